// SPDX-License-Identifier: GPL-3.0-or-later
// A version is kept and pinned: its outlines lie in the pictures, every number that differs stands beside the present one.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { answered, axeSource, close, finish, laidOut, open, ready, serve, setText, text, verdict, view } from "./helper.mjs";

after(finish);

const shot = async (page, name) => {
    if (process.env.FW_PICTURE) await page.screenshot({ path: join(process.env.FW_PICTURE, name) });
};

describe("a stage against a version of itself", () => {
    let server, page, first;
    const row = (what) => page.locator(`#compare tr[data-what="${what}"]`);
    const cells = async (what) => (await row(what).locator("td").allTextContents()).slice(1);
    const pinned = () => page.waitForFunction(() => globalThis.flexwright.state.pinned?.preview);
    before(async () => {
        server = await serve("straight-stage");
        page = await open(server);
        first = await text(page);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("the present text is kept under a name and compared with: nothing differs", async () => {
        await page.waitForSelector(".as-drawn:text-is('as it will be made')", { timeout: 60000 });
        await page.click("#versions");
        await page.fill('input[aria-label="Name of the version"]', "narrow leaves");
        await page.click(".version-compare");
        await pinned();
        assert.equal(await page.textContent("#h-compare"), "Compared with narrow leaves");
        assert.match(await page.textContent("#compare"), /No number that is shown differs/);
        assert.equal(await page.locator("#panel-motion .pinned path").count() > 0, true);
    });

    test("each number that a change moves stands beside the former, with the difference", async () => {
        const before = await page.evaluate(() => globalThis.flexwright.state.preview);
        await answered(page, () => setText(page, ['name="width" value="12 um"', 'name="width" value="12.5 um"']));
        await page.waitForFunction(() => globalThis.flexwright.settled(false));
        const now = await page.evaluate(() => globalThis.flexwright.state.preview);
        assert.deepEqual(await cells("Parameters: width"), ["12 um", "12.5 um", "+0.5 um"]);
        const [was, is, change] = await cells("Share of the limit: hinge A, as drawn");
        for (const [said, p] of [[was, before], [is, now]]) assert.equal(said, `${Number((100 * p.verdict.hinges[0].utilisation).toPrecision(3))} %`);
        assert.match(change, /^[+\u2212][\d.]+ points$/);
        const stroke = await cells((await row("Share of the limit: hinge A, as made").count()) ? "What it is for: stroke (final, draw), as made" : "What it is for: stroke (final, draw), as drawn, at a first look");
        assert.match(stroke[2], /^\u2212[\d.]+ µm$/, "a stiffer stage goes less far");
        assert.equal(await row("Parameters: leg").count(), 0, "what is equal is left out");
        await page.check('#compare input[type="checkbox"]');
        assert.deepEqual(await cells("Parameters: leg"), ["2.2 mm", "2.2 mm", "="]);
        await page.uncheck('#compare input[type="checkbox"]');
        assert.match(await page.locator('.bar[data-hinge="A"]').getAttribute("aria-label"), / in narrow leaves$/);
        await page.click('button:has-text("Judge as fabricated")', { timeout: 60000 }); // a slow one is not made by itself
        await page.waitForSelector(".as-drawn:text-is('as it will be made')", { timeout: 60000 });
        await row("Share of the limit: hinge A, as made").waitFor();
        await shot(page, "compare.png");
    });

    test("what a number is has the whole width of the card, and no column is cut, at every width of the page", async () => {
        for (const width of [1024, 1440, 1920]) {
            await page.setViewportSize({ width, height: 900 });
            await laidOut(page);
            const wrong = await page.evaluate(() => {
                const card = document.querySelector(".compare");
                const out = card.scrollWidth > card.clientWidth ? [`${card.scrollWidth} wide in ${card.clientWidth}`] : [];
                for (const row of card.querySelectorAll("tr[data-what]")) {
                    const [what, ...cells] = [...row.cells].map((c) => c.getBoundingClientRect());
                    if (what.width < 0.9 * card.clientWidth) out.push(`${row.dataset.what}: ${what.width}`);
                    for (const c of cells) if (c.width < 60 || c.top < what.bottom - 1) out.push(`${row.dataset.what}: a cell of ${c.width}`);
                }
                const heads = [...card.querySelectorAll("thead th")].filter((x) => x.offsetParent).map((x) => x.textContent);
                return [...out, ...(String(heads) === "then,now,change" ? [] : heads)];
            });
            assert.deepEqual(wrong, [], `at ${width} pixels`);
        }
        await page.setViewportSize({ width: 1440, height: 900 });
    });

    test("the ghost moves by its own motion, and stands in Draw", async () => {
        const slider = page.locator("input.time");
        await slider.focus();
        await page.keyboard.press("End");
        const place = await page.evaluate(() => { // of the stage, then and now, at the end of the scene
            const m = globalThis.flexwright.parts.motion.mechanism;
            const x = (g) => Number(/translate\(([-\d.]+)/.exec(g.getAttribute("transform"))[1]);
            return [x(m.pinned.querySelectorAll("g")[1]), x(m.bodies[1])];
        });
        const p = await page.evaluate(() => [globalThis.flexwright.state.pinned.preview, globalThis.flexwright.state.preview].map((v) => v.motion.q.at(-1)[3] * 1e6));
        place.forEach((v, i) => assert.ok(Math.abs(v - p[i]) < 0.01, `${v} for ${p[i]}`));
        assert.ok(p[0] - p[1] > 2);
        await view(page, "draw");
        assert.ok(await page.locator("#panel-draw .pinned path").count() > 0);
        await shot(page, "compare-draw.png");
        await view(page, "motion");
    });

    test("versions survive a reload, are put back as one undo, and are removed", async () => {
        page.once("dialog", (d) => d.accept()); // the text was changed
        await page.reload();
        await ready(page);
        const changed = await text(page);
        assert.notEqual(changed, first, "a draft survives, too");
        await page.click("#versions");
        assert.match(await page.textContent(".version-list"), /narrow leaves.*straight-stage · accepted/s);
        await page.evaluate(axeSource);
        const axe = await page.evaluate(() => globalThis.axe.run("dialog", { resultTypes: ["violations"] }));
        assert.deepEqual(axe.violations.filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => [v.id, v.nodes[0].html]), []);
        await shot(page, "versions.png");
        await page.click('button[aria-label="Compare with narrow leaves"]');
        await pinned();
        assert.deepEqual(await cells("Parameters: width"), ["12 um", "12.5 um", "+0.5 um"]);
        await page.click("#versions");
        await answered(page, () => page.click('button[aria-label="Put back narrow leaves"]'));
        assert.equal(await text(page), first);
        await answered(page, () => page.click("#undo"));
        assert.equal(await text(page), changed);
        await page.click("#versions");
        await page.click('button[aria-label="Remove narrow leaves"]');
        assert.match(await page.textContent(".version-list"), /No version is kept/);
        await page.click(".version-unpin");
        assert.ok(!(await page.isVisible("#compare")));
        assert.equal(await page.locator("#panel-motion .pinned path").count(), 0);
    });
});
