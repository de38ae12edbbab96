// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace contactx::solve
{
/// @brief Unknowns of a bulk beside displacements: pressures of mixed
/// spaces, temperatures of coupled problems, bubbles.
///
/// Contact does not change them; they are solved for together. Values are those
/// of this rank, one field after the other (shape=(size)).
class Fields
{
public:
  virtual ~Fields() = default;

  /// @brief Offsets of the fields, and the end of the last one.
  virtual std::vector<std::size_t> offsets() const = 0;

  /// @brief Values of now.
  virtual std::span<const double> values() = 0;

  /// @brief Set them, and give other ranks those of theirs. All ranks must take
  /// part.
  virtual void set(std::span<const double> values) = 0;

  /// @brief Their rows of what `Bulk::residual` has assembled last.
  virtual std::span<const double> residual() = 0;

  /// @brief True if these depend on pairs, gaps and pressures, as the heat that
  /// flows across a contact does: they are asked for anew where those have
  /// changed.
  virtual bool follow_contacts() const { return false; }

  /// @brief Values minus Dirichlet values where these are prescribed, else
  /// zero.
  virtual std::span<const double> defect() = 0;

  /// @brief Their rows of what `Bulk::lifted` has assembled last.
  virtual std::span<const double> lifted() = 0;

  /// @brief 1 at prescribed values, else 0.
  virtual std::span<const std::int8_t> markers() = 0;

  /// @brief Products of the bulk's Jacobian with some sizes, all entries by
  /// their size. All ranks must take part. It is dear, and asked for where a
  /// residual may be no more than rounding errors.
  /// @param[in] sizes Sizes of all unknowns of the bulk, displacements first.
  /// @return Sum of the sizes in each row, in the same order.
  virtual std::span<const double>
  absolute_products(std::span<const double> sizes) = 0;
};
} // namespace contactx::solve
