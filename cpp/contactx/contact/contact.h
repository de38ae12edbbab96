// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../kernel/assemble.h"
#include "../law/law.h"
#include "../law/node_state.h"
#include "../law/slip_history.h"
#include "../mesh/halo.h"
#include "master.h"
#include "method.h"
#include "slave_nodes.h"
#include <array>
#include <memory>
#include <optional>

namespace contactx::contact
{
/// @brief Kinematics of a contact.
enum class Sliding : std::int8_t
{
  finite, ///< pairs, normals and projections are those of the iterate
  small   ///< they are those of the reference configuration
};

/// @brief One contact: its slave nodes with their pairs, state and law.
///
/// A solver calls, for each load step, `begin_step`; at each accepted
/// iterate `search`, `update_gap` and `update_status` (`ActiveSet::update` does
/// so for all contacts of a problem); `update_gap` and the law's `evaluate`
/// before terms are assembled over `pairs`; and `accept` at the end. Positions
/// are those of the halo at each call; n is the number of owned slave nodes.
/// All ranks must call its functions without const.
class Contact
{
public:
  /// @brief Options of a contact.
  struct Options
  {
    Sliding sliding;
    Method method = Method::node_to_surface; ///< see `integrates_facets`
    /// 1 at displacements with a Dirichlet condition, those of the bulk's
    /// nodes (shape=(num_bulk, gdim))
    std::vector<std::int8_t> prescribed;
    /// 1 at owned nodes that the master surface has, too: those of a crack's
    /// tip, which have no gap (shape=(num_owned)); empty for none
    std::vector<std::int8_t> shared;
    /// Gaps and overlaps of the reference configuration that are at most so
    /// large count as none, for good: a length that is taken off the gap of
    /// each slave node, which puts no strain on the bodies
    std::optional<double> adjust = {};
  };

  /// @brief Pair the slave nodes in the reference configuration.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] slaves Slave nodes.
  /// @param[in] master Master, without pairs yet.
  /// @param[in] law Contact law.
  /// @param[in] options How the contact is.
  /// @throws std::invalid_argument if sizes do not fit, or `adjust` is
  /// negative, not finite, or given for a tie.
  Contact(std::shared_ptr<mesh::Halo> halo,
          std::shared_ptr<const SlaveNodes> slaves,
          std::shared_ptr<Master> master, std::shared_ptr<law::Law> law,
          Options options);

  /// @brief Slave nodes.
  const SlaveNodes& slaves() const { return *_slaves; }

  /// @brief The same, to keep.
  const std::shared_ptr<const SlaveNodes>& shared_slaves() const
  {
    return _slaves;
  }

  /// @brief Master.
  const std::shared_ptr<Master>& master() const { return _master; }

  /// @brief Law.
  const std::shared_ptr<law::Law>& law() const { return _law; }

  /// @brief State of the slave nodes.
  const std::shared_ptr<law::NodeState>& nodes() const { return _nodes; }

  /// @brief Slip of the accepted steps; null where slip is not measured.
  const std::shared_ptr<law::SlipHistory>& history() const { return _history; }

  /// @brief Nodes of this rank.
  const mesh::Halo& halo() const { return *_halo; }

  /// @brief True if slave and master are the same surface.
  bool is_self() const { return _master->is_self(); }

  /// @brief Kinematics.
  Sliding sliding() const { return _options.sliding; }

  /// @brief Kinematics of the terms now: frozen ones are those of small
  /// sliding.
  Sliding kinematics() const
  {
    return _is_frozen ? Sliding::small : Sliding::finite;
  }

  /// @brief Which kernels the law has.
  kernel::Law kernel_law() const;

  /// @brief True if pairs, normals and projections follow the iterates.
  bool updates_kinematics() const
  {
    return sliding() == Sliding::finite and not _law->is_tied();
  }

  /// @brief True if gaps and slip are linear in the displacements, with
  /// constants of the reference configuration: small sliding on a body.
  bool measures_displacements() const
  {
    return sliding() == Sliding::small and not _law->is_tied()
           and not _master->is_rigid();
  }

  /// @brief kernel::Pairs by the kinds of their facets, with their data of now.
  const std::vector<std::shared_ptr<kernel::Pairs>>& pairs() const
  {
    return _pairs;
  }

