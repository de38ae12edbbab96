// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "scene.h"
#include <algorithm>
#include <barrier>
#include <contactx/contact/slave_nodes.h>
#include <memory>
#include <set>
#include <thread>

namespace contactx::tests
{
/// @brief What threads that play ranks share.
struct Team
{
  explicit Team(int num_ranks)
      : size(num_ranks), barrier(num_ranks), reals(num_ranks),
        wholes(num_ranks), messages(num_ranks)
  {
  }

  template <class T>
  std::vector<std::vector<T>>& parts()
  {
    if constexpr (std::is_same_v<T, double>)
      return reals;
    else
      return wholes;
  }

  int size;
  std::barrier<> barrier;
  std::vector<std::vector<double>> reals;
  std::vector<std::vector<std::int64_t>> wholes;
  std::vector<parallel::Messages> messages;
};

/// @brief A rank that is a thread.
class ThreadRank final : public parallel::Ranks
{
public:
  ThreadRank(Team& team, int rank) : _team(team), _rank(rank) {}

  int rank() const override { return _rank; }
  int size() const override { return _team.size; }

  void reduce(std::span<double> values, parallel::Reduction how) override
  {
    reduce_parts(values, how);
  }

  void reduce(std::span<std::int64_t> values, parallel::Reduction how) override
  {
    reduce_parts(values, how);
  }

  parallel::Messages exchange(const parallel::Messages& outgoing) override
  {
    _team.messages[_rank] = outgoing;
    wait();
    parallel::Messages incoming;
    for (int r = 0; r < size(); ++r)
      if (const auto found = _team.messages[r].find(_rank);
          found != _team.messages[r].end())
        incoming[r] = found->second;
    wait();
    return incoming;
  }

  /// @brief Values of all ranks.
  template <class T>
  std::vector<std::vector<T>> all(std::span<const T> values)
  {
    _team.parts<T>()[_rank].assign(values.begin(), values.end());
    wait();
    auto result = _team.parts<T>();
    wait();
    return result;
  }

private:
  void wait() { _team.barrier.arrive_and_wait(); }

  template <class T>
  void reduce_parts(std::span<T> values, parallel::Reduction how)
  {
    const auto parts = all<T>(values);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = parts[0][i];
      for (int r = 1; r < size(); ++r)
        values[i] = how == parallel::Reduction::sum ? values[i] + parts[r][i]
                    : how == parallel::Reduction::least
                        ? std::min(values[i], parts[r][i])
                        : std::max(values[i], parts[r][i]);
    }
  }

  Team& _team;
  int _rank;
};

/// @brief Nodes of a rank that is a thread.
class ThreadNodes final : public parallel::NodeMap
{
public:
  /// @brief Take the nodes.
  /// @param[in] rank The rank.
  /// @param[in] num_owned Number of owned nodes, which come first.
  /// @param[in] numbers Numbers of the nodes on all ranks.
  ThreadNodes(std::shared_ptr<ThreadRank> rank, std::int32_t num_owned,
              std::vector<std::int32_t> numbers)
      : _rank(std::move(rank)), _num_owned(num_owned),
        _numbers(std::move(numbers))
  {
  }

  parallel::Ranks& ranks() const override { return *_rank; }
  std::int32_t num_owned() const override { return _num_owned; }
  std::int32_t num_nodes() const override
  {
    return static_cast<std::int32_t>(_numbers.size());
  }

  void forward(std::span<double> values, int width) const override
  {
    forward_parts(values, width);
  }

  void forward(std::span<std::int64_t> values, int width) const override
  {
    forward_parts(values, width);
  }

