# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Face slabs of a rockfill dam crushed at their joint, after Zhou, Zhang, Zhang & Feng 2015.

Concrete slabs, 16 m wide and about half a metre thick, lie side by side on a soft cushion layer, at
first without a gap: three bodies in contact with friction (doi 10.11779/CJGE201508010, submodel of
Figs. 6-10). Scheme 1: under the water pressure the support below the cushion gives way most below
the joint; the slabs turn towards each other, their joint opens below and is pressed together at
its top edge. Scheme 2: on a firm support, with a joint that gapes by 2 mm at its bottom, the sides
of the cushion are pushed inward. Compared is the largest compression along the dam.

The softness of the support is found by trial on a plane-strain slice: all grows in proportion with
the load, so that each try is one step. Lengths that the paper's text does not give are inferred.

    python demos/face_slab.py                       # scheme 1 on the coarse mesh in 3D
    python demos/face_slab.py --table               # all rows of the paper's Table 1
    python demos/face_slab.py --scheme 2            # slice of 5, 10 and 20 layers
    python demos/face_slab.py --preset slice --layers 10 --slabs 4
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from rich.table import Table

import slab_figures
import story
from meshes import FACE_SLABS
from slab_results import Laws, Measured, laws, measure
from slab_scene import Scene, Setting
from slab_schemes import Try, guess, scheme_1, scheme_2, try_supports

# Rotation in degrees and pressure in MPa: stress in MPa and concentration factor of Table 1
TABLE = {
    (0.11, 0.3): (13.3, 3.4),
    (0.17, 0.3): (18.0, 3.6),
    (0.22, 0.3): (20.9, 4.7),
    (0.17, 0.5): (21.7, 4.3),
    (0.17, 0.8): (24.8, 5.8),
}
SCHEME_2_LAYERS = (5, 10, 20)


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description="Face slabs of a rockfill dam crushed at their joint",
        formatter_class=argparse.ArgumentDefaultsHelpFormatter,
    )
    add = parser.add_argument
    add("--scheme", type=int, choices=(1, 2), default=1, help="1: rotation, 2: translation")
    add("--preset", choices=FACE_SLABS, help="mesh; coarse for scheme 1 and slice for scheme 2")
    add("--layers", type=int, nargs="+", help="cells through a slab; several: one run each")
    add("--slabs", type=int, default=2, help="number of slabs in the row")
    add("--matching", action="store_true", help="cushion with the nodes of the slabs")
    add("--slave", choices=("cushion", "slabs"), default="cushion", help="slave of their contact")
    add("--sliding", choices=("small", "finite"), default="small", help="kinematics of contact")
    add("--method", choices=story.METHODS, default=story.METHODS[0], help="method of contact")
    add("--rotation", type=float, default=0.17, help="wanted rotation of scheme 1, degrees")
    add("--pressure", type=float, default=0.3, help="water pressure, MPa")
    add("--push", type=float, default=20.0, help="push of each side in scheme 2, mm")
    add("--joint-friction", type=float, default=0.75, help="friction of slab and slab, a ratio")
    add("--cushion-friction", type=float, default=0.7, help="friction of slab and cushion, a ratio")
    add("--steps", type=int, help="load steps; 10 for scheme 1, 20 for the push of scheme 2")
    add("--table", action="store_true", help="all rows of Table 1, without pictures")
    add("--output", type=Path, default=Path(__file__).parent / "output", help="folder of pictures")
    return parser.parse_args(argv)


def settings(args: argparse.Namespace) -> list[Setting]:
    """Settings of all runs, one for each number of layers."""
    preset = args.preset or ("coarse" if args.scheme == 1 else "slice")
    model = replace(FACE_SLABS[preset], slabs=args.slabs, matching=args.matching)
    if args.scheme == 2:
        model = replace(model, cushion_thickness=2.0, opening=(0.0, 2e-3))
    layers = args.layers or ([model.layers] if args.scheme == 1 else SCHEME_2_LAYERS)
    return [
        Setting(
            replace(model, layers=n),
            joint_friction=args.joint_friction,
            cushion_friction=args.cushion_friction,
            sliding=args.sliding,
            method=args.method,
            cushion_is_slave=args.slave == "cushion",
        )
        for n in layers
    ]


