// SPDX-License-Identifier: GPL-3.0-or-later
// The studies of the description: run, stopped, gone on with, looked at; and the best device of one put into the text. A
// study is a job of the server, the command `flexwright study`; what it has judged stays when it is stopped.
import { get, remove } from "./api.js";
import { begin, inputKey, mayChange, ofAnother, requestKey, Shown, stampOf, studyText } from "./belong.js";
import { edit, taken } from "./design.js";
import { announce, button, h, icon, say, select } from "./dom.js";
import { duration, number, percent, si } from "./format.js";
import { elsewhere, fileOf, forget, hasFile, run, takeUp } from "./jobs.js";
import { emit, keepOfTab, keptOfTab, on, state } from "./store.js";

const KINDS = { // what a new one is made of: rows beside its inputs
    sweep: { words: "a map: every combination", vary: { steps: "9" }, respond: [{ name: "used", value: "governing.utilisation", max: "1" }] },
    sensitivity: { words: "which number matters", vary: {}, respond: [{ name: "used", value: "governing.utilisation" }] },
    size: { words: "the device that uses least of its limits", vary: {}, respond: [{ name: "used", value: "governing.utilisation", goal: "minimise" }] },
    "worst-case": { words: "the worst within the ranges", vary: {}, respond: [{ name: "used", value: "governing.utilisation" }] },
    yield: { words: "how many dies hold every limit", vary: null, respond: [] },
};
const PICTURES_MOST = 8;
const ELSEWHERE_MS = 1000; // between two looks at what others have begun
const BEGUN = "studies"; // of the browser's store of this tab: numbers of the studies that it has begun, which it may forget

const begunHere = () => Object.keys(keptOfTab(BEGUN)).map(Number);

function rememberBegun(id) {
    const all = begunHere().slice(-7); // the server keeps some as well
    keepOfTab(BEGUN, Object.fromEntries([...all, id].map((x) => [x, true])));
}

