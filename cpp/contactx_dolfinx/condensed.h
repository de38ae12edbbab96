// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include <contactx/condense/condensation.h>
#include <contactx/condense/dependent_constraints.h>
#include <contactx/solve/accuracy.h>
#include <petscksp.h>
#include <string>

namespace contactx_dolfinx
{
/// @brief Solves the system of the Jacobian with the multipliers eliminated.
///
/// The displacements that are left follow from
///
///     K_c = (I + left) (K + S) (I + right) + law (I + right),
///
/// see contactx::condense::Condensation, which is made as a matrix, and are
/// found by CG, or GMRES where friction slips, with PETSc's algebraic
/// multigrid. Where eliminations need one another, as in surface-to-surface
/// contact that slides, K_c is applied as a product and the matrix, in which
/// the series of their inverses are cut off, is for multigrid alone. A loop
/// reads as with `Assembler::J`, but for the linear solve:
///
///     Condensed condensed(assembler, "condensed_");
///     ...
///       assembler.residual(x, b);
///       condensed.solve(b, dx);
///
/// Each solve is as accurate as the next residual will show. What cannot be
/// condensed goes to a direct solver of the saddle point: multipliers without
/// an equation of their own, and what multigrid does not converge for. All
/// ranks must take part in everything.
class Condensed final : public contactx::problem::LinearSolver
{
public:
  /// @brief Create the solver.
  /// @param[in] assembler The system; it must outlive the solver.
  /// @param[in] prefix Prefix of PETSc's options of the Krylov solver and its
  /// preconditioner; with `direct_` behind it those of the direct solver.
  /// @throws std::invalid_argument if other fields are solved for, too.
  Condensed(Assembler& assembler, const std::string& prefix)
      : _assembler(&assembler), _prefix(prefix),
        _accuracy(has_path(*assembler.system()))
  {
    if (assembler.bulk()->fields())
      throw std::invalid_argument(
          "the condensed solver is for a displacement alone: where other "
          "fields "
          "are solved for take a KSPSolver, with a direct one");
  }

  /// @brief Solve J dx = b at the iterate that has settled last.
  /// @param[in] b Right-hand side in all unknowns.
  /// @param[out] dx Solution.
  void solve(::Vec b, ::Vec dx)
  {
    const contactx::solve::Loop& loop = _assembler->loop();
    if (_assembler->number() == 0)
      _accuracy.begin_step();
    const contactx::solve::Iterate& now = loop.iterate();
    _accuracy.set(now.residual, now.tolerance, loop.changing(),
                  loop.active_set().cycles() > 0);
    // A solver that has failed twice is not tried again: attempts are dear
    if (_failures < 2)
    {
      if (auto condensation = condense(b))
      {
        prepare(std::move(*condensation));
        const bool is_solved = apply(b, dx, _accuracy.target());
        _system.reset();
        if (is_solved)
          return;
        ++_failures;
      }
    }
    solve_directly(b, dx);
  }

  void update() override {}

  void solve(std::span<const double> b, std::span<double> x) override
  {
    const petsc::OwnVec right(_assembler->create_vector()),
        found(_assembler->create_vector());
    std::ranges::copy(b, petsc::Values(right.get()).span().begin());
    solve(right.get(), found.get());
    std::ranges::copy(petsc::ConstValues(found.get()).span(), x.begin());
  }

  /// @brief Krylov iterations so far.
  int iterations() const { return _iterations; }

  /// @brief Solves that went to the direct solver so far.
  int direct() const { return _direct; }

private:
  using OwnKSP = petsc::Owner<KSP, KSPDestroy>;

  /// What eliminations need of one another.
  struct DependentConstraints
  {
    petsc::OwnMat C, E; // E = I - C
    OwnKSP ksp;

    bool any() const { return ksp.get() != nullptr; }
  };

  /// The system of an iterate without multipliers, and the way there and back.
  struct System
  {
    System(contactx::condense::Condensation&& made, bool is_symmetric)
        : condensation(std::move(made)), is_symmetric(is_symmetric)
    {
    }

    contactx::condense::Condensation condensation;
    bool is_symmetric;
    std::vector<PetscInt> eliminated;
    ::Mat K = nullptr; // the bulk's, or stiff
    // Without identity; A is for multigrid, and applied where nothing is
    // chained
    petsc::OwnMat stiff, right, left, law, A, product;
    DependentConstraints of_right, of_left;
    petsc::OwnVec v, w; // work
    bool is_new = true;
  };

