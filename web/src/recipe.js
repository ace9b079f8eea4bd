// SPDX-License-Identifier: GPL-3.0-or-later
// Recipes: steps with cross-sections, computed times and what is missing; the schedule; the run sheet.
import { get, request as fetchText } from "./api.js";
import { AsRun } from "./asrun.js";
import { h, icon, select, setOptions } from "./dom.js";
import { duration, number, percent } from "./format.js";
import { Laboratory } from "./laboratory.js";
import { fileOf, forceTick, hasFile, JobView, REJECTED, rejection } from "./jobs.js";

export class Recipe {
    constructor(holder) {
        this.flow = select("Flow", [], "", () => this.#draw());
        this.body = h("div", { class: "recipe-body" });
        const head = h("div", { class: "recipe-head" }, h("label", { class: "option" }, h("span", {}, "flow"), this.flow));
        this.own = h("div", {});
        this.scroll = h("div", { class: "recipe" }, head, this.own, this.body);
        this.laboratory = new Laboratory(this.own);
        this.laboratory.offer(null, []);
        this.asRun = new AsRun(this.own, { fit: (options, name) => this.laboratory.fit({ text: "", options }, name) });
        this.asRun.offer(null);
        holder.append(this.scroll);
        const force = forceTick(() => this.job);
        this.job = new JobView(head, {
            kind: "recipe", action: "Compute the recipes", auto: true, options: force.options, intro: "Every step of every flow with computed times, the schedule and the run sheet.",
            accept: (job) => Boolean(job.result?.recipes ?? job.result?.steps), render: (job) => this.#take(job),
        });
        head.append(force.label);
        this.job.also(this.body);
    }

    shown(yes) {
        this.job.show(yes);
    }

    async #take(job) {
        this.done = job;
        this.recipes = (job.result.recipes ?? [job.result]).filter((r) => r.flow !== null);
        if (!this.recipes.length) return this.#none(job);
        setOptions(this.flow, this.recipes.map((r) => [r.flow, r.flow]), this.flow.value || this.recipes[0]?.flow);
        await this.#draw();
    }

    /** Nothing was made, and why. */
    #none(job) {
        setOptions(this.flow, [], "");
        this.laboratory.offer(null, []);
        this.asRun.offer(null);
        const why = job.exit_status === REJECTED ? `No recipe: the design is rejected. ${rejection()}` : `No recipe. ${(job.messages ?? []).join(" ")}`;
        this.body.replaceChildren(h("p", { class: "empty" }, why));
    }

    async #draw() {
        const job = this.done;
        const r = this.recipes?.find((x) => x.flow === this.flow.value);
        if (!r) return;
        const base = `recipes/${r.flow}`;
        const [sheet, schedule, worth] = await Promise.all([
            hasFile(job, `${base}.html`) ? fetchText("GET", fileOf(job, `${base}.html`), undefined, { as: "text" }).catch(() => "") : "",
            hasFile(job, `${base}.schedule.json`) ? get(fileOf(job, `${base}.schedule.json`)).catch(() => null) : null,
            hasFile(job, `${base}.measurements.json`) ? get(fileOf(job, `${base}.measurements.json`)).catch(() => null) : null,
        ]);
        if (job !== this.done) return;
        this.laboratory.offer(r.flow, numbersOf(r, worth?.measurements));
        this.asRun.offer(r.flow);
        const link = (path, text) => (hasFile(job, path) ? h("a", { class: "button", href: fileOf(job, path), target: "_blank", rel: "noopener" }, icon("open"), text) : null);
        const save = (path, text) => (hasFile(job, path) ? h("a", { class: "button", href: fileOf(job, path), download: path.split("/").at(-1) }, icon("download"), text) : null);
        const missing = r.steps.filter((x) => x.not_computable?.length);
        const made = r.manufacturable === true ? ["can be made", "good"] : r.manufacturable === false ? ["cannot be made", "bad"] : ["not guaranteed", "open"];
        this.body.replaceChildren(
            h("div", { class: "recipe-facts" },
                fact("computed time", duration(r.total_s)), fact("steps", String(r.steps.length)),
                fact("not computable", String(missing.length), missing.length ? "open" : "good"),
                fact("wafer to wafer", schedule?.feasible ? duration(schedule.makespan_s) : "no schedule"),
                fact("this device", made[0], made[1]),
                h("div", { class: "recipe-links" }, link(`${base}.html`, "Run sheet"), save(`${base}.csv`, "CSV"), save(`${base}.ics`, "Calendar"))),
            r.reasons?.length ? h("details", { class: "reasons" }, h("summary", {}, `${r.reasons.length} remarks on making it`), h("ul", {}, r.reasons.map((x) => h("li", {}, x)))) : "",
            measurements(worth?.measurements),
            picture(job, `${base}.schedule.svg`, "Schedule", `Schedule of ${r.flow}: machines over days`),
            folded("Release: when every place is free", picture(job, `${base}.release.svg`, "When every place is free", `When every place of the device is free in ${r.flow}, what is free last and what is lost first`)),
            folded("The wafer after every step, in space", picture(job, `${base}.stack.svg`, "The wafer after every step", `The wafer after every step of ${r.flow}, in space`)),
            h("ol", { class: "steps" }, r.steps.map((x) => step(x, sectionOf(sheet, x.id)))));
    }
}

