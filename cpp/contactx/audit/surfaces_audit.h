// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../contact/deformable_master.h"
#include "findings.h"

namespace contactx::audit
{
/// @brief Looks at a contact of two deformable surfaces from the side that the
/// constraints do not see: at slave facets from master nodes, and at the master
/// from slave nodes without a pair.
///
/// In small sliding all is seen in the reference configuration, with gaps
/// linear in displacements. All ranks must take part in each call.
class SurfacesAudit final : public ContactAudit
{
public:
  /// @brief Prepare the searches.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] contact The contact, no tie.
  /// @throws std::invalid_argument if its master is not deformable.
  SurfacesAudit(std::shared_ptr<mesh::Halo> halo,
                std::shared_ptr<contact::Contact> contact);

  /// @brief Remember which slave nodes lie behind the master before the next
  /// step.
  ///
  /// They may do so for good: behind a thin plate, or beside a surface that
  /// only part of the body is tagged with.
  void accept() override;

  /// @copydoc ContactAudit::find
  /// @throws std::invalid_argument if there are not as many positions as nodes.
  Findings find(std::span<const double> start) override;

private:
  // Positions to search in, and in small sliding displacements since
  struct Configuration
  {
    std::vector<double> x, displacement;
  };

  bool is_small() const;
  Configuration configuration() const;
  double facet_size(const geometry::FacetList& facets,
                    std::span<const double> x) const;
  void look_back(std::span<const double> start, std::span<const double> x,
                 Findings& findings) const;
  std::vector<std::int8_t> find_behind();
  FoundNodes look_from_slave(std::span<const double> x);
  std::vector<double> bent(const Configuration& now) const;
  search::ProbeResult see_slave(const Configuration& now,
                                std::span<const double> normals);
  void look_from_master(std::span<const double> positions, Findings& findings);
  double look_across(std::span<const double> x, double facet_size);

  std::shared_ptr<mesh::Halo> _halo;
  std::shared_ptr<contact::Contact> _contact;
  std::shared_ptr<contact::DeformableMaster> _master;
  search::SurfaceProbe _at_slave;
  search::InsideTest _outside_slave;
  // Of the master surface, without what both surfaces have: nodes of this
  // rank's facets, and those that this rank owns
  std::vector<std::int32_t> _points, _owned_master;
  double _extent; // of the master surface
  std::vector<std::int8_t> _behind;
};
} // namespace contactx::audit
