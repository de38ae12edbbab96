// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "slave_nodes.h"
#include "../check.h"
#include "../geometry/facing.h"
#include "../math/scales.h"
#include "../mesh/ranks.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::contact;

namespace
{
void check_facets(const geometry::FacetList& facets, std::int32_t num_nodes,
                  const std::string& name)
{
  const auto& offsets = facets.offsets;
  if (offsets.empty() or offsets.front() != 0
      or offsets.back() != std::ssize(facets.nodes)
      or not std::ranges::is_sorted(offsets, std::ranges::less_equal()))
    throw std::invalid_argument(name
                                + ": the offsets of the facets do not fit");
  check::numbers(facets.nodes, num_nodes, name, "nodes");
}

/// Values at owned slave nodes for all slave nodes, sent as numbers of type N.
template <class N, class T>
std::vector<T> scattered(const SlaveNodes& slaves, std::span<const T> values,
                         int width)
{
  check::require(width > 0, "width must be at least 1");
  check::rows(values.size(), slaves.owned().size(), width, "values",
              "owned slave node");
  const mesh::NodeMap& nodes = slaves.nodes();
  if (nodes.ranks().size() == 1)
    return {values.begin(), values.end()};
  std::vector<N> every(static_cast<std::size_t>(nodes.num_nodes()) * width, 0);
  const auto row = [&every, width](std::int32_t node)
  { return every.begin() + static_cast<std::ptrdiff_t>(node) * width; };
  for (std::size_t i = 0; i < slaves.owned().size(); ++i)
    std::copy_n(values.begin() + i * width, width, row(slaves.owned()[i]));
  nodes.forward(std::span<N>(every), width);
  std::vector<T> result;
  result.reserve(slaves.around().size() * width);
  for (std::int32_t node : slaves.around())
    std::transform(row(node), row(node) + width, std::back_inserter(result),
                   [](N value) { return static_cast<T>(value); });
  return result;
}

/// What is left of the values at each facet's nodes.
template <class T, class Function>
std::vector<T> of_facets(const geometry::FacetList& facets,
                         std::span<const T> values, Function better)
{
  std::vector<T> result(facets.size());
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    T value = values[nodes.front()];
    for (std::int32_t node : nodes.subspan(1))
      // NaN stays
      if (not(better(value, values[node]) or value != value))
        value = values[node];
    result[f] = value;
  }
  return result;
}
} // namespace

SlaveNodes::SlaveNodes(std::shared_ptr<const mesh::NodeMap> nodes,
                       const geometry::FacetList& facets,
                       const geometry::FacetList& own)
    : _nodes(std::move(nodes)), _facets(geometry::copied(facets)),
      _own(geometry::copied(own))
{
  if (not _nodes)
    throw std::invalid_argument("nodes must not be empty");
  check_facets(facets, _nodes->num_nodes(), "facets");
  check_facets(own, _nodes->num_nodes(), "own");
  _around = _facets.nodes;
  std::ranges::sort(_around);
  _around.erase(std::unique(_around.begin(), _around.end()), _around.end());
  const auto place = [this](std::int32_t node)
  {
    return static_cast<std::int32_t>(std::ranges::lower_bound(_around, node)
                                     - _around.begin());
  };
  _num_owned = place(_nodes->num_owned());
  _corners.resize(_facets.nodes.size());
  std::ranges::transform(_facets.nodes, _corners.begin(), place);
}

void SlaveNodes::set_weight(std::span<const double> weight)
{
  double most = 0;
  for (const double w : weight)
    most = std::max(most, std::abs(w));
  const double least = -math::round_off * mesh::largest(_nodes->ranks(), most);
  _nodes->ranks().agree(
      [&]
      {
        check::rows(weight.size(), _num_owned, 1, "weight");
        if (std::ranges::any_of(
                weight, [least](double w)
                { return not(std::isfinite(w) and w >= least); }))
          throw std::invalid_argument("the weight must be finite and not "
                                      "negative on the slave surface");
      });
  std::vector<double> own(weight.begin(), weight.end());
  for (double& w : own)
    w = std::max(w, 0.0);
  _weight = scatter_forward(own);
  _nodes->ranks().agree(
      [this]
      {
        for (const double most : largest(_weight))
          if (not(most > 0))
            throw std::invalid_argument(
                "the weight is zero all over a slave facet: take such facets "
                "out of the surface, as those on the axis of an axisymmetric "
                "model");
      });
}

