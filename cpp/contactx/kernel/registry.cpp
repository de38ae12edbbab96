// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "registry.h"
#include "frictional.h"
#include "frictionless.h"
#include "mortar.h"
#include "mortar_tied.h"
#include "rigid.h"
#include "rigid_mortar.h"
#include "tied.h"
#include <stdexcept>
#include <string>

using namespace contactx::kernel;

namespace
{
template <int n>
void add_coefficient(double* tensor, const double* w, const double*,
                     const double*, const int*, const std::uint8_t*, void*)
{
  for (int i = 0; i < n; ++i)
    tensor[i] += w[i];
}
} // namespace

std::span<const Entry> contactx::kernel::registry()
{
  static const std::vector<Entry> entries = []
  {
    std::vector<Entry> all;
    for (auto& part : {frictionless(), frictional(), tied(), rigid(), mortar(),
                       mortar_tied(), rigid_mortar()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return entries;
}

Shape contactx::kernel::shape(const Entry& entry)
{
  const int dofs = entry.gdim * (entry.num_slaves + entry.num_nodes);
  const int multipliers
      = entry.num_slaves * (entry.law == Law::frictionless ? 1 : entry.gdim);
  if (entry.term == "gap")
    return {entry.num_slaves, 1};
  if (entry.term == "residual")
    return {dofs, 1};
  if (entry.term == "stiffness")
    return {dofs, dofs};
  if (entry.term == "traction")
    return {dofs, multipliers};
  if (entry.term == "constraint")
    return {multipliers, dofs};
  return {multipliers, 1}; // normal and slip
}

Kernel* contactx::kernel::nodal(int num_values)
{
  switch (num_values)
  {
  case 1:
    return &add_coefficient<1>;
  case 2:
    return &add_coefficient<2>;
  case 3:
    return &add_coefficient<3>;
  case 4:
    return &add_coefficient<4>;
  case 9:
    return &add_coefficient<9>;
  default:
    throw std::invalid_argument("num_values must be 1, 2, 3, 4 or 9, not "
                                + std::to_string(num_values));
  }
}

const Entry* contactx::kernel::find_if_any(Law law, std::string_view sliding,
                                           std::string_view term, int num_nodes,
                                           int gdim, int num_slaves)
{
  for (const Entry& e : registry())
    if (e.law == law and e.sliding == sliding and e.term == term
        and e.num_nodes == num_nodes and e.gdim == gdim
        and e.num_slaves == num_slaves)
      return &e;
  return nullptr;
}

const Entry& contactx::kernel::find(Law law, std::string_view sliding,
                                    std::string_view term, int num_nodes,
                                    int gdim, int num_slaves)
{
  if (const Entry* e
      = find_if_any(law, sliding, term, num_nodes, gdim, num_slaves))
    return *e;
  throw std::invalid_argument("there is no kernel for " + std::string(sliding)
                              + " sliding, term " + std::string(term)
                              + " and facets of " + std::to_string(num_nodes)
                              + " nodes");
}
