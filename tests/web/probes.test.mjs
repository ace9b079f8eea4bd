// SPDX-License-Identifier: GPL-3.0-or-later
// What a device is for, on the page: requirements with their values beside the verdict, one probe over time with its
// bounds beside the angles. A device without probes has neither.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { answered, close, finish, open, serve, setText, verdict } from "./helper.mjs";

after(finish);

describe("probes", () => {
    let server, page;
    before(async () => {
        server = await serve("straight-stage");
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("requirements stand beside the verdict, with value and bound", async () => {
        await verdict(page, "accept");
        const said = await page.locator(".purpose").innerText();
        for (const word of ["stroke (final, draw)", "at least 40 µm: accepted", "frequency-1", "at least 400 Hz"]) assert.ok(said.includes(word), `${word} in ${said}`);
        assert.match(said, /tension \(peak, draw\)\s+115 µN/);
    });

    test("a probe is plotted with its bounds, and another can be chosen", async () => {
        const shown = () => page.evaluate(() => {
            const { data } = globalThis.flexwright.parts.motion.probes;
            return { name: data.series[0].name, most: Math.max(...data.series[0].values), marks: data.marks.map((x) => x.y) };
        });
        const first = await shown();
        assert.equal(first.name, "stroke");
        assert.deepEqual(first.marks.map((x) => Math.round(x * 1e3) / 1e3), [40]);
        assert.ok(first.most > 57 && first.most < 62);
        await page.locator(".plots select").selectOption("tension");
        assert.equal((await shown()).name, "tension");
        assert.ok(Math.abs((await shown()).most - 115) < 0.01);
        if (process.env.FW_PICTURE) await page.screenshot({ path: join(process.env.FW_PICTURE, "probes.png") });
    });

    test("what is not met is said, with its reason", async () => {
        await answered(page, () => setText(page, ['value="115 uN"', 'value="60 uN"']));
        await verdict(page, "reject");
        assert.match(await page.locator("#banner").innerText(), /stroke \(final\) is .*at least 40 um is required.*FW-D330/s);
        assert.match(await page.locator(".purpose").innerText(), /at least 40 µm: rejected/);
    });

    test("without probes there is neither card nor plot", async () => {
        const plain = await serve("leaf-four-bar");
        const other = await open(plain);
        assert.equal(await other.locator(".purpose:visible").count(), 0);
        assert.equal(await other.locator(".plots.probed").count(), 0);
        await close(other);
        await plain.stop();
    });
});
