// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// Pairs a second and core that the kernels evaluate, called as an assembler
// calls them: through their address, on packed coefficients, into a cleared
// local tensor.

#include "facing.h"
#include "table.h"
#include <cmath>
#include <contactx/geometry/ridge.h>
#include <contactx/kernel/registry.h>

using namespace contactx;
using namespace contactx::benchmarks;
using namespace contactx::kernel;

namespace
{
constexpr int num_pairs = 20000;

const std::vector<std::pair<Law, std::string>> laws{
    {Law::frictionless, "frictionless"},
    {Law::frictional, "frictional"},
    {Law::tied, "tied"}};

/// Coefficients of many pairs, one after another.
struct Coefficients
{
  std::vector<double> values;
  int stride;
};

/// A pair whose slave node is above the point `xi` of a random facet.
template <class F>
void fill_pair(double* w, Law law, int feature, std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int D = F::gdim;
  const auto at
      = [w, law](Coefficient c) { return w + offset(law, c, F::nodes, D); };
  geometry::Nodes<F> master;
  for (int l = 0; l < F::nodes; ++l)
    for (int k = 0; k < D; ++k)
      master[l][k] = (k < F::tdim ? F::vertices[l][k] : 0) + 0.1 * unit(random);
  geometry::Local<F> xi;
  for (double& c : xi)
    c = 0.1 + 0.4 * unit(random);
  Vector<3> cone{};
  if (feature > F::num_edges)
    xi = F::vertices[feature - 1 - F::num_edges];
  else if (feature > 0)
  {
    const auto [i, j] = geometry::feature_edge<F>(feature);
    xi = 0.4 * F::vertices[i] + 0.6 * F::vertices[j];
  }
  if (feature > 0)
    cone = {0, D == 2 ? 0 : 0.6, D == 2 ? 1 : 0.8};
  const auto normal = geometry::frame<F>(master, xi).n;
  const double gap = 0.01 * unit(random);
  const auto slave = geometry::combine<F>(F::shape(xi), master) + gap * normal;
  double* x = at(Coefficient::position);
  double* u = at(Coefficient::displacement);
  for (int a = 0; a <= F::nodes; ++a)
    for (int k = 0; k < D; ++k)
    {
      u[D * a + k] = 1e-3 * unit(random);
      x[D * a + k] = a == 0 ? slave[k] : master[a - 1][k];
    }
  // What the search found lies near, not at the projection
  FacetPair pair;
  pair.feature = feature;
  for (int a = 0; a < F::tdim; ++a)
    pair.xi[a] = xi[a] + 0.02 * unit(random);
  pair.cone = cone;
  std::copy(normal.begin(), normal.end(), pair.normal.begin());
  std::ranges::copy(values_of(std::span<const FacetPair>(&pair, 1)),
                    at(Coefficient::pair));
  if (law != Law::frictionless)
  {
    FacetSlip slip;
    for (int a = 0; a < F::tdim; ++a)
      slip.xi[a] = xi[a] + 0.05 * unit(random);
    slip.gap = gap;
    std::ranges::copy(values_of(std::span<const FacetSlip>(&slip, 1)),
                      at(Coefficient::slip));
  }
}

/// Coefficients of random pairs: geometry(w, random) fills what a search finds,
/// the law's numbers follow.
template <class Geometry>
Coefficients fill(Law law, int num_nodes, int gdim, int num_slaves,
                  Geometry&& geometry)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto at = [=](Coefficient c)
  { return offset(law, c, num_nodes, gdim, num_slaves); };
  const int stride = coefficient_values(law, num_nodes, gdim, num_slaves);
  Coefficients c{std::vector<double>(std::size_t(stride) * num_pairs), stride};
  for (int i = 0; i < num_pairs; ++i)
  {
    double* w = c.values.data() + std::size_t(i) * stride;
    geometry(w, random);
    for (int j = at(Coefficient::multiplier); j < stride; ++j)
      w[j] = 0.5 + unit(random);
  }
  return c;
}

