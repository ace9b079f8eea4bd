// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of what was explored: a number over one input with its band and limits, or the map of it over two. What is
// decided is told by colour, by the sign of a point and by a strip below: nothing by colour alone.
import { scale } from "./colours.js";
import { h, s } from "./dom.js";
import { number } from "./format.js";
import { rangeOf, stretches } from "./exploring.js";
import { ticks } from "./plotfile.js";

const [LEFT, RIGHT, TOP, STRIP, BELOW] = [58, 14, 12, 12, 44];
export const WORDS = { accept: "accepted", reject: "rejected", inconclusive: "inconclusive", run: "not judged", failed: "refused", open: "open" };
const SIGNS = { // of about 6 pixels
    accept: "M-3 0a3 3 0 1 0 6 0a3 3 0 1 0-6 0", reject: "M-3-3L3 3M3-3L-3 3", inconclusive: "M-2.6-2.6h5.2v5.2h-5.2z", run: "M-3 0h6", failed: "M-3-3L3 3M3-3L-3 3M0-4V4",
};
const MOST_SIGNS = 110;
const MARK = 6; // pixels that a sign at the end of the range needs beside it
const PAD = 0.06;
const FLAT = 1e-6; // relative: less is no change
const BAR = { room: 76, gap: 10, width: 12, parts: 32 }; // of a map's colour scale, at its right

export class ExplorePlot {
    /** onlook(x) or onlook([x, y]): somebody clicks there, in the units of the inputs; under(the same): {x, y, value, words} of the
     *  device that the pointer is nearest to, or null */
    constructor(holder, onlook, under) {
        this.svg = s("svg", { class: "explore-plot", role: "img", "aria-label": "Nothing is explored yet." });
        this.onlook = onlook;
        this.mark = s("circle", { class: "explore-under", r: 5 });
        this.tip = h("div", { class: "explore-tip", hidden: true, "aria-hidden": "true" });
        this.pointer = null; // where the pointer is, on the picture
        this.under = under;
        holder.append(h("div", { class: "explore-stage" }, this.svg, this.tip));
        new ResizeObserver(() => this.what && this.draw()).observe(this.svg);
        const look = (e) => {
            if (!this.from) return;
            const r = this.svg.getBoundingClientRect();
            this.onlook(this.from(e.clientX - r.left, e.clientY - r.top));
        };
        this.svg.addEventListener("pointerdown", (e) => e.button === 0 && look(e));
        this.svg.addEventListener("pointermove", (e) => {
            const r = this.svg.getBoundingClientRect();
            this.pointer = e.pointerType === "touch" ? null : [e.clientX - r.left, e.clientY - r.top];
            if (e.buttons & 1) look(e);
            this.#tell();
        });
        this.svg.addEventListener("pointerleave", () => {
            this.pointer = null;
            this.#tell();
        });
    }

    /** what: {kind: "line", x: {label, unit, from, to, now}, points: [{x, state, value, low, high}] sorted, told: likewise, limits, unit} or
     *  {kind: "map", x, y, cells: [{x, y, w, h, state, value, told}], limit, unit}; at: what is looked at */
    show(what) {
        this.what = what;
        this.draw();
    }

