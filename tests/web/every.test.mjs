// SPDX-License-Identifier: GPL-3.0-or-later
// Every test of the page in one Chromium: a browser and a node for each file would cost some two seconds of processor each.
// A test file of this directory that no line here names makes this one fail.
import assert from "node:assert/strict";
import { readdirSync } from "node:fs";
import { test } from "node:test";

// Those of one row stand together in one turn of ./test (tests/turn.py): FW_TURN is its number, without it, or "all", all are run. Each row
// takes about as long as any other.
const turns = [
    ["cards"],
    ["true"],
    ["drive", "marked"],
    ["laboratory", "attached"],
    ["draw", "probes"],
    ["page"],
    ["explore", "telling", "touch", "file"],
    ["compare", "write", "looks"],
];
const files = turns.flat();
const turn = process.env.FW_TURN ?? "all";
test("every file of tests is here", () => {
    const there = readdirSync(import.meta.dirname ?? new URL(".", import.meta.url).pathname).filter((name) => name.endsWith(".test.mjs") && name !== "every.test.mjs");
    assert.deepEqual([...files].map((name) => `${name}.test.mjs`).sort(), there.sort());
});
for (const name of turn === "all" ? files : turns[Number(turn)]) await import(`./${name}.test.mjs`);
