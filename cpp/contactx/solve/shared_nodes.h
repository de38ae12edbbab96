// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace contactx::solve
{
/// @brief One of several contacts at an iterate. Arrays are those of its slave
/// nodes that this rank owns, of which there are n.
struct Closing
{
  bool is_tied;                        ///< whether it is a tie
  std::span<const std::int8_t> closes; ///< 1 at nodes that it would close
                                       ///< (shape=(n))
  std::span<const double> gap;         ///< (shape=(n))
  std::span<const double> normal;      ///< unit normals of the master, zero
                                       ///< without a pair (shape=(n, 3))
};

/// @brief Slave nodes of one of several contacts that share nodes.
struct Shared
{
  std::vector<std::int8_t> redundant;    ///< 1 where a node leaves it to others
                                         ///< (shape=(n))
  std::vector<std::int8_t> frictionless; ///< 1 where friction is left out
                                         ///< (shape=(n))
};

/// @brief Keeps the system solvable where a node is slave in several contacts,
/// as in a corner.
///
/// The rule: of the contacts that a node closes, the deepest comes first, and
/// one whose normal lies nearly in the span of the normals before it stays
/// open. A node that closes several contacts slides without friction in all of
/// them, so that its constraints are the independent normals alone. A tie
/// constrains a node in every direction: the node's other contacts stay open.
class SharedNodes
{
public:
  /// @brief Find the nodes.
  /// @param[in] slaves Slave nodes of each contact that this rank owns, each
  /// once.
  explicit SharedNodes(
      const std::vector<std::span<const std::int32_t>>& slaves);

  /// @brief Nodes that are slave in several contacts, in order.
  const std::vector<std::int32_t>& shared() const { return _shared; }

  /// @brief Number of nodes that close several contacts at the last iterate.
  std::int32_t corners() const { return _corners; }

  /// @brief Decide which contacts of shared nodes may close, and where friction
  /// counts.
  /// @param[in] contacts The contacts at an iterate.
  /// @throws std::invalid_argument if sizes do not fit; nothing has changed.
  std::vector<Shared> update(const std::vector<Closing>& contacts);

private:
  struct Place
  {
    std::size_t contact;
    std::size_t node; // among the slave nodes of the contact
  };

  void decide(const std::vector<Closing>& contacts, std::vector<Place>& closed,
              std::vector<Shared>& result);

  std::vector<std::size_t> _sizes;
  std::vector<std::int32_t> _shared;
  std::vector<std::vector<Place>> _places; // of each shared node
  std::int32_t _corners = 0;
};
} // namespace contactx::solve
