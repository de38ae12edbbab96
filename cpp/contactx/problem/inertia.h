// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/ranks.h"
#include <cstdint>
#include <optional>
#include <span>

namespace contactx::problem
{
/// @brief What a time step needs of the bodies beside solve::Bulk: their
/// masses, and for the balance of energy loads and strain energy.
///
/// An adapter provides it. Arrays that a function returns a view of stay until
/// the function is called again. All ranks must take part in all but
/// `diagonal` and `is_lumped`.
class Inertia
{
public:
  virtual ~Inertia() = default;

  /// @brief Diagonal of the mass matrix M (shape=(num_owned, gdim)).
  virtual std::span<const double> diagonal() const = 0;

  /// @brief True if M has entries on its diagonal alone.
  virtual bool is_lumped() const = 0;

  /// @brief Multiply by M.
  /// @param[in] velocity Velocities (shape=(num_owned, gdim)).
  /// @return Momentum of the dofs (shape=(num_owned, gdim)).
  virtual std::span<const double> product(std::span<const double> velocity) = 0;

  /// @brief Take the dofs that are prescribed before systems with M are solved;
  /// not called where M is lumped.
  /// @param[in] markers 1 at prescribed dofs, else 0 (shape=(num_owned, gdim)).
  virtual void constrain(std::span<const std::int8_t> markers) = 0;

  /// @brief Solve with M without the rows and columns of prescribed dofs; not
  /// called where M is lumped.
  /// @param[in,out] values Impulses, then velocities, zero at prescribed dofs
  /// (shape=(num_owned, gdim)).
  virtual void solve(std::span<double> values) = 0;

  /// @brief Strain energy of this rank at the displacements of now; nothing
  /// where it is not known.
  virtual std::optional<double> strain_energy() { return std::nullopt; }

  /// @brief Loads that do not depend on the displacement, forces of the size
  /// that they have throughout the step (shape=(num_owned, gdim)); empty for
  /// none.
  virtual std::span<const double> loads() { return {}; }
};

/// @brief Check the masses; collective.
/// @param[in] inertia Masses of the bodies.
/// @param[in] ranks The ranks.
/// @throws std::invalid_argument on all ranks if a mass is not positive and
/// finite.
void check_masses(const Inertia& inertia, mesh::Ranks& ranks);
} // namespace contactx::problem
