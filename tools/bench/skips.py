# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a scene does not need, and the same scene with it.

What cannot be switched off from outside is switched off here by replacing a part of the library:
the library has no options for doing needless work.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

import contactx as cx
from contactx import cpp as core
from contactx._host import linear
from contactx._host.blocks import Blocks
from contactx.assembler import ContactAssembler
from dolfinx.io.gmsh import MeshData
from dolfinx.mesh import CellType

import meshes
import scenes
import story
from meshes import Tag
from scenes.tuning import tuned

# Not the default on the coarse meshes that try these scripts out
CONDENSED: dict[str, Any] = {"petsc_options": {"pc_type": "condensed"}}
DIRECT: dict[str, Any] = {"petsc_options": {"pc_type": "lu"}}


def hertz(data: MeshData, n: int, **options: Any) -> cx.ContactProblem:
    """The common Hertz problem."""
    return scenes.HertzSphere(data, **options).problem


def on_plane(data: MeshData, n: int, sliding: str, **options: Any) -> cx.ContactProblem:
    """Its upper body alone, on a rigid plane."""
    mesh, tags = meshes.single(data, Tag.UPPER)
    u = story.displacement(mesh)
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.UPPER_X0),
        story.fix(u, tags, 1, 0.0, Tag.UPPER_Y0),
        story.fix(u, tags, 2, -0.02, Tag.UPPER_TOP),
    ]
    plane = cx.Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    contact = cx.Contact(cx.Surface(tags, Tag.UPPER_CONTACT), plane, sliding=sliding)
    return cx.ContactProblem(
        story.elasticity(u, 1.0, scenes.NU),
        u,
        contacts=[contact],
        bcs=bcs,
        petsc_options_prefix="sphere_",
        **options,
    )


def blocks(
    data: MeshData,
    n: int,
    sliding: str,
    *,
    petsc_options: dict[str, Any],
    rounded: float = 0.0,
    **options: Any,
) -> cx.ContactProblem:
    """Two blocks on even grids, n cells high; the lower side of the upper one may be rounded.

    No node of the contact is on a plane of symmetry, where friction is not condensed.
    """
    scene = scenes.Blocks(CellType.tetrahedron, n_upper=n, n_lower=n + 3, gap=1e-6, down=0.02)
    x = scene.u.function_space.mesh.geometry.x
    upper = x[:, 2] > 5e-7
    middle = x[upper, :2].mean(axis=0)
    x[upper, 2] += rounded * ((x[upper, :2] - middle) ** 2).sum(axis=1)
    return scene.problem(scene.contact(sliding, **options), petsc_options=petsc_options)


@dataclass(frozen=True)
class Skip:
    """A rule by which the library skips what a scene does not need.

    Attributes:
        instead: What is done without it.
        part: The timer of the report that it is about; the whole if empty.
        scene: Makes the problem of a mesh, a number of cells and options.
        scene_off: The same without the rule, if another one.
        on: Options of the scene.
        off: Options of the scene without the rule, added to the others.
        replaced: What switches the rule off in the library.
    """

    instead: str
    part: str = ""
    scene: Callable[..., cx.ContactProblem] = hertz
    scene_off: Callable[..., cx.ContactProblem] | None = None
    on: dict[str, Any] = field(default_factory=dict)
    off: dict[str, Any] = field(default_factory=dict)
    replaced: Callable[[], AbstractContextManager[None]] = nullcontext

    def problem(self, data: MeshData, n: int, *, off: bool) -> cx.ContactProblem:
        """The problem with the rule, or without it."""
        options = {"sliding": "small", **CONDENSED, **self.on, **(self.off if off else {})}
        scene = self.scene_off if off and self.scene_off else self.scene
        return scene(data, n, **options)


@contextmanager
def _replaced(owner: Any, **values: Any) -> Iterator[None]:
    """Give attributes of a class or module other values; they must exist."""
    before = {name: getattr(owner, name) for name in values}
    for name, value in values.items():
        setattr(owner, name, value)
    try:
        yield
    finally:
        for name, value in before.items():
            setattr(owner, name, value)


def _jacobian_each_time() -> AbstractContextManager[None]:
    """The bulk's Jacobian as one that depends on the displacement."""
    before = Blocks.__init__

    def init(self: Blocks, *args: Any) -> None:
        before(self, *args)
        self._coefficients += [w._cpp_object for w in self.functions]

    return _replaced(Blocks, __init__=init)


def _pattern_each_time() -> AbstractContextManager[None]:
    """A new matrix for each factorisation."""
    before = linear.SaddlePoint.update

    def update(self: linear.SaddlePoint, *args: Any, **kwargs: Any) -> None:
        self.reset()
        before(self, *args, **kwargs)

    return _replaced(linear.SaddlePoint, update=update)


@contextmanager
def _search_anew() -> Iterator[None]:
    """Each search also builds a tree and asks it for all nodes; its answer is dropped.

    So pairs and iterations stay the same; the search that the library does comes on top.
    """
    collect = ContactAssembler._collect

    def search_too(self: ContactAssembler) -> None:
        with self.report.timing("settle"):
            for discrete in self.discrete_contacts:
                master, slave = discrete.master, discrete.slave_nodes.facets
                if isinstance(master, core.DeformableMaster):
                    x, closed = discrete.positions(), discrete.nodes.closed.astype(np.int8)
                    lists = (*slave, *master.surface.facets)
                    core.Pairing(*lists, x.shape[1]).update(x, master.reach, closed)
        collect(self)

    with _replaced(ContactAssembler, _collect=search_too):
        yield


SKIPS = {
    "no tangential unknowns": Skip("friction 1e-8", scene=blocks, off={"friction": 1e-8}),
    "no master side": Skip(
        "a block of 1e6 E",
        scene=on_plane,
        scene_off=hertz,
        off={"young": {Tag.LOWER: 1e6}},
    ),
    "only nodes in reach": Skip(
        "all nodes have pairs",
        scene=blocks,
        on={"search_distance": 0.05, "sliding": "finite", "rounded": 0.5},
        off={"search_distance": None},
    ),
    "bulk Jacobian once": Skip("assembled when u changes", replaced=_jacobian_each_time),
    "hierarchies kept": Skip(
        "one for each solve", "hierarchy", replaced=partial(tuned, renewal_cost=-1)
    ),
    "matrix's pattern kept": Skip("a new one each time", on=DIRECT, replaced=_pattern_each_time),
    "rough early solves": Skip(
        "all to the tolerance", "Krylov", replaced=partial(tuned, roughness=1e-9)
    ),
    "pairs kept, tree refitted": Skip(
        "built, searched anew", "settle", on={"sliding": "finite"}, replaced=_search_anew
    ),
    "small sliding": Skip("finite sliding", off={"sliding": "finite"}),
}
