// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// Operations of contactx_dolfinx::Algebra against dense arithmetic, and its
// solvers by their residuals, on the mesh of demos/cpp/sliding_block; prints
// what is wrong.

#include "scenes.h"
#include "sliding_block.h"
#include <contactx_dolfinx/algebra.h>
#include <contactx_dolfinx/partitioner.h>
#include <dolfinx/fem/Constant.h>
#include <numeric>

using namespace dolfinx;
using T = PetscScalar;
namespace cx = contactx_dolfinx;
using contactx::condense::Iterations;
using contactx::condense::MatrixPtr;
using End = Iterations::End;
using Vector = std::vector<double>;
using Int = std::int64_t;

namespace
{
int failures = 0;

void check(const char* what, bool is_right)
{
  int all = is_right;
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  failures += not all;
  if (not all)
    scenes::print(std::string("wrong: ") + what);
}

/// Rows or columns of a matrix, of which a rank has successive ones.
struct Part
{
  explicit Part(std::size_t mine) : mine(mine), total(mine)
  {
    MPI_Scan(&total, &first, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    first -= static_cast<Int>(mine);
    MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_INT64_T, MPI_SUM,
                  MPI_COMM_WORLD);
  }
  bool has(Int i) const { return i >= first and i < first + Int(mine); }
  std::size_t mine;
  Int first = 0, total;
};

/// All entries of a matrix, on all ranks.
struct Dense
{
  Dense(Int m, Int n, const std::function<double(Int, Int)>& f) : m(m), n(n)
  {
    for (Int k = 0; k < m * n; ++k)
      a.push_back(f(k / n, k % n));
  }
  double operator()(Int i, Int j) const { return a[i * n + j]; }
  Dense T() const
  {
    return {n, m, [this](Int i, Int j) { return (*this)(j, i); }};
  }
  Dense operator*(const Dense& b) const
  {
    const auto entry = [&](Int i, Int j)
    {
      double sum = 0;
      for (Int k = 0; k < n; ++k)
        sum += (*this)(i, k) * b(k, j);
      return sum;
    };
    return {m, b.n, entry};
  }
  bool operator==(const Dense& b) const
  {
    return n == b.n
           and std::ranges::equal(a, b.a, [](double x, double y)
                                  { return std::abs(x - y) < 1e-12; });
  }
  Int m, n;
  Vector a;
};

/// A quarter of the entries, and the diagonal.
Dense some(const Part& m, const Part& n, int seed)
{
  const auto entry = [&](Int i, Int j)
  {
    const bool is_there = i == j or (5 * i + 3 * j + seed) % 4 == 0;
    return is_there ? std::sin(double(1 + 3 * i + j * j + seed)) + 4 * (i == j)
                    : 0;
  };
  return {m.total, n.total, entry};
}

/// What products with a matrix tell of it.
Dense dense(cx::Algebra& algebra, const MatrixPtr& A, bool transposed = false)
{
  const auto layout = algebra.layout(*A);
  Part rows(layout.num_rows), columns(layout.num_columns);
  check("layout", rows.first == layout.first_row
                      and columns.first == layout.first_column);
  if (transposed)
    std::swap(rows, columns);
  Dense found(rows.total, columns.total, [](Int, Int) { return 0; });
  for (Int j = 0; j < columns.total; ++j)
  {
    Vector x(columns.mine, 0), y(rows.mine);
    if (columns.has(j))
      x[j - columns.first] = 1;
    transposed ? algebra.multiply_transposed(*A, x, y)
               : algebra.multiply(*A, x, y);
    for (std::size_t i = 0; i < y.size(); ++i)
      found.a[(rows.first + Int(i)) * found.n + j] = y[i];
  }
  MPI_Allreduce(MPI_IN_PLACE, found.a.data(), int(found.a.size()), MPI_DOUBLE,
                MPI_SUM, MPI_COMM_WORLD);
  return found;
}

/// A matrix; ranks have halves of its entries, whoever has the rows.
MatrixPtr sparse(cx::Algebra& algebra, const Dense& of, const Part& rows,
                 const Part& columns)
{
  std::vector<Int> i{-1}, j{0};
  Vector values{1};
  for (Int k = 0; k < 2 * of.m * of.n; ++k)
    if (const Int e = k / 2;
        of.a[e] != 0
        and (k / 2 + k) % dolfinx::MPI::size(MPI_COMM_WORLD)
                == dolfinx::MPI::rank(MPI_COMM_WORLD))
    {
      i.push_back(e / of.n);
      j.push_back(e % of.n);
      values.push_back(of.a[e] / 2);
    }
  return algebra.matrix(rows.mine, columns.mine, i, j, values);
}

/// Norm of b - A x.
double rest(cx::Algebra& algebra, const MatrixPtr& A, const Vector& b,
            const Vector& x, bool transposed = false)
{
  Vector r(b.size());
  transposed ? algebra.multiply_transposed(*A, x, r)
             : algebra.multiply(*A, x, r);
  std::ranges::transform(b, r, r.begin(), std::minus());
  return scenes::norm(r);
}

void operations(cx::Algebra& algebra)
{
  const int rank = dolfinx::MPI::rank(MPI_COMM_WORLD);
  // A rank without columns, too
  const Part m(5), n(rank == 1 ? 0 : 3);
  const Dense a = some(m, m, 0), b = some(m, n, 1), c = some(m, m, 2);
  const MatrixPtr A = sparse(algebra, a, m, m), B = sparse(algebra, b, m, n);
  const auto is
      = [&](const char* what, const MatrixPtr& found, const Dense& wanted)
  { check(what, dense(algebra, found) == wanted); };
  const auto entries = [&](auto&& f) { return Dense(m.total, m.total, f); };
  is("matrix", A, a);
  check("multiply_transposed", dense(algebra, B, true) == b.T());
  is("product", algebra.product(*A, *B), a * b);
  is("transposed_product", algebra.transposed_product(*A, *B), a.T() * b);
  is("projection", algebra.projection(*A, *B), b.T() * (a * b));
  is("transpose", algebra.transpose(*B), b.T());

  Vector diagonal, scales, sums, found(5);
  std::vector<std::int32_t> counts;
  for (Int i = m.first; i < m.first + 5; ++i)
  {
    diagonal.push_back(a(i, i));
    scales.push_back(double(1 + i));
    const std::span row(a.a.data() + i * a.n, a.n);
    counts.push_back(static_cast<int>(a.n - std::ranges::count(row, 0.0)));
    sums.push_back(std::accumulate(row.begin(), row.end(), 0.0,
                                   [](double sum, double v)
                                   { return sum + std::abs(v); }));
  }
  check("num_entries", algebra.num_entries(*A)
                           == Int(a.a.size()) - std::ranges::count(a.a, 0));
  check("entries_of_rows", algebra.entries_of_rows(*A) == counts);
  found = algebra.absolute_sums(*A);
  std::ranges::transform(found, sums, found.begin(), std::minus());
  check("absolute_sums", scenes::norm(found) < 1e-13);
  check("norm", std::abs(algebra.norm(*A)
                         - std::sqrt(std::inner_product(a.a.begin(), a.a.end(),
                                                        a.a.begin(), 0.0)))
                    < 1e-12);
  check("diagonal", algebra.diagonal(*A) == diagonal);

  MatrixPtr D = algebra.copy(*A);
  algebra.add(*D, -0.5, *sparse(algebra, c, m, m));
  is("add", D, entries([&](Int i, Int j) { return a(i, j) - 0.5 * c(i, j); }));
  algebra.set_diagonal(*D, scales);
  check("set_diagonal", algebra.diagonal(*D) == scales);
  D = algebra.copy(*B);
  algebra.scale(*D, scales, Vector(n.mine, 3));
  is("scale", D,
     Dense(b.m, b.n,
           [&](Int i, Int j) { return 3.0 * double(1 + i) * b(i, j); }));
  const std::vector<Int> rows{m.first + 3, m.first + 1};
  const auto place = [](Int k) { return k / 2 * 5 + (k % 2 ? 1 : 3); };
  is("submatrix", algebra.submatrix(*A, rows, rows),
     Dense(2 * m.total / 5, 2 * m.total / 5,
           [&](Int i, Int j) { return a(place(i), place(j)); }));
  D = algebra.copy(*A);
  algebra.set_identity(*D, rows);
  const auto is_one = [](Int i) { return i % 5 == 1 or i % 5 == 3; };
  is("set_identity", D,
     entries([&](Int i, Int j) -> double
             { return is_one(i) or is_one(j) ? i == j : a(i, j); }));

  // [A 0; 0 A] z with z = (x, x)
  const MatrixPtr join = algebra.join({{A, nullptr}, {nullptr, A}});
  Vector z(10), w(10);
  std::iota(z.begin(), z.begin() + 5, 1.0 + double(m.first));
  std::copy_n(z.begin(), 5, z.begin() + 5);
  algebra.multiply(*join, z, w);
  algebra.multiply(*A, std::span(z).first(5), found);
  check("join", std::equal(found.begin(), found.end(), w.begin())
                    and std::equal(found.begin(), found.end(), w.begin() + 5));

  for (const bool is_rough : {false, true})
  {
    const auto factors = algebra.factorise(
        algebra.copy(*A), {.name = "some", .is_rough = is_rough});
    for (const bool transposed : {false, true})
    {
      factors->solve(scales, found, transposed);
      check(is_rough ? "rough factors" : "factors",
            rest(algebra, A, scales, found, transposed)
                < (is_rough ? 1e-4 : 1e-12));
    }
  }
  D = algebra.copy(*A);
  algebra.scale(*D, Vector(5, 0), Vector(5, 1));
  const auto none = algebra.factorise(D, {.name = "none", .is_rough = false});
  none->solve(scales, found);
  check("singular", not dynamic_cast<const cx::petsc::Factors&>(*none).is_good()
                        and std::ranges::none_of(found, [](double v)
                                                 { return std::isfinite(v); }));
  // Without neighbours nothing is aggregated
  std::vector<Int> all(5);
  std::iota(all.begin(), all.end(), m.first);
  const MatrixPtr S = algebra.matrix(5, 5, all, all, scales);
  D = algebra.copy(*S);
  const auto one = algebra.hierarchy(
      S, {Vector(5, 1)}, 1, [&](std::span<const double> x, std::span<double> y)
      { algebra.multiply(*D, x, y); });
  std::ranges::fill(found, 0);
  one->set_diagonal(scales);
  one->update();
  check("one level", one->matrices().empty()
                         and one->solve(sums, found, true, 1e-9, 9).count == 1
                         and rest(algebra, D, sums, found) < 1e-9);
}

void solvers(cx::Assembler& assembler, cx::Algebra& algebra)
{
  algebra.update_bulk();
  const MatrixPtr K = algebra.bulk();
  const Part part(algebra.layout(*K).num_rows);
  const std::size_t n = part.mine;
  check("is_symmetric", algebra.is_symmetric());
  std::vector<std::int32_t> dofs(n / 2);
  std::iota(dofs.begin(), dofs.end(), 3);
  const Vector sums = algebra.absolute_sums(*K),
               of_rows = algebra.absolute_sums(*algebra.bulk_rows(dofs));
  check("bulk_rows",
        std::ranges::equal(of_rows, std::span(sums).subspan(3, n / 2)));
  const auto prescribed = algebra.prescribed();
  Vector b(n), x(n, 0), spring(n), diagonal = algebra.diagonal(*K);
  std::vector<Vector> modes(2, Vector(n, 0));
  for (std::size_t i = 0; i < n; ++i)
  {
    const bool is_free = not prescribed[i];
    b[i] = is_free * std::sin(double(part.first + Int(i)));
    diagonal[i] += spring[i] = 50 * (i % 7 == 0 and is_free);
    modes[i % 2][i] = is_free;
  }
  std::vector<Int> places(n);
  std::iota(places.begin(), places.end(), part.first);
  MatrixPtr S = algebra.matrix(n, n, places, places, spring), Z = K;
  const MatrixPtr A = algebra.bulk_copy(), P = algebra.bulk_copy();
  algebra.add(*A, 1, *S);

  // Multigrid of the bulk, then with springs
  MatrixPtr now = K;
  const auto multiply = [&](std::span<const double> v, std::span<double> w)
  {
    if (not now)
      throw std::domain_error("of the product");
    algebra.multiply(*now, v, w);
  };
  const auto hierarchy = algebra.hierarchy(P, modes, 2, multiply);
  check("levels",
        hierarchy->matrices().size() > 1 and algebra.num_entries(*P) == 0);
  Iterations done = hierarchy->solve(b, x, true, 1e-9, 200);
  check("CG", done.converged() and done.count < 40
                  and rest(algebra, K, b, x) < 1.1e-9);
  check("start", hierarchy->solve(b, x, true, 1e-8, 200).count == 0);
  for (std::size_t k = 0; k < hierarchy->matrices().size(); ++k)
  {
    const MatrixPtr &Q = hierarchy->prolongations()[k],
                    &coarse = hierarchy->matrices()[k];
    Z = algebra.projection(*Z, *Q);
    S = algebra.projection(*S, *Q);
    const MatrixPtr off = algebra.copy(*coarse);
    algebra.add(*off, -1, *Z);
    check("Galerkin", algebra.norm(*off) < 1e-12 * algebra.norm(*Z));
    algebra.add(*coarse, 1, *S);
  }
  now = A;
  hierarchy->set_diagonal(diagonal);
  hierarchy->update();
  for (const bool is_symmetric : {true, false})
  {
    std::ranges::fill(x, 0);
    done = hierarchy->solve(b, x, is_symmetric, 1e-9, 200);
    check("springs", done.converged() and done.count < 40
                         and rest(algebra, A, b, x) < 1.1e-9);
  }
  done = hierarchy->solve(diagonal, x, true, 1e-9, 2);
  check("too few", done.count == 2 and done.end == End::failed);
  now = nullptr;
  bool is_thrown = false;
  try
  {
    hierarchy->solve(b, x, true, 0, 200);
  }
  catch (const std::domain_error&)
  {
    is_thrown = true;
  }
  check("error", is_thrown);

  // Flexible GMRES with factors of the bulk
  now = A;
  const auto factors = algebra.factorise(
      algebra.bulk_copy(), {.name = "bulk", .is_symmetric = true, .group = 2});
  const auto flexible = algebra.flexible_gmres(
      n, multiply, [&](std::span<const double> r, std::span<double> z)
      { factors->solve(r, z); }, 50);
  for (const End end : {End::converged, End::failed})
  {
    int calls = 0;
    std::ranges::fill(x, 0);
    done = flexible->solve(
        b, x,
        [&](int count, double norm) -> std::optional<End>
        {
          calls += count == calls;
          const bool ends = end == End::failed ? count == 3 : norm < 1e-9;
          return ends ? std::optional(end) : std::nullopt;
        },
        100);
    check("FGMRES",
          done.end == end and calls == done.count + 1
              and (end == End::failed ? done.count == 3
                                      : rest(algebra, A, b, x) < 2e-9));
  }

  const auto coarse = algebra.aggregate(algebra.bulk_copy(), modes, 2);
  Z = algebra.projection(*K, *coarse->prolongation);
  algebra.add(*Z, -1, *coarse->stiffness);
  check("aggregate",
        algebra.norm(*Z) < 1e-12 * algebra.norm(*coarse->stiffness));

  // The system of all unknowns, then with springs and older factors
  const auto direct = algebra.direct_solver();
  const cx::petsc::OwnMat J(assembler.create_matrix());
  const cx::petsc::OwnVec u(assembler.create_vector()),
      r(assembler.create_vector());
  assembler.jacobian(assembler.x(), J.get());
  Vector load(assembler.system()->size()), found(load);
  std::ranges::copy(b, load.begin());
  for (const double more : {0.0, 1e-4})
  {
    VecZeroEntries(r.get());
    std::ranges::fill(cx::petsc::Values(r.get()).span().first(n), more);
    MatDiagonalSet(J.get(), r.get(), ADD_VALUES);
    direct->assemble(more > 0 ? std::optional(Vector(n, more)) : std::nullopt);
    check("factorise", more > 0 or direct->factorise());
    done = direct->solve(load, found, 1e-9, 60);
    std::ranges::copy(found, cx::petsc::Values(u.get()).span().begin());
    MatMult(J.get(), u.get(), r.get());
    const cx::petsc::ConstValues product(r.get());
    std::ranges::transform(load, product.span(), found.begin(), std::minus());
    check("direct", done.converged() and done.count == (more > 0 ? 4 : 1)
                        and scenes::norm(found) < 1e-9);
  }
}
/// Two rows of squares that touch along a line, all on the first rank.
void partition()
{
  const int size = dolfinx::MPI::size(MPI_COMM_WORLD);
  constexpr int length = 40;
  Vector x;
  std::vector<std::int8_t> near;
  std::vector<Int> cells;
  if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
  {
    for (int node = 0; node < 3 * (length + 1); ++node)
    {
      x.insert(x.end(),
               {double(node % (length + 1)), double(node / (length + 1))});
      near.push_back(node / (length + 1) == 1);
    }
    for (int cell = 0; cell < 2 * length; ++cell)
      for (const int corner : {0, 1, length + 1, length + 2})
        cells.push_back(cell + cell / length + corner);
  }
  const auto found = cx::partitioner(x, 2, near)(
      MPI_COMM_WORLD, size, {mesh::CellType::quadrilateral}, {cells});
  bool is_right = found.num_nodes() == std::ssize(cells) / 4;
  for (int rank = 0; is_right and not cells.empty() and rank < size; ++rank)
    is_right
        = std::abs(std::ranges::count(found.array(), rank) - 2 * length / size)
          <= 2;
  check("partition", is_right);
  bool is_refused = false;
  try
  {
    cx::partitioner({}, 2, {})(MPI_COMM_WORLD, size, {}, {});
  }
  catch (const std::invalid_argument&)
  {
    is_refused = true;
  }
  check("partition of mixed cells", is_refused);
}
} // namespace

