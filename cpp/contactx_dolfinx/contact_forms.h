// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "halo.h"
#include "input.h"
#include <contactx/contact/contact.h>
#include <contactx/kernel/registry.h>
#include <dolfinx/common/IndexMap.h>
#include <dolfinx/fem/Constant.h>
#include <dolfinx/fem/CoordinateElement.h>
#include <dolfinx/fem/DofMap.h>
#include <dolfinx/fem/ElementDofLayout.h>
#include <dolfinx/fem/FiniteElement.h>
#include <dolfinx/fem/Form.h>
#include <dolfinx/fem/Function.h>
#include <dolfinx/graph/AdjacencyList.h>
#include <dolfinx/la/Vector.h>
#include <dolfinx/mesh/Mesh.h>
#include <map>
#include <memory>
#include <numeric>
#include <vector>

namespace contactx_dolfinx
{
/// @brief A mesh whose cells stand for pairs or slave nodes, and spaces on it
/// that borrow dofs which exist already.
///
/// Nothing geometric is read from it: every cell is the same tetrahedron.
class CarrierMesh
{
public:
  /// @brief Make the mesh; all ranks must take part.
  /// @param[in] comm Communicator.
  /// @param[in] num_cells Number of cells of this rank.
  CarrierMesh(MPI_Comm comm, std::int32_t num_cells)
  {
    namespace dx = ::dolfinx;
    const auto type = dx::mesh::CellType::tetrahedron;
    const auto vertices = std::make_shared<const dx::common::IndexMap>(comm, 4);
    map = std::make_shared<const dx::common::IndexMap>(comm, num_cells);
    std::vector<std::int32_t> cells(std::size_t(4) * num_cells);
    for (std::size_t i = 0; i < cells.size(); ++i)
      cells[i] = static_cast<std::int32_t>(i % 4);
    const auto topology = std::make_shared<dx::mesh::Topology>(
        std::vector{type}, vertices, std::vector{map},
        std::vector{std::make_shared<dx::graph::AdjacencyList<std::int32_t>>(
            dx::graph::regular_adjacency_list(cells, 4))});
    std::vector<std::int64_t> input(4);
    std::iota(input.begin(), input.end(), 4 * dx::MPI::rank(comm));
    dx::mesh::Geometry<double> geometry(
        vertices, std::vector<std::vector<std::int32_t>>{std::move(cells)},
        std::vector{dx::fem::CoordinateElement<double>(type, 1)},
        std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 3,
        std::move(input));
    this->mesh = std::make_shared<const dx::mesh::Mesh<double>>(
        comm, topology, std::move(geometry));
  }

  /// @brief Make a space whose dofs are those of an index map.
  /// @param[in] index_map Map of the blocks that are borrowed.
  /// @param[in] dofs Blocks of each cell (shape=(num_cells, width)).
  /// @param[in] width Blocks a cell.
  /// @param[in] bs Dofs a block.
  /// @throws std::logic_error if dofmap and element disagree on the width.
  std::shared_ptr<const FunctionSpace>
  borrow(std::shared_ptr<const dolfinx::common::IndexMap> index_map,
         std::vector<std::int32_t> dofs, int width, int bs) const
  {
    namespace dx = ::dolfinx;
    // The dofmap has its width from the layout, packed coefficients their
    // stride from the element
    std::vector<int> inside(width);
    std::iota(inside.begin(), inside.end(), 0);
    const std::vector<std::vector<std::vector<int>>> entities{
        {{}}, {{}}, {{}}, {inside}};
    const std::vector<double> points(std::size_t(3) * width, 0.25);
    std::vector<std::size_t> shape;
    if (bs > 1)
      shape.push_back(bs);
    const auto element = std::make_shared<const dx::fem::FiniteElement<double>>(
        dx::mesh::CellType::tetrahedron, points,
        std::array{std::size_t(width), std::size_t(3)}, shape);
    const auto dofmap = std::make_shared<const dx::fem::DofMap>(
        dx::fem::ElementDofLayout(bs, entities, entities, {}, {}),
        std::move(index_map), bs, std::move(dofs), bs);
    if (dofmap->map().extent(1) != std::size_t(width)
        or element->space_dimension() != bs * width)
      throw std::logic_error("a borrowed space has another width than asked "
                             "for: take DOLFINx 0.11");
    return std::make_shared<const FunctionSpace>(mesh, element, dofmap);
  }

