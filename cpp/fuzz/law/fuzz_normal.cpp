// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../input.h"
#include "../require.h"
#include <contactx/law/normal.h>
#include <vector>

using namespace contactx;
using namespace contactx::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  const int n = in.below(5);
  std::vector<double> pressure(n), gap(n), c(n), area(n);
  std::vector<std::int8_t> status(n);
  for (int i = 0; i < n; ++i)
  {
    pressure[i] = in.number();
    gap[i] = in.below(8) == 0 ? NAN : in.number();
    c[i] = in.positive();
    area[i] = in.positive();
    status[i] = static_cast<std::int8_t>(in.below(3));
  }
  const law::NormalState state{pressure, gap, c};
  law::normal_status(state, status);
  require(law::normal_status(state, status) == 0, "the status is settled");

  // Of exactly their size, so that what lies beyond is found out
  std::vector<double> value(n), by_pressure(n), by_gap(n);
  law::normal_complementarity(state, area, status, value, by_pressure, by_gap);
  if (!in.finite())
    return 0;
  require(all_finite(value) and all_finite(by_pressure) and all_finite(by_gap),
          "all is finite, without a pair too");
  for (int i = 0; i < n; ++i)
  {
    require(std::isfinite(gap[i]) or status[i] == law::open,
            "without a pair a node is open");
    require(by_pressure[i] >= 0 and by_gap[i] >= 0, "the function ascends");
  }
  return 0;
}
