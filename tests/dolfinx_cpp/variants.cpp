// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// Each kind of contact on the mesh of demos/cpp/sliding_block, and on another
// one that variants.py writes: prints what that prints, in the same digits on
// any number of ranks.

#include "neo_hooke.h"
#include "prestress.h"
#include "quadratic.h"
#include "scenes.h"
#include "sliding_block.h"
#include <contactx_dolfinx/condensed.h>
#include <contactx_dolfinx/forms.h>
#include <contactx_dolfinx/obstacles.h>
#include <contactx_dolfinx/penetration.h>
#include <contactx_dolfinx/snes.h>
#include <dolfinx/fem/Constant.h>

using namespace dolfinx;
using T = PetscScalar;
using U = double;
namespace cx = contactx_dolfinx;

namespace
{
/// A fluid enters at smaller x.
constexpr double entry = 0.3;

struct Scene : scenes::Domain
{
  std::shared_ptr<fem::FunctionSpace<U>> V;
  std::shared_ptr<fem::Constant<T>> load;
  KSP ksp;
  bool condensed = false;
  bool has_snes = false;  // in place of a loop of one's own
  bool has_forms = false; // in place of the assembler's matrix

  int dim() const { return mesh->geometry().dim(); }
};

/// Mesh and tags of a file, and a displacement of some degree.
void read(Scene& scene, const char* name, mesh::CellType cell, int degree,
          int order = 1)
{
  static_cast<scenes::Domain&>(scene) = scenes::read(name, cell, order);
  scene.V = scenes::space(scene, scenes::lagrange(cell, degree, scene.dim()));
  std::vector<T> load(scene.dim(), 0);
  load.back() = -0.01;
  scene.load = std::make_shared<fem::Constant<T>>(load);
}

/// A residual with the load on the block.
std::shared_ptr<fem::Form<T>>
residual_form(const Scene& scene, ufcx_form& form,
              const std::shared_ptr<fem::Function<T>>& u,
              std::map<std::string, std::shared_ptr<fem::Constant<T>>> constants
              = {})
{
  // As the forms of some file call them
  for (const char* name : {"load", "push", "pressure"})
    constants[name] = scene.load;
  const auto top = fem::compute_integration_domains(
      fem::IntegralType::exterior_facet, *scene.mesh->topology(),
      scene.tags->find(12));
  return std::make_shared<fem::Form<T>>(fem::create_form<T>(
      form, {scene.V}, {{"u", u}, {"c", u}, {"w", u}},
      {constants.begin(), constants.end()},
      {{fem::IntegralType::exterior_facet, {{12, top}}}}, {}));
}

/// The block's support, and the value that pushes it.
struct Support
{
  std::vector<std::shared_ptr<const fem::DirichletBC<T>>> bcs;
  std::shared_ptr<fem::Constant<T>> push;
};

Support support(const Scene& scene,
                std::initializer_list<std::pair<int, int>> more = {})
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
                                     *Vi->dofmap(), scene.dim() - 1,
                                     scene.tags->find(face)),
        Vi));
    return value;
  };
  for (int k = 0; k < scene.dim(); ++k)
    fix(k, 22);
  made.push = fix(0, 12);
  if (scene.dim() == 3)
    fix(1, 12);
  for (const auto& [component, face] : more)
    fix(component, face);
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
  KSPReset(scene.ksp);
  for (int step = 0; step < 2; ++step)
  {
    assembler.begin_step();
    cx::Settled it;
    while (not(it = assembler.settle()).converged)
    {
      assembler.residual(assembler.x(), b.get());
      assembler.set_up(scene.ksp);
      KSPSolve(scene.ksp, b.get(), dx.get());
      VecScale(dx.get(), -1);
      assembler.update(dx.get(), assembler.limit(dx.get()));
    }
    assembler.accept();
    if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
      std::printf("%s %d %.6e\n", name, it.number, it.tolerance);
  }
}

