// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/check.h>

namespace contactx_bindings
{
namespace check = contactx::check;
} // namespace contactx_bindings
