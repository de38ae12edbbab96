// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "convergence.h"
#include "../math/scales.h"
#include "../mesh/extent.h"
#include "free_bodies.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// Displacement, over the scene's size or the largest prescribed one, above
/// which a body has run away
constexpr double runaway_ratio = 1e3;
/// Residual, over the stiffness times the scene's size, below which it may be
/// the round-off of forces that cancel
constexpr double cancelling_force_max = 1e-8;

double square(double value) { return value * value; }

double square(std::span<const double> values)
{
  double sum = 0;
  for (const double value : values)
    sum += square(value);
  return sum;
}

double largest_of(std::span<const double> values)
{
  double most = 0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  return most;
}

/// Sizes of the vectors of nodes.
std::vector<double> sizes_of(std::span<const double> values, int gdim)
{
  std::vector<double> sizes(values.size() / gdim);
  for (std::size_t i = 0; i < sizes.size(); ++i)
    sizes[i] = std::sqrt(square(values.subspan(i * gdim, gdim)));
  return sizes;
}
} // namespace

Convergence::Convergence(std::shared_ptr<System> system)
    : _system(std::move(system))
{
  const mesh::Halo& halo = *_system->halo();
  _scales = mesh::scales(ranks(), halo.reference(), halo.gdim());
  _cell_size.assign(halo.num_owned(), 0);
  if (Bulk& bulk = *_system->bulk(); not bulk.is_linear())
    std::ranges::copy(bulk.cell_sizes(), _cell_size.begin());
}

void Convergence::begin_step(std::vector<double> stiffness)
{
  _stiffness = std::move(stiffness);
  _scales.stiffness = norm(_stiffness);
  _scales.force.reset();
  _cancelling.reset();
  _before.reset();
  _field_scales.clear();
  look_into_cells(scale());
}

double Convergence::norm(std::span<const double> values) const
{
  return std::sqrt(mesh::total(ranks(), square(values)));
}

double Convergence::scale() { return norm(_system->bulk_residual()); }

bool Convergence::may_be_rounding(double residual) const
{
  return residual <= cancelling_force_max * _scales.deforming_force();
}

/// The largest residual of other fields over what it may be: at most one where
/// they have converged.
double Convergence::excess_of_fields(std::span<const double> b, double rtol)
{
  Fields* fields = _system->bulk()->fields();
  if (not fields)
    return 0;
  const std::vector<std::size_t> offsets = fields->offsets();
  const std::span<const std::int8_t> markers = fields->markers();
  const std::span<const double> values = fields->values();
  const std::size_t n = offsets.size() - 1;
  // Of each field: residual, and the largest defect and value
  std::vector<double> residual(n), largest(2 * n);
  for (std::size_t f = 0; f < n; ++f)
    for (std::size_t i = offsets[f]; i < offsets[f + 1]; ++i)
    {
      if (markers[i] == 1)
        largest[2 * f] = std::max(largest[2 * f], std::abs(b[i]));
      else
        residual[f] += b[i] * b[i];
      // A prescribed value may be the first that is not zero
      const double defect = markers[i] == 1 ? std::abs(b[i]) : 0;
      largest[2 * f + 1]
          = std::max({largest[2 * f + 1], std::abs(values[i]), defect});
    }
  ranks().reduce(std::span<double>(residual), mesh::Reduction::sum);
  ranks().reduce(std::span<double>(largest), mesh::Reduction::largest);
  _field_scales.resize(n);
  double excess = 0;
  std::vector<double> terms;
  for (std::size_t f = 0; f < n; ++f)
  {
    const double r = std::sqrt(residual[f]);
    if (not std::isfinite(r))
      return std::numeric_limits<double>::infinity();
    _field_scales[f] = std::max(_field_scales[f], r);
    double allowed = rtol * _field_scales[f];
    if (r > allowed)
    {
      // The same on all ranks
      if (terms.empty())
        terms = sizes_of_terms();
      const auto mine
          = std::span(terms).subspan(_system->num_displacements() + offsets[f],
                                     offsets[f + 1] - offsets[f]);
      allowed = std::max(allowed, math::sum_round_off * norm(mine));
    }
    if (r > 0)
      excess = std::max(excess, r / allowed);
    if (largest[2 * f] > 0)
      excess = std::max(excess,
                        largest[2 * f]
                            / (math::solved_length_tol * largest[2 * f + 1]));
  }
  return excess;
}

std::vector<double>
Convergence::weights_of_fields(std::span<const double> sizes, double residual)
{
  _field_scales.resize(sizes.size());
  const double force = std::max({scale(), _scales.force.value_or(0), residual});
  std::vector<double> weights;
  for (std::size_t f = 0; f < sizes.size(); ++f)
  {
    _field_scales[f] = std::max(_field_scales[f], sizes[f]);
    const bool is_known = force > 0 and _field_scales[f] > 0;
    weights.push_back(is_known ? force / _field_scales[f] : 1);
  }
  return weights;
}

