// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "chords.h"
#include "../contact/deformable_master.h"
#include "../facet/closest_point.h"
#include "../facet/gather.h"
#include "../facet/smooth.h"
#include "../text.h"
#include "../vec.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::audit;

namespace
{
/// What chords are off over what pressures press in, from which on pressures
/// are those of chords
constexpr double off_allowed = 0.5;
/// Length of the mean of the unit normals of a node's facets, by area: that of
/// two facets that meet at facet::cosine_at_edges
const double even_enough = std::sqrt((1 + facet::cosine_at_edges) / 2);

/// Mean unit normals of a surface at the nodes of this rank (shape=(num_nodes,
/// gdim)), zero at its edges.
std::vector<double> even_normals(parallel::Halo& halo,
                                 const facet::FacetList& own)
{
  const int g = halo.gdim();
  const auto x = halo.reference();
  std::vector<double> normal = facet::nodal_area_vectors(own, x, g);
  std::vector<double> area = facet::nodal_areas(own, x, g);
  halo.reverse(std::span(normal), g);
  halo.reverse(std::span(area), 1);
  for (std::int32_t i = 0; i < halo.num_owned(); ++i)
  {
    double* n = &normal[std::size_t(i) * g];
    const double size = std::sqrt(dot(n, n, g));
    const bool is_even = size > 0 and size >= even_enough * area[i];
    for (int k = 0; k < g; ++k)
      n[k] = is_even ? n[k] / size : 0;
  }
  halo.forward(std::span(normal), g);
  return normal;
}

/// Rise of the edge between two nodes of a facet, see facet::rise_over.
template <class F>
struct Edges
{
  facet::Nodes<F> x, normal;

  double operator()(int i, int j) const
  {
    const auto way = x[j] - x[i];
    const double a = -dot(normal[i], way), b = dot(normal[j], way);
    return a * b > 0 ? std::copysign(std::min(std::abs(a), std::abs(b)), a) : 0;
  }
};

/// Mean of the rise over a facet.
template <class F>
double mean_rise(const Edges<F>& k)
{
  if constexpr (F::nodes == 2)
    return k(0, 1) / 6;
  else if constexpr (F::nodes == 3)
    return (k(0, 1) + k(1, 2) + k(0, 2)) / 12;
  else
    return (k(0, 1) + k(2, 3) + k(0, 2) + k(1, 3)) / 12;
}

/// How a facet is bent.
struct Bend
{
  double curvature = 0; ///< of its edge that is bent most
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
        const auto way = k.x[i] - k.x[j];
        const double rise = k(j, i), curvature = 2 * rise / dot(way, way);
        if (std::abs(curvature) > std::abs(found.curvature))
          found.curvature = curvature;
        found.sagitta = std::max(found.sagitta, std::abs(rise) / 4);
      }
  return found;
}

/// True if one of two surfaces is hollow, and nearly as round as the other one.
bool do_fit(double a, double b)
{
  return std::abs(a + b) < 0.5 * std::max(std::abs(a), std::abs(b));
}

/// The surfaces of a contact.
struct Sides
{
  std::span<const double> x;
  std::vector<double> of_slave, of_master; // normals

  // f(edges) of a facet
  template <int D, class Function>
  static void visit(std::span<const std::int32_t> nodes,
                    std::span<const double> x, std::span<const double> normals,
                    Function&& f)
  {
    facet::visit(static_cast<int>(nodes.size()),
                 [&]<class F>(F)
                 {
                   if constexpr (F::gdim == D)
                     f(Edges<F>{facet::gather<F>(nodes, x),
                                facet::gather<F>(nodes, normals)});
                 });
  }
};

