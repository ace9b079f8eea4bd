// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy costs for this device: the trade-off job, what each further digit takes, its picture, the
// settings that nothing beats, and what the model itself is off by.
import { setOption, setOptionsTogether } from "./design.js";
import { announce, button, h, icon, select, setOptions } from "./dom.js";
import { number, percent, si } from "./format.js";
import { fileOf, hasFile, JobView } from "./jobs.js";
import { ACCURACIES } from "./motion.js";
import { Ladder } from "./statics.js";
import { on, state } from "./store.js";

/** What the model is off by at most, of floor_what. */
const FLOORS = { solid: "what the verdict allows its model of hinges", hinge: "what a better model of the hinges changes", effects: "what the effects that were left out change" };

export class Accuracy {
    constructor(holder) {
        const box = h("div", { class: "accuracy" });
        holder.append(box);
        const names = [["", "0.1 %"], ...ACCURACIES.map((a) => [a, percent(Number(a))])];
        const wanted = select("Accuracy wanted", names, "", (v) => setOption("accuracy", v));
        box.append(h("label", { class: "option accuracy-wanted" }, h("span", {}, "error of the peak deflection that is good enough"), wanted));
        on("options", () => {
            const now = state.options.accuracy ?? "";
            setOptions(wanted, names.some(([v]) => v === now) ? names : [...names, [now, now]], now);
        });
        this.job = new JobView(box, {
            kind: "tradeoff", action: "Measure the trade-off", options: () => Object.fromEntries(["scene", "accuracy", "effects", "hinge_model"].filter((name) => state.options[name]).map((name) => [name, state.options[name]])),
            intro: "Runs this scene with every method, integrator and tolerance and compares each with a reference that shares nothing with them: error of the peak hinge deflection against work. Takes about half a minute.",
            accept: (job) => Array.isArray(job.result?.points), render: (job, into) => this.#show(job, into),
        });
        this.ladder = new Ladder(box);
    }

    shown(yes) {
        this.job.show(yes);
    }

    #show(job, into) {
        const t = job.result;
        const c = t.chosen;
        const front = frontOf(t);
        into.replaceChildren(
            h("div", { class: "recipe-facts" },
                digitFact(t.summary),
                fact("no digit helps below", t.summary.floor === null ? "–" : percent(t.summary.floor, 2), t.summary.floor === null ? "" : `the model is off by more: ${FLOORS[t.summary.floor_what] ?? t.summary.floor_what}`),
                fact("chosen by itself", c.quasi_static ? "a quasi-static sequence of equilibria" : `${c.method}, ${c.integrator}`, `true error ${share(c.error)}; it says at most ${share(c.estimated)}`),
                fact("which costs", c.over_cheapest === null ? "–" : `${number(c.over_cheapest, 3)} ×`, "the cheapest setting that is good enough")),
            h("h3", {}, "What each digit costs"),
            table("What each digit costs", ["error at most", "work", "", "", "CPU time", "cheapest that reaches it", ""], digitRows(t), "digits"),
            h("p", { class: "doc" }, workedOut(t)),
            hasFile(job, "tradeoff.svg") ? h("figure", { class: "tradeoff", tabIndex: 0, role: "region", "aria-label": "Work-precision picture" }, h("img", { src: fileOf(job, "tradeoff.svg"), alt: "Error of the peak hinge deflection against work, for every method and integrator" })) : "",
            h("h3", {}, "Settings that nothing beats"),
            table("Settings that nothing beats", ["method", "integrator", "tolerance", "true error", "estimate", "steps", "work", ""], front.map((p) => h("tr", { class: same(p, c) ? "chosen-row" : "" },
                h("td", {}, p.method), h("td", {}, p.integrator), h("td", {}, p.quasi_static ? "–" : number(p.rtol, 1)), h("td", {}, `${p.at_most ? "≤ " : ""}${share(p.error)}`), h("td", {}, share(p.estimated)),
                h("td", {}, number(p.steps, 6)), h("td", {}, work(p)), h("td", {}, p.quasi_static ? "" : useButton(p))))),
            h("h3", {}, "What the model leaves out"),
            table("What the model leaves out", ["kind", "choice", "changes the peaks by", "known before", "why"],
                t.models.map((m) => h("tr", {}, h("td", {}, m.kind), h("td", {}, m.chosen ? h("b", {}, `${m.name}, chosen`) : m.name), h("td", {}, share(m.change)), h("td", {}, share(m.bound)), h("td", {}, m.why ?? "")))),
            h("p", { class: "recipe-links" }, ["tradeoff.svg", "tradeoff.csv", "tradeoff.json"].filter((f) => hasFile(job, f)).map((f) => h("a", { class: "button", href: fileOf(job, f), download: f }, icon("download"), f))));
    }
}

