#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands where a test wants ccx: ccx_once.py CCX STORE NAME runs CCX in this directory and keeps what it writes; the next time,
a deck of the same bytes is answered from STORE. A solve takes ten seconds; CalculiX in one thread gives the same again."""
import ctypes
import hashlib
import pathlib
import shutil
import signal
import subprocess
import sys

DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)


def main():
    solver, store, name = sys.argv[1:]
    here = pathlib.Path.cwd()
    deck = here / f"{name}.inp"
    known = pathlib.Path(store) / hashlib.sha256(deck.read_bytes()).hexdigest()
    if not known.exists():
        libc = ctypes.CDLL(None)
        code = subprocess.run([solver, name], check=False,
                              preexec_fn=lambda: libc.prctl(DIE_WITH_PARENT, signal.SIGKILL)).returncode
        if code:
            return code
        known.mkdir()
        for path in here.glob(f"{name}.*"):
            if path != deck:
                shutil.copy(path, known)
        return 0
    for path in known.iterdir():
        shutil.copy(path, here)
    return 0


if __name__ == "__main__":
    sys.exit(main())
