// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <array>
#include <contactx/contact/contact.h>
#include <dolfinx/la/Vector.h>
#include <map>
#include <span>

namespace contactx_dolfinx
{
class HaloAdapter;

/// @brief A mesh whose cells stand for pairs or slave nodes, and spaces on it
/// that borrow dofs which exist already.
///
/// Nothing geometric is read from it: every cell is the same tetrahedron.
class CarrierMesh
{
public:
  /// @brief Make the mesh; all ranks must take part.
  /// @param[in] comm Communicator.
  /// @param[in] num_cells Number of cells of this rank.
  CarrierMesh(MPI_Comm comm, std::int32_t num_cells);

  /// @brief Make a space whose dofs are those of an index map.
  /// @param[in] index_map Map of the blocks that are borrowed.
  /// @param[in] dofs Blocks of each cell (shape=(num_cells, width)).
  /// @param[in] width Blocks a cell.
  /// @param[in] bs Dofs a block.
  /// @throws std::logic_error if dofmap and element disagree on the width.
  std::shared_ptr<const FunctionSpace>
  borrow(std::shared_ptr<const dolfinx::common::IndexMap> index_map,
         std::vector<std::int32_t> dofs, int width, int bs) const;

  /// @brief Make a form over all cells.
  /// @param[in] spaces Spaces of the arguments.
  /// @param[in] kernel The kernel.
  /// @param[in] active Numbers of the coefficients that it reads.
  /// @param[in] coefficients Coefficients in the order of their values.
  std::shared_ptr<const Form>
  form(const std::vector<std::shared_ptr<const FunctionSpace>>& spaces,
       contactx::kernel::Kernel* kernel, std::vector<int> active,
       const std::vector<std::shared_ptr<const Function>>& coefficients) const;

  /// The mesh, and the index map of its cells
  std::shared_ptr<const dolfinx::mesh::Mesh<double>> mesh;
  std::shared_ptr<const dolfinx::common::IndexMap> map;
};

/// @brief Residual and Jacobian of one contact as forms of DOLFINx.
///
/// The parts are those of [[K, B], [C, D]] and [F_u, F_lambda]; the unknowns
/// are the displacement and the multipliers of the slave nodes, force/area.
/// Each part is a list of forms that add up, one for each kind of master
/// facet; it is empty where the part vanishes, as K does in small sliding. The
/// forms are assembled as any others: the spaces of the displacement borrow the
/// dofs of the bulk, those of the multipliers have a block a slave node. Dofs
/// of the displacement that only the contact needs are further ghosts, behind
/// those of the bulk, so that vectors and matrices of the forms are made with
/// `displacement_map`.
class ContactForms
{
public:
  using List = std::vector<std::shared_ptr<const Form>>;
  using IndexMap = std::shared_ptr<const dolfinx::common::IndexMap>;

  /// @brief Make the forms; all ranks must take part.
  /// @param[in] contact The contact.
  /// @param[in] adapter What its halo asks.
  /// @param[in] comm Communicator of the bulk.
  ContactForms(std::shared_ptr<contactx::contact::Contact> contact,
               std::shared_ptr<const HaloAdapter> adapter, MPI_Comm comm);

  /// @brief Take over the pairs and the state as they are now; all ranks must
  /// take part.
  void update();

  /// @brief Counts how often the forms have been made anew, as pairs or ghosts
  /// are others: matrices of other versions have other patterns. The same on
  /// all ranks.
  std::int64_t version() const { return _version; }

  /// Forces of contact, -A lambda . (v_s - sum_l N_l v_l)
  List F_u;
  /// Complementarity function, a force
  List F_lambda;
  List K; ///< derivative of F_u with respect to the displacement
  List B; ///< derivative of F_u with respect to the multiplier
  List C; ///< derivative of F_lambda with respect to the displacement
  List D; ///< derivative of F_lambda with respect to the multiplier

  /// Index map of the displacement's blocks, those of the bulk first
  IndexMap displacement_map;
  /// Index map of the slave nodes: those that this rank owns, then those of
  /// other ranks that share facets with them
  IndexMap multiplier_map;
  /// Components of a multiplier: 1, or the geometric dimension
  int multiplier_size;

private:
  using Vector = std::shared_ptr<dolfinx::la::Vector<double>>;
  // Numbers of slave and master nodes, whether pairs measure movement alone
  using Kind = std::array<int, 3>;

  static Kind kind_of(const contactx::kernel::Pairs& pairs)
  {
    return {pairs.num_slaves, pairs.num_nodes, pairs.is_movement};
  }

  Vector vector(const IndexMap& map, int bs) const;

  /// Lets a vector of the slave nodes follow values of their state.
  Vector keep(const std::vector<double>& values, int bs);

  void keep(contactx::kernel::Coefficient c, const std::vector<double>& values,
            int bs);
  IndexMap slave_map() const;

  /// Makes the forms of the part that slave nodes have by themselves.
  void make_nodal();

  void make();

  /// Makes the forms of pairs of one kind.
  void make(const Kind& kind);

  std::shared_ptr<contactx::contact::Contact> _contact;
  std::shared_ptr<const HaloAdapter> _adapter;
  MPI_Comm _comm;
  std::int64_t _version = 0;
  int _halo_version = -1;
  contactx::contact::Sliding _kinematics{};
  std::map<Kind, std::shared_ptr<const contactx::kernel::Pairs>> _pairs;
  // What the forms read: the state, all of it and where it comes from, and the
  // data of pairs
  std::map<contactx::kernel::Coefficient, Vector> _vectors;
  std::vector<std::pair<const std::vector<double>*, Vector>> _kept;
  std::map<Kind, std::map<contactx::kernel::Coefficient, Vector>> _data;
};
} // namespace contactx_dolfinx
