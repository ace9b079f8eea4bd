// SPDX-License-Identifier: GPL-3.0-or-later
// Values between judged devices, told and not judged: polynomials through the judged ones nearby, each with what it may be off by. A judged
// device that is left out is missed by so much; a told value is off by three times the most that those it rests on are missed by and half of the
// range's are, and never by less than some share of the picture's height. Nothing is told across a place where verdicts come about another way
// (the `way` of an answer: what governs, what acts, how closely it was looked at), nor where it would be off by more than can hardly be seen:
// such a place is to be judged. docs/theory/chance.md says why; tests/web/telling.test.mjs holds told values against judged ones.

export const FIELDS = ["value", "low", "high", "used"]; // the last one: what decides
export const SHOWN = FIELDS.slice(0, 3);
const AROUND = 6; // judged devices that a told one rests on
const LEAST = 5; // in a row that are alike, to tell anything
const MARGIN = 3;
const FLOOR = 1 / 2000; // of the height that is shown
const SEEN = 1 / 250; // of it: what would be off by more is judged
const CLOSE = 1 / 100; // of a limit: what is accepted and uses as much as that is judged
const CUTS = 3; // a row is cut in two, its parts again, so often: at edges that its verdicts say nothing of
const BENT = [3, 4, 5]; // devices that the end of a row is foretold from

/** Shares that the values of a list have in that at x: of the polynomial through them all. */
const sharesOf = (list, x) => list.map((a) => list.reduce((w, b) => (b === a ? w : (w * (x - b.x)) / (a.x - b.x)), 1));

const sum = (shares, list, field) => list.reduce((v, p, i) => v + shares[i] * p[field], 0);

/** From and to of `most` in a row of n around k to l. */
function around(n, k, l, most) {
    let [from, to] = [k, l];
    while (to - from + 1 < most && (from > 0 || to + 1 < n)) {
        if (from > 0 && (to + 1 === n || k - from <= to - l)) from--;
        else to++;
    }
    return [from, to];
}

/** How far a judged device is, field by field, from what the others around it say. The end of a row is foretold by few and by more of them:
 *  what is smooth is met by one of these, what has an edge before its end is met by none. */
function missed(row, k, fields) {
    const p = row[k], last = row.length - 1;
    const by = (list) => {
        const shares = sharesOf(list, p.x);
        return fields.map((f) => Math.abs(sum(shares, list, f) - p[f]));
    };
    if (k > 0 && k < last) {
        const [from, to] = around(row.length, k, k, AROUND + 1);
        return by(row.slice(from, to + 1).filter((q) => q !== p));
    }
    const others = k === 0 ? row.slice(1) : row.slice(0, -1).reverse();
    const all = BENT.filter((n) => n <= others.length).map((n) => by(others.slice(0, n)));
    return fields.map((_, i) => Math.min(...all.map((m) => m[i])));
}

/** Likewise of each device of a row, and what is usual in it. */
function missedAll(row) {
    const fields = FIELDS.filter((f) => known(row, f));
    const each = row.map((_, k) => missed(row, k, fields));
    return { fields, each, usual: fields.map((_, i) => middle(each.map((m) => m[i]))) };
}

const middle = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];

/** true, false (none has it) or null (some have). */
const known = (row, field) => {
    const n = row.filter((p) => Number.isFinite(p[field])).length;
    return n === row.length ? true : n ? null : false;
};

const heightOf = (field, height) => (field === "used" ? 1 : height);

/** A row of judged devices that are alike, with what is told between each and the next one may be off by: {row, off, open: how many are too far off}. */
function piece(row, usual, scale, miss = missedAll(row)) {
    const off = row.slice(1).map((_, k) => {
        const [from, to] = around(row.length, k, k + 1, AROUND), some = miss.each.slice(from, to + 1);
        return Object.fromEntries(miss.fields.map((f, i) => [f, MARGIN * (Math.max(...some.map((m) => m[i])) + usual[i]) + FLOOR * heightOf(f, scale.height)]));
    });
    return { row, off, open: off.filter((o, k) => tooFar(o, row[k], scale)).length };
}

/** What lies far beyond the picture may be off by as small a share of itself. */
const tooFar = (off, p, { height, top }) => SHOWN.some((f) => off[f] > SEEN * (Math.abs(p[f]) > top ? Math.abs(p[f]) : height));

/** How far apart what lies left of the place between k and the next one, and what lies right of it, would go on. */
function step(row, k) {
    const left = row.slice(Math.max(0, k - 2), k + 1), right = row.slice(k + 1, k + 4);
    if (left.length < 2 || right.length < 2) return 0;
    const x = (row[k].x + row[k + 1].x) / 2, [a, b] = [sharesOf(left, x), sharesOf(right, x)];
    return Math.max(...SHOWN.filter((f) => known(row, f)).map((f) => Math.abs(sum(a, left, f) - sum(b, right, f))));
}

