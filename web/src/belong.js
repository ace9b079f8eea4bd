// SPDX-License-Identifier: GPL-3.0-or-later
// What is shown and which input it belongs to. The input is the whole of it: the text, values that are held by a
// slider, what is typed in a field or changed and in no text yet, and the options. Every part of the page that shows a result says of which input it is (`take`); whatever
// is not of the present input is marked, by this file alone: `data-of` is "present", "former", "another" (of another device: hidden) or "nothing" at once,
// and what has been former for OLD_MS is visibly old (class "old": grey, with words). While somebody moves a slider
// answers come faster than that, and nothing flickers.
import { emit, on, state } from "./store.js";

export const OLD_MS = 150;
const LEFT_MOST = 64; // inputs of which it is remembered when they were left

const ordered = (object) => Object.entries(object).sort(([a], [b]) => (a < b ? -1 : a > b ? 1 : 0));

// Texts have numbers, so that keys are short; the same text has the same one while it is among the last TEXTS_MOST.
const TEXTS_MOST = 32;
const texts = new Map();
let count = 0;

function numberOf(text) {
    const n = texts.get(text) ?? ++count;
    texts.delete(text); // to the end of the list
    texts.set(text, n);
    if (texts.size > TEXTS_MOST) texts.delete(texts.keys().next().value);
    return n;
}

// A device that is begun anew, or opened: what is known of the one before is no former answer to it, and nothing of that is
// left to see (`data-of` "another"). Texts from its first one on are of it, as their numbers tell; undone, all is as it was.
const begun = [];

/** The text that the editor gets next is of another device than the one there is. */
export function anotherDevice(text) {
    if (text === state.text) return;
    texts.delete(text); // it is no text of before, though it may be the same
    firsts.clear();
    begun.push(numberOf(text));
    emit("another");
}

const deviceOf = (text) => begun.filter((first) => first <= text).length;

