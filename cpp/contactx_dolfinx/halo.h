// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include "ranks.h"
#include <contactx/mesh/halo.h>
#include <dolfinx/la/Vector.h>
#include <map>

namespace contactx_dolfinx
{
/// @brief Nodes of a displacement, as a halo needs them of whoever has the
/// bulk.
class HaloAdapter final : public contactx::mesh::HaloAdapter
{
public:
  /// @brief Start with the bulk's nodes alone; all ranks must take part.
  /// @param[in] u Displacement, in a Lagrange space of degree 1 or 2.
  explicit HaloAdapter(std::shared_ptr<Function> u);

  /// @brief The nodes of the bulk; all ranks must take part.
  contactx::mesh::BulkNodes bulk_nodes();

  contactx::mesh::Ranks& ranks() override { return _ranks; }

  /// @brief Index map of all nodes, those that only contact needs last.
  const std::shared_ptr<const dolfinx::common::IndexMap>& index_map() const
  {
    return _all;
  }

  void set_ghosts(std::span<const std::int64_t> numbers,
                  std::span<const std::int32_t> owners) override;

  /// @brief Give ghosts the owners' displacements: those of the bulk and of
  /// the contact halo. All ranks must take part.
  void update_ghosts();

  void forward(std::span<double> values, int width) override;
  void forward(std::span<std::int64_t> values, int width) override;
  void reverse(std::span<double> values, int width) override;
  void displacement(std::span<double> values) const override;

private:
  template <class T>
  using Vectors = std::map<int, dolfinx::la::Vector<T>>;

  template <class T>
  dolfinx::la::Vector<T>& vector_of(int width, Vectors<T>& vectors);
  template <class T>
  void scatter_forward(std::span<T> values, int width, Vectors<T>& vectors);

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
