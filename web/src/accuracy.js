// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy costs for this device: the trade-off job and its picture.
import { h, icon } from "./dom.js";
import { fileOf, JobView } from "./jobs.js";
import { state } from "./store.js";

export class Accuracy {
    constructor(holder) {
        const box = h("div", { class: "accuracy" });
        holder.append(box);
        this.job = new JobView(box, {
            kind: "tradeoff", action: "Measure the trade-off", options: () => (state.options.scene ? { scene: state.options.scene } : {}),
            intro: "Runs this scene with every method, integrator and tolerance and compares each with an independent reference: error of the peak hinge deflection against work. Takes some ten seconds.",
            accept: (job) => (job.files ?? []).length > 0 || job.result !== null, render: (job, into) => this.#show(job, into),
        });
    }

    shown(yes) {
        this.job.show(yes);
    }

    #show(job, into) {
        const pictures = (job.files ?? []).filter((f) => f.path.endsWith(".svg"));
        const others = (job.files ?? []).filter((f) => !f.path.endsWith(".svg") && f.path !== "manifest.json");
        into.replaceChildren(
            ...pictures.map((f) => h("figure", { class: "tradeoff", tabIndex: 0, role: "region", "aria-label": "Work-precision picture" }, h("img", { src: fileOf(job, f.path), alt: "Error of the peak hinge deflection against work, for every method and integrator" }))),
            h("p", { class: "recipe-links" }, others.map((f) => h("a", { class: "button", href: fileOf(job, f.path), target: "_blank", rel: "noopener" }, icon("open"), f.path))));
    }
}
