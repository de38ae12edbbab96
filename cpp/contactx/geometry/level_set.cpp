// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "level_set.h"
#include "../check.h"
#include "../math/matrix.h"
#include "../math/scales.h"
#include "meeting.h"
#include "parameters.h"
#include "shape.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::geometry;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
void require_values(const std::vector<double>& values, std::size_t size,
                    const char* name)
{
  if (values.size() != size)
    throw std::invalid_argument(std::string(name) + " of a LevelSet gave "
                                + std::to_string(values.size())
                                + " values: it must give "
                                + std::to_string(size));
}

/// The faces of a level set as one point sees them: planes, to first order.
struct Faces
{
  std::vector<Vector<3>> normal;
  std::vector<double> distance, size; ///< size of each gradient
  std::size_t largest = 0;            ///< the face that gives the value
  double value = -infinity;
  bool is_finite = true;

  Faces(const LevelValues& f, std::size_t n, std::size_t point, int gdim)
  {
    const std::size_t count = f.value.size() / n;
    normal.resize(count);
    distance.resize(count);
    size.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t row = i * n + point;
      const double here = f.value[row];
      const Vector<3> gradient = vector_at(f.gradient, row, gdim);
      size[i] = norm(gradient);
      is_finite = is_finite and std::isfinite(here) and std::isfinite(size[i]);
      // A constant bounds nothing
      distance[i] = size[i] > 0 ? here / size[i] : -infinity;
      if (size[i] > 0 and is_finite)
        normal[i] = (1 / size[i]) * gradient;
      if (here > value)
      {
        value = here;
        largest = i;
      }
    }
  }

  bool has_normal() const { return is_finite and size[largest] > 0; }
};

/// The nearest point of a level set: on a face, or on a ridge or apex.
struct Nearest
{
  double gap;
  Vector<3> normal;
  std::size_t face; ///< where there is no ridge
  std::optional<Meeting> ridge{};
  bool touches = false; ///< the ridge, so that the normal is its cone's axis
};

/// The axis of the cone of normals of the faces that meet within a distance
/// from a point, nothing where they face away from one another.
std::optional<Meeting> axis(const Faces& faces, std::size_t nearest,
                            double within, int gdim)
{
  std::vector<Vector<3>> normal;
  std::vector<int> which;
  const Vector<3>& n = faces.normal[nearest];
  for (std::size_t i = 0; i < faces.distance.size(); ++i)
    // By the distance from the plane where both faces are as near
    if (faces.distance[nearest] - faces.distance[i]
        <= within * norm(faces.normal[i] - n))
    {
      normal.push_back(faces.normal[i]);
      which.push_back(static_cast<int>(i));
    }
  if (which.size() == 1)
    return std::nullopt;
  const std::vector<double> equal(which.size(), 1.);
  auto found = meeting(normal, equal, gdim);
  if (found)
    for (int k = 0; k < found->count; ++k)
      found->plane[k] = which[found->plane[k]];
  return found;
}

/// Part that a face has in the axis of a cone, which is the shortest of the
/// means of the normals.
double part(const Meeting& cone, int i)
{
  return cone.share[i] / dot(cone.offset, cone.offset);
}

/// A body of several faces is convex: from outside its nearest point is that of
/// the planes' half-spaces, from inside that of the nearest plane. On a ridge
/// the normal is the axis of the cone of normals, and the gap is along it.
/// @param[in] width Distance from a ridge within which a point is on it.
Nearest nearest(const Faces& faces, double width, int gdim)
{
  const auto& distance = faces.distance;
  if (distance.size() == 1)
    return {distance[0], faces.normal[0], 0};
  const auto first = static_cast<std::size_t>(std::ranges::max_element(distance)
                                              - distance.begin());
  if (distance[first] > width)
  {
    const auto found = meeting(faces.normal, distance, gdim);
    if (not found)
      return {distance[faces.largest], faces.normal[faces.largest],
              faces.largest};
    const std::size_t face = found->plane[0];
    if (found->count == 1)
      return {distance[face], faces.normal[face], face};
    const double offset = norm(found->offset);
    return {offset, (1 / offset) * found->offset, face, found};
  }
  if (const auto cone = axis(faces, first, width, gdim))
  {
    double gap = 0;
    for (int i = 0; i < cone->count; ++i)
      gap += part(*cone, i) * distance[cone->plane[i]];
    return {gap, (1 / norm(cone->offset)) * cone->offset, first, cone, true};
  }
  return {distance[first], faces.normal[first], first};
}

