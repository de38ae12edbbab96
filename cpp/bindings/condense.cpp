// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include <contactx/condense/contact_block.h>
#include <contactx/condense/solver/algebra.h>
#include <contactx/math/scales.h>
#include <optional>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx;
using namespace contactx_bindings;
using namespace contactx::condense;

namespace
{
template <class T>
py::array_t<T> all_of(const std::vector<T>& values, py::handle owner)
{
  return looking(values, {static_cast<py::ssize_t>(values.size())}, owner);
}

/// Adds a property: an array that looks at values of the object
template <class Class, class F>
void add_array(Class& c, const char* name, F of)
{
  c.def_property_readonly(
      name, [of](py::object self)
      { return all_of(of(self.cast<const typename Class::type&>()), self); });
}
} // namespace

void contactx_bindings::condense(py::module_& m)
{
  py::class_<Triplets> triplets(m, "Triplets", "Entries of a sparse matrix");
  add_array(triplets, "rows",
            [](const Triplets& t) -> auto& { return t.rows; });
  add_array(triplets, "columns",
            [](const Triplets& t) -> auto& { return t.columns; });
  add_array(triplets, "values",
            [](const Triplets& t) -> auto& { return t.values; });
  triplets.def("__len__", &Triplets::size);

  py::class_<ContactBlock>(m, "ContactBlock",
                           "Contacts' part of a Jacobian on one rank")
      .def(py::init(
               [](const ContactBlock::Contacts& contacts,
                  const std::optional<Array<std::int8_t>>& prescribed,
                  bool keeps_zeros)
               {
                 return ContactBlock(contacts,
                                     prescribed
                                         ? view(*prescribed)
                                         : std::span<const std::int8_t>(),
                                     keeps_zeros);
               }),
           py::arg("contacts"), py::arg("prescribed") = py::none(),
           py::kw_only(), py::arg("keeps_zeros") = false)
      .def(
          "multiply", [](const ContactBlock& self, const Array<double>& x)
          { return array(self.multiply(view(x))); }, py::arg("x"))
      .def(
          "entries",
          [](const ContactBlock& self, const Array<std::int64_t>& places)
          {
            const Entries found = self.entries(view(places));
            return py::make_tuple(array(found.rows), array(found.columns),
                                  array(found.values));
          },
          py::arg("places"));

  m.attr("gmres_restart") = gmres_restart;
  m.attr("round_off") = contactx::math::round_off;
}
