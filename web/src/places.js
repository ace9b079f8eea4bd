// SPDX-License-Identifier: GPL-3.0-or-later
// Where the things of a description are: frames of bodies, shapes, and the points and sizes that may be dragged, read
// from the tree of the text, also of one that is no device yet. Places in um in the world, angles in rad.
import { walk } from "./model.js";
import { evaluate, kindOf } from "./quantities.js";

// ---- frames: world = [a c; b d] local + [e f] ----

const HERE = [1, 0, 0, 1, 0, 0];
const frame = (x, y, phi = 0) => [Math.cos(phi), Math.sin(phi), -Math.sin(phi), Math.cos(phi), x, y];
const mirrored = (how) => (how === "x" ? [1, 0, 0, -1, 0, 0] : how === "y" ? [-1, 0, 0, 1, 0, 0] : HERE);
const inside = (f, g) => [f[0] * g[0] + f[2] * g[1], f[1] * g[0] + f[3] * g[1], f[0] * g[2] + f[2] * g[3], f[1] * g[2] + f[3] * g[3], ...to(f, [g[4], g[5]])];
export const to = (f, [x, y]) => [f[0] * x + f[2] * y + f[4], f[1] * x + f[3] * y + f[5]];
export const from = (f, [x, y]) => {
    const det = f[0] * f[3] - f[1] * f[2];
    const [dx, dy] = [x - f[4], y - f[5]];
    return [(f[3] * dx - f[2] * dy) / det, (f[0] * dy - f[1] * dx) / det];
};

const SIX_BAR = { AB: ["A", "B"], BC: ["B", "C"], CD: ["C", "D"], DE: ["D", "E"], EF: ["E", "F"] };
const JOINTS = ["revolute", "prismatic", "distance", "weld", "spring"];
const NEAR = 1e-3; // um: what coincides
export const far = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]);

export class Places {
    /** held: values that are not in the text yet, as state.set has them; rests: frames of six-bar bodies, by id */
    constructor(root, units, held = {}, rests = new Map()) {
        Object.assign(this, { root, units, held, rests });
        this.known = new Map();
        this.parameters = new Map(root.children.filter((e) => e.name === "parameter" && e.id).map((e) => [e.id, e]));
        this.bodies = new Map();
        this.sixBar = root.children.find((e) => e.name === "six-bar") ?? null;
        this.mechanism = root.children.find((e) => e.name === "mechanism") ?? null;
        for (const e of this.sixBar?.children ?? []) if ((e.name === "link" || e.name === "platform") && SIX_BAR[e.id]) this.bodies.set(e.id, e);
        for (const e of this.mechanism?.children ?? []) if (e.name === "body" && e.id) this.bodies.set(e.id, e);
    }

    /** The same text with other values; changes: Map of path -> text. */
    with(changes) {
        return new Places(this.root, this.units, { ...this.held, ...Object.fromEntries(changes) }, this.rests);
    }

    text(element, attribute) {
        return this.held[`${element.path}/@${attribute}`] ?? element.attributes.get(attribute)?.value;
    }