void SlaveNodes::set_level(std::span<const std::int8_t> level, bool is_mortar)
{
  _nodes->ranks().agree(
      [&]
      {
        check::rows(level.size(), _num_owned, 1, "level");
        if (std::ranges::any_of(level,
                                [](std::int8_t k) { return k < 0 or k > 2; }))
          throw std::invalid_argument("level must be 0, 1 or 2");
      });
  _level = scatter_forward(level);
  _is_quadratic = true;
  _is_mortar = is_mortar;
}

std::vector<double> SlaveNodes::corner_weight() const
{
  std::vector<double> corners;
  if (not _weight.empty())
    for (const std::int32_t place : _corners)
      corners.push_back(_weight[place]);
  return corners;
}

std::vector<double> SlaveNodes::scatter_forward(std::span<const double> values,
                                                int width) const
{
  return scattered<double>(*this, values, width);
}

std::vector<std::int64_t>
SlaveNodes::scatter_forward(std::span<const std::int64_t> values,
                            int width) const
{
  return scattered<std::int64_t>(*this, values, width);
}

std::vector<std::int8_t>
SlaveNodes::scatter_forward(std::span<const std::int8_t> values,
                            int width) const
{
  return scattered<std::int64_t>(*this, values, width);
}

std::vector<double> SlaveNodes::here(std::span<const double> values, int width,
                                     const char* name) const
{
  check::require(width > 0, "width must be at least 1");
  check::rows(values.size(), _nodes->num_nodes(), width, name, "node");
  std::vector<double> result(_around.size() * width);
  for (std::size_t i = 0; i < _around.size(); ++i)
    std::copy_n(values.begin() + static_cast<std::size_t>(_around[i]) * width,
                width, result.begin() + i * width);
  return result;
}

std::vector<double> SlaveNodes::padded(std::span<const double> normal,
                                       int gdim) const
{
  check::rows(normal.size(), _num_owned, gdim, "normal");
  std::vector<double> every(normal.begin(), normal.end());
  every.resize(_around.size() * gdim, 0);
  return every;
}

std::vector<std::int8_t> SlaveNodes::facing(std::span<const double> x,
                                            std::span<const double> normal,
                                            int gdim) const
{
  check::dimension(gdim);
  std::vector<std::int8_t> faces
      = facing_nodes(local(), here(x, gdim, "x"), padded(normal, gdim), gdim);
  faces.resize(_num_owned);
  return faces;
}

std::vector<double> SlaveNodes::facing_areas(std::span<const double> reference,
                                             std::span<const double> x,
                                             std::span<const double> normal,
                                             int gdim) const
{
  check::dimension(gdim);
  return geometry::facing_areas(local(), here(reference, gdim, "reference"),
                                here(x, gdim, "x"), padded(normal, gdim), gdim,
                                shares());
}

std::vector<double> SlaveNodes::largest(std::span<const double> values) const
{
  check::rows(values.size(), _around.size(), 1, "values");
  return of_facets(local(), values, std::greater_equal());
}

std::vector<double> SlaveNodes::smallest(std::span<const double> values) const
{
  check::rows(values.size(), _around.size(), 1, "values");
  return of_facets(local(), values, std::less_equal());
}

std::vector<std::int8_t>
SlaveNodes::near(std::span<const std::int8_t> which) const
{
  using Values = std::span<const std::int8_t>;
  const std::vector<std::int8_t> at = scatter_forward(which);
  std::vector<std::int8_t> level
      = of_facets(local(), Values(at), std::greater_equal());
  // Of a node of another rank not all facets are here
  std::vector<std::int8_t> touched(_around.size(), 0);
  const geometry::FacetList facets = local();
  for (std::int32_t f = 0; f < facets.size(); ++f)
    for (std::int32_t node : facets[f])
      touched[node] |= level[f];
  const std::vector<std::int8_t> around
      = scatter_forward(Values(touched).first(_num_owned));
  const std::vector<std::int8_t> beside
      = of_facets(facets, Values(around), std::greater_equal());
  std::ranges::transform(level, beside, level.begin(), std::plus());
  return level;
}

std::vector<double> SlaveNodes::sums(std::span<const double> corners) const
{
  check::rows(corners.size(), _corners.size(), 1, "corners");
  std::vector<double> sums(_around.size(), 0);
  for (std::size_t c = 0; c < corners.size(); ++c)
    sums[_corners[c]] += corners[c];
  sums.resize(_num_owned);
  return sums;
}
