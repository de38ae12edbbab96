# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes of several load steps, and steps that are gone on with from a checkpoint."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.blocks import NU, Blocks
from scenes.materials import Plastic, neo_hookean
from scenes.problems import make_problem
from story import displacement, fix, traction


def state(problem: cx.ContactProblem, *history: fem.Function) -> list[bytes]:
    """Bits of all that a failed step must leave as it was."""
    arrays = [problem.u.x.array, *(f.x.array for f in history)]
    for contact in problem.contacts:
        arrays += contact.discrete.save().values()
        for value in vars(contact.fields).values():
            if isinstance(value, fem.Function):
                arrays.append(value.x.array)
        arrays += [contact.discrete.nodes.immobile]
        arrays += [contact.fields.force, contact.fields.imbalance]
    return [np.ascontiguousarray(array).tobytes() for array in arrays]


class Sheared:
    """A neo-Hookean block on a rigid plane; its top moves down and far sideways.

    One step takes more iterations than it is given, a few go through; deeper than its height none
    does.
    """

    def __init__(self, *, far: float = 3.0, deep: float = 0.5, **options: Any):
        data = meshes.blocks(CellType.triangle, (3, 3), (1, 1))
        mesh, tags = meshes.single(data, Tag.UPPER)
        self.tags = tags
        self.u = u = displacement(mesh)
        self.far, self.deep = far, deep
        self.bcs = [
            fix(u, tags, 0, 0.0, Tag.UPPER_CONTACT),
            *(fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(2)),
        ]
        self.normal = fem.Constant(mesh, np.array([0.0, 1.0]))
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT), cx.Plane((0.0, 0.0), self.normal)
        )
        self.problem = make_problem(
            neo_hookean(u, 2.6, 0.3),
            u,
            [self.contact],
            self.bcs,
            petsc_options={"snes_max_it": 7, **options},
        )
        self.history = fem.Function(fem.functionspace(mesh, ("DG", 0)))
        self.calls: list[float] = []

    def update(self, t: float) -> None:
        self.calls.append(t)
        self.bcs[1].g.value[...] = self.far * t
        self.bcs[2].g.value[...] = -self.deep * t

    def state(self) -> list[bytes]:
        """Bits of what a failed step must leave alone."""
        return state(self.problem, self.history)

    def steps(self, steps: Any, **options: Any) -> cx.LoadSteps:
        options = {"history": [self.history], "progress": False, **options}
        return cx.LoadSteps(self.problem, steps, options.pop("update", self.update), **options)


class SlidingBlocks:
    """The two blocks, the upper one pressed and pushed over the edges of the lower one's facets."""

    def __init__(self, cell_type: CellType, **options: Any):
        scene = Blocks(cell_type, n_upper=3, n_lower=4)
        self.u = scene.u
        upper, lower = (cx.Surface(scene.tags, t) for t in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT))
        self.contact = cx.Contact(upper, lower, **options)
        self.problem = scene.problem(self.contact)
        self.history: list[fem.Function] = []
        self._down, self._side = scene.bcs[-1], scene.bcs[-2]

    def update(self, t: float) -> None:
        self._down.g.value[...] = -0.1 * t
        self._side.g.value[...] = 0.4 * t

    def commit(self) -> None:
        """There is no history."""


class LooseBlock:
    """The upper block lies on the lower one, which alone holds it, and is pressed by a load."""

    def __init__(self) -> None:
        scene = Blocks(CellType.quadrilateral, n_upper=3, n_lower=4)
        self.u, mesh = scene.u, scene.u.function_space.mesh
        v = ufl.TestFunction(self.u.function_space)
        self._load = fem.Constant(mesh, 0.0)
        ds = ufl.Measure("ds", mesh, subdomain_data=scene.tags)
        scene.F += self._load * v[1] * ds(Tag.UPPER_TOP)
        scene.bcs = scene.bcs[:2]
        self.contact = scene.contact("small")
        self.problem = scene.problem(self.contact)
        self.history: list[fem.Function] = []

    def update(self, t: float) -> None:
        self._load.value = 0.05 + 0.1 * t

    def commit(self) -> None:
        """There is no history."""


class DentedBlock:
    """A plastic block under a rigid ball that moves down, and up again, and sideways."""

    def __init__(self, aside: float = 0.1, **options: Any):
        self._aside = aside
        data = meshes.blocks(CellType.tetrahedron, (1, 1, 1), (4, 4, 4))
        mesh, tags = meshes.single(data, Tag.LOWER)
        self.u = displacement(mesh)
        self.material = Plastic(self.u)
        self.history = [self.material.plastic, self.material.equivalent]
        self._centre = fem.Constant(mesh, np.array([0.5, 0.5, 1.0]))
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.LOWER_CONTACT), cx.Sphere(self._centre, 1.0), **options
        )
        self.problem = make_problem(
            self.material.F,
            self.u,
            [self.contact],
            [fix(self.u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)],
            petsc_options={"snes_linesearch_type": "bt"},
        )

    def update(self, t: float) -> None:
        self._centre.value[0] = 0.5 + self._aside * t
        self._centre.value[2] = 1 - 0.1 * min(t, 1.55 - t)

    def commit(self) -> None:
        """Take over the plastic strains."""
        self.material.commit()


