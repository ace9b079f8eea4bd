// SPDX-License-Identifier: GPL-3.0-or-later
// The file on disk: read at the start, followed while another program edits it, saved.
import { get, post } from "./api.js";
import { announce } from "./dom.js";
import { notice } from "./notices.js";
import starter from "./starter.xml"; // what `flexwright init` prints
import { emit, on, state } from "./store.js";


export async function startFile(editor) {
    state.file = state.session.file === null ? null : await get("/api/file");
    editor.open(state.file?.text ?? starter);
    restore(editor);
    on("text", keep);
    emit("file");
}

// ---- what was not saved survives a reload and a server that was started anew on the same port ----

const KEPT = "unsaved";

function keep() {
    try {
        if (state.file && state.text !== state.file.text) sessionStorage.setItem(KEPT, JSON.stringify([state.file.version, state.text]));
        else sessionStorage.removeItem(KEPT);
    } catch {
        // no room: it is only a comfort
    }
}

function restore(editor) {
    let kept = null;
    try {
        kept = JSON.parse(sessionStorage.getItem(KEPT));
    } catch {
        return;
    }
    if (!state.file || !kept || kept[0] !== state.file.version || kept[1] === state.file.text) return;
    editor.replace(kept[1]);
    notice({ kind: "info", stay: true, text: "Changes that were not saved are back.", actions: [["Take the file's instead", () => editor.replace(state.file.text)], ["Keep them", () => {}]] });
}

/** The file has changed: follow it, unless there are changes here that would be lost. */
export async function follow(editor) {
    let now;
    try {
        now = await get("/api/file");
    } catch {
        return; // it is gone for a moment while an editor writes it, or the connection is
    }
    if (state.file && now.version === state.file.version) return;
    if (saving && now.text === saving) return;
    const mine = state.file !== null && state.text !== state.file.text;
    state.file = now;
    if (!mine || state.text === now.text) {
        editor.replace(now.text);
        announce(`${now.name} has changed on disk and was read again`);
        emit("notice", { kind: "info", text: `${now.name} has changed on disk and was read again.` });
    } else conflict(editor, now);
    emit("file");
}

function conflict(editor, now) {
    notice({
        kind: "warn", stay: true, text: `${now.name} has changed on disk, and so has the text here.`,
        actions: [["Take the file's", () => editor.replace(now.text)], ["Keep mine", () => {}]],
    });
}

/** Without a file on disk: a text of the user's, read by the browser. */
export async function openText(editor) {
    const input = document.createElement("input");
    input.type = "file";
    input.accept = ".xml,application/xml,text/xml";
    input.addEventListener("change", async () => {
        if (input.files[0]) editor.open(await input.files[0].text());
    });
    input.click();
}

let saving = null;

export async function save(editor) {
    if (state.file === null) {
        const link = document.createElement("a");
        link.href = URL.createObjectURL(new Blob([state.text], { type: "application/xml" }));
        link.download = `${state.preview?.name ?? "device"}.xml`;
        link.click();
        return;
    }
    const text = (saving = state.text);
    try {
        const answer = await post("/api/file", { text, version: state.file.version });
        state.file = { ...state.file, text, version: answer.version };
        keep();
        announce("saved");
        emit("notice", { kind: "info", text: `Saved ${state.file.name}.` });
    } catch (error) {
        if (error.status === 409 && error.body?.text !== undefined) {
            state.file = { ...state.file, text: error.body.text, version: error.body.version };
            conflict(editor, state.file);
        } else if (!error.lost) emit("notice", { kind: "bad", text: `Not saved: ${error.message}` });
    } finally {
        saving = null;
    }
    emit("file");
}
