// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/condense/condensation.h>
#include <contactx/condense/dependent_constraints.h>

#include "algebra.h"
#include "generator.h"

/// @brief Dense algebra, and contacts with random entries.
namespace contactx::tests
{
using Column = std::vector<double>;

inline Eigen::MatrixXd dense(const Triplets& entries, std::size_t rows,
                             std::size_t columns)
{
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, columns);
  for (std::size_t e = 0; e < entries.size(); ++e)
    A(entries.rows.at(e), entries.columns.at(e)) += entries.values[e];
  return A;
}

inline Column operator+(Column a, const Column& b)
{
  for (std::size_t i = 0; i < a.size(); ++i)
    a[i] += b.at(i);
  return a;
}

inline Column operator-(Column a, const Column& b)
{
  for (std::size_t i = 0; i < a.size(); ++i)
    a[i] -= b.at(i);
  return a;
}

inline double distance(const Column& a, const Column& b)
{
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, std::abs(a[i] - b.at(i)));
  return most;
}

inline double largest(const Column& a)
{
  return distance(a, Column(a.size(), 0));
}

/// @brief One contact of a test.
struct Contact
{
  std::vector<std::int32_t> slaves;
  std::vector<std::int32_t> masters; ///< of all slave nodes alike
  int size;
  std::vector<std::int8_t> status;
  std::vector<double> compliance = {}; ///< of slave nodes, or nothing
  std::vector<double> area = {}, normal = {}, by_multiplier = {};

  condense::Nodes nodes() const
  {
    return {slaves, size, status, area, normal, by_multiplier};
  }
};

/// @brief A saddle point problem with random entries: displacements of some
/// nodes, then the multipliers.
///
/// As contact has it, the slave side is diagonal and a node's law is
/// D l + C u = d with D zero where it sticks or carries a scalar, unless it is
/// soft, zero along the normal where it slips, and the area where it is open.
/// Along prescribed displacements the law gives the multiplier by D alone.
class Saddle
{
public:
  Saddle(int gdim, int num_nodes, std::vector<Contact> contacts,
         std::vector<std::int32_t> prescribed, unsigned seed)
      : gdim(gdim), n(static_cast<std::size_t>(gdim) * num_nodes),
        contacts(std::move(contacts)), free(n, 1),
        bulk(Eigen::MatrixXd::Identity(n, n)), random(seed)
  {
    for (const std::int32_t dof : prescribed)
      free.at(dof) = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (free[i] and free[j])
          bulk(i, j) = (i == j ? 8.0 : 0.0) + random(-1, 1);
    m = 0;
    for (const Contact& c : this->contacts)
      m += c.slaves.size() * c.size;
    contact.setZero(n + m, n + m);
    std::size_t first = n;
    for (std::size_t k = 0; k < this->contacts.size(); ++k)
    {
      Contact& c = this->contacts[k];
      for (std::size_t s = 0; s < c.slaves.size(); ++s, first += c.size)
      {
        add_node(c, s, first);
      }
    }
  }

  /// @brief Make the bulk and laws symmetric, constraints those of the forces,
  /// three times as large and of the other sign, and leave out what else
  /// contact adds to the stiffness.
  void make_symmetric()
  {
    bulk = ((bulk + bulk.transpose()) / 2).eval();
    contact.topLeftCorner(n, n).setZero();
    contact.bottomLeftCorner(m, n)
        = -3 * contact.topRightCorner(n, m).transpose();
    std::size_t first = n;
    for (Contact& c : contacts)
      for (std::size_t s = 0; s < c.slaves.size(); ++s, first += c.size)
      {
        auto D = contact.block(first, first, c.size, c.size);
        D = ((D + D.transpose()) / 2).eval();
        for (int i = 0; i < c.size; ++i)
          for (int j = 0; j < c.size; ++j)
            c.by_multiplier[(s * c.size + i) * c.size + j] = D(i, j);
      }
  }

