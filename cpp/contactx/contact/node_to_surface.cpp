// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "node_to_surface.h"
#include "../geometry/gather.h"
#include "../geometry/sizes.h"
#include "../kernel/layout.h"
#include "../math/scales.h"
#include "../mesh/spread.h"
#include "mobility.h"
#include "touching.h"
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::contact;
using mesh::spread;

namespace
{
std::vector<std::int32_t> copy(std::span<const std::int32_t> values)
{
  return {values.begin(), values.end()};
}
} // namespace

NodeToSurface::NodeToSurface(std::shared_ptr<mesh::Halo> halo,
                             std::shared_ptr<const SlaveNodes> slaves,
                             std::shared_ptr<search::MasterSurface> surface,
                             std::shared_ptr<search::InsideTest> outside,
                             const PairingOptions& options)
    : DeformableMaster(std::move(halo), std::move(slaves), std::move(surface),
                       std::move(outside), options),
      _pairing(copy(_slaves->facets().offsets), copy(_slaves->facets().nodes),
               copy(_surface->facets().offsets), copy(_surface->facets().nodes),
               _halo->gdim(), _halo->num_owned())
{
  const auto reference = _halo->reference();
  _at.assign(reference.begin(), reference.end());
  if (_options.is_smooth)
    _smooth.emplace(*_halo, _surface->own());
  find_places();
}

std::vector<double> NodeToSurface::at_slaves(std::span<const double> x) const
{
  const int g = gdim();
  const auto& slaves = _pairing.slaves();
  std::vector<double> rows(slaves.size() * g);
  for (std::size_t i = 0; i < slaves.size(); ++i)
    std::copy_n(x.begin() + std::size_t(slaves[i]) * g, g,
                rows.begin() + g * i);
  return rows;
}

search::Projections
NodeToSurface::projections(std::span<const double> x,
                           std::span<const double> points) const
{
  return search::projections(_pairing.master(), _pairing.facet(), x, points,
                             _pairing.xi());
}

search::FacetPoints
NodeToSurface::facet_points(std::span<const double> x,
                            std::span<const double> xi) const
{
  return search::facet_points(_pairing.master(), _pairing.facet(), x, xi);
}

std::int32_t NodeToSurface::search(std::span<const double> x,
                                   std::span<const std::int8_t> closed)
{
  const int version = _halo->version();
  std::vector<double> at(x.begin(), x.end());
  std::int32_t changed
      = _surface->pair(_pairing, _slaves->facets(), at, _options.reach, closed);
  _at = _halo->updated(std::move(at), gdim(), version);
  changed += drop_outside(_at, closed);
  find_places();
  return changed;
}

/// Finds where slave nodes are measured: where the search found them, or on the
/// smooth surface but for its edges.
void NodeToSurface::find_places()
{
  _places = {_pairing.feature(),
             _pairing.xi(),
             _pairing.cone(),
             _pairing.normal(),
             {}};
  if (not _smooth)
    return;
  _places.rise.assign(size(), 0);
  const auto reference = _halo->reference();
  const geometry::FacetList facets = _surface->facets();
  for (std::size_t i = 0; i < size(); ++i)
  {
    const std::int32_t f = _pairing.facet()[i];
    if (f < 0)
      continue;
    const geometry::SmoothFacet& smooth = _smooth->of(*_halo, facets[f]);
    const int feature = _pairing.feature()[i];
    if (feature != geometry::interior and smooth.sharp >> (feature - 1) & 1)
      continue;
    geometry::visit(
        static_cast<int>(facets[f].size()),
        [&]<class F>(F)
        {
          if (F::gdim != gdim())
            return;
          geometry::Local<F> xi;
          std::copy_n(_pairing.xi().begin() + 2 * i, F::tdim, xi.begin());
          const auto at = geometry::smooth_projection<F>(
              geometry::gather<F>(facets[f], reference),
              geometry::gather<F>(facets[f], _at), smooth,
              geometry::point<F::gdim>(_pairing.slaves()[i], _at), xi);
          _places.feature[i] = geometry::kept;
          std::ranges::copy(at.xi, _places.xi.begin() + 2 * i);
          std::ranges::copy(at.cone, _places.cone.begin() + 3 * i);
          std::ranges::copy(at.normal, _places.normal.begin() + 3 * i);
          _places.rise[i] = at.rise;
        });
  }
}

