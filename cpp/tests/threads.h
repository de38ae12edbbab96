// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "scene.h"
#include "thread_ranks.h"
#include <contactx/geometry/facets.h>
#include <contactx/mesh/halo.h>

namespace contactx::tests
{
/// @brief Nodes of a mesh that are distributed, each with an owner.
struct Distribution
{
  int num_ranks;
  std::vector<int> owner;             ///< of each node
  std::vector<std::int64_t> number;   ///< that all ranks know
  std::vector<std::int64_t> original; ///< in the mesh as it was made
  std::vector<std::int32_t> place;    ///< among those of its owner

  /// @brief Give nodes to ranks; the order in which the mesh was made is
  /// random.
  Distribution(std::vector<int> owners, int num_ranks, Generator& random)
      : num_ranks(num_ranks), owner(std::move(owners)), number(owner.size()),
        original(owner.size()), place(owner.size())
  {
    std::int64_t count = 0;
    std::vector<std::int32_t> owned(num_ranks, 0);
    for (int r = 0; r < num_ranks; ++r)
      for (std::size_t i = 0; i < owner.size(); ++i)
        if (owner[i] == r)
        {
          number[i] = count++;
          place[i] = owned[r]++;
        }
    original = numbered<std::int64_t>(owner.size());
    for (std::size_t i = original.size(); i-- > 1;)
      std::swap(original[i], original[static_cast<std::size_t>(
                                 random(0, static_cast<double>(i)))]);
  }
};

/// @brief The bulk of a rank whose nodes are distributed.
class ThreadBulk final : public NumberedBulk
{
public:
  /// @brief Take the rank's own nodes and ghosts; displacements are those of
  /// all nodes of the mesh.
  ThreadBulk(const Distribution& nodes, ThreadRanks& ranks,
             const std::vector<std::int32_t>& ghosts,
             std::vector<double> displacement, int gdim)
      : NumberedBulk(ranks, {}, 0), _nodes(nodes), _gdim(gdim),
        _displacement(std::move(displacement))
  {
    for (std::size_t i = 0; i < nodes.owner.size(); ++i)
      if (nodes.owner[i] == ranks.rank())
        _here.push_back(static_cast<std::int32_t>(i));
    _num_owned = static_cast<std::int32_t>(_here.size());
    _here.insert(_here.end(), ghosts.begin(), ghosts.end());
    _num_bulk = _here.size();
    std::vector<std::int64_t> numbers;
    for (const std::int32_t node : _here)
      numbers.push_back(nodes.number[node]);
    _map = NumberedNodes(ranks, std::move(numbers), _num_owned);
  }

  /// @brief What the halo is made of, from positions of all nodes of the mesh.
  mesh::BulkNodes bulk(std::span<const double> x) const
  {
    mesh::BulkNodes result{_gdim, _num_owned, {}, {}, {}, {}};
    for (const std::int32_t node : _here)
    {
      const bool is_ghost = _nodes.owner[node] != _map.ranks().rank();
      result.numbers.push_back(_nodes.number[node]);
      result.owners.push_back(_nodes.owner[node]);
      // What a rank need not know of its ghosts it asks their owners for
      result.original.push_back(is_ghost ? -1 : _nodes.original[node]);
      for (int k = 0; k < _gdim; ++k)
        result.reference.push_back(is_ghost ? 1e300 : x[node * _gdim + k]);
    }
    return result;
  }

  void set_ghosts(std::span<const std::int64_t> numbers,
                  std::span<const std::int32_t> owners) override
  {
    _here.resize(_num_bulk);
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      const auto at = std::ranges::find(_nodes.number, numbers[i]);
      const auto node = static_cast<std::int32_t>(at - _nodes.number.begin());
      if (at == _nodes.number.end() or _nodes.owner[node] != owners[i])
        throw std::logic_error("a ghost of another owner");
      _here.push_back(node);
    }
    _map.set_ghosts(_num_bulk, numbers);
  }

  void displacement(std::span<double> values) const override
  {
    for (std::size_t i = 0; i < _here.size(); ++i)
      std::copy_n(&_displacement[_here[i] * _gdim], _gdim, &values[i * _gdim]);
  }

private:
  const Distribution& _nodes;
  int _gdim;
  std::vector<double> _displacement;
  std::int32_t _num_owned;
  std::size_t _num_bulk;
  std::vector<std::int32_t> _here; // nodes of the mesh by their number here
};

