// SPDX-License-Identifier: GPL-3.0-or-later
// What cannot be made, and what is rejected: the picture marks it, the banner says it in the words of the terminal.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { readFileSync, writeFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { answered, close, finish, open, program, serve, setText, SMALL, source, text, verdict, view } from "./helper.mjs";

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

describe("what is of another input looks so", () => {
    const LONG = 120000;
    const VIEWS = ["motion", "draw", "modes", "assembly", "masks", "recipe", "explore", "workspace", "accuracy"];
    let server, page;
    const settled = (jobs = true) => page.waitForFunction((j) => globalThis.flexwright.settled(j), jobs, { timeout: LONG });
    /** What can be seen that is marked in one of these ways, and what says that something is old. */
    const seen = (...ways) => page.evaluate((list) => {
        const visible = (e) => e.checkVisibility({ visibilityProperty: true });
        const marked = [...document.querySelectorAll("[data-of]")].filter((e) => list.includes(e.dataset.of) && visible(e)).map((e) => `${e.dataset.of}: ${e.className} ${e.textContent.replace(/\s+/g, " ").slice(0, 80)}`);
        const said = [...document.querySelectorAll(".job-message, .study-said, .old-note")].filter((e) => visible(e) && /former/.test(e.textContent)).map((e) => e.textContent);
        return [...marked, ...said];
    }, ways);
    const explored = () => page.waitForFunction(() => globalThis.flexwright.parts.explore.whole && globalThis.flexwright.parts.explore.showing.of === globalThis.flexwright.parts.explore.key, null, { timeout: LONG });
    const begin = async (name) => {
        await page.click("#new");
        await page.locator(".template", { has: page.locator(`strong:text-is("${name}")`) }).click();
    };
    before(async () => {
        server = await serve("leaf-four-bar");
        page = await open(server, SMALL);
        await page.waitForSelector(".as-drawn:text-is('as it will be made')", { timeout: LONG });
        for (const id of VIEWS) {
            await view(page, id);
            await page.waitForTimeout(600); // what begins by itself begins when nothing has changed for a while
            await settled();
        }
        await view(page, "explore");
        await explored();
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("Explore: typed in a field, a mistake, a held slider: grey and said, and gone again with it", async () => {
        const body = page.locator(".explore-body");
        const old = async (why) => {
            await page.waitForFunction(() => document.querySelector(".explore-body").classList.contains("old"));
            assert.equal(await body.getAttribute("data-of"), "former", why);
            assert.match(await body.evaluate((e) => getComputedStyle(e).filter), /grayscale\(1\)/, why);
            assert.match(await page.textContent("#panel-explore .job-message"), /of the former input|of \d+ devices/, why);
        };
        const present = async (why) => {
            await explored();
            assert.equal(await body.getAttribute("data-of"), "present", why);
            assert.equal(await body.evaluate((e) => getComputedStyle(e).filter), "none", why);
            assert.match(await page.textContent("#panel-explore .job-message"), /^\d+ devices in/, why);
        };
        await present("as it stands");
        const field = page.locator('.slider[data-name="width"] input.value');
        await field.fill("9 um");
        await old("typed");
        await field.press("Escape");
        await present("taken back");
        await answered(page, () => setText(page, ['kind="leaf"', 'kind="leef"']));
        await old("a mistake");
        await page.waitForTimeout(700); // of a mistake nothing is explored
        await old("still a mistake");
        await answered(page, () => page.click("#undo"));
        await present("undone");
        const slider = page.locator('input[data-parameter="leaf"]');
        const written = (await text(page)).match(/name="leaf" value="([^"]*)"/)[1];
        await page.route("**/api/explore", () => {}); // nothing comes that could take its place
        await slider.evaluate((e) => {
            e.value = 520;
            e.dispatchEvent(new Event("input"));
        });
        await old("held");
        await answered(page, () => slider.evaluate((e, v) => {
            e.value = parseFloat(v);
            e.dispatchEvent(new Event("input"));
            e.dispatchEvent(new Event("change"));
        }, written));
        await page.unroute("**/api/explore");
        await present("back where it was");
    });

    test("New…: of the device before nothing is left in any view, before the first answer and after it; undone, it is there again", async () => {
        const before = await text(page);
        let release;
        const gate = new Promise((resolve) => (release = resolve));
        const never = [/\/api\/jobs$/, /\/api\/explore$/];
        await page.route("**/api/preview", async (r) => (await gate, r.continue()));
        for (const x of never) await page.route(x, () => {}); // no job of the new one begins
        await begin("Gripper");
        await page.waitForTimeout(300); // what is old looks so by now
        for (const id of VIEWS) {
            await view(page, id);
            assert.deepEqual(await seen("former", "another"), [], `${id}, before the first answer`);
        }
        await view(page, "draw"); // what is drawn is of the text alone, and shown whole
        assert.equal(await page.locator("#panel-draw :is(.flexure, .attached-tags text, .hinge-tag)").evaluateAll((list) => list.filter((e) => e.getClientRects().length).length), 0);
        const inside = await page.evaluate(() => {
            const stage = document.querySelector(".draw-stage").getBoundingClientRect();
            return [...document.querySelectorAll(".sketch-shape")].every((e) => { const b = e.getBoundingClientRect(); return b.left >= stage.left && b.right <= stage.right; });
        });
        assert.ok(inside, "the new device is in the picture");
        release();
        await page.unroute("**/api/preview");
        await verdict(page, "accept");
        await settled(false);
        for (const id of VIEWS) {
            await view(page, id);
            assert.deepEqual(await seen("former", "another"), [], `${id}, after the first answer`);
        }
        assert.equal(await page.getAttribute("#banner", "data-of"), "present");
        await page.evaluate(() => globalThis.flexwright.parts.editor.undo());
        assert.equal(await text(page), before);
        await page.waitForFunction(() => document.querySelector("#banner").dataset.of === "present");
        for (const x of never) await page.unroute(x);
        await view(page, "masks");
        await page.waitForFunction(() => document.querySelector("#panel-masks .job-content").dataset.of === "present", null, { timeout: LONG });
        await view(page, "explore");
        await explored();
    });

    test("a text with a mistake after New… is of the new device: its answer is grey, and not gone", async () => {
        await begin("Gripper");
        await verdict(page, "accept");
        await settled(false);
        await answered(page, () => setText(page, ['kind="csfh"', 'kind="xxxx"']));
        await page.waitForSelector("#banner.old:visible");
        assert.equal(await page.getAttribute("#banner", "data-of"), "former");
        await page.waitForSelector('.old-note:has-text("Grey: of the last input that had an answer")');
    });
});
