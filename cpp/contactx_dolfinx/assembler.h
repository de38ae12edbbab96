// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "contact.h"
#include "jacobian.h"
#include "snapshot.h"
#include <contactx/audit/audit.h>
#include <contactx/audit/deformed_cells.h>
#include <contactx/newton/loop.h>
#include <contactx/parallel/extent.h>
#include <contactx/parallel/found_nodes.h>
#include <contactx/text.h>

/// @brief Contact beside the forms of DOLFINx 0.11, compiled in the program
/// that uses it: an adapter of the core, without any rule of contact.
namespace contactx::dolfinx
{
/// @brief No solution is to be expected any more in a step.
class ConvergenceError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// @brief An iterate whose pairs and active set are those of it, as all ranks
/// see it.
struct Settled : newton::Iterate
{
  int number = 0;         ///< linear solves so far
  bool converged = false; ///< whether it is a solution
};

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
///       assembler.F(x, b);
///       assembler.J(x, A);
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
  /// @brief Couple a bulk with contacts.
  /// @param[in] F Residual of the bulk, linear in its test function.
  /// @param[in] J Its derivative by the displacement.
  /// @param[in] u Displacement, in a linear Lagrange space of vectors.
  /// @param[in] bcs Dirichlet conditions, whose values may change from step to
  /// step.
  /// @param[in] contacts Contacts, at least one.
  /// @throws std::invalid_argument on all ranks if they do not fit: a form is
  /// null, of another space or does not depend on u, a condition is of another
  /// space, a surface is none of the boundary.
  Assembler(std::shared_ptr<const Form> F, std::shared_ptr<const Form> J,
            std::shared_ptr<Function> u,
            std::vector<std::shared_ptr<const DirichletBC>> bcs,
            std::vector<std::shared_ptr<Contact>> contacts)
      : _u(std::move(u)), _contacts(std::move(contacts))
  {
    input::check_displacement(_u.get());
    input::check_forms(F.get(), J.get(), *_u);
    input::check_conditions(bcs, *_u);
    if (_contacts.empty())
      throw std::invalid_argument(
          "an Assembler needs at least one contact: pass one");
    for (std::size_t k = 0; k < _contacts.size(); ++k)
      if (_contacts[k] == nullptr)
        throw std::invalid_argument("contacts[" + std::to_string(k)
                                    + "] is null: give a Contact");
    const FunctionSpace& V = *_u->function_space();

    auto adapter = std::make_unique<HaloAdapter>(_u);
    _adapter = adapter.get();
    parallel::BulkNodes nodes = adapter->bulk_nodes();
    _halo = std::make_shared<parallel::Halo>(std::move(nodes),
                                             std::move(adapter));
    _bulk = std::make_shared<Bulk>(std::move(F), std::move(J), _u,
                                   std::move(bcs), _halo, *_adapter);
    const auto& topology = *V.mesh()->topology();
    const auto bodies = std::make_shared<contact::Bodies>(
        _bulk->all_cells(), _bulk->nodes_per_cell(),
        topology.index_map(topology.dim())->size_local(),
        _halo->original().first(_halo->num_bulk()), _halo);
    std::size_t count = 0;
    try
    {
      newton::System::Contacts discrete;
      for (; count < _contacts.size(); ++count)
        discrete.push_back(_contacts[count]->attach(_halo, bodies, *_bulk, V));
      _audit = std::make_unique<audit::Audit>(_halo, discrete);
      _system
          = std::make_shared<newton::System>(_halo, _bulk, std::move(discrete));
      _loop = std::make_unique<newton::Loop>(_system, bodies);
      _jacobian = std::make_unique<Jacobian>(_system, _bulk);
      _x = std::make_unique<petsc::OwnVec>(create_vector());
    }
    catch (...)
    {
      for (std::size_t k = 0; k < count; ++k)
        _contacts[k]->detach();
      throw;
    }
  }

  ~Assembler()
  {
    for (const auto& contact : _contacts)
      contact->detach();
  }
  Assembler(const Assembler&) = delete;
  Assembler& operator=(const Assembler&) = delete;

  /// @brief A vector of all unknowns, which the caller destroys.
  ::Vec create_vector() const
  {
    ::Vec x = nullptr;
    petsc::check(VecCreateMPI(comm(), static_cast<PetscInt>(_system->size()),
                              PETSC_DETERMINE, &x),
                 "VecCreateMPI");
    return x;
  }

