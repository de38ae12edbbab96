// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <algorithm>
#include <basix/finite-element.h>
#include <dolfinx/fem/DirichletBC.h>
#include <dolfinx/fem/Form.h>
#include <dolfinx/fem/Function.h>
#include <dolfinx/fem/FunctionSpace.h>
#include <dolfinx/mesh/Mesh.h>
#include <dolfinx/mesh/cell_types.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

/// @brief Checks of what a program gives: DOLFINx assembles forms of wrong
/// spaces without a word, and writes beyond the arrays.
namespace contactx::dolfinx
{
/// Functions of the displacement's kind
using Function = ::dolfinx::fem::Function<double>;
/// Their spaces
using FunctionSpace = ::dolfinx::fem::FunctionSpace<double>;
/// Forms of the bulk
using Form = ::dolfinx::fem::Form<double>;
/// Dirichlet conditions
using DirichletBC = ::dolfinx::fem::DirichletBC<double>;

namespace input
{
/// @brief Check that a displacement is one that contact can act on.
/// @throws std::invalid_argument if it is null or not of a Lagrange space of
/// vectors of degree 1 or 2 on cells of the dimension of space.
inline void check_displacement(const Function* u)
{
  if (u == nullptr)
    throw std::invalid_argument("u is null: give the displacement");
  const FunctionSpace& V = *u->function_space();
  const auto& mesh = *V.mesh();
  const int gdim = mesh.geometry().dim(), tdim = mesh.topology()->dim();
  if (gdim != tdim or gdim < 2)
    throw std::invalid_argument("contact needs plane cells in the plane or "
                                "solid ones in space");
  const auto is_lagrange = [&V]
  {
    const auto& element = V.element()->basix_element();
    return element.family() == basix::element::family::P
           and not element.discontinuous()
           and (element.degree() == 1 or element.degree() == 2);
  };
  if (V.dofmap()->bs() != gdim or not is_lagrange())
    throw std::invalid_argument(
        "the displacement must be of a continuous Lagrange space of vectors: "
        "take degree 1 or 2 and as many components as the mesh has dimensions");
}

/// @brief Whether a space is that of a displacement, whole.
inline bool is_space_of(const Function& u, const FunctionSpace& V)
{
  return V.component().empty() and u.function_space()->contains(V);
}

/// @brief Check that a form has so many arguments, of the displacement's space.
/// @param[in] form The form.
/// @param[in] name What messages call it.
/// @param[in] count Number of its arguments.
/// @param[in] u Displacement.
/// @param[in] advice What to give.
/// @throws std::invalid_argument if it is null or another one.
inline void check_form(const Form* form, const std::string& name, int count,
                       const Function& u, const std::string& advice)
{
  if (form == nullptr)
    throw std::invalid_argument(name + " is null: " + advice);
  if (form->rank() != count)
    throw std::invalid_argument(name + " has " + std::to_string(form->rank())
                                + " arguments, but must have "
                                + std::to_string(count) + ": " + advice);
  for (const auto& V : form->function_spaces())
    if (not is_space_of(u, *V))
      throw std::invalid_argument(
          name
          + " has an argument that is not of the function space of u: create "
            "the form with u's own function space");
}

/// @brief Check that a residual and its Jacobian are forms of a displacement.
///
/// A residual that has no displacement may still depend on it through functions
/// of other spaces, as stresses at quadrature points that a program updates.
/// @throws std::invalid_argument if one is null, has another number of
/// arguments or arguments of another space, or F does not depend on u.
inline void check_forms(const Form* F, const Form* J, const Function& u)
{
  check_form(F, "F", 1, u, "give the residual, linear in a test function");
  check_form(J, "J", 2, u, "give the derivative of F, derivative(F, u)");
  const auto& in = F->coefficients();
  if (std::ranges::any_of(in, [&u](const auto& c) { return c.get() == &u; }))
    return;
  if (in.empty()
      or std::ranges::any_of(in, [&u](const auto& c)
                             { return is_space_of(u, *c->function_space()); }))
    throw std::invalid_argument(
        "F does not depend on u: create the form with the very Function that "
        "is passed as u");
}

/// @brief Check that Dirichlet conditions are those of a displacement.
/// @throws std::invalid_argument if one is null or of another space.
inline void
check_conditions(const std::vector<std::shared_ptr<const DirichletBC>>& bcs,
                 const Function& u)
{
  for (std::size_t k = 0; k < bcs.size(); ++k)
  {
    const std::string name = "bcs[" + std::to_string(k) + "]";
    if (bcs[k] == nullptr)
      throw std::invalid_argument(name + " is null: give a DirichletBC");
    if (not u.function_space()->contains(*bcs[k]->function_space()))
      throw std::invalid_argument(
          name
          + " is a condition on another function space than that of u: make "
            "it with u's function space, or with a sub space of it");
  }
}
} // namespace input
} // namespace contactx::dolfinx
