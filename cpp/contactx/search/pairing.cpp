// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "pairing.h"
#include "../geometry/facets.h"
#include "../geometry/gather.h"
#include "order.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// Returns to a facet after which a pair is frozen
constexpr std::int8_t max_returns = 2;

/// Marks a slave node that has not changed its facet in this step
constexpr std::int32_t no_facet_left = -2;
} // namespace

Pairing::Pairing(std::vector<std::int32_t> slave_offsets,
                 std::vector<std::int32_t> slave_nodes,
                 std::vector<std::int32_t> master_offsets,
                 std::vector<std::int32_t> master_nodes, int gdim,
                 std::int32_t num_owned)
    : _slave_offsets(std::move(slave_offsets)),
      _slave_nodes(std::move(slave_nodes)),
      _slaves(sorted_unique(_slave_nodes)),
      _num_slave_nodes(_slaves.empty() ? 0 : _slaves.back() + 1),
      _finder(std::move(master_offsets), std::move(master_nodes), gdim)
{
  _slaves.erase(std::ranges::lower_bound(_slaves, num_owned), _slaves.end());
  _facet.assign(_slaves.size(), -1);
  _feature.assign(_slaves.size(), geometry::interior);
  _xi.assign(2 * _slaves.size(), 0);
  _cone.assign(3 * _slaves.size(), 0);
  _normal.assign(3 * _slaves.size(), 0);
  begin_step();
}

void Pairing::begin_step()
{
  _left.assign(_slaves.size(), no_facet_left);
  _returns.assign(_slaves.size(), 0);
}

void Pairing::restore(std::span<const std::int32_t> facet,
                      std::span<const std::int32_t> feature,
                      std::span<const double> xi, std::span<const double> cone,
                      std::span<const double> normal)
{
  if (facet.size() != _facet.size() or feature.size() != _feature.size()
      or xi.size() != _xi.size() or cone.size() != _cone.size()
      or normal.size() != _normal.size())
    throw std::invalid_argument("pairs of another number of slave nodes");
  const geometry::FacetList facets = master().facets();
  const auto num_facets = static_cast<std::int32_t>(facets.size());
  for (std::size_t i = 0; i < facet.size(); ++i)
  {
    if (facet[i] < -1 or facet[i] >= num_facets)
      throw std::invalid_argument("a pair with a facet that does not exist");
    // As many vertices as edges; in 2D a facet is an edge itself
    std::ptrdiff_t features = geometry::interior;
    if (facet[i] >= 0)
      features += (master().gdim() - 1) * std::ssize(facets[facet[i]]);
    if (feature[i] < geometry::interior or feature[i] > features)
      throw std::invalid_argument("a pair on a feature that does not exist");
  }
  std::ranges::copy(facet, _facet.begin());
  std::ranges::copy(feature, _feature.begin());
  std::ranges::copy(xi, _xi.begin());
  std::ranges::copy(cone, _cone.begin());
  std::ranges::copy(normal, _normal.begin());
  begin_step();
}

void Pairing::set_master(std::vector<std::int32_t> offsets,
                         std::vector<std::int32_t> nodes)
{
  _finder = Finder(std::move(offsets), std::move(nodes), master().gdim());
}

/// Projection of a node on its facet, if the facet extended by the margin, and
/// no farther away than the reach, holds it or the pair is frozen.
std::optional<Projection> Pairing::in_margin(std::span<const double> x,
                                             std::size_t i, double reach) const
{
  if (_facet[i] < 0 or _feature[i] != geometry::interior)
    return std::nullopt;
  const auto q = extended(master(), _facet[i], x,
                          vector_at(x, _slaves[i], master().gdim()));
  if (q
      and (_returns[i] >= max_returns
           or (q->excess <= geometry::facet_margin
               and std::abs(q->gap) <= reach)))
    return q;
  return std::nullopt;
}

std::optional<Projection> Pairing::keep(std::span<const double> x,
                                        std::size_t i, double reach) const
{
  const auto q = in_margin(x, i, reach);
  // Away from its facet a node may have come close to another one
  if (q and (_returns[i] >= max_returns or std::abs(q->gap) <= q->size))
    return q;
  return std::nullopt;
}

