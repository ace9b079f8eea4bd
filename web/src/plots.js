// SPDX-License-Identifier: GPL-3.0-or-later
// Curves over time with one cursor for all of them.
import uPlot from "uplot";
import { FORMER, isFormer } from "./belong.js";
import { curve, dash, themed } from "./colours.js";
import { become, button, h, put, say } from "./dom.js";
import { number, tickWords } from "./format.js";
import { csvOf, saveAs, svgOf } from "./plotfile.js";
import { on, state } from "./store.js";

const NEAREST = 6; // curves that a look at a point names

export class Plot {
    /** onseek(t): the user has clicked or dragged to a time; onwindow(window): has zoomed, [from, to] or null */
    constructor(holder, { title, unit, log = false, onseek, onwindow }) {
        Object.assign(this, { title, unit, log, onseek, onwindow, window: null });
        this.heading = h("div", { class: "plot-title" }, h("span", {}, title), h("span", { class: "plot-unit" }, unit), h("span", { class: "plot-value" }));
        this.box = h("div", { class: "plot-box", role: "img", "aria-label": title });
        this.other = h("div", { class: "plot-other", hidden: true });
        this.look = h("div", { class: "plot-look", hidden: true, "aria-hidden": "true" });
        this.root = h("figure", { class: "plot" }, this.heading, this.#menu(holder), this.box, this.other, this.look);
        holder.append(this.root);
        new ResizeObserver(() => this.#resize()).observe(this.box);
        on("theme", () => (this.shape = null)); // whoever shows it shows it again
        this.fingers = new Map();
        this.box.addEventListener("pointerdown", (e) => {
            this.fingers.set(e.pointerId, e.clientX);
            if (this.fingers.size === 1) this.#seek(e);
        });
        this.box.addEventListener("pointermove", (e) => {
            if (this.fingers.size > 1) return this.#pinch(e);
            if (e.buttons & 1) this.#seek(e);
            return this.#under(e);
        });
        for (const end of ["pointerup", "pointercancel", "pointerleave"]) this.box.addEventListener(end, (e) => this.fingers.delete(e.pointerId));
        this.box.addEventListener("pointerleave", () => this.#leave());
        this.box.addEventListener("wheel", (e) => this.#wheel(e), { passive: false });
        this.box.addEventListener("dblclick", () => this.onwindow?.(null));
    }

    // ---- zoom, and values under the pointer ----

    #menu(holder) {
        const act = (label, f) => button(label, { class: "small" }, () => {
            menu.open = false;
            f();
        });
        const name = () => `${state.preview?.name ?? "device"}-${this.words.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "")}`;
        const menu = h("details", { class: "plot-menu" }, h("summary", { "aria-label": `${this.title}: zoom, save` }, "⋯"), h("div", { class: "plot-menu-list" },
            act("Zoom in", () => this.zoom(0.5)), act("Zoom out", () => this.zoom(2)), act("Whole scene", () => this.onwindow?.(null)),
            act("Save as CSV", () => saveAs(`${name()}.csv`, this.csv(), "text/csv", this.root)), act("Save as SVG", () => saveAs(`${name()}.svg`, this.svg(), "image/svg+xml", this.root))));
        menu.addEventListener("toggle", () => { // where little is left below of the view it opens upwards
            menu.classList.remove("up");
            const end = Math.min(innerHeight, holder.parentNode.getBoundingClientRect().bottom);
            if (menu.open && menu.lastChild.getBoundingClientRect().bottom > end) menu.classList.add("up");
        });
        menu.addEventListener("keydown", (e) => {
            if (e.key !== "Escape" || !menu.open) return;
            menu.open = false;
            menu.firstChild.focus();
            e.stopPropagation();
        });
        menu.addEventListener("focusout", (e) => menu.contains(e.relatedTarget) || (menu.open = false));
        return menu;
    }

    /** What the heading says: the title may have changed, or be a choice. */
    get words() {
        const first = this.heading.firstChild;
        return first.tagName === "SELECT" ? first.selectedOptions[0]?.textContent ?? "" : first.textContent;
    }
    get unitWords() {
        return this.heading.querySelector(".plot-unit").textContent;
    }

    /** In place of curves something else, with files = {csv(), svg()} of its own; null: curves. */
    instead(element, files = null) {
        this.files = files;
        if (element) this.#leave();
        become(this.other, { hidden: element === null });
        become(this.box, { hidden: element !== null });
        this.other.replaceChildren(...(element ? [element] : []));
    }

    csv() {
        if (this.files) return this.files.csv();
        return csvOf(this.data, this.unitWords.replace(/, (over ms|hinges as pins)$/, ""));
    }
    svg() {
        if (this.files) return this.files.svg();
        const { x, y } = this.plot.scales;
        return svgOf(this.data, { title: `${state.preview?.name ?? ""}: ${this.words}${isFormer(this.root) ? FORMER : ""}`, unit: this.unitWords, x: [x.min, x.max], y: [y.min, y.max], log: this.log });
    }

    /** Shows so much of the present window, about a time (of itself that of the cursor). */
    zoom(factor, about = this.now) {
        const t = this.data?.t;
        if (!t?.length) return;
        const [whole0, whole1] = [t[0], t.at(-1)];
        const [a, b] = this.window ?? [whole0, whole1];
        const middle = about >= a && about <= b ? about : (a + b) / 2;
        const least = (whole1 - whole0) / Math.max(t.length - 1, 1);
        const size = Math.max((b - a) * factor, 3 * least);
        if (size >= whole1 - whole0) return this.onwindow?.(null);
        const from = Math.min(Math.max(middle - ((middle - a) / (b - a)) * size, whole0), whole1 - size);
        this.onwindow?.([from, from + size]);
    }

    /** [from, to] in the unit of the axis; null: all. */
    setWindow(window) {
        this.window = window;
        this.plot?.setData(this.plot.data);
    }

    #time(event) {
        const left = event.clientX - this.box.getBoundingClientRect().left - this.plot.bbox.left / uPlot.pxRatio;
        return this.plot.posToVal(left, "x");
    }

    #wheel(event) {
        if (!this.plot || !this.onwindow || (matchMedia("(max-width: 900px)").matches && !event.ctrlKey)) return; // there it scrolls the page
        event.preventDefault();
        this.zoom(Math.exp(event.deltaY * (event.deltaMode === 1 ? 16 : 1) * 0.0016), this.#time(event));
    }

    /** Two fingers: zoom about the time between them. */
    #pinch(event) {
        if (!this.fingers.has(event.pointerId)) return;
        const width = () => Math.abs([...this.fingers.values()].slice(0, 2).reduce((a, b) => a - b));
        const before = width();
        this.fingers.set(event.pointerId, event.clientX);
        const [a, b] = [...this.fingers.values()];
        if (before > 4 && width() > 4 && this.onwindow) this.zoom(before / width(), this.#time({ clientX: (a + b) / 2 }));
    }

    #leave() {
        this.pointer = null;
        this.look.hidden = true;
    }

    /** The sample nearest to the pointer, of the nearest curves; told anew when other curves come below a pointer that rests. */
    #under(event) {
        const { t, series } = this.data ?? {};
        if (!this.plot || !t?.length) return;
        this.pointer = { clientX: event.clientX, clientY: event.clientY };
        this.told = this.data;
        const at = this.#time(event);
        let i = 0;
        while (i < t.length - 1 && Math.abs(t[i + 1] - at) <= Math.abs(t[i] - at)) i++;
        const r = this.box.getBoundingClientRect();
        const y = this.plot.posToVal(event.clientY - r.top - this.plot.bbox.top / uPlot.pxRatio, "y");
        const near = series.map((x, k) => ({ name: x.name, key: x.key ?? k, value: x.values[i] })).filter((x) => Number.isFinite(x.value)).sort((a, b) => Math.abs(a.value - y) - Math.abs(b.value - y)).slice(0, NEAREST);
        this.look.replaceChildren(h("b", {}, `${number(t[i], 4)} ms`), ...near.map((x) => h("span", {}, h("i", { style: { background: curve(x.key) } }), `${x.name} ${number(x.value, 4)}`)));
        this.look.hidden = near.length === 0;
        const right = event.clientX - r.left > r.width / 2;
        this.look.style.setProperty("top", `${this.box.offsetTop + 4}px`);
        this.look.style.setProperty("left", right ? "auto" : `${event.clientX - r.left + 14 + this.box.offsetLeft}px`);
        this.look.style.setProperty("right", right ? `${r.right - event.clientX + 14}px` : "auto");
    }

