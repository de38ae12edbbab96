# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Blocks that stick, slide and slide back, in partial slip, over many facets and over edges."""

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import CELLS, dimension
from scenes.coulomb import parts
from scenes.covering import BOTH, METHODS, SLIDINGS, covering
from scenes.driven import DrivenBlock
from scenes.grids import chosen, create, grid, middles, outside
from scenes.problems import make_problem
from story import displacement, elasticity

pytestmark = pytest.mark.usefixtures("method")


MU = 0.3
DOWN = -0.02
BASES = ("plane", "elastic")


def block(cell, base, sliding, **options):
    """A block above a plane or a base whose divisions do not match."""
    gdim = dimension(cell)
    up = (0.0,) * (gdim - 1) + (1.0,)
    plane = cx.Plane((0.0,) * gdim, up) if base == "plane" else None
    return DrivenBlock(cell, plane=plane, sliding=sliding, friction=MU, **options)


def along(scene, x, down=DOWN):
    """Move the top along the first axis."""
    scene.step(x, *(0.0,) * (scene.gdim - 2), down)


def resistance(scene):
    """Friction along the movement over what full sliding would give, with its sign."""
    return scene.tangential[0] / (MU * scene.normal)


@covering(cell=CELLS, base=BASES, **{"sliding,method": BOTH})
def test_stays_slides_and_slides_back(cell, base, sliding):
    scene = block(cell, base, sliding)
    along(scene, 0.0)
    path = []
    for x in (0.002, 0.004, 0.006, 0.05, 0.1, 0.098, 0.096, 0.05, 0.0, 0.002, 0.05, 0.1):
        along(scene, x)
        path.append(resistance(scene))
        if x in (0.05, 0.1, 0.0):
            p, t = parts(scene.contact)
            assert (scene.contact.status.x.array != 1).all()
            total = scene.contact.area @ np.linalg.norm(t, axis=1)
            assert total == pytest.approx(MU * (scene.contact.area @ p), rel=1e-8)
    print(scene.iterations, [f"{r:+.4f}" for r in path])
    path = np.array(path)
    # Sticking the force grows against the movement, and stays below friction times pressure
    assert np.all(np.diff(path[:3]) < 0)
    assert np.all(np.abs(path[:3]) < 0.9)
    # Slides in the normals of a dented base, or across a little in 3D
    loose = 0.02 if (scene.gdim == 3 or (base, sliding) == ("elastic", "finite")) else 1e-8
    assert path[3:5] == pytest.approx(-1, abs=loose)
    assert -1 < path[5] < path[6] < 0.9
    assert path[7:9] == pytest.approx(1, abs=loose)
    assert -0.9 < path[9] < 1
    assert path[10:] == pytest.approx(-1, abs=loose)
    # The loop closes: the same place after the same reversal has the same force
    assert path[11] == pytest.approx(path[4], abs=1e-3)
    assert max(scene.iterations) <= 10


@covering(base=BASES, sliding=SLIDINGS, method=METHODS)
def test_circular_path(base, sliding):
    """Friction opposes the velocity in every step once all slide."""
    scene = block(CellType.hexahedron, base, sliding, n_upper=2, n_lower=3)
    radius, steps = 0.3, 12
    scene.step(0, 0, DOWN)
    before = np.zeros(2)
    off = []
    for k in range(1, steps + 1):
        angle = 2 * np.pi * k / steps
        place = radius * np.array([np.cos(angle) - 1, np.sin(angle)])
        scene.step(*place, DOWN)
        p, t = parts(scene.contact)
        slip = scene.contact.discrete.history.slip
        assert (scene.contact.discrete.nodes.status == 2).all()
        against = np.einsum("ij,ij->i", t, slip) / np.linalg.norm(slip, axis=1)
        assert against == pytest.approx(-MU * p, rel=1e-8)
        # The block is elastic: its foot lags behind its top
        way = place - before
        before = place
        cosine = -scene.tangential @ way / np.linalg.norm(way) / np.linalg.norm(scene.tangential)
        off.append(np.degrees(np.arccos(cosine)))
    print(scene.iterations, f"{max(off):.2f} degrees off")
    assert max(off) < 5


def test_a_foot_that_opens_only_where_its_slip_turns_back():
    """With strong friction sticking presses the foot down, and so does slip on the way there."""
    plane = cx.Plane((0.0, 0.0), (0.0, 1.0))
    scene = DrivenBlock(CellType.triangle, plane=plane, friction=2.0, sliding="small", n_upper=2)
    for top in [(0, -0.03), (-0.0138, -0.01986), (0.05158, -0.005)]:
        scene.step(*top)
    scene.step(0.10671, 0.02)
    assert scene.iterations[-1] <= 12
    assert scene.count == {"open": 3, "stick": 0, "slip": 0}


