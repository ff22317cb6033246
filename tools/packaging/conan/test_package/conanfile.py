"""Build and run a program with the package."""

import os

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, cmake_layout


class HairTest(ConanFile):
    """Compile the consumer by CMake and run it."""

    settings = "os", "arch", "compiler", "build_type"
    generators = "CMakeDeps", "CMakeToolchain"

    def requirements(self):
        """Take the package that is tested."""
        self.requires(self.tested_reference_str)

    def layout(self):
        """Keep the build in a folder of its own."""
        cmake_layout(self)

    def build(self):
        """Build by CMake."""
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def test(self):
        """Run the program."""
        if can_run(self):
            self.run(os.path.join(self.cpp.build.bindir, "groom"), env="conanrun")
