// SPDX-License-Identifier: GPL-3.0-or-later
// Masks: layers of the mask as it is written, the outlines as drawn, on the mask and as fabricated, a
// ruler, and what breaks a rule as a list that goes to the place. All in micrometres of the drawing.
import { get, request as fetchText } from "./api.js";
import { Shown } from "./belong.js";
import { button, h, s, select, setOptions } from "./dom.js";
import { bytes, number } from "./format.js";
import { fileOf, forceTick, hasFile, JobView, REJECTED, rejection } from "./jobs.js";
import { zoomButtons } from "./motion.js";
import { on, state } from "./store.js";
import { scaleBar, Viewport } from "./viewport.js";

const OVERLAYS = [["drawn", "as drawn"], ["mask", "on the mask"], ["body", "as fabricated"], ["band", "where the edge may stand"]];

export class Masks {
    constructor(holder) {
        this.stage = h("div", { class: "stage mask-stage" });
        this.side = h("div", { class: "side-panel" });
        holder.append(h("div", { class: "split" }, this.stage, this.side));
        this.svg = s("svg", { class: "mask-picture" });
        this.stage.append(this.svg);
        this.place = h("output", { class: "place-readout", "aria-label": "Place under the pointer" });
        this.tools = h("div", { class: "stage-tools" });
        this.ruler = button("Ruler", { icon: "ruler", class: "small", "aria-pressed": "false" }, () => this.#useRuler());
        this.tools.append(this.ruler);
        this.stage.append(zoomButtons(() => this.view), this.tools, this.place);
        this.view = new Viewport(this.svg, { label: "Mask: arrow keys pan, plus and minus zoom, 0 fits, r is the ruler", onview: () => this.#overlay() });
        this.drawing = s("g", { class: "drawing" });
        this.layers = s("g", { class: "layers" });
        this.outlines = s("g", { class: "outlines" });
        this.marks = s("g", { class: "violation-marks" });
        this.view.world.append(this.drawing, this.layers, this.outlines, this.marks);
        this.bar = s("g", { class: "scale-bar", "aria-hidden": "true" });
        this.measure = s("g", { class: "measure" });
        this.view.overlay.append(this.measure, this.bar);
        this.points = [];
        this.svg.addEventListener("pointermove", (e) => this.#hover(e));
        this.svg.addEventListener("click", (e) => this.#click(e));
        this.svg.addEventListener("keydown", (e) => {
            if (e.key === "r") this.#useRuler();
            if (e.key === "Escape") this.#clearRuler();
        });
        this.#panel();
        on("preview", () => this.visible && this.#drawn());
    }

    #panel() {
        this.flow = select("Flow", [], "", () => {
            this.chosen = this.flow.value;
            this.#draw();
        });
        this.cell = select("Cell", [["", "device"], ["-coupons", "test die"]], "", () => this.#draw());
        this.which = h("div", { class: "row", hidden: true }, this.flow, this.cell);
        const card = h("section", { class: "card" }, h("h2", {}, "Masks"), this.which);
        this.layerList = h("section", { class: "card", hidden: true });
        this.violations = h("section", { class: "card", hidden: true });
        this.files = h("section", { class: "card", hidden: true });
        this.side.append(card, this.violations, this.layerList, this.files);
        const force = forceTick(() => this.job);
        this.job = new JobView(card, {
            kind: "mask", action: "Make the masks", auto: true, options: force.options, intro: "GDSII, SVG and what every flow's design rules say.",
            accept: (job) => Array.isArray(job.result?.masks), render: (job) => this.#take(job),
        });
        card.append(force.label);
        this.job.also(this.stage, this.violations, this.layerList, this.files);
        this.drawn = new Shown(this.stage);
    }

    shown(yes) {
        this.visible = yes;
        this.job.show(yes);
        if (!yes) return;
        this.#drawn();
        this.paint?.();
    }

    /** The drawing of the preview: what is there before any mask is, and where there is none. */
    #drawn() {
        const p = state.preview;
        if (!p || this.stage.offsetParent === null) return;
        const paths = [];
        for (const b of p.bodies) {
            const [x, y, phi] = b.rest ?? [0, 0, 0];
            const transform = `translate(${x * 1e6} ${y * 1e6}) rotate(${(phi * 180) / Math.PI})`;
            for (const d of [...b.outline, ...(b.islands ?? []), ...(b.frame ?? []), ...(b.tethers ?? [])]) paths.push(s("path", { d, transform }));
        }
        this.drawn.take(state.previewOf);
        this.drawing.replaceChildren(...paths, ...p.flexures.map((f) => s("path", { d: f.path })));
        if (!this.box) this.#fitTo(p.box_um);
        if (!this.result) this.#offer(p.flows.map((f) => [f.name, f.name]), p.flows[0]?.name);
    }

    /** Flows to choose from; which one it is unless a person chose. An empty box to choose from would ask for nothing. */
    #offer(flows, first) {
        setOptions(this.flow, flows, flows.some(([id]) => id === this.chosen) ? this.chosen : first);
        this.which.hidden = flows.length === 0;
    }

    #fitTo(box) {
        if (box) this.view.setBox(box);
    }

    async #take(job) {
        this.result = job.result;
        this.done = job;
        const flows = [...new Set([...job.result.masks.map((m) => m.flow), ...(job.result.violations ?? []).map((v) => v.flow)])];
        const broken = (f) => (job.result.violations ?? []).find((v) => v.flow === f)?.findings.length ?? 0;
        this.#offer(flows.map((f) => [f, broken(f) ? `${f}: ${broken(f)} broken` : f]), flows.find(broken) ?? flows[0]);
        await this.#draw();
    }

    async #draw() {
        if (!this.done) return;
        const job = this.done;
        const name = `${this.flow.value}${this.cell.value}`;
        const mask = this.result.masks.find((m) => m.flow === this.flow.value && (this.cell.value === "-coupons") === Boolean(m.coupons));
        const found = (this.result.violations ?? []).find((v) => v.flow === this.flow.value)?.findings ?? mask?.findings ?? [];
        const read = (path) => (hasFile(job, path) ? fetchText("GET", fileOf(job, path), undefined, { as: "text" }).catch(() => null) : null);
        const [layers, outlines, coupons] = await Promise.all([read(`masks/${name}.svg`), this.cell.value ? null : read(`masks/${name}.outlines.svg`),
            this.cell.value && hasFile(job, `masks/${name}.json`) ? get(fileOf(job, `masks/${name}.json`)) : null]);
        if (job !== this.done) return;
        this.paint = () => {
            this.paint = null;
            this.#layers(layers, coupons ?? mask);
            this.#outlines(outlines, mask);
        };
        if (this.stage.offsetParent !== null) this.paint(); // what is not laid out has no boxes: it is drawn when it is seen
        this.#violations(this.cell.value ? [] : found, mask !== undefined || found.length > 0);
        this.#files(job, name, mask);
        const box = (coupons ?? mask)?.extent_um;
        this.box = box ?? null;
        this.drawing.classList.toggle("alone", !layers);
        this.#fitTo(box ?? state.preview?.box_um);
    }

    #layers(text, mask) {
        this.layers.replaceChildren();
        this.layerList.hidden = !text;
        if (!text) return;
        const picture = new DOMParser().parseFromString(text, "image/svg+xml");
        const boxes = new Map((mask?.layers ?? []).map((l) => [l.gds, l.box_nm]));
        const rows = [];
        let shift = null;
        for (const g of picture.querySelectorAll("g[data-gds]")) {
            const layer = s("g", { fill: g.getAttribute("fill"), "data-gds": g.getAttribute("data-gds"), "fill-rule": "evenodd" }, shapesOf(picture, g));
            this.layers.append(layer);
            const title = [...g.children].find((c) => c.localName === "title")?.textContent ?? g.id;
            const box = boxes.get(g.getAttribute("data-gds"));
            if (!shift && box && layer.childElementCount) shift = shiftOf(layer.getBBox(), box);
            const tick = h("input", { type: "checkbox", checked: true });
            tick.addEventListener("change", () => layer.classList.toggle("none", !tick.checked));
            rows.push(h("label", { class: "layer-row" }, tick, h("span", { class: "swatch", style: { background: g.getAttribute("fill") }, "aria-hidden": "true" }), h("span", { class: "gds" }, g.getAttribute("data-gds")), h("span", { class: "layer-name", title }, h("b", {}, title.split(": ")[0]), h("span", {}, title.split(": ").slice(1).join(": ")))));
        }
        if (shift) this.layers.setAttribute("transform", shift);
        this.layerList.replaceChildren(h("h2", {}, "Layers"), ...rows, this.#overlaySwitches());
    }

    #overlaySwitches() {
        this.shownOutlines ??= new Set(["drawn", "mask"]);
        return h("fieldset", { class: "overlays" }, h("legend", {}, "Outlines"), OVERLAYS.map(([id, label]) => {
            const tick = h("input", { type: "checkbox", checked: this.shownOutlines.has(id) });
            tick.addEventListener("change", () => {
                this.shownOutlines[tick.checked ? "add" : "delete"](id);
                this.#visibility();
            });
            return h("label", { class: "layer-row" }, tick, h("span", { class: `outline-key ${id}`, "aria-hidden": "true" }), h("span", {}, label));
        }));
    }

