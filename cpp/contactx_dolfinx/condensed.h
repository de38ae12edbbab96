// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include <contactx/condense/chains.h>
#include <contactx/condense/condensation.h>
#include <contactx/newton/accuracy.h>
#include <petscksp.h>
#include <string>

namespace contactx::dolfinx
{
/// @brief Solves the system of the Jacobian with the multipliers eliminated.
///
/// The displacements that are left follow from
///
///     K_c = (I + left) (K + S) (I + right) + law (I + right),
///
/// see condense::Condensation, which is made as a matrix, and are found by CG,
/// or GMRES where friction slips, with PETSc's algebraic multigrid. A loop
/// reads as with `Assembler::J`, but for the linear solve:
///
///     Condensed condensed(assembler, "condensed_");
///     ...
///       assembler.F(x, b);
///       condensed.solve(b, dx);
///
/// Each solve is as accurate as the next residual will show. Where slave nodes
/// stand for others of their facets, as in surface-to-surface contact that
/// slides, K_c is nearly that of the Jacobian, and FGMRES corrects it. What
/// cannot be condensed goes to a direct solver of the saddle point: nodes that
/// are slave here and master there, and what multigrid does not converge for.
/// All ranks must take part in everything.
class Condensed
{
public:
  /// @brief Create the solver.
  /// @param[in] assembler The system; it must outlive the solver.
  /// @param[in] prefix Prefix of PETSc's options of the Krylov solver and its
  /// preconditioner; with `direct_` behind it those of the direct solver.
  Condensed(Assembler& assembler, const std::string& prefix)
      : _assembler(&assembler), _prefix(prefix),
        _accuracy(has_path(*assembler.system()))
  {
  }

  /// @brief Solve J dx = b at the iterate that has settled last.
  /// @param[in] b Right-hand side in all unknowns.
  /// @param[out] dx Solution.
  void solve(::Vec b, ::Vec dx)
  {
    const newton::Loop& loop = _assembler->loop();
    if (_assembler->number() == 0)
      _accuracy.begin_step();
    const newton::Iterate& now = loop.iterate();
    _accuracy.set(now.residual, now.tolerance, loop.changing(),
                  loop.active_set().cycles() > 0);
    // What does not converge twice will not, and each attempt is dear
    if (_failures < 2)
    {
      if (auto condensation = condense(b))
      {
        prepare(std::move(*condensation));
        const bool is_exact = parallel::everywhere(
            halo().ranks(), _system->condensation.is_exact());
        const bool is_solved
            = is_exact ? apply(b, dx, _accuracy.target()) : correct(b, dx);
        _system.reset();
        if (is_solved)
          return;
        ++_failures;
      }
    }
    solve_directly(b, dx);
  }

  /// @brief Krylov iterations so far.
  int iterations() const { return _iterations; }

  /// @brief Solves that went to the direct solver so far.
  int direct() const { return _direct; }

private:
  using OwnKSP = petsc::Owner<KSP, KSPDestroy>;

  /// The system of an iterate without multipliers, and the way there and back.
  struct System
  {
    System(condense::Condensation&& made, bool is_symmetric)
        : condensation(std::move(made)), is_symmetric(is_symmetric)
    {
    }

    condense::Condensation condensation;
    bool is_symmetric;
    std::vector<PetscInt> eliminated;
    ::Mat K = nullptr; // the bulk's, or stiff
    petsc::OwnMat stiff, right, left, law, A;
    bool is_new = true;
  };

  static bool has_path(const newton::System& system)
  {
    return std::ranges::any_of(system.contacts(), [](const auto& c)
                               { return c->history() != nullptr; });
  }

  const newton::System& system() const { return *_assembler->system(); }
  parallel::Halo& halo() const { return *system().halo(); }
  std::size_t num_owned() const { return system().num_displacements(); }

  /// Eliminates the multipliers; nothing on all ranks where that cannot be.
  std::optional<condense::Condensation> condense(::Vec b)
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

