// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "generator.h"
#include <algorithm>
#include <array>
#include <contactx/law/coulomb.h>

namespace contactx::tests
{
template <int D>
using Matrix = std::array<Vector<D>, D>;

/// @brief What Coulomb's law says of one slave node.
template <int D>
struct CoulombTerms
{
  Vector<D> value, by_gap;
  Matrix<D> by_traction, by_slip, by_normal;
};

/// @brief One slave node with friction.
template <int D>
struct CoulombNode
{
  Vector<D> traction, normal, slip;
  double gap, c, friction;
  double area = 1;
  double reach = 10; ///< of trial friction, over the bound
  Vector<D> mobile = ones();

  static Vector<D> ones()
  {
    Vector<D> v;
    v.fill(1);
    return v;
  }

  law::FrictionalState state() const
  {
    return {D, traction, {&gap, 1}, normal, slip, {&c, 1}, {&friction, 1}};
  }

  std::int8_t status(std::int8_t before = law::open) const
  {
    std::array<std::int8_t, 1> status{before};
    law::frictional_status(state(), reach, status);
    return status[0];
  }

  CoulombTerms<D> terms(std::int8_t status) const
  {
    Vector<D> value, by_gap;
    std::array<double, D * D> by_traction, by_slip, by_normal;
    const std::array s{status};
    law::frictional_complementarity(
        state(), {&area, 1}, s, mobile,
        {value, by_traction, by_gap, by_slip, by_normal});
    return {value, by_gap, matrix(by_traction), matrix(by_slip),
            matrix(by_normal)};
  }

  /// @brief Pressure, its trial value where the node is closed, and the trial
  /// friction.
  double pressure() const { return dot(normal, traction); }
  double trial_pressure() const { return pressure() - c * std::min(gap, 0.0); }
  Vector<D> tangential() const { return traction - pressure() * normal; }
  Vector<D> trial() const { return tangential() - c * slip; }

private:
  static Matrix<D> matrix(const std::array<double, D * D>& a)
  {
    Matrix<D> m;
    for (int i = 0; i < D; ++i)
      std::copy_n(a.begin() + D * i, D, m[i].begin());
    return m;
  }
};

/// @brief A random node in contact whose trial friction is far from zero.
template <int D>
CoulombNode<D> random_node(Generator& random)
{
  CoulombNode<D> node;
  do
  {
    node.normal = random.unit<D>();
    node.traction = random.vector<D>(-2, 2);
    node.slip = random.vector<D>(-0.5, 0.5);
    node.gap = random(-0.3, 0.3);
    node.c = random(0.5, 4);
    node.friction = random(0, 1.5);
    node.area = random(0.1, 3);
  } while (norm(node.trial()) < 0.5);
  return node;
}

/// @brief A node with its normal along the last axis and c = 8.
template <int D>
CoulombNode<D> upright(double p, double t, double gap, double slip,
                       double friction)
{
  CoulombNode<D> node{{}, {}, {}, gap, 8, friction};
  node.normal[D - 1] = 1;
  node.traction[0] = t;
  node.traction[D - 1] = p;
  node.slip[0] = slip;
  return node;
}

/// @brief Largest component of a vector.
template <std::size_t D>
double largest(const std::array<double, D>& v)
{
  double size = 0;
  for (double c : v)
    size = std::max(size, std::abs(c));
  return size;
}
} // namespace contactx::tests
