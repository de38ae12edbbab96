# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run the demos and write their pages of the manual: what they print, their pictures, their source.

Pages and pictures come to docs/manual/demos and are kept in the repository, so that the manual is
made without running anything. `make demo-pages` runs all demos but the long ones.

Usage: tools/demo_pages.py [NAME ...]
"""

import inspect
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[1]
DEMOS, PAGES = ROOT / "demos", ROOT / "docs" / "manual" / "demos"
PICTURES = PAGES / "pictures"
WIDTH = 1200

# Demos by subject, each with what its line of the list says
SUBJECTS = {
    "Against Hertz": {
        "hertz_sphere": "an elastic sphere on a block",
        "hertz_cylinder": "an elastic cylinder on a block, in plane strain",
        "hertz_axisymmetric": "the sphere as an axisymmetric model: a contact with a weight",
        "parallel": "the sphere on several ranks: the answer of one, and who does what",
        "rigid_plane": "a sphere on a rigid plane",
        "rigid_sphere": "a rigid ball on a block",
        "rigid_cylinder": "a rigid cylinder on a block",
        "level_set": "a rigid body given by a function in UFL",
    },
    "Friction": {
        "cattaneo_mindlin": "two cylinders pressed together and pushed sideways: partial slip",
        "sliding_block": "a block pushed to and fro on a rigid plane and on an elastic base",
        "stacked_blocks": "five free blocks that nothing but contact and friction supports",
        "ironing": "a stiff round die dragged over a soft block, by both methods",
    },
    "Large deformations and self-contact": {
        "finite_strain": "a neo-Hookean block pressed through 30 % of its height",
        "press_fit": "a ring pressed into another one, against Lamé",
        "closing_clip": "a clip whose tips meet, against beam theory",
        "folding_strip": "a strip that is folded onto itself, against an elastica",
        "settling_discs": "twenty loose discs that settle in a box",
    },
    "Rolling, sliding and machine parts": {
        "snap_fit": "a hook that snaps over a catch and out again, against beam theory",
        "gear_pair": "an involute gear drives another one through more than a pitch",
        "belt_drum": "a belt that slides on a drum, against Euler",
        "bolt": "a bolt with pre-tension, whose joint opens and slips, against VDI 2230",
        "o_ring": "a rubber cord in its groove, squeezed and pressed by a fluid",
    },
    "Elements and coupled fields": {
        "patch_test": "uniform pressure on meshes that do not match, by both methods",
        "incompressible": "elements for a material that keeps its volume",
        "heat_conductance": "heat that crosses a contact, by pressure and gap",
    },
    "Dynamics": {
        "impact_bars": "a bar that hits a wall, and two bars each other, against waves",
        "bouncing_block": "a block that slides and bounces down a slope",
        "rolling_ring": "a thin ring that rolls down a slope",
    },
    "Loops of your own": {
        "own_newton": "a Newton loop written out with petsc4py",
        "own_snes": "the SNES of DOLFINx's NonlinearProblem",
        "own_forms": "SNES on forms: bulk and contact in one matrix",
        "arc_length": "an arch that snaps through onto a floor",
    },
    "A dam": {
        "face_slab": "concrete slabs of a dam on their cushion, crushed at the joint",
        "dam_face": "the whole concrete face of a dam in its valley",
    },
}
# These take longer than a few minutes: their pages are made by naming them
LONG = {"dam_face"}
RANKS = {"parallel": 2}


def names() -> list[str]:
    """All demos, in the order of the list."""
    return [name for group in SUBJECTS.values() for name in group]


def run(name: str, folder: Path) -> tuple[str, float]:
    """Run a demo; returns what it prints and the seconds that it took."""
    source = (DEMOS / f"{name}.py").read_text()
    command = [sys.executable, f"demos/{name}.py"]
    if name in RANKS:
        command = ["mpiexec", "-n", str(RANKS[name]), *command]
    if "--output" in source or "story.arguments" in source:
        command += ["--output", str(folder)]
    start = time.perf_counter()
    environment = {**os.environ, "COLUMNS": "96", "OMP_NUM_THREADS": "1"}
    done = subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        sys.exit(f"demos/{name}.py failed:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    lines = [line.rstrip() for line in done.stdout.splitlines() if not line.startswith("see ")]
    return "\n".join(lines).strip("\n"), time.perf_counter() - start


def keep_pictures(name: str, folder: Path) -> list[str]:
    """Keep the pictures of a demo, small; returns their names."""
    PICTURES.mkdir(exist_ok=True)
    for old in PICTURES.glob(f"{name}*.png"):
        if owner(old.stem) == name:
            old.unlink()
    kept = []
    for path in sorted(folder.glob("*.png"), key=lambda path: path.stat().st_mtime):
        with Image.open(path) as opened:
            image = opened.convert("RGB")
        if image.width > WIDTH:
            height = round(image.height * WIDTH / image.width)
            image = image.resize((WIDTH, height), Image.Resampling.LANCZOS)
        # A tree keeps rare colours, those of contact among much grey
        image = image.quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
        image.save(PICTURES / path.name, optimize=True)
        kept.append(path.name)
    return kept


def owner(stem: str) -> str:
    """The demo that a picture is of."""
    return max((name for name in names() if stem.startswith(name)), key=len, default="")


def prose(name: str) -> tuple[str, str]:
    """Title and text of a demo, from its docstring."""
    source = (DEMOS / f"{name}.py").read_text()
    found = re.search(r'^"""(.*?)"""', source, re.DOTALL | re.MULTILINE)
    assert found, f"demos/{name}.py has no docstring"
    title, _, text = inspect.cleandoc(found[1]).partition("\n")
    return title.rstrip("."), text.strip()


def page(name: str, printed: str, seconds: float, pictures: list[str]) -> str:
    """The page of a demo."""
    title, text = prose(name)
    shown = "\n\n".join(f"![{title}](pictures/{picture})" for picture in pictures)
    count = RANKS.get(name, 1)
    ranks = "one rank" if count == 1 else f"{count} ranks"
    unit = f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"
    return f"""<!-- Written by tools/demo_pages.py -->

