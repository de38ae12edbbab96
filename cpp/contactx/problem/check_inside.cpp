// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "check_inside.h"
#include "../math/scales.h"
#include "../mesh/hull.h"
#include "../search/box_tree.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace contactx;
using namespace contactx::problem;

namespace
{
/// Points of one search
constexpr std::int64_t points_per_search = 256;

/// Boxes of some bodies.
class Boxes
{
public:
  Boxes(const mesh::Mesh& mesh, std::span<const std::int64_t> bodies)
      : _gdim(mesh.halo->gdim()), _count(bodies.size()),
        _corners(mesh.bodies->boxes(bodies, mesh.halo->reference(), _gdim))
  {
  }

  double low(std::size_t body, int k) const
  {
    return _corners[body * _gdim + k];
  }
  double high(std::size_t body, int k) const
  {
    return _corners[(_count + body) * _gdim + k];
  }

  /// Largest edge of a box.
  double size(std::size_t body) const
  {
    double size = 0;
    for (int k = 0; k < _gdim; ++k)
      size = std::max(size, high(body, k) - low(body, k));
    return size;
  }

  /// Whether a box is in one of others.
  bool is_in(std::size_t body, const Boxes& others, std::size_t other) const
  {
    const double room = math::equal_rel_tol * others.size(other);
    for (int k = 0; k < _gdim; ++k)
      if (not(low(body, k) >= others.low(other, k) - room
              and high(body, k) <= others.high(other, k) + room))
        return false;
    return true;
  }

private:
  int _gdim;
  std::size_t _count;
  std::vector<double> _corners;
};

/// Cells of a body on this rank, which points may be in.
class BodyCells
{
public:
  BodyCells(const mesh::Mesh& mesh, std::int64_t body, double padding)
      : _mesh(mesh), _cells(mesh.bodies->cells(body)),
        _tree(boxes(mesh, _cells, padding)),
        _hull(mesh.nodes_per_cell, mesh.halo->gdim())
  {
  }

  bool contain(const Vector<3>& p)
  {
    const auto point = std::span(p).first(_mesh.halo->gdim());
    bool is_in = false;
    _tree.for_each([&](const search::Box& box)
                   { return not is_in and box.distance2(p) == 0; },
                   [&](std::int32_t i)
                   {
                     is_in = is_in
                             or _hull.contains(point, nodes(_mesh, _cells[i]),
                                               _mesh.halo->reference(),
                                               math::equal_rel_tol);
                   });
    return is_in;
  }

  static std::span<const std::int32_t> nodes(const mesh::Mesh& mesh,
                                             std::int32_t cell)
  {
    return mesh.cells.subspan(std::size_t(cell) * mesh.nodes_per_cell,
                              mesh.nodes_per_cell);
  }

private:
  static std::vector<search::Box> boxes(const mesh::Mesh& mesh,
                                        std::span<const std::int32_t> cells,
                                        double padding)
  {
    const int gdim = mesh.halo->gdim();
    const auto x = mesh.halo->reference();
    std::vector<search::Box> boxes;
    boxes.reserve(cells.size());
    for (const std::int32_t cell : cells)
    {
      search::Box& box = boxes.emplace_back(search::Box::empty());
      for (const std::int32_t node : nodes(mesh, cell))
      {
        Vector<3> p{};
        std::copy_n(&x[std::size_t(node) * gdim], gdim, p.begin());
        box.add(p);
      }
      for (int k = 0; k < 3; ++k)
      {
        box.lower[k] -= padding;
        box.upper[k] += padding;
      }
    }
    return boxes;
  }

  const mesh::Mesh& _mesh;
  std::vector<std::int32_t> _cells;
  search::BoxTree _tree;
  mesh::Hull _hull;
};

/// Nodes of a body that this rank owns, and middles of its cells. The middles
/// tell a body that is inside from one that fills a hole of the other exactly.
std::vector<Vector<3>> points_of(const mesh::Mesh& mesh, std::int64_t body)
{
  const int gdim = mesh.halo->gdim();
  const auto x = mesh.halo->reference();
  std::vector<Vector<3>> points;
  for (const std::int32_t cell : mesh.bodies->cells(body))
  {
    Vector<3>& p = points.emplace_back();
    for (const std::int32_t node : BodyCells::nodes(mesh, cell))
      for (int k = 0; k < gdim; ++k)
        p[k] += x[std::size_t(node) * gdim + k];
    p = (1.0 / mesh.nodes_per_cell) * p;
  }
  for (const std::int32_t node : mesh.bodies->nodes(body))
    std::copy_n(&x[std::size_t(node) * gdim], gdim,
                points.emplace_back().begin());
  return points;
}

/// Whether all points of one body are in cells of another; collective.
bool lies_inside(const mesh::Mesh& mesh, std::int64_t inner, std::int64_t outer,
                 double size)
{
  mesh::Ranks& ranks = mesh.halo->ranks();
  const std::vector<Vector<3>> points = points_of(mesh, inner);
  BodyCells cells(mesh, outer, math::equal_rel_tol * size);
  // A few at a time, from everywhere: bodies that are not inside show it soon
  const std::int64_t looks
      = (mesh::total(ranks, std::ssize(points)) + points_per_search - 1)
        / points_per_search;
  std::vector<std::int64_t> is_in;
  for (std::int64_t look = 0; look < looks; ++look)
  {
    std::vector<Vector<3>> part;
    for (std::int64_t i = look; i < std::ssize(points); i += looks)
      part.push_back(points[i]);
    part = mesh::gathered(ranks, std::span<const Vector<3>>(part));
    is_in.resize(part.size());
    std::ranges::transform(part, is_in.begin(), [&cells](const Vector<3>& p)
                           { return cells.contain(p); });
    // A point is in a cell of some rank
    if (ranks.size() > 1)
      ranks.reduce(std::span(is_in), mesh::Reduction::largest);
    if (std::ranges::find(is_in, 0) != is_in.end())
      return false;
  }
  return true;
}
} // namespace

