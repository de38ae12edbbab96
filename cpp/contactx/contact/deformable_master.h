// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../check.h"
#include "../mesh/halo.h"
#include "../search/inside_test.h"
#include "../search/master_surface.h"
#include "master.h"
#include "slave_nodes.h"
#include "slip_origin.h"
#include <memory>
#include <stdexcept>

namespace contactx::contact
{
/// @brief Options of the pairing of slave nodes or facets.
struct PairingOptions
{
  double reach;       ///< largest distance of a pair
  bool is_small;      ///< whether sliding is small: pairs never change
  bool measures_slip; ///< whether slip is measured
  /// Where each node is on quadratic facets, see geometry::Shares; empty where
  /// facets are linear
  std::vector<std::int8_t> level = {};
  bool is_smooth = false; ///< whether linear facets stand for smooth surfaces
};

/// @brief kernel::Pairs with the facets of a deformable body.
class DeformableMaster : public Master
{
public:
  /// @brief Take both surfaces.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] slaves Slave nodes.
  /// @param[in] surface Master surface.
  /// @param[in] outside Finds points outside of its body.
  /// @param[in] options How pairs are made.
  /// @throws std::invalid_argument if the slave facets are none of the halo's
  /// dimension, or the reach is not larger than zero.
  DeformableMaster(std::shared_ptr<mesh::Halo> halo,
                   std::shared_ptr<const SlaveNodes> slaves,
                   std::shared_ptr<search::MasterSurface> surface,
                   std::shared_ptr<search::InsideTest> outside,
                   const PairingOptions& options)
      : _halo(std::move(halo)), _slaves(std::move(slaves)),
        _surface(std::move(surface)), _outside(std::move(outside)),
        _options(options)
  {
    if (not _slaves)
      throw std::invalid_argument("slaves must not be empty");
    const geometry::FacetList facets = _slaves->facets();
    check::facets(facets.offsets, facets.nodes, _halo->gdim());
    if (not(options.reach > 0))
      throw std::invalid_argument("the reach of pairs is not larger than zero");
  }

  int gdim() const override { return _halo->gdim(); }
  double reach() const override { return _options.reach; }
  bool is_self() const override { return _surface->is_self(); }

  /// @brief True if linear facets stand for smooth surfaces.
  bool is_smooth() const { return _options.is_smooth; }

  std::vector<Saved> identity() const override
  {
    return {{"facets", RowKind::global, 4, _surface->identity()}};
  }

  /// @brief Master surface.
  const std::shared_ptr<search::MasterSurface>& surface() const
  {
    return _surface;
  }

  /// @brief Finds points outside of the master's body.
  const std::shared_ptr<search::InsideTest>& outside() const
  {
    return _outside;
  }

protected:
  /// @brief Distance of each slave node from the master in the reference
  /// configuration, the mean of X_slave - X_master.
  ///
  /// Positions are taken from that of the slave node, as kernels do, so that
  /// rounding errors do not grow with its distance from the origin.
  /// @return Shape=(n, gdim).
  std::vector<double> apart() const
  {
    const std::size_t g = gdim();
    const auto owned = _slaves->owned();
    const auto x = _halo->reference();
    return means([&](std::int32_t i, std::int32_t node, std::size_t k)
                 { return x[g * node + k] - x[g * owned[i] + k]; });
  }

  /// @brief Movement of each slave node relative to the master, the mean of
  /// u_slave - u_master.
  /// @param[in] u Displacements (shape=(num_nodes, gdim)).
  /// @return Shape=(n, gdim).
  std::vector<double> moved(std::span<const double> u) const
  {
    const std::size_t g = gdim();
    return means([&](std::int32_t, std::int32_t node, std::size_t k)
                 { return u[g * node + k]; });
  }

  /// @brief Mean of x_slave - x_master (shape=(n, gdim)).
  /// @param[in] u Displacements (shape=(num_nodes, gdim)).
  std::vector<double> separation(std::span<const double> u) const
  {
    std::vector<double> separation = apart();
    const std::vector<double> by = moved(u);
    for (std::size_t k = 0; k < separation.size(); ++k)
      separation[k] += by[k];
    return separation;
  }

  std::shared_ptr<mesh::Halo> _halo;               ///< Nodes of this rank
  std::shared_ptr<const SlaveNodes> _slaves;       ///< Slave nodes
  std::shared_ptr<search::MasterSurface> _surface; ///< Master surface
  std::shared_ptr<search::InsideTest> _outside; ///< points outside of the body
  PairingOptions _options;                      ///< How pairs are made
  SlipOrigin _origin; ///< where slip starts in small sliding

private:
  /// Weighted sums, for each slave node i, of value(i, node, k).
  template <class Value>
  std::vector<double> means(Value&& value) const
  {
    const std::size_t g = gdim();
    const kernel::Weights w = weights();
    std::vector<double> sums(_slaves->owned().size() * g, 0);
    for (std::size_t e = 0; e < w.values.size(); ++e)
      for (std::size_t k = 0; k < g; ++k)
        sums[g * w.slaves[e] + k]
            += w.values[e] * value(w.slaves[e], w.nodes[e], k);
    return sums;
  }
};
} // namespace contactx::contact
