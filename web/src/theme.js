// SPDX-License-Identifier: GPL-3.0-or-later
import { button, icon } from "./dom.js";
import { emit } from "./store.js";

const system = matchMedia("(prefers-color-scheme: dark)");
let chosen = null; // what the user has switched to; null: as the system

function read() {
    try {
        return localStorage.getItem("theme");
    } catch {
        return null;
    }
}

let printing = false; // paper is light

function apply() {
    const theme = printing ? "light" : chosen ?? (system.matches ? "dark" : "light");
    document.documentElement.dataset.theme = theme;
    emit("theme", theme);
}

export function startTheme() {
    chosen = read();
    apply();
    system.addEventListener("change", apply);
    for (const [event, on] of [["beforeprint", true], ["afterprint", false]])
        window.addEventListener(event, () => {
            printing = on;
            apply();
        });
}

export function themeButton() {
    const b = button("Dark or light", { icon: "moon", hidden: true, class: "quiet", id: "theme" }, () => {
        chosen = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
        try {
            localStorage.setItem("theme", chosen);
        } catch {
            // it holds for this visit
        }
        apply();
        b.replaceChildren(icon(chosen === "dark" ? "sun" : "moon"));
    });
    b.replaceChildren(icon(document.documentElement.dataset.theme === "dark" ? "sun" : "moon"));
    return b;
}
