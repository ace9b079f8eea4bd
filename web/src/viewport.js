// SPDX-License-Identifier: GPL-3.0-or-later
// A picture that is panned and zoomed: an <svg> in screen pixels with a world group (micrometres, y up)
// and an overlay group on top whose things keep their size on the screen.
import { put, s } from "./dom.js";

const LEAST_PIXELS = 40; // of the whole picture: nobody loses it by zooming out
const MOST_SCALE = 400; // pixels per micrometre
const TAPS_MS = 350; // between two taps that are one gesture
const TAPS_APART = 30; // pixels

/** Of a picture that is shown whole, as a share of it. */
export const MARGIN = 0.04;

export class Viewport {
    /** box: [x0, y0, x1, y1] in um; onview: called when scale or place have changed */
    constructor(svg, { label, onview, pan = true } = {}) {
        this.svg = svg;
        this.world = s("g", { class: "world" });
        this.overlay = s("g", { class: "overlay" });
        svg.append(this.world, this.overlay);
        svg.setAttribute("tabindex", "0");
        svg.setAttribute("role", "application");
        svg.setAttribute("aria-roledescription", "picture that can be panned and zoomed");
        if (label) svg.setAttribute("aria-label", label);
        this.box = [0, 0, 1, 1];
        this.k = 1;
        this.x = 0;
        this.y = 0;
        this.onview = onview ?? (() => {});
        this.pan = pan;
        this.margin = () => MARGIN; // when all of it is shown
        this.fitted = true;
        this.fingers = new Map(); // pointers that are down -> where
        this.tapped = null;
        this.seen = [0, 0]; // its size, as it was told last: to ask for it would have the whole page laid out
        new ResizeObserver(() => this.#resized()).observe(svg);
        // paper has another size, and its layout tells nobody: what is seen on the screen is scaled onto it
        addEventListener("beforeprint", () => this.size.every((v) => v > 1) && svg.setAttribute("viewBox", `0 0 ${this.size.join(" ")}`));
        addEventListener("afterprint", () => {
            svg.removeAttribute("viewBox");
            this.#resized();
        });
        svg.addEventListener("wheel", (e) => this.#wheel(e), { passive: false });
        svg.addEventListener("pointerdown", (e) => this.#down(e));
        svg.addEventListener("keydown", (e) => this.#key(e));
    }

    get size() {
        return this.seen[0] && this.seen[1] ? this.seen : [this.svg.clientWidth || 1, this.svg.clientHeight || 1];
    }

    /** Sets what is to be seen; keeps the user's place unless it was the whole. */
    setBox(box, { fit = false } = {}) {
        const same = this.box.every((v, i) => Math.abs(v - box[i]) < 1e-9);
        this.box = box;
        if (fit || (this.fitted && !same)) this.fit();
    }

    fit() {
        this.fitTo(this.box, Math.min(this.margin(), 0.3));
        this.fitted = true;
        this.svg.classList.remove("zoomed");
    }

    /** Shows [x0, y0, x1, y1] with a share of the picture as margin. */
    fitTo([x0, y0, x1, y1], margin = 0.3) {
        const [w, h] = this.size;
        const k = Math.min(w / Math.max(x1 - x0, 1e-3), h / Math.max(y1 - y0, 1e-3)) * (1 - 2 * margin);
        this.k = Math.min(Math.max(k, 1e-6), MOST_SCALE);
        this.x = w / 2 - (this.k * (x0 + x1)) / 2;
        this.y = h / 2 + (this.k * (y0 + y1)) / 2;
        this.fitted = false;
        this.#apply();
    }

    zoom(factor, at = this.size.map((v) => v / 2)) {
        const extent = Math.max(this.box[2] - this.box[0], this.box[3] - this.box[1]);
        const k = Math.min(Math.max(this.k * factor, LEAST_PIXELS / extent), MOST_SCALE);
        const real = k / this.k;
        this.x = at[0] - (at[0] - this.x) * real;
        this.y = at[1] - (at[1] - this.y) * real;
        this.k = k;
        this.fitted = false;
        this.#apply();
    }

    move(dx, dy) {
        this.x += dx;
        this.y += dy;
        this.fitted = false;
        this.#apply();
    }

    /** Pixels of the picture to micrometres and back. */
    toWorld(px, py) {
        return [(px - this.x) / this.k, (this.y - py) / this.k];
    }
    toScreen(x, y) {
        return [this.x + this.k * x, this.y - this.k * y];
    }
    /** Micrometres under a pointer event. */
    at(event) {
        const r = this.svg.getBoundingClientRect();
        return this.toWorld(event.clientX - r.left, event.clientY - r.top);
    }

    #apply() {
        put(this.world, { transform: `matrix(${this.k} 0 0 ${-this.k} ${this.x} ${this.y})` });
        this.svg.classList.toggle("zoomed", !this.fitted); // then one finger moves it; else it scrolls the page
        this.onview(this);
    }

    #resized() {
        if (this.svg.hasAttribute("viewBox")) return; // on paper
        this.seen = [this.svg.clientWidth, this.svg.clientHeight];
        if (this.fitted) this.fit();
        else this.#apply();
    }

    #wheel(event) {
        if (event.defaultPrevented) return;
        event.preventDefault();
        const r = this.svg.getBoundingClientRect();
        const step = event.deltaY * (event.deltaMode === 1 ? 16 : 1);
        this.zoom(Math.exp(-step * 0.0016), [event.clientX - r.left, event.clientY - r.top]);
    }

    /** One finger or the mouse moves the picture, two zoom about the point between them. */
    #down(event) {
        if (event.defaultPrevented || event.button > 1 || !this.pan || this.fingers.size > 1) return;
        if (!this.fingers.size) {
            this.svg.addEventListener("pointermove", this.#moved);
            for (const end of ["pointerup", "pointercancel"]) this.svg.addEventListener(end, this.#up);
        }
        this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
        this.svg.setPointerCapture(event.pointerId);
        if (event.pointerType === "touch" && this.fingers.size === 1) this.#tapped(event);
    }

    #moved = (event) => {
        if (!this.fingers.has(event.pointerId)) return;
        const before = [...this.fingers.values()];
        this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
        const now = [...this.fingers.values()];
        const middle = (list) => [0, 1].map((k) => list.reduce((sum, p) => sum + p[k], 0) / list.length);
        const apart = ([p, q]) => Math.hypot(p[0] - q[0], p[1] - q[1]);
        const [a, b] = [middle(before), middle(now)];
        this.move(b[0] - a[0], b[1] - a[1]);
        if (now.length === 2 && apart(before) > 0 && apart(now) > 0) {
            const r = this.svg.getBoundingClientRect();
            this.zoom(apart(now) / apart(before), [b[0] - r.left, b[1] - r.top]);
        }
        this.tapped = null;
        this.svg.classList.add("panning");
    };

    #up = (event) => {
        this.fingers.delete(event.pointerId);
        if (this.fingers.size) return;
        this.svg.removeEventListener("pointermove", this.#moved);
        for (const end of ["pointerup", "pointercancel"]) this.svg.removeEventListener(end, this.#up);
        this.svg.classList.remove("panning");
    };

    /** Two taps at one place: closer, or the whole again. */
    #tapped(event) {
        const { tapped } = this;
        this.tapped = { time: event.timeStamp, x: event.clientX, y: event.clientY };
        if (!tapped || event.timeStamp - tapped.time > TAPS_MS || Math.hypot(event.clientX - tapped.x, event.clientY - tapped.y) > TAPS_APART) return;
        this.tapped = null;
        const r = this.svg.getBoundingClientRect();
        if (this.fitted) this.zoom(2.5, [event.clientX - r.left, event.clientY - r.top]);
        else this.fit();
    }

    #key(event) {
        if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
        const step = 60;
        const acts = {
            ArrowLeft: () => this.move(step, 0), ArrowRight: () => this.move(-step, 0),
            ArrowUp: () => this.move(0, step), ArrowDown: () => this.move(0, -step),
            "+": () => this.zoom(1.3), "=": () => this.zoom(1.3), "-": () => this.zoom(1 / 1.3),
            0: () => this.fit(), f: () => this.fit(),
        };
        if (!acts[event.key]) return;
        event.preventDefault();
        acts[event.key]();
    }
}

/** Length and words of a scale bar that is about `pixels` wide: {um, text}. */
export function scaleBar(k, pixels = 110) {
    const most = pixels / k;
    const power = 10 ** Math.floor(Math.log10(most));
    const um = [5, 2, 1].map((f) => f * power).find((v) => v <= most) ?? power;
    return { um, text: um >= 1000 ? `${um / 1000} mm` : um >= 1 ? `${um} µm` : `${um * 1000} nm` };
}
