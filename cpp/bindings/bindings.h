// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdint>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <span>
#include <vector>

namespace contactx_bindings
{
namespace py = pybind11;

/// Array that must not be converted or copied on the way in
template <class T>
using Array = py::array_t<T, py::array::c_style>;

/// View of all values of an array
template <class T>
std::span<const T> view(const Array<T>& a)
{
  return {a.data(), static_cast<std::size_t>(a.size())};
}

/// View of all values of an array that is written to
template <class T>
std::span<T> mutable_view(Array<T>& a)
{
  return {a.mutable_data(), static_cast<std::size_t>(a.size())};
}

/// Copy of all values of an array
template <class T>
std::vector<T> copy(const Array<T>& a)
{
  return {a.data(), a.data() + a.size()};
}

/// Array with a copy of the values
template <class T>
py::array_t<T> array(const std::vector<T>& v,
                     std::vector<py::ssize_t> shape = {})
{
  if (shape.empty())
    shape = {static_cast<py::ssize_t>(v.size())};
  return py::array_t<T>(shape, v.data());
}

/// Array that looks at values, which Python may not write to
template <class T>
py::array_t<T> look(std::span<const T> values)
{
  // With a base nothing is copied
  py::array_t<T> array(static_cast<py::ssize_t>(values.size()), values.data(),
                       py::none());
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// Array that looks at values, which Python writes to
template <class T>
py::array_t<T> lend(std::span<T> values)
{
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data(),
                        py::none());
}

void facet(py::module_& m);
void search(py::module_& m);
void node_state(py::module_& m);
void deformable(py::module_& m);
void law(py::module_& m);
void dynamics(py::module_& m);
void newton(py::module_& m);
void problem(py::module_& m);
void kernel(py::module_& m);
void audit(py::module_& m);
void algebra(py::module_& m);
void condense(py::module_& m);
void conductance(py::module_& m);
void slave_nodes(py::module_& m);
void contact(py::module_& m);
void results(py::module_& m);
void parallel(py::module_& m);
void checkpoint(py::module_& m);
void master(py::module_& m);
void bodies(py::module_& m);
void mesh(py::module_& m);
void obstacle(py::module_& m);
void reference(py::module_& m);
} // namespace contactx_bindings
