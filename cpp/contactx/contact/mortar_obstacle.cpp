// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "mortar_obstacle.h"
#include "../geometry/gather.h"
#include "../geometry/quadrature.h"
#include "../kernel/layout.h"
#include "../math/matrix.h"
#include "mobility.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::contact;

namespace
{
template <class F>
struct RulePoint
{
  geometry::Local<F> xi;
  double weight;
};

/// Rule on a facet's local coordinates, exact for polynomials of degree 4, on
/// quadrilaterals in each of the two.
template <class F>
std::vector<RulePoint<F>> rule()
{
  std::vector<RulePoint<F>> points;
  if constexpr (F::nodes == 3)
  {
    // Strang and Fix (1973), Dunavant (1985): two orbits of three points
    const double s = std::sqrt(10.0), t = std::sqrt(38 - 44 * std::sqrt(0.4));
    const double u = std::sqrt(213125 - 53320 * s);
    for (const double sign : {-1.0, 1.0})
    {
      const double a = (8 - s + sign * t) / 18;
      const double w = (620 + sign * u) / 7440;
      points.push_back({{1 - 2 * a, a}, w});
      points.push_back({{a, 1 - 2 * a}, w});
      points.push_back({{a, a}, w});
    }
  }
  else
    for (const auto& [a, wa] : geometry::gauss(3))
    {
      if constexpr (F::tdim == 1)
        points.push_back({{a}, wa});
      else
        for (const auto& [b, wb] : geometry::gauss(3))
          points.push_back({{a, b}, wa * wb});
    }
  return points;
}

/// Area, or length, of a facet by that of its local coordinates.
template <class F>
double stretch(const geometry::Nodes<F>& x, const geometry::Local<F>& xi)
{
  const auto dN = F::derivative(xi);
  if constexpr (F::tdim == 1)
    return norm(geometry::combine<F>(dN[0], x));
  else
    return norm(
        cross(geometry::combine<F>(dN[0], x), geometry::combine<F>(dN[1], x)));
}
} // namespace

MortarObstacle::MortarObstacle(std::shared_ptr<geometry::Obstacle> obstacle,
                               std::shared_ptr<const SlaveNodes> slaves,
                               std::span<const double> x, int gdim,
                               double reach, bool measures_slip)
    : ObstacleMaster(std::move(obstacle), std::move(slaves), x, gdim, reach,
                     measures_slip),
      _faces(_slaves->corners().size(), 1), _positions(x.begin(), x.end())
{
  add_kind<geometry::Segment>(x);
  add_kind<geometry::Triangle>(x);
  add_kind<geometry::Quadrilateral>(x);
}

template <class F>
void MortarObstacle::add_kind(std::span<const double> x)
{
  constexpr int k = F::nodes;
  const std::vector<RulePoint<F>> points = rule<F>();
  Kind kind;
  kind.k = k;
  kind.q = static_cast<int>(points.size());
  for (const auto& point : points)
  {
    const auto N = F::shape(point.xi);
    kind.N.insert(kind.N.end(), N.begin(), N.end());
  }
  const std::vector<double> weight = _slaves->corner_weight();
  for (std::size_t f = 0; f + 1 < _slaves->facets().offsets.size(); ++f)
  {
    const std::int32_t first = _slaves->facets().offsets[f];
    if (_slaves->facets().offsets[f + 1] - first != k)
      continue;
    const auto xs
        = geometry::gather<F>(_slaves->facets().nodes.subspan(first, k), x);
    Eigen::Matrix<double, k, k> mass = decltype(mass)::Zero();
    Vector<k> whole{}, factor;
    factor.fill(1);
    if (not weight.empty())
      std::copy_n(weight.begin() + first, k, factor.begin());
    std::vector<double> area(kind.q);
    for (int p = 0; p < kind.q; ++p)
    {
      const auto N = F::shape(points[p].xi);
      area[p] = stretch<F>(xs, points[p].xi) * points[p].weight;
      if (not weight.empty())
        area[p] *= dot(factor, N);
      whole = whole + area[p] * N;
      const auto column = math::column(N);
      mass += area[p] * column * column.transpose();
    }
    const auto dual = math::positive_inverse(mass);
    if (not dual)
      throw std::invalid_argument("a slave facet has no area");
    for (int s = 0; s < k; ++s)
    {
      kind.corners.push_back(first + s);
      for (int p = 0; p < kind.q; ++p)
        kind.weight.push_back(
            area[p] * whole[s]
            * dual->row(s).dot(math::column(F::shape(points[p].xi))));
    }
  }
  if (not kind.corners.empty())
    _kinds.push_back(std::move(kind));
}

std::vector<double> MortarObstacle::integrate(const Kind& kind,
                                              std::span<const double> x)
{
  const int k = kind.k, q = kind.q, g = _gdim;
  const std::size_t m = kind.corners.size() / k;
  _points.assign(m * q * g, 0.0);
  for (std::size_t f = 0; f < m; ++f)
    for (int p = 0; p < q; ++p)
      for (int t = 0; t < k; ++t)
      {
        const std::size_t node
            = _slaves->facets().nodes[kind.corners[k * f + t]];
        for (int d = 0; d < g; ++d)
          _points[g * (q * f + p) + d] += kind.N[k * p + t] * x[g * node + d];
      }
  _obstacle->evaluate(_points, g, _there);

  const kernel::RigidMortarLayout at(k, g);
  std::vector<double> data(m * at.size, 0.0);
  for (std::size_t f = 0; f < m; ++f)
    for (int s = 0; s < k; ++s)
    {
      if (not _faces[kind.corners[k * f + s]])
        continue;
      double* row = &data[f * at.size];
      for (int p = 0; p < q; ++p)
      {
        const std::size_t point = q * f + p;
        const double w = kind.weight[q * (k * f + s) + p];
        row[at.area + s] += w;
        row[at.gap + s] += w * _there.gap[point];
        for (int i = 0; i < g; ++i)
          row[at.normal + g * s + i] += w * _there.normal[g * point + i];
        for (int t = 0; t < k; ++t)
        {
          const double wt = w * kind.N[k * p + t];
          double* gradient = row + at.gradient + g * (k * s + t);
          double* curvature = row + at.curvature + g * g * (k * s + t);
          for (int i = 0; i < g; ++i)
            gradient[i] += wt * _there.gradient[g * point + i];
          for (int i = 0; i < g * g; ++i)
            curvature[i] += wt * _there.curvature[g * g * point + i];
        }
      }
    }
  return data;
}

