// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "thread_ranks.h"
#include <array>
#include <cmath>
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

  /// @brief Add a disc of bars from its middle to its rim and along it; the
  /// first node of the rim is the lowest.
  /// @return Number of the middle, before those of the rim.
  std::int32_t add_disc(int n, std::array<double, 2> middle, double radius)
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
    return first;
  }
};

/// @brief A truss as the bulk. Each rank has all nodes, its own first.
class TrussBulk final : public solve::Bulk
{
public:
  /// @param[in] truss The truss.
  /// @param[in] map Nodes of this rank.
  /// @param[in] number Number in the truss of each node of this rank.
  TrussBulk(const Truss& truss, std::shared_ptr<const mesh::NodeMap> map,
            std::vector<std::int64_t> number)
      : _gdim(truss.gdim), _cells(truss.cells), _map(std::move(map)),
        _number(std::move(number)), fixed(truss.x.size()),
        ground(truss.x.size()), u(truss.x.size())
  {
    for (const std::int64_t node : _number)
      for (int c = 0; c < _gdim; ++c)
        _reference.push_back(truss.x[node * _gdim + c]);
    _x = truss.x;
  }

  int gdim() const override { return _gdim; }
  bool is_linear() const override { return linear; }
  std::span<const double> reference() override { return _reference; }
  std::span<const double> positions() override
  {
    _positions = _reference;
    for (std::size_t i = 0; i < _number.size(); ++i)
      for (int c = 0; c < _gdim; ++c)
        _positions[i * _gdim + c] += u[_number[i] * _gdim + c];
    return _positions;
  }
  std::span<const double> displacements() override
  {
    return _displacements = owned(std::span<const double>(u));
  }
  std::span<const std::int8_t> markers() override
  {
    return _markers = owned(std::span<const std::int8_t>(fixed));
  }
  std::span<const double> diagonal() override
  {
    std::vector<double> all(u.size()), field(u.size()), force;
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      field[i] = 1;
      force = product(field);
      all[i] = force[i];
      field[i] = 0;
    }
    return _diagonal = owned(std::span<const double>(all));
  }
  std::span<const double> products(std::span<const double> fields,
                                   int count) override
  {
    ++calls;
    if (throws)
      throw std::runtime_error("the stiffness is spoilt");
    _products.clear();
    const std::size_t n = fields.size() / count;
    for (int k = 0; k < count; ++k)
    {
      // Of all ranks, then in the order of the truss
      std::vector<double> here(_number.size() * _gdim), all(here.size());
      std::ranges::copy(fields.subspan(k * n, n), here.begin());
      _map->forward(std::span<double>(here), _gdim);
      for (std::size_t i = 0; i < _number.size(); ++i)
        for (int c = 0; c < _gdim; ++c)
          all[_number[i] * _gdim + c] = here[i * _gdim + c];
      const std::vector<double> force = product(all);
      const auto mine = owned(std::span<const double>(force));
      _products.insert(_products.end(), mine.begin(), mine.end());
    }
    return _products;
  }

  // Free bodies ask for none of these
  void read() override { asked(); }
  bool has_own_jacobian() const override { return false; }
  std::span<const double> residual() override { return asked(); }
  std::span<const double> defect() override { return asked(); }
  std::span<const double> lifted() override { return asked(); }
  void set_displacements(std::span<const double>) override { asked(); }
  std::span<const std::int32_t> cells() override { return _cells; }
  int nodes_per_cell() const override { return 2; }
  std::span<const double> cell_sizes() override { return asked(); }
  std::span<const double> cell_forces() override { return asked(); }

  /// @brief Product of the stiffness with a field of the truss.
  std::vector<double> product(std::span<const double> field) const
  {
    std::vector<double> force(field.size());
    for (std::size_t i = 0; i < field.size(); ++i)
      force[i] = ground[i] * field[i];
    for (std::size_t b = 0; b < _cells.size(); b += 2)
    {
      const std::size_t p = _cells[b] * _gdim, q = _cells[b + 1] * _gdim;
      double square = 0, stretch = 0;
      for (int c = 0; c < _gdim; ++c)
      {
        const double d = _x[q + c] - _x[p + c];
        square += d * d;
        stretch += d * (field[q + c] - field[p + c]);
      }
      for (int c = 0; c < _gdim; ++c)
      {
        const double part = (_x[q + c] - _x[p + c]) * stretch / square;
        // Stresses resist the turns of bars
        const double turn = tension * (field[q + c] - field[p + c]);
        force[q + c] += part + turn;
        force[p + c] -= part + turn;
      }
    }
    return force;
  }

  /// @brief Values at owned nodes or dofs, of those of the truss.
  template <class T>
  std::vector<T> owned(std::span<const T> all) const
  {
    std::vector<T> mine;
    const std::size_t width = all.size() / _number.size();
    for (std::int32_t i = 0; i < _map->num_owned(); ++i)
      for (std::size_t c = 0; c < width; ++c)
        mine.push_back(all[_number[i] * width + c]);
    return mine;
  }

