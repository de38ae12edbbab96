// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/math/vec.h>
#include <cstdint>
#include <cstring>
#include <limits>

/// @brief What the fuzz targets share. They feed the core what the bindings let
/// through and check what must hold for every input.
namespace contactx::fuzz
{
/// @brief Which numbers an input is made of.
enum class Range
{
  lattice, ///< quarters: exact arithmetic, many coincidences
  plain,   ///< quarters and others, about one in size
  scaled,  ///< plain ones times one power of two up to the contract's limits
  wide,    ///< any that the contract holds for, of mixed size
  any      ///< also NaN, infinity and what overflows: nothing may crash
};

/// @brief Turns bytes into sizes and numbers; zeros follow the last byte.
class Input
{
public:
  /// @brief The first bytes say which numbers follow.
  Input(const std::uint8_t* data, std::size_t size) : _data(data), _left(size)
  {
    _range = static_cast<Range>(below(5));
    if (_range == Range::scaled)
      _scale = std::ldexp(1., 2 * below(150) - 149);
  }

  Range range() const { return _range; }

  /// @brief Whether all is about one size, so that rounding can be told from
  /// error.
  bool even() const { return _range <= Range::scaled; }

  /// @brief Whether the contract holds for all numbers.
  bool finite() const { return _range <= Range::wide; }

  /// @brief The size that numbers are about.
  double scale() const { return _scale; }

  int below(int n) { return n > 0 ? byte() % n : 0; }

  bool flag() { return byte() & 1; }

  /// @brief A number of the range, of a length's size.
  double number() { return _scale * unscaled(); }

  /// @brief A number of the range that has no unit.
  double unscaled()
  {
    const int kind = byte();
    if (_range == Range::lattice or kind < 96)
      return 0.25 * (kind % 17 - 8);
    if (_range <= Range::scaled or kind < 160)
    {
      // The last one again, but for rounding
      if (kind % 8 == 0)
        return _last * (1 + (kind % 5 - 2) * 0x1p-52);
      return _last = raw<std::int32_t>() * 0x1p-30;
    }
    const double mantissa = raw<std::int16_t>() * 0x1p-14;
    if (_range == Range::wide or kind < 224)
      return mantissa * std::pow(10., below(99) - 49);
    constexpr double inf = std::numeric_limits<double>::infinity();
    switch (kind % 8)
    {
    case 0:
      return std::nan("");
    case 1:
      return inf;
    case 2:
      return -inf;
    case 3:
      return std::numeric_limits<double>::max();
    case 4:
      return std::numeric_limits<double>::denorm_min();
    case 5:
      return -0.;
    default:
      return raw<double>();
    }
  }

  /// @brief A number that is not negative.
  double positive() { return std::abs(number()); }

  template <int D>
  Vector<D> vector()
  {
    Vector<D> v;
    for (double& c : v)
      c = number();
    return v;
  }

  /// @brief A vector of length one.
  template <int D>
  Vector<D> unit()
  {
    Vector<D> v;
    for (double& c : v)
      c = below(17) - 8;
    const double length = norm(v);
    if (length > 0)
      return (1 / length) * v;
    v[0] = 1;
    return v;
  }

private:
  std::uint8_t byte() { return raw<std::uint8_t>(); }

  template <class T>
  T raw()
  {
    T value{};
    const std::size_t n = std::min(sizeof(T), _left);
    std::memcpy(&value, _data, n);
    _data += n;
    _left -= n;
    return value;
  }

  const std::uint8_t* _data;
  std::size_t _left;
  Range _range;
  double _scale = 1;
  double _last = 1. / 3;
};
} // namespace contactx::fuzz
