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
  Defaults(const std::string& prefix, const Options& options)
  {
    for (const auto& [name, value] : options)
    {
      const std::string key = "-" + prefix + name;
      PetscBool is_set = PETSC_FALSE;
      check(PetscOptionsHasName(nullptr, nullptr, key.c_str(), &is_set),
            "PetscOptionsHasName");
      if (is_set)
        continue;
      check(PetscOptionsSetValue(nullptr, key.c_str(), value.c_str()),
            "PetscOptionsSetValue");
      _keys.push_back(key);
    }
  }
  ~Defaults()
  {
    for (const std::string& key : _keys)
      PetscOptionsClearValue(nullptr, key.c_str());
  }
  Defaults(const Defaults&) = delete;
  Defaults& operator=(const Defaults&) = delete;

private:
  std::vector<std::string> _keys;
};

/// @brief Options that make solves the same to the last bit, while vectors are
/// made: PETSc sums several products of vectors in another order where the
/// vectors happen to lie evenly spaced in memory.
inline Defaults reproducible()
{
  return {"", {{"vec_mdot_use_gemv", "false"}}};
}

/// @brief Whether something is so on any rank; all must take part.
inline bool anywhere(MPI_Comm comm, bool here)
{
  int found = here;
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_INT, MPI_MAX, comm);
  return found;
}

/// @brief Number of ranks.
inline int num_ranks(MPI_Comm comm)
{
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size;
}

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
inline std::size_t num_rows(::Mat A)
{
  PetscInt rows = 0;
  check(MatGetLocalSize(A, &rows, nullptr), "MatGetLocalSize");
  return rows;
}

/// @brief Make a vector that has no values until some are placed in it.
inline void create_empty(MPI_Comm comm, std::size_t size, OwnVec& v)
{
  const Defaults defaults = reproducible();
  const auto n = static_cast<PetscInt>(size);
  if (num_ranks(comm) == 1)
    check(VecCreateSeqWithArray(comm, 1, n, nullptr, v.put()),
          "VecCreateSeqWithArray");
  else
    check(VecCreateMPIWithArray(comm, 1, n, PETSC_DETERMINE, nullptr, v.put()),
          "VecCreateMPIWithArray");
}

/// @brief Values that a vector has while this lives.
class Placed
{
public:
  /// @brief Place values, which must outlive this.
  Placed(::Vec v, std::span<const double> values) : _v(v)
  {
    check(VecPlaceArray(v, values.data()), "VecPlaceArray");
  }
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
inline ::Mat of(const condense::Matrix& A)
{
  return static_cast<const Matrix&>(A).A.get();
}

/// @brief Vectors without values, of columns and of rows.
inline std::pair<::Vec, ::Vec> vectors(const condense::Matrix& given)
{
  const auto& [A, x, y] = static_cast<const Matrix&>(given);
  if (x.get() == nullptr)
  {
    PetscInt columns = 0;
    check(MatGetLocalSize(A.get(), nullptr, &columns), "MatGetLocalSize");
    create_empty(comm_of(A.get()), columns, x);
    create_empty(comm_of(A.get()), num_rows(A.get()), y);
  }
  return {x.get(), y.get()};
}

/// @brief Copy a matrix.
inline std::shared_ptr<Matrix> duplicate(::Mat A)
{
  auto made = std::make_shared<Matrix>();
  check(MatDuplicate(A, MAT_COPY_VALUES, made->A.put()), "MatDuplicate");
  return made;
}

/// @brief A matrix that somebody else has, too.
inline std::shared_ptr<Matrix> share(::Mat A)
{
  check(PetscObjectReference(reinterpret_cast<PetscObject>(A)),
        "PetscObjectReference");
  auto made = std::make_shared<Matrix>();
  *made->A.put() = A;
  return made;
}

/// @brief Operations with matrices.
class Matrices : public condense::Algebra
{
public:
  /// @brief Take the ranks that all matrices are of.
  explicit Matrices(MPI_Comm comm) : _comm(comm) {}

