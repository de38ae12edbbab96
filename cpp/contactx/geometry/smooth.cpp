// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "smooth.h"
#include "gather.h"
#include "middle.h"
#include <numeric>

using namespace contactx;
using namespace contactx::geometry;

namespace
{
/// Facets of a node that belong to one smooth sheet.
struct Sheet
{
  std::int32_t node;
  std::vector<std::int32_t> facets, others; ///< and the nodes of these
  bool is_closed;                           ///< whether they are all around
  Vector<3> normal{};
  bool is_known = false;
};

/// Slopes and curvatures of a height over a plane, and directions in it.
constexpr int max_unknowns = 5;
using Row = std::array<double, max_unknowns>;

/// Solves a least-squares problem by its normal equations; what the rows do not
/// determine becomes small.
class LeastSquares
{
public:
  explicit LeastSquares(int n) : _n(n) {}

  void add(const Row& row, double value)
  {
    for (int i = 0; i < _n; ++i)
    {
      for (int j = 0; j < _n; ++j)
        _A[i][j] += row[i] * row[j];
      _b[i] += row[i] * value;
    }
  }

  Row solve()
  {
    // Added to the diagonal, over the trace: unknowns without data are zero
    constexpr double trace_damping = 1e-9;
    double trace = 0;
    for (int i = 0; i < _n; ++i)
      trace += _A[i][i];
    for (int i = 0; i < _n; ++i)
      _A[i][i] += trace_damping * trace;
    Row y{};
    // Cholesky's factor in place
    for (int i = 0; i < _n; ++i)
      for (int j = 0; j <= i; ++j)
      {
        double s = _A[i][j];
        for (int k = 0; k < j; ++k)
          s -= _A[i][k] * _A[j][k];
        _A[i][j] = i == j ? std::sqrt(s) : s / _A[j][j];
      }
    for (int i = 0; i < _n; ++i)
    {
      y[i] = _b[i];
      for (int k = 0; k < i; ++k)
        y[i] -= _A[i][k] * y[k];
      y[i] /= _A[i][i];
    }
    for (int i = _n; i-- > 0;)
    {
      for (int k = i + 1; k < _n; ++k)
        y[i] -= _A[k][i] * y[k];
      y[i] /= _A[i][i];
    }
    return y;
  }

private:
  int _n;
  std::array<Row, max_unknowns> _A{};
  Row _b{};
};

class Fit
{
public:
  Fit(const FacetList& facets, std::span<const double> x, int gdim)
      : _facets(facets), _x(x), _gdim(gdim), _middles(middles(facets, x, gdim)),
        _of_corner(facets.nodes.size(), -1)
  {
    find_sheets();
    // Where facets are all around, the nodes alone tell; then those beside what
    // is known, from row to row, and in the end those that nothing is beside of
    take([](const Sheet& sheet) { return sheet.is_closed; });
    while (take(
        [this](const Sheet& sheet)
        {
          return std::ranges::any_of(sheet.others, [&](std::int32_t other)
                                     { return known(sheet, other); });
        }))
    {
    }
    take([](const Sheet&) { return true; });
  }

  SmoothFacet of(std::int32_t f) const
  {
    SmoothFacet smooth;
    const auto nodes = _facets[f];
    const std::size_t first = _facets.offsets[f];
    for (std::size_t l = 0; l < nodes.size(); ++l)
      smooth.normal[l] = sheet_at(first + l).normal;
    visit(static_cast<int>(nodes.size()),
          [&]<class F>(F)
          {
            for (int e = 0; e < F::num_edges; ++e)
            {
              const auto [i, j] = F::edges[e];
              if (not has_neighbour(f, first + i, nodes[j]))
                smooth.sharp |= 1 << e;
            }
            for (int l = 0; l < F::nodes; ++l)
              if (not sheet_at(first + l).is_closed)
                smooth.sharp |= 1 << (F::num_edges + l);
          });
    return smooth;
  }

private:
  /// Finds the normals of sheets that have none and are chosen; whether there
  /// are any.
  template <class Choose>
  bool take(Choose&& is_chosen)
  {
    std::vector<std::pair<std::size_t, Vector<3>>> found;
    for (std::size_t s = 0; s < _sheets.size(); ++s)
      if (not _sheets[s].is_known and is_chosen(_sheets[s]))
        found.emplace_back(s, normal_of(_sheets[s]));
    for (const auto& [s, n] : found)
    {
      _sheets[s].normal = n;
      _sheets[s].is_known = true;
    }
    return not found.empty();
  }

  const Sheet& sheet_at(std::size_t corner) const
  {
    return _sheets[_of_corner[corner]];
  }

  Vector<3> facet_normal(std::int32_t f) const
  {
    return vector_at(_middles.normals, f, _gdim);
  }

  bool has(std::int32_t f, std::int32_t node) const
  {
    return std::ranges::find(_facets[f], node) != _facets[f].end();
  }

  /// Whether another facet of a corner's sheet has an edge of that corner, too.
  bool has_neighbour(std::int32_t f, std::size_t corner,
                     std::int32_t other) const
  {
    return std::ranges::any_of(sheet_at(corner).facets, [&](std::int32_t e)
                               { return e != f and has(e, other); });
  }

  /// Other nodes that two facets share beside a node; in 2D that one.
  bool are_neighbours(std::int32_t e, std::int32_t f, std::int32_t node) const
  {
    if (_gdim == 2)
      return true;
    return std::ranges::any_of(_facets[e], [&](std::int32_t other)
                               { return other != node and has(f, other); });
  }

