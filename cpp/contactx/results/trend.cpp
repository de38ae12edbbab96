// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "trend.h"
#include "../math/matrix.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

using namespace contactx;
using namespace contactx::results;

namespace
{
// Averages of which the slope is taken: as many as those that it corrects
constexpr int slope_passes = 2;
// Rows of facets that the slope of an edge goes inside
constexpr int slope_rows = 6;
// What a slope explains counts beyond this times what it leaves
constexpr double beyond_scatter = 2;

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector<3> times(const double* tensor, const Vector<3>& v, int gdim)
{
  Vector<3> result{};
  for (int k = 0; k < gdim; ++k)
    result[k] = dot(tensor + k * gdim, v.data(), gdim);
  return result;
}

// What is along a plane with this unit normal
Vector<3> along(const Vector<3>& v, const Vector<3>& normal)
{
  return v - dot(v, normal) * normal;
}
} // namespace

/// Linear fits to owned nodes and their neighbours.
struct Trend::Fit
{
  std::vector<double> left;   // variance that is not of the slope (shape=(n))
  std::vector<double> spread; // covariance of places (shape=(n, gdim, gdim))
  std::vector<double> slope, place; // its mean place (shape=(n, gdim))
};

/// The edge of the contact.
struct Trend::Rim
{
  std::vector<double> out;    // leads out, or zero (shape=(n, gdim))
  std::vector<double> across; // projection on what leads out or in
                              // (shape=(n, gdim, gdim))
};

Trend::Trend(std::shared_ptr<const contact::SlaveNodes> slaves,
             std::vector<double> x, std::vector<double> parts, int gdim)
    : _slaves(std::move(slaves)), _x(std::move(x)), _parts(std::move(parts)),
      _gdim(gdim)
{
  const geometry::FacetList facets = _slaves->local();
  _normal = geometry::nodal_normals(facets, _x, gdim);
  const auto n = static_cast<std::int32_t>(_slaves->owned().size());
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    const auto corners = static_cast<int>(nodes.size());
    Vector<3> middle{};
    for (std::int32_t i : nodes)
      middle = middle + (1. / corners) * vector_at(_x, i, gdim);
    // Around the facet: corners 2 and 3 of four are in the order of rows
    const auto around
        = [&](int k) { return nodes[corners == 4 and k > 1 ? 5 - k : k]; };
    for (int k = 0; k < corners; ++k)
    {
      std::int32_t a = around(k);
      std::int32_t b = gdim == 2 ? a : around((k + 1) % corners);
      if (a >= n and b >= n)
        continue;
      if (a > b)
        std::swap(a, b);
      const Vector<3> at = vector_at(_x, a, gdim);
      const Vector<3> edge = vector_at(_x, b, gdim) - at;
      Vector<3> out = at + 0.5 * edge - middle;
      if (const double size = dot(edge, edge); size > 0)
        out = out - (dot(out, edge) / size) * edge;
      if (const double size = norm(out); size > 0)
        out = (1 / size) * out;
      _edges.push_back({a, b, f, out});
    }
  }
  std::ranges::sort(_edges, {}, [](const Edge& e)
                    { return std::tuple(e.a, e.b, e.facet); });
}

Trend::Rim Trend::rim(std::span<const std::int8_t> closed) const
{
  const geometry::FacetList facets = _slaves->local();
  const std::size_t n = _slaves->owned().size();
  std::vector<std::int8_t> is_in(facets.size(), 1);
  for (std::int32_t f = 0; f < facets.size(); ++f)
    for (std::size_t k = 0; k < facets[f].size(); ++k)
      // Vertices of quadratic triangles, without an area, say nothing
      if (not closed[facets[f][k]] and _parts[facets.offsets[f] + k] > 0)
        is_in[f] = 0;

  Rim result{std::vector<double>(n * _gdim, 0),
             std::vector<double>(n * _gdim * _gdim, 0)};
  std::vector<Matrix3d> sum(n, Matrix3d::Zero());
  for (std::size_t first = 0, end; first < _edges.size(); first = end)
  {
    const Edge* only = nullptr;
    int count = 0;
    for (end = first; end < _edges.size() and _edges[end].a == _edges[first].a
                      and _edges[end].b == _edges[first].b;
         ++end)
      if (is_in[_edges[end].facet])
      {
        only = &_edges[end];
        ++count;
      }
    if (count != 1)
      continue;
    const auto add = [&](std::int32_t i)
    {
      if (i >= static_cast<std::int32_t>(n))
        return;
      for (int k = 0; k < _gdim; ++k)
        result.out[i * _gdim + k] += only->out[k];
      const auto out = Vector3d::Map(only->out.data());
      sum[i] += out * out.transpose();
    };
    add(only->a);
    if (only->b != only->a)
      add(only->b);
  }
  // Of its eigenvalues, which are 2 and 0 on a straight edge, 1 and 1 at a
  // right angle, and 2 in 2D, those of 1 and 2 become 1
  for (std::size_t i = 0; i < n; ++i)
    Eigen::Map<math::Small>(&result.across[i * _gdim * _gdim], _gdim, _gdim)
        = (1.5 * sum[i] - 0.5 * sum[i] * sum[i]).topLeftCorner(_gdim, _gdim);
  return result;
}

