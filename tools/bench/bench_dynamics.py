# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Impact of bars, by ContactDynamics and by steps that contact excites, and a block that bounces.

Tables of
- the bars of demos/impact_bars.py: mean contact force and its swing between 0.5 and 1.5 L / c over
  rho c v A, the largest growth of energy in a step, what is lost, the velocity after;
- the same bar by Newmark's method (1/4, 1/2) written in UFL and solved by ContactProblem;
- time steps that do better, on a model of the bar by its own: what ContactDynamics was chosen from;
- a block that bounces on a floor for 10,000 steps.

    python tools/bench/bench_dynamics.py
    python tools/bench/bench_dynamics.py 40 500
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import runner  # isort: skip, it finds the demos

import impact_bars
import numpy as np
import tables
from moving import GRAVITY, SaintVenant

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import story
from meshes import Tag

COURANT = (0.25, 0.5, 1.0, 2.0)
FIGURES: list[tables.Column] = [
    ("mean", "mean", ".5f"),
    ("swing", "swing", ".4f"),
    ("growth", "growth", ".1e"),
    ("loss", "loss", ".4f"),
    ("velocity", "velocity", ".4f"),
]


def figures(times: Any, forces: Any, energies: Any, velocity: float) -> dict[str, Any]:
    """What the tables show of forces over rho c v A, energies and the velocity over v."""
    t, f, e = (np.asarray(a) for a in (times, forces, energies))
    begin, end = impact_bars.BETWEEN
    steady = f[(t > begin) & (t < end)]
    return {
        "mean": float(steady.mean()),
        "swing": float(np.ptp(steady)),
        "growth": float(np.diff(e).max() / e[0]),
        "loss": float(1 - e[-1] / e[0]),
        "velocity": velocity,
    }


def bars(scene: str, n: int, courant: float, method: str, mass: str) -> dict[str, Any]:
    """Bars by ContactDynamics."""
    found = impact_bars.Bars(scene, n, courant, method, mass=mass)
    found.run()
    velocity = found.velocity / impact_bars.VELOCITY
    return figures(found.times, found.forces, found.energies, velocity)


def newmark(n: int, courant: float) -> dict[str, Any]:
    """The bar on a wall by Newmark's method, which gives the contact force of the step's end."""
    v, width, dt = impact_bars.VELOCITY, 1 / n, courant / n
    data = meshes.blocks(
        CellType.quadrilateral,
        (1, n),
        (1, n),
        size_upper=(width, 1.0),
        size_lower=(1.0, 1.0),
        gap=0.3 * v * dt,
    )
    mesh, tags = meshes.single(data, Tag.UPPER)
    u = story.displacement(mesh)
    start, velocity, acceleration = (fem.Function(u.function_space) for _ in range(3))
    test = ufl.TestFunction(u.function_space)
    now = 4 / dt**2 * (u - start) - 4 / dt * velocity - acceleration
    F = ufl.inner(now, test) * ufl.dx
    F += ufl.inner(ufl.sym(ufl.grad(u)), ufl.grad(test)) * ufl.dx
    contact = cx.Contact(cx.Surface(tags, Tag.UPPER_CONTACT), cx.Plane((0, 0), (0, 1)))
    problem = cx.ContactProblem(F, u, contacts=[contact], petsc_options_prefix="newmark_")
    problem.assembler.core.allow_flight()
    kinetic = fem.form(0.5 * ufl.inner(velocity, velocity) * ufl.dx)
    strain = fem.form(impact_bars.strain_energy(u))
    momentum = fem.form(velocity[1] * ufl.dx)
    velocity.x.array[1::2] = -v
    times, forces, energies = [], [], [fem.assemble_scalar(kinetic)]
    for k in range(round(impact_bars.END / dt)):
        start.x.array[:] = u.x.array
        problem.solve()
        ended = 4 / dt**2 * (u.x.array - start.x.array) - 4 / dt * velocity.x.array
        ended -= acceleration.x.array
        velocity.x.array[:] += dt / 2 * (acceleration.x.array + ended)
        acceleration.x.array[:] = ended
        times.append((k + 1) * dt)
        forces.append(contact.force[1] / (v * width))
        energies.append(fem.assemble_scalar(kinetic) + fem.assemble_scalar(strain))
    return figures(times, forces, energies, fem.assemble_scalar(momentum) / (v * width))