def turn(args: argparse.Namespace, setting: Setting, wanted: float, pressure: float) -> Scene:
    """Find the support for a rotation, print the tries, and solve."""
    settlement = guess(wanted)
    if setting.model.slabs == 1:
        story.console.print("one slab has no joint: its support is the first guess")
    else:

        def show(found: Try) -> None:
            story.console.print(
                f"try: settlement {1000 * found.settlement:.3f} mm, "
                f"rotation {found.rotation:.5f} degrees (wanted: {wanted})",
                highlight=False,
            )

        with story.progress("looking for the support"):
            settlement = try_supports(setting, wanted, pressure, show).settlement
    return scheme_1(setting, settlement, pressure, steps=args.steps or 10)


def show_laws(found: Laws) -> None:
    """Print how well the laws hold."""
    story.console.print(
        f"balance of each slab {found.balance:.1e} of its water load, penetration "
        f"{found.penetration:.1e} m, Coulomb's law exceeded by {found.coulomb:.1e} of the pressure",
        highlight=False,
    )


def show_rows(title: str, rows: Sequence[tuple[str, float, float, Measured]]) -> None:
    """Print runs of scheme 1 beside the paper."""
    table = Table(title=title)
    for name in (
        "mesh",
        "wanted\ndegrees",
        "rotation\ndegrees",
        "p\nMPa",
        "paper\nMPa",
        "computed\nMPa",
        "error",
        "lower end\nMPa",
        "opening\nmm",
        "factor\npaper",
        "over the\nsection",
        "over the\ntop",
    ):
        table.add_column(name, justify="right")
    for name, wanted, p, m in rows:
        stress, factor = TABLE.get((wanted, p), (np.nan, np.nan))
        table.add_row(
            name,
            f"{wanted:g}",
            f"{m.rotation:.4f}",
            f"{p:g}",
            f"{stress:.1f}",
            f"{m.stress:.2f}",
            f"{100 * (m.stress / stress - 1):+.1f} %",
            f"{m.lower:.2f}",
            f"{1000 * m.opening:.3f}",
            f"{factor:.1f}",
            f"{m.section_factor:.1f}",
            f"{m.surface_factor:.1f}",
        )
    # Wide enough for all columns where there is no terminal
    console = story.console if story.console.width >= 120 else story.wide_console()
    console.print(table)


def run_1(args: argparse.Namespace) -> list[story.Result]:
    """Scheme 1: one row, several meshes or all rows of the table."""
    wanted = list(TABLE) if args.table else [(args.rotation, args.pressure)]
    rows, results = [], []
    for setting in settings(args):
        for angle, p in wanted:
            scene = turn(args, setting, angle, p)
            found = measure(scene)
            show_laws(laws(scene))
            rows.append((f"{setting.model.layers} layers", angle, p, found))
            results.append(story.Result(f"rotation, {p:g} MPa", angle, found.rotation))
            if (angle, p) in TABLE:
                expected = TABLE[angle, p][0]
                name = f"stress, {angle:g} degrees, {p:g} MPa"
                results.append(story.Result(name, expected, found.stress))
    show_rows("Slabs turned: largest compression at mid length", rows)
    if not args.table:
        with story.progress("drawing"):
            files = slab_figures.draw(scene, args.output / "face_slab_1")
        story.see(files)
    return results


def run_2(args: argparse.Namespace) -> list[story.Result]:
    """Scheme 2: the largest stress over the push."""
    curves = {}
    for setting in settings(args):
        push, stress = [], []

        def each(scene: Scene, push: list = push, stress: list = stress) -> None:
            push.append(1000 * float(scene.push[0].value))
            stress.append(measure(scene).largest)

        scene = scheme_2(
            setting, args.pressure, args.push / 1000, steps=args.steps or 20, each=each
        )
        show_laws(laws(scene))
        curves[f"{setting.model.layers} layers"] = np.array(push), np.array(stress)
        if len(curves) == 1:
            first = scene
    results = []
    for name, (push, stress) in curves.items():
        place, peak = slab_figures.PEAK
        results.append(story.Result(f"{name}: peak, MPa", peak, stress.max()))
        results.append(story.Result(f"{name}: push at the peak, mm", place, push[stress.argmax()]))
    story.show("Slabs pushed together", results)
    story.console.print(
        "The peak is where the second row of joint nodes closes, not where friction ends: it moves "
        "with the mesh, and only that of 5 layers, the paper's, can be compared."
    )
    path = args.output / "face_slab_2_push.png"
    slab_figures.pushed(curves, path)
    with story.progress("drawing"):
        files = slab_figures.draw(first, args.output / "face_slab_2")
    story.see([path, *files])
    return results


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Run a scheme, compare with the paper and draw."""
    args = arguments(argv)
    args.output.mkdir(parents=True, exist_ok=True)
    return run_1(args) if args.scheme == 1 else run_2(args)


if __name__ == "__main__":
    main()
