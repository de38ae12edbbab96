// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"
#include "../math/vec.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

using namespace contactx;
using namespace contactx::geometry;

namespace
{
/// Cosine to the master's normal, over a node's largest one, from which on a
/// facet is in front of the master: a face of a box at a right angle to
/// the one in contact is not, however the box tilts up to 26 degrees, and both
/// facets of a round body's polygon are
constexpr double facing_cosine_fraction = 0.5;

void check_rows(std::span<const double> x, std::span<const double> normal)
{
  if (x.size() != normal.size())
    throw std::invalid_argument("normals of another number of nodes");
}
} // namespace

std::vector<std::int8_t>
contactx::geometry::facing_nodes(const FacetList& facets,
                                 std::span<const double> x,
                                 std::span<const double> normal, int gdim)
{
  check_rows(x, normal);
  const std::vector<double> own = geometry::nodal_normals(facets, x, gdim);
  std::vector<std::int8_t> faces(x.size() / gdim);
  for (std::size_t i = 0; i < faces.size(); ++i)
    faces[i] = dot(&own[i * gdim], &normal[i * gdim], gdim) < 0;
  return faces;
}

std::vector<double> contactx::geometry::facing_areas(
    const FacetList& facets, std::span<const double> reference,
    std::span<const double> x, std::span<const double> normal, int gdim,
    const Shares& shares)
{
  check_rows(x, normal);
  check_rows(x, reference);
  const std::size_t n = facets.nodes.size();
  std::vector<std::int32_t> own(n);
  std::iota(own.begin(), own.end(), 0);
  // Each corner of each facet as a node of its own
  const FacetList corners{facets.offsets, own};
  const std::vector<double> turned = geometry::nodal_normals(
      corners, geometry::at_corners(facets, x, gdim), gdim);
  std::vector<double> area
      = geometry::corner_areas(facets, reference, gdim, shares);

  std::vector<double> cosine(n), most(x.size() / gdim, 0);
  for (std::size_t c = 0; c < n; ++c)
  {
    const auto node = static_cast<std::size_t>(facets.nodes[c]);
    cosine[c] = -dot(&turned[c * gdim], &normal[node * gdim], gdim);
    most[node] = std::max(most[node], cosine[c]);
  }
  for (std::size_t c = 0; c < n; ++c)
    if (const double best = most[facets.nodes[c]];
        best > 0 and cosine[c] < facing_cosine_fraction * best)
      area[c] = 0;
  return area;
}
