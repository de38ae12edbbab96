// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../kernel/pairs.h"
#include "saved.h"
#include <optional>
#include <span>

namespace contactx::contact
{
/// @brief Part of a relative movement that Dirichlet conditions leave free:
/// norms of gradients over free displacements, zero where neither slave node
/// nor master can move.
struct Mobility
{
  std::vector<double> normal; ///< of the gap (shape=(n))
  std::vector<double> each;   ///< of each component (shape=(n, gdim))
};

/// @brief Smallest gap that frozen pairs hide, and the smallest one over the
/// length of an edge of its facet.
struct HiddenGap
{
  double gap = 0;
  double part = 0;
};

/// @brief kernel::Pairs of the slave nodes of a contact with its master.
///
/// Positions `x` are those of all nodes on this rank (shape=(num_nodes,
/// gdim)), row-major. All ranks must take part in what is called collective;
/// all else is this rank's alone. n is the number of owned slave nodes.
///
/// Slip is measured from where a slave node was at the step's start; of one
/// that touches first within the step, from where it touched.
class Master
{
public:
  virtual ~Master() = default;

  /// @brief Geometric dimension.
  virtual int gdim() const = 0;

  /// @brief Largest distance of a pair.
  virtual double reach() const = 0;

  /// @brief True if the master has no degrees of freedom.
  virtual bool is_rigid() const { return false; }

  /// @brief True if its conditions are integrals over facets, so that normals
  /// are means.
  virtual bool integrates() const { return false; }

  /// @brief True if it is the slave surface itself.
  virtual bool is_self() const { return false; }

  /// @brief Take a converged configuration, the start of the next step;
  /// collective. The halo has it already.
  /// @param[in] x Its positions.
  virtual void accept(std::span<const double> /*x*/) {}

  /// @brief Start a step: slip is measured from its start, and pairs may move
  /// again; collective.
  virtual void begin_step() = 0;

  /// @brief Add the nodes of the pairs to the halo again, once it has shrunk;
  /// collective.
  virtual void rebuild() {}

  /// @brief Make positions that were kept fit nodes that have changed;
  /// collective.
  virtual void nodes_changed() {}

  /// @brief Rotation of the master under each slave node since the step
  /// before was accepted.
  /// @return Rotations (shape=(n, gdim, gdim)); nothing where all is as it
  /// was.
  virtual std::optional<std::vector<double>>
  turn(std::span<const double> x) const = 0;

  /// @brief Rotation of the master from some positions to others.
  /// @param[in] before Positions.
  /// @param[in] x Positions.
  /// @return Rotations (shape=(n, gdim, gdim)); nothing where none is known.
  virtual std::vector<double> rotations(std::span<const double> /*before*/,
                                        std::span<const double> /*x*/) const
  {
    return {};
  }

  /// @brief Measure the slip of nodes that touch first within the step from
  /// where they do: where the straight path from the step's start to its first
  /// iterate, relative to the master, intersects the master.
  /// @param[in] which 1 at those slave nodes, else 0 (shape=(n)).
  /// @param[in] x Positions at that iterate; at the one that closes them for
  /// what had no master at the start.
  /// @param[in] u Displacements that led there.
  /// @param[in] offset Offset, a length that is taken off the gap (shape=(n)).
  virtual void touch(std::span<const std::int8_t> which,
                     std::span<const double> x, std::span<const double> u,
                     std::span<const double> offset) = 0;

  /// @brief Pair the slave nodes; collective.
  /// @param[in] x Positions.
  /// @param[in] closed 1 at slave nodes in contact, else 0 (shape=(n)).
  /// @return Number of this rank's nodes in contact that changed their facet.
  virtual std::int32_t search(std::span<const double> x,
                              std::span<const std::int8_t> closed) = 0;

  /// @brief 1 at slave nodes that have a pair, else 0 (shape=(n)).
  virtual std::vector<std::int8_t> paired() const = 0;

