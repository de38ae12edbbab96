// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "threads.h"
#include <contactx/mesh/mesh.h>

namespace contactx::tests
{
/// @brief A part of the boundary of blocks.
struct Side
{
  geometry::Facets facets;        ///< oriented outward
  std::vector<std::int32_t> cell; ///< of each facet

  Side operator+(const Side& other) const
  {
    Side both = *this;
    for (std::int32_t f = 0; f < other.facets.list().size(); ++f)
      both.add(other.facets.list()[f], other.cell[f]);
    return both;
  }

  void add(std::span<const std::int32_t> nodes, std::int32_t of)
  {
    add_facet(facets, nodes);
    cell.push_back(of);
  }
};

/// @brief Blocks of quadrilaterals or hexahedra, each with nodes of its own.
struct Blocks
{
  int gdim;
  std::vector<double> x;
  std::vector<std::int32_t> cells; ///< (shape=(num_cells, 2^gdim))

  explicit Blocks(int dimension) : gdim(dimension) {}

  int width() const { return 1 << gdim; }
  std::int32_t num_nodes() const
  {
    return static_cast<std::int32_t>(x.size()) / gdim;
  }

  /// @brief Add a block of n cells an axis; its number.
  int add(int n, const Vector<3>& low, const Vector<3>& high)
  {
    _blocks.push_back(
        {n, num_nodes(), static_cast<std::int32_t>(cells.size() / width())});
    const int layers = gdim == 3 ? n : 0;
    for (int k = 0; k <= layers; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
        {
          const std::array<int, 3> at{i, j, k};
          for (int a = 0; a < gdim; ++a)
            x.push_back(low[a] + (high[a] - low[a]) * at[a] / n);
        }
    for (int k = 0; k < std::max(layers, 1); ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          for (int corner = 0; corner < width(); ++corner)
            cells.push_back(
                node(_blocks.back(), {i + (corner & 1), j + (corner >> 1 & 1),
                                      k + (corner >> 2)}));
    return static_cast<int>(_blocks.size()) - 1;
  }

  /// @brief Side of a block, at the lower or the upper end of an axis.
  Side side(int block, int axis, bool is_upper) const
  {
    const Block& b = _blocks[block];
    Side found;
    for (int j = 0; j < b.n; ++j)
      for (int i = 0; i < (gdim == 3 ? b.n : 1); ++i)
      {
        // In the plane the first of the other axes alone
        std::array<int, 3> cell{};
        const int u = (axis + 1) % gdim, v = (axis + 2) % gdim;
        cell[axis] = is_upper ? b.n - 1 : 0;
        cell[u] = j;
        if (gdim == 3)
          cell[v] = i;
        const auto corner = [&](int a, int c)
        {
          std::array<int, 3> at = cell;
          at[axis] += is_upper;
          at[u] += a;
          if (gdim == 3)
            at[v] += c;
          return node(b, at);
        };
        const std::int32_t of
            = b.first_cell + (cell[2] * b.n + cell[1]) * b.n + cell[0];
        if (gdim == 3)
        {
          std::vector<std::int32_t> nodes{corner(0, 0), corner(1, 0),
                                          corner(0, 1), corner(1, 1)};
          if (not is_upper)
            std::swap(nodes[1], nodes[2]);
          found.add(nodes, of);
        }
        else
        {
          std::vector<std::int32_t> nodes{corner(0, 0), corner(1, 0)};
          // The normal is the tangent turned clockwise
          if (is_upper != (axis == 0))
            std::swap(nodes[0], nodes[1]);
          found.add(nodes, of);
        }
      }
    return found;
  }

private:
  struct Block
  {
    int n;
    std::int32_t first_node, first_cell;
  };

  std::int32_t node(const Block& b, const std::array<int, 3>& at) const
  {
    return b.first_node + (at[2] * (b.n + 1) + at[1]) * (b.n + 1) + at[0];
  }

  std::vector<Block> _blocks;
};

/// @brief Blocks on some ranks, in slabs along the first axis or anyhow; nodes
/// are numbered in the mesh as it was made in some other order.
struct DistributedBlocks
{
  DistributedBlocks(const Blocks& mesh, int num_ranks, bool is_scattered)
      : blocks(mesh), _random(5),
        nodes(owners(mesh, num_ranks, is_scattered), num_ranks, _random)
  {
  }

  int rank_of(std::int32_t cell) const
  {
    return nodes.owner[blocks.cells[std::size_t(cell) * blocks.width()]];
  }

  const Blocks& blocks;

private:
  static std::vector<int> owners(const Blocks& mesh, int num_ranks,
                                 bool is_scattered)
  {
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < mesh.x.size(); i += mesh.gdim)
    {
      low = std::min(low, mesh.x[i]);
      high = std::max(high, mesh.x[i]);
    }
    Generator random(3);
    std::vector<int> owner;
    for (std::size_t i = 0; i < mesh.x.size(); i += mesh.gdim)
    {
      const double part = is_scattered
                              ? random(0, 1)
                              : 0.999 * (mesh.x[i] - low) / (high - low);
      owner.push_back(static_cast<int>(num_ranks * part));
    }
    return owner;
  }

  Generator _random;

public:
  Distribution nodes;
};

/// @brief A rank's part of blocks.
struct RankBlocks
{
  std::shared_ptr<mesh::Halo> halo;
  std::shared_ptr<mesh::Bodies> bodies;
  std::vector<std::int32_t> cells;

