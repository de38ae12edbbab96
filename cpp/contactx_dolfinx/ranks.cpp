// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "ranks.h"
#include <climits>
#include <stdexcept>

namespace contactx_dolfinx
{
void Ranks::reduce(std::span<double> values, contactx::mesh::Reduction how)
{
  reduce(values.data(), values.size(), MPI_DOUBLE, how);
}

void Ranks::reduce(std::span<std::int64_t> values,
                   contactx::mesh::Reduction how)
{
  reduce(values.data(), values.size(), MPI_INT64_T, how);
}

std::vector<std::byte> Ranks::gather(std::span<const std::byte> mine)
{
  const auto own = static_cast<std::int64_t>(mine.size());
  std::vector<std::int64_t> sizes(size());
  MPI_Allgather(&own, 1, MPI_INT64_T, sizes.data(), 1, MPI_INT64_T,
                _comm.comm());
  std::vector<int> counts, begins;
  std::int64_t total = 0;
  for (const std::int64_t count : sizes)
  {
    begins.push_back(static_cast<int>(total));
    counts.push_back(static_cast<int>(count));
    total += count;
    // The same on all ranks
    if (total > INT_MAX)
      throw std::length_error("what all ranks have is too long");
  }
  std::vector<std::byte> all(total);
  MPI_Allgatherv(mine.data(), counts[rank()], MPI_BYTE, all.data(),
                 counts.data(), begins.data(), MPI_BYTE, _comm.comm());
  return all;
}

contactx::mesh::Messages
Ranks::exchange(const contactx::mesh::Messages& outgoing)
{
  // Tags in turn, so that a message never ends up in the exchange before its
  // own
  const int tag = _turn;
  _turn = (_turn + 1) % 16;
  contactx::mesh::Messages received;
  std::vector<MPI_Request> sending;
  for (const auto& [to, bytes] : outgoing)
  {
    if (to == rank())
    {
      received[to] = bytes;
      continue;
    }
    if (bytes.size() > INT_MAX)
      throw std::length_error("a message to another rank is too long");
    MPI_Issend(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag,
               _comm.comm(), &sending.emplace_back());
  }
  if (size() == 1)
    return received;

  MPI_Request barrier = MPI_REQUEST_NULL;
  int is_done = 0;
  for (bool is_waiting = false; not is_done;)
  {
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, _comm.comm(), &is_there, &status);
    if (is_there)
    {
      int count = 0;
      MPI_Get_count(&status, MPI_BYTE, &count);
      std::vector<std::byte>& bytes = received[status.MPI_SOURCE];
      bytes.resize(count);
      MPI_Recv(bytes.data(), count, MPI_BYTE, status.MPI_SOURCE, tag,
               _comm.comm(), MPI_STATUS_IGNORE);
    }
    if (is_waiting)
    {
      MPI_Test(&barrier, &is_done, MPI_STATUS_IGNORE);
      continue;
    }
    int is_sent = 0;
    MPI_Testall(static_cast<int>(sending.size()), sending.data(), &is_sent,
                MPI_STATUSES_IGNORE);
    if (is_sent)
    {
      MPI_Ibarrier(_comm.comm(), &barrier);
      is_waiting = true;
    }
  }
  return received;
}

void Ranks::reduce(void* values, std::size_t count, MPI_Datatype type,
                   contactx::mesh::Reduction how)
{
  const MPI_Op operation = how == contactx::mesh::Reduction::sum     ? MPI_SUM
                           : how == contactx::mesh::Reduction::least ? MPI_MIN
                                                                     : MPI_MAX;
  MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(count), type, operation,
                _comm.comm());
}
} // namespace contactx_dolfinx
