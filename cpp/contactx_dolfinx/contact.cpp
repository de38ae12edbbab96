// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact.h"
#include "cells.h"
#include "contact_forms.h"
#include "halo.h"
#include <algorithm>
#include <contactx/mesh/mesh.h>
#include <contactx/problem/make_contact.h>
#include <stdexcept>

namespace contactx_dolfinx
{
namespace
{
contactx::problem::ContactOptions core_options(const Options& options)
{
  return {.method = options.method,
          .sliding = options.sliding,
          .tied = options.tied,
          .has_friction = options.friction or options.friction_law,
          .bound = options.friction_law,
          .search_distance = options.search_distance,
          .excluded_distance = options.excluded_distance,
          .adjust = options.adjust,
          .smooth = options.smooth,
          .tangential_factor = options.tangential_factor};
}

std::vector<double> weights(const Options& options,
                            const contactx::mesh::Halo& halo,
                            std::span<const std::int32_t> nodes)
{
  std::vector<double> values;
  for (const std::int32_t node : nodes)
  {
    contactx::Vector<3> x{};
    std::copy_n(halo.reference().begin() + halo.gdim() * node, halo.gdim(),
                x.begin());
    values.push_back(options.weight(x));
  }
  return values;
}
} // namespace

Contact::Contact(Surface slave, Master master, Options options)
    : _slave(std::move(slave)), _master(std::move(master)), _options(options),
      _values(std::make_shared<Values>(options.friction, options.offset))
{
  if (_options.friction and _options.friction_law)
    throw std::invalid_argument("a Contact has friction or a friction_law: "
                                "leave one of them out");
  const auto* obstacle
      = std::get_if<std::shared_ptr<contactx::geometry::Obstacle>>(&_master);
  if (obstacle and *obstacle == nullptr)
    throw std::invalid_argument("the obstacle of a Contact is null: give a "
                                "Plane, Sphere, Cylinder or LevelSet");
  contactx::problem::check(core_options(_options), is_self());
}

std::shared_ptr<contactx::contact::Contact>
Contact::attach(const contactx::mesh::Mesh& mesh,
                std::shared_ptr<const HaloAdapter> adapter,
                std::vector<std::int8_t> prescribed,
                const std::shared_ptr<const FunctionSpace>& V)
{
  if (_discrete)
    throw std::logic_error(
        "the contact belongs to an Assembler already: create one Contact an "
        "Assembler");
  try
  {
    make(mesh, std::move(prescribed), V);
    _V = V;
    _adapter = std::move(adapter);
    return _discrete;
  }
  catch (...)
  {
    detach();
    throw;
  }
}

void Contact::detach()
{
  _discrete.reset();
  _results.reset();
  _functions.reset();
  _forms.reset();
  _adapter.reset();
}

void Contact::set_friction(Value friction)
{
  if (not _options.friction)
    throw std::invalid_argument(
        "the contact has no friction: create it with one, zero will do");
  _values->set_friction(std::move(friction));
}
contactx::contact::Contact& Contact::discrete() const
{
  if (not _discrete)
    throw std::logic_error(
        "a contact has no results before it belongs to an Assembler: pass it "
        "to one first");
  return *_discrete;
}

const std::shared_ptr<contactx::contact::Contact>&
Contact::shared_discrete() const
{
  discrete();
  return _discrete;
}

const FunctionSpace& Contact::space() const
{
  discrete();
  return *_V;
}
bool Contact::is_self() const
{
  const auto* master = std::get_if<Surface>(&_master);
  return master and master->is(_slave);
}

const contactx::results::Results& Contact::results() const
{
  discrete();
  return *_results;
}

contactx::Vector<3> Contact::moment(const contactx::Vector<3>& point) const
{
  return results().moment(
      std::span<const double>(point).first(results().gdim()));
}

const Functions& Contact::functions()
{
  discrete();
  if (not _functions)
  {
    _functions = std::make_unique<Functions>(_V, slave_nodes(),
                                             discrete().law()->is_tied());
    _functions->take(*_results);
  }
  return *_functions;
}

const ContactForms& Contact::forms()
{
  discrete();
  if (not _forms)
    _forms = std::make_shared<ContactForms>(_discrete, _adapter,
                                            _V->mesh()->comm());
  _forms->update();
  return *_forms;
}

void Contact::show()
{
  if (_functions)
    _functions->take(*_results);
}

void Contact::make(const contactx::mesh::Mesh& mesh,
                   std::vector<std::int8_t> prescribed,
                   const std::shared_ptr<const FunctionSpace>& V)
{
  const auto& halo = mesh.halo;
  const contactx::geometry::Facets slave
      = _slave.facet_nodes(*V, halo->ranks(), "slave");
  contactx::geometry::Facets facets;
  contactx::problem::Sides sides{
      .slave = {_slave.name(), slave.list()},
      .master = std::shared_ptr<contactx::geometry::Obstacle>(),
      .is_self = is_self(),
      .level = contactx::mesh::node_levels(cells_of(*V), num_nodes(*V))};
  if (const auto* surface = std::get_if<Surface>(&_master))
  {
    facets = surface->facet_nodes(*V, halo->ranks(), "master");
    sides.master = contactx::mesh::NamedSurface{surface->name(), facets.list()};
  }
  else
    sides.master
        = std::get<std::shared_ptr<contactx::geometry::Obstacle>>(_master);
  if (_options.weight)
    sides.weight = [&](std::span<const std::int32_t> nodes)
    { return weights(_options, *halo, nodes); };
  _name = _options.name.empty()
              ? contactx::problem::name_of(sides, _options.sliding)
              : _options.name;
  _discrete = contactx::problem::make_contact(
      mesh, sides, core_options(_options), std::move(prescribed));
  _results = std::make_shared<contactx::results::Results>(_discrete);
  halo->ranks().agree([&] { _values->attach(V, slave_nodes()); });
}
} // namespace contactx_dolfinx
