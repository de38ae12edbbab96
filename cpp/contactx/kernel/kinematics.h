// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "variation.h"
#include <string_view>
#include <type_traits>

namespace contactx::kernel
{
/// @brief Derivative of the gap over a point that is the projection on a
/// surface of normal n: n for the slave node, -N_l n for the facet's.
template <class F>
Vector<Pair<F>::num_dofs> interior_gap_derivative(const ContactPoint<F>& c)
{
  Vector<Pair<F>::num_dofs> dg;
  for (int a = 0; a <= F::nodes; ++a)
    for (int k = 0; k < F::gdim; ++k)
      dg[F::gdim * a + k] = c.normal[k] * c.weight[a];
  return dg;
}

/// @brief Kinematics of finite sliding: everything is current.
template <class Facet>
struct Finite
{
  using F = Facet;
  static constexpr std::string_view name = "finite";
  static constexpr bool turning = true;

  explicit Finite(const double* w) : pair(w), point(project(pair)) {}

  Variation<F> variation() const { return Variation<F>(pair, point); }

  Vector<Pair<F>::num_dofs> gap_derivative() const
  {
    // The projection's movement along the surface does not change the gap
    if (pair.feature == geometry::interior)
      return interior_gap_derivative(point);
    return variation().gap;
  }

  Pair<F> pair;
  ContactPoint<F> point;
};

/// @brief Kinematics of small sliding: projection and normal are those of the
/// search, the gap is linear in the displacement.
template <class Facet>
struct Small
{
  using F = Facet;
  static constexpr std::string_view name = "small";
  static constexpr bool turning = false;

  explicit Small(const double* w)
      : pair(w), point(contact_point(pair, pair.xi, pair.normal))
  {
  }

  Vector<Pair<F>::num_dofs> gap_derivative() const
  {
    return interior_gap_derivative(point);
  }

  Pair<F> pair;
  ContactPoint<F> point;
};

/// @brief Call `f` with std::type_identity of each kind of kinematics.
template <class Function>
void for_all_kinematics(Function&& f)
{
  using geometry::Quadrilateral;
  using geometry::Segment;
  using geometry::Triangle;
  f(std::type_identity<Small<Segment>>{});
  f(std::type_identity<Small<Triangle>>{});
  f(std::type_identity<Small<Quadrilateral>>{});
  f(std::type_identity<Finite<Segment>>{});
  f(std::type_identity<Finite<Triangle>>{});
  f(std::type_identity<Finite<Quadrilateral>>{});
}
} // namespace contactx::kernel
