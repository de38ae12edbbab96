// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// @brief Sparse linear algebra that the condensed solver needs of whoever has
/// the bulk: matrices, factors, multigrid and Krylov methods of its library.
///
/// Rows and columns of a matrix are distributed: each rank has some successive
/// rows, and the entries of vectors that belong to them. Vectors are arrays of
/// what this rank has. All ranks must take part in all of it.
namespace contactx::condense
{
/// @brief A sparse matrix of the host's library.
class Matrix
{
public:
  virtual ~Matrix() = default;
};

/// @brief A matrix that objects share.
using MatrixPtr = std::shared_ptr<Matrix>;

/// @brief A function y = f(x) of vectors of this rank.
using Apply
    = std::function<void(std::span<const double> x, std::span<double> y)>;

/// @brief What this rank has of a matrix.
struct Layout
{
  std::size_t num_rows = 0;      ///< number of its rows
  std::size_t num_columns = 0;   ///< entries of vectors that it multiplies
  std::int64_t first_row = 0;    ///< number of its first row
  std::int64_t first_column = 0; ///< number of the first of these entries
};

/// @brief How iterations ended.
struct Iterations
{
  /// Ends of iterations
  enum class End : std::int8_t
  {
    converged,
    indefinite, ///< CG has met a direction of no or negative energy
    failed
  };

  int count = 0;            ///< number of iterations
  End end = End::converged; ///< why they ended

  /// @brief Whether the residual fell below what was asked for.
  bool converged() const { return end == End::converged; }
};

/// @brief Factors of a matrix.
class Factors
{
public:
  virtual ~Factors() = default;

  /// @brief Whether the matrix could be factorised; the same on all ranks.
  virtual bool is_good() const = 0;

  /// @brief Solve A x = b.
  /// @param[in] b Right-hand side.
  /// @param[out] x Solution; not finite where the matrix is singular.
  /// @param[in] transposed Whether with A^T.
  virtual void solve(std::span<const double> b, std::span<double> x,
                     bool transposed = false) = 0;
};

/// Krylov vectors of GMRES with multigrid before a restart, made as they are
/// needed: each multiplier that stays an unknown is an eigenvalue of its own
inline constexpr int gmres_restart = 100;

/// @brief A multigrid hierarchy of a matrix, and Krylov methods that it
/// preconditions, of a matrix that is given as a product.
class Hierarchy
{
public:
  virtual ~Hierarchy() = default;

  /// @brief Prolongations: to the finest level, to the next coarser one, and so
  /// on; none where one level is all.
  virtual const std::vector<MatrixPtr>& prolongations() const = 0;

  /// @brief Matrices of the coarser levels, in the same order. They may be
  /// added to; `update` must follow.
  virtual const std::vector<MatrixPtr>& matrices() const = 0;

  /// @brief Set the diagonal that the finest level's smoother divides by.
  /// @param[in] diagonal The diagonal (shape=(num_rows)).
  virtual void set_diagonal(std::span<const double> diagonal) = 0;

  /// @brief Take over what `matrices` are now.
  virtual void update() = 0;

  /// @brief Apply one cycle, x = M b.
  virtual void cycle(std::span<const double> b, std::span<double> x) = 0;

  /// @brief Solve A x = b.
  /// @param[in] b Right-hand side.
  /// @param[in,out] x Start of the iterations, then what they have found.
  /// @param[in] is_symmetric Whether by CG; else by GMRES, preconditioned from
  /// the right.
  /// @param[in] target What the norm of the residual must fall below; a
  /// relative residual of `math::round_off` does, too.
  /// @param[in] most Most iterations.
  virtual Iterations solve(std::span<const double> b, std::span<double> x,
                           bool is_symmetric, double target, int most) = 0;
};

/// @brief Flexible GMRES with a preconditioner of one's own, from the right.
class FlexibleGMRES
{
public:
  /// @brief Says how iterations go on, by their number and the norm of the
  /// residual: nothing to iterate, else the end.
  using Test
      = std::function<std::optional<Iterations::End>(int count, double norm)>;

  virtual ~FlexibleGMRES() = default;

  /// @brief Solve A x = b.
  /// @param[in] b Right-hand side.
  /// @param[in,out] x Start of the iterations, then what they have found.
  /// @param[in] test Called once an iteration.
  /// @param[in] most Most iterations.
  virtual Iterations solve(std::span<const double> b, std::span<double> x,
                           const Test& test, int most) = 0;
};

/// @brief Stiffness that is added to the diagonal of a rank's displacements
/// (shape=(num_displacements)), on all ranks or on none. A rank without
/// displacements has an empty one then.
using Springs = std::optional<std::vector<double>>;

/// @brief GMRES with the factors of an older matrix of all unknowns.
class DirectSolver
{
public:
  virtual ~DirectSolver() = default;

