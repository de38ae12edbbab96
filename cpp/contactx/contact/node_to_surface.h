// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../search/pairing.h"
#include "../search/projections.h"
#include "../search/smooth_surface.h"
#include "deformable_master.h"

namespace contactx::contact
{
/// @brief kernel::Pairs of slave nodes with the facets of a deformable body,
/// each with the one that it projects on.
class NodeToSurface : public DeformableMaster
{
public:
  /// @brief Create it with no node paired.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] slaves Slave nodes.
  /// @param[in] surface Master surface.
  /// @param[in] outside Finds points outside of its body.
  /// @param[in] options How nodes are paired.
  NodeToSurface(std::shared_ptr<mesh::Halo> halo,
                std::shared_ptr<const SlaveNodes> slaves,
                std::shared_ptr<search::MasterSurface> surface,
                std::shared_ptr<search::InsideTest> outside,
                const PairingOptions& options);

  void begin_step() override;
  void rebuild() override;
  void nodes_changed() override;
  std::optional<std::vector<double>>
  turn(std::span<const double> x) const override;
  void touch(std::span<const std::int8_t> which, std::span<const double> x,
             std::span<const double> u,
             std::span<const double> offset) override;
  std::int32_t search(std::span<const double> x,
                      std::span<const std::int8_t> closed) override;
  std::vector<std::int8_t> paired() const override;
  std::vector<kernel::Pairs> pairs() const override;
  std::optional<std::vector<kernel::Pairs>>
  update(std::span<const double> x, bool frozen,
         std::span<const double> offset) override;
  std::vector<double> normals() const override;
  kernel::Weights weights() const override;
  std::vector<double> compliance(std::span<const double> nodal) const override;
  Mobility mobility(std::span<const std::int8_t> free) const override;
  std::vector<Saved> save() const override;
  void load(const std::vector<Saved>& saved) override;
  double distance(std::span<const double> x) const override;
  std::vector<std::int32_t> frozen_pairs() const override;
  void reset_flips() override { _pairing.begin_step(); }
  HiddenGap
  deepest_frozen_pair(std::span<const double> x,
                      std::span<const std::int8_t> closed) const override;
  std::vector<double> rise() const override { return _places.rise; }

protected:
  /// @brief Where the slip of each slave node is measured from (shape=(n)).
  virtual std::vector<kernel::FacetSlip> slip() const;

  /// @brief Number of owned slave nodes.
  std::size_t size() const { return _pairing.slaves().size(); }

  /// @brief Rows of the owned slave nodes (shape=(n, gdim)).
  /// @param[in] x Values of all nodes (shape=(num_nodes, gdim)).
  std::vector<double> at_slaves(std::span<const double> x) const;

  /// @brief Projections of points, one a slave node, on the slave nodes'
  /// facets.
  search::Projections projections(std::span<const double> x,
                                  std::span<const double> points) const;

  /// @brief Points at local coordinates of the slave nodes' facets.
  search::FacetPoints facet_points(std::span<const double> x,
                                   std::span<const double> xi) const;

  /// @brief kernel::Pairs of the last search.
  const search::Pairing& pairing() const { return _pairing; }

private:
  /// Where slave nodes are measured against their facets, as `search::Pairing`
  /// names it
  struct MeasuredPlaces
  {
    std::vector<std::int32_t> feature;
    std::vector<double> xi, cone, normal;
    std::vector<double> rise; ///< see `Master::rise`
  };

  void find_places();
  kernel::FacetPair found_pair(std::size_t i) const;
  void load_places(const std::vector<Saved>& saved);
  std::int32_t drop_outside(std::span<const double> x,
                            std::span<const std::int8_t> closed);
  void restore(std::span<const std::int32_t> facet,
               const std::vector<Saved>& saved);
  std::vector<Saved> saved_pairs() const;
  std::vector<double> frames(std::span<const double> x) const;

  search::Pairing _pairing;
  MeasuredPlaces _places;
  std::optional<search::SmoothSurface> _smooth;
  // Positions of all nodes at the last search, and where the slip of each slave
  // node starts in finite sliding, as a place in the configuration of the
  // step's start
  std::vector<double> _at, _start;
};

/// @brief Slave nodes tied to the facets that they project on in the reference
/// configuration.
class NodeTie final : public NodeToSurface
{
public:
  using NodeToSurface::NodeToSurface;

  /// @brief Only the first search counts.
  std::int32_t search(std::span<const double> x,
                      std::span<const std::int8_t> closed) override;

  /// @brief The offset makes the tie longer.
  std::optional<std::vector<kernel::Pairs>>
  update(std::span<const double> x, bool frozen,
         std::span<const double> offset) override;

protected:
  std::vector<kernel::FacetSlip> slip() const override;

private:
  bool _found = false;
  std::vector<double> _offset, _xi, _gap, _arm, _normal;
};
} // namespace contactx::contact
