// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "rigid_modes.h"
#include "../math/matrix.h"
#include "../math/scales.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::solve;
using Eigen::MatrixXd;
using mesh::Reduction;

namespace
{
// The same up to which the body may move far enough to touch others
constexpr double weak_support_max = 1e-3;

/// Orthonormal basis of the null space of a matrix of so many rows, from the
/// matrix times its transpose from the left.
MatrixXd null_space(const MatrixXd& gram, double rows)
{
  const auto found = math::symmetric_eigen(gram);
  std::vector<Eigen::Index> which;
  for (Eigen::Index k = 0; k < gram.cols(); ++k)
    if (math::is_zero(found.eigenvalues()[k], std::max(rows, 1.0)))
      which.push_back(k);
  return found.eigenvectors()(Eigen::all, which);
}

void sum_up(mesh::Ranks& ranks, std::span<double> values)
{
  if (ranks.size() > 1)
    ranks.reduce(values, Reduction::sum);
}
} // namespace

/// Stiffness of the bulk against motions of a body.
struct RigidModes::Resistance
{
  Eigen::VectorXd values; ///< ascending
  MatrixXd motions;       ///< combinations of the motions that have it
  double scale;           ///< that against motions that are not rigid
};

void solve::rigid_modes(const double* d, double* modes, int gdim)
{
  const int m = num_modes(gdim);
  std::fill_n(modes, gdim * m, 0.0);
  for (int i = 0; i < gdim; ++i)
    modes[i * m + i] = 1;
  if (gdim == 2)
  {
    modes[2] = -d[1];
    modes[m + 2] = d[0];
    return;
  }
  for (int k = 0; k < 3; ++k)
  {
    // About axis k
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    modes[i * m + 3 + k] = -d[j];
    modes[j * m + 3 + k] = d[i];
  }
}

MatrixXd solve::by_body(std::span<const MatrixXd> bases)
{
  Eigen::Index rows = 0, cols = 0;
  for (const MatrixXd& basis : bases)
  {
    rows += basis.rows();
    cols += basis.cols();
  }
  MatrixXd Z = MatrixXd::Zero(rows, cols);
  rows = cols = 0;
  for (const MatrixXd& basis : bases)
  {
    Z.block(rows, cols, basis.rows(), basis.cols()) = basis;
    rows += basis.rows();
    cols += basis.cols();
  }
  return Z;
}

RigidModes::RigidModes(std::shared_ptr<const mesh::Bodies> bodies, Bulk& bulk,
                       std::span<const double> x)
    : _bodies(std::move(bodies)), _gdim(bulk.gdim())
{
  check(bulk, x);
  mesh::Ranks& ranks = _bodies->map().ranks();
  const std::size_t count = _bodies->size(), g = _gdim;
  const auto owned = body().first(_bodies->map().num_owned());
  std::vector<double> sums(count * (1 + g));
  for (std::size_t i = 0; i < owned.size(); ++i)
  {
    double* sum = &sums[owned[i] * (1 + g)];
    sum[0] += 1;
    for (std::size_t k = 0; k < g; ++k)
      sum[1 + k] += x[i * g + k];
  }
  sum_up(ranks, sums);
  _middle.resize(count * g);
  for (std::size_t b = 0; b < count; ++b)
  {
    for (std::size_t k = 0; k < g; ++k)
      _middle[b * g + k]
          = sums[b * (1 + g) + 1 + k] / std::max(sums[b * (1 + g)], 1.0);
  }
  _radius.resize(count);
  for (std::size_t i = 0; i < owned.size(); ++i)
  {
    double square = 0;
    for (std::size_t k = 0; k < g; ++k)
    {
      const double d = x[i * g + k] - _middle[owned[i] * g + k];
      square += d * d;
    }
    _radius[owned[i]] = std::max(_radius[owned[i]], std::sqrt(square));
  }
  if (ranks.size() > 1)
    ranks.reduce(std::span(_radius), Reduction::largest);
  std::ranges::replace(_radius, 0.0, 1.0);
  _sprung.assign(count, 0);
  update(bulk, x);
}

