// SPDX-License-Identifier: GPL-3.0-or-later
// The file on disk: read at the start, followed while another program edits it, saved. Nothing that somebody wrote is
// lost without a word: what was not saved is kept (drafts.js), and where two have written, both sides are shown.
import { get, post } from "./api.js";
import { anotherDevice } from "./belong.js";
import { anyHeld, taken } from "./design.js";
import { openDialog } from "./dialog.js";
import { bothSides } from "./diff.js";
import { announce, button, h } from "./dom.js";
import { keep, kept } from "./drafts.js";
import { notice } from "./notices.js";
import starter from "./starter.xml"; // what `flexwright init` prints
import { emit, on, state } from "./store.js";

// ---- line ends: the editor has "\n" only, the file keeps its own ----

function read(answer) {
    const ends = answer.text.match(/\r\n|\r|\n/g) ?? [];
    const crlf = ends.filter((e) => e === "\r\n").length;
    const eol = 2 * crlf > ends.length ? "\r\n" : "\n";
    return { ...answer, text: answer.text.replace(/\r\n?/g, "\n"), eol, mixed: ends.some((e) => e !== eol) };
}

const written = (text) => (state.file?.eol === "\r\n" ? text.replaceAll("\n", "\r\n") : text);

/** The text is another one than the file's. */
export const changed = () => state.text !== (state.file === null ? state.base : state.file.text);

/** There is something here that is nowhere else, be it in the text, still in a field or held by hand. */
export const unsaved = () => changed() || state.entered.size > 0 || state.edits.length > 0 || anyHeld();

// ---- start ----

export async function startFile(editor) {
    state.file = null;
    if (state.session.file !== null) {
        try {
            state.file = read(await get("/api/file"));
        } catch (error) {
            if (error.lost) throw error;
            state.file = { name: state.session.file, version: "", text: "", eol: "\n", writable: true, gone: error.message };
        }
    }
    state.base = starter;
    editor.open(state.file?.text ?? starter);
    if (state.file?.mixed) mixedEnds();
    if (state.file?.gone) tellGone(state.file.gone);
    await restore(editor);
    on("text", keepText);
    emit("file");
}

/** What is on the page and in no file that is watched is kept; without a file that is all but the starter, which anybody can begin with again. */
function keepText() {
    if (state.file) return keep(state.text, changed() ? state.file.version : null);
    keep(state.text, state.text === starter ? null : changed() ? "" : state.baseIs);
}

/** What the text that was not changed since is without a file: where else it may be, and what is said of it when it is back. */
const BASES = {
    downloaded: "The text is back that was downloaded last. It is no file here: what you change is in no file until it is downloaded again.",
    opened: "The text is back that was opened last. It is no file here: what you change is in no file until it is downloaded.",
};

function mixedEnds() {
    notice({ kind: "info", stay: true, text: `${state.file.name} mixes line ends; saving writes all of them as ${state.file.eol === "\n" ? "LF" : "CR LF"}.` });
}

let back = null; // the strip that says that a draft is back, until somebody has answered or all of it is saved

async function restore(editor) {
    const draft = await kept();
    if (!draft || draft.text === state.text) return;
    if (state.file && draft.version !== state.file.version) return conflict(editor, state.file, draft.text);
    const before = state.text;
    if (!state.file && draft.version in BASES) {
        Object.assign(state, { base: draft.text, baseIs: draft.version });
        editor.open(draft.text);
        back = notice({ kind: "info", stay: true, text: BASES[draft.version], actions: [["Begin anew instead", () => replaceAll(editor, before, "Begin anew")], ["Keep it", () => {}]] });
        return;
    }
    editor.replace(draft.text);
    back = notice({ kind: "info", stay: true, text: "Changes that were not saved are back.", actions: [[state.file ? "Take the file's instead" : "Begin anew instead", () => editor.replace(before)], ["Keep them", () => {}]] });
}

// ---- the file changes on disk ----

let gone = null; // the strip that says so

function tellGone(why) {
    gone?.remove();
    gone = notice({ kind: "warn", stay: true, text: `${state.file.name} ${why}. The text is kept here; Save writes it anew where nothing is in the way.` });
}

/** event: what the server says of the file: {version}, or {version: null, why}. */
export async function follow(editor, event) {
    if (!state.file) return;
    if (event.version === null) {
        state.file = { ...state.file, gone: event.why };
        tellGone(event.why);
        return emit("file");
    }
    let now;
    try {
        now = read(await get("/api/file"));
    } catch {
        return; // it is gone for a moment while an editor writes it, or the connection is
    }
    const back = state.file.gone !== undefined;
    gone?.remove();
    gone = null;
    if (now.version === state.file.version) {
        if (back) state.file = now;
        return emit("file");
    }
    if ((saving !== null && now.text === saving) || now.version === open?.now.version) return; // known already
    if (!changed() || state.text === now.text) { // what is typed in a field stays there
        state.file = now;
        editor.replace(now.text);
        settle();
        announce(`${now.name} has changed on disk and was read again`);
        emit("notice", { kind: "info", text: `${now.name} has changed on disk and was read again.` });
    } else conflict(editor, now, state.text);
    emit("file");
}

