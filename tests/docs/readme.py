#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What README.md, the tutorial and the pages on mechanisms and gallery tell a newcomer to type works, and the files that they name exist.
./demo and ./test are not run from inside a test; everything else is. Studies that size at a wanted yield judge thousands of dies, and that of
six numbers takes ten seconds: without FW_TEST_ALL=1 they are only planned, and what the sizes found is judged again by cli.sizing."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
program = pathlib.Path(sys.argv[1]).resolve()
text = (ROOT / "README.md").read_text()
problems = []

with tempfile.TemporaryDirectory() as here:
    (pathlib.Path(here) / "build").mkdir()
    (pathlib.Path(here) / "build/flexwright").symlink_to(program)
    (pathlib.Path(here) / "out").mkdir()
    (pathlib.Path(here) / "docs").symlink_to(ROOT / "docs")
    pages = text + "".join((ROOT / "docs" / page).read_text()
                           for page in ("tutorial.md", "mechanisms/README.md", "gallery/README.md"))
    # once each, though pages share some
    commands = list(dict.fromkeys(line.strip() for line in pages.splitlines() if line.startswith("    build/flexwright")))
    if len(commands) < 12:
        problems.append("README or the tutorial has lost its commands")
    for command in commands:
        study = re.search(r"study (docs/studies/\S+\.xml)", command)
        long = study and ('yield="0' in (ROOT / study[1]).read_text() or "which-of-six" in study[1])
        if long and not os.environ.get("FW_TEST_ALL"):
            command += " --plan"
        done = subprocess.run(command, shell=True, cwd=here, capture_output=True, text=True, timeout=900 if study else 120)
        if done.returncode != 0:
            problems.append(f"{command}: status {done.returncode}\n{done.stderr}")

# what the README quotes of the gallery device is what the program prints
device = ROOT / "docs/gallery/reference-six-bar/device.xml"
printed = subprocess.run([program, "check", device], capture_output=True, text=True).stdout
short = re.sub(r'length="([0-9.]+) um"', lambda m: f'length="{float(m.group(1)) / 4:g} um"', device.read_text())
printed += subprocess.run([program, "check", "-"], input=short, capture_output=True, text=True).stdout
for line in re.findall(r"^    (reference-six-bar: .*|as made, .*|as drawn: .*|not guaranteed: .*|flexure \w+: .*)$", text, re.M):
    if line not in printed:
        problems.append(f"README quotes '{line}', which the program does not print")

# and what the gallery's page quotes is in its verdicts and ledgers, which another test keeps as they are today
gallery = (ROOT / "docs/gallery/README.md").read_text()
for name, section in re.findall(r"^## ([\w-]+)\n(.*?)(?=^## |\Z)", gallery, re.M | re.S):
    made = "".join((ROOT / f"docs/gallery/{name}/{file}.txt").read_text() for file in ("verdict", "ledger"))
    for quoted in re.findall(r"\d+\.\d+ (?:%|V)", section):
        if quoted not in made:
            problems.append(f"the gallery quotes {quoted} of {name}, which is not in its verdict or ledger")

for target in re.findall(r"\]\(([^)#:]+)\)", text):
    if not (ROOT / target).exists():
        problems.append(f"README links to {target}, which is not there")
for page in [ROOT / "src/README.md", *ROOT.glob("docs/**/*.md")]:
    for target in re.findall(r"\]\(([^)#:]+)\)", page.read_text()):
        if not (page.parent / target).exists():
            problems.append(f"{page.relative_to(ROOT)} links to {target}, which is not there")
for script in ("demo", "test"):
    if not shutil.which(f"./{script}", path=str(ROOT)) and not (ROOT / script).stat().st_mode & 0o100:
        problems.append(f"./{script} is not executable")
for room in re.search(r"FW_ROOMS ([^)]*)\)", (ROOT / "cmake/rooms.cmake").read_text()).group(1).split():
    if f"`{room}/`" not in (ROOT / "src/README.md").read_text():
        problems.append(f"src/README.md does not name the room {room}/")

print("\n".join(problems) or f"{len(commands)} commands run, links good")
sys.exit(1 if problems else 0)
