// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master_surface.h"
#include "../check.h"
#include "../math/vec.h"
#include "distributed.h"
#include <map>
#include <numeric>
#include <stdexcept>

using namespace contactx;
using namespace contactx::search;

MasterSurface::MasterSurface(std::shared_ptr<mesh::Halo> halo,
                             std::shared_ptr<const geometry::Facets> own,
                             std::shared_ptr<const geometry::Facets> around)
    : _halo(std::move(halo)),
      _finder(around->offsets, around->nodes, _halo->gdim()), _facets(own),
      _own(std::move(own)), _around(std::move(around))
{
}

MasterSurface::MasterSurface(std::shared_ptr<mesh::Halo> halo,
                             geometry::Facets own)
    : _halo(std::move(halo)), _finder(own.offsets, own.nodes, _halo->gdim()),
      _facets(std::make_shared<const geometry::Facets>(std::move(own))),
      _own(_facets), _around(_facets)
{
}

void MasterSurface::set_facets(geometry::Facets facets)
{
  _facets = std::make_shared<const geometry::Facets>(std::move(facets));
  ++_version;
}

void MasterSurface::check_points(std::span<const double> x,
                                 std::span<const double> points,
                                 std::span<const double> normals) const
{
  const int gdim = _halo->gdim();
  check::positions(x.size(), _finder.surface().num_nodes(), gdim);
  check::positions(points.size(), 0, gdim, "points");
  check::rows(normals.size(), points.size() / gdim, gdim, "normals", "point");
}

Found MasterSurface::find(std::span<const double> x,
                          std::span<const double> points,
                          std::span<const double> normals, double reach)
{
  check_points(x, points, normals);
  _finder.refit(x);
  return _finder.find(
      x, points, normals,
      std::vector<double>(points.size() / _halo->gdim(), reach));
}

Found MasterSurface::find_of_nodes(std::span<const double> x,
                                   std::span<const std::int32_t> nodes,
                                   std::span<const double> normals,
                                   double reach)
{
  const std::size_t gdim = _halo->gdim();
  std::vector<double> points;
  for (const std::int32_t node : nodes)
    points.insert(points.end(), x.begin() + std::size_t(node) * gdim,
                  x.begin() + (std::size_t(node) + 1) * gdim);
  return find(x, points, normals, reach);
}

std::int32_t MasterSurface::pair(Pairing& pairing, const geometry::FacetList&,
                                 std::span<const double> x, double reach,
                                 std::span<const std::int8_t> closed)
{
  check::positions(x.size(), pairing.num_nodes(), _halo->gdim());
  check::rows(closed.size(), pairing.slaves().size(), 1, "closed",
              "slave node");
  return pairing.update(x, reach, closed);
}

void MasterSurface::add_facets_within(std::span<const double>,
                                      const geometry::FacetList&, double,
                                      double, std::span<const double>)
{
}

std::vector<std::int32_t>
MasterSurface::keep(std::span<const std::int32_t> used)
{
  return {used.begin(), used.end()};
}

double MasterSurface::distance(std::span<const double> x,
                               std::span<const double> points)
{
  const Found found
      = find(x, points, std::vector<double>(points.size(), 0), infinity);
  return std::accumulate(found.distance.begin(), found.distance.end(), infinity,
                         [](double a, double b) { return std::min(a, b); });
}

double MasterSurface::mean(std::span<const double> nodal)
{
  check::positions(nodal.size(), _finder.surface().num_nodes(), 1, "nodal");
  std::array<double, 2> sums{0, static_cast<double>(own().nodes.size())};
  for (const std::int32_t node : own().nodes)
    sums[0] += nodal[node];
  if (_halo->ranks().size() > 1)
    _halo->ranks().reduce(sums, mesh::Reduction::sum);
  return sums[0] / sums[1];
}

std::vector<std::int64_t>
MasterSurface::names_of(const geometry::FacetList& facets) const
{
  std::vector<std::int64_t> names(
      static_cast<std::size_t>(facets.size()) * most_nodes, -1);
  for (std::int32_t f = 0; f < facets.size(); ++f)
    for (std::size_t l = 0; l < facets[f].size(); ++l)
      names[static_cast<std::size_t>(f) * most_nodes + l]
          = _halo->original()[facets[f][l]];
  return names;
}

std::vector<std::int64_t> MasterSurface::identity() const
{
  return names_of(own());
}

std::vector<std::int64_t>
MasterSurface::names(std::span<const std::int32_t> which) const
{
  check::numbers(which, facets().size(), "which", "facets", -1);
  std::vector<std::int64_t> names(which.size() * most_nodes, -1);
  for (std::size_t i = 0; i < which.size(); ++i)
    if (which[i] >= 0)
      for (std::size_t l = 0; l < facets()[which[i]].size(); ++l)
        names[i * most_nodes + l] = _halo->original()[facets()[which[i]][l]];
  return names;
}

std::vector<std::int32_t>
MasterSurface::named(std::span<const std::int64_t> names)
{
  check::rows(names.size(), names.size() / most_nodes, most_nodes, "names",
              "facet");
  std::map<FacetKey, std::int32_t> known;
  const std::vector<std::int64_t> every = names_of(facets());
  for (std::int32_t f = 0; f < facets().size(); ++f)
    known.emplace(key_of(std::span(every).subspan(most_nodes * f)), f);
  std::vector<std::int32_t> which(names.size() / most_nodes, -1);
  for (std::size_t i = 0; i < which.size(); ++i)
  {
    const FacetKey key = key_of(names.subspan(most_nodes * i));
    if (key.front() == FacetRecord::none)
      continue;
    const auto at = known.find(key);
    if (at == known.end())
      throw std::invalid_argument("a pair with a facet that does not exist");
    which[i] = at->second;
  }
  return which;
}

std::shared_ptr<MasterSurface> contactx::search::make_master_surface(
    std::shared_ptr<mesh::Halo> halo, std::span<const std::int32_t> offsets,
    std::span<const std::int32_t> nodes, std::span<const std::int8_t> level)
{
  geometry::Facets own{{offsets.begin(), offsets.end()},
                       {nodes.begin(), nodes.end()}};
  if (halo->ranks().size() == 1)
    return std::make_shared<MasterSurface>(std::move(halo), std::move(own));
  return std::make_shared<DistributedSurface>(std::move(halo), std::move(own),
                                              level);
}
