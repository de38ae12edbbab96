// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../input.h"
#include "../require.h"
#include <contactx/kernel/registry.h>

namespace contactx::fuzz
{
/// @brief A kernel's coefficients, of exactly their size so that what lies
/// beyond is found out.
class Coefficients
{
public:
  explicit Coefficients(const kernel::Entry& e) : _entry(e)
  {
    _values.resize(
        kernel::coefficient_values(e.law, e.num_nodes, e.gdim, e.num_slaves));
  }

  /// @brief Place of a coefficient's values.
  double* at(kernel::Coefficient c) { return _values.data() + offset(c); }

  /// @brief All values.
  std::vector<double>& values() { return _values; }

  /// @brief Call the kernel.
  std::vector<double> tabulate() const
  {
    const kernel::Shape s = kernel::shape(_entry);
    std::vector<double> tensor(s.rows * s.columns, 0);
    _entry.function(tensor.data(), _values.data(), nullptr, nullptr, nullptr,
                    nullptr, nullptr);
    return tensor;
  }

private:
  int offset(kernel::Coefficient c) const
  {
    return kernel::offset(_entry.law, c, _entry.num_nodes, _entry.gdim,
                          _entry.num_slaves);
  }

  const kernel::Entry& _entry;
  std::vector<double> _values;
};

/// @brief The forces on all nodes of a pair sum to zero, and so do their
/// derivatives by multipliers and displacements.
inline void require_balance(const kernel::Entry& e,
                            const std::vector<double>& tensor)
{
  if (e.num_nodes == 0
      or (e.term != "residual" and e.term != "traction"
          and e.term != "stiffness"))
    return;
  const kernel::Shape s = kernel::shape(e);
  const double rounding = 1e-9 * largest(tensor);
  for (int col = 0; col < s.columns; ++col)
    for (int k = 0; k < e.gdim; ++k)
    {
      double sum = 0;
      for (int row = k; row < s.rows; row += e.gdim)
        sum += tensor[s.columns * row + col];
      require(std::abs(sum) <= rounding, "the forces of a pair sum to zero");
    }
}
} // namespace contactx::fuzz
