# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds what is compared, Flexwright and those of its peers that are installed, and runs it."""
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys

import curves

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
REFERENCE = ROOT / "tests/data/sixbar_ref_0p1ms.txt"
SUNDIALS = ["ida", "cvode", "nvecserial", "sunlinsolklu", "sunlinsoldense", "sunmatrixsparse",
            "sunmatrixdense", "sunnonlinsolfixedpoint"]


def say(text):
    print(text, file=sys.stderr, flush=True)


def command(arguments, **more):
    return subprocess.run(arguments, capture_output=True, text=True, check=False, **more)


def child():
    """One processor, so that both sides of a pair have the same one."""
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


class Programs:
    """Built programs by name, and what was skipped. built: ours are there, in a Release build."""

    def __init__(self, build, wanted, built=False):
        self.build, self.run, self.skipped, self.versions = build, {}, [], {}
        self.environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", LC_ALL="C")
        (build / "peers").mkdir(parents=True, exist_ok=True)
        self.flexwright(built)
        for name, make in (("Simbody", self.simbody), ("SUNDIALS", self.sundials), ("Octave", self.octave)):
            if name.lower() not in wanted:
                self.skipped.append(f"{name}: not asked for")
            elif problem := make():
                self.skipped.append(f"{name}: {problem}")
        for line in self.skipped:
            say(f"skipped: {line}")

    def flexwright(self, built):
        say("building flexwright" if not built else f"flexwright is that of {self.build}")
        for arguments in () if built else (["cmake", "-S", ROOT, "-B", self.build, "-G", "Ninja",
                           "-DCMAKE_BUILD_TYPE=Release", "-DFW_PAGE=OFF"],
                          ["cmake", "--build", self.build, "--target", "bench"]):
            done = command(arguments)
            if done.returncode:
                sys.exit(done.stdout[-3000:] + done.stderr[-3000:])
        self.run["flexwright"] = [self.build / "tests/bench/bench_transient"]
        self.versions["compiler"] = command(["cc", "--version"]).stdout.splitlines()[0]

    def compile(self, name, arguments):
        program = self.build / "peers" / name
        done = command([*arguments, "-O2", "-o", program])
        if done.returncode:
            return None, "does not build (tests/bench/peers/install installs it): " + (
                done.stderr.strip().splitlines() or ["no message"])[0]
        return [program], None

    def simbody(self):
        flags = command(["pkg-config", "--cflags", "simbody"])
        libraries = command(["pkg-config", "--libs", "simbody"])
        if flags.returncode or not shutil.which("c++"):
            return "not installed; tests/bench/peers/install does that"
        program, problem = self.compile("peer_simbody", [
            "c++", "-std=c++17", *flags.stdout.split(), HERE / "peers/simbody.cpp", "-Wl,--no-as-needed",
            *libraries.stdout.split()])
        if program:
            self.run["Simbody"] = program
            self.version("Simbody", "libsimbody-dev")
        return problem

    def sundials(self):
        program, problem = self.compile("peer_sundials", [
            "cc", "-std=gnu17", "-I/usr/include/suitesparse", HERE / "peers/sundials.c", "-Wl,--no-as-needed",
            *["-lsundials_" + name for name in SUNDIALS], "-lklu", "-lm"])
        if program:
            self.run["SUNDIALS"] = program
            self.version("SUNDIALS", "libsundials-dev")
            self.version("SuiteSparse", "libsuitesparse-dev")
        return problem

    def octave(self):
        if not shutil.which("octave-cli"):
            return "not installed; tests/bench/peers/install does that"
        self.run["Octave"] = ["octave-cli", "--no-init-file", "--no-window-system", HERE / "peers/octave.m"]
        self.version("Octave", "octave")
        return None

    def version(self, name, package):
        found = command(["dpkg-query", "-W", "-f", "${Version}", package])
        self.versions[name] = f"{package} {found.stdout}" if found.returncode == 0 else "unknown"

    def measure(self, name, problem, *arguments):
        """Rows of one run. Run a program by itself to see why a setting fails."""
        done = subprocess.run([*self.run[name], problem, *map(str, arguments), "--reference", REFERENCE],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False,
                              env=self.environment, preexec_fn=child)
        rows = curves.parse(problem, done.stdout)
        if not rows:
            say(f"{name} {problem}: no result (status {done.returncode})")
        return rows


def machine():
    """(processor, system)"""
    cpu = re.search(r"^model name\s*:\s*(.*)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.M)
    return (cpu.group(1) if cpu else platform.machine(),
            platform.freedesktop_os_release().get("PRETTY_NAME", platform.system()))
