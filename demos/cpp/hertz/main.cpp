// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// Hertz: an elastic sphere on an elastic block, demos/hertz_sphere.py in C++,
// with a Newton loop of one's own.
//
//     python mesh.py 0.05
//     cmake -S . -B build -DCMAKE_BUILD_TYPE=Release && cmake --build build
//     mpiexec -n 2 build/hertz
//     mpiexec -n 2 build/hertz -condensed
//
// For fine meshes: -condensed eliminates the multipliers and finds the
// displacements by CG with multigrid.

#include "hertz.h"
#include <basix/finite-element.h>
#include <cmath>
#include <contactx_dolfinx/condensed.h>
#include <cstdio>
#include <dolfinx.h>
#include <dolfinx/fem/Constant.h>
#include <dolfinx/io/XDMFFile.h>
#include <numbers>

using namespace dolfinx;
using T = PetscScalar;
using U = double;
namespace cx = contactx_dolfinx;

int main(int argc, char* argv[])
{
  init_logging(argc, argv);
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  {
    // Mesh: a quarter of a hemisphere (tags 1x) on a quarter of a block (2x)
    io::XDMFFile file(MPI_COMM_WORLD, "hertz.xdmf", "r");
    const fem::CoordinateElement<U> cell(mesh::CellType::tetrahedron, 1);
    auto mesh = std::make_shared<mesh::Mesh<U>>(
        file.read_mesh(cell, mesh::GhostMode::shared_facet, "mesh"));
    mesh->topology_mutable()->create_entities(2);
    mesh->topology_mutable()->create_connectivity(2, 3);
    auto tags = std::make_shared<const mesh::MeshTags<std::int32_t>>(
        file.read_meshtags(*mesh, "facet_tags", std::nullopt));

    // Displacement and forms
    auto element = basix::create_element<U>(
        basix::element::family::P, basix::cell::type::tetrahedron, 1,
        basix::element::lagrange_variant::unset,
        basix::element::dpc_variant::unset, false);
    auto V
        = std::make_shared<fem::FunctionSpace<U>>(fem::create_functionspace<U>(
            mesh, std::make_shared<fem::FiniteElement<U>>(
                      element, std::vector<std::size_t>{3})));
    auto u = std::make_shared<fem::Function<T>>(V);
    auto F = std::make_shared<fem::Form<T>>(
        fem::create_form<T>(*form_hertz_F, {V}, {{"u", u}}, {}, {}, {}));
    auto J = std::make_shared<fem::Form<T>>(
        fem::create_form<T>(*form_hertz_J, {V, V}, {{"u", u}}, {}, {}, {}));

    // Supports, and the top of the sphere that moves down
    std::vector<std::shared_ptr<const fem::DirichletBC<T>>> bcs;
    auto fix = [&](int component, T value, std::initializer_list<int> faces)
    {
      std::vector<std::int32_t> facets;
      for (int face : faces)
        std::ranges::copy(tags->find(face), std::back_inserter(facets));
      std::ranges::sort(facets);
      auto Vi = std::make_shared<fem::FunctionSpace<U>>(V->sub({component}));
      bcs.push_back(std::make_shared<const fem::DirichletBC<T>>(
          value,
          fem::locate_dofs_topological(*mesh->topology_mutable(), *Vi->dofmap(),
                                       2, facets),
          Vi));
    };
    fix(0, 0, {13, 23});
    fix(1, 0, {14, 24});
    fix(2, -0.02, {12});
    for (int i = 0; i < 3; ++i)
      fix(i, 0, {22});

    // Contact
    auto contact = std::make_shared<cx::Contact>(cx::Surface(tags, {11}),
                                                 cx::Surface(tags, {21}));
    cx::Assembler assembler(F, J, u, bcs, {contact});

    // Linear solver
    KSP ksp;
    KSPCreate(MPI_COMM_WORLD, &ksp);
    la::petsc::KrylovSolver solver(ksp, false);
    la::petsc::options::set("ksp_type", "preonly");
    la::petsc::options::set("pc_type", "lu");
    la::petsc::options::set("pc_factor_mat_solver_type", "mumps");
    solver.set_from_options();
    PetscBool is_condensed = PETSC_FALSE;
    PetscOptionsHasName(nullptr, nullptr, "-condensed", &is_condensed);
    cx::Condensed condensed(assembler, "condensed_");

    // Newton loop
    const Vec x = assembler.x();
    const cx::petsc::OwnVec b(assembler.create_vector()),
        dx(assembler.create_vector());
    const cx::petsc::OwnMat A(assembler.create_matrix());
    const int rank = dolfinx::MPI::rank(MPI_COMM_WORLD);
    assembler.begin_step();
    cx::Settled it;
    while (not(it = assembler.settle()).converged)
    {
      if (rank == 0)
        std::printf("%2d  residual %.3e  closed %lld\n", it.number, it.residual,
                    static_cast<long long>(it.closed));
      assembler.residual(x, b.get());
      if (is_condensed)
        condensed.solve(b.get(), dx.get());
      else
      {
        assembler.jacobian(x, A.get());
        solver.set_operator(A.get());
        solver.solve(dx.get(), b.get());
      }
      VecScale(dx.get(), -1);
      assembler.update(dx.get(), assembler.limit(dx.get()));
    }
    assembler.accept();

    // Force on the whole sphere and largest pressure, against Hertz
    const double force = 4 * contact->force()[2];
    double most[2] = {0, 0};
    for (double p : contact->pressure())
      most[0] = std::max(most[0], p);
    for (double p : contact->multiplier())
      most[1] = std::max(most[1], p);
    MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    const double modulus = 1 / (2 * (1 - 0.3 * 0.3));
    const double radius = std::cbrt(3 * force / (4 * modulus));
    const double peak = 3 * force / (2 * std::numbers::pi * radius * radius);
    if (rank == 0)
      std::printf("iterations %d, force %.12g, largest pressure %.12g, "
                  "largest multiplier %.12g (Hertz %.4g)\n",
                  it.number, force, most[0], most[1], peak);
    if (rank == 0 and is_condensed)
      std::printf("Krylov iterations %d, direct solves %d\n",
                  condensed.iterations(), condensed.direct());
  }
  PetscFinalize();
  return 0;
}
