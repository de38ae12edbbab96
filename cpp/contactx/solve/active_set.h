// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "cycle_guard.h"
#include "free_bodies.h"
#include "frozen_pairs.h"
#include "shared_nodes.h"

namespace contactx::solve
{
/// @brief A contact as free bodies see it.
std::shared_ptr<FreeBodyContact>
free_body_contact(std::shared_ptr<contact::Contact> contact);

/// @brief Changes that an update of the active set has made, on all ranks.
struct Changes
{
  std::int64_t status = 0;  ///< nodes that changed their status
  std::int64_t pairs = 0;   ///< nodes in contact that changed their facet
  std::int64_t contact = 0; ///< nodes that opened or closed
};

/// @brief Pairs and status of all contacts of a problem.
///
/// A Newton loop calls `update` at each accepted iterate, evaluates the
/// residual that belongs to it, and tells it by `note`. A small residual is a
/// solution if `may_end` says so. All ranks must call its functions without
/// const.
class ActiveSet
{
public:
  /// @brief Take the contacts.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] contacts The contacts.
  /// @param[in] bodies What keeps bodies without supports solvable, of the same
  /// contacts; null if all bodies have supports. Its steps begin apart: it asks
  /// for the stiffness of the bulk.
  ActiveSet(std::shared_ptr<mesh::Halo> halo,
            std::vector<std::shared_ptr<contact::Contact>> contacts,
            std::shared_ptr<FreeBodies> bodies = nullptr);

  /// @brief Start a load step.
  void begin_step();

  /// @brief Update pairs, gaps and status at an accepted iterate.
  ///
  /// While many nodes change their status, the active set is far off, and so
  /// are pressures and deformation: pairs found on it, and the stiffness of its
  /// normals, are wrong. So the kinematics (pairs, normals and projections)
  /// are frozen, which makes the contact conditions linear, and the active set
  /// converges as surely as in small sliding. Once few nodes change the
  /// kinematics are updated again.
  /// @param[in] forces Forces at the iterate, which free bodies ask for.
  /// @param[in] is_first Whether the iterate is the step's start.
  Changes update(const Forces& forces, bool is_first = false);

  /// @brief Update pairs and gaps alone, with the kinematics of the iterate.
  void pair();

  /// @brief Changes of the last `update`.
  const Changes& changes() const { return _changes; }

  /// @brief Number of nodes in contact, on all ranks.
  std::int64_t num_closed() const;

  /// @brief Number of slave nodes that slip against friction, on all ranks.
  std::int64_t num_slipping() const;

  /// @brief True if the kinematics are frozen.
  bool is_frozen() const { return _is_frozen; }

  /// @brief True if the conditions of the contacts are linear now, so that no
  /// pressure turns with a body.
  bool is_linear() const;

  /// @brief True if only `CycleGuard::step_fraction` of the last step is to be
  /// taken, because the active set cycles. Asked once a step.
  bool shortens() { return _guard.shortens(); }

  /// @brief Remember the residual of an iterate.
  void note(double residual);

  /// @brief Decide if an iterate with a small residual is a solution.
  ///
  /// With frozen kinematics the residual is not the true one. The active set
  /// may chatter: nodes without force change their status by round-off.
  enum class End : std::int8_t
  {
    solution, ///< it is
    again,    ///< pairs have been updated: its residual must be evaluated anew
    frozen_pair_penetrates ///< frozen pairs hide a penetration, and cannot be
                           ///< released
  };

  /// @brief Tell whether an iterate with a small residual is a solution, and
  /// update pairs and status again if not.
  /// @param[in] forces Forces at the iterate, which free bodies ask for.
  End may_end(const Forces& forces);

  /// @brief Number of times that a status has come back in this step.
  int cycles() const { return _guard.cycles(); }

  /// @brief Number of nodes that close several contacts, on all ranks.
  std::int64_t num_corners() const;

  /// @brief Take what slip is measured from of an iterate that is not taken,
  /// see contact::Contact::foresee; collective.
  void foresee();

  /// @brief Smallest gap that frozen pairs of each contact hide, when last
  /// searched.
  const std::vector<double>& hidden_gaps() const { return _hidden.gaps; }

private:
  Changes update(const Forces& forces, bool is_first, bool may_freeze);
  Changes update(bool is_first);
  void share(bool is_first);
  void freeze(bool is_frozen);
  void reset_flips();
  bool hide_penetration();
  bool are_many(std::int64_t changes) const;

  std::shared_ptr<mesh::Halo> _halo;
  std::vector<std::shared_ptr<contact::Contact>> _contacts;
  std::shared_ptr<FreeBodies> _bodies;
  SharedNodes _junctions;
  bool _has_junctions;
  CycleGuard _guard;
  HiddenPenetration _hidden;
  Changes _changes;
  // Pairs that changed before the first iterate
  std::int64_t _paired = 0;
  bool _is_frozen = false;
  // Whether the residual is one of frozen kinematics, or of pairs that were
  // frozen for an active set that is far off
  bool _is_stale = false;
};
} // namespace contactx::solve
