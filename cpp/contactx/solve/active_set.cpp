// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "active_set.h"
#include "../geometry/sizes.h"
#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// Number of nodes that change status or facet, over that of closed ones, above
/// which the kinematics are frozen
constexpr double freeze_fraction = 0.2;

std::vector<std::span<const std::int32_t>>
slaves_of(const std::vector<std::shared_ptr<contact::Contact>>& contacts)
{
  std::vector<std::span<const std::int32_t>> slaves;
  for (const auto& c : contacts)
    slaves.push_back(c->slaves().owned());
  return slaves;
}

class Held final : public FreeBodyContact
{
public:
  explicit Held(std::shared_ptr<contact::Contact> contact)
      : _contact(std::move(contact)),
        _coulomb(std::dynamic_pointer_cast<law::Coulomb>(_contact->law()))
  {
  }

  bool is_small() const override
  {
    return _contact->sliding() == contact::Sliding::small;
  }
  bool has_friction() const override { return _coulomb != nullptr; }
  double friction_max() const override
  {
    return _contact->law()->is_tied() ? std::numeric_limits<double>::infinity()
           : _coulomb                 ? _coulomb->friction_max()
                                      : 0;
  }
  Pairing pairing() const override
  {
    const contact::Master& master = *_contact->master();
    return {master.paired(), master.normals(), master.weights()};
  }
  std::vector<std::int8_t> status() const override { return nodes().status; }
  std::vector<double> closable_gap() const override
  {
    std::vector<double> gap(nodes().gap.size());
    for (std::size_t i = 0; i < gap.size(); ++i)
      gap[i] = nodes().closable_gap(i);
    return gap;
  }
  std::vector<double> facet_size() const override
  {
    const contact::SlaveNodes& slaves = _contact->slaves();
    const int g = nodes().gdim();
    const std::vector<double> x
        = slaves.here(_contact->halo().reference(), g, "reference");
    const geometry::FacetList facets = slaves.local();
    const std::vector<double> size = geometry::facet_sizes(facets, x, g);
    std::vector<double> largest(slaves.owned().size());
    for (std::size_t f = 0; f < size.size(); ++f)
      for (std::int32_t k = facets.offsets[f]; k < facets.offsets[f + 1]; ++k)
        if (const std::size_t i = facets.nodes[k]; i < largest.size())
          largest[i] = std::max(largest[i], size[f]);
    return largest;
  }
  FrictionState friction_state() override
  {
    _coulomb->evaluate(nodes());
    return {nodes().normal, nodes().multiplier,
            nodes().slip,   nodes().value,
            nodes().area,   _coulomb->has_friction(nodes())};
  }
  void close(std::span<const std::int32_t> which) override
  {
    nodes().close(which);
  }
  void set_tractions(std::span<const std::int32_t> which,
                     std::span<const double> tractions) override
  {
    const int size = nodes().size();
    for (std::size_t k = 0; k < which.size(); ++k)
      std::copy_n(tractions.begin() + std::size_t(size) * k, size,
                  nodes().multiplier.begin() + std::size_t(size) * which[k]);
  }

private:
  law::NodeState& nodes() const { return *_contact->nodes(); }

  std::shared_ptr<contact::Contact> _contact;
  std::shared_ptr<law::Coulomb> _coulomb;
};
} // namespace

std::shared_ptr<FreeBodyContact>
contactx::solve::free_body_contact(std::shared_ptr<contact::Contact> contact)
{
  return std::make_shared<Held>(std::move(contact));
}

ActiveSet::ActiveSet(std::shared_ptr<mesh::Halo> halo,
                     std::vector<std::shared_ptr<contact::Contact>> contacts,
                     std::shared_ptr<FreeBodies> bodies)
    : _halo(std::move(halo)), _contacts(std::move(contacts)),
      _bodies(std::move(bodies)), _junctions(slaves_of(_contacts)),
      _has_junctions(
          mesh::anywhere(_halo->ranks(), not _junctions.shared().empty()))
{
}

void ActiveSet::begin_step()
{
  _is_frozen = _is_stale = false;
  _changes = {};
  _paired = 0;
  _hidden = {};
  _halo->shrink();
  for (const auto& c : _contacts)
    c->begin_step();
  _guard.begin_step();
}

Changes ActiveSet::update(const Forces& forces, bool is_first)
{
  return update(forces, is_first, true);
}

Changes ActiveSet::update(const Forces& forces, bool is_first, bool may_freeze)
{
  Changes changes = update(is_first);
  _is_stale = _is_frozen and may_freeze and are_many(changes.status);
  if (_is_frozen and not _is_stale)
  {
    freeze(false);
    const Changes more = update(false);
    changes = {changes.status + more.status, more.pairs,
               changes.contact + more.contact};
  }
  freeze(may_freeze and are_many(changes.status + changes.pairs));
  if (are_many(changes.status))
  {
    // While the active set is far from that of the solution, neither pairs that
    // alternate nor the residual of pairs frozen for it mean anything
    const bool has_frozen = std::ranges::any_of(
        _contacts,
        [](const auto& c) { return not c->master()->frozen_pairs().empty(); });
    if (mesh::anywhere(_halo->ranks(), has_frozen) and may_freeze)
      _is_stale = true;
    reset_flips();
  }
  for (const auto& c : _contacts)
    c->nodes()->drop_open();
  if (_bodies and _bodies->stabilise(forces))
    freeze(true);
  _changes = changes;
  return changes;
}

