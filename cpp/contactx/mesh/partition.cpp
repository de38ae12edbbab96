// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "partition.h"
#include "../math/matrix.h"
#include "../math/vec.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
// Nodes at contact a part from which on it is worth sharing them
constexpr double nodes_per_part = 30;
// Part of the contact by which a plane may be off: the first such is taken
constexpr double allowed_imbalance = 0.02;
// Directions that are tried, and in the plane how far they turn, radians
constexpr int directions = 36;
constexpr double most_tilt = 0.6;
// Bins, and how often one is divided again: a plane is found to 1e-5
constexpr int bins = 64, divisions = 3;
// Turn that keeps cells of one layer of a grid apart, radians
constexpr double apart = 1e-3;

/// Middles of this rank's cells, and how much of them is at contact.
struct Middles
{
  std::vector<Vector<3>> middle;
  std::vector<double> contact;
};

/// What a rank knows of its own nodes.
struct Node
{
  Vector<3> x;
  double contact;
};

/// All values of a message.
template <class T>
std::vector<T> all_of(std::span<const std::byte> bytes)
{
  return unpack<T>(bytes, bytes.size() / sizeof(T));
}

Middles middles_of(Ranks& ranks, std::span<const std::int64_t> cells, int width,
                   const InputNodes& nodes)
{
  const auto n = static_cast<std::int64_t>(nodes.at_contact.size());
  std::vector<std::int64_t> ends
      = gathered(ranks, std::span<const std::int64_t>(&n, 1));
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  const std::int64_t first = ends[ranks.rank()] - n;
  std::vector<std::int64_t> wanted(cells.begin(), cells.end());
  std::ranges::sort(wanted);
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  ranks.agree(
      [&]
      {
        if (not wanted.empty()
            and (wanted.front() < 0 or wanted.back() >= ends.back()))
          throw std::invalid_argument(
              "cells have vertices that are not among the "
              + std::to_string(ends.back()) + " nodes of x");
      });
  // Ask whoever has them: numbers ascend with the ranks
  Messages questions;
  std::vector<std::size_t> begin{0};
  for (int r = 0; r < ranks.size(); ++r)
  {
    begin.push_back(std::ranges::lower_bound(wanted, ends[r]) - wanted.begin());
    if (begin[r + 1] > begin[r])
      pack(questions[r], std::span<const std::int64_t>(wanted).subspan(
                             begin[r], begin[r + 1] - begin[r]));
  }
  Messages answers;
  for (const auto& [from, bytes] : ranks.exchange(questions))
  {
    std::vector<Node> known;
    for (const std::int64_t number : all_of<std::int64_t>(bytes))
    {
      Node& node = known.emplace_back();
      const std::size_t i = number - first;
      std::copy_n(nodes.x.begin() + i * nodes.gdim, nodes.gdim, node.x.begin());
      node.contact = nodes.at_contact[i];
    }
    pack(answers[from], std::span<const Node>(known));
  }
  std::vector<Node> of_wanted(wanted.size());
  for (const auto& [from, bytes] : ranks.exchange(answers))
  {
    const std::vector<Node> known = all_of<Node>(bytes);
    std::ranges::copy(known, of_wanted.begin() + begin[from]);
  }
  Middles found;
  for (std::size_t c = 0; c < cells.size(); c += width)
  {
    Vector<3> middle{};
    double contact = 0;
    for (int k = 0; k < width; ++k)
    {
      const Node& node
          = of_wanted[std::ranges::lower_bound(wanted, cells[c + k])
                      - wanted.begin()];
      middle = middle + (1.0 / width) * node.x;
      contact += node.contact;
    }
    found.middle.push_back(middle);
    found.contact.push_back(contact);
  }
  return found;
}

/// Some of the cells, by their numbers on this rank.
using Some = std::vector<std::size_t>;

/// A plane, and what is below it.
struct Side
{
  Vector<3> direction;
  double at;      ///< height of the plane
  double contact; ///< part of the contact below
};

