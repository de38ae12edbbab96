// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/mesh/halo.h>
#include <pybind11/pybind11.h>

namespace contactx_bindings
{
/// @brief Halo whose adapter is an object of Python, with the methods that
/// contactx/_host/parallel/mpi_host.py describes. The object is kept alive.
class PythonNodes final : public contactx::mesh::Halo
{
public:
  explicit PythonNodes(const pybind11::object& adapter);
};

/// @brief Ranks of an object of Python, with `rank`, `size` and the methods
/// that contactx/_host/parallel/mpi_host.py describes. It is kept alive.
std::unique_ptr<contactx::mesh::Ranks> make_ranks(pybind11::object adapter);
} // namespace contactx_bindings