export class Studies {
    /** chosen(): the inputs that are explored at the moment, with their ranges as texts: [{what, from, to}] */
    constructor(holder, chosen) {
        this.chosen = chosen;
        this.kept = new Map(); // name -> {job, of: key of its input, whole: that of all of the text, control, stage, why, done}
        this.list = h("div", { class: "study-list" });
        this.there = []; // samples beside the file: {directory, study, kind, device}
        this.others = new Map(); // name -> job of a study that another page has begun, or this one before it was loaded anew
        this.kind = select("Kind of study", Object.entries(KINDS).map(([k, x]) => [k, `${k}: ${x.words}`]), "size", () => {});
        this.add = button("Add to the description", { icon: "plus", id: "study-add" }, () => this.#add());
        holder.append(h("section", { class: "studies", "aria-labelledby": "h-studies" }, h("h2", { id: "h-studies" }, "Studies"),
            h("p", { class: "doc" }, "A study judges many devices of this description, in files of its own: stopped, it goes on where it was. One stands in the text as <study>."),
            this.list, h("div", { class: "row" }, this.kind, this.add), h("p", { class: "doc" }, "A new one varies what is chosen above, over the ranges that stand there.")));
        for (const event of ["text", "options", "change", "preview"]) on(event, () => this.visible && this.#show());
        on("jobs-elsewhere", () => this.visible && this.#lookElsewhere());
        mayChange(() => [...this.kept.values()].some((x) => x.control), { job: true });
    }

    shown(yes) {
        this.visible = yes;
        if (!yes) return;
        this.#show();
        this.#lookElsewhere();
        get("/api/beside").then((beside) => {
            this.there = beside.results;
            this.#show();
        }).catch(() => {}); // then none are offered
    }

    /** The newest study of each name that is not this page's; one question at a time. */
    async #lookElsewhere() {
        if (this.looking) return (this.again = true);
        this.looking = true;
        this.again = false;
        try {
            this.others = new Map((await elsewhere()).filter((job) => job.kind === "study" && job.study).map((job) => [job.study, job]));
            for (const [name, job] of this.others) if (job.state === "done") await this.#takeUp(name, job.id);
            this.#show();
        } catch {
            // the connection says so
        }
        setTimeout(() => {
            this.looking = false;
            if (this.again && this.visible) this.#lookElsewhere();
        }, ELSEWHERE_MS);
    }

    /** What a study is of that begins now: the server keeps it with the job, for whichever page comes next. */
    #stamp(name) {
        return stampOf(name, this.#options(name));
    }

    /** A study that has ended is opened: of the present input where it was begun with that, on whichever page, else of a former one. */
    async #takeUp(name, id) {
        if (this.kept.has(name) || !this.#here.some((x) => x.name === name)) return;
        const job = await takeUp(id);
        if (!job.result || this.kept.has(name)) return;
        this.kept.set(name, { job, control: null, done: true, lent: !begunHere().includes(id), of: job.of === this.#stamp(name) ? this.#key(name, requestKey) : "of another input" });
        this.others.delete(name);
    }

    /** Names and kinds as the text has them. */
    get #here() {
        return (this.form?.root?.children ?? []).filter((e) => e.name === "study").map((e) => ({ name: e.attributes.get("name")?.value ?? "", kind: e.attributes.get("kind")?.value ?? "", element: e }));
    }

    #options(name) {
        const { accuracy, effects, hinge_model } = state.options;
        return { study: name, ...Object.fromEntries(Object.entries({ accuracy, effects, hinge_model }).filter(([, v]) => v !== undefined)) };
    }

    /** What its result depends on: not what other studies of the text say. */
    #key(name, make = inputKey) {
        return make(this.#options(name), studyText(name));
    }

    /** And what it can be gone on with: the program compares whole files. */
    #whole(name) {
        return requestKey(this.#options(name));
    }

    // ---- a new one ----

    async #add() {
        const kind = this.kind.value;
        const { vary, respond } = KINDS[kind];
        const inputs = vary ? this.chosen() : [];
        if (vary && !inputs.length) return emit("notice", { kind: "warn", text: "Choose above what is to be varied, and over which range." });
        const names = this.#here.map((x) => x.name);
        let name = kind;
        for (let n = 2; names.includes(name); n++) name = `${kind}-${n}`;
        const root = this.form.root.name;
        const at = `${root}/study[${name}]`;
        await edit([
            { add: root, element: "study", attributes: { name, kind, ...(kind === "yield" ? { samples: "200" } : { as: "drawn" }) } },
            ...inputs.map((x) => ({ add: at, element: "vary", attributes: { what: x.what, from: x.from, to: x.to, ...vary } })),
            ...respond.map((attributes) => ({ add: at, element: "respond", attributes })),
        ], `study ${name} added`);
        return this.#show();
    }

    // ---- running ----

    /** resume: number of a job that is gone on with; results: a directory that is opened */
    async #run(name, { resume, results } = {}) {
        const key = this.#key(name, requestKey);
        const before = this.kept.get(name);
        if (!resume && !results && before?.job && !before.lent) forget(before.job); // the page that began it shows it, too
        const control = new AbortController();
        const mine = { control, of: key, whole: this.#whole(name), stage: "waiting", job: null };
        this.kept.set(name, mine);
        this.#show();
        const end = begin({ words: `Study ${name}`, cancel: () => control.abort() });
        const begun = performance.now();
        try {
            await taken();
            mine.of = this.#key(name, requestKey);
            mine.whole = this.#whole(name);
            const job = await run("study", { options: this.#options(name), resume, results, of: this.#stamp(name), signal: control.signal, onprogress: (j) => {
                mine.far = /\d+ of (?:at most )?\d+ devices/.exec(j.stage ?? "")?.[0] ?? mine.far;
                mine.stage = `${j.stage ?? j.state} · ${((performance.now() - begun) / 1e3).toFixed(1)} s`;
                if (mine.job?.id !== j.id) rememberBegun(j.id);
                mine.job = j;
                this.#show();
            } });
            mine.job = job;
            if (job.state === "done" && job.result) mine.done = true;
            else if (job.state === "cancelled") mine.stopped = true;
            else mine.why = whyNot(job, results);
            if (results && !mine.why && before?.job && !before.lent) forget(before.job);
            announce(`Study ${name}: ${mine.done ? `done in ${duration(job.seconds)}` : mine.stopped ? "stopped" : mine.why}`);
        } catch (error) {
            mine.why = error.message;
        } finally {
            mine.control = null;
            if (mine.why && results) this.#notOpened(name, mine, before);
            end();
            this.#show();
        }
    }