    std::vector<condense::Nodes> nodes;
    for (const auto& contact : system().contacts())
      nodes.push_back(condense::nodes_of(*contact));
    const std::vector<std::int8_t> is_slave
        = condense::slave_marks(halo(), nodes);
    std::optional<condense::Condensation> made;
    {
      const petsc::ConstValues values(b);
      const auto d = values.span().subspan(num_owned());
      halo().ranks().agree(
          [&]
          {
            const condense::ContactBlock block(system().contacts(), prescribed,
                                               false, d);
            try
            {
              made.emplace(block.entries(), nodes, is_slave, _free, g);
            }
            catch (const condense::NotCondensable&)
            {
              made.reset();
            }
          });
    }
    if (not parallel::everywhere(halo().ranks(), made.has_value()))
      return std::nullopt;
    try
    {
      condense::check_chains(made->elimination(), halo());
    }
    catch (const condense::NotCondensable&)
    {
      return std::nullopt;
    }
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

  /// A matrix of entries in this rank's numbers, with ones on the diagonal if
  /// wanted. Entries of one place are added, over all ranks.
  void make(petsc::OwnMat& A, const Triplets& entries,
            std::span<const PetscInt> places, bool has_identity) const
  {
    const auto n = static_cast<PetscInt>(num_owned());
    std::vector<PetscInt> rows, columns;
    std::vector<double> values(entries.values);
    for (std::size_t e = 0; e < entries.size(); ++e)
    {
      rows.push_back(places[entries.rows[e]]);
      columns.push_back(places[entries.columns[e]]);
    }
    for (PetscInt i = 0; has_identity and i < n; ++i)
    {
      rows.push_back(places[i]);
      columns.push_back(places[i]);
      values.push_back(1);
    }
    petsc::check(MatCreate(comm(), A.put()), "MatCreate");
    petsc::check(MatSetSizes(A.get(), n, n, PETSC_DETERMINE, PETSC_DETERMINE),
                 "MatSetSizes");
    petsc::check(MatSetType(A.get(), MATAIJ), "MatSetType");
    petsc::check(MatSetPreallocationCOO(A.get(),
                                        static_cast<PetscCount>(rows.size()),
                                        rows.data(), columns.data()),
                 "MatSetPreallocationCOO");
    petsc::check(MatSetValuesCOO(A.get(), values.data(), ADD_VALUES),
                 "MatSetValuesCOO");
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
    return parallel::anywhere(halo().ranks(), here);
  }

  /// Makes the matrices of an iterate.
  void prepare(condense::Condensation&& made)
  {
    const std::vector<PetscInt> places = numbers();
    _system.emplace(std::move(made),
                    condense::is_symmetric(made.elimination(), halo()));
    System& system = *_system;
    const condense::Condensation& condensation = system.condensation;
    const condense::Elimination& elimination = condensation.elimination();

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
        make(S, condensation.stiffness(), places, false);
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
    petsc::OwnMat half;
    make(system.right, elimination.right(), places, true);
    petsc::check(MatMatMult(K, system.right.get(), MAT_INITIAL_MATRIX,
                            PETSC_DETERMINE, half.put()),
                 "MatMatMult");
    if (system.is_symmetric)
      petsc::check(MatTransposeMatMult(system.right.get(), half.get(),
                                       MAT_INITIAL_MATRIX, PETSC_DETERMINE,
                                       system.A.put()),
                   "MatTransposeMatMult");
    else
    {
      make(system.left, elimination.left(), places, true);
      petsc::check(MatMatMult(system.left.get(), half.get(), MAT_INITIAL_MATRIX,
                              PETSC_DETERMINE, system.A.put()),
                   "MatMatMult");
    }
    if (anywhere(elimination.law().size() > 0))
    {
      petsc::OwnMat rows;
      make(system.law, elimination.law(), places, false);
      petsc::check(MatMatMult(system.law.get(), system.right.get(),
                              MAT_INITIAL_MATRIX, PETSC_DETERMINE, rows.put()),
                   "MatMatMult");
      petsc::check(
          MatAXPY(system.A.get(), 1, rows.get(), DIFFERENT_NONZERO_PATTERN),
          "MatAXPY");
    }
    for (const std::int32_t dof : elimination.eliminated())
      system.eliminated.push_back(places[dof]);
    // Rows without neighbours: multigrid leaves them out, and as they are zero
    // on the right they stay zero in what is found
    petsc::check(
        MatZeroRowsColumns(system.A.get(),
                           static_cast<PetscInt>(system.eliminated.size()),
                           system.eliminated.data(), 0, nullptr, nullptr),
        "MatZeroRowsColumns");
    set_up();
  }