  /// @brief Displacements and multipliers from the whole system.
  Column solve(const Column& b, const Column& d) const
  {
    Eigen::MatrixXd A = contact;
    A.topLeftCorner(n, n) += bulk;
    Column both = b;
    both.insert(both.end(), d.begin(), d.end());
    return solution(A, both);
  }

  /// @brief Eliminate the multipliers.
  /// @param[in] holds Whether multipliers may stay unknowns.
  condense::Condensation condensed(bool holds = false) const
  {
    std::vector<std::int32_t> offsets{0}, columns;
    std::vector<double> values;
    for (std::size_t i = 0; i < n + m; ++i)
    {
      for (std::size_t j = 0; j < n + m; ++j)
        if (contact(i, j) != 0)
        {
          columns.push_back(static_cast<std::int32_t>(j));
          values.push_back(contact(i, j));
        }
      offsets.push_back(static_cast<std::int32_t>(columns.size()));
    }
    std::vector<condense::Nodes> nodes;
    for (const Contact& c : contacts)
      nodes.push_back(c.nodes());
    return condense::Condensation({offsets, columns, values}, nodes, free, gdim,
                                  diagonal(), holds);
  }

  Column diagonal() const
  {
    const Eigen::VectorXd values = bulk.diagonal();
    return {values.begin(), values.end()};
  }

  /// @brief The same from the system without multipliers.
  Column solve_condensed(const condense::Condensation& condensation,
                         const Column& b, const Column& d) const
  {
    const auto& elimination = condensation.elimination();
    const Condensed made(*this, condensation);
    auto given = condensation.right_hand_side(d);
    given.shift = product(made.of_right, given.shift);
    Column forces = b + given.forces;
    for (std::size_t i = 0; i < given.retained.size(); ++i)
      forces[condensation.retained().dofs[i]] = given.retained[i];
    Column rhs = product(made.left, forces - product(made.K, given.shift))
                 - product(made.law, given.shift) + given.extra + given.preload;
    for (const std::int32_t dof : elimination.eliminated())
      rhs[dof] = 0;
    Column u = product(made.right, solution(made.A, rhs)) + given.shift;
    Column multipliers = given.multipliers;
    condensation.recover(
        d, product(made.of_left, b + given.forces - product(made.K, u)), u,
        multipliers);
    for (const std::int32_t dof : condensation.retained().dofs)
      u[dof] = b[dof];
    u.insert(u.end(), multipliers.begin(), multipliers.end());
    return u;
  }

  /// @brief The condensed matrix A, one for eliminated displacements, and what
  /// it is made of.
  struct Condensed
  {
    Condensed(const Saddle& saddle, const condense::Condensation& condensation)
    {
      const std::size_t n = saddle.n;
      const auto& elimination = condensation.elimination();
      const auto I = Eigen::MatrixXd::Identity(n, n);
      const mesh::SerialNodes nodes(static_cast<std::int32_t>(n / saddle.gdim));
      const auto chains = condense::dependent_constraints(elimination, nodes);
      of_right = (I - dense(chains.right, n, n)).inverse();
      of_left = (I - dense(chains.left, n, n)).inverse();
      left = I
             + (dense(elimination.left(), n, n)
                + dense(elimination.rows(), n, n))
                   * of_left;
      right = I + of_right * dense(elimination.right(), n, n);
      law = dense(elimination.law(), n, n);
      K = saddle.bulk + dense(condensation.stiffness(), n, n);
      A = left * (K * right) + law * right + dense(elimination.springs(), n, n);
      for (const std::int32_t dof : elimination.eliminated())
      {
        A.row(dof) = I.row(dof);
        A.col(dof) = I.col(dof);
      }
    }

    Eigen::MatrixXd of_right, of_left, left, right, law, K, A;
  };

  Column column(std::size_t size)
  {
    Column x(size);
    for (double& value : x)
      value = random(-1, 1);
    return x;
  }

