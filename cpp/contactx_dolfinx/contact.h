// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "bulk.h"
#include "surface.h"
#include <contactx/contact/recovery.h>
#include <contactx/obstacle/obstacle.h>
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

/// @brief Contact of a slave surface with a master surface or a rigid obstacle,
/// or of a surface with itself, where slave and master are the same.
///
/// Gaps g >= 0 are positive where it is open, pressures p >= 0 in compression.
/// What it has of slave nodes are rows of those that this rank owns; it exists
/// once the contact belongs to an Assembler.
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
      : _slave(std::move(slave)), _master(std::move(master)), _options(options)
  {
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
    _recovery.reset();
    _coulomb.reset();
    _is_read = false;
  }

  /// @brief Take another coefficient of friction, on all ranks, from the next
  /// iterate on.
  /// @throws std::invalid_argument if the contact was created without one.
  void set_friction(double friction)
  {
    if (not _options.friction)
      throw std::invalid_argument(
          "the contact has no friction: create it with one, zero will do");
    _options.friction = friction;
    _is_read = false;
  }

  /// @brief Take another length off the gap, on all ranks, from the next
  /// iterate on.
  void set_offset(double offset)
  {
    _options.offset = offset;
    _is_read = false;
  }

  /// @brief Hand the core friction and offset as they are now; the Assembler
  /// does so.
  /// @throws std::invalid_argument if the coefficient is negative, or one of
  /// them is not finite.
  void read_values()
  {
    if (_is_read)
      return;
    if (not std::isfinite(_options.offset))
      throw std::invalid_argument(
          "the offset of a contact is not finite: give a finite length");
    const std::size_t n = discrete().nodes()->num_nodes();
    if (_coulomb)
      _coulomb->set_friction(std::vector<double>(n, *_options.friction));
    discrete().set_offset(std::vector<double>(n, _options.offset));
    _is_read = true;
  }

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

  /// @brief Gaps, NaN where there is no pair (shape=(n)).
  std::span<const double> gap() const { return discrete().nodes()->gap; }

  /// @brief Status, see law::Status: 0 open, 1 stick or tied, 2 slip or
  /// frictionless in contact (shape=(n)).
  std::span<const std::int8_t> status() const
  {
    return discrete().nodes()->status;
  }

  /// @brief Pressures, force/area, recovered from the multipliers: nodes in
  /// contact exchange force with their neighbours, see contact::Recovery. All
  /// ranks must take part.
  std::vector<double> pressure() const
  {
    const contact::NodeState& nodes = *discrete().nodes();
    std::vector<std::int8_t> closed(nodes.num_nodes());
    for (std::size_t i = 0; i < closed.size(); ++i)
      closed[i] = nodes.closed(i);
    std::vector<double> p(nodes.num_nodes());
    for (std::size_t i = 0; i < p.size(); ++i)
      p[i] = nodes.pressure(i);
    p = _recovery->pressure(p, nodes.area, closed);
    // Vertices of quadratic triangles have no area of their own
    const std::vector<double> filled = _recovery->filled(p, 1);
    for (std::size_t i = 0; i < p.size(); ++i)
      p[i] = filled[i] == 0 ? p[i] : filled[i];
    return p;
  }

  /// @brief Force on the slave side of all ranks (shape=(gdim)), zero behind
  /// that. All ranks must take part.
  Vector<3> force() const
  {
    const parallel::Halo& halo = discrete().halo();
    const int gdim = halo.gdim();
    std::vector<double> forces(std::size_t(halo.num_nodes()) * gdim, 0);
    discrete().add_residual(forces);
    halo.reverse(forces, gdim);
    Vector<3> sum{};
    const std::span<const std::int32_t> slaves = slave_nodes();
    // In self-contact all nodes may be slaves: those that are in contact, as no
    // node is on both sides
    const bool each_counts = not is_self();
    for (std::size_t i = 0; i < slaves.size(); ++i)
      if (each_counts or discrete().nodes()->closed(i))
        for (int k = 0; k < gdim; ++k)
          sum[k] -= forces[gdim * slaves[i] + k];
    halo.ranks().reduce(std::span<double>(sum), parallel::Reduction::sum);
    return sum;
  }

private:
  void make(const std::shared_ptr<parallel::Halo>& halo,
            const std::shared_ptr<const contact::Bodies>& bodies,
            const Bulk& bulk, const FunctionSpace& V)
  {
    const facet::Facets slave = _slave.facet_nodes(V, halo->ranks(), "slave");
    const auto* obstacle
        = std::get_if<std::shared_ptr<obstacle::Obstacle>>(&_master);
    const std::vector<std::int8_t> level
        = mesh::node_levels(cells_of(V), num_nodes(V));
    const auto slaves = reference::make_slave_nodes(
        halo, slave.list(), level, _options.method, obstacle != nullptr);
    if (_options.weight)
      slaves->set_weight(weights(*halo, *slaves));
    std::shared_ptr<law::Law> law;
    if (_options.tied)
      law = std::make_shared<law::Tied>();
    else if (_options.friction)
      law = _coulomb = std::make_shared<law::Coulomb>();
    else
      law = std::make_shared<law::Frictionless>();

    const reference::Mesh mesh{halo, bodies, bulk.all_cells(),
                               bulk.nodes_per_cell()};
    const reference::MasterOptions how{
        .method = _options.method,
        .sliding = _options.sliding,
        .search_distance = _options.search_distance,
        .level = level,
        .is_self = is_self(),
        .excluded_distance = _options.excluded_distance,
        .is_smooth = _options.smooth};
    contact::Contact::Options options{.sliding = _options.sliding,
                                      .method = _options.method,
                                      .prescribed = bulk.all_markers(),
                                      .shared = {},
                                      .adjust = _options.adjust};
    if (obstacle)
    {
      const auto master = reference::make_master(mesh, slaves, _slave.name(),
                                                 *obstacle, *law, how);
      _discrete = std::make_shared<contact::Contact>(halo, slaves, master, law,
                                                     std::move(options));
    }
    else
    {
      const Surface& surface = std::get<Surface>(_master);
      const facet::Facets facets
          = surface.facet_nodes(V, halo->ranks(), "master");
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
    _recovery = std::make_unique<contact::Recovery>(slaves, halo->reference(),
                                                    halo->gdim());
    // A rank without slave nodes finds nothing wrong
    halo->ranks().agree([this] { read_values(); });
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
  bool _is_read = false;
  std::shared_ptr<law::Coulomb> _coulomb;
  std::shared_ptr<contact::Contact> _discrete;
  std::unique_ptr<contact::Recovery> _recovery;
};
} // namespace contactx::dolfinx
