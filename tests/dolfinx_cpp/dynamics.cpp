// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// A block that falls on a plane and on another block: prints what dynamics.py
// prints, in the same digits on any number of ranks.

#include "falling_block.h"
#include "scenes.h"
#include <contactx_dolfinx/dynamics.h>
#include <contactx_dolfinx/obstacles.h>

using namespace dolfinx;
using T = PetscScalar;
using U = double;
namespace cx = contactx_dolfinx;

namespace
{
constexpr double gap = 0.0135, dt = 0.01;
constexpr int steps = 20;

struct Scene : scenes::Domain
{
  std::shared_ptr<fem::FunctionSpace<U>> V;
  KSP ksp;
};

Scene read()
{
  const auto cell = mesh::CellType::quadrilateral;
  Scene scene{scenes::read("falling_block.xdmf", cell), nullptr, nullptr};
  scene.V = scenes::space(scene, scenes::lagrange(cell, 1, 2));
  return scene;
}

/// A problem at its start.
struct Falling
{
  Falling(const Scene& scene, const cx::Contact::Master& to,
          const cx::Options& options = {}, bool is_consistent = false,
          std::optional<double> impact_travel = std::nullopt)
      : u(std::make_shared<fem::Function<T>>(scene.V)),
        start(std::make_shared<fem::Function<T>>(scene.V)),
        velocity(std::make_shared<fem::Function<T>>(scene.V)),
        length(std::make_shared<fem::Constant<T>>(1.0)),
        weight(std::make_shared<fem::Constant<T>>(std::vector<T>{0, -1}))
  {
    const auto form = [&](ufcx_form& given, int rank)
    {
      // Each form takes those that it has
      return std::make_shared<fem::Form<T>>(fem::create_form<T, U>(
          given,
          std::vector(rank,
                      std::shared_ptr<const fem::FunctionSpace<U>>(scene.V)),
          {{"u", u}, {"start", start}, {"velocity", velocity}},
          {{"dt", length}, {"weight", weight}}, {}, {}, scene.mesh));
    };
    std::vector<std::shared_ptr<const fem::DirichletBC<T>>> bcs;
    for (int component = 0; component < 2; ++component)
    {
      auto Vi
          = std::make_shared<fem::FunctionSpace<U>>(scene.V->sub({component}));
      bcs.push_back(std::make_shared<const fem::DirichletBC<T>>(
          std::make_shared<const fem::Constant<T>>(0.0),
          fem::locate_dofs_topological(*scene.mesh->topology_mutable(),
                                       *Vi->dofmap(), 1, scene.tags->find(22)),
          Vi));
    }
    velocity->interpolate(
        [](auto x) -> std::pair<std::vector<T>, std::vector<std::size_t>>
        {
          const std::size_t n = x.extent(1);
          std::vector<T> values(2 * n, 0);
          for (std::size_t p = 0; p < n; ++p)
            if (x(1, p) > gap / 2)
            {
              values[p] = 0.3;
              values[n + p] = -1 - 0.2 * x(0, p);
            }
          return {values, {2, n}};
        });
    KSPReset(scene.ksp);
    cx::DynamicForms forms{
        .F = form(is_consistent ? *form_falling_block_F_consistent
                                : *form_falling_block_F,
                  1),
        .J = form(is_consistent ? *form_falling_block_J_consistent
                                : *form_falling_block_J,
                  2),
        .mass = form(is_consistent ? *form_falling_block_consistent_mass
                                   : *form_falling_block_mass,
                     2),
        .loads = form(*form_falling_block_loads, 1),
        .strain_energy = form(*form_falling_block_strain_energy, 0)};
    dynamics.emplace(forms, cx::Motion{u, start, velocity, length}, bcs,
                     std::vector{std::make_shared<cx::Contact>(
                         cx::Surface(scene.tags, {11}), to, options)},
                     impact_travel);
    solver.emplace(dynamics->assembler(), scene.ksp);
  }

  /// What the balance of the step has.
  void print_balance(std::vector<double> figures = {})
  {
    const cx::Balance balance = dynamics->balance();
    for (const double impulse : balance.impulse.front())
      figures.push_back(impulse / balance.dt);
    figures.insert(figures.end(), {balance.kinetic, *balance.strain});
    figures.insert(figures.end(), balance.momentum.begin(),
                   balance.momentum.end());
    figures.insert(figures.end(),
                   {balance.angular_momentum.front(), balance.work_of_loads,
                    balance.work_of_supports, balance.contact_loss});
    scenes::print(scenes::text_of(figures));
  }

  std::shared_ptr<fem::Function<T>> u, start, velocity;
  std::shared_ptr<fem::Constant<T>> length, weight;
  std::optional<cx::Dynamics> dynamics;
  std::optional<cx::KSPSolver> solver;
};

void fall(const char* name, Falling&& falling)
{
  scenes::print(name);
  for (int step = 0; step < steps; ++step)
  {
    falling.dynamics->step(dt, *falling.solver);
    falling.print_balance();
  }
}
} // namespace

int main(int argc, char* argv[])
{
  init_logging(argc, argv);
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  {
    Scene scene = read();
    cx::petsc::Owner<KSP, KSPDestroy> ksp;
    KSPCreate(MPI_COMM_WORLD, ksp.put());
    scene.ksp = ksp.get();
    cx::petsc::set_lu(scene.ksp);

    const auto plane = std::make_shared<cx::Plane>(std::vector<double>{0, 0},
                                                   std::vector<double>{0, 1});
    fall("plane", {scene, plane});
    fall("plane, friction, consistent",
         {scene, plane, {.friction = 0.2}, true});
    fall("block, friction",
         {scene, cx::Surface(scene.tags, {21}), {.friction = 0.2}});

    scenes::print("steps that are short at the impact");
    Falling falling(scene, plane, {}, false, 0.02);
    cx::Dynamics& dynamics = *falling.dynamics;
    try
    {
      dynamics.step(2 * dt, *falling.solver);
    }
    catch (const cx::ConvergenceError& error)
    {
      const std::string text = error.what();
      scenes::print(text.substr(0, text.find(". ")));
    }
    // As it was before
    scenes::print(scenes::text_of(
        {dynamics.kinetic_energy(), *dynamics.strain_energy()}));
    cx::StepPlan plan(cx::StepPlan::equal(4, 8 * dt), 8);
    while (not plan.finished())
    {
      dynamics.advance(plan, [](double) {}, *falling.solver);
      falling.print_balance({plan.t()});
    }
  }
  PetscFinalize();
  return 0;
}
