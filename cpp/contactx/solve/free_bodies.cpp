// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "free_bodies.h"
#include "../law/normal.h"
#include "../math/matrix.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include "held_motions.h"
#include "motion_fields.h"
#include "rigid_modes.h"
#include "springs.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

using namespace contactx;
using namespace contactx::solve;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using mesh::Reduction;

namespace
{
// Force along free modes, over the forces that it is the sum of, up to which
// they balance: the step has no rigid motion, contact forces can hold the loads
constexpr double balanced_force_max = 1e-3;
// Resistance of closed nodes to a motion, over the largest, below which it is
// that of the corners between facets: squares of the sines of their angles
constexpr double corner_resistance = 1e-3;
// Way of a node of a body by such motions, over the size of the facets in
// contact, from which on others pass corners
constexpr double run_fraction = 0.1;
// Force along motions that little resists, over the contact forces, that
// supports may take
constexpr double held_force_max = 1e-2;
// Forces that are tried: in 3D a cone has more of them than its edges
constexpr int max_rays = 200;

/// Part of a vector along the surface.
Vector<3> along_surface(const Vector<3>& normal, const Vector<3>& v)
{
  const double height = dot(normal, v);
  return {v[0] - height * normal[0], v[1] - height * normal[1],
          v[2] - height * normal[2]};
}

double largest_size(std::span<const double> increment)
{
  double most = 0;
  for (const double value : increment)
    most = std::max(most, std::abs(value));
  return most;
}

/// First column of each body among those of all bodies, and their number.
std::vector<Eigen::Index> first_columns(const std::vector<MatrixXd>& bases)
{
  std::vector<Eigen::Index> first{0};
  for (const MatrixXd& basis : bases)
    first.push_back(first.back() + basis.cols());
  return first;
}

/// Columns of the bodies that a symmetric matrix joins, each in one part.
/// @param[in] gram The matrix (shape=(first.back(), >= first.back())).
/// @param[in] first First column of each body.
std::vector<std::vector<Eigen::Index>>
parts(const MatrixXd& gram, const std::vector<Eigen::Index>& first)
{
  const std::size_t count = first.size() - 1;
  std::vector<std::int32_t> owner(first.back()), joined;
  for (std::size_t b = 0; b < count; ++b)
    std::fill(owner.begin() + first[b], owner.begin() + first[b + 1],
              static_cast<std::int32_t>(b));
  for (Eigen::Index q = 0; q < first.back(); ++q)
    for (Eigen::Index p = 0; p < q; ++p)
      if (gram(p, q) != 0)
        joined.insert(joined.end(), {owner[p], owner[q]});
  const std::vector<std::int32_t> part
      = mesh::connected_parts(joined, 2, static_cast<std::int32_t>(count));
  std::vector<std::vector<Eigen::Index>> columns(count);
  for (Eigen::Index p = 0; p < first.back(); ++p)
    columns[part[owner[p]]].push_back(p);
  std::erase_if(columns, [](const auto& some) { return some.empty(); });
  return columns;
}
} // namespace

/// Slave nodes of a contact that have a pair.
struct FreeBodies::Rows
{
  FreeBodyContact* contact;
  int gdim, m;
  std::vector<std::int32_t> slaves; ///< by their number in the contact
  std::vector<Vector<3>> normal;
  /// Bodies that move a node, and its relative movement by their modes: those
  /// of slave i from offsets[i] on (shape=(offsets.back()), (offsets.back(),
  /// gdim, m))
  std::vector<std::size_t> offsets;
  std::vector<std::int32_t> bodies;
  std::vector<double> blocks;

  std::size_t size() const { return slaves.size(); }

  /// Relative movement of a slave node by a motion.
  Vector<3> by(std::span<const double> increment, std::size_t i) const
  {
    Vector<3> u{};
    for (std::size_t e = offsets[i]; e < offsets[i + 1]; ++e)
      for (int c = 0; c < gdim; ++c)
        for (int p = 0; p < m; ++p)
          u[c] += blocks[(e * gdim + c) * m + p] * increment[bodies[e] * m + p];
    return u;
  }

  /// Rows in a direction by the modes of each body that moves the node
  /// (shape=(number of bodies, m)).
  void in_direction(const Vector<3>& direction, std::size_t i,
                    std::vector<double>& row) const
  {
    row.assign((offsets[i + 1] - offsets[i]) * m, 0.0);
    for (std::size_t e = offsets[i]; e < offsets[i + 1]; ++e)
      for (int c = 0; c < gdim; ++c)
        for (int p = 0; p < m; ++p)
          row[(e - offsets[i]) * m + p]
              += direction[c] * blocks[(e * gdim + c) * m + p];
  }

  /// Row in a direction by the columns of the bases of all bodies, where it is
  /// not zero.
  /// @param[in] first First column of each body.
  void by_columns(const Vector<3>& direction, std::size_t i,
                  const std::vector<MatrixXd>& bases,
                  const std::vector<Eigen::Index>& first,
                  std::vector<Eigen::Index>& where,
                  std::vector<double>& row) const
  {
    std::vector<double> of_body;
    in_direction(direction, i, of_body);
    where.clear();
    row.clear();
    for (std::size_t e = offsets[i]; e < offsets[i + 1]; ++e)
    {
      const std::int32_t b = bodies[e];
      const double* modes = &of_body[(e - offsets[i]) * m];
      for (Eigen::Index k = 0; k < bases[b].cols(); ++k)
      {
        double sum = 0;
        for (int p = 0; p < m; ++p)
          sum += modes[p] * bases[b](p, k);
        where.push_back(first[b] + k);
        row.push_back(sum);
      }
    }
  }
};

/// Motions in columns, as coefficients of the modes of all bodies.
struct FreeBodies::Motions
{
  MatrixXd N;
  Eigen::Index num_free = 0; ///< that nothing resists, the first ones
};