Trend::Fit Trend::fit(std::span<const Flow> flows,
                      std::span<const double> points) const
{
  const std::size_t n = _slaves->owned().size();
  const int width = _gdim + 1;
  // Sums over a node and its neighbours, relative to the node
  struct Sums
  {
    double weight = 0;
    Vector<3> x{};
    double p = 0, pp = 0;
    Vector<3> xp{};
    Matrix3d xx = Matrix3d::Zero();
  };
  std::vector<Sums> sums(n);
  for (const Flow& flow : flows)
  {
    const double* own = &points[static_cast<std::size_t>(flow.to) * width];
    const double* other = &points[static_cast<std::size_t>(flow.from) * width];
    Vector<3> x{};
    for (int k = 0; k < _gdim; ++k)
      x[k] = other[k] - own[k];
    x = along(x, vector_at(_normal, flow.to, _gdim));
    const double p = other[_gdim] - own[_gdim], w = flow.weight;
    Sums& s = sums[flow.to];
    // The node itself counts as one of the facet's corners
    s.weight += w + w / (flow.corners - 1);
    s.x = s.x + w * x;
    s.p += w * p;
    s.pp += w * p * p;
    s.xp = s.xp + (w * p) * x;
    const auto column = Vector3d::Map(x.data());
    s.xx += w * column * column.transpose();
  }
  Fit fit{std::vector<double>(n, 0), std::vector<double>(n * _gdim * _gdim, 0),
          std::vector<double>(n * _gdim, 0), std::vector<double>(n * _gdim, 0)};
  for (std::size_t i = 0; i < n; ++i)
  {
    const Sums& s = sums[i];
    const double per = s.weight > 0 ? 1 / s.weight : 0;
    const Vector<3> mean = per * s.x;
    const double p = per * s.p;
    // In the plane a row and a column of it are zero
    const auto at = Vector3d::Map(mean.data());
    const Matrix3d A = per * s.xx - at * at.transpose();
    const Vector3d b = per * Vector3d::Map(s.xp.data()) - p * at;
    Vector3d slope = Vector3d::Zero();
    for (int k = 0; k < _gdim; ++k)
      fit.place[i * _gdim + k] = points[i * width + k] + mean[k];
    Eigen::Map<math::Small>(&fit.spread[i * _gdim * _gdim], _gdim, _gdim)
        = A.topLeftCorner(_gdim, _gdim);
    if (s.weight == 0)
      continue;
    const auto eigen = math::symmetric_eigen(A);
    const Vector3d& values = eigen.eigenvalues();
    for (int m = 0; m < 3; ++m)
      if (const Vector3d e = eigen.eigenvectors().col(m);
          values[m] > math::negligible_part * values[2])
        slope += e.dot(b) / values[m] * e;
    std::copy_n(slope.data(), _gdim, fit.slope.begin() + i * _gdim);
    fit.left[i] = std::max(per * s.pp - p * p - slope.dot(b), 0.);
  }
  return fit;
}

// What linear fits to nodes off the edge leave of the variance of multipliers,
// the largest of a node and its neighbours, and theirs (shape=(n))
std::vector<double> Trend::scatter_behind(std::span<const Flow> flows,
                                          std::span<const double> points,
                                          const Rim& rim) const
{
  const std::size_t n = _slaves->owned().size();
  std::vector<std::int8_t> is_off(n);
  for (std::size_t i = 0; i < n; ++i)
    is_off[i] = norm(vector_at(rim.out, i, _gdim)) == 0;
  is_off = _slaves->scatter_forward(is_off);
  std::vector<Flow> off;
  std::ranges::copy_if(flows, std::back_inserter(off), [&](const Flow& flow)
                       { return is_off[flow.to] and is_off[flow.from]; });
  std::vector<double> largest = fit(off, points).left;
  for (int ring = 0; ring < 2; ++ring)
  {
    const std::vector<double> every = _slaves->scatter_forward(largest);
    for (const Flow& flow : flows)
      largest[flow.to] = std::max(largest[flow.to], every[flow.from]);
  }
  return largest;
}

