// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../check.h"
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace contactx::contact
{
/// @brief Meaning of the rows of a saved array.
enum class RowKind : std::int8_t
{
  slave, ///< an owned slave node
  node,  ///< an owned node; rows of others may follow, which do not count
  global ///< nothing: the array is the same on all ranks
};

/// @brief An array of a contact's state, as it goes to a checkpoint and comes
/// back.
struct Saved
{
  using Values
      = std::variant<std::vector<double>, std::vector<std::int8_t>,
                     std::vector<std::int32_t>, std::vector<std::int64_t>>;

  std::string name;
  RowKind rows;
  int width; ///< values a row, 0 for one value a row (shape=(n))
  Values values;
};

/// @brief Values of a saved array.
/// @param[in] saved The arrays.
/// @param[in] name Name of the one.
/// @throws std::invalid_argument if it is not there, or of another type.
template <class T>
const std::vector<T>& values_of(const std::vector<Saved>& saved,
                                const std::string& name)
{
  for (const Saved& s : saved)
    if (s.name == name)
    {
      if (const auto* values = std::get_if<std::vector<T>>(&s.values))
        return *values;
      throw std::invalid_argument("the array " + name + " is of another type");
    }
  throw std::invalid_argument("there is no array " + name);
}

/// @brief Values of a saved array of a known size.
/// @param[in] saved The arrays.
/// @param[in] name Name of the one.
/// @param[in] rows Number of its rows.
/// @param[in] width Values a row.
/// @throws std::invalid_argument if it is not there, or of another size.
inline std::vector<double> values_of_size(const std::vector<Saved>& saved,
                                          const char* name, std::size_t rows,
                                          int width)
{
  std::vector<double> values = values_of<double>(saved, name);
  check::rows(values.size(), rows, width, name);
  return values;
}

/// @brief True if an array was saved.
inline bool has(const std::vector<Saved>& saved, const char* name)
{
  return std::ranges::any_of(saved,
                             [=](const Saved& s) { return s.name == name; });
}
} // namespace contactx::contact
