// SPDX-License-Identifier: GPL-3.0-or-later
// What of a motion can be plotted over its time beside angles and energy: probes and how fast they change, where its points
// are and how fast, how bodies turn, the gap of the joints. Values are the program's; a point of a body goes with that body.
import { moved } from "./outline.js";

/** Names of the points that are followed: centres of mass, and where loads act: [{name, body, at (um, in its axes)}] */
export function pointsOf(p) {
    const centres = p.bodies.flatMap((b, body) => (b.fixed ? [] : [{ name: b.id, body, at: [0, 0] }]));
    const loads = (p.loads ?? []).flatMap((x) => (x.eyelets ?? [x]).filter((e) => e.body >= 0 && e.at_um && p.bodies[e.body] && !p.bodies[e.body].fixed)
        .map((e) => ({ name: `${x.id ?? x.kind} on ${p.bodies[e.body].id}`, body: e.body, at: e.at_um })));
    const seen = new Map();
    return [...centres, ...loads].map((x) => {
        const n = (seen.get(x.name) ?? 0) + 1;
        seen.set(x.name, n);
        return n > 1 ? { ...x, name: `${x.name} (${n})` } : x;
    });
}

/** Of a row of poses, where a point is, um. */
export const pointAt = (row, { body, at }) => moved([row[3 * body] * 1e6, row[3 * body + 1] * 1e6, row[3 * body + 2]], at);

const SIDE = ["x", "y"];
export const ENERGIES = [["kinetic", "kinetic_J"], ["potential", "potential_J"], ["dissipated", "dissipated_J"], ["work", "work_J"]];

function ofPoints(p) {
    const m = p.motion;
    const points = pointsOf(p);
    const turning = p.bodies.flatMap((b, body) => (b.fixed ? [] : [{ name: b.id, body }]));
    const rest = p.bodies.flatMap((b) => b.rest ?? [0, 0, 0]);
    const place = (x) => m.q.map((row) => pointAt(row, x).map((v) => v * 1e-6));
    const from = (x) => pointAt(rest, x).map((v) => v * 1e-6);
    const speed = (x) => m.v.map((row, i) => {
        const [px, py] = pointAt(m.q[i], x).map((v, k) => v * 1e-6 - m.q[i][3 * x.body + k]);
        const [vx, vy, w] = row.slice(3 * x.body, 3 * x.body + 3);
        return [vx - w * py, vy + w * px];
    });
    const all = (values) => () => points.map((x) => ({ name: x.name, values: values(x) }));
    const both = (x, values) => () => {
        const at = values(x);
        return SIDE.map((name, k) => ({ name, values: at.map((v) => v[k]) }));
    };
    if (!points.length) return [];
    return [
        { group: "All points", id: ":way", label: "way from rest", unit: "m", curves: all((x) => place(x).map(([a, b]) => Math.hypot(a - from(x)[0], b - from(x)[1]))) },
        { group: "All points", id: ":speed", label: "speed", unit: "m/s", rates: true, curves: all((x) => speed(x).map((v) => Math.hypot(...v))) },
        { group: "Bodies", id: ":turn", label: "rotation", unit: "rad", curves: () => turning.map((x) => ({ name: x.name, values: m.q.map((row) => row[3 * x.body + 2] - rest[3 * x.body + 2]) })) },
        { group: "Bodies", id: ":turning", label: "turning speed", unit: "rad/s", rates: true, curves: () => turning.map((x) => ({ name: x.name, values: m.v.map((row) => row[3 * x.body + 2]) })) },
        ...points.flatMap((x) => [
            { group: "One point", id: `:at ${x.name}`, label: `${x.name}: x and y`, unit: "m", curves: both(x, place) },
            { group: "One point", id: `:v ${x.name}`, label: `${x.name}: velocity`, unit: "m/s", rates: true, curves: both(x, speed) },
        ]),
    ];
}

/**
 * [{group, id (of a probe its own), label, unit, probe, of: the probe that it is about, rates: it needs a motion with velocities, log, curves(): [{name, values
 * in SI}]}]; curves only where motion.v is there, if rates.
 */
export function coursesOf(p) {
    const m = p.motion;
    const probes = m.probes ?? [];
    return [
        ...probes.map((x) => ({ group: "Probes", id: x.id, label: x.id, unit: x.unit, kind: x.kind, probe: x, of: x, curves: () => [{ name: x.id, values: x.value }] })),
        ...probes.filter((x) => ["m", "rad"].includes(x.unit)).map((x) => ({ group: "How fast probes change", id: `:rate ${x.id}`, label: `${x.id}, rate`, unit: `${x.unit}/s`, rates: true, of: x, curves: () => [{ name: `${x.id}, rate`, values: x.rate }] })),
        ...ofPoints(p),
        ...(m.energy ? [{ group: "Energy", id: ":energy", label: "energies", unit: "J", curves: () => ENERGIES.filter(([, k]) => m.energy[k]).map(([name, k]) => ({ name, values: m.energy[k] })) }] : []),
        ...(m.constraint_norm ? [{ group: "Numerics", id: ":gap", label: "gap of the joints", unit: "", log: true, curves: () => [{ name: "norm", values: m.constraint_norm.map((x) => Math.max(x ?? 0, 1e-18)) }] }] : []),
        ...(p.ledger?.some((e) => e.called_for) ? [{ group: "Numerics", id: ":left", label: "what was left out", unit: "" }] : []),
    ];
}
