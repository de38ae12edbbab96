// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "contact.h"
#include <contactx/results/conductance.h>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

namespace contactx_dolfinx
{
/// @brief Flow of a scalar field from the slave to the master of a contact,
/// q = h(p, g) (T_slave - T_master) per area; see
/// contactx::results::Conductance.
///
/// Given to an Assembler that solves for displacement and field together it is
/// part of that system, with its derivatives. Where the field is solved for by
/// itself, after the contact, `residual` and `by_field` belong to its system.
class Conductance
{
public:
  /// @brief Let a field flow across a contact.
  /// @param[in] contact The contact.
  /// @param[in] field Field, in the scalar Lagrange space of the displacement's
  /// degree and mesh.
  /// @param[in] coefficient Coefficient h.
  /// @param[in] obstacle_value Value of the field at a rigid obstacle; only
  /// there, and needed there.
  /// @throws std::invalid_argument if contact or field are null, or
  /// `obstacle_value` is missing or has no place.
  Conductance(std::shared_ptr<Contact> contact, std::shared_ptr<Function> field,
              contactx::law::Coefficient coefficient,
              std::optional<double> obstacle_value = std::nullopt)
      : _contact(std::move(contact)), _field(std::move(field)),
        _coefficient(std::move(coefficient)), _obstacle_value(obstacle_value)
  {
    if (_contact == nullptr or _field == nullptr)
      throw std::invalid_argument("contact or field of a Conductance is null: "
                                  "give both");
    contactx::results::check_obstacle_value(_obstacle_value,
                                            _contact->is_rigid());
  }

  /// @brief The contact.
  const std::shared_ptr<Contact>& contact() const { return _contact; }

  /// @brief The field.
  const std::shared_ptr<Function>& field() const { return _field; }

  /// @brief Take another value of the field at the obstacle.
  /// @throws std::invalid_argument if the master is no obstacle.
  void set_obstacle_value(double value)
  {
    contactx::results::check_obstacle_value(value, _contact->is_rigid());
    _obstacle_value = value;
  }

  /// @brief Find the nodes of the field; the Assembler does so.
  /// @throws std::logic_error if the contact belongs to no Assembler yet.
  /// @throws std::invalid_argument if the field is of another space.
  void check()
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

  /// @brief Flow from the slave to the master, of all ranks, for field and
  /// contact as they are now. All ranks must take part.
  double flow() { return core().flow(values()); }

  /// @brief Flow out of each dof of the field that this rank owns, negative
  /// into the master's: what belongs to the left-hand side of a balance
  /// (shape=(number of owned dofs)). All ranks must take part.
  std::vector<double> residual()
  {
    const std::vector<double> of_nodes = core().residual(values());
    std::vector<double> flow(of_nodes.size());
    for (std::size_t i = 0; i < flow.size(); ++i)
      flow[_nodes[i]] = of_nodes[i];
    return flow;
  }

  /// @brief Derivative of the residual by the field, by the nodes of the
  /// contact's halo, of which `at_nodes` tells what a dof has. All ranks must
  /// take part.
  contactx::Triplets by_field() { return core().by_field(); }

  /// @brief All derivatives of the residual, see
  /// contactx::results::Derivatives. All ranks must take part.
  contactx::results::Derivatives derivatives()
  {
    return core().derivatives(values());
  }

  /// @brief Values of the field's owned dofs at all nodes of the contact's
  /// halo. All ranks must take part.
  std::vector<std::int64_t> at_nodes(std::span<const std::int64_t> values)
  {
    const contactx::mesh::Halo& halo = _contact->discrete().halo();
    std::vector<std::int64_t> at(halo.num_nodes());
    for (std::int32_t i = 0; i < halo.num_owned(); ++i)
      at[i] = values[_nodes[i]];
    halo.forward(std::span(at), 1);
    return at;
  }

private:
  /// The core's, with coefficient and obstacle's value of now.
  contactx::results::Conductance core()
  {
    if (_nodes.empty())
      check();
    return {_contact->shared_discrete(), _contact->shared_results(),
            _coefficient, _obstacle_value};
  }

  std::vector<double> values() const
  {
    std::vector<double> values(_contact->discrete().halo().num_owned());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = _field->x()->array()[_nodes[i]];
    return values;
  }

  std::shared_ptr<Contact> _contact;
  std::shared_ptr<Function> _field;
  contactx::law::Coefficient _coefficient;
  std::optional<double> _obstacle_value;
  // Node of the field at each of the displacement's
  std::vector<std::int32_t> _nodes;
};
} // namespace contactx_dolfinx
