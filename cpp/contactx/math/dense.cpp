// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "dense.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

using namespace contactx;
using namespace contactx::dense;

namespace
{
void check_square(bool fits)
{
  if (not fits)
    throw std::invalid_argument("the sizes of matrices do not fit");
}

/// Reduce a symmetric matrix to tridiagonal form.
/// @param[in,out] V The matrix; then the orthogonal transformation.
/// @param[out] d Diagonal.
/// @param[out] e Beside the diagonal, from the second on.
void tridiagonalise(Matrix& V, std::vector<double>& d, std::vector<double>& e)
{
  const std::size_t n = V.rows;
  for (std::size_t j = 0; j < n; ++j)
    d[j] = V(n - 1, j);
  for (std::size_t i = n - 1; i > 0; --i)
  {
    double scale = 0, h = 0;
    for (std::size_t k = 0; k < i; ++k)
      scale += std::abs(d[k]);
    if (scale == 0)
    {
      e[i] = d[i - 1];
      for (std::size_t j = 0; j < i; ++j)
      {
        d[j] = V(i - 1, j);
        V(i, j) = V(j, i) = 0;
      }
    }
    else
    {
      // Householder's vector
      for (std::size_t k = 0; k < i; ++k)
      {
        d[k] /= scale;
        h += d[k] * d[k];
      }
      const double f = d[i - 1];
      const double g = f > 0 ? -std::sqrt(h) : std::sqrt(h);
      e[i] = scale * g;
      h -= f * g;
      d[i - 1] = f - g;
      std::fill_n(e.begin(), i, 0.0);
      // Similarity to the columns that are left
      for (std::size_t j = 0; j < i; ++j)
      {
        const double dj = d[j];
        V(j, i) = dj;
        double sum = e[j] + V(j, j) * dj;
        for (std::size_t k = j + 1; k < i; ++k)
        {
          sum += V(k, j) * d[k];
          e[k] += V(k, j) * dj;
        }
        e[j] = sum;
      }
      double along = 0;
      for (std::size_t j = 0; j < i; ++j)
      {
        e[j] /= h;
        along += e[j] * d[j];
      }
      for (std::size_t j = 0; j < i; ++j)
        e[j] -= along / (h + h) * d[j];
      for (std::size_t j = 0; j < i; ++j)
      {
        for (std::size_t k = j; k < i; ++k)
          V(k, j) -= d[j] * e[k] + e[j] * d[k];
        d[j] = V(i - 1, j);
        V(i, j) = 0;
      }
    }
    d[i] = h;
  }
  // Gather the transformations
  for (std::size_t i = 0; i + 1 < n; ++i)
  {
    V(n - 1, i) = V(i, i);
    V(i, i) = 1;
    const double h = d[i + 1];
    if (h != 0)
    {
      for (std::size_t k = 0; k <= i; ++k)
        d[k] = V(k, i + 1) / h;
      for (std::size_t j = 0; j <= i; ++j)
      {
        double g = 0;
        for (std::size_t k = 0; k <= i; ++k)
          g += V(k, i + 1) * V(k, j);
        for (std::size_t k = 0; k <= i; ++k)
          V(k, j) -= g * d[k];
      }
    }
    for (std::size_t k = 0; k <= i; ++k)
      V(k, i + 1) = 0;
  }
  for (std::size_t j = 0; j < n; ++j)
  {
    d[j] = V(n - 1, j);
    V(n - 1, j) = 0;
  }
  V(n - 1, n - 1) = 1;
  e[0] = 0;
}

/// QL with implicit shifts on a tridiagonal matrix.
/// @param[in,out] V Orthogonal transformation to it; then the eigenvectors.
/// @param[in,out] d Diagonal; then the eigenvalues.
/// @param[in,out] e Beside the diagonal, from the second on.
void diagonalise(Matrix& V, std::vector<double>& d, std::vector<double>& e)
{
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const std::size_t n = V.rows;
  std::rotate(e.begin(), e.begin() + 1, e.end());
  double shift = 0, size = 0;
  for (std::size_t l = 0; l < n; ++l)
  {
    size = std::max(size, std::abs(d[l]) + std::abs(e[l]));
    std::size_t m = l;
    while (m + 1 < n and std::abs(e[m]) > eps * size)
      ++m;
    // What 50 sweeps have not made small is as small as it gets
    for (int sweep = 0; m > l and std::abs(e[l]) > eps * size and sweep < 50;
         ++sweep)
    {
      double g = d[l];
      double p = (d[l + 1] - g) / (2 * e[l]);
      double r = std::copysign(std::hypot(p, 1.0), p);
      d[l] = e[l] / (p + r);
      d[l + 1] = e[l] * (p + r);
      const double next = d[l + 1];
      const double h = g - d[l];
      for (std::size_t i = l + 2; i < n; ++i)
        d[i] -= h;
      shift += h;
      p = d[m];
      double c = 1, c2 = 1, c3 = 1, s = 0, s2 = 0;
      const double el1 = e[l + 1];
      for (std::size_t i = m; i-- > l;)
      {
        c3 = c2;
        c2 = c;
        s2 = s;
        g = c * e[i];
        const double t = c * p;
        r = std::hypot(p, e[i]);
        e[i + 1] = s * r;
        s = e[i] / r;
        c = p / r;
        p = c * d[i] - s * g;
        d[i + 1] = t + s * (c * g + s * d[i]);
        for (std::size_t k = 0; k < n; ++k)
        {
          const double v = V(k, i + 1);
          V(k, i + 1) = s * V(k, i) + c * v;
          V(k, i) = c * V(k, i) - s * v;
        }
      }
      p = -s * s2 * c3 * el1 * e[l] / next;
      e[l] = s * p;
      d[l] = c * p;
    }
    d[l] += shift;
    e[l] = 0;
  }
}
} // namespace

