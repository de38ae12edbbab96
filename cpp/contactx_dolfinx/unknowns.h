// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <cstdint>
#include <span>

namespace contactx_dolfinx
{
/// @brief Bodies whose displacement is solved for together with other fields:
/// the forms of each function, which is a block of rows and of columns. A
/// function of a mixed space is the only one.
struct Blocks
{
  /// Residual of each function, linear in its test function
  std::vector<std::shared_ptr<const Form>> F;
  /// Derivative of each residual by each function, in rows; null for none
  std::vector<std::vector<std::shared_ptr<const Form>>> J;
  /// The functions
  std::vector<std::shared_ptr<Function>> functions;
  /// Number of the function that is the displacement, or of the part of the
  /// mixed space
  int displacement = 0;
};

namespace input
{
/// @brief Check that residuals and their derivatives are forms of the functions
/// that are solved for.
///
/// A residual that has none of them may still depend on them through functions
/// of other spaces, as stresses at quadrature points that a program updates.
/// @throws std::invalid_argument if there are not as many, one is null, has
/// another number of arguments or arguments of another space, or none depends
/// on the functions.
void check_blocks(const Blocks& blocks);
} // namespace input

/// @brief Functions that are solved for together, and the place of the
/// displacement in them.
///
/// The displacement is one of the functions itself, or a copy of what one has
/// of it at the nodes: of a mixed space, or of one with bubbles inside of the
/// cells.
class Unknowns
{
public:
  /// @brief Owned dofs of a function that are one field.
  struct Field
  {
    int function; ///< number of the function
    std::vector<std::int32_t> dofs;
  };

  /// @brief Find the displacement.
  /// @param[in] functions The functions.
  /// @param[in] displacement Number of the displacement among them, or among
  /// the parts of the mixed space.
  /// @throws std::invalid_argument if there is no such part, or it is no
  /// displacement that contact can act on.
  Unknowns(std::vector<std::shared_ptr<Function>> functions, int displacement);

  /// @brief The functions.
  const std::vector<std::shared_ptr<Function>>& functions() const
  {
    return _functions;
  }

  /// @brief Number of the function that has the displacement.
  int index() const { return _index; }

  /// @brief Displacement, in a Lagrange space of vectors of degree 1 or 2.
  const std::shared_ptr<Function>& u() const { return _u; }

  /// @brief True if that is a copy.
  bool is_copy() const { return _u != _functions[_index]; }

  /// @brief The other fields.
  const std::vector<Field>& fields() const { return _fields; }

  /// @brief Dofs of the function that has it at the displacement's owned ones
  /// (shape=(num_displacements)).
  const std::vector<std::int32_t>& dofs() const { return _owned; }

  /// @brief Values at the displacement's dofs, ghosts included, of those of the
  /// function that has it.
  template <class T>
  std::vector<T> displacements_of(std::span<const T> values) const
  {
    if (not is_copy())
      return {values.begin(), values.end()};
    std::vector<T> taken(_dofs.size());
    for (std::size_t i = 0; i < _dofs.size(); ++i)
      taken[i] = values[_dofs[i]];
    return taken;
  }

  /// @brief Take the displacement that the function has, where u is a copy.
  void read();

  /// @brief Give the function the displacement, where u is a copy.
  void write();

  /// @brief Number of dofs of a function that this rank owns.
  static std::size_t num_owned(const Function& w);

private:
  void check_functions() const;

  /// Makes the displacement as a copy of a part that has dofs on facets as
  /// Lagrange spaces have them, and maybe more inside of cells.
  void copy_from(const FunctionSpace& part);

  /// Finds the dofs of a part at each component of each node.
  void find_nodes(const FunctionSpace& part);

  void find_fields();

  std::vector<std::shared_ptr<Function>> _functions;
  int _index = 0;
  std::shared_ptr<Function> _u;
  // Dofs of the function that has it, at those of the displacement, ghosts
  // included; empty if it is that function
  std::vector<std::int32_t> _dofs;
  std::vector<std::int32_t> _owned;
  std::vector<Field> _fields;
};
} // namespace contactx_dolfinx
