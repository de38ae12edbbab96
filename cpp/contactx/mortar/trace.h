// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../facet/quadratic.h"
#include "inverse_map.h"

namespace contactx::mortar
{
/// @brief Shape functions of a facet at a point of one of its parts.
/// @param[in] s Those of the part there.
/// @param[in] places Places of the part's nodes.
template <class F>
Vector<F::nodes> trace(const Shape<facet::Part<F>>& s,
                       const facet::Places<F>& places)
{
  if constexpr (facet::is_linear<F>)
    return s.N;
  else
  {
    facet::Local<F> xi{};
    for (int j = 0; j < facet::Part<F>::nodes; ++j)
      xi = xi + s.N[j] * F::points[places[j]];
    return F::shape(xi);
  }
}

/// @brief Their derivatives by the plane's coordinates.
/// @param[in] s Shape functions of the part there.
/// @param[in] places Places of the part's nodes.
template <class F>
std::array<Vector<F::nodes>, F::tdim>
trace_slope(const Shape<facet::Part<F>>& s, const facet::Places<F>& places)
{
  if constexpr (facet::is_linear<F>)
    return s.slope;
  else
  {
    facet::Local<F> xi{};
    std::array<facet::Local<F>, F::tdim> by_plane{}; // dxi / dr_i
    for (int j = 0; j < facet::Part<F>::nodes; ++j)
    {
      xi = xi + s.N[j] * F::points[places[j]];
      for (int i = 0; i < F::tdim; ++i)
        by_plane[i] = by_plane[i] + s.slope[i][j] * F::points[places[j]];
    }
    const auto dN = F::derivative(xi);
    std::array<Vector<F::nodes>, F::tdim> slope{};
    for (int i = 0; i < F::tdim; ++i)
      for (int a = 0; a < F::tdim; ++a)
        slope[i] = slope[i] + by_plane[i][a] * dN[a];
    return slope;
  }
}
} // namespace contactx::mortar
