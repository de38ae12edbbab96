// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../search/self/self_surface.h"
#include "findings.h"

namespace contactx::audit
{
/// @brief Looks at a surface that is in contact with itself: at what all of its
/// nodes see, whichever side of a pair they are, or none, and at what they have
/// gone through within the step.
///
/// All ranks must take part in each call.
class SelfAudit final : public ContactAudit
{
public:
  /// @brief Prepare the searches.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] contact The contact.
  /// @throws std::invalid_argument if its master is no SelfSurface.
  SelfAudit(std::shared_ptr<mesh::Halo> halo,
            std::shared_ptr<contact::Contact> contact);

  void accept() override {}

  /// @copydoc ContactAudit::find
  /// @throws std::invalid_argument if there are not as many positions as nodes.
  Findings find(std::span<const double> start) override;

private:
  FoundNodes look_back(double size) const;
  std::optional<Depth> look_around(std::span<const double> sizes) const;
  std::vector<double> nodal(std::span<const double> of_slaves) const;

  std::shared_ptr<mesh::Halo> _halo;
  std::shared_ptr<contact::Contact> _contact;
  std::shared_ptr<search::SelfSurface> _surface;
};
} // namespace contactx::audit