Changes ActiveSet::update(bool is_first)
{
  Changes changes;
  if (is_first)
    changes.pairs = _paired;
  for (const auto& c : _contacts)
    changes.pairs += c->search();
  for (const auto& c : _contacts)
    c->update_gap();
  share(is_first);
  for (const auto& c : _contacts)
  {
    const law::NodeState& nodes = *c->nodes();
    const std::vector<std::int8_t> before = nodes.status;
    changes.status += c->update_status(is_first);
    for (std::size_t i = 0; i < before.size(); ++i)
      changes.contact += nodes.closed(i) != (before[i] != law::open);
  }
  std::array sums{changes.status, changes.pairs, changes.contact};
  _halo->ranks().reduce(std::span<std::int64_t>(sums), mesh::Reduction::sum);
  return {sums[0], sums[1], sums[2]};
}

void ActiveSet::pair()
{
  freeze(false);
  _is_stale = false;
  _changes = {};
  for (const auto& c : _contacts)
    _changes.pairs += c->search();
  _paired += _changes.pairs;
  _changes.pairs = mesh::total(_halo->ranks(), _changes.pairs);
  for (const auto& c : _contacts)
    c->update_gap();
  if (_bodies)
    _bodies->release();
}

void ActiveSet::foresee()
{
  for (const auto& c : _contacts)
    c->search();
  for (const auto& c : _contacts)
  {
    c->update_gap();
    c->foresee();
  }
  // What it has changed was no return
  reset_flips();
}

/// Decides which contacts of shared nodes may close, and where friction counts.
void ActiveSet::share(bool is_first)
{
  if (not _has_junctions)
    return;
  std::vector<std::vector<std::int8_t>> closes;
  std::vector<std::vector<double>> normals;
  for (const auto& c : _contacts)
  {
    // Nodes that were ceded before may close again
    std::ranges::fill(c->nodes()->redundant, 0);
    if (not c->law()->is_tied())
      closes.push_back(c->closing(is_first));
    else if (c->is_active())
      closes.push_back(c->master()->paired());
    else
      closes.emplace_back(c->nodes()->num_nodes(), 0);
    normals.push_back(c->master()->normals());
  }
  std::vector<Closing> closing;
  for (std::size_t k = 0; k < _contacts.size(); ++k)
    closing.push_back({_contacts[k]->law()->is_tied(), closes[k],
                       _contacts[k]->nodes()->gap, normals[k]});
  const std::vector<Shared> shared = _junctions.update(closing);
  for (std::size_t k = 0; k < _contacts.size(); ++k)
  {
    // Views of the arrays stay valid
    std::ranges::copy(shared[k].redundant,
                      _contacts[k]->nodes()->redundant.begin());
    std::ranges::copy(shared[k].frictionless,
                      _contacts[k]->nodes()->frictionless.begin());
  }
}

bool ActiveSet::are_many(std::int64_t changes) const
{
  return static_cast<double>(changes)
         > std::max(1.0, freeze_fraction * static_cast<double>(num_closed()));
}

std::int64_t ActiveSet::num_closed() const
{
  std::int64_t closed = 0;
  for (const auto& c : _contacts)
    closed += std::ranges::count_if(c->nodes()->status, [](std::int8_t s)
                                    { return s != law::open; });
  return mesh::total(_halo->ranks(), closed);
}

std::int64_t ActiveSet::num_slipping() const
{
  std::int64_t slipping = 0;
  for (const auto& c : _contacts)
    if (c->history())
      slipping += std::ranges::count(c->nodes()->status, law::slip);
  return mesh::total(_halo->ranks(), slipping);
}

std::int64_t ActiveSet::num_corners() const
{
  return mesh::total(_halo->ranks(), std::int64_t(_junctions.corners()));
}

bool ActiveSet::is_linear() const
{
  return _is_frozen
         or std::ranges::none_of(_contacts, [](const auto& c)
                                 { return c->updates_kinematics(); });
}

void ActiveSet::freeze(bool is_frozen)
{
  _is_frozen = is_frozen
               and std::ranges::any_of(_contacts, [](const auto& c)
                                       { return c->updates_kinematics(); });
  for (const auto& c : _contacts)
    c->freeze(is_frozen);
}

void ActiveSet::reset_flips()
{
  for (const auto& c : _contacts)
    c->master()->reset_flips();
}

void ActiveSet::note(double residual)
{
  std::vector<std::span<const std::int8_t>> status;
  for (const auto& c : _contacts)
    status.push_back(c->nodes()->status);
  if (_guard.note(fingerprint(_halo->ranks(), status), residual))
    for (const auto& c : _contacts)
      c->law()->allow_any_friction();
}

bool ActiveSet::hide_penetration()
{
  const auto now = _halo->now();
  std::vector<contact::HiddenGap> found;
  for (const auto& c : _contacts)
    found.push_back(
        c->master()->deepest_frozen_pair(now->x, c->nodes()->status));
  _hidden = hidden_penetration(_halo->ranks(), found);
  return _hidden.is_deep;
}

ActiveSet::End ActiveSet::may_end(const Forces& forces)
{
  if (not _is_stale)
    return hide_penetration() ? End::frozen_pair_penetrates : End::solution;
  update(forces, false, false);
  return End::again;
}
