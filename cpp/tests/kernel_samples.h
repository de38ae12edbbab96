// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "facets.h"
#include <contactx/geometry/ridge.h>
#include <contactx/kernel/registry.h>
#include <contactx/search/facet_search.h>
#include <functional>
#include <ostream>

namespace contactx::tests
{
using kernel::Coefficient;
using kernel::Law;

/// @brief Kind of pairs that has kernels.
struct Kind
{
  Law law;
  int num_nodes, gdim, num_slaves;

  bool operator==(const Kind&) const = default;

  /// @brief Components of the multiplier.
  int size() const { return law == Law::frictionless ? 1 : gdim; }

  /// @brief Displacements of a pair.
  int num_dofs() const { return gdim * (num_slaves + num_nodes); }

  bool is_rigid() const { return num_nodes == 0; }

  /// @brief Whether pairs are those of facets, with integrals.
  bool is_mortar() const { return num_slaves > 1; }
};

inline std::ostream& operator<<(std::ostream& out, const Kind& k)
{
  return out << (k.law == Law::frictionless ? "frictionless"
                 : k.law == Law::frictional ? "frictional"
                                            : "tied")
             << ", slave nodes " << k.num_slaves << ", master nodes "
             << k.num_nodes << ", " << k.gdim << "D";
}

/// @brief All kinds of the registry but those of quadratic facets, of which one
/// pair of parts says nothing: scenes have them.
inline std::vector<Kind> kinds()
{
  std::vector<Kind> all;
  for (const kernel::Entry& e : kernel::registry())
  {
    if (e.num_slaves > e.gdim + (e.gdim == 3))
      continue;
    const Kind k{e.law, e.num_nodes, e.gdim, e.num_slaves};
    if (std::ranges::find(all, k) == all.end())
      all.push_back(k);
  }
  return all;
}

/// @brief Put a row of typed values where a kernel reads it.
template <class Row>
void put(double* to, const Row& row)
{
  std::ranges::copy(kernel::values_of(std::span(&row, 1)), to);
}

/// @brief A pair at some state: what its kernels are given.
struct Sample
{
  Kind kind;
  int feature = 0;     ///< interior, edge or vertex
  bool covers = false; ///< whether the master facet covers the slave facet
  std::vector<double> w = {}; ///< coefficients
  /// Renew the pair's data, which follow the displacement in finite sliding;
  /// nothing where they do not
  std::function<void(Sample&)> renew = {};

  double* at(Coefficient c) { return w.data() + offset(c); }
  const double* at(Coefficient c) const { return w.data() + offset(c); }

  /// @brief Current positions of the pair's nodes.
  std::vector<double> positions() const
  {
    std::vector<double> x(kind.num_dofs());
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = at(Coefficient::position)[i] + at(Coefficient::displacement)[i];
    return x;
  }

  /// @brief Set the displacement so that the nodes come to positions.
  void move_to(const std::vector<double>& x, bool follow)
  {
    for (std::size_t i = 0; i < x.size(); ++i)
      at(Coefficient::displacement)[i] = x[i] - at(Coefficient::position)[i];
    if (follow and renew)
      renew(*this);
  }

  /// @brief Whether the pair keeps the normal that the search found.
  bool keeps_normal() const
  {
    const kernel::MortarLayout layout(kind.num_slaves, kind.num_nodes);
    return kind.is_mortar() and !kind.is_rigid()
           and at(Coefficient::pair)[layout.keeps] != 0;
  }

  bool has(std::string_view sliding, std::string_view term) const
  {
    return find_if_any(kind.law, sliding, term, kind.num_nodes, kind.gdim,
                       kind.num_slaves)
           != nullptr;
  }

