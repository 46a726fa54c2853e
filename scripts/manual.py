#!/usr/bin/env python3
"""manual.py [--write] TOOL PAGE: the options in the manual page, which are those of the tool's own help.

The help of each command is printed from its table of options. The page has a list of them behind each line
`.\\" options of COMMAND`. An item of the list is what the table says; what the page has to add stands in it behind a line
`.\\" more` and stays. Without --write the page is compared with the help, and the exit code is 1 where they differ.
"""

import re
import subprocess
import sys
import textwrap

MARK = re.compile(r'\.\\" options of (.+)')
MORE = '.\\" more'
OPTION = re.compile(r"^  (?:-(\w), |    )--([a-z-]+)(?: (\S.*?))?(?:  +(.*))?$")


def read_options(tool, command):
    """(letter, name, value, help) of each option, in the order of the table, without --help."""
    text = subprocess.run([tool, *command.split(), "--help"], capture_output=True, text=True, check=True).stdout
    options = []
    for line in text.split("\nOptions:\n")[1].split("\n\n")[0].split("\n"):
        found = OPTION.match(line)
        if found:
            options.append([*found.groups()[:3], [found[4] or ""]])
        else:
            options[-1][3].append(line.strip())
    return [(*option, " ".join(words).strip()) for *option, words in options if option[1] != "help"]


def write_words(text):
    """Lines of the page: each sentence begins a line, which is no request and at most 79 characters long."""
    first = text[0] if re.match(r"\S+:", text) else text[0].upper()
    text = (first + text[1:] + ("" if text.endswith(".") else ".")).replace("\\", "\\e")
    lines = []
    for sentence in re.split(r"(?<=[a-z)]\.) +(?=[A-Z\"-])", text):
        lines += textwrap.wrap(sentence, 79, break_long_words=False, break_on_hyphens=False)
    return ["\\&" + line if line[0] in ".'" else line for line in lines]


def write_item(option, more):
    letter, name, value, words = option
    head = ".It " + (f"Fl {letter} , " if letter else "") + f"Fl -{name}"
    if value:
        head += ' Ar "' + value.replace('"', '\\(dq') + '"' if " " in value or '"' in value else f" Ar {value}"
    return [head, *write_words(words), *([MORE, *more] if more else [])]


def read_more(lines):
    """What was written by hand, by the option's name; `lines` are those of a list."""
    more, name, is_more = {}, None, False
    for line in lines:
        if line.startswith(".It "):
            name, is_more = re.findall(r"Fl -([a-z-]+)", line)[0], False
        elif line == MORE:
            is_more = True
        elif is_more:
            more.setdefault(name, []).append(line)
    return more


def write_list(tool, command, old):
    options, more = read_options(tool, command), read_more(old)
    for name in sorted(set(more) - {option[1] for option in options}):
        sys.exit(f"manual.py: {command} has no option --{name}, of which the page says more")
    return [".Bl -tag -width Ds", *(line for o in options for line in write_item(o, more.get(o[1]))), ".El"]


def write_page(tool, lines):
    page, at = [], 0
    while at < len(lines):
        page.append(lines[at])
        found, at = MARK.fullmatch(lines[at]), at + 1
        if not found:
            continue
        end = lines.index(".El", at) + 1
        page += write_list(tool, found[1], lines[at : end - 1])
        at = end
    return page


def main(arguments):
    is_write = arguments[:1] == ["--write"]
    tool, path = arguments[is_write:]
    with open(path, encoding="utf-8") as file:
        old = file.read()
    new = "\n".join(write_page(tool, old.split("\n")))
    if new != old and is_write:
        with open(path, "w", encoding="utf-8") as file:
            file.write(new)
    elif new != old:
        print(f"{path}: its options are not those of the tool: scripts/manual.py --write {tool} {path}")
    return int(new != old and not is_write)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
