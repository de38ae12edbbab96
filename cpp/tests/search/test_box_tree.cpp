// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "generator.h"
#include <contactx/search/box.h>
#include <contactx/search/box_tree.h>
#include <set>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
TEST(Box, EmptyOneIsInfinitelyFar)
{
  EXPECT_TRUE(std::isinf(Box::empty().distance2({1, 2, 3})));
}

TEST(Box, DistanceFromEachSide)
{
  Box b = Box::empty();
  b.add(Vector<3>{0, 0, 0});
  b.add(Vector<3>{1, 2, 3});
  EXPECT_EQ(b.distance2({0.5, 1, 1}), 0);
  EXPECT_EQ(b.distance2({1, 2, 3}), 0);
  EXPECT_EQ(b.distance2({-2, 1, 1}), 4);
  EXPECT_EQ(b.distance2({3, 1, 1}), 4);
  EXPECT_EQ(b.distance2({0.5, 5, 5}), 13);
  EXPECT_EQ(b.distance2({-1, -2, -3}), 14);
}

TEST(Box, IsNoFartherThanWhatItHolds)
{
  Generator random(1);
  for (int i = 0; i < 200; ++i)
  {
    Box a = Box::empty(), b = Box::empty();
    const Vector<3> p = random.vector<3>(-1, 1), q = random.vector<3>(-1, 1);
    a.add(p);
    b.add(q);
    b.add(a);
    const Vector<3> point = random.vector<3>(-2, 2);
    EXPECT_LE(b.distance2(point), dot(p - point, p - point));
    EXPECT_LE(b.distance2(point), dot(q - point, q - point));
  }
}

TEST(Box, PassesOverPointsThatAreNotNumbers)
{
  Box b = Box::empty();
  b.add(Vector<3>{0, 0, 0});
  b.add(Vector<3>{std::nan(""), 1, 0});
  EXPECT_EQ(b.distance2({0, 2, 0}), 1);
}

std::vector<Box> random_boxes(Generator& random, int n)
{
  std::vector<Box> boxes(n, Box::empty());
  for (Box& b : boxes)
  {
    const Vector<3> p = random.vector<3>(-1, 1);
    b.add(p);
    b.add(p + random.vector<3>(-0.1, 0.1));
  }
  return boxes;
}

/// The items that the tree visits for a bound that stays.
std::multiset<std::int32_t> visited(const BoxTree& tree, const Vector<3>& p,
                                    double bound2)
{
  std::multiset<std::int32_t> items;
  tree.nearest(p, bound2, [&items](std::int32_t i) { items.insert(i); });
  return items;
}

void expect_all_below(const BoxTree& tree, std::span<const Box> boxes,
                      const Vector<3>& p, double bound2)
{
  const auto items = visited(tree, p, bound2);
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    EXPECT_LE(items.count(i), 1u);
    if (boxes[i].distance2(p) <= bound2)
    {
      EXPECT_EQ(items.count(i), 1u);
    }
  }
}

TEST(BoxTree, VisitsEachBoxBelowTheBoundOnce)
{
  Generator random(1);
  for (int n : {1, 2, 4, 5, 9, 100, 1000})
    for (int i = 0; i < 20; ++i)
    {
      auto boxes = random_boxes(random, n);
      // Some are empty, or have moved anywhere else
      for (int k = 0; i % 4 == 0 and k < n; k += 3)
        boxes[k] = Box::empty();
      BoxTree tree(boxes);
      if (i % 2)
      {
        boxes = random_boxes(random, n);
        tree.refit(boxes);
      }
      expect_all_below(tree, boxes, random.vector<3>(-2, 2), random(0, 2));
      EXPECT_TRUE(visited(tree, {9, 9, 9}, 1).empty());
    }
}

TEST(BoxTree, VisitsABoxOnTheBound)
{
  std::vector<Box> boxes;
  for (int i = 0; i < 40; ++i)
    boxes.push_back({{double(i % 2), 0, 0}, {double(i % 2), 0, 0}});
  EXPECT_EQ(visited(BoxTree(boxes), {-1, 0, 0}, 1).count(0), 1u);
  expect_all_below(BoxTree(boxes), boxes, {-1, 0, 0}, 1);
  expect_all_below(BoxTree(boxes), boxes, {-1, 0, 0}, 4);
}

