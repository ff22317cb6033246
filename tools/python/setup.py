"""Make a wheel for every Python 3 of one kind of machine, because the wheel holds shared libraries."""

from setuptools import Distribution, setup
from wheel.bdist_wheel import bdist_wheel


class BinaryDistribution(Distribution):
    """A distribution that depends on the machine."""

    def has_ext_modules(self):
        """Return True, which selects the folder for packages with machine code."""
        return True


class PlatformWheel(bdist_wheel):
    """A wheel that does not depend on the version of Python."""

    def get_tag(self):
        """Return the tag of Python, of the binary interface, and of the machine."""
        return "py3", "none", super().get_tag()[2]


setup(distclass=BinaryDistribution, cmdclass={"bdist_wheel": PlatformWheel})
