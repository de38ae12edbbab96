// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>
#include <string>

/// @brief Checks of what a search is asked with. Each throws
/// std::invalid_argument, which names the argument.
namespace contactx::search::check
{
/// @brief Positions of nodes.
/// @param[in] size Number of values.
/// @param[in] num_nodes Number of nodes that must be there.
/// @param[in] gdim Geometric dimension.
/// @param[in] name Name of the argument.
void positions(std::size_t size, std::int32_t num_nodes, int gdim,
               const std::string& name = "x");

/// @brief Number of values of an array.
/// @param[in] size Number of values.
/// @param[in] rows Number of rows that it must have.
/// @param[in] width Values a row.
/// @param[in] name Name of the argument.
/// @param[in] of What a row belongs to.
void rows(std::size_t size, std::size_t rows, int width,
          const std::string& name, const std::string& of);

/// @brief Facets, -1 for none.
/// @param[in] facets Facets.
/// @param[in] count Number of facets that there are.
/// @param[in] name Name of the argument.
void facets(std::span<const std::int32_t> facets, std::int32_t count,
            const std::string& name);
} // namespace contactx::search::check
