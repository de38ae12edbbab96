// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include "parallel.h"
#include <contactx/contact/contact_state.h>
#include <contactx/problem/make_contact.h>
#include <contactx/results/transfer.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::contact;
using contactx::geometry::Obstacle;
using contactx::law::Law;
using contactx::mesh::Halo;
using contactx::mesh::Mesh;
using contactx::problem::ContactOptions;
using contactx::problem::make_contact;
using contactx::problem::Sides;

namespace
{
/// Name, offsets and nodes of facets.
using Surface
    = std::tuple<std::string, Array<std::int32_t>, Array<std::int32_t>>;

/// The surface as the core has it, which looks at the arrays.
contactx::mesh::NamedSurface named(const Surface& surface)
{
  const auto& [name, offsets, nodes] = surface;
  return {name, {view(offsets), view(nodes)}};
}
} // namespace

void contactx_bindings::contact(py::module_& m)
{
  py::class_<ContactOptions>(m, "ContactOptions", "Options of a contact")
      .def(py::init(
               [](bool is_mortar, bool is_small, bool tied, bool has_friction,
                  const std::optional<py::function>& bound,
                  std::optional<double> search_distance,
                  std::optional<double> excluded_distance,
                  std::optional<double> adjust, bool smooth,
                  double tangential_factor)
               {
                 return ContactOptions{
                     .method = is_mortar ? Method::surface_to_surface
                                         : Method::node_to_surface,
                     .sliding = is_small ? Sliding::small : Sliding::finite,
                     .tied = tied,
                     .has_friction = has_friction,
                     .bound = bound ? bound_of(*bound)
                                    : contactx::law::BoundFunction(),
                     .search_distance = search_distance,
                     .excluded_distance = excluded_distance,
                     .adjust = adjust,
                     .smooth = smooth,
                     .tangential_factor = tangential_factor};
               }),
           py::kw_only(), py::arg("is_mortar"), py::arg("is_small"),
           py::arg("tied"), py::arg("has_friction"), py::arg("bound"),
           py::arg("search_distance"), py::arg("excluded_distance"),
           py::arg("adjust"), py::arg("smooth"), py::arg("tangential_factor"))
      .def(
          "check", [](const ContactOptions& self, bool is_self)
          { contactx::problem::check(self, is_self); }, py::arg("is_self"));

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
      .def(py::init(
               [](const Mesh& mesh, const Surface& slave,
                  const py::object& master, const ContactOptions& options,
                  bool is_self, const Array<std::int8_t>& level,
                  const std::optional<py::function>& weight,
                  const Array<std::int8_t>& prescribed)
               {
                 Sides sides{.slave = named(slave),
                             .master = {},
                             .is_self = is_self,
                             .level = copy(level)};
                 std::optional<Surface> surface;
                 if (py::isinstance<Obstacle>(master))
                   sides.master = master.cast<std::shared_ptr<Obstacle>>();
                 else
                   sides.master
                       = named(surface.emplace(master.cast<Surface>()));
                 if (weight)
                   sides.weight = [&](std::span<const std::int32_t> nodes)
                   {
                     const py::array_t<std::int32_t> given(
                         static_cast<py::ssize_t>(nodes.size()), nodes.data());
                     return copy((*weight)(given).cast<Array<double>>());
                   };
                 return make_contact(mesh, sides, options, copy(prescribed));
               }),
           py::arg("mesh"), py::arg("slave"), py::arg("master"),
           py::arg("options"), py::kw_only(), py::arg("is_self"),
           py::arg("level"), py::arg("weight"), py::arg("prescribed"),
           // A subclass in Python must outlive who calls its methods
           py::keep_alive<1, 4>())
      .def_property_readonly(
          "slave_nodes", [](const Contact& self)
          { return std::const_pointer_cast<SlaveNodes>(self.shared_slaves()); })
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
      .def_property_readonly("pairs", &Contact::pairs)
      .def_property_readonly("version", &Contact::version)
      .def_property("active", &Contact::is_active, &Contact::set_active)
      .def_property_readonly("skipped_searches", &Contact::skipped_searches)
      .def_property_readonly("adjusted", [](const Contact& self)
                             { return array(self.adjusted()); })
      .def(
          "set_prescribed",
          [](Contact& self, const Array<std::int8_t>& prescribed)
          { self.set_prescribed(view(prescribed)); }, py::arg("prescribed"))
      .def("begin_step", &Contact::begin_step)
      .def("accept", &Contact::accept)
      .def_property_readonly("is_self", &Contact::is_self)
      .def("save", [](const Contact& self) { return to_dict(save(self)); })
      .def("rebuild", &Contact::rebuild)
      .def("search", &Contact::search)
      .def("freeze", &Contact::freeze, py::arg("is_frozen"))
      .def("update_gap", &Contact::update_gap)
      .def("update_status", &Contact::update_status,
           py::arg("is_first") = false)
      .def(
          "add_residual", [](const Contact& self, Array<double>& b)
          { self.add_residual(mutable_view(b)); }, py::arg("b").noconvert());

  py::class_<contactx::results::Transfer>(
      m, "Transfer", "Scalar fields on both sides of a contact")
      .def(py::init<const Contact&>(), py::arg("contact"),
           py::keep_alive<1, 2>())
      .def(
          "differences",
          [](const contactx::results::Transfer& self,
             const Array<double>& field)
          { return array(self.differences(view(field))); },
          py::arg("field"));
}