struct FreeBodies::Neutral
{
  MotionFields fields;
  MatrixXd N; ///< the same by the bodies' modes, a column each
  std::vector<Rows> rows;
  double size; ///< of the smallest facet in contact
};

struct FreeBodies::Room
{
  VectorXd motion;  ///< of all bodies, by their modes
  double depth = 0; ///< largest penetration before
  /// Nodes of each contact that are pressed in the end
  std::vector<std::vector<std::int32_t>> pressed;
};

struct FreeBodies::Loose
{
  MotionFields motions;
  std::vector<double> before;
};

FreeBodies::FreeBodies(std::shared_ptr<const mesh::Bodies> bodies,
                       std::shared_ptr<Bulk> bulk,
                       std::vector<std::shared_ptr<FreeBodyContact>> contacts,
                       std::span<const std::int64_t> original)
    : _bodies(std::move(bodies)), _bulk(std::move(bulk)),
      _contacts(std::move(contacts)),
      _original(original.begin(), original.end())
{
}

FreeBodies::FreeBodies(FreeBodies&&) noexcept = default;

FreeBodies::~FreeBodies() = default;

void FreeBodies::reset() { _modes.reset(); }

bool FreeBodies::has_friction() const
{
  return std::ranges::any_of(_contacts, [](const auto& contact)
                             { return contact->has_friction(); });
}

/// Whether all but the active set is linear.
bool FreeBodies::is_linear() const
{
  return _bulk->is_linear() and not has_friction()
         and std::ranges::all_of(_contacts, [](const auto& contact)
                                 { return contact->is_small(); });
}

/// Positions that rigid motions are about. Where all is linear these are those
/// of the reference: a rotation about the current ones changes gaps and strains
/// by what the bodies have moved.
std::span<const double> FreeBodies::positions() const
{
  return is_linear() ? _bulk->reference() : _bulk->positions();
}

void FreeBodies::begin_step()
{
  const std::span<const double> x = positions();
  if (_modes)
    _modes->update(*_bulk, x);
  else
    _modes = std::make_unique<RigidModes>(_bodies, *_bulk, x);
  _free_modes = _closed_for_balance = 0;
  _is_unbalanced = false;
  _springs.reset();
  _loose.reset();
  _held.reset();
  _neutral.reset();
  _begins = true;
  _is_holding = _has_let_go = false;
}

std::vector<FreeBodies::Rows> FreeBodies::rows(std::span<const double> x) const
{
  const int g = _modes->gdim(), m = _modes->modes_per_body();
  const std::span<const std::int32_t> body = _modes->body();
  std::vector<Rows> all;
  ranks().agree(
      [&]
      {
        std::array<double, 18> modes;
        for (const auto& contact : _contacts)
        {
          const Pairing pairing = contact->pairing();
          const kernel::Weights& weights = pairing.weights;
          const std::size_t n = pairing.paired.size();
          if (pairing.normals.size() != 3 * n)
            throw std::invalid_argument("normals must have three values for "
                                        "each slave node");
          if (weights.nodes.size() != weights.slaves.size()
              or weights.values.size() != weights.slaves.size())
            throw std::invalid_argument("the arrays of weights differ in size");
          if (contact->status().size() != n
              or contact->closable_gap().size() != n)
            throw std::invalid_argument("status and gap must have a value for "
                                        "each slave node");
          Rows& rows
              = all.emplace_back(Rows{contact.get(), g, m, {}, {}, {}, {}, {}});
          // Weights of each slave node, in their order
          std::vector<std::size_t> first(n + 1), order(weights.slaves.size());
          for (std::size_t w = 0; w < order.size(); ++w)
          {
            const std::int32_t slave = weights.slaves[w];
            const std::int32_t node = weights.nodes[w];
            if (slave < 0 or slave >= std::ssize(pairing.paired) or node < 0
                or node >= std::ssize(body))
              throw std::invalid_argument("weights must be of slave nodes and "
                                          "nodes that are there");
            ++first[slave + 1];
          }
          for (std::size_t i = 0; i < n; ++i)
            first[i + 1] += first[i];
          std::vector<std::size_t> at(first.begin(), first.end());
          for (std::size_t w = 0; w < order.size(); ++w)
            order[at[weights.slaves[w]]++] = w;
          rows.offsets.push_back(0);
          for (std::size_t i = 0; i < n; ++i)
          {
            if (pairing.paired[i] == 0)
              continue;
            rows.slaves.push_back(static_cast<std::int32_t>(i));
            rows.normal.push_back(vector_at(pairing.normals, i, 3));
            // Components beyond the dimension do not count
            for (int k = g; k < 3; ++k)
              rows.normal.back()[k] = 0;
            for (std::size_t k = first[i]; k < first[i + 1]; ++k)
            {
              const std::size_t w = order[k];
              const std::int32_t node = weights.nodes[w];
              std::size_t e = rows.offsets.back();
              while (e < rows.bodies.size() and rows.bodies[e] != body[node])
                ++e;
              if (e == rows.bodies.size())
              {
                rows.bodies.push_back(body[node]);
                rows.blocks.resize(rows.blocks.size() + g * m);
              }
              _modes->at(node, x, modes.data());
              for (int j = 0; j < g * m; ++j)
                rows.blocks[e * g * m + j] += weights.values[w] * modes[j];
            }
            rows.offsets.push_back(rows.bodies.size());
          }
        }
      });
  return all;
}

