// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "bulk.h"
#include "conductance.h"
#include "contact.h"
#include <contactx/problem/checkpoint.h>
#include <contactx/problem/problem.h>
#include <petscksp.h>

/// @brief Contact beside the forms of DOLFINx 0.11: an adapter of the core,
/// without any rule of contact.
namespace contactx_dolfinx
{
using contactx::problem::ConvergenceError;
using contactx::problem::Settled;
using contactx::problem::StepPlan;
using contactx::problem::Tolerances;

class Jacobian;

/// @brief The system of a bulk and its contacts, for a Newton loop of one's
/// own.
///
/// The unknowns of a rank are the displacements of its nodes, as u has them,
/// followed by the multipliers of its slave nodes, one contact after the other,
/// divided by each node's factor c of the complementarity to be lengths, too.
/// A loop reads
///
///     Vec x = assembler.x();
///     assembler.begin_step();
///     while (not assembler.settle().converged)
///     {
///       assembler.residual(x, b);
///       assembler.jacobian(x, A);
///       KSPSolve(ksp, b, dx);
///       VecScale(dx, -1);
///       assembler.update(dx, assembler.limit(dx));
///     }
///     assembler.accept();
///
/// and where a ConvergenceError ends it `restore` goes back to the step's
/// start. Pairs and status change at accepted iterates alone, no step turns
/// cells inside out, and a converged iterate is audited before it is accepted.
///
/// All ranks must call all functions, in the same order.
class Assembler
{
public:
  /// @brief What becomes of a converged iterate whose geometry is wrong: nodes
  /// went through the other side, a master reaches through slave facets between
  /// their nodes, or cells are turned inside out.
  enum class Audit : std::int8_t
  {
    refuse, ///< `settle` throws a ConvergenceError
    warn    ///< it is accepted, and what was found is among the warnings
  };

  /// @brief Couple a bulk with contacts.
  /// @param[in] F Residual of the bulk, linear in its test function.
  /// @param[in] J Its derivative by the displacement.
  /// @param[in] u Displacement, in a Lagrange space of vectors of degree 1
  /// or 2.
  /// @param[in] bcs Dirichlet conditions, whose values may change from step to
  /// step.
  /// @param[in] contacts Contacts, at least one.
  /// @param[in] audit What becomes of a converged iterate whose geometry is
  /// wrong.
  /// @throws std::invalid_argument on all ranks if they do not fit: a form is
  /// null, of another space or does not depend on u, a condition is of another
  /// space, a surface is none of the boundary.
  Assembler(std::shared_ptr<const Form> F, std::shared_ptr<const Form> J,
            std::shared_ptr<Function> u,
            std::vector<std::shared_ptr<const DirichletBC>> bcs,
            std::vector<std::shared_ptr<Contact>> contacts,
            Audit audit = Audit::refuse);

  /// @brief Couple a bulk of several fields with contacts: a mixed space, or a
  /// block of rows and columns a function.
  ///
  /// The unknowns of a rank are its displacements, then the other fields, one
  /// after the other, and its multipliers.
  /// @param[in] blocks Forms and functions.
  /// @param[in] bcs Dirichlet conditions on them.
  /// @param[in] contacts Contacts, at least one.
  /// @param[in] audit What becomes of a converged iterate whose geometry is
  /// wrong.
  /// @param[in] conductances Conductances across the contacts, of fields that
  /// are solved for.
  /// @throws std::invalid_argument as the other one does, and if a conductance
  /// is of another contact, or of a field that is not solved for.
  Assembler(const Blocks& blocks,
            std::vector<std::shared_ptr<const DirichletBC>> bcs,
            std::vector<std::shared_ptr<Contact>> contacts,
            Audit audit = Audit::refuse,
            std::vector<std::shared_ptr<Conductance>> conductances = {});

  ~Assembler();
  Assembler(const Assembler&) = delete;
  Assembler& operator=(const Assembler&) = delete;

  /// @brief A vector of all unknowns, which the caller destroys.
  ::Vec create_vector() const;

  /// @brief A matrix of all unknowns for `J`, which the caller destroys.
  ::Mat create_matrix() const;

  /// @brief The unknowns of now. It belongs to the assembler.
  ::Vec x() const;

  /// @brief Take a whole load step from u, with the loads and Dirichlet values
  /// of now: Newton's method, once more with damped steps where full ones do
  /// not converge. The state is that of before where it fails.
  /// @param[in] solver Solver of the Jacobian, such as a KSPSolver or a
  /// Condensed.
  /// @param[in] tolerances When iterations end.
  /// @throws ConvergenceError if it does not converge.
  /// @throws std::invalid_argument as `begin_step` does.
  void solve(contactx::problem::LinearSolver& solver,
             const Tolerances& tolerances = {});

  /// @brief Take the next of some load steps, and shorter ones until one
  /// converges:
  ///
  ///     StepPlan plan(StepPlan::equal(10));
  ///     while (not plan.finished())
  ///     {
  ///       assembler.advance(plan, update, solver);
  ///       // results are those at plan.t()
  ///     }
  /// @param[in,out] plan The load steps.
  /// @param[in] update Sets loads and Dirichlet values for a t.
  /// @param[in] solver Solver of the Jacobian.
  /// @param[in] tolerances When iterations end.
  /// @param[in] log Called with each attempt.
  /// @throws ConvergenceError if the shortest step does not converge; plan and
  /// state are then those of before.
  void advance(StepPlan& plan, const std::function<void(double t)>& update,
               contactx::problem::LinearSolver& solver,
               const Tolerances& tolerances = {},
               const contactx::problem::StepLog& log = {});

