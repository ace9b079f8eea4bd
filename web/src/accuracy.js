// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy costs for this device: the trade-off job, its picture, the settings that nothing beats,
// and what the model itself is off by.
import { setOptionsTogether } from "./design.js";
import { announce, button, h, icon } from "./dom.js";
import { number, percent, si } from "./format.js";
import { fileOf, hasFile, JobView } from "./jobs.js";
import { state } from "./store.js";

export class Accuracy {
    constructor(holder) {
        const box = h("div", { class: "accuracy" });
        holder.append(box);
        this.job = new JobView(box, {
            kind: "tradeoff", action: "Measure the trade-off", options: () => (state.options.scene ? { scene: state.options.scene } : {}),
            intro: "Runs this scene with every method, integrator and tolerance and compares each with a reference that shares nothing with them: error of the peak hinge deflection against work. Takes about half a minute.",
            accept: (job) => Array.isArray(job.result?.points), render: (job, into) => this.#show(job, into),
        });
    }

    shown(yes) {
        this.job.show(yes);
    }

    #show(job, into) {
        const t = job.result;
        const c = t.chosen;
        const front = t.points.filter((p) => p.front).sort((a, b) => (a.instructions ?? 0) - (b.instructions ?? 0));
        into.replaceChildren(
            h("div", { class: "recipe-facts" },
                fact("chosen by itself", `${c.method}, ${c.integrator}`), fact("its true error", share(c.error)), fact("its own estimate", share(c.estimated)),
                fact("over the cheapest that is enough", c.over_cheapest === null ? "–" : `${number(c.over_cheapest, 3)} ×`),
                fact("one more digit costs", t.summary.digit_here === null ? "–" : `${number(t.summary.digit_here, 3)} ×`),
                fact("the model itself is off by", t.summary.floor === null ? "–" : `${percent(t.summary.floor, 2)}, ${t.summary.floor_what}`)),
            hasFile(job, "tradeoff.svg") ? h("figure", { class: "tradeoff", tabIndex: 0, role: "region", "aria-label": "Work-precision picture" }, h("img", { src: fileOf(job, "tradeoff.svg"), alt: "Error of the peak hinge deflection against work, for every method and integrator" })) : "",
            h("h3", {}, "Settings that nothing beats"),
            h("div", { class: "wide", tabIndex: 0, role: "region", "aria-label": "Settings that nothing beats" }, h("table", { class: "plain" },
                h("thead", {}, h("tr", {}, ["method", "integrator", "tolerance", "true error", "estimate", "steps", "work", ""].map((x) => h("th", { scope: "col" }, x)))),
                h("tbody", {}, front.map((p) => h("tr", { class: p.method === c.method && p.integrator === c.integrator && p.rtol === c.rtol ? "chosen-row" : "" },
                    h("td", {}, p.method), h("td", {}, p.integrator), h("td", {}, number(p.rtol, 1)), h("td", {}, `${p.at_most ? "≤ " : ""}${share(p.error)}`), h("td", {}, share(p.estimated)),
                    h("td", {}, number(p.steps, 6)), h("td", {}, p.instructions === null ? "–" : si(p.instructions, " instr.")),
                    h("td", {}, button("Use", { class: "small", "aria-label": `Use ${p.method}, ${p.integrator}, ${p.rtol}` }, () => use(p)))))))),
            h("h3", {}, "What the model leaves out"),
            h("div", { class: "wide", tabIndex: 0, role: "region", "aria-label": "What the model leaves out" }, h("table", { class: "plain" },
                h("thead", {}, h("tr", {}, ["kind", "choice", "changes the peaks by", "known before", "why"].map((x) => h("th", { scope: "col" }, x)))),
                h("tbody", {}, t.models.map((m) => h("tr", {}, h("td", {}, m.kind), h("td", {}, m.chosen ? h("b", {}, `${m.name}, chosen`) : m.name), h("td", {}, share(m.change)), h("td", {}, share(m.bound)), h("td", {}, m.why ?? "")))))),
            h("p", { class: "recipe-links" }, ["tradeoff.csv", "tradeoff.json"].filter((f) => hasFile(job, f)).map((f) => h("a", { class: "button", href: fileOf(job, f), download: f }, icon("download"), f))));
    }
}

const share = (x) => (x === null || x === undefined ? "–" : x >= 1e-4 ? percent(x, 2) : number(x, 2));
const fact = (name, value) => h("div", { class: "fact" }, h("span", {}, name), h("strong", {}, value));

function use(point) {
    setOptionsTogether({ method: point.method, integrator: point.integrator, rtol: number(point.rtol, 1).replace("\u2212", "-") });
    announce(`the motion is computed by ${point.method} and ${point.integrator}`);
}
