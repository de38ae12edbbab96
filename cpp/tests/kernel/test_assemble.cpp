// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "kernel_samples.h"
#include <contactx/kernel/assemble.h>

using namespace contactx;
using namespace contactx::kernel;
using namespace contactx::tests;

namespace
{
using Values = std::vector<double>;

/// Pairs of one kind on nodes and slave nodes whose numbers go back, with gaps
/// between them, and the arrays of these.
struct Scene
{
  Kind kind;
  std::vector<Sample> samples;
  Pairs pairs;
  Values displacement, position, multiplier, area, gap_derivative,
      slip_derivative, normal_derivative;

  /// The last sample twice, so that its pairs add up.
  explicit Scene(const Kind& k) : kind(k), samples(tests::samples(k))
  {
    samples.push_back(samples.back());
    pairs.num_slaves = k.num_slaves;
    pairs.num_nodes = k.num_nodes;
    pairs.data_size = pair_values(k.num_slaves, k.num_nodes, k.gdim);
    const auto table = coefficients(k.law, k.num_nodes, k.gdim, k.num_slaves);
    pairs.slip_size = table[static_cast<int>(Coefficient::slip)].size;
    for (std::size_t p = 0; p < samples.size(); ++p)
    {
      const std::size_t last = std::min(p, samples.size() - 2);
      const Sample& s = samples[p];
      add(pairs.data, s, Coefficient::pair, pairs.data_size);
      add(pairs.slip, s, Coefficient::slip, pairs.slip_size);
      const int width = k.num_slaves + k.num_nodes;
      for (int a = 0; a < width; ++a)
      {
        const int node = number(last, a, width);
        pairs.nodes.push_back(node);
        set(displacement, node, s, Coefficient::displacement, a, k.gdim);
        set(position, node, s, Coefficient::position, a, k.gdim);
      }
      for (int a = 0; a < k.num_slaves; ++a)
      {
        const int slave = number(last, a, k.num_slaves);
        pairs.slaves.push_back(slave);
        const int matrix = k.size() > 1 ? k.gdim * k.gdim : 0;
        set(multiplier, slave, s, Coefficient::multiplier, a, k.size());
        set(area, slave, s, Coefficient::area, a, 1);
        set(gap_derivative, slave, s, Coefficient::gap_derivative, a, k.size());
        set(slip_derivative, slave, s, Coefficient::slip_derivative, a, matrix);
        set(normal_derivative, slave, s, Coefficient::normal_derivative, a,
            matrix);
      }
    }
  }

  NodalArrays arrays() const
  {
    return {displacement,   position,        multiplier,       area,
            gap_derivative, slip_derivative, normal_derivative};
  }

  int num_nodes() const { return most(pairs.nodes); }
  int num_slaves() const { return most(pairs.slaves); }

  /// Matrix or vector of a term, dense: rows of nodes or of slave nodes.
  Values dense(std::string_view sliding, std::string_view term) const
  {
    const bool matrix
        = term == "stiffness" or term == "traction" or term == "constraint";
    const auto rows = dofs(term == "constraint" or !matrix
                               ? (term == "residual" ? 'n' : 's')
                               : 'n',
                           term == "gap" ? 1 : kind.size());
    const auto columns = !matrix              ? Dofs{1, {}}
                         : term == "traction" ? dofs('s', kind.size())
                                              : dofs('n', kind.size());
    Values A(rows.count * columns.count);
    for (std::size_t p = 0; p < samples.size(); ++p)
    {
      const Values tensor = samples[p](sliding, term);
      const std::size_t width = tensor.size() / rows.of_pair[p].size();
      for (std::size_t i = 0; i < tensor.size(); ++i)
      {
        const int column = matrix ? columns.of_pair[p][i % width] : 0;
        A[columns.count * rows.of_pair[p][i / width] + column] += tensor[i];
      }
    }
    return A;
  }

private:
  struct Dofs
  {
    int count;
    std::vector<std::vector<int>> of_pair;
  };

