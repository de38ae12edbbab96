# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What README and manual say of measured results, made from the record of ``measured.py``.

Sentences are templates in docs/said.toml, whose fields are filled from ``values``; tables are
``TABLES``. Pages stay plain Markdown: ``differences`` looks for both in them, and ``rewrite`` puts
the recorded figures in the place of others. Pictures bear a digest of what they were drawn from.
"""

from __future__ import annotations

import hashlib
import json
import re
import string
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tables
from peers import table as peers_table

ROOT = Path(__file__).parents[1]
SAID = ROOT / "docs" / "said.toml"
PEERS = peers_table.FILE
# Pictures that are drawn from the record, and the sections that they show
PICTURES = {"error_time": (), "methods": ("methods",), "stress_map": ("stress_map",)}
METHODS = {"n2s": "node-to-surface", "s2s": "surface-to-surface"}
# Sizes of the common Hertz problem that the pages speak of
SIZES = (0.02, 0.01, 0.005)
# From how many displacements on growth is fitted, see bench_growth.py
GROWN = 30_000
# Total force by exact multipliers in another program, see docs/manual/numbers/accuracy.md
ELSEWHERE = {
    ("finite", 0.04): "0.0024350",
    ("finite", 0.02): "0.0023729",
    ("finite", 0.01): "0.0023524",
    ("small", 0.04): "0.0024371",
    ("small", 0.02): "0.0023736",
    ("small", 0.01): "0.0023530",
}

type Sections = Mapping[str, Mapping[str, Any]]
type Row = dict[str, Any]


def values(sections: Sections) -> dict[str, Any]:
    """Fields of the templates: rows by method and size, and what follows from them."""
    methods = sections["methods"]["rows"]
    growth = sections["growth"]["rows"]
    large = [row for row in growth if row["dofs"] > 0.95 * GROWN]
    known: dict[str, Any] = {
        f"{name}{ending}": {
            f"{row['h']:g}": row for row in _pick(methods, cells="tetrahedra", **kind)
        }
        for name, method in METHODS.items()
        for ending, sliding in (("", "finite"), ("_small", "small"))
        for kind in ({"method": method, "sliding": sliding},)
    }
    for ending in ("", "_small"):
        rows = [known[f"s2s{ending}"][f"{h:g}"] for h in SIZES]
        known[f"cost{ending}"] = _range(row["ratio"] for row in rows)
    hexahedra = _pick(methods, cells="hexahedra", h=0.01, sliding="finite", method=METHODS["s2s"])
    known["cost"]["hexahedra"] = hexahedra[0]["ratio"]
    known["stiff"] = {
        f"{row['stiff']} {name}": row
        for name, method in METHODS.items()
        for row in methods
        if "cells" not in row and row["method"] == method
    }
    known["mumps"] = _range(1 / row["ratio"] for row in _compared(sections, 0.01))
    largest = max(growth, key=lambda row: row["dofs"])
    known["million"] = {**largest, "gigabytes": largest["memory"] / 1000}
    known["growth"] = {
        key: tables.power_law([row["dofs"] for row in large], [row[key] for row in large])[0]
        for key in ("cpu", "memory")
    }
    known["beside"] = {
        f"{short} {row['h']:g}": row
        for short, method in METHODS.items()
        for name, rows in peers_table.numbers(PEERS).items()
        for row in rows
        if name.startswith(peers_table.OURS) and name.endswith(method)
    }
    known["fastest"] = {f"{h:g}": peer for h in SIZES if (peer := _fastest(h))}
    known["map"] = _of_map(sections["stress_map"])
    known["gallery"] = _of_gallery(sections["gallery"])
    known["case"] = {row["name"]: 100 * row["error"] for row in sections["gallery"]["rows"]}
    known["peers"] = of_peers()
    known["where"] = {name: where(section) for name, section in sections.items()}
    return known


def where(section: Mapping[str, Any]) -> str:
    """By which version, on what machine and when a section was measured."""
    version = f"contactx {section['version']}, " if "version" in section else ""
    return f"{version}commit {section['commit']}, {section['machine']}, {section['date']}"


def of_peers() -> str:
    """Where and when the codes of the comparison were measured, as far as their file says."""
    rows = peers_table.rows(PEERS)
    known = [row for row in rows if row["machine"]]
    days = sorted({row["date"] for row in known})
    text = f"on {' to '.join(dict.fromkeys((days[0], days[-1])))} on {known[0]['machine']}"
    every, older = (
        Counter(f"{row['peer']} {row['version']}" for row in of)
        for of in (rows, [row for row in rows if not row["machine"]])
    )
    if not older:
        return text
    left = [
        name if older[name] == every[name] else f"{n} row{'s' * (n > 1)} of {name}"
        for name, n in older.items()
    ]
    return f"{text}, but for {', '.join(left)}, of an earlier day"


def digest(sections: Sections, picture: str) -> str:
    """What tells whether a picture was drawn from the record as it is."""
    shown: list[Any] = [sections[name] for name in PICTURES[picture]]
    if picture == "error_time":
        shown.append(PEERS.read_text(encoding="utf-8"))
    return hashlib.sha256(json.dumps(shown, sort_keys=True).encode()).hexdigest()[:16]


# Tables ------------------------------------------------------------------------------------------


def hertz(sections: Sections) -> Iterator[Sequence[str]]:
    """Node-to-surface on the common Hertz problem: what it takes."""
    yield (
        *("h", "displacements", "sliding", "iterations, Krylov", "CPU s", "MB"),
        "MUMPS on the saddle point takes",
    )
    known = values(sections)
    for h in SIZES:
        rows = [known[name][f"{h:g}"] for name in ("n2s_small", "n2s")]
        other = {row["sliding"]: row for row in _compared(sections, h)}
        times = [f"{1 / other[s]['ratio']:.1f}" for s in ("small", "finite") if s in other]
        yield (
            *(f"{h:g}", f"{rows[0]['dofs']:,}", "small / finite"),
            " / ".join(f"{row['iterations']}, {row['krylov'] or '-'}" for row in rows),
            " / ".join(seconds(row["cpu"]) for row in rows),
            " / ".join(f"{row['memory']:,.0f}" for row in rows),
            f"{' / '.join(times)} times as long" if times else "",
        )
    row = known["million"]
    yield (
        *(f"{row['h']:g}", f"{row['dofs']:,}", "small", f"{row['iterations']}, {row['krylov']}"),
        *(seconds(row["cpu"]), f"{row['memory']:,.0f}", ""),
    )


def peers(sections: Sections) -> Iterator[Sequence[str]]:
    """Other codes on the common Hertz problem, digits as they stand in the file."""
    yield (
        *("code and setting", "h", "displacements", "iterations", "CPU s (wall)", "MB"),
        *("p_l2", "depth"),
    )
    for row in peers_table.rows(PEERS):
        yield tuple(peers_table.shown(row).values())


def limit(sections: Sections) -> Iterator[Sequence[str]]:
    """Contact in linear solves of the same mesh."""
    names = [name for method in METHODS.values() for name in (method, "with friction 0.3")]
    yield "h", *names
    rows = sections["limit"]["rows"]
    for h in SIZES:
        own = [_pick(rows, h=h, method=m, friction=f) for m in METHODS.values() for f in (0.0, 0.3)]
        yield f"{h:g}", *(f"{row['ratio']:.1f}" for (row,) in own)


def methods(sections: Sections) -> Iterator[Sequence[str]]:
    """Both methods on the common Hertz problem."""
    yield "cells", "h", "method", "iterations", "p_l2, raw", "p_l2", "peak, raw", "peak", "CPU"
    rows = sections["methods"]["rows"]
    for cells, sizes in (("tetrahedra", SIZES), ("hexahedra", (0.01,))):
        for h in sizes:
            for method in METHODS.values():
                (row,) = _pick(rows, cells=cells, h=h, method=method, sliding="finite")
                is_first = (h, method) == (sizes[0], METHODS["n2s"])
                yield (
                    *(cells if is_first else "", f"{h:g}", method, str(row["iterations"])),
                    *(f"{row[key]:.3f}" for key in ("p_l2", "p_l2_best")),
                    *(_percent(100 * row[key]) for key in ("p0_err", "p0_best")),
                    f"{row['ratio']:.2f}" if method == METHODS["s2s"] else "",
                )


def total_force(sections: Sections) -> Iterator[Sequence[str]]:
    """Force and pressure of the common Hertz problem, node-to-surface."""
    yield (
        *("h", "sliding", "total force 4F", "exact multipliers elsewhere", "iterations"),
        *("p_l2, raw", "p_l2"),
    )
    known = values(sections)
    for (sliding, h), force in ELSEWHERE.items():
        row = known["n2s" if sliding == "finite" else "n2s_small"][f"{h:g}"]
        yield (
            *(f"{h:g}", sliding, f"{row['force']:.7f}", force, str(row["iterations"])),
            *(f"{row[key]:.3f}" for key in ("p_l2", "p_l2_best")),
        )


def degrees(sections: Sections) -> Iterator[Sequence[str]]:
    """Linear and quadratic displacements on the common Hertz problem."""
    sizes = ("0.08", "0.04", "0.02")
    yield "", "h = 0.08", "0.04", "0.02", "time at 0.02"
    known = {
        f"{row['degree']} {row['cells']} {row['method']} {row['h']:g}": row
        for row in sections["degrees"]["rows"]
    }
    first = known[f"1 tetrahedra {METHODS['n2s']} 0.02"]["cpu"]
    for degree, cells, words in ((1, "tetrahedra", "linear"), (2, "tetrahedra", "quadratic")):
        for method in METHODS.values():
            yield _of_degree(known, (degree, cells, method), f"{words}, {method}", sizes, first)
    curved = (2, "curved", METHODS["s2s"])
    yield _of_degree(known, curved, "the same on a curved mesh", sizes, first)


def _of_degree(
    known: Row, kind: tuple[int, str, str], name: str, sizes: Sequence[str], first: float
) -> Sequence[str]:
    rows = [known[f"{kind[0]} {kind[1]} {kind[2]} {h}"] for h in sizes]
    time = rows[-1]["cpu"] / first
    return name, *(f"{row['error']:.3f}" for row in rows), f"{time:.1f}"


def tip(sections: Sections) -> Iterator[Sequence[str]]:
    """A corner that slides along an arm."""
    yield "n", "slave", "method", "force along, down", "work not stored"
    for row in sections["edges"]["rows"]:
        if "n" not in row:
            continue
        if "refused" in row:
            forces, lost = f"refused at a depth of {row['depth']:.2f}", ""
        else:
            forces = f"{1e4 * row['along']:.3f}, {1e4 * row['down']:.3f}"
            lost = _percent(100 * abs(row["lost"]))
        yield str(row["n"]), row["slave"], row["method"], forces, lost


def ball(sections: Sections) -> Iterator[Sequence[str]]:
    """A ball beside the edge of a plate."""
    yield "h", "method", "slave", "force", "across : down"
    for row in sections["edges"]["rows"]:
        if "ratio" in row:
            force = f"{row['force']:.4f}"
            yield f"{row['h']:g}", row["method"], row["slave"], force, f"{row['ratio']:.2f}"


def nafems(sections: Sections) -> Iterator[Sequence[str]]:
    """Problems 1 and 2 of NAFEMS R0094."""
    yield "problem", "friction", "model", "h, mm", "method", "published", "contactx", "error"
    for row in sections["nafems"]["rows"]:
        yield (
            *(row["problem"], f"{row['friction']:g}", row["model"], f"{row['h']:g}", row["method"]),
            *(f"{row['published']:.5g}", f"{row['value']:.5g}", f"{100 * row['error']:+.2f} %"),
        )


def stress_map(sections: Sections) -> Iterator[Sequence[str]]:
    """Families of the stress map, and all of them."""
    counted = ("scenes", "converged", "after cut-back", "rightly refused", "refused", "WRONG")
    summed = ("steps", "iterations")
    yield "family", *counted, *summed, "most in a step"
    rows = sections["stress_map"]["rows"]
    for row in rows:
        most = "" if row["most"] is None else f"{row['most']:.0f}"
        yield row["family"], *(_count(row[key]) for key in (*counted, *summed)), most
    total = {key: sum(row[key] or 0 for row in rows) for key in (*counted, *summed)}
    most = max(row["most"] or 0 for row in rows)
    yield "all", *(_count(total[key]) for key in (*counted, *summed)), f"{most:.0f}"


@dataclass(frozen=True)
class Table:
    """A table of a page.

    Attributes:
        page: The page.
        begins: How the line of its headings begins there, and on no other table.
        rows: Headings and rows from the record.
        right: Which columns are flush right; none by default.
    """

    page: str
    begins: str
    rows: Callable[[Sections], Iterator[Sequence[str]]]
    right: Sequence[int] = ()

    def lines(self, sections: Sections) -> list[str]:
        """The table as Markdown."""
        head, *rows = self.rows(sections)
        marks = ["---:" if k in self.right else "---" for k in range(len(head))]
        return [f"| {' | '.join(cells)} |" for cells in (head, marks, *rows)]


_NUMBERS = "docs/manual/numbers"
TABLES = (
    Table(f"{_NUMBERS}/speed.md", "| h | displacements |", hertz),
    Table(f"{_NUMBERS}/speed.md", "| code and setting |", peers, range(2, 8)),
    Table(f"{_NUMBERS}/speed.md", "| h | node-to-surface |", limit),
    Table(f"{_NUMBERS}/methods.md", "| cells | h |", methods),
    Table(f"{_NUMBERS}/methods.md", "| n | slave |", tip),
    Table(f"{_NUMBERS}/methods.md", "| h | method | slave |", ball),
    Table(f"{_NUMBERS}/accuracy.md", "| h | sliding | total force 4F |", total_force),
    Table(f"{_NUMBERS}/accuracy.md", "|  | h = 0.08 |", degrees),
    Table(f"{_NUMBERS}/accuracy.md", "| problem | friction | model |", nafems, range(5, 8)),
    Table(f"{_NUMBERS}/stress_map.md", "| family | scenes |", stress_map, range(1, 10)),
)


# Pages -------------------------------------------------------------------------------------------


def said() -> list[tuple[str, str]]:
    """Pages, each with a template of what it says."""
    found = tomllib.loads(SAID.read_text(encoding="utf-8"))
    return [(page, " ".join(text.split())) for page, texts in found.items() for text in texts]


def differences(read: Callable[[str], str], sections: Sections) -> list[str]:
    """Where pages are not what the record makes them.

    Args:
        read: Gives the text of a page.
        sections: The record.
    """
    known, found = values(sections), []
    for page, template in said():
        text = " ".join(read(page).split())
        expected = " ".join(template.format(**known).split())
        if expected not in text:
            says = [match[0] for match in _places(template, text, known)]
            found.append(f"{page} says\n  {says or 'nothing like it'}\nrecorded is\n  {expected}")
    for table in TABLES:
        lines = table.lines(sections)
        there = _lines_of(table, read(table.page))
        if there != lines:
            now, then = (set(part) for part in (there, lines))
            say = "\n  ".join([*(now - then), "recorded is", *(then - now)])
            found.append(f"{table.page} has in the table {table.begins}\n  {say}")
    return found


def rewrite(sections: Sections) -> list[str]:
    """Put the recorded figures into all pages.

    Returns:
        Pages that have changed.

    Raises:
        ValueError: If a page does not have one place for a sentence or a table.
    """
    known = values(sections)
    pages = dict.fromkeys([*(page for page, _ in said()), *(table.page for table in TABLES)])
    texts = {page: (ROOT / page).read_text(encoding="utf-8") for page in pages}
    before = dict(texts)
    for page, template in said():
        match = list(_places(template, texts[page], known))
        if len(match) != 1:
            raise ValueError(f"{page} has {len(match)} places for: {template}")
        texts[page] = _filled(template, match[0], known)
    for table in TABLES:
        now = "\n".join(_lines_of(table, texts[table.page]))
        if not now or texts[table.page].count(now) != 1:
            raise ValueError(f"{table.page} has no table that begins with {table.begins}")
        texts[table.page] = texts[table.page].replace(now, "\n".join(table.lines(sections)))
    changed = [page for page in pages if texts[page] != before[page]]
    for page in changed:
        (ROOT / page).write_text(texts[page], encoding="utf-8")
    return changed


def _places(template: str, text: str, known: Row) -> Iterator[re.Match[str]]:
    """Where a text has the words of a template, whatever numbers or words its fields have."""
    pattern, formatter = "", string.Formatter()
    for words, field, _, _ in formatter.parse(template):
        pattern += r"\s+".join(re.escape(part) for part in re.split(r"\s+", words))
        if field is not None:
            is_text = isinstance(formatter.get_field(field, (), known)[0], str)
            pattern += r"([^|]{0,900}?)" if is_text else r"([^\s|]{1,20}?)"
    # The point at the end of a sentence is not that of a number
    return re.finditer(pattern + r"(?!\d)", text)


def _filled(template: str, match: re.Match[str], known: Row) -> str:
    """The page with recorded values in the fields of a template; its lines stay as they are."""
    text, end = "", 0
    fields = [part for part in string.Formatter().parse(template) if part[1] is not None]
    for number, (_, field, form, _) in enumerate(fields, start=1):
        value = string.Formatter().vformat(f"{{{field}:{form}}}", (), known)
        start, stop = match.span(number)
        same = match[number].split() == value.split()
        text += match.string[end:start] + (match[number] if same else value)
        end = stop
    return text + match.string[end:]


def _lines_of(table: Table, text: str) -> list[str]:
    """The lines of a table in a page."""
    lines = text.splitlines()
    starts = [k for k, line in enumerate(lines) if line.startswith(table.begins)]
    if len(starts) != 1:
        return []
    end = starts[0]
    while end < len(lines) and lines[end].startswith("|"):
        end += 1
    return lines[starts[0] : end]


# Parts -------------------------------------------------------------------------------------------


def seconds(value: float) -> str:
    """Seconds with two digits or three."""
    return f"{value:.2f}" if value < 1 else f"{value:.1f}" if value < 20 else f"{value:.0f}"


def _percent(value: float) -> str:
    digits = 0 if abs(value) >= 9.95 else 1 if abs(value) >= 0.095 else 2
    return f"{value:.{digits}f} %"


def _count(value: int | None) -> str:
    return "" if value is None else f"{value:,}"


def _range(found: Iterator[float]) -> dict[str, float]:
    every = list(found)
    return {"least": min(every), "most": max(every)}


def _pick(rows: Sequence[Row], **wanted: Any) -> list[Row]:
    return [row for row in rows if all(row.get(k) == value for k, value in wanted.items())]


def _compared(sections: Sections, h: float) -> list[Row]:
    """Rows of the condensed solver that have been compared with MUMPS."""
    rows = sections["hertz"]["rows"]
    return [row for row in _pick(rows, h=h, took="condensed") if "ratio" in row]


def _fastest(h: float) -> Row | None:
    rows = [
        {**row, "name": name.partition(",")[0], "seconds": seconds(row["cpu"])}
        for name, of_peer in peers_table.others(PEERS).items()
        for row in of_peer
        if row["h"] == h and "cpu" in row
    ]
    return min(rows, key=lambda row: row["cpu"], default=None)


def _of_map(section: Mapping[str, Any]) -> dict[str, Any]:
    rows = section["rows"]
    total = {key: sum(row[key] or 0 for row in rows) for key in ("of", "scenes")}
    kinds = ("converged", "after cut-back", "rightly refused", "refused", "WRONG")
    came = {kind: sum(row[kind] or 0 for row in rows) for kind in kinds}
    left = total["of"] - total["scenes"]
    if left:
        run = f"{total['scenes']:,} of {total['of']:,} problems have been run, {left:,} have not"
    else:
        run = f"All {total['of']:,} problems were run on {section['date']}"
    wrong = came["WRONG"]
    return {
        **total,
        "run": run,
        "solved": came["converged"] + came["after cut-back"],
        "rightly": came["rightly refused"],
        "refused": came["refused"],
        "wrong": {0: "none has a wrong answer", 1: "one has a wrong answer"}.get(
            wrong, f"{wrong} have a wrong answer"
        ),
        # Behind the end of a sentence
        "since": f" {section['since']}" if section.get("since") else "",
    }


def _of_gallery(section: Mapping[str, Any]) -> dict[str, Any]:
    # It needs DOLFINx
    from published.gallery import counts

    return counts(section["rows"])
