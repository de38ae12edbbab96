// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "halo.h"
#include "cells.h"
#include <algorithm>
#include <functional>

namespace contactx_dolfinx
{
// Of the messages in which index maps find out who has their ghosts
constexpr int halo_tag = 7090;

HaloAdapter::HaloAdapter(std::shared_ptr<Function> u)
    : _u(std::move(u)), _map(_u->function_space()->dofmap()->index_map),
      _gdim(_u->function_space()->mesh()->geometry().dim()),
      _ranks(_map->comm())
{
  set_ghosts({}, {});
}

contactx::mesh::BulkNodes HaloAdapter::bulk_nodes()
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

void HaloAdapter::set_ghosts(std::span<const std::int64_t> numbers,
                             std::span<const std::int32_t> owners)
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
        _map->comm(), _map->size_local(), ghosts, from, halo_tag);
  }
  _displacement.resize(std::size_t(_gdim)
                       * (_all->size_local() + _all->num_ghosts()));
  update_ghosts();
}

void HaloAdapter::update_ghosts()
{
  auto& u = _u->x()->array();
  const std::size_t owned = std::size_t(_gdim) * _map->size_local();
  std::copy_n(u.begin(), owned, _displacement.begin());
  forward(std::span<double>(_displacement), _gdim);
  std::copy_n(_displacement.begin(), u.size(), u.begin());
}

void HaloAdapter::forward(std::span<double> values, int width)
{
  scatter_forward(values, width, _doubles);
}

void HaloAdapter::forward(std::span<std::int64_t> values, int width)
{
  scatter_forward(values, width, _integers);
}

void HaloAdapter::reverse(std::span<double> values, int width)
{
  if (_ranks.size() == 1)
    return;
  auto& vector = vector_of(width, _doubles);
  std::ranges::copy(values, vector.array().begin());
  vector.scatter_rev(std::plus<double>());
  std::copy_n(vector.array().begin(), std::size_t(width) * _map->size_local(),
              values.begin());
}

void HaloAdapter::displacement(std::span<double> values) const
{
  std::ranges::copy(_displacement, values.begin());
}

template <class T>
dolfinx::la::Vector<T>& HaloAdapter::vector_of(int width, Vectors<T>& vectors)
{
  return vectors.try_emplace(width, _all, width).first->second;
}

template <class T>
void HaloAdapter::scatter_forward(std::span<T> values, int width,
                                  Vectors<T>& vectors)
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
} // namespace contactx_dolfinx
