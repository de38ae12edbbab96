// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <stdexcept>

namespace contactx::solve
{
/// @brief The residual or the Jacobian of the bodies is not finite: the step
/// does not converge, but a shorter one may. A host throws it on all ranks.
class NotFinite : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
} // namespace contactx::solve
