// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "scene.h"

namespace contactx::tests
{
/// @brief Surfaces for the search to be tried on, common and degenerate.
enum class Kind
{
  triangles,  ///< not connected, of several sizes
  mixed,      ///< triangles and warped quadrilaterals, not connected
  grid,       ///< connected, triangles and quadrilaterals
  coplanar,   ///< overlapping in one plane, on a lattice: many ties
  coincident, ///< each facet several times
  slivers,    ///< aspect ratios up to 1e6
  single,     ///< one facet
  empty,      ///< none
  segments,   ///< in the plane, not connected
  polygon,    ///< in the plane, closed
  num_kinds
};

inline std::vector<Kind> all_kinds()
{
  std::vector<Kind> kinds;
  for (int k = 0; k < static_cast<int>(Kind::num_kinds); ++k)
    kinds.push_back(static_cast<Kind>(k));
  return kinds;
}

inline void add_random_facet(Scene& scene, Generator& random, int num_nodes,
                             double size, double thickness)
{
  const Vector<3> centre = random.vector<3>(-1, 1);
  const Vector<3> a = size * random.unit<3>();
  const Vector<3> b = thickness * random.unit<3>();
  std::vector<std::int32_t> n{scene.node(centre), scene.node(centre + a)};
  if (num_nodes > 2)
    n.push_back(scene.node(centre + random(0, 1) * a + b));
  if (num_nodes > 3)
    n.push_back(
        scene.node(centre + a + b + 0.2 * thickness * random.unit<3>()));
  scene.facet(n);
}

inline Scene random_scene(Kind kind, Generator& random)
{
  if (kind == Kind::grid)
  {
    const double wave = random(0, 0.2);
    return grid(static_cast<int>(random(1, 8)), Cells::mixed,
                [wave](double s, double t)
                {
                  return Vector<3>{2 * s - 1, 2 * t - 1,
                                   wave * std::sin(5 * s) * std::cos(4 * t)};
                });
  }
  Scene scene(kind == Kind::segments or kind == Kind::polygon ? 2 : 3);
  const int n = kind == Kind::empty    ? 0
                : kind == Kind::single ? 1
                                       : static_cast<int>(random(2, 60));
  for (int i = 0; i < n; ++i)
    switch (kind)
    {
    case Kind::segments:
      add_random_facet(scene, random, 2, random(0.05, 1), 0);
      break;
    case Kind::polygon:
      scene.node({std::cos(6.283185307179586 * i / n),
                  std::sin(6.283185307179586 * i / n)});
      scene.facet({i, (i + 1) % n});
      break;
    case Kind::coplanar:
    {
      const Vector<3> corner{std::round(random(-4, 4)) / 4,
                             std::round(random(-4, 4)) / 4, 0.5};
      const std::int32_t a = scene.node(corner);
      scene.node(corner + Vector<3>{0.25, 0, 0});
      scene.node(corner + Vector<3>{0, 0.25, 0});
      scene.node(corner + Vector<3>{0.25, 0.25, 0});
      scene.patch({a, a + 1, a + 2, a + 3}, i % 2);
      break;
    }
    case Kind::coincident:
      if (i % 4 == 0)
        add_random_facet(scene, random, i % 8 ? 3 : 4, 0.5, 0.5);
      else
        scene.facet({scene.nodes.begin() + scene.offsets.end()[-2],
                     scene.nodes.begin() + scene.offsets.end()[-1]});
      break;
    case Kind::slivers:
      add_random_facet(scene, random, 3 + i % 2, 1,
                       std::pow(10, random(-6, 0)));
      break;
    default:
      add_random_facet(scene, random, kind == Kind::triangles ? 3 : 3 + i % 2,
                       random(0.05, 1), random(0.05, 1));
    }
  return scene;
}

/// @brief A point to search from: anywhere, near, or on a node or an edge.
inline Vector<3> random_query(const Scene& scene, Generator& random, int i)
{
  Vector<3> p = random.vector<3>(-1.5, 1.5);
  if (scene.gdim == 2)
    p[2] = 0;
  const auto facets = scene.facets();
  if (facets.size() == 0 or i % 4 == 0)
    return p;
  const auto f = facets[static_cast<int>(random(0, facets.size()))];
  const Vector<3> a = scene.point(f[0]), b = scene.point(f[1]);
  if (i % 4 == 1)
    return a;
  if (i % 4 == 2)
    return 0.5 * (a + b);
  return a + random(0, 1) * (b - a) + 1e-3 * p;
}
} // namespace contactx::tests
