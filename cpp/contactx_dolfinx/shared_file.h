// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/storage/archive.h>
#include <filesystem>
#include <mpi.h>

namespace contactx::mesh
{
class Ranks;
}

namespace contactx_dolfinx
{
/// @brief A file that all ranks have open while this lives; all must take part
/// in everything. What fails on one rank is thrown on all.
class SharedFile final : public contactx::storage::File
{
public:
  /// @brief Open a file.
  /// @param[in] comm Communicator.
  /// @param[in] ranks Its ranks.
  /// @param[in] path The file.
  /// @param[in] mode MPI's mode.
  /// @throws std::runtime_error if MPI cannot.
  SharedFile(MPI_Comm comm, contactx::mesh::Ranks& ranks,
             const std::filesystem::path& path, int mode);
  ~SharedFile() override { MPI_File_close(&_file); }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  std::int64_t size() override;
  void write(std::int64_t at, std::span<const std::byte> bytes) override;
  void read(std::int64_t at, std::span<std::byte> bytes) override;

  /// @brief Bring to the disk what was written.
  void sync() { require(MPI_File_sync(_file)); }

private:
  void require(int code);

  contactx::mesh::Ranks* _ranks;
  MPI_File _file = MPI_FILE_NULL;
};
} // namespace contactx_dolfinx
