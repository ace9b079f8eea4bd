// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn by hand, as changes that /api/edit takes: elements with their places in the frames of their bodies.
import { arcOver, far, from, to } from "./places.js";
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
export const makePlate = (places, { p, q, body, hole, symmetry }) => {
    const middle = [0, 1].map((k) => (p[k] + q[k]) / 2);
    const made = inBody(places, body, middle, "plate", "plate", (at) => ({
        ...point(["x", "y"], at(middle)), width: um(Math.abs(q[0] - p[0])), height: um(Math.abs(q[1] - p[1])), ...(hole ? { hole: "yes" } : {}), ...mirrorWords(symmetry),
    }));
    return made;
};

/** A disc about p through q. */
export const makeDisc = (places, { p, q, body, hole, symmetry }) => inBody(places, body, p, "disc", "disc", (at) => ({
    ...point(["x", "y"], at(p)), radius: um(far(p, q)), ...(hole ? { hole: "yes" } : {}), ...mirrorWords(symmetry),
}));

/** Sides of a closed line through points: {over (of an arc, else null), to}; sides: of each point "arc" or "line", how it
 *  goes on from the one before. An arc takes two points: one that it passes, and its end. */
export function sidesOf(points, sides = []) {
    const out = [];
    for (let i = 1; i < points.length; i++) {
        const arc = sides[i] === "arc";
        out.push(arc ? { over: points[i], to: points[++i] ?? points[0] } : { over: null, to: points[i] });
    }
    if (far(out.at(-1)?.to ?? points[0], points[0]) > 0) out.push({ over: null, to: points[0] });
    return out;
}

/** A closed line through points, of lines and arcs. */
export function makeOutline(places, { points: list, sides, body, hole, symmetry }) {
    const name = free(places, "outline-");
    const more = { ...(hole ? { hole: "yes" } : {}), ...mirrorWords(symmetry) };
    const made = inBody(places, body, list[0], "part", "outline", (at) => ({ id: name, ...point(["start-x", "start-y"], at(list[0])), ...more }));
    const there = places.bodies.get(body)?.name === "body";
    const at = there ? (p) => local(places, body, p) : (p) => [p[0] - list[0][0], p[1] - list[0][1]];
    const path = `${made.changes.at(-1).add}/outline[${name}]`;
    let before = at(list[0]);
    const children = sidesOf(list, sides).map((side) => {
        const end = at(side.to);
        const arc = side.over && arcOver(before, at(side.over), end);
        before = end;
        return arc ? { add: path, element: "arc", attributes: { ...point(["to-x", "to-y"], end), radius: um(arc.radius), turn: arc.left ? "left" : "right", ...(arc.large ? { large: "yes" } : {}) } }
            : { add: path, element: "line", attributes: point(["to-x", "to-y"], end) };
    });
    return { id: made.id, changes: [...made.changes, ...children] };
}

const mirrorWords = (symmetry) => (symmetry && symmetry !== "none" ? { symmetry } : {});

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

// ---- a mirrored copy ----

/** Names that are free, one after the other. */
function names(places) {
    const taken = new Set([...walk(places.root)].map((e) => e.id));
    return {
        letter: () => {
            for (let i = 0; ; i++) {
                const name = i < 26 ? String.fromCharCode(65 + i) : `H${i - 25}`;
                if (!taken.has(name)) return taken.add(name), name;
            }
        },
        like: (id) => {
            for (let i = 1; ; i++) {
                const name = `${id.replace(/-mirrored(-\d+)?$/, "")}-mirrored${i > 1 ? `-${i}` : ""}`;
                if (!taken.has(name)) return taken.add(name), name;
            }
        },
    };
}

const JOINTED = ["revolute", "spring", "distance", "weld"];
const OTHER_SIDE = { x: "y", y: "x" }; // mirror="y" is the image about the y axis, whose x has the other sign

/**
 * A body again, as its image about a line: axis "x" has the other sign of x, about x = at (um), "y" likewise; with its shapes,
 * the joints that hold it on the ground or on others, and the loads on it. Formulas stay formulas.
 */
