// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "mean_normal.h"
#include "../math/vec.h"
#include <algorithm>
#include <cstddef>

using namespace contactx;
using namespace contactx::law;

namespace
{
double length_of(const double* a, int gdim)
{
  return std::sqrt(dot(a, a, gdim));
}

/// For each row of a matrix minus (row . n) n.
/// @param[out] along Products of the rows and n.
void drop_along(double* matrix, const double* n, double* along, int gdim)
{
  for (int i = 0; i < gdim; ++i)
  {
    double* row = matrix + gdim * i;
    along[i] = dot(row, n, gdim);
    for (int j = 0; j < gdim; ++j)
      row[j] -= along[i] * n[j];
  }
}
} // namespace

MeanNormal::MeanNormal(std::int32_t num_nodes, int gdim)
    : _gdim(gdim), _length(num_nodes, 1.0),
      _kept(std::size_t(num_nodes) * gdim, 1.0), _movement(_kept.size(), 0.0),
      _mobile(_kept.size(), 1.0)
{
}

void MeanNormal::normalise(std::span<double> normal,
                           std::span<const double> mobile)
{
  for (std::size_t i = 0; i < _length.size(); ++i)
  {
    double* n = normal.data() + _gdim * i;
    const double* m = mobile.data() + _gdim * i;
    double* kept = _kept.data() + _gdim * i;
    Vector<3> part{};
    for (int k = 0; k < _gdim; ++k)
      part[k] = n[k] * m[k];
    // A node whose normal lies in such directions cannot move along it
    const bool leans = norm(part) > 0.5 * length_of(n, _gdim);
    for (int k = 0; k < _gdim; ++k)
    {
      kept[k] = leans ? m[k] : 1.0;
      n[k] *= kept[k];
    }
    const double length = length_of(n, _gdim);
    _length[i] = length > 0 ? length : 1.0;
    for (int k = 0; k < _gdim; ++k)
      n[k] /= _length[i];
  }
}

void MeanNormal::project(std::span<const double> normal, std::span<double> slip,
                         std::span<const double> mobile)
{
  std::ranges::copy(slip, _movement.begin());
  std::ranges::copy(mobile, _mobile.begin());
  for (std::size_t i = 0; i < _length.size(); ++i)
  {
    const double* n = normal.data() + _gdim * i;
    double* s = slip.data() + _gdim * i;
    const double height = dot(n, s, _gdim);
    for (int k = 0; k < _gdim; ++k)
      s[k] = (s[k] - height * n[k]) * _mobile[_gdim * i + k];
  }
}

void MeanNormal::chain(std::span<const double> normal,
                       std::span<double> by_slip,
                       std::span<double> by_normal) const
{
  const int g = _gdim;
  for (std::size_t i = 0; i < _length.size(); ++i)
  {
    const double* n = normal.data() + g * i;
    const double* w = _movement.data() + g * i;
    double* S = by_slip.data() + g * g * i;
    double* N = by_normal.data() + g * g * i;
    const double height = dot(n, w, g);
    Vector<3> along;
    for (int r = 0; r < g; ++r)
    {
      for (int k = 0; k < g; ++k)
        S[g * r + k] *= _mobile[g * i + k];
      along[r] = dot(S + g * r, n, g);
      // Of (I - n n^T) w by n: -(n . w) I - n w^T
      for (int k = 0; k < g; ++k)
        N[g * r + k] -= height * S[g * r + k] + along[r] * w[k];
    }
    drop_along(S, n, along.data(), g);
    // Of M m / |M m| by m: (I - n n^T) M / |M m|
    drop_along(N, n, along.data(), g);
    for (int r = 0; r < g; ++r)
      for (int k = 0; k < g; ++k)
        N[g * r + k] *= _kept[g * i + k] / _length[i];
  }
}
