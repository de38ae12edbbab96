// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "junctions.h"

namespace contactx::active_set
{
/// @brief What an update of the active set has changed, on all ranks.
struct Changes
{
  std::int64_t status = 0; ///< nodes that changed their status
  std::int64_t pairs = 0;  ///< nodes in contact that changed their facet
};

/// @brief Pairs and status of all contacts of a problem at accepted iterates.
///
/// While many nodes change their status, the active set is far off, and so are
/// pressures and deformation: pairs found on it, and the stiffness of its
/// normals, lead astray. So the kinematics (pairs, normals and projections) are
/// frozen, which makes the contact conditions linear, and the active set
/// converges as surely as in small sliding. Once few nodes change the
/// kinematics are updated again.
///
/// All ranks must take part in whatever has no const.
class ActiveSet
{
public:
  /// @brief Take the contacts.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] contacts The contacts.
  ActiveSet(std::shared_ptr<parallel::Halo> halo,
            std::vector<std::shared_ptr<contact::Contact>> contacts);

  /// @brief Start a step.
  void begin_step();

  /// @brief Update pairs, gaps and status at an accepted iterate.
  /// @param[in] is_first Whether the iterate is the step's start.
  /// @param[in] may_freeze Whether kinematics are frozen where many nodes
  /// change.
  Changes settle(bool is_first, bool may_freeze);

  /// @brief Freeze the kinematics, or update them again.
  void freeze(bool is_frozen);

  /// @brief Whether kinematics are frozen.
  bool is_frozen() const { return _is_frozen; }

  /// @brief Whether the residual is one of frozen kinematics, or of pairs that
  /// were frozen for an active set that is far off: it is not the true one.
  bool is_stale() const { return _is_stale; }

  /// @brief Number of nodes in contact, on all ranks.
  std::int64_t num_closed();

  /// @brief How many nodes close several contacts, on this rank.
  std::int32_t corners() const { return _junctions.corners(); }

private:
  Changes update(bool is_first);
  void share(bool is_first);
  bool are_many(std::int64_t changes);

  std::shared_ptr<parallel::Halo> _halo;
  std::vector<std::shared_ptr<contact::Contact>> _contacts;
  Junctions _junctions;
  bool _has_junctions;
  bool _is_frozen = false, _is_stale = false;
};
} // namespace contactx::active_set
