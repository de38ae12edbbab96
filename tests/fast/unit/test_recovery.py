# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Recovery of pressures and tractions on facets of every kind, with random sets of closed nodes."""

from dataclasses import dataclass
from types import SimpleNamespace

from mpi4py import MPI

import numpy as np
import pytest

from contactx import cpp as core
from contactx.parallel.slaves import SlaveNodes
from contactx.recovery import Recovery
from contactx.surface import FacetList

MU = 0.3


def recovery(facets, x):
    """Recovery on one rank, whose nodes are all its own."""
    halo = SimpleNamespace(comm=MPI.COMM_SELF, num_owned=len(x))
    return Recovery(SlaveNodes(halo, facets), x)


@dataclass
class Sheet:
    """A curved slave surface of cells of uneven size, among other nodes of a bulk.

    Attributes:
        facets: Its facets.
        x: Positions of the bulk's nodes, shape (num_nodes, gdim).
        slaves: Its nodes, shape (n,).
        closed: Which of them are in contact.
        area: Areas of theirs that a master faces, shape (n,).
        normal: Unit normals, shape (n, gdim).
    """

    facets: FacetList
    x: np.ndarray
    slaves: np.ndarray
    closed: np.ndarray
    area: np.ndarray
    normal: np.ndarray

    @property
    def recovery(self) -> Recovery:
        return recovery(self.facets, self.x)

    def tangential(self, v: np.ndarray) -> np.ndarray:
        return v - np.einsum("ij,ij->i", v, self.normal)[:, None] * self.normal


def sheet(kind, seed=1, m=9, *, curved=True, closed=0.7, uneven=0.25):
    rng = np.random.default_rng(seed)
    gdim = 2 if kind == "segments" else 3
    shape = (m,) * (gdim - 1)
    grid = np.stack(np.meshgrid(*[np.arange(m)] * (gdim - 1), indexing="ij"), axis=-1)
    place = (grid + uneven * rng.uniform(-1, 1, grid.shape)).reshape(-1, gdim - 1) / m
    number = np.arange(len(place)).reshape(shape)
    if kind == "segments":
        cells = [np.stack([number[:-1], number[1:]], axis=-1)]
    else:
        corners = number[:-1, :-1], number[1:, :-1], number[:-1, 1:], number[1:, 1:]
        quads = np.stack([c.ravel() for c in corners], axis=-1)
        triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [1, 3, 2]]])
        half = len(quads) // 2
        cells = {
            "quadrilaterals": [quads],
            "triangles": [triangles],
            "both": [quads[:half], triangles[half : len(quads)], triangles[len(quads) + half :]],
        }[kind]
    height = np.sum(place**2, axis=1) if curved else 0 * place[:, 0]
    x = np.column_stack([place, height])
    # Other nodes of the bulk are before and between them
    slaves = np.sort(rng.choice(2 * len(x), len(x), replace=False)) + 3
    bulk = rng.uniform(-1, 1, (2 * len(x) + 5, gdim))
    bulk[slaves] = x
    nodes = slaves[np.concatenate([c.ravel() for c in cells])].astype(np.int32)
    sizes = np.concatenate([np.full(len(c), c.shape[1]) for c in cells])
    facets = FacetList(np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32), nodes)
    whole = core.nodal_areas(facets.offsets, facets.nodes, bulk, gdim)[slaves]
    normal = np.column_stack([2 * place * curved, -np.ones(len(x))])
    return Sheet(
        facets,
        bulk,
        slaves,
        rng.uniform(size=len(x)) < closed,
        # A third of the nodes are covered in part
        whole * np.where(rng.uniform(size=len(x)) < 0.3, rng.uniform(0.05, 1, len(x)), 1),
        normal / np.linalg.norm(normal, axis=1, keepdims=True),
    )


kinds = pytest.mark.parametrize("kind", ["segments", "triangles", "quadrilaterals", "both"])


@kinds
def test_a_uniform_pressure_stays(kind):
    surface = sheet(kind)
    p = np.where(surface.closed, 2.5, 0.0)
    recovered = surface.recovery.pressure(p, surface.area, surface.closed)
    assert recovered == pytest.approx(p, rel=1e-12, abs=0)


@kinds
def test_force_signs_and_open_nodes_stay(kind):
    surface = sheet(kind, seed=1)
    p = np.random.default_rng(1).uniform(0, 1, len(surface.slaves)) ** 4 * surface.closed
    recovered = surface.recovery.pressure(p, surface.area, surface.closed)
    assert surface.area @ recovered == pytest.approx(surface.area @ p, rel=1e-13)
    assert recovered.min() >= 0
    assert recovered.max() <= p.max()
    assert not recovered[~surface.closed].any()
    assert np.all(recovered[surface.closed] > 0)
    assert np.abs(recovered - p).max() > 0.1 * p.max()


