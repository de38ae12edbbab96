// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// Contact where a displacement is solved for together with other fields, on the
// mesh of demos/cpp/sliding_block: prints what fields.py prints, in the same
// digits on any number of ranks.

#include "scenes.h"
#include "several_fields.h"
#include <contactx_dolfinx/checkpoint.h>
#include <contactx_dolfinx/condensed.h>
#include <contactx_dolfinx/obstacles.h>

using namespace dolfinx;
using T = PetscScalar;
using U = double;
namespace cx = contactx_dolfinx;

namespace
{
using Space = std::shared_ptr<const fem::FunctionSpace<U>>;
using scenes::Element;
using Function = std::shared_ptr<fem::Function<T>>;
using Conditions = std::vector<std::shared_ptr<const fem::DirichletBC<T>>>;

struct Scene : scenes::Domain
{
  std::shared_ptr<fem::Constant<T>> load
      = std::make_shared<fem::Constant<T>>(std::vector<T>{0, -0.01});
  KSP ksp = nullptr;

  Space space(const Element& element) const
  {
    return scenes::space(*this, element);
  }

  static Space part(const Space& V, int k)
  {
    return std::make_shared<const fem::FunctionSpace<U>>(V->sub({k}));
  }

  /// A form whose functions are known by their names.
  std::shared_ptr<const fem::Form<T>>
  form(ufcx_form& given, const std::vector<Space>& spaces,
       const std::vector<std::pair<std::string, Function>>& functions) const
  {
    std::map<std::string, std::shared_ptr<const fem::Function<T>>> in(
        functions.begin(), functions.end());
    const auto top = fem::compute_integration_domains(
        fem::IntegralType::exterior_facet, *mesh->topology(), tags->find(12));
    return std::make_shared<fem::Form<T>>(fem::create_form<T, U>(
        given, spaces, in, {{"load", load}},
        {{fem::IntegralType::exterior_facet, {{12, top}}}}, {}, mesh));
  }

  std::shared_ptr<fem::Constant<T>> fix(Conditions& bcs, const Space& V,
                                        int face, double value) const
  {
    auto constant = std::make_shared<fem::Constant<T>>(value);
    bcs.push_back(std::make_shared<const fem::DirichletBC<T>>(
        std::shared_ptr<const fem::Constant<T>>(constant),
        fem::locate_dofs_topological(*mesh->topology_mutable(), *V->dofmap(), 1,
                                     tags->find(face)),
        V));
    return constant;
  }

