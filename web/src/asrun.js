// SPDX-License-Identifier: GPL-3.0-or-later
// What was done, beside what was planned: the as-run log of a flow, which is a file beside the description and grows by the
// command `flexwright log` alone. Steps are entered here; what was measured and set is asked for as the plan has it; the
// log's page has the control charts, and the numbers of the process can be fitted to its coupons.
import { get } from "./api.js";
import { begin, inputKey, mayChange, requestKey, Shown } from "./belong.js";
import { isPresent } from "./design.js";
import { announce, button, h, icon, select, setOptions } from "./dom.js";
import { changed } from "./file.js";
import { duration, number } from "./format.js";
import { fileOf, forget, hasFile, run } from "./jobs.js";
import { on, state } from "./store.js";

const QUIET_MS = 500;
const SHORT_S = 60; // a step that takes less begins and ends in one minute
const NAME = /^[A-Za-z0-9_][A-Za-z0-9_-]{0,59}$/;
const OTHER_PLAN = /\[FW-D281\]/;
const said = (job) => (job.messages ?? []).filter((m) => !/^\s*\d*\s*\|/.test(m) && !/ note: /.test(m));
const plain = (x) => /^[-+0-9.eE\s:a-z]+$/.test(x) && !/[a-z]\s*$/.test(x.trim()); // numbers, maybe by the names of sites
const units = (unit) => (["1", "yes/no", ""].includes(unit) ? "" : ` ${unit}`);
const now = () => new Date(Date.now() - new Date().getTimezoneOffset() * 60000).toISOString().slice(0, 16);
/** The unit that a value is in, where no value stands before it. */
const within = (unit) => (units(unit).trim() ? `, in ${units(unit).trim()}` : "");

const planned = (x) => (typeof x.planned === "string" ? x.planned : x.planned === null ? `not known${within(x.unit)}` : `${number(x.planned, 6)}${units(x.unit)}`);

/** What is accepted of a measure, in words. */
function accepted(m) {
    if (m.unit === "yes/no") return "yes or no";
    const [low, high] = [m.low, m.high].map((x) => (x === "" ? null : x));
    const unit = units(m.unit);
    return low !== null && high !== null ? `${low} to ${high}${unit}` : high === "0" && low === null ? "none" : high !== null ? `at most ${high}${unit}` : low !== null ? `at least ${low}${unit}` : `any${within(m.unit)}`;
}

export class AsRun {
    /** fit(options, name): numbers of the process from the coupons of a log */
    constructor(holder, { fit }) {
        this.flow = null;
        this.fit = fit;
        this.logs = [];
        this.name = "";
        this.control = null;
        this.timer = 0;
        this.which = select("Log", [["", "a new log"]], "", (v) => this.#take(v), { id: "log-name" });
        this.said = h("p", { class: "doc", role: "status" });
        this.wrong = h("ul", { class: "messages warn-text" });
        this.result = h("div", { class: "log-result" });
        this.form = h("form", { class: "log-form", "aria-label": "A step that was run", onsubmit: (e) => {
            e.preventDefault();
            this.#add();
        } });
        this.box = h("details", { class: "reasons as-run", ontoggle: () => this.box.open && this.#look() }, h("summary", {}, "As run: what was done, beside the plan"),
            h("p", { class: "doc" }, "The log of a lot is a file beside the description. It only grows, and a line that somebody changes afterwards is found. It is of the recipe as it was when the log began."),
            h("div", { class: "row" }, h("label", { class: "option" }, h("span", {}, "log"), this.which)), this.said, this.wrong, this.result, this.form);
        holder.append(this.box);
        this.shown = new Shown(this.result, () => this.#key());
        mayChange(() => this.control !== null || this.timer !== 0, { job: true });
        for (const event of ["preview", "change", "options", "lab"]) on(event, () => this.#later());
    }

    /** Whose log; null: there is no recipe. */
    offer(flow) {
        this.box.hidden = flow === null;
        if (flow === this.flow) return;
        this.flow = flow;
        this.name = "";
        this.told = null;
        this.shape = null;
        if (this.box.open && flow) this.#look();
    }

    #key(make = inputKey) {
        return make({ flow: this.flow, run: this.name });
    }

    #later() {
        clearTimeout(this.timer);
        this.timer = 0;
        if (!this.box.open || this.box.hidden || !this.flow || this.#key() === this.tried || !isPresent() || this.control) return;
        this.timer = setTimeout(() => {
            this.timer = 0;
            this.#read();
        }, QUIET_MS);
    }

    async #look() {
        try {
            const there = await get("/api/beside");
            this.logs = there.logs;
            this.where = there.directory;
        } catch (error) {
            this.#refuse([error.message]);
        }
        if (!this.name && this.logs.length === 1 && this.told === null) [this.name] = this.logs;
        this.#names();
        return this.#read();
    }

    #names() {
        const all = [...new Set([...this.logs, ...(this.name ? [this.name] : [])])];
        setOptions(this.which, [["", "a new log"], ...all.map((x) => [x, x])], this.name);
    }

    #take(name) {
        this.name = name;
        this.#read();
    }

