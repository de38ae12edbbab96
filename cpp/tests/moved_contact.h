// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "two_sheets.h"
#include <contactx/contact/contact.h>
#include <contactx/contact/obstacle_pairs.h>
#include <contactx/geometry/plane.h>

namespace contactx::tests
{
/// @brief A contact whose nodes a test moves.
struct MovedContact
{
  int gdim;
  std::shared_ptr<std::vector<double>> displacement;
  std::shared_ptr<mesh::Halo> halo;
  std::shared_ptr<contact::Contact> contact;

  MovedContact(const TwoSheets& sheets, double reach, contact::Sliding sliding,
               std::shared_ptr<law::Law> law
               = std::make_shared<law::Frictionless>())
      : MovedContact(sheets.x, sheets.gdim)
  {
    make(sheets.slave.list(),
         sheets.pairs_of<contact::NodeToSurface>(
             halo, {reach, sliding == contact::Sliding::small, false}),
         std::move(law), sliding);
  }

  MovedContact(const Scene& slave, std::shared_ptr<geometry::Obstacle> obstacle,
               contact::Sliding sliding = contact::Sliding::finite)
      : MovedContact(slave.x, slave.gdim)
  {
    const auto facets = slave.facets();
    auto master = std::make_shared<contact::ObstacleMaster>(
        std::move(obstacle),
        std::make_shared<contact::SlaveNodes>(halo, facets, facets), slave.x,
        gdim, 1.0, false);
    make(facets, master, std::make_shared<law::Frictionless>(), sliding);
  }

  /// @brief Move some nodes along the last axis, from where they were made.
  void move(std::int32_t begin, std::int32_t end, double by)
  {
    for (std::int32_t i = begin; i < end; ++i)
      (*displacement)[gdim * (i + 1) - 1] = by;
  }

private:
  MovedContact(std::vector<double> x, int dim)
      : gdim(dim),
        displacement(std::make_shared<std::vector<double>>(x.size(), 0.))
  {
    halo = mesh::serial_halo(std::move(x), dim, displacement);
  }

  void make(const geometry::FacetList& facets,
            std::shared_ptr<contact::Master> master,
            std::shared_ptr<law::Law> law, contact::Sliding sliding)
  {
    contact::Contact::Options options{
        sliding, contact::Method::node_to_surface, {}, {}};
    options.prescribed.assign(displacement->size(), 0);
    contact = std::make_shared<contact::Contact>(
        halo, std::make_shared<const contact::SlaveNodes>(halo, facets, facets),
        std::move(master), std::move(law), std::move(options));
  }
};

/// @brief A square of side 2 at a height of 0.1 above a plane.
inline MovedContact square_above_plane()
{
  const Scene slave(3, {{0, 0, 0.1}, {0, 2, 0.1}, {2, 0, 0.1}, {2, 2, 0.1}},
                    {{0, 1, 2, 3}});
  return MovedContact(
      slave, std::make_shared<geometry::Plane>(std::vector<double>{0, 0, 0},
                                               std::vector<double>{0, 0, 1}));
}
} // namespace contactx::tests
