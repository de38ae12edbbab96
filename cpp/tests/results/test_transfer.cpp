// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_scene.h"
#include <cmath>
#include <contactx/results/transfer.h>
#include <gtest/gtest.h>
#include <numeric>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
template <class M>
class Transfers : public testing::Test
{
protected:
  static std::shared_ptr<Contact> contact(ContactScene& scene)
  {
    std::mt19937 random(7);
    scene.shake(random, 0.005);
    auto contact = scene.contact<M>(std::make_shared<law::Frictionless>());
    contact->search();
    contact->update_gap();
    return contact;
  }

  /// Random numbers.
  static std::vector<double> any(std::size_t count, unsigned seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> one(0.5, 1.5);
    std::vector<double> values(count);
    for (double& v : values)
      v = one(random);
    return values;
  }
};

using Methods = testing::Types<NodeToSurface, SurfaceToSurface>;
TYPED_TEST_SUITE(Transfers, Methods);

TYPED_TEST(Transfers, UniformFieldHasNoDifference)
{
  for (const int dim : {2, 3})
  {
    ContactScene scene(dim);
    const auto contact = this->contact(scene);
    const results::Transfer transfer(*contact);
    ASSERT_GT(std::accumulate(transfer.is_paired().begin(),
                              transfer.is_paired().end(), 0),
              3);
    const std::vector<double> field(scene.halo->num_nodes(), 3);
    for (const double d : transfer.differences(field))
      EXPECT_NEAR(d, 0, 1e-13);
  }
}

TYPED_TEST(Transfers, NothingIsLost)
{
  for (const int dim : {2, 3})
  {
    ContactScene scene(dim);
    const auto contact = this->contact(scene);
    const results::Transfer transfer(*contact);
    const auto flow = this->any(transfer.area().size(), 1);
    std::vector<double> b(scene.halo->num_nodes(), 0);
    transfer.add(flow, b);
    double sum = 0, size = 0;
    for (const double v : b)
    {
      sum += v;
      size += std::abs(v);
    }
    EXPECT_GT(size, 1);
    EXPECT_NEAR(sum, 0, 1e-13 * size);
  }
}

/// Derivatives against what flows.
TYPED_TEST(Transfers, MatricesAreTheDerivatives)
{
  for (const int dim : {2, 3})
  {
    ContactScene scene(dim);
    const auto contact = this->contact(scene);
    const results::Transfer transfer(*contact);
    const std::size_t n = transfer.area().size();
    const std::size_t nodes = scene.halo->num_nodes();
    const auto h = this->any(n, 2), field = this->any(nodes, 3);
    std::vector<double> flow = transfer.differences(field);
    for (std::size_t i = 0; i < n; ++i)
      flow[i] *= h[i] * transfer.area()[i];
    std::vector<double> b(nodes, 0), product(nodes, 0);
    transfer.add(flow, b);
    transfer.by_field(h).multiply(field, product);
    for (std::size_t k = 0; k < nodes; ++k)
      EXPECT_NEAR(product[k], b[k], 1e-13);
    std::ranges::fill(product, 0);
    transfer.by_slaves(h).multiply(flow, product);
    std::ranges::fill(b, 0);
    for (std::size_t i = 0; i < n; ++i)
      flow[i] *= h[i];
    transfer.add(flow, b);
    for (std::size_t k = 0; k < nodes; ++k)
      EXPECT_NEAR(product[k], b[k], 1e-13);
    // By a displacement: what the gaps change by, with the normals as they are
    const auto u = this->any(nodes * dim, 4);
    const std::vector<double> normals = contact->master()->normals();
    std::vector<double> opening(n, 0), part(nodes);
    for (int k = 0; k < dim; ++k)
    {
      for (std::size_t j = 0; j < nodes; ++j)
        part[j] = u[dim * j + k];
      const auto d = transfer.differences(part);
      for (std::size_t i = 0; i < n; ++i)
        opening[i] += normals[3 * i + k] * d[i];
    }
    for (std::size_t i = 0; i < n; ++i)
      opening[i] *= h[i];
    std::ranges::fill(b, 0);
    transfer.add(opening, b);
    std::ranges::fill(product, 0);
    transfer.by_displacement(h).multiply(u, product);
    for (std::size_t k = 0; k < nodes; ++k)
      EXPECT_NEAR(product[k], b[k], 1e-12);
  }
}

TYPED_TEST(Transfers, MasterHasMeansOfWhatIsInFrontOfIt)
{
  for (const int dim : {2, 3})
  {
    ContactScene scene(dim);
    const auto contact = this->contact(scene);
    const results::Transfer transfer(*contact);
    const std::vector<double> uniform(transfer.area().size(), 2);
    const auto values = this->any(transfer.area().size(), 5);
    const auto same = transfer.at_master(uniform);
    const auto means = transfer.at_master(values);
    std::size_t count = 0;
    for (std::size_t k = 0; k < means.size(); ++k)
    {
      EXPECT_EQ(std::isnan(means[k]), std::isnan(same[k]));
      if (std::isnan(means[k]))
        continue;
      ++count;
      EXPECT_NEAR(same[k], 2, 1e-13);
      EXPECT_GE(means[k], 0.5);
      EXPECT_LE(means[k], 1.5);
    }
    EXPECT_GT(count, 2);
    for (const std::int32_t node : scene.slaves->owned())
      EXPECT_TRUE(std::isnan(means[node]));
  }
}

TYPED_TEST(Transfers, SizesAreChecked)
{
  ContactScene scene(2);
  const auto contact = this->contact(scene);
  const results::Transfer transfer(*contact);
  const std::vector<double> none;
  std::vector<double> b(scene.halo->num_nodes());
  EXPECT_THROW((void)transfer.differences(none), std::invalid_argument);
  EXPECT_THROW(transfer.add(none, b), std::invalid_argument);
  EXPECT_THROW((void)transfer.by_field(none), std::invalid_argument);
  EXPECT_THROW((void)transfer.by_slaves(none), std::invalid_argument);
  EXPECT_THROW((void)transfer.by_displacement(none), std::invalid_argument);
  EXPECT_THROW((void)transfer.at_master(none), std::invalid_argument);
}
} // namespace
