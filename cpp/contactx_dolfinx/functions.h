// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <functional>
#include <span>

namespace contactx::results
{
class Results;
}

namespace contactx_dolfinx
{
/// @brief Results of a contact as functions of DOLFINx, for files and forms.
///
/// Vectors are of the displacement's space, numbers of the scalar Lagrange
/// space of its nodes, which has their numbers. Each has the name of its
/// member.
class Functions
{
public:
  /// @brief Create the functions.
  /// @param[in] V Space of the displacement.
  /// @param[in] slaves Slave nodes that this rank owns, as its blocks of dofs.
  /// @param[in] is_tied Whether the contact is a tie, which has no slip.
  Functions(std::shared_ptr<const FunctionSpace> V,
            std::span<const std::int32_t> slaves, bool is_tied);

  /// @brief Copy results; all ranks must take part.
  void take(const contactx::results::Results& results);

  /// @brief All of them, as io::VTKFile and others write them.
  std::vector<std::reference_wrapper<const Function>> all() const;

  /// @brief Space of numbers at the nodes of a space of vectors, with its
  /// dofmap.
  static std::shared_ptr<const FunctionSpace> scalars(const FunctionSpace& V);

  /// Pressure, force/area, zero off the slave surface
  std::shared_ptr<Function> pressure;
  /// Its means at the nodes of the master, zero elsewhere
  std::shared_ptr<Function> master_pressure;
  /// Traction that the master exerts on the slave, force/area, zero off the
  /// slave surface
  std::shared_ptr<Function> traction;
  /// Gap, a length; NaN off the slave surface and where there is no pair
  std::shared_ptr<Function> gap;
  /// Status: -1 off the slave surface, 0 open, 1 stick or tied, 2 slip or
  /// frictionless in contact
  std::shared_ptr<Function> status;
  /// Slip increment of the last step, a length; null of a tie
  std::shared_ptr<Function> slip;
  /// Accumulated length of slip; null of a tie
  std::shared_ptr<Function> slip_total;

private:
  std::vector<std::shared_ptr<Function>> list() const;

  /// Values of the slave nodes.
  template <class T>
  void set(Function& f, const std::vector<T>& values) const;

  std::vector<std::int32_t> _slaves;
};
} // namespace contactx_dolfinx
