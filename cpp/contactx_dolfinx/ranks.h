// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/mesh/ranks.h>
#include <dolfinx/common/MPI.h>

namespace contactx_dolfinx
{
/// @brief The ranks of a communicator, by MPI.
///
/// It has a communicator of its own, so that its messages meet no others.
class Ranks final : public contactx::mesh::Ranks
{
public:
  /// @brief Duplicate a communicator; all ranks must take part.
  /// @param[in] comm Communicator.
  explicit Ranks(MPI_Comm comm) : _comm(comm, true) {}

  int rank() const override { return dolfinx::MPI::rank(_comm.comm()); }
  int size() const override { return dolfinx::MPI::size(_comm.comm()); }
  void reduce(std::span<double> values, contactx::mesh::Reduction how) override;
  void reduce(std::span<std::int64_t> values,
              contactx::mesh::Reduction how) override;

  /// @copydoc contactx::mesh::Ranks::gather
  /// @throws std::length_error if MPI cannot count the bytes of all.
  std::vector<std::byte> gather(std::span<const std::byte> mine) override;

  /// @brief Sparse exchange by nonblocking consensus (Hoefler, Siebert,
  /// Lumsdaine 2010): what it costs a rank goes with the ranks that it writes
  /// to, not with how many there are.
  /// @throws std::length_error if a message is longer than MPI can count.
  contactx::mesh::Messages
  exchange(const contactx::mesh::Messages& outgoing) override;

private:
  void reduce(void* values, std::size_t count, MPI_Datatype type,
              contactx::mesh::Reduction how);

  dolfinx::MPI::Comm _comm;
  int _turn = 0;
};
} // namespace contactx_dolfinx
