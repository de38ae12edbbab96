// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <dolfinx/fem/DirichletBC.h>
#include <dolfinx/fem/Form.h>
#include <dolfinx/fem/Function.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// @brief Checks of what a program gives: DOLFINx assembles forms of wrong
/// spaces without a word, and writes beyond the arrays.
namespace contactx_dolfinx
{
/// Functions of the displacement's kind
using Function = dolfinx::fem::Function<double>;
/// Their spaces
using FunctionSpace = dolfinx::fem::FunctionSpace<double>;
/// Forms of the bulk
using Form = dolfinx::fem::Form<double>;
/// Dirichlet conditions
using DirichletBC = dolfinx::fem::DirichletBC<double>;

/// @brief Space of an element whose dofs need no permutation, on a mesh that
/// others have. All ranks must take part.
std::shared_ptr<const FunctionSpace> create_space(
    const std::shared_ptr<const dolfinx::mesh::Mesh<double>>& mesh,
    const std::shared_ptr<const dolfinx::fem::FiniteElement<double>>& element);

/// @brief Whether a space is a continuous Lagrange space of degree 1 or 2, of
/// numbers or of vectors: its blocks of dofs are the nodes.
bool is_lagrange(const FunctionSpace& V);

namespace input
{
/// @brief Check that a displacement is one that contact can act on.
/// @throws std::invalid_argument if it is null or not of a Lagrange space of
/// vectors of degree 1 or 2 on cells of the dimension of space.
void check_displacement(const Function* u);

/// @brief Whether a space is that of a displacement, whole.
bool is_space_of(const Function& u, const FunctionSpace& V);

/// @brief Check that a form has arguments of the spaces of some functions.
/// @param[in] form The form.
/// @param[in] name What messages call it.
/// @param[in] arguments The functions, and what messages call them.
/// @param[in] advice What to give.
/// @throws std::invalid_argument if it is null or another one.
void check_form(
    const Form* form, const std::string& name,
    const std::vector<std::pair<const Function*, std::string>>& arguments,
    const std::string& advice);

/// @brief Check that Dirichlet conditions are those of some functions.
/// @throws std::invalid_argument if one is null or of another space.
void check_conditions(
    const std::vector<std::shared_ptr<const DirichletBC>>& bcs,
    const std::vector<std::shared_ptr<Function>>& functions);
} // namespace input
} // namespace contactx_dolfinx
