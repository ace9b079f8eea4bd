// SPDX-License-Identifier: GPL-3.0-or-later
// Broken rules, small screens, keyboard, paper, both themes.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { ALL, axeSource, close, computed, finish, laidOut, open, program, serious, serve, source, text, theBrowser, verdict, view, SMALL } from "./helper.mjs";

after(finish);

describe("the report", () => {
    test("nothing is cut at 1280 pixels or on paper, A4 or Letter, whatever is opened", async () => {
        const server = await serve(null); // for its directory
        const page = await (await theBrowser()).newPage();
        try {
            const out = join(server.directory, "out");
            spawnSync(program, ["plan", join(source, "docs/gallery/reference-six-bar/device.xml"), "-o", out, "-q", "--corners", "none", "--advice", "none",
                "--measurements", "none", "--hinge-model", "revolute", "--accuracy", "3e-2"]);
            await page.goto(`file://${out}/report.html`);
            await page.evaluate(() => document.querySelectorAll("details").forEach((d) => (d.open = true)));
            for (const [media, width] of [["screen", 1280], ["print", 688], ["print", 710]]) { // paper less its margins of 14 mm
                await page.setViewportSize({ width, height: 900 });
                await page.emulateMedia({ media });
                const cut = await page.evaluate(() => [...document.querySelectorAll("main table, main svg, main pre, p")]
                    .filter((e) => !e.parentElement.closest("svg") && e.getBoundingClientRect().right > (e.closest(".wide, main") ?? document.body).getBoundingClientRect().right + 1)
                    .map((e) => `${e.tagName} of ${e.closest("section")?.id}: ${e.textContent}`.slice(0, 60)));
                assert.deepEqual(cut, [], `${media} ${width}`);
            }
        } finally {
            await page.close();
            await server.stop();
        }
    });
});

/** What is wrong with the place of a control: outside of the window or of what clips it, its own words cut, something else over it. */
const misplaced = (page, within = "body") => page.evaluate((w) => {
    const out = new Set();
    for (const e of document.querySelector(w).querySelectorAll("button, .button, select, input, textarea, summary")) {
        const r = e.getBoundingClientRect();
        if (!e.checkVisibility({ visibilityProperty: true, opacityProperty: true }) || r.width <= 1 || e.closest(".skip, .read-only, .cm-editor")) continue;
        const name = `${e.closest("[id]")?.id}: ${e.tagName.toLowerCase()} ${(e.getAttribute("aria-label") ?? e.innerText ?? e.value ?? "").trim().replace(/\s+/g, " ").slice(0, 40) || e.className}`;
        let [left, top, right, bottom] = [0, 0, innerWidth, innerHeight], scrolls = false, down = false;
        if (r.left < -0.5 || r.right > innerWidth + 0.5) out.add(`${name} is outside of the window`);
        for (let p = e.parentElement; p; p = p.parentElement) {
            const look = getComputedStyle(p), b = p.getBoundingClientRect();
            scrolls ||= p.matches(".wide, .schedule, .tradeoff, .diff"); // tables and pictures that are meant to be pushed
            down ||= ["auto", "scroll"].includes(look.overflowY);
            if (look.overflowX !== "visible" && !scrolls && (r.left < b.left - 0.5 || r.right > b.right + 0.5)) out.add(`${name} is cut by ${p.id || p.className}`);
            if (["hidden", "clip"].includes(look.overflowY) && !down && (r.top < b.top - 0.5 || r.bottom > b.bottom + 0.5)) out.add(`${name} is cut at the top or bottom by ${p.id || p.className}`);
            if (look.overflowX !== "visible") [left, top, right, bottom] = [Math.max(left, b.left), Math.max(top, b.top), Math.min(right, b.right), Math.min(bottom, b.bottom)];
        }
        if (e.matches("button, .button") && (e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1)) out.add(`${name}: its words are cut`);
        for (const x of [r.left + 3, (r.left + r.right) / 2, r.right - 3])
            for (const y of [r.top + 3, (r.top + r.bottom) / 2, r.bottom - 3]) {
                if (x < left || x > right || y < top || y > bottom) continue; // scrolled away
                const there = document.elementFromPoint(x, y);
                if (there && !e.contains(there) && !there.contains(e) && e.closest("label") !== there.closest("label, button, select, input")) out.add(`${name} is under ${there.tagName.toLowerCase()} ${there.id || there.getAttribute("class") || there.textContent.slice(0, 30)}`);
            }
    }
    return [...out];
}, within);