  static bool has_path(const contactx::solve::System& system)
  {
    return std::ranges::any_of(system.contacts(), [](const auto& c)
                               { return c->history() != nullptr; });
  }

  const contactx::solve::System& system() const
  {
    return *_assembler->system();
  }
  contactx::mesh::Halo& halo() const { return *system().halo(); }
  std::size_t num_owned() const { return system().num_displacements(); }

  /// Eliminates the multipliers; nothing on all ranks where that cannot be.
  std::optional<contactx::condense::Condensation> condense(::Vec b)
  {
    const int g = halo().gdim();
    const std::size_t local = std::size_t(halo().num_nodes()) * g;
    _free.assign(local, 0);
    std::vector<std::int64_t> free(local, 0);
    const auto markers = _assembler->bulk()->markers();
    for (std::size_t i = 0; i < markers.size(); ++i)
      free[i] = markers[i] == 0;
    halo().forward(std::span(free), g);
    std::ranges::copy(free, _free.begin());
    std::vector<std::int8_t> prescribed;
    for (const std::int8_t f : _free)
      prescribed.push_back(not f);

    std::vector<contactx::condense::Nodes> nodes;
    for (const auto& contact : system().contacts())
      nodes.push_back(contactx::condense::nodes_of(*contact));
    std::optional<contactx::condense::Condensation> made;
    {
      const petsc::ConstValues values(b);
      const auto d = values.span().subspan(num_owned());
      halo().ranks().agree(
          [&]
          {
            const contactx::condense::ContactBlock block(system().contacts(),
                                                         prescribed, false, d);
            try
            {
              made.emplace(block.entries(), nodes, _free, g);
            }
            catch (const contactx::condense::NotCondensable&)
            {
              made.reset();
            }
          });
    }
    if (not contactx::mesh::everywhere(halo().ranks(), made.has_value()))
      return std::nullopt;
    return made;
  }

  /// Numbers of displacements of this rank in the bulk's matrix.
  std::vector<PetscInt> numbers() const
  {
    const int g = halo().gdim();
    std::vector<std::int32_t> nodes(halo().num_nodes());
    std::iota(nodes.begin(), nodes.end(), 0);
    std::vector<PetscInt> places;
    places.reserve(nodes.size() * g);
    for (const std::int64_t node : halo().numbers(nodes))
      for (int k = 0; k < g; ++k)
        places.push_back(static_cast<PetscInt>(g * node + k));
    return places;
  }

  /// A matrix of entries in this rank's numbers. Entries of one place are
  /// added, over all ranks.
  void make(petsc::OwnMat& A, const contactx::Triplets& entries,
            std::span<const PetscInt> places) const
  {
    const auto n = static_cast<PetscInt>(num_owned());
    std::vector<PetscInt> rows, columns;
    for (std::size_t e = 0; e < entries.size(); ++e)
    {
      rows.push_back(places[entries.rows[e]]);
      columns.push_back(places[entries.columns[e]]);
    }
    petsc::check(MatCreate(comm(), A.put()), "MatCreate");
    petsc::check(MatSetSizes(A.get(), n, n, PETSC_DETERMINE, PETSC_DETERMINE),
                 "MatSetSizes");
    petsc::check(MatSetType(A.get(), MATAIJ), "MatSetType");
    petsc::check(MatSetPreallocationCOO(A.get(),
                                        static_cast<PetscCount>(rows.size()),
                                        rows.data(), columns.data()),
                 "MatSetPreallocationCOO");
    petsc::check(MatSetValuesCOO(A.get(), entries.values.data(), ADD_VALUES),
                 "MatSetValuesCOO");
  }

  /// Adds one to a matrix that may have no place on its diagonal.
  void add_identity(petsc::OwnMat& A) const
  {
    contactx::Triplets ones;
    for (std::size_t i = 0; i < num_owned(); ++i)
      ones.add(static_cast<std::int32_t>(i), static_cast<std::int32_t>(i), 1);
    petsc::OwnMat I;
    make(I, ones, numbers());
    petsc::check(MatAXPY(A.get(), 1, I.get(), DIFFERENT_NONZERO_PATTERN),
                 "MatAXPY");
  }

