// SPDX-License-Identifier: GPL-3.0-or-later
// Named versions of the text, kept in the browser's store of this address, and the one that is pinned: its answer is
// computed with the present options, so that picture and numbers can be compared with the present ones.
import { newest, post } from "./api.js";
import { mayChange } from "./belong.js";
import { previewRequest } from "./design.js";
import { announce, button, h } from "./dom.js";
import { openDialog } from "./dialog.js";
import { emit, on, state } from "./store.js";

const STORE = "flexwright.versions";
const MOST = 40; // the oldest goes when there are more

/** [{name, at, device, word, text}], the newest first. */
export function versions() {
    try {
        const list = JSON.parse(localStorage.getItem(STORE) ?? "[]");
        return Array.isArray(list) ? list.filter((v) => ["name", "at", "text"].every((k) => typeof v?.[k] === "string")) : [];
    } catch {
        return [];
    }
}

function store(list) {
    try {
        localStorage.setItem(STORE, JSON.stringify(list.slice(0, MOST)));
        return true;
    } catch {
        emit("notice", { kind: "warn", stay: true, text: "The browser has no room for another version. Save it as a file, or take old versions away." });
        return false;
    }
}

/** A version of the present text; one of the same name is replaced. */
export function keep(name) {
    const word = state.summary?.length && state.preview?.verdict ? { accept: "accepted", reject: "rejected", inconclusive: "inconclusive" }[state.preview.verdict.verdict] ?? "" : "";
    const version = { name, at: new Date().toISOString(), device: state.preview?.name ?? "", word, text: state.text };
    return store([version, ...versions().filter((v) => v.name !== name)]) ? version : null;
}

export const drop = (name) => store(versions().filter((v) => v.name !== name));

// ---- the pinned one ----

const ask = newest(
    ({ body, version }, signal) => post("/api/preview", body, { signal }).then((answer) => ({ answer, version })),
    ({ answer, version }, { made }) => {
        if (state.pinned?.text !== version.text) return; // another was pinned meanwhile
        const good = answer.status === "ok" && answer.bodies?.length > 0;
        const why = good ? null : answer.diagnostics?.find((d) => d.severity === "error")?.message ?? "it cannot be computed";
        state.pinned = { ...state.pinned, preview: good ? answer : null, made: good ? made : null, why };
        emit("pinned", state.pinned);
    },
    (error) => {
        if (error.lost || !state.pinned) return;
        state.pinned = { ...state.pinned, preview: null, made: null, why: error.message };
        emit("pinned", state.pinned);
    }, { words: "Computing the pinned version" });
mayChange(() => ask.busy);

const compute = (version, made) => ask.ask({ body: { ...previewRequest(), text: version.text, set: {} }, version, made });

/** made: the full judgement of this very text, where it is known; null: nothing is pinned any more. */
export function pin(version, made = null) {
    ask.cancel();
    state.pinned = version && { name: version.name, text: version.text, preview: null, made: null, why: null };
    emit("pinned", state.pinned);
    if (!version) return announce("no version is pinned");
    compute(version, made);
    announce(`${version.name} is pinned`);
}
on("options", () => state.pinned && compute(state.pinned, null)); // compared with the same scene, method and accuracy

// ---- the dialog ----

/** judged(): the full judgement of the present text, or null. */
export function versionsDialog(editor, judged) {
    const list = h("div", { class: "version-list" });
    const name = h("input", { type: "text", "aria-label": "Name of the version", maxLength: 60, value: freeName() });
    const kept = () => {
        const words = name.value.trim();
        if (!words) return null;
        const version = keep(words);
        name.value = freeName();
        show();
        return version;
    };
    const dialog = openDialog("Versions", [
        h("p", {}, `Texts under names of yours, kept by this browser for ${location.host}: start the program with --port ${location.port} to find them again, or save what has to last as a file.`),
        h("form", { class: "row version-new", onsubmit: (e) => {
            e.preventDefault();
            kept();
        } }, h("label", { class: "option" }, h("span", {}, "the present text as"), name), button("Keep", { class: "small version-keep" }, kept),
        button("Keep and compare", { class: "small version-compare" }, () => {
            const made = judged();
            const version = kept();
            if (!version) return;
            pin(version, made);
            dialog.close();
        })), list,
    ], [state.pinned ? button("Compare no more", { class: "version-unpin" }, () => {
        pin(null);
        dialog.close();
    }) : null].filter(Boolean));

    function show() {
        const all = versions();
        list.replaceChildren(...(all.length ? all.map((v) => h("div", { class: "version" },
            h("div", {}, h("strong", {}, v.name), v.name === state.pinned?.name && v.text === state.pinned?.text ? h("span", { class: "chip open" }, "compared with") : null,
                h("span", { class: "doc" }, [v.device, v.word, when(v.at), v.text === state.text ? "the present text" : ""].filter(Boolean).join(" · "))),
            h("div", { class: "row" },
                button("Compare", { class: "small", "aria-label": `Compare with ${v.name}` }, () => {
                    pin(v);
                    dialog.close();
                }),
                button("Put back", { class: "small", "aria-label": `Put back ${v.name}` }, () => {
                    editor.replace(v.text);
                    announce(`${v.name} is back; undo brings the other`);
                    dialog.close();
                }),
                button("Remove", { class: "small quiet", "aria-label": `Remove ${v.name}` }, () => {
                    drop(v.name);
                    show();
                }))))
            : [h("p", { class: "empty" }, "No version is kept yet.")]));
    }
    show();
    name.select();
}

function freeName() {
    const taken = new Set(versions().map((v) => v.name));
    for (let i = 1; ; i++) if (!taken.has(`version ${i}`)) return `version ${i}`;
}

const when = (iso) => new Date(iso).toLocaleString(undefined, { dateStyle: "short", timeStyle: "short" });