describe("plots", () => {
    test("each tells its unit, and the whole value under its cursor, from 1000 to 1440 pixels", async () => {
        const server = await serve("comb-stage");
        const page = await open(server);
        for (const width of [1000, 1024, 1180, 1280, 1440]) {
            await page.setViewportSize({ width, height: 900 });
            await laidOut(page);
            const bad = await page.evaluate(() => [...document.querySelectorAll("#panel-motion .plot")].filter((p) => p.offsetParent).flatMap((p) => {
                const [unit, value, toggle] = [".plot-unit", ".plot-value", ".toggle"].map((q) => p.querySelector(`.plot-title ${q}`));
                const name = p.querySelector(".plot-title").textContent;
                return [...(unit.offsetParent || (toggle && /%|°/.test(value.textContent)) ? [] : [`${name}: no unit`]),
                    ...[unit, value].filter((e) => e.offsetParent && e.scrollWidth > e.clientWidth + 1).map((e) => `${name}: "${e.textContent}" is cut`)];
            }));
            assert.deepEqual(bad, [], `${width} pixels`);
        }
        await close(page);
        await server.stop();
    });
});

describe("controls", () => {
    // combs, stops and drives beside the six-bar, whose page is looked at by axe below: every view is computed once for both
    for (const device of ["reference-six-bar", "comb-stage"])
        test(`none is cut off or covered in any view at 1000 to 1280 pixels, ${device}`, async () => {
            const server = await serve(device);
            const page = await open(server, { width: 1000, height: 768 });
            const found = [];
            const widths = ALL || device === "reference-six-bar" ? [1000, 1024, 1100, 1280] : [1000, 1280];
            await page.waitForSelector("#banner:has-text('as it will be made')", { timeout: 60000 });
            if (device === "comb-stage") await page.evaluate(axeSource);
            for (const id of ["motion", "draw", "workspace", "modes", "assembly", "masks", "recipe", "explore", "accuracy"]) {
                await view(page, id);
                if (["modes", "assembly", "masks", "recipe"].includes(id)) await computed(page, id, 60000);
                for (const width of widths) {
                    await page.setViewportSize({ width, height: 768 });
                    await laidOut(page); // plots and pictures take their new size
                    found.push(...(await misplaced(page)).map((x) => `${id} at ${width}: ${x}`));
                }
                if (device === "comb-stage") found.push(...(await serious(page, id, id === "motion" ? null : `#panel-${id}`)));
            }
            if (device === "comb-stage") {
                await page.click("#tab-xml");
                found.push(...(await serious(page, "xml", "#edit")));
            }
            assert.deepEqual(found, []);
            await close(page);
            await server.stop();
        });
});

test("what a new device may begin with is whole, whatever the window's size, in both themes", async () => {
    const server = await serve(null);
    const page = await open(server, { width: 1024, height: 768 });
    const found = [];
    for (const colorScheme of ["light", "dark"]) {
        await page.emulateMedia({ colorScheme });
        for (const [width, height] of [[1440, 900], [1024, 768], [800, 600], [390, 844]]) {
            await page.setViewportSize({ width, height });
            await page.click("#new");
            await page.waitForSelector(".template");
            await laidOut(page);
            found.push(...(await misplaced(page, "dialog")).map((x) => `${colorScheme} at ${width}: ${x}`));
            await page.keyboard.press("Escape");
            await page.waitForSelector("dialog", { state: "detached" });
        }
    }
    assert.deepEqual(found, []);
    await close(page);
    await server.stop();
});

