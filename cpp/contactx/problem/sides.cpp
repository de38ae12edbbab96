// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "sides.h"
#include "../check.h"
#include "../contact/mortar_obstacle.h"
#include "../contact/node_to_surface.h"
#include "../contact/obstacle_tie.h"
#include "../contact/surface_to_surface.h"
#include "../geometry/sizes.h"
#include "../mesh/extent.h"
#include "../mesh/shared_nodes.h"
#include "../search/self/self_surface.h"
#include "../search/slave_facets.h"
#include "../text.h"
#include "check_facets.h"
#include "check_inside.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

using namespace contactx;
using namespace contactx::problem;

namespace
{
void check_facet_list(const mesh::Halo& halo, const geometry::FacetList& facets,
                      const std::string& of)
{
  check::facets(facets.offsets, facets.nodes, halo.gdim(), of);
  check::numbers(facets.nodes, halo.num_nodes(), of + "nodes", "nodes");
}

void check_arguments(const mesh::Mesh& mesh, const contact::SlaveNodes* slaves,
                     const MasterOptions& options)
{
  check::require(mesh.halo and mesh.bodies and slaves,
                 "mesh and slaves must not be empty");
  check_facet_list(*mesh.halo, slaves->own(), "slave_");
  check::rows(std::ssize(mesh.cells), std::ssize(mesh.bodies->of_cell()),
              mesh.nodes_per_cell, "cells", "cell of the bodies");
  check::numbers(mesh.cells, mesh.halo->num_nodes(), "cells", "nodes");
  if (options.search_distance and not(*options.search_distance > 0))
    throw std::invalid_argument("search_distance must be larger than zero, not "
                                + number_text(*options.search_distance, 6));
}

/// What smooth surfaces are not made for.
void check_smooth(const law::Law& law, const MasterOptions& options)
{
  if (not options.is_smooth)
    return;
  check::require(
      options.level.empty(),
      "smooth is for linear facets: quadratic ones are curved as the "
      "mesh is; leave it out, and curve the mesh");
  check::require(not law.is_tied(),
                 "smooth is not for ties, whose places on the facets stay as "
                 "they are: leave it out");
  check::require(not options.is_self,
                 "smooth is not for a surface on itself, of which one side is "
                 "chosen a node at a time: leave it out, or give each side a "
                 "surface of its own");
}

/// Largest distance of the nodes of a surface from their mean.
double radius(const mesh::Halo& halo, const geometry::FacetList& facets)
{
  const auto x = halo.reference();
  const std::size_t gdim = halo.gdim();
  // Each node counts on the rank that owns it
  std::vector<double> marks(halo.num_nodes(), 0);
  for (const std::int32_t node : facets.nodes)
    marks[node] = 1;
  halo.reverse(std::span(marks), 1);
  std::array<double, 4> sums{};
  for (std::int32_t i = 0; i < halo.num_owned(); ++i)
    if (marks[i] > 0)
    {
      for (std::size_t k = 0; k < gdim; ++k)
        sums[k] += x[i * gdim + k];
      ++sums[3];
    }
  halo.ranks().reduce(std::span<double>(sums), mesh::Reduction::sum);
  double largest = 0;
  for (std::int32_t i = 0; i < halo.num_owned(); ++i)
    if (marks[i] > 0)
    {
      Vector<3> arm{};
      for (std::size_t k = 0; k < gdim; ++k)
        arm[k] = x[i * gdim + k] - sums[k] / sums[3];
      largest = std::max(largest, norm(arm));
    }
  return mesh::largest(halo.ranks(), largest);
}
} // namespace

double contactx::problem::default_reach(const mesh::Halo& halo,
                                        const geometry::FacetList& slave,
                                        const geometry::FacetList& master)
{
  const double of_slave = radius(halo, slave);
  return 2 * std::max(of_slave, radius(halo, master));
}

std::shared_ptr<contact::SlaveNodes> contactx::problem::make_slave_nodes(
    const std::shared_ptr<mesh::Halo>& halo, const geometry::FacetList& facets,
    std::span<const std::int8_t> level, Method method, bool is_rigid)
{
  check::require(halo != nullptr, "halo must not be empty");
  halo->ranks().agree([&] { check_facet_list(*halo, facets, ""); });
  const geometry::Facets own
      = search::in_order(*halo, facets.offsets, facets.nodes);
  const geometry::Facets around
      = search::slave_facets(*halo, own.offsets, own.nodes, level);
  const auto slaves
      = std::make_shared<contact::SlaveNodes>(halo, around.list(), own.list());
  // A rank without nodes has none of their levels
  if (not mesh::anywhere(halo->ranks(), not level.empty()))
    return slaves;
  std::vector<std::int8_t> own_level;
  for (const std::int32_t node : slaves->owned())
    own_level.push_back(level[node]);
  slaves->set_level(own_level,
                    contact::integrates_facets(method, is_rigid, true));
  return slaves;
}

