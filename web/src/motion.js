// SPDX-License-Identifier: GPL-3.0-or-later
// The motion of one scene: the mechanism, its plots and the time that couples them; and how it is
// computed, with what that costs.
import { alike as same } from "./alike.js";
import { Shown } from "./belong.js";
import { curve, dark, dash } from "./colours.js";
import { coursesOf, ENERGIES, pointAt, pointsOf } from "./courses.js";
import { setOption } from "./design.js";
import { become, button, h, put, s, say, select, setGroups, setOptions } from "./dom.js";
import { deviceName, FRAMES_A_SECOND, filmMenu, record } from "./film.js";
import { degrees, micrometres, number, percent, prefixOf, si } from "./format.js";
import { leftOutCsv, leftOutList, leftOutOf, leftOutSvg } from "./leftout.js";
import { colourLegend, Mechanism, posesOf, restOf } from "./mechanism.js";
import { Plot } from "./plots.js";
import { hasPins, isUnknown, whyUnknown, withBand } from "./purpose.js";
import { emit, lookAt, on, state } from "./store.js";

const SECONDS = 4; // that a whole scene takes at speed 1
const FRAMES_MOST = 250; // of a film
const ROUNDING = { rad: 1e-12, m: 1e-15 }; // below it a course that nobody has judged is none
const CLOSED = 1e-9; // norm of the joints' gaps below which they are closed but for rounding
const RTOL = ["1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11"]; // what explicit integrators take

/** What --accuracy is offered beside 1e-3, which it is by itself. */
export const ACCURACIES = ["1e-2", "1e-4", "1e-5"];

/** The angle of a pin at which it uses all of the limit that rules in this motion, rad, or null. */
const limitOf = (pin) => pin.shown_limit_rad ?? null;

/** Of an answer what the picture shows. */
const seen = (p) => [p.scenes, p.bodies, p.flexures, p.loads, p.ties, p.springs, p.marks, p.scene_box_um, p.pins.map((x) => [x.id, x.at_um, x.shown_limit_rad, x.shown_criterion]),
    p.motion && ["scene", "t_s", "q", "angle_rad", "load_factor", "tension_N"].map((k) => p.motion[k] ?? null)];

/** Options of a <select> from a list of the table: [value, text, sentence]. */
const optionNames = (list) => (list ?? []).map((o) => (typeof o === "string" ? [o, o] : [o.name, o.name, o.sentence]));

