// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "parallel.h"
#include "bindings.h"
#include <pybind11/functional.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::parallel;

namespace
{
/// Array that looks at the values, which Python may write to.
template <class T>
py::array_t<T> shared(std::span<T> values)
{
  // With a base nothing is copied
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data(),
                        py::none());
}

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
    _adapter.attr("reduce")(shared(values), name_of(how));
  }

  void reduce(std::span<std::int64_t> values, Reduction how) override
  {
    _adapter.attr("reduce")(shared(values), name_of(how));
  }

  Messages exchange(const Messages& outgoing) override
  {
    py::dict out;
    for (const auto& [rank, bytes] : outgoing)
      out[py::int_(rank)] = py::bytes(
          reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const py::dict in = _adapter.attr("exchange")(out);
    Messages incoming;
    for (const auto& [rank, bytes] : in)
    {
      const std::string_view data = bytes.cast<std::string_view>();
      const auto* first = reinterpret_cast<const std::byte*>(data.data());
      incoming[rank.cast<int>()].assign(first, first + data.size());
    }
    return incoming;
  }

  void agree(const std::function<void()>& work) override
  {
    _adapter.attr("agree")(py::cpp_function(work));
  }

private:
  static const char* name_of(Reduction how)
  {
    return how == Reduction::sum     ? "sum"
           : how == Reduction::least ? "least"
                                     : "largest";
  }

  py::object _adapter;
  int _rank, _size;
};
} // namespace

PythonNodes::PythonNodes(py::object adapter)
    : _adapter(adapter), _ranks(std::make_unique<PythonRanks>(adapter))
{
}

std::int32_t PythonNodes::num_owned() const
{
  return _adapter.attr("num_owned").cast<std::int32_t>();
}

std::int32_t PythonNodes::num_nodes() const
{
  return _adapter.attr("num_nodes").cast<std::int32_t>();
}

void PythonNodes::forward(std::span<double> values, int width) const
{
  if (_ranks->size() > 1)
    _adapter.attr("forward")(shared(values), width);
}

void PythonNodes::forward(std::span<std::int64_t> values, int width) const
{
  if (_ranks->size() > 1)
    _adapter.attr("forward")(shared(values), width);
}

void PythonNodes::reverse(std::span<double> values, int width) const
{
  if (_ranks->size() > 1)
    _adapter.attr("reverse")(shared(values), width);
}

void contactx_bindings::parallel(py::module_& m)
{
  py::class_<NodeMap, std::shared_ptr<NodeMap>>(
      m, "NodeMap", "Nodes of this rank, for the core");
  py::class_<PythonNodes, NodeMap, std::shared_ptr<PythonNodes>>(
      m, "PythonNodes", "Nodes that an object of Python looks after")
      .def(py::init<py::object>(), py::arg("adapter"));
}
