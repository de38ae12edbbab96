// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "master_surface.h"
#include "rank_boxes.h"
#include "records.h"

namespace contactx::search
{
/// @brief Facets of a master surface of which each rank has a part.
///
/// A rank asks others by points, and by slave facets, and gets the facets that
/// matter to them. It keeps those until the step's end. Boxes of the ranks'
/// facets say which to ask.
class DistributedSurface : public MasterSurface
{
public:
  /// @brief Take this rank's facets and those around them, whose nodes are
  /// added to the halo for good; all ranks must take part.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] own Facets of the surface that this rank has.
  /// @param[in] level See make_master_surface.
  DistributedSurface(std::shared_ptr<mesh::Halo> halo, geometry::Facets own,
                     std::span<const std::int8_t> level = {});

  Found find(std::span<const double> x, std::span<const double> points,
             std::span<const double> normals, double reach) override;
  std::int32_t pair(Pairing& pairing, const geometry::FacetList& slave,
                    std::span<const double> x, double reach,
                    std::span<const std::int8_t> closed) override;
  void add_facets_within(std::span<const double> x,
                         const geometry::FacetList& slave, double reach,
                         double margin, std::span<const double> along) override;
  std::vector<std::int32_t> keep(std::span<const std::int32_t> used) override;
  std::vector<std::int32_t> named(std::span<const std::int64_t> names) override;

protected:
  /// @brief Numbers of facets among `facets`, to which new ones are appended;
  /// collective.
  std::vector<std::int32_t> learn(const FacetRecords& facets);

  /// @brief Settle pairs with the results of their search; the halo may have
  /// grown since `x` was taken.
  /// @param[in,out] pairing Pairs with `facets`.
  /// @param[in] left Slave nodes, by their place in the pairing.
  /// @param[in] places Where each is, on facets of now; nothing without one.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)).
  /// @param[in] version Version of the halo at which they were taken.
  /// @param[in] reach Largest distance of a pair.
  /// @param[in] closed Whether slave nodes are in contact (shape=(num_slaves)).
  /// @return Number of this rank's nodes in contact that changed their facet.
  std::int32_t
  accept_projections(Pairing& pairing, std::span<const std::int32_t> left,
                     std::span<const std::optional<Projection>> places,
                     std::span<const double> x, int version, double reach,
                     std::span<const std::int8_t> closed);

private:
  struct Parts;
  class Best;

  DistributedSurface(std::shared_ptr<mesh::Halo> halo, Parts parts);

  // Ask ranks for the points that are wanted of them, and take what is better
  void ask(std::span<const double> x, std::span<const double> points,
           std::span<const double> normals,
           const std::map<int, std::vector<std::int32_t>>& wanted, Best& best);

  // View of points on this rank's facets. A nearest facet that is only around
  // them is left to the rank that has it, and all that is around that one; the
  // bound may be lowered to its distance.
  std::vector<std::byte> answer(std::span<const double> x,
                                std::span<const double> points,
                                std::span<const double> normals,
                                std::span<double> bound) const;

  void set_known(FacetRecords known);

  FacetRecords _own_records, _around_records, _known;
  geometry::QuadraticFacets _own_parents;
  std::vector<std::int8_t> _is_own;        // of those around
  std::map<FacetKey, std::int32_t> _place; // in _known
};
} // namespace contactx::search
