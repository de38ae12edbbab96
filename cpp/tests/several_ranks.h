// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <algorithm>
#include <barrier>
#include <contactx/parallel/ranks.h>
#include <exception>
#include <functional>
#include <map>
#include <thread>

namespace contactx::tests
{
/// @brief Ranks that are threads of one process.
class SeveralRanks
{
public:
  /// @brief Run a function on some ranks, each in a thread of its own.
  /// @param[in] size Number of ranks.
  /// @param[in] work What they do.
  /// @throws What the first rank that throws does.
  static void run(int size, const std::function<void(parallel::Ranks&)>& work)
  {
    Shared shared(size);
    std::vector<std::exception_ptr> errors(size);
    std::vector<std::thread> threads;
    for (int r = 0; r < size; ++r)
      threads.emplace_back(
          [&, r]
          {
            Rank rank(shared, r);
            try
            {
              work(rank);
            }
            catch (...)
            {
              errors[r] = std::current_exception();
            }
            shared.slots[r] = nullptr;
            shared.barrier.arrive_and_drop();
          });
    for (std::thread& thread : threads)
      thread.join();
    for (const std::exception_ptr& error : errors)
      if (error)
        std::rethrow_exception(error);
  }

private:
  struct Shared
  {
    explicit Shared(int size) : slots(size), barrier(size) {}
    std::vector<const void*> slots;
    std::barrier<> barrier;
  };

  class Rank final : public parallel::Ranks
  {
  public:
    Rank(Shared& shared, int rank) : _shared(shared), _rank(rank) {}
    int rank() const override { return _rank; }
    int size() const override { return static_cast<int>(_shared.slots.size()); }
    void reduce(std::span<double> values, parallel::Reduction how) override
    {
      reduce_any(values, how);
    }
    void reduce(std::span<std::int64_t> values,
                parallel::Reduction how) override
    {
      reduce_any(values, how);
    }
    parallel::Messages exchange(const parallel::Messages& outgoing) override
    {
      parallel::Messages incoming;
      meet(&outgoing,
           [&](int r, const void* theirs)
           {
             const auto& out = *static_cast<const parallel::Messages*>(theirs);
             if (const auto found = out.find(_rank); found != out.end())
               incoming[r] = found->second;
           });
      return incoming;
    }

  private:
    template <class T>
    void reduce_any(std::span<T> values, parallel::Reduction how)
    {
      std::vector<T> result;
      const std::span<const T> mine = values;
      meet(&mine,
           [&](int, const void* theirs)
           {
             const auto& other
                 = *static_cast<const std::span<const T>*>(theirs);
             if (result.empty())
             {
               result.assign(other.begin(), other.end());
               return;
             }
             for (std::size_t i = 0; i < result.size(); ++i)
               result[i] = how == parallel::Reduction::sum
                               ? result[i] + other[i]
                           : how == parallel::Reduction::least
                               ? std::min(result[i], other[i])
                               : std::max(result[i], other[i]);
           });
      std::ranges::copy(result, values.begin());
    }

    /// Look at what all ranks show, in their order.
    template <class F>
    void meet(const void* mine, F look)
    {
      _shared.slots[_rank] = mine;
      _shared.barrier.arrive_and_wait();
      for (int r = 0; r < size(); ++r)
        if (_shared.slots[r])
          look(r, _shared.slots[r]);
      _shared.barrier.arrive_and_wait();
    }

    Shared& _shared;
    int _rank;
  };
};

/// @brief Nodes of one of these ranks, by their numbers among all nodes.
class NumberedNodes final : public parallel::NodeMap
{
public:
  /// @param[in] ranks The ranks.
  /// @param[in] numbers Number of each node on this rank, owned ones first.
  /// @param[in] num_owned How many it owns.
  NumberedNodes(parallel::Ranks& ranks, std::vector<std::int64_t> numbers,
                std::int32_t num_owned)
      : _ranks(ranks), _numbers(std::move(numbers)), _num_owned(num_owned)
  {
  }

  parallel::Ranks& ranks() const override { return _ranks; }
  std::int32_t num_owned() const override { return _num_owned; }
  std::int32_t num_nodes() const override
  {
    return static_cast<std::int32_t>(_numbers.size());
  }
  const std::vector<std::int64_t>& numbers() const { return _numbers; }

  /// @brief Add a node of another rank.
  void add(std::int64_t number)
  {
    _numbers.push_back(number);
    notify();
  }

  void forward(std::span<double> values, int width) const override
  {
    forward_any(values, width);
  }
  void forward(std::span<std::int64_t> values, int width) const override
  {
    forward_any(values, width);
  }
  void reverse(std::span<double>, int) const override
  {
    throw std::logic_error("no test needs this");
  }

private:
  template <class T>
  void forward_any(std::span<T> values, int width) const
  {
    const auto owned
        = std::span<const std::int64_t>(_numbers).first(_num_owned);
    const auto numbers = parallel::gathered(_ranks, owned);
    const auto all = parallel::gathered(
        _ranks, std::span<const T>(values).first(owned.size() * width));
    std::map<std::int64_t, std::size_t> place;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      place[numbers[i]] = i;
    for (std::size_t i = _num_owned; i < _numbers.size(); ++i)
      std::copy_n(&all[place.at(_numbers[i]) * width], width,
                  &values[i * width]);
  }

  parallel::Ranks& _ranks;
  std::vector<std::int64_t> _numbers;
  std::int32_t _num_owned;
};
} // namespace contactx::tests
