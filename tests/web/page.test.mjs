// SPDX-License-Identifier: GPL-3.0-or-later
// The page in a browser: what a researcher does with a device, from opening it to reading a run sheet.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import { after, before, describe, test } from "node:test";
import { ALL, answered, axeSource, close, computed, finish, open, program, serve, setText, source, text, theBrowser, verdict, view } from "./helper.mjs";

after(finish);

describe("the six-bar", () => {
    let server, page;
    before(async () => {
        server = await serve("reference-six-bar");
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("its address opens once", async () => {
        assert.ok(!page.url().includes("token"), "the token stays in the address bar");
        const other = await (await theBrowser()).newContext();
        const second = await other.newPage();
        const answer = await second.goto(server.url);
        assert.ok(answer.status() >= 400, `the token was taken twice: ${answer.status()}`);
        await other.close();
    });

    test("a verdict with the governing hinge, a bar for every hinge", async () => {
        await verdict(page, "accept");
        const told = JSON.parse(execFileSync(program, ["check", server.file, "--corners", "none", "--json"], { cwd: source, stdio: ["ignore", "pipe", "ignore"] }));
        // in the same words as the terminal: of the drawing at first, as it will be made as soon as that is known
        const first = await page.evaluate(() => globalThis.flexwright.state.preview);
        assert.deepEqual(first.verdict.summary, told.summary);
        assert.deepEqual(first.verdict.governing, told.governing);
        await page.waitForSelector(".as-drawn:text-is('as it will be made')");
        const made = JSON.parse(execFileSync(program, ["check", server.file, "--json"], { cwd: source, stdio: ["ignore", "pipe", "ignore"] }));
        const lines = await page.locator("#banner .top-line").allTextContents();
        assert.equal(lines.length, made.summary.length);
        made.summary.forEach((line, i) => assert.equal(lines[i].replace(/[: ]/g, ""), `${line.label}${line.text}`.replace(/[: ]/g, "")));
        assert.match(await page.locator(".bar.governs").getAttribute("aria-label"), new RegExp(`^Hinge ${made.governing.id}: `));
        assert.equal(await page.locator(".bar").count(), told.hinges.length);
        const flow = made.flows[1];
        const worst = flow.hinges.reduce((a, b) => (b.as_fabricated.utilisation > a.as_fabricated.utilisation ? b : a));
        await page.selectOption('select[aria-label="Utilisation in"]', flow.id);
        assert.match(await page.locator(".bar.governs").getAttribute("aria-label"), new RegExp(`^Hinge ${worst.id}: ${(100 * worst.as_fabricated.utilisation).toPrecision(3)} % of its limit as made`));
        await page.selectOption('select[aria-label="Utilisation in"]', "");
    });

    test("the form is the table: unit, range, default and sentence of an attribute", async () => {
        await page.click('summary:has(.element-name:text-is("flexure"):visible) >> nth=0');
        const field = page.locator('.field:has([data-path="device/flexure[A]/@length"])');
        await field.locator("input").focus();
        const help = await field.locator(".help").textContent();
        const table = await page.evaluate(() => globalThis.flexwright.state.table.elements.find((e) => e.name === "flexure").attributes.find((a) => a.name === "length"));
        assert.ok(help.includes(table.sentence) && help.includes(table.unit), help);
        assert.equal(await field.locator("input").inputValue(), "300 um");
    });

    test("a number of the form changes these bytes of the text and no other; undo and redo", async () => {
        const before = await text(page);
        const input = page.locator('[data-path="device/flexure[A]/@length"]');
        await answered(page, async () => {
            await input.fill("312 um");
            await input.press("Enter");
        });
        const now = await text(page);
        assert.equal(now, before.replace('id="A" kind="csfh" length="300 um"', 'id="A" kind="csfh" length="312 um"'));
        await answered(page, () => page.click("#undo"));
        assert.equal(await text(page), before);
        assert.equal(await input.inputValue(), "300 um");
        await answered(page, () => page.click("#redo"));
        assert.equal(await text(page), now);
        await answered(page, () => page.keyboard.press("Control+z"));
        assert.equal(await text(page), before);
    });

    test("elements are added and removed", async () => {
        const before = await text(page);
        const scene = page.locator('details.element:has(> summary .element-id:text-is("gentle-step"))');
        await scene.locator("> summary").click();
        await page.evaluate(() => globalThis.flexwright.parts.editor.text.length);
        await scene.locator("> .element-body > .element-tools select.add").selectOption("gravity");
        await page.waitForFunction((n) => /<scene name="gentle-step"[^]*<gravity[^]*<\/scene>/.test(globalThis.flexwright.state.text) && globalThis.flexwright.state.text.length > n, before.length);
        await page.click("#undo");
        await page.waitForFunction((t) => globalThis.flexwright.state.text === t, before);
    });

    test("motion: time moves bodies and cursors, a scene and a method are chosen", async () => {
        await view(page, "motion");
        const place = () => page.locator('#panel-motion .body[data-id="CD"]').getAttribute("transform");
        const slider = page.locator("input.time");
        await slider.focus();
        await page.keyboard.press("Home");
        const rest = await place();
        assert.match(await page.locator(".clock").textContent(), /^0 s/);
        for (let i = 0; i < 30; i++) await page.keyboard.press("ArrowRight");
        assert.notEqual(await place(), rest);
        const value = await page.locator(".plot-value").first().textContent();
        await page.locator(".plot-box").first().click({ position: { x: 220, y: 60 } });
        assert.notEqual(await page.locator(".plot-value").first().textContent(), value);
        await page.click('button[aria-label="Play"]');
        const begin = await place();
        await page.waitForFunction((t) => document.querySelector('#panel-motion .body[data-id="CD"]').getAttribute("transform") !== t, begin);
        await page.click('button[aria-label="Pause"]');
        await answered(page, () => page.selectOption('select[aria-label="method"]', "minimal"));
        assert.match(await page.textContent(".run-stats"), /^minimal/);
        await answered(page, () => page.selectOption('select[aria-label="integrator"]', "radau5"));
        assert.match(await page.textContent(".run-stats"), /radau5/);
        await answered(page, () => page.selectOption('select[aria-label="tolerance"]', "1e-8"));
        assert.match(await page.textContent(".run-stats"), /rtol 1\.0e.8/);
        await answered(page, () => page.selectOption('select[aria-label="tolerance"]', ""));
        await answered(page, () => page.selectOption("#scene", "gentle-step"));
        assert.equal(await page.evaluate(() => globalThis.flexwright.state.preview.motion.scene), "gentle-step");
        for (const label of ["method", "integrator"]) await answered(page, () => page.selectOption(`select[aria-label="${label}"]`, ""));
        await answered(page, () => page.selectOption("#scene", "step-load"));
    });

    test("a bent flexure at rest is its outline, and hinges are told by number and colour", async () => {
        const worst = await page.evaluate(() => {
            const { mechanism } = globalThis.flexwright.parts.motion;
            const q = globalThis.flexwright.state.preview.bodies.map((b) => b.rest ?? [0, 0, 0]);
            mechanism.pose(q);
            const box = (d) => {
                const p = document.createElementNS("http://www.w3.org/2000/svg", "path");
                p.setAttribute("d", d);
                document.querySelector("svg").append(p);
                const b = p.getBBox();
                p.remove();
                return [b.x, b.y, b.x + b.width, b.y + b.height];
            };
            return Math.max(...globalThis.flexwright.state.preview.flexures.flatMap((f, i) => {
                const a = box(f.path);
                return box(mechanism.flexures[i].path.getAttribute("d")).map((v, k) => Math.abs(v - a[k]));
            }));
        });
        assert.ok(worst < 0.2, `bent at rest it is ${worst} um off`); // chords of 5 um on radii of 60 um and more: 0.05 um
        await page.locator("input.time").press("End");
        assert.match(await page.locator("#panel-motion .hinge-tag[data-id=A]").textContent(), /^A \d+ %$/);
    });

    test("the platform is dragged: hinges follow, colours and words tell the limit", async () => {
        await view(page, "workspace");
        await page.waitForSelector(".pose-status.good");
        const handle = page.locator("#panel-workspace .handle[role=slider]");
        const b = await handle.boundingBox();
        const [x, y] = [b.x + b.width / 2, b.y + b.height / 2];
        const scale = await page.evaluate(() => globalThis.flexwright.parts.workspace.mechanism.view.k);
        await page.mouse.move(x, y);
        await page.mouse.down();
        for (let i = 1; i <= 6; i++) await page.mouse.move(x + i * 8, y);
        await page.mouse.up();
        const moved = Number(await page.inputValue("#pose-x_m"));
        assert.ok(Math.abs(moved - 48 / scale) < 1, `${moved} um for 48 pixels of ${1 / scale} um`);
        await page.waitForFunction(() => parseFloat(document.querySelector(".pose-hinge .bar-value").textContent) !== 0);
        await handle.focus();
        await page.keyboard.press("Home");
        await page.keyboard.press("Shift+ArrowUp");
        await page.keyboard.press("]");
        assert.deepEqual([Number(await page.inputValue("#pose-x_m")), Number(await page.inputValue("#pose-y_m")), Number(await page.inputValue("#pose-phi_rad"))], [0, 50, -0.1]);
        await page.fill("#pose-x_m", "1500");
        await page.press("#pose-x_m", "Enter");
        await page.waitForSelector(".pose-status.bad");
        await page.waitForSelector("#panel-workspace .hinge-tag.over");
        await handle.press("Home");
        await page.waitForSelector(".pose-status.good");
    });

    test("modes and assembly are computed and shown", async () => {
        await view(page, "modes");
        await computed(page, "modes");
        assert.equal(await page.locator(".mode").count(), 3);
        assert.match(await page.locator(".mode").first().textContent(), /510\.8 Hz/);
        const said = await page.textContent("#panel-modes .job-content");
        assert.match(said, /Lowest of all: 510\.8 Hz, in the plane\./);
        assert.match(said, /These frequencies are off by up to 0\.86 %/);
        assert.match(said, /Out of the plane521\.7 Hz CD goes up and down/);
        assert.match(await page.textContent("#right .across"), /swings out of the plane from 521\.7 Hz on \(.*Drying: /s);
        await view(page, "assembly");
        await computed(page, "assembly");
        assert.match(await page.textContent("#panel-assembly .job-content"), /3: 15 coordinates, 12 conditions/);
        assert.ok(await page.locator("#panel-assembly .ghost g").count() >= 5);
    });

    test("masks: outlines lie on the layers, also where they were made while another tab was looked at; layers hide, the ruler measures", async () => {
        await view(page, "masks");
        await page.waitForFunction(() => globalThis.flexwright.parts.masks.job.control !== null);
        await view(page, "motion");
        await page.waitForFunction(() => globalThis.flexwright.parts.masks.job.control === null && globalThis.flexwright.parts.masks.done, null, { timeout: 60000 });
        await view(page, "masks");
        await computed(page, "masks");
        const off = await page.evaluate(() => {
            const m = globalThis.flexwright.parts.masks;
            const box = (e) => e.getBoundingClientRect();
            const a = box(m.layers.querySelector('[data-gds="1/0"]'));
            const b = box(m.outlines.querySelector('[data-kind="mask"]'));
            const drawn = box(m.outlines.querySelector('[data-kind="drawn"]'));
            const plan = box(m.drawing);
            return [a.left - b.left, a.bottom - b.bottom, drawn.left - plan.left, drawn.top - plan.top].map((v) => Math.abs(v) / m.view.k);
        });
        assert.ok(off.every((v) => v < 0.05), `outlines are off by ${off} um`);
        await page.locator(".layer-row input").first().uncheck();
        await page.waitForSelector('#panel-masks .layers [data-gds="1/0"].none', { state: "attached" });
        await page.click('#panel-masks button:has-text("Ruler")');
        const b = await page.locator(".mask-picture").boundingBox();
        const scale = await page.evaluate(() => globalThis.flexwright.parts.masks.view.k);
        await page.mouse.click(b.x + 100, b.y + 300);
        await page.mouse.click(b.x + 250, b.y + 300);
        const words = await page.getAttribute(".mask-stage", "data-ruler");
        assert.ok(Math.abs(parseFloat(words) - 150 / scale) < 0.01 * (150 / scale), words);
        await page.locator(".mask-picture").focus();
        await page.keyboard.press("+");
        assert.ok((await page.evaluate(() => globalThis.flexwright.parts.masks.view.k)) > scale);
        await page.selectOption('#panel-masks select[aria-label="Cell"]', "-coupons");
        await page.waitForFunction(() => document.querySelectorAll("#panel-masks .layers path").length > 500);
        await page.selectOption('#panel-masks select[aria-label="Cell"]', "");
        await page.click('#panel-masks button:has-text("Ruler")');
    });

    test("a rejected design has no masks, unless they are asked for all the same", async () => {
        const good = await text(page);
        await answered(page, () => setText(page, ['strength="2.5 GPa"', 'strength="0.9 GPa"']));
        await verdict(page, "reject");
        await page.waitForSelector("#panel-masks .empty:has-text('no rule was checked')", { timeout: 30000 });
        await page.locator('#panel-masks label:has-text("though it is rejected") input').check();
        await page.waitForFunction(() => /REJECTED/.test(globalThis.flexwright.parts.masks.result?.masks[0]?.cell));
        await page.waitForFunction(() => document.querySelectorAll("#panel-masks .layers path").length > 20);
        await page.locator('#panel-masks label:has-text("though it is rejected") input').uncheck();
        await page.click("#undo");
        await verdict(page, "accept");
        assert.equal(await text(page), good);
    });

    test("recipes: times, what is not computable, sections, schedule, a run sheet to read", async () => {
        await view(page, "recipe");
        await computed(page, "recipe");
        await page.waitForSelector(".step");
        assert.ok((await page.locator(".step").count()) > 15);
        assert.match(await page.locator(".step.missing .not-computable").first().textContent(), /NOT COMPUTABLE, missing: \w/);
        assert.ok((await page.locator(".section-picture svg").count()) >= 10); // of the steps that change the wafer
        assert.match(await page.locator(".worth summary").textContent(), /^Measure the .* first \(\w.*of the limit, of [\d.]+ % in all\.$/);
        await page.click(".worth summary");
        const worth = page.locator(".worth tbody tr").first();
        assert.match(await worth.textContent(), /[\d.]+ % → [\d.]+ %/); // what it brings now, and once it is measured
        await page.waitForFunction(() => document.querySelector(".schedule img")?.naturalWidth > 300);
        const [sheet] = await Promise.all([page.context().waitForEvent("page"), page.click('a:has-text("Run sheet")')]);
        await sheet.waitForLoadState();
        assert.match(await sheet.textContent("h1"), /Run sheet/);
        assert.ok((await sheet.locator("section.step").count()) > 15);
        assert.equal(await sheet.evaluate(() => globalThis.origin), "null", "a document of a job has an origin");
        await sheet.close();
    });

    test("as fabricated: the full judgement of the program", async () => {
        await page.click('button:has-text("Judge as fabricated")');
        await page.waitForSelector(".fab", { timeout: 40000 });
        assert.equal(await page.locator(".fab").count(), 2);
    });

    test("everything as one archive, byte for byte what the command line writes", async () => {
        await page.click("#download");
        const link = await page.waitForSelector("a:has-text('Save reference-six-bar.zip')", { timeout: 60000 });
        const [saved] = await Promise.all([page.waitForEvent("download"), link.click()]);
        assert.equal(saved.suggestedFilename(), "reference-six-bar.zip");
        const zip = join(server.directory, "plan.zip");
        await saved.saveAs(zip);
        const [from, to] = [join(server.directory, "unpacked"), join(server.directory, "plan")];
        execFileSync("python3", ["-m", "zipfile", "-e", zip, from]);
        writeFileSync(server.file, await text(page));
        spawnSync(program, ["plan", "device.xml", "-o", "plan", "-q"], { cwd: server.directory, env: { ...process.env, FLEXWRIGHT_DATA: process.env.FLEXWRIGHT_DATA ?? source } });
        const list = (d) => readdirSync(d).flatMap((f) => (statSync(join(d, f)).isDirectory() ? list(join(d, f)) : [join(d, f)])).sort();
        const names = list(to).map((f) => relative(to, f));
        assert.deepEqual(list(from).map((f) => relative(from, f)), names);
        assert.ok(names.includes("verdict.json") && names.some((f) => f.endsWith(".gds")));
        for (const f of names) assert.ok(readFileSync(join(to, f)).equals(readFileSync(join(from, f))), `${f} is another`);
        await page.keyboard.press("Escape");
    });

    test("what a page has begun by itself ends with it, and a study that it has begun is seen and stopped by the next", async () => {
        const device = readFileSync(join(source, "docs/gallery/leaf-four-bar/device.xml"), "utf8").replace("</device>", `<study name="long" kind="yield" samples="4000"><uncertain what="material/@thickness" mean="50 um" sd="0.5 um"/></study></device>`);
        const own = await serve("leaf-four-bar");
        writeFileSync(own.file, device);
        let first;
        try {
            first = await open(own);
            const ask = (p) => p.evaluate(async () => (await (await fetch("/api/jobs", { credentials: "same-origin" })).json()).jobs.filter((j) => ["queued", "running"].includes(j.state)));
            await view(first, "explore");
            await first.click('.study[data-name="long"] [data-act=run]');
            await first.waitForSelector('.study[data-name="long"] [data-act=stop]');
            await first.waitForFunction(async () => (await (await fetch("/api/jobs", { credentials: "same-origin" })).json()).jobs.some((j) => j.kind === "study" && j.state === "running"));
            await first.reload();
            await first.waitForSelector("#banner");
            await first.waitForFunction(async () => (await (await fetch("/api/jobs", { credentials: "same-origin" })).json()).jobs.filter((j) => j.automatic && ["queued", "running"].includes(j.state)).length <= 1);
            assert.equal((await ask(first)).filter((j) => j.kind === "study").length, 1);
            await view(first, "explore");
            await first.click('.study[data-name="long"] [data-act=stop-other]');
            await first.waitForSelector('.study[data-name="long"] [data-act=resume-other]');
            assert.equal((await ask(first)).filter((j) => j.kind === "study").length, 0);
        } finally {
            if (first) await close(first);
            await own.stop();
        }
    });

    test("a job is cancelled, and the next one works", async () => {
        await page.click("#download");
        await page.click("dialog .cancel");
        await page.waitForSelector("dialog", { state: "detached" });
        await view(page, "workspace");
        const cancelled = async () => {
            await page.click('button:has-text("Compute the reachable set")');
            await page.click("#panel-workspace .cancel", { timeout: 2000 }).catch(() => {}); // it may just have ended
            await page.waitForFunction(() => document.querySelector("#panel-workspace .cancel").hidden);
            return /cancelled/.test(await page.textContent("#panel-workspace .job-errors"));
        };
        let tries = 1;
        while (!(await cancelled())) assert.ok(tries++ < 6, "it always ended before it was cancelled");
        await page.click('button:has-text("Compute the reachable set")');
        await page.waitForSelector('#panel-workspace .job-content:has-text("volume")', { timeout: 40000 });
    });

    test("the trade-off is begun and cancelled, or said not to be in this program", async () => {
        await view(page, "accuracy");
        await page.click('button:has-text("Measure the trade-off")');
        const told = await Promise.race([
            page.waitForSelector('#panel-accuracy .job-errors:has-text("not in this version")').then(() => "missing"),
            page.waitForSelector('#panel-accuracy .job-message:has-text("s")', { state: "visible" }).then(() => "running"),
        ]);
        if (told === "running") await page.click("#panel-accuracy .cancel", { timeout: 800 }).catch(() => {}); // it may just have ended
        await page.waitForFunction(() => /cancelled|not in this version/.test(document.querySelector("#panel-accuracy .job-errors").textContent));
    });

    test("what each digit costs is read off a table: cheapest settings, the accuracy wanted, what the model is off by", async () => {
        const point = (method, integrator, rtol, error, instructions, front = true) => ({ method, integrator, rtol, state: "done", error, at_most: false, estimated: 10 * error, steps: 50, instructions, instructions_by: "callgrind", front, time: { told: true, ratio: instructions / 4e6, low: 0, high: 1, pairs: 25 } });
        const result = {
            schema: "flexwright.tradeoff/1", accuracy_wanted: 1e-3, chosen: { ...point("chain", "dop853", 3e-6, 3e-5, 4e6, false), over_cheapest: 2, cpu_s: 1e-3, quasi_static: false },
            summary: { digit_here: 1.25, digit_overall: 3, floor: 0.02, floor_what: "solid" }, instructions_why: null, models: [], masks: [],
            points: [point("chain", "dopri5", 1e-3, 4e-2, 1e6), point("chain", "dopri5", 1e-5, 5e-4, 2e6), point("svd", "rk4", 1e-5, 5e-4, 9e6, false), point("chain", "dop853", 1e-7, 8e-7, 8e6), { method: "qr", integrator: "rk4", rtol: 1e-3, state: "skipped", why: "too slow" }],
        };
        await page.evaluate((r) => {
            const { job } = globalThis.flexwright.parts.accuracy;
            job.content.hidden = false;
            job.render({ id: 0, result: r, files: [] }, job.content);
        }, result);
        const facts = await page.locator("#panel-accuracy .fact strong").allTextContents();
        assert.deepEqual(facts, ["25 % more work", "2 %", "chain, dop853", "2 ×"]);
        const rows = await page.locator("table.digits tbody tr").evaluateAll((list) => list.map((r) => [...r.children].map((c) => c.textContent.trim()).filter(Boolean).join("; ")));
        assert.deepEqual(rows, [
            "10 %; 1 M instr.; 250 µs; chain, dopri5, 0.001; Use",
            "below 2 % the model itself is off by more (what the verdict allows its model of hinges)",
            "1 %; 2 M instr.; 2 ×; 500 µs; chain, dopri5, 1e\u22125; Use",
            "0.1 % wanted; the same",
            "0.01 %; 8 M instr.; 4 ×; 2 ms; chain, dop853, 1e\u22127; Use",
            "1e\u22126; the same", // 1e-5, which costs the same as both its neighbours, is left out
        ]);
        const widths = await page.locator("table.digits .work-bar i").evaluateAll((list) => list.map((b) => b.getBoundingClientRect().width));
        assert.ok([1, 2, 2, 8, 8].every((w, i) => Math.abs(widths[i] / widths[3] - w / 8) < 0.02), widths.join());
        await answered(page, () => page.locator('table.digits button[aria-label="Use chain, dop853, 1e-7"]').click());
        assert.deepEqual(await page.evaluate(() => ["method", "integrator", "rtol"].map((k) => globalThis.flexwright.state.options[k])), ["chain", "dop853", "1e-7"]);
        await answered(page, () => page.selectOption('select[aria-label="Accuracy wanted"]', "1e-4"));
        assert.equal(await page.inputValue('select[aria-label="accuracy"]'), "1e-4", "the same choice above the motion");
        await page.selectOption('select[aria-label="Accuracy wanted"]', "");
        await page.evaluate(axeSource);
        const axe = await page.evaluate(() => globalThis.axe.run("#panel-accuracy", { resultTypes: ["violations"] }));
        assert.deepEqual(axe.violations.filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => [v.id, v.nodes[0].html]), []);
    });

    test("while a slider is held the picture is of its value before the verdict is, which stays marked as former until then", async () => {
        await view(page, "motion");
        const slider = page.locator('[data-parameter="arc"]');
        const written = await slider.evaluate((e) => e.value);
        const looks = () => page.evaluate(() => ({ of: ["#panel-motion .stage", "#panel-motion .plots"].map((x) => document.querySelector(x).dataset.of),
            verdict: document.querySelector("#banner").dataset.of,
            d: document.querySelector("#panel-motion .stage path.flexure").getAttribute("d"), labels: [...document.querySelectorAll("#panel-motion .hinge-label")].map((x) => x.textContent) }));
        let go;
        const gate = new Promise((resolve) => (go = resolve));
        const before = await looks();
        await page.route("**/api/preview", async (r) => (await gate, r.continue().catch(() => {}))); // a later one may have taken its place
        await slider.evaluate((e) => {
            e.value = 200;
            e.dispatchEvent(new Event("input"));
        });
        await page.waitForFunction((d) => document.querySelector("#panel-motion .stage path.flexure").getAttribute("d") !== d, before.d);
        const held = await looks();
        assert.deepEqual([...held.of, held.verdict], ["present", "former", "former"]);
        assert.notDeepEqual(held.labels, before.labels);
        go();
        await page.unroute("**/api/preview");
        await page.waitForFunction(() => globalThis.flexwright.state.previewOf === globalThis.flexwright.state.pictureOf && document.querySelector("#panel-motion .plots").dataset.of === "present");
        const then = await looks();
        assert.deepEqual([...then.of, then.verdict], ["present", "present", "present"]);
        assert.deepEqual([then.d, then.labels], [held.d, held.labels], "the same picture");
        await answered(page, () => slider.evaluate((e, v) => {
            e.value = v;
            e.dispatchEvent(new Event("input"));
            e.dispatchEvent(new Event("change"));
        }, written));
    });

    test("what took long to judge as fabricated is judged again when nothing changes; until then it is accepted as drawn", async () => {
        const made = () => page.waitForFunction(() => { // of the present input
            const banner = document.querySelector("#banner");
            return banner.dataset.of === "present" && banner.querySelector(".as-drawn")?.textContent === "as it will be made";
        });
        await page.route("**/api/jobs/*", async (r) => {
            if (r.request().method() !== "GET") return r.continue();
            const response = await r.fetch();
            return r.fulfill({ response, json: { ...(await response.json()), seconds: 3.2 } });
        });
        const slider = page.locator('[data-parameter="link"]');
        for (const key of ["ArrowRight", "ArrowLeft"]) {
            await answered(page, () => slider.press(key));
            await page.waitForFunction(() => document.querySelector("#banner strong").innerText.endsWith("Accepted as drawn") && document.querySelector("#banner.accept.first"));
            await made();
            assert.match(await page.locator("#banner strong").innerText(), /Accepted$/);
        }
        await page.unroute("**/api/jobs/*");
    });

    test("a run of keys on a slider is one step of the history; what another page has ended can be ended again", async () => {
        page.expected = [/404 \(Not Found\)/];
        const slider = page.locator('[data-parameter="link"]');
        const before = await page.evaluate(() => [globalThis.flexwright.parts.editor.depths[0], globalThis.flexwright.state.text]);
        await slider.focus();
        for (let i = 0; i < 4; i++) await page.keyboard.press("ArrowRight");
        await page.waitForFunction((t) => globalThis.flexwright.state.text !== t && globalThis.flexwright.settled(false), before[1]);
        assert.equal(await page.evaluate(() => globalThis.flexwright.parts.editor.depths[0]), before[0] + 1);
        await answered(page, () => page.click("#undo"));
        assert.equal(await text(page), before[1]);
        const gone = await page.evaluate(async () => {
            const { token } = await (await fetch("/api/session", { credentials: "same-origin" })).json();
            const ask = async (path, method, body) => {
                const answer = await fetch(path, { method, credentials: "same-origin", headers: { "X-Flexwright-Token": token, ...(body ? { "Content-Type": "application/json" } : {}) }, body });
                return [answer.status, await answer.json()];
            };
            const [, { id }] = await ask("/api/jobs", "POST", JSON.stringify({ kind: "modes", text: globalThis.flexwright.state.text, set: {}, options: {} }));
            const said = [];
            while (said.at(-1)?.[1].state !== "gone" && said.length < 400) {
                said.push(await ask(`/api/jobs/${id}`, "DELETE"));
                await new Promise((resolve) => setTimeout(resolve, 25));
            }
            return { id, last: said.at(-1), first: said[0], never: await ask("/api/jobs/999999", "DELETE") };
        });
        assert.deepEqual([gone.first[0], ...gone.last], [200, 200, { id: gone.id, state: "gone" }]);
        assert.equal(gone.never[0], 404, "no job has had this number");
    });

    test("the slider: how long until the new motion is seen", async (t) => {
        await view(page, "motion");
        const slider = page.locator('[data-parameter="arc"]');
        await slider.focus();
        await page.evaluate(() => (globalThis.flexwright.state.latency.length = 0));
        for (let i = 0; i < (ALL ? 40 : 24); i++) await answered(page, () => page.keyboard.press(i % 8 < 4 ? "ArrowLeft" : "ArrowRight"));
        await page.waitForTimeout(100);
        const times = (await page.evaluate(() => [...globalThis.flexwright.state.latency])).sort((a, b) => a - b);
        const at = (q) => times[Math.min(Math.floor(q * times.length), times.length - 1)].toFixed(0);
        t.diagnostic(`change to picture: median ${at(0.5)} ms, 95 % ${at(0.95)} ms, longest ${at(1)} ms of ${times.length}`);
        assert.ok(times.length >= 20);
    });
});
