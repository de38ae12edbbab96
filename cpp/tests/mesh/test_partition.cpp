// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "thread_ranks.h"
#include <cmath>
#include <contactx/mesh/partition.h>

using namespace contactx;

namespace
{
/// A block on another one that is larger: grids of `2 n` cells along each axis
/// of the lower one and `n` of the upper one, which touch at height zero.
struct Stack
{
  Stack(int gdim, int n) : gdim(gdim), width(1 << gdim)
  {
    add(2 * n, -1, -1);
    add(n, -0.5, 0);
  }

  void add(int n, double corner, double bottom)
  {
    const auto first = static_cast<std::int64_t>(at_contact.size());
    const int deep = gdim == 3 ? n + 1 : 1;
    for (int k = 0; k < deep; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
        {
          const double step = -2 * corner / n, height = bottom + step / 2 * j;
          x.push_back(corner + step * i);
          if (gdim == 3)
            x.push_back(corner + step * k);
          x.push_back(height);
          at_contact.push_back(
              std::abs(height) < 1e-9 and std::abs(corner + step * i) < 0.6
              and (gdim == 2 or std::abs(corner + step * k) < 0.6));
        }
    for (int k = 0; k < std::max(deep - 1, 1); ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          for (int v = 0; v < width; ++v)
            cells.push_back(
                first + ((k + (v >> 2)) * (n + 1) + j + (v >> 1 & 1)) * (n + 1)
                + i + (v & 1));
  }

  /// Parts of all cells; each rank gives a share of cells and nodes.
  std::vector<std::int32_t> parts(mesh::Ranks& ranks, int count) const
  {
    const auto share = [&](std::size_t n, std::size_t size)
    {
      const std::size_t begin = n * ranks.rank() / ranks.size(),
                        end = n * (ranks.rank() + 1) / ranks.size();
      return std::pair(begin * size, (end - begin) * size);
    };
    const auto [cell, num_cells] = share(cells.size() / width, width);
    const auto [at, num_x] = share(at_contact.size(), gdim);
    const auto [mark, num_marks] = share(at_contact.size(), 1);
    const std::vector<std::int32_t> mine = mesh::parts_with_contact(
        ranks, std::span(cells).subspan(cell, num_cells), width,
        {std::span(x).subspan(at, num_x), gdim,
         std::span(at_contact).subspan(mark, num_marks)},
        count);
    return mesh::gathered(ranks, std::span<const std::int32_t>(mine));
  }

  int gdim, width;
  std::vector<double> x;
  std::vector<std::int8_t> at_contact;
  std::vector<std::int64_t> cells;
};

TEST_2D_3D(Partition, PartsHaveAsManyCellsAndAsMuchContact, gdim)
{
  const Stack stack(gdim, gdim == 2 ? 128 : 16);
  const std::size_t n = stack.cells.size() / stack.width;
  for (const int count : {1, 2, 3, 4})
  {
    mesh::OneRank alone;
    const std::vector<std::int32_t> parts = stack.parts(alone, count);
    std::vector<double> cells(count), contact(count);
    double all = 0;
    for (std::size_t c = 0; c < n; ++c)
    {
      cells[parts[c]] += 1;
      for (int v = 0; v < stack.width; ++v)
        contact[parts[c]] += stack.at_contact[stack.cells[c * stack.width + v]];
    }
    for (const double part : contact)
      all += part;
    for (int part = 0; part < count; ++part)
    {
      EXPECT_NEAR(cells[part] * count / n, 1, 0.01);
      // Lines cannot be turned as far, and thirds have no turn for sure
      EXPECT_NEAR(contact[part] * count / all, 1,
                  gdim == 3 and count != 3 ? 0.1 : 0.3);
    }
    // Sums over ranks may round differently, next to a plane
    for (const int size : {2, 3})
      tests::on_ranks(size,
                      [&](mesh::Ranks& ranks)
                      {
                        const auto found = stack.parts(ranks, count);
                        std::size_t others = 0;
                        for (std::size_t c = 0; c < n; ++c)
                          others += found[c] != parts[c];
                        EXPECT_LE(others, n / 1000);
                      });
  }
}

TEST_2D_3D(Partition, CellsAloneAreSharedWithoutContact, gdim)
{
  Stack stack(gdim, 8);
  std::ranges::fill(stack.at_contact, 0);
  mesh::OneRank alone;
  const std::vector<std::int32_t> parts = stack.parts(alone, 3);
  for (const int part : {0, 1, 2})
    EXPECT_NEAR(3.0 * std::ranges::count(parts, part) / parts.size(), 1, 0.02);
}

TEST(Partition, PlanesInSpaceAreCutAsInThePlane)
{
  const Stack plane(2, 32);
  Stack space(2, 32);
  space.gdim = 3;
  space.x.clear();
  for (std::size_t i = 0; i < plane.x.size(); i += 2)
    space.x.insert(space.x.end(), {plane.x[i], plane.x[i + 1], 0.7});
  mesh::OneRank alone;
  const auto expected = plane.parts(alone, 2), found = space.parts(alone, 2);
  std::size_t equal = 0;
  for (std::size_t c = 0; c < found.size(); ++c)
    equal += found[c] == expected[c];
  // Axes have no sense of their own: the parts may have changed places
  EXPECT_GE(std::max(equal, found.size() - equal), 0.99 * found.size());
}

TEST(Partition, WhatDoesNotFitIsRefused)
{
  mesh::OneRank alone;
  Stack stack(2, 2);
  EXPECT_REFUSED(stack.parts(alone, 0));
  stack.cells.front() = 1000;
  EXPECT_REFUSED(stack.parts(alone, 2));
  stack = Stack(2, 2);
  stack.x.front() = std::nan("");
  EXPECT_REFUSED(stack.parts(alone, 2));
  stack = Stack(2, 2);
  stack.cells.pop_back();
  EXPECT_REFUSED(mesh::parts_with_contact(alone, stack.cells, 4,
                                          {stack.x, 2, stack.at_contact}, 2));
  EXPECT_REFUSED(mesh::parts_with_contact(alone, stack.cells, 1,
                                          {stack.x, 4, stack.at_contact}, 2));
  stack.at_contact.pop_back();
  EXPECT_REFUSED(mesh::parts_with_contact(alone, {}, 4,
                                          {stack.x, 2, stack.at_contact}, 2));
}
} // namespace