@kinds
def test_the_friction_cone_is_kept(kind):
    surface, rng = sheet(kind, seed=1), np.random.default_rng(1)
    n = len(surface.slaves)
    p = rng.uniform(0, 1, n) * surface.closed
    t = surface.tangential(rng.uniform(-1, 1, surface.normal.shape))
    # Nodes slip and stick by turns
    size = MU * p * np.where(rng.uniform(size=n) < 0.5, 1, rng.uniform(0, 1, n))
    t *= (size / np.linalg.norm(t, axis=1))[:, None]
    state = surface.area, surface.closed
    p_new = surface.recovery.pressure(p, *state)
    t_new = surface.recovery.shear(t, surface.normal, *state)
    assert np.all(np.linalg.norm(t_new, axis=1) <= MU * p_new * (1 + 1e-13))
    assert np.abs(np.einsum("ij,ij->i", t_new, surface.normal)).max() <= 1e-15
    assert not t_new[~surface.closed].any()


@pytest.mark.parametrize("kind", ["segments", "triangles"])
def test_shear_keeps_its_size_where_the_surface_is_curved(kind):
    """In a plane of bending it turns with the normal: its size along the arc is that of a line."""
    surface = sheet(kind)
    if kind == "triangles":
        surface.normal[:, 1] = 0
        surface.normal /= np.linalg.norm(surface.normal, axis=1, keepdims=True)
    along = np.zeros_like(surface.normal)
    along[:, 0], along[:, -1] = -surface.normal[:, -1], surface.normal[:, 0]
    size = np.random.default_rng(0).uniform(-1, 1, len(surface.slaves)) * surface.closed
    state = surface.area, surface.closed
    recovered = surface.recovery.shear(size[:, None] * along, surface.normal, *state)
    expected = surface.recovery.pressure(size, *state)
    assert recovered == pytest.approx(expected[:, None] * along, abs=1e-14)


@pytest.mark.parametrize("kind", ["segments", "both"])
def test_rigid_motions_change_nothing(kind):
    surface, rng = sheet(kind), np.random.default_rng(3)
    gdim = surface.x.shape[1]
    Q, _ = np.linalg.qr(rng.standard_normal((gdim, gdim)))
    Q *= np.sign(np.linalg.det(Q))
    moved = recovery(surface.facets, surface.x @ Q.T + rng.uniform(-1, 1, gdim))
    p = rng.uniform(0, 1, len(surface.slaves)) * surface.closed
    t = surface.tangential(rng.uniform(-1, 1, surface.normal.shape)) * surface.closed[:, None]
    state = surface.area, surface.closed
    assert moved.pressure(p, *state) == pytest.approx(
        surface.recovery.pressure(p, *state), rel=1e-12
    )
    assert moved.shear(t @ Q.T, surface.normal @ Q.T, *state) == pytest.approx(
        surface.recovery.shear(t, surface.normal, *state) @ Q.T, abs=1e-14
    )


@pytest.mark.parametrize("kind", ["segments", "quadrilaterals"])
def test_alternating_scatter_goes_and_a_linear_pressure_stays(kind):
    surface = sheet(kind, m=12, curved=False, closed=1.1, uneven=0.0)
    whole = core.nodal_areas(
        surface.facets.offsets, surface.facets.nodes, surface.x, surface.x.shape[1]
    )[surface.slaves]
    place = surface.x[surface.slaves][:, :-1] * 12
    linear = 3 + place @ np.array([0.2, -0.1])[: place.shape[1]]
    scatter = np.where(np.round(place.sum(axis=1)).astype(int) % 2, 1.0, -1.0)
    recovered = surface.recovery.pressure(linear + scatter, whole, surface.closed)
    inside = np.all((place > 1.5) & (place < 9.5), axis=1)
    assert recovered[inside] == pytest.approx(linear[inside], rel=1e-13)


def test_normals_that_oppose_each_other_do_no_harm():
    surface = sheet("segments", m=3, curved=False, closed=1.1)
    surface.normal[1] *= -1
    t = np.array([[1.0, 0.0], [0.5, 0.0], [-1.0, 0.0]])
    recovered = surface.recovery.shear(t, surface.normal, surface.area, surface.closed)
    assert np.abs(recovered[:, 0]).max() <= 1
    assert np.all(recovered[:, 1] == 0)
