// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/obstacle.h"
#include "../kernel/layout.h"
#include "master.h"
#include "slave_nodes.h"
#include <memory>

namespace contactx::contact
{
/// @brief kernel::Pairs of slave nodes with a rigid obstacle: slave nodes
/// alone.
///
/// The obstacle may move at any time: it is asked anew in each call. What it
/// throws comes through, on this rank alone.
class ObstacleMaster : public Master
{
public:
  /// @brief Create the pairs, none yet, from the reference configuration.
  /// @param[in] obstacle The obstacle.
  /// @param[in] slaves Slave nodes.
  /// @param[in] x Reference positions.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  /// @param[in] reach Largest distance of a pair, infinite if unlimited.
  /// @param[in] measures_slip Whether slip is measured.
  /// @throws std::invalid_argument if the arguments do not fit together, or the
  /// obstacle's parameters the dimension.
  ObstacleMaster(std::shared_ptr<geometry::Obstacle> obstacle,
                 std::shared_ptr<const SlaveNodes> slaves,
                 std::span<const double> x, int gdim, double reach,
                 bool measures_slip);

  int gdim() const override { return _gdim; }
  double reach() const override { return _reach; }
  bool is_rigid() const override { return true; }

  /// @brief The obstacle.
  const std::shared_ptr<geometry::Obstacle>& obstacle() const
  {
    return _obstacle;
  }

  /// @brief Gap of the owned slave nodes (shape=(n)).
  /// @param[in] x Positions, of which those of owned nodes count.
  std::vector<double> inside(std::span<const double> x) const;

  /// @brief True if the obstacle has moved since the step's start and nothing
  /// tells how, so that slip cannot be measured on this rank.
  /// @param[in] tolerance Gap that counts as none.
  bool has_unknown_motion(double tolerance) const;

  void accept(std::span<const double> x) override;
  void begin_step() override;

  /// @copydoc Master::turn; all of it turns as one
  std::optional<std::vector<double>>
  turn(std::span<const double> x) const override;

  /// @copydoc Master::touch; the path is relative to the obstacle as it was at
  /// the step's start
  void touch(std::span<const std::int8_t> which, std::span<const double> x,
             std::span<const double> u,
             std::span<const double> offset) override;

  /// @copydoc Master::search; there are no facets to change between
  std::int32_t search(std::span<const double> x,
                      std::span<const std::int8_t> closed) override;
  std::vector<std::int8_t> paired() const override { return _paired; }
  std::vector<kernel::Pairs> pairs() const override;

  /// @copydoc Master::update; frozen, gap and slip are linear in the
  /// displacement since the search
  std::optional<std::vector<kernel::Pairs>>
  update(std::span<const double> x, bool frozen,
         std::span<const double> offset) override;
  std::vector<double> normals() const override;
  kernel::Weights weights() const override;

  /// @copydoc Master::movement; of an obstacle that does not tell how it moves
  /// the part along its normal is known from the gaps
  std::vector<double> movement() const override;
  std::vector<double> compliance(std::span<const double> nodal) const override;
  Mobility mobility(std::span<const std::int8_t> free) const override;
  std::vector<Saved> save() const override;
  void load(const std::vector<Saved>& saved) override;
  double distance(std::span<const double> x) const override;

protected:
  /// Number of owned slave nodes.
  std::size_t size() const { return _slaves->owned().size(); }

  /// Positions of the owned slave nodes.
  std::vector<double> at_slaves(std::span<const double> x) const;

  /// Compute slip and its derivative at positions of the slave nodes, with the
  /// normals of the kernels' data.
  virtual void update_slip(std::span<const double> at,
                           std::span<const kernel::ObstaclePair> pairs);

  /// Where the obstacle has carried the points that slip is measured from.
  std::vector<double> carried() const;

  std::shared_ptr<geometry::Obstacle> _obstacle;
  std::shared_ptr<const SlaveNodes> _slaves;
  int _gdim;
  double _reach;
  bool _measures_slip;
  std::vector<std::int8_t> _paired;
  std::vector<kernel::ObstacleSlip> _slip;
  geometry::Placement _placed; ///< of the obstacle at the step's start

private:
  /// kernel::Pairs of all slave nodes from the geometry of the obstacle.
  std::vector<kernel::ObstaclePair>
  pairs_of(const geometry::Geometry& seen) const;

  std::vector<kernel::Pairs>
  group(std::span<const kernel::ObstaclePair> pairs) const;

  geometry::Geometry _seen;                 // scratch
  std::vector<kernel::ObstaclePair> _found; // by the last search
  std::vector<double> _at;
  std::vector<double> _start, _x0, _gap0, _parameters;
};
} // namespace contactx::contact
