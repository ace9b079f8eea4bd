// SPDX-License-Identifier: GPL-3.0-or-later
// Two commands as cards: the equilibrium under a scene's loads with the way to it, and every flexure on the ladder of its
// models. Each is the job of that name, with the words and numbers of its document.
import { h, icon } from "./dom.js";
import { degrees, number, percent, si } from "./format.js";
import { fileOf, hasFile, JobView } from "./jobs.js";
import { state } from "./store.js";

const chosen = (names) => Object.fromEntries(names.filter((n) => state.options[n] !== undefined).map((n) => [n, state.options[n]]));
const save = (job, path) => (hasFile(job, path) ? h("a", { class: "button small", href: fileOf(job, path), download: path }, icon("download"), path) : null);
const picture = (job, path, alt) => (hasFile(job, path) ? h("a", { href: fileOf(job, path), target: "_blank", rel: "noopener", class: "picture-link" }, h("img", { src: fileOf(job, path), alt })) : null);
const table = (label, heads, rows) => h("div", { class: "wide", tabIndex: 0, role: "region", "aria-label": label },
    h("table", { class: "plain" }, h("thead", {}, h("tr", {}, heads.map((x) => h("th", { scope: "col" }, x)))), h("tbody", {}, rows)));

/** The equilibrium of the scene, and with the tick the load path from rest to it. */
export class Statics {
    constructor(holder) {
        const card = h("section", { class: "card", id: "statics" }, h("h2", {}, "Equilibrium under load"));
        holder.append(card);
        const path = h("input", { type: "checkbox" });
        path.addEventListener("change", () => this.view.job && this.view.run());
        card.append(h("label", { class: "force-row" }, path, h("span", {}, "with the load path, through limit points")));
        this.view = new JobView(card, {
            kind: "statics", action: "Find the equilibrium", options: () => ({ ...chosen(["scene", "accuracy", "effects", "hinge_model"]), ...(path.checked ? { path: true } : {}) }),
            intro: "Where the mechanism comes to rest under the loads of the scene, and whether it stays there.", render: (job, into) => this.#show(job, into),
        });
    }

    #show(job, into) {
        const r = job.result;
        const events = (r.path?.events ?? []).filter((e) => e.kind !== "end");
        const bodies = Object.entries(r.com ?? {});
        into.replaceChildren(
            h("p", {}, h("strong", {}, r.stable ? "Stable" : `Unstable in ${r.negative} ${r.negative === 1 ? "direction" : "directions"}`), `, ${r.scene}.`, r.neutral ? ` ${r.neutral} motions without stiffness.` : ""),
            table("Hinges at the equilibrium", ["hinge", "angle", "force"], (r.hinges ?? []).map((x) => h("tr", {}, h("td", {}, x.hinge), h("td", { class: "n" }, degrees(x.angle_rad)), h("td", { class: "n" }, x.force_N ? si(Math.hypot(...x.force_N), "N") : "–")))),
            bodies.length ? h("p", { class: "doc" }, `Centres of mass: ${bodies.slice(0, 8).map(([id, at]) => `${id} ${at.map((v) => number(v * 1e6, 5)).join(", ")} µm`).join("; ")}.`) : "",
            r.path ? h("p", {}, r.path.complete ? "The path reaches the full load" : "The path ends before the full load", events.length ? `: ${events.map((e) => `${e.kind} at ${percent(e.load_factor, 4)} of the load`).join(", ")}.` : ", past no limit point.") : "",
            picture(job, "statics.svg", `Equilibrium of ${r.scene}`) ?? "", picture(job, "path.svg", "Load path") ?? "",
            h("div", { class: "row" }, ["statics.csv", "statics.json"].map((f) => save(job, f))));
    }
}

/** Every flexure by every model of it: what each says, by how much it may be off, and which one is good enough. */
export class Ladder {
    constructor(holder) {
        const box = h("section", { id: "ladder" }, h("h2", {}, "Hinges by themselves"));
        holder.append(box);
        this.view = new JobView(box, {
            kind: "hinge", action: "Compare their models", options: () => chosen(["accuracy"]),
            intro: "Every flexure on a ladder of models, in the material of every flow: stiffness, limit angle, what each model may be off by, and its cost.", render: (job, into) => this.#show(job, into),
        });
    }

    #show(job, into) {
        const row = (x, level, first) => h("tr", {}, h("td", {}, first ? `${x.id}${x.flow ? `, ${x.flow}` : ""}` : ""), h("td", {}, `${x.picked?.level === level.level ? "* " : ""}${level.level}`),
            ...(level.solved === false ? [h("td", { colSpan: 5 }, `no answer${level.why ? `: ${level.why}` : ""}`)] : [h("td", { class: "n" }, si(level.stiffness_Nm_per_rad, "N m/rad")), h("td", { class: "n" }, percent(level.error?.stiffness, 2)), h("td", { class: "n" }, Number.isFinite(level.limit_angle_rad) ? degrees(level.limit_angle_rad) : "–"),
                h("td", { class: "n" }, percent(level.error?.strain, 2)), h("td", { class: "n" }, si(level.cpu_s, "s", 2))]));
        // what the terminal says above and below the levels of a flexure
        const note = (x) => [Number.isFinite(x.fillet_m) ? `strain and limit rest on fillets of ${number(x.fillet_m * 1e6, 4)} µm at its roots, ${x.fillet_stated ? "as stated" : "chosen: none is stated"}` : "", Number.isFinite(x.used_stiffness_Nm_per_rad) ? `stiffness used: ${si(x.used_stiffness_Nm_per_rad, "N m/rad", 5)}` : "",
            x.levels.some((level) => level.error?.outside) ? "outside of the shapes that were compared with finite elements: errors are guesses" : "",
            x.picked ? `* ${x.picked.level}: ${x.picked.why}` : ""].filter(Boolean).join("; ");
        const notes = (x) => h("tr", { class: "ladder-note" }, h("td", {}), h("td", { colSpan: 6, class: x.levels.some((level) => level.error?.outside) ? "guessed" : "" }, note(x)));
        into.replaceChildren(
            table("Flexures by level", ["flexure", "model", "stiffness", "off by at most", "limit angle", "strain off by at most", "CPU"], (job.result.hinges ?? []).flatMap((x) => [...x.levels.map((level, i) => row(x, level, i === 0)), ...(note(x) ? [notes(x)] : [])])),
            h("div", { class: "row" }, ["hinge.svg", "hinge.json"].map((f) => save(job, f))), picture(job, "hinge.svg", "Flexures with their elastic centres") ?? "");
    }
}