export class Motion {
    constructor(holder) {
        this.time = 0;
        this.speed = 1;
        this.playing = false;
        this.showPaths = button("Paths", { class: "small", "aria-pressed": "false", title: "of the centres of mass, and of the points that loads act on" }, () => {
            this.showPaths.setAttribute("aria-pressed", String(this.showPaths.getAttribute("aria-pressed") !== "true"));
            this.#paths();
        });
        this.tools = h("div", { class: "toolbar", role: "group", "aria-label": "How the motion is computed" });
        this.stage = h("div", { class: "stage" });
        this.player = h("div", { class: "player", role: "group", "aria-label": "Time" });
        this.plots = h("div", { class: "plots" });
        holder.append(this.tools, this.stage, this.player, this.plots);
        this.mechanism = new Mechanism(this.stage, { label: "The mechanism in motion. Arrow keys pan, plus and minus zoom, 0 fits.", onhinge: lookAt, scene: true });
        this.stage.append(colourLegend(), this.#zoomButtons(), h("div", { class: "stage-tools" }, this.showPaths, (this.film = filmMenu(() => this.#film(), () => `${deviceName()}-${state.preview.motion.scene}`))));
        this.paths = s("g", { class: "paths", "aria-hidden": "true" });
        this.mechanism.above.append(this.paths);
        this.stats = h("div", { class: "run-stats" });
        this.pictured = [this.stage, this.player].map((element) => new Shown(element));
        this.written = [this.plots, this.stats].map((element) => new Shown(element));
        this.#player();
        const seek = (t) => this.seek(t / 1e3, true);
        const onwindow = (window) => [this.angles, this.energy, this.course].forEach((plot) => plot.setWindow(window)); // one time for all
        this.angles = new Plot(this.plots, { title: "Share of the limit", unit: "%, over ms", onseek: seek, onwindow });
        this.energy = new Plot(this.plots, { title: "Energy", unit: "nJ, over ms", onseek: seek, onwindow });
        this.course = new Plot(this.plots, { title: "What is plotted", unit: "", onseek: seek, onwindow });
        this.whichCourse = select("What is plotted", [], "", () => this.#choose(this.whichCourse.value));
        this.course.heading.firstChild.replaceWith(this.whichCourse);
        this.inDegrees = button("degrees", { class: "small toggle", "aria-pressed": "false" }, () => {
            this.inDegrees.setAttribute("aria-pressed", String(this.inDegrees.getAttribute("aria-pressed") !== "true"));
            this.#plotAll();
            this.paint(); // and the heading tells what is plotted
        });
        this.angles.heading.append(this.inDegrees);
        on("options", () => this.picks?.forEach((refresh) => refresh()));
        on("picture", () => this.visible && this.#came());
        on("preview", () => this.visible && (this.of === state.picture ? this.#rest() : this.show()));
        on("judged", () => this.visible && this.courseShown?.unknown && this.#plotCourse(state.preview));
        for (const event of ["hinge", "theme", "pinned"]) on(event, () => this.visible && this.show());
    }

    shown(yes) {
        this.visible = yes;
        if (yes) this.show();
        else this.toggle(false);
    }

    start(table) {
        const o = table.options ?? table;
        this.picks = [];
        const pick = (label, name, list, first) => {
            const names = [["", first], ...optionNames(list).filter(([v]) => v !== "auto" || first !== "auto")];
            const box = select(label, names, "", (v) => setOption(name, v));
            this.picks.push(() => { // chosen elsewhere, and maybe none of the list
                const now = state.options[name] ?? "";
                setOptions(box, names.some(([v]) => v === now) ? names : [...names, [now, now]], now);
            });
            return h("label", { class: "option" }, h("span", {}, label), box);
        };
        this.scene = select("Scene", [], "", (v) => setOption("scene", v), { id: "scene" });
        const defaults = table.defaults ?? {};
        this.tools.replaceChildren(
            h("label", { class: "option" }, h("span", {}, "scene"), this.scene),
            pick("method", "method", o.methods, defaults.method ?? "chain"),
            pick("integrator", "integrator", o.integrators, "auto"),
            pick("stabilise", "stabilise", o.stabilisations, defaults.stabilise ?? "projection"),
            pick("tolerance", "rtol", RTOL, "auto"),
            pick("hinges", "hinge_model", o.hinge_models, "auto"),
            pick("effects", "effects", ["all", "none"], "auto"),
            pick("accuracy", "accuracy", ACCURACIES, "1e-3"),
            this.stats);
    }

    #zoomButtons() {
        return zoomButtons(() => this.mechanism.view);
    }

    #player() {
        this.play = button("Play", { icon: "play", hidden: true, class: "play" }, () => this.toggle());
        this.slider = h("input", { type: "range", min: 0, max: 1000, step: 1, value: 0, class: "time", "aria-label": "Time of the scene" });
        this.slider.addEventListener("input", () => this.seek((this.slider.value / 1000) * this.#end(), true));
        this.clock = h("output", { class: "clock" });
        const speeds = [["0.1", "0.1×"], ["0.25", "¼×"], ["0.5", "½×"], ["1", "1×"], ["2", "2×"]];
        this.player.append(this.play, this.slider, this.clock, select("Speed", speeds, "1", (v) => (this.speed = Number(v))));
    }

    #end() {
        return this.t?.at(-1) || 1;
    }

    /** The same device was asked for in another way: all of it is there. */
    #again() {
        this.of = state.picture;
        for (const shown of [...this.pictured, ...(this.plotted ? this.written : [])]) shown.take(state.pictureOf);
        if (this.plotted) this.plotted = this.of;
    }

    show() {
        if (!state.preview) return;
        this.#picture();
        this.#rest();
    }

    /** Another picture: of the same device in another way, the one that is there already with all else of its answer, or a new one. */
    #came() {
        if (state.same && state.same === this.of) return this.#again();
        if (!this.of || !same(seen(state.picture), seen(this.of))) return this.#picture();
        this.#begin();
    }

    #begin() {
        this.of = state.picture;
        if (state.picture === state.preview) this.plotted = null; // whose curves are there
        for (const shown of this.pictured) shown.take(state.pictureOf);
    }

    /** What is looked at first. */
    #picture() {
        this.#begin();
        const p = this.of;
        const scenes = p.scenes.map((x) => [x.name, x.name]);
        const scene = state.options.scene ?? p.motion?.scene ?? ""; // chosen, and maybe none of the list
        setOptions(this.scene, !scene || p.scenes.some((x) => x.name === scene) ? scenes : [...scenes, [scene, scene]], scene);
        for (const element of [this.player, this.plots, this.film]) become(element, { hidden: !p.motion });
        if (!p.motion) return this.#still(p);
        const first = this.t === undefined;
        const share = this.t ? this.time / this.#end() : 0;
        this.t = p.motion.t_s;
        this.time = first ? peakTime(p) : share * this.#end();
        const rules = [...new Set(p.pins.map((pin) => pin.shown_criterion).filter(Boolean))];
        this.rule = rules.length === 1 ? `${rules[0]} limit` : "limit";
        this.mechanism.show(p, { posed: true });
        this.mechanism.setLoads(loadsOf(p));
        this.#paths();
        this.paint();
    }

    /** What is read. */
    #rest() {
        const p = state.preview;
        for (const shown of this.written) shown.take(state.previewOf);
        const done = this.plotted === p;
        this.plotted = p;
        if (!p.motion) {
            this.stats.textContent = p.scenes.length ? "this scene was not moved; the notes say why" : "the description has no scene";
            return;
        }
        if (!done) this.#plotAll();
        this.#stats();
        this.#cursors();
    }

