// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include "../mesh/extent.h"
#include "deformable_master.h"
#include "mobility.h"
#include "obstacle_pairs.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace contactx;
using namespace contactx::contact;

namespace
{
std::string_view name_of(Sliding sliding)
{
  return sliding == Sliding::small ? "small" : "finite";
}

void require(bool fits, const char* what)
{
  if (not fits)
    throw std::invalid_argument(what);
}
} // namespace

Contact::Contact(std::shared_ptr<mesh::Halo> halo,
                 std::shared_ptr<const SlaveNodes> slaves,
                 std::shared_ptr<Master> master, std::shared_ptr<law::Law> law,
                 Options options)
    : _halo(std::move(halo)), _slaves(std::move(slaves)),
      _master(std::move(master)), _law(std::move(law)),
      _options(std::move(options)),
      _is_frozen(_options.sliding == Sliding::small)
{
  const auto owned = _slaves->owned();
  const auto n = static_cast<std::int32_t>(owned.size());
  require(_options.prescribed.size() == std::size_t(_halo->num_bulk()) * gdim(),
          "prescribed must have a value for each displacement of the bulk");
  require(_options.shared.empty()
              or _options.shared.size() == std::size_t(_halo->num_owned()),
          "shared must have a value for each owned node");
  _nodes = std::make_shared<law::NodeState>(n, gdim(), _law->is_vector(),
                                            _master->integrates());
  if (_law->is_vector() and not _law->is_tied())
  {
    _history = std::make_shared<law::SlipHistory>(n, gdim());
    if (auto* coulomb = dynamic_cast<law::Coulomb*>(_law.get()))
      coulomb->follow(_history);
  }
  _touched.assign(n, 0);
  _had_master.assign(n, 0);
  for (auto* values : {&_given, &_adjusted, &_offset})
    values->assign(n, 0);
  _is_left_out.assign(n, 0);
  if (not _options.shared.empty())
    for (std::int32_t i = 0; i < n; ++i)
      _is_left_out[i] = _options.shared[owned[i]];
  leave_out_empty();
  nodes_changed();
  _observer = _halo->on_change([this] { nodes_changed(); });
  take_start();
  const auto reference = _halo->reference();
  const std::vector<double> x(reference.begin(), reference.end());
  const std::vector<std::int8_t> open(n, 0);
  if (_master->is_rigid())
    _halo->ranks().agree([&] { _master->search(x, open); });
  else
    _master->search(x, open);
  find_front();
  _master->begin_step();
  take(_master->pairs());
  find_immobile();
  find_rest();
  if (_options.adjust)
    find_adjusted(*_options.adjust);
}

kernel::Law Contact::kernel_law() const
{
  if (_law->is_tied())
    return kernel::Law::tied;
  return _law->is_vector() ? kernel::Law::frictional
                           : kernel::Law::frictionless;
}

/// Finds what ties measure as movement where nothing has moved: integration
/// points of curved facets and what they are projected on are apart along the
/// surface, too.
void Contact::find_rest()
{
  if (not _law->is_tied() or not _master->integrates() or _master->is_rigid())
    return;
  const auto reference = _halo->reference();
  const std::vector<double> still(reference.size(), 0);
  assemble("slip", still, _nodes->slip);
  _rest = _nodes->slip;
  std::ranges::fill(_nodes->slip, 0.0);
  double most = 0;
  for (const double v : reference)
    most = std::max(most, std::abs(v));
  // Straight facets have no more than rounding errors
  if (std::ranges::all_of(_rest, [most](double v)
                          { return std::abs(v) <= math::round_off * most; }))
    _rest.clear();
}

std::vector<double> Contact::at_slaves(std::span<const double> x) const
{
  const auto owned = _slaves->owned();
  std::vector<double> rows(owned.size() * gdim());
  for (std::size_t i = 0; i < owned.size(); ++i)
    std::copy_n(x.begin() + std::size_t(owned[i]) * gdim(), gdim(),
                rows.begin() + gdim() * i);
  return rows;
}

void Contact::set_offset(std::span<const double> offset)
{
  require(offset.size() == _offset.size(),
          "offset must have a value for each slave node");
  if (std::ranges::equal(offset, _given))
    return;
  _given.assign(offset.begin(), offset.end());
  sum_offset();
  _evaluated_version = -1;
}

