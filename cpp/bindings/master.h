// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "bindings.h"
#include <contactx/contact/master.h>
#include <contactx/geometry/nodal.h>
#include <contactx/law/law.h>
#include <memory>

namespace contactx_bindings
{
/// @brief Array that looks at values which an object of Python keeps alive.
template <class T>
py::array_t<T> looking(const std::vector<T>& values,
                       std::vector<py::ssize_t> shape, py::handle owner)
{
  py::array_t<T> a(std::move(shape), values.data(), owner);
  a.attr("flags").attr("writeable") = false;
  return a;
}

/// @brief Saved arrays by their names.
py::dict to_dict(const std::vector<contactx::contact::Saved>& saved);

/// @brief Pairs as a list of Python.
py::list to_list(std::vector<contactx::kernel::Pairs> pairs);

/// @brief Facets as offsets and nodes.
py::tuple to_tuple(const contactx::geometry::FacetList& facets);

/// @brief Bound of friction that a function of Python gives: of arrays of
/// pressures and lengths of slip, three arrays.
contactx::law::BoundFunction bound_of(const py::function& bound);

/// @brief Truth values as the core has them.
std::vector<std::int8_t> truths(const Array<bool>& values);

/// @brief Truth values as NumPy has them.
py::array_t<bool> to_bool(const std::vector<std::int8_t>& values);
} // namespace contactx_bindings
