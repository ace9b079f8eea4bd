// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn by hand, as changes that /api/edit takes: elements with their places in the frames of their bodies.
import { far, from } from "./places.js";
import { walk } from "./model.js";

const um = (v) => `${Number(v.toFixed(3)) + 0} um`;
const deg = (rad) => `${Number(((rad * 180) / Math.PI).toFixed(3)) + 0} deg`;

/** An id that is free among all of the description. */
function free(places, word, first = 1) {
    const taken = new Set([...walk(places.root)].map((e) => e.id));
    for (let i = first; ; i++) if (!taken.has(`${word}${i}`)) return `${word}${i}`;
}

/** Hinges are letters, as in drawings of mechanisms; after Z they are numbered. */
function freeLetter(places) {
    const taken = new Set([...walk(places.root)].map((e) => e.id));
    for (let i = 0; i < 26; i++) if (!taken.has(String.fromCharCode(65 + i))) return String.fromCharCode(65 + i);
    return free(places, "H");
}

const mechanism = (places) => (places.mechanism ? [] : [{ add: places.root.path, element: "mechanism", attributes: {} }]);

/** Where elements of the scene go: that which is looked at, or a new one. */
function scene(places, name) {
    const e = places.scene(name);
    if (e) return [[], e.path];
    const id = free(places, "scene-");
    return [[{ add: places.root.path, element: "scene", attributes: { name: id, duration: "20 ms" } }], `${places.root.path}/scene[${id}]`];
}

/** Of a body, in its frame; ground: the world. */
const local = (places, body, p) => from(places.frame(body), p);
/** Attributes of a point: those that are 0 are left out where that is the default. */
const point = (names, p) => Object.fromEntries(names.map((n, i) => [n, um(p[i])]));

/** A shape of a body that is there, or of a new one with its origin at `at`. shape: (point in the body's frame) -> attributes */
function inBody(places, body, at, word, element, attributes) {
    const there = places.bodies.get(body);
    if (there?.name === "body") return { id: body, changes: [{ add: there.path, element, attributes: attributes((p) => local(places, body, p)) }] };
    const id = free(places, `${word}-`);
    const path = `${places.root.path}/mechanism`;
    return {
        id,
        changes: [...mechanism(places), { add: path, element: "body", attributes: { id, ...point(["x", "y"], at) } },
            { add: `${path}/body[${id}]`, element, attributes: attributes((p) => [p[0] - at[0], p[1] - at[1]]) }],
    };
}

/** A bar from p to q. */
export const makeBar = (places, { p, q, width, body, round }) => inBody(places, body, p, "link", "bar", (at) => ({
    ...point(["x", "y"], at(p)), ...point(["to-x", "to-y"], at(q)), width: um(width), ...(round ? { ends: "round" } : {}),
}));

/** A rectangle with corners p and q. */
export const makePlate = (places, { p, q, body, hole }) => {
    const middle = [0, 1].map((k) => (p[k] + q[k]) / 2);
    const made = inBody(places, body, middle, "plate", "plate", (at) => ({
        ...point(["x", "y"], at(middle)), width: um(Math.abs(q[0] - p[0])), height: um(Math.abs(q[1] - p[1])), ...(hole ? { hole: "yes" } : {}),
    }));
    return made;
};

/** A disc about p through q. */
export const makeDisc = (places, { p, q, body, hole }) => inBody(places, body, p, "disc", "disc", (at) => ({
    ...point(["x", "y"], at(p)), radius: um(far(p, q)), ...(hole ? { hole: "yes" } : {}),
}));

/** A closed line through points, of lines. */
export function makeOutline(places, { points: list, body, hole }) {
    const name = free(places, "outline-");
    const made = inBody(places, body, list[0], "part", "outline", (at) => ({ id: name, ...point(["start-x", "start-y"], at(list[0])), ...(hole ? { hole: "yes" } : {}) }));
    const there = places.bodies.get(body)?.name === "body";
    const at = there ? (p) => local(places, body, p) : (p) => [p[0] - list[0][0], p[1] - list[0][1]];
    const path = `${made.changes.at(-1).add}/outline[${name}]`;
    return { id: made.id, changes: [...made.changes, ...[...list.slice(1), list[0]].map((p) => ({ add: path, element: "line", attributes: point(["to-x", "to-y"], at(p)) }))] };
}

