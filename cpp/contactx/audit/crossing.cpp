// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "crossing.h"
#include "../geometry/frame.h"
#include "../geometry/gather.h"
#include "../search/box_tree.h"
#include <bit>
#include <limits>

using namespace contactx;
using namespace contactx::audit;
using search::Box;

namespace
{
/// How far points are taken aside, in tolerances: by no round number, so that
/// those of regular meshes do not go right through edges and nodes, where
/// round-off would say which facets they meet
constexpr Vector<3> aside{5.671e-3, -3.218e-3, 7.583e-3};

/// What moves on a straight line.
template <int D>
struct Path
{
  Vector<D> from, to;

  Vector<D> at(double t) const { return (1 - t) * from + t * to; }
};

/// Path as seen from what moves on another one.
template <int D>
Path<D> seen(const Path<D>& path, const Path<D>& from)
{
  return {path.from - from.from, path.to - from.to};
}

/// A segment or a triangle as seen from the point: its first node from the
/// point, and the others from that node.
template <int D>
using Simplex = std::array<Path<D>, D>;

/// Area or volume that point and simplex span, negative in front.
double spanned(const std::array<Vector<2>, 2>& r)
{
  return r[0][0] * r[1][1] - r[0][1] * r[1][0];
}

double spanned(const std::array<Vector<3>, 3>& r)
{
  return dot(r[0], cross(r[1], r[2]));
}

/// A cubic by its Bernstein coefficients in [0, 1].
using Cubic = std::array<double, 4>;

/// What point and simplex span over time.
template <int D>
Cubic spanned_over_time(const Simplex<D>& s)
{
  std::array<double, D + 1> b{};
  for (unsigned ends = 0; ends < 1 << D; ++ends)
  {
    std::array<Vector<D>, D> r;
    for (int k = 0; k < D; ++k)
      r[k] = ends >> k & 1 ? s[k].to : s[k].from;
    b[std::popcount(ends)] += spanned(r);
  }
  if constexpr (D == 2)
    return {b[0], (b[0] + b[1]) / 3, (b[1] + b[2]) / 3, b[2]};
  else
    return {b[0], b[1] / 3, b[2] / 3, b[3]};
}

double value(const Cubic& c, double t)
{
  const double s = 1 - t;
  return s * s * (s * c[0] + 3 * t * c[1]) + t * t * (3 * s * c[2] + t * c[3]);
}

/// Where a cubic may turn, in ascending order between 0 and 1, and both ends.
std::array<double, 4> pieces(const Cubic& c)
{
  const double d0 = c[1] - c[0], d1 = c[2] - c[1], d2 = c[3] - c[2];
  const double a = d0 - 2 * d1 + d2, b = d1 - d0, root = b * b - a * d0;
  std::array<double, 4> t{0, 1, 1, 1};
  if (root > 0)
  {
    const double q = -(b + std::copysign(std::sqrt(root), b));
    for (int k = 1; k < 3; ++k)
      if (const double turn = k == 1 ? q / a : d0 / q; turn > 0 and turn < 1)
        t[k] = turn;
    if (t[1] > t[2])
      std::swap(t[1], t[2]);
  }
  return t;
}

/// Call visit(t, entering) where a cubic changes its sign.
template <class Visitor>
void for_each_change(Cubic c, Visitor&& visit)
{
  // It stays between its coefficients
  if (!(std::ranges::max(c) > 0) or !(std::ranges::min(c) <= 0))
    return;
  const double size = std::max(std::ranges::max(c), -std::ranges::min(c));
  for (double& v : c)
    v /= size;
  const auto t = pieces(c);
  for (int k = 0; k < 3; ++k)
  {
    double low = t[k], high = t[k + 1];
    const bool behind = value(c, low) > 0;
    if (!(low < high) or (value(c, high) > 0) == behind)
      continue;
    for (int i = 0; i < 60; ++i)
    {
      const double middle = 0.5 * (low + high);
      ((value(c, middle) > 0) == behind ? low : high) = middle;
    }
    visit(high, !behind);
  }
}

/// Whether a point that is in the line of a segment, or in the plane of a
/// triangle, is inside.
bool holds(const std::array<Vector<2>, 2>& r)
{
  const double s = -dot(r[0], r[1]), length2 = dot(r[1], r[1]);
  return length2 > 0 and s >= 0 and s <= length2;
}

bool holds(const std::array<Vector<3>, 3>& r)
{
  const Vector<3> p = -1. * r[0], n = cross(r[1], r[2]);
  const double n2 = dot(n, n), s = dot(cross(p, r[2]), n),
               t = dot(cross(r[1], p), n);
  return n2 > 0 and s >= 0 and t >= 0 and s + t <= n2;
}

/// Call visit(simplex) for the simplices of a facet, whose nodes are seen from
/// the point.
template <class F, class Visitor>
void for_each_simplex(const std::array<Path<F::gdim>, F::nodes>& x,
                      Visitor&& visit)
{
  if constexpr (F::nodes == 2)
    visit(Simplex<2>{x[0], seen(x[1], x[0])});
  else if constexpr (F::nodes == 3)
    visit(Simplex<3>{x[0], seen(x[1], x[0]), seen(x[2], x[0])});
  else
  {
    Path<3> middle{};
    for (const auto& node : x)
      middle = {middle.from + 0.25 * node.from, middle.to + 0.25 * node.to};
    for (const auto& [i, j] : F::edges)
      visit(Simplex<3>{x[i], seen(x[j], x[i]), seen(middle, x[i])});
  }
}

/// A facet's normal in its middle, and how high a point is over the lowest and
/// the highest of its nodes along it.
template <int D>
struct Height
{
  Vector<D> normal;
  double least, most;
};

template <class F>
Height<F::gdim> height(const geometry::Nodes<F>& x, const Vector<F::gdim>& p)
{
  geometry::Local<F> middle{};
  for (const auto& v : F::vertices)
    middle = middle + (1. / F::nodes) * v;
  Height<F::gdim> h{geometry::frame<F>(x, middle).n,
                    std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
  for (const auto& node : x)
  {
    const double over = dot(h.normal, p - node);
    h.least = std::min(h.least, over);
    h.most = std::max(h.most, over);
  }
  return h;
}

template <int D>
Vector<D> row(std::span<const double> values, std::size_t i)
{
  return geometry::point<D>(static_cast<std::int32_t>(i), values);
}

template <std::size_t D>
void add(Box& box, const std::array<double, D>& p)
{
  Vector<3> padded{};
  std::copy(p.begin(), p.end(), padded.begin());
  box.add(padded);
}

/// Whether a path goes through a box: a long one aslant goes through few of
/// those that its own box meets. Of a box that holds another one it says no
/// less than of that, round-off included.
template <int D>
bool meets(const Box& box, const Path<D>& path)
{
  double first = 0, last = 1;
  for (int k = 0; k < D; ++k)
  {
    const double delta = path.to[k] - path.from[k];
    if (delta == 0)
    {
      if (!(box.lower[k] <= path.from[k] and path.from[k] <= box.upper[k]))
        return false;
      continue;
    }
    double in = (box.lower[k] - path.from[k]) / delta;
    double out = (box.upper[k] - path.from[k]) / delta;
    if (in > out)
      std::swap(in, out);
    first = std::max(first, in);
    last = std::min(last, out);
  }
  // So that round-off loses none
  return first <= last + 1e-9;
}

/// A point on its path.
template <int D>
struct Moved
{
  std::int32_t point;
  Path<D> path;
};

template <int D>
class Finder
{
public:
  Finder(const geometry::FacetList& facets, std::span<const double> x0,
         std::span<const double> x1, const geometry::RigidMotion& motion,
         const MovedPoints& points)
      : _facets(facets), _x0(x0), _x1(x1), _motion(motion), _points(points)
  {
  }

  std::vector<Crossing> find()
  {
    if (_points.tolerance.empty())
      return {};
    Box whole = Box::empty();
    std::vector<Box> boxes(_facets.size(), Box::empty());
    for (std::int32_t f = 0; f < _facets.size(); ++f)
    {
      for (const std::int32_t node : _facets[f])
      {
        const Path<D> path = node_path(node);
        add(boxes[f], path.from);
        add(boxes[f], path.to);
      }
      whole.add(boxes[f]);
    }
    std::vector<Moved<D>> moved;
    for (std::size_t i = 0; i < _points.tolerance.size(); ++i)
      if (const auto p = moved_point(i); meets<D>(whole, p.path))
        moved.push_back(p);
    if (moved.empty())
      return {};
    const search::BoxTree tree(boxes);
    for (const Moved<D>& p : moved)
      tree.for_each([&p](const Box& box) { return meets<D>(box, p.path); },
                    [this, &p](std::int32_t f) { cross(p, f); });
    return std::move(_found);
  }

private:
  Path<D> node_path(std::int32_t node) const
  {
    return {geometry::point<D>(node, _x0),
            _motion.moved_back<D>(geometry::point<D>(node, _x1))};
  }

  Moved<D> moved_point(std::size_t i) const
  {
    const double tolerance = _points.tolerance[i];
    Vector<D> shift;
    std::copy_n(aside.begin(), D, shift.begin());
    const auto back
        = [&shift, tolerance](const Vector<D>& p, const Vector<D>& normal)
    { return p + tolerance * (shift - normal); };
    return {static_cast<std::int32_t>(i),
            {back(row<D>(_points.x0, i), row<D>(_points.normal0, i)),
             back(_motion.moved_back<D>(row<D>(_points.x1, i)),
                  _motion.turned_back<D>(row<D>(_points.normal1, i)))}};
  }

  void cross(const Moved<D>& p, std::int32_t f)
  {
    const auto nodes = _facets[f];
    const std::int32_t own = _points.node[p.point];
    if (own >= 0 and std::ranges::find(nodes, own) != nodes.end())
      return;
    if constexpr (D == 2)
      cross<geometry::Segment>(p, f);
    else if (nodes.size() == 3)
      cross<geometry::Triangle>(p, f);
    else
      cross<geometry::Quadrilateral>(p, f);
  }

  template <class F>
  void cross(const Moved<D>& p, std::int32_t f)
  {
    std::array<Path<D>, F::nodes> x;
    for (int l = 0; l < F::nodes; ++l)
      x[l] = seen(node_path(_facets[f][l]), p.path);
    for_each_simplex<F>(x, [this, &p, f](const Simplex<D>& simplex)
                        { cross<F>(p, f, simplex); });
  }

  template <class F>
  void cross(const Moved<D>& p, std::int32_t f, const Simplex<D>& simplex)
  {
    for_each_change(spanned_over_time<D>(simplex),
                    [this, &p, f, &simplex](double t, bool entering)
                    {
                      std::array<Vector<D>, D> r;
                      for (int k = 0; k < D; ++k)
                        r[k] = simplex[k].at(t);
                      if (holds(r))
                        add_crossing<F>(p.point, f, t, entering);
                    });
  }

  template <class F>
  void add_crossing(std::int32_t point, std::int32_t f, double time,
                    bool entering)
  {
    const auto before = height<F>(geometry::gather<F>(_facets[f], _x0),
                                  row<D>(_points.x0, point));
    const auto after = height<F>(geometry::gather<F>(_facets[f], _x1),
                                 row<D>(_points.x1, point));
    const double cosine
        = entering ? dot(before.normal, row<D>(_points.normal0, point))
                   : dot(after.normal, row<D>(_points.normal1, point));
    _found.push_back(
        {point, f, time, entering, cosine, before.least, after.most});
  }

  geometry::FacetList _facets;
  std::span<const double> _x0, _x1;
  const geometry::RigidMotion& _motion;
  const MovedPoints& _points;
  std::vector<Crossing> _found;
};
} // namespace

std::vector<Crossing> contactx::audit::crossings(
    const geometry::FacetList& facets, std::span<const double> x0,
    std::span<const double> x1, int gdim, const geometry::RigidMotion& motion,
    const MovedPoints& points)
{
  if (gdim == 2)
    return Finder<2>(facets, x0, x1, motion, points).find();
  return Finder<3>(facets, x0, x1, motion, points).find();
}
