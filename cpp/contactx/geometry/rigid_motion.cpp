// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "rigid_motion.h"
#include "../math/scales.h"
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

using namespace contactx;
using namespace contactx::geometry;

namespace
{
using Eigen::Matrix3d;

/// Correlation of the turned start with the end up to which the surface has not
/// moved like a rigid body: no rotation fits all of its parts
constexpr double correlation_min = 0.5;

/// Rotation in the plane: of its angle the sums of dot and cross products are
/// cosine and sine.
Matrix3d plane_rotation(const Matrix3d& h, double scale)
{
  const double c = h(0, 0) + h(1, 1), s = h(0, 1) - h(1, 0);
  const double length = std::hypot(c, s);
  if (!(length > correlation_min * scale))
    return Matrix3d::Identity();
  return Matrix3d{
      {c / length, -s / length, 0}, {s / length, c / length, 0}, {0, 0, 1}};
}

/// Rotation in 3D by Horn's quaternion, which is proper for flat surfaces,
/// too.
Matrix3d space_rotation(const Matrix3d& h, double scale)
{
  // The quaternion's scalar part is last
  const Eigen::Vector3d turn{h(1, 2) - h(2, 1), h(2, 0) - h(0, 2),
                             h(0, 1) - h(1, 0)};
  Eigen::Matrix4d n;
  n << h + h.transpose() - h.trace() * Matrix3d::Identity(), turn,
      turn.transpose(), h.trace();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> found(n / scale);
  const Eigen::Vector4d& values = found.eigenvalues();
  // Two rotations may be as good: nodes on a line may be turned around it
  if (!(found.info() == Eigen::Success and values[3] > correlation_min
        and values[3] - values[2] > math::equal_rel_tol))
    return Matrix3d::Identity();
  return Eigen::Quaterniond(found.eigenvectors().col(3)).toRotationMatrix();
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
    return {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, origin0, origin1};
  const Vector<3> p{m[1] / m[0], m[2] / m[0], m[3] / m[0]};
  const Vector<3> q{m[4] / m[0], m[5] / m[0], m[6] / m[0]};
  Matrix3d h;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      h(i, k) = m[9 + 3 * i + k] - m[0] * p[i] * q[k];
  const double scale = std::sqrt(std::max(m[7] - m[0] * dot(p, p), 0.))
                       * std::sqrt(std::max(m[8] - m[0] * dot(q, q), 0.));
  RigidMotion motion{{}, origin0 + p, origin1 + q};
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(motion.rotation[0].data())
      = not(scale > 0) ? Matrix3d::Identity()
        : gdim == 2    ? plane_rotation(h, scale)
                       : space_rotation(h, scale);
  return motion;
}
