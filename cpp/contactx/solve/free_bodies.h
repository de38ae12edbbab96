// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../kernel/pairs.h"
#include "../mesh/bodies.h"
#include "bulk.h"
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace contactx::solve
{
class HeldMotions;
class MotionFields;
class RigidModes;

/// @brief Pairs of a contact as the last search left them.
struct Pairing
{
  std::vector<std::int8_t> paired; ///< 1 at slave nodes with a pair (shape=(n))
  std::vector<double> normals;     ///< of the master (shape=(n, 3))
  kernel::Weights weights;
};

/// @brief Slave nodes of a contact with friction (arrays of shape=(n, gdim) but
/// for two).
struct FrictionState
{
  std::vector<double> normal, traction, slip;
  std::vector<double> value; ///< complementarity function, a force
  std::vector<double> area;  ///< shape=(n)
  /// 1 where the bound of friction is not zero (shape=(n))
  std::vector<std::int8_t> has_friction;
};

/// @brief A contact as free bodies see it. n is the number of owned slave
/// nodes.
class FreeBodyContact
{
public:
  virtual ~FreeBodyContact() = default;

  /// @brief True if pairs and normals are those of the reference: sliding is
  /// small.
  virtual bool is_small() const = 0;

  /// @brief True with Coulomb friction.
  virtual bool has_friction() const = 0;

  /// @brief Largest coefficient of friction, infinite where forces along the
  /// surface, or ties, are not bounded by one.
  virtual double friction_max() const = 0;

  /// @brief The pairs.
  virtual Pairing pairing() const = 0;

  /// @brief Status of each slave node, see law::Status (shape=(n)).
  virtual std::vector<std::int8_t> status() const = 0;

  /// @brief Gap of each slave node, NaN where it cannot close (shape=(n)).
  virtual std::vector<double> closable_gap() const = 0;

  /// @brief Size of the largest facet around each slave node (shape=(n)).
  virtual std::vector<double> facet_size() const = 0;

  /// @brief Evaluate the law of friction as the status is now.
  virtual FrictionState friction_state() = 0;

  /// @brief Close nodes, whatever their pressures: they stick where there is
  /// friction.
  virtual void close(std::span<const std::int32_t> which) = 0;

  /// @brief Set the multipliers of nodes.
  /// @param[in] which The nodes.
  /// @param[in] tractions Multipliers (shape=(which.size(), gdim)).
  virtual void set_tractions(std::span<const std::int32_t> which,
                             std::span<const double> tractions) = 0;
};

/// @brief Forces at an iterate; collective, and called only where a body has a
/// free mode.
struct Forces
{
  /// Residual of the displacements without Dirichlet rows, at owned dofs
  /// (shape=(num_owned, gdim))
  std::function<std::vector<double>()> residual;
  /// The bulk's part of it
  std::function<std::vector<double>()> of_bulk;
  /// Forces of the problem
  std::function<double()> scale;
};

/// @brief Keeps the Newton step of bodies without enough supports solvable.
///
/// A rigid mode that neither supports nor closed contacts resist is free and
/// makes the Jacobian singular. Where the forces along free modes balance, as
/// many springs as modes are added to the Jacobian: they are statically
/// determinate, so they carry no force and change no step. Where the forces do
/// not balance, the open nodes that would touch first in a rigid motion of the
/// bodies are closed, until the closed nodes can balance them; then those
/// slipping nodes stick whose slip this motion reverses first. The residual is
/// not touched, so no solution depends on this; but for motions that are held,
/// see HeldMotions, which `held_force` tells of. All ranks must take part in
/// all of it, and find the same.
class FreeBodies
{
public:
  /// @brief Take the bodies.
  /// @param[in] bodies Bodies of the mesh.
  /// @param[in] bulk The bulk.
  /// @param[in] contacts The contacts.
  /// @param[in] original Number of each owned node in the mesh as it was made
  /// (shape=(num_owned)).
  FreeBodies(std::shared_ptr<const mesh::Bodies> bodies,
             std::shared_ptr<Bulk> bulk,
             std::vector<std::shared_ptr<FreeBodyContact>> contacts,
             std::span<const std::int64_t> original);
  FreeBodies(FreeBodies&&) noexcept;
  ~FreeBodies();

  /// @brief True if any contact has Coulomb friction.
  bool has_friction() const;

  /// @brief Take the springs away, as something else keeps the bodies, but for
  /// supports of motions that are held.
  void release()
  {
    if (_held)
      return;
    _springs.reset();
    _free_modes = 0;
    _is_unbalanced = false;
  }

  /// @brief Find the free modes of the bodies.
  void begin_step();

  /// @brief Drop the rigid modes: a failed step may have found them of a spoilt
  /// stiffness.
  void reset();

  /// @brief Find the springs to add to the Jacobian at an iterate, and close
  /// nodes for balance.
  /// @param[in] forces Forces at the iterate.
  /// @return Whether nodes have been closed or stick on any rank.
  bool stabilise(const Forces& forces);

  /// @brief True if a body has motions that nothing, or little, resists.
  bool any_free() const;

  /// @brief Rigid motions of free bodies, and how deep what makes them go has
  /// been.
  struct Escape
  {
    double depth;                  ///< largest penetration, length
    std::vector<double> increment; ///< of owned nodes (shape=(num_owned, gdim))
  };

  /// @brief Find where free bodies that no force acts on give way to what
  /// penetrates them, by search and gaps of now; nothing is closed. Collective.
  /// @param[in] forces Forces at the iterate.
  /// @param[in] is_first Whether they have not gone anywhere yet: what touches
  /// stays, while those that go leave a gap.
  /// @return Where they go to in first order; nothing if nothing penetrates
  /// them.
  std::optional<Escape> escape(const Forces& forces, bool is_first);

  /// @brief Movement of the bodies along their free modes since the last
  /// call of `stabilise`.
  ///
  /// Without friction, where the forces balance and kinematics are frozen,
  /// nothing asks for such a motion: it comes of the places of the springs,
  /// which bodies turn about as they deform, and takes nodes past each other.
  /// @return Displacements at owned dofs (shape=(num_owned, gdim)); nothing if
  /// no mode was free, or something asked for a motion.
  std::optional<std::vector<double>> drift();

  /// @brief Largest angle that a body with free modes has turned by, radians;
  /// zero where strains are not linear. Collective.
  ///
  /// Linear strains take a rotation by the angle w for a stretch by
  /// sqrt(1 + w^2) that costs nothing. A body that is supported keeps its place
  /// in spite of that; a loose one can become larger until nothing touches it.
  double turned() const;

  /// @brief Stiffness to add to the Jacobian's diagonal at owned dofs,
  /// force/length (shape=(num_owned, gdim)); nothing if there are none.
  const std::optional<std::vector<double>>& springs() const { return _springs; }

  /// @brief Tell whether a step moves nodes in contact by more than a part of
  /// their facets along motions that nothing but the corners between facets
  /// resists, and the forces along them are small: facets that are passed do
  /// not resist as they did. Collective.
  /// @param[in] dx The step (shape=(>= num_owned * gdim)).
  bool runs_along(std::span<const double> dx) const;

  /// @brief Hold bodies where they are along these motions until the step ends,
  /// as long as the forces along them are small.
  void hold();

  /// @brief Let them go, once a step, if something pulls at the supports; held
  /// motions are those of the next call of `stabilise`.
  /// @return Whether they were let go.
  bool let_go();

  /// @brief Motions that are held where they are, nothing if none are.
  const std::shared_ptr<HeldMotions>& held() const { return _held; }

  /// @brief Forces of the supports that hold them, over those of all contacts;
  /// zero where nothing pulls at them.
  double held_force() const;

  /// @brief Number of free rigid modes at the last iterate.
  std::int64_t free_modes() const { return _free_modes; }

  /// @brief Bodies that had free rigid modes at the last iterate.
  struct LooseBodies
  {
    std::int64_t count = 0;
    std::vector<double> middle; ///< of the first one (shape=(gdim))
  };

  /// @brief Find these bodies; collective.
  LooseBodies loose() const;

  /// @brief Number of nodes that were closed in this step to balance a body.
  std::int64_t closed_for_balance() const { return _closed_for_balance; }

  /// @brief True if the last iterate had forces that no contact can
  /// balance.
  bool is_unbalanced() const { return _is_unbalanced; }

  /// @brief Tell whether any forces inside the cones of friction, at slave
  /// nodes that have a pair, near or far, balance the loads where the bodies
  /// are now.
  ///
  /// Non-negative least squares on the forces along the bodies' free modes,
  /// whose rays are found one by one: each is the force inside any node's cone
  /// that works most on the motion that what is left asks for (Lawson and
  /// Hanson 1974). Where none does, that motion is resisted by nothing.
  /// Collective.
  /// @param[in] forces Forces at the iterate.
  /// @param[in] reach Largest gap of these nodes, length.
  bool may_balance(const Forces& forces, double reach) const;

private:
  /// Slave nodes of a contact with a pair under rigid motions of the bodies.
  struct Rows;
  /// Orthonormal motions of the bodies
  struct Motions;
  /// Motions that nothing but corners between facets resists
  struct Neutral;
  /// Where free bodies give way to what penetrates them
  struct Room;
  /// Free motions at owned dofs, and the displacements at which they were found
  struct Loose;
  /// Nodes of a contact that may balance a body, and the time in which the
  /// motion gets there.
  struct Found
  {
    FreeBodyContact* contact;
    std::vector<std::int32_t> slaves;
    std::vector<double> times;
    std::vector<double> tractions{};
  };

  mesh::Ranks& ranks() const { return _bodies->map().ranks(); }
  bool is_linear() const;
  std::span<const double> positions() const;
  std::vector<Rows> rows(std::span<const double> x) const;
  std::vector<double> along(std::span<const double> x,
                            std::span<const double> forces, double sign) const;
  Motions free_basis(const std::vector<Rows>& rows, bool of_weak) const;
  bool close_before_springs(const std::vector<Rows>& rows,
                            std::span<const double> pull);
  std::int64_t
  close_first(const std::vector<Rows>& rows, std::span<const double> increment,
              std::vector<double>& way,
              double within = std::numeric_limits<double>::infinity());
  bool stick_first(const std::vector<Rows>& rows,
                   std::span<const double> increment);
  std::vector<double> cone_deficit(const std::vector<Rows>& rows) const;
  FrictionState friction_state(const Rows& rows, std::size_t n) const;
  double lowest(std::span<const Found> found) const;
  std::vector<double> strongest(const std::vector<Rows>& rows,
                                std::span<const double> motion,
                                double reach) const;
  MotionFields displacements(const Motions& motions,
                             std::span<const double> x) const;
  std::vector<double> springs_of(const MotionFields& fields) const;
  void add_springs(const Motions& motions, std::span<const double> x,
                   std::span<const double> pull,
                   std::span<const double> forces);
  void keep_in_place(MotionFields fields);
  void note_neutral(const Motions& motions, std::vector<Rows> rows,
                    std::span<const double> x, std::span<const double> pull,
                    std::span<const double> forces,
                    std::span<const double> of_bulk);
  Room room(const std::vector<Rows>& rows,
            std::span<const std::int8_t> is_driven, double clearance) const;
  std::vector<std::int8_t> driven(std::span<const double> pull) const;
  bool give_way(const std::vector<Rows>& rows, std::span<const double> pull);

  std::shared_ptr<const mesh::Bodies> _bodies;
  std::shared_ptr<Bulk> _bulk;
  std::vector<std::shared_ptr<FreeBodyContact>> _contacts;
  std::vector<std::int64_t> _original;
  std::unique_ptr<RigidModes> _modes;
  std::int64_t _free_modes = 0, _closed_for_balance = 0;
  bool _is_unbalanced = false, _begins = true, _has_given_way = false;
  bool _is_holding = false, _has_let_go = false;
  std::vector<std::int8_t> _is_loose; // of each body
  std::optional<std::vector<double>> _springs;
  std::unique_ptr<Loose> _loose;
  std::unique_ptr<Neutral> _neutral;
  std::shared_ptr<HeldMotions> _held;
  // Force that is none, and that of all contacts
  double _balanced = 0, _pressed = 0;
};
} // namespace contactx::solve
