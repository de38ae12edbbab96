// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/contact/node_to_surface.h>

namespace contactx::tests
{
/// @brief Frozen pairs that hide a penetration.
class Hiding : public contact::NodeToSurface
{
public:
  using NodeToSurface::NodeToSurface;

  std::vector<std::int32_t> frozen_pairs() const override
  {
    return is_frozen ? std::vector<std::int32_t>{0}
                     : std::vector<std::int32_t>();
  }
  void reset_flips() override { ++releases; }
  contact::HiddenGap
  deepest_frozen_pair(std::span<const double>,
                      std::span<const std::int8_t>) const override
  {
    return is_frozen ? contact::HiddenGap{-1e-3, -0.1} : contact::HiddenGap();
  }

  bool is_frozen = true;
  int releases = 0;
};
} // namespace contactx::tests
