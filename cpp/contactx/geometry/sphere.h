// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "obstacle.h"

namespace contactx::geometry
{
/// @brief Ball, or if hollow all that is outside of one; in 2D a disc.
class Sphere : public Obstacle
{
public:
  /// @brief A sphere that must be placed before it is used.
  /// @param[in] hollow Whether bodies are inside, as in a bowl.
  explicit Sphere(bool hollow = false) : _hollow(hollow) {}

  /// @brief Create a sphere.
  /// @param[in] centre Centre (shape=(gdim)).
  /// @param[in] radius Radius.
  /// @param[in] hollow Whether bodies are inside.
  Sphere(std::vector<double> centre, double radius, bool hollow = false);

  /// @brief Move it; parameters that do not fit are refused at their next use.
  /// @param[in] centre Centre (shape=(gdim)).
  /// @param[in] radius Radius.
  /// @param[in] angle How far it has spun, see Placement; empty if it does not.
  void place(std::vector<double> centre, double radius,
             std::vector<double> angle = {});

  using Obstacle::evaluate;
  /// @copydoc Obstacle::evaluate; g = |x - centre| - radius, or its opposite
  /// for a hollow sphere
  void evaluate(std::span<const double> x, int gdim, Geometry& at) override;
  Placement placement(int gdim) override;
  double size(int gdim) override;
  std::string name() const override { return "Sphere"; }
  std::string usual_mistake() const override;

private:
  bool _hollow;
  std::vector<double> _centre, _angle;
  double _radius = 0;
};
} // namespace contactx::geometry
