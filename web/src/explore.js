// SPDX-License-Identifier: GPL-3.0-or-later
// Explore: a number of the verdict over the range of any parameter or attribute, or over two of them as a map, asked for
// point by point from the engine of the studies while one looks; every point is what `check` says of that device. What is
// shown belongs to the exact input, as everything does (belong.js).
import { post } from "./api.js";
import { begin, deviceText, FORMER, inputKey, isFormer, mayChange, requestKey, Shown } from "./belong.js";
import { edit, isPresent, lab, taken } from "./design.js";
import { announce, button, h, select, setOptions } from "./dom.js";
import { ALWAYS, bendOf, bent, CELLS, endOf, heightOf, inputsOf, mapRounds, numbersToLookAt, optionsOf, pointOf, POINTS, rounds, stretches, textOf, told, unitSizes } from "./exploring.js";
import { alone, ExplorePlot, legendOf, WORDS } from "./exploreplot.js";
import { number, percent } from "./format.js";
import { csvOf, saveAs, svgOf } from "./plotfile.js";
import { on, state } from "./store.js";
import { Studies } from "./studies.js";
import { nextOf, SHOWN, tell, tellMap } from "./telling.js";

const HOW = [["quick", "at a first look: hinges as pins", "as the live verdict: what a better model of the hinges would change is in the band"],
    ["full", "as drawn, as check does", "the model of the hinges that the accuracy needs; slower"], ["made", "as it will be made", "what each flow may make of it, at the corners of its ranges; slowest"]];
const QUIET_MS = 400; // that nothing changes before it is asked for by itself
const REQUEST_MS = 250; // that a request is to take: progress is seen, and cancelling is quick
const FIRST = 4; // points of the first request
const TOO_LONG = "FW-D286"; // a request was ended: it took longer than the server gives to one
const MOST = 64;
const HALVINGS = 6; // of an interval between two places in which the decision changes
const EDGES = 8;
const FILLED = 100; // devices that are judged before what is left to tell is left to the rounds behind
const KEPT = 12; // exact inputs whose points are remembered