  MPI_Comm comm() const
  {
    MPI_Comm comm = MPI_COMM_NULL;
    petsc::check(
        PetscObjectGetComm(
            reinterpret_cast<PetscObject>(_assembler->bulk()->matrix()), &comm),
        "PetscObjectGetComm");
    return comm;
  }

  bool anywhere(bool here) const
  {
    return contactx::mesh::anywhere(halo().ranks(), here);
  }

  /// Makes the matrices of an iterate.
  void prepare(contactx::condense::Condensation&& made)
  {
    const std::vector<PetscInt> places = numbers();
    _system.emplace(std::move(made), contactx::condense::is_symmetric(
                                         made.elimination(), halo()));
    System& system = *_system;
    const contactx::condense::Condensation& condensation = system.condensation;
    const contactx::condense::Elimination& elimination
        = condensation.elimination();

    // Stiffness of bulk, contact and springs; that of a linear bulk stays whole
    ::Mat K = _assembler->bulk()->matrix();
    const auto& springs = _assembler->loop().free_bodies().springs();
    const bool has_contact = anywhere(condensation.stiffness().size() > 0);
    if (has_contact or anywhere(springs.has_value()))
    {
      petsc::check(MatDuplicate(K, MAT_COPY_VALUES, system.stiff.put()),
                   "MatDuplicate");
      K = system.stiff.get();
      if (has_contact)
      {
        petsc::OwnMat S;
        make(S, condensation.stiffness(), places);
        petsc::check(MatAXPY(K, 1, S.get(), DIFFERENT_NONZERO_PATTERN),
                     "MatAXPY");
      }
      if (springs)
      {
        petsc::OwnVec diagonal;
        petsc::check(MatCreateVecs(K, diagonal.put(), nullptr),
                     "MatCreateVecs");
        std::ranges::copy(*springs,
                          petsc::Values(diagonal.get()).span().begin());
        petsc::check(MatDiagonalSet(K, diagonal.get(), ADD_VALUES),
                     "MatDiagonalSet");
      }
    }

    system.K = K;
    for (auto* vector : {&system.v, &system.w})
      petsc::check(MatCreateVecs(K, vector->put(), nullptr), "MatCreateVecs");
    for (const std::int32_t dof : elimination.eliminated())
      system.eliminated.push_back(places[dof]);
    make(system.right, elimination.right(), places);
    if (anywhere(elimination.law().size() > 0))
      make(system.law, elimination.law(), places);
    if (not system.is_symmetric)
    {
      contactx::Triplets left = elimination.left();
      const contactx::Triplets& rows = elimination.rows();
      for (std::size_t e = 0; e < rows.size(); ++e)
        left.add(rows.rows[e], rows.columns[e], rows.values[e]);
      make(system.left, left, places);
    }
    const contactx::condense::DependentConstraints chains
        = contactx::condense::dependent_constraints(elimination, halo());
    make(system.of_right, chains.right, places);
    if (not system.is_symmetric)
      make(system.of_left, chains.left, places);
    make_matrix();
    make_product();
    set_up();
  }

  /// Makes the solver of what eliminations need of one another, if they do.
  void make(DependentConstraints& chains, const contactx::Triplets& entries,
            std::span<const PetscInt> places) const
  {
    if (not anywhere(entries.size() > 0))
      return;
    make(chains.C, entries, places);
    petsc::check(MatDuplicate(chains.C.get(), MAT_COPY_VALUES, chains.E.put()),
                 "MatDuplicate");
    petsc::check(MatScale(chains.E.get(), -1), "MatScale");
    add_identity(chains.E);
    petsc::check(KSPCreate(comm(), chains.ksp.put()), "KSPCreate");
    const KSP ksp = chains.ksp.get();
    petsc::check(KSPSetOperators(ksp, chains.E.get(), chains.E.get()),
                 "KSPSetOperators");
    petsc::check(KSPSetType(ksp, KSPGMRES), "KSPSetType");
    PC pc = nullptr;
    petsc::check(KSPGetPC(ksp, &pc), "KSPGetPC");
    petsc::check(PCSetType(pc, PCBJACOBI), "PCSetType");
    petsc::check(KSPSetTolerances(ksp, rounding, 0, PETSC_DEFAULT, most),
                 "KSPSetTolerances");
  }