/// Forces on all ranks, times a sign, along the modes of the bodies
/// (shape=(num_bodies, m)).
std::vector<double> FreeBodies::along(std::span<const double> x,
                                      std::span<const double> forces,
                                      double sign) const
{
  const std::size_t g = _modes->gdim(), m = _modes->modes_per_body();
  const auto body = _modes->body();
  std::array<double, 18> modes;
  std::vector<double> sums(_modes->count() * m);
  for (std::size_t i = 0; i < forces.size() / g; ++i)
  {
    _modes->at(static_cast<std::int32_t>(i), x, modes.data());
    double* sum = &sums[body[i] * m];
    for (std::size_t p = 0; p < m; ++p)
    {
      double work = 0;
      for (std::size_t k = 0; k < g; ++k)
        work += modes[k * m + p] * (sign * forces[i * g + k]);
      sum[p] += work;
    }
  }
  if (ranks().size() > 1)
    ranks().reduce(std::span(sums), Reduction::sum);
  return sums;
}

bool FreeBodies::stabilise(const Forces& forces)
{
  _springs.reset();
  _loose.reset();
  _held.reset();
  _neutral.reset();
  _free_modes = 0;
  if (not any_free())
    return false;
  const std::span<const double> x = positions();
  const std::size_t n
      = _bodies->map().num_owned() * std::size_t(_modes->gdim());
  const auto checked = [&](std::vector<double> values)
  {
    ranks().agree(
        [&]
        {
          if (values.size() != n)
            throw std::invalid_argument(
                "forces must have a value for each of " + std::to_string(n)
                + " owned dofs, not " + std::to_string(values.size()));
        });
    return values;
  };
  const std::vector<double> force = checked(forces.residual());
  const std::vector<double> pull = along(x, force, -1);
  _balanced = math::negligible_part * forces.scale();
  std::vector<Rows> rows = this->rows(x);
  bool closed_any = _begins and close_before_springs(rows, pull);
  if (_begins)
    _has_given_way = false;
  else if (not std::exchange(_has_given_way, true))
    closed_any = give_way(rows, pull) or closed_any;
  _begins = false;
  Motions motions;
  MatrixXd N;
  std::vector<double> way(pull.size(), 0);
  while (true)
  {
    motions = free_basis(rows, false);
    N = motions.N.leftCols(motions.num_free);
    if (N.cols() == 0)
    {
      _is_unbalanced = false;
      break;
    }
    VectorXd f = N.transpose() * math::column(pull);
    // In 3D the tangent across the slip resists motions that slip to all sides
    // does not
    if (_modes->gdim() == 2)
      f += N.transpose() * math::column(cone_deficit(rows));
    // A norm that does not depend on which basis of the modes round-off has
    // chosen
    if (f.norm() <= _balanced)
    {
      _is_unbalanced = false;
      break;
    }
    const VectorXd motion = N * f;
    const std::span increment(motion.data(), motion.size());
    const std::int64_t closed = close_first(rows, increment, way);
    _closed_for_balance += closed;
    if (closed == 0 and not stick_first(rows, increment))
    {
      _is_unbalanced = true;
      break;
    }
    closed_any = true;
  }
  _free_modes = N.cols();
  const Eigen::Index m = _modes->modes_per_body();
  _is_loose.assign(_modes->count(), 0);
  for (std::size_t b = 0; N.cols() > 0 and b < _is_loose.size(); ++b)
    _is_loose[b] = N.middleRows(b * m, m).norm() > math::equal_rel_tol;
  if (not has_friction() and motions.N.cols() > motions.num_free)
    note_neutral(motions, std::move(rows), x, pull, force,
                 checked(forces.of_bulk()));
  if (_neutral and _is_holding)
    hold();
  else if (_free_modes > 0)
    add_springs({N, N.cols()}, x, pull, force);
  return closed_any;
}

FreeBodies::LooseBodies FreeBodies::loose() const
{
  const auto first = std::ranges::find(_is_loose, 1);
  if (_free_modes == 0 or first == _is_loose.end())
    return {};
  const std::size_t g = _modes->gdim();
  // Where users have drawn it
  const std::span<const double> x = _bulk->reference();
  const auto body = _modes->body().first(_bodies->map().num_owned());
  std::vector<double> sums(g + 1);
  for (std::size_t i = 0; i < body.size(); ++i)
    if (body[i] == first - _is_loose.begin())
    {
      for (std::size_t k = 0; k < g; ++k)
        sums[k] += x[g * i + k];
      ++sums[g];
    }
  ranks().reduce(std::span(sums), Reduction::sum);
  for (std::size_t k = 0; k < g; ++k)
    sums[k] /= sums[g];
  sums.pop_back();
  return {std::ranges::count(_is_loose, 1), std::move(sums)};
}

/// Displacements by motions, in parts of bodies that some motions move
/// together.
MotionFields FreeBodies::displacements(const Motions& motions,
                                       std::span<const double> x) const
{
  const std::size_t g = _modes->gdim(), m = _modes->modes_per_body();
  const MatrixXd& N = motions.N;
  // First body that each motion moves
  std::vector<std::int32_t> joined, moved(N.cols(), -1);
  for (Eigen::Index k = 0; k < N.cols(); ++k)
    for (std::size_t b = 0; b < _modes->count(); ++b)
      if ((N.col(k).segment(b * m, m).array() != 0).any())
      {
        const auto body = static_cast<std::int32_t>(b);
        moved[k] = moved[k] < 0 ? body : moved[k];
        joined.insert(joined.end(), {moved[k], body});
      }
  const std::vector<std::int32_t> group = mesh::connected_parts(
      joined, 2, static_cast<std::int32_t>(_modes->count()));
  std::vector<MotionFields::Part> parts(_modes->count());
  for (Eigen::Index k = 0; k < N.cols(); ++k)
    parts[group[moved[k]]].motions.push_back(k);
  const auto body = _modes->body().first(_bodies->map().num_owned());
  for (std::size_t i = 0; i < g * body.size(); ++i)
    if (MotionFields::Part& part = parts[group[body[i / g]]];
        not part.motions.empty())
      part.dofs.push_back(static_cast<Eigen::Index>(i));
  std::erase_if(parts, [](const MotionFields::Part& part)
                { return part.motions.empty(); });
  std::array<double, 18> modes;
  for (MotionFields::Part& some : parts)
  {
    some.by.resize(some.motions.size(), some.dofs.size());
    const MatrixXd by_modes = N(Eigen::all, some.motions).transpose();
    for (std::size_t i = 0; i < some.dofs.size(); i += g)
    {
      const auto node = static_cast<std::int32_t>(some.dofs[i] / g);
      _modes->at(node, x, modes.data());
      some.by.middleCols(i, g)
          = by_modes.middleCols(body[node] * m, m)
            * Eigen::Map<const MatrixXd>(modes.data(), m, g);
    }
  }
  return {ranks(), std::move(parts)};
}

