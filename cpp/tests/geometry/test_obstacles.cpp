// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "obstacles.h"
#include <numbers>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
std::vector<double> random_points(int n, int gdim, double low, double high)
{
  Generator random(1);
  return random.numbers(n * gdim, low, high);
}

template <class O>
std::string error_of(O&& obstacle, std::vector<double> x, int gdim)
{
  return refusal([&] { obstacle.evaluate(x, gdim); });
}

TEST(Geometry, LargestCurvaturesArePrincipalOnes)
{
  // z = (a x^2 + b y^2) / 2 + c x y at the origin, and turned out of the axes
  const auto at = [](double a, double b, double c, Vector<3> n)
  {
    Geometry seen;
    seen.resize(1, 3);
    const double length = norm(n);
    n = (1 / length) * n;
    const Vector<3> t = std::abs(n[0]) < 0.9
                            ? (1 / norm(cross(n, Vector<3>{1, 0, 0})))
                                  * cross(n, Vector<3>{1, 0, 0})
                            : Vector<3>{0, 1, 0};
    const Vector<3> s = cross(n, t), more{0.3, -2, 5};
    for (int j = 0; j < 3; ++j)
    {
      seen.normal[j] = n[j];
      // What is along the normal is no curvature
      for (int k = 0; k < 3; ++k)
        seen.curvature[3 * j + k] = a * t[j] * t[k] + b * s[j] * s[k]
                                    + c * (t[j] * s[k] + s[j] * t[k])
                                    + dot(more, t) * t[j] * n[k];
    }
    return seen.largest_curvatures(3)[0];
  };
  for (const Vector<3>& n :
       {Vector<3>{0, 0, 1}, Vector<3>{1, 1, 1}, Vector<3>{0.2, -0.5, 0.8}})
  {
    EXPECT_NEAR(at(2, 2, 0, n), 2, 1e-14);
    EXPECT_NEAR(at(-3, 1, 0, n), 3, 1e-14);
    EXPECT_NEAR(at(0, 0, 1.5, n), 1.5, 1e-14);
    EXPECT_NEAR(at(1, 1, 1, n), 2, 1e-14);
  }
  Sphere sphere({0, 0}, 0.5);
  EXPECT_NEAR(sphere.evaluate(std::vector<double>{0.3, 0.4}, 2)
                  .largest_curvatures(2)[0],
              2, 1e-14);
}

TEST_2D_3D(Obstacles, DerivativesAreThoseByDifferences, gdim)
{
  for (Kind kind : kinds(gdim))
  {
    SCOPED_TRACE(testing::Message() << gdim << " " << int(kind));
    expect_differences(*make_obstacle(kind, gdim),
                       random_points(100, gdim, 0.5, 1.5), gdim, 1e-5,
                       [](const Geometry& at, int)
                       {
                         double largest = 1;
                         for (double c : at.curvature)
                           largest = std::max(largest, std::abs(c));
                         return 1e-7 * largest;
                       });
  }
}

TEST_2D_3D(Obstacles, AskedAboutNoPointsHaveNone, gdim)
{
  for (Kind kind : kinds(gdim))
  {
    const auto o = make_obstacle(kind, gdim);
    Geometry at = o->evaluate(random_points(3, gdim, 1, 2), gdim);
    o->evaluate({}, gdim, at);
    EXPECT_TRUE(at.gap.empty() and at.gradient.empty() and at.normal.empty()
                and at.curvature.empty());
    EXPECT_TRUE(o->level({}, gdim).empty());
    EXPECT_TRUE(o->distance({}, gdim).empty());
    EXPECT_TRUE(o->normals({}, gdim).empty());
  }
}

TEST(Obstacles, GapsAndNormalsOfKnownPoints)
{
  const std::vector<double> x{0, 0, 2, 3, 4, 0};
  const Geometry plane = Plane({0, 0, 1}, {0, 0, 5}).evaluate(x, 3);
  EXPECT_EQ(plane.gap, (std::vector<double>{1, -1}));
  EXPECT_EQ(plane.normal, (std::vector<double>{0, 0, 1, 0, 0, 1}));
  Sphere ball({0, 0, 0}, 4), hole({0, 0, 0}, 4, true);
  const Geometry sphere = ball.evaluate(x, 3), bowl = hole.evaluate(x, 3);
  EXPECT_EQ(sphere.gap, (std::vector<double>{-2, 1}));
  EXPECT_EQ(bowl.gap, (std::vector<double>{2, -1}));
  const std::vector<double> out{0, 0, 1, 0.6, 0.8, 0};
  for (int k = 0; k < 6; ++k)
  {
    EXPECT_NEAR(sphere.normal[k], out[k], 1e-15);
    EXPECT_NEAR(bowl.normal[k], -out[k], 1e-15);
  }
  Cylinder cylinder({0, 0, 7}, {0, 2, 0}, 1);
  const auto gap = cylinder.distance(x, 3);
  EXPECT_NEAR(gap[0], 4, 1e-14);
  EXPECT_NEAR(gap[1], std::hypot(3, 7) - 1, 1e-14);
  EXPECT_EQ(ball.size(3), 8);
  EXPECT_EQ(cylinder.size(3), 2);
  EXPECT_TRUE(std::isinf(hole.size(3)));
}

