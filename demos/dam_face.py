# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The whole concrete face of a rockfill dam in its valley: where do its joints crush?

Slabs, 16 m wide and half a metre thick, lie side by side on the cushion zone of a rockfill dam,
each a body of its own, in contact with friction. Their own weight comes first, then the water in
stages, then creep of the rockfill towards the middle of the valley. Zhou, Zhang, Zhang & Feng 2015
(doi 10.11779/CJGE201508010) explain by two slabs alone why faces crush: slabs of the river bed turn
towards one another, and their joint is pressed together in a narrow band at its top. Here all slabs
tell which joint that is; its rotation and its water then load the two slabs of face_slab.py, whose
cells are finer.

    python demos/dam_face.py                 # 10 slabs
    python demos/dam_face.py --rockfill E-B  # on rockfill of the E-B model of Duncan and Chang
    python demos/dam_face.py --slabs 20 --rows 104 --rockfill-rows 70
    mpiexec -n 2 python demos/dam_face.py    # the same
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from hexahedra import NodalStress, stress

import contactx as cx
from dolfinx import fem

import dam_figures
import story
from dam_results import HEIGHTS, Joint, Laws, joints, laws, total_water
from dam_scene import Dam, DamSetting, run
from duncan_chang import DuncanChang
from meshes import FACE_SLABS, DamFace
from slab_results import measure
from slab_scene import Setting
from slab_schemes import scheme_1, try_supports

# Height of the dam over its length
ASPECT = 0.3
# Rotation of the slabs at a joint, degrees, from which the two slabs of the paper stand for it
TURNED = 0.01


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description="The concrete face of a rockfill dam",
        formatter_class=argparse.ArgumentDefaultsHelpFormatter,
    )
    add = parser.add_argument
    add("--slabs", type=int, default=10, help="number of slabs")
    add("--height", type=float, help=f"height of the dam, m; {ASPECT} of its length, at most 178")
    add("--layers", type=int, default=3, help="cells through a slab")
    add("--rows", type=int, default=40, help="cells along a slab")
    add("--rockfill-rows", type=int, default=28, help="cells of the rockfill up the slope")
    add("--rockfill-cells", type=int, default=5, help="cells of the rockfill across a slab")
    add("--rockfill", choices=("linear", "E-B"), default="linear", help="law of the rockfill")
    add("--stages", type=int, default=10, help="stages of the water")
    add("--joint-friction", type=float, default=0.75, help="friction of slab and slab, a ratio")
    add("--cushion-friction", type=float, default=0.7, help="friction of slab and cushion, a ratio")
    add("--no-creep", action="store_true", help="end with the full reservoir")
    add("--no-submodel", action="store_true", help="leave out the two slabs at the worst joint")
    add("--checkpoint", type=Path, help="file to write after each stage")
    add("--restart", type=Path, help="file to go on from")
    add("--output", type=Path, default=Path(__file__).parent / "output", help="folder of pictures")
    return parser.parse_args(argv)


def model_of(slabs: int, height: float | None = None, **cells: Any) -> DamFace:
    """Measures of a dam of a number of slabs; its height follows from its length if None."""
    high = height or min(ASPECT * slabs * DamFace.width, DamFace.height)
    return DamFace(slabs=slabs, height=high, **cells)


class Compression:
    """Compression along the dam at the nodes, MPa."""

    def __init__(self, dam: Dam):
        """Compile the stress of a dam."""
        sigma = stress(dam.u, dam.young, dam.nu)[0, 0]
        self._stress = NodalStress(sigma, dam.mesh, "stress along the dam")
        self.values = fem.Function(self._stress.values.function_space, name="compression")

    def update(self) -> fem.Function:
        """Evaluate it now."""
        self.values.x.array[:] = -self._stress.update()
        return self.values


