// SPDX-License-Identifier: GPL-3.0-or-later
// Elements without HTML text: nothing of a device's file is ever parsed as markup, and no attribute
// is one that the content security policy forbids (styles go through the CSSOM).
const SVG = "http://www.w3.org/2000/svg";

function fill(element, attributes, children) {
    for (const [name, value] of Object.entries(attributes ?? {})) {
        if (value === null || value === undefined || value === false) continue;
        if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
        else if (name === "style") for (const [k, v] of Object.entries(value)) element.style.setProperty(k, v);
        else if (name === "class") element.setAttribute("class", value);
        else if (name in element && !(element instanceof SVGElement) && name !== "list" && name !== "form")
            element[name] = value;
        else element.setAttribute(name, value === true ? "" : value);
    }
    element.append(...children.flat(Infinity).filter((c) => c !== null && c !== undefined && c !== false));
    return element;
}

/** h("p", {class: "note"}, "text", child): an HTML element. */
export const h = (name, attributes, ...children) => fill(document.createElement(name), attributes, children);

/** s("path", {d}): an SVG element. */
export const s = (name, attributes, ...children) => fill(document.createElementNS(SVG, name), attributes, children);

// What is written is laid out anew, be it what stood there or not: so only what differs is written.

export function say(element, text) {
    if (element.textContent !== text) element.textContent = text;
}

/** Attributes, of HTML and SVG elements. */
export function put(element, attributes) {
    for (const [name, value] of Object.entries(attributes)) if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value);
}

/** Properties of an element: value, hidden ... */
export function become(element, properties) {
    for (const [name, value] of Object.entries(properties)) if (element[name] !== value) element[name] = value;
}

/**
 * replaceChildren() that keeps what stands there and changes what differs in it: elements of one kind at one place are one
 * element. So what somebody has opened or holds by the keyboard stays. Not for children whose listeners know more than their
 * attributes tell: those of the first time stay, too.
 */
export function refill(box, ...children) {
    let old = box.firstChild;
    for (const child of children.flat(Infinity).filter((c) => c !== null && c !== undefined && c !== false)) {
        const fresh = child instanceof Node ? child : document.createTextNode(child);
        const next = old?.nextSibling ?? null;
        if (!old) box.append(fresh);
        else if (!became(old, fresh)) old.replaceWith(fresh);
        old = next;
    }
    while (old) {
        const next = old.nextSibling;
        old.remove();
        old = next;
    }
}

/** Makes a node show what another one does, where both are of one kind. */
function became(old, fresh) {
    if (old === fresh) return true;
    if (old.nodeName !== fresh.nodeName) return false;
    if (old.nodeType === Node.TEXT_NODE) {
        become(old, { data: fresh.data });
        return true;
    }
    for (const name of old.getAttributeNames()) if (!fresh.hasAttribute(name) && name !== "open") old.removeAttribute(name);
    for (const { name, value } of fresh.attributes) {
        if (name === "style") become(old.style, { cssText: fresh.style.cssText }); // the attribute is forbidden, the CSSOM is not
        else put(old, { [name]: value });
    }
    refill(old, ...fresh.childNodes);
    return true;
}

export const $ = (id) => document.getElementById(id);

