#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""abi.py FORMER.h HEADER.h: what a program compiled with the former header relies on is in the present
one: every function as it was declared, every number of an enum, every field of a struct at its offset."""
import pathlib
import re
import subprocess
import sys
import tempfile


def without_comments(text):
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def declarations(text):
    return {re.search(r"(\w+)\(", d).group(1): " ".join(d.split())
            for d in re.findall(r"^FW_API ([^;{]*\([^;{]*\));", text, flags=re.M)}


def constants(text):
    return [name for body in re.findall(r"enum \{(.*?)\};", text, flags=re.S)
            for name in re.findall(r"(\w+) =", body)]


def fields(text):
    for body, name in re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", text, flags=re.S):
        for line in body.split(";"):
            for part in line.split(","):
                field = re.sub(r"\[.*|.*[\s*]", "", part.strip())
                if field:
                    yield name, field


def layout(header, names, members):
    """What a compiler says of them."""
    lines = [f'printf("{n} %lld\\n", (long long){n});' for n in names]
    lines += [f'printf("{s}.{f} %zu %zu\\n", offsetof({s}, {f}), sizeof((({s} *)0)->{f}));'
              for s, f in members]
    with tempfile.TemporaryDirectory() as directory:
        source = pathlib.Path(directory, "layout.c")
        source.write_text(f'#include "{header}"\n#include <stdio.h>\n'
                          "int main(void) {" + "".join(lines) + " return 0; }\n")
        program = str(source.with_suffix(""))
        subprocess.run(["cc", "-std=c17", "-Wl,--unresolved-symbols=ignore-all", str(source), "-o",
                        program], check=True)
        return subprocess.run([program], capture_output=True, text=True, check=True).stdout


def main():
    former, present = (pathlib.Path(p).resolve() for p in sys.argv[1:])
    text, now = without_comments(former.read_text()), without_comments(present.read_text())
    wrong = [f"{name}: was {declared}" for name, declared in declarations(text).items()
             if declarations(now).get(name) != declared]
    names, members = constants(text), list(fields(text))
    assert len(names) > 50 and len(members) > 30 and len(declarations(text)) > 20
    before, after = (layout(h, names, members).splitlines() for h in (former, present))
    wrong += [f"{a}, now {b}" for a, b in zip(before, after) if a != b]
    for line in wrong:
        print(line)
    print(f"{len(declarations(text))} functions, {len(names)} numbers, {len(members)} fields of the "
          f"former header, {len(wrong)} changed")
    return 1 if wrong else 0


sys.exit(main())
