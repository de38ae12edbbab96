// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../law/normal.h"
#include <cstdint>
#include <span>

/// @brief Search for the set of closed nodes.
namespace contactx::solve
{
/// @brief Effect of a Newton step with hard contact on the closed nodes.
/// Sums over them, those of several contacts and ranks add up.
struct HardStep
{
  double work = 0;   ///< of the changes of pressure on the gaps that they close
  double local = 0;  ///< the same if all bodies were as stiff as c
  double closed = 0; ///< number of closed nodes
  double opening = 0; ///< number of those that the step leaves in tension
};

/// @brief Look at a Newton step.
/// @param[in] state Pressures and gaps before it.
/// @param[in] area Area of each node.
/// @param[in] status Status of each node.
/// @param[in] change Changes of the pressures in the step.
HardStep look_at_step(const law::NormalState& state,
                      std::span<const double> area,
                      std::span<const std::int8_t> status,
                      std::span<const double> change);

/// @brief A path from soft to hard contact, for active sets that creep.
///
/// The primal-dual active set strategy finds the closed nodes of slender bodies
/// node by node: the finer the mesh, the more iterations (Ito & Kunisch, M2AN
/// 37, 2003). Through a layer of any fixed compliance the number of Newton
/// steps does not depend on the mesh (Hintermueller, Ito & Kunisch, SIAM J.
/// Optim. 13, 2003). So where a step is about to open many of the closed nodes
/// and the bodies are much softer than their surfaces, the step is not taken:
/// the nodes get a layer as compliant as the bodies, which is then made harder
/// by levels until it may go. What has converged is always hard contact.
class SoftPath
{
public:
  /// @brief Start a load step: contact is hard, and no step has been seen.
  void begin_step();

  /// @brief Decide whether the path begins, at most once a load step.
  /// @param[in] step The hard step, sums over all contacts and ranks.
  /// @return Whether it does, and the step is not to be taken.
  bool begins(const HardStep& step);

  /// @brief Go on after an iterate: to the next level if this one has
  /// converged.
  /// @param[in] changes Number of nodes that changed their status.
  /// @param[in] closed Number of closed nodes.
  /// @param[in] is_full Whether the step was taken in full.
  void advance(std::int64_t changes, std::int64_t closed, bool is_full);

  /// @brief Make contact hard again.
  void harden() { _compliance = 0; }

  /// @brief Compliance of the layer, over 1 / c; zero if contact is hard.
  double compliance() const { return _compliance; }

private:
  double _compliance = 0;
  // Smallest stiffness of the bodies that has been seen, over c
  double _stiffness = 1;
  int _iterations = 0; // at this level
  bool _has_begun = false, _is_fresh = false;
};
} // namespace contactx::solve