  RankBlocks(const DistributedBlocks& all, ThreadRanks& ranks) : _all(all)
  {
    const Blocks& blocks = all.blocks;
    const int width = blocks.width();
    std::vector<std::int32_t> ghosts, mine;
    for (std::size_t c = 0; c * width < blocks.cells.size(); ++c)
      if (all.rank_of(static_cast<std::int32_t>(c)) == ranks.rank())
        mine.insert(mine.end(), &blocks.cells[c * width],
                    &blocks.cells[c * width] + width);
    for (const std::int32_t node : mine)
      if (all.nodes.owner[node] != ranks.rank())
        ghosts.push_back(node);
    halo = thread_halo(all.nodes, ranks, ghosts, blocks.x,
                       std::vector<double>(blocks.x.size(), 0.0), blocks.gdim);
    for (const std::int32_t node : mine)
      cells.push_back(here(node));
    bodies = std::make_shared<mesh::Bodies>(
        cells, width, static_cast<std::int32_t>(cells.size()) / width,
        halo->original().first(halo->num_bulk()), halo);
  }

  mesh::Mesh mesh() const { return {halo, bodies, cells, _all.blocks.width()}; }

  /// @brief Facets of a side that belong to this rank's cells.
  geometry::Facets own(const Side& side) const
  {
    geometry::Facets result;
    for (std::int32_t f = 0; f < side.facets.list().size(); ++f)
      if (_all.rank_of(side.cell[f]) == halo->ranks().rank())
        add_facet(result, side.facets.list()[f],
                  [this](std::int32_t node) { return here(node); });
    return result;
  }

private:
  std::int32_t here(std::int32_t node) const
  {
    return halo->find(std::vector{_all.nodes.number[node]}).front();
  }

  const DistributedBlocks& _all;
};

/// @brief What work(rank_blocks) throws on all ranks; empty if nothing.
template <class Work>
std::string said(const Blocks& blocks, int num_ranks, Work work,
                 bool is_scattered = false)
{
  const DistributedBlocks all(blocks, num_ranks, is_scattered);
  return said_on(num_ranks,
                 [&](ThreadRanks& ranks) { work(RankBlocks(all, ranks)); });
}

/// @brief A block of a size on another one, which is 1 high and `wide`.
struct Stacked
{
  Blocks blocks;

  /// @brief Put the upper one, of n cells an axis, at `low` and at a height
  /// above the lower one, which has four.
  Stacked(int gdim, double low, double height, double size, double wide,
          int n = 3)
      : blocks(gdim)
  {
    Vector<3> at{low, low, low}, bottom{}, top{wide, wide, wide};
    at[gdim - 1] = height;
    bottom[gdim - 1] = -1;
    top[gdim - 1] = 0;
    blocks.add(n, at, at + Vector<3>{size, size, size});
    blocks.add(4, bottom, top);
  }

  Side upper(int axis, bool is_upper) const
  {
    return blocks.side(0, axis, is_upper);
  }
  Side lower(int axis, bool is_upper) const
  {
    return blocks.side(1, axis, is_upper);
  }
};
} // namespace contactx::tests
