// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "registry.h"

namespace contactx::kernel
{
/// @brief Kernels that tie a slave node to its master with a vector multiplier.
///
/// The constraint is w = x_s - sum_l N_l(xi_0) x_l - g_0 n(xi_0) = 0, with the
/// projection xi_0 and the gap g_0 of the reference: the slave node keeps its
/// place in the facet's frame, which turns. The forces -A lambda . dw are its
/// transposed derivative, so that those of a pair have neither a sum nor a
/// moment, over an open gap too. With small sliding the frame does not turn.
std::vector<Entry> tied();
} // namespace contactx::kernel
