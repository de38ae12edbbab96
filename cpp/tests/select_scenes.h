// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "scene.h"
#include <contactx/search/select.h>

namespace contactx::tests
{
/// @brief The projection that a search finds for a point of any normal.
inline std::optional<search::Projection>
paired(const Scene& scene, const Vector<3>& p, const Vector<3>& normal = {})
{
  const search::Surface surface = scene.surface();
  const search::BoxTree tree(surface.boxes(scene.x));
  const auto q = search::nearest_facet(surface, tree, scene.x, p, normal, 10);
  return q ? search::select(surface, scene.x, p, *q) : q;
}

/// @brief Two unit squares that meet at an edge on the y axis: the first is
/// x in [-1, 0] at z = 0 with the normal (0, 0, 1), the second is turned down
/// by the angle `down`, so that the edge is a ridge where it is positive and
/// a valley where it is negative.
inline Scene fold(double down, bool split)
{
  Scene scene(3);
  const double c = std::cos(down), s = std::sin(down);
  for (Vector<3> p : {Vector<3>{-1, 0, 0},
                      {0, 0, 0},
                      {-1, 1, 0},
                      {0, 1, 0},
                      {c, 0, -s},
                      {c, 1, -s}})
    scene.node(p);
  scene.patch({0, 1, 2, 3}, split);
  scene.patch({1, 4, 3, 5}, split);
  return scene;
}

/// @brief The fold of two unit segments in the plane, with the body below.
inline Scene fold_2d(double down)
{
  Scene scene(2);
  for (Vector<3> p :
       {Vector<3>{-1, 0}, {0, 0}, {std::cos(down), -std::sin(down)}})
    scene.node(p);
  scene.facet({1, 0});
  scene.facet({2, 1});
  return scene;
}

/// @brief The three faces of a box that meet at its corner (0, 0, 0), with
/// the box in the octant of negative coordinates.
inline Scene corner(bool split)
{
  Scene scene(3);
  for (Vector<3> p : {Vector<3>{0, 0, 0},
                      {-1, 0, 0},
                      {0, -1, 0},
                      {-1, -1, 0},
                      {0, 0, -1},
                      {-1, 0, -1},
                      {0, -1, -1}})
    scene.node(p);
  scene.patch({3, 2, 1, 0}, split); // z = 0
  scene.patch({5, 1, 4, 0}, split); // y = 0
  scene.patch({6, 4, 2, 0}, split); // x = 0
  return scene;
}
} // namespace contactx::tests
