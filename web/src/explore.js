// SPDX-License-Identifier: GPL-3.0-or-later
// Explore: a number of the verdict over the range of any parameter or attribute, or over two of them as a map, asked for
// point by point from the engine of the studies while one looks; every point is what `check` says of that device. What is
// shown belongs to the exact input, as everything does (belong.js).
import { post } from "./api.js";
import { begin, deviceText, FORMER, inputKey, isFormer, mayChange, requestKey, Shown } from "./belong.js";
import { edit, isPresent, lab, taken } from "./design.js";
import { announce, button, h, select, setOptions } from "./dom.js";
import { bendOf, bent, CELLS, endOf, inputsOf, mapRounds, numbersToLookAt, optionsOf, POINTS, rounds, stretches, textOf, told, unitSizes } from "./exploring.js";
import { ExplorePlot, legendOf, WORDS } from "./exploreplot.js";
import { number, percent } from "./format.js";
import { csvOf, saveAs, svgOf } from "./plotfile.js";
import { on, state } from "./store.js";
import { Studies } from "./studies.js";

const HOW = [["quick", "at a first look: hinges as pins", "as the live verdict: what a better model of the hinges would change is in the band"],
    ["full", "as drawn, as check does", "the model of the hinges that the accuracy needs; slower"], ["made", "as it will be made", "what each flow may make of it, at the corners of its ranges; slowest"]];
const QUIET_MS = 400; // that nothing changes before it is asked for by itself
const REQUEST_MS = 250; // that a request is to take: progress is seen, and cancelling is quick
const FIRST = 3; // points of the first request
const TOO_LONG = "FW-D286"; // a request was ended: it took longer than the server gives to one
const LANES = navigator.hardwareConcurrency > 1 ? 2 : 1; // requests at a time: the server has two processes that compute
const MOST = 64;
const HALVINGS = 6; // of an interval in which the decision changes
const EDGES = 8;
const KEPT = 12; // exact inputs whose points are remembered

