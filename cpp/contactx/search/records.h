// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/facets.h"
#include "../geometry/quadratic_facets.h"
#include "../mesh/halo.h"
#include <array>
#include <limits>
#include <map>

namespace contactx::search
{
/// @brief Most nodes of a facet.
inline constexpr int most_nodes = 4;

/// @brief Numbers of a facet's nodes in the mesh as it was made, ascending:
/// what tells facets apart, and orders them alike on any number of ranks.
using FacetKey = std::array<std::int64_t, most_nodes>;

/// @brief A facet by numbers that mean the same on all ranks.
struct FacetRecord
{
  /// Where a facet has fewer nodes
  static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();

  std::array<std::int64_t, most_nodes> numbers;  ///< of its nodes, in order
  std::array<std::int64_t, most_nodes> original; ///< in the mesh as it was made
  std::array<std::int32_t, most_nodes> owners;   ///< ranks that own the nodes

  /// @brief Number of nodes; zero of what stands for no facet.
  int size() const;

  /// @brief Key that identifies the facet.
  FacetKey key() const;

  /// @brief No facet.
  static FacetRecord nothing();
};

/// @brief Key of a facet by its name: the numbers of its nodes in the mesh as
/// it was made, -1 where there is none. No facet has the key whose first number
/// is FacetRecord::none.
FacetKey key_of(std::span<const std::int64_t> name);

/// @brief Facets, some of which may be of other ranks.
using FacetRecords = std::vector<FacetRecord>;

/// @brief Records of facets whose nodes are on this rank.
FacetRecords records(const geometry::FacetList& facets, const mesh::Halo& halo);

/// @brief Each facet once, in the order of their keys; of the same ones the
/// first.
FacetRecords joined(FacetRecords facets);

/// @brief Add the facets' nodes to the halo; all ranks must take part.
/// @param[in,out] halo Nodes of this rank.
/// @param[in] facets Facets.
/// @param[in] for_good Whether they stay when the halo shrinks.
void add_to(mesh::Halo& halo, const FacetRecords& facets,
            bool for_good = false);

/// @brief Facets with the numbers of this rank, whose halo must have their
/// nodes.
geometry::Facets here(const FacetRecords& facets, const mesh::Halo& halo);

/// @brief Facets at the nodes that this rank owns, by the rank that has them;
/// all ranks must take part.
/// @param[in] ranks The ranks.
/// @param[in] facets Facets that this rank has.
/// @param[in] parents What these are parts of, which count as one; null if each
/// is one.
std::map<int, FacetRecords>
around_nodes(mesh::Ranks& ranks, const FacetRecords& facets,
             const geometry::QuadraticFacets* parents = nullptr);

/// @brief Facets that share a node with those of this rank, which are among
/// them, each once and in the order of their keys; all ranks must take part.
/// @param[in] ranks The ranks.
/// @param[in] facets Facets that this rank has.
FacetRecords around_facets(mesh::Ranks& ranks, const FacetRecords& facets);
} // namespace contactx::search