/// Second derivatives of a face at a point, by the size of its gradient.
Matrix3d bends(const LevelValues& f, std::size_t n, std::size_t point,
               std::size_t face, double size, int gdim)
{
  Matrix3d H = Matrix3d::Zero();
  H.topLeftCorner(gdim, gdim)
      = Eigen::Map<const math::Small>(
            &f.hessian[gdim * gdim * (face * n + point)], gdim, gdim)
        / size;
  return H;
}

Eigen::Map<const Vector3d> column(const Vector<3>& v)
{
  return Vector3d::Map(v.data());
}

/// Without what is along a unit vector: (I - n n^T) A.
Matrix3d across(const Matrix3d& A, const Vector3d& n)
{
  return A - n * (n.transpose() * A);
}

/// Derivatives of gap and normal by the position.
struct Turn
{
  Vector3d gradient;
  Matrix3d curvature;
};

Turn turn_of_face(const Nearest& at, const Matrix3d& H)
{
  const auto n = column(at.normal);
  return {n - at.gap * H * n, across(H, n)};
}

/// Derivative of the vector d = sum m_i n_i that has the distances c_i = n_i .
/// d from planes. With the dual vectors b_i of the n_i, whose derivatives are
/// N_i, S = sum m_i N_i and Q = sum b_i n_i^T it is d' = (1 - Q) S + sum b_i
/// (c_i' - N_i^T d).
/// @param[in] N Derivatives of the planes' normals.
/// @param[in] distance Derivatives of the distances.
Matrix3d offset_turns(const Meeting& at, std::span<const Vector<3>> normal,
                      std::span<const Matrix3d> N,
                      std::span<const Vector3d> distance)
{
  Matrix3d S = Matrix3d::Zero();
  for (int i = 0; i < at.count; ++i)
    S += at.share[i] * N[i];
  Matrix3d offset = S;
  for (int i = 0; i < at.count; ++i)
    offset += column(at.dual[i])
              * (distance[i] - N[i].transpose() * column(at.offset)
                 - S.transpose() * column(normal[at.plane[i]]))
                    .transpose();
  return offset;
}

/// On a ridge: the vector is that to all planes at the distance one.
Turn turn_of_axis(const Nearest& at, std::span<const Matrix3d> H,
                  const Faces& faces)
{
  const Meeting& cone = *at.ridge;
  Turn turn{Vector3d::Zero(), {}};
  std::array<Matrix3d, 3> N;
  for (int i = 0; i < cone.count; ++i)
  {
    const auto n = column(faces.normal[cone.plane[i]]);
    N[i] = across(H[i], n);
    turn.gradient
        += part(cone, i) * (n - faces.distance[cone.plane[i]] * H[i] * n);
  }
  const std::array<Vector3d, 3> none{Vector3d::Zero(), Vector3d::Zero(),
                                     Vector3d::Zero()};
  turn.curvature
      = across(offset_turns(cone, faces.normal, N, none), column(at.normal))
        / norm(cone.offset);
  return turn;
}

/// Beyond a ridge: the vector is that from it. Gradients in place of normals,
/// whose derivatives are symmetric, and the values of the functions.
Turn turn_of_ridge(const Nearest& at, std::span<const Matrix3d> H,
                   const Faces& faces)
{
  const Meeting& ridge = *at.ridge;
  std::array<Vector3d, 3> distance;
  for (int i = 0; i < ridge.count; ++i)
    distance[i] = column(faces.normal[ridge.plane[i]]);
  const Matrix3d offset = offset_turns(ridge, faces.normal, H, distance);
  const auto n = column(at.normal);
  return {offset.transpose() * n, across(offset, n) / at.gap};
}
} // namespace

LevelSet::LevelSet(Function f, Parameters parameters,
                   std::optional<Velocity> velocity)
    : _f(std::move(f)), _parameters(std::move(parameters)),
      _velocity(std::move(velocity))
{
}