Slope Trend::find(std::span<const Flow> flows, std::span<const double> p,
                  std::span<const std::int8_t> closed) const
{
  const std::size_t n = _slaves->owned().size();
  const int width = _gdim + 1;

  // Where the multipliers are: the centres of the shape functions
  std::vector<double> points(n * width);
  for (std::size_t i = 0; i < n; ++i)
  {
    std::copy_n(_x.begin() + i * _gdim, _gdim, points.begin() + i * width);
    points[i * width + _gdim] = p[i];
  }
  for (const Flow& flow : flows)
    for (int k = 0; k < _gdim; ++k)
      points[flow.to * width + k]
          += flow.moment
             * (_x[flow.from * _gdim + k] - _x[flow.to * _gdim + k]);
  std::vector<double> every = _slaves->scatter_forward(points, width);
  const std::vector<double> at_multipliers = every;
  const Fit raw = fit(flows, every);
  for (int pass = 0; pass < slope_passes; ++pass)
  {
    for (const Flow& flow : flows)
      for (int k = 0; k < width; ++k)
        points[flow.to * width + k]
            += flow.rate
               * (every[flow.from * width + k] - every[flow.to * width + k]);
    every = _slaves->scatter_forward(points, width);
  }
  const Fit smooth = fit(flows, every);
  const Rim rim = this->rim(closed);
  const std::vector<double> scatter
      = scatter_behind(flows, at_multipliers, rim);
  const std::vector<double> slopes
      = _slaves->scatter_forward(smooth.slope, _gdim);
  const std::vector<double> places
      = _slaves->scatter_forward(smooth.place, _gdim);
  const std::vector<double> across
      = _slaves->scatter_forward(rim.across, _gdim * _gdim);

  // What is across the edge, and its direction
  std::vector<Vector<3>> gradient(n), up(n, Vector<3>{});
  for (std::size_t i = 0; i < n; ++i)
  {
    gradient[i]
        = times(&across[i * _gdim * _gdim], vector_at(slopes, i, _gdim), _gdim);
    const double size = norm(gradient[i]);
    if (size > 0 and dot(gradient[i], vector_at(rim.out, i, _gdim)) > 0)
      up[i] = (1 / size) * gradient[i];
  }
  // Means of slope and place of those behind a node
  std::vector<double> all(n, 0), behind(n, 0), slope(n, 0), place(n, 0);
  for (const Flow& flow : flows)
  {
    const Vector<3>& e = up[flow.to];
    const Vector<3> there = times(&across[flow.from * _gdim * _gdim], e, _gdim);
    // Those of the same edge are not
    const double weight = flow.weight * std::max(1 - dot(e, there), 0.);
    all[flow.to] += flow.weight;
    behind[flow.to] += weight;
    slope[flow.to] += weight * dot(e, vector_at(slopes, flow.from, _gdim));
    place[flow.to] += weight * dot(e, vector_at(places, flow.from, _gdim));
  }
  std::vector<double> share(n, 0);
  for (std::size_t i = 0; i < n; ++i)
  {
    const double own = dot(up[i], vector_at(slopes, i, _gdim));
    if (not(own > 0))
      continue;
    const Vector<3> at = vector_at(places, i, _gdim);
    const double ahead = dot(up[i], vector_at(_x, i, _gdim) - at);
    double as_line = 1;
    if (behind[i] > 1e-6 * all[i])
    {
      const double step = dot(up[i], at) - place[i] / behind[i];
      if (ahead > 0 and step > 1e-9 * ahead)
        as_line += ahead / step * (1 - slope[i] / behind[i] / own);
    }
    const double explained
        = own * own
          * dot(up[i], times(&raw.spread[i * _gdim * _gdim], up[i], _gdim));
    const double left = std::max(raw.left[i], scatter[i]);
    if (explained > 0)
      share[i] = std::clamp(as_line, 0., 1.)
                 * std::max(1 - beyond_scatter * left / explained, 0.);
  }

  // From where the pressure is higher to where it is lower
  std::vector<double> at_edge(n * _gdim), above(n, 0), from_above(flows.size());
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < _gdim; ++k)
      at_edge[i * _gdim + k] = share[i] * gradient[i][k];
  for (std::size_t f = 0; f < flows.size(); ++f)
  {
    const auto& flow = flows[f];
    const Vector<3> edge
        = vector_at(_x, flow.from, _gdim) - vector_at(_x, flow.to, _gdim);
    from_above[f]
        = flow.weight
          * std::max(dot(edge, vector_at(slopes, flow.to, _gdim)), 0.);
    above[flow.to] += from_above[f];
  }
  Slope result{_slaves->scatter_forward(at_edge, _gdim),
               _slaves->scatter_forward(share)};
  std::vector<double> sum(n * _gdim);
  for (int row = 1; row < slope_rows; ++row)
  {
    std::ranges::fill(sum, 0);
    for (std::size_t f = 0; f < flows.size(); ++f)
      for (int k = 0; k < _gdim; ++k)
        sum[flows[f].to * _gdim + k]
            += from_above[f] * result.values[flows[f].from * _gdim + k];
    for (std::size_t i = 0; i < n; ++i)
    {
      Vector<3> mean = above[i] > 0 ? (1 / above[i]) * vector_at(sum, i, _gdim)
                                    : Vector<3>{};
      if (share[i] > 0)
        mean = mean - times(&across[i * _gdim * _gdim], mean, _gdim);
      const double size = dot(mean, mean);
      const double part
          = size > 0 ? std::clamp(dot(mean, vector_at(slopes, i, _gdim)) / size,
                                  0., 1.)
                     : 0;
      for (int k = 0; k < _gdim; ++k)
        sum[i * _gdim + k] = at_edge[i * _gdim + k] + part * mean[k];
    }
    result.values = _slaves->scatter_forward(sum, _gdim);
  }
  return result;
}
