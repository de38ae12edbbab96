// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "surface_to_surface.h"
#include "../geometry/gather.h"
#include "../geometry/middle.h"
#include "../geometry/sizes.h"
#include "../mesh/spread.h"
#include "mobility.h"
#include "slip_weights.h"
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::contact;
using mesh::spread;

namespace
{
// Distance beyond a slave facet's edges to which pairs are found in advance,
// over its size
constexpr double search_margin = 0.1;
// Cosine of the angle between a slave facet and one in front of it, over the
// largest one of its and its neighbours' pairs, below which the pair is dropped
constexpr double facing_ratio_min = 0.4;
// Covered fraction of a slave node's area from which on it is paired, and stays
// paired
constexpr double cover_to_pair = 0.06;
constexpr double cover_to_stay = 0.04;

std::vector<std::int32_t> nodes_of_both(const geometry::FacetList& slave,
                                        const geometry::FacetList& master)
{
  std::vector<std::int32_t> nodes(slave.nodes.begin(), slave.nodes.end());
  nodes.insert(nodes.end(), master.nodes.begin(), master.nodes.end());
  return search::sorted_unique(nodes);
}
} // namespace

SurfaceToSurface::SurfaceToSurface(
    std::shared_ptr<mesh::Halo> halo, std::shared_ptr<const SlaveNodes> slaves,
    std::shared_ptr<search::MasterSurface> surface,
    std::shared_ptr<search::InsideTest> outside, const PairingOptions& options)
    : DeformableMaster(std::move(halo), std::move(slaves), std::move(surface),
                       std::move(outside), options),
      _sides(*_slaves, _halo->reference(), _halo->gdim()), _slip(_sides),
      _nodes(nodes_of_both(_slaves->facets(), _surface->own())),
      _area(_sides.size(), 0), _paired(_sides.size(), 0),
      _weight(_slaves->corner_weight())
{
  if (not _options.is_small)
    _edges = _sides.at_edges(_halo->reference());
  _keeps.assign(_sides.num_slave_facets(), _options.is_smooth
                                               ? kernel::Keeps::all
                                               : kernel::Keeps::nothing);
  _inradius = mesh::least(_halo->ranks(), _sides.inradius());
  const auto reference = _halo->reference();
  _at.assign(reference.begin(), reference.end());
  if (_options.is_smooth)
  {
    _smooth_slave.emplace(*_halo, _slaves->own());
    _smooth_master.emplace(*_halo, _surface->own());
    _slave_patches = _smooth_slave->of(*_halo, _slaves->facets());
  }
  set_master_facets();
  _place.resize(_sides.size());
  for (std::int32_t f = _sides.num_slave_facets(); f-- > 0;)
    for (int s = _sides.width(); s-- > 0;)
      if (const std::size_t i = _sides.numbers(f)[s]; i < _sides.size())
        _place[i] = {f, s};
  _whole = _slaves->sums(geometry::corner_areas(
      _slaves->local(), _slaves->here(reference, gdim(), "x"), gdim(),
      _slaves->shares()));
}

/// Takes the master facets that are known now; those before keep their numbers.
void SurfaceToSurface::set_master_facets()
{
  geometry::Facets ours = geometry::copied(_slaves->facets()),
                   theirs = geometry::copied(_surface->facets());
  _search.emplace(std::move(ours.offsets), std::move(ours.nodes),
                  std::move(theirs.offsets), std::move(theirs.nodes), gdim());
  std::vector<std::int8_t> level;
  if (_slaves->is_quadratic())
  {
    std::vector<std::int64_t> every(_halo->num_nodes(), 0);
    std::copy_n(_options.level.begin(), _halo->num_owned(), every.begin());
    _halo->forward(std::span<std::int64_t>(every), 1);
    level.assign(every.begin(), every.end());
  }
  _sides.set_master_facets(_surface->facets(), level);
  if (_smooth_master)
    _master_patches = _smooth_master->of(*_halo, _surface->facets());
}

std::int32_t SurfaceToSurface::search(std::span<const double> x,
                                      std::span<const std::int8_t>)
{
  pair(x);
  return 0;
}

