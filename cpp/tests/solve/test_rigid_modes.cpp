// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "free_bodies_scene.h"
#include <contactx/math/matrix.h>
#include <contactx/solve/rigid_modes.h>
#include <contactx/solve/springs.h>

using namespace contactx;
using namespace contactx::solve;
using tests::FreeScene;
using tests::Truss;

namespace
{
FreeScene block(int gdim)
{
  Truss truss{gdim, {}, {}};
  truss.add_block(2, {0.3, -0.2, 0.5}, 1.0);
  return FreeScene(truss);
}

/// Fix components of the nodes where a function of the position holds.
template <class F>
void fix(FreeScene& scene, F at, std::vector<int> components)
{
  const int g = scene.truss.gdim;
  for (std::int32_t i = 0; i < scene.truss.num_nodes(); ++i)
    if (at(&scene.truss.x[i * g]))
      for (const int c : components)
        scene.bulk->fixed[i * g + c] = 1;
}

/// Whether no mode moves what is fixed, and the bars are as long as they were.
void expect_free(const FreeScene& scene, const RigidModes& modes,
                 std::size_t body)
{
  const std::size_t g = scene.truss.gdim, m = modes.modes_per_body();
  const Eigen::MatrixXd& free = modes.free()[body];
  std::vector<double> at(g * m);
  for (Eigen::Index k = 0; k < free.cols(); ++k)
  {
    std::vector<double> field(scene.truss.x.size());
    for (std::int32_t i = 0; i < scene.truss.num_nodes(); ++i)
    {
      if (modes.body()[i] != static_cast<std::int32_t>(body))
        continue;
      modes.at(i, scene.bulk->reference(), at.data());
      for (std::size_t c = 0; c < g; ++c)
        for (std::size_t p = 0; p < m; ++p)
          field[i * g + c] += at[c * m + p] * free(p, k);
    }
    EXPECT_GT(math::column(field).norm(), 0.1);
    for (std::size_t i = 0; i < field.size(); ++i)
      EXPECT_NEAR(scene.bulk->fixed[i] * field[i], 0, 1e-6);
    for (const double force : scene.bulk->product(field))
      EXPECT_NEAR(force, 0, 1e-6);
  }
}

std::size_t num_free(FreeScene& scene)
{
  const RigidModes modes(scene.bodies, *scene.bulk, scene.bulk->reference());
  expect_free(scene, modes, 0);
  EXPECT_EQ(modes.any_free(), modes.free()[0].cols() > 0);
  return modes.free()[0].cols();
}

TEST_2D_3D(RigidModes, ExactMotionsKeepDistancesAndLinearOnesAreTheirDerivative,
           g)
{
  FreeScene scene = block(g);
  const auto x = scene.bulk->reference();
  const RigidModes modes(scene.bodies, *scene.bulk, x);
  const std::size_t m = modes.modes_per_body();
  const std::array<double, 6> all{0.3, -0.2, 0.7, 0.5, 0.1, -0.4};
  std::vector<double> at(g * m);
  const auto moved = [&](std::int32_t node, double part, bool is_exact)
  {
    std::array<double, 6> motion = all;
    for (double& value : motion)
      value *= part;
    std::vector<double> by(g);
    modes.move(node, x, motion.data(), is_exact, by.data());
    return by;
  };
  const std::vector<double> first = moved(0, 1, true);
  for (std::int32_t i = 1; i < scene.truss.num_nodes(); ++i)
  {
    const std::vector<double> by = moved(i, 1, true),
                              little = moved(i, 1e-6, true),
                              linear = moved(i, 1, false);
    modes.at(i, x, at.data());
    double before = 0, after = 0;
    for (int k = 0; k < g; ++k)
    {
      const double apart = x[i * g + k] - x[k];
      before += apart * apart;
      after += std::pow(apart + by[k] - first[k], 2);
      double sum = 0;
      for (std::size_t p = 0; p < m; ++p)
        sum += at[k * m + p] * all[p];
      EXPECT_NEAR(linear[k], sum, 1e-14);
      EXPECT_NEAR(little[k], 1e-6 * sum, 1e-11);
    }
    EXPECT_NEAR(after, before, 1e-13);
  }
}

TEST(RigidModes, TranslationsThenRotations)
{
  const std::array<double, 3> d{2, 3, 5};
  std::array<double, 18> modes;
  rigid_modes(d.data(), modes.data(), 2);
  EXPECT_TRUE(std::ranges::equal(std::span(modes).first(6),
                                 std::array{1., 0., -3., 0., 1., 2.}));
  rigid_modes(d.data(), modes.data(), 3);
  for (int k = 0; k < 3; ++k)
  {
    Vector<3> axis{};
    axis[k] = 1;
    const Vector<3> turned = cross(axis, d);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_EQ(modes[6 * c + k], c == k);
      EXPECT_EQ(modes[6 * c + 3 + k], turned[c]);
    }
  }
}

