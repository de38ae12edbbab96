// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_scene.h"
#include <Eigen/Core>
#include <contactx/condense/coupled_rows.h>
#include <gtest/gtest.h>
#include <numeric>

using namespace contactx;
using namespace contactx::condense;
using namespace contactx::tests;

namespace
{
/// Contacts' part of a Jacobian at a random state.
ContactBlock random_block(ContactScene& scene, std::mt19937& random,
                          bool keeps_zeros)
{
  auto law = std::make_shared<law::Coulomb>();
  law->set_friction(std::vector<double>(scene.sheets.num_slaves, 0.3));
  const auto contact = scene.contact<contact::NodeToSurface>(law);
  scene.shake(random, 0.01);
  contact->search();
  std::ranges::fill(contact->nodes()->multiplier, 0.5);
  std::ranges::fill(contact->nodes()->c, 1.0);
  for (std::size_t i = 0; i < contact->nodes()->status.size(); ++i)
    contact->nodes()->status[i] = static_cast<std::int8_t>(i % 3);
  const std::vector<std::shared_ptr<contact::Contact>> contacts{contact};
  residual(contacts);
  return ContactBlock(contacts, {}, keeps_zeros);
}
} // namespace

TEST(CoupledRows, TheyAreTheSumOfBulkAndContacts)
{
  std::mt19937 random(7);
  for (const bool keeps_zeros : {false, true})
    for (const int kind : {0, 1, 2, 3})
    {
      // Nodes of another rank, and rows of other fields of the bulk
      const bool has_others = kind % 2 == 1;
      const std::size_t extra = kind / 2 * 5;
      ContactScene scene(2);
      const ContactBlock contact = random_block(scene, random, keeps_zeros);
      const std::size_t n = contact.size(), num_local = scene.u->size();
      // The last nodes may be of another rank, whose unknowns come first
      const std::size_t num_owned = has_others ? num_local - 6 : num_local;
      std::vector<std::int64_t> places(n);
      for (std::size_t i = 0; i < n; ++i)
        places[i] = i < num_owned   ? 6 + std::int64_t(i)
                    : i < num_local ? std::int64_t(i - num_owned)
                                    : std::int64_t(i + extra);
      if (not has_others)
        for (std::size_t i = 0; i < n; ++i)
          places[i] = std::int64_t(i < num_local ? i : i + extra);
      const std::size_t all = n + extra;
      // A bulk with a few entries a row
      std::vector<std::int64_t> offsets{0}, columns;
      std::vector<double> values;
      std::uniform_real_distribution<double> any(-1, 1);
      Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(all, all);
      const std::int64_t first = places[0];
      for (std::size_t i = 0; i < num_owned + extra; ++i)
      {
        for (std::size_t j = i % 3; j < all; j += 4)
        {
          columns.push_back(std::int64_t(j));
          values.push_back(any(random));
          expected(first + i, j) += values.back();
        }
        offsets.push_back(std::ssize(columns));
      }
      const auto c = contact.entries();
      for (std::size_t i = 0; i < n; ++i)
        for (auto e = c.offsets[i]; e < c.offsets[i + 1]; ++e)
          expected(places[i], places[c.columns[e]]) += c.values[e];

      const CoupledRows found = coupled(offsets, columns, values, contact,
                                        places, num_owned, num_local);
      Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(all, all);
      const auto add = [&sum](const Rows& rows, auto place)
      {
        for (std::size_t i = 0; i + 1 < rows.offsets.size(); ++i)
          for (auto e = rows.offsets[i]; e < rows.offsets[i + 1]; ++e)
          {
            const bool is_first = e == rows.offsets[i];
            EXPECT_TRUE(is_first or rows.columns[e - 1] < rows.columns[e]);
            sum(place(i), rows.columns[e]) += rows.values[e];
          }
      };
      // Own rows follow each other: displacements, then multipliers
      add(found.own, [first](std::size_t i) { return first + i; });
      add(found.added, [&found](std::size_t i) { return found.others[i]; });
      ASSERT_EQ(found.own.offsets.size(), all - (num_local - num_owned) + 1);
      EXPECT_EQ(found.others.empty(), not has_others);
      EXPECT_LE((sum - expected).cwiseAbs().maxCoeff(), 1e-14);
    }
}

TEST(CoupledRows, PlacesDependOnPairsAloneWhereZerosStay)
{
  std::mt19937 random(8);
  ContactScene scene(3);
  const auto contact = scene.contact<contact::SurfaceToSurface>(
      std::make_shared<law::Frictionless>());
  const std::vector<std::shared_ptr<contact::Contact>> contacts{contact};
  std::vector<std::int32_t> columns;
  std::vector<std::size_t> fewer;
  for (const std::int8_t status : {law::open, law::slip})
  {
    std::ranges::fill(contact->nodes()->status, status);
    std::ranges::fill(contact->nodes()->multiplier, double(status));
    residual(contacts);
    const ContactBlock all(contacts, {}, true);
    const auto entries = all.entries();
    EXPECT_TRUE(status == law::open
                or std::ranges::equal(columns, entries.columns));
    columns.assign(entries.columns.begin(), entries.columns.end());
    fewer.push_back(ContactBlock(contacts, {}).entries().columns.size());
  }
  EXPECT_LT(fewer[0], fewer[1]);
  EXPECT_LE(fewer[1], columns.size());
}

TEST(CoupledRows, WhatDoesNotFitIsRefused)
{
  std::mt19937 random(9);
  ContactScene scene(2);
  const ContactBlock contact = random_block(scene, random, false);
  const std::size_t n = contact.size(), num_local = scene.u->size();
  std::vector<std::int64_t> places(n), offsets(num_local + 1, 0);
  std::iota(places.begin(), places.end(), 0);
  const auto call = [&](std::size_t num_owned, std::size_t local)
  { coupled(offsets, {}, {}, contact, places, num_owned, local); };
  EXPECT_NO_THROW(call(num_local, num_local));
  EXPECT_THROW(call(num_local, num_local - 1), std::invalid_argument);
  EXPECT_THROW(call(num_local + 1, num_local + 1), std::invalid_argument);
  EXPECT_THROW(call(num_local, n + 1), std::invalid_argument);
  EXPECT_THROW(coupled({}, {}, {}, contact, places, num_local, num_local),
               std::invalid_argument);
  const std::vector<double> one(1, 0.0);
  EXPECT_THROW(coupled(offsets, {}, one, contact, places, num_local, num_local),
               std::invalid_argument);
  places.pop_back();
  EXPECT_THROW(call(num_local, num_local), std::invalid_argument);
}
