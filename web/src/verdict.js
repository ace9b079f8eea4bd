// SPDX-License-Identifier: GPL-3.0-or-later
// The right column: decision, governing hinge, utilisation against the limit, what each flow can make,
// which effects were computed and why, what it cost.
import { alike } from "./alike.js";
import { deviceText, inputKey, Shown } from "./belong.js";
import { Compare } from "./compare.js";
import { askAgain, edit, isPresent } from "./design.js";
import { announce, become, button, h, icon, refill, select, setOptions } from "./dom.js";
import { degrees, number, percent, si } from "./format.js";
import { JobView } from "./jobs.js";
import { reasonOf } from "./leftout.js";
import { probesOf, requirementsOf, whyUnknown, withBand } from "./purpose.js";
import { emit, lookAt, on, state } from "./store.js";

const QUIET_MS = 900; // without a change, after which the same is judged as it will be made
const QUIET_MOST_MS = 10000;
const MOST = 100; // diagnostics in a list
const MOST_LINES = 5; // of the banner
const WORDS = {
    accept: ["Accepted", "check"], reject: ["Rejected", "cross"], inconclusive: ["Inconclusive", "question"],
};

export class Verdict {
    constructor(holder) {
        this.banner = h("div", { class: "banner", id: "banner" });
        this.problems = h("section", { class: "card problems", "aria-label": "Diagnostics", hidden: true });
        this.notes = h("section", { class: "card notes", "aria-label": "Notes", hidden: true });
        this.bars = h("div", { class: "bars" });
        this.whose = select("Utilisation in", [["", "worst of all flows"]], "", (v) => {
            state.flow = v;
            this.show();
        });
        this.required = h("section", { class: "card", "aria-labelledby": "h-required", hidden: true }, h("h2", { id: "h-required" }, "What it is for"));
        this.old = h("div", { class: "old-note", id: "old-note", hidden: true });
        this.across = h("section", { class: "card across", "aria-labelledby": "h-across", hidden: true }, h("h2", { id: "h-across" }, "Out of the plane, drying"));
        this.pulls = h("div", {});
        this.pullIn = h("section", { class: "card pull-in", "aria-labelledby": "h-pull-in", hidden: true }, h("h2", { id: "h-pull-in" }, "Electrodes, as drawn"), this.pulls);
        this.flows = h("div", { class: "flows" });
        this.ledger = h("div", { class: "ledger" });
        this.cost = h("dl", { class: "facts-list" });
        this.left = h("div", { class: "left-out" });
        const full = h("div", { class: "full-check" });
        const card = (id, title, ...content) => h("section", { class: "card", "aria-labelledby": `h-${id}` }, h("h2", { id: `h-${id}` }, title), content);
        const use = card("use", "Share of the limit that rules", this.whose, this.bars);
        const cards = [use, this.required, this.pullIn, this.across, card("flows", "Flows", this.flows)];
        const last = [card("ledger", "Effects", this.ledger), card("cost", "Cost of this answer", this.cost, this.left)];
        state.judged = () => this.judged;
        this.compare = new Compare(state.judged);
        this.made = card("full", "As fabricated", full);
        holder.append(this.old, this.banner, this.problems, this.compare.card, ...cards, this.made, ...last, this.notes);
        this.ofPreview = [this.banner, ...cards, ...last].map((element) => new Shown(element));
        this.ofAnswer = [this.problems, this.notes].map((element) => new Shown(element));
        this.full = new JobView(full, {
            kind: "check", action: "Judge as fabricated", options: judging, reads: deviceText,
            intro: "The live verdict is of the drawing. This judges what each flow may make of it, at the corners of its ranges, and looks for changes that help.",
            auto: () => Boolean(state.preview?.verdict), humble: true,
            quiet: () => Math.min(Math.max(QUIET_MS, 1e3 * (this.full?.job?.seconds ?? 0)), QUIET_MOST_MS), // what takes long waits longer for the last change
            accept: (job) => job.result?.verdict !== undefined, render: (job, into) => this.#fabricated(job.result, into),
        });
        this.ofFull = [this.banner, use, this.required, this.pullIn, this.across].map((element) => new Shown(element, () => this.full.key));
        this.full.show(true);
        on("preview", () => this.show());
        on("answer", () => this.#answer());
        on("belong", () => this.#staleness());
        on("hinge", () => this.#chosen());
        on("pinned", () => state.preview?.verdict && this.#bars(state.preview.verdict));
        this.#wait();
    }

    #wait() {
        this.#decided(null);
        for (const box of [this.bars, this.flows]) box.replaceChildren(h("p", { class: "empty" }, "–"));
        for (const box of [this.required, this.pullIn, this.across]) box.hidden = true; // what was reached before says nothing of this device
        for (const box of [this.required, this.across]) box.replaceChildren(box.firstChild);
        if (state.preview?.status === "failed" && state.preview.marks?.length) return this.#cannot();
        this.banner.replaceChildren(h("p", { class: "empty" }, !state.preview ? "No verdict yet."
            : state.preview.status === "failed" ? "Nothing is judged yet: nothing moves what is drawn."
            : (state.preview.diagnostics ?? []).some((d) => d.severity === "error") ? "Nothing is judged: the mistakes below stand in the way."
                : "Nothing is judged: no hinge here has a limit. Motion, modes and assembly work all the same."));
    }

    /** Colour of the banner, and its word for programs; null: there is no decision. */
    #decided(decision, colour = decision === "failed" ? "reject" : decision) {
        for (const name of Object.keys(WORDS)) this.banner.classList.toggle(name, name === colour);
        this.banner.classList.remove("first");
        if (decision) this.banner.dataset.verdict = decision;
        else delete this.banner.dataset.verdict;
    }

    /** The layout cannot be made: the picture has its marks. */
    #cannot() {
        this.#decided("failed");
        const marks = state.preview.marks ?? [];
        this.banner.replaceChildren(
            h("div", { class: "decision" }, icon("cross"), h("strong", {}, was(), "Cannot be made"), h("span", { class: "as-drawn" }, "no verdict without a layout")),
            ...marks.slice(0, MOST_LINES).map((m, i) => h("p", { class: "mark-line", title: m.text }, h("span", { class: "mark-number" }, String(i + 1)), ` ${m.label}`, m.code ? h("span", { class: "code" }, ` ${m.code}`) : null)),
            marks.length > MOST_LINES ? h("p", {}, `and ${marks.length - MOST_LINES} more`) : "");
        this.last = "failed";
    }

    /** What could not be made is another input's, and of this one nothing is judged. */
    #noMore() {
        this.last = this.of = null; // the same answer shown again is composed again
        this.#decided(null);
        for (const shown of this.banner.shown) shown.take(null);
        this.banner.replaceChildren(h("p", { class: "empty" }, "Nothing is judged: what is said below comes first."));
    }