export class Explore {
    constructor(holder) {
        const again = () => this.#asked();
        this.rangesOf = new Map(); // what -> [from, to] as somebody has typed them
        this.points = [];
        this.done = new Map();
        this.told = []; // between those that are done
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
        Object.assign(this, { byItself, stopped: null, tried: key, doing: key, whole: false, spec, asked: 0, inAll: 1, filled: null, checked: 0, missed: 0 });
        this.done = new Map();
        this.told = [];
        this.points = [];
        this.at = null;
        this.errors.replaceChildren();
        this.wrong.take(null);
        const end = begin({ words: "Exploring", cancel: () => this.#stop("cancelled"), row: () => this.cancel });
        this.begun = performance.now();
        this.#say();
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
            this.#tell(spec);
            this.#draw(spec);
            this.#say();
        };
        if (missing.length < texts.length) show(texts.length - missing.length);
        const set = Object.fromEntries(Object.entries(state.set).filter(([path]) => !spec.inputs.some((x) => x.what === path || `device/${x.what}` === path)));
        const { number: n } = spec;
        const values = [...n.value, ...n.low, ...n.high, "governing.utilisation"]; // the last one: that it is judged
        const body = { text: state.text, set, ...lab(), options: this.#options(), inputs: spec.inputs.map((x) => x.what), values };
        for (let i = 0; i < missing.length; ) {
            const some = missing.slice(i, i + (this.chunk ?? FIRST));
            const since = performance.now();
            let answer;
            try {
                answer = await post("/api/explore", { ...body, points: some.map((k) => texts[k]) }, { signal });
            } catch (error) {
                if (signal.aborted || error.body?.error?.code !== TOO_LONG) throw error;
                if (some.length === 1) { // this one alone takes too long: it is named, and the others go on
                    take({ state: "run", late: true, way: null, why: `With ${texts[some[0]].join(", ")} it took longer than ${answerTime(error)}, and was left out.`, used: NaN, value: NaN, low: NaN, high: NaN }, some[0]);
                    show(1);
                    i++;
                    continue;
                }
                this.chunk = Math.max(Math.floor(some.length / 4), 1); // a machine that does other work, too: fewer at once
                continue;
            }
            if (signal.aborted) throw new Error("given up");
            if (answer.status !== "ok") throw new Error(answer.diagnostics?.find((d) => d.severity === "error")?.message ?? "this cannot be computed");
            answer.points.forEach((p, j) => {
                const k = some[j], found = pointOf(p, n);
                kept.set(nameOf(k), found);
                take(found, k);
            });
            i += some.length;
            const each = (performance.now() - since) / some.length;
            this.chunk = Math.min(Math.max(2 * Math.round(REQUEST_MS / each / 2), 1), MOST); // by twos: two of them are judged at a time
            show(some.length);
        }
    }

    /** What is told between the devices that are judged. The places that are to be judged, for that nothing can be told there. */
    #tell(spec) {
        const { number: n, inputs } = spec, share = n.unit === "%", limits = n.limits.map((v) => v * n.factor);
        this.told = [];
        if (this.missed) return []; // what was told turned out to be otherwise: all that is shown is judged
        const { height, top } = heightOf([...this.done.values()], limits, share);
        if (inputs.length === 2) {
            const [w, hh] = inputs.map((v) => (v.to - v.from) / CELLS);
            this.told = tellMap(this.done, CELLS, height, top).map((p) => ({ ...p, x: placeOf(inputs[0], p.i / CELLS), y: placeOf(inputs[1], p.j / CELLS), w, h: hh }));
            return [];
        }
        const found = tell(this.#sorted(), this.places, height, top);
        this.told = found.told;
        return found.open;
    }

    /** A device that is judged where one was told: is it as it was told? */
    #check(told, p) {
        if (!told) return;
        this.checked++;
        if (told.state !== p.state || SHOWN.some((f) => Math.abs(told[f] - p[f]) > told.off[f])) this.missed++;
    }

    async #askLine(spec, key, signal) {
        const [x] = spec.inputs, at = (share) => placeOf(x, share);
        let round = 0;
        const ask = async (list) => {
            await this.#ask(spec, list.map((v) => [textOf(v, x.unit)]), key, signal, (p, i) => {
                this.#check(this.told.find((q) => q.x === list[i]), p);
                this.done.set(list[i], { x: list[i], round, bend: 0, ...p });
            });
            const points = this.#sorted();
            points.forEach((p, k) => p.round === round && (p.bend = bendOf(points, k)));
            round++;
        };
        const others = (list) => list.map((i) => at(i / POINTS)).filter((v) => !this.done.has(v));
        this.places = Array.from({ length: POINTS + 1 }, (_, i) => at(i / POINTS));
        this.inAll = POINTS + 2;
        const all = rounds(), first = all.filter((r) => r.stride > ALWAYS), later = all.filter((r) => r.stride <= ALWAYS);
        const list = first.flatMap((r) => others(r.list));
        await ask(x.now >= x.from && x.now <= x.to ? [x.now, ...list.filter((v) => v !== x.now)] : list);
        for (let open = this.#tell(spec); open.length && this.done.size < FILLED; open = this.#tell(spec)) await ask(nextOf(open));
        this.filled = { judged: this.done.size, seconds: (performance.now() - this.begun) / 1e3 };
        await this.#halve(ask, x);
        for (const { list, stride } of later) {
            const left = others(list), some = bent(left, this.#sorted(), stride);
            this.inAll -= left.length - some.length;
            if (some.length) await ask(some);
        }
        await this.#halve(ask, x);
    }

    /** Where the decision changes it is found closer. */
    async #halve(ask, x) {
        const least = ((x.to - x.from) / POINTS / 2 ** HALVINGS) * 1.01;
        for (let k = 0; k < HALVINGS; k++) {
            const points = this.#sorted();
            const between = points.slice(1).map((p, i) => [points[i], p]).filter(([a, b]) => a.state !== b.state && b.x - a.x > least && !a.late && !b.late).slice(0, EDGES);
            const list = between.map(([a, b]) => Number(textOf((a.x + b.x) / 2, "").trim())).filter((v) => !this.done.has(v));
            if (!list.length) return;
            this.inAll = Math.max(this.inAll, this.asked + list.length * (HALVINGS - k));
            await ask(list);
        }
    }

    async #askMap(spec, key, signal) {
        const [x, y] = spec.inputs;
        this.inAll = (CELLS + 1) ** 2;
        for (const { stride, list } of mapRounds()) {
            const [w, hh] = [x, y].map((v) => (stride * (v.to - v.from)) / CELLS);
            await this.#ask(spec, list.map(([i, j]) => [textOf(placeOf(x, i / CELLS), x.unit), textOf(placeOf(y, j / CELLS), y.unit)]), key, signal, (p, k) => {
                const [i, j] = list[k];
                this.#check(this.told.find((q) => q.i === i && q.j === j), p);
                this.done.set(list[k].join(" "), { x: placeOf(x, i / CELLS), y: placeOf(y, j / CELLS), w, h: hh, ...p });
            });
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

    /** Judged and told. */
    #all() {
        return [...this.done.values(), ...this.told];
    }

    #draw(spec = this.spec) {
        if (!spec || !this.done.size) return;
        const { number: n, inputs } = spec;
        const map = inputs.length === 2;
        const limits = n.limits.map((v) => v * n.factor);
        if (this.legendOf !== map) this.legend.replaceChildren(...legendOf(map ? "map" : "line"));
        this.legendOf = map;
        if (map) this.plot.show({ kind: "map", x: inputs[0], y: inputs[1], cells: this.#all().sort((a, b) => b.w - a.w), limit: limits[0] ?? null, unit: n.unit, at: this.at });
        else this.plot.show({ kind: "line", x: inputs[0], points: this.#sorted(), told: this.told, whole: this.whole, limits, unit: n.unit, ylabel: `${n.label} (${n.unit})`, at: this.at });
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
        return `${said}.${why ? ` ${why}` : ""}${this.#toldWords()}`;
    }

    #mapWords() {
        const all = [...this.done.values()];
        const count = (s) => all.filter((p) => p.state === s).length;
        return `${this.judged}: ${["accept", "inconclusive", "reject", "run", "failed"].filter(count).map((s) => `${count(s)} of ${all.length} ${WORDS[s]}`).join(", ")}. The pointer on a place tells its value.${this.#toldWords()}`;
    }

    /** What is told and not judged, and how sure that is. */
    #toldWords() {
        const n = this.told.length;
        if (!n) return this.missed ? " Nothing is told between these devices: one that was told and then judged came otherwise." : "";
        const off = Math.max(...this.told.map(offOf));
        return ` Values at ${n} places between them are told, by at most ${number(off, 2)} ${this.spec.number.unit} off${this.checked ? `; ${this.checked} that were told and then judged came as told` : ""}.`;
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
        this.message.textContent = busy && this.asked === 0 ? "" : busy ? `${this.asked} of ${devices(this.inAll)} · ${((performance.now() - this.begun) / 1e3).toFixed(1)} s`
            : why !== undefined ? `${why}${nothing ? "" : " What stands below is of the former input."}` : nothing ? "" : this.showing.former ? "of the former input: something has changed since"
                : `${devices(this.done.size)} in ${number(this.seconds, 3)} s${!this.whole ? "; not all of it: stopped" : this.spec.inputs.length === 1 ? ", closer where the line bends" : ""}`;
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
        return this.#all().reduce((a, b) => (far(b) < far(a) ? b : a));
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
        const other = p.state !== "accept" && p.used > 1 && n.unit === "%" && (p.high ?? p.value) <= 100 && !p.why ? `; what decides is another limit, used to ${percent(p.used)}` : "";
        return `${where}: ${WORDS[p.state]}${Number.isFinite(p.value) ? `, ${number(p.value, 4)} ${n.unit}${band}` : ""}${other}${p.told ? `; told between judged devices, by at most ${number(offOf(p), 2)} ${n.unit} off` : ""}${p.why ? `. ${p.why}` : ""}`;
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
        const points = inputs.length === 2 ? this.#all() : this.#all().sort((a, b) => a.x - b.x);
        const column = (key) => points.map((p) => p[key]);
        const head = (x) => `${x.what}${x.unit ? ` (${x.unit})` : ""}`;
        const t = column("x");
        const series = [...(inputs.length === 2 ? [{ name: head(inputs[1]), values: column("y") }] : []), { name: "judged or told", values: points.map((p) => (p.told ? "told" : "judged")) }, { name: `off by at most (${n.unit})`, values: points.map((p) => (p.told ? offOf(p) : "")) }, { name: `${n.label} (${n.unit})`, values: column("value") }, { name: "low", values: column("low") }, { name: "high", values: column("high") },
            { name: "decision", values: column("state") }];
        saveAs(`${this.#name()}.csv`, csvOf({ t, series: series.map((x) => ({ ...x, values: x.values.map((v) => (typeof v === "number" && !Number.isFinite(v) ? "" : v)) })) }, "", head(inputs[0])), "text/csv", this.body);
    }

    #svg() {
        if (!this.done.size) return;
        const { inputs: [x, y], number: n } = this.spec;
        if (y) return saveAs(`${this.#name()}.svg`, alone(this.plot.svg), "image/svg+xml", this.body);
        const points = this.#all().sort((a, b) => a.x - b.x);
        const judged = this.told.length ? [{ name: "judged", values: points.map((p) => (p.told ? NaN : p.value)), key: 0, dots: true }] : [];
        const series = [{ name: judged.length ? "told" : "value", values: points.map((p) => p.value), key: 0, solid: true }, ...judged, { name: "least", values: points.map((p) => p.low), key: 0, then: true }, { name: "most", values: points.map((p) => p.high), key: 0, then: true }];
        const all = series.flatMap((v) => v.values).filter(Number.isFinite);
        const limits = n.limits.map((v) => v * n.factor);
        const [low, high] = [Math.min(...all, ...limits), Math.max(...all, ...limits)];
        saveAs(`${this.#name()}.svg`, svgOf({ t: points.map((p) => p.x), series, marks: limits.map((v) => ({ y: v, text: "limit" })) },
            { title: `${state.preview?.name ?? ""}: ${n.label}${isFormer(this.body) ? FORMER : ""}`, unit: `${n.unit} over ${x.label}${x.unit ? ` (${x.unit})` : ""}`, x: [x.from, x.to], y: [low - 0.05 * (high - low), high + 0.05 * (high - low)], log: false }), "image/svg+xml", this.body);
    }
}

/** A place of a range, as it is written. */
const placeOf = (input, share) => Number(textOf(input.from + share * (input.to - input.from), "").trim());

/** The most that a told value or an end of its band is off by. */
const offOf = (p) => Math.max(...SHOWN.map((f) => p.off[f] ?? 0));

/** The time that the server gives to one request, in its words. */
const answerTime = (error) => /\d+ s\b/.exec(error.message)?.[0] ?? "the server gives to one request";

/** "1 device", "3 devices" */
const devices = (n) => `${n} ${n === 1 ? "device" : "devices"}`;

function group(list) {
    const out = new Map();
    for (const x of list) out.set(x.group, [...(out.get(x.group) ?? []), x]);
    return out;
}