    #parameter(name) {
        const e = this.parameters.get(name);
        if (!e) return NaN;
        if (!this.known.has(name)) {
            this.known.set(name, NaN); // one that uses itself
            this.known.set(name, this.evaluate(this.written(name)));
        }
        return this.known.get(name);
    }

    /** The text of a parameter's value. */
    written(name) {
        const e = this.parameters.get(name);
        return this.held[name] ?? this.text(e, "value") ?? "";
    }

    evaluate(text) {
        return evaluate(text, this.units, (name) => this.#parameter(name));
    }

    kind(text) {
        return kindOf(text, this.units, (name) => this.parameters.has(name));
    }

    si(element, attribute, usual = 0) {
        const text = this.text(element, attribute);
        return text === undefined ? usual : this.evaluate(text);
    }
    um(element, attribute, usual = 0) {
        return this.si(element, attribute, usual / 1e6) * 1e6;
    }

    // ---- frames ----

    sixBarPoint(at) {
        const e = this.sixBar?.children.find((x) => x.name === "hinge" && x.id === at);
        return e ? [this.um(e, "x"), this.um(e, "y")] : [NaN, NaN];
    }

    /** The frame in which points of a body are stated. */
    frame(id) {
        if (id === "ground" || id === undefined || id === null) return HERE;
        const e = this.bodies.get(id);
        if (!e) return [1, 0, 0, 1, NaN, NaN];
        if (e.name === "body") return frame(this.um(e, "x"), this.um(e, "y"), this.si(e, "phi"));
        const rest = this.rests.get(id);
        if (rest) return frame(rest[0] * 1e6, rest[1] * 1e6, rest[2]);
        if (e.name === "platform") return frame(this.um(e, "x"), this.um(e, "y"));
        const [p, q] = SIX_BAR[id].map((x) => this.sixBarPoint(x));
        return frame((p[0] + q[0]) / 2, (p[1] + q[1]) / 2);
    }

    /** Of a shape inside a body. */
    shapeFrame(e, body) {
        const own = e.name === "outline" || e.name === "plate" || e.name === "lettering" ? frame(this.um(e, "x"), this.um(e, "y"), this.si(e, "angle")) : HERE;
        return inside(inside(this.frame(body), own), e.name === "outline" ? mirrored(this.text(e, "mirror")) : HERE);
    }

    // ---- points: two attributes of one element in a frame ----

    point(element, [x, y], frameOf, label) {
        return { element, x, y, frameOf, label };
    }
    at(point) {
        return to(point.frameOf(this), [this.um(point.element, point.x), this.um(point.element, point.y)]);
    }

    /** Both ends of a joint, or of a contact or probe between two bodies. */
    ends(e) {
        return ["a", "b"].filter((k) => e.attributes.has(k)).map((k) => ({ ...this.point(e, [`${k}-x`, `${k}-y`], (p) => p.frame(p.text(e, k)), k), body: this.text(e, k) }));
    }

    get joints() {
        return (this.mechanism?.children ?? []).filter((e) => JOINTS.includes(e.name));
    }

    /** Points of the bars of a body. */
    barEnds(body) {
        const e = this.bodies.get(body);
        return (e?.children ?? []).filter((c) => c.name === "bar").flatMap((c) => [["x", "y"], ["to-x", "to-y"]].map((names) => ({ ...this.point(c, names, (p) => p.frame(body)), body })));
    }

    /** Where the hinges of a body are. */
    hingePoints(body) {
        const own = this.joints.filter((e) => e.name === "revolute").flatMap((e) => this.ends(e)).filter((x) => x.body === body).map((x) => this.at(x));
        return [...(SIX_BAR[body] && this.sixBar ? SIX_BAR[body].map((x) => this.sixBarPoint(x)) : []), ...own];
    }

    // ---- shapes ----

    /** [{element, body, rings: [[x, y] ...], hole}] of every body, also of one that is drawn by its width alone. */
    shapes() {
        return [...this.bodies].flatMap(([id, e]) => [...this.#ownShapes(id, e), ...(e.name === "body" ? e.children : []).flatMap((c) => this.#shape(c, id))]).filter((x) => x.rings.every((r) => r.length > 2 && r.every((p) => p.every(Number.isFinite)))); // an outline of a file has none here
    }

    #ownShapes(id, e) {
        const out = [];
        const [w, hgt] = e.name === "platform" ? [this.um(e, "width", NaN), this.um(e, "height", NaN)] : [this.um(e, "plate-width", NaN), this.um(e, "plate-height", NaN)];
        if (w > 0 && hgt > 0) out.push({ element: e, body: id, rings: [box(this.plateFrame(e), w, hgt)] });
        const width = e.name === "platform" ? NaN : this.um(e, "width", NaN);
        const points = this.hingePoints(id);
        if (width > 0 && !(w > 0) && points.length > 1) {
            const middle = points.length === 2 ? points[1] : [0, 1].map((k) => points.reduce((s, p) => s + p[k], 0) / points.length);
            for (const p of points.length === 2 ? [points[0]] : points) out.push({ element: e, body: id, rings: [strip(p, middle, width)] });
        }
        return out;
    }

    /** Of the rectangle that a body's own attributes state; in the world. */
    plateFrame(e) {
        if (e.name === "platform") return frame(this.um(e, "x"), this.um(e, "y"), this.si(e, "angle"));
        return frame(this.um(e, "plate-x", this.um(e, "x")), this.um(e, "plate-y", this.um(e, "y")), this.si(e, "plate-angle"));
    }

    #shape(e, body) {
        const ring = this.#ring(e, body);
        if (!ring) return [];
        const f = this.frame(body);
        const n = Math.min(Math.max(Math.round(this.si(e, "copies", 1)) || 1, 1), 500);
        const [px, py] = [this.um(e, "pitch-x"), this.um(e, "pitch-y")];
        const how = this.text(e, "symmetry") ?? "none";
        const images = [[1, 1], ...(how === "x" ? [[1, -1]] : how === "y" ? [[-1, 1]] : how === "both" ? [[1, -1], [-1, 1], [-1, -1]] : [])];
        const local = ring.map((p) => from(f, p));
        const rings = Array.from({ length: n }, (_, i) => images.map(([sx, sy]) => local.map(([x, y]) => to(f, [sx * (x + i * px), sy * (y + i * py)])))).flat();
        return [{ element: e, body, rings, hole: this.text(e, "hole") === "yes" }];
    }

    #ring(e, body) {
        const f = this.shapeFrame(e, body);
        if (e.name === "bar") return strip(to(f, [this.um(e, "x"), this.um(e, "y")]), to(f, [this.um(e, "to-x"), this.um(e, "to-y")]), this.um(e, "width"));
        if (e.name === "plate") return box(f, this.um(e, "width"), this.um(e, "height"));
        if (e.name === "disc") {
            const [x, y, r] = [this.um(e, "x"), this.um(e, "y"), this.um(e, "radius")];
            return Array.from({ length: 32 }, (_, i) => to(f, [x + r * Math.cos((i * Math.PI) / 16), y + r * Math.sin((i * Math.PI) / 16)]));
        }
        return e.name === "outline" ? this.#outline(e).map((p) => to(f, p)) : null;
    }

    #outline(e) {
        const points = [[this.um(e, "start-x"), this.um(e, "start-y")]];
        for (const c of e.children) {
            const q = [this.um(c, "to-x"), this.um(c, "to-y")];
            if (c.name === "arc") points.push(...bend(points.at(-1), q, this.um(c, "radius"), this.text(c, "turn") === "left", this.text(c, "large") === "yes"));
            else points.push(q);
        }
        return points;
    }

    /** Bodies under a place, within so many um of what is drawn of them; the nearest first. */
    bodiesAt(p, within) {
        const best = new Map();
        for (const x of this.shapes()) {
            if (x.hole) continue;
            const d = Math.min(...x.rings.map((r) => (holds(r, p) ? 0 : edge(r, p))));
            if (d <= within && d < (best.get(x.body) ?? Infinity)) best.set(x.body, d);
        }
        return [...best].sort((a, b) => a[1] - b[1]).map(([id]) => id);
    }

    /** Bodies that a rectangle with these corners lies on. */
    bodiesUnder(p, q) {
        const [x0, x1, y0, y1] = [Math.min(p[0], q[0]), Math.max(p[0], q[0]), Math.min(p[1], q[1]), Math.max(p[1], q[1])];
        const n = 16; // points on each side
        const sides = Array.from({ length: n + 1 }, (_, i) => i / n).flatMap((t) => [[x0 + t * (x1 - x0), y0], [x0 + t * (x1 - x0), y1], [x0, y0 + t * (y1 - y0)], [x1, y0 + t * (y1 - y0)]]);
        const on = (ring) => ring.some(([x, y]) => x >= x0 && x <= x1 && y >= y0 && y <= y1) || sides.some((s) => holds(ring, s));
        return [...new Set(this.shapes().filter((x) => !x.hole && x.rings.some(on)).map((x) => x.body))];
    }

    /** The scene that is looked at: of this name, else the first. */
    scene(name) {
        const all = this.root.children.filter((e) => e.name === "scene");
        return all.find((e) => e.id === name) ?? all[0] ?? null;
    }
}

