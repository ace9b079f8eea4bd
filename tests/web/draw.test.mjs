// SPDX-License-Identifier: GPL-3.0-or-later
// A device made with the mouse: from an empty page to an accepted gripper without touching the text, and things that
// are there dragged, with what is written respected.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { answered, axeSource, close, finish, open, serve, text, verdict, view } from "./helper.mjs";

after(finish);

const shot = async (page, name) => {
    if (process.env.FW_PICTURE) await page.screenshot({ path: join(process.env.FW_PICTURE, name) });
};

/** Pixels of a place in um. */
const pixels = (page, at) => page.evaluate((p) => {
    const { view: v } = globalThis.flexwright.parts.draw;
    const r = v.svg.getBoundingClientRect();
    const [x, y] = v.toScreen(...p);
    return [x + r.left, y + r.top];
}, at);
const drag = async (page, from, to, { release = true, steps = 4 } = {}) => {
    const [a, b] = [await pixels(page, from), await pixels(page, to)];
    await page.mouse.move(...a);
    await page.mouse.down();
    for (let i = 1; i <= steps; i++) await page.mouse.move(a[0] + ((b[0] - a[0]) * i) / steps, a[1] + ((b[1] - a[1]) * i) / steps);
    if (release) await page.mouse.up();
};
const click = async (page, at) => page.mouse.click(...await pixels(page, at));
const tool = (page, id) => page.click(`.draw-tools [data-tool="${id}"]`);
const changed = async (page, act) => {
    const was = await text(page);
    await act();
    await page.waitForFunction((t) => globalThis.flexwright.state.text !== t, was);
};

describe("a gripper from an empty page", () => {
    let server, page;
    before(async () => {
        server = await serve(null);
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("with the mouse alone, to an accepted device", async () => {
        await page.click("#new");
        await page.click('.template:has-text("Empty page")');
        await view(page, "draw");
        await shot(page, "draw-empty.png");
        await tool(page, "bar");
        await changed(page, () => drag(page, [-400, 0], [-400, 1000]));
        await page.selectOption('label:has-text("belongs to") select', "link-1");
        await changed(page, () => drag(page, [-400, 1000], [-100, 1000]));
        await page.selectOption('label:has-text("belongs to") select', "");
        await changed(page, () => drag(page, [400, 0], [400, 1000]));
        await page.selectOption('label:has-text("belongs to") select', "link-2");
        await changed(page, () => drag(page, [400, 1000], [100, 1000]));
        assert.match(await page.locator("#right .problems").innerText(), /mistake/i);
        await shot(page, "draw-links.png");
        await tool(page, "hinge");
        await changed(page, () => click(page, [-400, 0]));
        await changed(page, () => click(page, [400, 0]));
        assert.equal((await text(page)).match(/<flexure /g).length, 1, "hinges of the same sizes share their flexure");
        await tool(page, "force");
        await changed(page, () => drag(page, [-400, 600], [-200, 600]));
        await changed(page, () => drag(page, [400, 600], [200, 600]));
        await verdict(page, "accept");
        await page.waitForSelector(".as-drawn:text-is('as it will be made')", { timeout: 60000 });
        await shot(page, "draw-gripper.png");
        console.log(await text(page));
    });
});
