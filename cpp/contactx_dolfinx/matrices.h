// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "petsc.h"
#include <contactx/condense/solver/algebra.h>
#include <map>
#include <mpi.h>

/// @brief Matrices and vectors of PETSc for contactx::condense::Algebra.
namespace contactx_dolfinx::petsc
{
namespace condense = contactx::condense;
using condense::MatrixPtr;

using OwnIS = Owner<::IS, ISDestroy>;

/// Options of PETSc's database, without dash and prefix
using Options = std::map<std::string, std::string>;

/// @brief Options in PETSc's database while this lives, where the user has set
/// no others.
class Defaults
{
public:
  /// @brief Set them.
  /// @param[in] prefix Prefix of all of them.
  /// @param[in] options Names and values.
  Defaults(const std::string& prefix, const Options& options);
  ~Defaults();
  Defaults(const Defaults&) = delete;
  Defaults& operator=(const Defaults&) = delete;

private:
  std::vector<std::string> _keys;
};

/// @brief Options that make solves the same to the last bit, while vectors are
/// made: PETSc sums several products of vectors in another order where the
/// vectors happen to lie evenly spaced in memory.
Defaults reproducible();

/// @brief Whether something is so on any rank; all must take part.
bool anywhere(MPI_Comm comm, bool here);

/// @brief Number of ranks.
int num_ranks(MPI_Comm comm);

/// @brief Ranks of an object of PETSc.
template <class T>
MPI_Comm comm_of(T object)
{
  MPI_Comm comm = MPI_COMM_NULL;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(object), &comm),
        "PetscObjectGetComm");
  return comm;
}

/// @brief Number of rows of this rank.
std::size_t num_rows(::Mat A);

/// @brief Make a vector that has no values until some are placed in it.
void create_empty(MPI_Comm comm, std::size_t size, OwnVec& v);

/// @brief Values that a vector has while this lives.
class Placed
{
public:
  /// @brief Place values, which must outlive this.
  Placed(::Vec v, std::span<const double> values);
  ~Placed() { VecResetArray(_v); }
  Placed(const Placed&) = delete;
  Placed& operator=(const Placed&) = delete;

private:
  ::Vec _v;
};

/// @brief A matrix, and vectors without values for products with it.
struct Matrix final : condense::Matrix
{
  OwnMat A;            ///< the matrix
  mutable OwnVec x, y; ///< what it multiplies, and the product
};

/// @brief What PETSc has of a matrix.
::Mat of(const condense::Matrix& A);

/// @brief Vectors without values, of columns and of rows.
std::pair<::Vec, ::Vec> vectors(const condense::Matrix& given);

/// @brief Copy a matrix.
std::shared_ptr<Matrix> duplicate(::Mat A);

/// @brief A matrix that somebody else has, too.
std::shared_ptr<Matrix> share(::Mat A);

/// @brief Operations with matrices.
class Matrices : public condense::Algebra
{
public:
  /// @brief Take the ranks that all matrices are of.
  explicit Matrices(MPI_Comm comm) : _comm(comm) {}

  MatrixPtr matrix(std::size_t num_rows, std::size_t num_columns,
                   std::span<const std::int64_t> rows,
                   std::span<const std::int64_t> columns,
                   std::span<const double> values) override;
  condense::Layout layout(const condense::Matrix& A) const override;
  void multiply(const condense::Matrix& A, std::span<const double> x,
                std::span<double> y) override;
  void multiply_transposed(const condense::Matrix& A, std::span<const double> x,
                           std::span<double> y) override;
  MatrixPtr copy(const condense::Matrix& A) override
  {
    return duplicate(of(A));
  }

  void add(condense::Matrix& Y, double factor,
           const condense::Matrix& X) override;
  void scale(condense::Matrix& A, std::span<const double> left,
             std::span<const double> right) override;
  MatrixPtr product(const condense::Matrix& A,
                    const condense::Matrix& B) override;
  MatrixPtr transposed_product(const condense::Matrix& A,
                               const condense::Matrix& B) override;
  MatrixPtr projection(const condense::Matrix& A,
                       const condense::Matrix& P) override;
  MatrixPtr transpose(const condense::Matrix& A) override;
  MatrixPtr submatrix(const condense::Matrix& A,
                      std::span<const std::int64_t> rows,
                      std::span<const std::int64_t> columns) override;
  std::vector<double> diagonal(const condense::Matrix& A) override;
  void set_diagonal(condense::Matrix& A,
                    std::span<const double> values) override;
  void set_identity(condense::Matrix& A,
                    std::span<const std::int64_t> rows) override;
  double norm(const condense::Matrix& A) override;
  std::int64_t num_entries(const condense::Matrix& A) override;
  std::vector<std::int32_t> entries_of_rows(const condense::Matrix& A) override;
  std::vector<double> absolute_sums(const condense::Matrix& A) override;
  MatrixPtr join(const std::vector<std::vector<MatrixPtr>>& blocks) override;

protected:
  MPI_Comm comm() const { return _comm; }
  void make(OwnIS& set, const std::vector<PetscInt>& numbers) const;

private:
  MPI_Comm _comm;
};
} // namespace contactx_dolfinx::petsc
