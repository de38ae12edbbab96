// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace contactx::benchmarks
{
/// @brief A slave and a master surface that face each other: wavy squares of
/// triangles which do not match, the slave surface a little higher.
struct WavySquares
{
  std::vector<double> x; ///< positions (shape=(num_nodes, 3))
  std::vector<std::int32_t> slave_offsets, slave_nodes;
  std::vector<std::int32_t> master_offsets, master_nodes;
  double size; ///< edge of a master facet

  /// @brief Make the surfaces.
  /// @param[in] n Number of slave nodes and of master facets, about.
  /// @param[in] gap Distance of the surfaces in edges of a master facet.
  /// @param[in] shuffled Number nodes and facets at random, which is the worst
  /// order for a cache, not row by row.
  WavySquares(int n, double gap, bool shuffled)
  {
    const int slaves = std::lround(std::sqrt(n));
    const int cells = std::lround(std::sqrt(n / 2.0));
    size = 1.0 / cells;
    // Inside the master's outer edge, which is no round multiple of its cells
    add(slaves - 1, 0.013, 0.97, gap * size, false, slave_offsets, slave_nodes);
    add(cells, 0, 1, 0, true, master_offsets, master_nodes);
    if (shuffled)
      shuffle();
  }

  /// @brief Shift the slave surface.
  void move(double dx, double dz)
  {
    for (std::size_t i = 0; i < slave_node.size(); ++i)
      if (slave_node[i])
      {
        x[3 * i] += dx;
        x[3 * i + 2] += dz;
      }
  }

  std::vector<char> slave_node; ///< whether a node is one of the slave surface

private:
  static double height(double s, double t)
  {
    return 0.03 * std::sin(9 * s) * std::cos(7 * t);
  }

  void add(int cells, double begin, double end, double z, bool up,
           std::vector<std::int32_t>& offsets, std::vector<std::int32_t>& nodes)
  {
    const std::int32_t first = x.size() / 3;
    for (int j = 0; j <= cells; ++j)
      for (int i = 0; i <= cells; ++i)
      {
        const double s = begin + (end - begin) * i / cells;
        const double t = begin + (end - begin) * j / cells;
        x.insert(x.end(), {s, t, z + height(s, t)});
        slave_node.push_back(!up);
      }
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i)
      {
        const std::int32_t a = first + j * (cells + 1) + i, b = a + 1;
        const std::int32_t c = a + cells + 1, d = c + 1;
        if (up)
          nodes.insert(nodes.end(), {a, b, c, b, d, c});
        else
          nodes.insert(nodes.end(), {a, c, b, b, c, d});
      }
    offsets.resize(nodes.size() / 3 + 1);
    for (std::size_t f = 0; f < offsets.size(); ++f)
      offsets[f] = 3 * f;
  }

  void shuffle()
  {
    std::mt19937 random(1);
    std::vector<std::int32_t> to(x.size() / 3);
    std::iota(to.begin(), to.end(), 0);
    std::shuffle(to.begin(), to.end(), random);
    const std::vector<double> old = x;
    const std::vector<char> was = slave_node;
    for (std::size_t i = 0; i < to.size(); ++i)
    {
      std::copy_n(old.begin() + 3 * i, 3, x.begin() + 3 * to[i]);
      slave_node[to[i]] = was[i];
    }
    for (auto* nodes : {&slave_nodes, &master_nodes})
    {
      std::vector<std::int32_t> order(nodes->size() / 3);
      std::iota(order.begin(), order.end(), 0);
      std::shuffle(order.begin(), order.end(), random);
      std::vector<std::int32_t> mixed;
      for (std::int32_t f : order)
        for (int l = 0; l < 3; ++l)
          mixed.push_back(to[(*nodes)[3 * f + l]]);
      *nodes = std::move(mixed);
    }
  }
};
} // namespace contactx::benchmarks