const ICONS = {
    undo: "M9 14 4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3",
    redo: "m15 14 5-5-5-5M20 9H10a6 6 0 0 0 0 12h3",
    save: "M5 3h11l3 3v15H5zM8 3v6h7V3M8 21v-7h8v7",
    download: "M12 3v12m-5-5 5 5 5-5M4 20h16",
    play: "M7 4v16l13-8z",
    pause: "M7 4v16M17 4v16",
    fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
    plus: "M12 5v14M5 12h14",
    minus: "M5 12h14",
    ruler: "m3 17 14-14 4 4L7 21zM8 12l2 2M11 9l3 3M14 6l2 2",
    close: "M6 6l12 12M18 6 6 18",
    sun: "M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8M12 2v2M12 20v2M2 12h2M20 12h2M5 5l1.5 1.5M17.5 17.5 19 19M5 19l1.5-1.5M17.5 6.5 19 5",
    moon: "M20 14A8.5 8.5 0 0 1 10 4a8.5 8.5 0 1 0 10 10z",
    info: "M12 11v6M12 7.5v.5M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18",
    check: "m5 12 5 5L20 7",
    cross: "M6 6l12 12M18 6 6 18",
    question: "M9 9a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.2-1.5 2.4M12 17.5v.5",
    warn: "M12 4 2.5 20h19zM12 10v5M12 17.5v.3",
    open: "M14 4h6v6M20 4l-9 9M18 14v6H4V6h6",
    print: "M7 8V3h10v5M7 17H4V8h16v9h-3M7 14h10v7H7z",
    bar: "M5 19 19 5M3 17l4 4M17 3l4 4",
    plate: "M4 6h16v12H4z",
    disc: "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16",
    outline: "M4 19 7 5l8 3 5-3v9l-7 6z",
    hinge: "M4 20c9 0 12-4 12-8s-3-6-6-4-2 7 2 6 2-8 4-10",
    force: "M4 20 19 5M10 4h10v10",
    cable: "M4 12a2 2 0 1 0 4 0 2 2 0 0 0-4 0M8 12c4 0 4-6 8-6h5M18 3l3 3-3 3",
    comb: "M4 4v16M4 6h8M4 12h8M4 18h8M20 4v16M20 9h-8M20 15h-8",
    workspace: "M4 8V4h4M16 4h4v4M20 16v4h-4M8 20H4v-4M12 9v6M9 12h6",
    cursor: "M6 3v15l4-4 3 7 3-1-3-7h6z",
    versions: "M8 4h12v12M4 8h12v12H4z",
    film: "M4 5h16v14H4zM8 5v14M16 5v14M4 9.5h4M4 14.5h4M16 9.5h4M16 14.5h4",
    target: "M12 5a7 7 0 1 0 0 14 7 7 0 0 0 0-14M12 2v4M12 18v4M2 12h4M18 12h4",
};

/** A line icon of 24 units; it says nothing by itself (aria-hidden). */
export function icon(name) {
    return s("svg", { viewBox: "0 0 24 24", class: "icon", "aria-hidden": "true" }, s("path", { d: ICONS[name] }));
}

/** A button with an icon; its label is text (shown) or a name for assistive programs (hidden). */
export function button(label, { icon: name, hidden = false, ...attributes } = {}, onclick) {
    return h(
        "button",
        { type: "button", title: hidden ? label : null, "aria-label": hidden ? label : null, onclick, ...attributes },
        name ? icon(name) : null,
        hidden ? null : h("span", {}, label),
    );
}

/** <select> of [value, text] pairs. */
export function select(label, options, value, onchange, attributes) {
    const box = h("select", { "aria-label": label, onchange: () => onchange(box.value), ...attributes });
    setOptions(box, options, value);
    return box;
}

export function setOptions(box, options, value) {
    const key = JSON.stringify(options);
    if (box.dataset.key !== key) {
        box.dataset.key = key;
        box.replaceChildren(...options.map(([v, text, title]) => h("option", { value: v, title }, text)));
    }
    box.value = value;
    if (box.selectedIndex < 0 && options.length) box.selectedIndex = 0;
}

/** The same with groups: options are [group, value, text], those of a group behind each other. */
export function setGroups(box, options, value) {
    const key = JSON.stringify(options);
    if (box.dataset.key !== key) {
        box.dataset.key = key;
        const groups = [...new Set(options.map(([group]) => group))];
        box.replaceChildren(...groups.map((label) => h("optgroup", { label }, options.filter(([group]) => group === label).map(([, v, text]) => h("option", { value: v }, text)))));
    }
    box.value = value;
}

/** Puts text into a live region of the page, so that it is read aloud once. */
export function announce(text) {
    $("announce").textContent = text;
}
