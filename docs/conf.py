"""Settings of the documentation site: `make docs` builds it with Sphinx."""

import ast
import re
import sys
from pathlib import Path
from xml.sax.saxutils import escape

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from matplotlib.figure import Figure
from sphinx.util import logging
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
# Except types of other packages: nothing is fetched, so their documentation is unknown; and type variables.
nitpick_ignore_regex = [("py:class", r"(?!loiter\.).*|.*\.(AnyTime|AnyFrame|OtherArrays?)")]
smartquotes = False
default_role = "code"

myst_heading_anchors = 4
# Formulas are $...$ in a line and ```math blocks, which GitHub renders too.
myst_enable_extensions = ["dollarmath"]
myst_fence_as_directive = ["math"]
html_math_renderer = "mathml"
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


thumbnails = {}


def save_thumbnail(figure, path):
    """Save the figure without words and numbers, which nobody could read at the size of a thumbnail."""
    figure.suptitle("")
    for legend in figure.legends:
        legend.remove()
    for axes in figure.axes:
        axes.set(title="", xlabel="", ylabel="")
        axes.tick_params(which="both", length=0, labelbottom=False, labelleft=False, labelright=False)
        for words in [*axes.texts, axes.get_legend()]:
            if words:
                words.set_visible(False)
    figure.set_size_inches(4.0, 3.0)
    thumbnail = path.parent / "thumb" / path.name.replace("_001.png", "_thumb.png")
    thumbnails[thumbnail] = thumbnail.with_name(f"plain_{path.name}")
    thumbnail.parent.mkdir(exist_ok=True)
    figure.savefig(thumbnails[thumbnail], dpi=160)


def replace_thumbnails(app):
    """Replace the gallery's thumbnails, which are reduced pictures, by the plain ones."""
    for thumbnail, plain in thumbnails.items():
        plain.replace(thumbnail)


def save_figures(block, block_vars, gallery_conf):
    """Save the figures that a block of a gallery script has made; the library draws them without pyplot."""
    known = block_vars.setdefault("figures", set())
    found = [value for value in block_vars["example_globals"].values() if isinstance(value, Figure)]
    paths = []
    for figure in (figure for figure in found if id(figure) not in known):
        known.add(id(figure))
        paths.append(next(block_vars["image_path_iterator"]))
        figure.savefig(paths[-1], dpi=110)
        if paths[-1].endswith("_001.png"):
            save_thumbnail(figure, Path(paths[-1]))
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
html_favicon = "../src/loiter/page/source/icon.svg"
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
DOCUMENT = re.compile(r"(?<!evidence/)\bdocs/(\w+)\.md\b")
EVIDENCE = re.compile(r"\]\((?:\.\./)+evidence/")
REPOSITORY = "https://github.com/loiter-uav/loiter/blob/main"


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


def link_evidence(app, docname, source):
    """Let links to the evidence, which is not part of the site, lead to the repository."""
    source[0] = EVIDENCE.sub(f"]({REPOSITORY}/evidence/", source[0])


def write_commands(app):
    """Write the reference of the command line, from the help texts of its commands."""
    text = commands.generate_docs(output_format="markdown", recursive=True)
    head, _, rest = text.partition("## Table of Contents")
    head = head.replace("# loiter", "# The command line", 1)
    path = Path(app.srcdir) / "reference" / "commands.md"
    path.write_text(head + rest[rest.index("**Plans**") :], encoding="utf-8")


TAG = re.compile(r"\\tag\{(\w+)\}")
# What the MathML of docutils lacks: bars that open and close, signs that are no operators, and the space of TeX around
# the names of functions.
SPACES = [
    (r'<mo class="mathopen">([|‖])</mo>', r'<mo form="prefix" stretchy="false">\1</mo>'),
    (r"<mo>([|‖])</mo>", r'<mo form="postfix" stretchy="false">\1</mo>'),
    (r"(<mo[^>]*>(?:[([,:=≤≥≠]|&[lg]t;)</mo>\s*)<mo>([−+±∓])</mo>", r'\1<mo form="prefix">\2</mo>'),
    (r'<mo stretchy="false">/</mo>', r'<mo lspace="0" rspace="0">/</mo>'),
    (r"(</m(?:i|n|sup|sub|row)>\s*)(<mi[^>]*>\w+</mi>\s*<mo>&Apply)", r'\1<mspace width="0.17em"></mspace>\2'),
    (r"<mo>&ApplyFunction;</mo>(?!\s*<mo[^>]*>[([])", r'<mspace width="0.17em"></mspace>'),
]


def as_mathml(node, text):
    """A formula as MathML, which browsers render without a script; an unknown command is a warning."""
    try:
        formula = tex2mathml(text, as_block=isinstance(node, nodes.math_block))
    except MathError as error:
        logging.getLogger(__name__).warning("formula %s: %s", text, error, location=node)
        return escape(text)
    for pattern, replacement in SPACES:
        formula = re.sub(pattern, replacement, formula)
    return formula


def write_inline_formula(writer, node):
    writer.body.append(as_mathml(node, node.astext()))
    raise nodes.SkipNode


def join_punctuation(app, doctree, name):
    """Join each formula in a line with the parentheses and commas next to it: browsers would break the line between."""
    for formula in list(doctree.findall(nodes.math)):
        parent, i = formula.parent, formula.parent.index(formula)
        joined = nodes.inline("", "", formula.deepcopy(), classes=["formula"])
        if i + 1 < len(parent) and isinstance(parent[i + 1], nodes.Text):
            closing, rest = re.fullmatch(r"([^\s\w]*)(.*)", parent[i + 1], re.DOTALL).groups()
            joined.append(nodes.Text(closing))
            parent[i + 1] = nodes.Text(rest)
        if i > 0 and isinstance(parent[i - 1], nodes.Text):
            text, opening = re.fullmatch(r"(.*?)([(\[]*)", parent[i - 1], re.DOTALL).groups()
            joined.insert(0, nodes.Text(opening))
            parent[i - 1] = nodes.Text(text)
        parent[i] = joined


def write_formula(writer, node):
    """Write a formula on lines of its own, with its number; the theme lets it scroll where it is too wide."""
    text = node.astext()
    number = "".join(f'<span class="eqno">({number})</span>' for number in TAG.findall(text))
    formula = f'<div class="pst-scrollable-table-container">{as_mathml(node, TAG.sub("", text))}</div>'
    writer.body.append(f'<div class="math">{number}{formula}</div>\n')
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (write_inline_formula, None), (write_formula, None))
    app.connect("doctree-resolved", join_punctuation)
    app.connect("source-read", link_evidence)
    app.connect("builder-inited", write_commands)
    app.connect("builder-inited", replace_thumbnails, priority=900)
    app.connect("autodoc-process-docstring", convert_docstring)