class Halver
{
public:
  Halver(Ranks& ranks, const Middles& cells, bool is_plane)
      : _ranks(ranks), _cells(cells), _is_plane(is_plane)
  {
  }

  /// Gives parts from `first` on to some of the cells.
  void share(const Some& some, int first, int parts,
             std::vector<std::int32_t>& of_cell) const
  {
    if (parts == 1)
    {
      for (const std::size_t c : some)
        of_cell[c] = first;
      return;
    }
    const int below = parts / 2;
    const Side side = halve(some, static_cast<double>(below) / parts, parts);
    Some low, high;
    for (const std::size_t c : some)
      (dot(side.direction, _cells.middle[c]) < side.at ? low : high)
          .push_back(c);
    share(low, first, below, of_cell);
    share(high, first + below, parts - below, of_cell);
  }

private:
  /// Principal axes of points with weights, longest extent first, and their
  /// total weight.
  std::pair<Eigen::Matrix3d, double> axes(const Some& some,
                                          bool of_contact) const
  {
    std::array<double, 10> sums{};
    for (const std::size_t c : some)
    {
      const double weight = of_contact ? _cells.contact[c] : 1;
      const Vector<3>& x = _cells.middle[c];
      sums[0] += weight;
      for (int i = 0; i < 3; ++i)
      {
        sums[1 + i] += weight * x[i];
        // Upper part of the second moments
        for (int j = i; j < 3; ++j)
          sums[4 + i + j + (i > 0)] += weight * x[i] * x[j];
      }
    }
    _ranks.reduce(std::span<double>(sums), Reduction::sum);
    const double total = std::max(sums[0], 1.0);
    Eigen::Matrix3d moments;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        moments(i, j) = moments(j, i)
            = sums[4 + i + j + (i > 0)] / total
              - sums[1 + i] * sums[1 + j] / (total * total);
    return {math::symmetric_eigen(moments).eigenvectors().rowwise().reverse(),
            sums[0]};
  }

  /// The plane that has a part of some cells below it.
  Side halve(const Some& some, double part, int parts) const
  {
    auto [along, contact] = axes(some, true);
    const bool is_shared = contact >= nodes_per_part * parts;
    if (not is_shared)
      along = axes(some, false).first;
    std::vector<Vector<3>> ways;
    for (int k = 0; k < (is_shared ? directions : 1); ++k)
    {
      // To one side and to the other in turn, farther and farther
      const double turn = (k + 1) / 2 * (k % 2 == 0 ? 1 : -1)
                          * (_is_plane ? 2 * most_tilt : std::numbers::pi)
                          / directions;
      const Eigen::Vector3d way
          = std::cos(turn + apart) * along.col(0)
            + std::sin(turn + apart) * along.col(1)
            + (_is_plane ? 0 : apart * apart) * along.col(2);
      ways.push_back({way[0], way[1], way[2]});
    }
    const std::vector<Side> sides = planes(some, ways, part);
    const auto off
        = [part](const Side& side) { return std::abs(side.contact - part); };
    for (const Side& side : sides)
      if (not is_shared or off(side) <= allowed_imbalance)
        return side;
    return *std::ranges::min_element(sides, {}, off);
  }