  /// @brief Start a load step from u, with the loads and Dirichlet values of
  /// now.
  /// @throws ConvergenceError if the residual is not finite.
  /// @throws std::invalid_argument if Dirichlet conditions keep slave nodes
  /// inside a rigid obstacle, or values of a contact do not fit.
  void begin_step();

  /// @brief Return to where the last step began, bit for bit, with all
  /// contacts: where it does not converge, and shorter ones may.
  void restore();

  /// @brief Go on from the state of another run, as a Checkpoint has it.
  /// @param[in] checkpoint Checkpoint of this problem.
  /// @param[in] state The state; functions have their values of it.
  /// @throws std::invalid_argument on all ranks if they do not fit.
  void take(const contactx::problem::Checkpoint& checkpoint,
            const contactx::problem::Checkpoint::State& state);

  /// @brief Update pairs and active set at an accepted iterate, and judge its
  /// residual.
  ///
  /// The iterate may change by a little: where iterates go round, part of the
  /// last step is taken back, and so is what free bodies have drifted by.
  /// @param[in] rtol Tolerance relative to the forces of the problem.
  /// @param[in] atol Absolute tolerance, a force.
  /// @param[in] max_it Most linear solves of the step.
  /// @throws ConvergenceError if no solution is to be expected any more.
  const Settled& settle(double rtol = 1e-11, double atol = 0, int max_it = 50);

  /// @brief Assemble the residual of bulk and contacts. Rows of Dirichlet
  /// conditions are displacements minus prescribed ones.
  /// @param[in] x Unknowns: the state becomes this.
  /// @param[out] b Residual.
  void residual(::Vec x, ::Vec b);

  /// @brief Assemble the Jacobian of bulk and contacts: a saddle point.
  ///
  /// Its pattern is another one where pairs have changed, which KSP notices.
  /// @param[in] x Unknowns: the state becomes this.
  /// @param[out] A Jacobian, a matrix of `create_matrix`.
  void jacobian(::Vec x, ::Mat A);

  /// @brief Give a KSP of one's own the Jacobian of the iterate that has
  /// settled last.
  /// @param[in] ksp The solver.
  /// @throws std::logic_error if none has settled since the last step was
  /// taken.
  void set_up(::KSP ksp);

  /// @brief Part of a step that may be taken.
  ///
  /// No cell may turn inside out. Zero means that the iterate stays, and that
  /// the next residual is another one: of the corrector of an interior point,
  /// by the same Jacobian, or with bodies that are held.
  /// @param[in] dx Increment of the unknowns.
  /// @return Part of it, at most 1.
  double limit(::Vec dx)
  {
    return _problem->limit(petsc::ConstValues(dx).span());
  }

  /// @brief Add a step to the unknowns: to u and the contacts' multipliers.
  /// @param[in] dx The step.
  /// @param[in] part Part of it.
  void update(::Vec dx, double part = 1);

  /// @brief Take the solution as the start of the next step.
  /// @throws std::logic_error if the iterate that has settled last is none.
  /// @throws std::invalid_argument if a level set that is touched with friction
  /// has moved.
  void accept();

  /// @brief Report of the step: iterates, what the audit has found, totals.
  const contactx::problem::Report& report() const { return _problem->report(); }

  /// @brief What the last solution is warned of, a sentence each, the same on
  /// all ranks.
  const std::vector<std::string>& warnings() const { return report().warnings; }

  /// @brief The core's driver of a step.
  contactx::problem::Problem& problem() { return *_problem; }

  /// @brief The core's loop.
  const contactx::solve::Loop& loop() const { return _problem->loop(); }

  /// @brief The core's system.
  const std::shared_ptr<contactx::solve::System>& system() const
  {
    return _system;
  }

  /// @brief The contacts.
  const std::vector<std::shared_ptr<Contact>>& contacts() const
  {
    return _contacts;
  }

  /// @brief The bulk.
  const std::shared_ptr<Bulk>& bulk() const { return _bulk; }

  /// @brief Nodes of this rank, those of other ranks that pairs need included.
  const std::shared_ptr<contactx::mesh::Halo>& halo() const { return _halo; }

  /// @brief Linear solves of the step so far.
  int number() const { return _problem->number(); }

private:
  void
  check(const std::vector<std::shared_ptr<Conductance>>& conductances) const;
  void check_cells() const;
  MPI_Comm comm() const { return _u->function_space()->mesh()->comm(); }
  void show() const;
  void pack() const { _system->unknowns(petsc::Values(_x->get()).span()); }
  void take(::Vec x);

  std::shared_ptr<Function> _u;
  std::vector<std::shared_ptr<Contact>> _contacts;
  std::shared_ptr<contactx::mesh::Halo> _halo;
  // Lives as long as the halo, which owns it
  std::shared_ptr<HaloAdapter> _adapter;
  std::shared_ptr<Bulk> _bulk;
  std::shared_ptr<contactx::solve::System> _system;
  std::unique_ptr<contactx::problem::Problem> _problem;
  std::unique_ptr<Jacobian> _jacobian;
  std::unique_ptr<petsc::OwnVec> _x;
  std::unique_ptr<petsc::OwnMat> _A; // that of `set_up`
};

/// @brief Solves with the Jacobian of an assembler, a saddle point, by a KSP of
/// the user's.
class KSPSolver final : public contactx::problem::LinearSolver
{
public:
  /// @brief Take a solver.
  /// @param[in] assembler The system; it must outlive this.
  /// @param[in] ksp The solver, as its options set it; it must outlive this.
  KSPSolver(Assembler& assembler, ::KSP ksp);

  void update() override { _assembler->set_up(_ksp); }
  void solve(std::span<const double> b, std::span<double> x) override;

private:
  Assembler* _assembler;
  ::KSP _ksp;
  petsc::OwnVec _b, _x;
};
} // namespace contactx_dolfinx
