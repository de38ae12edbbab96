// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "kernel_samples.h"

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
using Values = std::vector<double>;

/// Kernels of a slave node over the facet F.
template <class F>
class KernelsOver : public testing::Test
{
public:
  static constexpr int gdim = F::gdim;

  /// Samples over the interior, or over anything, of a law.
  static std::vector<Sample> of(Law law, bool interior)
  {
    std::vector<Sample> all = samples({law, F::nodes, gdim, 1});
    if (interior)
      std::erase_if(all, [](const Sample& s) { return s.feature != 0; });
    return all;
  }

  static Vector<gdim> vector(const Values& v, int i = 0)
  {
    Vector<gdim> x;
    std::copy_n(&v[gdim * i], gdim, x.begin());
    return x;
  }

  static Nodes<F> master(const Sample& s)
  {
    Nodes<F> x;
    for (int l = 0; l < F::nodes; ++l)
      x[l] = vector(s.positions(), 1 + l);
    return x;
  }

  static Local<F> local(const double* xi)
  {
    Local<F> x;
    std::copy_n(xi, F::tdim, x.begin());
    return x;
  }

  template <std::size_t D>
  static void expect_near(const std::array<double, D>& a,
                          const std::array<double, D>& b)
  {
    EXPECT_LE(norm(a - b), 1e-13);
  }
};

TYPED_TEST_SUITE(KernelsOver, FacetTypes);

TYPED_TEST(KernelsOver, GiveTheDistanceFromTheFacetAlongItsOutwardNormal)
{
  using F = TypeParam;
  for (Sample s : this->of(Law::frictionless, true))
  {
    *s.at(Coefficient::gap_derivative) = 1;
    const auto x = this->master(s);
    const auto slave = this->vector(s.positions());
    const double gap = s("finite", "gap")[0];
    // By the slave node's position: the unit normal
    const Values dg = s("finite", "constraint");
    const auto normal = this->vector(dg);
    EXPECT_NEAR(norm(normal), 1, 1e-14);
    // By the nodes: their weights at the foot times -n
    Vector<F::nodes> N;
    for (int l = 0; l < F::nodes; ++l)
      N[l] = -dot(this->vector(dg, 1 + l), normal);
    this->expect_near(combine<F>(N, x), slave - gap * normal);
    // The foot is a point of the facet, and its outward normal is that
    Local<F> xi;
    if constexpr (F::nodes == 2)
      xi = {N[1]};
    else if constexpr (F::nodes == 3)
      xi = {N[1], N[2]};
    else
      xi = {N[1] + N[3], N[2] + N[3]};
    this->expect_near(F::shape(xi), N);
    this->expect_near(frame<F>(x, xi).n, normal);
  }
}

TYPED_TEST(KernelsOver, MeasureAtTheSearchesPointInSmallSliding)
{
  using F = TypeParam;
  for (const Sample& s : this->of(Law::frictionless, false))
  {
    const auto p = kernel::read<kernel::FacetPair>(s.at(Coefficient::pair));
    const auto xi = this->local(p.xi.data());
    const auto N = F::shape(xi);
    Vector<F::gdim> normal;
    std::copy_n(p.normal.begin(), F::gdim, normal.begin());
    const auto d = this->vector(s.positions()) - combine<F>(N, this->master(s));
    EXPECT_NEAR(s("small", "gap")[0], dot(normal, d), 1e-14);
    const Values forces = s("small", "residual");
    const double force
        = *s.at(Coefficient::area) * *s.at(Coefficient::multiplier);
    this->expect_near(this->vector(forces), -force * normal);
    for (int l = 0; l < F::nodes; ++l)
      this->expect_near(this->vector(forces, 1 + l), force * N[l] * normal);
  }
}

TYPED_TEST(KernelsOver, SlipAcrossTheNormalFromThePointThatTheNodeWasOver)
{
  using F = TypeParam;
  for (Sample s : this->of(Law::frictional, false))
  {
    auto from = kernel::read<kernel::FacetSlip>(s.at(Coefficient::slip));
    from.gap = 0;
    put(s.at(Coefficient::slip), from);
    const auto start
        = position<F>(this->master(s), this->local(from.xi.data()));
    for (const std::string_view sliding : {"finite", "small"})
    {
      const auto n = this->vector(s(sliding, "normal"));
      EXPECT_NEAR(norm(n), 1, 1e-14);
      EXPECT_NEAR(dot(this->vector(s(sliding, "slip")), n), 0, 1e-14);
    }
    if (s.feature != 0)
      continue;
    const auto normal = this->vector(s("finite", "normal"));
    const auto foot
        = this->vector(s.positions()) - s("finite", "gap")[0] * normal;
    const auto way = foot - start;
    this->expect_near(this->vector(s("finite", "slip")),
                      way - dot(way, normal) * normal);
  }
}