private:
  static std::span<const double> asked()
  {
    throw std::logic_error("a truss has no forces");
  }

  int _gdim;
  std::vector<std::int32_t> _cells;
  std::shared_ptr<const mesh::NodeMap> _map;
  std::vector<std::int64_t> _number;
  std::vector<double> _x, _reference, _positions, _displacements, _diagonal,
      _products;
  std::vector<std::int8_t> _markers;

public:
  // Of the truss
  std::vector<std::int8_t> fixed; ///< 1 at prescribed displacements
  std::vector<double> ground;     ///< springs to the ground
  std::vector<double> u;          ///< displacement
  double tension = 0;             ///< of all bars, over their length
  bool linear = false, throws = false;
  int calls = 0;
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

  /// @brief Add a slave node.
  /// @param[in] slave The node.
  /// @param[in] master The node that it is paired with, -1 for a plane.
  /// @param[in] normal Unit normal of the master.
  /// @param[in] at Its gap.
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

/// @brief A truss with its bodies, on one rank or several.
struct FreeScene
{
  /// @param[in] truss The truss.
  /// @param[in] ranks The ranks; one alone if null.
  explicit FreeScene(Truss given, mesh::Ranks* ranks = nullptr)
      : truss(std::move(given)), number(truss.num_nodes())
  {
    const std::int32_t n = truss.num_nodes();
    std::int32_t num_owned = n;
    for (std::int32_t i = 0; i < n; ++i)
      number[i] = i;
    if (ranks)
    {
      // Nodes in turn: bodies are on all ranks
      const auto mine = [&](std::int64_t node)
      { return node * 7 % n % ranks->size() == ranks->rank(); };
      num_owned = static_cast<std::int32_t>(
          std::ranges::stable_partition(number, mine).begin() - number.begin());
      map = std::make_shared<NumberedNodes>(*ranks, number, num_owned);
    }
    else
      map = std::make_shared<mesh::SerialNodes>(n);
    place.resize(n);
    for (std::int32_t i = 0; i < n; ++i)
      place[number[i]] = i;
    std::vector<std::int32_t> cells;
    for (const std::int32_t node : truss.cells)
      cells.push_back(place[node]);
    bodies = std::make_shared<mesh::Bodies>(
        cells, 2, static_cast<std::int32_t>(cells.size() / 2), number, map);
    bulk = std::make_shared<TrussBulk>(truss, map, number);
  }

  bool owns(std::int32_t node) const { return place[node] < map->num_owned(); }

  /// @brief Add a contact.
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
    return {bodies, bulk, contacts, std::span(number).first(map->num_owned())};
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
    for (auto* forces : {&load, &of_bulk})
      for (double& force : *forces)
        force = -force;
    return {[load = bulk->owned(std::span<const double>(load))]
            { return load; },
            [of_bulk = bulk->owned(std::span<const double>(of_bulk))]
            { return of_bulk; }, [] { return 1.0; }};
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
  std::vector<std::int64_t> number; ///< in the truss, of each node here
  std::vector<std::int32_t> place;  ///< here, of each node of the truss
  std::shared_ptr<mesh::NodeMap> map;
  std::shared_ptr<mesh::Bodies> bodies;
  std::shared_ptr<TrussBulk> bulk;
  std::vector<std::shared_ptr<solve::FreeBodyContact>> contacts;
};
} // namespace contactx::tests
