// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "stepped_bodies.h"
#include <contactx/condense/solver/algebra.h>

namespace contactx::tests
{
/// Dense algebra of one rank, and the stiffness of bodies of springs. What it
/// was asked for is counted.
class DenseAlgebra final : public condense::Algebra
{
public:
  using Dense = Eigen::MatrixXd;
  using MatrixPtr = condense::MatrixPtr;
  using Iterations = condense::Iterations;
  using Span = std::span<const double>;

  explicit DenseAlgebra(Stepped& bodies) : _bodies(bodies) {}

  /// What solves were asked for
  std::vector<double> targets;
  /// Factors by their names, and hierarchies
  std::map<std::string, int> factorised;
  int hierarchies = 0;
  /// Whether multigrid and bodies converge
  bool multigrid_converges = true, bodies_converge = true;
  std::string asked; ///< what options ask for
  /// Rows of other fields by displacements, the transpose of forces by fields,
  /// and by themselves
  Dense of_fields, by_fields;

  struct Held final : condense::Matrix
  {
    explicit Held(Dense A) : A(std::move(A)) {}
    Dense A;
  };
  static Dense& of(const condense::Matrix& A)
  {
    return const_cast<Dense&>(static_cast<const Held&>(A).A);
  }
  static MatrixPtr hold(Dense A)
  {
    return std::make_shared<Held>(std::move(A));
  }

  static Dense dense_of(const condense::Apply& multiply, std::size_t n)
  {
    Dense A(n, n);
    std::vector<double> unit(n, 0), column(n);
    for (std::size_t j = 0; j < n; ++j)
    {
      unit[j] = 1;
      multiply(unit, column);
      unit[j] = 0;
      A.col(j) = math::column(column);
    }
    return A;
  }