  /// @brief Assemble the Jacobian of now, which later solves are with.
  /// @param[in] springs What holds free bodies.
  virtual void assemble(const Springs& springs) = 0;

  /// @brief Factorise it.
  /// @return Whether it has factors.
  virtual bool factorise() = 0;

  /// @brief Solve with it, preconditioned by the last factors.
  /// @param[in] b Right-hand side (shape=(size)).
  /// @param[out] x Solution, from zero.
  /// @param[in] target What the norm of the residual must fall below.
  /// @param[in] most Most iterations.
  virtual Iterations solve(std::span<const double> b, std::span<double> x,
                           double target, int most) = 0;

  /// @brief Drop matrix and factors.
  virtual void reset() = 0;
};

/// @brief Which factors are wanted.
struct FactorOptions
{
  /// Name of what is factorised, of which the host makes a prefix of options
  std::string_view name;
  bool is_symmetric = false; ///< whether the matrix is symmetric
  /// Number of successive unknowns that are coupled to the same others
  int group = 1;
  /// Whether iterations correct them: single precision will do. Else they are
  /// exact, and each rank has those of all of a matrix that is small.
  bool is_rough = true;
};

/// @brief A coarse space of a matrix by smoothed aggregation.
struct Aggregates
{
  MatrixPtr prolongation; ///< P
  MatrixPtr stiffness;    ///< P^T A P
};

/// @brief Blocks of the bulk's Jacobian that concern other fields.
struct FieldBlocks
{
  MatrixPtr uf; ///< rows of displacements by fields
  MatrixPtr fu; ///< rows of fields by displacements
  MatrixPtr ff; ///< rows of fields by fields
};

/// @brief The operations, and the bulk's matrix.
class Algebra
{
public:
  virtual ~Algebra() = default;

  /// @brief Assemble the bulk's Jacobian if the state is another than that of
  /// the last one. It is meant by displacements, of which its rows are those
  /// that this rank owns, with unit rows and columns at prescribed ones.
  virtual void update_bulk() = 0;

  /// @brief How often the bulk's Jacobian was assembled so far.
  virtual int assemblies() const = 0;

  /// @brief Whether the bulk's Jacobian is symmetric.
  virtual bool is_symmetric() = 0;

  /// @brief The bulk's Jacobian, for products and its diagonal alone.
  virtual MatrixPtr bulk() = 0;

  /// @brief A copy of it that all operations take.
  virtual MatrixPtr bulk_copy() = 0;

  /// @brief The bulk's Jacobian for `hierarchy`, which takes its entries: a
  /// copy, or itself where the host has no more need of all of them.
  virtual MatrixPtr lent_bulk() { return bulk_copy(); }

  /// @brief Some of its rows, for nobody to change.
  /// @param[in] dofs Which owned ones, in order; the same ones every time.
  virtual MatrixPtr bulk_rows(std::span<const std::int32_t> dofs) = 0;

  /// @brief What of it concerns other fields, for nobody to change; asked for
  /// where there are such.
  virtual FieldBlocks field_blocks() = 0;

  /// @brief 1 at owned displacements that are prescribed, else 0.
  virtual std::span<const std::int8_t> prescribed() = 0;

  /// @brief Make a matrix. Entries of one place are added, over all ranks;
  /// those of negative rows or columns are left out.
  /// @param[in] num_rows Number of rows of this rank.
  /// @param[in] num_columns Number of columns that belong to it.
  /// @param[in] rows Rows of the entries, over all ranks.
  /// @param[in] columns Columns.
  /// @param[in] values Values.
  virtual MatrixPtr matrix(std::size_t num_rows, std::size_t num_columns,
                           std::span<const std::int64_t> rows,
                           std::span<const std::int64_t> columns,
                           std::span<const double> values) = 0;

  /// @brief What this rank has of a matrix.
  virtual Layout layout(const Matrix& A) const = 0;

  /// @brief Multiply, y = A x.
  virtual void multiply(const Matrix& A, std::span<const double> x,
                        std::span<double> y) = 0;

  /// @brief Multiply, y = A^T x.
  virtual void multiply_transposed(const Matrix& A, std::span<const double> x,
                                   std::span<double> y) = 0;

  /// @brief Copy a matrix.
  virtual MatrixPtr copy(const Matrix& A) = 0;

  /// @brief Add, Y += factor X, whatever places X has entries in.
  virtual void add(Matrix& Y, double factor, const Matrix& X) = 0;

  /// @brief Scale rows and columns, A = diag(left) A diag(right).
  virtual void scale(Matrix& A, std::span<const double> left,
                     std::span<const double> right) = 0;