  int gdim;
  std::size_t n, m;
  std::vector<Contact> contacts;
  std::vector<std::int8_t> free;
  Eigen::MatrixXd bulk, contact; ///< of displacements, and of all unknowns
  Generator random;

private:
  void add_node(Contact& c, std::size_t s, std::size_t first)
  {
    const int g = gdim, k = c.size;
    const double area = random(0.5, 2);
    c.area.push_back(area);
    Column normal(g);
    double length = 0;
    for (double& x : normal)
    {
      x = random(0.2, 1) * (random(-1, 1) > 0 ? 1 : -1);
      length += x * x;
    }
    for (double& x : normal)
      x /= std::sqrt(length);
    if (k > 1)
      c.normal.insert(c.normal.end(), normal.begin(), normal.end());

    std::vector<std::int32_t> dofs;
    for (int i = 0; i < g; ++i)
    {
      dofs.push_back(c.slaves[s] * g + i);
      for (const std::int32_t node : c.masters)
        dofs.push_back(node * g + i);
    }
    const bool is_closed = c.status[s] != 0;
    for (const std::int32_t dof : dofs)
    {
      const bool is_own = dof / g == c.slaves[s];
      for (int i = 0; i < k and free[dof]; ++i)
      {
        // The slave side of a vector is diagonal
        if (not is_own)
          contact(dof, first + i) = random(-1, 1);
        else if (k == 1)
          contact(dof, first) = -area * normal[dof % g];
        else if (dof % g == i)
          contact(dof, first + i) = -area;
        if (is_closed)
          contact(first + i, dof)
              = random(-1, 1)
                + (is_own and dof % g == (k == 1 ? int(s) % g : i) ? 4 : 0);
      }
      for (const std::int32_t other : dofs)
        if (free[dof] and free[other] and is_closed)
          contact(dof, other) += 0.1 * random(-1, 1);
    }

    const Eigen::MatrixXd D = law(c, s, normal, area);
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < k; ++j)
      {
        c.by_multiplier.push_back(D(i, j));
        contact(first + i, first + j) = D(i, j);
      }
  }

  Eigen::MatrixXd law(const Contact& c, std::size_t s, const Column& normal,
                      double area)
  {
    const int k = c.size;
    const double compliance = c.compliance.empty() ? 0 : c.compliance[s];
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(k, k);
    if (c.status[s] == 0)
    {
      for (int i = 0; i < k; ++i)
        D(i, i) = area;
      return D;
    }
    if (k == 1)
    {
      D(0, 0) = area * compliance;
      return D;
    }
    const bool is_soft = c.status[s] == 1 and compliance > 0;
    std::vector<int> f, p;
    for (int i = 0; i < k; ++i)
      (free[c.slaves[s] * gdim + i] ? f : p).push_back(i);
    if (c.status[s] == 2)
    {
      // B without what is along the normal in f
      double square = 0;
      for (const int i : f)
        square += normal[i] * normal[i];
      for (const int j : f)
      {
        Column B = column(k);
        double along = 0;
        for (const int i : f)
          along += normal[i] * B[i];
        for (const int i : f)
          D(i, j) = area * (B[i] - along * normal[i] / square);
      }
    }
    if (is_soft)
      for (const int i : f)
        for (const int j : f)
          D(i, j)
              = area * compliance * ((i == j ? 2 : 0) + 0.5 * random(-1, 1));
    if (p.empty())
      return D;
    Eigen::MatrixXd pp(p.size(), p.size());
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t j = 0; j < p.size(); ++j)
        D(p[i], p[j]) = pp(i, j)
            = area * ((i == j ? 2 : 0) + 0.5 * random(-1, 1));
    for (const int i : f)
      for (const int j : p)
      {
        D(i, j) = area * random(-1, 1);
        D(j, i) = area * random(-1, 1);
      }
    for (const int j : f)
    {
      Column pf;
      for (const int i : p)
        pf.push_back(D(i, j));
      const Column x = solution(pp, pf);
      for (const int i : f)
        for (std::size_t l = 0; l < p.size(); ++l)
          D(i, j) += D(i, p[l]) * x[l];
    }
    return D;
  }
};
} // namespace contactx::tests
