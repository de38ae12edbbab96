// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "two_sheets.h"
#include <contactx/contact/contact.h>
#include <contactx/contact/obstacle_pairs.h>

namespace contactx::tests
{
/// @brief A bulk on one rank whose displacement a test changes.
class MovedBulk final : public parallel::HaloAdapter
{
public:
  /// @brief Look at the displacement of all nodes (shape=(num_nodes, gdim)).
  explicit MovedBulk(std::shared_ptr<const std::vector<double>> displacement)
      : _displacement(std::move(displacement))
  {
  }

  parallel::Ranks& ranks() override { return _ranks; }
  void set_ghosts(std::span<const std::int64_t>,
                  std::span<const std::int32_t>) override
  {
  }
  void forward(std::span<double>, int) override {}
  void forward(std::span<std::int64_t>, int) override {}
  void reverse(std::span<double>, int) override {}
  void displacement(std::span<double> values) const override
  {
    std::ranges::copy(*_displacement, values.begin());
  }

private:
  parallel::OneRank _ranks;
  std::shared_ptr<const std::vector<double>> _displacement;
};

/// @brief A contact whose nodes a test moves.
struct MovedContact
{
  int gdim;
  std::shared_ptr<std::vector<double>> displacement;
  std::shared_ptr<parallel::Halo> halo;
  std::shared_ptr<contact::Contact> contact;

  /// @brief A slave sheet over a master sheet.
  MovedContact(const TwoSheets& sheets, double reach, contact::Sliding sliding,
               std::shared_ptr<law::Law> law
               = std::make_shared<law::Frictionless>())
      : MovedContact(sheets.x, sheets.gdim)
  {
    auto surface = search::make_master_surface(halo, sheets.master.offsets,
                                               sheets.master.nodes);
    auto outside = std::make_shared<search::Outside>(
        halo, sheets.master.offsets, sheets.master.nodes);
    auto master = std::make_shared<contact::NodeToSurface>(
        halo, sheets.slave, surface, outside,
        contact::PairingOptions{reach, sliding == contact::Sliding::small,
                                false});
    make(sheets.slave.list(), master, std::move(law), sliding);
  }

  /// @brief A slave sheet and an obstacle.
  MovedContact(const Scene& slave, std::shared_ptr<obstacle::Obstacle> obstacle,
               contact::Sliding sliding = contact::Sliding::finite)
      : MovedContact(slave.x, slave.gdim)
  {
    const auto facets = slave.facets();
    const contact::SlaveNodes slaves(halo, facets, facets);
    auto master = std::make_shared<contact::ObstacleMaster>(
        std::move(obstacle), halo, facets, slaves.owned(), slave.x, gdim, 1.0,
        false);
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
    const auto n = static_cast<std::int32_t>(x.size()) / dim;
    parallel::BulkNodes bulk{dim, n, {}, {}, {}, std::move(x)};
    for (std::int32_t i = 0; i < n; ++i)
      bulk.numbers.push_back(i);
    bulk.owners.assign(n, 0);
    bulk.original = bulk.numbers;
    halo = std::make_shared<parallel::Halo>(
        std::move(bulk), std::make_unique<MovedBulk>(displacement));
  }

  void make(const facet::FacetList& facets,
            std::shared_ptr<contact::Master> master,
            std::shared_ptr<law::Law> law, contact::Sliding sliding)
  {
    contact::Contact::Options options{sliding, false, {}, {}};
    options.prescribed.assign(displacement->size(), 0);
    contact = std::make_shared<contact::Contact>(
        halo, std::make_shared<const contact::SlaveNodes>(halo, facets, facets),
        std::move(master), std::move(law), std::move(options));
  }
};
} // namespace contactx::tests
