// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "generator.h"
#include <contactx/geometry/frame.h>
#include <gtest/gtest.h>

namespace contactx::tests
{
/// @brief The facets that typed tests run on.
using FacetTypes = testing::Types<geometry::Segment, geometry::Triangle,
                                  geometry::Quadrilateral>;

/// @brief A random convex facet in the plane of the first two axes (on the
/// first axis in 2D), about one in size.
template <class F>
geometry::Nodes<F> flat_facet(Generator& random)
{
  if constexpr (F::nodes == 2)
    return {{{0, 0}, {random(0.5, 2), 0}}};
  else if constexpr (F::nodes == 3)
    return {{{0, 0, 0},
             {random(0.5, 2), 0, 0},
             {random(-0.5, 1.5), random(0.5, 2), 0}}};
  else
  {
    geometry::Nodes<F> x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
    const double width = random(0.5, 2);
    for (auto& p : x)
    {
      p = p + Vector<3>{random(-0.2, 0.2), random(-0.2, 0.2), 0};
      p[0] *= width;
    }
    return x;
  }
}

/// @brief Outward normal of the facets that flat_facet() makes.
template <class F>
Vector<F::gdim> flat_normal()
{
  if constexpr (F::gdim == 2)
    return {0, -1};
  else
    return {0, 0, 1};
}

/// @brief Local coordinates inside a facet, away from its edges.
template <class F>
geometry::Local<F> inner_point(Generator& random)
{
  geometry::Local<F> xi = random.vector<F::tdim>(0.05, 0.95);
  while (F::excess(xi) > -0.05)
    xi = random.vector<F::tdim>(0.05, 0.95);
  return xi;
}

/// @brief A random facet somewhere in space; quadrilaterals are warped.
template <class F>
geometry::Nodes<F> random_facet(Generator& random, double warp = 0.2)
{
  geometry::Nodes<F> x = flat_facet<F>(random);
  if constexpr (F::nodes == 4)
    for (auto& p : x)
      p[2] = random(-warp, warp);
  return Motion<F::gdim>(random, 3)(x);
}

/// @brief Point of a facet.
template <class F>
Vector<F::gdim> position(const geometry::Nodes<F>& x,
                         const geometry::Local<F>& xi)
{
  return geometry::combine<F>(F::shape(xi), x);
}
} // namespace contactx::tests
