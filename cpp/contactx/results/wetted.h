// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include <memory>
#include <span>
#include <vector>

namespace contactx::results
{
/// @brief Nodes that a fluid wets which spreads along surfaces from where it
/// enters, up to the contacts that are closed; all ranks must take part.
///
/// It goes from node to node along the edges of the facets, of the given ones
/// and of the slave surfaces, and does not enter a slave node in contact, nor
/// one that is tied. A node of a master that has the slave surface in front of
/// it is wetted where that is, so that the fluid ends on both sides at the same
/// place, crosses open gaps from the slave to the master, and goes along no
/// master behind a contact, whichever of both meshes is the finer one. Where
/// nothing is in front of a master it spreads along that as along any surface.
/// In self-contact pairs tell what is in front of a node.
/// @param[in] halo Nodes of this rank.
/// @param[in] facets Facets of this rank's cells that may be wetted, their
/// nodes among those of the bulk.
/// @param[in] is_entry 1 at nodes where the fluid enters, else 0; those off the
/// facets do not count (shape=(num_owned)).
/// @param[in] contacts Contacts on these nodes, as they are now.
/// @return 1 at nodes that are wetted, else 0 (shape=(num_owned)).
/// @throws std::invalid_argument on all ranks if sizes or nodes do not fit, or
/// a contact is null or has nodes of another halo.
std::vector<std::int8_t>
wetted_nodes(const std::shared_ptr<mesh::Halo>& halo,
             const geometry::FacetList& facets,
             std::span<const std::int8_t> is_entry,
             std::span<const std::shared_ptr<const contact::Contact>> contacts);
} // namespace contactx::results
