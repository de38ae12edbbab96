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

/// @brief Contact laws, which differ in their multipliers.
enum class Law : std::int8_t
{
  frictionless, ///< scalar multiplier, the pressure
  frictional,   ///< vector multiplier, the traction
  tied          ///< vector multiplier that never opens
};

/// @brief What a coefficient's degrees of freedom belong to.
enum class Site : std::int8_t
{
  nodes, ///< the nodes of a pair: the slave node, then those of the facet
  pair,  ///< the pair
  slave  ///< the slave node
};

/// @brief Coefficients that kernels are given, in this order. Those of slip
/// and of the normal do not exist without friction.
enum class Coefficient : std::int8_t
{
  displacement,
  position,
  pair,
  slip,
  multiplier,
  area,
  gap_derivative,
  slip_derivative,
  normal_derivative
};

/// Number of coefficients
inline constexpr int num_coefficients = 9;

/// @brief Description of a coefficient.
struct CoefficientInfo
{
  std::string_view name;
  Site site;
  int size; ///< values a dof; 0 where the law has no such coefficient
};

/// Values a pair with a facet: feature, local coordinates, components of a
/// ridge's normal in the frame of its facet, and the unit normal that the
/// search found
inline constexpr int pair_feature = 0;
inline constexpr int pair_xi = 1;
inline constexpr int pair_cone = 3;
inline constexpr int pair_normal = 6;
inline constexpr int pair_size = 9;

/// Values of slip a pair with a facet: local coordinates and gap of the point
/// that slip is measured from, and its place relative to those local
/// coordinates while the pair is held
inline constexpr int slip_xi = 0;
inline constexpr int slip_gap = 2;
inline constexpr int slip_origin = 3;
inline constexpr int slip_size = 6;

/// Values a pair with a rigid obstacle: gap, gradient of the gap, unit normal
/// and derivative of the normal, row-major
inline constexpr int rigid_gap = 0;
inline constexpr int rigid_gradient = 1;
inline constexpr int rigid_normal = 4;
inline constexpr int rigid_curvature = 7;
inline constexpr int rigid_size = 16;

/// Values of slip a pair with a rigid obstacle: slip and its derivative,
/// row-major
inline constexpr int rigid_slip = 0;
inline constexpr int rigid_slip_derivative = 3;
inline constexpr int rigid_slip_size = 12;

/// @brief The coefficients in their order.
/// @param[in] law Contact law.
/// @param[in] num_nodes Number of nodes of the facet, 0 for a rigid obstacle.
/// @param[in] gdim Geometric dimension.
constexpr std::array<CoefficientInfo, num_coefficients>
coefficients(Law law, int num_nodes, int gdim)
{
  const bool facet = num_nodes > 0;
  const bool vector = law != Law::frictionless;
  const int n = vector ? gdim : 1;
  return {
      {{"displacement", Site::nodes, gdim},
       {"position", Site::nodes, gdim},
       {"pair", Site::pair, facet ? pair_size : rigid_size},
       {"slip", Site::pair, vector ? (facet ? slip_size : rigid_slip_size) : 0},
       {"multiplier", Site::slave, n},
       {"area", Site::slave, 1},
       {"gap_derivative", Site::slave, n},
       {"slip_derivative", Site::slave, vector ? gdim * gdim : 0},
       {"normal_derivative", Site::slave, vector ? gdim * gdim : 0}}};
}

/// @brief Place of a coefficient in the array that a kernel is given.
/// @param[in] law Contact law.
/// @param[in] c Coefficient.
/// @param[in] num_nodes Number of nodes of the facet, 0 for a rigid obstacle.
/// @param[in] gdim Geometric dimension.
constexpr int offset(Law law, Coefficient c, int num_nodes, int gdim)
{
  const auto table = coefficients(law, num_nodes, gdim);
  int n = 0;
  for (int i = 0; i < static_cast<int>(c); ++i)
    n += (table[i].site == Site::nodes ? num_nodes + 1 : 1) * table[i].size;
  return n;
}
} // namespace contactx::kernel