// ---- rings ----

const box = (f, w, h) => [[-w / 2, -h / 2], [w / 2, -h / 2], [w / 2, h / 2], [-w / 2, h / 2]].map((p) => to(f, p));

function strip(p, q, width) {
    const n = far(p, q) || 1;
    const [ox, oy] = [(-(q[1] - p[1]) * width) / 2 / n, ((q[0] - p[0]) * width) / 2 / n];
    return [[p[0] + ox, p[1] + oy], [p[0] - ox, p[1] - oy], [q[0] - ox, q[1] - oy], [q[0] + ox, q[1] + oy]];
}

/** Points of an arc from p to q, without p; one that is too small is a line. */
/** The arc from p over a point to q: {radius, left, large, points (without p)}; null: the three are in a line. */
export function arcOver(p, over, q) {
    const cross = (over[0] - p[0]) * (q[1] - p[1]) - (over[1] - p[1]) * (q[0] - p[0]);
    const [a, b, c] = [far(over, q), far(p, q), far(p, over)];
    if (Math.abs(cross) < 1e-3 * b || !(b > 0)) return null;
    const least = Math.ceil(b * 500 - 1e-6) / 1000; // half the chord, whole nanometres
    const radius = Math.max(Math.round((1e3 * a * b * c) / (2 * Math.abs(cross))) / 1e3, least);
    const left = cross > 0; // by way of the point it bends to the side of the end
    const large = (over[0] - p[0]) * (over[0] - q[0]) + (over[1] - p[1]) * (over[1] - q[1]) > 0; // seen from the point the chord is narrow
    return { radius, left, large, points: bend(p, q, radius, left, large) };
}

