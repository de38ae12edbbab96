// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "functions.h"
#include "surface.h"
#include "values.h"
#include <contactx/geometry/obstacle.h>
#include <contactx/results/results.h>

namespace contactx::mesh
{
struct Mesh;
}

namespace contactx_dolfinx
{
using contactx::contact::Method;
using contactx::contact::Sliding;

class ContactForms;
class HaloAdapter;

/// @brief Options of a contact.
struct Options
{
  /// Coulomb's coefficient: a number, a constant or a function, whose values
  /// may change. With nothing along the surface nothing is computed there, with
  /// zero it may become another one
  std::optional<Value> friction = std::nullopt;
  /// Bound of friction in place of Coulomb's: from pressures and accumulated
  /// lengths of slip, with its derivatives
  contactx::law::BoundFunction friction_law = {};
  Method method
      = Method::node_to_surface;     ///< node-to-surface or surface-to-surface
  Sliding sliding = Sliding::finite; ///< whether pairs follow the bodies
  bool tied = false; ///< whether slave nodes keep their place on the master
  /// Largest distance of a pair; the diameter of the larger surface if not
  /// given, unlimited for an obstacle
  std::optional<double> search_distance = std::nullopt;
  Value offset = 0.0; ///< length that is taken off the gap, likewise
  /// Gaps and overlaps of the reference configuration that count as none if
  /// they are at most so large, see contactx::contact::Contact::Options::adjust
  std::optional<double> adjust = std::nullopt;
  /// In self-contact the length along the surface, in the reference
  /// configuration, up to which facets are no masters of a node; see
  /// contactx::search::SelfSight for what it is if not given
  std::optional<double> excluded_distance = std::nullopt;
  /// Whether linear facets stand for smooth surfaces through their nodes, see
  /// contactx::geometry::SmoothFacet
  bool smooth = false;
  /// What contact is integrated with, at reference positions, as the bulk's
  /// forms are: 2 pi r in axisymmetric models, a thickness; 1 if empty
  std::function<double(const contactx::Vector<3>&)> weight = {};
  /// Complementarity factor along the surface as a part of the normal one: what
  /// Newton's method finds does not depend on it, how fast it does
  double tangential_factor = 1;
  /// Name in messages; that of its surfaces if empty
  std::string name = {};
};

/// @brief Contact of a slave surface with a master surface or a rigid obstacle,
/// or of a surface with itself, where slave and master are the same.
///
/// Gaps g >= 0 are positive where it is open, pressures p >= 0 in compression.
/// What it has of slave nodes are rows of those that this rank owns; it exists
/// once the contact belongs to an Assembler. Results are those of the last
/// accepted step, areas and multipliers those of now.
class Contact
{
public:
  /// A deformable or a rigid master
  using Master
      = std::variant<Surface, std::shared_ptr<contactx::geometry::Obstacle>>;

  /// @brief Create a contact.
  /// @param[in] slave Surface whose nodes must not penetrate the master: the
  /// finer or the softer one.
  /// @param[in] master Surface or obstacle that they are measured against.
  /// @param[in] options How it is.
  /// @throws std::invalid_argument if options are out of their range or exclude
  /// each other, or the obstacle is null.
  Contact(Surface slave, Master master, Options options = {});

  /// @brief Make the contact's discrete side; the Assembler does so. All ranks
  /// must take part.
  /// @param[in] mesh The mesh.
  /// @param[in] adapter What its halo asks.
  /// @param[in] prescribed 1 at displacements with a Dirichlet condition, those
  /// of the bulk's nodes (shape=(num_bulk, gdim)).
  /// @param[in] V Space of the displacement.
  /// @throws std::invalid_argument on all ranks if the surfaces do not fit.
  /// @throws std::logic_error if it belongs to an Assembler already.
  std::shared_ptr<contactx::contact::Contact>
  attach(const contactx::mesh::Mesh& mesh,
         std::shared_ptr<const HaloAdapter> adapter,
         std::vector<std::int8_t> prescribed,
         const std::shared_ptr<const FunctionSpace>& V);

  /// @brief Leave the Assembler, which is gone.
  void detach();

  /// @brief Take another coefficient of friction, on all ranks, from the next
  /// iterate on.
  /// @throws std::invalid_argument if the contact was created without one.
  void set_friction(Value friction);

  /// @brief Take another length off the gap, on all ranks, from the next
  /// iterate on.
  void set_offset(Value offset) { _values->set_offset(std::move(offset)); }

  /// @brief Name in messages, once it belongs to an Assembler.
  const std::string& name() const { return _name; }

  /// @brief Friction and offset, as the core reads them.
  const std::shared_ptr<Values>& values() const { return _values; }

