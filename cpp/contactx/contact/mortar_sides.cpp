// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "mortar_sides.h"
#include "../geometry/middle.h"
#include "../geometry/smooth.h"
#include "../kernel/layout.h"
#include "../search/surface.h"
#include <cmath>
#include <limits>
#include <tuple>

using namespace contactx;
using namespace contactx::contact;

void contactx::contact::normalise(std::span<double> vectors)
{
  for (std::size_t i = 0; i < vectors.size(); i += 3)
  {
    const double size
        = std::sqrt(vectors[i] * vectors[i] + vectors[i + 1] * vectors[i + 1]
                    + vectors[i + 2] * vectors[i + 2]);
    for (int k = 0; k < 3; ++k)
      vectors[i + k] = size > 0 ? vectors[i + k] / size : 0.0;
  }
}

bool Mortar::has_weight(std::size_t p) const
{
  const auto n = static_cast<std::size_t>(width) * width;
  const auto row = std::span(weight).subspan(n * p, n);
  return std::ranges::any_of(row, [](double w) { return w != 0; });
}

Mortar Mortar::scaled(std::span<const double> factor) const
{
  Mortar result = *this;
  for (std::size_t c = 0; c < width * size(); ++c)
  {
    result.gap[c] *= factor[c];
    for (int l = 0; l < width; ++l)
      result.weight[width * c + l] *= factor[c];
  }
  return result;
}

Mortar Mortar::joined(const Mortar& other) const
{
  Mortar result;
  result.width = width;
  const std::ptrdiff_t n = width;
  for (const Mortar* part : {this, &other})
    for (std::size_t p = 0; p < part->size(); ++p)
    {
      if (not part->has_weight(p))
        continue;
      result.slave.push_back(part->slave[p]);
      result.master.push_back(part->master[p]);
      const auto weights = part->weight.begin() + n * n * p;
      result.weight.insert(result.weight.end(), weights, weights + n * n);
      const auto gaps = part->gap.begin() + n * p;
      result.gap.insert(result.gap.end(), gaps, gaps + n);
    }
  return result;
}

MortarSides::MortarSides(const SlaveNodes& slaves,
                         std::span<const double> reference, int gdim)
    : _slaves(&slaves), _gdim(gdim),
      _inradius(std::numeric_limits<double>::infinity())
{
  const geometry::FacetList slave = slaves.facets();
  const geometry::QuadraticFacets local
      = geometry::quadratic_facets(slaves.local(), slaves.shares().level);
  _numbers = local.nodes;
  _slave = local;
  for (std::int32_t& node : _slave.nodes)
    node = slaves.around()[node];
  for (std::int32_t f = 0; f < slave.size(); ++f)
  {
    std::array<Vector<3>, 4> p;
    for (std::size_t k = 0; k < 4; ++k)
      p[k] = vector_at(reference, slave[f][std::min(k, slave[f].size() - 1)],
                       gdim);
    double longest = 0;
    for (int k = 0; k < 4; ++k)
      longest = std::max(longest, norm(p[k] - p[(k + 3) % 4]));
    // Twice the area over the perimeter is no less than a third of it over the
    // longest edge
    const double area
        = gdim == 2 ? longest * longest : norm(cross(p[1] - p[0], p[2] - p[0]));
    _inradius = std::min(_inradius, area / longest / 3);
  }
}

void MortarSides::set_master_facets(const geometry::FacetList& master,
                                    std::span<const std::int8_t> level)
{
  _master = geometry::quadratic_facets(master, level);
}

std::vector<double>
MortarSides::at_corners(std::span<const double> values,
                        std::span<const std::int32_t> facets) const
{
  std::vector<double> corners(width() * facets.size());
  for (std::size_t p = 0; p < facets.size(); ++p)
    for (int s = 0; s < width(); ++s)
      corners[width() * p + s] = at(values, numbers(facets[p])[s]);
  return corners;
}

