// SPDX-License-Identifier: GPL-3.0-or-later
// Fields that write into the text. What is typed in one and not in the text yet is in state.entered, by the path of what it
// changes, and part of the input (belong.js): nothing that is shown is of it. It stays there until it is in the text, until
// the text is asked and refuses it, or until somebody leaves it with Escape.
import { become } from "./dom.js";
import { splitQuantity } from "./format.js";
import { emit, state } from "./store.js";

/** How a path begins that is a place in the drawing, which changes what the text allows. */
export const DRAWN = "drawn: ";

const takers = new Map(); // path -> makes an edit of what is entered there
const taking = new Map(); // path -> {value, done}: the edit that is under way
let rebuilding = 0; // fields are made anew: one that loses the focus thereby was not left by anybody

export function rebuild(make) {
    rebuilding++;
    try {
        make();
    } finally {
        rebuilding--;
    }
}

function note(path, value, take) {
    state.entered.set(path, value);
    takers.set(path, take);
    emit("entered");
}

/** It is not entered any more: taken, taken back, or what it would change is gone. */
export function leave(path) {
    takers.delete(path);
    if (state.entered.delete(path)) emit("entered");
}

/** What the field of this path shows: what is entered, else the text's. */
export function show(input, path, text) {
    if (state.entered.get(path) === text) leave(path);
    const value = state.entered.get(path);
    if (value === undefined ? input.value.trim() !== text || document.activeElement !== input : input.value.trim() !== value) become(input, { value: value ?? text });
}

/** Begins an edit of everything that is entered; returns promises of why one was refused, or of null. */
export function takeEntered() {
    for (const take of [...takers.values()]) take();
    return [...taking.values()].map((x) => x.done);
}

/** path: what it changes; present(): the text's value; commit(value): the promise of why it was refused, or of null. */
export function enter(input, path, present, commit) {
    const take = () => {
        const value = state.entered.get(path);
        if (value === undefined || taking.get(path)?.value === value) return;
        const mine = { value };
        taking.set(path, mine);
        mine.done = commit(value).finally(() => {
            if (taking.get(path) === mine) taking.delete(path);
            if (state.entered.get(path) === value) leave(path);
            show(input, path, present());
        });
    };
    const typed = () => {
        const value = input.value.trim();
        if (value === present()) leave(path);
        else note(path, value, take);
    };
    const left = () => {
        if (rebuilding) return;
        delete input.dataset.dirty;
        take();
        show(input, path, present());
    };
    input.addEventListener("input", () => {
        input.dataset.dirty = "yes";
        typed();
    });
    input.addEventListener("change", () => {
        if (rebuilding) return;
        typed(); // where a program has filled it in
        left();
    });
    input.addEventListener("blur", left);
    input.addEventListener("keydown", (e) => {
        if (e.key === "Enter") input.blur();
        if (e.key === "Escape") {
            leave(path);
            input.value = present();
            input.blur();
            e.preventDefault();
        }
        if ((e.key === "ArrowUp" || e.key === "ArrowDown") && input.type !== "number") {
            const q = splitQuantity(input.value);
            if (!q) return;
            e.preventDefault();
            const digits = (/\.(\d*)/.exec(input.value)?.[1] ?? "").length;
            const step = 10 ** -digits * (e.shiftKey ? 10 : 1) * (e.key === "ArrowUp" ? 1 : -1);
            input.value = `${(q.value + step).toFixed(digits)}${q.unit ? ` ${q.unit}` : ""}`;
            typed();
            take();
        }
    });
}
