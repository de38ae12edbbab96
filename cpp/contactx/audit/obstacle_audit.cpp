// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "obstacle_audit.h"
#include "../geometry/middle.h"
#include "../geometry/plane.h"
#include "../geometry/sizes.h"
#include "facet_sampling.h"
#include "far_side.h"
#include "penetration.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::audit;

namespace
{
// Bisections of a slave facet: an obstacle of 2^-7 of its size is found
constexpr int max_bisections = 7;
// Points on the path of a node that may have passed through the obstacle
constexpr int points_of_path = 64;

std::shared_ptr<contact::ObstacleMaster> rigid(const contact::Contact& contact)
{
  auto master
      = std::dynamic_pointer_cast<contact::ObstacleMaster>(contact.master());
  if (not master)
    throw std::invalid_argument("the contact's master must be an obstacle");
  return master;
}

/// Distance of a row of one table from a row of another one.
double distance(std::span<const double> a, std::size_t i,
                std::span<const double> b, std::size_t j, int gdim)
{
  double square = 0;
  for (int k = 0; k < gdim; ++k)
  {
    const double d = a[i * gdim + k] - b[j * gdim + k];
    square += d * d;
  }
  return std::sqrt(square);
}

/// Vectors turned by a rotation (shape=(gdim, gdim)).
std::vector<double> turned(std::span<const double> vectors,
                           std::span<const double> rotation, int gdim)
{
  std::vector<double> result(vectors.size(), 0);
  for (std::size_t i = 0; i < vectors.size(); i += gdim)
    for (int r = 0; r < gdim; ++r)
      for (int c = 0; c < gdim; ++c)
        result[i + r] += rotation[r * gdim + c] * vectors[i + c];
  return result;
}
} // namespace

ObstacleAudit::ObstacleAudit(std::shared_ptr<mesh::Halo> halo,
                             std::shared_ptr<contact::Contact> contact)
    : _halo(std::move(halo)), _contact(std::move(contact)),
      _master(rigid(*_contact))
{
}

void ObstacleAudit::accept()
{
  _halo->ranks().agree(
      [this]
      {
        Places now = places(_halo->now()->x);
        _placed = _master->obstacle()->placement(gdim());
        // Spin moves no shape
        _placed.angle.clear();
        _normals = _master->obstacle()->evaluate(now.points, gdim()).normal;
        _before = std::move(now);
      });
  accept_warning();
}

Findings ObstacleAudit::find(std::span<const double> /*start*/)
{
  mesh::Ranks& ranks = _halo->ranks();
  const contact::SlaveNodes& slaves = _contact->slaves();
  const auto here = _halo->now();
  const std::vector<double>& x = here->x;
  const auto around = rows_of(x, slaves.around(), gdim());
  const auto size = geometry::unstretched_sizes(
      slaves.local(), around,
      rows_of(_halo->reference(), slaves.around(), gdim()), gdim());
  Findings findings;
  for (const double h : size)
    findings.facet_size = std::max(findings.facet_size, h);
  findings.facet_size = mesh::largest(ranks, findings.facet_size);
  const double small = negligible_depth * findings.facet_size;
  std::vector<double> offset = _contact->offset();
  for (double& value : offset)
    value = std::min(value, 0.);
  offset = slaves.scatter_forward(offset);
  std::vector<double> gap;
  std::vector<std::int32_t> bad;
  std::int64_t passed = 0;
  // A user's function may fail on one rank
  ranks.agree(
      [&]
      {
        gap = gaps(rows_of(x, slaves.owned(), gdim()));
        bad = inside(gap, small);
        passed = count_passed(x, small);
      });
  const auto how_near = near(gap, small);
  std::optional<Depth> mine;
  std::optional<Roundness> round;
  ranks.agree(
      [&]
      {
        mine = look_between(around, size, how_near, offset);
        round = roundness(around, size, gap, small);
      });
  findings.roundness = sharpest(ranks, round, gdim());
  warn(findings, findings.roundness);
  findings.passed.count = mesh::total(ranks, passed);
  if (findings.passed.count == 0)
    findings.inside = found_nodes(*_halo, bad, x);
  findings.deepest = deepest(ranks, mine, gdim());
  findings.penetrates_too_deep = not findings.is_fault() and findings.deepest
                                 and findings.deepest->excess > 1;
  return findings;
}

ObstacleAudit::Places ObstacleAudit::places(std::span<const double> x) const
{
  const contact::SlaveNodes& slaves = _contact->slaves();
  const std::size_t owned = slaves.owned().size() * gdim();
  const auto around = rows_of(x, slaves.around(), gdim());
  const auto nodal = geometry::nodal_normals(slaves.local(), around, gdim());
  // Each facet on one rank
  const geometry::Middles middles = geometry::middles(slaves.own(), x, gdim());
  const auto joined =
      [owned](std::span<const double> nodes, const std::vector<double>& facets)
  {
    std::vector<double> all(nodes.begin(), nodes.begin() + owned);
    all.insert(all.end(), facets.begin(), facets.end());
    return all;
  };
  return {joined(around, middles.points), joined(nodal, middles.normals)};
}

