// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "mortar_sides.h"
#include <optional>

namespace contactx::contact
{
/// @brief kernel::Weights with which slave nodes are measured against points of
/// the master in finite sliding.
///
/// They are those of the step's start: what was in front of a slave node then
/// stays what its movement is relative to. A node that touches first within a
/// step gets weights interpolated along its path, between those at both of its
/// ends.
class MortarSlip
{
public:
  /// @brief Create it before the first step.
  /// @param[in] sides Both surfaces, which outlive this.
  explicit MortarSlip(const MortarSides& sides) : _sides(&sides) {}

  /// @brief Start a step.
  /// @param[in] now kernel::Pairs at its start, divided by the slave nodes'
  /// areas.
  /// @param[in] origin What they measure at the start although nothing has
  /// moved, a vector a slave node; nothing if empty.
  void begin_step(Mortar now, std::vector<double> origin = {});

  /// @brief Measure from where nodes touch.
  /// @param[in] which 1 at those slave nodes (shape=(n)).
  /// @param[in] now kernel::Pairs at the iterate that closes them, divided by
  /// the areas.
  /// @param[in] offset Offset, a length that is taken off the gap (shape=(n)).
  /// @param[in] origin What these pairs measure there, as in a step's start.
  void touch(std::span<const std::int8_t> which, const Mortar& now,
             std::span<const double> offset,
             std::span<const double> origin = {});

  /// @brief What the pairs measure where nothing has moved; empty for nothing.
  const std::vector<double>& origin() const { return _origin; }

  /// @brief kernel::Pairs that the movement is measured with.
  /// @param[in] area Areas of the slave nodes (shape=(n)).
  Mortar pairs(std::span<const double> area) const;

  /// @brief Master facets that slip is measured with.
  std::span<const std::int32_t> masters() const;

  /// @brief Take other numbers of the master facets.
  void rename(std::span<const std::int32_t> numbers);

private:
  const MortarSides* _sides;
  std::vector<double> _gap, _origin;
  std::optional<Mortar> _start;
};
} // namespace contactx::contact
