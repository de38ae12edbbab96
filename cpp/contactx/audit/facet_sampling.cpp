// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facet_sampling.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

using namespace contactx;
using namespace contactx::audit;

FacetSampling::FacetSampling(const geometry::FacetList& facets,
                             std::span<const double> x, int gdim,
                             std::vector<double> allowed, int levels)
    : _gdim(gdim), _levels(levels), _allowed(std::move(allowed)),
      _gap(facets.size(), std::numeric_limits<double>::infinity()),
      _deepest(facets.size() * static_cast<std::size_t>(gdim),
               std::numeric_limits<double>::quiet_NaN())
{
  if (_allowed.size() != _gap.size())
    throw std::invalid_argument("depths of another number of facets");
  std::vector<double> corners;
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    corners.clear();
    for (const std::int32_t node : facets[f])
      corners.insert(corners.end(),
                     x.begin() + static_cast<std::size_t>(node) * gdim,
                     x.begin() + static_cast<std::size_t>(node + 1) * gdim);
    add(f, corners);
  }
}

void FacetSampling::add(std::int32_t facet, std::span<const double> corners)
{
  const std::size_t num = corners.size() / _gdim;
  _facet.push_back(facet);
  _first.push_back(_corners.size());
  _corners.insert(_corners.end(), corners.begin(), corners.end());
  std::array<double, 3> middle{};
  for (std::size_t i = 0; i < corners.size(); ++i)
    middle[i % _gdim] += corners[i] / num;
  double radius = 0;
  for (std::size_t c = 0; c < num; ++c)
  {
    double square = 0;
    for (int k = 0; k < _gdim; ++k)
    {
      const double d = corners[c * _gdim + k] - middle[k];
      square += d * d;
    }
    radius = std::max(radius, square);
  }
  _radius.push_back(std::sqrt(radius));
  _points.insert(_points.end(), middle.begin(), middle.begin() + _gdim);
}

void FacetSampling::halve(std::int32_t facet, std::span<const double> corners)
{
  const int num = static_cast<int>(corners.size()) / _gdim, g = _gdim;
  const auto mean = [corners, g](std::initializer_list<int> of)
  {
    std::array<double, 3> m{};
    for (const int c : of)
      for (int k = 0; k < g; ++k)
        m[k] += corners[c * g + k] / of.size();
    return m;
  };
  std::vector<double> piece;
  const auto put =
      [this, facet, g, &piece](std::initializer_list<std::array<double, 3>> at)
  {
    piece.clear();
    for (const auto& p : at)
      piece.insert(piece.end(), p.begin(), p.begin() + g);
    add(facet, piece);
  };
  const auto a = mean({0}), b = mean({1}), ab = mean({0, 1});
  if (num == 2)
  {
    put({a, ab});
    put({ab, b});
    return;
  }
  const auto c = mean({2}), ac = mean({0, 2});
  if (num == 3)
  {
    const auto bc = mean({1, 2});
    put({a, ab, ac});
    put({ab, b, bc});
    put({ac, bc, c});
    put({bc, ac, ab});
    return;
  }
  // The corners of a quadrilateral run along its first axis first
  const auto d = mean({3}), bd = mean({1, 3}), cd = mean({2, 3}),
             abcd = mean({0, 1, 2, 3});
  put({a, ab, ac, abcd});
  put({ab, b, abcd, bd});
  put({ac, abcd, c, cd});
  put({abcd, bd, cd, d});
}

void FacetSampling::take(std::span<const double> gap)
{
  if (gap.size() != _facet.size())
    throw std::invalid_argument("gaps of another number of points");
  const auto facet = std::exchange(_facet, {});
  const auto first = std::exchange(_first, {});
  const auto corners = std::exchange(_corners, {});
  const auto radius = std::exchange(_radius, {});
  const auto points = std::exchange(_points, {});
  for (std::size_t i = 0; i < facet.size(); ++i)
    if (const std::int32_t f = facet[i]; gap[i] < _gap[f])
    {
      _gap[f] = gap[i];
      std::copy_n(points.begin() + i * _gdim, _gdim,
                  _deepest.begin() + static_cast<std::size_t>(f) * _gdim);
    }
  if (_levels-- <= 0)
    return;
  for (std::size_t i = 0; i < facet.size(); ++i)
  {
    const std::size_t end
        = i + 1 < first.size() ? first[i + 1] : corners.size();
    // A facet that is too deep anywhere needs no refinement
    if (gap[i] - radius[i] < -_allowed[facet[i]]
        and _gap[facet[i]] >= -_allowed[facet[i]])
      halve(facet[i], std::span(corners).subspan(first[i], end - first[i]));
  }
}
