// SPDX-License-Identifier: GPL-3.0-or-later
// The design: text of the editor, changes to it by way of the server, previews of it.
import { alike } from "./alike.js";
import { newest, onConnection, post } from "./api.js";
import { begin, inputKey, look, mayChange, requestKey, together } from "./belong.js";
import { announce } from "./dom.js";
import { takeEntered } from "./entering.js";
import { withValues } from "./model.js";
import { emit, on, onFirst, state } from "./store.js";

const TYPING_MS = 90; // that nothing is typed before an answer is asked for

let editor = null;
let changes = Promise.resolve(null); // one after the other: each needs the text that the last one made

export function useEditor(e) {
    editor = e;
}

/** list: [{path, value}] as /api/edit takes them; one step of the history. Until they are in the text they are part of the
 *  input. Returns the promise of why they were refused, or of null. */
export function edit(list, words) {
    state.edits.push(list);
    emit("entered");
    const end = begin({ words: "Changing the text" });
    const done = changes.then(async () => {
        let before, made;
        do { // again, where somebody has typed meanwhile
            before = state.text;
            made = await changed(before, list);
        } while (state.text !== before);
        state.edits.splice(state.edits.indexOf(list), 1);
        if (made.text !== undefined) {
            editor.replace(made.text);
            if (words) announce(words);
        } else refuse(made.why);
        emit("entered");
        end();
        return made.why ?? null;
    });
    changes = done.catch(() => null);
    return done;
}

/** {text} with these changes, or {why} there is none. Without the server values that stand in the text are changed here. */
async function changed(text, list) {
    try {
        const answer = await post("/api/edit", { text, changes: list });
        const good = typeof answer.text === "string" && (!answer.status || answer.status === "ok");
        return good ? { text: answer.text } : { why: answer.diagnostics?.[0]?.message ?? "the change cannot be made" };
    } catch (error) {
        if (!error.lost) return { why: error.message };
        const here = withValues(text, (name) => keyOf(name), list);
        return here !== null ? { text: here } : { why: `${error.status === 0 ? "the server does not answer" : "this session is over"}, and this page alone changes only values that stand in the text` };
    }
}

/** The attribute that names an element. */
const keyOf = (name) => state.table?.elements.find((e) => e.name === name)?.key ?? null;

/** Says that the text is not changed, and why. */
export function refuse(message) {
    emit("notice", { kind: "warn", text: `Not changed: ${message}.`.replace(/\.\.$/, ".") });
    emit("text", state.text); // fields show again what the text says
    return message;
}

/** What is typed in a field is taken, as when it is left, what is held as when it is let go, and all changes are in the text.
 *  Whoever makes something of the text that stays (a file, a job, a version) waits for it. Throws where something of it was
 *  refused. */
export async function taken() {
    const asked = takeEntered();
    if (anyHeld()) asked.push(letGoTogether(new Map(Object.entries(state.set)), "what is held is taken"));
    while (state.edits.length) await changes;
    const wrong = (await Promise.all(asked)).find((why) => why !== null);
    if (wrong) throw new Error(`what was entered is not taken: ${wrong}`);
}

/** Something is held by hand, by a slider or in the picture. */
export const anyHeld = () => Object.keys(state.set).length > 0;

/** A slider that is held: the value counts at once, the text gets it when it is let go, or taken before. */
export function hold(name, value) {
    state.set[name] = value;
    emit("change");
}

export async function letGo(name, value) {
    if (state.set[name] === undefined) return; // it was taken, and is not moved since
    const why = await edit([{ path: name, value }]);
    if (state.set[name] !== value) return; // it is held again
    delete state.set[name];
    emit("change");
    if (why) emit("text", state.text); // the slider goes back, too
}

/** Values that are held by hand in the picture, Map of path -> text, in place of those that were (keys). */
export function holdTogether(changes, before = []) {
    for (const path of before) delete state.set[path];
    for (const [path, value] of changes) state.set[path] = value;
    emit("change");
}

