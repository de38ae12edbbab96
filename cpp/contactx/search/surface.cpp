// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "surface.h"
#include "../facet/closest_point.h"
#include "../facet/gather.h"
#include <stdexcept>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// The facet's area, relative to its diameter, below which it has no normal
constexpr double degenerate = 1e-14;

/// Local node numbers of a feature of a facet with `num_nodes` nodes.
std::vector<int> feature_nodes(int num_nodes, int feature)
{
  return facet::visit(num_nodes,
                      [feature]<class F>(F) -> std::vector<int>
                      {
                        if (feature == facet::interior)
                          return {};
                        if (F::num_edges > 0 and feature <= F::num_edges)
                        {
                          const auto [i, j] = F::edges[feature - 1];
                          return {i, j};
                        }
                        return {feature - 1 - F::num_edges};
                      });
}

template <std::size_t D>
Vec<3> pad(const std::array<double, D>& a)
{
  Vec<3> b{};
  std::copy(a.begin(), a.end(), b.begin());
  return b;
}

template <class F>
Vec<F::gdim> unpad(const Vec<3>& a)
{
  Vec<F::gdim> b;
  std::copy_n(a.begin(), F::gdim, b.begin());
  return b;
}

template <class F>
std::optional<Projection> make(std::int32_t f, const facet::Nodes<F>& x,
                               const Vec<F::gdim>& d, int feature,
                               const facet::Local<F>& xi)
{
  const auto fr = facet::frame<F>(x, xi);
  const double size = facet::diameter<F>(x);
  if (!(fr.jacobian > degenerate * (F::gdim == 2 ? size : size * size)))
    return std::nullopt;
  Projection q{f,   feature, {}, pad(d), pad(fr.n), dot(fr.n, d), F::excess(xi),
               size};
  std::copy(xi.begin(), xi.end(), q.xi.begin());
  return q;
}
} // namespace

Surface::Surface(std::vector<std::int32_t> offsets,
                 std::vector<std::int32_t> nodes, int gdim)
    : _gdim(gdim), _offsets(std::move(offsets)), _nodes(std::move(nodes)),
      _vertices(_nodes)
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

  std::ranges::sort(_vertices);
  _vertices.erase(std::unique(_vertices.begin(), _vertices.end()),
                  _vertices.end());
  std::vector<std::int32_t> position(_nodes.size());
  _star_offsets.assign(_vertices.size() + 1, 0);
  for (std::size_t i = 0; i < _nodes.size(); ++i)
  {
    position[i]
        = std::ranges::lower_bound(_vertices, _nodes[i]) - _vertices.begin();
    ++_star_offsets[position[i] + 1];
  }
  for (std::size_t v = 0; v < _vertices.size(); ++v)
    _star_offsets[v + 1] += _star_offsets[v];
  _stars.resize(_nodes.size());
  std::vector<std::int32_t> next(_star_offsets);
  for (std::int32_t f = 0; f < facets().size(); ++f)
    for (std::int32_t i = _offsets[f]; i < _offsets[f + 1]; ++i)
      _stars[next[position[i]]++] = f;
}

std::vector<std::int32_t> Surface::star(std::int32_t f,
                                        std::span<const int> local) const
{
  if (local.empty())
    return {f};
  const auto nodes = facets()[f];
  const std::size_t v = std::ranges::lower_bound(_vertices, nodes[local[0]])
                        - _vertices.begin();
  std::vector<std::int32_t> result;
  for (std::int32_t i = _star_offsets[v]; i < _star_offsets[v + 1]; ++i)
  {
    const auto other = facets()[_stars[i]];
    if (std::ranges::all_of(
            local, [&other, &nodes](int l)
            { return std::ranges::find(other, nodes[l]) != other.end(); }))
      result.push_back(_stars[i]);
  }
  return result;
}

std::vector<std::int32_t> Surface::star(std::int32_t f, int feature) const
{
  return star(f, feature_nodes(facets()[f].size(), feature));
}

bool Surface::on_boundary(std::int32_t f, int feature) const
{
  const std::vector<int> local = feature_nodes(facets()[f].size(), feature);
  if (local.empty())
    return false;
  if (local.size() == 2 or _gdim == 2)
    return star(f, local).size() < 2;
  // A vertex is on the boundary where an edge at it has one facet only
  const std::int32_t vertex = facets()[f][local[0]];
  for (std::int32_t g : star(f, local))
  {
    const auto nodes = facets()[g];
    const bool open = facet::visit(
        nodes.size(),
        [this, nodes, g, vertex]<class F>(F)
        {
          return std::ranges::any_of(
              F::edges,
              [this, nodes, g, vertex](auto e)
              {
                const std::array<int, 2> ij{e.first, e.second};
                return (nodes[e.first] == vertex or nodes[e.second] == vertex)
                       and star(g, ij).size() < 2;
              });
        });
    if (open)
      return true;
  }
  return false;
}

std::vector<Box> Surface::boxes(std::span<const double> x) const
{
  std::vector<Box> boxes(facets().size(), Box::empty());
  for (std::int32_t f = 0; f < facets().size(); ++f)
    for (std::int32_t node : facets()[f])
      boxes[f].add(_gdim == 2 ? pad(facet::point<2>(node, x))
                              : facet::point<3>(node, x));
  return boxes;
}

std::optional<Projection> contactx::search::closest(const Surface& surface,
                                                    std::int32_t f,
                                                    std::span<const double> x,
                                                    const Vec<3>& p)
{
  const auto nodes = surface.facets()[f];
  return facet::visit(nodes.size(),
                      [=]<class F>(F) -> std::optional<Projection>
                      {
                        const auto xf = facet::gather<F>(nodes, x);
                        const auto q = unpad<F>(p);
                        const auto c = facet::closest_point<F>(xf, q);
                        if (!std::isfinite(c.distance2))
                          return std::nullopt;
                        return make<F>(f, xf, c.d, c.feature, c.xi);
                      });
}

std::optional<Projection> contactx::search::extended(const Surface& surface,
                                                     std::int32_t f,
                                                     std::span<const double> x,
                                                     const Vec<3>& p)
{
  const auto nodes = surface.facets()[f];
  return facet::visit(nodes.size(),
                      [=]<class F>(F) -> std::optional<Projection>
                      {
                        const auto xf = facet::gather<F>(nodes, x);
                        const auto q = unpad<F>(p);
                        facet::Local<F> xi = facet::projection_start<F>(xf, q);
                        if (!facet::project<F>(xf, q, xi))
                          return std::nullopt;
                        const auto foot = facet::combine<F>(F::shape(xi), xf);
                        return make<F>(f, xf, q - foot, facet::interior, xi);
                      });
}

SurfacePoint contactx::search::point_at(const Surface& surface, std::int32_t f,
                                        std::span<const double> x,
                                        const Vec<2>& xi)
{
  const auto nodes = surface.facets()[f];
  return facet::visit(nodes.size(),
                      [nodes, x, &xi]<class F>(F)
                      {
                        const auto xf = facet::gather<F>(nodes, x);
                        facet::Local<F> local;
                        std::copy_n(xi.begin(), F::tdim, local.begin());
                        const auto at = facet::combine<F>(F::shape(local), xf);
                        const auto n = facet::frame<F>(xf, local).n;
                        return SurfacePoint{pad(at), pad(n)};
                      });
}
