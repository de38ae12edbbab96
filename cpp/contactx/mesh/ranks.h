// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

/// @brief Communication that the core needs. An adapter provides it, by MPI
/// or by whatever else it has.
namespace contactx::mesh
{
/// @brief Reductions of the numbers of all ranks to one.
enum class Reduction : std::int8_t
{
  sum,
  least,
  largest
};

/// @brief Bytes by the rank that they go to, or come from.
using Messages = std::map<int, std::vector<std::byte>>;

/// @brief The ranks that share a problem. All of them must take part in
/// whatever has no const.
class Ranks
{
public:
  virtual ~Ranks() = default;

  /// @brief Number of this rank.
  virtual int rank() const = 0;

  /// @brief Number of ranks.
  virtual int size() const = 0;

  /// @brief Reduce numbers over the ranks, each for itself.
  /// @param[in,out] values Numbers of this rank, as many on each.
  /// @param[in] how What becomes of them.
  virtual void reduce(std::span<double> values, Reduction how) = 0;

  /// @copydoc reduce
  virtual void reduce(std::span<std::int64_t> values, Reduction how) = 0;

  /// @brief Bytes of all ranks, one rank's after the other's.
  /// @param[in] mine Bytes of this rank, any number of them.
  virtual std::vector<std::byte> gather(std::span<const std::byte> mine) = 0;

  /// @brief Send messages and receive those of others, who do not know of them
  /// yet.
  /// @param[in] outgoing Messages, one to this rank itself among them or not.
  /// @return Those that came in, by the rank that sent them.
  virtual Messages exchange(const Messages& outgoing) = 0;

  /// @brief Do something of this rank alone, and throw what is thrown on any
  /// rank on all of them, so that none waits for another one for ever.
  ///
  /// Other ranks than the first that throws get its message as a
  /// std::invalid_argument or std::runtime_error.
  /// @param[in] work Function to call; it must not communicate.
  virtual void agree(const std::function<void()>& work);
};

/// @brief One rank alone.
class OneRank final : public Ranks
{
public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void reduce(std::span<double>, Reduction) override {}
  void reduce(std::span<std::int64_t>, Reduction) override {}
  std::vector<std::byte> gather(std::span<const std::byte> mine) override
  {
    return {mine.begin(), mine.end()};
  }
  Messages exchange(const Messages& outgoing) override { return outgoing; }
};

/// @brief A number of all ranks.
/// @param[in] ranks The ranks, all of which take part.
/// @param[in] value Number of this rank.
/// @param[in] how What becomes of the numbers.
template <class T>
T reduced(Ranks& ranks, T value, Reduction how)
{
  using Number
      = std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t>;
  auto number = static_cast<Number>(value);
  if (ranks.size() > 1)
    ranks.reduce(std::span<Number>(&number, 1), how);
  return static_cast<T>(number);
}

/// @brief Sum over the ranks.
template <class T>
T total(Ranks& ranks, T value)
{
  return reduced(ranks, value, Reduction::sum);
}

/// @brief Largest of the ranks' numbers.
template <class T>
T largest(Ranks& ranks, T value)
{
  return reduced(ranks, value, Reduction::largest);
}

/// @brief Smallest of the ranks' numbers.
template <class T>
T least(Ranks& ranks, T value)
{
  return reduced(ranks, value, Reduction::least);
}

/// @brief True on all ranks if a condition holds on any of them.
inline bool anywhere(Ranks& ranks, bool value)
{
  return largest<std::int64_t>(ranks, value) != 0;
}

/// @brief True on all ranks if a condition holds on all of them.
inline bool everywhere(Ranks& ranks, bool value)
{
  return least<std::int64_t>(ranks, value) != 0;
}

/// @brief Values as bytes.
template <class T>
void pack(std::vector<std::byte>& bytes, std::span<const T> values)
{
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t at = bytes.size();
  bytes.resize(at + values.size_bytes());
  if (not values.empty())
    std::memcpy(bytes.data() + at, values.data(), values.size_bytes());
}

/// @brief Take values from the front of bytes.
/// @param[in,out] bytes Bytes that are left.
/// @param[in] count Number of values.
/// @throws std::invalid_argument if there are not that many.
template <class T>
std::vector<T> unpack(std::span<const std::byte>& bytes, std::size_t count)
{
  static_assert(std::is_trivially_copyable_v<T>);
  if (count > bytes.size() / sizeof(T))
    throw std::invalid_argument("a message of another rank is too short");
  std::vector<T> values(count);
  if (count > 0)
    std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  bytes = bytes.subspan(count * sizeof(T));
  return values;
}

/// @brief Values of all ranks, one rank's after the other's; for few of them.
template <class T>
std::vector<T> gathered(Ranks& ranks, std::span<const T> values)
{
  static_assert(std::is_trivially_copyable_v<T>);
  if (ranks.size() == 1)
    return {values.begin(), values.end()};
  const std::vector<std::byte> all = ranks.gather(std::as_bytes(values));
  std::span<const std::byte> left = all;
  return unpack<T>(left, all.size() / sizeof(T));
}

/// @brief Sum of a count over the ranks before this one.
/// @param[in] ranks The ranks, all of which take part.
/// @param[in] count Number of this rank.
inline std::int64_t total_before(Ranks& ranks, std::int64_t count)
{
  const auto counts = gathered(ranks, std::span<const std::int64_t>(&count, 1));
  return std::accumulate(counts.begin(), counts.begin() + ranks.rank(),
                         std::int64_t(0));
}

/// @brief Nodes of this rank: those that it owns, then those of other ranks
/// that it has, the bulk's ghosts and what contact has added.
///
/// All ranks must take part in `forward` and `reverse`.
class NodeMap
{
public:
  virtual ~NodeMap() = default;

