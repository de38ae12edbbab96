// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"
#include "obstacle.h"

namespace contactx::geometry
{
/// @brief Endless circular cylinder, or if hollow all that is outside of one;
/// in three dimensions alone.
class Cylinder : public Obstacle
{
public:
  /// @brief A cylinder that must be placed before it is used.
  /// @param[in] hollow Whether bodies are inside, as in a pipe.
  explicit Cylinder(bool hollow = false) : _hollow(hollow) {}

  /// @brief Create a cylinder.
  /// @param[in] point A point of the axis (shape=(3)).
  /// @param[in] axis Direction of the axis, of any length (shape=(3)).
  /// @param[in] radius Radius.
  /// @param[in] hollow Whether bodies are inside.
  Cylinder(std::vector<double> point, std::vector<double> axis, double radius,
           bool hollow = false);

  /// @brief Move it; parameters that do not fit are refused at their next use.
  /// @param[in] point A point of the axis (shape=(3)).
  /// @param[in] axis Direction of the axis, of any length (shape=(3)).
  /// @param[in] radius Radius.
  /// @param[in] angle How far it has spun about its axis (shape=(1)); empty if
  /// it does not.
  /// @param[in] point A point of the axis (shape=(3)).
  /// @param[in] axis Direction of the axis, of any length (shape=(3)).
  /// @param[in] radius Radius.
  /// @param[in] angle How far it has spun about its axis (shape=(1)); empty if
  /// it does not.
  void place(std::vector<double> point, std::vector<double> axis, double radius,
             std::vector<double> angle = {});

  using Obstacle::evaluate;
  /// @copydoc Obstacle::evaluate; g is the distance from the axis less the
  /// radius, or its opposite for a hollow cylinder
  void evaluate(std::span<const double> x, int gdim, Geometry& at) override;
  Placement placement(int gdim) override;
  double size(int gdim) override;
  std::string name() const override { return "Cylinder"; }
  std::string usual_mistake() const override;

private:
  /// Read the parameters anew.
  void read(int gdim);

  bool _hollow;
  std::vector<double> _point, _axis, _angle;
  double _radius = 0;
};
} // namespace contactx::geometry
