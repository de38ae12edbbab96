// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

/// @brief Checks of what the core takes for granted: sizes and numbers. Each
/// throws std::invalid_argument, which names the argument.
namespace contactx_bindings::check
{
/// @brief The geometric dimension.
void dimension(int gdim);

/// @brief Facets as offsets and nodes.
/// @param[in] gdim Geometric dimension.
/// @param[in] of Which facets: comes before "offsets" and "nodes".
void facets(std::span<const std::int32_t> offsets,
            std::span<const std::int32_t> nodes, int gdim,
            const std::string& of = "");

/// @brief One more than the largest node.
std::int32_t num_nodes(std::span<const std::int32_t> nodes);

/// @brief Positions of nodes.
/// @param[in] size Number of values.
/// @param[in] num_nodes Number of nodes that must be there.
/// @param[in] name Name of the argument.
void positions(std::ptrdiff_t size, std::int32_t num_nodes, int gdim,
               const std::string& name = "x");

/// @brief Facets as offsets and nodes, and the positions `x` of their nodes.
/// @param[in] size Number of values of the positions.
void surface(std::span<const std::int32_t> offsets,
             std::span<const std::int32_t> nodes, std::ptrdiff_t size,
             int gdim);

/// @brief Number of values of an array.
/// @param[in] name Name of the argument.
/// @param[in] rows Number of rows that it must have.
/// @param[in] width Values a row.
/// @param[in] of What a row belongs to.
void rows(std::ptrdiff_t size, std::ptrdiff_t rows, int width,
          const std::string& name, const std::string& of);

/// @brief Numbers of things, from 0 or a lower start.
/// @param[in] count Number of things.
/// @param[in] name Name of the argument.
/// @param[in] of What is numbered.
/// @param[in] first Lowest number.
void numbers(std::span<const std::int32_t> values, std::ptrdiff_t count,
             const std::string& name, const std::string& of, int first = 0);

/// @brief An integer between two others.
void between(int value, int low, int high, const std::string& name);
} // namespace contactx_bindings::check
