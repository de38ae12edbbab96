# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How Sphinx makes the manual: `make docs`. Nothing is loaded from a network, now or by a reader."""

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
# Furo's default names a font service where the system has no font of its own
html_theme_options = {
    "navigation_with_keys": True,
    "light_css_variables": {"color-brand-primary": "#00597c", "color-brand-content": "#00597c"},
}

myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
# The page of the published benchmarks has a heading and a table from elsewhere
myst_links_external_new_tab = False

# A line of a console is copied without its prompt
copybutton_prompt_text = r">>> |\$ "
copybutton_prompt_is_regexp = True

autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_format = "short"
autodoc_typehints_description_target = "documented_params"
autodoc_class_signature = "separated"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88
napoleon_numpy_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False


def _escape_bars(app, what, name, obj, options, lines):  # noqa: ARG001
    """Bars are absolute values in docstrings, not the names of substitutions."""
    for i, line in enumerate(lines):
        parts = line.split("``")
        parts[::2] = [part.replace("|", r"\|") for part in parts[::2]]
        lines[i] = "``".join(parts)


def setup(app):
    """Sphinx calls this."""
    app.connect("autodoc-process-docstring", _escape_bars)
