// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "contact.h"
#include "halo.h"

namespace contactx::dolfinx
{
/// @brief Copy of a displacement, of all that the next step of its contacts
/// depends on, and of their results.
class Snapshot
{
public:
  /// @brief Copy the state.
  /// @param[in] u Displacement.
  /// @param[in] contacts Its contacts.
  Snapshot(const Function& u,
           const std::vector<std::shared_ptr<Contact>>& contacts)
      : _u(u.x()->array())
  {
    for (const auto& owner : contacts)
    {
      const contact::Contact* contact = &owner->discrete();
      const contact::NodeState& nodes = *contact->nodes();
      State state{
          owner,
          owner->results(),
          contact->is_active(),
          {nodes.multiplier, nodes.gap, nodes.normal, nodes.slip, nodes.mobile},
          {nodes.status, nodes.immobile},
          {},
          contact->master()->save()};
      if (const auto& history = contact->history())
        state.history
            = {history->slip(), history->total(), history->dissipation()};
      _states.push_back(std::move(state));
    }
  }

  /// @brief Return to the state, bit for bit; all ranks must take part.
  /// @param[in,out] u The displacement.
  /// @param[in,out] adapter Owner of the displacement.
  void restore(Function& u, HaloAdapter& adapter) const
  {
    std::ranges::copy(_u, u.x()->array().begin());
    adapter.update_ghosts();
    for (const State& state : _states)
    {
      contact::Contact& contact = state.contact->discrete();
      contact.master()->load(state.master);
      contact.set_active(state.is_active);
      contact::NodeState& nodes = *contact.nodes();
      std::array values{&nodes.multiplier, &nodes.gap, &nodes.normal,
                        &nodes.slip, &nodes.mobile};
      // Others look at the arrays
      for (std::size_t i = 0; i < values.size(); ++i)
        std::ranges::copy(state.values[i], values[i]->begin());
      std::ranges::copy(state.marks[0], nodes.status.begin());
      std::ranges::copy(state.marks[1], nodes.immobile.begin());
      if (const auto& history = contact.history())
        history->restore(state.history[0], state.history[1], state.history[2]);
      contact.rebuild();
      state.contact->restore(state.results);
    }
  }

private:
  struct State
  {
    std::shared_ptr<Contact> contact;
    results::Results results;
    bool is_active;
    std::array<std::vector<double>, 5> values;
    std::array<std::vector<std::int8_t>, 2> marks;
    std::array<std::vector<double>, 3> history;
    std::vector<contact::Saved> master;
  };

  std::vector<double> _u;
  std::vector<State> _states;
};
} // namespace contactx::dolfinx
