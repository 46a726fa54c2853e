"""ovoid for Conan 2, from the sources that this recipe lies in (packaging/README.md)."""

import os
import re

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

required_conan_version = ">=2.0"


class OvoidConan(ConanFile):
    name = "ovoid"
    description = "Proximity queries between convex bodies: collision, distance, depth and time of impact, with proofs."
    license = "MIT"
    topics = ("collision-detection", "geometry", "gjk", "epa", "continuous-collision-detection")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "io": [True, False], "tool": [True, False]}
    default_options = {"shared": False, "io": False, "tool": False}

    @property
    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        """The version stands in the header, once."""
        header = load(self, os.path.join(self._root, "include", "ovoid", "base.h"))
        self.version = ".".join(re.findall(r"#define OVOID_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "adapters/*", "include/*", "src/*", "judge/*", "cli/*"):
            copy(self, pattern, src=self._root, dst=self.export_sources_folder)

    def configure(self):
        # It is C.
        self.settings.rm_safe("compiler.libcxx")
        self.settings.rm_safe("compiler.cppstd")

    def validate(self):
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration("ovoid was tested on Linux only")
        if self.options.tool and not self.options.io:
            raise ConanInvalidConfiguration("the tool needs io=True")

    def requirements(self):
        if self.options.io:
            self.requires("jansson/2.14")
        if self.options.tool:
            self.requires("gmp/6.3.0")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update({
            "OVOID_SHARED": bool(self.options.shared),
            "OVOID_IO": bool(self.options.io),
            "OVOID_CLI": bool(self.options.tool),
            "OVOID_JUDGE": bool(self.options.tool),
            "OVOID_ROBOT": False,
            "OVOID_ASSIMP": False,
            "OVOID_TESTS": False,
            "OVOID_BENCH": False,
            "OVOID_EXAMPLES": False,
            "OVOID_PYTHON": False,
        })
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        # CMakeDeps and PkgConfigDeps write these for whoever uses the package.
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "ovoid")
        core = self.cpp_info.components["core"]
        core.set_property("cmake_target_name", "ovoid::ovoid")
        core.set_property("pkg_config_name", "ovoid")
        core.libs = ["ovoid"]
        core.system_libs = ["m", "pthread"]
        if self.options.io:
            io = self.cpp_info.components["io"]
            io.set_property("cmake_target_name", "ovoid::ovoid_io")
            io.set_property("pkg_config_name", "ovoid_io")
            io.libs = ["ovoid_io"]
            io.requires = ["core", "jansson::jansson"]
        if self.options.tool:
            # The tool's alone; no library needs it.
            self.cpp_info.components["tool"].requires = ["gmp::gmp"]
