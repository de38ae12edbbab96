// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <contactx/geometry/closest_point.h>

using namespace contactx;
using namespace contactx::fuzz;

namespace
{
/// Whether Newton's method need not find more than one projection: convex and
/// hardly warped.
template <class F>
bool tame(const geometry::Nodes<F>& x)
{
  if constexpr (F::flat)
    return true;
  else
  {
    const auto n = geometry::frame<F>(x, {0.5, 0.5}).n;
    for (const auto& corner : F::vertices)
    {
      if (!(roundness<F>(x, corner) > 0.05)
          or !(dot(geometry::frame<F>(x, corner).n, n) > 0.99))
        return false;
    }
    return true;
  }
}

template <class F>
void check(Input& in)
{
  const geometry::Nodes<F> x = nodes<F>(in);
  const auto p = in.vector<F::gdim>();
  const auto c = geometry::closest_point<F>(x, p);
  if (!in.finite())
    return;
  require(std::isfinite(c.distance2), "the distance is finite");
  require(all_finite(c.d), "so is the vector to the point");
  require(F::excess(c.xi) <= 1e-12, "the closest point is on the facet");
  require(c.feature >= 0 and c.feature <= F::num_edges + F::nodes,
          "its feature exists");

  double size = largest(p);
  for (const auto& node : x)
    size = std::max(size, largest(node));
  const double distance = norm(c.d), rounding = 1e-9 * size;
  const auto at = [&x, &p](const geometry::Local<F>& xi)
  { return p - geometry::combine<F>(F::shape(xi), x); };
  require(norm(c.d - at(c.xi)) <= rounding, "the vector leads to it");
  for (const auto& [i, j] : F::edges)
    for (const double s : {0., 0.3, 0.5, 1.})
      require(distance
                  <= norm(at((1 - s) * F::vertices[i] + s * F::vertices[j]))
                         + rounding,
              "no point of an edge is closer");
  if (!tame<F>(x))
    return;
  for (const double s : {0.1, 0.25, 0.4})
    for (const double t : {0.2, 0.3, 0.55})
    {
      geometry::Local<F> xi{s};
      if constexpr (F::tdim == 2)
        xi[1] = t;
      require(distance <= norm(at(xi)) + rounding, "no inner point is closer");
    }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  geometry::visit(2 + in.below(3), [&in]<class F>(F) { check<F>(in); });
  return 0;
}
