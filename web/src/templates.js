// SPDX-License-Identifier: GPL-3.0-or-later
// New…: the smallest device, and those of the gallery with their pictures, to begin from.
import combStage from "../../docs/gallery/comb-stage/device.xml";
import combStagePicture from "../../docs/gallery/comb-stage/device.svg";
import fourBar from "../../docs/gallery/leaf-four-bar/device.xml";
import fourBarPicture from "../../docs/gallery/leaf-four-bar/device.svg";
import freeFourBar from "../../docs/gallery/free-form-four-bar/device.xml";
import freeFourBarPicture from "../../docs/gallery/free-form-four-bar/device.svg";
import gripper from "../../docs/gallery/free-form-gripper/device.xml";
import gripperPicture from "../../docs/gallery/free-form-gripper/device.svg";
import nodder from "../../docs/gallery/copper-nodder/device.xml";
import nodderPicture from "../../docs/gallery/copper-nodder/device.svg";
import sixBar from "../../docs/gallery/reference-six-bar/device.xml";
import sixBarPicture from "../../docs/gallery/reference-six-bar/device.svg";
import stage from "../../docs/gallery/straight-stage/device.xml";
import stagePicture from "../../docs/gallery/straight-stage/device.svg";
import tendons from "../../docs/gallery/four-tendons/device.xml";
import tendonsPicture from "../../docs/gallery/four-tendons/device.svg";
import { announce, h, icon } from "./dom.js";
import { anotherDevice } from "./belong.js";
import { openDialog } from "./dialog.js";
import { replaceAll } from "./file.js";
import { emit, state } from "./store.js";
import blank from "./templates/blank.xml";
import empty from "./templates/empty.xml";

export const TEMPLATES = [
    ["Empty page", "nothing but a material and a flow: draw the device with the mouse, in Draw", blank, null],
    ["One leaf", "one body on one leaf: the smallest device that is judged and made", empty, null],
    ["Six-bar", "two legs and a platform on six arcs, 3 mm wide, for both flows", sixBar, sixBarPicture],
    ["Four-bar", "any planar mechanism, here a crank, a coupler and a rocker on leaves", fourBar, fourBarPicture],
    ["Stage", "a parallelogram drawn by a cable; stroke, straightness and frequency are required", stage, stagePicture],
    ["Gripper", "two jaws drawn as outlines, closed by tendons; opening and grip force are required", gripper, gripperPicture],
    ["Comb stage", "a stage on four leaves, drawn by comb drives, on hollowed glass", combStage, combStagePicture],
    ["Four cables", "the six-bar moved by cables that only pull", tendons, tendonsPicture],
    ["Copper nodder", "a parallel crank of copper that tires: an example of a rejection", nodder, nodderPicture],
    ["Free-form four-bar", "hinges of varying width, and hinges that are paths", freeFourBar, freeFourBarPicture],
];

export function newDevice(editor) {
    const pictures = [];
    const show = (svg) => {
        const url = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
        pictures.push(url);
        return h("img", { src: url, alt: "" });
    };
    const cards = TEMPLATES.map(([name, words, text, picture]) => h("button", {
        type: "button", class: "template", onclick: () => {
            dialog.close();
            take(editor, name, text);
        },
    }, h("span", { class: "template-picture" }, picture ? show(picture) : icon("plus")), h("strong", {}, name), h("span", {}, words)));
    const dialog = openDialog("New device", [
        h("p", {}, state.file ? `It takes the place of the text here, one undo away; ${state.file.name} changes when you save.` : "It takes the place of the text here."),
        h("div", { class: "templates scroll" }, cards),
    ], []);
    dialog.classList.add("wide-dialog");
    dialog.addEventListener("close", () => pictures.forEach((url) => URL.revokeObjectURL(url)));
}

function take(editor, name, text) {
    if (state.file) {
        anotherDevice(text);
        editor.replace(text);
    } else replaceAll(editor, text, `Begin with ${name}`);
    if (text === blank) emit("show-view", "draw");
    announce(`${name}: begun`);
}
