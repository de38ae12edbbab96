// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "impact.h"
#include "../check.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

using namespace contactx;
using namespace contactx::solve;

namespace
{
// Bounds of loops, reached with redundant constraints alone
constexpr int max_solves = 30;
constexpr int max_cg_iterations = 1000;
constexpr int max_node_releases = 3;

/// A closed slave node.
struct Node
{
  std::size_t contact, place; ///< which one of which contact
  bool is_normal;             ///< constrained along the normal alone
  bool pulls;                 ///< whether its impulse may have any sign
  bool held = true;           ///< whether its velocity is prescribed
  int releases = 0;           ///< how often it was released
  Vector<3> normal{}, mobile{}, target{};
  Vector<3> given{}; ///< impulse of the step's multipliers
  Vector<3> sum{};   ///< impulse so far
  Vector<3> along{}; ///< tangential impulse of a slipping node over its normal
  std::vector<std::pair<std::int32_t, double>> weights;

  double normal_part(const Vector<3>& v) const
  {
    return normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2];
  }

  /// Part of a velocity that is prescribed.
  Vector<3> constrained(const Vector<3>& v) const
  {
    if (not held)
      return {};
    Vector<3> part{};
    const double size = normal_part(v);
    for (int k = 0; k < 3; ++k)
      part[k] = is_normal ? size * normal[k] : mobile[k] * v[k];
    return part;
  }
};

using Vectors = std::vector<Vector<3>>;

/// Velocities of nodes relative to their masters, or displacements.
/// @param[in] values Those of all owned nodes (shape=(num_owned, gdim)).
Vectors relative(const mesh::Halo& halo, const std::vector<Node>& nodes,
                 std::span<const double> values)
{
  const int g = halo.gdim();
  std::vector<double> every(std::size_t(halo.num_nodes()) * g, 0);
  std::ranges::copy(values, every.begin());
  halo.forward(every, g);
  Vectors result(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const auto& [node, weight] : nodes[i].weights)
      for (int k = 0; k < g; ++k)
        result[i][k] += weight * every[std::size_t(node) * g + k];
  return result;
}

/// Closed nodes and what impulses on them do.
class Velocities
{
public:
  Velocities(const mesh::Halo& halo, std::vector<Node> nodes,
             std::span<double> velocity, const Impact::SolveMass& solve)
      : _halo(halo), _nodes(std::move(nodes)), _velocity(velocity),
        _solve(solve), _g(halo.gdim())
  {
    double largest = 0;
    for (const double v : velocity)
      largest = std::max(largest, std::abs(v));
    for (const Node& node : _nodes)
      for (const double v : node.target)
        largest = std::max(largest, std::abs(v));
    _small = math::round_off * mesh::largest(_halo.ranks(), largest)
             * std::sqrt(mesh::total(_halo.ranks(),
                                     static_cast<double>(_nodes.size())));
  }

  std::vector<Node>& nodes() { return _nodes; }

  /// Gives constrained nodes their velocities: conjugate gradients.
  void hold()
  {
    Vectors left = relative(_velocity);
    for (std::size_t i = 0; i < left.size(); ++i)
    {
      for (int k = 0; k < 3; ++k)
        left[i][k] = _nodes[i].target[k] - left[i][k];
      left[i] = _nodes[i].constrained(left[i]);
    }
    Vectors increment = left;
    double size = product(left, left);
    for (int n = 0; n < max_cg_iterations and std::sqrt(size) > _small; ++n)
    {
      const std::vector<double> more = pushed(increment);
      Vectors change = relative(more);
      for (std::size_t i = 0; i < change.size(); ++i)
        change[i] = _nodes[i].constrained(change[i]);
      const double work = product(increment, change);
      // Fixed by prescribed displacements
      if (not(work > 0))
        return;
      const double part = size / work;
      for (std::size_t j = 0; j < more.size(); ++j)
        _velocity[j] += part * more[j];
      for (std::size_t i = 0; i < increment.size(); ++i)
        for (int k = 0; k < 3; ++k)
        {
          _nodes[i].sum[k] += part * increment[i][k];
          left[i][k] -= part * change[i][k];
        }
      const double before = std::exchange(size, product(left, left));
      for (std::size_t i = 0; i < increment.size(); ++i)
        for (int k = 0; k < 3; ++k)
          increment[i][k] = left[i][k] + size / before * increment[i][k];
    }
  }