  /// @brief Counts how often `pairs` or `kinematics` have changed, be it but
  /// their data.
  std::int64_t version() const { return _version; }

  /// @brief 1 at slave nodes that take no force: those that the master surface
  /// has, too, and those of quadratic facets that have no area (shape=(n)).
  const std::vector<std::int8_t>& is_left_out() const { return _is_left_out; }

  /// @brief 1 at owned nodes that the master surface has, too
  /// (shape=(num_owned)); empty for none.
  const std::vector<std::int8_t>& shared() const { return _options.shared; }

  /// @brief True if the contact is switched on.
  bool is_active() const { return _is_active; }

  /// @brief Switch the contact on or off; for the next step.
  void set_active(bool is_active);

  /// @brief Searches of this step that were not needed.
  int skipped_searches() const { return _skipped_searches; }

  /// @brief Take another offset of the gap from now on (shape=(n)).
  /// @throws std::invalid_argument if there are not as many.
  void set_offset(std::span<const double> offset);

  /// @brief Gaps of the reference configuration that count as none, see
  /// Options::adjust (shape=(n)).
  const std::vector<double>& adjusted() const { return _adjusted; }

  /// @brief The length that is taken off the gap: offset, the gaps that count
  /// as none, and what smooth surfaces rise over their facets (shape=(n)).
  const std::vector<double>& offset() const { return _offset; }

  /// @brief Take other Dirichlet conditions from now on.
  /// @param[in] prescribed 1 at displacements with one, those of the bulk's
  /// nodes (shape=(num_bulk, gdim)).
  /// @throws std::invalid_argument on all ranks if there are not as many.
  void set_prescribed(std::span<const std::int8_t> prescribed);

  /// @brief Start a step: pairs may change again, and in small sliding an
  /// obstacle may have moved.
  void begin_step();

  /// @brief Take the converged state as the start of the next step.
  void accept();

  /// @brief Go on from a state that was loaded; kinematics are not frozen.
  void rebuild();

  /// @brief Set the factor c of the complementarity from the compliance of the
  /// pairs.
  ///
  /// Slave node and master facet are springs in series: where one is much
  /// stiffer than the other, the softer one decides how fast a gap closes.
  /// @param[in] compliance Compliance of all nodes, length/force, zero where
  /// one cannot move (shape=(num_nodes)).
  void set_factor(std::span<const double> compliance);

  /// @brief Slave nodes of this rank that Dirichlet conditions keep inside a
  /// rigid obstacle: no pressure could get them out.
  /// @param[in] x Positions with the prescribed displacements (shape=(at least
  /// num_owned, gdim)).
  std::vector<std::int32_t> constrained_inside(std::span<const double> x);

  /// @brief True if an obstacle that is touched has moved since the step's
  /// start, and nothing tells how its material moves, which slip and ties are
  /// measured from.
  bool has_unknown_motion();

  /// @brief Pair the slave nodes, unless kinematics are frozen.
  /// @return Number of this rank's nodes in contact whose facet has changed.
  std::int32_t search();

  /// @brief Freeze pairs, normals and projections of finite sliding, or update
  /// them again.
  ///
  /// Frozen kinematics make the contact conditions linear. Those of small
  /// sliding always are.
  void freeze(bool is_frozen);

  /// @brief Evaluate gap, normal and slip of each slave node, unless they are
  /// those of these positions, pairs and offsets already.
  void update_gap();

  /// @brief True if no slave node of any rank that has a pair has a gap, or an
  /// overlap, but for round-off; collective.
  bool is_without_gaps() const;

  /// @brief Set each slave node's status from its multiplier, gap and slip.
  /// @param[in] is_first Whether the iterate is the step's start.
  /// @return Number of this rank's nodes that changed.
  std::int32_t update_status(bool is_first);

  /// @brief Measure slip from where nodes touch on the path to this iterate,
  /// which need not be one that is taken: that of the step's first Newton step
  /// in full. It has been searched, and its gap updated; no status changes.
  void foresee();

