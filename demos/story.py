# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the demos share: arguments, linear elasticity, the table of results, pictures."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt
from rich.console import Console
from rich.table import Table

import contactx as cx
import ufl
from dolfinx import fem, mesh

import plot
import reference

# One rank speaks for all
console = Console(quiet=MPI.COMM_WORLD.rank > 0)
METHODS = ("node-to-surface", "surface-to-surface")


def wide_console(width: int = 120) -> Console:
    """A console for tables that do not fit into 80 columns, where there is no terminal."""
    return Console(width=width, quiet=MPI.COMM_WORLD.rank > 0)


def show_table(
    title: str, names: Sequence[str], rows: Sequence[Sequence[str]], width: int = 120
) -> None:
    """Print a table that needs a width; where there is no terminal it has that."""
    table = Table(title=title)
    for name in names:
        table.add_column(name, justify="right")
    for row in rows:
        table.add_row(*row)
    (console if console.width >= width else wide_console(width)).print(table)


@dataclass(frozen=True)
class Result:
    """A number that a demo computes and a formula gives.

    Where 0 is expected, there is nothing that an error could be relative to: what is computed is
    taken over something of its kind already, and the name says over what.
    """

    name: str
    expected: float
    computed: float

    @property
    def error(self) -> float:
        """Relative error; what is computed itself where 0 is expected."""
        return self.computed / self.expected - 1 if self.expected != 0 else self.computed

    @classmethod
    def of_curves(
        cls, name: str, weights: np.ndarray, computed: np.ndarray, exact: np.ndarray
    ) -> Result:
        """L2 norm of the difference of two curves over that of the exact one.

        Args:
            name: Of what is compared.
            weights: Areas of the nodes, shape (n,).
            computed: Nodal values, shape (n,).
            exact: Those of a formula, shape (n,).
        """
        norm, difference = (float(np.sqrt(weights @ y**2)) for y in (exact, computed - exact))
        return cls(name, 0.0, difference / norm)


def displacement(domain: mesh.Mesh, degree: int = 1) -> fem.Function:
    """Displacement in the Lagrange space of vectors of a degree."""
    V = fem.functionspace(domain, ("Lagrange", degree, (domain.geometry.dim,)))
    return fem.Function(V, name="displacement")


def constants(u: fem.Function, *values: Any) -> Iterator[Any]:
    """Values of a form; numbers as constants, so that what is compiled serves others, too."""
    for value in values:
        is_number = isinstance(value, int | float)
        yield fem.Constant(u.function_space.mesh, float(value)) if is_number else value


def elasticity(u: fem.Function, young: Any, nu: float) -> ufl.Form:
    """Residual of linear elasticity, in plane strain where the mesh is plane."""
    v = ufl.TestFunction(u.function_space)
    young, nu = constants(u, young, nu)
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    strain = ufl.sym(ufl.grad(u))
    stress = 2 * mu * strain + lmbda * ufl.tr(strain) * ufl.Identity(len(u))
    return ufl.inner(stress, ufl.grad(v)) * ufl.dx


def traction(u: fem.Function, tags: mesh.MeshTags, face: int, load: fem.Constant) -> ufl.Form:
    """Residual of a force per reference area on a tagged face."""
    ds = ufl.Measure("ds", domain=u.function_space.mesh, subdomain_data=tags)
    return -ufl.inner(load, ufl.TestFunction(u.function_space)) * ds(int(face))


def fix(
    u: fem.Function, tags: mesh.MeshTags, component: int, value: float, *faces: int
) -> fem.DirichletBC:
    """Prescribe one component of the displacement on tagged faces."""
    V = u.function_space.sub(component)
    facets = np.concatenate([tags.find(face) for face in faces])
    dofs = fem.locate_dofs_topological(V, tags.dim, facets)
    return fem.dirichletbc(np.float64(value), dofs, V)