void RigidModes::check(Bulk& bulk, std::span<const double> x) const
{
  _bodies->map().ranks().agree(
      [&]
      {
        if (_gdim != 2 and _gdim != 3)
          throw std::invalid_argument("gdim must be 2 or 3, not "
                                      + std::to_string(_gdim));
        if (x.size() != body().size() * _gdim)
          throw std::invalid_argument(
              "x must have gdim coordinates for each of "
              + std::to_string(body().size()) + " nodes: it has "
              + std::to_string(x.size()) + " values");
        const std::size_t dofs = _bodies->map().num_owned() * _gdim;
        if (bulk.markers().size() != dofs)
          throw std::invalid_argument(
              "markers must have gdim values for each owned node: "
              + std::to_string(dofs) + ", not "
              + std::to_string(bulk.markers().size()));
      });
}

double RigidModes::size() const
{
  return _radius.empty() ? 0.0 : std::ranges::max(_radius);
}

bool RigidModes::any_free() const
{
  const auto some = [](const MatrixXd& basis) { return basis.cols() > 0; };
  return std::ranges::any_of(_free, some) or std::ranges::any_of(_weak, some);
}

void RigidModes::at(std::int32_t node, std::span<const double> x,
                    double* modes) const
{
  const std::size_t b = body()[node];
  std::array<double, 3> d{};
  for (int k = 0; k < _gdim; ++k)
    d[k] = (x[std::size_t(node) * _gdim + k] - _middle[b * _gdim + k])
           / _radius[b];
  rigid_modes(d.data(), modes, _gdim);
}

void RigidModes::move(std::int32_t node, std::span<const double> x,
                      const double* motion, bool is_exact, double* by) const
{
  const std::size_t b = body()[node];
  Eigen::Vector3d arm = Eigen::Vector3d::Zero(), turn = arm, shift = arm;
  for (int k = 0; k < _gdim; ++k)
  {
    arm[k] = x[std::size_t(node) * _gdim + k] - _middle[b * _gdim + k];
    shift[k] = motion[k];
  }
  for (int k = _gdim; k < modes_per_body(); ++k)
    turn[_gdim == 2 ? 2 : k - 3] = motion[k] / _radius[b];
  const double angle = turn.norm();
  if (is_exact and angle > 0)
    shift += Eigen::AngleAxisd(angle, turn / angle) * arm - arm;
  else
    shift += turn.cross(arm);
  std::copy_n(shift.data(), _gdim, by);
}

void RigidModes::update(Bulk& bulk, std::span<const double> x)
{
  check(bulk, x);
  const std::size_t m = modes_per_body(), g = _gdim;
  const std::vector<double> seen = prescribed(bulk, x);
  std::vector<std::int8_t> sprung = _sprung;
  // Motions that prescribed displacements leave, and those of them that do not
  // turn a body: stresses resist rotations without being a support
  std::vector<MatrixXd> unconstrained, shifts;
  for (std::size_t b = 0; b < count(); ++b)
  {
    const double* of_body = &seen[b * (m * m + 1)];
    const MatrixXd& all = unconstrained.emplace_back(
        null_space(Eigen::Map<const MatrixXd>(of_body, m, m), of_body[m * m]));
    shifts.emplace_back(m, 0);
    if (all.cols() == 0 or _is_first or sprung[b])
      continue;
    const auto turns = all.bottomRows(m - g);
    shifts[b]
        = all
          * null_space(turns.transpose() * turns, static_cast<double>(m - g));
  }
  const std::vector<Resistance> against_shifts = resistance(bulk, x, shifts);
  for (std::size_t b = 0; b < count(); ++b)
    if (shifts[b].cols() > 0)
      sprung[b] = against_shifts[b].values.cwiseAbs().maxCoeff()
                  > math::round_off * against_shifts[b].scale;
  std::vector<MatrixXd> free = unconstrained,
                        weak(count(), MatrixXd::Zero(m, 0));
  for (std::size_t b = 0; b < count(); ++b)
    if (not(_is_first or sprung[b]))
      unconstrained[b].resize(m, 0);
  const std::vector<Resistance> resistances
      = resistance(bulk, x, unconstrained);
  std::vector<std::vector<double>> stiffness(count());
  for (std::size_t b = 0; b < count(); ++b)
  {
    if (unconstrained[b].cols() == 0)
      continue;
    const Resistance& r = resistances[b];
    std::vector<Eigen::Index> none, some;
    for (Eigen::Index k = 0; k < r.values.size(); ++k)
    {
      const double size = std::abs(r.values[k]);
      if (size <= math::round_off * r.scale)
        none.push_back(k);
      else if (size <= weak_support_max * r.scale)
      {
        some.push_back(k);
        stiffness[b].push_back(size);
      }
    }
    free[b] = unconstrained[b] * r.motions(Eigen::all, none);
    weak[b] = unconstrained[b] * r.motions(Eigen::all, some);
    if (free[b].cols() < unconstrained[b].cols())
      sprung[b] = 1;
  }
  _free = std::move(free);
  _weak = std::move(weak);
  _stiffness = std::move(stiffness);
  _sprung = std::move(sprung);
  _is_first = false;
}