LevelValues LevelSet::values(std::span<const double> x, int gdim,
                             int order) const
{
  // A rank without slave nodes: no function needs to take that
  if (x.empty())
    return {};
  const std::size_t n = x.size() / gdim;
  LevelValues at = _f(x, gdim, order);
  const std::size_t faces = std::max<std::size_t>(1, at.value.size() / n);
  require_values(at.value, faces * n, "the function");
  if (order > 0)
    require_values(at.gradient, faces * n * gdim, "the gradient");
  if (order > 1 and not at.hessian.empty())
    require_values(at.hessian, faces * n * gdim * gdim,
                   "the second derivative");
  return at;
}

/// Not a length of these points alone where there is another one: which ones
/// they are depends on the partition.
double LevelSet::scene_size(std::span<const double> x, int gdim) const
{
  if (extent > 0)
    return extent;
  double size = 0;
  for (int k = 0; k < gdim; ++k)
  {
    double low = x[k], high = x[k];
    for (std::size_t i = k; i < x.size(); i += gdim)
    {
      low = std::min(low, x[i]);
      high = std::max(high, x[i]);
    }
    size = std::max(size, high - low);
  }
  return size;
}

double LevelSet::ridge_width(std::span<const double> x, int gdim) const
{
  return std::max(facet_margin * facet, math::round_off * scene_size(x, gdim));
}

std::vector<double> LevelSet::differences(std::span<const double> x,
                                          int gdim) const
{
  const std::size_t n = x.size() / gdim;
  const double size = std::max(scene_size(x, gdim), 1e-30);
  std::vector<double> h(n), H;
  for (std::size_t i = 0; i < n; ++i)
  {
    double largest = 0;
    for (int k = 0; k < gdim; ++k)
      largest = std::max(largest, std::abs(x[gdim * i + k]));
    h[i] = 1e-6 * std::max(largest * 1e-3, size);
  }
  std::vector<double> moved;
  for (int k = 0; k < gdim; ++k)
  {
    const auto gradient = [&](double sign)
    {
      moved.assign(x.begin(), x.end());
      for (std::size_t i = 0; i < n; ++i)
        moved[gdim * i + k] += sign * h[i];
      return values(moved, gdim, 1).gradient;
    };
    const std::vector<double> plus = gradient(1), minus = gradient(-1);
    H.resize(plus.size() * gdim);
    for (std::size_t i = 0; i < plus.size() / gdim; ++i)
      for (int j = 0; j < gdim; ++j)
        H[gdim * (gdim * i + j) + k]
            = (plus[gdim * i + j] - minus[gdim * i + j]) / (2 * h[i % n]);
  }
  for (std::size_t i = 0; i < H.size(); i += gdim * gdim)
    for (int j = 0; j < gdim; ++j)
      for (int k = 0; k < j; ++k)
      {
        double &a = H[i + gdim * j + k], &b = H[i + gdim * k + j];
        a = b = (a + b) / 2;
      }
  return H;
}

void LevelSet::evaluate(std::span<const double> x, int gdim, Geometry& at)
{
  const std::size_t n = x.size() / gdim;
  at.resize(n, gdim);
  if (n == 0)
    return;
  LevelValues f = values(x, gdim, 2);
  if (f.hessian.empty())
    f.hessian = differences(x, gdim);
  const double width = ridge_width(x, gdim);
  std::size_t bad = 0, first = 0;
  for (std::size_t i = n; i-- > 0;)
  {
    const Faces faces(f, n, i, gdim);
    if (not faces.has_normal())
    {
      ++bad;
      first = i;
      continue;
    }
    const Nearest seen = nearest(faces, width, gdim);
    std::array<Matrix3d, 3> H;
    const auto bend = [&](std::size_t face)
    { return bends(f, n, i, face, faces.size[face], gdim); };
    Turn turn;
    if (seen.ridge)
    {
      for (int k = 0; k < seen.ridge->count; ++k)
        H[k] = bend(seen.ridge->plane[k]);
      turn = seen.touches ? turn_of_axis(seen, H, faces)
                          : turn_of_ridge(seen, H, faces);
    }
    else
      turn = turn_of_face(seen, bend(seen.face));
    at.gap[i] = seen.gap;
    std::copy_n(seen.normal.begin(), gdim, &at.normal[gdim * i]);
    std::copy_n(turn.gradient.data(), gdim, &at.gradient[gdim * i]);
    Eigen::Map<math::Small>(&at.curvature[gdim * gdim * i], gdim, gdim)
        = turn.curvature.topLeftCorner(gdim, gdim);
  }
  if (bad > 0)
    throw check::Undefined(
        "the function of a LevelSet or its gradient is not finite, or the "
        "gradient zero, at "
        + std::to_string(bad) + " slave nodes, first at "
        + text(x.subspan(gdim * first, gdim))
        + ": the gradient must point outward wherever a slave node may come "
          "(manual: errors/level-set-values)");
}

