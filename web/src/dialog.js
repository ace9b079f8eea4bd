// SPDX-License-Identifier: GPL-3.0-or-later
import { button, h } from "./dom.js";

/** A modal dialog; the browser keeps the focus inside and closes it with Escape. */
export function openDialog(title, content, actions) {
    const body = h("div", { class: "dialog-body" }, content);
    const foot = h("div", { class: "dialog-foot" }, actions);
    const dialog = h("dialog", { "aria-labelledby": "dialog-title" }, h("header", {}, h("h2", { id: "dialog-title" }, title), button("Close", { icon: "close", hidden: true, class: "quiet" }, () => {
        dialog.dispatchEvent(new Event("cancel"));
        dialog.close();
    })), body, foot);
    dialog.setContent = (c, a) => {
        body.replaceChildren(...c.filter(Boolean));
        foot.replaceChildren(...a.filter(Boolean));
    };
    dialog.addEventListener("close", () => setTimeout(() => dialog.remove()));
    document.body.append(dialog);
    dialog.showModal();
    return dialog;
}
