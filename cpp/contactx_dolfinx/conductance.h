// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <contactx/results/conductance.h>
#include <optional>
#include <span>

namespace contactx_dolfinx
{
class Contact;

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
              std::optional<double> obstacle_value = std::nullopt);

  /// @brief The contact.
  const std::shared_ptr<Contact>& contact() const { return _contact; }

  /// @brief The field.
  const std::shared_ptr<Function>& field() const { return _field; }

  /// @brief Take another value of the field at the obstacle.
  /// @throws std::invalid_argument if the master is no obstacle.
  void set_obstacle_value(double value);

  /// @brief Find the nodes of the field; the Assembler does so.
  /// @throws std::logic_error if the contact belongs to no Assembler yet.
  /// @throws std::invalid_argument if the field is of another space.
  void check();

  /// @brief Flow from the slave to the master, of all ranks, for field and
  /// contact as they are now. All ranks must take part.
  double flow() { return core().flow(values()); }

  /// @brief Flow out of each dof of the field that this rank owns, negative
  /// into the master's: what belongs to the left-hand side of a balance
  /// (shape=(number of owned dofs)). All ranks must take part.
  std::vector<double> residual();

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
  std::vector<std::int64_t> at_nodes(std::span<const std::int64_t> values);

private:
  /// The core's, with coefficient and obstacle's value of now.
  contactx::results::Conductance core();

  std::vector<double> values() const;

  std::shared_ptr<Contact> _contact;
  std::shared_ptr<Function> _field;
  contactx::law::Coefficient _coefficient;
  std::optional<double> _obstacle_value;
  // Node of the field at each of the displacement's
  std::vector<std::int32_t> _nodes;
};
} // namespace contactx_dolfinx