/// Drops pairs with facets behind all of the master's body.
std::int32_t NodeToSurface::drop_outside(std::span<const double> x,
                                         std::span<const std::int8_t> closed)
{
  if (_surface->sees_bodies() or not _outside->is_around())
    return 0;
  const int g = gdim();
  const std::size_t n = size();
  const std::vector<double> points = at_slaves(x);
  const auto [foot, normal] = facet_points(x, _pairing.xi());
  const geometry::FacetList facets = _surface->facets();
  const std::vector<double> sizes = geometry::facet_sizes(facets, x, g);
  std::vector<double> depth(n), size(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    for (int k = 0; k < g; ++k)
      depth[i] += normal[g * i + k] * (foot[g * i + k] - points[g * i + k]);
    const std::int32_t f = _pairing.facet()[i];
    size[i] = f < 0 ? std::numeric_limits<double>::infinity() : sizes[f];
  }
  const auto is_outside = _outside->find(x, points, depth, size);
  std::int32_t changed = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (is_outside[i])
      changed += _pairing.accept_projection(static_cast<std::int32_t>(i),
                                            std::nullopt, x, _options.reach,
                                            closed[i] != 0);
  return changed;
}

void NodeToSurface::begin_step()
{
  reset_flips();
  if (not _options.measures_slip)
    return;
  if (_options.is_small)
    _origin.start(moved(_halo->start()->u));
  else
    _start = at_slaves(_halo->start()->x);
}

void NodeToSurface::rebuild()
{
  if (_halo->ranks().size() == 1)
    return;
  const std::vector<std::int32_t> facet = _surface->keep(_pairing.facet());
  restore(facet, saved_pairs());
}

void NodeToSurface::restore(std::span<const std::int32_t> facet,
                            const std::vector<Saved>& saved)
{
  _pairing.set_master(copy(_surface->facets().offsets),
                      copy(_surface->facets().nodes));
  _pairing.restore(facet, values_of<std::int32_t>(saved, "feature"),
                   values_of<double>(saved, "xi"),
                   values_of<double>(saved, "cone"),
                   values_of<double>(saved, "normal"));
}

std::vector<Saved> NodeToSurface::saved_pairs() const
{
  return {{"feature", RowKind::slave, 0, _pairing.feature()},
          {"xi", RowKind::slave, 2, _pairing.xi()},
          {"cone", RowKind::slave, 3, _pairing.cone()},
          {"normal", RowKind::slave, 3, _pairing.normal()}};
}

void NodeToSurface::nodes_changed() { _at = spread(*_halo, _at, gdim()); }

std::vector<std::int8_t> NodeToSurface::paired() const
{
  std::vector<std::int8_t> paired(size());
  std::ranges::transform(_pairing.facet(), paired.begin(),
                         [](std::int32_t f) { return f >= 0; });
  return paired;
}

std::vector<double> NodeToSurface::normals() const
{
  std::vector<double> normals = _places.normal;
  for (std::size_t i = 0; i < size(); ++i)
    if (_pairing.facet()[i] < 0)
      std::fill_n(normals.begin() + 3 * i, 3, 0.0);
  return normals;
}

std::vector<kernel::Pairs> NodeToSurface::pairs() const
{
  using namespace kernel;
  const geometry::FacetList facets = _surface->facets();
  const std::vector<FacetSlip> slips
      = _options.measures_slip ? slip() : std::vector<FacetSlip>();
  std::vector<kernel::Pairs> groups;
  for (int nodes = 2; nodes <= 4; ++nodes)
  {
    kernel::Pairs group;
    group.num_nodes = nodes;
    group.data_size = num_values<FacetPair>;
    group.slip_size = _options.measures_slip ? num_values<FacetSlip> : 0;
    for (std::size_t i = 0; i < size(); ++i)
    {
      const std::int32_t f = _pairing.facet()[i];
      if (f < 0 or std::ssize(facets[f]) != nodes)
        continue;
      group.slaves.push_back(static_cast<std::int32_t>(i));
      group.nodes.push_back(_pairing.slaves()[i]);
      group.nodes.insert(group.nodes.end(), facets[f].begin(), facets[f].end());
      group.add(found_pair(i));
      if (_options.measures_slip)
        group.add_slip(slips[i]);
    }
    if (not group.slaves.empty())
      groups.push_back(std::move(group));
  }
  return groups;
}

kernel::FacetPair NodeToSurface::found_pair(std::size_t i) const
{
  kernel::FacetPair pair{.feature = double(_places.feature[i])};
  std::copy_n(_places.xi.begin() + 2 * i, 2, pair.xi.begin());
  std::copy_n(_places.cone.begin() + 3 * i, 3, pair.cone.begin());
  std::copy_n(_places.normal.begin() + 3 * i, 3, pair.normal.begin());
  return pair;
}

