// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "coulomb.h"
#include "../math/vec.h"
#include <algorithm>
#include <cstddef>

using namespace contactx;
using namespace contactx::law;

namespace
{
template <int D>
using Mat = std::array<Vector<D>, D>;

template <int D>
Mat<D> outer(const Vector<D>& a, const Vector<D>& b)
{
  Mat<D> m;
  for (int i = 0; i < D; ++i)
    m[i] = a[i] * b;
  return m;
}

/// I - a a^T
template <int D>
Mat<D> across(const Vector<D>& a)
{
  Mat<D> m = outer<D>(-1 * a, a);
  for (int i = 0; i < D; ++i)
    m[i][i] += 1;
  return m;
}

template <int D>
Mat<D> multiply(const Mat<D>& a, const Mat<D>& b)
{
  Mat<D> m{};
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k)
      m[i] = m[i] + a[i][k] * b[k];
  return m;
}

template <int D>
Mat<D> scaled(double s, Mat<D> m)
{
  for (auto& row : m)
    row = s * row;
  return m;
}

template <int D>
Mat<D> sum(Mat<D> a, const Mat<D>& b)
{
  for (int i = 0; i < D; ++i)
    a[i] = a[i] + b[i];
  return a;
}

template <int D>
Vector<D> vector_at(std::span<const double> values, std::size_t i)
{
  Vector<D> v;
  for (int k = 0; k < D; ++k)
    v[k] = values[D * i + k];
  return v;
}

/// One slave node.
template <int D>
struct Node
{
  Node(const FrictionalState& s, std::size_t i, bool is_closed)
      : lambda(vector_at<D>(s.traction, i)), n(vector_at<D>(s.normal, i)),
        slip(vector_at<D>(s.slip, i)), gap(s.gap[i]), c(s.c[i]),
        c_t(s.along * c), p(dot(n, lambda)),
        p_hat(pressure_hat(p, c, gap, is_closed)), t(lambda - p * n),
        t_hat(t - c_t * slip), size(norm(t_hat)),
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
        = size < reach * bound and dot(t, t_hat) < -0.05 * bound * size;
    return back ? Status::stick : Status::slip;
  }

  Vector<D> lambda, n, slip;
  double gap, c, c_t, p, p_hat;
  Vector<D> t, t_hat;
  double size, bound;
};

/// Function and derivatives of one node, without the area.
template <int D>
struct Terms
{
  Vector<D> value{}, by_gap{};
  Mat<D> by_traction{}, by_slip{}, by_normal{};
};

template <int D>
Mat<D> identity(double s)
{
  Mat<D> m{};
  for (int i = 0; i < D; ++i)
    m[i][i] = s;
  return m;
}

template <int D>
Terms<D> open_terms(const Vector<D>& lambda)
{
  Terms<D> r;
  r.value = lambda;
  r.by_traction = identity<D>(1);
  return r;
}

/// Of t by the normal: -(p I + n lambda^T)
template <int D>
Mat<D> traction_by_normal(const Node<D>& a)
{
  return scaled<D>(-1, sum<D>(identity<D>(a.p), outer<D>(a.n, a.lambda)));
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
  r.by_slip = identity<D>(a.c);
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
  const Vector<D> s = directed ? (1 / a.size) * a.t_hat : Vector<D>{};
  const Mat<D> turn
      = directed ? scaled<D>(a.bound / a.size, across<D>(s)) : Mat<D>{};
  const Mat<D> t_by_n = traction_by_normal<D>(a);
  Terms<D> r;
  r.value = a.t - a.bound * s;
  // See `pressure_hat`
  r.by_gap = a.gap > 0 ? Vector<D>{} : (a.c * friction) * s;
  r.by_slip = scaled<D>(a.c_t, turn);
  if (const double length = norm(a.slip); softening != 0 and length > 0)
    r.by_slip = sum<D>(r.by_slip, outer<D>((-softening / length) * s, a.slip));
  const Mat<D> tangential = across<D>(a.n);
  r.by_traction
      = sum<D>(sum<D>(tangential, scaled<D>(-1, multiply<D>(turn, tangential))),
               outer<D>(-friction * s, a.n));
  r.by_normal = sum<D>(t_by_n, sum<D>(scaled<D>(-1, multiply<D>(turn, t_by_n)),
                                      outer<D>(-friction * s, a.lambda)));
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
      q.by_traction[k] = other.by_traction[k];
      q.by_slip[k] = other.by_slip[k];
      q.by_normal[k] = other.by_normal[k];
    }
  const Mat<D> along = across<D>(a.n);
  const double height = dot(a.n, q.value);
  Terms<D> p;
  p.value = q.value - height * a.n;
  p.by_gap = q.by_gap - dot(a.n, q.by_gap) * a.n;
  p.by_traction = multiply<D>(along, q.by_traction);
  p.by_slip = multiply<D>(along, q.by_slip);
  p.by_normal = sum<D>(
      multiply<D>(along, q.by_normal),
      scaled<D>(-1, sum<D>(identity<D>(height), outer<D>(a.n, q.value))));
  return p;
}

/// Add what vanishes along the normal of a closed node: c g
template <int D>
Terms<D> closed(const Node<D>& a, Terms<D> r)
{
  r.value = r.value + (a.c * a.gap) * a.n;
  r.by_gap = r.by_gap + a.c * a.n;
  r.by_normal = sum<D>(r.by_normal, identity<D>(a.c * a.gap));
  return r;
}

template <int D>
void write(const Terms<D>& r, double area, std::size_t i,
           const FrictionalLaw& law)
{
  for (int k = 0; k < D; ++k)
  {
    law.value[D * i + k] = area * r.value[k];
    law.by_gap[D * i + k] = area * r.by_gap[k];
    for (int j = 0; j < D; ++j)
    {
      const std::size_t at = D * (D * i + k) + j;
      law.by_traction[at] = area * r.by_traction[k][j];
      law.by_slip[at] = area * r.by_slip[k][j];
      law.by_normal[at] = area * r.by_normal[k][j];
    }
  }
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
