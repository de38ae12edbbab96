# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Each kind of contact on the mesh of demos/cpp/sliding_block, as variants.cpp has them.

It writes curved_blocks.xdmf and solid_blocks.xdmf, which variants.cpp reads.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import contactx as cx  # isort: skip

from mpi4py import MPI

import numpy as np

import basix.ufl
import ufl
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

from shared import LU, direct, newton_step, read, sentence, show, texts, write  # isort: skip

import meshes
import story

WAYS = (0.0, 0.03, -0.02)
# A fluid enters at smaller x
ENTRY = 0.3


def norm(values: Any) -> float:
    """Norm of what is on all ranks."""
    return float(np.sqrt(MPI.COMM_WORLD.allreduce(float((np.asarray(values) ** 2).sum()))))


def neo_hooke(u: fem.Function) -> Any:
    """Residual of a compressible neo-Hookean solid."""
    F = ufl.Identity(2) + ufl.grad(u)
    log = ufl.ln(ufl.det(F))
    energy = 0.5 * (ufl.tr(F.T * F) - 2 - 2 * log) + log**2
    return ufl.derivative(energy * ufl.dx, u)


def solve(
    name: str,
    tags: Any,
    V: fem.FunctionSpace,
    master: Any,
    condensed: bool = False,
    **options: Any,
) -> None:
    """Solve three steps and print their figures."""
    u = fem.Function(V)
    gdim = len(u)
    load = fem.Constant(V.mesh, -0.01 * np.eye(gdim)[-1])
    F = neo_hooke(u) if name == "neo-Hooke" else story.elasticity(u, 1.0, 0.3)
    F += story.traction(u, tags, 12, load)
    bcs = [story.fix(u, tags, i, 0.0, 22) for i in range(gdim)]
    bcs += [story.fix(u, tags, i, 0.0, 12) for i in range(gdim - 1)]
    push = bcs[gdim]
    slave = master if name == "self" else cx.Surface(tags, 11)
    contact = cx.Contact(slave=slave, master=master, **options)
    problem = cx.ContactProblem(
        F,
        u,
        contacts=[contact],
        bcs=bcs,
        petsc_options_prefix="variants_",
        petsc_options={"pc_type": "condensed"} if condensed else LU,
    )
    fluid = cx.FluidPenetration(
        V.mesh, cx.Surface(tags, 11, 21), entry=lambda x: x[0] < ENTRY, contacts=[contact]
    )
    dofs = fluid.wet.function_space.dofmap
    for way in WAYS:
        push.g.value[...] = way
        problem.solve()
        fields, size = contact.fields, V.dofmap.index_map.size_local
        figures = [*contact.force, norm(u.x.array[: gdim * size]), norm(contact.multiplier)]
        for f in (fields.pressure, fields.traction, fields.slip):
            figures.append(0.0 if f is None else norm(f.x.array))
        figures += np.atleast_1d(contact.moment([0.5, 0.25, 0.0][:gdim])).tolist()
        fluid.update()
        figures.append(norm(fluid.wet.x.array[: dofs.index_map.size_local]))
        for f in (fields.gap, fields.status, fields.slip_total, fields.master_pressure):
            figures.append(0.0 if f is None else norm(np.nan_to_num(f.x.array[:size])))
        totals = fields.totals()
        figures += [totals.closed, totals.area, totals.largest_pressure, totals.dissipation]
        # Iterations go with how accurate Krylov solvers are
        show(name, "condensed" if condensed else problem.report.iterations, *texts(figures))


