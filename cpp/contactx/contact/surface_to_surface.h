// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../search/facet_search.h"
#include "../search/smooth_surface.h"
#include "deformable_master.h"
#include "mortar_slip.h"

namespace contactx::contact
{
/// @brief kernel::Pairs of slave facets with the facets of a deformable body,
/// with dual multipliers.
///
/// A slave node's constraint gathers from all pairs of its facets. A node of
/// which little is in front of the master is not paired. Facets of which slave
/// nodes belong to other ranks are integrated by all of these.
class SurfaceToSurface : public DeformableMaster
{
public:
  /// @brief Create it with no pair; all ranks must take part.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] slaves Slave nodes.
  /// @param[in] surface Master surface.
  /// @param[in] outside Finds points outside of its body.
  /// @param[in] options How facets are paired.
  SurfaceToSurface(std::shared_ptr<mesh::Halo> halo,
                   std::shared_ptr<const SlaveNodes> slaves,
                   std::shared_ptr<search::MasterSurface> surface,
                   std::shared_ptr<search::InsideTest> outside,
                   const PairingOptions& options);
  SurfaceToSurface(const SurfaceToSurface&) = delete;
  SurfaceToSurface& operator=(const SurfaceToSurface&) = delete;

  /// @brief kernel::Pairs are then those of the start alone, whatever has been
  /// before.
  void begin_step() override;
  void rebuild() override;
  bool integrates() const override { return true; }
  void nodes_changed() override;
  std::optional<std::vector<double>>
  turn(std::span<const double> x) const override;
  std::vector<double> rotations(std::span<const double> before,
                                std::span<const double> x) const override;
  void touch(std::span<const std::int8_t> which, std::span<const double> x,
             std::span<const double> u,
             std::span<const double> offset) override;

  /// @brief As integrals change continuously no node changes its facet.
  std::int32_t search(std::span<const double> x,
                      std::span<const std::int8_t> closed) override;
  std::vector<std::int8_t> paired() const override { return _paired; }
  std::vector<kernel::Pairs> pairs() const override;
  std::optional<std::vector<kernel::Pairs>>
  update(std::span<const double> x, bool frozen,
         std::span<const double> offset) override;
  std::vector<double> normals() const override;
  kernel::Weights weights() const override;

  /// @brief Area in front of the master. A node that is pushed off within
  /// an iteration keeps some until the next search.
  std::vector<double> area(std::span<const double> whole) const override;
  std::vector<double> rise() const override { return _rise; }
  std::vector<double> origin() const override
  {
    return _options.is_small ? _origin.moved() : _slip.origin();
  }
  std::vector<double> compliance(std::span<const double> nodal) const override;

  /// @brief On a plane of symmetry nothing moves across it: only half of what
  /// is around its slave nodes is integrated, where the master seems to.
  Mobility mobility(std::span<const std::int8_t> free) const override;
  std::vector<Saved> save() const override;
  void load(const std::vector<Saved>& saved) override;
  double distance(std::span<const double> x) const override;

protected:
  /// @brief True after the first search.
  bool is_found() const { return _found.has_value(); }

  /// @brief Measure along the slave facets' own normals at edges, too.
  void take_own_normals() { _edges.clear(); }

  /// @brief Both surfaces.
  const MortarSides& sides() const { return _sides; }

  /// @brief kernel::Pairs with their integrals.
  const Mortar& mortar() const { return _mortar; }

  /// @brief kernel::Pairs of facets as the kernels read them.
  std::vector<kernel::Pairs> groups(const Mortar& mortar,
                                    bool is_movement = false) const
  {
    return _sides.pairs(mortar, _dual, _normal, _keeps, _corner, is_movement);
  }

private:
  void set_master_facets();
  void pair(std::span<const double> x);
  void update_facets(std::span<const double> x, double margin,
                     std::span<const double> along = {});
  bool lacks(std::span<const double> x);
  bool has_moved(std::span<const double> x) const;
  geometry::FacetPairs find(std::span<const double> x, double margin,
                            std::span<const double> along = {});
  geometry::FacetPairs facing(std::span<const double> x,
                              const geometry::FacetPairs& found) const;
  geometry::FacetPairs without_outside(std::span<const double> x,
                                       geometry::FacetPairs found) const;
  std::vector<double> integrate(std::span<const double> x);
  geometry::Integrals integrals(std::span<const double> x,
                                std::span<const double> normal) const;
  void find_rise(std::span<const double> of_pairs);
  void find_corners(std::span<const double> x);
  void take_normals(std::span<const double> x);
  bool is_at_edge(std::int32_t facet) const
  {
    return not _edges.empty() and _edges[facet];
  }
  std::size_t num_own_parts() const;
  Mortar slip_pairs() const;
  Mortar normalised() const;
  Mortar of_slip(std::span<const double> x, std::span<const double> u) const;
  std::vector<double> along(std::span<const double> u) const;

  MortarSides _sides;
  MortarSlip _slip;
  std::optional<search::FacetSearch> _search;
  double _inradius;
  std::vector<std::int32_t> _nodes;   // of both surfaces here
  std::vector<double> _at, _searched; // positions; those of _nodes
  std::vector<double> _whole, _area;  // of the slave nodes
  std::vector<std::int8_t> _paired;
  // A facet of each slave node, and its number there
  std::vector<std::pair<std::int32_t, int>> _place;
  std::vector<double> _weight; // at the corners of the slave facets
  std::optional<geometry::FacetPairs> _found;
  std::vector<double> _dual, _normal;
  // Slave facets at edges; those whose direction is kept, and the directions
  std::vector<std::int8_t> _edges;
  std::vector<kernel::Keeps> _keeps;
  std::vector<double> _kept;
  // Smooth surfaces of both sides and their patches, by facets
  std::optional<search::SmoothSurface> _smooth_slave, _smooth_master;
  std::vector<geometry::SmoothFacet> _slave_patches, _master_patches;
  std::vector<double> _rise,
      _corner; // the latter: normals at the facets' nodes
  Mortar _mortar;
};

/// @brief Slave facets tied to the facets that are in front of them in the
/// reference configuration.
class SurfaceTie final : public SurfaceToSurface
{
public:
  /// @copydoc SurfaceToSurface::SurfaceToSurface
  SurfaceTie(std::shared_ptr<mesh::Halo> halo,
             std::shared_ptr<const SlaveNodes> slaves,
             std::shared_ptr<search::MasterSurface> surface,
             std::shared_ptr<search::InsideTest> outside,
             PairingOptions options);

  /// @brief Only the first search counts.
  std::int32_t search(std::span<const double> x,
                      std::span<const std::int8_t> closed) override;
  void begin_step() override {}
  std::vector<kernel::Pairs> pairs() const override;

  /// @brief The offset makes the tie longer.
  std::optional<std::vector<kernel::Pairs>>
  update(std::span<const double> x, bool frozen,
         std::span<const double> offset) override;
  std::vector<Saved> save() const override { return {}; }
  void load(const std::vector<Saved>&) override {}

private:
  std::vector<double> _offset;
};
} // namespace contactx::contact