/// Values of a function of the obstacle at points, as many at a time as there
/// are slave nodes: for so many a user's function is compiled.
std::vector<double> ObstacleAudit::seen(std::span<const double> points,
                                        Function function, int width) const
{
  geometry::Obstacle& obstacle = *_master->obstacle();
  const std::size_t g = gdim(), n = points.size() / g;
  if (n == 0)
    return (obstacle.*function)(points, gdim());
  const std::size_t at_a_time
      = std::max<std::size_t>(1, _contact->slaves().owned().size());
  std::vector<double> values, part(at_a_time * g);
  values.reserve(n * width);
  for (std::size_t first = 0; first < n; first += at_a_time)
  {
    const std::size_t count = std::min(at_a_time, n - first);
    // The last ones again and again where there are fewer
    for (std::size_t i = 0; i < at_a_time; ++i)
      std::ranges::copy(points.subspan((first + i % count) * g, g),
                        part.begin() + static_cast<std::ptrdiff_t>(i * g));
    const auto found = (obstacle.*function)(part, gdim());
    values.insert(values.end(), found.begin(),
                  found.begin() + static_cast<std::ptrdiff_t>(count * width));
  }
  return values;
}

std::vector<double> ObstacleAudit::gaps(std::span<const double> points) const
{
  return seen(points, &geometry::Obstacle::distance, 1);
}

/// Slave nodes that face away from the obstacle and are inside it.
std::vector<std::int32_t> ObstacleAudit::inside(std::span<const double> gap,
                                                double small) const
{
  const auto slaves = _contact->slaves().owned();
  const law::NodeState& state = *_contact->nodes();
  const auto paired = _master->paired();
  std::vector<std::int32_t> nodes;
  for (std::size_t i = 0; i < slaves.size(); ++i)
    if (gap[i] < std::min(_contact->offset()[i], 0.) - small and not paired[i]
        and not state.immobile[i] and not state.redundant[i])
      nodes.push_back(slaves[i]);
  return nodes;
}

/// Whether an owned slave node is in contact and at the obstacle: a gap that is
/// a mean may be closed although the node is beside it.
bool ObstacleAudit::touches(std::size_t i, double gap, double small) const
{
  return _contact->nodes()->is_constrained(i)
         and not(gap - _contact->offset()[i] > small);
}