  static int most(const std::vector<std::int32_t>& numbers)
  {
    return std::ranges::max(numbers) + 1;
  }

  int number(std::size_t pair, int a, int width) const
  {
    const int count = static_cast<int>(samples.size()) * width;
    return 2 * (count - static_cast<int>(pair) * width - a);
  }

  static void add(Values& to, const Sample& s, Coefficient c, int size)
  {
    to.insert(to.end(), s.at(c), s.at(c) + size);
  }

  static void set(Values& to, int row, const Sample& s, Coefficient c, int a,
                  int size)
  {
    to.resize(std::max(to.size(), std::size_t(size) * (row + 1)), NAN);
    std::copy_n(s.at(c) + size * a, size, to.begin() + size * row);
  }

  Dofs dofs(char site, int size) const
  {
    const bool nodes = site == 'n';
    size = nodes ? kind.gdim : size;
    const auto& numbers = nodes ? pairs.nodes : pairs.slaves;
    Dofs d{size * most(numbers), {}};
    const std::size_t width = numbers.size() / samples.size();
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      if (i % width == 0)
        d.of_pair.emplace_back();
      for (int k = 0; k < size; ++k)
        d.of_pair.back().push_back(size * numbers[i] + k);
    }
    return d;
  }
};

const std::vector<std::string_view> slidings{"finite", "small"};

TEST(KernelAssembly, AddsVectorsOfEachKindOfPairs)
{
  for (const Kind& kind : kinds())
  {
    SCOPED_TRACE(testing::Message() << kind);
    const Scene scene(kind);
    for (const std::string_view sliding : slidings)
      for (const std::string_view term : {"gap", "normal", "slip", "residual"})
      {
        const bool exists = scene.samples[0].has(sliding, term);
        EXPECT_EQ(has_term(kind.law, sliding, term, scene.pairs, kind.gdim),
                  exists);
        const int size = term == "residual" ? kind.gdim * scene.num_nodes()
                                            : (term == "gap" ? 1 : kind.size())
                                                  * scene.num_slaves();
        Values b(size, 2.0);
        add_vector(kind.law, sliding, term, scene.pairs, scene.arrays(),
                   kind.gdim, b);
        Values expected
            = exists ? scene.dense(sliding, term) : Values(size, 0.0);
        for (double& v : expected)
          v += 2;
        expect_close(b, expected, 1e-14);
      }
  }
}

TEST(KernelAssembly, GivesMatricesOfEachKindOfPairsAsTriplets)
{
  for (const Kind& kind : kinds())
  {
    SCOPED_TRACE(testing::Message() << kind);
    const Scene scene(kind);
    for (const std::string_view sliding : slidings)
      for (const std::string_view term :
           {"stiffness", "traction", "constraint"})
      {
        const Triplets found = assemble_matrix(
            kind.law, sliding, term, scene.pairs, scene.arrays(), kind.gdim);
        if (!scene.samples[0].has(sliding, term))
        {
          EXPECT_TRUE(found.values.empty());
          continue;
        }
        const Values expected = scene.dense(sliding, term);
        const int columns = term == "traction"
                                ? kind.size() * scene.num_slaves()
                                : kind.gdim * scene.num_nodes();
        ASSERT_EQ(found.rows.size(), found.values.size());
        ASSERT_EQ(found.columns.size(), found.values.size());
        Values A(expected.size());
        for (std::size_t e = 0; e < found.values.size(); ++e)
          A.at(columns * found.rows[e] + found.columns[e]) += found.values[e];
        expect_close(A, expected, 1e-14);
      }
  }
}

