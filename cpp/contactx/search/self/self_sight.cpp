// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "self_sight.h"
#include "../../geometry/facets.h"
#include "../../math/scales.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// Depth of a node behind a facet, over the body's thickness there, up to which
/// it has come through that facet
constexpr double passed_fraction = 0.5;
/// Largest cosine between the normals of a node and of a facet on the far side
/// of its body: no passage through a right angle that becomes less than one
constexpr double far_side_cosine = 0.5;
/// Largest distance of the edge of a valley that a node is behind, over its
/// height: farther away the candidates end, not the valley
constexpr double valley_distance_ratio = 2;

std::vector<std::int32_t> copy(std::span<const std::int32_t> values)
{
  return {values.begin(), values.end()};
}
} // namespace

SelfSight::SelfSight(std::shared_ptr<const mesh::Halo> halo,
                     const geometry::FacetList& own,
                     std::span<const std::int64_t> body,
                     std::optional<double> excluded)
    : _surface(halo, own), _gdim(halo->gdim()),
      _reference(_surface.gathered(halo->reference(), _gdim)), _x0(_reference),
      _x(_reference),
      _normal0(geometry::nodal_normals(_surface.facets(), _reference, _gdim)),
      _normal(_normal0),
      _thickness(_surface.num_nodes(), std::numeric_limits<double>::infinity()),
      _body(_surface.gathered(body, 1)),
      _finder(copy(_surface.facets().offsets), copy(_surface.facets().nodes),
              _gdim),
      _order(_surface.facets(), _reference, _gdim),
      _neighbours(_surface.num_nodes())
{
  _finder.refit(_x);
  find_neighbours(excluded);
  find_thickness();
}

void SelfSight::find_neighbours(std::optional<double> excluded)
{
  const geometry::FacetList facets = _surface.facets();
  std::vector<std::vector<std::int32_t>> at(_surface.num_nodes());
  for (std::int32_t f = 0; f < facets.size(); ++f)
    for (const std::int32_t node : facets[f])
      at[node].push_back(f);
  const std::optional<EdgePaths> paths
      = excluded
            ? std::optional<EdgePaths>(std::in_place, facets, _reference, _gdim)
            : std::nullopt;
  for (const std::int32_t node : _surface.owned())
  {
    std::vector<std::int32_t> found = at[node];
    if (paths)
      for (const auto& [length, other] : paths->from(node, *excluded))
        found.insert(found.end(), at[other].begin(), at[other].end());
    else
      for (const std::int32_t f : at[node])
        for (const std::int32_t other : facets[f])
          found.insert(found.end(), at[other].begin(), at[other].end());
    _neighbours[node] = sorted_unique(found);
  }
}

void SelfSight::find_thickness()
{
  std::int32_t hint = -1;
  for (const std::int32_t node : _surface.owned())
  {
    const Vector<3> normal = vector_at(_normal, node, _gdim);
    const auto is_far_side = [&](const Projection& q)
    {
      return q.gap < 0 and dot(q.normal, normal) < far_side_cosine
             and _body[_surface.facets()[q.facet][0]] == _body[node]
             and std::ranges::find(_surface.facets()[q.facet], node)
                     == _surface.facets()[q.facet].end();
    };
    // Facets of any normal
    const FoundPlace found = _finder.find(
        _reference, vector_at(_reference, node, _gdim), {},
        std::numeric_limits<double>::infinity(), hint, is_far_side);
    if (not found.nearest)
      continue;
    hint = found.nearest->facet;
    _thickness[node] = norm(found.nearest->d);
  }
}

void SelfSight::refit(std::span<const double> x0, std::span<const double> x)
{
  _x0 = _surface.gathered(x0, _gdim);
  _x = _surface.gathered(x, _gdim);
  _normal0 = geometry::nodal_normals(_surface.facets(), _x0, _gdim);
  _normal = geometry::nodal_normals(_surface.facets(), _x, _gdim);
  _finder.refit(_x);
  _moved = 0;
  for (std::size_t i = 0; i < _x.size(); i += _gdim)
    _moved = std::max(_moved, norm(vector_at(_x, i / _gdim, _gdim)
                                   - vector_at(_x0, i / _gdim, _gdim)));
}

bool SelfSight::sees(std::int32_t node, const Vector<3>& normal,
                     const Projection& q) const
{
  if (std::ranges::binary_search(_neighbours[node], q.facet))
    return false;
  const double slack = math::negligible_part * q.size;
  if (q.gap >= 0)
    return dot(normal, q.d) <= slack;
  if (norm(q.d) <= passed_fraction * _thickness[node])
    return true;
  const SurfacePoint foot = point_at(_finder.surface(), q.facet, _x0, q.xi);
  const Vector<3> d0 = vector_at(_x0, node, _gdim) - foot.x,
                  normal0 = vector_at(_normal0, node, _gdim);
  return dot(foot.normal, normal0) < 0 and dot(foot.normal, d0) >= -slack
         and dot(normal0, d0) <= slack;
}

FoundPlace SelfSight::find(std::int32_t node, double reach,
                           std::int32_t hint) const
{
  const Vector<3> p = vector_at(_x, node, _gdim),
                  normal = vector_at(_normal, node, _gdim);
  const View view{passed_fraction * _thickness[node], _moved,
                  norm(normal - vector_at(_normal0, node, _gdim)),
                  math::negligible_part};
  FoundPlace found = _finder.find(
      _x, p, normal, reach, hint,
      [&](const Projection& q) { return sees(node, normal, q); }, view);
  if (found.selected and found.selected->excess > geometry::facet_margin
      and found.selected->feature == geometry::interior
      and norm(found.nearest->d)
              > valley_distance_ratio * std::abs(found.selected->gap))
    found.selected = std::nullopt;
  return found;
}

bool SelfSight::is_slave(std::int32_t node, const Projection& at) const
{
  const auto nodes = _surface.facets()[at.facet];
  return geometry::visit(nodes.size(),
                         [&]<class F>(F)
                         {
                           geometry::Local<F> xi;
                           std::copy_n(at.xi.begin(), F::tdim, xi.begin());
                           const auto weights = F::shape(xi);
                           return _order.is_after(node, nodes, weights);
                         });
}
