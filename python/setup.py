# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts libflexwright and its packs into the wheel, so that it works wherever it is installed.

FLEXWRIGHT_BUILD names a directory of CMake with a library that is built, from the top of the source tree; without it one
is built.
"""
import os
import pathlib
import re
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

SOURCE = pathlib.Path(__file__).resolve().parents[1]


def version() -> str:
    """As CMakeLists.txt states it."""
    text = (SOURCE / "CMakeLists.txt").read_text()
    return re.search(r"project\(flexwright VERSION (\S+)", text).group(1)


def library(scratch: pathlib.Path) -> pathlib.Path:
    """The shared library, built where it is not."""
    built = os.environ.get("FLEXWRIGHT_BUILD")
    if built:
        here = SOURCE / built / "libflexwright.so.0"
        if not here.exists():
            raise SystemExit(f"FLEXWRIGHT_BUILD={built}: {here} does not exist; name a directory that cmake has built in, "
                             "from the top of the source tree or as an absolute path")
        return here
    configure = ["cmake", "-S", str(SOURCE), "-B", str(scratch), "-DFW_TESTS=OFF"]
    if shutil.which("ninja"):
        configure += ["-G", "Ninja"]
    subprocess.run(configure, check=True)
    subprocess.run(["cmake", "--build", str(scratch), "--parallel", "--target", "flexwright_library"],
                   check=True)
    return scratch / "libflexwright.so.0"


class BuildWithLibrary(build_py):
    """Python files, then the library beside them."""

    def run(self) -> None:
        super().run()
        if self.editable_mode:
            return  # it is found in build/ of the source tree
        native = pathlib.Path(self.build_lib) / "flexwright" / "_native"
        scratch = pathlib.Path(self.get_finalized_command("build").build_temp).resolve() / "library"
        shutil.rmtree(native, ignore_errors=True)
        (native / "lib").mkdir(parents=True)
        shutil.copy(library(scratch), native / "lib" / "libflexwright.so.0")
        for name in ("processes", "masks"):
            shutil.copytree(SOURCE / name, native / "share" / "flexwright" / name,
                            ignore=shutil.ignore_patterns("gallery"))


class OfThisMachine(Distribution):
    """With a library in it a wheel is no other machine's."""

    def has_ext_modules(self) -> bool:
        return True


setup(version=version(), cmdclass={"build_py": BuildWithLibrary}, distclass=OfThisMachine)