function bend(p, q, r, left, large) {
    const half = far(p, q) / 2;
    if (!(r >= half) || half === 0) return [q];
    const k = ((left === large ? -1 : 1) * Math.sqrt(r * r - half * half)) / half;
    const c = [(p[0] + q[0]) / 2 - (k * (q[1] - p[1])) / 2, (p[1] + q[1]) / 2 + (k * (q[0] - p[0])) / 2];
    const begin = Math.atan2(p[1] - c[1], p[0] - c[0]);
    let turn = Math.atan2(q[1] - c[1], q[0] - c[0]) - begin;
    if (left && turn < 0) turn += 2 * Math.PI;
    if (!left && turn > 0) turn -= 2 * Math.PI;
    const n = Math.max(Math.ceil(Math.abs(turn) / 0.15), 1);
    return Array.from({ length: n }, (_, i) => (i === n - 1 ? q : [c[0] + r * Math.cos(begin + (turn * (i + 1)) / n), c[1] + r * Math.sin(begin + (turn * (i + 1)) / n)]));
}

function holds(ring, [x, y]) {
    let odd = false;
    ring.forEach((a, i) => {
        const b = ring[(i + 1) % ring.length];
        if (a[1] > y !== b[1] > y && x < a[0] + ((y - a[1]) * (b[0] - a[0])) / (b[1] - a[1])) odd = !odd;
    });
    return odd;
}

const edge = (ring, p) => Math.min(...ring.map((a, i) => {
    const b = ring[(i + 1) % ring.length];
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const t = Math.min(Math.max(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy || 1), 0), 1);
    return far([a[0] + t * dx, a[1] + t * dy], p);
}));

// ---- what may be dragged ----

const nameOf = (e) => `${e.name}${e.id ? ` ${e.id}` : ""}`;

/**
 * A handle: {id, label, element, body, look, at: [x, y], wants(places, target): [{element, attribute, value (SI), axis,
 * plain: no parameter is changed for it}], always: shown without being chosen}. wants gives the values that put it at a
 * target; points that belong together (both ends of a hinge, bars that end in it) go together.
 */
export function handlesOf(places, { scene = "", reach = 60 } = {}) {
    const out = [];
    const together = (points) => {
        const rest = points.map((p) => places.at(p));
        return (now, target) => points.flatMap((p, i) => {
            const local = from(p.frameOf(now), [0, 1].map((k) => rest[i][k] + target[k] - rest[0][k]));
            return [[p.x, 0], [p.y, 1]].map(([attribute, axis]) => ({ element: p.element, attribute, value: local[axis] / 1e6, axis }));
        });
    };
    const add = (h) => {
        if (h.at.every(Number.isFinite)) out.push({ id: `${h.element.path} ${h.part ?? ""}`.trim(), ...h });
    };
    const points = (list, h) => list.length && add({ at: places.at(list[0]), wants: together(list), element: list[0].element, ...h });
    const context = { places, add, points };
    joints(context);
    for (const [id, e] of places.bodies) body(context, id, e);
    sixBar(context);
    for (const e of places.root.children) if (e.name === "probe") carried(context, e);
    loads(context, places.scene(scene), reach);
    return out;
}

/** Bar ends of these bodies that lie at a place. */
const endsAt = (places, bodies, at) => bodies.flatMap((id) => places.barEnds(id)).filter((p) => far(places.at(p), at) < NEAR);

function joints({ places, points }) {
    for (const e of places.joints) {
        const ends = places.ends(e);
        if (e.name === "revolute" || e.name === "weld") {
            const at = ends.length ? places.at(ends[0]) : [NaN, NaN];
            points([...ends, ...endsAt(places, ends.map((x) => x.body), at)], { element: e, label: `${e.name === "revolute" ? "hinge" : "weld"} ${e.id ?? ""}`, look: "hinge", always: true });
        } else for (const end of ends) points([end], { element: e, part: end.label, label: `${nameOf(e)}, end on ${end.body}`, look: "round", always: true, body: end.body });
    }
}

