// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace contactx
{
/// @brief Check the number of values of an array.
/// @param[in] size Number of values.
/// @param[in] rows Number of rows that it must have.
/// @param[in] width Values a row.
/// @param[in] name Name of the argument.
/// @throws std::invalid_argument if they do not fit.
inline void check_size(std::size_t size, std::size_t rows, int width,
                       const char* name)
{
  if (width < 1 or size != rows * width)
    throw std::invalid_argument(
        std::string(name) + " must have " + std::to_string(rows) + " times "
        + std::to_string(width) + " values, not " + std::to_string(size));
}
} // namespace contactx
