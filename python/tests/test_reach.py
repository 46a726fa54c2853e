"""Every public function of C is called by the extension, or named in docs/python.md with the reason why not.

Truth: the declarations marked OVOID_API in include/ovoid/*.h, the names in python/src, the table of the page.
"""

import fnmatch
import glob
import os
import re
import unittest

import common

SOURCE = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))


def read(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return file.read()


def strip_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)


def find_declared():
    """The public functions and the header of each."""
    found = {}
    for path in sorted(glob.glob(os.path.join(SOURCE, "include", "ovoid", "*.h"))):
        for name in re.findall(r"OVOID_API\s[^;(]*?\b(ovoid_\w+)\s*\(", strip_comments(read(path))):
            found[name] = os.path.basename(path)
    return found


def find_called():
    text = "".join(strip_comments(read(path)) for path in glob.glob(os.path.join(SOURCE, "python", "src", "**", "*.c"), recursive=True))
    return set(re.findall(r"\bovoid_\w+", re.sub(r'"[^"\n]*"', "", text)))


def find_listed():
    """The names of the table, with their reasons."""
    section = read("docs/python.md").split("## What is not reached")[1].split("\n## ")[0]
    rows = re.findall(r"^\| (`.*?) \| (.*?) \|$", section, re.M)
    return {name: reason for names, reason in rows for name in re.findall(r"`([\w*]+)`", names)}


class Reach(unittest.TestCase):
    def setUp(self):
        self.declared, self.called, self.listed = find_declared(), find_called(), find_listed()

    def test_counts(self):
        """The patterns find something at all."""
        self.assertGreater(len(self.declared), 250)
        self.assertGreater(len(self.called & set(self.declared)), 150)
        self.assertGreater(len(self.listed), 20)

    def test_every_function(self):
        absent = [f"{name} ({header})" for name, header in self.declared.items()
                  if name not in self.called and not any(fnmatch.fnmatchcase(name, one) for one in self.listed)]
        self.assertEqual(absent, [], "call them in python/src, or name them in docs/python.md, What is not reached")

    def test_every_line(self):
        for one, reason in self.listed.items():
            names = fnmatch.filter(self.declared, one)
            self.assertTrue(names, f"docs/python.md lists {one}, which no header has")
            self.assertFalse(all(name in self.called for name in names), f"docs/python.md lists {one}, which is called")
            self.assertTrue(reason.strip(), one)


if __name__ == "__main__":
    common.main()
