// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "distributed.h"
#include "../check.h"
#include "../math/scales.h"
#include "facet_search.h"
#include <algorithm>
#include <stdexcept>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// Distance up to which another facet may be as near as one of this distance
double tie_bound(double distance, double size)
{
  return distance + 10 * math::distance_round_off(distance, size);
}

/// What a rank has for a point. It is sent as it lies in memory.
struct Answer
{
  std::int32_t point, feature;
  double distance, size, gap;
  Vector<2> xi;
  Vector<3> normal;
  FacetKey key;      // of the nearest facet
  FacetRecord facet; // that contact is measured with, of no node without one
};
static_assert(sizeof(Answer)
              == 2 * sizeof(std::int32_t) + 8 * sizeof(double)
                     + sizeof(FacetKey) + sizeof(FacetRecord));

/// The rows of some points.
std::vector<double> rows(std::span<const double> values,
                         std::span<const std::int32_t> which, int width)
{
  std::vector<double> result;
  result.reserve(which.size() * width);
  for (const std::int32_t i : which)
  {
    const auto row = values.subspan(static_cast<std::size_t>(i) * width, width);
    result.insert(result.end(), row.begin(), row.end());
  }
  return result;
}

bool same(const geometry::FacetList& a, const geometry::FacetList& b)
{
  return std::ranges::equal(a.offsets, b.offsets)
         and std::ranges::equal(a.nodes, b.nodes);
}
} // namespace

/// What a surface begins with.
struct DistributedSurface::Parts
{
  Parts(mesh::Halo& halo, const geometry::Facets& own)
      : own_records(joined(records(own.list(), halo))),
        around_records(around_facets(halo.ranks(), own_records))
  {
    // Contact may be measured with a facet beside the nearest one, and in the
    // plane with the normal half way between that and the next one
    if (halo.gdim() == 2)
      around_records = around_facets(halo.ranks(), around_records);
    add_to(halo, around_records, true);
  }

  FacetRecords own_records, around_records;
};

/// The best answers so far, a row a point.
class DistributedSurface::Best
{
public:
  Best(std::size_t n, double reach)
      : bound(n, reach), found(n), facet(n, FacetRecord::nothing()),
        _key(n, FacetKey{})
  {
  }

  /// Take what is nearer, and of facets as near the first one.
  void take(std::span<const std::int32_t> which,
            std::span<const std::byte> answers)
  {
    for (const Answer& a :
         mesh::unpack<Answer>(answers, answers.size() / sizeof(Answer)))
    {
      const std::int32_t i = which[a.point];
      const double before = found.distance[i];
      const double tol = math::distance_round_off(a.distance, a.size);
      if (not(a.distance < before - tol)
          and not(a.distance <= before + tol and a.key < _key[i]))
        continue;
      found.distance[i] = a.distance;
      bound[i] = std::min(bound[i], tie_bound(a.distance, a.size));
      // Its number is known at the end
      found.take(i, Projection{-1, a.feature, a.xi, {}, a.normal, a.gap, 0, 0});
      facet[i] = a.facet;
      _key[i] = a.key;
    }
  }

  std::vector<double> bound;
  Found found;
  FacetRecords facet;

private:
  std::vector<FacetKey> _key;
};

DistributedSurface::DistributedSurface(std::shared_ptr<mesh::Halo> halo,
                                       geometry::Facets own,
                                       std::span<const std::int8_t> level)
    : DistributedSurface(halo, Parts(*halo, own))
{
  _own_parents = geometry::quadratic_facets(this->own(), level);
}

DistributedSurface::DistributedSurface(std::shared_ptr<mesh::Halo> halo,
                                       Parts parts)
    : MasterSurface(halo,
                    std::make_shared<const geometry::Facets>(
                        here(parts.own_records, *halo)),
                    std::make_shared<const geometry::Facets>(
                        here(parts.around_records, *halo))),
      _own_records(std::move(parts.own_records)),
      _around_records(std::move(parts.around_records))
{
  for (const FacetRecord& facet : _around_records)
    _is_own.push_back(std::ranges::binary_search(_own_records, facet.key(), {},
                                                 &FacetRecord::key));
  set_facets({});
}