test("values beside bars, fields deep in the form, the laboratory's table and what a drag says are whole at 1024 pixels", async () => {
    const server = await serve("reference-six-bar");
    const page = await open(server, { width: 1024, height: 768 });
    await page.evaluate(() => {
        const { state, parts } = globalThis.flexwright;
        for (const [i, x] of state.preview.verdict.hinges.entries()) x.utilisation = [1 / 0, 1.234e8, 123, 0.4567][i % 4];
        for (const f of state.preview.verdict.flows) for (const [i, x] of f.hinges.entries()) x.utilisation = [1 / 0, 1.234e8, 123, 0.4567][i % 4];
        parts.verdict.show();
    });
    const cut = (q) => page.evaluate((w) => [...document.querySelectorAll(w)].filter((e) => e.offsetParent && e.scrollWidth > e.clientWidth + 1).map((e) => `${e.className || e.id}: ${e.textContent.slice(0, 40)}`), q);
    assert.deepEqual(await cut("#right .bar, #right .bar-value, #right"), []);
    for (let i = 0; i < 4; i++) await page.evaluate(() => document.querySelectorAll("#panel-form details.element").forEach((e) => (e.open = true)));
    await laidOut(page);
    const narrow = await page.evaluate(() => [...document.querySelectorAll("#panel-form .field input")].filter((e) => e.offsetParent && e.clientWidth < 84).map((e) => `${e.dataset.path}: ${e.clientWidth}`));
    assert.deepEqual(narrow, []);
    await view(page, "recipe");
    await computed(page, "recipe", 60000);
    await page.evaluate(() => (document.querySelector("details.laboratory").open = true));
    for (let i = 0; i < 3; i++) await page.selectOption('.laboratory select[aria-label="Another number"]', { index: 1 });
    await page.evaluate(() => document.querySelectorAll(".lab-used").forEach((e) => (e.textContent = "nothing of yours: what is entered is not used yet")));
    await laidOut(page);
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll(".lab-table")].filter((t) => t.rows.length > 1 && t.getBoundingClientRect().right > document.querySelector("#panel-recipe").clientWidth + document.querySelector("#panel-recipe").getBoundingClientRect().left).length), 0);
    await close(page);
    await server.stop();
});

