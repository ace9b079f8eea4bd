# SPDX-License-Identifier: GPL-3.0-or-later
"""The program from within KLayout: where it is, device files and their parameters, a run and what it says."""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import xml.etree.ElementTree as ET

HERE = pathlib.Path(__file__).resolve().parents[2]  # the package: share/flexwright/klayout, or klayout/ of the source
SPACE = "{urn:flexwright:device:1}"
LARGEST = 8 << 20  # bytes of a device file, as the program has it
# A mask is drawn while somebody waits: its geometry does not depend on how closely the motion is judged.
FAST = ["--force", "--corners", "none", "--advice", "none", "--measurements", "none", "--accuracy", "3e-2", "--hinge-model", "revolute", "--color",
        "never", "-q", "--gds", "-"]


class Failure(Exception):
    """What the program says, one sentence an error, with code and place."""

    def __init__(self, sentences):
        super().__init__("\n".join(sentences))
        self.sentences = list(sentences)


def configured(name):
    """a setting of KLayout, "flexwright-program" or "flexwright-devices", or the variable FLEXWRIGHT_PROGRAM or FLEXWRIGHT_DEVICES"""
    value = os.environ.get("FLEXWRIGHT_" + name.upper())
    if value:
        return value
    try:
        import pya
        return pya.Application.instance().get_config("flexwright-" + name)
    except (ImportError, AttributeError, RuntimeError):
        return None


def program():
    """path of the program: as set, the one that this package was installed with, or one of PATH"""
    own = os.path.normpath(HERE / "../../../bin/flexwright")
    for path in (configured("program"), own, shutil.which("flexwright"), "/usr/local/bin/flexwright", "/usr/bin/flexwright"):
        if path and os.access(path, os.X_OK) and os.path.isfile(path):
            return str(path)
    raise Failure(["the program flexwright is not found. Install it, or name it: the variable FLEXWRIGHT_PROGRAM, or Tools > Flexwright > Settings"])


def device_files():
    """{name: path} of the folders that are set and of the examples that came with the package"""
    folders = [p for p in (configured("devices") or "").split(os.pathsep) if p]
    examples = HERE / "devices" if (HERE / "devices").is_dir() else HERE.parent / "docs/gallery"
    found = {}
    for folder in [*folders, str(examples)]:
        top = pathlib.Path(folder).expanduser()
        for path in sorted([*top.glob("*.xml"), *top.glob("*/device.xml")]):
            device = read(path)
            if device is None:
                continue
            name, n = device.get("name") or path.stem, 2
            while name in found:
                name, n = "%s-%d" % (device.get("name") or path.stem, n), n + 1
            found[name] = path.resolve()
    return found


def read(path):
    """root of a device file; None: it is none, or cannot be read (the program says why)"""
    try:
        text = pathlib.Path(path).read_bytes()
        if len(text) > LARGEST or b"<!DOCTYPE" in text or b"<!ENTITY" in text:
            return None
        root = ET.fromstring(text)
    except (OSError, ET.ParseError, ValueError):
        return None
    return root if root.tag == SPACE + "device" else None


def parameters(root):
    """[(name, value, description)] as the file has them: texts with units"""
    out = []
    for e in root.iter(SPACE + "parameter"):
        low, high, doc = e.get("min"), e.get("max"), e.get("doc")
        within = "%s to %s" % (low, high) if low and high else "at least " + low if low else "at most " + high if high else ""
        out.append((e.get("name", ""), e.get("value", ""), e.get("name", "") + (" (%s)" % within if within else "") + (": " + doc if doc else "")))
    return out


def flows(root):
    return [e.get("ref", "") for e in root.findall(SPACE + "flow")]


def wait(arguments):
    """status, standard output and messages of a run. No events of the window are handled meanwhile: KLayout would ask at once whether to reload the files
    that the run writes."""
    try:
        done = subprocess.run(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    except OSError as error:
        raise Failure(["%s cannot be run: %s" % (arguments[0], error.strerror)]) from error
    return done.returncode, done.stdout, done.stderr.decode("utf-8", "replace")


def errors(text, status):
    """"FILE:LINE:COLUMN: error: ... [FW-Dnnn]", each with its further lines joined; what there is where there is none"""
    found = re.findall(r"^(.*error: .*)$", text, re.M)
    return found or [line for line in text.splitlines() if line.strip()][-3:] or ["flexwright ended with status %d and said nothing" % status]


known = {}  # what was drawn last: a redraw without a change runs nothing


def mask(path, flow, settings):
    """bytes of the flow's GDSII, and is the design rejected? settings: {parameter: "250 um"}. Failure: there is no mask."""
    tool = program()
    arguments = [tool, "mask", str(path), *FAST]
    if not flow:
        root = read(path)
        flow = next(iter(flows(root)), "") if root is not None else ""
    if flow:
        arguments += ["--flow", flow]
    for name, value in sorted(settings.items()):
        arguments += ["--set", "%s=%s" % (name, value)]
    try:
        content = hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
    except OSError as error:
        raise Failure(["%s cannot be read: %s" % (path, error.strerror)]) from error
    key = (content, os.stat(tool).st_mtime_ns, os.environ.get("FLEXWRIGHT_DATA"), tuple(arguments))
    if key not in known:
        status, drawn, said = wait(arguments)
        if not drawn:
            raise Failure(errors(said, status))
        while len(known) >= 32:
            known.pop(next(iter(known)))
        broken = [s for s in errors(said, status) if "error: " in s]
        known[key] = drawn, status == 1, broken
    return known[key]
