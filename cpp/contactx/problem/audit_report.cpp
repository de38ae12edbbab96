// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "audit_report.h"
#include "../contact/obstacle_pairs.h"
#include "../mesh/deformed_cells.h"
#include "../text.h"
#include <algorithm>

using namespace contactx;
using namespace contactx::problem;

namespace
{
constexpr const char* far
    = "the body has come to its far side, or is too thin for the overlap. Take "
      "smaller load steps, or start without the overlap";
constexpr const char* unpaired
    = "sliding=\"small\" pairs nodes in the reference configuration, once: "
      "give a larger search_distance, or take sliding=\"finite\"";

/// Adds a text on slave nodes inside their master, if there are any.
void add_inside(AuditReport& report, const std::string& name,
                const std::string& what, const audit::Findings& found,
                double size, const std::string& advice)
{
  const audit::FoundNodes& inside = found.inside;
  if (inside.count > 0)
    report.faults.push_back(name + ": " + std::to_string(inside.count)
                            + " slave nodes are inside the " + what
                            + ", first node " + std::to_string(inside.first)
                            + " of the mesh as it was made, at "
                            + point_text(inside.at, size) + ": " + advice
                            + " (manual: errors/nodes-inside)");
}

/// Adds a text on what reaches through a slave facet, if that is deeper than
/// the mesh explains.
void add_depth(AuditReport& report, const std::string& name,
               const std::string& what, const audit::Findings& found,
               const std::string& place, const std::string& advice)
{
  if (not found.penetrates_too_deep or not found.deepest)
    return;
  const audit::Depth& worst = *found.deepest;
  report.faults.push_back(
      name + ": the " + what + " reaches " + number_text(worst.depth, 3)
      + " deep through a slave facet of size " + number_text(worst.size, 3)
      + " " + place + " " + point_text(worst.at, worst.size)
      + ", between its nodes" + (worst.is_held ? "" : ", which are open")
      + ": the slave surface is too coarse to see it. " + advice
      + " (manual: errors/slave-too-coarse)");
}
} // namespace

void contactx::problem::add(AuditReport& report, const std::string& name,
                            const contact::Contact& contact,
                            const audit::Findings& found, double size)
{
  report.passed += found.passed.count;
  report.far_side += found.inside.count;
  if (found.deepest and found.deepest->excess > report.excess)
  {
    report.excess = found.deepest->excess;
    report.depth = std::max(found.deepest->depth, 0.);
  }
  if (found.roundness)
    report.radius_in_facets
        = std::min(report.radius_in_facets, found.roundness->facets());
  if (found.chords)
    report.chords = std::max(report.chords, found.chords->ratio());
  if (found.edges)
    report.edges = std::max(report.edges, found.edges->ratio());
  for (const std::string& text : found.warnings)
    report.warnings.push_back(name + ": " + text);

  const std::string count = std::to_string(found.passed.count);
  if (const auto* master
      = dynamic_cast<const contact::ObstacleMaster*>(contact.master().get()))
  {
    const std::string kind = "rigid " + master->obstacle()->name();
    if (found.passed.count > 0)
      report.faults.push_back(
          name + ": " + count + " slave nodes and facets went through the "
          + kind
          + " within the step and are on its far side. Take smaller load steps "
            "(manual: errors/passed-through)");
    add_inside(report, name, kind + ", which they face away from", found, size,
               far);
    add_depth(report, name, kind, found, "around", "Refine the slave surface");
    return;
  }
  if (found.passed.count > 0)
    report.faults.push_back(
        name + ": " + count
        + " nodes went through the other surface within the step, the first is "
          "at "
        + point_text(found.passed.at, found.facet_size)
        + ". Take smaller load steps (manual: errors/passed-through)");
  if (found.apart > 0)
    report.faults.push_back(
        name + ": the surfaces press across a distance of "
        + number_text(found.apart, 2)
        + " or more, though slave facets have the size "
        + number_text(found.facet_size, 3)
        + " and nothing touches: the slave surface is too coarse to see an "
          "edge of the master. Swap slave and master, or refine the slave "
          "surface (manual: errors/slave-too-coarse)");
  const bool is_small = contact.sliding() == contact::Sliding::small;
  add_inside(report, name, "master, and have no pair with it", found, size,
             is_small ? unpaired : far);
  if (contact.is_self())
    add_depth(report, name, "surface", found, "at",
              "Refine it, or take smaller load steps");
  else
    add_depth(report, name, "master", found, "at",
              "Swap slave and master, or refine the slave surface");
}

DeformedCells contactx::problem::deformed_cells(mesh::Halo& halo,
                                                solve::Bulk& bulk)
{
  const int g = halo.gdim(), width = bulk.nodes_per_cell();
  const std::span<const std::int32_t> cells = bulk.cells();
  const std::span<const double> X = halo.reference();
  const mesh::DeformedCells mine
      = mesh::deformed_cells(cells, width, X, halo.now()->u, g);
  // Smallest det F and midpoint of each rank that has cells
  std::vector<double> row;
  if (mine.cell >= 0)
  {
    row.assign(g + 1, 0);
    row[0] = mine.smallest;
    for (const std::int32_t node :
         cells.subspan(std::size_t(mine.cell) * width, width))
      for (int k = 0; k < g; ++k)
        row[1 + k] += X[std::size_t(node) * g + k] / width;
  }
  const auto all = mesh::gathered<double>(halo.ranks(), row);
  DeformedCells found;
  found.inverted = mesh::total(halo.ranks(), mine.inverted);
  std::span<const double> best;
  for (std::size_t at = 0; at < all.size(); at += g + 1)
  {
    const auto theirs = std::span(all).subspan(at, g + 1);
    // Of equal ones the first by its place, on any number of ranks
    if (best.empty() or std::ranges::lexicographical_compare(theirs, best))
      best = theirs;
  }
  if (not best.empty())
  {
    found.smallest = best[0];
    found.at.assign(best.begin() + 1, best.end());
  }
  return found;
}

void contactx::problem::add(AuditReport& report, const DeformedCells& found,
                            bool is_linear, double size)
{
  report.smallest_det = found.smallest;
  report.inverted = found.inverted;
  if (found.inverted == 0)
    return;
  const std::string text
      = std::to_string(found.inverted)
        + " cells are turned inside out, the worst with det F = "
        + number_text(found.smallest, 3) + " at " + point_text(found.at, size)
        + " in the reference configuration. ";
  if (is_linear)
    report.warnings.push_back(
        text
        + "A linear material does not resist that: take one for large strains "
          "(manual: errors/cells-inside-out)");
  else
    report.faults.push_back(
        text
        + "Take smaller load steps, or a line search (snes_linesearch_type bt) "
          "(manual: errors/cells-inside-out)");
}