void contactx::problem::check_nested(const mesh::Mesh& mesh,
                                     const mesh::NamedSurface& slave,
                                     const mesh::NamedSurface& master)
{
  const mesh::Bodies& bodies = *mesh.bodies;
  const auto slaves = bodies.carrying(slave.facets.nodes);
  const auto masters = bodies.carrying(master.facets.nodes);
  const Boxes slave_boxes(mesh, slaves), master_boxes(mesh, masters);
  const std::string slave_name = "slave surface " + slave.name,
                    master_name = "master surface " + master.name;
  const auto check
      = [&](const auto& inner, const Boxes& inner_boxes,
            const std::string& inner_name, const auto& outer,
            const Boxes& outer_boxes, const std::string& outer_name)
  {
    for (std::size_t i = 0; i < inner.size(); ++i)
      for (std::size_t o = 0; o < outer.size(); ++o)
        if (inner[i] != outer[o] and inner_boxes.is_in(i, outer_boxes, o)
            and lies_inside(mesh, inner[i], outer[o], outer_boxes.size(o)))
          throw std::invalid_argument(
              "the body of the " + inner_name
              + " lies wholly inside the body of the " + outer_name
              + ": all its " + std::to_string(bodies.count(inner[i]))
              + " nodes are in cells of the other. Move the bodies apart; they "
                "may overlap in part (manual: errors/refused-mesh)");
  };
  check(slaves, slave_boxes, slave_name, masters, master_boxes, master_name);
  check(masters, master_boxes, master_name, slaves, slave_boxes, slave_name);
}

void contactx::problem::check_outside(const mesh::Mesh& mesh,
                                      const contact::SlaveNodes& slaves,
                                      const std::string& name,
                                      std::span<const double> gap,
                                      geometry::Obstacle& obstacle)
{
  const mesh::Bodies& bodies = *mesh.bodies;
  mesh::Ranks& ranks = mesh.halo->ranks();
  const int gdim = mesh.halo->gdim();
  const auto x = mesh.halo->reference();
  const auto names = bodies.carrying(slaves.owned());
  const Boxes boxes(mesh, names);
  std::vector<double> highest(names.size(),
                              -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < gap.size(); ++i)
  {
    const std::int64_t body = bodies.of_node()[slaves.owned()[i]];
    double& most
        = highest[std::ranges::lower_bound(names, body) - names.begin()];
    most = std::max(most, gap[i]);
  }
  ranks.reduce(std::span(highest), mesh::Reduction::largest);
  for (std::size_t b = 0; b < names.size(); ++b)
  {
    if (not(highest[b] <= math::equal_rel_tol * boxes.size(b)))
      continue;
    std::vector<double> level;
    ranks.agree(
        [&]
        {
          std::vector<double> points;
          for (const std::int32_t node : bodies.nodes(names[b]))
            for (int k = 0; k < gdim; ++k)
              points.push_back(x[std::size_t(node) * gdim + k]);
          level = obstacle.level(points, gdim);
        });
    double size = 0;
    for (const double value : level)
      if (std::isfinite(value))
        size = std::max(size, std::abs(value));
    size = mesh::largest(ranks, size);
    // A body that touches the surface from within has nodes at zero
    const bool is_within = std::ranges::all_of(
        level, [room = math::equal_rel_tol * size](double value)
        { return value <= room; });
    if (mesh::everywhere(ranks, is_within))
      throw std::invalid_argument(
          "the body of the slave surface " + name
          + " lies wholly inside the rigid obstacle: all its "
          + std::to_string(bodies.count(names[b])) + " nodes are inside the "
          + obstacle.name() + ". " + obstacle.usual_mistake()
          + ", or the body is in the wrong place (manual: "
            "errors/refused-mesh)");
  }
}
