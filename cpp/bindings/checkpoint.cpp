// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include "parallel.h"
#include <contactx/problem/checkpoint.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::mesh::Ranks;
using contactx::problem::Checkpoint;

namespace
{
/// File of an object of Python, see
/// python/contactx/_host/checkpoint/shared_file.py.
class PythonFile final : public contactx::storage::File
{
public:
  explicit PythonFile(py::object adapter) : _adapter(std::move(adapter)) {}

  std::int64_t size() override
  {
    return _adapter.attr("size")().cast<std::int64_t>();
  }
  void write(std::int64_t at, std::span<const std::byte> bytes) override
  {
    _adapter.attr("write")(
        at, look(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                           bytes.size())));
  }
  void read(std::int64_t at, std::span<std::byte> bytes) override
  {
    _adapter.attr("read")(
        at, lend(std::span(reinterpret_cast<std::uint8_t*>(bytes.data()),
                           bytes.size())));
  }

private:
  py::object _adapter;
};

/// With the ranks, which it needs as long as it is there.
class PythonCheckpoint
{
public:
  using Function = std::tuple<std::string, Array<std::int64_t>, int>;

  PythonCheckpoint(
      py::object ranks,
      std::vector<std::shared_ptr<contactx::contact::Contact>> contacts,
      const std::vector<Function>& functions, const Array<double>& positions,
      const Array<std::int64_t>& cells,
      std::shared_ptr<contactx::mesh::Halo> halo)
      : _ranks(make_ranks(std::move(ranks))),
        _checkpoint(*_ranks, std::move(halo), std::move(contacts),
                    given(functions),
                    {copy(positions), copy(cells), width(cells)})
  {
  }

  const Checkpoint& get() const { return _checkpoint; }

private:
  static int width(const Array<std::int64_t>& keys)
  {
    return static_cast<int>(keys.shape(1));
  }

  static std::vector<Checkpoint::Function>
  given(const std::vector<Function>& functions)
  {
    std::vector<Checkpoint::Function> result;
    for (const auto& [name, keys, values] : functions)
      result.push_back({name, copy(keys), width(keys), values});
    return result;
  }

  std::unique_ptr<Ranks> _ranks;
  Checkpoint _checkpoint;
};

} // namespace

void contactx_bindings::checkpoint(py::module_& m)
{
  py::class_<Checkpoint::State>(m, "CheckpointState",
                                "Values of all that a step's answer depends on")
      .def_property_readonly(
          "functions",
          [](py::object self)
          {
            py::list functions;
            for (const auto& values :
                 self.cast<const Checkpoint::State&>().functions)
              functions.append(looking(
                  values, {static_cast<py::ssize_t>(values.size())}, self));
            return functions;
          })
      .def_property_readonly("steps",
                             [](const Checkpoint::State& self)
                             {
                               py::dict steps;
                               for (const auto& [name, numbers] : self.steps)
                                 steps[py::str(name)] = array(numbers);
                               return steps;
                             });
  py::class_<PythonCheckpoint>(
      m, "Checkpoint", "State of a problem in a file, on any number of ranks")
      .def(py::init<py::object,
                    std::vector<std::shared_ptr<contactx::contact::Contact>>,
                    const std::vector<PythonCheckpoint::Function>&,
                    const Array<double>&, const Array<std::int64_t>&,
                    std::shared_ptr<contactx::mesh::Halo>>(),
           py::arg("ranks"), py::arg("contacts"), py::arg("functions"),
           py::arg("positions"), py::arg("cells"), py::arg("halo") = py::none(),
           // A subclass in Python must outlive who calls its methods
           py::keep_alive<1, 3>())
      .def(
          "write",
          [](const PythonCheckpoint& self, py::object file,
             const py::iterable& functions,
             const std::map<std::string, Array<double>>& steps)
          {
            std::vector<std::vector<double>> values;
            for (const py::handle f : functions)
              values.push_back(copy(f.cast<Array<double>>()));
            Checkpoint::Numbers numbers;
            for (const auto& [name, a] : steps)
              numbers[name] = copy(a);
            PythonFile shared(std::move(file));
            self.get().write(shared, std::move(values), std::move(numbers));
          },
          py::arg("file"), py::arg("functions"), py::arg("steps"))
      .def(
          "read",
          [](const PythonCheckpoint& self, py::object file)
          {
            PythonFile shared(std::move(file));
            return self.get().read(shared);
          },
          py::arg("file"))
      .def(
          "apply",
          [](const PythonCheckpoint& self, const Checkpoint::State& state)
          { self.get().apply(state); }, py::arg("state"));
}
