# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How Sphinx makes the manual, `make docs`, without a network for it or its readers."""

import re

import contactx

project = "contactx"
author = "contactx authors"
project_copyright = "2026, contactx authors"
version = release = contactx.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    # Brings MathJax with its fonts and sets its path
    "sphinx-mathjax-offline",
]
exclude_patterns = ["_build", "demos/results"]

html_theme = "furo"
html_title = f"contactx {release}"
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "navigation_with_keys": True,
    "light_css_variables": {
        "color-brand-primary": "#00597c",
        "color-brand-content": "#00597c",
    },
}

myst_enable_extensions = [
    "amsmath",
    "attrs_inline",
    "colon_fence",
    "deflist",
    "dollarmath",
]
myst_heading_anchors = 4

# A line of a console is copied without its prompt
copybutton_prompt_text = r">>> |\$ "
copybutton_prompt_is_regexp = True

autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_format = "short"
autodoc_typehints_description_target = "documented_params"
autoclass_content = "both"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88
napoleon_numpy_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False


# How docstrings and messages name pages of the manual
_PAGE = re.compile(r"\b((?:theory|errors|numbers|howto|tutorials)/[\w-]+)")


def _as_rst(app, what, name, obj, options, lines):
    """Make docstrings those of Sphinx.

    Bars are absolute values in them, not the names of substitutions, and pages of the
    manual are links.
    """
    for i, line in enumerate(lines):
        parts = line.split("``")
        parts[::2] = [
            _PAGE.sub(r":doc:`\1 </\1>`", part.replace("|", r"\|"))
            for part in parts[::2]
        ]
        lines[i] = "``".join(parts)


def setup(app):
    """Sphinx calls this."""
    app.connect("autodoc-process-docstring", _as_rst)
