// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "chords.h"
#include "../contact/deformable_master.h"
#include "../geometry/closest_point.h"
#include "../geometry/gather.h"
#include "../geometry/smooth.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include "../text.h"
#include "passed_nodes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

using namespace contactx;
using namespace contactx::audit;

namespace
{
/// Change of gaps by chords, over the compression there, above which pressures
/// are those of the chords. In shrink fits of rings 0.35 leaves recovered
/// pressures within 1 %, by 0.8 nodes open, and by 0.5 surface-to-surface
/// contact loses a quarter of the mean pressure.
constexpr double chord_ratio_max = 0.4;
/// Error of the patches over the change of gaps by chords
constexpr double patch_error_fraction = 0.1;

/// Rise of the edge between two nodes of a facet, see geometry::rise_over.
template <class F>
struct Edges
{
  geometry::Nodes<F> x, normal;

  double operator()(int i, int j) const
  {
    const auto edge = x[j] - x[i];
    const double a = -dot(normal[i], edge), b = dot(normal[j], edge);
    return a * b > 0 ? std::copysign(std::min(std::abs(a), std::abs(b)), a) : 0;
  }
};

/// How a facet is bent.
struct Bend
{
  double curvature = 0; ///< of its edge that is bent most
  double turn = 0;      ///< of the normal along that edge
  double sagitta = 0;   ///< the largest one of an edge, without a sign
};

template <class F>
Bend bend(const Edges<F>& k)
{
  Bend found;
  for (int i = 0; i < F::nodes; ++i)
    for (int j = 0; j < i; ++j)
      // No diagonals of quadrilaterals
      if (F::flat or i + j != 3)
      {
        const auto edge = k.x[i] - k.x[j];
        const double rise = k(j, i), curvature = 2 * rise / dot(edge, edge);
        if (std::abs(curvature) > std::abs(found.curvature))
        {
          found.curvature = curvature;
          found.turn = std::abs(curvature) * norm(edge);
        }
        found.sagitta = std::max(found.sagitta, std::abs(rise) / 4);
      }
  return found;
}

/// True if one of two surfaces is hollow, and nearly as round as the other one.
bool do_fit(double a, double b)
{
  return std::abs(a + b) < 0.5 * std::max(std::abs(a), std::abs(b));
}

/// f(edges) of a facet.
template <int D, class Function>
void visit_edges(std::span<const std::int32_t> nodes, std::span<const double> x,
                 std::span<const double> normals, Function&& f)
{
  geometry::visit(static_cast<int>(nodes.size()),
                  [&]<class F>(F)
                  {
                    if constexpr (F::gdim == D)
                      f(Edges<F>{geometry::gather<F>(nodes, x),
                                 geometry::gather<F>(nodes, normals)});
                  });
}

/// The surfaces of a contact.
struct Sides
{
  std::span<const double> x;
  std::vector<double> of_slave, of_master; // normals
};

/// What chords change at owned slave nodes whose facets fit those of their
/// master.
struct Changes
{
  std::vector<double> off;  // taken off the gap, in the mean over pairs, or NaN
  std::vector<double> turn; // of the normal along a facet
  double sagitta = 0;       // the largest one of a facet that fits
};

/// A point of a slave facet, or a slave node, and the master in front of it.
template <int D>
struct Sample
{
  Vector<D> at{};
  double rise = 0; // of the slave
  std::array<double, 4>
      weight{};               // of the facet's nodes, by their dual functions
  double distance = infinity; // of the nearest master facet that fits
  double master = 0;          // its rise there
};

/// Points along a facet, in each direction: at the middles of parts.
constexpr int facet_divisions = 4;

/// Points of a slave facet; the sum of their weights is the facet's size.
template <int D, class F>
std::vector<Sample<D>> sampled(const Edges<F>& edges)
{
  std::vector<Sample<D>> samples;
  const auto add = [&](const geometry::Local<F>& xi)
  {
    const auto N = F::shape(xi);
    Sample<D> sample{geometry::combine<F>(N, edges.x),
                     geometry::rise_over<F>(xi, edges)};
    for (int l = 0; l < F::nodes; ++l)
    {
      if constexpr (F::flat)
        sample.weight[l] = (F::nodes + 1) * N[l] - 1;
      else
        sample.weight[l] = (l % 2 ? 3 * xi[0] - 1 : 2 - 3 * xi[0])
                           * (l / 2 ? 3 * xi[1] - 1 : 2 - 3 * xi[1]);
    }
    samples.push_back(sample);
  };
  for (int i = 0; i < facet_divisions; ++i)
  {
    const double s = (i + 0.5) / facet_divisions;
    if constexpr (F::tdim == 1)
      add({s});
    else if constexpr (F::flat)
      // Centres of smaller triangles, of both orientations
      for (int j = 0; i + j < facet_divisions; ++j)
      {
        add({(i + 1. / 3) / facet_divisions, (j + 1. / 3) / facet_divisions});
        if (i + j + 1 < facet_divisions)
          add({(i + 2. / 3) / facet_divisions, (j + 2. / 3) / facet_divisions});
      }
    else
      for (int j = 0; j < facet_divisions; ++j)
        add({s, (j + 0.5) / facet_divisions});
  }
  double size = 0;
  if constexpr (F::tdim == 1)
    size = norm(edges.x[1] - edges.x[0]);
  else
    size = norm(cross(edges.x[1] - edges.x[0], edges.x[2] - edges.x[0]));
  for (auto& sample : samples)
    for (double& weight : sample.weight)
      weight *= size / static_cast<double>(samples.size());
  return samples;
}

template <int D>
Changes changes(const contact::Contact& contact, const Sides& sides)
{
  const contact::SlaveNodes& slaves = contact.slaves();
  const std::size_t n = slaves.owned().size();
  Changes found{std::vector<double>(n, 0), std::vector<double>(n, 0)};
  // Of the facets around each slave node, that which is bent most
  std::vector<double> curvature(n, 0);
  const geometry::FacetList facets = slaves.facets(), local = slaves.local();
  std::map<std::vector<std::int32_t>, Bend> bent;
  for (std::int32_t f = 0; f < facets.size(); ++f)
    visit_edges<D>(facets[f], sides.x, sides.of_slave,
                   [&](const auto& edges)
                   {
                     const Bend its = bend(edges);
                     const auto corners = local[f];
                     if (its.curvature != 0)
                       bent[{corners.begin(), corners.end()}] = its;
                     for (const std::int32_t i : corners)
                     {
                       if (i >= static_cast<std::int32_t>(n)
                           or std::abs(its.curvature) <= std::abs(curvature[i]))
                         continue;
                       curvature[i] = its.curvature;
                       found.turn[i] = its.turn;
                     }
                   });
  // Of slave facets, or slave nodes, that something fits
  std::map<std::vector<std::int32_t>, std::vector<Sample<D>>> samples;
  for (const auto& pairs : contact.pairs())
    for (std::size_t p = 0; p < pairs->size() and not pairs->is_movement; ++p)
    {
      const auto m = std::size_t(pairs->num_slaves),
                 size = m + std::size_t(pairs->num_nodes);
      const auto nodes = std::span(pairs->nodes).subspan(p * size, size);
      const auto places = std::span(pairs->slaves).subspan(p * m, m);
      const std::vector<std::int32_t> key(places.begin(), places.end());
      Bend here;
      if (m == 1)
        here.curvature = curvature[key[0]];
      else if (const auto its = bent.find(key); its != bent.end())
        here = its->second;
      visit_edges<D>(
          nodes.subspan(m), sides.x, sides.of_master,
          [&]<class F>(const Edges<F>& edges)
          {
            const Bend there = bend(edges);
            if (not do_fit(here.curvature, there.curvature))
              return;
            found.sagitta
                = std::max({found.sagitta, here.sagitta, there.sagitta});
            auto& its = samples[key];
            if (its.empty() and m == 1)
              // The slave node itself is on its surface
              its.push_back({geometry::point<D>(nodes[0], sides.x), 0, {1}});
            else if (its.empty())
              visit_edges<D>(nodes.first(m), sides.x, sides.of_slave,
                             [&](const auto& slave)
                             { its = sampled<D>(slave); });
            for (Sample<D>& sample : its)
              if (const auto foot
                  = geometry::closest_point<F>(edges.x, sample.at);
                  foot.distance2 < sample.distance)
              {
                sample.distance = foot.distance2;
                sample.master = geometry::rise_over<F>(foot.xi, edges);
              }
          });
    }
  std::vector<double> weight(n, 0);
  for (const auto& [places, its] : samples)
    for (std::size_t k = 0; k < places.size(); ++k)
      for (const Sample<D>& sample : its)
        if (const std::int32_t i = places[k]; i < static_cast<std::int32_t>(n))
        {
          found.off[i] += sample.weight[k] * (sample.rise + sample.master);
          weight[i] += sample.weight[k];
        }
  for (std::size_t i = 0; i < n; ++i)
    found.off[i] = weight[i] > 0 ? found.off[i] / weight[i]
                                 : std::numeric_limits<double>::quiet_NaN();
  return found;
}
} // namespace

