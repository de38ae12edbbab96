// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../contact/obstacle_pairs.h"
#include "findings.h"

namespace contactx::audit
{
/// @brief Looks at an obstacle from all of the slave facets, between their
/// nodes, and whether nodes came to its far side.
///
/// All ranks must take part in each call, and throw what the obstacle throws on
/// any of them.
class ObstacleAudit final : public ContactAudit
{
public:
  /// @brief Prepare the searches.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] contact The contact, in finite sliding: in small sliding the
  /// obstacle of each node is a plane.
  /// @throws std::invalid_argument if its master is no obstacle.
  ObstacleAudit(std::shared_ptr<mesh::Halo> halo,
                std::shared_ptr<contact::Contact> contact);

  /// @brief Remember how slave nodes and facets lie before the next step.
  void accept() override;

  Findings find(std::span<const double> start) override;

private:
  // Owned slave nodes and middles of this rank's facets, and unit normals there
  struct Places
  {
    std::vector<double> points, normals;
  };

  using Function
      = std::vector<double> (geometry::Obstacle::*)(std::span<const double> x,
                                                    int gdim);

  int gdim() const { return _halo->gdim(); }
  Places places(std::span<const double> x) const;
  std::vector<double> seen(std::span<const double> points, Function function,
                           int width) const;
  std::vector<double> gaps(std::span<const double> points) const;
  std::vector<std::int32_t> inside(std::span<const double> gap,
                                   double small) const;
  std::int64_t count_passed(std::span<const double> x, double small) const;
  bool touches(std::size_t i, double gap, double small) const;
  std::optional<Roundness> roundness(std::span<const double> x,
                                     std::span<const double> size,
                                     std::span<const double> gap,
                                     double small) const;
  std::vector<std::int8_t> near(std::span<const double> gap,
                                double small) const;
  std::optional<Depth> look_between(std::span<const double> x,
                                    std::span<const double> size,
                                    std::span<const std::int8_t> near,
                                    std::span<const double> offset) const;
  std::vector<double> turns(std::span<const std::int32_t> facets,
                            std::span<const double> at,
                            std::span<const double> x,
                            std::span<const double> normal) const;

  std::shared_ptr<mesh::Halo> _halo;
  std::shared_ptr<contact::Contact> _contact;
  std::shared_ptr<contact::ObstacleMaster> _master;
  // Before the step, with the obstacle's normals there and where it was
  std::optional<Places> _before;
  std::vector<double> _normals;
  geometry::Placement _placed;
};
} // namespace contactx::audit
