// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "matrices.h"
#include <cmath>

namespace contactx_dolfinx::petsc
{
namespace
{
std::vector<PetscInt> integers(std::span<const std::int64_t> numbers)
{
  return {numbers.begin(), numbers.end()};
}

/// The matrix that a function of PETSc makes, its last argument.
template <class Function, class... Given>
MatrixPtr made(const char* name, Function function, Given... given)
{
  auto matrix = std::make_shared<Matrix>();
  check(function(given..., matrix->A.put()), name);
  return matrix;
}

template <class Use>
void for_each_row(::Mat A, Use&& use)
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
} // namespace

Defaults::Defaults(const std::string& prefix, const Options& options)
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

Defaults::~Defaults()
{
  for (const std::string& key : _keys)
    PetscOptionsClearValue(nullptr, key.c_str());
}

Defaults reproducible() { return {"", {{"vec_mdot_use_gemv", "false"}}}; }

bool anywhere(MPI_Comm comm, bool here)
{
  int found = here;
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_INT, MPI_MAX, comm);
  return found;
}

int num_ranks(MPI_Comm comm)
{
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size;
}

std::size_t num_rows(::Mat A)
{
  PetscInt rows = 0;
  check(MatGetLocalSize(A, &rows, nullptr), "MatGetLocalSize");
  return rows;
}

void create_empty(MPI_Comm comm, std::size_t size, OwnVec& v)
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

Placed::Placed(::Vec v, std::span<const double> values) : _v(v)
{
  check(VecPlaceArray(v, values.data()), "VecPlaceArray");
}

::Mat of(const condense::Matrix& A)
{
  return static_cast<const Matrix&>(A).A.get();
}

std::pair<::Vec, ::Vec> vectors(const condense::Matrix& given)
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

std::shared_ptr<Matrix> duplicate(::Mat A)
{
  auto made = std::make_shared<Matrix>();
  check(MatDuplicate(A, MAT_COPY_VALUES, made->A.put()), "MatDuplicate");
  return made;
}

std::shared_ptr<Matrix> share(::Mat A)
{
  check(PetscObjectReference(reinterpret_cast<PetscObject>(A)),
        "PetscObjectReference");
  auto made = std::make_shared<Matrix>();
  *made->A.put() = A;
  return made;
}

MatrixPtr Matrices::matrix(std::size_t num_rows, std::size_t num_columns,
                           std::span<const std::int64_t> rows,
                           std::span<const std::int64_t> columns,
                           std::span<const double> values)
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

condense::Layout Matrices::layout(const condense::Matrix& A) const
{
  PetscInt rows = 0, columns = 0, row = 0, column = 0;
  check(MatGetLocalSize(of(A), &rows, &columns), "MatGetLocalSize");
  check(MatGetOwnershipRange(of(A), &row, nullptr), "MatGetOwnershipRange");
  check(MatGetOwnershipRangeColumn(of(A), &column, nullptr),
        "MatGetOwnershipRangeColumn");
  return {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns),
          row, column};
}

void Matrices::multiply(const condense::Matrix& A, std::span<const double> x,
                        std::span<double> y)
{
  const auto& [of_columns, of_rows] = vectors(A);
  const Placed from(of_columns, x), to(of_rows, y);
  check(MatMult(of(A), of_columns, of_rows), "MatMult");
}

void Matrices::multiply_transposed(const condense::Matrix& A,
                                   std::span<const double> x,
                                   std::span<double> y)
{
  const auto& [of_columns, of_rows] = vectors(A);
  const Placed from(of_rows, x), to(of_columns, y);
  check(MatMultTranspose(of(A), of_rows, of_columns), "MatMultTranspose");
}
void Matrices::add(condense::Matrix& Y, double factor,
                   const condense::Matrix& X)
{
  check(MatAXPY(of(Y), factor, of(X), DIFFERENT_NONZERO_PATTERN), "MatAXPY");
}

