// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "check_facing.h"
#include "../text.h"
#include <algorithm>
#include <cmath>

using namespace contactx;

void contactx::problem::check_facing(const mesh::Halo& halo,
                                     const contact::SlaveNodes& slaves,
                                     const std::string& slave_name,
                                     const contact::DeformableMaster& master,
                                     const std::string& master_name)
{
  mesh::Ranks& ranks = halo.ranks();
  if (mesh::anywhere(ranks, std::ranges::count(master.paired(), 1) > 0))
    return;
  // The halo grows below
  const std::vector<double> x(halo.reference().begin(), halo.reference().end());
  const std::size_t gdim = halo.gdim();
  const double distance = mesh::least(ranks, master.distance(x));
  const std::vector<double> every
      = geometry::nodal_normals(slaves.facets(), x, halo.gdim());
  std::vector<double> points, normals;
  for (const std::int32_t node : slaves.owned())
    for (std::size_t k = 0; k < gdim; ++k)
    {
      points.push_back(x[node * gdim + k]);
      normals.push_back(every[node * gdim + k]);
    }
  // The facet that faces a node may lie beside it
  const search::Found found
      = master.surface()->find(x, points, normals, master.reach());
  const bool faces = mesh::anywhere(
      ranks, std::ranges::any_of(found.distance,
                                 [](double d) { return std::isfinite(d); }));
  if (distance <= master.reach() and not faces)
    throw std::invalid_argument(
        "the slave surface " + slave_name + " faces away from its master "
        + master_name
        + ": no slave node has a normal that opposes that of a master facet "
          "within the search distance "
        + number_text(master.reach(), 3) + ", although the nearest is "
        + number_text(distance, 3)
        + " away. Check the tags: the surfaces must face each other (manual: "
          "errors/refused-mesh)");
}