Found DistributedSurface::find(std::span<const double> x,
                               std::span<const double> points,
                               std::span<const double> normals, double reach)
{
  check_points(x, points, normals);
  const int gdim = _halo->gdim();
  const std::size_t n = points.size() / gdim;
  _finder.refit(x);
  Best best(n, reach);
  std::vector<std::int32_t> every(n);
  for (std::size_t i = 0; i < n; ++i)
    every[i] = static_cast<std::int32_t>(i);
  best.take(every, answer(x, points, normals, best.bound));

  const RankBoxes others(_halo->ranks(), own(), x, gdim);
  std::vector<double> bound = best.bound;
  for (double& b : bound)
    b *= 1 + math::equal_rel_tol;
  RankBoxes::Near near = others.from_points(points, normals, bound);
  const std::size_t m = near.ranks.size();
  // First the nearest rank, then all that may still have something nearer
  std::map<int, std::vector<std::int32_t>> wanted;
  for (const std::int32_t i : every)
  {
    const std::span row = std::span(near.distance).subspan(i * m, m);
    for (std::size_t j = 0; j < m; ++j)
      if (near.ranks[j] == _halo->ranks().rank())
        row[j] = infinity;
    const auto first = std::ranges::min_element(row);
    if (first == row.end() or *first == infinity)
      continue;
    wanted[near.ranks[first - row.begin()]].push_back(i);
    *first = infinity;
  }
  ask(x, points, normals, wanted, best);
  wanted.clear();
  for (const std::int32_t i : every)
    for (std::size_t j = 0; j < m; ++j)
    {
      const double distance = near.distance[i * m + j];
      if (distance < infinity
          and distance <= best.bound[i] * (1 + math::equal_rel_tol))
        wanted[near.ranks[j]].push_back(i);
    }
  ask(x, points, normals, wanted, best);

  FacetRecords selected;
  for (const FacetRecord& facet : best.facet)
    if (facet.size() > 0)
      selected.push_back(facet);
  const std::vector<std::int32_t> numbers = learn(selected);
  auto number = numbers.begin();
  for (std::size_t i = 0; i < n; ++i)
    if (best.facet[i].size() > 0)
      best.found.facet[i] = *number++;
  return std::move(best.found);
}

void DistributedSurface::ask(
    std::span<const double> x, std::span<const double> points,
    std::span<const double> normals,
    const std::map<int, std::vector<std::int32_t>>& wanted, Best& best)
{
  const int gdim = _halo->gdim();
  mesh::Messages questions;
  for (const auto& [rank, which] : wanted)
  {
    auto& bytes = questions[rank];
    mesh::pack<double>(bytes, rows(points, which, gdim));
    mesh::pack<double>(bytes, rows(normals, which, gdim));
    mesh::pack<double>(bytes, rows(best.bound, which, 1));
  }
  mesh::Messages answers;
  for (const auto& [rank, bytes] : _halo->ranks().exchange(questions))
  {
    std::span<const std::byte> left = bytes;
    const std::size_t n = bytes.size() / sizeof(double) / (2 * gdim + 1);
    const auto p = mesh::unpack<double>(left, n * gdim);
    const auto normal = mesh::unpack<double>(left, n * gdim);
    auto bound = mesh::unpack<double>(left, n);
    answers[rank] = answer(x, p, normal, bound);
  }
  for (const auto& [rank, bytes] : _halo->ranks().exchange(answers))
    best.take(wanted.at(rank), bytes);
}

std::vector<std::byte> DistributedSurface::answer(
    std::span<const double> x, std::span<const double> points,
    std::span<const double> normals, std::span<double> bound) const
{
  const FoundNearest found = _finder.find(x, points, normals, bound);
  std::vector<Answer> answers;
  for (std::size_t i = 0; i < bound.size(); ++i)
  {
    if (found.nearest[i] < 0)
      continue;
    if (!_is_own[found.nearest[i]])
    {
      bound[i]
          = std::min(bound[i], tie_bound(found.distance[i], found.size[i]));
      continue;
    }
    answers.push_back({static_cast<std::int32_t>(i),
                       found.feature[i],
                       found.distance[i],
                       found.size[i],
                       found.gap[i],
                       {},
                       {},
                       _around_records[found.nearest[i]].key(),
                       found.facet[i] < 0 ? FacetRecord::nothing()
                                          : _around_records[found.facet[i]]});
    std::copy_n(found.xi.begin() + 2 * i, 2, answers.back().xi.begin());
    std::copy_n(found.normal.begin() + 3 * i, 3, answers.back().normal.begin());
  }
  std::vector<std::byte> bytes;
  mesh::pack<Answer>(bytes, answers);
  return bytes;
}

std::vector<std::int32_t> DistributedSurface::learn(const FacetRecords& facets)
{
  FacetRecords fresh;
  std::ranges::copy_if(facets, std::back_inserter(fresh),
                       [this](const FacetRecord& facet)
                       { return !_place.contains(facet.key()); });
  fresh = joined(std::move(fresh));
  if (mesh::anywhere(_halo->ranks(), !fresh.empty()))
  {
    add_to(*_halo, fresh);
    FacetRecords known = std::move(_known);
    known.insert(known.end(), fresh.begin(), fresh.end());
    set_known(std::move(known));
  }
  std::vector<std::int32_t> numbers;
  for (const FacetRecord& facet : facets)
    numbers.push_back(_place.at(facet.key()));
  return numbers;
}

