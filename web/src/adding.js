// SPDX-License-Identifier: GPL-3.0-or-later
// What "Add…" writes: elements with values that the description takes, and the children without which they mean
// nothing. What a row of the table asks for and is not listed here gets the first value that is allowed.
import { walk } from "./model.js";

/** Ids that a reference may name. */
export const idsOf = (root, row, space) => [...new Set([...walk(root)].filter((e) => e.id && row(e.name, null).id_space === space).map((e) => e.id))];

/**
 * Values by element; of several with one name under its parent. c: {ids(space), free(word), has(path of element names),
 * first(element name): attributes of the first one}.
 */
const VALUES = {
    parameter: () => ({ value: "10 um", min: "5 um", max: "20 um" }),
    material: () => ({ ref: "silicon-100", thickness: "50 um" }),
    flow: (c) => ({ ref: ["al-masked-rie", "copper-on-porous-silicon", "silicon-on-glass"].find((x) => !c.taken("flow").includes(x)) ?? "al-masked-rie" }),
    flexure: () => ({ kind: "leaf", length: "300 um", width: "10 um" }),
    "flexure>line": () => ({ length: "200 um" }),
    "flexure>arc": () => ({ radius: "100 um", angle: "90 deg" }),
    workspace: () => ({ "x-min": "-1 um", "x-max": "1 um", "y-min": "-1 um", "y-max": "1 um", "phi-min": "0 deg", "phi-max": "0 deg" }),
    die: () => ({ width: "6 mm", height: "6 mm" }),
    sweep: (c) => {
        const name = c.ids("parameter")[0];
        const p = c.parameter(name);
        return { parameter: name, from: p?.min ?? p?.value, to: p?.max ?? p?.value, steps: "3" };
    },
    body: (c) => ({ x: c.beside, y: "0 mm" }),
    revolute: (c) => two(c),
    spring: (c) => ({ ...two(c), stiffness: "1 N/m" }),
    prismatic: (c) => ({ ...two(c), axis: "0 deg" }),
    distance: (c) => two(c),
    weld: (c) => two(c),
    driver: () => ({ value: "0.01 rad * t / 1 s" }),
    "outline>line": () => ({ "to-x": "100 um", "to-y": "100 um" }),
    "outline>arc": () => ({ "to-x": "100 um", "to-y": "100 um", radius: "200 um", turn: "left" }),
    plate: () => ({ width: "200 um", height: "200 um" }),
    bar: () => ({ "to-x": "200 um", "to-y": "0 um", width: "60 um" }),
    disc: () => ({ radius: "100 um" }),
    lettering: () => ({ text: "A" }),
    scene: () => ({ duration: "10 ms" }),
    force: () => ({ fx: "10 uN" }),
    torque: () => ({ value: "1 uN mm" }),
    gravity: () => ({ gy: "-9.81 m/s^2" }),
    initial: () => ({ omega: "1 rad/s" }),
    tendon: () => ({ stiffness: "10 N/m", draw: "1 um" }),
    "comb-drive": (c) => ({ kind: "comb", direction: "0 deg", gap: "8 um", fingers: "10", overlap: "20 um", length: "50 um", voltage: "10 V", on: c.moving[0] }),
    "base-motion": () => ({ ax: "9.81 m/s^2", law: "sine", frequency: "50 Hz" }),
    friction: () => ({ coefficient: "0.1", radius: "20 um" }),
    contact: (c) => ({ a: c.moving[0], b: "ground", side: "outside", distance: "1 um", stiffness: "20 N/m" }),
    "material-damping": () => ({ "loss-factor": "0.001" }),
    temperature: () => ({ change: "10 K" }),
    "residual-stress": () => ({ mean: "10 MPa" }),
    air: () => ({ kind: "slide", gap: "20 um" }),
    probe: (c) => ({ kind: "displacement", on: c.moving.at(-1), direction: "0 deg" }),
    require: (c) => ({ probe: c.ids("probe")[0] ?? "", measure: "peak", max: c.bound(c.ids("probe")[0]) }),
    eyelet: () => ({ x: "0 mm", y: "0 mm" }),
    study: () => ({ kind: "sweep" }),
    vary: (c) => varied(c),
    uncertain: (c) => ({ what: varied(c).what, spread: "interval", from: varied(c).from, to: varied(c).to }),
    respond: () => ({ value: "governing.utilisation" }),
};

/** Children that must be there: [element, attributes]. */
const CHILDREN = {
    tendon: (c) => [["eyelet", { on: c.moving[0] }], ["eyelet", { on: "ground", x: "2 mm", y: "2 mm" }]],
    outline: () => [["line", { "to-x": "200 um", "to-y": "0 um" }], ["line", { "to-x": "200 um", "to-y": "200 um" }], ["line", { "to-x": "0 um", "to-y": "200 um" }], ["line", { "to-x": "0 um", "to-y": "0 um" }]],
    body: () => [["plate", {}]],
    study: (c) => [["vary", varied(c)], ["respond", { name: "used", value: "governing.utilisation" }]],
};

/** The range of the first parameter, or of what every description has. */
function varied(c) {
    const name = c.ids("parameter")[0];
    const p = name && c.parameter(name);
    return p?.min && p?.max ? { what: name, from: p.min, to: p.max } : { what: "limits/@safety-factor", from: "1", to: "2" };
}

function two(c) {
    const [a, b] = [c.moving.at(-1), c.moving.at(-2)];
    return { a: "ground", b: a ?? b };
}

