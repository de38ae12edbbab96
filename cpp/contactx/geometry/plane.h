// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "obstacle.h"

namespace contactx::geometry
{
/// @brief Half-space bounded by a plane; its outward normal points to where
/// bodies may be.
class Plane : public Obstacle
{
public:
  /// @brief A plane that must be placed before it is used.
  Plane() = default;

  /// @brief Create a plane.
  /// @param[in] point A point of the plane (shape=(gdim)).
  /// @param[in] normal Outward normal of any length (shape=(gdim)).
  Plane(std::vector<double> point, std::vector<double> normal);

  /// @brief Move it; parameters that do not fit are refused at their next use.
  void place(std::vector<double> point, std::vector<double> normal);

  using Obstacle::evaluate;
  /// @copydoc Obstacle::evaluate; g = n . (x - point)
  void evaluate(std::span<const double> x, int gdim, Geometry& at) override;
  Placement placement(int gdim) override;
  bool is_flat() const override { return true; }
  std::string name() const override { return "Plane"; }
  std::string usual_mistake() const override;

private:
  std::vector<double> _point, _normal;
};
} // namespace contactx::geometry
