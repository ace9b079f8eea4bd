// SPDX-License-Identifier: GPL-3.0-or-later
// The form: the tree of the text's elements, each with the attributes that the description table has
// for it. It holds nothing: every change goes to the text, and the form is made from the text again.
import { adding, idsOf, mayAdd } from "./adding.js";
import { mayChange } from "./belong.js";
import { edit, hold, isPresent, letGo } from "./design.js";
import { become, button, h, put, say, setOptions } from "./dom.js";
import { DRAWN, enter, leave, rebuild, show } from "./entering.js";
import { endOf, unitSizes } from "./exploring.js";
import { number, splitQuantity } from "./format.js";
import { parse, walk } from "./model.js";
import { emit, on, state } from "./store.js";
import { Works } from "./works.js";

const resting = new Set(); // timers of sliders whose keys rest
const rested = (timer) => {
    clearTimeout(timer);
    resting.delete(timer);
};
mayChange(() => resting.size > 0);
const KEY_REST_MS = 600; // without a key, after which what a slider holds is let go
let nextId = 0;

export class Form {
    constructor(holder) {
        this.opened = new Set();
        this.fields = new Map(); // path of an attribute -> {refresh(element)}
        this.sliders = h("div", { class: "sliders" });
        this.tree = h("div", { class: "tree" });
        holder.append(
            h("section", { class: "card", "aria-label": "Parameters" }, h("h2", {}, "Parameters"), this.sliders),
            h("section", { class: "card", "aria-label": "Elements" }, h("h2", {}, "Description"), this.tree));
        this.moved = null; // of the slider that was moved last: what Works asks for
        new Works(() => this.moved?.() ?? null);
        on("text", () => this.update());
        on("belong", () => this.#bounds());
    }

    start(table) {
        this.elements = table.elements;
        this.rows = new Map(table.elements.toReversed().map((e) => [e.name, e])); // of several with one name the first
        this.update();
    }

    /** Name of the device, as the text has it. */
    get name() {
        return this.root?.attributes.get("name")?.value ?? "";
    }

    /** Elements of one name have a row for each parent; without a parent, or in another one, the first. */
    row(name, parent) {
        return this.elements.find((e) => e.name === name && mayStandIn(e, parent)) ?? this.rows.get(name) ?? { name, attributes: [], sentence: "" };
    }

    update() {
        if (!this.rows) return;
        const root = parse(state.text, (name) => this.rows.get(name)?.key ?? null);
        if (!root) return; // the last good form stays while the text is no XML
        const shape = JSON.stringify([...walk(root)].map((e) => [e.path, [...e.attributes.keys()]]));
        this.root = root;
        this.places = new Map([...walk(root)].map((e) => [e.path, e]));
        if (shape !== this.shape) {
            this.shape = shape;
            rebuild(() => this.#build());
            this.#gone();
        } else for (const field of this.fields.values()) field.refresh();
    }

    /** What was entered for an element that is there no more. */
    #gone() {
        for (const [path, value] of state.entered) {
            if (path.startsWith(DRAWN) || this.places.has(path.replace(/\/@[^@]*$/, ""))) continue;
            leave(path);
            emit("notice", { kind: "warn", text: `What was entered is gone with its element: ${value}.` });
        }
    }

    #build() {
        const focus = document.activeElement?.closest?.("[data-path]")?.dataset.path;
        this.fields.clear();
        this.#parameters();
        this.tree.replaceChildren(this.#element(this.root, true));
        if (focus) document.querySelector(`[data-path="${CSS.escape(focus)}"]`)?.focus({ preventScroll: true });
    }

    // ---- parameters ----

    #parameters() {
        const list = this.root.children.filter((c) => c.name === "parameter");
        this.sliders.replaceChildren(...list.map((p) => this.#slider(p)));
        if (!list.length) this.sliders.append(h("p", { class: "empty" }, "This file declares no parameter. One with min and max becomes a slider: <parameter name=\"t\" value=\"10 um\" min=\"5 um\" max=\"20 um\"/>."));
        this.#bounds();
    }

    #slider(element) {
        const id = `p${++nextId}`;
        const path = element.path;
        const name = () => this.places.get(path)?.attributes.get("name")?.value ?? "";
        const text = (a) => this.places.get(path)?.attributes.get(a)?.value;
        const label = h("label", { for: `${id}-text` }, name());
        const value = h("input", { id: `${id}-text`, class: "value", autocomplete: "off", spellcheck: false, "data-path": `${path}/@value`, "aria-describedby": `${id}-doc` });
        const range = h("input", { type: "range", "aria-label": `${name()}, slider`, "data-parameter": name(), "aria-describedby": `${id}-doc` });
        const doc = h("p", { id: `${id}-doc`, class: "doc" });
        const ends = h("div", { class: "ends", "aria-hidden": "true" }, h("span"), h("span"));
        let unit = "";
        const shown = () => `${Number(Number(range.value).toPrecision(12))}${unit ? ` ${unit}` : ""}`;
        const wrong = h("div", { class: "slider-wrong", role: "status", hidden: true });
        const now = () => {
            const written = state.set[name()] ?? text("value") ?? "";
            const v = endOf(written, unit, unitSizes(state.table)); // somebody may have written it in another unit than its ends
            return Number.isFinite(v) && !range.hidden && wrong.isConnected ? { name: name(), path, text: written, value: v, unit, min: Number(range.min), max: Number(range.max), box: wrong } : null;
        };
        // A browser tells of no change where the value comes back to what it was, and of nothing where the slider is gone
        // meanwhile: what is held ends with the pointer or the key, too.
        // A run of keys is one step of the history: what it holds is let go when no key comes for a while.
        let held = null; // {name, value, ends}
        let byKey = false;
        let rest = 0;
        const release = (event) => {
            rested(rest);
            rest = 0;
            if (!held) return;
            if (byKey && ["change", "keyup"].includes(event?.type)) {
                rest = setTimeout(release, KEY_REST_MS);
                resting.add(rest);
                return;
            }
            const { name: of, value: last, ends: listening } = held;
            held = null;
            listening.abort();
            letGo(of, last);
        };
        range.addEventListener("keydown", () => (byKey = true));
        range.addEventListener("pointerdown", () => (byKey = false));
        range.addEventListener("input", () => {
            leave(`${path}/@value`);
            value.value = shown();
            range.setAttribute("aria-valuetext", shown());
            if (!held) {
                held = { name: name(), ends: new AbortController() };
                for (const event of ["pointerup", "pointercancel", "keyup", "blur"]) addEventListener(event, release, { signal: held.ends.signal, capture: true });
            }
            rested(rest);
            held.value = shown();
            this.moved = now;
            hold(held.name, held.value);
        });
        range.addEventListener("change", release);
        enter(value, `${path}/@value`, () => text("value") ?? "", (v) => {
            this.moved = now;
            return edit([{ path: `${path}/@value`, value: v }], `${name()} is ${v}`);
        });
        const holder = h("div", { class: "slider", "data-name": name() }, h("div", { class: "slider-head" }, label, value), range, ends, wrong, doc);
        const refresh = () => {
            say(label, name());
            say(doc, text("doc") ?? "");
            const present = state.set[name()] ?? text("value") ?? "";
            show(value, `${path}/@value`, present);
            const b = bounds(name(), present, text("min"), text("max"));
            for (const element of [range, ends]) become(element, { hidden: !b });
            put(holder, { "data-of": !b?.computed ? "nothing" : isPresent() ? "present" : "former" });
            if (!b) return;
            unit = b.unit;
            put(range, { min: b.min, max: b.max, step: b.step, "aria-valuetext": present });
            if (!(name() in state.set)) become(range, { value: String(b.value) });
            say(ends.firstChild, `${number(b.min, 4)} ${unit}`);
            say(ends.lastChild, `${number(b.max, 4)} ${unit}`);
        };
        this.fields.set(`${path} slider`, { refresh });
        refresh();
        return holder;
    }

    #bounds() {
        for (const [key, field] of this.fields) if (key.endsWith(" slider")) field.refresh();
    }

