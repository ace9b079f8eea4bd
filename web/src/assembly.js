// SPDX-License-Identifier: GPL-3.0-or-later
// The assembly problem: poses of the description before, closed joints after.
import { h, select, setOptions } from "./dom.js";
import { degrees, micrometres } from "./format.js";
import { JobView } from "./jobs.js";
import { centred } from "./mechanism.js";
import { Split } from "./split.js";
import { state } from "./store.js";

export class Assembly extends Split {
    constructor(holder) {
        super(holder, { title: "Assembly", label: "Assembly: outline before, filled after." });
        this.stage.append(h("div", { class: "picture-key" }, h("span", { class: "ghost-key" }), "before", h("span", { class: "after-key" }), "after"));
        this.blend = h("input", { type: "range", min: 0, max: 100, value: 100, "aria-label": "From before to after" });
        this.blend.addEventListener("input", () => this.draw());
        this.which = select("Assembly shown", [], "found", () => this.draw());
        this.card.append(h("label", { class: "option" }, h("span", {}, "before"), this.blend, h("span", {}, "after")), this.which);
        this.view = new JobView(this.card, {
            kind: "assemble", action: "Assemble", auto: true, options: () => (state.options.scene ? { scene: state.options.scene } : {}),
            intro: "Takes the poses of the bodies as a guess and closes all joints.", render: (job, into) => this.#show(job.result, into),
        });
        this.view.also(this.stage);
    }

    #show(result, into) {
        this.result = result;
        const others = result.alternatives ?? [];
        setOptions(this.which, [["found", "found assembly"], ...others.map((a, i) => [String(i), `elbow ${a.elbows_mirrored.join(", ")} mirrored`])], this.which.value);
        this.which.hidden = !others.length;
        const f = result.freedom ?? {};
        into.replaceChildren(
            h("dl", { class: "facts-list" }, [
                ["joints closed", result.closed ? "yes" : "no"], ["largest gap", result.gap_before_m === result.gap_after_m ? gap(result.gap_after_m) : `${gap(result.gap_before_m)} → ${gap(result.gap_after_m)}`],
                ["moved by", `${micrometres(result.moved_m)}, ${degrees(result.turned_rad)}`], ["iterations", `${result.iterations}, ${result.restarts} restarts`],
                ["freedom", `${f.dof}: ${f.unknowns} coordinates, ${f.rank === f.rows ? `${f.rows} conditions` : `${f.rank} of ${f.rows} conditions independent`}`], ["redundant", f.redundant?.length ? f.redundant.join(", ") : "none"],
            ].flatMap(([k, v]) => [h("dt", {}, k), h("dd", {}, v)])),
            result.branches?.length ? h("table", { class: "plain" }, h("thead", {}, h("tr", {}, ["elbow", "bends before", "after"].map((x) => h("th", { scope: "col" }, x)))),
                h("tbody", {}, result.branches.map((b) => h("tr", {}, h("td", {}, b.elbow), h("td", {}, side(b.guess)), h("td", {}, side(b.found)))))) : "");
        this.draw();
    }

    draw() {
        const p = state.preview;
        if (!p || !this.result) return;
        const other = this.which.value === "found" ? null : this.result.alternatives?.[Number(this.which.value)];
        const after = other ? other.q : this.result.after;
        const t = Number(this.blend.value) / 100;
        const { before, after: found, com } = this.result;
        const shown = (b, frame) => (frame && com?.[b.id] ? centred(frame, b.id, found, com) : b.rest ?? [0, 0, 0]);
        this.mechanism.pose(p.bodies.map((b) => {
            const [from, to] = [before?.[b.id], after?.[b.id]];
            return shown(b, from && to && from.map((x, i) => x + t * (to[i] - x)));
        }));
        this.mechanism.ghostAt(p.bodies.map((b) => shown(b, before?.[b.id])));
    }
}

const ROUNDING_M = 1e-15;
const gap = (m) => (Math.abs(m) < ROUNDING_M ? "none" : micrometres(m, 3));
const side = (n) => (n > 0 ? "left" : n < 0 ? "right" : "stretched");
