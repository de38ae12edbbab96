// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "cell_forces.h"
#include "halo.h"
#include "petsc.h"
#include <cmath>
#include <contactx/newton/bulk.h>
#include <contactx/newton/not_finite.h>
#include <dolfinx/fem/DirichletBC.h>
#include <dolfinx/fem/Form.h>
#include <dolfinx/fem/assembler.h>
#include <dolfinx/fem/petsc.h>
#include <dolfinx/mesh/utils.h>
#include <optional>
#include <string>

namespace contactx::dolfinx
{
/// @brief Bodies without contact: forms of DOLFINx, as the core's Newton loop
/// sees them.
class Bulk final : public newton::Bulk
{
public:
  /// @brief Take the forms.
  /// @param[in] F Residual.
  /// @param[in] J Its derivative by the displacement.
  /// @param[in] u Displacement.
  /// @param[in] bcs Dirichlet conditions, whose values may change.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] adapter What that one asks; it lives as long as the halo.
  Bulk(std::shared_ptr<const Form> F, std::shared_ptr<const Form> J,
       std::shared_ptr<Function> u,
       std::vector<std::shared_ptr<const DirichletBC>> bcs,
       std::shared_ptr<parallel::Halo> halo, HaloAdapter& adapter)
      : _F(std::move(F)), _J(std::move(J)), _u(std::move(u)),
        _bcs(std::move(bcs)), _halo(std::move(halo)), _adapter(&adapter),
        _forces(_F, _u->function_space()),
        _b(_u->function_space()->dofmap()->index_map, _halo->gdim()),
        _markers(_u->x()->array().size(), 0),
        _cells(mesh::linear_cells(cells_of(*_u->function_space()))),
        _size(std::size_t(_halo->num_owned()) * _halo->gdim())
  {
    for (const auto& bc : _bcs)
      bc->mark_dofs(_markers);
    // That of a linear bulk does not depend on the displacement
    const auto& in = _J->coefficients();
    _is_linear = std::ranges::none_of(in, [this](const auto& c)
                                      { return c.get() == _u.get(); });
  }

  void read() override { _adapter->update_ghosts(); }

  /// @copydoc newton::Bulk::has_own_jacobian
  ///
  /// A program always gives it.
  bool has_own_jacobian() const override { return true; }
  /// @brief The displacement.
  const std::shared_ptr<Function>& u() const { return _u; }

  int gdim() const override { return _halo->gdim(); }
  bool is_linear() const override { return _is_linear; }

  std::span<const double> reference() override { return _halo->reference(); }

