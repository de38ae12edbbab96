// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "finder.h"
#include "bisector.h"
#include <limits>

using namespace contactx;
using namespace contactx::search;

Found::Found(std::size_t n)
    : distance(n, std::numeric_limits<double>::infinity()), facet(n, -1),
      feature(n, geometry::interior), gap(n), xi(2 * n), normal(3 * n)
{
}

void Found::take(std::size_t i, const Projection& selected)
{
  facet[i] = selected.facet;
  feature[i] = selected.feature;
  gap[i] = selected.gap;
  std::ranges::copy(selected.xi, xi.begin() + 2 * i);
  std::ranges::copy(selected.normal, normal.begin() + 3 * i);
}

FoundNearest::FoundNearest(std::size_t n) : Found(n), nearest(n, -1), size(n) {}

Finder::Finder(std::vector<std::int32_t> offsets,
               std::vector<std::int32_t> nodes, int gdim)
    : _surface(std::move(offsets), std::move(nodes), gdim)
{
}

void Finder::refit(std::span<const double> x)
{
  if (_tree)
    _tree->refit([this, x](std::int32_t f) { return _surface.box(f, x); });
  else
    _tree.emplace(_surface.boxes(x));
}

FoundPlace Finder::find(std::span<const double> x, const Vector<3>& p,
                        const Vector<3>& normal, double reach,
                        std::int32_t hint, const Accepts& accepts,
                        const View& view) const
{
  FoundPlace found;
  found.nearest = nearest_facet(_surface, *_tree, x, p, normal, reach, hint,
                                accepts, view);
  if (found.nearest)
    found.selected = select(_surface, x, p, *found.nearest);
  if (found.selected and found.selected->feature == geometry::interior)
    if (const auto half_way = bisector(_surface, x, p, *found.selected))
      found.selected = half_way;
  return found;
}

FoundNearest Finder::find(std::span<const double> x,
                          std::span<const double> points,
                          std::span<const double> normals,
                          std::span<const double> reach) const
{
  const int gdim = _surface.gdim();
  const auto row = [gdim](std::span<const double> values, std::size_t i)
  {
    Vector<3> v{};
    std::copy_n(values.begin() + i * gdim, gdim, v.begin());
    return v;
  };
  FoundNearest result(reach.size());
  std::int32_t hint = -1;
  for (std::size_t i = 0; i < reach.size(); ++i)
  {
    const FoundPlace found
        = find(x, row(points, i), row(normals, i), reach[i], hint);
    if (!found.nearest)
      continue;
    hint = result.nearest[i] = found.nearest->facet;
    result.distance[i] = norm(found.nearest->d);
    result.size[i] = found.nearest->size;
    if (found.selected)
      result.take(i, *found.selected);
  }
  return result;
}