void SurfaceToSurface::pair(std::span<const double> x)
{
  const int g = gdim();
  int version = _halo->version();
  std::vector<double> now(x.begin(), x.end());
  const auto update = [&]
  {
    now = _halo->updated(std::move(now), g, version);
    version = _halo->version();
  };
  if (not _found or (has_moved(now) and lacks(now)))
  {
    update();
    const double margin = _options.is_small ? 0.0 : search_margin;
    update_facets(now, margin);
    update();
    _found = find(now, margin);
    if (_options.is_small)
    {
      // Facets that are in front along the directions that gaps are measured in
      const geometry::Integrals all = integrals(now, {});
      _kept = _sides.between(now, *_found, all.weight, all.normal);
      update_facets(now, margin, _kept);
      update();
      _found = find(now, margin, _kept);
    }
    _searched.clear();
    for (const std::int32_t node : _nodes)
      _searched.insert(_searched.end(), now.begin() + std::size_t(node) * g,
                       now.begin() + std::size_t(node + 1) * g);
  }
  update();
  take_normals(now);
  find_rise(integrate(now));
  find_corners(now);
  for (std::size_t i = 0; i < _paired.size(); ++i)
    _paired[i]
        = _area[i] > (_paired[i] ? cover_to_stay : cover_to_pair) * _whole[i];
}

void SurfaceToSurface::update_facets(std::span<const double> x, double margin,
                                     std::span<const double> along)
{
  const int known = _surface->version();
  _surface->add_facets_within(x, _slaves->facets(), _options.reach, margin,
                              along);
  if (_surface->version() != known)
    set_master_facets();
}

/// Whether any rank finds a pair that it does not have.
bool SurfaceToSurface::lacks(std::span<const double> x)
{
  const int version = _halo->version();
  update_facets(x, 0.0);
  const std::vector<double> now
      = _halo->updated({x.begin(), x.end()}, gdim(), version);
  const geometry::FacetPairs found = find(now, 0.0);
  return mesh::anywhere(_halo->ranks(), not search::contains(*_found, found));
}

/// Whether anything has moved so far since the search that pairs may lack.
bool SurfaceToSurface::has_moved(std::span<const double> x) const
{
  const int g = gdim();
  double moved = 0;
  for (std::size_t i = 0; i < _nodes.size(); ++i)
    for (int k = 0; k < g; ++k)
    {
      const double d
          = std::abs(x[std::size_t(_nodes[i]) * g + k] - _searched[g * i + k]);
      // Not a number is far
      moved = std::isnan(d) ? std::numeric_limits<double>::infinity()
                            : std::max(moved, d);
    }
  // Both sides may have moved
  return mesh::largest(_halo->ranks(), moved)
         > 0.25 * search_margin * _inradius;
}

geometry::FacetPairs SurfaceToSurface::find(std::span<const double> x,
                                            double margin,
                                            std::span<const double> along)
{
  return facing(x, without_outside(x, _search->find(x, _options.reach, margin,
                                                    false, along)));
}

/// Facet pairs without those whose master facets do not face the slave facet,
/// while others around it do: beyond an edge of the master, its sides are in
/// front of slave facets that touch the edge, far off, and would count in the
/// mean.
geometry::FacetPairs
SurfaceToSurface::facing(std::span<const double> x,
                         const geometry::FacetPairs& found) const
{
  const int g = gdim();
  const std::vector<double> ours
      = geometry::middles(_slaves->facets(), x, g).normals;
  const std::vector<double> theirs
      = geometry::middles(_surface->facets(), x, g).normals;
  std::vector<double> cosine(found.size(), 0);
  for (std::size_t p = 0; p < found.size(); ++p)
    for (int k = 0; k < g; ++k)
      cosine[p] -= ours[std::size_t(found.slave[p]) * g + k]
                   * theirs[std::size_t(found.master[p]) * g + k];
  const geometry::FacetList local = _slaves->local();
  std::vector<double> best(_sides.size(), 0);
  for (std::size_t p = 0; p < found.size(); ++p)
    for (const std::int32_t i : local[found.slave[p]])
      if (i < std::int32_t(best.size()))
        best[i] = std::max(best[i], cosine[p]);
  const std::vector<double> around = _slaves->largest(
      _slaves->scatter_forward(std::span<const double>(best)));
  geometry::FacetPairs kept;
  for (std::size_t p = 0; p < found.size(); ++p)
    if (is_at_edge(found.slave[p])
        or cosine[p] >= facing_ratio_min * around[found.slave[p]])
    {
      kept.slave.push_back(found.slave[p]);
      kept.master.push_back(found.master[p]);
    }
  return kept;
}

