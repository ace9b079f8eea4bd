#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""kl_asked.py JOBS ANSWERS: many checks in one KLayout, whose start takes longer than most of them.

JOBS: a line for each, by tabs: what is said of it, a script of this directory, NAME=VALUE of its variables. ANSWERS: a line
"ok    …" or "FAIL  …" for each, after a failure what the script printed. Exit 1 where KLayout does not run."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent


def ask(jobs):
    """[(passed, output)] of jobs {"script": PATH, "vars": {NAME: VALUE}}, and what KLayout says where it does not run. A
    warning fails the shell scripts among them, whose question it is."""
    with tempfile.TemporaryDirectory() as work:
        asked, result = pathlib.Path(work) / "jobs.json", pathlib.Path(work) / "result.json"
        asked.write_text(json.dumps(jobs), encoding="utf-8")
        done = subprocess.run(["klayout", "-b", "-r", HERE / "kl_batch.py", "-rd", "jobs=%s" % asked, "-rd", "result=%s" % result],
                              capture_output=True, text=True, check=False,
                              env=dict(os.environ, QT_QPA_PLATFORM="offscreen", LC_ALL="C"))
        if not result.exists():
            return None, done.stdout + done.stderr
        answers = json.loads(result.read_text(encoding="utf-8"))
    loud = [job["script"].endswith(".sh") and re.search("warning|error", answer["output"], re.I)
            for job, answer in zip(jobs, answers)]
    return [(a["status"] == 0 and not noise, a["output"]) for a, noise in zip(answers, loud)], ""


class Open:
    """One KLayout that answers as long as it is asked: run(text of a script, directory, variables)."""

    def __init__(self):
        answers, to = os.pipe()
        self.asked = subprocess.Popen(["klayout", "-b", "-r", HERE / "kl_batch.py", "-rd", "jobs=/dev/stdin", "-rd", "result=/dev/fd/%d" % to],
                                      stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, pass_fds=[to], text=True,
                                      env=dict(os.environ, QT_QPA_PLATFORM="offscreen", LC_ALL="C"))
        os.close(to)
        self.answers = os.fdopen(answers, encoding="utf-8")

    def run(self, text, where, variables):
        self.asked.stdin.write(json.dumps([{"script": "script.py", "text": text, "where": str(where), "vars": variables}]) + "\n")
        self.asked.stdin.flush()
        answer = json.loads(self.answers.readline() or '[{"status": 1, "output": "KLayout has ended"}]')[0]
        assert answer["status"] == 0, answer["output"]

    def close(self):
        self.asked.stdin.close()
        self.answers.close()
        assert self.asked.wait() == 0


def main(jobs, answers):
    rows = [line.split("\t") for line in pathlib.Path(jobs).read_text(encoding="utf-8").splitlines()]
    found, why = ask([{"script": str(HERE / script), "vars": dict(v.split("=", 1) for v in more)} for _, script, *more in rows])
    if found is None:
        print(why)
        return 1
    lines = []
    for (name, *_), (passed, output) in zip(rows, found):
        lines.append("%s  %s" % ("ok  " if passed else "FAIL", name))
        lines += [] if passed else ["      " + line for line in output.splitlines()[-20:]]
    pathlib.Path(answers).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 0 if rows else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
