// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <map>

namespace contactx::mesh
{
class Halo;
}

namespace contactx_dolfinx
{
/// @brief Sizes of the contributions of cells and integrals to a residual,
/// before their sum.
///
/// A residual in a space that is broken between the cells has them side by
/// side; the kernels are those of the form. What one integral adds up, such as
/// a stress less that of a thermal strain, has cancelled before. FFCx makes one
/// integral of all terms over the same cells or facets.
class CellForces
{
public:
  /// @brief Take the residual; nothing is made before it is asked for.
  /// @param[in] F Residual.
  /// @param[in] V Space of the displacement.
  CellForces(std::shared_ptr<const Form> F,
             std::shared_ptr<const FunctionSpace> V);

  /// @brief Sum over cells and integrals of the size of the force on each owned
  /// node (shape=(num_owned)). All ranks must take part.
  /// @param[in] halo Nodes of this rank.
  std::vector<double> magnitudes(const contactx::mesh::Halo& halo);

private:
  /// Make the broken space, and a form in it of each integral. Coefficients are
  /// packed for the residual itself, as the maps between meshes that it may
  /// need for them are its own.
  void make();

  std::shared_ptr<const Form> _F;
  std::shared_ptr<const FunctionSpace> _V, _broken;
  std::map<std::pair<dolfinx::fem::IntegralType, int>, Form> _terms;
};
} // namespace contactx_dolfinx
