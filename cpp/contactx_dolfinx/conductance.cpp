// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "conductance.h"
#include "cells.h"
#include "contact.h"
#include <stdexcept>

namespace contactx_dolfinx
{
Conductance::Conductance(std::shared_ptr<Contact> contact,
                         std::shared_ptr<Function> field,
                         contactx::law::Coefficient coefficient,
                         std::optional<double> obstacle_value)
    : _contact(std::move(contact)), _field(std::move(field)),
      _coefficient(std::move(coefficient)), _obstacle_value(obstacle_value)
{
  if (_contact == nullptr or _field == nullptr)
    throw std::invalid_argument("contact or field of a Conductance is null: "
                                "give both");
  contactx::results::check_obstacle_value(_obstacle_value,
                                          _contact->is_rigid());
}

void Conductance::set_obstacle_value(double value)
{
  contactx::results::check_obstacle_value(value, _contact->is_rigid());
  _obstacle_value = value;
}

void Conductance::check()
{
  const FunctionSpace &V = _contact->space(), &Q = *_field->function_space();
  const int degree = V.element()->basix_element().degree();
  if (Q.mesh() != V.mesh() or not is_scalar_lagrange(Q, {degree}))
    throw std::invalid_argument(
        "the field of a conductance is of another space: take the scalar "
        "Lagrange space of degree "
        + std::to_string(degree)
        + " on the displacement's mesh, whose nodes are those of contact");
  _nodes = matching_nodes(V, Q);
}
std::vector<double> Conductance::residual()
{
  const std::vector<double> of_nodes = core().residual(values());
  std::vector<double> flow(of_nodes.size());
  for (std::size_t i = 0; i < flow.size(); ++i)
    flow[_nodes[i]] = of_nodes[i];
  return flow;
}
std::vector<std::int64_t>
Conductance::at_nodes(std::span<const std::int64_t> values)
{
  const contactx::mesh::Halo& halo = _contact->discrete().halo();
  std::vector<std::int64_t> at(halo.num_nodes());
  for (std::int32_t i = 0; i < halo.num_owned(); ++i)
    at[i] = values[_nodes[i]];
  halo.forward(std::span(at), 1);
  return at;
}

contactx::results::Conductance Conductance::core()
{
  if (_nodes.empty())
    check();
  return {_contact->shared_discrete(), _contact->shared_results(), _coefficient,
          _obstacle_value};
}

std::vector<double> Conductance::values() const
{
  std::vector<double> values(_contact->discrete().halo().num_owned());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = _field->x()->array()[_nodes[i]];
  return values;
}
} // namespace contactx_dolfinx
