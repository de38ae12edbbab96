// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <dolfinx/mesh/MeshTags.h>

namespace contactx::geometry
{
struct Facets;
}
namespace contactx::mesh
{
class Ranks;
}

namespace contactx_dolfinx
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
  Surface(std::shared_ptr<const dolfinx::mesh::MeshTags<std::int32_t>> tags,
          std::vector<std::int32_t> values);

  /// @brief Whether another surface is the same part of the same tags.
  bool is(const Surface& other) const
  {
    return _tags == other._tags and _facets == other._facets;
  }

  /// @brief Name in messages.
  const std::string& name() const { return _name; }

  /// @brief Nodes of the surface's facets whose cells this rank owns, oriented,
  /// see contactx::mesh::facets. All ranks must take part.
  /// @param[in] V Lagrange space of degree 1 or 2 whose blocks of dofs are the
  /// nodes.
  /// @param[in] ranks The ranks.
  /// @param[in] role What the surface is to a contact.
  /// @throws std::invalid_argument on all ranks if the tags belong to another
  /// mesh, a facet has a cell on either side, or facets are curved that the
  /// displacement has straight.
  contactx::geometry::Facets facet_nodes(const FunctionSpace& V,
                                         contactx::mesh::Ranks& ranks,
                                         const std::string& role) const;

private:
  void check(const dolfinx::mesh::Topology& topology,
             const dolfinx::graph::AdjacencyList<std::int32_t>& cells) const;

  std::shared_ptr<const dolfinx::mesh::MeshTags<std::int32_t>> _tags;
  std::vector<std::int32_t> _values, _facets;
  std::string _name;
};
} // namespace contactx_dolfinx