/** What belongs to this input is of a device that is no longer there. */
export const ofAnother = (of) => begun.length > 0 && deviceOf(Number(/^\[(\d+)/.exec(of)?.[1])) !== deviceOf(numberOf(state.text));

// What judges a device reads neither its studies nor comments, nor what is blank between elements: texts that differ in
// nothing else are one input of it.
const COMMENT = /<!--[^]*?-->/g;
const STUDY = /<study(?:\s+[\w:.-]+\s*=\s*(?:"[^"]*"|'[^']*'))*\s*(?:\/>|>[^]*?<\/study\s*>)/g;
const firsts = new Map(); // such a text without all that -> number of the first one that had it

/** Number of the whole text, which a result depends on as a rule. */
const wholeText = () => numberOf(state.text);

/** What is read of the text: without comments, blanks between elements, and all studies but the one of that name. */
function whatIsRead(study) {
    if (/<!(?:\[CDATA|DOCTYPE)/.test(state.text)) return state.text;
    const named = (element) => /\sname\s*=\s*(?:"([^"]*)"|'([^']*)')/.exec(element.slice(0, element.indexOf(">")));
    const keeps = (element) => study !== undefined && (named(element)?.[1] ?? named(element)?.[2]) === study;
    return state.text.replace(COMMENT, "").replace(STUDY, (element) => (keeps(element) ? element : "")).replace(/>\s+</g, "><").trim();
}

function firstOf(read) {
    const own = numberOf(state.text);
    const first = firsts.get(read) ?? own;
    firsts.delete(read);
    firsts.set(read, first);
    if (firsts.size > TEXTS_MOST) firsts.delete(firsts.keys().next().value);
    return first;
}

/** Of a result that goes by the device that is described alone. */
export const deviceText = () => firstOf(whatIsRead());

/** Of the result of a study: what other studies say does not change it. */
export const studyText = (name) => () => firstOf(whatIsRead(name));

/** A short text that is another for another input of a study, the same on every page: 106 bits of it (cyrb53, twice). */
export function stampOf(study, options) {
    const words = JSON.stringify([whatIsRead(study), ordered(state.set), ordered(options), ordered(state.lab)]);
    return [0, 1].map((seed) => {
        let [a, b] = [0xdeadbeef ^ seed, 0x41c6ce57 ^ seed];
        for (let i = 0; i < words.length; i++) {
            const c = words.charCodeAt(i);
            a = Math.imul(a ^ c, 2654435761);
            b = Math.imul(b ^ c, 1597334677);
        }
        a = Math.imul(a ^ (a >>> 16), 2246822507) ^ Math.imul(b ^ (b >>> 13), 3266489909);
        b = Math.imul(b ^ (b >>> 16), 2246822507) ^ Math.imul(a ^ (a >>> 13), 3266489909);
        return (4294967296 * (2097151 & b) + (a >>> 0)).toString(16);
    }).join("-");
}

/** What a request of now is of, or of which parts of the state a result depends: with other options, of a job; reads():
 *  the number of what it takes from the text. */
export const requestKey = (options = state.options, reads = wholeText) => JSON.stringify([reads(), ordered(state.set), ordered(options), ...Object.entries(state.lab).map(([name, text]) => [name, numberOf(text)])]);

/** The present input: that, and what is in no text yet. While there is such a thing, no answer is of the present input. */
export function inputKey(options = state.options, reads = wholeText) {
    const key = requestKey(options, reads);
    return state.entered.size || state.edits.length ? `${key} ${JSON.stringify([[...state.entered], state.edits])}` : key;
}

const left = new Map(); // key -> when it stopped being the present one
const all = new Set();
let timer = 0;

/** One result in one element. present(): the key that a result of now would have. */
export class Shown {
    constructor(element, present = inputKey) {
        Object.assign(this, { element, present, of: null });
        element.shown = [...(element.shown ?? []), this];
        element.dataset.of = "nothing";
        all.add(this);
    }

    /** What is shown from now on is of this input; null: nothing is shown. */
    take(of) {
        this.of = of;
        look();
    }

    get former() {
        return this.of !== null && this.of !== this.now;
    }

    /** What is shown is of a device that is no longer there. */
    get another() {
        return this.former && ofAnother(this.of);
    }
}

let holding = 0; // what is shown is being changed, and looked at when all of it is
let due = false;

/** Many results are taken at once, and every part is marked once. */
export function together(change) {
    holding++;
    try {
        change();
    } finally {
        holding--;
        if (!holding && due) look();
    }
}

/** Marks every part anew; whoever changes the input or shows a result calls it, before anything else happens. */
function look() {
    due = holding > 0;
    if (due) return;
    const time = performance.now();
    const here = inputKey();
    let next = Infinity;
    const elements = new Set();
    for (const shown of all) {
        const now = shown.present === inputKey ? here : shown.present();
        if (shown.now !== undefined && shown.now !== now) {
            left.delete(shown.now); // to the end of the list
            left.set(shown.now, time);
        }
        shown.now = now;
        elements.add(shown.element);
    }
    while (left.size > LEFT_MOST) left.delete(left.keys().next().value);
    // nothing is waited for any more: what is former now stays so
    const over = state.answered === here || state.cancelled === here;
    for (const element of elements) next = Math.min(next, mark(element, over ? Infinity : time));
    clearTimeout(timer);
    if (next < Infinity) timer = setTimeout(look, next);
    emit("belong");
}

/** An element with several results is as old as the oldest of them, at this time. Returns in how many ms it becomes
 *  old. */
function mark(element, time) {
    const some = element.shown.filter((x) => x.of !== null);
    const former = some.filter((x) => x.former);
    const another = former.some((x) => x.another);
    const of = another ? "another" : former.length ? "former" : some.length ? "present" : "nothing";
    if (element.dataset.of !== of) element.dataset.of = of;
    const age = Math.max(...former.map((x) => time - (left.get(x.of) ?? 0)), -Infinity);
    const old = age >= OLD_MS && !another;
    if (old !== element.classList.contains("old")) element.classList.toggle("old", old);
    return former.length && !old && !another ? OLD_MS - age + 1 : Infinity;
}

for (const event of ["text", "change", "options", "entered"]) on(event, look);
export { look };

/** What an element shows, or is part of, is of a former input: what is saved of it says so. */
export const isFormer = (element) => element.closest('[data-of="former"]') !== null;
export const FORMER = ", of a former input";

// ---- what is on its way, with a sign and a way to end it ----

const working = new Set();

/** Work that somebody waits for: {words, cancel(), row(): where it has a sign of its own}; returns the function that ends the sign. */
export function begin(work) {
    const item = { since: performance.now(), ...work };
    working.add(item);
    emit("working");
    return () => {
        working.delete(item);
        emit("working");
    };
}

export const underWay = () => [...working];

/** Asks everything that may still change what is shown: each adds () => true while it has something to do. */
const pending = [];
export const mayChange = (busy, { job = false } = {}) => pending.push({ busy, job });

/** Nothing changes any more by itself; jobs false: but for long work. */
export const settled = (jobs = true) => working.size === 0 && pending.every((x) => (x.job && !jobs) || !x.busy());
