// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// A rubber block between a rigid disk and its base, two contacts with friction,
// in DOLFINx's own Newton solver. A step that takes too many iterations is
// taken back, and half of it is tried.
//
//     python ../sliding_block/mesh.py
//     cmake -S . -B build -DCMAKE_BUILD_TYPE=Release && cmake --build build
//     mpiexec -n 2 build/pressed_block

#include "pressed_block.h"
#include <basix/finite-element.h>
#include <contactx_dolfinx/assembler.h>
#include <contactx_dolfinx/obstacles.h>
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

    // Displacement and forms
    auto element = basix::create_element<U>(
        basix::element::family::P, basix::cell::type::quadrilateral, 1,
        basix::element::lagrange_variant::unset,
        basix::element::dpc_variant::unset, false);
    auto V
        = std::make_shared<fem::FunctionSpace<U>>(fem::create_functionspace<U>(
            mesh, std::make_shared<fem::FiniteElement<U>>(
                      element, std::vector<std::size_t>{2})));
    auto u = std::make_shared<fem::Function<T>>(V);
    auto F = std::make_shared<fem::Form<T>>(fem::create_form<T>(
        *form_pressed_block_F, {V}, {{"u", u}}, {}, {}, {}));
    auto J = std::make_shared<fem::Form<T>>(fem::create_form<T>(
        *form_pressed_block_J, {V, V}, {{"u", u}}, {}, {}, {}));

    // The base is fixed at its bottom; contacts alone hold the block
    auto fixed = std::make_shared<const fem::DirichletBC<T>>(
        std::vector<T>{0, 0},
        fem::locate_dofs_topological(*mesh->topology_mutable(), *V->dofmap(), 1,
                                     tags->find(22)),
        V);

    // Two contacts: with the base, and with the disk, which comes down
    const double radius = 0.6;
    auto disk = std::make_shared<cx::Sphere>(
        std::vector<double>{1.5, 1 + radius}, radius);
    auto below = std::make_shared<cx::Contact>(
        cx::Surface(tags, {11}), cx::Surface(tags, {21}),
        cx::Options{.friction = 0.2, .offset = 1e-8});
    auto above = std::make_shared<cx::Contact>(cx::Surface(tags, {12}), disk,
                                               cx::Options{.friction = 0.2});
    cx::Assembler assembler(F, J, u, {fixed}, {below, above});

    // DOLFINx's Newton solver with the assembler's residual and Jacobian.
    // settle() updates pairs and active set at each iterate and judges it
    cx::petsc::OwnVec b(assembler.create_vector());
    cx::petsc::OwnMat A(assembler.create_matrix());
    cx::Settled it;
    nls::petsc::NewtonSolver newton(MPI_COMM_WORLD);
    newton.max_it = 8;
    newton.report = false;
    newton.set_form([&](Vec) { it = assembler.settle(); });
    newton.setF([&](const Vec x, Vec r) { assembler.residual(x, r); }, b.get());
    newton.setJ([&](const Vec x, Mat K) { assembler.jacobian(x, K); }, A.get());
    newton.set_update(
        [&](const nls::petsc::NewtonSolver&, const Vec dx, Vec)
        {
          VecScale(dx, -1);
          assembler.update(dx, assembler.limit(dx));
        });
    newton.set_convergence_check(
        [&](const nls::petsc::NewtonSolver&, const Vec)
        { return std::pair(it.residual, it.converged); });
    cx::petsc::set_lu(newton.get_krylov_solver().ksp());

    for (double t = 0, dt = 1; t < 1;)
    {
      disk->place({1.5, 1 + radius - 0.5 * (t + dt)}, radius);
      assembler.begin_step();
      try
      {
        newton.solve(assembler.x());
      }
      catch (const std::runtime_error&)
      {
        // Displacements and contacts are those of the step's start again
        assembler.restore();
        dt /= 2;
        if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
          std::printf("t %.4f: a shorter step, %.4f\n", t, dt);
        continue;
      }
      assembler.accept();
      t += dt;
      if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
        std::printf("t %.4f  iterations %d  force of the disk %.10f  on the "
                    "base %.10f\n",
                    t, it.number, above->force()[1], below->force()[1]);
    }
  }
  PetscFinalize();
  return 0;
}
