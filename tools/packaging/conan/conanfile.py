"""Recipe of conan for libhair, with libhair_egl and libhair_bullet as options.

    conan create tools/packaging/conan
"""

import os
import re

from conan import ConanFile
from conan.tools.files import copy, rmdir

ROOT = os.path.join("..", "..", "..")


class Hair(ConanFile):
    """Build by make and package the installed tree."""

    name = "hair"
    license = "MIT"
    description = "Strand hair in real time"
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "egl": [True, False], "bullet": [True, False]}
    default_options = {"shared": False, "egl": True, "bullet": False}

    def set_version(self):
        """Take the version from the headers."""
        path = os.path.join(self.recipe_folder, ROOT, "include", "hair", "hair_base.h")
        with open(path, encoding="utf-8") as file:
            self.version = ".".join(re.findall(r"^#define HAIR_VERSION_\w+ (\d+)", file.read(), re.MULTILINE))

    def export_sources(self):
        """Export the sources that the libraries and their packages are made of."""
        root = os.path.join(self.recipe_folder, ROOT)
        for pattern in ("Makefile", "LICENSE", "include/*", "lib/*", "glsl/*", "tools/*", "tests/*.mk", "tests/consumer/*",
                        "tests/*/*.mk"):  # fmt: skip
            copy(self, pattern, root, self.export_sources_folder)

    def build(self):
        """Build the libraries."""
        self._make("libraries")

    def package(self):
        """Install the libraries, and keep those of the chosen kind."""
        self._make(f"install-libraries PREFIX={self.package_folder}")
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        folder = os.path.join(self.package_folder, "lib")
        for name in ("cmake", "pkgconfig"):  # conan makes such files itself.
            rmdir(self, os.path.join(folder, name))
        for name in os.listdir(folder):
            is_shared, is_static = ".so" in name, name.endswith(".a")
            is_unwanted = not self.options.egl and name.startswith("libhair_egl.")
            if is_unwanted or (is_shared and not self.options.shared) or (is_static and self.options.shared):
                os.remove(os.path.join(folder, name))

    def package_info(self):
        """Name the targets as hairConfig.cmake does."""
        self.cpp_info.set_property("cmake_file_name", "hair")
        self._component("hair", "hair", [], ["m"])
        if self.options.egl:
            self._component("egl", "hair_egl", ["hair"], [] if self.options.shared else ["EGL"])
        if self.options.bullet:
            self._component("bullet", "hair_bullet", ["hair"], ["BulletCollision", "LinearMath", "stdc++"])

    def _component(self, name, library, requires, system_libs):
        component = self.cpp_info.components[name]
        component.libs, component.requires, component.system_libs = [library], requires, system_libs
        component.set_property("cmake_target_name", f"hair::{name}")
        component.set_property("pkg_config_name", library)
        component.defines = ["HAIR_SHARED"] if self.options.shared else []

    def _make(self, target):
        bullet = 1 if self.options.bullet else 0
        config = "debug" if self.settings.build_type == "Debug" else "release"
        self.run(f"make -j{os.cpu_count()} SETUP=0 VIEW=0 BULLET={bullet} config={config} {target}", cwd=self.source_folder)
