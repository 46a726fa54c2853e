#!/usr/bin/env python3
"""names.py [--write]: docs/names.md, each public function of C with its counterpart in C++, Python and JavaScript.

The column of C++ is found: the function or the class of include/ovoid/**/*.hpp that calls it. Python's and JavaScript's are
written by hand, and kept by --write, which adds what is new and drops what is gone. Without --write the table is compared
with the headers, the stub and ovoid.d.ts: exit 1 and a sentence for each fault. A cell holds names in backquotes, or else
the reason why there is none, which does not begin with one; `Not in LANGUAGE:` above a table is the reason of its empty cells.
"""

import ast
import os
import re
import sys
from pathlib import Path

ROOT = Path(os.environ.get("OVOID_SOURCE_DIR") or Path(__file__).resolve().parents[1])
PAGE = ROOT / "docs" / "names.md"
LANGUAGES = ("C++", "Python", "JavaScript")
HEAD = "| C | C++ | Python | JavaScript |\n|---|---|---|---|\n"


def read(paths):
    return "\n".join(re.sub(r"/\*.*?\*/|//[^\n]*", "", path.read_text(encoding="utf-8"), flags=re.S) for path in sorted(paths))


def find_declared():
    """The public functions by header, in their order."""
    found = {}
    for path in sorted((ROOT / "include" / "ovoid").glob("*.h")):
        names = re.findall(r"OVOID_API\s[^;(]*?\b(ovoid_\w+)\s*\(", read([path]))
        if names:
            found[path.name] = names
    return found


def name_scope(text):
    """What a brace opens: the kind, and the name. text: since the brace or semicolon before."""
    text = re.sub(r"\btemplate\s*<.*?>(?=\s*(class|struct|inline|static|void|std|[a-z_]+ ))", "", text, count=1, flags=re.S)
    kind = re.search(r"\b(?:class|struct)\s+(\w+)", text)
    if kind and "(" not in text.split(kind[1])[0]:
        return "class", kind[1]
    function = re.search(r"(operator\s*[^\s(]+|~?\w+)\s*\(", text)
    return ("function", function[1]) if function else ("other", "")


def find_cpp():
    """Of each C function the C++ names that call it."""
    # The headers that answer FCL's calls have FCL's names.
    headers = (ROOT / "include" / "ovoid").rglob("*.hpp")
    text = read(path for path in headers if "fcl" not in (path.stem, path.parent.name))
    text = re.sub(r'"(\\.|[^"\n])*"|^\s*#.*$|=\s*\{\}', "", text, flags=re.M)
    scopes, begin, found = [], 0, {}
    for token in re.finditer(r"[{};]|\bpublic:|\bprivate:|\bovoid_\w+", text):
        if token[0].startswith("ovoid_"):
            owner = next((name for kind, name in reversed(scopes) if kind == "class"), "")
            function = next((name for kind, name in scopes if kind == "function"), "")
            if not function:
                kind, name = name_scope(text[begin:token.start()])
                owner = name if kind == "class" else owner
                function = "" if kind == "class" else name
            called = "::".join(part for part in (owner, "" if function == owner else function) if part)
            if called:
                found.setdefault(token[0], {})[called.replace("detail::", "")] = 1
            continue
        if token[0] == "{":
            scopes.append(name_scope(text[begin:token.start()]))
        elif token[0] == "}" and scopes:
            scopes.pop()
        begin = token.end()
    return {name: list(names)[:2] for name, names in found.items()}


def find_python():
    """The public names of the stub, and those called in the binding."""
    package = ROOT / "python" / "ovoid"
    nodes = ast.parse((package / "__init__.pyi").read_text(encoding="utf-8")).body
    modules = {node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.level and (package / f"{node.module}.py").exists()}
    for module in modules:
        nodes += ast.parse((package / f"{module}.py").read_text(encoding="utf-8")).body
    public = {"__version__"}
    for node in nodes:
        if isinstance(node, ast.ImportFrom):
            public |= {one.asname or one.name for one in node.names}
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            public.add(node.name)
        for one in getattr(node, "body", []) if isinstance(node, ast.ClassDef) else []:
            name = one.target.id if isinstance(one, ast.AnnAssign) else getattr(one, "name", "")
            public.add(f"{node.name}.{name}")
    return public, set(re.findall(r"\bovoid_\w+", read((ROOT / "python" / "src").rglob("*.c"))))


