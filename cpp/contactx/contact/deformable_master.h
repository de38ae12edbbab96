// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../check.h"
#include "../parallel/halo.h"
#include "../search/master_surface.h"
#include "../search/outside.h"
#include "master.h"
#include "slave_nodes.h"
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
  /// Where each node is on quadratic facets, see facet::Shares; empty where
  /// facets are linear
  std::vector<std::int8_t> level = {};
};

/// @brief Pairs with the facets of a deformable body.
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
  DeformableMaster(std::shared_ptr<parallel::Halo> halo,
                   std::shared_ptr<const SlaveNodes> slaves,
                   std::shared_ptr<search::MasterSurface> surface,
                   std::shared_ptr<search::Outside> outside,
                   const PairingOptions& options)
      : _halo(std::move(halo)), _slaves(std::move(slaves)),
        _surface(std::move(surface)), _outside(std::move(outside)),
        _options(options)
  {
    if (not _slaves)
      throw std::invalid_argument("slaves must not be empty");
    const facet::FacetList facets = _slaves->facets();
    check::facets(facets.offsets, facets.nodes, _halo->gdim());
    if (not(options.reach > 0))
      throw std::invalid_argument("the reach of pairs is not larger than zero");
  }

  int gdim() const override { return _halo->gdim(); }
  double reach() const override { return _options.reach; }
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
  const std::shared_ptr<search::Outside>& outside() const { return _outside; }

protected:
  std::shared_ptr<parallel::Halo> _halo;           ///< Nodes of this rank
  std::shared_ptr<const SlaveNodes> _slaves;       ///< Slave nodes
  std::shared_ptr<search::MasterSurface> _surface; ///< Master surface
  std::shared_ptr<search::Outside> _outside; ///< points outside of the body
  PairingOptions _options;                   ///< How pairs are made
};
} // namespace contactx::contact
