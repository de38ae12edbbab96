// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "normal.h"
#include <cstddef>

using namespace contactx::law;

std::int32_t contactx::law::normal_status(const NormalState& state,
                                          std::span<std::int8_t> status)
{
  std::int32_t changed = 0;
  for (std::size_t i = 0; i < status.size(); ++i)
  {
    // False for the gap NaN, too
    const bool closed = pressure_hat(state.pressure[i], state.c[i],
                                     state.gap[i], status[i] != open)
                        > 0;
    const std::int8_t now = closed ? slip : open;
    changed += now != status[i];
    status[i] = now;
  }
  return changed;
}

void contactx::law::normal_complementarity(const NormalState& state,
                                           std::span<const double> area,
                                           std::span<const std::int8_t> status,
                                           std::span<double> value,
                                           std::span<double> d_pressure,
                                           std::span<double> d_gap)
{
  for (std::size_t i = 0; i < status.size(); ++i)
  {
    const bool closed = status[i] != open;
    d_pressure[i] = closed ? 0 : area[i];
    d_gap[i] = closed ? area[i] * state.c[i] : 0;
    value[i] = d_pressure[i] * state.pressure[i];
    if (closed)
      value[i] += d_gap[i] * state.gap[i];
  }
}