    /** Nothing was moved: the device at rest. */
    #still(p) {
        this.t = null;
        this.toggle(false);
        this.mechanism.show(p);
        this.mechanism.setLoads([]);
        this.paths.replaceChildren();
        this.mechanism.pose(restOf(p));
        this.#pinned();
        this.mechanism.colour(new Map(), state.hinge);
    }

    /** Where the motion takes what moves. */
    #paths() {
        const p = state.picture;
        const shown = this.showPaths.getAttribute("aria-pressed") === "true" && p?.motion;
        if (!shown) return this.paths.replaceChildren();
        this.paths.replaceChildren(...pointsOf(p).map((x) => s("path", { d: `M${p.motion.q.map((row) => pointAt(row, x).map((v) => v.toFixed(3)).join(" ")).join("L")}` })));
    }

    #stats() {
        const m = state.preview.motion;
        const stats = m.stats ?? {};
        const { gap } = this;
        const facts = [m.method, m.integrator, state.preview.hinge_model ? `hinges: ${state.preview.hinge_model}` : null, m.rtol ? `rtol ${number(m.rtol, 2)}` : null, `${number(stats.steps, 6)} steps`, `${number(stats.rhs, 6)} evaluations`,
            stats.cpu_s !== undefined ? `${si(stats.cpu_s, "s", 2)} CPU` : null, gap <= CLOSED && gap !== null ? `joints closed to ${number(gap, 2)}` : null];
        const hidden = notDrawn(state.preview);
        if (hidden.length) facts.push(`not drawn: ${hidden.join(", ")}`);
        say(this.stats, facts.filter(Boolean).join(" · "));
        this.stats.title = [m.reason, state.preview.hinge_model_why].filter(Boolean).join("; ");
    }

    #plotAll() {
        const p = state.preview;
        if (!p?.motion || this.plotted !== p) return;
        const m = p.motion;
        const ms = m.t_s.map((t) => t * 1e3);
        if (this.lasts !== ms.at(-1)) for (const plot of [this.angles, this.energy, this.course]) plot.window = null; // what was looked at closely is of another length
        this.lasts = ms.at(-1);
        const limits = p.pins.map(limitOf);
        const inDegrees = this.inDegrees.getAttribute("aria-pressed") === "true" || limits.every((x) => !x);
        const chosen = state.hinge !== null && p.pins.some((x) => x.id === state.hinge) ? state.hinge : null;
        const series = p.pins.map((pin, i) => {
            const factor = inDegrees ? 180 / Math.PI : limits[i] ? 100 / limits[i] : NaN;
            return { name: pin.id, key: i, values: m.angle_rad.map((row) => (Number.isFinite(factor) && row[i] !== null ? row[i] * factor : null)) };
        });
        series.push(...this.#anglesThen(ms, inDegrees));
        let marks = [{ y: 100, text: this.rule }, { y: -100 }];
        if (inDegrees) marks = p.pins.flatMap((pin, i) => (limits[i] && (chosen === null || chosen === pin.id) ? [1, -1].map((f) => ({ y: (f * limits[i] * 180) / Math.PI, curve: i })) : []));
        const most = Math.max(...m.angle_rad.map((row) => Math.max(...row.map((a, i) => (limits[i] ? Math.abs(a) / limits[i] : 0)))));
        say(this.angles.heading.firstChild, inDegrees ? "Hinge angle" : "Share of the limit");
        say(this.angles.heading.children[1], inDegrees ? "degrees, over ms" : "%, over ms");
        this.angles.show(ms, series, { marks, chosen, range: inDegrees ? undefined : most > 0.4 ? [-112, 112] : undefined });
        const energies = ENERGIES.filter(([, k]) => m.energy?.[k]);
        const largest = Math.max(0, ...energies.flatMap(([, k]) => m.energy[k].map((x) => Math.abs(x ?? 0))));
        const [prefix, size] = prefixOf(largest);
        say(this.energy.heading.children[1], `${prefix}J, over ms`);
        this.energy.show(ms, energies.map(([name, k], i) => ({ name, key: i, values: m.energy[k].map((x) => (x === null ? null : x / size)) })));
        this.gap = m.constraint_norm ? Math.max(0, ...m.constraint_norm.map((x) => x ?? 0)) : null;
        this.plots.classList.toggle("two", energies.length === 0);
        become(this.energy.root, { hidden: energies.length === 0 }); // a row of equilibria has none
        this.#plotCourse(p);
        this.#legend(p, energies);
    }

    /** The same curves of the pinned version, at the times of this one. */
    #anglesThen(ms, inDegrees) {
        const p = state.pinned?.preview;
        if (!p?.motion) return [];
        return state.preview.pins.flatMap((pin, key) => {
            const k = p.pins.findIndex((x) => x.id === pin.id);
            const factor = inDegrees ? 180 / Math.PI : 100 / limitOf(p.pins[k] ?? {});
            if (k < 0 || !Number.isFinite(factor)) return [];
            return [{ name: `${pin.id}, then`, then: pin.id, key, values: alike(ms, p.motion.t_s.map((t) => t * 1e3), (i) => p.motion.angle_rad[i][k] * factor) }];
        });
    }

    /** Somebody wants to see another course; velocities are asked for when they are wanted. */
    #choose(id) {
        this.chosenCourse = id;
        const one = coursesOf(state.preview).find((x) => x.id === id);
        const asked = state.rates;
        state.rates = Boolean(one?.rates);
        if (state.rates && !asked && !state.preview.motion.v) emit("change");
        this.#plotCourse(state.preview);
        this.paint();
    }

    /** One of the courses: a probe with the bounds of what is required of it, velocities, where points are. What nobody has chosen is the
     *  first probe that something is required of; without probes how far points come, or the joints' gap where that is more than rounding. */
    #plotCourse(p) {
        const list = coursesOf(p);
        const required = (id) => (p.verdict?.requirements ?? []).filter((r) => r.probe === id && r.scene === p.motion.scene && (r.flow ?? null) === (p.motion.flow ?? null));
        const usual = this.gap > CLOSED ? list.find((x) => x.id === ":gap") : list.find((x) => x.probe && required(x.id).length) ?? list[0];
        const one = list.find((x) => x.id === this.chosenCourse) ?? usual;
        become(this.course.root, { hidden: !one });
        this.courseShown = one ?? null;
        this.courseUnit = 1; // of the plotted numbers, in SI
        if (!one) return;
        setGroups(this.whichCourse, list.map((x) => [x.group, x.id, x.label]), one.id);
        if (one.id === ":left") return this.#leftOut(p);
        const ms = p.motion.t_s.map((t) => t * 1e3);
        const curves = one.rates && !p.motion.v ? [] : one.curves();
        const unknown = one.of ? this.#unknown(p, one) : null;
        if (unknown) return this.#instead(one, unknown);
        const [prefix, size] = one.log ? ["", 1] : prefixOf(Math.max(0, ...curves.flatMap((x) => x.values.map((v) => Math.abs(v ?? 0)))));
        this.courseUnit = size;
        const levels = one.probe ? required(one.id).filter((r) => ["peak", "maximum", "minimum", "final"].includes(r.measure)) : [];
        const marks = levels.flatMap((r) => [[r.min, "at least"], [r.max, "at most"]].filter(([y]) => y !== null).map(([y, text]) => ({ y: y / size, text: `${r.measure}: ${text}` })));
        say(this.course.heading.querySelector(".plot-unit"), [one.kind, one.log ? "norm" : `${prefix}${one.unit}`, one.of && hasPins(p) ? "hinges as pins" : ""].filter(Boolean).join(", "));
        const key = (i) => (one.probe ? 2 : i);
        const series = curves.map((x, i) => ({ name: x.name, key: key(i), solid: curves.length === 1, values: x.values.map((v) => (v === null ? null : v / size)) }));
        const old = state.pinned?.preview;
        const other = old?.motion && !(one.rates && !old.motion.v) ? coursesOf(old).find((x) => x.id === one.id && x.unit === one.unit)?.curves() ?? [] : [];
        const then = curves.flatMap((x, i) => {
            const was = other.find((y) => y.name === x.name);
            return was ? [{ name: `${x.name}, then`, then: x.name, key: key(i), values: alike(p.motion.t_s, old.motion.t_s, (k) => was.values[k] / size) }] : [];
        });
        const ends = [...series.flatMap((x) => x.values.filter((v) => v !== null)), ...marks.map((x) => x.y)];
        const [low, high] = ends.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
        const pad = 0.08 * (high - low || 1);
        this.course.log = Boolean(one.log);
        this.course.instead(null);
        this.course.show(ms, [...series, ...then], { marks, range: one.log || !ends.length ? undefined : [low - pad, high + pad] });
        legend(this.course, curves.length > 1 ? curves.map((x, i) => [x.name, key(i)]) : []);
    }

    /** Why a probe's curve would say nothing: all of it is rounding, or less than what hinges that flex would change; null where it says something. */
    #unknown(p, one) {
        const same = (x) => x.id === one.of.id && x.scene === p.motion.scene && (x.flow ?? null) === (p.motion.flow ?? null);
        const x = (p.verdict?.probes ?? []).find(same);
        const most = Math.max(0, ...one.of.value.map((v) => Math.abs(v ?? 0)));
        if (x ? !isUnknown(x) : !hasPins(p) || !(most <= (ROUNDING[one.of.unit] ?? 0))) return null;
        const judged = (state.judged() ?? { probes: [] }).probes?.find(same);
        return `${one.of.id} is ${whyUnknown(p)}.${judged && !isUnknown(judged) ? ` In the verdict it has ${withBand(judged.peak, null, judged.unit)} at its peak, as drawn.` : ""} Another model of the hinges, chosen above, shows its course.`;
    }

    /** In place of curves a sentence, in files, too. */
    #instead(one, why) {
        const head = `t_ms,${one.label.replaceAll(",", "")} (${one.unit})`;
        say(this.course.heading.querySelector(".plot-unit"), one.kind ?? "");
        this.course.instead(h("p", { class: "empty course-unknown" }, why), {
            csv: () => `${head}\n# ${why}\n`,
            svg: () => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 760 60" width="760" height="60" font-family="system-ui, sans-serif" font-size="12"><text x="16" y="34">${why.replace(/[&<>]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[c])}</text></svg>\n`,
        });
        this.courseShown = { ...one, unknown: true };
        legend(this.course, []);
    }

    /** What the motion was computed without. */
    #leftOut(p) {
        const left = leftOutOf(p, p.verdict?.accuracy?.wanted ?? Number(state.options.accuracy ?? 1e-3));
        this.course.heading.querySelector(".plot-unit").textContent = "of the peak, at most";
        this.course.instead(leftOutList(left), { csv: () => leftOutCsv(left), svg: () => leftOutSvg(left, `${deviceName()}, ${p.motion.scene}: what was left out`) });
        legend(this.course, []);
    }

    #legend(p, energies) {
        legend(this.angles, p.pins.map((pin, i) => [pin.id, i]), lookAt);
        legend(this.energy, energies.map(([name], i) => [name, i]));
    }

    toggle(play = !this.playing) {
        this.playing = play;
        this.play.replaceChildren(button("x", { icon: play ? "pause" : "play", hidden: true }).firstChild);
        this.play.title = play ? "Pause" : "Play";
        this.play.setAttribute("aria-label", this.play.title);
        if (!play) return;
        if (this.time >= this.#end() * 0.999) this.time = 0;
        let last = performance.now();
        const frame = (now) => {
            if (!this.playing) return;
            this.time += (((now - last) / 1e3) * this.speed * this.#end()) / SECONDS;
            last = now;
            if (this.time > this.#end()) this.time = 0;
            this.paint();
            requestAnimationFrame(frame);
        };
        requestAnimationFrame(frame);
    }

    seek(t, stop = false) {
        if (stop) this.toggle(false);
        this.time = Math.min(Math.max(t, 0), this.#end());
        this.paint();
        if (stop) {
            this.seen = true; // somebody has chosen it
            emit("time", this.time);
        }
    }

    /** The scene as it is seen here, from its begin to its end, in the time that it takes to play. */
    async #film() {
        const [p, time] = [state.picture, this.time];
        this.toggle(false);
        const seconds = SECONDS / this.speed;
        const n = Math.min(Math.round(seconds * FRAMES_A_SECOND), FRAMES_MOST);
        const end = this.#end();
        try {
            return await record(this.mechanism.svg, {
                n, seconds, cancelled: () => state.picture !== p || !this.visible || this.playing,
                show: (i) => {
                    this.time = (end * i) / (n - 1);
                    this.paint();
                },
                caption: (i) => `${deviceName()}, ${p.motion.scene}: ${si((end * i) / (n - 1), "s", 3)}; one second here is ${si(end / seconds, "s", 3)}`,
            });
        } finally {
            this.time = time;
            this.paint();
        }
    }

    /** Everything that goes with time. */
    paint() {
        const p = state.picture;
        if (!p?.motion || !this.t) return;
        const [i, f] = this.#sample(this.time);
        const m = p.motion;
        const a = m.q[i];
        const b = m.q[Math.min(i + 1, m.q.length - 1)];
        this.mechanism.pose(posesOf(p, a.map((x, k) => x + f * (b[k] - x))), { factors: between(p.motion.load_factor, p.loads.length, i, f, 1), tensions: between(p.motion.tension_N, p.motion.tension_N?.length ?? 0, i, f, 0) });
        this.#pinned();
        const now = this.#turned(p);
        this.mechanism.colour(now.shares, state.hinge);
        this.slider.value = Math.round((1000 * this.time) / this.#end());
        const text = si(this.time, "s", 3);
        put(this.slider, { "aria-valuetext": text });
        say(this.clock, `${text} / ${si(this.#end(), "s", 3)}`);
        if (this.plotted?.motion) this.#cursors(this.plotted === p ? now : undefined);
    }

    /** Of an answer at that time: its sample, how far each pin has turned, and what that uses of its limit. */
    #turned(p) {
        const m = p.motion;
        const [i, f] = this.#sample(this.time, m.t_s);
        const next = m.angle_rad[Math.min(i + 1, m.angle_rad.length - 1)];
        const angles = m.angle_rad[i].map((x, k) => x + f * ((next[k] ?? x) - x));
        return { i, angles, shares: new Map(p.pins.map((pin, k) => [pin.id, limitOf(pin) ? Math.abs(angles[k]) / limitOf(pin) : null])) };
    }

    /** Of the plots, and what their headings say at that time. */
    #cursors({ i, angles, shares } = this.#turned(this.plotted)) {
        const p = this.plotted;
        const m = p.motion;
        const k = state.hinge === null ? -1 : p.pins.findIndex((x) => x.id === state.hinge);
        const worst = [...shares].reduce((best, x) => (x[1] !== null && x[1] > (best?.[1] ?? -1) ? x : best), null);
        const ms = this.time * 1e3;
        const share = k >= 0 ? shares.get(p.pins[k].id) : null;
        const asAngle = share === null || this.inDegrees.getAttribute("aria-pressed") === "true"; // what is plotted is told
        this.angles.at(ms, k >= 0 ? `${p.pins[k].id}: ${asAngle ? degrees(angles[k]) : percent(share)}` : worst ? `${worst[0]}: ${percent(worst[1])}` : "");
        const energy = (key) => (m.energy?.[key] ? m.energy[key][i] : 0);
        this.energy.at(ms, si(energy("kinetic_J") + energy("potential_J"), "J"));
        const one = this.courseShown;
        if (one) this.course.at(ms, one.unknown ? "" : one.probe ? si(one.probe.value[i], one.unit) : one.log ? number(m.constraint_norm[i], 2) : "");
    }

    /** The pinned version at the same time of its scene; without a motion at rest. */
    #pinned() {
        const p = state.pinned?.preview ?? null;
        if (!p?.motion || !this.t) return this.mechanism.compareWith(p, p && restOf(p));
        const [i, f] = this.#sample(this.time, p.motion.t_s);
        const [a, b] = [p.motion.q[i], p.motion.q[Math.min(i + 1, p.motion.q.length - 1)]];
        this.mechanism.compareWith(p, posesOf(p, a.map((x, k) => x + f * (b[k] - x))));
    }

    #sample(time, t = this.t) {
        let low = 0;
        let high = t.length - 1;
        while (high - low > 1) {
            const mid = (low + high) >> 1;
            if (t[mid] <= time) low = mid;
            else high = mid;
        }
        return [low, t[high] > t[low] ? Math.min((time - t[low]) / (t[high] - t[low]), 1) : 0];
    }
}

