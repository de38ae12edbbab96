// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bulk.h"
#include "cell_forces.h"
#include "cells.h"
#include "conductance.h"
#include "halo.h"
#include <algorithm>
#include <cmath>
#include <contactx/solve/not_finite.h>
#include <dolfinx/fem/assembler.h>
#include <dolfinx/fem/petsc.h>
#include <dolfinx/mesh/utils.h>
#include <numeric>

namespace contactx_dolfinx
{
namespace
{
/// Adds the product of a matrix, all entries by their size, with a vector.
void add_absolute(::Mat K, std::span<const double> x, std::span<double> sums)
{
  petsc::OwnMat absolute;
  petsc::check(MatDuplicate(K, MAT_COPY_VALUES, absolute.put()),
               "MatDuplicate");
  PetscInt first = 0, last = 0;
  petsc::check(MatGetOwnershipRange(K, &first, &last), "MatGetOwnershipRange");
  std::vector<double> sizes;
  for (PetscInt i = first; i < last; ++i)
  {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    petsc::check(MatGetRow(K, i, &count, &columns, &values), "MatGetRow");
    sizes.resize(count);
    std::transform(values, values + count, sizes.begin(),
                   [](double v) { return std::abs(v); });
    petsc::check(MatSetValues(absolute.get(), 1, &i, count, columns,
                              sizes.data(), INSERT_VALUES),
                 "MatSetValues");
    petsc::check(MatRestoreRow(K, i, &count, &columns, &values),
                 "MatRestoreRow");
  }
  petsc::check(MatAssemblyBegin(absolute.get(), MAT_FINAL_ASSEMBLY),
               "MatAssemblyBegin");
  petsc::check(MatAssemblyEnd(absolute.get(), MAT_FINAL_ASSEMBLY),
               "MatAssemblyEnd");
  petsc::OwnVec from, to;
  petsc::check(MatCreateVecs(K, from.put(), to.put()), "MatCreateVecs");
  std::ranges::copy(x, petsc::Values(from.get()).span().begin());
  petsc::check(MatMult(absolute.get(), from.get(), to.get()), "MatMult");
  const petsc::ConstValues values(to.get());
  std::ranges::transform(sums, values.span(), sums.begin(), std::plus());
}
} // namespace

/// The fields beside the displacement.
class Bulk::Fields final : public contactx::solve::Fields
{
public:
  explicit Fields(Bulk& bulk) : _bulk(&bulk)
  {
    _offsets.push_back(0);
    for (const auto& field : bulk._unknowns->fields())
      _offsets.push_back(_offsets.back() + field.dofs.size());
    take(_markers, [&](int k) -> const auto& { return bulk.markers_of(k); });
  }

  std::vector<std::size_t> offsets() const override { return _offsets; }
  std::span<const double> values() override
  {
    take(_values, [this](int k) -> const auto&
         { return _bulk->functions()[k]->x()->array(); });
    return _values;
  }
  void set(std::span<const double> values) override
  {
    auto next = values.begin();
    for (const auto& [k, dofs] : _bulk->_unknowns->fields())
      for (const std::int32_t dof : dofs)
        _bulk->functions()[k]->x()->array()[dof] = *next++;
    for (const auto& w : _bulk->functions())
      w->x()->scatter_fwd();
  }
  std::span<const double> residual() override { return _residual; }
  bool follow_contacts() const override
  {
    return not _bulk->_conductances.empty();
  }
  std::span<const double> defect() override
  {
    take(_defect, [this](int k) { return _bulk->defects(k); });
    return _defect;
  }
  std::span<const double> lifted() override { return _lifted; }
  std::span<const std::int8_t> markers() override { return _markers; }
  std::span<const double>
  absolute_products(std::span<const double> sizes) override
  {
    return _products = _bulk->absolute_products(sizes);
  }

  /// @brief Keep the residual that was assembled.
  void take_residual() { take_rows(_residual); }
  /// @brief Keep what was lifted.
  void take_lifted() { take_rows(_lifted); }

private:
  /// Values at the fields' dofs, of what `of` has of each function.
  template <class T, class Of>
  void take(std::vector<T>& taken, Of&& of) const
  {
    taken.clear();
    for (const auto& [k, dofs] : _bulk->_unknowns->fields())
    {
      const auto& values = of(k);
      for (const std::int32_t dof : dofs)
        taken.push_back(values[dof]);
    }
  }

