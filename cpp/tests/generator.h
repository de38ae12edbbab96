// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <algorithm>
#include <contactx/math/vec.h>
#include <numeric>
#include <random>
#include <vector>

/// @brief What several tests share: random input and slow references.
namespace contactx::tests
{
/// @brief Uniform random numbers, the same in each run.
class Generator
{
public:
  explicit Generator(unsigned seed) : _engine(seed) {}

  /// @brief A number between `a` and `b`.
  double operator()(double a, double b)
  {
    return a + (b - a) * (_engine() / 4294967296.0);
  }

  /// @brief Numbers between `a` and `b`.
  std::vector<double> numbers(std::size_t n, double a, double b)
  {
    std::vector<double> values(n);
    for (double& value : values)
      value = (*this)(a, b);
    return values;
  }
  /// @brief A vector with components between `a` and `b`.
  template <int D>
  Vector<D> vector(double a, double b)
  {
    Vector<D> v;
    for (double& c : v)
      c = (*this)(a, b);
    return v;
  }

  /// @brief A vector of length one.
  template <int D>
  Vector<D> unit()
  {
    Vector<D> v = vector<D>(-1, 1);
    while (norm(v) < 0.1)
      v = vector<D>(-1, 1);
    return (1 / norm(v)) * v;
  }

private:
  std::mt19937 _engine;
};

/// @brief n numbers in order.
template <class T = std::int32_t>
std::vector<T> numbered(std::size_t n, T first = 0)
{
  std::vector<T> all(n);
  std::iota(all.begin(), all.end(), first);
  return all;
}

/// @brief Row i of values.
template <int D>
Vector<D> row(std::span<const double> values, std::size_t i)
{
  Vector<D> v;
  std::ranges::copy(values.subspan(D * i, D), v.begin());
  return v;
}

/// @brief Rotation and translation.
template <int D>
struct Motion
{
  std::array<Vector<D>, D> rows; ///< of the rotation
  Vector<D> shift;

  /// @brief A random motion, translated by at most `distance` an axis.
  Motion(Generator& random, double distance)
      : shift(random.vector<D>(-distance, distance))
  {
    rows[0] = random.unit<D>();
    if constexpr (D == 2)
      rows[1] = {-rows[0][1], rows[0][0]};
    else
    {
      Vector<3> b = random.unit<3>();
      while (norm(cross(rows[0], b)) < 0.1)
        b = random.unit<3>();
      rows[1] = (1 / norm(cross(rows[0], b))) * cross(rows[0], b);
      rows[2] = cross(rows[0], rows[1]);
    }
  }

  Vector<D> rotate(const Vector<D>& v) const
  {
    Vector<D> y;
    for (int k = 0; k < D; ++k)
      y[k] = dot(rows[k], v);
    return y;
  }

  Vector<D> operator()(const Vector<D>& p) const { return shift + rotate(p); }

  template <std::size_t N>
  std::array<Vector<D>, N> operator()(std::array<Vector<D>, N> x) const
  {
    for (auto& p : x)
      p = (*this)(p);
    return x;
  }
};
} // namespace contactx::tests
