// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of the laboratory: what a recipe cannot compute without is entered here and becomes a laboratory pack, as
// `--lab` takes it. A pack belongs to the input of everything that is computed (state.lab); it can be saved, and one that
// somebody has can be opened, or made of what was measured on the coupons (`flexwright calibrate`).
import { requestKey } from "./belong.js";
import { announce, button, h, say, select } from "./dom.js";
import { run } from "./jobs.js";
import { saveAs } from "./plotfile.js";
import { emit, keepOfTab, keptOfTab, on, state } from "./store.js";

const NAMESPACE = "urn:flexwright:process:1";
const KEPT = "laboratory"; // of the browser's store of this tab: a reload keeps them
const STATUS = [["measured", "measured"], ["stated", "stated by the maker"], ["typical", "typical"], ["assumed", "assumed"]];
const MOST_BYTES = 200000;

const escaped = (x) => String(x).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
const nameOf = (flow) => `entered-${flow}.xml`;
/** What is counted is exact unless somebody says otherwise. */
const exact = (kind) => (kind === "count" ? "0" : "");
const isNumber = (x) => /^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*$/.test(x);

/** Of what kind the source is that stands behind a number: each claim needs one that can bear it. */
const SOURCES = { measured: ["laboratory", "measured"], stated: ["maker", "datasheet"], typical: ["taken", "assumed"], assumed: ["taken", "assumed"] };

/** The pack of these rows: [{id, kind, value, u, unit, status}], numbers and words as somebody has written them. */
export function packOf(flow, rows, source) {
    const says = (r) => (r.kind === "word" ? `word="${escaped(r.value.trim())}"` : `value="${escaped(r.value.trim())}"${r.u?.trim() ? ` u="${escaped(r.u.trim())}"` : ""}`);
    const values = rows.map((r) => `  <q id="${escaped(r.id)}" ${says(r)} unit="${escaped(r.unit)}" status="${r.status}" src="${SOURCES[r.status][0]}"/>`);
    const used = new Map(rows.map((r) => SOURCES[r.status]));
    const sources = [...used].map(([id, kind]) => `  <source id="${id}" kind="${kind}">${escaped(source || "entered on the page")}</source>`);
    return `<?xml version="1.0" encoding="UTF-8"?>\n<process xmlns="${NAMESPACE}" id="laboratory" version="1" title="numbers of the laboratory" flow="${escaped(flow)}">\n${sources.join("\n")}\n${values.join("\n")}\n</process>\n`;
}

/** The numbers of a pack: id -> {value, u, status}, a word as its value; of one that cannot be read, none. */
function numbersOf(pack) {
    const all = pack === undefined ? [] : new DOMParser().parseFromString(pack, "text/xml").getElementsByTagNameNS(NAMESPACE, "q");
    const one = (q) => ({ value: q.getAttribute("word") ?? q.getAttribute("value") ?? "", u: q.getAttribute("u") ?? "", status: q.getAttribute("status") ?? "" });
    return new Map([...all].map((q) => [q.getAttribute("id"), one(q)]));
}

const counted = (n) => `${n} ${n === 1 ? "number" : "numbers"}`;

/** Packs of an earlier visit of this tab. */
export function restorePacks() {
    const kept = keptOfTab(KEPT);
    state.labRows = kept.rows ?? {};
    state.labSources = kept.sources ?? {};
    state.lab = kept.lab ?? {};
}

const keepPacks = () => keepOfTab(KEPT, { lab: state.lab, rows: state.labRows, sources: state.labSources });

function changed(words) {
    keepPacks();
    emit("change");
    emit("lab");
    announce(words);
}

const LONGEST_MS = 60000; // that an answer is waited for

/** Whether the input of this key was answered, for better or worse, while it is the present one. */
function answerOf(key) {
    return new Promise((resolve) => {
        const begun = performance.now();
        const look = () => {
            if (state.answered === key) return resolve(true);
            if (requestKey() !== key || state.lost !== null || state.cancelled === key || performance.now() - begun > LONGEST_MS) return resolve(false);
            setTimeout(look, 50);
        };
        look();
    });
}

