// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "petsc.h"
#include "unknowns.h"
#include <contactx/mesh/halo.h>
#include <contactx/solve/bulk.h>
#include <dolfinx/la/Vector.h>
#include <functional>
#include <optional>

namespace contactx_dolfinx
{
class CellForces;
class Conductance;
class HaloAdapter;

/// @brief Bodies without contact: forms of DOLFINx, as the core's Newton loop
/// sees them. Besides the displacement there may be other fields.
class Bulk final : public contactx::solve::Bulk
{
public:
  /// @brief Take the forms.
  /// @param[in] blocks Residuals, their derivatives, and the functions.
  /// @param[in] unknowns These functions, with the displacement's place.
  /// @param[in] bcs Dirichlet conditions, whose values may change.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] adapter What that one asks.
  Bulk(const Blocks& blocks, std::shared_ptr<Unknowns> unknowns,
       std::vector<std::shared_ptr<const DirichletBC>> bcs,
       std::shared_ptr<contactx::mesh::Halo> halo,
       std::shared_ptr<HaloAdapter> adapter);
  ~Bulk() override;

  void read() override;

  /// @copydoc contactx::solve::Bulk::has_own_jacobian
  ///
  /// A program always gives it.
  bool has_own_jacobian() const override { return true; }

  /// @brief The displacement.
  const std::shared_ptr<Function>& u() const { return _u; }

  /// @brief All functions that are solved for.
  const std::vector<std::shared_ptr<Function>>& functions() const
  {
    return _unknowns->functions();
  }

  contactx::solve::Fields* fields() override;

  /// @brief Take the conductances across contacts, whose flows are added to the
  /// residuals of their fields.
  void follow(std::vector<std::shared_ptr<Conductance>> conductances);

  /// @brief These.
  const std::vector<std::shared_ptr<Conductance>>& conductances() const
  {
    return _conductances;
  }

  int gdim() const override { return _halo->gdim(); }
  bool is_linear() const override { return _is_linear; }
  std::span<const double> reference() override { return _halo->reference(); }

  std::span<const double> positions() override
  {
    return _positions = _halo->now()->x;
  }

  std::span<const double> displacements() override
  {
    return std::span<const double>(_u->x()->array()).first(_size);
  }

  std::span<const std::int8_t> markers() override
  {
    return std::span<const std::int8_t>(_markers).first(_size);
  }

  /// @brief 1 at prescribed displacements of the bulk's nodes, ghosts included,
  /// else 0 (shape=(num_bulk, gdim)).
  const std::vector<std::int8_t>& all_markers() const { return _markers; }

  /// @brief 1 at prescribed values of a function, ghosts included, else 0.
  const std::vector<std::int8_t>& markers_of(int function) const
  {
    return _markers_of[function];
  }

  std::span<const double> diagonal() override;
  std::span<const double> products(std::span<const double> fields,
                                   int count) override;
  std::span<const double> residual() override;
  std::span<const double> defect() override;
  std::span<const double> lifted() override;
  void set_displacements(std::span<const double> u) override;
  std::span<const std::int32_t> cells() override;

  /// @brief Nodes of all linear cells between the nodes, ghosts included
  /// (shape=(num_cells, nodes_per_cell)).
  std::span<const std::int32_t> all_cells() const { return _cells; }

  /// @brief Number of these that belong to cells of this rank.
  std::int32_t num_owned_cells() const;

  int nodes_per_cell() const override;
  std::span<const double> cell_sizes() override;

  /// @copydoc contactx::solve::Bulk::cell_forces
  ///
  /// Terms are the integrals of the residual, see CellForces.
  std::span<const double> cell_forces() override;

  /// @brief Jacobian of the function that has the displacement, see `block`.
  /// All ranks must take part.
  ::Mat matrix();

  /// @brief Derivative of the residual of a function by another one, as it was
  /// assembled last, with unit rows and columns at Dirichlet conditions.
  ::Mat block(int i, int j) const
  {
    return _blocks[std::size_t(i) * functions().size() + j].get();
  }

  /// @brief Assemble the Jacobian anew where a coefficient or a constant of its
  /// forms has changed: that of a linear bulk once. All ranks must take part.
  /// @throws contactx::solve::NotFinite on all ranks if it is not finite.
  void assemble();

  /// @brief Number of assemblies of the Jacobian.
  int assemblies() const { return _assemblies; }

  /// @brief Number of a function among those that are solved for.
  int number_of(const Function& w) const;

  /// @brief Calls a function with the number of the function and the dofs of
  /// the displacement, then with those of each other field: this rank's
  /// unknowns in their order.
  template <class Use>
  void for_each_part(Use&& use) const
  {
    use(index(), _unknowns->dofs());
    for (const auto& [function, dofs] : _unknowns->fields())
      use(function, dofs);
  }

private:
  class Fields;

  int index() const { return _unknowns->index(); }
  void update_ghosts();

  /// Calls a function with the numbers and the form of each block that has one.
  template <class Use>
  void for_each_block(Use&& use) const;

  std::vector<std::reference_wrapper<const DirichletBC>> conditions() const;

  /// Those of a function.
  std::vector<std::reference_wrapper<const DirichletBC>>
  conditions(int function) const;

  /// Values minus Dirichlet values of a function, zero elsewhere, ghosts
  /// included.
  std::vector<double> defects(int function) const;

  /// Values at the displacement's owned dofs of those of its function.
  void at_displacements(std::span<const double> values,
                        std::span<double> taken) const;

  std::vector<double> sums() const;

  /// Creates the matrices of the blocks.
  void create();

  MPI_Comm comm() const { return _u->function_space()->mesh()->comm(); }

  /// Assembles a block.
  void fill(int i, int j);

  /// See contactx::solve::Fields::absolute_products.
  std::vector<double> absolute_products(std::span<const double> sizes);

  std::vector<std::shared_ptr<const Form>> _F;
  std::vector<std::vector<std::shared_ptr<const Form>>> _J;
  std::shared_ptr<Unknowns> _unknowns;
  std::shared_ptr<Function> _u;
  std::vector<std::shared_ptr<const DirichletBC>> _bcs;
  std::shared_ptr<contactx::mesh::Halo> _halo;
  std::shared_ptr<HaloAdapter> _adapter;
  std::unique_ptr<CellForces> _forces; // of a displacement alone
  std::unique_ptr<Fields> _fields;     // of others beside it
  std::vector<std::shared_ptr<Conductance>> _conductances;
  // Residuals and markers of each function
  std::vector<dolfinx::la::Vector<double>> _b;
  std::vector<std::vector<std::int8_t>> _markers_of;
  std::vector<std::int8_t> _markers; // of the displacement
  std::vector<std::int32_t> _cells;
  std::size_t _size;
  bool _is_linear = true;
  std::vector<petsc::OwnMat> _blocks;
  int _assemblies = 0;
  // Constants and coefficients of the Jacobian; nothing if it must be anew
  std::optional<std::vector<double>> _assembled_with;
  // Arrays that functions return views of
  std::vector<double> _positions, _diagonal, _products, _residual, _defect,
      _lifted, _cell_sizes, _cell_forces;
};
} // namespace contactx_dolfinx