TEST(Obstacles, InTheCentreThereIsNoNormal)
{
  Sphere sphere({1, 2, 3}, 1.5);
  Cylinder cylinder({1, 2, 0}, {0, 0, 1}, 1.5);
  for (Obstacle* o :
       {static_cast<Obstacle*>(&sphere), static_cast<Obstacle*>(&cylinder)})
  {
    const Geometry at = o->evaluate(std::vector<double>{1, 2, 3}, 3);
    EXPECT_EQ(at.gap[0], -1.5);
    for (double c : at.normal)
      EXPECT_EQ(c, 0);
    for (double c : at.curvature)
      EXPECT_EQ(c, 0);
  }
}

TEST(Obstacles, ANormalOfAnyLengthIsADirection)
{
  for (double size : {1e-320, 1e-200, 1e200, 1e308})
  {
    Plane plane({0, 1}, {0, size});
    EXPECT_NEAR(plane.distance(std::vector<double>{0, 2}, 2)[0], 1, 1e-14);
  }
}

TEST(Obstacles, ThatMoveAreSeenWhereTheyAre)
{
  Plane plane({0, 1}, {0, 1});
  const std::vector<double> x{0, 3};
  EXPECT_EQ(plane.distance(x, 2)[0], 2);
  plane.place({0, 2}, {0, -3});
  EXPECT_EQ(plane.distance(x, 2)[0], -1);
  EXPECT_EQ(plane.placement(2).direction, (std::vector<double>{0, -1}));
}

/// A sphere whose parameters come from elsewhere.
class Growing final : public Sphere
{
public:
  double radius = 1;

private:
  void refresh(int gdim) override
  {
    place(std::vector<double>(gdim, 0.0), radius);
  }
};

TEST(Obstacles, AskForTheirParametersEachTime)
{
  Growing sphere;
  const std::vector<double> x{0, 3};
  EXPECT_EQ(sphere.distance(x, 2)[0], 2);
  sphere.radius = 2.5;
  EXPECT_EQ(sphere.distance(x, 2)[0], 0.5);
  EXPECT_EQ(sphere.size(2), 5);
  EXPECT_EQ(sphere.placement(2).point.size(), 2u);
}

TEST(Obstacles, SayWhatDoesNotFit)
{
  const double nan = std::nan("");
  const std::vector<double> x{0, 0}, y{0, 0, 0};
  EXPECT_EQ(error_of(Plane({0, 0, 0.5}, {0, 1}), x, 2),
            "point of a Plane is [0, 0, 0.5]: give 2 finite numbers, as the "
            "mesh has");
  EXPECT_EQ(error_of(Plane({0, nan}, {0, 1}), x, 2),
            "point of a Plane is [0, nan]: give 2 finite numbers, as the mesh "
            "has");
  EXPECT_EQ(error_of(Plane({0, 0}, {0, 0}), x, 2),
            "normal of a Plane is a zero vector: give a direction");
  EXPECT_EQ(error_of(Plane(), x, 2),
            "normal of a Plane is []: give 2 finite numbers, as the mesh has");
  EXPECT_EQ(error_of(Sphere({0, 0}, 0), x, 2),
            "radius of a Sphere is 0: give a positive number");
  EXPECT_EQ(error_of(Sphere({0, 0}, nan), x, 2),
            "radius of a Sphere is nan: give a positive number");
  EXPECT_EQ(error_of(Cylinder({0, 0, 0}, {0, 0, 0}, 1), y, 3),
            "axis of a Cylinder is a zero vector: give a direction");
  EXPECT_EQ(error_of(Cylinder({0, 0}, {0, 1}, 1), x, 2),
            "a Cylinder needs 3D: in 2D take a Sphere");
}

/// Rotation from a to b by axis and angle (Rodrigues).
std::array<Vector<3>, 3> rotation_between(const Vector<3>& a,
                                          const Vector<3>& b)
{
  Vector<3> axis = cross(a, b);
  const double s = norm(axis), angle = std::atan2(s, dot(a, b));
  axis = (1 / s) * axis;
  std::array<Vector<3>, 3> R;
  for (int j = 0; j < 3; ++j)
  {
    Vector<3> e{};
    e[j] = 1;
    const Vector<3> v = std::cos(angle) * e + std::sin(angle) * cross(axis, e)
                        + ((1 - std::cos(angle)) * axis[j]) * axis;
    for (int i = 0; i < 3; ++i)
      R[i][j] = v[i];
  }
  return R;
}

