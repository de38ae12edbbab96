// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "bulk.h"
#include "functions.h"
#include "surface.h"
#include <contactx/obstacle/obstacle.h>
#include <contactx/problem/values.h>
#include <contactx/reference/facing.h>
#include <contactx/reference/shared_nodes.h>
#include <contactx/reference/sides.h>
#include <functional>
#include <optional>
#include <variant>

namespace contactx::dolfinx
{
using contact::Sliding;
using reference::Method;

/// @brief Options of a contact.
struct Options
{
  /// Coulomb's coefficient; with nothing along the surface nothing is computed
  /// there, with zero it may become another one
  std::optional<double> friction = std::nullopt;
  Method method
      = Method::node_to_surface;     ///< node-to-surface or surface-to-surface
  Sliding sliding = Sliding::finite; ///< whether pairs follow the bodies
  bool tied = false; ///< whether slave nodes keep their place on the master
  /// Largest distance of a pair; the diameter of the larger surface if not
  /// given, unlimited for an obstacle
  std::optional<double> search_distance = std::nullopt;
  double offset = 0; ///< length that is taken off the gap
  /// Gaps and overlaps of the reference configuration that count as none if
  /// they are at most so large, see contact::Contact::Options::adjust
  std::optional<double> adjust = std::nullopt;
  /// In self-contact the length along the surface, in the reference
  /// configuration, up to which facets are no masters of a node; see
  /// search::SelfSight for what it is if not given
  std::optional<double> excluded_distance = std::nullopt;
  /// Whether linear facets stand for smooth surfaces through their nodes, see
  /// facet::SmoothFacet
  bool smooth = false;
  /// What contact is integrated with, at reference positions, as the bulk's
  /// forms are: 2 pi r in axisymmetric models, a thickness; 1 if empty
  std::function<double(const Vector<3>&)> weight = {};
};

/// @brief Friction and offset of a contact, the same at all nodes.
struct Values final : problem::Values
{
  bool vary() const override { return true; }
  std::optional<std::vector<double>> friction() override
  {
    if (not coefficient)
      return std::nullopt;
    return std::vector<double>(num_nodes, *coefficient);
  }
  std::vector<double> offset() override
  {
    if (not std::isfinite(length))
      throw std::invalid_argument(
          "the offset of a contact is not finite: give a finite length");
    return std::vector<double>(num_nodes, length);
  }

  std::size_t num_nodes = 0;         ///< slave nodes of this rank
  std::optional<double> coefficient; ///< Coulomb's, if there is one
  double length = 0;                 ///< that is taken off the gap
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
  using Master = std::variant<Surface, std::shared_ptr<obstacle::Obstacle>>;

  /// @brief Create a contact.
  /// @param[in] slave Surface whose nodes must not penetrate the master: the
  /// finer or the softer one.
  /// @param[in] master Surface or obstacle that they are measured against.
  /// @param[in] options How it is.
  /// @throws std::invalid_argument if it is tied and has friction, or the
  /// obstacle is null.
  Contact(Surface slave, Master master, Options options = {})
      : _slave(std::move(slave)), _master(std::move(master)), _options(options),
        _values(std::make_shared<Values>())
  {
    _values->coefficient = options.friction;
    _values->length = options.offset;
    if (_options.tied and _options.friction)
      throw std::invalid_argument(
          "tied excludes friction: a tied slave node does not slip. Leave "
          "one of them out");
    const auto* obstacle
        = std::get_if<std::shared_ptr<obstacle::Obstacle>>(&_master);
    if (obstacle and *obstacle == nullptr)
      throw std::invalid_argument("the obstacle of a Contact is null: give a "
                                  "Plane, Sphere, Cylinder or LevelSet");
  }

