// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "mortar_pair.h"

namespace contactx::kernel
{
/// @brief Gap of each slave node, the share of one pair.
/// @tparam K What the kernels read: pair, its normal and the nodes' areas.
template <class K>
void mortar_gap(double* b, const double* w, const double*, const double*,
                const int*, const std::uint8_t*, void*)
{
  const K k(w);
  for (int s = 0; s < K::slaves; ++s)
    b[s] += dot(k.normals[s], k.pair.distance(s)) / k.area[s];
}

/// @brief Share of the pair in the mean normal of each slave node, which is
/// none of unit length.
template <class K>
void mortar_normal(double* b, const double* w, const double*, const double*,
                   const int*, const std::uint8_t*, void*)
{
  const K k(w);
  for (int s = 0; s < K::slaves; ++s)
    for (int i = 0; i < K::gdim; ++i)
      b[K::gdim * s + i] += k.pair.area(s) / k.area[s] * k.normals[s][i];
}
} // namespace contactx::kernel