    /** Mistakes stand on top; what is only to be known stands last. */
    #answer() {
        for (const shown of this.ofAnswer) shown.take(state.answered);
        if (this.last === "failed" && state.preview !== null && state.answered === inputKey() && !isPresent()) this.#noMore();
        this.#staleness();
        const errors = state.diagnostics.filter((d) => d.severity === "error");
        const rest = state.diagnostics.filter((d) => d.severity !== "error");
        const empty = errors.length === 1 && errors[0].code === "FW-D052" && /^<mechanism> has no <body>/.test(errors[0].message);
        const words = empty ? "Nothing is drawn yet" : `${errors.length} ${errors.length === 1 ? "mistake" : "mistakes"}`;
        become(this.made, { hidden: empty }); // there is nothing that could be made
        become(this.problems, { hidden: errors.length === 0 });
        if (!alike(errors, this.listed)) this.#list(errors, empty, words);
        this.listed = errors;
        become(this.notes, { hidden: rest.length === 0 });
        if (!alike(rest, this.noted)) refill(this.notes, h("h2", {}, "Warnings and notes"), h("ul", { class: "diagnostics" }, rest.slice(0, MOST).map((d) => diagnosticItem(d))));
        this.noted = rest;
        const said = empty ? words : errors.length ? `${words}: ${errors[0].message}` : "";
        if (said && said !== this.said) announce(said);
        this.said = said;
    }

    #list(errors, empty, words) {
        const unheld = errors.length > 0 && errors.every((d) => d.code === "FW-D082" && / no hinge holds it yet/.test(d.message));
        const still = errors.length > 0 && errors.every((d) => d.code === "FW-D202") && !/<(scene|workspace)\b/.test(state.text);
        this.problems.classList.toggle("none-yet", empty || unheld || still); // an empty page is no mistake, nor is a link whose hinge comes next, nor what nothing moves yet
        if (still) {
            this.problems.replaceChildren(h("h2", {}, "Nothing moves it yet"), h("p", {}, "Choose Force, Cable or Electrodes, and draw where it acts; of a six-bar a Workspace box does, too. Then it is judged."),
                button("Draw", { class: "small", icon: "bar" }, () => emit("show-view", "draw")));
        } else if (unheld) {
            this.problems.replaceChildren(h("h2", {}, "Not held yet"), h("p", {}, "No hinge holds it yet. Choose Hinge, and click where a link turns on the ground."),
                button("Draw", { class: "small", icon: "bar" }, () => emit("show-view", "draw")),
                h("details", {}, h("summary", {}, `${words} in the description until then`), h("ul", { class: "diagnostics" }, errors.slice(0, MOST).map((d) => diagnosticItem(d)))));
        } else if (empty) this.problems.replaceChildren(h("h2", {}, words), h("p", {}, "Draw a link, hold it by a hinge, and pull it by a force or a cable; or write <body> and <revolute> in the text."), button("Draw", { class: "small", icon: "bar" }, () => emit("show-view", "draw")));
        else this.problems.replaceChildren(h("h2", {}, `${words} in ${whereOf(errors)}`), h("ul", { class: "diagnostics" }, errors.slice(0, MOST).map((d) => diagnosticItem(d))));
    }

    /** Why what is shown is old, in words, as soon as it looks old. */
    #staleness() {
        const key = inputKey();
        const why = state.preview === null || isPresent() ? "" : state.lost !== null ? "lost" : state.entered.size ? "entered"
            : state.cancelled === key ? "cancelled" : state.answered === key ? "none" : "late";
        const said = this.ofPreview.some((x) => x.element.classList.contains("old")) ? why : ""; // the banner itself may say nothing of it
        if (said === this.why) return;
        this.why = said;
        this.old.hidden = said === "";
        this.old.replaceChildren(h("div", {}, {
            "": [], late: ["Grey: of the former input. The present one is being computed."],
            lost: ["Grey: of the former input. Nothing is computed of the present one while the server does not answer."],
            entered: ["Grey: of the text without what is typed in a field. Enter takes it, Escape leaves it."],
            none: ["Grey: of the last input that had an answer. The present one has none."],
            cancelled: ["Grey: of the former input. Computing the present one was cancelled. ", button("Compute", { class: "small", id: "compute-again" }, askAgain)],
        }[said]));
    }

    show() {
        const full = this.#full();
        for (const shown of this.ofPreview) shown.take(state.previewOf);
        for (const shown of this.ofFull) shown.take(full ? this.full.of : null);
        const same = state.same !== null && state.same === this.of && full === this.ofJudged && this.packs === Object.keys(state.lab).length;
        Object.assign(this, { of: state.preview, ofJudged: full, packs: Object.keys(state.lab).length });
        if (same) return this.#cost(); // the same device, asked for in another way: all of it is there
        const v = state.preview.verdict;
        if (!v) {
            state.summary = null;
            this.#wait();
            this.#effects();
            return this.#cost();
        }
        const top = full ?? v; // the same document: as it will be made, or a first look at the drawing
        const lines = (state.summary = top.summary ?? []);
        // nothing is good about a device that bears its motion and that no flow can make: no green
        const unmade = top.verdict === "accept" && lines.some((line) => line.label === "cannot be made");
        const [bears, fine] = WORDS[top.verdict] ?? WORDS.inconclusive;
        const first = top.verdict === "accept" && !unmade && !full && state.preview.provisional; // a look at the drawing accepts nothing yet
        const [word, sign] = unmade ? [`${bears}, but cannot be made`, "cross"] : [first ? `${bears} as drawn` : bears, fine];
        const changed = this.last !== word;
        this.last = word;
        this.#decided(top.verdict, unmade ? "reject" : top.verdict);
        this.banner.classList.toggle("first", first);
        refill(this.banner,
            h("div", { class: "decision" }, icon(sign), h("strong", {}, was(), word), h("span", { class: "as-drawn", "data-of": full ? "check" : "preview", title: full ? "" : (state.preview.left_out ?? []).map((x) => x.sentence).join(" ") }, this.#basis(full))),
            ...lines.slice(0, MOST_LINES).map(topLine),
            lines.length > MOST_LINES ? h("details", {}, h("summary", {}, `${lines.length - MOST_LINES} more`), lines.slice(MOST_LINES).map(topLine)) : "",
            lines.length ? this.#more() : "");
        if (changed) announce(`${word}. ${lines.length ? `${lines[0].label}: ${lines[0].text}` : ""}`);
        this.#bars(v);
        this.#required(v, full);
        this.#across(full ?? v, !full && state.preview.provisional);
        this.#flows(v);
        this.#effects();
        this.#cost();
    }

    /** On a phone the decision leaves room for the picture, until somebody wants all of it. */
    #more() {
        const opened = () => this.banner.classList.contains("opened");
        const words = () => (opened() ? "Less" : "All of it");
        const more = h("button", { type: "button", class: "small banner-more", "aria-expanded": String(opened()), onclick: () => {
            this.banner.classList.toggle("opened");
            more.textContent = words();
            more.setAttribute("aria-expanded", String(opened()));
        } }, words());
        return more;
    }

    /** Requirements and probes: of the verdict where it is there, of the first look until then. */
    #required(v, full) {
        const judged = full ?? v;
        const look = !full && state.preview.provisional;
        const [asked, probes] = [requirementsOf(judged, look), probesOf(judged)];
        become(this.required, { hidden: asked.length + probes.length === 0 });
        const bound = (r) => [r.min === null ? "" : `at least ${si(r.min, r.unit, 4)}`, r.max === null ? "" : `at most ${si(r.max, r.unit, 4)}`].filter(Boolean).join(", ");
        const where = (x) => [x.scene ?? "at rest", judged.flows.length > 1 ? x.flow : null].filter(Boolean).join(", ");
        const word = (row) => (row.decision !== "inconclusive" ? WORDS[row.decision][0].toLowerCase() : row.at && row.r.verdict === "accept" ? "undecided, as some devices of its flow may not hold it" : "inconclusive");
        const said = (row) => (row.only ? `${si(row.band[0], row.r.unit, 4)} to ${si(row.band[1], row.r.unit, 4)}` : withBand(row.value, row.band, row.r.unit));
        refill(this.required, this.required.firstChild,
            look ? h("p", { class: "doc" }, "Of a first look at the drawing: it accepts nothing yet.") : "",
            h("dl", { class: "facts-list purpose" },
                asked.flatMap((row) => [h("dt", { title: row.why ?? "" }, `${row.r.probe} (${row.r.measure ?? row.r.kind}, ${where(row.r)})`),
                    h("dd", { class: row.first && row.decision === "accept" ? "first" : row.decision, title: row.at ? `with ${row.at}` : "" }, row.known ? `${said(row)} ${row.basis} \u2013 ${bound(row.r)}: ${word(row)}${row.first ? " as drawn" : ""}` : `not known: ${row.why ?? ""}`),
                    row.all ? h("dd", { class: "beside" }, `${si(row.all[0], row.r.unit, 4)} to ${si(row.all[1], row.r.unit, 4)} over all corners; ${withBand(row.r.value, row.r.band, row.r.unit)} as drawn`) : null]),
                probes.flatMap(({ x, band, known, zero }) => [h("dt", {}, `${x.id} (peak, ${where(x)})`),
                    h("dd", {}, known ? `${zero ? `0 ${x.unit}, within ${si(x.error, x.unit, 1)}` : withBand(x.peak, band, x.unit)} as drawn${look ? ", at a first look" : ""}` : whyUnknown(full ? { hinge_model: state.options.hinge_model } : state.preview))])));
    }

    /** What the terminal says of the ways out of the plane, and of how the device may be dried. */
    #across(v, look) {
        const named = (x, words) => `${v.flows.length > 1 && x.flow ? `${x.flow}: ` : ""}${words}`;
        const tips = (s) => (s.tips_at === null ? "" : `${s.scene}: does not tip below ${number(s.tips_at / (1 + s.tips_error), 4)} times its forces.`);
        const scene = (s) => [s.lowest_m === undefined ? "" : `${s.scene}: ${s.lowest_m === null ? "how far down is not known" : `down by up to ${si(-s.lowest_m, "m", 4)}, tilted by up to ${degrees(s.tilt_rad)}`}.`, tips(s)].filter(Boolean).join(" ");
        const out = (v.out_of_plane ?? []).flatMap((o) => {
            const [low] = o.modes;
            if (!o.known || !low) return o.scenes.length || !o.known ? [named(o, `Out of the plane: not known: ${o.why ?? ""}`)] : [];
            const stiff = o.stiffness_over_in_plane === null ? "" : ` Its stiffness is ${number(o.stiffness_over_in_plane)} of that in the plane.`;
            return [named(o, `As drawn it swings out of the plane from ${number(low.f_Hz, 4)} Hz on (${number(low.band_Hz[0], 4)} to ${number(low.band_Hz[1], 4)} Hz; ${low.body} ${low.kind === "tilt" ? "tilts" : "goes up and down"}).${stiff} Its weight lowers it by ${si(o.weight_sag_m, "m", 4)}, at most ${si(o.weight_sag_most_m, "m", 4)}, on a table; below it: ${o.below.words}.`), ...o.scenes.map(scene).filter(Boolean)];
        });
        const dry = (v.stiction ?? []).filter((s) => s.needs && s.drying.how !== "never wet").map((s) => named(s, `Drying: ${s.drying.words}; ${s.needs}.`));
        const pulled = (v.pull_in ?? []).filter((p) => p.voltage_V !== null).map((p) => named(p, `Pull-in in ${p.scene}: ${p.comb ? `comb drive ${p.comb}` : "the drives"} ${p.kind === "none" ? `is stable up to ${number(p.voltage_V, 4)} V` : `at ${number(p.voltage_V, 4)} V (${p.kind})`}, at least ${number(p.least_V, 4)} V, slowly; the scene asks for up to ${number(p.scene_voltage_V, 4)} V.`));
        const first = look ? h("p", { class: "doc" }, "Of a first look at the drawing: closer models of the hinges may change it.") : "";
        refill(this.pulls, first, pulled.map((x) => h("p", {}, x)));
        become(this.pullIn, { hidden: pulled.length === 0 });
        become(this.across, { hidden: out.length + dry.length === 0 });
        refill(this.across, this.across.firstChild, look ? first.cloneNode(true) : "", [...out, ...dry].map((x) => h("p", {}, x)));
    }

    /** The same for those who compare. */
    get judged() {
        return this.#full();
    }

    /** The full judgement, while it is of the present text. */
    #full() {
        return this.full?.job && !this.full.stale ? this.full.job.result ?? null : null;
    }

    /** What the banner speaks of. */
    #basis(full) {
        return `${this.#judgedAs(full)}${Object.keys(state.lab).length ? "; with your laboratory's numbers" : ""}`;
    }

    #judgedAs(full) {
        if (full) return full.flows.some((f) => f.as_fabricated) ? "as it will be made" : "as drawn";
        const p = state.preview;
        if (!p.provisional) return "as drawn";
        return p.left_out?.some((x) => x.what === "corners") ? "as drawn; corners not run yet" : "as drawn; a first look";
    }

    /** Of every hinge as made. */
    #made() {
        const full = this.#full();
        return full && { hinges: (flow) => new Map((full.flows.find((f) => f.id === flow) ?? full).hinges.filter((x) => x.as_fabricated).map((x) => [x.id, x.as_fabricated])) };
    }

    #bars(v) {
        setOptions(this.whose, [["", "worst of all flows"], ...v.flows.map((f) => [f.id, f.id])], state.flow);
        become(this.whose, { hidden: v.flows.length < 2 });
        state.flow = this.whose.value;
        const judged = this.#full() ?? v; // one number of a hinge everywhere: that of the banner
        const own = judged.flows.find((f) => f.id === state.flow);
        const list = own?.hinges ?? judged.hinges;
        if (!list.length) {
            this.bars.replaceChildren(h("p", { class: "empty" }, "No motion, no utilisation."));
            return;
        }
        const made = this.#made()?.hinges(state.flow);
        const worst = made?.size ? [...made].reduce((a, b) => (b[1].utilisation > a[1].utilisation ? b : a)) : null;
        const governing = !own ? judged.governing : worst ? { id: worst[0] } : own.governing; // all flows: that of the banner
        const most = Math.max(1.25, ...list.map((x) => Math.min(Math.max(x.utilisation ?? 0, made?.get(x.id)?.utilisation ?? 0), 4)));
        const then = pinnedShares(state.flow, made);
        const rows = list.map((hinge) => bar(hinge, most, governing, made?.get(hinge.id), then(hinge.id)));
        refill(this.bars,
            h("div", { class: "bar-axis", "aria-hidden": "true", style: { "--at": `${100 / most}%` } }, h("span", {}, "limit")),
            h("div", { class: "bar-list", style: { "--at": `${100 / most}%` } }, rows));
        this.#chosen();
    }

    #chosen() {
        for (const row of this.bars.querySelectorAll(".bar")) row.setAttribute("aria-pressed", String(row.dataset.hinge === state.hinge));
        const v = this.#full() ?? state.preview?.verdict;
        const hinge = (v?.flows.find((f) => f.id === state.flow) ?? v)?.hinges.find((x) => x.id === state.hinge);
        this.bars.querySelector(".bar-detail")?.remove();
        if (!hinge) return;
        const facts = [
            ["peak", `${degrees(hinge.peak_angle_rad)} ± ${degrees(hinge.angle_error_rad, 1)}`],
            ["limit", degrees(hinge.limit_angle_rad)],
            ["peak strain", percent(hinge.peak_strain)],
            ["strain limit", percent(hinge.strain_limit)],
            ["where", hinge.t_s === null ? "a required pose" : `${hinge.scene}, ${si(hinge.t_s, "s")}`],
            ["flow", hinge.flow],
            ["rules", hinge.criterion ?? "–"],
        ];
        const made = this.#made()?.hinges(state.flow).get(hinge.id);
        if (made) facts.push(["as made", `${percent(made.utilisation)}, ${made.corner}`]);
        this.bars.append(h("dl", { class: "facts-list bar-detail" }, facts.map(([k, x]) => [h("dt", {}, k), h("dd", {}, x)])));
    }

    #flows(v) {
        const list = state.preview.flows ?? v.flows ?? [];
        refill(this.flows, list.map((flow) => {
            const name = flow.name ?? flow.id;
            const own = (this.#full() ?? v).flows?.find((f) => f.id === name);
            const made = flow.manufacturable;
            const reasons = flow.reasons ?? [];
            const word = made === true ? "can be made" : made === false ? "cannot be made" : reasons.length ? "not guaranteed" : "not looked at";
            return h("details", { class: `flow ${own?.verdict ?? ""}` },
                h("summary", {}, h("span", { class: "flow-name" }, name), h("span", { class: `chip ${made === true ? "good" : made === false ? "bad" : "open"}` }, word)),
                own?.governing ? h("p", {}, asDrawn(own.governing)) : null,
                reasons.length ? h("ul", {}, reasons.map((r) => h("li", {}, r)))
                    : h("p", {}, made === true ? "Nothing speaks against it." : "Not computed here: the masks and the recipe say what the flow can make."));
        }));
    }

    #effects() {
        const list = state.preview.ledger ?? [];
        const called = list.filter((e) => e.called_for !== false);
        const rest = list.length - called.length;
        const last = called.length === 0 ? h("p", { class: "empty" }, state.preview.motion ? "This scene calls for no effect." : "Nothing was moved.")
            : rest > 0 ? h("p", { class: "doc" }, `${rest} other effects are not called for by this scene and cost nothing.`) : "";
        refill(this.ledger,
            called.map((e) => h("details", { class: e.active ? "effect active" : "effect" },
                h("summary", {}, h("span", { class: "effect-mark", "aria-hidden": "true" }, e.active ? "●" : "○"), h("span", {}, e.id ?? e.name),
                    h("span", { class: "bound", title: "most that leaving it out changes the peak" }, e.bound === null ? "no bound" : percent(e.bound, 2)),
                    h("span", { class: "state" }, e.active ? "computed" : "left out")),
                h("p", {}, reasonOf(e, state.preview) ?? ""))), last);
    }

    #cost() {
        const p = state.preview;
        const stats = p.motion?.stats ?? p.stats ?? {};
        const rows = [
            ["read and lay out", si(p.cost?.read_s ?? NaN, "s", 2)],
            ["judge and move", si((p.cost?.judge_s ?? NaN) + (p.cost?.simulate_s ?? 0), "s", 2)],
            ["steps", `${number(stats.steps, 6)}${stats.rejected ? `, ${stats.rejected} rejected` : ""}`],
            ["evaluations", number(stats.rhs, 7)],
            ["energy balance", number(stats.energy_error, 2)],
            ["constraints", number(stats.max_constraint_norm, 2)],
        ];
        refill(this.cost, rows.map(([k, x]) => [h("dt", {}, k), h("dd", {}, x)]));
        const left = [...(p.left_out ?? []).map((x) => `${x.sentence}${x.could_reject ? " It could reject." : ""}`), ...(p.not_drawn ?? []).map((x) => `${x}: acts, and no picture shows it.`)];
        refill(this.left, left.length ? h("details", {}, h("summary", {}, `${left.length} ${left.length === 1 ? "thing was" : "things were"} left out of the live answer`), h("ul", {}, left.map((x) => h("li", {}, x)))) : "");
    }

    #fabricated(v, into) {
        const rows = v.flows.map((flow) => {
            const made = flow.as_fabricated;
            const word = made ? made.verdict : flow.verdict;
            const worst = Math.max(...flow.hinges.map((x) => x.as_fabricated?.utilisation ?? x.utilisation ?? 0));
            return h("div", { class: `fab ${word}` },
                h("div", { class: "fab-head" }, icon(WORDS[word]?.[1] ?? "question"), h("strong", {}, WORDS[word]?.[0] ?? word), h("span", {}, flow.id)),
                h("p", {}, `Worst ${percent(worst)} of a limit${made?.corners ? `, ${made.corners.length} devices at the corners of ${made.inputs.length} ranges` : ""}.`),
                made?.reason ? h("p", {}, made.reason) : null, made?.control ? h("p", {}, made.control) : null);
        });
        const advice = (v.advice ?? []).map((a) => h("li", {}, a.text, " ", button("Apply", { class: "small" },
            () => edit(a.set, a.set.map((one) => `${one.path} is ${one.value}`).join(", ")))));
        into.replaceChildren(...rows,
            advice.length ? h("div", { class: "advice" }, h("h3", {}, "What would be accepted, the least change first"), h("ol", {}, advice)) : "",
            v.advice_note ? h("p", { class: "doc" }, v.advice_note) : "");
        this.show();
        emit("judged");
    }
}