  /// The base held, and the top pushed along.
  std::shared_ptr<fem::Constant<T>> support(Conditions& bcs,
                                            const Space& V) const
  {
    fix(bcs, part(V, 0), 22, 0);
    fix(bcs, part(V, 1), 22, 0);
    return fix(bcs, part(V, 0), 12, 0);
  }
};

Element lagrange(int degree, std::optional<std::size_t> components = {})
{
  return scenes::lagrange(mesh::CellType::quadrilateral, degree, components);
}

/// What is at the end of a step.
std::vector<double> figures(const cx::Contact& contact,
                            const std::vector<Function>& functions,
                            const std::shared_ptr<cx::Conductance>& conductance)
{
  const auto force = contact.force();
  std::vector<double> values(force.begin(), force.begin() + 2);
  for (const auto& f : functions)
    values.push_back(scenes::norm(f));
  values.insert(values.end(),
                {scenes::norm(contact.multiplier()),
                 scenes::norm(contact.pressure()), scenes::norm(contact.gap()),
                 conductance ? conductance->flow() : 0.0});
  return values;
}

/// Whether figures are the same but for a part of 1 or of themselves: by
/// default the order of sums, as compare.py has it.
bool same(const std::vector<double>& one, const std::vector<double>& other,
          double part = 1e-10)
{
  return std::ranges::equal(
      one, other, [part](double a, double b)
      { return std::abs(a - b) <= part * std::max(1.0, std::abs(a)); });
}

/// Three steps and their figures. From what was saved before the last one, on
/// whatever number of ranks, that is taken again by another Assembler, and once
/// more by the condensed solver, which knows no conductances. The file of four
/// ranks is fields.py's.
void steps(const Scene& scene, const std::string& name,
           const cx::Blocks& blocks, const Conditions& bcs,
           const std::shared_ptr<fem::Constant<T>>& push,
           const std::shared_ptr<cx::Contact>& contact,
           const std::vector<Function>& functions,
           const std::shared_ptr<cx::Conductance>& conductance = nullptr)
{
  std::vector<std::shared_ptr<cx::Conductance>> conductances;
  if (conductance)
    conductances.push_back(conductance);
  // Of cells
  const auto history = std::make_shared<fem::Function<T>>(scene.space(
      std::make_shared<const fem::FiniteElement<U>>(basix::create_element<U>(
          basix::element::family::P, basix::cell::type::quadrilateral, 0,
          basix::element::lagrange_variant::unset,
          basix::element::dpc_variant::unset, true))));
  history->interpolate(
      [](auto x) -> std::pair<std::vector<T>, std::vector<std::size_t>>
      {
        std::vector<T> values(x.extent(1));
        for (std::size_t p = 0; p < values.size(); ++p)
          values[p] = x(0, p) + 10 * x(1, p);
        return {values, {values.size()}};
      });
  const std::vector<T> kept = history->x()->array();
  const int size = dolfinx::MPI::size(MPI_COMM_WORLD);
  const auto file = [&name](int ranks)
  { return name + "." + std::to_string(ranks) + ".state"; };
  cx::StepPlan plan({0.5, 0.75, 1});
  std::vector<double> last;
  int iterations = 0;
  // Sizes are others than those of the contact before
  KSPReset(scene.ksp);
  {
    cx::Assembler assembler(blocks, bcs, {contact},
                            cx::Assembler::Audit::refuse, conductances);
    cx::Checkpoint checkpoint(assembler, {history});
    cx::KSPSolver solver(assembler, scene.ksp);
    for (const double way : {0.0, 0.01, -0.01})
    {
      if (way < 0)
        checkpoint.write(file(size), &plan);
      push->value[0] = way;
      assembler.solve(solver);
      plan.accept(assembler.number());
      last = figures(*contact, functions, conductance);
      iterations = assembler.number();
      scenes::print(name + " " + std::to_string(iterations) + " "
                    + scenes::text_of(last));
    }
  }
  for (int ranks = 1; ranks <= 4; ++ranks)
  {
    if (not std::filesystem::exists(file(ranks)))
      continue;
    for (const auto& f : functions)
      std::ranges::fill(f->x()->array(), 0);
    std::ranges::fill(history->x()->array(), 0);
    cx::Assembler assembler(blocks, bcs, {contact},
                            cx::Assembler::Audit::refuse, conductances);
    cx::StepPlan place({0.5, 0.75, 1});
    cx::Checkpoint(assembler, {history}).read(file(ranks), &place);
    KSPReset(scene.ksp);
    cx::KSPSolver solver(assembler, scene.ksp);
    assembler.solve(solver);
    place.accept(assembler.number());
    const std::vector<double> again = figures(*contact, functions, conductance);
    const std::string from = "from " + std::to_string(ranks) + " ranks: ";
    if (not same(again, last) or assembler.number() != iterations)
      scenes::print(from + std::to_string(assembler.number()) + " "
                    + scenes::text_of(again));
    if (history->x()->array() != kept or place != plan)
      std::printf("%sanother history or plan\n", from.c_str());
    if (conductance)
    {
      try
      {
        cx::Condensed(assembler, "condensed_");
        std::printf("%scondensed in spite of a conductance\n", from.c_str());
      }
      catch (const std::invalid_argument&)
      {
      }
      continue;
    }
    cx::Checkpoint(assembler, {history}).read(file(ranks), &place);
    cx::Condensed condensed(assembler, "condensed_");
    assembler.solve(condensed);
    const std::vector<double> split = figures(*contact, functions, conductance);
    if (not same(split, last, 1e-8) or condensed.direct() > 0
        or condensed.iterations() == 0)
      scenes::print("condensed, " + from + std::to_string(condensed.direct())
                    + " direct " + scenes::text_of(split));
  }
}

/// A nearly incompressible solid with its pressure, in one space and in two.
void incompressible(const Scene& scene, const std::string& name,
                    cx::Options options)
{
  options.offset = 1e-8;
  const cx::Surface slave(scene.tags, {11}), base(scene.tags, {21});
  const Element vectors = lagrange(2, 2), numbers = lagrange(1);
  {
    const Space W = scene.space(std::make_shared<const fem::FiniteElement<U>>(
        std::vector<Element>{vectors, numbers}));
    const auto w = std::make_shared<fem::Function<T>>(W);
    Conditions bcs;
    const auto push = scene.support(bcs, Scene::part(W, 0));
    steps(scene, "mixed " + name,
          {{scene.form(*form_several_fields_F, {W}, {{"w", w}})},
           {{scene.form(*form_several_fields_J, {W, W}, {})}},
           {w},
           0},
          bcs, push, std::make_shared<cx::Contact>(slave, base, options), {w});
  }
  const Space V = scene.space(vectors), Q = scene.space(numbers);
  const auto u = std::make_shared<fem::Function<T>>(V),
             p = std::make_shared<fem::Function<T>>(Q);
  const std::vector<std::pair<std::string, Function>> in{{"u", u}, {"p", p}};
  Conditions bcs;
  const auto push = scene.support(bcs, V);
  steps(scene, "blocks " + name,
        {{scene.form(*form_several_fields_F_p, {Q}, in),
          scene.form(*form_several_fields_F_u, {V}, in)},
         {{scene.form(*form_several_fields_J_pp, {Q, Q}, {}),
           scene.form(*form_several_fields_J_pu, {Q, V}, {})},
          {scene.form(*form_several_fields_J_up, {V, Q}, {}),
           scene.form(*form_several_fields_J_uu, {V, V}, {})}},
         {p, u},
         1},
        bcs, push, std::make_shared<cx::Contact>(slave, base, options), {u, p});
}

/// A solid that warmth makes larger, and heat that flows across the contact.
void warm(const Scene& scene, const std::string& name,
          const cx::Contact::Master& master, std::optional<double> obstacle,
          cx::Options options)
{
  options.offset = 1e-8;
  const Space V = scene.space(lagrange(1, 2)), Q = scene.space(lagrange(1));
  const auto u = std::make_shared<fem::Function<T>>(V),
             warmth = std::make_shared<fem::Function<T>>(Q);
  const std::vector<std::pair<std::string, Function>> in{{"moved", u},
                                                         {"warm", warmth}};
  Conditions bcs;
  scene.fix(bcs, Q, 12, 1);
  scene.fix(bcs, Q, 22, 0);
  const auto push = scene.support(bcs, V);
  const auto contact = std::make_shared<cx::Contact>(
      cx::Surface(scene.tags, {11}), master, options);
  const auto conductance = std::make_shared<cx::Conductance>(
      contact, warmth,
      contactx::law::Coefficient(
          [](std::span<const double> p, std::span<const double> g)
          {
            std::vector<double> h(p.size());
            for (std::size_t i = 0; i < h.size(); ++i)
              h[i] = 2 + 40 * p[i] / (1 + g[i]);
            return h;
          }),
      obstacle);
  steps(scene, "warm " + name,
        {{scene.form(*form_several_fields_F_moved, {V}, in),
          scene.form(*form_several_fields_F_warm, {Q}, in)},
         {{scene.form(*form_several_fields_J_moved, {V, V}, {}),
           scene.form(*form_several_fields_J_moved_warm, {V, Q}, {})},
          {nullptr, scene.form(*form_several_fields_J_warm, {Q, Q}, {})}},
         {u, warmth},
         0},
        bcs, push, contact, {u, warmth}, conductance);
}
} // namespace

int main(int argc, char* argv[])
{
  init_logging(argc, argv);
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  {
    Scene scene;
    static_cast<scenes::Domain&>(scene)
        = scenes::read("sliding_block.xdmf", mesh::CellType::quadrilateral);
    cx::petsc::Owner<KSP, KSPDestroy> ksp;
    KSPCreate(MPI_COMM_WORLD, ksp.put());
    scene.ksp = ksp.get();
    cx::petsc::set_lu(scene.ksp);

    const cx::Options friction{.friction = 0.2},
        mortar{.method = cx::Method::surface_to_surface};
    incompressible(scene, "n2s", friction);
    incompressible(scene, "s2s", mortar);
    const cx::Surface base(scene.tags, {21});
    const auto plane = std::make_shared<cx::Plane>(std::vector<double>{0, 0},
                                                   std::vector<double>{0, 1});
    warm(scene, "base n2s", base, std::nullopt, friction);
    warm(scene, "base s2s", base, std::nullopt, mortar);
    warm(scene, "plane n2s", plane, -0.3, friction);
    warm(scene, "plane s2s", plane, -0.3, mortar);
  }
  PetscFinalize();
  return 0;
}