  void update_bulk() override { _K = unit_rows(); }
  int assemblies() const override { return 0; }
  bool is_symmetric() override { return true; }
  MatrixPtr bulk() override { return hold(_K); }
  MatrixPtr bulk_copy() override { return hold(_K); }
  MatrixPtr bulk_rows(std::span<const std::int32_t> dofs) override
  {
    Dense rows(dofs.size(), _K.cols());
    for (std::size_t i = 0; i < dofs.size(); ++i)
      rows.row(i) = _K.row(dofs[i]);
    return hold(rows);
  }
  condense::FieldBlocks field_blocks() override
  {
    return {hold(of_fields.transpose()), hold(of_fields), hold(by_fields)};
  }
  std::span<const std::int8_t> prescribed() override
  {
    return _bodies.bulk->markers();
  }
  MatrixPtr matrix(std::size_t num_rows, std::size_t num_columns,
                   std::span<const std::int64_t> rows,
                   std::span<const std::int64_t> columns, Span values) override
  {
    Dense A = Dense::Zero(num_rows, num_columns);
    for (std::size_t e = 0; e < values.size(); ++e)
      if (rows[e] >= 0 and columns[e] >= 0)
        A(rows[e], columns[e]) += values[e];
    return hold(A);
  }
  condense::Layout layout(const condense::Matrix& A) const override
  {
    return {std::size_t(of(A).rows()), std::size_t(of(A).cols()), 0, 0};
  }
  void multiply(const condense::Matrix& A, Span x, std::span<double> y) override
  {
    std::ranges::copy(tests::product(of(A), x), y.begin());
  }
  void multiply_transposed(const condense::Matrix& A, Span x,
                           std::span<double> y) override
  {
    std::ranges::copy(tests::product(of(A).transpose(), x), y.begin());
  }
  MatrixPtr copy(const condense::Matrix& A) override { return hold(of(A)); }
  void add(condense::Matrix& Y, double factor,
           const condense::Matrix& X) override
  {
    of(Y) += factor * of(X);
  }
  void scale(condense::Matrix& A, Span left, Span right) override
  {
    of(A) = math::column(left).asDiagonal() * of(A)
            * math::column(right).asDiagonal();
  }
  MatrixPtr product(const condense::Matrix& A,
                    const condense::Matrix& B) override
  {
    return hold(of(A) * of(B));
  }
  MatrixPtr transposed_product(const condense::Matrix& A,
                               const condense::Matrix& B) override
  {
    return hold(of(A).transpose() * of(B));
  }
  MatrixPtr projection(const condense::Matrix& A,
                       const condense::Matrix& P) override
  {
    return hold(of(P).transpose() * of(A) * of(P));
  }
  MatrixPtr transpose(const condense::Matrix& A) override
  {
    return hold(of(A).transpose());
  }
  MatrixPtr submatrix(const condense::Matrix& A,
                      std::span<const std::int64_t> rows,
                      std::span<const std::int64_t> columns) override
  {
    Dense part(rows.size(), columns.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j)
        part(i, j) = of(A)(rows[i], columns[j]);
    return hold(part);
  }
  std::vector<double> diagonal(const condense::Matrix& A) override
  {
    const Eigen::VectorXd d = of(A).diagonal();
    return {d.begin(), d.end()};
  }
  void set_diagonal(condense::Matrix& A, Span values) override
  {
    of(A).diagonal() = math::column(values);
  }
  void set_identity(condense::Matrix& A,
                    std::span<const std::int64_t> rows) override
  {
    for (const std::int64_t i : rows)
    {
      of(A).row(i).setZero();
      of(A).col(i).setZero();
      of(A)(i, i) = 1;
    }
  }
  double norm(const condense::Matrix& A) override { return of(A).norm(); }
  std::int64_t num_entries(const condense::Matrix& A) override
  {
    return (of(A).array() != 0).count();
  }
  std::vector<std::int32_t> entries_of_rows(const condense::Matrix& A) override
  {
    std::vector<std::int32_t> counts;
    for (Eigen::Index i = 0; i < of(A).rows(); ++i)
      counts.push_back(int((of(A).row(i).array() != 0).count()));
    return counts;
  }
  std::vector<double> absolute_sums(const condense::Matrix& A) override
  {
    const Eigen::VectorXd sums = of(A).cwiseAbs().rowwise().sum();
    return {sums.begin(), sums.end()};
  }
  MatrixPtr join(const std::vector<std::vector<MatrixPtr>>& blocks) override
  {
    std::vector<Eigen::Index> rows, columns(blocks.front().size());
    for (const auto& row : blocks)
      for (std::size_t j = 0; j < row.size(); ++j)
        if (row[j])
          columns[j] = of(*row[j]).cols();
    for (const auto& row : blocks)
      rows.push_back(of(**std::ranges::find_if(row, [](const auto& A)
                                               { return A != nullptr; }))
                         .rows());
    Dense all = Dense::Zero(std::reduce(rows.begin(), rows.end()),
                            std::reduce(columns.begin(), columns.end()));
    for (std::size_t i = 0, r = 0; i < blocks.size(); r += rows[i++])
      for (std::size_t j = 0, c = 0; j < columns.size(); c += columns[j++])
        if (blocks[i][j])
          all.block(r, c, rows[i], columns[j]) = of(*blocks[i][j]);
    return hold(all);
  }
  std::unique_ptr<condense::Factors>
  factorise(MatrixPtr A, const condense::FactorOptions& options) override
  {
    ++factorised[std::string(options.name)];
    return std::make_unique<LU>(of(*A));
  }
  std::unique_ptr<condense::Hierarchy>
  hierarchy(MatrixPtr A,
            const std::vector<std::vector<double>>& near_null_space, int,
            condense::Apply multiply) override
  {
    ++hierarchies;
    EXPECT_EQ(std::ssize(near_null_space), _bodies.bulk->gdim() == 2 ? 3 : 6);
    return std::make_unique<TwoLevels>(*this, of(*A), std::move(multiply));
  }
  std::optional<condense::Aggregates>
  aggregate(MatrixPtr A, const std::vector<std::vector<double>>& modes,
            int) override
  {
    Dense P(of(*A).rows(), modes.size());
    for (std::size_t j = 0; j < modes.size(); ++j)
      P.col(j) = math::column(modes[j]);
    return condense::Aggregates{hold(P), hold(P.transpose() * of(*A) * P)};
  }
  std::unique_ptr<condense::FlexibleGMRES>
  flexible_gmres(std::size_t size, condense::Apply multiply,
                 condense::Apply precondition, int) override
  {
    return std::make_unique<Richardson>(*this, size, std::move(multiply),
                                        std::move(precondition));
  }
  std::unique_ptr<condense::DirectSolver> direct_solver() override
  {
    return std::make_unique<Direct>(*this);
  }
  std::string preconditioner() const override { return asked; }

private:
  class LU final : public condense::Factors
  {
  public:
    explicit LU(const Dense& A) : _A(A), _lu(A) {}
    bool is_good() const override { return _lu.isInvertible(); }
    void solve(Span b, std::span<double> x, bool transposed) override
    {
      Eigen::VectorXd::Map(x.data(), _A.rows())
          = transposed ? Eigen::VectorXd(_lu.transpose().solve(math::column(b)))
                       : Eigen::VectorXd(_lu.solve(math::column(b)));
    }

