// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "level_set.h"
#include "parameters.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx::obstacle;

namespace
{
/// Lengths of vectors.
std::vector<double> sizes(std::span<const double> vectors, int gdim)
{
  std::vector<double> size(vectors.size() / gdim);
  for (std::size_t i = 0; i < size.size(); ++i)
  {
    double square = 0;
    for (int k = 0; k < gdim; ++k)
      square += vectors[gdim * i + k] * vectors[gdim * i + k];
    size[i] = std::sqrt(square);
  }
  return size;
}

void check(const std::vector<double>& values, std::size_t size,
           const char* name)
{
  if (values.size() != size)
    throw std::invalid_argument(std::string(name) + " of a LevelSet gave "
                                + std::to_string(values.size())
                                + " values: it must give "
                                + std::to_string(size));
}
} // namespace

LevelSet::LevelSet(Function f, Parameters parameters,
                   std::optional<Velocity> velocity)
    : _f(std::move(f)), _parameters(std::move(parameters)),
      _velocity(std::move(velocity))
{
}

LevelValues LevelSet::values(std::span<const double> x, int gdim,
                             int order) const
{
  // A rank without slave nodes: no function needs to take that
  if (x.empty())
    return {};
  const std::size_t n = x.size() / gdim;
  LevelValues at = _f(x, gdim, order);
  check(at.value, n, "the function");
  if (order > 0)
    check(at.gradient, n * gdim, "the gradient");
  if (order > 1 and not at.hessian.empty())
    check(at.hessian, n * gdim * gdim, "the second derivative");
  return at;
}