  /// First terms of the series of (I - C)^-1 X.
  static void add_terms(const DependentConstraints& chains, petsc::OwnMat& X,
                        bool is_left)
  {
    if (not chains.any())
      return;
    const ::Mat C = chains.C.get();
    petsc::OwnMat term, next;
    petsc::check(MatDuplicate(X.get(), MAT_COPY_VALUES, term.put()),
                 "MatDuplicate");
    for (int k = 0; k < terms; ++k)
    {
      petsc::check(MatMatMult(is_left ? term.get() : C,
                              is_left ? C : term.get(), MAT_INITIAL_MATRIX,
                              PETSC_DETERMINE, next.put()),
                   "MatMatMult");
      petsc::check(MatAXPY(X.get(), 1, next.get(), DIFFERENT_NONZERO_PATTERN),
                   "MatAXPY");
      petsc::check(MatDuplicate(next.get(), MAT_COPY_VALUES, term.put()),
                   "MatDuplicate");
    }
  }

  /// Makes K_c, or a matrix near it.
  void make_matrix()
  {
    System& system = *_system;
    petsc::OwnMat right, half;
    petsc::check(MatDuplicate(system.right.get(), MAT_COPY_VALUES, right.put()),
                 "MatDuplicate");
    add_terms(system.of_right, right, false);
    add_identity(right);
    petsc::check(MatMatMult(system.K, right.get(), MAT_INITIAL_MATRIX,
                            PETSC_DETERMINE, half.put()),
                 "MatMatMult");
    if (system.is_symmetric)
      petsc::check(MatTransposeMatMult(right.get(), half.get(),
                                       MAT_INITIAL_MATRIX, PETSC_DETERMINE,
                                       system.A.put()),
                   "MatTransposeMatMult");
    else
    {
      petsc::OwnMat left;
      petsc::check(MatDuplicate(system.left.get(), MAT_COPY_VALUES, left.put()),
                   "MatDuplicate");
      add_terms(system.of_left, left, true);
      add_identity(left);
      petsc::check(MatMatMult(left.get(), half.get(), MAT_INITIAL_MATRIX,
                              PETSC_DETERMINE, system.A.put()),
                   "MatMatMult");
    }
    if (system.law.get())
    {
      petsc::OwnMat rows;
      petsc::check(MatMatMult(system.law.get(), right.get(), MAT_INITIAL_MATRIX,
                              PETSC_DETERMINE, rows.put()),
                   "MatMatMult");
      petsc::check(
          MatAXPY(system.A.get(), 1, rows.get(), DIFFERENT_NONZERO_PATTERN),
          "MatAXPY");
    }
    // Rows without neighbours: multigrid leaves them out, and as they are zero
    // on the right they stay zero in what is found
    petsc::check(
        MatZeroRowsColumns(system.A.get(),
                           static_cast<PetscInt>(system.eliminated.size()),
                           system.eliminated.data(), 0, nullptr, nullptr),
        "MatZeroRowsColumns");
  }

  /// Makes K_c as a product, where its matrix is only near it.
  void make_product()
  {
    System& system = *_system;
    if (not system.of_right.any() and not system.of_left.any())
      return;
    const auto n = static_cast<PetscInt>(num_owned());
    petsc::check(MatCreateShell(comm(), n, n, PETSC_DETERMINE, PETSC_DETERMINE,
                                this, system.product.put()),
                 "MatCreateShell");
    petsc::check(MatShellSetOperation(
                     system.product.get(), MATOP_MULT,
                     reinterpret_cast<void (*)()>(&Condensed::multiply)),
                 "MatShellSetOperation");
  }

  static PetscErrorCode multiply(::Mat A, ::Vec x, ::Vec y)
  {
    void* context = nullptr;
    if (const PetscErrorCode error = MatShellGetContext(A, &context))
      return error;
    // Nothing may be thrown through PETSc
    try
    {
      auto& self = *static_cast<Condensed*>(context);
      System& system = *self._system;
      const ::Vec u = system.v.get(), w = system.w.get();
      self.expand(x, u);
      petsc::check(MatMult(system.K, u, w), "MatMult");
      self.combine(w, y);
      if (system.law.get())
        petsc::check(MatMultAdd(system.law.get(), u, y, y), "MatMultAdd");
      self.clear_eliminated(y);
      return PETSC_SUCCESS;
    }
    catch (const std::exception&)
    {
      return PETSC_ERR_LIB;
    }
  }

