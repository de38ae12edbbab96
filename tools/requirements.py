# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Print what to install before contactx itself is built and installed.

That is, one a line, what pyproject.toml requires for the build, for the run
and for the extras named on the command line.
"""

import re
import sys
import tomllib
from pathlib import Path


def main(extras: list[str]) -> None:
    """Print the requirements."""
    pyproject = Path(__file__).parents[1] / "pyproject.toml"
    tables = tomllib.loads(pyproject.read_text())
    project = tables["project"]
    queue = [*tables["build-system"]["requires"], *project["dependencies"]]
    queue += [f"{project['name']}[{','.join(extras)}]"]
    found = []
    while queue:
        requirement = queue.pop(0)
        # An extra of the project itself stands for its requirements.
        own = re.fullmatch(rf"{project['name']}\[(.*)\]", requirement)
        if own is None:
            found.append(requirement)
        else:
            for extra in own[1].split(","):
                queue += project["optional-dependencies"][extra.strip()]
    print("\n".join(dict.fromkeys(found)))


main(sys.argv[1:])
