// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "plane.h"
#include "parameters.h"
#include <algorithm>

using namespace contactx;
using namespace contactx::geometry;

Plane::Plane(std::vector<double> point, std::vector<double> normal)
    : _point(std::move(point)), _normal(std::move(normal))
{
}

void Plane::place(std::vector<double> point, std::vector<double> normal)
{
  _point = std::move(point);
  _normal = std::move(normal);
}

void Plane::evaluate(std::span<const double> x, int gdim, Geometry& at)
{
  refresh(gdim);
  const Vector<3> normal = direction(_normal, gdim, "normal of a Plane");
  const Vector<3> point = vector(_point, gdim, "point of a Plane");
  const std::size_t n = x.size() / gdim;
  at.resize(n, gdim);
  for (std::size_t i = 0; i < n; ++i)
  {
    double gap = 0;
    for (int k = 0; k < gdim; ++k)
    {
      gap += (x[gdim * i + k] - point[k]) * normal[k];
      at.gradient[gdim * i + k] = at.normal[gdim * i + k] = normal[k];
    }
    at.gap[i] = gap;
  }
  std::ranges::fill(at.curvature, 0.0);
}

Placement Plane::placement(int gdim)
{
  refresh(gdim);
  const Vector<3> point = vector(_point, gdim, "point of a Plane");
  const Vector<3> normal = direction(_normal, gdim, "normal of a Plane");
  return {{point.begin(), point.begin() + gdim},
          {normal.begin(), normal.begin() + gdim}};
}

std::string Plane::usual_mistake() const
{
  return "Its normal probably points the wrong way: it must point to where "
         "bodies may be";
}
