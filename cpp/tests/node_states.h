// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "generator.h"
#include <contactx/law/law.h>
#include <contactx/law/node_state.h>
#include <string>

namespace contactx::tests
{
/// @brief Set all that a law reads to random numbers, where nothing is
/// singular: unit normals, trial friction far from zero and gaps away from it.
inline void randomise(law::NodeState& nodes, Generator& random)
{
  const std::size_t n = nodes.num_nodes(), g = nodes.gdim();
  for (std::size_t i = 0; i < n; ++i)
  {
    nodes.area[i] = random(0.5, 2);
    nodes.c[i] = random(0.5, 4);
    nodes.gap[i] = (i % 2 == 0 ? 1 : -1) * random(0.05, 0.3);
    nodes.status[i] = static_cast<std::int8_t>(i % 3);
    if (not nodes.is_vector())
    {
      nodes.multiplier[i] = random(-2, 2);
      continue;
    }
    double length = 0;
    while (length < 0.3)
    {
      length = 0;
      for (std::size_t k = g * i; k < g * (i + 1); ++k)
      {
        nodes.normal[k] = random(-1, 1);
        length += nodes.normal[k] * nodes.normal[k];
      }
      length = std::sqrt(length);
    }
    for (std::size_t k = g * i; k < g * (i + 1); ++k)
    {
      nodes.normal[k] /= length;
      nodes.multiplier[k] = random(-2, 2);
      nodes.slip[k] = random(0.3, 0.6) * (random(0, 1) < 0.5 ? -1 : 1);
      nodes.mobile[k] = random(0, 1) < 0.85;
    }
  }
}

/// @brief A node with its normal along the last axis, c = 8 and area 1, among
/// others like it.
inline void set_upright(law::NodeState& nodes, std::size_t i, double p,
                        double t, double gap, double slip)
{
  const std::size_t g = nodes.gdim();
  nodes.area[i] = 1;
  nodes.c[i] = 8;
  nodes.gap[i] = gap;
  nodes.normal[g * i + g - 1] = 1;
  nodes.multiplier[g * i] = t;
  nodes.multiplier[g * i + g - 1] = p;
  nodes.slip[g * i] = slip;
}
} // namespace contactx::tests