/// kernel::Pairs but for those with facets behind all of the master's body.
geometry::FacetPairs
SurfaceToSurface::without_outside(std::span<const double> x,
                                  geometry::FacetPairs found) const
{
  if (not _outside->is_around())
    return found;
  const int g = gdim();
  const geometry::FacetList theirs = _surface->facets();
  const geometry::Middles ours = geometry::middles(_slaves->facets(), x, g);
  const std::vector<double> others = geometry::middles(theirs, x, g).points;
  const std::vector<double> own_sizes
      = geometry::facet_sizes(_slaves->facets(), x, g);
  const std::vector<double> their_sizes = geometry::facet_sizes(theirs, x, g);
  std::vector<double> points, depth, size;
  for (std::size_t p = 0; p < found.size(); ++p)
  {
    const std::size_t e = found.slave[p], f = found.master[p];
    double d = 0;
    for (int k = 0; k < g; ++k)
    {
      points.push_back(ours.points[g * e + k]);
      d += ours.normals[g * e + k]
           * (ours.points[g * e + k] - others[g * f + k]);
    }
    depth.push_back(d);
    size.push_back(std::max(own_sizes[e], their_sizes[f]));
  }
  const auto is_outside = _outside->find(x, points, depth, size, true);
  geometry::FacetPairs kept;
  for (std::size_t p = 0; p < found.size(); ++p)
    if (not is_outside[p])
    {
      kept.slave.push_back(found.slave[p]);
      kept.master.push_back(found.master[p]);
    }
  return kept;
}

geometry::Integrals
SurfaceToSurface::integrals(std::span<const double> x,
                            std::span<const double> normal) const
{
  return geometry::integrals(
      {_slaves->facets(), &_sides.slave_wholes(), _slave_patches},
      {_surface->facets(), &_sides.master_wholes(), _master_patches}, *_found,
      x, _halo->reference(), gdim(), normal, _weight);
}

/// At an edge of the slave no facet has the normal of what touches it: its
/// facets take the master's, until the next search. In small sliding all have
/// kept directions of their own.
void SurfaceToSurface::take_normals(std::span<const double> x)
{
  if (_options.is_small)
    return;
  _kept.clear();
  std::ranges::replace(_keeps, kernel::Keeps::normal, kernel::Keeps::nothing);
  if (std::ranges::none_of(_found->slave,
                           [this](std::int32_t f) { return is_at_edge(f); }))
    return;
  _kept = _sides.master_normals(x, *_found, integrals(x, {}).weight);
  for (std::size_t f = 0; f < _keeps.size(); ++f)
    for (int k = 0; k < 3; ++k)
    {
      _kept[3 * f + k] *= _edges[f];
      if (_kept[3 * f + k] != 0 and _keeps[f] == kernel::Keeps::nothing)
        _keeps[f] = kernel::Keeps::normal;
    }
}

