// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "spring_bodies.h"
#include <contactx/contact/contact_state.h>
#include <contactx/problem/problem.h>

namespace contactx::tests
{
/// Friction and offset of all nodes.
struct GivenValues final : contactx::problem::Values
{
  bool vary() const override { return varies; }
  std::optional<std::vector<double>> friction() override
  {
    ++reads;
    if (not coefficient)
      return std::nullopt;
    return std::vector<double>(count, *coefficient);
  }
  std::vector<double> offset() override
  {
    return std::vector<double>(count, length);
  }

  bool varies = true;
  int reads = 0;
  std::size_t count = 0;
  std::optional<double> coefficient;
  double length = 0;
};

/// Bodies of springs in a step with dense algebra.
struct Stepped : SpringBodies
{
  using SpringBodies::SpringBodies;

  /// Once contacts and Dirichlet conditions are there.
  contactx::problem::Problem& problem(bool refuses = true)
  {
    if (not made)
    {
      std::vector<contactx::problem::Part> parts;
      for (const auto& contact : contacts)
      {
        given.push_back(std::make_shared<GivenValues>());
        given.back()->count = contact->nodes()->num_nodes();
        if (contact->law()->is_vector())
          given.back()->coefficient = 0.3;
        std::shared_ptr<results::Results> shown;
        if (has_results)
          shown = results_of.emplace_back(
              std::make_shared<results::Results>(contact));
        parts.push_back({"contact 0 (of sheets)", given.back(), shown});
      }
      made.emplace(system(), bodies(), std::move(parts), refuses);
    }
    return *made;
  }

  void advance()
  {
    solve::System& system = *problem().system();
    std::vector<double> b(system.size());
    system.residual(b);
    std::vector<double> dx = solution(matrix(), b);
    for (double& value : dx)
      value = -value;
    problem().update(dx, problem().limit(dx));
  }

  /// Jacobian by the unknowns, which are lengths.
  Eigen::MatrixXd matrix()
  {
    return jacobian(*problem().system(),
                    problem().loop().free_bodies().springs());
  }

  /// Iterate until a solution is found, or none is to be expected.
  const contactx::problem::Settled& iterate(int max_it = 30)
  {
    while (true)
    {
      const contactx::problem::Settled& found
          = problem().settle(1e-12, 0, max_it);
      if (found.converged or not found.failure.empty())
        return found;
      advance();
    }
  }

  const contactx::problem::Settled& solve(int max_it = 30)
  {
    problem().begin_step();
    return iterate(max_it);
  }

  /// All that a failed step must leave as it was.
  std::vector<std::vector<contact::Saved>> state() const
  {
    std::vector<std::vector<contact::Saved>> all{
        {{"u", contact::RowKind::node, 0, *scene.u}}};
    for (const auto& contact : contacts)
      all.push_back(contact::save(*contact));
    return all;
  }

  std::optional<contactx::problem::Problem> made;
  std::vector<std::shared_ptr<GivenValues>> given;
  bool has_results = false; ///< whether contacts have results
  std::vector<std::shared_ptr<results::Results>> results_of;
};

class DenseSolver final : public contactx::problem::LinearSolver
{
public:
  explicit DenseSolver(Stepped& bodies) : _bodies(&bodies) {}

  void update() override { _J = _bodies->matrix(); }
  void solve(std::span<const double> b, std::span<double> x) override
  {
    ++solves;
    std::ranges::copy(solution(_J, b), x.begin());
  }

  int solves = 0;

private:
  Stepped* _bodies;
  Eigen::MatrixXd _J;
};
} // namespace contactx::tests
