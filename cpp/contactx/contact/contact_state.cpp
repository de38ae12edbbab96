// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_state.h"
#include <algorithm>
#include <array>
#include <string_view>

using namespace contactx;
using namespace contactx::contact;

namespace
{
constexpr std::string_view of_master = "master_";
constexpr std::array of_history{"history_slip", "history_total",
                                "history_dissipation"};

/// Calls a function with the name, the width and the values of each array of
/// the slave nodes that outlives a step.
template <class Nodes, class Use>
void for_each_lasting(Nodes& nodes, Use use)
{
  use("multiplier", nodes.size(), nodes.multiplier);
  use("multiplier before", nodes.size(), nodes.before);
  use("status", 0, nodes.status);
  use("gap", 0, nodes.gap);
  use("immobile", 0, nodes.immobile);
  if (not nodes.is_vector())
    return;
  use("normal", nodes.gdim(), nodes.normal);
  use("slip", nodes.gdim(), nodes.slip);
  use("mobile", nodes.gdim(), nodes.mobile);
}
} // namespace

std::vector<Saved> contactx::contact::save(const Contact& contact)
{
  std::vector<Saved> saved{{"active", RowKind::global, 0,
                            std::vector<std::int8_t>{contact.is_active()}}};
  const law::NodeState& nodes = *contact.nodes();
  for_each_lasting(nodes, [&](const char* name, int width, const auto& values)
                   { saved.push_back({name, RowKind::slave, width, values}); });
  if (const auto& history = contact.history())
  {
    saved.push_back(
        {of_history[0], RowKind::slave, nodes.gdim(), history->slip()});
    saved.push_back({of_history[1], RowKind::slave, 0, history->total()});
    saved.push_back({of_history[2], RowKind::slave, 0, history->dissipation()});
  }
  for (Saved& s : contact.master()->save())
  {
    s.name.insert(0, of_master);
    saved.push_back(std::move(s));
  }
  return saved;
}

void contactx::contact::load(Contact& contact, const std::vector<Saved>& saved)
{
  law::NodeState& nodes = *contact.nodes();
  const auto& history = contact.history();
  contact.halo().ranks().agree(
      [&]
      {
        check::rows(values_of<std::int8_t>(saved, "active").size(), 1, 1,
                    "active");
        for_each_lasting(nodes,
                         [&](const char* name, int, const auto& values)
                         {
                           using T = std::decay_t<decltype(values[0])>;
                           check::rows(values_of<T>(saved, name).size(),
                                       values.size(), 1, name);
                         });
        if (history)
          for (const char* name : of_history)
            values_of<double>(saved, name);
      });
  std::vector<Saved> master;
  for (const Saved& s : saved)
    if (s.name.starts_with(of_master))
      master.push_back(
          {s.name.substr(of_master.size()), s.rows, s.width, s.values});
  contact.master()->load(master);
  contact.set_active(values_of<std::int8_t>(saved, "active")[0] != 0);
  // Views of the arrays stay valid
  for_each_lasting(nodes,
                   [&](const char* name, int, auto& values)
                   {
                     using T = std::decay_t<decltype(values[0])>;
                     std::ranges::copy(values_of<T>(saved, name),
                                       values.begin());
                   });
  if (history)
    history->restore(values_of<double>(saved, of_history[0]),
                     values_of<double>(saved, of_history[1]),
                     values_of<double>(saved, of_history[2]));
  contact.rebuild();
}