TEST(KernelAssembly, HasThePlacesOfMatricesByThePairsAlone)
{
  Scene scene({Law::frictional, 4, 3, 1});
  const auto assemble = [&scene](std::string_view term)
  {
    return assemble_matrix(Law::frictional, "finite", term, scene.pairs,
                           scene.arrays(), 3);
  };
  const Triplets stiffness = assemble("stiffness");
  const Triplets constraint = assemble("constraint");
  EXPECT_EQ(stiffness.values.size(), scene.samples.size() * 15 * 15);
  for (Values* v : {&scene.multiplier, &scene.gap_derivative,
                    &scene.slip_derivative, &scene.normal_derivative})
    std::ranges::fill(*v, 0.0);
  for (const auto& [now, term] :
       {std::pair(stiffness, "stiffness"), std::pair(constraint, "constraint")})
  {
    const Triplets zero = assemble(term);
    EXPECT_EQ(largest(zero.values), 0);
    EXPECT_EQ(zero.rows, now.rows);
    EXPECT_EQ(zero.columns, now.columns);
  }
}

TEST(KernelAssembly, LeavesOutWhatIsBeyondTheVector)
{
  const Scene scene({Law::frictional, 3, 3, 3});
  Values all(scene.num_slaves());
  add_vector(Law::frictional, "finite", "gap", scene.pairs, scene.arrays(), 3,
             all);
  Values some(scene.num_slaves() / 2);
  add_vector(Law::frictional, "finite", "gap", scene.pairs, scene.arrays(), 3,
             some);
  EXPECT_GT(largest(some), 0);
  all.resize(some.size());
  EXPECT_EQ(some, all);
}

TEST(KernelAssembly, TakesSlipAndConstraintAloneOfPairsOfMovement)
{
  Scene scene({Law::tied, 3, 3, 3});
  scene.pairs.is_movement = true;
  const auto add = [&scene](Law law, std::string_view term)
  {
    Values b(3 * scene.num_nodes());
    add_vector(law, "finite", term, scene.pairs, scene.arrays(), 3, b);
    return b;
  };
  for (const Law law : {Law::frictional, Law::tied})
  {
    for (const std::string_view term : {"gap", "normal", "residual"})
      EXPECT_EQ(largest(add(law, term)), 0);
    for (const std::string_view term : {"stiffness", "traction"})
      EXPECT_FALSE(has_term(law, "finite", term, scene.pairs, 3));
    EXPECT_GT(assemble_matrix(law, "finite", "constraint", scene.pairs,
                              scene.arrays(), 3)
                  .values.size(),
              0);
  }
  const Values slip = add(Law::frictional, "slip");
  scene.pairs.is_movement = false;
  EXPECT_EQ(slip, add(Law::tied, "slip"));
  EXPECT_GT(largest(slip), 0);
}

/// Expect that the assembly refuses a changed scene for a reason, and leaves
/// the vector as it is.
template <class Change>
void expect_refused(Change&& change, const std::string& reason,
                    std::string_view term = "residual",
                    std::string_view sliding = "finite", int gdim = 3)
{
  Scene scene({Law::frictional, 3, 3, 1});
  Values b(3 * scene.num_nodes());
  change(scene, b);
  const Values before = b;
  expect_refusal(
      [&]
      {
        add_vector(scene.kind.law, sliding, term, scene.pairs, scene.arrays(),
                   gdim, b);
      },
      reason);
  EXPECT_EQ(b, before);
}

