// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facet_search.h"
#include "../check.h"
#include "../geometry/gather.h"
#include "../geometry/segment.h"
#include "../math/scales.h"

using namespace contactx;
using namespace contactx::search;

namespace
{
/// Cosine of the angle at which a master facet counts as upright
constexpr double upright_cosine = 0.1;

struct SharedFacet
{
  std::int32_t facet;
  double area;     ///< shared with the slave facet itself
  double distance; ///< where it shares something
};

/// Area of a polygon, or length.
template <int D>
double size_of(const geometry::Overlap<D>& o)
{
  double area = 0;
  integrate(o, 0, [&area](const auto&, double w) { area += w; });
  return area;
}

/// The prism over a slave facet, for boxes.
template <class S>
class Prism
{
public:
  Prism(const geometry::ProjectionPlane<S>& plane,
        const geometry::Overlap<S::tdim>& outline, double low, double high)
      : _plane(plane), _low(low), _high(high)
  {
    _from = _to = outline.corner[0];
    for (int i = 1; i < outline.size; ++i)
      for (int a = 0; a < S::tdim; ++a)
      {
        _from[a] = std::min(_from[a], outline.corner[i][a]);
        _to[a] = std::max(_to[a], outline.corner[i][a]);
      }
  }

  bool meets(const Box& box) const
  {
    Vector<S::gdim> centre, half;
    for (int k = 0; k < S::gdim; ++k)
    {
      if (not(box.lower[k] <= box.upper[k]))
        return false; // empty: positions that are no numbers
      centre[k] = 0.5 * (box.lower[k] + box.upper[k]) - _plane.origin[k];
      half[k] = 0.5 * (box.upper[k] - box.lower[k]);
    }
    const auto apart = [&](const Vector<S::gdim>& axis, double from, double to)
    {
      double reach = 0;
      for (int k = 0; k < S::gdim; ++k)
        reach += std::abs(axis[k]) * half[k];
      const double at = dot(axis, centre);
      return at + reach < from or at - reach > to;
    };
    for (int a = 0; a < S::tdim; ++a)
      if (apart(_plane.dual[a], _from[a], _to[a]))
        return false;
    return !apart(_plane.conormal, _low, _high);
  }

private:
  const geometry::ProjectionPlane<S>& _plane;
  double _low, _high;
  geometry::Local<S> _from, _to;
};

/// Distance of a facet, in the middle of what it shares.
template <class M>
double distance_at(const geometry::Overlap<M::tdim>& part,
                   const geometry::Flat<M>& r, const Vector<M::nodes>& height)
{
  geometry::Local<M> middle{};
  for (int i = 0; i < part.size; ++i)
    middle = middle + (1.0 / part.size) * part.corner[i];
  return std::abs(dot(geometry::InverseMap<M>(r).at(middle).N, height));
}

/// Where several layers are found, keep the nearest ones, as far as connected.
/// What lies beside the slave facet connects no layers, but goes with them.
void keep_nearest(std::vector<SharedFacet>& found, double area,
                  const Surface& master)
{
  double total = 0;
  for (const SharedFacet& f : found)
    total += f.area;
  if (total <= (1 + math::negligible_part) * area)
    return;
  const auto share_a_node = [&master](std::int32_t a, std::int32_t b)
  {
    const auto facets = master.facets();
    return std::ranges::any_of(
        facets[a], [nodes = facets[b]](std::int32_t node)
        { return std::ranges::find(nodes, node) != nodes.end(); });
  };
  const auto gather = [&share_a_node](std::vector<SharedFacet>& layer,
                                      std::vector<SharedFacet>& from)
  {
    for (std::size_t i = 0; i < layer.size(); ++i)
      std::erase_if(from,
                    [&](const SharedFacet& f)
                    {
                      if (!share_a_node(layer[i].facet, f.facet))
                        return false;
                      layer.push_back(f);
                      return true;
                    });
  };
  const auto border
      = std::partition(found.begin(), found.end(),
                       [](const SharedFacet& f) { return f.area > 0; });
  std::vector<SharedFacet> beside(border, found.end());
  found.erase(border, found.end());
  std::ranges::sort(found, {}, &SharedFacet::distance);
  std::vector<SharedFacet> kept, left;
  total = 0;
  while (!found.empty())
  {
    // A layer: what is connected with the nearest facet that is left
    std::vector<SharedFacet> layer{found.front()};
    found.erase(found.begin());
    gather(layer, found);
    double more = 0;
    for (const SharedFacet& f : layer)
      more += f.area;
    const bool fits
        = kept.empty() or total + more <= (1 + math::negligible_part) * area;
    if (fits)
      total += more;
    auto& side = fits ? kept : left;
    side.insert(side.end(), layer.begin(), layer.end());
  }
  gather(kept, beside);
  gather(left, beside);
  kept.insert(kept.end(), beside.begin(), beside.end());
  found = std::move(kept);
}
} // namespace