// ---- two have written ----

let open = null; // {editor, now, mine, strip} while nobody has answered

function settle() {
    open?.strip.remove();
    answered();
    open = null;
    keep(state.text, changed() ? state.file.version : null);
}

/** Until somebody has answered, nothing is written over the file, and the text here stays. */
function conflict(editor, now, mine) {
    open?.strip.remove();
    if (state.text !== mine) editor.replace(mine);
    open = { editor, now };
    open.strip = notice({
        kind: "warn", stay: true, text: `${now.name} has changed on disk, and so has the text here.`,
        actions: [["Take the file's", () => takeTheirs()], ["Keep mine", () => keepMine()], ["Show both", () => showBoth(), { stay: true }]], dismiss: false,
    });
}

function takeTheirs() {
    const { editor, now } = open;
    state.file = now;
    editor.replace(now.text); // mine is one undo away
    settle();
    emit("file");
}

function keepMine() {
    state.file = open.now;
    settle();
    emit("file");
}

function showBoth() {
    const { now } = open;
    if (document.querySelector("dialog[open]")) return; // it stands there already
    const done = (act) => () => {
        dialog.close();
        if (open?.now === now) act();
    };
    const dialog = openDialog("Two have changed this file", [
        h("p", {}, `Left the text here, right ${now.name} as it is on disk. Taking the file's is one undo away from yours; keeping yours lets Save write over the file's.`),
        bothSides(["here", state.text], [`${now.name} on disk`, now.text]),
    ], [button("Take the file's", { class: "take-theirs" }, done(takeTheirs)), button("Keep mine", { class: "keep-mine" }, done(keepMine)), button("Later", {}, () => dialog.close())]);
    dialog.classList.add("wide-dialog");
}

// ---- open and save ----

/** Without a file on disk: a text of the user's, read by the browser. */
export function openText(editor) {
    const input = document.createElement("input");
    input.type = "file";
    input.accept = ".xml,application/xml,text/xml";
    input.addEventListener("change", async () => {
        const file = input.files[0];
        if (!file) return;
        const { text } = read({ text: await file.text() });
        replaceAll(editor, text, `Open ${file.name}`);
    });
    input.click();
}

/** Another text in place of this one; where something would be lost, it asks. */
export function replaceAll(editor, text, words) {
    const go = () => {
        Object.assign(state, { base: text, baseIs: "opened" });
        anotherDevice(text);
        editor.open(text);
        answered();
        keepText();
        emit("file");
    };
    if (!unsaved()) return go();
    const dialog = openDialog(`${words}?`, [h("p", {}, "The text here has changes that were not saved. They would be gone.")], [
        button("Save them first", { class: "primary" }, () => {
            dialog.close();
            save(editor).then(() => unsaved() || go());
        }),
        button("Drop them", { class: "drop" }, () => {
            dialog.close();
            go();
        }), button("Cancel", { class: "cancel" }, () => dialog.close())]);
}

let saving = null;

export async function save(editor) {
    try {
        await taken();
    } catch (error) {
        return void emit("notice", { kind: "bad", stay: true, text: `Not saved: ${error.message}` });
    }
    if (state.file === null) return download();
    if (open) return showBoth(); // nobody has answered yet
    const text = (saving = state.text);
    try {
        const answer = await post("/api/file", { text: written(text), version: state.file.version });
        const { gone: was, ...file } = state.file;
        state.file = { ...file, text, version: answer.version, mixed: false };
        gone?.remove();
        settle();
        announce("saved");
        emit("notice", { kind: "info", text: `Saved ${state.file.name}.` });
    } catch (error) {
        if (error.status === 409 && error.body?.text !== undefined) {
            conflict(editor, read(error.body), state.text);
            showBoth();
        } else emit("notice", { kind: "bad", stay: !error.lost, text: `Not saved: ${error.message}` });
    } finally {
        saving = null;
    }
    emit("file");
}

/** Without a file on disk it goes where the browser puts what is downloaded. */
function download() {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([state.text], { type: "application/xml" }));
    link.download = `${/<device[^>]*?\sname="([\w.-]+)"/.exec(state.text)?.[1] ?? "device"}.xml`;
    link.click();
    Object.assign(state, { base: state.text, baseIs: "downloaded" });
    answered();
    keepText();
    emit("file");
}

/** Nothing is left to be said of what came back. */
function answered() {
    back?.remove();
    back = null;
}