std::vector<double> LevelSet::differences(std::span<const double> x,
                                          int gdim) const
{
  const std::size_t n = x.size() / gdim;
  // Not a length of these points alone: which ones they are depends on the
  // partition
  double size = extent;
  if (size == 0)
    for (int k = 0; k < gdim; ++k)
    {
      double low = x[k], high = x[k];
      for (std::size_t i = 0; i < n; ++i)
      {
        low = std::min(low, x[gdim * i + k]);
        high = std::max(high, x[gdim * i + k]);
      }
      size = std::max(size, high - low);
    }
  std::vector<double> h(n), H(n * gdim * gdim);
  for (std::size_t i = 0; i < n; ++i)
  {
    double largest = 0;
    for (int k = 0; k < gdim; ++k)
      largest = std::max(largest, std::abs(x[gdim * i + k]));
    h[i] = 1e-6 * std::max(largest * 1e-3, std::max(size, 1e-30));
  }
  std::vector<double> moved;
  for (int k = 0; k < gdim; ++k)
  {
    const auto gradient = [&](double sign)
    {
      moved.assign(x.begin(), x.end());
      for (std::size_t i = 0; i < n; ++i)
        moved[gdim * i + k] += sign * h[i];
      return values(moved, gdim, 1).gradient;
    };
    const std::vector<double> plus = gradient(1), minus = gradient(-1);
    for (std::size_t i = 0; i < n; ++i)
      for (int j = 0; j < gdim; ++j)
        H[gdim * (gdim * i + j) + k]
            = (plus[gdim * i + j] - minus[gdim * i + j]) / (2 * h[i]);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (int j = 0; j < gdim; ++j)
      for (int k = 0; k < j; ++k)
      {
        double &a = H[gdim * (gdim * i + j) + k],
               &b = H[gdim * (gdim * i + k) + j];
        a = b = (a + b) / 2;
      }
  return H;
}

void LevelSet::evaluate(std::span<const double> x, int gdim, Geometry& at)
{
  const std::size_t n = x.size() / gdim;
  at.resize(n, gdim);
  if (n == 0)
    return;
  LevelValues f = values(x, gdim, 2);
  if (f.hessian.empty())
    f.hessian = differences(x, gdim);
  const std::vector<double> size = sizes(f.gradient, gdim);
  std::size_t bad = 0, first = 0;
  for (std::size_t i = n; i-- > 0;)
    if (not(std::isfinite(f.value[i]) and std::isfinite(size[i])
            and size[i] > 0))
    {
      ++bad;
      first = i;
    }
  if (bad > 0)
    throw std::invalid_argument(
        "the function of a LevelSet or its gradient is not finite, or the "
        "gradient zero, at "
        + std::to_string(bad) + " slave nodes, first at "
        + text(x.subspan(gdim * first, gdim))
        + ": the gradient must point outward wherever a slave node may come "
          "(manual: errors/level-set-values)");
  for (std::size_t i = 0; i < n; ++i)
  {
    const double* H = &f.hessian[gdim * gdim * i];
    double* normal = &at.normal[gdim * i];
    for (int k = 0; k < gdim; ++k)
      normal[k] = f.gradient[gdim * i + k] / size[i];
    at.gap[i] = f.value[i] / size[i];
    for (int j = 0; j < gdim; ++j)
    {
      double along = 0;
      for (int k = 0; k < gdim; ++k)
        along += H[gdim * j + k] * normal[k];
      at.gradient[gdim * i + j] = normal[j] - at.gap[i] * along / size[i];
      for (int k = 0; k < gdim; ++k)
      {
        double projected = 0;
        for (int l = 0; l < gdim; ++l)
          projected += ((j == l) - normal[j] * normal[l]) * H[gdim * l + k];
        at.curvature[gdim * (gdim * i + j) + k] = projected / size[i];
      }
    }
  }
}

Placement LevelSet::placement(int gdim)
{
  Placement now{std::vector<double>(gdim, 0.0)};
  if (_velocity)
    now.time = _velocity->time();
  if (not std::isfinite(now.time))
    throw std::invalid_argument(
        "the time of a LevelSet is not finite: give a finite number "
        "(manual: errors/level-set-values)");
  return now;
}

std::vector<double> LevelSet::velocity(std::span<const double> x,
                                       int gdim) const
{
  std::vector<double> v = _velocity->values(x, gdim);
  check(v, x.size(), "the velocity");
  const auto bad = std::ranges::find_if(
      v, [](double component) { return not std::isfinite(component); });
  if (bad != v.end())
    throw std::invalid_argument(
        "the velocity of a LevelSet is not finite at "
        + text(x.subspan((bad - v.begin()) / gdim * gdim, gdim))
        + ": let it return finite numbers (manual: errors/level-set-values)");
  return v;
}

/// The method of Runge and Kutta of fourth order: a quarter of a turn in one
/// step is off by 2e-5 radii.
std::vector<double> LevelSet::carry(std::span<const double> x,
                                    const Placement& from, const Placement& to)
{
  std::vector<double> at(x.begin(), x.end());
  if (not _velocity or x.empty() or to.time == from.time)
    return at;
  const int gdim = static_cast<int>(from.point.size());
  constexpr int parts = 4;
  const double dt = (to.time - from.time) / parts;
  const std::size_t n = x.size();
  for (int part = 0; part < parts; ++part)
  {
    const std::vector<double> start = at;
    std::vector<double> sum(n, 0), moved = start;
    for (int stage = 0; stage < 4; ++stage)
    {
      const std::vector<double> v = velocity(moved, gdim);
      const double weight = stage == 0 or stage == 3 ? 1. / 6 : 1. / 3;
      const double reach = stage == 2 ? 1 : 0.5;
      for (std::size_t i = 0; i < n; ++i)
      {
        sum[i] += weight * v[i];
        moved[i] = start[i] + reach * dt * v[i];
      }
    }
    for (std::size_t i = 0; i < n; ++i)
      at[i] = start[i] + dt * sum[i];
  }
  return at;
}

std::vector<double> LevelSet::distance(std::span<const double> x, int gdim)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const LevelValues f = values(x, gdim, 1);
  const std::vector<double> size = sizes(f.gradient, gdim);
  std::vector<double> gap(size.size());
  for (std::size_t i = 0; i < gap.size(); ++i)
  {
    gap[i] = size[i] > 0 ? f.value[i] / size[i]
                         : std::copysign(infinity, f.value[i]);
    if (not std::isfinite(f.value[i]) or not std::isfinite(size[i]))
      gap[i] = infinity;
  }
  return gap;
}

std::vector<double> LevelSet::normals(std::span<const double> x, int gdim)
{
  std::vector<double> normal = values(x, gdim, 1).gradient;
  const std::vector<double> size = sizes(normal, gdim);
  for (std::size_t i = 0; i < size.size(); ++i)
    for (int k = 0; k < gdim; ++k)
    {
      double& c = normal[gdim * i + k];
      c = std::isfinite(size[i]) and size[i] > 0 ? c / size[i] : 0;
    }
  return normal;
}

std::vector<double> LevelSet::level(std::span<const double> x, int gdim)
{
  return values(x, gdim, 0).value;
}

std::vector<double> LevelSet::parameters(int gdim)
{
  return _parameters ? _parameters(gdim) : std::vector<double>{};
}

std::string LevelSet::usual_mistake() const
{
  return "Perhaps the sign of its function is wrong: it must be positive where "
         "bodies may be";
}
