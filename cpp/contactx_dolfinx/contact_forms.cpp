// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_forms.h"
#include "halo.h"
#include <algorithm>
#include <contactx/kernel/registry.h>
#include <dolfinx/fem/Constant.h>
#include <numeric>
#include <stdexcept>

namespace contactx_dolfinx
{
namespace
{
// Of a facet
constexpr int most_nodes = 9;

// Of the messages in which index maps find out who has their ghosts
constexpr int slave_tag = 7091;

std::vector<int> to_int(std::span<const std::int32_t> values)
{
  return {values.begin(), values.end()};
}
} // namespace

CarrierMesh::CarrierMesh(MPI_Comm comm, std::int32_t num_cells)
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

std::shared_ptr<const FunctionSpace>
CarrierMesh::borrow(std::shared_ptr<const dolfinx::common::IndexMap> index_map,
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

std::shared_ptr<const Form> CarrierMesh::form(
    const std::vector<std::shared_ptr<const FunctionSpace>>& spaces,
    contactx::kernel::Kernel* kernel, std::vector<int> active,
    const std::vector<std::shared_ptr<const Function>>& coefficients) const
{
  namespace fem = dolfinx::fem;
  std::vector<std::int32_t> every(map->size_local());
  std::iota(every.begin(), every.end(), 0);
  std::map<std::tuple<fem::IntegralType, int, int>, fem::integral_data<double>>
      cells;
  cells.insert({{fem::IntegralType::cell, 0, 0},
                {kernel, std::move(every), std::move(active)}});
  return std::make_shared<const Form>(
      spaces, std::move(cells), mesh, coefficients,
      std::vector<std::shared_ptr<const fem::Constant<double>>>(), false,
      std::vector<std::reference_wrapper<const dolfinx::mesh::EntityMap>>());
}

ContactForms::ContactForms(std::shared_ptr<contactx::contact::Contact> contact,
                           std::shared_ptr<const HaloAdapter> adapter,
                           MPI_Comm comm)
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

void ContactForms::update()
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
      std::ranges::copy(c == contactx::kernel::Coefficient::pair ? pairs->data
                                                                 : pairs->slip,
                        vector->array().begin());
  std::ranges::copy(halo.now()->u,
                    _vectors.at(contactx::kernel::Coefficient::displacement)
                        ->array()
                        .begin());
  for (const auto& [values, vector] : _kept)
    std::ranges::copy(*values, vector->array().begin());
}

ContactForms::Vector ContactForms::vector(const IndexMap& map, int bs) const
{
  return std::make_shared<dolfinx::la::Vector<double>>(map, bs);
}

ContactForms::Vector ContactForms::keep(const std::vector<double>& values,
                                        int bs)
{
  _kept.emplace_back(&values, vector(multiplier_map, bs));
  return _kept.back().second;
}

void ContactForms::keep(contactx::kernel::Coefficient c,
                        const std::vector<double>& values, int bs)
{
  _vectors[c] = keep(values, bs);
}

ContactForms::IndexMap ContactForms::slave_map() const
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
      _comm, n, ghosts, to_int(halo.owners(others)), slave_tag);
}

void ContactForms::make_nodal()
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

void ContactForms::make()
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

void ContactForms::make(const Kind& kind)
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
} // namespace contactx_dolfinx
