// SPDX-License-Identifier: GPL-3.0-or-later
// A picture that moves as a file: what is seen is recorded frame by frame, with the looks that the page gives it, and written
// as an SVG that moves by itself (exact, its lines stay lines), or as a GIF for slides. The same picture gives the same bytes.
import { FORMER, isFormer } from "./belong.js";
import { $, announce, button, h, icon } from "./dom.js";
import { gifOf } from "./gif.js";
import { saveAs } from "./plotfile.js";
import { emit } from "./store.js";

export const FRAMES_A_SECOND = 25;
const FOOT = 26; // pixels below the picture, for its caption
const NAMES = ["d", "x", "y", "width", "height", "r", "cx", "cy", "rx", "x1", "y1", "x2", "y2"];
const LOOKS = ["fill", "fill-opacity", "fill-rule", "stroke", "stroke-width", "stroke-opacity", "stroke-dasharray", "stroke-linecap", "stroke-linejoin", "opacity", "vector-effect", "paint-order"];
const TEXT_LOOKS = ["font-size", "font-weight", "font-family", "text-anchor"];
const USUAL = { fill: "rgb(0, 0, 0)", "fill-opacity": "1", "fill-rule": "nonzero", stroke: "none", "stroke-width": "1px", "stroke-opacity": "1", "stroke-dasharray": "none", "stroke-linecap": "butt", "stroke-linejoin": "miter", opacity: "1", "vector-effect": "none", "paint-order": "normal" };
const KEPT = new Set(["svg", "g", "path", "circle", "rect", "line", "text", "tspan", "title", "defs", "pattern", "marker"]);

const escaped = (x) => String(x).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
const breath = () => new Promise((resolve) => setTimeout(resolve));

/** As the header has it. */
export const deviceName = () => $("device-name").textContent || "device";

/** What an element looks like now; text where it is nothing but that. */
function looksOf(e) {
    const style = getComputedStyle(e);
    const names = e.localName === "text" || e.localName === "tspan" ? [...LOOKS, ...TEXT_LOOKS] : LOOKS;
    const out = { transform: e.getAttribute("transform") ?? "", display: style.display === "none" || style.visibility === "hidden" ? "none" : "inline" };
    for (const name of NAMES) if (e.hasAttribute(name)) out[name] = e.getAttribute(name);
    for (const name of names) out[name] = style.getPropertyValue(name).replaceAll('"', "'");
    if (e.getAttribute("marker-end")) out["marker-end"] = e.getAttribute("marker-end");
    if (!e.children.length && e.textContent) out.text = e.textContent;
    return out;
}

class Recorded {
    constructor(element) {
        this.name = element.localName;
        this.fixed = ["id", "viewBox", "refX", "refY", "markerWidth", "markerHeight", "orient", "patternUnits", "patternTransform", "dy"].flatMap((n) => (element.hasAttribute(n) ? [[n, element.getAttribute(n)]] : []));
        this.element = element;
        this.frames = [];
        this.children = [...element.children].filter((c) => KEPT.has(c.localName)).map((c) => new Recorded(c));
    }

    take() {
        if (this.name !== "title") this.frames.push(looksOf(this.element));
        for (const child of this.children) child.take();
    }

    values(name) {
        const list = this.frames.map((f) => f[name]);
        return list.every((v) => v === list[0]) ? list[0] : list;
    }
}

const attribute = (name, value, usual = USUAL[name]) => (value === undefined || value === "" || value === usual || (name === "display" && value === "inline") ? "" : ` ${name}="${escaped(value)}"`);
const animate = (name, list, seconds) => `<animate attributeName="${name}" dur="${seconds}s" repeatCount="indefinite" calcMode="discrete" values="${escaped(list.map((v) => v ?? "").join(";"))}"/>`;

/** Places of a transform "translate(x y) rotate(a)". */
function placed(text) {
    const [x, y] = /translate\(([-\d.e]+)[ ,]+([-\d.e]+)\)/.exec(text)?.slice(1) ?? [0, 0];
    return { translate: `${x} ${y}`, rotate: /rotate\(([-\d.e]+)\)/.exec(text)?.[1] ?? "0" };
}

