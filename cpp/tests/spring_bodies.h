// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "algebra.h"
#include "contact_scene.h"
#include <contactx/mesh/bodies.h>
#include <contactx/solve/loop.h>

namespace contactx::tests
{
/// @brief Fields beside displacements whose rows are stiffness times value
/// minus load, apart from each other.
class LooseFields final : public solve::Fields
{
public:
  explicit LooseFields(std::vector<std::size_t> offsets)
      : value(offsets.back(), 0), load(value), stiffness(value.size(), 1),
        prescribed(value), size(value), fixed(value.size(), 0),
        _offsets(std::move(offsets))
  {
  }

  std::vector<std::size_t> offsets() const override { return _offsets; }
  std::span<const double> values() override { return value; }
  void set(std::span<const double> values) override
  {
    std::ranges::copy(values, value.begin());
  }
  std::span<const double> residual() override
  {
    ++residuals;
    _residual.resize(value.size());
    for (std::size_t i = 0; i < value.size(); ++i)
      _residual[i] = stiffness[i] * value[i] - load[i];
    return _residual;
  }
  std::span<const double> defect() override
  {
    _defect.resize(value.size());
    for (std::size_t i = 0; i < value.size(); ++i)
      _defect[i] = fixed[i] ? value[i] - prescribed[i] : 0;
    return _defect;
  }
  std::span<const double> lifted() override
  {
    ++lifts;
    return _lifted = std::vector<double>(value.size(), 0.5);
  }
  std::span<const std::int8_t> markers() override { return fixed; }
  std::span<const double>
  absolute_products(std::span<const double> sizes) override
  {
    ++looks;
    _products.assign(sizes.size() - size.size(), 0);
    _products.insert(_products.end(), size.begin(), size.end());
    return _products;
  }

  std::vector<double> value, load, stiffness; ///< values of now
  std::vector<double> prescribed;             ///< Dirichlet values
  std::vector<double> size;                   ///< of the terms of each row
  std::vector<std::int8_t> fixed;             ///< 1 where there are some
  int residuals = 0, lifts = 0, looks = 0;    ///< how often they were asked for

private:
  std::vector<std::size_t> _offsets;
  std::vector<double> _residual, _defect, _lifted, _products;
};

/// @brief A bulk of springs. Each node has one to the ground in each direction,
/// the end of which may move; the nodes of a cell are joined by springs that
/// resist whatever moves one against the other. All arrays are in the order of
/// this rank, which has all nodes.
class SpringBulk : public solve::Bulk
{
public:
  /// @brief Take nodes, their displacement, and the nodes of all cells by their
  /// numbers in the mesh, `width` each.
  SpringBulk(const WholeMesh& mesh, std::shared_ptr<mesh::Halo> halo,
             std::shared_ptr<std::vector<double>> u,
             const std::vector<std::int32_t>& cells, int width)
      : u(std::move(u)), ground(this->u->size(), 0), ends(ground), load(ground),
        values(ground), fixed(ground.size(), 0), size(halo->num_nodes(), 0),
        cell_force(size), _halo(std::move(halo)), _width(width)
  {
    for (const std::int32_t node : cells)
      _cells.push_back(mesh.place[node]);
    for (std::size_t c = 0; c < cells.size(); c += width)
      if (mesh.owns(cells[c]))
        _own.insert(_own.end(), &_cells[c], &_cells[c] + width);
  }

  void read() override { _halo->forward(std::span(*u), gdim()); }
  bool has_own_jacobian() const override { return false; }
  int gdim() const override { return _halo->gdim(); }
  bool is_linear() const override { return linear; }
  std::span<const double> reference() override { return _halo->reference(); }
  std::span<const double> positions() override
  {
    return _positions = _halo->now()->x;
  }
  std::span<const double> displacements() override { return owned(*u); }
  std::span<const std::int8_t> markers() override { return owned(fixed); }
  std::span<const double> diagonal() override
  {
    _diagonal = ground;
    for_each_bar(
        [&](std::size_t p, std::size_t q)
        {
          _diagonal[p] += bar;
          _diagonal[q] += bar;
        });
    return owned(_diagonal);
  }
  std::span<const double> products(std::span<const double> fields,
                                   int count) override
  {
    _products.clear();
    const std::size_t n = fields.size() / count;
    for (int k = 0; k < count; ++k)
    {
      std::vector<double> field(u->size());
      std::ranges::copy(fields.subspan(k * n, n), field.begin());
      _halo->forward(std::span(field), gdim());
      const std::vector<double> force = product(field);
      _products.insert(_products.end(), force.begin(), force.begin() + n);
    }
    return _products;
  }