std::vector<double> FreeBodies::springs_of(const MotionFields& fields) const
{
  const std::size_t g = _modes->gdim();
  const auto markers = _bulk->markers();
  const auto diagonal = _bulk->diagonal();
  std::vector<double> springs(diagonal.size());
  for (const MotionFields::Part& part : fields.parts())
  {
    std::vector<std::int8_t> prescribed;
    std::vector<double> stiffness;
    std::vector<std::int64_t> original;
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
    {
      prescribed.push_back(markers[part.dofs[i]]);
      stiffness.push_back(diagonal[part.dofs[i]]);
      if (i % g == 0)
        original.push_back(_original[part.dofs[i] / g]);
    }
    const std::vector<double> of_part = independent_springs(
        ranks(), part.by, prescribed, stiffness, original, static_cast<int>(g));
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
      springs[part.dofs[i]] = of_part[i];
  }
  return springs;
}

void FreeBodies::add_springs(const Motions& motions, std::span<const double> x,
                             std::span<const double> pull,
                             std::span<const double> forces)
{
  MotionFields fields = displacements(motions, x);
  _springs = springs_of(fields);
  const double size
      = std::sqrt(mesh::total(ranks(), math::column(forces).squaredNorm()));
  const bool idle = (motions.N.transpose() * math::column(pull)).norm()
                    <= balanced_force_max * size;
  // Friction resists motions across the slip
  if (idle and not has_friction())
    keep_in_place(std::move(fields));
  // Weak, so that they do not slow down convergence along modes with a small
  // stiffness, as of friction that turns
  for (double& spring : *_springs)
    spring *= math::weak_spring;
}

/// Remembers where bodies are, to take off what they drift by.
void FreeBodies::keep_in_place(MotionFields fields)
{
  fields.fix(_bulk->markers());
  const auto u = _bulk->displacements();
  _loose
      = std::make_unique<Loose>(Loose{std::move(fields), {u.begin(), u.end()}});
}

/// Finds the motions that nothing but corners between facets resists, if the
/// forces along them are small.
void FreeBodies::note_neutral(const Motions& motions, std::vector<Rows> rows,
                              std::span<const double> x,
                              std::span<const double> pull,
                              std::span<const double> forces,
                              std::span<const double> of_bulk)
{
  _pressed = std::sqrt(mesh::total(
      ranks(), (math::column(forces) - math::column(of_bulk)).squaredNorm()));
  // Where bodies are held the end of the step decides. At its begin contact may
  // have no forces yet
  const double acting = std::max(_pressed, math::column(pull).norm());
  if (not _is_holding
      and (motions.N.transpose() * math::column(pull)).norm()
              > std::max(_balanced, held_force_max * acting))
    return;
  double size = std::numeric_limits<double>::infinity();
  for (const Rows& some : rows)
  {
    const std::vector<std::int8_t> status = some.contact->status();
    const std::vector<double> sizes = some.contact->facet_size();
    for (const std::int32_t slave : some.slaves)
      if (status[slave] != law::open)
        size = std::min(size, sizes[slave]);
  }
  _neutral = std::make_unique<Neutral>(Neutral{displacements(motions, x),
                                               motions.N, std::move(rows),
                                               mesh::least(ranks(), size)});
}

bool FreeBodies::runs_along(std::span<const double> dx) const
{
  if (not _neutral or _is_holding)
    return false;
  const VectorXd motion = _neutral->N * _neutral->fields.part_of(dx);
  const std::span by(motion.data(), motion.size());
  bool is_far = false;
  for (const Rows& some : _neutral->rows)
    for (std::size_t i = 0; i < some.size() and not is_far; ++i)
      is_far = norm(some.by(by, i)) > run_fraction * _neutral->size;
  return mesh::anywhere(ranks(), is_far);
}

/// Holds bodies where they are, by supports as stiff as the bulk.
void FreeBodies::hold()
{
  _is_holding = true;
  _free_modes = _neutral->fields.size();
  _springs = springs_of(_neutral->fields);
  keep_in_place(_neutral->fields);
  _held = std::make_shared<HeldMotions>(ranks(), _loose->motions, *_springs);
}

double FreeBodies::held_force() const
{
  return _held and _held->force() > _balanced ? _held->force() / _pressed : 0;
}

bool FreeBodies::let_go()
{
  const double force = held_force();
  if (force == 0 or (_has_let_go and force <= held_force_max))
    return false;
  _has_let_go = true;
  _is_holding = false;
  return true;
}

