// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "cells.h"
#include "ranks.h"
#include <contactx/mesh/halo.h>
#include <dolfinx/fem/Function.h>
#include <dolfinx/fem/FunctionSpace.h>
#include <dolfinx/la/Vector.h>
#include <dolfinx/mesh/Mesh.h>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <vector>

namespace contactx_dolfinx
{
/// @brief Nodes of a displacement, as a halo needs them of whoever has the
/// bulk.
class HaloAdapter final : public contactx::mesh::HaloAdapter
{
public:
  /// @brief Start with the bulk's nodes alone; all ranks must take part.
  /// @param[in] u Displacement, in a Lagrange space of degree 1 or 2.
  explicit HaloAdapter(std::shared_ptr<Function> u)
      : _u(std::move(u)), _map(_u->function_space()->dofmap()->index_map),
        _gdim(_u->function_space()->mesh()->geometry().dim()),
        _ranks(_map->comm())
  {
    set_ghosts({}, {});
  }

  /// @brief The nodes of the bulk; all ranks must take part.
  contactx::mesh::BulkNodes bulk_nodes()
  {
    const FunctionSpace& V = *_u->function_space();
    contactx::mesh::BulkNodes nodes{.gdim = _gdim,
                                    .num_owned = _map->size_local(),
                                    .numbers = _map->global_indices(),
                                    .owners = {},
                                    .original = original_nodes(V, _ranks),
                                    .reference = reference_positions(V)};
    nodes.owners.assign(_map->size_local(), _ranks.rank());
    nodes.owners.insert(nodes.owners.end(), _map->owners().begin(),
                        _map->owners().end());
    return nodes;
  }

  contactx::mesh::Ranks& ranks() override { return _ranks; }

  /// @brief Index map of all nodes, those that only contact needs last.
  const std::shared_ptr<const dolfinx::common::IndexMap>& index_map() const
  {
    return _all;
  }

  void set_ghosts(std::span<const std::int64_t> numbers,
                  std::span<const std::int32_t> owners) override
  {
    _doubles.clear();
    _integers.clear();
    _all = _map;
    if (_ranks.size() > 1)
    {
      std::vector<std::int64_t> ghosts(_map->ghosts().begin(),
                                       _map->ghosts().end());
      ghosts.insert(ghosts.end(), numbers.begin(), numbers.end());
      std::vector<int> from(_map->owners().begin(), _map->owners().end());
      from.insert(from.end(), owners.begin(), owners.end());
      _all = std::make_shared<const dolfinx::common::IndexMap>(
          _map->comm(), _map->size_local(), ghosts, from, _tag);
    }
    _displacement.resize(std::size_t(_gdim)
                         * (_all->size_local() + _all->num_ghosts()));
    update_ghosts();
  }

  /// @brief Give ghosts the owners' displacements: those of the bulk and of
  /// the contact halo. All ranks must take part.
  void update_ghosts()
  {
    auto& u = _u->x()->array();
    const std::size_t owned = std::size_t(_gdim) * _map->size_local();
    std::copy_n(u.begin(), owned, _displacement.begin());
    forward(std::span<double>(_displacement), _gdim);
    std::copy_n(_displacement.begin(), u.size(), u.begin());
  }

  void forward(std::span<double> values, int width) override
  {
    scatter_forward(values, width, _doubles);
  }

  void forward(std::span<std::int64_t> values, int width) override
  {
    scatter_forward(values, width, _integers);
  }

  void reverse(std::span<double> values, int width) override
  {
    if (_ranks.size() == 1)
      return;
    auto& vector = vector_of(width, _doubles);
    std::ranges::copy(values, vector.array().begin());
    vector.scatter_rev(std::plus<double>());
    std::copy_n(vector.array().begin(), std::size_t(width) * _map->size_local(),
                values.begin());
  }

  void displacement(std::span<double> values) const override
  {
    std::ranges::copy(_displacement, values.begin());
  }

private:
  // Of the messages in which index maps find out who has their ghosts
  static constexpr int _tag = 7090;

  template <class T>
  using Vectors = std::map<int, dolfinx::la::Vector<T>>;

  template <class T>
  dolfinx::la::Vector<T>& vector_of(int width, Vectors<T>& vectors)
  {
    return vectors.try_emplace(width, _all, width).first->second;
  }

  template <class T>
  void scatter_forward(std::span<T> values, int width, Vectors<T>& vectors)
  {
    if (_ranks.size() == 1)
      return;
    auto& vector = vector_of(width, vectors);
    const std::size_t owned = std::size_t(width) * _map->size_local();
    std::copy_n(values.begin(), owned, vector.array().begin());
    vector.scatter_fwd();
    std::copy(vector.array().begin() + owned, vector.array().end(),
              values.begin() + owned);
  }

  std::shared_ptr<Function> _u;
  std::shared_ptr<const dolfinx::common::IndexMap> _map, _all;
  int _gdim;
  Ranks _ranks;
  Vectors<double> _doubles;
  Vectors<std::int64_t> _integers;
  // Of all nodes, as of the last update
  std::vector<double> _displacement;
};
} // namespace contactx_dolfinx
