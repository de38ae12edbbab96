// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "generator.h"
#include "obstacles.h"
#include <contactx/contact/obstacle_pairs.h>
#include <contactx/kernel/layout.h>

namespace contactx::tests
{
/// @brief Nodes of one rank, of which others own the last ones.
class PartOfNodes final : public mesh::NodeMap
{
public:
  PartOfNodes(std::int32_t num_owned, std::int32_t num_nodes)
      : _num_owned(num_owned), _num_nodes(num_nodes)
  {
  }

  mesh::Ranks& ranks() const override { return _ranks; }
  std::int32_t num_owned() const override { return _num_owned; }
  std::int32_t num_nodes() const override { return _num_nodes; }
  void forward(std::span<double>, int) const override {}
  void forward(std::span<std::int64_t>, int) const override {}
  void reverse(std::span<double>, int) const override {}

private:
  mutable mesh::OneRank _ranks;
  std::int32_t _num_owned, _num_nodes;
};

/// @brief Slave nodes, each with a small facet of its own that faces an
/// obstacle; the other nodes of the facets count as those of another rank.
struct FacingNodes
{
  int gdim, n;
  std::vector<double> x;
  std::vector<std::int32_t> owned, offsets{0}, nodes;
  std::shared_ptr<const contact::SlaveNodes> slaves;

  /// @brief Nodes at random places around an obstacle.
  FacingNodes(geometry::Obstacle& o, int dimension, int count = 12)
      : gdim(dimension), n(count)
  {
    Generator random(7);
    for (int i = 0; i < n * gdim; ++i)
      x.push_back(random(-1, 2));
    face(o);
  }

  FacingNodes(geometry::Obstacle& o, int dimension, std::vector<double> points)
      : gdim(dimension), n(static_cast<int>(points.size()) / dimension),
        x(std::move(points))
  {
    face(o);
  }

  geometry::FacetList facets() const { return {offsets, nodes}; }

  /// @brief All positions after a function has moved the slave nodes.
  std::vector<double> moved(auto&& f) const
  {
    std::vector<double> y = x;
    for (int i = 0; i < n; ++i)
      f(i, &y[gdim * i]);
    return y;
  }

private:
  void face(geometry::Obstacle& o)
  {
    const auto normal = o.normals(x, gdim);
    const double h = 1e-3;
    for (int i = 0; i < n; ++i)
    {
      owned.push_back(i);
      const auto other = static_cast<std::int32_t>(x.size()) / gdim;
      nodes.push_back(i);
      if (gdim == 2)
      {
        // The outward normal is the tangent turned clockwise
        const Vector<2> t{normal[2 * i + 1], -normal[2 * i]};
        for (int k = 0; k < 2; ++k)
          x.push_back(x[2 * i + k] + h * t[k]);
        nodes.push_back(other);
      }
      else
      {
        const Vector<3> m{-normal[3 * i], -normal[3 * i + 1],
                          -normal[3 * i + 2]};
        Vector<3> a
            = cross(m, std::abs(m[0]) < 0.7 ? Vector<3>{1} : Vector<3>{0, 1});
        a = (1 / norm(a)) * a;
        const Vector<3> b = cross(m, a);
        for (const Vector<3>& t : {a, b})
          for (int k = 0; k < 3; ++k)
            x.push_back(x[3 * i + k] + h * t[k]);
        nodes.insert(nodes.end(), {other, other + 1});
      }
      offsets.push_back(static_cast<std::int32_t>(nodes.size()));
    }
    slaves = std::make_shared<contact::SlaveNodes>(
        std::make_shared<PartOfNodes>(n, static_cast<std::int32_t>(x.size())
                                             / gdim),
        facets(), facets());
  }
};

/// @brief What the kernels are given of slave nodes.
struct Given
{
  std::vector<double> slip, derivative, gap, normal;

  /// @brief Take it from pairs of all nodes of a master.
  Given(const std::vector<kernel::Pairs>& groups, int gdim)
  {
    const kernel::Pairs& p = groups.at(0);
    for (std::size_t i = 0; i < p.size(); ++i)
    {
      const auto pair = p.row<kernel::ObstaclePair>(i);
      gap.push_back(pair.gap);
      add(normal, pair.normal.data(), gdim);
      if (p.slip_size == 0)
        continue;
      const auto from = p.slip_row<kernel::ObstacleSlip>(i);
      add(slip, from.slip.data(), gdim);
      add(derivative, from.derivative.data(), gdim * gdim);
    }
  }

private:
  static void add(std::vector<double>& to, const double* from, int size)
  {
    to.insert(to.end(), from, from + size);
  }
};

/// @brief Largest difference of two lists of numbers of one size.
inline double difference(const std::vector<double>& a,
                         const std::vector<double>& b)
{
  double largest = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

inline double largest(const std::vector<double>& a)
{
  return difference(a, std::vector<double>(a.size(), 0.0));
}
} // namespace contactx::tests
