// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "surface.h"
#include "../geometry/closest_point.h"
#include "../geometry/gather.h"
#include "../math/scales.h"
#include <stdexcept>

using namespace contactx;
using namespace contactx::search;

namespace
{
template <std::size_t D>
Vector<3> pad(const std::array<double, D>& a)
{
  Vector<3> b{};
  std::copy(a.begin(), a.end(), b.begin());
  return b;
}

template <class F>
Vector<F::gdim> unpad(const Vector<3>& a)
{
  Vector<F::gdim> b;
  std::copy_n(a.begin(), F::gdim, b.begin());
  return b;
}

template <class F>
std::optional<Projection> make(std::int32_t f, const geometry::Nodes<F>& x,
                               const Vector<F::gdim>& d, int feature,
                               const geometry::Local<F>& xi)
{
  const auto fr = geometry::frame<F>(x, xi);
  const double size = geometry::diameter<F>(x);
  if (!(fr.jacobian > math::round_off * (F::gdim == 2 ? size : size * size)))
    return std::nullopt;
  Projection q{f,   feature, {}, pad(d), pad(fr.n), dot(fr.n, d), F::excess(xi),
               size};
  std::copy(xi.begin(), xi.end(), q.xi.begin());
  return q;
}
} // namespace

Surface::Surface(std::vector<std::int32_t> offsets,
                 std::vector<std::int32_t> nodes, int gdim)
    : _gdim(gdim), _offsets(std::move(offsets)), _nodes(std::move(nodes))
{
  if (_offsets.empty() or _offsets.back() != std::ssize(_nodes))
    throw std::invalid_argument("offsets must end at the number of nodes");
  for (std::int32_t f = 0; f < facets().size(); ++f)
  {
    const std::size_t n = facets()[f].size();
    if (gdim == 2 ? n != 2 : (n != 3 and n != 4))
      throw std::invalid_argument("a facet has two nodes in 2D, and three or "
                                  "four in 3D");
  }

  const std::vector<std::int32_t> vertices = sorted_unique(_nodes);
  if (!vertices.empty())
    _num_nodes = vertices.back() + 1;
  std::vector<std::int32_t> place(_num_nodes);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    place[vertices[v]] = static_cast<std::int32_t>(v);
  _vertex.resize(_nodes.size());
  _star_offsets.assign(vertices.size() + 1, 0);
  for (std::size_t i = 0; i < _nodes.size(); ++i)
  {
    _vertex[i] = place[_nodes[i]];
    ++_star_offsets[_vertex[i] + 1];
  }
  for (std::size_t v = 0; v < vertices.size(); ++v)
    _star_offsets[v + 1] += _star_offsets[v];
  _stars.resize(_nodes.size());
  std::vector<std::int32_t> next(_star_offsets);
  for (std::int32_t f = 0; f < facets().size(); ++f)
    for (std::int32_t i = _offsets[f]; i < _offsets[f + 1]; ++i)
      _stars[next[_vertex[i]]++] = f;
}

Surface::Ends Surface::feature_ends(int num_nodes, int feature)
{
  return geometry::visit(num_nodes,
                         [feature]<class F>(F) -> Ends
                         {
                           if (F::num_edges > 0 and feature <= F::num_edges)
                             return F::edges[feature - 1];
                           const int vertex = feature - 1 - F::num_edges;
                           return {vertex, vertex};
                         });
}

std::int32_t Surface::count_at(std::int32_t f, const Ends& ends) const
{
  std::int32_t n = 0;
  for_each_at(f, ends, [&n](std::int32_t) { ++n; });
  return n;
}

std::vector<std::int32_t> Surface::star(std::int32_t f, int feature) const
{
  std::vector<std::int32_t> result;
  for_each_around(f, feature,
                  [&result](std::int32_t g) { result.push_back(g); });
  return result;
}

bool Surface::on_boundary(std::int32_t f, int feature) const
{
  if (feature == geometry::interior)
    return false;
  const Ends ends = feature_ends(facets()[f].size(), feature);
  if (ends.first != ends.second or _gdim == 2)
    return count_at(f, ends) < 2;
  // A vertex is on the boundary where an edge at it has one facet only
  const std::int32_t vertex = facets()[f][ends.first];
  bool open = false;
  for_each_at(f, ends,
              [this, vertex, &open](std::int32_t g)
              {
                const auto nodes = facets()[g];
                geometry::visit(nodes.size(),
                                [this, nodes, g, vertex, &open]<class F>(F)
                                {
                                  for (const auto& e : F::edges)
                                    if (nodes[e.first] == vertex
                                        or nodes[e.second] == vertex)
                                      open = open or count_at(g, e) < 2;
                                });
              });
  return open;
}

