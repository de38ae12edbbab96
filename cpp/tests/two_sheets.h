// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "facing.h"
#include <contactx/contact/node_to_surface.h>
#include <contactx/contact/surface_to_surface.h>

namespace contactx::tests
{
/// @brief A slave sheet that looks down on a master sheet that looks up.
struct TwoSheets
{
  int gdim;
  std::vector<double> x;
  geometry::Facets slave, master;
  std::int32_t num_slaves; ///< the slave's nodes come first

  /// @brief Create a slave over [0, high]^2 at a height over the master, which
  /// is over [-1, 2]^2 at zero.
  explicit TwoSheets(int dim, double height = 0, Cells cells = Cells::mixed,
                     double high = 1)
      : gdim(dim)
  {
    const Scene up = sheet(dim, 5, cells, true, -1, 2, level(dim, 0));
    const Scene down = sheet(dim, 3, cells, false, 0, high, level(dim, height));
    x = down.x;
    x.insert(x.end(), up.x.begin(), up.x.end());
    num_slaves = static_cast<std::int32_t>(down.x.size()) / dim;
    slave = {down.offsets, down.nodes};
    master = {up.offsets, up.nodes};
    for (std::int32_t& node : master.nodes)
      node += num_slaves;
  }

  /// @brief Number of all nodes.
  std::int32_t num_nodes() const
  {
    return static_cast<std::int32_t>(x.size()) / gdim;
  }

  /// @brief Status of slave nodes that are all open.
  std::vector<std::int8_t> open() const
  {
    return std::vector<std::int8_t>(num_slaves, 0);
  }

  /// @brief Positions after each node p has gone to way(p, is_slave).
  template <class Way>
  std::vector<double> moved(Way way) const
  {
    std::vector<double> y = x;
    for (std::int32_t i = 0; i < num_nodes(); ++i)
      std::copy_n(way(vector_at(x, i, gdim), i < num_slaves).begin(), gdim,
                  &y[gdim * i]);
    return y;
  }

  /// @brief Positions after the slave has gone along the first axis.
  std::vector<double> aside(double by) const
  {
    return moved(
        [by](Vector<3> p, bool is_slave)
        {
          p[0] += is_slave ? by : 0.0;
          return p;
        });
  }

  /// @brief Displacements that lead to some positions.
  std::vector<double> moved_by(const std::vector<double>& y) const
  {
    std::vector<double> u(x.size());
    std::ranges::transform(y, x, u.begin(), std::minus());
    return u;
  }

  std::shared_ptr<mesh::Halo> halo; ///< that of the last pairs

  /// @brief Pairs of these surfaces, searched for.
  /// @brief Pairs of these surfaces, searched for.
  template <class M>
  std::shared_ptr<M> pairs(bool is_small = false, bool measures_slip = true)
  {
    halo = mesh::serial_halo(x, gdim);
    auto made = pairs_of<M>(halo, {1.0, is_small, measures_slip});
    made->search(x, open());
    made->begin_step();
    return made;
  }

  /// @brief The same on other nodes, not searched for.
  template <class M>
  std::shared_ptr<M> pairs_of(std::shared_ptr<mesh::Halo> nodes,
                              contact::PairingOptions options) const
  {
    return std::make_shared<M>(
        nodes,
        std::make_shared<contact::SlaveNodes>(nodes, slave.list(),
                                              slave.list()),
        search::make_master_surface(nodes, master.offsets, master.nodes),
        std::make_shared<search::InsideTest>(nodes, master.offsets,
                                             master.nodes),
        options);
  }

  /// @brief Turned about the origin, in the plane of the first and last axis.
  std::vector<double> turned(double angle) const
  {
    const double c = std::cos(angle), s = std::sin(angle);
    const int z = gdim - 1;
    return moved(
        [c, s, z](Vector<3> p, bool)
        {
          const double a = p[0], b = p[z];
          p[0] = c * a - s * b;
          p[z] = s * a + c * b;
          return p;
        });
  }
};
} // namespace contactx::tests
