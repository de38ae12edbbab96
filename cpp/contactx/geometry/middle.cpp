// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "middle.h"
#include "frame.h"
#include "gather.h"

using namespace contactx;
using namespace contactx::geometry;

Vector<3> CornerNormals::mean() const
{
  Vector<3> sum{};
  for (int i = 0; i < size; ++i)
    sum = sum + normal[i];
  for (double& c : sum)
    c /= size;
  return sum;
}

CornerNormals
contactx::geometry::corner_normals(std::span<const std::int32_t> nodes,
                                   std::span<const double> x)
{
  return visit(static_cast<int>(nodes.size()),
               [nodes, x]<class F>(F)
               {
                 const Nodes<F> xf = gather<F>(nodes, x);
                 CornerNormals found{F::flat ? 1 : F::nodes, {}};
                 for (int i = 0; i < found.size; ++i)
                 {
                   const auto t = tangents<F>(xf, F::vertices[i]);
                   if constexpr (F::gdim == 2)
                     found.normal[i] = {t[0][1], -t[0][0], 0};
                   else
                     found.normal[i] = cross(t[0], t[1]);
                 }
                 return found;
               });
}

Vector<3> contactx::geometry::middle(std::span<const std::int32_t> nodes,
                                     std::span<const double> x, int gdim)
{
  Vector<3> sum{};
  for (const std::int32_t node : nodes)
    for (int k = 0; k < gdim; ++k)
      sum[k] += x[static_cast<std::size_t>(node) * gdim + k];
  for (double& c : sum)
    c /= static_cast<double>(nodes.size());
  return sum;
}

Middles contactx::geometry::middles(const FacetList& facets,
                                    std::span<const double> x, int gdim)
{
  const std::size_t n = static_cast<std::size_t>(facets.size()) * gdim;
  Middles found{std::vector<double>(n), std::vector<double>(n)};
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const std::size_t at = static_cast<std::size_t>(f) * gdim;
    const Vector<3> point = middle(facets[f], x, gdim);
    const Vector<3> normal = corner_normals(facets[f], x).mean();
    const double size = norm(normal);
    for (int k = 0; k < gdim; ++k)
    {
      found.points[at + k] = point[k];
      found.normals[at + k] = size > 0 ? normal[k] / size : 0;
    }
  }
  return found;
}
