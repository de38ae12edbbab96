// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include <optional>
#include <string>

namespace contactx::audit
{
/// @brief How far two round surfaces that fit each other are off the shapes
/// that their linear facets stand for, beside what presses there.
struct Chords
{
  double mean;    ///< what chords take off the gap, or add to it, in the mean
  double scatter; ///< in the mean, by how much that differs from node to node
  double turn;    ///< angle of a facet, by the radius
  double sagitta; ///< largest distance of a chord from its arc
  /// How far pressures press nodes in if others stay, in the mean over the
  /// force: pressure over the factor of the complementarity
  double pressed;

  /// @brief What chords change over what is pressed in.
  ///
  /// What differs from node to node is pressed in facet by facet, the mean by
  /// the bodies as a whole, which yield more by the radius over the facet.
  double ratio() const;

  /// @brief True if pressures are those of chords.
  bool is_coarse() const;

  /// @brief What that means and what to do: one sentence, which the name of the
  /// contact goes before.
  std::string words() const;
};

/// @brief Look at the facets in contact of two deformable bodies; collective.
///
/// Where an edge of a facet leads from one node to another one, the surface
/// rises over it by k s (1 - s) at the part s of the edge, see
/// `geometry::SmoothFacet`. Its k follows from the nodes' mean normals; it is
/// the smaller one of what either of them tells, so that a flat facet beside a
/// round one stays flat, and zero where facets of a node make an edge. Surfaces
/// fit where one is hollow and the other is not: where bodies touch in a point
/// or along a line, chords matter as cells do.
/// @param[in] halo Nodes of this rank.
/// @param[in] contact A contact of two deformable bodies, with the gaps, pairs
/// and multipliers of now.
/// @return Nothing where nothing is pressed, nor kept from it by chords, where
/// surfaces do not fit, are smooth or of quadratic facets that are integrated.
std::optional<Chords> chords(mesh::Halo& halo, const contact::Contact& contact);
} // namespace contactx::audit
