// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "check.h"
#include "master.h"
#include <contactx/active_set/free_bodies.h>
#include <contactx/contact/bodies.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::active_set;
using contactx::contact::Bodies;
using contactx::parallel::NodeMap;

namespace
{
template <class T>
std::vector<T> values_of(py::handle values)
{
  // Converted where it has another type
  const auto a
      = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(
          values);
  if (not a)
    throw py::error_already_set();
  return {a.data(), a.data() + a.size()};
}

std::vector<std::int8_t> truths_of(py::handle values)
{
  return truths(values.cast<Array<bool>>());
}

/// Bulk that an object of Python looks after: see python/contactx/bodies.
class PythonBulk final : public Bulk
{
public:
  explicit PythonBulk(py::object adapter) : _adapter(std::move(adapter)) {}

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
    return keep(_displacements, _adapter.attr("displacements"));
  }
  std::span<const std::int8_t> markers() override
  {
    return keep(_markers, _adapter.attr("markers"));
  }
  std::span<const double> diagonal() override
  {
    return keep(_diagonal, _adapter.attr("diagonal")());
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
    return keep(_products, _adapter.attr("products")(given));
  }

private:
  template <class T>
  static std::span<const T> keep(Array<T>& kept, const py::object& values)
  {
    kept = values.cast<Array<T>>();
    return view(kept);
  }

  py::object _adapter;
  Array<double> _reference, _positions, _displacements, _diagonal, _products;
  Array<std::int8_t> _markers;
};

/// Contact that an object of Python looks after.
class PythonHolding final : public Holding
{
public:
  explicit PythonHolding(py::object adapter) : _adapter(std::move(adapter)) {}

  bool is_small() const override
  {
    return _adapter.attr("is_small").cast<bool>();
  }
  bool has_friction() const override
  {
    return _adapter.attr("has_friction").cast<bool>();
  }
  Pairing pairing() const override
  {
    const py::tuple p = _adapter.attr("pairing")();
    return {truths_of(p[0]),
            values_of<double>(p[1]),
            {values_of<std::int32_t>(p[2]), values_of<std::int32_t>(p[3]),
             values_of<double>(p[4])}};
  }
  std::vector<std::int8_t> status() const override
  {
    return values_of<std::int8_t>(_adapter.attr("status"));
  }
  std::vector<double> closable_gap() const override
  {
    return values_of<double>(_adapter.attr("closable_gap"));
  }
  Rubbing rubbing() override
  {
    const py::tuple p = _adapter.attr("rubbing")();
    return {values_of<double>(p[0]), values_of<double>(p[1]),
            values_of<double>(p[2]), values_of<double>(p[3]),
            values_of<double>(p[4]), truths_of(p[5])};
  }
  void close(std::span<const std::int32_t> which) override
  {
    _adapter.attr("close")(numbers(which));
  }
  void set_tractions(std::span<const std::int32_t> which,
                     std::span<const double> tractions) override
  {
    _adapter.attr("set_tractions")(
        numbers(which),
        py::array_t<double>(static_cast<py::ssize_t>(tractions.size()),
                            tractions.data()));
  }

private:
  static py::array_t<std::int32_t> numbers(std::span<const std::int32_t> which)
  {
    return py::array_t<std::int32_t>(static_cast<py::ssize_t>(which.size()),
                                     which.data());
  }

  py::object _adapter;
};

py::list matrices(const std::vector<contactx::dense::Matrix>& all)
{
  py::list result;
  for (const auto& m : all)
    result.append(array(m.values, {static_cast<py::ssize_t>(m.rows),
                                   static_cast<py::ssize_t>(m.cols)}));
  return result;
}

py::object or_none(const std::optional<std::vector<double>>& values)
{
  if (not values)
    return py::none();
  return array(*values);
}
} // namespace

