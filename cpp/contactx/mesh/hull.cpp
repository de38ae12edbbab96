// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "hull.h"
#include "../check.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include <algorithm>
#include <map>
#include <numeric>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
/// Choices of k of the numbers below n, each ascending.
std::vector<std::vector<int>> choices(int n, int k)
{
  std::vector<std::vector<int>> all;
  std::vector<int> chosen(k);
  std::iota(chosen.begin(), chosen.end(), 0);
  while (true)
  {
    all.push_back(chosen);
    int i = k - 1;
    while (i >= 0 and chosen[i] == n - k + i)
      --i;
    if (i < 0)
      return all;
    std::iota(chosen.begin() + i, chosen.end(), chosen[i] + 1);
  }
}

Vector<3> row(const std::vector<double>& arms, int i)
{
  return {arms[3 * i], arms[3 * i + 1], arms[3 * i + 2]};
}
} // namespace

Hull::Hull(int num_vertices, int gdim)
    : _num_vertices(num_vertices), _gdim(gdim)
{
  check::dimension(gdim);
  check::require(num_vertices > gdim,
                 "num_vertices must be larger than the dimension");
  std::map<std::vector<int>, int> place;
  for (const std::vector<int>& face : choices(num_vertices, gdim))
  {
    place.emplace(face, static_cast<int>(place.size()));
    _faces.insert(_faces.end(), face.begin(), face.end());
  }
  for (const std::vector<int>& simplex : choices(num_vertices, gdim + 1))
    for (int k = 0; k <= gdim; ++k)
    {
      std::vector<int> face = simplex;
      face.erase(face.begin() + k);
      _simplices.push_back(place.at(face));
    }
  _arms.resize(static_cast<std::size_t>(num_vertices) * gdim);
  _volumes.resize(place.size());
}

bool Hull::contains(std::span<const double> point,
                    std::span<const std::int32_t> vertices,
                    std::span<const double> x, double tolerance)
{
  for (int i = 0; i < _num_vertices; ++i)
    for (int k = 0; k < _gdim; ++k)
      _arms[i * _gdim + k]
          = x[static_cast<std::size_t>(vertices[i]) * _gdim + k] - point[k];
  // Volumes that the point spans with gdim vertices, taken in ascending order
  for (std::size_t f = 0; f < _volumes.size(); ++f)
  {
    const int* face = &_faces[f * _gdim];
    if (_gdim == 2)
      _volumes[f] = _arms[2 * face[0]] * _arms[2 * face[1] + 1]
                    - _arms[2 * face[0] + 1] * _arms[2 * face[1]];
    else
      _volumes[f] = dot(row(_arms, face[0]),
                        cross(row(_arms, face[1]), row(_arms, face[2])));
  }
  for (std::size_t s = 0; s < _simplices.size(); s += _gdim + 1)
  {
    // Their sum with alternating signs is the simplex's own: the shares are
    // the barycentric coordinates
    std::array<double, 4> parts{};
    double whole = 0, largest = 0;
    for (int k = 0; k <= _gdim; ++k)
    {
      parts[k] = (k % 2 == 0 ? 1 : -1) * _volumes[_simplices[s + k]];
      whole += parts[k];
      largest = std::max(largest, std::abs(parts[k]));
    }
    if (math::is_zero(whole, largest))
      continue;
    if (std::all_of(parts.begin(), parts.begin() + _gdim + 1,
                    [=](double part) { return part / whole >= -tolerance; }))
      return true;
  }
  return false;
}
