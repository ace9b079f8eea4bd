// SPDX-License-Identifier: GPL-3.0-or-later
// What the user has to know now: a strip below the header.
import { openSession } from "./api.js";
import { taken } from "./design.js";
import { $, button, h } from "./dom.js";
import { emit, state } from "./store.js";

const RETRY_MS = 2000;
const SHOWN_MS = 6000;
let lost = null;

/** passing: it goes by itself, and lies over the page: nothing under the pointer moves away for it. */
function strip(kind, content, actions = [], passing = false) {
    const box = h("div", { class: `notice ${kind}` }, h("div", {}, content), h("div", { class: "notice-actions" }, actions));
    let holder = $("notices");
    if (passing) holder = holder.querySelector(".passing") ?? holder.appendChild(h("div", { class: "passing" }));
    holder.append(box);
    return box;
}

/** {kind: "info" | "warn" | "bad", text, actions: [[label, function, {stay: it does not end the notice}]], stay,
 *  dismiss: may go without an answer} */
export function notice({ kind = "info", text, actions = [], stay = false, dismiss = true }) {
    for (const former of $("notices").querySelectorAll(".notice")) if (former.says === text) former.remove(); // said once, and of now
    const passing = !stay && !actions.length;
    const box = strip(kind, text, [
        ...actions.map(([label, act, how]) => button(label, { class: "small" }, () => {
            if (!how?.stay) box.remove();
            act();
        })),
        dismiss ? button("Dismiss", { icon: "close", hidden: true, class: "quiet" }, () => box.remove()) : null,
    ], passing);
    box.says = text;
    if (passing) setTimeout(() => box.remove(), SHOWN_MS);
    return box;
}

async function keep() {
    await taken().catch(() => {}); // what is refused is told, and the text is saved all the same: there may be no other time
    const link = h("a", { download: state.file?.name ?? "device.xml", href: URL.createObjectURL(new Blob([state.text ?? ""], { type: "application/xml" })) });
    document.body.append(link);
    link.click();
    link.remove();
}

/** The server or the session is gone (error), or back (null). */
export function connection(error) {
    if (!error) {
        if (!lost) return;
        lost.remove();
        lost = null;
        notice({ kind: "info", text: "The server answers again." });
        emit("change");
        return;
    }
    if (lost && (lost.status === error.status || error.status === 0)) return;
    lost?.remove();
    const text = error.status === 0
        ? "The server does not answer. Your text is kept in this page; it goes on when the server does. If you have started it anew, open the address that it printed."
        : "This session is over. Open the address that flexwright serve printed last.";
    lost = strip("bad", [text], [
        button("Try again", { class: "small" }, retry),
        state.text ? button("Save the text as a file", { class: "small" }, keep) : null,
    ]);
    lost.status = error.status;
    if (error.status === 0) setTimeout(retry, RETRY_MS);
}

async function retry() {
    if (!lost) return;
    try {
        await openSession();
    } catch (error) {
        if (lost && error.status === 0) setTimeout(retry, RETRY_MS); // a session that is over stays over
    }
}