/** A hinge at `at` of two bodies; the flexure is one that is there with the same sizes, or a new one. */
export function makeHinge(places, { at, a, b, flexure, kind, sizes, axis }) {
    const changes = [];
    let id = flexure;
    if (!id) {
        const wanted = { kind, ...sizes };
        const alike = places.root.children.find((e) => e.name === "flexure" && e.id && e.attributes.size === Object.keys(wanted).length + 1 && Object.entries(wanted).every(([k, v]) => e.attributes.get(k)?.value === v));
        id = alike?.id ?? free(places, kind === "leaf" ? "leaf-" : "arc-");
        if (!alike) changes.push({ add: places.root.path, element: "flexure", attributes: { id, ...wanted } });
    }
    const name = freeLetter(places);
    const [pa, pb] = [local(places, a, at), local(places, b, at)];
    changes.push(...mechanism(places), { add: `${places.root.path}/mechanism`, element: "revolute", attributes: {
        id: name, a, ...point(["a-x", "a-y"], pa), b, ...point(["b-x", "b-y"], pb), hinge: id, ...(axis === null ? {} : { axis: deg(axis) }),
    } });
    return { id: name, changes };
}

/** A force at p of a body, towards q; size in uN. */
export function makeForce(places, { p, q, body, size, scene: name }) {
    const [before, path] = scene(places, name);
    const phi = Math.atan2(q[1] - p[1], q[0] - p[0]);
    const uN = (v) => `${Number(v.toPrecision(6)) + 0} uN`;
    const part = (v) => (Math.abs(v) < 1e-9 ? 0 : v);
    return { id: null, changes: [...before, { add: path, element: "force", attributes: { on: body, ...point(["x", "y"], local(places, body, p)), fx: uN(size * part(Math.cos(phi))), fy: uN(size * part(Math.sin(phi))) } }] };
}

/** A cable through points of bodies, pulled behind the last; size in uN. */
export function makeCable(places, { points: list, size, scene: name }) {
    const [before, path] = scene(places, name);
    const id = free(places, "cable-");
    return {
        id,
        changes: [...before, { add: path, element: "tendon", attributes: { id, pull: `${size} uN`, law: "ramp", rise: "10 ms" } },
            ...list.map(({ at, body }) => ({ add: `${path}/tendon[${id}]`, element: "eyelet", attributes: { on: body, ...point(["x", "y"], local(places, body, at)) } }))],
    };
}

/** A comb at p of a body, which is pulled towards q. */
export function makeComb(places, { p, q, body, fingers, gap, overlap, length, voltage, scene: name }) {
    const [before, path] = scene(places, name);
    const id = free(places, "comb-");
    return {
        id,
        changes: [...before, { add: path, element: "comb-drive", attributes: {
            id, kind: "comb", on: body, ...point(["x", "y"], local(places, body, p)), direction: deg(Math.atan2(q[1] - p[1], q[0] - p[0])),
            fingers: String(fingers), gap: um(gap), overlap: um(overlap), length: um(length), voltage: `${voltage} V`,
        } }],
    };
}

/** A required workspace of a six-bar, about the platform as drawn. */
export function makeWorkspace(places, { p, q }) {
    const middle = places.frame("CD").slice(4);
    const range = (k) => [Math.min(p[k], q[k]) - middle[k], Math.max(p[k], q[k]) - middle[k]].map(um);
    const [x, y] = [range(0), range(1)];
    return { id: null, changes: [{ add: places.root.path, element: "workspace", attributes: { "x-min": x[0], "x-max": x[1], "y-min": y[0], "y-max": y[1], "phi-min": "0 deg", "phi-max": "0 deg" } }] };
}

// ---- taking away ----

/** Attributes that name such an element. */
const BODY = ["on", "a", "b", "body", "against"];
const JOINT = ["joint", "of", "on"];
const REFERRED = { body: BODY, revolute: JOINT, prismatic: JOINT, distance: JOINT, weld: JOINT, spring: ["of"], driver: ["of"], tendon: ["of"], "comb-drive": ["of"], contact: ["of"], probe: ["probe"] };

/** An element and all that would mean nothing without it: {count, changes}, the last of the file first, so that numbers in
 *  paths hold. */
export function removing(places, element) {
    const all = [...walk(places.root)];
    const parent = new Map(all.flatMap((e) => e.children.map((c) => [c, e])));
    const out = new Set();
    const take = (e) => {
        if (out.has(e)) return;
        out.add(e);
        e.children.forEach(take);
        const cable = e.name === "eyelet" ? parent.get(e) : null; // which has two eyelets at least
        if (cable && cable.children.filter((c) => !out.has(c)).length < 2) take(cable);
        const names = REFERRED[e.name];
        if (!names || !e.id || all.some((o) => o.name === e.name && o.id === e.id && !out.has(o))) return; // another scene has one, too
        for (const o of all) if (names.some((a) => o.attributes.get(a)?.value === e.id)) take(o);
    };
    take(element);
    const tops = [...out].filter((e) => !out.has(parent.get(e)));
    return { count: tops.length, changes: tops.sort((a, b) => b.from - a.from).map((e) => ({ remove: e.path })) };
}
