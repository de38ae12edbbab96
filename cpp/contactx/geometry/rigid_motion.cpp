// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "rigid_motion.h"

using namespace contactx;
using namespace contactx::geometry;

namespace
{
using Matrix = std::array<Vector<3>, 3>;

constexpr Matrix identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Correlation of the turned start with the end up to which the surface has not
/// moved like a rigid body: no rotation fits all of its parts
constexpr double correlation_min = 0.5;

/// Difference of the correlations of two rotations up to which the best one is
/// not unique: nodes on a line may be turned around it
constexpr double correlation_gap_min = 1e-10;

/// Largest eigenvalue, the next one, and the first one's eigenvector.
struct Largest
{
  double value, next;
  std::array<double, 4> vector;
};

/// Jacobi's method on a symmetric matrix.
Largest largest_eigenvalue(std::array<std::array<double, 4>, 4> a)
{
  std::array<std::array<double, 4>, 4> v{};
  for (int k = 0; k < 4; ++k)
    v[k][k] = 1;
  for (int sweep = 0; sweep < 30; ++sweep)
  {
    double off = 0, all = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
      {
        all += a[i][j] * a[i][j];
        off += i == j ? 0 : a[i][j] * a[i][j];
      }
    if (!(off > 1e-34 * all))
      break;
    for (int p = 0; p < 4; ++p)
      for (int q = p + 1; q < 4; ++q)
      {
        if (a[p][q] == 0)
          continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t
            = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::hypot(theta, 1.));
        const double c = 1 / std::hypot(t, 1.), s = t * c;
        for (int k = 0; k < 4; ++k)
        {
          const double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y;
          a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < 4; ++k)
        {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y;
          a[q][k] = s * x + c * y;
          const double vx = v[k][p], vy = v[k][q];
          v[k][p] = c * vx - s * vy;
          v[k][q] = s * vx + c * vy;
        }
      }
  }
  int first = 0;
  for (int k = 1; k < 4; ++k)
    if (a[k][k] > a[first][first])
      first = k;
  Largest found{a[first][first], -std::abs(a[first][first]), {}};
  for (int k = 0; k < 4; ++k)
  {
    found.vector[k] = v[k][first];
    if (k != first)
      found.next = std::max(found.next, a[k][k]);
  }
  return found;
}

/// Rotation in 2D: of its angle the sums of dot and cross products are
/// cosine and sine.
Matrix plane_rotation(const Matrix& h, double scale)
{
  const double c = h[0][0] + h[1][1], s = h[0][1] - h[1][0];
  const double length = std::hypot(c, s);
  if (!(length > correlation_min * scale))
    return identity;
  return {
      {{c / length, -s / length, 0}, {s / length, c / length, 0}, {0, 0, 1}}};
}

/// Rotation in 3D by Horn's quaternion, which is proper for flat surfaces,
/// too.
Matrix space_rotation(Matrix h, double scale)
{
  for (auto& row : h)
    row = (1 / scale) * row;
  const auto n = largest_eigenvalue(
      {{{h[0][0] + h[1][1] + h[2][2], h[1][2] - h[2][1], h[2][0] - h[0][2],
         h[0][1] - h[1][0]},
        {h[1][2] - h[2][1], h[0][0] - h[1][1] - h[2][2], h[0][1] + h[1][0],
         h[2][0] + h[0][2]},
        {h[2][0] - h[0][2], h[0][1] + h[1][0], h[1][1] - h[0][0] - h[2][2],
         h[1][2] + h[2][1]},
        {h[0][1] - h[1][0], h[2][0] + h[0][2], h[1][2] + h[2][1],
         h[2][2] - h[0][0] - h[1][1]}}});
  if (!(n.value > correlation_min and n.value - n.next > correlation_gap_min))
    return identity;
  const auto [w, x, y, z] = n.vector;
  return {
      {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
       {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
       {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}
} // namespace

Moments contactx::geometry::moments(const FacetList& facets,
                                    std::span<const double> x0,
                                    std::span<const double> x1, int gdim,
                                    const Vector<3>& origin0,
                                    const Vector<3>& origin1)
{
  Moments m{};
  for (const std::int32_t node : facets.nodes)
  {
    Vector<3> p{}, q{};
    for (int k = 0; k < gdim; ++k)
    {
      p[k] = x0[static_cast<std::size_t>(node) * gdim + k] - origin0[k];
      q[k] = x1[static_cast<std::size_t>(node) * gdim + k] - origin1[k];
    }
    m[0] += 1;
    for (int i = 0; i < 3; ++i)
    {
      m[1 + i] += p[i];
      m[4 + i] += q[i];
      for (int k = 0; k < 3; ++k)
        m[9 + 3 * i + k] += p[i] * q[k];
    }
    m[7] += dot(p, p);
    m[8] += dot(q, q);
  }
  return m;
}

RigidMotion contactx::geometry::rigid_motion(const Moments& m, int gdim,
                                             const Vector<3>& origin0,
                                             const Vector<3>& origin1)
{
  if (!(m[0] > 0))
    return {identity, origin0, origin1};
  const Vector<3> p{m[1] / m[0], m[2] / m[0], m[3] / m[0]};
  const Vector<3> q{m[4] / m[0], m[5] / m[0], m[6] / m[0]};
  Matrix h;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      h[i][k] = m[9 + 3 * i + k] - m[0] * p[i] * q[k];
  const double scale = std::sqrt(std::max(m[7] - m[0] * dot(p, p), 0.))
                       * std::sqrt(std::max(m[8] - m[0] * dot(q, q), 0.));
  RigidMotion motion{identity, origin0 + p, origin1 + q};
  if (scale > 0)
    motion.rotation
        = gdim == 2 ? plane_rotation(h, scale) : space_rotation(h, scale);
  return motion;
}