  /// @brief Make a form over all cells.
  /// @param[in] spaces Spaces of the arguments.
  /// @param[in] kernel The kernel.
  /// @param[in] active Numbers of the coefficients that it reads.
  /// @param[in] coefficients Coefficients in the order of their values.
  std::shared_ptr<const Form>
  form(const std::vector<std::shared_ptr<const FunctionSpace>>& spaces,
       contactx::kernel::Kernel* kernel, std::vector<int> active,
       const std::vector<std::shared_ptr<const Function>>& coefficients) const
  {
    namespace fem = dolfinx::fem;
    std::vector<std::int32_t> every(map->size_local());
    std::iota(every.begin(), every.end(), 0);
    std::map<std::tuple<fem::IntegralType, int, int>,
             fem::integral_data<double>>
        cells;
    cells.insert({{fem::IntegralType::cell, 0, 0},
                  {kernel, std::move(every), std::move(active)}});
    return std::make_shared<const Form>(
        spaces, std::move(cells), mesh, coefficients,
        std::vector<std::shared_ptr<const fem::Constant<double>>>(), false,
        std::vector<std::reference_wrapper<const dolfinx::mesh::EntityMap>>());
  }

  /// The mesh, and the index map of its cells
  std::shared_ptr<const dolfinx::mesh::Mesh<double>> mesh;
  std::shared_ptr<const dolfinx::common::IndexMap> map;
};

/// @brief Residual and Jacobian of one contact as forms of DOLFINx.
///
/// The parts are those of [[K, B], [C, D]] and [F_u, F_lambda]; the unknowns
/// are the displacement and the multipliers of the slave nodes, force/area.
/// Each part is a list of forms that add up, one for each kind of master
/// facet; it is empty where the part vanishes, as K does in small sliding. The
/// forms are assembled as any others: the spaces of the displacement borrow the
/// dofs of the bulk, those of the multipliers have a block a slave node. Dofs
/// of the displacement that only the contact needs are further ghosts, behind
/// those of the bulk, so that vectors and matrices of the forms are made with
/// `displacement_map`.
class ContactForms
{
public:
  using List = std::vector<std::shared_ptr<const Form>>;
  using IndexMap = std::shared_ptr<const dolfinx::common::IndexMap>;

  /// @brief Make the forms; all ranks must take part.
  /// @param[in] contact The contact.
  /// @param[in] adapter What its halo asks.
  /// @param[in] comm Communicator of the bulk.
  ContactForms(std::shared_ptr<contactx::contact::Contact> contact,
               std::shared_ptr<const HaloAdapter> adapter, MPI_Comm comm)
      : multiplier_size(contact->nodes()->size()), _contact(std::move(contact)),
        _adapter(std::move(adapter)), _comm(comm)
  {
    const contactx::law::NodeState& nodes = *_contact->nodes();
    const int g = nodes.gdim(), size = multiplier_size;
    multiplier_map = slave_map();
    using enum contactx::kernel::Coefficient;
    keep(multiplier, nodes.multiplier, size);
    keep(area, nodes.area, 1);
    std::ranges::fill(_vectors.at(area)->array(),
                      contactx::kernel::area_elsewhere);
    keep(gap_derivative, nodes.by_gap, size);
    if (nodes.is_vector())
    {
      keep(slip_derivative, nodes.by_slip, g * g);
      keep(normal_derivative, nodes.by_normal, g * g);
    }
    make_nodal();
  }

  /// @brief Take over the pairs and the state as they are now; all ranks must
  /// take part.
  void update()
  {
    const contactx::mesh::Halo& halo = _contact->halo();
    bool same = _version > 0 and _halo_version == halo.version()
                and _kinematics == _contact->kinematics()
                and _pairs.size() == _contact->pairs().size();
    for (const auto& pairs : _contact->pairs())
      same = same and _pairs.contains(kind_of(*pairs))
             and pairs->same(*_pairs.at(kind_of(*pairs)));
    _pairs.clear();
    for (const auto& pairs : _contact->pairs())
      _pairs[kind_of(*pairs)] = pairs;
    if (not contactx::mesh::everywhere(halo.ranks(), same))
      make();
    for (const auto& [kind, pairs] : _pairs)
      for (const auto& [c, vector] : _data.at(kind))
        std::ranges::copy(c == contactx::kernel::Coefficient::pair
                              ? pairs->data
                              : pairs->slip,
                          vector->array().begin());
    std::ranges::copy(halo.now()->u,
                      _vectors.at(contactx::kernel::Coefficient::displacement)
                          ->array()
                          .begin());
    for (const auto& [values, vector] : _kept)
      std::ranges::copy(*values, vector->array().begin());
  }

