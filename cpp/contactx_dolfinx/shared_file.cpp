// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "shared_file.h"
#include <contactx/mesh/ranks.h>
#include <stdexcept>
#include <string>

namespace contactx_dolfinx
{
SharedFile::SharedFile(MPI_Comm comm, contactx::mesh::Ranks& ranks,
                       const std::filesystem::path& path, int mode)
    : _ranks(&ranks)
{
  require(MPI_File_open(comm, path.c_str(), mode, MPI_INFO_NULL, &_file));
}

std::int64_t SharedFile::size()
{
  MPI_Offset size = 0;
  require(MPI_File_get_size(_file, &size));
  return size;
}

void SharedFile::write(std::int64_t at, std::span<const std::byte> bytes)
{
  require(MPI_File_write_at_all(_file, at, bytes.data(),
                                static_cast<int>(bytes.size()), MPI_BYTE,
                                MPI_STATUS_IGNORE));
}

void SharedFile::read(std::int64_t at, std::span<std::byte> bytes)
{
  require(MPI_File_read_at_all(_file, at, bytes.data(),
                               static_cast<int>(bytes.size()), MPI_BYTE,
                               MPI_STATUS_IGNORE));
}
void SharedFile::require(int code)
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
} // namespace contactx_dolfinx
