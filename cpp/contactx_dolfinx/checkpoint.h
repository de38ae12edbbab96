// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include <cmath>
#include <contactx/contact/contact_state.h>
#include <dolfinx/io/HDF5Interface.h>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>

namespace contactx_dolfinx
{
/// @brief Writes the state of an Assembler to a file, from which another run
/// goes on, on any number of ranks.
///
/// The file is of HDF5, and each rank writes and reads its rows. They are known
/// by the numbers of nodes and cells in the mesh as it was made: the other run
/// must read the same mesh. All ranks must take part in everything.
class Checkpoint
{
public:
  /// @brief Find the rows.
  /// @param[in] assembler The system; it must outlive this.
  /// @param[in] history Further functions that belong to the state, as plastic
  /// strains do.
  /// @throws std::invalid_argument if a function is null, or of a space whose
  /// dofs change their order from rank to rank: Lagrange spaces of degree 1 and
  /// 2, mixed ones of them, discontinuous and quadrature spaces do not.
  explicit Checkpoint(Assembler& assembler,
                      std::vector<std::shared_ptr<Function>> history = {})
      : _assembler(&assembler)
  {
    const auto& solved = assembler.bulk()->functions();
    for (std::size_t k = 0; k < solved.size(); ++k)
      add("function_" + std::to_string(k), solved[k]);
    for (std::size_t k = 0; k < history.size(); ++k)
      add("history_" + std::to_string(k), std::move(history[k]));
  }

  /// @brief Write the state; a file of this name is replaced once the new one
  /// is whole.
  /// @param[in] path The file.
  /// @param[in] plan Load steps whose place belongs to it, null for none.
  /// @throws std::runtime_error on all ranks if it cannot be written.
  void write(const std::filesystem::path& path,
             const StepPlan* plan = nullptr) const
  {
    std::filesystem::path temporary = path;
    temporary += ".tmp";
    try
    {
      write_state(File(comm(), ranks(), temporary, "w"), plan);
      ranks().agree(
          [&]
          {
            if (ranks().rank() == 0)
              std::filesystem::rename(temporary, path);
          });
    }
    catch (const std::exception& error)
    {
      std::error_code ignored;
      if (ranks().rank() == 0)
        std::filesystem::remove(temporary, ignored);
      throw std::runtime_error("cannot write the checkpoint " + path.string()
                               + ": " + error.what()
                               + "; an older file of this name is as it was");
    }
  }

  /// @brief Go on from what `write` has written for the same problem.
  /// @param[in] path The file.
  /// @param[in,out] plan Load steps, which go on from the place of the saved
  /// ones; null for none.
  /// @throws std::invalid_argument on all ranks if there is no such file, it is
  /// damaged or of another problem, or has no load steps; nothing has changed.
  void read(const std::filesystem::path& path, StepPlan* plan = nullptr)
  {
    ranks().agree(
        [&]
        {
          if (not std::filesystem::is_regular_file(path))
            throw std::invalid_argument("there is no checkpoint "
                                        + path.string()
                                        + ". Give another file, or start anew "
                                          "(manual: errors/restart-refused)");
        });
    try
    {
      restore(File(comm(), ranks(), path, "r"), plan);
    }
    catch (const std::exception& error)
    {
      throw std::invalid_argument(
          "cannot restart from " + path.string() + ": " + error.what()
          + ". Give a checkpoint of this problem, or start anew (manual: "
            "errors/restart-refused)");
    }
  }

private:
  static constexpr std::int64_t version = 2;
  // Rows that are read at once
  static constexpr std::int64_t chunk = 1 << 16;

  /// Rows of this rank, by keys that no other row has, on any rank.
  struct Rows
  {
    std::vector<std::int64_t> keys;
  };

  /// A function, and its dofs in each row.
  struct Saved
  {
    std::shared_ptr<Function> function;
    Rows rows;
    std::vector<std::int32_t> dofs; // (rows, width)
  };