    /** What was chosen is not of this study as it is now: that says nothing of the study, which stays as it was. */
    #notOpened(name, mine, before) {
        if (mine.job) forget(mine.job);
        if (before) this.kept.set(name, before);
        else this.kept.delete(name);
        emit("notice", { kind: "warn", text: mine.why });
    }

    // ---- what is shown ----

    #show() {
        const here = this.#here;
        for (const name of this.kept.keys()) if (!here.some((x) => x.name === name) && !this.kept.get(name).control) {
            if (!this.kept.get(name).lent) forget(this.kept.get(name).job);
            this.kept.delete(name);
        }
        const open = new Set([...this.list.querySelectorAll(".study")].map((e) => e.dataset.name));
        if (!here.length) {
            this.list.replaceChildren(h("p", { class: "empty" }, "There is none in this description yet."));
            return;
        }
        if (open.size !== here.length || here.some((x) => !open.has(x.name))) this.list.replaceChildren(...here.map((x) => this.#card(x.name)));
        for (const x of here) this.#fill(x);
    }

    #card(name) {
        const head = h("div", { class: "study-head" });
        const body = h("div", { class: "study-body job-content" });
        const card = h("section", { class: "study card", "data-name": name, "aria-label": `Study ${name}` }, head, body);
        Object.assign(card, { head, body, result: new Shown(body, () => this.#key(name)) });
        return card;
    }

    #fill({ name, kind, element }) {
        const card = [...this.list.children].find((e) => e.dataset.name === name);
        const kept = this.kept.get(name);
        const mine = kept && !kept.control && ofAnother(kept.of) ? undefined : kept; // a study of another device may have the same name
        const present = mine?.of === this.#key(name);
        const other = mine?.control ? undefined : this.others.get(name); // begun by another page
        const runs = other && ["queued", "running"].includes(other.state);
        const inputs = element.children.filter((c) => c.name === "vary" || c.name === "uncertain").map((c) => c.attributes.get("what")?.value).filter(Boolean);
        const goOn = Boolean(mine?.stopped && present && mine.job && mine.whole === this.#whole(name));
        const changed = !mine?.stopped || goOn ? "" : present ? "; the text has another study or remark since, so that it begins anew" : "; the input has changed since";
        const said = mine?.control ? mine.stage : mine?.why ? mine.why : mine?.stopped ? `stopped${mine.far ? ` after ${mine.far}` : ""}${changed}` : mine?.done ? `${mine.job.result.samples.run} devices in ${duration(mine.job.seconds)}${present ? "" : "; of the former input"}` : "";
        const theirs = runs ? `another page runs it: ${other.state === "queued" ? "waiting" : `${other.stage ?? "working"} · ${duration(other.seconds)}`}` : other && !mine ? "another page has run it: what it has judged can be gone on with" : "";
        const part = mine?.control && /(\d+) of (?:at most )?(\d+) devices/.exec(mine.stage);
        const there = this.there.filter((x) => x.study === null || (x.study === name && x.kind === kind)); // samples of others cannot be gone on with
        // buttons stay while a field is left whose edit changes the words: a click is not lost between its two halves
        const key = JSON.stringify([kind, inputs, mine?.control ? said : "", Boolean(mine), Boolean(mine?.control), mine?.job?.id, mine?.done, Boolean(mine?.why), goOn, there, other?.id, runs]);
        if (card.dataset.key === key) return say(card.querySelector(".study-said"), theirs || said);
        card.dataset.key = key;
        card.head.replaceChildren(
            h("strong", {}, name), h("span", { class: "doc" }, `${kind}${inputs.length ? ` over ${inputs.join(", ")}` : ""}`), h("span", { class: "space" }),
            ...(mine?.control ? [h("progress", { "aria-label": `Study ${name}: progress`, max: part ? Number(part[2]) : null, value: part ? Number(part[1]) : null }), button("Stop", { icon: "close", class: "small", "data-act": "stop" }, () => mine.control?.abort())] : runs ? [button("Stop", { icon: "close", class: "small", "data-act": "stop-other" }, async () => {
                await remove(`/api/jobs/${other.id}`).catch(() => {}); // it may just have ended
                this.#lookElsewhere();
            })] : [
                other && !mine ? button("Go on", { icon: "play", class: "small primary", "data-act": "resume-other" }, () => {
                    this.others.delete(name);
                    this.#run(name, { resume: other.id });
                }) : null,
                goOn ? button("Go on", { icon: "play", class: "small primary", "data-act": "resume" }, () => this.#run(name, { resume: mine.job.id })) : null,
                button(mine ? "Run anew" : "Run", { icon: "target", class: `small${mine ? "" : " primary"}`, "data-act": "run" }, () => this.#run(name)),
                there.length ? select(`Open results of ${name}`, [["", "Open results…"], ...there.map((x) => [x.directory, x.study === null ? `${x.directory} (whose it is cannot be told)` : x.directory])], "", (results) => results && this.#run(name, { results })) : null,
            ]).filter(Boolean),
            h("p", { class: mine?.why ? "job-errors study-said" : "job-message study-said", role: "status" }, theirs || said));
        if (!mine?.done) {
            card.body.replaceChildren();
            card.result.take(null);
            return;
        }
        if (card.body.dataset.job !== String(mine.job.id)) {
            card.body.dataset.job = String(mine.job.id);
            card.body.replaceChildren(...this.#result(mine.job));
        }
        card.result.take(mine.of);
    }

    #result(job) {
        const r = job.result;
        const link = (path, words) => (hasFile(job, path) ? h("a", { class: "button", href: fileOf(job, path), target: "_blank", rel: "noopener" }, icon("open"), words) : null);
        const save = (path, words) => (hasFile(job, path) ? h("a", { class: "button", href: fileOf(job, path), download: `${r.device}-${r.study}-${path}` }, icon("download"), words) : null);
        const n = r.samples;
        const parts = [`${n.accepted} accepted`, `${n.rejected} rejected`, `${n.inconclusive} inconclusive`, ...(n.accepted_at_some_corners ? [`${n.accepted_at_some_corners} no better than these`] : []), ...(n.failed ? [`${n.failed} could not be judged`] : [])];
        return [
            h("p", {}, `${n.run + n.failed} devices: ${parts.join(", ")}${n.failed && n.example_why ? ` (number ${n.example_at}: ${n.example_why})` : ""}.`),
            ...(r.yields ?? []).map((y) => h("p", {}, `${y.flow ?? "As drawn"}: ${y.least ? `${percent(y.least.yield)} to ${percent(y.most.yield)}, as is what is only assumed,` : percent(y.yield)} hold every limit (${percent(y.sampling_interval?.[0])} to ${percent(y.sampling_interval?.[1])} by sampling alone; with the model's own band ${percent(y.yield_range?.[0])} to ${percent(y.yield_range?.[1])}).`)),
            ...(r.found ?? []).map((f, i) => this.#device(r.found.length > 1 ? `Device ${i + 1} of the front` : "Best device", f, r)),
            r.kind === "size" && !r.found?.length && r.nearest ? this.#device("No device holds every limit; the nearest", r.nearest, r) : null,
            ...(r.responses ?? []).flatMap((x) => [["least", x.worst_least], ["largest", x.worst_largest]].filter(([, w]) => w?.set).map(([word, w]) => this.#device(`${x.name}, ${word}${x.without ? ` of the ${x.values} that have a value` : ""}: ${valueOf(x, w.value)}`, w, r))),
            ...(r.responses ?? []).filter((x) => x.without).map((x) => this.#device(withoutValue(x, r), { set: x.without.set }, r)),
            ...(r.responses ?? []).filter((x) => x.by).map((x) => effects(x)),
            r.how ? h("p", { class: "doc" }, r.how) : null,
            h("div", { class: "study-pictures" }, (job.files ?? []).filter((f) => /^pictures\/.*\.svg$/.test(f.path)).slice(0, PICTURES_MOST).map((f) => h("a", { href: fileOf(job, f.path), target: "_blank", rel: "noopener" }, h("img", { src: fileOf(job, f.path), alt: f.path.replace(/^pictures\/|\.svg$/g, "").replaceAll("-", " ") })))),
            h("div", { class: "row" }, link("study.html", "Study page"), save("study.csv", "CSV"), save("study.sqlite", "SQLite"), h("a", { class: "button", href: `/api/jobs/${job.id}/archive`, download: `${r.device}-${r.study}.zip` }, icon("download"), "All files")),
        ].filter(Boolean);
    }

    /** A device of the results: what it is, and the button that puts it into the text. */
    #device(words, f, result) {
        const set = f.set.map((x) => `${x.path} ${x.value}`).join(", ");
        const values = (f.responses ?? []).map((x) => `${x.name} ${valueOf(result.responses.find((q) => q.name === x.name), x.value)}`).join(", ");
        return h("p", { class: "study-device" }, `${words}: ${set}${values ? ` (${values})` : ""}${f.verdict ? `, ${f.verdict}` : ""} `,
            button("Apply", { class: "small", "data-act": "apply" }, () => edit(f.set.map((x) => ({ path: x.path, value: x.value })), set)));
    }
}

/** Why a study has no result, in words of the page: what the program says of its own options cannot be done here. */
function whyNot(job, results) {
    const said = (job.messages ?? []).filter((m) => !/^\s*\d*\s*\|/.test(m)).join(" ") || `ended with status ${job.exit_status ?? "?"}`;
    const other = /it holds the samples of study '(.*?)' of other inputs, options or another version of the program, not those of '.*?' as it is now(.*); name another directory/.exec(said);
    if (!other) return said;
    const whose = results ? `The samples in ${results} are` : "What was judged is";
    return `${whose} of study '${other[1]}' with another description, other options or another version of the program${other[2]}. ${results ? "They stay where they are; " : ""}Run${results ? "" : " anew"} judges devices of the present description.`;
}

/** A value of a response as people read it: shares of a limit in %, as the verdict has them. */
const valueOf = (response, value) => (response?.share ? percent(value) : response?.unit ? si(value, response.unit, 4) : number(value, 4));

/** How many devices have no value of a response, what they are, and what that leaves of the answer. */
function withoutValue(x, result) {
    const w = x.without;
    const others = w.devices - w.accepted - w.rejected - w.inconclusive - w.failed;
    const parts = [[w.accepted, "accepted"], [w.rejected, "rejected"], [w.inconclusive, "inconclusive"], [w.failed, "could not be judged"], [others, "not judged"]];
    const worst = result.kind === "worst-case" && x.values ? "The worst case of the ranges may well be among them. " : "";
    return `${w.devices} of ${result.samples.run + result.samples.failed} devices have no value of ${x.name}: ${parts.filter(([n]) => n).map(([n, word]) => `${n} ${word}`).join(", ")}. ${worst}Number ${w.first_at} (${w.first_state}) is the first of them`;
}

/** A difference of two values of a response. */
const changeOf = (response, change) => (response.share && Math.abs(change) < 10 ? percent(change).replace(" %", " points") : valueOf(response, change));

/** What each input does to a response, the largest first. */
function effects(x) {
    const rows = [...x.by].sort((a, b) => Math.abs(b.half_range_effect ?? 0) - Math.abs(a.half_range_effect ?? 0));
    return h("table", { class: "plain" }, h("thead", {}, h("tr", {}, [x.name, "half its range changes it by", "share of the variance alone", "with all others"].map((t) => h("th", {}, t)))),
        h("tbody", {}, rows.map((b) => h("tr", {}, h("td", {}, b.what), h("td", { class: "n" }, b.half_range_effect === null || b.half_range_effect === undefined ? "not known" : changeOf(x, b.half_range_effect)), h("td", { class: "n" }, b.first === null || b.first === undefined ? "–" : percent(b.first, 2)), h("td", { class: "n" }, b.total === null || b.total === undefined ? "–" : percent(b.total, 2))))));
}