  /// @brief The core's side.
  /// @throws std::logic_error if it does not exist yet.
  contactx::contact::Contact& discrete() const;

  /// @brief The same, to keep.
  const std::shared_ptr<contactx::contact::Contact>& shared_discrete() const;

  /// @brief Space of the displacement.
  /// @throws std::logic_error if it belongs to no Assembler yet.
  const FunctionSpace& space() const;

  /// @brief Whether the master is a rigid obstacle.
  bool is_rigid() const { return not std::holds_alternative<Surface>(_master); }

  /// @brief Whether it is a contact of a surface with itself.
  bool is_self() const;

  /// @brief Slave nodes, as the blocks of the displacement's dofs (shape=(n)).
  std::span<const std::int32_t> slave_nodes() const
  {
    return discrete().slaves().owned();
  }

  /// @brief Reference areas, lengths in 2D (shape=(n)).
  std::span<const double> area() const { return discrete().nodes()->area; }

  /// @brief Multipliers, force/reference area, as they were solved for: without
  /// friction pressures (shape=(n)), else tractions on the slave nodes
  /// (shape=(n, gdim)).
  std::span<const double> multiplier() const
  {
    return discrete().nodes()->multiplier;
  }

  /// @brief All results, those of the last accepted step.
  /// @throws std::logic_error if there are none yet.
  const contactx::results::Results& results() const;

  /// @brief Pressures, force/area, recovered from the multipliers, see
  /// contactx::results::Recovery (shape=(n)).
  std::span<const double> pressure() const { return results().pressure(); }

  /// @brief Tractions that the master exerts, force/area, recovered in the same
  /// way (shape=(n, gdim)).
  std::span<const double> traction() const { return results().traction(); }

  /// @brief Means of the pressure at the nodes of the master, zero elsewhere
  /// (shape=(number of the displacement's nodes that this rank owns)).
  std::span<const double> master_pressure() const
  {
    return results().master_pressure();
  }

  /// @brief Gaps, lengths, NaN where there is no pair (shape=(n)).
  std::span<const double> gap() const { return results().gap(); }

  /// @brief Status, see contactx::law::Status: 0 open, 1 stick or tied, 2 slip
  /// or frictionless in contact (shape=(n)).
  std::span<const std::int8_t> status() const { return results().status(); }

  /// @brief Slip increments of the last step, lengths, zero where there is no
  /// friction (shape=(n, gdim)).
  std::span<const double> slip() const { return results().slip(); }

  /// @brief Accumulated lengths of slip (shape=(n)).
  std::span<const double> slip_total() const { return results().slip_total(); }

  /// @brief Force on the slave side of all ranks (shape=(gdim)), zero behind
  /// that.
  contactx::Vector<3> force() const { return results().force(); }

  /// @brief Moment of the forces on the slave side of all ranks, which must
  /// take part; in 2D its last component, positive counter-clockwise.
  /// @param[in] point The point that it is about (shape=(gdim)).
  /// @throws std::invalid_argument if the point is not finite.
  /// @throws std::logic_error if the model is axisymmetric.
  contactx::Vector<3> moment(const contactx::Vector<3>& point) const;

  /// @brief Sums and extremes over all ranks, which must take part.
  contactx::results::Totals totals() const { return results().totals(); }

  /// @brief The results as functions of DOLFINx, which follow the accepted
  /// steps from the first call on. All ranks must take part.
  const Functions& functions();

  /// @brief Residual and Jacobian of the contact as forms of DOLFINx; all ranks
  /// must take part.
  ///
  /// They are made at the first call, and anew where pairs have changed since.
  /// They read the state as it is at the last call: ask again after each
  /// `settle` or `update`.
  /// @return The forms, always the same object.
  /// @throws std::logic_error if it belongs to no Assembler yet.
  const ContactForms& forms();

  /// @brief The results as the core's driver of a step updates them.
  const std::shared_ptr<contactx::results::Results>& shared_results() const
  {
    return _results;
  }

  /// @brief Copy the results to the functions, where these are asked for; the
  /// Assembler does so. All ranks must take part.
  void show();

private:
  void make(const contactx::mesh::Mesh& mesh,
            std::vector<std::int8_t> prescribed,
            const std::shared_ptr<const FunctionSpace>& V);

  Surface _slave;
  Master _master;
  Options _options;
  std::string _name;
  std::shared_ptr<Values> _values;
  std::shared_ptr<contactx::contact::Contact> _discrete;
  std::shared_ptr<contactx::results::Results> _results;
  std::shared_ptr<const FunctionSpace> _V;
  std::shared_ptr<const HaloAdapter> _adapter;
  std::unique_ptr<Functions> _functions;
  std::shared_ptr<ContactForms> _forms;
};
} // namespace contactx_dolfinx