/// The force of length 1 inside the cone of any node on any rank that works
/// most on a motion, along the modes of the bodies; zero if none works.
std::vector<double> FreeBodies::strongest(const std::vector<Rows>& rows,
                                          std::span<const double> motion,
                                          double reach) const
{
  double most = 0;
  std::vector<double> best(motion.size()), row;
  for (const Rows& some : rows)
  {
    const double friction = some.contact->friction_max();
    const std::vector<double> gap = some.contact->closable_gap();
    for (std::size_t i = 0; i < some.size(); ++i)
    {
      if (not(gap[some.slaves[i]] <= reach))
        continue;
      const Vector<3> v = some.by(motion, i), n = some.normal[i],
                      t = along_surface(n, v);
      const double slip = std::sqrt(dot(t, t));
      Vector<3> force = v;
      if (std::isfinite(friction))
        for (int k = 0; k < 3; ++k)
          force[k] = n[k] + (slip > 0 ? friction / slip * t[k] : 0);
      const double size = std::sqrt(dot(force, force));
      if (not(size > 0) or not(dot(force, v) > most * size))
        continue;
      most = dot(force, v) / size;
      for (double& f : force)
        f /= size;
      some.in_direction(force, i, row);
      std::ranges::fill(best, 0);
      for (std::size_t e = some.offsets[i]; e < some.offsets[i + 1]; ++e)
        for (int p = 0; p < some.m; ++p)
          best[some.bodies[e] * some.m + p]
              = row[(e - some.offsets[i]) * some.m + p];
    }
  }
  const double largest = mesh::largest(ranks(), most);
  const int mine = most == largest ? ranks().size() - ranks().rank() : 0;
  if (mesh::largest<std::int64_t>(ranks(), mine) != mine)
    std::ranges::fill(best, 0);
  ranks().reduce(std::span(best), Reduction::sum);
  return best;
}

bool FreeBodies::may_balance(const Forces& forces, double reach) const
{
  if (not any_free())
    return true;
  const std::span<const double> x = positions();
  const std::vector<double> loads = along(x, forces.of_bulk(), 1);
  const std::vector<Rows> rows = this->rows(x);
  const MatrixXd N = free_basis({}, false).N;
  const VectorXd needed = N.transpose() * math::column(loads);
  // Without loads forces that are as small as rounding balance
  if (needed.norm() <= math::negligible_part * forces.scale())
    return true;
  MatrixXd rays(N.cols(), 0);
  VectorXd shares(0), left = needed;
  for (int k = 0; k < max_rays; ++k)
  {
    if (left.norm() <= balanced_force_max * needed.norm())
      return true;
    const VectorXd motion = N * left;
    const std::vector<double> force
        = strongest(rows, {motion.data(), std::size_t(motion.size())}, reach);
    const VectorXd ray = N.transpose() * math::column(force);
    if (not(ray.dot(left) > math::equal_rel_tol * ray.norm() * left.norm()))
      return false;
    rays.conservativeResize(Eigen::NoChange, rays.cols() + 1);
    rays.rightCols(1) = ray;
    shares.conservativeResize(rays.cols());
    shares.tail(1).setZero();
    while (true)
    {
      const VectorXd next = rays.colPivHouseholderQr().solve(needed);
      double part = 1;
      for (Eigen::Index i = 0; i < next.size(); ++i)
        if (next[i] <= 0)
          part = std::min(part, shares[i] / (shares[i] - next[i]));
      shares += part * (next - shares);
      if (part == 1)
        break;
      // Rays that pull are left out
      Eigen::Index kept = 0;
      for (Eigen::Index i = 0; i < shares.size(); ++i)
        if (next[i] > 0 or shares[i] > math::equal_rel_tol * shares.maxCoeff())
        {
          rays.col(kept) = rays.col(i);
          shares[kept++] = shares[i];
        }
      rays.conservativeResize(Eigen::NoChange, kept);
      shares.conservativeResize(kept);
    }
    left = needed - rays * shares;
  }
  return true;
}

std::optional<std::vector<double>> FreeBodies::drift()
{
  if (not _loose)
    return std::nullopt;
  const auto now = _bulk->displacements();
  const std::size_t n = _bodies->map().num_owned() * _modes->gdim();
  ranks().agree(
      [&]
      {
        if (now.size() != n or _loose->before.size() != n)
          throw std::invalid_argument("displacements must have a value for "
                                      "each owned dof");
      });
  std::vector<double> step(n);
  for (std::size_t i = 0; i < n; ++i)
    step[i] = now[i] - _loose->before[i];
  return _loose->motions.displacements(_loose->motions.part_of(step), n);
}

double FreeBodies::turned() const
{
  if (not _modes or not _bulk->is_linear())
    return 0;
  const std::size_t g = _modes->gdim(), m = _modes->modes_per_body();
  const auto x = _bulk->reference(), u = _bulk->displacements();
  const auto body = _modes->body();
  const std::vector<double> work = along(x, u, 1);
  // One beside the other
  MatrixXd grams = MatrixXd::Zero(m, _modes->count() * m);
  std::array<double, 18> modes;
  for (std::size_t i = 0; i < u.size() / g; ++i)
  {
    _modes->at(static_cast<std::int32_t>(i), x, modes.data());
    const Eigen::Map<const MatrixXd> at(modes.data(), m, g);
    grams.middleCols(body[i] * m, m) += at * at.transpose();
  }
  if (ranks().size() > 1)
    ranks().reduce(std::span(grams.data(), grams.size()), Reduction::sum);
  double most = 0;
  for (std::size_t b = 0; b < _modes->count(); ++b)
  {
    if (_modes->free()[b].cols() == 0)
      continue;
    const VectorXd motion = combined(grams.middleCols(b * m, m),
                                     math::column(work).segment(b * m, m));
    most = std::max(most, motion.tail(m - g).norm() / _modes->radius(b));
  }
  return most;
}

/// Close the nodes of bodies on weak supports that touch before the supports
/// stop them: a Newton step would carry the bodies through their masters.
bool FreeBodies::close_before_springs(const std::vector<Rows>& rows,
                                      std::span<const double> pull)
{
  const MatrixXd Z = by_body(_modes->weak());
  std::vector<double> stiffness;
  for (const std::vector<double>& some : _modes->stiffness())
    stiffness.insert(stiffness.end(), some.begin(), some.end());
  bool closed_any = false;
  while (true)
  {
    const Motions motions = free_basis(rows, true);
    const MatrixXd N = motions.N.leftCols(motions.num_free);
    if (N.cols() == 0)
      break;
    const MatrixXd combine = Z.transpose() * N;
    const MatrixXd stiff = math::column(stiffness).asDiagonal() * combine;
    const VectorXd motion = N
                            * combined(combine.transpose() * stiff,
                                       N.transpose() * math::column(pull));
    const std::span increment(motion.data(), motion.size());
    if (largest_size(increment) == 0)
      break;
    std::vector<double> way(pull.size(), 0);
    const std::int64_t closed = close_first(rows, increment, way, 1.0);
    _closed_for_balance += closed;
    if (closed == 0)
      break;
    closed_any = true;
  }
  return closed_any;
}

