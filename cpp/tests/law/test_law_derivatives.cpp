// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "node_states.h"
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::tests;
using law::NodeState;

namespace
{
/// Entry (i, j) of a derivative at each node against central differences.
///
/// @param[in] evaluate Evaluates the law at a changed state.
/// @param[in] values What is changed, `width` values a node.
/// @param[in] derivative As the law has it (shape=(n, size, width)).
void expect_differences(const NodeState& nodes,
                        const std::function<std::vector<double>()>& evaluate,
                        std::vector<double>& values, std::size_t width,
                        const std::vector<double>& derivative, const char* name)
{
  const std::size_t n = nodes.num_nodes(), size = nodes.size();
  const double h = 1e-5;
  ASSERT_EQ(values.size(), n * width);
  ASSERT_EQ(derivative.size(), n * size * width);
  double largest = 1;
  for (double d : derivative)
    largest = std::max(largest, std::abs(d));
  for (std::size_t j = 0; j < width; ++j)
  {
    // All nodes at once: each has its own function
    const auto before = values;
    const auto at = [&](double step)
    {
      for (std::size_t i = 0; i < n; ++i)
        values[width * i + j] = before[width * i + j] + step;
      return evaluate();
    };
    const auto plus = at(h), minus = at(-h);
    values = before;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < size; ++k)
      {
        const std::size_t row = size * i + k;
        EXPECT_NEAR(derivative[width * row + j],
                    (plus[row] - minus[row]) / (2 * h), 1e-7 * largest)
            << name << ", node " << i << ", row " << k << ", column " << j;
      }
  }
}

/// Friction that grows less than the pressure, and weakens with slip.
law::Bounds weakening(std::span<const double> pressure,
                      std::span<const double> slip)
{
  law::Bounds found;
  for (std::size_t i = 0; i < pressure.size(); ++i)
  {
    const double p = pressure[i], weak = std::exp(-slip[i]);
    found.bound.push_back((0.2 + 0.5 * weak) * std::log1p(p));
    found.by_pressure.push_back((0.2 + 0.5 * weak) / (1 + p));
    found.by_slip.push_back(-0.5 * weak * std::log1p(p));
  }
  return found;
}

/// A law with random coefficients of friction where it has some.
std::unique_ptr<law::Law> law_of(const std::string& name, int n,
                                 Generator& random)
{
  if (name == "frictionless")
    return std::make_unique<law::Frictionless>();
  if (name == "tied")
    return std::make_unique<law::Tied>();
  if (name == "weakening")
    return std::make_unique<law::Coulomb>(weakening);
  auto coulomb = std::make_unique<law::Coulomb>();
  std::vector<double> friction = random.numbers(n, 0.1, 1.2);
  coulomb->set_friction(friction);
  return coulomb;
}

class LawDerivatives : public testing::TestWithParam<int>
{
protected:
  static constexpr int n = 200;
};

TEST_P(LawDerivatives, AreDifferencesOfTheValue)
{
  const int gdim = GetParam();
  Generator random(11);
  for (const std::string name :
       {"frictionless", "frictional", "tied", "weakening"})
  {
    SCOPED_TRACE(name);
    const auto law = law_of(name, n, random);
    EXPECT_EQ(law->name(), name == "weakening" ? "frictional" : name);
    NodeState nodes(n, gdim, law->is_vector());
    randomise(nodes, random);
    nodes.frictionless[5] = nodes.frictionless[7] = nodes.frictionless[9] = 1;
    const auto evaluate = [&]
    {
      law->evaluate(nodes);
      return nodes.value;
    };
    evaluate();
    const auto by_multiplier = nodes.by_multiplier, by_gap = nodes.by_gap,
               by_slip = nodes.by_slip, by_normal = nodes.by_normal;
    const std::size_t size = nodes.size();
    expect_differences(nodes, evaluate, nodes.multiplier, size, by_multiplier,
                       "multiplier");
    expect_differences(nodes, evaluate, nodes.gap, 1, by_gap, "gap");
    if (not law->is_vector())
      continue;
    expect_differences(nodes, evaluate, nodes.slip, size, by_slip, "slip");
    expect_differences(nodes, evaluate, nodes.normal, size, by_normal,
                       "normal");
  }
}

TEST_P(LawDerivatives, OfMeansAreThoseByMeanAndMovement)
{
  const std::size_t gdim = GetParam();
  Generator random(12);
  const auto law = law_of("frictional", n, random);
  NodeState nodes(n, gdim, true, true);
  randomise(nodes, random);
  // Means are shorter than one
  auto mean = nodes.normal, movement = nodes.slip;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = gdim * i; k < gdim * (i + 1); ++k)
      mean[k] *= 0.6 + 0.4 * i / n;
  const std::vector<double> origin(n * gdim, 0.01);
  const auto evaluate = [&]
  {
    nodes.normal = mean;
    nodes.slip = movement;
    nodes.normalise();
    nodes.project(origin);
    law->evaluate(nodes);
    return nodes.value;
  };
  evaluate();
  const auto by_movement = nodes.by_slip, by_mean = nodes.by_normal;
  expect_differences(nodes, evaluate, movement, gdim, by_movement, "movement");
  expect_differences(nodes, evaluate, mean, gdim, by_mean, "mean");
}

TEST_P(LawDerivatives, OfTiesTakeEachComponentOnItsOwn)
{
  const std::size_t gdim = GetParam();
  NodeState nodes(2, gdim, true);
  nodes.status[0] = law::stick;
  for (std::size_t i = 0; i < 2; ++i)
  {
    set_upright(nodes, i, 3, 5, 0, 0.25);
    nodes.area[i] = 2;
  }
  nodes.slip[gdim - 1] = 0.5;
  nodes.mobile[0] = 0;
  const law::Tied law;
  law.evaluate(nodes);
  std::vector<double> expected(2 * gdim, 0.0);
  // A lambda where it cannot move, A c s along the normal, and A lambda of the
  // open node
  expected[0] = 2 * 5;
  expected[gdim - 1] = 2 * 8 * 0.5;
  expected[gdim] = 2 * 5;
  expected[2 * gdim - 1] = 2 * 3;
  EXPECT_EQ(nodes.value, expected);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, LawDerivatives, testing::Values(2, 3));
} // namespace