    // ---- elements ----

    #element(element, top = false, parent = "") {
        const row = this.row(element.name, parent);
        const path = element.path;
        const body = h("div", { class: "element-body" });
        const id = h("span", { class: "element-id" });
        const note = h("span", { class: "element-note" });
        const refresh = () => {
            const now = this.places.get(path) ?? element;
            say(id, title(now));
            say(note, summary(now));
        };
        this.fields.set(`${path} summary`, { refresh });
        refresh();
        const details = h("details", { class: "element", open: top || this.opened.has(path) },
            h("summary", {}, h("span", { class: "element-name" }, element.name), id, note), body);
        let filled = false;
        const fillIt = () => {
            if (filled) return;
            filled = true;
            body.append(...this.#attributes(element, row), ...this.#children(element), this.#tools(element, row, top));
        };
        details.addEventListener("toggle", () => {
            if (details.open) {
                fillIt();
                this.opened.add(path);
            } else this.opened.delete(path);
        });
        if (details.open) fillIt();
        return details;
    }

    #children(element) {
        return element.children.filter((c) => !(c.name === "parameter" && element === this.root)).map((c) => this.#element(c, false, element.name));
    }

    #attributes(element, row) {
        const present = row.attributes.filter((a) => element.attributes.has(a.name));
        const absent = row.attributes.filter((a) => !element.attributes.has(a.name));
        const out = [h("p", { class: "sentence" }, row.sentence), ...present.map((a) => this.#field(element.path, a))];
        if (absent.length) {
            const mine = `${element.path} more`; // the form is made anew when one of them is written: what was open stays so
            const more = h("details", { class: "more", open: this.opened.has(mine) }, h("summary", {}, `${absent.length} more ${absent.length === 1 ? "attribute" : "attributes"}`));
            const fill = () => more.childElementCount === 1 && more.append(...absent.map((a) => this.#field(element.path, a)));
            if (more.open) fill();
            more.addEventListener("toggle", () => {
                this.opened[more.open ? "add" : "delete"](mine);
                if (more.open) fill();
            });
            out.push(more);
        }
        return out;
    }

    #field(path, attribute) {
        const id = `f${++nextId}`;
        const full = `${path}/@${attribute.name}`;
        const now = () => this.places.get(path)?.attributes.get(attribute.name)?.value;
        const change = (v) => edit([{ path: full, value: v === "" && !attribute.required ? null : v }], `${attribute.name} is ${v}`);
        const input = attribute.choices?.length ? choice(id, attribute, change) : h("input", {
            id, autocomplete: "off", spellcheck: false, placeholder: attribute.default ?? "", "data-path": full, "aria-describedby": `${id}-help`,
        });
        if (!attribute.choices?.length) enter(input, full, () => now() ?? "", change);
        const names = attribute.refers_to ? this.#suggest(input, `${id}-names`, attribute) : null;
        input.required = attribute.required;
        const refresh = () => {
            if (input.tagName === "SELECT") become(input, { value: now() ?? "" });
            else show(input, full, now() ?? "");
        };
        this.fields.set(full, { refresh });
        refresh();
        return h("div", { class: "field" },
            h("label", { for: id }, attribute.name, attribute.required ? h("span", { class: "required", title: "required" }, "*") : null),
            input, names,
            h("p", { id: `${id}-help`, class: "help" }, help(attribute)));
    }

    /** Ids that a reference may name, made when the field is entered. */
    #suggest(input, id, attribute) {
        const list = h("datalist", { id });
        input.setAttribute("list", id);
        input.addEventListener("focus", () => {
            const ids = idsOf(this.root, (name, parent) => this.row(name, parent), attribute.refers_to);
            list.replaceChildren(...[...new Set([...ids, ...(attribute.ground ? ["ground"] : [])])].map((x) => h("option", { value: x })));
        });
        return list;
    }

    #tools(element, row, top) {
        const add = h("select", { "aria-label": `Add an element to ${element.name}`, class: "add" });
        const kinds = this.kinds(element);
        setOptions(add, [["", "Add…"], ...kinds.map((r) => [r.name, r.name, r.sentence])], "");
        add.addEventListener("change", () => {
            const kind = kinds.find((r) => r.name === add.value);
            add.value = "";
            if (kind) this.#add(this.places.get(element.path) ?? element, kind);
        });
        return h("div", { class: "element-tools" },
            kinds.length ? add : null,
            button("Show in XML", { icon: "open", class: "quiet" }, () => {
                const e = this.places.get(element.path);
                emit("show-xml", [e.from, e.to]);
            }),
            top ? null : button("Remove", { icon: "close", class: "quiet" }, () => edit([{ remove: element.path }], `${element.name} removed`)));
    }