    /** Reads the log, or without one what there is to enter. A log that began before numbers of the laboratory were used
     *  is of the plan without them. */
    async #read() {
        this.control?.abort();
        const control = (this.control = new AbortController());
        const key = (this.tried = this.#key(requestKey));
        const ask = (packs) => run("log", { options: { flow: this.flow, ...(this.name ? { run: this.name } : {}) }, packs, byItself: true, signal: control.signal });
        const end = begin({ words: "Log", cancel: () => control.abort() });
        try {
            let job = await ask(true);
            this.without = false;
            if (job.state === "failed" && said(job).some((m) => OTHER_PLAN.test(m)) && Object.keys(state.lab).length) {
                forget(job);
                job = await ask(false);
                this.without = job.state === "done";
            }
            if (control !== this.control || job.state === "cancelled") return forget(job);
            forget(this.job);
            this.job = job;
            const good = job.state === "done" && job.result;
            this.#refuse(good ? said(job).filter((m) => /\[FW-D28[0-9]\]/.test(m)) : said(job), good ? null : "another");
            if (good) {
                this.told = job.result;
                this.#show();
            } else this.result.replaceChildren();
            this.shown.take(good ? key : null);
        } catch (error) {
            if (control === this.control) this.#refuse([error.message]);
        } finally {
            end();
            if (control === this.control) this.control = null;
        }
    }

