// SPDX-License-Identifier: GPL-3.0-or-later
// Explore: every point is what `check` says of that device, what is shown is of the present input, a study is run, stopped,
// gone on with, and its best device put into the text by one step of the history.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { answered, axeSource, close, finish, open, program, ready, serve, setText, source, text, view, SMALL } from "./helper.mjs";
import { endOf, stretches, told } from "../../web/src/exploring.js";
import { kindOf, sizeOf } from "../../web/src/quantities.js";

after(finish);

const LONG = 120000; // of a machine that others use, too
const whole = (page) => page.waitForFunction(() => globalThis.flexwright.parts.explore.whole && globalThis.flexwright.parts.explore.showing.element.dataset.of === "present", null, { timeout: LONG });
/** Values that are told between the points. */
const toldOf = (page) => page.evaluate(() => globalThis.flexwright.parts.explore.told);
const points = (page) => page.evaluate(() => [...globalThis.flexwright.parts.explore.done.values()]);
const check = (file, ...options) => JSON.parse(spawnSync(program, ["check", file, "--json", ...options], { cwd: source }).stdout);
/** The first point of the present input, which is today's value: not yet the others. */
const first = async (page) => {
    await page.waitForFunction(() => globalThis.flexwright.parts.explore.done.size > 0 && globalThis.flexwright.parts.explore.showing.element.dataset.of === "present", null, { timeout: LONG });
    return (await points(page))[0];
};
const setRange = async (page, which, from, to) => {
    await page.fill(`[aria-label="${which} input, from"]`, from);
    await page.press(`[aria-label="${which} input, from"]`, "Tab");
    await page.fill(`[aria-label="${which} input, to"]`, to);
    await page.press(`[aria-label="${which} input, to"]`, "Tab");
};

test("what is told as accepted lies within what was accepted", () => {
    const points = [[6, "reject"], [6.97951, "reject"], [6.98049, "accept"], [9, "accept"], [11.96751, "accept"], [11.96849, "reject"], [20, "reject"]].map(([x, state]) => ({ x, state }));
    const list = told(stretches(points, true), points);
    assert.deepEqual(list.map((r) => [r.state, r.from, r.to]), [["reject", "6", "6.981"], ["accept", "6.981", "11.96"], ["reject", "11.96", "20"]]);
    const all = [{ x: 0, state: "accept" }, { x: 1 / 3, state: "accept" }];
    assert.deepEqual(told(stretches(all, true), all).map((r) => [r.from, r.to]), [["0", "0.3333"]]);
});

test("what nobody tried between two decisions is told as open, on neither side", () => {
    const points = [[1, "reject"], [3.2, "reject"], [5.4, "accept"], [10, "accept"]].map(([x, state]) => ({ x, state }));
    assert.deepEqual(told(stretches(points, true), points).map((r) => [r.state, r.from, r.to]), [["reject", "1", "3.2"], ["open", "3.2", "5.4"], ["accept", "5.4", "10"]]);
    const three = [[1, "reject"], [2, "inconclusive"], [3, "reject"]].map(([x, state]) => ({ x, state }));
    assert.deepEqual(told(stretches(three, false), three).map((r) => [r.state, r.from, r.to]),
        [["reject", "1", "1"], ["open", "1", "2"], ["inconclusive", "2", "2"], ["open", "2", "3"], ["reject", "3", "3"]]);
});

test("a device that takes longer than the server gives is named and left out, and the others are judged", async () => {
    const server = await serve("leaf-four-bar");
    const page = await open(server, SMALL);
    page.expected = [/500/];
    let slow = null;
    await page.route("**/api/explore", (r) => {
        const { points } = r.request().postDataJSON();
        slow ??= points.at(-1)[0];
        return points.some((p) => p[0] === slow) ? r.fulfill({ status: 500, json: { error: { code: "FW-D286", message: "the computation was stopped after 20 s" } } }) : r.continue();
    });
    await view(page, "explore");
    await page.waitForFunction(() => globalThis.flexwright.parts.explore.whole, null, { timeout: LONG });
    const [late, all] = await page.evaluate(() => {
        const { done } = globalThis.flexwright.parts.explore;
        return [[...done.values()].filter((p) => p.late), done.size];
    });
    assert.equal(late.length, 1);
    assert.match(late[0].why, /longer than 20 s/);
    assert.ok(all > 10, `${all} devices`);
    assert.ok((await page.textContent(".explore-summary")).includes(`With ${slow} it took longer than 20 s, and was left out.`));
    await close(page);
    await server.stop();
});