def tolerances(name: str, tags: Any, V: fem.FunctionSpace, size: float, **options: Any) -> None:
    """Solve twice with forces that cancel, and print what the residual was compared with."""
    u, v = fem.Function(V), ufl.TestFunction(V)
    prestress = fem.Constant(V.mesh, size * np.array([[2.0, 1.0], [1.0, 3.0]]))
    # In one integral, as FFCx has all that is over the same cells
    strain = ufl.sym(ufl.grad(u)) - fem.Constant(V.mesh, 1e-3) * ufl.Identity(2)
    stress = 2 / 2.6 * strain + 0.3 / (1.3 * 0.4) * ufl.tr(strain) * ufl.Identity(2) + prestress
    F = ufl.inner(stress, ufl.grad(v)) * ufl.dx
    F -= ufl.inner(prestress * ufl.FacetNormal(V.mesh), v) * ufl.ds
    F += story.traction(u, tags, 12, fem.Constant(V.mesh, np.array([0, -0.01])))
    bcs = [*(story.fix(u, tags, i, 0.0, 22) for i in range(2)), story.fix(u, tags, 0, 0.0, 12)]
    contact = cx.Contact(cx.Surface(tags, 11), cx.Surface(tags, 21), offset=1e-8, **options)
    problem = cx.ContactProblem(
        F, u, contacts=[contact], bcs=bcs, petsc_options_prefix="variants_", petsc_options=LU
    )
    for _ in range(2):
        problem.solve()
        report = problem.report
        show(name, report.iterations, f"{report.history[-1].tolerance:.6e}")


def said(name: str, act: Callable[[], str]) -> None:
    """Print what is said of a step that is refused, or of a solution."""
    try:
        text = act()
    except cx.ConvergenceError as error:
        text = sentence(error.reason)
    except (ValueError, RuntimeError) as error:
        text = sentence(str(error))
    show(f"{name}: {text}")


class Told:
    """A scene whose steps are refused, or accepted with a warning."""

    def __init__(
        self,
        tags: Any,
        V: fem.FunctionSpace,
        master: Any,
        *,
        more: Any = (),
        held: bool = True,
        form: Any = None,
        load: float = -0.01,
        **options: Any,
    ):
        self.u = u = fem.Function(V)
        self.load = fem.Constant(V.mesh, np.array([0.0, load]))
        F = form(u) if form else story.elasticity(u, 1.0, 0.3)
        F += story.traction(u, tags, 12, self.load)
        bcs = [story.fix(u, tags, i, 0.0, 22) for i in range(2)]
        self.push = story.fix(u, tags, 0, 0.0, 12)
        bcs += [self.push] if held else []
        bcs += [story.fix(u, tags, i, 0.0, face) for i, face in more]
        contact = cx.Contact(slave=cx.Surface(tags, 11), master=master, **options)
        self.assembler = cx.ContactAssembler(F, u, contacts=[contact], bcs=bcs)
        self.ksp = direct()

    def step(self, max_it: int = 50) -> str:
        """Take a step; what it is warned of."""
        a = self.assembler
        b, dx = a.create_vector(), a.create_vector()
        a.begin_step()
        while not a.settle(max_it=max_it).converged:
            newton_step(a, self.ksp, b, dx)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            a.accept()
        told = a.core.report.warnings
        return sentence(told[0]) if told else "accepted"


def refusals(tags: Any, V: fem.FunctionSpace) -> None:
    """Steps that both languages refuse with the same words."""
    base = cx.Surface(tags, 21)
    little: dict[str, Any] = {"offset": 1e-8}
    plane = cx.Plane(point=[0.0, 0.0], normal=[0.0, 1.0])
    said("unbalanced", lambda: Told(tags, V, base, held=False, load=0.01, **little).step())
    rubs = {"friction": 0.3, **little}
    said("too few iterations", lambda: Told(tags, V, base, form=neo_hooke, **rubs).step(1))
    higher = cx.Plane(point=[0.0, 0.05], normal=[0.0, 1.0])
    said("held inside", lambda: Told(tags, V, higher, more=[(1, 11)]).step())

    def displacement() -> str:
        told = Told(tags, V, base, **little)
        told.u.x.array[:] = np.nan
        return told.step()

    def prescribed() -> str:
        told = Told(tags, V, base, **little)
        told.push.g.value[...] = np.inf
        return told.step()

    def friction() -> str:
        coefficient = fem.Constant(V.mesh, 0.3)
        told = Told(tags, V, base, friction=coefficient, **little)
        told.step()
        coefficient.value = np.nan
        return told.step()

    def level_set() -> str:
        height = fem.Constant(V.mesh, 0.0)
        told = Told(tags, V, cx.LevelSet(lambda x: x[1] - height), **rubs)
        told.step()
        height.value = 0.1
        return told.step()

    said("displacement", displacement)
    said("prescribed", prescribed)
    said("load", lambda: Told(tags, V, base, load=np.nan, **little).step())
    said("friction", friction)
    disc = cx.Sphere(centre=[0.9, -0.15], radius=0.15)
    said("coarse disc", lambda: Told(tags, V, disc, friction=0.1, **little).step())
    said("level set", level_set)
    for name, master, options in (
        ("tied with friction", base, {"friction": 0.3, "tied": True}),
        ("negative distance", base, {"search_distance": -1}),
        ("excluded", base, {"excluded_distance": 0.1}),
        ("adjusted tie", base, {"tied": True, "adjust": 0.1}),
        ("tangential factor", base, {"friction": 0.3, "tangential_factor": 0}),
        ("smooth plane", plane, {"smooth": True}),
        ("smooth tie", base, {"tied": True, "smooth": True}),
        ("faces away", cx.Surface(tags, 22), {}),
    ):
        said(name, lambda m=master, o=options: Told(tags, V, m, **o).step())