export class Explore {
    constructor(holder) {
        const again = () => this.#asked();
        this.rangesOf = new Map(); // what -> [from, to] as somebody has typed them
        this.points = [];
        this.done = new Map();
        this.kept = new Map(); // exact input -> values of the inputs -> point
        this.at = null;
        this.asked = 0;
        this.inAll = 1;
        this.axes = ["x", "y"].map((name, i) => this.#axis(name, i));
        this.which = select("Number", [], "", () => {
            this.id = this.which.value;
            again();
        });
        this.how = select("Judged", HOW, "quick", again);
        this.button = button("Compute", { icon: "target", class: "primary", id: "explore-start" }, () => this.run());
        this.cancel = button("Cancel", { icon: "close", class: "cancel" }, () => this.#stop("cancelled"));
        this.cancel.hidden = true;
        this.progress = h("progress", { "aria-label": "Explore: progress", hidden: true, max: 1 });
        this.message = h("span", { class: "job-message", role: "status" });
        this.errors = h("div", { class: "job-errors", role: "status" });
        this.figure = h("figure", { class: "explore-figure" });
        this.legend = h("figcaption", { class: "explore-legend" });
        this.summary = h("p", { class: "explore-summary" });
        this.slider = h("input", { type: "range", min: 0, max: 1000, value: 500, "aria-label": "Look at", oninput: () => this.#slid() });
        this.readout = h("p", { class: "explore-readout", role: "status" });
        this.use = button("Use", { icon: "check", id: "explore-use", disabled: true }, () => this.#use());
        const menu = h("div", { class: "row" }, button("Save as CSV", { class: "small" }, () => this.#csv()), button("Save as SVG", { class: "small", id: "explore-svg" }, () => this.#svg()));
        this.plot = new ExplorePlot(this.figure, (at) => this.#look(at), (at) => this.#under(at));
        this.figure.append(this.legend);
        this.body = h("div", { class: "explore-body" }, this.figure, this.summary, h("div", { class: "explore-look" }, this.slider, this.readout, this.use), menu);
        const box = h("div", { class: "explore-scroll" },
            h("div", { class: "explore-head" }, h("label", { class: "option" }, h("span", {}, "number"), this.which), ...this.axes.map((a) => a.box),
                h("label", { class: "option" }, h("span", {}, "judged"), this.how)),
            h("div", { class: "job-bar" }, this.button, this.progress, this.message, this.cancel), this.errors, this.body);
        this.studies = new Studies(box, () => {
            const { inputs = [] } = this.#spec();
            return inputs.map((x) => ({ what: x.what, from: textOf(x.from, x.unit), to: textOf(x.to, x.unit) }));
        });
        holder.append(box);
        this.showing = new Shown(this.body, () => this.key);
        this.wrong = new Shown(this.errors, () => this.key);
        for (const event of ["preview", "text", "change", "options", "entered"]) on(event, () => this.#moved(event));
        mayChange(() => this.control !== undefined && this.control !== null || this.timer !== 0, { job: true });
        this.timer = 0;
    }

    /** form: whose tree of the text is looked at */
    start(table, form) {
        this.table = table;
        this.form = this.studies.form = form;
        this.units = unitSizes(table);
    }

    shown(yes) {
        this.visible = yes;
        this.studies.shown(yes);
        if (yes) {
            this.#offer();
            this.plot.what && this.plot.draw();
            this.#moved("shown");
        } else if (this.byItself) this.#stop("hidden");
    }

    // ---- what is asked for ----

    #axis(name, i) {
        const end = (word) => h("input", { autocomplete: "off", spellcheck: false, class: "explore-end", "aria-label": `${name === "x" ? "First" : "Second"} input, ${word}`, onchange: () => {
            const input = this.inputs?.[i];
            if (input) this.rangesOf.set(input.what, [axis.from.value, axis.to.value]);
            this.#asked();
        } });
        const axis = { from: end("from"), to: end("to") };
        axis.pick = h("select", { "aria-label": i === 0 ? "Vary" : "and vary" });
        axis.pick.addEventListener("change", () => {
            axis.chosen = axis.pick.value;
            this.#ranges();
            this.#asked();
        });
        axis.ends = h("span", { class: "explore-ends" }, axis.from, h("span", {}, "to"), axis.to);
        axis.box = h("div", { class: "explore-axis" }, h("label", { class: "option" }, h("span", {}, i === 0 ? "over" : "and"), axis.pick), axis.ends);
        return axis;
    }

    /** Fills the lists from the present text and answer; keeps what was chosen while it is there. */
    #offer() {
        const { form } = this;
        if (!this.table || !form.root) return;
        this.all = inputsOf(form.root, (n, p) => form.row(n, p), this.table, state.preview?.parameters ?? []);
        this.axes.forEach((axis, i) => {
            const groups = Map.groupBy ? Map.groupBy(this.all, (x) => x.group) : group(this.all);
            const key = JSON.stringify(this.all.map((x) => x.what));
            if (axis.pick.dataset.key !== key) {
                axis.pick.dataset.key = key;
                axis.pick.replaceChildren(...(i === 1 ? [h("option", { value: "" }, "nothing else")] : []),
                    ...[...groups].map(([name, list]) => h("optgroup", { label: name }, list.map((x) => h("option", { value: x.what }, x.label)))));
            }
            const wanted = axis.chosen ?? (i === 0 ? this.all[0]?.what : "");
            axis.pick.value = this.all.some((x) => x.what === wanted) ? wanted : i === 1 ? "" : this.all[0]?.what ?? "";
        });
        this.#ranges();
        const list = numbersToLookAt(state.preview?.verdict, this.how.value === "made");
        setOptions(this.which, list.map((x) => [x.id, x.label]), this.id ?? "governing");
        this.number = list.find((x) => x.id === this.which.value) ?? list[0];
    }

    #ranges() {
        this.inputs = this.axes.map((axis) => this.all?.find((x) => x.what === axis.pick.value) ?? null);
        this.axes.forEach((axis, i) => {
            const input = this.inputs[i];
            axis.ends.hidden = !input;
            if (!input || document.activeElement === axis.from || document.activeElement === axis.to) return;
            const typed = this.rangesOf.get(input.what);
            axis.from.value = typed?.[0] ?? textOf(input.from, input.unit);
            axis.to.value = typed?.[1] ?? textOf(input.to, input.unit);
        });
    }

    /** {inputs: [{..., from, to}], number, made} or what is wrong, in words. */
    #spec() {
        if (!this.table || !this.number) return { why: "" };
        const inputs = this.inputs.map((input, i) => input && { ...input, from: endOf(this.axes[i].from.value, input.unit, this.units), to: endOf(this.axes[i].to.value, input.unit, this.units) }).filter(Boolean);
        if (!inputs.length) return { why: "This description has no number to vary." };
        for (const x of inputs) if (!(Number.isFinite(x.from) && Number.isFinite(x.to) && x.from < x.to)) return { why: `The range of ${x.label} needs two numbers in ${x.unit || "its unit"}, the smaller one first.` };
        if (inputs.length === 2 && inputs[0].what === inputs[1].what) return { why: "A map needs two different inputs." };
        return { inputs, number: this.number };
    }

    #options() {
        return optionsOf(this.how.value);
    }

    get key() {
        return this.#keyOf(inputKey);
    }

    #keyOf(make) {
        const spec = this.table ? this.#spec() : { why: "" };
        return make({ ...this.#options(), explore: spec.why === undefined ? [spec.inputs.map((x) => [x.what, x.from, x.to]), spec.number.id] : spec.why }, deviceText);
    }

    #asked() {
        this.#offer();
        this.#moved("asked");
    }

    /** Something may be another: what runs is given up, and asked for anew when nothing has changed for a while. */
    #moved(event) {
        if (!this.visible) return;
        if (event === "preview" || event === "text") this.#offer();
        this.showing.take(this.showing.of); // looks again
        const key = this.key;
        if (this.control && key !== this.doing) this.#stop("newer");
        clearTimeout(this.timer);
        this.timer = 0;
        this.#say();
        if (key === this.doing || key === this.showing.of && this.whole || key === this.tried || !isPresent()) return;
        const { why } = this.#spec();
        if (why !== undefined) return;
        this.timer = setTimeout(() => {
            this.timer = 0;
            this.run(true);
        }, event === "asked" || event === "shown" ? 0 : QUIET_MS); // nothing changes where somebody comes to look
    }

    // ---- asking ----

    #stop(why) {
        if (!this.control) return;
        this.stopped = why;
        this.control.abort();
    }

    async #taken() {
        try {
            await taken();
            return true;
        } catch (error) {
            this.#failed([`Not begun: ${error.message}`], this.key);
            return false;
        }
    }

    async run(byItself = false) {
        this.control?.abort();
        if (!byItself && !(await this.#taken())) return;
        const spec = this.#spec();
        if (spec.why !== undefined) return this.#say();
        const control = (this.control = new AbortController());
        const key = this.#keyOf(requestKey);
        this.judged = { quick: "As drawn, at a first look", full: "As drawn", made: "As it will be made" }[this.how.value];
        Object.assign(this, { byItself, stopped: null, tried: key, doing: key, whole: false, spec, asked: 0, inAll: 1 });
        this.done = new Map();
        this.points = [];
        this.at = null;
        this.errors.replaceChildren();
        this.wrong.take(null);
        const end = begin({ words: "Exploring", cancel: () => this.#stop("cancelled") });
        this.begun = performance.now();
        this.lanes = undefined;
        try {
            if (spec.inputs.length === 2) await this.#askMap(spec, key, control.signal);
            else await this.#askLine(spec, key, control.signal);
            this.whole = control === this.control;
            if (this.whole) {
                this.#draw(); // "so far" no more
                announce(this.summary.textContent);
            }
        } catch (error) {
            if (control === this.control && !control.signal.aborted && !error.lost) this.#failed([error.message], key);
            else if (control === this.control && this.stopped !== "cancelled") this.tried = null;
        } finally {
            end();
            if (control === this.control) {
                this.control = null;
                this.doing = null;
                this.seconds = (performance.now() - this.begun) / 1e3;
                this.#say();
                this.#moved("end");
            }
        }
    }

    /** Points that were computed for the same text, held values, options, inputs and number, whatever their range was. */
    #keptOf(spec) {
        const key = requestKey({ ...this.#options(), explore: [spec.inputs.map((x) => x.what), spec.number.id] }, deviceText);
        const points = this.kept.get(key) ?? new Map();
        this.kept.delete(key);
        this.kept.set(key, points); // the last one that was used stands last
        if (this.kept.size > KEPT) this.kept.delete(this.kept.keys().next().value);
        return points;
    }

    /** Points of texts: those that are kept, the others in requests of about REQUEST_MS; take(point, index) for each. */
    async #ask(spec, texts, key, signal, take) {
        const kept = this.#keptOf(spec), nameOf = (k) => texts[k].join("\n"), missing = [];
        for (let k = 0; k < texts.length; k++) {
            if (kept.has(nameOf(k))) take(kept.get(nameOf(k)), k);
            else missing.push(k);
        }
        const show = (n) => {
            this.asked += n;
            this.showing.take(key);
            this.#draw(spec);
            this.#say();
        };
        if (missing.length < texts.length) show(texts.length - missing.length);
        const set = Object.fromEntries(Object.entries(state.set).filter(([path]) => !spec.inputs.some((x) => x.what === path || `device/${x.what}` === path)));
        const { number: n } = spec;
        const values = [...n.value, ...n.low, ...n.high, "governing.utilisation"]; // the last one: that it is judged
        const body = { text: state.text, set, ...lab(), options: this.#options(), inputs: spec.inputs.map((x) => x.what), values };
        for (let i = 0; i < missing.length; ) {
            const lanes = this.lanes ?? LANES;
            const some = missing.slice(i, i + lanes * (this.chunk ?? FIRST));
            const parts = Array.from({ length: Math.min(lanes, some.length) }, (_, lane) => some.filter((_, j) => j % lanes === lane));
            const since = performance.now();
            let answers;
            try {
                answers = await Promise.all(parts.map((part) => post("/api/explore", { ...body, points: part.map((k) => texts[k]) }, { signal })));
            } catch (error) {
                if (signal.aborted || error.body?.error?.code !== TOO_LONG || some.length === 1) throw error;
                this.chunk = Math.max(Math.floor((this.chunk ?? FIRST) / 4), 1); // a machine that does other work, too: fewer at once
                if (parts[0].length === 1) this.lanes = 1;
                continue;
            }
            if (signal.aborted) throw new Error("given up");
            answers.forEach((answer, lane) => {
                if (answer.status !== "ok") throw new Error(answer.diagnostics?.find((d) => d.severity === "error")?.message ?? "this cannot be computed");
                answer.points.forEach((p, j) => {
                    const k = parts[lane][j], found = point(p, n);
                    kept.set(nameOf(k), found);
                    take(found, k);
                });
            });
            i += some.length;
            const each = (performance.now() - since) / parts[0].length;
            this.chunk = Math.min(Math.max(Math.round(REQUEST_MS / each), 1), MOST);
            show(some.length);
        }
    }

    async #askLine(spec, key, signal) {
        const [x] = spec.inputs;
        const at = (share) => Number(textOf(x.from + share * (x.to - x.from), "").trim());
        let round = 0;
        const ask = async (list) => {
            await this.#ask(spec, list.map((v) => [textOf(v, x.unit)]), key, signal, (p, i) => this.done.set(list[i], { x: list[i], round, bend: 0, ...p }));
            const points = this.#sorted();
            points.forEach((p, k) => p.round === round && (p.bend = bendOf(points, k)));
            round++;
        };
        this.inAll = POINTS + 2;
        if (x.now >= x.from && x.now <= x.to) await ask([x.now]);
        for (const { list, stride } of rounds()) {
            const some = bent(list.map((i) => at(i / POINTS)).filter((v) => !this.done.has(v)), this.#sorted(), stride);
            this.inAll -= list.length - some.length;
            if (some.length) await ask(some);
        }
        for (let k = 0; k < HALVINGS; k++) { // where the decision changes
            const points = this.#sorted();
            const between = points.slice(1).map((p, i) => [points[i], p]).filter(([a, b]) => a.state !== b.state).slice(0, EDGES);
            const list = between.map(([a, b]) => Number(textOf((a.x + b.x) / 2, "").trim())).filter((v) => !this.done.has(v));
            if (!list.length) return;
            this.inAll = Math.max(this.inAll, this.asked + list.length * (HALVINGS - k));
            await ask(list);
        }
    }

    async #askMap(spec, key, signal) {
        const at = (input, i) => Number(textOf(input.from + (i / CELLS) * (input.to - input.from), "").trim());
        const [x, y] = spec.inputs;
        this.inAll = (CELLS + 1) ** 2;
        for (const { stride, list } of mapRounds()) {
            const [w, hh] = [x, y].map((v) => (stride * (v.to - v.from)) / CELLS);
            await this.#ask(spec, list.map(([i, j]) => [textOf(at(x, i), x.unit), textOf(at(y, j), y.unit)]), key, signal,
                (p, k) => this.done.set(list[k].join(" "), { x: at(x, list[k][0]), y: at(y, list[k][1]), w, h: hh, ...p }));
            // what was coarse is as fine as all others now
            for (const cell of this.done.values()) Object.assign(cell, { w, h: hh });
        }
    }

    #failed(messages, of) {
        this.errors.replaceChildren(h("ul", { class: "messages" }, messages.map((m) => h("li", {}, m))));
        this.wrong.take(of);
    }

    // ---- what is shown ----

    #sorted() {
        return [...this.done.values()].sort((a, b) => a.x - b.x);
    }

    #draw(spec = this.spec) {
        if (!spec || !this.done.size) return;
        const { number: n, inputs } = spec;
        const map = inputs.length === 2;
        const limits = n.limits.map((v) => v * n.factor);
        if (this.legendOf !== map) this.legend.replaceChildren(...legendOf(map ? "map" : "line"));
        this.legendOf = map;
        if (map) this.plot.show({ kind: "map", x: inputs[0], y: inputs[1], cells: [...this.done.values()].sort((a, b) => b.w - a.w), limit: limits[0] ?? null, unit: n.unit, at: this.at });
        else this.plot.show({ kind: "line", x: inputs[0], points: this.#sorted(), whole: this.whole, limits, unit: n.unit, ylabel: `${n.label} (${n.unit})`, at: this.at });
        this.summary.textContent = map ? this.#mapWords() : this.#lineWords(inputs[0]);
        this.plot.svg.setAttribute("aria-label", `${n.label} over ${inputs.map((x) => x.label).join(" and ")}. ${this.summary.textContent}`);
        this.slider.hidden = map;
        this.#read();
    }

    #lineWords(x) {
        const points = this.#sorted();
        const list = told(stretches(points, this.whole), points).map((r) => `${WORDS[r.state]} ${r.from === r.to ? `at ${r.from}` : `from ${r.from} to ${r.to}`}${x.unit ? ` ${x.unit}` : ""}`);
        const words = list.length > 6 ? [...list.slice(0, 6), `and ${list.length - 6} more stretches`] : list;
        const text = words.join("; ");
        const why = [...this.done.values()].find((p) => p.why)?.why;
        const said = this.whole ? `${this.judged}: ${text}` : `${this.judged}, so far, by ${this.done.size} ${this.done.size === 1 ? "device" : "devices"}: ${text}`;
        return `${said}.${why ? ` ${why}` : ""}`;
    }

    #mapWords() {
        const all = [...this.done.values()];
        const count = (s) => all.filter((p) => p.state === s).length;
        return `${this.judged}: ${["accept", "inconclusive", "reject", "run", "failed"].filter(count).map((s) => `${count(s)} of ${all.length} ${WORDS[s]}`).join(", ")}. The pointer on a place tells its value.`;
    }

    #say() {
        const busy = Boolean(this.control);
        this.button.hidden = busy;
        this.cancel.hidden = this.progress.hidden = !busy;
        const { why } = this.table ? this.#spec() : { why: "" };
        this.button.disabled = why !== undefined;
        this.progress.value = Math.min(this.asked / this.inAll, 1);
        const nothing = this.showing.of === null || this.showing.another;
        this.button.classList.toggle("primary", nothing || this.showing.former);
        this.message.textContent = busy ? `${this.asked} of ${this.inAll} devices · ${((performance.now() - this.begun) / 1e3).toFixed(1)} s`
            : why !== undefined ? `${why}${nothing ? "" : " What stands below is of the former input."}` : nothing ? "" : this.showing.former ? "of the former input: something has changed since"
                : `${this.done.size} devices in ${number(this.seconds, 3)} s${!this.whole ? "; not all of it: stopped" : this.spec.inputs.length === 1 ? ", closer where the line bends" : ""}`;
    }