    draw() {
        const [w, height] = [this.svg.clientWidth, this.svg.clientHeight];
        if (!w || !height) return;
        this.svg.setAttribute("viewBox", `0 0 ${w} ${height}`);
        this.svg.replaceChildren(...(this.what.kind === "line" ? this.#line(w, height) : this.#map(w, height)), this.mark);
        this.#tell();
    }

    /** What the pointer is on, beside it. */
    #tell() {
        const p = this.pointer && this.from ? this.under(this.from(...this.pointer)) : null;
        this.tip.hidden = !p;
        this.mark.setAttribute("visibility", p ? "visible" : "hidden");
        if (!p) return;
        this.tip.textContent = p.words;
        const at = this.to(p);
        for (const [name, v] of [["cx", at[0]], ["cy", at[1]]]) this.mark.setAttribute(name, v);
        const [w, height] = [this.svg.clientWidth, this.svg.clientHeight];
        const right = at[0] > w / 2;
        this.tip.style.left = right ? "" : `${at[0] + 12}px`;
        this.tip.style.right = right ? `${w - at[0] + 12}px` : "";
        this.tip.style.top = `${Math.min(Math.max(at[1] - 12, 0), Math.max(height - this.tip.offsetHeight, 0))}px`;
    }

    #axes(w, height, x, y, ylabel, beside = RIGHT) {
        const [right, bottom] = [w - beside, height - BELOW];
        const px = (v) => LEFT + ((v - x.from) / (x.to - x.from)) * (right - LEFT);
        const py = (v) => bottom - ((v - y.from) / (y.to - y.from)) * (bottom - TOP);
        this.from = null;
        const out = [s("rect", { class: "explore-ground", x: LEFT, y: TOP, width: Math.max(right - LEFT, 0), height: Math.max(bottom - TOP, 0) })];
        for (const v of ticks(x.from, x.to, Math.max(Math.floor(w / 110), 2))) out.push(s("path", { class: "explore-grid", d: `M${px(v)} ${TOP}V${bottom}` }), s("text", { class: "explore-tick", x: px(v), y: height - 24, "text-anchor": "middle" }, number(v, 4)));
        for (const v of ticks(y.from, y.to, Math.max(Math.floor(height / 60), 2))) out.push(s("path", { class: "explore-grid", d: `M${LEFT} ${py(v)}H${right}` }), s("text", { class: "explore-tick", x: LEFT - 6, y: py(v) + 4, "text-anchor": "end" }, number(v, 4)));
        out.push(s("text", { class: "explore-label", x: (LEFT + right) / 2, y: height - 6, "text-anchor": "middle" }, `${x.label}${x.unit ? ` (${x.unit})` : ""}`));
        out.push(s("text", { class: "explore-label", transform: `translate(13 ${(TOP + bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, ylabel));
        return { out, px, py, right, bottom };
    }

    #line(w, height) {
        const { x, points, told, limits, unit, at, whole } = this.what;
        const line = [...points, ...told].sort((a, b) => a.x - b.x);
        let { low, high } = rangeOf(line, limits, false);
        const flat = high - low < FLAT * Math.max(Math.abs(low), Math.abs(high)); // a number that this input does nothing to
        const pad = (flat ? Math.abs(high) || 1 : high - low) * PAD;
        if (unit === "%" && low >= 0) low = Math.min(0, low);
        const { out, px, py, right, bottom } = this.#axes(w, height, x, { from: unit === "%" && !flat ? low : low - pad, to: high + pad }, this.what.ylabel);
        const area = s("clipPath", { id: "explore-area" }, s("rect", { x: LEFT - MARK, y: TOP, width: right - LEFT + 2 * MARK, height: bottom - TOP }));
        const inside = s("g", { "clip-path": "url(#explore-area)" });
        for (const run of runs(line, (p) => [p.value, p.low, p.high].every(Number.isFinite))) inside.append(s("path", { class: "explore-band", d: `M${run.map((p) => `${px(p.x)} ${py(p.high)}`).join("L")}L${[...run].reverse().map((p) => `${px(p.x)} ${py(p.low)}`).join("L")}Z` }));
        for (const v of limits) inside.append(s("path", { class: "explore-limit", d: `M${LEFT} ${py(v)}H${right}` }));
        for (const run of runs(line, (p) => Number.isFinite(p.value)).flatMap(alike)) inside.append(s("path", { class: `explore-line${run.some((p) => p.told) ? " told" : ""}`, d: `M${run.map((p) => `${px(p.x)} ${py(p.value)}`).join("L")}` }));
        const step = Math.max(1, Math.ceil(points.length / MOST_SIGNS));
        points.forEach((p, i) => {
            const edge = points[i - 1]?.state !== p.state || points[i + 1]?.state !== p.state;
            if (i % step && !edge) return;
            inside.append(s("path", { class: `explore-sign ${p.state}`, d: SIGNS[p.state], transform: `translate(${px(p.x)} ${!Number.isFinite(p.value) ? bottom - 8 : p.value > high ? TOP + 5 : py(p.value)})` }));
        });
        if (Number.isFinite(x.now) && x.now >= x.from && x.now <= x.to) inside.append(s("path", { class: "explore-now", d: `M${px(x.now)} ${TOP}V${bottom}` }), s("text", { class: "explore-word", x: px(x.now) + (px(x.now) > right - 50 ? -5 : 5), y: TOP + (limits.some((v) => Math.abs(py(v) - TOP - 6) < 10) ? 26 : 10), "text-anchor": px(x.now) > right - 50 ? "end" : "start" }, "now"));
        if (at !== null && at !== undefined) inside.append(s("path", { class: "explore-at", d: `M${px(at)} ${TOP}V${bottom}` }));
        out.push(area, inside);
        limits.forEach((v) => py(v) >= TOP && out.push(s("text", { class: "explore-word limit", x: right - 4, y: py(v) - 5, "text-anchor": "end" }, "limit")));
        for (const r of stretches(points, whole)) {
            const [a, b] = [px(r.from), px(r.to)];
            out.push(s("rect", { class: `explore-strip ${r.state}`, x: a, y: bottom + 1, width: Math.max(b - a, 1), height: STRIP - 4 }, s("title", {}, WORDS[r.state])));
        }
        this.to = (p) => [px(p.x), !Number.isFinite(p.value) ? bottom - 8 : Math.min(Math.max(py(p.value), TOP), bottom)];
        this.from = (ex) => Math.min(Math.max(x.from + ((ex - LEFT) / (right - LEFT)) * (x.to - x.from), x.from), x.to);
        return out;
    }

    #map(w, height) {
        const { x, y, cells, limit, at } = this.what;
        const { out, px, py, right, bottom } = this.#axes(w, height, x, y, `${y.label}${y.unit ? ` (${y.unit})` : ""}`, BAR.room);
        const [low, high] = coloured(cells, limit);
        const inside = s("g", { "clip-path": "url(#explore-area)" });
        out.push(s("clipPath", { id: "explore-area" }, s("rect", { x: LEFT, y: TOP, width: right - LEFT, height: bottom - TOP })));
        const marks = [], some = cells.some((c) => c.told); // then those that are judged are marked
        for (const c of cells) { // coarse ones first, finer ones over them
            const [a, b, e, f] = [px(c.x - c.w / 2), px(c.x + c.w / 2), py(c.y + c.h / 2), py(c.y - c.h / 2)];
            const fill = Number.isFinite(c.value) ? scale((c.value - low) / (high - low || 1)) : "transparent";
            inside.append(s("rect", { x: a, y: e, width: b - a + 0.4, height: f - e + 0.4, fill, class: "explore-cell" }));
            if (c.state !== "accept") inside.append(s("rect", { x: a, y: e, width: b - a + 0.4, height: f - e + 0.4, class: `explore-veil ${c.state}` }));
            if (c.state === "reject" || c.state === "failed") inside.append(s("path", { class: "explore-veil-line", d: `M${a} ${f}L${b} ${e}${c.state === "failed" ? `M${a} ${e}L${b} ${f}` : ""}` }));
            if (c.state === "inconclusive") inside.append(s("path", { class: "explore-veil-line", d: `M${(a + b) / 2 - 1.5} ${(e + f) / 2}h3` }));
            if (some && !c.told) marks.push(s("circle", { class: "explore-judged", cx: px(c.x), cy: py(c.y), r: 1.6 }));
        }
        inside.append(...marks);
        if (Number.isFinite(x.now) && Number.isFinite(y.now)) inside.append(s("path", { class: "explore-now", d: `M${px(x.now)} ${TOP}V${bottom}M${LEFT} ${py(y.now)}H${right}` }));
        if (at) inside.append(s("circle", { class: "explore-at", cx: px(at[0]), cy: py(at[1]), r: 7 }));
        out.push(inside, ...this.#bar(right + BAR.gap, bottom, low, high));
        this.to = (p) => [px(p.x), py(p.y)];
        this.from = (ex, ey) => [
            Math.min(Math.max(x.from + ((ex - LEFT) / (right - LEFT)) * (x.to - x.from), x.from), x.to),
            Math.min(Math.max(y.from + ((bottom - ey) / (bottom - TOP)) * (y.to - y.from), y.from), y.to),
        ];
        return out;
    }

    /** The colours of a map with the values they stand for, and where among them the limit is. */
    #bar(x, bottom, low, high) {
        const { limit, unit, cells } = this.what;
        if (!cells.some((c) => Number.isFinite(c.value))) return [];
        const at = (v) => bottom - ((v - low) / (high - low || 1)) * (bottom - TOP);
        const step = (bottom - TOP) / BAR.parts, end = x + BAR.width;
        const out = Array.from({ length: BAR.parts }, (_, i) => s("rect", { x, y: bottom - (i + 1) * step, width: BAR.width, height: step + 0.4, fill: scale((i + 0.5) / BAR.parts) }));
        const text = (y, words, cls = "explore-tick") => s("text", { class: cls, x: end + 4, y }, words);
        for (const v of high > low ? ticks(low, high, Math.max(Math.floor((bottom - TOP) / 40), 2)) : [low])
            if (limit === null || Math.abs(at(v) - at(limit)) > 14) out.push(s("path", { class: "explore-grid", d: `M${end} ${at(v)}h3` }), text(at(v) + 4, number(v, 3)));
        if (limit !== null) out.push(s("path", { class: "explore-limit", d: `M${x} ${at(limit)}H${end + 3}` }), text(Math.max(at(limit) + 4, TOP + 10), "limit", "explore-word"), text(Math.max(at(limit) + 18, TOP + 24), `${number(limit, 3)}${unit ? ` ${unit}` : ""}`));
        else if (unit) out.push(text(bottom + 16, unit));
        return [s("g", { class: "explore-bar" }, s("title", {}, `colours from ${number(low, 3)} to ${number(high, 3)} ${unit}${limit !== null ? `, limit ${number(limit, 3)}` : ""}`), ...out)];
    }
}

/** The values that a map's darkest and lightest colour stand for: up to the limit, and all there are where what is accepted lies
 *  beyond it (a limit that asks for at least so much) or nothing is limited. */
function coloured(cells, limit) {
    const good = cells.filter((c) => Number.isFinite(c.value)), values = good.map((c) => c.value);
    if (limit !== null && !good.some((c) => c.state === "accept" && c.value > limit)) return [0, limit];
    if (limit !== null) values.push(limit);
    return values.length ? [Math.min(...values), Math.max(...values)] : [0, 1];
}

/** Runs of neighbours that all have it. */
function runs(points, has) {
    const out = [];
    let run = [];
    for (const p of [...points, null]) {
        if (p && has(p)) run.push(p);
        else {
            if (run.length > 1) out.push(run);
            run = [];
        }
    }
    return out;
}

/** Of a run the pieces between judged places that follow each other, and those in which places are told. */
function alike(run) {
    const out = [];
    run.slice(1).forEach((p, i) => {
        const told = Boolean(p.told || run[i].told), last = out.at(-1);
        if (last?.told === told) last.list.push(p);
        else out.push({ told, list: [run[i], p] });
    });
    return out.map((x) => x.list);
}

/** What colours and signs of a picture mean. */
export function legendOf(kind) {
    const sign = (state) => h("span", { class: "explore-key" }, s("svg", { viewBox: "-5 -5 10 10", class: "explore-key-sign", "aria-hidden": "true" }, s("path", { class: `explore-sign ${state}`, d: SIGNS[state] })), WORDS[state]);
    if (kind === "map") return [h("span", { class: "explore-key" }, "the scale at the right says what a colour stands for; hatched: rejected, a dash: inconclusive, crossed: refused; dots: judged, told between them; lines: now")];
    return [sign("accept"), sign("inconclusive"), sign("reject"), h("span", { class: "explore-key" }, h("i", { class: "explore-band-key" }), "error band"), h("span", { class: "explore-key" }, h("i", { class: "explore-told-key" }), "told between judged devices"), h("span", { class: "explore-key" }, h("i", { class: "explore-now-key" }), "as it is now")];
}

const DRAWN = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "opacity", "font-size"];

/** A picture of the page as a file that looks the same without its sheets. */
export function alone(svg) {
    const copy = svg.cloneNode(true);
    const own = [...svg.querySelectorAll("*")];
    [...copy.querySelectorAll("*")].forEach((e, i) => {
        const style = getComputedStyle(own[i]);
        for (const name of DRAWN) e.setAttribute(name, style.getPropertyValue(name));
        e.removeAttribute("class");
    });
    for (const e of copy.querySelectorAll('[visibility="hidden"]')) e.remove(); // the pointer's mark
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    copy.setAttribute("font-family", "system-ui, sans-serif");
    return `${new XMLSerializer().serializeToString(copy)}\n`;
}
