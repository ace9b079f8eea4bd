// SPDX-License-Identifier: GPL-3.0-or-later
// Long work: jobs of the server, with progress and a way to end them. A JobView is the part of a tab
// that is filled by a job: it says what is missing, shows progress, keeps the last good result while
// the next one is made, and marks it when the text has moved on.
import { get, onConnection, post, remove, removeAndGo } from "./api.js";
import { inputKey, mayChange, requestKey, Shown } from "./belong.js";
import { isPresent, taken } from "./design.js";
import { announce, become, button, h, say } from "./dom.js";
import { duration } from "./format.js";
import { emit, on, state } from "./store.js";

const POLL_MS = 1000;
const ENDED = new Set(["done", "failed", "cancelled"]);
export const jobs = new Map(); // id -> job, as last heard of
const waiting = new Map(); // id -> function that looks at it again

/** Called for every `job` event of the server's stream. */
export function heard(event) {
    const job = jobs.get(event.id);
    if (!job) return emit("jobs-elsewhere", event);
    Object.assign(job, event);
    emit("jobs", job);
    waiting.get(event.id)?.();
}

onConnection((error) => {
    if (error) for (const look of waiting.values()) look();
});

/** Until the server says something of a job, or a while has passed. */
const news = (id) => new Promise((resolve) => {
    const timer = setTimeout(resolve, POLL_MS);
    waiting.set(id, () => {
        clearTimeout(timer);
        resolve();
    });
});

/** Starts a job and waits for its end; onprogress(job); files: name -> text, that options name; resume: the number of a
 *  study that is gone on with, results: the directory of one beside the file; of: what the server tells of the job to whoever asks; packs: with the numbers of the laboratory.
 *  Throws when it could not be started. byItself: what is typed in a field is left alone; automatic: nobody has asked for it, and it
 *  ends with the page. */
export async function run(kind, { byItself = false, ...asked } = {}) {
    if (!byItself) await taken();
    return begun(kind, asked);
}

async function begun(kind, { text = state.text, options = {}, files, resume, results, of, packs: used = kind !== "calibrate", automatic = false, onprogress, signal }) {
    const packs = used ? Object.keys(state.lab) : [];
    const all = { ...files, ...(packs.length ? state.lab : {}) };
    const { id } = await post("/api/jobs", {
        kind, text, set: { ...state.set }, options: packs.length ? { ...options, lab: packs.join(",") } : options,
        ...(Object.keys(all).length ? { files: all } : {}), ...(resume ? { resume } : {}), ...(results ? { results } : {}), ...(of ? { of } : {}), ...(automatic ? { automatic } : {}),
    });
    const job = { id, kind, automatic, state: "queued", seconds: 0, stage: null };
    jobs.set(id, job);
    const cancel = () => waiting.get(id)?.();
    signal?.addEventListener("abort", cancel);
    emit("jobs", job);
    try {
        while (!ENDED.has(job.state)) {
            if (!signal?.aborted) await news(id);
            if (signal?.aborted) {
                forget(job);
                job.state = "cancelled";
            } else Object.assign(job, await get(`/api/jobs/${id}`));
            onprogress?.(job);
            emit("jobs", job);
        }
        return job;
    } catch (error) {
        if (!error.lost) forget(job);
        throw error;
    } finally {
        waiting.delete(id);
        signal?.removeEventListener("abort", cancel);
    }
}

/** Ends a job, if it has not ended, and forgets it with its files on the server. */
export function forget(job) {
    if (!job || !jobs.delete(job.id)) return;
    remove(`/api/jobs/${job.id}`).catch(() => {}); // it is gone either way
}

// A page that is closed or loaded anew has nobody who waits for what it began by itself.
addEventListener("pagehide", () => {
    for (const job of jobs.values()) if (job.automatic && !ENDED.has(job.state)) removeAndGo(`/api/jobs/${job.id}`);
});

/** What waits or runs that other pages have begun, or this one before it was loaded anew. */
export async function elsewhere() {
    const all = (await get("/api/jobs")).jobs;
    return all.filter((job) => !jobs.has(job.id));
}

/** A job that has ended and that another page has begun, or this one before it was loaded anew, with what it gave. */
export async function takeUp(id) {
    const job = await get(`/api/jobs/${id}`);
    jobs.set(id, job);
    return job;
}