  private:
    Dense _A;
    Eigen::FullPivLU<Dense> _lu;
  };

  /// A hierarchy whose coarser matrix is tested before each solve; solves are
  /// exact.
  class TwoLevels final : public condense::Hierarchy
  {
  public:
    TwoLevels(DenseAlgebra& algebra, const Dense& A, condense::Apply multiply)
        : _algebra(algebra), _multiply(std::move(multiply))
    {
      std::srand(7);
      const Dense Q = Dense::Random(A.rows(), 5);
      _prolongations = {hold(Q)};
      _matrices = {hold(Q.transpose() * A * Q)};
    }
    const std::vector<MatrixPtr>& prolongations() const override
    {
      return _prolongations;
    }
    const std::vector<MatrixPtr>& matrices() const override
    {
      return _matrices;
    }
    void set_diagonal(Span diagonal) override
    {
      _diagonal.assign(diagonal.begin(), diagonal.end());
    }
    void update() override { _is_updated = true; }
    void cycle(Span b, std::span<double> x) override
    {
      std::ranges::copy(solution(dense_of(_multiply, b.size()), b), x.begin());
    }
    Iterations solve(Span b, std::span<double> x, bool is_symmetric,
                     double target, int) override
    {
      _algebra.targets.push_back(target);
      const Dense A = dense_of(_multiply, b.size());
      if (is_symmetric)
        expect_galerkin(A);
      if (not _algebra.multigrid_converges)
        return {1, Iterations::End::failed};
      std::ranges::copy(solution(A, b), x.begin());
      return {1, Iterations::End::converged};
    }

  private:
    /// Coarser matrices are Galerkin products of the condensed matrix without
    /// what stands for eliminated displacements, and no eigenvalue is larger
    /// than those of the diagonal allow.
    void expect_galerkin(const Dense& A)
    {
      EXPECT_LE((A - A.transpose()).norm(), 1e-12 * A.norm());
      if (std::exchange(_is_updated, false))
      {
        // Without friction closed nodes that are not soft have their normal
        // displacement eliminated, the last one here
        Dense condensed = A;
        const contact::Contact& contact = *_algebra._bodies.contacts.front();
        const int g = _algebra._bodies.bulk->gdim();
        const auto slaves = contact.slaves().owned();
        for (std::size_t k = 0; k < slaves.size(); ++k)
          if (const auto i = g * slaves[k] + g - 1;
              contact.nodes()->closed(k)
              and contact.nodes()->by_multiplier[k] == 0)
            condensed(i, i) = 0;
        const Dense& Q = of(*_prolongations.front());
        const Dense wanted = Q.transpose() * condensed * Q;
        EXPECT_LE((of(*_matrices.front()) - wanted).norm(),
                  1e-10 * wanted.norm());
      }
      const Eigen::VectorXd root
          = math::column(_diagonal).array().rsqrt().matrix();
      const Dense scaled = root.asDiagonal() * A * root.asDiagonal();
      const Eigen::VectorXd of_bulk
          = _algebra._K.diagonal().array().abs().rsqrt().matrix();
      const Dense bulk
          = of_bulk.asDiagonal() * _algebra._K * of_bulk.asDiagonal();
      EXPECT_LE(scaled.operatorNorm(),
                std::max(1.0, bulk.operatorNorm()) * (1 + 1e-10));
    }

