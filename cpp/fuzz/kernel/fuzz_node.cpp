// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "tensor.h"
#include <contactx/kernel/pair.h>

using namespace contactx;
using namespace contactx::fuzz;
using kernel::Coefficient;
using kernel::Entry;

namespace
{
std::vector<const Entry*> kernels()
{
  std::vector<const Entry*> all;
  for (const Entry& e : kernel::registry())
    if (e.num_slaves == 1)
      all.push_back(&e);
  return all;
}

/// Fill in a facet's pair as a search gives it; returns whether the facet is
/// far from degenerate, so that all must be finite.
template <class F>
bool fill_pair(Input& in, const Entry& e, Coefficients& w)
{
  const auto x = nodes<F>(in);
  double* position = w.at(Coefficient::position);
  double* u = w.at(Coefficient::displacement);
  for (int l = 0; l < F::nodes; ++l)
    for (int k = 0; k < F::gdim; ++k)
    {
      const int i = F::gdim * (l + 1) + k;
      position[i] = x[l][k] - u[i];
    }
  kernel::FacetPair pair;
  const int feature = in.below(1 + F::num_edges + F::nodes);
  geometry::Local<F> xi;
  for (double& c : xi)
    c = (in.below(25) - 4) / 16.;
  const auto cone = in.unit<3>();
  const auto normal = in.unit<F::gdim>();
  pair.feature = feature;
  std::ranges::copy(xi, pair.xi.begin());
  pair.cone = cone;
  std::ranges::copy(normal, pair.normal.begin());
  std::ranges::copy(
      kernel::values_of(std::span<const kernel::FacetPair>(&pair, 1)),
      w.at(Coefficient::pair));
  if (e.law != kernel::Law::frictionless)
    for (double* c = w.at(Coefficient::slip); double& s : std::span(c, 2))
      s = in.below(17) / 16.;
  for (const auto& corner : F::vertices)
    if (!(roundness<F>(x, corner) > 0.05))
      return false;
  const auto c = kernel::project(kernel::Pair<F>(w.values().data()));
  return roundness<F>(x, c.xi) > 0.05 and largest(c.xi) < 2;
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  static const auto all = kernels();
  Input in(data, size);
  const Entry& e = *all[(in.below(256) + 256 * in.below(2)) % all.size()];
  Coefficients w(e);
  for (double& value : w.values())
    value = in.number();
  bool round = true;
  if (e.num_nodes > 0)
    round = geometry::visit(e.num_nodes,
                            [&]<class F>(F) { return fill_pair<F>(in, e, w); });
  const auto tensor = w.tabulate();
  // A step that has gone wrong may crush a facet: that is found out later
  if (!in.even() or !round)
    return 0;
  require(all_finite(tensor), "what a kernel gives is finite");
  require_balance(e, tensor);
  return 0;
}
