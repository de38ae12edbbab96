// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "parallel.h"
#include "bindings.h"
#include "check.h"
#include <algorithm>
#include <contactx/mesh/partition.h>
#include <pybind11/functional.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::mesh;

namespace
{
class PythonRanks final : public Ranks
{
public:
  explicit PythonRanks(py::object adapter)
      : _adapter(std::move(adapter)), _rank(_adapter.attr("rank").cast<int>()),
        _size(_adapter.attr("size").cast<int>())
  {
  }

  int rank() const override { return _rank; }
  int size() const override { return _size; }

  void reduce(std::span<double> values, Reduction how) override
  {
    if (_size > 1)
      _adapter.attr("reduce")(lend(values), name_of(how));
  }

  void reduce(std::span<std::int64_t> values, Reduction how) override
  {
    if (_size > 1)
      _adapter.attr("reduce")(lend(values), name_of(how));
  }

  std::vector<std::byte> gather(std::span<const std::byte> mine) override
  {
    return received(_adapter.attr("gather")(sent(mine)));
  }

  Messages exchange(const Messages& outgoing) override
  {
    py::dict out;
    for (const auto& [rank, bytes] : outgoing)
      out[py::int_(rank)] = sent(bytes);
    const py::dict in = _adapter.attr("exchange")(out);
    Messages incoming;
    for (const auto& [rank, bytes] : in)
      incoming[rank.cast<int>()] = received(bytes);
    return incoming;
  }

  void agree(const std::function<void()>& work) override
  {
    if (_size == 1)
      work();
    else
      _adapter.attr("agree")(py::cpp_function(work));
  }

private:
  static py::bytes sent(std::span<const std::byte> bytes)
  {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  static std::vector<std::byte> received(const py::handle& bytes)
  {
    const auto data = std::as_bytes(std::span(bytes.cast<std::string_view>()));
    return {data.begin(), data.end()};
  }

  static const char* name_of(Reduction how)
  {
    return how == Reduction::sum     ? "sum"
           : how == Reduction::least ? "least"
                                     : "largest";
  }

  py::object _adapter;
  int _rank, _size;
};
class PythonAdapter final : public HaloAdapter
{
public:
  explicit PythonAdapter(const py::object& adapter)
      : _adapter(adapter), _ranks(adapter)
  {
  }

  Ranks& ranks() override { return _ranks; }

  void set_ghosts(std::span<const std::int64_t> numbers,
                  std::span<const std::int32_t> owners) override
  {
    _adapter.attr("set_ghosts")(
        array(std::vector<std::int64_t>(numbers.begin(), numbers.end())),
        array(std::vector<std::int32_t>(owners.begin(), owners.end())));
    _displacement.reset();
  }

  void forward(std::span<double> values, int width) override
  {
    _adapter.attr("forward")(lend(values), width);
  }

  void forward(std::span<std::int64_t> values, int width) override
  {
    _adapter.attr("forward")(lend(values), width);
  }

  void reverse(std::span<double> values, int width) override
  {
    _adapter.attr("reverse")(lend(values), width);
  }

  void displacement(std::span<double> values) const override
  {
    // The array of a vector that has other values later
    if (not _displacement)
      _displacement
          = _adapter.attr("current_displacement")().cast<Array<double>>();
    check::rows(_displacement->size(), std::ssize(values), 1, "displacement",
                "value");
    std::ranges::copy(view(*_displacement), values.begin());
  }

  void changed() override { _adapter.attr("changed")(); }

private:
  py::object _adapter;
  PythonRanks _ranks;
  mutable std::optional<Array<double>> _displacement;
};

/// The bulk's nodes as the adapter has them.
BulkNodes bulk_of(const py::object& adapter)
{
  const py::dict bulk = adapter.attr("bulk")();
  return {bulk["gdim"].cast<int>(),
          bulk["num_owned"].cast<std::int32_t>(),
          copy(bulk["numbers"].cast<Array<std::int64_t>>()),
          copy(bulk["owners"].cast<Array<std::int32_t>>()),
          copy(bulk["original"].cast<Array<std::int64_t>>()),
          copy(bulk["reference"].cast<Array<double>>())};
}
} // namespace

PythonNodes::PythonNodes(const py::object& adapter)
    : Halo(bulk_of(adapter), std::make_unique<PythonAdapter>(adapter))
{
}

std::unique_ptr<Ranks> contactx_bindings::make_ranks(py::object adapter)
{
  return std::make_unique<PythonRanks>(std::move(adapter));
}

void contactx_bindings::parallel(py::module_& m)
{
  py::class_<NodeMap, std::shared_ptr<NodeMap>>(
      m, "NodeMap", "Nodes of this rank, for the core");
  py::class_<Halo, NodeMap, std::shared_ptr<Halo>>(
      m, "Halo", "The bulk's nodes and those of other ranks that contact needs")
      .def_property_readonly("num_owned", &Halo::num_owned)
      .def_property_readonly("num_bulk", &Halo::num_bulk)
      .def_property_readonly("num_nodes", &Halo::num_nodes)
      .def_property_readonly("gdim", &Halo::gdim)
      .def_property_readonly("version", &Halo::version)
      .def_property_readonly(
          "original",
          [](const Halo& self)
          {
            const auto found = self.original();
            return array(std::vector<std::int64_t>(found.begin(), found.end()));
          })
      .def_property_readonly(
          "reference",
          [](const Halo& self)
          {
            const auto found = self.reference();
            return array(std::vector<double>(found.begin(), found.end()),
                         {self.num_nodes(), self.gdim()});
          })
      .def("positions", [](const Halo& self)
           { return array(self.now()->x, {self.num_nodes(), self.gdim()}); })
      .def(
          "numbers", [](const Halo& self, const Array<std::int32_t>& nodes)
          { return array(self.numbers(view(nodes))); }, py::arg("nodes"))
      .def(
          "owners", [](const Halo& self, const Array<std::int32_t>& nodes)
          { return array(self.owners(view(nodes))); }, py::arg("nodes"))
      .def(
          "find", [](const Halo& self, const Array<std::int64_t>& numbers)
          { return array(self.find(view(numbers))); }, py::arg("numbers"))
      .def(
          "grow",
          [](Halo& self, const Array<std::int64_t>& numbers,
             const Array<std::int32_t>& owners, bool for_good)
          { self.grow(view(numbers), view(owners), for_good); },
          py::arg("numbers"), py::arg("owners"), py::kw_only(),
          py::arg("for_good") = false)
      .def("shrink", &Halo::shrink);
  py::class_<PythonNodes, Halo, std::shared_ptr<PythonNodes>>(
      m, "PythonNodes", "A halo whose adapter is an object of Python")
      .def(py::init<const py::object&>(), py::arg("adapter"));
  m.def(
      "parts_with_contact",
      [](py::object adapter, const Array<std::int64_t>& cells,
         const Array<double>& x, const Array<std::int8_t>& at_contact,
         int parts)
      {
        const std::unique_ptr<Ranks> ranks = make_ranks(std::move(adapter));
        return array(parts_with_contact(
            *ranks, view(cells), static_cast<int>(cells.shape(1)),
            {view(x), static_cast<int>(x.shape(1)), view(at_contact)}, parts));
      },
      py::arg("ranks"), py::arg("cells"), py::arg("x"), py::arg("at_contact"),
      py::arg("parts"));
}
