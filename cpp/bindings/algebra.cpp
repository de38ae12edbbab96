// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/problem/condensed_solver.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::condense;
using contactx::problem::CondensedSolver;
using contactx::problem::Problem;

namespace
{
/// Function for Python that writes into its second argument.
py::cpp_function to_python(Apply apply)
{
  return {[apply = std::move(apply)](const Array<double>& x, Array<double> y)
          { apply(view(x), mutable_view(y)); }, py::arg("x"),
          py::arg("y").noconvert()};
}

std::vector<double> to_values(const py::object& object)
{
  return contactx_bindings::copy(object.cast<Array<double>>());
}

struct PythonMatrix final : Matrix
{
  explicit PythonMatrix(py::object A) : A(std::move(A)) {}
  py::object A;
};

const py::object& of(const Matrix& A)
{
  return static_cast<const PythonMatrix&>(A).A;
}

MatrixPtr made(py::object A)
{
  return std::make_shared<PythonMatrix>(std::move(A));
}

std::vector<MatrixPtr> all_made(const py::object& matrices)
{
  std::vector<MatrixPtr> all;
  for (const py::handle A : matrices)
    all.push_back(made(py::reinterpret_borrow<py::object>(A)));
  return all;
}

Iterations to_iterations(const py::object& found)
{
  const auto [count, end] = found.cast<std::pair<int, Iterations::End>>();
  return {count, end};
}

class PythonFactors final : public Factors
{
public:
  explicit PythonFactors(py::object adapter) : _adapter(std::move(adapter)) {}
  bool is_good() const override
  {
    return _adapter.attr("is_good").cast<bool>();
  }
  void solve(std::span<const double> b, std::span<double> x,
             bool transposed) override
  {
    _adapter.attr("solve")(look(b), lend(x), transposed);
  }

private:
  py::object _adapter;
};

class PythonHierarchy final : public Hierarchy
{
public:
  explicit PythonHierarchy(py::object adapter)
      : _adapter(std::move(adapter)),
        _prolongations(all_made(_adapter.attr("prolongations"))),
        _matrices(all_made(_adapter.attr("matrices")))
  {
  }
  const std::vector<MatrixPtr>& prolongations() const override
  {
    return _prolongations;
  }
  const std::vector<MatrixPtr>& matrices() const override { return _matrices; }
  void set_diagonal(std::span<const double> diagonal) override
  {
    _adapter.attr("set_diagonal")(look(diagonal));
  }
  void update() override { _adapter.attr("update")(); }
  void cycle(std::span<const double> b, std::span<double> x) override
  {
    _adapter.attr("cycle")(look(b), lend(x));
  }
  Iterations solve(std::span<const double> b, std::span<double> x,
                   bool is_symmetric, double target, int most) override
  {
    return to_iterations(
        _adapter.attr("solve")(look(b), lend(x), is_symmetric, target, most));
  }

private:
  py::object _adapter;
  std::vector<MatrixPtr> _prolongations, _matrices;
};

class PythonGMRES final : public FlexibleGMRES
{
public:
  explicit PythonGMRES(py::object adapter) : _adapter(std::move(adapter)) {}
  Iterations solve(std::span<const double> b, std::span<double> x,
                   const Test& test, int most) override
  {
    return to_iterations(_adapter.attr("solve")(look(b), lend(x), test, most));
  }

private:
  py::object _adapter;
};

class PythonDirect final : public DirectSolver
{
public:
  explicit PythonDirect(py::object adapter) : _adapter(std::move(adapter)) {}
  void assemble(const Springs& springs) override
  {
    _adapter.attr("assemble")(springs ? py::object(array(*springs))
                                      : py::none());
  }
  bool factorise() override
  {
    return _adapter.attr("factorise")().cast<bool>();
  }
  Iterations solve(std::span<const double> b, std::span<double> x,
                   double target, int most) override
  {
    return to_iterations(
        _adapter.attr("solve")(look(b), lend(x), target, most));
  }
  void reset() override { _adapter.attr("reset")(); }

private:
  py::object _adapter;
};

/// Algebra of an object of Python: see python/contactx/_host/algebra.py. The
/// object is kept alive.
class PythonAlgebra final : public Algebra
{
public:
  explicit PythonAlgebra(py::object adapter) : _adapter(std::move(adapter)) {}

