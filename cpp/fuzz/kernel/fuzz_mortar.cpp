// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "tensor.h"
#include <contactx/search/facet_search.h>
#include <numeric>

using namespace contactx;
using namespace contactx::fuzz;
using kernel::Coefficient;
using kernel::Entry;
using kernel::MortarLayout;

namespace
{
std::vector<const Entry*> kernels()
{
  std::vector<const Entry*> all;
  for (const Entry& e : kernel::registry())
    if (e.num_slaves > 1 and e.num_slaves <= e.gdim + (e.gdim == 3))
      all.push_back(&e);
  return all;
}

/// One facet with its nodes numbered from `first`.
List one(int num_nodes, int first)
{
  List list;
  list.nodes.resize(num_nodes);
  std::iota(list.nodes.begin(), list.nodes.end(), first);
  list.offsets.push_back(num_nodes);
  return list;
}

/// Place two facets before one another and take their integrals; returns
/// whether they make a pair.
bool fill_pair(Input& in, const Entry& e, Coefficients& w)
{
  const int n = e.num_slaves, m = e.num_nodes, gdim = e.gdim;
  double* position = w.at(Coefficient::position);
  double* u = w.at(Coefficient::displacement);
  const auto place = [&]<class F>(F, int first, bool up)
  {
    for (int l = 0; l < F::nodes; ++l)
    {
      double* p = position + gdim * (first + l);
      for (int k = 0; k < F::tdim; ++k)
        p[k] = in.scale() * F::vertices[l][k];
      // The reference triangle looks up, the segment down
      if (up != (gdim == 3))
        gdim == 3 ? std::swap(p[0], p[1]) : void(p[0] = in.scale() - p[0]);
      p[gdim - 1] = 0;
      for (int k = 0; k < gdim; ++k)
        if (in.below(4) == 0)
          p[k] += 0.25 * in.number();
    }
  };
  geometry::visit(n, [&](auto kind) { place(kind, 0, false); });
  geometry::visit(m, [&](auto kind) { place(kind, n, true); });
  std::vector<double> x(gdim * (n + m)),
      reference(position, position + x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    u[i] = in.below(4) == 0 ? 0.25 * in.number() : 0;
    x[i] = position[i] + u[i];
  }
  const List slave = one(n, 0), master = one(m, n);
  search::FacetSearch search(slave.offsets, slave.nodes, master.offsets,
                             master.nodes, gdim);
  const auto pairs = search.find(x, INFINITY, 0);
  const auto all = geometry::integrals(search.slave(), search.master(), pairs,
                                       x, reference, gdim);
  if (pairs.size() == 0)
    return false;
  double* pair = w.at(Coefficient::pair);
  const MortarLayout at(n, m);
  constexpr int stride = geometry::most_nodes;
  for (int s = 0; s < n; ++s)
  {
    std::copy_n(&all.weight[stride * s], m, pair + at.weight + m * s);
    std::copy_n(&all.dual[stride * s], n, pair + at.dual + n * s);
    pair[at.gap + s] = all.gap[s];
    w.at(Coefficient::area)[s] = all.area[s];
  }
  std::copy_n(all.normal.begin(), 3, pair + at.normal);
  pair[at.keeps] = in.below(3);
  return std::all_of(all.area.begin(), all.area.begin() + n,
                     [](double a) { return a > 0; });
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
  // One of a few, whatever else numbers are
  if (e.num_nodes > 0)
    w.at(Coefficient::pair)[MortarLayout(e.num_slaves, e.num_nodes).keeps]
        = in.below(3);
  bool found = true;
  if (e.num_nodes > 0)
    found = fill_pair(in, e, w);
  else
    for (int s = 0; s < e.num_slaves; ++s)
      found = found and w.at(Coefficient::area)[s] > 0;
  const auto tensor = w.tabulate();
  if (!in.even() or !found)
    return 0;
  require(all_finite(tensor), "what a kernel gives is finite");
  require_balance(e, tensor);
  return 0;
}