TEST(KernelAssembly, RefusesArgumentsThatDoNotFit)
{
  const auto as_it_is = [](Scene&, Values&) {};
  expect_refused(as_it_is, "the term must be gap", "stiffness");
  expect_refused(as_it_is, "the term must be gap", "gaps");
  expect_refused(as_it_is, "no kernel for medium", "gap", "medium");
  expect_refused(as_it_is, "gdim must be 2 or 3", "gap", "finite", 4);
  expect_refused([](Scene& s, Values&) { s.pairs.nodes[3] = -1; },
                 "pairs.nodes must be numbers of rows of displacement");
  expect_refused([](Scene& s, Values&) { s.pairs.nodes[3] = 100000; },
                 "there is 100000");
  expect_refused([](Scene& s, Values&) { s.pairs.slaves[0] = 100000; },
                 "pairs.slaves must be numbers of rows of multiplier");
  expect_refused([](Scene& s, Values&) { s.pairs.slaves[0] = -1; },
                 "pairs.slaves must not be negative", "gap");
  expect_refused([](Scene& s, Values&) { s.pairs.nodes.pop_back(); },
                 "pairs.nodes must have 36 values, 4 for each pair");
  expect_refused([](Scene& s, Values&) { s.pairs.data.pop_back(); },
                 "pairs.data must have 81 values, 9 for each pair");
  expect_refused([](Scene& s, Values&) { s.pairs.data_size = 8; },
                 "pairs.data_size must be 9");
  expect_refused([](Scene& s, Values&) { s.pairs.slip.clear(); },
                 "pairs.slip must have 54 values, 6 for each pair", "slip");
  expect_refused([](Scene& s, Values&) { s.pairs.num_slaves = 0; },
                 "pairs.num_slaves must be from 1 to 9");
  expect_refused([](Scene& s, Values&) { s.pairs.num_nodes = 10; },
                 "pairs.num_nodes must be from 0 to 9");
  expect_refused([](Scene& s, Values&) { s.area.clear(); },
                 "rows of area, of which there are 0");
  expect_refused([](Scene& s, Values&) { s.position.pop_back(); },
                 "position must have rows of 3 values");
  expect_refused([](Scene&, Values& b) { b.resize(3); },
                 "pairs.nodes must be numbers of rows of b");
  expect_refused([](Scene&, Values& b) { b.resize(10); },
                 "b must have rows of 3 values");
  expect_refused(
      [](Scene& s, Values&)
      {
        s.kind.law = Law::frictionless;
        s.pairs.is_movement = true;
      },
      "are for vector multipliers");
}

/// A slave facet before a fan of master facets that meet under it and cover it.
struct Fan
{
  Values position, displacement;
  std::vector<std::int32_t> slave_nodes, master_offsets, master_nodes;
  Values multiplier, area, gap_derivative, by_normal, by_slip;

  explicit Fan(Generator& random)
      : slave_nodes{0, 1, 2}, master_offsets{0}, by_slip(27, 0.0)
  {
    position = {-0.5, -0.4, 0, 0.6, -0.4, 0.05, 0, 0.7, -0.05};
    // The middle and the corners of a square, seen from above
    position.insert(position.end(), {0.1, 0.05, -0.3, -3, -3, -0.2, 3, -3, -0.3,
                                     3, 3, -0.1, -3, 3, -0.2});
    for (int c = 0; c < 4; ++c)
    {
      master_nodes.insert(master_nodes.end(), {3, 4 + c, 4 + (c + 1) % 4});
      master_offsets.push_back(3 * (c + 1));
    }
    // The master looks up: turn the slave facet over
    std::swap(slave_nodes[1], slave_nodes[2]);
    const Motion<3> motion(random, 1);
    for (std::size_t i = 0; i < position.size() / 3; ++i)
      std::ranges::copy(motion(vector_at(position, i, 3)), &position[3 * i]);
    displacement.resize(position.size());
    for (double& u : displacement)
      u = random(-0.02, 0.02);
    const auto fill = [&random](Values& v, int n)
    {
      for (int i = 0; i < n; ++i)
        v.push_back(random(0.3, 1));
    };
    fill(multiplier, 9);
    fill(area, 3);
    fill(gap_derivative, 9);
    fill(by_normal, 27);
  }

  NodalArrays arrays() const
  {
    return {displacement,   position, multiplier, area,
            gap_derivative, by_slip,  by_normal};
  }

