// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_scene.h"
#include <contactx/contact/node_to_surface.h>
#include <contactx/contact/surface_to_surface.h>
#include <contactx/math/matrix.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
template <class>
using Changes = testing::Test;

using Methods = testing::Types<NodeToSurface, SurfaceToSurface>;
TYPED_TEST_SUITE(Changes, Methods);

TYPED_TEST(Changes, AreDerivativesOfGapSlipAndNormals)
{
  for (const int dim : {2, 3})
  {
    SCOPED_TRACE(std::to_string(dim) + "D");
    ContactScene scene(dim, 0.05, Cells::mixed);
    const std::size_t n = scene.u->size();
    const auto contact = scene.contact<TypeParam>(
        coulomb(scene.slaves->owned().size(), 0.3), Sliding::finite);
    Generator random(2);
    std::vector<double> u(n), du(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      u[i] = random(-1, 1) * 2e-3;
      du[i] = random(-1, 1);
    }
    const double h = 1e-6;
    const auto at = [&](double step)
    {
      for (std::size_t i = 0; i < n; ++i)
        (*scene.u)[i] = u[i] + step * du[i];
      // Pairs stay
      contact->update_gap();
    };
    contact->begin_step();
    for (std::size_t i = 0; i < n; ++i)
      (*scene.u)[i] = u[i];
    contact->search();
    contact->update_gap();
    const law::NodeState& nodes = *contact->nodes();
    contact->law()->evaluate(*contact->nodes());
    const auto change = contact->change(du);
    const auto base = nodes.normal;
    const auto values = [&](double step)
    {
      at(step);
      return std::tuple(nodes.gap, nodes.slip, nodes.normal);
    };
    const auto [gap_plus, slip_plus, normal_plus] = values(h);
    const auto [gap_minus, slip_minus, normal_minus] = values(-h);
    const int size = nodes.size();
    int count = 0;
    for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    {
      if (std::isnan(gap_plus[i]) or std::isnan(gap_minus[i]))
        continue;
      ++count;
      const double gap = (gap_plus[i] - gap_minus[i]) / (2 * h);
      for (int k = 0; k < size; ++k)
      {
        const std::size_t at = size * i + k;
        const double slip = (slip_plus[at] - slip_minus[at]) / (2 * h);
        EXPECT_NEAR(change.movement[at], base[at] * gap + slip, 1e-6);
        EXPECT_NEAR(change.normal[at],
                    (normal_plus[at] - normal_minus[at]) / (2 * h), 1e-6);
      }
    }
    EXPECT_GT(count, 3);
  }
}
} // namespace