/** Where mistakes are: the text of the page, the numbers of a laboratory, or another file that these name. */
function whereOf(errors) {
    const places = [["the description", (d) => d.in_text !== false || !d.file], ["the laboratory's numbers", (d) => d.in_text === false && d.file && Object.keys(state.lab).some((name) => d.file?.endsWith(name))]];
    const named = places.filter(([, is]) => errors.some(is)).map(([words]) => words);
    const others = [...new Set(errors.filter((d) => !places.some(([, is]) => is(d))).map((d) => d.file ?? "another file"))];
    return [...named, ...others].join(" and ");
}

/** Before the word of a decision; seen when that is old. */
const was = () => h("span", { class: "was" }, "Before: ");

/** Of how it is computed, what a verdict depends on. */
function judging() {
    const { accuracy, effects, hinge_model } = state.options;
    return Object.fromEntries(Object.entries({ accuracy, effects, hinge_model }).filter(([, v]) => v !== undefined));
}

/** A line of the top of the result; long ones of what is not guaranteed open on demand. */
function topLine(line) {
    const class_ = `top-line ${/^(rejected|cannot)/.test(line.label) ? "bad" : line.label === "do" ? "do" : ""}`;
    const [where, ...rest] = line.text.split(": ");
    if (!/^not guaranteed/.test(line.label) || rest.length === 0) return h("p", { class: class_ }, h("b", {}, `${line.label}: `), line.text);
    return h("details", { class: class_ }, h("summary", {}, h("b", {}, `${line.label} `), where), h("p", {}, rest.join(": ")));
}

