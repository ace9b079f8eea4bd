// SPDX-License-Identifier: GPL-3.0-or-later
// What can be explored of a text, and at which points: inputs with their present values and usual ranges, numbers of the
// verdict that can be looked at, and the order in which points are asked for, coarse ones first.
import { number, prefixOf, splitQuantity } from "./format.js";
import { evaluate, kindOf, sizeOf } from "./quantities.js";
import { state } from "./store.js";

const USUAL = 0.3; // of its value either way, where a range is not stated
const LEFT_OUT = new Set(["parameter", "study", "vary", "uncertain", "trend", "respond", "sweep", "order"]);
const ROUND = 4; // digits of an end that was not stated
export const POINTS = 200; // intervals of a range
export const CELLS = 32; // of each of two
const STRIDES = [40, 8, 4, 2, 1];
export const ALWAYS = 4; // up to this stride all points are asked for, beyond it where the line bends
const FLAT = 1 / 1000; // of the height of what is shown: less cannot be seen
const MAP_STRIDES = [8, 4, 2, 1];

/** Symbols of units, those of micro with each of its signs (U+00B5, U+03BC), too, as the program reads them. */
export const unitSizes = (table) => Object.fromEntries(table.units.flatMap((u, i) => (u[0] === "u" ? ["u", "\u00b5", "\u03bc"].map((sign) => sign + u.slice(1)) : [u]).map((x) => [x, table.unit_factors[i]])));

/** A number in a unit as a text that the program reads back to the same nine digits. */
export const textOf = (x, unit) => `${Number(x.toPrecision(9))}${unit ? ` ${unit}` : ""}`;

/** Options of points, judged "quick", "full" or as "made". */
export function optionsOf(how) {
    const { accuracy, effects, hinge_model } = state.options;
    const given = Object.fromEntries(Object.entries({ effects, hinge_model }).filter(([, v]) => v !== undefined));
    return { ...given, ...(accuracy === undefined ? {} : { accuracy: Number(accuracy) }), detail: how === "quick" ? "quick" : "full", corners: how === "made" ? "auto" : "none" };
}

const rounded = (x) => Number(x.toPrecision(ROUND));

/** {from, to} in the unit of the value. */
function usualRange(value) {
    if (value === 0) return { from: -1, to: 1 };
    const [a, b] = [rounded(value * (1 - USUAL)), rounded(value * (1 + USUAL))];
    return { from: Math.min(a, b), to: Math.max(a, b) };
}

/**
 * Everything of a description that is a number: [{what (as --set takes it), label, group, unit, now (in the unit), from,
 * to, formula}]. root, row: of the form; parameters: of the last answer.
 */