  std::span<const double> residual() override
  {
    ++residuals;
    _residual = product(*u);
    for (std::size_t i = 0; i < u->size(); ++i)
      _residual[i] -= ground[i] * ends[i] + load[i];
    return owned(_residual);
  }
  std::span<const double> defect() override
  {
    return owned(_defect = defects());
  }
  std::span<const double> lifted() override
  {
    ++lifts;
    _lifted = product(defects());
    for (double& force : _lifted)
      force = -force;
    return owned(_lifted);
  }
  void set_displacements(std::span<const double> values) override
  {
    std::ranges::copy(values, u->begin());
    _halo->forward(std::span(*u), gdim());
  }
  std::span<const std::int32_t> cells() override { return _own; }
  int nodes_per_cell() const override { return _width; }
  std::span<const double> cell_sizes() override
  {
    return std::span(size).first(_halo->num_owned());
  }
  std::span<const double> cell_forces() override
  {
    ++looks;
    return std::span(cell_force).first(_halo->num_owned());
  }

  solve::Fields* fields() override { return others.get(); }

  /// @brief Product of the stiffness with displacements of all nodes.
  virtual std::vector<double> product(std::span<const double> field) const
  {
    std::vector<double> force(field.size());
    for (std::size_t i = 0; i < field.size(); ++i)
      force[i] = ground[i] * field[i];
    for_each_bar(
        [&](std::size_t p, std::size_t q)
        {
          force[p] += bar * (field[p] - field[q]);
          force[q] += bar * (field[q] - field[p]);
        });
    return force;
  }

  std::shared_ptr<std::vector<double>> u;
  std::vector<double> ground;     ///< stiffness of the springs to the ground
  std::vector<double> ends;       ///< displacements of their ends
  std::vector<double> load;       ///< forces on the nodes
  std::vector<double> values;     ///< Dirichlet values
  std::vector<std::int8_t> fixed; ///< 1 where there are some
  std::vector<double> size;       ///< of the largest cell around each node
  std::vector<double> cell_force; ///< what cancels at each node
  double bar = 0;                 ///< stiffness between nodes of a cell
  bool linear = true;             ///< what is said of the stiffness
  int residuals = 0, lifts = 0, looks = 0; ///< how often they were asked for
  std::shared_ptr<LooseFields> others;     ///< other fields, or none

protected:
  template <class T>
  std::span<const T> owned(const std::vector<T>& all) const
  {
    return std::span(all).first(std::size_t(_halo->num_owned()) * gdim());
  }

  std::shared_ptr<mesh::Halo> _halo;
  int _width;
  std::vector<std::int32_t> _cells, _own;
  std::vector<double> _positions, _diagonal;

private:
  std::vector<double> defects() const
  {
    std::vector<double> result(u->size());
    for (std::size_t i = 0; i < u->size(); ++i)
      result[i] = fixed[i] ? (*u)[i] - values[i] : 0;
    return result;
  }

  template <class Visit>
  void for_each_bar(Visit visit) const
  {
    for (std::size_t c = 0; c < _cells.size(); c += _width)
      for (int b = 0; b < _width; ++b)
        for (int a = 0; a < b; ++a)
          for (int k = 0; k < gdim(); ++k)
            visit(std::size_t(gdim()) * _cells[c + a] + k,
                  std::size_t(gdim()) * _cells[c + b] + k);
  }

  std::vector<double> _products, _residual, _defect, _lifted;
};

/// @brief Two sheets whose nodes hang on springs, the ends of which the test
/// moves. The sheets' edges are cells.
struct SpringBodies
{
  ContactScene scene;
  std::shared_ptr<SpringBulk> bulk;
  std::vector<std::shared_ptr<contact::Contact>> contacts;

  explicit SpringBodies(int dim, double height = 0.05,
                        mesh::Ranks* ranks = nullptr)
      : scene(dim, height, Cells::mixed, ranks),
        bulk(std::make_shared<SpringBulk>(scene.mesh, scene.halo, scene.u,
                                          edges(), 2))
  {
    std::ranges::fill(bulk->ground, 3.0);
  }

  SpringBodies(TwoSheets surfaces, const std::vector<std::int32_t>& cells,
               int width)
      : scene(std::move(surfaces)),
        bulk(std::make_shared<SpringBulk>(scene.mesh, scene.halo, scene.u,
                                          cells, width))
  {
  }

  /// @brief Nodes of the sheets' edges, by their numbers in the mesh.
  std::vector<std::int32_t> edges() const
  {
    std::vector<std::int32_t> result;
    for (const auto* facets : {&scene.sheets.slave, &scene.sheets.master})
      for (std::int32_t f = 0; f < facets->list().size(); ++f)
      {
        const auto nodes = facets->list()[f];
        for (std::size_t i = 1; i < nodes.size(); ++i)
          result.insert(result.end(), {nodes[i - 1], nodes[i]});
      }
    return result;
  }

  /// @brief Prescribe a displacement of a node of the mesh; before contacts are
  /// added.
  void prescribe(std::int32_t node, int direction, double value)
  {
    const std::size_t dof
        = scene.sheets.gdim * scene.mesh.place[node] + direction;
    scene.prescribed[dof] = bulk->fixed[dof] = 1;
    bulk->values[dof] = value;
  }

