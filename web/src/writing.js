// SPDX-License-Identifier: GPL-3.0-or-later
// Help while the XML is written: what may stand here (elements, attributes, words, names), and what the thing under the
// pointer is. Everything comes from the table of elements that the program checks by.
import { syntaxTree } from "@codemirror/language";
import { hoverTooltip } from "@codemirror/view";
import { idsOf } from "./adding.js";
import { h } from "./dom.js";
import { number } from "./format.js";

const TAGS = new Set(["OpenTag", "SelfClosingTag", "CloseTag", "MismatchedCloseTag", "MissingCloseTag"]);
const WORD = /[\w:.-]*$/;

const textAt = (state, node) => (node ? state.sliceDoc(node.from, node.to) : "");
const nameOf = (state, tag) => textAt(state, tag?.getChild("TagName"));

/** The names of the elements around a place, the outermost first; but: one that is not counted. */
function around(state, node, but = null) {
    const out = [];
    for (let n = node; n; n = n.parent) if (n.name === "Element" && n !== but && !(but && n.from === but.from && n.to === but.to)) out.unshift(nameOf(state, n.firstChild));
    return out;
}

/** Facts of an attribute as the form has them, in one line. */
export function facts(a) {
    const out = [];
    if (a.unit) out.push(a.unit);
    else if (a.type) out.push(a.type);
    const say = (v) => (typeof v === "number" ? number(v) : v);
    const [low, high] = [a.minimum ?? null, a.maximum ?? null];
    if (low !== null && high !== null) out.push(`${say(low)} to ${say(high)}`);
    else if (low !== null) out.push(`at least ${say(low)}`);
    else if (high !== null) out.push(`at most ${say(high)}`);
    if (a.choices?.length) out.push(a.choices.join(", "));
    if (a.default) out.push(`default ${a.default}`);
    if (a.required) out.push("required");
    return out.join(" · ");
}

/** Where a place is: {kind: "element", parent, from} | {kind: "attribute", element, parent, has, from} | {kind: "value",
 *  element, parent, name, from} | null. */