  MatrixPtr matrix(std::size_t num_rows, std::size_t num_columns,
                   std::span<const std::int64_t> rows,
                   std::span<const std::int64_t> columns,
                   std::span<const double> values) override
  {
    std::vector<PetscInt> i = integers(rows), j = integers(columns);
    auto made = std::make_shared<Matrix>();
    check(MatCreate(comm(), made->A.put()), "MatCreate");
    const ::Mat A = made->A.get();
    check(MatSetSizes(A, static_cast<PetscInt>(num_rows),
                      static_cast<PetscInt>(num_columns), PETSC_DETERMINE,
                      PETSC_DETERMINE),
          "MatSetSizes");
    check(MatSetType(A, MATAIJ), "MatSetType");
    // It leaves out negative numbers
    check(MatSetPreallocationCOO(A, static_cast<PetscCount>(i.size()), i.data(),
                                 j.data()),
          "MatSetPreallocationCOO");
    check(MatSetValuesCOO(A, values.data(), ADD_VALUES), "MatSetValuesCOO");
    return made;
  }

  condense::Layout layout(const condense::Matrix& A) const override
  {
    PetscInt rows = 0, columns = 0, row = 0, column = 0;
    check(MatGetLocalSize(of(A), &rows, &columns), "MatGetLocalSize");
    check(MatGetOwnershipRange(of(A), &row, nullptr), "MatGetOwnershipRange");
    check(MatGetOwnershipRangeColumn(of(A), &column, nullptr),
          "MatGetOwnershipRangeColumn");
    return {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns),
            row, column};
  }

  void multiply(const condense::Matrix& A, std::span<const double> x,
                std::span<double> y) override
  {
    const auto& [of_columns, of_rows] = vectors(A);
    const Placed from(of_columns, x), to(of_rows, y);
    check(MatMult(of(A), of_columns, of_rows), "MatMult");
  }

  void multiply_transposed(const condense::Matrix& A, std::span<const double> x,
                           std::span<double> y) override
  {
    const auto& [of_columns, of_rows] = vectors(A);
    const Placed from(of_rows, x), to(of_columns, y);
    check(MatMultTranspose(of(A), of_rows, of_columns), "MatMultTranspose");
  }

  MatrixPtr copy(const condense::Matrix& A) override
  {
    return duplicate(of(A));
  }

  void add(condense::Matrix& Y, double factor,
           const condense::Matrix& X) override
  {
    check(MatAXPY(of(Y), factor, of(X), DIFFERENT_NONZERO_PATTERN), "MatAXPY");
  }

  void scale(condense::Matrix& A, std::span<const double> left,
             std::span<const double> right) override
  {
    const auto& [of_columns, of_rows] = vectors(A);
    const Placed l(of_rows, left), r(of_columns, right);
    check(MatDiagonalScale(of(A), of_rows, of_columns), "MatDiagonalScale");
  }

  MatrixPtr product(const condense::Matrix& A,
                    const condense::Matrix& B) override
  {
    return made("MatMatMult", MatMatMult, of(A), of(B), MAT_INITIAL_MATRIX,
                PETSC_DETERMINE);
  }

  MatrixPtr transposed_product(const condense::Matrix& A,
                               const condense::Matrix& B) override
  {
    return made("MatTransposeMatMult", MatTransposeMatMult, of(A), of(B),
                MAT_INITIAL_MATRIX, PETSC_DETERMINE);
  }

  MatrixPtr projection(const condense::Matrix& A,
                       const condense::Matrix& P) override
  {
    return made("MatPtAP", MatPtAP, of(A), of(P), MAT_INITIAL_MATRIX,
                PETSC_DETERMINE);
  }

  MatrixPtr transpose(const condense::Matrix& A) override
  {
    return made("MatTranspose", MatTranspose, of(A), MAT_INITIAL_MATRIX);
  }

  MatrixPtr submatrix(const condense::Matrix& A,
                      std::span<const std::int64_t> rows,
                      std::span<const std::int64_t> columns) override
  {
    OwnIS of_rows, of_columns;
    make(of_rows, integers(rows));
    make(of_columns, integers(columns));
    return made("MatCreateSubMatrix", MatCreateSubMatrix, of(A), of_rows.get(),
                of_columns.get(), MAT_INITIAL_MATRIX);
  }