def find_javascript():
    """The classes of ovoid.d.ts and their members, those of what load returns bare; the C functions called in the module."""
    text = read([ROOT / "web" / "package" / "ovoid.d.ts"])
    public = set()
    for owner, body in re.findall(r"^export (?:declare class|interface) (\w+)[^{\n]*\{\n(.*?)^\}", text, flags=re.S | re.M):
        members = re.findall(r"(?:^|[;{])\s*(?:static |readonly )*(\w+)\??\s*[:(]", body, flags=re.M)
        public |= {owner} | {member if owner == "Ovoid" else f"{owner}.{member}" for member in members}
    return public, set(re.findall(r"\bovoid_\w+", read((ROOT / "web" / "src").glob("*.c"))))


def read_page():
    """The cells of each function, the reasons of each header, and what stands before the first header."""
    text = PAGE.read_text(encoding="utf-8") if PAGE.exists() else "# Names\n\n"
    rows, reasons, header = {}, {}, ""
    for line in text.splitlines():
        if line.startswith("## "):
            header = line[3:].strip("` ")
        reason = re.match(r"Not in (\S+): (.*)", line)
        if reason:
            reasons.setdefault(header, {})[reason[1]] = reason[2]
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if header and len(cells) == 4 and cells[0].startswith("`ovoid_"):
            rows.setdefault(header, []).append((cells[0].strip("`"), cells[1:]))
    return text.split("\n## ")[0], reasons, rows


def make_cpp_cell(names):
    return ", ".join(f"`{name}`" for name in names)


def write_page(declared, cpp):
    opening, reasons, rows = read_page()
    known = {name: cells for of_header in rows.values() for name, cells in of_header}
    out = [opening.rstrip()]
    for header, names in declared.items():
        out.append(f"\n## `{header}`\n")
        out += [f"Not in {language}: {reason}\n" for language, reason in reasons.get(header, {}).items()]
        lines = []
        for name in names:
            cells = known.get(name, ["", "", ""])
            cell = make_cpp_cell(cpp[name]) if name in cpp else ("" if find_names(cells[0]) else cells[0])
            lines.append(f"| `{name}` | {cell} | {cells[1]} | {cells[2]} |")
        out.append(HEAD + "\n".join(lines))
    PAGE.write_text("\n".join(out) + "\n", encoding="utf-8")


def find_names(cell):
    """The names of a cell, none where it is a reason."""
    if not re.fullmatch(r"`[^`]+`(, `[^`]+`)*", cell):
        return []
    return [re.sub(r"\(.*", "", name).lstrip(".") for name in re.findall(r"`([^`]+)`", cell)]


def find_faults_of(name, cells, reasons, faces):
    """What is wrong with a row. faces: of each language the public names, and the C functions that it calls."""
    for language, cell in zip(LANGUAGES, cells):
        public, called = faces[language]
        names = find_names(cell)
        if not cell and language not in reasons:
            yield f"{name}: no name in {language}, and no reason"
        if language == "C++" and name in called and cell != make_cpp_cell(public[name]):
            yield f"{name}: C++ has {make_cpp_cell(public[name])}: run scripts/names.py --write"
        if language != "C++":
            yield from (f"{name}: {language} has no {one}" for one in names if one not in public)
            if name in called and not cell:
                yield f"{name}: called in {language}, under no name here"
        if names and name not in called and language == "C++":
            yield f"{name}: no C++ header calls it"


def find_faults(declared, cpp):
    _, reasons, rows = read_page()
    faces = {"C++": (cpp, set(cpp)), "Python": find_python(), "JavaScript": find_javascript()}
    for header in declared.keys() | rows.keys():
        wanted, there = declared.get(header, []), [name for name, _ in rows.get(header, [])]
        if wanted != there:
            differing = sorted(set(wanted) ^ set(there)) or ["the order"]
            yield f"{header}: {', '.join(differing)}: run scripts/names.py --write"
        for name, cells in rows.get(header, []):
            yield from find_faults_of(name, cells, reasons.get(header, {}), faces)


def main():
    declared, cpp = find_declared(), find_cpp()
    if "--write" in sys.argv[1:]:
        write_page(declared, cpp)
    faults = list(find_faults(declared, cpp))
    for fault in faults:
        print(f"FAILED docs/names.md: {fault}")
    count = sum(map(len, declared.values()))
    print(f"{count - min(len(faults), count)} passed, {len(faults)} failed, 0 skipped")
    return bool(faults) or count < 250


if __name__ == "__main__":
    sys.exit(main())
