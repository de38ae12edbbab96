// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "halo.h"
#include "../check.h"
#include <algorithm>
#include <numeric>
#include <string>

using namespace contactx::mesh;

Halo::Halo(BulkNodes bulk, std::unique_ptr<HaloAdapter> adapter)
    : _adapter(std::move(adapter)), _gdim(bulk.gdim),
      _num_owned(bulk.num_owned),
      _num_bulk(static_cast<std::int32_t>(bulk.numbers.size())),
      _num_kept(_num_bulk), _numbers(std::move(bulk.numbers)),
      _original(std::move(bulk.original)), _owners(std::move(bulk.owners)),
      _reference(std::move(bulk.reference))
{
  _adapter->ranks().agree(
      [this]
      {
        check::dimension(_gdim);
        if (_num_owned < 0 or _num_owned > _num_bulk)
          throw std::invalid_argument("num_owned must be from 0 to the number "
                                      "of the bulk's nodes");
        const std::size_t n = _numbers.size();
        if (_owners.size() != n or _original.size() != n
            or _reference.size() != n * _gdim)
          throw std::invalid_argument("numbers, owners, original and reference "
                                      "must have a row for each "
                                      "of the bulk's nodes");
      });
  sort();
  // Of ghosts the owner knows more
  forward(_original, 1);
  forward(_reference, _gdim);
  _start = displaced(std::vector<double>(_reference.size(), 0));
}

void Halo::forward(std::span<double> values, int width) const
{
  check(values.size(), width);
  if (ranks().size() > 1)
    _adapter->forward(values, width);
}

void Halo::forward(std::span<std::int64_t> values, int width) const
{
  check(values.size(), width);
  if (ranks().size() > 1)
    _adapter->forward(values, width);
}

void Halo::reverse(std::span<double> values, int width) const
{
  check(values.size(), width);
  if (ranks().size() > 1)
    _adapter->reverse(values, width);
}

std::shared_ptr<const Configuration>
Halo::displaced(std::vector<double> u) const
{
  Configuration made{std::move(u), _reference};
  for (std::size_t i = 0; i < made.x.size(); ++i)
    made.x[i] += made.u[i];
  return std::make_shared<const Configuration>(std::move(made));
}

std::shared_ptr<const Configuration> Halo::now() const
{
  std::vector<double> u(_reference.size());
  _adapter->displacement(u);
  if (not _now or _now->u != u)
    _now = displaced(std::move(u));
  return _now;
}

void Halo::accept()
{
  // Each contact calls this
  const auto next = now();
  if (next == _start)
    return;
  _before.assign(_start->u.begin(),
                 _start->u.begin() + std::ptrdiff_t(_num_owned) * _gdim);
  _start = next;
}

void Halo::set_start(std::span<const double> u)
{
  const std::size_t owned = std::size_t(_num_owned) * _gdim;
  ranks().agree(
      [&]
      {
        if (u.size() < owned)
          throw std::invalid_argument("u must have a row for each owned node");
      });
  std::vector<double> all(_reference.size(), 0);
  std::copy_n(u.begin(), owned, all.begin());
  forward(all, _gdim);
  _start = displaced(std::move(all));
}

std::vector<std::int64_t>
Halo::numbers(std::span<const std::int32_t> nodes) const
{
  check(nodes);
  std::vector<std::int64_t> result(nodes.size());
  std::ranges::transform(nodes, result.begin(),
                         [this](std::int32_t node) { return _numbers[node]; });
  return result;
}

std::vector<std::int32_t>
Halo::owners(std::span<const std::int32_t> nodes) const
{
  check(nodes);
  std::vector<std::int32_t> result(nodes.size());
  std::ranges::transform(nodes, result.begin(),
                         [this](std::int32_t node) { return _owners[node]; });
  return result;
}

std::int32_t Halo::node_of(std::int64_t number) const
{
  const auto by_number = [this](std::int32_t node) { return _numbers[node]; };
  const auto at = std::ranges::lower_bound(_order, number, {}, by_number);
  return at != _order.end() and _numbers[*at] == number ? *at : -1;
}

