// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "penetration.h"
#include "../math/vec.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::audit;

namespace
{
/// Allowed penetration over the depth of the chord of a curved facet: both
/// sides are curved
constexpr double chord_depth_factor = 2;

/// Depth of a chord in a circle, by the chord's length.
/// @param[in] turn Length of the chord by the radius.
double chord(double turn)
{
  return turn < 2 ? turn / (4 + 2 * std::sqrt(4 - turn * turn)) : infinity;
}
} // namespace

std::vector<double> contactx::audit::allowed_penetration(
    std::span<const double> size, std::span<const double> curvature,
    std::span<const std::int8_t> contact, std::span<const double> extent)
{
  if (size.size() != curvature.size() or size.size() != contact.size()
      or size.size() != extent.size())
    throw std::invalid_argument(
        "sizes, curvatures and contact of different numbers of facets");
  std::vector<double> depth(size.size());
  for (std::size_t i = 0; i < depth.size(); ++i)
  {
    const double h = size[i];
    // Beside a facet in contact one end is free
    const double part = contact[i] > 1   ? harmful_depth
                        : contact[i] > 0 ? harmful_depth / 2
                                         : negligible_depth;
    depth[i] = std::min(h, extent[i]) * part;
    if (const double its = chord(curvature[i] * h); its <= harmful_depth)
      depth[i] = std::max(
          depth[i], std::min(chord_depth_factor * its, harmful_depth) * h);
  }
  return depth;
}
