// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// A loop of one's own on forms: DOLFINx's Newton solver with bulk and contact
// in one matrix. The block of demos/cpp/sliding_block is pushed until it
// slides. The program assembles the bulk itself; the lines marked "contact" add
// the contact's forms to the same vector and matrix, and let pairs, active set
// and law follow each iterate.
//
//     python ../sliding_block/mesh.py
//     cmake -S . -B build -DCMAKE_BUILD_TYPE=Release && cmake --build build
//     mpiexec -n 2 build/own_forms

#include "sliding_block.h"
#include <basix/finite-element.h>
#include <contactx_dolfinx/forms.h>
#include <cstdio>
#include <dolfinx.h>
#include <dolfinx/fem/Constant.h>
#include <dolfinx/io/XDMFFile.h>
#include <dolfinx/nls/NewtonSolver.h>

using namespace dolfinx;
using T = PetscScalar;
using U = double;
namespace cx = contactx_dolfinx;

int main(int argc, char* argv[])
{
  init_logging(argc, argv);
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  {
    // Mesh: the block (tags 1x) on its base (2x)
    io::XDMFFile file(MPI_COMM_WORLD, "sliding_block.xdmf", "r");
    const fem::CoordinateElement<U> cell(mesh::CellType::quadrilateral, 1);
    auto mesh = std::make_shared<mesh::Mesh<U>>(
        file.read_mesh(cell, mesh::GhostMode::shared_facet, "mesh"));
    mesh->topology_mutable()->create_entities(1);
    mesh->topology_mutable()->create_connectivity(1, 2);
    mesh->topology_mutable()->create_connectivity(2, 1);
    auto tags = std::make_shared<const mesh::MeshTags<std::int32_t>>(
        file.read_meshtags(*mesh, "facet_tags", std::nullopt));

    // Displacement and forms, with a pressure on the top
    auto element = basix::create_element<U>(
        basix::element::family::P, basix::cell::type::quadrilateral, 1,
        basix::element::lagrange_variant::unset,
        basix::element::dpc_variant::unset, false);
    auto V
        = std::make_shared<fem::FunctionSpace<U>>(fem::create_functionspace<U>(
            mesh, std::make_shared<fem::FiniteElement<U>>(
                      element, std::vector<std::size_t>{2})));
    auto u = std::make_shared<fem::Function<T>>(V);
    auto load = std::make_shared<fem::Constant<T>>(std::vector<T>{0, -0.01});
    const auto top = fem::compute_integration_domains(
        fem::IntegralType::exterior_facet, *mesh->topology(), tags->find(12));
    auto F = std::make_shared<fem::Form<T>>(fem::create_form<T>(
        *form_sliding_block_F, {V}, {{"u", u}}, {{"load", load}},
        {{fem::IntegralType::exterior_facet, {{12, top}}}}, {}));
    auto J = std::make_shared<fem::Form<T>>(fem::create_form<T>(
        *form_sliding_block_J, {V, V}, {{"u", u}}, {}, {}, {}));

    // The base is fixed at its bottom, the top of the block moves sideways
    std::vector<std::shared_ptr<const fem::DirichletBC<T>>> bcs;
    std::vector<std::reference_wrapper<const fem::DirichletBC<T>>> conditions;
    auto fix = [&](int component, int face)
    {
      auto value = std::make_shared<fem::Constant<T>>(0.0);
      auto Vi = std::make_shared<fem::FunctionSpace<U>>(V->sub({component}));
      bcs.push_back(std::make_shared<const fem::DirichletBC<T>>(
          std::shared_ptr<const fem::Constant<T>>(value),
          fem::locate_dofs_topological(*mesh->topology_mutable(), *Vi->dofmap(),
                                       1, tags->find(face)),
          Vi));
      conditions.push_back(*bcs.back());
      return value;
    };
    fix(0, 22);
    fix(1, 22);
    auto push = fix(0, 12);

    auto contact = std::make_shared<cx::Contact>( // contact
        cx::Surface(tags, {11}), cx::Surface(tags, {21}),
        cx::Options{.friction = 0.3, .offset = 1e-8});
    cx::Assembler assembler(F, J, u, bcs, {contact}); // contact
    cx::Forms forms(assembler, J);                    // contact
    cx::Settled it;
    cx::petsc::OwnVec b(assembler.create_vector());

    nls::petsc::NewtonSolver newton(MPI_COMM_WORLD);
    newton.report = false;
    newton.set_form([&](Vec x)
                    { it = forms.settle(x); }); // contact: pairs, law
    newton.setF(
        [&](const Vec, Vec b)
        {
          const auto& map = V->dofmap()->index_map;
          la::Vector<T> force(map, 2);
          std::ranges::fill(force.array(), 0);
          fem::assemble_vector(force.array(), *F);
          fem::apply_lifting(force.array(), {*J}, {conditions},
                             {std::span<const T>(u->x()->array())}, -1.0);
          force.scatter_rev(std::plus<T>());
          for (const auto& bc : bcs)
            bc->set(force.array(), u->x()->array(), -1);
          VecZeroEntries(b);
          {
            const cx::petsc::Values values(b);
            std::copy_n(force.array().begin(), 2 * map->size_local(),
                        values.span().begin());
          }
          forms.assemble_vector(b); // contact
        },
        b.get());
    newton.setJ(
        [&](const Vec, Mat A)
        {
          forms.matrix(); // contact: zero, with places for the pairs of now
          fem::assemble_matrix(
              la::petsc::Matrix::set_block_expand_fn(A, 2, 2, ADD_VALUES), *J,
              conditions);
          fem::set_diagonal<T>(la::petsc::Matrix::set_fn(A, ADD_VALUES), *V,
                               conditions);
          forms.assemble_matrix(A); // contact
        },
        forms.matrix());
    newton.set_update(
        [&](const nls::petsc::NewtonSolver&, const Vec dx, Vec x)
        {
          VecScale(dx, -1);
          VecAXPY(x, assembler.limit(dx), dx); // contact: no cell turns over
        });
    newton.set_convergence_check(
        [&](const nls::petsc::NewtonSolver&, const Vec)
        { return std::pair(it.residual, it.converged); });
    cx::petsc::set_lu(newton.get_krylov_solver().ksp());

    for (int step = 0; step <= 6; ++step)
    {
      push->value[0] = 0.015 * step;
      assembler.begin_step(); // contact
      newton.solve(assembler.x());
      assembler.accept(); // contact
      const auto force = contact->force();
      if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
        std::printf("push %6.3f  force %.10f  iterations %d\n", push->value[0],
                    -force[0], it.number);
    }
  }
  PetscFinalize();
  return 0;
}
