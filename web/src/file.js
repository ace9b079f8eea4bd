// SPDX-License-Identifier: GPL-3.0-or-later
// The file on disk: read at the start, followed while another program edits it, saved.
import { get, post } from "./api.js";
import { announce } from "./dom.js";
import { notice } from "./notices.js";
import { emit, state } from "./store.js";

const STARTER = `<?xml version="1.0" encoding="UTF-8"?>
<device xmlns="urn:flexwright:device:1" name="new-device">
</device>
`;

export async function startFile(editor) {
    try {
        state.file = await get("/api/file");
        editor.open(state.file.text);
    } catch (error) {
        if (error.status !== 404) throw error;
        state.file = null;
        editor.open(STARTER);
    }
    emit("file");
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
