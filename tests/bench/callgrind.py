# SPDX-License-Identifier: GPL-3.0-or-later
"""Instructions of named functions, counted by callgrind: the same number on a busy machine and on an idle one. What chooses
code by the processor is pinned, so that another processor counts the same: one thread, libm and string functions without AVX
(the program's own kernels see what valgrind shows them, which has no AVX-512)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
# valgrind's processor has none of AVX-512; -AVX2 and -FMA leave the variants of libm that every x86-64 has
PINNED = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-ERMS,-FSRM", "OPENBLAS_NUM_THREADS": "1", "OPENBLAS_CORETYPE": "Nehalem",
          "OMP_NUM_THREADS": "1", "LC_ALL": "C"}


def missing():
    return not shutil.which("valgrind")


def environment():
    """Nothing of the caller's but the path: its size alone would move the stack."""
    kept = {name: os.environ[name] for name in ("PATH", "HOME", "TMPDIR", "LD_LIBRARY_PATH") if name in os.environ}
    return {**kept, **PINNED}


def total(text):
    return int(re.search(r"^(?:summary|totals): (\d+)", text, re.M).group(1))


def own(text, program, names=None):
    """Instructions in the program's own file alone, the libraries' left out. names: of objects, kept from dump to dump."""
    names = {} if names is None else names
    here, skip, found = False, False, 0
    for line in text.splitlines():
        if line.startswith("ob="):
            number, _, name = line[3:].partition(" ")
            if name:
                names[number] = name
            here = names.get(number) == str(program)
        elif line.startswith("cob="):
            number, _, name = line[4:].partition(" ")
            if name:
                names[number] = name
        elif line.startswith("calls="):
            skip = True  # the next line is what the callee cost
        elif line[:1] in "0123456789+-*" and line:
            if here and not skip:
                found += int(line.split()[1]) if " " in line else 0
            skip = False
    return found


class Part:
    """One call of the function."""

    def __init__(self, whole, of_program):
        self.total, self.own = whole, of_program


def count(program, arguments, function="measured", timeout=None):
    """(what the program printed, its status, [Part] of every call of the function, in order)"""
    program = pathlib.Path(program).resolve()
    with tempfile.TemporaryDirectory() as work:
        out = pathlib.Path(work) / "out"
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", f"--toggle-collect={function}",
                               f"--dump-after={function}", str(program), *map(str, arguments)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False, env=environment(), timeout=timeout)
        parts, names, i = [], {}, 1
        while (part := out.parent / f"out.{i}").exists():
            text = part.read_text(encoding="utf-8")
            parts.append(Part(total(text), own(text, program, names)))
            i += 1
    if not parts:
        sys.exit(f"{program.name}: callgrind counted nothing\n{done.stdout[-1000:]}{done.stderr[-2000:]}")
    return done.stdout, done.returncode, parts