  /// @brief A matrix of all unknowns for `J`, which the caller destroys.
  ::Mat create_matrix() const
  {
    ::Mat A = nullptr;
    const auto size = static_cast<PetscInt>(_system->size());
    petsc::check(MatCreate(comm(), &A), "MatCreate");
    petsc::check(MatSetSizes(A, size, size, PETSC_DETERMINE, PETSC_DETERMINE),
                 "MatSetSizes");
    petsc::check(MatSetType(A, MATAIJ), "MatSetType");
    petsc::check(MatSetUp(A), "MatSetUp");
    return A;
  }

  /// @brief The unknowns of now, as of the last `begin_step`, `settle` or
  /// `update`. It belongs to the assembler.
  ::Vec x() const { return _x->get(); }

  /// @brief Start a load step from u, with the loads and Dirichlet values of
  /// now.
  /// @throws ConvergenceError if the residual is not finite.
  /// @throws std::invalid_argument if Dirichlet conditions keep slave nodes
  /// inside a rigid obstacle, or values of a contact do not fit.
  void begin_step()
  {
    _has_begun = _is_settled = _is_solution = false;
    _adapter->update_ghosts();
    read_values();
    check_kept();
    _before.emplace(*_u, _system->contacts());
    try
    {
      if (not _loop->begin_step(false))
        throw ConvergenceError("the residual is not finite at the start of the "
                               "step: the material fails, or a load is not "
                               "finite. Take smaller load steps, or repair "
                               "what sets it (manual: "
                               "errors/residual-not-finite)");
      _audit->begin_step();
      _loop->settle_first();
    }
    catch (...)
    {
      restore();
      throw;
    }
    pack();
    _number = 0;
    _has_begun = true;
  }

  /// @brief Return to where the last step began, bit for bit, with all
  /// contacts: where it does not converge, and shorter ones may.
  void restore()
  {
    if (_before)
      _before->restore(*_u, *_adapter);
    pack();
    _has_begun = _is_settled = _is_solution = false;
    // A failed step may have found the rigid modes of a spoilt stiffness
    if (not _has_accepted)
      _loop->reset();
  }

  /// @brief Update pairs and active set at an accepted iterate, and judge its
  /// residual.
  ///
  /// The iterate may change by a little: where iterates go round, part of the
  /// last step is taken back, and so is what free bodies have drifted by.
  /// @param[in] rtol Tolerance relative to the forces of the problem.
  /// @param[in] atol Absolute tolerance, a force.
  /// @param[in] max_it Most linear solves of the step.
  /// @throws ConvergenceError if no solution is to be expected any more.
  Settled settle(double rtol = 1e-11, double atol = 0, int max_it = 50)
  {
    require(_has_begun, "settle() before begin_step(): call that first");
    look_anew();
    if (_number > 0)
      read_values();
    std::vector<double> b(_system->size());
    const newton::Verdict verdict = _loop->judge(_number == 0, rtol, atol, b);
    // Iterates may have been taken back
    pack();
    if (const char* failure = reason(verdict))
      throw ConvergenceError(failure);
    _is_solution = verdict == newton::Verdict::solution;
    if (_is_solution)
      look_at_solution();
    else if (_number >= max_it)
      throw ConvergenceError(
          "no convergence in " + std::to_string(max_it) + " iterations: "
          + (_loop->is_homogeneous()
                 ? "smaller load steps would not help, as this step from "
                   "rest, of linear bodies without gaps, is the same for any "
                   "size of its load: take what presses the bodies together "
                   "first and what shears them afterwards, swap slave and "
                   "master, take the other method, or meshes that match or "
                   "are finer, or"
                 : "take smaller load steps, or")
          + " raise max_it (manual: errors/no-convergence)");
    _is_settled = true;
    return {_loop->iterate(), _number, _is_solution};
  }

  /// @brief Assemble the residual of bulk and contacts. Rows of Dirichlet
  /// conditions are displacements minus prescribed ones.
  /// @param[in] x Unknowns: the state becomes this.
  /// @param[out] b Residual.
  void F(::Vec x, ::Vec b)
  {
    require(_has_begun, "F() before begin_step(): call that first");
    take(x);
    // Loads may be others, as in arc-length methods
    _system->begin_step();
    _system->residual(petsc::Values(b).span());
  }