void DistributedSurface::set_known(FacetRecords known)
{
  _known = std::move(known);
  _place.clear();
  for (std::size_t f = 0; f < _known.size(); ++f)
    _place.emplace(_known[f].key(), static_cast<std::int32_t>(f));
  set_facets(here(_known, *_halo));
}

std::int32_t DistributedSurface::pair(Pairing& pairing,
                                      const geometry::FacetList& slave,
                                      std::span<const double> x, double reach,
                                      std::span<const std::int8_t> closed)
{
  const int gdim = _halo->gdim(), version = _halo->version();
  check::positions(x.size(), pairing.num_nodes(), gdim);
  check::rows(closed.size(), pairing.slaves().size(), 1, "closed",
              "slave node");
  const std::vector<std::int32_t> left = pairing.seek(x, reach);
  if (!mesh::anywhere(_halo->ranks(), !left.empty()))
    return 0;
  std::vector<std::int32_t> nodes;
  for (const std::int32_t i : left)
    nodes.push_back(pairing.slaves()[i]);
  const std::vector<double> normals = geometry::nodal_normals(slave, x, gdim);
  const Found found
      = find(x, rows(x, nodes, gdim), rows(normals, nodes, gdim), reach);
  std::vector<std::optional<Projection>> places(left.size());
  for (std::size_t k = 0; k < left.size(); ++k)
    if (found.facet[k] >= 0)
      places[k] = Projection{found.facet[k],
                             found.feature[k],
                             {found.xi[2 * k], found.xi[2 * k + 1]},
                             {},
                             {found.normal[3 * k], found.normal[3 * k + 1],
                              found.normal[3 * k + 2]},
                             0,
                             0,
                             0};
  return accept_projections(pairing, left, places, x, version, reach, closed);
}

std::int32_t DistributedSurface::accept_projections(
    Pairing& pairing, std::span<const std::int32_t> left,
    std::span<const std::optional<Projection>> places,
    std::span<const double> x, int version, double reach,
    std::span<const std::int8_t> closed)
{
  if (!same(pairing.master().facets(), facets()))
    pairing.set_master({facets().offsets.begin(), facets().offsets.end()},
                       {facets().nodes.begin(), facets().nodes.end()});
  std::vector<double> grown;
  if (version != _halo->version())
  {
    grown = _halo->updated({x.begin(), x.end()}, _halo->gdim(), version);
    x = grown;
  }
  std::int32_t changed = 0;
  for (std::size_t k = 0; k < left.size(); ++k)
    changed += pairing.accept_projection(left[k], places[k], x, reach,
                                         closed[left[k]] != 0);
  return changed;
}

void DistributedSurface::add_facets_within(std::span<const double> x,
                                           const geometry::FacetList& slave,
                                           double reach, double margin,
                                           std::span<const double> along)
{
  const int gdim = _halo->gdim();
  check::positions(x.size(), _finder.surface().num_nodes(), gdim);
  mesh::Ranks& ranks = _halo->ranks();
  const auto near
      = RankBoxes(ranks, own(), x, gdim).from_facets(x, slave, reach, along);
  // Sizes of the facets, then their corners and directions
  mesh::Messages questions;
  for (const auto& [rank, facets] : near)
  {
    std::vector<std::int32_t> sizes{static_cast<std::int32_t>(facets.size())},
        nodes;
    for (const std::int32_t f : facets)
    {
      sizes.push_back(static_cast<std::int32_t>(slave[f].size()));
      nodes.insert(nodes.end(), slave[f].begin(), slave[f].end());
    }
    mesh::pack<std::int32_t>(questions[rank], sizes);
    mesh::pack<double>(questions[rank], rows(x, nodes, gdim));
    if (not along.empty())
      mesh::pack<double>(questions[rank], rows(along, facets, 3));
  }
  // One search for what all ranks ask: its tree is made once
  geometry::Facets theirs;
  std::vector<double> every(x.begin(), x.end()), directions;
  std::vector<int> asker;
  for (const auto& [rank, bytes] : ranks.exchange(questions))
  {
    std::span<const std::byte> left = bytes;
    const std::int32_t count = mesh::unpack<std::int32_t>(left, 1).front();
    std::int32_t corners = 0;
    for (const std::int32_t size : mesh::unpack<std::int32_t>(left, count))
    {
      for (std::int32_t l = 0; l < size; ++l)
        theirs.nodes.push_back(static_cast<std::int32_t>(every.size() / gdim)
                               + corners++);
      theirs.offsets.push_back(static_cast<std::int32_t>(theirs.nodes.size()));
      asker.push_back(rank);
    }
    const auto more
        = mesh::unpack<double>(left, static_cast<std::size_t>(corners) * gdim);
    every.insert(every.end(), more.begin(), more.end());
    if (not left.empty())
    {
      const auto own
          = mesh::unpack<double>(left, 3 * static_cast<std::size_t>(count));
      directions.insert(directions.end(), own.begin(), own.end());
    }
  }
  std::map<int, std::vector<std::int32_t>> found;
  if (!asker.empty())
  {
    FacetSearch search(std::move(theirs.offsets), std::move(theirs.nodes),
                       {own().offsets.begin(), own().offsets.end()},
                       {own().nodes.begin(), own().nodes.end()}, gdim);
    const auto pairs = search.find(every, reach, margin, true, directions);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      found[asker[pairs.slave[i]]].push_back(pairs.master[i]);
  }
  mesh::Messages answers;
  for (auto& [rank, masters] : found)
  {
    FacetRecords records;
    std::vector<std::int32_t> whole;
    for (const std::int32_t f : masters)
      for (const std::int32_t part : _own_parents.parts_of(f))
        whole.push_back(part);
    for (const std::int32_t f : sorted_unique(whole))
      records.push_back(_own_records[f]);
    mesh::pack<FacetRecord>(answers[rank], records);
  }
  FacetRecords got;
  for (const auto& [rank, bytes] : ranks.exchange(answers))
  {
    std::span<const std::byte> left = bytes;
    const auto records
        = mesh::unpack<FacetRecord>(left, bytes.size() / sizeof(FacetRecord));
    got.insert(got.end(), records.begin(), records.end());
  }
  learn(got);
}

