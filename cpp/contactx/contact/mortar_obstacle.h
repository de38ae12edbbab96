// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "obstacle_pairs.h"

namespace contactx::contact
{
/// @brief kernel::Pairs of slave facets with a rigid obstacle.
///
/// The gap and the normal at points of each facet are integrated with the dual
/// functions; the force of a slave node acts on itself alone, along its mean
/// normal. Slip, and which nodes are in reach, are those of the nodes.
///
/// The rules are exact for the product of two shape functions and a gap of
/// constant curvature.
class MortarObstacle final : public ObstacleMaster
{
public:
  /// @brief Create the pairs, none yet; the arguments are those of
  /// ObstacleMaster.
  /// @throws std::invalid_argument also where a slave facet has no area.
  MortarObstacle(std::shared_ptr<geometry::Obstacle> obstacle,
                 std::shared_ptr<const SlaveNodes> slaves,
                 std::span<const double> x, int gdim, double reach,
                 bool measures_slip);

  bool integrates() const override { return true; }
  void nodes_changed() override;
  std::int32_t search(std::span<const double> x,
                      std::span<const std::int8_t> closed) override;

  /// @copydoc Master::set_front_facets; the others are not integrated
  void set_front_facets(std::span<const std::int8_t> faces) override;

  /// @copydoc Master::mobility; a node that is held may move along an axis that
  /// is inclined
  Mobility mobility(std::span<const std::int8_t> free) const override;

  /// @copydoc Master::pairs; of slave facets of one kind
  std::vector<kernel::Pairs> pairs() const override;

  /// @copydoc Master::update; frozen, the gap is linear in the displacement
  /// since the search
  std::optional<std::vector<kernel::Pairs>>
  update(std::span<const double> x, bool frozen,
         std::span<const double> offset) override;

  /// @copydoc Master::origin; where the obstacle has carried the points that
  /// slip is measured from
  std::vector<double> origin() const override;
  std::vector<Saved> save() const override;
  void load(const std::vector<Saved>& saved) override;

private:
  /// Slave facets with k nodes each, and a rule of q points.
  struct Kind
  {
    int k = 0, q = 0;
    std::vector<double> N;             ///< shape functions (shape=(q, k))
    std::vector<std::int32_t> corners; ///< of facets' nodes in the list of all
    /// kernel::Weights of the dual functions at the points, by reference area
    /// (shape=(m, k, q))
    std::vector<double> weight;
  };

  /// Rule and dual functions of the facets with as many nodes as F has.
  template <class F>
  void add_kind(std::span<const double> x);

  /// The kernels measure it by themselves.
  void update_slip(std::span<const double>,
                   std::span<const kernel::ObstaclePair>) override
  {
  }

  /// Data of facets that the kernels read (shape=(m, size)).
  std::vector<double> integrate(const Kind& kind, std::span<const double> x);
  std::vector<std::vector<double>> integrate(std::span<const double> x);

  std::vector<kernel::Pairs>
  group(const std::vector<std::vector<double>>& values) const;

  std::vector<Kind> _kinds;
  std::vector<std::int8_t> _faces;
  std::vector<std::vector<double>> _values;
  std::vector<double> _positions;
  std::vector<double> _points; // scratch
  geometry::Geometry _there;   // scratch
};
} // namespace contactx::contact
