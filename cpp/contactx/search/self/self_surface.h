// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../distributed.h"
#include "self_sight.h"

namespace contactx::search
{
/// @brief A surface whose nodes are paired with the surface itself.
///
/// A node has a pair where it sees a facet, see SelfSight, and is the slave of
/// the two, see SelfOrder; what is in contact stays so, on whichever side. Of
/// two nodes that are each paired with a facet of the other one keeps its pair:
/// who is in contact, else who is later in the order.
class SelfSurface final : public DistributedSurface
{
public:
  /// @brief Take the facets; all ranks must take part.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] own Facets of this rank's cells, each on one rank alone.
  /// @param[in] body Body of each of this rank's nodes (shape=(at least
  /// num_owned)).
  /// @param[in] excluded See SelfSight.
  /// @param[in] level See make_master_surface.
  SelfSurface(std::shared_ptr<mesh::Halo> halo, geometry::Facets own,
              const std::vector<std::int64_t>& body,
              std::optional<double> excluded,
              std::span<const std::int8_t> level = {});

  /// @brief Visibility of the surface from its nodes.
  SelfSight& sight() { return _sight; }

  Found find_of_nodes(std::span<const double> x,
                      std::span<const std::int32_t> nodes,
                      std::span<const double> normals, double reach) override;
  std::int32_t pair(Pairing& pairing, const geometry::FacetList& slave,
                    std::span<const double> x, double reach,
                    std::span<const std::int8_t> closed) override;
  void take_compliance(std::span<const double> nodal) override;
  bool sees_bodies() const override { return true; }
  bool is_self() const override { return true; }

private:
  std::vector<std::optional<Projection>>
  candidates(std::span<const std::int32_t> nodes, double reach) const;
  std::vector<std::optional<Projection>>
  here(std::vector<std::optional<Projection>> places);
  std::int32_t drop_doubles(Pairing& pairing, std::span<const double> x,
                            double reach, std::span<const std::int8_t> closed);

  SelfSight _sight;
  bool _is_ordered = false;
};
} // namespace contactx::search
