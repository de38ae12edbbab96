// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "operator.h"

namespace contactx::condense
{
/// @brief What contact adds to a block of the bulk's matrix.
struct BlockChange
{
  MatrixPtr added;           ///< what is added
  bool is_symmetric = false; ///< whether it is symmetric where the block is
};

/// @brief Displacements of soft bodies, or of stiff ones, and the bulk's block.
/// All ranks must take part in all of it.
class DofBlock
{
public:
  /// @brief Take a block out of the bulk's matrix.
  /// @param[in] numbering Displacements of this rank; it must outlive this.
  /// @param[in] dofs Owned displacements, ascending.
  /// @param[in] K The bulk's matrix.
  DofBlock(const Numbering& numbering, std::vector<std::int32_t> dofs,
           const Matrix& K);

  /// @brief Owned displacements, ascending.
  const std::vector<std::int32_t>& dofs() const { return _dofs; }

  /// @brief The same in the numbers of the bulk's matrix.
  const std::vector<std::int64_t>& numbers() const { return _numbers; }

  /// @brief The bulk's block.
  const Matrix& K() const { return *_K; }

  /// @brief Number of displacements of a node if these are of whole nodes on
  /// all ranks, else one.
  int group() const { return _group; }

  /// @brief Places of owned displacements among these, of those that are there.
  std::vector<std::int32_t> places(std::span<const std::int32_t> dofs) const;

  /// @brief Absolute values of the block's diagonal.
  std::vector<double> diagonal() const;

  /// @brief What contact adds to the block: (I + L) (K + S) (I + R) + law (I +
  /// R) + springs - K.
  /// @param[in] transforms What contact does.
  BlockChange change(const Transforms& transforms) const;

  /// @brief The block and what contact adds to it, with the block's own
  /// diagonal for what is eliminated. So factors serve where displacements are
  /// no longer eliminated.
  /// @param[in] added What contact adds.
  /// @param[in] eliminated Owned displacements that are eliminated.
  MatrixPtr with(const Matrix& added,
                 std::span<const std::int32_t> eliminated) const;

private:
  MatrixPtr part(const MatrixPtr& A) const;

  const Numbering& _numbering;
  Algebra& _algebra;
  std::vector<std::int32_t> _dofs, _places;
  std::vector<std::int64_t> _numbers;
  MatrixPtr _K;
  int _group;
};
} // namespace contactx::condense
