// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "finder.h"
#include "bisector.h"

using namespace contactx;
using namespace contactx::search;

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

Found Finder::find(std::span<const double> x, const Vector<3>& p,
                   const Vector<3>& normal, double reach,
                   std::int32_t hint) const
{
  Found found;
  found.nearest = nearest_facet(_surface, *_tree, x, p, normal, reach, hint);
  if (found.nearest)
    found.selected = select(_surface, x, p, *found.nearest);
  if (found.selected and found.selected->feature == facet::interior)
    if (const auto half_way = bisector(_surface, x, p, *found.selected))
      found.selected = half_way;
  return found;
}