@pytest.mark.parametrize("gap", [0.0, 0.01])
def test_a_foot_that_slip_pulls_off_and_stick_holds(gap):
    ball = cx.Sphere((0.5, -3.0), 3.0)
    scene = DrivenBlock(
        CellType.triangle, plane=ball, friction=2.0, sliding="small", n_upper=2, gap=gap
    )
    for top in [(0, -0.03), (0.14877, -0.02271)]:
        scene.step(*top)
    scene.step(0.01504, -0.02146)
    assert scene.iterations[-1] <= 35


@covering(
    cell=(CellType.quadrilateral, CellType.hexahedron),
    base=("plane", "elastic"),
    friction=(0.3, 1.0),
    **{"sliding,method": BOTH},
)
def test_every_reversal_converges(friction, cell, base, sliding):
    """Between a full slide on and a full slide back there are all mixtures of them."""
    gdim, n = (2, 8) if cell == CellType.quadrilateral else (3, 3)
    up = (0.0,) * (gdim - 1) + (1.0,)
    plane = cx.Plane((0.0,) * gdim, up) if base == "plane" else None
    across = (0.0,) * (gdim - 2)
    iterations, mixed = [], 0
    scene = DrivenBlock(
        cell, plane=plane, sliding=sliding, friction=friction, n_upper=n, n_lower=2 * n
    )
    scene.step(0.0, *across, -0.02)
    for back in (0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.04, 0.06):
        scene.step(0.15, *across, -0.02)
        scene.step(0.15 - back, *across, -0.02)
        iterations.append(scene.iterations[-1])
        mixed += scene.count["stick"] > 0 and scene.count["slip"] > 0
    print(iterations, f"{mixed} mixed, most {max(scene.iterations)}")
    assert mixed > 0
    assert max(scene.iterations) <= 12


def block_on_fixed_base(cell, n_lower, **options):
    """A block on a flat base that is fixed everywhere; nu = 0 keeps it from moving across."""
    return DrivenBlock(
        cell, n_upper=3, n_lower=n_lower, nu=0.0, friction=MU, rigid_base=True, **options
    )


def facets(scene):
    """Nodes of the facet that each slave node is paired with."""
    result = [()] * len(scene.contact.area)
    for pairs in scene.contact.discrete.master.pairs():
        for slave, nodes in zip(pairs.slaves[:, 0], pairs.nodes[:, 1:], strict=True):
            result[slave] = tuple(nodes)
    return result


def check_full_slide(scene, exact, method):
    """All slide against friction times pressure; returns the size of the friction force.

    Args:
        method: By surface-to-surface normals are the slave's, which bends at its free edges.
    """
    contact = scene.contact
    p, t = parts(contact)
    w = contact.area
    assert np.all(contact.discrete.nodes.status[p > 0] == 2)
    assert w @ np.linalg.norm(t, axis=1) == pytest.approx(MU * (w @ p), rel=1e-8)
    flat = method == "node-to-surface"
    assert scene.normal == pytest.approx(w @ p, rel=1e-12 if flat else 0.02)
    size = np.linalg.norm(scene.tangential)
    assert size == pytest.approx(MU * scene.normal, rel=(1e-8 if exact else 1e-3) if flat else 0.1)
    return size


@covering(cell=CELLS, n_lower=(2, 5, 12), direction=[(1.0, 0.0), (0.6, 0.8)], method=METHODS[:1])
def test_many_facets_in_one_step(direction, n_lower, cell, method):
    """Facets of 1.5, 0.6 and 0.25 under a block whose nodes stand 0.33 apart."""
    scene = block_on_fixed_base(cell, n_lower)
    across = np.array(direction[: scene.gdim - 1]) if scene.gdim == 3 else np.array([1.0])
    # nu = 0 keeps hexahedra from moving across an axis
    exact = scene.gdim == 2 or (cell == CellType.hexahedron and direction[1] == 0)
    scene.step(*0 * across, -0.02)
    place = 0 * across
    crossed = []
    for length in (0.4, 0.6, -1.3, 0.5):
        place = place + length * across
        before = facets(scene)
        scene.step(*place, -0.02)
        crossed.append(np.mean([a != b for a, b in zip(before, facets(scene), strict=True)]))
        size = check_full_slide(scene, exact, method)
        cosine = -np.sign(length) * (scene.tangential @ across) / size
        assert cosine == pytest.approx(1, abs=1e-8 if exact else 1e-2)
    print(scene.iterations, "changed facet:", crossed)
    assert max(crossed) > (0.5 if n_lower == 2 else 0.9)
    assert max(scene.iterations) <= 10


