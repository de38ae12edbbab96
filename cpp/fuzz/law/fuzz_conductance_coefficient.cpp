// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../input.h"
#include "../require.h"
#include <cmath>
#include <contactx/law/conductance_coefficient.h>
#include <stdexcept>
#include <vector>

using namespace contactx;
using namespace contactx::fuzz;
using law::Coefficient;

/// A coefficient that grows with pressure and falls with the gap: what it gives
/// is finite and not negative, or it is refused, and its differences have the
/// signs of the derivatives.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  const double base = in.unscaled(), slope = in.unscaled();
  std::vector<double> p(in.below(5)), g(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    p[i] = in.number();
    g[i] = in.number();
  }
  const double at = in.scale();
  const auto given = [=](std::span<const double> p, std::span<const double> g)
  {
    std::vector<double> h(p.size());
    for (std::size_t i = 0; i < h.size(); ++i)
    {
      require(p[i] >= 0 and g[i] >= 0, "it is asked for what may be");
      h[i] = (base + slope * (p[i] / at)) / (1 + g[i] / at);
    }
    return h;
  };
  mesh::OneRank ranks;
  const Coefficient coefficient(given);
  // Iterates that are not finite are refused before
  if (not in.finite())
    return 0;
  try
  {
    for (const double h : coefficient.values(p, g))
      require(std::isfinite(h) and h >= 0, "flows have a direction");
    const law::Gradient d = coefficient.gradient(p, g, ranks);
    require(d.by_pressure.size() == p.size() and d.by_gap.size() == g.size(),
            "there is a derivative for each node");
    if (in.even() and slope > 0.1 and base > 0)
      for (std::size_t i = 0; i < p.size(); ++i)
        require(d.by_pressure[i] >= 0, "pressure helps");
  }
  catch (const std::invalid_argument&)
  {
  }
  return 0;
}
