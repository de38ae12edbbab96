// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <contactx/condense/condensation.h>
#include <contactx/condense/contact_block.h>
#include <contactx/condense/dependent_constraints.h>
#include <contactx/contact/node_to_surface.h>
#include <contactx/contact/obstacle_tie.h>
#include <contactx/contact/surface_to_surface.h>
#include <contactx/geometry/plane.h>
#include <contactx/solve/active_set.h>

using namespace contactx;
using namespace contactx::fuzz;
using contact::Contact;

namespace
{
std::shared_ptr<law::Law> any_law(Input& in, std::size_t n)
{
  switch (in.below(3))
  {
  case 0:
    return std::make_shared<law::Frictionless>();
  case 1:
    return std::make_shared<law::Tied>();
  default:
    auto coulomb = std::make_shared<law::Coulomb>();
    coulomb->set_friction(std::vector<double>(n, std::abs(in.unscaled())));
    return coulomb;
  }
}

/// A contact of the scene with its master surface, or with a plane.
std::shared_ptr<Contact> any_contact(Input& in, const Scene& scene,
                                     std::shared_ptr<mesh::Halo> halo)
{
  const auto slave = scene.slave.facets(), master = scene.master.facets();
  const auto slaves = std::make_shared<contact::SlaveNodes>(halo, slave, slave);
  const auto law = any_law(in, slaves->owned().size());
  const auto sliding
      = in.flag() ? contact::Sliding::small : contact::Sliding::finite;
  const contact::PairingOptions options{
      in.flag() ? INFINITY : in.positive() + in.scale(),
      sliding == contact::Sliding::small, law->is_vector()};
  std::shared_ptr<contact::Master> pairs;
  bool has_means = false;
  if (in.below(4) == 0)
  {
    const auto up = in.unit<3>(), at = in.vector<3>();
    auto plane = std::make_shared<geometry::Plane>(
        std::vector<double>(at.begin(), at.begin() + scene.gdim),
        std::vector<double>{0, 1, 0});
    std::vector<double> normal(up.begin(), up.begin() + scene.gdim);
    normal[0] += 2;
    plane->place(std::vector<double>(at.begin(), at.begin() + scene.gdim),
                 normal);
    if (law->is_tied())
      pairs = std::make_shared<contact::ObstacleTie>(plane, slaves, scene.x,
                                                     scene.gdim, options.reach);
    else
      pairs = std::make_shared<contact::ObstacleMaster>(
          plane, slaves, scene.x, scene.gdim, options.reach, law->is_vector());
  }
  else
  {
    auto surface
        = search::make_master_surface(halo, master.offsets, master.nodes);
    auto outside = std::make_shared<search::InsideTest>(halo, master.offsets,
                                                        master.nodes);
    has_means = in.flag();
    if (has_means and law->is_tied())
      pairs = std::make_shared<contact::SurfaceTie>(halo, slaves, surface,
                                                    outside, options);
    else if (has_means)
      pairs = std::make_shared<contact::SurfaceToSurface>(halo, slaves, surface,
                                                          outside, options);
    else if (law->is_tied())
      pairs = std::make_shared<contact::NodeTie>(halo, slaves, surface, outside,
                                                 options);
    else
      pairs = std::make_shared<contact::NodeToSurface>(halo, slaves, surface,
                                                       outside, options);
  }
  std::vector<std::int8_t> prescribed(scene.x.size());
  for (auto& p : prescribed)
    p = in.below(4) == 0;
  return std::make_shared<Contact>(
      halo, slaves, pairs, law,
      Contact::Options{sliding,
                       has_means ? contact::Method::surface_to_surface
                                 : contact::Method::node_to_surface,
                       std::move(prescribed),
                       {}});
}

void check_state(const Contact& contact, const Scene& scene)
{
  const law::NodeState& nodes = *contact.nodes();
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
  {
    require(nodes.status[i] == law::open or nodes.status[i] == law::stick
                or nodes.status[i] == law::slip,
            "a status is one of three");
    require(not(nodes.status[i] != law::open and std::isnan(nodes.gap[i])
                and not contact.law()->is_tied()),
            "what is in contact has a gap");
  }
  for (const auto& pairs : contact.pairs())
  {
    for (const std::int32_t node : pairs->nodes)
      require(node >= 0 and node < scene.num_nodes(), "a pair's nodes exist");
    for (const std::int32_t node : pairs->slaves)
      require(node >= 0 and node < std::ssize(contact.slaves().around()),
              "so do its slave nodes");
  }
}

/// The multipliers eliminated and found again.
void eliminate(const std::vector<std::shared_ptr<Contact>>& contacts,
               const mesh::Halo& halo, Input& in)
{
  const condense::ContactBlock block(contacts, {});
  const std::size_t n = std::size_t(halo.num_nodes()) * halo.gdim();
  std::vector<condense::Nodes> nodes;
  for (const auto& c : contacts)
    nodes.push_back(condense::nodes_of(*c));
  std::vector<std::int8_t> free(n);
  for (auto& f : free)
    f = in.below(4) > 0;
  try
  {
    const std::vector<double> diagonal(free.size(), 1);
    const condense::Condensation c(block.entries(), nodes, free, halo.gdim(),
                                   diagonal);
    condense::dependent_constraints(c.elimination(), halo);
    const std::vector<double> d(block.size() - n, 0.5);
    auto right = c.right_hand_side(d);
    const std::vector<double> u(n, 0.25);
    c.recover(d, u, u, right.multipliers);
  }
  catch (const condense::NotCondensable&)
  {
  }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  Scene scene(in);
  // Displacements and coordinates are checked before
  if (not in.even())
    return 0;
  const auto u = std::make_shared<std::vector<double>>(scene.x.size(), 0.0);
  const auto halo = mesh::serial_halo(scene.x, scene.gdim, u);
  std::vector<std::shared_ptr<Contact>> contacts;
  for (int k = 1 + in.below(2); k > 0; --k)
    contacts.push_back(any_contact(in, scene, halo));
  solve::ActiveSet set(halo, contacts);
  const solve::Forces forces{[] { return std::vector<double>(); },
                             [] { return std::vector<double>(); },
                             [] { return 1.0; }};
  std::vector<std::vector<contact::Saved>> saved;
  for (int steps = 1 + in.below(3); steps > 0; --steps)
  {
    set.begin_step();
    for (const auto& c : contacts)
      c->set_factor(std::vector<double>(scene.num_nodes(), 1.0));
    set.settle(forces, true);
    for (int moves = in.below(4); moves > 0; --moves)
    {
      for (int k = in.below(6); k > 0; --k)
        (*u)[in.below(static_cast<int>(u->size()))] += 0.25 * in.number();
      for (const auto& c : contacts)
        for (double& m : c->nodes()->multiplier)
          m = in.below(3) == 0 ? in.unscaled() : m;
      set.settle(forces);
      set.note(1.0 + in.below(3));
      for (const auto& c : contacts)
      {
        c->update_gap();
        c->law()->evaluate(*c->nodes());
        check_state(*c, scene);
      }
      eliminate(contacts, *halo, in);
      if (in.flag())
        set.may_end(forces);
    }
    for (std::size_t k = 0; k < contacts.size(); ++k)
    {
      contacts[k]->accept();
      if (saved.size() <= k)
        saved.push_back(contacts[k]->master()->save());
      else if (in.flag())
      {
        contacts[k]->master()->load(saved[k]);
        contacts[k]->rebuild();
      }
      check_state(*contacts[k], scene);
    }
  }
  return 0;
}
