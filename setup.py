"""Builds the extension of the Python package with CMake, and packs it with python/ovoid; pyproject.toml has the rest.

OVOID_CMAKE_ARGS: more arguments for CMake, for example -DOVOID_ASSIMP=ON, for COLLADA, glTF and others.
"""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
OFF = ("SHARED", "CLI", "JUDGE", "TESTS", "BENCH", "EXAMPLES", "INSTALL", "ASSIMP")


def read_version():
    """The version stands in include/ovoid/base.h, once."""
    text = (ROOT / "include/ovoid/base.h").read_text()
    return ".".join(re.findall(r"#define OVOID_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", text))


class CMakeBuild(build_ext):
    """The extension, built by CMake in a folder of its own."""

    def build_extension(self, extension):
        folder = Path(self.build_temp).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        configure = ["cmake", "-S", str(ROOT), "-B", str(folder), "-DCMAKE_BUILD_TYPE=Release", "-DOVOID_PYTHON=ON",
                     f"-DOVOID_PYTHON_INTERPRETER={sys.executable}", *(f"-DOVOID_{name}=OFF" for name in OFF)]
        more = shlex.split(os.environ.get("OVOID_CMAKE_ARGS", ""))
        # Files are read through libovoid_io, which wants jansson, and robots' too, which want expat and libyaml.
        tries = (("IO=ON", "ROBOT=ON"), ("IO=ON", "ROBOT=OFF"), ("IO=OFF", "ROBOT=ON"))
        for parts in tries:
            last = parts == tries[-1]
            if not subprocess.run([*configure, *(f"-DOVOID_{part}" for part in parts), *more], check=last).returncode:
                break
            print(f"ovoid: not with {' '.join(parts)}: jansson, or expat or libyaml, is missing", file=sys.stderr)
        subprocess.run(["cmake", "--build", str(folder), "--target", "ovoid_python", f"-j{os.cpu_count()}"], check=True)
        target = Path(self.get_ext_fullpath(extension.name))
        self.copy_file(folder / "python/ovoid/_ovoid.abi3.so", target)
        # The planners, where OMPL is; the template of ovoid.show(), where `make page` has built it.
        for more in (folder / "python/ovoid/_ompl.abi3.so", ROOT / "build/release/page.html"):
            if more.is_file():
                self.copy_file(more, target.parent / more.name)


setup(
    version=read_version(),
    packages=["ovoid"],
    package_dir={"": "python"},
    package_data={"ovoid": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("ovoid._ovoid", [], py_limited_api=True)],
    cmdclass={"build_ext": CMakeBuild},
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
)