TEST(BoxTree, PassesOverWhatIsFar)
{
  Generator random(2);
  const auto boxes = random_boxes(random, 10000);
  EXPECT_LT(visited(BoxTree(boxes), {0, 0, 0}, 1e-4).size(), 200u);
  EXPECT_TRUE(visited(BoxTree(boxes), {9, 9, 9}, 1).empty());
}

TEST(BoxTree, LooksAtFewBoxesForTheNearest)
{
  Generator random(3);
  const auto boxes = random_boxes(random, 10000);
  const BoxTree tree(boxes);
  const Vector<3> p{5, 0.1, 0.2};
  double bound2 = 1e9;
  int looked_at = 0;
  tree.nearest(p, bound2,
               [&boxes, &bound2, &looked_at, &p](std::int32_t i)
               {
                 ++looked_at;
                 bound2 = std::min(bound2, boxes[i].distance2(p));
               });
  double expected = 1e9;
  for (const Box& b : boxes)
    expected = std::min(expected, b.distance2(p));
  EXPECT_EQ(bound2, expected);
  EXPECT_LT(looked_at, 500);
}

TEST(BoxTree, WithoutBoxesVisitsNothing)
{
  BoxTree tree({});
  EXPECT_TRUE(visited(tree, {0, 0, 0}, 1e9).empty());
  EXPECT_NO_THROW(tree.refit({}));
}

TEST(BoxTree, TakesEmptyBoxes)
{
  const std::vector<Box> none(20, Box::empty());
  EXPECT_TRUE(visited(BoxTree(none), {0, 0, 0}, 1e9).empty());
}

TEST(BoxTree, TakesEqualBoxes)
{
  const std::vector<Box> boxes(5000, Box{{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(visited(BoxTree(boxes), {2, 0, 0}, 1).size(), 5000u);
}

bool meet(const Box& a, const Box& b)
{
  for (int k = 0; k < 3; ++k)
    if (not(a.lower[k] <= b.upper[k] and b.lower[k] <= a.upper[k]))
      return false;
  return true;
}

/// The items whose boxes meet a box, with the number of boxes looked at.
std::pair<std::multiset<std::int32_t>, int> met(const BoxTree& tree,
                                                const Box& box)
{
  std::multiset<std::int32_t> items;
  int looked_at = 0;
  tree.for_each(
      [&](const Box& b)
      {
        ++looked_at;
        return meet(b, box);
      },
      [&items](std::int32_t i) { items.insert(i); });
  return {items, looked_at};
}

TEST(BoxTree, ForEachVisitsEachBoxThatMattersOnce)
{
  Generator random(7);
  for (int n : {1, 2, 4, 5, 9, 100, 1000})
    for (int i = 0; i < 20; ++i)
    {
      auto boxes = random_boxes(random, n);
      if (i % 4 == 0)
        boxes[n / 2] = Box::empty();
      BoxTree tree(boxes);
      if (i % 2)
      {
        boxes = random_boxes(random, n);
        tree.refit(boxes);
      }
      Box box = Box::empty();
      const Vector<3> p = random.vector<3>(-1, 1);
      box.add(p);
      box.add(p + random.vector<3>(-1, 1));
      std::multiset<std::int32_t> expected;
      for (int j = 0; j < n; ++j)
        if (meet(boxes[j], box))
          expected.insert(j);
      EXPECT_EQ(met(tree, box).first, expected);
    }
}

TEST(BoxTree, ForEachPassesOverWhatDoesNotMatter)
{
  Generator random(8);
  const auto boxes = random_boxes(random, 10000);
  const BoxTree tree(boxes);
  const auto [items, looked_at] = met(tree, {{0, 0, 0}, {0.05, 0.05, 0.05}});
  EXPECT_FALSE(items.empty());
  EXPECT_LT(looked_at, 1000);
  EXPECT_EQ(met(tree, {{9, 9, 9}, {10, 10, 10}}).second, 1);
  EXPECT_EQ(met(BoxTree({}), {{0, 0, 0}, {1, 1, 1}}).second, 0);
}

TEST(BoxTree, RefitNeedsAsManyBoxes)
{
  Generator random(6);
  BoxTree tree(random_boxes(random, 7));
  EXPECT_REFUSED(tree.refit(random_boxes(random, 6)));
  EXPECT_REFUSED(tree.refit(random_boxes(random, 8)));
  EXPECT_REFUSED(tree.refit({}));
}
} // namespace
