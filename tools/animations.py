# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Make the small animations of the manual: ironing, a snap-fit, discs that settle in a box.

They come to docs/manual/pictures and are kept in the repository. Colours are the norm of Green's
strain in each cell.

Usage: tools/animations.py [ironing] [snap_fit] [settling_discs]
"""

from __future__ import annotations

import contactx as cx  # isort: skip

import sys
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

from mpi4py import MPI

import gmsh
import numpy as np
import numpy.typing as npt
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from PIL import Image

import ufl
from dolfinx import fem
from dolfinx.io import gmsh as gmshio

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "demos"))
PICTURES = ROOT / "docs" / "manual" / "pictures"
WIDTH, COLOURS, MILLISECONDS = 520, 48, 80


class Film:
    """Frames of a deforming plane mesh.

    Attributes:
        frames: What has been drawn.
    """

    def __init__(self, u: fem.Function, limits: tuple[float, ...], strain: float):
        """Prepare the drawing.

        Args:
            u: Displacement.
            limits: Least and largest x, least and largest y of the picture.
            strain: Strain of the darkest colour.
        """
        domain = u.function_space.mesh
        E = 0.5 * (ufl.grad(u).T * ufl.grad(u) + ufl.grad(u) + ufl.grad(u).T)
        Q = fem.functionspace(domain, ("DG", 0))
        self._expression = fem.Expression(ufl.sqrt(ufl.inner(E, E)), Q.element.interpolation_points)
        self._strain, self._u, self._limits, self._largest = fem.Function(Q), u, limits, strain
        self._X = u.function_space.tabulate_dof_coordinates()[:, :2]
        cells = u.function_space.dofmap.list
        # Corners of quadrilaterals in DOLFINx are not in a circle
        self._cells = cells[:, [0, 1, 3, 2]] if cells.shape[1] == 4 else cells
        self.frames: list[Image.Image] = []

    def draw(self, *lines: npt.ArrayLike) -> None:
        """Draw the mesh as it is now.

        Args:
            lines: Outlines of rigid bodies, shape (n, 2) each.
        """
        self._strain.interpolate(self._expression)
        x = self._X + self._u.x.array.reshape(-1, 2)
        left, right, low, high = self._limits
        height = WIDTH * (high - low) / (right - left)
        figure = Figure(figsize=(WIDTH / 100, height / 100), dpi=200)
        axis = figure.add_axes((0, 0, 1, 1))
        axis.add_collection(
            PolyCollection(
                x[self._cells],
                array=self._strain.x.array[: len(self._cells)],
                cmap="YlOrRd",
                clim=(0, self._largest),
                edgecolor="#55606a",
                linewidth=0.25,
            )
        )
        for line in lines:
            axis.plot(*np.asarray(line).T, color="#2f3a44", lw=1.5)
        axis.set(xlim=(left, right), ylim=(low, high), aspect="equal")
        axis.axis("off")
        self.frames.append(_image(figure))

    def save(self, path: Path) -> None:
        """Write the frames as a GIF that rests a little at its end."""
        width, height = self.frames[0].size
        some = self.frames[:: max(1, len(self.frames) // 8)]
        sheet = Image.new("RGB", (width, height * len(some)))
        for k, frame in enumerate(some):
            sheet.paste(frame, (0, height * k))
        # A tree keeps rare colours
        palette = sheet.quantize(COLOURS, Image.Quantize.FASTOCTREE)
        frames = [f.quantize(palette=palette, dither=Image.Dither.NONE) for f in self.frames]
        times = [MILLISECONDS] * (len(frames) - 1) + [1500]
        path.parent.mkdir(exist_ok=True)
        frames[0].save(
            path, save_all=True, append_images=frames[1:], duration=times, loop=0, optimize=True
        )
        print(f"{path.name}: {len(frames)} frames, {path.stat().st_size // 1000} kB", flush=True)


def _image(figure: Figure) -> Image.Image:
    """A figure as an image of the width of the film."""
    buffer = BytesIO()
    figure.savefig(buffer, dpi=200, facecolor="white")
    with Image.open(buffer) as opened:
        image = opened.convert("RGB")
    return image.resize(
        (WIDTH, round(image.height * WIDTH / image.width)), Image.Resampling.LANCZOS
    )


def ironing() -> Film:
    """A stiff die is pressed into a soft block and dragged over it, with friction."""
    from ironing import Ironing

    run = Ironing(1 / 12, 2, 0.3, "surface-to-surface")
    film = Film(run.u, (-0.15, 2.75, -0.75, 0.35), 0.5)
    film.draw()
    for step in cx.LoadSteps(run.problem, run.steps, update=run._move, progress=False):
        if step.index % 2 == 0:
            film.draw()
    return film


def settling_discs() -> Film:
    """Loose discs fall into a box and come to rest."""
    from settling_discs import Box

    box = Box(0.13)
    x = box.u.function_space.tabulate_dof_coordinates()
    width, high = 5.6, x[:, 1].max()
    wall = [(0, high), (0, 0), (width, 0), (width, high)]
    film = Film(box.u, (-0.15, width + 0.15, -0.1, high + 0.1), 0.05)
    film.draw(wall)
    for _ in box.fall():
        film.draw(wall)
    return film


def snap_fit() -> Film:
    """An elastic hook is pushed over a catch and snaps in, in time."""
    ARM, CATCH, HELD, GRIP, HOOK, BUMP = 1, 2, 3, 4, 5, 6
    shapes = {
        ARM: [
            (0, 0),
            (1.7, 0),
            (1.78, -0.22),
            (1.85, -0.22),
            (2.15, 0.04),
            (2.15, 0.12),
            (0, 0.12),
        ],
        CATCH: [
            (2.0, -0.5),
            (3.2, -0.5),
            (3.2, -0.26),
            (2.7, -0.26),
            (2.62, -0.1),
            (2.52, -0.1),
            (2.25, -0.34),
            (2.0, -0.34),
        ],
    }
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    geo = gmsh.model.geo
    lines: dict[int, list[int]] = {}
    for body, corners in shapes.items():
        points = [geo.addPoint(x, y, 0, 0.05) for x, y in corners]
        ends = zip(points, [*points[1:], points[0]], strict=True)
        lines[body] = [geo.addLine(a, b) for a, b in ends]
        surface = geo.addPlaneSurface([geo.addCurveLoop(lines[body])])
        geo.synchronize()
        gmsh.model.addPhysicalGroup(2, [surface], body)
    for tag, found in (
        (GRIP, [lines[ARM][6]]),
        (HOOK, lines[ARM][0:5]),
        (HELD, [lines[CATCH][0]]),
        (BUMP, lines[CATCH][2:7]),
    ):
        gmsh.model.addPhysicalGroup(1, found, tag)
    gmsh.model.mesh.generate(2)
    data = gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0, gdim=2)
    gmsh.finalize()
    domain, tags = data.mesh, data.facet_tags

    V = fem.functionspace(domain, ("Lagrange", 1, (2,)))
    u, v = fem.Function(V), ufl.TestFunction(V)

    def forces(w: ufl.core.expr.Expr) -> ufl.Form:
        F = ufl.variable(ufl.Identity(2) + ufl.grad(w))
        J = ufl.det(F)
        psi = 20 * (ufl.tr(F.T * F) - 2 - 2 * ufl.ln(J)) + 30 * ufl.ln(J) ** 2
        return ufl.inner(ufl.diff(psi, F), ufl.grad(v)) * ufl.dx

    push = fem.Constant(domain, np.zeros(2))
    bcs = [
        fem.dirichletbc(value, fem.locate_dofs_topological(V, 1, tags.find(tag)), V)
        for value, tag in ((push, GRIP), (np.zeros(2), HELD))
    ]
    contact = cx.Contact(cx.Surface(tags, HOOK), cx.Surface(tags, BUMP), friction=0.1)
    problem = cx.ContactDynamics(
        forces, u, density=2e-3, contacts=[contact], bcs=bcs, petsc_options_prefix="snap_"
    )

    def update(t: float) -> None:  # the rest of the time is for the hook to come to rest
        push.value[0] = 0.92 * min(t / 10, 1.0)

    film = Film(u, (-0.05, 3.3, -0.55, 0.4), 0.012)
    film.draw()
    for step in cx.LoadSteps(problem, 180, update=update, t_end=12.0, progress=False):
        if step.index % 3 == 0:
            film.draw()
    return film


FILMS: dict[str, Callable[[], Film]] = {
    "ironing": ironing,
    "snap_fit": snap_fit,
    "settling_discs": settling_discs,
}


def main(wanted: list[str]) -> None:
    """Make the films."""
    for name in wanted or FILMS:
        FILMS[name]().save(PICTURES / f"{name}.gif")


if __name__ == "__main__":
    main(sys.argv[1:])
