# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is read off the face of a dam: joints, rotation of slabs, balance; any number of ranks."""

from __future__ import annotations

from dataclasses import dataclass

from mpi4py import MPI

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem

from dam_scene import Dam, Nodes
from meshes import block_tag
from slab_results import friction_excess

# Where rotations are read, as parts of a joint's height above its foot
HEIGHTS = (0.1, 0.3, 0.6, 0.9)


@dataclass(frozen=True)
class Joint:
    """State of a joint between two slabs.

    Attributes:
        number: Number of the slab on its left, from 1.
        x: Place along the dam, m.
        opening: Largest distance of its faces, m.
        closed: Part of its slave nodes that are in contact.
        pressure: Largest contact pressure, MPa.
        stress: Largest compression along the dam on its faces, MPa.
        slope: Where that is up the slope, as a part of the joint's length.
        height: Where that is through the slab, as a part of its thickness: 1 at the top.
        rotation: Mean rotation of its two slabs about the slope there, towards one another at
            their tops, degrees.
        rotations: The same at ``HEIGHTS`` of the joint's height.
        water: Pressure of the water there, MPa.
    """

    number: int
    x: float
    opening: float
    closed: float
    pressure: float
    stress: float
    slope: float
    height: float
    rotation: float
    rotations: tuple[float, ...]
    water: float


@dataclass(frozen=True)
class Laws:
    """How well the laws hold.

    Attributes:
        balance: Largest force that is missing in the balance of a slab along the dam and off the
            face, relative to its water load; of its weight where there is no water.
        reactions: What the supports' reactions miss of all loads, relative to these.
        penetration: Deepest penetration of a joint, m; 0 if there is none.
        coulomb: Largest excess of |t| over mu p at a node, relative to the largest pressure.
    """

    balance: float
    reactions: float
    penetration: float
    coulomb: float


def _owned(dam: Dam, nodes: Nodes) -> Nodes:
    return nodes[nodes < dam.u.function_space.dofmap.index_map.size_local]