/// Where free bodies go that give way to what penetrates them, as if they were
/// rigid and each node of theirs a spring.
///
/// Before a body is pressed from both sides nothing but corners between facets
/// resists its motions along the surface.
/// @param[in] is_driven Whether forces act on each body, so that it stays.
/// @param[in] clearance Gap that they leave.
FreeBodies::Room FreeBodies::room(const std::vector<Rows>& rows,
                                  std::span<const std::int8_t> is_driven,
                                  double clearance) const
{
  struct Spring
  {
    std::size_t contact;
    std::int32_t slave;
    double gap;
    bool is_tied;
    std::vector<Eigen::Index> where{};
    std::vector<double> row{};
    bool is_pressed = false;
  };
  std::vector<MatrixXd> bases = _modes->free();
  for (std::size_t b = 0; b < bases.size(); ++b)
    if (is_driven[b] != 0)
      bases[b].resize(bases[b].rows(), 0);
  const std::vector<Eigen::Index> first = first_columns(bases);
  const Eigen::Index count = first.back();
  Room room{{}, 0, std::vector<std::vector<std::int32_t>>(rows.size())};
  if (count == 0)
    return room;
  std::vector<Spring> springs;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const bool is_tied = std::isinf(rows[k].contact->friction_max());
    const std::vector<double> gap = rows[k].contact->closable_gap();
    const auto add = [&](const Vector<3>& direction, std::size_t i, double gap)
    {
      Spring spring{k, rows[k].slaves[i], gap, is_tied};
      rows[k].by_columns(direction, i, bases, first, spring.where, spring.row);
      if (not spring.where.empty())
        springs.push_back(std::move(spring));
    };
    for (std::size_t i = 0; i < rows[k].size(); ++i)
      if (is_tied)
        for (int c = 0; c < rows[k].gdim; ++c)
        {
          Vector<3> axis{};
          axis[c] = 1;
          add(axis, i, 0);
        }
      else if (std::isfinite(gap[rows[k].slaves[i]]))
        add(rows[k].normal[i], i, gap[rows[k].slaves[i]] - clearance);
  }
  VectorXd motion = VectorXd::Zero(count);
  bool changes = true;
  for (int k = 0; changes and k < max_rays; ++k)
  {
    changes = false;
    MatrixXd gram = MatrixXd::Zero(count, count + 1);
    for (Spring& spring : springs)
    {
      double depth = -spring.gap;
      for (std::size_t p = 0; p < spring.row.size(); ++p)
        depth -= spring.row[p] * motion[spring.where[p]];
      if (k == 0 and not spring.is_tied)
        room.depth = std::max(room.depth, depth);
      const bool is_pressed = spring.is_tied or depth > 0;
      changes = changes or spring.is_pressed != is_pressed;
      spring.is_pressed = is_pressed;
      if (not spring.is_pressed)
        continue;
      for (std::size_t p = 0; p < spring.row.size(); ++p)
      {
        for (std::size_t q = 0; q < spring.row.size(); ++q)
          gram(spring.where[p], spring.where[q])
              += spring.row[p] * spring.row[q];
        gram(spring.where[p], count) -= spring.row[p] * spring.gap;
      }
    }
    changes = mesh::anywhere(ranks(), changes);
    if (ranks().size() > 1)
      ranks().reduce(std::span(gram.data(), gram.size()), Reduction::sum);
    const double most = std::max(gram.diagonal().maxCoeff(), 1.0);
    gram.diagonal().array() += corner_resistance * most;
    for (const std::vector<Eigen::Index>& part : parts(gram, first))
      motion(part)
          = gram(part, part).eval().ldlt().solve(gram(part, count)).eval();
  }
  room.depth = mesh::largest(ranks(), room.depth);
  room.motion = by_body(bases) * motion;
  for (const Spring& spring : springs)
    if (spring.is_pressed and not spring.is_tied)
      room.pressed[spring.contact].push_back(spring.slave);
  return room;
}

/// Closes the nodes that are pressed where free bodies that nothing pulls yet
/// give way.
bool FreeBodies::give_way(const std::vector<Rows>& rows,
                          std::span<const double> pull)
{
  Room room = this->room(rows, driven(pull), 0);
  std::int64_t closed = 0;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const std::vector<std::int8_t> status = rows[k].contact->status();
    std::erase_if(room.pressed[k], [&](std::int32_t slave)
                  { return status[slave] != law::open; });
    rows[k].contact->close(room.pressed[k]);
    closed += std::ssize(room.pressed[k]);
  }
  closed = mesh::total(ranks(), closed);
  _closed_for_balance += closed;
  return closed > 0;
}

/// Bodies that a force acts on.
/// @param[in] pull Forces along the modes of the bodies.
std::vector<std::int8_t> FreeBodies::driven(std::span<const double> pull) const
{
  const int m = _modes->modes_per_body();
  std::vector<std::int8_t> is_driven;
  for (std::size_t b = 0; b < _modes->count(); ++b)
    is_driven.push_back(math::column(pull.subspan(b * m, m)).norm()
                        > _balanced);
  return is_driven;
}

bool FreeBodies::any_free() const { return _modes and _modes->any_free(); }

