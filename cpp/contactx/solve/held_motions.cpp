// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "held_motions.h"
#include <cmath>
#include <utility>

using namespace contactx;
using namespace contactx::solve;
using Eigen::MatrixXd;
using Eigen::VectorXd;

HeldMotions::HeldMotions(mesh::Ranks& ranks, MotionFields fields,
                         std::span<const double> supports)
    : _ranks(ranks), _fields(std::move(fields))
{
  std::vector<MatrixXd> work;
  for (const MotionFields::Part& part : _fields.parts())
  {
    std::vector<Eigen::Index>& held = _supports.emplace_back();
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
      if (supports[part.dofs[i]] > 0)
        held.push_back(static_cast<Eigen::Index>(i));
    const MatrixXd by = part.by(Eigen::all, held);
    work.push_back(by * by.transpose());
  }
  _fields.sum_up(work);
  for (const MatrixXd& of_part : work)
    _work.emplace_back(of_part);
}

void HeldMotions::take_off(std::span<double> force)
{
  const VectorXd left = _fields.work(force);
  double sum = 0;
  for (std::size_t k = 0; k < _work.size(); ++k)
  {
    const MotionFields::Part& part = _fields.parts()[k];
    const VectorXd by_motion = _work[k].solve(left(part.motions));
    for (const Eigen::Index i : _supports[k])
    {
      const double support = part.by.col(i).dot(by_motion);
      force[part.dofs[i]] -= support;
      sum += support * support;
    }
  }
  _force = std::sqrt(mesh::total(_ranks, sum));
}