def write_solid() -> None:
    """Write a block on a wider one, of tetrahedra."""
    data = meshes.blocks(
        CellType.tetrahedron,
        [3, 2, 2],
        [3, 3, 2],
        size_upper=[1.0, 0.8, 0.6],
        size_lower=[1.6, 1.2, 0.5],
        shift=[0.25, 0.2],
        comm=MPI.COMM_SELF,
    )
    write("solid_blocks", data.mesh, data.facet_tags)


def write_curved() -> None:
    """Write blocks of order 2 that meet along a wave, 0.01 apart."""
    data = meshes.blocks(
        CellType.quadrilateral, [8, 3], [12, 3], size_lower=[1.5, 0.5], shift=[0.2],
        gap=0.01, comm=MPI.COMM_SELF,
    )  # fmt: skip
    W = fem.functionspace(data.mesh, ("Lagrange", 2))
    x = W.tabulate_dof_coordinates()[:, :2]
    heights = {11: 0.01, 12: 1.01, 21: 0.0, 22: -0.5}
    element = basix.ufl.element("Lagrange", "quadrilateral", 2, shape=(2,))
    curved = mesh.create_mesh(MPI.COMM_SELF, W.dofmap.list.astype(np.int64), element, x)
    found = [
        mesh.locate_entities_boundary(curved, 1, lambda x, y=y: np.isclose(x[1], y))
        for y in heights.values()
    ]
    tags = np.repeat(np.array(list(heights), dtype=np.int32), [len(f) for f in found])
    order = np.argsort(np.concatenate(found))
    facet_tags = mesh.meshtags(curved, 1, np.concatenate(found)[order], tags[order])
    points = curved.geometry.x
    points[:, 1] += 0.03 * np.sin(4 * points[:, 0])
    write("curved_blocks", curved, facet_tags)


