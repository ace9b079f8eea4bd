// SPDX-License-Identifier: GPL-3.0-or-later
// What was not saved: kept in this tab at once, and on the server a moment later, so that it survives a reload, a page
// that is closed and a server that is started anew.
import { get, onConnection, post, remove } from "./api.js";

const KEPT = "unsaved"; // in the tab
const LATER_MS = 400;

let timer = 0;
let onServer = false;
let unsent = null; // what the server was not there for

/** version: of the file that the text began from, "" without a file; null: nothing is to be kept. */
export function keep(text, version) {
    try {
        if (version === null) sessionStorage.removeItem(KEPT);
        else sessionStorage.setItem(KEPT, JSON.stringify([version, text]));
    } catch {
        // no room in the tab: the server has it in a moment
    }
    clearTimeout(timer);
    unsent = null;
    timer = setTimeout(() => (version === null ? drop() : send(text, version)), LATER_MS);
}

async function send(text, version) {
    try {
        await post("/api/draft", { text, version });
        onServer = true;
        unsent = null;
    } catch (error) {
        unsent = error.lost ? [text, version] : null; // or it has no place: the tab has it
    }
}

async function drop() {
    if (!onServer) return;
    try {
        await remove("/api/draft");
        onServer = false;
    } catch {
        // it is offered once more, and is the same as the file
    }
}

onConnection((error) => {
    if (error || !unsent) return;
    const again = unsent;
    unsent = null;
    send(...again);
});

/** {version, text} of what was kept last, or null. */
export async function kept() {
    let mine = null;
    try {
        mine = JSON.parse(sessionStorage.getItem(KEPT));
    } catch {
        // not ours
    }
    const there = await get("/api/draft").catch(() => null);
    onServer = typeof there?.text === "string";
    if (Array.isArray(mine) && mine.every((x) => typeof x === "string")) return { version: mine[0], text: mine[1] };
    return onServer ? there : null;
}
