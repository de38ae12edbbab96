// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "edges.h"
#include "../contact/node_to_surface.h"
#include "../geometry/middle.h"
#include "../text.h"
#include "passed_nodes.h"
#include "penetration.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

using namespace contactx;
using namespace contactx::audit;

namespace
{
/// Largest error of the normal force, relative: the angle by which the
/// contact's force is off, 3 degrees. Under punches, which are right, it was
/// up to 0.024. A ball on a plate's edge was off by 5 degrees at 0.062, by 40
/// at 0.68.
constexpr double force_error_max = 0.05;
/// Force on an edge between the nodes, over the normal force, from which on the
/// nodes resolve too little of it. At corners of punches, which are right, it
/// was up to 0.32; a ball beside an edge had half of the force at 1.6.
constexpr double unseen_force_max = 1;
/// Largest angle between a slave facet and a face of the master whose edge is
/// pressed as the face is, radians
constexpr double face_angle_max = std::numbers::pi / 12;
} // namespace

double EdgeForce::ratio() const
{
  return unseen > unseen_force_max ? infinity : off;
}

bool EdgeForce::is_coarse() const { return ratio() > force_error_max; }

std::string EdgeForce::words() const
{
  const std::string what
      = unseen > unseen_force_max
            ? "an edge of the master is " + number_text(depth, 2)
                  + " deep in a slave facet of size " + number_text(size, 2)
                  + " at " + point_text(hidden, size)
                  + ", between its nodes, which take less force than that needs"
            : "edges of the master take " + number_text(100 * share, 3)
                  + " % of the force along normals of their faces, "
                  + number_text(360 / std::numbers::pi
                                    * std::asin(std::min(1., off / share / 2)),
                                2)
                  + " degrees off those of the slave in the mean, most at "
                  + point_text(at, norm(vector_at(at, 0, int(at.size()))));
  return what
         + ". Nodes do not see an edge between them, and the force has another "
           "direction. Swap slave and master, or take surface-to-surface "
           "contact (manual: errors/edges)";
}

std::optional<EdgeForce>
contactx::audit::edge_force(mesh::Halo& halo, const contact::Contact& contact,
                            std::span<const double> x,
                            std::span<const MasterBelow> below)
{
  const auto* master
      = dynamic_cast<const contact::NodeToSurface*>(contact.master().get());
  if (not master) // The same on all ranks
    return {};
  const int g = halo.gdim();
  const auto own = master->surface()->own();
  const auto even = even_normals(halo, own, halo.reference()),
             normal = even_normals(halo, contact.slaves().own(), x);
  const auto is_edge
      = [&](std::int32_t node) { return norm(vector_at(even, node, g)) == 0; };

  // Normal forces, and what is off in them, at nodes of the master
  const auto slaves = contact.slaves().owned();
  const law::NodeState& state = *contact.nodes();
  const std::vector<double> of_master = master->normals();
  std::vector<double> force(slaves.size(), 0);
  for (std::size_t i = 0; i < slaves.size(); ++i)
    if (state.closed(i))
      force[i] = state.pressure(i) * state.area[i];
  std::vector<double> shared(std::size_t(halo.num_nodes()) * 4, 0);
  const kernel::Weights weights = master->weights();
  for (std::size_t e = 0; e < weights.nodes.size(); ++e)
  {
    const std::int32_t i = weights.slaves[e];
    if (weights.nodes[e] == slaves[i])
      continue;
    const double part = -weights.values[e] * force[i];
    const auto n = vector_at(normal, slaves[i], g);
    const auto off = vector_at(of_master, i, 3) + n;
    double* row = &shared[std::size_t(weights.nodes[e]) * 4];
    row[3] += part;
    for (int k = 0; k < 3 and norm(n) > 0; ++k)
      row[k] += part * off[k];
  }
  halo.reverse(std::span(shared), 4);
  std::array<double, 3> sums{std::accumulate(force.begin(), force.end(), 0.)};
  // The worst of this rank: what is off and where, what is unseen, its depth,
  // the facet's size and where
  std::array<double, 10> worst{};
  const auto at = halo.now();
  const std::vector<double>& now = at->x;
  for (std::int32_t i = 0; i < halo.num_owned(); ++i)
    if (const double* row = &shared[std::size_t(i) * 4];
        row[3] > 0 and is_edge(i))
    {
      const double off = norm(Vector<3>{row[0], row[1], row[2]});
      sums[1] += row[3];
      sums[2] += off;
      if (off > worst[0])
      {
        worst[0] = off;
        std::copy_n(&now[std::size_t(i) * g], g, &worst[1]);
      }
    }
  halo.ranks().reduce(std::span<double>(sums), mesh::Reduction::sum);
  const auto [total, at_edges, off] = sums;

  // Cosine of the angle between a facet and the face that it fits best
  std::vector<double> fit(halo.num_nodes(), 1);
  std::vector<Vector<3>> facing(halo.num_nodes());
  for (const MasterBelow& its : below)
    if (its.depth > negligible_depth * its.size and is_edge(its.node))
    {
      fit[its.node] = -1;
      facing[its.node] = its.normal;
    }
  const geometry::FacetList around = master->surface()->around();
  const auto faces = geometry::middles(around, x, g).normals;
  for (std::int32_t f = 0; f < around.size(); ++f)
    for (const std::int32_t node : around[f])
      fit[node]
          = std::max(fit[node], -dot(vector_at(faces, f, g), facing[node]));
  for (const MasterBelow& its : below)
    if (const double needed = its.stiffness * its.depth;
        fit[its.node] < std::cos(face_angle_max) and needed > worst[4])
    {
      worst[4] = needed;
      worst[5] = its.depth;
      worst[6] = its.size;
      std::copy_n(&now[std::size_t(its.node) * g], g, &worst[7]);
    }
  const auto all = mesh::gathered<double>(halo.ranks(), worst);
  worst.fill(0); // Of as bad ones all ranks take that of the same rank
  for (auto row = all.begin(); row != all.end(); row += worst.size())
  {
    if (row[0] > worst[0])
      std::copy_n(row, 4, worst.begin());
    if (row[4] > worst[4])
      std::copy_n(row + 4, 6, worst.begin() + 4);
  }
  if (not(total > 0) and worst[4] == 0)
    return {};
  return EdgeForce{total > 0 ? at_edges / total : 0,
                   total > 0 ? off / total : 0,
                   {&worst[1], &worst[1] + g},
                   total > 0 ? worst[4] / total : infinity,
                   worst[5],
                   worst[6],
                   {&worst[7], &worst[7] + g}};
}