void Contact::sum_offset()
{
  std::ranges::transform(_given, _adjusted, _offset.begin(), std::plus());
  const std::vector<double> rise = _master->rise();
  if (not rise.empty())
    std::ranges::transform(_offset, rise, _offset.begin(), std::plus());
}

/// Finds the gaps and overlaps that count as none.
void Contact::find_adjusted(double length)
{
  _halo->ranks().agree(
      [&]
      {
        require(std::isfinite(length) and length >= 0,
                "adjust must be a finite length of at least 0");
        require(not _law->is_tied(),
                "adjust is not for ties, which keep the gaps of the reference "
                "configuration as they are: leave it out");
        const auto reference = _halo->reference();
        std::vector<double> gap(_offset.size());
        assemble("gap", std::vector<double>(reference.size(), 0), gap);
        const std::vector<std::int8_t> paired = _master->paired();
        for (std::size_t i = 0; i < gap.size(); ++i)
        {
          const double left = gap[i] - _offset[i];
          _adjusted[i] = paired[i] and std::abs(left) <= length ? left : 0;
        }
      });
  sum_offset();
}

void Contact::set_active(bool is_active)
{
  _is_active = is_active;
  _evaluated_version = -1;
}

void Contact::set_prescribed(std::span<const std::int8_t> prescribed)
{
  _halo->ranks().agree(
      [&]
      {
        require(prescribed.size() == _options.prescribed.size(),
                "prescribed must have a value for each displacement of the "
                "bulk");
      });
  _options.prescribed.assign(prescribed.begin(), prescribed.end());
  find_free();
  find_immobile();
  ++_version;
}

void Contact::nodes_changed()
{
  find_free();
  _master->nodes_changed();
}

/// Finds the displacements of all nodes that no Dirichlet condition prescribes.
void Contact::find_free()
{
  std::vector<std::int64_t> marks(std::size_t(_halo->num_nodes()) * gdim(), 0);
  std::copy_n(_options.prescribed.begin(),
              std::size_t(_halo->num_owned()) * gdim(), marks.begin());
  _halo->forward(std::span(marks), gdim());
  _free.resize(marks.size());
  std::ranges::transform(marks, _free.begin(),
                         [](std::int64_t mark) { return mark == 0; });
}

void Contact::begin_step()
{
  _skipped_searches = 0;
  _multiplier = _nodes->multiplier;
  _law->begin_step();
  _master->rebuild();
  freeze(false);
  turn_tractions();
  _master->begin_step();
  for (std::size_t i = 0; i < _touched.size(); ++i)
    _touched[i] = _nodes->closed(i);
  _is_predicted = false;
  std::ranges::fill(_nodes->slip_reversals, 0);
  std::ranges::fill(_nodes->slip_closings, 0);
  if (sliding() == Sliding::small and _master->is_rigid())
  {
    const auto reference = _halo->reference();
    pair(std::vector<double>(reference.begin(), reference.end()));
  }
  else
    take(_master->pairs());
}

/// Turns the tractions with a master that has turned since, as a better start.
void Contact::turn_tractions()
{
  if (not _history or not updates_kinematics())
    return;
  const auto turn = _master->turn(_halo->now()->x);
  if (not turn)
    return;
  const int g = gdim();
  for (std::int32_t i = 0; i < _nodes->num_nodes(); ++i)
  {
    double* t = _nodes->multiplier.data() + std::size_t(g) * i;
    Vector<3> before{};
    std::copy_n(t, g, before.begin());
    for (int r = 0; r < g; ++r)
    {
      t[r] = 0;
      for (int c = 0; c < g; ++c)
        t[r] += (*turn)[g * (std::size_t(g) * i + r) + c] * before[c];
    }
  }
}

void Contact::accept()
{
  take_start();
  _nodes->before = _multiplier;
  const std::vector<double> front = _front, area = _nodes->area;
  find_front();
  if (mesh::anywhere(_halo->ranks(), front != _front))
  {
    take(_master->pairs());
    // Forces stay
    const int size = _nodes->size();
    for (std::size_t i = 0; i < area.size(); ++i)
      for (int k = 0; k < size; ++k)
        _nodes->multiplier[size * i + k] *= area[i] / _nodes->area[i];
  }
  if (_history)
    _history->add(*_nodes);
}

