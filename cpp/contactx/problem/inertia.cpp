// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "inertia.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

using namespace contactx;

void problem::check_masses(const Inertia& inertia, mesh::Ranks& ranks)
{
  const std::span<const double> mass = inertia.diagonal();
  const auto everywhere = [&](auto fits)
  { return mesh::everywhere(ranks, std::ranges::all_of(mass, fits)); };
  const auto none
      = mesh::total<std::int64_t>(ranks, std::ranges::count(mass, 0.0));
  const bool some = mesh::anywhere(
      ranks, std::ranges::any_of(mass, [](double m) { return m > 0; }));
  const bool never_negative = everywhere([](double m) { return m >= 0; });
  if (inertia.is_lumped() and none > 0 and some and never_negative)
    throw std::invalid_argument(
        "mass \"lumped\" leaves " + std::to_string(none)
        + " dofs without a mass: it takes density, with factors such as 2 pi "
          "r, at vertices, and it is zero at some, as on the axis of an "
          "axisymmetric model. Give mass=\"consistent\"");
  if (not everywhere([](double m) { return std::isfinite(m) and m > 0; }))
    throw std::invalid_argument(
        "density gives masses that are not positive and finite: give a density "
        "above 0 everywhere");
}
