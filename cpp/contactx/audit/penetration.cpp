// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "penetration.h"
#include "../vec.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::audit;

namespace
{
/// Depth by the size of a facet that is harm, whatever a facet sees
constexpr double harm = 0.15;
/// How often the depth of the chord of a curvature is allowed: both sides are
/// curved
constexpr double both_sides = 2;

/// Depth of a chord in a circle, by the chord's length.
/// @param[in] turn Length of the chord by the radius.
double chord(double turn)
{
  return turn < 2 ? turn / (4 + 2 * std::sqrt(4 - turn * turn)) : infinity;
}

double distance(std::span<const double> x, std::int32_t a, std::int32_t b,
                int gdim)
{
  double square = 0;
  for (int k = 0; k < gdim; ++k)
  {
    const double d = x[static_cast<std::size_t>(a) * gdim + k]
                     - x[static_cast<std::size_t>(b) * gdim + k];
    square += d * d;
  }
  return std::sqrt(square);
}
} // namespace

std::vector<double> contactx::audit::facet_turns(const facet::FacetList& facets,
                                                 std::span<const double> x,
                                                 std::span<const double> normal,
                                                 int gdim)
{
  if (x.size() != normal.size())
    throw std::invalid_argument("normals of another number of nodes");
  std::vector<double> turn(facets.size(), 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
      {
        const double way = distance(x, nodes[i], nodes[j], gdim);
        if (way > 0)
          turn[f] = std::max(turn[f],
                             distance(normal, nodes[i], nodes[j], gdim) / way);
      }
  }
  return turn;
}

std::vector<double>
contactx::audit::nodal_curvatures(const facet::FacetList& facets,
                                  std::span<const double> x,
                                  std::span<const double> normal, int gdim)
{
  const std::vector<double> turn = facet_turns(facets, x, normal, gdim);
  std::vector<double> curvature(x.size() / gdim, 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
    for (const std::int32_t node : facets[f])
      curvature[node] = std::max(curvature[node], turn[f]);
  return curvature;
}

std::vector<double> contactx::audit::facet_sizes(const facet::FacetList& facets,
                                                 std::span<const double> x,
                                                 int gdim)
{
  std::vector<double> size(facets.size(), 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        size[f] = std::max(size[f], distance(x, nodes[i], nodes[j], gdim));
  }
  return size;
}

std::vector<double>
contactx::audit::unstretched_sizes(const facet::FacetList& facets,
                                   std::span<const double> x,
                                   std::span<const double> reference, int gdim)
{
  std::vector<double> size = facet_sizes(facets, x, gdim);
  const std::vector<double> before = facet_sizes(facets, reference, gdim);
  for (std::size_t f = 0; f < size.size(); ++f)
    size[f] = std::min(size[f], before[f]);
  return size;
}

std::vector<double> contactx::audit::explained_depths(
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
    const double part = contact[i] > 1   ? harm
                        : contact[i] > 0 ? harm / 2
                                         : negligible;
    depth[i] = std::min(h, extent[i]) * part;
    if (const double its = chord(curvature[i] * h); its <= harm)
      depth[i] = std::max(depth[i], std::min(both_sides * its, harm) * h);
  }
  return depth;
}