/// Finds the normals of the slave's patches, against which the master's are, at
/// the nodes of each facet.
void SurfaceToSurface::find_corners(std::span<const double> x)
{
  if (not _smooth_slave)
    return;
  const auto reference = _halo->reference();
  const geometry::FacetList facets = _slaves->facets();
  _corner.assign(12 * std::size_t(facets.size()), 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
    geometry::visit(static_cast<int>(facets[f].size()),
                    [&]<class F>(F)
                    {
                      if (F::gdim != gdim())
                        return;
                      for (int l = 0; l < F::nodes; ++l)
                      {
                        const auto n
                            = geometry::smooth_point<F>(
                                  geometry::gather<F>(facets[f], reference),
                                  geometry::gather<F>(facets[f], x),
                                  _slave_patches[f], F::vertices[l])
                                  .normal;
                        for (int k = 0; k < F::gdim; ++k)
                          _corner[12 * std::size_t(f) + 3 * l + k] = -n[k];
                      }
                    });
}

void SurfaceToSurface::find_rise(std::span<const double> of_pairs)
{
  _rise.clear();
  if (_smooth_slave)
    _rise = _sides.total(of_pairs, _found->slave);
  for (std::size_t i = 0; i < _rise.size(); ++i)
    _rise[i] = _area[i] > 0 ? _rise[i] / _area[i] : 0;
}

/// @return Integrals of what smooth patches rise.
std::vector<double> SurfaceToSurface::integrate(std::span<const double> x)
{
  geometry::Integrals all = integrals(x, _kept);
  _at.assign(x.begin(), x.end());
  _area = _sides.total(all.area);
  _dual = std::move(all.dual);
  _normal = std::move(all.normal);
  _mortar = {all.width, _found->slave, _found->master, std::move(all.weight),
             std::move(all.gap)};
  return std::move(all.rise);
}

std::vector<double> SurfaceToSurface::area(std::span<const double> whole) const
{
  std::vector<double> area(whole.begin(), whole.end());
  for (std::size_t i = 0; i < area.size(); ++i)
    if (_paired[i])
      area[i] = std::max(_area[i], 0.1 * cover_to_stay * whole[i]);
  return area;
}

std::vector<kernel::Pairs> SurfaceToSurface::pairs() const
{
  std::vector<kernel::Pairs> result = groups(_mortar);
  if (_options.measures_slip)
    for (kernel::Pairs& p : groups(slip_pairs(), true))
      result.push_back(std::move(p));
  return result;
}

/// kernel::Pairs that slip is measured with.
Mortar SurfaceToSurface::slip_pairs() const
{
  if (not _options.is_small)
    return _slip.pairs(area(_whole));
  Mortar movement = _mortar;
  std::ranges::fill(movement.gap, 0.0);
  return movement;
}

void SurfaceToSurface::rebuild()
{
  if (_halo->ranks().size() == 1 or not _found)
    return;
  std::vector<std::int32_t> used(_mortar.master);
  const auto of_slip = _slip.masters();
  used.insert(used.end(), of_slip.begin(), of_slip.end());
  // All parts of quadratic facets
  for (const std::int32_t f : std::vector(used))
    for (const std::int32_t part : _sides.master_wholes().parts_of(f))
      used.push_back(part);
  used = search::sorted_unique(used);
  std::vector<std::int32_t> numbers(_surface->facets().size() + 1, 0);
  const std::vector<std::int32_t> kept = _surface->keep(used);
  for (std::size_t k = 0; k < used.size(); ++k)
    numbers[used[k]] = kept[k];
  for (std::int32_t& f : _mortar.master)
    f = numbers[f];
  _slip.rename(numbers);
  set_master_facets();
}

void SurfaceToSurface::nodes_changed() { _at = spread(*_halo, _at, gdim()); }

std::optional<std::vector<kernel::Pairs>>
SurfaceToSurface::update(std::span<const double> x, bool frozen,
                         std::span<const double>)
{
  // Patches have no slope to one another that facets had: what changes their
  // gap as they slide is curvature, which each search finds
  if (frozen or _options.is_small or _options.is_smooth
      or std::ranges::equal(x, _at))
    return std::nullopt;
  integrate(x);
  return pairs();
}

std::vector<double> SurfaceToSurface::normals() const
{
  std::vector<double> normals(3 * _sides.size(), 0);
  for (std::size_t p = 0; p < _mortar.size(); ++p)
    for (int s = 0; s < _mortar.width; ++s)
    {
      const std::size_t i = _sides.numbers(_mortar.slave[p])[s];
      if (i >= _sides.size() or not _paired[i])
        continue;
      double share = 0;
      for (const double w : _mortar.row(p, s))
        share += w;
      const auto f = static_cast<std::size_t>(_mortar.slave[p]);
      const double* n
          = _corner.empty() ? &_normal[3 * f] : &_corner[12 * f + 3 * s];
      for (int k = 0; k < 3; ++k)
        normals[3 * i + k] += share * n[k];
    }
  normalise(normals);
  return normals;
}

kernel::Weights SurfaceToSurface::weights() const
{
  const Mortar mortar = normalised();
  kernel::Weights weights;
  for (std::size_t i = 0; i < _sides.size(); ++i)
    if (_paired[i])
      _sides.for_each_part(_place[i].first, _place[i].second,
                           [&](std::int32_t node, double part)
                           {
                             weights.slaves.push_back(
                                 static_cast<std::int32_t>(i));
                             weights.nodes.push_back(node);
                             weights.values.push_back(part);
                           });
  for (std::size_t p = 0; p < mortar.size(); ++p)
    for (int s = 0; s < mortar.width; ++s)
      for (int l = 0; l < mortar.width; ++l)
      {
        // Zero for slave nodes of other ranks, too
        const double w = mortar.row(p, s)[l];
        if (w == 0)
          continue;
        weights.slaves.push_back(_sides.numbers(mortar.slave[p])[s]);
        weights.nodes.push_back(_sides.master_nodes(mortar.master[p])[l]);
        weights.values.push_back(-w);
      }
  return weights;
}

void SurfaceToSurface::begin_step()
{
  if (not _found)
    return;
  if (not _options.is_small)
  {
    _found.reset();
    const auto start = _halo->start();
    pair(start->x);
  }
  if (not _options.measures_slip)
    return;
  // With the nodes that the pairs have brought here
  const auto& [u0, x0] = *_halo->start();
  if (_options.is_small)
    _origin.start(moved(u0));
  else
    _slip.begin_step(of_slip(x0, u0), along(u0));
}

/// How far slave nodes are from what is in front of them, along the surface,
/// where patches are smooth: facets are projected along their own normals, and
/// slip is measured across those of the patches. No slip has made it.
std::vector<double> SurfaceToSurface::along(std::span<const double> u) const
{
  if (not _smooth_slave)
    return {};
  const std::size_t g = gdim();
  std::vector<double> apart = separation(u);
  const std::vector<double> normal = normals();
  for (std::size_t i = 0; i < _sides.size(); ++i)
  {
    double across = 0;
    for (std::size_t k = 0; k < g; ++k)
      across += apart[g * i + k] * normal[3 * i + k];
    for (std::size_t k = 0; k < g; ++k)
      apart[g * i + k] -= across * normal[3 * i + k];
  }
  return apart;
}

/// kernel::Pairs divided by the areas, with what slip is measured by.
Mortar SurfaceToSurface::of_slip(std::span<const double> x,
                                 std::span<const double> u) const
{
  if (not _slaves->is_quadratic())
    return normalised();
  return slip_weights(normalised(), _sides, separation(u), normals(), x,
                      gdim());
}

/// kernel::Pairs divided by the slave nodes' areas.
Mortar SurfaceToSurface::normalised() const
{
  std::vector<double> inverse = area(_whole);
  for (std::size_t i = 0; i < inverse.size(); ++i)
    inverse[i] = _paired[i] ? 1 / inverse[i] : 0.0;
  return _mortar.scaled(_sides.at_corners(inverse, _mortar.slave));
}

void SurfaceToSurface::touch(std::span<const std::int8_t> which,
                             std::span<const double> x,
                             std::span<const double> u,
                             std::span<const double> offset)
{
  if (_options.is_small)
    _origin.touch(which, apart(), moved(u), normals(), offset);
  else
    _slip.touch(which, of_slip(x, u), offset, along(u));
}

std::optional<std::vector<double>>
SurfaceToSurface::turn(std::span<const double> x) const
{
  const std::vector<double>& x0 = _halo->start()->x;
  if (std::ranges::equal(x, x0))
    return std::nullopt;
  return rotations(x0, x);
}

std::vector<double> SurfaceToSurface::rotations(std::span<const double> from,
                                                std::span<const double> x) const
{
  const int g = gdim();
  const std::vector<double> before = _sides.frames(from);
  const std::vector<double> now = _sides.frames(x);
  std::vector<double> turn(before.size(), 0);
  for (std::size_t i = 0; i < _sides.size(); ++i)
    for (int r = 0; r < g; ++r)
      for (int c = 0; c < g; ++c)
        for (int k = 0; k < g; ++k)
          turn[g * (g * i + r) + c]
              += now[g * (g * i + r) + k] * before[g * (g * i + c) + k];
  return turn;
}

/// Entries of the weights that are the slave nodes' own, which come first.
std::size_t SurfaceToSurface::num_own_parts() const
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < _sides.size(); ++i)
    if (_paired[i])
      _sides.for_each_part(_place[i].first, _place[i].second,
                           [&count](std::int32_t, double) { ++count; });
  return count;
}

