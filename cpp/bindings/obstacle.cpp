// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include "master.h"
#include <contactx/contact/mortar_obstacle.h>
#include <contactx/contact/obstacle_tie.h>
#include <contactx/geometry/cylinder.h>
#include <contactx/geometry/level_set.h>
#include <contactx/geometry/plane.h>
#include <contactx/geometry/sphere.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::contact;
using namespace contactx::geometry;

namespace
{
/// An obstacle whose subclass in Python hands its parameters over.
template <class O>
class Refreshed final : public O
{
public:
  using O::O;

protected:
  void refresh(int gdim) override { PYBIND11_OVERRIDE(void, O, refresh, gdim); }
};

/// What is seen, which knows its shapes.
struct ProbeResult
{
  Geometry at;
  py::ssize_t gdim;
};

struct Dimension
{
  int gdim;

  explicit Dimension(const Array<double>& x) : gdim(0)
  {
    if (x.ndim() != 2)
      throw std::invalid_argument("x must have a row for each point");
    gdim = static_cast<int>(x.shape(1));
    check::dimension(gdim);
  }
};

std::vector<double> numbers(const py::handle& values)
{
  using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const auto a = py::cast<Values>(values);
  return {a.data(), a.data() + a.size()};
}

/// A level set's function in Python: of points (n, gdim) and an order, to
/// values, gradients and second derivatives, of which the last ones may be
/// None.
LevelSet::Function level_function(py::function f)
{
  return [f = std::move(f)](std::span<const double> x, int gdim, int order)
  {
    const py::ssize_t n = static_cast<py::ssize_t>(x.size()) / gdim;
    // A copy: the user's function may keep it
    const py::array_t<double> points({n, py::ssize_t(gdim)}, x.data());
    const py::tuple result = f(points, order);
    LevelValues at;
    at.value = numbers(result[0]);
    at.gradient = numbers(result[1]);
    if (not result[2].is_none())
      at.hessian = numbers(result[2]);
    return at;
  };
}
/// The velocity of a level set's material in Python: of points (n, gdim), and
/// the time.
std::optional<LevelSet::Velocity> level_velocity(py::object velocity,
                                                 py::object time)
{
  if (velocity.is_none())
    return std::nullopt;
  return LevelSet::Velocity{
      [f = std::move(velocity)](std::span<const double> x, int gdim)
      {
        const py::ssize_t n = static_cast<py::ssize_t>(x.size()) / gdim;
        return numbers(
            f(py::array_t<double>({n, py::ssize_t(gdim)}, x.data())));
      },
      [t = std::move(time)] { return t().cast<double>(); }};
}
} // namespace

void contactx_bindings::obstacle(py::module_& m)
{
  const auto part = [](std::vector<double> Geometry::* values, int rank)
  {
    return [values, rank](py::object self)
    {
      const auto& seen = self.cast<const ProbeResult&>();
      std::vector<py::ssize_t> shape{
          static_cast<py::ssize_t>(seen.at.gap.size())};
      shape.insert(shape.end(), rank, seen.gdim);
      return looking(seen.at.*values, shape, self);
    };
  };
  py::class_<ProbeResult>(m, "Geometry", "An obstacle seen from points")
      .def_property_readonly("gap", part(&Geometry::gap, 0))
      .def_property_readonly("gradient", part(&Geometry::gradient, 1))
      .def_property_readonly("normal", part(&Geometry::normal, 1))
      .def_property_readonly("curvature", part(&Geometry::curvature, 2));
  py::class_<Obstacle, std::shared_ptr<Obstacle>>(
      m, "Obstacle", "Rigid body, a master without degrees of freedom")
      .def("evaluate",
           [](Obstacle& self, const Array<double>& x)
           {
             const int gdim = Dimension(x).gdim;
             return ProbeResult{self.evaluate(view(x), gdim), gdim};
           })
      .def("parameters", [](Obstacle& self, int gdim)
           { return array(self.parameters(gdim)); })
      .def("level", [](Obstacle& self, const Array<double>& x)
           { return array(self.level(view(x), Dimension(x).gdim)); })
      .def_readwrite("extent", &Obstacle::extent);
  py::class_<Plane, Refreshed<Plane>, Obstacle, std::shared_ptr<Plane>>(
      m, "Plane", "Half-space bounded by a plane")
      .def(py::init<>())
      .def("place", &Plane::place);
  py::class_<Sphere, Refreshed<Sphere>, Obstacle, std::shared_ptr<Sphere>>(
      m, "Sphere", "Ball, or all that is outside of one")
      .def(py::init<bool>())
      .def("place", &Sphere::place, py::arg("centre"), py::arg("radius"),
           py::arg("angle") = std::vector<double>{});
  py::class_<Cylinder, Refreshed<Cylinder>, Obstacle,
             std::shared_ptr<Cylinder>>(
      m, "Cylinder", "Endless circular cylinder, or all that is outside of one")
      .def(py::init<bool>())
      .def("place", &Cylinder::place, py::arg("point"), py::arg("axis"),
           py::arg("radius"), py::arg("angle") = std::vector<double>{});
  py::class_<LevelSet, Obstacle, std::shared_ptr<LevelSet>>(
      m, "LevelSet", "Body where a function is negative")
      .def(py::init(
               [](py::function f,
                  std::function<std::vector<double>(int)> parameters,
                  py::object velocity, py::object time)
               {
                 return std::make_shared<LevelSet>(
                     level_function(std::move(f)), std::move(parameters),
                     level_velocity(std::move(velocity), std::move(time)));
               }),
           py::arg("function"), py::arg("parameters"),
           py::arg("velocity") = py::none(), py::arg("time") = py::none());

  py::class_<ObstacleMaster, Master, std::shared_ptr<ObstacleMaster>>(
      m, "ObstacleMaster", "Pairs of slave nodes with a rigid obstacle")
      .def_property_readonly("obstacle", &ObstacleMaster::obstacle);
  py::class_<ObstacleTie, ObstacleMaster, std::shared_ptr<ObstacleTie>>(
      m, "ObstacleTie", "Slave nodes tied to a rigid obstacle");
  py::class_<MortarObstacle, ObstacleMaster, std::shared_ptr<MortarObstacle>>(
      m, "MortarObstacle", "Pairs of slave facets with a rigid obstacle");
}