def arguments(
    description: str,
    h: float,
    unit: str,
    argv: Sequence[str] | None,
    dimensions: Sequence[int] = (),
    methods: bool = False,
) -> argparse.Namespace:
    """Read the command line: size h, sliding, folder of the pictures.

    Args:
        description: What the demo shows.
        h: Default of the size.
        unit: Unit of the size.
        argv: The command line; that of the process if None.
        dimensions: Dimensions of space to choose from, the default first; no choice if empty.
        methods: Whether the method of contact can be chosen.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--h", type=float, default=h, help=f"cell size in the contact, {unit}")
    parser.add_argument(
        "--sliding", choices=("finite", "small"), default="finite", help="kinematics of contact"
    )
    parser.add_argument(
        "--output",
        type=Path,
        default=Path(__file__).parent / "output",
        help="folder for pictures and files",
    )
    if dimensions:
        parser.add_argument(
            "--dim", type=int, choices=dimensions, default=dimensions[0], help="dimension of space"
        )
    if methods:
        parser.add_argument(
            "--method", choices=METHODS, default=METHODS[0], help="discretisation of contact"
        )
    return parser.parse_args(argv)


@contextmanager
def progress(text: str) -> Iterator[Callable[[str], None]]:
    """Show what is going on; yields a function that changes the text."""
    with console.status(text) as status:
        yield status.update


def solve(problem: cx.ContactProblem) -> None:
    """Solve and show the iterations as they come."""
    with progress("solving") as show:

        def monitor(*_: object) -> None:
            row = problem.report.history[-1]
            show(
                f"solving: iteration {row.number}, residual {row.residual:.1e} "
                f"(to reach {row.tolerance:.1e}), {row.closed} nodes in contact"
            )

        problem.solver.setMonitor(monitor)
        problem.solve()
        # It refers to the problem, and PETSc would keep both for ever
        problem.solver.cancelMonitor()
    console.print(str(problem.report), highlight=False)


def nodal_pressure(contact: cx.Contact) -> npt.NDArray[np.float64]:
    """Pressures of the slave nodes, shape (n,)."""
    pressure: npt.NDArray[np.float64] = contact.pressure.x.array[contact.slave_nodes]
    return pressure


def show(title: str, results: Sequence[Result]) -> None:
    """Print the results against the formula: before pictures, which need packages of their own."""
    table = Table("", "expected", "computed", "error", title=title)
    for r in results:
        table.add_row(r.name, f"{r.expected:.6g}", f"{r.computed:.6g}", f"{100 * r.error:+.2f} %")
    console.print(table)


def see(files: Sequence[Path]) -> None:
    """Print where the pictures are."""
    for file in files:
        console.print(f"see {file}", soft_wrap=True, highlight=False)


def draw(
    name: str,
    title: str,
    folder: Path,
    problem: cx.ContactProblem,
    contact: cx.Contact,
    r: np.ndarray,
    hertz: Any,
    mirror: Sequence[str],
) -> list[Path]:
    """Draw the bodies and the pressure against Hertz, and write a file for ParaView.

    Args:
        name: First part of the files' names.
        title: Title of the picture of the bodies.
        folder: Where the files go.
        problem: Solved problem.
        contact: Its contact.
        r: Distance of the slave nodes from the axis, shape (n,).
        hertz: Closed formula, with ``pressure``.
        mirror: Planes of symmetry.

    Returns:
        The files.
    """
    pressure = nodal_pressure(contact)
    end = 1.5 * r[pressure > 0].max()
    curve = np.linspace(0, end, 400)
    return pictures(
        folder / name,
        title,
        problem,
        contact,
        (r[r < end], pressure[r < end]),
        (curve, hertz.pressure(curve)),
        ("distance from the axis / R", "Hertz"),
        mirror,
    )


def pictures(
    stem: Path,
    title: str,
    problem: cx.ContactProblem,
    contact: cx.Contact,
    computed: tuple[npt.ArrayLike, npt.ArrayLike],
    exact: tuple[npt.ArrayLike, npt.ArrayLike],
    words: tuple[str, str],
    mirror: Sequence[str] = (),
) -> list[Path]:
    """Draw the bodies and their pressure against a curve, and write a file for ParaView.

    Args:
        stem: Folder and first part of the files' names.
        title: Title of the picture of the bodies.
        problem: Solved problem.
        contact: Its contact.
        computed: Places and pressures of slave nodes, each of shape (n,).
        exact: Places and pressures of the curve, each of shape (m,).
        words: What the places are, and whose the curve is.
        mirror: Planes of symmetry.

    Returns:
        The files.
    """
    files = [stem.with_name(stem.name + end) for end in (".png", "_pressure.png", ".pvd")]
    label = "contact pressure / E"
    with progress("drawing"):
        with cx.VTKOutput(files[2], problem.u, [contact]) as output:
            output.write(0.0)
        plot.deformed_bodies(
            problem.u, contact.pressure, files[0], title=title, label=label, mirror=mirror
        )
        plot.pressure_curve(
            *computed,
            *exact,
            files[1],
            labels=(words[0], label),
            title=f"Pressure of the slave nodes against {words[1]}",
        )
    return files


def hertz(
    name: str,
    title: str,
    folder: Path,
    problem: cx.ContactProblem,
    contact: cx.Contact,
    modulus: float,
) -> list[Result]:
    """Compare a quarter of a point contact of radius 1 about the z-axis with Hertz, and draw it."""
    x = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    r, p = np.hypot(x[:, 0], x[:, 1]), nodal_pressure(contact)
    force = 4 * abs(contact.force[2])
    exact = reference.HertzSphere(force=force, radius=1.0, modulus=modulus)
    radius = np.sqrt(4 * contact.area[p > 0].sum() / np.pi)
    results = [
        Result("force, sum of the pressures", force, 4 * np.dot(contact.area, p)),
        Result("contact radius", exact.contact_radius, radius),
        Result("peak pressure", exact.peak_pressure, p.max()),
    ]
    show(title, results)
    see(draw(name, title, folder, problem, contact, r, exact, mirror=("x", "y")))
    return results
