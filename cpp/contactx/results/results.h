// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../geometry/nodal.h"
#include "../math/vec.h"
#include "recovery.h"
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// @brief What users see of a contact: tractions, gaps, status, slip, and the
/// forces that are in balance with them.
namespace contactx::results
{
/// @brief Sums and extremes of a contact over all ranks.
struct Totals
{
  std::int64_t closed = 0;     ///< number of slave nodes in contact
  std::int64_t slipping = 0;   ///< those of the status slip
  double area = 0;             ///< reference area of those in contact
  double largest_pressure = 0; ///< recovered, at least 0
  double smallest_gap = 0;     ///< NaN where no node has a pair
  double dissipation = 0;      ///< work of friction so far, an energy
};

/// @brief Results of a contact at its slave nodes, as of the last update.
///
/// Arrays are those of the owned slave nodes, of which there are n, row-major;
/// num_owned is the number of the bulk's nodes that this rank owns. Before the
/// first update there are no gaps, and nothing is in contact. A copy keeps what
/// results are now, to return to by assignment bit for bit; copies are of the
/// same contact. All ranks must call the constructor and what is called
/// collective.
class Results
{
public:
  /// @brief Find the neighbours of slave nodes, by which tractions are
  /// recovered.
  /// @param[in] contact The contact.
  /// @throws std::invalid_argument if it is null.
  explicit Results(std::shared_ptr<const contact::Contact> contact);

  /// @brief Evaluate all results for the state of now, an accepted one;
  /// collective.
  void update();

  /// @brief Geometric dimension.
  int gdim() const { return _contact->halo().gdim(); }

  /// @brief Pressures, force/area, recovered from the multipliers, see
  /// Recovery; zero at open nodes (shape=(n)).
  const std::vector<double>& pressure() const { return _pressure; }

  /// @brief Tractions that the master exerts, force/area, recovered
  /// (shape=(n, gdim)).
  const std::vector<double>& traction() const { return _traction; }

  /// @brief Means of the pressure at the nodes of the master, zero elsewhere
  /// and of a rigid obstacle (shape=(num_owned)).
  const std::vector<double>& master_pressure() const
  {
    return _master_pressure;
  }

  /// @brief Gaps, lengths, NaN where there is no pair; at nodes without an area
  /// the mean of their neighbours' (shape=(n)).
  const std::vector<double>& gap() const { return _gap; }

  /// @brief Status, see law::Status: 0 open, 1 stick or tied, 2 slip or
  /// frictionless in contact (shape=(n)).
  const std::vector<std::int8_t>& status() const { return _status; }

  /// @brief Slip increments of the last step, lengths; zero where slip is not
  /// measured (shape=(n, gdim)).
  const std::vector<double>& slip() const { return _slip; }

  /// @brief Accumulated lengths of slip (shape=(n)).
  const std::vector<double>& slip_total() const { return _slip_total; }

  /// @brief Force on the slave side of all ranks, zero behind its gdim
  /// components. In self-contact it is that on the nodes in contact, as no node
  /// is on both sides then.
  const Vector<3>& force() const { return _force; }

  /// @brief Sum of the forces on both sides, zero but for round-off. A rigid
  /// obstacle carries what it takes.
  const Vector<3>& imbalance() const { return _imbalance; }

  /// @brief By how much the recovered tractions change the force, over the sum
  /// of the nodes' forces.
  double recovery_change() const { return _recovery_change; }

  /// @brief True in a plane model whose weight is 2 pi r, or another multiple
  /// of a radius that varies: forces around the axis have no moment.
  bool is_axisymmetric() const { return _is_axisymmetric; }

  /// @brief Moment of the forces on the slave side of all ranks, force times
  /// length, which act where the slave nodes were at the update; collective.
  /// @param[in] point The point that it is about, of gdim coordinates.
  /// @return The moment; in 2D its last component, positive counter-clockwise.
  /// @throws std::invalid_argument if the point has other coordinates, or they
  /// are not finite.
  /// @throws std::logic_error if the model is axisymmetric.
  Vector<3> moment(std::span<const double> point) const;

