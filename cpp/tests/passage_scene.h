// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "scene.h"
#include <contactx/audit/passage.h>

namespace contactx::tests
{
/// @brief Facets and points at the start and at the end of a step.
struct MovingScene
{
  explicit MovingScene(int gdim) : facets(gdim) {}

  Scene facets;
  std::vector<double> x1;
  std::vector<double> points0, points1, normals0, normals1, tolerance;
  std::vector<std::int32_t> nodes;

  int gdim() const { return facets.gdim; }

  std::int32_t node(const Vector<3>& from, const Vector<3>& to)
  {
    x1.insert(x1.end(), to.begin(), to.begin() + gdim());
    return facets.node(from);
  }

  void point(const Vector<3>& from, const Vector<3>& to,
             const Vector<3>& normal0, const Vector<3>& normal1, double tol,
             std::int32_t number = -1)
  {
    const auto add = [this](std::vector<double>& values, const Vector<3>& v)
    { values.insert(values.end(), v.begin(), v.begin() + gdim()); };
    add(points0, from);
    add(points1, to);
    add(normals0, normal0);
    add(normals1, normal1);
    tolerance.push_back(tol);
    nodes.push_back(number);
  }

  audit::MovedPoints points() const
  {
    return {points0, points1, normals0, normals1, tolerance, nodes};
  }

  audit::Passages passages() const
  {
    return audit::passages(facets.facets(), facets.x, x1, gdim(), points());
  }

  /// @brief Crossings as an observer at rest sees them.
  std::vector<audit::Crossing> crossings() const
  {
    const geometry::RigidMotion rest{
        {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}, {}};
    return audit::crossings(facets.facets(), facets.x, x1, gdim(), rest,
                            points());
  }

  void scale(double by)
  {
    for (auto* values : {&facets.x, &x1, &points0, &points1, &tolerance})
      for (double& v : *values)
        v *= by;
  }

  /// @brief Move the whole scene, or its end alone.
  template <int D>
  void move(const Motion<D>& motion, bool end_alone)
  {
    for (auto* x : {&facets.x, &points0, &x1, &points1})
      if (!end_alone or x == &x1 or x == &points1)
        each<D>(*x, motion);
    for (auto* n : {&normals0, &normals1})
      if (!end_alone or n == &normals1)
        each<D>(*n, [&motion](const Vector<D>& v) { return motion.rotate(v); });
  }

private:
  template <int D, class Function>
  static void each(std::vector<double>& values, Function f)
  {
    Vector<D> v;
    for (std::size_t i = 0; i < values.size(); i += D)
    {
      std::copy_n(values.begin() + i, D, v.begin());
      std::ranges::copy(f(v), values.begin() + i);
    }
  }
};

/// @brief A rotation by an angle around a random axis, and a translation.
template <int D>
Motion<D> turn(Generator& random, double degrees, double distance)
{
  Motion<D> motion(random, distance);
  const double angle = degrees * std::numbers::pi / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  if constexpr (D == 2)
    motion.rows = {{{c, -s}, {s, c}}};
  else
  {
    const Vector<3> k = random.unit<3>();
    for (int i = 0; i < 3; ++i)
    {
      Vector<3> e{};
      e[i] = 1;
      // Row i of the rotation is what the inverse makes of e_i
      motion.rows[i] = c * e + -s * cross(k, e) + (1 - c) * dot(k, e) * k;
    }
  }
  return motion;
}

/// @brief Points of a plane scene.
using Outline = std::vector<Vector<2>>;

/// @brief Corners of a rectangle, n segments a side, the body inside.
inline Outline rectangle(const Vector<2>& low, const Vector<2>& high, int n)
{
  const Outline corners{low, {high[0], low[1]}, high, {low[0], high[1]}};
  Outline outline;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i)
      outline.push_back(corners[side]
                        + (double(i) / n)
                              * (corners[(side + 1) % 4] - corners[side]));
  return outline;
}

/// @brief Corners of a circle with the body inside, or of a hole.
inline Outline circle(double radius, int n, bool hole = false)
{
  Outline outline;
  for (int i = 0; i < n; ++i)
  {
    const double angle = (hole ? -1 : 1) * 2 * std::numbers::pi * i / n;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

/// @brief What a plane scene is made of.
enum class Made
{
  segments,
  triangles,
  quadrilaterals
};

/// @brief A surface in the plane, or as long in the third direction.
/// @param[in] from, to Its points at the start and at the end.
/// @param[in] closed Whether the last point is joined to the first one.
inline MovingScene outlined(Made made, const Outline& from, const Outline& to,
                            bool closed = true)
{
  MovingScene scene(made == Made::segments ? 2 : 3);
  const int n = static_cast<int>(from.size());
  const int layers = made == Made::segments ? 1 : 3;
  for (int j = 0; j < layers; ++j)
    for (int i = 0; i < n; ++i)
      scene.node({from[i][0], from[i][1], 2. * j - 2},
                 {to[i][0], to[i][1], 2. * j - 2});
  for (int i = 0; i < (closed ? n : n - 1); ++i)
  {
    const int next = (i + 1) % n;
    if (layers == 1)
      scene.facets.facet({i, next});
    else
      for (int a = 0; a < 2 * n; a += n)
        scene.facets.patch({a + i, a + next, a + n + i, a + n + next},
                           made == Made::triangles);
  }
  return scene;
}
} // namespace contactx::tests
