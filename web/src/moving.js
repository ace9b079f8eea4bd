// SPDX-License-Identifier: GPL-3.0-or-later
// A move by hand as changes of the text. A plain number is written anew, in its unit. An attribute that is just a
// parameter changes the parameter, within its least and most, and everything else that uses it follows. What is a
// formula is never overwritten without a word: that direction is held, and the answer says by what.
import { written } from "./quantities.js";

const SAME_M = 0.4e-9; // what is written is rounded to a nanometre
const SAME_RAD = 9e-6;

const pathOf = (w) => `${w.element.path}/@${w.attribute}`;

/** A value of the text, changed: the text to write, in the unit that stands there; absent ones get `unit`. */
function anew(places, text, value, unit) {
    const kind = text === undefined ? { kind: "number", unit } : places.kind(text);
    return written(value, kind.unit || unit, places.units);
}

/** What a parameter may be set to, or null where its own value is a formula. */
function ofParameter(places, name, value) {
    const text = places.written(name);
    const kind = places.kind(text);
    if (kind.kind !== "number") return null;
    const e = places.parameters.get(name);
    const [least, most] = ["min", "max"].map((a) => (e.attributes.has(a) ? places.si(e, a) : NaN));
    const inside = Math.min(Math.max(value, Number.isNaN(least) ? -Infinity : least), Number.isNaN(most) ? Infinity : most);
    return { inside, text: written(inside, kind.unit, places.units), ends: inside !== value };
}

/** One try: {changes: Map path -> text, locked: [{...want, text}], at the limit of: name} */
function attempt(places, handle, target, { loose = false } = {}) {
    const changes = new Map();
    const locked = [];
    let limited = null;
    for (const w of handle.wants(places, target)) {
        const text = places.text(w.element, w.attribute);
        const kind = text === undefined ? null : places.kind(text);
        if (kind?.kind !== "parameter" || w.plain || same(w, places.si(w.element, w.attribute)) || changes.has(kind.name)) continue;
        const now = ofParameter(places, kind.name, kind.sign * w.value);
        if (!now) continue; // held: found below
        changes.set(kind.name, now.text);
        if (now.ends && w.axis !== null) limited = { name: kind.name, axis: w.axis, share: (kind.sign * now.inside - places.si(w.element, w.attribute)) / (w.value - places.si(w.element, w.attribute)) };
    }
    if (limited) return { limited };
    const next = places.with(changes);
    for (const w of handle.wants(next, target)) {
        const text = next.text(w.element, w.attribute);
        if (same(w, next.si(w.element, w.attribute))) continue;
        const kind = text === undefined ? "number" : next.kind(text).kind;
        const unit = w.angle ? "deg" : w.unit ?? "um";
        if (kind === "number") changes.set(pathOf(w), anew(next, text, w.value, unit));
        else if (loose) changes.set(pathOf(w), written(w.value, unit, next.units));
        else locked.push({ ...w, text });
    }
    return { changes, locked };
}

const same = (w, now) => Math.abs(w.value - now) < (w.angle ? SAME_RAD : w.force ? 1e-6 * w.force : SAME_M);

/**
 * The nearest that the text allows to dragging a handle to a target: {changes: Map path -> text (a parameter by its
 * name), places: with these changes, target: where it comes to, locked: what held it back}. loose: formulas are replaced by numbers.
 */
export function plan(places, handle, target, options = {}) {
    const [x0, y0] = handle.at;
    let wanted = target;
    for (let k = 0; k < 2; k++) { // a parameter at its end ends the way there, on its axis
        const first = attempt(places, handle, wanted, options);
        if (!first.limited) break;
        wanted = wanted.map((v, axis) => (axis === first.limited.axis ? handle.at[axis] + first.limited.share * (v - handle.at[axis]) : v));
    }
    let held = [];
    for (const to of [wanted, [x0, wanted[1]], [wanted[0], y0]]) {
        const one = attempt(places, handle, to, options);
        if (one.limited) continue;
        if (!held.length) held = one.locked;
        if (one.locked.length === 0) return { changes: one.changes, places: places.with(one.changes), target: to, locked: held };
    }
    return { changes: new Map(), places, target: handle.at, locked: held };
}

/** Why a handle was held, in words. */
export function heldBy(locked) {
    const names = [...new Set(locked.map((w) => `${w.attribute} of ${w.element.name}${w.element.id ? ` ${w.element.id}` : ""} is ${w.text}`))];
    return names.slice(0, 3).join(", ");
}