/// Takes the configuration of now as the start of the next step. All contacts
/// of a halo do so together.
void Contact::take_start()
{
  _halo->accept();
  _halo->ranks().agree([&] { _master->accept(_halo->start()->x); });
}

void Contact::rebuild()
{
  _is_frozen = sliding() == Sliding::small;
  find_front();
  take(_master->pairs());
}

/// Finds which part of the slave nodes' area is in front of the master.
void Contact::find_front()
{
  const int g = gdim();
  const auto reference = _halo->reference();
  const auto now = _halo->now();
  const std::vector<double> normals = _master->normals();
  std::vector<double> normal(normals.size() / 3 * g);
  for (std::size_t i = 0; i < normals.size() / 3; ++i)
    std::copy_n(normals.begin() + 3 * i, g, normal.begin() + g * i);
  const std::vector<double> corners = _slaves->facing_areas(
      reference, sliding() == Sliding::small ? reference : std::span(now->x),
      normal, g);
  _front = _slaves->sums(corners);
  std::vector<std::int8_t> faces(corners.size());
  std::ranges::transform(corners, faces.begin(),
                         [](double area) { return area > 0; });
  _halo->ranks().agree([&] { _master->set_front_facets(faces); });
}

/// Slave nodes of quadratic facets that have no area take no force: their
/// multipliers are zero, of equations that are not.
void Contact::leave_out_empty()
{
  _filler.assign(_touched.size(), 0);
  if (not _slaves->is_quadratic())
    return;
  const std::vector<double> area = _slaves->sums(geometry::corner_areas(
      _slaves->local(), _slaves->here(_halo->reference(), gdim(), "x"), gdim(),
      _slaves->shares()));
  const double most = mesh::largest(_halo->ranks(),
                                    area.empty() ? 0 : std::ranges::max(area));
  for (std::size_t i = 0; i < area.size(); ++i)
    if (area[i] == 0)
    {
      _is_left_out[i] = 1;
      _filler[i] = math::equal_rel_tol * most;
    }
}

void Contact::take(std::vector<kernel::Pairs> pairs)
{
  // Views of the array stay valid
  std::ranges::copy(_master->area(_front), _nodes->area.begin());
  for (std::size_t i = 0; i < _filler.size(); ++i)
    if (_filler[i] > 0)
      _nodes->area[i] = _filler[i];
  sum_offset();
  _pairs.clear();
  for (kernel::Pairs& p : pairs)
    _pairs.push_back(std::make_shared<kernel::Pairs>(std::move(p)));
  ++_version;
}

void Contact::set_factor(std::span<const double> compliance)
{
  require(compliance.size() == std::size_t(_halo->num_nodes()),
          "compliance must have a value for each node");
  std::vector<double> of_pairs = _master->compliance(compliance);
  const auto owned = _slaves->owned();
  for (std::size_t i = 0; i < owned.size(); ++i)
    of_pairs[i] = compliance[owned[i]] + of_pairs[i];
  _nodes->set_factor(_halo->ranks(), of_pairs);
}

std::vector<std::int32_t> Contact::constrained_inside(std::span<const double> x)
{
  const auto* master = dynamic_cast<const ObstacleMaster*>(_master.get());
  if (not master or _law->is_tied() or not _is_active)
    return {};
  std::vector<double> gap, at;
  _halo->ranks().agree(
      [&]
      {
        gap = master->inside(x);
        at = at_slaves(x);
      });
  const double size
      = std::ranges::max(mesh::extent(_halo->ranks(), at, gdim()));
  std::vector<std::int32_t> nodes;
  for (std::size_t i = 0; i < gap.size(); ++i)
    if (_nodes->immobile[i]
        and gap[i] - _offset[i] < -math::equal_rel_tol * size)
      nodes.push_back(_slaves->owned()[i]);
  return nodes;
}

bool Contact::has_unknown_motion()
{
  const auto* master = dynamic_cast<const ObstacleMaster*>(_master.get());
  if (not master or not _is_active)
    return false;
  const double size = std::ranges::max(
      mesh::extent(_halo->ranks(), at_slaves(_halo->reference()), gdim()));
  bool moves = false;
  _halo->ranks().agree(
      [&] { moves = master->has_unknown_motion(math::round_off * size); });
  const bool touches = std::ranges::any_of(_nodes->status, [](std::int8_t s)
                                           { return s != law::open; });
  // Both are asked on all ranks
  const bool is_touched = mesh::anywhere(_halo->ranks(), touches);
  return mesh::anywhere(_halo->ranks(), moves) and is_touched;
}

