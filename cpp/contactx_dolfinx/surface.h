// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "halo.h"
#include <array>
#include <contactx/facet/facets.h>
#include <contactx/vec.h>
#include <dolfinx/fem/ElementDofLayout.h>
#include <dolfinx/mesh/MeshTags.h>
#include <dolfinx/mesh/Topology.h>
#include <dolfinx/mesh/cell_types.h>
#include <initializer_list>
#include <stdexcept>
#include <string>

namespace contactx::dolfinx
{
/// @brief Tagged part of a mesh's boundary.
class Surface
{
public:
  /// @brief Create a surface; all ranks must take part.
  /// @param[in] tags Tags of facets.
  /// @param[in] values Values of these that make up the surface.
  /// @throws std::invalid_argument if the tags are not of facets, or no facet
  /// of any rank has one of the values.
  Surface(std::shared_ptr<const ::dolfinx::mesh::MeshTags<std::int32_t>> tags,
          std::vector<std::int32_t> values)
      : _tags(std::move(tags)), _values(std::move(values))
  {
    const auto& topology = *_tags->topology();
    if (_tags->dim() != topology.dim() - 1)
      throw std::invalid_argument(
          "a Surface needs tags of facets: pass those of dimension tdim - 1");
    if (_values.empty())
      throw std::invalid_argument("a Surface needs at least one tag: pass one");
    const std::int32_t owned = topology.index_map(_tags->dim())->size_local();
    std::vector<std::int64_t> there;
    for (std::int32_t value : _values)
    {
      const std::vector<std::int32_t> facets = _tags->find(value);
      there.push_back(std::ranges::count_if(facets, [owned](std::int32_t f)
                                            { return f < owned; }));
      _facets.insert(_facets.end(), facets.begin(), facets.end());
    }
    std::ranges::sort(_facets);
    const auto repeated = std::ranges::unique(_facets);
    _facets.erase(repeated.begin(), repeated.end());
    Ranks ranks(topology.comm());
    ranks.reduce(std::span<std::int64_t>(there), parallel::Reduction::sum);
    std::int64_t count = 0;
    for (std::size_t i = 0; i < _values.size(); ++i)
    {
      if (there[i] == 0)
        throw std::invalid_argument(
            "tag " + std::to_string(_values[i])
            + " is not in the facet tags: give tags that "
              "are there");
      _name += (i > 0 ? ", " : "") + std::to_string(_values[i]);
      count += there[i];
    }
    _name = "Surface({" + _name + "}, " + std::to_string(count) + " facets)";
  }

  /// @brief Whether another surface is the same part of the same tags.
  bool is(const Surface& other) const
  {
    return _tags == other._tags and _facets == other._facets;
  }

  /// @brief Name in messages.
  const std::string& name() const { return _name; }

  /// @brief Nodes of the surface's facets whose cells this rank owns, oriented:
  /// the normal t_1 x t_2 of a facet's local coordinates points out of its
  /// cell. All ranks must take part.
  /// @param[in] V Linear Lagrange space whose blocks of dofs are the nodes.
  /// @param[in] ranks The ranks.
  /// @throws std::invalid_argument on all ranks if the tags belong to another
  /// mesh, or a facet has a cell on either side.
  facet::Facets facet_nodes(const FunctionSpace& V,
                            parallel::Ranks& ranks) const
  {
    auto topology = V.mesh()->topology_mutable();
    const int tdim = topology->dim(), gdim = V.mesh()->geometry().dim();
    topology->create_connectivity(tdim - 1, tdim);
    topology->create_connectivity(tdim, tdim - 1);
    const auto cells = topology->connectivity(tdim - 1, tdim);
    ranks.agree([&] { check(*topology, *cells); });

    const auto facets = topology->connectivity(tdim, tdim - 1);
    const std::int32_t num_owned = topology->index_map(tdim)->size_local();
    const auto& layout = V.dofmap()->element_dof_layout();
    const std::vector<double> x = reference_positions(V);
    facet::Facets result;
    for (std::int32_t f : _facets)
    {
      const std::int32_t cell = cells->links(f)[0];
      if (cell >= num_owned)
        continue;
      const auto own = facets->links(cell);
      const auto local = std::ranges::find(own, f) - own.begin();
      const auto dofs = V.dofmap()->cell_dofs(cell);
      const std::size_t at = result.nodes.size();
      for (int i :
           layout.entity_closure_dofs(tdim - 1, static_cast<int>(local)))
        result.nodes.push_back(dofs[i]);
      const auto nodes = std::span(result.nodes).subspan(at);
      if (points_inward(nodes, dofs, x, gdim))
        gdim == 2 ? std::swap(nodes[0], nodes[1])
                  : std::swap(nodes[1], nodes[2]);
      result.offsets.push_back(static_cast<std::int32_t>(result.nodes.size()));
    }
    return result;
  }

private:
  void check(const ::dolfinx::mesh::Topology& topology,
             const ::dolfinx::graph::AdjacencyList<std::int32_t>& cells) const
  {
    if (_tags->topology().get() != &topology)
      throw std::invalid_argument("the facet tags of " + _name
                                  + " belong to another mesh than the "
                                    "displacement: make them on its mesh");
    std::vector<std::int32_t> between;
    // The cell on the other side may be on another rank
    if (::dolfinx::MPI::size(topology.comm()) > 1)
      between = topology.interprocess_facets();
    std::ranges::sort(between);
    for (std::int32_t f : _facets)
      if (cells.num_links(f) != 1 or std::ranges::binary_search(between, f))
        throw std::invalid_argument(
            _name
            + " has facets inside a body, with a cell on either side: a "
              "contact surface must be part of the boundary");
  }

  static Vector<3> at(std::int32_t node, std::span<const double> x, int gdim)
  {
    Vector<3> point{};
    std::copy_n(x.begin() + gdim * node, gdim, point.begin());
    return point;
  }

  static Vector<3> middle(std::span<const std::int32_t> nodes,
                          std::span<const double> x, int gdim)
  {
    Vector<3> sum{};
    for (std::int32_t node : nodes)
      sum = sum + at(node, x, gdim);
    return (1.0 / static_cast<double>(nodes.size())) * sum;
  }

  static bool points_inward(std::span<const std::int32_t> facet,
                            std::span<const std::int32_t> cell,
                            std::span<const double> x, int gdim)
  {
    const Vector<3> t = at(facet[1], x, gdim) - at(facet[0], x, gdim);
    const Vector<3> normal
        = gdim == 2 ? Vector<3>{t[1], -t[0], 0}
                    : cross(t, at(facet[2], x, gdim) - at(facet[0], x, gdim));
    return dot(normal, middle(facet, x, gdim) - middle(cell, x, gdim)) < 0;
  }

  std::shared_ptr<const ::dolfinx::mesh::MeshTags<std::int32_t>> _tags;
  std::vector<std::int32_t> _values, _facets;
  std::string _name;
};
} // namespace contactx::dolfinx