def scheme(name: str, n: int, courant: float) -> dict[str, Any]:
    """A bar of springs and masses on a wall, by one of the steps that were compared.

    "none" is the midpoint rule with contact at the step's end and nothing else; "impact" has the
    law of impact; "stabilised" is that of Deuflhard, Krause and Ertel (2008): the predictor is put
    onto the wall; "no mass" that of Khenous, Laborde and Renard (2008): the node at the wall has
    none, its neighbour has it.
    """
    h, dt, v = 1 / n, courant / n, 1.0
    mass = np.full(n + 1, h)
    mass[[0, -1]] = h / 2
    if name == "no mass":
        mass[:2] = 0, 1.5 * h
    K = (2 * np.eye(n + 1) - np.eye(n + 1, k=1) - np.eye(n + 1, k=-1)) / h
    K[0, 0] = K[-1, -1] = 1 / h
    A = np.diag(2 * mass / dt**2) + K / 2
    held = A.copy()
    held[0] = np.eye(n + 1)[0]
    free, held = np.linalg.inv(A), np.linalg.inv(held)
    u, velocity = np.full(n + 1, 0.3 * v * dt), np.full(n + 1, -v)
    times, forces, energies = [], [], [0.5 * mass @ velocity**2]
    for k in range(round(impact_bars.END / dt)):
        place = u + dt * velocity
        if name == "stabilised":
            place[0] = max(place[0], 0.0)
        b = 2 * mass * place / dt**2 - K @ u / 2
        new, force = free @ b, 0.0
        if new[0] < 0:
            b[0], was = 0.0, b[0]
            new = held @ b
            force = A[0] @ new - was
        if name == "stabilised":
            pull = -K @ (u + new) / 2
            pull[0] += force
            velocity = velocity + dt * pull / mass
        else:
            velocity = 2 * (new - u) / dt - velocity
        if name == "impact" and force > 0:
            force -= mass[0] * velocity[0] / dt
            velocity[0] = 0.0
        u = new
        times.append((k + 1) * dt)
        forces.append(force / v)
        energies.append(0.5 * mass @ velocity**2 + 0.5 * u @ K @ u)
    return figures(times, forces, energies, float(mass @ velocity / v))


def bounce(steps: int, friction: float = 0.0) -> dict[str, Any]:
    """A block that bounces on a floor, at first askew: energy less the work of weight."""
    data = meshes.blocks(CellType.quadrilateral, (2, 2), (2, 2), gap=0.2)
    mesh, tags = meshes.single(data, Tag.UPPER)
    u = story.displacement(mesh)
    contact = cx.Contact(
        cx.Surface(tags, Tag.UPPER_CONTACT), cx.Plane((0, 0), (0, 1)), friction=friction
    )
    material = SaintVenant(u, 1e4, 0.3)
    weight = fem.Constant(mesh, (0.0, -GRAVITY))
    dynamics = cx.ContactDynamics(
        material.forces,
        u,
        density=1.0,
        contacts=[contact],
        petsc_options_prefix="bounce_",
        loads=ufl.inner(weight, ufl.TestFunction(u.function_space)) * ufl.dx,
        strain_energy=material.energy,
    )
    dynamics.velocity.interpolate(
        lambda x: np.stack([0.1 - 0.2 * (x[1] - 0.7), 0.2 * (x[0] - 0.5)])
    )
    height = GRAVITY * 0.2
    start = dynamics.kinetic_energy() + height
    energies, flies, bounces = [start], True, 0
    work = 0.0
    for step in cx.LoadSteps(dynamics, steps, lambda t: None, t_end=0.005 * steps, progress=False):
        balance = step.report.balance
        assert balance is not None
        work += balance.work_of_loads
        energies.append(height + balance.energy - work)
        touches = balance.impulse[0][1] > 0
        bounces += flies and touches
        flies = not touches
    return {
        "steps": steps,
        "friction": friction,
        "bounces": int(bounces),
        "growth": float(np.diff(energies).max() / start),
        "whole": float(np.max(energies) / start - 1),
        "loss": float(1 - energies[-1] / start),
    }


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    n, steps = [int(a) for a in argv] or (200, 10000)
    rows = [
        {
            "scene": scene,
            "method": method,
            "mass": mass,
            "courant": courant,
            **bars(scene, n, courant, method, mass),
        }
        for scene in impact_bars.SCENES
        for method, mass in (
            (story.METHODS[0], "lumped"),
            (story.METHODS[1], "lumped"),
            (story.METHODS[0], "consistent"),
        )
        for courant in COURANT
    ]
    names: list[tables.Column] = [
        ("scene", "scene", "s"),
        ("method", "method", "s"),
        ("mass", "mass", "s"),
    ]
    courant: list[tables.Column] = [("Courant", "courant", ".2f")]
    title = f"Bars of {n} cells by ContactDynamics"
    tables.show(title, names + courant + FIGURES, rows, runner.OUTPUT / "dynamics.csv")
    plain = [{"scene": "Newmark", "courant": number, **newmark(n, number)} for number in COURANT]
    title = f"A bar of {n} cells by Newmark's method"
    file = runner.OUTPUT / "dynamics_newmark.csv"
    tables.show(title, [names[0], *courant, *FIGURES], plain, file)
    schemes = [
        {"scene": name, "courant": number, **scheme(name, n, number)}
        for name in ("none", "impact", "stabilised", "no mass")
        for number in COURANT
    ]
    title = f"Time steps on a model of the bar, {n} cells"
    file = runner.OUTPUT / "dynamics_schemes.csv"
    tables.show(title, [names[0], *courant, *FIGURES], schemes, file)
    bounces = [bounce(steps, friction) for friction in (0.0, 0.3)]
    columns: list[tables.Column] = [
        ("steps", "steps", "d"),
        ("friction", "friction", ".1f"),
        ("bounces", "bounces", "d"),
        ("growth in a step", "growth", ".1e"),
        ("growth", "whole", ".1e"),
        ("loss", "loss", ".3f"),
    ]
    tables.show("A bouncing block", columns, bounces, runner.OUTPUT / "dynamics_bounce.csv")
    return [*rows, *plain, *schemes, *bounces]


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
