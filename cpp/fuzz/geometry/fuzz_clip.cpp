// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../input.h"
#include "../require.h"
#include <contactx/geometry/quadrature.h>

using namespace contactx;
using namespace contactx::fuzz;
using geometry::Flat;
using geometry::Overlap;

namespace
{
template <class F>
Flat<F> flat(Input& in)
{
  Flat<F> r;
  const bool reference = in.flag();
  for (int l = 0; l < F::nodes; ++l)
    r[l] = reference ? in.scale() * F::vertices[l] + 0.25 * in.vector<F::tdim>()
                     : in.vector<F::tdim>();
  return r;
}

template <int D>
double area_of(const Overlap<D>& o, int degree)
{
  double area = 0;
  geometry::integrate(o, degree, [&area](const auto&, double w) { area += w; });
  return area;
}

template <class S, class M>
void check(Input& in)
{
  const Flat<S> s = flat<S>(in);
  const Flat<M> m = flat<M>(in);
  if (!geometry::is_convex<M>(m))
    return;
  const auto a = geometry::outline<M>(m);
  const auto b = geometry::outline<S>(s);
  const auto c = geometry::clip(a, b);
  require(c.size >= 0 and c.size <= Overlap<S::tdim>::most,
          "a part has no more corners than two facets");
  const int degree = in.below(40);
  const double area = area_of(c, degree);
  if (!in.finite())
    return;
  for (int i = 0; i < c.size; ++i)
    require(all_finite(c.corner[i]), "corners are finite");
  require(area >= 0 and std::isfinite(area), "no area is negative");
  if (!in.even() or !geometry::is_convex<S>(s))
    return;
  double size = 0;
  for (const auto& p : m)
    size = std::max(size, largest(p));
  for (const auto& p : s)
    size = std::max(size, largest(p));
  const double rounding = 1e-9 * (S::tdim == 1 ? size : size * size);
  require(area <= area_of(a, degree) + rounding, "a part is no larger");
  require(area <= area_of(b, degree) + rounding, "a part is no larger");
  const double back = area_of(geometry::clip(b, a), degree);
  require(std::abs(area - back) <= rounding, "either cuts the other alike");
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  using geometry::Quadrilateral;
  using geometry::Segment;
  using geometry::Triangle;
  Input in(data, size);
  switch (in.below(5))
  {
  case 0:
    check<Segment, Segment>(in);
    break;
  case 1:
    check<Triangle, Triangle>(in);
    break;
  case 2:
    check<Triangle, Quadrilateral>(in);
    break;
  case 3:
    check<Quadrilateral, Triangle>(in);
    break;
  default:
    check<Quadrilateral, Quadrilateral>(in);
  }
  return 0;
}
