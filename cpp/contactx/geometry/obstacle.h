// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

/// @brief Rigid bodies that deformable ones come into contact with.
namespace contactx::geometry
{
/// @brief An obstacle seen from n points; arrays are row-major.
struct Geometry
{
  /// Signed distance, or what is one to first order: positive outside
  /// (shape=(n))
  std::vector<double> gap;
  std::vector<double> gradient; ///< of the gap (shape=(n, gdim))
  std::vector<double> normal;   ///< outward, of unit length (shape=(n, gdim))
  /// Derivative of the normal by the position (shape=(n, gdim, gdim))
  std::vector<double> curvature;

  /// @brief Make room for values at `n` points.
  void resize(std::size_t n, int gdim);

  /// @brief Largest size of a principal curvature at each point (shape=(n)).
  std::vector<double> largest_curvatures(int gdim) const;
};

/// @brief Position and direction of a rigid obstacle.
struct Placement
{
  std::vector<double> point; ///< moves with it (shape=(gdim))
  /// Unit vector that turns with it (shape=(gdim)); empty where none is known
  std::vector<double> direction{};
  /// How far its material has spun, in radians: in 2D counter-clockwise,
  /// in 3D about the direction (shape=(1)), or, where there is none, by a
  /// rotation vector (shape=(3)); empty if it does not spin
  std::vector<double> angle{};
  double time = 0; ///< up to which its material has gone with a velocity

  /// @brief Rotation of the obstacle's shape to another placement, the smallest
  /// from one direction to the other; spin does not change it.
  /// @param[in] to The other placement.
  /// @return Rotation (shape=(gdim, gdim)), the identity where a direction is
  /// not known.
  /// @throws std::invalid_argument if it turns by 180 degrees, which has no
  /// shortest way.
  std::vector<double> turn(const Placement& to) const;

  /// @brief Carry points of the obstacle's material from this placement to
  /// another one, with its spin.
  /// @param[in] x Points (shape=(n, gdim)).
  /// @param[in] to The other placement.
  /// @return Points (shape=(n, gdim)).
  /// @throws std::invalid_argument as `turn`.
  std::vector<double> carry(std::span<const double> x,
                            const Placement& to) const;

private:
  std::vector<double> spin(const Placement& to) const;
};

/// @brief Rigid body, a master without degrees of freedom.
///
/// Points `x` are row-major (shape=(n, gdim)); each function may throw
/// std::invalid_argument where the obstacle's parameters do not fit.
class Obstacle
{
public:
  virtual ~Obstacle() = default;

  /// @brief See the obstacle from points.
  virtual void evaluate(std::span<const double> x, int gdim, Geometry& at) = 0;

  /// @brief See the obstacle from points.
  Geometry evaluate(std::span<const double> x, int gdim)
  {
    Geometry at;
    evaluate(x, gdim, at);
    return at;
  }

  /// @brief Placement of the obstacle: its movement enters the slip of what
  /// touches it.
  virtual Placement placement(int gdim) = 0;

  /// @brief Carry points of its material from one placement to another one.
  /// @param[in] x Points (shape=(n, gdim)).
  /// @param[in] from Where the obstacle is with these.
  /// @param[in] to Where they are wanted.
  /// @return Points (shape=(n, gdim)).
  virtual std::vector<double> carry(std::span<const double> x,
                                    const Placement& from, const Placement& to);

  /// @brief Its diameter, infinite where none is known.
  virtual double size(int /*gdim*/)
  {
    return std::numeric_limits<double>::infinity();
  }

  /// @brief Gap alone, infinite where there is none (shape=(n)).
  virtual std::vector<double> distance(std::span<const double> x, int gdim);

  /// @brief Outward unit normals alone, zero where there is none (shape=(n,
  /// gdim)).
  virtual std::vector<double> normals(std::span<const double> x, int gdim);

  /// @brief Function of the sign of the gap, of any scale, also where there is
  /// no normal (shape=(n)).
  virtual std::vector<double> level(std::span<const double> x, int gdim);

  /// @brief True if `placement` says how its material moves.
  virtual bool knows_its_motion() const { return true; }

  /// @brief Current values of what moves it although `placement` does not tell.
  virtual std::vector<double> parameters(int /*gdim*/) { return {}; }

  /// @brief True if its gap is linear in the position, as that of a plane.
  virtual bool is_flat() const { return false; }

  /// @brief Name of its kind in messages.
  virtual std::string name() const { return "obstacle"; }

  /// @brief Advice where a whole body is inside: a sentence
  /// without its full stop.
  virtual std::string usual_mistake() const
  {
    return "It is probably in the wrong place";
  }

  /// Size of the largest surface that is measured against it, the same on all
  /// ranks; zero if none is known
  double extent = 0;

  /// Size of the smallest facet that is measured against it, the same on all
  /// ranks; zero if none is known
  double facet = 0;

protected:
  /// @brief Called before the parameters are read. Who gets them from
  /// elsewhere hands their current values over here.
  virtual void refresh(int /*gdim*/) {}
};
} // namespace contactx::geometry
