// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "thread_ranks.h"
#include <contactx/solve/balance_guard.h>
#include <contactx/solve/cycle_guard.h>
#include <contactx/solve/frozen_pairs.h>
#include <set>

using contactx::contact::HiddenGap;
using namespace contactx;
using namespace contactx::solve;
using namespace contactx::tests;
using contact::HiddenGap;

namespace
{
/// A guard that has seen a number of unbalanced iterates with settled status.
BalanceGuard after(int count)
{
  BalanceGuard guard;
  for (int i = 0; i < count; ++i)
    EXPECT_FALSE(guard.note(true, 0));
  return guard;
}

TEST(BalanceGuard, GivesUpAfterTenIteratesWithSettledStatus)
{
  BalanceGuard guard = after(BalanceGuard::max_iterates - 1);
  // One in which nodes change their status does not count, nor start anew
  EXPECT_FALSE(guard.note(true, 1));
  EXPECT_TRUE(guard.note(true, 0));
  EXPECT_TRUE(guard.note(true, 1));
  EXPECT_EQ(BalanceGuard::max_iterates, 10);
}

TEST(BalanceGuard, CountsAnewWhereForcesBalance)
{
  BalanceGuard guard = after(BalanceGuard::max_iterates - 1);
  EXPECT_FALSE(guard.note(false, 0));
  for (int i = 1; i < BalanceGuard::max_iterates; ++i)
    EXPECT_FALSE(guard.note(true, 0));
  EXPECT_TRUE(guard.note(true, 0));
  guard.begin_step();
  EXPECT_FALSE(guard.note(true, 0));
}

using Status = std::vector<std::int8_t>;

std::uint64_t alone(const std::vector<Status>& status)
{
  mesh::OneRank ranks;
  return fingerprint(ranks, {status.begin(), status.end()});
}

/// Number of the steps that are shortened before a full one.
int count_short(CycleGuard& guard)
{
  int count = 0;
  while (guard.shortens())
    ++count;
  return count;
}

TEST(Fingerprint, TellsStatusApart)
{
  // All of five nodes of two contacts, and of those with one node less
  std::set<std::uint64_t> seen;
  int num = 0;
  for (int code = 0; code < 243; ++code)
  {
    Status all;
    for (int k = 0, rest = code; k < 5; ++k, rest /= 3)
      all.push_back(static_cast<std::int8_t>(rest % 3));
    for (int first = 0; first <= 5; ++first)
    {
      seen.insert(alone({Status(all.begin(), all.begin() + first),
                         Status(all.begin() + first, all.end())}));
      ++num;
    }
  }
  EXPECT_EQ(std::ssize(seen), num);
}

TEST(Fingerprint, OfManyNodesChangesWithOneOfThem)
{
  Generator random(1);
  Status status(1003);
  for (auto& s : status)
    s = static_cast<std::int8_t>(random(0, 3));
  std::set<std::uint64_t> seen{alone({status})};
  for (auto& s : status)
  {
    const std::int8_t before = s;
    s = static_cast<std::int8_t>((s + 1) % 3);
    seen.insert(alone({status}));
    s = before;
  }
  EXPECT_EQ(seen.size(), status.size() + 1);
  EXPECT_TRUE(seen.contains(alone({status})));
  EXPECT_EQ(alone({}), 0xe220a8397b1dcdaf) << "the same on any machine";
}

TEST(Fingerprint, IsTheSameOnAllRanksAndKnowsWhoseStatusItIs)
{
  const std::vector<Status> status{{0, 1, 2, 2, 1}, {1, 1}, {}};
  const auto together = [&status](const std::vector<int>& order)
  {
    std::vector<std::uint64_t> found(3);
    on_ranks(3,
             [&](mesh::Ranks& rank)
             {
               const int r = rank.rank();
               found[r] = fingerprint(rank, {status[order[r]]});
             });
    EXPECT_EQ(found[0], found[1]);
    EXPECT_EQ(found[0], found[2]);
    return found[0];
  };
  const auto first = together({0, 1, 2});
  EXPECT_EQ(together({0, 1, 2}), first);
  EXPECT_NE(together({1, 0, 2}), first);
  EXPECT_NE(together({0, 2, 1}), first);
}

TEST(CycleGuard, LetsAStatusThatIsNewOrStaysConverge)
{
  CycleGuard guard;
  double residual = 1;
  for (std::uint64_t status = 0; status < 20; ++status)
    EXPECT_FALSE(guard.note(status, residual));
  // Ever so slowly
  for (int i = 0; i < 20; ++i)
    EXPECT_FALSE(guard.note(19, residual *= 0.99));
  // And even with a larger residual
  EXPECT_FALSE(guard.note(19, 10));
  EXPECT_EQ(guard.cycles(), 0);
  EXPECT_FALSE(guard.shortens());
}

TEST(CycleGuard, AStatusThatComesBackWithoutHalfTheResidualIsACycle)
{
  for (double residual : {0.49, 0.51, 3.})
  {
    CycleGuard guard;
    EXPECT_FALSE(guard.note(1, 4));
    EXPECT_FALSE(guard.note(1, 1));
    EXPECT_FALSE(guard.note(2, 1));
    EXPECT_EQ(guard.note(1, residual), residual > 0.5);
    EXPECT_EQ(guard.cycles(), residual > 0.5);
    EXPECT_EQ(count_short(guard), residual > 0.5 ? 2 : 0);
  }
}

TEST(CycleGuard, TheSameResidualOfAStatusThatStaysIsACycle)
{
  CycleGuard guard;
  EXPECT_FALSE(guard.note(1, 2));
  EXPECT_FALSE(guard.note(1, 1));
  EXPECT_FALSE(guard.note(1, 1.0011));
  // Slip that turns to and fro has two residuals by turns
  EXPECT_TRUE(guard.note(1, 2.0019));
}

TEST(CycleGuard, ShortensMoreStepsEachTimeAndForgetsWhatWasBefore)
{
  CycleGuard guard;
  for (int cycle = 1; cycle <= 4; ++cycle)
  {
    EXPECT_FALSE(guard.note(1, 1));
    EXPECT_FALSE(guard.note(2, 1));
    EXPECT_TRUE(guard.note(1, 1));
    EXPECT_EQ(guard.cycles(), cycle);
    EXPECT_EQ(count_short(guard), 1 + cycle);
    // To begin with the other status
    EXPECT_FALSE(guard.note(3, 1));
  }
  guard.begin_step();
  EXPECT_EQ(guard.cycles(), 0);
  EXPECT_FALSE(guard.note(1, 1));
}

TEST(CycleGuard, AShortenedStepIsNoCycle)
{
  CycleGuard guard;
  EXPECT_FALSE(guard.note(1, 1));
  EXPECT_FALSE(guard.note(2, 1));
  EXPECT_TRUE(guard.note(1, 1));
  EXPECT_TRUE(guard.shortens());
  // One more is to be shortened, whatever comes back meanwhile
  EXPECT_FALSE(guard.note(2, 1));
  EXPECT_FALSE(guard.note(1, 1));
  EXPECT_FALSE(guard.note(2, 1));
  EXPECT_EQ(guard.cycles(), 1);
  EXPECT_TRUE(guard.shortens());
  EXPECT_FALSE(guard.shortens());
  EXPECT_TRUE(guard.note(1, 1));
  EXPECT_EQ(guard.cycles(), 2);
}

TEST(CycleGuard, LeadsOutOfACycleOfNewton)
{
  // A function that jumps at zero: Newton goes from -1 to 2 and back for ever
  const auto f = [](double x) { return x > 0 ? x + 1 : x - 2; };
  const auto status = [](double x) { return std::uint64_t(x > 0); };
  EXPECT_EQ(5 - f(5.), -1);
  EXPECT_EQ(-1 - f(-1.), 2);
  EXPECT_EQ(2 - f(2.), -1);
  CycleGuard guard;
  double x = 5;
  guard.note(status(x), std::abs(f(x)));
  bool has_left = false;
  for (int i = 0; i < 10; ++i)
  {
    const double last = x;
    x -= f(x);
    if (guard.shortens())
      x = last + CycleGuard::step_fraction * (x - last);
    has_left |= x != 2 and x != -1;
    guard.note(status(x), std::abs(f(x)));
  }
  EXPECT_GT(guard.cycles(), 0);
  EXPECT_TRUE(has_left);
}

TEST(CycleGuard, AResidualThatIsNoNumberIsNoCycle)
{
  CycleGuard guard;
  const double none = std::nan("");
  EXPECT_FALSE(guard.note(1, 1));
  EXPECT_FALSE(guard.note(2, none));
  EXPECT_FALSE(guard.note(2, none));
  EXPECT_FALSE(guard.note(1, none));
}

TEST(FrozenPairs, HideAsMuchAsTheMeshExplains)
{
  mesh::OneRank alone;
  const std::vector<HiddenGap> few{{-0.5, -0.029}, {0, 0}};
  const HiddenPenetration shallow = hidden_penetration(alone, few);
  EXPECT_FALSE(shallow.is_deep);
  EXPECT_EQ(shallow.gaps, (std::vector<double>{-0.5, 0}));
  // The part of an edge counts, in any of the contacts
  const std::vector<HiddenGap> more{{-0.5, -0.029}, {-1e-3, -0.031}};
  const HiddenPenetration deep = hidden_penetration(alone, more);
  EXPECT_TRUE(deep.is_deep);
  EXPECT_EQ(deep.gaps, (std::vector<double>{-0.5, -1e-3}));
  EXPECT_FALSE(hidden_penetration(alone, {}).is_deep);
}

TEST(FrozenPairs, OfAnyRankCount)
{
  on_ranks(3,
           [](mesh::Ranks& rank)
           {
             std::vector<HiddenGap> found{{0, 0}, {-0.1, -0.01}};
             EXPECT_FALSE(hidden_penetration(rank, found).is_deep);
             if (rank.rank() == 1)
               found[0] = {-0.2, -0.04};
             const HiddenPenetration all = hidden_penetration(rank, found);
             EXPECT_TRUE(all.is_deep);
             EXPECT_EQ(all.gaps, (std::vector<double>{-0.2, -0.1}));
           });
}

} // namespace
