// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include "contact_forms.h"
#include <array>

namespace contactx_dolfinx
{
/// @brief Adds contact, from forms, to a matrix and a vector that have the bulk
/// already.
///
/// The loop, the assembly of the bulk and its Dirichlet conditions are the
/// program's, in DOLFINx's NewtonSolver for example. Contact is one call in
/// each place:
///
///     Assembler assembler(F, J, u, bcs, {contact});
///     Forms forms(assembler, J);
///     assembler.begin_step();
///     Vec x = assembler.x(), b = assembler.create_vector();
///     while (not forms.settle(x).converged) // pairs, active set and law
///     {
///       ...                      // b = residual of the bulk
///       forms.assemble_vector(b);
///       Mat A = forms.matrix();
///       ...                      // add the Jacobian of the bulk to A
///       forms.assemble_matrix(A);
///       ...                      // solve and update x
///     }
///     assembler.accept();
///
/// The unknowns are those of the assembler: a rank's displacements, then its
/// multipliers over the factor c. The matrix is made from one sparsity pattern.
/// Its local numbers are those of the displacement, with the nodes of other
/// ranks that contact needs behind those of the bulk, then those of the
/// multipliers of each contact.
class Forms
{
public:
  /// @brief Make the forms of all contacts; all ranks must take part.
  /// @param[in] assembler Bulk and contacts; the displacement is all that it
  /// solves for. It must outlive this.
  /// @param[in] J Bilinear form of the displacement, for whose entries the
  /// matrix has places.
  /// @throws std::invalid_argument if the assembler has other fields, or J is
  /// no bilinear form of the displacement's space.
  Forms(Assembler& assembler, std::shared_ptr<const Form> J);
  Forms(const Forms&) = delete;
  Forms& operator=(const Forms&) = delete;

  /// @brief Matrix for bulk and contacts, zero, with places for the entries of
  /// the pairs of now. It is always the same one, and belongs to this. All
  /// ranks must take part.
  ///
  /// The Jacobian of the bulk is assembled into it with
  /// `la::petsc::Matrix::set_block_expand_fn`: the displacements are its first
  /// local numbers.
  ::Mat matrix();

  /// @brief Update pairs, active set and law at an accepted iterate, once an
  /// iteration. See Assembler::settle, which this calls. Steps are taken by the
  /// caller, not by Assembler::update.
  /// @param[in,out] x The iterate: the state becomes this. It may change a
  /// little.
  /// @param[in] rtol Tolerance relative to the forces of the problem.
  /// @param[in] atol Absolute tolerance, a force.
  /// @param[in] max_it Most linear solves of the step.
  /// @throws ConvergenceError if no solution is to be expected any more.
  const Settled& settle(::Vec x, double rtol = 1e-11, double atol = 0,
                        int max_it = 50);

  /// @brief Evaluate gaps and law at some x, as in a line search; pairs and
  /// active set stay.
  /// @param[in] x Unknowns: the state becomes this.
  void update(::Vec x);

  /// @brief Add the contacts' residual, but for rows with a Dirichlet
  /// condition.
  /// @param[in,out] b Residual of the bulk, with zero for the multipliers.
  void assemble_vector(::Vec b);

  /// @brief Add the contacts' Jacobian, but for rows with a Dirichlet
  /// condition, and finish the matrix.
  ///
  /// The columns of these dofs stay: what is prescribed need not be lifted for
  /// contact.
  /// @param[in,out] A The matrix, with the Jacobian of the bulk.
  /// @throws std::invalid_argument if it is not that of `matrix`, or pairs have
  /// become others since.
  void assemble_matrix(::Mat A);

  /// @brief Split an assembled matrix into its blocks K, B, C, D, in this
  /// order, which the caller destroys. All ranks must take part.
  /// @param[in] A The matrix.
  std::array<::Mat, 4> blocks(::Mat A) const;

private:
  using Maps = std::vector<std::pair<ContactForms::IndexMap, int>>;

  contactx::solve::System& system() const { return *_assembler->system(); }
  int gdim() const { return _assembler->bulk()->gdim(); }
  MPI_Comm comm() const
  {
    return _assembler->bulk()->u()->function_space()->mesh()->comm();
  }

  void take(::Vec x);
  void evaluate();

  /// Lets the forms follow the state.
  void refresh();

  /// Calls a function with each form and the numbers of its blocks of rows and
  /// columns: first the displacement, then the multipliers of each contact.
  template <class Use>
  void for_each_block(Use&& use) const;

  Maps maps() const;

  /// Makes the matrix from one sparsity pattern.
  void create();

  /// Tells the matrix of the local numbers of rows and columns.
  void set_numbers();

  Assembler* _assembler;
  std::shared_ptr<const Form> _J;
  std::vector<const ContactForms*> _forms;
  // Versions of the forms, and of those that the matrix is for
  std::vector<std::int64_t> _versions, _made_for;
  petsc::OwnMat _A;
};
} // namespace contactx_dolfinx
