// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/found_nodes.h"
#include "chords.h"
#include "edges.h"
#include <optional>
#include <string>

/// @brief Checks of a converged iterate by its geometry alone.
namespace contactx::audit
{
using mesh::found_nodes;
using mesh::FoundNodes;

/// @brief Depth of a master below a slave facet, between its nodes.
struct Depth
{
  double excess;          ///< ratio to what the mesh explains
  double depth;           ///< the depth
  double size;            ///< size of the facet
  bool is_held;           ///< whether a node of the facet is in contact
  std::vector<double> at; ///< where that is (shape=(gdim))
};

/// @brief A rigid surface that touches slave facets, by its radius of
/// curvature: where that is smallest by the facets' size.
struct Roundness
{
  double radius;          ///< 1 / curvature
  double size;            ///< size of the largest facet around the node
  std::vector<double> at; ///< the node in contact (shape=(gdim))

  /// @brief How many facets the radius has.
  double facets() const { return radius / size; }

  /// @brief True if that are too few for the direction of the force: it swings
  /// with the place of the nodes.
  bool is_coarse() const;

  /// @brief What that means and what to do: one sentence, which the name of the
  /// contact goes before.
  std::string words() const;
};

/// @brief Findings of one contact, the same on each rank.
struct Findings
{
  /// Nodes that went through the other surface within the step; of an obstacle
  /// slave nodes and facets, which have no first one
  FoundNodes passed;
  /// Slave nodes that came behind the master without a pair, or are inside an
  /// obstacle that they face away from; sought where nothing passed
  FoundNodes inside;
  /// Where the master is deepest below a slave facet, by what the mesh
  /// explains; nothing where it is in front of none
  std::optional<Depth> deepest;
  /// Whether that is deeper than the mesh explains, and nothing else was found:
  /// where nodes are inside the master their facets are, too
  bool penetrates_too_deep = false;
  double facet_size = 0; ///< size of the largest slave facet
  /// Distance across which facets press that are integrated, though nothing
  /// touches; zero where something does, or nothing presses
  double apart = 0;
  /// Of an obstacle that is curved where nodes touch it; nothing of others
  std::optional<Roundness> roundness{};
  /// Of two bodies whose round surfaces fit each other; nothing of others
  std::optional<Chords> chords{};
  /// Of two bodies by node-to-surface contact, where anything presses
  std::optional<EdgeForce> edges{};
  /// What to warn of, of one contact each once
  std::vector<std::string> warnings{};

  /// @brief True if the iterate is wrong.
  bool is_fault() const
  {
    return passed.count > 0 or inside.count > 0 or penetrates_too_deep
           or apart > 0;
  }
};

/// @brief Looks at one contact; all ranks must take part.
class ContactAudit
{
public:
  virtual ~ContactAudit() = default;

  /// @brief Take the configuration of now as the one before the next step.
  virtual void accept() = 0;

  /// @brief Look at the state of now.
  /// @param[in] start Positions of all nodes when the step started
  /// (shape=(num_nodes, gdim)), row-major.
  virtual Findings find(std::span<const double> start) = 0;

protected:
  /// @brief Warn of the state of now, if no state that was accepted was warned
  /// of the same.
  /// @param[in,out] findings What was found.
  /// @param[in] about What to warn of, each if it is coarse; in each state the
  /// same kinds.
  template <class... Coarse>
  void warn(Findings& findings, const std::optional<Coarse>&... about)
  {
    _is_coarse = {(about and about->is_coarse())...};
    _has_warned.resize(_is_coarse.size(), false);
    std::size_t k = 0;
    const auto add = [&](const auto& its)
    {
      if (_is_coarse[k] and not _has_warned[k])
        findings.warnings.push_back(its->words());
      ++k;
    };
    (add(about), ...);
  }

  /// @brief The state of now is accepted.
  void accept_warning()
  {
    for (std::size_t k = 0; k < _is_coarse.size(); ++k)
      _has_warned[k] = _has_warned[k] or _is_coarse[k];
  }

private:
  std::vector<bool> _is_coarse, _has_warned;
};

/// @brief Rows of some nodes.
/// @param[in] values Values of all nodes (shape=(num_nodes, width)), row-major.
/// @param[in] nodes Nodes.
/// @param[in] width Values a node.
/// @return Values (shape=(n, width)).
std::vector<double> rows_of(std::span<const double> values,
                            std::span<const std::int32_t> nodes, int width);

/// @brief The depth of all ranks with the largest excess; all ranks must take
/// part.
/// @param[in] ranks The ranks.
/// @param[in] mine That of this rank, if it has one.
/// @param[in] gdim Geometric dimension, 2 or 3.
std::optional<Depth> deepest(mesh::Ranks& ranks,
                             const std::optional<Depth>& mine, int gdim);

/// @brief The roundness of all ranks with the fewest facets; all ranks must
/// take part.
/// @param[in] ranks The ranks.
/// @param[in] mine That of this rank, if it has one.
/// @param[in] gdim Geometric dimension, 2 or 3.
std::optional<Roundness>
sharpest(mesh::Ranks& ranks, const std::optional<Roundness>& mine, int gdim);

/// @brief Number of the value that is the largest one and more than minus
/// infinity; the first of equal ones, -1 for none.
std::ptrdiff_t worst_of(std::span<const double> values);
} // namespace contactx::audit