std::vector<std::int32_t>
DistributedSurface::keep(std::span<const std::int32_t> used)
{
  check::numbers(used, static_cast<std::int32_t>(_known.size()), "used",
                 "facets", -1);
  std::vector<std::int32_t> kept;
  std::ranges::copy_if(used, std::back_inserter(kept),
                       [](std::int32_t f) { return f >= 0; });
  kept = sorted_unique(kept);
  FacetRecords known;
  for (const std::int32_t f : kept)
    known.push_back(_known[f]);
  add_to(*_halo, known);
  set_known(std::move(known));
  std::vector<std::int32_t> result(used.size(), -1);
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] >= 0)
      result[i] = static_cast<std::int32_t>(
          std::ranges::lower_bound(kept, used[i]) - kept.begin());
  return result;
}

std::vector<std::int32_t>
DistributedSurface::named(std::span<const std::int64_t> names)
{
  mesh::Ranks& ranks = _halo->ranks();
  ranks.agree(
      [names]
      {
        check::rows(names.size(), names.size() / most_nodes, most_nodes,
                    "names", "facet");
      });
  std::vector<FacetKey> keys;
  for (std::size_t i = 0; i < names.size(); i += most_nodes)
    keys.push_back(key_of(names.subspan(i)));
  const auto is_facet
      = [](const FacetKey& key) { return key.front() != FacetRecord::none; };
  std::vector<FacetKey> missing;
  std::ranges::copy_if(keys, std::back_inserter(missing),
                       [this, is_facet](const FacetKey& key)
                       { return is_facet(key) and !_place.contains(key); });
  std::ranges::sort(missing);
  const auto twice = std::unique(missing.begin(), missing.end());
  missing.erase(twice, missing.end());
  // All may have what is not known here
  mesh::Messages questions;
  if (!missing.empty())
    for (int rank = 0; rank < ranks.size(); ++rank)
      mesh::pack<FacetKey>(questions[rank], missing);
  mesh::Messages answers;
  for (const auto& [rank, bytes] : ranks.exchange(questions))
  {
    std::span<const std::byte> left = bytes;
    FacetRecords theirs;
    for (const FacetKey& key :
         mesh::unpack<FacetKey>(left, bytes.size() / sizeof(FacetKey)))
    {
      const auto at
          = std::ranges::lower_bound(_own_records, key, {}, &FacetRecord::key);
      if (at != _own_records.end() and at->key() == key)
        theirs.push_back(*at);
    }
    if (!theirs.empty())
      mesh::pack<FacetRecord>(answers[rank], theirs);
  }
  FacetRecords got;
  for (const auto& [rank, bytes] : ranks.exchange(answers))
  {
    std::span<const std::byte> left = bytes;
    const auto records
        = mesh::unpack<FacetRecord>(left, bytes.size() / sizeof(FacetRecord));
    got.insert(got.end(), records.begin(), records.end());
  }
  got = joined(std::move(got));
  if (mesh::anywhere(ranks, got.size() < missing.size()))
    throw std::invalid_argument("a pair with a facet that does not exist");
  learn(got);
  std::vector<std::int32_t> which(keys.size(), -1);
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (is_facet(keys[i]))
      which[i] = _place.at(keys[i]);
  return which;
}
