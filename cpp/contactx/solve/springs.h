// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/ranks.h"
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace contactx::solve
{
/// @brief Springs at as many dofs as there are modes, where they are most
/// independent: they are statically determinate.
///
/// All ranks must take part; on any number of ranks the springs are at the
/// same dofs, whatever basis of the modes is given.
/// @param[in] ranks The ranks.
/// @param[in] field Displacements by orthonormal combinations of modes at owned
/// dofs, which are its columns (shape=(k, num_owned * gdim)).
/// @param[in] prescribed 1 at dofs that are prescribed and take no spring
/// (shape=(num_owned * gdim)).
/// @param[in] diagonal Stiffness that springs have a part of, force/length
/// (shape=(num_owned * gdim)).
/// @param[in] original Number of each node in the mesh as it was made, of which
/// those of owned nodes count.
/// @param[in] gdim Geometric dimension.
/// @return Stiffness, force/length (shape=(num_owned * gdim)).
/// @throws std::invalid_argument on all ranks if the sizes do not fit on one.
std::vector<double> independent_springs(mesh::Ranks& ranks,
                                        const Eigen::MatrixXd& field,
                                        std::span<const std::int8_t> prescribed,
                                        std::span<const double> diagonal,
                                        std::span<const std::int64_t> original,
                                        int gdim);
} // namespace contactx::solve
