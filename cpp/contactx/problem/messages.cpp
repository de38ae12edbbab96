// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "messages.h"
#include "../text.h"

using namespace contactx;
using namespace contactx::problem;
using solve::Verdict;

std::string contactx::problem::failure_of(Verdict verdict, double moved)
{
  switch (verdict)
  {
  case Verdict::frozen_pair_penetrates:
    return "pairs went back and forth between facets and were frozen, and hide "
           "a penetration: refine the coarser surface there, swap slave and "
           "master where that is the slave, or take smaller load steps "
           "(manual: errors/frozen-pairs)";
  case Verdict::unbounded_motion:
    return "a body that nothing holds has moved by " + number_text(moved, 3)
           + ", more than the size of the scene: no place was found where the "
             "forces of contact balance. Support it. Where a ring can turn in "
             "another one, take method=\"surface-to-surface\", or numbers of "
             "facets that are no multiples of each other (manual: "
             "errors/body-ran-away)";
  case Verdict::large_rotation:
    return "a body that nothing holds has turned by " + number_text(moved, 3)
           + " degrees, which linear strains take for a stretch. Support it, "
             "or take a material with finite strains (manual: "
             "errors/body-turned)";
  case Verdict::unbalanced:
    return "the loads on a body cannot be balanced: it has no support and "
           "nothing is in its way, or friction barely could. Support it, turn "
           "the loads so that they press the bodies together, or take smaller "
           "load steps where friction has to hold it (manual: "
           "errors/unbalanced-loads)";
  case Verdict::not_finite:
    return "the residual is not finite: the material fails, or a body is free "
           "to move without touching anything. Take smaller load steps, or "
           "support the body (manual: errors/residual-not-finite)";
  case Verdict::stuck:
    return "no step is short enough to lead on: cells would turn inside out, "
           "or the residual does not fall. Take smaller load steps (manual: "
           "errors/no-step-leads-on)";
  case Verdict::goes_on:
  case Verdict::solution:
    break;
  }
  return {};
}

std::string contactx::problem::no_convergence(std::string_view count,
                                              std::string_view limit,
                                              bool is_homogeneous)
{
  const std::string_view advice
      = is_homogeneous
            ? "smaller load steps would not help, as this step from rest, of "
              "linear bodies without gaps, is the same for any size of its "
              "load: take what presses the bodies together first and what "
              "shears them afterwards, swap slave and master, take the other "
              "method, or meshes that match or are finer where nodes still "
              "change their status at the end; else raise "
            : "take smaller load steps; where nodes still change their status "
              "at the end, refine the mesh in contact, else raise ";
  std::string text = "no convergence in ";
  text.append(count).append(" iterations: ").append(advice).append(limit);
  return text + " (manual: errors/no-convergence)";
}

std::string contactx::problem::loose_bodies(std::int64_t count,
                                            const std::string& place)
{
  return "; " + std::to_string(count)
         + (count == 1 ? " body is loose, around "
                       : " bodies are loose, one of them around ")
         + place
         + ": supports, weak springs, friction or contact from the start "
           "(adjust=, a small overlap by offset=) hold what is loose (manual: "
           "errors/loose-bodies)";
}

std::string contactx::problem::held_bodies(std::int64_t motions, double force)
{
  return "nothing but the corners between facets resists "
         + std::to_string(motions)
         + " motions of bodies without supports, and contact without friction "
           "does not balance there: the bodies are held where they are, by "
         + number_text(100 * force, 2)
         + " % of the contact forces. Where they lie matters little if that is "
           "little; else give friction, support them, or refine the meshes "
           "(manual: errors/held-motions)";
}
