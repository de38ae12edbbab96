// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include <atomic>
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

void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace
{
TEST(Kernels, AllocateNothing)
{
  Generator random(1);
  std::vector<double> A(1000), w(200);
  for (double& c : w)
    c = random(0.1, 1);
  const long before = allocations;
  std::vector<double> counted(1);
  ASSERT_EQ(allocations, before + 1);

  for (const Entry& e : registry())
  {
    // The interior, edges and vertices
    const int features = e.num_nodes == 0 ? 1 : 1 + (e.gdim - 1) * e.num_nodes;
    for (int feature = 0; feature < features; ++feature)
    {
      if (e.num_nodes > 0)
        w[offset(e.law, Coefficient::pair, e.num_nodes, e.gdim) + pair_feature]
            = feature;
      const long start = allocations;
      e.function(A.data(), w.data(), nullptr, nullptr, nullptr, nullptr,
                 nullptr);
      EXPECT_EQ(allocations, start)
          << e.sliding << " " << e.term << " " << e.num_nodes;
    }
  }
}
} // namespace