/// Projection of a node on its facet where this is as near as another one but
/// for the margin. Far in front of the edge of two facets either will do, but
/// what flows across the gap must not jump from iterate to iterate.
std::optional<Projection> Pairing::as_near(std::span<const double> x,
                                           std::size_t i, std::int32_t other,
                                           double reach) const
{
  const auto mine = in_margin(x, i, reach);
  if (!mine or mine->gap <= 0)
    return std::nullopt;
  const auto theirs
      = closest(master(), other, x, vector_at(x, _slaves[i], master().gdim()));
  if (theirs
      and mine->gap > norm(theirs->d) + geometry::facet_margin * mine->size)
    return std::nullopt;
  return mine;
}

void Pairing::set(std::size_t i, const std::optional<Projection>& q,
                  std::span<const double> x)
{
  _facet[i] = q ? q->facet : -1;
  _feature[i] = q ? q->feature : geometry::interior;
  if (!q)
    return;
  std::copy(q->xi.begin(), q->xi.end(), _xi.begin() + 2 * i);
  std::copy(q->normal.begin(), q->normal.end(), _normal.begin() + 3 * i);
  Vector<3> c{};
  if (q->feature != geometry::interior)
    c = cone_components(master(), x, *q);
  std::copy(c.begin(), c.end(), _cone.begin() + 3 * i);
}

std::vector<std::int32_t> Pairing::seek(std::span<const double> x, double reach)
{
  if (_order.empty())
    _order = spatial_order(_slaves, x, master().gdim());
  std::vector<std::int32_t> left;
  for (const std::int32_t i : _order)
  {
    const auto kept = keep(x, i, reach);
    if (kept)
      set(i, kept, x);
    else if (_returns[i] < max_returns)
      left.push_back(i);
  }
  return left;
}

/// Whether a node lies on the ridge of its pair, as seen along the pair's
/// normal: away from it the normal may be none of the cone any more.
bool Pairing::is_on_ridge(std::size_t i, const Projection& q,
                          std::span<const double> x) const
{
  const Vector<3> c = cone_components(master(), x, q);
  double cosine = 0;
  for (int k = 0; k < 3; ++k)
    cosine += c[k] * _cone[3 * i + k];
  const double beside = q.gap * std::sqrt(std::max(0., 1 - cosine * cosine));
  return beside <= geometry::facet_margin * q.size;
}

bool Pairing::accept_projection(std::int32_t i,
                                const std::optional<Projection>& q,
                                std::span<const double> x, double reach,
                                bool closed)
{
  const std::int32_t now = q ? q->facet : -1;
  if (now >= 0 and now != _facet[i])
    if (const auto mine = as_near(x, i, now, reach))
    {
      set(i, mine, x);
      return false;
    }
  const bool same = now == _facet[i] and (!q or q->feature == _feature[i]);
  // On a ridge any normal of the cone will do, but it must not wander
  if (same and closed and q and q->feature != geometry::interior
      and is_on_ridge(i, *q, x))
    return false;
  // One that came off the surface while in contact comes back open
  const bool back = _facet[i] < 0 and now == _left[i] and now >= 0;
  const bool changed = !same and closed and !back;
  if (changed)
  {
    if (now == _left[i] and ++_returns[i] >= max_returns)
    {
      if (const auto frozen = keep(x, i, reach))
        set(i, frozen, x);
      return false;
    }
    _left[i] = _facet[i];
  }
  _returns[i] += back;
  set(i, q, x);
  return changed;
}

std::int32_t Pairing::update(std::span<const double> x, double reach,
                             std::span<const std::int8_t> closed)
{
  const std::vector<std::int32_t> left = seek(x, reach);
  if (left.empty())
    return 0;
  _finder.refit(x);
  const std::vector<double> normals = geometry::nodal_normals(
      {_slave_offsets, _slave_nodes}, x, master().gdim());
  std::int32_t changed = 0, hint = -1;
  for (const std::int32_t i : left)
  {
    if (_facet[i] >= 0)
      hint = _facet[i];
    const auto found = _finder.find(
        x, vector_at(x, _slaves[i], master().gdim()),
        vector_at(normals, _slaves[i], master().gdim()), reach, hint);
    if (found.nearest)
      hint = found.nearest->facet;
    changed += accept_projection(i, found.selected, x, reach, closed[i]);
  }
  return changed;
}

std::vector<std::int32_t> Pairing::frozen() const
{
  std::vector<std::int32_t> result;
  for (std::size_t i = 0; i < _slaves.size(); ++i)
    if (_returns[i] >= max_returns)
      result.push_back(static_cast<std::int32_t>(i));
  return result;
}