/// Where the obstacle is roundest by the facets around a node that touches it.
/// @param[in] x Positions of the slave nodes around.
/// @param[in] size Sizes of the facets around the owned ones.
/// @param[in] gap Gaps of the owned slave nodes.
/// @param[in] small What is no matter.
std::optional<Roundness> ObstacleAudit::roundness(std::span<const double> x,
                                                  std::span<const double> size,
                                                  std::span<const double> gap,
                                                  double small) const
{
  const geometry::FacetList local = _contact->slaves().local();
  const std::size_t n = gap.size();
  std::vector<double> largest(n, 0);
  for (std::int32_t f = 0; f < local.size(); ++f)
    for (const std::int32_t node : local[f])
      if (static_cast<std::size_t>(node) < n)
        largest[node] = std::max(largest[node], size[f]);
  const auto curvature = _master->obstacle()
                             ->evaluate(x.first(n * gdim()), gdim())
                             .largest_curvatures(gdim());
  std::vector<double> turn(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    if (touches(i, gap[i], small))
      turn[i] = curvature[i] * largest[i];
  const auto worst = worst_of(turn);
  if (worst < 0 or not(turn[worst] > 0))
    return std::nullopt;
  return Roundness{
      1 / curvature[worst],
      largest[worst],
      {x.begin() + worst * gdim(), x.begin() + (worst + 1) * gdim()}};
}

/// How near each slave facet is to contact; collective.
std::vector<std::int8_t> ObstacleAudit::near(std::span<const double> gap,
                                             double small) const
{
  const contact::SlaveNodes& slaves = _contact->slaves();
  const law::NodeState& state = *_contact->nodes();
  std::vector<std::int8_t> held(gap.size()), touching(gap.size());
  for (std::size_t i = 0; i < gap.size(); ++i)
  {
    held[i] = state.is_constrained(i);
    touching[i] = touches(i, gap[i], small);
  }
  auto result = slaves.near(held);
  const auto touches = slaves.near(touching);
  for (std::size_t f = 0; f < result.size(); ++f)
    if (touches[f] != 2)
      result[f] = std::min<std::int8_t>(result[f], 1);
  return result;
}

/// Where the obstacle reaches deepest through a slave facet, by what the mesh
/// explains, with the middle of the facet as its place.
/// @param[in] x Positions of the slave nodes around.
/// @param[in] size Sizes of the facets around the owned ones.
/// @param[in] near How near each is to contact.
/// @param[in] offset What the gap of the slave nodes around may fall to.
std::optional<Depth> ObstacleAudit::look_between(
    std::span<const double> x, std::span<const double> size,
    std::span<const std::int8_t> near, std::span<const double> offset) const
{
  geometry::Obstacle& obstacle = *_master->obstacle();
  const contact::SlaveNodes& slaves = _contact->slaves();
  const geometry::FacetList local = slaves.local();
  // A plane is deepest at a node
  if (dynamic_cast<const geometry::Plane*>(&obstacle) or local.size() == 0)
    return std::nullopt;
  const std::size_t n = size.size();
  std::vector<double> extent(n, obstacle.size(gdim()));
  const geometry::Geometry geometry = obstacle.evaluate(x, gdim());
  auto curvature = geometry::facet_turns(local, x, geometry.normal, gdim());
  const auto at_nodes = slaves.largest(geometry.largest_curvatures(gdim()));
  for (std::size_t f = 0; f < n; ++f)
    curvature[f] = std::max(curvature[f], at_nodes[f]);
  FacetSampling sampling(local, x, gdim(),
                         allowed_penetration(size, curvature, near, extent),
                         max_bisections);
  while (not sampling.points().empty())
    sampling.take(gaps(sampling.points()));
  std::vector<double> depth = slaves.smallest(offset), excess(n);
  std::vector<std::int32_t> deep;
  for (std::size_t f = 0; f < n; ++f)
  {
    depth[f] -= sampling.gaps()[f];
    if (depth[f] > 0)
      deep.push_back(static_cast<std::int32_t>(f));
  }
  // Between nodes whose normals tell nothing of it may be a punch
  const auto steep = turns(deep, rows_of(sampling.deepest(), deep, gdim()), x,
                           geometry.normal);
  for (std::size_t k = 0; k < deep.size(); ++k)
    curvature[deep[k]] = std::max(curvature[deep[k]], steep[k]);
  // Facets that are not in contact see no more of the obstacle than that place
  for (std::size_t f = 0; f < n; ++f)
    if (near[f] < 2 and curvature[f] * size[f] > 1)
      extent[f] = std::min(extent[f], 2 / curvature[f]);
  const auto explained = allowed_penetration(size, curvature, near, extent);
  for (std::size_t f = 0; f < n; ++f)
    excess[f] = depth[f] / explained[f];
  const auto worst = worst_of(excess);
  if (worst < 0)
    return std::nullopt;
  const Vector<3> middle
      = geometry::middle(local[static_cast<std::int32_t>(worst)], x, gdim());
  return Depth{excess[worst],
               depth[worst],
               size[worst],
               near[worst] > 1,
               {middle.begin(), middle.begin() + gdim()}};
}

/// Rotation of the obstacle's normal along the segments from nodes of facets to
/// a point in each.
/// @param[in] facets Facets around the owned slave nodes (shape=(n)).
/// @param[in] at The points (shape=(n, gdim)).
/// @param[in] x Positions of the slave nodes around.
/// @param[in] normal The obstacle's normals there.
std::vector<double> ObstacleAudit::turns(std::span<const std::int32_t> facets,
                                         std::span<const double> at,
                                         std::span<const double> x,
                                         std::span<const double> normal) const
{
  std::vector<double> turn(facets.size(), 0);
  if (facets.empty())
    return turn;
  const auto there = seen(at, &geometry::Obstacle::normals, gdim());
  const geometry::FacetList local = _contact->slaves().local();
  for (std::size_t k = 0; k < facets.size(); ++k)
    for (const std::int32_t node : local[facets[k]])
    {
      const double length = distance(at, k, x, node, gdim());
      if (length > 0)
        turn[k] = std::max(turn[k],
                           distance(there, k, normal, node, gdim()) / length);
    }
  return turn;
}

/// Number of nodes and facets of this rank that have gone through the obstacle.
std::int64_t ObstacleAudit::count_passed(std::span<const double> x,
                                         double small) const
{
  if (not _before)
    return 0;
  geometry::Obstacle& obstacle = *_master->obstacle();
  const std::size_t g = gdim();
  const Places now = places(x);
  const geometry::Placement placed = obstacle.placement(gdim());
  const auto before = turned(_normals, _placed.turn(placed), gdim());
  const auto after = obstacle.evaluate(now.points, gdim()).normal;
  const auto is_far
      = far_side(_before->normals, now.normals, before, after, gdim());
  std::vector<std::int32_t> passed;
  for (std::size_t i = 0; i < is_far.size(); ++i)
    if (is_far[i])
      passed.push_back(static_cast<std::int32_t>(i));
  if (not obstacle.knows_its_motion() or passed.empty())
    return std::ssize(passed);
  const auto start
      = _placed.carry(rows_of(_before->points, passed, gdim()), placed);
  const auto end = rows_of(now.points, passed, gdim());
  std::vector<double> along;
  along.reserve(points_of_path * start.size());
  for (int k = 0; k < points_of_path; ++k)
  {
    const double t
        = k + 1 < points_of_path ? k * (1. / (points_of_path - 1)) : 1;
    for (std::size_t i = 0; i < start.size(); ++i)
      along.push_back(start[i] + t * (end[i] - start[i]));
  }
  const auto gap = gaps(along);
  const std::size_t n = start.size() / g;
  std::vector<std::int8_t> went_in(n, 0);
  for (std::size_t i = 0; i < gap.size(); ++i)
    if (gap[i] < -small)
      went_in[i % n] = 1;
  return std::ranges::count(went_in, 1);
}
