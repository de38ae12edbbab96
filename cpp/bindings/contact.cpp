// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include "parallel.h"
#include <contactx/contact/transfer.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::contact;
using contactx::law::Law;
using contactx::parallel::Halo;

void contactx_bindings::contact(py::module_& m)
{
  py::class_<Contact, std::shared_ptr<Contact>>(
      m, "Contact", "Slave nodes of a contact with their pairs, state and law")
      .def(
          py::init(
              [](std::shared_ptr<Halo> halo, std::shared_ptr<SlaveNodes> slaves,
                 std::shared_ptr<Master> master, std::shared_ptr<Law> law,
                 bool is_small, bool is_mortar,
                 const Array<std::int8_t>& prescribed,
                 const std::optional<Array<bool>>& shared,
                 std::optional<double> adjust)
              {
                return std::make_shared<Contact>(
                    std::move(halo), std::move(slaves), std::move(master),
                    std::move(law),
                    Contact::Options{
                        is_small ? Sliding::small : Sliding::finite,
                        is_mortar ? Method::surface_to_surface
                                  : Method::node_to_surface,
                        copy(prescribed),
                        shared ? truths(*shared) : std::vector<std::int8_t>(),
                        adjust});
              }),
          py::arg("halo"), py::arg("slaves"), py::arg("master"), py::arg("law"),
          py::kw_only(), py::arg("is_small"), py::arg("is_mortar"),
          py::arg("prescribed"), py::arg("shared") = py::none(),
          py::arg("adjust") = py::none())
      .def_property_readonly("master", &Contact::master)
      .def_property_readonly("law", &Contact::law)
      .def_property_readonly("nodes", &Contact::nodes)
      .def_property_readonly("history", &Contact::history)
      .def_property_readonly(
          "sliding", [](const Contact& self)
          { return self.sliding() == Sliding::small ? "small" : "finite"; })
      .def_property_readonly(
          "kinematics", [](const Contact& self)
          { return self.kinematics() == Sliding::small ? "small" : "finite"; })
      .def_property_readonly("updates_kinematics", &Contact::updates_kinematics)
      .def_property_readonly("pairs", &Contact::pairs)
      .def_property_readonly("version", &Contact::version)
      .def_property("active", &Contact::is_active, &Contact::set_active)
      .def_property_readonly("skipped_searches", &Contact::skipped_searches)
      .def(
          "set_offset", [](Contact& self, const Array<double>& offset)
          { self.set_offset(view(offset)); }, py::arg("offset"))
      .def_property_readonly("adjusted", [](const Contact& self)
                             { return array(self.adjusted()); })
      .def(
          "set_prescribed",
          [](Contact& self, const Array<std::int8_t>& prescribed)
          { self.set_prescribed(view(prescribed)); }, py::arg("prescribed"))
      .def("begin_step", &Contact::begin_step)
      .def("accept", &Contact::accept)
      .def("rebuild", &Contact::rebuild)
      .def(
          "set_factor", [](Contact& self, const Array<double>& compliance)
          { self.set_factor(view(compliance)); }, py::arg("compliance"))
      .def(
          "kept_inside", [](Contact& self, const Array<double>& x)
          { return array(self.kept_inside(view(x))); }, py::arg("x"))
      .def("moves_untold", &Contact::moves_untold)
      .def("search", &Contact::search)
      .def("freeze", &Contact::freeze, py::arg("is_frozen"))
      .def("update_gap", &Contact::update_gap)
      .def("update_status", &Contact::update_status,
           py::arg("is_first") = false)
      .def(
          "closing", [](Contact& self, bool is_first)
          { return to_bool(self.closing(is_first)); },
          py::arg("is_first") = false)
      .def(
          "add_residual", [](const Contact& self, Array<double>& b)
          { self.add_residual(mutable_view(b)); }, py::arg("b").noconvert());

  py::class_<Transfer>(m, "Transfer",
                       "Scalar fields on both sides of a contact")
      .def(py::init<const Contact&>(), py::arg("contact"),
           py::keep_alive<1, 2>())
      .def_property_readonly("is_paired", [](const Transfer& self)
                             { return to_bool(self.is_paired()); })
      .def_property_readonly("area", [](const Transfer& self)
                             { return array(self.area()); })
      .def(
          "differences", [](const Transfer& self, const Array<double>& field)
          { return array(self.differences(view(field))); }, py::arg("field"))
      .def(
          "add",
          [](const Transfer& self, const Array<double>& flow, Array<double> b)
          { self.add(view(flow), mutable_view(b)); }, py::arg("flow"),
          py::arg("b").noconvert())
      .def(
          "by_field", [](const Transfer& self, const Array<double>& h)
          { return self.by_field(view(h)); }, py::arg("h"))
      .def(
          "by_displacement",
          [](const Transfer& self, const Array<double>& factor)
          { return self.by_displacement(view(factor)); }, py::arg("factor"))
      .def(
          "by_slaves", [](const Transfer& self, const Array<double>& factor)
          { return self.by_slaves(view(factor)); }, py::arg("factor"))
      .def(
          "at_master", [](const Transfer& self, const Array<double>& values)
          { return array(self.at_master(view(values))); }, py::arg("values"));
}
