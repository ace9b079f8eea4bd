// SPDX-License-Identifier: GPL-3.0-or-later
// The design: text of the editor, changes to it by way of the server, previews of it.
import { alike } from "./alike.js";
import { newest, post } from "./api.js";
import { begin, inputKey, look, mayChange, together } from "./belong.js";
import { announce } from "./dom.js";
import { emit, on, onFirst, state } from "./store.js";

const TYPING_MS = 90; // that nothing is typed before an answer is asked for

let editor = null;
let editing = 0; // changes that are on their way
let changes = Promise.resolve(); // one after the other: each needs the text that the last one made

export function useEditor(e) {
    editor = e;
}

/** changes: [{path, value}] as /api/edit takes them; one step of the history. */
export function edit(list, words) {
    editing++;
    changes = changes.then(async () => {
        const end = begin({ words: "Changing the text" });
        try {
            let before, answer;
            do { // again, where somebody has typed meanwhile
                before = state.text;
                answer = await post("/api/edit", { text: before, changes: list });
            } while (state.text !== before);
            if (answer.text !== undefined && answer.text !== null && !(answer.status && answer.status !== "ok")) {
                editor.replace(answer.text);
                if (words) announce(words);
            } else refuse(answer.diagnostics?.[0]?.message ?? "the change cannot be made");
        } catch (error) {
            if (!error.lost) refuse(error.message);
        } finally {
            editing--;
            end();
        }
    });
    return changes;
}

function refuse(message) {
    emit("notice", { kind: "warn", text: `Not changed: ${message}` });
    emit("text", state.text); // fields show again what the text says
}

/** A slider that is held: the value counts at once, the text gets it when it is let go. */
export function hold(name, value) {
    state.set[name] = value;
    emit("change");
}

export async function letGo(name, value) {
    await edit([{ path: name, value }]);
    if (state.set[name] !== value) return; // it is held again
    delete state.set[name];
    emit("change");
}

/** Values that are held by hand in the picture, Map of path -> text, in place of those that were (keys). */
export function holdTogether(changes, before = []) {
    for (const path of before) delete state.set[path];
    for (const [path, value] of changes) state.set[path] = value;
    emit("change");
}

/** They become text, as one step of the history; with no changes they are as they were. */
export async function letGoTogether(changes, words) {
    if (changes.size) await edit([...changes].map(([path, value]) => ({ path, value })), words);
    for (const [path, value] of changes) if (state.set[path] === value) delete state.set[path]; // else it is held again
    emit("change");
}

/** How it is computed: {method, integrator, rtol, scene ...}; "" leaves the choice to the program. */
export function setOptionsTogether(values) {
    for (const [name, value] of Object.entries(values)) {
        if (value === "") delete state.options[name];
        else state.options[name] = value;
    }
    emit("options");
    emit("change");
}
export const setOption = (name, value) => setOptionsTogether({ [name]: value });

/** What a job or a preview of the present state is asked with. */
export function request() {
    const options = { ...state.options };
    for (const name of OPTIONS_AS_NUMBERS) if (options[name] !== undefined) options[name] = Number(options[name]);
    return { text: state.text, set: { ...state.set }, options, ...lab() };
}

/** With the velocities of a motion, where they are looked at: the rest of the answer is the same with and without them. */
export const previewRequest = () => ({ ...request(), ...(state.rates ? { rates: true } : {}) });

/** Laboratory packs that are in use, as requests have them. */
export const lab = () => (Object.keys(state.lab).length ? { lab: { ...state.lab } } : {});

const OPTIONS_AS_NUMBERS = ["rtol", "accuracy"];

const preview = newest(
    ({ body }, signal) => post("/api/preview", body, { signal }),
    take,
    (error, input) => {
        rest?.();
        if (error.lost) return;
        wrong(input, [{ severity: "error", code: error.body?.error?.code ?? null, message: error.message, line: 0, column: 0 }]);
        emit("answer");
        look();
    },
    {
        words: "Computing the motion and the verdict",
        given: (input, why) => {
            if (why !== "cancelled" || input.key !== inputKey()) return;
            rest?.();
            state.cancelled = input.key;
            emit("answer");
            look();
        },
    });

/** No good answer: what is shown stays, and is of the former input. */
function wrong(input, diagnostics) {
    state.diagnostics = diagnostics;
    state.answered = input.key;
    state.cancelled = null;
}

// what two answers of one device need not have in common: a slider that was let go is asked about once more, as text
const OWN = { cost: true, parameters: true, diagnostics: true, motion: { stats: true } };

function take(answer, input) {
    const diagnostics = answer.diagnostics ?? [];
    const shown = answer.marks?.length > 0 && answer.bodies?.length > 0; // a layout that cannot be made
    const good = answer.status === "ok" || (answer.status === "failed" && shown);
    if (!good && !diagnostics.length) diagnostics.push({ severity: "error", code: null, message: answer.message ?? "this design cannot be computed", line: 0, column: 0 });
    if (!good) {
        rest?.(); // of the answer before it, whose picture is there
        return told(answer, input, diagnostics);
    }
    const first = state.preview === null;
    state.same = !first && alike(answer, state.preview, OWN) ? state.preview : null;
    state.preview = answer;
    state.previewOf = input.key;
    together(() => emit("picture", answer));
    const mine = (rest = () => {
        if (rest !== mine) return; // a newer picture is there, and its rest is to come
        rest = null;
        together(() => {
            emit("preview", answer);
            told(answer, input, diagnostics);
        });
    });
    if (first || state.same || inputKey() === toldOf) rest(); // of the same device the picture stays, and its rest can come with it
    afterFrame(() => {
        state.latency.push(performance.now() - input.since);
        if (state.latency.length > 400) state.latency.shift();
        mine();
    });
}

// The picture first: what is read, lists and curves, comes in the frame behind it. Until then it is of the former input, and marked so.
let rest = null; // shows it
let toldOf = null; // input of the answer that all of the page showed last

/** Where the input is what the lists are of, the picture and they come together before anything is painted: all of the page is of one answer. */
function back() {
    if (rest && inputKey() === toldOf) rest();
}

const FRAME_MOST_MS = 100; // a window that nobody sees draws no frames

function afterFrame(f) {
    let done = false;
    const once = () => {
        if (done) return;
        done = true;
        f();
    };
    requestAnimationFrame(() => setTimeout(once));
    setTimeout(once, FRAME_MOST_MS);
}

function told(answer, input, diagnostics) {
    wrong(input, diagnostics);
    if (state.previewOf === input.key) toldOf = input.key;
    emit("answer", answer);
    look();
}

/** A good answer to the present input is shown. */
export const isPresent = () => state.preview !== null && state.previewOf === inputKey();

export const askAgain = () => emit("change");

export function startPreviews() {
    let timer = 0;
    for (const event of ["text", "change", "options"]) on(event, back);
    onFirst("change", () => {
        clearTimeout(timer);
        timer = 0;
        state.cancelled = null;
        preview.ask({ body: previewRequest(), key: inputKey(), since: performance.now() });
    });
    on("text", () => {
        clearTimeout(timer); // somebody may be typing
        timer = setTimeout(() => emit("change"), TYPING_MS);
    });
    mayChange(() => timer !== 0 || editing > 0 || preview.busy || rest !== null);
}