@covering(cell=CELLS, method=METHODS)
def test_over_the_outer_edge(cell, method):
    """Nodes beyond the edge open; the others go on with friction times what they carry."""
    scene = block_on_fixed_base(cell, 4, width=2.0, shift=0.55)
    zero = (0.0,) * (scene.gdim - 2)
    open_nodes = []
    for x in (0.0, 0.3, 0.7, 1.0, 1.2):
        scene.step(x, *zero, -0.02)
        open_nodes.append(int((scene.contact.discrete.nodes.status == 0).sum()))
        if x > 0:
            check_full_slide(scene, cell != CellType.tetrahedron, method)
    print(scene.iterations, open_nodes)
    # A block that hangs over tilts and may lift one more
    assert open_nodes[:2] == [0, 0]
    if method == "node-to-surface":
        assert open_nodes[2] >= scene.gdim**2 // 4
    else:
        # Part of its facets still carries
        assert open_nodes[-1] >= scene.gdim**2 // 4
    assert np.all(np.diff(open_nodes) >= 0)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("cells", [4, 8])
def test_guided_down_a_slope_the_force_is_on_the_cone(method, cells):
    """Guides hold slave nodes where the base is free: they are no planes of symmetry."""
    friction = 0.1
    domain = create(grid([0.0, 0.0], [2.0, 1.0], [10, 5]), grid([0.7, 1.0], [1.3, 1.5], [cells, 4]))
    facets = outside(domain)
    at, of_cell = middles(domain, facets)
    is_block = of_cell[:, 1] > 1
    level, side = np.isclose(at[:, 1], 1), np.isclose(np.abs(at[:, 0] - 1), 0.3)
    places = [
        level & is_block,
        level & ~is_block,
        np.isclose(at[:, 1], 0),
        np.isclose(at[:, 1], 1.5),
        side & is_block,
    ]
    tags = chosen(domain, facets, np.select(places, [1, 2, 3, 4, 5]))
    slope = np.tan(np.pi / 6)
    domain.geometry.x[:, 1] -= slope * (domain.geometry.x[:, 0] - 1)
    u = displacement(domain)
    V = u.function_space
    ds = ufl.Measure("ds", domain=domain, subdomain_data=tags)
    F = elasticity(u, 1e3, 0.3) + ufl.TestFunction(V)[1] * ds(4)
    bcs = [
        fem.dirichletbc(np.zeros(2), fem.locate_dofs_topological(V, 1, tags.find(3)), V),
        fem.dirichletbc(0.0, fem.locate_dofs_topological(V.sub(0), 1, tags.find(5)), V.sub(0)),
    ]
    contact = cx.Contact(cx.Surface(tags, 1), cx.Surface(tags, 2), friction=friction, method=method)
    make_problem(F, u, [contact], bcs).solve()
    normal = np.array([slope, 1]) / np.hypot(slope, 1)
    pressed = contact.force @ normal
    rubs = contact.force @ np.array([normal[1], -normal[0]])
    assert abs(rubs) == pytest.approx(friction * pressed, rel=0.01)


@pytest.mark.parametrize("method", METHODS[1:])
@pytest.mark.parametrize("degree", [1, 2])
@pytest.mark.parametrize("cell", CELLS)
def test_all_of_a_block_rubs_that_is_pushed_by_a_side(cell, degree, method):
    """Also its nodes on the edge that is pushed, whose displacement is prescribed."""
    gdim = dimension(cell)
    data = meshes.blocks(
        cell,
        (3,) * gdim,
        (4,) * gdim,
        size_lower=(3.0,) * (gdim - 1) + (1.0,),
        shift=(0.83,) * (gdim - 1),
    )
    domain, tags = data.mesh, data.facet_tags
    u = displacement(domain, degree)
    V = u.function_space
    ds = ufl.Measure("ds", domain=domain, subdomain_data=tags)
    F = elasticity(u, 100.0, 0.3) + ufl.TestFunction(V)[gdim - 1] * ds(Tag.UPPER_TOP)
    facets = outside(domain)
    at, of_cell = middles(domain, facets)
    upper = of_cell[:, -1] > 0
    side = facets[upper & np.isclose(at[:, 0], at[upper, 0].min())]
    push = fem.Constant(domain, 0.0)
    bottom = tags.find(Tag.LOWER_BOTTOM)
    bcs = [
        fem.dirichletbc(np.zeros(gdim), fem.locate_dofs_topological(V, gdim - 1, bottom), V),
        fem.dirichletbc(push, fem.locate_dofs_topological(V.sub(0), gdim - 1, side), V.sub(0)),
    ]
    for k in range(1, gdim - 1):
        dofs = fem.locate_dofs_topological(V.sub(k), gdim - 1, side)
        bcs.append(fem.dirichletbc(0.0, dofs, V.sub(k)))
    surfaces = [cx.Surface(tags, tag) for tag in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)]
    contact = cx.Contact(*surfaces, friction=MU, method=method)
    problem = make_problem(F, u, [contact], bcs)
    for push.value in (0.0, 0.05):
        problem.solve()
    p, t = parts(contact)
    assert contact.area @ np.linalg.norm(t, axis=1) == pytest.approx(
        MU * contact.area @ p, rel=1e-6
    )
    assert -contact.force[0] == pytest.approx(MU * contact.force[-1], rel=0.02)