  /// Solves the system of an iterate; whether the iterations converged.
  bool apply(::Vec b, ::Vec dx, double target)
  {
    System& system = *_system;
    const condense::Condensation& condensation = system.condensation;
    const condense::Elimination& elimination = condensation.elimination();
    const ::Mat K = system.K;
    const std::size_t n = num_owned();
    const int g = halo().gdim();

    // Right-hand side
    const petsc::ConstValues given(b);
    auto [forces, shift, extra, multipliers]
        = condensation.right_hand_side(given.span().subspan(n));
    halo().reverse(forces, g);
    petsc::OwnVec w, h, work, rhs, v;
    for (auto* vector : {&w, &h, &work, &rhs, &v})
      petsc::check(MatCreateVecs(K, vector->put(), nullptr), "MatCreateVecs");
    {
      const petsc::Values force(w.get()), start(h.get());
      for (std::size_t i = 0; i < n; ++i)
      {
        force.span()[i] = given.span()[i] + forces[i];
        start.span()[i] = shift[i];
      }
    }
    std::vector<double> balance(n);
    std::ranges::copy(petsc::ConstValues(w.get()).span(), balance.begin());
    petsc::check(MatMult(K, h.get(), work.get()), "MatMult");
    petsc::check(VecAXPY(w.get(), -1, work.get()), "VecAXPY");
    if (system.is_symmetric)
      petsc::check(MatMultTranspose(system.right.get(), w.get(), rhs.get()),
                   "MatMultTranspose");
    else
      petsc::check(MatMult(system.left.get(), w.get(), rhs.get()), "MatMult");
    if (system.law.get())
    {
      petsc::check(MatMult(system.law.get(), h.get(), work.get()), "MatMult");
      petsc::check(VecAXPY(rhs.get(), -1, work.get()), "VecAXPY");
    }
    {
      const petsc::Values values(rhs.get());
      for (std::size_t i = 0; i < n; ++i)
        values.span()[i] += extra[i];
      for (const std::int32_t dof : elimination.eliminated())
        values.span()[dof] = 0;
    }
    if (not iterate(rhs.get(), v.get(), target))
      return false;

    // Displacements, and what they leave for the multipliers
    petsc::check(MatMultAdd(system.right.get(), v.get(), h.get(), h.get()),
                 "MatMultAdd");
    petsc::check(MatMult(K, h.get(), work.get()), "MatMult");
    std::vector<double> u(_free.size());
    {
      const petsc::ConstValues displacement(h.get()), force(work.get());
      std::ranges::copy(displacement.span(), u.begin());
      for (std::size_t i = 0; i < n; ++i)
        balance[i] -= force.span()[i];
    }
    halo().forward(std::span(u), g);
    condensation.recover(given.span().subspan(n), balance, u, multipliers);
    const petsc::Values x(dx);
    for (std::size_t i = 0; i < n; ++i)
      x.span()[i] = _free[i] ? u[i] : given.span()[i];
    for (std::size_t i = 0; i < multipliers.size(); ++i)
      x.span()[n + i] = multipliers[i] / this->system().factors()[i];
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
    const ::Mat A = system.A.get();
    if (system.is_new)
      set_near_null_space(A);
    petsc::check(KSPSetOperators(ksp, A, A), "KSPSetOperators");
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
    petsc::check(KSPSetOperators(ksp, _system->A.get(), _system->A.get()),
                 "KSPSetOperators");
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
    const petsc::Values values(v);
    for (const std::int32_t dof :
         _system->condensation.elimination().eliminated())
      values.span()[dof] = 0;
    return reason;
  }

