// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "findings.h"

namespace contactx::audit
{
/// @brief Looks at the contacts of a converged iterate as nothing in the Newton
/// loop does.
///
/// The residual says that the constraints hold which contact has set up.
/// Whether they were the right ones is seen from geometry alone: from the
/// master's side, between slave nodes, along the displacement since the last
/// accepted configuration. Ties are not audited, nor obstacles in small
/// sliding, which are a plane for each node.
///
/// Positions are those of the halo at each call. All ranks must take part.
class Audit
{
public:
  /// @brief Prepare the searches, and take the configuration of now as the one
  /// before the first step.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] contacts All contacts.
  Audit(std::shared_ptr<mesh::Halo> halo,
        std::vector<std::shared_ptr<contact::Contact>> contacts);

  /// @brief Start a step, from wherever the displacement is now.
  void begin_step();

  /// @brief Take the configuration of now as the one before the next step.
  void accept();

  /// @brief Audit the state of now.
  /// @return What was found of each contact, nothing of those that are not
  /// audited or switched off.
  std::vector<Findings> find();

private:
  // Positions of owned nodes
  std::vector<double> owned() const;

  std::shared_ptr<mesh::Halo> _halo;
  std::vector<std::shared_ptr<contact::Contact>> _contacts;
  std::vector<std::unique_ptr<ContactAudit>> _audits;
  std::vector<double> _start;
};
} // namespace contactx::audit
