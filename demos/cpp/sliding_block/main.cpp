// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// A block on an elastic base, pressed down and pushed to and fro with friction:
// demos/sliding_block.py in C++, with a Newton loop of one's own.
//
//     python mesh.py
//     cmake -S . -B build -DCMAKE_BUILD_TYPE=Release && cmake --build build
//     mpiexec -n 2 build/sliding_block

#include "sliding_block.h"
#include <algorithm>
#include <basix/finite-element.h>
#include <contactx_dolfinx/assembler.h>
#include <contactx_dolfinx/vtk_output.h>
#include <cstdio>
#include <dolfinx.h>
#include <dolfinx/fem/Constant.h>
#include <dolfinx/io/XDMFFile.h>

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
    const double pressure = 0.01, width = 2, friction = 0.3;
    auto load
        = std::make_shared<fem::Constant<T>>(std::vector<T>{0, -pressure});
    const auto top = fem::compute_integration_domains(
        fem::IntegralType::exterior_facet, *mesh->topology(), tags->find(12));
    auto F = std::make_shared<fem::Form<T>>(fem::create_form<T>(
        *form_sliding_block_F, {V}, {{"u", u}}, {{"load", load}},
        {{fem::IntegralType::exterior_facet, {{12, top}}}}, {}));
    auto J = std::make_shared<fem::Form<T>>(fem::create_form<T>(
        *form_sliding_block_J, {V, V}, {{"u", u}}, {}, {}, {}));

    // The base is fixed at its bottom, the top of the block moves sideways
    std::vector<std::shared_ptr<const fem::DirichletBC<T>>> bcs;
    auto fix = [&](int component, int face)
    {
      auto value = std::make_shared<fem::Constant<T>>(0.0);
      auto Vi = std::make_shared<fem::FunctionSpace<U>>(V->sub({component}));
      bcs.push_back(std::make_shared<const fem::DirichletBC<T>>(
          std::shared_ptr<const fem::Constant<T>>(value),
          fem::locate_dofs_topological(*mesh->topology_mutable(), *Vi->dofmap(),
                                       1, tags->find(face)),
          Vi));
      return value;
    };
    fix(0, 22);
    fix(1, 22);
    auto push = fix(0, 12);

    // Contact; bodies interfere by little, so that it is closed from the start
    auto contact = std::make_shared<cx::Contact>(
        cx::Surface(tags, {11}), cx::Surface(tags, {21}),
        cx::Options{.friction = friction, .offset = 1e-8});
    cx::Assembler assembler(F, J, u, bcs, {contact});

    // Linear solver
    KSP ksp;
    KSPCreate(MPI_COMM_WORLD, &ksp);
    la::petsc::KrylovSolver solver(ksp, false);
    la::petsc::options::set("ksp_type", "preonly");
    la::petsc::options::set("pc_type", "lu");
    la::petsc::options::set("pc_factor_mat_solver_type", "mumps");
    solver.set_from_options();

    // Press, then push to the right, to the left and back; ParaView opens
    // displacement and results of all steps so far
    cx::VTKOutput output(MPI_COMM_WORLD, "sliding_block.pvd");
    const Vec x = assembler.x();
    const cx::petsc::OwnVec b(assembler.create_vector()),
        dx(assembler.create_vector());
    const cx::petsc::OwnMat A(assembler.create_matrix());
    for (int step = 0; step <= 20; ++step)
    {
      const int way = step <= 4 ? step : step <= 12 ? 8 - step : step - 16;
      push->value[0] = 0.06 * way / 4;
      assembler.begin_step();
      cx::Settled it;
      while (not(it = assembler.settle()).converged)
      {
        assembler.residual(x, b.get());
        assembler.jacobian(x, A.get());
        solver.set_operator(A.get());
        solver.solve(dx.get(), b.get());
        VecScale(dx.get(), -1);
        assembler.update(dx.get(), assembler.limit(dx.get()));
      }
      assembler.accept();
      auto functions = contact->functions().all();
      functions.push_back(*u);
      output.write(functions, step);

      const auto force = contact->force();
      const auto status = contact->status();
      auto sticking = static_cast<int>(std::ranges::count(status, 1));
      MPI_Allreduce(MPI_IN_PLACE, &sticking, 1, MPI_INT, MPI_SUM,
                    MPI_COMM_WORLD);
      if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
        std::printf("push %6.3f  force %.10f of %.4f  sticking %2d  "
                    "iterations %d\n",
                    push->value[0], -force[0], friction * pressure * width,
                    sticking, it.number);
    }
  }
  PetscFinalize();
  return 0;
}