  /// Solves J dx = b by FGMRES with what is nearly its inverse.
  bool correct(::Vec b, ::Vec dx)
  {
    PetscReal norm = 0;
    petsc::check(VecNorm(b, NORM_2, &norm), "VecNorm");
    const double target = _accuracy.finer_target();
    _part = std::max(0.1, norm > 0 ? 0.5 * target / norm : 1.0);
    _has_failed = false;
    make_jacobian();
    OwnKSP ksp;
    petsc::check(KSPCreate(comm(), ksp.put()), "KSPCreate");
    petsc::check(KSPSetType(ksp.get(), KSPFGMRES), "KSPSetType");
    petsc::check(
        KSPSetTolerances(ksp.get(), rounding, target, PETSC_DEFAULT, 30),
        "KSPSetTolerances");
    petsc::check(KSPSetOperators(ksp.get(), _J.get(), _J.get()),
                 "KSPSetOperators");
    PC pc = nullptr;
    petsc::check(KSPGetPC(ksp.get(), &pc), "KSPGetPC");
    petsc::check(PCSetType(pc, PCSHELL), "PCSetType");
    petsc::check(PCShellSetContext(pc, this), "PCShellSetContext");
    petsc::check(PCShellSetApply(pc, &Condensed::apply_nearly),
                 "PCShellSetApply");
    petsc::check(KSPSolve(ksp.get(), b, dx), "KSPSolve");
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    petsc::check(KSPGetConvergedReason(ksp.get(), &reason),
                 "KSPGetConvergedReason");
    return reason > 0 and not _has_failed;
  }

  static PetscErrorCode apply_nearly(PC pc, ::Vec b, ::Vec dx)
  {
    void* context = nullptr;
    if (const PetscErrorCode error = PCShellGetContext(pc, &context))
      return error;
    auto& self = *static_cast<Condensed*>(context);
    PetscReal norm = 0;
    if (const PetscErrorCode error = VecNorm(b, NORM_2, &norm))
      return error;
    // Nothing may be thrown through PETSc
    try
    {
      if (not self._has_failed and self.apply(b, dx, self._part * norm))
        return PETSC_SUCCESS;
    }
    catch (const std::exception&)
    {
    }
    self._has_failed = true;
    return VecZeroEntries(dx);
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
                            parallel::Reduction::sum);
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
    _assembler->J(_assembler->x(), _J.get());
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
      petsc::check(KSPSetType(_lu.get(), KSPPREONLY), "KSPSetType");
      PC pc = nullptr;
      petsc::check(KSPGetPC(_lu.get(), &pc), "KSPGetPC");
      petsc::check(PCSetType(pc, PCLU), "PCSetType");
#ifdef PETSC_HAVE_MUMPS
      petsc::check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS),
                   "PCFactorSetMatSolverType");
#endif
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

  Assembler* _assembler;
  std::string _prefix;
  newton::Accuracy _accuracy;
  OwnKSP _ksp, _lu;
  petsc::OwnMat _J;
  std::vector<std::int8_t> _free; // of the displacements of all nodes
  std::optional<System> _system;
  // Of a right-hand side that a solve of nearly the same system may leave
  double _part = 0;
  bool _has_failed = false;
  // Iterations with the preconditioner: the first and the last ones
  int _first = 0, _last = std::numeric_limits<int>::max();
  int _iterations = 0, _direct = 0, _failures = 0;
};
} // namespace contactx::dolfinx