export function makeMirrored(places, body, { axis, at }) {
    const e = places.bodies.get(body);
    if (e?.name !== "body") return { refuse: "The bodies of a six-bar have their mirror image in its own sizes." };
    const free_ = names(places);
    const id = free_.like(body);
    const isNumber = (text) => places.kind(text).kind === "number";
    const minus = (text) => (places.evaluate(text) === 0 && isNumber(text) ? text : isNumber(text) ? (text.trim().startsWith("-") ? text.trim().slice(1) : `-${text.trim()}`) : `-(${text})`);
    const beyond = (text) => (at === 0 ? minus(text) : isNumber(text) ? um(2 * at - places.evaluate(text) * 1e6) : `${um(2 * at)} - (${text})`);
    const turned = (text) => (axis === "y" ? minus(text) : isNumber(text) ? deg(Math.PI - places.evaluate(text)) : `180 deg - (${text})`);
    const image = ([x, y]) => (axis === "x" ? [2 * at - x, y] : [x, 2 * at - y]);
    /** Attributes with some of them changed: name -> function of the text, or null to leave it out. */
    const again = (element, changes) => Object.fromEntries([...element.attributes.keys()].filter((k) => k !== "xmlns" && changes[k] !== null)
        .map((k) => [k, changes[k] ? changes[k](places.text(element, k)) : places.text(element, k)]));
    const is = (value) => () => value;
    const own = (...list) => Object.fromEntries(list.map((k) => [k, minus]));
    const [phi, plate] = [{ phi: minus }, { [`plate-${axis}`]: beyond, "plate-angle": minus }];
    const mechanism_ = `${places.root.path}/mechanism`;
    const changes = [{ add: mechanism_, element: "body", attributes: again(e, { id: is(id), [axis]: beyond, ...phi, ...plate, [`com-${axis}`]: minus }) }];
    const path = `${mechanism_}/body[${id}]`;
    const left = [], done = new Set([e, ...e.children]);
    for (const c of e.children) {
        const pitch = own(`pitch-${axis}`);
        if (c.name === "bar") changes.push({ add: path, element: "bar", attributes: again(c, { id: null, ...own(axis, `to-${axis}`), ...pitch }) });
        else if (c.name === "plate") changes.push({ add: path, element: "plate", attributes: again(c, { id: null, ...own(axis, "angle"), ...pitch }) });
        else if (c.name === "disc") changes.push({ add: path, element: "disc", attributes: again(c, { id: null, ...own(axis), ...pitch }) });
        else if (c.name === "outline") {
            const name = free_.like(c.id ?? "outline");
            const was = places.text(c, "mirror") ?? "no";
            const other = OTHER_SIDE[axis];
            const [mirror, half] = was === "no" ? [other, false] : was === other ? ["no", false] : ["no", true]; // both signs: half a turn
            const angle = places.text(c, "angle") ?? "0 deg";
            changes.push({ add: path, element: "outline", attributes: { ...again(c, { ...own(axis), ...pitch, mirror: null, angle: null }), id: name, ...(mirror === "no" ? {} : { mirror }), ...(half ? { angle: `180 deg - (${angle})` } : places.evaluate(angle) === 0 ? {} : { angle: minus(angle) }) } });
            for (const line of c.children) changes.push({ add: `${path}/outline[${name}]`, element: line.name, attributes: again(line, {}) });
        } else left.push(c.name);
    }
    /** The point `k` of a joint or a load: of the copy where it is the body's, mirrored on others. */
    const pointOf = (element, of, [x, y]) => {
        const texts = [x, y].map((k) => places.text(element, k) ?? "0 um");
        const flips = (g) => (axis === "x" ? [g(texts[0]), texts[1]] : [texts[0], g(texts[1])]);
        if (of === body) return flips(minus);
        if (of === "ground") return flips(beyond);
        return from(places.frame(of), image(to(places.frame(of), texts.map((t) => places.evaluate(t) * 1e6)))).map(um);
    };
    /** Attributes of what has two ends, one of them on the body. */
    const between = (element, more) => {
        const set = { ...more };
        const attributes = {};
        for (const k of ["a", "b"]) {
            const of = places.text(element, k);
            const [x, y] = pointOf(element, of, [`${k}-x`, `${k}-y`]);
            Object.assign(attributes, { [k]: of === body ? id : of, [`${k}-x`]: x, [`${k}-y`]: y });
        }
        return { ...again(element, set), ...attributes };
    };
    const isOf = (element) => ["a", "b"].some((k) => places.text(element, k) === body);
    for (const joint of places.joints.filter(isOf)) {
        done.add(joint);
        if (!JOINTED.includes(joint.name)) {
            left.push(joint.name);
            continue;
        }
        const attributes = between(joint, { id: joint.id ? is(joint.name === "revolute" ? free_.letter() : free_.like(joint.id)) : null, axis: turned, "free-angle": minus, "stop-min": null, "stop-max": null });
        for (const [k, o] of [["stop-min", "stop-max"], ["stop-max", "stop-min"]]) if (joint.attributes.has(k)) attributes[o] = minus(places.text(joint, k));
        changes.push({ add: mechanism_, element: joint.name, attributes });
    }
    for (const scene_ of places.root.children.filter((x) => x.name === "scene")) {
        for (const load of scene_.children) {
            const on = places.text(load, "on"), before = changes.length;
            if (load.name === "force" && on === body) changes.push({ add: scene_.path, element: "force", attributes: again(load, { on: is(id), ...own(axis, `f${axis}`) }) });
            else if (load.name === "torque" && on === body) changes.push({ add: scene_.path, element: "torque", attributes: again(load, { on: is(id), value: minus }) });
            else if (load.name === "comb-drive" && on === body && !load.attributes.has("against")) changes.push({ add: scene_.path, element: "comb-drive", attributes: again(load, { id: is(free_.like(load.id ?? "comb")), on: is(id), direction: turned, ...own(axis) }) });
            else if (load.name === "tendon" && load.children.some((c) => places.text(c, "on") === body)) {
                const name = free_.like(load.id ?? "cable");
                changes.push({ add: scene_.path, element: "tendon", attributes: again(load, { id: is(name) }) });
                for (const c of load.children) {
                    const of = places.text(c, "on");
                    const [x, y] = pointOf(c, of, ["x", "y"]);
                    changes.push({ add: `${scene_.path}/tendon[${name}]`, element: c.name, attributes: { ...again(c, {}), on: of === body ? id : of, x, y } });
                }
            } else if (load.name === "contact" && isOf(load) && !load.attributes.has("on")) changes.push({ add: scene_.path, element: "contact", attributes: between(load, load.id ? { id: is(free_.like(load.id)) } : {}) });
            if (changes.length > before) [load, ...load.children].forEach((c) => done.add(c));
        }
    }
    // probes, requirements, drivers and whatever else is about the body or what holds it, told by name
    const about = { body: [body], joint: places.joints.filter(isOf).map((j) => j.id).filter(Boolean) };
    for (const o of walk(places.root)) {
        const says = (keys, names_) => keys.some((k) => names_.includes(o.attributes.get(k)?.value));
        if (!done.has(o) && (says(BODY, about.body) || says(JOINT, about.joint))) left.push(o.id ? `${o.name} ${o.id}` : o.name);
    }
    return { id, changes, left: [...new Set(left)] };
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