  /// u = (I + right) v
  void expand(::Vec v, ::Vec u) const
  {
    const System& system = *_system;
    petsc::check(MatMult(system.right.get(), v, u), "MatMult");
    solve(system.of_right, u, false);
    petsc::check(VecAXPY(u, 1, v), "VecAXPY");
  }

  /// y = (I + left) w; w is overwritten by rows with one multiplier each
  void combine(::Vec w, ::Vec y) const
  {
    const System& system = *_system;
    petsc::check(VecCopy(w, y), "VecCopy");
    release(w);
    if (system.is_symmetric)
      petsc::check(MatMultTransposeAdd(system.right.get(), w, y, y),
                   "MatMultTransposeAdd");
    else
      petsc::check(MatMultAdd(system.left.get(), w, y, y), "MatMultAdd");
  }

  /// Makes rows that give multipliers have one each.
  void release(::Vec w) const
  {
    const System& system = *_system;
    solve(system.is_symmetric ? system.of_right : system.of_left, w,
          system.is_symmetric);
  }

  /// Solves (I - C) x = x, with C transposed or not.
  static void solve(const DependentConstraints& chains, ::Vec x,
                    bool is_transposed)
  {
    if (not chains.any())
      return;
    petsc::OwnVec b;
    petsc::check(VecDuplicate(x, b.put()), "VecDuplicate");
    petsc::check(VecCopy(x, b.get()), "VecCopy");
    const KSP ksp = chains.ksp.get();
    petsc::check(is_transposed ? KSPSolveTranspose(ksp, b.get(), x)
                               : KSPSolve(ksp, b.get(), x),
                 "KSPSolve");
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    petsc::check(KSPGetConvergedReason(ksp, &reason), "KSPGetConvergedReason");
    // A solve that fails leaves no solution, which its residual shows
    if (reason < 0)
      petsc::check(VecSet(x, std::numeric_limits<double>::quiet_NaN()),
                   "VecSet");
  }

  void clear_eliminated(::Vec x) const
  {
    const petsc::Values values(x);
    for (const std::int32_t dof :
         _system->condensation.elimination().eliminated())
      values.span()[dof] = 0;
  }

  /// Solves the system of an iterate; whether the iterations converged.
  bool apply(::Vec b, ::Vec dx, double target)
  {
    System& system = *_system;
    const contactx::condense::Condensation& condensation = system.condensation;
    const contactx::condense::Elimination& elimination
        = condensation.elimination();
    const ::Mat K = system.K;
    const std::size_t n = num_owned();
    const int g = halo().gdim();

    // Right-hand side
    const petsc::ConstValues given(b);
    contactx::condense::Condensation::RightHandSide right
        = condensation.right_hand_side(given.span().subspan(n));
    halo().reverse(right.forces, g);
    petsc::OwnVec w, h, work, rhs, v, balance;
    for (auto* vector : {&w, &h, &work, &rhs, &v})
      petsc::check(MatCreateVecs(K, vector->put(), nullptr), "MatCreateVecs");
    {
      const petsc::Values force(w.get()), start(h.get());
      for (std::size_t i = 0; i < n; ++i)
      {
        force.span()[i] = given.span()[i] + right.forces[i];
        start.span()[i] = right.shift[i];
      }
    }
    solve(system.of_right, h.get(), false);
    petsc::check(VecDuplicate(w.get(), balance.put()), "VecDuplicate");
    petsc::check(VecCopy(w.get(), balance.get()), "VecCopy");
    petsc::check(MatMult(K, h.get(), work.get()), "MatMult");
    petsc::check(VecAXPY(w.get(), -1, work.get()), "VecAXPY");
    combine(w.get(), rhs.get());
    if (system.law.get())
    {
      petsc::check(MatMult(system.law.get(), h.get(), work.get()), "MatMult");
      petsc::check(VecAXPY(rhs.get(), -1, work.get()), "VecAXPY");
    }
    {
      const petsc::Values values(rhs.get());
      for (std::size_t i = 0; i < n; ++i)
        values.span()[i] += right.extra[i];
    }
    clear_eliminated(rhs.get());
    if (not iterate(rhs.get(), v.get(), target))
      return false;

    // Displacements, and what they leave for the multipliers
    expand(v.get(), work.get());
    petsc::check(VecAXPY(h.get(), 1, work.get()), "VecAXPY");
    petsc::check(MatMult(K, h.get(), work.get()), "MatMult");
    petsc::check(VecAXPY(balance.get(), -1, work.get()), "VecAXPY");
    release(balance.get());
    std::vector<double> u(_free.size());
    std::ranges::copy(petsc::ConstValues(h.get()).span(), u.begin());
    halo().forward(std::span(u), g);
    condensation.recover(given.span().subspan(n),
                         petsc::ConstValues(balance.get()).span(), u,
                         right.multipliers);
    const petsc::Values x(dx);
    for (std::size_t i = 0; i < n; ++i)
      x.span()[i] = _free[i] ? u[i] : given.span()[i];
    for (std::size_t i = 0; i < right.multipliers.size(); ++i)
      x.span()[n + i] = right.multipliers[i] / this->system().factors()[i];
    return true;
  }

