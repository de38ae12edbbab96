// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../contact/saved.h"
#include "../storage/archive.h"
#include <map>
#include <memory>

namespace contactx::problem
{
/// @brief State of a problem in a file, to go on from on any number of ranks.
/// All ranks must take part in everything.
class Checkpoint
{
public:
  /// @brief A function of the host, which has a row of values a node or a cell.
  struct Function
  {
    std::string name;
    /// Key of each row that this rank owns, see storage::Rows
    /// (shape=(n, key_width))
    std::vector<std::int64_t> keys;
    int key_width;
    int width; ///< values a row
  };

  /// @brief The mesh, by which a file is told from those of others.
  struct Mesh
  {
    /// Reference positions of the displacement's owned nodes (shape=(n, gdim))
    std::vector<double> positions;
    /// Nodes of the owned cells by their numbers in the mesh as it was made
    /// (shape=(num_cells, points_per_cell))
    std::vector<std::int64_t> cells;
    int points_per_cell;
  };

  /// @brief Numbers that are the same on all ranks, by their names.
  using Numbers = std::map<std::string, std::vector<double>>;

  /// @brief Values of all that a step's answer depends on.
  struct State
  {
    /// Those of each function (shape=(rows, width))
    std::vector<std::vector<double>> functions;
    /// Displacements of the step's start and of that of the step before, none
    /// without contacts (shape=(num_owned, gdim))
    std::vector<double> start, before;
    /// Those of each contact, see contact::save
    std::vector<std::vector<contact::Saved>> contacts;
    Numbers steps; ///< what the host knows of the load steps
  };

  /// @brief Find the rows.
  /// @param[in] ranks The ranks; they must outlive this.
  /// @param[in] halo Nodes of this rank; null for a problem without contacts.
  /// @param[in] contacts The contacts.
  /// @param[in] functions The functions, the displacement "u" first, whose
  /// rows are its nodes.
  /// @param[in] mesh The mesh.
  /// @throws std::invalid_argument on all ranks if there are several and two
  /// rows have the same key.
  Checkpoint(mesh::Ranks& ranks, std::shared_ptr<mesh::Halo> halo,
             std::vector<std::shared_ptr<contact::Contact>> contacts,
             std::vector<Function> functions, Mesh mesh);

  /// @brief Write the state of now.
  /// @param[in] file An empty file.
  /// @param[in] functions Values of the functions (shape=(rows, width)).
  /// @param[in] steps What the host knows of the load steps.
  void write(storage::File& file, std::vector<std::vector<double>> functions,
             Numbers steps) const;

  /// @brief Read a state; nothing changes.
  /// @param[in] file The file.
  /// @throws std::invalid_argument on all ranks if it is damaged, of another
  /// problem or not finite.
  State read(storage::File& file) const;

  /// @brief Let the contacts go on from a state, and the steps' starts; the
  /// host has set the displacements.
  /// @param[in] state The state.
  /// @throws std::invalid_argument on all ranks if it does not fit the
  /// contacts; some may have changed then.
  void apply(const State& state) const;

private:
  // Calls use(name, rows, width, values) for each array of a state, whose
  // values it may take or change
  template <class Use>
  void for_each(State& state, Use use) const;
  // The state of now, but for functions and steps
  State now() const;

  mesh::Ranks* _ranks;
  std::shared_ptr<mesh::Halo> _halo;
  std::vector<std::shared_ptr<contact::Contact>> _contacts;
  std::vector<Function> _functions; // without their keys
  std::vector<storage::Rows> _rows, _slaves;
  std::vector<double> _positions;
  std::vector<std::int64_t> _cells;
  std::vector<std::vector<std::int64_t>> _identities;
};
} // namespace contactx::problem
