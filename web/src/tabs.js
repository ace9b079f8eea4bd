// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs as the ARIA pattern has them: one tab stop, arrows move, the panel is named by its tab.
import { h } from "./dom.js";

/** tabs: [{id, label, panel}]; returns {bar, select(id), current}. */
export function makeTabs(label, tabs, { onselect } = {}) {
    let current = null;
    const buttons = tabs.map(({ id, label: text, panel }) => {
        panel.id = `panel-${id}`;
        panel.setAttribute("role", "tabpanel");
        panel.setAttribute("aria-labelledby", `tab-${id}`);
        panel.classList.add("panel");
        panel.hidden = true;
        return h("button", {
            type: "button", id: `tab-${id}`, role: "tab", "aria-selected": "false", "aria-controls": panel.id,
            tabIndex: -1, class: "tab", onclick: () => select(id),
        }, text);
    });
    const bar = h("div", { role: "tablist", class: "tabs", "aria-label": label, onkeydown: key }, buttons);

    function key(event) {
        const at = tabs.findIndex((t) => t.id === current);
        const next = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1 }[event.key];
        if (next === undefined) return;
        event.preventDefault();
        const to = (next + tabs.length) % tabs.length;
        select(tabs[to].id);
        buttons[to].focus();
    }

    /** The chosen one is seen, where there is no room for all of them. */
    function inSight(tab) {
        const [from, to] = [tab.offsetLeft - bar.offsetLeft, tab.offsetLeft - bar.offsetLeft + tab.offsetWidth];
        if (from < bar.scrollLeft) bar.scrollLeft = from;
        else if (to > bar.scrollLeft + bar.clientWidth) bar.scrollLeft = to - bar.clientWidth;
    }

    function select(id) {
        if (id === current) return;
        current = id;
        tabs.forEach((tab, i) => {
            const chosen = tab.id === id;
            buttons[i].setAttribute("aria-selected", String(chosen));
            buttons[i].tabIndex = chosen ? 0 : -1;
            tab.panel.hidden = !chosen;
            if (chosen) inSight(buttons[i]);
        });
        onselect?.(id);
    }
    new ResizeObserver(() => current && inSight(buttons[tabs.findIndex((t) => t.id === current)])).observe(bar);
    return { bar, select, has: (id) => tabs.some((t) => t.id === id), get current() { return current; } };
}