std::int32_t Contact::search()
{
  if (_is_frozen or not updates_kinematics())
  {
    ++_skipped_searches;
    return 0;
  }
  const auto now = _halo->now();
  return pair(now->x);
}

std::int32_t Contact::pair(std::span<const double> x)
{
  std::vector<std::int8_t> closed(_nodes->num_nodes());
  for (std::size_t i = 0; i < closed.size(); ++i)
    closed[i] = _nodes->closed(i);
  std::int32_t changed = 0;
  // Errors of an obstacle's function are raised on all ranks
  if (_master->is_rigid())
    _halo->ranks().agree([&] { _master->search(x, closed); });
  else
    changed = _master->search(x, closed);
  take(_master->pairs());
  find_immobile();
  return changed;
}

void Contact::find_immobile()
{
  const Mobility found = _master->mobility(_free);
  const std::vector<std::int8_t> paired = _master->paired();
  for (std::size_t i = 0; i < paired.size(); ++i)
    // Dirichlet conditions leave nothing of the motion along the normal free
    _nodes->immobile[i] = paired[i] and found.normal[i] < math::equal_rel_tol;
  for (std::size_t k = 0; k < _nodes->mobile.size(); ++k)
    _nodes->mobile[k] = found.each[k] < mobile_fraction_min ? 0 : 1;
}

void Contact::freeze(bool is_frozen)
{
  if (not updates_kinematics() or is_frozen == _is_frozen)
    return;
  _is_frozen = is_frozen;
  take(_master->pairs());
}

void Contact::update_gap()
{
  const auto now = _halo->now();
  // Each rank finds on its own whether it has anything to do
  _halo->ranks().agree(
      [&]
      {
        if (_evaluated_version == _version and _evaluated == now)
          return;
        if (auto fresh = _master->update(now->x, _is_frozen, _offset))
          take(std::move(*fresh));
        measure_gap(now->u);
        if (_nodes->is_vector())
        {
          assemble("normal", now->u, _nodes->normal);
          _nodes->normalise();
          measure_slip(now->u);
        }
        const std::vector<std::int8_t> paired = _master->paired();
        for (std::size_t i = 0; i < _offset.size(); ++i)
          _nodes->gap[i] = paired[i] and _is_active and not _is_left_out[i]
                               ? _nodes->gap[i] - _offset[i]
                               : std::numeric_limits<double>::quiet_NaN();
        _evaluated = now;
        _evaluated_version = _version;
      });
}

void Contact::measure_gap(std::span<const double> displacement)
{
  if (not measures_displacements())
  {
    assemble("gap", displacement, _nodes->gap);
    return;
  }
  // Rounding errors of the first part are the same at all iterates
  const std::vector<double> still(displacement.size(), 0);
  assemble("gap", still, _nodes->gap);
  std::vector<double> moved(_nodes->gap.size());
  assemble("gap", displacement, moved, still);
  for (std::size_t i = 0; i < moved.size(); ++i)
    _nodes->gap[i] += moved[i];
}

void Contact::measure_slip(std::span<const double> displacement)
{
  // Where it is a difference of displacements, positions are left out
  const std::size_t n = measures_displacements() ? displacement.size() : 0;
  assemble("slip", displacement, _nodes->slip, std::vector<double>(n, 0));
  if (not _law->is_tied())
    _nodes->project(_master->origin());
  if (_rest.empty())
    return;
  const auto reference = _halo->reference();
  std::vector<double> x(reference.begin(), reference.end());
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] += displacement[k];
  const int g = gdim();
  std::vector<double> turn;
  if (kinematics() == Sliding::finite)
    turn = _master->rotations(reference, x);
  for (std::int32_t i = 0; i < _nodes->num_nodes(); ++i)
    for (int r = 0; r < g; ++r)
    {
      double& slip = _nodes->slip[g * i + r];
      if (turn.empty())
        slip -= _rest[g * i + r];
      else
        for (int c = 0; c < g; ++c)
          slip -= turn[g * (std::size_t(g) * i + r) + c] * _rest[g * i + c];
    }
}