const share = (x) => (x === null || x === undefined ? "–" : x >= 1e-4 ? percent(x, 2) : number(x, 2));
const work = (p) => (p.instructions === null ? "–" : si(p.instructions, " instr."));
const same = (p, q) => p.method === q.method && p.integrator === q.integrator && p.rtol === q.rtol;
const fact = (name, value, rest) => h("div", { class: "fact" }, h("span", {}, name), h("strong", {}, value), rest ? h("small", {}, rest) : null);
const table = (name, heads, rows, kind = "") => h("div", { class: "wide", tabIndex: 0, role: "region", "aria-label": name }, h("table", { class: `plain ${kind}` },
    h("thead", {}, h("tr", {}, heads.map((x) => (x ? h("th", { scope: "col", class: x === "CPU time" ? "cpu" : null }, x) : h("td", {}))))), h("tbody", {}, rows)));

/** From the program's own setting on, or where nothing is finer than that on average. */
function digitFact({ digit_here: here, digit_overall: overall }) {
    if (here === null) return fact("one more digit costs", more(overall), overall === null ? "one setting is the best for every digit" : "on average over all digits");
    return fact("one more digit costs", more(here), overall === null ? "" : `${more(overall)} on average`);
}

/** A factor of work as people say it: 1.04 -> "4 % more work", 2.5 -> "2.5 × the work". */
const more = (factor) => (factor === null || factor === undefined ? "–" : factor < 1.005 ? "nothing" : factor < 2 ? `${number((factor - 1) * 100, factor < 1.1 ? 1 : 2)} % more work` : `${number(factor, 2)} × the work`);

/** What nothing beats, the cheapest first. */
const frontOf = (t) => [t.chosen, ...t.points].filter((p) => p.front && p.instructions !== null).sort((a, b) => a.instructions - b.instructions);

/**
 * For 10 %, 1 %, 0.1 % ... the cheapest setting that has no larger error: [{error, point}], as far as any reaches.
 * Only settings of the front count: what is cheapest for some error is beaten by nothing.
 */
export function digits(t) {
    const front = frontOf(t);
    const rows = [];
    for (let k = 1; k < 17; k++) {
        const error = Number(`1e-${k}`);
        const good = front.filter((p) => p.error <= error);
        if (!good.length) break;
        rows.push({ error, point: good[0] });
    }
    return rows;
}

/** Rows of the table: what is the same as above and below is left out, unless it is wanted or the first that is finer than the model. */
function digitRows(t) {
    const rows = digits(t);
    const most = Math.max(...rows.map((r) => r.point.instructions));
    const floor = t.summary.floor ?? 0;
    const enough = (r) => r !== undefined && r.error <= t.accuracy_wanted * 1.0001;
    return rows.flatMap((r, i) => {
        const [before, next] = [rows[i - 1], rows[i + 1]];
        const again = before?.point === r.point;
        const wanted = enough(r) && !enough(before);
        const firstFiner = r.error < floor && !(before?.error < floor);
        if (again && next?.point === r.point && !wanted && !firstFiner) return [];
        const line = h("tr", { class: `${r.error < floor ? "below-floor" : ""}${wanted ? " chosen-row" : ""}`, "data-error": r.error },
            h("th", { scope: "row" }, r.error >= 1e-4 ? percent(r.error) : number(r.error, 1), " ", wanted ? h("span", { class: "wanted-tag" }, r.error > t.accuracy_wanted * 0.9999 ? "wanted" : `wanted: ${percent(t.accuracy_wanted)}`) : null),
            h("td", {}, again ? "the same" : work(r.point)),
            h("td", { class: "work-bar" }, h("i", { style: { width: `${(100 * r.point.instructions) / most}%` } })),
            h("td", { class: "step-factor" }, !before || again ? "" : `${number(r.point.instructions / before.point.instructions, 3)} ×`),
            h("td", { class: "cpu" }, again ? "" : timeOf(t, r.point)),
            h("td", { class: "setting" }, again ? "" : settingOf(r.point)),
            h("td", {}, again || r.point.quasi_static ? "" : useButton(r.point)));
        return firstFiner ? [h("tr", { class: "floor-row" }, h("td", { colSpan: 7 }, `below ${percent(floor, 2)} the model itself is off by more (${FLOORS[t.summary.floor_what] ?? t.summary.floor_what})`)), line] : [line];
    });
}

const settingOf = (p) => (p.quasi_static ? "a quasi-static sequence of equilibria" : `${p.method}, ${p.integrator}, ${number(p.rtol, 1)}`);

/** CPU time where it was measured: its ratio to the chosen setting's, times that one's. */
const timeOf = (t, p) => (p.time?.told && t.chosen.cpu_s !== null ? si(p.time.ratio * t.chosen.cpu_s, "s", 2) : "–");

/** How the work is known, in a sentence. */
const workedOut = (t) => (t.instructions_why ? `Work is a model's, good to a factor of two (${t.instructions_why}).` : "Work is counted instructions, the error estimate included; × is against the row above.");

function useButton(point) {
    return button("Use", { class: "small", "aria-label": `Use ${point.method}, ${point.integrator}, ${point.rtol}` }, () => {
        setOptionsTogether({ method: point.method, integrator: point.integrator, rtol: number(point.rtol, 1).replace("\u2212", "-") });
        announce(`the motion is computed by ${point.method} and ${point.integrator}`);
    });
}
