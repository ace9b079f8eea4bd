#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""test_install.py BUILD: the installed tree works wherever it is moved to, manual pages and completions have
every command and option of --help, and the Debian package can be installed, used and removed."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
SIX_BAR = ROOT / "docs/gallery/reference-six-bar/device.xml"
CLEAN = {k: v for k, v in os.environ.items() if not k.startswith(("FLEXWRIGHT_", "LD_", "PYTHON"))}


def run(*command, status=0, **named):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False,
                          env={**CLEAN, **named.pop("environment", {})}, **named)
    assert done.returncode == status, (command, done.returncode, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


def commands():
    listed = run(BUILD / "flexwright", "--help").split("Commands:\n")[1].split("\n\n")[0]
    return [line.split()[0] for line in listed.splitlines()]


def options(command):
    listed = run(BUILD / "flexwright", command, "--help").split("Options:\n")[1]
    return re.findall(r"^  (?:-\w, |    )--([\w-]+)", listed, re.M)


class Tree(unittest.TestCase):
    """cmake --install, moved."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        first = pathlib.Path(cls.scratch.name, "first")
        run("cmake", "--install", BUILD, "--prefix", first)
        cls.prefix = pathlib.Path(cls.scratch.name, "moved", "with a space")
        cls.prefix.parent.mkdir()
        first.rename(cls.prefix)
        cls.program = cls.prefix / "bin/flexwright"

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_program(self):
        here = pathlib.Path(self.scratch.name, "here")
        here.mkdir()
        shutil.copy(SIX_BAR, here / "device.xml")
        run(self.program, "check", "device.xml", "-o", "mine", "-q", cwd=here)
        run(BUILD / "flexwright", "check", "device.xml", "-o", "theirs", "-q", cwd=here)
        self.assertEqual((here / "mine/verdict.json").read_bytes(), (here / "theirs/verdict.json").read_bytes())
        self.assertIn("flexwright", run(self.program, "doctor"))
        link = here / "flexwright"  # as /usr/local/bin may have one
        link.symlink_to(self.program)
        self.assertEqual(json.loads(run(link, "check", "device.xml", "--json", cwd=here))["verdict"], "accept")

    def test_its_own_packs(self):
        copy = pathlib.Path(self.scratch.name, "copy")
        shutil.copytree(self.prefix, copy)
        base = copy / "share/flexwright/processes/base.xml"
        base.write_text(base.read_text().replace("<material", "<metarial", 1))
        run(copy / "bin/flexwright", "check", SIX_BAR, status=3)
        run(self.program, "check", SIX_BAR)
        named = {"FLEXWRIGHT_DATA": str(self.prefix / "share/flexwright")}
        run(copy / "bin/flexwright", "check", SIX_BAR, environment=named)

    def test_nothing_remembers_the_prefix(self):
        for path in self.prefix.rglob("*"):
            if path.is_file() and not path.is_symlink():
                self.assertNotIn(str(pathlib.Path(self.scratch.name, "first")).encode(), path.read_bytes(), path)

    def test_catalogue(self):
        data = self.prefix / "share/flexwright"
        for schema in ("device.rng", "study.rng"):
            self.assertEqual((data / schema).read_bytes(), (ROOT / "docs/reference" / schema).read_bytes())
        if shutil.which("xmlcatalog"):
            found = run("xmlcatalog", data / "catalog.xml", "urn:flexwright:device:1").strip()
            self.assertTrue(found.endswith("/device.rng"), found)
            found = run("xmlcatalog", data / "catalog.xml", "urn:flexwright:study:1").strip()
            self.assertTrue(found.endswith("/study.rng"), found)
            found = run("xmlcatalog", data / "catalog.xml", "urn:flexwright:process:1").strip().removeprefix("file://")
            found = urllib.parse.unquote(found)
            self.assertTrue(pathlib.Path(found).samefile(data / "processes/packs.rng"), found)
            for pack in (data / "processes").glob("*.xml"):
                run("xmllint", "--nonet", "--noout", "--relaxng", found, pack)

    def test_pages(self):
        """every page is there with all that it links to, and the devices that its examples name"""
        pages = self.prefix / "share/doc/flexwright"
        links = 0
        for page in pages.rglob("*.md"):
            for link in re.findall(r"\]\(([^)#\s]+)", page.read_text(encoding="utf-8")):
                links += 1
                self.assertTrue("://" in link or (page.parent / link).exists(), (page, link))
        self.assertGreater(links, 300)
        self.assertTrue((pages / "docs/gallery/reference-six-bar/device.xml").is_file())

    def test_klayout_package(self):
        """whole, with the gallery's devices; it finds the program of its own prefix and makes the technologies"""
        package = self.prefix / "share/flexwright/klayout"
        for name in ("grain.xml", "pymacros/flexwright.lym", "drc/engine.rb", "devices/reference-six-bar.xml"):
            self.assertTrue((package / name).is_file(), name)
        found = run(sys.executable, "-B", "-c", "import sys; sys.path.insert(0, %r); from flexwright_klayout import program; print(program.program()); "
                    "print(sorted(program.device_files())[:2])" % str(package / "python"))
        self.assertEqual(found.splitlines()[0], str(self.prefix / "bin/flexwright"))
        self.assertIn("comb-stage", found)
        made = self.prefix.parent / "tech"
        run(package / "make_tech.py", self.prefix / "bin/flexwright", made)
        for path in (package / "tech").rglob("*.ly*"):
            self.assertEqual(path.read_bytes(), (made / path.relative_to(package / "tech")).read_bytes())

    def test_manual_pages(self):
        pages = self.prefix / "share/man/man1"
        main = (pages / "flexwright.1").read_text()
        known = commands()
        self.assertGreater(len(known), 10)
        self.assertEqual({p.name for p in pages.iterdir()},
                         {"flexwright.1"} | {f"flexwright-{c}.1" for c in known})
        for command in known:
            self.assertIn(f"flexwright\\-{command} (1)", main)
            page = (pages / f"flexwright-{command}.1").read_text()
            for line in page.splitlines():
                self.assertFalse(line.startswith("'"), line)
            for option in options(command):
                self.assertIn("\\fB\\-\\-" + option.replace("-", "\\-") + "\\fR", page)
        if shutil.which("groff"):
            for page in pages.iterdir():
                done = subprocess.run(["groff", "-man", "-ww", "-Tascii", str(page)], capture_output=True,
                                      text=True, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""), page)

    def complete(self, *words):
        script = self.prefix / "share/bash-completion/completions/flexwright"
        quoted = " ".join(f"'{word}'" for word in words)
        return run("bash", "-c", f". '{script}'; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _flexwright; "
                   'printf "%s\\n" "${COMPREPLY[@]}"', cwd=self.scratch.name).split("\n")[:-1]

    def test_bash(self):
        self.assertEqual(set(self.complete("flexwright", "")) - {"--help", "--version"}, set(commands()))
        self.assertEqual(self.complete("flexwright", "work"), ["workspace"])
        for command in commands():
            self.assertEqual(set(self.complete("flexwright", command, "--")), {"--" + o for o in options(command)})
        self.assertIn("udwadia-kalaba", self.complete("flexwright", "simulate", "--method", ""))
        self.assertEqual(self.complete("flexwright", "simulate", "--integrator", "=", "dop8"), ["dop853"])
        self.assertEqual(self.complete("flexwright", "modes", "x.xml", "--at", "eq"), ["equilibrium"])
        flows = {path.stem for path in (self.prefix / "share/flexwright/masks").glob("*.xml")}
        self.assertGreaterEqual(len(flows), 5)
        self.assertEqual(set(self.complete(self.prefix / "bin/flexwright", "plan", "x.xml", "--flow", "")), flows)
        self.assertEqual(self.complete(self.prefix / "bin/flexwright", "calibrate", "--flow", "al-"), ["al-masked-rie"])
        pathlib.Path(self.scratch.name, "my device.xml").touch()
        pathlib.Path(self.scratch.name, "my notes.txt").touch()
        self.assertEqual(self.complete("flexwright", "check", "my"), ["my device.xml"])

    def test_other_shells(self):
        zsh = (self.prefix / "share/zsh/vendor-completions/_flexwright").read_text()
        fish = (self.prefix / "share/fish/vendor_completions.d/flexwright.fish").read_text()
        self.assertTrue(zsh.startswith("#compdef flexwright\n"))
        for command in commands():
            part = zsh.split(f"\n        {command}) shift words")[1].split(";;")[0]
            for option in options(command):
                self.assertIn("--" + option, part)
                self.assertIn(f"'__fish_seen_subcommand_from {command}' -l {option} ", fish)
        for shell in (zsh, fish):  # a colon and an apostrophe are the shell's own: the words keep a comma, and theirs
            self.assertIn("only the verdict, does a hinge leave its elastic range?", shell)
            self.assertIn("equilibrium under a scene\u2019s loads", shell)
        for line in zsh.splitlines() + fish.splitlines():  # quotes are closed
            self.assertEqual(line.count("'") % 2, 0, line)
        for shell, name in (("zsh", "share/zsh/vendor-completions/_flexwright"),
                            ("fish", "share/fish/vendor_completions.d/flexwright.fish")):
            if shutil.which(shell):
                run(shell, "-n", self.prefix / name)


