"""coverage.py SUMMARY [--write]: gcovr's summary by folder, as a table; --write puts it into docs/coverage.md between its marks."""
import collections
import json
import re
import sys


def folder_of(name):
    """src/robot/path/search.c belongs to src/robot/path, cli/pairs/view.c to cli/pairs, src/simd/kernels/... too."""
    return name.rsplit("/", 1)[0]


def make_table(files):
    sums = collections.defaultdict(lambda: [0, 0, 0, 0])
    for file in files:
        counts = [file[key] for key in ("line_covered", "line_total", "branch_covered", "branch_total")]
        for name in (folder_of(file["filename"]), "all"):
            sums[name] = [a + b for a, b in zip(sums[name], counts)]
    rows = ["| folder | lines | of them run, % | branches | of them taken, % |", "|---|---:|---:|---:|---:|"]
    for name in sorted(sums, key=lambda name: (name == "all", name)):
        lines, line_total, branches, branch_total = sums[name]
        rows.append("| %s | %d | %.1f | %d | %.1f |" % (name, line_total, 100 * lines / max(line_total, 1), branch_total,
                                                       100 * branches / max(branch_total, 1)))
    return "\n".join(rows) + "\n"


def main():
    table = make_table(json.load(open(sys.argv[1]))["files"])
    print(table, end="")
    if "--write" in sys.argv:
        page = open("docs/coverage.md").read()
        page, found = re.subn(r"(<!-- figures.*?-->\n).*?(?=<!-- end of the figures)", lambda mark: mark.group(1) + table, page, flags=re.S)
        if not found:
            sys.exit("coverage: docs/coverage.md has no marks around its figures")
        open("docs/coverage.md", "w").write(page)


main()
