// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "quadrature.h"
#include "trace.h"

namespace contactx::geometry
{
/// @brief A slave facet projected on its plane.
template <class S>
struct SlaveFacet
{
  /// @brief Project the facet.
  /// @param[in] x Its nodes.
  /// @param[in] reference Its nodes in the reference configuration.
  /// @param[in] weight Weight of the integrals, at its nodes.
  SlaveFacet(const Nodes<S>& x, const Nodes<S>& reference,
             const Vector<S::nodes>& weight = ones())
      : SlaveFacet(ProjectionPlane<S>(x), x, reference, weight)
  {
  }

  /// @brief Project the facet on a plane of its own.
  /// @param[in] plane The plane.
  /// @param[in] x Its nodes.
  /// @param[in] reference Its nodes in the reference configuration.
  /// @param[in] weight Weight of the integrals, at its nodes.
  SlaveFacet(const ProjectionPlane<S>& plane, const Nodes<S>& x,
             const Nodes<S>& reference, const Vector<S::nodes>& weight = ones())
      : reference(reference), plane(plane), map(project<S>(plane, x)),
        shape(outline<S>(project<S>(plane, x))), weight(weight),
        is_weighted(weight != ones())
  {
    if constexpr (S::flat)
      area = geometry::frame<S>(reference, {}).jacobian;
    else
    {
      // How much the reference area varies over the facet
      const ProjectionPlane<S> before(reference);
      const InverseMap<S> flat(project<S>(before, reference));
      Vector<S::gdim> w{};
      for (int t = 0; t < S::nodes; ++t)
        w = w + S::mixed_derivative[t] * reference[t];
      const double height = dot(w, before.n);
      const double size = std::min(norm(before.t[0]), norm(before.t[1]));
      bend = std::max(
          {map.distortion(), flat.distortion(), std::abs(height) / size});
    }
  }

  /// @brief Reference area a unit of the plane's, at a point, with the weight.
  double reference_area(const Shape<S>& s) const
  {
    const double factor = is_weighted ? dot(weight, s.N) : 1;
    if constexpr (S::flat)
      return factor * area;
    else
      return factor
             * (geometry::frame<S>(reference, s.xi).jacobian / s.jacobian);
  }

  /// @brief No weight.
  static constexpr Vector<S::nodes> ones()
  {
    Vector<S::nodes> w;
    w.fill(1);
    return w;
  }

  Nodes<S> reference;
  ProjectionPlane<S> plane;
  InverseMap<S> map;
  Overlap<S::tdim> shape; ///< its outline
  Vector<S::nodes> weight;
  bool is_weighted;
  double area = 0;
  double bend = 0;
};

/// @brief Degree of the shape functions of a facet.
template <class F>
constexpr int shape_degree()
{
  if constexpr (geometry::is_linear<F>)
    return F::flat ? 1 : 2;
  else
    return F::degree;
}

/// @brief Degree of the rule: of the products of shape functions and the
/// weight, and where facets are distorted what makes their inverse maps exact
/// to round-off.
template <class S, class M>
int rule_degree(double distortion, bool is_weighted = false)
{
  const int degree = shape_degree<S>()
                     + std::max(shape_degree<S>(), shape_degree<M>())
                     + (is_weighted ? shape_degree<Part<S>>() : 0);
  if (not(distortion >= 1e-13))
    return degree;
  // The error falls by half the distortion with every degree
  constexpr double log_accuracy = 25; // -log of the relative error, 1e-11
  return degree
         + static_cast<int>(log_accuracy
                            / std::log(2 / std::min(distortion, 1.0)));
}

/// @brief Integrate over what a part of a slave facet S and a part of a master
/// facet M share, with the slave facet's reference area. A master facet that is
/// folded or has no area shares nothing.
/// @param[in] slave Part of the slave facet.
/// @param[in] master Nodes of the part of the master facet.
/// @param[in] f Called as f(slave's shape, master's shape, weight), the shapes
/// being those of the parts.
/// @param[in] more By how much the degree of f is above that of a shape
/// function of each facet.
template <class SlaveWhole, class MasterWhole, class Function>
void integrate(const SlaveFacet<Part<SlaveWhole>>& slave,
               const Nodes<Part<MasterWhole>>& master, Function&& f,
               int more = 0)
{
  using S = Part<SlaveWhole>;
  using M = Part<MasterWhole>;
  const Flat<M> r = project<M>(slave.plane, master);
  if (!is_convex<M>(r))
    return;
  const Overlap<S::tdim> overlap = clip(outline<M>(r), slave.shape);
  if (overlap.size == 0)
    return;
  const InverseMap<M> map(r);
  if (!map.exists())
    return;
  const int degree
      = more
        + rule_degree<SlaveWhole, MasterWhole>(
            std::max(slave.bend, map.distortion()), slave.is_weighted);
  integrate(overlap, degree,
            [&](const Local<S>& p, double weight)
            {
              const Shape<S> s = slave.map.at(p);
              const Shape<M> m = map.at(p);
              // On degenerate quadrilaterals round-off may lead outside
              if (s.jacobian > 0 and M::excess(m.xi) <= facet_margin)
                f(s, m, weight * slave.reference_area(s));
            });
}

/// @brief Call `f` with each kind of linear slave and master facet that can
/// meet.
template <class Function>
void for_all_kinds(Function&& f)
{
  using namespace geometry;
  f(Segment{}, Segment{});
  f(Triangle{}, Triangle{});
  f(Triangle{}, Quadrilateral{});
  f(Quadrilateral{}, Triangle{});
  f(Quadrilateral{}, Quadrilateral{});
}

/// @brief Call a function with facets that are both linear, or both quadratic.
template <class Function>
void for_all_wholes(Function&& f)
{
  using namespace geometry;
  for_all_kinds(f);
  f(QuadraticSegment{}, QuadraticSegment{});
  f(QuadraticTriangle{}, QuadraticTriangle{});
  f(QuadraticTriangle{}, BiquadraticQuadrilateral{});
  f(BiquadraticQuadrilateral{}, QuadraticTriangle{});
  f(BiquadraticQuadrilateral{}, BiquadraticQuadrilateral{});
}

/// @brief Call `f` with the linear facet types of so many nodes, of one
/// dimension.
template <class Function>
decltype(auto) visit(int slave_nodes, int master_nodes, Function&& f)
{
  return geometry::visit(slave_nodes,
                         [&](auto s)
                         {
                           using S = decltype(s);
                           if constexpr (S::tdim == 1)
                             return f(s, Segment{});
                           else
                             return master_nodes == 3 ? f(s, Triangle{})
                                                      : f(s, Quadrilateral{});
                         });
}
} // namespace contactx::geometry