class Package(unittest.TestCase):
    """The package of Debian in a root of its own."""

    def test_installed_used_removed(self):
        if not shutil.which("dpkg-deb") or not shutil.which("dpkg-shlibdeps"):
            self.skipTest("no tools of Debian packages (dpkg-dev)")
        with tempfile.TemporaryDirectory() as scratch:
            run("cpack", "-G", "DEB", "-B", scratch, "--config", BUILD / "CPackConfig.cmake", cwd=scratch)
            deb, = pathlib.Path(scratch).glob("flexwright_*.deb")
            field = dict(line.split(": ", 1) for line in run("dpkg-deb", "-f", deb).splitlines()
                         if re.match(r"[\w-]+: ", line))
            self.assertEqual(field["Package"], "flexwright")
            for needed in ("libxml2", "libcairo2", "libgsl27", "liblapacke", "libmicrohttpd12", "libc6"):
                self.assertIn(needed, field["Depends"])
            self.assertIn("python3-numpy", field["Recommends"])
            root = pathlib.Path(scratch, "root")
            admin = root / "var/lib/dpkg"
            for name in ("info", "updates", "triggers"):
                (admin / name).mkdir(parents=True)
            (admin / "status").touch()
            (admin / "available").touch()
            dpkg = ("dpkg", f"--root={root}", "--force-depends", "--force-not-root",
                    "--force-script-chrootless", "--log=/dev/null")
            run(*dpkg, "-i", deb)
            program = root / "usr/bin/flexwright"
            self.assertEqual(json.loads(run(program, "check", SIX_BAR, "--json"))["verdict"], "accept")
            base = root / "usr/share/flexwright/processes/base.xml"
            self.assertTrue(base.exists())
            run("/usr/bin/python3", "-c", "import flexwright, sys; d = flexwright.Device(sys.argv[1]); "
                "assert flexwright.__file__.startswith(sys.argv[2]); assert d.check().accepted; import flexwright_klayout.program", SIX_BAR, root,
                environment={"PYTHONPATH": ":".join(str(root / at) for at in ("usr/lib/python3/dist-packages", "usr/share/flexwright/klayout/python"))},
                cwd=scratch)
            self.assertTrue(list((root / "usr/lib/python3").rglob("*.pyc")))  # compiled by whoever may write there: goes with the package
            run(*dpkg, "-r", "flexwright")
            self.assertFalse([p for p in (root / "usr").rglob("*") if "flexwright" in p.name])


if __name__ == "__main__":
    unittest.main()