def laws(dam: Dam) -> Laws:
    """Check balance, reactions, penetration and Coulomb's law of a solved dam (collective)."""
    V, comm, halo = dam.u.function_space, dam.mesh.comm, dam.problem.assembler.halo
    # Each rank has what its own slave nodes do to all nodes that it knows
    known = np.zeros(halo.positions().size)
    for contact in dam.problem.contacts:
        if contact.active:
            contact.discrete.add_residual(known)
    forces = -halo.scatter_reverse(known.reshape(-1, 3))
    loads = dam.loads_on_nodes()
    balance = 0.0
    for i in dam.slabs:
        nodes = _owned(dam, dam.nodes_of(i))
        sums = np.array([forces[nodes].sum(0), loads[nodes].sum(0)])
        contact_force, load = comm.allreduce(sums)
        missing = (contact_force + load)[[0, 2]]
        balance = max(balance, float(np.abs(missing).max() / np.abs(load).max()))
    n = 3 * V.dofmap.index_map.size_local
    inner = dam.problem.assembler.bulk.residual()[:n]
    supported = dam.problem.assembler.bulk.markers[:n] == 1
    reaction = np.where(supported, inner - forces[: n // 3].ravel(), 0).reshape(-1, 3)
    total = comm.allreduce(np.array([reaction.sum(0), loads[: n // 3].sum(0)]))
    missing = float(np.abs(total.sum(0)).max() / np.abs(total[1]).max())
    return Laws(balance, missing, *_contact_laws(dam))


def _contact_laws(dam: Dam) -> tuple[float, float]:
    """Deepest penetration of a joint, and the excess of Coulomb's law."""
    excess, pressure, gap = -np.inf, 0.0, 0.0
    for contact in dam.problem.contacts:
        is_cushion = contact is dam.cushion
        mu = dam.setting.cushion_friction if is_cushion else dam.setting.joint_friction
        beyond, highest = friction_excess(contact, mu)
        excess, pressure = max(excess, beyond), max(pressure, highest)
        if contact.active and not is_cushion:
            gaps = contact.gap.x.array[contact.slave_nodes]
            gap = min(gap, float(np.nanmin(gaps, initial=0.0)))
    comm = dam.mesh.comm
    excess, pressure, depth = (comm.allreduce(a, op=MPI.MAX) for a in (excess, pressure, -gap))
    return depth, max(excess, 0.0) / pressure


def joints(dam: Dam, compression: fem.Function) -> list[Joint]:
    """State of all joints, along the dam (collective).

    Args:
        dam: A solved dam.
        compression: Compression along the dam at the nodes, MPa.
    """
    return [_joint(dam, contact, i, compression) for i, contact in enumerate(dam.joints, start=1)]


def _joint(dam: Dam, contact: cx.Contact, left: int, compression: fem.Function) -> Joint:
    comm, model = dam.mesh.comm, dam.model
    gap = contact.gap.x.array[contact.slave_nodes]
    p = contact.pressure.x.array[contact.slave_nodes]
    closed = np.array([np.count_nonzero(p > 0), len(p)])
    most = [float(np.nanmax(gap, initial=0.0)), float(p.max(initial=0.0))]
    opening, pressure = (comm.allreduce(value, op=MPI.MAX) for value in most)
    shares = comm.allreduce(closed)
    # The largest of any rank, with its place
    best = (-np.inf, 0.0, 0.0)
    for body, side in ((left, "x1"), (left + 1, "x0")):
        nodes = _owned(dam, dam.nodes_on(body, side))
        if len(nodes):
            at = nodes[np.argmax(compression.x.array[nodes])]
            best = max(best, (float(compression.x.array[at]), *map(float, dam.x[at, 1:])))
    stress, y, z = max(comm.allgather(best))
    x = float(model.edges[left])
    elevation = y * float(model.up[1])
    ground = float(model.ground(np.array([x]))[0])

    def turned(y: float) -> float:
        """How far the two slabs are turned towards one another."""
        angles = [rotation(dam, body, y) for body in (left, left + 1)]
        return 0.5 * (angles[1] - angles[0])

    rises = [(ground + part * (model.height - ground)) / float(model.up[1]) for part in HEIGHTS]
    return Joint(
        number=left,
        x=x,
        opening=opening,
        closed=float(shares[0] / shares[1]),
        pressure=pressure,
        stress=stress,
        slope=(elevation - ground) / (model.height - ground),
        height=z / float(model.thickness_at(np.array([elevation]))[0]),
        rotation=turned(y),
        rotations=tuple(map(turned, rises)),
        water=dam.water_at(elevation),
    )


def rotation(dam: Dam, body: int, y: float) -> float:
    """Rotation of a slab about the slope, off the face at its right side, degrees (collective).

    Args:
        dam: A solved dam.
        body: Number of the slab.
        y: Where along the slope, m: the node of each side that is nearest counts.
    """
    w = []
    for side in ("x0", "x1"):
        nodes = _owned(dam, dam.nodes_on(body, side))
        nodes = nodes[np.isclose(dam.x[nodes, 2], 0, atol=1e-9)]
        best = (np.inf, 0.0)
        if len(nodes):
            at = nodes[np.argmin(np.abs(dam.x[nodes, 1] - y))]
            best = (abs(float(dam.x[at, 1]) - y), float(dam.u.x.array[3 * at + 2]))
        w.append(min(dam.mesh.comm.allgather(best))[1])
    return float(np.degrees(np.arctan((w[1] - w[0]) / dam.model.width)))


def total_water(dam: Dam) -> float:
    """Water load on all slabs along the normal, MN (collective)."""
    ds = ufl.Measure("ds", domain=dam.mesh, subdomain_data=dam.tags)
    tops = tuple(block_tag(i, "top") for i in dam.slabs)
    load = fem.assemble_scalar(fem.form(dam.pressure() * ds(tops)))
    return float(dam.mesh.comm.allreduce(load))
