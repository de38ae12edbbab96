// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/bodies.h"
#include "bulk.h"
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace contactx::solve
{
/// @brief Number of rigid modes of a body, 3 in 2D and 6 in 3D.
constexpr int num_modes(int gdim) { return gdim * (gdim + 1) / 2; }

/// @brief Rigid modes at a point: translations, then rotations about the
/// origin.
/// @param[in] d The point (shape=(gdim)).
/// @param[out] modes Displacements (shape=(gdim, m)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
void rigid_modes(const double* d, double* modes, int gdim);

/// @brief Rigid modes of the bodies, and those that supports leave free.
///
/// A mode is a field of displacements of all nodes of one body, its largest
/// value about 1. It is kept as m coefficients: translations, then rotations
/// about the body's middle over its radius. All but displacements is the same
/// on all ranks, and bodies are in the order of their names.
class RigidModes
{
public:
  /// @brief Find the free modes; collective.
  /// @param[in] bodies Bodies of the mesh.
  /// @param[in] bulk The bulk.
  /// @param[in] x Positions at the start (shape=(num_nodes, gdim)).
  /// @throws std::invalid_argument on all ranks if an array does not fit.
  RigidModes(std::shared_ptr<const mesh::Bodies> bodies, Bulk& bulk,
             std::span<const double> x);

  /// @brief Find the free modes in another configuration; collective. If the
  /// bulk throws, they stay those of before.
  /// @param[in] bulk The bulk.
  /// @param[in] x Positions (shape=(num_nodes, gdim)).
  /// @throws std::invalid_argument on all ranks if an array does not fit.
  void update(Bulk& bulk, std::span<const double> x);

  /// @brief Number of bodies.
  std::size_t count() const { return _radius.size(); }

  /// @brief Geometric dimension.
  int gdim() const { return _gdim; }

  /// @brief Modes a body.
  int modes_per_body() const { return num_modes(_gdim); }

  /// @brief Radius of the largest body.
  double size() const;

  /// @brief Radius of a body.
  double radius(std::size_t body) const { return _radius[body]; }

  /// @brief True if any body has a rigid mode that nothing, or little, resists.
  bool any_free() const;

  /// @brief Body of each node (shape=(num_nodes)).
  std::span<const std::int32_t> body() const { return _bodies->number(); }

  /// @brief For each body the modes that neither Dirichlet conditions nor the
  /// bulk's stiffness (springs, elastic supports) resist, as columns of
  /// coefficients.
  const std::vector<Eigen::MatrixXd>& free() const { return _free; }

  /// @brief For each body those that the bulk's stiffness resists by little.
  const std::vector<Eigen::MatrixXd>& weak() const { return _weak; }

  /// @brief That stiffness, for each body.
  const std::vector<std::vector<double>>& stiffness() const
  {
    return _stiffness;
  }

  /// @brief All rigid modes of a node's body at this node.
  /// @param[in] node The node.
  /// @param[in] x Positions of all nodes, reference or current
  /// (shape=(num_nodes, gdim)).
  /// @param[out] modes Displacements (shape=(gdim, m)).
  void at(std::int32_t node, std::span<const double> x, double* modes) const;

  /// @brief Displacement of a node by a rigid motion of its body.
  /// @param[in] node The node.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)).
  /// @param[in] motion How much of each mode (shape=(m)).
  /// @param[in] is_exact Whether distances stay as they are, not in first order
  /// only.
  /// @param[out] by Displacement (shape=(gdim)).
  void move(std::int32_t node, std::span<const double> x, const double* motion,
            bool is_exact, double* by) const;

private:
  struct Resistance;

  void check(Bulk& bulk, std::span<const double> x) const;
  std::vector<double> prescribed(Bulk& bulk, std::span<const double> x) const;
  std::vector<Resistance>
  resistance(Bulk& bulk, std::span<const double> x,
             const std::vector<Eigen::MatrixXd>& motions) const;

  std::shared_ptr<const mesh::Bodies> _bodies;
  int _gdim;
  std::vector<double> _middle, _radius;
  // Whether the bulk's stiffness has ever resisted a motion of a body
  std::vector<std::int8_t> _sprung;
  bool _is_first = true;
  std::vector<Eigen::MatrixXd> _free, _weak;
  std::vector<std::vector<double>> _stiffness;
};

/// @brief Modes of single bodies as modes of all, in columns.
Eigen::MatrixXd by_body(std::span<const Eigen::MatrixXd> bases);
} // namespace contactx::solve