/// Seconds a pair of one kernel, zero where there is none.
double time(Law law, std::string_view sliding, std::string_view term,
            int num_nodes, int gdim, int num_slaves, const Coefficients& c)
{
  const Entry* entry
      = find_if_any(law, sliding, term, num_nodes, gdim, num_slaves);
  if (!entry)
    return 0;
  const Shape size = shape(*entry);
  std::vector<double> A(size.rows * size.columns);
  double sum = 0;
  const double t = best_seconds(
      7,
      [&]
      {
        for (int i = 0; i < num_pairs; ++i)
        {
          std::fill(A.begin(), A.end(), 0.0);
          entry->function(A.data(), c.values.data() + std::size_t(i) * c.stride,
                          nullptr, nullptr, nullptr, nullptr, nullptr);
          sum += A[0];
        }
      });
  if (!std::isfinite(sum))
    throw std::runtime_error("a kernel gave no number");
  return t / num_pairs;
}

/// Add a row: what all the kernels of a law cost.
void add_row(Table& table, const std::vector<std::string>& name, Law law,
             std::string_view sliding, int num_nodes, int gdim, int num_slaves,
             const Coefficients& c)
{
  const auto cost = [&](std::string_view term)
  { return time(law, sliding, term, num_nodes, gdim, num_slaves, c); };
  const double gap = cost("gap"), normal = cost("normal"), slip = cost("slip"),
               residual = cost("residual"), stiffness = cost("stiffness"),
               traction = cost("traction"), constraint = cost("constraint");
  const auto rate
      = [](double t) { return t > 0 ? number(1e-6 / t) : std::string("-"); };
  std::vector<std::string> cells = name;
  for (const double t :
       {gap, residual, stiffness, traction, constraint,
        gap + normal + slip + residual, stiffness + traction + constraint})
    cells.push_back(rate(t));
  table.row(cells);
}

template <class F>
void run(Table& table, const std::string& facet)
{
  // A segment has no edges but its vertices
  const std::vector<std::pair<int, std::string>> features{
      {geometry::interior, "interior"},
      {1, F::num_edges > 0 ? "edge" : "vertex"},
      {1 + F::num_edges, "vertex"}};
  for (const auto& [law, law_name] : laws)
    for (const std::string sliding : {"finite", "small"})
      for (const auto& [feature, feature_name] : features)
      {
        // These read nothing of the feature
        if (feature > 0 and (law == Law::tied or sliding == "small"))
          continue;
        if (F::num_edges == 0 and &feature == &features.back().first)
          continue;
        const Coefficients c
            = fill(law, F::nodes, F::gdim, 1,
                   [law, feature](double* w, std::mt19937& random)
                   { fill_pair<F>(w, law, feature, random); });
        add_row(table, {facet, law_name, sliding, feature_name}, law, sliding,
                F::nodes, F::gdim, 1, c);
      }
}

template <class S, class M>
void run_facing(Table& table, const std::string& slave,
                const std::string& master)
{
  for (const auto& [law, law_name] : laws)
    for (const std::string sliding : {"finite", "small"})
    {
      const Coefficients c = fill(law, M::nodes, S::gdim, S::nodes,
                                  [law](double* w, std::mt19937& random)
                                  { fill_facing<S, M>(w, law, random); });
      add_row(table, {slave, master, law_name, sliding}, law, sliding, M::nodes,
              S::gdim, S::nodes, c);
    }
}
} // namespace

int main(int argc, char** argv)
{
  using namespace geometry;
  const std::string folder = argc > 1 ? std::string(argv[1]) + "/" : "";
  std::cout << "\nMillions of pairs a second. Residual: all the vectors of an "
               "evaluation;\nJacobian: stiffness, traction and constraint\n";
  const std::vector<std::string> terms{"gap",      "forces",     "stiffness",
                                       "traction", "constraint", "residual",
                                       "jacobian"};
  const auto head = [&terms](std::vector<std::string> names)
  {
    names.insert(names.end(), terms.begin(), terms.end());
    return names;
  };
  Table nodes(folder + "kernels.csv",
              head({"facet", "law         ", "sliding", "feature"}));
  run<Segment>(nodes, "segment");
  run<Triangle>(nodes, "triangle");
  run<Quadrilateral>(nodes, "quad");
  std::cout << "\nPairs of facets\n";
  Table facets(folder + "kernels_facets.csv",
               head({"slave", "master", "law         ", "sliding"}));
  run_facing<Segment, Segment>(facets, "segment", "segment");
  run_facing<Triangle, Triangle>(facets, "triangle", "triangle");
  run_facing<Triangle, Quadrilateral>(facets, "triangle", "quad");
  run_facing<Quadrilateral, Triangle>(facets, "quad", "triangle");
  run_facing<Quadrilateral, Quadrilateral>(facets, "quad", "quad");
}
