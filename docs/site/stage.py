"""stage.py FOLDER XML [DEMO]: lays out the pages of the site in FOLDER, for Sphinx.

The pages of docs/ and the three of the root come together in one folder, so links between them lose their folder; each
example is a page of its own; the reference is made of Doxygen's XML and of the Python package's types. The navigation is that of
docs/index.md: each of its headings is a group, the links of its list are the group's pages. DEMO: there is
a live page, demo.html, which the front page's picture leads to."""
import ast
import pathlib
import re
import sys
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOT_PAGES = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")
FENCE = "````"
# The front page's picture where the live page is there.
LIVE = r"""<a href="demo.html">\1</a>

<a href="demo.html">Open it</a>: turn it, drag a body and see the brackets follow, choose a pair and have its proof checked, in the browser."""
LANGUAGES = {".c": "c", ".cpp": "cpp", ".json": "json", ".urdf": "xml", ".srdf": "xml"}


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def move_links(text):
    """Links as they are where all pages lie in one folder, and examples are pages."""
    text = re.sub(r"\]\((?:\.\./|docs/)", "](", text)
    return re.sub(r"\]\((examples/[a-z_/]+\.[a-z]+)\)", r"](\1.md)", text)


def toctree(caption, pages):
    lines = "\n".join(pages)
    return f"\n{FENCE}{{toctree}}\n:hidden:\n:caption: {caption}\n\n{lines}\n{FENCE}\n"


def add_navigation(text, reference, examples):
    """A hidden tree of contents for each group of the front page, with the pages that are made here."""
    trees = ""
    for group in re.split(r"^## ", text, flags=re.M)[1:]:
        title, _, body = group.partition("\n")
        pages = re.findall(r"^- .*?\]\(([A-Za-z-]+)\.md\)", body, re.M)
        trees += toctree(title, pages + {"Reference": reference, "Tutorials": examples}.get(title, []))
    return text + trees


def stage_pages(out, reference, examples, demo):
    for page in [*(ROOT / name for name in ROOT_PAGES), *sorted((ROOT / "docs").glob("*.md"))]:
        text = move_links(page.read_text(encoding="utf-8"))
        if page.name == "index.md":
            if demo:
                text, count = re.subn(r"\[(!\[[^]]*\]\(page\.png\))\]\(page\.md\)", LIVE, text)
                if not count:
                    sys.exit("stage: docs/index.md has no picture page.png that leads to page.md; the live page has no link")
            text = add_navigation(text, reference, examples)
        write(out / page.name, text)
    for figure in [*(ROOT / "docs").glob("*.svg"), *(ROOT / "docs").glob("*.png"), *(ROOT / "docs" / "paper").glob("*.svg")]:
        path = out / figure.relative_to(ROOT / "docs")
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(figure.read_bytes())


def stage_examples(out):
    """Each file of the examples as a page, but scripts for clusters; their list as another."""
    rows = []
    for source in sorted(path for path in (ROOT / "examples").rglob("*.*") if path.suffix not in (".txt", ".sh", ".py")):
        name = source.relative_to(ROOT / "examples").as_posix()
        text = source.read_text(encoding="utf-8")
        words = " ".join(line[2:].strip() for line in re.match(r"(//.*\n)*", text)[0].splitlines())
        language = LANGUAGES.get(source.suffix, "none")
        write(out / "examples" / f"{name}.md", f"# examples/{name}\n\n{FENCE}{language}\n{text}{FENCE}\n")
        rows.append((name, f"- [{name}]({name}.md)" + (f": {words}" if words else "")))
    rows.sort(key=lambda row: ("/" in row[0], row))
    text = "# Examples\n\nPrograms, which the tests run, and the files that the pages read.\n\n" + "\n".join(row for _, row in rows) + "\n"
    write(out / "examples" / "index.md", text + toctree("Examples", [name for name, _ in rows]))
    return ["examples/index"]


# ---- the reference


def words_of(node):
    """The brief description, or the first sentence of the rest."""
    brief = " ".join("".join(node.find("briefdescription").itertext()).split())
    rest = " ".join("".join(node.find("detaileddescription").itertext()).split())
    return brief or re.split(r"(?<=[.:;]) ", rest, 1)[0]


def plain(text):
    """Text without what Markdown would read as markup."""
    return re.sub(r"([\\`*_\[\]<>])", r"\\\1", text)


def entry(kind, name, declared, words, link):
    """One name of the reference: what is declared, one line, where the rest stands."""
    return f'{FENCE}{{{kind}}} {name} {declared}\n{plain(words)} <a href="../api/{link}">In full</a>\n{FENCE}\n\n'