  /// Pairs with their integrals at the displacement.
  Pairs pairs() const
  {
    Values x(position);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += displacement[i];
    search::FacetSearch search({0, 3}, slave_nodes, master_offsets,
                               master_nodes, 3);
    const auto found = search.find(x, INFINITY, 0);
    const auto all = geometry::integrals(search.slave(), search.master(), found,
                                         x, position, 3);
    const MortarLayout at(3, 3);
    Pairs p;
    p.num_slaves = p.num_nodes = 3;
    p.data_size = at.size;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      p.slaves.insert(p.slaves.end(), {0, 1, 2});
      p.nodes.insert(p.nodes.end(), slave_nodes.begin(), slave_nodes.end());
      const auto first = master_nodes.begin() + 3 * found.master[i];
      p.nodes.insert(p.nodes.end(), first, first + 3);
      Values data(at.size);
      constexpr int most = geometry::most_nodes;
      for (int s = 0; s < 3; ++s)
      {
        std::copy_n(&all.weight[most * (most * i + s)], 3,
                    &data[at.weight + 3 * s]);
        std::copy_n(&all.dual[most * s], 3, &data[at.dual + 3 * s]);
        data[at.gap + s] = all.gap[most * i + s];
      }
      std::copy_n(all.normal.begin(), 3, &data[at.normal]);
      p.data.insert(p.data.end(), data.begin(), data.end());
    }
    return p;
  }

  Values vector(Law law, std::string_view term, int rows) const
  {
    Values b(rows);
    add_vector(law, "finite", term, pairs(), arrays(), 3, b);
    return b;
  }

  Values matrix(Law law, std::string_view term, int rows) const
  {
    Values A(rows * position.size());
    const Triplets t
        = assemble_matrix(law, "finite", term, pairs(), arrays(), 3);
    for (std::size_t e = 0; e < t.values.size(); ++e)
      A[position.size() * t.rows[e] + t.columns[e]] += t.values[e];
    return A;
  }

  /// Derivative of a vector by the displacement.
  Values difference(Law law, std::string_view term, int rows) const
  {
    constexpr double h = 1e-4;
    const int n = static_cast<int>(position.size());
    Values result(rows * n);
    for (int j = 0; j < n; ++j)
      for (const auto& [step, factor] :
           {std::pair(h, 8.), {-h, -8.}, {2 * h, -1.}, {-2 * h, 1.}})
      {
        Fan moved = *this;
        moved.displacement[j] += step;
        const Values b = moved.vector(law, term, rows);
        for (int i = 0; i < rows; ++i)
          result[n * i + j] += factor * b[i] / (12 * h);
      }
    return result;
  }
};

// What moves from one facet to the next is left out of each
TEST(KernelAssembly, OfAllFacetsBeforeASlaveFacetIsConsistent)
{
  Generator random(5);
  for (int i = 0; i < 3; ++i)
  {
    const Fan fan(random);
    ASSERT_EQ(fan.pairs().size(), 4u);
    const int dofs = static_cast<int>(fan.position.size());
    for (const Law law : {Law::frictionless, Law::frictional})
    {
      expect_close(fan.matrix(law, "stiffness", dofs),
                   fan.difference(law, "residual", dofs), 1e-7);
      const int size = law == Law::frictionless ? 1 : 3;
      const Values dg = fan.difference(law, "gap", 3);
      Values expected(3 * size * dofs);
      for (int row = 0; row < 3 * size; ++row)
        for (int j = 0; j < dofs; ++j)
          expected[dofs * row + j]
              += fan.gap_derivative[row] * dg[dofs * (row / size) + j];
      if (law == Law::frictional)
      {
        const Values dn = fan.difference(law, "normal", 9);
        for (int row = 0; row < 9; ++row)
          for (int k = 0; k < 3; ++k)
            for (int j = 0; j < dofs; ++j)
              expected[dofs * row + j] += fan.by_normal[3 * row + k]
                                          * dn[dofs * (row - row % 3 + k) + j];
      }
      expect_close(fan.matrix(law, "constraint", 3 * size), expected, 1e-7);
    }
  }
}
} // namespace