    #visibility() {
        for (const g of this.outlines.children) g.classList.toggle("none", !this.shownOutlines?.has(g.dataset.kind));
    }

    #outlines(text, mask) {
        this.outlines.replaceChildren();
        if (!text) return;
        const picture = new DOMParser().parseFromString(text, "image/svg+xml");
        let shift = null;
        for (const [id] of OVERLAYS) {
            const d = picture.querySelector(`defs path[id$="-${id}"]`)?.getAttribute("d");
            if (!d) continue;
            const path = s("path", { d, class: id, "fill-rule": "evenodd" });
            this.outlines.append(s("g", { "data-kind": id }, path));
            if (id !== "mask") continue;
            const b = path.getBBox();
            const layer = (mask?.layers ?? []).map((l) => l.box_nm).find((x) => x && Math.abs((x[2] - x[0]) / 1e3 - b.width) < 0.5 && Math.abs((x[3] - x[1]) / 1e3 - b.height) < 0.5);
            if (layer) shift = shiftOf(b, layer);
        }
        if (shift) this.outlines.setAttribute("transform", shift);
        else this.outlines.replaceChildren(); // not to be shown in a wrong place
        this.#visibility();
    }

    /** checked: rules were looked at; else why not. */
    #violations(list, checked) {
        this.violations.hidden = !this.done;
        this.marks.replaceChildren(...list.map((v, i) => s("g", { class: `mark ${v.severity}`, "data-i": i },
            s("rect", { x: v.box_um[0], y: v.box_um[1], width: v.box_um[2] - v.box_um[0], height: v.box_um[3] - v.box_um[1] }),
            s("line", { x1: v.at_um[0][0], y1: v.at_um[0][1], x2: v.at_um[1][0], y2: v.at_um[1][1] }))));
        const items = list.map((v, i) => h("li", { class: v.severity }, h("button", { type: "button", class: "jump violation", onclick: () => this.#jump(v, i) },
            h("span", { class: "place" }, `${number(v.at_um[0][0], 5)}, ${number(v.at_um[0][1], 5)}`),
            h("span", {}, v.needed ? `${v.what}: ${number(v.value, 3)} ${unit(v.unit)}, needs ${number(v.needed, 4)} ${unit(v.unit)}` : v.what),
            h("span", { class: "code" }, `${v.layer} · ${v.pieces.join(" and ")}`))));
        this.violations.replaceChildren(
            h("h2", {}, list.length ? `${list.length} ${list.length === 1 ? "place breaks" : "places break"} a rule` : "Design rules"),
            list.length ? h("ul", { class: "diagnostics" }, items) : h("p", { class: "empty" }, checked ? "No rule is broken." : this.#unmade()));
    }

    /** Why there is no mask, and so nothing that rules could be checked on. */
    #unmade() {
        return this.done.exit_status === REJECTED ? `No mask was made, so no rule was checked: the design is rejected. ${rejection()}` : `No mask was made, so no rule was checked. ${this.done.messages?.[0] ?? ""}`;
    }

    #jump(v, i) {
        const x = (v.at_um[0][0] + v.at_um[1][0]) / 2;
        const y = (v.at_um[0][1] + v.at_um[1][1]) / 2;
        const size = Math.max(v.value || 0, v.needed || 0, 4) * (v.unit === "um" ? 6 : 3);
        this.view.fitTo([x - size, y - size, x + size, y + size], 0.05);
        this.marks.querySelectorAll(".mark").forEach((g) => g.classList.toggle("chosen", g.dataset.i === String(i)));
        this.violations.querySelectorAll(".violation").forEach((b, k) => b.setAttribute("aria-current", String(k === i)));
    }

    #files(job, name, mask) {
        const list = (job.files ?? []).filter((f) => f.path.startsWith(`masks/${name}.`));
        this.files.hidden = !list.length;
        this.files.replaceChildren(h("h2", {}, "Files"),
            h("ul", { class: "file-list" }, list.map((f) => h("li", {}, h("a", { href: fileOf(job, f.path), download: f.path.split("/").at(-1) }, f.path.split("/").at(-1)), h("span", {}, bytes(f.bytes))))),
            hasFile(job, `masks/${this.flow.value}-wafer-map.svg`) ? h("a", { href: fileOf(job, `masks/${this.flow.value}-wafer-map.svg`), target: "_blank", rel: "noopener", class: "picture-link" }, h("img", { src: fileOf(job, `masks/${this.flow.value}-wafer-map.svg`), alt: "Map of the wafer" })) : "",
            mask ? h("p", { class: "doc" }, `Grid ${mask.grid_nm} nm, edges within ${number(mask.edge_error_nm)} nm, ${mask.bias}.`) : "");
    }

    // ---- ruler ----

    #useRuler() {
        this.ruling = !this.ruling;
        this.ruler.setAttribute("aria-pressed", String(this.ruling));
        this.view.pan = !this.ruling;
        this.svg.classList.toggle("ruling", this.ruling);
        if (!this.ruling) this.#clearRuler();
    }

    #clearRuler() {
        this.points = [];
        this.#overlay();
    }

    #click(event) {
        if (!this.ruling) return;
        if (this.points.length === 2) this.points = [];
        this.points.push(this.view.at(event));
        this.#overlay();
    }

    #hover(event) {
        const [x, y] = this.view.at(event);
        this.place.textContent = `${x.toFixed(2)}, ${y.toFixed(2)} µm`;
        if (this.ruling && this.points.length === 1) {
            this.floating = [x, y];
            this.#overlay();
        }
    }

    #overlay() {
        const [w, height] = this.view.size;
        const { um, text } = scaleBar(this.view.k);
        const length = um * this.view.k;
        const y = height - 14;
        this.bar.replaceChildren(s("path", { d: `M${w - 16 - length} ${y - 4}v4h${length}v-4` }), s("text", { x: w - 16 - length / 2, y: y - 7, "text-anchor": "middle" }, text));
        const [a, b = this.floating] = this.points;
        this.measure.replaceChildren();
        if (!a || !b) return;
        const [x1, y1] = this.view.toScreen(...a);
        const [x2, y2] = this.view.toScreen(...b);
        const words = `${number(Math.hypot(b[0] - a[0], b[1] - a[1]), 5)} µm  (${number(b[0] - a[0], 4)}, ${number(b[1] - a[1], 4)})`;
        const back = s("rect", { x: (x1 + x2) / 2 - words.length * 3.4 - 6, y: (y1 + y2) / 2 - 30, width: words.length * 6.8 + 12, height: 20, rx: 4 });
        this.measure.append(s("line", { x1, y1, x2, y2 }), s("circle", { cx: x1, cy: y1, r: 3 }), s("circle", { cx: x2, cy: y2, r: 3 }), back,
            s("text", { x: (x1 + x2) / 2, y: (y1 + y2) / 2 - 16, "text-anchor": "middle" }, words));
        this.stage.dataset.ruler = words;
    }
}

const unit = (u) => ({ um: "µm", um2: "µm²", deg: "°", 1: "" })[u] ?? u;

/** The shapes of a layer, those too that are written once and used again. */
function shapesOf(picture, g) {
    return [...g.children].map((e) => {
        const title = s("title", {}, e.querySelector("title")?.textContent ?? "");
        if (e.localName === "path") return s("path", { d: e.getAttribute("d") }, title);
        if (e.localName !== "use") return null;
        const id = (e.getAttributeNS("http://www.w3.org/1999/xlink", "href") ?? e.getAttribute("href") ?? "").slice(1);
        const d = picture.getElementById(id)?.getAttribute("d");
        return d ? s("path", { d, transform: `translate(${Number(e.getAttribute("x"))} ${Number(e.getAttribute("y"))})` }, title) : null;
    }).filter(Boolean);
}

/** Takes a picture (y down) whose box is known in the drawing (nm, y up) to the drawing, in um. */
function shiftOf(b, [x0, , , y1]) {
    return `matrix(1 0 0 -1 ${x0 / 1e3 - b.x} ${y1 / 1e3 + b.y})`;
}
