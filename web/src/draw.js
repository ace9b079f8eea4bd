// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing: the mechanism at rest with handles on all that has a place, and tools that add to it. Everything made here
// is a change of the text, one step of its history; while something is dragged its values are held, as by a slider, so
// that picture and verdict follow before the text does.
import { Shown } from "./belong.js";
import { edit, holdTogether, isPresent, letGoTogether, refuse } from "./design.js";
import { announce, button, h, s, select, setOptions } from "./dom.js";
import { DRAWN, enter, show } from "./entering.js";
import { number } from "./format.js";
import { Mechanism, restOf } from "./mechanism.js";
import { parse, walk } from "./model.js";
import { zoomButtons } from "./motion.js";
import { makeMirrored, removing, sidesOf } from "./making.js";
import { heldBy, plan } from "./moving.js";
import { arcOver, elementAt, far, handlesOf, Places } from "./places.js";
import { gridStep, snap } from "./snapping.js";
import { inputKey, ofAnother, requestKey } from "./belong.js";
import { emit, lookAt, on, state } from "./store.js";
import { TOOLS } from "./tools.js";
import { MARGIN } from "./viewport.js";

const CLICK_PIXELS = 4; // less is no drag
const TOUCH_PIXELS = 10; // around a body that still hits it
const TIP_PIXELS = 62; // from a load to the handle of its direction
const TIP_LEAST = 0.4; // of its length, where there is no room for more
const TIP_MARGIN = 14; // of that handle, from the edge of the picture
const EMPTY = [-1000, -800, 1000, 1200]; // um, of a page without anything
const GRIDS = [["", "grid: auto"], ["0", "no grid"], ["1", "1 µm"], ["5", "5 µm"], ["10", "10 µm"], ["50", "50 µm"], ["100", "100 µm"]];

const marked = (fault) => (!fault ? "" : fault.bad ? " faulty" : " doubtful");
const um = (v) => `${number(Number(v.toFixed(3)), 7)} µm`;
const path = (ring) => `M${ring.map(([x, y]) => `${x.toFixed(3)} ${y.toFixed(3)}`).join("L")}Z`;
const LOOKS = {
    hinge: () => s("circle", { r: 6.5 }), round: () => s("circle", { r: 4.5 }), square: () => s("rect", { x: -4.5, y: -4.5, width: 9, height: 9 }),
    diamond: () => s("path", { d: "M0-6 6 0 0 6-6 0Z" }), cross: () => s("path", { d: "M-2-7h4v5h5v4h-5v5h-4v-5h-5v-4h5Z" }),
    side: () => s("path", { d: "M-5-3.5h10v7h-10Z" }), tip: () => s("circle", { r: 5 }),
};

export class Draw {
    constructor(holder) {
        this.tool = null;
        this.chosen = null; // id of a handle
        this.points = []; // of what is being drawn
        this.on = []; // bodies of its eyelets, where they were chosen
        this.values = Object.fromEntries(TOOLS.map((t) => [t.id, Object.fromEntries(t.fields.map((f) => [f.key, f.value]))]));
        this.grid = "";
        this.bar = h("div", { class: "draw-tools", role: "toolbar", "aria-label": "Tools of drawing" });
        this.stage = h("div", { class: "stage draw-stage" });
        this.side = h("div", { class: "side-panel" });
        holder.append(this.bar, h("div", { class: "split" }, this.stage, this.side));
        this.mechanism = new Mechanism(this.stage, { label: "The device as drawn. Arrow keys pan; Tab goes to its handles, which arrow keys move.", around: 0.08, scene: true });
        this.view = this.mechanism.view;
        // an arrow at the rim of the device has room for the least that it is drawn with
        this.view.margin = () => (this.list?.some((x) => x.turns) ? Math.max(MARGIN, (TIP_LEAST * TIP_PIXELS + TIP_MARGIN) / Math.min(...this.view.size)) : MARGIN);
        this.stage.append(zoomButtons(() => this.view));
        this.lines = s("path", { class: "draw-grid", "aria-hidden": "true" });
        this.sketch = s("g", { class: "sketch" });
        this.guides = s("g", { class: "guides", "aria-hidden": "true" });
        this.handles = s("g", { class: "draw-handles" });
        this.dimension = s("g", { class: "dimension none", "aria-hidden": "true" }, s("rect", { rx: 4, height: 20 }), s("text", { y: 14, x: 7 }));
        this.view.world.prepend(this.lines);
        this.view.world.append(this.sketch);
        this.view.overlay.append(this.guides, this.handles, this.dimension);
        this.shownOf = new Shown(this.stage);
        const base = this.view.onview;
        this.view.onview = (v) => {
            base(v);
            this.#place();
        };
        this.#toolbar();
        this.#pointer();
        this.#keys();
        on("text", () => this.#refresh());
        on("another", () => { // what is drawn on next is another device, of which nothing is chosen, though it may have the same names
            if (this.tool) this.#use(null);
            Object.assign(this, { chosen: null, panelOf: null });
            this.side.replaceChildren();
            if (state.hinge) lookAt(state.hinge);
        });
        on("pinned", () => this.visible && this.#pinned());
        on("picture", () => this.visible && this.#base());
        on("answer", () => this.#refresh());
    }

    start(table) {
        this.table = table;
        this.units = Object.fromEntries(table.units.map((name, i) => [name, table.unit_factors[i]]));
        this.keys = new Map(table.elements.toReversed().map((e) => [e.name, e.key]));
        this.#refresh();
    }

    shown(yes) {
        this.visible = yes;
        if (!yes) return this.#cancel();
        if (state.picture) this.#base();
        this.#refresh();
    }

    // ---- what is drawn ----

    #base() {
        this.mechanism.show(state.picture);
        this.mechanism.pose(restOf(state.picture));
        this.mechanism.colour(new Map(), state.hinge);
        this.#pinned();
        this.#stands();
        if (!this.drag) this.#refresh();
    }

    #pinned() {
        const p = state.pinned?.preview ?? null;
        this.mechanism.compareWith(p, p && restOf(p));
    }

    /** The tree of the text and its places; null while it is no XML. What is held is taken as it is now: whoever plans a move has
     *  the same places before and after it. but: paths of what is held that do not count. */
    #read(but = []) {
        if (this.readOf !== state.text) {
            this.readOf = state.text;
            this.root = parse(state.text, (name) => this.keys.get(name) ?? null) ?? this.root;
        }
        const rests = new Map((state.picture?.bodies ?? []).filter((b) => b.rest).map((b) => [b.id, b.rest]));
        const held = { ...state.set };
        for (const path of but) delete held[path];
        this.places = this.root ? new Places(this.root, this.units, held, rests) : null;
    }

    #refresh() {
        if (!this.visible || !this.table) return;
        if (this.drag?.handle) return this.#values(); // of what is said of it as it is now
        this.live = null;
        this.#read();
        if (!this.places) return;
        this.list = this.#handlesOf(this.places);
        if (this.chosen && !this.list.some((x) => x.id === this.chosen)) this.chosen = null;
        this.#stands();
        this.#fit();
        this.#paint(this.places, this.list);
        this.#panel();
    }