    #look(at) {
        this.at = at;
        const [x] = this.spec.inputs;
        if (!Array.isArray(at)) this.slider.value = Math.round((1000 * (at - x.from)) / (x.to - x.from));
        this.#draw();
        clearTimeout(this.looking);
        this.closer?.abort();
        if (!Array.isArray(at)) this.looking = setTimeout(() => this.#lookCloser(x, at), QUIET_MS);
    }

    /** Where somebody keeps looking a device is computed, if there is none within a 400th of the range. */
    async #lookCloser(x, at) {
        const spec = this.spec, key = this.key, v = Number(textOf(at, "").trim());
        const near = () => [...this.done.values()].some((p) => Math.abs(p.x - v) <= (x.to - x.from) / 400);
        if (this.control || !this.whole || key !== this.showing.of || v < x.from || v > x.to || near()) return;
        const control = (this.closer = new AbortController());
        try {
            await this.#ask(spec, [[textOf(v, x.unit)]], key, control.signal, (p) => spec === this.spec && this.done.set(v, { x: v, round: 0, bend: 0, ...p }));
        } catch (error) {
            if (!control.signal.aborted && !error.lost) this.#failed([error.message], key);
        }
    }

    #slid() {
        if (!this.spec || this.spec.inputs.length === 2) return;
        const [x] = this.spec.inputs;
        this.#look(x.from + (Number(this.slider.value) / 1000) * (x.to - x.from));
    }

    /** The point nearest to what is looked at. */
    get nearest() {
        return this.#nearestTo(this.at);
    }

    #nearestTo(at) {
        if (at === null || !this.done.size) return null;
        const [x, y] = this.spec.inputs;
        const far = (p) => (Array.isArray(at) ? ((p.x - at[0]) / (x.to - x.from)) ** 2 + ((p.y - at[1]) / (y.to - y.from)) ** 2 : Math.abs(p.x - at));
        return [...this.done.values()].reduce((a, b) => (far(b) < far(a) ? b : a));
    }

    /** The device under the pointer, and its words: {x, y, value, words}; null: there is none. */
    #under(at) {
        const p = this.#nearestTo(at);
        return p && { ...p, words: this.#words(p) };
    }

    #read() {
        const p = this.nearest;
        this.use.disabled = p === null;
        if (!p) {
            this.readout.textContent = "A click on the picture, a drag over it, or the slider keeps what is told of a place here.";
            return;
        }
        this.readout.textContent = this.#words(p);
        this.slider.setAttribute("aria-valuetext", this.readout.textContent);
    }

    #words(p) {
        const { inputs, number: n } = this.spec;
        const where = inputs.map((x, i) => `${x.label} ${textOf(i ? p.y : p.x, x.unit)}`).join(", ");
        const band = Number.isFinite(p.low) && Number.isFinite(p.high) ? ` (${number(p.low)} to ${number(p.high)})` : "";
        const other = p.state !== "accept" && p.used > 1 && n.unit === "%" && (p.high ?? p.value) <= 100 ? `; what decides is another limit, used to ${percent(p.used)}` : "";
        return `${where}: ${WORDS[p.state]}${Number.isFinite(p.value) ? `, ${number(p.value, 4)} ${n.unit}${band}` : ""}${other}${p.why ? `. ${p.why}` : ""}`;
    }

    /** The values that are looked at become text, as one step of the history. */
    #use() {
        const p = this.nearest;
        if (!p) return;
        const changes = this.spec.inputs.map((x, i) => ({ path: x.group === "Parameters" ? x.what : `device/${x.what}`, value: textOf(i ? p.y : p.x, x.unit) }));
        edit(changes, changes.map((c) => `${c.path} is ${c.value}`).join(", "));
    }

    // ---- files ----

    #name() {
        return `${state.preview?.name ?? "device"}-${this.spec.number.id}-over-${this.spec.inputs.map((x) => x.what).join("-")}`.replace(/[^A-Za-z0-9]+/g, "-");
    }

    #csv() {
        if (!this.done.size) return;
        const { inputs, number: n } = this.spec;
        const points = inputs.length === 2 ? [...this.done.values()] : this.#sorted();
        const column = (key) => points.map((p) => p[key]);
        const head = (x) => `${x.what}${x.unit ? ` (${x.unit})` : ""}`;
        const t = column("x");
        const series = [...(inputs.length === 2 ? [{ name: head(inputs[1]), values: column("y") }] : []), { name: `${n.label} (${n.unit})`, values: column("value") }, { name: "low", values: column("low") }, { name: "high", values: column("high") },
            { name: "decision", values: column("state") }];
        saveAs(`${this.#name()}.csv`, csvOf({ t, series: series.map((x) => ({ ...x, values: x.values.map((v) => (typeof v === "number" && !Number.isFinite(v) ? "" : v)) })) }, "", head(inputs[0])), "text/csv", this.body);
    }

    #svg() {
        if (!this.done.size) return;
        const { inputs: [x, y], number: n } = this.spec;
        if (y) return saveAs(`${this.#name()}.svg`, alone(this.plot.svg), "image/svg+xml", this.body);
        const points = this.#sorted();
        const series = [{ name: n.label, values: points.map((p) => p.value), key: 0, solid: true }, { name: "least", values: points.map((p) => p.low), key: 0, then: true }, { name: "most", values: points.map((p) => p.high), key: 0, then: true }];
        const all = series.flatMap((v) => v.values).filter(Number.isFinite);
        const limits = n.limits.map((v) => v * n.factor);
        const [low, high] = [Math.min(...all, ...limits), Math.max(...all, ...limits)];
        saveAs(`${this.#name()}.svg`, svgOf({ t: points.map((p) => p.x), series, marks: limits.map((v) => ({ y: v, text: "limit" })) },
            { title: `${state.preview?.name ?? ""}: ${n.label}${isFormer(this.body) ? FORMER : ""}`, unit: `${n.unit} over ${x.label}${x.unit ? ` (${x.unit})` : ""}`, x: [x.from, x.to], y: [low - 0.05 * (high - low), high + 0.05 * (high - low)], log: false }), "image/svg+xml", this.body);
    }
}

/** A point of an answer in the unit of the number. */
function point(p, n) {
    const v = p.values.map((x) => (x === null ? NaN : x * n.factor));
    const first = (list) => list.find(Number.isFinite) ?? NaN;
    const [a, b] = [n.value.length, n.value.length + n.low.length];
    return { state: p.state, why: p.why, used: p.limit_used, value: n.least ? Math.min(...v.slice(0, a)) : first(v.slice(0, a)), low: first(v.slice(a, b)), high: first(v.slice(b, b + n.high.length)) };
}

function group(list) {
    const out = new Map();
    for (const x of list) out.set(x.group, [...(out.get(x.group) ?? []), x]);
    return out;
}

const DRAWN = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "opacity", "font-size"];

/** A picture of the page as a file that looks the same without its sheets. */
function alone(svg) {
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
