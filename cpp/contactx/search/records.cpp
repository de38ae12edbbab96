// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "records.h"
#include <algorithm>

using namespace contactx;
using namespace contactx::search;

namespace
{
// They are sent as they lie in memory
static_assert(sizeof(FacetRecord) == 80);

/// Send facets by rank, and receive those of others.
std::map<int, FacetRecords> exchanged(mesh::Ranks& ranks,
                                      const std::map<int, FacetRecords>& facets)
{
  mesh::Messages out;
  for (const auto& [rank, theirs] : facets)
    mesh::pack<FacetRecord>(out[rank], theirs);
  std::map<int, FacetRecords> in;
  for (const auto& [rank, bytes] : ranks.exchange(out))
  {
    std::span<const std::byte> left = bytes;
    in[rank]
        = mesh::unpack<FacetRecord>(left, bytes.size() / sizeof(FacetRecord));
  }
  return in;
}
} // namespace

int FacetRecord::size() const
{
  return static_cast<int>(std::ranges::find(numbers, none) - numbers.begin());
}

FacetKey FacetRecord::key() const
{
  FacetKey key = original;
  std::ranges::sort(key);
  return key;
}

FacetRecord FacetRecord::nothing()
{
  FacetRecord record;
  record.numbers.fill(none);
  record.original.fill(none);
  record.owners.fill(-1);
  return record;
}

FacetKey contactx::search::key_of(std::span<const std::int64_t> name)
{
  FacetKey key;
  for (int l = 0; l < most_nodes; ++l)
    key[l] = name[l] < 0 ? FacetRecord::none : name[l];
  std::ranges::sort(key);
  return key;
}

FacetRecords contactx::search::records(const geometry::FacetList& facets,
                                       const mesh::Halo& halo)
{
  const std::vector<std::int64_t> numbers = halo.numbers(facets.nodes);
  const std::vector<std::int32_t> owners = halo.owners(facets.nodes);
  FacetRecords result(facets.size(), FacetRecord::nothing());
  for (std::int32_t f = 0; f < facets.size(); ++f)
    for (std::int32_t i = facets.offsets[f]; i < facets.offsets[f + 1]; ++i)
    {
      const std::int32_t l = i - facets.offsets[f];
      result[f].numbers[l] = numbers[i];
      result[f].original[l] = halo.original()[facets.nodes[i]];
      result[f].owners[l] = owners[i];
    }
  return result;
}

FacetRecords contactx::search::joined(FacetRecords facets)
{
  std::ranges::stable_sort(facets, {}, &FacetRecord::key);
  const auto same = [](const FacetRecord& a, const FacetRecord& b)
  { return a.key() == b.key(); };
  const auto twice = std::unique(facets.begin(), facets.end(), same);
  facets.erase(twice, facets.end());
  return facets;
}

void contactx::search::add_to(mesh::Halo& halo, const FacetRecords& facets,
                              bool for_good)
{
  std::vector<std::int64_t> numbers;
  std::vector<std::int32_t> owners;
  for (const FacetRecord& facet : facets)
    for (int l = 0; l < facet.size(); ++l)
    {
      numbers.push_back(facet.numbers[l]);
      owners.push_back(facet.owners[l]);
    }
  halo.grow(numbers, owners, for_good);
}

geometry::Facets contactx::search::here(const FacetRecords& facets,
                                        const mesh::Halo& halo)
{
  geometry::Facets result;
  std::vector<std::int64_t> numbers;
  for (const FacetRecord& facet : facets)
  {
    numbers.insert(numbers.end(), facet.numbers.begin(),
                   facet.numbers.begin() + facet.size());
    result.offsets.push_back(static_cast<std::int32_t>(numbers.size()));
  }
  result.nodes = halo.find(numbers);
  return result;
}

std::map<int, FacetRecords>
contactx::search::around_nodes(mesh::Ranks& ranks, const FacetRecords& facets,
                               const geometry::QuadraticFacets* parents)
{
  std::map<int, FacetRecords> out;
  std::vector<std::int32_t> owners;
  for (std::size_t f = 0; f < facets.size(); ++f)
  {
    owners.clear();
    const auto add = [&owners](const FacetRecord& facet)
    {
      owners.insert(owners.end(), facet.owners.begin(),
                    facet.owners.begin() + facet.size());
    };
    if (parents)
      for (const std::int32_t part :
           parents->parts_of(static_cast<std::int32_t>(f)))
        add(facets[part]);
    else
      add(facets[f]);
    std::ranges::sort(owners);
    owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
    for (const std::int32_t owner : owners)
      out[owner].push_back(facets[f]);
  }
  return exchanged(ranks, out);
}

FacetRecords contactx::search::around_facets(mesh::Ranks& ranks,
                                             const FacetRecords& facets)
{
  // The owner of a node knows all facets there, and their ranks
  const auto at_nodes = around_nodes(ranks, facets);
  FacetRecords every;
  for (const auto& [rank, theirs] : at_nodes)
    every.insert(every.end(), theirs.begin(), theirs.end());
  every = joined(std::move(every));
  std::map<int, FacetRecords> out;
  for (const auto& [rank, theirs] : at_nodes)
  {
    std::vector<std::int64_t> nodes;
    for (const FacetRecord& facet : theirs)
      for (int l = 0; l < facet.size(); ++l)
        if (facet.owners[l] == ranks.rank())
          nodes.push_back(facet.numbers[l]);
    std::ranges::sort(nodes);
    std::ranges::copy_if(
        every, std::back_inserter(out[rank]),
        [&nodes](const FacetRecord& facet)
        {
          return std::ranges::any_of(
              std::span(facet.numbers).first(facet.size()),
              [&nodes](std::int64_t number)
              { return std::ranges::binary_search(nodes, number); });
        });
  }
  FacetRecords found = facets;
  for (const auto& [rank, theirs] : exchanged(ranks, out))
    found.insert(found.end(), theirs.begin(), theirs.end());
  return joined(std::move(found));
}