FacetSearch::FacetSearch(std::vector<std::int32_t> slave_offsets,
                         std::vector<std::int32_t> slave_nodes,
                         std::vector<std::int32_t> master_offsets,
                         std::vector<std::int32_t> master_nodes, int gdim)
    : _slave(std::move(slave_offsets), std::move(slave_nodes), gdim),
      _master(std::move(master_offsets), std::move(master_nodes), gdim)
{
}

geometry::FacetPairs FacetSearch::find(std::span<const double> x, double reach,
                                       double margin, bool all_layers,
                                       std::span<const double> along)
{
  check::rows(along.empty() ? slave().size() : along.size() / 3, slave().size(),
              1, "along", "slave facet");
  if (!_tree)
    _tree.emplace(_master.boxes(x));
  else
    _tree->refit([this, x](std::int32_t f) { return _master.box(f, x); });
  geometry::FacetPairs pairs;
  std::vector<SharedFacet> found;
  for (std::int32_t f = 0; f < slave().size(); ++f)
  {
    found.clear();
    geometry::visit(
        static_cast<int>(slave()[f].size()),
        [&]<class S>(S)
        {
          const auto xs = geometry::gather<S>(slave()[f], x);
          geometry::ProjectionPlane<S> plane(xs);
          if (not along.empty())
          {
            Vector<S::gdim> direction;
            for (int k = 0; k < S::gdim; ++k)
              direction[k] = -along[3 * std::size_t(f) + k];
            // Zero where nothing is in front
            if (dot(direction, plane.n) > 0)
              plane = {xs, direction};
          }
          if (not std::isfinite(plane.n[0]))
            return;
          const geometry::Overlap<S::tdim> outline
              = geometry::outline<S>(geometry::project<S>(plane, xs));
          geometry::Overlap<S::tdim> wide = outline;
          geometry::Local<S> middle{};
          for (int i = 0; i < outline.size; ++i)
            middle = middle + (1.0 / outline.size) * outline.corner[i];
          for (int i = 0; i < wide.size; ++i)
            wide.corner[i]
                = wide.corner[i] + margin * (outline.corner[i] - middle);
          double low = 0, high = 0;
          for (const auto& p : xs)
          {
            low = std::min(low, plane.height(p));
            high = std::max(high, plane.height(p));
          }
          const Prism<S> prism(plane, wide, low - reach, high + reach);
          const auto look = [&]<class M>(std::int32_t m, M)
          {
            const auto xm = geometry::gather<M>(master()[m], x);
            if (not(dot(geometry::frame<M>(xm, geometry::plane_origin<M>()).n,
                        plane.n)
                    < -upright_cosine))
              return;
            Vector<M::nodes> height;
            for (int l = 0; l < M::nodes; ++l)
              height[l] = plane.height(xm[l]);
            const auto [nearest, farthest] = std::ranges::minmax(height);
            if (nearest - high > reach or farthest - low < -reach)
              return;
            const geometry::Flat<M> r = geometry::project<M>(plane, xm);
            if (!geometry::is_convex<M>(r)
                or !geometry::InverseMap<M>(r).exists())
              return;
            const auto shape = geometry::outline<M>(r);
            if (not(size_of(geometry::clip(shape, wide)) > 0))
              return;
            const auto part = geometry::clip(shape, outline);
            const double area = size_of(part);
            found.push_back(
                {m, area, area > 0 ? distance_at<M>(part, r, height) : 0});
          };
          _tree->for_each([&prism](const Box& box) { return prism.meets(box); },
                          [&](std::int32_t m)
                          {
                            geometry::visit(
                                static_cast<int>(master()[m].size()),
                                [&]<class M>(M kind)
                                {
                                  if constexpr (M::gdim == S::gdim)
                                    look(m, kind);
                                });
                          });
          if (!all_layers)
            keep_nearest(found, size_of(outline), _master);
        });
    std::ranges::sort(found, {}, &SharedFacet::facet);
    for (const SharedFacet& m : found)
    {
      pairs.slave.push_back(f);
      pairs.master.push_back(m.facet);
    }
  }
  return pairs;
}

bool contactx::search::contains(const geometry::FacetPairs& all,
                                const geometry::FacetPairs& part)
{
  std::size_t j = 0;
  for (std::size_t i = 0; i < part.size(); ++i)
  {
    while (j < all.size()
           and (all.slave[j] < part.slave[i]
                or (all.slave[j] == part.slave[i]
                    and all.master[j] < part.master[i])))
      ++j;
    if (j == all.size() or all.slave[j] != part.slave[i]
        or all.master[j] != part.master[i])
      return false;
  }
  return true;
}