  void find_sheets()
  {
    std::int32_t num_nodes = 0;
    for (const std::int32_t node : _facets.nodes)
      num_nodes = std::max(num_nodes, node + 1);
    std::vector<std::vector<std::int32_t>> around(num_nodes);
    for (std::int32_t f = 0; f < _facets.size(); ++f)
      for (const std::int32_t node : _facets[f])
        around[node].push_back(f);
    for (std::int32_t node = 0; node < num_nodes; ++node)
      for (std::vector<std::int32_t> left = around[node]; not left.empty();)
      {
        Sheet sheet{node, {left.back()}, {}, false};
        left.pop_back();
        for (std::size_t i = 0; i < sheet.facets.size(); ++i)
          std::erase_if(left,
                        [&](std::int32_t f)
                        {
                          const std::int32_t e = sheet.facets[i];
                          const bool joins
                              = are_neighbours(e, f, node)
                                and dot(facet_normal(e), facet_normal(f))
                                        >= cosine_at_edges;
                          if (joins)
                            sheet.facets.push_back(f);
                          return joins;
                        });
        std::ranges::sort(sheet.facets);
        add(std::move(sheet));
      }
  }

  void add(Sheet sheet)
  {
    std::vector<std::int32_t> ends; // of the edges at the node
    for (const std::int32_t f : sheet.facets)
      visit(static_cast<int>(_facets[f].size()),
            [&]<class F>(F)
            {
              const auto nodes = _facets[f];
              for (int l = 0; l < F::nodes; ++l)
                if (nodes[l] == sheet.node)
                  _of_corner[_facets.offsets[f] + l]
                      = static_cast<std::int32_t>(_sheets.size());
                else
                  sheet.others.push_back(nodes[l]);
              for (const auto& [i, j] : F::edges)
                if (nodes[i] == sheet.node)
                  ends.push_back(nodes[j]);
                else if (nodes[j] == sheet.node and F::gdim == 3)
                  ends.push_back(nodes[i]);
            });
    std::ranges::sort(sheet.others);
    sheet.others.erase(std::unique(sheet.others.begin(), sheet.others.end()),
                       sheet.others.end());
    // Each edge at an inner node has two facets; in 2D the node has
    std::ranges::sort(ends);
    if (_gdim == 2)
      sheet.is_closed = ends.size() == 2;
    else
    {
      sheet.is_closed = ends.size() % 2 == 0;
      for (std::size_t i = 0; sheet.is_closed and i < ends.size(); i += 2)
        sheet.is_closed = ends[i] == ends[i + 1];
    }
    _sheets.push_back(std::move(sheet));
  }

  /// Unit normal of the paraboloid about a node.
  Vector<3> normal_of(const Sheet& sheet) const
  {
    Vector<3> mean{};
    for (const std::int32_t f : sheet.facets)
      mean = mean + facet_normal(f);
    mean = (1 / norm(mean)) * mean;
    const Vector<3> point = vector_at(_x, sheet.node, _gdim);
    Vector<3> first = cross(mean, {0, 0, 1});
    if (_gdim == 3)
    {
      int axis = 0;
      for (int k = 1; k < 3; ++k)
        if (std::abs(mean[k]) < std::abs(mean[axis]))
          axis = k;
      Vector<3> along{};
      along[axis] = 1;
      first = cross(mean, along);
    }
    first = (1 / norm(first)) * first;
    const Vector<3> second = cross(mean, first);
    const int across = _gdim - 1;
    double size = 0;
    for (const std::int32_t other : sheet.others)
      size += norm(vector_at(_x, other, _gdim) - point)
              / static_cast<double>(sheet.others.size());
    LeastSquares fit(across == 1 ? 2 : max_unknowns);
    for (const std::int32_t other : sheet.others)
    {
      const Vector<3> edge = (1 / size) * (vector_at(_x, other, _gdim) - point);
      const double far = norm(edge), height = dot(edge, mean);
      const double s = dot(edge, first), t = dot(edge, second);
      // Slopes, then curvatures: weighted, so that near nodes tell more
      const Row row = across == 1 ? Row{s, 0.5 * s * s}
                                  : Row{s, t, 0.5 * s * s, s * t, 0.5 * t * t};
      fit.add((1 / far) * row, height / far);
      if (const Sheet* beside = sheet.is_closed ? nullptr : known(sheet, other))
      {
        const double up = dot(beside->normal, mean);
        const double slope = -dot(beside->normal, first) / up;
        if (across == 1)
          fit.add({1, s}, slope);
        else
        {
          fit.add({1, 0, s, t, 0}, slope);
          fit.add({0, 1, 0, s, t}, -dot(beside->normal, second) / up);
        }
      }
    }
    const Row y = fit.solve();
    Vector<3> n = mean - y[0] * first;
    if (across == 2)
      n = n - y[1] * second;
    return (1 / norm(n)) * n;
  }

  /// Sheet of another node that a sheet continues in, if its normal is known.
  const Sheet* known(const Sheet& sheet, std::int32_t node) const
  {
    for (const std::int32_t f : sheet.facets)
    {
      const auto nodes = _facets[f];
      for (std::size_t l = 0; l < nodes.size(); ++l)
        if (nodes[l] == node and sheet_at(_facets.offsets[f] + l).is_known)
          return &sheet_at(_facets.offsets[f] + l);
    }
    return nullptr;
  }

  const FacetList& _facets;
  std::span<const double> _x;
  int _gdim;
  Middles _middles;
  std::vector<Sheet> _sheets;
  std::vector<std::int32_t> _of_corner; // sheet of each corner of each facet
};
} // namespace

std::vector<SmoothFacet>
contactx::geometry::smooth_facets(const FacetList& facets,
                                  std::span<const double> x, int gdim)
{
  const Fit fit(facets, x, gdim);
  std::vector<SmoothFacet> result;
  for (std::int32_t f = 0; f < facets.size(); ++f)
    result.push_back(fit.of(f));
  return result;
}
