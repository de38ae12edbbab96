// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "scene.h"
#include "thread_ranks.h"
#include <contactx/contact/slave_nodes.h>
#include <set>

namespace contactx::tests
{
/// @brief What a sheet is made of; nothing for segments in the plane.
using Facets = std::optional<Cells>;

inline const std::vector<Facets> all_facets{
    std::nullopt, Cells::triangles, Cells::quadrilaterals, Cells::mixed};

/// @brief A slave surface of n cells of uneven size an axis, a paraboloid or
/// flat, over (about) the unit square or interval.
inline Scene slave_sheet(Facets facets, int n, Generator& random,
                         bool curved = true, double uneven = 0.25)
{
  const auto at = [&](double s, double t, int dim)
  {
    Vector<3> p{s, t, 0};
    for (int k = 0; k < dim; ++k)
    {
      p[k] += uneven / n * random(-1, 1);
      p[dim] += curved ? p[k] * p[k] : 0;
    }
    return p;
  };
  if (facets)
    return grid(n, *facets, [&at](double s, double t) { return at(s, t, 2); });
  return line(n, [&at](double s) { return at(s, 0, 1); });
}

/// @brief Unit normals of the paraboloid, or of a plane, downward.
inline std::vector<double> sheet_normals(const Scene& scene, bool curved = true)
{
  std::vector<double> normal;
  const int last = scene.gdim - 1;
  for (std::int32_t i = 0; i < scene.num_nodes(); ++i)
  {
    Vector<3> n{};
    for (int k = 0; k < last; ++k)
      n[k] = curved ? 2 * scene.point(i)[k] : 0;
    n[last] = -1;
    n = (1 / norm(n)) * n;
    normal.insert(normal.end(), n.begin(), n.begin() + scene.gdim);
  }
  return normal;
}

/// @brief The surface among other nodes of a bulk, and the place of its nodes
/// there; they keep their order.
inline std::pair<Scene, std::vector<std::int32_t>> in_bulk(const Scene& scene,
                                                           Generator& random)
{
  Scene bulk(scene.gdim);
  std::vector<std::int32_t> place;
  for (std::int32_t i = 0; i < scene.num_nodes(); ++i)
  {
    for (double others = random(0, 3); others > 1; --others)
      bulk.node(random.vector<3>(-1, 1));
    place.push_back(bulk.node(scene.point(i)));
  }
  bulk.node(random.vector<3>(-1, 1));
  bulk.offsets = scene.offsets;
  for (std::int32_t node : scene.nodes)
    bulk.nodes.push_back(place[node]);
  return {bulk, place};
}

/// @brief Slave nodes of a surface on one rank.
inline std::shared_ptr<contact::SlaveNodes> slave_nodes(const Scene& scene)
{
  const auto nodes = std::make_shared<mesh::SerialNodes>(scene.num_nodes());
  return std::make_shared<contact::SlaveNodes>(nodes, scene.facets(),
                                               scene.facets());
}

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

/// @brief Part of a surface that a rank has, by the rank of each node.
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