test("a unit may have several symbols, joined by a blank, '.', '*' or '/'", () => {
    const units = { N: 1, uN: 1e-6, m: 1, mm: 1e-3, um: 1e-6, kg: 1, s: 1, rad: 1 };
    for (const [unit, size] of [["um", 1e-6], ["N m", 1], ["uN mm", 1e-9], ["uN.mm", 1e-9], ["uN*mm", 1e-9], ["kg m^2/s^2", 1], ["mm^2", 1e-6]]) {
        assert.ok(Math.abs(sizeOf(unit, units) / size - 1) < 1e-12, unit);
        assert.deepEqual(kindOf(`2.5 ${unit}`, units, () => false), { kind: "number", unit });
    }
    for (const none of ["", "foo", "um w", "um*w"]) assert.equal(sizeOf(none, units), undefined, none);
    assert.equal(kindOf("2 um*w", units, () => false).kind, "formula");
    assert.ok(Math.abs(endOf("3e-8 N m", "uN mm", units) / 30 - 1) < 1e-12);
    assert.equal(endOf("30", "uN mm", units), 30);
    assert.ok(Number.isNaN(endOf("30 foo", "uN mm", units)));
});

describe("a range", () => {
    let server, page;
    before(async () => {
        server = await serve("leaf-four-bar");
        page = await open(server);
        await view(page, "explore");
        await whole(page);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("begins with the first parameter over its own range, and today's value among the points", async () => {
        assert.equal(await page.inputValue('[aria-label="First input, from"]'), "6 um");
        assert.equal(await page.inputValue('[aria-label="First input, to"]'), "16 um");
        const list = await points(page);
        assert.ok(list.length >= 51 && list.length <= 202, String(list.length));
        assert.ok(list.some((p) => p.x === 8) && list.some((p) => p.x === 6) && list.some((p) => p.x === 16));
        assert.match(await page.textContent(".explore-summary"), /^[A-Z].* from 6 to .* um/);
        await page.emulateMedia({ forcedColors: "active" });
        assert.equal(await page.evaluate(() => getComputedStyle(document.querySelector(".explore-band-key")).forcedColorAdjust), "none");
        await page.emulateMedia({ forcedColors: null });
    });

    test("points are what check says of these devices", async () => {
        const list = (await points(page)).sort((a, b) => a.x - b.x);
        for (const p of [list[0], list[Math.floor(list.length / 3)], list.at(-1)]) {
            const told = check(server.file, "--corners", "none", "--hinge-model", "revolute", "--set", `width=${p.x} um`);
            assert.equal(p.state, told.verdict);
            assert.equal(p.value, told.governing.utilisation * 100);
            assert.deepEqual([p.low, p.high], told.governing.utilisation_band.map((v) => v * 100));
        }
    });

    test("where the decision changes is found to a thousandth of the range", async () => {
        await page.selectOption('select[aria-label="Vary"]', "scene[push]/force/@fx");
        await setRange(page, "First", "0.1 mN", "0.5 mN");
        await whole(page);
        const list = (await points(page)).sort((a, b) => a.x - b.x);
        const states = new Set(list.map((p) => p.state));
        assert.ok(states.has("accept") && states.has("reject"), [...states].join());
        const jumps = list.slice(1).flatMap((p, i) => (p.state !== list[i].state ? [p.x - list[i].x] : []));
        assert.ok(jumps.length && jumps.every((d) => d < 4e-4), String(jumps));
        const edge = list.find((p, i) => p.state === "accept" && list[i + 1].state !== "accept");
        const next = list[list.indexOf(edge) + 1];
        for (const p of [edge, next]) assert.equal(check(server.file, "--corners", "none", "--hinge-model", "revolute", "--set", `scene[push]/force/@fx=${p.x} mN`).verdict, p.state);
        const asked = [];
        page.on("request", (r) => r.url().endsWith("/api/explore") && asked.push(r));
        await page.selectOption('select[aria-label="Vary"]', "width");
        await whole(page);
        assert.equal(asked.length, 0, "what was computed for this very input is remembered");
        assert.ok((await points(page)).length >= 51);
    });

    test("what is left out between points lies on the line", async () => {
        const list = (await points(page)).sort((a, b) => a.x - b.x);
        const values = list.flatMap((p) => [p.value, p.low, p.high]), span = Math.max(...values) - Math.min(...values);
        const widest = list.slice(1).map((p, i) => [list[i], p]).sort((a, b) => b[1].x - b[0].x - (a[1].x - a[0].x)).slice(0, 3);
        assert.ok(widest[0][1].x - widest[0][0].x > 0.051, "something was left out");
        for (const [a, b] of widest) {
            const told = check(server.file, "--corners", "none", "--hinge-model", "revolute", "--set", `width=${(a.x + b.x) / 2} um`);
            const off = told.governing.utilisation * 100 - (a.value + b.value) / 2;
            assert.ok(Math.abs(off) < 2e-3 * span, `${off} of ${span}`);
            assert.equal(told.verdict, a.state);
        }
    });

    test("where somebody keeps looking a device is computed", async () => {
        const before = (await points(page)).map((p) => p.x).sort((a, b) => a - b);
        const i = before.findIndex((v, k) => k > 0 && v - before[k - 1] > 0.15);
        assert.ok(i > 0, "a place that was left out");
        const place = (before[i] + before[i - 1]) / 2;
        await page.locator('[aria-label="Look at"]').fill(String(Math.round(100 * (place - 6))));
        await page.waitForFunction((n) => globalThis.flexwright.parts.explore.done.size > n, before.length, { timeout: LONG });
        const near = (await points(page)).map((p) => p.x).find((v) => Math.abs(v - place) < 0.01);
        assert.ok(near, String(place));
        assert.match(await page.textContent(".explore-readout"), new RegExp(`width ${near}`));
    });

    test("a place that is looked at is told, and used by one step of the history", async () => {
        const before = await text(page);
        await page.locator('[aria-label="Look at"]').focus();
        for (let i = 0; i < 3; i++) await page.keyboard.press("PageUp");
        const said = await page.textContent(".explore-readout");
        const value = /width (\S+ um): (accepted|rejected|inconclusive), \S+ % \(/.exec(said)?.[1];
        assert.ok(value, said);
        await answered(page, () => page.click("#explore-use"));
        assert.equal(await text(page), before.replace('name="width" value="8 um"', `name="width" value="${value}"`));
        await answered(page, () => page.click("#undo"));
        assert.equal(await text(page), before);
    });

    test("the pointer tells the nearest device beside it, and what is kept below stays", async () => {
        const kept = await page.textContent(".explore-readout");
        const box = await page.locator(".explore-plot").boundingBox();
        const list = [...(await points(page)), ...(await toldOf(page))];
        const { from, to } = await page.evaluate(() => globalThis.flexwright.parts.explore.spec.inputs[0]);
        for (const share of [0.3, 0.7]) {
            await page.mouse.move(box.x + share * box.width, box.y + box.height / 3);
            const said = await page.textContent(".explore-tip:not([hidden])");
            const [, x, value] = /^\S.* ([\d.]+) um: \w+, ([\d.]+) %/.exec(said) ?? assert.fail(said);
            const there = list.find((p) => p.x === Number(x));
            assert.equal(value, String(Number(there.value.toPrecision(4))));
            assert.equal(/; told between judged devices, by at most \S+ % off/.test(said), Boolean(there.told), said);
            const mark = await page.locator(".explore-under").boundingBox(); // it stands at that device, and none is nearer to the pointer
            const apart = Math.min(...list.map((p) => Math.abs(p.x - (there.x + ((box.x + share * box.width - mark.x - mark.width / 2) / (box.width - 72)) * (to - from)))));
            assert.ok(Math.abs(box.x + share * box.width - mark.x - mark.width / 2) <= (apart / (to - from)) * box.width + 2, said);
        }
        assert.equal(await page.textContent(".explore-readout"), kept);
        await page.mouse.move(box.x + 100, box.y - 40);
        assert.equal(await page.locator(".explore-tip").isVisible(), false);
    });

    test("another text makes it old at once, and new by itself; a held slider, too", async () => {
        await whole(page);
        await setText(page, ['safety-factor="2"', 'safety-factor="3"']);
        assert.equal(await page.evaluate(() => globalThis.flexwright.parts.explore.showing.element.dataset.of), "former");
        const p = await first(page);
        assert.ok(p.x === 8);
        await page.evaluate(() => globalThis.flexwright.parts.editor.undo());
        const q = await first(page);
        assert.notEqual(q.value, p.value);
        const slider = page.locator('input[data-parameter="leaf"]');
        await slider.evaluate((e) => {
            e.value = 500;
            e.dispatchEvent(new Event("input"));
        });
        const held = await first(page);
        const leaf = await page.evaluate(() => globalThis.flexwright.state.set.leaf);
        assert.equal(held.value, check(server.file, "--corners", "none", "--hinge-model", "revolute", "--set", `leaf=${leaf}`).governing.utilisation * 100);
        await answered(page, () => slider.evaluate((e) => e.dispatchEvent(new Event("change"))));
        await page.click("#undo");
        await whole(page);
    });

    test("Cancel stops it: what is there stays, and Compute begins anew", async () => {
        await setText(page, ['safety-factor="2"', 'safety-factor="2.5"']);
        await page.waitForFunction(() => globalThis.flexwright.parts.explore.control && globalThis.flexwright.parts.explore.asked > 0, null, { timeout: LONG });
        await page.click("#panel-explore .job-bar .cancel");
        await page.waitForFunction(() => !globalThis.flexwright.parts.explore.control);
        await page.waitForTimeout(700); // it does not begin by itself again
        assert.equal(await page.evaluate(() => globalThis.flexwright.parts.explore.whole), false);
        assert.match(await page.textContent("#panel-explore .job-message"), /not all of it: stopped|former input/);
        await page.click("#explore-start");
        await whole(page);
        await page.evaluate(() => globalThis.flexwright.parts.editor.undo()); // the next range is computed for that text
    });

    test("what cannot be made is said, and a range that is none", async () => {
        await setRange(page, "First", "-2 um", "16 um");
        await whole(page);
        assert.ok((await points(page)).some((p) => p.state === "failed" && p.why));
        await page.fill('[aria-label="First input, to"]', "-9 um");
        await page.press('[aria-label="First input, to"]', "Tab");
        assert.match(await page.textContent("#panel-explore .job-message"), /needs two numbers in um, the smaller one first/);
        assert.ok(await page.isDisabled("#explore-start"));
        await setRange(page, "First", "6 um", "16 um");
    });

    test("a number that the input does nothing to is a flat line", async () => {
        await page.selectOption('select[aria-label="Vary"]', "scene[push]/force/@fx");
        await page.selectOption('select[aria-label="Number"]', "frequency");
        await page.waitForFunction(() => globalThis.flexwright.parts.explore.spec.number.id === "frequency" && globalThis.flexwright.parts.explore.done.size > 9, null, { timeout: LONG });
        const list = await points(page);
        assert.ok(list.every((p) => Math.abs(p.value / list[0].value - 1) < 1e-6 && p.value > 0 && p.state !== "run"), JSON.stringify(list[0]));
        assert.equal(await page.textContent("#panel-explore .job-errors"), "");
        await page.selectOption('select[aria-label="Number"]', "governing");
        await page.selectOption('select[aria-label="Vary"]', "width");
        await whole(page);
    });

    test("saved as CSV and SVG: every point, and a picture that is drawn by itself", async () => {
        const [csv] = await Promise.all([page.waitForEvent("download"), page.click('.explore-body button:has-text("Save as CSV")')]);
        const rows = readFileSync(await csv.path(), "utf8").trim().split("\n");
        const told = await toldOf(page), judged = await points(page);
        assert.equal(rows.length - 1, judged.length + told.length);
        assert.match(rows[0], /^width \(um\),.*low,high,decision$/);
        assert.match(rows[0], /^width \(um\),judged or told,off by at most \(%\),/);
        for (const [list, word, off] of [[judged, "judged", ""], [told, "told", null]])
            for (const p of list) {
                const row = rows.find((x) => x.startsWith(`${p.x},`)).split(",");
                assert.deepEqual([row[1], row[2], row.at(-1)], [word, off ?? String(Math.max(p.off.value, p.off.low, p.off.high)), p.state]);
            }
        const [svg] = await Promise.all([page.waitForEvent("download"), page.click("#explore-svg")]);
        const drawn = readFileSync(await svg.path(), "utf8");
        assert.match(drawn, /^<svg [^]*Share of the limit that governs[^]*<\/svg>\n$/);
        // a dot for each judged device, the line through those that are told as well
        assert.equal(/<path d="((?:M[\d.]+ [-\d.]+h4)+)"/.exec(drawn)[1].split("M").length - 1, judged.length);
        assert.match(drawn, />told<\/text>[^]*>judged<\/text>[^]*>least<\/text>/);
    });

    test("two inputs are a map, each cell what check says; no serious finding of axe", async () => {
        await page.selectOption('select[aria-label="and vary"]', "leaf");
        await page.waitForFunction(() => globalThis.flexwright.parts.explore.spec?.inputs.length === 2 && globalThis.flexwright.parts.explore.done.size > 100 && !globalThis.flexwright.parts.explore.control, null, { timeout: LONG }); // it is drawn anew until then
        const cells = await points(page);
        for (const c of [cells[0], cells[cells.length - 1]]) {
            const told = check(server.file, "--corners", "none", "--hinge-model", "revolute", "--set", `width=${c.x} um`, "--set", `leaf=${c.y} um`);
            assert.equal(c.state, told.verdict);
            assert.equal(c.value, told.governing.utilisation * 100);
        }
        // the scale beside it has numbers: from nothing to the limit of what is used, all of them inside the picture
        const bar = await page.locator(".explore-bar text").allTextContents();
        assert.ok(bar.includes("limit") && bar.includes("100 %") && bar.includes("0") && bar.length > 4, String(bar));
        const [all, box] = await Promise.all([".explore-plot", ".explore-bar"].map((x) => page.locator(x).boundingBox()));
        assert.ok(box.x > all.x && box.x + box.width <= all.x + all.width && box.y >= all.y && box.y + box.height <= all.y + all.height, JSON.stringify([all, box]));
        if (process.env.FW_SHOT) await page.screenshot({ path: process.env.FW_SHOT });
        await page.evaluate(axeSource);
        const found = await page.evaluate(() => globalThis.axe.run("#panel-explore", { resultTypes: ["violations"] }));
        assert.deepEqual(found.violations.filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => [v.id, v.nodes.map((n) => n.html)]), []);
        await page.selectOption('select[aria-label="and vary"]', "");
    });
});

describe("what is told", () => {
    let server, page;
    before(async () => {
        server = await serve("reference-six-bar");
        page = await open(server, SMALL);
        await view(page, "explore");
        await whole(page);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("a curve of 200 values stands after few judged devices, and others that are judged behind it come as told", async () => {
        const { filled, checked, missed, places } = await page.evaluate(() => {
            const { filled, checked, missed, places } = globalThis.flexwright.parts.explore;
            return { filled, checked, missed, places };
        });
        assert.ok(filled.judged <= 40, `${filled.judged} devices were judged`); // a second of two processors has some 55
        assert.ok(checked >= 15 && missed === 0, `${missed} of ${checked}`);
        const judged = await points(page), told = await toldOf(page);
        const there = new Set([...judged, ...told].map((p) => p.x));
        assert.equal(places.length, 201);
        assert.ok(told.length > 100 && places.every((x) => there.has(x)));
        assert.match(await page.textContent(".explore-summary"), new RegExp(`Values at ${told.length} places between them are told, by at most \\S+ % off; ${checked} that were told and then judged came as told\\.$`));
        // told stretches of the line look otherwise, and only judged devices have signs
        assert.ok((await page.locator(".explore-line.told").count()) > 0);
        assert.ok((await page.locator(".explore-sign:not(.explore-key-sign *)").count()) <= judged.length);
    });

    test("it is what check says of these devices, within what it is said to be off by", async () => {
        const told = await toldOf(page);
        for (let k = 0, seed = 5; k < 8; k++) {
            seed = (seed * 48271) % 2147483647;
            const p = told[seed % told.length];
            const is = check(server.file, "--corners", "none", "--hinge-model", "revolute", "--set", `arc=${p.x} deg`);
            assert.equal(p.state, is.verdict);
            for (const [name, v] of [["value", is.governing.utilisation], ["low", is.governing.utilisation_band[0]], ["high", is.governing.utilisation_band[1]]])
                assert.ok(Math.abs(p[name] - 100 * v) <= p.off[name] && p.off[name] < 0.5, `${name} at ${p.x}: ${p[name]} for ${100 * v}, off by ${p.off[name]}`);
        }
    });

    test("where one that was told is judged otherwise nothing is told", async () => {
        const answerOtherwise = async (route) => {
            const { points: asked } = route.request().postDataJSON();
            const answer = await route.fetch(), json = await answer.json();
            json.points.forEach((p, k) => {
                const i = (Number.parseFloat(asked[k][0]) - 110) / 0.45;
                if (Math.abs((i % 8) - 4) < 1e-6) p.values = p.values.map((v) => 1.02 * v);
            });
            await route.fulfill({ response: answer, json });
        };
        await page.route("**/api/explore", answerOtherwise);
        await page.selectOption('select[aria-label="Vary"]', "link");
        await page.waitForFunction(() => globalThis.flexwright.parts.explore.spec.inputs[0].what === "link", null, { timeout: LONG });
        await whole(page);
        await page.unroute("**/api/explore", answerOtherwise);
        assert.deepEqual(await toldOf(page), []);
        assert.match(await page.textContent(".explore-summary"), / Nothing is told between these devices: one that was told and then judged came otherwise\.$/);
        assert.equal(await page.locator(".explore-line.told").count(), 0);
    });

    test("a map is told from its first cells on, and judged behind that", async () => {
        await page.selectOption('select[aria-label="Vary"]', "arc");
        await page.selectOption('select[aria-label="and vary"]', "link");
        // counted in the page at that moment: it goes on judging
        const found = await page.waitForFunction(() => {
            const { spec, told, done } = globalThis.flexwright.parts.explore;
            return spec?.inputs.length === 2 && told.length > 500 ? { judged: done.size, told } : null;
        }, null, { timeout: LONG });
        const { judged, told } = await found.jsonValue();
        assert.ok(judged <= 300, String(judged)); // and more than 500 are told
        for (const p of [told[17], told[Math.floor(told.length / 2)], told.at(-40)]) {
            const is = check(server.file, "--corners", "none", "--hinge-model", "revolute", "--set", `arc=${p.x} deg`, "--set", `link=${p.y} um`);
            assert.ok(p.state === is.verdict && Math.abs(p.value - 100 * is.governing.utilisation) <= p.off.value, JSON.stringify(p));
        }
        assert.ok((await page.locator(".explore-judged").count()) > 20);
        await page.click("#panel-explore .job-bar .cancel");
        await page.selectOption('select[aria-label="and vary"]', "");
    });
});

describe("studies", () => {
    let server, page;
    const card = '.study[data-name="size"]';
    before(async () => {
        server = await serve("reference-six-bar");
        page = await open(server, SMALL);
        await view(page, "explore");
        await page.selectOption('select[aria-label="Vary"]', "flexure[C]/@width");
        await setRange(page, "First", "7 um", "12 um");
        await page.click("#study-add");
        await page.waitForSelector(`${card} [data-act="run"]:not([disabled])`);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("a new one is written into the text, and read by the program", async () => {
        assert.match(await text(page), /<study name="size" kind="size" as="drawn">\s*<vary what="flexure\[C\]\/@width" from="7 um" to="12 um"\/>\s*<respond name="used" value="governing.utilisation" goal="minimise"\/>\s*<\/study>/);
    });

    test("one that is added, a comment and a blank line leave what is judged and explored of the device as it is", async () => {
        await page.waitForFunction(() => globalThis.flexwright.settled(true) && globalThis.flexwright.parts.explore.whole, null, { timeout: LONG });
        const now = () => page.evaluate(() => {
            const { explore, verdict } = globalThis.flexwright.parts;
            return { job: verdict.full.job.id, stale: verdict.full.stale, basis: document.querySelector("#banner .as-drawn").textContent, of: document.querySelector("#banner").dataset.of, explored: explore.done.size, present: explore.showing.element.dataset.of };
        });
        const asked = [];
        const listen = (r) => r.method() === "POST" && /\/api\/(jobs|explore)$/.test(r.url()) && asked.push(r.url());
        const before = await now();
        assert.deepEqual([before.stale, before.of, before.present], [false, "present", "present"]);
        page.on("request", listen);
        await answered(page, () => page.click("#study-add"));
        assert.equal(((await text(page)).match(/<study /g) ?? []).length, 2);
        await answered(page, () => setText(page, ["<material ", "<!-- of > nothing -->\n\n  <material "]));
        await page.waitForTimeout(2500); // longer than a text has to rest
        assert.deepEqual(await now(), before);
        assert.deepEqual(asked, []);
        page.off("request", listen);
        for (let i = 0; i < 2; i++) await answered(page, () => page.click("#undo"));
    });

    test("run, stopped, gone on with: nothing that was judged is judged again", async () => {
        await page.click(`${card} [data-act="run"]`);
        await page.waitForFunction((c) => /(\d+) of (?:at most )?\d+ devices/.exec(document.querySelector(`${c} .study-said`).textContent)?.[1] > 2, card, { timeout: LONG });
        await page.click(`${card} [data-act="stop"]`);
        await page.waitForSelector(`${card} [data-act="resume"]`);
        assert.match(await page.textContent(`${card} .study-said`), /^stopped/);
        await page.click(`${card} [data-act="resume"]`);
        await page.waitForSelector(`${card} [data-act="apply"]`, { timeout: LONG });
        assert.equal(await page.getAttribute(`${card} .study-body`, "data-of"), "present");
        const result = await page.evaluate(() => globalThis.flexwright.parts.explore.studies.kept.get("size").job.result);
        assert.equal(result.found.length, 1);
        const directory = `${server.directory}/by-itself`;
        const saved = `${server.directory}/terminal/device.xml`;
        mkdirSync(`${server.directory}/terminal`);
        writeFileSync(saved, await text(page));
        const same = JSON.parse(execFileSync(program, ["study", saved, "-o", directory, "--json"], { cwd: source, stdio: ["ignore", "pipe", "ignore"] }));
        assert.deepEqual(result.found, same.found); // to the last bit what the command finds in one run
        assert.equal(result.samples.run, same.samples.run);
        // what a terminal has left beside the file is opened, and nothing is judged again; what is of another study is not offered
        const other = `${server.directory}/terminal/other.xml`;
        writeFileSync(other, (await text(page)).replace(/<study name="size"[^]*?<\/study>/, '<study name="other" kind="sweep" as="hinges"><vary what="flexure[C]/@width" from="8 um" to="9 um" steps="2"/><respond name="used" value="governing.utilisation"/></study>'));
        execFileSync(program, ["study", other, "-o", `${server.directory}/by-another`, "-q"], { cwd: source, stdio: "ignore" });
        writeFileSync(other, (await text(page)).replace('<study name="size" kind="size"', '<study name="size" kind="size" samples="3"'));
        spawnSync(program, ["study", other, "-o", `${server.directory}/of-few`, "-q"], { cwd: source });
        await view(page, "motion");
        await view(page, "explore");
        await page.waitForSelector(`${card} select[aria-label="Open results of size"]`);
        assert.deepEqual(await page.locator(`${card} select option`).allTextContents(), ["Open results…", "by-itself", "of-few"]);
        // of its name, and asked for something else: that is told in words that can be followed here, and the study stays as it was
        await page.selectOption(`${card} select[aria-label="Open results of size"]`, "of-few");
        await page.waitForSelector('.notice:has-text("The samples in of-few are of study \'size\' with another description, other options")', { timeout: LONG });
        assert.doesNotMatch((await page.locator(".notice").allTextContents()).join(), /FW-D495| -o|--resume/);
        assert.deepEqual(await page.evaluate(() => globalThis.flexwright.parts.explore.studies.kept.get("size").job.result.found), same.found);
        await page.selectOption(`${card} select[aria-label="Open results of size"]`, "by-itself");
        await page.waitForFunction(() => { const k = globalThis.flexwright.parts.explore.studies.kept.get("size"); return k && !k.control; }, null, { timeout: LONG });
        const opened = await page.evaluate(() => { const { job, why } = globalThis.flexwright.parts.explore.studies.kept.get("size"); return { found: job?.result?.found, run: job?.result?.samples.run, seconds: job?.seconds, why }; });
        assert.deepEqual([opened.found, opened.run], [same.found, same.samples.run], opened.why);
    });

    test("its best device becomes the text by one step of the history, and is accepted", async () => {
        const before = await text(page);
        const { path, value } = await page.evaluate(() => globalThis.flexwright.parts.explore.studies.kept.get("size").job.result.found[0].set[0]);
        assert.equal(path, "flexure[C]/@width");
        await answered(page, () => page.click(`${card} [data-act="apply"]`));
        assert.equal(await text(page), before.replace('id="C" kind="csfh" length="200 um" angle="arc" width="8 um"', `id="C" kind="csfh" length="200 um" angle="arc" width="${value}"`));
        assert.equal(await page.getAttribute(`${card} .study-body`, "data-of"), "former");
        assert.match(await page.textContent(`${card} .study-said`), /of the former input/);
        await answered(page, () => page.click("#undo"));
        assert.equal(await text(page), before);
        assert.equal(await page.getAttribute(`${card} .study-body`, "data-of"), "present");
    });

    test("what is used of a limit is in %, in its words, its page and its pictures, as in the verdict", async () => {
        const { used, value } = await page.evaluate(() => {
            const { result } = globalThis.flexwright.parts.explore.studies.kept.get("size").job;
            return { used: result.found[0].responses[0].value, value: result.responses[0].value };
        });
        assert.equal(value, "governing.utilisation");
        const said = (await page.locator(`${card} .study-device`).first().textContent()).match(/\(used (.*?)\)/)[1];
        assert.equal(said, `${Number((100 * used).toPrecision(3))} %`);
        const whole = await (await page.request.get(new URL(await page.locator(`${card} a:has-text("Study page")`).getAttribute("href"), page.url()).href)).text();
        assert.ok(whole.includes(`<td>${said}</td>`) && whole.includes("used (%)"));
        const sources = await page.locator(`${card} .study-pictures img`).evaluateAll((list) => list.map((i) => i.src).filter((x) => /used-/.test(x)));
        assert.ok(sources.length > 0);
        for (const x of sources) {
            const ticks = [...(await (await page.request.get(x)).text()).matchAll(/text-anchor="end">([\d.]+)<\/text>/g)].map((m) => Number(m[1]));
            assert.ok(Math.min(...ticks) <= 100 * used + 20 && Math.max(...ticks) >= 100 * used - 20, `the axis of ${x} has ${ticks} where ${said} are used`);
        }
    });

    test("its page opens, its pictures are shown, its files are saved", async () => {
        const href = await page.locator(`${card} a:has-text("Study page")`).getAttribute("href");
        const answer = await page.request.get(new URL(href, page.url()).href);
        assert.ok(answer.ok() && (await answer.text()).includes("<svg"));
        assert.ok((await page.locator(`${card} .study-pictures img`).count()) > 0);
        const seen = await page.locator(`${card} .study-pictures img`).evaluateAll((list) => Promise.all(list.map((i) => i.decode().then(() => i.naturalWidth > 0, () => false))));
        assert.ok(seen.every(Boolean));
        const [zip] = await Promise.all([page.waitForEvent("download"), page.click(`${card} a:has-text("All files")`)]);
        assert.equal(readFileSync(await zip.path()).subarray(0, 2).toString(), "PK");
    });

    test("loaded anew the page has the study that had ended: of the present input, with its device to be applied", async () => {
        const { found } = await page.evaluate(() => globalThis.flexwright.parts.explore.studies.kept.get("size").job.result);
        page.on("dialog", (d) => d.accept());
        await page.reload();
        await ready(page);
        await view(page, "explore");
        await page.waitForSelector(`${card} [data-act="apply"]`);
        assert.equal(await page.getAttribute(`${card} .study-body`, "data-of"), "present");
        assert.equal(await page.locator(`${card} [data-act^="resume"]`).count(), 0);
        assert.deepEqual(await page.evaluate(() => globalThis.flexwright.parts.explore.studies.kept.get("size").job.result.found), found);
        // and so has another page, which has not begun it
        const second = await page.context().newPage();
        await second.goto(page.url());
        await ready(second);
        await view(second, "explore");
        await second.waitForSelector(`${card} [data-act="apply"]`);
        assert.equal(await second.getAttribute(`${card} .study-body`, "data-of"), "present");
        assert.doesNotMatch(await second.textContent(`${card} .study-said`), /former/);
        await second.close();
    });

    test("of devices that could not be judged one is told with its reason", async () => {
        await page.selectOption('select[aria-label="Vary"]', "flexure[C]/@width");
        await setRange(page, "First", "8 um", "400 um");
        await page.selectOption('select[aria-label="Kind of study"]', "sweep");
        await page.click("#study-add");
        const sweep = '.study[data-name="sweep"]';
        await page.waitForSelector(sweep);
        assert.equal(await page.getAttribute(`${card} .study-body`, "data-of"), "present", "another study in the text is none of its input");
        await page.click(`${sweep} [data-act="run"]:not([disabled])`);
        await page.waitForSelector(`${sweep} .study-body p`, { timeout: LONG });
        const { samples } = await page.evaluate(() => globalThis.flexwright.parts.explore.studies.kept.get("sweep").job.result);
        assert.ok(samples.failed > 0 && samples.run > 0 && samples.example_why, JSON.stringify(samples));
        const said = await page.locator(`${sweep} .study-body p`).first().textContent();
        assert.ok(said.endsWith(`${samples.failed} could not be judged (number ${samples.example_at}: ${samples.example_why}).`), said);
    });
});
