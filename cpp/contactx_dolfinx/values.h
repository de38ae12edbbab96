// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "cells.h"
#include "functions.h"
#include <cmath>
#include <contactx/problem/values.h>
#include <dolfinx/fem/Constant.h>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

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
              std::span<const std::int32_t> nodes)
  {
    _name = std::move(name);
    _nodes.assign(nodes.begin(), nodes.end());
    if (const auto* constant
        = std::get_if<std::shared_ptr<const Constant>>(&_value))
    {
      if (*constant == nullptr or (*constant)->value.size() != 1)
        throw std::invalid_argument(_name
                                    + " is a constant that is no number: "
                                      "give one of a number");
      return;
    }
    const auto* given = std::get_if<std::shared_ptr<const Function>>(&_value);
    if (given == nullptr)
      return;
    const int degree = V->element()->basix_element().degree();
    if (*given == nullptr or (*given)->function_space()->mesh() != V->mesh()
        or not is_scalar_lagrange(*(*given)->function_space(), {1, degree}))
      throw std::invalid_argument(
          _name
          + " is a function of another space: interpolate it into a continuous "
            "scalar Lagrange space, linear or of the displacement's degree, on "
            "the displacement's mesh");
    const FunctionSpace& Q = *(*given)->function_space();
    if (Q.element()->basix_element().degree() != degree)
    {
      // A linear one where there are nodes between the vertices
      _between = std::make_shared<Function>(Functions::scalars(*V));
      return;
    }
    // Both spaces number the nodes
    const std::vector<std::int32_t> match = matching_nodes(*V, Q);
    for (std::int32_t& node : _nodes)
      node = match[node];
  }

  /// @brief Values at the slave nodes as they are now.
  /// @throws std::invalid_argument if one is not finite.
  std::vector<double> now() const
  {
    std::vector<double> values(_nodes.size(), 0);
    if (const auto* number = std::get_if<double>(&_value))
      std::ranges::fill(values, check(*number));
    else if (const auto* constant
             = std::get_if<std::shared_ptr<const Constant>>(&_value))
      std::ranges::fill(values, check((*constant)->value[0]));
    else
    {
      const auto& given = std::get<std::shared_ptr<const Function>>(_value);
      if (_between)
        _between->interpolate(*given);
      const auto& array = (_between ? *_between : *given).x()->array();
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = check(array[_nodes[i]]);
    }
    return values;
  }

private:
  double check(double value) const
  {
    if (not std::isfinite(value))
      throw std::invalid_argument(
          _name
          + " is not finite: give finite numbers (manual: "
            "errors/values-not-finite)");
    return value;
  }

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
  Values(std::optional<Value> friction, Value offset)
      : _friction(std::move(friction)), _offset(std::move(offset))
  {
  }

  /// @brief Find the nodes; all ranks must take part.
  void attach(const std::shared_ptr<const FunctionSpace>& V,
              std::span<const std::int32_t> nodes)
  {
    _V = V;
    _slaves.assign(nodes.begin(), nodes.end());
    if (_friction)
      _friction->attach("friction", _V, _slaves);
    _offset.attach("offset", _V, _slaves);
  }

  /// @brief Take another coefficient, or another offset.
  void set_friction(Value friction)
  {
    set(_friction.emplace(friction), "friction");
  }

  /// @copydoc set_friction
  void set_offset(Value offset) { set(_offset = std::move(offset), "offset"); }

  bool vary() const override
  {
    return std::exchange(_is_new, false) or not _offset.is_number()
           or (_friction and not _friction->is_number());
  }
  std::optional<std::vector<double>> friction() override
  {
    if (not _friction)
      return std::nullopt;
    return _friction->now();
  }
  std::vector<double> offset() override { return _offset.now(); }

private:
  void set(Value& value, const char* name)
  {
    if (_V)
      value.attach(name, _V, _slaves);
    _is_new = true;
  }

  std::optional<Value> _friction;
  Value _offset;
  mutable bool _is_new = false;
  std::shared_ptr<const FunctionSpace> _V;
  std::vector<std::int32_t> _slaves;
};
} // namespace contactx_dolfinx
