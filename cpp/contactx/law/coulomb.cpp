// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "coulomb.h"
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

using namespace contactx;
using namespace contactx::law;

namespace
{
template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

template <int D>
using Mat = Eigen::Matrix<double, D, D>;

/// I - a a^T
template <int D>
Mat<D> across(const Vec<D>& a)
{
  return Mat<D>::Identity() - a * a.transpose();
}

/// One slave node.
template <int D>
struct Node
{
  Node(const FrictionalState& s, std::size_t i, bool is_closed)
      : lambda(Vec<D>::Map(&s.traction[D * i])),
        n(Vec<D>::Map(&s.normal[D * i])), slip(Vec<D>::Map(&s.slip[D * i])),
        gap(s.gap[i]), c(s.c[i]), c_t(s.along * c), p(n.dot(lambda)),
        p_hat(pressure_hat(p, c, gap, is_closed)), t(lambda - p * n),
        t_hat(t - c_t * slip), size(t_hat.norm()),
        bound(s.bound.empty() ? s.friction[i] * p_hat : s.bound[i])
  {
  }

  Status status(double reach) const
  {
    // False for the gap NaN, too
    if (!(p_hat > 0))
      return Status::open;
    // Without friction nothing sticks, not even where nothing pulls
    if (bound > 0 and size <= bound)
      return Status::stick;
    // Slip that reverses has passed a state of rest: without this, nodes that
    // overshoot under full friction chatter. The overshoot is not much larger
    // than the deformation by friction
    const bool back
        = size < reach * bound and t.dot(t_hat) < -0.05 * bound * size;
    return back ? Status::stick : Status::slip;
  }