  template <class M>
  void add(std::shared_ptr<law::Law> law
           = std::make_shared<law::Frictionless>(),
           contact::Sliding sliding = contact::Sliding::finite)
  {
    contacts.push_back(scene.contact<M>(std::move(law), sliding));
  }

  std::shared_ptr<law::Law> law(double friction) const
  {
    if (friction == 0)
      return std::make_shared<law::Frictionless>();
    return coulomb(scene.slaves->owned().size(), friction);
  }

  /// @brief Press the slave down by a dome, and aside.
  void press(double down, double aside, double steep = 3)
  {
    const int g = scene.sheets.gdim;
    for (std::int32_t node = 0; node < scene.sheets.num_slaves; ++node)
    {
      double r2 = 0;
      for (int k = 0; k < g - 1; ++k)
        r2 += std::pow(scene.sheets.x[g * node + k] - 0.5, 2);
      const std::int32_t i = scene.mesh.place[node];
      bulk->ends[g * i] = aside;
      bulk->ends[g * i + g - 1] = -down * (1 - steep * r2);
    }
  }

  std::shared_ptr<solve::System> system() const
  {
    return std::make_shared<solve::System>(scene.halo, bulk, contacts);
  }

  /// @brief Unknowns of this rank from those of one alone.
  std::vector<double> mine(const std::vector<double>& all) const
  {
    const std::vector<std::int64_t>& number = scene.mesh.number;
    std::vector<double> rows;
    const auto add = [&](std::size_t first, std::int64_t node, int width)
    {
      const auto at = all.begin() + first + width * node;
      rows.insert(rows.end(), at, at + width);
    };
    for (std::int32_t i = 0; i < scene.mesh.num_owned; ++i)
      add(0, number[i], scene.sheets.gdim);
    std::size_t first = scene.u->size();
    for (const auto& c : contacts)
    {
      // The mesh's first nodes are the slave's
      const int width = c->nodes()->size();
      for (const std::int32_t i : scene.slaves->owned())
        add(first, number[i], width);
      first += width * scene.sheets.num_slaves;
    }
    return rows;
  }

  /// @brief Bodies of the mesh: the sheets.
  std::shared_ptr<const mesh::Bodies> bodies() const
  {
    const auto cells = bulk->cells();
    const int width = bulk->nodes_per_cell();
    return std::make_shared<mesh::Bodies>(
        cells, width, static_cast<std::int32_t>(cells.size() / width),
        scene.halo->original(), scene.halo);
  }

  /// @brief Stiffness of the bulk, of one rank.
  Eigen::MatrixXd stiffness() const
  {
    const std::size_t n = scene.u->size();
    Eigen::MatrixXd K(n, n);
    for (std::size_t j = 0; j < n; ++j)
    {
      std::vector<double> field(n);
      field[j] = 1;
      K.col(j) = math::column(bulk->product(field));
    }
    return K;
  }

  /// @brief Jacobian of one rank by the unknowns of a system, which are
  /// lengths.
  Eigen::MatrixXd jacobian(const solve::System& system,
                           const std::optional<std::vector<double>>& springs
                           = {}) const
  {
    Eigen::MatrixXd J = jacobian(springs ? std::span<const double>(*springs)
                                         : std::span<const double>());
    const auto factors = math::column(system.factors());
    J.rightCols(factors.size()) *= factors.asDiagonal();
    return J;
  }

  /// @brief Take a part of a step of one rank; where it leads.
  static std::vector<double> go(solve::System& system,
                                std::span<const double> dx, double part = 1)
  {
    std::vector<double> x(system.size());
    system.unknowns(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] -= part * dx[i];
    system.take(x);
    return x;
  }

  /// @brief Jacobian of one rank, with rows and columns of Dirichlet conditions
  /// that are those of the identity, and springs on its diagonal.
  Eigen::MatrixXd jacobian(std::span<const double> springs = {}) const
  {
    const condense::ContactBlock contact(contacts, scene.prescribed);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(contact.size(), contact.size());
    const auto entries = contact.entries();
    for (std::size_t i = 0; i < contact.size(); ++i)
      for (auto e = entries.offsets[i]; e < entries.offsets[i + 1]; ++e)
        J(i, entries.columns[e]) = entries.values[e];
    const Eigen::MatrixXd K = stiffness();
    const std::size_t n = K.rows();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (not scene.prescribed[i] and not scene.prescribed[j])
          J(i, j) += K(i, j);
    for (std::size_t i = 0; i < n; ++i)
      if (scene.prescribed[i])
        J(i, i) = 1;
    for (std::size_t i = 0; i < springs.size(); ++i)
      J(i, i) += springs[i];
    return J;
  }
};
} // namespace contactx::tests