/** A list of all that waits or runs, each with a button that ends it; gone(): one was ended. */
async function waitingList(gone) {
    const all = (await get("/api/jobs")).jobs.filter((job) => !ENDED.has(job.state));
    return h("ul", { class: "messages waiting-jobs" }, all.map((job) => h("li", {},
        `${job.kind}${job.study ? ` ${job.study}` : ""}: ${job.state === "queued" ? "waits" : `runs for ${duration(job.seconds)}`}${jobs.has(job.id) ? "" : ", begun by another page"} `,
        button("Cancel", { icon: "close", class: "small" }, async () => {
            await remove(`/api/jobs/${job.id}`).catch(() => {}); // it may just have ended
            gone();
        }))));
}

export const fileOf = (job, path) => `/api/jobs/${job.id}/files/${path.split("/").map(encodeURIComponent).join("/")}`;
export const hasFile = (job, path) => job.files?.some((f) => f.path === path) ?? false;

/** Exit status of a command whose design is rejected. */
export const REJECTED = 1;

/** Why the present design is rejected, and what can be done all the same, in words. */
export const rejection = () => `${isPresent() ? (state.summary ?? []).slice(0, 1).map((l) => `${l.label}: ${l.text}.`).join(" ") : ""} Tick "though it is rejected" to have it made all the same, marked so.`;

/** "make it of a rejected design, too": {label, options()} of a job that makes masks or recipes. */
export function forceTick(view) {
    const tick = h("input", { type: "checkbox" });
    tick.addEventListener("change", () => view().run());
    const label = h("label", { class: "force-row", hidden: true }, tick, h("span", {}, "though it is rejected (marked so)"));
    on("preview", (p) => (label.hidden = p.verdict?.verdict !== "reject" && !tick.checked));
    // what would be accepted is told beside the verdict; nobody waits for it here
    return { label, options: () => ({ advice: "none", ...(tick.checked ? { force: true } : {}) }) };
}

// One job runs at a time. What nobody has asked for gives way to what somebody waits for, and comes again.
const background = new Set();
export function giveWay() {
    for (const view of background) view.giveWay();
}

const AUTO_MS = 500; // an automatic job waits until nothing has changed for so long
const WAITS_MS = 1500; // a longer wait is told

export class JobView {
    /**
     * kind, options(): of the job; intro: what it gives, shown while there is nothing; action: label of
     * the button; render(job, holder): fills the holder, may be async; auto: runs by itself while shown,
     * when nothing has changed for `quiet` ms, a number or what gives it; humble: then it gives way to other jobs;
     * reads: deviceText where it goes by the device that the text describes, and not by all of the text.
     */
    constructor(holder, { kind, options = () => ({}), intro, action, render, auto = false, accept, quiet = AUTO_MS, humble = false, reads }) {
        Object.assign(this, { kind, options, action, render, auto, accept, quiet, reads });
        if (humble) background.add(this);
        this.humble = humble;
        this.shown = false;
        this.job = null;
        this.of = null; // input of the job whose result is shown
        this.control = null;
        this.timer = 0;
        this.message = h("span", { class: "job-message" });
        this.start = button(action, { icon: "target", class: "primary" }, () => this.run());
        this.cancel = button("Cancel", { icon: "close", hidden: false, class: "cancel" }, () => this.control?.abort());
        this.bar = h("div", { class: "job-bar" }, this.start, h("progress", { "aria-label": `${action}: progress` }), this.message, this.cancel);
        this.progress = this.bar.querySelector("progress");
        this.intro = h("p", { class: "empty" }, intro);
        this.errors = h("div", { class: "job-errors", role: "status" });
        this.content = h("div", { class: "job-content" });
        holder.append(this.bar, this.errors, this.intro, this.content);
        this.showing = [];
        this.also(this.content);
        this.wrong = new Shown(this.errors, () => this.key);
        this.#look();
        for (const event of ["text", "options", "change", "preview", "entered"]) on(event, () => this.#moved());
        mayChange(() => this.control !== null || this.timer !== 0, { job: true });
    }

    /** Elements beside its own that show what the job gave. */
    also(...elements) {
        this.showing.push(...elements.map((element) => new Shown(element, () => this.key)));
    }

    /** Shown or hidden with its tab. */
    show(shown) {
        this.shown = shown;
        if (shown) this.#moved();
    }

    /** What its result depends on, as it is now. */
    get key() {
        return inputKey(this.options(), this.reads);
    }
    get stale() {
        return this.job !== null && this.of !== this.key;
    }

    #moved() {
        this.waits = "";
        this.#look();
        const auto = typeof this.auto === "function" ? this.auto() : this.auto;
        const key = this.key;
        if (this.control && this.byItself && key !== this.tried) this.giveWay(); // nobody waits for it any more
        clearTimeout(this.timer);
        this.timer = 0;
        if (!auto || !this.shown || key === this.of || key === this.tried || !isPresent()) return;
        const quiet = typeof this.quiet === "function" ? this.quiet() : this.quiet;
        this.timer = setTimeout(() => {
            this.timer = 0;
            this.run(true);
        }, quiet);
        this.waits = quiet > WAITS_MS ? `; made anew when nothing changes for ${Math.round(quiet / 1e3)} s` : "";
        this.#look();
    }