std::optional<FreeBodies::Escape> FreeBodies::escape(const Forces& forces,
                                                     bool is_first)
{
  if (not any_free())
    return std::nullopt;
  const std::span<const double> x = positions();
  const std::size_t g = _modes->gdim(), m = _modes->modes_per_body();
  const auto body = _modes->body();
  const std::vector<double> all = forces.residual(), bulk = forces.of_bulk();
  _balanced = math::negligible_part * forces.scale();
  std::vector<std::int8_t> is_driven = driven(along(x, all, -1));
  // Others are pressed from more than one side
  std::vector<double> pressed(_modes->count());
  for (std::size_t i = 0; i < all.size(); ++i)
    pressed[body[i / g]] += (all[i] - bulk[i]) * (all[i] - bulk[i]);
  if (ranks().size() > 1)
    ranks().reduce(std::span(pressed), Reduction::sum);
  for (std::size_t b = 0; b < pressed.size(); ++b)
    if (std::sqrt(pressed[b]) > _balanced)
      is_driven[b] = 1;
  const double size = math::equal_rel_tol * _modes->size();
  const Room room = this->room(rows(x), is_driven, is_first ? 0 : 2 * size);
  if (not(room.depth > size))
    return std::nullopt;
  Escape found{room.depth, std::vector<double>(all.size())};
  // Linear strains take rotations that are linear in the reference for rigid
  const bool is_linear = _bulk->is_linear();
  for (std::size_t i = 0; i < all.size() / g; ++i)
    _modes->move(static_cast<std::int32_t>(i),
                 is_linear ? _bulk->reference() : x, &room.motion[body[i] * m],
                 not is_linear, &found.increment[g * i]);
  return found;
}

/// Orthonormal basis of the motions that no closed node resists, and behind
/// them of those that little does.
/// @param[in] of_weak Whether they are combined of the modes that little
/// resists, not of those that nothing does.
FreeBodies::Motions FreeBodies::free_basis(const std::vector<Rows>& rows,
                                           bool of_weak) const
{
  const std::vector<MatrixXd>& bases
      = of_weak ? _modes->weak() : _modes->free();
  const std::vector<Eigen::Index> first = first_columns(bases);
  const Eigen::Index count = first.back();
  if (count == 0)
    return {};
  MatrixXd gram = MatrixXd::Zero(count, count);
  std::vector<Eigen::Index> where;
  std::vector<double> row;
  const auto add
      = [&](const Rows& some, const Vector<3>& direction, std::size_t i)
  {
    some.by_columns(direction, i, bases, first, where, row);
    for (std::size_t p = 0; p < row.size(); ++p)
      for (std::size_t q = 0; q < row.size(); ++q)
        gram(where[p], where[q]) += row[p] * row[q];
  };
  for (const Rows& some : rows)
  {
    const std::vector<std::int8_t> status = some.contact->status();
    for (std::size_t i = 0; i < some.size(); ++i)
    {
      const std::int8_t kind = status[some.slaves[i]];
      if (kind == law::open)
        continue;
      add(some, some.normal[i], i);
      if (kind == law::stick)
        for (int k = 0; k < some.gdim; ++k)
        {
          Vector<3> axis{};
          axis[k] = 1;
          add(some, axis, i);
        }
    }
  }
  if (ranks().size() > 1)
    ranks().reduce(std::span(gram.data(), gram.size()), Reduction::sum);
  const std::vector<std::vector<Eigen::Index>> columns = parts(gram, first);
  std::vector<Eigen::SelfAdjointEigenSolver<MatrixXd>> found;
  double most = 1;
  for (const std::vector<Eigen::Index>& of_part : columns)
  {
    found.push_back(math::symmetric_eigen(MatrixXd(gram(of_part, of_part))));
    most = std::max(most, found.back().eigenvalues().maxCoeff());
  }
  std::vector<VectorXd> motions;
  const auto add_between = [&](double least, double largest)
  {
    for (std::size_t k = 0; k < columns.size(); ++k)
      for (std::size_t i = 0; i < columns[k].size(); ++i)
      {
        const double value = found[k].eigenvalues()[i];
        if (not(value > least * most) or not(value <= largest * most))
          continue;
        VectorXd by_columns = VectorXd::Zero(count);
        by_columns(columns[k]) = found[k].eigenvectors().col(i);
        VectorXd& motion = motions.emplace_back(
            bases.size() * std::size_t(_modes->modes_per_body()));
        for (std::size_t b = 0; b < bases.size(); ++b)
          motion.segment(b * bases[b].rows(), bases[b].rows())
              = bases[b] * by_columns.segment(first[b], bases[b].cols());
      }
  };
  add_between(-infinity, math::round_off);
  const Eigen::Index num_free = std::ssize(motions);
  add_between(math::round_off, corner_resistance);
  MatrixXd N(bases.size() * _modes->modes_per_body(), motions.size());
  for (std::size_t k = 0; k < motions.size(); ++k)
    N.col(k) = motions[k];
  return {std::move(N), num_free};
}

/// Shortest of the times that nodes of all ranks need; infinite if there are
/// none.
double FreeBodies::lowest(std::span<const Found> found) const
{
  double lowest = infinity;
  for (const Found& some : found)
    for (const double time : some.times)
      lowest = std::min(lowest, time);
  return mesh::least(ranks(), lowest);
}