  /// @brief Counts how often the forms have been made anew, as pairs or ghosts
  /// are others: matrices of other versions have other patterns. The same on
  /// all ranks.
  std::int64_t version() const { return _version; }

  /// Forces of contact, -A lambda . (v_s - sum_l N_l v_l)
  List F_u;
  /// Complementarity function, a force
  List F_lambda;
  List K; ///< derivative of F_u with respect to the displacement
  List B; ///< derivative of F_u with respect to the multiplier
  List C; ///< derivative of F_lambda with respect to the displacement
  List D; ///< derivative of F_lambda with respect to the multiplier

  /// Index map of the displacement's blocks, those of the bulk first
  IndexMap displacement_map;
  /// Index map of the slave nodes: those that this rank owns, then those of
  /// other ranks that share facets with them
  IndexMap multiplier_map;
  /// Components of a multiplier: 1, or the geometric dimension
  int multiplier_size;

private:
  using Vector = std::shared_ptr<dolfinx::la::Vector<double>>;
  // Numbers of slave and master nodes, whether pairs measure movement alone
  using Kind = std::array<int, 3>;
  static constexpr int most_nodes = 9;
  // Of the messages in which index maps find out who has their ghosts
  static constexpr int tag = 7091;

  static Kind kind_of(const contactx::kernel::Pairs& pairs)
  {
    return {pairs.num_slaves, pairs.num_nodes, pairs.is_movement};
  }

  static std::vector<int> to_int(std::span<const std::int32_t> values)
  {
    return {values.begin(), values.end()};
  }

  Vector vector(const IndexMap& map, int bs) const
  {
    return std::make_shared<dolfinx::la::Vector<double>>(map, bs);
  }

  /// Lets a vector of the slave nodes follow values of their state.
  Vector keep(const std::vector<double>& values, int bs)
  {
    _kept.emplace_back(&values, vector(multiplier_map, bs));
    return _kept.back().second;
  }

  void keep(contactx::kernel::Coefficient c, const std::vector<double>& values,
            int bs)
  {
    _vectors[c] = keep(values, bs);
  }

  IndexMap slave_map() const
  {
    const contactx::mesh::Halo& halo = _contact->halo();
    const contactx::contact::SlaveNodes& slaves = _contact->slaves();
    const auto owned = slaves.owned();
    const auto n = static_cast<std::int32_t>(owned.size());
    auto map = std::make_shared<const dolfinx::common::IndexMap>(_comm, n);
    if (halo.ranks().size() == 1)
      return map;
    std::vector<std::int64_t> numbers(halo.num_nodes());
    for (std::int32_t i = 0; i < n; ++i)
      numbers[owned[i]] = map->local_range()[0] + i;
    halo.forward(std::span<std::int64_t>(numbers), 1);
    const auto others = std::span(slaves.around()).subspan(n);
    std::vector<std::int64_t> ghosts;
    for (const std::int32_t node : others)
      ghosts.push_back(numbers[node]);
    return std::make_shared<const dolfinx::common::IndexMap>(
        _comm, n, ghosts, to_int(halo.owners(others)), tag);
  }

  /// Makes the forms of the part that slave nodes have by themselves.
  void make_nodal()
  {
    const contactx::law::NodeState& nodes = *_contact->nodes();
    const int size = multiplier_size;
    const CarrierMesh carrier(_comm, nodes.num_nodes());
    std::vector<std::int32_t> own(nodes.num_nodes());
    std::iota(own.begin(), own.end(), 0);
    const auto S = carrier.borrow(multiplier_map, own, 1, size);
    const auto T = carrier.borrow(multiplier_map, own, 1, size * size);
    F_lambda = {carrier.form(
        {S}, contactx::kernel::nodal(size), {0},
        {std::make_shared<const Function>(S, keep(nodes.value, size))})};
    D = {carrier.form({S, S}, contactx::kernel::nodal(size * size), {0},
                      {std::make_shared<const Function>(
                          T, keep(nodes.by_multiplier, size * size))})};
  }

