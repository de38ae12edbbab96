// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../condense/contact_block.h"
#include "bulk.h"

namespace contactx::solve
{
class HeldMotions;

/// @brief The coupled system of bulk and contacts.
///
/// Unknowns of a rank are the displacements of its nodes, then those of the
/// bulk's other fields, if it has some, then the multipliers of its slave
/// nodes, one contact after the other. All rows but those of other fields are
/// forces: the
/// complementarity of a slave node is scaled by its area and the stiffness of
/// its node. These unknowns are lengths: a multiplier is divided by its node's
/// factor c, a traction per length. So all entries of the Jacobian are
/// stiffnesses, and pivots do not depend on the units. The factor is rounded to
/// a power of two, which changes no digit of a multiplier.
/// The state is the bulk's displacements and the multipliers of the
/// contacts' nodes. All ranks must call its functions without const.
class System
{
public:
  using Contacts = std::vector<std::shared_ptr<contact::Contact>>;

  /// @brief Lay out the unknowns.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] bulk The bulk.
  /// @param[in] contacts The contacts.
  System(std::shared_ptr<mesh::Halo> halo, std::shared_ptr<Bulk> bulk,
         Contacts contacts);

  /// @brief Nodes of this rank.
  const std::shared_ptr<mesh::Halo>& halo() const { return _halo; }

  /// @brief The bulk.
  const std::shared_ptr<Bulk>& bulk() const { return _bulk; }

  /// @brief The contacts.
  const Contacts& contacts() const { return _contacts; }

  /// @brief Offsets of the bulk and of the multipliers of each contact among
  /// the unknowns, and their number at the end (shape=(contacts + 2)).
  const std::vector<std::size_t>& offsets() const { return _offsets; }

  /// @brief Number of unknowns of this rank.
  std::size_t size() const { return _offsets.back(); }

  /// @brief Number of displacements of this rank.
  std::size_t num_displacements() const { return _num_displacements; }

  /// @brief Number of the bulk's unknowns of this rank, displacements first.
  std::size_t num_bulk() const { return _offsets[1]; }

  /// @brief Start a step: loads, constants and coefficients may have changed.
  void begin_step() { _at.clear(); }

  /// @brief Take the contacts' factors c as the units of their multipliers.
  void take_factors();

  /// @brief Multipliers over unknowns (shape=(size - num_bulk)).
  const std::vector<double>& factors() const { return _factors; }

  /// @brief The unknowns at the state of now.
  /// @param[out] x Unknowns (shape=(size)).
  /// @throws std::invalid_argument if it has another size.
  void unknowns(std::span<double> x) const;

  /// @brief Set the state.
  /// @param[in] x Unknowns (shape=(size)).
  /// @throws std::invalid_argument on all ranks if it has another size.
  void take(std::span<const double> x);

  /// @brief Displacements of all nodes of this rank that a step brings;
  /// collective.
  /// @param[in] dx Step, which is taken off the unknowns (shape=(size)).
  std::vector<double> movement(std::span<const double> dx) const;

  /// @brief Forces of the bulk alone, assembled anew only where unknowns of it
  /// have changed (shape=(num_displacements)).
  std::span<const double> bulk_residual();

  /// @brief Rows of its other fields, with them.
  std::span<const double> fields_residual();

  /// @brief Evaluate the residual at the state of now; pairs and status are as
  /// they stand. Rows of Dirichlet conditions are differences of displacements.
  /// @param[out] b Residual (shape=(size)).
  /// @throws std::invalid_argument on all ranks if it has another size.
  void residual(std::span<double> b);

  /// @brief Take the forces of supports off the residuals to come.
  /// @param[in] held Motions that they hold; nothing for none.
  void hold(std::shared_ptr<HeldMotions> held) { _held = std::move(held); }

  /// @brief Evaluate gaps and laws of all contacts at the state of now; pairs
  /// and status are as they stand.
  void evaluate();

  /// @brief 1 at prescribed displacements of all nodes, those of other ranks
  /// included (shape=(num_nodes, gdim)); all ranks must take part.
  std::vector<std::int8_t> markers() const;

  /// @brief Forces of bulk and contacts, without Dirichlet conditions.
  /// @return Forces at owned dofs (shape=(num_owned, gdim)).
  std::vector<double> forces();

  /// @brief Multiply by the contacts' part of the Jacobian.
  /// @param[in] contact The part of this rank's pairs.
  /// @param[in] x Values of all unknowns (shape=(size)).
  /// @param[out] y Product (shape=(size)).
  /// @throws std::invalid_argument if sizes do not fit.
  void multiply(const condense::ContactBlock& contact,
                std::span<const double> x, std::span<double> y) const;

private:
  std::span<const double> fields_values() const;
  std::vector<double> product(const condense::ContactBlock& contact,
                              std::span<const double> x) const;
  void check(std::size_t size, const char* name) const;
  void add_sums(std::vector<double>& pushed, std::span<double> force) const;

  std::shared_ptr<mesh::Halo> _halo;
  std::shared_ptr<HeldMotions> _held;
  std::shared_ptr<Bulk> _bulk;
  Contacts _contacts;
  std::vector<std::size_t> _offsets;
  std::size_t _num_displacements;
  std::vector<double> _bulk_residual, _fields_residual;
  std::vector<double> _factors;
  // Unknowns of the bulk at which it was assembled; empty if it must be anew
  std::vector<double> _at;
};
} // namespace contactx::solve
