// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "thread_ranks.h"
#include <contactx/geometry/facets.h>
#include <contactx/mesh/halo.h>
#include <numeric>

namespace contactx::tests
{
/// @brief A mesh of which each rank has all nodes, its own first.
struct WholeMesh
{
  /// @param[in] n Number of nodes.
  /// @param[in] ranks The ranks; one alone if null.
  WholeMesh(std::int32_t n, mesh::Ranks* ranks)
      : ranks(ranks), number(n), place(n), num_owned(n)
  {
    std::iota(number.begin(), number.end(), 0);
    if (ranks)
      num_owned = static_cast<std::int32_t>(
          std::ranges::stable_partition(
              number,
              [&](std::int64_t node) { return owner(node) == ranks->rank(); })
              .begin()
          - number.begin());
    for (std::int32_t i = 0; i < n; ++i)
      place[number[i]] = i;
  }

  /// @brief Rank of a node: neighbours are on any.
  int owner(std::int64_t node) const
  {
    return ranks ? static_cast<int>(node * 7 % 11) % ranks->size() : 0;
  }

  /// @brief Whether a node is this rank's.
  bool owns(std::int32_t node) const { return place[node] < num_owned; }

  /// @brief Values of the nodes in the order of this rank.
  template <class T>
  std::vector<T> here(const std::vector<T>& values, int width) const
  {
    std::vector<T> result;
    for (const std::int64_t node : number)
      result.insert(result.end(), values.begin() + node * width,
                    values.begin() + (node + 1) * width);
    return result;
  }

  /// @brief Facets by the nodes of this rank.
  /// @param[in] facets Facets of the mesh.
  /// @param[in] around Whether those are taken that have a node of this rank,
  /// else those whose first node is.
  geometry::Facets here(const geometry::Facets& facets, bool around) const
  {
    geometry::Facets result;
    for (std::int32_t f = 0; f < facets.list().size(); ++f)
    {
      const auto nodes = facets.list()[f];
      if (std::ranges::any_of(nodes.first(around ? nodes.size() : 1),
                              [&](std::int32_t node) { return owns(node); }))
      {
        for (const std::int32_t node : nodes)
          result.nodes.push_back(place[node]);
        result.offsets.push_back(
            static_cast<std::int32_t>(result.nodes.size()));
      }
    }
    return result;
  }

  /// @brief The nodes with their positions.
  /// @param[in] x Positions (shape=(n, gdim)).
  /// @param[in] gdim Geometric dimension.
  /// @param[in] u Displacements in the order of this rank.
  std::shared_ptr<mesh::Halo>
  halo(const std::vector<double>& x, int gdim,
       std::shared_ptr<const std::vector<double>> u) const;

  mesh::Ranks* ranks;
  std::vector<std::int64_t> number; ///< in the mesh, of each node here
  std::vector<std::int32_t> place;  ///< here, of each node of the mesh
  std::int32_t num_owned;
};

/// @brief The bulk of a rank that has all nodes.
class WholeBulk final : public mesh::HaloAdapter
{
public:
  WholeBulk(const WholeMesh& mesh,
            std::shared_ptr<const std::vector<double>> displacement)
      : _map(*mesh.ranks, mesh.number, mesh.num_owned),
        _displacement(std::move(displacement))
  {
  }

  mesh::Ranks& ranks() override { return _map.ranks(); }
  void set_ghosts(std::span<const std::int64_t> numbers,
                  std::span<const std::int32_t>) override
  {
    if (not numbers.empty())
      throw std::logic_error("all nodes are here");
  }
  void forward(std::span<double> values, int width) override
  {
    _map.forward(values, width);
  }
  void forward(std::span<std::int64_t> values, int width) override
  {
    _map.forward(values, width);
  }
  void reverse(std::span<double> values, int width) override
  {
    _map.reverse(values, width);
  }
  void displacement(std::span<double> values) const override
  {
    std::ranges::copy(*_displacement, values.begin());
  }

private:
  NumberedNodes _map;
  std::shared_ptr<const std::vector<double>> _displacement;
};

inline std::shared_ptr<mesh::Halo>
WholeMesh::halo(const std::vector<double>& x, int gdim,
                std::shared_ptr<const std::vector<double>> u) const
{
  if (not ranks)
    return mesh::serial_halo(x, gdim, std::move(u));
  mesh::BulkNodes bulk{gdim, num_owned, number, {}, number, here(x, gdim)};
  for (const std::int64_t node : number)
    bulk.owners.push_back(owner(node));
  return std::make_shared<mesh::Halo>(
      std::move(bulk), std::make_unique<WholeBulk>(*this, std::move(u)));
}
} // namespace contactx::tests
