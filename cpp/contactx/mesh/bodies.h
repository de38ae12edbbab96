// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "ranks.h"
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace contactx::mesh
{
/// @brief Bodies: the connected parts of a mesh, on any number of ranks. They
/// share no nodes.
///
/// A body is named by the smallest number that a node of it has in the mesh as
/// it was made. All ranks must take part in what is called collective.
class Bodies
{
public:
  /// @brief Find the bodies; collective.
  /// @param[in] cells Nodes of the cells of this rank, ghosts last
  /// (shape=(num_cells, width)), row-major.
  /// @param[in] width Nodes a cell.
  /// @param[in] num_owned_cells Number of cells that this rank owns.
  /// @param[in] original Number of each node of the bulk in the mesh as it was
  /// made, ghosts included; the nodes of cells are among these
  /// (shape=(num_bulk)).
  /// @param[in] nodes Nodes of this rank.
  /// @throws std::invalid_argument on all ranks if the arrays do not fit on
  /// one of them.
  Bodies(std::span<const std::int32_t> cells, int width,
         std::int32_t num_owned_cells, std::span<const std::int64_t> original,
         std::shared_ptr<const NodeMap> nodes);

  // Halos call it
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  /// @brief The nodes of this rank.
  const NodeMap& map() const { return *_map; }

  /// @brief Number of bodies.
  std::size_t size() const { return _names.size(); }

  /// @brief Names of all bodies, ascending, the same on all ranks.
  const std::vector<std::int64_t>& names() const { return _names; }

  /// @brief Body of each node by its name (shape=(num_nodes)).
  const std::vector<std::int64_t>& of_node() const { return _of_node; }

  /// @brief Body of each node by its place among the names
  /// (shape=(num_nodes)).
  const std::vector<std::int32_t>& number() const { return _number; }

  /// @brief Body of each cell by its name, ghosts included
  /// (shape=(num_cells)).
  const std::vector<std::int64_t>& of_cell() const { return _of_cell; }

  /// @brief Bodies that some nodes of any rank belong to, ascending;
  /// collective.
  /// @param[in] nodes Nodes of this rank.
  /// @throws std::invalid_argument on all ranks if one of them has no such
  /// node.
  std::vector<std::int64_t> carrying(std::span<const std::int32_t> nodes) const;

  /// @brief Nodes of a body that this rank owns.
  /// @param[in] body Its name.
  std::vector<std::int32_t> nodes(std::int64_t body) const;

  /// @brief Number of nodes of a body on all ranks; collective.
  /// @param[in] body Its name.
  std::int64_t count(std::int64_t body) const;

  /// @brief Cells of a body that this rank owns.
  /// @param[in] body Its name.
  std::vector<std::int32_t> cells(std::int64_t body) const;

  /// @brief Bounding boxes of bodies on all ranks; collective.
  /// @param[in] bodies Names, the same on all ranks.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
  /// @param[in] gdim Geometric dimension.
  /// @return Lowest corners, then highest (shape=(2, num_bodies, gdim)).
  /// @throws std::invalid_argument on all ranks if a body is not there, or the
  /// positions do not fit.
  std::vector<double> boxes(std::span<const std::int64_t> bodies,
                            std::span<const double> x, int gdim) const;

private:
  /// Join parts that are on several ranks: names of all bodies, and of those
  /// that the parts with the given names on this rank belong to.
  std::vector<std::int64_t> across_ranks(std::span<const std::int64_t> here,
                                         std::int32_t num_bulk);
  /// Give nodes that have come to this rank their bodies; collective.
  void nodes_changed();

  std::shared_ptr<const NodeMap> _map;
  std::vector<std::int64_t> _names, _of_node, _of_cell;
  std::vector<std::int32_t> _number;
  std::int32_t _num_owned_cells;
  std::shared_ptr<const void> _observer;
};

/// @brief Smallest of the nodes that each node is connected to by cells
/// (shape=(count)).
/// @param[in] cells Nodes of the cells (shape=(num_cells, width)), row-major.
/// @param[in] width Nodes a cell.
/// @param[in] count Number of nodes.
/// @throws std::invalid_argument if the cells do not fit.
std::vector<std::int32_t> connected_parts(std::span<const std::int32_t> cells,
                                          int width, std::int32_t count);
} // namespace contactx::mesh
