// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <contactx/geometry/ridge.h>

using namespace contactx;
using namespace contactx::fuzz;

namespace
{
template <class F>
void check(Input& in)
{
  const geometry::Nodes<F> x = nodes<F>(in);
  const int feature = 1 + in.below(F::num_edges + F::nodes);
  const auto [i, j] = geometry::feature_edge<F>(feature);
  const bool on_edge = F::num_edges > 0 and feature <= F::num_edges;
  const double along = on_edge ? 0.125 * in.below(9) : 0;
  const geometry::Local<F> xi
      = (1 - along) * F::vertices[i] + along * F::vertices[j];
  const auto axes = geometry::ridge_axes<F>(x, feature, xi);
  // Without a normal there is no pair
  if (!in.finite() or !(roundness<F>(x, xi) > 1e-4))
    return;
  for (const auto& axis : axes)
    require(is_unit(axis), "the axes have length one");
  for (int k = 0; k < F::gdim; ++k)
    for (int l = 0; l < k; ++l)
      require(std::abs(dot(axes[k], axes[l])) < 1e-9, "they are orthogonal");
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  geometry::visit(2 + in.below(3), [&in]<class F>(F) { check<F>(in); });
  return 0;
}
