// SPDX-License-Identifier: GPL-3.0-or-later
// Statics and the ladder of hinges as cards: the numbers of the commands, and what was left out of the live answer.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, describe, test } from "node:test";
import { axeSource, close, finish, open, program, serve, source, view } from "./helper.mjs";

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
        assert.equal(await page.locator("#ladder tbody tr").count(), told.hinges.reduce((n, x) => n + x.levels.length, 0));
        const mine = await page.evaluate(() => globalThis.flexwright.parts.accuracy.ladder.view.job.result.hinges.map((x) => [x.id, x.levels.map((y) => y.stiffness_Nm_per_rad)]));
        assert.deepEqual(mine, told.hinges.map((x) => [x.id, x.levels.map((y) => y.stiffness_Nm_per_rad)]));
        await clean("ladder");
    });

    test("what was left out of the live answer is listed", async () => {
        const left = await page.evaluate(() => globalThis.flexwright.state.preview.left_out.map((x) => x.sentence));
        const said = await page.textContent(".left-out");
        for (const sentence of left) assert.ok(said.includes(sentence), sentence);
    });
});