/// What chords take off the gap of each owned slave node whose facets fit those
/// of its master, in the mean over its pairs; NaN for others, and for those of
/// facets without a node in contact.
template <int D>
std::vector<double> off_nodes(const contact::Contact& contact,
                              std::span<const std::int8_t> near,
                              const Sides& sides, double& sagitta)
{
  const contact::SlaveNodes& slaves = contact.slaves();
  const std::size_t n = slaves.owned().size();
  // Of the facets around each slave node, that which is bent most
  std::vector<double> curvature(n, 0);
  std::vector<std::int8_t> is_near(n, 0);
  const facet::FacetList facets = slaves.facets(), local = slaves.local();
  for (std::int32_t f = 0; f < facets.size(); ++f)
    Sides::visit<D>(facets[f], sides.x, sides.of_slave,
                    [&](const auto& edges)
                    {
                      const Bend its = bend(edges);
                      for (const std::int32_t i : local[f])
                      {
                        if (i >= static_cast<std::int32_t>(n))
                          continue;
                        is_near[i] |= near[f] == 2;
                        if (std::abs(its.curvature) > std::abs(curvature[i]))
                          curvature[i] = its.curvature;
                      }
                    });
  std::vector<double> off(n, 0);
  std::vector<int> count(n, 0);
  for (const auto& pairs : contact.pairs())
    for (std::size_t p = 0; p < pairs->size() and not pairs->is_movement; ++p)
    {
      const auto m = std::size_t(pairs->num_slaves),
                 size = m + std::size_t(pairs->num_nodes);
      const auto nodes = std::span(pairs->nodes).subspan(p * size, size);
      double rise = 0;
      Bend here, there;
      Sides::visit<D>(nodes.subspan(m), sides.x, sides.of_master,
                      [&]<class F>(const Edges<F>& edges)
                      {
                        there = bend(edges);
                        if (m > 1)
                          rise = mean_rise(edges);
                        else
                        {
                          // The slave node itself is on its surface
                          const auto foot = facet::closest_point<F>(
                              edges.x, facet::point<D>(nodes[0], sides.x));
                          rise = facet::rise_over<F>(foot.xi, edges);
                        }
                      });
      if (m > 1)
        Sides::visit<D>(nodes.first(m), sides.x, sides.of_slave,
                        [&](const auto& edges)
                        {
                          here = bend(edges);
                          rise += mean_rise(edges);
                        });
      for (std::size_t k = 0; k < m; ++k)
      {
        const std::int32_t i = pairs->slaves[p * m + k];
        if (i >= static_cast<std::int32_t>(n) or not is_near[i]
            or not do_fit(curvature[i], there.curvature))
          continue;
        off[i] += rise;
        ++count[i];
        sagitta = std::max({sagitta, here.sagitta, there.sagitta});
      }
    }
  for (std::size_t i = 0; i < n; ++i)
    off[i] = count[i] > 0 ? std::abs(off[i]) / count[i]
                          : std::numeric_limits<double>::quiet_NaN();
  return off;
}
} // namespace

bool Chords::is_coarse() const { return ratio() > off_allowed; }

std::string Chords::words() const
{
  return "facets are chords, up to " + number_text(sagitta, 2)
         + " off the round surfaces that they stand for: gaps are off by "
         + number_text(off, 2) + " in the mean, " + number_text(ratio(), 2)
         + " times as much as what presses there presses in, "
         + number_text(pressed, 2)
         + ", and pressures are those of chords. Take smooth=True, with "
           "adjust=length for a fit without clearance, or a finer mesh, or a "
           "curved one with quadratic displacements (manual: "
           "errors/chords)";
}

std::optional<Chords> contactx::audit::chords(parallel::Halo& halo,
                                              const contact::Contact& contact)
{
  const auto* master
      = dynamic_cast<const contact::DeformableMaster*>(contact.master().get());
  const contact::SlaveNodes& slaves = contact.slaves();
  // The same on all ranks
  if (not master or slaves.is_quadratic() or master->is_smooth())
    return {};
  const contact::NodeState& state = *contact.nodes();
  std::vector<std::int8_t> held(slaves.owned().size());
  for (std::size_t i = 0; i < held.size(); ++i)
    held[i] = state.held(i) and not contact.is_left_out()[i];
  const auto near = slaves.near(held);
  const Sides sides{halo.reference(), even_normals(halo, slaves.own()),
                    even_normals(halo, master->surface()->own())};
  double sagitta = 0;
  const auto off = halo.gdim() == 2
                       ? off_nodes<2>(contact, near, sides, sagitta)
                       : off_nodes<3>(contact, near, sides, sagitta);
  // Force, force times how far it presses in; area, and area times what is off
  std::array<double, 4> sums{};
  const int width = state.size();
  for (std::size_t i = 0; i < off.size(); ++i)
  {
    if (std::isnan(off[i]))
      continue;
    sums[2] += state.area[i];
    sums[3] += state.area[i] * off[i];
    if (not held[i])
      continue;
    const double* value = &state.multiplier[i * width];
    const double p
        = width == 1 ? value[0] : dot(value, &state.normal[i * width], width);
    sums[0] += p * state.area[i];
    sums[1] += p * state.area[i] * p / state.c[i];
  }
  halo.ranks().reduce(std::span<double>(sums), parallel::Reduction::sum);
  sagitta = parallel::largest(halo.ranks(), sagitta);
  if (not(sums[1] > 0 and sums[2] > 0))
    return {};
  return Chords{sums[3] / sums[2], sagitta, sums[1] / sums[0]};
}