TEST(RigidModes, ModesAreAboutTheMiddleOverTheRadius)
{
  Truss truss{2, {}, {}};
  truss.add_block(1, {0, 0, 0}, 2.0);
  truss.add_block(1, {10, 4, 0}, 1.0);
  const FreeScene scene(truss);
  const RigidModes modes(scene.bodies, *scene.bulk, scene.bulk->reference());
  EXPECT_EQ(modes.count(), 2);
  EXPECT_NEAR(modes.size(), std::sqrt(2.0), 1e-15);
  std::array<double, 6> at;
  // The last node is a corner of the small block
  modes.at(7, scene.bulk->reference(), at.data());
  EXPECT_NEAR(at[2], -std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(at[5], std::sqrt(0.5), 1e-14);
}

TEST(RigidModes, SupportsIn2D)
{
  FreeScene none = block(2), point = block(2), points = block(2),
            line = block(2), roller = block(2), slope = block(2);
  EXPECT_EQ(num_free(none), 3);
  fix(point, [](const double* x) { return x[0] < 0.4 and x[1] < 0; }, {0, 1});
  EXPECT_EQ(num_free(point), 1);
  fix(points, [](const double* x) { return x[0] < 0.4 and x[1] < 0; }, {0, 1});
  fix(points, [](const double* x) { return x[0] > 1 and x[1] > 0.7; }, {0});
  EXPECT_EQ(num_free(points), 0);
  fix(line, [](const double* x) { return x[1] < -0.1; }, {0, 1});
  EXPECT_EQ(num_free(line), 0);
  // It slides along
  fix(roller, [](const double* x) { return x[1] < -0.1; }, {1});
  EXPECT_EQ(num_free(roller), 1);
  // Forces that meet in a point: a rotation about it is free
  fix(slope, [](const double* x) { return x[0] < 0.4 and x[1] < 0; }, {1});
  fix(slope, [](const double* x) { return x[0] < 0.4 and x[1] > 0.7; }, {0});
  EXPECT_EQ(num_free(slope), 1);
}

TEST(RigidModes, SupportsIn3D)
{
  const auto corner = [](const double* x)
  { return x[0] < 0.4 and x[1] < -0.1 and x[2] < 0.6; };
  const auto edge = [](const double* x) { return x[1] < -0.1 and x[2] < 0.6; };
  const auto face = [](const double* x) { return x[2] < 0.6; };
  FreeScene none = block(3), point = block(3), line = block(3),
            plane = block(3), roller = block(3), guided = block(3);
  EXPECT_EQ(num_free(none), 6);
  fix(point, corner, {0, 1, 2});
  EXPECT_EQ(num_free(point), 3);
  fix(line, edge, {0, 1, 2});
  EXPECT_EQ(num_free(line), 1);
  fix(plane, face, {0, 1, 2});
  EXPECT_EQ(num_free(plane), 0);
  fix(roller, face, {2});
  EXPECT_EQ(num_free(roller), 3);
  fix(guided, face, {2});
  fix(guided, edge, {1});
  EXPECT_EQ(num_free(guided), 1);
}

TEST_2D_3D(RigidModes, ElasticSupports, g)
{
  // Of all nodes in one direction
  FreeScene scene = block(g);
  const double k = 1e-6;
  for (std::int32_t i = 0; i < scene.truss.num_nodes(); ++i)
    scene.bulk->ground[i * g + g - 1] = k;
  const RigidModes modes(scene.bodies, *scene.bulk, scene.bulk->reference());
  // Along it, and rotations that lift nodes
  const std::size_t held = g == 2 ? 2 : 3;
  EXPECT_EQ(modes.free()[0].cols(), num_modes(g) - held);
  ASSERT_EQ(modes.weak()[0].cols(), held);
  EXPECT_EQ(modes.stiffness()[0].size(), held);
  // A translation has all springs
  EXPECT_NEAR(std::ranges::max(modes.stiffness()[0]),
              k * scene.truss.num_nodes(), 1e-6 * k);
  // Stiff ones leave nothing that little resists
  for (double& spring : scene.bulk->ground)
    spring = 1;
  const RigidModes stiff(scene.bodies, *scene.bulk, scene.bulk->reference());
  EXPECT_FALSE(stiff.any_free());
}

TEST_2D_3D(RigidModes, StressesAreNoSupport, g)
{
  FreeScene scene = block(g);
  RigidModes modes(scene.bodies, *scene.bulk, scene.bulk->reference());
  EXPECT_EQ(modes.free()[0].cols(), num_modes(g));
  // They resist rotations alone
  scene.bulk->tension = 0.1;
  modes.update(*scene.bulk, scene.bulk->reference());
  EXPECT_EQ(modes.free()[0].cols(), num_modes(g));
  // A support that comes later
  scene.bulk->tension = 0;
  scene.bulk->ground[0] = 1e-3;
  modes.update(*scene.bulk, scene.bulk->reference());
  EXPECT_EQ(modes.free()[0].cols(), num_modes(g) - 1);
  // Whose motions are looked at from then on
  scene.bulk->ground[0] = 0;
  modes.update(*scene.bulk, scene.bulk->reference());
  EXPECT_EQ(modes.free()[0].cols(), num_modes(g));
}

TEST(RigidModes, AStiffnessThatThrowsChangesNothing)
{
  FreeScene scene = block(2);
  RigidModes modes(scene.bodies, *scene.bulk, scene.bulk->reference());
  scene.bulk->throws = true;
  EXPECT_THROW(modes.update(*scene.bulk, scene.bulk->reference()),
               std::runtime_error);
  EXPECT_EQ(modes.free()[0].cols(), 3);
  EXPECT_REFUSED(modes.update(*scene.bulk, std::array<double, 3>{}));
}

TEST_2D_3D(RigidModes, OnSeveralRanksTheyAreThoseOfOne, g)
{
  Truss truss{g, {}, {}};
  truss.add_block(2, {0.3, -0.2, 0.5}, 1.0);
  truss.add_block(3, {2, 2, 2}, 2.0);
  const auto hold = [g](FreeScene& scene)
  {
    scene.bulk->fixed[scene.place[0] * g] = 1;
    scene.bulk->ground[scene.place[1] * g + g - 1] = 1e-5;
  };
  FreeScene one(truss);
  hold(one);
  const RigidModes serial(one.bodies, *one.bulk, one.bulk->reference());
  EXPECT_EQ(serial.free()[0].cols(), num_modes(g) - 2);
  EXPECT_EQ(serial.free()[1].cols(), num_modes(g));
  for (const int size : {2, 3, 4})
    tests::on_ranks(
        size,
        [&](mesh::Ranks& ranks)
        {
          FreeScene scene(truss, &ranks);
          hold(scene);
          const RigidModes modes(scene.bodies, *scene.bulk,
                                 scene.bulk->reference());
          EXPECT_NEAR(modes.size(), serial.size(), 1e-14);
          for (std::size_t b = 0; b < 2; ++b)
          {
            // The same space
            const Eigen::MatrixXd &F = modes.free()[b], &S = serial.free()[b];
            ASSERT_EQ(F.cols(), S.cols());
            EXPECT_TRUE((F * F.transpose()).isApprox(S * S.transpose(), 1e-8));
          }
          ASSERT_EQ(modes.stiffness()[0].size(), 1);
          EXPECT_NEAR(modes.stiffness()[0][0], serial.stiffness()[0][0], 1e-15);
        });
}

TEST(RigidModes, OfSingleBodiesAsThoseOfAll)
{
  const Eigen::MatrixXd bases[]
      = {Eigen::MatrixXd{{1}, {2}}, Eigen::MatrixXd(2, 0),
         Eigen::MatrixXd{{3, 4}, {5, 6}}};
  const Eigen::MatrixXd expected{{1, 0, 0}, {2, 0, 0}, {0, 0, 0},
                                 {0, 0, 0}, {0, 3, 4}, {0, 5, 6}};
  const Eigen::MatrixXd Z = by_body(bases);
  ASSERT_EQ(Z.rows(), 6);
  ASSERT_EQ(Z.cols(), 3);
  EXPECT_EQ(Z, expected);
}

/// Rigid modes at random points, combined by some columns.
struct Points
{
  Points(int gdim, int count, unsigned seed) : gdim(gdim), random(seed)
  {
    const int m = solve::num_modes(gdim);
    field.resize(m, count * gdim);
    for (int i = 0; i < count; ++i)
    {
      const Vector<3> at = random.vector<3>(-1, 1);
      solve::rigid_modes(at.data(), &field(0, i * gdim), gdim);
      original.push_back((i * 7 + 3) % count);
    }
    for (int i = 0; i < count * gdim; ++i)
      diagonal.push_back(random(-2, -1));
    prescribed.resize(count * gdim);
  }

  std::vector<double> springs() const
  {
    mesh::OneRank ranks;
    return independent_springs(ranks, field, prescribed, diagonal, original,
                               gdim);
  }

  int gdim;
  tests::Generator random;
  Eigen::MatrixXd field;
  std::vector<std::int8_t> prescribed;
  std::vector<double> diagonal;
  std::vector<std::int64_t> original;
};

TEST(Springs, AreStaticallyDeterminate)
{
  for (unsigned seed = 0; seed < 10; ++seed)
    for (const int g : {2, 3})
    {
      Points points(g, 20, seed);
      points.prescribed[5] = points.prescribed[8] = 1;
      const std::vector<double> springs = points.springs();
      std::vector<std::size_t> dofs;
      for (std::size_t i = 0; i < springs.size(); ++i)
        if (springs[i] != 0)
        {
          dofs.push_back(i);
          EXPECT_EQ(springs[i], -points.diagonal[i]);
          EXPECT_EQ(points.prescribed[i], 0);
        }
      // As many as modes, and any forces along these have their springs
      const std::size_t m = points.field.rows();
      ASSERT_EQ(dofs.size(), m);
      const Eigen::MatrixXd columns = points.field(Eigen::all, dofs);
      const Eigen::MatrixXd gram = columns * columns.transpose();
      EXPECT_GT(math::symmetric_eigen(gram).eigenvalues()[0], 0.01);
    }
}

TEST(Springs, DoNotDependOnTheBasis)
{
  for (unsigned seed = 0; seed < 10; ++seed)
    for (const int g : {2, 3})
    {
      Points points(g, 15, seed);
      const std::vector<double> springs = points.springs();
      const auto m = points.field.rows();
      // Eigenvectors of any symmetric matrix are as good a basis
      const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(
          m, m, [&points] { return points.random(-1, 1); });
      points.field = math::symmetric_eigen(any).eigenvectors().transpose()
                     * points.field;
      EXPECT_EQ(points.springs(), springs);
    }
}

TEST(Springs, OfEqualOnesTheFirstInTheMeshAsItWasMade)
{
  Points points(2, 6, 0);
  // One translation
  points.field.setZero(1, 12);
  for (int i = 0; i < 6; ++i)
    points.field(0, 2 * i + 1) = 1 + (i % 2) * 1e-12;
  const std::vector<double> springs = points.springs();
  const auto first = std::ranges::find(points.original, 0);
  const auto dof = 2 * (first - points.original.begin()) + 1;
  for (std::ptrdiff_t i = 0; i < 12; ++i)
    EXPECT_EQ(springs[i] != 0, i == dof);
}

TEST_2D_3D(Springs, OnSeveralRanksTheyAreThoseOfOne, g)
{
  const Points points(g, 20, 3);
  const std::vector<double> expected = points.springs();
  for (const int size : {2, 3, 4})
    tests::on_ranks(size,
                    [&](mesh::Ranks& ranks)
                    {
                      // The last rank has no node
                      std::vector<Eigen::Index> dofs;
                      std::vector<double> diagonal, mine;
                      std::vector<std::int8_t> prescribed;
                      std::vector<std::int64_t> original;
                      for (int i = 0; i < 20; ++i)
                      {
                        if (i % (size - 1) != ranks.rank())
                          continue;
                        original.push_back(points.original[i]);
                        for (int dof = i * g; dof < (i + 1) * g; ++dof)
                        {
                          dofs.push_back(dof);
                          diagonal.push_back(points.diagonal[dof]);
                          prescribed.push_back(0);
                          mine.push_back(expected[dof]);
                        }
                      }
                      const Eigen::MatrixXd field
                          = points.field(Eigen::all, dofs);
                      EXPECT_EQ(independent_springs(ranks, field, prescribed,
                                                    diagonal, original, g),
                                mine);
                    });
}

TEST(Springs, WhatDoesNotFitIsRefused)
{
  Points points(2, 4, 0);
  points.diagonal.pop_back();
  EXPECT_REFUSED(points.springs());
}
} // namespace