  void update_bulk() override { _adapter.attr("update_bulk")(); }
  int assemblies() const override
  {
    return _adapter.attr("assemblies").cast<int>();
  }
  bool is_symmetric() override
  {
    return _adapter.attr("is_symmetric").cast<bool>();
  }
  MatrixPtr bulk() override { return made(_adapter.attr("bulk")()); }
  MatrixPtr bulk_copy() override { return made(_adapter.attr("bulk_copy")()); }
  MatrixPtr lent_bulk() override { return made(_adapter.attr("lent_bulk")()); }
  MatrixPtr bulk_rows(std::span<const std::int32_t> dofs) override
  {
    return made(_adapter.attr("bulk_rows")(look(dofs)));
  }
  FieldBlocks field_blocks() override
  {
    const auto [uf, fu, ff]
        = _adapter.attr("field_blocks")().cast<std::array<py::object, 3>>();
    return {made(uf), made(fu), made(ff)};
  }
  std::span<const std::int8_t> prescribed() override
  {
    _prescribed = _adapter.attr("prescribed").cast<Array<std::int8_t>>();
    return view(_prescribed);
  }
  MatrixPtr matrix(std::size_t num_rows, std::size_t num_columns,
                   std::span<const std::int64_t> rows,
                   std::span<const std::int64_t> columns,
                   std::span<const double> values) override
  {
    return made(_adapter.attr("matrix")(num_rows, num_columns, look(rows),
                                        look(columns), look(values)));
  }
  Layout layout(const Matrix& A) const override
  {
    const auto found
        = _adapter.attr("layout")(of(A)).cast<std::array<std::int64_t, 4>>();
    return {static_cast<std::size_t>(found[0]),
            static_cast<std::size_t>(found[1]), found[2], found[3]};
  }
  void multiply(const Matrix& A, std::span<const double> x,
                std::span<double> y) override
  {
    _adapter.attr("multiply")(of(A), look(x), lend(y));
  }
  void multiply_transposed(const Matrix& A, std::span<const double> x,
                           std::span<double> y) override
  {
    _adapter.attr("multiply_transposed")(of(A), look(x), lend(y));
  }
  MatrixPtr copy(const Matrix& A) override
  {
    return made(_adapter.attr("copy")(of(A)));
  }
  void add(Matrix& Y, double factor, const Matrix& X) override
  {
    _adapter.attr("add")(of(Y), factor, of(X));
  }
  void scale(Matrix& A, std::span<const double> left,
             std::span<const double> right) override
  {
    _adapter.attr("scale")(of(A), look(left), look(right));
  }
  MatrixPtr product(const Matrix& A, const Matrix& B) override
  {
    return made(_adapter.attr("product")(of(A), of(B)));
  }
  MatrixPtr transposed_product(const Matrix& A, const Matrix& B) override
  {
    return made(_adapter.attr("transposed_product")(of(A), of(B)));
  }
  MatrixPtr projection(const Matrix& A, const Matrix& P) override
  {
    return made(_adapter.attr("projection")(of(A), of(P)));
  }
  MatrixPtr transpose(const Matrix& A) override
  {
    return made(_adapter.attr("transpose")(of(A)));
  }
  MatrixPtr submatrix(const Matrix& A, std::span<const std::int64_t> rows,
                      std::span<const std::int64_t> columns) override
  {
    return made(_adapter.attr("submatrix")(of(A), look(rows), look(columns)));
  }
  std::vector<double> diagonal(const Matrix& A) override
  {
    return to_values(_adapter.attr("diagonal")(of(A)));
  }
  void set_diagonal(Matrix& A, std::span<const double> values) override
  {
    _adapter.attr("set_diagonal")(of(A), look(values));
  }
  void set_identity(Matrix& A, std::span<const std::int64_t> rows) override
  {
    _adapter.attr("set_identity")(of(A), look(rows));
  }
  double norm(const Matrix& A) override
  {
    return _adapter.attr("norm")(of(A)).cast<double>();
  }
  std::int64_t num_entries(const Matrix& A) override
  {
    return _adapter.attr("num_entries")(of(A)).cast<std::int64_t>();
  }
  std::vector<std::int32_t> entries_of_rows(const Matrix& A) override
  {
    return contactx_bindings::copy(
        _adapter.attr("entries_of_rows")(of(A)).cast<Array<std::int32_t>>());
  }
  std::vector<double> absolute_sums(const Matrix& A) override
  {
    return to_values(_adapter.attr("absolute_sums")(of(A)));
  }
  MatrixPtr join(const std::vector<std::vector<MatrixPtr>>& blocks) override
  {
    py::list rows;
    for (const auto& row : blocks)
    {
      py::list all;
      for (const MatrixPtr& A : row)
        all.append(A ? of(*A) : py::none());
      rows.append(std::move(all));
    }
    return made(_adapter.attr("join")(std::move(rows)));
  }
  std::unique_ptr<Factors> factorise(MatrixPtr A,
                                     const FactorOptions& options) override
  {
    return std::make_unique<PythonFactors>(_adapter.attr("factorise")(
        of(*A), std::string(options.name), options.is_symmetric, options.group,
        options.is_rough));
  }
  std::unique_ptr<Hierarchy>
  hierarchy(MatrixPtr A,
            const std::vector<std::vector<double>>& near_null_space,
            int block_size, Apply multiply) override
  {
    return std::make_unique<PythonHierarchy>(
        _adapter.attr("hierarchy")(of(*A), arrays(near_null_space), block_size,
                                   to_python(std::move(multiply))));
  }
  std::optional<Aggregates>
  aggregate(MatrixPtr A,
            const std::vector<std::vector<double>>& near_null_space,
            int block_size) override
  {
    const py::object found = _adapter.attr("aggregate")(
        of(*A), arrays(near_null_space), block_size);
    if (found.is_none())
      return std::nullopt;
    const auto [P, K] = found.cast<std::pair<py::object, py::object>>();
    return Aggregates{made(P), made(K)};
  }
  std::unique_ptr<FlexibleGMRES> flexible_gmres(std::size_t size,
                                                Apply multiply,
                                                Apply precondition,
                                                int restart) override
  {
    return std::make_unique<PythonGMRES>(_adapter.attr("flexible_gmres")(
        size, to_python(std::move(multiply)),
        to_python(std::move(precondition)), restart));
  }
  std::unique_ptr<DirectSolver> direct_solver() override
  {
    return std::make_unique<PythonDirect>(_adapter.attr("direct_solver")());
  }
  std::string preconditioner() const override
  {
    return _adapter.attr("preconditioner").cast<std::string>();
  }

private:
  static py::list arrays(const std::vector<std::vector<double>>& vectors)
  {
    py::list all;
    for (const auto& vector : vectors)
      all.append(array(vector));
    return all;
  }

