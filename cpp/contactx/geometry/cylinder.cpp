// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "cylinder.h"
#include "parameters.h"
#include "radial.h"
#include <stdexcept>

using namespace contactx;
using namespace contactx::geometry;

Cylinder::Cylinder(std::vector<double> point, std::vector<double> axis,
                   double radius, bool hollow)
    : _hollow(hollow), _point(std::move(point)), _axis(std::move(axis)),
      _radius(radius)
{
}

void Cylinder::place(std::vector<double> point, std::vector<double> axis,
                     double radius, std::vector<double> angle)
{
  _angle = std::move(angle);
  _point = std::move(point);
  _axis = std::move(axis);
  _radius = radius;
}

void Cylinder::read(int gdim)
{
  if (gdim != 3)
    throw std::invalid_argument("a Cylinder needs 3D: in 2D take a Sphere");
  refresh(gdim);
}

void Cylinder::evaluate(std::span<const double> x, int gdim, Geometry& at)
{
  read(gdim);
  const Vector<3> axis = direction(_axis, 3, "axis of a Cylinder");
  const Vector<3> point = vector(_point, 3, "point of a Cylinder");
  const double radius = positive(_radius, "radius of a Cylinder");
  std::array<Vector<3>, 3> across;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      across[i][j] = (i == j) - axis[i] * axis[j];
  const std::size_t n = x.size() / 3;
  at.resize(n, 3);
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vector<3> p{x[3 * i] - point[0], x[3 * i + 1] - point[1],
                      x[3 * i + 2] - point[2]};
    const Vector<3> d{dot(across[0], p), dot(across[1], p), dot(across[2], p)};
    const Radial seen(d, 3, radius, _hollow);
    at.gap[i] = seen.gap;
    for (int k = 0; k < 3; ++k)
    {
      at.gradient[3 * i + k] = at.normal[3 * i + k] = seen.normal[k];
      for (int j = 0; j < 3; ++j)
        at.curvature[3 * (3 * i + k) + j] = dot(seen.curvature[k], across[j]);
    }
  }
}

Placement Cylinder::placement(int gdim)
{
  read(gdim);
  const Vector<3> point = vector(_point, 3, "point of a Cylinder");
  const Vector<3> axis = direction(_axis, 3, "axis of a Cylinder");
  return {{point.begin(), point.end()},
          {axis.begin(), axis.end()},
          spun(_angle, 1, "angle of a Cylinder")};
}

double Cylinder::size(int gdim)
{
  read(gdim);
  return _hollow ? Obstacle::size(gdim)
                 : 2 * positive(_radius, "radius of a Cylinder");
}

std::string Cylinder::usual_mistake() const { return usual_mistake_of_radial; }
