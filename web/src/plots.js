// SPDX-License-Identifier: GPL-3.0-or-later
// Curves over time with one cursor for all of them.
import uPlot from "uplot";
import { curve, dash, themed } from "./colours.js";
import { h } from "./dom.js";
import { number } from "./format.js";
import { on } from "./store.js";

export class Plot {
    /** onseek(t): the user has clicked or dragged to a time */
    constructor(holder, { title, unit, log = false, onseek }) {
        Object.assign(this, { title, unit, log, onseek });
        this.heading = h("div", { class: "plot-title" }, h("span", {}, title), h("span", { class: "plot-unit" }, unit), h("span", { class: "plot-value" }));
        this.box = h("div", { class: "plot-box", role: "img", "aria-label": title });
        this.root = h("figure", { class: "plot" }, this.heading, this.box);
        holder.append(this.root);
        new ResizeObserver(() => this.#resize()).observe(this.box);
        on("theme", () => (this.shape = null)); // whoever shows it shows it again
        this.box.addEventListener("pointerdown", (e) => this.#seek(e));
        this.box.addEventListener("pointermove", (e) => e.buttons & 1 && this.#seek(e));
    }

    /** t: times in ms; series: [{name, values, key (colour), limit, then: the series of whose pinned version it is}], marks: [{y, text, curve}] */
    show(t, series, { marks = [], chosen = null, range } = {}) {
        const shape = JSON.stringify([series.map((x) => x.name), chosen, marks.length, Boolean(range)]);
        this.data = { t, series, marks, chosen, range };
        if (this.plot && shape === this.shape) {
            this.plot.setData([t, ...series.map((x) => x.values)]);
            this.plot.redraw();
        } else {
            this.shape = shape;
            this.#make();
        }
        this.box.setAttribute("aria-label", `${this.title}: ${series.map((x) => x.name).join(", ")}`);
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
                x: { time: false },
                y: this.log ? { distr: 3 } : { range: (u, low, high) => this.#range(low, high) },
            },
            axes: [
                { ...axis, size: 26, values: (u, v) => v.map((x) => number(x, 4)) },
                { ...axis, size: 50, values: (u, v) => v.map((x) => (x === null ? "" : number(x, this.log ? 1 : 3))) },
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
        this.now = now;
        this.heading.querySelector(".plot-value").textContent = text ?? "";
        this.plot?.redraw(false, false);
    }

    #seek(event) {
        if (!this.plot || event.button > 0) return;
        const left = event.clientX - this.box.getBoundingClientRect().left - this.plot.bbox.left / uPlot.pxRatio;
        this.onseek?.(this.plot.posToVal(left, "x"));
    }

    #resize() {
        const { clientWidth: width, clientHeight: height } = this.box;
        if (!width || !height) return;
        if (this.plot) this.plot.setSize({ width, height });
        else this.#make();
    }
}
