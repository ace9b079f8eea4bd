// SPDX-License-Identifier: GPL-3.0-or-later
// What a slider says where its value leads to a device that cannot be drawn, cannot be made or is rejected: why, and from
// which value on it can. Values are those of Explore: the engine of the studies judges them as the live verdict does.
import { post } from "./api.js";
import { begin, inputKey, mayChange, Shown } from "./belong.js";
import { edit, lab } from "./design.js";
import { button, h } from "./dom.js";
import { optionsOf, textOf } from "./exploring.js";
import { on, state } from "./store.js";

const QUIET_MS = 300; // that nothing changes before values are tried
const PARTS = 8; // of a range, and of what lies between a value that works and one that does not
const ROUNDS = 3;
const FINEST = 600; // parts of a range to which a value is found, a little more than a slider has

/** The best that any value comes to, and how it is said. */
const LEVELS = [
    [(s) => s === "accept", (from) => `As drawn, at a first look, it is accepted ${from}. `],
    [(s) => s === "inconclusive", (from) => `It is inconclusive ${from}, and accepted at no value that was tried. `],
    [(s) => s === "reject" || s === "run", (from) => `It can be drawn and moved ${from}, and is accepted at no value that was tried. `],
];

/** Why the present input is no device that is accepted; null: it is one, or nobody knows yet. */
function whyNot() {
    if (state.answered !== inputKey()) return null;
    const p = state.preview;
    if (state.previewOf !== state.answered || p.status === "failed")
        return state.diagnostics.find((d) => d.severity === "error")?.message ?? p?.marks?.[0]?.text ?? "this cannot be computed";
    const lines = p.verdict?.summary ?? [];
    const top = lines.find((line) => ["rejected because", "cannot be made"].includes(line.label));
    if (top) return `${top.label === "cannot be made" ? "cannot be made: " : ""}${top.text}`;
    return p.verdict?.verdict === "reject" ? lines[0]?.text ?? "it is rejected" : null; // by a hinge alone, which is the first line
}

/** Values that are tried, at the same distances, on a grid that numbers with few digits are of. */
function between(a, b, grid) {
    const list = Array.from({ length: PARTS + 1 }, (_, i) => a + ((b - a) * i) / PARTS);
    return list.map((x) => Number((Math.round(x / grid) * grid).toPrecision(9)));
}

export class Works {
    /** of(): {name, path, text (as it is written), value, unit, min, max (in the unit of the ends), box} of the slider that was moved last; null: none was */
    constructor(of) {
        this.of = of;
        this.timer = 0;
        this.stop = null; // of the values that are being tried
        this.box = null; // that says something
        on("answer", () => this.#look());
        on("change", () => this.#end());
        mayChange(() => this.timer !== 0 || this.stop !== null);
    }

    #end() {
        clearTimeout(this.timer);
        this.timer = 0;
        this.stop?.abort();
        this.stop = null;
    }

    #look() {
        if (state.answered !== inputKey()) return; // a newer one is on its way
        this.#end();
        const slider = this.of();
        const why = slider && whyNot();
        if (this.box && this.box !== (why ? slider.box : null)) this.#say(this.box, []);
        this.box = why ? slider.box : null;
        if (!why) return;
        this.#say(slider.box, [h("p", { title: why }, h("strong", {}, `At ${slider.text}: `), why), h("p", { class: "busy-words" }, "Looking for the nearest value that works…")]);
        this.timer = setTimeout(() => this.#search(slider), QUIET_MS);
    }

    #say(box, words) {
        box.shown ?? new Shown(box);
        box.hidden = words.length === 0;
        box.replaceChildren(...words);
        box.shown[0].take(words.length ? state.answered : null);
    }

    /** value -> state of its point, for those of the list that are not there yet. Where the text's own value is refused, no
     *  study begins: then another one holds its place. */
    async #ask(slider, list, tried, signal) {
        const { name, unit, min, max } = slider;
        const some = [...new Set(list)].filter((x) => x >= min && x <= max && !tried.has(x));
        if (!some.length) return;
        for (const place of [null, max, (min + max) / 2, min]) {
            const set = { ...state.set, ...(place === null ? {} : { [name]: textOf(place, unit) }) };
            if (place === null) delete set[name];
            const answer = await post("/api/explore", { text: state.text, set, ...lab(), options: optionsOf("quick"), inputs: [name],
                values: ["governing.utilisation"], points: some.map((x) => [textOf(x, unit)]) }, { signal });
            if (answer.status !== "ok") continue;
            answer.points.forEach((p, i) => tried.set(some[i], p.state));
            return;
        }
        throw new Error("the text itself is wrong");
    }

    async #search(slider) {
        this.timer = 0;
        const stop = (this.stop = new AbortController());
        const done = begin({ words: `Looking for values of ${slider.name} that work`, cancel: () => this.#end() });
        const found = slider.box.lastChild;
        try {
            const words = await this.#nearest(slider, stop.signal);
            if (!stop.signal.aborted) found.replaceChildren(...words);
        } catch (error) {
            if (!stop.signal.aborted) found.replaceChildren(error.lost ? "" : "Which value works is not known: other mistakes stand in the way.");
        } finally {
            found.classList.remove("busy-words");
            if (stop.signal.aborted) found.replaceChildren();
            if (this.stop === stop) this.stop = null;
            done();
        }
    }

    async #nearest(slider, signal) {
        const { value, unit, min, max } = slider;
        const grid = 10 ** Math.floor(Math.log10((max - min) / FINEST));
        const tried = new Map([[value, "here"]]);
        await this.#ask(slider, [min, ...between(min, max, grid), max], tried, signal);
        const [works, words] = LEVELS.find(([is]) => [...tried.values()].some(is)) ?? LEVELS[0];
        const nearest = () => [...tried].filter(([, s]) => works(s)).map(([x]) => x).sort((a, b) => Math.abs(a - value) - Math.abs(b - value))[0];
        if (nearest() === undefined) return [`No value from ${textOf(min, unit)} to ${textOf(max, unit)} was found that works while everything else stays as it is.`];
        for (let k = 1; k < ROUNDS; k++) {
            const good = nearest();
            const bad = [...tried.keys()].filter((x) => (x - value) * (good - value) >= 0 && Math.abs(x - value) < Math.abs(good - value)).sort((a, b) => Math.abs(a - good) - Math.abs(b - good))[0];
            await this.#ask(slider, between(bad ?? value, good, grid), tried, signal);
        }
        const good = nearest();
        const up = good > value;
        const beyond = [...tried].filter(([x]) => (up ? x > good : x < good));
        const from = beyond.every(([, s]) => works(s)) ? (up ? `from ${textOf(good, unit)} on` : `up to ${textOf(good, unit)}`) : `at ${textOf(good, unit)}`;
        const title = `${tried.size - 1} values between ${textOf(min, unit)} and ${textOf(max, unit)} were judged as drawn`;
        return [h("span", { title }, words(from)),
            button(`Use ${textOf(good, unit)}`, { class: "small" }, () => edit([{ path: `${slider.path}/@value`, value: textOf(good, unit) }], `${slider.name} is ${textOf(good, unit)}`))];
    }
}
