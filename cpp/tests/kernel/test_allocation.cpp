// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include <atomic>
#include <contactx/geometry/segment.h>
#include <contactx/kernel/registry.h>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>

using namespace contactx;
using namespace contactx::kernel;
using namespace contactx::tests;

namespace
{
std::atomic<long> allocations = 0;
} // namespace

// Counts for the whole test program
void* operator new(std::size_t size)
{
  ++allocations;
  if (void* p = std::malloc(size))
    return p;
  throw std::bad_alloc();
}

void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  ++allocations;
  return std::malloc(size);
}

void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace
{
/// Put a slave facet and a master facet over one another.
template <class S, class M>
void face(double* w, Law law)
{
  constexpr int D = S::gdim;
  const auto at = [w, law](Coefficient c)
  { return w + offset(law, c, M::nodes, D, S::nodes); };
  double* u = at(Coefficient::displacement);
  double* x = at(Coefficient::position);
  std::fill(u, x, 0);
  for (int a = 0; a < S::nodes + M::nodes; ++a)
    for (int k = 0; k < S::tdim; ++k)
      x[D * a + k] = a < S::nodes ? S::vertices[a][S::tdim - 1 - k]
                                  : M::vertices[a - S::nodes][k];
}

TEST(Kernels, AllocateNothing)
{
  Generator random(1);
  std::vector<double> A(1000), numbers(500);
  for (double& c : numbers)
    c = random(0.1, 1);
  const long before = allocations;
  std::vector<double> counted(1);
  ASSERT_EQ(allocations, before + 1);

  std::vector<double> w(numbers);
  for (const Entry& e : registry())
  {
    std::ranges::copy(numbers, w.begin());
    // The interior, edges and vertices
    const bool has_features = e.num_nodes > 0 and e.num_slaves == 1;
    const int features = has_features ? 1 + (e.gdim - 1) * e.num_nodes : 1;
    // Quadratic facets need places for their parts
    if (e.num_slaves > e.gdim + (e.gdim == 3))
      continue;
    if (e.num_nodes > 0 and e.num_slaves > 1)
      geometry::visit(e.num_slaves, e.num_nodes, [&]<class S, class M>(S, M)
                      { face<S, M>(w.data(), e.law); });
    for (int feature = 0; feature < features; ++feature)
    {
      if (has_features)
        // The first of its values
        w[offset(e.law, Coefficient::pair, e.num_nodes, e.gdim)] = feature;
      const long start = allocations;
      e.function(A.data(), w.data(), nullptr, nullptr, nullptr, nullptr,
                 nullptr);
      EXPECT_EQ(allocations, start)
          << e.sliding << " " << e.term << " " << e.num_nodes;
    }
  }
}
} // namespace
