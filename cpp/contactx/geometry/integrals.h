// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"
#include "quadratic_facets.h"
#include "smooth.h"
#include <cstdint>
#include <span>
#include <vector>

namespace contactx::geometry
{
/// @brief Pairs of slave and master facets.
struct FacetPairs
{
  std::vector<std::int32_t> slave;  ///< slave facet of each pair, ascending
  std::vector<std::int32_t> master; ///< its master facet

  /// @brief Number of pairs.
  std::size_t size() const { return slave.size(); }

  bool operator==(const FacetPairs&) const = default;
};

/// Places for the nodes of a linear facet, the stride of arrays over them
inline constexpr int most_nodes = 4;

/// @brief Integrals of the dual basis functions of the slave facets over the
/// parts that face master facets, by reference area.
///
/// The dual functions Phi_s = sum_t a_st M_t of a slave facet are biorthogonal
/// to its basis M, see Basis, over all of its parts, int Phi_s M_t =
/// delta_st area_s (B. I. Wohlmuth, SIAM J. Numer. Anal. 38, 2000; on facets
/// that are partly covered: T. Cichosz and M. Bischoff, Comput. Methods Appl.
/// Mech. Engrg. 200, 2011).
struct Integrals
{
  int width = most_nodes; ///< places for a facet's nodes, n
  /// int Phi_s N_l of each pair (shape=(num_pairs, n, n))
  std::vector<double> weight;
  /// int Phi_s gap of each pair, the gap measured along the direction of the
  /// projection (shape=(num_pairs, n))
  std::vector<double> gap;
  /// int Phi_s (rise of both facets' patches) of each pair, where facets are
  /// smooth (shape=(num_pairs, n)); else empty
  std::vector<double> rise;
  /// Coefficients a_st of each slave facet (shape=(num_facets, n, n))
  std::vector<double> dual;
  /// int Phi_s = int M_s over the covered part (shape=(num_facets, n))
  std::vector<double> area;
  /// Unit normal of the master: against the direction that the slave facet is
  /// projected along (shape=(num_facets, 3))
  std::vector<double> normal;
};

/// Least covered fraction of a slave facet
inline constexpr double covered_fraction_min = 1e-3;

/// @brief Facets of one side: linear ones, and those that they are parts of.
struct Side
{
  FacetList facets;               ///< facets that are paired
  const QuadraticFacets* parents; ///< whole facets that they are parts of
  /// Smooth patches that linear facets stand for; empty for none
  std::span<const SmoothFacet> smooth = {};
};

/// @brief Compute the integrals. Those of parts are of the shape functions of
/// the whole facets, in the order of their nodes.
/// @param[in] slave Slave facets.
/// @param[in] master Master facets, smooth if the slave's are.
/// @param[in] pairs Pairs, ascending by slave facet. Those that share nothing
/// get zeros.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] reference Node coordinates in the reference configuration.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] normal Unit normals of the master to project along, one a slave
/// facet (shape=(num_facets, 3)); where it is zero, or if empty, that against
/// the slave facet's own.
/// @param[in] weight Weight of the integrals, at the corners of the slave
/// facets (shape=(slave.nodes.size())); 1 if empty.
Integrals integrals(const Side& slave, const Side& master,
                    const FacetPairs& pairs, std::span<const double> x,
                    std::span<const double> reference, int gdim,
                    std::span<const double> normal = {},
                    std::span<const double> weight = {});

/// @brief Integrals over pairs of linear facets.
Integrals integrals(const FacetList& slave, const FacetList& master,
                    const FacetPairs& pairs, std::span<const double> x,
                    std::span<const double> reference, int gdim,
                    std::span<const double> normal = {},
                    std::span<const double> weight = {});
} // namespace contactx::geometry
