// SPDX-License-Identifier: GPL-3.0-or-later
// The sign that something is computed, from OLD_MS on, with its time and a button that ends it. Where all that is under way
// has a row of its own on the screen (row(), with its own button) the sign is marked: on a phone it is then not repeated.
import { OLD_MS, underWay } from "./belong.js";
import { become, button, h } from "./dom.js";
import { on } from "./store.js";

const TICK_MS = 100;

const onScreen = (element) => {
    const { top, bottom, height } = element.getBoundingClientRect();
    return height > 0 && top >= 0 && bottom <= innerHeight;
};

export function busySign() {
    const words = h("span", {});
    const box = h("div", { class: "busy-sign", id: "busy", role: "status", hidden: true }, h("span", { class: "busy-dot", "aria-hidden": "true" }), words,
        button("Cancel", { icon: "close", class: "small", id: "busy-cancel" }, () => {
            for (const work of underWay()) work.cancel?.();
        }));
    const cancel = box.querySelector("button");
    let timer = 0;
    let said = "";
    const show = () => {
        clearTimeout(timer);
        const list = underWay();
        const first = list.reduce((a, b) => (!a || b.since < a.since ? b : a), null);
        const age = first ? performance.now() - first.since : 0;
        become(box, { hidden: !first || age < OLD_MS });
        const told = list.length > 0 && list.every((x) => x.row && onScreen(x.row()));
        if (told !== box.classList.contains("told")) box.classList.toggle("told", told);
        become(cancel, { hidden: !list.some((x) => x.cancel) });
        if (!box.hidden) {
            const now = `${first.words} · ${(age / 1e3).toFixed(age < 1e4 ? 1 : 0)} s`;
            if (now !== said) words.textContent = said = now;
        }
        if (first) timer = setTimeout(show, box.hidden ? OLD_MS - age + 1 : TICK_MS);
    };
    on("working", show);
    return box;
}