  py::object _adapter;
  Array<std::int8_t> _prescribed;
};
} // namespace

void contactx_bindings::algebra(py::module_& m)
{
  py::enum_<Iterations::End>(m, "End", "Ends of iterations")
      .value("CONVERGED", Iterations::End::converged)
      .value("INDEFINITE", Iterations::End::indefinite)
      .value("FAILED", Iterations::End::failed);
  py::class_<CondensedSolver::Statistics>(m, "SolverStatistics",
                                          "What solves of a step have done")
      .def_readonly("solves", &CondensedSolver::Statistics::solves)
      .def_readonly("iterations", &CondensedSolver::Statistics::iterations)
      .def_readonly("hierarchies", &CondensedSolver::Statistics::hierarchies)
      .def_readonly("factorisations",
                    &CondensedSolver::Statistics::factorisations)
      .def_readonly("factorised", &CondensedSolver::Statistics::factorised)
      .def_readonly("by_bodies", &CondensedSolver::Statistics::by_bodies)
      .def_readonly("direct", &CondensedSolver::Statistics::direct)
      .def_readonly("seconds", &CondensedSolver::Statistics::seconds);
  py::class_<Tuning>(m, "Tuning", "Numbers that cost or save time alone")
      .def_readwrite("renewal_cost", &Tuning::renewal_cost)
      .def_readwrite("slow_rate", &Tuning::slow_rate)
      .def_readwrite("max_iterations", &Tuning::max_iterations)
      .def_readwrite("max_change", &Tuning::max_change)
      .def_readwrite("short_wave_exponent", &Tuning::short_wave_exponent)
      .def_readwrite("roughness", &Tuning::roughness);
  py::class_<CondensedSolver>(
      m, "CondensedSolver",
      "Solves the system of the Jacobian with the multipliers eliminated")
      .def(py::init(
               [](Problem& problem, py::object algebra)
               {
                 return std::make_unique<CondensedSolver>(
                     problem,
                     std::make_shared<PythonAlgebra>(std::move(algebra)));
               }),
           py::arg("problem"), py::arg("algebra"), py::keep_alive<1, 2>())
      .def(
          "solve",
          [](CondensedSolver& self, const Array<double>& b, Array<double> x)
          { self.solve(view(b), mutable_view(x)); }, py::arg("b"),
          py::arg("x").noconvert())
      .def(
          "multiply",
          [](CondensedSolver& self, const Array<double>& x, Array<double> y)
          { self.multiply(view(x), mutable_view(y)); }, py::arg("x"),
          py::arg("y").noconvert())
      .def_readonly("tuning", &CondensedSolver::tuning)
      .def("reset", &CondensedSolver::reset)
      .def("statistics", &CondensedSolver::statistics);
}