TEST(Placement, TurnsOnTheShortestWay)
{
  Generator random(3);
  for (int sample = 0; sample < 100; ++sample)
  {
    const Vector<3> a = random.unit<3>(), b = random.unit<3>(),
                    p = random.vector<3>(-1, 1), q = random.vector<3>(-1, 1),
                    x = random.vector<3>(-1, 1);
    if (dot(a, b) < -0.9 or norm(cross(a, b)) < 1e-2)
      continue;
    const auto R = rotation_between(a, b);
    const Placement from{{p.begin(), p.end()}, {a.begin(), a.end()}},
        to{{q.begin(), q.end()}, {b.begin(), b.end()}};
    const auto turn = from.turn(to);
    const auto y = from.carry(x, to);
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(turn[3 * i + j], R[i][j], 1e-14);
      EXPECT_NEAR(y[i], q[i] + dot(R[i], x - p), 1e-14);
    }
    const auto back = to.carry(y, from);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(back[i], x[i], 1e-13);
  }
}

TEST(Placement, WithoutADirectionDoesNotTurn)
{
  const Placement from{{1, 2}, {}}, to{{3, 5}, {}};
  EXPECT_EQ(from.turn(to), (std::vector<double>{1, 0, 0, 1}));
  EXPECT_EQ(from.carry(std::vector<double>{1, 1}, to),
            (std::vector<double>{3, 4}));
}

TEST(Placement, AHalfTurnHasNoShortestWay)
{
  const Placement from{{0, 0}, {1, 0}}, to{{0, 0}, {-1, 0}};
  EXPECT_REFUSED(from.turn(to));
}

TEST(Placement, CarriesMaterialWithItsSpin)
{
  const double pi = std::numbers::pi;
  // In the plane, counter-clockwise about a centre that moves
  const Placement disc{{1, 2}, {}, {0.25}}, spun{{3, 2}, {}, {0.25 + pi / 2}};
  expect_near(disc.carry(std::vector<double>{2, 2, 1, 5}, spun), {3, 3, 0, 2},
              1e-14);
  // About an axis that turns from z to x, then about x
  const Placement rod{{0, 0, 0}, {0, 0, 1}, {1.0}};
  const Placement turned{{0, 0, 0}, {1, 0, 0}, {1.0 + pi / 2}};
  expect_near(rod.carry(std::vector<double>{0, 0, 2, 0, 1, 0}, turned),
              {2, 0, 0, 0, 0, 1}, 1e-14);
  // By rotation vectors: half a turn about z after a quarter about x
  const Placement ball{{0, 0, 0}, {}, {pi / 2, 0, 0}};
  const Placement other{{0, 0, 0}, {}, {0, 0, pi}};
  expect_near(ball.carry(std::vector<double>{0, 0, 1}, other), {0, -1, 0},
              1e-14);
  expect_near(other.carry(std::vector<double>{0, -1, 0}, ball), {0, 0, 1},
              1e-14);
  // The shape does not spin
  expect_near(disc.turn(spun), {1, 0, 0, 1}, 1e-14);
  // What does not spin stays, whatever the other one does
  const Placement still{{1, 2}, {}, {}};
  expect_near(still.carry(std::vector<double>{2, 2}, spun), {4, 2}, 1e-14);
}

TEST(Obstacles, SayHowFarTheyHaveSpun)
{
  Sphere sphere;
  sphere.place({0, 0}, 1, {0.5});
  EXPECT_EQ(sphere.placement(2).angle, std::vector{0.5});
  sphere.place({0, 0, 0}, 1, {0.5, 0, 1});
  EXPECT_EQ(sphere.placement(3).angle, (std::vector{0.5, 0.0, 1.0}));
  sphere.place({0, 0}, 1, {0.5, 0, 1});
  EXPECT_REFUSED(sphere.placement(2));
  sphere.place({0, 0, 0}, 1, {0.5});
  EXPECT_REFUSED(sphere.placement(3));
  Cylinder cylinder;
  cylinder.place({0, 0, 0}, {0, 0, 1}, 1, {0.5});
  EXPECT_EQ(cylinder.placement(3).angle, std::vector{0.5});
  cylinder.place({0, 0, 0}, {0, 0, 1}, 1, {std::nan("")});
  EXPECT_REFUSED(cylinder.placement(3));
}
} // namespace
