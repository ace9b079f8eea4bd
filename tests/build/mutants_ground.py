# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests/build/mutants.py stands on: a copy of the tree, its rooms as one shared library in which one file can be put in place of
another as a program starts, the tests of ./test taken apart into cases, and which of them pass which line.

The programs need libreplaced.so, which is empty, and then librooms.so. What a file of src/ gives the others is looked up in this order:
with a changed file as libreplaced.so every call goes to it, and nothing else is compiled or linked. librooms.so counts what is passed
(tests/edges/edges.c), so that a run of each case by itself tells its lines."""
import ast
import functools
import json
import os
import pathlib
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
GROUND = ROOT / "build-mutants"
TREE, BUILD, MAP, WORK = GROUND / "tree", GROUND / "build", GROUND / "map", GROUND / "work"
REPLACED = BUILD / "libreplaced.so"
# Tests that ask other things than what src/ computes (a build of their own, names, sizes, pages of documents), that link
# otherwise (allocations that fail), or wait more than they compute
NOT_ASKED = re.compile(r"^(build|arch|gate|cost|library|python|install|whole|web|hostile|live\.designs)\b|^accuracy\.survey|^effects\.|"
                       r"^serve\.(mutants|robust|hostile|doors)|^hard\.valgrind|^fuzz\.device|^fault\.(memory|kill|calls)|^cli\.(slurm|large)|"
                       r"^golden\.plans|^accept\.(masks|wafer)|^klayout\.(cells|package)|^docs\.(readme|solids|gallery_solids)|^ccx")
PROGRAMS = re.compile(r"^(flexwright|(tests/)?(unit_\w+|test_hard_\w+|live|lint_packs|clearance_outlines|judge|accuracy_reference)|"
                      r"(tests/fuzz/)?fuzzed_\w+)$")
COMPUTE = ("maths", "geometry", "flexure", "multibody", "dynamics", "clearance", "workspace", "release")
LIBRARIES = "libxml-2.0 cairo gsl jansson zlib libmicrohttpd libzip sqlite3 nlopt cmocka"


def quiet(*command, **options):
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True, **options).stdout


def copy():
    """the tree as it is now; what did not change keeps its time. Once lines are measured, of tests alone: what was tried is of one state of
    src/, and build-mutants removed begins another one"""
    begun = (MAP / "places").exists()
    for name in filter(None, quiet("git", "-C", ROOT, "ls-files", "-z").split("\0")):
        source, to = ROOT / name, TREE / name
        if begun and not name.startswith("tests/"):
            continue
        if source.is_file() and not (to.exists() and to.read_bytes() == source.read_bytes()):
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, to)
            to.chmod(source.stat().st_mode)


def inputs(target):
    """what ninja makes it from"""
    text = quiet("ninja", "-C", BUILD, "-t", "query", target)
    part = text[text.index("  input:"):text.index("  outputs:")] if "  outputs:" in text else text
    return [row.strip(" |") for row in part.splitlines()[1:]]


def prepare(with_tests):
    """builds the rooms, and links the programs that were made of older objects; with_tests: as they are now, else as they were
    measured, since one that was changed with src/ would fail for that"""
    if with_tests or not (MAP / "places").exists():
        copy()
    quiet("cmake", "-S", TREE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_C_COMPILER=clang", "-DFW_EDGES=edge", "-DFW_REPLACEABLE=ON", "-DFW_TESTS=ON",
          "-DFW_PAGE=OFF", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_C_FLAGS_DEBUG=-O1 -gline-tables-only",
          *(["-DCMAKE_C_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []), "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")
    rows = quiet("ninja", "-C", BUILD, "-t", "targets", "all").splitlines()
    programs = {name: inputs(name) for name, rule in (r.split(": ", 1) for r in rows) if rule.startswith("C_EXECUTABLE") and PROGRAMS.match(name)}
    rooms = [name for name, rule in (r.split(": ", 1) for r in rows) if rule.startswith("C_STATIC") and re.match(r"libfw_\w+\.a$", name)]
    counters = "tests/CMakeFiles/edges.dir/edges/edges.c.o"
    objects = {name: [i for i in made if i.endswith(".o") and i != counters] for name, made in programs.items()}
    wanted = sorted({o for made in objects.values() for o in made})
    print("building", flush=True)
    subprocess.run(["ninja", "-C", str(BUILD), "-j2", *rooms, counters, *wanted], check=True, stdout=subprocess.DEVNULL)
    outside = quiet("pkg-config", "--libs", *LIBRARIES.split()).split() + ["-llapacke", "-llapack", "-lm", "-lpthread"]
    link = ["clang", "-fuse-ld=lld", "-Wl,--no-as-needed"]
    def run(*command):
        subprocess.run(list(map(str, command)), check=True, cwd=BUILD)
    def older(name, made):
        return not (BUILD / name).exists() or any((BUILD / m).stat().st_mtime > (BUILD / name).stat().st_mtime for m in made)
    empty()
    library = [*rooms, counters]
    if older("librooms.so", library):
        run(*link, "-shared", "-o", "librooms.so", "-Wl,--whole-archive", *rooms, "-Wl,--no-whole-archive", counters, *outside)
        shutil.rmtree(MAP, ignore_errors=True)
    for name, made in objects.items():
        if older(name, made):
            run(*link, "-o", name, *made, "-L.", "-lreplaced", "-lrooms", f"-Wl,-rpath,{BUILD}", *outside)


def empty():
    subprocess.run(["clang", "-fuse-ld=lld", "-shared", "-nostdlib", "-o", str(REPLACED), "-x", "c", "/dev/null"], check=True)


def cases(script):
    """CLASS.test of a script of unittest"""
    text = script.read_text()
    if "unittest.main" not in text:
        return []
    found = []
    for node in ast.parse(text).body:
        if isinstance(node, ast.ClassDef):
            found += [f"{node.name}.{f.name}" for f in node.body if isinstance(f, ast.FunctionDef) and f.name.startswith("test")]
    return found


def listed():
    return quiet("ctest", "--test-dir", BUILD, "--show-only=json-v1")


def tests(rows=None):
    """{name: (command, environment, directory)}: ctest's, those of many cases taken apart"""
    found = {}
    for test in json.loads(rows or listed())["tests"]:
        name, command = test["name"], test.get("command")
        properties = {p["name"]: p["value"] for p in test["properties"]}
        if not command or NOT_ASKED.search(name) or "long" in properties.get("LABELS", []):
            continue
        environment = dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", []))
        environment.pop("FW_GALLERY_PLANS", None)
        directory = properties["WORKING_DIRECTORY"]
        if name == "golden.gallery":
            for device in sorted(TREE.glob("docs/gallery/*/device.xml")):
                found[f"{name}:{device.parent.name}"] = (command, {**environment, "FW_GALLERY_ONLY": device.parent.name}, directory)
            continue
        script = next((TREE / c for c in command[1:2] if c.endswith(".py") and (TREE / c).is_file()), None)
        parts = cases(script) if script else []
        for part in parts:
            found[f"{name}:{part}"] = ([*command, part], environment, directory)
        if not parts:
            found[name] = (command, environment, directory)
    return found


