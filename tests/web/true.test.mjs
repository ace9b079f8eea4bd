// SPDX-License-Identifier: GPL-3.0-or-later
// What the page says is true: one utilisation everywhere, reasons where nothing was made, motion inside the picture,
// elements that may be added; narrow screens and forced colours; the address a second time.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { ALL, answered, close, computed, finish, open, program, serve, SMALL, setText, source, text, theBrowser, verdict, view } from "./helper.mjs";

after(finish);

describe("a device that is rejected for fatigue", () => {
    let server, page;
    before(async () => {
        server = await serve("copper-nodder");
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("picture, plot and list have the utilisation of the verdict, and the plot's limit is the one that rules", async () => {
        await verdict(page, "reject");
        const done = spawnSync(program, ["check", server.file, "--corners", "none", "--advice", "none", "--json"], { cwd: source, maxBuffer: 64 << 20 });
        const told = JSON.parse(done.stdout).hinges.find((x) => x.id === "A");
        assert.equal(told.criterion, "fatigue");
        const shown = await page.evaluate(() => {
            const { motion } = globalThis.flexwright.parts;
            const { series, marks } = motion.angles.data;
            return {
                curve: Math.max(...series.find((x) => x.name === "A").values.map(Math.abs)) / 100, limit: marks[0],
                tag: Number(/(\d+) %/.exec(document.querySelector("#panel-motion .hinge-tag[data-id=A]").textContent)[1]) / 100,
                bar: Number(/: ([\d.]+) %/.exec(document.querySelector(".bar[data-hinge=A]").getAttribute("aria-label"))[1]) / 100,
                banner: Number(/hinge A uses ([\d.]+) %/.exec(document.querySelector("#banner").textContent)[1]) / 100,
            };
        });
        // the live answer has pins, the program may look closer: within the band that both state
        const [low, high] = told.utilisation_band;
        for (const [where, share] of Object.entries({ curve: shown.curve, tag: shown.tag, bar: shown.bar, banner: shown.banner })) {
            assert.ok(share >= low && share <= high, `${where}: ${share}, the verdict ${told.utilisation} in [${low}, ${high}]`);
            assert.ok(Math.abs(share - shown.banner) < 0.011, `${where}: ${share}, the banner ${shown.banner}`);
        }
        assert.deepEqual(shown.limit, { y: 100, text: "fatigue limit" });
    });

    test("the lowest frequency is that of check and modes, out of the plane too, in Modes and in Explore", async () => {
        const done = spawnSync(program, ["modes", server.file, "--json"], { cwd: source, maxBuffer: 64 << 20 });
        const told = JSON.parse(done.stdout);
        const [inside, across] = [told.modes[0].f_Hz, told.out_of_plane.modes[0].f_Hz];
        assert.ok(across < inside);
        await view(page, "modes");
        await computed(page, "modes");
        assert.equal(await page.textContent("#panel-modes .mode-lowest strong"), `${Number(across.toPrecision(4))} Hz`);
        await view(page, "explore");
        for (const [id, f] of [["frequency", across], ["frequency-in", inside], ["frequency-out", across]]) {
            await page.selectOption('select[aria-label="Number"]', id);
            await page.waitForFunction((x) => globalThis.flexwright.parts.explore.spec.number.id === x && globalThis.flexwright.parts.explore.done.size > 2, id, { timeout: 60000 });
            const now = await page.evaluate(() => {
                const { done: all, spec } = globalThis.flexwright.parts.explore;
                const [x] = spec.inputs;
                return [...all.values()].reduce((a, b) => (Math.abs(b.x - x.now) < Math.abs(a.x - x.now) ? b : a)).value;
            });
            assert.ok(Math.abs(now / f - 1) < 0.02, `${id}: ${now}, ${f}`);
        }
        await view(page, "motion");
    });

    test("masks and recipes of a rejected design say why there are none, and what was not checked", async () => {
        await view(page, "masks");
        const words = page.locator("#panel-masks .empty:visible", { hasText: "no rule was checked" });
        await words.waitFor({ timeout: 40000 });
        assert.match(await words.textContent(), /rejected.*fatigue/s);
        assert.equal(await page.locator("#panel-masks", { hasText: "No rule is broken" }).count(), 0);
        await view(page, "recipe");
        await page.waitForSelector('#panel-recipe .recipe-body .empty:has-text("No recipe: the design is rejected")', { timeout: 40000 });
        assert.match(await page.textContent("#panel-recipe .recipe-body"), /fatigue/);
    });

    test("the plan is made with the options that were chosen", async () => {
        await view(page, "motion");
        await answered(page, () => page.selectOption('#panel-motion select[aria-label="accuracy"]', "1e-2"));
        const [request] = await Promise.all([page.waitForRequest((r) => r.url().endsWith("/api/jobs") && r.postDataJSON().kind === "plan"), page.click("#download")]);
        assert.deepEqual(request.postDataJSON().options, { accuracy: "1e-2" });
        assert.match(await page.textContent("dialog"), /--accuracy=1e-2/);
        await page.click("dialog .cancel");
    });
});

test("no shipped example opens with a mistake, and every motion stays in its picture", async () => {
    const server = await serve(null);
    const page = await open(server);
    const { readdirSync, readFileSync } = await import("node:fs");
    const files = [...readdirSync(join(source, "docs/gallery")).filter((d) => !d.includes(".")).map((d) => `docs/gallery/${d}/device.xml`),
        ...readdirSync(join(source, "docs/mechanisms")).filter((f) => f.endsWith(".xml")).map((f) => `docs/mechanisms/${f}`)];
    assert.ok(files.length > 10);
    for (const file of files) {
        const outside = await page.evaluate(async (text) => {
            const { parts, state, settled } = globalThis.flexwright;
            parts.editor.open(text);
            while (!settled(false)) await new Promise((resolve) => setTimeout(resolve, 20));
            if (state.preview.motion === null) return ["no motion"];
            const picture = parts.motion.mechanism.svg.getBoundingClientRect();
            const out = [];
            for (let i = 0; i <= 40; i++) {
                parts.motion.seek((parts.motion.t.at(-1) * i) / 40, true);
                for (const b of document.querySelectorAll("#panel-motion .body:not(.fixed)")) {
                    const r = b.getBoundingClientRect();
                    if (r.left < picture.left - 2 || r.right > picture.right + 2 || r.top < picture.top - 2 || r.bottom > picture.bottom + 2) out.push(`${b.dataset.id} at ${i}/40`);
                }
            }
            return [...state.diagnostics.filter((d) => d.severity === "error").map((d) => d.message), ...out.slice(0, 3)];
        }, readFileSync(join(source, file), "utf8"));
        assert.deepEqual(outside, [], file);
    }
    await close(page);
    await server.stop();
});

test("New…: every device to begin from is judged, has its picture, and is one undo away", async () => {
    const server = await serve("leaf-four-bar"); // to which each undo returns: the cheapest
    const page = await open(server, SMALL);
    // a text of its own: one of the devices to begin from may be this one as it stands, and no answer follows where nothing changes
    await answered(page, () => setText(page, ["</device>", "<!-- mine -->\n</device>"]));
    const before = await page.evaluate(() => globalThis.flexwright.state.text);
    await page.click("#new");
    const names = await page.locator(".template strong").allTextContents();
    assert.ok(names.length >= 9 && ["Empty page", "One leaf", "Six-bar", "Four-bar", "Stage", "Gripper"].every((n) => names.includes(n)), names.join());
    await page.waitForFunction(() => [...document.querySelectorAll(".template img")].every((i) => i.naturalWidth > 100));
    await page.keyboard.press("Escape");
    for (const name of names) {
        await page.click("#new");
        await answered(page, () => page.locator(".template", { has: page.locator(`strong:text-is("${name}")`) }).click());
        await page.waitForFunction(() => globalThis.flexwright.settled(false));
        if (name === "Empty page") { // it is no mistake, and says what to do
            assert.match(await page.innerText("#right .problems"), /^nothing is drawn yet/i);
            assert.ok(await page.isVisible("#panel-draw"));
            await answered(page, () => page.evaluate(() => globalThis.flexwright.parts.editor.undo()));
            continue;
        }
        assert.deepEqual(await page.evaluate(() => globalThis.flexwright.state.diagnostics.filter((d) => d.severity === "error").map((d) => d.message)), [], name);
        assert.equal(await page.evaluate(() => globalThis.flexwright.state.preview.verdict.verdict), name === "Copper nodder" ? "reject" : "accept", name);
        await page.evaluate(() => globalThis.flexwright.parts.editor.undo());
        assert.equal(await page.evaluate(() => globalThis.flexwright.state.text), before, name);
    }
    await close(page);
    await server.stop();
});

describe("what is added", () => {
    // what needs a place that only a person knows; a third flow needs a scene of its own
    const NEEDS_A_PERSON = new Set(["mechanism>revolute", "mechanism>prismatic", "mechanism>weld", "body>outline", "body>lettering", "device>flow", "device>cell"]);
    // every element is written into each device; what it comes to is judged in one of them, the cheapest that can have it, and with all tests in each
    const judged = new Set();
    for (const device of ["leaf-four-bar", "free-form-gripper", "reference-six-bar"])
        test(`Add… writes what the description takes: ${device}`, async () => {
            const server = await serve(device);
            const page = await open(server, SMALL);
            const wrong = await page.evaluate(async ([known, before]) => {
                const { state, parts } = globalThis.flexwright;
                const { token } = await (await fetch("/api/session")).json();
                const post = async (path, body) => (await fetch(path, { method: "POST", headers: { "X-Flexwright-Token": token, "Content-Type": "application/json" }, body: JSON.stringify(body) })).json();
                const seen = new Set();
                const list = [];
                for (const element of parts.form.places.values())
                    for (const kind of parts.form.kinds(element)) {
                        const name = `${element.name}>${kind.name}`;
                        if (seen.has(name)) continue;
                        seen.add(name);
                        const edited = await post("/api/edit", { text: state.text, changes: parts.form.adding(element, kind) });
                        if (edited.status !== "ok") list.push(`${name}: ${edited.diagnostics?.[0]?.message ?? edited.error?.message}`);
                        else if (!known.includes(name) && !before.includes(name)) list.push(...(await post("/api/preview", { text: edited.text })).diagnostics.filter((d) => d.severity === "error").map((d) => `${name}: ${d.message}`));
                    }
                return { list, seen: [...seen] };
            }, [[...NEEDS_A_PERSON], ALL ? [] : [...judged]]);
            wrong.seen.forEach((name) => judged.add(name));
            assert.ok(wrong.seen.length > 15);
            assert.deepEqual(wrong.list, []);
            await close(page);
            await server.stop();
        });
});

describe("for everybody", () => {
    let server;
    before(async () => {
        server = await serve("reference-six-bar");
    });
    after(() => server.stop());

    test("Tab leaves the editor", async () => {
        const page = await open(server);
        await page.click("#tab-xml");
        const before = await page.evaluate(() => globalThis.flexwright.parts.editor.text);
        await page.click("#editor .cm-content");
        await page.keyboard.press("Tab");
        assert.ok(!(await page.evaluate(() => document.activeElement.id === "editor")), "the focus stays in the editor");
        assert.equal(await page.evaluate(() => globalThis.flexwright.parts.editor.text), before);
        await close(page);
        await server.halt();
        await server.restart();
    });

    for (const width of [800, 390])
        test(`at ${width} pixels: decision, picture, then the rest, nothing beside the screen, with the text shown, too`, async () => {
            const page = await open(server, { width, height: 844 });
            for (const tab of ["form", "xml"]) {
                await page.click(`#tab-${tab}`);
                const seen = await page.evaluate(() => ({ wide: document.documentElement.scrollWidth - innerWidth, tops: ["banner", "centre", "edit"].map((id) => document.getElementById(id).getBoundingClientRect().top), widths: ["centre", "edit"].map((id) => document.getElementById(id).getBoundingClientRect().width / innerWidth), stage: document.querySelector("#panel-motion .stage").clientHeight }));
                assert.ok(seen.wide <= 0 && seen.tops[0] < seen.tops[1] && seen.tops[1] < seen.tops[2] && seen.widths.every((w) => w > 0.9) && seen.stage > 250, JSON.stringify(seen));
            }
            await close(page);
            await server.halt();
            await server.restart();
        });

    test("with forced colours the bars, the curves and the picture are still there", async () => {
        const page = await open(server, { forcedColors: "active" });
        const seen = await page.evaluate(() => [getComputedStyle(document.querySelector(".bar-fill")).backgroundColor, getComputedStyle(document.querySelector(".bar-track")).backgroundColor, getComputedStyle(document.querySelector(".stage")).forcedColorAdjust]);
        assert.notEqual(seen[0], seen[1]);
        assert.equal(seen[2], "none");
        await close(page);
    });

    test("the address a second time says in words what to do", async () => {
        const context = await (await theBrowser()).newContext();
        const page = await context.newPage();
        const answer = await page.goto(server.url);
        assert.equal(answer.status(), 403);
        assert.match(await page.textContent("body"), /used already.*start it again/s);
        await context.close();
    });
});

describe("a device whose bodies' centres of mass are not where their frames are", () => {
    let server, page;
    before(async () => {
        server = await serve("comb-stage");
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });
    /** Farthest that a body of this view stands from where it is drawn: um, and radians. */
    const off = (id) => page.evaluate((p) => {
        const { q, rest } = globalThis.flexwright.parts[p].mechanism;
        return [0, 1].map((angle) => Math.max(...q.map((pose, i) => (angle ? Math.abs(pose[2] - rest[i][2]) : 1e6 * Math.hypot(pose[0] - rest[i][0], pose[1] - rest[i][1])))));
    }, id);

    test("assembled without a change they stand in the picture where they are drawn, and near it at the least amplitude of a mode", async () => {
        await view(page, "assembly");
        await computed(page, "assembly");
        assert.equal(await page.evaluate(() => globalThis.flexwright.parts.assembly.result.moved_m), 0);
        assert.ok((await off("assembly")).every((x) => x < 1e-3), `${await off("assembly")}`);
        await view(page, "modes");
        await computed(page, "modes");
        await page.fill('#panel-modes input[type="range"]', "1");
        const [um, rad] = await off("modes");
        assert.ok(um < 10 && rad < 0.005, `${um} um, ${rad} rad`); // 0.0045 rad about a hinge 0.8 mm away
    });

    test("a mode leaves what a flexure holds together at the flexure: its ends part by no more than the bend of a small motion", async () => {
        await page.fill('#panel-modes input[type="range"]', "10");
        const parted = await page.evaluate(() => {
            const { mechanism } = globalThis.flexwright.parts.modes;
            const { preview: p } = globalThis.flexwright.state;
            const placed = (id, at) => { // a point of a body as it is drawn, where the mode has it
                const i = p.bodies.findIndex((b) => b.id === id);
                if (i < 0 || p.bodies[i].fixed) return at;
                const [a, b] = [mechanism.rest[i], mechanism.q[i]];
                const [x, y] = [at[0] - 1e6 * a[0], at[1] - 1e6 * a[1]], [c, s] = [Math.cos(b[2] - a[2]), Math.sin(b[2] - a[2])];
                return [1e6 * b[0] + c * x - s * y, 1e6 * b[1] + s * x + c * y];
            };
            return p.pins.map((pin, k) => {
                const [one, other] = p.flexures[k].between.map((id) => placed(id, pin.at_um));
                return Math.hypot(one[0] - other[0], one[1] - other[1]);
            });
        });
        assert.ok(parted.every((d) => d < 10), `hinges part by ${parted} um`);
    });
});

test("masks: the flow can be chosen before any mask is made; workspace: at rest no hinge governs", async () => {
    const server = await serve("reference-six-bar");
    const page = await open(server, { width: 1000, height: 700 });
    await page.route("**/api/jobs", (route) => new Promise((resolve) => setTimeout(resolve, 1500)).then(() => route.continue()));
    await view(page, "masks");
    assert.equal(await page.evaluate(() => globalThis.flexwright.parts.masks.result), undefined);
    assert.deepEqual(await page.locator('#panel-masks select[aria-label="Flow"] option').allTextContents(), ["al-masked-rie", "copper-on-porous-silicon"]);
    await page.selectOption('#panel-masks select[aria-label="Flow"]', "copper-on-porous-silicon");
    await computed(page, "masks", 60000);
    assert.equal(await page.inputValue('#panel-masks select[aria-label="Flow"]'), "copper-on-porous-silicon");
    assert.ok((await page.locator("#panel-masks .file-list").first().textContent()).includes("copper-on-porous-silicon"));
    await view(page, "workspace");
    await page.waitForSelector('.pose-status:has-text("At rest: no hinge is bent.")');
    await page.fill("#pose-x_m", "50");
    await page.press("#pose-x_m", "Enter");
    await page.waitForSelector('.pose-status:has-text("governs with")');
    await close(page);
    await server.stop();
});

test("a slider below what can be made says why at its place, and from which value on it works", async () => {
    const server = await serve("leaf-four-bar");
    const page = await open(server, SMALL);
    const box = page.locator('.slider[data-name="width"] .slider-wrong');
    const slide = (value) => answered(page, () => page.fill('#panel-form input[type="range"][data-parameter="width"]', value));
    await answered(page, () => setText(page, ['min="6 um"', 'min="1 um"']));
    const directory = mkdtempSync(join(tmpdir(), "fw-slider-"));
    const file = join(directory, "device.xml");
    writeFileSync(file, await text(page));
    const decision = (value) => spawnSync(program, ["check", file, "--corners", "none", "--advice", "none", "--hinge-model", "revolute", "-q", "--set", `width=${value} um`], { cwd: source }).status;
    assert.ok(await box.isHidden());
    await slide("2");
    await box.getByText(/At 2 um: link rocker and frame, upper half meet/).waitFor();
    await box.getByText(/accepted from/).first().waitFor();
    const said = /accepted from ([\d.]+) um on/.exec(await box.getByText(/accepted from/).first().textContent());
    const from = Number(said[1]);
    assert.equal(decision(from), 0);
    assert.notEqual(decision(from - 0.1), 0);
    await slide("10");
    await box.waitFor({ state: "hidden" });
    // a hinge alone rejects it
    await answered(page, () => setText(page, ['safety-factor="2"', 'safety-factor="4.8"']));
    await slide("6");
    await box.getByText(/At 6 um: hinge A uses 1\d\d\.\d % of its elastic limit/).waitFor();
    await box.getByText(/accepted (from|at)/).first().waitFor();
    await slide("10");
    await answered(page, () => setText(page, ['safety-factor="4.8"', 'safety-factor="2"']));
    await box.waitFor({ state: "hidden" });
    // in another unit than its ends: the value is the only mistake, all of its sentence is told, and what works is found
    const typed = page.locator('.slider[data-name="width"] input.value');
    await typed.fill("10 mm");
    await typed.press("Enter");
    await box.getByText(/At 10 mm: .*its declaration allows at most/).waitFor();
    await box.getByText(/accepted/).first().waitFor();
    await typed.fill("10 \u00b5m");
    await typed.press("Enter");
    await box.waitFor({ state: "hidden" });
    await page.waitForSelector('#banner[data-of="present"]');
    await typed.fill("10 um");
    await answered(page, () => typed.press("Enter"));
    // what cannot be drawn at all says so at the same place, and the button goes to the value
    await answered(page, () => setText(page, ['min="1 um"', 'min="-4 um"']));
    await slide("-2");
    await box.getByText(/At -2 um: /).waitFor();
    await box.getByRole("button", { name: `Use ${from} um` }).or(box.getByRole("button", { name: /^Use/ })).click();
    await box.waitFor({ state: "hidden" });
    assert.ok(Math.abs(Number.parseFloat(await page.inputValue('.slider[data-name="width"] input.value')) - from) < 0.1);
    rmSync(directory, { recursive: true });
    await close(page);
    await server.stop();
});

test("a device that cannot be drawn reaches nothing: no value of a former one is left under what it is for", async () => {
    const server = await serve("free-form-gripper");
    const page = await open(server, SMALL);
    await page.waitForSelector(".purpose dd.accept");
    await answered(page, () => setText(page, ['value="0.6 mm" min="0.55 mm"', 'value="0.3 mm" min="0.2 mm"']));
    await page.waitForSelector('#banner[data-verdict="failed"]');
    assert.equal(await page.locator(".purpose").count(), 0);
    assert.ok(await page.locator("#panel-motion .overlap").count() > 0);
    await close(page);
    await server.stop();
});
