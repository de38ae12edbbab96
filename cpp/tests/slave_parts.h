// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "scene.h"
#include "thread_ranks.h"
#include <contactx/contact/slave_nodes.h>
#include <memory>
#include <set>

namespace contactx::tests
{
/// @brief A surface on one of several ranks.
struct Part
{
  Scene scene; ///< facets around the rank's own nodes
  std::shared_ptr<const contact::SlaveNodes> slaves;
  std::vector<std::int32_t> numbers; ///< of the scene's nodes in the whole one
  std::int32_t num_owned;

  /// @brief Rows of the owned slave nodes from those of all slave nodes of the
  /// whole surface, which are all of its nodes.
  template <class T>
  std::vector<T> take(const std::vector<T>& values, int width = 1) const
  {
    std::vector<T> result;
    for (std::int32_t i : slaves->owned())
      result.insert(result.end(), values.begin() + numbers[i] * width,
                    values.begin() + (numbers[i] + 1) * width);
    return result;
  }
};

/// @brief Part of a surface that a rank has.
/// @param[in] whole The surface.
/// @param[in] owner Rank of each node.
/// @param[in] rank The rank.
inline Part part_of(const Scene& whole, const std::vector<int>& owner,
                    mesh::Ranks& rank)
{
  Part part{Scene(whole.gdim), nullptr, {}, 0};
  const geometry::FacetList facets = whole.facets();
  std::set<std::int32_t> others;
  std::vector<std::int32_t> here;
  for (std::int32_t f = 0; f < facets.size(); ++f)
    if (std::ranges::any_of(facets[f], [&](std::int32_t node)
                            { return owner[node] == rank.rank(); }))
    {
      here.push_back(f);
      others.insert(facets[f].begin(), facets[f].end());
    }
  for (std::int32_t i = 0; i < std::ssize(owner); ++i)
    if (owner[i] == rank.rank())
    {
      part.numbers.push_back(i);
      others.erase(i);
    }
  part.num_owned = static_cast<std::int32_t>(part.numbers.size());
  part.numbers.insert(part.numbers.end(), others.begin(), others.end());
  for (std::int32_t i : part.numbers)
    part.scene.node(whole.point(i));
  Scene own(whole.gdim);
  for (std::int32_t f : here)
  {
    std::vector<std::int32_t> nodes;
    for (std::int32_t node : facets[f])
      nodes.push_back(static_cast<std::int32_t>(
          std::ranges::find(part.numbers, node) - part.numbers.begin()));
    part.scene.facet(nodes);
    if (owner[facets[f].front()] == rank.rank())
      own.facet(nodes);
  }
  part.slaves = std::make_shared<contact::SlaveNodes>(
      std::make_shared<NumberedNodes>(
          rank,
          std::vector<std::int64_t>(part.numbers.begin(), part.numbers.end()),
          part.num_owned),
      part.scene.facets(), own.facets());
  return part;
}
} // namespace contactx::tests
