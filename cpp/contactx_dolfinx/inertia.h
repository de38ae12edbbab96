// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include "petsc.h"
#include <contactx/problem/inertia.h>
#include <dolfinx/la/Vector.h>
#include <optional>
#include <span>

namespace contactx_dolfinx
{
/// @brief Masses, loads and strain energy of the bodies: forms of DOLFINx, as
/// the core asks for them.
class Inertia final : public contactx::problem::Inertia
{
public:
  /// @brief Assemble the mass matrix; all ranks must take part.
  ///
  /// Masses are lumped where the matrix is diagonal: where the form is
  /// integrated by its values at vertices.
  /// @param[in] mass Inertia, a bilinear form.
  /// @param[in] loads Virtual work of the loads; null for none.
  /// @param[in] strain_energy Strain energy, a form without arguments; null
  /// for none.
  /// @param[in] ranks The ranks.
  Inertia(const Form& mass, std::shared_ptr<const Form> loads,
          std::shared_ptr<const Form> strain_energy,
          contactx::mesh::Ranks& ranks);

  std::span<const double> diagonal() const override { return _diagonal; }
  bool is_lumped() const override { return _is_lumped; }
  std::span<const double> product(std::span<const double> velocity) override;
  void constrain(std::span<const std::int8_t> markers) override;
  void solve(std::span<double> values) override;
  std::optional<double> strain_energy() override;
  std::span<const double> loads() override;

private:
  std::shared_ptr<const Form> _loads, _strain_energy;
  petsc::OwnMat _A;
  petsc::OwnVec _x, _y;
  std::vector<double> _diagonal, _product;
  bool _is_lumped = false;
  std::optional<dolfinx::la::Vector<double>> _b;
  // Consistent masses without prescribed dofs
  std::vector<std::int8_t> _markers;
  petsc::OwnMat _free;
  petsc::OwnKSP _ksp;
};
} // namespace contactx_dolfinx
