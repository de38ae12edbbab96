// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../results/results.h"
#include "../solve/impact.h"
#include "balance.h"
#include "inertia.h"
#include "problem.h"

namespace contactx::problem
{
/// @brief A time step of bodies with inertia and contact.
///
/// A step of length dt from u_0, v_0 is a load step of a problem whose bulk has
/// the inertia 2 (u_1 - u_0) / dt^2 - 2 v_0 / dt, times the masses, and
/// stresses in the middle of the step. Once it has converged, velocities are
/// v_1 = 2 (u_1 - u_0) / dt - v_0, or (u_1 - u_0) / dt where displacements are
/// prescribed, and then corrected by the law of impact, see solve::Impact. An
/// adapter calls
///
///     attach(problem, step);             // once
///
///     step->begin(dt, velocity);         // for each step
///     problem.solve(solver);
///     // step->velocity() is the new one, step->balance() says what was done
///
/// All ranks must call all functions without const.
class TimeStep
{
public:
  /// @brief Take the bodies and their contacts.
  /// @param[in] system Bulk and contacts.
  /// @param[in] results Results of each contact.
  /// @param[in] inertia Masses of the bodies.
  /// @param[in] impact_travel How far a node may move along the normal before
  /// it touches within a step, over the size of a cell there; no limit if none.
  /// @throws std::invalid_argument if they do not fit together, the limit is
  /// not above 0, or as check_masses does.
  TimeStep(std::shared_ptr<solve::System> system,
           std::vector<std::shared_ptr<results::Results>> results,
           std::shared_ptr<Inertia> inertia,
           std::optional<double> impact_travel = std::nullopt);

  /// @brief Begin a step from the displacements of now.
  /// @param[in] dt Length of the step, a time.
  /// @param[in] velocity Velocities (shape=(num_owned, gdim)).
  /// @throws std::invalid_argument on all ranks if dt is not finite and above
  /// 0, or velocities are not finite or of another size.
  void begin(double dt, std::span<const double> velocity);

  /// @brief Find velocities and balance of a step that has converged, before it
  /// is accepted.
  /// @return Why the step is refused: a node has moved farther than
  /// impact_travel before it touched. Empty if it is not.
  /// @throws std::logic_error if no step has begun.
  std::string end();

  /// @brief Velocities at the end of the step that has ended last
  /// (shape=(num_owned, gdim)).
  const std::vector<double>& velocity() const { return _velocity; }

  /// @brief Balance of the step that was accepted last.
  Balance balance() const;

  /// @brief Kinetic energy 1/2 v . M v.
  /// @param[in] velocity Velocities (shape=(num_owned, gdim)).
  double kinetic_energy(std::span<const double> velocity);

  /// @brief Momentum M v (shape=(gdim)).
  /// @param[in] velocity Velocities (shape=(num_owned, gdim)).
  std::vector<double> momentum(std::span<const double> velocity);

  /// @brief Moment of momentum about the origin (shape=(1) in 2D, positive
  /// counter-clockwise, shape=(3) in 3D).
  /// @param[in] velocity Velocities (shape=(num_owned, gdim)).
  std::vector<double> angular_momentum(std::span<const double> velocity);

  /// @brief Strain energy of the displacements of now; nothing where it is not
  /// known.
  std::optional<double> strain_energy();

private:
  std::string refusal(std::span<const double> increment) const;
  void constrain();
  void solve_mass(std::span<double> values);
  std::vector<double> contact_forces() const;
  double product(std::span<const double> a, std::span<const double> b) const;
  void check(std::span<const double> velocity) const;
  std::vector<double> sum(std::vector<double> values) const;

  std::shared_ptr<solve::System> _system;
  std::shared_ptr<mesh::Halo> _halo;
  std::vector<std::shared_ptr<results::Results>> _results;
  std::shared_ptr<Inertia> _inertia;
  std::optional<double> _impact_travel;
  solve::Impact _impact;
  // Of the step: its length, 0 if none has begun; displacements and velocities
  // at its start
  double _dt = 0;
  std::vector<double> _start, _before;
  // At its end; impulses of the balance are those of the impacts alone
  std::vector<double> _velocity;
  Balance _balance;
  // Prescribed dofs that the masses were constrained with last
  std::optional<std::vector<std::int8_t>> _markers;
};

/// @brief Let a problem take time steps: velocities are found before a step is
/// accepted, and bodies may be out of contact.
/// @param[in] problem Problem of the same system.
/// @param[in] step The time step.
void attach(Problem& problem, std::shared_ptr<TimeStep> step);
} // namespace contactx::problem
