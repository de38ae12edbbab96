// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "functions.h"
#include "ranks.h"
#include <filesystem>

namespace dolfinx::io
{
class VTKFile;
}

namespace contactx_dolfinx
{
/// @brief Writes functions for ParaView, a set for each time: a collection
/// `.pvd`, and a file of each rank and time beside it.
///
/// The collection lists the times that all ranks have written, whenever the
/// program is killed: it is replaced by a longer one that was written beside
/// it. All ranks must take part in everything.
class VTKOutput
{
public:
  /// @brief Open the file; an older collection of its name is removed.
  /// @param[in] comm Communicator of the mesh.
  /// @param[in] path The file, ending in `.pvd`, in a folder that is there.
  /// @throws std::invalid_argument if it ends in something else.
  /// @throws std::runtime_error on all ranks if an older one cannot be removed.
  VTKOutput(MPI_Comm comm, const std::filesystem::path& path);

  VTKOutput(const VTKOutput&) = delete;
  VTKOutput& operator=(const VTKOutput&) = delete;

  /// @brief Close the file.
  ~VTKOutput();

  /// @brief Write functions.
  /// @param[in] functions The functions, as `Functions::all` has them.
  /// @param[in] t Time.
  /// @throws std::runtime_error on all ranks if the collection cannot be
  /// written.
  void
  write(const std::vector<std::reference_wrapper<const Function>>& functions,
        double t);

private:
  Ranks _ranks;
  std::filesystem::path _path, _beside;
  std::unique_ptr<dolfinx::io::VTKFile> _file;
};
} // namespace contactx_dolfinx