  /// @brief Make the contact's discrete side; the Assembler does so. All ranks
  /// must take part.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] bodies Bodies of the mesh.
  /// @param[in] bulk The bulk.
  /// @param[in] V Space of the displacement.
  /// @throws std::invalid_argument on all ranks if the surfaces do not fit.
  /// @throws std::logic_error if it belongs to an Assembler already.
  std::shared_ptr<contact::Contact>
  attach(const std::shared_ptr<parallel::Halo>& halo,
         const std::shared_ptr<const contact::Bodies>& bodies, const Bulk& bulk,
         const FunctionSpace& V)
  {
    if (_discrete)
      throw std::logic_error(
          "the contact belongs to an Assembler already: create one Contact an "
          "Assembler");
    try
    {
      make(halo, bodies, bulk, V);
      _V = bulk.u()->function_space();
      return _discrete;
    }
    catch (...)
    {
      detach();
      throw;
    }
  }

  /// @brief Leave the Assembler, which is gone.
  void detach()
  {
    _discrete.reset();
    _results.reset();
    _functions.reset();
  }

  /// @brief Take another coefficient of friction, on all ranks, from the next
  /// iterate on.
  /// @throws std::invalid_argument if the contact was created without one.
  void set_friction(double friction)
  {
    if (not _options.friction)
      throw std::invalid_argument(
          "the contact has no friction: create it with one, zero will do");
    _values->coefficient = friction;
  }

  /// @brief Take another length off the gap, on all ranks, from the next
  /// iterate on.
  void set_offset(double offset) { _values->length = offset; }

  /// @brief Name in messages.
  std::string name() const
  {
    if (is_self())
      return "Contact of " + _slave.name() + " with itself";
    const auto* surface = std::get_if<Surface>(&_master);
    const std::string master
        = surface
              ? surface->name()
              : std::get<std::shared_ptr<obstacle::Obstacle>>(_master)->name();
    const bool is_small = _options.sliding == Sliding::small;
    return "Contact(slave=" + _slave.name() + ", master=" + master
           + ", sliding='" + (is_small ? "small" : "finite") + "')";
  }

  /// @brief Friction and offset, as the core reads them.
  const std::shared_ptr<Values>& values() const { return _values; }

  /// @brief The core's side.
  /// @throws std::logic_error if it does not exist yet.
  contact::Contact& discrete() const
  {
    if (not _discrete)
      throw std::logic_error(
          "a contact has no results before it belongs to an Assembler: pass it "
          "to one first");
    return *_discrete;
  }

  /// @brief Whether it is a contact of a surface with itself.
  bool is_self() const
  {
    const auto* master = std::get_if<Surface>(&_master);
    return master and master->is(_slave);
  }

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
  const results::Results& results() const
  {
    discrete();
    return *_results;
  }

  /// @brief Pressures, force/area, recovered from the multipliers, see
  /// contact::Recovery (shape=(n)).
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

  /// @brief Status, see law::Status: 0 open, 1 stick or tied, 2 slip or
  /// frictionless in contact (shape=(n)).
  std::span<const std::int8_t> status() const { return results().status(); }

  /// @brief Slip increments of the last step, lengths, zero where there is no
  /// friction (shape=(n, gdim)).
  std::span<const double> slip() const { return results().slip(); }

  /// @brief Accumulated lengths of slip (shape=(n)).
  std::span<const double> slip_total() const { return results().slip_total(); }

  /// @brief Force on the slave side of all ranks (shape=(gdim)), zero behind
  /// that.
  Vector<3> force() const { return results().force(); }

  /// @brief Moment of the forces on the slave side of all ranks, which must
  /// take part; in 2D its last component, positive counter-clockwise.
  /// @param[in] point The point that it is about (shape=(gdim)).
  /// @throws std::invalid_argument if the point is not finite.
  /// @throws std::logic_error if the model is axisymmetric.
  Vector<3> moment(const Vector<3>& point) const
  {
    return results().moment(
        std::span<const double>(point).first(results().gdim()));
  }

  /// @brief Sums and extremes over all ranks, which must take part.
  results::Totals totals() const { return results().totals(); }

