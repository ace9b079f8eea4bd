// SPDX-License-Identifier: GPL-3.0-or-later
// Statics and the ladder of hinges as cards: the numbers of the commands, and what was left out of the live answer.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, describe, test } from "node:test";
import { answered, axeSource, close, finish, open, program, serve, source, view } from "./helper.mjs";

after(finish);

const print = (...words) => JSON.parse(execFileSync(program, [...words, "--json"], { cwd: source, stdio: ["ignore", "pipe", "ignore"] }));

describe("commands as cards", () => {
    let server, page;
    before(async () => {
        server = await serve("leaf-four-bar");
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });
    const ran = (id) => page.waitForFunction((i) => /^computed/.test(document.querySelector(`#${i} .job-message`).textContent), id, { timeout: 60000 });
    const clean = async (id) => {
        await page.evaluate(axeSource);
        const found = await page.evaluate((i) => globalThis.axe.run(`#${i}`, { resultTypes: ["violations"] }), id);
        assert.deepEqual(found.violations.filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => v.id), []);
    };

    test("the equilibrium, with its load path", async () => {
        await view(page, "modes");
        await page.check("#statics input[type=checkbox]");
        await page.click('#statics button:has-text("Find the equilibrium")');
        await ran("statics");
        const told = print("statics", server.file, "--path");
        assert.deepEqual(await page.evaluate(() => globalThis.flexwright.parts.modes.statics.view.job.result.hinges), told.hinges);
        const rows = await page.locator("#statics tbody tr").allTextContents();
        assert.equal(rows.length, told.hinges.length);
        told.hinges.forEach((x, i) => assert.ok(rows[i].includes(`${Number(Math.abs((x.angle_rad * 180) / Math.PI).toPrecision(3))}°`), rows[i]));
        assert.match(await page.textContent("#statics .job-content"), /Stable, push\.[^]*The path reaches the full load/);
        assert.equal(await page.locator("#statics img").count(), 2);
        await clean("statics");
    });

    test("the ladder of every flexure", async () => {
        await view(page, "accuracy");
        await page.click('#ladder button:has-text("Compare their models")');
        await ran("ladder");
        const told = print("hinge", server.file);
        assert.equal(await page.locator("#ladder tbody tr:not(.ladder-note)").count(), told.hinges.reduce((n, x) => n + x.levels.length, 0));
        const mine = await page.evaluate(() => globalThis.flexwright.parts.accuracy.ladder.view.job.result.hinges.map((x) => [x.id, x.levels.map((y) => y.stiffness_Nm_per_rad)]));
        assert.deepEqual(mine, told.hinges.map((x) => [x.id, x.levels.map((y) => y.stiffness_Nm_per_rad)]));
        // the command's words about each: what is used, what the errors rest on, why one is enough
        const notes = await page.locator("#ladder .ladder-note").allTextContents();
        assert.equal(notes.length, told.hinges.length);
        for (const [i, x] of told.hinges.entries()) {
            assert.ok(notes[i].includes(x.picked.why) && /stiffness used: [\d.]+ .?N m\/rad/.test(notes[i]), notes[i]);
            assert.ok(notes[i].includes(`strain and limit rest on fillets of ${Number((x.fillet_m * 1e6).toPrecision(4))} µm at its roots, ${x.fillet_stated ? "as stated" : "chosen: none is stated"}`), notes[i]);
            assert.equal(/outside of the shapes that were compared with finite elements: errors are guesses/.test(notes[i]), x.levels.some((y) => y.error?.outside));
        }
        await clean("ladder");
    });

    test("what weight lowers is told with what it is at most, as the terminal says it", async () => {
        const all = print("check", server.file, "--corners", "none").out_of_plane.filter((o) => o.known);
        const said = await page.textContent(".card.across");
        const near = (words, m) => Math.abs(Number(words) * 1e-9 / m - 1) < 1e-3;
        const found = [...said.matchAll(/Its weight lowers it by ([\d.]+) nm, at most ([\d.]+) nm, on a table/g)];
        assert.equal(found.length, all.length, said);
        found.forEach(([, a, b], i) => assert.ok(near(a, all[i].weight_sag_m) && near(b, all[i].weight_sag_most_m) && Number(b) >= Number(a), said));
    });

    test("what was left out of the live answer is listed", async () => {
        const left = await page.evaluate(() => globalThis.flexwright.state.preview.left_out.map((x) => x.sentence));
        const said = await page.textContent(".left-out");
        for (const sentence of left) assert.ok(said.includes(sentence), sentence);
    });
});

