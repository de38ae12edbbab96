// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "two_sheets.h"
#include "whole_mesh.h"
#include <contactx/condense/contact_block.h>
#include <contactx/contact/contact.h>
#include <random>

namespace contactx::tests
{
/// @brief Two sheets in contact, and the displacement of their nodes.
struct ContactScene
{
  TwoSheets sheets;
  WholeMesh mesh;
  std::shared_ptr<std::vector<double>> u;
  std::shared_ptr<mesh::Halo> halo;
  std::shared_ptr<contact::SlaveNodes> slaves;
  std::shared_ptr<search::MasterSurface> surface;
  std::shared_ptr<search::InsideTest> outside;

  /// 1 at displacements with a Dirichlet condition, in the order of this rank
  std::vector<std::int8_t> prescribed;

  /// @param[in] away Added to all coordinates.
  explicit ContactScene(int dim, double height = 0.05,
                        Cells cells = Cells::mixed,
                        mesh::Ranks* ranks = nullptr, double away = 0)
      : ContactScene(moved(TwoSheets(dim, height, cells), away), ranks)
  {
  }

  /// @brief Take any two surfaces.
  explicit ContactScene(TwoSheets surfaces, mesh::Ranks* ranks = nullptr)
      : sheets(std::move(surfaces)), mesh(sheets.num_nodes(), ranks),
        u(std::make_shared<std::vector<double>>(sheets.x.size(), 0.0)),
        prescribed(u->size(), 0)
  {
    halo = mesh.halo(sheets.x, sheets.gdim, u);
    const auto around = mesh.here(sheets.slave, true);
    const auto own = mesh.here(sheets.slave, false);
    slaves = std::make_shared<contact::SlaveNodes>(halo, around.list(),
                                                   own.list());
    const auto master = mesh.here(sheets.master, false);
    surface = search::make_master_surface(halo, master.offsets, master.nodes);
    outside = std::make_shared<search::InsideTest>(halo, master.offsets,
                                                   master.nodes);
  }

  /// @brief Pairs of a method, not searched for yet.
  template <class M>
  std::shared_ptr<M> master(const law::Law& law, contact::Sliding sliding) const
  {
    return std::make_shared<M>(
        halo, slaves, surface, outside,
        contact::PairingOptions{1.0, sliding == contact::Sliding::small,
                                law.is_vector()});
  }

  /// @brief A contact of these sheets.
  /// @param[in] shared 1 at nodes that both surfaces have; empty for none.
  template <class M>
  std::shared_ptr<contact::Contact>
  contact(std::shared_ptr<law::Law> law,
          contact::Sliding sliding = contact::Sliding::finite,
          std::vector<std::int8_t> shared = {},
          std::optional<double> adjust = std::nullopt) const
  {
    constexpr auto method = std::is_base_of_v<contact::SurfaceToSurface, M>
                                ? contact::Method::surface_to_surface
                                : contact::Method::node_to_surface;
    return std::make_shared<contact::Contact>(
        halo, slaves, master<M>(*law, sliding), law,
        contact::Contact::Options{sliding, method, prescribed,
                                  std::move(shared), adjust});
  }

  /// @brief Move all nodes by random numbers up to a size.
  void shake(std::mt19937& random, double size)
  {
    std::uniform_real_distribution<double> any(-size, size);
    for (double& v : *u)
      v = any(random);
  }

private:
  static TwoSheets moved(TwoSheets sheets, double away)
  {
    for (double& x : sheets.x)
      x += away;
    return sheets;
  }
};

/// @brief Residual of contacts: forces on all nodes, then the complementarity
/// function of each contact.
inline std::vector<double>
residual(const std::vector<std::shared_ptr<contact::Contact>>& contacts)
{
  const mesh::Halo& halo = contacts.front()->halo();
  std::vector<double> b(std::size_t(halo.num_nodes()) * halo.gdim(), 0);
  for (const auto& c : contacts)
  {
    c->update_gap();
    c->law()->evaluate(*c->nodes());
    c->add_residual(
        std::span(b).first(std::size_t(halo.num_nodes()) * halo.gdim()));
  }
  for (const auto& c : contacts)
    b.insert(b.end(), c->nodes()->value.begin(), c->nodes()->value.end());
  return b;
}
} // namespace contactx::tests
