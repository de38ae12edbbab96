// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cmath>
#include <contactx/geometry/facets.h>
#include <contactx/mesh/halo.h>
#include <contactx/search/self/self_surface.h>
#include <numbers>

namespace contactx::tests
{
/// @brief Boundary of a strip in the plane, counter-clockwise: its bottom, an
/// end, its top, the other end. It may be bent about a middle above it.
struct Strip
{
  int cells;
  double length, thickness;
  std::vector<double> x;
  geometry::Facets facets;

  Strip(int cells, double length, double thickness)
      : cells(cells), length(length), thickness(thickness)
  {
    for (int i = 0; i <= cells; ++i)
      add(length * (double(i) / cells - 0.5), 0);
    for (int i = cells; i >= 0; --i)
      add(length * (double(i) / cells - 0.5), thickness);
    const auto n = static_cast<std::int32_t>(x.size() / 2);
    for (std::int32_t i = 0; i < n; ++i)
    {
      facets.nodes.push_back(i);
      facets.nodes.push_back((i + 1) % n);
      facets.offsets.push_back(2 * (i + 1));
    }
  }

  void add(double a, double b)
  {
    x.push_back(a);
    x.push_back(b);
  }

  /// @brief Number of a node of the top, from the left.
  std::int32_t top(int i) const { return 2 * cells + 1 - i; }

  /// @brief Displacement that folds the strip upward about its middle: its top
  /// halves come to face each other at a distance, or overlap by a negative
  /// one.
  std::vector<double> folded(double distance) const
  {
    std::vector<double> u(x.size());
    // A tight arc, and straight legs
    const double inner = distance / 2, arc = 4 * thickness;
    const double radius = 2 * arc / std::numbers::pi;
    for (std::size_t i = 0; i < x.size() / 2; ++i)
    {
      const double s = x[2 * i], height = x[2 * i + 1], side = s < 0 ? -1 : 1;
      double a, b;
      if (std::abs(s) <= arc)
      {
        const double angle = s / radius, r = radius - height;
        a = r * std::sin(angle);
        b = radius - r * std::cos(angle);
      }
      else
      {
        // Legs lean towards each other until they are apart by the distance
        const double along = std::abs(s) - arc;
        const double lean = std::min(1.0, along / (4 * thickness));
        const double wide = (1 - lean) * radius + lean * (inner + thickness);
        a = side * (wide - height);
        b = radius + along;
      }
      u[2 * i] = a - s;
      u[2 * i + 1] = b - height;
    }
    return u;
  }
};

/// @brief Several boundaries as one surface.
struct Joined
{
  std::vector<double> x;
  geometry::Facets facets;
  std::vector<std::int64_t> body;

  void add(const Strip& strip, double aside, double up, std::int64_t name)
  {
    const auto first = static_cast<std::int32_t>(x.size() / 2);
    for (std::size_t i = 0; i < strip.x.size() / 2; ++i)
    {
      x.push_back(strip.x[2 * i] + aside);
      x.push_back(strip.x[2 * i + 1] + up);
      body.push_back(name);
    }
    for (const std::int32_t node : strip.facets.nodes)
      facets.nodes.push_back(first + node);
    facets.offsets.clear();
    for (std::size_t f = 0; 2 * f <= facets.nodes.size(); ++f)
      facets.offsets.push_back(static_cast<std::int32_t>(2 * f));
  }
};
} // namespace contactx::tests