std::vector<std::int32_t>
Halo::find(std::span<const std::int64_t> numbers) const
{
  std::vector<std::int32_t> nodes(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    nodes[i] = node_of(numbers[i]);
    if (nodes[i] < 0)
      throw std::invalid_argument("numbers must be of nodes on this rank: "
                                  + std::to_string(numbers[i])
                                  + " is not here");
  }
  return nodes;
}

void Halo::grow(std::span<const std::int64_t> numbers,
                std::span<const std::int32_t> owners, bool for_good)
{
  if (owners.size() != numbers.size())
    throw std::invalid_argument("owners must be one for each of the numbers");
  if (ranks().size() == 1)
    return;
  using Fresh = std::pair<std::int64_t, std::int32_t>;
  std::vector<Fresh> fresh;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (node_of(numbers[i]) < 0)
      fresh.emplace_back(numbers[i], owners[i]);
  std::ranges::stable_sort(fresh, {}, &Fresh::first);
  const auto twice = std::unique(fresh.begin(), fresh.end(),
                                 [](const Fresh& a, const Fresh& b)
                                 { return a.first == b.first; });
  fresh.erase(twice, fresh.end());
  if (anywhere(ranks(), !fresh.empty()))
  {
    for (const auto& [number, owner] : fresh)
    {
      _numbers.push_back(number);
      _owners.push_back(owner);
    }
    take_ghosts();
  }
  if (for_good)
    _num_kept = num_nodes();
}

void Halo::shrink()
{
  if (ranks().size() == 1)
    return;
  _numbers.resize(_num_kept);
  _owners.resize(_num_kept);
  take_ghosts();
}

std::vector<double> Halo::updated(std::vector<double> values, int width,
                                  int version) const
{
  if (version == _version)
    return values;
  values.resize(static_cast<std::size_t>(num_nodes()) * width);
  forward(values, width);
  return values;
}

void Halo::take_ghosts()
{
  sort();
  _adapter->set_ghosts(std::span(_numbers).subspan(_num_bulk),
                       std::span(_owners).subspan(_num_bulk));
  _original.resize(_numbers.size());
  forward(_original, 1);
  _reference.resize(_numbers.size() * _gdim);
  forward(_reference, _gdim);
  std::vector<double> start = _start->u;
  start.resize(_reference.size());
  forward(start, _gdim);
  _start = displaced(std::move(start));
  ++_version;
  _adapter->changed();
  notify();
}

void Halo::sort()
{
  _order.resize(_numbers.size());
  std::iota(_order.begin(), _order.end(), 0);
  std::ranges::sort(_order, {},
                    [this](std::int32_t node) { return _numbers[node]; });
}

void Halo::check(std::span<const std::int32_t> nodes) const
{
  check::numbers(nodes, num_nodes(), "nodes", "nodes on this rank");
}

void Halo::check(std::size_t size, int width) const
{
  check::rows(size, num_nodes(), width, "values", "node");
}

void SerialBulk::displacement(std::span<double> values) const
{
  std::ranges::copy(*_displacement, values.begin());
}

std::shared_ptr<Halo> contactx::mesh::serial_halo(
    std::vector<double> reference, int gdim,
    std::shared_ptr<const std::vector<double>> displacement)
{
  const std::size_t n = reference.size() / gdim;
  if (not displacement)
    displacement
        = std::make_shared<const std::vector<double>>(reference.size(), 0.0);
  if (displacement->size() != reference.size())
    throw std::invalid_argument(
        "displacement must have " + std::to_string(reference.size())
        + " values, not " + std::to_string(displacement->size()));
  std::vector<std::int64_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return std::make_shared<Halo>(
      BulkNodes{gdim, static_cast<std::int32_t>(n), numbers,
                std::vector<std::int32_t>(n), numbers, std::move(reference)},
      std::make_unique<SerialBulk>(std::move(displacement)));
}
