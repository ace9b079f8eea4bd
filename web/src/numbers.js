// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers that the page shows of an answer, each with the words it goes by, so that two answers can be set beside
// each other.
import { degrees, number, percent, si } from "./format.js";
import { FIRST_LOOK, probesOf, requirementsOf } from "./purpose.js";

const of = (unit) => (x) => si(x, unit);
const plain = (x) => number(x, 3);
const where = (x, flows) => [x.scene ?? "at rest", flows > 1 ? x.flow : null].filter(Boolean).join(", ");

/** Rows of one group: [label, value in SI, format]; what is null or no number is left out. */
const GROUPS = [
    ["Parameters", (p) => (p.parameters ?? []).map((x) => [x.name, x.unit ? x.value : x.value_SI, (v) => `${number(v, 6)}${x.unit ? ` ${x.unit}` : ""}`])],
    ["Share of the limit", (p, made) => {
        const drawn = (p.verdict?.hinges ?? []).map((x) => [`hinge ${x.id}, as drawn`, x.utilisation, percent]);
        return [...drawn, ...(made?.hinges ?? []).map((x) => [`hinge ${x.id}, as made`, x.as_fabricated?.utilisation, percent])];
    }],
    ["Hinges", (p) => (p.verdict?.hinges ?? []).flatMap((x) => [
        [`${x.id}, peak`, Math.abs(x.peak_angle_rad), degrees], [`${x.id}, limit`, x.limit_angle_rad, degrees], [`${x.id}, peak strain`, x.peak_strain, percent], [`${x.id}, strain limit`, x.strain_limit, percent],
    ])],
    ["What it is for", (p, made) => {
        const v = made ?? p.verdict;
        const look = !made && p.provisional;
        const flows = v?.flows?.length ?? 1;
        const asked = (r) => `${r.probe} (${r.measure ?? r.kind}, ${where(r, flows)})`;
        const rows = requirementsOf(v, look).filter((row) => row.known && !row.only);
        return [...rows.map((row) => [`${asked(row.r)}, ${row.basis}`, row.value, of(row.r.unit)]),
            ...probesOf(v).filter((x) => x.known).map(({ x }) => [`${x.id} (peak, ${where(x, flows)}), as drawn${look ? `, ${FIRST_LOOK}` : ""}`, x.peak, of(x.unit)])];
    }],
    ["Nearest", (p, made) => {
        const v = made ?? p.verdict;
        return (v?.clearances ?? []).map((x) => [`${where(x, v.flows?.length ?? 1)}`, x.clearance_m, of("m")]);
    }],
    ["Motion", (p) => {
        const most = (list) => Math.max(...(list ?? []).map((x) => Math.abs(x ?? 0)));
        const energy = Object.entries(p.motion?.energy ?? {}).map(([k, list]) => [`${k.replace("_J", "")} energy, most`, most(list), of("J")]);
        return [...energy, ...(p.motion?.tension_N ?? []).map((list, i) => [`cable ${i + 1}, most`, most(list), of("N")])];
    }],
    ["Bodies", (p) => (p.bodies ?? []).filter((b) => !b.fixed).map((b) => [`mass of ${b.id}`, Number.isFinite(b.mass_kg) ? b.mass_kg * 1e3 : null, of("g")])],
    ["Effects, bounds", (p) => (p.ledger ?? []).filter((e) => e.called_for !== false).map((e) => [e.id, e.bound, (x) => percent(x, 2)])],
    ["Cost of the answer", (p) => {
        const s = p.motion?.stats ?? {};
        return [["steps", s.steps, plain], ["evaluations", s.rhs, plain], ["energy balance", s.energy_error, plain], ["constraints", s.max_constraint_norm, plain]];
    }],
];

/** [{group, label, value, format}]; p: a preview, made: the full judgement of the same, or null. */
export const numbersOf = (p, made) => GROUPS.flatMap(([group, rows]) => rows(p, made).filter(([, v]) => typeof v === "number" && Number.isFinite(v)).map(([label, value, format]) => ({ group, label, value, format })));

const SAME = 1e-9; // relative: a last digit is no difference

/** Both beside each other: [{group, label, now, then, format, same}]; what only one has is undefined in the other. */
export function beside(now, then) {
    const key = (x) => `${x.group}: ${x.label}`;
    const old = new Map(then.map((x) => [key(x), x]));
    const rows = now.map((x) => ({ ...x, now: x.value, then: old.get(key(x))?.value }));
    const known = new Set(now.map(key));
    for (const x of then) if (!known.has(key(x))) rows.push({ ...x, now: undefined, then: x.value });
    for (const r of rows) r.same = r.now === r.then || Math.abs(r.now - r.then) <= SAME * Math.max(Math.abs(r.now), Math.abs(r.then));
    return rows;
}

/** A difference with its sign, in the unit of the number; shares in points of a percent. */
export function change(row) {
    if (row.now === undefined) return "gone";
    if (row.then === undefined) return "new";
    if (row.same) return "=";
    const text = row.format(Math.abs(row.now - row.then));
    return `${row.now > row.then ? "+" : "\u2212"}${row.format === percent ? text.replace(" %", " points") : text}`;
}