# {title}

{text}

{shown}

## What it prints

On {ranks} and one thread, with meshing, compilation of forms and pictures {unit}:

```{{code-block}} text
{printed}
```

## Source

`demos/{name}.py`

```{{literalinclude}} ../../../demos/{name}.py
:language: python
:lines: 3-
```
"""


def index() -> str:
    """The list of all demos."""
    text = """<!-- Written by tools/demo_pages.py -->

# Demos

Each demo is one file that prints what was expected, what was computed and the error, and leaves its
pictures in `demos/output`. They share meshes, closed formulas and plots in the folders beside them;
if you want a script to copy from, take a [tutorial](../tutorials/index.md). All of them run in the
tests. These pages were made by running them (`make demo-pages`).
"""
    for subject, group in SUBJECTS.items():
        text += f"\n## {subject}\n\n|  | demo | shows |\n| --- | --- | --- |\n"
        for name, what in group.items():
            pictures = sorted(PICTURES.glob(f"{name}*.png"))
            pictures = [path for path in pictures if owner(path.stem) == name]
            first = f"![](pictures/{pictures[0].name})" if pictures else ""
            text += f"| {first} | [{name}]({name}.md) | {what} |\n"
    return text + "\n```{toctree}\n:hidden:\n\n" + "\n".join(names()) + "\n```\n"


def main(wanted: list[str]) -> None:
    """Run the demos and write pages."""
    unknown = set(wanted) - set(names())
    if unknown:
        sys.exit(f"there is no demo of the name {', '.join(sorted(unknown))}")
    for name in wanted or [name for name in names() if name not in LONG]:
        with tempfile.TemporaryDirectory() as folder:
            printed, seconds = run(name, Path(folder))
            pictures = keep_pictures(name, Path(folder))
        (PAGES / f"{name}.md").write_text(page(name, printed, seconds, pictures))
        print(f"{name}: {seconds:.0f} s, {len(pictures)} pictures", flush=True)
    (PAGES / "index.md").write_text(index())


if __name__ == "__main__":
    main(sys.argv[1:])