    /** t: times in ms; series: [{name, values, key (colour), limit, then: the series of whose pinned version it is}], marks: [{y, text, curve}] */
    show(t, series, { marks = [], chosen = null, range } = {}) {
        const shape = JSON.stringify([series.map((x) => x.name), chosen, marks.length, Boolean(range), this.log]);
        this.data = { t, series, marks, chosen, range };
        if (this.plot && shape === this.shape) {
            this.plot.setData([t, ...series.map((x) => x.values)]); // draws; redraw() would put the former range back
        } else {
            this.shape = shape;
            this.#make();
        }
        put(this.box, { "aria-label": `${this.title}: ${series.map((x) => x.name).join(", ")}` });
    }

    #make() {
        this.plot?.destroy();
        this.plot = null;
        if (!this.data || !this.box.clientWidth) return;
        const { t, series, chosen } = this.data;
        const ink = themed("--muted");
        const grid = { stroke: themed("--grid"), width: 1 };
        const axis = { stroke: ink, font: "11px system-ui, sans-serif", grid, ticks: { ...grid, size: 4 } };
        this.plot = new uPlot({
            width: this.box.clientWidth, height: this.box.clientHeight,
            legend: { show: false }, cursor: { show: false },
            scales: {
                x: { time: false, range: (u, low, high) => this.window ?? [low, high] },
                y: this.log ? { distr: 3 } : { range: (u, low, high) => this.#range(low, high) },
            },
            axes: [
                { ...axis, size: 26, values: (u, v) => tickWords(v, 4) },
                { ...axis, size: (u, words) => Math.max(50, 14 + 7 * Math.max(0, ...(words ?? []).map((x) => x.length))), values: (u, v) => (this.log ? v.map((x) => (x === null ? "" : number(x, 1))) : tickWords(v)) },
            ],
            series: [{}, ...series.map((x, i) => ({
                label: x.name, stroke: curve(x.key ?? i), dash: x.then ? [1.5, 2.5] : x.solid ? [] : dash(x.key ?? i), points: { show: false },
                width: x.then ? 1.1 : chosen === null || chosen === x.name ? 1.8 : 0.9, alpha: chosen === null || chosen === (x.then ?? x.name) ? 1 : 0.4, spanGaps: true,
            }))],
            hooks: { draw: [(u) => this.#over(u)] },
        }, [t, ...series.map((x) => x.values)], this.box);
    }

    #range(low, high) {
        const { range } = this.data;
        if (range) return [Math.min(low ?? 0, range[0]), Math.max(high ?? 1, range[1])];
        if (!(high > low)) return [(low ?? 0) - 1, (high ?? 0) + 1];
        const pad = (high - low) * 0.08;
        return [low - pad, high + pad];
    }

    #over(u) {
        if (this.pointer && this.plot === u && this.told !== this.data) this.#under(this.pointer);
        const ctx = u.ctx;
        const ratio = uPlot.pxRatio;
        ctx.save();
        ctx.beginPath();
        ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
        ctx.clip();
        for (const mark of this.data.marks) {
            const y = u.valToPos(mark.y, "y", true);
            ctx.strokeStyle = mark.curve === undefined ? themed("--limit") : curve(mark.curve);
            ctx.lineWidth = 1.4 * ratio;
            ctx.setLineDash([5 * ratio, 4 * ratio]);
            ctx.beginPath();
            ctx.moveTo(u.bbox.left, y);
            ctx.lineTo(u.bbox.left + u.bbox.width, y);
            ctx.stroke();
            if (!mark.text) continue;
            ctx.setLineDash([]);
            ctx.fillStyle = themed("--limit");
            ctx.font = `${10.5 * ratio}px system-ui, sans-serif`;
            ctx.textAlign = "right";
            ctx.fillText(mark.text, u.bbox.left + u.bbox.width - 6 * ratio, y + (mark.y < 0 ? -5 : 13) * ratio);
        }
        if (this.now !== undefined) {
            const x = u.valToPos(this.now, "x", true);
            ctx.setLineDash([]);
            ctx.strokeStyle = themed("--ink");
            ctx.lineWidth = 1.2 * ratio;
            ctx.beginPath();
            ctx.moveTo(x, u.bbox.top);
            ctx.lineTo(x, u.bbox.top + u.bbox.height);
            ctx.stroke();
        }
        ctx.restore();
    }

    /** The cursor: a time in the unit of the axis, and what the heading says there. */
    at(now, text) {
        say(this.heading.querySelector(".plot-value"), text ?? "");
        if (this.now === now) return;
        this.now = now;
        this.plot?.redraw(false, false);
    }

    #seek(event) {
        if (!this.plot || event.button > 0) return;
        this.onseek?.(this.#time(event));
    }

    #resize() {
        const { clientWidth: width, clientHeight: height } = this.box;
        if (!width || !height) return;
        if (this.plot) this.plot.setSize({ width, height });
        else this.#make();
    }
}