export function inputsOf(root, row, table, parameters = []) {
    const units = unitSizes(table);
    const known = new Map(parameters.map((p) => [p.name, p]));
    const valueOf = (name) => known.get(name)?.value_SI ?? NaN;
    const out = [];
    for (const e of root.children.filter((c) => c.name === "parameter")) {
        const name = e.attributes.get("name")?.value;
        const p = known.get(name);
        if (!name || !p || !Number.isFinite(p.value)) continue;
        const unit = p.unit ?? "";
        const stated = Number.isFinite(p.minimum ?? NaN) && Number.isFinite(p.maximum ?? NaN) && p.maximum > p.minimum;
        out.push({ what: name, label: name, group: "Parameters", unit, now: p.value, ...(stated ? { from: p.minimum, to: p.maximum } : usualRange(p.value)), bounds: stated ? [p.minimum, p.maximum] : null });
    }
    for (const e of inner(root)) {
        const attributes = row(e.name, e.parent).attributes ?? [];
        for (const a of attributes) {
            const text = e.attributes.get(a.name)?.value;
            if (text === undefined || !["number", "expression"].includes(a.type) || a.whole) continue;
            const kind = kindOf(text, units, (n) => known.has(n));
            const si = evaluate(text, units, valueOf);
            if (!Number.isFinite(si)) continue;
            const unit = kind.kind === "number" ? kind.unit : (a.unit ?? "");
            const now = Number((si / (sizeOf(unit, units) ?? 1)).toPrecision(9));
            const path = `${e.path}/@${a.name}`.replace(/^[^/]+\//, "");
            out.push({ what: path, label: path.replaceAll("/@", " ").replaceAll("/", " › "), group: e.name, unit, now, ...usualRange(now), formula: kind.kind === "number" ? null : text });
        }
    }
    return out;
}

function* inner(element) {
    for (const child of element.children) {
        if (LEFT_OUT.has(child.name)) continue;
        child.parent = element.name;
        yield child;
        yield* inner(child);
    }
}

/** An end of a range as somebody types it: in the unit of the input, or NaN. */
export function endOf(text, unit, units) {
    const q = splitQuantity(text);
    if (q && (q.unit === "" || q.unit === unit)) return q.value;
    const written = kindOf(text, units, () => false);
    return written.kind === "number" && written.unit ? evaluate(text, units, () => NaN) / (sizeOf(unit, units) ?? NaN) : NaN;
}

// ---- numbers to look at ----

const SHARE = { unit: "%", factor: 100, limits: [1] };

/**
 * [{id, label, unit, factor (from SI), value, low, high: paths of the documents, also: of a hinge as made, least: the least of all values and not the first that
 *  is known, and none where one of them is not, limits (SI)}] of
 * a verdict; made: as the flows make it.
 */
export function numbersToLookAt(v, made) {
    const out = [{ id: "governing", label: "Share of the limit that governs", ...SHARE, value: ["governing.utilisation"], low: ["governing.utilisation_band[0]"], high: ["governing.utilisation_band[1]"] }];
    for (const x of v?.hinges ?? []) {
        const paths = (key) => [...(made ? [`hinges[${x.id}].as_fabricated.${key}`] : []), `hinges[${x.id}].${key}`];
        if (/[\],]/.test(x.id)) continue; // no path could name it
        out.push({ id: `hinge ${x.id}`, label: `Hinge ${x.id}, share of its limit`, ...SHARE, value: paths("utilisation"), low: paths("utilisation_band[0]"), high: paths("utilisation_band[1]") });
    }
    const seen = new Set();
    for (const r of v?.requirements ?? []) {
        const words = [r.probe, r.scene, r.flow].filter(Boolean).join(",");
        if (seen.has(words) || /[\]]/.test(words)) continue;
        seen.add(words);
        const path = (key) => [...(made ? [`requirements[${words}].as_fabricated.${key}`] : []), `requirements[${words}].${key}`];
        const [prefix, size] = prefixOf(Math.max(...[r.min, r.max, r.value].map((x) => Math.abs(x ?? 0))));
        out.push({ id: `require ${words}`, label: `${r.probe} (${[r.measure ?? r.kind, r.scene].filter(Boolean).join(", ")})`, unit: `${prefix}${r.unit}`, factor: 1 / size, limits: [r.min, r.max].filter((x) => x !== null), value: path("value"), low: path("band[0]"), high: path("band[1]") });
    }
    const frequency = (id, label, value, least = false) => out.push({ id, label, unit: "Hz", factor: 1, limits: [], value, low: [], high: [], least });
    const [inPlane, across] = ["modes:modes[0].f_Hz", "modes:out_of_plane.modes[0].f_Hz"];
    frequency("frequency", "Lowest natural frequency, in or out of the plane, at rest", [inPlane, across], true);
    frequency("frequency-in", "Lowest natural frequency in the plane, at rest", [inPlane]);
    frequency("frequency-out", "Lowest natural frequency out of the plane, of rigid bodies, at rest", [across]);
    return out;
}

// ---- points ----

/** A point of an answer in the unit of the number. */
export function pointOf(p, n) {
    const v = p.values.map((x) => (x === null ? NaN : x * n.factor));
    const first = (list) => list.find(Number.isFinite) ?? NaN;
    const [a, b] = [n.value.length, n.value.length + n.low.length];
    return { state: p.state, way: p.way, why: p.why, used: p.limit_used, value: n.least ? Math.min(...v.slice(0, a)) : first(v.slice(0, a)), low: first(v.slice(a, b)), high: first(v.slice(b, b + n.high.length)) };
}

const BEYOND = 4; // a share so many times its limit is as bad as any other
const ALIKE = 1e-4; // of itself: less is no height

/** What a picture of these points shows, {low, high}, the limits in it; share: from nothing on. */
export function rangeOf(points, limits, share) {
    const all = [...points.filter((p) => Number.isFinite(p.value)).flatMap((p) => [p.value, p.low, p.high]), ...limits].filter(Number.isFinite);
    let [low, high] = all.length ? [Math.min(...all), Math.max(...all)] : [0, 1];
    const top = limits.length ? BEYOND * Math.max(...limits.map(Math.abs)) : Infinity;
    if (high > top && low < top) high = top;
    return { low: share && low >= 0 ? 0 : low, high };
}

/** How high that is, and where it ends: what cannot be seen need not be known closer. */
export function heightOf(points, limits, share) {
    const { low, high } = rangeOf(points, limits, share);
    return { height: Math.max(high - low, ALIKE * Math.max(Math.abs(low), Math.abs(high))), top: high };
}

/** Indices 0..POINTS in the order in which they are asked for, in rounds. */
export function rounds() {
    const done = new Set();
    return STRIDES.map((stride) => {
        const list = [];
        for (let i = 0; i <= POINTS; i += stride) if (!done.has(i)) list.push(i);
        for (const i of list) done.add(i);
        return { stride, list };
    });
}

