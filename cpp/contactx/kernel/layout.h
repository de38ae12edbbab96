// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

/// @brief Kernels with the UFCx signature: what one pair adds to a vector or a
/// matrix.
///
/// The driver of a step calls them itself and assembles rows (assemble.h,
/// condense/contact_block.h): in small problems that is two to three times as
/// fast as DOLFINx's assembly of forms made of them (bench_forms.py), and no
/// forms have to be made anew where pairs change. The forms are the door for
/// others, for a loop or a matrix of their own; a test holds both equal.
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

/// @brief Entity that a coefficient's degrees of freedom belong to.
enum class Site : std::int8_t
{
  nodes, ///< the nodes of a pair: those of the slave, then those of the facet
  pair,  ///< the pair
  slave  ///< the slave nodes: one, or those of a slave facet
};

/// @brief Coefficients that kernels are given, in this order. Those of slip
/// and of the normal do not exist without friction.
///
/// Pairs of facets have slave nodes of other ranks, too, whose shares are in
/// pairs of those. Here they have no multipliers and no derivatives, and
/// negative areas.
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

/// Area of slave nodes of other ranks: what is divided by it goes nowhere
inline constexpr double area_elsewhere = -1;

/// @brief True for the area of a slave node of another rank.
constexpr bool is_elsewhere(double area) { return area < 0; }

/// @brief Description of a coefficient.
struct CoefficientInfo
{
  std::string_view name;
  Site site;
  int size; ///< values a dof; 0 where the law has no such coefficient
};

/// @brief A pair of a slave node with a facet, as the search found it.
struct FacetPair
{
  double feature = 0;             ///< of the facet, see geometry::interior
  std::array<double, 2> xi{};     ///< local coordinates
  std::array<double, 3> cone{};   ///< a ridge's normal in the facet's frame
  std::array<double, 3> normal{}; ///< unit normal
};

/// @brief Slip of such a pair: the point that it is measured from.
struct FacetSlip
{
  std::array<double, 2> xi{}; ///< local coordinates
  double gap = 0;             ///< gap
  /// Place relative to those local coordinates while kinematics are frozen
  std::array<double, 3> origin{};
};

/// @brief A pair of a slave node with a rigid obstacle. In the plane vectors
/// have two components, and matrices are 2 x 2, without anything between rows.
struct ObstaclePair
{
  double gap = 0;                    ///< gap
  std::array<double, 3> gradient{};  ///< of the gap
  std::array<double, 3> normal{};    ///< unit normal
  std::array<double, 9> curvature{}; ///< derivative of the normal, row-major
};

/// @brief Slip of such a pair.
struct ObstacleSlip
{
  std::array<double, 3> slip{};       ///< slip
  std::array<double, 9> derivative{}; ///< its derivative, row-major
};

/// Number of values of a row of these kinds, which have nothing but doubles
template <class Row>
inline constexpr int num_values = sizeof(Row) / sizeof(double);

/// @brief Read a row of values.
/// @param[in] values The values, `num_values` of them.
template <class Row>
Row read(const double* values)
{
  static_assert(std::is_trivially_copyable_v<Row>
                and sizeof(Row) % sizeof(double) == 0);
  Row row;
  std::memcpy(static_cast<void*>(&row), values, sizeof(Row));
  return row;
}

/// @brief Rows as the values that coefficients hold, one after the other.
template <class Row>
std::span<const double> values_of(std::span<const Row> rows)
{
  static_assert(std::is_standard_layout_v<Row>
                and alignof(Row) == alignof(double));
  return {reinterpret_cast<const double*>(rows.data()),
          rows.size() * num_values<Row>};
}

/// @brief Rows of values, as many as there are whole ones.
template <class Row>
std::vector<Row> rows_of(std::span<const double> values)
{
  std::vector<Row> rows(values.size() / num_values<Row>);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = read<Row>(values.data() + num_values<Row> * i);
  return rows;
}

/// @brief What a pair of two facets keeps from one search to the next in finite
/// sliding.
enum class Keeps : std::int8_t
{
  nothing, ///< the normal is that of the slave facet, now
  normal,  ///< the normal that the search found
  all      ///< normals at the slave nodes and the integrals
};