TYPED_TEST(KernelsOver, MeasureATieFromItsPlaceInTheTurningFrame)
{
  using F = TypeParam;
  for (const Sample& s : this->of(Law::tied, false))
  {
    const auto from = kernel::read<kernel::FacetSlip>(s.at(Coefficient::slip));
    const auto xi = this->local(from.xi.data());
    const auto x = this->master(s);
    const auto n = frame<F>(x, xi).n;
    const auto d = this->vector(s.positions()) - position<F>(x, xi);
    this->expect_near(this->vector(s("finite", "slip")), d - from.gap * n);
    this->expect_near(this->vector(s("finite", "normal")), n);
    EXPECT_NEAR(s("finite", "gap")[0], dot(n, d), 1e-14);
  }
}

/// Values of an obstacle's pair that a kernel gives as they are.
Values part(const double* values, int first, int count, double factor = 1)
{
  Values result(values + first, values + first + count);
  for (double& v : result)
    v *= factor;
  return result;
}

TEST_SAMPLES(KernelsOfObstacles, GiveWhatTheyAreGivenAtANode)
{
  if (!s.kind.is_rigid() or s.kind.is_mortar())
    return;
  const int gdim = s.kind.gdim;
  const double area = *s.at(Coefficient::area);
  const auto pair = kernel::read<kernel::ObstaclePair>(s.at(Coefficient::pair));
  const double* lambda = s.at(Coefficient::multiplier);
  const Values normal = part(pair.normal.data(), 0, gdim);
  for (const std::string_view sliding : {"finite", "small"})
  {
    EXPECT_EQ(s(sliding, "gap"), Values{pair.gap});
    if (s.kind.law == Law::frictionless)
    {
      expect_close(s(sliding, "residual"),
                   part(normal.data(), 0, gdim, -area * *lambda), 1e-15);
      continue;
    }
    EXPECT_EQ(s(sliding, "normal"), normal);
    EXPECT_EQ(s(sliding, "slip"), part(s.at(Coefficient::slip), 0, gdim));
    expect_close(s(sliding, "residual"), part(lambda, 0, gdim, -area), 1e-15);
  }
}

TEST_SAMPLES(KernelsOfObstacles, DivideIntegralsByTheAreasOfTheNodes)
{
  if (!s.kind.is_rigid() or !s.kind.is_mortar())
    return;
  const auto [law, m, gdim, n] = s.kind;
  const kernel::RigidMortarLayout at(n, gdim);
  const double* pair = s.at(Coefficient::pair);
  const double* area = s.at(Coefficient::area);
  const double* lambda = s.at(Coefficient::multiplier);
  const Values x = s.positions();
  Values gap, normal, slip, residual;
  for (int a = 0; a < n; ++a)
  {
    gap.push_back(pair[at.gap + a] / area[a]);
    for (int i = gdim * a; i < gdim * (a + 1); ++i)
    {
      normal.push_back(pair[at.normal + i] / area[a]);
      slip.push_back(pair[at.area + a] / area[a] * x[i]);
      residual.push_back(law == Law::frictionless
                             ? -lambda[a] * pair[at.normal + i]
                             : -lambda[i] * pair[at.area + a]);
    }
  }
  for (const std::string_view sliding : {"finite", "small"})
  {
    expect_close(s(sliding, "gap"), gap, 1e-15);
    expect_close(s(sliding, "residual"), residual, 1e-15);
    if (law == Law::frictionless)
      continue;
    expect_close(s(sliding, "normal"), normal, 1e-15);
    expect_close(s(sliding, "slip"), slip, 1e-15);
  }
}

TEST(KernelRegistry, HasOneKernelOfEachDescription)
{
  for (const kernel::Entry& e : kernel::registry())
    EXPECT_EQ(
        &find(e.law, e.sliding, e.term, e.num_nodes, e.gdim, e.num_slaves), &e);
}

TEST(KernelRegistry, TellsWhatThereIsNot)
{
  using kernel::find;
  EXPECT_REFUSED(find(Law::frictionless, "finite", "gap", 5, 3));
  EXPECT_REFUSED(find(Law::frictionless, "small", "stiffness", 3, 3));
  EXPECT_REFUSED(find(Law::frictionless, "medium", "gap", 3, 3));
  EXPECT_REFUSED(find(Law::frictionless, "finite", "x", 3, 3));
  for (const Law law : {Law::frictional, Law::tied})
    EXPECT_REFUSED(find(law, "finite", "stiffness", 0, 3));
}

/// Derivative of f(step) at zero by four steps, of fourth order.
template <class Function>
Values derivative(Function&& f, double h)
{
  const Values a = f(h), b = f(-h), c = f(2 * h), d = f(-2 * h);
  Values result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    result[i] = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * h);
  return result;
}

/// Derivative of f(sample) by one coefficient, [rows][columns].
template <class Function>
Values derivative_by(const Sample& sample, Coefficient by, int columns,
                     bool follow, Function&& f)
{
  Values result;
  for (int j = 0; j < columns; ++j)
  {
    const Values column = derivative(
        [&](double step)
        {
          Sample moved = sample;
          moved.at(by)[j] += step;
          if (follow and moved.renew)
            moved.renew(moved);
          return f(moved);
        },
        2e-4);
    result.resize(column.size() * columns);
    for (std::size_t i = 0; i < column.size(); ++i)
      result[columns * i + j] = column[i];
  }
  return result;
}