/// What prescribed displacements see of the modes of each body: Gram matrix of
/// the modes at prescribed dofs, and the number of these (shape=(num_bodies,
/// m * m + 1)).
std::vector<double> RigidModes::prescribed(Bulk& bulk,
                                           std::span<const double> x) const
{
  const std::size_t m = modes_per_body(), g = _gdim;
  const auto markers = bulk.markers();
  std::array<double, 18> modes;
  std::vector<double> seen(count() * (m * m + 1));
  for (std::size_t i = 0; i < markers.size() / g; ++i)
  {
    bool is_known = false;
    double* of_body = &seen[body()[i] * (m * m + 1)];
    for (std::size_t k = 0; k < g; ++k)
    {
      if (markers[i * g + k] != 1)
        continue;
      if (not is_known)
        at(static_cast<std::int32_t>(i), x, modes.data());
      is_known = true;
      for (std::size_t p = 0; p < m; ++p)
        for (std::size_t q = 0; q < m; ++q)
          of_body[p * m + q] += modes[k * m + p] * modes[k * m + q];
      of_body[m * m] += 1;
    }
  }
  sum_up(_bodies->map().ranks(), seen);
  return seen;
}

std::vector<RigidModes::Resistance>
RigidModes::resistance(Bulk& bulk, std::span<const double> x,
                       const std::vector<MatrixXd>& motions) const
{
  const std::size_t m = modes_per_body(), g = _gdim;
  const auto owned = body().first(_bodies->map().num_owned());
  const std::size_t n = owned.size() * g;
  // All bodies move at once, as none has a stiffness against another one
  Eigen::Index most = 0;
  for (const MatrixXd& of_body : motions)
    most = std::max(most, of_body.cols());
  std::vector<Resistance> found(motions.size());
  if (most == 0)
    return found;
  MatrixXd fields = MatrixXd::Zero(n, most);
  std::array<double, 18> modes;
  for (std::size_t i = 0; i < owned.size(); ++i)
  {
    const MatrixXd& of_body = motions[owned[i]];
    at(static_cast<std::int32_t>(i), x, modes.data());
    fields.block(i * g, 0, g, of_body.cols())
        = Eigen::Map<const MatrixXd>(modes.data(), m, g).transpose() * of_body;
  }
  const auto diagonal = bulk.diagonal();
  const auto forces
      = bulk.products({fields.data(), most * n}, static_cast<int>(most));
  mesh::Ranks& ranks = _bodies->map().ranks();
  ranks.agree(
      [&]
      {
        if (diagonal.size() != n or forces.size() != most * n)
          throw std::invalid_argument(
              "the diagonal and the products of the stiffness must have a "
              "value for each of "
              + std::to_string(n) + " owned dofs");
      });
  // Of each body a matrix whose last column is the stiffness of the diagonal
  const std::size_t size = most * (most + 1);
  std::vector<double> sums(motions.size() * size);
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::size_t b = owned[i / g];
    const Eigen::Index k = motions[b].cols();
    Eigen::Map<MatrixXd> sum(&sums[b * size], most, most + 1);
    for (Eigen::Index p = 0; p < k; ++p)
    {
      const double u = fields(i, p);
      for (Eigen::Index q = 0; q < k; ++q)
        sum(p, q) += u * forces[q * n + i];
      sum(p, most) += u * std::abs(diagonal[i]) * u;
    }
  }
  sum_up(ranks, sums);
  for (std::size_t b = 0; b < motions.size(); ++b)
  {
    const Eigen::Index k = motions[b].cols();
    if (k == 0)
      continue;
    const Eigen::Map<const MatrixXd> sum(&sums[b * size], most, most + 1);
    const MatrixXd energy = sum.topLeftCorner(k, k);
    const auto eigen
        = math::symmetric_eigen(MatrixXd((energy + energy.transpose()) / 2));
    found[b] = {eigen.eigenvalues(), eigen.eigenvectors(),
                sum.col(most).head(k).maxCoeff()};
  }
  return found;
}
