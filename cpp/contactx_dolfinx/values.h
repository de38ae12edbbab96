// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <contactx/problem/values.h>
#include <dolfinx/fem/Constant.h>
#include <optional>
#include <span>
#include <variant>

namespace contactx_dolfinx
{
/// @brief A number, a constant, or a function of a scalar Lagrange space, which
/// may change from one iterate to the next.
class Value
{
public:
  using Constant = dolfinx::fem::Constant<double>;

  /// @brief A number, the same at all nodes.
  Value(double value) : _value(value) {}

  /// @brief A constant of DOLFINx, of a number.
  Value(std::shared_ptr<const Constant> value) : _value(std::move(value)) {}

  /// @brief A function of a scalar Lagrange space, linear or of the
  /// displacement's degree.
  Value(std::shared_ptr<const Function> value) : _value(std::move(value)) {}

  /// @brief True if it is a number, which never changes.
  bool is_number() const { return std::holds_alternative<double>(_value); }

  /// @brief Find the nodes of a function; all ranks must take part.
  /// @param[in] name What messages call it.
  /// @param[in] V Space of the displacement.
  /// @param[in] nodes Slave nodes of this rank, its blocks of dofs.
  /// @throws std::invalid_argument if a constant is null or no number, or a
  /// function is null or of another space.
  void attach(std::string name, const std::shared_ptr<const FunctionSpace>& V,
              std::span<const std::int32_t> nodes);

  /// @brief Values at the slave nodes as they are now.
  /// @throws std::invalid_argument if one is not finite.
  std::vector<double> now() const;

private:
  double check(double value) const;

  std::variant<double, std::shared_ptr<const Constant>,
               std::shared_ptr<const Function>>
      _value;
  std::string _name;
  std::vector<std::int32_t> _nodes;
  std::shared_ptr<Function> _between;
};

/// @brief Friction and offset of a contact, as the core reads them.
class Values final : public contactx::problem::Values
{
public:
  /// @brief Take the values.
  /// @param[in] friction Coulomb's coefficient; nothing where the law takes
  /// none.
  /// @param[in] offset Length that is taken off the gap.
  Values(std::optional<Value> friction, Value offset);

  /// @brief Find the nodes; all ranks must take part.
  void attach(const std::shared_ptr<const FunctionSpace>& V,
              std::span<const std::int32_t> nodes);

  /// @brief Take another coefficient, or another offset.
  void set_friction(Value friction)
  {
    set(_friction.emplace(friction), "friction");
  }

  /// @copydoc set_friction
  void set_offset(Value offset) { set(_offset = std::move(offset), "offset"); }

  bool vary() const override;
  std::optional<std::vector<double>> friction() override;
  std::vector<double> offset() override { return _offset.now(); }

private:
  void set(Value& value, const char* name);

  std::optional<Value> _friction;
  Value _offset;
  mutable bool _is_new = false;
  std::shared_ptr<const FunctionSpace> _V;
  std::vector<std::int32_t> _slaves;
};
} // namespace contactx_dolfinx
