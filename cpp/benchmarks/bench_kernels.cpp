// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// Pairs a second and core that the kernels evaluate, called as an assembler
// calls them: through their address, on packed coefficients, into a cleared
// local tensor.

#include "table.h"
#include <cmath>
#include <contactx/facet/ridge.h>
#include <contactx/kernel/registry.h>
#include <random>

using namespace contactx;
using namespace contactx::benchmarks;
using namespace contactx::kernel;

namespace
{
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
  facet::Nodes<F> master;
  for (int l = 0; l < F::nodes; ++l)
    for (int k = 0; k < D; ++k)
      master[l][k] = (k < F::tdim ? F::vertices[l][k] : 0) + 0.1 * unit(random);
  facet::Local<F> xi;
  for (double& c : xi)
    c = 0.1 + 0.4 * unit(random);
  Vec<3> cone{};
  if (feature > F::num_edges)
    xi = F::vertices[feature - 1 - F::num_edges];
  else if (feature > 0)
  {
    const auto [i, j] = facet::feature_edge<F>(feature);
    xi = 0.4 * F::vertices[i] + 0.6 * F::vertices[j];
  }
  if (feature > 0)
    cone = {0, D == 2 ? 0 : 0.6, D == 2 ? 1 : 0.8};
  const auto normal = facet::frame<F>(master, xi).n;
  const double gap = 0.01 * unit(random);
  const auto slave = facet::combine<F>(F::shape(xi), master) + gap * normal;
  double* x = at(Coefficient::position);
  double* u = at(Coefficient::displacement);
  for (int a = 0; a <= F::nodes; ++a)
    for (int k = 0; k < D; ++k)
    {
      u[D * a + k] = 1e-3 * unit(random);
      x[D * a + k] = a == 0 ? slave[k] : master[a - 1][k];
    }
  // What the search found lies near, not at the projection
  double* p = at(Coefficient::pair);
  p[pair_feature] = feature;
  for (int a = 0; a < F::tdim; ++a)
    p[pair_xi + a] = xi[a] + 0.02 * unit(random);
  std::copy(cone.begin(), cone.end(), p + pair_cone);
  std::copy(normal.begin(), normal.end(), p + pair_normal);
  if (law != Law::frictionless)
  {
    double* s = at(Coefficient::slip);
    for (int a = 0; a < F::tdim; ++a)
      s[slip_xi + a] = xi[a] + 0.05 * unit(random);
    s[slip_gap] = gap;
  }
  const int end = at(Coefficient::multiplier) - w;
  const auto table = coefficients(law, F::nodes, D);
  int size = 0;
  for (std::size_t c = std::size_t(Coefficient::multiplier); c < table.size();
       ++c)
    size += table[c].size;
  for (int i = end; i < end + size; ++i)
    w[i] = 0.5 + unit(random);
}

template <class F>
Coefficients fill(Law law, int feature, int num_pairs)
{
  std::mt19937 random(1);
  const int last
      = offset(law, Coefficient::normal_derivative, F::nodes, F::gdim);
  const int stride = last + coefficients(law, F::nodes, F::gdim).back().size;
  Coefficients c{std::vector<double>(std::size_t(stride) * num_pairs), stride};
  for (int i = 0; i < num_pairs; ++i)
    fill_pair<F>(c.values.data() + std::size_t(i) * stride, law, feature,
                 random);
  return c;
}

/// Seconds a pair of one kernel, zero where there is none.
double time(Law law, std::string_view sliding, std::string_view term,
            int num_nodes, int gdim, const Coefficients& c, int num_pairs)
{
  const Entry* entry = nullptr;
  for (const Entry& e : registry())
    if (e.law == law and e.sliding == sliding and e.term == term
        and e.num_nodes == num_nodes and e.gdim == gdim)
      entry = &e;
  if (!entry)
    return 0;
  // Rows and columns of the local tensor
  const int dofs = gdim * (num_nodes + 1);
  const int dim = law == Law::frictionless ? 1 : gdim;
  const int size = term == "gap"                        ? 1
                   : term == "normal" or term == "slip" ? gdim
                   : term == "residual"                 ? dofs
                   : term == "stiffness"                ? dofs * dofs
                                                        : dofs * dim;
  std::vector<double> A(size);
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

template <class F>
void run(Table& table, std::string_view facet)
{
  constexpr int num_pairs = 20000;
  const std::vector<std::pair<Law, std::string>> laws{
      {Law::frictionless, "frictionless"},
      {Law::frictional, "frictional"},
      {Law::tied, "tied"}};
  // A segment has no edges but its vertices
  const std::vector<std::pair<int, std::string>> features{
      {facet::interior, "interior"},
      {1, F::num_edges > 0 ? "edge" : "vertex"},
      {1 + F::num_edges, "vertex"}};
  for (const auto& [law, law_name] : laws)
    for (std::string_view sliding : {"finite", "small"})
      for (const auto& [feature, feature_name] : features)
      {
        // These read nothing of the feature
        if (feature > 0 and (law == Law::tied or sliding == "small"))
          continue;
        if (F::num_edges == 0 and &feature == &features.back().first)
          continue;
        const Coefficients c = fill<F>(law, feature, num_pairs);
        const auto cost = [&](std::string_view term)
        { return time(law, sliding, term, F::nodes, F::gdim, c, num_pairs); };
        const double gap = cost("gap"), normal = cost("normal"),
                     slip = cost("slip"), residual = cost("residual"),
                     stiffness = cost("stiffness"), traction = cost("traction"),
                     constraint = cost("constraint");
        const auto rate = [](double t)
        { return t > 0 ? number(1e-6 / t) : std::string("-"); };
        table.row({std::string(facet), law_name, std::string(sliding),
                   feature_name, rate(gap), rate(residual), rate(stiffness),
                   rate(traction), rate(constraint),
                   rate(gap + normal + slip + residual),
                   rate(stiffness + traction + constraint)});
      }
}
} // namespace

int main(int argc, char** argv)
{
  const std::string folder = argc > 1 ? std::string(argv[1]) + "/" : "";
  std::cout << "\nMillions of pairs a second. Residual: all the vectors of an "
               "evaluation;\nJacobian: stiffness, traction and constraint\n";
  Table table(folder + "kernels.csv",
              {"facet", "law         ", "sliding", "feature", "gap", "forces",
               "stiffness", "traction", "constraint", "residual", "jacobian"});
  run<facet::Segment>(table, "segment");
  run<facet::Triangle>(table, "triangle");
  run<facet::Quadrilateral>(table, "quad");
}
