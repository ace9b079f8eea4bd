// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the page together: session, file, editor, form, views, verdict.
import { about } from "./about.js";
import { Accuracy } from "./accuracy.js";
import { startAddress } from "./address.js";
import { get, onConnection, openSession } from "./api.js";
import { download } from "./archive.js";
import { Assembly } from "./assembly.js";
import { requestKey, settled } from "./belong.js";
import { busySign } from "./busy.js";
import { startPreviews, taken, useEditor } from "./design.js";
import { $, become, button, h, s, say } from "./dom.js";
import { Draw } from "./draw.js";
import { Editor } from "./editor.js";
import { Explore } from "./explore.js";
import { follow, openText, save, startFile, unsaved } from "./file.js";
import { Form } from "./form.js";
import { controlsOf, helpDialog } from "./help.js";
import { heard } from "./jobs.js";
import { restorePacks } from "./laboratory.js";
import { Masks } from "./masks.js";
import { Modes } from "./modes.js";
import { Motion } from "./motion.js";
import { connection, notice } from "./notices.js";
import { Recipe } from "./recipe.js";
import { emit, on, state } from "./store.js";
import { makeTabs } from "./tabs.js";
import { newDevice } from "./templates.js";
import { startTheme, themeButton } from "./theme.js";
import { Verdict } from "./verdict.js";
import { versionsDialog } from "./versions.js";
import { Workspace } from "./workspace.js";

startTheme();
const parts = {};

// ---- the header ----

/** What is typed in a field or held by hand is in the text before. Where it is refused, that is said, and the field has the text's value again. */
const afterTaken = (act) => taken().then(act, () => {});

function header() {
    const mark = s("svg", { viewBox: "0 0 32 32", class: "mark", "aria-hidden": "true" },
        s("path", { d: "M5 24h6M21 8h6", class: "mark-body" }), s("path", { d: "M11 24c7 0 9.5-3 9.5-7.5S17 9 13.5 11.5 12.5 19 17 18.5 20 8 22 8", class: "mark-hinge" }));
    parts.device = h("span", { class: "device-name", id: "device-name" });
    parts.file = h("span", { class: "file-state", id: "file-state" });
    parts.undo = button("Undo", { icon: "undo", hidden: true, id: "undo" }, () => afterTaken(() => parts.editor.undo()));
    parts.redo = button("Redo", { icon: "redo", hidden: true, id: "redo" }, () => afterTaken(() => parts.editor.redo()));
    parts.fresh = button("New…", { icon: "plus", id: "new" }, () => afterTaken(() => newDevice(parts.editor)));
    parts.open = button("Open", { icon: "open", id: "open" }, () => afterTaken(() => openText(parts.editor)));
    parts.open.hidden = true;
    parts.save = button("Save", { icon: "save", id: "save" }, () => save(parts.editor));
    $("top").append(
        h("h1", { class: "brand" }, mark, h("span", {}, "Flexwright")), parts.device, parts.file, h("span", { class: "space" }), busySign(),
        parts.fresh, parts.undo, parts.redo,
        button("Versions: keep, compare", { icon: "versions", hidden: true, id: "versions" }, () => afterTaken(() => versionsDialog(parts.editor, () => parts.verdict.judged))), parts.open, parts.save,
        button("Plan and download", { icon: "download", id: "download", class: "primary" }, download),
        button("Print", { icon: "print", hidden: true, class: "quiet" }, () => window.print()), themeButton(),
        button("Help", { icon: "question", hidden: true, class: "quiet", id: "help" }, () => helpDialog($(`tab-${parts.tabs.current}`).textContent, $(`panel-${parts.tabs.current}`))),
        button("About", { icon: "info", hidden: true, class: "quiet", id: "about" }, about));
}

function headerState() {
    const [undos, redos] = parts.editor.depths;
    parts.undo.disabled = undos === 0;
    parts.redo.disabled = redos === 0;
    const changed = unsaved();
    const gone = state.file?.gone !== undefined;
    parts.save.disabled = state.file === null ? false : (!changed && !gone) || state.file.writable === false;
    const apart = state.baseIs === "downloaded" ? changed ? "changed since it was downloaded, not a file" : "downloaded, not a file" : `not a file${changed ? ", changed" : ""}`;
    const where = state.file === null ? apart : `${state.file.name}${gone ? ", not on disk" : changed ? ", changed" : ""}`;
    say(parts.file, where);
    parts.file.classList.toggle("changed", changed);
    say(parts.device, parts.form.name);
    become(document, { title: `${changed && state.file ? "• " : ""}${parts.form.name || "Flexwright"} – Flexwright` });
}

// ---- the three areas ----