  /// @brief kernel::Pairs by the kind of their facets, with the data of the
  /// last search.
  virtual std::vector<kernel::Pairs> pairs() const = 0;

  /// @brief Data of the pairs at an iterate between two searches.
  /// @param[in] x Positions.
  /// @param[in] frozen Whether normals and projections stay those of the last
  /// search.
  /// @param[in] offset Offset, a length that is taken off the gap (shape=(n)).
  /// @return The pairs, nothing where their data have not changed.
  virtual std::optional<std::vector<kernel::Pairs>>
  update(std::span<const double> x, bool frozen, std::span<const double> offset)
      = 0;

  /// @brief Unit normals that the last search found, zero where there is no
  /// pair (shape=(n, 3)).
  virtual std::vector<double> normals() const = 0;

  /// @brief Relative movement of each slave node and its master.
  virtual kernel::Weights weights() const = 0;

  /// @brief Movement of a rigid obstacle in this step, in front of each slave
  /// node: along its normal, and with slip along its surface (shape=(n, gdim));
  /// empty for none.
  virtual std::vector<double> movement() const { return {}; }

  /// @brief Length that is taken off the gap of each slave node, as the last
  /// search found it: how far smooth surfaces rise over their facets
  /// (shape=(n)); empty for nothing.
  virtual std::vector<double> rise() const { return {}; }

  /// @brief Area that each slave node's multiplier acts on (shape=(n)).
  /// @param[in] whole Its part of the slave surface in front of the master
  /// (shape=(n)).
  virtual std::vector<double> area(std::span<const double> whole) const
  {
    return {whole.begin(), whole.end()};
  }

  /// @brief Take which corners of the slave facets face the master; only what
  /// integrates over facets on its own needs to know.
  /// @param[in] faces 1 at those corners, else 0, in the order of the facets'
  /// nodes.
  virtual void set_front_facets(std::span<const std::int8_t> /*faces*/) {}

  /// @brief Vector that is taken off the movement that kernels measure
  /// (shape=(n, gdim)); empty for nothing.
  virtual std::vector<double> origin() const { return {}; }

  /// @brief Compliance of the master at each slave node (shape=(n));
  /// collective.
  /// @param[in] nodal Compliance of each node, length/force
  /// (shape=(num_nodes)).
  virtual std::vector<double> compliance(std::span<const double> nodal) const
      = 0;

  /// @brief Part of the relative movement that is free.
  /// @param[in] free 1 at displacements that are not prescribed, else 0
  /// (shape=(num_nodes, gdim)).
  virtual Mobility mobility(std::span<const std::int8_t> free) const = 0;

  /// @brief Whole numbers that tell this master from another to which `save`
  /// would not fit, each row on one rank alone.
  virtual std::vector<Saved> identity() const { return {}; }

  /// @brief State that the next search starts from. Facets are saved by their
  /// nodes' numbers in the mesh as it was made, -1 where there is none.
  virtual std::vector<Saved> save() const = 0;

  /// @brief Take over what `save` gave for the same surfaces; collective.
  /// @throws std::invalid_argument if it does not fit; nothing has changed.
  virtual void load(const std::vector<Saved>& saved) = 0;

  /// @brief Distance from the nearest of this rank's slave nodes to the
  /// master; collective.
  virtual double distance(std::span<const double> x) const = 0;

  /// @brief Slave nodes whose pair has alternated between facets and was
  /// frozen.
  virtual std::vector<std::int32_t> frozen_pairs() const { return {}; }

  /// @brief Release frozen pairs and count anew how often pairs alternate.
  virtual void reset_flips() {}

  /// @brief Smallest gap that this rank's frozen pairs hide; collective.
  /// @param[in] x Positions of all nodes.
  /// @param[in] closed Whether slave nodes are in contact: a gap in front of
  /// one counts as a penetration (shape=(n)).
  virtual HiddenGap
  deepest_frozen_pair(std::span<const double> /*x*/,
                      std::span<const std::int8_t> /*closed*/) const
  {
    return {};
  }
};
} // namespace contactx::contact
