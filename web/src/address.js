// SPDX-License-Identifier: GPL-3.0-or-later
// How it is looked at, in the address behind #: the view, the time, the options. So a reload, a bookmark and the browser's
// own way back find it again; the design itself is in the file and in the draft, never here.
import { setOptionsTogether } from "./design.js";
import { on, state } from "./store.js";

const WRITE_MS = 300; // that nothing changes before it is written: a motion that plays would else write at every frame
const LISTED = { method: "methods", integrator: "integrators", stabilise: "stabilisations", hinge_model: "hinge_models" };
const NUMBERS = { rtol: "rtol", accuracy: "accuracy" };
const nameOf = (x) => (typeof x === "string" ? x : x.name);

/** Is this a value that the option may have? What somebody has typed into an address is not believed. */
function allowed(name, value) {
    const { table } = state;
    if (LISTED[name]) return (table[LISTED[name]] ?? []).some((x) => nameOf(x) === value);
    if (NUMBERS[name]) {
        const { minimum, maximum } = table.limits[NUMBERS[name]];
        return Number(value) >= minimum && Number(value) <= maximum;
    }
    if (name === "effects") return value === "all" || value === "none";
    return name === "scene" && value.length <= 200;
}

const OPTIONS = ["scene", ...Object.keys(LISTED), ...Object.keys(NUMBERS), "effects"];

/** parts: of the page, with tabs, editTabs and motion; called once, after the text is there. */
export function startAddress(parts) {
    let timer = 0;
    let wanted = null; // the time, until there is a motion

    const present = () => {
        const q = new URLSearchParams();
        if (parts.tabs.current !== "motion") q.set("view", parts.tabs.current);
        if (parts.editTabs.current !== "form") q.set("text", parts.editTabs.current);
        for (const name of OPTIONS) if (state.options[name] !== undefined) q.set(name, state.options[name]);
        if (wanted !== null) q.set("t", wanted);
        else if (parts.motion.seen) q.set("t", Number(parts.motion.time.toPrecision(4)));
        const text = q.toString();
        return text ? `#${text}` : "";
    };

    function read() {
        const q = new URLSearchParams(location.hash.slice(1));
        const options = Object.fromEntries(OPTIONS.map((name) => [name, q.has(name) && allowed(name, q.get(name)) ? q.get(name) : ""]));
        const scenes = (parts.form.root?.children ?? []).filter((e) => e.name === "scene").map((e) => e.attributes.get("name")?.value);
        if (options.scene && !scenes.includes(options.scene)) options.scene = "";
        if (OPTIONS.some((name) => (state.options[name] ?? "") !== options[name])) setOptionsTogether(options);
        const view = q.get("view") ?? "motion";
        if (parts.tabs.has(view)) parts.tabs.select(view);
        const text = q.get("text") ?? "form";
        if (parts.editTabs.has(text)) parts.editTabs.select(text);
        wanted = q.has("t") && Number.isFinite(Number(q.get("t"))) ? Number(q.get("t")) : null;
        seek();
    }

    function seek() {
        if (wanted === null || !parts.motion.t) return;
        parts.motion.seen = true;
        parts.motion.seek(wanted, true);
        wanted = null;
    }

    function write() {
        clearTimeout(timer);
        timer = setTimeout(() => {
            const text = present();
            if (text !== location.hash) history.replaceState(null, "", text || location.pathname);
        }, WRITE_MS);
    }

    if (location.hash) read();
    for (const event of ["preview", "view"]) on(event, () => setTimeout(seek)); // behind the view itself
    for (const event of ["options", "view", "time"]) on(event, write);
    addEventListener("hashchange", read);
}