/** They become text, as one step of the history; with no changes they are as they were. Returns why not, or null. */
export async function letGoTogether(changes, words) {
    const why = changes.size ? await edit([...changes].map(([path, value]) => ({ path, value })), words) : null;
    for (const [path, value] of changes) if (state.set[path] === value) delete state.set[path]; // else it is held again
    emit("change");
    return why;
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

// What is held by hand changes many times a second, and a person looks at the picture: it is asked for alone first, which
// takes a tenth of what a verdict does. What is read comes with the preview.
const picture = newest(({ body }, signal) => post("/api/picture", body, { signal }), takePicture, () => {}, { words: null });
let asked = 0; // inputs, in their order
let pictured = 0; // that of the picture

// The preview waits for its picture, so that is asked for only where it takes little of the preview's time, and that much.
const WORTH_SHARE = 0.45;
const WORTH_S = 0.03;
const TRY_AGAIN = 50; // changes that were not asked for, after which the times may be others
const pictures = { name: null, alone_s: 0, skipped: 0 };

function worthAPicture() {
    const { name, cost } = state.preview;
    const whole_s = cost.read_s + cost.judge_s + cost.simulate_s;
    if (name !== pictures.name || pictures.skipped >= TRY_AGAIN) Object.assign(pictures, { name, alone_s: 0, skipped: 0 });
    const worth = whole_s > WORTH_S && pictures.alone_s < WORTH_SHARE * whole_s;
    pictures.skipped += Number(!worth);
    return worth;
}

function takePicture(answer, input) {
    if (answer.status !== "ok" || input.at <= pictured) return;
    pictures.alone_s = answer.cost.read_s + answer.cost.judge_s;
    state.same = null;
    show(answer, input);
    afterFrame(() => timed(input));
}

function show(answer, input) {
    pictured = input.at;
    state.picture = answer;
    state.pictureOf = input.key;
    together(() => emit("picture", answer));
}

/** Of an input the first of its pictures counts. */
function timed({ clock }) {
    if (clock.shown) return;
    clock.shown = true;
    state.latency.push(performance.now() - clock.since);
    if (state.latency.length > 400) state.latency.shift();
}

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
            if (why !== "cancelled" || input.key !== requestKey()) return;
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
    const errors = diagnostics.filter((d) => d.severity === "error");
    const still = errors.length > 0 && errors.every((d) => d.code === "FW-D202"); // nothing moves it yet: it is drawn all the same
    const shown = (answer.marks?.length > 0 || still) && answer.bodies?.length > 0; // or a layout that cannot be made
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
    if (input.at >= pictured) show(answer, input); // else a newer picture is there
    const mine = (rest = () => {
        if (rest !== mine) return; // a newer picture is there, and its rest is to come
        rest = null;
        together(() => {
            emit("preview", answer);
            told(answer, input, diagnostics);
        });
    });
    if (first || state.same || requestKey() === toldOf) rest(); // of the same device the picture stays, and its rest can come with it
    const another = !state.same; // than the picture that was there
    afterFrame(() => {
        if (another) timed(input);
        mine();
    });
}

// The picture first: what is read, lists and curves, comes in the frame behind it. Until then it is of the former input, and marked so.
let rest = null; // shows it
let toldOf = null; // input of the answer that all of the page showed last

/** Where the input is what the lists are of, the picture and they come together before anything is painted: all of the page is of one answer. */
function back() {
    if (rest && requestKey() === toldOf) rest();
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
    onConnection((error) => {
        const lost = error?.status ?? null;
        if (lost === state.lost) return;
        state.lost = lost;
        look();
    });
    for (const event of ["text", "change", "options"]) on(event, back);
    onFirst("change", () => {
        clearTimeout(timer);
        timer = 0;
        state.cancelled = null;
        const input = { key: requestKey(), at: ++asked, clock: { since: performance.now(), shown: false } };
        if (anyHeld() && state.preview?.cost && worthAPicture()) picture.ask({ ...input, body: request() });
        preview.ask({ ...input, body: previewRequest() });
    });
    on("text", () => {
        clearTimeout(timer); // somebody may be typing
        timer = setTimeout(() => emit("change"), TYPING_MS);
    });
    mayChange(() => timer !== 0 || state.edits.length > 0 || preview.busy || picture.busy || rest !== null);
}