  void make()
  {
    ++_version;
    const contactx::mesh::Halo& halo = _contact->halo();
    _halo_version = halo.version();
    _kinematics = _contact->kinematics();
    displacement_map = _adapter->index_map();
    using enum contactx::kernel::Coefficient;
    for (const auto c : {displacement, position})
      _vectors[c] = vector(displacement_map, halo.gdim());
    std::ranges::copy(halo.reference(), _vectors.at(position)->array().begin());
    for (List* part : {&F_u, &K, &B, &C})
      part->clear();
    _data.clear();
    // All ranks have the same forms, be it without pairs
    constexpr int n = most_nodes + 1;
    std::vector<double> found(2 * n * n);
    for (const auto& [kind, pairs] : _pairs)
      found[2 * (n * kind[0] + kind[1]) + kind[2]] = 1;
    halo.ranks().reduce(std::span<double>(found),
                        contactx::mesh::Reduction::largest);
    for (int i = 0; i < 2 * n * n; ++i)
      if (found[i] > 0)
        make({i / (2 * n), i / 2 % n, i % 2});
  }

  /// Makes the forms of pairs of one kind.
  void make(const Kind& kind)
  {
    const auto [num_slaves, num_nodes, is_movement] = kind;
    const int gdim = _contact->halo().gdim();
    static const contactx::kernel::Pairs none;
    const auto at = _pairs.find(kind);
    const contactx::kernel::Pairs& pairs
        = at == _pairs.end() ? none : *at->second;
    // The kernels of a tie measure movement
    const auto law
        = is_movement ? contactx::kernel::Law::tied : _contact->kernel_law();
    const CarrierMesh carrier(
        _comm, static_cast<std::int32_t>(pairs.slaves.size() / num_slaves));
    std::vector<std::int32_t> every(carrier.map->size_local());
    std::iota(every.begin(), every.end(), 0);

    // Coefficients that exist, in their order, and the place of each
    const auto table
        = contactx::kernel::coefficients(law, num_nodes, gdim, num_slaves);
    std::map<std::pair<contactx::kernel::Site, int>,
             std::shared_ptr<const FunctionSpace>>
        spaces;
    const auto space = [&](contactx::kernel::Site site, int bs)
    {
      auto& V = spaces[{site, bs}];
      if (not V)
        V = site == contactx::kernel::Site::nodes
                ? carrier.borrow(displacement_map, pairs.nodes,
                                 num_slaves + num_nodes, bs)
            : site == contactx::kernel::Site::slave
                ? carrier.borrow(multiplier_map, pairs.slaves, num_slaves, bs)
                : carrier.borrow(carrier.map, every, 1, bs);
      return V;
    };
    std::vector<std::shared_ptr<const Function>> coefficients;
    std::map<contactx::kernel::Coefficient, int> places;
    auto& data = _data[kind];
    for (int i = 0; i < contactx::kernel::num_coefficients; ++i)
    {
      const auto c = static_cast<contactx::kernel::Coefficient>(i);
      if (table[i].size == 0)
        continue;
      if (table[i].site == contactx::kernel::Site::pair)
        data[c] = vector(carrier.map, table[i].size);
      places[c] = static_cast<int>(coefficients.size());
      coefficients.push_back(std::make_shared<const Function>(
          space(table[i].site, table[i].size),
          data.contains(c) ? data.at(c) : _vectors.at(c)));
    }

    const auto U = space(contactx::kernel::Site::nodes, gdim);
    const auto S = space(contactx::kernel::Site::slave, multiplier_size);
    const auto add
        = [&](List& part, std::string_view term,
              const std::vector<std::shared_ptr<const FunctionSpace>>& of)
    {
      const contactx::kernel::Entry* entry = contactx::kernel::find_if_any(
          law,
          _kinematics == contactx::contact::Sliding::small ? "small" : "finite",
          term, num_nodes, gdim, num_slaves);
      if (not entry or (is_movement and term != "constraint"))
        return;
      std::vector<int> active;
      for (const contactx::kernel::Coefficient c : entry->active)
        active.push_back(places.at(c));
      part.push_back(
          carrier.form(of, entry->function, std::move(active), coefficients));
    };
    add(F_u, "residual", {U});
    add(K, "stiffness", {U, U});
    add(B, "traction", {U, S});
    add(C, "constraint", {S, U});
  }

  std::shared_ptr<contactx::contact::Contact> _contact;
  std::shared_ptr<const HaloAdapter> _adapter;
  MPI_Comm _comm;
  std::int64_t _version = 0;
  int _halo_version = -1;
  contactx::contact::Sliding _kinematics{};
  std::map<Kind, std::shared_ptr<const contactx::kernel::Pairs>> _pairs;
  // What the forms read: the state, all of it and where it comes from, and the
  // data of pairs
  std::map<contactx::kernel::Coefficient, Vector> _vectors;
  std::vector<std::pair<const std::vector<double>*, Vector>> _kept;
  std::map<Kind, std::map<contactx::kernel::Coefficient, Vector>> _data;
};
} // namespace contactx_dolfinx