test("at which voltage electrodes pull in is told beside the verdict that accepts them, with what they surely hold", async () => {
    const server = await serve("comb-stage");
    const page = await open(server);
    assert.match(await page.textContent(".card.pull-in"), /Of a first look.*Pull-in in|^Electrodes, as drawnPull-in in/);
    await page.waitForSelector("#banner:has-text('as it will be made')", { timeout: 60000 });
    const [p] = print("check", server.file, "--corners", "none", "--advice", "none").pull_in;
    const said = /Pull-in in (\S+): comb drive (\S+) at ([\d.]+) V \((\w+)\), at least ([\d.]+) V, slowly; the scene asks for up to ([\d.]+) V/.exec(await page.textContent(".card.pull-in"));
    assert.ok(said, await page.textContent(".card.pull-in"));
    assert.deepEqual([said[1], said[2], said[4]], [p.scene, p.comb, p.kind]);
    for (const [words, value] of [[said[3], p.voltage_V], [said[5], p.least_V], [said[6], p.scene_voltage_V]]) assert.ok(Math.abs(words / value - 1) < 1e-2, `${said[0]}: ${value}`);
    await close(page);
    await server.stop();
});

describe("what an answer does not change", () => {
    let server, page;
    before(async () => {
        server = await serve("reference-six-bar");
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });
    const settled = () => page.waitForFunction(() => globalThis.flexwright.settled(false));

    test("parts of the picture, bars and what somebody has opened are the same elements with what is new in them", async () => {
        await settled();
        await page.evaluate(() => {
            const find = (what) => document.querySelector(what);
            find(".ledger details").open = true;
            find(".bar").focus();
            globalThis.before = [".ledger details", ".bar", ".view-motion .flexure", ".view-motion .body:not(.fixed) path", "#banner .decision"].map(find);
            globalThis.outline = globalThis.before[2].getAttribute("d");
        });
        await answered(page, () => page.evaluate(() => {
            const slider = document.querySelector("[data-parameter]");
            slider.value = Number(slider.value) + 5 * Number(slider.step);
            for (const event of ["input", "change"]) slider.dispatchEvent(new Event(event, { bubbles: true }));
        }));
        await settled();
        const seen = await page.evaluate(() => {
            const [effect, bar, flexure] = globalThis.before;
            const judged = globalThis.flexwright.parts.verdict.judged ?? globalThis.flexwright.state.preview.verdict;
            const use = judged.hinges.find((x) => x.id === bar.dataset.hinge);
            return {
                there: globalThis.before.map((x) => x.isConnected), open: effect.open, focus: document.activeElement === bar, outline: flexure.getAttribute("d") !== globalThis.outline,
                said: bar.querySelector(".bar-value").textContent, share: 100 * (use.as_fabricated ?? use).utilisation, picked: (bar.click(), globalThis.flexwright.state.hinge === bar.dataset.hinge),
            };
        });
        assert.deepEqual(seen.there, [true, true, true, true, true]);
        assert.ok(seen.open && seen.focus && seen.outline && seen.picked, JSON.stringify(seen));
        assert.ok(Math.abs(parseFloat(seen.said) - seen.share) < 0.01 * seen.share, `${seen.said} of ${seen.share} %`);
        await page.click(".bar"); // looked at no more
    });

    test("a key of a slider has few elements styled anew", async () => {
        const client = await page.context().newCDPSession(page);
        const events = [];
        client.on("Tracing.dataCollected", ({ value }) => events.push(...value));
        await page.locator("[data-parameter]").first().focus();
        await client.send("Tracing.start", { transferMode: "ReportEvents", traceConfig: { includedCategories: ["devtools.timeline"] } });
        await answered(page, () => page.keyboard.press("ArrowRight"));
        await settled();
        const done = new Promise((resolve) => client.once("Tracing.tracingComplete", resolve));
        await client.send("Tracing.end");
        await done;
        const styled = events.filter((e) => e.name === "UpdateLayoutTree").map((e) => e.args.elementCount ?? 0);
        assert.ok(styled.length > 0 && Math.max(...styled) < 250, `${styled}`); // all of the page are more than a thousand
    });

    test("the text that nobody sees is there when it is looked at, and has its history", async () => {
        const [before, now] = await page.evaluate(() => [globalThis.flexwright.state.text, globalThis.flexwright.parts.editor.text]);
        assert.equal(now, before);
        await answered(page, () => page.keyboard.press("ArrowLeft"));
        await settled();
        const changed = await page.evaluate(() => globalThis.flexwright.state.text);
        assert.notEqual(changed, before);
        await answered(page, () => page.click("#undo"));
        assert.equal(await page.evaluate(() => globalThis.flexwright.state.text), before);
        await answered(page, () => page.click("#redo"));
        await page.click("#tab-xml");
        assert.equal(await page.evaluate(() => globalThis.flexwright.parts.editor.view.state.doc.toString()), changed);
        await answered(page, () => page.click("#undo"));
        assert.equal(await page.evaluate(() => globalThis.flexwright.parts.editor.view.state.doc.toString()), before);
        await page.click("#tab-form");
    });
});
