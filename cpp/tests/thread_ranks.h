// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "expect.h"
#include <algorithm>
#include <condition_variable>
#include <contactx/mesh/halo.h>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

/// @brief Several ranks in one process, each a thread.
namespace contactx::tests
{
/// @brief Where the threads wait for each other, and see what each has.
class Meeting
{
public:
  explicit Meeting(int size) : board(size), _size(size) {}

  int size() const { return _size; }

  /// @brief Wait until all have come here.
  /// @throws std::logic_error if one has left for good.
  void wait()
  {
    std::unique_lock lock(_mutex);
    const int turn = _turn;
    if (++_waiting == _size)
    {
      _waiting = 0;
      ++_turn;
      _changed.notify_all();
      return;
    }
    _changed.wait(lock, [&] { return turn != _turn or _left; });
    if (turn == _turn)
      throw std::logic_error("another rank has left");
  }

  /// @brief Wait no more, and let nobody wait for this one.
  void leave()
  {
    const std::lock_guard lock(_mutex);
    _left = true;
    _changed.notify_all();
  }

  std::vector<const void*> board; ///< What each rank shows to the others

private:
  int _size, _waiting = 0, _turn = 0;
  bool _left = false;
  std::mutex _mutex;
  std::condition_variable _changed;
};

/// @brief A rank of several.
class ThreadRanks final : public mesh::Ranks
{
public:
  ThreadRanks(Meeting& meeting, int rank) : _meeting(meeting), _rank(rank) {}

  int rank() const override { return _rank; }
  int size() const override { return _meeting.size(); }
  void reduce(std::span<double> values, mesh::Reduction how) override
  {
    reduce_all(values, how);
  }
  void reduce(std::span<std::int64_t> values, mesh::Reduction how) override
  {
    reduce_all(values, how);
  }

  std::vector<std::byte> gather(std::span<const std::byte> mine) override
  {
    std::vector<std::byte> all;
    show(mine, [&](int, std::span<const std::byte> theirs)
         { all.insert(all.end(), theirs.begin(), theirs.end()); });
    return all;
  }

  mesh::Messages exchange(const mesh::Messages& outgoing) override
  {
    ++num_exchanges;
    mesh::Messages incoming;
    show(outgoing,
         [&](int rank, const mesh::Messages& theirs)
         {
           if (const auto at = theirs.find(_rank); at != theirs.end())
             incoming[rank] = at->second;
         });
    return incoming;
  }

  /// @brief Show something to all ranks, and see what they show, rank by rank.
  template <class T, class See>
  void show(const T& mine, See&& see)
  {
    _meeting.board[_rank] = &mine;
    _meeting.wait();
    for (int r = 0; r < size(); ++r)
      see(r, *static_cast<const T*>(_meeting.board[r]));
    _meeting.wait();
  }

  int num_exchanges = 0;

private:
  template <class T>
  void reduce_all(std::span<T> values, mesh::Reduction how)
  {
    std::vector<T> all(values.size());
    show(values,
         [&](int rank, std::span<T> theirs)
         {
           for (std::size_t i = 0; i < all.size(); ++i)
             all[i] = rank == 0                     ? theirs[i]
                      : how == mesh::Reduction::sum ? all[i] + theirs[i]
                      : how == mesh::Reduction::least
                          ? std::min(all[i], theirs[i])
                          : std::max(all[i], theirs[i]);
         });
    std::ranges::copy(all, values.begin());
  }