  /// @brief Assemble the Jacobian of bulk and contacts: a saddle point.
  ///
  /// Its pattern is another one where pairs have changed, which KSP notices.
  /// @param[in] x Unknowns: the state becomes this.
  /// @param[out] A Jacobian, a matrix of `create_matrix`.
  void J(::Vec x, ::Mat A)
  {
    require(_has_begun, "J() before begin_step(): call that first");
    take(x);
    _jacobian->assemble(A, _loop->free_bodies().springs());
  }

  /// @brief Part of a step that may be taken.
  ///
  /// No cell may turn inside out. Zero means that contact becomes soft before
  /// the next solve, where a step would open many nodes of slender bodies.
  /// @param[in] dx Increment of the unknowns.
  /// @return Part of it, at most 1.
  double limit(::Vec dx)
  {
    require(_is_settled, "limit() before settle(): call that first");
    const petsc::ConstValues values(dx);
    std::vector<double> step(values.span().begin(), values.span().end());
    for (double& s : step)
      s = -s;
    if (_loop->softens(step))
      return 0;
    _loop->foresee(step);
    const double size = _loop->size_of(step);
    _loop->length().begin(size,
                          std::isfinite(size) ? _loop->within_cells(step) : 1);
    return _loop->length().part();
  }

  /// @brief Add a step to the unknowns: to u and the contacts' multipliers.
  /// @param[in] dx The step.
  /// @param[in] part Part of it.
  void update(::Vec dx, double part = 1)
  {
    require(_has_begun, "update() before begin_step(): call that first");
    petsc::check(VecAXPY(_x->get(), part, dx), "VecAXPY");
    take(_x->get());
    ++_number;
    _is_settled = _is_solution = false;
  }

  /// @brief Take the solution as the start of the next step.
  /// @throws std::logic_error if the iterate that has settled last is none.
  void accept()
  {
    require(_is_solution, "accept() of an iterate that is no solution: go on "
                          "until settle() says converged, or restore()");
    _loop->accept();
    for (const auto& contact : _system->contacts())
      contact->accept();
    _audit->accept();
    _has_begun = _is_settled = _is_solution = false;
    _has_accepted = true;
  }

  /// @brief What the last solution is warned of, a sentence each, the same on
  /// all ranks: a slave that is coarse for an obstacle's radius, once.
  const std::vector<std::string>& warnings() const { return _warnings; }

  /// @brief The core's loop.
  const newton::Loop& loop() const { return *_loop; }

  /// @brief The core's system.
  const std::shared_ptr<newton::System>& system() const { return _system; }

  /// @brief The bulk.
  const std::shared_ptr<Bulk>& bulk() const { return _bulk; }

  /// @brief Linear solves of the step so far.
  int number() const { return _number; }

private:
  MPI_Comm comm() const { return _u->function_space()->mesh()->comm(); }

  static void require(bool is_in_order, const char* what)
  {
    if (not is_in_order)
      throw std::logic_error(what);
  }

  static const char* reason(newton::Verdict verdict)
  {
    switch (verdict)
    {
    case newton::Verdict::hidden:
      return "pairs went back and forth between facets and were frozen, and "
             "hide a penetration: refine the coarser surface there, or take "
             "smaller load steps (manual: errors/frozen-pairs)";
    case newton::Verdict::ran_away:
      return "a body that nothing holds has left the scene: support it "
             "(manual: errors/body-ran-away)";
    case newton::Verdict::turned:
      return "a body that nothing holds has turned so far that linear strains "
             "take it for a stretch: support it, or take a material with "
             "finite strains (manual: errors/body-turned)";
    case newton::Verdict::unbalanced:
      return "the loads on a body cannot be balanced: it has no support and "
             "nothing is in its way, or friction barely could. Support it, or "
             "turn the loads so that they press the bodies together (manual: "
             "errors/unbalanced-loads)";
    case newton::Verdict::not_finite:
      return "the residual is not finite: the material fails, or a body is "
             "free to move without touching anything. Take smaller load "
             "steps, or support the body (manual: "
             "errors/residual-not-finite)";
    case newton::Verdict::stuck:
      return "no step is short enough to lead on: take smaller load steps "
             "(manual: errors/no-step-leads-on)";
    default:
      return nullptr;
    }
  }

