// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include "jacobian.h"
#include "krylov.h"
#include <optional>

namespace contactx_dolfinx
{
/// @brief GMRES with the factors of an older Jacobian of an assembler.
class DirectSolver final : public contactx::condense::DirectSolver
{
public:
  /// @brief Take the system.
  /// @param[in] assembler The system; it must outlive this.
  /// @param[in] prefix Prefix of PETSc's options.
  DirectSolver(Assembler& assembler, std::string prefix);

  void assemble(const contactx::condense::Springs& springs) override;
  bool factorise() override;
  contactx::condense::Iterations solve(std::span<const double> b,
                                       std::span<double> x, double target,
                                       int most) override;
  void reset() override;

private:
  Assembler* _assembler;
  std::string _prefix;
  petsc::OwnMat _A;
  std::optional<Jacobian> _jacobian;
  std::optional<petsc::Krylov> _krylov;
  PetscObjectState _pattern = -1; // of the factors
};

/// @brief What the condensed solver needs of linear algebra, by PETSc; see
/// contactx::condense::Algebra.
class Algebra final : public petsc::Matrices
{
public:
  using Apply = contactx::condense::Apply;
  using MatrixPtr = contactx::condense::MatrixPtr;

  /// @brief Take the system.
  /// @param[in] assembler The system; it must outlive this.
  /// @param[in] prefix Prefix of PETSc's options: of multigrid's Krylov solver;
  /// with a name of factors, `bodies_model_` or `direct_` behind it of others.
  Algebra(Assembler& assembler, std::string prefix);

  void update_bulk() override { _bulk->assemble(); }
  int assemblies() const override { return _bulk->assemblies(); }

  /// @copydoc contactx::condense::Algebra::is_symmetric
  ///
  /// It is where x.Ky = y.Kx for two random vectors, which an asymmetric K
  /// fails but for chance.
  bool is_symmetric() override;

  MatrixPtr bulk() override;
  MatrixPtr bulk_copy() override { return petsc::duplicate(stiffness()); }
  MatrixPtr bulk_rows(std::span<const std::int32_t> dofs) override;
  contactx::condense::FieldBlocks field_blocks() override;

  std::span<const std::int8_t> prescribed() override
  {
    return _bulk->markers();
  }

  std::unique_ptr<contactx::condense::Factors>
  factorise(MatrixPtr A,
            const contactx::condense::FactorOptions& options) override;
  std::unique_ptr<contactx::condense::Hierarchy>
  hierarchy(MatrixPtr A,
            const std::vector<std::vector<double>>& near_null_space,
            int block_size, Apply multiply) override;
  std::optional<contactx::condense::Aggregates>
  aggregate(MatrixPtr A,
            const std::vector<std::vector<double>>& near_null_space,
            int block_size) override;
  std::unique_ptr<contactx::condense::FlexibleGMRES>
  flexible_gmres(std::size_t size, Apply multiply, Apply precondition,
                 int restart) override;
  std::unique_ptr<contactx::condense::DirectSolver> direct_solver() override;
  std::string preconditioner() const override;

private:
  using Blocks = std::vector<std::vector<MatrixPtr>>;

  /// The Jacobian by displacements.
  ::Mat stiffness();

  /// Blocks of the displacement and of all other fields.
  const Blocks& parts();

  MatrixPtr joined(const Blocks& blocks);

  Assembler* _assembler;
  std::shared_ptr<Bulk> _bulk;
  std::string _prefix;
  std::shared_ptr<petsc::Matrix> _K, _rows;
  Blocks _parts;
  // Assemblies that these are of
  int _rows_of = -1, _symmetry_of = -1, _parts_of = -1;
  bool _is_symmetric = false;
};
} // namespace contactx_dolfinx