  /// For each direction the plane that has a part of some cells below it.
  std::vector<Side> planes(const Some& some, const std::vector<Vector<3>>& ways,
                           double part) const
  {
    const std::size_t n = ways.size();
    std::vector<double> ends(2 * n, -std::numeric_limits<double>::max());
    for (const std::size_t c : some)
      for (std::size_t k = 0; k < n; ++k)
      {
        const double height = dot(ways[k], _cells.middle[c]);
        ends[2 * k] = std::max(ends[2 * k], -height);
        ends[2 * k + 1] = std::max(ends[2 * k + 1], height);
      }
    _ranks.reduce(std::span(ends), Reduction::largest);
    std::array<double, 2> totals{static_cast<double>(some.size()), 0};
    for (const std::size_t c : some)
      totals[1] += _cells.contact[c];
    _ranks.reduce(std::span<double>(totals), Reduction::sum);
    std::vector<double> low(n), width(n), cells(n), contact(n);
    for (std::size_t k = 0; k < n; ++k)
    {
      low[k] = -ends[2 * k];
      // The farthest cell has a bin, too
      width[k] = std::max((ends[2 * k + 1] - low[k]) * (1 + apart) / bins,
                          std::numeric_limits<double>::min());
    }
    for (int division = 0; division < divisions; ++division)
    {
      std::vector<double> counts(2 * bins * n);
      for (const std::size_t c : some)
        for (std::size_t k = 0; k < n; ++k)
        {
          const double height = dot(ways[k], _cells.middle[c]) - low[k];
          if (not(height >= 0) or not(height < bins * width[k]))
            continue;
          const auto bin = std::min(static_cast<std::size_t>(height / width[k]),
                                    std::size_t(bins - 1));
          counts[2 * (bins * k + bin)] += 1;
          counts[2 * (bins * k + bin) + 1] += _cells.contact[c];
        }
      _ranks.reduce(std::span(counts), Reduction::sum);
      for (std::size_t k = 0; k < n; ++k)
      {
        int bin = 0;
        for (; bin < bins - 1; ++bin)
        {
          const double* count = &counts[2 * (bins * k + bin)];
          if (cells[k] + count[0] > part * totals[0])
            break;
          cells[k] += count[0];
          contact[k] += count[1];
        }
        low[k] += bin * width[k];
        width[k] /= bins;
      }
    }
    std::vector<Side> sides;
    for (std::size_t k = 0; k < n; ++k)
      sides.push_back({ways[k], low[k], contact[k] / std::max(totals[1], 1.0)});
    return sides;
  }

  Ranks& _ranks;
  const Middles& _cells;
  bool _is_plane;
};
} // namespace

std::vector<std::int32_t>
mesh::parts_with_contact(Ranks& ranks, std::span<const std::int64_t> cells,
                         int width, const InputNodes& nodes, int parts)
{
  ranks.agree(
      [&]
      {
        if (nodes.gdim != 2 and nodes.gdim != 3)
          throw std::invalid_argument("x must have 2 or 3 columns, not "
                                      + std::to_string(nodes.gdim));
        if (nodes.x.size() != nodes.at_contact.size() * nodes.gdim)
          throw std::invalid_argument(
              "there must be a mark for each of "
              + std::to_string(nodes.x.size() / nodes.gdim) + " nodes, not "
              + std::to_string(nodes.at_contact.size()));
        if (not std::ranges::all_of(nodes.x, [](double value)
                                    { return std::isfinite(value); }))
          throw std::invalid_argument("x has values that are not finite");
        if (width < 1 or cells.size() % width != 0)
          throw std::invalid_argument("cells must have " + std::to_string(width)
                                      + " vertices each, at least one");
        if (parts < 1)
          throw std::invalid_argument("there must be one part at least, not "
                                      + std::to_string(parts));
      });
  // Meshes of the plane may be given in space
  std::array<double, 2> height{0, 0};
  if (nodes.gdim == 3)
  {
    height.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 2; i < nodes.x.size(); i += 3)
    {
      height[0] = std::max(height[0], nodes.x[i]);
      height[1] = std::max(height[1], -nodes.x[i]);
    }
    ranks.reduce(std::span<double>(height), Reduction::largest);
  }
  const Middles all = middles_of(ranks, cells, width, nodes);
  Some some(all.middle.size());
  for (std::size_t c = 0; c < some.size(); ++c)
    some[c] = c;
  std::vector<std::int32_t> of_cell(some.size());
  Halver(ranks, all, height[0] == -height[1]).share(some, 0, parts, of_cell);
  return of_cell;
}