  /// Lets go of what would be pulled, holds again what then approaches, and
  /// brings friction up to the normal impulses; returns whether anything has
  /// changed.
  bool adjust()
  {
    Vectors more(_nodes.size());
    const Vectors speed = relative(_velocity);
    bool changes = false;
    for (std::size_t i = 0; i < _nodes.size(); ++i)
    {
      Node& node = _nodes[i];
      const double p = node.normal_part(node.sum);
      if (node.held and not node.pulls and p < 0)
      {
        node.held = false;
        ++node.releases;
        changes = true;
        for (int k = 0; k < 3; ++k)
          more[i][k] = -node.sum[k];
      }
      else if (not node.held and node.releases < max_node_releases
               and node.normal_part(speed[i]) - node.normal_part(node.target)
                       < -_small)
        node.held = changes = true;
      else if (node.held and node.is_normal)
        for (int k = 0; k < 3; ++k)
        {
          const double tangential = node.sum[k] - p * node.normal[k];
          more[i][k] = p * node.along[k] - tangential;
          changes
              = changes
                or std::abs(more[i][k])
                       > math::round_off * std::abs(p) * std::abs(node.along[k])
                             + std::abs(tangential) * math::round_off;
        }
      for (int k = 0; k < 3; ++k)
        node.sum[k] += more[i][k];
    }
    if (not mesh::anywhere(_halo.ranks(), changes))
      return false;
    const std::vector<double> change = pushed(more);
    for (std::size_t j = 0; j < change.size(); ++j)
      _velocity[j] += change[j];
    return true;
  }

private:
  double product(const Vectors& a, const Vectors& b) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (int k = 0; k < 3; ++k)
        sum += a[i][k] * b[i][k];
    return mesh::total(_halo.ranks(), sum);
  }

  /// Changes of velocities by impulses on the nodes.
  std::vector<double> pushed(const Vectors& impulses) const
  {
    std::vector<double> values(std::size_t(_halo.num_nodes()) * _g, 0);
    for (std::size_t i = 0; i < _nodes.size(); ++i)
      for (const auto& [node, weight] : _nodes[i].weights)
        for (int k = 0; k < _g; ++k)
          values[std::size_t(node) * _g + k] += weight * impulses[i][k];
    _halo.reverse(values, _g);
    values.resize(_velocity.size());
    _solve(values);
    return values;
  }

  Vectors relative(std::span<const double> velocity) const
  {
    return ::relative(_halo, _nodes, velocity);
  }

  const mesh::Halo& _halo;
  std::vector<Node> _nodes;
  std::span<double> _velocity;
  const Impact::SolveMass& _solve;
  int _g;
  double _small;
};

/// Closed nodes of a contact.
void add_nodes(const contact::Contact& contact, std::size_t number, double dt,
               std::vector<Node>& all)
{
  const law::NodeState& state = *contact.nodes();
  const int g = state.gdim();
  const std::vector<double> normals = contact.master()->normals();
  const std::vector<double> movement = contact.master()->movement();
  std::vector<std::int32_t> place(state.num_nodes(), -1);
  for (std::int32_t i = 0; i < state.num_nodes(); ++i)
  {
    if (not state.closed(i))
      continue;
    const bool is_tied = contact.law()->is_tied();
    Node node{.contact = number,
              .place = std::size_t(i),
              .is_normal = state.status[i] == law::slip,
              .pulls = is_tied,
              .weights = {}};
    for (int k = 0; k < g; ++k)
    {
      const std::size_t at = std::size_t(g) * i + k;
      node.normal[k] = state.is_vector() ? state.normal[at]
                                         : normals[3 * std::size_t(i) + k];
      node.mobile[k] = state.is_vector() ? state.mobile[at] : 1;
      node.target[k] = movement.empty() ? 0 : movement[at] / dt;
    }
    const double size = dt * state.area[i];
    for (int k = 0; k < g; ++k)
      node.given[k]
          = size
            * (state.is_vector() ? state.multiplier[std::size_t(g) * i + k]
                                 : state.multiplier[i] * node.normal[k]);
    node.sum = node.given;
    const double p = node.normal_part(node.given);
    if (node.is_normal and state.is_vector() and p > 0)
      for (int k = 0; k < g; ++k)
        node.along[k] = node.given[k] / p - node.normal[k];
    place[i] = static_cast<std::int32_t>(all.size());
    all.push_back(std::move(node));
  }
  const kernel::Weights weights = contact.master()->weights();
  for (std::size_t e = 0; e < weights.slaves.size(); ++e)
    if (const std::int32_t i = weights.slaves[e];
        i < state.num_nodes() and place[i] >= 0)
      all[place[i]].weights.emplace_back(weights.nodes[e], weights.values[e]);
}
} // namespace

