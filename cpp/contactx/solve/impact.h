// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

/// @brief Contact of bodies with inertia.
namespace contactx::solve
{
/// @brief Law of impact: velocities at the end of a time step.
///
/// A step that ends with g >= 0, p >= 0, p g = 0 stops no node: one that has
/// arrived with the velocity -v leaves the step with up to v, and goes to and
/// fro from then on. So velocities are corrected at the step's end. Impulses
/// P_s of the slave nodes take the place of those that the step's multipliers
/// have given, F_s = dt A_s lambda_s, such that relative velocities
/// r_s = sum_l w_sl v_l - (velocity of a rigid obstacle) obey
///
/// - closed nodes: n . r >= 0, n . P >= 0, (n . r) (n . P) = 0, an inelastic
///   impact (Moreau 1988);
/// - sticking and tied nodes: r = 0;
/// - slipping nodes: the tangential impulse grows and falls with the normal
///   one, P_t = F_t (n . P) / (n . F).
///
/// Impulses act by the same weights as forces, so that those of a pair sum to
/// zero. On obstacles at rest and without friction v is the projection of the
/// velocity without contact, v - M^-1 B^T F, on the cone B v >= 0 in the norm
/// of the masses M: kinetic energy cannot grow, as B v >= 0, F >= 0 and
/// P . B v = 0 give |v|^2 <= v . M (v before) .
class Impact
{
public:
  using Contacts = std::vector<std::shared_ptr<contact::Contact>>;

  /// Makes velocities of impulses, in place: multiplies by the inverse of the
  /// masses; zero at prescribed displacements (shape=(num_owned, gdim)).
  /// Collective.
  using SolveMass = std::function<void(std::span<double>)>;

  /// @brief Take the contacts.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] contacts The contacts, of this halo.
  /// @throws std::invalid_argument if one is missing.
  Impact(std::shared_ptr<mesh::Halo> halo, Contacts contacts);

  /// @brief Take note of the nodes that are closed before a step.
  void begin_step();

  /// @brief How far nodes that were open before the step have moved to what
  /// they touch at its end; collective.
  ///
  /// Contact acts throughout a step, as if they had touched from its start: the
  /// time of an impact is known as well as these distances are small.
  /// @param[in] increment Displacements of the step (shape=(num_owned, gdim)).
  /// @param[in] cell_sizes Size of the largest cell around each node
  /// (shape=(num_owned)).
  /// @return Largest distance along the normal over the size of a cell at the
  /// slave node, the same on all ranks; 0 if no node has arrived.
  /// @throws std::invalid_argument on all ranks if an array does not fit on
  /// one of them, or no step has begun.
  double arrival(std::span<const double> increment,
                 std::span<const double> cell_sizes) const;

  /// @brief Correct velocities after a step that has converged, before it is
  /// accepted; all ranks must take part.
  /// @param[in] dt Length of the step, a time.
  /// @param[in,out] velocity Velocities (shape=(num_owned, gdim)).
  /// @param[in] solve Makes velocities of impulses.
  /// @throws std::invalid_argument if dt is not positive, or velocities have
  /// another size.
  void correct(double dt, std::span<double> velocity, const SolveMass& solve);

  /// @brief Impulse of each slave node of each contact in the last step, P: a
  /// force times a time, zero on open nodes (shape=(n, gdim)).
  const std::vector<std::vector<double>>& impulses() const { return _impulses; }

  /// @brief Impulse P of the impact less that of the step's multipliers, P - F.
  const std::vector<std::vector<double>>& corrections() const
  {
    return _corrections;
  }

private:
  std::shared_ptr<mesh::Halo> _halo;
  Contacts _contacts;
  std::vector<std::vector<std::int8_t>> _was_closed;
  std::vector<std::vector<double>> _impulses, _corrections;
};
} // namespace contactx::solve