  /// @brief Mark the nodes that the complementarity closes.
  ///
  /// At a step's start also those that touch but for rounding errors: these
  /// must not decide which nodes carry a body that rests on another one.
  /// @param[in] is_first Whether the iterate is the step's start.
  /// @return 1 at these, else 0 (shape=(n)).
  std::vector<std::int8_t> closing(bool is_first);

  /// @brief Add this rank's contact forces.
  /// @param[in,out] b Forces on all nodes (shape=(num_nodes, gdim)).
  /// @throws std::invalid_argument if it has another size.
  void add_residual(std::span<double> b) const;

  /// @brief Assemble a block of the Jacobian over this rank's pairs, see
  /// `kernel::assemble_matrix`; slave nodes of other ranks come last.
  /// @param[in] term "stiffness", "traction" or "constraint".
  /// @param[in] which 1 at slave nodes whose pairs are assembled (shape=(n));
  /// empty for all.
  Triplets block(std::string_view term,
                 std::span<const std::int8_t> which = {}) const;

  /// @brief What displacements change in first order at slave nodes.
  struct Change
  {
    std::vector<double> movement; ///< against the master (shape=(n, gdim))
    std::vector<double> normal;   ///< normals (shape=(n, gdim))
  };

  /// @brief Find what displacements change in first order, where multipliers
  /// are vectors.
  /// @param[in] displacement Displacements of all nodes (shape=(num_nodes,
  /// gdim)).
  Change change(std::span<const double> displacement) const;

  /// @brief Tabulate a matrix term pair by pair.
  /// @param[in] term "stiffness", "traction" or "constraint".
  /// @param[in] which 1 at slave nodes whose pairs are taken (shape=(n)); empty
  /// for all.
  /// @param[in] use Called for each pair; slave nodes of other ranks come last.
  void for_each_pair(std::string_view term, std::span<const std::int8_t> which,
                     const kernel::UsePair& use) const;

private:
  int gdim() const { return _halo->gdim(); }
  std::vector<double> at_slaves(std::span<const double> x) const;
  void nodes_changed();
  void take_start();
  void find_free();
  void turn_tractions();
  void find_front();
  void leave_out_empty();
  void find_rest();
  void find_adjusted(double length);
  void sum_offset();
  void take(std::vector<kernel::Pairs> pairs);
  std::int32_t pair(std::span<const double> x);
  void find_immobile();
  std::vector<std::int8_t> touching(std::span<const std::int8_t> closes,
                                    bool is_first);
  void measure_from_touching(std::span<const std::int8_t> which);
  kernel::NodalArrays arrays(std::span<const double> displacement,
                             std::array<std::vector<double>, 5>& padded,
                             std::span<const double> position = {}) const;
  void assemble(std::string_view term, std::span<const double> displacement,
                std::span<double> values,
                std::span<const double> position = {}) const;
  void measure_gap(std::span<const double> displacement);
  void measure_slip(std::span<const double> displacement);

  std::shared_ptr<mesh::Halo> _halo;
  std::shared_ptr<const SlaveNodes> _slaves;
  std::shared_ptr<Master> _master;
  std::shared_ptr<law::Law> _law;
  Options _options;
  std::shared_ptr<law::NodeState> _nodes;
  std::shared_ptr<law::SlipHistory> _history;
  bool _is_frozen, _is_active = true;
  // Whether the step's first iterate has told where nodes touch
  bool _is_predicted = false;
  std::vector<std::shared_ptr<kernel::Pairs>> _pairs;
  std::int64_t _version = 0;
  int _skipped_searches = 0;
  // The last is the sum of these and of what smooth surfaces rise
  std::vector<double> _given, _adjusted, _offset;
  std::vector<double> _front;
  std::vector<double> _rest;       // (n, gdim), in the reference configuration
  std::vector<std::int8_t> _free;  // displacements of all nodes
  std::vector<double> _multiplier; // at the step's start
  std::vector<std::int8_t> _touched, _had_master, _is_left_out;
  std::vector<double> _filler; // areas of slave nodes that have none
  // Configuration and version at which gaps were evaluated
  std::shared_ptr<const mesh::Configuration> _evaluated;
  std::int64_t _evaluated_version = -1;
  std::shared_ptr<const void> _observer;
};
} // namespace contactx::contact