def show_joints(found: Sequence[Joint], title: str, most: int = 12) -> None:
    """Print the joints of the largest compression."""
    names = (
        "joint",
        "x\nm",
        "stress\nMPa",
        "up the\nslope",
        "through\nthe slab",
        "pressure\nMPa",
        "closed",
        "opening\nmm",
        "rotation\ndegrees",
        *(f"at\n{part:g} up" for part in HEIGHTS),
    )
    rows = [
        (
            f"{j.number}",
            f"{j.x:.0f}",
            f"{j.stress:.2f}",
            f"{j.slope:.2f}",
            f"{j.height:.2f}",
            f"{j.pressure:.2f}",
            f"{j.closed:.2f}",
            f"{1000 * j.opening:.2f}",
            f"{j.rotation:.4f}",
            *(f"{angle:.4f}" for angle in j.rotations),
        )
        for j in sorted(found, key=lambda j: -j.stress)[:most]
    ]
    story.show_table(title, names, rows, width=130)


def show_laws(found: Laws) -> None:
    """Print how well the laws hold."""
    story.console.print(
        f"balance of each slab {found.balance:.1e}, reactions {found.reactions:.1e} of the loads, "
        f"penetration {found.penetration:.1e} m, Coulomb's law exceeded by {found.coulomb:.1e} of "
        "the pressure",
        highlight=False,
    )


def submodel(joint: Joint) -> list[story.Result]:
    """Load the two slabs of face_slab.py as the worst joint is: the same rotation and water."""
    setting = Setting(replace(FACE_SLABS["slice"], layers=10))
    wanted = joint.rotation
    with story.progress("two slabs at the worst joint"):
        settlement = try_supports(setting, wanted, joint.water, lambda _: None).settlement
        scene = scheme_1(setting, settlement, joint.water, steps=1, progress=False)
    found = measure(scene)
    results = [
        story.Result("rotation, degrees", wanted, found.rotation),
        story.Result("largest compression, MPa", joint.stress, found.stress),
    ]
    title = f"Two slabs (computed) as joint {joint.number} of the face (expected)"
    story.show(title, results)
    return results


def main(argv: Sequence[str] | None = None) -> list[Joint]:
    """Load the dam, rank its joints and draw its face."""
    args = arguments(argv)
    model = model_of(
        args.slabs,
        args.height,
        layers=args.layers,
        rows=args.rows,
        rockfill_rows=args.rockfill_rows,
        rockfill_cells=args.rockfill_cells,
    )
    dam = Dam(
        DamSetting(
            model,
            DuncanChang() if args.rockfill == "E-B" else DamSetting.rockfill,
            joint_friction=args.joint_friction,
            cushion_friction=args.cushion_friction,
        )
    )
    compression = Compression(dam)
    found: list[Joint] = []

    def each(dam: Dam, step: cx.Step) -> None:
        found[:] = joints(dam, compression.update())
        worst = max(found, key=lambda j: j.stress)
        story.console.print(
            f"stage {step.t:g}: water {float(dam.level.value):.1f} m, {step.iterations} "
            f"iterations, largest compression {worst.stress:.2f} MPa at joint {worst.number}",
            highlight=False,
        )

    run(
        dam,
        args.stages,
        creep=not args.no_creep,
        each=each,
        checkpoint=args.checkpoint,
        restart=args.restart,
    )
    story.console.print(f"water load {total_water(dam):.1f} MN", highlight=False)
    show_laws(laws(dam))
    show_joints(found, "Where does the face crush?")
    args.output.mkdir(parents=True, exist_ok=True)
    path = args.output / "dam_face.png"
    with story.progress("drawing"):
        dam_figures.draw(dam, compression.update(), found, path)
    story.see([path])
    # The two slabs are turned towards one another and pressed by the water
    turned = [j for j in found if j.rotation > TURNED and j.water > 0]
    if turned and not args.no_submodel and dam.mesh.comm.size == 1:
        submodel(max(turned, key=lambda j: j.stress))
    return found


if __name__ == "__main__":
    main()
