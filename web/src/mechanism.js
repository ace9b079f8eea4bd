// SPDX-License-Identifier: GPL-3.0-or-later
// The device as a picture that moves: real outlines of bodies, flexures bent between them, hinges
// coloured and numbered by how much of their limit they use, springs and cables, loads as arrows.
import { alike } from "./alike.js";
import { Attached } from "./attached.js";
import { scale } from "./colours.js";
import { h, put, s, say } from "./dom.js";
import { percent } from "./format.js";
import { Bend, displacement, moved, place } from "./outline.js";
import { scaleBar, Viewport } from "./viewport.js";

const REST = [0, 0, 0];
let count = 0;

const grown = ([x0, y0, x1, y1], share) => {
    const [dx, dy] = [(x1 - x0) * share, (y1 - y0) * share];
    return [x0 - dx, y0 - dy, x1 + dx, y1 + dy];
};

/** The box that is shown where it holds the new one and is hardly larger: a picture that is driven does not pulse. */
const steady = (old, now) => (old[0] <= now[0] && old[1] <= now[1] && old[2] >= now[2] && old[3] >= now[3] && old[2] - old[0] <= 1.25 * (now[2] - now[0]) && old[3] - old[1] <= 1.25 * (now[3] - now[1]) ? old : now);

/** Row of a motion, x, y, phi of body after body, as poses in the order of the preview's bodies. */
export const posesOf = (preview, row) => preview.bodies.map((b, i) => (b.fixed ? REST : row.slice(3 * i, 3 * i + 3)));
export const restOf = (preview) => preview.bodies.map((b) => b.rest ?? REST);

/** A body's pose for the picture, which is drawn about the centre of mass, from that of its reference frame, which the results of
 *  commands have. `frames` and `centres`: of one and the same pose, as such a result states them. */
export function centred(frame, id, frames, centres) {
    const [x, y, phi] = frames[id];
    const [dx, dy] = [centres[id][0] - x, centres[id][1] - y];
    const [c, sn] = [Math.cos(frame[2] - phi), Math.sin(frame[2] - phi)];
    return [frame[0] + c * dx - sn * dy, frame[1] + sn * dx + c * dy, frame[2]];
}

/** Lists of a body's outlines, and the class of each. */
const OUTLINES = [["frame", "chip"], ["tethers", "tether"], ["islands", "island"], ["outline", undefined]];

const FAR_PIXELS = 60; // most that a hinge's number stands off its edge for its size

/** Corners of an outline, from a point. */
function cornersAbout(d, [x, y]) {
    return [...d.matchAll(/(-?[\d.]+(?:e-?\d+)?) (-?[\d.]+(?:e-?\d+)?)(?=[A-Za-z]|$)/g)].map((m) => [Number(m[1]) - x, Number(m[2]) - y]);
}

const lineOf = (text) => (text ? text.slice(1).split("L").map((p) => p.split(" ").map(Number)) : null);