/** When the first of the largest angles is there: what a first look should show. */
function peakTime(p) {
    const peaks = p.motion.peaks.map((x, i) => ({ ...x, share: Math.abs(x.angle_rad) / (limitOf(p.pins[i]) ?? Infinity) }));
    return peaks.reduce((a, b) => (b.share > (a?.share ?? 0) ? b : a), null)?.t_s ?? 0;
}

export function zoomButtons(view) {
    return h("div", { class: "zoom-buttons", role: "group", "aria-label": "Zoom" },
        button("Zoom in", { icon: "plus", hidden: true }, () => view().zoom(1.4)),
        button("Zoom out", { icon: "minus", hidden: true }, () => view().zoom(1 / 1.4)),
        button("Fit", { icon: "fit", hidden: true }, () => view().fit()));
}

function legend(plot, names, onclick) {
    const shown = JSON.stringify([names, onclick ? state.hinge : null, dark()]);
    if (shown === plot.legendShown) return;
    plot.legendShown = shown;
    const items = names.map(([name, i]) => {
        const key = s("svg", { class: "key", viewBox: "0 0 22 6", "aria-hidden": "true" }, s("path", { d: "M0 3h22", stroke: curve(i), "stroke-width": 2, "stroke-dasharray": dash(i).join(" ") || null }));
        return onclick
            ? h("button", { type: "button", class: "legend-item", "aria-pressed": String(state.hinge === name), onclick: () => onclick(name) }, key, name)
            : h("span", { class: "legend-item" }, key, name);
    });
    let box = plot.root.querySelector(".legend");
    if (!box) plot.root.append((box = h("div", { class: "legend" })));
    box.replaceChildren(...items);
}

