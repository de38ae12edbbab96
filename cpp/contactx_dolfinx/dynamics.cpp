// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "dynamics.h"
#include "inertia.h"
#include <algorithm>
#include <stdexcept>

namespace contactx_dolfinx
{
namespace
{
Motion checked(Motion motion, const DynamicForms& forms)
{
  const auto& [u, start, velocity, dt] = motion;
  input::check_displacement(u.get());
  for (const auto& [f, name] :
       {std::pair(start, "start"), std::pair(velocity, "velocity")})
    if (f == nullptr or not input::is_space_of(*u, *f->function_space())
        or f == u)
      throw std::invalid_argument(
          std::string(name)
          + " is null, u itself or of another space: give a function of its "
            "own in u's function space");
  if (dt == nullptr or dt->value.size() != 1)
    throw std::invalid_argument(
        "dt is null or no number: give the Constant that F has");
  const std::pair<const Function*, std::string> of_u{u.get(), "u"};
  input::check_form(forms.mass.get(), "mass", {of_u, of_u},
                    "give the density times the product of a trial and a "
                    "test function");
  if (forms.loads)
    input::check_form(forms.loads.get(), "loads", {of_u},
                      "give a form linear in a test function");
  if (forms.strain_energy)
    input::check_form(forms.strain_energy.get(), "strain_energy", {},
                      "give a form without arguments");
  if (forms.F == nullptr)
    return motion;
  const auto& in = forms.F->coefficients();
  for (const auto& f : {start, velocity})
    if (std::ranges::none_of(in, [&f](const auto& c)
                             { return c.get() == f.get(); }))
      throw std::invalid_argument(
          "F does not depend on start and velocity: create the form with the "
          "very functions that are passed, as its inertia is 2 (u - start) / "
          "dt^2 - 2 velocity / dt");
  return motion;
}
} // namespace

Dynamics::Dynamics(const DynamicForms& forms, Motion motion,
                   std::vector<std::shared_ptr<const DirichletBC>> bcs,
                   std::vector<std::shared_ptr<Contact>> contacts,
                   std::optional<double> impact_travel, Assembler::Audit audit)
    : _motion(checked(std::move(motion), forms)),
      _assembler(forms.F, forms.J, _motion.u, std::move(bcs), contacts, audit)
{
  std::vector<std::shared_ptr<contactx::results::Results>> results;
  for (const auto& contact : contacts)
    results.push_back(contact->shared_results());
  const auto& system = _assembler.system();
  _step = std::make_shared<contactx::problem::TimeStep>(
      system, std::move(results),
      std::make_shared<Inertia>(*forms.mass, forms.loads, forms.strain_energy,
                                system->halo()->ranks()),
      impact_travel);
  contactx::problem::attach(_assembler.problem(), _step);
  _assembler.problem().before_step([this] { begin(); });
}

void Dynamics::step(double dt, contactx::problem::LinearSolver& solver,
                    const Tolerances& tolerances)
{
  _next = dt;
  _assembler.solve(solver, tolerances);
  finish();
}

void Dynamics::advance(StepPlan& plan,
                       const std::function<void(double t)>& update,
                       contactx::problem::LinearSolver& solver,
                       const Tolerances& tolerances,
                       const contactx::problem::StepLog& log)
{
  const double start = plan.t();
  _assembler.advance(
      plan,
      [&](double t)
      {
        update(t);
        _next = t - start;
      },
      solver, tolerances, log);
  finish();
}
std::span<const double> Dynamics::velocity() const
{
  return std::span<const double>(_motion.velocity->x()->array())
      .first(_assembler.system()->num_displacements());
}

void Dynamics::begin()
{
  _step->begin(_next, velocity());
  _motion.dt->value[0] = _next;
  std::ranges::copy(_motion.u->x()->array(),
                    _motion.start->x()->array().begin());
  _motion.velocity->x()->scatter_fwd();
}

void Dynamics::finish()
{
  std::ranges::copy(_step->velocity(), _motion.velocity->x()->array().begin());
  _motion.velocity->x()->scatter_fwd();
}
} // namespace contactx_dolfinx
