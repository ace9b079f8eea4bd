// SPDX-License-Identifier: GPL-3.0-or-later
// The card beside the verdict that sets the present numbers beside those of the pinned version.
import { Shown } from "./belong.js";
import { become, button, h } from "./dom.js";
import { beside, change, numbersOf } from "./numbers.js";
import { on, state } from "./store.js";
import { pin } from "./versions.js";

const WORDS = { accept: "accepted", reject: "rejected", inconclusive: "inconclusive" };

export class Compare {
    /** judged(): the full judgement of the present text, or null; of(): the input that it is of */
    constructor(judged) {
        this.judged = judged;
        this.title = h("h2", { id: "h-compare" });
        this.body = h("div", { class: "compare", tabIndex: 0, role: "group", "aria-labelledby": "h-compare" }); // it scrolls; keys must reach it
        this.all = h("input", { type: "checkbox" });
        this.all.addEventListener("change", () => this.show());
        this.card = h("section", { class: "card", "aria-labelledby": "h-compare", id: "compare", hidden: true }, this.title, this.body,
            h("div", { class: "row" }, h("label", { class: "option" }, this.all, h("span", {}, "what is equal, too")), button("Compare no more", { class: "small" }, () => pin(null))));
        this.ofPreview = new Shown(this.card);
        for (const event of ["preview", "pinned", "judged"]) on(event, () => this.show());
    }

    show() {
        const { pinned, preview } = state;
        become(this.card, { hidden: !pinned });
        if (!pinned) return this.ofPreview.take(null);
        this.title.textContent = `Compared with ${pinned.name}`;
        this.ofPreview.take(state.previewOf);
        if (!pinned.preview || !preview) {
            this.body.replaceChildren(h("p", { class: "empty" }, pinned.why ? `${pinned.name} has no answer: ${pinned.why}` : "Being computed."));
            return;
        }
        const made = pinned.made ? this.judged() : null; // as made beside as made, or neither
        const rows = beside(numbersOf(preview, made), numbersOf(pinned.preview, made ? pinned.made : null));
        const shown = rows.filter((r) => this.all.checked || !r.same);
        const [then, now] = [pinned.preview, preview].map((p) => WORDS[p.verdict?.verdict] ?? "not judged");
        const groups = grouped(shown);
        this.body.replaceChildren(
            h("p", { class: "compare-word" }, then === now ? `As drawn both are ${now}.` : `As drawn it was ${then}, and is ${now}.`),
            shown.length ? h("table", { class: "plain compare-table" },
                h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "what"), h("th", { scope: "col" }, "then"), h("th", { scope: "col" }, "now"), h("th", { scope: "col" }, "change"))),
                [...groups].map(([group, list]) => h("tbody", {}, h("tr", {}, h("th", { scope: "colgroup", colSpan: 4 }, group)),
                    list.map((r) => h("tr", { class: r.same ? "same" : "", "data-what": `${r.group}: ${r.label}` }, h("td", {}, r.label), ...[r.then, r.now].map((v) => h("td", { class: "n" }, v === undefined ? "\u2013" : r.format(v))), h("td", { class: "n change" }, change(r)))))))
                : h("p", { class: "empty" }, "No number that is shown differs."),
            h("p", { class: "doc" }, `${rows.filter((r) => !r.same).length} of ${rows.length} numbers differ. Dashed in the pictures: ${pinned.name}.${made ? "" : " As made is not compared: it is known of one of the two at most."}`));
    }
}

function grouped(list) {
    const out = new Map();
    for (const r of list) out.set(r.group, [...(out.get(r.group) ?? []), r]);
    return out;
}