/** First that a row allows, where nothing is listed. */
function plain(a, c) {
    if (a.choices?.length) return a.choices[0];
    if (a.refers_to) return (a.refers_to === "body" ? c.moving[0] : c.ids(a.refers_to)[0]) ?? "";
    if (a.type === "number") {
        const value = a.minimum > 0 || a.above_minimum ? Math.max(a.minimum, 1) : 0;
        return `${value}${a.unit && a.unit !== "1" ? ` ${a.unit}` : ""}`;
    }
    return "";
}

// What a probe's limit is written in, and a size that is usual where no motion tells one: unit, in SI, usual.
const LENGTH = ["um", 1e-6, 10];
const WRITTEN = { displacement: LENGTH, distance: LENGTH, opening: LENGTH, gap: LENGTH, velocity: ["mm/s", 1e-3, 10], angle: ["deg", Math.PI / 180, 1], force: ["uN", 1e-6, 10],
    torque: ["N m", 1, 1e-6], power: ["W", 1, 1e-6], capacitance: ["F", 1, 1e-12], stiffness: ["N/m", 1, 1], compliance: ["m/N", 1, 1], frequency: ["Hz", 1, 1000] };

/** A limit of a probe that is of its own size: what it has at its peak, and half as much again; SI peak or NaN. */
function boundOf(kind, peak) {
    const [unit, size, usual] = WRITTEN[kind] ?? LENGTH;
    return `${peak > 0 && Number.isFinite(peak) ? Number((1.5 * peak / size).toPrecision(2)) : usual} ${unit}`;
}

/** Changes for /api/edit that add such an element to `parent` (a path); row(name, parent name): of the table; probes: what a verdict says of them. */
export function adding(root, parent, kind, row, probes = []) {
    const all = [...walk(root)];
    const ids = (space) => idsOf(root, row, space);
    const bodies = ids("body");
    const c = {
        ids, moving: bodies.filter((x) => x !== "ground"), beside: "3 mm",
        taken: (name) => all.filter((e) => e.name === name).map((e) => e.id ?? e.attributes.get("ref")?.value),
        bound: (id) => boundOf(all.find((e) => e.name === "probe" && e.id === id)?.attributes.get("kind")?.value, Math.max(...probes.filter((x) => x.id === id).map((x) => Math.abs(x.peak)))),
        parameter: (id) => {
            const e = all.find((x) => x.name === "parameter" && x.id === id);
            return e && Object.fromEntries([...e.attributes].map(([k, v]) => [k, v.value]));
        },
    };
    const known = new Set(kind.attributes.map((a) => a.name));
    const given = (VALUES[`${parent.name}>${kind.name}`] ?? VALUES[kind.name] ?? (() => ({})))(c);
    const attributes = {};
    for (const a of kind.attributes) {
        if (a.name === kind.key && (a.type === "id" || a.type === "name") && given[a.name] === undefined) attributes[a.name] = freeId(all, kind, a.type === "id" ? "-" : "_");
        else if (a.name === kind.key && a.choices) attributes[a.name] = a.choices.find((x) => !c.taken(kind.name).includes(x)) ?? a.choices[0];
        else if (given[a.name] !== undefined) attributes[a.name] = given[a.name];
        else if (a.required) attributes[a.name] = plain(a, c);
    }
    if (kind.key && !known.has(kind.key)) delete attributes[kind.key];
    const changes = [{ add: parent.path, element: kind.name, attributes }];
    const same = parent.children.filter((x) => x.name === kind.name).length;
    const path = `${parent.path}/${kind.name}[${kind.key && attributes[kind.key] && !/^\d+$/.test(attributes[kind.key]) ? attributes[kind.key] : same + 1}]`;
    for (const [name, values] of (CHILDREN[kind.name]?.(c) ?? [])) {
        const own = VALUES[`${kind.name}>${name}`] ?? VALUES[name];
        changes.push({ add: path, element: name, attributes: { ...own?.(c), ...values } });
    }
    return changes;
}

function freeId(all, kind, sign) {
    const taken = new Set(all.map((e) => e.id));
    for (let i = 1; ; i++) if (!taken.has(`${kind.name}${sign}${i}`)) return `${kind.name}${sign}${i}`;
}

/** What may not be added to this parent now, because it would be wrong there: by element. */
const NOT_NOW = {
    line: (parent) => parent.name === "outline" || parent.attributes.get("kind")?.value !== "path", // an outline is closed as it is
    arc: (parent) => parent.name === "outline" || parent.attributes.get("kind")?.value !== "path",
    workspace: (parent) => !parent.children.some((e) => e.name === "six-bar"),
    "six-bar": (parent) => parent.children.some((e) => e.name === "mechanism"),
};

/** May an element of this row be added to this parent? It is there once already, all its names are taken, what it refers
 *  to does not exist, or it makes no sense there. */
export function mayAdd(root, parent, kind, row) {
    const same = parent.children.filter((e) => e.name === kind.name);
    const key = kind.attributes.find((a) => a.name === kind.key);
    if (kind.once && same.length && !key?.choices) return false;
    if (key?.choices && key.choices.every((x) => same.some((e) => e.id === x))) return false;
    if (NOT_NOW[kind.name]?.(parent)) return false;
    const refers = kind.attributes.filter((a) => a.refers_to && (a.required || a.name === "probe"));
    return refers.every((a) => idsOf(root, row, a.refers_to).length > 0);
}