  /// A file, open while this lives.
  class File
  {
  public:
    File(MPI_Comm comm, contactx::mesh::Ranks& ranks,
         const std::filesystem::path& path, const std::string& mode)
        : _comm(comm), _ranks(&ranks), _parallel(dolfinx::MPI::size(comm) > 1),
          _handle(dolfinx::io::hdf5::open_file(comm, path, mode, _parallel))
    {
    }
    ~File() { dolfinx::io::hdf5::close_file(_handle); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    bool has(const std::string& name) const
    {
      // Asked for in a group that is not there, HDF5 prints errors
      for (auto end = name.find('/'); end != std::string::npos;
           end = name.find('/', end + 1))
        if (not dolfinx::io::hdf5::has_dataset(_handle,
                                               "/" + name.substr(0, end)))
          return false;
      return dolfinx::io::hdf5::has_dataset(_handle, "/" + name);
    }

    /// Write what is the same on all ranks.
    template <class T>
    void write_same(const std::string& name, const std::vector<T>& values) const
    {
      const bool mine = dolfinx::MPI::rank(_comm) == 0;
      put(name, values, 1, mine ? static_cast<std::int64_t>(values.size()) : 0);
    }

    /// Write rows, with their keys.
    void write(const Rows& rows, const std::string& name,
               const std::vector<double>& values) const
    {
      const auto n = static_cast<std::int64_t>(rows.keys.size());
      put(name + "/keys", rows.keys, 1, n);
      put(name + "/values", values, width_of(rows, values.size()), n);
    }

    template <class T>
    std::vector<T> read_same(const std::string& name) const
    {
      return get<T>(name, {0, shape(name)[0]});
    }

    /// Read this rank's rows, in their order.
    /// @param[in] size Number of values here.
    std::vector<double> read(const Rows& rows, const std::string& name,
                             std::size_t size) const
    {
      const auto width = static_cast<std::size_t>(width_of(rows, size));
      std::vector<std::pair<std::int64_t, std::size_t>> mine;
      for (std::size_t i = 0; i < rows.keys.size(); ++i)
        mine.emplace_back(rows.keys[i], i);
      std::ranges::sort(mine);
      const auto count = contactx::mesh::total(
          *_ranks, static_cast<std::int64_t>(mine.size()));
      const auto there = shape(name + "/values");
      const auto columns = static_cast<std::int64_t>(width);
      if (there[0] != count or (count > 0 and there[1] != columns))
        throw std::invalid_argument(
            "'" + name + "' has " + std::to_string(there[0]) + " rows of "
            + std::to_string(there[1]) + " there, and " + std::to_string(count)
            + " of " + std::to_string(width)
            + " here: it is of another mesh, or of other contacts");
      std::vector<double> values(mine.size() * width);
      std::size_t found = 0;
      for (std::int64_t first = 0; first < count; first += chunk)
      {
        const std::array range{first, std::min(first + chunk, count)};
        const auto keys = get<std::int64_t>(name + "/keys", range);
        const auto some = get<double>(name + "/values", range);
        for (std::size_t r = 0; r < keys.size(); ++r)
        {
          const auto at = std::ranges::lower_bound(
              mine, keys[r], {}, [](const auto& row) { return row.first; });
          if (at == mine.end() or at->first != keys[r])
            continue;
          std::copy_n(some.begin() + std::ptrdiff_t(r * width), width,
                      values.begin() + std::ptrdiff_t(at->second * width));
          ++found;
        }
      }
      if (contactx::mesh::anywhere(*_ranks, found != mine.size()))
        throw std::invalid_argument(
            "'" + name
            + "' has other rows: it is of another mesh, or of other surfaces");
      return values;
    }

  private:
    /// Values a row, which a rank without rows does not know by itself.
    std::int64_t width_of(const Rows& rows, std::size_t size) const
    {
      const std::size_t n = rows.keys.size();
      return contactx::mesh::largest(
          *_ranks, static_cast<std::int64_t>(n > 0 ? size / n : 0));
    }

    std::vector<std::int64_t> shape(const std::string& name) const
    {
      if (not has(name))
        throw std::invalid_argument("'" + name
                                    + "' is missing: contacts, their options "
                                      "or functions were others");
      auto shape = dolfinx::io::hdf5::get_dataset_shape(_handle, "/" + name);
      shape.resize(2, 1);
      return shape;
    }

    template <class T>
    void put(const std::string& name, const std::vector<T>& values,
             std::int64_t width, std::int64_t rows) const
    {
      std::int64_t end = 0;
      MPI_Scan(&rows, &end, 1, MPI_INT64_T, MPI_SUM, _comm);
      const std::int64_t all = contactx::mesh::total(*_ranks, rows);
      dolfinx::io::hdf5::write_dataset(_handle, "/" + name, values.data(),
                                       {end - rows, end}, {all, width},
                                       _parallel, false);
    }

    template <class T>
    std::vector<T> get(const std::string& name,
                       std::array<std::int64_t, 2> range) const
    {
      const hid_t set = dolfinx::io::hdf5::open_dataset(_handle, "/" + name);
      try
      {
        auto values = dolfinx::io::hdf5::read_dataset<T>(set, range, false);
        H5Dclose(set);
        return values;
      }
      catch (...)
      {
        H5Dclose(set);
        throw;
      }
    }

    MPI_Comm _comm;
    contactx::mesh::Ranks* _ranks;
    bool _parallel;
    hid_t _handle;
  };