Matrix dense::product(const Matrix& A, const Matrix& B)
{
  check_square(A.cols == B.rows);
  Matrix C(A.rows, B.cols);
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t k = 0; k < A.cols; ++k)
      if (const double a = A(i, k); a != 0)
        for (std::size_t j = 0; j < B.cols; ++j)
          C(i, j) += a * B(k, j);
  return C;
}

Matrix dense::product_transposed(const Matrix& A, const Matrix& B)
{
  check_square(A.rows == B.rows);
  Matrix C(A.cols, B.cols);
  for (std::size_t k = 0; k < A.rows; ++k)
    for (std::size_t i = 0; i < A.cols; ++i)
      if (const double a = A(k, i); a != 0)
        for (std::size_t j = 0; j < B.cols; ++j)
          C(i, j) += a * B(k, j);
  return C;
}

std::vector<double> dense::product(const Matrix& A, std::span<const double> x)
{
  check_square(A.cols == x.size());
  std::vector<double> y(A.rows);
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t j = 0; j < A.cols; ++j)
      y[i] += A(i, j) * x[j];
  return y;
}

std::vector<double> dense::product_transposed(const Matrix& A,
                                              std::span<const double> x)
{
  check_square(A.rows == x.size());
  std::vector<double> y(A.cols);
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t j = 0; j < A.cols; ++j)
      y[j] += A(i, j) * x[i];
  return y;
}

Matrix dense::columns(const Matrix& A, std::span<const std::size_t> which)
{
  for (const std::size_t k : which)
    check_square(k < A.cols);
  Matrix B(A.rows, which.size());
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t k = 0; k < which.size(); ++k)
      B(i, k) = A(i, which[k]);
  return B;
}

double dense::norm(std::span<const double> x)
{
  return std::sqrt(std::transform_reduce(x.begin(), x.end(), x.begin(), 0.0));
}

Eigen dense::symmetric_eigen(const Matrix& A)
{
  check_square(A.rows == A.cols);
  const std::size_t n = A.rows;
  if (not std::ranges::all_of(A.values,
                              [](double a) { return std::isfinite(a); }))
    throw std::invalid_argument("a matrix has values that are not finite");
  if (n == 0)
    return {};
  Matrix V(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      V(i, j) = V(j, i) = A(i, j);
  std::vector<double> d(n), e(n);
  tridiagonalise(V, d, e);
  diagonalise(V, d, e);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&d](std::size_t i) { return d[i]; });
  Eigen result{std::vector<double>(n), columns(V, order)};
  for (std::size_t i = 0; i < n; ++i)
    result.values[i] = d[order[i]];
  return result;
}

std::vector<double> dense::solve(Matrix A, std::span<const double> b)
{
  const std::size_t n = A.rows;
  check_square(A.cols == n and b.size() == n);
  std::vector<double> x(b.begin(), b.end());
  for (std::size_t k = 0; k < n; ++k)
  {
    std::size_t p = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(A(i, k)) > std::abs(A(p, k)))
        p = i;
    if (A(p, k) == 0)
      throw std::domain_error("a matrix is singular");
    if (p != k)
    {
      std::swap_ranges(&A(k, 0), &A(k, 0) + n, &A(p, 0));
      std::swap(x[k], x[p]);
    }
    for (std::size_t i = k + 1; i < n; ++i)
    {
      const double part = A(i, k) / A(k, k);
      for (std::size_t j = k + 1; j < n; ++j)
        A(i, j) -= part * A(k, j);
      x[i] -= part * x[k];
    }
  }
  for (std::size_t k = n; k-- > 0;)
  {
    for (std::size_t j = k + 1; j < n; ++j)
      x[k] -= A(k, j) * x[j];
    x[k] /= A(k, k);
  }
  return x;
}
