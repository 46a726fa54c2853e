"""What the tests share: the last line that the house's tests end with, and numbers without NumPy."""

import os
import subprocess
import sys
import unittest

# As on a machine that has none.
if os.environ.get("OVOID_TEST_WITHOUT_NUMPY"):
    sys.modules["numpy"] = None

try:
    import numpy
except ImportError:
    numpy = None

try:
    import hypothesis
except ImportError:
    hypothesis = None

needs_numpy = unittest.skipUnless(numpy, "needs python3-numpy")
needs_hypothesis = unittest.skipUnless(hypothesis, "needs python3-hypothesis")


def make_corner():
    """Points and triangles of an L."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    cap = [(3, 4, 5), (3, 5, 0), (3, 0, 1), (3, 1, 2)]
    faces = [(a, c, b) for a, b, c in cap] + [(a + 6, b + 6, c + 6) for a, b, c in cap]
    for i in range(6):
        k = (i + 1) % 6
        faces += [(i, k, k + 6), (i, k + 6, i + 6)]
    return [(x, y, z) for z in (0, 1) for x, y in outline], faces


def run_tool(words, **how):
    """subprocess.run without the runtime of the sanitizers that Python is started with: the tool brings its own."""
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run(words, env=environment, **how)


class Result(unittest.TextTestResult):
    """Counts what passed: testsRun has skipped tests in some versions of Python and not in others."""

    passed = 0

    def addSuccess(self, test):
        super().addSuccess(test)
        self.passed += 1


def main():
    """Runs the tests of the calling file and ends with "N passed, N failed, N skipped"."""
    runner = unittest.TextTestRunner(resultclass=Result)
    result = unittest.main(module="__main__", exit=False, testRunner=runner).result
    failed = len(result.failures) + len(result.errors) + len(result.unexpectedSuccesses)
    for test, reason in result.skipped:
        print(f"skipped: {test}: {reason}")
    print(f"{result.passed} passed, {failed} failed, {len(result.skipped)} skipped", flush=True)
    sys.exit(1 if failed else 0)