  /// @brief Product A B.
  virtual MatrixPtr product(const Matrix& A, const Matrix& B) = 0;

  /// @brief Product A^T B.
  virtual MatrixPtr transposed_product(const Matrix& A, const Matrix& B) = 0;

  /// @brief Product P^T A P.
  virtual MatrixPtr projection(const Matrix& A, const Matrix& P) = 0;

  /// @brief The transpose.
  virtual MatrixPtr transpose(const Matrix& A) = 0;

  /// @brief Some rows and columns.
  /// @param[in] A The matrix.
  /// @param[in] rows Numbers of rows that this rank owns.
  /// @param[in] columns Numbers of columns that belong to it.
  virtual MatrixPtr submatrix(const Matrix& A,
                              std::span<const std::int64_t> rows,
                              std::span<const std::int64_t> columns) = 0;

  /// @brief The diagonal (shape=(num_rows)).
  virtual std::vector<double> diagonal(const Matrix& A) = 0;

  /// @brief Set the diagonal, all of which has places.
  virtual void set_diagonal(Matrix& A, std::span<const double> values) = 0;

  /// @brief Make some rows and columns those of the identity.
  /// @param[in] A The matrix, square.
  /// @param[in] rows Their numbers, of this rank.
  virtual void set_identity(Matrix& A, std::span<const std::int64_t> rows) = 0;

  /// @brief Frobenius norm over all ranks.
  virtual double norm(const Matrix& A) = 0;

  /// @brief Number of entries on all ranks.
  virtual std::int64_t num_entries(const Matrix& A) = 0;

  /// @brief Number of entries of each row of this rank.
  virtual std::vector<std::int32_t> entries_of_rows(const Matrix& A) = 0;

  /// @brief Sum of the absolute values of each row of this rank.
  virtual std::vector<double> absolute_sums(const Matrix& A) = 0;

  /// @brief Join blocks to one matrix; each rank's rows are those of the first
  /// row of blocks, then those of the next one. Null blocks are zero.
  /// @param[in] blocks Rows of blocks, as many in each.
  virtual MatrixPtr join(const std::vector<std::vector<MatrixPtr>>& blocks) = 0;

  /// @brief Factorise a matrix, whose entries are gone then.
  virtual std::unique_ptr<Factors> factorise(MatrixPtr A,
                                             const FactorOptions& options) = 0;

  /// @brief Make a multigrid hierarchy.
  /// @param[in] A Matrix whose aggregates and products it has; its entries are
  /// gone then.
  /// @param[in] near_null_space Vectors that A all but maps to zero.
  /// @param[in] block_size Successive unknowns that are aggregated together.
  /// @param[in] multiply The matrix that is solved with.
  virtual std::unique_ptr<Hierarchy>
  hierarchy(MatrixPtr A,
            const std::vector<std::vector<double>>& near_null_space,
            int block_size, Apply multiply) = 0;

  /// @brief Make a coarse space.
  /// @param[in] A The matrix, square.
  /// @param[in] near_null_space Vectors that A all but maps to zero.
  /// @param[in] block_size Successive unknowns that are aggregated together.
  /// @return Nothing where there are too few unknowns to aggregate.
  virtual std::optional<Aggregates>
  aggregate(MatrixPtr A,
            const std::vector<std::vector<double>>& near_null_space,
            int block_size) = 0;

  /// @brief Make a flexible GMRES.
  /// @param[in] size Number of unknowns of this rank.
  /// @param[in] multiply The matrix.
  /// @param[in] precondition What is near its inverse.
  /// @param[in] restart Vectors that are kept at most.
  virtual std::unique_ptr<FlexibleGMRES> flexible_gmres(std::size_t size,
                                                        Apply multiply,
                                                        Apply precondition,
                                                        int restart) = 0;

  /// @brief Make a solver of the system of all unknowns.
  virtual std::unique_ptr<DirectSolver> direct_solver() = 0;

  /// @brief Which preconditioner the host's options ask for: empty for none in
  /// particular.
  virtual std::string preconditioner() const { return {}; }

  /// Wall seconds of parts of the work by their names: "condensation",
  /// "hierarchy", "Krylov", "Jacobian", "old factors" and "factorisation"
  std::map<std::string, double> seconds;
};

/// @brief Times a part of the work while it exists.
class Timing
{
public:
  Timing(Algebra& algebra, const char* name) : _seconds(algebra.seconds[name])
  {
  }
  ~Timing()
  {
    const std::chrono::duration<double> passed = Clock::now() - _start;
    _seconds += passed.count();
  }
  Timing(const Timing&) = delete;
  Timing& operator=(const Timing&) = delete;

private:
  using Clock = std::chrono::steady_clock;
  double& _seconds;
  Clock::time_point _start = Clock::now();
};
} // namespace contactx::condense