  Vec<D> lambda, n, slip;
  double gap, c, c_t, p, p_hat;
  Vec<D> t, t_hat;
  double size, bound;
};

/// Function and derivatives of one node, without the area.
template <int D>
struct Terms
{
  Vec<D> value = Vec<D>::Zero(), by_gap = value;
  Mat<D> by_traction = Mat<D>::Zero(), by_slip = by_traction,
         by_normal = by_traction;
};

template <int D>
Terms<D> open_terms(const Vec<D>& lambda)
{
  Terms<D> r;
  r.value = lambda;
  r.by_traction.setIdentity();
  return r;
}

/// Of t by the normal: -(p I + n lambda^T)
template <int D>
Mat<D> traction_by_normal(const Node<D>& a)
{
  return -a.p * Mat<D>::Identity() - a.n * a.lambda.transpose();
}

/// What vanishes along the surface where nothing can move: t
template <int D>
Terms<D> immobile_terms(const Node<D>& a)
{
  Terms<D> r;
  r.value = a.t;
  r.by_traction = across<D>(a.n);
  r.by_normal = traction_by_normal<D>(a);
  return r;
}

/// What vanishes along the surface of a sticking node: c ds
template <int D>
Terms<D> stick_terms(const Node<D>& a)
{
  Terms<D> r;
  r.value = a.c * a.slip;
  r.by_slip.diagonal().setConstant(a.c);
  return r;
}

/// What vanishes along the surface of a slipping node
/// @param[in] friction Derivative of the bound by p_hat.
/// @param[in] softening Its derivative by the length of the slip.
template <int D>
Terms<D> slip_terms(const Node<D>& a, double friction, double softening)
{
  // Without a direction there is nothing to slip along: any will do
  const bool directed = a.size > 0;
  Vec<D> s = Vec<D>::Zero();
  Mat<D> turn = Mat<D>::Zero();
  if (directed)
  {
    s = a.t_hat / a.size;
    turn = a.bound / a.size * across<D>(s);
  }
  const Mat<D> t_by_n = traction_by_normal<D>(a);
  Terms<D> r;
  r.value = a.t - a.bound * s;
  // See `pressure_hat`
  if (not(a.gap > 0))
    r.by_gap = a.c * friction * s;
  r.by_slip = a.c_t * turn;
  if (const double length = a.slip.norm(); softening != 0 and length > 0)
    r.by_slip -= softening / length * s * a.slip.transpose();
  const Mat<D> tangential = across<D>(a.n);
  r.by_traction
      = tangential - turn * tangential - friction * s * a.n.transpose();
  r.by_normal = t_by_n - turn * t_by_n - friction * s * a.lambda.transpose();
  return r;
}

/// Rows of `r`, those of `other` in directions that cannot move. Rows of both
/// leave the surface: their part along it counts.
template <int D>
Terms<D> mixed(const Node<D>& a, const Terms<D>& r, const Terms<D>& other,
               const double* mobile)
{
  if (std::all_of(mobile, mobile + D, [](double m) { return m > 0; }))
    return r;
  Terms<D> q = r;
  for (int k = 0; k < D; ++k)
    if (!(mobile[k] > 0))
    {
      q.value[k] = other.value[k];
      q.by_gap[k] = other.by_gap[k];
      q.by_traction.row(k) = other.by_traction.row(k);
      q.by_slip.row(k) = other.by_slip.row(k);
      q.by_normal.row(k) = other.by_normal.row(k);
    }
  const Mat<D> along = across<D>(a.n);
  const double height = a.n.dot(q.value);
  Terms<D> p;
  p.value = q.value - height * a.n;
  p.by_gap = q.by_gap - a.n.dot(q.by_gap) * a.n;
  p.by_traction = along * q.by_traction;
  p.by_slip = along * q.by_slip;
  p.by_normal = along * q.by_normal - height * Mat<D>::Identity()
                - a.n * q.value.transpose();
  return p;
}

/// Add what vanishes along the normal of a closed node: c g
template <int D>
Terms<D> closed(const Node<D>& a, Terms<D> r)
{
  r.value += a.c * a.gap * a.n;
  r.by_gap += a.c * a.n;
  r.by_normal.diagonal().array() += a.c * a.gap;
  return r;
}

template <int D>
void write(const Terms<D>& r, double area, std::size_t i,
           const FrictionalLaw& law)
{
  using Rows = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  Vec<D>::Map(&law.value[D * i]) = area * r.value;
  Vec<D>::Map(&law.by_gap[D * i]) = area * r.by_gap;
  Rows::Map(&law.by_traction[D * D * i]) = area * r.by_traction;
  Rows::Map(&law.by_slip[D * D * i]) = area * r.by_slip;
  Rows::Map(&law.by_normal[D * D * i]) = area * r.by_normal;
}

template <int D>
std::int32_t set_status(const FrictionalState& state, double reach,
                        std::span<std::int8_t> status)
{
  std::int32_t changed = 0;
  for (std::size_t i = 0; i < status.size(); ++i)
  {
    const Status now = Node<D>(state, i, status[i] != open).status(reach);
    changed += now != status[i];
    status[i] = now;
  }
  return changed;
}

template <int D>
void evaluate(const FrictionalState& state, std::span<const double> area,
              std::span<const std::int8_t> status,
              std::span<const double> mobile, const FrictionalLaw& law)
{
  for (std::size_t i = 0; i < status.size(); ++i)
  {
    const Node<D> node(state, i, status[i] != open);
    if (status[i] == Status::open)
    {
      write<D>(open_terms<D>(node.lambda), area[i], i, law);
      continue;
    }
    const Terms<D> moving = status[i] == Status::stick
                                ? stick_terms<D>(node)
                                : slip_terms<D>(node, state.friction[i],
                                                state.bound_by_slip.empty()
                                                    ? 0
                                                    : state.bound_by_slip[i]);
    const Terms<D> along = mixed<D>(node, moving, immobile_terms<D>(node),
                                    mobile.data() + D * i);
    write<D>(closed<D>(node, along), area[i], i, law);
  }
}
} // namespace

std::int32_t contactx::law::frictional_status(const FrictionalState& state,
                                              double reach,
                                              std::span<std::int8_t> status)
{
  return state.gdim == 2 ? set_status<2>(state, reach, status)
                         : set_status<3>(state, reach, status);
}

void contactx::law::frictional_complementarity(
    const FrictionalState& state, std::span<const double> area,
    std::span<const std::int8_t> status, std::span<const double> mobile,
    const FrictionalLaw& law)
{
  if (state.gdim == 2)
    evaluate<2>(state, area, status, mobile, law);
  else
    evaluate<3>(state, area, status, mobile, law);
}
