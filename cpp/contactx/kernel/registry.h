// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "layout.h"
#include <span>
#include <vector>

namespace contactx::kernel
{
/// @brief A kernel and what its form needs to know.
struct Entry
{
  Law law;
  std::string_view sliding; ///< "finite" or "small"
  std::string_view term;    ///< term that is assembled
  int num_nodes;            ///< nodes of the facet, 0 for a rigid obstacle
  int gdim;                 ///< geometric dimension
  Kernel* function;
  std::vector<Coefficient> active; ///< coefficients that the kernel reads
  int num_slaves = 1; ///< slave nodes: one, or those of a slave facet
};

/// @brief Numbers of rows and columns of the array that a kernel adds to,
/// row-major.
struct Shape
{
  int rows, columns;
};

/// @brief Shape of a kernel's tensor: slave nodes, multipliers or the
/// displacements of the pair's nodes, and one column where it is a vector.
Shape shape(const Entry& entry);

/// @brief All kernels.
std::span<const Entry> registry();

/// @brief Kernel that adds its one coefficient: the part of a slave node alone,
/// whose complementarity and derivative by the multiplier the law gives.
/// @param[in] num_values Values of the coefficient: 1, 2, 3, 4 or 9.
/// @throws std::invalid_argument for another number.
Kernel* nodal(int num_values);

/// @brief Find a kernel, or nothing where there is none; see find().
const Entry* find_if_any(Law law, std::string_view sliding,
                         std::string_view term, int num_nodes, int gdim,
                         int num_slaves = 1);

/// @brief Find a kernel.
/// @param[in] law Contact law.
/// @param[in] sliding "finite" or "small".
/// @param[in] term "gap", "residual", "stiffness" (derivative of the residual
/// with respect to the displacement), "traction" (with respect to the
/// multiplier) or "constraint" (derivative of the complementarity with
/// respect to the displacement); with vector multipliers "normal" and "slip",
/// too.
/// @param[in] num_nodes Number of nodes of the facet, 0 for a rigid obstacle.
/// @param[in] gdim Geometric dimension.
/// @param[in] num_slaves Number of slave nodes: 1, or those of a slave facet.
/// @throws std::invalid_argument where there is no such kernel.
const Entry& find(Law law, std::string_view sliding, std::string_view term,
                  int num_nodes, int gdim, int num_slaves = 1);
} // namespace contactx::kernel