void Matrices::scale(condense::Matrix& A, std::span<const double> left,
                     std::span<const double> right)
{
  const auto& [of_columns, of_rows] = vectors(A);
  const Placed l(of_rows, left), r(of_columns, right);
  check(MatDiagonalScale(of(A), of_rows, of_columns), "MatDiagonalScale");
}

MatrixPtr Matrices::product(const condense::Matrix& A,
                            const condense::Matrix& B)
{
  return made("MatMatMult", MatMatMult, of(A), of(B), MAT_INITIAL_MATRIX,
              PETSC_DETERMINE);
}

MatrixPtr Matrices::transposed_product(const condense::Matrix& A,
                                       const condense::Matrix& B)
{
  return made("MatTransposeMatMult", MatTransposeMatMult, of(A), of(B),
              MAT_INITIAL_MATRIX, PETSC_DETERMINE);
}

MatrixPtr Matrices::projection(const condense::Matrix& A,
                               const condense::Matrix& P)
{
  return made("MatPtAP", MatPtAP, of(A), of(P), MAT_INITIAL_MATRIX,
              PETSC_DETERMINE);
}

MatrixPtr Matrices::transpose(const condense::Matrix& A)
{
  return made("MatTranspose", MatTranspose, of(A), MAT_INITIAL_MATRIX);
}

MatrixPtr Matrices::submatrix(const condense::Matrix& A,
                              std::span<const std::int64_t> rows,
                              std::span<const std::int64_t> columns)
{
  OwnIS of_rows, of_columns;
  make(of_rows, integers(rows));
  make(of_columns, integers(columns));
  return made("MatCreateSubMatrix", MatCreateSubMatrix, of(A), of_rows.get(),
              of_columns.get(), MAT_INITIAL_MATRIX);
}

std::vector<double> Matrices::diagonal(const condense::Matrix& A)
{
  std::vector<double> values(layout(A).num_rows);
  const ::Vec v = vectors(A).second;
  const Placed placed(v, values);
  check(MatGetDiagonal(of(A), v), "MatGetDiagonal");
  return values;
}

void Matrices::set_diagonal(condense::Matrix& A, std::span<const double> values)
{
  const ::Vec v = vectors(A).second;
  const Placed placed(v, values);
  check(MatDiagonalSet(of(A), v, INSERT_VALUES), "MatDiagonalSet");
}

void Matrices::set_identity(condense::Matrix& A,
                            std::span<const std::int64_t> rows)
{
  const std::vector<PetscInt> numbers = integers(rows);
  check(MatZeroRowsColumns(of(A), static_cast<PetscInt>(numbers.size()),
                           numbers.data(), 1, nullptr, nullptr),
        "MatZeroRowsColumns");
}

double Matrices::norm(const condense::Matrix& A)
{
  PetscReal norm = 0;
  check(MatNorm(of(A), NORM_FROBENIUS, &norm), "MatNorm");
  return norm;
}

std::int64_t Matrices::num_entries(const condense::Matrix& A)
{
  MatInfo info;
  check(MatGetInfo(of(A), MAT_GLOBAL_SUM, &info), "MatGetInfo");
  return static_cast<std::int64_t>(info.nz_used);
}

std::vector<std::int32_t> Matrices::entries_of_rows(const condense::Matrix& A)
{
  std::vector<std::int32_t> counts;
  for_each_row(of(A), [&](std::span<const double> values)
               { counts.push_back(static_cast<int>(values.size())); });
  return counts;
}

std::vector<double> Matrices::absolute_sums(const condense::Matrix& A)
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

MatrixPtr Matrices::join(const std::vector<std::vector<MatrixPtr>>& blocks)
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
  return made("MatConvert", MatConvert, nest.get(), MATAIJ, MAT_INITIAL_MATRIX);
}

void Matrices::make(OwnIS& set, const std::vector<PetscInt>& numbers) const
{
  check(ISCreateGeneral(comm(), static_cast<PetscInt>(numbers.size()),
                        numbers.data(), PETSC_COPY_VALUES, set.put()),
        "ISCreateGeneral");
}
} // namespace contactx_dolfinx::petsc
