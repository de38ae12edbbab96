// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "ranks.h"
#include <memory>

namespace contactx::mesh
{
/// @brief Nodes of the bulk on this rank, as they are handed over once: those
/// that it owns, then ghosts of other ranks.
struct BulkNodes
{
  int gdim;               ///< geometric dimension, 2 or 3
  std::int32_t num_owned; ///< nodes that this rank owns

  std::vector<std::int64_t> numbers;  ///< numbers that all ranks know
  std::vector<std::int32_t> owners;   ///< ranks that own them
  std::vector<std::int64_t> original; ///< numbers in the mesh as it was made
  std::vector<double> reference;      ///< positions (shape=(n, gdim))
};

/// @brief Functions that a halo needs of the owner of the bulk. All ranks must
/// call its functions without const.
class HaloAdapter
{
public:
  virtual ~HaloAdapter() = default;

  /// @brief The ranks.
  virtual Ranks& ranks() = 0;

  /// @brief From now on the nodes are those of the bulk and then these.
  /// @param[in] numbers Numbers that all ranks know.
  /// @param[in] owners Ranks that own them.
  virtual void set_ghosts(std::span<const std::int64_t> numbers,
                          std::span<const std::int32_t> owners) = 0;

  /// @copydoc NodeMap::forward
  virtual void forward(std::span<double> values, int width) = 0;

  /// @copydoc NodeMap::forward
  virtual void forward(std::span<std::int64_t> values, int width) = 0;

  /// @copydoc NodeMap::reverse
  virtual void reverse(std::span<double> values, int width) = 0;

  /// @brief Displacements of all nodes, those of other ranks included.
  /// @param[out] values Displacements (shape=(num_nodes, gdim)), row-major.
  virtual void displacement(std::span<double> values) const = 0;

  /// @brief The halo has changed: called once it knows its nodes again.
  virtual void changed() {}
};

/// @brief Where all nodes of a rank are at one instant.
///
/// It never changes: who keeps one knows by its address whether it is another
/// one.
struct Configuration
{
  std::vector<double> u; ///< displacements (shape=(num_nodes, gdim))
  std::vector<double> x; ///< positions (shape=(num_nodes, gdim))
};

/// @brief The bulk's nodes on this rank, followed by nodes of other ranks that
/// contact needs here.
///
/// The bulk's own numbers stay as they are: its owned nodes come first, then
/// its ghosts, then those of the contact halo. "All nodes" are all of them. The
/// halo grows as pairs are found, by nodes that are appended, and shrinks at a
/// step's start. On one rank there is none.
///
/// It owns the configurations that contacts are measured in: the reference, the
/// start of the step, and that of now.
class Halo : public NodeMap
{
public:
  /// @brief Start with the bulk's nodes alone; all ranks must take part.
  /// @param[in] bulk Nodes of the bulk.
  /// @param[in] adapter Owner of the bulk, with no nodes added to its own.
  /// @throws std::invalid_argument if the bulk's arrays do not fit together.
  Halo(BulkNodes bulk, std::unique_ptr<HaloAdapter> adapter);

  Ranks& ranks() const override { return _adapter->ranks(); }
  std::int32_t num_owned() const override { return _num_owned; }
  std::int32_t num_nodes() const override
  {
    return static_cast<std::int32_t>(_numbers.size());
  }
  void forward(std::span<double> values, int width) const override;
  void forward(std::span<std::int64_t> values, int width) const override;
  void reverse(std::span<double> values, int width) const override;

  /// @brief Geometric dimension.
  int gdim() const { return _gdim; }

  /// @brief Number of the bulk's nodes here, ghosts included.
  std::int32_t num_bulk() const { return _num_bulk; }

  /// @brief Counts how often the halo has changed.
  int version() const { return _version; }

  /// @brief Number of each node in the mesh as it was made: the same on any
  /// number of ranks (shape=(num_nodes)).
  std::span<const std::int64_t> original() const { return _original; }

  /// @brief Reference positions of all nodes (shape=(num_nodes, gdim)).
  std::span<const double> reference() const { return _reference; }

  /// @brief The configuration of now; another one where displacements or nodes
  /// have changed.
  std::shared_ptr<const Configuration> now() const;

  /// @brief The converged configuration that the step has started from; the
  /// reference before the first one.
  const std::shared_ptr<const Configuration>& start() const { return _start; }

