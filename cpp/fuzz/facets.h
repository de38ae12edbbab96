// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <contactx/geometry/frame.h>
#include <contactx/geometry/nodal.h>

namespace contactx::fuzz
{
/// @brief A facet: of any nodes, or a reference facet with its nodes moved.
template <class F>
geometry::Nodes<F> nodes(Input& in)
{
  geometry::Nodes<F> x{};
  const bool reference = in.flag();
  for (int l = 0; l < F::nodes; ++l)
    if (reference)
    {
      std::copy(F::vertices[l].begin(), F::vertices[l].end(), x[l].begin());
      x[l] = in.scale() * x[l];
      if (in.flag())
        x[l] = x[l] + 0.25 * in.vector<F::gdim>();
    }
    else
      x[l] = l > 0 and in.below(8) == 0 ? x[l - 1] : in.vector<F::gdim>();
  return x;
}

/// @brief Area of a flat facet and of a bilinear one at a point, in units of
/// its diameter: what is small is degenerate.
template <class F>
double roundness(const geometry::Nodes<F>& x, const geometry::Local<F>& xi)
{
  const double size = geometry::diameter<F>(x);
  if (!(size > 0))
    return 0;
  return geometry::frame<F>(x, xi).jacobian
         / (F::gdim == 2 ? size : size * size);
}

/// @brief Lists of facets as the bindings take them.
struct List
{
  std::vector<std::int32_t> offsets{0}, nodes;

  void add(std::initializer_list<std::int32_t> facet)
  {
    nodes.insert(nodes.end(), facet);
    offsets.push_back(static_cast<std::int32_t>(nodes.size()));
  }

  /// @brief Keep no more than the first facets.
  void cut(std::int32_t most)
  {
    if (size() <= most)
      return;
    offsets.resize(most + 1);
    nodes.resize(offsets.back());
  }

  std::int32_t size() const
  {
    return static_cast<std::int32_t>(offsets.size()) - 1;
  }

  geometry::FacetList facets() const { return {offsets, nodes}; }
};

/// @brief A surface of any facets: nodes may be missing or twice in a facet.
/// @param[in] count Number of nodes to choose from.
inline List any_facets(Input& in, int gdim, int count)
{
  List list;
  for (int left = in.below(9); left > 0; --left)
  {
    const auto n = [&] { return in.below(count); };
    if (gdim == 2)
      list.add({n(), n()});
    else if (in.flag())
      list.add({n(), n(), n()});
    else
      list.add({n(), n(), n(), n()});
  }
  return list;
}

/// @brief A sheet of facets of all kinds, two a side in 3D or four in 2D.
/// @param[in] first Number of its first node; it has `sheet_nodes`.
/// @param[in] up Whether the normals point along the last axis.
inline List sheet(Input& in, int gdim, int first, bool up)
{
  List list;
  if (gdim == 2)
  {
    for (int i = first; i < first + 4; ++i)
      up ? list.add({i + 1, i}) : list.add({i, i + 1});
    return list;
  }
  for (int i : {0, 1, 3, 4})
  {
    std::int32_t a = first + i, b = a + 1, c = a + 3, d = a + 4;
    if (!up)
      std::swap(b, c);
    if (in.flag())
      list.add({a, b, c, d});
    else
    {
      list.add({a, b, c});
      list.add({b, d, c});
    }
  }
  return list;
}

/// @brief Number of nodes of a sheet.
inline int sheet_nodes(int gdim) { return gdim == 2 ? 5 : 9; }

/// @brief Two surfaces and the positions of their nodes.
struct Scene
{
  explicit Scene(Input& in) : gdim(in.flag() ? 3 : 2)
  {
    const int n = sheet_nodes(gdim);
    if (in.below(3) > 0)
    {
      slave = sheet(in, gdim, 0, false);
      master = sheet(in, gdim, n, true);
      place(in, 0, 0.25 * in.unscaled());
      place(in, n, 0);
    }
    else
    {
      const int count = 1 + in.below(12);
      slave = any_facets(in, gdim, count);
      master = any_facets(in, gdim, count);
      for (int i = 0; i < gdim * count; ++i)
        x.push_back(in.number());
    }
  }

  int num_nodes() const { return static_cast<int>(x.size()) / gdim; }

  /// @brief Move some nodes.
  void move(Input& in)
  {
    for (int k = in.below(6); k > 0; --k)
      x[in.below(static_cast<int>(x.size()))] += 0.25 * in.number();
  }

  Vector<3> point(Input& in) const
  {
    Vector<3> p{};
    for (int k = 0; k < gdim; ++k)
      p[k] = in.number();
    return p;
  }

  int gdim;
  std::vector<double> x;
  List slave, master;

private:
  void place(Input& in, int first, double height)
  {
    const int n = sheet_nodes(gdim);
    x.resize(gdim * (first + n));
    for (int i = 0; i < n; ++i)
    {
      double* p = &x[gdim * (first + i)];
      p[0] = in.scale() * (gdim == 2 ? i : i % 3);
      if (gdim == 3)
        p[1] = in.scale() * (i / 3);
      p[gdim - 1] = in.scale() * height;
      if (in.below(3) == 0)
        for (int k = 0; k < gdim; ++k)
          p[k] += 0.25 * in.number();
    }
  }
};
} // namespace contactx::fuzz
