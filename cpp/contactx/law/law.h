// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/ranks.h"
#include "node_state.h"
#include "slip_history.h"
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace contactx::law
{
/// @brief Complementarity of the slave nodes of a contact.
class Law
{
public:
  virtual ~Law() = default;

  /// @brief Name of the kernels.
  virtual std::string_view name() const = 0;

  /// @brief True if the multiplier is a vector, and slip is measured.
  virtual bool is_vector() const { return true; }

  /// @brief True if pairs are always those of the reference configuration.
  virtual bool is_tied() const { return false; }

  /// @brief Start a step: what iterates of the last one have shown does not
  /// count.
  virtual void begin_step() {}

  /// @brief Accept any trial friction in this step, where the active set
  /// cycles.
  virtual void allow_any_friction() {}

  /// @brief Set each node's status from its multiplier, gap and slip.
  /// @param[in,out] nodes Slave nodes.
  /// @param[in] ranks The ranks, all of which take part.
  /// @return Number of this rank's nodes that changed.
  /// @throws std::invalid_argument if the multipliers are not those of the law.
  virtual std::int32_t set_status(NodeState& nodes, mesh::Ranks& ranks) const
      = 0;

  /// @brief Compute the complementarity function and its derivatives for the
  /// status.
  /// @param[in,out] nodes Slave nodes.
  /// @throws std::invalid_argument if the multipliers are not those of the law.
  virtual void evaluate(NodeState& nodes) const = 0;

  /// @brief Set the bounds of friction of nodes on an interior path, by their
  /// pressures there; zero without friction.
  /// @param[in,out] nodes Slave nodes with an interior state.
  virtual void bound_interior(NodeState&) const {}

  /// @brief True if it calls a user's function, which may throw on one rank
  /// alone.
  virtual bool may_throw() const { return false; }
};

/// @brief Unilateral contact: p >= 0, g >= 0, p g = 0; see `normal_status`.
class Frictionless final : public Law
{
public:
  std::string_view name() const override { return "frictionless"; }
  bool is_vector() const override { return false; }
  std::int32_t set_status(NodeState& nodes, mesh::Ranks& ranks) const override;
  void evaluate(NodeState& nodes) const override;
};

/// @brief Bounds of friction with their derivatives, one value a slave node
/// (shape=(n)).
struct Bounds
{
  std::vector<double> bound;       ///< largest |t|, a traction of at least 0
  std::vector<double> by_pressure; ///< derivative by the pressure
  std::vector<double> by_slip;     ///< derivative by the length of the slip
};

/// @brief Bounds of friction from pressures of at least 0 and accumulated
/// lengths of slip, of all accepted steps and this one (shape=(n)).
using BoundFunction = std::function<Bounds(std::span<const double> pressure,
                                           std::span<const double> slip)>;

/// @brief Unilateral contact with dry friction: |t| <= mu p, and slip only
/// where they are equal; see `frictional_status`. Or with another bound than
/// mu p, such as Tresca's.
class Coulomb final : public Law
{
public:
  Coulomb() = default;

  /// @brief Take another bound than Coulomb's.
  /// @param[in] bound Function that gives it.
  explicit Coulomb(BoundFunction bound) : _bound(std::move(bound)) {}

  std::string_view name() const override { return "frictional"; }
  void begin_step() override { _has_cycled = false; }

  /// @copydoc Law::allow_any_friction
  ///
  /// A node that friction moves far may have been deformed by it after all.
  void allow_any_friction() override { _has_cycled = true; }

  /// @brief Take what accepted steps have slipped, which a bound counts, too.
  void follow(std::shared_ptr<const SlipHistory> history)
  {
    _history = std::move(history);
  }

  /// @brief Take the coefficients of friction, which count from now on.
  /// @param[in] friction Coefficients (shape=(n)).
  /// @throws std::invalid_argument if one is negative or not finite; nothing
  /// has changed.
  void set_friction(std::span<const double> friction);

  /// @brief Coefficients of friction, zero where it is left out: derivatives of
  /// the bounds by the pressures (shape=(n)).
  /// @param[in] nodes Slave nodes.
  /// @throws std::invalid_argument if coefficients of others have been taken,
  /// or a function of the bound gives what is none.
  std::vector<double> friction(const NodeState& nodes) const;

  /// @brief Largest coefficient of friction on this rank, infinite with another
  /// bound than Coulomb's.
  double friction_max() const;

  /// @brief Mark the nodes that friction acts on: their bound is not zero
  /// (shape=(n)).
  /// @param[in] nodes Slave nodes.
  /// @throws std::invalid_argument as above.
  std::vector<std::int8_t> has_friction(const NodeState& nodes) const;

  void bound_interior(NodeState& nodes) const override;

  bool may_throw() const override { return bool(_bound); }

  /// @copydoc Law::set_status
  ///
  /// At the friction bound a node that slips keeps slipping. One that closes
  /// repeatedly with slip, which opens it, sticks every fourth time. A node
  /// whose slip reverses sticks and slips in turn: one that opens only while it
  /// slips back would alternate without end.
  std::int32_t set_status(NodeState& nodes, mesh::Ranks& ranks) const override;
  void evaluate(NodeState& nodes) const override;

private:
  Bounds bounds(const NodeState& nodes, std::span<const double> pressure) const;

  BoundFunction _bound;
  std::shared_ptr<const SlipHistory> _history;
  std::vector<double> _friction;
  bool _has_cycled = false;
};

/// @brief Slave nodes keep their place in the frame of their facet: those with
/// a pair are tied, and slip has a normal part, too.
///
/// Each component on its own is A c ds where it can move, else A lambda.
class Tied final : public Law
{
public:
  std::string_view name() const override { return "tied"; }
  bool is_tied() const override { return true; }
  std::int32_t set_status(NodeState& nodes, mesh::Ranks& ranks) const override;
  void evaluate(NodeState& nodes) const override;
};
} // namespace contactx::law
