// SPDX-License-Identifier: GPL-3.0-or-later
// Drives the page at random and compares what it shows with a fresh answer to what is in the editor.
//
// What is asked for is recorded where it leaves the page (fetch), so that what an answer belongs to is known here
// without the page's own book-keeping (web/src/belong.js), which is what is tested.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { program, source } from "./helper.mjs";

/** Numbers that look random and are the same in every run: mulberry32 (T. Ettinger, public domain, 2017). */
export function dice(seed) {
    let a = seed >>> 0;
    const next = () => {
        a = (a + 0x6d2b79f5) >>> 0;
        let t = a;
        t = Math.imul(t ^ (t >>> 15), t | 1);
        t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
    return { next, below: (n) => Math.floor(next() * n), of: (list) => list[Math.floor(next() * list.length)] };
}

/** Before the page's own script: notes of every answer what it was asked with, and looks at every frame. */
export function watcher() {
    const plain = globalThis.fetch;
    const askedBy = new WeakMap(); // an answer -> the body of its request
    const jobs = new Map(); // id -> the body that began it
    globalThis.fetch = async (path, init) => {
        const response = await plain(path, init);
        const json = response.json.bind(response);
        response.json = async () => {
            const answer = await json();
            if (["/api/preview", "/api/picture"].includes(path)) askedBy.set(answer, JSON.parse(init.body));
            if (path === "/api/jobs" && init.method === "POST" && answer.id) jobs.set(answer.id, JSON.parse(init.body));
            return answer;
        };
        return response;
    };
    const ordered = (x) => JSON.stringify(Object.entries(x ?? {}).map(([k, v]) => [k, String(Number.isNaN(Number(v)) ? v : Number(v))]).sort());
    const JUDGED = ["accuracy", "effects", "hinge_model"];
    const some = (options) => Object.fromEntries(Object.entries(options ?? {}).filter(([k]) => JUDGED.includes(k)));
    const same = (body, now) => body && body.text === now.text && ordered(body.set) === ordered(now.set) && ordered(body.options) === ordered(now.options);
    // a verdict reads neither comments nor what is blank between elements; no device here has a study
    const read = (text) => text?.split("<!--").map((part, i) => (i ? part.slice(part.indexOf("-->") + 3) : part)).join("").split("<").map((part) => part.replace(/>\s*$/, ">").trimEnd()).join("<").trim();
    const driven = (globalThis.driven = { wrong: [], frames: 0 });
    driven.presentIs = () => {
        const { state, parts } = globalThis.flexwright;
        const job = parts.verdict.full.job;
        const now = { text: state.text, set: state.set, options: state.options };
        return {
            preview: state.preview !== null && same(askedBy.get(state.preview), now),
            picture: state.picture !== null && same(askedBy.get(state.picture), now),
            full: job !== null && same({ ...jobs.get(job.id), text: read(jobs.get(job.id)?.text), options: some(jobs.get(job.id)?.options) }, { ...now, text: read(now.text), options: some(state.options) }),
        };
    };
    /** Nothing that is marked as present is of another input; at every frame. */
    driven.look = () => {
        const { state, parts } = globalThis.flexwright;
        if (!state.preview) return;
        const is = driven.presentIs();
        const say = (what) => driven.wrong.length < 20 && driven.wrong.push(what);
        const banner = document.querySelector("#banner");
        const made = banner.querySelector(".as-drawn")?.textContent === "as it will be made";
        if (banner.dataset.of === "present" && !(made ? is.full : is.preview)) say(`banner: ${banner.textContent.slice(0, 60)}`);
        // a view that is hidden keeps the answer that it showed last, and is compared when it is seen again
        for (const e of document.querySelectorAll("#right > .card[data-of='present'], #panel-motion:not([hidden]) [data-of='present']"))
            if (!(e.matches(".stage, .player") ? is.picture : is.preview) && !e.matches(".problems, .notes")) say(`${e.className} ${e.textContent.slice(0, 40)}`);
        if (parts.verdict.full.content.dataset.of === "present" && !is.full) say("as fabricated");
        if (banner.dataset.of === "present") // what a field says is what the verdict is of
            for (const f of document.querySelectorAll("#panel-form .slider input.value")) {
                const e = parts.form.places.get(f.dataset.path.replace(/\/@value$/, ""));
                const says = [e?.attributes.get("value")?.value, state.set[e?.attributes.get("name")?.value]];
                if (!says.includes(f.value.trim())) say(`a field says ${f.value}, beside a verdict of ${says[0]}`);
            }
        driven.frames++;
    };
    const frame = () => {
        if (globalThis.flexwright) driven.look();
        requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
}

// ---- what is shown ----

/** Everything that the page shows of its input, read off the page; runs in it. */
function shown() {
    const own = (e) => e.offsetParent !== null && !e.closest(".full-check"); // that is a job, which may be late
    const text = (q, root = document) => root.querySelector(q)?.textContent ?? null;
    const { parts, state } = globalThis.flexwright;
    const m = parts.motion;
    const banner = document.querySelector("#banner");
    return {
        name: text("#device-name"), verdict: banner.dataset.verdict ?? null, basis: text(".as-drawn", banner), of: banner.querySelector(".as-drawn")?.dataset.of,
        lines: [...banner.querySelectorAll(".top-line")].map((x) => x.textContent.replace(/[: ]/g, "")),
        bars: [...document.querySelectorAll(".bar")].map((x) => x.getAttribute("aria-label")),
        purpose: [...document.querySelectorAll(".card:not([hidden]) > .purpose > dt")].map((x) => [x.textContent.split(" (")[0], x.nextElementSibling.className]),
        problems: [...document.querySelectorAll(".problems:not([hidden]) .what")].map((x) => x.textContent),
        effects: [...document.querySelectorAll(".ledger .effect summary")].map((x) => [x.children[1].textContent, x.children[3].textContent]),
        flows: [...document.querySelectorAll(".flow .flow-name")].map((x) => x.textContent),
        scene: document.querySelector("#scene").value, stats: text(".run-stats"),
        bodies: m.mechanism.bodies.map((g) => [g.dataset.id, [...g.querySelectorAll("path")].map((p) => p.getAttribute("d")).join("")]),
        time: m.t ? m.time : null,
        tags: [...document.querySelectorAll("#panel-motion .hinge-tag")].map((g) => g.textContent),
        course: m.t && !m.course.root.hidden ? { id: m.courseShown.id, unknown: Boolean(m.courseShown.unknown), left: [...m.course.root.querySelectorAll(".leftout-row .leftout-name")].map((x) => x.textContent).sort(), series: m.courseShown.id === ":left" || m.courseShown.unknown ? [] : m.course.data.series.map((x) => x.values.map((v) => v === null ? null : v * m.courseUnit)) } : null,
        curves: m.t ? m.angles.data.series.map((x) => [x.name, x.values]) : null,
        fields: [...document.querySelectorAll("#panel-form input[data-path]")].filter((x) => !x.dataset.dirty).map((x) => [x.dataset.path, x.value]),
        notes: [...document.querySelectorAll("#panel-form details.element")].map((x) => [x.querySelector(".element-name").textContent, x.querySelector(".element-id").textContent, x.querySelector(".element-note").textContent]),
        options: Object.fromEntries(["method", "integrator", "accuracy"].map((k) => [k, document.querySelector(`#panel-motion select[aria-label="${k}"]`).value])),
        text: parts.editor.text, set: state.set, chosen: state.options,
        old: [...document.querySelectorAll(".old")].filter(own).length,
        former: [...document.querySelectorAll('[data-of="former"]')].filter(own).map((e) => e.className),
        busy: !document.querySelector("#busy").hidden, note: text("#old-note"),
    };
}

/** Answers anew, past everything that the page keeps; runs in it. */
async function fresh() {
    const { state, parts } = globalThis.flexwright;
    const { token } = await (await fetch("/api/session")).json();
    const options = Object.fromEntries(Object.entries(state.options).map(([k, v]) => [k, ["rtol", "accuracy"].includes(k) ? Number(v) : v]));
    const response = await fetch("/api/preview", { method: "POST", headers: { "X-Flexwright-Token": token, "Content-Type": "application/json" }, body: JSON.stringify({ text: parts.editor.text, set: state.set, options, rates: true }) });
    const answer = await response.json();
    return response.ok ? answer : { status: "refused", diagnostics: [{ severity: "error", message: answer.error.message }] };
}

const ENTITIES = { lt: "<", gt: ">", amp: "&", quot: '"', apos: "'" };

/** [element, [[attribute, value]]] of the text, read here and not by the page's parser; null: its tags do not fit. */
function attributes(text) {
    const all = [];
    const open = [];
    for (const [, end, name, rest, empty] of text.replace(/<!--.*?-->|<\?.*?\?>/gs, "").matchAll(/<(\/?)([\w.-]+)((?:\s+[\w:.-]+\s*=\s*(?:"[^"]*"|'[^']*'))*)\s*(\/?)>/g)) {
        if (end) {
            if (open.pop() !== name) return null;
            continue;
        }
        const list = [...rest.matchAll(/([\w:.-]+)\s*=\s*(?:"([^"]*)"|'([^']*)')/g)].map(([, k, a, b]) => [k, (a ?? b).replace(/&(\w+);/g, (whole, e) => ENTITIES[e] ?? whole)]);
        all.push([name, list.filter(([k]) => k !== "xmlns")]);
        if (!empty) open.push(name);
    }
    return open.length ? null : all;
}

const percent = (share) => Math.round(share * 100);

function compareMotion(page, now) {
    const m = now.motion;
    assert.equal(page.time !== null, m !== null, "a motion is shown where there is none, or the other way round");
    assert.deepEqual(page.bodies, now.bodies.map((b) => [b.id, [...(b.frame ?? []), ...(b.tethers ?? []), ...(b.islands ?? []), ...b.outline].join("")]), "outlines of the bodies");
    if (!m) return;
    assert.equal(page.scene, m.scene, "the scene");
    assert.ok(page.stats.startsWith(`${m.method} · ${m.integrator}`) && page.stats.includes(`${m.stats.steps} steps`.slice(-9)), `what it cost: ${page.stats}`);
    const rule = now.pins.map((p) => p.shown_limit_rad ?? null);
    const judged = rule.some((x) => x !== null);
    if (judged) {
        for (const [i, [name, values]] of page.curves.entries()) {
            assert.equal(name, now.pins[i].id);
            if (rule[i]) assert.deepEqual(values.slice(0, 40), m.angle_rad.slice(0, 40).map((r) => r[i] * (100 / rule[i])), `curve of ${name}`);
        }
    }
    compareCourse(page, now);
    let i = m.t_s.findLastIndex((t) => t <= page.time);
    i = Math.min(Math.max(i, 0), m.t_s.length - 2);
    const f = m.t_s[i + 1] > m.t_s[i] ? Math.min((page.time - m.t_s[i]) / (m.t_s[i + 1] - m.t_s[i]), 1) : 0;
    now.pins.forEach((pin, k) => {
        if (!rule[k]) return assert.equal(page.tags[k], pin.id);
        const share = Math.abs(m.angle_rad[i][k] + f * (m.angle_rad[i + 1][k] - m.angle_rad[i][k])) / rule[k];
        const told = Number(/ (\d+) %$/.exec(page.tags[k])?.[1]);
        assert.ok(Math.abs(told - percent(share)) <= 1, `hinge ${pin.id} is told with ${page.tags[k]}, and has ${share}`);
    });
}

/** The third plot: a probe, how fast it changes, or what bodies do, as the fresh answer has it. */
function compareCourse(page, now) {
    if (!page.course) return;
    const m = now.motion;
    const { id, series, left } = page.course;
    const probe = m.probes?.find((x) => x.id === id || `:rate ${x.id}` === id);
    const moving = now.bodies.flatMap((b, i) => (b.fixed ? [] : [[b, i]]));
    const wanted = probe ? [id === probe.id ? probe.value : probe.rate]
        : id === ":turning" ? moving.map(([, i]) => m.v.map((row) => row[3 * i + 2]))
            : id === ":turn" ? moving.map(([b, i]) => m.q.map((row) => row[3 * i + 2] - b.rest[2]))
                : id.startsWith(":v ") ? moving.filter(([b]) => id === `:v ${b.id}`).flatMap(([, i]) => [0, 1].map((k) => m.v.map((row) => row[3 * i + k]))) : [];
    if (probe) { // a sentence stands in place of curves that would say nothing
        const x = now.verdict?.probes?.find((y) => y.id === probe.id && y.scene === m.scene && (y.flow ?? null) === (m.flow ?? null));
        if (x) assert.equal(page.course.unknown, (x.level_error !== null && x.level_error >= 1) || !Number.isFinite(x.peak), `whether ${id} is known`);
        if (page.course.unknown) return;
    }
    if (id === ":left") assert.deepEqual(left, now.ledger.filter((e) => e.called_for).map((e) => e.id).sort());
    if (wanted.length) assert.equal(series.length, wanted.length, `curves of ${id}`);
    wanted.forEach((values, i) => {
        const most = Math.max(1e-300, ...values.map((v) => Math.abs(v ?? 0)));
        assert.ok(values.every((v, k) => v === series[i][k] || Math.abs(v - series[i][k]) <= 1e-9 * most), `curve ${i} of ${id}`);
    });
}

function compareForm(page, all) {
    if (!all) return; // no XML: the form shows what could be read
    const left = all.map(([name, list]) => JSON.stringify([name, list]));
    for (const [name, id, note] of page.notes) {
        const found = all.some(([n, list]) => n === name && list.filter(([, v]) => v !== id).slice(0, 4).map(([k, v]) => `${k} ${v}`).join(", ") === note);
        assert.ok(found, `the form tells ${name} ${id}: ${note}, which the text does not have: ${left.filter((x) => x.includes(name)).join("; ")}`);
    }
    for (const [path, value] of page.fields) {
        const attribute = path.split("/@")[1];
        const element = /([^/[]+)(?:\[[^\]]*\])?\/@/.exec(path)[1];
        const id = /\[([^\]]*)\]\/@/.exec(path)?.[1];
        const held = element === "parameter" && attribute === "value" ? page.set[id] : undefined;
        const values = all.filter(([n]) => n === element).filter(([, list]) => !id || /^\d+$/.test(id) || list.some(([, v]) => v === id)).map(([, list]) => list.find(([k]) => k === attribute)?.[1] ?? "");
        assert.ok(held !== undefined ? value === held : values.includes(value), `the form shows ${path} as ${value}, the text has ${values.join(" or ")}`);
    }
}

/** Against a fresh answer; nothing looks old, nothing is busy. */
export async function compare(page, server) {
    const [now, seen] = [await page.evaluate(fresh), await page.evaluate(shown)];
    assert.equal(seen.busy, false, "the sign of work stays");
    compareForm(seen, attributes(seen.text));
    assert.equal(seen.name, /<device[^>]*?\sname="([^"]*)"/.exec(seen.text)?.[1] ?? "", "the name of the device");
    if (seen.problems.length === 1 && /^the computation was ended after \d+ s/.test(seen.problems[0])) { // of a machine that others use, too: the page says so, and that it has no answer
        assert.ok(seen.old > 3 && seen.former.length > 3, "what was ended has no answer, and nothing looks old");
        return "ended";
    }
    assert.deepEqual(seen.problems, now.diagnostics.filter((d) => d.severity === "error").slice(0, 100).map((d) => d.message), "the mistakes");
    const good = now.status === "ok" || (now.status === "failed" && now.marks?.length > 0 && now.bodies?.length > 0);
    if (!good) {
        assert.ok(seen.old > 3 && seen.former.length > 3, `no answer to the present text (${now.diagnostics[0]?.message}), and ${seen.old} parts look old`);
        assert.match(seen.note, /has none/);
        return "none";
    }
    assert.deepEqual(seen.former, [], "of a former input");
    assert.equal(seen.old, 0, "looks old and is not");
    compareMotion(seen, now);
    assert.deepEqual(seen.flows, now.verdict ? now.flows.map((f) => f.name) : []); // without a verdict they are not shown
    const told = now.status !== "failed" && now.verdict && seen.of === "check" ? check(server, seen) : null;
    comparePurpose(seen, told ?? now.verdict, told === null && now.provisional);
    assert.deepEqual(seen.effects, now.ledger.filter((e) => e.called_for).map((e) => [e.id, e.active ? "computed" : "left out"]));
    if (now.status === "failed") assert.equal(seen.verdict, "failed");
    else if (!now.verdict) assert.equal(seen.verdict, null);
    else if (seen.of === "check") compareChecked(seen, told);
    else {
        assert.equal(seen.verdict, now.verdict.verdict);
        assert.deepEqual(seen.lines, now.verdict.summary.map((l) => `${l.label}${l.text}`.replace(/[: ]/g, "")));
        compareBars(seen, now.verdict.hinges.map((x) => [x.id, x.utilisation]));
    }
    return seen.basis ?? seen.verdict;
}

/** Requirements, and probes of which none speaks: those of the verdict as made, before it of the answer (look: which accepts nothing
 *  yet), and none without a verdict. */
function comparePurpose(seen, verdict, look) {
    const word = (r) => (r.verdict === "accept" && r.as_fabricated && r.as_fabricated.verdict !== "accept" ? "inconclusive" : r.verdict === "accept" && look ? "first" : r.verdict);
    const asked = verdict?.requirements ?? [];
    const others = (verdict?.probes ?? []).filter((x) => !asked.some((r) => r.probe === x.id && r.scene === x.scene && r.flow === x.flow));
    assert.deepEqual(seen.purpose, [...asked.map((r) => [r.probe, word(r)]), ...others.map((x) => [x.id, ""])], "what it is for");
}

/** What the program says of the same text in a terminal. */
function check(server, seen) {
    const file = join(server.directory, "driven.xml");
    writeFileSync(file, seen.text);
    const options = [["accuracy", "accuracy"], ["effects", "effects"], ["hinge_model", "hinge-model"]].filter(([k]) => seen.chosen[k]).map(([k, o]) => `--${o}=${seen.chosen[k]}`);
    const set = Object.entries(seen.set).map(([k, v]) => `--set=${k}=${v}`);
    const done = spawnSync(program, ["check", ...options, ...set, "--json", file], { cwd: source, maxBuffer: 64 << 20 });
    return JSON.parse(done.stdout);
}

function compareChecked(seen, told) {
    assert.equal(seen.verdict, told.verdict);
    assert.deepEqual(seen.lines, told.summary.map((l) => `${l.label}${l.text}`.replace(/[: ]/g, "")));
    compareBars(seen, told.hinges.map((x) => [x.id, (x.as_fabricated ?? x).utilisation]));
}

/** [[hinge, utilisation]] of the verdict: the same in the list. */
function compareBars(seen, list) {
    if (list.length === 0) return;
    assert.deepEqual(seen.bars.map((b) => /^Hinge (\S+):/.exec(b)[1]), list.map(([id]) => id));
    list.forEach(([id, share], i) => {
        const told = Number(/: (\S+) %/.exec(seen.bars[i])[1].replace("\u2212", "-")) / 100;
        assert.ok(share === null || Math.abs(told - share) <= 0.006 * Math.abs(share), `the list says ${seen.bars[i]}, the verdict ${share}`);
    });
}

// ---- what is done ----

const LONGEST_MS = Number(process.env.FW_DRIVE_WAIT_MS ?? 240000); // that a judgement as fabricated takes; of a machine that others use more
const NUMBER = /(\w+)="(-?\d+(?:\.\d+)?)( [a-zA-Z]+)"/g;

/** Another number somewhere in the text, or what is no text at all. */
function otherText(text, d) {
    const kind = d.below(10);
    if (kind === 0) return text.replace(/<\/\w+>/, (m) => `${m.slice(0, -1)}x>`); // a mistake
    if (kind === 1) return text.replace(/kind="(\w+)"/, 'kind="none-such"');
    if (kind === 2) return text.replace(/name="([^"]*)"/, (m, n) => `name="${n.slice(0, 12)}-${d.below(100)}"`);
    const places = [...text.matchAll(NUMBER)].filter((m) => !/<!--[^>]*$/.test(text.slice(0, m.index)));
    const m = d.of(places);
    if (!m) return text;
    const digits = (/\.(\d*)/.exec(m[2])?.[1] ?? "").length;
    const value = (Number(m[2]) * (0.9 + 0.2 * d.next())).toFixed(Math.max(digits, 1));
    return `${text.slice(0, m.index)}${m[1]}="${value}${m[3]}"${text.slice(m.index + m[0].length)}`;
}

const replace = (page, text) => page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), text);
const textOf = (page) => page.evaluate(() => globalThis.flexwright.parts.editor.text);

/** Everything else that is asked for of `path` waits until release(). */
async function holdBack(page, path) {
    let release;
    const gate = new Promise((resolve) => (release = resolve));
    const handler = async (route) => {
        await gate;
        await route.continue().catch(() => {}); // given up meanwhile
    };
    await page.route(path, handler);
    return async () => {
        release();
        await page.unroute(path, handler);
    };
}

/** While the answer is held back: what is shown looks old, and the sign is there. */
async function looksOld(page) {
    await page.waitForFunction(() => {
        const parts = [...document.querySelectorAll("#banner, #right > .card[data-of='former'], #panel-motion [data-of='former']")].filter((e) => e.offsetParent !== null && e.dataset.of !== "nothing");
        return !document.querySelector("#busy").hidden && parts.length > 2 && parts.every((e) => e.classList.contains("old") && getComputedStyle(e.matches(".stage") ? e.querySelector("svg") : e).filter.includes("grayscale"));
    });
    await page.waitForSelector("#old-note > div:visible");
}

const OPTIONS = { method: ["", "minimal", "qr"], integrator: ["", "dopri5"], accuracy: ["", "1e-2", "1e-4"], effects: ["", "all", "none"], tolerance: ["", "1e-6", "1e-8"] };

export const actions = {
    async text(page, d) {
        await replace(page, otherText(await textOf(page), d));
    },
    async burst(page, d) {
        for (let i = 2 + d.below(4); i > 0; i--) await replace(page, otherText(await textOf(page), d));
    },
    async undo(page, d) {
        for (let i = 1 + d.below(3); i > 0; i--) await page.evaluate(() => globalThis.flexwright.parts.editor.undo());
    },
    async redo(page) {
        await page.evaluate(() => globalThis.flexwright.parts.editor.redo());
    },
    async option(page, d) {
        const name = d.of(Object.keys(OPTIONS));
        await page.selectOption(`#panel-motion select[aria-label="${name}"]`, d.of(OPTIONS[name]));
    },
    async scene(page, d) {
        const names = await page.locator("#scene option").evaluateAll((list) => list.map((o) => o.value));
        if (names.length) await page.selectOption("#scene", d.of(names));
    },
    /** Another course in the third plot. */
    async course(page, d) {
        const box = page.locator('.plots select[aria-label="What is plotted"]:visible');
        if (!(await box.count())) return;
        await box.selectOption(d.of(await box.locator("option").evaluateAll((list) => list.map((o) => o.value))));
    },
    async field(page, d) {
        const inputs = page.locator("#panel-form .slider input.value:visible");
        const n = await inputs.count();
        if (!n) return;
        const input = inputs.nth(d.below(n));
        const m = /^(-?\d+(?:\.\d+)?)(.*)$/.exec(await input.inputValue());
        if (!m) return;
        await input.fill(`${(Number(m[1]) * (0.93 + 0.14 * d.next())).toPrecision(4)}${m[2]}`);
        await input.press("Enter");
    },
    /** Typed, and in no text: what is shown is of another input, until it is taken or left. */
    async typed(page, d, settle) {
        const inputs = page.locator("#panel-form .slider input.value:visible");
        const n = await inputs.count();
        if (!n) return;
        const input = inputs.nth(d.below(n));
        const m = /^(-?\d+(?:\.\d+)?)(.*)$/.exec(await input.inputValue());
        if (!m) return;
        await input.fill(`${(Number(m[1]) * (1.01 + 0.06 * d.next())).toPrecision(4)}${m[2]}`);
        await settle();
        const present = await page.evaluate(() => [...document.querySelectorAll("#banner, #right > .card:not(.problems, .notes), #panel-motion [data-of]")].filter((e) => e.dataset.of === "present").map((e) => e.className));
        assert.deepEqual(present, [], "present, and of a text without what is typed");
        await input.press(d.of(["Escape", "Enter", "Tab"]));
    },
    async keys(page, d) {
        const sliders = page.locator("#panel-form input[type=range]:visible");
        if (!(await sliders.count())) return;
        await sliders.nth(d.below(await sliders.count())).focus();
        for (let i = 1 + d.below(4); i > 0; i--) await page.keyboard.press(d.of(["ArrowLeft", "ArrowRight"]));
    },
    /** Held by the mouse: what is shown is of the held value, and stays so when it is let go. */
    async hold(page, d, settle, same) {
        const sliders = page.locator("#panel-form input[type=range]:visible");
        if (!(await sliders.count())) return;
        const slider = sliders.nth(d.below(await sliders.count()));
        await slider.scrollIntoViewIfNeeded();
        const b = await slider.boundingBox();
        const at = () => b.x + b.width * (0.35 + 0.3 * d.next());
        await page.mouse.move(at(), b.y + b.height / 2);
        await page.mouse.down();
        try {
            for (let i = 1 + d.below(3); i > 0; i--) await page.mouse.move(at(), b.y + b.height / 2, { steps: 3 });
            if (d.below(2)) {
                await settle();
                await same();
            }
        } finally {
            await page.mouse.up();
        }
    },
    /** A handle of the drawing, by the mouse, in any number of moves: what is written is what one move to the same place writes. */
    async drag(page, d, settle) {
        const settled = () => page.waitForFunction(() => globalThis.flexwright.settled(false) && !globalThis.flexwright.parts.draw.drag, null, { timeout: LONGEST_MS });
        await page.click("#tab-draw");
        try {
            await settle();
            const handles = page.locator(".draw-handle");
            const n = await handles.count();
            if (!n) return;
            const handle = handles.nth(d.below(n));
            const id = await handle.getAttribute("data-id");
            const by = [0, 1].map(() => (d.below(2) ? 1 : -1) * (8 + d.below(30)));
            const before = await textOf(page);
            // where it is now: a notice of the first drag that stays has moved the picture
            const written = async (moves) => {
                const box = await page.locator(`.draw-handle[data-id=${JSON.stringify(id)}]`).locator(".reach").boundingBox();
                const a = [box.x + box.width / 2, box.y + box.height / 2];
                const b = a.map((v, k) => v + by[k]);
                await page.mouse.move(...a);
                await page.mouse.down();
                for (let i = 1; i <= moves; i++) await page.mouse.move(...a.map((v, k) => v + ((b[k] - v) * i) / moves));
                await page.mouse.up();
                await settled();
                return textOf(page);
            };
            const first = await written(1 + d.below(13));
            if (first !== before) await page.evaluate(() => globalThis.flexwright.parts.editor.undo());
            assert.equal(await textOf(page), before, "one drag is one step of the history");
            await settled();
            assert.equal(await written(1), first, `${id} dragged by ${by} pixels`);
        } finally {
            await page.click("#tab-motion");
        }
    },
    /** A slow answer: what is there looks old; then it comes, or is overtaken, or is cancelled. */
    async slow(page, d) {
        const release = await holdBack(page, "**/api/preview");
        try {
            const before = await textOf(page);
            const places = [...before.matchAll(NUMBER)];
            if (!places.length || !(await page.evaluate(() => globalThis.driven.presentIs().preview))) return;
            await replace(page, `${before} `); // a text that is another, and as good
            await looksOld(page);
            const kind = d.below(3);
            if (kind === 0) {
                await page.click("#busy-cancel");
                await page.waitForSelector("#compute-again");
                assert.match(await page.textContent("#old-note"), /cancelled/);
                await release();
                await page.click("#compute-again");
            } else if (kind === 1) await replace(page, otherText(before, d));
        } finally {
            await release();
        }
    },
    async slowEdit(page, d) {
        const release = await holdBack(page, "**/api/edit");
        try {
            await this.field(page, d);
            await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 30)));
        } finally {
            await release();
        }
    },
};

