// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "obstacle.h"
#include <functional>
#include <optional>

namespace contactx::geometry
{
/// @brief A function of the position at n points, or several, one for each face
/// of a body with ridges: the largest of them counts.
struct LevelValues
{
  std::vector<double> value;    ///< (shape=(faces, n))
  std::vector<double> gradient; ///< (shape=(faces, n, gdim))
  /// Second derivatives (shape=(faces, n, gdim, gdim)); empty where the
  /// function has none, and differences of the gradient serve
  std::vector<double> hessian;
};

/// @brief Body where a function is negative; bodies may be where it is
/// positive.
///
/// The function need not be a distance: its zero is the surface, and g = f /
/// |grad f| is the distance to first order. A function that changes tells of no
/// movement along its surface: for friction its material is at rest, unless it
/// has a velocity.
///
/// Where the body is what several faces have in common, a point beyond a ridge
/// or an apex is projected on its nearest point, along the vector from that; on
/// it the normal is the axis of the cone of normals.
class LevelSet : public Obstacle
{
public:
  /// @brief Evaluates the function at points (shape=(n, gdim)), n > 0, up to
  /// the derivatives of some order, 0 to 2.
  using Function = std::function<LevelValues(std::span<const double> x,
                                             int gdim, int order)>;

  /// @brief Current values of what changes the function, as many on each rank.
  using Parameters = std::function<std::vector<double>(int gdim)>;

  /// @brief Velocity of its material.
  struct Velocity
  {
    /// Evaluates it at points (shape=(n, gdim)), n > 0
    std::function<std::vector<double>(std::span<const double> x, int gdim)>
        values;
    /// The time now: between two times the material goes with the velocity
    std::function<double()> time;
  };

  /// @brief Create an obstacle.
  /// @param[in] f The function; its errors are passed on.
  /// @param[in] parameters Tells whether the function has changed.
  /// @param[in] velocity Tells how its material moves.
  explicit LevelSet(Function f, Parameters parameters = {},
                    std::optional<Velocity> velocity = std::nullopt);

  using Obstacle::evaluate;
  /// @copydoc Obstacle::evaluate
  /// @throws check::Undefined if the function or its gradient is not
  /// finite or its gradient zero at a point.
  void evaluate(std::span<const double> x, int gdim, Geometry& at) override;
  /// @copydoc Obstacle::placement
  /// @throws std::invalid_argument if the time is not finite.
  Placement placement(int gdim) override;

  /// @copydoc Obstacle::carry
  /// @throws std::invalid_argument if the velocity is not finite at a point.
  std::vector<double> carry(std::span<const double> x, const Placement& from,
                            const Placement& to) override;

  /// @copydoc Obstacle::distance; points between slave nodes may be where the
  /// function means nothing
  std::vector<double> distance(std::span<const double> x, int gdim) override;
  std::vector<double> normals(std::span<const double> x, int gdim) override;

  /// @copydoc Obstacle::level; the function itself
  std::vector<double> level(std::span<const double> x, int gdim) override;

  bool knows_its_motion() const override { return _velocity.has_value(); }
  std::vector<double> parameters(int gdim) override;
  std::string name() const override { return "LevelSet"; }
  std::string usual_mistake() const override;

private:
  std::vector<double> velocity(std::span<const double> x, int gdim) const;
  LevelValues values(std::span<const double> x, int gdim, int order) const;
  double scene_size(std::span<const double> x, int gdim) const;

  /// Distance from a ridge within which a point is on it: a facet that it cuts
  /// there is on both of its sides.
  double ridge_width(std::span<const double> x, int gdim) const;

  /// Central differences of the gradient, symmetric. They only serve the
  /// tangent: the solution does not depend on them.
  std::vector<double> differences(std::span<const double> x, int gdim) const;

  Function _f;
  Parameters _parameters;
  std::optional<Velocity> _velocity;
};
} // namespace contactx::geometry