/// Derivative of a term by the displacement. In finite sliding the pair's data
/// follow it.
Values by_displacement(const Sample& sample, std::string_view sliding,
                       std::string_view term)
{
  return derivative_by(sample, Coefficient::displacement,
                       sample.kind.num_dofs(), sliding == "finite",
                       [=](const Sample& s) { return s(sliding, term); });
}

/// Derivative of the complementarity function through gap, slip and normal.
Values expected_constraint(const Sample& sample, std::string_view sliding)
{
  const Kind& kind = sample.kind;
  const int size = kind.size(), dofs = kind.num_dofs(), gdim = kind.gdim;
  Values result(kind.num_slaves * size * dofs);
  // A tie to facets measures movement alone
  const bool moves_alone = kind.law == Law::tied and !kind.is_rigid();
  if (!moves_alone)
  {
    const Values dg = by_displacement(sample, sliding, "gap");
    for (int row = 0; row < kind.num_slaves * size; ++row)
      for (int j = 0; j < dofs; ++j)
        result[dofs * row + j] += sample.at(Coefficient::gap_derivative)[row]
                                  * dg[dofs * (row / size) + j];
  }
  const auto add = [&](Coefficient by, std::string_view term)
  {
    if (!sample.has(sliding, term))
      return;
    const Values d = by_displacement(sample, sliding, term);
    for (int row = 0; row < kind.num_slaves * gdim; ++row)
      for (int k = 0; k < gdim; ++k)
        for (int j = 0; j < dofs; ++j)
          result[dofs * row + j] += sample.at(by)[gdim * row + k]
                                    * d[dofs * (row - row % gdim + k) + j];
  };
  if (kind.law != Law::frictionless)
  {
    add(Coefficient::slip_derivative, "slip");
    if (!moves_alone)
      add(Coefficient::normal_derivative, "normal");
  }
  return result;
}

/// A facet's share in a slave facet that lies in front of several is consistent
/// together with theirs alone: what moves from one to the next is left out.
bool is_share(const Sample& s)
{
  return s.kind.is_mortar() and !s.kind.is_rigid() and !s.covers
         and s.kind.law != Law::tied;
}

TEST_SAMPLES(KernelDerivatives, StiffnessIsThatOfTheForces)
{
  if (is_share(s))
    return;
  const Values expected = by_displacement(s, "finite", "residual");
  Values computed(expected.size());
  if (s.has("finite", "stiffness"))
    computed = s("finite", "stiffness");
  const int size = s.kind.num_slaves * s.kind.size();
  const double* p = s.at(Coefficient::multiplier);
  // A tie has none without a gap
  const double unit = s.kind.law == Law::tied or !largest(computed)
                          ? largest(Values(p, p + size))
                          : 0;
  expect_close(computed, expected, 1e-7, unit);
}

TEST_SAMPLES(KernelDerivatives, SmallSlidingHasNoStiffness)
{
  EXPECT_FALSE(s.has("small", "stiffness"));
  const Values before = s("small", "residual");
  for (int i = 0; i < s.kind.num_dofs(); ++i)
    s.at(Coefficient::displacement)[i] += 0.1 * (i + 1);
  EXPECT_EQ(s("small", "residual"), before);
}

TEST_SAMPLES(KernelDerivatives, TractionIsThatOfTheForcesByTheMultiplier)
{
  for (const std::string_view sliding : {"finite", "small"})
  {
    const Values expected = derivative_by(
        s, Coefficient::multiplier, s.kind.num_slaves * s.kind.size(), false,
        [=](const Sample& moved) { return moved(sliding, "residual"); });
    expect_close(s(sliding, "traction"), expected, 1e-10);
  }
}

TEST_SAMPLES(KernelDerivatives, ConstraintIsThatThroughGapSlipAndNormal)
{
  if (!is_share(s))
  {
    const Values expected = expected_constraint(s, "finite");
    expect_close(s("finite", "constraint"), expected, 1e-7);
  }
  if (s.kind.is_rigid())
  {
    // An obstacle's data stay, and the kernels are those of finite
    // sliding
    EXPECT_EQ(s("small", "constraint"), s("finite", "constraint"));
  }
  else
  {
    const Values expected = expected_constraint(s, "small");
    expect_close(s("small", "constraint"), expected, 1e-7);
  }
}

TEST_SAMPLES(KernelDerivatives,
             AreZeroWithoutMultiplierAndWithoutComplementarity)
{
  Sample blind = s;
  const auto first = s.at(Coefficient::gap_derivative) - s.w.data();
  std::fill(blind.w.begin() + first, blind.w.end(), 0.0);
  std::fill_n(s.at(Coefficient::multiplier), s.kind.num_slaves * s.kind.size(),
              0.0);
  for (const std::string_view sliding : {"finite", "small"})
  {
    EXPECT_EQ(largest(blind(sliding, "constraint")), 0);
    EXPECT_EQ(largest(s(sliding, "residual")), 0);
  }
  if (s.has("finite", "stiffness"))
  {
    EXPECT_EQ(largest(s("finite", "stiffness")), 0);
  }
}

} // namespace
