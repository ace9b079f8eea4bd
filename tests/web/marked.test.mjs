// SPDX-License-Identifier: GPL-3.0-or-later
// What cannot be made, and what is rejected: the picture marks it, the banner says it in the words of the terminal.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { readFileSync, writeFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { answered, close, finish, open, program, serve, setText, source, text, verdict } from "./helper.mjs";

after(finish);

const check = (file) => JSON.parse(spawnSync(program, ["check", file, "--json"], { cwd: source, encoding: "utf8" }).stdout);
const shot = async (page, name) => {
    if (process.env.FW_PICTURE) await page.screenshot({ path: join(process.env.FW_PICTURE, name) });
};
// the lines of the banner against a summary; what is beyond the fifth is folded away
const same = (lines, summary) => {
    const bare = (x) => x.replace(/[: ]/g, "");
    assert.deepEqual(lines.map(bare), summary.map((x) => bare(`${x.label}${x.text}`)));
};

describe("a gripper", () => {
    let server, page;
    before(async () => {
        server = await serve("free-form-gripper");
        // with nothing between its jaws, and drawn so little that they stay apart
        const bare = readFileSync(server.file, "utf8").replace(/\s*<(probe|require|contact) [^>]*\/>/g, "")
            .replace(/name="pull" value="[^"]*"/, 'name="pull" value="18 uN"').replace(/name="copper_pull" value="[^"]*"/, 'name="copper_pull" value="1.8 uN"');
        writeFileSync(server.file, bare);
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("a first look says that it is one, and what follows replaces it", async () => {
        await verdict(page, "accept");
        const first = await page.evaluate(() => globalThis.flexwright.state.preview);
        assert.ok(first.provisional && first.left_out.some((x) => x.what === "corners"));
        assert.ok(first.verdict.summary.some((x) => x.label === "as drawn"));
        await page.waitForSelector(".as-drawn:text-is('as it will be made')", { timeout: 60000 });
        same(await page.locator("#banner .top-line").allTextContents(), check(server.file).summary);
        assert.equal(await page.locator(".mark-tag").count(), 0);
        await shot(page, "marked-accepted.png");
    });

    test("jaws that meet are marked, and why is the first line", async () => {
        await answered(page, () => setText(page, ['name="pull" value="18 uN"', 'name="pull" value="60 uN"']));
        await verdict(page, "reject");
        assert.match(await page.locator("#banner .top-line").first().innerText(), /^rejected because: link left and link right meet in scene close.*FW-D294/);
        assert.deepEqual(await page.locator(".body.faulty").evaluateAll((e) => e.map((x) => x.dataset.id).sort()), ["left", "right"]);
        assert.equal(await page.locator("#panel-motion .mark-tag").count(), 1);
        assert.ok(!/as it will be made/.test(await page.textContent("#banner")));
        await shot(page, "marked-rejected.png");
    });

    test("jaws that overlap as drawn are shown, not kept from sight", async () => {
        await answered(page, () => setText(page, ['name="pull" value="60 uN"', 'name="pull" value="18 uN"']));
        for (const face of [612, 655]) { // beyond the middle, which is at 600 um
            await answered(page, async () => setText(page, [/name="face" value="\d+ um" min="500 um" max="\d+ um"/.exec(await text(page))[0], `name="face" value="${face} um" min="500 um" max="700 um"`]));
            await page.waitForSelector('#banner[data-verdict="failed"]');
            assert.match(await page.locator("#banner").innerText(), /Cannot be made.*parts that overlap: left, right FW-D120/s);
            assert.ok(await page.locator("#panel-motion .overlap").count() > 0);
            const box = await page.locator("#panel-motion .overlap").first().boundingBox();
            assert.ok(box.width > 0 && box.height > 0);
            assert.equal(await page.locator("#banner.stale").count(), 0);
            const masses = await page.evaluate(() => globalThis.flexwright.state.preview.bodies.map((b) => b.mass_kg ?? 0));
            assert.ok(masses.every((m) => m < 1e-3), "no mass that stands in for another is told");
            await shot(page, `marked-overlap-${face}.png`);
        }
        await answered(page, () => setText(page, ['value="655 um"', 'value="570 um"']));
        await verdict(page, "accept");
        assert.equal(await page.locator(".mark-tag").count() + await page.locator(".body.faulty").count() + await page.locator(".overlap").count(), 0);
    });
});

describe("hinges too close to each other", () => {
    test("both are ringed by their names, as soon as the page opens", async () => {
        const server = await serve("reference-six-bar");
        const page = await open(server);
        const bare = (await text(page)).replace(/ (mass|inertia|stiffness|damping)="[^"]*"/g, "").replace('at="D" x="2.20 mm"', 'at="D" x="1.05 mm"');
        writeFileSync(server.file, bare);
        await close(page);
        await server.stop();
        const again = await serve("reference-six-bar");
        writeFileSync(again.file, bare);
        const other = await open(again);
        await other.waitForSelector('#banner[data-verdict="failed"]');
        assert.deepEqual(await other.locator("#panel-motion .hinge-tag.faulty").evaluateAll((e) => e.map((x) => x.dataset.id)), ["C", "D"]);
        await shot(other, "marked-hinges.png");
        await close(other);
        await again.stop();
    });
});