/// @brief Nodes of a rank; positions and displacements are those of all nodes
/// of the mesh, ghosts may be there several times.
inline std::shared_ptr<mesh::Halo>
thread_halo(const Distribution& nodes, ThreadRanks& ranks,
            std::span<const std::int32_t> ghosts, std::span<const double> x,
            std::vector<double> displacement, int gdim)
{
  auto bulk = std::make_unique<ThreadBulk>(nodes, ranks,
                                           search::sorted_unique(ghosts),
                                           std::move(displacement), gdim);
  auto given = bulk->bulk(x);
  return std::make_shared<mesh::Halo>(std::move(given), std::move(bulk));
}

/// @brief Facets of which each rank has some, and the nodes they need.
class DistributedScene
{
public:
  /// @brief Distribute nodes and facets: anywhere if they are scattered, else
  /// in pieces along the first axis.
  DistributedScene(const Scene& scene, int num_ranks, unsigned seed,
                   bool scattered)
      : scene(scene), _random(seed),
        // The same mesh on any number of ranks
        nodes(owners(num_ranks, scattered), num_ranks, _random)
  {
    Generator random(seed + 1);
    for (std::int32_t f = 0; f < scene.facets().size(); ++f)
    {
      const auto facet = scene.facets()[f];
      facet_rank.push_back(
          scattered ? static_cast<int>(random(0, num_ranks))
                    : nodes.owner[facet[static_cast<std::size_t>(
                          random(0, static_cast<double>(facet.size())))]]);
    }
  }

  /// @brief Nodes of a rank, its facets' among them; they have the displacement
  /// of all nodes of the mesh, or none.
  std::shared_ptr<mesh::Halo> halo(ThreadRanks& ranks,
                                   std::vector<double> displacement = {}) const
  {
    displacement.resize(scene.x.size());
    std::vector<std::int32_t> ghosts;
    for (std::int32_t f = 0; f < scene.facets().size(); ++f)
      if (facet_rank[f] == ranks.rank())
        for (const std::int32_t node : scene.facets()[f])
          if (nodes.owner[node] != ranks.rank())
            ghosts.push_back(node);
    return thread_halo(nodes, ranks, ghosts, scene.x, std::move(displacement),
                       scene.gdim);
  }

  /// @brief Facets of a rank, of those from one to another one.
  geometry::Facets own(const mesh::Halo& halo, std::int32_t begin,
                       std::int32_t end) const
  {
    geometry::Facets result;
    for (std::int32_t f = begin; f < end; ++f)
      if (facet_rank[f] == halo.ranks().rank())
        add_facet(
            result, scene.facets()[f], [&](std::int32_t node)
            { return halo.find(std::vector{nodes.number[node]}).front(); });
    return result;
  }

  /// @brief Nodes of the mesh by their numbers on a rank.
  std::vector<std::int32_t>
  mesh_nodes(const mesh::Halo& halo, std::span<const std::int32_t> which) const
  {
    std::vector<std::int32_t> result;
    for (const std::int64_t number : halo.numbers(which))
      result.push_back(static_cast<std::int32_t>(
          std::ranges::find(nodes.number, number) - nodes.number.begin()));
    return result;
  }

  const Scene& scene;

private:
  std::vector<int> owners(int num_ranks, bool scattered)
  {
    Generator random(7);
    std::vector<double> along;
    for (std::size_t i = 0; i < scene.x.size(); i += scene.gdim)
      along.push_back(scene.x[i]);
    std::vector<double> sorted = along;
    std::ranges::sort(sorted);
    std::vector<int> result;
    for (const double a : along)
    {
      const auto at = std::ranges::lower_bound(sorted, a) - sorted.begin();
      result.push_back(
          scattered ? static_cast<int>(random(0, num_ranks))
                    : static_cast<int>(at * num_ranks / std::ssize(sorted)));
    }
    return result;
  }

  Generator _random;

public:
  Distribution nodes;
  std::vector<int> facet_rank; ///< of each facet
};
} // namespace contactx::tests