/** One element with all that is in it: at a frame, or moving (frame null). */
function written(r, frame, seconds) {
    if (r.name === "title") return frame === null ? `<title>${escaped(r.element.textContent)}</title>` : "";
    const names = Object.keys(r.frames[0]).filter((n) => n !== "text" && n !== "transform");
    let attributes = r.fixed.map(([n, v]) => ` ${n}="${escaped(v)}"`).join("");
    let moving = "";
    for (const name of names) {
        const v = frame === null ? r.values(name) : r.frames[frame][name];
        if (!Array.isArray(v)) attributes += attribute(name, v);
        else {
            attributes += attribute(name, v[0], null);
            moving += animate(name, v, seconds);
        }
    }
    const text = frame === null ? r.values("text") : r.frames[frame].text;
    const inside = r.children.map((c) => written(c, frame, seconds)).join("");
    const place = frame === null ? r.values("transform") : r.frames[frame].transform;
    const whole = (words, more = "") => `<${r.name}${attributes}>${moving}${more}${escaped(words ?? "")}${inside}</${r.name}>`;
    let out;
    if (!Array.isArray(text)) out = whole(text);
    else // letters cannot be animated: each of its texts has its time
        out = [...new Set(text)].map((words) => whole(words, animate("visibility", text.map((t) => (t === words ? "visible" : "hidden")), seconds))).join("");
    if (!Array.isArray(place)) return place ? `<g transform="${escaped(place)}">${out}</g>` : out;
    const turns = place.map(placed);
    const turn = (type) => `<animateTransform attributeName="transform" type="${type}" dur="${seconds}s" repeatCount="indefinite" calcMode="discrete" values="${turns.map((t) => t[type]).join(";")}"/>`;
    return `<g>${turn("translate")}<g>${turn("rotate")}${out}</g></g>`;
}

/**
 * Records an <svg>: show(i) puts frame i of n on it, caption(i) says what it is. Gives {n, seconds, width, height, shown: the <svg>, svg: the text
 * that moves, at(i): the text of one frame}. Between frames others have their turn.
 */
export async function record(svg, { n, seconds, show, caption, cancelled = () => false }) {
    const [width, height] = [svg.clientWidth, svg.clientHeight];
    const root = new Recorded(svg);
    const count = svg.querySelectorAll("*").length;
    for (let i = 0; i < n; i++) {
        show(i);
        if (svg.querySelectorAll("*").length !== count || cancelled()) throw new Error("the picture has changed meanwhile");
        root.take();
        if (i % 4 === 3) await breath();
    }
    const style = getComputedStyle(svg.parentElement);
    const ink = getComputedStyle(document.body).color;
    const of = isFormer(svg) ? FORMER : "";
    const captions = Array.from({ length: n }, (_, i) => caption(i) + of);
    const head = (one) => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height + FOOT}" width="${width}" height="${height + FOOT}"><rect width="${width}" height="${height + FOOT}" fill="${style.backgroundColor}"/>${one}`;
    const line = (words, more = "") => `<text x="12" y="${height + 17}" font-size="13" font-family="system-ui, sans-serif" fill="${ink}">${more}${escaped(words)}</text></svg>\n`;
    const inner = (frame) => root.children.map((c) => written(c, frame, seconds)).join("\n");
    const clip = `<clipPath id="film"><rect width="${width}" height="${height}"/></clipPath><g clip-path="url(#film)">`;
    const same = captions.every((c) => c === captions[0]);
    const moving = () => [...new Set(captions)].map((words) => line(words, same ? "" : animate("visibility", captions.map((c) => (c === words ? "visible" : "hidden")), seconds)).replace("</svg>\n", "")).join("");
    return {
        n, seconds, width, height: height + FOOT, shown: svg,
        svg: () => `${head(clip)}${inner(null)}</g>${moving()}</svg>\n`,
        at: (i) => `${head(clip)}${inner(i)}</g>${line(captions[i])}`,
    };
}

async function pixels(canvas, text) {
    const url = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
    try {
        const image = new Image();
        image.src = url;
        await image.decode();
        const context = canvas.getContext("2d", { willReadFrequently: true });
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, canvas.width, canvas.height).data;
    } finally {
        URL.revokeObjectURL(url);
    }
}

/** The recorded frames as a GIF that goes on for ever. */
export async function asGif(film) {
    const canvas = h("canvas", { width: film.width, height: film.height });
    return gifOf(film.width, film.height, film.n, Math.round((100 * film.seconds) / film.n), (i) => pixels(canvas, film.at(i)));
}

/** A menu that saves a film; make(): what record gives, name(): of the file. */
export function filmMenu(make, name) {
    const box = h("details", { class: "film-menu" }, h("summary", { class: "button small", title: "Save what moves here as a file" }, icon("film"), h("span", {}, "Film")));
    const item = (label, words, write) => button(label, { class: "small", title: words }, async () => {
        box.open = false;
        const summary = box.querySelector("summary");
        if (summary.getAttribute("aria-busy") === "true") return;
        summary.setAttribute("aria-busy", "true");
        announce("The film is being made");
        try {
            await write(await make());
            announce(`${label}: saved`);
        } catch (error) {
            emit("notice", { kind: "warn", text: `The film could not be made: ${error.message}` });
        } finally {
            summary.removeAttribute("aria-busy");
        }
    });
    box.append(h("div", { class: "plot-menu-list" },
        item("Animated SVG", "exact, for the web; its lines stay lines", async (film) => saveAs(`${name()}.svg`, film.svg(), "image/svg+xml", film.shown)),
        item("GIF", "for slides and mails", async (film) => saveAs(`${name()}.gif`, await asGif(film), "image/gif", film.shown))));
    return box;
}
