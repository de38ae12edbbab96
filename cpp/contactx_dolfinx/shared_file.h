// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "ranks.h"
#include <contactx/storage/archive.h>
#include <filesystem>
#include <stdexcept>
#include <string>

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
             const std::filesystem::path& path, int mode)
      : _ranks(&ranks)
  {
    require(MPI_File_open(comm, path.c_str(), mode, MPI_INFO_NULL, &_file));
  }
  ~SharedFile() override { MPI_File_close(&_file); }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  std::int64_t size() override
  {
    MPI_Offset size = 0;
    require(MPI_File_get_size(_file, &size));
    return size;
  }

  void write(std::int64_t at, std::span<const std::byte> bytes) override
  {
    require(MPI_File_write_at_all(_file, at, bytes.data(),
                                  static_cast<int>(bytes.size()), MPI_BYTE,
                                  MPI_STATUS_IGNORE));
  }

  void read(std::int64_t at, std::span<std::byte> bytes) override
  {
    require(MPI_File_read_at_all(_file, at, bytes.data(),
                                 static_cast<int>(bytes.size()), MPI_BYTE,
                                 MPI_STATUS_IGNORE));
  }

  /// @brief Bring to the disk what was written.
  void sync() { require(MPI_File_sync(_file)); }

private:
  void require(int code)
  {
    _ranks->agree(
        [code]
        {
          if (code == MPI_SUCCESS)
            return;
          std::string text(MPI_MAX_ERROR_STRING, '\0');
          int length = 0;
          MPI_Error_string(code, text.data(), &length);
          throw std::runtime_error(text.substr(0, length));
        });
  }

  contactx::mesh::Ranks* _ranks;
  MPI_File _file = MPI_FILE_NULL;
};
} // namespace contactx_dolfinx