    /** Opens an element, those around it, and goes to its first field. */
    reveal(path) {
        const steps = path.split("/");
        steps.forEach((x, i) => this.opened.add(steps.slice(0, i + 1).join("/")));
        rebuild(() => this.#build());
        const field = [...this.tree.querySelectorAll("[data-path]")].find((f) => f.dataset.path.startsWith(`${path}/@`));
        field?.scrollIntoView({ block: "center" });
        field?.focus({ preventScroll: true });
    }

    /** Changes of the text that add it; for the tests, too. */
    adding(element, kind) {
        return adding(this.root, element, kind, (name, parent) => this.row(name, parent), state.preview?.verdict?.probes ?? []);
    }

    /** What may be added to an element of this name. */
    kinds(element) {
        return this.elements.filter((r) => mayStandIn(r, element.name) && mayAdd(this.root, element, r, (name, parent) => this.row(name, parent)));
    }

    #add(element, kind) {
        this.opened.add(element.path);
        edit(this.adding(element, kind), `${kind.name} added`);
    }
}

// ---- helpers ----

function choice(id, attribute, change) {
    const box = h("select", { id, "data-path": "", "aria-describedby": `${id}-help`, onchange: () => change(box.value) });
    setOptions(box, [...(attribute.required ? [] : [["", attribute.default ? `${attribute.default} (default)` : "–"]]), ...attribute.choices.map((c) => [c, c])], "");
    return box;
}