/// Assembles bulk and contact from forms, for the state of an assembler; the
/// Jacobian belongs to the forms.
Mat assemble(cx::Forms& forms, const cx::Assembler& assembler,
             const fem::Form<T>& F, const fem::Form<T>& J,
             const std::vector<std::shared_ptr<const fem::DirichletBC<T>>>& bcs,
             Vec b)
{
  forms.update(assembler.x());
  std::vector<std::reference_wrapper<const fem::DirichletBC<T>>> conditions;
  for (const auto& bc : bcs)
    conditions.push_back(*bc);
  const auto& u = assembler.bulk()->u()->x()->array();
  const auto& V = *F.function_spaces()[0];
  const int bs = V.dofmap()->bs();
  la::Vector<T> force(V.dofmap()->index_map, bs);
  std::ranges::fill(force.array(), 0);
  fem::assemble_vector(force.array(), F);
  fem::apply_lifting(force.array(), {J}, {conditions}, {std::span<const T>(u)},
                     -1.0);
  force.scatter_rev(std::plus<T>());
  for (const fem::DirichletBC<T>& bc : conditions)
    bc.set(force.array(), u, -1);
  VecZeroEntries(b);
  {
    const cx::petsc::Values values(b);
    std::copy_n(force.array().begin(), bs * V.dofmap()->index_map->size_local(),
                values.span().begin());
  }
  forms.assemble_vector(b);
  const Mat A = forms.matrix();
  fem::assemble_matrix(
      la::petsc::Matrix::set_block_expand_fn(A, bs, bs, ADD_VALUES), J,
      conditions);
  fem::set_diagonal<T>(la::petsc::Matrix::set_fn(A, ADD_VALUES), V, conditions);
  forms.assemble_matrix(A);
  return A;
}

