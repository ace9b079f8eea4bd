// SPDX-License-Identifier: GPL-3.0-or-later
// Two texts beside each other, line by line: what stands in one only, with some lines around it.
import { h } from "./dom.js";

const AROUND = 2; // lines that are the same, before and behind what differs
const MOST_CELLS = 4e6; // of the table below; beyond it the middle counts as different as a whole

/** Rows [line of a or null, line of b or null, same] of two lists of lines: a longest common subsequence. */
export function rowsOf(a, b) {
    let from = 0;
    while (from < a.length && from < b.length && a[from] === b[from]) from++;
    let end = 0;
    while (end < a.length - from && end < b.length - from && a.at(-1 - end) === b.at(-1 - end)) end++;
    const [x, y] = [a.slice(from, a.length - end), b.slice(from, b.length - end)];
    const same = (list) => list.map((line) => [line, line, true]);
    return [...same(a.slice(0, from)), ...middle(x, y), ...same(a.slice(a.length - end))];
}

function middle(x, y) {
    const [n, m] = [x.length, y.length];
    if (n * m > MOST_CELLS) return [...x.map((l) => [l, null, false]), ...y.map((l) => [null, l, false])];
    const longest = Array.from({ length: n + 1 }, () => new Uint32Array(m + 1));
    for (let i = n - 1; i >= 0; i--)
        for (let j = m - 1; j >= 0; j--) longest[i][j] = x[i] === y[j] ? longest[i + 1][j + 1] + 1 : Math.max(longest[i + 1][j], longest[i][j + 1]);
    const rows = [];
    let [i, j] = [0, 0];
    while (i < n || j < m) {
        if (i < n && j < m && x[i] === y[j]) rows.push([x[i++], y[j++], true]);
        else if (j === m || (i < n && longest[i + 1][j] >= longest[i][j + 1])) rows.push([x[i++], null, false]);
        else rows.push([null, y[j++], false]);
    }
    return rows;
}

/** A table of both sides, what is the same left out where there is much of it. */
export function bothSides([nameA, textA], [nameB, textB]) {
    const rows = rowsOf(textA.split("\n"), textB.split("\n"));
    const near = rows.map((_, i) => rows.slice(Math.max(0, i - AROUND), i + AROUND + 1).some((r) => !r[2]));
    const body = [];
    let hidden = 0;
    const gap = () => hidden && body.push(h("tr", { class: "diff-gap" }, h("td", { colSpan: 2 }, `${hidden} ${hidden === 1 ? "line" : "lines"} the same`)));
    rows.forEach(([a, b, same], i) => {
        if (!near[i]) return hidden++;
        gap();
        hidden = 0;
        const cell = (line, kind) => h("td", { class: same ? "" : line === null ? "diff-none" : kind }, line ?? "");
        body.push(h("tr", {}, cell(a, "diff-mine"), cell(b, "diff-theirs")));
    });
    gap();
    return h("div", { class: "diff scroll", tabIndex: 0, role: "region", "aria-label": "Both texts" },
        h("table", {}, h("thead", {}, h("tr", {}, h("th", { scope: "col" }, nameA), h("th", { scope: "col" }, nameB))), h("tbody", {}, body)));
}
