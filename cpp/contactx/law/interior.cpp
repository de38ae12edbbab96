// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "interior.h"
#include "cone.h"
#include "node_state.h"

using namespace contactx;
using namespace contactx::law;

namespace
{
using Map = Eigen::Map<const Eigen::VectorXd>;
} // namespace

Interior::Interior(const NodeState& nodes) : gdim(nodes.gdim())
{
  const std::size_t n = nodes.num_nodes();
  const std::size_t rows = nodes.is_vector() ? n * gdim : 0;
  is_on.assign(n, 0);
  has_friction.assign(n, 0);
  pressure.assign(n, 0);
  slack.assign(n, 0);
  bound.assign(n, 0);
  by_pressure.assign(n, 0);
  traction.assign(rows, 0);
  slip.assign(rows, 0);
  slip_length.assign(n, 0);
  normal.assign(rows, 0);
  product.assign(n, 0);
  correction.assign(nodes.is_vector() ? n * (1 + gdim) : 0, 0);
}

void contactx::law::interior_complementarity(NodeState& nodes)
{
  const Interior& in = *nodes.interior;
  const int g = nodes.size();
  using Rows = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  for (std::size_t i = 0; i < in.is_on.size(); ++i)
  {
    const Vector lambda = Map(&nodes.multiplier[g * i], g);
    Vector value = lambda, by_gap = Vector::Zero(g);
    Rows by_multiplier = Rows::Identity(g, g), by_slip = Rows::Zero(g, g),
         by_normal = by_slip;
    double scale = nodes.area[i];
    if (in.is_on[i])
    {
      scale *= nodes.c[i];
      const double p = in.pressure[i], compliance = in.slack[i] / p;
      const double height = nodes.gap[i] - (in.target - in.product[i]) / p;
      if (not nodes.is_vector())
      {
        value[0] = height;
        by_multiplier(0, 0) = compliance;
        by_gap[0] = 1;
      }
      else
      {
        const Vector n = Map(&nodes.normal[g * i], g);
        const Rows across = Rows::Identity(g, g) - n * n.transpose();
        // Derivatives of the traction along the surface by the normal
        const Rows turn = -p * Rows::Identity(g, g) - n * lambda.transpose();
        const double c = nodes.c[i];
        Vector along = across * lambda / c;
        Rows by_traction = across / c, moves = Rows::Zero(g, g),
             by_turn = turn / c;
        if (in.has_friction[i])
        {
          const ConePair pair = pair_of(in, i);
          const Rows F = across * pair.block();
          along = Vector(Map(&nodes.slip[g * i], g))
                  - 2 * in.target * Vector(pair.inverse().tail(g))
                  - Vector(Map(&in.correction[(1 + g) * i + 1], g));
          const Vector friction
              = in.by_pressure[i] * across * pair.first_column().tail(g);
          by_traction = F * across + friction * n.transpose();
          by_turn = F * turn + friction * lambda.transpose();
          moves = Rows::Identity(g, g);
        }
        // What cannot move has no traction
        for (int k = 0; k < g; ++k)
          if (in.has_friction[i] and not(nodes.mobile[g * i + k] > 0))
          {
            along[k] = (lambda[k] - p * n[k]) / c;
            by_traction.row(k) = across.row(k) / c;
            by_turn.row(k) = turn.row(k) / c;
            moves.row(k).setZero();
          }
        value = height * n + along;
        by_gap = n;
        by_multiplier = compliance * n * n.transpose() + by_traction;
        by_slip = moves;
        by_normal = height * Rows::Identity(g, g)
                    + compliance * n * lambda.transpose() + by_turn;
      }
    }
    Eigen::Map<Eigen::VectorXd>(&nodes.value[g * i], g) = scale * value;
    Eigen::Map<Eigen::VectorXd>(&nodes.by_gap[g * i], g) = scale * by_gap;
    const auto write = [&](std::vector<double>& to, const Rows& rows)
    {
      for (int k = 0; k < g; ++k)
        for (int l = 0; l < g; ++l)
          to[g * (g * i + k) + l] = scale * rows(k, l);
    };
    write(nodes.by_multiplier, by_multiplier);
    if (nodes.is_vector())
    {
      write(nodes.by_slip, by_slip);
      write(nodes.by_normal, by_normal);
    }
  }
}
