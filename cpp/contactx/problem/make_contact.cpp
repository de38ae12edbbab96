// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "make_contact.h"
#include "../check.h"
#include "../mesh/shared_nodes.h"
#include "../text.h"
#include "check_facing.h"
#include "sides.h"
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::problem;

namespace
{
using Obstacle = std::shared_ptr<geometry::Obstacle>;

/// Refuses a number.
void refuse(bool is_wrong, const char* name, double value, const char* advice)
{
  if (is_wrong)
    throw std::invalid_argument(std::string(name) + " is "
                                + number_text(value, 6) + advice);
}

/// What a surface on itself is not made for.
void check_self(const ContactOptions& options)
{
  check::require(
      options.method == contact::Method::node_to_surface,
      "method is \"surface-to-surface\", but slave and master are the same "
      "surface: in self-contact one side is chosen a node at a time, which "
      "integrals over facets cannot follow. Take \"node-to-surface\", or give "
      "each side a surface of its own");
  check::require(
      options.sliding == contact::Sliding::finite,
      "sliding is \"small\", but slave and master are the same surface: what "
      "meets is found as it folds. Take \"finite\", or give each side a "
      "surface "
      "of its own");
  check::require(not options.tied,
                 "tied is for two surfaces, but slave and master are the same: "
                 "give each side a surface of its own");
}

std::shared_ptr<law::Law> law_of(const ContactOptions& options)
{
  if (options.tied)
    return std::make_shared<law::Tied>();
  if (options.bound)
    return std::make_shared<law::Coulomb>(options.bound);
  if (options.has_friction)
    return std::make_shared<law::Coulomb>();
  return std::make_shared<law::Frictionless>();
}
} // namespace

void contactx::problem::check(const ContactOptions& options, bool is_self)
{
  const auto is_length
      = [](double value) { return std::isfinite(value) and value >= 0; };
  check::require(not options.tied or not options.has_friction,
                 "tied excludes friction: a tied slave node does not slip. "
                 "Leave friction out, or tied");
  if (const auto& distance = options.search_distance)
    refuse(not(*distance > 0), "search_distance", *distance,
           ": give a positive length");
  if (is_self)
    check_self(options);
  if (const auto& length = options.adjust)
  {
    refuse(not is_length(*length), "adjust", *length,
           ": give a finite length of at least 0");
    refuse(options.tied, "adjust", *length,
           ", but a tie keeps the gaps of the reference configuration as they "
           "are: leave it out");
    refuse(is_self, "adjust", *length,
           ", but in self-contact the master of a node is another one as the "
           "surface folds: leave it out");
  }
  if (const auto& distance = options.excluded_distance)
  {
    refuse(not is_length(*distance), "excluded_distance", *distance,
           ": give a finite length of at least 0");
    refuse(not is_self, "excluded_distance", *distance,
           ", but slave and master are not the same surface: leave it out");
  }
  const double factor = options.tangential_factor;
  refuse(not(std::isfinite(factor) and factor > 0), "tangential_factor", factor,
         ": give a positive number, such as 0.05");
}

std::string contactx::problem::name_of(const Sides& sides,
                                       contact::Sliding sliding)
{
  if (sides.is_self)
    return "Contact of " + sides.slave.name + " with itself";
  const auto* obstacle = std::get_if<Obstacle>(&sides.master);
  return "Contact(slave=" + sides.slave.name + ", master="
         + (obstacle ? (*obstacle)->name()
                     : std::get<mesh::NamedSurface>(sides.master).name)
         + ", sliding='"
         + (sliding == contact::Sliding::small ? "small" : "finite") + "')";
}

std::shared_ptr<contact::Contact>
contactx::problem::make_contact(const mesh::Mesh& mesh, const Sides& sides,
                                const ContactOptions& options,
                                std::vector<std::int8_t> prescribed)
{
  check::require(mesh.halo != nullptr, "mesh must have a halo");
  const std::shared_ptr<mesh::Halo>& halo = mesh.halo;
  halo->ranks().agree([&] { problem::check(options, sides.is_self); });
  const auto* obstacle = std::get_if<Obstacle>(&sides.master);
  const auto slaves
      = problem::make_slave_nodes(halo, sides.slave.facets, sides.level,
                                  options.method, obstacle != nullptr);
  if (sides.weight)
    halo->ranks().agree([&]
                        { slaves->set_weight(sides.weight(slaves->owned())); });
  const std::shared_ptr<law::Law> law = law_of(options);
  const MasterOptions how{.method = options.method,
                          .sliding = options.sliding,
                          .search_distance = options.search_distance,
                          .level = sides.level,
                          .is_self = sides.is_self,
                          .excluded_distance = options.excluded_distance,
                          .is_smooth = options.smooth};
  contact::Contact::Options kinematics{.sliding = options.sliding,
                                       .method = options.method,
                                       .prescribed = std::move(prescribed),
                                       .shared = {},
                                       .adjust = options.adjust};
  std::shared_ptr<contact::Contact> contact;
  const auto make = [&](std::shared_ptr<contact::Master> master)
  {
    contact = std::make_shared<contact::Contact>(
        halo, slaves, std::move(master), law, std::move(kinematics));
  };
  if (obstacle)
    make(problem::make_master(mesh, slaves, sides.slave.name, *obstacle, *law,
                              how));
  else
  {
    const auto& surface = std::get<mesh::NamedSurface>(sides.master);
    const auto master = problem::make_master(mesh, slaves, sides.slave.name,
                                             surface, *law, how);
    // Nodes that a surface shares with itself have gaps all the same
    if (not sides.is_self)
    {
      kinematics.shared
          = mesh::shared_nodes(*halo, slaves->own(), surface.facets);
      kinematics.shared.resize(halo->num_owned());
    }
    make(master);
    if (not sides.is_self)
      problem::check_facing(*halo, *slaves, sides.slave.name, *master,
                            surface.name);
  }
  contact->nodes()->tangential_ratio = options.tangential_factor;
  return contact;
}
