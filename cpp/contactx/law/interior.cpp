// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "interior.h"
#include "node_state.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::law;

namespace
{
using Map = Eigen::Map<const Eigen::VectorXd>;

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

Interior::Interior(const NodeState& nodes) : gdim(nodes.gdim())
{
  const std::size_t n = nodes.num_nodes();
  const std::size_t rows = nodes.is_vector() ? n * gdim : 0;
  is_on.assign(n, 0);
  has_friction.assign(n, 0);
  pressure.assign(n, 0);
  slack.assign(n, 0);
  bound.assign(n, 0);
  by_pressure.assign(n, 0);
  traction.assign(rows, 0);
  slip.assign(rows, 0);
  slip_length.assign(n, 0);
  normal.assign(rows, 0);
  product.assign(n, 0);
  correction.assign(nodes.is_vector() ? n * (1 + gdim) : 0, 0);
}

ConeVector Interior::x(std::size_t i) const
{
  ConeVector v(1 + gdim);
  v << bound[i], Map(&traction[gdim * i], gdim);
  return v;
}

ConeVector Interior::y(std::size_t i) const
{
  ConeVector v(1 + gdim);
  v << slip_length[i], Map(&slip[gdim * i], gdim);
  return v;
}

ConePair Interior::pair(std::size_t i) const { return {x(i), y(i)}; }

void contactx::law::interior_complementarity(NodeState& nodes)
{
  const Interior& in = *nodes.interior;
  const int g = nodes.size();
  using Rows = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  for (std::size_t i = 0; i < in.is_on.size(); ++i)
  {
    const Vector lambda = Map(&nodes.multiplier[g * i], g);
    Vector value = lambda, by_gap = Vector::Zero(g);
    Rows by_multiplier = Rows::Identity(g, g), by_slip = Rows::Zero(g, g),
         by_normal = by_slip;
    double scale = nodes.area[i];
    if (in.is_on[i])
    {
      scale *= nodes.c[i];
      const double p = in.pressure[i], compliance = in.slack[i] / p;
      const double height = nodes.gap[i] - (in.target - in.product[i]) / p;
      if (not nodes.is_vector())
      {
        value[0] = height;
        by_multiplier(0, 0) = compliance;
        by_gap[0] = 1;
      }
      else
      {
        const Vector n = Map(&nodes.normal[g * i], g);
        const Rows across = Rows::Identity(g, g) - n * n.transpose();
        // Derivatives of the traction along the surface by the normal
        const Rows turn = -p * Rows::Identity(g, g) - n * lambda.transpose();
        const double c = nodes.c[i];
        Vector along = across * lambda / c;
        Rows by_traction = across / c, moves = Rows::Zero(g, g),
             by_turn = turn / c;
        if (in.has_friction[i])
        {
          const ConePair pair = in.pair(i);
          const Rows F = across * pair.block();
          along = Vector(Map(&nodes.slip[g * i], g))
                  - 2 * in.target * Vector(pair.inverse().tail(g))
                  - Vector(Map(&in.correction[(1 + g) * i + 1], g));
          const Vector friction
              = in.by_pressure[i] * across * pair.first_column().tail(g);
          by_traction = F * across + friction * n.transpose();
          by_turn = F * turn + friction * lambda.transpose();
          moves = Rows::Identity(g, g);
        }
        // What cannot move has no traction
        for (int k = 0; k < g; ++k)
          if (in.has_friction[i] and not(nodes.mobile[g * i + k] > 0))
          {
            along[k] = (lambda[k] - p * n[k]) / c;
            by_traction.row(k) = across.row(k) / c;
            by_turn.row(k) = turn.row(k) / c;
            moves.row(k).setZero();
          }
        value = height * n + along;
        by_gap = n;
        by_multiplier = compliance * n * n.transpose() + by_traction;
        by_slip = moves;
        by_normal = height * Rows::Identity(g, g)
                    + compliance * n * lambda.transpose() + by_turn;
      }
    }
    Eigen::Map<Eigen::VectorXd>(&nodes.value[g * i], g) = scale * value;
    Eigen::Map<Eigen::VectorXd>(&nodes.by_gap[g * i], g) = scale * by_gap;
    const auto write = [&](std::vector<double>& to, const Rows& rows)
    {
      for (int k = 0; k < g; ++k)
        for (int l = 0; l < g; ++l)
          to[g * (g * i + k) + l] = scale * rows(k, l);
    };
    write(nodes.by_multiplier, by_multiplier);
    if (nodes.is_vector())
    {
      write(nodes.by_slip, by_slip);
      write(nodes.by_normal, by_normal);
    }
  }
}