double Chords::ratio() const
{
  const double change = scatter + mean * turn;
  return change > math::negligible_part * sagitta ? change / pressed : 0;
}

bool Chords::is_coarse() const { return ratio() > chord_ratio_max; }

std::string Chords::words() const
{
  return "facets are chords, up to " + number_text(sagitta, 2)
         + " off the round surfaces that they stand for. Gaps are off by "
         + number_text(mean, 2) + " in the mean"
         + (scatter > 0.01 * mean
                ? " and by " + number_text(scatter, 2) + " from node to node, "
                : ", ")
         + (pressed > 0
                ? "where pressures press nodes in by " + number_text(pressed, 2)
                      + ": pressures are those of chords"
                : std::string("and keep nodes from touching"))
         + ". Take smooth=True, with adjust=length for a fit without "
           "clearance, or a finer mesh, or surface-to-surface contact of a "
           "curved one with quadratic displacements (manual: errors/chords)";
}

std::optional<Chords> contactx::audit::chords(mesh::Halo& halo,
                                              const contact::Contact& contact)
{
  const auto* master
      = dynamic_cast<const contact::DeformableMaster*>(contact.master().get());
  const contact::SlaveNodes& slaves = contact.slaves();
  // The same on all ranks. Quadratic facets that are integrated are curved, by
  // node-to-surface linear parts of them stand for them
  if (not master or slaves.is_mortar() or master->is_smooth())
    return {};
  const Sides sides{
      halo.reference(), even_normals(halo, slaves.own(), halo.reference()),
      even_normals(halo, master->surface()->own(), halo.reference())};
  const Changes found = halo.gdim() == 2 ? changes<2>(contact, sides)
                                         : changes<3>(contact, sides);
  const law::NodeState& state = *contact.nodes();
  const std::size_t n = slaves.owned().size();
  // Those in contact, and those that chords keep from it
  std::vector<std::int8_t> which(n), is_near(n, 0);
  bool is_kept = false;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double off = found.off[i], change = std::abs(off);
    // What was counted as none is not kept from touching
    const bool is_hidden = change > math::negligible_part * found.sagitta
                           and state.gap[i] + contact.adjusted()[i]
                                   < off - patch_error_fraction * change;
    which[i] = not contact.is_left_out()[i]
               and (state.is_constrained(i) or is_hidden);
    is_kept = is_kept or (which[i] and not state.is_constrained(i));
  }
  // All nodes of facets that have one of these
  const auto near = slaves.near(which);
  const geometry::FacetList local = slaves.local();
  for (std::int32_t f = 0; f < local.size(); ++f)
    for (const std::int32_t i : local[f])
      if (near[f] == 2 and i < static_cast<std::int32_t>(n)
          and not std::isnan(found.off[i]))
        is_near[i] = 1;

  // Force, and force times how far it presses in; area, and area times what is
  // off and turns
  std::array<double, 5> sums{};
  for (std::size_t i = 0; i < n; ++i)
  {
    if (not is_near[i])
      continue;
    sums[2] += state.area[i];
    sums[3] += state.area[i] * found.off[i];
    sums[4] += state.area[i] * found.turn[i];
    if (not state.is_constrained(i))
      continue;
    const double p = state.pressure(i);
    sums[0] += p * state.area[i];
    sums[1] += p * state.area[i] * p / state.c[i];
  }
  mesh::Ranks& ranks = halo.ranks();
  ranks.reduce(std::span<double>(sums), mesh::Reduction::sum);
  const auto [force, work, area, off, turn] = sums;
  if (not(area > 0) or (force == 0 and not mesh::anywhere(ranks, is_kept)))
    return {};
  double scatter = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (is_near[i])
      scatter += state.area[i] * std::abs(found.off[i] - off / area);
  return Chords{.mean = std::abs(off) / area,
                .scatter = mesh::total(ranks, scatter) / area,
                .turn = turn / area,
                .sagitta = mesh::largest(ranks, found.sagitta),
                .pressed = force > 0 ? work / force : 0};
}
