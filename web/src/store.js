// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of the page share. The text of the editor is the only state of the design: everything
// else here is either how it is looked at (options, theme, time) or an answer to that text.

export const state = {
    text: "",
    session: null, // flexwright.session/1
    table: null, // flexwright.table/1
    file: null, // {name, version, text (as on disk, but for line ends), eol, writable, gone: why it cannot be read}
    base: "", // without a file: the text that was opened or downloaded last
    baseIs: "opened", // what that text is: "opened", "downloaded"
    set: {}, // values that are held by hand, by a slider or in the picture, and not in the text yet: path -> text
    entered: new Map(), // path -> what is typed in its field and not in the text yet (entering.js)
    edits: [], // changes of the text that are under way, as /api/edit takes them
    lost: null, // status of the failure since which the server does not answer, or answers this session no more
    lab: {}, // laboratory packs that are in use: name -> text
    labRows: {}, // what is entered of them: flow -> id -> {value, u, status}
    labSources: {}, // where they are from: flow -> words
    options: {}, // scene, method, integrator, stabilise, rtol, accuracy, effects, hinge_model
    rates: false, // velocities of the motion are looked at, and asked for
    preview: null, // last good flexwright.preview/1
    previewOf: null, // its input (belong.js)
    picture: null, // what the picture shows: that answer, or the picture alone of a newer input, flexwright.picture/1
    pictureOf: null, // its input
    same: null, // the answer before it, where both are of one device: whoever shows that one shows this one
    answered: null, // input of the last answer, good or not: that of the diagnostics
    cancelled: null, // input whose answer nobody waits for any more
    diagnostics: [],
    pinned: null, // version that is compared with: {name, text, preview, made, why: it has no answer}
    judged: () => null, // the full judgement of the present text, or null (verdict.js)
    summary: null, // first lines of the verdict that is shown
    hinge: null, // id of the hinge that is looked at
    flow: "", // whose utilisation is shown; "": the worst of all
    latency: [], // ms from a change to its picture, of the last ones
};

/** What this tab has kept under a name, also from before it was loaded anew; a store that is closed keeps nothing. */
export function keptOfTab(name) {
    try {
        return JSON.parse(sessionStorage.getItem(name) ?? "{}");
    } catch {
        return {};
    }
}

export function keepOfTab(name, value) {
    try {
        sessionStorage.setItem(name, JSON.stringify(value));
    } catch {
        // it is closed, or full
    }
}

const bus = new EventTarget();
export const on = (name, f) => bus.addEventListener(name, (e) => f(e.detail));
/** Before all others: what the server does meanwhile takes longer than they do. */
export const onFirst = (name, f) => bus.addEventListener(name, (e) => f(e.detail), { capture: true });
export const emit = (name, detail) => bus.dispatchEvent(new CustomEvent(name, { detail }));

/** Names of events: "text" (editor's text changed), "another" (it is about to be of another device), "change" (ask for a preview), "entered" (typed, and in no text yet), "options" (how it is
 *  computed), "picture" (state.picture is another one), "preview" (a good answer, a frame behind its picture: of the rest), "answer" (any answer), "belong" (what is shown was marked anew), "working"
 *  (what is on its way), "hinge" (looked at), "pinned" (a version, or its answer), "judged" (as made), "jobs" (any job), "view" (a tab was chosen), "time" (of the motion, by hand), "lab" (packs in use), "theme". */
export function lookAt(hinge) {
    state.hinge = state.hinge === hinge ? null : hinge;
    emit("hinge", state.hinge);
}