    #refuse(list, kind = null) {
        const other = list.some((m) => OTHER_PLAN.test(m));
        this.wrong.replaceChildren(...list.map((m) => h("li", {}, m)), ...(other ? [h("li", {}, "Undo what was changed since, or take back the version that was made (Versions in the header), to enter more steps.")] : []));
        this.form.hidden = kind === "another" && this.name !== "";
        if (list.length) announce(list[0]);
    }

    // ---- planned and actual ----

    #show() {
        const r = this.told;
        const steps = r.steps.filter((x) => x.times);
        const lot = r.lot ? `, lot ${r.lot}` : "";
        this.said.textContent = this.name ? `${this.name}${lot}: ${r.entries} ${r.entries === 1 ? "entry" : "entries"}, ${r.logged} of ${r.steps.length} steps run, ${r.outside} outside of their limits.${this.without ? " The numbers of the laboratory came after it began: its plan is the one without them." : ""}`
            : `No log is chosen: the first entry begins one.${this.#onlyHere()}`;
        const row = (x, e, first) => h("tr", { class: e.judged === "in window" || e.judged === "no plan" ? "" : "outside" },
            h("th", { scope: "row" }, first ? `${x.id} ${x.title}` : ""), h("td", {}, e.wafer ?? "lot"), h("td", { class: "n" }, x.at_machine_s === null ? "–" : duration(x.at_machine_s)), h("td", { class: "n" }, e.actual_s === undefined ? "–" : duration(e.actual_s) + (e.runs ? `; ${e.runs} runs, ${duration(e.runs_s)}` : "")), h("td", {}, e.judged ?? "–"),
            h("td", {}, [...(e.measured ?? []).map((m) => [m.accepted, `${m.measure} ${typeof m.value === "number" ? number(m.value, 4) : m.value ?? ""}${units(m.unit ?? "")}`]), ...(e.settings ?? []).map((m) => [m.accepted, `${m.name} ${typeof m.value === "number" ? number(m.value, 4) : m.value ?? ""}${units(m.unit ?? "")}`])]
                .map(([good, words], i) => h("span", { class: good ? "" : "bad-text" }, `${i ? "; " : ""}${words}${good ? "" : " (outside)"}`)), e.note ? h("span", { class: "doc" }, ` ${e.note}`) : ""));
        const rows = steps.flatMap((x) => [x, ...(x.others ?? [])].map((e, i) => row(x, e, i === 0)));
        const link = this.job && hasFile(this.job, "log.html") ? h("a", { class: "button small", href: fileOf(this.job, "log.html"), target: "_blank", rel: "noopener" }, icon("open"), "Report with control charts") : null;
        const keep = this.name ? h("a", { class: "button small", href: `/api/beside/${encodeURIComponent(this.name)}`, download: this.name }, icon("download"), "The log itself") : null;
        const coupons = steps.some((x) => [x, ...(x.others ?? [])].some((e) => e.coupons?.length));
        const fit = coupons ? button("Fit the process to its coupons", { icon: "target", class: "small", id: "log-fit" }, () => this.fit({ flow: this.flow, run: this.name }, this.name)) : null;
        this.result.replaceChildren(...[
            rows.length ? h("div", { class: "wide", tabIndex: 0, role: "region", "aria-label": "Steps as run" }, h("table", { class: "plain" }, h("thead", {}, h("tr", {}, ["step", "wafer", "planned, at the machine", "as run", "time", "measured and set"].map((x) => h("th", { scope: "col" }, x)))), h("tbody", {}, rows))) : null,
            r.deviations?.length ? h("ul", { class: "log-deviations" }, r.deviations.map((d) => h("li", {}, `${d.step}${d.wafer ? `, wafer ${d.wafer}` : ""}: ${d.what} is ${d.actual}, planned ${d.planned}`))) : null,
            r.fates?.length ? h("ul", { class: "log-fates" }, r.fates.map((f) => h("li", {}, `wafer ${f.wafer}: ${f.fate} at ${f.step}, ${f.at}: ${f.why}`))) : null,
            this.name ? h("div", { class: "row" }, link, keep, fit) : null].filter(Boolean));
        this.#steps();
    }

    /** What a log that begins now is of, and no file has: whoever goes on in the terminal needs it. */
    #onlyHere() {
        const text = changed();
        const packs = Object.keys(state.lab).length > 0;
        if (!text && !packs) return "";
        const what = [text ? "a text that is not saved" : null, packs ? "numbers of the laboratory that are in this page" : null].filter(Boolean).join(" and ");
        return ` It is then of ${what}: save ${text && packs ? "both" : text ? "it" : "them as a pack"} first, so that flexwright log can go on with it.`;
    }

    // ---- an entry ----

    #steps() {
        const key = JSON.stringify([this.flow, this.name, this.told.wafers]);
        if (key === this.shape) return;
        this.shape = key;
        const next = this.told.steps.find((x) => !x.times) ?? this.told.steps[0];
        const field = (label, value, more = {}) => {
            const input = h("input", { value, autocomplete: "off", ...more });
            return [input, h("label", { class: "pose-field" }, h("span", {}, label), input)];
        };
        this.step = select("Step", this.told.steps.map((x) => [x.id, `${x.id} ${x.title}`]), next.id, () => this.#asked());
        const [start, startBox] = field("begun", now(), { type: "datetime-local", required: true });
        const [end, endBox] = field("ended", now(), { type: "datetime-local", required: true });
        const [by, byBox] = field("by", this.fields?.by.value ?? "", { required: true, placeholder: "initials" });
        const [second, secondBox] = field("second signature", "");
        const [tool, toolBox] = field("machine", "");
        const [bath, bathBox] = field("bath", "");
        const [instrument, instrumentBox] = field("measured with", "");
        const [note, noteBox] = field("note", "");
        const [why, whyBox] = field("why", "", { placeholder: "cracked in the chuck" });
        const became = select("What became of the wafer", [["", "nothing: it goes on"], ["held", "held"], ["resumed", "goes on after it was held"], ["scrapped", "scrapped"]], "", () => (whyBox.hidden = !became.value));
        whyBox.hidden = true;
        this.became = { became, why };
        const [lot, lotBox] = field("lot", "");
        const [file, fileBox] = field("file", "lot1", { id: "log-file" });
        const [wafers, wafersBox] = field("wafers: how many, or their names with commas between", "1");
        const wafer = select("Wafer", [["", "the whole lot"], ...(this.told.wafers ?? []).map((w) => [w, `wafer ${w}`])], "", () => {});
        this.fields = { start, end, by, second, tool, bath, instrument, note, wafer };
        this.first = this.name ? null : { lot, file, wafers };
        this.measured = h("div", { class: "draw-fields log-asked" });
        this.sets = h("div", { class: "draw-fields log-asked" });
        this.coupons = h("textarea", { rows: 2, "aria-label": "Coupons, one a line", placeholder: "undercut-ladder, feature=width, drawn=16 um, value=13.1 13.0 um, u=0.1 um, at=50.5 um", spellcheck: false });
        this.form.replaceChildren(h("h3", {}, this.name ? "The next entry" : "Begin a log"), ...[
            this.first ? h("div", { class: "draw-fields" }, fileBox, lotBox, wafersBox) : null,
            h("div", { class: "draw-fields" }, h("label", { class: "pose-field wide-field" }, h("span", {}, "step"), this.step), this.first ? null : h("label", { class: "pose-field" }, h("span", {}, "of"), wafer), startBox, endBox, byBox, secondBox, toolBox, bathBox, instrumentBox, noteBox),
            this.told.wafers ? h("details", { class: "reasons" }, h("summary", {}, "What became of a wafer"), h("p", { class: "doc" }, "An entry of its own, at the time under ended: from then on nothing more is expected of the wafer. What was run and measured of it before is an entry before this one."),
                h("div", { class: "draw-fields" }, h("label", { class: "pose-field" }, h("span", {}, "it is"), became), whyBox)) : null,
            this.measured, h("details", { class: "reasons" }, h("summary", {}, "What was set"), this.sets), h("details", { class: "reasons" }, h("summary", {}, "Coupons that were measured"), h("p", { class: "doc" }, "One a line, as calibrate takes them: name, feature, drawn size, values, standard uncertainty, at what."), this.coupons),
            h("div", { class: "row" }, button("Add to the log", { icon: "check", class: "small primary", id: "log-add", type: "submit" }))].filter(Boolean));
        this.#asked();
    }

    /** What the chosen step measures and sets. */
    #asked() {
        const x = this.told.steps.find((y) => y.id === this.step.value);
        const field = (kind, name, hint) => h("label", { class: "pose-field" }, h("span", {}, name, h("span", { class: "doc" }, ` ${hint}`)), h("input", { autocomplete: "off", "data-kind": kind, "data-name": name,
            title: kind === "measure" ? `What was measured; accepted is ${hint}. Several values with blanks between, then their unit.` : `What was set on the machine, with its unit; ${hint}.` }));
        this.measured.replaceChildren(...x.measures.map((m) => field("measure", m.measure, `${accepted(m)}${m.sites > 1 ? `; up to ${m.sites} values: centre, top, left, bottom, right` : ""}`)));
        this.sets.replaceChildren(...(x.sets.length ? x.sets.map((y) => field("set", y.name, `planned ${planned(y)}`)) : [h("p", { class: "doc" }, "This step sets nothing.")]));
    }

    /** The words of the entry, or what is wrong with them. */
    #words() {
        const x = this.told.steps.find((y) => y.id === this.step.value);
        const parts = [x.id];
        const { became, why } = this.became;
        if (became.value) {
            const { end, by, wafer, note } = this.fields;
            if (!wafer.value || !why.value.trim()) return { why: "Say of which wafer, and why." };
            for (const [name, value] of [["wafer", wafer.value], ["start", end.value], ["by", by.value], ["note", note.value], [became.value, why.value]]) if (value.trim()) parts.push(`${name}=${value.trim()}`);
            return parts.some((p) => /[;\t\r\n]/.test(p)) ? { why: "No semicolon can stand in an entry." } : { words: parts.join("; ") };
        }
        const { start, end } = this.fields;
        if (x.at_machine_s >= SHORT_S && start.value === end.value) return { why: `It began and ended in the same minute, and is planned for ${duration(x.at_machine_s)}: say when it began. What is written into a log stays there.` };
        for (const [name, input] of Object.entries(this.fields)) if (input.value.trim()) parts.push(`${name}=${input.value.trim()}`);
        for (const input of this.form.querySelectorAll("[data-kind]")) {
            const value = input.value.trim();
            if (!value) continue;
            const of = input.dataset.kind === "set" ? x.sets.find((y) => y.name === input.dataset.name) : x.measures.find((y) => y.measure === input.dataset.name);
            parts.push(`${input.dataset.kind === "set" ? "set " : ""}${input.dataset.name}=${value}${plain(value) ? units(of.unit) : ""}`);
        }
        parts.push(...this.coupons.value.split("\n").map((line) => line.trim()).filter(Boolean).map((line) => `coupon=${line}`));
        const bad = parts.find((p) => /[;\t\r\n]/.test(p));
        return bad ? { why: `No semicolon can stand in an entry: "${bad}".` } : { words: parts.join("; ") };
    }

    async #add() {
        if (this.control) return this.#refuse(["The log is being read: try again in a moment."]);
        const { words, why } = this.#words();
        if (why) return this.#refuse([why]);
        const begins = this.first;
        const file = begins?.file.value.trim().replace(/\.log$/, ""); // as the list names it
        if (begins && !NAME.test(file)) return this.#refuse(["The name of the log's file is of letters, digits, - and _."]);
        const name = begins ? `${file}.log` : this.name;
        if (begins && this.logs.includes(name)) return this.#refuse([`${name} is there already: choose it above, or give another name.`]);
        const add = this.form.querySelector("#log-add");
        add.disabled = true;
        this.control = new AbortController();
        const end = begin({ words: "Adding to the log", cancel: () => {} });
        try {
            const job = await run("log", {
                options: { flow: this.flow, run: name, entries: "entry.txt", ...(begins ? { lot: begins.lot.value.trim() || undefined, wafers: begins.wafers.value.trim() || undefined } : {}) },
                files: { "entry.txt": `${words}\n` }, packs: !this.without,
            });
            forget(job);
            if (job.state !== "done") return this.#refuse(said(job));
            announce(`${this.step.value} is in the log`);
            if (!this.logs.includes(name)) this.logs.push(name);
            this.name = name;
            this.#names();
            this.shape = null;
            const doubts = said(job).filter((m) => /\[FW-D28[0-9]\]|entry/.test(m));
            this.control = null;
            await this.#read();
            if (doubts.length) this.#refuse(doubts);
        } catch (error) {
            this.#refuse([error.message]);
        } finally {
            end();
            add.disabled = false;
            if (this.control && !this.control.signal.aborted && this.tried === this.#key()) this.control = null;
        }
    }
}