  std::span<const double> positions() override
  {
    return _positions = _halo->positions();
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

  std::span<const double> diagonal() override
  {
    petsc::OwnVec diagonal;
    petsc::check(MatCreateVecs(matrix(), nullptr, diagonal.put()),
                 "MatCreateVecs");
    petsc::check(MatGetDiagonal(matrix(), diagonal.get()), "MatGetDiagonal");
    return _diagonal = copied(diagonal.get());
  }

  std::span<const double> products(std::span<const double> fields,
                                   int count) override
  {
    petsc::OwnVec x, y;
    petsc::check(MatCreateVecs(matrix(), x.put(), y.put()), "MatCreateVecs");
    _products.resize(fields.size());
    for (int k = 0; k < count; ++k)
    {
      std::ranges::copy(fields.subspan(k * _size, _size),
                        petsc::Values(x.get()).span().begin());
      petsc::check(MatMult(matrix(), x.get(), y.get()), "MatMult");
      std::ranges::copy(petsc::ConstValues(y.get()).span(),
                        _products.begin() + k * _size);
    }
    return _products;
  }

  std::span<const double> residual() override
  {
    std::ranges::fill(_b.array(), 0);
    ::dolfinx::fem::assemble_vector(_b.array(), *_F);
    return _residual = sums();
  }

  std::span<const double> defect() override
  {
    return std::span<const double>(all_defects()).first(_size);
  }

  std::span<const double> lifted() override
  {
    std::ranges::fill(_b.array(), 0);
    ::dolfinx::fem::apply_lifting(_b.array(), {*_J}, {conditions()},
                                  {std::span<const double>(_u->x()->array())},
                                  -1.0);
    return _lifted = sums();
  }

  void set_displacements(std::span<const double> u) override
  {
    std::ranges::copy(u, _u->x()->array().begin());
    _adapter->update_ghosts();
  }

  std::span<const std::int32_t> cells() override
  {
    return all_cells().first(std::size_t(num_owned_cells()) * nodes_per_cell());
  }

  /// @brief Nodes of all linear cells between the nodes, ghosts included
  /// (shape=(num_cells, nodes_per_cell)).
  std::span<const std::int32_t> all_cells() const { return _cells; }

  /// @brief Number of these that belong to cells of this rank.
  std::int32_t num_owned_cells() const
  {
    const auto& V = *_u->function_space();
    const auto& topology = *V.mesh()->topology();
    return topology.index_map(topology.dim())->size_local()
           * cells_of(V).num_parts();
  }

  int nodes_per_cell() const override
  {
    return mesh::num_vertices(cells_of(*_u->function_space()).type);
  }

  std::span<const double> cell_sizes() override
  {
    const mesh::Cells cells = cells_of(*_u->function_space());
    const auto& domain = *_u->function_space()->mesh();
    std::vector<std::int32_t> every(cells.size());
    std::iota(every.begin(), every.end(), 0);
    const std::vector<double> h
        = ::dolfinx::mesh::h(domain, every, domain.topology()->dim());
    std::vector<double> sizes(_halo->num_bulk(), 0);
    for (std::int32_t c = 0; c < cells.size(); ++c)
      for (const std::int32_t node : cells[c])
        sizes[node] = std::max(sizes[node], h[c]);
    sizes.resize(_halo->num_owned());
    return _cell_sizes = std::move(sizes);
  }

  /// @copydoc newton::Bulk::cell_forces
  ///
  /// Terms are the integrals of the residual, see CellForces.
  std::span<const double> cell_forces() override
  {
    return _cell_forces = _forces.magnitudes(*_halo);
  }

  /// @brief Jacobian, with unit rows and columns at Dirichlet conditions,
  /// assembled anew where a coefficient or a constant of its form has changed:
  /// that of a linear bulk once. All ranks must take part.
  /// @throws newton::NotFinite on all ranks if it is not finite.
  ::Mat matrix()
  {
    std::vector<double> with = ::dolfinx::fem::pack_constants(*_J);
    for (const auto& c : _J->coefficients())
      with.insert(with.end(), c->x()->array().begin(), c->x()->array().end());
    // NaN is unlike itself
    if (parallel::everywhere(_halo->ranks(),
                             _assembled_with and *_assembled_with == with))
      return _A.get();
    _assembled_with.reset();
    if (_A.get() == nullptr)
      *_A.put() = ::dolfinx::fem::petsc::create_matrix(*_J);
    const ::Mat A = _A.get();
    petsc::check(MatZeroEntries(A), "MatZeroEntries");
    ::dolfinx::fem::assemble_matrix(
        ::dolfinx::la::petsc::Matrix::set_block_fn(A, ADD_VALUES), *_J,
        conditions());
    petsc::check(MatAssemblyBegin(A, MAT_FLUSH_ASSEMBLY), "MatAssemblyBegin");
    petsc::check(MatAssemblyEnd(A, MAT_FLUSH_ASSEMBLY), "MatAssemblyEnd");
    ::dolfinx::fem::set_diagonal<double>(
        ::dolfinx::la::petsc::Matrix::set_fn(A, INSERT_VALUES),
        *_u->function_space(), conditions());
    petsc::check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
    petsc::check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
    PetscReal norm = 0;
    petsc::check(MatNorm(A, NORM_FROBENIUS, &norm), "MatNorm");
    if (not std::isfinite(norm))
      throw newton::NotFinite(
          "the Jacobian is not finite: it does not exist at this displacement, "
          "or a coefficient of it is NaN or infinite. Start from another "
          "displacement, or repair the coefficient (manual: "
          "errors/jacobian-not-finite)");
    _assembled_with = std::move(with);
    ++_assemblies;
    return A;
  }

  /// @brief Number of assemblies of the Jacobian.
  int assemblies() const { return _assemblies; }

private:
  std::vector<std::reference_wrapper<const DirichletBC>> conditions() const
  {
    std::vector<std::reference_wrapper<const DirichletBC>> bcs;
    for (const auto& bc : _bcs)
      bcs.push_back(*bc);
    return bcs;
  }

  const std::vector<double>& all_defects()
  {
    const std::span<const double> u = _u->x()->array();
    _defect.assign(u.size(), 0);
    for (const auto& bc : _bcs)
      bc->set(_defect, u, -1);
    return _defect;
  }

  std::vector<double> sums()
  {
    _b.scatter_rev(std::plus<double>());
    return {_b.array().begin(), _b.array().begin() + _size};
  }

  static std::vector<double> copied(::Vec x)
  {
    const petsc::ConstValues values(x);
    return {values.span().begin(), values.span().end()};
  }

  std::shared_ptr<const Form> _F, _J;
  std::shared_ptr<Function> _u;
  std::vector<std::shared_ptr<const DirichletBC>> _bcs;
  std::shared_ptr<parallel::Halo> _halo;
  HaloAdapter* _adapter;
  CellForces _forces;
  ::dolfinx::la::Vector<double> _b;
  std::vector<std::int8_t> _markers;
  std::vector<std::int32_t> _cells;
  std::size_t _size;
  bool _is_linear;
  petsc::OwnMat _A;
  int _assemblies = 0;
  // Constants and coefficients of the Jacobian; nothing if it must be anew
  std::optional<std::vector<double>> _assembled_with;
  // Arrays that functions return views of
  std::vector<double> _positions, _diagonal, _products, _residual, _defect,
      _lifted, _cell_sizes, _cell_forces;
};
} // namespace contactx::dolfinx