std::vector<double> MortarSides::total(std::span<const double> values) const
{
  std::vector<double> sums(around().size(), 0);
  for (std::size_t c = 0; c < _numbers.size(); ++c)
    sums[_numbers[c]] += values[c];
  sums.resize(size());
  return sums;
}

std::vector<double>
MortarSides::total(std::span<const double> values,
                   std::span<const std::int32_t> facets) const
{
  std::vector<double> sums(size(), 0);
  for (std::size_t p = 0; p < facets.size(); ++p)
    for (int s = 0; s < width(); ++s)
      if (const std::int32_t i = numbers(facets[p])[s];
          i < std::int32_t(size()))
        sums[i] += values[width() * p + s];
  return sums;
}

std::vector<kernel::Pairs>
MortarSides::pairs(const Mortar& mortar, std::span<const double> dual,
                   std::span<const double> normal,
                   std::span<const kernel::Keeps> keeps,
                   std::span<const double> corner, bool is_movement) const
{
  std::vector<kernel::Pairs> groups;
  const std::size_t stride = width();
  for (int n = 2; n <= width(); ++n)
    for (int m = 2; m <= width(); ++m)
    {
      const kernel::MortarLayout at(n, m);
      kernel::Pairs group;
      group.num_slaves = n;
      group.num_nodes = m;
      group.data_size = at.size;
      group.is_movement = is_movement;
      for (std::size_t p = 0; p < mortar.size(); ++p)
      {
        const std::int32_t e = mortar.slave[p], f = mortar.master[p];
        if (_slave.sizes[e] != n or _master.sizes[f] != m)
          continue;
        const auto slaves = numbers(e).first(n);
        group.slaves.insert(group.slaves.end(), slaves.begin(), slaves.end());
        const auto own = slave_nodes(e).first(n);
        group.nodes.insert(group.nodes.end(), own.begin(), own.end());
        const auto theirs = master_nodes(f).first(m);
        group.nodes.insert(group.nodes.end(), theirs.begin(), theirs.end());
        const std::size_t first = group.data.size();
        group.data.resize(first + at.size);
        double* data = group.data.data() + first;
        for (int s = 0; s < n; ++s)
        {
          for (int l = 0; l < m; ++l)
            data[at.weight + m * s + l] = mortar.row(p, s)[l];
          for (int t = 0; t < n; ++t)
            data[at.dual + n * s + t] = dual[stride * (stride * e + s) + t];
          data[at.gap + s] = mortar.gap[stride * p + s];
        }
        for (int k = 0; k < 3; ++k)
          data[at.normal + k] = normal[3 * std::size_t(e) + k];
        data[at.keeps] = static_cast<double>(keeps[e]);
        if (not corner.empty())
          std::copy_n(corner.begin() + 12 * std::size_t(e), 3 * n,
                      data + at.normals);
        const std::vector<double>& weight = _slaves->weight();
        for (int k = 0; k < 4; ++k)
        {
          const int of_slave = _slave.places[4 * std::size_t(e) + k];
          data[at.factor + k] = weight.empty() ? 1 : weight[slaves[of_slave]];
          data[at.slave_places + k] = of_slave;
          data[at.master_places + k] = _master.places[4 * std::size_t(f) + k];
        }
      }
      if (not group.slaves.empty())
        groups.push_back(std::move(group));
    }
  return groups;
}

