// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "vtk_output.h"
#include <dolfinx/io/VTKFile.h>
#include <petscsystypes.h>
#include <stdexcept>

namespace contactx_dolfinx
{
VTKOutput::VTKOutput(MPI_Comm comm, const std::filesystem::path& path)
    : _ranks(comm), _path(std::filesystem::absolute(path)), _beside(_path)
{
  if (_path.extension() != ".pvd")
    throw std::invalid_argument("the path of VTKOutput is " + path.string()
                                + ": give a name that ends in .pvd");
  // Its stem gives the names of the data
  _beside += "~";
  _ranks.agree(
      [&]
      {
        if (_ranks.rank() == 0)
          std::filesystem::remove(_path);
      });
  _file = std::make_unique<dolfinx::io::VTKFile>(comm, _beside, "w");
}

VTKOutput::~VTKOutput()
{
  // DOLFINx writes once more
  _file.reset();
  std::error_code ignored;
  if (_ranks.rank() == 0)
    std::filesystem::remove(_beside, ignored);
}

void VTKOutput::write(
    const std::vector<std::reference_wrapper<const Function>>& functions,
    double t)
{
  _file->write<PetscScalar>(functions, t);
  // Once the files of all ranks are there
  _ranks.agree([] {});
  _ranks.agree(
      [&]
      {
        if (_ranks.rank() != 0)
          return;
        // This writes the collection, and the file stays open
        _file->close();
        std::filesystem::rename(_beside, _path);
      });
}
} // namespace contactx_dolfinx