function sixBar({ places, points, add }) {
    for (const e of places.sixBar?.children ?? []) {
        if (e.name === "hinge") points([places.point(e, ["x", "y"], () => HERE)], { element: e, label: `hinge ${e.id ?? ""}`, look: "hinge", always: true });
        if (e.name === "platform") {
            points([places.point(e, ["x", "y"], () => HERE)], { element: e, label: "platform, middle", look: "cross", body: e.id, always: true });
            corner(places, add, e, e.id, ["width", "height"], (p) => p.plateFrame(e), "platform, corner");
        }
    }
    if (places.sixBar) for (const e of places.root.children.filter((x) => x.name === "workspace")) required(places, add, e);
}

/** The middle of a rectangle stays where it is, its sides follow. */
function corner(places, add, e, body, [w, h], frameOf, label) {
    add({
        element: e, part: "corner", body, label, look: "square", at: to(frameOf(places), [places.um(e, w, NaN) / 2, places.um(e, h, NaN) / 2]),
        wants: (now, target) => from(frameOf(now), target).map((v, axis) => ({ element: e, attribute: [w, h][axis], value: Math.max(2 * Math.abs(v), 1) / 1e6, axis })),
    });
}

/** Corners of a required workspace, about the platform as drawn. */
function required(places, add, e) {
    const platform = places.sixBar.children.find((x) => x.name === "platform");
    if (!platform) return;
    const middle = (p) => p.frame("CD").slice(4);
    for (const [part, x, y] of [["least", "x-min", "y-min"], ["most", "x-max", "y-max"]])
        add({
            element: e, part, label: `workspace, ${part} corner`, look: "square", always: true, at: [places.um(e, x) + middle(places)[0], places.um(e, y) + middle(places)[1]],
            wants: (now, target) => [x, y].map((attribute, axis) => ({ element: e, attribute, value: (target[axis] - middle(now)[axis]) / 1e6, axis })),
        });
}

function body({ places, points, add }, id, e) {
    if (e.name !== "body") return;
    const origin = places.point(e, ["x", "y"], () => HERE);
    const plate = ["plate-x", "plate-y"].every((a) => e.attributes.has(a)) ? [places.point(e, ["plate-x", "plate-y"], () => HERE)] : [];
    const coupled = places.joints.filter((j) => j.name !== "spring").flatMap((j) => {
        const ends = places.ends(j);
        if (!ends.some((x) => x.body === id)) return [];
        const others = ends.filter((x) => x.body !== id);
        const at = places.at(ends.find((x) => x.body === id));
        return [...others.filter((x) => far(places.at(x), at) < NEAR), ...endsAt(places, others.map((x) => x.body), at)];
    });
    points([origin, ...plate, ...coupled], { element: e, label: `body ${id}`, look: "cross", body: id });
    if (places.um(e, "plate-width", NaN) > 0) corner(places, add, e, id, ["plate-width", "plate-height"], (p) => p.plateFrame(e), `plate of ${id}, corner`);
    for (const c of e.children) shapeHandles({ places, points, add }, c, id);
}