std::vector<kernel::FacetSlip> NodeToSurface::slip() const
{
  const int g = gdim();
  const geometry::FacetList facets = _surface->facets();
  std::vector<kernel::FacetSlip> from(size());
  if (_options.is_small)
  {
    for (std::size_t i = 0; i < size(); ++i)
    {
      std::copy_n(_places.xi.begin() + 2 * i, 2, from[i].xi.begin());
      std::copy_n(_origin.moved().begin() + g * i, g, from[i].origin.begin());
    }
    return from;
  }
  const auto [xi, gap] = projections(_halo->start()->x, _start);
  const auto normal = facet_points(_at, xi).normal;
  for (std::size_t i = 0; i < size(); ++i)
  {
    const std::int32_t f = _pairing.facet()[i];
    const std::size_t nodes = f < 0 ? 0 : facets[f].size();
    std::copy_n(xi.begin() + 2 * i, 2, from[i].xi.begin());
    // It has no part across the normal of a flat facet
    const bool is_flat = _places.feature[i] == geometry::interior and nodes < 4;
    from[i].gap = is_flat ? 0 : gap[i];
    for (int k = 0; k < g; ++k)
      from[i].origin[k] = from[i].gap * normal[g * i + k];
  }
  return from;
}

std::optional<std::vector<double>>
NodeToSurface::turn(std::span<const double> x) const
{
  const std::vector<double>& x0 = _halo->start()->x;
  if (std::ranges::equal(x, x0))
    return std::nullopt;
  const int g = gdim();
  const std::vector<double> before = frames(x0), now = frames(x);
  std::vector<double> turn(size() * g * g, 0);
  for (std::size_t i = 0; i < size(); ++i)
    for (int r = 0; r < g; ++r)
      for (int c = 0; c < g; ++c)
      {
        double& value = turn[g * (g * i + r) + c];
        if (_pairing.facet()[i] < 0)
          value = r == c;
        else
          value = dot(now.data() + g * (g * i + r),
                      before.data() + g * (g * i + c), g);
      }
  return turn;
}

/// Unit normal and directions along each slave node's facet, in columns.
std::vector<double> NodeToSurface::frames(std::span<const double> x) const
{
  const int g = gdim();
  const auto [foot, normal] = facet_points(x, _pairing.xi());
  std::vector<double> beside = _pairing.xi();
  for (std::size_t i = 0; i < size(); ++i)
    beside[2 * i] += 1;
  const auto ahead = facet_points(x, beside).x;
  std::vector<double> frames(size() * g * g);
  for (std::size_t i = 0; i < size(); ++i)
  {
    Vector<3> n{}, along{};
    for (int k = 0; k < g; ++k)
    {
      n[k] = normal[g * i + k];
      along[k] = ahead[g * i + k] - foot[g * i + k];
    }
    along = along - dot(n, along) * n;
    const double length = norm(along);
    if (length > 0)
      for (double& a : along)
        a /= length;
    const std::array columns{n, along, cross(n, along)};
    for (int r = 0; r < g; ++r)
      for (int c = 0; c < g; ++c)
        frames[g * (g * i + r) + c] = columns[c][r];
  }
  return frames;
}

void NodeToSurface::touch(std::span<const std::int8_t> which,
                          std::span<const double> x, std::span<const double> u,
                          std::span<const double> offset)
{
  if (_options.is_small)
  {
    _origin.touch(which, apart(), moved(u), normals(), offset);
    return;
  }
  const int g = gdim();
  const std::vector<double> points = at_slaves(x);
  const std::vector<double>& x0 = _halo->start()->x;
  auto [xi0, gap0] = projections(x0, _start);
  const auto [xi1, gap1] = projections(x, points);
  std::vector<double> part(size());
  for (std::size_t i = 0; i < size(); ++i)
  {
    part[i] = touching(gap0[i] - offset[i], gap1[i] - offset[i]);
    for (int a = 0; a < 2; ++a)
      xi0[2 * i + a] += part[i] * (xi1[2 * i + a] - xi0[2 * i + a]);
  }
  const auto [foot, normal] = facet_points(x0, xi0);
  for (std::size_t i = 0; i < size(); ++i)
    if (which[i])
    {
      const double height = gap0[i] + part[i] * (gap1[i] - gap0[i]);
      for (int k = 0; k < g; ++k)
        _start[g * i + k] = foot[g * i + k] + height * normal[g * i + k];
    }
}

