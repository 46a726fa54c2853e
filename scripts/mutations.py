#!/usr/bin/env python3
"""mutations.py [--write]: the tables of docs/mutation.md, from scripts/mutations.

*.txt has the faults, results.tsv the last result of each that was run: name, group, what noticed it or SURVIVED, day, remark;
mutate.sh adds them. Between `<!-- mutations GROUP... -->` and `<!-- end -->` stand the results of these groups and the
reasons of those that survived, each of which is the line `survives:` of the fault. Without --write the page is compared with
what it would be: exit 1 and a sentence for each fault.
"""

import os
import re
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(os.environ.get("OVOID_SOURCE_DIR") or Path(__file__).resolve().parents[1])
PAGE = ROOT / "docs" / "mutation.md"
FAULTS = ROOT / "scripts" / "mutations"
SECTION = re.compile(r"(<!-- mutations ([\w ]+) -->\n).*?(<!-- end -->\n)", re.S)


def read_faults():
    """Each fault by its name, in the order of the files."""
    faults = {}
    for path in sorted(FAULTS.glob("*.txt")):
        for block in re.split(r"\n\s*\n", path.read_text(encoding="utf-8")):
            lines = [line.partition(":") for line in block.splitlines() if not line.startswith("#")]
            fault = {"tests": "query"} | {key: value[1:] for key, _, value in lines}
            if "name" in fault:
                faults[fault["name"]] = fault
    return faults


def read_results():
    lines = (FAULTS / "results.tsv").read_text(encoding="utf-8").splitlines()
    rows = [(line.split("\t") + [""])[:5] for line in lines]
    return {row[0]: row[1:] for row in rows}


def find_wrong(faults, results, page):
    """Sentences about what does not agree."""
    for name, (group, word, day, _) in results.items():
        if name not in faults:
            yield f'results.tsv: there is no fault "{name}" any more: remove its line'
        elif faults[name]["tests"] != group:
            yield f'results.tsv: "{name}" is of the group {faults[name]["tests"]}, not {group}'
        elif word == "SURVIVED" and "survives" not in faults[name]:
            yield f'"{name}" survived: say why, or what is to be done, in a line "survives:" of the fault'
        if not re.fullmatch(r"test_\w+(\.sh)?|SURVIVED", word) or not re.fullmatch(r"\d{4}-\d\d-\d\d", day):
            yield f'results.tsv: "{name}" needs a test or SURVIVED, and a day'
    for name, fault in faults.items():
        if "survives" in fault and results.get(name, ["", ""])[1] != "SURVIVED":
            yield f'"{name}" has a line "survives:" and did not survive'
    shown = Counter(group for _, groups, _ in SECTION.findall(page) for group in groups.split())
    for group in sorted({fault["tests"] for fault in faults.values()} | set(shown)):
        if shown[group] != 1:
            yield f"docs/mutation.md has the group {group} {shown[group]} times, not once"


def write_section(groups, faults, results):
    """What stands between the marks."""
    of_groups = [fault for fault in faults.values() if fault["tests"] in groups]
    run = [fault for fault in of_groups if fault["name"] in results]
    survivors = [fault for fault in run if results[fault["name"]][1] == "SURVIVED"]
    counts = [f"{len(of_groups)} faults", f"{len(run) - len(survivors)} noticed", f"{len(survivors)} survived"]
    text = f"\n{', '.join(counts)}, {len(of_groups) - len(run)} without a result.\n"
    if run:
        text += "\n| mutation | file | what it breaks | noticed by | day |\n|---|---|---|---|---|\n"
    for fault in run:
        _, word, day, remark = results[fault["name"]]
        word = ("**survived**" if word == "SURVIVED" else word) + (f" ({remark})" if remark else "")
        text += f"| {fault['name']} | `{fault['file'].removeprefix('src/')}` | {fault['breaks']} | {word} | {day} |\n"
    if survivors:
        text += "\nThe survivors:\n\n" + "".join(f"- *{fault['name']}*: {fault['survives']}\n" for fault in survivors)
    return text + "\n"


def main(arguments):
    if arguments not in ([], ["--write"]):
        sys.exit(__doc__)
    faults, results, page = read_faults(), read_results(), PAGE.read_text(encoding="utf-8")
    wrong = list(find_wrong(faults, results, page))
    new = SECTION.sub(lambda m: m[1] + write_section(m[2].split(), faults, results) + m[3], page) if not wrong else page
    if arguments:
        PAGE.write_text(new, encoding="utf-8")
    elif new != page:
        wrong.append("docs/mutation.md is not what the results say: scripts/mutations.py --write")
    for sentence in wrong:
        print(sentence)
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main(sys.argv[1:])
