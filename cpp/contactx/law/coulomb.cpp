// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "coulomb.h"
#include "../vec.h"
#include <cstddef>

using namespace contactx;
using namespace contactx::law;

namespace
{
template <int D>
using Mat = std::array<Vec<D>, D>;

template <int D>
Mat<D> outer(const Vec<D>& a, const Vec<D>& b)
{
  Mat<D> m;
  for (int i = 0; i < D; ++i)
    m[i] = a[i] * b;
  return m;
}

/// I - a a^T
template <int D>
Mat<D> across(const Vec<D>& a)
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
Vec<D> vector_at(std::span<const double> values, std::size_t i)
{
  Vec<D> v;
  for (int k = 0; k < D; ++k)
    v[k] = values[D * i + k];
  return v;
}

/// One slave node.
template <int D>
struct Node
{
  Node(const FrictionalState& s, std::size_t i)
      : lambda(vector_at<D>(s.traction, i)), n(vector_at<D>(s.normal, i)),
        slip(vector_at<D>(s.slip, i)), gap(s.gap[i]), c(s.c[i]),
        p(dot(n, lambda)), p_hat(p - c * gap), t(lambda - p * n),
        t_hat(t - c * slip), size(norm(t_hat)), bound(s.friction[i] * p_hat)
  {
  }

  Status status(Status before) const
  {
    // False for the gap NaN, too
    if (!(p_hat > 0))
      return Status::open;
    // Against its traction a node would jump across the whole cone of friction
    if (before == Status::slip and bound > 0 and dot(t, t_hat) < 0)
      return Status::stick;
    // Without friction nothing sticks, not even where nothing pulls
    return bound > 0 and size <= bound ? Status::stick : Status::slip;
  }

  Vec<D> lambda, n, slip;
  double gap, c, p, p_hat;
  Vec<D> t, t_hat;
  double size, bound;
};

/// Function and derivatives of one node, without the area.
template <int D>
struct Terms
{
  Vec<D> value{}, by_gap{};
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
Terms<D> open_terms(const Vec<D>& lambda)
{
  Terms<D> r;
  r.value = lambda;
  r.by_traction = identity<D>(1);
  return r;
}

template <int D>
Terms<D> stick_terms(const Node<D>& a)
{
  Terms<D> r;
  r.value = a.c * (a.gap * a.n + a.slip);
  r.by_gap = a.c * a.n;
  r.by_slip = identity<D>(a.c);
  r.by_normal = identity<D>(a.c * a.gap);
  return r;
}

template <int D>
Terms<D> slip_terms(const Node<D>& a, double friction)
{
  // Without a direction there is nothing to slip along: any will do
  const bool directed = a.size > 0;
  const Vec<D> s = directed ? (1 / a.size) * a.t_hat : Vec<D>{};
  const Mat<D> turn
      = directed ? scaled<D>(a.bound / a.size, across<D>(s)) : Mat<D>{};
  // Of t by the normal: -(p I + n lambda^T)
  const Mat<D> t_by_n
      = scaled<D>(-1, sum<D>(identity<D>(a.p), outer<D>(a.n, a.lambda)));
  Terms<D> r;
  r.value = (a.c * a.gap) * a.n + a.t - a.bound * s;
  r.by_gap = a.c * (a.n + friction * s);
  r.by_slip = scaled<D>(a.c, turn);
  const Mat<D> tangential = across<D>(a.n);
  r.by_traction
      = sum<D>(sum<D>(tangential, scaled<D>(-1, multiply<D>(turn, tangential))),
               outer<D>(-friction * s, a.n));
  r.by_normal = sum<D>(sum<D>(identity<D>(a.c * a.gap), t_by_n),
                       sum<D>(scaled<D>(-1, multiply<D>(turn, t_by_n)),
                              outer<D>(-friction * s, a.lambda)));
  return r;
}

template <int D>
void write(const Terms<D>& r, const Terms<D>& immobile, double area,
           std::span<const double> mobile, std::size_t i,
           const FrictionalLaw& law)
{
  for (int k = 0; k < D; ++k)
  {
    const Terms<D>& from = mobile[D * i + k] > 0 ? r : immobile;
    law.value[D * i + k] = area * from.value[k];
    law.by_gap[D * i + k] = area * from.by_gap[k];
    for (int j = 0; j < D; ++j)
    {
      const std::size_t at = D * (D * i + k) + j;
      law.by_traction[at] = area * from.by_traction[k][j];
      law.by_slip[at] = area * from.by_slip[k][j];
      law.by_normal[at] = area * from.by_normal[k][j];
    }
  }
}

template <int D>
std::int32_t set_status(const FrictionalState& state,
                        std::span<std::int8_t> status)
{
  std::int32_t changed = 0;
  for (std::size_t i = 0; i < status.size(); ++i)
  {
    const Status now = Node<D>(state, i).status(static_cast<Status>(status[i]));
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
    const Node<D> node(state, i);
    const Terms<D> open = open_terms<D>(node.lambda);
    if (status[i] == Status::open)
      write<D>(open, open, area[i], mobile, i, law);
    else if (status[i] == Status::stick)
      write<D>(stick_terms<D>(node), open, area[i], mobile, i, law);
    else
      write<D>(slip_terms<D>(node, state.friction[i]), open, area[i], mobile, i,
               law);
  }
}
} // namespace

std::int32_t contactx::law::frictional_status(const FrictionalState& state,
                                              std::span<std::int8_t> status)
{
  return state.gdim == 2 ? set_status<2>(state, status)
                         : set_status<3>(state, status);
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
