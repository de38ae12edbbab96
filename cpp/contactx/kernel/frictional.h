// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "registry.h"

namespace contactx::kernel
{
/// @brief Kernels of frictional node-to-surface contact with multipliers.
///
/// With the traction lambda of the slave node and its area A the virtual work
/// is - A lambda . (v_s - sum_l N_l v_l). The slip is the tangential part of
/// the movement relative to the point of the facet that the slave node was
/// over, ds = (I - n n^T) (x_s - sum_l N_l(xi_0) x_l - g_0 n(xi_0)): on a facet
/// it is sum_l (N_l(xi) - N_l(xi_0)) x_l, over a ridge it counts what lies on
/// both of its sides. It is indifferent to rigid motions (T. A. Laursen,
/// Computational Contact and Impact Mechanics, Springer 2002, chapter 5).
std::vector<Entry> frictional();
} // namespace contactx::kernel
