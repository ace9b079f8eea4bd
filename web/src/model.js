// SPDX-License-Identifier: GPL-3.0-or-later
// The text as a tree of elements with the places of their attributes, for the form. The parser goes on
// behind mistakes, so that the form stays usable while somebody types.
import { parser } from "@lezer/xml";

const ENTITIES = { lt: "<", gt: ">", amp: "&", quot: '"', apos: "'" };
const decode = (text) =>
    text.replace(/&(#x?[0-9a-fA-F]+|\w+);/g, (whole, name) => {
        if (name[0] !== "#") return ENTITIES[name] ?? whole;
        const code = name[1] === "x" ? parseInt(name.slice(2), 16) : parseInt(name.slice(1), 10);
        return code > 0 && code < 0x110000 ? String.fromCodePoint(code) : whole;
    });

function attributesOf(tag, text) {
    const attributes = new Map();
    for (let a = tag.firstChild; a; a = a.nextSibling) {
        if (a.name !== "Attribute") continue;
        const name = a.getChild("AttributeName");
        const value = a.getChild("AttributeValue");
        if (!name || !value) continue;
        attributes.set(text.slice(name.from, name.to), { value: decode(text.slice(value.from + 1, value.to - 1)), from: a.from, to: a.to, valueFrom: value.from, valueTo: value.to });
    }
    return attributes;
}

function elementOf(node, text, keyOf) {
    const tag = node.firstChild;
    const nameNode = tag?.getChild("TagName");
    if (!nameNode) return null;
    const name = text.slice(nameNode.from, nameNode.to);
    const attributes = attributesOf(tag, text);
    const key = keyOf(name);
    const children = [];
    for (let c = node.firstChild; c; c = c.nextSibling) {
        if (c.name !== "Element") continue;
        const child = elementOf(c, text, keyOf);
        if (child) children.push(child);
    }
    return { name, id: key ? attributes.get(key)?.value ?? null : null, attributes, children, from: node.from, to: tag.to };
}

/** Paths as /api/edit takes them: ELEMENT[ID] where the ID is there and alone, else ELEMENT[N]. */
function name(element, path) {
    element.path = path;
    const alike = (c) => element.children.filter((o) => o.name === c.name);
    for (const child of element.children) {
        const same = alike(child);
        const byId = child.id && same.filter((o) => o.id === child.id).length === 1 && !/^\d+$|[\]/]/.test(child.id);
        const step = same.length === 1 && !child.id ? child.name : `${child.name}[${byId ? child.id : same.indexOf(child) + 1}]`;
        name(child, `${path}/${step}`);
    }
}

/** keyOf(name): the attribute that names such an element, or null. Returns the root element or null. */
export function parse(text, keyOf) {
    const top = parser.parse(text).topNode.getChild("Element");
    const root = top ? elementOf(top, text, keyOf) : null;
    if (root) name(root, root.name);
    return root;
}

export function* walk(element) {
    yield element;
    for (const child of element.children) yield* walk(child);
}

/** What an edit's path names: ELEMENT/…/@ATTRIBUTE, with or without the root, or a parameter by its name. */
function attributeAt(root, path) {
    const [, of, name] = /^(.*)\/@([^/@]+)$/.exec(path) ?? [];
    if (of === undefined) return root.children.find((c) => c.name === "parameter" && c.attributes.get("name")?.value === path)?.attributes.get("value");
    return [...walk(root)].find((e) => e.path === of || e.path === `${root.name}/${of}`)?.attributes.get(name);
}

const NO_XML = /[\0-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]|\p{Cs}/u;
const AS_WRITTEN = { "&": "&amp;", "<": "&lt;", "\n": "&#10;", "\r": "&#13;", "\t": "&#9;" };
const QUOTES = { '"': "&quot;", "'": "&apos;" };

/** The text with other values of attributes that stand in it, as /api/edit would write them; null where that is not all
 *  that is asked for. list: [{path, value}] */
export function withValues(text, keyOf, list) {
    let now = text;
    for (const { path, value } of list) {
        const root = typeof path === "string" && typeof value === "string" && !NO_XML.test(value) ? parse(now, keyOf) : null;
        const at = root && attributeAt(root, path);
        if (!at) return null;
        const quote = now[at.valueFrom];
        const written = value.replace(/[&<\n\r\t"']/g, (c) => AS_WRITTEN[c] ?? (c === quote ? QUOTES[c] : c));
        now = `${now.slice(0, at.valueFrom + 1)}${written}${now.slice(at.valueTo - 1)}`;
    }
    return now;
}
