// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "settle.h"
#include <algorithm>

using namespace contactx;
using namespace contactx::active_set;

namespace
{
// Share of the closed nodes above which changes of status or facet freeze the
// kinematics
constexpr double few = 0.2;

std::vector<std::span<const std::int32_t>>
slaves_of(const std::vector<std::shared_ptr<contact::Contact>>& contacts)
{
  std::vector<std::span<const std::int32_t>> slaves;
  for (const auto& c : contacts)
    slaves.push_back(c->slaves().owned());
  return slaves;
}
} // namespace

ActiveSet::ActiveSet(std::shared_ptr<parallel::Halo> halo,
                     std::vector<std::shared_ptr<contact::Contact>> contacts)
    : _halo(std::move(halo)), _contacts(std::move(contacts)),
      _junctions(slaves_of(_contacts)),
      _has_junctions(
          parallel::anywhere(_halo->ranks(), not _junctions.shared().empty()))
{
}

void ActiveSet::begin_step()
{
  _is_frozen = _is_stale = false;
  for (const auto& c : _contacts)
    c->begin_step();
}

Changes ActiveSet::settle(bool is_first, bool may_freeze)
{
  Changes changes = update(is_first);
  _is_stale = _is_frozen and may_freeze and are_many(changes.status);
  if (_is_frozen and not _is_stale)
  {
    freeze(false);
    const Changes more = update(false);
    changes = {changes.status + more.status, more.pairs};
  }
  freeze(may_freeze and are_many(changes.status + changes.pairs));
  if (are_many(changes.status))
  {
    // What flips on an active set that is far off says nothing of the solution,
    // and no more does the residual of the pairs that were frozen for it
    const bool has_frozen = std::ranges::any_of(
        _contacts,
        [](const auto& c) { return not c->master()->frozen_pairs().empty(); });
    if (parallel::anywhere(_halo->ranks(), has_frozen) and may_freeze)
      _is_stale = true;
    for (const auto& c : _contacts)
      c->master()->reset_flips();
  }
  for (const auto& c : _contacts)
    c->nodes()->drop_open();
  return changes;
}

Changes ActiveSet::update(bool is_first)
{
  Changes changes;
  for (const auto& c : _contacts)
    changes.pairs += c->search();
  for (const auto& c : _contacts)
    c->update_gap();
  share(is_first);
  for (const auto& c : _contacts)
    changes.status += c->update_status(is_first);
  std::array sums{changes.status, changes.pairs};
  if (_halo->ranks().size() > 1)
    _halo->ranks().reduce(std::span<std::int64_t>(sums),
                          parallel::Reduction::sum);
  return {sums[0], sums[1]};
}

/// Decides which contacts of shared nodes may close, and where friction counts.
void ActiveSet::share(bool is_first)
{
  if (not _has_junctions)
    return;
  std::vector<std::vector<std::int8_t>> closes;
  std::vector<std::vector<double>> normals;
  std::vector<Closing> closing;
  for (const auto& c : _contacts)
  {
    // What was ceded before may close again
    std::ranges::fill(c->nodes()->ceded, 0);
    if (c->law()->is_tied())
    {
      closes.push_back(c->master()->paired());
      if (not c->is_active)
        std::ranges::fill(closes.back(), 0);
    }
    else
      closes.push_back(c->closing(is_first));
    normals.push_back(c->master()->normals());
  }
  for (std::size_t k = 0; k < _contacts.size(); ++k)
    closing.push_back({_contacts[k]->law()->is_tied(), closes[k],
                       _contacts[k]->nodes()->gap, normals[k]});
  const std::vector<Shared> shared = _junctions.update(closing, is_first);
  for (std::size_t k = 0; k < _contacts.size(); ++k)
  {
    // Others look at the arrays
    std::ranges::copy(shared[k].ceded, _contacts[k]->nodes()->ceded.begin());
    std::ranges::copy(shared[k].smooth, _contacts[k]->nodes()->smooth.begin());
  }
}

bool ActiveSet::are_many(std::int64_t changes)
{
  return static_cast<double>(changes)
         > std::max(1.0, few * static_cast<double>(num_closed()));
}

std::int64_t ActiveSet::num_closed()
{
  std::int64_t closed = 0;
  for (const auto& c : _contacts)
    closed += std::ranges::count_if(c->nodes()->status, [](std::int8_t s)
                                    { return s != law::open; });
  return parallel::total(_halo->ranks(), closed);
}

void ActiveSet::freeze(bool is_frozen)
{
  _is_frozen = is_frozen
               and std::ranges::any_of(_contacts, [](const auto& c)
                                       { return c->updates_kinematics(); });
  for (const auto& c : _contacts)
    c->freeze(is_frozen);
}