  /// Hands the matrix to the Krylov solver. The preconditioner of an older one
  /// stays while it serves: until iterations are twice as many as with it new.
  void set_up()
  {
    System& system = *_system;
    if (_ksp.get() == nullptr)
    {
      petsc::check(KSPCreate(comm(), _ksp.put()), "KSPCreate");
      petsc::check(KSPSetOptionsPrefix(_ksp.get(), _prefix.c_str()),
                   "KSPSetOptionsPrefix");
      PC pc = nullptr;
      petsc::check(KSPGetPC(_ksp.get(), &pc), "KSPGetPC");
      petsc::check(PCSetType(pc, PCGAMG), "PCSetType");
    }
    const KSP ksp = _ksp.get();
    petsc::check(KSPSetType(ksp, system.is_symmetric ? KSPCG : KSPGMRES),
                 "KSPSetType");
    petsc::check(KSPSetPCSide(ksp, system.is_symmetric ? PC_LEFT : PC_RIGHT),
                 "KSPSetPCSide");
    petsc::check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED),
                 "KSPSetNormType");
    petsc::check(KSPSetFromOptions(ksp), "KSPSetFromOptions");
    system.is_new = _last > 2 * _first + 10;
    petsc::check(KSPSetReusePreconditioner(ksp, system.is_new ? PETSC_FALSE
                                                              : PETSC_TRUE),
                 "KSPSetReusePreconditioner");
    if (system.is_new)
      set_near_null_space(system.A.get());
    set_operators();
  }

  void set_operators() const
  {
    const System& system = *_system;
    const ::Mat A = system.A.get();
    petsc::check(
        KSPSetOperators(_ksp.get(),
                        system.product.get() ? system.product.get() : A, A),
        "KSPSetOperators");
  }

  /// Solves K_c v = rhs; whether the iterations converged.
  bool iterate(::Vec rhs, ::Vec v, double target)
  {
    const KSP ksp = _ksp.get();
    petsc::check(KSPSetTolerances(ksp, rounding, target, PETSC_DEFAULT, most),
                 "KSPSetTolerances");
    petsc::check(VecZeroEntries(v), "VecZeroEntries");
    const KSPConvergedReason reason = run(rhs, v);
    if (reason > 0 or _system->is_new)
    {
      if (std::exchange(_system->is_new, false))
        _first = _last;
      return reason > 0;
    }
    // It may with a preconditioner of its own
    _system->is_new = true;
    petsc::check(KSPSetReusePreconditioner(ksp, PETSC_FALSE),
                 "KSPSetReusePreconditioner");
    set_near_null_space(_system->A.get());
    set_operators();
    petsc::check(VecZeroEntries(v), "VecZeroEntries");
    return iterate(rhs, v, target);
  }

  KSPConvergedReason run(::Vec rhs, ::Vec v)
  {
    const KSP ksp = _ksp.get();
    petsc::check(KSPSolve(ksp, rhs, v), "KSPSolve");
    PetscInt count = 0;
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    petsc::check(KSPGetIterationNumber(ksp, &count), "KSPGetIterationNumber");
    petsc::check(KSPGetConvergedReason(ksp, &reason), "KSPGetConvergedReason");
    _iterations += static_cast<int>(count);
    _last = static_cast<int>(count);
    // An older preconditioner has other rows of eliminated displacements
    clear_eliminated(v);
    return reason;
  }

  /// Rigid modes, zero where displacements are prescribed or eliminated.
  void set_near_null_space(::Mat A) const
  {
    const int g = halo().gdim();
    petsc::check(MatSetBlockSize(A, g), "MatSetBlockSize");
    petsc::OwnVec x;
    petsc::check(MatCreateVecs(A, x.put(), nullptr), "MatCreateVecs");
    petsc::check(VecSetBlockSize(x.get(), g), "VecSetBlockSize");
    {
      const std::span<const double> X = halo().reference().first(num_owned());
      // About the origin of a far body rotations are all but translations
      std::vector<double> middle(g + 1, 0);
      for (std::size_t i = 0; i < X.size(); ++i)
        middle[i % g] += X[i];
      middle[g] = static_cast<double>(X.size() / g);
      halo().ranks().reduce(std::span<double>(middle),
                            contactx::mesh::Reduction::sum);
      const petsc::Values values(x.get());
      for (std::size_t i = 0; i < X.size(); ++i)
        values.span()[i] = X[i] - middle[i % g] / middle[g];
    }
    MatNullSpace rigid = nullptr, near = nullptr;
    petsc::check(MatNullSpaceCreateRigidBody(x.get(), &rigid),
                 "MatNullSpaceCreateRigidBody");
    PetscInt count = 0;
    const ::Vec* modes = nullptr;
    petsc::check(MatNullSpaceGetVecs(rigid, nullptr, &count, &modes),
                 "MatNullSpaceGetVecs");
    // PETSc lets nobody change its own
    std::vector<::Vec> mine(count);
    for (PetscInt m = 0; m < count; ++m)
    {
      petsc::check(VecDuplicate(modes[m], &mine[m]), "VecDuplicate");
      petsc::check(VecCopy(modes[m], mine[m]), "VecCopy");
      const petsc::Values values(mine[m]);
      for (std::size_t i = 0; i < values.span().size(); ++i)
        if (not _free[i])
          values.span()[i] = 0;
    }
    petsc::check(
        MatNullSpaceCreate(comm(), PETSC_FALSE, count, mine.data(), &near),
        "MatNullSpaceCreate");
    petsc::check(MatSetNearNullSpace(A, near), "MatSetNearNullSpace");
    for (::Vec& mode : mine)
      petsc::check(VecDestroy(&mode), "VecDestroy");
    petsc::check(MatNullSpaceDestroy(&rigid), "MatNullSpaceDestroy");
    petsc::check(MatNullSpaceDestroy(&near), "MatNullSpaceDestroy");
  }

  /// Assembles the Jacobian as it is.
  void make_jacobian()
  {
    if (_J.get() == nullptr)
      *_J.put() = _assembler->create_matrix();
    _assembler->jacobian(_assembler->x(), _J.get());
  }

  void solve_directly(::Vec b, ::Vec dx)
  {
    ++_direct;
    if (_lu.get() == nullptr)
    {
      petsc::check(KSPCreate(comm(), _lu.put()), "KSPCreate");
      petsc::check(
          KSPSetOptionsPrefix(_lu.get(), (_prefix + "direct_").c_str()),
          "KSPSetOptionsPrefix");
      petsc::set_lu(_lu.get());
      petsc::check(KSPSetFromOptions(_lu.get()), "KSPSetFromOptions");
    }
    make_jacobian();
    petsc::check(KSPSetOperators(_lu.get(), _J.get(), _J.get()),
                 "KSPSetOperators");
    petsc::check(KSPSolve(_lu.get(), b, dx), "KSPSolve");
  }

  // Relative residual that rounding allows, and Krylov iterations at most
  static constexpr double rounding = 1e-13;
  static constexpr int most = 500;
  // Terms of the series that stand for an inverse in multigrid's matrix
  static constexpr int terms = 2;

  Assembler* _assembler;
  std::string _prefix;
  contactx::solve::Accuracy _accuracy;
  OwnKSP _ksp, _lu;
  petsc::OwnMat _J;
  std::vector<std::int8_t> _free; // of the displacements of all nodes
  std::optional<System> _system;
  // Iterations with the preconditioner: the first and the last ones
  int _first = 0, _last = std::numeric_limits<int>::max();
  int _iterations = 0, _direct = 0, _failures = 0;
};
} // namespace contactx_dolfinx