  /// @brief The results as functions of DOLFINx, which follow the accepted
  /// steps from the first call on. All ranks must take part.
  const Functions& functions()
  {
    discrete();
    if (not _functions)
    {
      _functions = std::make_unique<Functions>(_V, slave_nodes(),
                                               discrete().law()->is_tied());
      _functions->take(*_results);
    }
    return *_functions;
  }

  /// @brief The results as the core's driver of a step updates them.
  const std::shared_ptr<results::Results>& shared_results() const
  {
    return _results;
  }

  /// @brief Copy the results to the functions, where these are asked for; the
  /// Assembler does so. All ranks must take part.
  void show()
  {
    if (_functions)
      _functions->take(*_results);
  }

private:
  void make(const std::shared_ptr<parallel::Halo>& halo,
            const std::shared_ptr<const contact::Bodies>& bodies,
            const Bulk& bulk, const FunctionSpace& V)
  {
    const facet::Facets slave = _slave.facet_nodes(V, halo->ranks());
    const auto slaves = reference::make_slave_nodes(halo, slave.list());
    if (_options.weight)
      slaves->set_weight(weights(*halo, *slaves));
    std::shared_ptr<law::Law> law;
    if (_options.tied)
      law = std::make_shared<law::Tied>();
    else if (_options.friction)
      law = std::make_shared<law::Coulomb>();
    else
      law = std::make_shared<law::Frictionless>();

    const reference::Mesh mesh{halo, bodies, bulk.all_cells(),
                               bulk.nodes_per_cell()};
    const reference::MasterOptions how{
        .method = _options.method,
        .sliding = _options.sliding,
        .search_distance = _options.search_distance,
        .is_self = is_self(),
        .excluded_distance = _options.excluded_distance,
        .is_smooth = _options.smooth};
    contact::Contact::Options options{
        .sliding = _options.sliding,
        .has_means = _options.method == Method::surface_to_surface,
        .prescribed = bulk.all_markers(),
        .shared = {},
        .adjust = _options.adjust};
    if (const auto* obstacle
        = std::get_if<std::shared_ptr<obstacle::Obstacle>>(&_master))
    {
      const auto master = reference::make_master(mesh, slaves, _slave.name(),
                                                 *obstacle, *law, how);
      _discrete = std::make_shared<contact::Contact>(halo, slaves, master, law,
                                                     std::move(options));
    }
    else
    {
      const Surface& surface = std::get<Surface>(_master);
      const facet::Facets facets = surface.facet_nodes(V, halo->ranks());
      const auto master
          = reference::make_master(mesh, slaves, _slave.name(),
                                   {surface.name(), facets.list()}, *law, how);
      if (not is_self())
      {
        options.shared
            = reference::shared_nodes(*halo, slaves->own(), facets.list());
        options.shared.resize(halo->num_owned());
      }
      _discrete = std::make_shared<contact::Contact>(halo, slaves, master, law,
                                                     std::move(options));
      if (not is_self())
        reference::check_facing(*halo, *slaves, _slave.name(), *master,
                                surface.name());
    }
    _results = std::make_shared<results::Results>(_discrete);
    _values->num_nodes = slaves->owned().size();
  }

  std::vector<double> weights(const parallel::Halo& halo,
                              const contact::SlaveNodes& slaves) const
  {
    std::vector<double> values;
    for (const std::int32_t node : slaves.owned())
    {
      Vector<3> x{};
      std::copy_n(halo.reference().begin() + halo.gdim() * node, halo.gdim(),
                  x.begin());
      values.push_back(_options.weight(x));
    }
    return values;
  }

  Surface _slave;
  Master _master;
  Options _options;
  std::shared_ptr<Values> _values;
  std::shared_ptr<contact::Contact> _discrete;
  std::shared_ptr<results::Results> _results;
  std::shared_ptr<const FunctionSpace> _V;
  std::unique_ptr<Functions> _functions;
};
} // namespace contactx::dolfinx
