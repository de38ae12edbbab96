// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "shared_nodes.h"
#include "../check.h"
#include "../math/vec.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// Length of a unit normal's part outside the span of others, from which on its
/// constraint is independent of theirs
constexpr double independent_normal_min = 0.1;

/// Directions that constraints of a node span.
class Span
{
public:
  /// @brief Part of a vector outside of it.
  Vector<3> rest(const Vector<3>& v) const
  {
    if (_is_whole)
      return {0, 0, 0};
    Vector<3> r = v;
    for (int k = 0; k < _size; ++k)
      r = r - dot(_basis[k], v) * _basis[k];
    return r;
  }

  /// @brief Add a direction outside of it.
  void add(const Vector<3>& unit)
  {
    _basis[_size++] = unit;
    _is_whole = _size == 3;
  }

  void add_all() { _is_whole = true; }

private:
  std::array<Vector<3>, 3> _basis;
  int _size = 0;
  bool _is_whole = false;
};
} // namespace

SharedNodes::SharedNodes(
    const std::vector<std::span<const std::int32_t>>& slaves)
{
  std::vector<std::tuple<std::int32_t, std::size_t, std::size_t>> all;
  for (std::size_t k = 0; k < slaves.size(); ++k)
  {
    _sizes.push_back(slaves[k].size());
    for (std::size_t i = 0; i < slaves[k].size(); ++i)
      all.emplace_back(slaves[k][i], k, i);
  }
  std::ranges::sort(all);
  for (std::size_t a = 0, b = 0; a < all.size(); a = b)
  {
    while (b < all.size() and std::get<0>(all[b]) == std::get<0>(all[a]))
      ++b;
    if (b - a == 1)
      continue;
    _shared.push_back(std::get<0>(all[a]));
    auto& places = _places.emplace_back();
    for (std::size_t c = a; c < b; ++c)
      places.push_back({std::get<1>(all[c]), std::get<2>(all[c])});
  }
}

std::vector<Shared> SharedNodes::update(const std::vector<Closing>& contacts)
{
  if (contacts.size() != _sizes.size())
    throw std::invalid_argument("contacts must be as many as there were");
  for (std::size_t k = 0; k < contacts.size(); ++k)
  {
    check::rows(contacts[k].closes.size(), _sizes[k], 1, "closes");
    check::rows(contacts[k].gap.size(), _sizes[k], 1, "gap");
    check::rows(contacts[k].normal.size(), _sizes[k], 3, "normal");
  }
  _corners = 0;
  std::vector<Shared> result;
  for (std::size_t n : _sizes)
    result.push_back(
        {std::vector<std::int8_t>(n, 0), std::vector<std::int8_t>(n, 0)});
  std::vector<Place> closed;
  for (std::size_t s = 0; s < _shared.size(); ++s)
  {
    closed.clear();
    for (const Place& place : _places[s])
      if (contacts[place.contact].closes[place.node])
        closed.push_back(place);
    if (closed.size() > 1)
      decide(contacts, closed, result);
  }
  return result;
}

void SharedNodes::decide(const std::vector<Closing>& contacts,
                         std::vector<Place>& closed,
                         std::vector<Shared>& result)
{
  const auto urgency = [&contacts](const Place& place)
  {
    const Closing& c = contacts[place.contact];
    const double gap = c.gap[place.node];
    // A tie may have none
    return std::tuple(not c.is_tied,
                      std::isnan(gap) ? std::numeric_limits<double>::infinity()
                                      : gap,
                      place.contact);
  };
  std::ranges::sort(closed, {}, urgency);
  Span span;
  std::vector<Place> kept;
  for (const Place& place : closed)
  {
    const Closing& c = contacts[place.contact];
    Vector<3> normal;
    std::copy_n(c.normal.begin() + 3 * place.node, 3, normal.begin());
    const Vector<3> rest = span.rest(normal);
    const double size = norm(rest);
    if (not(size >= independent_normal_min))
    {
      result[place.contact].redundant[place.node] = 1;
      continue;
    }
    kept.push_back(place);
    if (c.is_tied)
      span.add_all();
    else
      span.add((1 / size) * rest);
  }
  if (kept.size() < 2)
    return;
  ++_corners;
  for (const Place& place : kept)
    result[place.contact].frictionless[place.node] = 1;
}
