# SPDX-License-Identifier: GPL-3.0-or-later
"""`pip install .` at the top of the source tree: the package of this directory, by setuptools."""
import contextlib
import os
import pathlib
from typing import Any, Iterator

from setuptools import build_meta


@contextlib.contextmanager
def _here() -> Iterator[None]:
    before = os.getcwd()
    os.chdir(pathlib.Path(__file__).resolve().parent)
    try:
        yield
    finally:
        os.chdir(before)


def _hook(name: str) -> Any:
    def call(*arguments: Any, **named: Any) -> Any:
        with _here():
            return getattr(build_meta, name)(*arguments, **named)
    return call


build_wheel = _hook("build_wheel")
build_sdist = _hook("build_sdist")
prepare_metadata_for_build_wheel = _hook("prepare_metadata_for_build_wheel")
get_requires_for_build_wheel = _hook("get_requires_for_build_wheel")
get_requires_for_build_sdist = _hook("get_requires_for_build_sdist")
