// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "obstacle_pairs.h"

namespace contactx::contact
{
/// @brief Slave nodes tied to a rigid obstacle: they move with it, from where
/// both were when the tie was made.
class ObstacleTie final : public ObstacleMaster
{
public:
  /// @brief Create the pairs, none yet; the arguments are those of
  /// ObstacleMaster.
  ObstacleTie(std::shared_ptr<geometry::Obstacle> obstacle,
              std::shared_ptr<const SlaveNodes> slaves,
              std::span<const double> x, int gdim, double reach);

  /// @copydoc Master::search; only the first search counts
  std::int32_t search(std::span<const double> x,
                      std::span<const std::int8_t> closed) override;

  /// @copydoc Master::update; the offset makes the tie longer
  std::optional<std::vector<kernel::Pairs>>
  update(std::span<const double> x, bool frozen,
         std::span<const double> offset) override;

  void accept(std::span<const double> x) override;
  std::vector<Saved> save() const override;
  void load(const std::vector<Saved>& saved) override;

private:
  /// The whole displacement from the place that the obstacle has carried the
  /// node to.
  void update_slip(std::span<const double> at,
                   std::span<const kernel::ObstaclePair> pairs) override;

  bool _found = false;
  // Where the obstacle has carried the nodes' places to by the last accepted
  // step, and the outward normals there
  std::vector<double> _place, _normal, _offset;
};
} // namespace contactx::contact