std::vector<double> MortarSides::frames(std::span<const double> x) const
{
  const int g = _gdim;
  std::vector<std::int32_t> facet(around().size(), 0);
  for (std::size_t c = 0; c < _numbers.size(); ++c)
    facet[_numbers[c]] = static_cast<std::int32_t>(c / width());
  std::vector<double> frames(size() * g * g);
  for (std::size_t i = 0; i < size(); ++i)
  {
    std::array<Vector<3>, 3> p;
    for (int k = 0; k < 3; ++k)
      p[k] = vector_at(x, slave_nodes(facet[i])[k], g);
    Vector<3> along = p[1] - p[0];
    along = (1 / norm(along)) * along;
    Vector<3> n{along[1], -along[0], 0};
    if (g == 3)
    {
      n = cross(along, p[2] - p[0]);
      n = (1 / norm(n)) * n;
    }
    const std::array columns{n, along, cross(n, along)};
    for (int r = 0; r < g; ++r)
      for (int c = 0; c < g; ++c)
        frames[g * (g * i + r) + c] = columns[c][r];
  }
  return frames;
}

std::vector<double>
MortarSides::master_normals(std::span<const double> x,
                            const geometry::FacetPairs& pairs,
                            std::span<const double> weight) const
{
  std::vector<double> mean(3 * std::size_t(num_slave_facets()), 0);
  for (std::size_t p = 0; p < pairs.size(); ++p)
  {
    double share = 0;
    const auto n = static_cast<std::size_t>(width()) * width();
    for (std::size_t k = 0; k < n; ++k)
      share += weight[n * p + k];
    const auto theirs = master_normal(x, pairs.master[p]);
    for (int k = 0; k < 3; ++k)
      mean[3 * std::size_t(pairs.slave[p]) + k] += share * theirs[k];
  }
  normalise(mean);
  return mean;
}

std::vector<std::int8_t> MortarSides::at_edges(std::span<const double> x) const
{
  const geometry::FacetList facets = _slaves->local();
  const std::vector<double> here
      = _slaves->here({x.begin(), x.end()}, _gdim, "x");
  const std::vector<double> normals
      = geometry::middles(facets, here, _gdim).normals;
  std::vector<std::vector<std::int32_t>> around(size());
  for (std::int32_t f = 0; f < facets.size(); ++f)
    for (const std::int32_t node : facets[f])
      if (node < std::int32_t(size()))
        around[node].push_back(f);
  const auto cosine = [&](std::int32_t e, std::int32_t f)
  {
    double c = 0;
    for (int k = 0; k < _gdim; ++k)
      c += normals[_gdim * e + k] * normals[_gdim * f + k];
    return c;
  };
  std::vector<std::int8_t> is_edge(size(), 0);
  for (std::size_t i = 0; i < size(); ++i)
    for (const std::int32_t e : around[i])
      for (const std::int32_t f : around[i])
        if (cosine(e, f) < geometry::cosine_at_edges)
          is_edge[i] = 1;
  const auto marks = _slaves->scatter_forward(std::span(is_edge));
  const std::vector<double> values(marks.begin(), marks.end());
  const std::vector<double> most = _slaves->largest(values);
  return {most.begin(), most.end()};
}

std::vector<double> MortarSides::between(std::span<const double> x,
                                         const geometry::FacetPairs& pairs,
                                         std::span<const double> weight,
                                         std::span<const double> normal) const
{
  std::vector<double> mean = master_normals(x, pairs, weight);
  for (std::size_t k = 0; k < mean.size(); ++k)
    mean[k] += normal[k];
  normalise(mean);
  return mean;
}

/// Unit normal at the middle of a master facet.
std::array<double, 3> MortarSides::master_normal(std::span<const double> x,
                                                 std::int32_t facet) const
{
  std::array<Vector<3>, 4> p;
  for (int k = 0; k < 4; ++k)
    p[k] = vector_at(x, master_nodes(facet)[k], _gdim);
  const Vector<3> first = p[1] - p[0];
  Vector<3> n{first[1], -first[0], 0};
  if (_gdim == 3)
    // The diagonals of a quadrilateral, whose last node is opposite to its
    // first
    n = _master.sizes[facet] == 4 or _master.sizes[facet] == 9
            ? cross(p[3] - p[0], p[2] - p[1])
            : cross(first, p[2] - p[0]);
  normalise(n);
  return n;
}
