// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../input.h"
#include "../require.h"
#include <algorithm>
#include <contactx/law/coulomb.h>
#include <vector>

using namespace contactx;
using namespace contactx::fuzz;

namespace
{
/// Slave nodes and what the law says of them.
template <int D>
struct Nodes
{
  Nodes(Input& in, int n)
      : gap(n), c(n), friction(n), area(n), traction(D * n), normal(D * n),
        slip(D * n), mobile(D * n), value(D * n), by_gap(D * n),
        by_traction(D * D * n), by_slip(D * D * n), by_normal(D * D * n),
        status(n)
  {
    for (int i = 0; i < n; ++i)
    {
      const auto unit = in.unit<D>();
      for (int k = 0; k < D; ++k)
      {
        normal[D * i + k] = unit[k];
        traction[D * i + k] = in.number();
        slip[D * i + k] = in.number();
        mobile[D * i + k] = in.below(4) > 0;
      }
      gap[i] = in.below(8) == 0 ? NAN : in.number();
      c[i] = in.positive();
      friction[i] = 0.125 * in.below(12);
      area[i] = in.positive();
      status[i] = static_cast<std::int8_t>(in.below(3));
    }
  }

  law::FrictionalState state() const
  {
    return {D, traction, gap, normal, slip, c, friction};
  }

  law::FrictionalLaw law()
  {
    return {value, by_traction, by_gap, by_slip, by_normal};
  }

  Vector<D> at(const std::vector<double>& v, std::size_t i) const
  {
    Vector<D> a;
    std::copy_n(v.begin() + D * i, D, a.begin());
    return a;
  }

  std::vector<double> gap, c, friction, area, traction, normal, slip, mobile;
  std::vector<double> value, by_gap, by_traction, by_slip, by_normal;
  std::vector<std::int8_t> status;
};

/// The friction that a slipping node is led to: t where its function vanishes.
template <int D>
void check_slip(const Nodes<D>& a, std::size_t i)
{
  const auto n = a.at(a.normal, i), lambda = a.at(a.traction, i);
  const double p = dot(n, lambda), pulled = a.c[i] * a.gap[i];
  const auto t = lambda - p * n;
  const auto found = (1 / a.area[i]) * a.at(a.value, i) - pulled * n;
  const double size = norm(lambda) + std::abs(pulled);
  const double bound
      = a.friction[i] * law::pressure_hat(p, a.c[i], a.gap[i], true);
  require(norm(t - found) <= bound + 1e-9 * size,
          "friction is no more than Coulomb's");
}

template <int D>
void check(Input& in)
{
  const int n = in.below(4);
  Nodes<D> a(in, n);
  const auto state = a.state();
  const auto before = a.status;
  // Any status is evaluated, not that of the state alone
  law::frictional_complementarity(state, a.area, before, a.mobile, a.law());
  const double reach = in.positive();
  law::frictional_status(state, reach, a.status);
  // The bound of a node that has just closed is that of its pressure from now
  law::frictional_status(state, reach, a.status);
  require(law::frictional_status(state, reach, a.status) == 0,
          "the status is settled");
  law::frictional_complementarity(state, a.area, a.status, a.mobile, a.law());
  for (int i = 0; i < n; ++i)
    if (std::isnan(a.gap[i]))
      require(a.status[i] == law::open, "without a pair a node is open");
  if (!in.even())
    return;
  for (const auto& v :
       {a.value, a.by_gap, a.by_traction, a.by_slip, a.by_normal})
    require(all_finite(v), "all is finite, without a pair too");
  for (int i = 0; i < n; ++i)
    if (a.status[i] == law::slip and a.area[i] > 0
        and std::all_of(a.mobile.begin() + D * i,
                        a.mobile.begin() + D * (i + 1),
                        [](double m) { return m > 0; }))
      check_slip<D>(a, i);
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  in.flag() ? check<3>(in) : check<2>(in);
  return 0;
}
