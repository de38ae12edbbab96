// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "functions.h"
#include <algorithm>
#include <contactx/results/results.h>
#include <dolfinx/fem/utils.h>
#include <limits>

namespace contactx_dolfinx
{
namespace
{
std::shared_ptr<Function>
create(const std::shared_ptr<const FunctionSpace>& space, std::string name,
       double value = 0)
{
  auto f = std::make_shared<Function>(space);
  f->name = std::move(name);
  std::ranges::fill(f->x()->array(), value);
  return f;
}
} // namespace

Functions::Functions(std::shared_ptr<const FunctionSpace> V,
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

void Functions::take(const contactx::results::Results& results)
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

std::vector<std::reference_wrapper<const Function>> Functions::all() const
{
  std::vector<std::reference_wrapper<const Function>> functions;
  for (const auto& f : list())
    functions.emplace_back(*f);
  return functions;
}

std::shared_ptr<const FunctionSpace> Functions::scalars(const FunctionSpace& V)
{
  const auto element = V.element()->extract_sub_element({0});
  const dolfinx::fem::DofMap& nodes = *V.dofmap();
  const auto cells = nodes.map();
  std::vector<std::int32_t> list(cells.data_handle(),
                                 cells.data_handle() + cells.size());
  return std::make_shared<const FunctionSpace>(
      V.mesh(), element,
      std::make_shared<const dolfinx::fem::DofMap>(
          dolfinx::fem::create_element_dof_layout(*element), nodes.index_map, 1,
          std::move(list), 1));
}

std::vector<std::shared_ptr<Function>> Functions::list() const
{
  std::vector list{pressure, master_pressure, traction, gap, status};
  if (slip)
    list.insert(list.end(), {slip, slip_total});
  return list;
}

template <class T>
void Functions::set(Function& f, const std::vector<T>& values) const
{
  const std::size_t bs = f.function_space()->dofmap()->bs();
  auto& array = f.x()->array();
  for (std::size_t i = 0; i < _slaves.size(); ++i)
    std::copy_n(values.begin() + bs * i, bs, array.begin() + bs * _slaves[i]);
}
} // namespace contactx_dolfinx