/// @brief Places of the values a pair of two facets, with `s` slave and `m`
/// master nodes: integrals of the dual basis functions with the master's shape
/// functions, the dual functions' coefficients, integrals of the gap, the
/// unit normal that the search found, what finite sliding keeps of it, a
/// `Keeps`, unit normals at the slave nodes where it keeps all, weight of the
/// integrals at the slave part's nodes, and the places of the nodes of both
/// parts among those of the facets.
struct MortarLayout
{
  int weight, dual, gap, normal, keeps, normals, factor, slave_places,
      master_places, size;

  constexpr MortarLayout(int s, int m)
      : weight(0), dual(s * m), gap(dual + s * s), normal(gap + s),
        keeps(normal + 3), normals(keeps + 1), factor(normals + 3 * s),
        slave_places(factor + 4), master_places(slave_places + 4),
        size(master_places + 4)
  {
  }
};

/// @brief Places of the values a slave facet before a rigid obstacle, with `s`
/// nodes: integrals of the dual basis functions alone, with the gap, with its
/// gradient, with the normal and its derivative, the derivatives by the nodes
/// of the facet, row-major.
struct RigidMortarLayout
{
  int area, gap, gradient, normal, curvature, size;

  constexpr RigidMortarLayout(int s, int gdim)
      : area(0), gap(s), gradient(2 * s), normal(gradient + s * s * gdim),
        curvature(normal + s * gdim), size(curvature + s * s * gdim * gdim)
  {
  }
};

/// @brief Number of values a pair.
/// @param[in] num_slaves Number of slave nodes.
/// @param[in] num_nodes Number of nodes of the facet, 0 for a rigid obstacle.
/// @param[in] gdim Geometric dimension.
constexpr int pair_values(int num_slaves, int num_nodes, int gdim)
{
  if (num_slaves > 1)
    return num_nodes > 0 ? MortarLayout(num_slaves, num_nodes).size
                         : RigidMortarLayout(num_slaves, gdim).size;
  return num_nodes > 0 ? num_values<FacetPair> : num_values<ObstaclePair>;
}

/// @brief The coefficients in their order. Those of slip a pair exist for
/// single slave nodes alone.
/// @param[in] law Contact law.
/// @param[in] num_nodes Number of nodes of the facet, 0 for a rigid obstacle.
/// @param[in] gdim Geometric dimension.
/// @param[in] num_slaves Number of slave nodes: 1, or those of a slave facet.
constexpr std::array<CoefficientInfo, num_coefficients>
coefficients(Law law, int num_nodes, int gdim, int num_slaves = 1)
{
  const bool vector = law != Law::frictionless;
  const int slip
      = num_nodes > 0 ? num_values<FacetSlip> : num_values<ObstacleSlip>;
  const int n = vector ? gdim : 1;
  return {{{"displacement", Site::nodes, gdim},
           {"position", Site::nodes, gdim},
           {"pair", Site::pair, pair_values(num_slaves, num_nodes, gdim)},
           {"slip", Site::pair, vector and num_slaves == 1 ? slip : 0},
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
/// @param[in] num_slaves Number of slave nodes: 1, or those of a slave facet.
constexpr int offset(Law law, Coefficient c, int num_nodes, int gdim,
                     int num_slaves = 1)
{
  const auto table = coefficients(law, num_nodes, gdim, num_slaves);
  int n = 0;
  for (int i = 0; i < static_cast<int>(c); ++i)
  {
    const Site site = table[i].site;
    const int count = site == Site::nodes   ? num_slaves + num_nodes
                      : site == Site::slave ? num_slaves
                                            : 1;
    n += count * table[i].size;
  }
  return n;
}

/// @brief Number of values of all coefficients that a kernel is given.
/// @param[in] law Contact law.
/// @param[in] num_nodes Number of nodes of the facet, 0 for a rigid obstacle.
/// @param[in] gdim Geometric dimension.
/// @param[in] num_slaves Number of slave nodes: 1, or those of a slave facet.
constexpr int coefficient_values(Law law, int num_nodes, int gdim,
                                 int num_slaves = 1)
{
  return offset(law, static_cast<Coefficient>(num_coefficients), num_nodes,
                gdim, num_slaves);
}
} // namespace contactx::kernel