/** Where a row has an edge that no verdict speaks of it is cut, if more is told so. */
function pieces(row, usual, scale, cuts, miss) {
    if (row.length < LEAST) return [{ row, off: null, open: row.length - 1 }];
    const whole = piece(row, usual, scale, miss);
    if (!whole.open || !cuts) return [whole];
    const steps = row.slice(1).map((_, k) => step(row, k));
    const k = steps.indexOf(Math.max(...steps)) + 1;
    const two = [row.slice(0, k), row.slice(k)].flatMap((part) => pieces(part, usual, scale, cuts - 1));
    return two.reduce((n, p) => n + p.open, 1) < whole.open ? two : [whole];
}

function rowsOf(points) {
    const rows = [];
    for (const p of points) {
        const last = rows.at(-1);
        if (last && p.way && last[0].way === p.way) last.push(p);
        else rows.push([p]);
    }
    return rows.filter((r) => r[0].way && r.length >= LEAST && FIELDS.every((f) => known(r, f) !== null) && known(r, "value"));
}

/** One that is accepted uses no more than its limits, and any other more. */
const decided = (p) => (p.state === "accept" ? p.used + p.off.used <= 1 - CLOSE : p.used - p.off.used >= 1);

function tellAt(row, k, off, x) {
    const [from, to] = around(row.length, k, k + 1, AROUND), list = row.slice(from, to + 1);
    const w = sharesOf(list, x);
    const p = { x, told: true, state: row[k].state, way: row[k].way, off: {} };
    for (const f of FIELDS) {
        p[f] = sum(w, list, f);
        if (off[f] !== undefined) p.off[f] = off[f] + list.reduce((v, q, i) => v + Math.abs(w[i]) * (q.off?.[f] ?? 0), 0);
    }
    return p;
}

/**
 * Between judged devices, sorted by x: {x, state, way, value, low, high, used}, at `places`, sorted, too; height: of what is shown, top: where it
 * ends. {told: [the same with told: true and off: {value, low, high, used}], open: [{from, to, places}], which are to be judged}
 */
export function tell(points, places, height, top = Infinity) {
    const scale = { height, top };
    const alike = new Map(); // a judged device -> its piece and where in it
    for (const row of rowsOf(points)) {
        if (!places.some((x) => x > row[0].x && x < row.at(-1).x)) continue;
        const miss = missedAll(row);
        for (const p of pieces(row, miss.usual, scale, CUTS, miss)) if (p.off) p.row.forEach((q, k) => alike.set(q, { ...p, k }));
    }
    const told = [], open = [];
    let i = 0;
    for (let n = 0; n + 1 < points.length; n++) {
        const [a, b] = [points[n], points[n + 1]], some = [];
        for (; i < places.length && places[i] < b.x; i++) if (places[i] > a.x) some.push(places[i]);
        if (!some.length) continue;
        const one = alike.get(a), off = one && alike.get(b)?.row === one.row && !tooFar(one.off[one.k], a, scale) ? one.off[one.k] : null;
        const list = off ? some.map((x) => tellAt(one.row, one.k, off, x)) : [];
        if (list.length && list.every((p) => decided(p) && !tooFar(p.off, p, scale))) told.push(...list);
        else open.push({ from: a.x, to: b.x, places: some });
    }
    return { told, open };
}

/** Of places that are open those that are judged next: the middle of each, and where it is one alone two in it, since two processors judge. */
export function nextOf(open) {
    const share = open.length > 1 ? [1 / 2] : [1 / 3, 2 / 3];
    return open.flatMap(({ places }) => [...new Set(share.map((s) => places[Math.min(Math.floor(s * places.length), places.length - 1)]))]);
}

/** Likewise of a map, `cells` of which are judged: Map of "i j" -> {x, y, ...}; n: cells of a side. By rows and then by columns, and where
 *  that leaves some untold the other way round. [{i, j, ...}] */
export function tellMap(cells, n, height, top = Infinity) {
    const out = new Map(), all = Array.from({ length: n + 1 }, (_, i) => i);
    for (const name of [(i, j) => `${i} ${j}`, (i, j) => `${j} ${i}`]) {
        const found = new Map(cells);
        for (const turned of [false, true])
            for (const k of all) {
                const at = (i) => (turned ? name(k, i) : name(i, k));
                const points = all.flatMap((i) => (found.has(at(i)) ? [{ ...found.get(at(i)), x: i }] : []));
                const rest = all.filter((i) => !found.has(at(i)));
                if (points.length >= LEAST && rest.length) for (const p of tell(points, rest, height, top).told) found.set(at(p.x), p);
            }
        for (const [key, p] of found) if (p.told && !out.has(key)) out.set(key, p);
        if (cells.size + out.size === all.length ** 2) break;
    }
    return [...out].map(([key, p]) => {
        const [i, j] = key.split(" ").map(Number);
        return { ...p, i, j };
    });
}
