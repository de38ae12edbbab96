// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>

/// @brief Checks of arguments: sizes and numbers. Each throws
/// std::invalid_argument, which names the argument.
namespace contactx::check
{
/// @brief A function of the user's has no value where the bodies are. An
/// iterate may have gone where no solution is: a shorter step stays nearer.
class Undefined : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

/// @brief Require a condition.
/// @param[in] fits Whether it does.
/// @param[in] message Message of the error if not.
void require(bool fits, const char* message);

/// @brief The geometric dimension, 2 or 3.
void dimension(int gdim);

/// @brief Facets as offsets and nodes.
/// @param[in] offsets First node of each facet, and the end.
/// @param[in] nodes Nodes, facet after facet.
/// @param[in] gdim Geometric dimension.
/// @param[in] of Which facets: comes before "offsets" and "nodes".
void facets(std::span<const std::int32_t> offsets,
            std::span<const std::int32_t> nodes, int gdim,
            std::string_view of = "");

/// @brief One more than the largest node; zero without nodes.
std::int32_t num_nodes(std::span<const std::int32_t> nodes);

/// @brief Positions of nodes.
/// @param[in] size Number of values.
/// @param[in] num_nodes Number of nodes that must be there.
/// @param[in] gdim Geometric dimension.
/// @param[in] name Name of the argument.
void positions(std::ptrdiff_t size, std::int32_t num_nodes, int gdim,
               std::string_view name = "x");

/// @brief Facets as offsets and nodes, and the positions `x` of their nodes.
/// @param[in] offsets First node of each facet, and the end.
/// @param[in] nodes Nodes, facet after facet.
/// @param[in] size Number of values of the positions.
/// @param[in] gdim Geometric dimension.
void surface(std::span<const std::int32_t> offsets,
             std::span<const std::int32_t> nodes, std::ptrdiff_t size,
             int gdim);

/// @brief Number of values of an array.
/// @param[in] size Number of values.
/// @param[in] rows Number of rows that it must have.
/// @param[in] width Values a row.
/// @param[in] name Name of the argument.
/// @param[in] of Entity that a row belongs to.
void rows(std::ptrdiff_t size, std::ptrdiff_t rows, int width,
          std::string_view name, std::string_view of = "row");

/// @brief Numbers of things, from 0 or a lower start.
/// @param[in] values Numbers.
/// @param[in] count Number of things.
/// @param[in] name Name of the argument.
/// @param[in] of Entities that are numbered.
/// @param[in] first Lowest number: -1 where that is none of the things.
void numbers(std::span<const std::int32_t> values, std::ptrdiff_t count,
             std::string_view name, std::string_view of, int first = 0);

/// @brief An integer between two others.
void between(int value, int low, int high, std::string_view name);
} // namespace contactx::check
