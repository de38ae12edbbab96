// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "contact.h"
#include "saved.h"

namespace contactx::contact
{
/// @brief Copy all of a contact that the next step depends on: whether it is
/// switched on, the state of its slave nodes, their slip, and the state of the
/// master, whose names begin with "master_".
///
/// This is the one list of what outlives a step: snapshots and checkpoints
/// follow from it.
/// @param[in] contact The contact.
/// @return Arrays of this rank, of names, shapes and types that never change.
std::vector<Saved> save(const Contact& contact);

/// @brief Go on from what `save` gave for the same contact; collective.
/// @param[in,out] contact The contact.
/// @param[in] saved The arrays.
/// @throws std::invalid_argument on all ranks if an array is missing, of
/// another size or type, or does not fit the master; nothing has changed.
void load(Contact& contact, const std::vector<Saved>& saved);
} // namespace contactx::contact