/** One action, `kind` or any; whatever it was, afterwards the page shows what is true. Returns [action, what it is compared with].
 *  mend: the text has no answer, and mostly something is taken back. */
export async function step(page, server, d, { mend = false, whole = d.below(4) === 0, kind = "" } = {}) {
    let name = "";
    const settle = () => page.waitForFunction((all) => globalThis.flexwright.settled(all), whole, { timeout: LONGEST_MS }).catch(async (error) => {
        const { set, options, working, job } = await page.evaluate(() => {
            const { state, parts } = globalThis.flexwright;
            const { full } = parts.verdict;
            return { set: state.set, options: state.options, working: document.querySelector("#busy").textContent, job: [full.working, full.timer, full.message.textContent] };
        });
        throw new Error(`${error.message} Not settled after ${name}: ${JSON.stringify({ whole, set, options, working, job })}`);
    });
    const same = () => compare(page, server);
    name = kind || (mend && d.below(4) ? "undo" : d.of(Object.keys(actions)));
    await actions[name](page, d, settle, same);
    await settle();
    assert.deepEqual(await page.evaluate(() => globalThis.flexwright.state.set), {}, "a value is held that nobody holds");
    const basis = await same();
    const wrong = await page.evaluate(() => globalThis.driven.wrong);
    assert.deepEqual(wrong, [], "marked as present, and of another input");
    return [name, basis];
}