/** Of the values v of a round those without which the line would be another one. A point lies off the straight line between its
 *  neighbours by some `bend`; the points halfway to them then lie off by a quarter of that. `points`: what is done, sorted by x,
 *  with the round that it came in. A first round of such points, and one where the decision or what is known changes, is asked for whole. */
export function bent(values, points, stride) {
    if (stride >= ALWAYS) return values;
    const known = points.filter((p) => Number.isFinite(p.value));
    const all = known.flatMap((p) => [p.value, p.low, p.high].filter(Number.isFinite));
    const flat = FLAT * (Math.max(...all) - Math.min(...all));
    let i = 0;
    return values.filter((v) => {
        while (i + 1 < points.length && points[i + 1].x <= v) i++;
        const [a, b] = [points[i], points[i + 1]];
        if (!b || a.state !== b.state || !Number.isFinite(a.value) || !Number.isFinite(b.value)) return true;
        const last = a.round > b.round ? a : b;
        return !(last.bend / 4 <= flat);
    });
}

/** How far point k of points that are sorted by x lies off the straight line between its neighbours, the ends of its band likewise. */
export function bendOf(points, k) {
    const [a, p, b] = [points[k - 1], points[k], points[k + 1]];
    if (!a || !b) return Infinity;
    const off = ["value", "low", "high"].map((key) => p[key] - (a[key] + ((b[key] - a[key]) * (p.x - a.x)) / (b.x - a.x))).filter(Number.isFinite);
    return off.length ? Math.max(...off.map(Math.abs)) : Infinity;
}

/** Likewise of a map: pairs of indices 0..CELLS. */
export function mapRounds() {
    const done = new Set();
    return MAP_STRIDES.map((stride) => {
        const list = [];
        for (let j = 0; j <= CELLS; j += stride) for (let i = 0; i <= CELLS; i += stride) if (!done.has(`${i} ${j}`)) list.push([i, j]);
        for (const p of list) done.add(p.join(" "));
        return { stride, list };
    });
}

/** Ranges of one decision, between points sorted by x: [{state, from, to}], the ends in the middle between two points, or, where
 *  more points are to come, at the points themselves. */
export function stretches(points, middle = true) {
    const out = [];
    for (const p of points) {
        const last = out.at(-1);
        if (last?.state === p.state) last.to = p.x;
        else {
            if (last && middle) last.to = (last.to + p.x) / 2;
            out.push({ state: p.state, from: last && middle ? last.to : p.x, to: p.x });
        }
    }
    return out;
}

const DIGITS = 4; // of an end of a stretch that is told

/** The same with their ends as they are told. What is accepted ends at its own outermost points, rounded inwards: a value within what is
 *  told was accepted. Whatever lies beside it begins there. */
export function told(list, points) {
    const plain = (v) => number(v, DIGITS);
    const inwards = (v, up) => {
        const step = v === 0 ? 1 : 10 ** (Math.floor(Math.log10(Math.abs(v))) - DIGITS + 1);
        const near = Math.round(v / step) * step;
        return plain(Math.abs(near - v) <= 1e-9 * Math.abs(v) || (up ? near > v : near < v) ? near : near + (up ? step : -step));
    };
    const [first, last] = [points[0]?.x, points.at(-1)?.x];
    const own = list.map((r) => {
        if (r.state !== "accept") return null;
        const inside = points.filter((p) => p.state === "accept" && p.x >= r.from && p.x <= r.to).map((p) => p.x);
        return inside.length ? [inside[0], inside.at(-1)] : [r.from, r.to];
    });
    const end = (v, up) => (v === first || v === last ? plain(v) : inwards(v, up));
    const out = list.map((r, i) => ({
        state: r.state,
        from: own[i] ? end(own[i][0], true) : own[i - 1] ? end(own[i - 1][1], false) : plain(r.from),
        to: own[i] ? end(own[i][1], false) : own[i + 1] ? end(own[i + 1][0], true) : plain(r.to),
    }));
    return out.flatMap((r, i) => {
        const [low, high] = i ? gapBefore(list[i], points) : [0, 0];
        if (!(high - low > OPEN * (last - first))) return [r];
        if (!own[i - 1]) out[i - 1].to = plain(low);
        if (!own[i]) r.from = plain(high);
        return [{ state: "open", from: out[i - 1].to, to: r.from }, r];
    });
}

const OPEN = 0.02; // of the range: where nothing was tried in so much of it, neither side has it

/** The last point of the stretch before this one and the first of its own. */
function gapBefore(r, points) {
    const k = points.findIndex((p, i) => i > 0 && p.state === r.state && points[i - 1].state !== r.state && p.x >= r.from);
    return k < 0 ? [0, 0] : [points[k - 1].x, points[k].x];
}
