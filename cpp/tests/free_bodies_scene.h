// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "spring_bodies.h"
#include <contactx/law/coulomb.h>
#include <contactx/solve/free_bodies.h>

namespace contactx::tests
{
/// @brief Bodies of bars: nodes and cells whose nodes are all joined by bars
/// along the lines between them, which no rigid motion stretches.
struct Truss
{
  int gdim;
  std::vector<double> x;           ///< shape=(num_nodes, gdim)
  std::vector<std::int32_t> cells; ///< shape=(num_cells, 2)

  std::int32_t num_nodes() const
  {
    return static_cast<std::int32_t>(x.size()) / gdim;
  }

  /// @brief Add a block of a grid of cells.
  /// @return Number of its first node.
  std::int32_t add_block(int n, std::array<double, 3> origin, double size)
  {
    const std::int32_t first = num_nodes();
    const int layers = gdim == 3 ? n : 0;
    const auto number = [&](int i, int j, int k)
    { return first + (k * (n + 1) + j) * (n + 1) + i; };
    for (int k = 0; k <= layers; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
        {
          const std::array<int, 3> at{i, j, k};
          for (int c = 0; c < gdim; ++c)
            x.push_back(origin[c] + size * at[c] / n);
        }
    for (int k = 0; k < std::max(layers, 1); ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
          std::vector<std::int32_t> corners;
          for (int c = 0; c < (gdim == 3 ? 8 : 4); ++c)
            corners.push_back(number(i + c % 2, j + c / 2 % 2, k + c / 4));
          for (std::size_t a = 0; a < corners.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
              cells.insert(cells.end(), {corners[b], corners[a]});
        }
    return first;
  }

  /// @brief Add a disc of bars from its middle, its first node, to its rim and
  /// along it; the first node of the rim is the lowest.
  void add_disc(int n, std::array<double, 2> middle, double radius)
  {
    const std::int32_t first = num_nodes();
    x.insert(x.end(), middle.begin(), middle.end());
    for (int i = 0; i < n; ++i)
    {
      const double angle = 2 * std::acos(-1.0) * i / n;
      x.push_back(middle[0] + radius * std::sin(angle));
      x.push_back(middle[1] - radius * std::cos(angle));
      cells.insert(cells.end(), {first, first + 1 + i, first + 1 + i,
                                 first + 1 + (i + 1) % n});
    }
  }
};

/// @brief A truss as the bulk: bars that resist to be stretched alone.
class TrussBulk final : public SpringBulk
{
public:
  TrussBulk(const WholeMesh& mesh, std::shared_ptr<mesh::Halo> halo,
            const Truss& truss)
      : SpringBulk(mesh, std::move(halo),
                   std::make_shared<std::vector<double>>(truss.x.size()),
                   truss.cells, 2)
  {
    linear = false;
  }

  std::span<const double> positions() override
  {
    _positions.assign(_halo->reference().begin(), _halo->reference().end());
    for (std::size_t i = 0; i < u->size(); ++i)
      _positions[i] += (*u)[i];
    return _positions;
  }
  std::span<const double> diagonal() override
  {
    std::vector<double> field(u->size());
    _diagonal.resize(u->size());
    for (std::size_t i = 0; i < u->size(); ++i)
    {
      field[i] = 1;
      _diagonal[i] = product(field)[i];
      field[i] = 0;
    }
    return owned(_diagonal);
  }
  std::span<const double> products(std::span<const double> fields,
                                   int count) override
  {
    if (throws)
      throw std::runtime_error("the stiffness is spoilt");
    return SpringBulk::products(fields, count);
  }

  std::vector<double> product(std::span<const double> field) const override
  {
    const std::size_t g = gdim();
    const auto x = _halo->reference();
    std::vector<double> force(field.size());
    for (std::size_t i = 0; i < field.size(); ++i)
      force[i] = ground[i] * field[i];
    for (std::size_t b = 0; b < _cells.size(); b += 2)
    {
      const std::size_t p = _cells[b] * g, q = _cells[b + 1] * g;
      double square = 0, stretch = 0;
      for (std::size_t c = 0; c < g; ++c)
      {
        const double d = x[q + c] - x[p + c];
        square += d * d;
        stretch += d * (field[q + c] - field[p + c]);
      }
      for (std::size_t c = 0; c < g; ++c)
      {
        // Stresses resist the turns of bars
        const double part = (x[q + c] - x[p + c]) * stretch / square
                            + tension * (field[q + c] - field[p + c]);
        force[q + c] += part;
        force[p + c] -= part;
      }
    }
    return force;
  }

  double tension = 0; ///< of all bars, over their length
  bool throws = false;
};

/// @brief Slave nodes that are paired with nodes, or with a rigid plane.
class NodeContact final : public solve::FreeBodyContact
{
public:
  bool is_small() const override { return small; }
  bool has_friction() const override { return friction > 0; }
  double friction_max() const override { return friction; }
  solve::Pairing pairing() const override { return found; }
  std::vector<std::int8_t> status() const override { return kind; }
  std::vector<double> closable_gap() const override { return gap; }
  std::vector<double> facet_size() const override
  {
    return std::vector<double>(kind.size(), size);
  }

  solve::FrictionState friction_state() override
  {
    const std::size_t n = kind.size(), g = gdim;
    std::vector<double> normal;
    for (std::size_t i = 0; i < n; ++i)
      normal.insert(normal.end(), &found.normals[3 * i],
                    &found.normals[3 * i] + g);
    const std::vector<double> c(n, 1.0), mu(n, friction), area(n, 0.1),
        mobile(n * g, 1.0);
    std::vector<double> value(n * g), by_gap(n * g), by_traction(n * g * g),
        by_slip(n * g * g), by_normal(n * g * g);
    law::frictional_complementarity(
        {gdim, traction, gap, normal, slip, c, mu}, area, kind, mobile,
        {value, by_traction, by_gap, by_slip, by_normal});
    std::vector<std::int8_t> has_friction(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      double pressure = 0;
      for (std::size_t k = 0; k < g; ++k)
        pressure += normal[i * g + k] * traction[i * g + k];
      has_friction[i] = friction * pressure > 0;
    }
    return {normal, traction, slip, value, area, has_friction};
  }

  void close(std::span<const std::int32_t> which) override
  {
    for (const std::int32_t i : which)
      kind[i] = friction > 0 ? law::stick : law::slip;
  }

  void set_tractions(std::span<const std::int32_t> which,
                     std::span<const double> tractions) override
  {
    for (std::size_t k = 0; k < which.size(); ++k)
      for (int c = 0; c < gdim; ++c)
        traction[which[k] * gdim + c] = tractions[k * gdim + c];
  }

  /// @brief Add a slave node with its gap, that is paired with a node or, at
  /// -1, with a plane.
  void add(std::int32_t slave, std::int32_t master,
           std::array<double, 3> normal, double at)
  {
    const auto i = static_cast<std::int32_t>(kind.size());
    kind.push_back(law::open);
    gap.push_back(at);
    slip.resize(slip.size() + gdim);
    traction.resize(slip.size());
    found.paired.push_back(1);
    found.normals.insert(found.normals.end(), normal.begin(), normal.end());
    const auto weigh = [&](std::int32_t node, double value)
    {
      found.weights.slaves.push_back(i);
      found.weights.nodes.push_back(node);
      found.weights.values.push_back(value);
    };
    weigh(slave, 1);
    if (master >= 0)
      weigh(master, -1);
  }

  int gdim = 2;
  double size = 1; ///< of facets
  bool small = false;
  double friction = 0;
  solve::Pairing found;
  std::vector<std::int8_t> kind;
  std::vector<double> gap, slip, traction;
};

/// @brief A truss with its bodies, on one rank or several: those on all of
/// them.
struct FreeScene : WholeMesh
{
  explicit FreeScene(const Truss& given, mesh::Ranks* ranks = nullptr)
      : WholeMesh(given.num_nodes(), ranks), truss(given)
  {
    const auto nodes
        = halo(truss.x, truss.gdim,
               std::make_shared<std::vector<double>>(truss.x.size()));
    bulk = std::make_shared<TrussBulk>(*this, nodes, truss);
    const auto cells = bulk->cells();
    bodies = std::make_shared<mesh::Bodies>(
        cells, 2, static_cast<std::int32_t>(cells.size() / 2),
        nodes->original(), nodes);
  }

  std::shared_ptr<NodeContact> add_contact(double friction = 0)
  {
    auto contact = std::make_shared<NodeContact>();
    contact->gdim = truss.gdim;
    contact->friction = friction;
    contacts.push_back(contact);
    return contact;
  }

  /// @brief What keeps the bodies solvable; once all contacts are there.
  solve::FreeBodies free_bodies() const
  {
    return {bodies, bulk, contacts, std::span(number).first(num_owned)};
  }

  /// @brief The same at the start of a step.
  solve::FreeBodies begun() const
  {
    solve::FreeBodies free = free_bodies();
    free.begin_step();
    return free;
  }

  /// @brief Forces on the nodes of the truss, loads of size one.
  solve::Forces loads(std::vector<double> load,
                      std::vector<double> of_bulk = {}) const
  {
    if (of_bulk.empty())
      of_bulk = load;
    const auto mine = [this](std::vector<double> force)
    {
      force = here(force, truss.gdim);
      force.resize(num_owned * truss.gdim);
      for (double& f : force)
        f = -f;
      return [force] { return force; };
    };
    return {mine(load), mine(of_bulk), [] { return 1.0; }};
  }

  /// @brief The same force on some nodes of the truss, from one on.
  std::vector<double> push(std::int32_t first, std::vector<double> force) const
  {
    std::vector<double> load(truss.x.size());
    for (std::size_t i = first * truss.gdim; i < load.size(); ++i)
      load[i] = force[i % truss.gdim];
    return load;
  }

  Truss truss;
  std::shared_ptr<mesh::Bodies> bodies;
  std::shared_ptr<TrussBulk> bulk;
  std::vector<std::shared_ptr<solve::FreeBodyContact>> contacts;
};
} // namespace contactx::tests