/// Close the open nodes that touch first in a rigid motion of the bodies.
/// @param[in] increment The motion: coefficients of each body's modes.
/// @param[in,out] way How far bodies have gone before, by the same
/// coefficients, then with what they go now.
/// @param[in] within Part of the motion that they go.
/// @return Number of nodes closed on all ranks.
std::int64_t FreeBodies::close_first(const std::vector<Rows>& rows,
                                     std::span<const double> increment,
                                     std::vector<double>& way, double within)
{
  const double most = largest_size(increment);
  std::vector<Found> found;
  for (const Rows& some : rows)
  {
    Found& able = found.emplace_back(Found{some.contact, {}, {}});
    const std::vector<std::int8_t> status = some.contact->status();
    const std::vector<double> gap = some.contact->closable_gap();
    for (std::size_t i = 0; i < some.size(); ++i)
    {
      const std::int32_t slave = some.slaves[i];
      if (status[slave] != law::open or not std::isfinite(gap[slave]))
        continue;
      const double speed = -dot(some.normal[i], some.by(increment, i));
      if (not(speed > math::negligible_part * most))
        continue;
      able.slaves.push_back(slave);
      const double left = gap[slave] + dot(some.normal[i], some.by(way, i));
      able.times.push_back(std::max(left, 0.0) / speed);
    }
  }
  const double first = lowest(found);
  if (not std::isfinite(first) or first > within)
    return 0;
  // Nodes that are closer than this touch at once
  const double margin = math::equal_rel_tol * _modes->size() / most;
  std::int64_t count = 0;
  for (const Found& some : found)
  {
    std::vector<std::int32_t> which;
    for (std::size_t i = 0; i < some.slaves.size(); ++i)
      if (some.times[i] <= first + margin)
        which.push_back(some.slaves[i]);
    some.contact->close(which);
    count += std::ssize(which);
  }
  for (std::size_t k = 0; k < way.size(); ++k)
    way[k] += first * increment[k];
  return mesh::total(ranks(), count);
}

/// State of a contact with friction.
/// @param[in] n Number of its slave nodes.
FrictionState FreeBodies::friction_state(const Rows& rows, std::size_t n) const
{
  FrictionState found;
  ranks().agree(
      [&]
      {
        found = rows.contact->friction_state();
        for (const auto* vectors :
             {&found.normal, &found.traction, &found.slip, &found.value})
          if (vectors->size() != n * rows.gdim)
            throw std::invalid_argument("the state of friction must have gdim "
                                        "values for each slave node");
        if (found.area.size() != n or found.has_friction.size() != n)
          throw std::invalid_argument("the state of friction must have an area "
                                      "and a bound for each slave node");
      });
  return found;
}

/// Forces of Coulomb's law at slipping nodes minus those of the iterate's
/// tractions, along the modes of the bodies (shape=(num_bodies, m)).
///
/// Newton steps balance bodies with tractions that are not yet on the cone.
std::vector<double>
FreeBodies::cone_deficit(const std::vector<Rows>& rows) const
{
  const std::size_t m = _modes->modes_per_body();
  std::vector<double> sums(_modes->count() * m), row;
  for (const Rows& some : rows)
  {
    if (not some.contact->has_friction())
      continue;
    const std::vector<std::int8_t> status = some.contact->status();
    const FrictionState friction_state
        = this->friction_state(some, status.size());
    for (std::size_t i = 0; i < some.size(); ++i)
    {
      const std::int32_t slave = some.slaves[i];
      if (status[slave] != law::slip)
        continue;
      const Vector<3> force = along_surface(
          some.normal[i], vector_at(friction_state.value, slave, some.gdim));
      some.in_direction(force, i, row);
      for (std::size_t e = some.offsets[i]; e < some.offsets[i + 1]; ++e)
        for (std::size_t p = 0; p < m; ++p)
          sums[some.bodies[e] * m + p] -= row[(e - some.offsets[i]) * m + p];
    }
  }
  if (ranks().size() > 1)
    ranks().reduce(std::span(sums), Reduction::sum);
  return sums;
}

/// Stick the slipping nodes whose slip a rigid motion of the bodies reverses
/// first. Slip to both sides may balance a body that slip along its motion
/// alone does not.
/// @param[in] increment The motion: coefficients of each body's modes.
/// @return Whether any sticks on any rank.
bool FreeBodies::stick_first(const std::vector<Rows>& rows,
                             std::span<const double> increment)
{
  const double most = largest_size(increment);
  std::vector<Found> found;
  for (const Rows& some : rows)
  {
    if (not some.contact->has_friction())
      continue;
    const int g = some.gdim;
    Found& able = found.emplace_back(Found{some.contact, {}, {}});
    const std::vector<std::int8_t> status = some.contact->status();
    const FrictionState friction_state
        = this->friction_state(some, status.size());
    for (std::size_t i = 0; i < some.size(); ++i)
    {
      const std::int32_t slave = some.slaves[i];
      if (status[slave] != law::slip or friction_state.has_friction[slave] == 0)
        continue;
      // Traction of the node by Coulomb's law
      const Vector<3> excess
          = along_surface(vector_at(friction_state.normal, slave, g),
                          vector_at(friction_state.value, slave, g));
      Vector<3> cone = vector_at(friction_state.traction, slave, g);
      for (int k = 0; k < g; ++k)
        cone[k] -= excess[k] / friction_state.area[slave];
      const Vector<3> movement
          = along_surface(some.normal[i], some.by(increment, i));
      const double speed = std::sqrt(dot(movement, movement));
      // Slip goes against the traction, also where it has only just begun
      if (not(dot(cone, movement) > 0 and speed > math::negligible_part * most))
        continue;
      const Vector<3> slip = vector_at(friction_state.slip, slave, g);
      able.slaves.push_back(slave);
      able.times.push_back(std::sqrt(dot(slip, slip)) / speed);
      able.tractions.insert(able.tractions.end(), cone.begin(),
                            cone.begin() + g);
    }
  }
  const double first = lowest(found);
  if (not std::isfinite(first))
    return false;
  const std::size_t g = _modes->gdim();
  for (const Found& some : found)
  {
    std::vector<std::int32_t> which;
    std::vector<double> tractions;
    for (std::size_t i = 0; i < some.slaves.size(); ++i)
      if (some.times[i] <= first * (1 + math::equal_rel_tol))
      {
        which.push_back(some.slaves[i]);
        tractions.insert(tractions.end(), &some.tractions[i * g],
                         &some.tractions[i * g] + g);
      }
    // With the traction of slip: more than that must not pass for a solution
    some.contact->set_tractions(which, tractions);
    some.contact->close(which);
  }
  return true;
}