  const contactx::solve::System::Contacts& contacts() const
  {
    return _assembler->system()->contacts();
  }
  contactx::mesh::Halo& halo() const { return *_assembler->system()->halo(); }
  contactx::mesh::Ranks& ranks() const { return halo().ranks(); }
  MPI_Comm comm() const
  {
    return _assembler->bulk()->u()->function_space()->mesh()->comm();
  }

  static std::string name_of(std::size_t contact, const std::string& array)
  {
    return "contact_" + std::to_string(contact) + "/" + array;
  }

  /// Finds the rows of a function: nodes, or cells.
  void add(const std::string& name, std::shared_ptr<Function> f)
  {
    if (f == nullptr)
      throw std::invalid_argument(name + " is null: give a Function");
    const FunctionSpace& V = *f->function_space();
    const auto& dofs = *V.dofmap();
    const int bs = dofs.bs();
    Saved saved{f, {}, {}};
    if (is_lagrange(V))
    {
      const auto original = original_nodes(V, ranks());
      const std::int32_t n = dofs.index_map->size_local();
      saved.rows.keys.assign(original.begin(), original.begin() + n);
      for (std::int32_t dof = 0; dof < bs * n; ++dof)
        saved.dofs.push_back(dof);
    }
    else
    {
      if (V.element()->needs_dof_permutations()
          or V.element()->needs_dof_transformations())
        throw std::invalid_argument(
            name
            + " is of a space whose dofs change their order from rank to rank: "
              "take a Lagrange space of degree 1 or 2, a mixed one of such, a "
              "quadrature or a discontinuous space");
      const auto& topology = *V.mesh()->topology();
      const std::int32_t n = topology.index_map(topology.dim())->size_local();
      const auto original = original_cells(*V.mesh());
      if (contactx::mesh::anywhere(ranks(), original.size() < std::size_t(n)))
        throw std::invalid_argument(
            name
            + " has values in cells, but the mesh does not know the numbers "
              "that they had as it was made: make it with mesh::create_mesh or "
              "read it");
      saved.rows.keys.assign(original.begin(), original.begin() + n);
      const auto cells = dofs.map();
      for (std::int32_t c = 0; c < n; ++c)
        for (std::size_t i = 0; i < cells.extent(1); ++i)
          for (int k = 0; k < bs; ++k)
            saved.dofs.push_back(bs * cells(c, i) + k);
    }
    _functions.emplace(name, std::move(saved));
  }