describe("rules and looks", () => {
    let server, page;
    before(async () => {
        server = await serve("reference-six-bar");
        writeFileSync(server.file, readFileSync(server.file, "utf8").replaceAll('gap="8 um"', 'gap="2 um"'));
        page = await open(server, { width: 1024, height: 768 });
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("a rule that is broken is found, and the list goes to its place", async () => {
        await view(page, "masks");
        await page.waitForSelector(".violation", { timeout: 30000 });
        const entry = page.locator('.violation:has-text("space")').first();
        await entry.click();
        const [place, middle, k] = await page.evaluate(() => {
            const { view: v, result } = globalThis.flexwright.parts.masks;
            const f = result.violations[0].findings.find((x) => x.what === "space");
            return [[0, 1].map((i) => (f.at_um[0][i] + f.at_um[1][i]) / 2), v.toWorld(v.size[0] / 2, v.size[1] / 2), v.k];
        });
        assert.ok(Math.hypot(place[0] - middle[0], place[1] - middle[1]) < 0.01 && k > 3, `${place} is not in the middle, ${middle}`);
        assert.equal(await entry.getAttribute("aria-current"), "true");
        // it bears its motion, and no flow can make it: no green, and the words of the terminal
        await page.waitForFunction(() => /cannot be made:/.test(document.querySelector("#banner").textContent), null, { timeout: 60000 });
        assert.match(await page.locator("#banner strong").innerText(), /Accepted, but cannot be made$/);
        assert.deepEqual(await page.evaluate(() => [document.querySelector("#banner").className.split(" ").includes("accept"), document.querySelector("#banner").dataset.verdict]), [false, "accept"]);
    });

    test("at 1024 pixels nothing is cut off or hidden behind another", async () => {
        const wide = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth, ...["top", "edit", "centre", "right"].map((id) => document.getElementById(id).getBoundingClientRect().right)]);
        assert.ok(wide[0] <= wide[1] && wide.slice(2).every((x) => x <= wide[1]), wide.join());
        const cut = await page.evaluate(() => [...document.querySelectorAll(".tabs")].map((t) => t.scrollWidth - t.clientWidth));
        assert.ok(cut.every((x) => x <= 0), `tabs are cut off by ${cut} pixels`);
        await view(page, "workspace");
        const legend = await page.evaluate(() => {
            const whole = document.querySelector("#panel-workspace .colour-legend");
            return [whole.querySelector(".ramp").getBoundingClientRect().width, whole.scrollWidth - whole.clientWidth];
        });
        assert.ok(legend[0] >= 50 && legend[1] <= 0, `the legend's colours are ${legend[0]} pixels wide, and ${legend[1]} are cut off`);
    });

    test("by keyboard alone: tabs, slider, views", async () => {
        await page.focus("#tab-masks");
        await page.keyboard.press("Home");
        assert.equal(await page.getAttribute("#tab-motion", "aria-selected"), "true");
        for (const next of ["tab-draw", "tab-workspace"]) {
            await page.keyboard.press("ArrowRight");
            assert.equal(await page.evaluate(() => document.activeElement.id), next);
        }
        await page.waitForFunction(() => globalThis.flexwright.settled(false)); // what waits for an answer cannot be pressed
        const seen = new Set();
        for (let i = 0; i < 250 && !seen.has("arc, slider"); i++) { // past every rule that is broken
            await page.keyboard.press("Tab");
            seen.add(await page.evaluate(() => document.activeElement.id || document.activeElement.getAttribute("aria-label") || document.activeElement.className.baseVal || document.activeElement.className));
        }
        for (const wanted of ["download", "arc, slider", "tab-form", "pose-x_m"]) assert.ok(seen.has(wanted), `${wanted} is not reached: ${[...seen].join("; ")}`);
    });

    test("on paper: picture and verdict, no controls", async () => {
        await view(page, "motion");
        await page.emulateMedia({ media: "print", colorScheme: "dark" });
        assert.ok(!(await page.isVisible("#edit")) && !(await page.isVisible("#save")));
        assert.ok(await page.isVisible("#banner"));
        await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
        assert.equal(await page.getAttribute("html", "data-theme"), "light");
        await page.evaluate(() => dispatchEvent(new Event("afterprint")));
        await page.emulateMedia({ media: "screen", colorScheme: "light" });
    });

    test("on paper the whole picture, and nothing over anything else; of what is entered the words alone", async () => {
        await view(page, "motion");
        const size = page.viewportSize();
        // paper is laid out without anybody being told, as this is in one go: no frame comes between
        await page.emulateMedia({ media: "print" });
        const outside = await page.evaluate(() => {
            dispatchEvent(new Event("beforeprint"));
            const stage = document.querySelector("#panel-motion .stage");
            stage.style.width = "330px";
            const [paper, parts] = [stage, stage.querySelector(".world")].map((e) => e.getBoundingClientRect());
            stage.style.width = "";
            dispatchEvent(new Event("afterprint"));
            return [parts.left - paper.left, paper.right - parts.right, paper.bottom - parts.bottom].filter((v) => v < -1);
        });
        assert.deepEqual(outside, []);
        await page.setViewportSize({ width: 718, height: 1000 }); // A4 less its margins
        await laidOut(page);
        const over = await page.evaluate(() => {
            const parts = [...document.querySelectorAll("#panel-motion :is(.stage, .plot), #panel-motion .run-stats, #right > *")].filter((e) => e.getClientRects().length && !e.hidden);
            const boxes = parts.map((e) => [e.className || e.id, e.getBoundingClientRect()]).filter(([, b]) => b.width > 1 && b.height > 1);
            return boxes.flatMap(([a, p], i) => boxes.slice(i + 1).filter(([, q]) => Math.min(p.right, q.right) - Math.max(p.left, q.left) > 2 && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 2).map(([b]) => `${a} and ${b}`));
        });
        assert.deepEqual(over, []);
        const cut = await page.evaluate(() => [...document.querySelectorAll("#panel-motion .plot")].filter((e) => e.getClientRects().length && e.querySelector("canvas")?.getBoundingClientRect().bottom > e.parentElement.getBoundingClientRect().bottom + 1).length);
        assert.equal(cut, 0);
        await page.emulateMedia({ media: "screen" });
        await page.setViewportSize(size);
        await view(page, "recipe");
        await page.evaluate(() => document.querySelectorAll("details.laboratory, details.as-run").forEach((e) => (e.open = true)));
        await page.emulateMedia({ media: "print" });
        assert.deepEqual(await page.locator("#panel-recipe :is(.log-form, button, a.button)").evaluateAll((list) => list.filter((e) => e.getClientRects().length).map((e) => e.outerHTML.slice(0, 80))), []);
        await page.emulateMedia({ media: "screen" });
        await page.evaluate(() => document.querySelectorAll("details.laboratory, details.as-run").forEach((e) => (e.open = false)));
        await view(page, "motion");
    });

    /** Options of a view, of Draw with every tool, for which the help has no sentence. */
    const unexplained = async (id) => {
        const out = [];
        for (const tool of id === "draw" ? await page.locator(".draw-tool").evaluateAll((list) => list.filter((b) => !b.hidden).map((b) => b.dataset.tool)) : [null]) {
            if (tool) await page.evaluate((t) => document.querySelector(`[data-tool="${t}"]`).click(), tool);
            await page.click("#help");
            const [names, told] = await page.evaluate((p) => [[...document.querySelectorAll(`#panel-${p} :is(select, input, textarea)`)].filter((e) => e.offsetParent && e.type !== "file").length, document.querySelectorAll(".help-list dt").length], id);
            const missing = await page.evaluate((p) => globalThis.flexwright.parts.unexplained(p), id);
            await page.keyboard.press("Escape");
            out.push(...missing.map((x) => `${id}: no help for ${x}`), ...(names > 0 && told === 0 ? [`${id}: the help is empty`] : []));
        }
        return out;
    };

    for (const theme of ["light", "dark"])
        test(`no serious finding of axe in any view, ${theme}`, async () => {
            await page.emulateMedia({ colorScheme: theme });
            await page.waitForFunction((t) => document.documentElement.dataset.theme === t, theme);
            if (theme === "light") await page.evaluate(axeSource);
            const found = [];
            for (const id of ["motion", "draw", "workspace", "modes", "assembly", "masks", "recipe", "explore", "accuracy", "xml", "about"]) {
                if (id === "xml") await page.click("#tab-xml");
                else if (id === "about") await page.click("#about");
                else await view(page, id);
                if (["modes", "assembly", "recipe"].includes(id)) await computed(page, id);
                if (theme === "light" && id !== "xml" && id !== "about") found.push(...(await unexplained(id)));
                // in the dark nothing but colours is another; what stands beside every view is looked at with the first and the last
                const where = ALL || ["motion", "about"].includes(id) ? null : id === "xml" ? "#edit" : `#panel-${id}`;
                const rules = theme === "dark" ? { runOnly: ["color-contrast", "link-in-text-block"] } : { rules: { "label-content-name-mismatch": { enabled: true } } };
                found.push(...(await serious(page, id, where, rules)));
            }
            await page.keyboard.press("Escape");
            await page.click("#tab-form");
            assert.deepEqual(found, []);
        });

    test("every library is named with its licence", async () => {
        const answer = await page.request.get(`http://127.0.0.1:${server.port}/licences.txt`);
        const body = await answer.text();
        for (const name of ["@codemirror/view", "@lezer/xml", "uplot"]) assert.ok(body.includes(`${name} `), name);
        assert.ok(existsSync(join(source, "web/package-lock.json")));
        assert.doesNotMatch(readFileSync(join(source, "web/package-lock.json"), "utf8"), /"resolved": "(?!https:\/\/registry\.npmjs\.org\/)/);
    });
});

describe("accessibility of other pages than the six-bar's", () => {
    // with all tests also outlines of one's own, and nothing at all; the comb stage's is looked at with the places of its controls
    for (const device of ALL ? ["free-form-gripper", null] : [])
        test(`no serious finding of axe in any view of ${device ?? "a page without a device"}`, async () => {
            const server = await serve(device);
            const page = await open(server, SMALL);
            try {
                await page.evaluate(axeSource);
                const found = [], seen = [];
                for (const id of ["motion", "draw", "workspace", "modes", "assembly", "masks", "recipe", "explore", "accuracy", "xml"]) {
                    const tab = page.locator(`#tab-${id}`);
                    if (!(await tab.count()) || !(await tab.isVisible()) || !(await tab.isEnabled())) continue;
                    seen.push(id);
                    await tab.click();
                    if (device && ["modes", "assembly", "recipe"].includes(id)) await computed(page, id);
                    found.push(...(await serious(page, id, null)));
                }
                assert.deepEqual(found, []);
                assert.ok(seen.length >= 4, seen.join());
            } finally {
                await close(page);
                await server.stop();
            }
        });
});
