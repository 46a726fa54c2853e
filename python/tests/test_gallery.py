"""The notebooks of python/gallery run, each in a kernel of its own. Truth: their own assertions; they are stored without outputs.

Needs nbconvert, ipykernel and matplotlib. Not with a sanitizer: kernels are programs of their own.
"""

import glob
import json
import os
import tempfile
import unittest

import common
import ovoid

try:
    import ipykernel  # noqa: F401
    import matplotlib  # noqa: F401
    import nbformat
    import numpy  # noqa: F401
    from nbconvert.preprocessors import ExecutePreprocessor
except ImportError:
    ExecutePreprocessor = None

SOURCE = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))
GALLERY = sorted(glob.glob(os.path.join(SOURCE, "python", "gallery", "*.ipynb")))


class Gallery(unittest.TestCase):
    def test_stored(self):
        """As one file of text each, without outputs, and named on the page."""
        self.assertGreaterEqual(len(GALLERY), 5)
        with open(os.path.join(SOURCE, "docs", "python.md"), encoding="utf-8") as file:
            page = file.read()
        for path in GALLERY:
            with open(path, encoding="utf-8") as file:
                notebook = json.load(file)
            self.assertIn(os.path.basename(path), page)
            for cell in notebook["cells"]:
                self.assertEqual((cell.get("outputs", []), cell.get("execution_count")), ([], None), path)

    @unittest.skipUnless(ExecutePreprocessor, "needs python3-nbconvert, python3-ipykernel, python3-matplotlib")
    @unittest.skipIf("asan" in os.environ.get("LD_PRELOAD", ""), "kernels are not run with a sanitizer")
    def test_run(self):
        with tempfile.TemporaryDirectory() as home:
            for name in ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "MPLCONFIGDIR"):
                os.environ[name] = home
            os.environ["OVOID_SOURCE_DIR"] = os.path.abspath(SOURCE)
            for path in GALLERY:
                if "robot" in path and not (ovoid.has_robot and ovoid.has_io):
                    continue
                with self.subTest(path):
                    notebook = nbformat.read(path, as_version=4)
                    ExecutePreprocessor(timeout=300, kernel_name="python3").preprocess(notebook, {"metadata": {"path": home}})
                    pictures = [1 for cell in notebook.cells for output in cell.get("outputs", [])
                                if "image/png" in output.get("data", {})]
                    self.assertTrue(pictures, "no picture was drawn")


if __name__ == "__main__":
    common.main()
