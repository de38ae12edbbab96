// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "expect.h"
#include <cmath>
#include <contactx/geometry/cylinder.h>
#include <contactx/geometry/level_set.h>
#include <contactx/geometry/plane.h>
#include <contactx/geometry/sphere.h>
#include <memory>

namespace contactx::tests
{
/// @brief f = |x - c|^2 - 1/2 + x_0 x_1, with its derivatives or, if
/// `has_hessian` is false, its gradient alone.
inline geometry::LevelValues bump(std::span<const double> x, int gdim,
                                  bool has_hessian)
{
  const double c[3] = {0.1, 0.2, -0.3};
  const std::size_t n = x.size() / gdim;
  geometry::LevelValues at;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double* p = &x[gdim * i];
    double f = -0.5 + p[0] * p[1];
    for (int k = 0; k < gdim; ++k)
      f += (p[k] - c[k]) * (p[k] - c[k]);
    at.value.push_back(f);
    for (int k = 0; k < gdim; ++k)
      at.gradient.push_back(2 * (p[k] - c[k]) + (k < 2 ? p[1 - k] : 0));
    for (int j = 0; has_hessian and j < gdim; ++j)
      for (int k = 0; k < gdim; ++k)
        at.hessian.push_back(2 * (j == k) + (j != k and j < 2 and k < 2));
  }
  return at;
}

enum class Kind
{
  plane,
  sphere,
  bowl,
  cylinder,
  pipe,
  level_set,
  level_set_by_gradients
};

inline std::vector<Kind> kinds(int gdim)
{
  using enum Kind;
  if (gdim == 2)
    return {plane, sphere, bowl, level_set, level_set_by_gradients};
  return {
      plane, sphere, bowl, cylinder, pipe, level_set, level_set_by_gradients};
}

/// @brief An obstacle near the origin, about as large as one.
inline std::shared_ptr<geometry::Obstacle> make_obstacle(Kind kind, int gdim)
{
  const auto cut = [gdim](std::vector<double> v)
  {
    v.resize(gdim);
    return v;
  };
  const std::vector<double> point = cut({0.1, 0.2, -0.3}), axis{0.3, -0.5, 0.8};
  switch (kind)
  {
  case Kind::plane:
    return std::make_shared<geometry::Plane>(point, cut({0.4, -1, 2}));
  case Kind::sphere:
    return std::make_shared<geometry::Sphere>(point, 0.7);
  case Kind::bowl:
    return std::make_shared<geometry::Sphere>(point, 3.0, true);
  case Kind::cylinder:
    return std::make_shared<geometry::Cylinder>(point, axis, 0.7);
  case Kind::pipe:
    return std::make_shared<geometry::Cylinder>(point, axis, 3.0, true);
  default:
    return std::make_shared<geometry::LevelSet>(
        [has_hessian = kind == Kind::level_set](std::span<const double> x,
                                                int g, int)
        { return bump(x, g, has_hessian); });
  }
}

/// @brief Compare gradients and curvatures at some points with differences of
/// gaps and of unit normals.
/// @param[in] tolerance Of curvatures, called as tolerance(geometry, point).
template <class Tolerance>
void expect_differences(geometry::Obstacle& obstacle,
                        const std::vector<double>& x, int gdim, double h,
                        Tolerance tolerance)
{
  const geometry::Geometry at = obstacle.evaluate(x, gdim);
  for (int k = 0; k < gdim; ++k)
  {
    std::vector<double> up = x, down = x;
    for (std::size_t i = k; i < x.size(); i += gdim)
    {
      up[i] += h;
      down[i] -= h;
    }
    const geometry::Geometry a = obstacle.evaluate(up, gdim),
                             b = obstacle.evaluate(down, gdim);
    for (std::size_t i = 0; i < at.gap.size(); ++i)
    {
      EXPECT_NEAR(norm(vector_at(at.normal, i, gdim)), 1, 1e-14);
      EXPECT_NEAR(at.gradient[gdim * i + k], (a.gap[i] - b.gap[i]) / (2 * h),
                  2e-7);
      for (std::size_t j = gdim * i; j < gdim * (i + 1); ++j)
        EXPECT_NEAR(at.curvature[gdim * j + k],
                    (a.normal[j] - b.normal[j]) / (2 * h), tolerance(at, i))
            << at.gap[i];
    }
  }
}
} // namespace contactx::tests