std::vector<double>
SurfaceToSurface::compliance(std::span<const double> nodal) const
{
  const kernel::Weights w = weights();
  std::vector<double> total(_sides.size(), 0), mean(_sides.size(), 0);
  for (std::size_t e = num_own_parts(); e < w.values.size(); ++e)
    if (w.values[e] <= 0)
    {
      const double size = std::abs(w.values[e]);
      total[w.slaves[e]] += size;
      mean[w.slaves[e]] += size * nodal[w.nodes[e]];
    }
  std::vector<double> result(_sides.size(), _surface->mean(nodal));
  for (std::size_t i = 0; i < result.size(); ++i)
    if (total[i] > 0)
      result[i] = mean[i] / total[i];
  return result;
}

Mobility SurfaceToSurface::mobility(std::span<const std::int8_t> free) const
{
  const int g = gdim();
  const std::size_t n = _sides.size();
  if (all_free(_sides.slaves(), free, g)
      and all_free(_surface->facets().nodes, free, g))
    return {std::vector<double>(n, 1), std::vector<double>(n * g, 1)};
  const kernel::Weights w = weights();
  std::vector<double> squares = free_squares(w, free, _paired, g);
  // A plane of symmetry cuts the master, too; an edge that is pushed along
  // a master has friction
  std::vector<std::int8_t> cuts(n * g, 0);
  for (std::size_t e = num_own_parts(); e < w.values.size(); ++e)
    if (w.values[e] < 0)
      for (int k = 0; k < g; ++k)
        if (not free[std::size_t(w.nodes[e]) * g + k])
          cuts[std::size_t(w.slaves[e]) * g + k] = 1;
  std::vector<std::int8_t> around(_sides.around().size() * g, 0);
  for (std::int32_t f = 0; f < _sides.num_slave_facets(); ++f)
    for (int k = 0; k < g; ++k)
    {
      bool some = false;
      for (const std::int32_t node : _sides.slave_nodes(f))
        some = some or free[std::size_t(node) * g + k];
      if (some)
        for (const std::int32_t i : _sides.numbers(f))
          around[std::size_t(i) * g + k] = 1;
    }
  const std::vector<double> normal = normals();
  Mobility found{std::vector<double>(n), std::vector<double>(n * g)};
  for (std::size_t i = 0; i < n; ++i)
  {
    double sum = 0;
    for (int k = 0; k < g; ++k)
    {
      double& square = squares[g * i + k];
      if (not free[std::size_t(_sides.slaves()[i]) * g + k]
          and around[g * i + k]
          and (cuts[g * i + k] or is_normal(normal[3 * i + k])))
        square = 0;
      sum += normal[3 * i + k] * normal[3 * i + k] * square;
      found.each[g * i + k] = std::sqrt(square);
    }
    found.normal[i] = _paired[i] ? std::sqrt(sum) : 1.0;
  }
  return found;
}