  static std::vector<double> values_of(const Saved& f)
  {
    std::vector<double> values;
    for (const std::int32_t dof : f.dofs)
      values.push_back(f.function->x()->array()[dof]);
    return values;
  }

  Rows node_rows() const
  {
    const auto original = halo().original();
    return {{original.begin(), original.begin() + halo().num_owned()}};
  }

  Rows rows_of(contactx::contact::RowKind kind, std::size_t contact) const
  {
    if (kind == contactx::contact::RowKind::node)
      return node_rows();
    Rows rows;
    for (const std::int32_t node : contacts()[contact]->slaves().owned())
      rows.keys.push_back(halo().original()[node]);
    return rows;
  }

  /// State of a contact, and what tells it from others.
  std::vector<contactx::contact::Saved> arrays_of(std::size_t k) const
  {
    std::vector<contactx::contact::Saved> arrays
        = contactx::contact::save(*contacts()[k]);
    const std::size_t g = halo().gdim();
    for (contactx::contact::Saved& s : arrays)
      if (s.rows == contactx::contact::RowKind::node)
        std::get<std::vector<double>>(s.values).resize(halo().num_owned() * g);
    // Facets of all ranks, whichever has them: a sum of their hashes
    std::uint64_t sum
        = contacts()[k]->sliding() == contactx::contact::Sliding::small ? 1 : 2;
    if (ranks().rank() > 0)
      sum = 0;
    for (const contactx::contact::Saved& s :
         contacts()[k]->master()->identity())
    {
      const auto& numbers = std::get<std::vector<std::int64_t>>(s.values);
      for (std::size_t i = 0; i < numbers.size(); i += s.width)
      {
        std::uint64_t hash = 14695981039346656037u; // FNV-1a
        for (int j = 0; j < s.width; ++j)
          hash = (hash ^ std::uint64_t(numbers[i + j])) * 1099511628211u;
        sum += hash;
      }
    }
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UINT64_T, MPI_SUM, comm());
    arrays.push_back(
        {"identity", contactx::contact::RowKind::global, 0,
         std::vector<double>{double(sum >> 32), double(sum & 0xffffffffu)}});
    return arrays;
  }

  /// Reference positions of the owned nodes.
  std::vector<double> identity() const { return owned(halo().reference()); }

  /// Rows of the owned nodes.
  std::vector<double> owned(std::span<const double> values) const
  {
    return {values.begin(),
            values.begin()
                + std::ptrdiff_t(halo().gdim()) * halo().num_owned()};
  }

  static std::vector<double> doubles(const contactx::contact::Saved& s)
  {
    return std::visit(
        [](const auto& values)
        { return std::vector<double>(values.begin(), values.end()); },
        s.values);
  }

  void write_state(const File& file, const StepPlan* plan) const
  {
    file.write_same("format", std::vector<std::int64_t>{version});
    if (plan)
    {
      file.write_same("plan/given", plan->given());
      file.write_same("plan/place", plan->place());
    }
    const Rows nodes = node_rows();
    file.write(nodes, "nodes", identity());
    file.write(nodes, "start", owned(halo().start()->u));
    file.write(nodes, "before", halo().before());
    for (const auto& [name, f] : _functions)
      file.write(f.rows, name, values_of(f));
    for (std::size_t k = 0; k < contacts().size(); ++k)
      for (const contactx::contact::Saved& s : arrays_of(k))
        if (s.rows == contactx::contact::RowKind::global)
          file.write_same(name_of(k, s.name), doubles(s));
        else
          file.write(rows_of(s.rows, k), name_of(k, s.name), doubles(s));
  }

