// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "two_sheets.h"
#include <cmath>
#include <contactx/contact/slip_weights.h>
#include <gtest/gtest.h>
#include <numeric>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
/// A slave node with made-up weights over some facets of a master in a frame.
struct Weighted
{
  TwoSheets sheets;
  SlaveNodes slaves;
  MortarSides sides;
  Mortar mortar;
  std::vector<double> x;

  explicit Weighted(int gdim, double angle)
      : sheets(gdim, 0.1), slaves(mesh::serial_halo(sheets.x, gdim),
                                  sheets.slave.list(), sheets.slave.list()),
        sides(slaves, sheets.x, gdim), x(sheets.turned(angle))
  {
    sides.set_master_facets(sheets.master.list(), {});
    const std::size_t w = mortar.width = sides.width();
    mortar.slave = {0, 0, 0};
    mortar.master = {0, 1, 3};
    mortar.gap.assign(3 * w, 0);
    mortar.weight.assign(3 * w * w, 0);
    double total = 0;
    for (std::size_t p = 0; p < 3; ++p)
      for (int l = 0; l < gdim; ++l)
        total += at(p, l) = l == 0 and p == 2 ? -0.1 : 0.1 + 0.1 * p + 0.2 * l;
    for (double& value : mortar.weight)
      value /= total;
  }

  double& at(std::size_t p, int l)
  {
    return mortar.weight[p * mortar.width * mortar.width + l];
  }

  /// Normals of all slave nodes.
  std::vector<double> normals(double angle) const
  {
    std::vector<double> n(3 * sides.size(), 0);
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      n[3 * i] = -std::sin(angle);
      n[3 * i + sheets.gdim - 1] = std::cos(angle);
    }
    return n;
  }

  /// Slave node less the master's points.
  std::vector<double> distances(const Mortar& m) const
  {
    const int g = sheets.gdim;
    std::vector<double> d(g * sides.size(), 0);
    const std::size_t i = sides.numbers(0)[0];
    const std::int32_t node = sides.slaves()[i];
    for (int k = 0; k < g; ++k)
    {
      d[g * i + k] = x[g * node + k];
      for (std::size_t p = 0; p < m.size(); ++p)
        for (int l = 0; l < m.width; ++l)
          d[g * i + k]
              -= m.row(p, 0)[l] * x[g * sides.master_nodes(m.master[p])[l] + k];
    }
    return d;
  }
};
} // namespace

TEST(SlipWeights, PutMastersRightBeforeTheirNodeInAnyFrame)
{
  for (int gdim : {2, 3})
    for (double angle : {0.0, 0.7, 1.5})
    {
      const Weighted w(gdim, angle);
      const auto n = w.normals(angle);
      const auto before = w.distances(w.mortar);
      const Mortar found
          = slip_weights(w.mortar, w.sides, before, n, w.x, gdim);
      const auto after = w.distances(found);
      const std::size_t i = w.sides.numbers(0)[0];
      double along = 0, was = 0;
      for (int k = 0; k < gdim; ++k)
      {
        along += n[3 * i + k] * after[gdim * i + k];
        was += n[3 * i + k] * before[gdim * i + k];
      }
      double across = 0, offset = 0;
      for (int k = 0; k < gdim; ++k)
      {
        across = std::max(across,
                          std::abs(after[gdim * i + k] - along * n[3 * i + k]));
        offset = std::max(offset,
                          std::abs(before[gdim * i + k] - was * n[3 * i + k]));
      }
      EXPECT_GT(offset, 0.1);
      EXPECT_LT(across, 1e-12);
      EXPECT_NEAR(along, was, 1e-12); // masters are in a plane
      const auto sum = [](const std::vector<double>& values)
      { return std::accumulate(values.begin(), values.end(), 0.0); };
      EXPECT_NEAR(sum(found.weight), 1, 1e-12);
      // The same weights in any frame
      const Weighted flat(gdim, 0);
      const Mortar upright
          = slip_weights(flat.mortar, flat.sides, flat.distances(flat.mortar),
                         flat.normals(0), flat.x, gdim);
      for (std::size_t e = 0; e < found.weight.size(); ++e)
      {
        EXPECT_NEAR(found.weight[e], upright.weight[e], 1e-12);
        if (w.mortar.weight[e] == 0)
        {
          EXPECT_EQ(found.weight[e], 0);
        }
      }
    }
}

TEST(SlipWeights, LeaveWhatIsRightBeforeTheirNode)
{
  for (int gdim : {2, 3})
  {
    const Weighted w(gdim, 0.7);
    const std::vector<double> n = w.normals(0.7);
    std::vector<double> d(gdim * w.sides.size(), 0);
    for (std::size_t i = 0; i < w.sides.size(); ++i)
      for (int k = 0; k < gdim; ++k)
        d[gdim * i + k] = 0.3 * n[3 * i + k];
    const Mortar found = slip_weights(w.mortar, w.sides, d, n, w.x, gdim);
    for (std::size_t e = 0; e < found.weight.size(); ++e)
      EXPECT_NEAR(found.weight[e], w.mortar.weight[e], 1e-14);
  }
}

TEST(SlipWeights, LeaveMastersInOneLineAlone)
{
  // Nothing is known across it
  Weighted w(3, 0);
  for (std::size_t p = 0; p < 3; ++p)
    for (int l = 0; l < 3; ++l)
      w.at(p, l) = p == 0 and l < 2 ? 0.5 : 0.0;
  const Mortar found = slip_weights(w.mortar, w.sides, w.distances(w.mortar),
                                    w.normals(0), w.x, 3);
  EXPECT_EQ(found.weight, w.mortar.weight);
}
