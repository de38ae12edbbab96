// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "sphere.h"
#include "parameters.h"
#include "radial.h"

using namespace contactx;
using namespace contactx::geometry;

Sphere::Sphere(std::vector<double> centre, double radius, bool hollow)
    : _hollow(hollow), _centre(std::move(centre)), _radius(radius)
{
}

void Sphere::place(std::vector<double> centre, double radius,
                   std::vector<double> angle)
{
  _centre = std::move(centre);
  _radius = radius;
  _angle = std::move(angle);
}

void Sphere::evaluate(std::span<const double> x, int gdim, Geometry& at)
{
  refresh(gdim);
  const Vector<3> centre = vector(_centre, gdim, "centre of a Sphere");
  const double radius = positive(_radius, "radius of a Sphere");
  const std::size_t n = x.size() / gdim;
  at.resize(n, gdim);
  for (std::size_t i = 0; i < n; ++i)
  {
    Vector<3> d{};
    for (int k = 0; k < gdim; ++k)
      d[k] = x[gdim * i + k] - centre[k];
    const Radial seen(d, gdim, radius, _hollow);
    at.gap[i] = seen.gap;
    for (int k = 0; k < gdim; ++k)
    {
      at.gradient[gdim * i + k] = at.normal[gdim * i + k] = seen.normal[k];
      for (int j = 0; j < gdim; ++j)
        at.curvature[gdim * (gdim * i + k) + j] = seen.curvature[k][j];
    }
  }
}

Placement Sphere::placement(int gdim)
{
  refresh(gdim);
  const Vector<3> centre = vector(_centre, gdim, "centre of a Sphere");
  return {{centre.begin(), centre.begin() + gdim},
          {},
          spun(_angle, gdim == 2 ? 1 : 3, "angle of a Sphere")};
}

double Sphere::size(int gdim)
{
  refresh(gdim);
  return _hollow ? Obstacle::size(gdim)
                 : 2 * positive(_radius, "radius of a Sphere");
}

std::string Sphere::usual_mistake() const { return usual_mistake_of_radial; }