  /// @brief Sums over all ranks of the state of now, with the pressure of the
  /// last update; collective.
  /// @param[in] shares What of each owned node counts, as `shares` has it
  /// (shape=(num_owned)); all if empty.
  /// @throws std::invalid_argument on all ranks if there are not as many.
  Totals totals(std::span<const double> shares = {}) const;

  /// @brief What of each node belongs to a part of the surfaces: that of its
  /// reference area; collective.
  ///
  /// Shares of parts that make up the whole sum to one, and so do what is
  /// summed with them.
  /// @param[in] part Facets of the part, of this rank's cells.
  /// @param[in] whole Facets of all of the surfaces, of this rank's cells.
  /// @return Shares of the owned nodes (shape=(num_owned)).
  std::vector<double> shares(const geometry::FacetList& part,
                             const geometry::FacetList& whole) const;

  /// @brief Force of contact on a part of the surfaces, on nodes of the slave
  /// and of the master, of all ranks and for the state of now; collective.
  /// @param[in] shares What of each owned node counts (shape=(num_owned)).
  /// @throws std::invalid_argument on all ranks if there are not as many.
  Vector<3> force(std::span<const double> shares) const;

  /// @brief Moment of this force, which acts where the nodes are now;
  /// collective.
  /// @param[in] point The point that it is about, of gdim coordinates.
  /// @param[in] shares What of each owned node counts (shape=(num_owned)).
  /// @throws std::invalid_argument as `force` and the other `moment` do.
  /// @throws std::logic_error if the model is axisymmetric.
  Vector<3> moment(std::span<const double> point,
                   std::span<const double> shares) const;

  /// @brief Pressures for the multipliers of now, recovered as `pressure` is;
  /// collective (shape=(n)).
  std::vector<double> recovered_pressure() const;

  /// @brief Values of the slave nodes at the nodes of both surfaces, for the
  /// pairs of now; collective.
  /// @param[in] values Values, NaN where they are unknown (shape=(n)).
  /// @param[in] missing Value where nothing known is in front of a node, and
  /// off the surfaces.
  /// @return At slave nodes the values, at nodes of the master the means of
  /// those in front of them (shape=(num_owned)).
  /// @throws std::invalid_argument if the master is a rigid obstacle, or sizes
  /// do not fit.
  std::vector<double> on_both(std::span<const double> values,
                              double missing) const;

  /// @brief Values of a field on the opposite surface, for the pairs of now;
  /// collective.
  /// @param[in] field Values of the owned nodes (shape=(num_owned)).
  /// @return At slave nodes the master's values in front of them, at nodes of
  /// the master the means of the slave nodes in front of them, elsewhere the
  /// field itself (shape=(num_owned)).
  /// @throws std::invalid_argument as `on_both` does.
  std::vector<double> across(std::span<const double> field) const;

private:
  void measure();
  void sum_forces();
  void recover();
  std::vector<double> assembled() const;
  std::vector<double> nodal_forces(std::vector<double> forces) const;
  Recovered tractions() const;
  std::vector<double> between(std::vector<double> values, int width) const;
  void check_deformable() const;
  Vector<3> check_moment(std::span<const double> point) const;
  std::vector<double> forces_of(std::span<const double> shares) const;

  std::shared_ptr<const contact::Contact> _contact;
  std::shared_ptr<const Recovery> _recovery;
  bool _is_axisymmetric;

  std::vector<double> _pressure, _traction, _master_pressure, _gap;
  std::vector<std::int8_t> _status;
  std::vector<double> _slip, _slip_total;
  Vector<3> _force{}, _imbalance{};
  double _recovery_change = 0;
  // Forces on the slave nodes, and where they act (n, gdim)
  std::vector<double> _on_slave, _at;
};
} // namespace contactx::results