void contactx_bindings::bodies(py::module_& m)
{
  py::class_<Bodies, std::shared_ptr<Bodies>>(m, "Bodies",
                                              "Connected parts of a mesh")
      .def(py::init(
               [](const Array<std::int32_t>& cells, std::int32_t num_owned,
                  const Array<std::int64_t>& original,
                  std::shared_ptr<NodeMap> nodes)
               {
                 if (cells.ndim() != 2)
                   throw std::invalid_argument(
                       "cells must have a row for each cell");
                 return std::make_shared<Bodies>(
                     view(cells), static_cast<int>(cells.shape(1)), num_owned,
                     view(original), nodes);
               }),
           py::arg("cells"), py::arg("num_owned"), py::arg("original"),
           py::arg("nodes"))
      .def("nodes_changed", &Bodies::nodes_changed)
      .def_property_readonly("names",
                             [](const Bodies& b) { return array(b.names()); })
      .def_property_readonly("of_node",
                             [](const Bodies& b) { return array(b.of_node()); })
      .def_property_readonly("number",
                             [](const Bodies& b) { return array(b.number()); })
      .def_property_readonly("of_cell",
                             [](const Bodies& b) { return array(b.of_cell()); })
      .def(
          "carrying", [](const Bodies& b, const Array<std::int32_t>& nodes)
          { return array(b.carrying(view(nodes))); }, py::arg("nodes"))
      .def(
          "nodes", [](const Bodies& b, std::int64_t body)
          { return array(b.nodes(body)); }, py::arg("body"))
      .def("count", &Bodies::count, py::arg("body"))
      .def(
          "cells", [](const Bodies& b, std::int64_t body)
          { return array(b.cells(body)); }, py::arg("body"))
      .def(
          "boxes_of",
          [](const Bodies& b, const Array<std::int64_t>& bodies,
             const Array<double>& x, int gdim)
          {
            return array(b.boxes(view(bodies), view(x), gdim),
                         {2, bodies.size(), gdim});
          },
          py::arg("bodies"), py::arg("x"), py::arg("gdim"));
  m.def(
      "rigid_modes",
      [](const Array<double>& d)
      {
        if (d.ndim() != 2)
          throw std::invalid_argument("d must have a row for each point");
        const int gdim = static_cast<int>(d.shape(1));
        check::dimension(gdim);
        py::array_t<double> modes(
            {d.shape(0), py::ssize_t(gdim), py::ssize_t(num_modes(gdim))});
        for (py::ssize_t i = 0; i < d.shape(0); ++i)
          rigid_modes(d.data(i, 0), modes.mutable_data(i, 0, 0), gdim);
        return modes;
      },
      py::arg("d"),
      "Translations, then rotations about the origin, at some points");
  py::class_<RigidModes>(m, "RigidModes", "Rigid modes of bodies")
      .def(py::init(
               [](std::shared_ptr<Bodies> bodies, py::object bulk,
                  const Array<double>& x)
               {
                 PythonBulk seen(std::move(bulk));
                 return std::make_unique<RigidModes>(std::move(bodies), seen,
                                                     view(x));
               }),
           py::arg("bodies"), py::arg("bulk"), py::arg("x"))
      .def(
          "update",
          [](RigidModes& self, py::object bulk, const Array<double>& x)
          {
            PythonBulk seen(std::move(bulk));
            self.update(seen, view(x));
          },
          py::arg("bulk"), py::arg("x"))
      .def_property_readonly("count", &RigidModes::count)
      .def_property_readonly("size", &RigidModes::size)
      .def_property_readonly("any_free", &RigidModes::any_free)
      .def_property_readonly("free", [](const RigidModes& self)
                             { return matrices(self.free()); })
      .def(
          "at",
          [](const RigidModes& self, const Array<std::int32_t>& nodes,
             const Array<double>& x)
          {
            const int gdim = self.gdim();
            const auto size = static_cast<std::int32_t>(self.body().size());
            check::numbers(view(nodes), size, "nodes", "nodes");
            check::positions(x.size(), size, gdim);
            py::array_t<double> modes({nodes.size(), py::ssize_t(gdim),
                                       py::ssize_t(self.modes_per_body())});
            for (py::ssize_t i = 0; i < nodes.size(); ++i)
              self.at(nodes.data()[i], view(x), modes.mutable_data(i, 0, 0));
            return modes;
          },
          py::arg("nodes"), py::arg("x"));
  py::class_<FreeBodies>(m, "FreeBodies",
                         "What keeps bodies without enough supports solvable")
      .def(py::init(
               [](std::shared_ptr<Bodies> bodies, py::object bulk,
                  const py::list& contacts, const Array<std::int64_t>& original)
               {
                 std::vector<std::shared_ptr<Holding>> holding;
                 for (const py::handle& contact : contacts)
                   holding.push_back(std::make_shared<PythonHolding>(
                       py::reinterpret_borrow<py::object>(contact)));
                 return std::make_unique<FreeBodies>(
                     std::move(bodies),
                     std::make_shared<PythonBulk>(std::move(bulk)),
                     std::move(holding), view(original));
               }),
           py::arg("bodies"), py::arg("bulk"), py::arg("contacts"),
           py::arg("original"))
      .def("begin_step", &FreeBodies::begin_step)
      .def("reset", &FreeBodies::reset)
      .def(
          "stabilise",
          [](FreeBodies& self, const py::function& residual,
             const py::function& of_bulk, const py::function& scale)
          {
            return self.stabilise(
                {[&residual] { return values_of<double>(residual()); },
                 [&of_bulk] { return values_of<double>(of_bulk()); },
                 [&scale] { return scale().cast<double>(); }});
          },
          py::arg("residual"), py::arg("of_bulk"), py::arg("scale"))
      .def("drift", [](FreeBodies& self) { return or_none(self.drift()); })
      .def_property_readonly("springs", [](const FreeBodies& self)
                             { return or_none(self.springs()); })
      .def_property_readonly("free_modes", &FreeBodies::free_modes)
      .def_property_readonly("closed_for_balance",
                             &FreeBodies::closed_for_balance)
      .def_property_readonly("is_unbalanced", &FreeBodies::is_unbalanced);
}