std::shared_ptr<contact::DeformableMaster> contactx::problem::make_master(
    const mesh::Mesh& mesh, std::shared_ptr<const contact::SlaveNodes> slaves,
    const std::string& slave_name, const mesh::NamedSurface& master,
    const law::Law& law, const MasterOptions& options)
{
  check::require(mesh.halo != nullptr, "mesh must have a halo");
  const std::shared_ptr<mesh::Halo>& halo = mesh.halo;
  halo->ranks().agree(
      [&]
      {
        check_arguments(mesh, slaves.get(), options);
        check_facet_list(*halo, master.facets, "master_");
        check_smooth(law, options);
      });
  const mesh::NamedSurface slave{slave_name, slaves->own()};
  check_facets(*halo, slave, "slave");
  check_facets(*halo, master, "master");
  if (not options.is_self)
    check_shared(*halo, slave, master);
  check_nested(mesh, slave, master);
  // Where facets are folded a node has no normal to search along; facets have
  const bool is_mortar = contact::integrates_facets(options.method, false,
                                                    slaves->is_quadratic());
  if (not is_mortar)
    check_folds(*halo, *slaves, slave_name);
  const contact::PairingOptions pairing{
      options.search_distance
          ? *options.search_distance
          : default_reach(*halo, slaves->facets(), master.facets),
      options.sliding == contact::Sliding::small, law.is_vector(),
      options.level, options.is_smooth};
  const geometry::Facets own
      = search::in_order(*halo, master.facets.offsets, master.facets.nodes);
  // The halo grows, and the bodies with it
  const std::vector<std::int64_t> body = mesh.bodies->of_node();
  const std::shared_ptr<search::MasterSurface> surface
      = options.is_self
            ? std::make_shared<search::SelfSurface>(
                  halo, own, body, options.excluded_distance, options.level)
            : search::make_master_surface(halo, own.offsets, own.nodes,
                                          options.level);
  const auto outside
      = std::make_shared<search::InsideTest>(halo, own.offsets, own.nodes);
  const auto made
      = [&]<class M>(
            std::type_identity<M>) -> std::shared_ptr<contact::DeformableMaster>
  { return std::make_shared<M>(halo, slaves, surface, outside, pairing); };
  using namespace contact;
  if (is_mortar)
    return law.is_tied() ? made(std::type_identity<SurfaceTie>())
                         : made(std::type_identity<SurfaceToSurface>());
  return law.is_tied() ? made(std::type_identity<NodeTie>())
                       : made(std::type_identity<NodeToSurface>());
}

std::shared_ptr<contact::ObstacleMaster> contactx::problem::make_master(
    const mesh::Mesh& mesh, std::shared_ptr<const contact::SlaveNodes> slaves,
    const std::string& slave_name, std::shared_ptr<geometry::Obstacle> obstacle,
    const law::Law& law, const MasterOptions& options)
{
  check::require(mesh.halo != nullptr, "mesh must have a halo");
  mesh::Halo& halo = *mesh.halo;
  halo.ranks().agree(
      [&]
      {
        check_arguments(mesh, slaves.get(), options);
        check::require(obstacle != nullptr, "obstacle must not be empty");
        check::require(
            not options.is_smooth,
            "smooth is for surfaces of facets; an obstacle is smooth "
            "as it is: leave it out");
      });
  check_facets(halo, {slave_name, slaves->own()}, "slave");
  const auto x = halo.reference();
  const int gdim = halo.gdim();
  obstacle->extent = std::max(
      obstacle->extent,
      std::ranges::max(mesh::extent(halo.ranks(), slaves->owned(), x, gdim)));
  double smallest = std::numeric_limits<double>::infinity();
  for (const double size : geometry::facet_sizes(slaves->own(), x, gdim))
    smallest = std::min(smallest, size);
  smallest = -mesh::largest(halo.ranks(), -smallest);
  obstacle->facet
      = obstacle->facet > 0 ? std::min(obstacle->facet, smallest) : smallest;
  const double reach = options.search_distance.value_or(
      std::numeric_limits<double>::infinity());
  std::shared_ptr<contact::ObstacleMaster> master;
  std::vector<double> gap;
  halo.ranks().agree(
      [&]
      {
        using namespace contact;
        if (law.is_tied())
          master
              = std::make_shared<ObstacleTie>(obstacle, slaves, x, gdim, reach);
        else if (contact::integrates_facets(options.method, true,
                                            slaves->is_quadratic())
                 and not obstacle->is_flat())
          master = std::make_shared<MortarObstacle>(obstacle, slaves, x, gdim,
                                                    reach, law.is_vector());
        else
          // Dual functions weigh what is linear on a facet, as a plane's gap,
          // at its nodes
          master = std::make_shared<ObstacleMaster>(obstacle, slaves, x, gdim,
                                                    reach, law.is_vector());
        gap = master->inside(x);
      });
  check_outside(mesh, *slaves, slave_name, gap, *obstacle);
  return master;
}
