#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which files tools/together.py lets be compiled as one: every kind of name that two files may not share keeps them apart, and
what only looks like one does not."""
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import together  # noqa: E402

APART = {
    "functions": ("static int sum(int a) { return a; }", "static double sum(void) { return 1; }"),
    "objects": ("static const double step[] = {1, 2};", "static int step;"),
    "types": ("typedef struct { int a; } row;", "typedef struct row { double b; } row;"),
    "enumerators": ("enum { MOST = 3, LEAST };", "enum kind { OTHER, LEAST = 7 };"),
    "a macro and a word": ("#define N 3\nstatic int one;", "static int two(int N) { return N; }"),
    "a name of a header's": ('#include "theirs.h"', "static int rig_new(void) { return 0; }"),
    "two headers": ('#include "theirs.h"', '#include "others.h"'),
    "a name of the system's": ("static void open(int a) { (void)a; }", "#include <fcntl.h>\nstatic int f(void) { return 0; }"),
    "I of complex.h": ("#include <complex.h>\n", "static int I_am(int I) { return I; }"),
}
TOGETHER = {
    "locals": ("static int f(void) { int sum = 1; return sum; }", "static int g(int sum) { return sum; }"),
    "words in comments and strings": ('static int f(void) { return 0; } // static int g', 'static const char *g = "http://f(";'),
    "parameters": ("static int f(int a, int b);", "static int g(int b, int a);"),
    "the same header": ('#include "theirs.h"\nstatic int f;', '#include "theirs.h"\nstatic int g;'),
    "mains": ("int main(void) { return 0; }", "int main(void) { return 1; }"),
}


class Together(unittest.TestCase):
    def groups(self, *texts):
        with tempfile.TemporaryDirectory() as name:
            place = pathlib.Path(name)
            (place / "theirs.h").write_text("#ifndef THEIRS\n#define THEIRS\ntypedef struct { int a; } rig;\nint rig_new(void);\n#endif\n")
            (place / "others.h").write_text("typedef struct { double a; } rig;\n")
            files = []
            for number, text in enumerate(texts):
                files.append(place / f"{number}.c")
                files[-1].write_text(text + "\n")
            return list(together.grouped(files, 8, []).values())

    def test_what_names_the_same_is_apart(self):
        for name, texts in APART.items():
            self.assertEqual(self.groups(*texts), [0, 1], name)

    def test_what_does_not_is_together(self):
        for name, texts in TOGETHER.items():
            self.assertEqual(self.groups(*texts), [0, 0], name)

    def test_a_group_is_no_larger_than_asked(self):
        self.assertEqual(self.groups(*(f"static int n{i};" for i in range(10))), [0] * 8 + [1] * 2)


if __name__ == "__main__":
    unittest.main()
