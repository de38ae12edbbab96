// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/facets.h"
#include "../mesh/halo.h"
#include "records.h"

namespace contactx::search
{
/// @brief All facets of a surface on every rank, in the order of their keys, so
/// that all ranks find the same on any number of them.
///
/// Its nodes have numbers of their own, in the order of those in the mesh as it
/// was made. n is the number of nodes.
class WholeSurface
{
public:
  /// @brief Gather the facets; all ranks must take part.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] own Facets of this rank's cells, each on one rank alone.
  WholeSurface(std::shared_ptr<const mesh::Halo> halo,
               const geometry::FacetList& own);

  /// @brief Facets, with the surface's own numbers of nodes.
  geometry::FacetList facets() const { return _facets.list(); }

  /// @brief The facets by node numbers that all ranks know.
  const FacetRecords& records() const { return _records; }

  /// @brief Number of nodes.
  std::int32_t num_nodes() const
  {
    return static_cast<std::int32_t>(_original.size());
  }

  /// @brief Numbers of the nodes in the mesh as it was made, ascending
  /// (shape=(n)).
  const std::vector<std::int64_t>& original() const { return _original; }

  /// @brief Nodes that this rank owns.
  const std::vector<std::int32_t>& owned() const { return _owned; }

  /// @brief The owned nodes by their numbers on this rank.
  const std::vector<std::int32_t>& owned_here() const { return _owned_here; }

  /// @brief Node by its number on this rank, -1 where it is none of the
  /// surface.
  std::int32_t node(std::int32_t here) const;

  /// @brief Values of all nodes of the surface; all ranks must take part.
  /// @param[in] values Values of this rank's nodes, of which those that it owns
  /// count (shape=(at least num_owned, width)), row-major.
  /// @param[in] width Values a node.
  /// @return Values (shape=(n, width)).
  template <class T>
  std::vector<T> gathered(std::span<const T> values, int width) const
  {
    const auto w = static_cast<std::size_t>(width);
    std::vector<T> mine;
    mine.reserve(_owned_here.size() * w);
    for (const std::int32_t node : _owned_here)
    {
      const auto row = values.subspan(std::size_t(node) * w, w);
      mine.insert(mine.end(), row.begin(), row.end());
    }
    const auto every
        = mesh::gathered<T>(_halo->ranks(), std::span<const T>(mine));
    std::vector<T> all(_original.size() * w);
    for (std::size_t i = 0; i < _of_ranks.size(); ++i)
      std::copy_n(every.begin() + static_cast<std::ptrdiff_t>(i * w), w,
                  all.begin() + static_cast<std::ptrdiff_t>(_of_ranks[i] * w));
    return all;
  }

private:
  std::shared_ptr<const mesh::Halo> _halo;
  FacetRecords _records;
  geometry::Facets _facets;
  std::vector<std::int64_t> _original;
  std::vector<std::int32_t> _owned, _owned_here;
  std::vector<std::size_t> _of_ranks; // owned nodes of one rank after the other
};
} // namespace contactx::search