Impact::Impact(std::shared_ptr<mesh::Halo> halo, Contacts contacts)
    : _halo(std::move(halo)), _contacts(std::move(contacts))
{
  if (not _halo
      or std::ranges::any_of(_contacts,
                             [](const auto& contact) { return not contact; }))
    throw std::invalid_argument("halo and contacts must not be empty");
}

void Impact::correct(double dt, std::span<double> velocity,
                     const SolveMass& solve)
{
  if (not(std::isfinite(dt) and dt > 0))
    throw std::invalid_argument("dt must be a finite number above 0");
  const int g = _halo->gdim();
  if (velocity.size() != std::size_t(_halo->num_owned()) * g)
    throw std::invalid_argument(
        "velocity must have a value for each displacement of this rank");
  std::vector<Node> closed;
  _impulses.clear();
  for (std::size_t c = 0; c < _contacts.size(); ++c)
  {
    _impulses.emplace_back(std::size_t(_contacts[c]->nodes()->num_nodes()) * g,
                           0.0);
    add_nodes(*_contacts[c], c, dt, closed);
  }
  _corrections = _impulses;
  if (not mesh::anywhere(_halo->ranks(), not closed.empty()))
    return;
  Velocities velocities(*_halo, std::move(closed), velocity, solve);
  for (int n = 0; n < max_solves; ++n)
  {
    velocities.hold();
    if (not velocities.adjust())
      break;
  }
  for (const Node& node : velocities.nodes())
    for (int k = 0; k < g; ++k)
    {
      const std::size_t at = std::size_t(g) * node.place + k;
      _impulses[node.contact][at] = node.sum[k];
      _corrections[node.contact][at] = node.sum[k] - node.given[k];
    }
}

void Impact::begin_step()
{
  _was_closed.clear();
  for (const auto& contact : _contacts)
  {
    const law::NodeState& state = *contact->nodes();
    std::vector<std::int8_t> closed(state.num_nodes());
    for (std::int32_t i = 0; i < state.num_nodes(); ++i)
      closed[i] = state.closed(i);
    _was_closed.push_back(std::move(closed));
  }
}

double Impact::arrival(std::span<const double> increment,
                       std::span<const double> cell_sizes) const
{
  const std::size_t n = _halo->num_owned();
  _halo->ranks().agree(
      [&]
      {
        check::rows(increment.size(), n, _halo->gdim(), "way", "owned node");
        check::rows(cell_sizes.size(), n, 1, "cell_sizes", "owned node");
        check::require(_was_closed.size() == _contacts.size(),
                       "begin_step must come before arrival");
      });
  std::vector<Node> closed, arrived;
  for (std::size_t c = 0; c < _contacts.size(); ++c)
    add_nodes(*_contacts[c], c, 1, closed);
  for (Node& node : closed)
    if (not _was_closed[node.contact][node.place])
      arrived.push_back(std::move(node));
  const Vectors moved = relative(*_halo, arrived, increment);
  double most = 0;
  for (std::size_t i = 0; i < arrived.size(); ++i)
  {
    const Node& node = arrived[i];
    const double travel
        = node.normal_part(moved[i]) - node.normal_part(node.target);
    const std::int32_t slave
        = _contacts[node.contact]->slaves().owned()[node.place];
    most = std::max(most, std::abs(travel) / cell_sizes[slave]);
  }
  return mesh::largest(_halo->ranks(), most);
}
