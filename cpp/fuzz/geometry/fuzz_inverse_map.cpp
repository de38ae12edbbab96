// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <contactx/geometry/clip.h>
#include <contactx/geometry/inverse_map.h>

using namespace contactx;
using namespace contactx::fuzz;
using geometry::Flat;

namespace
{
/// A facet in a plane and not far from the reference one.
template <class F>
Flat<F> flat(Input& in)
{
  Flat<F> r;
  for (int l = 0; l < F::nodes; ++l)
    r[l] = in.scale() * F::vertices[l] + 0.25 * in.vector<F::tdim>();
  return r;
}

/// Whether the map is far from one that has no inverse.
template <class F>
bool invertible(const Flat<F>& r)
{
  double size = 0;
  for (const auto& p : r)
    size = std::max(size, largest(p));
  for (const auto& corner : F::vertices)
  {
    const auto dN = F::derivative(corner);
    std::array<geometry::Local<F>, F::tdim> t{};
    for (int a = 0; a < F::tdim; ++a)
      for (int l = 0; l < F::nodes; ++l)
        t[a] = t[a] + dN[a][l] * r[l];
    if constexpr (F::tdim == 1)
      return std::abs(t[0][0]) > 0.05 * size;
    else if (!(t[0][0] * t[1][1] - t[0][1] * t[1][0] > 0.05 * size * size))
      return false;
  }
  return true;
}

template <class F>
void check(Input& in)
{
  const Flat<F> r = flat<F>(in);
  geometry::Local<F> xi;
  for (double& c : xi)
    c = in.below(17) / 16.;
  geometry::Local<F> p{};
  const auto N = F::shape(xi);
  for (int l = 0; l < F::nodes; ++l)
    p = p + N[l] * r[l];
  const geometry::InverseMap<F> map(r);
  const auto at = map.at(p);
  if (!in.even() or !invertible<F>(r))
    return;
  double sum = 0;
  for (const double value : at.N)
    sum += value;
  require(std::abs(sum - 1) < 1e-9, "shape functions sum to one");
  for (const auto& slope : at.slope)
  {
    double change = 0;
    for (const double value : slope)
      change += value;
    require(std::abs(change) <= 1e-9 * largest(slope), "their slopes to zero");
  }
  if (F::excess(xi) <= 0)
    require(norm(at.xi - xi) < 1e-6, "the map is the inverse");
  require(at.jacobian > 0 and std::isfinite(at.jacobian),
          "the Jacobian is positive");
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  geometry::visit(2 + in.below(3), [&in]<class F>(F) { check<F>(in); });
  return 0;
}