std::vector<Saved> SurfaceToSurface::save() const
{
  // kernel::Pairs follow from the positions
  return {{"paired", RowKind::slave, 0, _paired}};
}

void SurfaceToSurface::load(const std::vector<Saved>& saved)
{
  _paired = values_of<std::int8_t>(saved, "paired");
  begin_step();
}

double SurfaceToSurface::distance(std::span<const double> x) const
{
  const int g = gdim();
  std::vector<double> points;
  for (const std::int32_t node : _sides.slaves())
    points.insert(points.end(), x.begin() + std::size_t(node) * g,
                  x.begin() + std::size_t(node + 1) * g);
  return _surface->distance(x, points);
}

SurfaceTie::SurfaceTie(std::shared_ptr<mesh::Halo> halo,
                       std::shared_ptr<const SlaveNodes> slaves,
                       std::shared_ptr<search::MasterSurface> surface,
                       std::shared_ptr<search::InsideTest> outside,
                       PairingOptions options)
    : SurfaceToSurface(std::move(halo), std::move(slaves), std::move(surface),
                       std::move(outside),
                       {options.reach, options.is_small, false, options.level}),
      _offset(sides().size(), 0)
{
  // kernel::Pairs for good must turn with the facets
  take_own_normals();
}

std::int32_t SurfaceTie::search(std::span<const double> x,
                                std::span<const std::int8_t> closed)
{
  return is_found() ? 0 : SurfaceToSurface::search(x, closed);
}

std::vector<kernel::Pairs> SurfaceTie::pairs() const
{
  Mortar longer = mortar();
  const std::vector<double> offset = sides().at_corners(_offset, longer.slave);
  const std::size_t n = longer.width;
  for (std::size_t c = 0; c < offset.size(); ++c)
  {
    double share = 0;
    for (const double w : longer.row(c / n, static_cast<int>(c % n)))
      share += w;
    longer.gap[c] += share * offset[c];
  }
  return groups(longer);
}

std::optional<std::vector<kernel::Pairs>>
SurfaceTie::update(std::span<const double>, bool,
                   std::span<const double> offset)
{
  if (std::ranges::equal(offset, _offset))
    return std::nullopt;
  _offset.assign(offset.begin(), offset.end());
  return pairs();
}
