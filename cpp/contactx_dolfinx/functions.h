// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <algorithm>
#include <array>
#include <contactx/results/results.h>
#include <dolfinx/fem/DofMap.h>
#include <dolfinx/fem/utils.h>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace contactx_dolfinx
{
/// @brief Results of a contact as functions of DOLFINx, for files and forms.
///
/// Vectors are of the displacement's space, numbers of the scalar Lagrange
/// space of its nodes, which has their numbers. Each has the name of its
/// member.
class Functions
{
public:
  /// @brief Create the functions.
  /// @param[in] V Space of the displacement.
  /// @param[in] slaves Slave nodes that this rank owns, as its blocks of dofs.
  /// @param[in] is_tied Whether the contact is a tie, which has no slip.
  Functions(std::shared_ptr<const FunctionSpace> V,
            std::span<const std::int32_t> slaves, bool is_tied)
      : _slaves(slaves.begin(), slaves.end())
  {
    const auto Q = scalars(*V);
    pressure = create(Q, "pressure");
    master_pressure = create(Q, "master_pressure");
    traction = create(V, "traction");
    gap = create(Q, "gap", std::numeric_limits<double>::quiet_NaN());
    status = create(Q, "status", -1);
    if (is_tied)
      return;
    slip = create(V, "slip");
    slip_total = create(Q, "slip_total");
  }

  /// @brief Copy results; all ranks must take part.
  void take(const contactx::results::Results& results)
  {
    set(*pressure, results.pressure());
    std::ranges::copy(results.master_pressure(),
                      master_pressure->x()->array().begin());
    set(*traction, results.traction());
    set(*gap, results.gap());
    set(*status, results.status());
    if (slip)
    {
      set(*slip, results.slip());
      set(*slip_total, results.slip_total());
    }
    for (const auto& f : list())
      f->x()->scatter_fwd();
  }

  /// @brief All of them, as io::VTKFile and others write them.
  std::vector<std::reference_wrapper<const Function>> all() const
  {
    std::vector<std::reference_wrapper<const Function>> functions;
    for (const auto& f : list())
      functions.emplace_back(*f);
    return functions;
  }

  /// @brief Space of numbers at the nodes of a space of vectors, with its
  /// dofmap.
  static std::shared_ptr<const FunctionSpace> scalars(const FunctionSpace& V)
  {
    const auto element = V.element()->extract_sub_element({0});
    const dolfinx::fem::DofMap& nodes = *V.dofmap();
    const auto cells = nodes.map();
    std::vector<std::int32_t> list(cells.data_handle(),
                                   cells.data_handle() + cells.size());
    return std::make_shared<const FunctionSpace>(
        V.mesh(), element,
        std::make_shared<const dolfinx::fem::DofMap>(
            dolfinx::fem::create_element_dof_layout(*element), nodes.index_map,
            1, std::move(list), 1));
  }

  /// Pressure, force/area, zero off the slave surface
  std::shared_ptr<Function> pressure;
  /// Its means at the nodes of the master, zero elsewhere
  std::shared_ptr<Function> master_pressure;
  /// Traction that the master exerts on the slave, force/area, zero off the
  /// slave surface
  std::shared_ptr<Function> traction;
  /// Gap, a length; NaN off the slave surface and where there is no pair
  std::shared_ptr<Function> gap;
  /// Status: -1 off the slave surface, 0 open, 1 stick or tied, 2 slip or
  /// frictionless in contact
  std::shared_ptr<Function> status;
  /// Slip increment of the last step, a length; null of a tie
  std::shared_ptr<Function> slip;
  /// Accumulated length of slip; null of a tie
  std::shared_ptr<Function> slip_total;

private:
  std::vector<std::shared_ptr<Function>> list() const
  {
    std::vector list{pressure, master_pressure, traction, gap, status};
    if (slip)
      list.insert(list.end(), {slip, slip_total});
    return list;
  }

  static std::shared_ptr<Function>
  create(const std::shared_ptr<const FunctionSpace>& space, std::string name,
         double value = 0)
  {
    auto f = std::make_shared<Function>(space);
    f->name = std::move(name);
    std::ranges::fill(f->x()->array(), value);
    return f;
  }

  /// Values of the slave nodes.
  template <class T>
  void set(Function& f, const std::vector<T>& values) const
  {
    const std::size_t bs = f.function_space()->dofmap()->bs();
    auto& array = f.x()->array();
    for (std::size_t i = 0; i < _slaves.size(); ++i)
      std::copy_n(values.begin() + bs * i, bs, array.begin() + bs * _slaves[i]);
  }

  std::vector<std::int32_t> _slaves;
};
} // namespace contactx_dolfinx