void solve(const Scene& scene, const char* name, const cx::Contact::Master& to,
           const cx::Options& options,
           ufcx_form* residual = form_sliding_block_F,
           ufcx_form* jacobian = form_sliding_block_J)
{
  const auto& [mesh, tags] = static_cast<const scenes::Domain&>(scene);
  const auto& V = scene.V;
  const auto load = scene.load;
  const KSP ksp = scene.ksp;
  auto u = std::make_shared<fem::Function<T>>(V);
  const auto F = residual_form(scene, *residual, u);
  auto J = std::make_shared<fem::Form<T>>(fem::create_form<T>(
      *jacobian, {V, V}, {{"u", u}, {"c", u}, {"w", u}},
      {{"load", load}, {"push", load}, {"pressure", load}}, {}, {}));
  const auto [bcs, push] = support(scene);
  const auto slave = std::string(name) == "self" ? std::get<cx::Surface>(to)
                                                 : cx::Surface(tags, {11});
  auto contact = std::make_shared<cx::Contact>(slave, to, options);
  cx::Assembler assembler(F, J, u, bcs, {contact});
  cx::petsc::OwnVec b(assembler.create_vector()), dx(assembler.create_vector());
  cx::Condensed condensed(assembler, "condensed_");
  cx::petsc::OwnKSP of_condensed;
  KSPCreate(MPI_COMM_WORLD, of_condensed.put());
  KSPSetType(of_condensed.get(), KSPPREONLY);
  std::optional<cx::Forms> forms;
  if (scene.has_forms)
    forms.emplace(assembler, J);
  auto iterate = [&]
  {
    const Mat of_forms
        = forms ? assemble(*forms, assembler, *F, *J, bcs, b.get()) : nullptr;
    if (not forms)
      assembler.residual(assembler.x(), b.get());
    if (scene.condensed)
    {
      condensed.set_up(of_condensed.get());
      KSPSolve(of_condensed.get(), b.get(), dx.get());
    }
    else if (forms)
    {
      KSPSetOperators(ksp, of_forms, of_forms);
      KSPSolve(ksp, b.get(), dx.get());
    }
    else
    {
      assembler.set_up(ksp);
      KSPSolve(ksp, b.get(), dx.get());
    }
    VecScale(dx.get(), -1);
    assembler.update(dx.get(), assembler.limit(dx.get()));
  };
  // Sizes are others than those of the contact before
  KSPReset(ksp);
  cx::petsc::Owner<SNES, SNESDestroy> snes;
  SNESCreate(MPI_COMM_WORLD, snes.put());
  KSP its = nullptr;
  SNESGetKSP(snes.get(), &its);
  cx::petsc::set_lu(its);
  SNESLineSearch search = nullptr;
  SNESGetLineSearch(snes.get(), &search);
  SNESLineSearchSetType(search, SNESLINESEARCHBASIC);
  SNESSetTolerances(snes.get(), 0, 1e-11, 0, 50, -1);
  cx::SNESLoop loop(assembler, snes.get());
  const cx::Surface faces(tags, {11, 21});
  const auto wet = std::make_shared<fem::Function<T>>(
      scenes::space(scene, scenes::lagrange(mesh->topology()->cell_type(), 1)));
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
    if (scene.has_snes)
    {
      loop.solve();
      it.number = assembler.number();
    }
    else
      while (not(it = assembler.settle()).converged)
        iterate();
    assembler.accept();
    const auto force = contact->force();
    const auto moment = contact->moment({0.5, 0.25});
    const contactx::results::Totals totals = contact->totals();
    const cx::Functions& f = contact->functions();
    std::vector<double> figures(force.begin(), force.begin() + scene.dim());
    figures.insert(figures.end(),
                   {scenes::norm(u), scenes::norm(contact->multiplier()),
                    scenes::norm(contact->pressure()),
                    scenes::norm(contact->traction()),
                    scenes::norm(contact->slip())});
    figures.insert(figures.end(), moment.begin() + (scene.dim() == 2 ? 2 : 0),
                   moment.end());
    cx::penetrate(
        assembler, faces, [](const auto& x) { return x[0] < entry; }, *wet);
    figures.insert(figures.end(),
                   {scenes::norm(wet), scenes::norm(f.gap),
                    scenes::norm(f.status), scenes::norm(f.slip_total),
                    scenes::norm(f.master_pressure), double(totals.closed),
                    totals.area, totals.largest_pressure, totals.dissipation});
    // Iterations go with how accurate Krylov solvers are
    scenes::print(name + std::string(" ")
                  + (scene.condensed ? "condensed" : std::to_string(it.number))
                  + " " + scenes::text_of(figures));
  }
  // What needed the direct solver, and whether multigrid did the rest
  const bool expected = condensed.direct() == 0 and condensed.iterations() > 0;
  if (scene.condensed and not expected
      and dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
    std::printf("%s: %d direct solves, %d Krylov iterations\n", name,
                condensed.direct(), condensed.iterations());
}
/// First sentence of a message.
std::string sentence(const std::string& text)
{
  return text.substr(0, text.find(". "));
}

/// What is said of a step that is refused, or of a solution.
void said(const char* name, const std::function<std::string()>& act)
{
  std::string text;
  try
  {
    text = act();
  }
  catch (const std::exception& error)
  {
    text = sentence(error.what());
  }
  if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
    std::printf("%s: %s\n", name, text.c_str());
}

/// A scene whose steps are refused, or accepted with a warning.
struct Told
{
  Told(const Scene& scene, const cx::Contact::Master& to,
       const cx::Options& options, Support given,
       ufcx_form* residual = form_sliding_block_F,
       ufcx_form* jacobian = form_sliding_block_J)
      : scene(scene), bcs(std::move(given)),
        u(std::make_shared<fem::Function<T>>(scene.V)),
        contact(std::make_shared<cx::Contact>(cx::Surface(scene.tags, {11}), to,
                                              options)),
        assembler(residual_form(scene, *residual, u),
                  std::make_shared<fem::Form<T>>(fem::create_form<T>(
                      *jacobian, {scene.V, scene.V}, {{"u", u}}, {}, {}, {})),
                  u, bcs.bcs, {contact})
  {
    KSPReset(scene.ksp);
  }

