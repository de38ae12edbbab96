// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include <contactx/problem/time_step.h>

namespace contactx_dolfinx
{
using contactx::problem::Balance;

/// @brief Forms of a time step of bodies with inertia.
struct DynamicForms
{
  /// Residual: inertia 2 (u - start) / dt^2 - 2 velocity / dt times the
  /// density, the stresses in the middle of the step, (start + u) / 2, less the
  /// loads
  std::shared_ptr<const Form> F;
  /// Derivative of F by u
  std::shared_ptr<const Form> J;
  /// Density times the product of two vectors, a bilinear form, integrated as
  /// the inertia in F is. By values at vertices masses are lumped
  std::shared_ptr<const Form> mass;
  /// Loads that do not depend on u, with the sign of a right-hand side, for the
  /// balance; null where F has none
  std::shared_ptr<const Form> loads = nullptr;
  /// Strain energy of u, for the balance; null if it is not asked for
  std::shared_ptr<const Form> strain_energy = nullptr;
};

/// @brief What the forms of a time step have for coefficients.
struct Motion
{
  /// Displacement, in a Lagrange space of vectors of degree 1 or 2
  std::shared_ptr<Function> u;
  /// Displacement at the start of a step, of the same space; it is set where a
  /// step begins
  std::shared_ptr<Function> start;
  /// Velocity at the end of the last step, of the same space; set it before the
  /// first one
  std::shared_ptr<Function> velocity;
  /// Length of the step, a time; it is set where a step begins
  std::shared_ptr<dolfinx::fem::Constant<double>> dt;
};

/// @brief Bodies with inertia and contact, one time step after the other.
///
/// Steps are those of ContactDynamics in Python: the midpoint rule with the
/// contact laws at the end of a step, and velocities that are corrected by the
/// law of inelastic impact, see contactx::problem::TimeStep. A program reads
///
///     Dynamics dynamics({F, J, mass}, {u, start, velocity, dt}, bcs,
///                       {contact});
///     KSPSolver solver(dynamics.assembler(), ksp);
///     for (int k = 0; k < 100; ++k)
///     {
///       dynamics.step(1e-3, solver);
///       // results are those at the end of the step
///     }
///
/// All ranks must call all functions, in the same order.
class Dynamics
{
public:
  /// @brief Couple bodies with contacts.
  /// @param[in] forms Forms of a step; density is read here.
  /// @param[in] motion Functions and length of a step, which the forms have.
  /// @param[in] bcs Dirichlet conditions; prescribed displacements move with
  /// their mean velocity of a step.
  /// @param[in] contacts Contacts, at least one.
  /// @param[in] impact_travel How far a node may move before it touches within
  /// a step, over the size of a cell there; a step in which one moves farther
  /// fails. No limit if none.
  /// @param[in] audit As of Assembler.
  /// @throws std::invalid_argument on all ranks if they do not fit, masses are
  /// not positive and finite, or as Assembler does.
  Dynamics(const DynamicForms& forms, Motion motion,
           std::vector<std::shared_ptr<const DirichletBC>> bcs,
           std::vector<std::shared_ptr<Contact>> contacts,
           std::optional<double> impact_travel = std::nullopt,
           Assembler::Audit audit = Assembler::Audit::refuse);

  Dynamics(const Dynamics&) = delete;
  Dynamics& operator=(const Dynamics&) = delete;

  /// @brief Take a step from u and velocity, with the loads and Dirichlet
  /// values of now.
  /// @param[in] dt Its length, a time.
  /// @param[in] solver Solver of the Jacobian, such as a KSPSolver of
  /// `assembler()`.
  /// @param[in] tolerances When iterations end.
  /// @throws ConvergenceError if it does not converge, or a node has moved
  /// farther than impact_travel before it touched; displacement, velocity and
  /// contacts are then those of before.
  /// @throws std::invalid_argument if dt is not finite and above 0, the
  /// velocity is not finite, or as Assembler::begin_step does.
  void step(double dt, contactx::problem::LinearSolver& solver,
            const Tolerances& tolerances = {});

  /// @brief Take the next step of a plan whose t is the time, and shorter ones
  /// until one converges.
  /// @param[in,out] plan The time steps.
  /// @param[in] update Sets loads and Dirichlet values for the time at the end
  /// of a step.
  /// @param[in] solver Solver of the Jacobian.
  /// @param[in] tolerances When iterations end.
  /// @param[in] log Called with each attempt.
  /// @throws ConvergenceError if the shortest step does not converge; plan and
  /// state are then those of before.
  void advance(StepPlan& plan, const std::function<void(double t)>& update,
               contactx::problem::LinearSolver& solver,
               const Tolerances& tolerances = {},
               const contactx::problem::StepLog& log = {});

  /// @brief Balance of the last step: energies, momentum, works, impulses.
  Balance balance() const { return _step->balance(); }

  /// @brief Kinetic energy of the current velocity.
  double kinetic_energy() { return _step->kinetic_energy(velocity()); }

  /// @brief Strain energy of the current displacement; nothing where no form
  /// was given.
  std::optional<double> strain_energy() { return _step->strain_energy(); }

  /// @brief Momentum of the current velocity (shape=(gdim)).
  std::vector<double> momentum() { return _step->momentum(velocity()); }

  /// @brief Moment of momentum about the origin (shape=(1) in 2D, positive
  /// counter-clockwise, shape=(3) in 3D).
  std::vector<double> angular_momentum()
  {
    return _step->angular_momentum(velocity());
  }

  /// @brief The system that is solved in a step, for solvers and reports.
  Assembler& assembler() { return _assembler; }

private:
  std::span<const double> velocity() const;
  void begin();
  void finish();

  Motion _motion;
  Assembler _assembler;
  std::shared_ptr<contactx::problem::TimeStep> _step;
  // Length of the step that is attempted
  double _next = 0;
};
} // namespace contactx_dolfinx
