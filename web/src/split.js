// SPDX-License-Identifier: GPL-3.0-or-later
// A tab with the mechanism on one side and what is computed about it on the other.
import { Shown } from "./belong.js";
import { h } from "./dom.js";
import { Mechanism } from "./mechanism.js";
import { zoomButtons } from "./motion.js";
import { on, state } from "./store.js";

/** A view extends it, sets `view` (a JobView in `side`) and has draw(), which poses the mechanism. */
export class Split {
    constructor(holder, { title, ...picture }) {
        this.stage = h("div", { class: "stage" });
        this.card = h("section", { class: "card" }, h("h2", {}, title));
        holder.append(h("div", { class: "split" }, this.stage, h("div", { class: "side-panel" }, this.card)));
        this.mechanism = new Mechanism(this.stage, picture);
        this.stage.append(zoomButtons(() => this.mechanism.view));
        this.visible = false;
        this.drawn = new Shown(this.stage);
        on("preview", () => this.visible && this.#show());
    }

    #show() {
        this.mechanism.show(state.preview);
        this.drawn.take(state.previewOf);
    }

    shown(yes) {
        this.visible = yes;
        this.view.show(yes);
        if (!yes) return;
        if (state.preview) this.#show();
        this.draw();
    }
}