  /// Read what a user may have changed since the last call.
  void look_anew()
  {
    _adapter->update_ghosts();
    _system->begin_step();
  }

  void read_values()
  {
    _halo->ranks().agree(
        [this]
        {
          for (const auto& contact : _contacts)
            contact->read_values();
        });
  }

  void pack() { _system->unknowns(petsc::Values(_x->get()).span()); }

  void take(::Vec x)
  {
    const petsc::ConstValues values(x);
    _system->take(values.span());
  }

  /// Dirichlet conditions must keep no slave node inside a rigid obstacle.
  void check_kept()
  {
    std::vector<double> x = _bulk->prescribed();
    const std::span<const double> X = _halo->reference();
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += X[i];
    for (const auto& contact : _system->contacts())
    {
      const auto found
          = parallel::found_nodes(*_halo, contact->kept_inside(x), X);
      if (found.count == 0)
        continue;
      const Vector<3> size = parallel::extent(
          _halo->ranks(), contact->slaves().owned(), X, _halo->gdim());
      throw std::invalid_argument(
          "Dirichlet conditions constrain " + std::to_string(found.count)
          + " slave nodes inside a rigid obstacle, the first at "
          + point_text(found.at, *std::ranges::max_element(size))
          + ": take them out of the slave surface, or prescribe values outside "
            "of it (manual: errors/over-constrained)");
    }
  }

  /// Look at the geometry, which the residual does not see.
  void look_at_solution()
  {
    const double size = [this]
    {
      const auto sizes = parallel::extent(
          _halo->ranks(),
          _halo->reference().first(_system->num_displacements()),
          _halo->gdim());
      return *std::ranges::max_element(sizes);
    }();
    const auto looks = _audit->look();
    _warnings.clear();
    for (std::size_t k = 0; k < looks.size(); ++k)
    {
      const audit::Findings& found = looks[k];
      for (const std::string& text : found.warnings)
        _warnings.push_back("contact " + std::to_string(k) + ": " + text);
      if (not found.is_fault())
        continue;
      std::string text = "contact " + std::to_string(k) + ": ";
      std::string advice;
      if (found.passed.count > 0)
      {
        text += std::to_string(found.passed.count)
                + " nodes went through the other surface within the step";
        advice = ". Take smaller load steps (manual: errors/passed-through)";
      }
      else if (found.inside.count > 0)
      {
        text += std::to_string(found.inside.count)
                + " slave nodes are inside the master without a pair, the "
                  "first at "
                + point_text(found.inside.at, size);
        advice = ". Take smaller load steps, or start without the overlap "
                 "(manual: errors/nodes-inside)";
      }
      else
      {
        text += "the master reaches " + number_text(found.deepest->depth, 3)
                + " deep through a slave facet, between its nodes, at "
                + point_text(found.deepest->at, found.deepest->size)
                + ": the slave surface is too coarse to see it";
        advice = ". Swap slave and master, or refine the slave surface "
                 "(manual: errors/slave-too-coarse)";
      }
      throw ConvergenceError(text + advice);
    }
    if (_bulk->is_linear())
      return;
    const auto cells = audit::deformed_cells(
        _bulk->cells(), _bulk->nodes_per_cell(), _halo->reference(),
        _halo->displacement(), _halo->gdim());
    if (const auto inverted = parallel::total(_halo->ranks(), cells.inverted);
        inverted > 0)
      throw ConvergenceError(std::to_string(inverted)
                             + " cells are turned inside out: take smaller "
                               "load steps (manual: errors/cells-inside-out)");
  }

  std::shared_ptr<Function> _u;
  std::vector<std::shared_ptr<Contact>> _contacts;
  std::shared_ptr<parallel::Halo> _halo;
  // The halo has it
  HaloAdapter* _adapter = nullptr;
  std::shared_ptr<Bulk> _bulk;
  std::shared_ptr<newton::System> _system;
  std::unique_ptr<audit::Audit> _audit;
  std::vector<std::string> _warnings;
  std::unique_ptr<newton::Loop> _loop;
  std::unique_ptr<Jacobian> _jacobian;
  std::unique_ptr<petsc::OwnVec> _x;
  std::optional<Snapshot> _before;
  int _number = 0;
  bool _has_accepted = false, _has_begun = false, _is_settled = false,
       _is_solution = false;
};
} // namespace contactx::dolfinx