  /// @brief The ranks.
  virtual Ranks& ranks() const = 0;

  /// @brief Number of nodes that this rank owns.
  virtual std::int32_t num_owned() const = 0;

  /// @brief Number of all nodes on this rank.
  virtual std::int32_t num_nodes() const = 0;

  /// @brief Give nodes of other ranks the values of their owners.
  /// @param[in,out] values Values of all nodes, of which those of owned nodes
  /// count (shape=(num_nodes, width)), row-major.
  /// @param[in] width Values a node.
  virtual void forward(std::span<double> values, int width) const = 0;

  /// @copydoc forward
  virtual void forward(std::span<std::int64_t> values, int width) const = 0;

  /// @brief Add what all ranks have for a node on its owner.
  /// @param[in,out] values Values of all nodes; those of owned nodes become
  /// sums, the others mean nothing then (shape=(num_nodes, width)), row-major.
  /// @param[in] width Values a node.
  virtual void reverse(std::span<double> values, int width) const = 0;

  /// @brief Call a function on all ranks whenever the nodes have changed.
  /// @param[in] observer The function.
  /// @return The observer: it is not called any more once this is gone.
  [[nodiscard]] std::shared_ptr<const void>
  on_change(std::function<void()> observer) const;

protected:
  /// @brief Call the observers of changes, in order; collective.
  void notify() const;

private:
  using Observer = std::function<void()>;
  mutable std::vector<std::weak_ptr<const Observer>> _observers;
};

/// @brief Nodes of one rank alone.
class SerialNodes final : public NodeMap
{
public:
  /// @brief Create the map.
  /// @param[in] num_nodes Number of nodes.
  explicit SerialNodes(std::int32_t num_nodes) : _num_nodes(num_nodes) {}

  Ranks& ranks() const override { return _ranks; }
  std::int32_t num_owned() const override { return _num_nodes; }
  std::int32_t num_nodes() const override { return _num_nodes; }
  void forward(std::span<double>, int) const override {}
  void forward(std::span<std::int64_t>, int) const override {}
  void reverse(std::span<double>, int) const override {}

private:
  mutable OneRank _ranks;
  std::int32_t _num_nodes;
};
} // namespace contactx::mesh
