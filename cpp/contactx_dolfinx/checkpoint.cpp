// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "checkpoint.h"
#include "cells.h"
#include "shared_file.h"
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace contactx_dolfinx
{
namespace
{
std::int32_t num_cells(const FunctionSpace& V)
{
  const auto& topology = *V.mesh()->topology();
  return topology.index_map(topology.dim())->size_local();
}

/// Nodes of each owned cell by their numbers in the mesh as it was made.
std::vector<std::int64_t> cell_nodes(const FunctionSpace& V)
{
  const auto& numbers = V.mesh()->geometry().input_global_indices();
  const auto geometry = geometry_of(*V.mesh());
  std::vector<std::int64_t> nodes;
  for (std::int32_t c = 0; c < num_cells(V); ++c)
    for (const std::int32_t point : geometry[c])
      nodes.push_back(numbers[point]);
  return nodes;
}
} // namespace

Checkpoint::Checkpoint(Assembler& assembler,
                       std::vector<std::shared_ptr<Function>> history)
    : _assembler(&assembler), _functions(std::move(history)), _core(create())
{
}

void Checkpoint::write(const std::filesystem::path& path,
                       const StepPlan* plan) const
{
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  Core::Numbers steps;
  if (plan)
    steps = {{"given", plan->given()}, {"place", plan->place()}};
  std::vector<std::vector<double>> values;
  for (std::size_t k = 0; k < _functions.size(); ++k)
  {
    // Rows of cells may have dofs of other ranks
    if (k > 0)
      _functions[k]->x()->scatter_fwd();
    for (values.emplace_back(); const std::int32_t dof : _dofs[k])
      values.back().push_back(_functions[k]->x()->array()[dof]);
  }
  try
  {
    on_first(
        [&]
        {
          // Where MPI cannot open a file it does not say why
          if (not std::ofstream(temporary))
            throw std::runtime_error(std::strerror(errno));
        });
    {
      SharedFile file(comm(), ranks(), temporary,
                      MPI_MODE_CREATE | MPI_MODE_WRONLY);
      _core.write(file, std::move(values), std::move(steps));
      file.sync();
    }
    on_first([&] { std::filesystem::rename(temporary, path); });
  }
  catch (const std::exception& error)
  {
    std::error_code ignored;
    if (ranks().rank() == 0)
      std::filesystem::remove(temporary, ignored);
    throw std::runtime_error("cannot write the checkpoint " + path.string()
                             + ": " + error.what()
                             + "; an older file of this name is as it was");
  }
}

void Checkpoint::read(const std::filesystem::path& path, StepPlan* plan)
{
  on_first(
      [&]
      {
        if (not std::filesystem::is_regular_file(path)
            or not std::ifstream(path))
          throw std::invalid_argument("there is no checkpoint " + path.string()
                                      + ". Give another file, or start anew "
                                        "(manual: errors/restart-refused)");
      });
  try
  {
    SharedFile file(comm(), ranks(), path, MPI_MODE_RDONLY);
    const auto state = _core.read(file);
    StepPlan place = plan ? *plan : StepPlan({1});
    if (plan)
    {
      if (not state.steps.contains("place"))
        throw std::invalid_argument("it has no load steps");
      place.load(state.steps.at("given"), state.steps.at("place"));
    }
    take(state);
    if (plan)
      *plan = place;
  }
  catch (const std::exception& error)
  {
    throw std::invalid_argument(
        "cannot restart from " + path.string() + ": " + error.what()
        + ". Give a checkpoint of this problem, or start anew (manual: "
          "errors/restart-refused)");
  }
}

template <class Work>
void Checkpoint::on_first(Work work) const
{
  ranks().agree(
      [&]
      {
        if (ranks().rank() == 0)
          work();
      });
}

Checkpoint::Core Checkpoint::create()
{
  const Bulk& bulk = *_assembler->bulk();
  std::vector<Core::Function> rows;
  for (std::size_t k = 0; k < _functions.size(); ++k)
    if (const std::string name = "history[" + std::to_string(k) + "]";
        _functions[k] == nullptr)
      throw std::invalid_argument(name + " is null: give a Function");
  _functions.insert(_functions.begin(), bulk.u());
  for (const auto& w : bulk.functions())
    if (w != bulk.u())
      _functions.push_back(w);
  for (std::size_t k = 0; k < _functions.size(); ++k)
    rows.push_back(
        rows_of(k == 0 ? "u" : "history[" + std::to_string(k - 1) + "]",
                *_functions[k]));
  const FunctionSpace& V = *bulk.u()->function_space();
  auto positions = reference_positions(V);
  positions.resize(rows[0].keys.size() * rows[0].width);
  const auto& system = *_assembler->system();
  return {ranks(),
          system.halo(),
          system.contacts(),
          std::move(rows),
          {std::move(positions), cell_nodes(V),
           geometry_of(*V.mesh()).points_per_cell}};
}

Checkpoint::Core::Function Checkpoint::rows_of(const std::string& name,
                                               const Function& f)
{
  const FunctionSpace& V = *f.function_space();
  const auto& map = *V.dofmap();
  const int bs = map.bs();
  std::vector<std::int32_t>& dofs = _dofs.emplace_back();
  if (is_lagrange(V))
  {
    auto keys = original_nodes(V, ranks());
    keys.resize(map.index_map->size_local());
    for (std::int32_t dof = 0; dof < bs * std::ssize(keys); ++dof)
      dofs.push_back(dof);
    return {name, std::move(keys), 1, bs};
  }
  if (ranks().size() > 1
      and (V.element()->needs_dof_permutations()
           or V.element()->needs_dof_transformations()))
    throw std::invalid_argument(
        name
        + " is of a space whose dofs change their order from rank to rank: "
          "take a Lagrange space of degree 1 or 2, a mixed one of such, a "
          "quadrature or a discontinuous space, or one rank");
  const auto cells = map.map();
  for (std::int32_t c = 0; c < num_cells(V); ++c)
    for (std::size_t i = 0; i < cells.extent(1); ++i)
      for (int k = 0; k < bs; ++k)
        dofs.push_back(bs * cells(c, i) + k);
  return {name, cell_nodes(V), geometry_of(*V.mesh()).points_per_cell,
          bs * static_cast<int>(cells.extent(1))};
}

void Checkpoint::take(const Core::State& state)
{
  const contactx::problem::Snapshot before = _assembler->problem().snapshot();
  // Of bodies without stress
  _assembler->problem().find_rigid_modes();
  std::vector<std::vector<double>> old;
  for (std::size_t k = 0; k < _functions.size(); ++k)
  {
    auto& x = *_functions[k]->x();
    old.push_back(x.array());
    for (std::size_t i = 0; i < _dofs[k].size(); ++i)
      x.array()[_dofs[k][i]] = state.functions[k][i];
    x.scatter_fwd();
  }
  try
  {
    _assembler->take(_core, state);
  }
  catch (...)
  {
    for (std::size_t k = 0; k < _functions.size(); ++k)
      _functions[k]->x()->array() = old[k];
    before.restore();
    throw;
  }
}
} // namespace contactx_dolfinx
