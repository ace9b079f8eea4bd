// SPDX-License-Identifier: GPL-3.0-or-later
// A phone: the decision and the picture are what one sees first, nothing is wider than the screen, one finger scrolls, two
// zoom the picture about the point between them, and one moves it then.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { close, finish, open, serve, verdict, view } from "./helper.mjs";

after(finish);

describe("on a phone", () => {
    let server, page, touch;
    before(async () => {
        server = await serve("reference-six-bar");
        page = await open(server, { width: 390, height: 844, hasTouch: true, isMobile: true });
        await verdict(page, "accept");
        const session = await page.context().newCDPSession(page);
        touch = (type, points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    });
    after(async () => {
        await close(page);
        await server.stop();
    });
    const place = () => page.evaluate(() => {
        const { view: v } = globalThis.flexwright.parts.motion.mechanism;
        return { k: v.k, x: v.x, y: v.y, fitted: v.fitted };
    });
    const middle = async () => {
        const b = await page.locator("#panel-motion .stage > svg").boundingBox();
        return [b.x + b.width / 2, b.y + b.height / 2];
    };
    /** Both fingers from a to b, each its own way, in steps. */
    const gesture = async (from, to) => {
        await touch("touchStart", [from[0]]);
        if (from.length > 1) await touch("touchStart", from);
        for (let i = 1; i <= 8; i++) await touch("touchMove", from.map((p, n) => p.map((v, k) => v + ((to[n][k] - v) * i) / 8)));
        await touch("touchEnd", []);
        await page.waitForTimeout(50);
    };

    test("decision and picture first, whole, and nothing wider than the screen in any view", async () => {
        const banner = await page.locator("#banner").boundingBox();
        const stage = await page.locator("#panel-motion .stage").boundingBox();
        assert.ok(banner.y >= 0 && banner.y < 120, JSON.stringify(banner));
        assert.ok(stage.y > banner.y && stage.y + stage.height <= 700, JSON.stringify(stage));
        for (const id of ["draw", "workspace", "modes", "assembly", "masks", "recipe", "explore", "accuracy", "motion"]) {
            await view(page, id);
            assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390, id);
        }
    });

    test("while something is computed every control of the header stays on the screen", async () => {
        await page.route("**/api/explore", () => {}); // it never answers
        await view(page, "explore");
        const own = page.locator("#panel-explore .job-bar .cancel");
        await own.waitFor();
        assert.equal(await page.locator("#panel-explore .job-bar .cancel:visible, #busy-cancel:visible").count(), 1, "two buttons that cancel the same");
        await page.evaluate(() => scrollTo(0, document.documentElement.scrollHeight)); // its own row is out of sight
        await page.waitForSelector("#busy:visible");
        const out = await page.evaluate(() => [...document.querySelectorAll("#top button, #busy, #busy button")].filter((e) => e.offsetParent !== null || e.id === "busy").map((e) => [e.id || e.textContent, e.getBoundingClientRect()]).filter(([, r]) => r.width && (r.left < 0 || r.right > innerWidth)).map(([id]) => id));
        assert.deepEqual(out, []);
        const [words, sign] = await page.evaluate(() => {
            scrollTo(0, document.documentElement.scrollHeight);
            return [Math.max(...[...document.querySelectorAll("#main > *, #right > *")].map((e) => e.getBoundingClientRect().bottom)), document.querySelector("#busy").getBoundingClientRect().top];
        });
        assert.ok(words <= sign, `the end of the page, ${words}, is behind the sign, ${sign}`);
        await page.click("#busy-cancel");
        await page.unroute("**/api/explore");
        await view(page, "motion");
    });

    test("all of the decision is one tap away", async () => {
        const lines = page.locator("#banner .top-line:visible");
        const before = await lines.count();
        await page.click(".banner-more");
        assert.ok((await lines.count()) > before);
        assert.equal(await page.getAttribute(".banner-more", "aria-expanded"), "true");
        await page.click(".banner-more");
        assert.equal(await lines.count(), before);
    });

    test("one finger up the whole picture scrolls the page and leaves the picture", async () => {
        const [x, y] = await middle();
        const was = await place();
        await gesture([[x, y + 60]], [[x, y - 160]]);
        await page.waitForFunction(() => scrollY > 60);
        assert.equal((await place()).k, was.k);
        // a page that was flung goes on for a while
        await page.waitForFunction(() => {
            globalThis.still = scrollY === 0 ? (globalThis.still ?? 0) + 1 : 0;
            if (scrollY !== 0) scrollTo(0, 0);
            return globalThis.still > 30;
        });
    });

    test("two fingers zoom about the point between them; one moves it then; two taps show the whole", async () => {
        const [x, y] = await middle(); // which may scroll
        const scrolled = await page.evaluate(() => scrollY);
        const before = await place();
        const r = await page.locator("#panel-motion .stage > svg").boundingBox();
        const world = (v) => [(x - r.x - v.x) / v.k, (v.y - (y - r.y)) / v.k];
        const there = world(before);
        await gesture([[x - 30, y], [x + 30, y]], [[x - 90, y], [x + 90, y]]);
        const after = await place();
        assert.ok(Math.abs(after.k / before.k - 3) < 0.4, String(after.k / before.k));
        const now = world(after);
        assert.ok(Math.hypot(now[0] - there[0], now[1] - there[1]) * after.k < 14, `${there} ${now}`);
        assert.equal(await page.evaluate(() => scrollY), scrolled);
        await gesture([[x, y]], [[x + 40, y - 50]]);
        const moved = await place();
        assert.equal(moved.k, after.k);
        assert.ok(Math.abs(moved.x - after.x - 40) < 12 && Math.abs(moved.y - after.y + 50) < 14, JSON.stringify([after, moved]));
        for (let i = 0; i < 2; i++) {
            await touch("touchStart", [[x, y]]);
            await touch("touchEnd", []);
        }
        await page.waitForFunction(() => globalThis.flexwright.parts.motion.mechanism.view.fitted);
    });

    test("two fingers on a plot zoom its time", async () => {
        const box = page.locator("#panel-motion .plot-box").first();
        await box.scrollIntoViewIfNeeded();
        const b = await box.boundingBox();
        const [x, y] = [b.x + b.width / 2, b.y + b.height / 2];
        await gesture([[x - 20, y], [x + 20, y]], [[x - 80, y], [x + 80, y]]);
        const [from, to] = await page.evaluate(() => globalThis.flexwright.parts.motion.angles.window);
        assert.ok(to - from < 6 && from > 0 && to < 10, `${from} ${to}`);
    });

    test("one finger on a handle drags it, up and down, too, and the page stays where it is", async () => {
        const finger = async (panel, selector, by, moved) => {
            await view(page, panel);
            await page.locator(selector).scrollIntoViewIfNeeded();
            const b = await page.locator(selector).boundingBox();
            const at = [b.x + b.width / 2, b.y + b.height / 2];
            const before = await page.evaluate(moved);
            const scrolled = await page.evaluate(() => scrollY);
            await gesture([at], [[at[0], at[1] + by]]);
            await page.waitForFunction(([f, was]) => new Function(`return (${f})()`)() !== was, [String(moved), before]);
            assert.equal(await page.evaluate(() => scrollY), scrolled, panel);
        };
        await finger("workspace", "#panel-workspace .handle[role=slider]", -20, () => document.querySelector("#pose-y_m").value);
        await finger("draw", '.draw-handle[data-id="device/workspace[1] most"] .reach', 20, () => globalThis.flexwright.state.text);
        await page.click("#undo");
        await view(page, "motion");
    });

    test("the handle of a load's direction is in the picture, where its arrow would end outside, too", async () => {
        const arm = `<device xmlns="urn:flexwright:device:1" name="arm"><material ref="silicon-100" thickness="50 um"/><flow ref="al-masked-rie"/>
            <mechanism><body id="arm" x="0 um" y="0 um"><bar x="0 um" y="0 um" to-x="1500 um" to-y="0 um" width="120 um"/></body>
            <revolute id="A" a="ground" a-x="0 um" a-y="0 um" b="arm" b-x="0 um" b-y="0 um" hinge="f"/></mechanism>
            <flexure id="f" kind="csfh" radius="80 um" angle="240 deg" width="8 um" gap="10 um"/>
            <scene name="s" duration="20 ms"><force on="arm" x="1500 um" y="0 um" fx="10 uN" fy="1 uN"/></scene></device>`;
        const before = await page.evaluate(() => globalThis.flexwright.state.text);
        await page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), arm);
        await view(page, "draw");
        await page.waitForSelector(".draw-handle.tip");
        await page.evaluate(() => globalThis.flexwright.parts.draw.view.fit());
        const [tip, svg] = await page.evaluate(() => ["#panel-draw .draw-handle.tip .reach", "#panel-draw .draw-stage > svg"].map((q) => {
            const r = document.querySelector(q).getBoundingClientRect();
            return [r.left + (q.includes("reach") ? 12 : 0), r.right - (q.includes("reach") ? 12 : 0)];
        }));
        assert.ok(tip[1] <= svg[1] - 10 && tip[0] >= svg[0], `${tip} in ${svg}`);
        await page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), before);
        await view(page, "motion");
    });
});