std::optional<std::vector<kernel::Pairs>>
NodeToSurface::update(std::span<const double>, bool, std::span<const double>)
{
  // The kernels project by themselves
  return std::nullopt;
}

std::vector<double>
NodeToSurface::compliance(std::span<const double> nodal) const
{
  _surface->take_compliance(nodal);
  const geometry::FacetList facets = _surface->facets();
  std::vector<double> result(size(), _surface->mean(nodal));
  for (std::size_t i = 0; i < size(); ++i)
    if (const std::int32_t f = _pairing.facet()[i]; f >= 0)
    {
      double sum = 0;
      for (const std::int32_t node : facets[f])
        sum += nodal[node];
      result[i] = sum / static_cast<double>(facets[f].size());
    }
  return result;
}

Mobility NodeToSurface::mobility(std::span<const std::int8_t> free) const
{
  using namespace kernel;
  const int g = gdim();
  Mobility found{std::vector<double>(size(), 1),
                 std::vector<double>(size() * g, 1)};
  if (all_free(_pairing.slaves(), free, g)
      and all_free(_surface->facets().nodes, free, g))
    return found;
  for (const kernel::Pairs& group : pairs())
  {
    const int width = 1 + group.num_nodes;
    std::vector<double> weight(width);
    for (std::size_t p = 0; p < group.size(); ++p)
    {
      const std::size_t i = group.slaves[p];
      const auto nodes = std::span(group.nodes).subspan(width * p, width);
      if (all_free(nodes, free, g))
        continue;
      const auto squares = [&](const double* xi)
      {
        pair_weights(group.num_nodes, xi, weight.data());
        Vector<3> sum{};
        for (int l = 0; l < width; ++l)
          for (int k = 0; k < g; ++k)
            if (free[std::size_t(nodes[l]) * g + k])
              sum[k] += weight[l] * weight[l];
        return sum;
      };
      const auto pair = group.row<FacetPair>(p);
      const Vector<3> square = squares(pair.xi.data());
      double sum = 0;
      for (int k = 0; k < g; ++k)
        sum += pair.normal[k] * pair.normal[k] * square[k];
      found.normal[i] = std::sqrt(sum);
      if (group.slip_size == 0)
        continue;
      const Vector<3> each = squares(group.slip_row<FacetSlip>(p).xi.data());
      for (int k = 0; k < g; ++k)
        found.each[g * i + k] = std::sqrt(each[k]);
    }
  }
  return found;
}

kernel::Weights NodeToSurface::weights() const
{
  const geometry::FacetList facets = _surface->facets();
  kernel::Weights weights;
  // In the order of `pairs`
  for (std::size_t num_nodes = 2; num_nodes <= 4; ++num_nodes)
    for (std::size_t i = 0; i < size(); ++i)
    {
      const std::int32_t f = _pairing.facet()[i];
      if (f < 0 or facets[f].size() != num_nodes)
        continue;
      weights.slaves.insert(weights.slaves.end(), 1 + num_nodes,
                            static_cast<std::int32_t>(i));
      weights.nodes.push_back(_pairing.slaves()[i]);
      weights.nodes.insert(weights.nodes.end(), facets[f].begin(),
                           facets[f].end());
      const std::size_t at = weights.values.size();
      weights.values.resize(at + 1 + num_nodes);
      pair_weights(static_cast<int>(num_nodes), _places.xi.data() + 2 * i,
                   weights.values.data() + at);
    }
  return weights;
}

std::vector<Saved> NodeToSurface::save() const
{
  std::vector<Saved> saved{
      {"facet_nodes", RowKind::slave, 4, _surface->names(_pairing.facet())}};
  for (Saved& s : saved_pairs())
    saved.push_back(std::move(s));
  if (_smooth)
    saved.insert(saved.end(),
                 {{"smooth_feature", RowKind::slave, 0, _places.feature},
                  {"smooth_xi", RowKind::slave, 2, _places.xi},
                  {"smooth_cone", RowKind::slave, 3, _places.cone},
                  {"smooth_normal", RowKind::slave, 3, _places.normal},
                  {"rise", RowKind::slave, 0, _places.rise}});
  if (_options.measures_slip)
  {
    saved.push_back(
        _options.is_small
            ? Saved{"moved", RowKind::slave, gdim(), _origin.moved()}
            : Saved{"start", RowKind::slave, gdim(), _start});
    saved.push_back({"at", RowKind::node, gdim(), _at});
  }
  return saved;
}

