// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "ranks.h"
#include "../check.h"
#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>

using namespace contactx::mesh;

void Ranks::agree(const std::function<void()>& work)
{
  if (size() == 1)
  {
    work();
    return;
  }
  std::exception_ptr error;
  std::string text;
  // What kind of error: 0 another, 1 of an argument, 2 of an undefined function
  char kind = '0';
  try
  {
    work();
  }
  catch (const check::Undefined& e)
  {
    error = std::current_exception();
    text = e.what();
    kind = '2';
  }
  catch (const std::invalid_argument& e)
  {
    error = std::current_exception();
    text = e.what();
    kind = '1';
  }
  catch (const std::exception& e)
  {
    error = std::current_exception();
    text = e.what();
  }
  catch (...)
  {
    error = std::current_exception();
    text = "an error without a message";
  }
  const int first = least(*this, error ? rank() : size());
  if (first == size())
    return;
  Messages out;
  if (rank() == first)
  {
    const std::string message = kind + text;
    for (int r = 0; r < size(); ++r)
      if (r != first)
        pack(out[r], std::span<const char>(message));
  }
  const Messages in = exchange(out);
  if (rank() == first)
    std::rethrow_exception(error);
  std::span<const std::byte> bytes = in.at(first);
  const auto letters = unpack<char>(bytes, bytes.size());
  const std::string theirs(letters.begin() + 1, letters.end());
  if (letters[0] == '2')
    throw check::Undefined(theirs);
  if (letters[0] == '1')
    throw std::invalid_argument(theirs);
  throw std::runtime_error(theirs);
}

std::shared_ptr<const void>
NodeMap::on_change(std::function<void()> observer) const
{
  std::erase_if(_observers, [](const auto& o) { return o.expired(); });
  const auto kept = std::make_shared<const Observer>(std::move(observer));
  _observers.push_back(kept);
  return kept;
}

void NodeMap::notify() const
{
  for (const auto& observer : _observers)
    if (const auto call = observer.lock())
      (*call)();
}
