# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The conda recipe can be read and says what pyproject.toml says."""

import re
import tomllib
from pathlib import Path

import jinja2
import yaml

ROOT = Path(__file__).parents[3]


def recipe():
    """The recipe, as conda reads it on Linux with Python 3.13."""
    text = (ROOT / "recipe" / "meta.yaml").read_text()
    template = jinja2.Environment(undefined=jinja2.StrictUndefined).from_string(text)
    rendered = template.render(
        PYTHON="python",
        compiler=lambda language: f"{language}_compiler",
        stdlib=lambda language: f"{language}_stdlib",
    )
    lines = (re.sub(r"(.*)  # \[win or py<312\]$", "", line) for line in rendered.splitlines())
    return yaml.safe_load("\n".join(lines))


def test_the_recipe_is_that_of_the_project():
    meta = recipe()
    tables = tomllib.loads((ROOT / "pyproject.toml").read_text())
    project = tables["project"]
    assert meta["package"] == {"name": project["name"], "version": project["version"]}
    assert "skip" not in meta["build"]
    assert meta["about"]["license"] == project["license"]
    assert meta["about"]["license_file"] == project["license-files"]
    for name in meta["about"]["license_file"]:
        assert (ROOT / name).exists()

    def names(requirements):
        return {re.split(r"[ <>=]", r, maxsplit=1)[0] for r in requirements}

    needs = meta["requirements"]
    # PyPI's wheel of Eigen has a name of its own
    build = {name.removeprefix("cmeel-") for name in names(tables["build-system"]["requires"])}
    assert build <= names(needs["host"])
    assert names(project["dependencies"]) <= names(needs["run"])
    assert "fenics-dolfinx 0.11.*" in needs["run"]
