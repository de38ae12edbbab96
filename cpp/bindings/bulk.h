// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "bindings.h"
#include <contactx/solve/bulk.h>
#include <contactx/solve/not_finite.h>
#include <optional>
#include <pybind11/stl.h>

namespace contactx_bindings
{
/// An array of Python's that is looked at for as long as it is kept.
template <class T>
std::span<const T> keep(Array<T>& kept, const py::object& values)
{
  kept = values.cast<Array<T>>();
  return view(kept);
}

/// What a bulk of Python has for unknowns beside displacements: see
/// python/contactx/_host/bulk_host.py.
class PythonFields final : public contactx::solve::Fields
{
public:
  explicit PythonFields(py::object adapter) : _adapter(std::move(adapter)) {}

  std::vector<std::size_t> offsets() const override
  {
    return _adapter.attr("offsets").cast<std::vector<std::size_t>>();
  }
  std::span<const double> values() override
  {
    return keep(_values, _adapter.attr("values")());
  }
  void set(std::span<const double> values) override
  {
    _adapter.attr("set")(py::array_t<double>(
        static_cast<py::ssize_t>(values.size()), values.data()));
  }
  std::span<const double> residual() override
  {
    return keep(_residual, _adapter.attr("residual")());
  }
  bool follow_contacts() const override
  {
    return _adapter.attr("follow_contacts").cast<bool>();
  }
  std::span<const double> defect() override
  {
    return keep(_defect, _adapter.attr("defect")());
  }
  std::span<const double> lifted() override
  {
    return keep(_lifted, _adapter.attr("lifted")());
  }
  std::span<const std::int8_t> markers() override
  {
    return keep(_markers, _adapter.attr("markers")());
  }
  std::span<const double>
  absolute_products(std::span<const double> sizes) override
  {
    return keep(_products,
                _adapter.attr("absolute_products")(py::array_t<double>(
                    static_cast<py::ssize_t>(sizes.size()), sizes.data())));
  }

private:
  py::object _adapter;
  Array<double> _values, _residual, _defect, _lifted, _products;
  Array<std::int8_t> _markers;
};

/// Bulk that an object of Python looks after: see
/// python/contactx/_host/bulk_host.py. The object is kept alive.
class PythonBulk final : public contactx::solve::Bulk
{
public:
  explicit PythonBulk(py::object adapter) : _adapter(std::move(adapter))
  {
    if (const py::object fields = py::getattr(_adapter, "fields", py::none());
        not fields.is_none())
      _fields.emplace(fields);
  }

  void read() override { _adapter.attr("read")(); }
  bool has_own_jacobian() const override
  {
    return _adapter.attr("has_own_jacobian").cast<bool>();
  }
  int gdim() const override { return _adapter.attr("gdim").cast<int>(); }
  bool is_linear() const override
  {
    return _adapter.attr("is_linear").cast<bool>();
  }
  std::span<const double> reference() override
  {
    return keep(_reference, _adapter.attr("reference"));
  }
  std::span<const double> positions() override
  {
    return keep(_positions, _adapter.attr("positions")());
  }
  std::span<const double> displacements() override
  {
    // The array of a function that has other values later
    if (not _displacements)
      _displacements = _adapter.attr("displacements").cast<Array<double>>();
    return view(*_displacements);
  }
  std::span<const std::int8_t> markers() override
  {
    return keep(_markers, _adapter.attr("markers"));
  }
  std::span<const double> diagonal() override
  {
    return keep(_diagonal, finite("diagonal"));
  }
  std::span<const double> products(std::span<const double> fields,
                                   int count) override
  {
    const py::ssize_t size
        = count == 0 ? 0 : static_cast<py::ssize_t>(fields.size()) / count;
    // With a base nothing is copied
    py::array_t<double> given({static_cast<py::ssize_t>(count), size},
                              fields.data(), py::none());
    given.attr("flags").attr("writeable") = false;
    return keep(_products, finite("products", given));
  }
  std::span<const double> residual() override
  {
    return keep(_residual, _adapter.attr("residual")());
  }
  std::span<const double> defect() override
  {
    return keep(_defect, _adapter.attr("defect")());
  }
  std::span<const double> lifted() override
  {
    return keep(_lifted, _adapter.attr("lifted")());
  }
  void set_displacements(std::span<const double> u) override
  {
    _adapter.attr("set_displacements")(
        py::array_t<double>(static_cast<py::ssize_t>(u.size()), u.data()));
  }
  std::span<const std::int32_t> cells() override
  {
    return keep(_cells, _adapter.attr("cells"));
  }
  int nodes_per_cell() const override
  {
    return _adapter.attr("nodes_per_cell").cast<int>();
  }
  std::span<const double> cell_sizes() override
  {
    return keep(_cell_sizes, _adapter.attr("cell_sizes")());
  }
  std::span<const double> cell_forces() override
  {
    return keep(_cell_forces, _adapter.attr("cell_forces")());
  }
  contactx::solve::Fields* fields() override
  {
    return _fields ? &*_fields : nullptr;
  }

private:
  /// Calls what asks for the Jacobian, which may not be finite.
  template <class... Given>
  py::object finite(const char* name, Given&&... given)
  {
    try
    {
      return _adapter.attr(name)(std::forward<Given>(given)...);
    }
    catch (const py::error_already_set& error)
    {
      const py::object kind
          = py::module_::import("contactx.cpp").attr("NotFiniteError");
      if (error.matches(kind))
        throw contactx::solve::NotFinite(py::str(error.value()));
      throw;
    }
  }

  py::object _adapter;
  std::optional<PythonFields> _fields;
  std::optional<Array<double>> _displacements;
  Array<double> _reference, _positions, _diagonal, _products, _residual,
      _defect, _lifted, _cell_sizes, _cell_forces;
  Array<std::int32_t> _cells;
  Array<std::int8_t> _markers;
};
} // namespace contactx_bindings
