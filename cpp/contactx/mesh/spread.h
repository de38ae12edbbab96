// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "ranks.h"
#include <algorithm>

namespace contactx::mesh
{
/// @brief Values of all nodes from those of owned ones; all ranks take part.
/// @param[in] nodes Nodes of this rank.
/// @param[in] values Values, of which the rows of owned nodes count; others may
/// follow (shape=(at least num_owned, width)), row-major.
/// @param[in] width Values a node.
/// @return Values (shape=(num_nodes, width)).
/// @throws std::invalid_argument If there are fewer values.
inline std::vector<double> spread(const NodeMap& nodes,
                                  std::span<const double> values, int width)
{
  const std::size_t owned = std::size_t(nodes.num_owned()) * width;
  if (values.size() < owned)
    throw std::invalid_argument("values must have a row for each owned node");
  std::vector<double> all(std::size_t(nodes.num_nodes()) * width, 0);
  std::copy_n(values.begin(), owned, all.begin());
  nodes.forward(std::span<double>(all), width);
  return all;
}
} // namespace contactx::mesh