/** The numbers that a laboratory may state of a recipe: those that are missing first. */
function numbersOf(r, m) {
    const out = new Map((m?.ranked ?? []).filter((q) => q.id).map((q) => [q.id, { id: q.id, name: q.name, kind: q.kind, unit: q.unit, missing: "", value: q.value }]));
    for (const step of r.steps) {
        for (const words of step.not_computable ?? []) {
            const [, name, id] = /^(.*) \(([^()]+)\)$/.exec(words) ?? [];
            if (!id) continue;
            const of = step.quantities?.find((q) => q.name === name);
            const unit = out.get(id)?.unit ?? of?.unit;
            const kind = out.get(id)?.kind ?? (of?.word === undefined ? "number" : "word");
            if (unit) out.set(id, { id, name, kind, unit, value: null, missing: [out.get(id)?.missing, step.id].filter(Boolean).join(", ") });
        }
    }
    return [...out.values()].sort((a, b) => (b.missing !== "") - (a.missing !== ""));
}

/** What each input would be worth if it were measured alone: the first in a sentence, all of them in a table. */
function measurements(m) {
    if (!m?.ranked?.length) return "";
    const now = (q) => (q.value === null ? "not known" : `${q.known ? "" : "assumed "}${number(q.value, 4)} ± ${number(q.u, 2)} ${q.unit === "1" ? "" : q.unit}`);
    const brings = (q) => (q.share > 0 ? `${percent(q.share, 2)} → ${percent(q.share_measured, 2)}` : "–");
    const steps = (q) => [q.windows.length ? `narrower in ${q.windows.map((w) => w.step).join(", ")}` : "", q.needed_for ? `needed for ${q.needed_for}` : ""].filter(Boolean).join("; ");
    return h("details", { class: "reasons worth" }, h("summary", {}, m.first ?? "What to measure first: nothing narrows the verdict"),
        h("table", { class: "plain" }, h("thead", {}, h("tr", {}, ["input", "now", "read by", m.of ? `uncertainty that it brings to ${m.of}, of the limit` : "uncertainty that it brings", "times"].map((x) => h("th", {}, x)))),
            h("tbody", {}, m.ranked.map((q) => h("tr", {}, h("td", {}, q.id ? `${q.name} (${q.id})` : q.name), h("td", { class: "n" }, now(q)), h("td", {}, q.read_by ?? "nothing in this flow"),
                h("td", { class: "n" }, brings(q)), h("td", {}, steps(q)))))));
}

/** A picture of the job, wide: it scrolls by itself. */
function picture(job, path, caption, alt) {
    if (!hasFile(job, path)) return "";
    return h("div", { class: "schedule", tabIndex: 0, role: "region", "aria-label": caption }, h("p", { class: "caption" }, caption), h("img", { src: fileOf(job, path), alt }));
}

/** What is tall and not always wanted. */
const folded = (words, figure) => (figure === "" ? "" : h("details", { class: "reasons" }, h("summary", {}, words), figure));

const fact = (name, value, kind) => h("div", { class: `fact ${kind ?? ""}` }, h("span", {}, name), h("strong", {}, value));

function step(x, section) {
    const t = x.time_s;
    return h("li", { class: x.not_computable?.length ? "step missing" : "step", id: `step-${x.id}` },
        h("div", { class: "step-head" }, h("span", { class: "step-id" }, x.id), h("strong", {}, x.title),
            h("span", { class: "step-source" }, x.in_source ? "in the source" : "added"), h("span", { class: "step-time" }, t ? duration(t.nominal) : "–")),
        h("div", { class: "step-body" },
            section ? h("figure", { class: "section-picture" }, section) : null,
            h("div", {},
                x.not_computable?.length ? h("p", { class: "not-computable" }, h("strong", {}, "NOT COMPUTABLE"), `, missing: ${x.not_computable.join(", ")}`) : null,
                t ? h("p", { class: "window" }, window_("planned", t.nominal), window_("first look", t.first_look), window_("clear by", t.clear_by), window_("stop", t.stop),
                    h("span", { class: `tag ${t.status}` }, t.status)) : null,
                x.quantities?.length ? h("details", {}, h("summary", {}, `${x.quantities.length} ${x.quantities.length === 1 ? "quantity" : "quantities"}`),
                    h("table", { class: "plain" }, h("tbody", {}, x.quantities.map((q) => h("tr", {}, h("td", {}, q.name), h("td", { class: "n" }, q.word ? q.word : q.value === null || q.value === undefined ? "____" : `${number(q.value, 4)}${q.uncertainty ? ` ± ${number(q.uncertainty, 2)}` : ""} ${q.unit ?? ""}`),
                        h("td", {}, h("span", { class: `tag ${q.status}` }, q.status)), h("td", { class: "source" }, q.source ?? "")))))) : null)));
}

const window_ = (name, seconds) => (seconds === null || seconds === undefined ? null : h("span", {}, h("span", {}, name), h("b", {}, duration(seconds))));

/** The cross-section of a step from the run sheet, alone: its <svg> and nothing else of that page. */
function sectionOf(sheet, id) {
    const at = sheet.indexOf(`<section class="step" id="${id}"`);
    const end = at < 0 ? -1 : sheet.indexOf("</section>", at);
    const from = at < 0 ? -1 : sheet.indexOf("<svg", at);
    if (from < 0 || from > end) return null;
    const to = sheet.indexOf("</svg>", from);
    const picture = new DOMParser().parseFromString(sheet.slice(from, to + 6), "image/svg+xml").documentElement;
    if (picture.localName !== "svg" || picture.querySelector("script, foreignObject, style, parsererror, [style]")) return null;
    return document.adoptNode(picture);
}