/** Of n lists of values at the samples each one's value between sample i and the next; without a list `usual`. */
const between = (lists, n, i, f, usual) => Array.from({ length: n }, (_, k) => {
    const list = lists?.[k];
    return list ? list[i] + f * ((list[i + 1] ?? list[i]) - list[i]) : usual;
});

/** value(i) at the samples of one list of times, linear between them, at the times of another; null outside. */
function alike(times, samples, value) {
    let i = 0;
    return times.map((t) => {
        if (t < samples[0] || t > samples.at(-1)) return null;
        while (i < samples.length - 2 && samples[i + 1] < t) i++;
        const [t0, t1] = [samples[i], samples[Math.min(i + 1, samples.length - 1)]];
        const f = t1 > t0 ? (t - t0) / (t1 - t0) : 0;
        return value(i) + f * (value(Math.min(i + 1, samples.length - 1)) - value(i));
    });
}

/** Arrows for the loads of the scene, each as long as it is beside the largest of its kind. */
function loadsOf(p) {
    const list = (p.loads ?? []).map((x, index) => ({ ...x, index }));
    const size = { force: (x) => Math.hypot(...x.force_N), torque: (x) => Math.abs(x.torque_Nm), tendon: (x) => Math.abs(x.pull_N ?? x.draw_m), "comb-drive": (x) => x.voltage_V ** 2 };
    const most = (x) => Math.max(...list.filter((y) => y.kind === x.kind).map(size[x.kind]));
    return list.filter((x) => size[x.kind]?.(x) > 0).map((x) => ({ index: x.index, relative: size[x.kind](x) / most(x), ...arrows[x.kind](p, x) }));
}

