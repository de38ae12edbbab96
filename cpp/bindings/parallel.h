// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/parallel/ranks.h>
#include <memory>
#include <pybind11/pybind11.h>

namespace contactx_bindings
{
/// @brief Ranks and nodes that Python looks after: an object with the methods
/// that contactx/parallel/adapter.py describes.
class PythonNodes final : public contactx::parallel::NodeMap
{
public:
  /// @brief Take the object; it is kept alive.
  explicit PythonNodes(pybind11::object adapter);

  contactx::parallel::Ranks& ranks() const override { return *_ranks; }
  std::int32_t num_owned() const override;
  std::int32_t num_nodes() const override;
  void forward(std::span<double> values, int width) const override;
  void forward(std::span<std::int64_t> values, int width) const override;
  void reverse(std::span<double> values, int width) const override;

private:
  pybind11::object _adapter;
  std::unique_ptr<contactx::parallel::Ranks> _ranks;
};
} // namespace contactx_bindings