def main() -> None:
    """Solve all."""
    domain, tags = read("sliding_block")
    V = fem.functionspace(domain, ("Lagrange", 1, (2,)))
    base = cx.Surface(tags, 21)
    plane = cx.Plane(point=[0.0, 0.0], normal=[0.0, 1.0])
    disc = cx.Sphere(centre=[1.5, -4.0], radius=4.0)
    mortar: dict[str, Any] = {"method": "surface-to-surface"}
    little = {"offset": 1e-8}
    rubs = {"friction": 0.3, **little}
    solve("frictionless", tags, V, base, **little)
    solve("friction", tags, V, base, **rubs)
    solve("small", tags, V, base, sliding="small", **rubs)
    solve("tied", tags, V, base, tied=True)
    solve("mortar", tags, V, base, **mortar, **little)
    solve("mortar friction", tags, V, base, **mortar, **rubs)
    solve("mortar tied", tags, V, base, **mortar, tied=True)
    solve("self", tags, V, cx.Surface(tags, [11, 21]), **rubs, excluded_distance=0.01)
    solve("plane", tags, V, plane, **rubs)
    solve("mortar plane", tags, V, plane, **mortar, **rubs)
    solve("disc", tags, V, disc, friction=0.1, **little)
    solve("adjusted disc", tags, V, disc, friction=0.1, **little, adjust=0.1)
    solve("smooth", tags, V, base, **rubs, smooth=True)
    solve("neo-Hooke", tags, V, base, **rubs)
    # By a SNES in C++
    solve("friction", tags, V, base, **rubs)
    solve("mortar friction", tags, V, base, **mortar, **rubs)
    solve("neo-Hooke", tags, V, base, **rubs)
    # From forms in C++
    solve("friction", tags, V, base, **rubs)
    solve("small", tags, V, base, sliding="small", **rubs)
    solve("mortar friction", tags, V, base, **mortar, **rubs)
    solve("mortar tied", tags, V, base, **mortar, tied=True)
    solve("mortar plane", tags, V, plane, **mortar, **rubs)
    solve("neo-Hooke", tags, V, base, **rubs)
    weight: Any = {"weight": 1 + ufl.SpatialCoordinate(domain)[0] / 2, **little}
    solve("weight", tags, V, base, **weight)
    solve("mortar weight", tags, V, base, **mortar, **weight)
    # Fields and laws of one's own
    Q = fem.functionspace(domain, ("Lagrange", 1))
    rough, layer = fem.Function(Q), fem.Function(Q)
    rough.interpolate(lambda x: 0.1 + 0.2 * x[0])
    layer.interpolate(lambda x: 1e-3 * x[0])
    solve("friction field", tags, V, base, friction=rough, **little)
    solve("offset field", tags, V, base, friction=0.3, offset=layer)
    solve("mortar friction field", tags, V, base, **mortar, friction=rough, **little)
    law = cx.FrictionLaw(lambda p, s: (0.2 + 0.1 * ufl.exp(-s / 0.01)) * p)
    solve("own law", tags, V, base, friction=law, **little)
    solve("tangential factor", tags, V, base, tangential_factor=0.1, **rubs)
    refusals(tags, V)
    tolerances("prestress", tags, V, 1e3)
    tolerances("mortar prestress", tags, V, 1e3, **mortar)
    tolerances("growth", tags, V, 0.0)
    condensed: dict[str, Any] = {"condensed": True}
    solve("frictionless", tags, V, base, **little, **condensed)
    solve("friction", tags, V, base, **rubs, **condensed)
    solve("mortar", tags, V, base, **mortar, **little, **condensed)
    solve("plane", tags, V, plane, **rubs, **condensed)
    solve("tied", tags, V, base, tied=True, **condensed)
    solve("neo-Hooke", tags, V, base, **rubs, **condensed)

    # A quadratic displacement, of quadrilaterals and of tetrahedra
    W = fem.functionspace(domain, ("Lagrange", 2, (2,)))
    solve("quadratic friction", tags, W, base, **rubs)
    solve("quadratic tied", tags, W, base, tied=True)
    solve("quadratic mortar", tags, W, base, **mortar, **rubs)
    solve("quadratic disc", tags, W, disc, friction=0.1, **little)
    solve("quadratic mortar disc", tags, W, disc, **mortar, friction=0.1, **little)
    solve("quadratic mortar", tags, W, base, **mortar, **rubs, **condensed)
    if MPI.COMM_WORLD.rank == 0:
        write_curved()
        write_solid()
    MPI.COMM_WORLD.barrier()
    domain, tags = read("curved_blocks")
    W = fem.functionspace(domain, ("Lagrange", 2, (2,)))
    base, gap = cx.Surface(tags, 21), {"friction": 0.3, "offset": 0.01}
    solve("curved friction", tags, W, base, **gap)
    solve("curved mortar", tags, W, base, **mortar, **gap)
    domain, tags = read("solid_blocks")
    W = fem.functionspace(domain, ("Lagrange", 2, (3,)))
    base = cx.Surface(tags, 21)
    ball = cx.Sphere(centre=[0.75, 0.6, -4.0], radius=4.0)
    # Then from forms in C++
    for _ in range(2):
        solve("solid friction", tags, W, base, **rubs)
        solve("solid mortar", tags, W, base, **mortar, **rubs)
    solve("solid ball", tags, W, ball, friction=0.1, **little)
    solve("solid mortar ball", tags, W, ball, **mortar, friction=0.1, **little)


if __name__ == "__main__":
    main()
