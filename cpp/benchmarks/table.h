// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// @brief Benchmarks of the core: tables on stdout, the same as CSV files.
namespace contactx::benchmarks
{
/// @brief Seconds that one call takes.
template <class Function>
double seconds(Function&& f)
{
  const auto begin = std::chrono::steady_clock::now();
  f();
  const std::chrono::duration<double> d
      = std::chrono::steady_clock::now() - begin;
  return d.count();
}

/// @brief Seconds that one call takes, the least of several calls: what other
/// programs take away only adds.
template <class Function>
double best_seconds(int repeats, Function&& f)
{
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i)
    best = std::min(best, seconds(f));
  return best;
}

/// @brief A number with `digits` significant digits.
inline std::string number(double value, int digits = 3)
{
  std::ostringstream s;
  s << std::setprecision(digits) << value;
  return s.str();
}

/// @brief Rows of text, printed as they come and written to a CSV file.
class Table
{
public:
  /// @brief Print the head.
  /// @param[in] path CSV file.
  /// @param[in] columns Names of the columns.
  Table(const std::string& path, const std::vector<std::string>& columns)
      : _file(path)
  {
    if (!_file)
      throw std::runtime_error("cannot write " + path);
    for (const std::string& c : columns)
      _widths.push_back(std::max<std::size_t>(c.size(), 9));
    row(columns);
  }

  /// @brief Add a row.
  void row(const std::vector<std::string>& cells)
  {
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      std::cout << std::setw(_widths[i] + 2) << cells[i];
      _file << (i > 0 ? "," : "") << cells[i];
    }
    std::cout << std::endl;
    _file << std::endl;
  }

private:
  std::ofstream _file;
  std::vector<std::size_t> _widths;
};
} // namespace contactx::benchmarks