function shapeHandles({ places, points, add }, e, body) {
    const local = (names) => places.point(e, names, (p) => p.frame(body));
    const of = `${nameOf(e)} of ${body}`;
    if (e.name === "bar") {
        points([local(["x", "y"])], { element: e, part: "begin", label: `${of}, begin`, look: "square", body });
        points([local(["to-x", "to-y"])], { element: e, part: "end", label: `${of}, end`, look: "square", body });
        const middle = (p) => [0, 1].map((k) => (p.at(local(["x", "y"]))[k] + p.at(local(["to-x", "to-y"]))[k]) / 2);
        const across = (p) => {
            const [a, b] = [p.at(local(["x", "y"])), p.at(local(["to-x", "to-y"]))];
            const n = far(a, b) || 1;
            return [-(b[1] - a[1]) / n, (b[0] - a[0]) / n];
        };
        const [m, u] = [middle(places), across(places)];
        add({
            element: e, part: "width", body, label: `${of}, width`, look: "side", at: [m[0] + (u[0] * places.um(e, "width")) / 2, m[1] + (u[1] * places.um(e, "width")) / 2],
            wants: (now, target) => [{ element: e, attribute: "width", axis: null, value: Math.max(2 * Math.abs(across(now).reduce((s, v, k) => s + v * (target[k] - middle(now)[k]), 0)), 1) / 1e6 }],
        });
    } else if (e.name === "outline") {
        const names = ["start-x", "start-y"];
        const f = (p) => p.shapeFrame(e, body);
        const first = places.point(e, names, f);
        const others = e.children.map((c) => places.point(c, ["to-x", "to-y"], f));
        const closing = others.filter((p, i) => i === others.length - 1 && far(places.at(p), places.at(first)) < NEAR);
        if (others.length) points([first, ...closing], { element: e, part: "start", label: `${of}, corner 1`, look: "square", body });
        others.slice(0, others.length - closing.length).forEach((p, i) => points([p], { element: p.element, label: `${of}, corner ${i + 2}`, look: "square", body }));
    } else if (["plate", "disc", "lettering"].includes(e.name)) {
        points([local(["x", "y"])], { element: e, label: e.name === "lettering" ? `${of}, corner` : `${of}, middle`, look: "cross", body });
        if (e.name === "plate") corner(places, add, e, body, ["width", "height"], (p) => p.shapeFrame(e, body), `${of}, corner`);
        if (e.name === "disc") {
            const middle = (p) => p.at(local(["x", "y"]));
            add({
                element: e, part: "radius", body, label: `${of}, radius`, look: "side", at: [middle(places)[0] + places.um(e, "radius"), middle(places)[1]],
                wants: (now, target) => [{ element: e, attribute: "radius", axis: null, value: Math.max(far(target, middle(now)), 1) / 1e6 }],
            });
        }
    }
}

/** A point that a body carries, or two. */
function carried({ places, points }, e, look = "round") {
    if (e.attributes.has("on") && (e.attributes.has("x") || e.attributes.has("y") || e.name !== "probe"))
        points([places.point(e, ["x", "y"], (p) => p.frame(p.text(e, "on")))], { element: e, label: `${nameOf(e)} on ${places.text(e, "on")}`, look, always: true });
    if (e.name === "probe" || e.name === "contact")
        for (const end of places.ends(e)) if (["x", "y"].some((k) => e.attributes.has(`${end.label}-${k}`))) points([end], { element: e, part: end.label, label: `${nameOf(e)}, point on ${end.body}`, look, always: true });
}

function loads(context, scene, reach) {
    const { places, add } = context;
    for (const e of scene?.children ?? []) {
        if (e.name === "tendon") e.children.forEach((c) => carried(context, c, "diamond"));
        if (e.name === "contact" && !e.attributes.has("on")) carried(context, e, "diamond");
        if (e.name !== "force" && e.name !== "comb-drive") continue;
        carried(context, e, "diamond");
        const at = (p) => to(p.frame(p.text(e, "on")), [p.um(e, "x"), p.um(e, "y")]);
        const p = at(places);
        const [fx, fy] = ["fx", "fy"].map((a) => places.si(e, a));
        const stator = (now) => now.frame(now.text(e, "against"));
        const turned = (f) => Math.atan2(f[1], f[0]);
        const direction = e.name === "force" ? Math.atan2(fy, fx) : places.si(e, "direction") + turned(stator(places));
        add({
            element: e, part: "direction", label: `${nameOf(e)}, direction`, look: "tip", always: true, turns: at,
            at: [p[0] + reach * Math.cos(direction), p[1] + reach * Math.sin(direction)],
            wants: (now, target) => {
                const phi = Math.atan2(target[1] - at(now)[1], target[0] - at(now)[0]);
                if (e.name === "comb-drive") return [{ element: e, attribute: "direction", value: phi - turned(stator(now)), axis: null, angle: true, plain: true }];
                const size = Math.hypot(fx, fy);
                return [["fx", Math.cos], ["fy", Math.sin]].map(([attribute, g]) => ({ element: e, attribute, value: Math.abs(g(phi)) < 1e-9 ? 0 : size * g(phi), axis: null, unit: "uN", plain: true, force: size }));
            },
        });
    }
}

// ---- a move as changes of the text ----

/** The element that a place in the text (an offset) is in: the innermost start tag. */
export function elementAt(root, offset) {
    let best = null;
    for (const e of walk(root)) if (e.from <= offset && offset <= e.to && (!best || e.from >= best.from)) best = e;
    return best;
}
