// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "asperities.h"
#include "thread_ranks.h"
#include <contactx/law/conductance_coefficient.h>
#include <contactx/math/vec.h>

using namespace contactx;
using namespace contactx::law;
using tests::asperities;
using tests::expect_refusal;
using tests::on_ranks;

namespace
{
constexpr double undefined = std::nan("");

law::Gradient slopes(std::span<const double> p, std::span<const double> gap)
{
  law::Gradient result;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    result.by_pressure.push_back(6 * p[i]);
    result.by_gap.push_back(-0.5 / 0.2 / std::pow(1 + gap[i] / 0.2, 2));
  }
  return result;
}

TEST(Coefficient, IsANumber)
{
  const std::vector<double> p{1, 0, 3}, gap{0, 0.1, 0};
  const law::Coefficient h(2.5);
  EXPECT_EQ(h.values(p, gap), std::vector<double>(3, 2.5));
  mesh::OneRank ranks;
  const law::Gradient gradient = h.gradient(p, gap, ranks);
  EXPECT_EQ(gradient.by_pressure, std::vector<double>(3, 0));
  EXPECT_EQ(gradient.by_gap, std::vector<double>(3, 0));
}

TEST(Coefficient, TakesNegativePressuresAndGapsForZero)
{
  const law::Coefficient h(asperities, slopes);
  const std::vector<double> p{-2, 1, -3}, gap{0.1, -0.3, -0.1};
  const std::vector<double> q{0, 1, 0}, open{0.1, 0, 0};
  EXPECT_EQ(h.values(p, gap), asperities(q, open));
  mesh::OneRank ranks;
  const law::Gradient gradient = h.gradient(p, gap, ranks);
  EXPECT_EQ(gradient.by_pressure, slopes(q, open).by_pressure);
  EXPECT_EQ(gradient.by_gap, slopes(q, open).by_gap);
}

TEST(Coefficient, DifferencesAreTheGradient)
{
  const std::vector<double> p{0.3, 2, 0.7, 1.1}, gap{0.1, 0.02, 0.3, 0.25};
  mesh::OneRank ranks;
  const law::Gradient given
      = law::Coefficient(asperities, slopes).gradient(p, gap, ranks);
  const law::Gradient found
      = law::Coefficient(asperities).gradient(p, gap, ranks);
  tests::expect_near(found.by_pressure, given.by_pressure, 1e-7);
  tests::expect_near(found.by_gap, given.by_gap, 1e-7);
  // From the right where there is nothing to the left
  const std::vector<double> touching{0, -0.1, 0.3, 0.25};
  const std::vector<double> opening{0, 0, 0.3, 0.25};
  tests::expect_near(
      Coefficient(asperities).gradient(p, touching, ranks).by_gap,
      slopes(p, opening).by_gap, 1e-5);
  // With no pressure anywhere there is no scale for a step
  const std::vector<double> none(4, -1);
  EXPECT_EQ(law::Coefficient(asperities).gradient(none, gap, ranks).by_pressure,
            std::vector<double>(4, 0));
}

/// A rank without nodes never calls the function; steps are those of all ranks.
TEST(Coefficient, DifferencesAreThoseOfAllRanks)
{
  const std::vector<double> p{0.3, 2, 0.7}, gap{0.1, 0.02, 0.3};
  mesh::OneRank alone;
  const law::Gradient all
      = law::Coefficient(asperities).gradient(p, gap, alone);
  const auto work = [&](mesh::Ranks& ranks)
  {
    const law::Coefficient h(
        [&](auto pressures, auto gaps)
        {
          EXPECT_FALSE(pressures.empty());
          return asperities(pressures, gaps);
        });
    const std::size_t first = ranks.rank() == 0 ? 0 : 1;
    const std::size_t count = ranks.rank() == 0 ? 1 : ranks.rank() == 1 ? 0 : 2;
    const auto q = std::span(p).subspan(first, count);
    const auto g = std::span(gap).subspan(first, count);
    EXPECT_EQ(h.values(q, g).size(), count);
    const law::Gradient here = h.gradient(q, g, ranks);
    for (std::size_t i = 0; i < count; ++i)
    {
      EXPECT_EQ(here.by_pressure[i], all.by_pressure[first + i]);
      EXPECT_EQ(here.by_gap[i], all.by_gap[first + i]);
    }
  };
  on_ranks(3, work);
}

TEST(Coefficient, RefusesWhatCannotBe)
{
  for (const double value : {-1., undefined, infinity})
  {
    expect_refusal([&] { law::Coefficient h(value); }, "of at least 0");
    const law::Coefficient h([&](auto p, auto)
                             { return std::vector<double>(p.size(), value); });
    expect_refusal([&] { (void)h.values(std::vector{1.}, std::vector{0.}); },
                   "negative or not finite");
  }
  expect_refusal([] { law::Coefficient h{law::Function()}; }, "is empty");
  const std::vector<double> p{1, 2}, gap{0, 0.1};
  const law::Coefficient few([](auto, auto)
                             { return std::vector<double>(3, 1); });
  expect_refusal([&] { (void)few.values(p, gap); },
                 "returned 3 values for 2 nodes");
  expect_refusal([&] { (void)few.values(p, std::vector{1.}); }, "gap");
  // Pressures that are not finite have no coefficient
  const law::Coefficient any(asperities);
  expect_refusal([&] { (void)any.values(std::vector{undefined, 1.}, gap); },
                 "not finite");
  mesh::OneRank ranks;
  const law::Coefficient steep(
      asperities,
      [](auto, auto) { return law::Gradient{{1, undefined}, {0, 0}}; });
  expect_refusal([&] { (void)steep.gradient(p, gap, ranks); },
                 "a derivative of the coefficient");
  const law::Coefficient half(asperities, [](auto, auto)
                              { return law::Gradient{{1, 1}, {0}}; });
  expect_refusal([&] { (void)half.gradient(p, gap, ranks); },
                 "returned 1 values");
}

TEST(Coefficient, IsRefusedOnAllRanks)
{
  on_ranks(2,
           [&](mesh::Ranks& ranks)
           {
             const bool bad = ranks.rank() == 1;
             const law::Coefficient h(
                 [&](auto p, auto)
                 { return std::vector<double>(p.size(), bad ? -1 : 1); });
             const std::vector<double> p{1}, gap{0.1};
             expect_refusal([&] { (void)h.gradient(p, gap, ranks); },
                            "negative or not finite");
           });
}
} // namespace
