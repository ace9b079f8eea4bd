// SPDX-License-Identifier: GPL-3.0-or-later
// The workspace by hand: the platform is dragged, the server answers with the pose of the whole
// mechanism and what every hinge then needs of its limit. The certified set is a job.
import { newest, post } from "./api.js";
import { inputKey, look, mayChange, requestKey, Shown } from "./belong.js";
import { scale } from "./colours.js";
import { request } from "./design.js";
import { announce, button, h, s, select, setOptions } from "./dom.js";
import { degrees, fixed, micrometres, number } from "./format.js";
import { fileOf, hasFile, JobView } from "./jobs.js";
import { colourLegend, Mechanism, posesOf } from "./mechanism.js";
import { zoomButtons } from "./motion.js";
import { lookAt, on, state } from "./store.js";

const HANDLE_PIXELS = 64; // from the platform to its handle of rotation
const GRIP_PIXELS = 10; // of that handle, which must not leave the picture
const RESTS = 1e-9; // share of a limit: less is none

export class Workspace {
    constructor(holder) {
        this.at = { x_m: 0, y_m: 0, phi_rad: 0 };
        this.stage = h("div", { class: "stage" });
        this.side = h("div", { class: "side-panel" });
        holder.append(h("div", { class: "split" }, this.stage, this.side));
        this.mechanism = new Mechanism(this.stage, { label: "Workspace: drag the platform, or use the numbers beside the picture.", onhinge: lookAt, around: 0.12 });
        this.stage.append(colourLegend(), zoomButtons(() => this.mechanism.view));
        this.boxes = s("g", { class: "boxes" });
        this.mechanism.above.append(this.boxes);
        this.handle = s("g", { class: "handle", tabindex: 0, role: "slider", "aria-label": "Platform: arrow keys move by 5 µm, with Shift by 50; square brackets turn", "aria-valuetext": "at rest", "aria-valuenow": 0, "aria-valuemin": -1, "aria-valuemax": 1 },
            s("circle", { r: 11, class: "grip" }), s("path", { d: "M-6 0h12M0-6v12", class: "grip-cross" }));
        this.turner = s("g", { class: "handle turner", "aria-hidden": "true" }, s("line", { class: "turn-line" }), s("circle", { r: 8, class: "grip" }));
        this.mechanism.view.overlay.append(this.turner, this.handle);
        const base = this.mechanism.view.onview;
        this.mechanism.view.onview = (v) => {
            base(v);
            this.#handles();
        };
        this.#panel();
        this.#drag(this.handle, (p, from) => this.ask({ ...this.at, x_m: from.at.x_m + (p[0] - from.p[0]) * 1e-6, y_m: from.at.y_m + (p[1] - from.p[1]) * 1e-6 }));
        this.#drag(this.turner, (p, from) => {
            const c = this.#centre();
            const turn = Math.atan2(p[1] - c[1], p[0] - c[0]) - Math.atan2(from.p[1] - from.centre[1], from.p[0] - from.centre[0]);
            this.ask({ ...this.at, phi_rad: wrap(from.at.phi_rad + turn) });
        });
        this.handle.addEventListener("keydown", (e) => this.#key(e));
        this.handle.addEventListener("wheel", (e) => {
            e.preventDefault();
            e.stopPropagation();
            this.ask({ ...this.at, phi_rad: this.at.phi_rad - Math.sign(e.deltaY) * 0.005 });
        }, { passive: false });
        this.send = newest(({ body }, signal) => post("/api/pose", body, { signal }), (answer, input) => this.#answer(answer, input), (error, { key }) => {
            if (!error.lost) this.#refused(error.message, key);
        }, { words: "Computing the pose" });
        mayChange(() => this.send.busy);
        const pose = () => this.#input();
        this.showing = [this.stage, this.status, this.list].map((element) => new Shown(element, pose));
        this.drawn = new Shown(this.stage);
        on("picture", () => this.visible && state.picture === state.preview && this.show());
        on("hinge", () => this.#colour());
    }

    #panel() {
        this.flow = select("Flow", [], "", () => this.show());
        this.body = select("Body that is dragged", [], "", () => {
            this.last = undefined;
            this.platform = null;
            this.ask({ x_m: 0, y_m: 0, phi_rad: 0 });
        });
        const box = (label, unit, key, factor) => {
            const input = h("input", { type: "number", step: unit === "°" ? 0.1 : 1, value: 0, id: `pose-${key}` });
            input.addEventListener("change", () => Number.isFinite(input.valueAsNumber) && this.ask({ ...this.at, [key]: input.valueAsNumber / factor }));
            this[key] = input;
            return h("label", { class: "pose-field" }, h("span", {}, `${label} (${unit})`), input);
        };
        this.status = h("p", { class: "pose-status", role: "status" });
        this.list = h("div", { class: "pose-hinges" });
        const job = h("section", { class: "card" }, h("h2", {}, "Certified set"));
        this.side.append(
            h("section", { class: "card" }, h("h2", {}, "Platform, from rest"),
                h("div", { class: "row" }, h("label", { class: "option" }, h("span", {}, "body"), this.body), h("label", { class: "option" }, h("span", {}, "flow"), this.flow)),
                h("div", { class: "pose-fields" }, box("x", "µm", "x_m", 1e6), box("y", "µm", "y_m", 1e6), box("φ", "°", "phi_rad", 180 / Math.PI)),
                button("Back to rest", { class: "small" }, () => this.ask({ x_m: 0, y_m: 0, phi_rad: 0 })),
                this.status, this.list, h("p", { class: "doc" }, "By rotation alone; the verdict also counts the forces that hold a required pose.")),
            job);
        this.view = new JobView(job, {
            kind: "workspace", action: "Compute the reachable set", options: () => ({}),
            intro: "All poses of the platform at which no hinge is beyond its elastic limit, enclosed by interval arithmetic: every number is proved.",
            render: (j, into) => this.#certified(j, into),
        });
    }

    shown(yes) {
        this.visible = yes;
        this.view.show(yes);
        if (yes) this.show();
    }

    show() {
        const p = state.preview;
        if (!p) return;
        setOptions(this.flow, p.flows.map((f) => [f.name, f.name]), this.flow.value || p.flows[0]?.name);
        const bodies = p.bodies.filter((b) => !b.fixed);
        setOptions(this.body, bodies.map((b) => [b.id, b.platform ? `${b.id}, platform` : b.id]), this.body.value || (bodies.find((b) => b.platform) ?? bodies[0])?.id);
        this.mechanism.show(p);
        this.drawn.take(state.previewOf);
        this.#required();
        this.ask(this.at);
    }

    /** What a pose depends on. */
    #input(make = inputKey) {
        return make({ ...state.options, flow: this.flow.value, body: this.body.value, at: this.at });
    }

    ask(at) {
        this.at = at;
        this.x_m.value = round(at.x_m * 1e6, 2);
        this.y_m.value = round(at.y_m * 1e6, 2);
        this.phi_rad.value = round((at.phi_rad * 180) / Math.PI, 3);
        if (this.stage.offsetParent === null) return; // not on the screen
        look();
        if (requestKey() !== state.previewOf) return; // the picture is of another input; its preview asks again
        const body = { ...request(), flow: this.flow.value || undefined, body: this.body.value || undefined, platform: at, q: this.last };
        this.send.ask({ body, key: this.#input(requestKey), of: requestKey() });
    }

    /** No pose: what is shown is of the last one. */
    #refused(message, key) {
        this.status.textContent = message;
        this.#good(false);
        this.showing[1].take(key);
    }

    #good(good) {
        this.status.classList.toggle("good", good);
        this.status.classList.toggle("bad", !good);
    }

    #answer(answer, { key, of }) {
        if (of !== state.previewOf) return; // the picture is of another input; its preview asks again
        if (answer.status && answer.status !== "ok") return this.#refused(answer.diagnostics?.find((d) => d.severity === "error")?.message ?? "no pose for this device", key);
        const present = key === this.#input();
        const first = this.platform !== answer.body;
        this.platform = answer.body;
        this.last = answer.how === "assembly" ? answer.q : undefined;
        if (present) this.body.value = answer.body; // what was chosen, or the platform where nothing was
        for (const shown of this.showing) shown.take(present ? this.#input() : key);
        this.mechanism.pose(posesOf(state.preview, answer.q));
        if (first) this.#required();
        const flow = answer.flows.find((f) => f.name === answer.flow) ?? answer.flows[0];
        this.hinges = flow.hinges;
        this.#colour();
        this.#handles();
        const use = flow.utilisation ?? 0;
        const words = !answer.reachable ? `Out of reach: ${answer.reason ?? "the joints do not let it go there; the nearest pose is shown"}.`
            : flow.governing === null ? "No hinge of this device has a limit."
            : use < RESTS ? "At rest: no hinge is bent."
            : use > 1 ? `Hinge ${flow.governing} would be beyond its limit: ${fixed(use * 100, 1)} %.` : `Within the limits; hinge ${flow.governing} governs with ${fixed(use * 100, 1)} %.`;
        if (this.status.textContent !== words) this.status.textContent = words;
        this.#good(answer.reachable && use <= 1);
        this.handle.setAttribute("aria-valuetext", `x ${micrometres(this.at.x_m)}, y ${micrometres(this.at.y_m)}, turned by ${degrees(this.at.phi_rad)}; ${words}`);
        this.list.replaceChildren(...flow.hinges.map((x) => h("div", { class: `pose-hinge${x.utilisation > 1 ? " over" : ""}` },
            h("span", { class: "bar-id" }, x.id),
            h("span", { class: "bar-track" }, h("span", { class: "pose-fill", style: { width: `${Math.min((x.utilisation ?? 0) * 80, 100)}%`, background: scale(x.utilisation ?? 0) } }), h("span", { class: "pose-limit" })),
            h("span", { class: "bar-value" }, `${fixed((x.angle_rad * 180) / Math.PI, 2)}°`), h("span", { class: "bar-value" }, `${fixed(x.utilisation * 100, 1)} %`))));
    }

    #colour() {
        if (this.hinges) this.mechanism.colour(new Map(this.hinges.map((x) => [x.id, x.utilisation])), state.hinge);
    }

    #centre() {
        const p = state.preview;
        const i = p ? p.bodies.findIndex((b) => b.id === this.platform) : -1;
        const q = i >= 0 ? this.mechanism.q?.[i] : null;
        return q ? [q[0] * 1e6, q[1] * 1e6, q[2]] : [0, 0, 0];
    }

    #handles() {
        const there = Boolean(this.platform && this.mechanism.q);
        this.handle.classList.toggle("none", !there);
        this.turner.classList.toggle("none", !there);
        if (!there) return;
        const c = this.#centre();
        const [x, y] = this.mechanism.view.toScreen(c[0], c[1]);
        this.handle.setAttribute("transform", `translate(${x} ${y})`);
        const angle = c[2] + Math.PI / 2;
        const [w, height] = this.mechanism.view.size;
        const inside = (sign) => [[x + sign * HANDLE_PIXELS * Math.cos(angle), w], [y - sign * HANDLE_PIXELS * Math.sin(angle), height]].every(([v, end]) => v > GRIP_PIXELS && v < end - GRIP_PIXELS);
        const side = inside(1) || !inside(-1) ? 1 : -1; // where there is no room it stands on the other side
        const dx = side * HANDLE_PIXELS * Math.cos(angle);
        const dy = -side * HANDLE_PIXELS * Math.sin(angle);
        this.turner.setAttribute("transform", `translate(${x + dx} ${y + dy})`);
        const line = this.turner.querySelector("line");
        line.setAttribute("x2", -dx * 0.82);
        line.setAttribute("y2", -dy * 0.82);
    }

    #drag(target, moved) {
        target.addEventListener("pointerdown", (event) => {
            event.preventDefault();
            target.setPointerCapture(event.pointerId);
            target.focus?.({ preventScroll: true }); // the picture stays below the pointer
            const from = { p: this.mechanism.view.at(event), at: { ...this.at }, centre: this.#centre() };
            const move = (e) => moved(this.mechanism.view.at(e), from);
            const up = () => {
                target.removeEventListener("pointermove", move);
                target.removeEventListener("pointerup", up);
                target.removeEventListener("pointercancel", up);
            };
            target.addEventListener("pointermove", move);
            target.addEventListener("pointerup", up);
            target.addEventListener("pointercancel", up);
        });
    }

    #key(event) {
        const step = (event.shiftKey ? 50 : 5) * 1e-6;
        const turn = ((event.shiftKey ? 1 : 0.1) * Math.PI) / 180;
        const by = {
            ArrowLeft: [-step, 0, 0], ArrowRight: [step, 0, 0], ArrowUp: [0, step, 0], ArrowDown: [0, -step, 0],
            "[": [0, 0, turn], "]": [0, 0, -turn], "{": [0, 0, turn], "}": [0, 0, -turn],
        }[event.key];
        if (event.key === "Home") this.ask({ x_m: 0, y_m: 0, phi_rad: 0 });
        else if (by) this.ask({ x_m: this.at.x_m + by[0], y_m: this.at.y_m + by[1], phi_rad: this.at.phi_rad + by[2] });
        else return;
        event.preventDefault();
        event.stopPropagation();
    }

    /** Required boxes of this flow, about the platform at rest. */
    #required() {
        const p = state.preview;
        const i = p.bodies.findIndex((b) => b.id === this.platform);
        const rest = i >= 0 ? p.bodies[i].rest : null;
        const list = rest ? (p.verdict?.workspace?.required ?? []).filter((r) => r.flow === this.flow.value) : [];
        this.boxes.replaceChildren(...list.map((r) => s("rect", {
            class: "required-box", x: (rest[0] + r.x_m[0]) * 1e6, y: (rest[1] + r.y_m[0]) * 1e6,
            width: (r.x_m[1] - r.x_m[0]) * 1e6, height: (r.y_m[1] - r.y_m[0]) * 1e6,
        }, s("title", {}, "required workspace"))));
    }

    #certified(job, into) {
        const flows = job.result.flows ?? [];
        into.replaceChildren(...flows.map((f) => {
            if (!f.reachable?.volume) return h("p", {}, `${f.flow}: ${f.reachable?.none ?? f.reachable ?? "no set"}`);
            const r = f.reachable;
            const range = (e, factor, unit) => `${number(e[0][1] * factor, 4)} to ${number(e[1][0] * factor, 4)} ${unit}`;
            return h("div", { class: "certified" }, h("h3", {}, f.flow), h("dl", { class: "facts-list" },
                [["x", range(r.extents.x_m, 1e6, "µm")], ["y", range(r.extents.y_m, 1e6, "µm")], ["φ", range(r.extents.phi_rad, 180 / Math.PI, "°")],
                    ["volume", `${number(r.volume.m2_rad[0] * 1e6, 3)} to ${number(r.volume.m2_rad[1] * 1e6, 3)} mm² rad`],
                    ["required box", f.required?.length ? (f.required.every((b) => b.certified) ? "inside, proved" : "not proved") : "none"]].flatMap(([k, v]) => [h("dt", {}, k), h("dd", {}, v)])));
        }), hasFile(job, "workspace.svg") ? h("a", { href: fileOf(job, "workspace.svg"), target: "_blank", rel: "noopener", class: "picture-link" }, h("img", { src: fileOf(job, "workspace.svg"), alt: "Areas that are reachable at constant rotation" })) : "");
        announce("reachable set computed");
    }
}

const round = (x, digits) => Number(x.toFixed(digits));
const wrap = (a) => Math.atan2(Math.sin(a), Math.cos(a));
