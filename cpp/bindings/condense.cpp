// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include <contactx/condense/coupled_rows.h>
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
          { return array(self.multiply(view(x))); }, py::arg("x"));

  m.def(
      "coupled_rows",
      [](const Array<std::int64_t>& offsets, const Array<std::int64_t>& columns,
         const Array<double>& values, const ContactBlock& contact,
         const Array<std::int64_t>& places, std::size_t num_owned,
         std::size_t num_local)
      {
        const auto rows_of = [](const Rows& rows)
        {
          return py::make_tuple(array(rows.offsets), array(rows.columns),
                                array(rows.values));
        };
        const CoupledRows found
            = coupled(view(offsets), view(columns), view(values), contact,
                      view(places), num_owned, num_local);
        return py::make_tuple(rows_of(found.own), array(found.others),
                              rows_of(found.added));
      },
      py::arg("offsets"), py::arg("columns"), py::arg("values"),
      py::arg("contact"), py::arg("places"), py::arg("num_owned"),
      py::arg("num_local"),
      "Rows of the coupled system, and what is added to those of other ranks");
}
