// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "cone.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::law;

namespace
{
/// A scalar, then a vector of three at most
ConeVector joined(double scalar, const double* vector, int size)
{
  ConeVector v(1 + size);
  v << scalar, Eigen::Map<const Eigen::VectorXd>(vector, size);
  return v;
}

/// v0^2 - |v1|^2 without cancellation
double det(const ConeVector& v)
{
  const double length = v.tail(v.size() - 1).norm();
  return std::max((v[0] - length) * (v[0] + length),
                  std::numeric_limits<double>::min());
}

/// v with its vector turned round
ConeVector reflected(ConeVector v)
{
  v.tail(v.size() - 1) *= -1;
  return v;
}

/// Jordan's product
ConeVector jordan(const ConeVector& a, const ConeVector& b)
{
  ConeVector c = a[0] * b + b[0] * a;
  c[0] = a.dot(b);
  return c;
}
} // namespace

ConePair::ConePair(const ConeVector& x, const ConeVector& y)
    : _x(x), _factor(std::sqrt(det(y) / det(x)))
{
  const ConeVector a = x / std::sqrt(det(x)), b = y / std::sqrt(det(y));
  _u = (b + reflected(a)) / std::sqrt(2 * (1 + std::max(a.dot(b), 1.0)));
  _q = _u;
  _q[0] += 1;
  _q /= std::sqrt(2 * (1 + _u[0]));
}

/// (2 q q^T - J) v
ConeVector ConePair::mirrored(const ConeVector& v, const ConeVector& q) const
{
  return 2 * q.dot(v) * q - reflected(v);
}

ConeVector ConePair::scaled(const ConeVector& v) const
{
  return _factor * mirrored(v, _u);
}

ConeVector ConePair::first_column() const
{
  return scaled(ConeVector::Unit(_x.size(), 0));
}

Eigen::MatrixXd ConePair::block() const
{
  const auto u = _u.tail(_u.size() - 1);
  return _factor
         * (2 * u * u.transpose()
            + Eigen::MatrixXd::Identity(u.size(), u.size()));
}

ConeVector ConePair::inverse() const { return reflected(_x) / det(_x); }

ConeVector ConePair::correction(const ConeVector& dx,
                                const ConeVector& dy) const
{
  const double root = std::sqrt(_factor);
  const ConeVector v = root * mirrored(_x, _q);
  const ConeVector r
      = jordan(root * mirrored(dx, _q), mirrored(dy, reflected(_q)) / root);
  ConeVector z = r;
  z[0] = v.dot(reflected(r)) / det(v);
  z.tail(z.size() - 1)
      = (r.tail(r.size() - 1) - z[0] * v.tail(v.size() - 1)) / v[0];
  return -root * mirrored(z, _q);
}

double contactx::law::step_to_boundary(const ConeVector& x,
                                       const ConeVector& dx)
{
  const auto inner = [](const ConeVector& a, const ConeVector& b)
  { return a.dot(reflected(b)); };
  const double a = inner(dx, dx), b = inner(x, dx), c = det(x);
  double least = std::numeric_limits<double>::infinity();
  if (dx[0] < 0)
    least = -x[0] / dx[0];
  if (const double root = b * b - a * c; root >= 0)
  {
    const double q = -(b + std::copysign(std::sqrt(root), b));
    for (const double t : {q / a, c / q})
      if (std::isfinite(t) and t > 0)
        least = std::min(least, t);
  }
  return least;
}

ConeVector contactx::law::bound_and_traction(const Interior& in, std::size_t i)
{
  return joined(in.bound[i], &in.traction[in.gdim * i], in.gdim);
}

ConeVector contactx::law::slip_slacks(const Interior& in, std::size_t i)
{
  return joined(in.slip_length[i], &in.slip[in.gdim * i], in.gdim);
}

ConePair contactx::law::pair_of(const Interior& in, std::size_t i)
{
  return {bound_and_traction(in, i), slip_slacks(in, i)};
}