  Meeting& _meeting;
  int _rank;
};

/// @brief Do work(ranks) on several ranks, and throw what one of them throws.
template <class Work>
void on_ranks(int size, Work work)
{
  Meeting meeting(size);
  std::vector<std::exception_ptr> errors(size);
  std::vector<std::thread> threads;
  for (int r = 0; r < size; ++r)
    threads.emplace_back(
        [&, r]
        {
          ThreadRanks ranks(meeting, r);
          try
          {
            work(ranks);
          }
          catch (...)
          {
            errors[r] = std::current_exception();
          }
          // Whoever waits for this one then fails instead of waiting for ever
          meeting.leave();
        });
  for (std::thread& thread : threads)
    thread.join();
  // What made the others leave comes first
  for (const bool last : {false, true})
    for (const std::exception_ptr& error : errors)
      if (error)
        try
        {
          std::rethrow_exception(error);
        }
        catch (const std::logic_error& e)
        {
          if (last or std::string(e.what()) != "another rank has left")
            throw;
        }
}

/// @brief What work(ranks) throws on all ranks; empty if nothing.
/// @throws std::logic_error if ranks do not throw the same.
template <class Work>
std::string said_on(int size, Work work)
{
  std::vector<std::string> texts(size);
  on_ranks(size, [&](ThreadRanks& ranks)
           { texts[ranks.rank()] = refusal([&] { work(ranks); }); });
  for (const std::string& text : texts)
    if (text != texts[0])
      throw std::logic_error("one rank says " + texts[0] + ", another one "
                             + text);
  return texts[0];
}

/// @brief Nodes of a rank, by the numbers that all ranks know.
class NumberedNodes final : public mesh::NodeMap
{
public:
  /// @brief Take nodes by their numbers, of which the first ones are owned.
  NumberedNodes(mesh::Ranks& ranks, std::vector<std::int64_t> numbers,
                std::int32_t num_owned)
      : _ranks(dynamic_cast<ThreadRanks*>(&ranks)),
        _numbers(std::move(numbers)), _num_owned(num_owned)
  {
  }

  mesh::Ranks& ranks() const override { return *_ranks; }
  std::int32_t num_owned() const override { return _num_owned; }
  std::int32_t num_nodes() const override
  {
    return static_cast<std::int32_t>(_numbers.size());
  }
  const std::vector<std::int64_t>& numbers() const { return _numbers; }

  /// @brief Have nodes of other ranks, after the first ones of now.
  void set_ghosts(std::size_t first, std::span<const std::int64_t> numbers)
  {
    _numbers.resize(first);
    _numbers.insert(_numbers.end(), numbers.begin(), numbers.end());
    notify();
  }

  void forward(std::span<double> values, int width) const override
  {
    forward_all(values, width);
  }
  void forward(std::span<std::int64_t> values, int width) const override
  {
    forward_all(values, width);
  }

  void reverse(std::span<double> values, int width) const override
  {
    const auto mine = places(0, _num_owned);
    std::vector<double> sums(mine.size() * width, 0.0);
    _ranks->show(std::pair(std::span(_numbers), values),
                 [&](int, const auto& theirs)
                 {
                   const auto& [numbers, all] = theirs;
                   for (std::size_t i = 0; i < numbers.size(); ++i)
                     if (const auto at = mine.find(numbers[i]);
                         at != mine.end())
                       for (int k = 0; k < width; ++k)
                         sums[at->second * width + k] += all[i * width + k];
                 });
    std::ranges::copy(sums, values.begin());
  }

private:
  std::map<std::int64_t, std::size_t> places(std::size_t begin,
                                             std::size_t end) const
  {
    std::map<std::int64_t, std::size_t> result;
    for (std::size_t i = begin; i < end; ++i)
      result[_numbers[i]] = i;
    return result;
  }

  template <class T>
  void forward_all(std::span<T> values, int width) const
  {
    const auto ghosts = places(_num_owned, _numbers.size());
    std::vector<T> found(values.begin(), values.end());
    _ranks->show(std::pair(std::span(_numbers).first(_num_owned), values),
                 [&](int, const auto& theirs)
                 {
                   const auto& [numbers, all] = theirs;
                   for (std::size_t i = 0; i < numbers.size(); ++i)
                     if (const auto at = ghosts.find(numbers[i]);
                         at != ghosts.end())
                       std::copy_n(all.begin() + i * width, width,
                                   found.begin() + at->second * width);
                 });
    std::ranges::copy(found, values.begin());
  }

  ThreadRanks* _ranks;
  std::vector<std::int64_t> _numbers;
  std::int32_t _num_owned;
};

/// @brief A bulk whose nodes all ranks know by their numbers.
class NumberedBulk : public mesh::HaloAdapter
{
public:
  NumberedBulk(mesh::Ranks& ranks, std::vector<std::int64_t> numbers,
               std::int32_t num_owned)
      : _map(ranks, std::move(numbers), num_owned)
  {
  }

  mesh::Ranks& ranks() override { return _map.ranks(); }
  void forward(std::span<double> values, int width) override
  {
    _map.forward(values, width);
  }
  void forward(std::span<std::int64_t> values, int width) override
  {
    _map.forward(values, width);
  }
  void reverse(std::span<double> values, int width) override
  {
    _map.reverse(values, width);
  }

protected:
  NumberedNodes _map;
};
} // namespace contactx::tests