export class Laboratory {
    constructor(holder) {
        this.flow = null;
        this.known = [];
        this.rows = h("tbody", {});
        this.other = select("Another number", [["", "another number…"]], "", (id) => this.#addRow(id));
        this.source = h("input", { "aria-label": "Where these numbers are from", placeholder: "where they are from", class: "lab-source", oninput: () => {
            state.labSources[this.flow] = this.source.value;
            keepPacks();
        } });
        this.said = h("p", { class: "doc", role: "status" });
        this.wrong = h("ul", { class: "messages warn-text" });
        this.table = h("table", { class: "plain lab-table" }, h("thead", {}, h("tr", {}, ["number", "value", "± (standard uncertainty)", "unit", "how it is known", "in use"].map((x) => h("th", { scope: "col" }, x)))), this.rows);
        const file = (label, accept, take) => {
            const input = h("input", { type: "file", accept, hidden: true, "aria-label": label, onchange: async () => {
                const [f] = input.files;
                input.value = "";
                if (f) take(f);
            } });
            return [button(label, { icon: "open", class: "small" }, () => input.click()), input];
        };
        this.save = button("Save as a pack", { icon: "download", class: "small", id: "lab-save" }, () => this.#save());
        this.clear = button("Without them", { icon: "close", class: "small", id: "lab-clear" }, () => this.#clear());
        this.box = h("details", { class: "reasons laboratory" }, h("summary", {}, "Numbers of your laboratory"),
            h("p", { class: "doc" }, "What is entered stands for the value of the process pack in all that this page computes, as ", h("code", {}, "--lab"), " does on the command line."),
            this.table, h("div", { class: "row" }, this.other, this.source, button("Use these numbers", { icon: "check", class: "small primary", id: "lab-use" }, () => this.#use()), this.save, this.clear),
            h("div", { class: "row" }, file("Open a pack…", ".xml", (f) => this.#open(f)), file("From measured coupons…", ".csv,.txt,.log", (f) => this.#calibrate(f))), this.wrong, this.said);
        holder.append(this.box);
        on("lab", () => this.#say());
        on("answer", () => this.#diagnostics());
        this.#say();
    }

    /** flow: whose numbers; known: [{id, name, kind ("number", "count", "word"), unit, missing (for what, or ""), value}] */
    offer(flow, known) {
        const before = this.flow;
        this.flow = flow;
        this.known = known;
        this.box.hidden = flow === null;
        if (flow === null) return;
        if (before !== flow) this.source.value = state.labSources[flow] ?? "";
        const rows = (state.labRows[flow] ??= {});
        for (const q of known) if (q.missing && !rows[q.id]) rows[q.id] = { value: "", u: exact(q.kind), status: q.kind === "word" ? "stated" : "measured" };
        const rest = known.filter((q) => !rows[q.id]);
        this.other.replaceChildren(h("option", { value: "" }, "another number…"), ...rest.map((q) => h("option", { value: q.id }, `${q.name} (${q.id})`)));
        const key = JSON.stringify([flow, Object.keys(rows)]);
        if (this.shape !== key) {
            this.shape = key;
            this.rows.replaceChildren(...Object.keys(rows).map((id) => this.#row(id)));
        }
        if (before !== flow && Object.values(rows).some((r) => !r.value) && known.some((q) => q.missing)) this.box.open = true;
        this.#say();
    }

    #row(id) {
        const row = state.labRows[this.flow][id];
        const known = this.known.find((x) => x.id === id) ?? { id, name: id, kind: row.kind ?? "number", unit: row.unit ?? "1", missing: "" };
        const q = known.name === id ? { ...known, name: row.name ?? id } : known; // once it is in use, the recipe misses it no more, and names it no more
        Object.assign(row, { unit: q.unit, name: q.name, kind: q.kind });
        const word = q.kind === "word";
        const words = q.name === id ? id : `${q.name} (${id})`;
        const take = (name, value) => {
            row[name] = value;
            this.#say();
        };
        const field = (name, label, short) => h("input", { value: row[name], placeholder: short, inputmode: word ? "text" : "decimal", autocomplete: "off", "aria-label": `${words}: ${label}`, oninput: (e) => take(name, e.target.value), onkeydown: (e) => e.key === "Enter" && this.#use() });
        return h("tr", { "data-id": id }, h("th", { scope: "row" }, q.name === id ? "" : `${q.name} `, h("span", { class: "code" }, id), q.missing ? h("span", { class: "doc" }, ` needed for ${q.missing}`) : ""),
            h("td", {}, word ? field("value", "which it is", "its name") : field("value", "value", "value")), h("td", {}, word ? "–" : field("u", "standard uncertainty", "±")), h("td", {}, word ? "a word" : q.unit === "1" ? "–" : q.unit), h("td", {}, select(`${words}: how it is known`, STATUS, row.status, (v) => take("status", v))), h("td", { class: "lab-used" }));
    }

    #addRow(id) {
        if (!id) return;
        const { kind } = this.known.find((x) => x.id === id) ?? {};
        state.labRows[this.flow][id] = { value: "", u: exact(kind), status: kind === "word" ? "stated" : "measured" };
        this.offer(this.flow, this.known);
        this.rows.querySelector(`[data-id="${CSS.escape(id)}"] input`)?.focus();
    }

    #filled() {
        return Object.entries(state.labRows[this.flow] ?? {}).map(([id, r]) => ({ id, ...r })).filter((r) => r.value.trim());
    }

    /** What is entered, as a pack takes it; null: something is not, and it is said. */
    #good() {
        const rows = this.#filled();
        const bad = rows.filter((r) => r.kind !== "word" && (!isNumber(r.value) || !isNumber(r.u)));
        this.#refuse(bad.map((r) => (isNumber(r.value) && !r.u.trim() ? `${r.id}: its standard uncertainty is needed, too; 0 says that it is exact` : `${r.id}: a number is needed, not "${isNumber(r.value) ? r.u : r.value}"`)));
        return bad.length ? null : rows;
    }

    #use() {
        const rows = this.#good();
        if (!rows) return;
        if (!rows.length) return this.#refuse(["No value is entered yet."]);
        state.lab[nameOf(this.flow)] = packOf(this.flow, rows, this.source.value);
        changed(`${counted(rows.length)} of the laboratory ${rows.length === 1 ? "is" : "are"} used`);
    }

    #clear() {
        state.lab = {};
        this.#refuse([]);
        changed("without numbers of the laboratory");
    }

    /** What the table shows, as a file. It is used first, so that it is what is computed with, and that the program has looked at it: what the
     *  command line would refuse is not saved. */
    async #save() {
        const rows = this.#good();
        if (!rows) return;
        const name = nameOf(this.flow);
        const shown = rows.length ? packOf(this.flow, rows, this.source.value) : undefined;
        if (shown !== state.lab[name]) {
            if (shown === undefined) delete state.lab[name];
            else state.lab[name] = shown;
            changed(shown === undefined ? "without the numbers of the table" : `${counted(rows.length)} of the laboratory ${rows.length === 1 ? "is" : "are"} used`);
        }
        const pack = state.lab[name] ?? Object.values(state.lab)[0];
        if (!pack) return this.#refuse(["There is nothing to save yet."]);
        this.save.disabled = true;
        const looked = await answerOf(requestKey());
        this.save.disabled = false;
        if (pack !== (state.lab[name] ?? Object.values(state.lab)[0])) return; // it was changed meanwhile
        if (!looked) return this.#refuse(["Not saved: nothing was computed with it, so that the program has not looked at it."]);
        const refused = this.#refused();
        if (refused.length) {
            this.wrong.prepend(h("li", {}, `Not saved: ${refused.join(", ")} is refused.`));
            return announce(`Not saved: ${refused.join(", ")} is refused`);
        }
        this.#refuse([]);
        saveAs(`laboratory-${this.flow}.xml`, pack, "application/xml");
    }

    async #open(file) {
        if (file.size > MOST_BYTES) return this.#refuse([`${file.name} is larger than a laboratory pack may be here (200 kB)`]);
        const text = await file.text();
        const name = `${file.name.toLowerCase().replace(/\.xml$/, "").replace(/[^a-z0-9]+/g, "-").replace(/^-+|-+$/g, "").slice(0, 40) || "pack"}.xml`;
        this.#refuse([]);
        state.lab[name === "archive.xml" ? "pack.xml" : name] = text;
        changed(`${file.name} is used`);
    }

    /** What was measured on the coupons becomes a pack, by the command's own fit. */
    async #calibrate(file) {
        if (file.size > MOST_BYTES) return this.#refuse([`${file.name} is larger than a table may be here (200 kB)`]);
        return this.fit({ text: await file.text(), options: { flow: this.flow } }, file.name);
    }

    /** By the fit of the command: of a table, or of a log that options name. Of several the one that is asked for last counts. */
    async fit(what, name) {
        this.box.open = true;
        const mine = (this.fitting = {});
        this.#refuse([]); // what was said of another table
        const into = this.#calibrated(); // of the flow that it is begun with, whichever is looked at when it ends
        this.said.textContent = `Fitting the numbers of ${this.flow} to ${name}…`;
        try {
            const packs = this.#others();
            const names = Object.keys(packs);
            const job = await run("calibrate", names.length ? { ...what, files: packs, options: { ...what.options, lab: names.join(",") } } : what);
            if (mine !== this.fitting) return;
            if (job.state !== "done" || !job.files?.length) return this.#refuse((job.messages ?? []).filter((m) => !/^\s*\d*\s*\|/.test(m)).map((m) => m.replace(/^measured\.csv(?=:)/, () => name)));
            const pack = await (await fetch(`/api/jobs/${job.id}/files/laboratory.xml`, { credentials: "same-origin" })).text();
            if (mine !== this.fitting) return;
            state.lab[into] = pack;
            changed(`numbers of ${name} are used`);
        } catch (error) {
            if (mine === this.fitting) this.#refuse([error.message]);
        }
        if (mine === this.fitting) this.#say();
    }

    #calibrated() {
        return `calibrated-${this.flow}.xml`;
    }

    /** The packs of this flow that are not made of its coupons: what is found is for use with them. */
    #others() {
        return Object.fromEntries(Object.entries(state.lab).filter(([name, text]) => name !== this.#calibrated() && /<process[^>]*\sflow="([^"]*)"/.exec(text)?.[1] === this.flow));
    }

    #refuse(list) {
        this.wrong.replaceChildren(...list.map((m) => h("li", {}, m)));
        if (list.length) announce(list[0]);
        this.#say();
    }

    /** What the program says of the packs, where they are used. */
    #diagnostics() {
        const names = Object.keys(state.lab);
        const said = state.diagnostics.filter((d) => names.some((n) => (d.file ?? "").endsWith(n)) && d.severity !== "note");
        if (said.length || this.byProgram) this.wrong.replaceChildren(...said.map((d) => h("li", {}, `${d.file}:${d.line}: ${d.message}${d.code ? ` [${d.code}]` : ""}`)));
        this.byProgram = said.length > 0;
        if (said.length) this.box.open = true;
        this.#say();
    }

    /** Which of the packs the program refuses, as the last answer says. */
    #refused() {
        const errors = state.answered === requestKey() ? state.diagnostics.filter((d) => d.severity === "error") : [];
        return Object.keys(state.lab).filter((n) => errors.some((d) => (d.file ?? "").endsWith(n)));
    }

    /** What is in use, number by number and in all, and what is entered and not in use. */
    #say() {
        const names = Object.keys(state.lab);
        const refused = this.#refused();
        const own = numbersOf(state.lab[nameOf(this.flow)]);
        const used = new Map(refused.length ? [] : names.flatMap((n) => [...numbersOf(state.lab[n])]));
        const waiting = [];
        for (const tr of this.rows.children) {
            const { id } = tr.dataset;
            const row = state.labRows[this.flow]?.[id];
            const [mine, now] = [own.get(id), used.get(id)];
            const differs = row && (row.value.trim() || mine) && !(mine && mine.value === row.value.trim() && (row.kind === "word" || mine.u === row.u.trim()) && mine.status === row.status);
            if (differs) waiting.push(id);
            say(tr.querySelector(".lab-used"), `${now ? `${now.value}${now.u ? ` ± ${now.u}` : ""}` : "nothing of yours"}${differs ? "; what is entered is not used yet" : ""}`);
            tr.classList.toggle("waiting", Boolean(differs));
        }
        this.clear.disabled = names.length === 0;
        const packs = names.map((n) => `${n} (${counted(numbersOf(state.lab[n]).size)})`).join(", ");
        say(this.said, `${refused.length ? `Nothing is computed with ${packs}: ${refused.join(", ")} is refused. Correct it and use it again, or go on without.` : names.length ? `In use: ${packs}.` : "None are in use."}${
            waiting.length ? ` Entered and not used yet: ${waiting.join(", ")}. "Use these numbers" takes what stands in the table.` : ""}`);
    }
}