void NodeToSurface::load(const std::vector<Saved>& saved)
{
  restore(_surface->named(values_of<std::int64_t>(saved, "facet_nodes")),
          saved);
  load_places(saved);
  if (_options.measures_slip)
  {
    if (_options.is_small)
      _origin.start(values_of<double>(saved, "moved"));
    else
      _start = values_of<double>(saved, "start");
    _at = spread(*_halo, values_of<double>(saved, "at"), gdim());
  }
}

/// Takes where slave nodes are measured from what `save` gave, or as pairs are.
void NodeToSurface::load_places(const std::vector<Saved>& saved)
{
  _places = {_pairing.feature(),
             _pairing.xi(),
             _pairing.cone(),
             _pairing.normal(),
             {}};
  if (_smooth)
    _places = {values_of<std::int32_t>(saved, "smooth_feature"),
               values_of<double>(saved, "smooth_xi"),
               values_of<double>(saved, "smooth_cone"),
               values_of<double>(saved, "smooth_normal"),
               values_of<double>(saved, "rise")};
}

double NodeToSurface::distance(std::span<const double> x) const
{
  return _surface->distance(x, at_slaves(x));
}

std::vector<std::int32_t> NodeToSurface::frozen_pairs() const
{
  return _pairing.frozen();
}

HiddenGap
NodeToSurface::deepest_frozen_pair(std::span<const double> x,
                                   std::span<const std::int8_t> closed) const
{
  const int g = gdim();
  const std::vector<std::int32_t> frozen = _pairing.frozen();
  HiddenGap deepest;
  if (mesh::total(_halo->ranks(), std::int64_t(frozen.size())) == 0)
    return deepest;
  const std::vector<double> nodal
      = geometry::nodal_normals(_slaves->facets(), x, g);
  std::vector<std::int32_t> nodes;
  std::vector<double> normals;
  for (const std::int32_t i : frozen)
  {
    nodes.push_back(_pairing.slaves()[i]);
    const std::size_t at = std::size_t(nodes.back()) * g;
    normals.insert(normals.end(), nodal.begin() + at, nodal.begin() + at + g);
  }
  // Facets that a search without memory finds for them
  const auto found = _surface->find_of_nodes(x, nodes, normals, _options.reach);
  const auto at = _halo->now();
  const geometry::FacetList facets = _surface->facets();
  for (std::size_t i = 0; i < frozen.size(); ++i)
  {
    // A closed node beside its facet may be as far before the surface. Less is
    // round-off
    const double gap = found.facet[i] < 0 ? 0 : found.gap[i],
                 hidden = closed[frozen[i]] ? -std::abs(gap) : gap;
    if (not(hidden < -math::solved_length_tol * _options.reach))
      continue;
    const auto ends = facets[found.facet[i]];
    double square = 0;
    for (int k = 0; k < g; ++k)
    {
      const double d = at->x[std::size_t(ends.back()) * g + k]
                       - at->x[std::size_t(ends.front()) * g + k];
      square += d * d;
    }
    deepest.gap = std::min(deepest.gap, hidden);
    deepest.part = std::min(deepest.part, hidden / std::sqrt(square));
  }
  return deepest;
}

std::int32_t NodeTie::search(std::span<const double> x,
                             std::span<const std::int8_t> closed)
{
  if (_found)
    return 0;
  _found = true;
  const std::int32_t changed = NodeToSurface::search(x, closed);
  const auto at = spread(*_halo, x, gdim());
  const std::vector<double> points = at_slaves(at);
  auto [xi, gap] = projections(at, points);
  auto [foot, normal] = facet_points(at, xi);
  _arm.resize(points.size());
  std::ranges::transform(points, foot, _arm.begin(), std::minus());
  _xi = std::move(xi);
  _gap = std::move(gap);
  _normal = std::move(normal);
  _offset.assign(size(), 0);
  return changed;
}

std::optional<std::vector<kernel::Pairs>>
NodeTie::update(std::span<const double>, bool, std::span<const double> offset)
{
  if (std::ranges::equal(offset, _offset))
    return std::nullopt;
  _offset.assign(offset.begin(), offset.end());
  return pairs();
}

std::vector<kernel::FacetSlip> NodeTie::slip() const
{
  const int g = gdim();
  std::vector<kernel::FacetSlip> from(size());
  for (std::size_t i = 0; i < size(); ++i)
  {
    std::copy_n(_xi.begin() + 2 * i, 2, from[i].xi.begin());
    from[i].gap = _gap[i] + _offset[i];
    for (int k = 0; k < g; ++k)
      from[i].origin[k] = _arm[g * i + k] + _offset[i] * _normal[g * i + k];
  }
  return from;
}
