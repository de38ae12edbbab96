// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "condensation.h"
#include <algorithm>
#include <string>

using namespace contactx;
using namespace contactx::condense;

namespace
{
void check_size(std::size_t size, std::size_t least, std::size_t most,
                const char* name)
{
  if (size < least or size > most)
    throw std::invalid_argument(std::string(name) + " has "
                                + std::to_string(size) + " values, not "
                                + std::to_string(most));
}

/// Blocks of what fits
Blocks checked(const CompressedRows& contact, std::span<const Nodes> contacts,
               std::span<const std::int8_t> free, int gdim,
               std::span<const double> diagonal)
{
  condense::check(contacts, free.size() / std::max(gdim, 1), gdim);
  const std::size_t num_local = free.size();
  check_size(num_local, num_local / gdim * gdim, num_local / gdim * gdim,
             "free");
  const std::size_t size = num_local + num_multipliers(contacts);
  check_size(contact.offsets.size(), size + 1, size + 1, "offsets");
  // Slave nodes are this rank's
  std::size_t num_slave = 0;
  for (const Nodes& nodes : contacts)
    for (const std::int32_t node : nodes.slaves)
      num_slave = std::max(num_slave, (std::size_t(node) + 1) * gdim);
  check_size(diagonal.size(), num_slave, num_local, "diagonal");
  return sorted(contact, num_local);
}
} // namespace

Condensation::Condensation(const CompressedRows& contact,
                           std::span<const Nodes> contacts,
                           std::span<const std::int8_t> free, int gdim,
                           std::span<const double> diagonal, bool holds)
    : _num_local(free.size()),
      _num_multipliers(condense::num_multipliers(contacts)),
      _prescribed(contacts, checked(contact, contacts, free, gdim, diagonal),
                  free, gdim, diagonal, holds),
      _elimination(contacts, _prescribed, free, gdim, diagonal)
{
}

Condensation::RightHandSide
Condensation::right_hand_side(std::span<const double> d) const
{
  check_size(d.size(), _num_multipliers, _num_multipliers, "d");
  RightHandSide result;
  result.forces.assign(_num_local, 0);
  std::vector<double> left(d.begin(), d.end());
  _prescribed.right_hand_side(left, result.forces, result.retained);
  result.multipliers = _elimination.open_multipliers(left);
  _prescribed.blocks().traction.multiply(result.multipliers, result.forces, -1);
  result.shift = _elimination.shift(left);
  result.extra = _elimination.extra(left);
  result.preload = _elimination.preload(left);
  return result;
}

void Condensation::recover(std::span<const double> d,
                           std::span<const double> defect,
                           std::span<const double> u,
                           std::span<double> multipliers) const
{
  check_size(d.size(), _num_multipliers, _num_multipliers, "d");
  check_size(u.size(), _num_local, _num_local, "u");
  check_size(multipliers.size(), _num_multipliers, _num_multipliers,
             "multipliers");
  const auto& rows = _elimination.recovered();
  const std::size_t least = rows.empty() ? 0 : std::ranges::max(rows) + 1;
  check_size(defect.size(), least, _num_local, "defect");
  std::vector<double> left(d.begin(), d.end()), forces(_num_local), retained;
  _prescribed.right_hand_side(left, forces, retained);
  _elimination.recover(left, defect, u, multipliers);
  _prescribed.recover(d, u, multipliers);
}
