// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "motion_fields.h"
#include "../math/matrix.h"
#include <stdexcept>
#include <utility>

using namespace contactx;
using namespace contactx::solve;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solve::combined(const MatrixXd& gram, const VectorXd& work)
{
  const Eigen::LLT<MatrixXd> factors(gram);
  if (factors.info() != Eigen::Success)
    throw std::domain_error("rigid motions of the bodies are not independent");
  return factors.solve(work);
}

MotionFields::MotionFields(mesh::Ranks& ranks, std::vector<Part> parts)
    : _ranks(&ranks), _parts(std::move(parts))
{
  for (const Part& part : _parts)
    _size += std::ssize(part.motions);
}

void MotionFields::fix(std::span<const std::int8_t> markers)
{
  for (Part& part : _parts)
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
      if (markers[part.dofs[i]] != 0)
        part.by.col(i).setZero();
}

VectorXd MotionFields::work(std::span<const double> forces) const
{
  const auto f = math::column(forces);
  VectorXd work(_size);
  for (const Part& part : _parts)
    work(part.motions) = part.by * f(part.dofs);
  if (_ranks->size() > 1)
    _ranks->reduce(std::span(work.data(), work.size()), mesh::Reduction::sum);
  return work;
}

VectorXd MotionFields::part_of(std::span<const double> u) const
{
  std::vector<MatrixXd> grams;
  for (const Part& part : _parts)
    grams.push_back(part.by * part.by.transpose());
  sum_up(grams);
  VectorXd motion = work(u);
  for (std::size_t k = 0; k < _parts.size(); ++k)
  {
    const auto& motions = _parts[k].motions;
    motion(motions) = combined(grams[k], motion(motions)).eval();
  }
  return motion;
}

std::vector<double> MotionFields::displacements(const VectorXd& motion,
                                                std::size_t n) const
{
  std::vector<double> u(n);
  Eigen::Map<VectorXd> all(u.data(), u.size());
  for (const Part& part : _parts)
    all(part.dofs) = part.by.transpose() * motion(part.motions);
  return u;
}

void MotionFields::sum_up(std::vector<MatrixXd>& grams) const
{
  if (_ranks->size() == 1)
    return;
  // All in one reduction
  std::vector<double> sums;
  for (const MatrixXd& gram : grams)
    sums.insert(sums.end(), gram.data(), gram.data() + gram.size());
  _ranks->reduce(std::span(sums), mesh::Reduction::sum);
  const double* at = sums.data();
  for (MatrixXd& gram : grams)
  {
    gram = Eigen::Map<const MatrixXd>(at, gram.rows(), gram.cols());
    at += gram.size();
  }
}
