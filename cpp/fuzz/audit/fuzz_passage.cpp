// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <algorithm>
#include <contactx/audit/passage.h>
#include <tuple>
#include <utility>

using namespace contactx;
using namespace contactx::fuzz;
using audit::Crossing;

namespace
{
/// Points on their way.
struct Points
{
  Points(Input& in, const Scene& scene)
  {
    for (int left = 1 + in.below(6); left > 0; --left)
    {
      const Vector<3> p = scene.point(in);
      add(x0, p, scene.gdim);
      add(x1, in.flag() ? scene.point(in) : p, scene.gdim);
      for (auto* normal : {&normal0, &normal1})
        add(*normal, unit(in, scene.gdim), scene.gdim);
      tolerance.push_back(0x1p-6 * in.positive());
      node.push_back(in.below(scene.num_nodes() + 1) - 1);
    }
  }

  static void add(std::vector<double>& values, const Vector<3>& v, int gdim)
  {
    values.insert(values.end(), v.begin(), v.begin() + gdim);
  }

  static Vector<3> unit(Input& in, int gdim)
  {
    Vector<3> n{};
    if (in.below(8) == 0)
      return n;
    if (gdim == 3)
      return in.unit<3>();
    const auto flat = in.unit<2>();
    std::ranges::copy(flat, n.begin());
    return n;
  }

  audit::MovedPoints view() const
  {
    return {x0, x1, normal0, normal1, tolerance, node};
  }

  std::vector<double> x0, x1, normal0, normal1, tolerance;
  std::vector<std::int32_t> node;
};

auto order(const Crossing& c)
{
  return std::tuple(c.point, c.facet, c.time, c.entering);
}

void check(const Crossing& c, const Scene& scene, const Points& points)
{
  const auto facets = scene.master.facets();
  require(c.point >= 0 and c.point < std::ssize(points.tolerance),
          "the point exists");
  require(c.facet >= 0 and c.facet < facets.size(), "the facet exists");
  require(c.time >= 0 and c.time <= 1, "it is within the step");
  const auto nodes = facets[c.facet];
  const auto own = points.node[c.point];
  require(own < 0 or std::ranges::find(nodes, own) == nodes.end(),
          "it is no facet of the point's own");
  require(!(std::abs(c.cosine) > 1 + 1e-9), "normals have length one");
}

/// The crossings of parts of a surface are those of the whole.
void check_parts(const Scene& scene, const std::vector<double>& x1,
                 const geometry::RigidMotion& motion, const Points& points,
                 std::vector<Crossing> whole, int cut)
{
  const List& all = scene.master;
  List first = all, second;
  first.cut(cut);
  for (std::int32_t f = first.size(); f < all.size(); ++f)
  {
    const auto nodes = all.facets()[f];
    second.nodes.insert(second.nodes.end(), nodes.begin(), nodes.end());
    second.offsets.push_back(static_cast<std::int32_t>(second.nodes.size()));
  }
  auto parts = audit::crossings(first.facets(), scene.x, x1, scene.gdim, motion,
                                points.view());
  for (Crossing c : audit::crossings(second.facets(), scene.x, x1, scene.gdim,
                                     motion, points.view()))
  {
    c.facet += first.size();
    parts.push_back(c);
  }
  std::ranges::sort(parts, {}, order);
  std::ranges::sort(whole, {}, order);
  require(std::ranges::equal(parts, whole, {}, order, order),
          "parts have the crossings of the whole");
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  Scene scene(in);
  const std::vector<double> x0 = scene.x;
  scene.move(in);
  const std::vector<double> x1 = std::exchange(scene.x, x0);
  const Points points(in, scene);
  const auto facets = scene.master.facets();
  const Vector<3> origin0 = scene.point(in), origin1 = scene.point(in);
  const auto motion = geometry::rigid_motion(
      geometry::moments(facets, x0, x1, scene.gdim, origin0, origin1),
      scene.gdim, origin0, origin1);
  const auto found
      = audit::crossings(facets, x0, x1, scene.gdim, motion, points.view());
  for (const Crossing& c : found)
    check(c, scene, points);
  if (in.finite())
  {
    for (const auto& row : motion.rotation)
      require(is_unit(row), "the rotation is one");
    check_parts(scene, x1, motion, points, found, in.below(9));
  }
  const auto which = audit::passed(found, points.tolerance);
  for (std::size_t i = 0; i < which.size(); ++i)
  {
    if (which[i] < 0)
      continue;
    const Crossing& c = found[which[i]];
    require(c.point == static_cast<std::int32_t>(i) and c.entering
                and c.cosine < -audit::oblique_cosine,
            "a point passes what it faces");
  }
  const auto again = audit::passages(facets, x0, x1, scene.gdim, points.view());
  require(again.facet.size() == which.size(), "each point has an answer");
  return 0;
}