function editArea() {
    const form = h("div", { class: "form-holder" });
    const xml = h("div", { class: "xml-holder" });
    const editor = h("div", { class: "editor", id: "editor" });
    const list = h("div", { class: "xml-problems" });
    xml.append(editor, list);
    parts.editTabs = makeTabs("Description", [{ id: "form", label: "Form", panel: form }, { id: "xml", label: "XML", panel: xml }],
        { onselect: (id) => {
            document.body.classList.toggle("text-shown", id === "xml");
            parts.editor?.show(id === "xml");
            emit("view", id);
        } });
    $("edit").append(parts.editTabs.bar, form, xml);
    parts.editor = new Editor(editor, {
        onchange: (text) => {
            state.text = text;
            emit("text", text);
            headerState();
        },
    });
    useEditor(parts.editor);
    parts.form = new Form(form);
    parts.editTabs.select("form");
    on("answer", () => { // places in another text are none in this one
        if (state.answered === requestKey()) parts.editor.mark(state.diagnostics.filter((d) => d.in_text !== false));
    });
}

function views() {
    const names = [["motion", "Motion", Motion], ["draw", "Draw", Draw], ["workspace", "Workspace", Workspace], ["modes", "Modes", Modes], ["assembly", "Assembly", Assembly],
        ["masks", "Masks", Masks], ["recipe", "Recipe", Recipe], ["explore", "Explore", Explore], ["accuracy", "Accuracy", Accuracy]];
    const panels = names.map(([id, label]) => ({ id, label, panel: h("div", { class: `view view-${id}` }) }));
    const tabs = makeTabs("Views", panels, {
        onselect: (id) => {
            for (const [name] of names) parts[name]?.shown?.(name === id);
            emit("view", id);
        },
    });
    $("centre").append(tabs.bar, ...panels.map((p) => p.panel));
    names.forEach(([id, , View], i) => (parts[id] = new View(panels[i].panel)));
    tabs.select("motion");
    parts.tabs = tabs;
}

// ---- keys ----

document.addEventListener("keydown", (e) => {
    if (!(e.ctrlKey || e.metaKey)) return;
    const inEditor = e.composedPath().some((x) => x === $("editor"));
    if (e.key === "s") {
        e.preventDefault();
        save(parts.editor);
    } else if (!inEditor && e.key.toLowerCase() === "z") {
        if (document.activeElement?.dataset.dirty) return; // a field that is being typed in undoes its own letters
        e.preventDefault();
        afterTaken(() => parts.editor[e.shiftKey ? "redo" : "undo"]());
    } else if (!inEditor && e.key === "y") {
        e.preventDefault();
        afterTaken(() => parts.editor.redo());
    }
});

window.addEventListener("beforeunload", (e) => {
    if (unsaved()) e.preventDefault();
});

document.addEventListener("jump", (e) => {
    parts.editTabs.select("xml");
    parts.editor.jump(e.detail.line, e.detail.column);
});
on("show-xml", ([from, to]) => {
    parts.editTabs.select("xml");
    parts.editor.select(from, to);
});

on("show-view", (id) => parts.tabs.select(id));
on("show-form", (path) => {
    parts.editTabs.select("form");
    parts.form.reveal(path);
});

// ---- start ----

const MOST_WAIT_MS = 30000;

function listen(wait = 1500) {
    const stream = new EventSource("/api/events");
    stream.addEventListener("open", () => (wait = 1500));
    stream.addEventListener("file", (e) => follow(parts.editor, JSON.parse(e.data)));
    stream.addEventListener("job", (e) => heard(JSON.parse(e.data)));
    stream.addEventListener("error", () => {
        if (stream.readyState !== EventSource.CLOSED) return;
        setTimeout(async () => {
            try {
                await openSession();
                listen(Math.min(2 * wait, MOST_WAIT_MS)); // four pages may listen; this one may be the fifth
            } catch (error) {
                if (error.status === 0) setTimeout(listen, wait);
            }
        }, wait);
    });
}

async function start() {
    header();
    editArea();
    views();
    parts.verdict = new Verdict($("right"));
    for (const event of ["file", "entered", "change"]) on(event, headerState);
    on("notice", notice);
    onConnection(connection);
    startPreviews();
    state.session = await openSession();
    state.table = await get("/api/table");
    parts.form.start(state.table);
    parts.editor.help(state.table, parts.form);
    parts.motion.start(state.table);
    parts.draw.start(state.table);
    parts.explore.start(state.table, parts.form);
    parts.open.hidden = state.session.file !== null;
    restorePacks();
    await startFile(parts.editor);
    startAddress(parts);
    headerState();
    listen();
    document.body.dataset.ready = "yes";
}

start().catch((error) => {
    if (error.lost) connection(error);
    else {
        notice({ kind: "bad", text: `The page could not start: ${error.message}` });
        throw error;
    }
});

parts.unexplained = (id) => controlsOf($(`panel-${id}`)).filter((x) => !x.sentence).map((x) => x.name);

// for the tests of the page, which look and do not touch
globalThis.flexwright = { state, parts, on, settled };