  /// Take a step; what it is warned of.
  std::string step(int max_it = 50)
  {
    cx::KSPSolver solver(assembler, scene.ksp);
    std::vector<T> dx(assembler.system()->size()), b(dx);
    assembler.begin_step();
    while (not assembler.settle(1e-11, 0, max_it).converged)
    {
      assembler.system()->residual(b);
      solver.update();
      solver.solve(b, dx);
      cx::petsc::OwnVec step(assembler.create_vector());
      std::ranges::transform(dx, cx::petsc::Values(step.get()).span().begin(),
                             std::negate());
      assembler.update(step.get(), assembler.limit(step.get()));
    }
    assembler.accept();
    return assembler.warnings().empty() ? "accepted"
                                        : sentence(assembler.warnings()[0]);
  }

  const Scene& scene;
  Support bcs;
  std::shared_ptr<fem::Function<T>> u;
  std::shared_ptr<cx::Contact> contact;
  cx::Assembler assembler;
};

/// Steps that both languages refuse with the same words.
void refusals(Scene& scene)
{
  const cx::Surface base(scene.tags, {21});
  const double offset = 1e-8;
  const std::vector<double> point{0, 0}, up{0, 1};
  said("unbalanced",
       [&]
       {
         Support only_base = support(scene);
         only_base.bcs.resize(2);
         scene.load->value[1] = 0.01;
         return Told(scene, base, {.offset = offset}, only_base).step();
       });
  scene.load->value[1] = -0.01;
  said("too few iterations",
       [&]
       {
         return Told(scene, base, {.friction = 0.3, .offset = offset},
                     support(scene), form_neo_hooke_F, form_neo_hooke_J)
             .step(1);
       });
  said("held inside",
       [&]
       {
         const Support given = support(scene, {{1, 11}});
         return Told(scene,
                     std::make_shared<cx::Plane>(std::vector<double>{0, 0.05},
                                                 up),
                     {}, given)
             .step();
       });
  said("displacement",
       [&]
       {
         Told told(scene, base, {.offset = offset}, support(scene));
         std::ranges::fill(told.u->x()->array(), NAN);
         return told.step();
       });
  said("prescribed",
       [&]
       {
         const Support given = support(scene);
         given.push->value[0] = INFINITY;
         return Told(scene, base, {.offset = offset}, given).step();
       });
  said("load",
       [&]
       {
         scene.load->value[1] = NAN;
         return Told(scene, base, {.offset = offset}, support(scene)).step();
       });
  scene.load->value[1] = -0.01;
  said("friction",
       [&]
       {
         Told told(scene, base, {.friction = 0.3, .offset = offset},
                   support(scene));
         told.step();
         told.contact->set_friction(NAN);
         return told.step();
       });
  said("coarse disc",
       [&]
       {
         const auto disc = std::make_shared<cx::Sphere>(
             std::vector<double>{0.9, -0.15}, 0.15);
         return Told(scene, disc, {.friction = 0.1, .offset = offset},
                     support(scene))
             .step();
       });
  said("level set",
       [&]
       {
         double height = 0;
         const auto f = [&](std::span<const double> x, int, int)
         {
           cx::LevelValues at;
           for (std::size_t i = 0; i < x.size(); i += 2)
           {
             at.value.push_back(x[i + 1] - height);
             at.gradient.insert(at.gradient.end(), {0, 1});
             at.hessian.insert(at.hessian.end(), 4, 0);
           }
           return at;
         };
         const auto moved = [&](int) { return std::vector<double>{height}; };
         Told told(scene, std::make_shared<cx::LevelSet>(f, moved),
                   {.friction = 0.3, .offset = offset}, support(scene));
         told.step();
         height = 0.1;
         return told.step();
       });
  const auto options = [&](const char* name, const cx::Contact::Master& to,
                           const cx::Options& given)
  {
    said(name, [&] { return Told(scene, to, given, support(scene)).step(); });
  };
  options("tied with friction", base, {.friction = 0.3, .tied = true});
  options("negative distance", base, {.search_distance = -1});
  options("excluded", base, {.excluded_distance = 0.1});
  options("adjusted tie", base, {.tied = true, .adjust = 0.1});
  options("tangential factor", base, {.friction = 0.3, .tangential_factor = 0});
  options("smooth plane", std::make_shared<cx::Plane>(point, up),
          {.smooth = true});
  options("smooth tie", base, {.tied = true, .smooth = true});
  options("faces away", cx::Surface(scene.tags, {22}), {});
}
} // namespace

