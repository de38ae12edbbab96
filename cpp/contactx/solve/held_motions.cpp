// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "held_motions.h"
#include <cmath>
#include <utility>

using namespace contactx;
using namespace contactx::solve;
using Eigen::MatrixXd;
using Eigen::VectorXd;

HeldMotions::HeldMotions(mesh::Ranks& ranks, MatrixXd field,
                         std::span<const double> supports)
    : _ranks(ranks), _field(std::move(field))
{
  const Eigen::Index k = _field.rows();
  MatrixXd work = MatrixXd::Zero(k, k);
  for (std::size_t i = 0; i < supports.size(); ++i)
    if (supports[i] > 0)
    {
      const auto dof = static_cast<Eigen::Index>(i);
      _dofs.push_back(dof);
      work += _field.col(dof) * _field.col(dof).transpose();
    }
  if (_ranks.size() > 1)
    _ranks.reduce(std::span(work.data(), work.size()), mesh::Reduction::sum);
  _work.compute(work);
}

void HeldMotions::take_off(std::span<double> force)
{
  VectorXd left
      = _field * Eigen::Map<const VectorXd>(force.data(), _field.cols());
  if (_ranks.size() > 1)
    _ranks.reduce(std::span(left.data(), left.size()), mesh::Reduction::sum);
  const VectorXd by_motion = _work.solve(left);
  double sum = 0;
  for (const Eigen::Index dof : _dofs)
  {
    const double support = _field.col(dof).dot(by_motion);
    force[dof] -= support;
    sum += support * support;
  }
  _force = std::sqrt(mesh::total(_ranks, sum));
}
