// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../audit/findings.h"
#include "../contact/contact.h"
#include "../solve/bulk.h"
#include <limits>
#include <string>
#include <vector>

namespace contactx::problem
{
/// @brief What the audit of a converged iterate has found of all contacts and
/// of the cells, in numbers and in words; the same on all ranks.
struct AuditReport
{
  /// Slave nodes inside their master, or on the far side of a rigid one
  std::int64_t far_side = 0;
  std::int64_t passed = 0; ///< nodes that went through the other surface
  /// Largest depth of a master below a slave facet, between its nodes
  double depth = 0;
  double excess = 0; ///< largest ratio of such a depth to what a mesh explains
  /// Smallest radius of curvature of an obstacle where slave nodes touch it, by
  /// the facets' size
  double radius_in_facets = std::numeric_limits<double>::infinity();
  /// What gaps of round surfaces that fit are off by chords, over what is
  /// pressed in
  double chords = 0;
  /// Where edges of a master press a smooth slave, what the force there is off
  /// the slave's normals, over the normal force; infinite where an edge between
  /// slave nodes would need more force than they take
  double edges = 0;
  std::int64_t inverted = 0; ///< cells that are turned inside out
  /// Smallest det F of the cells, NaN where none was checked
  double smallest_det = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> faults;   ///< what is wrong, and what to do
  std::vector<std::string> warnings; ///< what is only warned of
};

/// @brief Add what was found of a contact.
/// @param[in,out] report The report.
/// @param[in] name Name of the contact.
/// @param[in] contact The contact.
/// @param[in] found What was found of it.
/// @param[in] size Size of the scene.
void add(AuditReport& report, const std::string& name,
         const contact::Contact& contact, const audit::Findings& found,
         double size);

/// @brief The cells that displacements squeeze most, of all ranks.
struct DeformedCells
{
  /// Smallest det F at the points that mesh::deformed_cells names, infinity
  /// where there are no cells
  double smallest = std::numeric_limits<double>::infinity();
  std::int64_t inverted = 0; ///< number of cells that are turned inside out
  /// Midpoint of the cell with the smallest one in the reference configuration
  /// (shape=(gdim)); empty where there are no cells
  std::vector<double> at;
};

/// @brief Look at the cells of all ranks; collective.
/// @param[in] halo Nodes of this rank, with their displacements.
/// @param[in] bulk The bulk.
DeformedCells deformed_cells(mesh::Halo& halo, solve::Bulk& bulk);

/// @brief Add the cells that are turned inside out: a fault where the material
/// resists that, else a warning.
/// @param[in,out] report The report.
/// @param[in] found The cells.
/// @param[in] is_linear Whether the bulk is.
/// @param[in] size Size of the scene.
void add(AuditReport& report, const DeformedCells& found, bool is_linear,
         double size);
} // namespace contactx::problem
