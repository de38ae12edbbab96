// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <array>
#include <cstdint>
#include <string_view>

/// @brief Kernels with the UFCx signature, assembled by DOLFINx.
namespace contactx::kernel
{
/// @brief UFCx tabulate function: local tensor, coefficients, constants,
/// coordinates, entity, permutation, custom data.
using Kernel = void(double*, const double*, const double*, const double*,
                    const int*, const std::uint8_t*, void*);

/// @brief What a coefficient's degrees of freedom belong to.
enum class Site : std::int8_t
{
  nodes, ///< the nodes of a pair: the slave node, then those of the facet
  pair,  ///< the pair
  slave  ///< the slave node
};

/// @brief Coefficients that every kernel is given, in this order.
enum class Coefficient : std::int8_t
{
  displacement,
  position,
  pair,
  multiplier,
  area,
  gap_derivative
};

/// @brief Description of a coefficient.
struct CoefficientInfo
{
  std::string_view name;
  Site site;
  int size; ///< values a dof; 0 stands for the geometric dimension
};

/// Values a pair with a facet: feature, local coordinates, components of a
/// ridge's normal in the frame of its facet, and the unit normal that the
/// search found
inline constexpr int pair_feature = 0;
inline constexpr int pair_xi = 1;
inline constexpr int pair_cone = 3;
inline constexpr int pair_normal = 6;
inline constexpr int pair_size = 9;

/// Values a pair with a rigid obstacle: gap, gradient of the gap, unit normal
/// and derivative of the normal, row-major
inline constexpr int rigid_gap = 0;
inline constexpr int rigid_gradient = 1;
inline constexpr int rigid_normal = 4;
inline constexpr int rigid_curvature = 7;
inline constexpr int rigid_size = 16;

/// @brief The coefficients in their order.
/// @param[in] num_nodes Number of nodes of the facet, 0 for a rigid obstacle.
constexpr std::array<CoefficientInfo, 6> coefficients(int num_nodes)
{
  return {{{"displacement", Site::nodes, 0},
           {"position", Site::nodes, 0},
           {"pair", Site::pair, num_nodes > 0 ? pair_size : rigid_size},
           {"multiplier", Site::slave, 1},
           {"area", Site::slave, 1},
           {"gap_derivative", Site::slave, 1}}};
}

/// @brief Place of a coefficient in the array that a kernel is given.
/// @param[in] c Coefficient.
/// @param[in] num_nodes Number of nodes of the facet, 0 for a rigid obstacle.
/// @param[in] gdim Geometric dimension.
constexpr int offset(Coefficient c, int num_nodes, int gdim)
{
  int n = 0;
  for (int i = 0; i < static_cast<int>(c); ++i)
  {
    const CoefficientInfo info = coefficients(num_nodes)[i];
    n += (info.site == Site::nodes ? num_nodes + 1 : 1)
         * (info.size > 0 ? info.size : gdim);
  }
  return n;
}
} // namespace contactx::kernel