export class Mechanism {
    /** holder: an element that gets the picture; label: its name for assistive programs; around: room for what
     *  moves, as a share of the device; scene: the picture holds the scene's cables, too */
    constructor(holder, { label, onhinge, pan, around = 0, scene = false } = {}) {
        this.id = `mechanism${++count}`;
        this.onhinge = onhinge;
        this.around = around;
        this.scene = scene;
        this.svg = s("svg", { class: "mechanism" });
        holder.append(this.svg);
        this.view = new Viewport(this.svg, { label, pan, onview: () => this.#resize() });
        this.svg.prepend(this.#defs());
        this.ghost = s("g", { class: "ghost" });
        this.under = s("g", { class: "under" });
        this.parts = s("g", { class: "parts" });
        this.pinned = s("g", { class: "pinned", "aria-hidden": "true" });
        this.above = s("g", { class: "above" });
        this.attached = new Attached();
        this.view.world.append(this.under, this.ghost, this.parts, this.attached.group, this.pinned, this.above);
        this.labels = s("g", { class: "labels" });
        this.arrows = s("g", { class: "arrows" });
        this.tags = s("g", { class: "mark-tags" });
        this.bar = s("g", { class: "scale-bar", "aria-hidden": "true" });
        this.view.overlay.append(this.attached.tags, this.arrows, this.labels, this.tags, this.bar);
        this.bodies = [];
        this.flexures = [];
        this.pins = [];
        this.loads = [];
        this.q = null;
    }

    #defs() {
        return s("defs", {},
            s("pattern", { id: `${this.id}-over`, width: 7, height: 7, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
                s("rect", { width: 7, height: 7, class: "over-back" }),
                s("rect", { width: 3, height: 7, class: "over-line" })),
            s("marker", { id: `${this.id}-head`, viewBox: "0 0 10 10", refX: 8, refY: 5, markerWidth: 6, markerHeight: 6, orient: "auto-start-reverse" },
                s("path", { d: "M0 0 10 5 0 10z", class: "arrow-head" })));
    }

    /** Takes a new device; keeps pan and zoom. posed: its pose comes next, and it is placed then. */
    show(preview, { posed = false } = {}) {
        const before = this.preview;
        if (before === preview) return;
        this.preview = preview;
        const same = (f) => Boolean(before) && alike(f(preview), f(before));
        const shape = same((p) => [p.bodies, p.flexures, p.pins.map((x) => [x.id, x.a, x.b, x.at_um])]);
        const marks = same((p) => p.marks ?? []);
        const attached = same((p) => [p.scene_box_um ?? null, p.ties ?? null, p.springs ?? null, p.loads ?? null]);
        if (shape && attached && marks) return;
        this.rest = restOf(preview);
        if (!shape) this.#parts(preview);
        if (!shape || !marks) this.#marks(preview);
        const q = shape && this.q ? this.q : this.rest;
        if (!shape || !attached) this.attached.show(preview, this.rest);
        if (posed) this.motion = null;
        else this.pose(q);
        const room = this.scene && preview.loads?.some((x) => x.kind === "tendon") ? 0.06 : 0; // for the arrows of cables
        const box = this.scene ? preview.scene_box_um : preview.box_um;
        if (box) this.view.setBox(steady(this.view.box, grown(box, Math.max(this.around, room))));
    }

    /** The elements of a device whose parts are the same stay, each with its new outline. */
    #parts(preview) {
        const kinds = JSON.stringify([preview.bodies.map((b) => [b.id, b.fixed, b.drawn, ...OUTLINES.map(([list]) => b[list]?.length ?? 0)]), preview.flexures.map((f) => f.id), preview.pins.map((x) => x.id)]);
        if (kinds !== this.kinds) this.#made(preview);
        this.kinds = kinds;
        const index = new Map(preview.bodies.map((b, i) => [b.id, i]));
        const ground = preview.bodies.findIndex((b) => b.fixed);
        preview.bodies.forEach((body, i) => {
            const paths = this.bodies[i].querySelectorAll("path");
            OUTLINES.flatMap(([list]) => body[list] ?? []).forEach((d, k) => put(paths[k], { d }));
        });
        preview.flexures.forEach((flexure, i) => {
            const f = this.flexures[i];
            [f.a, f.b] = flexure.between.map((id) => index.get(id) ?? ground);
            if (f.rest === flexure.path && f.line === flexure.centre_line) return;
            Object.assign(f, { rest: flexure.path, line: flexure.centre_line, bend: flexure.centre_line ? new Bend(flexure.path, lineOf(flexure.centre_line)) : null });
        });
        preview.pins.forEach((pin, i) => {
            const own = preview.flexures.find((f) => f.id === pin.id);
            const around = own && pin.at_um ? cornersAbout(own.path, pin.at_um) : []; // um: the number stands beside what it is about
            Object.assign(this.pins[i], { body: index.get(pin.a) ?? index.get(pin.b) ?? ground, at: pin.at_um, around });
        });
    }

    #made(preview) {
        this.parts.replaceChildren();
        this.bodies = preview.bodies.map((body) => {
            const g = s("g", { class: body.fixed ? "body fixed" : body.drawn === false ? "body bare" : "body", "data-id": body.id },
                s("title", {}, body.fixed ? "fixed" : `body ${body.id}`),
                OUTLINES.map(([list, name]) => (body[list] ?? []).map(() => s("path", { class: name, "fill-rule": "evenodd" }))));
            this.parts.append(g);
            return g;
        });
        this.flexures = preview.flexures.map((flexure) => {
            const path = s("path", { class: "flexure", "fill-rule": "evenodd", "data-id": flexure.id });
            const edge = s("path", { class: "flexure-edge" });
            const title = s("title", {}, `hinge ${flexure.id}`);
            path.append(title);
            path.addEventListener("click", () => this.onhinge?.(flexure.id));
            this.parts.append(edge, path);
            return { id: flexure.id, path, edge, title };
        });
        this.#pins(preview);
    }

    /** Why the layout cannot be made, or the device is rejected: parts and places in the warning colour. */
    #marks(preview) {
        const marks = preview.marks ?? [];
        const bodies = new Set(marks.flatMap((m) => m.bodies));
        preview.bodies.forEach((b, i) => this.bodies[i].classList.toggle("faulty", bodies.has(b.id)));
        const hinges = new Set(marks.flatMap((m) => m.hinges));
        for (const pin of this.pins) pin.g.classList.toggle("faulty", hinges.has(pin.id));
        this.above.querySelectorAll(".overlap").forEach((e) => e.remove());
        this.above.append(...marks.flatMap((m) => m.overlap.map((d) => s("path", { d, class: "overlap", "fill-rule": "evenodd" }))));
        this.marked = marks.map((m, i) => ({ at: m.at_um ?? preview.pins.find((p) => p.id === m.hinges[0])?.at_um, m, i })).filter((x) => x.at);
        this.tags.replaceChildren(...this.marked.map((x) => {
            x.g = s("g", { class: "mark-tag" }, s("title", {}, `${x.m.text}${x.m.code ? ` [${x.m.code}]` : ""}`), s("circle", { r: 8 }), s("text", { "text-anchor": "middle", y: 3.7 }, String(x.i + 1)));
            return x.g;
        }));
    }

