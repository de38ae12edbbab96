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
/// @brief Displacements by rigid motions of bodies at owned dofs.
///
/// Motions are kept with the bodies that they move alone: many loose bodies
/// have as many times six motions, each of which is zero nearly everywhere. All
/// ranks must have the same parts, and take part in what is collective.
class MotionFields
{
public:
  /// @brief Motions that move the same bodies.
  struct Part
  {
    std::vector<Eigen::Index> motions; ///< their numbers
    std::vector<Eigen::Index> dofs;    ///< owned dofs of the bodies
    Eigen::MatrixXd by;                ///< shape=(motions.size(), dofs.size())
  };

  /// @brief Take motions.
  /// @param[in] ranks The ranks.
  /// @param[in] parts Each motion in one of them; their numbers are from 0 on.
  MotionFields(mesh::Ranks& ranks, std::vector<Part> parts);

  /// @brief Number of motions.
  Eigen::Index size() const { return _size; }

  /// @brief The parts.
  const std::vector<Part>& parts() const { return _parts; }

  /// @brief Keep dofs where they are.
  /// @param[in] markers Not zero at these (shape=(num_owned * gdim)).
  void fix(std::span<const std::int8_t> markers);

  /// @brief Work of forces on the motions; collective.
  /// @param[in] forces Those at owned dofs first (shape=(>= num_owned * gdim)).
  /// @return shape=(size()).
  Eigen::VectorXd work(std::span<const double> forces) const;

  /// @brief Part of displacements that is a combination of the motions;
  /// collective.
  /// @param[in] u Those of owned dofs first (shape=(>= num_owned * gdim)).
  /// @return How much of each motion (shape=(size())).
  /// @throws std::domain_error if the motions are not independent.
  Eigen::VectorXd part_of(std::span<const double> u) const;

  /// @brief Displacements by a combination of the motions.
  /// @param[in] motion How much of each (shape=(size())).
  /// @param[in] n Number of owned dofs.
  /// @return shape=(n).
  std::vector<double> displacements(const Eigen::VectorXd& motion,
                                    std::size_t n) const;

  /// @brief Add up a symmetric matrix of each part over the ranks; collective.
  /// @param[in,out] grams A rank's share of each (shape=(parts().size())).
  void sum_up(std::vector<Eigen::MatrixXd>& grams) const;

private:
  mesh::Ranks* _ranks;
  std::vector<Part> _parts;
  Eigen::Index _size = 0;
};

/// @brief Combination of motions with so much work, by their symmetric matrix.
/// @throws std::domain_error if the motions are not independent.
Eigen::VectorXd combined(const Eigen::MatrixXd& gram,
                         const Eigen::VectorXd& work);
} // namespace contactx::solve
