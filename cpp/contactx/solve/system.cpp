// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "system.h"
#include "../math/scales.h"
#include "held_motions.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::solve;

namespace
{
double largest_size(std::span<const double> values)
{
  double most = 0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  return most;
}
} // namespace

System::System(std::shared_ptr<mesh::Halo> halo, std::shared_ptr<Bulk> bulk,
               Contacts contacts)
    : _halo(std::move(halo)), _bulk(std::move(bulk)),
      _contacts(std::move(contacts)),
      _num_displacements(std::size_t(_halo->num_owned()) * _halo->gdim())
{
  const Fields* fields = _bulk->fields();
  _offsets = {0, _num_displacements + (fields ? fields->offsets().back() : 0)};
  for (const auto& c : _contacts)
    _offsets.push_back(_offsets.back() + c->nodes()->multiplier.size());
  _factors.assign(size() - num_bulk(), 1);
}

std::span<const double> System::fields_values() const
{
  Fields* fields = _bulk->fields();
  return fields ? fields->values() : std::span<const double>();
}

void System::take_factors()
{
  std::size_t at = 0;
  for (const auto& c : _contacts)
  {
    const law::NodeState& nodes = *c->nodes();
    for (const double factor : nodes.c)
    {
      int exponent = 0;
      std::frexp(factor, &exponent);
      for (int k = 0; k < nodes.size(); ++k)
        _factors[at++] = std::ldexp(1.0, exponent);
    }
  }
}

void System::check(std::size_t size, const char* name) const
{
  if (size != this->size())
    throw std::invalid_argument(std::string(name)
                                + " must have a value for each unknown of this "
                                  "rank");
}

void System::unknowns(std::span<double> x) const
{
  check(x.size(), "x");
  std::ranges::copy(_bulk->displacements(), x.begin());
  std::ranges::copy(fields_values(), x.begin() + num_displacements());
  std::size_t at = num_bulk();
  for (const auto& c : _contacts)
    for (const double multiplier : c->nodes()->multiplier)
    {
      x[at] = multiplier / _factors[at - num_bulk()];
      ++at;
    }
}

void System::take(std::span<const double> x)
{
  _halo->ranks().agree([&] { check(x.size(), "x"); });
  _bulk->set_displacements(x.first(num_displacements()));
  if (Fields* fields = _bulk->fields())
    fields->set(
        x.subspan(num_displacements(), num_bulk() - num_displacements()));
  std::size_t at = num_bulk();
  for (const auto& c : _contacts)
    for (double& multiplier : c->nodes()->multiplier)
    {
      multiplier = x[at] * _factors[at - num_bulk()];
      ++at;
    }
}

std::vector<double> System::movement(std::span<const double> dx) const
{
  std::vector<double> u(std::size_t(_halo->num_nodes()) * _halo->gdim());
  for (std::size_t i = 0; i < _num_displacements; ++i)
    u[i] = -dx[i];
  _halo->forward(std::span(u), _halo->gdim());
  return u;
}

std::span<const double> System::bulk_residual()
{
  const std::span<const double> u = _bulk->displacements();
  const std::span<const double> values = fields_values();
  const std::span<const double> at(_at);
  std::vector<double> others(values.begin(), values.end());
  if (Fields* fields = _bulk->fields(); fields and fields->follow_contacts())
    for (const auto& c : _contacts)
    {
      others.push_back(static_cast<double>(c->version()));
      const std::vector<double>& multiplier = c->nodes()->multiplier;
      others.insert(others.end(), multiplier.begin(), multiplier.end());
    }
  const bool same = not at.empty() and std::ranges::equal(u, at.first(u.size()))
                    and std::ranges::equal(others, at.subspan(u.size()));
  if (not mesh::everywhere(_halo->ranks(), same or num_bulk() == 0))
  {
    _at.assign(u.begin(), u.end());
    _at.insert(_at.end(), others.begin(), others.end());
    const std::span<const double> b = _bulk->residual();
    _bulk_residual.assign(b.begin(), b.end());
    if (Fields* fields = _bulk->fields())
    {
      const std::span<const double> others = fields->residual();
      _fields_residual.assign(others.begin(), others.end());
    }
  }
  return _bulk_residual;
}

std::span<const double> System::fields_residual()
{
  bulk_residual();
  return _fields_residual;
}

void System::evaluate()
{
  for (const auto& c : _contacts)
  {
    c->update_gap();
    const auto law = [&] { c->law()->evaluate(*c->nodes()); };
    if (c->law()->may_throw())
      _halo->ranks().agree(law);
    else
      law();
  }
}

