"""The documentation as a site: `make docs`."""

import ast
import pathlib
import re
import sys

from sphinx.util import logging

ROOT = pathlib.Path(__file__).resolve().parent.parent

project = "footfall"
author = "the footfall authors"
copyright = "2026, the footfall authors"
release = version = re.search(r"project\(footfall\s+VERSION\s+([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx.ext.napoleon", "sphinx_copybutton"]
source_suffix = {".md": "myst-nb"}
exclude_patterns = ["figures", "friction", "validation", "**/requirements.txt"]
nitpicky = True

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4  # headings have the anchors that code hosts give them
myst_dmath_allow_labels = False  # (33) after a formula is the paper's number, not a label of ours

# The notebooks of docs/notebooks run each time, with the package that is installed beside Sphinx; a cell that fails fails
# the build.
nb_execution_mode = "force"
nb_execution_timeout = 300
nb_execution_show_tb = True
nb_merge_streams = True

# The reference of the Python package comes from its docstrings. Nothing is built for it: what is compiled, and what is
# imported from elsewhere, is stood in for.
sys.path.insert(0, str(ROOT / "python"))
sys.dont_write_bytecode = True
autodoc_mock_imports = ["footfall._core", "matplotlib", "numpy", "pandas", "tomli", "tomli_w", "xarray"]
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_class_signature = "separated"
autodoc_default_options = {"exclude-members": "__init__, __new__"}
napoleon_use_rtype = False
python_use_unqualified_type_names = True
nitpick_ignore_regex = [("py:.*", r"(?!footfall).*"), ("py:.*", r"footfall\._core.*")]

html_theme = "furo"
html_title = f"footfall {release}"
html_copy_source = False
html_show_sphinx = False

# Pages link to these as files of the repository; on the site they are pages.
PAGES_OF_FILES = {
    "](../data/published/README.md": "](published-data.md",
}


def link_to_pages(app, name, source):
    for file, page in PAGES_OF_FILES.items():
        source[0] = source[0].replace(file, page)


def check_references(app):
    """Warns of what is public and not in the reference. Sphinx itself warns of what is there and does not exist."""
    warn = logging.getLogger(__name__).warning
    pages = {name: (ROOT / "docs/reference" / name).read_text() for name in ("cpp.md", "python.md")}

    include = ROOT / "include"
    headers = [str(file.relative_to(include)) for file in sorted(include.rglob("*.hpp"))]
    for header in headers:
        if f"`{header.removeprefix('footfall/')}`" not in pages["cpp.md"]:
            warn("docs/reference/cpp.md: the header %s is missing", header)

    for name in public_names(ROOT / "python/footfall/__init__.py"):
        if not re.search(rf"(?<![\w.])footfall\.{re.escape(name)}\b", pages["python.md"]):
            warn("docs/reference/python.md: footfall.%s is missing", name)
    for kind in ("normal", "friction"):
        for file in (include / "footfall/law" / kind).glob("*.hpp"):
            if name := re.search(r'\.name = "([\w-]+)"', file.read_text()):
                law = "".join(part.capitalize() for part in name[1].split("-")) + kind.capitalize()
                if not re.search(rf"`{law}`", pages["python.md"], re.IGNORECASE):
                    warn("docs/reference/python.md: the law %s is missing", law)


def public_names(file):
    """What __all__ lists, read without importing anything."""
    for statement in ast.parse(file.read_text()).body:
        if isinstance(statement, ast.Assign) and getattr(statement.targets[0], "id", None) == "__all__":
            return ast.literal_eval(statement.value)
    raise ValueError(f"{file}: there is no __all__")


def escape_bars(app, what, name, obj, options, lines):
    """|u| in a docstring is a length, not a substitution."""
    lines[:] = [line if "``" in line or line.lstrip().startswith(">>>") else line.replace("|", r"\|") for line in lines]


def setup(app):
    app.connect("autodoc-process-docstring", escape_bars)
    app.connect("source-read", link_to_pages)
    app.connect("builder-inited", check_references)
