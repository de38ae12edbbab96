// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "text.h"
#include <array>
#include <charconv>
#include <cmath>

namespace
{
/// Text of a number in a format of std::to_chars.
template <class... Format>
std::string text_in(double value, Format... format)
{
  if (std::isnan(value))
    return "nan"; // Without a sign
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                 value, format...);
  return {buffer.data(), end.ptr};
}
} // namespace

std::string contactx::number_text(double value, int digits)
{
  return text_in(value, std::chars_format::general, digits);
}

std::string contactx::exact_text(double value) { return text_in(value); }

std::string contactx::point_text(std::span<const double> x, double size)
{
  std::string text;
  for (const double value : x)
    text += (text.empty() ? "" : ", ")
            + number_text(std::abs(value) < 1e-9 * size ? 0 : value, 6);
  return "(" + text + ")";
}
