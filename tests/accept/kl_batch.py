# SPDX-License-Identifier: GPL-3.0-or-later
# kl_batch.py: klayout -b -r kl_batch.py -rd jobs=JOBS.json -rd result=RESULT.json
# Runs many of the kl_*.py checks in one KLayout, whose start takes longer than most of them. JOBS: in each line a list of
# {"script": FILE, "vars": {NAME: VALUE}}; "text", if there is one, is run in place of what stands in the file, and "where" is the
# directory to run in. Of a shell script the Python between <<'PY' and PY is taken. Each runs as it would alone: with the
# variables of -rd, its own `pya`, in which leaving the application only ends the script.
# RESULT: for each line one with a list of {"status": N, "output": TEXT}; the output holds KLayout's own warnings too.
# Both may be pipes: KLayout stays until that of the jobs is closed (kl_asked.Open).
import json as _json, os as _os, sys as _sys, tempfile as _tempfile, traceback as _traceback, types as _types
import pya as _pya


class _Left(BaseException):
    pass


class _Application:
    @staticmethod
    def instance():
        return _Application

    @staticmethod
    def exit(status):
        raise _Left(status)


_module = _types.ModuleType("pya")
_module.__dict__.update({k: v for k, v in _pya.__dict__.items() if not k.startswith("__")})
_module.Application = _Application


def _code(path, text=None, known={}):
    if text is not None:
        return compile(text, path, "exec")
    if path not in known:
        with open(path, encoding="utf-8") as file:
            text = file.read()
        if path.endswith(".sh"):
            text = text.split("<<'PY'\n", 1)[1].split("\nPY\n", 1)[0]
        known[path] = compile(text, path, "exec")
    return known[path]


def _run(job, out):
    """status of a job; what it and KLayout write goes to the file `out`"""
    _sys.stdout.flush()
    _sys.stderr.flush()
    kept = _os.dup(1), _os.dup(2)
    _os.dup2(out.fileno(), 1)
    _os.dup2(out.fileno(), 2)
    _sys.modules["pya"] = _module
    status = 0
    try:
        if "where" in job:
            _os.chdir(job["where"])
        exec(_code(job["script"], job.get("text")), dict(job["vars"], __name__="__main__"))
    except _Left as left:
        status = left.args[0]
    except BaseException:
        print(_traceback.format_exc())
        status = 1
    _sys.modules["pya"] = _pya
    _sys.stdout.flush()
    _sys.stderr.flush()
    for fd, old in zip((1, 2), kept):
        _os.dup2(old, fd)
        _os.close(old)
    return status


with open(jobs, encoding="utf-8") as _asked, open(result, "w", encoding="utf-8") as _answers:
    for _line in _asked:
        _results = []
        for _job in _json.loads(_line):
            with _tempfile.TemporaryFile() as _out:
                _status = _run(_job, _out)
                _out.seek(0)
                _results.append({"status": _status, "output": _out.read().decode("utf-8", "replace")})
        print(_json.dumps(_results), file=_answers, flush=True)
_pya.Application.instance().exit(0)