Convergence::Result Convergence::compare(std::span<const double> b, double rtol,
                                         double atol)
{
  const std::size_t n = _system->num_displacements();
  Result found = compare_forces(b, rtol, atol);
  const double excess
      = excess_of_fields(b.subspan(n, _system->num_bulk() - n), rtol);
  // Relative to their tolerances the largest counts
  if (excess > 1 and found.tolerance > 0)
    found.residual = std::max(found.residual, excess * found.tolerance);
  else if (excess > 1)
    found.residual = std::max(found.residual, excess);
  return found;
}

Convergence::Result Convergence::compare_forces(std::span<const double> b,
                                                double rtol, double atol)
{
  const std::span<const std::int8_t> markers = _system->bulk()->markers();
  const std::size_t n = _system->num_displacements();
  const int g = _system->halo()->gdim();
  std::vector<double> force(b.begin(), b.begin() + n);
  double defect = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (markers[i] == 1)
    {
      defect = std::max(defect, std::abs(force[i]));
      force[i] = 0;
    }
  defect = mesh::largest(ranks(), defect);
  const std::vector<double> force_size = sizes_of(force, g);
  const double constraints = square(b.subspan(_system->num_bulk()));
  const double residual
      = std::sqrt(mesh::total(ranks(), square(force) + constraints));
  double scale = this->scale();
  if (not _scales.force)
    // Unloading ends without forces. What the first change of the Dirichlet
    // values asks for says little: a stiff body that moves as a whole asks for
    // much and gets nothing
    _scales.force = std::max(
        {scale, math::negligible_part * residual, scale_of_accepted()});
  scale = std::max(scale, *_scales.force);

  // A gap is a difference of positions, the forces of a stiff body sums of
  // stiffness times displacement that cancel. Displacements count only while
  // what they leave is small against the forces: a body that has run away is no
  // solution
  const std::vector<double> u = sizes();
  const double moved = mesh::largest(ranks(), largest_of(u));
  const std::vector<double> lengths = gap_lengths();
  double weights = 0;
  for (std::size_t k = 0; k < lengths.size(); ++k)
  {
    const law::NodeState& nodes = *_system->contacts()[k]->nodes();
    const double most = lengths[k] + moved;
    for (std::size_t i = 0; i < nodes.status.size(); ++i)
      if (nodes.closed(i))
        weights += std::pow(nodes.area[i] * nodes.c[i] * most, 2);
  }
  const double of_gaps
      = math::sum_round_off * std::sqrt(mesh::total(ranks(), weights));
  std::vector<double> excused(u.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    excused[i] = math::sum_round_off * _stiffness[i] * (u[i] + _cell_size[i]);
  double whole = std::min(norm(excused), math::negligible_part * scale);
  for (double& error : excused)
    error = std::min(error, math::negligible_part * scale);

  const double strict = std::max({rtol * scale, atol, of_gaps});
  const double tolerance = std::max({rtol * scale, atol, of_gaps + whole});
  if (residual > tolerance)
  {
    auto errors = rounding_of_cancelling(residual);
    const double all = errors ? norm(*errors) : 0;
    if (not errors or residual > of_gaps + all)
      return {residual, tolerance, scale, defect};
    excused = std::move(*errors);
    whole = all;
  }
  if (has_run_away())
    return {residual, 0, scale, defect};
  double rest = constraints;
  for (std::size_t i = 0; i < force_size.size(); ++i)
    rest += std::pow(std::max(force_size[i] - excused[i], 0.0), 2);
  rest = std::sqrt(mesh::total(ranks(), rest));
  if (rest <= strict)
    return {residual, std::max(tolerance, of_gaps + whole), scale, defect};
  if (residual <= tolerance)
    return {rest, strict, scale, defect};
  return {residual, tolerance, scale, defect};
}

/// Lengths whose rounding errors the gaps of each contact have, besides
/// displacements.
///
/// In small sliding what the reference configuration has in a gap is a
/// constant, from which the offset is taken; in finite sliding projections and
/// integrals are those of positions.
std::vector<double> Convergence::gap_lengths() const
{
  std::vector<double> lengths;
  for (const auto& c : _system->contacts())
    lengths.push_back(c->measures_displacements() ? largest_of(c->offset())
                                                  : _scales.farthest);
  ranks().reduce(std::span(lengths), mesh::Reduction::largest);
  return lengths;
}

/// Rounding errors of forces that cancel, at each owned node; nothing where
/// they are smaller than the residual.
std::optional<std::vector<double>>
Convergence::rounding_of_cancelling(double residual)
{
  const std::optional<double> before = std::exchange(_before, residual);
  // A residual that still falls is more than that
  if (residual > largest_error() and (not before or residual > 0.1 * *before))
    look_into_cells(residual);
  if (residual > largest_error())
    return std::nullopt;
  return errors();
}

/// What the norm of the rounding errors cannot exceed, which costs little.
double Convergence::largest_error() const
{
  // They may be on different ranks
  std::array most{largest_of(sizes()), largest_of(_cell_size)};
  ranks().reduce(std::span<double>(most), mesh::Reduction::largest);
  const double cancelling = _cancelling ? norm(*_cancelling) : 0;
  return math::sum_round_off
         * (_scales.stiffness * (most[0] + most[1]) + cancelling);
}

/// Evaluates the forces that cancel between cells and terms, once a step at
/// most, if what is left of them is tiny: else they do not matter.
void Convergence::look_into_cells(double force)
{
  if (_cancelling or not may_be_rounding(force) or not(force > 0))
    return;
  Bulk& bulk = *_system->bulk();
  if (bulk.fields())
    _cancelling = sizes_of(std::span<const double>(sizes_of_terms())
                               .first(_system->num_displacements()),
                           _system->halo()->gdim());
  else
  {
    const std::span<const double> forces = bulk.cell_forces();
    _cancelling.emplace(forces.begin(), forces.end());
  }
}

/// Sum of the sizes of the terms in each row of the bulk: entries of its
/// Jacobian times unknowns. Displacements count by themselves and the size of
/// the cells around them: strains are differences of 1 and the deformation
/// gradient.
std::vector<double> Convergence::sizes_of_terms() const
{
  Bulk& bulk = *_system->bulk();
  const int g = _system->halo()->gdim();
  std::vector<double> sizes;
  for (const double u : bulk.displacements())
    sizes.push_back(std::abs(u) + _cell_size[sizes.size() / g]);
  for (const double value : bulk.fields()->values())
    sizes.push_back(std::abs(value));
  const std::span<const double> sums = bulk.fields()->absolute_products(sizes);
  return {sums.begin(), sums.end()};
}

std::vector<double> Convergence::errors() const
{
  std::vector<double> errors = around(sizes());
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    errors[i]
        = math::sum_round_off * _stiffness[i] * (errors[i] + _cell_size[i]);
    if (_cancelling)
      errors[i] += math::sum_round_off * (*_cancelling)[i];
  }
  return errors;
}

