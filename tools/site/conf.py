"""Sphinx's settings of the site that tools/site/build.py builds: Debian's packages alone, nothing from a network."""
import gc
import os
import sys

from docutils import nodes
from pygments.lexers.javascript import JavascriptLexer
from sphinx import addnodes
from sphinx.environment.adapters.toctree import TocTree
from sphinx.util.math import get_node_equation_number

gc.set_threshold(100_000, 20, 20)  # trees of nodes are many small objects, of which little is garbage
sys.path.insert(0, os.environ["POLYNYA_PYTHON"])

project = "Polynya"
version = release = os.environ["POLYNYA_VERSION"]
copyright = "the Polynya authors, GPL-3.0-or-later"  # noqa: A001 (Sphinx's name)
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx_copybutton"]
# In a block with prompts only the commands are copied, not their output.
copybutton_prompt_text = r"\$ "
copybutton_prompt_is_regexp = True
exclude_patterns = ["images/*", "static"]

myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
# Fragments of output and scenes with comments are not sound JSON.
suppress_warnings = ["misc.highlighting_failure"]

autodoc_member_order = "bysource"

html_theme = "furo"
html_title = f"Polynya {version}"
html_static_path = [os.environ["POLYNYA_STATIC"]]
html_css_files = ["site.css"]
html_js_files = ["equations.js", "search.js"]
html_search_scorer = os.path.join(os.path.dirname(__file__), "search_order.js")
html_math_renderer = "katex"
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"navigation_with_keys": True}


def visit_inline(self, node):
    self.body.append(f'<span class="math tex">{self.encode(node.astext())}</span>')
    raise nodes.SkipNode


def visit_block(self, node):
    self.body.append('<div class="math">')
    if node["number"]:
        self.body.append(f'<span class="eqno">({get_node_equation_number(self, node)})')
        self.add_permalink_ref(node, "Link to this equation")
        self.body.append("</span>")
    self.body.append(f'<div class="tex display">{self.encode(node.astext())}</div></div>\n')
    raise nodes.SkipNode


def titles_alone(tocs):
    """Tables of contents without the headings within pages, as the theme's tree in each page has them."""
    short = {}
    for page, toc in tocs.items():
        short[page] = toc.deepcopy()
        for top in short[page]:
            if len(top) > 1:
                trees = list(top.findall(addnodes.toctree))
                top[1:] = [type(top[1])("", *trees)] if trees else []
    return short


def tree_of_titles(resolve):
    """get_toctree_for, which copies for each page the headings of all and then drops them: a third of Sphinx's time."""
    def resolved(self, docname, builder, collapse, **options):
        if not options.get("titles_only"):
            return resolve(self, docname, builder, collapse, **options)
        whole = self.env.tocs
        if not hasattr(builder, "tocs_of_titles"):
            builder.tocs_of_titles = titles_alone(whole)
        self.env.tocs = builder.tocs_of_titles
        try:
            return resolve(self, docname, builder, collapse, **options)
        finally:
            self.env.tocs = whole
    return resolved


def setup(app):
    TocTree.get_toctree_for = tree_of_titles(TocTree.get_toctree_for)
    app.add_lexer("jsonc", JavascriptLexer)
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_block, None))
