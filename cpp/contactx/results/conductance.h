// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../law/conductance_coefficient.h"
#include "../math/triplets.h"
#include "results.h"
#include "transfer.h"
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace contactx::results
{
/// @brief Check that the field has a value at a rigid obstacle, and that one is
/// given nowhere else.
/// @param[in] obstacle_value Value of the field there, if it is given.
/// @param[in] is_rigid Whether the master is a rigid obstacle.
/// @throws std::invalid_argument if not.
void check_obstacle_value(std::optional<double> obstacle_value, bool is_rigid);

/// @brief Derivatives of the flows out of this rank's nodes; entries of one
/// place on several ranks add up.
struct Derivatives
{
  /// By the field: nodes by nodes
  Triplets by_field;
  /// By the displacement, as flows depend on gaps: nodes by displacements, of
  /// which that of node j along axis k is gdim j + k
  Triplets by_displacement;
  /// By the multipliers, as flows depend on pressures: nodes by multipliers of
  /// the owned slave nodes, in the order of law::NodeState::multiplier
  Triplets by_multiplier;
};

/// @brief Flow of a scalar field T, a temperature for example, from the slave
/// to the master of a contact: h(p, g) (T_slave - T_master) per area.
///
/// p is the recovered pressure and g the gap of the iterate, h the coefficient.
/// With the weights w_ij of Transfer the flow out of node j is
/// sum_i w_ij A_i h_i sum_k w_ik T_k: what leaves one side enters the other.
/// Flows are integrals with the contact's weight, over reference areas. Nodes
/// without a master in front of them, and contacts that are switched off,
/// conduct nothing.
///
/// Everything is evaluated for positions, pairs and multipliers as they are at
/// the call. All ranks must call all functions. Fields are those of the owned
/// nodes (shape=(num_owned)).
class Conductance
{
public:
  /// @brief Let a field flow across a contact.
  /// @param[in] contact The contact.
  /// @param[in] results Its results, which recover its pressures.
  /// @param[in] coefficient law::Coefficient h.
  /// @param[in] obstacle_value Value of the field at a rigid obstacle.
  /// @throws std::invalid_argument if contact or results are null, or
  /// `obstacle_value` is missing or has no place.
  Conductance(std::shared_ptr<contact::Contact> contact,
              std::shared_ptr<const Results> results,
              law::Coefficient coefficient,
              std::optional<double> obstacle_value = std::nullopt);

  /// @brief Flow from the slave to the master, of all ranks.
  ///
  /// Ranks add up their slave nodes in order.
  /// @param[in] field Values of the field.
  /// @return Flow: unit of the coefficient times that of the field and area.
  /// @throws std::invalid_argument on all ranks if the coefficient does not
  /// fit, see `law::Coefficient::values`, or there are not as many values.
  double flow(std::span<const double> field);

  /// @brief Flow out of each node: what belongs to the left-hand side of a
  /// balance.
  /// @param[in] field Values of the field.
  /// @return Flow out of the owned nodes, negative into those of the master
  /// (shape=(num_owned)).
  /// @throws std::invalid_argument as `flow` does.
  std::vector<double> residual(std::span<const double> field);

  /// @brief Derivative of the residual by the field: symmetric and positive
  /// semidefinite.
  /// @return Entries of this rank's pairs, nodes by nodes, see Derivatives.
  /// @throws std::invalid_argument as `flow` does.
  Triplets by_field();

  /// @brief All derivatives of the residual; pairs and normals stay.
  /// @param[in] field Values of the field.
  /// @throws std::invalid_argument as `flow` does.
  Derivatives derivatives(std::span<const double> field);

private:
  /// The iterate: its pairs, and the slave nodes that conduct
  struct Iterate
  {
    Transfer transfer;
    std::vector<std::int32_t> nodes;   // slave nodes that conduct
    std::vector<double> pressure, gap; // of these
    std::vector<double> h;             // zero at all others (n)
  };

  Iterate evaluate() const;
  std::vector<double> differences(const Iterate& iterate,
                                  std::span<const double> field) const;
  std::vector<double> flows(const Iterate& iterate,
                            std::span<const double> field) const;

  std::shared_ptr<contact::Contact> _contact;
  std::shared_ptr<const Results> _results;
  law::Coefficient _coefficient;
  std::optional<double> _obstacle_value;
};
} // namespace contactx::results