/** Names of the scene's loads that no arrow stands for: those of effects without a picture, and kinds that are new to this page. */
const notDrawn = (p) => [...(p.not_drawn ?? []), ...new Set((p.loads ?? []).map((x) => x.kind).filter((kind) => !arrows[kind]))];

const lawOf = (x) => (x.law && x.law !== "step" ? `, ${x.law}` : "");
const bodyOf = (p, i) => p.bodies[i]?.id ?? "ground";
const arrows = {
    force: (p, x) => ({ body: x.body, at: x.at_um, along: () => x.force_N, text: `force ${si(Math.hypot(...x.force_N), "N")} on ${bodyOf(p, x.body)}${lawOf(x)}` }),
    torque: (p, x) => ({ body: x.body, at: [0, 0], torque_Nm: x.torque_Nm, text: `torque ${si(x.torque_Nm, "N m")} on ${bodyOf(p, x.body)}${lawOf(x)}` }),
    tendon: (p, x) => { // behind the last eyelet, the way the cable is drawn
        const [before, last] = x.eyelets.slice(-2);
        const amount = x.pull_N ?? x.draw_m;
        return { body: last.body, at: last.at_um, longest: 14, of: (f) => f * Math.sign(amount),
            along: (at) => [0, 1].map((k) => at(last.body, last.at_um)[k] - at(before.body, before.at_um)[k]),
            text: `cable ${x.id ?? ""}: ${x.pull_N === null ? `${micrometres(amount)} drawn in` : `pulled with ${si(amount, "N")}`}${lawOf(x)}` };
    },
    "comb-drive": (p, x) => ({ body: x.bodies[1], at: x.at_um, of: (f) => f * f, // its force goes with the square of the voltage
        along: (at, q) => [Math.cos, Math.sin].map((g) => g(x.direction_rad + (q[x.bodies[0]]?.[2] ?? 0))),
        text: `drive ${x.id ?? ""}: ${si(x.voltage_V, "V")}${lawOf(x)}` }),
};