    /** Where the last answer has no picture, or is of another device, what is drawn stands for it; until the next answer it stays so. */
    #stands() {
        const nothing = state.answered === inputKey() && !isPresent();
        if (nothing || !state.picture || ofAnother(state.pictureOf)) this.alone = true;
        else if (isPresent()) this.alone = false;
        this.stage.classList.toggle("sketch-only", this.alone);
        this.shownOf.take(this.alone ? null : state.pictureOf);
    }

    #handlesOf(places) {
        return handlesOf(places, { scene: this.#scene(), reach: TIP_PIXELS / this.view.k });
    }

    /** Another device is shown whole; what is drawn on does not jump. */
    #fit() {
        const name = this.root.attributes.get("name")?.value;
        if (name === this.fitted || !this.stage.clientWidth) return;
        this.fitted = name;
        if (this.alone) {
            const all = [...this.places.shapes().flatMap((x) => x.rings.flat()), ...this.list.filter((x) => x.always && x.look !== "tip").map((x) => x.at)];
            const ends = (k) => [Math.min(...all.map((p) => p[k]), EMPTY[k]), Math.max(...all.map((p) => p[k]), EMPTY[k + 2])];
            const [[x0, x1], [y0, y1]] = [ends(0), ends(1)];
            this.view.box = [x0, y0, x1, y1];
        }
        this.view.fit();
    }

    #paint(places, list) {
        const faulty = this.#faulty();
        const body = list.find((x) => x.id === this.chosen)?.body;
        this.sketch.replaceChildren(...places.shapes().map((x) => s("path", {
            d: x.rings.map(path).join(""), "data-body": x.body,
            class: `sketch-shape${x.hole ? " hole" : ""}${x.body === body ? " chosen" : ""}${marked(faulty.get(x.element) ?? faulty.get(places.bodies.get(x.body)))}`,
        })));
        this.sketch.append(...this.#lines(places).map((x) => s("path", { d: `M${x.points.map((p) => p.map((v) => v.toFixed(3)).join(" ")).join("L")}`, class: `sketch-line ${x.kind}` })));
        const focus = document.activeElement?.closest?.(".draw-handle")?.dataset.id;
        const above = (x) => Number(x.look === "hinge"); // where a body's origin is in its hinge, the hinge is what is taken
        const shown = list.filter((x) => x.always || x.id === this.chosen || (body && x.body === body)).sort((a, b) => above(a) - above(b));
        const stop = shown.find((x) => x.id === this.chosen) ?? shown[0];
        this.handles.replaceChildren(...shown.map((x) => {
            const fault = faulty.get(x.element);
            const words = fault?.words;
            const g = s("g", {
                class: `draw-handle ${x.look}${x.id === this.chosen ? " chosen" : ""}${marked(fault)}`, "data-id": x.id, role: "button", tabindex: x === stop ? 0 : -1,
                "aria-label": `${x.label}, x ${um(x.at[0])}, y ${um(x.at[1])}${words ? `; ${words}` : ""}`, "aria-pressed": String(x.id === this.chosen),
            }, s("circle", { r: 12, class: "reach" }), LOOKS[x.look](), s("title", {}, words ? `${x.label}: ${words}` : x.label), words ? s("text", { class: "fault", x: 8, y: -6 }, "!") : null);
            g.at = x.at;
            g.from = x.turns ? x.turns(places) : null;
            return g;
        }));
        this.arrows = list.filter((x) => x.turns).map((x) => ({ from: x.turns(places), to: x.at }));
        this.#place();
        if (focus) this.#handle(focus)?.focus({ preventScroll: true });
    }

    /** Cables, springs and rods as lines. */
    #lines(places) {
        const pairs = places.joints.filter((e) => e.name === "spring" || e.name === "distance").map((e) => ({ kind: e.name, points: places.ends(e).map((x) => places.at(x)) }));
        const cables = (places.scene(this.#scene())?.children ?? []).filter((e) => e.name === "tendon")
            .map((e) => ({ kind: "cable", points: e.children.map((c) => places.at(places.point(c, ["x", "y"], (p) => p.frame(p.text(c, "on"))))) }));
        return [...pairs, ...cables].filter((x) => x.points.length > 1 && x.points.flat().every(Number.isFinite));
    }

    #scene() {
        return state.options.scene ?? state.preview?.motion?.scene ?? "";
    }

    #handle(id) {
        return [...this.handles.children].find((g) => g.dataset.id === id);
    }

    /** Elements that a mistake or a warning of the present text is about: element -> {words, bad}. */
    #faulty() {
        const out = new Map();
        if (state.answered !== requestKey() || !this.root) return out;
        const lines = state.text.split("\n");
        for (const d of state.diagnostics) {
            if (d.severity === "note" || d.in_text === false || !d.line || d.line > lines.length) continue;
            const before = lines.slice(0, d.line - 1).reduce((n, x) => n + x.length + 1, 0);
            const e = elementAt(this.root, before + Math.max(d.column - 1, 0));
            const bad = d.severity === "error";
            if (e && e !== this.root && (!out.has(e) || (bad && !out.get(e).bad))) out.set(e, { words: d.message, bad });
        }
        return out;
    }

    #place() {
        const { view } = this;
        for (const g of this.handles.children) {
            const [x, y] = g.from ? this.#tip(g.from, g.at)[1] : view.toScreen(...g.at);
            g.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
        }
        const step = this.grid === "" ? gridStep(view.k) : Number(this.grid);
        this.lines.setAttribute("d", step ? this.#grid(step) : "");
        const arrows = (this.arrows ?? []).map((a) => {
            const [p, q] = this.#tip(a.from, a.to);
            return `M${p.map((v) => v.toFixed(1)).join(" ")}L${q.map((v) => v.toFixed(1)).join(" ")}`;
        });
        this.stems ??= this.view.overlay.insertBefore(s("path", { class: "tip-stem", "aria-hidden": "true" }), this.handles);
        this.stems.setAttribute("d", arrows.join(""));
        if (this.drawing) this.#rubber();
    }

    /** Where an arrow begins and ends on the screen: as long at any scale, and shorter where its handle would be out of the picture. */
    #tip(from, to) {
        const [p, end] = [this.view.toScreen(...from), this.view.toScreen(...to)];
        const long = Math.hypot(end[0] - p[0], end[1] - p[1]);
        const q = long > 0 ? p.map((v, k) => v + ((end[k] - v) * TIP_PIXELS) / long) : end; // `to` is of the scale that it was made at
        let share = 1;
        this.view.size.forEach((size, k) => {
            const way = q[k] - p[k];
            const end = Math.min(Math.max(q[k], TIP_MARGIN), size - TIP_MARGIN);
            if (end !== q[k] && p[k] > 0 && p[k] < size) share = Math.min(share, (end - p[k]) / way);
        });
        share = Math.max(share, TIP_LEAST); // it does not lie on the load itself
        return [p, q.map((v, k) => p[k] + share * (v - p[k]))];
    }

    #grid(step) {
        const [w, hgt] = this.view.size;
        const each = step * (step * this.view.k < 20 ? 5 : 1);
        if (each * this.view.k < 5) return "";
        const [x0, y0] = this.view.toWorld(0, hgt);
        const [x1, y1] = this.view.toWorld(w, 0);
        let d = "";
        for (let x = Math.ceil(x0 / each) * each; x <= x1; x += each) d += `M${x.toFixed(3)} ${y0.toFixed(2)}V${y1.toFixed(2)}`;
        for (let y = Math.ceil(y0 / each) * each; y <= y1; y += each) d += `M${x0.toFixed(2)} ${y.toFixed(3)}H${x1.toFixed(2)}`;
        return d;
    }

    // ---- tools ----

    #toolbar() {
        const tools = [{ id: null, label: "Select", icon: "cursor" }, ...TOOLS];
        this.buttons = tools.map((t) => button(t.label, { icon: t.icon, class: "small draw-tool", "data-tool": t.id ?? "select", "aria-pressed": String(t.id === null), tabIndex: t.id === null ? 0 : -1 }, () => this.#use(t.id)));
        this.bar.append(...this.buttons);
        this.stage.append(h("div", { class: "stage-tools" }, select("Grid", GRIDS, "", (v) => {
            this.grid = v;
            this.#place();
        })));
        this.bar.addEventListener("keydown", (e) => {
            const shown = this.buttons.filter((b) => !b.hidden);
            const at = shown.indexOf(document.activeElement);
            const next = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: shown.length - 1 }[e.key];
            if (at < 0 || next === undefined) return;
            e.preventDefault();
            shown[(next + shown.length) % shown.length].focus();
        });
    }

    #use(id) {
        this.#cancel();
        this.tool = TOOLS.find((t) => t.id === id) ?? null;
        for (const b of this.buttons) {
            const on_ = b.dataset.tool === (id ?? "select");
            b.setAttribute("aria-pressed", String(on_));
            b.tabIndex = on_ ? 0 : -1;
        }
        this.stage.classList.toggle("tool-on", this.tool !== null);
        this.panelOf = null;
        this.#refresh();
    }

    #context() {
        const raw = this.values[this.tool.id];
        const values = Object.fromEntries(this.tool.fields.map((f) => [f.key, f.unit !== undefined && !f.optional ? Number(raw[f.key]) : raw[f.key]]));
        return { places: this.places, values, within: TOUCH_PIXELS / this.view.k, scene: this.#scene(), on: this.on };
    }

    async #make(points) {
        this.#read();
        const made = this.tool.make(this.#context(), points);
        this.#clear();
        if (made.refuse) {
            emit("notice", { kind: "warn", text: made.refuse });
            return announce(made.refuse);
        }
        const before = state.text;
        await edit(made.changes, `${this.tool?.label ?? "it"} drawn`);
        if (state.text === before) return;
        this.chosen = null;
        this.#refresh();
        const e = [...walk(this.root)].findLast((x) => x.path === made.changes.at(-1).add || (made.id && x.id === made.id));
        const id = this.list.find((x) => x.element === e || (made.id && x.element.id === made.id && x.element.name !== "flexure"))?.id ?? null;
        if (id) this.#choose(id);
    }

    #clear() {
        this.points = [];
        this.on = [];
        this.drawing = null;
        this.guides.replaceChildren();
        this.dimension.classList.add("none");
    }

    #cancel() {
        if (this.drag?.handle) holdTogether(new Map(), this.drag.held.keys());
        this.drag = null;
        this.#clear();
        if (this.visible) this.#refresh();
    }

    // ---- the pointer ----

    #snapped(event, without = []) {
        const p = this.view.at(event);
        const last = this.points.at(-1); // a point is not drawn onto the one before it
        const others = [...this.list.filter((x) => !without.includes(x.element) && !["tip", "side"].includes(x.look)).map((x) => x.at), ...this.points].filter((q) => !last || far(q, last) > 0);
        return snap(p, others, { k: this.view.k, grid: this.grid === "" ? undefined : Number(this.grid), free: event.altKey });
    }

    #pointer() {
        const { svg } = this.view;
        svg.addEventListener("pointerdown", (e) => this.#down(e), { capture: true });
        svg.addEventListener("pointermove", (e) => this.#move(e));
        svg.addEventListener("pointerup", (e) => this.#up(e));
        svg.addEventListener("pointercancel", () => this.#cancel());
        svg.addEventListener("dblclick", () => this.tool?.points === null && this.#enough() && this.#finish());
    }

    /** A notice that comes or goes moves the picture on the screen: while something is dragged it stays under the pointer. */
    #still() {
        const { left, top } = this.view.svg.getBoundingClientRect();
        if (this.origin && (left !== this.origin[0] || top !== this.origin[1])) this.view.move(this.origin[0] - left, this.origin[1] - top);
        this.origin = [left, top];
    }

    #down(event) {
        if (event.button !== 0 || !this.places) return;
        this.#refresh(); // a move that is on its way to the text counts: what is taken up now stands where it is seen
        if (!this.points.length) this.origin = null;
        this.#still();
        if (this.tool) {
            event.preventDefault();
            this.view.fitted = false; // the place under the pointer stays there
            document.activeElement?.blur(); // what is typed is taken
            this.view.svg.setPointerCapture(event.pointerId);
            this.#read();
            return this.#begin(event);
        }
        const target = event.target.closest(".draw-handle");
        const p = this.view.at(event);
        const body = target ? null : this.places.bodiesAt(p, 2 / this.view.k)[0];
        const id = target?.dataset.id ?? this.list.find((x) => x.look === "cross" && x.body === body && ["body", "platform"].includes(x.element.name))?.id;
        if (!id) {
            if (this.chosen) this.#choose(null);
            return; // the picture is panned
        }
        event.preventDefault();
        this.view.svg.setPointerCapture(event.pointerId);
        const handle = this.list.find((x) => x.id === id);
        this.drag = { at: [event.clientX, event.clientY], grip: target ? [0, 0] : [p[0] - handle.at[0], p[1] - handle.at[1]], candidate: handle, held: new Map() };
        this.#choose(id);
        this.#handle(id)?.focus({ preventScroll: true });
    }

    /** What is kept of a point beside its place: of an eyelet the body, of an outline's corner how one comes to it. */
    #goesOn() {
        const values = this.values[this.tool.id];
        return this.tool.closes ? values.side : values.body;
    }

    #begin(event) {
        const { at } = this.#snapped(event);
        if (this.tool.points === null) {
            if (this.points.length && far(this.points.at(-1), at) * this.view.k < CLICK_PIXELS) return; // the second of a double click
            if (this.tool.closes && this.#enough() && far(this.points[0], at) * this.view.k < CLICK_PIXELS) return this.#finish();
            this.points.push(at);
            this.on.push(this.#goesOn());
        } else {
            this.points.push(at);
            this.drag = { at: [event.clientX, event.clientY], drawing: true };
        }
        this.drawing = { at };
        this.#rubber(this.#snapped(event));
        this.#panel();
    }

    #move(event) {
        if (this.tool) {
            if (!this.list || event.pointerType === "touch" && !this.drag) return;
            if (this.points.length) this.#still();
            const snapped = this.#snapped(event);
            this.drawing = { at: snapped.at };
            return this.#rubber(snapped);
        }
        const d = this.drag;
        if (!d) return;
        if (!d.handle) {
            if (Math.hypot(event.clientX - d.at[0], event.clientY - d.at[1]) < CLICK_PIXELS) return;
            d.handle = d.candidate;
            this.view.fitted = false;
            this.#taken();
        }
        this.#still();
        const p = this.view.at(event);
        const grip = { altKey: event.altKey, clientX: event.clientX, clientY: event.clientY };
        const moving = this.#together(d.handle);
        const r = this.view.svg.getBoundingClientRect();
        const wanted = [p[0] - d.grip[0], p[1] - d.grip[1]];
        const [sx, sy] = this.view.toScreen(...wanted);
        const snapped = d.handle.look === "tip" ? { at: wanted, lines: [null, null] } : this.#snapped({ ...grip, clientX: sx + r.left, clientY: sy + r.top }, moving);
        this.#drag(snapped);
    }

    /** What is dragged, in the text as it is without the drag: at its beginning, and where the text has changed under it. */
    #taken() {
        const d = this.drag;
        d.of = state.text;
        this.#read(d.held.keys());
        this.list = this.#handlesOf(this.places);
        d.places = this.places;
        d.handle = this.list.find((x) => x.id === d.candidate.id) ?? d.candidate;
    }

    /** Elements that move with a handle: none of their points is a place to snap to. */
    #together(handle) {
        return [handle.element, ...handle.wants(this.drag.places, handle.at).map((w) => w.element), ...(handle.body && handle.element.name === "body" ? handle.element.children.flatMap((c) => [c, ...c.children]) : [])];
    }

    #drag(snapped) {
        const d = this.drag;
        if (d.of !== state.text) this.#taken();
        const now = plan(d.places, d.handle, snapped.at);
        d.now = now;
        d.wanted = snapped.at;
        holdTogether(now.changes, d.held.keys());
        d.held = now.changes;
        const list = this.#handlesOf(now.places);
        this.live = { places: now.places, list };
        this.#paint(now.places, list);
        this.#values();
        const at = list.find((x) => x.id === d.handle.id)?.at ?? now.target;
        const [dx, dy] = [at[0] - d.handle.at[0], at[1] - d.handle.at[1]];
        const lines = d.handle.look === "tip" || d.handle.look === "side" || d.handle.part === "corner" ? this.#sizes(d.handle, now.places) : [`x ${um(at[0])}, y ${um(at[1])}`, `moved ${um(dx)}, ${um(dy)}`];
        if (now.locked.length) lines.push(`held: ${heldBy(now.locked)}`);
        this.#dimensions(at, lines);
        this.#guides(snapped, at);
    }

    /** What a handle of a size or of a direction changes, in words. */
    #sizes(handle, places) {
        return [handle.wants(places, handle.at).map((w) => `${w.attribute} ${places.text(w.element, w.attribute) ?? ""}`).join(", ")];
    }

    async #up(event) {
        if (this.tool) {
            const d = this.drag;
            this.drag = null;
            if (this.tool.points === null || !this.points.length) return;
            if (this.points.length < this.tool.points.length && d?.drawing && Math.hypot(event.clientX - d.at[0], event.clientY - d.at[1]) >= CLICK_PIXELS) this.points.push(this.#snapped(event).at);
            if (this.points.length >= this.tool.points.length) await this.#make(this.points.slice(0, this.tool.points.length));
            return;
        }
        const d = this.drag;
        this.drag = null;
        this.live = null;
        if (!d?.handle) return;
        this.#clear();
        if (d.held.size && ![...d.held.keys()].some((path) => path in state.set)) return this.#refresh(); // it was taken while it was held
        if (d.of !== state.text) {
            this.drag = d;
            this.#taken();
            this.drag = null;
            d.now = plan(d.places, d.handle, d.wanted);
            holdTogether(d.now.changes, d.held.keys());
        }
        await this.#commit(d.handle, d.now, d.wanted);
    }

    async #commit(handle, now, wanted) {
        const why = await letGoTogether(now.changes, `${handle.label} moved`);
        this.#refresh();
        const short = Math.max(Math.abs(wanted[0] - now.target[0]), Math.abs(wanted[1] - now.target[1]));
        if (!now.locked.length || short * this.view.k < CLICK_PIXELS) return why;
        const names = [...new Set(now.locked.map((w) => `${w.attribute} of ${w.element.name}${w.element.id ? ` ${w.element.id}` : ""}`))];
        emit("notice", {
            kind: "warn", stay: true, text: `${handle.label} is held by what is written: ${heldBy(now.locked)}. Change what the formula uses, or let numbers take its place.`,
            actions: [[`Replace ${names.length === 1 ? names[0] : `${names.length} formulas`} by numbers`, async () => {
                this.#read();
                const again = this.#handlesOf(this.places).find((x) => x.id === handle.id);
                if (!again) return;
                const loose = plan(this.places, again, wanted, { loose: true });
                await letGoTogether(loose.changes, `${handle.label} moved`);
            }]],
        });
        return why;
    }

    // ---- what is seen while drawing ----

    #rubber(snapped) {
        const at = this.drawing?.at;
        if (!at || !this.tool) return;
        const all = [...this.points, at];
        const screen = all.map((p) => this.view.toScreen(...p));
        const [p, q] = [all[0], at];
        const marks = screen.map(([x, y]) => s("circle", { cx: x, cy: y, r: 3.5, class: "rubber-point" }));
        const shape = this.tool.closes && all.length > 1 ? `M${this.#sides(all).map((v) => this.view.toScreen(...v).join(" ")).join("L")}` : this.tool.id === "plate" || this.tool.id === "workspace" ? `M${screen[0]}L${screen[0][0]} ${screen.at(-1)[1]}L${screen.at(-1)}L${screen.at(-1)[0]} ${screen[0][1]}Z` : `M${screen.map((v) => v.join(" ")).join("L")}`;
        this.guides.replaceChildren(...(snapped ? this.#guideLines(snapped, at) : []), s("path", { d: all.length > 1 ? shape : "", class: "rubber" }),
            this.tool.id === "disc" && all.length > 1 ? s("circle", { cx: screen[0][0], cy: screen[0][1], r: far(p, q) * this.view.k, class: "rubber" }) : "", ...marks);
        const last = this.points.at(-1);
        const d = last ? [at[0] - last[0], at[1] - last[1]] : null;
        this.#dimensions(at, !d ? [`x ${um(at[0])}, y ${um(at[1])}`]
            : this.tool.id === "plate" || this.tool.id === "workspace" ? [`${um(Math.abs(d[0]))} × ${um(Math.abs(d[1]))}`]
                : [`${um(Math.hypot(...d))}, ${number((Math.atan2(d[1], d[0]) * 180) / Math.PI, 4)}°`, `${um(d[0])}, ${um(d[1])}`]);
        this.#fill(all);
    }

    /** The outline so far, with its arcs as far as they are known. */
    #sides(all) {
        const [first, ...rest] = sidesOf(all, [...this.on, this.#goesOn()]).filter((side, i, list) => i < list.length - 1 || side.to !== all[0] || side.over);
        let before = all[0];
        return [before, ...[first, ...rest].filter(Boolean).flatMap(({ over, to }) => {
            const arc = over && to !== over ? arcOver(before, over, to) : null;
            const part = arc ? arc.points : over ? [over, to] : [to];
            before = to;
            return part;
        })];
    }

    #guideLines(snapped, at) {
        const [w, hgt] = this.view.size;
        const [x, y] = this.view.toScreen(...at);
        return [snapped.lines?.[0] ? s("path", { d: `M${x} 0V${hgt}`, class: "guide-line" }) : "", snapped.lines?.[1] ? s("path", { d: `M0 ${y}H${w}`, class: "guide-line" }) : "",
            snapped.point ? s("circle", { cx: x, cy: y, r: 10, class: "guide-ring" }) : ""].filter(Boolean);
    }

    #guides(snapped, at) {
        this.guides.replaceChildren(...this.#guideLines(snapped, at));
    }

    #dimensions(at, lines) {
        const [x, y] = this.view.toScreen(...at);
        const [w] = this.view.size;
        const [back, text] = this.dimension.children;
        const most = Math.min(70, Math.floor((w - 24) / 6.3)), said = lines.filter(Boolean);
        text.replaceChildren(...said.map((t, i) => s("tspan", { x: 7, dy: i ? 15 : 0 }, t.length > most ? `${t.slice(0, most - 1)}…` : t)));
        this.dimension.classList.remove("none"); // what is not shown has no length
        const width = 14 + Math.max(...[...text.children].map((t) => t.getComputedTextLength()));
        back.setAttribute("width", width.toFixed(1));
        back.setAttribute("height", 5 + 15 * said.length);
        this.dimension.setAttribute("transform", `translate(${Math.max(Math.min(x + 16, w - width - 4), 2).toFixed(1)} ${Math.max(y - 26 - 15 * said.length, 2).toFixed(1)})`);
    }

    // ---- keys ----

    #keys() {
        this.stage.addEventListener("keydown", (e) => {
            const id = e.target.closest?.(".draw-handle")?.dataset.id;
            if (this.#key(e, id)) {
                e.preventDefault();
                e.stopPropagation();
            }
        }, { capture: true });
        document.addEventListener("keydown", (e) => {
            if (!this.visible) return;
            if (e.key === "Enter" && this.tool?.points === null && this.#enough() && !e.target.closest?.("input, select, button, .editor")) this.#finish();
            if (e.key === "Escape" && (this.drag || this.points.length)) {
                this.#cancel();
                announce("given up");
            }
        });
        this.handles.addEventListener("focusin", (e) => {
            const id = e.target.closest(".draw-handle")?.dataset.id;
            if (id && id !== this.chosen && !this.drag) this.#choose(id);
        });
    }

    #key(event, id) {
        if (event.ctrlKey || event.metaKey) return false;
        if (event.key === "Escape") {
            if (this.drag || this.points.length) return false; // given up by the page's own
            if (this.tool) this.#use(null);
            else this.#choose(null);
            return true;
        }
        if (!id) return false;
        const step = (event.shiftKey ? 10 : 1) * (this.grid === "" ? 5 : Number(this.grid) || 1);
        const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
        const handle = this.list.find((x) => x.id === id);
        if (by && handle) return this.#step(handle, by), true;
        if (event.key === "Delete" || event.key === "Backspace") return this.#remove(handle.element), true;
        const other = { PageDown: 1, PageUp: -1 }[event.key];
        if (!other) return false;
        const all = [...this.handles.children];
        const next = all[(all.findIndex((g) => g.dataset.id === id) + other + all.length) % all.length];
        this.#choose(next.dataset.id);
        this.#handle(next.dataset.id)?.focus();
        return true;
    }

    async #step(handle, by) {
        const turned = handle.turns ? (by[0] + by[1] > 0 ? 1 : -1) * (Math.abs(by[0] + by[1]) >= 50 ? 10 : 1) * (Math.PI / 180) : 0;
        const about = turned ? handle.turns(this.places) : null;
        const target = about ? turn(handle.at, about, turned) : [handle.at[0] + by[0], handle.at[1] + by[1]];
        await this.#goto(handle, target);
    }

    async #goto(handle, target) {
        const now = plan(this.places, handle, target);
        holdTogether(now.changes); // the next step begins where this one ends, also before it is in the text
        this.#refresh();
        const why = await this.#commit(handle, now, target);
        const at = this.list.find((x) => x.id === handle.id)?.at;
        if (at) announce(`${handle.label}: x ${um(at[0])}, y ${um(at[1])}`);
        return why;
    }

    #enough() {
        return this.points.length >= (this.tool.least ?? 2);
    }

    #finish() {
        return this.#make(this.points);
    }

    async #remove(element) {
        const { changes, count } = removing(this.places, element);
        this.chosen = null;
        const words = `${element.name} ${element.id ?? ""} removed${count > 1 ? `, and ${count - 1} more that needed it` : ""}`;
        await edit(changes, words);
        if (count > 1) emit("notice", { kind: "info", text: `${words}. One undo brings all of it back.` });
    }

    #choose(id) {
        if (id === this.chosen && id !== null) return;
        this.chosen = id;
        this.panelOf = null;
        this.#paint(this.places, this.list);
        this.#panel();
        const e = this.list.find((x) => x.id === id)?.element;
        if (e && ["revolute", "hinge"].includes(e.name) && e.id !== state.hinge) lookAt(e.id);
    }

    // ---- the panel beside the picture ----

    #panel() {
        if (!this.visible || !this.places) return;
        for (const [i, b] of this.buttons.entries()) b.hidden = Boolean(TOOLS[i - 1]?.sixBar) && !this.places.sixBar;
        const handle = this.list.find((x) => x.id === this.chosen);
        const key = this.tool ? `tool ${this.tool.id}` : handle ? `${handle.id} ${this.#facts(handle).map(([, a]) => a).join()}` : "nothing";
        if (key !== this.panelOf) {
            this.panelOf = key;
            this.fields = [];
            this.side.replaceChildren(...(this.tool ? this.#toolPanel() : handle ? this.#handlePanel(handle) : this.#partsPanel()));
        }
        this.#values();
    }

    /** What the panel tells of the chosen part; while it is dragged, where it is now. */
    #values() {
        for (const f of this.fields ?? []) f();
    }

    /** path: where it changes the text, and commit returns the promise of why not, or of null. */
    #number(label, unit, value, commit, path = null) {
        const input = h("input", { type: "number", step: "any", "aria-label": unit ? `${label}, ${unit}` : label });
        if (path === null) input.addEventListener("change", () => Number.isFinite(input.valueAsNumber) && commit(input.valueAsNumber));
        else enter(input, path, () => String(value()), async (v) => (v !== "" && Number.isFinite(Number(v)) ? commit(Number(v)) : refuse("a number is needed")));
        this.fields.push(() => {
            if (path !== null) show(input, path, String(value()));
            else if (document.activeElement !== input) input.value = value();
        });
        return h("label", { class: "pose-field" }, h("span", {}, unit ? `${label} (${unit})` : label), input);
    }

    #choice(label, options, value, commit) {
        const box = select(label, options(), value(), commit);
        this.fields.push(() => setOptions(box, options(), value()));
        return h("label", { class: "pose-field" }, h("span", {}, label), box);
    }

    #bodyOptions(f) {
        const ids = [...this.places.bodies.keys()];
        return [["", f.bodies], ...(f.bodies.includes("or a new one") ? [["new", "a new body"]] : []), ...(f.ground ? [["ground", "the ground"]] : []), ...ids.map((id) => [id, id])];
    }

    #toolPanel() {
        const { tool } = this;
        const values = this.values[tool.id];
        const fields = h("div", { class: "draw-fields" });
        const again = () => {
            this.panelOf = null;
            this.#panel();
        };
        for (const f of tool.fields) {
            if (f.when && !f.when(values)) continue;
            const set = (v) => {
                values[f.key] = v;
                if (f.key === "kind" || f.flexures) again();
            };
            if (f.bodies) fields.append(this.#choice(f.label, () => this.#bodyOptions(f), () => values[f.key], set));
            else if (f.flexures) fields.append(this.#choice(f.label, () => [["", "a new one, or one alike"], ...this.root.children.filter((e) => e.name === "flexure" && e.id).map((e) => [e.id, `${e.id} (${e.attributes.get("kind")?.value ?? "?"})`])], () => values.flexure, set));
            else if (f.choices) fields.append(this.#choice(f.label, () => f.choices.map((c) => [c, c]), () => values[f.key], set));
            else fields.append(this.#number(f.label, f.unit === "um" ? "µm" : f.unit === "uN" ? "µN" : f.unit === "deg" ? "°" : f.unit, () => values[f.key], set));
        }
        return [h("section", { class: "card" }, h("h2", {}, tool.label), h("p", { class: "doc" }, tool.words), fields), this.#byNumbers(tool)];
    }

    /** The same without a pointer: its points as numbers. */
    #byNumbers(tool) {
        this.typed = [[0, 0], [0, 0]];
        const names = tool.points ?? [tool.closes ? "next corner" : "next eyelet"];
        this.inputs = names.map((name) => ["x", "y"].map((axis) => h("input", { type: "number", step: "any", value: 0, "aria-label": `${name}, ${axis}, µm` })));
        const add = button(tool.points ? "Add" : `Add ${tool.closes ? "corner" : "eyelet"}`, { class: "small draw-add" }, () => {
            const points = this.inputs.map((pair) => pair.map((input) => input.valueAsNumber || 0));
            if (tool.points) return this.#make(points);
            this.points.push(points[0]);
            this.on.push(this.#goesOn());
            this.drawing = { at: points[0] };
            this.#rubber();
        });
        return h("section", { class: "card" }, h("h2", {}, "By numbers"),
            h("div", { class: "draw-points" }, names.map((name, i) => [h("span", {}, `${name} (µm)`), ...this.inputs[i]])),
            h("div", { class: "row" }, add, tool.points ? null : button("Finish", { class: "small" }, () => this.#enough() && this.#finish())),
            h("p", { class: "doc" }, "Escape gives up. With Alt nothing is snapped."));
    }

    /** The numbers follow the pointer. */
    #fill(points) {
        if (!this.inputs || this.side.contains(document.activeElement)) return;
        const shown = this.tool.points ? points : points.slice(-1);
        shown.slice(0, this.inputs.length).forEach((p, i) => p.forEach((v, k) => (this.inputs[i][k].value = Number(v.toFixed(3)))));
    }

    /** Attributes of an element, and of a hinge's flexure, that are values and no places: [element, attribute]. */
    #facts(handle) {
        const places = this.places;
        const own = (e) => [...e.attributes.keys()].filter((a) => !/^(x|y|to-[xy]|[ab]-[xy]|start-[xy]|plate-[xy]|id|at|kind|name|law|on|a|b|hinge|flexure|symmetry|hole|mirror|ends)$/.test(a) && Number.isFinite(places.si(e, a, NaN))).map((a) => [e, a]);
        const e = handle.element.name === "eyelet" ? [...walk(this.root)].find((t) => t.children.includes(handle.element)) : handle.element;
        const id = places.text(e, "hinge") ?? places.text(e, "flexure");
        const flexure = id && this.root.children.find((x) => x.name === "flexure" && x.id === id);
        const bulge = flexure && e.name === "revolute" && !e.attributes.has("axis") ? [[e, "axis"]] : []; // where none is stated one may be
        return [...own(e), ...bulge, ...(flexure ? own(flexure) : [])];
    }

    #handlePanel(handle) {
        const now = () => (this.live?.list ?? this.list).find((x) => x.id === handle.id) ?? handle;
        const sized = ["side", "tip"].includes(handle.look) || handle.part === "corner";
        const places = h("div", { class: "pose-fields" }, sized ? [] : [0, 1].map((k) => this.#number("xy"[k], "µm", () => Number(now().at[k].toFixed(3)), (v) => this.#goto(now(), now().at.map((w, i) => (i === k ? v : w))), `${DRAWN}${handle.id} ${"xy"[k]}`)));
        const facts = this.#facts(handle).map(([e, attribute]) => {
            const other = e !== handle.element;
            const input = h("input", { autocomplete: "off", spellcheck: false });
            const bulge = e.name === "revolute" && attribute === "axis";
            const label = bulge ? "bulges to" : `${attribute}${other ? ` of ${e.name} ${e.id ?? ""}` : ""}`;
            input.setAttribute("aria-label", label);
            if (bulge) input.placeholder = "chosen by the layout";
            const path = `${e.path}/@${attribute}`;
            const present = () => (this.live?.places ?? this.places).text([...walk(this.root)].find((x) => x.path === e.path) ?? e, attribute) ?? "";
            const written = (value) => (!bulge ? value : value.trim() === "" ? null : /^[-+.\d]+$/.test(value.trim()) ? `${value.trim()} deg` : value);
            enter(input, path, present, (value) => edit([{ path, value: written(value) }], `${label} is ${value}`));
            this.fields.push(() => show(input, path, present()));
            return h("label", { class: "pose-field" }, h("span", {}, label), input);
        });
        const fault = h("p", { class: "pose-status bad", role: "status", hidden: true });
        this.fields.push(() => {
            const words = this.#faulty().get(now().element)?.words ?? "";
            fault.textContent = words;
            fault.hidden = words === "";
        });
        return [h("section", { class: "card" }, h("h2", {}, handle.label), fault, places, h("div", { class: "draw-fields" }, facts), this.#imagePanel(handle),
            h("div", { class: "row" }, button("All of it in the form", { class: "small", icon: "open" }, () => emit("show-form", now().element.path)),
                button("Remove", { class: "small draw-remove", icon: "close" }, () => this.#remove(now().element)))), this.#parts()];
    }

    /** A shape's own choices, and the mirrored copy of a body. */
    #imagePanel(handle) {
        const out = [];
        const e = handle.element;
        const shape = ["plate", "disc", "outline", "bar"].includes(e.name) ? e : null;
        if (shape) {
            const now = (a, usual) => this.places.text(this.list.find((x) => x.id === handle.id)?.element ?? shape, a) ?? usual;
            if (shape.name !== "bar") out.push(h("div", { class: "draw-fields" },
                this.#choice("mirror image too", () => [["none", "no"], ["x", "y with the other sign"], ["y", "x with the other sign"], ["both", "both"]], () => now("symmetry", "none"), (v) => edit([{ path: `${shape.path}/@symmetry`, value: v }], `mirror image: ${v}`)),
                this.#choice("cut out", () => [["no", "no"], ["yes", "yes"]], () => now("hole", "no"), (v) => edit([{ path: `${shape.path}/@hole`, value: v }], `cut out: ${v}`))));
        }
        const body = e.name === "body" ? e.id : handle.body;
        if (this.places.bodies.get(body)?.name !== "body") return out;
        this.mirror ??= { axis: "x", at: 0 };
        const field = this.#number("about", "µm", () => this.mirror.at, (v) => (this.mirror.at = v));
        out.push(h("details", { class: "reasons draw-mirror", open: this.mirror.open, ontoggle: (ev) => (this.mirror.open = ev.target.open) }, h("summary", {}, `Mirrored copy of ${body}`),
            h("p", { class: "doc" }, "With its shapes, the hinges that hold it, and the loads on it."),
            h("div", { class: "draw-fields" }, this.#choice("to", () => [["x", "left and right"], ["y", "above and below"]], () => this.mirror.axis, (v) => (this.mirror.axis = v)), field),
            h("div", { class: "row" }, button("Make the copy", { class: "small draw-copy", icon: "versions" }, () => this.#mirrored(body)))));
        return out;
    }

    async #mirrored(body) {
        this.#read();
        const made = makeMirrored(this.places, body, this.mirror);
        if (made.refuse) return emit("notice", { kind: "warn", text: made.refuse });
        const before = state.text;
        await edit(made.changes, `${made.id} made, the mirror image of ${body}`);
        if (state.text === before) return;
        this.mirror.open = false; // a second click at the same place is no second copy
        if (made.left.length) emit("notice", { kind: "info", text: `${made.id}: what could not be mirrored was left out: ${made.left.join(", ")}.` });
        this.#refresh();
        this.#choose(this.list.find((x) => x.element.name === "body" && x.element.id === made.id)?.id ?? null);
    }

    /** All that can be chosen, for those who do not point. */
    #parts() {
        const options = () => [["", "choose…"], ...this.list.map((x) => [x.id, x.label])];
        return h("section", { class: "card" }, h("h2", {}, "Parts"), this.#choice("Part", options, () => this.chosen ?? "", (id) => {
            this.#choose(id || null);
        }));
    }

    #partsPanel() {
        const bare = this.places.bodies.size === 0;
        return [h("section", { class: "card" }, h("h2", {}, "Drawing"), h("p", { class: "doc" }, bare
            ? "Nothing is drawn yet. Begin with Link: a bar between two points. Then Hinge: where two links meet, or on a link to hold it on the ground. Force or Cable moves it."
            : "Drag a hinge, a load, or a body; click a body to see its corners. One drag is one undo. Escape gives up, Delete removes, Page Down goes to the next handle, arrow keys move one.")), this.#parts()];
    }
}

const turn = ([x, y], [cx, cy], by) => [cx + Math.cos(by) * (x - cx) - Math.sin(by) * (y - cy), cy + Math.sin(by) * (x - cx) + Math.cos(by) * (y - cy)];
