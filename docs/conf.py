"""Settings of the documentation site: `make docs` builds it with Sphinx."""

import ast
import re
import sys
from pathlib import Path

from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "src"))

from loiter import __version__
from loiter.cli.app import app as commands

project, author, release = "loiter", "The loiter authors", __version__
project_copyright = author
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx_gallery.gen_gallery"]
exclude_patterns = ["gallery/*", "pictures/*.ipynb"]
suppress_warnings = ["config.cache"]
# A link to a page, a heading or a name that does not exist is an error, like every other warning.
nitpicky = True
# Except types of other packages: nothing is fetched, so their documentation is unknown.
nitpick_ignore_regex = [("py:class", r"(?!loiter\.).*|.*\.AnyTime")]
smartquotes = False
default_role = "code"

myst_heading_anchors = 4
myst_url_schemes = {"http": None, "https": None, "mailto": None}
# The outputs in the notebooks are those that `make notebooks` wrote; a test runs the notebooks and compares.
nb_execution_mode = "off"
nb_merge_streams = True

autodoc_default_options = {"members": True, "member-order": "bysource", "show-inheritance": False}
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
add_module_names = False


def save_figures(block, block_vars, gallery_conf):
    """Save the figures that a block of a gallery script has made; the library draws them without pyplot."""
    known = block_vars.setdefault("figures", set())
    found = [value for value in block_vars["example_globals"].values() if isinstance(value, Figure)]
    paths = []
    for figure in (figure for figure in found if id(figure) not in known):
        known.add(id(figure))
        paths.append(next(block_vars["image_path_iterator"]))
        figure.savefig(paths[-1], dpi=110)
    return figure_rst(
        paths,
        gallery_conf["src_dir"],
        ast.get_docstring(ast.parse(Path(block_vars["target_file"]).read_text())).splitlines()[0],
    )


sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "pictures",
    "filename_pattern": "/draw_",
    "ignore_pattern": r"__init__\.py",
    "abort_on_example_error": True,
    "min_reported_time": 1e9,
    "show_memory": False,
    "show_signature": False,
    "download_all_examples": False,
    "write_computation_times": False,
    "thumbnail_size": (480, 360),
    "remove_config_comments": True,
    "run_stale_examples": True,
    "within_subsection_order": "FileNameSortKey",
    "image_scrapers": (save_figures,),
}

html_theme = "pydata_sphinx_theme"
html_title = "loiter"
html_context = {"default_mode": "auto"}
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_favicon = "../src/loiter/web/static/icon.svg"
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "logo": {"text": "loiter", "image_light": "_static/icon.svg", "image_dark": "_static/icon.svg"},
    "header_links_before_dropdown": 7,
    "navbar_persistent": ["search-button"],
    "navbar_end": ["theme-switcher"],
    "secondary_sidebar_items": ["page-toc"],
    "show_prev_next": True,
    "navigation_with_keys": False,
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}

CODE = re.compile(r"`([^`]+)`")
DOCUMENT = re.compile(r"\bdocs/(\w+)\.md\b")


def as_restructured_text(line: str) -> str:
    """A line of a plain docstring in reStructuredText: code in backticks, nothing else marked up."""
    if line.lstrip().startswith((">>>", "...")):
        return line
    parts = CODE.split(line)
    for i, part in enumerate(parts):
        parts[i] = f"``{part}``" if i % 2 else re.sub(r"([*|\\])|(?<=\w)(_)(?=\W|$)", r"\\\1\2", part)
    return DOCUMENT.sub(r":doc:`\g<0> </\1>`", "".join(parts))


def convert_docstring(app, what, name, obj, options, lines):
    """Convert a docstring in place. Examples are left as they are, and so are their results."""
    example = False
    for i, line in enumerate(lines):
        example = bool(line.strip()) and (example or line.lstrip().startswith(">>>"))
        if not example:
            lines[i] = as_restructured_text(line)


def write_commands(app):
    """Write the reference of the command line, from the help texts of its commands."""
    text = commands.generate_docs(output_format="markdown", recursive=True)
    head, _, rest = text.partition("## Table of Contents")
    head = head.replace("# loiter", "# The command line", 1)
    path = Path(app.srcdir) / "reference" / "commands.md"
    path.write_text(head + rest[rest.index("**Plans**") :], encoding="utf-8")


def setup(app):
    app.connect("builder-inited", write_commands)
    app.connect("autodoc-process-docstring", convert_docstring)