function help(a) {
    const facts = [];
    if (a.unit) facts.push(a.unit);
    else if (a.type) facts.push(a.type);
    const low = a.minimum ?? null;
    const high = a.maximum ?? null;
    const say = (v) => (typeof v === "number" ? number(v) : v);
    if (low !== null && high !== null) facts.push(`${say(low)} to ${say(high)}`);
    else if (low !== null) facts.push(`at least ${say(low)}`);
    else if (high !== null) facts.push(`at most ${say(high)}`);
    if (a.default) facts.push(`default ${a.default}`);
    return [h("span", { class: "facts" }, facts.join(" · ")), facts.length ? " " : "", a.sentence ?? ""];
}

const mayStandIn = (row, parent) => row.parent === parent;

function title(element) {
    return element.id ?? "";
}

function summary(element) {
    const shown = [...element.attributes].filter(([name, a]) => a.value !== element.id && name !== "xmlns").slice(0, 4);
    return shown.map(([name, a]) => `${name} ${a.value}`).join(", ");
}

/** Range of a slider in the unit of the value; from the last preview where it knows it. */
function bounds(name, present, min, max) {
    const q = splitQuantity(present);
    const low = splitQuantity(min ?? "");
    const high = splitQuantity(max ?? "");
    if (q && low && high && low.unit === high.unit && low.unit === q.unit) return finish(low.value, high.value, q.value, q.unit);
    const known = state.preview?.parameters?.find((p) => p.name === name);
    if (!known || known.minimum === null || known.maximum === null || known.minimum === undefined || known.maximum === undefined) return null;
    const range = finish(known.minimum, known.maximum, known.value, known.unit);
    return range && { ...range, computed: true };
}

function finish(min, max, value, unit) {
    if (!(max > min)) return null;
    const raw = (max - min) / 240;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((f) => f * power).find((f) => f >= raw * 0.999);
    return { min, max, value, unit, step: Number(step.toPrecision(6)) };
}
