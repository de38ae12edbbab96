// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "sizes.h"
#include "../math/vec.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::geometry;

namespace
{
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

std::vector<double>
contactx::geometry::facet_turns(const FacetList& facets,
                                std::span<const double> x,
                                std::span<const double> normal, int gdim)
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
        const double length = distance(x, nodes[i], nodes[j], gdim);
        if (length > 0)
          turn[f] = std::max(turn[f], distance(normal, nodes[i], nodes[j], gdim)
                                          / length);
      }
  }
  return turn;
}

std::vector<double>
contactx::geometry::nodal_curvatures(const FacetList& facets,
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

std::vector<double> contactx::geometry::facet_sizes(const FacetList& facets,
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

std::vector<double> contactx::geometry::unstretched_sizes(
    const FacetList& facets, std::span<const double> x,
    std::span<const double> reference, int gdim)
{
  std::vector<double> size = facet_sizes(facets, x, gdim);
  const std::vector<double> before = facet_sizes(facets, reference, gdim);
  for (std::size_t f = 0; f < size.size(); ++f)
    size[f] = std::min(size[f], before[f]);
  return size;
}