int main(int argc, char* argv[])
{
  init_logging(argc, argv);
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  {
    Scene scene;
    const auto quadrilateral = mesh::CellType::quadrilateral;
    read(scene, "sliding_block.xdmf", quadrilateral, 1);
    cx::petsc::Owner<KSP, KSPDestroy> ksp;
    KSPCreate(MPI_COMM_WORLD, ksp.put());
    scene.ksp = ksp.get();
    cx::petsc::set_lu(scene.ksp);

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
    solve(scene, "plane", std::make_shared<cx::Plane>(point, up),
          {.friction = 0.3, .offset = offset});
    solve(scene, "mortar plane", std::make_shared<cx::Plane>(point, up),
          {.friction = 0.3, .method = mortar, .offset = offset});
    solve(scene, "disc", std::make_shared<cx::Sphere>(middle, 4.0),
          {.friction = 0.1, .offset = offset});
    solve(scene, "adjusted disc", std::make_shared<cx::Sphere>(middle, 4.0),
          {.friction = 0.1, .offset = offset, .adjust = 0.1});
    solve(scene, "smooth", base,
          {.friction = 0.3, .offset = offset, .smooth = true});
    solve(scene, "neo-Hooke", base, {.friction = 0.3, .offset = offset},
          form_neo_hooke_F, form_neo_hooke_J);
    scene.has_snes = true;
    solve(scene, "friction", base, {.friction = 0.3, .offset = offset});
    solve(scene, "mortar friction", base,
          {.friction = 0.3, .method = mortar, .offset = offset});
    solve(scene, "neo-Hooke", base, {.friction = 0.3, .offset = offset},
          form_neo_hooke_F, form_neo_hooke_J);
    scene.has_snes = false;
    scene.has_forms = true;
    solve(scene, "friction", base, {.friction = 0.3, .offset = offset});
    solve(scene, "small", base,
          {.friction = 0.3, .sliding = small, .offset = offset});
    solve(scene, "mortar friction", base,
          {.friction = 0.3, .method = mortar, .offset = offset});
    solve(scene, "mortar tied", base, {.method = mortar, .tied = true});
    solve(scene, "mortar plane", std::make_shared<cx::Plane>(point, up),
          {.friction = 0.3, .method = mortar, .offset = offset});
    solve(scene, "neo-Hooke", base, {.friction = 0.3, .offset = offset},
          form_neo_hooke_F, form_neo_hooke_J);
    scene.has_forms = false;
    const auto weight = [](const auto& x) { return 1 + x[0] / 2; };
    solve(scene, "weight", base, {.offset = offset, .weight = weight});
    solve(scene, "mortar weight", base,
          {.method = mortar, .offset = offset, .weight = weight});

    // Fields and laws of one's own
    const auto Q = cx::Functions::scalars(*scene.V);
    const auto rough = std::make_shared<fem::Function<T>>(Q),
               layer = std::make_shared<fem::Function<T>>(Q);
    const auto set = [](fem::Function<T>& f, auto value)
    {
      f.interpolate(
          [&](auto x) -> std::pair<std::vector<T>, std::vector<std::size_t>>
          {
            std::vector<T> values;
            for (std::size_t p = 0; p < x.extent(1); ++p)
              values.push_back(value(x(0, p)));
            return {values, {values.size()}};
          });
    };
    set(*rough, [](double x) { return 0.1 + 0.2 * x; });
    set(*layer, [](double x) { return 1e-3 * x; });
    solve(scene, "friction field", base,
          {.friction = std::shared_ptr<const fem::Function<T>>(rough),
           .offset = offset});
    solve(scene, "offset field", base,
          {.friction = 0.3,
           .offset = std::shared_ptr<const fem::Function<T>>(layer)});
    solve(scene, "mortar friction field", base,
          {.friction = std::shared_ptr<const fem::Function<T>>(rough),
           .method = mortar,
           .offset = offset});
    const contactx::law::BoundFunction weakens
        = [](std::span<const double> p, std::span<const double> slip)
    {
      contactx::law::Bounds found;
      for (std::size_t i = 0; i < p.size(); ++i)
      {
        const double weak = std::exp(-slip[i] / 0.01);
        found.bound.push_back((0.2 + 0.1 * weak) * p[i]);
        found.by_pressure.push_back(0.2 + 0.1 * weak);
        found.by_slip.push_back(-0.1 * weak / 0.01 * p[i]);
      }
      return found;
    };
    solve(scene, "own law", base, {.friction_law = weakens, .offset = offset});
    solve(scene, "tangential factor", base,
          {.friction = 0.3,
           .offset = offset,
           .tangential_factor = 0.1,
           .name = "rubs"});

    refusals(scene);

    tolerances(scene, "prestress", 1e3, {.offset = offset});
    tolerances(scene, "mortar prestress", 1e3,
               {.method = mortar, .offset = offset});
    tolerances(scene, "growth", 0, {.offset = offset});

    scene.condensed = true;
    solve(scene, "frictionless", base, {.offset = offset});
    solve(scene, "friction", base, {.friction = 0.3, .offset = offset});
    solve(scene, "mortar", base, {.method = mortar, .offset = offset});
    solve(scene, "plane", std::make_shared<cx::Plane>(point, up),
          {.friction = 0.3, .offset = offset});
    solve(scene, "tied", base, {.tied = true});
    solve(scene, "neo-Hooke", base, {.friction = 0.3, .offset = offset},
          form_neo_hooke_F, form_neo_hooke_J);

    // A quadratic displacement, of quadrilaterals and of tetrahedra
    scene.condensed = false;
    read(scene, "sliding_block.xdmf", quadrilateral, 2);
    const auto plane = [&](const char* name, const cx::Contact::Master& to,
                           const cx::Options& options)
    { solve(scene, name, to, options, form_quadratic_F, form_quadratic_J); };
    const cx::Surface wide(scene.tags, {21});
    const auto disc = std::make_shared<cx::Sphere>(middle, 4.0);
    const cx::Options has_friction{.friction = 0.3, .offset = offset},
        rubs_on_facets{.friction = 0.3, .method = mortar, .offset = offset};
    plane("quadratic friction", wide, has_friction);
    plane("quadratic tied", wide, {.tied = true});
    plane("quadratic mortar", wide, rubs_on_facets);
    plane("quadratic disc", disc, {.friction = 0.1, .offset = offset});
    plane("quadratic mortar disc", disc,
          {.friction = 0.1, .method = mortar, .offset = offset});
    scene.condensed = true;
    plane("quadratic mortar", wide, rubs_on_facets);
    scene.condensed = false;

    read(scene, "curved_blocks.xdmf", quadrilateral, 2, 2);
    const auto curved = [&](const char* name, cx::Method method)
    {
      solve(scene, name, cx::Surface(scene.tags, {21}),
            {.friction = 0.3, .method = method, .offset = 0.01},
            form_quadratic_F_curved, form_quadratic_J_curved);
    };
    curved("curved friction", cx::Method::node_to_surface);
    curved("curved mortar", mortar);

    read(scene, "solid_blocks.xdmf", mesh::CellType::tetrahedron, 2);
    const auto solid = [&](const char* name, const cx::Contact::Master& to,
                           const cx::Options& options)
    {
      solve(scene, name, to, options, form_quadratic_F_solid,
            form_quadratic_J_solid);
    };
    const cx::Surface below(scene.tags, {21});
    const auto ball
        = std::make_shared<cx::Sphere>(std::vector<double>{0.75, 0.6, -4}, 4.0);
    for (const bool has_forms : {false, true})
    {
      scene.has_forms = has_forms;
      solid("solid friction", below, has_friction);
      solid("solid mortar", below, rubs_on_facets);
    }
    scene.has_forms = false;
    solid("solid ball", ball, {.friction = 0.1, .offset = offset});
    solid("solid mortar ball", ball,
          {.friction = 0.1, .method = mortar, .offset = offset});
  }
  PetscFinalize();
  return 0;
}
