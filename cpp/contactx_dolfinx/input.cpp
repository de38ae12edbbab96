// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "input.h"
#include <algorithm>
#include <basix/finite-element.h>
#include <dolfinx/fem/utils.h>
#include <stdexcept>

namespace contactx_dolfinx
{
std::shared_ptr<const FunctionSpace> create_space(
    const std::shared_ptr<const dolfinx::mesh::Mesh<double>>& mesh,
    const std::shared_ptr<const dolfinx::fem::FiniteElement<double>>& element)
{
  return std::make_shared<const FunctionSpace>(
      mesh, element,
      std::make_shared<const dolfinx::fem::DofMap>(dolfinx::fem::create_dofmap(
          mesh->comm(), dolfinx::fem::create_element_dof_layout(*element),
          *mesh->topology_mutable(), nullptr, nullptr)));
}

bool is_lagrange(const FunctionSpace& V)
{
  if (V.element()->is_mixed())
    return false;
  const auto& element = V.element()->basix_element();
  return element.family() == basix::element::family::P
         and not element.discontinuous()
         and (element.degree() == 1 or element.degree() == 2);
}

namespace input
{
void check_displacement(const Function* u)
{
  if (u == nullptr)
    throw std::invalid_argument("u is null: give the displacement");
  const FunctionSpace& V = *u->function_space();
  const auto& mesh = *V.mesh();
  const int gdim = mesh.geometry().dim(), tdim = mesh.topology()->dim();
  if (gdim != tdim or gdim < 2)
    throw std::invalid_argument("contact needs plane cells in the plane or "
                                "solid ones in space");
  if (V.dofmap()->bs() != gdim or not is_lagrange(V))
    throw std::invalid_argument(
        "the displacement must be of a continuous Lagrange space of vectors: "
        "take degree 1 or 2 and as many components as the mesh has dimensions");
}

bool is_space_of(const Function& u, const FunctionSpace& V)
{
  return V.component().empty() and u.function_space()->contains(V);
}

void check_form(
    const Form* form, const std::string& name,
    const std::vector<std::pair<const Function*, std::string>>& arguments,
    const std::string& advice)
{
  if (form == nullptr)
    throw std::invalid_argument(name + " is null: " + advice);
  const int count = static_cast<int>(arguments.size());
  if (form->rank() != count)
    throw std::invalid_argument(name + " has " + std::to_string(form->rank())
                                + " arguments, but must have "
                                + std::to_string(count) + ": " + advice);
  for (int k = 0; k < count; ++k)
    if (const auto& [w, its] = arguments[k];
        not is_space_of(*w, *form->function_spaces()[k]))
      throw std::invalid_argument(
          name + " has an argument that is not of the function space of " + its
          + ": create the form with " + its + "'s own function space");
}

void check_conditions(
    const std::vector<std::shared_ptr<const DirichletBC>>& bcs,
    const std::vector<std::shared_ptr<Function>>& functions)
{
  for (std::size_t k = 0; k < bcs.size(); ++k)
  {
    const std::string name = "bcs[" + std::to_string(k) + "]";
    if (bcs[k] == nullptr)
      throw std::invalid_argument(name + " is null: give a DirichletBC");
    const auto is_of = [&](const auto& w)
    { return w->function_space()->contains(*bcs[k]->function_space()); };
    if (std::ranges::none_of(functions, is_of))
      throw std::invalid_argument(
          name
          + " is a condition on another function space than that of u: make "
            "it with u's function space, or with a sub space of it");
  }
}
} // namespace input
} // namespace contactx_dolfinx