  void restore(const File& file, StepPlan* plan)
  {
    if (not file.has("format"))
      throw std::invalid_argument("it is no checkpoint of contactx");
    const auto format = file.read_same<std::int64_t>("format");
    if (format != std::vector{version})
      throw std::invalid_argument("it has format " + std::to_string(format[0])
                                  + ", but this contactx reads "
                                  + std::to_string(version));
    if (plan and not file.has("plan/place"))
      throw std::invalid_argument("it has no load steps");
    check_mesh(file.read(node_rows(), "nodes", identity().size()));
    std::map<std::string, std::vector<double>> values;
    for (const auto& [name, f] : _functions)
    {
      values[name] = file.read(f.rows, name, f.dofs.size());
      const bool is_finite = std::ranges::all_of(values[name], [](double v)
                                                 { return std::isfinite(v); });
      if (not contactx::mesh::everywhere(ranks(), is_finite))
        throw std::invalid_argument("'" + name + "' is not finite");
    }
    std::vector<double> start
        = file.read(node_rows(), "start", identity().size());
    std::vector<double> before
        = file.read(node_rows(), "before", identity().size());
    std::vector<std::vector<contactx::contact::Saved>> states;
    for (std::size_t k = 0; k < contacts().size(); ++k)
    {
      std::vector<contactx::contact::Saved> arrays = arrays_of(k);
      for (contactx::contact::Saved& s : arrays)
        std::visit(
            [&](auto& here)
            {
              const std::string name = name_of(k, s.name);
              const auto there
                  = s.rows == contactx::contact::RowKind::global
                        ? file.read_same<double>(name)
                        : file.read(rows_of(s.rows, k), name, here.size());
              if (s.name == "identity" and not std::ranges::equal(here, there))
                throw std::invalid_argument(
                    "contact " + std::to_string(k)
                    + " has another master, or another sliding");
              here.assign(there.begin(), there.end());
            },
            s.values);
      states.push_back(std::move(arrays));
    }
    StepPlan place = plan ? *plan : StepPlan({1});
    if (plan)
      place.load(file.read_same<double>("plan/given"),
                 file.read_same<double>("plan/place"));
    take(values, std::move(start), std::move(before), std::move(states));
    if (plan)
      *plan = place;
  }

  void check_mesh(const std::vector<double>& there) const
  {
    const std::vector<double> here = identity();
    std::array<double, 2> most{};
    for (std::size_t i = 0; i < here.size(); ++i)
    {
      most[0] = std::max(most[0], std::abs(here[i]));
      most[1] = std::max(most[1], std::abs(here[i] - there[i]));
    }
    ranks().reduce(std::span<double>(most), contactx::mesh::Reduction::largest);
    // Another machine may round them in another way
    if (not(most[1] <= 1e-12 * most[0]))
      throw std::invalid_argument("its nodes are elsewhere: it is of another "
                                  "mesh");
  }

  /// Takes functions and contacts; what was before stays where these do not
  /// fit.
  void take(const std::map<std::string, std::vector<double>>& values,
            std::vector<double> start, std::vector<double> last,
            std::vector<std::vector<contactx::contact::Saved>> contacts)
  {
    const contactx::problem::Snapshot before = _assembler->problem().snapshot();
    // Of bodies without stress
    _assembler->problem().find_rigid_modes();
    std::vector<std::vector<double>> arrays;
    for (const auto& [name, f] : _functions)
      arrays.push_back(f.function->x()->array());
    const auto set = [](Function& f, auto&& write)
    {
      write(f.x()->array());
      f.x()->scatter_fwd();
    };
    for (const auto& [name, f] : _functions)
      set(*f.function,
          [&](auto& x)
          {
            for (std::size_t i = 0; i < f.dofs.size(); ++i)
              x[f.dofs[i]] = values.at(name)[i];
          });
    try
    {
      _assembler->take(std::move(start), std::move(last), std::move(contacts));
    }
    catch (...)
    {
      auto old = arrays.begin();
      for (const auto& [name, f] : _functions)
        set(*f.function, [&](auto& x) { x = *old++; });
      before.restore();
      throw;
    }
  }

  Assembler* _assembler;
  std::map<std::string, Saved> _functions;
};
} // namespace contactx_dolfinx