    #pins(preview) {
        this.labels.replaceChildren();
        this.pins = preview.pins.map((pin) => {
            const text = s("text", { class: "hinge-label", "text-anchor": "middle" });
            const back = s("rect", { class: "hinge-plate", rx: 4, height: 18 });
            const g = s("g", { class: "hinge-tag", "data-id": pin.id }, back, text);
            g.addEventListener("click", () => this.onhinge?.(pin.id));
            this.labels.append(g);
            return { id: pin.id, width: 0, g, text, back, key: null };
        });
    }

    /** q: pose [x_m, y_m, phi_rad] of every body, in the order of the preview's bodies; acting: {factors:
     *  how much of every load acts, tensions: of every cable}; null: the picture is of no scene. */
    pose(q, acting = null) {
        this.q = q;
        this.factors = acting?.factors;
        this.attached.pose(q, acting);
        const motion = q.map((pose, i) => displacement(this.rest[i], pose));
        this.motion = motion;
        q.forEach((pose, i) => put(this.bodies[i], { transform: place(pose) }));
        for (const f of this.flexures) {
            const d = f.bend ? f.bend.path(motion[f.a] ?? REST, motion[f.b] ?? REST) : f.rest;
            if (d === f.d) continue;
            f.d = d;
            f.path.setAttribute("d", d);
            f.edge.setAttribute("d", d);
        }
        this.#place();
    }

    /** A second outline behind, of other poses: null takes it away. */
    ghostAt(q) {
        this.ghost.replaceChildren();
        if (!q) return;
        this.preview.bodies.forEach((body, i) => {
            if (body.fixed) return;
            this.ghost.append(s("g", { transform: place(q[i]) }, body.outline.map((d) => s("path", { d }))));
        });
    }

    /** Another device over this one as dashed outlines, at poses of its own; null takes it away. */
    compareWith(preview, q) {
        if (preview !== this.comparedWith) {
            this.comparedWith = preview;
            this.pinned.replaceChildren();
            if (!preview) return;
            const index = new Map(preview.bodies.map((b, i) => [b.id, i]));
            this.pinnedBodies = preview.bodies.map((b) => (b.fixed ? null : s("g", {}, b.outline.map((d) => s("path", { d })))));
            this.pinnedFlexures = preview.flexures.map((f) => ({ at: f.between.map((id) => index.get(id)), path: s("path", {}), d: f.path, bend: f.centre_line ? new Bend(f.path, lineOf(f.centre_line)) : null }));
            this.pinned.append(...this.pinnedBodies.filter(Boolean), ...this.pinnedFlexures.map((f) => f.path));
        }
        if (!preview) return;
        const rest = restOf(preview);
        const motion = q.map((pose, i) => displacement(rest[i], pose));
        q.forEach((pose, i) => this.pinnedBodies[i]?.setAttribute("transform", place(pose)));
        for (const f of this.pinnedFlexures) f.path.setAttribute("d", f.bend ? f.bend.path(motion[f.at[0]] ?? REST, motion[f.at[1]] ?? REST) : f.d);
    }

    /** shares: Map of hinge id -> used share of the limit (null: no limit known). */
    colour(shares, chosen) {
        for (const f of this.flexures) {
            const share = shares.get(f.id);
            const colour = share === undefined || share === null ? "var(--piece)" : share > 1 ? `url(#${this.id}-over)` : scale(share);
            if (colour !== f.colour) for (const name of ["fill", "stroke"]) f.path.style.setProperty(name, colour);
            f.colour = colour;
            f.edge.classList.toggle("chosen", f.id === chosen);
            f.edge.classList.toggle("over", share > 1);
            say(f.title, `hinge ${f.id}${share === undefined || share === null ? "" : `: ${percent(share)} of its limit`}`);
        }
        let wider = false;
        for (const pin of this.pins) {
            const share = shares.get(pin.id);
            const text = share === undefined || share === null ? pin.id : `${pin.id} ${Math.round(share * 100)} %`;
            if (text !== pin.key) {
                pin.key = text;
                pin.text.textContent = text;
                const width = 12 + text.length * 6.6;
                wider ||= width !== pin.width;
                pin.width = width;
                pin.back.setAttribute("width", width);
                pin.back.setAttribute("x", -width / 2);
                pin.back.setAttribute("y", -13);
            }
            pin.g.classList.toggle("over", share > 1);
            pin.g.classList.toggle("chosen", pin.id === chosen);
        }
        if (wider) this.#place();
    }

    /** loads: [{body (index, -1: ground), at: [x_um, y_um] in its axes, index (of the preview's loads), relative
     *  (to the largest), and along: (at) => [x, y], at(body, point) in um, or torque_Nm}]. */
    setLoads(loads) {
        this.loads = loads;
        this.arrows.replaceChildren(...loads.map((load) => {
            const turning = load.torque_Nm !== undefined;
            load.path = s("path", turning ? { class: "load turning", "marker-end": `url(#${this.id}-head)` } : { class: "load", "marker-end": `url(#${this.id}-head)` });
            load.path.append(s("title", {}, load.text ?? ""));
            return load.path;
        }));
        this.#place();
    }

    #place() {
        if (!this.motion || !this.preview) return;
        const centre = this.view.toScreen((this.view.box[0] + this.view.box[2]) / 2, (this.view.box[1] + this.view.box[3]) / 2);
        for (const pin of this.pins) {
            if (!pin.at) continue;
            const [x, y] = this.view.toScreen(...moved(this.motion[pin.body], pin.at));
            const dx = x - centre[0];
            const dy = y - centre[1];
            const far = Math.hypot(dx, dy) || 1; // beside the hinge, towards the middle of the picture
            const [ux, uy] = [dx / far, dy / far];
            const size = pin.around.reduce((most, [px, py]) => Math.max(most, px * -ux + py * uy), 0); // the picture's y is down
            const out = Math.min(size * this.view.k, FAR_PIXELS) + (Math.abs(ux) * pin.width) / 2 + Math.abs(uy) * 9 + 3;
            pin.g.setAttribute("transform", `translate(${(x - ux * out).toFixed(1)} ${(y - uy * out + 4).toFixed(1)})`);
        }
        const taken = []; // numbers of one place stand beside each other
        for (const x of this.marked ?? []) {
            let [px, py] = this.view.toScreen(...x.at);
            while (taken.some((t) => Math.hypot(t[0] - px, t[1] - py) < 16)) px += 17;
            taken.push([px, py]);
            x.g.setAttribute("transform", `translate(${px.toFixed(1)} ${py.toFixed(1)})`);
        }
        this.attached.name((x, y) => this.view.toScreen(x, y), this.view.k, this.covered?.[2] ?? []);
        for (const load of this.loads) this.#load(load);
    }

    #load(load) {
        const size = (load.of ?? ((x) => x))(this.factors?.[load.index] ?? 1);
        const at = (body, point) => moved((this.q[body] ?? REST).map((v, i) => (i < 2 ? v * 1e6 : v)), point);
        const [x, y] = this.view.toScreen(...at(load.body, load.at));
        load.path.classList.toggle("none", Math.abs(size) < 0.02);
        if (load.torque_Nm !== undefined) {
            const r = 17;
            const sweep = size * load.torque_Nm > 0 ? 0 : 1; // the picture's y is down
            const end = sweep ? -50 : 230;
            const begin = sweep ? 200 : -20;
            const p = (deg) => `${(x + r * Math.cos((deg * Math.PI) / 180)).toFixed(1)} ${(y - r * Math.sin((deg * Math.PI) / 180)).toFixed(1)}`;
            load.path.setAttribute("d", `M${p(begin)}A${r} ${r} 0 1 ${sweep} ${p(end)}`);
            return;
        }
        const [ux, uy] = load.along(at, this.q);
        const far = Math.hypot(ux, uy) || 1;
        const length = Math.sign(size) * (14 + (load.longest ?? 42) * Math.min(Math.abs(size), 1.5) * (load.relative ?? 1));
        load.path.setAttribute("d", `M${x.toFixed(1)} ${y.toFixed(1)}L${(x + (ux / far) * length).toFixed(1)} ${(y - (uy / far) * length).toFixed(1)}`);
    }

    /** [left, top, right, bottom] of what lies over the picture, in its pixels. */
    #buttons() {
        const own = this.svg.getBoundingClientRect();
        return [...this.svg.parentElement.querySelectorAll(".stage-tools, .zoom-buttons")].map((e) => e.getBoundingClientRect()).filter((r) => r.width)
            .map((r) => [r.left - own.left, r.top - own.top, r.right - own.left, r.bottom - own.top]);
    }

    #resize() {
        const [w, height] = this.view.size;
        if (this.covered?.[0] !== w || this.covered[1] !== height || !this.covered[2].length) this.covered = [w, height, this.#buttons()];
        this.#place();
        const { um, text } = scaleBar(this.view.k);
        const length = um * this.view.k;
        const y = height - 14;
        const bar = JSON.stringify([w, y, length, text]);
        if (bar === this.barShown) return;
        this.barShown = bar;
        this.bar.replaceChildren(
            s("path", { d: `M${w - 16 - length} ${y - 4}v4h${length}v-4` }),
            s("text", { x: w - 16 - length / 2, y: y - 7, "text-anchor": "middle" }, text));
    }
}

/** The legend of the colours: used share of the limit. */
export function colourLegend() {
    const steps = 24;
    const bar = h("span", { class: "ramp", "aria-hidden": "true" },
        Array.from({ length: steps }, (_, i) => h("i", { style: { background: scale(i / (steps - 1)) } })));
    return h("div", { class: "colour-legend" },
        h("span", {}, "share of the limit"), h("span", {}, "0"), bar, h("span", {}, "100 %"),
        h("span", { class: "over-key", "aria-hidden": "true" }), h("span", {}, "beyond"));
}
