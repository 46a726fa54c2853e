"""Sphinx's settings of the site, for the pages that docs/site/stage.py has laid out. scripts/site.sh runs both."""
project = "ovoid"
html_title = "ovoid"
extensions = ["myst_parser"]
myst_heading_anchors = 4
root_doc = "index"
language = "en"
highlight_language = "none"

html_theme = "furo"
html_static_path = ["site.css"]
html_css_files = ["site.css"]
html_favicon = "favicon.svg"
html_copy_source = False
html_show_copyright = False
html_show_sphinx = False
# furo's own defaults are fonts of the system and icons in the page: nothing is asked of the network.
html_theme_options = {"navigation_with_keys": True, "source_repository": ""}


def name_of(env, text, node):
    """A function in the reference is shown as declared, and found by its name: the first word before a parenthesis."""
    from docutils import nodes

    from sphinx import addnodes

    name, declared = text.split(" ", 1)
    before, at, after = declared.partition(name.rpartition("::")[2] + "(") if "(" in declared else (declared, "", "")
    node += addnodes.desc_annotation(before, before)
    node += addnodes.desc_name(at.rstrip("("), at.rstrip("("))
    node += nodes.Text(at[-1:] + after)
    return name


def setup(app):
    for kind, words in ("cname", "C"), ("cppname", "C++"), ("pyname", "Python"):
        app.add_object_type(kind, kind, objname=words, parse_node=name_of)