std::vector<std::vector<double>>
MortarObstacle::integrate(std::span<const double> x)
{
  std::vector<std::vector<double>> values;
  for (const Kind& kind : _kinds)
    values.push_back(integrate(kind, x));
  return values;
}

Mobility MortarObstacle::mobility(std::span<const std::int8_t> free) const
{
  Mobility found = ObstacleMaster::mobility(free);
  // Facets move with the nodes beside one that is held
  const std::vector<double> normal = normals();
  for (std::size_t i = 0; i < size(); ++i)
    for (int k = 0; k < _gdim; ++k)
      if (is_inclined(normal[3 * i + k]))
        found.each[_gdim * i + k] = 1;
  return found;
}

void MortarObstacle::nodes_changed()
{
  // Those of owned nodes come first and stay
  _positions.resize(std::size_t(_slaves->nodes().num_nodes()) * _gdim);
  _slaves->nodes().forward(_positions, _gdim);
}

std::int32_t MortarObstacle::search(std::span<const double> x,
                                    std::span<const std::int8_t> closed)
{
  const std::int32_t changed = ObstacleMaster::search(x, closed);
  _values = integrate(x);
  _positions.assign(x.begin(), x.end());
  return changed;
}

void MortarObstacle::set_front_facets(std::span<const std::int8_t> faces)
{
  if (faces.size() != _faces.size())
    throw std::invalid_argument("faces must have a value for each corner");
  if (std::ranges::equal(faces, _faces))
    return;
  _faces.assign(faces.begin(), faces.end());
  _values = integrate(_positions);
}

std::vector<kernel::Pairs> MortarObstacle::pairs() const
{
  return group(_values);
}

std::vector<kernel::Pairs>
MortarObstacle::group(const std::vector<std::vector<double>>& values) const
{
  std::vector<kernel::Pairs> groups;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const Kind& kind = _kinds[i];
    kernel::Pairs p;
    p.num_slaves = kind.k;
    p.data_size = kernel::RigidMortarLayout(kind.k, _gdim).size;
    for (std::size_t f = 0; f < kind.corners.size() / kind.k; ++f)
    {
      const std::span corners
          = std::span(kind.corners).subspan(kind.k * f, kind.k);
      // Other ranks handle their own nodes
      const auto near = [this](std::int32_t corner)
      {
        const std::size_t place = _slaves->corners()[corner];
        return place < size() and _paired[place] and _faces[corner];
      };
      if (not std::ranges::any_of(corners, near))
        continue;
      for (std::int32_t corner : corners)
      {
        p.slaves.push_back(_slaves->corners()[corner]);
        p.nodes.push_back(_slaves->facets().nodes[corner]);
      }
      const auto row = values[i].begin() + f * p.data_size;
      p.data.insert(p.data.end(), row, row + p.data_size);
    }
    if (not p.slaves.empty())
      groups.push_back(std::move(p));
  }
  return groups;
}

std::optional<std::vector<kernel::Pairs>>
MortarObstacle::update(std::span<const double> x, bool frozen,
                       std::span<const double>)
{
  if (x.size() != _positions.size())
    throw std::invalid_argument("x must hold the positions of all nodes");
  if (not frozen)
    return group(integrate(x));
  std::vector<std::vector<double>> values = _values;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const Kind& kind = _kinds[i];
    const int k = kind.k, g = _gdim;
    const kernel::RigidMortarLayout at(k, g);
    for (std::size_t f = 0; f < kind.corners.size() / k; ++f)
    {
      double* row = &values[i][f * at.size];
      for (int s = 0; s < k; ++s)
      {
        double more = 0;
        for (int t = 0; t < k; ++t)
        {
          const std::size_t node
              = _slaves->facets().nodes[kind.corners[k * f + t]];
          for (int d = 0; d < g; ++d)
            more += row[at.gradient + g * (k * s + t) + d]
                    * (x[g * node + d] - _positions[g * node + d]);
        }
        row[at.gap + s] += more;
      }
      std::fill(row + at.curvature, row + at.size, 0.0);
    }
  }
  return group(values);
}

std::vector<double> MortarObstacle::origin() const
{
  return _measures_slip ? carried() : std::vector<double>{};
}

std::vector<Saved> MortarObstacle::save() const
{
  std::vector<Saved> saved = ObstacleMaster::save();
  saved.push_back({"positions", RowKind::node, _gdim, _positions});
  return saved;
}

void MortarObstacle::load(const std::vector<Saved>& saved)
{
  const auto& positions = values_of<double>(saved, "positions");
  const std::size_t owned = std::size_t(_slaves->nodes().num_owned()) * _gdim;
  if (positions.size() < owned)
    throw std::invalid_argument("positions must be those of all owned nodes");
  ObstacleMaster::load(saved);
  _positions.assign(positions.begin(), positions.begin() + owned);
  nodes_changed();
  _values = integrate(_positions);
}