  /// @brief Call a kernel.
  std::vector<double> operator()(std::string_view sliding,
                                 std::string_view term) const
  {
    const kernel::Entry& e = find(kind.law, sliding, term, kind.num_nodes,
                                  kind.gdim, kind.num_slaves);
    const kernel::Shape s = shape(e);
    std::vector<double> tensor(s.rows * s.columns, 0);
    e.function(tensor.data(), w.data(), nullptr, nullptr, nullptr, nullptr,
               nullptr);
    return tensor;
  }

private:
  int offset(Coefficient c) const
  {
    return kernel::offset(kind.law, c, kind.num_nodes, kind.gdim,
                          kind.num_slaves);
  }
};

/// @brief A facet in space, warped, turned and stretched.
template <class F>
geometry::Nodes<F> kernel_facet(Generator& random)
{
  geometry::Nodes<F> x;
  const double size = random(0.5, 2);
  for (int l = 0; l < F::nodes; ++l)
    for (int k = 0; k < F::gdim; ++k)
      x[l][k] = size
                * ((k < F::tdim ? F::vertices[l][k] : 0) + random(-0.15, 0.15));
  return Motion<F::gdim>(random, 1)(x);
}

/// @brief Put a slave node near a feature of a facet.
template <class F>
void place_node(Sample& s, Generator& random)
{
  constexpr int D = F::gdim;
  const auto x = kernel_facet<F>(random);
  geometry::Local<F> xi = inner_point<F>(random);
  Vector<3> cone{};
  if (s.feature > F::num_edges)
  {
    xi = F::vertices[s.feature - 1 - F::num_edges];
    cone = random.unit<3>();
    if (D == 2)
    {
      const auto c = random.unit<2>();
      cone = {c[0], 0, c[1]};
    }
  }
  else if (s.feature > 0)
  {
    const auto [i, j] = geometry::feature_edge<F>(s.feature);
    const double part = random(0.1, 0.9);
    xi = (1 - part) * F::vertices[i] + part * F::vertices[j];
    const auto c = random.unit<2>();
    cone = {0, c[0], c[1]};
  }
  Vector<D> slave;
  if (s.feature == 0)
    slave = position<F>(x, xi)
            + random(-0.15, 0.15) * geometry::frame<F>(x, xi).n;
  else
  {
    // Not at the middle of the facet, which may be too near to a ridge
    slave = position<F>(x, xi);
    slave = slave + random(0.2, 0.5) * random.unit<D>();
  }
  double* u = s.at(Coefficient::displacement);
  double* X = s.at(Coefficient::position);
  for (int a = 0; a <= F::nodes; ++a)
    for (int k = 0; k < D; ++k)
    {
      const int i = D * a + k;
      X[i] = (a == 0 ? slave[k] : x[a - 1][k]) - u[i];
    }
  kernel::FacetPair pair{.feature = double(s.feature)};
  std::ranges::copy(xi, pair.xi.begin());
  std::ranges::copy(cone, pair.cone.begin());
  std::ranges::copy(random.unit<D>(), pair.normal.begin());
  put(s.at(Coefficient::pair), pair);
  if (s.kind.law != Law::frictionless)
  {
    auto from = kernel::read<kernel::FacetSlip>(s.at(Coefficient::slip));
    for (int a = 0; a < F::tdim; ++a)
      from.xi[a] = random(-0.1, 0.7);
    from.gap = random(-0.3, 0.3);
    put(s.at(Coefficient::slip), from);
  }
}

/// @brief Take the integrals of a pair of facets at its positions.
inline void integrate_facets(Sample& sample)
{
  const auto [law, m, gdim, n] = sample.kind;
  std::vector<std::int32_t> slave(n), master(m);
  std::iota(slave.begin(), slave.end(), 0);
  std::iota(master.begin(), master.end(), n);
  search::FacetSearch search({0, n}, slave, {0, m}, master, gdim);
  const auto x = sample.positions();
  const double* X = sample.at(Coefficient::position);
  const std::vector<double> reference(X, X + x.size());
  const auto pairs = search.find(x, INFINITY, 0);
  if (pairs.size() != 1)
    throw std::runtime_error("the facets do not face one another");
  double* p = sample.at(Coefficient::pair);
  const kernel::MortarLayout at(n, m);
  const std::vector<double> weight(p + at.factor, p + at.factor + n);
  std::vector<double> kept;
  if (p[at.keeps] != 0)
    kept.assign(p + at.normal, p + at.normal + 3);
  const auto all = geometry::integrals(search.slave(), search.master(), pairs,
                                       x, reference, gdim, kept, weight);
  for (int s = 0; s < n; ++s)
  {
    std::copy_n(&all.weight[geometry::most_nodes * s], m,
                p + at.weight + m * s);
    std::copy_n(&all.dual[geometry::most_nodes * s], n, p + at.dual + n * s);
    p[at.gap + s] = all.gap[s];
  }
  std::copy_n(all.normal.begin(), 3, p + at.normal);
}

/// @brief Put a slave facet before a master facet, within it or not; the pairs
/// of ties keep their integrals.
/// @param[in] keeps Whether the pair keeps a normal, that is not the facet's.
inline void place_facets(Sample& s, Generator& random, bool within, bool keeps)
{
  const auto [law, m, gdim, n] = s.kind;
  std::vector<double> x;
  const auto add = [&]<class F>(F, double size, double height)
  {
    // The middle of both facets is at the origin, and the master looks the
    // other way
    const double shift = within ? 0 : random(-0.2, 0.2);
    for (int l = 0; l < F::nodes; ++l)
      for (int k = 0; k < F::gdim; ++k)
      {
        const double middle = F::nodes == 3 ? 1. / 3 : 0.5;
        double c = height;
        if (k < F::tdim)
          c = size * (F::vertices[l][k] - middle);
        if (k == 0 and size > 1)
          c = shift - c;
        x.push_back(c + random(-0.08, 0.08));
      }
  };
  geometry::visit(n, [&](auto kind) { add(kind, 1, 0); });
  geometry::visit(m, [&](auto kind)
                  { add(kind, within ? 6 : 1.5, random(-.1, .1)); });
  const auto turn = [&]<int D>(std::integral_constant<int, D>)
  {
    const Motion<D> motion(random, 1);
    for (std::size_t i = 0; i < x.size(); i += D)
    {
      Vector<D> p;
      std::copy_n(&x[i], D, p.begin());
      std::ranges::copy(motion(p), &x[i]);
    }
  };
  if (gdim == 2)
    turn(std::integral_constant<int, 2>{});
  else
    turn(std::integral_constant<int, 3>{});
  double* u = s.at(Coefficient::displacement);
  for (std::size_t i = 0; i < x.size(); ++i)
    s.at(Coefficient::position)[i] = x[i] - u[i];
  s.covers = within;
  const kernel::MortarLayout at(n, m);
  double* pair = s.at(Coefficient::pair);
  std::generate_n(pair + at.factor, n, [&random] { return random(0.3, 2); });
  pair[at.keeps] = 0;
  integrate_facets(s);
  if (keeps)
  {
    Vector<3> normal{};
    for (int k = 0; k < gdim; ++k)
      normal[k] = pair[at.normal + k] + random(-0.2, 0.2);
    normal = (1 / norm(normal)) * normal;
    std::ranges::copy(normal, pair + at.normal);
    pair[at.keeps] = 1;
    integrate_facets(s);
  }
  if (law != Law::tied)
    s.renew = integrate_facets;
}

/// @brief An ellipsoid's level set, whose gradient is no unit vector and whose
/// normal has a derivative that is not symmetric, and the movement across its
/// normal from where a point started.
struct Ellipsoid
{
  double radius;
  std::vector<double> centre = {}, start = {};
  Vector<3> stretch = {1, 1.3, 0.8};

