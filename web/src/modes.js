// SPDX-License-Identifier: GPL-3.0-or-later
// Mode shapes, moving.
import { button, h, select } from "./dom.js";
import { deviceName, FRAMES_A_SECOND, filmMenu, record } from "./film.js";
import { degrees, percent, si } from "./format.js";
import { JobView } from "./jobs.js";
import { centred } from "./mechanism.js";
import { Split } from "./split.js";
import { Statics } from "./statics.js";
import { state } from "./store.js";

const PERIOD_S = 1.6;
const FEW = 6; // modes out of the plane in the list, as in the terminal
const RESTS = 1e-6; // rad, or of the device's size: less is no way to go

export class Modes extends Split {
    constructor(holder) {
        super(holder, { title: "Modes", label: "A mode shape of the mechanism, moving.", around: 0.08 });
        this.at = select("About", [["rest", "about rest"], ["equilibrium", "about the equilibrium"]], "rest", () => this.view.run());
        this.amplitude = h("input", { type: "range", min: 1, max: 100, value: 30, "aria-label": "Amplitude of the picture", oninput: () => this.draw() });
        this.moving = !matchMedia("(prefers-reduced-motion: reduce)").matches;
        this.pause = button(...this.#nextWord(), () => this.#toggle());
        this.card.append(h("div", { class: "row" }, this.at, this.pause, (this.film = filmMenu(() => this.#film(), () => `${deviceName()}-mode-${this.chosen + 1}`))), h("label", { class: "option" }, h("span", {}, "amplitude"), this.amplitude));
        this.view = new JobView(this.card, {
            kind: "modes", action: "Compute the modes", auto: true, options: () => ({ at: this.at.value, ...(state.options.scene ? { scene: state.options.scene } : {}) }),
            intro: "Natural frequencies, damping and shapes of small motions.", render: (job, into) => this.#list(job, into),
        });
        this.view.also(this.stage);
        this.statics = new Statics(this.card.parentElement);
        this.chosen = 0;
    }

    /** What the button does next. */
    #nextWord() {
        return [this.moving ? "Pause" : "Play", { icon: this.moving ? "pause" : "play", class: "small" }];
    }

    #toggle() {
        this.moving = !this.moving;
        this.pause.replaceChildren(...button(...this.#nextWord()).childNodes);
        if (this.moving) this.draw();
    }

    #list(job, into) {
        this.modes = job.result.modes;
        this.q = job.result.q;
        this.com = job.result.com;
        this.unit = job.result.unit_length_m;
        this.chosen = Math.min(this.chosen, Math.max(this.modes.length - 1, 0));
        const items = this.modes.map((m, i) => h("button", { type: "button", class: "mode", "aria-pressed": String(i === this.chosen), onclick: () => this.#choose(i) },
            h("strong", {}, `${i + 1}`), h("span", { class: "mode-f" }, m.kind === "free" ? "free" : m.kind === "unstable" ? "unstable" : si(m.f_Hz, "Hz", 4)),
            h("span", { class: "mode-d" }, m.damping_ratio !== null ? `damping ${percent(m.damping_ratio, 2).replace(" ", "\u00a0")}` : m.kind), h("span", { class: "mode-b" }, `moves most: ${m.bodies}`)));
        const own = job.result.frequency_error;
        const [lowest, across] = this.#across(job.result.out_of_plane);
        into.replaceChildren(lowest, h("h3", {}, "In the plane"), h("div", { class: "mode-list" }, items),
            this.modes.length ? h("p", { class: "doc mode-off" }, `${own === null ? "How far these frequencies are off is not known" : `These frequencies are off by up to ${percent(own)}: the model of the hinges, and half the error of a flexure's stiffness`}; bodies that bend make them lower.`) : "", across,
            h("p", { class: "doc" }, `Scene ${job.result.scene}, about ${job.result.at === "rest" ? "rest" : "the equilibrium"}.${job.result.out_of_rest > RESTS ? ` The loads hold it elsewhere: it would go on from there by some ${degrees(job.result.out_of_rest, 2)} or ${si(job.result.out_of_rest * this.unit, "m", 2)}; choose the equilibrium.` : ""}`));
        this.draw();
    }

    /** The modes out of the plane, before those in it: the lowest of all may be one of them. */
    #across(across) {
        if (!across) return ["", ""];
        const all = [...this.modes.filter((m) => m.f_Hz > 0).map((m) => [m.f_Hz, "in the plane"]), ...across.modes.map((m) => [m.f_Hz, `out of the plane, ${m.body} ${m.kind === "tilt" ? "tilts" : "goes up and down"}`])];
        const [f, where] = all.reduce((a, b) => (b[0] < a[0] ? b : a), all[0] ?? [NaN, ""]);
        const lowest = Number.isFinite(f) ? h("p", { class: "mode-lowest" }, "Lowest of all: ", h("strong", {}, si(f, "Hz", 4)), `, ${where}${across.known ? "" : "; those out of the plane are not known"}.`) : "";
        const more = across.modes.slice(FEW);
        const rows = across.modes.slice(0, FEW).map((m) => h("li", {}, h("strong", {}, si(m.f_Hz, "Hz", 4)), ` ${m.body} ${m.kind === "tilt" ? "tilts" : "goes up and down"}`));
        return [lowest, h("details", { class: "mode-across", open: true }, h("summary", {}, "Out of the plane"),
            across.known ? h("ul", {}, rows, more.length ? h("li", {}, `and ${more.length} more, up to ${si(more.at(-1).f_Hz, "Hz", 4)}`) : "") : h("p", {}, `Not known: ${across.why ?? ""}.`),
            across.known ? h("p", { class: "doc" }, `Of rigid bodies on their flexures, as drawn${across.with_loads ? "" : " and without loads"}: off by up to ${percent(across.frequency_error)}, and lower with bodies that bend; the verdict's band has both.`) : "")];
    }

    #choose(i) {
        this.chosen = i;
        this.card.querySelectorAll(".mode").forEach((b, k) => b.setAttribute("aria-pressed", String(k === i)));
        this.#frame(this.phase ?? 0);
        if (this.moving) this.draw();
    }

    #frame(phase) {
        const p = state.preview;
        const mode = this.modes?.[this.chosen];
        if (!p || !mode) return;
        const size = (Number(this.amplitude.value) / 100) * 0.45 * Math.sin(phase);
        this.mechanism.pose(p.bodies.map((b) => {
            const shape = mode.shape[b.id];
            if (!shape || !this.q[b.id]) return b.rest ?? [0, 0, 0];
            return centred(this.q[b.id].map((x, j) => x + size * shape[j]), b.id, this.q, this.com);
        }));
    }

    /** One period of the chosen shape. */
    async #film() {
        const mode = this.modes?.[this.chosen];
        if (!mode) throw new Error("no mode is chosen");
        const [p, moving] = [state.preview, this.moving];
        if (moving) this.#toggle();
        const n = Math.round(PERIOD_S * FRAMES_A_SECOND);
        try {
            return await record(this.mechanism.svg, {
                n, seconds: PERIOD_S, cancelled: () => state.preview !== p || !this.visible || this.moving || mode !== this.modes?.[this.chosen],
                show: (i) => this.#frame((2 * Math.PI * i) / n),
                caption: () => `${deviceName()}, mode ${this.chosen + 1}${Number.isFinite(mode.f_Hz) ? `: ${si(mode.f_Hz, "Hz", 4)}` : ""}; the size of the motion is free`,
            });
        } finally {
            if (moving) this.#toggle();
        }
    }

    draw() {
        if (this.running) return;
        if (!this.moving) {
            this.#frame(Math.PI / 2);
            return;
        }
        this.running = true;
        const begin = performance.now();
        const frame = (now) => {
            if (!this.visible || !this.moving) {
                this.running = false;
                return;
            }
            this.phase = ((now - begin) / 1e3 / PERIOD_S) * 2 * Math.PI;
            this.#frame(this.phase);
            requestAnimationFrame(frame);
        };
        requestAnimationFrame(frame);
    }
}