  void take_rows(std::vector<double>& taken) const
  {
    take(taken, [this](int k) -> const auto& { return _bulk->_b[k].array(); });
  }

  Bulk* _bulk;
  std::vector<std::size_t> _offsets;
  std::vector<std::int8_t> _markers;
  std::vector<double> _values, _residual, _defect, _lifted, _products;
};

Bulk::Bulk(const Blocks& blocks, std::shared_ptr<Unknowns> unknowns,
           std::vector<std::shared_ptr<const DirichletBC>> bcs,
           std::shared_ptr<contactx::mesh::Halo> halo,
           std::shared_ptr<HaloAdapter> adapter)
    : _F(blocks.F), _J(blocks.J), _unknowns(std::move(unknowns)),
      _u(_unknowns->u()), _bcs(std::move(bcs)), _halo(std::move(halo)),
      _adapter(std::move(adapter)),
      _cells(contactx::mesh::linear_cells(cells_of(*_u->function_space()))),
      _size(std::size_t(_halo->num_owned()) * _halo->gdim())
{
  for (const auto& w : functions())
  {
    const FunctionSpace& V = *w->function_space();
    _b.emplace_back(V.dofmap()->index_map, V.dofmap()->index_map_bs());
    _markers_of.emplace_back(w->x()->array().size(), 0);
    for (const auto& bc : _bcs)
      if (V.contains(*bc->function_space()))
        bc->mark_dofs(_markers_of.back());
  }
  _markers = _unknowns->displacements_of(
      std::span<const std::int8_t>(_markers_of[index()]));
  if (_unknowns->fields().empty())
    _forces = std::make_unique<CellForces>(_F[0], _u->function_space());
  else
    _fields = std::make_unique<Fields>(*this);
  // That of a linear bulk does not depend on what is solved for
  for_each_block(
      [this](int, int, const Form& J)
      {
        for (const auto& c : J.coefficients())
          for (const auto& w : functions())
            _is_linear = _is_linear and c.get() != w.get();
      });
}

Bulk::~Bulk() = default;

contactx::solve::Fields* Bulk::fields() { return _fields.get(); }

void Bulk::read()
{
  _unknowns->read();
  update_ghosts();
}

void Bulk::follow(std::vector<std::shared_ptr<Conductance>> conductances)
{
  _conductances = std::move(conductances);
  // Pairs, gaps and pressures decide on them
  _is_linear = _is_linear and _conductances.empty();
}
std::span<const double> Bulk::diagonal()
{
  petsc::OwnVec diagonal;
  petsc::check(MatCreateVecs(matrix(), nullptr, diagonal.put()),
               "MatCreateVecs");
  petsc::check(MatGetDiagonal(matrix(), diagonal.get()), "MatGetDiagonal");
  const petsc::ConstValues values(diagonal.get());
  _diagonal.resize(_size);
  at_displacements(values.span(), _diagonal);
  return _diagonal;
}

std::span<const double> Bulk::products(std::span<const double> fields,
                                       int count)
{
  petsc::OwnVec x, y;
  petsc::check(MatCreateVecs(matrix(), x.put(), y.put()), "MatCreateVecs");
  petsc::check(VecZeroEntries(x.get()), "VecZeroEntries");
  _products.resize(fields.size());
  for (int k = 0; k < count; ++k)
  {
    {
      const petsc::Values values(x.get());
      for (std::size_t i = 0; i < _size; ++i)
        values.span()[_unknowns->dofs()[i]] = fields[k * _size + i];
    }
    petsc::check(MatMult(matrix(), x.get(), y.get()), "MatMult");
    at_displacements(petsc::ConstValues(y.get()).span(),
                     std::span(_products).subspan(k * _size, _size));
  }
  return _products;
}

std::span<const double> Bulk::residual()
{
  for (std::size_t k = 0; k < _b.size(); ++k)
  {
    std::ranges::fill(_b[k].array(), 0);
    dolfinx::fem::assemble_vector(_b[k].array(), *_F[k]);
    _b[k].scatter_rev(std::plus<double>());
  }
  for (const auto& conductance : _conductances)
  {
    const std::vector<double> flow = conductance->residual();
    auto& b = _b[number_of(*conductance->field())].array();
    std::ranges::transform(flow, b, b.begin(), std::plus());
  }
  if (_fields)
    _fields->take_residual();
  return _residual = sums();
}

std::span<const double> Bulk::defect()
{
  const std::vector<double> defect = defects(index());
  _defect.resize(_size);
  at_displacements(defect, _defect);
  return _defect;
}

std::span<const double> Bulk::lifted()
{
  for (auto& b : _b)
    std::ranges::fill(b.array(), 0);
  for_each_block(
      [this](int i, int j, const Form& J)
      {
        dolfinx::fem::apply_lifting(
            _b[i].array(), {J}, {conditions(j)},
            {std::span<const double>(functions()[j]->x()->array())}, -1.0);
      });
  for (auto& b : _b)
    b.scatter_rev(std::plus<double>());
  if (_fields)
    _fields->take_lifted();
  return _lifted = sums();
}

void Bulk::set_displacements(std::span<const double> u)
{
  std::ranges::copy(u, _u->x()->array().begin());
  update_ghosts();
}

std::span<const std::int32_t> Bulk::cells()
{
  return all_cells().first(std::size_t(num_owned_cells()) * nodes_per_cell());
}

std::int32_t Bulk::num_owned_cells() const
{
  const auto& V = *_u->function_space();
  const auto& topology = *V.mesh()->topology();
  return topology.index_map(topology.dim())->size_local()
         * cells_of(V).num_parts();
}

int Bulk::nodes_per_cell() const
{
  return contactx::mesh::num_vertices(cells_of(*_u->function_space()).type);
}

std::span<const double> Bulk::cell_sizes()
{
  const contactx::mesh::Cells cells = cells_of(*_u->function_space());
  const auto& domain = *_u->function_space()->mesh();
  std::vector<std::int32_t> every(cells.size());
  std::iota(every.begin(), every.end(), 0);
  const std::vector<double> h
      = dolfinx::mesh::h(domain, every, domain.topology()->dim());
  std::vector<double> sizes(_halo->num_bulk(), 0);
  for (std::int32_t c = 0; c < cells.size(); ++c)
    for (const std::int32_t node : cells[c])
      sizes[node] = std::max(sizes[node], h[c]);
  sizes.resize(_halo->num_owned());
  return _cell_sizes = std::move(sizes);
}

std::span<const double> Bulk::cell_forces()
{
  return _cell_forces = _forces->magnitudes(*_halo);
}

::Mat Bulk::matrix()
{
  assemble();
  return block(index(), index());
}
void Bulk::assemble()
{
  std::vector<double> with;
  for_each_block(
      [&with](int, int, const Form& J)
      {
        const auto constants = dolfinx::fem::pack_constants(J);
        with.insert(with.end(), constants.begin(), constants.end());
        for (const auto& c : J.coefficients())
          with.insert(with.end(), c->x()->array().begin(),
                      c->x()->array().end());
      });
  // NaN is unlike itself
  if (contactx::mesh::everywhere(_halo->ranks(),
                                 _assembled_with and *_assembled_with == with))
    return;
  _assembled_with.reset();
  if (_blocks.empty())
    create();
  const int n = static_cast<int>(functions().size());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      fill(i, j);
  _assembled_with = std::move(with);
  ++_assemblies;
}

int Bulk::number_of(const Function& w) const
{
  const auto at = std::ranges::find(functions(), &w,
                                    [](const auto& f) { return f.get(); });
  return static_cast<int>(at - functions().begin());
}

void Bulk::update_ghosts()
{
  _adapter->update_ghosts();
  _unknowns->write();
}

template <class Use>
void Bulk::for_each_block(Use&& use) const
{
  for (std::size_t i = 0; i < _J.size(); ++i)
    for (std::size_t j = 0; j < _J[i].size(); ++j)
      if (_J[i][j])
        use(static_cast<int>(i), static_cast<int>(j), *_J[i][j]);
}

std::vector<std::reference_wrapper<const DirichletBC>> Bulk::conditions() const
{
  std::vector<std::reference_wrapper<const DirichletBC>> bcs;
  for (const auto& bc : _bcs)
    bcs.push_back(*bc);
  return bcs;
}

std::vector<std::reference_wrapper<const DirichletBC>>
Bulk::conditions(int function) const
{
  auto bcs = conditions();
  const FunctionSpace& V = *functions()[function]->function_space();
  std::erase_if(bcs, [&V](const DirichletBC& bc)
                { return not V.contains(*bc.function_space()); });
  return bcs;
}

std::vector<double> Bulk::defects(int function) const
{
  const std::span<const double> w = functions()[function]->x()->array();
  std::vector<double> defect(w.size(), 0);
  for (const DirichletBC& bc : conditions(function))
    bc.set(defect, w, -1);
  return defect;
}

void Bulk::at_displacements(std::span<const double> values,
                            std::span<double> taken) const
{
  for (std::size_t i = 0; i < taken.size(); ++i)
    taken[i] = values[_unknowns->dofs()[i]];
}

std::vector<double> Bulk::sums() const
{
  std::vector<double> sums(_size);
  at_displacements(_b[index()].array(), sums);
  return sums;
}

void Bulk::create()
{
  const std::size_t n = functions().size();
  _blocks = std::vector<petsc::OwnMat>(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
    {
      ::Mat* A = _blocks[n * i + j].put();
      if (_J[i][j])
      {
        *A = dolfinx::fem::petsc::create_matrix(*_J[i][j]);
        continue;
      }
      petsc::check(
          MatCreateAIJ(
              comm(),
              static_cast<PetscInt>(Unknowns::num_owned(*functions()[i])),
              static_cast<PetscInt>(Unknowns::num_owned(*functions()[j])),
              PETSC_DETERMINE, PETSC_DETERMINE, i == j ? 1 : 0, nullptr, 0,
              nullptr, A),
          "MatCreateAIJ");
    }
}

void Bulk::fill(int i, int j)
{
  const ::Mat A = block(i, j);
  petsc::check(MatZeroEntries(A), "MatZeroEntries");
  if (const auto& J = _J[i][j])
  {
    dolfinx::fem::assemble_matrix(
        dolfinx::la::petsc::Matrix::set_block_fn(A, ADD_VALUES), *J,
        conditions());
    petsc::check(MatAssemblyBegin(A, MAT_FLUSH_ASSEMBLY), "MatAssemblyBegin");
    petsc::check(MatAssemblyEnd(A, MAT_FLUSH_ASSEMBLY), "MatAssemblyEnd");
    if (i == j)
      dolfinx::fem::set_diagonal<double>(
          dolfinx::la::petsc::Matrix::set_fn(A, INSERT_VALUES),
          *functions()[i]->function_space(), conditions());
  }
  else if (i == j)
  {
    PetscInt first = 0;
    petsc::check(MatGetOwnershipRange(A, &first, nullptr),
                 "MatGetOwnershipRange");
    // The diagonal has its place, whatever is prescribed
    for (std::size_t k = 0; k < Unknowns::num_owned(*functions()[i]); ++k)
    {
      const PetscInt row = first + static_cast<PetscInt>(k);
      petsc::check(MatSetValue(A, row, row, _markers_of[i][k], INSERT_VALUES),
                   "MatSetValue");
    }
  }
  petsc::check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  petsc::check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
  PetscReal norm = 0;
  petsc::check(MatNorm(A, NORM_FROBENIUS, &norm), "MatNorm");
  if (not std::isfinite(norm))
    throw contactx::solve::NotFinite(
        "the Jacobian is not finite: it does not exist at this displacement, "
        "or a coefficient of it is NaN or infinite. Start from another "
        "displacement, or repair the coefficient (manual: "
        "errors/jacobian-not-finite)");
}

std::vector<double> Bulk::absolute_products(std::span<const double> sizes)
{
  assemble();
  const int n = static_cast<int>(functions().size());
  std::vector<std::vector<double>> of, sums;
  for (const auto& w : functions())
    of.emplace_back(Unknowns::num_owned(*w), 0.0);
  sums = of;
  auto size = sizes.begin();
  for_each_part(
      [&](int k, const std::vector<std::int32_t>& dofs)
      {
        for (const std::int32_t dof : dofs)
          of[k][dof] = *size++;
      });
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      add_absolute(block(i, j), of[j], sums[i]);
  std::vector<double> taken;
  for_each_part(
      [&](int k, const std::vector<std::int32_t>& dofs)
      {
        for (const std::int32_t dof : dofs)
          taken.push_back(sums[k][dof]);
      });
  return taken;
}
} // namespace contactx_dolfinx
