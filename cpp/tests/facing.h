// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "facets.h"
#include "scene.h"
#include <contactx/geometry/gather.h>
#include <contactx/search/facet_search.h>

namespace contactx::tests
{
/// @brief The same facet seen from behind.
template <class F>
geometry::Nodes<F> turned(geometry::Nodes<F> x)
{
  if constexpr (F::nodes == 2)
    std::swap(x[0], x[1]);
  else
    std::swap(x[1], x[2]);
  return x;
}

/// @brief Surface of n segments, or n x n cells, over [low, high]^2, that looks
/// up or down; its nodes are at position(s, t).
template <class Position>
Scene sheet(int gdim, int n, Cells cells, bool up, double low, double high,
            Position position)
{
  const auto at = [low, high](double s) { return low + s * (high - low); };
  if (gdim == 2)
    return line(n, [&](double s) { return position(at(up ? 1 - s : s), 0.0); });
  return grid(n, cells, [&](double s, double t)
              { return up ? position(at(s), at(t)) : position(at(t), at(s)); });
}

/// @brief The nodes of a flat sheet: at height `z`.
inline auto level(int gdim, double z)
{
  return [gdim, z](double s, double t)
  { return gdim == 2 ? Vector<3>{s, z, 0} : Vector<3>{s, t, z}; };
}

/// @brief A surface of one facet.
template <class F>
Scene single(const geometry::Nodes<F>& x)
{
  Scene scene(F::gdim);
  std::vector<std::int32_t> nodes;
  for (const auto& p : x)
  {
    Vector<3> q{};
    std::copy(p.begin(), p.end(), q.begin());
    nodes.push_back(scene.node(q));
  }
  scene.facet(nodes);
  return scene;
}

/// @brief A slave and a master surface, over common nodes.
struct Facing
{
  int gdim;
  std::vector<double> x;
  Scene slave, master; ///< with the numbers of the common nodes

  Facing(const Scene& below, const Scene& above)
      : gdim(below.gdim), x(below.x), slave(below), master(above)
  {
    const auto first = static_cast<std::int32_t>(x.size()) / gdim;
    x.insert(x.end(), above.x.begin(), above.x.end());
    for (std::int32_t& node : master.nodes)
      node += first;
  }

  template <class Map>
  void move(Map&& map)
  {
    for (std::size_t i = 0; i < x.size() / gdim; ++i)
      std::copy_n(map(point(i)).begin(), gdim, &x[gdim * i]);
  }

  search::FacetSearch search() const
  {
    return {slave.offsets, slave.nodes, master.offsets, master.nodes, gdim};
  }

  geometry::FacetPairs find(double reach = 10, double margin = 0) const
  {
    return search().find(x, reach, margin);
  }

  geometry::FacetPairs all_pairs() const
  {
    geometry::FacetPairs pairs;
    for (std::int32_t f = 0; f < slave.facets().size(); ++f)
      for (std::int32_t g = 0; g < master.facets().size(); ++g)
      {
        pairs.slave.push_back(f);
        pairs.master.push_back(g);
      }
    return pairs;
  }

  geometry::Integrals integrals(const geometry::FacetPairs& pairs,
                                std::span<const double> reference,
                                std::span<const double> normal = {}) const
  {
    return geometry::integrals(slave.facets(), master.facets(), pairs, x,
                               reference, gdim, normal);
  }

  geometry::Integrals integrals(const geometry::FacetPairs& pairs) const
  {
    return integrals(pairs, x);
  }

  Vector<3> point(std::int32_t node) const { return vector_at(x, node, gdim); }
};

/// @brief Weight int Phi_s N_l of a pair.
inline double weight(const geometry::Integrals& found, std::size_t pair, int s,
                     int l)
{
  constexpr int n = geometry::most_nodes;
  return found.weight[n * n * pair + n * s + l];
}
} // namespace contactx::tests