/// Arrays that kernels read. Slave nodes of other ranks have no multipliers
/// here, see kernel::Coefficient.
kernel::NodalArrays Contact::arrays(std::span<const double> displacement,
                                    std::array<std::vector<double>, 5>& padded,
                                    std::span<const double> position) const
{
  kernel::NodalArrays a{
      displacement,       position.empty() ? _halo->reference() : position,
      _nodes->multiplier, _nodes->area,
      _nodes->by_gap,     _nodes->by_slip,
      _nodes->by_normal};
  const std::size_t n = _slaves->owned().size(), m = _slaves->around().size();
  if (n == m)
    return a;
  const std::array views{&a.multiplier, &a.area, &a.gap_derivative,
                         &a.slip_derivative, &a.normal_derivative};
  for (std::size_t k = 0; k < views.size(); ++k)
  {
    // Facets without a node of this rank are none of its own: n > 0
    const std::size_t width = views[k]->size() / n;
    padded[k].assign(views[k]->begin(), views[k]->end());
    padded[k].resize(m * width,
                     views[k] == &a.area ? kernel::area_elsewhere : 0.0);
    *views[k] = padded[k];
  }
  return a;
}

/// Values of the owned slave nodes; those of others are of their own ranks.
/// The reference configuration is the halo's where no positions are given.
void Contact::assemble(std::string_view term,
                       std::span<const double> displacement,
                       std::span<double> values,
                       std::span<const double> position) const
{
  std::ranges::fill(values, 0.0);
  std::array<std::vector<double>, 5> padded;
  const kernel::NodalArrays read = arrays(displacement, padded, position);
  for (const auto& pairs : _pairs)
    kernel::add_vector(kernel_law(), name_of(kinematics()), term, *pairs, read,
                       gdim(), values);
}

void Contact::add_residual(std::span<double> b) const
{
  require(b.size() == std::size_t(_halo->num_nodes()) * gdim(),
          "b must have a value for each displacement");
  const auto now = _halo->now();
  std::array<std::vector<double>, 5> padded;
  const kernel::NodalArrays read = arrays(now->u, padded);
  for (const auto& pairs : _pairs)
    kernel::add_vector(kernel_law(), name_of(kinematics()), "residual", *pairs,
                       read, gdim(), b);
}

Triplets Contact::block(std::string_view term,
                        std::span<const std::int8_t> which) const
{
  require(which.empty() or which.size() == _slaves->owned().size(),
          "which must have a value for each slave node");
  const auto now = _halo->now();
  std::array<std::vector<double>, 5> padded;
  const kernel::NodalArrays read = arrays(now->u, padded);
  Triplets all;
  for (const auto& pairs : _pairs)
  {
    Triplets part = kernel::assemble_matrix(kernel_law(), name_of(kinematics()),
                                            term, *pairs, read, gdim(), which);
    if (all.size() == 0)
      all = std::move(part);
    else
      all.join(part);
  }
  return all;
}

Contact::Change Contact::change(std::span<const double> displacement) const
{
  const std::size_t n = _nodes->num_nodes(), size = _nodes->size();
  const int g = gdim();
  // Product of the constraint's block with other derivatives than the law's
  const auto product
      = [&](std::vector<double>& by_gap, std::vector<double>& by_slip,
            std::vector<double>& by_normal)
  {
    if (_nodes->mean)
      _nodes->mean->chain(_nodes->normal, by_slip, by_normal);
    const auto swap = [&]
    {
      std::swap(by_gap, _nodes->by_gap);
      std::swap(by_slip, _nodes->by_slip);
      std::swap(by_normal, _nodes->by_normal);
    };
    swap();
    const Triplets C = block("constraint");
    swap();
    std::vector<double> sum(n * size);
    // Slave nodes of other ranks come last
    for (std::size_t e = 0; e < C.size(); ++e)
      if (std::size_t(C.rows[e]) < sum.size())
        sum[C.rows[e]] += C.values[e] * displacement[C.columns[e]];
    return sum;
  };
  const std::size_t square = n * g * g;
  std::vector<double> by_gap = _nodes->normal, by_slip(square),
                      by_normal(square);
  for (std::size_t i = 0; i < square; i += g * g)
    for (int k = 0; k < g; ++k)
      by_slip[i + k * (g + 1)] = 1;
  // Derivatives by slip and mean normal are chained in place
  const std::vector<double> along = by_slip;
  Change found{product(by_gap, by_slip, by_normal), {}};
  found.normal.assign(n * g, 0);
  if (kinematics() == Sliding::small)
    return found;
  // Kernels leave out nodes whose derivatives by gap and slip are zero
  by_slip = along;
  by_normal = along;
  found.normal = product(by_gap, by_slip, by_normal);
  for (std::size_t k = 0; k < found.normal.size(); ++k)
    found.normal[k] -= found.movement[k];
  return found;
}

