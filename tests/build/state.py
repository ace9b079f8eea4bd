#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""state.py BUILD-DIRECTORY: designs in two threads share nothing that one of them writes. Of the rooms that the library is made of no
object holds a variable of the whole process, and none calls a function of the C library that keeps or changes a state of the whole
process, but for those named here with their reasons. It looks at the objects: what no run happens to touch is seen, too.
tests/build/threads.sh (./test --all) has two designs run under ThreadSanitizer."""
import pathlib
import re
import subprocess
import sys

PROGRAMS = {"cli", "serve"}  # rooms of the program alone, one to a process
VARIABLES = {
    ("base", "arena.c", "allocations"): "atomic: how many allocations there were, for tests that let one fail",
    ("base", "arena.c", "fault_at"): "atomic: which of them fails",
    ("base", "arena.c", "fault_ever_after"): "atomic: and whether those behind it do",
    ("maths", "dense.c", "alone"): "the mutex itself",
    ("maths", "dense.c", "ready"): "written behind that mutex",
    ("maths", "functions.c", "once"): "pthread_once: GSL's handler of errors is switched off for the process",
    ("xml", "xml_parse.c", "once"): "pthread_once: the parser's own tables",
}
# a buffer or a state of the whole process (attributes(7) says MT-Unsafe); strerror and readdir are not of them in glibc
SHARED = {"strtok", "localtime", "gmtime", "ctime", "asctime", "rand", "srand", "random", "srandom", "drand48", "lrand48", "setlocale", "setenv",
          "putenv", "unsetenv", "clearenv", "tmpnam", "getpwuid", "getpwnam", "gethostbyname", "ttyname", "getlogin", "crypt", "lgamma", "umask",
          "chdir", "signal", "sigaction", "sigprocmask", "alarm", "setitimer", "exit", "gsl_set_error_handler", "gsl_set_error_handler_off",
          "xmlSetGenericErrorFunc", "xmlInitParser", "xmlCleanupParser", "fesetround", "fesetenv"}
CALLS = {
    ("maths", "functions.c", "gsl_set_error_handler_off"): "by pthread_once",
    ("xml", "xml_parse.c", "xmlInitParser"): "by pthread_once",
    ("continuum", "solver.c", "chdir"): "in the child behind fork",
    ("continuum", "solver.c", "signal"): "in the child behind fork",
    ("continuum", "solver.c", "sigprocmask"): "in the child behind fork",
}


def objects(archive):
    """(file, section, symbol) of each object of an archive, (file, None, symbol) of what it asks others for"""
    listing = subprocess.run(["objdump", "-t", archive], capture_output=True, text=True, check=True).stdout
    file = None
    for row in listing.splitlines():
        if member := re.match(r"(\S+)\.o: +file format", row):
            file = member.group(1)
        elif " *UND*\t" in row:
            yield file, None, row.split()[-1]
        elif found := re.search(r" O (\S+)\t", row):
            yield file, found.group(1), re.sub(r"\.\d+$", "", row.split()[-1])
        elif " *COM*\t" in row:
            yield file, "*COM*", row.split()[-1]


def main(build):
    rooms = re.search(r"set\(FW_ROOMS ([^)]*)\)", (pathlib.Path(__file__).resolve().parents[2] / "cmake/rooms.cmake").read_text()).group(1).split()
    wrong, variables, calls, looked_at = [], set(), set(), 0
    for room in rooms:
        archive = build / f"libfw_{room}.a"
        if room in PROGRAMS or not archive.exists():
            continue
        for file, section, symbol in objects(archive):
            looked_at += 1
            if section is None and symbol in SHARED:
                calls.add((room, file, symbol))
            elif section and not section.startswith((".rodata", ".data.rel.ro", ".lrodata")):
                variables.add((room, file, symbol))
    for room, file, symbol in sorted(variables - VARIABLES.keys()):
        wrong.append(f"src/{room}/{file}: '{symbol}' is one variable of all designs: keep it with the design, or make it const")
    for room, file, symbol in sorted(calls - CALLS.keys()):
        wrong.append(f"src/{room}/{file} calls {symbol}, which changes a state of the whole process")
    for row in sorted((VARIABLES.keys() - variables) | (CALLS.keys() - calls)):
        wrong.append("tests/build/state.py excuses what is not there: %s/%s %s" % row)
    print("\n".join(wrong + [f"{looked_at} symbols of {len(rooms) - len(PROGRAMS)} rooms; {len(VARIABLES)} variables of the process, {len(CALLS)} calls"]))
    return 1 if wrong or not looked_at else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
