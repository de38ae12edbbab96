// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "thread_ranks.h"
#include "two_sheets.h"
#include <contactx/condense/contact_block.h>
#include <contactx/contact/contact.h>
#include <contactx/geometry/facets.h>
#include <contactx/mesh/halo.h>

namespace contactx::tests
{
/// @brief A bulk of which each rank has all nodes.
class WholeBulk final : public NumberedBulk
{
public:
  WholeBulk(mesh::Ranks& ranks, const std::vector<std::int64_t>& numbers,
            std::int32_t num_owned,
            std::shared_ptr<const std::vector<double>> displacement)
      : NumberedBulk(ranks, numbers, num_owned),
        _displacement(std::move(displacement))
  {
  }

  void set_ghosts(std::span<const std::int64_t> numbers,
                  std::span<const std::int32_t>) override
  {
    if (not numbers.empty())
      throw std::logic_error("all nodes are here");
  }
  void displacement(std::span<double> values) const override
  {
    std::ranges::copy(*_displacement, values.begin());
  }

private:
  std::shared_ptr<const std::vector<double>> _displacement;
};

/// @brief A mesh of which each rank has all nodes, its own first.
struct WholeMesh
{
  /// @brief Take n nodes, on one rank alone if there are none.
  WholeMesh(std::int32_t n, mesh::Ranks* ranks)
      : ranks(ranks), number(numbered<std::int64_t>(n)), place(n), num_owned(n)
  {
    if (ranks)
      num_owned = static_cast<std::int32_t>(
          std::ranges::stable_partition(
              number,
              [&](std::int64_t node) { return owner(node) == ranks->rank(); })
              .begin()
          - number.begin());
    for (std::int32_t i = 0; i < n; ++i)
      place[number[i]] = i;
  }

  /// @brief Rank of a node: neighbours are on any.
  int owner(std::int64_t node) const
  {
    return ranks ? static_cast<int>(node * 7 % 11) % ranks->size() : 0;
  }

  bool owns(std::int32_t node) const { return place[node] < num_owned; }

  /// @brief Values of the nodes in the order of this rank.
  template <class T>
  std::vector<T> here(const std::vector<T>& values, int width) const
  {
    std::vector<T> result;
    for (const std::int64_t node : number)
      result.insert(result.end(), values.begin() + node * width,
                    values.begin() + (node + 1) * width);
    return result;
  }

  /// @brief Facets by the nodes of this rank: those around its nodes, or those
  /// whose first node it has.
  geometry::Facets here(const geometry::Facets& facets, bool around) const
  {
    geometry::Facets result;
    for (std::int32_t f = 0; f < facets.list().size(); ++f)
    {
      const auto nodes = facets.list()[f];
      if (std::ranges::any_of(nodes.first(around ? nodes.size() : 1),
                              [&](std::int32_t node) { return owns(node); }))
        add_facet(result, nodes,
                  [&](std::int32_t node) { return place[node]; });
    }
    return result;
  }

  /// @brief The nodes with their positions, and displacements in the order of
  /// this rank.
  std::shared_ptr<mesh::Halo>
  halo(const std::vector<double>& x, int gdim,
       std::shared_ptr<const std::vector<double>> u) const
  {
    if (not ranks)
      return mesh::serial_halo(x, gdim, std::move(u));
    mesh::BulkNodes bulk{gdim, num_owned, number, {}, number, here(x, gdim)};
    for (const std::int64_t node : number)
      bulk.owners.push_back(owner(node));
    return std::make_shared<mesh::Halo>(
        std::move(bulk),
        std::make_unique<WholeBulk>(*ranks, number, num_owned, std::move(u)));
  }

  mesh::Ranks* ranks;
  std::vector<std::int64_t> number; ///< in the mesh, of each node here
  std::vector<std::int32_t> place;  ///< here, of each node of the mesh
  std::int32_t num_owned;
};

/// @brief A law with the same coefficient of friction at n nodes.
inline std::shared_ptr<law::Coulomb> coulomb(std::size_t n, double friction)
{
  auto law = std::make_shared<law::Coulomb>();
  law->set_friction(std::vector<double>(n, friction));
  return law;
}

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

  explicit ContactScene(int dim, double height = 0.05,
                        Cells cells = Cells::mixed,
                        mesh::Ranks* ranks = nullptr)
      : ContactScene(TwoSheets(dim, height, cells), ranks)
  {
  }

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
  contact(std::shared_ptr<law::Law> law = std::make_shared<law::Frictionless>(),
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

  /// @brief Displace each node otherwise, by its number in the mesh.
  void make_uneven()
  {
    const int g = sheets.gdim;
    for (std::size_t i = 0; i < mesh.number.size(); ++i)
      for (int k = 0; k < g; ++k)
        (*u)[g * i + k] = 0.01 * std::sin(3. * double(mesh.number[i]) + k);
  }

  /// @brief Displace all slave nodes, along the first and the last axis.
  void put_slave(double aside, double up)
  {
    const int g = sheets.gdim;
    for (std::int32_t i = 0; i < sheets.num_slaves; ++i)
    {
      (*u)[g * mesh.place[i]] = aside;
      (*u)[g * mesh.place[i] + g - 1] = up;
    }
  }
};

/// @brief Residual of contacts: forces on all nodes, then the complementarity
/// function of each contact.
inline std::vector<double>
residual(const std::vector<std::shared_ptr<contact::Contact>>& contacts)
{
  const mesh::Halo& halo = contacts.front()->halo();
  const std::size_t n = std::size_t(halo.num_nodes()) * halo.gdim();
  std::vector<double> b(n, 0);
  for (const auto& c : contacts)
  {
    c->update_gap();
    c->law()->evaluate(*c->nodes());
    c->add_residual(std::span(b).first(n));
    b.insert(b.end(), c->nodes()->value.begin(), c->nodes()->value.end());
  }
  return b;
}
} // namespace contactx::tests
