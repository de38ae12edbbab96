// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// Each kind of contact on the mesh of demos/cpp/sliding_block: prints what
// variants.py prints, in the same digits on any number of ranks.

#include "neo_hooke.h"
#include "prestress.h"
#include "sliding_block.h"
#include <basix/finite-element.h>
#include <contactx/obstacle/plane.h>
#include <contactx/obstacle/sphere.h>
#include <contactx_dolfinx/condensed.h>
#include <cstdio>
#include <dolfinx.h>
#include <dolfinx/fem/Constant.h>
#include <dolfinx/io/XDMFFile.h>

using namespace dolfinx;
using T = PetscScalar;
using U = double;
namespace cx = contactx::dolfinx;
namespace obstacle = contactx::obstacle;

namespace
{
struct Scene
{
  std::shared_ptr<mesh::Mesh<U>> mesh;
  std::shared_ptr<const mesh::MeshTags<std::int32_t>> tags;
  std::shared_ptr<fem::FunctionSpace<U>> V;
  std::shared_ptr<fem::Constant<T>> load;
  KSP ksp;
  bool condensed = false;
};

double sum(double mine)
{
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return mine;
}

double squares(std::span<const double> values)
{
  double s = 0;
  for (double v : values)
    s += v * v;
  return std::sqrt(sum(s));
}

/// A residual with the load on the block.
std::shared_ptr<fem::Form<T>>
residual_form(const Scene& scene, ufcx_form& form,
              const std::shared_ptr<fem::Function<T>>& u,
              std::map<std::string, std::shared_ptr<fem::Constant<T>>> constants
              = {})
{
  constants["load"] = scene.load;
  const auto top = fem::compute_integration_domains(
      fem::IntegralType::exterior_facet, *scene.mesh->topology(),
      scene.tags->find(12));
  return std::make_shared<fem::Form<T>>(fem::create_form<T>(
      form, {scene.V}, {{"u", u}}, {constants.begin(), constants.end()},
      {{fem::IntegralType::exterior_facet, {{12, top}}}}, {}));
}

/// The block's support, and the value that pushes it.
struct Support
{
  std::vector<std::shared_ptr<const fem::DirichletBC<T>>> bcs;
  std::shared_ptr<fem::Constant<T>> push;
};

Support support(const Scene& scene)
{
  Support made;
  const auto fix = [&](int component, int face)
  {
    auto value = std::make_shared<fem::Constant<T>>(0.0);
    auto Vi
        = std::make_shared<fem::FunctionSpace<U>>(scene.V->sub({component}));
    made.bcs.push_back(std::make_shared<const fem::DirichletBC<T>>(
        std::shared_ptr<const fem::Constant<T>>(value),
        fem::locate_dofs_topological(*scene.mesh->topology_mutable(),
                                     *Vi->dofmap(), 1, scene.tags->find(face)),
        Vi));
    return value;
  };
  fix(0, 22);
  fix(1, 22);
  made.push = fix(0, 12);
  return made;
}

/// Two steps with forces that cancel: what the residual was compared with.
void tolerances(const Scene& scene, const char* name, double size,
                const cx::Options& options)
{
  auto u = std::make_shared<fem::Function<T>>(scene.V);
  const std::map<std::string, std::shared_ptr<fem::Constant<T>>> constants{
      {"growth", std::make_shared<fem::Constant<T>>(1e-3)},
      {"prestress", std::make_shared<fem::Constant<T>>(
                        std::vector<T>{2 * size, size, size, 3 * size},
                        std::vector<std::size_t>{2, 2})}};
  const auto F = residual_form(scene, *form_prestress_F, u, constants);
  const auto J = std::make_shared<fem::Form<T>>(
      fem::create_form<T>(*form_prestress_J, {scene.V, scene.V}, {{"u", u}},
                          {constants.begin(), constants.end()}, {}, {}));
  const auto contact = std::make_shared<cx::Contact>(
      cx::Surface(scene.tags, {11}), cx::Surface(scene.tags, {21}), options);
  cx::Assembler assembler(F, J, u, support(scene).bcs, {contact});
  cx::petsc::OwnVec b(assembler.create_vector()), dx(assembler.create_vector());
  cx::petsc::OwnMat A(assembler.create_matrix());
  KSPReset(scene.ksp);
  for (int step = 0; step < 2; ++step)
  {
    assembler.begin_step();
    cx::Settled it;
    while (not(it = assembler.settle()).converged)
    {
      assembler.F(assembler.x(), b.get());
      assembler.J(assembler.x(), A.get());
      KSPSetOperators(scene.ksp, A.get(), A.get());
      KSPSolve(scene.ksp, b.get(), dx.get());
      VecScale(dx.get(), -1);
      assembler.update(dx.get(), assembler.limit(dx.get()));
    }
    assembler.accept();
    if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
      std::printf("%s %d %.6e\n", name, it.number, it.tolerance);
  }
}

void solve(const Scene& scene, const char* name, const cx::Contact::Master& to,
           const cx::Options& options,
           ufcx_form* residual = form_sliding_block_F,
           ufcx_form* jacobian = form_sliding_block_J)
{
  const auto& [mesh, tags, V, load, ksp, is_condensed] = scene;
  auto u = std::make_shared<fem::Function<T>>(V);
  const auto F = residual_form(scene, *residual, u);
  auto J = std::make_shared<fem::Form<T>>(
      fem::create_form<T>(*jacobian, {V, V}, {{"u", u}}, {}, {}, {}));
  const auto [bcs, push] = support(scene);
  const auto slave = std::string(name) == "self" ? std::get<cx::Surface>(to)
                                                 : cx::Surface(tags, {11});
  auto contact = std::make_shared<cx::Contact>(slave, to, options);
  cx::Assembler assembler(F, J, u, bcs, {contact});
  cx::petsc::OwnVec b(assembler.create_vector()), dx(assembler.create_vector());
  cx::petsc::OwnMat A(assembler.create_matrix());
  cx::Condensed condensed(assembler, "condensed_");
  auto iterate = [&]
  {
    assembler.F(assembler.x(), b.get());
    if (scene.condensed)
      condensed.solve(b.get(), dx.get());
    else
    {
      assembler.J(assembler.x(), A.get());
      KSPSetOperators(ksp, A.get(), A.get());
      KSPSolve(ksp, b.get(), dx.get());
    }
    VecScale(dx.get(), -1);
    assembler.update(dx.get(), assembler.limit(dx.get()));
  };
  // Sizes are others than those of the contact before
  KSPReset(ksp);
  for (double way : {0.0, 0.03, -0.02})
  {
    // A step too far, which is given up, leaves no trace
    push->value[0] = 5 * way;
    assembler.begin_step();
    for (int k = 0; k < 2 and not assembler.settle().converged; ++k)
      iterate();
    assembler.restore();

    push->value[0] = way;
    assembler.begin_step();
    cx::Settled it;
    while (not(it = assembler.settle()).converged)
      iterate();
    assembler.accept();
    const auto force = contact->force();
    const std::span<const double> all = u->x()->array();
    const double norms[3]
        = {squares(all.first(2 * V->dofmap()->index_map->size_local())),
           squares(contact->multiplier()), squares(contact->pressure())};
    if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
    {
      // Iterations go with how accurate Krylov solvers are
      std::printf("%s %s", name,
                  is_condensed ? "condensed"
                               : std::to_string(it.number).c_str());
      for (double f : {force[0], force[1], norms[0], norms[1], norms[2]})
        // Rounding has a sign
        std::printf(" %.9f", std::abs(f) < 5e-10 ? 0.0 : f);
      std::printf("\n");
    }
  }
  // What needed the direct solver, and whether multigrid did the rest
  const bool expected = condensed.direct() == 0 and condensed.iterations() > 0;
  if (scene.condensed and not expected
      and dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
    std::printf("%s: %d direct solves, %d Krylov iterations\n", name,
                condensed.direct(), condensed.iterations());
}
} // namespace

int main(int argc, char* argv[])
{
  init_logging(argc, argv);
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  {
    Scene scene;
    io::XDMFFile file(MPI_COMM_WORLD, "sliding_block.xdmf", "r");
    const fem::CoordinateElement<U> cell(mesh::CellType::quadrilateral, 1);
    scene.mesh = std::make_shared<mesh::Mesh<U>>(
        file.read_mesh(cell, mesh::GhostMode::shared_facet, "mesh"));
    const auto topology = scene.mesh->topology_mutable();
    topology->create_entities(1);
    topology->create_connectivity(1, 2);
    topology->create_connectivity(2, 1);
    scene.tags = std::make_shared<const mesh::MeshTags<std::int32_t>>(
        file.read_meshtags(*scene.mesh, "facet_tags", std::nullopt));
    auto element = basix::create_element<U>(
        basix::element::family::P, basix::cell::type::quadrilateral, 1,
        basix::element::lagrange_variant::unset,
        basix::element::dpc_variant::unset, false);
    scene.V
        = std::make_shared<fem::FunctionSpace<U>>(fem::create_functionspace<U>(
            scene.mesh, std::make_shared<fem::FiniteElement<U>>(
                            element, std::vector<std::size_t>{2})));
    scene.load = std::make_shared<fem::Constant<T>>(std::vector<T>{0, -0.01});
    cx::petsc::Owner<KSP, KSPDestroy> ksp;
    KSPCreate(MPI_COMM_WORLD, ksp.put());
    scene.ksp = ksp.get();
    KSPSetType(scene.ksp, KSPPREONLY);
    PC pc;
    KSPGetPC(scene.ksp, &pc);
    PCSetType(pc, PCLU);
    PCFactorSetMatSolverType(pc, MATSOLVERMUMPS);

    const cx::Surface base(scene.tags, {21});
    const auto mortar = cx::Method::surface_to_surface;
    const auto small = cx::Sliding::small;
    const double offset = 1e-8;
    solve(scene, "frictionless", base, {.offset = offset});
    solve(scene, "friction", base, {.friction = 0.3, .offset = offset});
    solve(scene, "small", base,
          {.friction = 0.3, .sliding = small, .offset = offset});
    solve(scene, "tied", base, {.tied = true});
    solve(scene, "mortar", base, {.method = mortar, .offset = offset});
    solve(scene, "mortar friction", base,
          {.friction = 0.3, .method = mortar, .offset = offset});
    solve(scene, "mortar tied", base, {.method = mortar, .tied = true});
    // Lower and upper side at once, and what is beside them on their facets
    solve(scene, "self", cx::Surface(scene.tags, {11, 21}),
          {.friction = 0.3, .offset = offset, .excluded_distance = 0.01});
    const std::vector<double> point{0, 0}, up{0, 1}, middle{1.5, -4};
    solve(scene, "plane", std::make_shared<obstacle::Plane>(point, up),
          {.friction = 0.3, .offset = offset});
    solve(scene, "mortar plane", std::make_shared<obstacle::Plane>(point, up),
          {.friction = 0.3, .method = mortar, .offset = offset});
    solve(scene, "disc", std::make_shared<obstacle::Sphere>(middle, 4.0),
          {.friction = 0.1, .offset = offset});
    solve(scene, "adjusted disc",
          std::make_shared<obstacle::Sphere>(middle, 4.0),
          {.friction = 0.1, .offset = offset, .adjust = 0.1});
    solve(scene, "smooth", base,
          {.friction = 0.3, .offset = offset, .smooth = true});
    solve(scene, "neo-Hooke", base, {.friction = 0.3, .offset = offset},
          form_neo_hooke_F, form_neo_hooke_J);
    const auto weight = [](const auto& x) { return 1 + x[0] / 2; };
    solve(scene, "weight", base, {.offset = offset, .weight = weight});
    solve(scene, "mortar weight", base,
          {.method = mortar, .offset = offset, .weight = weight});

    tolerances(scene, "prestress", 1e3, {.offset = offset});
    tolerances(scene, "mortar prestress", 1e3,
               {.method = mortar, .offset = offset});
    tolerances(scene, "growth", 0, {.offset = offset});

    scene.condensed = true;
    solve(scene, "frictionless", base, {.offset = offset});
    solve(scene, "friction", base, {.friction = 0.3, .offset = offset});
    solve(scene, "mortar", base, {.method = mortar, .offset = offset});
    solve(scene, "plane", std::make_shared<obstacle::Plane>(point, up),
          {.friction = 0.3, .offset = offset});
    solve(scene, "tied", base, {.tied = true});
    solve(scene, "neo-Hooke", base, {.friction = 0.3, .offset = offset},
          form_neo_hooke_F, form_neo_hooke_J);
  }
  PetscFinalize();
  return 0;
}