double Convergence::scale_of_balance()
{
  return std::max(scale(), norm(errors()) / math::negligible_part);
}

/// Sizes of the displacements of the owned nodes.
std::vector<double> Convergence::sizes() const
{
  return sizes_of(_system->bulk()->displacements(), _system->halo()->gdim());
}

/// Mean, over the cells around each owned node, of the largest size in each: a
/// node that stays where it is has the rounding errors of forces from those
/// around it.
std::vector<double> Convergence::around(std::vector<double> sizes) const
{
  const mesh::Halo& halo = *_system->halo();
  const auto n = static_cast<std::size_t>(halo.num_nodes());
  sizes.resize(n);
  halo.forward(std::span(sizes), 1);
  Bulk& bulk = *_system->bulk();
  const std::span<const std::int32_t> cells = bulk.cells();
  const auto k = static_cast<std::size_t>(bulk.nodes_per_cell());
  // Sum and count
  std::vector<double> sums(2 * n);
  for (std::size_t at = 0; at < cells.size(); at += k)
  {
    double most = 0;
    for (const std::int32_t node : cells.subspan(at, k))
      most = std::max(most, sizes[node]);
    for (const std::int32_t node : cells.subspan(at, k))
    {
      sums[2 * node] += most;
      sums[2 * node + 1] += 1;
    }
  }
  halo.reverse(std::span(sums), 2);
  std::vector<double> mean(halo.num_owned());
  for (std::size_t i = 0; i < mean.size(); ++i)
    mean[i] = sums[2 * i] / std::max(sums[2 * i + 1], 1.0);
  return mean;
}

void Convergence::accept()
{
  const std::span<const double> forces = _system->bulk_residual();
  _accepted.emplace(std::vector(forces.begin(), forces.end()),
                    std::max(scale(), _scales.force.value_or(0)));
}

/// What the last solution was relative to, while nothing has changed since: it
/// was large enough for these forces, and the same solve again must have
/// nothing to do.
double Convergence::scale_of_accepted()
{
  if (not _accepted)
    return 0;
  const bool same
      = std::ranges::equal(_accepted->first, _system->bulk_residual());
  return mesh::everywhere(ranks(), same) ? _accepted->second : 0;
}

/// Whether a body is so far away that its forces are but rounding errors.
bool Convergence::has_run_away()
{
  const double most
      = mesh::largest(ranks(), largest_of(_system->bulk()->displacements()));
  return most > runaway_ratio * farthest();
}

double Convergence::farthest()
{
  Bulk& bulk = *_system->bulk();
  const std::span<const double> u = bulk.displacements();
  const std::span<const double> defect = bulk.defect();
  const std::span<const std::int8_t> markers = bulk.markers();
  double prescribed = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    if (markers[i] == 1)
      prescribed = std::max(prescribed, std::abs(u[i] - defect[i]));
  return std::max(_scales.length, mesh::largest(ranks(), prescribed));
}
