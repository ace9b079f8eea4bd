// SPDX-License-Identifier: GPL-3.0-or-later
import { openDialog } from "./dialog.js";
import { h } from "./dom.js";
import { number } from "./format.js";
import { state } from "./store.js";

// What is in page.js beside this project's own modules; web/package-lock.json has the versions.
const LIBRARIES = [
    ["CodeMirror 6", "editor of the XML text", "MIT", "Marijn Haverbeke and others"],
    ["Lezer", "parser of the XML text", "MIT", "Marijn Haverbeke and others"],
    ["crelt, style-mod, w3c-keyname", "parts of CodeMirror", "MIT", "Marijn Haverbeke and others"],
    ["uPlot", "curves over time", "MIT", "Leon Sorokin"],
];

export function about() {
    const sorted = [...state.latency].sort((a, b) => a - b);
    const at = (q) => sorted[Math.min(Math.floor(sorted.length * q), sorted.length - 1)];
    openDialog("About Flexwright", [
        h("p", {}, `Version ${state.session?.version ?? "?"}. From one description of a compliant micromanipulator to a verdict, masks and fabrication recipes. This page talks to the program on this machine and to nothing else.`),
        h("p", {}, "Flexwright is free software under the GNU General Public License, version 3 or later."),
        h("p", {}, h("a", { href: "/help/page.html", target: "_blank", rel: "noopener" }, "The documentation"), ", of this version and without network: this page, tutorial, device description, diagnostics, and more."),
        h("h3", {}, "Libraries in this page"),
        h("table", { class: "plain" }, h("thead", {}, h("tr", {}, ["library", "for", "licence", "by"].map((x) => h("th", { scope: "col" }, x)))),
            h("tbody", {}, LIBRARIES.map((row) => h("tr", {}, row.map((x) => h("td", {}, x)))))),
        h("p", {}, h("a", { href: "/licences.txt", target: "_blank", rel: "noopener" }, "Their licences in full")),
        h("h3", {}, "Keys"),
        h("table", { class: "plain keys" }, h("tbody", {}, [
            ["Ctrl S", "save"], ["Ctrl Z, Ctrl Shift Z", "undo, redo: for form, sliders and text alike"], ["+ − 0, arrows", "zoom, fit, pan, in a picture"],
            ["arrows, [ ]", "move and turn the platform, on its handle; Shift: ten times as far"], ["r", "ruler, in the masks"], ["Ctrl F", "search, in the XML text"],
        ].map(([k, v]) => h("tr", {}, h("td", {}, h("kbd", {}, k)), h("td", {}, v))))),
        sorted.length ? h("p", { class: "doc" }, `Change to picture in this visit: median ${number(at(0.5), 3)} ms, 95 % below ${number(at(0.95), 3)} ms (${sorted.length} answers).`) : "",
    ], []);
}
