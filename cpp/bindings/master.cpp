// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include <contactx/kernel/layout.h>
#include <pybind11/stl.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::contact;

namespace
{
/// Pairs with copies of the arrays, which say by their shapes what they are.
contactx::kernel::Pairs pairs_of(const Array<std::int32_t>& slaves,
                                 const Array<std::int32_t>& nodes,
                                 const Array<double>& data,
                                 const std::optional<Array<double>>& slip,
                                 bool is_movement)
{
  const auto check = [&slaves](const py::array& a, const char* name)
  {
    if (a.ndim() != 2 or a.shape(0) != slaves.shape(0))
      throw std::invalid_argument(std::string(name)
                                  + " must have a row for each pair");
  };
  if (slaves.ndim() != 2 or slaves.shape(1) < 1)
    throw std::invalid_argument("slaves must have a row for each pair");
  check(nodes, "nodes");
  check(data, "data");
  if (slip)
    check(*slip, "slip");
  if (nodes.shape(1) < slaves.shape(1))
    throw std::invalid_argument("nodes must begin with the slave nodes");
  contactx::kernel::Pairs p;
  p.num_slaves = static_cast<int>(slaves.shape(1));
  p.num_nodes = static_cast<int>(nodes.shape(1) - slaves.shape(1));
  p.data_size = static_cast<int>(data.shape(1));
  p.is_movement = is_movement;
  p.slaves = copy(slaves);
  p.nodes = copy(nodes);
  p.data = copy(data);
  if (slip)
  {
    p.slip_size = static_cast<int>(slip->shape(1));
    p.slip = copy(*slip);
  }
  return p;
}

py::array_t<double> rows(const std::vector<double>& values, py::ssize_t width)
{
  return array(values,
               {static_cast<py::ssize_t>(values.size()) / width, width});
}
} // namespace

py::dict contactx_bindings::to_dict(const std::vector<Saved>& saved)
{
  py::dict result;
  for (const Saved& s : saved)
    result[py::str(s.name)] = std::visit(
        [&s](const auto& values) -> py::object
        {
          if (s.width == 0)
            return array(values);
          return array(
              values,
              {static_cast<py::ssize_t>(values.size()) / s.width, s.width});
        },
        s.values);
  return result;
}

py::list contactx_bindings::to_list(std::vector<contactx::kernel::Pairs> pairs)
{
  py::list result;
  for (contactx::kernel::Pairs& p : pairs)
    result.append(std::make_shared<contactx::kernel::Pairs>(std::move(p)));
  return result;
}

py::tuple
contactx_bindings::to_tuple(const contactx::geometry::FacetList& facets)
{
  const auto copied = [](std::span<const std::int32_t> values)
  { return array(std::vector<std::int32_t>(values.begin(), values.end())); };
  return py::make_tuple(copied(facets.offsets), copied(facets.nodes));
}

std::vector<std::int8_t> contactx_bindings::truths(const Array<bool>& values)
{
  return {values.data(), values.data() + values.size()};
}

py::array_t<bool>
contactx_bindings::to_bool(const std::vector<std::int8_t>& values)
{
  py::array_t<bool> result(static_cast<py::ssize_t>(values.size()));
  std::ranges::copy(values, result.mutable_data());
  return result;
}

void contactx_bindings::master(py::module_& m)
{
  py::class_<contactx::kernel::Pairs, std::shared_ptr<contactx::kernel::Pairs>>(
      m, "Pairs", "Pairs with master facets of one kind")
      .def(py::init(&pairs_of), py::arg("slaves"), py::arg("nodes"),
           py::arg("data"), py::arg("slip") = py::none(), py::kw_only(),
           py::arg("is_movement") = false)
      .def_property_readonly(
          "slaves",
          [](py::object self)
          {
            const auto& p = self.cast<const contactx::kernel::Pairs&>();
            return looking(p.slaves,
                           {static_cast<py::ssize_t>(p.size()), p.num_slaves},
                           self);
          })
      .def_property_readonly(
          "nodes",
          [](py::object self)
          {
            const auto& p = self.cast<const contactx::kernel::Pairs&>();
            return looking(p.nodes,
                           {static_cast<py::ssize_t>(p.size()),
                            p.num_slaves + p.num_nodes},
                           self);
          })
      .def_property_readonly(
          "data",
          [](py::object self)
          {
            const auto& p = self.cast<const contactx::kernel::Pairs&>();
            return looking(p.data,
                           {static_cast<py::ssize_t>(p.size()), p.data_size},
                           self);
          })
      .def_property_readonly(
          "slip",
          [](py::object self) -> py::object
          {
            const auto& p = self.cast<const contactx::kernel::Pairs&>();
            if (p.slip_size == 0)
              return py::none();
            return looking(p.slip,
                           {static_cast<py::ssize_t>(p.size()), p.slip_size},
                           self);
          })
      .def_property_readonly(
          "normal",
          [](py::object self) -> py::object
          {
            using namespace contactx::kernel;
            const std::size_t at
                = (self.cast<const contactx::kernel::Pairs&>().num_nodes == 0
                       ? offsetof(ObstaclePair, normal)
                       : offsetof(FacetPair, normal))
                  / sizeof(double);
            const py::object data = self.attr("data");
            return data[py::make_tuple(py::ellipsis(),
                                       py::slice(at, at + 3, 1))];
          })
      .def_readonly("num_nodes", &contactx::kernel::Pairs::num_nodes)
      .def_readonly("is_movement", &contactx::kernel::Pairs::is_movement)
      .def("same", &contactx::kernel::Pairs::same, py::arg("other"));
  py::class_<contactx::kernel::Weights>(m, "Weights",
                                        "Relative movement of slave nodes")
      .def_property_readonly("slaves", [](const contactx::kernel::Weights& w)
                             { return array(w.slaves); })
      .def_property_readonly("nodes", [](const contactx::kernel::Weights& w)
                             { return array(w.nodes); })
      .def_property_readonly("values", [](const contactx::kernel::Weights& w)
                             { return array(w.values); });
  py::class_<Master, std::shared_ptr<Master>>(
      m, "Master", "Pairs of the slave nodes of a contact with its master")
      .def_property_readonly("reach", &Master::reach)
      .def_property_readonly("is_rigid", &Master::is_rigid)
      .def("turn",
           [](const Master& self, const Array<double>& x) -> py::object
           {
             const auto turn = self.turn(view(x));
             if (not turn)
               return py::none();
             const py::ssize_t g = self.gdim();
             return array(
                 *turn,
                 {static_cast<py::ssize_t>(turn->size()) / (g * g), g, g});
           })
      .def("search", [](Master& self, const Array<double>& x,
                        const Array<std::int8_t>& closed)
           { return self.search(view(x), view(closed)); })
      .def_property_readonly("paired", [](const Master& self)
                             { return to_bool(self.paired()); })
      .def("pairs", [](const Master& self) { return to_list(self.pairs()); })
      .def("update",
           [](Master& self, const Array<double>& x, bool frozen,
              const Array<double>& offset) -> py::object
           {
             auto fresh = self.update(view(x), frozen, view(offset));
             if (not fresh)
               return py::none();
             return to_list(std::move(*fresh));
           })
      .def("normals",
           [](const Master& self) { return rows(self.normals(), 3); })
      .def("weights", &Master::weights)
      .def("area", [](const Master& self, const Array<double>& whole)
           { return array(self.area(view(whole))); })
      .def("distance", [](const Master& self, const Array<double>& x)
           { return self.distance(view(x)); })
      .def_property_readonly("frozen_pairs", [](const Master& self)
                             { return array(self.frozen_pairs()); });
}
