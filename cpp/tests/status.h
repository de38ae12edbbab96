// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>

namespace contactx::tests
{
/// Status of slave nodes as the laws have it
inline constexpr std::int8_t open = 0, stick = 1, slip = 2;
} // namespace contactx::tests