  /// @brief Displacements of owned nodes that the last accepted step has
  /// started from, zero before there is one (shape=(num_owned, gdim)).
  const std::vector<double>& before() const { return _before; }

  /// @brief Take other displacements of owned nodes for these.
  /// @param[in] u Displacements (shape=(num_owned, gdim)).
  void set_before(std::vector<double> u) { _before = std::move(u); }

  /// @brief Take the configuration of now as the start of the next step.
  void accept();

  /// @brief Take another start of the step; all ranks must take part.
  /// @param[in] u Displacements, of which the rows of owned nodes count
  /// (shape=(at least num_owned, gdim)).
  /// @throws std::invalid_argument on all ranks if there are fewer.
  void set_start(std::span<const double> u);

  /// @brief Numbers of some nodes that all ranks know.
  /// @param[in] nodes Nodes of this rank.
  std::vector<std::int64_t> numbers(std::span<const std::int32_t> nodes) const;

  /// @brief Ranks that own some nodes.
  /// @param[in] nodes Nodes of this rank.
  std::vector<std::int32_t> owners(std::span<const std::int32_t> nodes) const;

  /// @brief Nodes by the numbers that all ranks know.
  /// @param[in] numbers Numbers of nodes that are here.
  /// @throws std::invalid_argument if one is not.
  std::vector<std::int32_t> find(std::span<const std::int64_t> numbers) const;

  /// @brief Append the nodes of these numbers that are not here yet; all ranks
  /// must take part.
  /// @param[in] numbers Numbers, in any order and more than once.
  /// @param[in] owners Ranks that own them.
  /// @param[in] for_good Whether the nodes of now stay when the halo shrinks.
  void grow(std::span<const std::int64_t> numbers,
            std::span<const std::int32_t> owners, bool for_good = false);

  /// @brief Drop nodes that were not appended for good; all ranks must take
  /// part.
  void shrink();

  /// @brief Values of all nodes that were made before the halo changed, for its
  /// nodes of now; all ranks must take part.
  /// @param[in] values Values of all nodes then, row-major.
  /// @param[in] width Values a node.
  /// @param[in] version Version at which they were made.
  std::vector<double> updated(std::vector<double> values, int width,
                              int version) const;

private:
  // -1 if it is not here
  std::int32_t node_of(std::int64_t number) const;
  // Those that were appended or dropped, on all ranks
  void take_ghosts();
  void sort();
  void check(std::span<const std::int32_t> nodes) const;
  void check(std::size_t size, int width) const;
  std::shared_ptr<const Configuration> displaced(std::vector<double> u) const;

  std::unique_ptr<HaloAdapter> _adapter;
  int _gdim, _version = 1;
  std::int32_t _num_owned, _num_bulk;
  // Nodes up to this one stay for good
  std::int32_t _num_kept;
  std::vector<std::int64_t> _numbers, _original;
  std::vector<std::int32_t> _owners;
  std::vector<double> _reference;
  std::shared_ptr<const Configuration> _start;
  std::vector<double> _before;
  mutable std::shared_ptr<const Configuration> _now;
  // Nodes in the order of their numbers
  std::vector<std::int32_t> _order;
};

/// @brief A bulk on one rank alone.
class SerialBulk final : public HaloAdapter
{
public:
  /// @brief Look at the displacement of all nodes, which may change
  /// (shape=(num_nodes, gdim)).
  explicit SerialBulk(std::shared_ptr<const std::vector<double>> displacement)
      : _displacement(std::move(displacement))
  {
  }

  Ranks& ranks() override { return _ranks; }
  void set_ghosts(std::span<const std::int64_t>,
                  std::span<const std::int32_t>) override
  {
  }
  void forward(std::span<double>, int) override {}
  void forward(std::span<std::int64_t>, int) override {}
  void reverse(std::span<double>, int) override {}
  void displacement(std::span<double> values) const override;

private:
  OneRank _ranks;
  std::shared_ptr<const std::vector<double>> _displacement;
};

/// @brief Nodes of one rank alone, in the order of the mesh as it was made.
/// @param[in] reference Reference positions (shape=(num_nodes, gdim)).
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] displacement Displacements, which may change
/// (shape=(num_nodes, gdim)); null for zero.
/// @throws std::invalid_argument if they are not as many as the positions.
std::shared_ptr<Halo>
serial_halo(std::vector<double> reference, int gdim,
            std::shared_ptr<const std::vector<double>> displacement = nullptr);
} // namespace contactx::mesh