class Rubbing:
    """Two blocks that rub, with a switch for each thing that may become bad.

    Attributes:
        history: A function that belongs to the state.
    """

    def __init__(self, method: str = "node-to-surface", solver: str = "lu", **kind: Any):
        self.blocks = blocks = Blocks(CellType.quadrilateral, n_upper=3, n_lower=4)
        self.u, domain = blocks.u, blocks.u.function_space.mesh
        self.young, self.tangent = fem.Constant(domain, 1.0), fem.Constant(domain, 1.0)
        self.load = fem.Constant(domain, (0.0, 0.0))
        blocks.F = neo_hookean(self.u, self.young, NU, degree=3) + traction(
            self.u, blocks.tags, Tag.UPPER_X0, self.load
        )
        self.friction, self.offset = blocks.scalar(0.2), blocks.scalar(0.0)
        kind = {"friction": self.friction, **kind}
        self.contact = blocks.contact(method=method, offset=self.offset, **kind)
        self.problem = blocks.problem(
            self.contact,
            J=self.tangent * ufl.derivative(blocks.F, self.u),
            petsc_options={"pc_type": solver},
        )
        self._down, self._side = blocks.bcs[-1], blocks.bcs[-2]
        self.history = fem.Function(fem.functionspace(domain, ("DG", 0)))

    def update(self, t: float) -> None:
        """Press, and push to and fro."""
        self._down.g.value[...] = -0.08 * min(2 * t, 1)
        self._side.g.value[...] = 0.3 * np.sin(2 * np.pi * t)

    def state(self) -> list[bytes]:
        """Bits of the state."""
        return state(self.problem, self.history)

    def steps(self, steps: Any, **options: Any) -> cx.LoadSteps:
        """Load steps without a display."""
        options = {"history": [self.history], "progress": False, **options}
        return cx.LoadSteps(self.problem, steps, options.pop("update", self.update), **options)

    def run(self, steps: cx.LoadSteps) -> None:
        """Take the steps that are left; a material would remember each of them."""
        for step in steps:
            self.history.x.array[:] = 2 * self.history.x.array + step.index


KINDS: dict[str, dict[str, Any]] = {
    "nodes": {},
    "facets": {"method": "surface-to-surface"},
    "condensed": {"solver": "condensed"},
    "small": {"sliding": "small"},
    "tied": {"tied": True, "friction": 0.0},
    "frictionless": {"friction": 0.0},
}
FACETS = {"method": "surface-to-surface"}
SCENES = {
    "triangles": lambda: SlidingBlocks(CellType.triangle),
    "hexahedra": lambda: SlidingBlocks(CellType.hexahedron),
    "small sliding": lambda: SlidingBlocks(CellType.tetrahedron, sliding="small"),
    "friction": lambda: SlidingBlocks(CellType.tetrahedron, friction=0.2),
    # One pair goes back and forth and is frozen
    "friction, plane": lambda: SlidingBlocks(CellType.quadrilateral, friction=0.2),
    "friction, small": lambda: SlidingBlocks(CellType.triangle, friction=0.2, sliding="small"),
    "tied": lambda: SlidingBlocks(CellType.tetrahedron, tied=True, offset=0.01),
    "facets, small": lambda: SlidingBlocks(CellType.hexahedron, sliding="small", **FACETS),
    "facets, friction": lambda: SlidingBlocks(CellType.tetrahedron, friction=0.2, **FACETS),
    "free body": LooseBlock,
    "plastic under a ball": DentedBlock,
    "plastic with friction": lambda: DentedBlock(friction=0.3),
    "plastic, tied to a ball": lambda: DentedBlock(0.01, tied=True, search_distance=0.03),
}
# The rest takes longer
QUICK = ("friction, plane", "facets, small", "plastic, tied to a ball")


def run(scene: Any, until: int | None = None, **options: Any) -> tuple[list[bytes], cx.LoadSteps]:
    """Take steps, six in all if none is cut, and return the bits of their results."""
    steps = cx.LoadSteps(
        scene.problem, 6, scene.update, history=scene.history, progress=False, **options
    )
    for step in steps:
        scene.commit()
        if step.index == until:
            break
    discrete = scene.contact.discrete
    arrays = [scene.u.x.array, *(f.x.array for f in scene.history)]
    arrays += [*discrete.save().values(), scene.contact.force]
    return [a.tobytes() for a in arrays], steps


def check_restart(name: str, file: Path) -> None:
    """Steps that are gone on with from a file end in the same bits as without it."""
    first = SCENES[name]()
    straight, _ = run(first)
    assert first.contact.multiplier.any()
    assert all(f.x.array.any() for f in first.history)
    middle, _ = run(SCENES[name](), until=4, checkpoint=file)
    assert middle != straight
    scene = SCENES[name]()
    restarted, steps = run(scene, restart=file)
    assert restarted == straight
    assert steps.t == 1
    lines = [line.split("│")[1:3] for line in steps.table().splitlines() if "│" in line]
    assert [int(index) for index, _ in lines] == list(range(1, len(lines) + 1))
    assert np.all(np.diff([float(t) for _, t in lines]) > 0)