def declaration(member):
    declared = f"{''.join(member.find('type').itertext())} {member.findtext('name')}{member.findtext('argsstring')}"
    return " ".join(declared.split())


def link_of(member):
    file, _, anchor = member.get("id").rpartition("_1")
    return f"{file}.html#{anchor}"


def entries_of(path, kind):
    """The public functions of a file of Doxygen's XML, each name once; and what it is."""
    compound = xml.etree.ElementTree.parse(path).find("compounddef")
    found = {}
    for member in compound.iter("memberdef"):
        if member.get("kind") != "function" or member.get("prot") != "public":
            continue
        name = member.findtext("qualifiedname") or member.findtext("name")
        if "operator" in name or "~" in name:
            continue
        if name not in found or (not found[name][1] and words_of(member)):
            found[name] = declaration(member), words_of(member), link_of(member)
    return compound, {name: entry(kind, name, *rest) for name, rest in found.items()}


def stage_c(out, xml_folder):
    pages = []
    for path in sorted(xml_folder.glob("*_8h.xml")):
        compound, entries = entries_of(path, "cname")
        if not entries:
            continue
        header = compound.findtext("compoundname")
        page = header.removesuffix(".h")
        pages.append((page, header, len(entries)))
        head = f"# ovoid/{header}\n\n{plain(words_of(compound))} <a href=\"../api/{compound.get('id')}.html\">The header in full</a>, with its types\n\n"
        write(out / "reference" / f"{page}.md", head + "".join(entries.values()))
    return pages


def stage_cpp(out, xml_folder):
    text, total = "# C++\n\nClasses and functions of [the C++ headers](../cpp.md); overloads stand once.\n\n", 0
    for path in sorted([*xml_folder.glob("class*.xml"), *xml_folder.glob("namespaceovoid.xml")]):
        compound, entries = entries_of(path, "cppname")
        if "detail" in compound.findtext("compoundname"):
            continue
        title = compound.findtext("compoundname")
        text += f"## {plain(title)}\n\n" + (entry("cppname", title, f"class {title}", words_of(compound), f"{compound.get('id')}.html")
                                          if path.name.startswith("class") else "") + "".join(entries.values())
        total += len(entries)
    write(out / "reference" / "cpp.md", text)
    return total


def python_functions(tree):
    """(name, declaration) of each public function and method of the package's types."""
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):
            for one in node.names:
                if one.asname:
                    yield one.name, f"class {one.name}" if one.name[0].isupper() else one.name
        inner = node.body if isinstance(node, ast.ClassDef) else [node]
        before = f"{node.name}." if isinstance(node, ast.ClassDef) else ""
        if before and not before.startswith("_"):
            yield node.name, f"class {node.name}"
        for one in inner:
            if isinstance(one, ast.FunctionDef) and not f"{before}{one.name}".startswith("_") and not one.name.startswith("_"):
                back = f" -> {ast.unparse(one.returns)}" if one.returns else ""
                yield before + one.name, f"{before}{one.name}({ast.unparse(one.args)}){back}"


def stage_python(out):
    tree = ast.parse((ROOT / "python" / "ovoid" / "__init__.pyi").read_text(encoding="utf-8"))
    seen, text = set(), "# Python\n\nNames and types; [from Python](../python.md) explains them, and `help(ovoid.distance)` has the words of each.\n\n"
    for name, declared in python_functions(tree):
        if name not in seen:
            seen.add(name)
            text += f"{FENCE}{{pyname}} ovoid.{name} {declared}\n{FENCE}\n\n"
    write(out / "reference" / "python.md", text)
    return len(seen)


def stage_reference(out, xml_folder):
    headers = stage_c(out, xml_folder)
    cpp, python = stage_cpp(out, xml_folder), stage_python(out)
    rows = "".join(f"| [{header}]({page}.md) | {count} |\n" for page, header, count in headers)
    text = ("# All functions\n\nThe search finds each by its name; each leads to its full text in <a href=\"../api/index.html\">Doxygen's pages</a>.\n\n"
            f"| header | functions |\n|---|---:|\n{rows}| [C++](cpp.md) | {cpp} |\n| [Python](python.md) | {python} |\n")
    write(out / "reference" / "index.md", text + toctree("Headers", [page for page, _, _ in headers] + ["cpp", "python"]))
    return ["reference/index"]


def main(out, xml_folder, demo=""):
    out, xml_folder = pathlib.Path(out), pathlib.Path(xml_folder)
    stage_pages(out, stage_reference(out, xml_folder), stage_examples(out), demo)


if __name__ == "__main__":
    main(*sys.argv[1:])