Box Surface::box(std::int32_t f, std::span<const double> x) const
{
  Box box = Box::empty();
  for (std::int32_t node : facets()[f])
    box.add(_gdim == 2 ? pad(geometry::point<2>(node, x))
                       : geometry::point<3>(node, x));
  return box;
}

std::vector<Box> Surface::boxes(std::span<const double> x) const
{
  std::vector<Box> boxes(facets().size());
  for (std::int32_t f = 0; f < facets().size(); ++f)
    boxes[f] = box(f, x);
  return boxes;
}

std::vector<std::int32_t>
contactx::search::sorted_unique(std::span<const std::int32_t> nodes)
{
  std::vector<std::int32_t> result;
  if (nodes.empty())
    return result;
  // Marks, not a sort: they are the numbers of a mesh's nodes
  std::vector<bool> marked(std::ranges::max(nodes) + 1, false);
  for (std::int32_t node : nodes)
    marked[node] = true;
  for (std::size_t node = 0; node < marked.size(); ++node)
    if (marked[node])
      result.push_back(static_cast<std::int32_t>(node));
  return result;
}

std::optional<Projection> contactx::search::closest(const Surface& surface,
                                                    std::int32_t f,
                                                    std::span<const double> x,
                                                    const Vector<3>& p)
{
  return closest_within(surface, f, x, p,
                        std::numeric_limits<double>::infinity());
}

std::optional<Projection>
contactx::search::closest_within(const Surface& surface, std::int32_t f,
                                 std::span<const double> x, const Vector<3>& p,
                                 double bound2)
{
  const auto nodes = surface.facets()[f];
  return geometry::visit(nodes.size(),
                         [=]<class F>(F) -> std::optional<Projection>
                         {
                           const auto xf = geometry::gather<F>(nodes, x);
                           const auto q = unpad<F>(p);
                           const auto c = geometry::closest_point<F>(xf, q);
                           if (!std::isfinite(c.distance2)
                               or c.distance2 > bound2)
                             return std::nullopt;
                           return make<F>(f, xf, c.d, c.feature, c.xi);
                         });
}

std::optional<Projection> contactx::search::extended(const Surface& surface,
                                                     std::int32_t f,
                                                     std::span<const double> x,
                                                     const Vector<3>& p)
{
  const auto nodes = surface.facets()[f];
  return geometry::visit(
      nodes.size(),
      [=]<class F>(F) -> std::optional<Projection>
      {
        const auto xf = geometry::gather<F>(nodes, x);
        const auto q = unpad<F>(p);
        geometry::Local<F> xi = geometry::projection_start<F>(xf, q);
        if (!geometry::project<F>(xf, q, xi))
          return std::nullopt;
        const auto foot = geometry::combine<F>(F::shape(xi), xf);
        return make<F>(f, xf, q - foot, geometry::interior, xi);
      });
}

SurfacePoint contactx::search::point_at(const Surface& surface, std::int32_t f,
                                        std::span<const double> x,
                                        const Vector<2>& xi)
{
  const auto nodes = surface.facets()[f];
  return geometry::visit(nodes.size(),
                         [nodes, x, &xi]<class F>(F)
                         {
                           const auto xf = geometry::gather<F>(nodes, x);
                           geometry::Local<F> local;
                           std::copy_n(xi.begin(), F::tdim, local.begin());
                           const auto at
                               = geometry::combine<F>(F::shape(local), xf);
                           const auto n = geometry::frame<F>(xf, local).n;
                           return SurfacePoint{pad(at), pad(n)};
                         });
}

double contactx::search::outer_margin(const Surface& surface, std::int32_t f,
                                      const Vector<2>& xi)
{
  return geometry::visit(
      surface.facets()[f].size(),
      [&surface, f, &xi]<class F>(F)
      {
        geometry::Local<F> at;
        std::copy_n(xi.begin(), F::tdim, at.begin());
        const auto N = F::shape(at);
        double margin = 1;
        // The functions of an edge's nodes add up to one on it
        if constexpr (F::gdim == 2)
          for (int v = 0; v < F::nodes; ++v)
            margin = surface.on_boundary(f, 1 + v) ? std::min(margin, 1 - N[v])
                                                   : margin;
        else
          for (int e = 0; e < F::num_edges; ++e)
            if (surface.on_boundary(f, 1 + e))
              margin = std::min(margin, 1 - N[F::edges[e].first]
                                            - N[F::edges[e].second]);
        return margin;
      });
}
