// SPDX-License-Identifier: GPL-3.0-or-later
// The sign that something is computed, from OLD_MS on, with its time and a button that ends it.
import { OLD_MS, underWay } from "./belong.js";
import { become, button, h } from "./dom.js";
import { on } from "./store.js";

const TICK_MS = 100;

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
