// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "layout.h"
#include "pair.h"

namespace contactx::kernel
{
/// @brief State of a slave node that the kernels of a vector multiplier read.
template <class F>
struct NodeState
{
  /// @brief Read from the coefficients.
  /// @param[in] w Coefficients of a law with slip.
  explicit NodeState(const double* w)
      : multiplier(at(w, Coefficient::multiplier)),
        area(*at(w, Coefficient::area)),
        gap_derivative(at(w, Coefficient::gap_derivative)),
        slip_derivative(at(w, Coefficient::slip_derivative)),
        normal_derivative(at(w, Coefficient::normal_derivative))
  {
  }

  const double* multiplier; ///< traction (shape=(gdim))
  double area;
  /// Derivatives of the complementarity function: by the gap (shape=(gdim)),
  /// the slip and the normal (shape=(gdim, gdim))
  const double *gap_derivative, *slip_derivative, *normal_derivative;

private:
  static const double* at(const double* w, Coefficient c)
  {
    return w + offset(Law::frictional, c, F::nodes, F::gdim);
  }
};
} // namespace contactx::kernel