/** Of one flow, whose drawing alone was looked at. */
function asDrawn(g) {
    const where = g.t_s === null || g.t_s === undefined ? "at a required pose" : `in ${g.scene} at ${si(g.t_s, "s")}`;
    const band = g.utilisation_band ? ` (${number(g.utilisation_band[0] * 100, 2)} to ${number(g.utilisation_band[1] * 100, 2)} %)` : "";
    return `As drawn hinge ${g.id} uses ${percent(g.utilisation)}${band} of its ${g.criterion ?? "elastic"} limit, ${where}.`;
}

/** Shares of the pinned version, as made where that is shown of this one: (hinge) -> share, or undefined. */
function pinnedShares(flow, made) {
    const { pinned } = state;
    if (!pinned?.preview?.verdict) return () => undefined;
    const source = made?.size && pinned.made ? pinned.made : made?.size ? null : pinned.preview.verdict;
    const own = source?.flows?.find((f) => f.id === flow) ?? source;
    return (id) => {
        const x = own?.hinges?.find((y) => y.id === id);
        return made?.size ? x?.as_fabricated?.utilisation : x?.utilisation;
    };
}

function bar(hinge, most, governing, made, then) {
    const rules = made ?? hinge; // as it will be made, where that is known: what the banner says
    const use = rules.utilisation ?? 0;
    const [low, high] = rules.utilisation_band ?? [use, use];
    const shown = percent(use);
    const drawn = made ? `, ${percent(hinge.utilisation)} as drawn` : "";
    const x = (v) => `${(100 * Math.min(Math.max(v, 0), most)) / most}%`;
    return h("button", {
        type: "button", class: `bar${use > 1 ? " over" : ""}${governing?.id === hinge.id ? " governs" : ""}`, "data-hinge": hinge.id, "aria-pressed": "false",
        "aria-label": `Hinge ${hinge.id}: ${shown} of its limit${made ? " as made" : ""}${drawn}${then === undefined ? "" : `, ${percent(then)} in ${state.pinned.name}`}${governing?.id === hinge.id ? ", governs" : ""}`, onclick: (e) => lookAt(e.currentTarget.dataset.hinge),
    },
    h("span", { class: "bar-id", "aria-hidden": "true" }, hinge.id), " ", // the button's name says both, in this order
    h("span", { class: "bar-track" },
        h("span", { class: "bar-fill", style: { width: x(use) } }),
        h("span", { class: "bar-band", style: { left: x(low), width: `calc(${x(high)} - ${x(low)})` } }),
        then === undefined ? null : h("span", { class: "bar-then", title: `${state.pinned.name}: ${percent(then)}`, style: { left: x(then) } }),
        made ? h("span", { class: "bar-drawn", title: `as drawn: ${percent(hinge.utilisation)}`, style: { left: x(hinge.utilisation ?? 0) } }) : null),
    h("span", { class: "bar-value", "aria-hidden": "true", title: shown }, !Number.isFinite(use) ? "\u221e" : percent(use, use >= 1e5 ? 2 : 3)));
}

function jumpTo({ currentTarget: { dataset } }) {
    document.dispatchEvent(new CustomEvent("jump", { detail: { line: Number(dataset.line), column: Number(dataset.column) } }));
}

export function diagnosticItem(d, jump = true) {
    const here = d.in_text !== false;
    const place = !d.line ? "" : here ? `${d.line}:${d.column}` : (d.file ?? "").split("/").at(-1);
    const text = [place ? h("span", { class: "place" }, place) : null, h("span", { class: "what" }, d.message), d.code ? h("span", { class: "code" }, d.code) : null];
    return h("li", { class: d.severity },
        jump && d.line && here ? h("button", { type: "button", class: "jump", "data-line": d.line, "data-column": d.column, onclick: jumpTo }, text) : h("div", { class: "jump" }, text),
        d.explain ? h("details", { class: "explain" }, h("summary", {}, d.title ?? "more"), h("p", {}, d.explain)) : null);
}