function placeOf(state, pos) {
    const before = state.sliceDoc(Math.max(0, pos - 4000), pos);
    const start = before.lastIndexOf("<");
    if (start < 0) return null;
    const inside = before.slice(start); // from the last "<" on
    if (/^<[!?/]/.test(inside)) return null;
    const quotes = inside.match(/"/g)?.length ?? 0;
    if (quotes % 2 === 0 && inside.includes(">")) return null; // between elements
    const at = pos - inside.length;
    const tree = syntaxTree(state);
    let node = tree.resolveInner(at + 1, 1);
    while (node && node.name !== "Element" && node.parent) node = node.parent;
    const here = node?.name === "Element" && node.from === at ? node : null;
    const parents = around(state, here ? here.parent : tree.resolveInner(at, -1));
    const parent = parents.at(-1) ?? null;
    const head = /^<([\w:.-]*)/.exec(inside)[1];
    if (inside.length === head.length + 1) return { kind: "element", parent, from: at + 1 };
    if (quotes % 2) {
        const name = /([\w:.-]+)\s*=\s*"[^"]*$/.exec(inside)?.[1];
        return name ? { kind: "value", element: head, parent, name, from: pos - /[^"]*$/.exec(inside)[0].length } : null;
    }
    const whole = inside + state.sliceDoc(pos, Math.min(pos + 2000, state.doc.length)).split(/[<>]/)[0];
    return { kind: "attribute", element: head, parent, has: [...whole.matchAll(/([\w:.-]+)\s*=\s*"/g)].map((m) => m[1]), from: pos - WORD.exec(inside)[0].length };
}

/** words(): {elements: of the table, form} once they are there. */
export function completions(words) {
    return (context) => {
        const { form, elements } = words() ?? {};
        if (!form) return null;
        const place = placeOf(context.state, context.pos);
        if (!place) return null;
        if (place.kind === "element") return { from: place.from, options: elements.filter((r) => r.parent === place.parent).map((r) => elementOption(r)), validFor: /^[\w:.-]*$/ };
        const row = form.row(place.element, place.parent);
        if (place.kind === "attribute") {
            const options = row.attributes.filter((a) => !place.has.includes(a.name)).map((a) => attributeOption(a));
            return { from: place.from, options, validFor: /^[\w:.-]*$/ };
        }
        const a = row.attributes.find((x) => x.name === place.name);
        const list = a ? valuesOf(a, form) : [];
        return list.length ? { from: place.from, options: list, validFor: /^[^"]*$/ } : null;
    };
}

function elementOption(r) {
    const required = r.attributes.filter((a) => a.required);
    const text = `${r.name}${required.map((a) => ` ${a.name}=""`).join("")}`;
    return {
        label: r.name, type: "type", detail: r.once ? "once" : undefined, info: () => h("div", { class: "cm-help" }, r.sentence),
        apply: (view, _completion, from, to) => {
            const first = text.indexOf('""');
            const close = /^\s*\/?>/.test(view.state.sliceDoc(to, to + 3)) ? "" : "/>";
            view.dispatch({ changes: { from, to, insert: text + close }, selection: { anchor: from + (first < 0 ? text.length : first + 1) }, userEvent: "input.complete" });
        },
    };
}

function attributeOption(a) {
    return {
        label: a.name, type: "property", detail: a.required ? "required" : a.unit ?? undefined, boost: a.required ? 1 : 0, info: () => helpOf(null, a),
        apply: (view, _completion, from, to) => {
            const text = `${a.name}=""`;
            const next = view.state.sliceDoc(to, to + 1);
            view.dispatch({ changes: { from, to, insert: text + (/[\w]/.test(next) ? " " : "") }, selection: { anchor: from + text.length - 1 }, userEvent: "input.complete" });
        },
    };
}

function valuesOf(a, form) {
    const root = form.root;
    const all = (list, detail) => list.map((label) => ({ label, detail, type: "constant" }));
    if (a.choices?.length) return all(a.choices);
    if (!root) return [];
    if (a.refers_to) return all([...idsOf(root, (n, p) => form.row(n, p), a.refers_to), ...(a.ground ? ["ground"] : [])], a.refers_to);
    const parameters = root.children.filter((e) => e.name === "parameter").map((e) => e.attributes.get("name")?.value).filter(Boolean);
    return ["number", "expression", "in-time", "name"].includes(a.type) ? all(parameters, "parameter") : [];
}

const helpOf = (element, a) => h("div", { class: "cm-help" }, h("div", {}, h("b", {}, element ? `<${element}> ${a.name}` : a.name), " ", h("span", { class: "cm-facts" }, facts(a))), h("div", {}, a.sentence ?? ""));

/** What the name or value under the pointer is. */
export function hover(words) {
    return hoverTooltip((view, pos, side) => {
        const { form } = words() ?? {};
        if (!form) return null;
        let node = syntaxTree(view.state).resolveInner(pos, side);
        if (!["TagName", "AttributeName", "AttributeValue", "Is"].includes(node.name)) return null;
        const attribute = node.name === "TagName" ? null : node.parent;
        const tag = node.name === "TagName" ? node.parent : attribute?.parent;
        if (!tag || !TAGS.has(tag.name)) return null;
        const element = nameOf(view.state, tag);
        const row = form.row(element, around(view.state, tag.parent?.parent).at(-1) ?? null);
        if (!attribute) return row.sentence ? { pos: node.from, end: node.to, create: () => ({ dom: h("div", { class: "cm-help" }, h("b", {}, `<${element}>`), " ", row.sentence) }) } : null;
        const a = row.attributes.find((x) => x.name === textAt(view.state, attribute.getChild("AttributeName")));
        return a ? { pos: attribute.from, end: attribute.to, create: () => ({ dom: helpOf(element, a) }) } : null;
    });
}
