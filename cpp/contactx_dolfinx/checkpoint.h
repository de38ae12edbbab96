// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include <filesystem>

namespace contactx_dolfinx
{
/// @brief Writes the state of an Assembler to a file, from which another run
/// goes on, on any number of ranks.
///
/// Each rank writes and reads its share of the rows. They are known by the
/// numbers of nodes in the mesh as it was made: the other run must read the
/// same mesh. Files are those of contactx.LoadSteps in Python. All ranks must
/// take part in everything.
class Checkpoint
{
public:
  /// @brief Find the rows.
  /// @param[in] assembler The system; it must outlive this.
  /// @param[in] history Further functions that belong to the state, as plastic
  /// strains do.
  /// @throws std::invalid_argument if a function is null, or, on several ranks,
  /// of a space whose dofs change their order from rank to rank: Lagrange
  /// spaces of degree 1 and 2, mixed ones of them, discontinuous and quadrature
  /// spaces do not.
  explicit Checkpoint(Assembler& assembler,
                      std::vector<std::shared_ptr<Function>> history = {});

  /// @brief Write the state; a file of this name is replaced once the new one
  /// is whole.
  /// @param[in] path The file.
  /// @param[in] plan Load steps whose place belongs to it, null for none.
  /// @throws std::runtime_error on all ranks if it cannot be written.
  void write(const std::filesystem::path& path,
             const StepPlan* plan = nullptr) const;

  /// @brief Go on from what `write` has written for the same problem.
  /// @param[in] path The file.
  /// @param[in,out] plan Load steps, which go on from the place of the saved
  /// ones; null for none.
  /// @throws std::invalid_argument on all ranks if there is no such file, it is
  /// damaged or of another problem, or has no load steps; nothing has changed.
  void read(const std::filesystem::path& path, StepPlan* plan = nullptr);

private:
  using Core = contactx::problem::Checkpoint;

  contactx::mesh::Ranks& ranks() const
  {
    return _assembler->system()->halo()->ranks();
  }

  MPI_Comm comm() const
  {
    return _assembler->bulk()->u()->function_space()->mesh()->comm();
  }

  /// Does something on rank 0 alone.
  template <class Work>
  void on_first(Work work) const;

  /// Adds the functions that are solved for to those of the history, and finds
  /// the rows of all.
  Core create();

  /// Finds the rows of a function: nodes, or cells.
  Core::Function rows_of(const std::string& name, const Function& f);

  /// Takes functions and contacts; what was before stays where these do not
  /// fit.
  void take(const Core::State& state);

  Assembler* _assembler;
  // The displacement, the history, and what else is solved for; dofs of their
  // rows
  std::vector<std::shared_ptr<Function>> _functions;
  std::vector<std::vector<std::int32_t>> _dofs;
  Core _core;
};
} // namespace contactx_dolfinx
