# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Write python/contactx/cpp.pyi, the types of the bindings, from the compiled extension.

pybind11-stubgen reads the signatures that pybind11 writes into docstrings. What they do not say is
mended here: classes that are bound after their first use, and arguments that may be None.

    python tools/stubs.py
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tempfile
from pathlib import Path

STUB = Path(__file__).parents[1] / "python" / "contactx" / "cpp.pyi"
# Classes with another name in Python than in C++, where their binding comes after their first use
_RENAMED = {"contactx::mesh::Mesh": "ReferenceMesh"}
_HEAD = """\
# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
# Written by tools/stubs.py

from collections.abc import {abc}
from typing import {typing}

import numpy as np
from numpy.typing import ArrayLike, NDArray

type Float = SupportsFloat | SupportsIndex
type Int = SupportsInt | SupportsIndex

"""
_ABC = ("Callable", "Iterable", "Iterator", "Mapping", "Sequence")
_TYPING = ("Any", "ClassVar", "SupportsFloat", "SupportsIndex", "SupportsInt", "overload")
_SHORTER = (
    (r"\b(?:numpy\.typing|collections\.abc|typing)\.", ""),
    (r"\bnumpy\.", "np."),
    (r"\bAnnotated\[ArrayLike, np\.\w+\]", "ArrayLike"),
    (r"\bAnnotated\[(NDArray\[np\.\w+\]), ['\"]?\[\w+, \w+\]['\"]?\]", r"\1"),
    (r"\bSupportsFloat \| SupportsIndex\b", "Float"),
    (r"\bSupportsInt \| SupportsIndex\b", "Int"),
    # What a callback returns may be an array
    (r"\bSequence\[(?:Float|Int)\]", "ArrayLike"),
)


class _Mended(ast.NodeTransformer):
    """Leaves docstrings out, and makes types what mypy accepts."""

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        """Leave out how objects compare, which each object has already."""
        self.generic_visit(node)
        node.body = [n for n in node.body if not _compares(n)] or [_ellipsis()]
        return node

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        """Let arguments be None that are so by default."""
        arguments = node.args
        defaults = [None] * (len(arguments.args) - len(arguments.defaults)) + arguments.defaults
        pairs = zip(
            [*arguments.args, *arguments.kwonlyargs],
            [*defaults, *arguments.kw_defaults],
            strict=True,
        )
        for argument, default in pairs:
            if argument.annotation is None or default is None:
                continue
            text = ast.unparse(argument.annotation)
            if ast.unparse(default) == "None" and not re.search(r"\bNone\b", text):
                argument.annotation = ast.parse(f"{text} | None", mode="eval").body
        node.body = [_ellipsis()]
        return node

    def visit_Expr(self, node: ast.Expr) -> ast.AST | None:
        """Leave out docstrings."""
        is_text = isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
        return None if is_text else node


def _ellipsis() -> ast.Expr:
    return ast.Expr(ast.Constant(...))


def _compares(node: ast.stmt) -> bool:
    name = node.name if isinstance(node, ast.FunctionDef) else _assigned(node)
    return name in ("__eq__", "__ne__", "__hash__")


def _assigned(node: ast.stmt) -> str:
    """Name that an annotated assignment gives a value, if it is one."""
    return ast.unparse(node.target) if isinstance(node, ast.AnnAssign) else ""


def _mended(text: str) -> str:
    """Text of pybind11-stubgen without what is not Python, shorter."""
    for name, renamed in _RENAMED.items():
        text = text.replace(name, renamed)
    text = re.sub(r"\bcontactx::(?:\w+::)*(\w+)", r"\1", text)
    tree = _Mended().visit(ast.parse(text))
    tree.body = [
        node
        for node in tree.body
        if not isinstance(node, ast.Import | ast.ImportFrom) and _assigned(node) != "__all__"
    ]
    text = ast.unparse(tree)
    for pattern, shorter in _SHORTER:
        text = re.sub(pattern, shorter, text)
    words = {*re.findall(r"\w+", _HEAD + text)}
    abc, typing = (", ".join(n for n in names if n in words) for names in (_ABC, _TYPING))
    return _HEAD.format(abc=abc, typing=typing) + text + "\n"


def stub() -> str:
    """The types of the compiled extension that contactx is imported with."""
    generator = [sys.executable, "-m", "pybind11_stubgen", "contactx.cpp"]
    options = ["--numpy-array-use-type-var", "--print-invalid-expressions-as-is"]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [*generator, *options, "-o", folder], check=True, capture_output=True, cwd=folder
        )
        text = (Path(folder) / "contactx" / "cpp.pyi").read_text(encoding="utf-8")
    formatter = [sys.executable, "-m", "ruff", "format", "--stdin-filename", str(STUB), "-"]
    return subprocess.run(
        formatter, input=_mended(text), check=True, capture_output=True, text=True
    ).stdout


if __name__ == "__main__":
    STUB.write_text(stub(), encoding="utf-8")