/// Adds what all ranks have for the nodes that this one owns.
void System::add_sums(std::vector<double>& pushed,
                      std::span<double> force) const
{
  _halo->reverse(pushed, _halo->gdim());
  for (std::size_t i = 0; i < force.size(); ++i)
    force[i] += pushed[i];
}

std::vector<double> System::product(const condense::ContactBlock& contact,
                                    std::span<const double> x) const
{
  const std::size_t all = std::size_t(_halo->num_nodes()) * _halo->gdim();
  const std::size_t n = num_bulk();
  std::vector<double> v(all + size() - n);
  std::copy_n(x.begin(), num_displacements(), v.begin());
  _halo->forward(std::span(v).first(all), _halo->gdim());
  for (std::size_t i = n; i < x.size(); ++i)
    v[all + i - n] = x[i] * _factors[i - n];
  return contact.multiply(v);
}

void System::multiply(const condense::ContactBlock& contact,
                      std::span<const double> x, std::span<double> y) const
{
  check(x.size(), "x");
  check(y.size(), "y");
  std::vector<double> w = product(contact, x);
  const std::size_t all = std::size_t(_halo->num_nodes()) * _halo->gdim();
  std::copy(w.begin() + all, w.end(), y.begin() + num_bulk());
  w.resize(all);
  const std::span<double> force = y.first(num_displacements());
  std::ranges::fill(y.first(num_bulk()), 0);
  add_sums(w, force);
}

std::vector<std::int8_t> System::markers() const
{
  std::vector<std::int64_t> all(std::size_t(_halo->num_nodes())
                                * _halo->gdim());
  std::ranges::copy(_bulk->markers(), all.begin());
  _halo->forward(std::span<std::int64_t>(all), _halo->gdim());
  return {all.begin(), all.end()};
}

std::vector<double> System::forces()
{
  std::vector<double> pushed(std::size_t(_halo->num_nodes()) * _halo->gdim());
  for (const auto& c : _contacts)
    c->add_residual(pushed);
  const std::span<const double> bulk = bulk_residual();
  std::vector<double> sum(bulk.begin(), bulk.end());
  add_sums(pushed, sum);
  return sum;
}

void System::residual(std::span<double> b)
{
  _halo->ranks().agree([&] { check(b.size(), "b"); });
  const std::span<double> force = b.first(num_displacements());
  std::ranges::copy(bulk_residual(), force.begin());
  const std::span<double> others
      = b.subspan(num_displacements(), num_bulk() - num_displacements());
  std::ranges::copy(fields_residual(), others.begin());
  Fields* fields = _bulk->fields();
  const std::size_t all = std::size_t(_halo->num_nodes()) * _halo->gdim();
  std::vector<double> pushed(all);
  evaluate();
  for (std::size_t k = 0; k < _contacts.size(); ++k)
  {
    const contact::Contact& c = *_contacts[k];
    c.add_residual(pushed);
    std::ranges::copy(c.nodes()->value, b.begin() + _offsets[k + 1]);
  }
  const std::span<const double> defect = _bulk->defect();
  const std::span<const double> other_defect
      = fields ? fields->defect() : std::span<const double>();
  std::array most{largest_size(defect), largest_size(_bulk->displacements()),
                  largest_size(other_defect), largest_size(fields_values())};
  _halo->ranks().reduce(std::span<double>(most), mesh::Reduction::largest);
  if (most[0] > math::sum_round_off * most[1]
      or most[2] > math::sum_round_off * most[3])
  {
    // Dirichlet values that the displacements do not have yet, in other rows
    const std::span<const double> lifted = _bulk->lifted();
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] += lifted[i];
    if (fields)
    {
      const std::span<const double> more = fields->lifted();
      for (std::size_t i = 0; i < others.size(); ++i)
        others[i] += more[i];
    }
    std::vector<double> x(size());
    std::ranges::copy(defect, x.begin());
    const std::vector<double> w
        = product(condense::ContactBlock(_contacts, {}), x);
    for (std::size_t i = 0; i < all; ++i)
      pushed[i] -= w[i];
    for (std::size_t i = all; i < w.size(); ++i)
      b[num_bulk() + i - all] -= w[i];
  }
  add_sums(pushed, force);
  const std::span<const std::int8_t> markers = _bulk->markers();
  for (std::size_t i = 0; i < force.size(); ++i)
    if (markers[i] == 1)
      force[i] = defect[i];
  if (fields)
  {
    const std::span<const std::int8_t> prescribed = fields->markers();
    for (std::size_t i = 0; i < others.size(); ++i)
      if (prescribed[i] == 1)
        others[i] = other_defect[i];
  }
  if (_held)
    _held->take_off(b);
}