def used_by(session):
    """seconds of a processor of all processes that a test has started, those that have ended among them"""
    ticks = 0
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            part = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue  # it has just ended
        if int(part[3]) == session:
            ticks += sum(map(int, part[11:15]))
    return ticks / os.sysconf("SC_CLK_TCK")


def limited():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (16 << 30, 16 << 30))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))


def run(what, within_s, **environment):
    """(status, seconds of a processor); status "time" where it takes more than that of a processor, or ten times that by the clock"""
    command, own, directory = what
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryDirectory(dir=WORK) as place:
        process = subprocess.Popen(command, env={**os.environ, **own, **environment, "TMPDIR": place, "CMOCKA_TEST_ABORT": "1", "PYTHONDONTWRITEBYTECODE": "1"},
                                   cwd=directory, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   start_new_session=True, preexec_fn=limited)
        status, waited = None, 0  # seconds that were waited, not the clock: all of this may be stopped meanwhile
        while status is None:
            try:
                status = process.wait(timeout=1)
            except subprocess.TimeoutExpired:
                waited += 1
                if waited > 10 + 10 * within_s or used_by(process.pid) > within_s:
                    status = "time"
        try:
            os.killpg(process.pid, signal.SIGKILL)  # what it has started itself
        except ProcessLookupError:
            pass
        process.wait()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return status, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measured():
    """{case: (status, seconds)}; only those of status 0 are asked"""
    rows = (json.loads(r) for r in (MAP / "cases.jsonl").read_text().splitlines()) if (MAP / "cases.jsonl").exists() else ()
    return {r["name"]: (r["status"], r["seconds"]) for r in rows}