Placement LevelSet::placement(int gdim)
{
  Placement now{std::vector<double>(gdim, 0.0)};
  if (_velocity)
    now.time = _velocity->time();
  if (not std::isfinite(now.time))
    throw std::invalid_argument(
        "the time of a LevelSet is not finite: give a finite number "
        "(manual: errors/level-set-values)");
  return now;
}

std::vector<double> LevelSet::velocity(std::span<const double> x,
                                       int gdim) const
{
  std::vector<double> v = _velocity->values(x, gdim);
  require_values(v, x.size(), "the velocity");
  const auto bad = std::ranges::find_if(
      v, [](double component) { return not std::isfinite(component); });
  if (bad != v.end())
    throw std::invalid_argument(
        "the velocity of a LevelSet is not finite at "
        + text(x.subspan((bad - v.begin()) / gdim * gdim, gdim))
        + ": let it return finite numbers (manual: errors/level-set-values)");
  return v;
}

/// The method of Runge and Kutta of fourth order: a quarter of a turn in one
/// step is off by 2e-5 radii.
std::vector<double> LevelSet::carry(std::span<const double> x,
                                    const Placement& from, const Placement& to)
{
  std::vector<double> at(x.begin(), x.end());
  if (not _velocity or x.empty() or to.time == from.time)
    return at;
  const int gdim = static_cast<int>(from.point.size());
  constexpr int substeps = 4;
  const double dt = (to.time - from.time) / substeps;
  const std::size_t n = x.size();
  for (int part = 0; part < substeps; ++part)
  {
    const std::vector<double> start = at;
    std::vector<double> sum(n, 0), moved = start;
    for (int stage = 0; stage < 4; ++stage)
    {
      const std::vector<double> v = velocity(moved, gdim);
      const double weight = stage == 0 or stage == 3 ? 1. / 6 : 1. / 3;
      const double reach = stage == 2 ? 1 : 0.5;
      for (std::size_t i = 0; i < n; ++i)
      {
        sum[i] += weight * v[i];
        moved[i] = start[i] + reach * dt * v[i];
      }
    }
    for (std::size_t i = 0; i < n; ++i)
      at[i] = start[i] + dt * sum[i];
  }
  return at;
}

std::vector<double> LevelSet::distance(std::span<const double> x, int gdim)
{
  const std::size_t n = x.size() / gdim;
  if (n == 0)
    return {};
  const LevelValues f = values(x, gdim, 1);
  const double width = ridge_width(x, gdim);
  std::vector<double> gap(n, infinity);
  for (std::size_t i = 0; i < n; ++i)
    if (const Faces faces(f, n, i, gdim); faces.has_normal())
      gap[i] = nearest(faces, width, gdim).gap;
    else if (faces.is_finite)
      gap[i] = std::copysign(infinity, faces.value);
  return gap;
}

std::vector<double> LevelSet::normals(std::span<const double> x, int gdim)
{
  const std::size_t n = x.size() / gdim;
  if (n == 0)
    return {};
  const LevelValues f = values(x, gdim, 1);
  const double width = ridge_width(x, gdim);
  std::vector<double> normal(x.size(), 0);
  for (std::size_t i = 0; i < n; ++i)
    if (const Faces faces(f, n, i, gdim); faces.has_normal())
      std::ranges::copy_n(nearest(faces, width, gdim).normal.begin(), gdim,
                          &normal[gdim * i]);
  return normal;
}

std::vector<double> LevelSet::level(std::span<const double> x, int gdim)
{
  const std::size_t n = x.size() / gdim;
  std::vector<double> value = values(x, gdim, 0).value;
  for (std::size_t i = n; i < value.size(); ++i)
    value[i % n] = std::max(value[i % n], value[i]);
  value.resize(n);
  return value;
}

std::vector<double> LevelSet::parameters(int gdim)
{
  return _parameters ? _parameters(gdim) : std::vector<double>{};
}

std::string LevelSet::usual_mistake() const
{
  return "Perhaps the sign of its function is wrong: it must be positive where "
         "bodies may be";
}
