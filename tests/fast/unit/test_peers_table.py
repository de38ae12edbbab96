# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The table of what peers measured keeps the rows that are not measured again."""

from peers import table


def row(peer, h, cpu, date="2026-11-21", **more):
    return {"peer": peer, "setting": "hard", "h": h, "cpu": cpu, "date": date, **more}


def test_measured_rows_take_the_place_of_earlier_ones(tmp_path):
    path = tmp_path / "peers.csv"
    path.write_text("peer,setting,h\n")
    table.update([row("A", "0.01", "3.0", version="2.20"), row("B", "0.01", "2.0")], path)
    new = [row("A", "0.02", "1.0", "2026-11-26"), row("A", "0.01", "2.9", "2026-11-26")]
    every = table.update([*new, row(table.OURS, "0.01", "0.5", "2026-11-26", commit="abc")], path)
    found = [(r["peer"], r["h"], r["cpu"], r["date"]) for r in table.rows(path)]
    assert found == [
        (table.OURS, "0.01", "0.5", "2026-11-26"),
        ("A", "0.02", "1.0", "2026-11-26"),
        ("A", "0.01", "2.9", "2026-11-26"),
        ("B", "0.01", "2.0", "2026-11-21"),
    ]
    assert len(every) == len(found)
    assert list(table.others(path)) == ["A, hard", "B, hard"]


def test_versions_stay_as_they_are_written():
    names = list(table.others())
    assert any(name.startswith("CalculiX 2.20, ") for name in names)
    assert not any(name.startswith(table.OURS) for name in names)
    assert all(row["date"] for row in table.rows())
