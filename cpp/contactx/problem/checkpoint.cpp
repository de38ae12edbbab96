// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "checkpoint.h"
#include "../contact/contact_state.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

using namespace contactx;
using namespace contactx::problem;

namespace
{
constexpr std::string_view of_steps = "steps: ";

std::vector<std::int64_t> numbers_of(const storage::Digest& digest)
{
  return {digest.count, digest.high, digest.low};
}

/// Whether an array of a file may be of the problem that is here.
bool is_of_same_problem(mesh::Ranks& ranks, const std::string& name,
                        const storage::Values& here,
                        const storage::Values& there)
{
  if (name == "mesh: cells" or name.ends_with(": identity"))
    return here == there;
  if (name != "mesh: coordinates")
    return true;
  // Another machine may round them in another way
  const auto& x = std::get<std::vector<double>>(here);
  const auto& y = std::get<std::vector<double>>(there);
  std::array<double, 2> most{};
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    most[0] = std::max(most[0], std::abs(x[i]));
    most[1] = std::max(most[1], std::abs(x[i] - y[i]));
  }
  if (ranks.size() > 1)
    ranks.reduce(std::span<double>(most), mesh::Reduction::largest);
  return most[1] <= 1e-12 * most[0];
}

/// Number of values that are not finite although they must be.
std::int64_t not_finite(const std::string& name, const storage::Values& values)
{
  if (name != "u" and name != "start" and name != "before"
      and not name.ends_with(": multiplier"))
    return 0;
  return std::ranges::count_if(std::get<std::vector<double>>(values),
                               [](double v) { return not std::isfinite(v); });
}
} // namespace

Checkpoint::Checkpoint(mesh::Ranks& ranks, std::shared_ptr<mesh::Halo> halo,
                       std::vector<std::shared_ptr<contact::Contact>> contacts,
                       std::vector<Function> functions, Mesh mesh)
    : _ranks(&ranks), _halo(std::move(halo)), _contacts(std::move(contacts)),
      _functions(std::move(functions)), _positions(std::move(mesh.positions)),
      _cells(
          numbers_of(storage::digest(ranks, mesh.cells, mesh.points_per_cell)))
{
  for (Function& f : _functions)
  {
    _rows.emplace_back(ranks, f.keys, f.key_width);
    f.keys = {};
  }
  for (const auto& contact : _contacts)
  {
    std::vector<std::int64_t> keys;
    for (const std::int32_t node : contact->slaves().owned())
      keys.push_back(_halo->original()[node]);
    _slaves.emplace_back(ranks, keys, 1);
    std::vector<std::int64_t> identity{contact->sliding()
                                       == contact::Sliding::small};
    for (const contact::Saved& s : contact->master()->identity())
      std::ranges::copy(
          numbers_of(storage::digest(
              ranks, std::get<std::vector<std::int64_t>>(s.values), s.width)),
          std::back_inserter(identity));
    _identities.push_back(std::move(identity));
  }
}

template <class Use>
void Checkpoint::for_each(State& state, Use use) const
{
  const storage::Rows* const nodes = &_rows.front();
  const int gdim = _functions.front().width;
  auto positions = _positions;
  use("mesh: coordinates", nodes, gdim, positions);
  auto cells = _cells;
  use("mesh: cells", nullptr, 0, cells);
  for (std::size_t k = 0; k < _functions.size(); ++k)
    use(_functions[k].name, &_rows[k], _functions[k].width, state.functions[k]);
  if (_halo)
  {
    use("start", nodes, gdim, state.start);
    use("before", nodes, gdim, state.before);
  }
  for (std::size_t k = 0; k < _contacts.size(); ++k)
  {
    const std::string of = "contact " + std::to_string(k) + ": ";
    auto identity = _identities[k];
    use(of + "identity", nullptr, 0, identity);
    for (contact::Saved& s : state.contacts[k])
      use(of + s.name,
          s.rows == contact::RowKind::global  ? nullptr
          : s.rows == contact::RowKind::slave ? &_slaves[k]
                                              : nodes,
          s.width, s.values);
  }
  for (auto& [name, numbers] : state.steps)
    use(std::string(of_steps) + name, nullptr, 0, numbers);
}

Checkpoint::State Checkpoint::now() const
{
  State state;
  state.functions.resize(_functions.size());
  if (_halo)
  {
    state.start = _halo->start()->u;
    state.start.resize(_positions.size());
    state.before = _halo->before();
  }
  for (const auto& contact : _contacts)
  {
    state.contacts.push_back(contact::save(*contact));
    for (contact::Saved& s : state.contacts.back())
      // Rows of other ranks may follow
      if (s.rows == contact::RowKind::node)
        std::visit([&](auto& values)
                   { values.resize(_rows.front().size() * s.width); },
                   s.values);
  }
  return state;
}

void Checkpoint::write(storage::File& file,
                       std::vector<std::vector<double>> functions,
                       Numbers steps) const
{
  State state = now();
  for (std::size_t k = 0; k < _functions.size(); ++k)
    check::rows(std::ssize(functions[k]), std::ptrdiff_t(_rows[k].size()),
                _functions[k].width, _functions[k].name);
  state.functions = std::move(functions);
  state.steps = std::move(steps);
  std::vector<storage::Array> arrays;
  for_each(
      state,
      [&](std::string name, const storage::Rows* rows, int width, auto& values)
      { arrays.push_back({std::move(name), rows, width, std::move(values)}); });
  storage::write(*_ranks, file, arrays);
}

Checkpoint::State Checkpoint::read(storage::File& file) const
{
  const storage::Reader reader(*_ranks, file);
  State state = now();
  std::set<std::string> here;
  for (const storage::Entry& e : reader.entries())
    if (e.name.starts_with(of_steps))
      state.steps[e.name.substr(of_steps.size())];
  for_each(state, [&](const std::string& name, auto, int, auto&)
           { here.insert(name); });
  for (const storage::Entry& e : reader.entries())
    if (not here.contains(e.name))
      throw std::invalid_argument("'" + e.name
                                  + "' is only in the file: were contacts, "
                                    "their options or history others?");
  for_each(state,
           [&]<class T>(const std::string& name, const storage::Rows* rows,
                        int width, T& values)
           {
             storage::Array array{name, rows, width, values};
             reader.read(array);
             if constexpr (std::is_same_v<T, storage::Values>)
               std::swap(values, array.values);
             else
               std::swap(values, std::get<T>(array.values));
             if (not is_of_same_problem(*_ranks, name, array.values, values))
               throw std::invalid_argument(
                   "'" + name
                   + "' is another one here: restart the same problem");
             const auto bad = mesh::total(*_ranks, not_finite(name, values));
             if (bad > 0)
               throw std::invalid_argument("'" + name + "' is not finite at "
                                           + std::to_string(bad) + " dofs");
           });
  return state;
}

void Checkpoint::apply(const State& state) const
{
  if (_halo)
  {
    _halo->set_start(state.start);
    _halo->set_before(state.before);
  }
  for (std::size_t k = 0; k < _contacts.size(); ++k)
    contact::load(*_contacts[k], state.contacts[k]);
}