  std::vector<double> diagonal(const condense::Matrix& A) override
  {
    std::vector<double> values(layout(A).num_rows);
    const ::Vec v = vectors(A).second;
    const Placed placed(v, values);
    check(MatGetDiagonal(of(A), v), "MatGetDiagonal");
    return values;
  }

  void set_diagonal(condense::Matrix& A,
                    std::span<const double> values) override
  {
    const ::Vec v = vectors(A).second;
    const Placed placed(v, values);
    check(MatDiagonalSet(of(A), v, INSERT_VALUES), "MatDiagonalSet");
  }

  void set_identity(condense::Matrix& A,
                    std::span<const std::int64_t> rows) override
  {
    const std::vector<PetscInt> numbers = integers(rows);
    check(MatZeroRowsColumns(of(A), static_cast<PetscInt>(numbers.size()),
                             numbers.data(), 1, nullptr, nullptr),
          "MatZeroRowsColumns");
  }

  double norm(const condense::Matrix& A) override
  {
    PetscReal norm = 0;
    check(MatNorm(of(A), NORM_FROBENIUS, &norm), "MatNorm");
    return norm;
  }

  std::int64_t num_entries(const condense::Matrix& A) override
  {
    MatInfo info;
    check(MatGetInfo(of(A), MAT_GLOBAL_SUM, &info), "MatGetInfo");
    return static_cast<std::int64_t>(info.nz_used);
  }

  std::vector<std::int32_t> entries_of_rows(const condense::Matrix& A) override
  {
    std::vector<std::int32_t> counts;
    for_each_row(of(A), [&](std::span<const double> values)
                 { counts.push_back(static_cast<int>(values.size())); });
    return counts;
  }

  std::vector<double> absolute_sums(const condense::Matrix& A) override
  {
    std::vector<double> sums;
    for_each_row(of(A),
                 [&](std::span<const double> values)
                 {
                   double& sum = sums.emplace_back(0);
                   for (const double value : values)
                     sum += std::abs(value);
                 });
    return sums;
  }

  MatrixPtr join(const std::vector<std::vector<MatrixPtr>>& blocks) override
  {
    std::vector<::Mat> matrices;
    for (const auto& row : blocks)
      for (const MatrixPtr& block : row)
        matrices.push_back(block ? of(*block) : nullptr);
    OwnMat nest;
    check(MatCreateNest(comm(), static_cast<PetscInt>(blocks.size()), nullptr,
                        static_cast<PetscInt>(blocks.front().size()), nullptr,
                        matrices.data(), nest.put()),
          "MatCreateNest");
    return made("MatConvert", MatConvert, nest.get(), MATAIJ,
                MAT_INITIAL_MATRIX);
  }

protected:
  MPI_Comm comm() const { return _comm; }

  void make(OwnIS& set, const std::vector<PetscInt>& numbers) const
  {
    check(ISCreateGeneral(comm(), static_cast<PetscInt>(numbers.size()),
                          numbers.data(), PETSC_COPY_VALUES, set.put()),
          "ISCreateGeneral");
  }

private:
  static std::vector<PetscInt> integers(std::span<const std::int64_t> numbers)
  {
    return {numbers.begin(), numbers.end()};
  }

  /// The matrix that a function of PETSc makes, its last argument.
  template <class Function, class... Given>
  static MatrixPtr made(const char* name, Function function, Given... given)
  {
    auto matrix = std::make_shared<Matrix>();
    check(function(given..., matrix->A.put()), name);
    return matrix;
  }

  template <class Use>
  static void for_each_row(::Mat A, Use&& use)
  {
    PetscInt first = 0, last = 0;
    check(MatGetOwnershipRange(A, &first, &last), "MatGetOwnershipRange");
    for (PetscInt row = first; row < last; ++row)
    {
      PetscInt count = 0;
      const PetscScalar* values = nullptr;
      check(MatGetRow(A, row, &count, nullptr, &values), "MatGetRow");
      use(std::span(values, static_cast<std::size_t>(count)));
      check(MatRestoreRow(A, row, &count, nullptr, &values), "MatRestoreRow");
    }
  }

  MPI_Comm _comm;
};
} // namespace contactx_dolfinx::petsc
