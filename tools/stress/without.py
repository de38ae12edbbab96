# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the stress map loses without a rule of the method, rule by rule.

    python tools/stress/without.py --every 20
    python tools/stress/without.py --every 20 --only "slip closings" "drift"
    python tools/stress/without.py --every 1 --together --only "slip closings" "drift"

``rules.json`` has for each rule the file and the text that switch it off. A copy of the package is
built once with all of these behind an environment variable, in build/without; the map is run with
all rules, then without each one (or without all named ones together), and a row for each is
printed: scenes that are solved with all rules and lost without, and those gained; wrong ones;
iterations of the scenes that both solve, and solves of attempts that failed.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("tests", "demos", "tools")]

import contactx  # noqa: E402, F401  # it comes first

# isort: split
from stress import sheet  # noqa: E402
from stress.outcome import Kind, Outcome  # noqa: E402

OUTPUT = ROOT / "build" / "without"
RULES = Path(__file__).with_name("rules.json")
_VARIABLE = "CONTACTX_WITHOUT"
_HEADER = """#pragma once
#include <cstdlib>
#include <string>

/// Whether a rule is switched off
inline bool without(const char* rule)
{
  const char* all = std::getenv("CONTACTX_WITHOUT");
  static const std::string rules = all ? all : "";
  return rules.find(";" + std::string(rule) + ";") != std::string::npos;
}
"""


@dataclass(frozen=True)
class Row:
    """What came of the map without rules.

    Attributes:
        rules: Their names.
        lost: Scenes that are solved with all rules, but not without these.
        gained: The other way round.
        wrong: Wrong answers without them.
        before: Iterations with all rules of the scenes that are solved both ways.
        after: Those without.
        failed_before: Solves of attempts that failed, all rules, all scenes.
        failed_after: Those without.
        changed: Scenes with another number of solves.
    """

    rules: str
    lost: int
    gained: int
    wrong: int
    before: int
    after: int
    failed_before: int
    failed_after: int
    changed: int

    def __str__(self) -> str:
        """A row of a table in Markdown."""
        cells = [
            self.rules,
            self.changed,
            self.lost,
            self.gained,
            self.wrong,
            f"{self.before:,} to {self.after:,}",
            f"{self.failed_before:,} to {self.failed_after:,}",
        ]
        return f"| {' | '.join(map(str, cells))} |"


def switched(text: str, off: list[tuple[str, str]]) -> str:
    """A source text in which rules can be switched off.

    Raises:
        ValueError: If a text that is to be replaced is not there exactly once.
    """
    for old, new in off:
        if text.count(old) != 1:
            raise ValueError(f"rules.json: {text.count(old)} places have {old!r}")
        text = text.replace(old, new)
    return text


def build(output: Path) -> Path:
    """Build a copy of the package whose rules can be switched off, and return where it is."""
    copy, site = output / "source", output / "site"
    for folder in (copy, site):
        shutil.rmtree(folder, ignore_errors=True)
    copy.mkdir(parents=True)
    for name in ("cpp", "python"):
        shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("*.so"))
    for name in ("CMakeLists.txt", "pyproject.toml", "README.md"):
        shutil.copy(ROOT / name, copy)
    for file in ROOT.glob("LICENSE*"):
        shutil.copy(file, copy)
    (copy / "cpp" / "contactx" / "without.h").write_text(_HEADER)
    rules = json.loads(RULES.read_text())
    places: dict[str, list[tuple[str, str]]] = {}
    for rule in rules:
        for change in rule["off"]:
            new = change["new"].replace("OFF", f'without("{rule["name"]}")')
            places.setdefault(change["file"], []).append((change["old"], new))
    for name, off in places.items():
        path = copy / "cpp" / "contactx" / name
        text = switched(path.read_text(), off)
        include = '#include "' + "../" * name.count("/") + 'without.h"\n'
        first = text.index("#pragma once\n") + 13 if name.endswith(".h") else 0
        path.write_text(text[:first] + include + text[first:])
    command = f"{sys.executable} -m pip install --quiet --no-deps --no-build-isolation --target"
    environment = {**os.environ, "SKBUILD_BUILD_DIR": str(output / "build")}
    subprocess.run([*command.split(), str(site), str(copy)], check=True, env=environment)
    return site


def run(site: Path, output: Path, names: list[str], every: int, workers: int) -> list[Outcome]:
    """Run the map without some rules."""
    path = os.pathsep.join(filter(None, [str(site), os.environ.get("PYTHONPATH")]))
    subprocess.run(
        [
            sys.executable,
            str(ROOT / "tools" / "stress" / "stress_map.py"),
            f"--every={every}",
            f"--workers={workers}",
            f"--output={output}",
        ],
        env={**os.environ, "PYTHONPATH": path, _VARIABLE: f";{';'.join(names)};"},
        stdout=subprocess.DEVNULL,
        check=False,
    )
    return sheet.read(output / "map.csv")


def compared(rules: str, before: list[Outcome], after: list[Outcome]) -> Row:
    """What changes from one map to another."""
    pairs = list(zip(before, after, strict=True))
    solved = [(a, b) for a, b in pairs if not {a.kind, b.kind} & {Kind.REFUSED, Kind.WRONG}]
    return Row(
        rules,
        sum(a.kind != Kind.REFUSED and b.kind == Kind.REFUSED for a, b in pairs),
        sum(a.kind == Kind.REFUSED and b.kind != Kind.REFUSED for a, b in pairs),
        sum(b.kind == Kind.WRONG for b in after),
        sum(a.iterations for a, _ in solved),
        sum(b.iterations for _, b in solved),
        sum(a.discarded for a in before),
        sum(b.discarded for b in after),
        sum((a.iterations, a.discarded) != (b.iterations, b.discarded) for a, b in pairs),
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--every", type=int, default=20, help="take each n-th scene only")
    parser.add_argument("--workers", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only", nargs="+", help="names of rules")
    parser.add_argument("--together", action="store_true", help="switch them off together")
    parser.add_argument("--output", type=Path, default=OUTPUT)
    parser.add_argument("--built", action="store_true", help="the copy is there already")
    args = parser.parse_args()
    known = [rule["name"] for rule in json.loads(RULES.read_text())]
    names = args.only or known
    if unknown := set(names) - set(known):
        parser.error(f"no such rules: {', '.join(sorted(unknown))}")
    site = args.output / "site" if args.built else build(args.output)
    before = run(site, args.output / "all", [], args.every, args.workers)
    print("| without | changes | lost | gained | wrong | iterations | failed |")
    print("|---|---:|---:|---:|---:|---:|---:|", flush=True)
    for own in [names] if args.together else [[name] for name in names]:
        title = ", ".join(own)
        after = run(site, args.output / own[0].replace(" ", "_"), own, args.every, args.workers)
        print(compared(title, before, after), flush=True)


if __name__ == "__main__":
    main()
