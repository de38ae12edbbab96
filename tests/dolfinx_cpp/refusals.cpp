// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// What the layer must refuse, on all ranks alike; prints what it did not.

#include "falling_block.h"
#include "sliding_block.h"
#include <basix/finite-element.h>
#include <contactx_dolfinx/checkpoint.h>
#include <contactx_dolfinx/dynamics.h>
#include <contactx_dolfinx/forms.h>
#include <contactx_dolfinx/obstacles.h>
#include <contactx_dolfinx/snes.h>
#include <contactx_dolfinx/vtk_output.h>
#include <cstdio>
#include <dolfinx.h>
#include <dolfinx/fem/Constant.h>
#include <dolfinx/mesh/generation.h>
#include <fstream>
#include <numeric>

using namespace dolfinx;
using T = PetscScalar;
using U = double;
namespace cx = contactx_dolfinx;
using Tags = mesh::MeshTags<std::int32_t>;

namespace
{
int failures = 0;

/// Whether all ranks refuse something with words of the message.
template <class F>
void refuses(const char* words, F&& work)
{
  int is_right = 0;
  std::string message = "nothing";
  try
  {
    work();
  }
  catch (const std::exception& error)
  {
    message = error.what();
    is_right = message.find(words) != std::string::npos;
  }
  MPI_Allreduce(MPI_IN_PLACE, &is_right, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (is_right)
    return;
  ++failures;
  if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
    std::printf("wanted \"%s\", but got \"%s\"\n", words, message.c_str());
}

std::shared_ptr<fem::FunctionSpace<U>>
space(const std::shared_ptr<mesh::Mesh<U>>& mesh, int degree,
      bool is_discontinuous = false)
{
  auto element = basix::create_element<U>(
      basix::element::family::P, basix::cell::type::quadrilateral, degree,
      basix::element::lagrange_variant::gll_warped,
      basix::element::dpc_variant::unset, is_discontinuous);
  return std::make_shared<fem::FunctionSpace<U>>(fem::create_functionspace<U>(
      mesh, std::make_shared<fem::FiniteElement<U>>(
                element, std::vector<std::size_t>{2})));
}

/// A unit square with the tags 11 (bottom), 12 (top) and 5 (all inner facets).
std::shared_ptr<const Tags> tags_of(const mesh::Mesh<U>& mesh)
{
  const auto topology = mesh.topology_mutable();
  topology->create_connectivity(1, 2);
  topology->create_connectivity(2, 1);
  topology->create_connectivity(1, 0);
  std::map<std::int32_t, std::int32_t> values;
  const auto map = topology->index_map(1);
  for (std::int32_t f = 0; f < map->size_local(); ++f)
    values[f] = 5;
  for (std::int32_t f : mesh::exterior_facet_indices(*topology))
    values.erase(f);
  for (auto [height, tag] : {std::pair{0.0, 11}, std::pair{1.0, 12}})
  {
    const auto facets = mesh::locate_entities_boundary(
        mesh, 1,
        [height](auto x)
        {
          std::vector<std::int8_t> is_there(x.extent(1));
          for (std::size_t i = 0; i < is_there.size(); ++i)
            is_there[i] = std::abs(x(1, i) - height) < 1e-12;
          return is_there;
        });
    for (std::int32_t f : facets)
      values[f] = tag;
  }
  std::vector<std::int32_t> facets, tags;
  for (auto [f, tag] : values)
  {
    facets.push_back(f);
    tags.push_back(tag);
  }
  return std::make_shared<const Tags>(mesh.topology(), 1, std::move(facets),
                                      std::move(tags));
}
} // namespace

int main(int argc, char* argv[])
{
  init_logging(argc, argv);
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  {
    auto square = [](mesh::GhostMode mode)
    {
      return std::make_shared<mesh::Mesh<U>>(
          mesh::create_rectangle<U>(MPI_COMM_WORLD, {{{0, 0}, {1, 1}}}, {4, 4},
                                    mesh::CellType::quadrilateral,
                                    mesh::create_cell_partitioner(mode, 2)));
    };
    const auto mesh = square(mesh::GhostMode::shared_facet);
    const auto tags = tags_of(*mesh);
    const auto V = space(mesh, 1);
    const auto u = std::make_shared<fem::Function<T>>(V);
    const auto load = std::make_shared<fem::Constant<T>>(std::vector<T>{0, 0});
    const auto F = std::make_shared<cx::Form>(fem::create_form<T>(
        *form_sliding_block_F, {V}, {{"u", u}}, {{"load", load}}, {}, {}));
    const auto J = std::make_shared<cx::Form>(fem::create_form<T>(
        *form_sliding_block_J, {V, V}, {{"u", u}}, {}, {}, {}));
    const auto plane_at = [](double height)
    {
      return std::make_shared<cx::Plane>(std::vector<double>{0, height},
                                         std::vector<double>{0, 1});
    };
    const cx::Surface bottom(tags, {11}), top(tags, {12});
    const auto fixed = std::make_shared<const fem::DirichletBC<T>>(
        std::vector<T>{0, 0},
        fem::locate_dofs_topological(*mesh->topology_mutable(), *V->dofmap(), 1,
                                     tags->find(12)),
        V);
    const auto make = [&](const cx::Surface& slave, cx::Contact::Master master,
                          cx::Options options = {})
    {
      return std::make_shared<cx::Contact>(slave, std::move(master), options);
    };
    const auto couple = [&](std::shared_ptr<cx::Contact> contact)
    {
      return cx::Assembler(F, J, u, {fixed},
                           contact
                               ? std::vector{contact}
                               : std::vector<std::shared_ptr<cx::Contact>>());
    };

    refuses("tag 7 is not", [&] { cx::Surface(tags, {11, 7}); });
    refuses("at least one tag", [&] { cx::Surface(tags, {}); });
    refuses("tied excludes friction",
            [&] { make(bottom, top, {.friction = 0.1, .tied = true}); });
    refuses("at least one contact", [&] { couple(nullptr); });
    refuses("inside a body",
            [&] { couple(make(cx::Surface(tags, {5}), plane_at(0))); });
    const auto other = square(mesh::GhostMode::none);
    refuses("another mesh", [&]
            { couple(make(cx::Surface(tags_of(*other), {11}), plane_at(0))); });
    refuses("at least 0",
            [&] { couple(make(bottom, plane_at(0), {.friction = -1})); });
    refuses("adjust is -1: give a finite length",
            [&] { couple(make(bottom, plane_at(0), {.adjust = -1})); });
    refuses(
        "but a tie keeps the gaps", [&]
        { couple(make(bottom, plane_at(0), {.tied = true, .adjust = 0.1})); });
    refuses("offset is not finite",
            [&] { couple(make(bottom, plane_at(0), {.offset = NAN})); });
    refuses("degree 1 or 2",
            [&]
            {
              const auto w = std::make_shared<fem::Function<T>>(space(mesh, 3));
              cx::Assembler(F, J, w, {}, {make(bottom, plane_at(0))});
            });
    const auto one = [&] { return std::vector{make(bottom, plane_at(0))}; };
    const std::vector<std::shared_ptr<const fem::DirichletBC<T>>> none;
    refuses("F is null", [&] { cx::Assembler(nullptr, J, u, none, one()); });
    refuses("J is null", [&] { cx::Assembler(F, nullptr, u, none, one()); });
    refuses("u is null", [&] { cx::Assembler(F, J, nullptr, none, one()); });
    refuses("F has 2 arguments", [&] { cx::Assembler(J, F, u, none, one()); });
    refuses("J has 1 arguments", [&] { cx::Assembler(F, F, u, none, one()); });
    refuses("bcs[1] is null",
            [&] { cx::Assembler(F, J, u, {fixed, nullptr}, one()); });
    refuses("contacts[0] is null",
            [&] { cx::Assembler(F, J, u, none, {nullptr}); });
    refuses("obstacle of a Contact is null",
            [&] { make(bottom, std::shared_ptr<cx::Plane>()); });
    // Forms of another function than the displacement, and of its space
    refuses("F does not depend on u",
            [&]
            {
              const auto w = std::make_shared<fem::Function<T>>(V);
              cx::Assembler(F, J, w, none, one());
            });
    const auto W = space(mesh, 1);
    refuses("F has an argument that is not of the function space of u",
            [&]
            {
              const auto w = std::make_shared<fem::Function<T>>(W);
              cx::Assembler(F, J, w, none, one());
            });
    refuses("bcs[0] is a condition on another function space",
            [&]
            {
              const auto other = std::make_shared<const fem::DirichletBC<T>>(
                  std::vector<T>{0, 0},
                  fem::locate_dofs_topological(*mesh->topology_mutable(),
                                               *W->dofmap(), 1, tags->find(12)),
                  W);
              cx::Assembler(F, J, u, {other}, one());
            });
    // Contact of a surface with itself has no integrals over facets
    refuses("but slave and master are the same surface",
            [&]
            {
              couple(make(bottom, bottom,
                          {.method = cx::Method::surface_to_surface}));
            });
    refuses("but slave and master are not the same surface",
            [&] { couple(make(bottom, top, {.excluded_distance = 0.1})); });
    refuses("inside the rigid obstacle",
            [&]
            {
              couple(make(top, std::make_shared<cx::Plane>(
                                   std::vector<double>{0, 0.99},
                                   std::vector<double>{0, -1})))
                  .begin_step();
            });

    const auto contact = make(bottom, plane_at(0));
    refuses("no results before", [&] { contact->force(); });
    refuses("has no friction", [&] { contact->set_friction(0.1); });
    cx::Assembler assembler(F, J, u, {fixed}, {contact});
    refuses("belongs to an Assembler already", [&] { couple(contact); });
    const cx::petsc::OwnVec b(assembler.create_vector());
    refuses("settle() before begin_step()", [&] { assembler.settle(); });
    refuses("residual() before begin_step()",
            [&] { assembler.residual(assembler.x(), b.get()); });
    assembler.begin_step();
    refuses("limit() before settle()", [&] { assembler.limit(b.get()); });
    refuses("accept() before settle()", [&] { assembler.accept(); });
    assembler.settle();
    cx::petsc::OwnVec shorter;
    VecCreateMPI(MPI_COMM_WORLD, 1, PETSC_DETERMINE, shorter.put());
    refuses("", [&] { assembler.residual(shorter.get(), b.get()); });
    {
      cx::Assembler pressed(F, J, u, {fixed}, {make(bottom, plane_at(0.01))});
      cx::petsc::Owner<SNES, SNESDestroy> snes;
      SNESCreate(MPI_COMM_WORLD, snes.put());
      SNESSetTolerances(snes.get(), 0, 1e-11, 0, 0, -1);
      cx::SNESLoop loop(pressed, snes.get());
      refuses("before begin_step()", [&] { loop.solve(); });
      pressed.begin_step();
      refuses("no convergence in 0 iterations", [&] { loop.solve(); });
      pressed.restore();
    }
    u->x()->array()[0] = NAN;
    refuses("not finite", [&] { assembler.begin_step(); });

    std::ranges::fill(u->x()->array(), 0);

    // Several fields
    const auto w = std::make_shared<fem::Function<T>>(V);
    const cx::Blocks two{{F, F}, {{J, nullptr}, {nullptr, J}}, {u, w}};
    const auto solves = [&](cx::Blocks blocks, auto&& change)
    {
      change(blocks);
      cx::Assembler(blocks, none, one());
    };
    refuses("functions[1] is there twice",
            [&] { solves(two, [&](auto& b) { b.functions[1] = u; }); });
    refuses("functions[1] is null",
            [&] { solves(two, [](auto& b) { b.functions[1] = nullptr; }); });
    refuses("displacement is 2: give a number from 0 to 1",
            [&] { solves(two, [](auto& b) { b.displacement = 2; }); });
    refuses("2 and 2 times 2",
            [&] { solves(two, [](auto& b) { b.F.pop_back(); }); });
    refuses("F[1] has an argument that is not of the function space of "
            "functions[1]",
            [&]
            {
              solves(
                  two, [&](auto& b)
                  { b.functions[1] = std::make_shared<fem::Function<T>>(W); });
            });
    refuses("functions[1] is on another mesh",
            [&]
            {
              solves(two,
                     [&](auto& b)
                     {
                       b.functions[1] = std::make_shared<fem::Function<T>>(
                           space(square(mesh::GhostMode::shared_facet), 1));
                     });
            });
    const auto with = [&](const std::shared_ptr<cx::Conductance>& conductance)
    {
      cx::Assembler(two, none, one(), cx::Assembler::Audit::refuse,
                    {conductance});
    };
    const contactx::law::Coefficient h(1.0);
    refuses("conductances[0] is null", [&] { with(nullptr); });
    refuses("conductances[0] is of another contact",
            [&]
            {
              with(std::make_shared<cx::Conductance>(make(bottom, plane_at(0)),
                                                     w, h, 1.0));
            });
    refuses("obstacle_value is missing",
            [&] { cx::Conductance(make(bottom, plane_at(0)), w, h); });
    for (const auto& [field, words] :
         {std::pair(u, "the field of conductances[0] is not solved for"),
          std::pair(w, "the field of a conductance is of another space")})
      refuses(words,
              [&]
              {
                const auto mine = make(bottom, plane_at(0));
                cx::Assembler(
                    two, none, {mine}, cx::Assembler::Audit::refuse,
                    {std::make_shared<cx::Conductance>(mine, field, h, 1.0)});
              });

    // Checkpoints
    cx::Checkpoint checkpoint(assembler);
    refuses("there is no checkpoint nowhere.state",
            [&] { checkpoint.read("nowhere.state"); });
    refuses("history[0] is null",
            [&] { cx::Checkpoint(assembler, {nullptr}); });
    if (dolfinx::MPI::size(MPI_COMM_WORLD) > 1)
      refuses("whose dofs change their order from rank to rank",
              [&]
              {
                cx::Checkpoint(assembler, {std::make_shared<fem::Function<T>>(
                                              space(mesh, 3))});
              });
    refuses("cannot write the checkpoint .: ", [&] { checkpoint.write("."); });
    checkpoint.write("refusals.state");
    cx::StepPlan plan(cx::StepPlan::equal(2));
    refuses("it has no load steps",
            [&] { checkpoint.read("refusals.state", &plan); });
    {
      cx::Assembler other(
          F, J, u, none,
          {make(bottom, plane_at(0), {.sliding = cx::Sliding::small})});
      refuses("'contact 0: identity' is another one here",
              [&] { cx::Checkpoint(other).read("refusals.state"); });
    }
    {
      cx::Assembler other(F, J, u, none,
                          {make(bottom, plane_at(0), {.friction = 0.1})});
      refuses("has 1 values of type f8 a row in the file, but 2 of type f8",
              [&] { cx::Checkpoint(other).read("refusals.state"); });
    }
    {
      cx::Assembler other(F, J, u, none, {make(top, plane_at(0))});
      refuses("has other nodes or cells in the file",
              [&] { cx::Checkpoint(other).read("refusals.state"); });
    }
    {
      cx::Assembler other(F, J, u, none,
                          {make(bottom, plane_at(0)), make(top, plane_at(-1))});
      refuses("'contact 1: identity' is missing in the file",
              [&] { cx::Checkpoint(other).read("refusals.state"); });
    }
    checkpoint.read("refusals.state");
    if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
      std::ofstream("older.h5") << "\x89HDF";
    refuses("it is of an older contactx for C++",
            [&] { checkpoint.read("older.h5"); });
    {
      // Values in cells of a mesh that was made of another one
      std::vector<std::int32_t> cells(
          mesh->topology()->index_map(2)->size_local());
      std::iota(cells.begin(), cells.end(), 0);
      const auto part = std::make_shared<dolfinx::mesh::Mesh<U>>(
          std::get<0>(dolfinx::mesh::create_submesh(*mesh, 2, cells)));
      const auto f = std::make_shared<fem::Function<T>>(space(part, 1, true));
      std::ranges::fill(f->x()->array(), 3);
      cx::Checkpoint own(assembler, {f});
      own.write("submesh.state");
      std::ranges::fill(f->x()->array(), 0);
      own.read("submesh.state");
      if (std::ranges::any_of(f->x()->array(), [](T v) { return v != 3; }))
      {
        ++failures;
        std::printf("a function of a submesh was not read\n");
      }
    }
    std::ranges::fill(u->x()->array(), NAN);
    checkpoint.write("refusals.state");
    std::ranges::fill(u->x()->array(), 0);
    refuses("'u' is not finite at", [&] { checkpoint.read("refusals.state"); });

    // Forms
    refuses("a contact has no results before",
            [&] { make(bottom, plane_at(0))->forms(); });
    {
      cx::Assembler assembler(F, J, u, none, {make(bottom, plane_at(0))});
      refuses("J must be a bilinear form", [&] { cx::Forms(assembler, F); });
      refuses("J must be a bilinear form",
              [&] { cx::Forms(assembler, nullptr); });
      cx::Forms forms(assembler, J);
      cx::petsc::OwnMat other(assembler.create_matrix());
      refuses("residual() before begin_step()",
              [&] { forms.assemble_vector(assembler.x()); });
      assembler.begin_step();
      forms.settle(assembler.x());
      refuses("A is not the matrix of the pairs of now",
              [&] { forms.assemble_matrix(other.get()); });
    }

    // Time steps
    const auto start = std::make_shared<fem::Function<T>>(V),
               velocity = std::make_shared<fem::Function<T>>(V);
    const auto dt = std::make_shared<fem::Constant<T>>(1.0);
    const auto weight
        = std::make_shared<fem::Constant<T>>(std::vector<T>{0, 0});
    const auto moving = std::make_shared<fem::Function<T>>(V);
    const auto form = [&](ufcx_form& given, int rank)
    {
      return std::make_shared<fem::Form<T>>(fem::create_form<T, U>(
          given,
          std::vector<std::shared_ptr<const fem::FunctionSpace<U>>>(rank, V),
          {{"u", moving}, {"start", start}, {"velocity", velocity}},
          {{"dt", dt}, {"weight", weight}}, {}, {}, mesh));
    };
    const cx::DynamicForms forms{.F = form(*form_falling_block_F, 1),
                                 .J = form(*form_falling_block_J, 2),
                                 .mass = form(*form_falling_block_mass, 2)};
    const auto dynamics
        = [&](const cx::DynamicForms& given, const cx::Motion& motion)
    {
      return std::make_unique<cx::Dynamics>(
          given, motion, none, std::vector{make(bottom, plane_at(0))});
    };
    const cx::Motion motion{moving, start, velocity, dt};
    refuses("start is null",
            [&] { dynamics(forms, {moving, nullptr, velocity, dt}); });
    refuses("velocity is null, u itself",
            [&] { dynamics(forms, {moving, start, moving, dt}); });
    refuses("dt is null or no number",
            [&] { dynamics(forms, {moving, start, velocity, weight}); });
    refuses("F does not depend on start and velocity",
            [&]
            {
              const auto other = std::make_shared<fem::Function<T>>(V);
              dynamics(forms, {moving, start, other, dt});
            });
    refuses("mass has 1 arguments, but must have 2",
            [&] { dynamics({forms.F, forms.J, forms.F}, motion); });
    const auto falling = dynamics(forms, motion);
    cx::petsc::Owner<KSP, KSPDestroy> ksp;
    KSPCreate(MPI_COMM_WORLD, ksp.put());
    cx::KSPSolver solver(falling->assembler(), ksp.get());
    refuses("dt is 0: give a finite time above 0",
            [&] { falling->step(0, solver); });
    velocity->x()->array()[0] = NAN;
    refuses("velocity is not finite", [&] { falling->step(1, solver); });

    refuses("the path of VTKOutput is run.xdmf: give a name that ends in .pvd",
            [] { cx::VTKOutput(MPI_COMM_WORLD, "run.xdmf"); });
  }
  if (failures == 0 and dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
    std::printf("all refused\n");
  PetscFinalize();
  return failures;
}