def chart(which, until):
    """runs each case whose name matches by itself, and keeps what it passed"""
    MAP.mkdir(parents=True, exist_ok=True)
    WORK.mkdir(exist_ok=True)
    known, every = measured(), tests()
    for name, what in every.items():
        if name in known or not re.search(which, name) or time.monotonic() > until:
            continue
        with tempfile.TemporaryDirectory(dir=WORK) as to:
            status, seconds = run(what, 300, FW_EDGES_TO=to)
            passed = None
            for file in pathlib.Path(to).glob("*.edges"):
                now = int.from_bytes(file.read_bytes().translate(bytes([0] + [1] * 255)), "little")
                passed = now if passed is None else passed | now
            if not (MAP / "places").exists():
                for file in pathlib.Path(to).glob("*.places"):
                    shutil.copyfile(file, MAP / "places")
        if passed is None and status == 0:
            status = "passes nothing of src/"
        if passed is not None:
            (MAP / (name.replace("/", "_") + ".edges")).write_bytes(zlib.compress(passed.to_bytes(passed.bit_length() // 8 + 1, "little"), 1))
        with open(MAP / "cases.jsonl", "a") as to:
            to.write(json.dumps({"name": name, "status": status, "seconds": round(seconds, 3)}) + "\n")


def lines():
    """{file of src/: {line: [edge]}}, by the places that the library has told"""
    kept = MAP / "lines.json"
    if not kept.exists():
        table = (MAP / "places").read_bytes()
        asked = "".join("0x%x\n" % int.from_bytes(table[i:i + 8], "little") for i in range(0, len(table), 16))
        text = quiet("llvm-symbolizer", f"--obj={BUILD}/librooms.so", "--inlines", "--functions=none", "--output-style=LLVM", input=asked)
        found = {}
        blocks = text.strip().split("\n\n")
        if len(blocks) != len(table) // 16:
            sys.exit("llvm-symbolizer answers otherwise than it did")
        for edge, block in enumerate(blocks):
            for row in block.splitlines():
                match = re.match(r"(.*?/src/\w+/\w+\.c):(\d+)", row)
                if match:
                    file = match.group(1)[match.group(1).rindex("/src/") + 1:]
                    found.setdefault(file, {}).setdefault(match.group(2), []).append(edge)
        kept.write_text(json.dumps(found))
    return {f: {int(n): edges for n, edges in of.items()} for f, of in json.loads(kept.read_text()).items()}


class Passed:
    """which cases pass which lines"""

    def __init__(self):
        self.lines, self.seconds, self.bytes = lines(), {}, {}
        listed = tests()
        for name, (status, seconds) in measured().items():
            if status == 0 and name in listed:
                self.seconds[name] = seconds
                self.bytes[name] = zlib.decompress((MAP / (name.replace("/", "_") + ".edges")).read_bytes())
        self.every, self.what = listed, {name: listed[name] for name in self.seconds}

    def by(self, edges):
        return {name for name, b in self.bytes.items() if any(e < len(b) and b[e] for e in edges)}

    def of(self, path, number, seen=()):
        """(cases that pass the last counted place before the line, cases that pass its function)"""
        text = (TREE / path).read_text().splitlines()
        begin = next((i for i in range(number - 1, 0, -1) if text[i - 1].startswith("}")), 0)
        end = next((i for i in range(number, len(text) + 1) if text[i - 1].startswith("}")), len(text))
        inside = {n: edges for n, edges in self.lines.get(str(path), {}).items() if begin < n <= end}
        last = max((n for n in inside if n <= number), default=None)
        near, anywhere = self.by(inside[last]) if last else set(), self.by([e for edges in inside.values() for e in edges])
        if last:
            return near, anywhere
        # a short function of this file, which is part of those that call it and has no place of its own at its start
        head = next(filter(None, (re.match(r"(?:static|INLINE)\b.*?\b(\w+)\(", t) for t in text[begin:number])), None)
        name = head.group(1) if head else None
        for i, row in enumerate(text, 1):
            if name and name not in seen and not begin < i <= end and re.search(rf"\b{name}\b", row):
                for found, there in zip((near, anywhere), self.of(path, i, (*seen, name))):
                    found |= there
        return near, anywhere


def commands():
    """{file: [how it is compiled, without what it is called and what counts]}; one file may be compiled several times"""
    found = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        path = pathlib.Path(entry["file"])
        if TREE / "src" not in path.parents:
            continue
        words = shlex.split(entry["command"])
        words = words[words.index(next(w for w in words if w.endswith("clang"))):]
        if any(w.startswith("-DFW_SERVE_WITHOUT") for w in words):
            continue  # a server with one defence left out, of tests/serve alone; the names are the same
        kept, skip = [], False
        for word in words:
            if skip:
                skip = False
            elif word in ("-o", "-c", "-MT", "-MF"):
                skip = True
            elif not word.startswith(("-fsanitize-coverage", "-MD", "-g")):
                kept.append(word)
        found.setdefault(str(path.relative_to(TREE)), []).append([*kept, "-iquote", str(path.parent)])
    return found


@functools.cache
def own_library():
    return quiet("clang", "-print-libgcc-file-name").strip()


def compiled(path, text, how, name):
    """objects of the file with this text, by what they are to be called; none where the compiler refuses it"""
    source, objects = WORK / f"{name}.c", []
    source.write_text(text)
    # a file that computes for long is optimised as the others; of most it takes more time than it saves
    level = [] if path.parts[1] in COMPUTE else ["-O0"]
    level += ["-Wtautological-unsigned-zero-compare"]  # gcc, which builds the project, too, refuses that by -Wextra
    for i, command in enumerate(how):
        objects.append(str(WORK / f"{name}-{i}.o"))
        if subprocess.run([*command, *level, "-c", str(source), "-o", objects[-1]], capture_output=True, check=False).returncode:
            return []
    return objects


def replace(objects):
    """these in place of what the library has"""
    new = WORK / "new.so"
    # what the compiler itself calls is in its own library
    subprocess.run(["ld.lld", "-shared", "-o", str(new), *objects, own_library()], check=True)
    os.replace(new, REPLACED)


def isolated():
    return bool(os.environ.get("FW_MUTANTS_ALONE"))


def isolate():
    """begins this program again where only build-mutants can be written, and /tmp is its own: a changed program deletes and
    writes what it likes"""
    if not shutil.which("unshare"):
        sys.exit("unshare (util-linux) is wanted: a changed program may delete what it likes, and must only see a copy")
    script = ('mount --make-rprivate / && mount --bind "$0" "$0" && mount -t tmpfs none /tmp && mount -o remount,bind,ro / && '
              'export FW_MUTANTS_ALONE=1 && exec "$@"')
    sys.stdout.flush()
    os.execvp("unshare", ["unshare", *(() if os.getuid() == 0 else ("-r",)), "-m", "sh", "-c", script, str(GROUND), sys.executable, *sys.argv])