    DenseAlgebra& _algebra;
    condense::Apply _multiply;
    std::vector<MatrixPtr> _prolongations, _matrices;
    std::vector<double> _diagonal;
    bool _is_updated = false;
  };

  /// GMRES without restart, by least squares on all of its vectors.
  class Richardson final : public condense::FlexibleGMRES
  {
  public:
    Richardson(DenseAlgebra& algebra, std::size_t size,
               condense::Apply multiply, condense::Apply precondition)
        : _algebra(algebra), _size(size), _multiply(std::move(multiply)),
          _precondition(std::move(precondition))
    {
    }
    Iterations solve(Span b, std::span<double> x, const Test& test,
                     int most) override
    {
      const Dense A = dense_of(_multiply, _size);
      const Dense M = dense_of(_precondition, _size);
      const Eigen::VectorXd start = math::column(std::span<const double>(x));
      const Eigen::VectorXd r = math::column(b) - A * start;
      Dense directions(_size, 0);
      Eigen::VectorXd left = r, found = start;
      for (int count = 0;; ++count)
      {
        if (const auto end = test(count, left.norm()))
        {
          Eigen::VectorXd::Map(x.data(), _size) = found;
          return {count,
                  _algebra.bodies_converge ? *end : Iterations::End::failed};
        }
        if (count == most)
          return {count, Iterations::End::failed};
        directions.conservativeResize(Eigen::NoChange, count + 1);
        directions.col(count) = M * left;
        const Eigen::VectorXd y
            = (A * directions).colPivHouseholderQr().solve(r);
        found = start + directions * y;
        left = math::column(b) - A * found;
      }
    }

  private:
    DenseAlgebra& _algebra;
    std::size_t _size;
    condense::Apply _multiply, _precondition;
  };

  class Direct final : public condense::DirectSolver
  {
  public:
    explicit Direct(DenseAlgebra& algebra) : _algebra(algebra) {}
    void assemble(const condense::Springs&) override
    {
      _J = _algebra._bodies.matrix();
    }
    bool factorise() override
    {
      ++_algebra.factorised["system"];
      _factors = _J;
      return Eigen::FullPivLU<Dense>(_J).isInvertible();
    }
    Iterations solve(Span b, std::span<double> x, double target,
                     int most) override
    {
      _algebra.targets.push_back(target);
      Eigen::VectorXd found = Eigen::VectorXd::Zero(_J.rows());
      for (int count = 0; count <= most; ++count)
      {
        const Eigen::VectorXd left = math::column(b) - _J * found;
        if (left.norm() <= std::max(target, 1e-13 * math::column(b).norm()))
        {
          Eigen::VectorXd::Map(x.data(), _J.rows()) = found;
          return {count, Iterations::End::converged};
        }
        found += _factors.partialPivLu().solve(left);
      }
      return {most, Iterations::End::failed};
    }
    void reset() override {}

  private:
    DenseAlgebra& _algebra;
    Dense _J, _factors;
  };

  /// The bodies' stiffness, with unit rows and columns where prescribed.
  Dense unit_rows() const
  {
    Dense K = _bodies.stiffness();
    const auto markers = _bodies.bulk->markers();
    for (Eigen::Index i = 0; i < K.rows(); ++i)
      if (markers[i])
      {
        K.row(i).setZero();
        K.col(i).setZero();
        K(i, i) = 1;
      }
    return K;
  }

  Stepped& _bodies;
  Dense _K;
};
} // namespace contactx::tests
