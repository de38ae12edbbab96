// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "snapshot.h"
#include "../contact/contact_state.h"

using namespace contactx;
using namespace contactx::problem;

Snapshot::Snapshot(std::shared_ptr<solve::System> system,
                   std::vector<std::shared_ptr<results::Results>> results)
    : _system(std::move(system)), _results(std::move(results))
{
  std::erase(_results, nullptr);
  for (const auto& result : _results)
    _copies.push_back(*result);
  solve::Bulk& bulk = *_system->bulk();
  const auto u = bulk.displacements();
  _displacements.assign(u.begin(), u.end());
  const auto start = _system->halo()->start();
  _start.assign(start->u.begin(), start->u.begin() + std::ptrdiff_t(u.size()));
  _last = _system->halo()->before();
  if (solve::Fields* fields = bulk.fields())
  {
    const auto values = fields->values();
    _fields.assign(values.begin(), values.end());
  }
  for (const auto& contact : _system->contacts())
    _contacts.push_back(contact::save(*contact));
}

void Snapshot::restore() const
{
  solve::Bulk& bulk = *_system->bulk();
  bulk.set_displacements(_displacements);
  if (solve::Fields* fields = bulk.fields())
    fields->set(_fields);
  _system->halo()->set_start(_start);
  _system->halo()->set_before(_last);
  for (std::size_t k = 0; k < _contacts.size(); ++k)
    contact::load(*_system->contacts()[k], _contacts[k]);
  for (std::size_t k = 0; k < _copies.size(); ++k)
    *_results[k] = _copies[k];
}
