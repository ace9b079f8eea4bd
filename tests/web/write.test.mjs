// SPDX-License-Identifier: GPL-3.0-or-later
// The XML while it is written: what may stand here, what is under the pointer; and the address, which finds the view, the
// time and the options again.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { answered, axeSource, close, finish, open, ready, serve, text, view } from "./helper.mjs";

after(finish);

describe("the text and the address", () => {
    let server, page;
    before(async () => {
        server = await serve("reference-six-bar");
        page = await open(server);
        await page.click("#tab-xml");
    });
    after(async () => {
        await close(page);
        await server.stop();
    });
    /** The cursor behind these words of the text. */
    const behind = (words, before = 0) => page.evaluate(([w, n]) => {
        const { editor } = globalThis.flexwright.parts;
        const at = editor.text.indexOf(w) + w.length - n;
        editor.select(at, at);
    }, [words, before]);
    const options = async () => {
        await page.waitForSelector(".cm-tooltip-autocomplete li");
        return page.locator(".cm-tooltip-autocomplete li .cm-completionLabel").allTextContents();
    };
    const attributes = (element) => page.evaluate((e) => globalThis.flexwright.state.table.elements.find((x) => x.name === e).attributes, element);

    test("an element is completed with what it needs, where it may stand", async () => {
        const whole = await text(page);
        await behind("<limits safety-factor=\"1.5\"/>\n");
        await page.keyboard.type("  <");
        const list = await options();
        const rows = await page.evaluate(() => globalThis.flexwright.state.table.elements.filter((e) => e.parent === "device").map((e) => e.name));
        assert.deepEqual([...list].sort(), [...new Set(rows)].sort());
        await page.keyboard.type("scen");
        await page.waitForFunction(() => document.querySelector("#editor").shadowRoot.querySelector(".cm-tooltip-autocomplete li[aria-selected=true] .cm-completionLabel")?.textContent === "scene");
        await page.waitForTimeout(120); // the list takes no Enter in its first moments
        await page.keyboard.press("Enter");
        const needed = (await attributes("scene")).filter((a) => a.required).map((a) => ` ${a.name}=""`).join("");
        assert.ok((await text(page)).includes(`  <scene${needed}/>`), (await text(page)).slice(0, 1600));
        await page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), whole);
    });

    test("attributes that were opened in the form stay so when one of them is written", async () => {
        const whole = await text(page);
        await page.click("#tab-form");
        await page.evaluate(() => document.querySelectorAll("#panel-form details.element").forEach((e) => /^limits/.test(e.textContent) && (e.open = true)));
        const more = page.locator("#panel-form details.element:not(:has(details.element)) details.more").first();
        await more.locator("summary").click();
        const field = more.locator('input[data-path$="/@cycles"]');
        const path = await field.getAttribute("data-path"); // a browser tells that it has opened a little later: this waits until it is filled
        const before = await more.locator(".field").count();
        await field.fill("1000");
        await field.press("Enter");
        await page.waitForFunction((t) => globalThis.flexwright.state.text !== t, whole);
        await page.waitForFunction((p) => !document.querySelector(`details.more [data-path="${p}"]`), path);
        assert.equal(await more.getAttribute("open"), "");
        assert.equal(await more.locator(".field").count(), before - 1);
        await page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), whole);
        await page.click("#tab-xml");
    });

    test("attributes that are not there yet, with words and names as values", async () => {
        const whole = await text(page);
        await behind('<flexure id="A" kind="csfh"');
        await page.keyboard.type(" ");
        await page.keyboard.press("Control+Space");
        const list = await options();
        const all = (await attributes("flexure")).map((a) => a.name);
        assert.deepEqual([...list].sort(), all.filter((x) => !["id", "kind", "length", "angle", "width", "gap"].includes(x)).sort());
        await page.keyboard.press("Escape");
        await page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), whole);
        await behind('<flexure id="B" kind="csfh"', 5);
        await page.keyboard.press("Control+Space");
        const kinds = (await attributes("flexure")).find((a) => a.name === "kind").choices;
        for (const kind of await options()) assert.ok(kinds.includes(kind), kind);
        await page.keyboard.press("Escape");
        await behind('angle="arc"', 4);
        await page.keyboard.press("Control+Space");
        assert.deepEqual((await options()).sort(), ["arc", "link"]);
        await page.keyboard.press("Escape");
        assert.equal(await text(page), whole);
    });

    test("the pointer tells what an attribute is, from the table", async () => {
        await behind('<flexure id="A" kind="csfh" length="300 um"', 12);
        const at = await page.evaluate(() => {
            const { view } = globalThis.flexwright.parts.editor;
            const c = view.coordsAtPos(view.state.selection.main.head);
            return [c.left + 2, (c.top + c.bottom) / 2];
        });
        await page.mouse.move(at[0] - 60, at[1] - 40);
        await page.mouse.move(...at);
        const said = await page.locator(".cm-tooltip-hover .cm-help").textContent();
        const length = (await attributes("flexure")).find((a) => a.name === "length");
        assert.ok(said.includes(length.sentence) && said.includes("<flexure> length"), said);
        await page.mouse.move(5, 5);
    });

    test("completions are read by assistive programs: no serious finding", async () => {
        await behind('angle="arc"', 4);
        await page.keyboard.press("Control+Space");
        await options();
        await page.evaluate(axeSource);
        const found = await page.evaluate(() => globalThis.axe.run("#edit", { resultTypes: ["violations"] }));
        assert.deepEqual(found.violations.filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => [v.id, v.nodes.map((n) => n.html)]), []);
        await page.keyboard.press("Escape");
        await page.click("#tab-form");
    });

    test("view, time and options are in the address, and found again by a reload", async () => {
        await answered(page, () => page.selectOption('#panel-motion select[aria-label="method"]', "minimal"));
        await answered(page, () => page.selectOption("#scene", "gentle-step"));
        await page.locator("input.time").focus();
        await page.keyboard.press("Home");
        for (let i = 0; i < 4; i++) await page.keyboard.press("PageUp");
        const time = await page.evaluate(() => globalThis.flexwright.parts.motion.time);
        await view(page, "modes");
        await page.waitForFunction(() => location.hash.includes("view=modes"));
        const q = new URLSearchParams(new URL(page.url()).hash.slice(1));
        assert.equal(q.get("method"), "minimal");
        assert.equal(q.get("scene"), "gentle-step");
        assert.ok(Math.abs(Number(q.get("t")) - time) <= 1e-3 * time, `${q.get("t")} ${time}`);
        assert.ok(!page.url().includes("token"));
        await page.reload();
        await ready(page);
        await page.waitForSelector("#panel-modes:not([hidden])");
        await page.waitForFunction(() => globalThis.flexwright.state.preview?.motion?.method === "minimal" && globalThis.flexwright.state.preview.motion.scene === "gentle-step");
        await view(page, "motion");
        await page.waitForFunction((t) => Math.abs(globalThis.flexwright.parts.motion.time - t) <= 1e-3 * t, time);
    });

    test("what an address has that is none of ours is not believed", async () => {
        await page.evaluate(() => (location.hash = "#view=elsewhere&method=magic&scene=no-such&accuracy=7&rtol=x&effects=none&t=1e9"));
        await page.waitForFunction(() => globalThis.flexwright.state.options.effects === "none");
        assert.deepEqual(await page.evaluate(() => globalThis.flexwright.state.options), { effects: "none" });
        await page.waitForFunction(() => globalThis.flexwright.state.preview?.motion?.scene === "step-load");
        assert.equal(await page.getAttribute("#tab-motion", "aria-selected"), "true");
        await page.evaluate(() => (location.hash = ""));
        await page.waitForFunction(() => globalThis.flexwright.state.options.effects === undefined);
    });
});
