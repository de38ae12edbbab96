// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "kernel_samples.h"

using namespace contactx;
using namespace contactx::tests;

namespace
{
TEST(KernelNodal, AddsItsCoefficient)
{
  for (const int n : {1, 2, 3, 4, 9})
  {
    std::vector<double> w(n), tensor(n, 1);
    std::iota(w.begin(), w.end(), 1);
    kernel::nodal(n)(tensor.data(), w.data(), nullptr, nullptr, nullptr,
                     nullptr, nullptr);
    for (int i = 0; i < n; ++i)
      EXPECT_EQ(tensor[i], i + 2);
  }
  EXPECT_THROW(kernel::nodal(5), std::invalid_argument);
}

TEST(KernelNodal, SlaveNodesOfOtherRanksHaveNoForcesHere)
{
  int count = 0;
  for_all_samples(
      [&count](Sample s)
      {
        if (not s.kind.is_mortar())
          return;
        for (const char* sliding : {"finite", "small"})
        {
          const std::vector<double> all = s(sliding, "traction");
          double& area = s.at(Coefficient::area)[0];
          const double own = std::exchange(area, kernel::area_elsewhere);
          const std::vector<double> left = s(sliding, "traction");
          area = own;
          const int size = s.kind.size(), width = size * s.kind.num_slaves;
          for (std::size_t i = 0; i < all.size(); ++i)
            EXPECT_EQ(left[i], int(i) % width < size ? 0 : all[i]);
          ++count;
        }
      });
  EXPECT_GT(count, 0);
}
} // namespace
