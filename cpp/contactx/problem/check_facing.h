// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/deformable_master.h"
#include <string>

namespace contactx::problem
{
/// @brief Check that a slave surface does not face away from all of its master
/// that is in reach; all ranks must take part.
///
/// It may lie beyond the master's outer edge, to slide onto it later, or out of
/// reach.
/// @param[in] halo Nodes of this rank, which may grow.
/// @param[in] slaves Slave nodes.
/// @param[in] slave_name What messages call the slave surface.
/// @param[in] master Master with pairs in the reference configuration.
/// @param[in] master_name What messages call the master surface.
/// @throws std::invalid_argument on all ranks if it does.
void check_facing(const mesh::Halo& halo, const contact::SlaveNodes& slaves,
                  const std::string& slave_name,
                  const contact::DeformableMaster& master,
                  const std::string& master_name);
} // namespace contactx::problem
