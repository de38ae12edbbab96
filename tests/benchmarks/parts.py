# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Where the time goes: process CPU seconds of each part of a run, by the functions that it is in.

The library is watched from outside (sys.monitoring), so that it carries no timers for this. Time
belongs to the innermost function of the library that a part is named for; what such a function
calls, in numpy, DOLFINx or PETSc, is its own time. Functions without a part count for their caller.
"""

from __future__ import annotations

import importlib
import inspect
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import CodeType
from typing import Any

import contactx

ASSEMBLY = "bulk assembly"
FORMS = "bulk forms"
CONTACT = "contact assembly"
SEARCH = "search and pairing"
CONDENSATION = "condensation"
STATUS = "status and law"
HIERARCHY = "hierarchy"
KRYLOV = "Krylov"
DIRECT = "SNES and direct solver"
REST = "rest"

PARTS = (
    *(FORMS, ASSEMBLY, CONTACT, SEARCH, CONDENSATION, STATUS),
    *(HIERARCHY, KRYLOV, DIRECT, REST),
)
# Everything that is contact
OF_CONTACT = (CONTACT, SEARCH, CONDENSATION, STATUS)

# Part of each module or folder, and of those functions of it that are of another part; None is the
# caller's. The empty name stands for all other functions.
_RULES: dict[str, dict[str, str | None]] = {
    "arguments": {"": REST},
    "assembly": {"": CONTACT},
    "bodies": {"": STATUS},
    "bodies/modes": {"": None},
    "bulk": {"": ASSEMBLY, "Bulk.__init__": FORMS},
    "bulk_input": {"": REST},
    "callback": {"": None},
    "compat": {"": REST},
    "condensed": {"": CONDENSATION},
    "condensed/operator": {
        "": CONDENSATION,
        # The products of the bulk's matrix and what PETSc does between them
        "CondensedOperator.mult": KRYLOV,
        "CondensedOperator.bulk": KRYLOV,
    },
    "condensed/guess": {"": KRYLOV},
    "condensed/multigrid": {
        "": CONDENSATION,
        "Multigrid._iterate": KRYLOV,
        "Multigrid._make": HIERARCHY,
        "near_null_space": HIERARCHY,
    },
    "condensed/solver": {"": CONDENSATION, "CondensedSolver._solve_directly": DIRECT},
    "contact": {"": CONTACT},
    "contact_matrix": {"": CONTACT},
    "contact_mesh": {"": CONTACT},
    "convergence": {"": STATUS},
    "cycling": {"": STATUS},
    "errors": {"": None},
    "factorised": {"": DIRECT},
    "fields": {"": CONTACT},
    "files": {"": REST},
    "forms": {"": CONTACT},
    "geometry": {"": SEARCH},
    "interface": {
        "": CONTACT,
        "Interface._pair": SEARCH,
        "Interface._find_immobile": SEARCH,
        "Interface.update_status": STATUS,
        "Interface.closing": STATUS,
    },
    "interrupts": {"": None},
    "junctions": {"": STATUS},
    "law": {"": STATUS},
    "layout": {"": CONTACT},
    "linear": {"": None},
    "master": {"": SEARCH},
    "newton": {"": None, "NewtonLoop.run": DIRECT},
    "nodal": {"": CONTACT},
    "obstacles": {"": SEARCH},
    "options": {"": None},
    "parallel": {"": None},
    "problem": {"": REST},
    "recovery": {"": CONTACT},
    "report": {"": None},
    "search": {"": SEARCH},
    "slip": {"": CONTACT},
    "state": {"": CONTACT, "Snapshot.__init__": REST, "Snapshot.restore": REST},
    "steps": {"": REST},
    "surface": {"": SEARCH},
    "system": {"": CONTACT, "SaddlePointSystem._lift": ASSEMBLY},
}
# What no measured run enters
_NOT_WATCHED = ("__init__", "meshes", "output", "plot", "reference")

_PACKAGE = Path(contactx.__file__).parent


class Clock:
    """CPU seconds of each part.

    Attributes:
        functions: Seconds by part and function.
    """

    def __init__(self) -> None:
        self.functions: dict[tuple[str, str], float] = {}
        self._stack = [(REST, "")]
        self._known: dict[CodeType, tuple[str, str] | None] = {}
        self._last = time.process_time()

    @contextmanager
    def watching(self) -> Iterator[None]:
        """Watch what runs inside."""
        monitoring = sys.monitoring
        tool, events = monitoring.PROFILER_ID, monitoring.events
        monitoring.use_tool_id(tool, "contactx benchmark")
        callbacks = {
            events.PY_START: self._enter,
            events.PY_RETURN: self._leave,
            events.PY_UNWIND: self._unwind,
        }
        for event, callback in callbacks.items():
            monitoring.register_callback(tool, event, callback)
        self._last = time.process_time()
        monitoring.set_events(tool, sum(callbacks))
        try:
            yield
        finally:
            monitoring.set_events(tool, 0)
            monitoring.free_tool_id(tool)
            self._charge()

    @property
    def seconds(self) -> dict[str, float]:
        """Seconds by part."""
        total = dict.fromkeys(PARTS, 0.0)
        for (part, _), seconds in self.functions.items():
            total[part] += seconds
        return total

    def dearest(self, parts: Sequence[str], number: int) -> dict[str, float]:
        """Seconds of the functions of some parts that take most."""
        own = {name: s for (part, name), s in self.functions.items() if part in parts}
        return dict(sorted(own.items(), key=lambda item: -item[1])[:number])

    def _charge(self) -> None:
        now = time.process_time()
        key = self._stack[-1]
        self.functions[key] = self.functions.get(key, 0.0) + now - self._last
        self._last = now

    def _enter(self, code: CodeType, *_: Any) -> Any:
        part = self._part(code)
        if part is None:
            return sys.monitoring.DISABLE
        self._charge()
        self._stack.append(part)
        return None

    def _leave(self, code: CodeType, *_: Any) -> Any:
        if self._part(code) is None:
            return sys.monitoring.DISABLE
        self._charge()
        self._stack.pop()
        return None

    def _unwind(self, code: CodeType, *_: Any) -> None:
        if self._part(code) is not None:
            self._charge()
            self._stack.pop()

    def _part(self, code: CodeType) -> tuple[str, str] | None:
        try:
            return self._known[code]
        except KeyError:
            part = part_of(code)
            self._known[code] = found = None if part is None else (part, code.co_qualname)
            return found


def part_of(code: CodeType) -> str | None:
    """Part of a function; None where it is the caller's."""
    path = Path(code.co_filename)
    # Generators come and go; what they do is their caller's
    if not path.is_relative_to(_PACKAGE) or code.co_flags & inspect.CO_GENERATOR:
        return None
    rules = _rules_of(path.relative_to(_PACKAGE).with_suffix("").as_posix())
    return None if rules is None else rules.get(code.co_qualname, rules[""])


def _rules_of(module: str) -> dict[str, str | None] | None:
    return _RULES.get(module, _RULES.get(module.split("/")[0]))


def outdated() -> list[str]:
    """What the rules miss of the library, and what they name that it does not have."""
    found = []
    for path in _PACKAGE.rglob("*.py"):
        module = path.relative_to(_PACKAGE).with_suffix("").as_posix()
        if module.split("/")[0] not in _NOT_WATCHED and _rules_of(module) is None:
            found.append(f"{module} has no part")
    for name, rules in _RULES.items():
        if not (_PACKAGE / name).is_dir() and not (_PACKAGE / f"{name}.py").exists():
            found.append(f"there is no {name}")
            continue
        module = importlib.import_module("contactx." + name.replace("/", "."))
        for function in filter(None, rules):
            owner: Any = module
            for part in function.split("."):
                owner = getattr(owner, part, None)
            if owner is None:
                found.append(f"{name} has no {function}")
    return found
