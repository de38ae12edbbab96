// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/facets.h"
#include "../mesh/halo.h"
#include "pairing.h"

namespace contactx::search
{
/// @brief Facets of a master surface, as the slave nodes of a rank see them: on
/// one rank all of them. All ranks must call its functions without const.
class MasterSurface
{
public:
  /// @brief Take the facets.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] own Facets of the surface.
  MasterSurface(std::shared_ptr<mesh::Halo> halo, geometry::Facets own);

  virtual ~MasterSurface() = default;

  /// @brief Facets that pairs are with; the view ends when they change.
  geometry::FacetList facets() const { return _facets->list(); }

  /// @brief Facets of this rank.
  geometry::FacetList own() const { return _own->list(); }

  /// @brief Facets of this rank and all that share a node with them; some more
  /// in the plane.
  geometry::FacetList around() const { return _around->list(); }

  /// @brief Counts how often `facets` has changed.
  int version() const { return _version; }

  /// @brief Search for points. The halo and `facets` may grow.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
  /// @param[in] points Points (shape=(n, gdim)), row-major.
  /// @param[in] normals Outward normals there; zero accepts facets of any
  /// normal (shape=(n, gdim)).
  /// @param[in] reach Largest distance.
  virtual Found find(std::span<const double> x, std::span<const double> points,
                     std::span<const double> normals, double reach);

  /// @brief Search for nodes as `pair` does, without memory. The halo and
  /// `facets` may grow.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
  /// @param[in] nodes Nodes that this rank owns.
  /// @param[in] normals Outward normals there (shape=(nodes.size(), gdim)).
  /// @param[in] reach Largest distance.
  virtual Found find_of_nodes(std::span<const double> x,
                              std::span<const std::int32_t> nodes,
                              std::span<const double> normals, double reach);

  /// @brief Take the compliance of all nodes, length/force.
  /// @param[in] nodal Values at all nodes (shape=(num_nodes)).
  virtual void take_compliance(std::span<const double> /*nodal*/) {}

  /// @brief True if it is the slave surface, too.
  virtual bool is_self() const { return false; }

  /// @brief True if `pair` finds by itself the nodes that lie behind all of a
  /// body.
  virtual bool sees_bodies() const { return false; }

  /// @brief Pair slave nodes. The halo and `facets` may grow.
  /// @param[in,out] pairing Pairs with `facets`.
  /// @param[in] slave Facets around the slave nodes.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
  /// @param[in] reach Largest distance of a pair.
  /// @param[in] closed Whether slave nodes are in contact
  /// (shape=(num_slaves)).
  /// @return Number of this rank's nodes in contact that changed their facet.
  virtual std::int32_t pair(Pairing& pairing, const geometry::FacetList& slave,
                            std::span<const double> x, double reach,
                            std::span<const std::int8_t> closed);

  /// @brief Add to `facets` all that are in front of slave facets; the halo may
  /// grow.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
  /// @param[in] slave Slave facets.
  /// @param[in] reach Largest distance.
  /// @param[in] margin By which part slave facets are enlarged.
  /// @param[in] along Unit normals of the master to project along, one a slave
  /// facet, zero for its own normal (shape=(num_slave_facets, 3)), or empty.
  virtual void add_facets_within(std::span<const double> x,
                                 const geometry::FacetList& slave, double reach,
                                 double margin,
                                 std::span<const double> along = {});

  /// @brief Keep some facets and drop the others, once the halo has shrunk.
  /// @param[in] used Facets to keep, -1 for none.
  /// @return Their new numbers (shape=(n)).
  virtual std::vector<std::int32_t> keep(std::span<const std::int32_t> used);

  /// @brief Distance from the nearest of this rank's points to a facet of any
  /// rank, infinite without points. The halo and `facets` may grow.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
  /// @param[in] points Points (shape=(n, gdim)), row-major.
  double distance(std::span<const double> x, std::span<const double> points);

  /// @brief Mean of nodal values over the nodes of all facets of all ranks.
  /// @param[in] nodal Values at all nodes (shape=(num_nodes)).
  double mean(std::span<const double> nodal);

  /// @brief Identity of this surface: the names of this rank's
  /// facets (shape=(num_own, 4)).
  std::vector<std::int64_t> identity() const;

  /// @brief Numbers of the nodes of some of `facets` in the mesh as it was
  /// made, -1 where there is none (shape=(n, 4)).
  /// @param[in] which Facets, -1 for none.
  std::vector<std::int64_t> names(std::span<const std::int32_t> which) const;

  /// @brief Facets by what `names` gave. The halo and `facets` may grow.
  /// @param[in] names Names (shape=(n, 4)).
  /// @return Facets, -1 for none (shape=(n)).
  /// @throws std::invalid_argument on all ranks if there is no such facet.
  virtual std::vector<std::int32_t> named(std::span<const std::int64_t> names);

protected:
  /// @brief Take the facets of this rank, and those around them.
  MasterSurface(std::shared_ptr<mesh::Halo> halo,
                std::shared_ptr<const geometry::Facets> own,
                std::shared_ptr<const geometry::Facets> around);

  /// @brief Take other facets that pairs are with.
  void set_facets(geometry::Facets facets);

  /// @brief Check the arguments of a search.
  void check_points(std::span<const double> x, std::span<const double> points,
                    std::span<const double> normals) const;

  std::shared_ptr<mesh::Halo> _halo; ///< Nodes of this rank
  Finder _finder;                    ///< of `around`

private:
  std::vector<std::int64_t> names_of(const geometry::FacetList& facets) const;

  std::shared_ptr<const geometry::Facets> _facets, _own, _around;
  int _version = 0;
};

/// @brief Facets of a master surface on one rank or several; all ranks must
/// take part.
/// @param[in] halo Nodes of this rank.
/// @param[in] offsets First node of each facet that this rank has, and end.
/// @param[in] nodes Nodes of these facets.
/// @param[in] level Where nodes are on quadratic facets that these are parts
/// of, see geometry::Shares: `query` gives all parts of one then; empty
/// otherwise.
std::shared_ptr<MasterSurface>
make_master_surface(std::shared_ptr<mesh::Halo> halo,
                    std::span<const std::int32_t> offsets,
                    std::span<const std::int32_t> nodes,
                    std::span<const std::int8_t> level = {});
} // namespace contactx::search
