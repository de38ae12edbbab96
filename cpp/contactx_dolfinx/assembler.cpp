// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "assembler.h"
#include "cells.h"
#include "halo.h"
#include "jacobian.h"
#include <algorithm>
#include <contactx/mesh/degenerate.h>
#include <contactx/mesh/mesh.h>
#include <contactx/solve/not_finite.h>
#include <stdexcept>

namespace contactx_dolfinx
{
namespace
{
/// A displacement alone.
Blocks alone(std::shared_ptr<const Form> F, std::shared_ptr<const Form> J,
             std::shared_ptr<Function> u)
{
  input::check_displacement(u.get());
  return {{std::move(F)}, {{std::move(J)}}, {std::move(u)}};
}
} // namespace

Assembler::Assembler(std::shared_ptr<const Form> F,
                     std::shared_ptr<const Form> J, std::shared_ptr<Function> u,
                     std::vector<std::shared_ptr<const DirichletBC>> bcs,
                     std::vector<std::shared_ptr<Contact>> contacts,
                     Audit audit)
    : Assembler(alone(std::move(F), std::move(J), std::move(u)), std::move(bcs),
                std::move(contacts), audit)
{
}

Assembler::Assembler(const Blocks& blocks,
                     std::vector<std::shared_ptr<const DirichletBC>> bcs,
                     std::vector<std::shared_ptr<Contact>> contacts,
                     Audit audit,
                     std::vector<std::shared_ptr<Conductance>> conductances)
    : _contacts(std::move(contacts))
{
  const auto unknowns
      = std::make_shared<Unknowns>(blocks.functions, blocks.displacement);
  _u = unknowns->u();
  input::check_blocks(blocks);
  input::check_conditions(bcs, blocks.functions);
  if (_contacts.empty())
    throw std::invalid_argument(
        "an Assembler needs at least one contact: pass one");
  for (std::size_t k = 0; k < _contacts.size(); ++k)
    if (_contacts[k] == nullptr)
      throw std::invalid_argument("contacts[" + std::to_string(k)
                                  + "] is null: give a Contact");
  auto adapter = std::make_unique<HaloAdapter>(_u);
  HaloAdapter* const owned = adapter.get();
  contactx::mesh::BulkNodes nodes = adapter->bulk_nodes();
  _halo = std::make_shared<contactx::mesh::Halo>(std::move(nodes),
                                                 std::move(adapter));
  _adapter = std::shared_ptr<HaloAdapter>(_halo, owned);
  _bulk = std::make_shared<Bulk>(blocks, unknowns, std::move(bcs), _halo,
                                 _adapter);
  check(conductances);
  const auto bodies = std::make_shared<contactx::mesh::Bodies>(
      _bulk->all_cells(), _bulk->nodes_per_cell(), _bulk->num_owned_cells(),
      _halo->original().first(_halo->num_bulk()), _halo);
  std::size_t count = 0;
  try
  {
    contactx::solve::System::Contacts discrete;
    std::vector<contactx::problem::Part> parts;
    for (; count < _contacts.size(); ++count)
    {
      const Contact& contact = *_contacts[count];
      discrete.push_back(_contacts[count]->attach(
          {_halo, bodies, _bulk->all_cells(), _bulk->nodes_per_cell()},
          _adapter, _bulk->all_markers(), _u->function_space()));
      parts.push_back(
          {"contact " + std::to_string(count) + " (" + contact.name() + ")",
           contact.values(), contact.shared_results()});
    }
    check_cells();
    for (const auto& conductance : conductances)
      conductance->check();
    _bulk->follow(std::move(conductances));
    _system = std::make_shared<contactx::solve::System>(_halo, _bulk,
                                                        std::move(discrete));
    _problem = std::make_unique<contactx::problem::Problem>(
        _system, bodies, std::move(parts), audit == Audit::refuse);
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

Assembler::~Assembler()
{
  for (const auto& contact : _contacts)
    contact->detach();
}

::Vec Assembler::create_vector() const
{
  ::Vec x = nullptr;
  petsc::check(VecCreateMPI(comm(), static_cast<PetscInt>(_system->size()),
                            PETSC_DETERMINE, &x),
               "VecCreateMPI");
  return x;
}

::Mat Assembler::create_matrix() const
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

::Vec Assembler::x() const
{
  pack();
  return _x->get();
}

void Assembler::solve(contactx::problem::LinearSolver& solver,
                      const Tolerances& tolerances)
{
  try
  {
    _problem->solve(solver, tolerances);
  }
  catch (...)
  {
    pack();
    throw;
  }
  pack();
  show();
}

void Assembler::advance(StepPlan& plan,
                        const std::function<void(double t)>& update,
                        contactx::problem::LinearSolver& solver,
                        const Tolerances& tolerances,
                        const contactx::problem::StepLog& log)
{
  try
  {
    _problem->advance(plan, update, solver, tolerances, log);
  }
  catch (...)
  {
    pack();
    show();
    throw;
  }
  pack();
  show();
}

void Assembler::begin_step()
{
  try
  {
    _problem->begin_step();
  }
  catch (const contactx::solve::NotFinite& error)
  {
    throw ConvergenceError(error.what());
  }
  pack();
}

void Assembler::restore()
{
  _problem->restore();
  pack();
  show();
}

void Assembler::take(const contactx::problem::Checkpoint& checkpoint,
                     const contactx::problem::Checkpoint::State& state)
{
  _bulk->read();
  checkpoint.apply(state);
  _problem->update_results();
  pack();
  show();
}

const Settled& Assembler::settle(double rtol, double atol, int max_it)
{
  const Settled& found = _problem->settle(rtol, atol, max_it);
  // Iterates may have been taken back
  pack();
  if (not found.failure.empty())
    throw ConvergenceError(found.failure);
  return found;
}

void Assembler::residual(::Vec x, ::Vec b)
{
  _problem->enter("residual");
  take(x);
  // Loads may be others, as in arc-length methods
  _system->begin_step();
  _system->residual(petsc::Values(b).span());
}

void Assembler::jacobian(::Vec x, ::Mat A)
{
  _problem->enter("jacobian");
  take(x);
  _jacobian->assemble(A, loop().free_bodies().springs());
}

void Assembler::set_up(::KSP ksp)
{
  _problem->enter("set_up", {{"condensed", 0}});
  if (not _A)
    _A = std::make_unique<petsc::OwnMat>(create_matrix());
  _jacobian->assemble(_A->get(), loop().free_bodies().springs());
  petsc::check(KSPSetOperators(ksp, _A->get(), _A->get()), "KSPSetOperators");
}
void Assembler::update(::Vec dx, double part)
{
  _problem->update(petsc::ConstValues(dx).span(), part);
  pack();
}

void Assembler::accept()
{
  _problem->enter("accept");
  _problem->summarise();
  try
  {
    _problem->accept();
  }
  catch (...)
  {
    pack();
    throw;
  }
  show();
}

void Assembler::check(
    const std::vector<std::shared_ptr<Conductance>>& conductances) const
{
  for (std::size_t k = 0; k < conductances.size(); ++k)
  {
    const std::string name = "conductances[" + std::to_string(k) + "]";
    if (conductances[k] == nullptr)
      throw std::invalid_argument(name + " is null: give a Conductance");
    if (std::ranges::find(_contacts, conductances[k]->contact())
        == _contacts.end())
      throw std::invalid_argument(
          name + " is of another contact: list it among the contacts");
    const auto& field = conductances[k]->field();
    if (field == _u
        or _bulk->number_of(*field) == int(_bulk->functions().size()))
      throw std::invalid_argument(
          "the field of " + name
          + " is not solved for: give it among the functions of Blocks; a "
            "part of a mixed space will not do. Where it is solved for by "
            "itself, leave the conductance out and take its residual() and "
            "by_field()");
  }
}

void Assembler::check_cells() const
{
  const FunctionSpace& V = *_u->function_space();
  const auto& topology = *V.mesh()->topology();
  contactx::mesh::check_cells(_halo->ranks(), cells_of(V).type,
                              geometry_of(*V.mesh()),
                              topology.index_map(topology.dim())->size_local(),
                              original_cells(*V.mesh()));
}

void Assembler::show() const
{
  for (const auto& contact : _contacts)
    contact->show();
}
void Assembler::take(::Vec x)
{
  const petsc::ConstValues values(x);
  _system->take(values.span());
}

KSPSolver::KSPSolver(Assembler& assembler, ::KSP ksp)
    : _assembler(&assembler), _ksp(ksp), _b(assembler.create_vector()),
      _x(assembler.create_vector())
{
}
void KSPSolver::solve(std::span<const double> b, std::span<double> x)
{
  std::ranges::copy(b, petsc::Values(_b.get()).span().begin());
  petsc::check(KSPSolve(_ksp, _b.get(), _x.get()), "KSPSolve");
  KSPConvergedReason reason{};
  petsc::check(KSPGetConvergedReason(_ksp, &reason), "KSPGetConvergedReason");
  if (reason < 0)
    throw contactx::solve::NotFinite(
        "the linear solver failed: is a body free to move without touching "
        "anything? Support it; with a Krylov solver of your own try pc_type "
        "lu (manual: errors/linear-solver-failed)");
  std::ranges::copy(petsc::ConstValues(_x.get()).span(), x.begin());
}
} // namespace contactx_dolfinx
