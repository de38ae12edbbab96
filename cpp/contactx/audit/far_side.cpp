// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "far_side.h"
#include <stdexcept>

std::vector<std::int8_t> contactx::audit::far_side(
    std::span<const double> own_before, std::span<const double> own_after,
    std::span<const double> before, std::span<const double> after, int gdim)
{
  const std::size_t size = own_before.size();
  if (own_after.size() != size or before.size() != size or after.size() != size)
    throw std::invalid_argument("normals of different numbers of nodes");
  const auto dot = [gdim](std::span<const double> a, std::span<const double> b,
                          std::size_t i)
  {
    double sum = 0;
    for (int k = 0; k < gdim; ++k)
      sum += a[i * gdim + k] * b[i * gdim + k];
    return sum;
  };
  std::vector<std::int8_t> is(size / gdim);
  for (std::size_t i = 0; i < is.size(); ++i)
    is[i] = dot(own_before, before, i) < 0 and dot(own_after, after, i) > 0
            and dot(own_before, own_after, i) > 0 and dot(before, after, i) < 0;
  return is;
}
