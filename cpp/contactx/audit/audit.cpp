// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "audit.h"
#include "../mesh/spread.h"
#include "obstacle_audit.h"
#include "self_audit.h"
#include "surfaces_audit.h"

using namespace contactx;
using namespace contactx::audit;

Audit::Audit(std::shared_ptr<mesh::Halo> halo,
             std::vector<std::shared_ptr<contact::Contact>> contacts)
    : _halo(std::move(halo)), _contacts(std::move(contacts))
{
  for (const auto& contact : _contacts)
  {
    std::unique_ptr<ContactAudit> look;
    const bool is_rigid = contact->master()->is_rigid();
    const bool is_small = contact->sliding() == contact::Sliding::small;
    if (contact->is_self())
      look = std::make_unique<SelfAudit>(_halo, contact);
    else if (not contact->law()->is_tied() and not is_rigid)
      look = std::make_unique<SurfacesAudit>(_halo, contact);
    else if (not contact->law()->is_tied() and not is_small)
      look = std::make_unique<ObstacleAudit>(_halo, contact);
    _audits.push_back(std::move(look));
  }
  accept();
}

void Audit::begin_step()
{
  if (mesh::anywhere(_halo->ranks(), _start != owned()))
    accept();
}

void Audit::accept()
{
  _start = owned();
  for (const auto& look : _audits)
    if (look)
      look->accept();
}

std::vector<Findings> Audit::find()
{
  const auto start = mesh::spread(*_halo, _start, _halo->gdim());
  std::vector<Findings> found(_audits.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    if (_audits[i] and _contacts[i]->is_active())
      found[i] = _audits[i]->find(start);
  return found;
}

std::vector<double> Audit::owned() const
{
  std::vector<double> x = _halo->now()->x;
  x.resize(std::size_t(_halo->num_owned()) * _halo->gdim());
  return x;
}