    giveWay() {
        if (!this.control || !this.byItself) return;
        this.gaveWay = true;
        this.control.abort();
    }

    async run(byItself = false) {
        this.control?.abort();
        this.gaveWay = false;
        this.byItself = byItself;
        if (!this.humble) giveWay();
        const control = (this.control = new AbortController());
        let key = (this.tried = requestKey(this.options(), this.reads));
        this.errors.replaceChildren();
        this.wrong.take(null);
        this.working = { state: "queued", seconds: 0 };
        this.#look();
        const begun = performance.now();
        const clock = setInterval(() => this.#look(performance.now() - begun), 200);
        try {
            if (!byItself) {
                await taken();
                if (control !== this.control) return;
                key = this.tried = requestKey(this.options(), this.reads);
            }
            const job = await run(this.kind, { byItself: true, automatic: byItself, options: this.options(), signal: control.signal, onprogress: (j) => (this.working = j) });
            if (control !== this.control) return forget(job);
            await this.#ended(job, key);
        } catch (error) {
            if (control === this.control) this.#failed([error.message], key);
            if (control === this.control && error.status === 429) await this.#others(() => this.run(byItself));
        } finally {
            clearInterval(clock);
            if (control === this.control) {
                this.working = null;
                this.control = null;
                this.#look();
                this.#moved();
            }
        }
    }

    async #ended(job, key) {
        if (job.state === "cancelled" && this.gaveWay) {
            this.tried = null; // it comes again when the others are done
            return;
        }
        if (job.state === "cancelled" && this.byItself && key !== this.key) return; // the input moved on
        if (job.state === "cancelled") {
            this.#failed(["cancelled"], key);
            announce(`${this.action}: cancelled`);
            return;
        }
        const good = job.state === "done" && (this.accept ? this.accept(job) : job.result !== null);
        if (!good) {
            this.#failed(job.messages?.length ? job.messages : [`ended with status ${job.exit_status ?? "?"}`], key);
            return forget(job);
        }
        forget(this.job);
        this.job = job;
        this.of = key;
        this.content.hidden = false;
        await this.render(job, this.content);
        for (const shown of this.showing) shown.take(key);
        announce(`${this.action}: done in ${duration(job.seconds)}`);
    }

    /** Too many wait: each of them can be ended here. */
    async #others(again) {
        try {
            this.errors.append(await waitingList(again));
        } catch {
            // then only the message stands there
        }
    }

    #failed(messages, of) {
        const said = messages.filter((m) => !/^\s*\d*\s*\|/.test(m)); // without the lines of the text below a message
        this.errors.replaceChildren(h("ul", { class: "messages" }, said.map((m) => h("li", {}, m))));
        this.wrong.take(of);
    }

    #look(ms = 0) {
        const busy = Boolean(this.working);
        const job = this.showing[0].another ? null : this.job; // of another device nothing is told
        become(this.start, { hidden: busy });
        this.start.classList.toggle("primary", job === null || this.stale);
        for (const element of [this.progress, this.cancel]) become(element, { hidden: !busy });
        become(this.intro, { hidden: job !== null || busy });
        this.bar.classList.toggle("busy", busy);
        if (busy) {
            const j = this.working;
            const seconds = Math.max(j.seconds ?? 0, ms / 1000);
            say(this.message, `${j.state === "queued" ? "waits for the job before it" : j.stage || "working"} · ${seconds.toFixed(1)} s`);
        } else if (job) {
            say(this.message, this.stale ? `of the former input: something has changed since${this.waits ?? ""}` : `computed in ${duration(job.seconds)}`);
        } else say(this.message, "");
    }
}