int main(int argc, char* argv[])
{
  init_logging(argc, argv);
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  {
    const auto cell = mesh::CellType::quadrilateral;
    const scenes::Domain domain = scenes::read("sliding_block.xdmf", cell);
    const auto V = scenes::space(domain, scenes::lagrange(cell, 1, 2));
    const auto u = std::make_shared<fem::Function<T>>(V);
    const auto load
        = std::make_shared<fem::Constant<T>>(std::vector<T>{0, -0.01});
    const auto F = std::make_shared<cx::Form>(fem::create_form<T>(
        *form_sliding_block_F, {V}, {{"u", u}}, {{"load", load}}, {}, {}));
    const auto J = std::make_shared<cx::Form>(fem::create_form<T>(
        *form_sliding_block_J, {V, V}, {{"u", u}}, {}, {}, {}));
    std::vector<std::shared_ptr<const fem::DirichletBC<T>>> bcs;
    for (const int face : {12, 22})
      bcs.push_back(std::make_shared<const fem::DirichletBC<T>>(
          std::vector<T>{0, face == 12 ? -0.01 : 0.0},
          fem::locate_dofs_topological(*domain.mesh->topology_mutable(),
                                       *V->dofmap(), 1,
                                       domain.tags->find(face)),
          V));
    const auto contact = std::make_shared<cx::Contact>(
        cx::Surface(domain.tags, {11}), cx::Surface(domain.tags, {21}),
        cx::Options{.friction = 0.3, .offset = 1e-8});
    cx::Assembler assembler(F, J, u, bcs, {contact});
    assembler.begin_step();
    assembler.settle();
    cx::Algebra algebra(assembler, "algebra_");
    operations(algebra);
    solvers(assembler, algebra);
    partition();

    check("no preconditioner", algebra.preconditioner().empty());
    PetscOptionsSetValue(nullptr, "-algebra_pc_type", "jacobi");
    check("preconditioner", algebra.preconditioner() == "jacobi");
    std::string message;
    try
    {
      algebra.hierarchy(algebra.bulk_copy(), {}, 2, {});
    }
    catch (const std::invalid_argument& error)
    {
      message = error.what();
    }
    check("refusal", message.find("gamg and bodies, not j") != message.npos);
    PetscBool is_left = PETSC_TRUE;
    PetscOptionsHasName(nullptr, "algebra_", "-pc_use_amat", &is_left);
    check("options", not is_left);
  }
  PetscFinalize();
  return failures > 0;
}
