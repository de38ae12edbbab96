// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "values.h"
#include "cells.h"
#include "functions.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace contactx_dolfinx
{
void Value::attach(std::string name,
                   const std::shared_ptr<const FunctionSpace>& V,
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

std::vector<double> Value::now() const
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

double Value::check(double value) const
{
  if (not std::isfinite(value))
    throw std::invalid_argument(
        _name
        + " is not finite: give finite numbers (manual: "
          "errors/values-not-finite)");
  return value;
}

Values::Values(std::optional<Value> friction, Value offset)
    : _friction(std::move(friction)), _offset(std::move(offset))
{
}

void Values::attach(const std::shared_ptr<const FunctionSpace>& V,
                    std::span<const std::int32_t> nodes)
{
  _V = V;
  _slaves.assign(nodes.begin(), nodes.end());
  if (_friction)
    _friction->attach("friction", _V, _slaves);
  _offset.attach("offset", _V, _slaves);
}
bool Values::vary() const
{
  return std::exchange(_is_new, false) or not _offset.is_number()
         or (_friction and not _friction->is_number());
}

std::optional<std::vector<double>> Values::friction()
{
  if (not _friction)
    return std::nullopt;
  return _friction->now();
}

void Values::set(Value& value, const char* name)
{
  if (_V)
    value.attach(name, _V, _slaves);
  _is_new = true;
}
} // namespace contactx_dolfinx