  void reverse(std::span<double> values, int width) const override
  {
    const auto sums = rows<double>(values, width, num_nodes());
    for (std::int32_t i = 0; i < _num_owned; ++i)
      std::ranges::copy(sums.at(_numbers[i]), values.begin() + i * width);
  }

private:
  // Sums of the first nodes' rows on all ranks, by the nodes' numbers
  template <class T>
  std::map<std::int32_t, std::vector<T>>
  rows(std::span<const T> values, int width, std::int32_t count) const
  {
    const std::vector<std::int64_t> mine(_numbers.begin(),
                                         _numbers.begin() + count);
    const auto numbers = _rank->all<std::int64_t>(mine);
    const auto parts = _rank->all<T>(values);
    std::map<std::int32_t, std::vector<T>> result;
    for (std::size_t r = 0; r < parts.size(); ++r)
      for (std::size_t i = 0; i < numbers[r].size(); ++i)
      {
        auto& row = result[numbers[r][i]];
        row.resize(width, 0);
        for (int k = 0; k < width; ++k)
          row[k] += parts[r][i * width + k];
      }
    return result;
  }

  template <class T>
  void forward_parts(std::span<T> values, int width) const
  {
    const auto owned = rows<T>(values, width, _num_owned);
    for (std::int32_t i = _num_owned; i < num_nodes(); ++i)
      std::ranges::copy(owned.at(_numbers[i]), values.begin() + i * width);
  }

  std::shared_ptr<ThreadRank> _rank;
  std::int32_t _num_owned;
  std::vector<std::int32_t> _numbers;
};

/// @brief A surface on one of several ranks.
struct Part
{
  Scene scene; ///< facets around the rank's own nodes
  std::shared_ptr<const contact::SlaveNodes> slaves;
  std::vector<std::int32_t> numbers; ///< of the scene's nodes in the whole one
  std::int32_t num_owned;

  /// @brief Rows of the owned slave nodes from those of all slave nodes of the
  /// whole surface, which are all of its nodes.
  template <class T>
  std::vector<T> take(const std::vector<T>& values, int width = 1) const
  {
    std::vector<T> result;
    for (std::int32_t i : slaves->owned())
      result.insert(result.end(), values.begin() + numbers[i] * width,
                    values.begin() + (numbers[i] + 1) * width);
    return result;
  }
};

/// @brief Part of a surface that a rank has.
/// @param[in] whole The surface.
/// @param[in] owner Rank of each node.
/// @param[in] rank The rank.
inline Part part_of(const Scene& whole, const std::vector<int>& owner,
                    std::shared_ptr<ThreadRank> rank)
{
  Part part{Scene(whole.gdim), nullptr, {}, 0};
  const facet::FacetList facets = whole.facets();
  std::set<std::int32_t> others;
  std::vector<std::int32_t> here;
  for (std::int32_t f = 0; f < facets.size(); ++f)
    if (std::ranges::any_of(facets[f], [&](std::int32_t node)
                            { return owner[node] == rank->rank(); }))
    {
      here.push_back(f);
      others.insert(facets[f].begin(), facets[f].end());
    }
  for (std::int32_t i = 0; i < std::ssize(owner); ++i)
    if (owner[i] == rank->rank())
    {
      part.numbers.push_back(i);
      others.erase(i);
    }
  part.num_owned = static_cast<std::int32_t>(part.numbers.size());
  part.numbers.insert(part.numbers.end(), others.begin(), others.end());
  for (std::int32_t i : part.numbers)
    part.scene.node(whole.point(i));
  Scene own(whole.gdim);
  for (std::int32_t f : here)
  {
    std::vector<std::int32_t> nodes;
    for (std::int32_t node : facets[f])
      nodes.push_back(static_cast<std::int32_t>(
          std::ranges::find(part.numbers, node) - part.numbers.begin()));
    part.scene.facet(nodes);
    if (owner[facets[f].front()] == rank->rank())
      own.facet(nodes);
  }
  part.slaves = std::make_shared<contact::SlaveNodes>(
      std::make_shared<ThreadNodes>(rank, part.num_owned, part.numbers),
      part.scene.facets(), own.facets());
  return part;
}

/// @brief Do something on several ranks at once, each of which is a thread.
/// @param[in] size Number of ranks.
/// @param[in] work Called with each rank.
template <class Work>
void on_ranks(int size, Work work)
{
  Team team(size);
  std::vector<std::thread> threads;
  for (int r = 0; r < size; ++r)
    threads.emplace_back([&team, &work, r]
                         { work(std::make_shared<ThreadRank>(team, r)); });
  for (std::thread& thread : threads)
    thread.join();
}
} // namespace contactx::tests
