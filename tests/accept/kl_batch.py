# SPDX-License-Identifier: GPL-3.0-or-later
# kl_batch.py: klayout -b -r kl_batch.py -rd jobs=JOBS.json -rd result=RESULT.json
# Runs many of the kl_*.py checks in one KLayout, whose start takes longer than most of them. JOBS: a list of
# {"script": FILE, "vars": {NAME: VALUE}}; of a shell script the Python between <<'PY' and PY is taken. Each runs as it would
# alone: with the variables of -rd, its own `pya`, in which leaving the application only ends the script.
# RESULT: a list of {"status": N, "output": TEXT}; the output holds KLayout's own warnings too.
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


def _code(path, known={}):
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
        exec(_code(job["script"]), dict(job["vars"], __name__="__main__"))
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


_results = []
with open(jobs, encoding="utf-8") as _file:
    _list = _json.load(_file)
for _job in _list:
    with _tempfile.TemporaryFile() as _out:
        _status = _run(_job, _out)
        _out.seek(0)
        _results.append({"status": _status, "output": _out.read().decode("utf-8", "replace")})
with open(result, "w", encoding="utf-8") as _file:
    _json.dump(_results, _file)
_pya.Application.instance().exit(0)