void Contact::for_each_pair(std::string_view term,
                            std::span<const std::int8_t> which,
                            const kernel::UsePair& use) const
{
  require(which.empty() or which.size() == _slaves->owned().size(),
          "which must have a value for each slave node");
  const auto now = _halo->now();
  std::array<std::vector<double>, 5> padded;
  const kernel::NodalArrays read = arrays(now->u, padded);
  for (const auto& pairs : _pairs)
    kernel::for_each_pair(kernel_law(), name_of(kinematics()), term, *pairs,
                          read, gdim(), which, use);
}

bool Contact::is_without_gaps() const
{
  const double gap_tol
      = law::touching_gap(_halo->ranks(), at_slaves(_halo->now()->x), gdim());
  const bool any = std::ranges::any_of(_nodes->gap, [gap_tol](double gap)
                                       { return std::abs(gap) > gap_tol; });
  return not mesh::anywhere(_halo->ranks(), any);
}

std::int32_t Contact::update_status(bool is_first)
{
  const std::vector<std::int8_t> before = _nodes->status;
  const std::vector<std::int8_t> closes = closing(is_first);
  if (_history)
    measure_from_touching(touching(closes, is_first));
  _law->set_status(*_nodes, _halo->ranks());
  if (is_first)
  {
    // Nor does round-off decide between stick and slip where nothing presses
    // yet
    const int size = _nodes->size();
    std::vector<std::int32_t> which;
    for (std::size_t i = 0; i < closes.size(); ++i)
    {
      const auto multiplier
          = std::span(_nodes->multiplier).subspan(size * i, size);
      const bool presses
          = std::ranges::any_of(multiplier, [](double m) { return m != 0; });
      if (closes[i] and not(_nodes->closed(i) and presses))
        which.push_back(static_cast<std::int32_t>(i));
    }
    _nodes->close(which);
  }
  std::int32_t changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    changed += before[i] != _nodes->status[i];
  return changed;
}

void Contact::foresee()
{
  if (_history)
    measure_from_touching(touching(closing(false), false));
}

/// Slave nodes whose slip is to be counted from where this iterate touches.
/// That is the step's first one, as later ones depend on more than the loads:
/// what closes later slips from the step's start, unless it had no master then.
std::vector<std::int8_t> Contact::touching(std::span<const std::int8_t> closes,
                                           bool is_first)
{
  const bool is_prediction = not is_first and not _is_predicted;
  std::vector<std::int8_t> first(closes.size());
  for (std::size_t i = 0; i < closes.size(); ++i)
  {
    const bool has_master = not std::isnan(_nodes->gap[i]);
    first[i] = closes[i] and not _touched[i];
    if (is_first)
      _had_master[i] = has_master;
    else if (is_prediction and _had_master[i])
      _touched[i] = 1;
  }
  _is_predicted = _is_predicted or is_prediction;
  return first;
}

void Contact::measure_from_touching(std::span<const std::int8_t> which)
{
  const auto now = _halo->now();
  _halo->ranks().agree(
      [&]
      {
        if (std::ranges::none_of(which, [](std::int8_t w) { return w != 0; }))
          return;
        _master->touch(which, now->x, now->u, _offset);
        for (std::size_t i = 0; i < which.size(); ++i)
          _touched[i] = _touched[i] or which[i];
        auto fresh = _master->update(now->x, _is_frozen, _offset);
        take(fresh ? std::move(*fresh) : _master->pairs());
        measure_slip(now->u);
        _evaluated_version = _version;
      });
}

std::vector<std::int8_t> Contact::closing(bool is_first)
{
  const double gap_tol
      = is_first ? law::touching_gap(_halo->ranks(), at_slaves(_halo->now()->x),
                                     gdim())
                 : -1.0;
  std::vector<std::int8_t> closes(_nodes->num_nodes());
  for (std::size_t i = 0; i < closes.size(); ++i)
    closes[i] = _nodes->closing(i, gap_tol);
  return closes;
}
