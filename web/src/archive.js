// SPDX-License-Identifier: GPL-3.0-or-later
// Download of everything: the directory of `flexwright plan` as one archive.
import { inputKey, requestKey } from "./belong.js";
import { taken } from "./design.js";
import { announce, button, h } from "./dom.js";
import { bytes, duration } from "./format.js";
import { forget, giveWay, run } from "./jobs.js";
import { openDialog } from "./dialog.js";
import { state } from "./store.js";

const PLANNED = ["accuracy", "effects", "hinge_model"]; // of the options above the motion, what a plan takes

export async function download() {
    const control = new AbortController();
    let of = null;
    const options = Object.entries(state.options).filter(([name]) => PLANNED.includes(name));
    const stage = h("p", { role: "status" }, "starting");
    const dialog = openDialog("Plan and download", [
        h("p", {}, "Verdict, masks, recipes and report of the text as it stands, byte for byte what ", h("code", {}, `flexwright plan${options.map(([k, v]) => ` --${k.replace("_", "-")}=${v}`).join("")} -o`), " writes."),
        h("progress", { "aria-label": "plan: progress" }), stage,
    ], [button("Cancel", { class: "cancel" }, () => control.abort())]);
    dialog.addEventListener("cancel", () => control.abort());
    const begun = performance.now();
    giveWay();
    let name = null;
    const clock = setInterval(() => (stage.textContent = `${name ?? "working"} · ${((performance.now() - begun) / 1e3).toFixed(1)} s`), 200);
    try {
        await taken();
        of = requestKey();
        const job = await run("plan", { options: Object.fromEntries(options), signal: control.signal, onprogress: (j) => (name = j.stage) });
        clearInterval(clock);
        if (job.state === "cancelled") return dialog.close();
        finish(dialog, job, of);
    } catch (error) {
        clearInterval(clock);
        stage.textContent = error.message;
        dialog.querySelector("progress").hidden = true;
    }
}

function finish(dialog, job, of) {
    const files = job.files ?? [];
    if (!files.length) {
        dialog.setContent([h("p", {}, "The plan failed:"), h("ul", { class: "messages" }, (job.messages ?? []).map((m) => h("li", {}, m)))], [button("Close", {}, () => dialog.close())]);
        return;
    }
    const size = files.reduce((n, f) => n + f.bytes, 0);
    const device = state.preview?.name ?? "device";
    const link = h("a", { class: "button primary", href: `/api/jobs/${job.id}/archive`, download: `${device}.zip` }, `Save ${device}.zip`);
    const rejected = job.exit_status === 1;
    dialog.setContent([
        h("p", {}, `${files.length} files, ${bytes(size)}, in ${duration(job.seconds)}.`),
        of === inputKey() ? "" : h("p", { class: "warn-text" }, "The text or the options have changed since: this is of what they were when it was begun."),
        rejected ? h("p", { class: "warn-text" }, "The design is rejected: the report says why, and there are no masks and no recipes.") : "",
        h("ul", { class: "file-list scroll" }, files.map((f) => h("li", {}, h("span", {}, f.path), h("span", {}, bytes(f.bytes))))),
    ], [link, button("Close", {}, () => dialog.close())]);
    dialog.addEventListener("close", () => setTimeout(() => forget(job), 60000));
    link.focus();
    announce("the plan is ready");
}