  /// @brief Values of an obstacle's pair at a point.
  /// @param[out] pair The pair.
  /// @param[out] slip Its slip; not written if null.
  void operator()(int gdim, const double* x, kernel::ObstaclePair& pair,
                  kernel::ObstacleSlip* slip) const
  {
    Vector<3> d{}, stretched{};
    for (int k = 0; k < gdim; ++k)
    {
      d[k] = stretch[k] * (x[k] - centre[k]);
      stretched[k] = stretch[k] * d[k];
    }
    const double r = norm(d);
    const Vector<3> gradient = (1 / r) * stretched;
    const double slope = norm(gradient);
    pair = {};
    pair.gap = r - radius;
    std::copy_n(gradient.begin(), gdim, pair.gradient.begin());
    auto& n = pair.normal;
    for (int k = 0; k < gdim; ++k)
      n[k] = gradient[k] / slope;
    auto& dn = pair.curvature;
    for (int j = 0; j < gdim; ++j)
    {
      // Of the gradient by x_j
      Vector<3> turn = (-gradient[j] / r) * gradient;
      turn[j] += stretch[j] * stretch[j] / r;
      const double along = dot(gradient, turn) / (slope * slope);
      for (int i = 0; i < gdim; ++i)
        dn[gdim * i + j] = (turn[i] - along * gradient[i]) / slope;
    }
    if (!slip)
      return;
    double along = 0; // of the movement
    for (int i = 0; i < gdim; ++i)
      along += n[i] * (x[i] - start[i]);
    *slip = {};
    auto& ds = slip->derivative;
    for (int i = 0; i < gdim; ++i)
    {
      slip->slip[i] = x[i] - start[i] - along * n[i];
      for (int j = 0; j < gdim; ++j)
      {
        double turned = 0;
        for (int k = 0; k < gdim; ++k)
          turned += (x[k] - start[k]) * dn[gdim * k + j];
        ds[gdim * i + j]
            = (i == j) - n[i] * (n[j] + turned) - along * dn[gdim * i + j];
      }
    }
  }
};

/// @brief A slave node near a obstacle.
inline void place_before_obstacle(Sample& s, Generator& random)
{
  const int gdim = s.kind.gdim;
  Ellipsoid obstacle{.radius = random(0.5, 1)};
  const auto x = s.positions();
  const Vector<3> way = random.unit<3>();
  for (int k = 0; k < gdim; ++k)
  {
    obstacle.centre.push_back(x[k] + way[k] + 0.1 * (k == 0));
    obstacle.start.push_back(x[k] + random(-0.3, 0.3));
  }
  s.renew = [obstacle](Sample& now)
  {
    kernel::ObstaclePair pair;
    kernel::ObstacleSlip slip;
    const bool slips = now.kind.law != Law::frictionless;
    obstacle(now.kind.gdim, now.positions().data(), pair,
             slips ? &slip : nullptr);
    put(now.at(Coefficient::pair), pair);
    if (slips)
      put(now.at(Coefficient::slip), slip);
  };
  s.renew(s);
}

/// @brief A slave facet near an obstacle, with integrals by some points and
/// weights: whatever they are, the kernels are those of the integrals.
inline void place_facet_before_obstacle(Sample& s, Generator& random)
{
  const auto [law, m, gdim, n] = s.kind;
  Ellipsoid obstacle{.radius = random(1, 2)};
  for (int k = 0; k < gdim; ++k)
  {
    obstacle.centre.push_back(k == 0 ? 3 : random(-0.5, 0.5));
    obstacle.start.push_back(0);
  }
  constexpr int num_points = 3;
  // Shape functions and weighted dual functions at each point
  std::vector<double> shape, dual;
  for (int i = 0; i < num_points * n; ++i)
  {
    shape.push_back(random(0.1, 0.6));
    dual.push_back(random(-0.2, 0.8));
  }
  s.renew = [obstacle, shape, dual](Sample& now)
  {
    const auto [law, m, gdim, n] = now.kind;
    const kernel::RigidMortarLayout at(n, gdim);
    double* p = now.at(Coefficient::pair);
    std::fill_n(p, at.size, 0);
    const auto x = now.positions();
    for (int q = 0; q < num_points; ++q)
    {
      const double *N = &shape[n * q], *phi = &dual[n * q];
      Vector<3> point{};
      for (int t = 0; t < n; ++t)
        for (int k = 0; k < gdim; ++k)
          point[k] += N[t] * x[gdim * t + k];
      kernel::ObstaclePair d;
      obstacle(gdim, point.data(), d, nullptr);
      for (int a = 0; a < n; ++a)
      {
        p[at.area + a] += phi[a];
        p[at.gap + a] += phi[a] * d.gap;
        for (int k = 0; k < gdim; ++k)
          p[at.normal + gdim * a + k] += phi[a] * d.normal[k];
        for (int t = 0; t < n; ++t)
        {
          for (int k = 0; k < gdim; ++k)
            p[at.gradient + (n * a + t) * gdim + k]
                += phi[a] * N[t] * d.gradient[k];
          for (int k = 0; k < gdim * gdim; ++k)
            p[at.curvature + (n * a + t) * gdim * gdim + k]
                += phi[a] * N[t] * d.curvature[k];
        }
      }
    }
  };
  s.renew(s);
}

/// @brief Pairs of a kind at random states: over the interior of a facet, at
/// each of its edges and vertices; facets within and across one another.
inline std::vector<Sample> samples(const Kind& kind)
{
  Generator random(1000 * kind.num_slaves + 100 * kind.num_nodes
                   + 10 * kind.gdim + static_cast<int>(kind.law));
  // The interior twice
  int count = 2;
  if (!kind.is_mortar() and !kind.is_rigid())
    count += (kind.gdim - 1) * kind.num_nodes;
  else if (kind.is_mortar() and !kind.is_rigid())
    count = 4;
  std::vector<Sample> all;
  for (int i = 0; i < count; ++i)
  {
    Sample s{kind};
    s.w.resize(kernel::coefficient_values(kind.law, kind.num_nodes, kind.gdim,
                                          kind.num_slaves));
    for (double& value : s.w)
      value = random(-1, 1);
    for (int k = 0; k < kind.num_dofs(); ++k)
      s.at(Coefficient::displacement)[k] *= 0.1;
    for (int a = 0; a < kind.num_slaves; ++a)
      s.at(Coefficient::area)[a] = random(0.5, 1);
    if (kind.is_mortar() and kind.is_rigid())
      place_facet_before_obstacle(s, random);
    else if (kind.is_mortar())
      place_facets(s, random, i < 2, kind.law != Law::tied and i % 2 == 1);
    else if (kind.is_rigid())
      place_before_obstacle(s, random);
    else
    {
      s.feature = std::max(0, i - 1);
      geometry::visit(kind.num_nodes,
                      [&]<class F>(F) { place_node<F>(s, random); });
    }
    all.push_back(std::move(s));
  }
  return all;
}

/// @brief Largest magnitude.
inline double largest(const std::vector<double>& values)
{
  double m = 0;
  for (const double v : values)
    m = std::max(m, std::abs(v));
  return m;
}

/// @brief Expect numbers close to others, relative to the largest of these; or
/// of a size.
inline void expect_close(const std::vector<double>& computed,
                         const std::vector<double>& reference, double relative,
                         double size = 0)
{
  ASSERT_EQ(computed.size(), reference.size());
  const double tolerance = relative * std::max(size, largest(reference));
  for (std::size_t i = 0; i < computed.size(); ++i)
    EXPECT_NEAR(computed[i], reference[i], tolerance) << "entry " << i;
}

/// @brief Call f(sample) for the samples of all kinds.
template <class Function>
void for_all_samples(Function&& f)
{
  for (const Kind& kind : kinds())
  {
    const auto all = samples(kind);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      SCOPED_TRACE(testing::Message() << kind << ", sample " << i);
      f(all[i]);
    }
  }
}

/// @brief A test of the samples of all kinds.
#define TEST_SAMPLES(suite, name)                                              \
  static void suite##_##name(Sample s);                                        \
  TEST(suite, name) { for_all_samples(suite##_##name); }                       \
  void suite##_##name(Sample s)
} // namespace contactx::tests
