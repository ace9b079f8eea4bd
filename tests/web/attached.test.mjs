// SPDX-License-Identifier: GPL-3.0-or-later
// What is attached to the bodies: cables, springs and electrodes stand where the answer puts their points, and
// move with them; arrows and words say what the scene does at that time.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { answered, close, finish, open, serve, source } from "./helper.mjs";

after(finish);

/** Points of a path of M and L (or h) commands. */
const points = (d) => [...d.matchAll(/[ML]([-\d.e]+) ([-\d.e]+)/g)].map((m) => [Number(m[1]), Number(m[2])]);
const far = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
/** A point of a body in um, from a row of the motion: the body's matrix times the point. */
const at = (row, body, [x, y]) => {
    if (body < 0) return [x, y];
    const [px, py, phi] = row.slice(3 * body, 3 * body + 3);
    return [px * 1e6 + Math.cos(phi) * x - Math.sin(phi) * y, py * 1e6 + Math.sin(phi) * x + Math.cos(phi) * y];
};
const along = (list) => list.slice(1).reduce((sum, p, i) => sum + far(p, list[i]), 0);

describe("attached to the bodies", () => {
    let server, page;
    const preview = () => page.evaluate(() => globalThis.flexwright.state.preview);
    const shown = (query) => page.locator(`#panel-motion .attached ${query}`);
    const paths = async (query) => (await shown(query).evaluateAll((list) => list.map((e) => e.getAttribute("d")))).map(points);
    const slide = async (key) => {
        await page.locator("input.time").focus();
        await page.keyboard.press(key);
    };
    before(async () => {
        server = await serve("four-tendons");
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("cables run through their eyelets and move with the bodies", async () => {
        const p = await preview();
        const rest = p.bodies.flatMap((b) => b.rest ?? []);
        for (const [key, row] of [["Home", p.motion.q[0]], ["End", p.motion.q.at(-1)]]) {
            await slide(key);
            const drawn = await paths(".cable");
            assert.equal(drawn.length, 4);
            p.loads.forEach((t, i) => t.eyelets.forEach((e, k) => assert.ok(far(drawn[i][k], at(row, e.body, e.at_um)) < 0.01, `${t.id} at ${key}`)));
        }
        const box = p.scene_box_um;
        for (const t of p.loads) for (const e of t.eyelets) {
            const [x, y] = at(rest, e.body, e.at_um);
            assert.ok(x >= box[0] && x <= box[2] && y >= box[1] && y <= box[3], "an eyelet is outside of the picture");
        }
    });

    test("on a narrow screen no button lies over the name of a cable", async () => {
        const size = page.viewportSize();
        await page.setViewportSize({ width: 390, height: 844 });
        await page.waitForTimeout(200); // the picture takes its size
        const over = await page.evaluate(() => {
            const box = (e) => e.getBoundingClientRect();
            const buttons = [...document.querySelectorAll("#panel-motion .stage-tools, #panel-motion .zoom-buttons")].map(box);
            return [...document.querySelectorAll("#panel-motion .attached-tag")].filter((e) => e.textContent).map((e) => [e.textContent, box(e)])
                .filter(([, t]) => buttons.some((b) => t.left < b.right && b.left < t.right && t.top < b.bottom && b.top < t.bottom)).map(([name]) => name);
        });
        assert.deepEqual(over, []);
        await page.setViewportSize(size);
    });

    test("a cable says its tension, its arrow what is drawn in", async () => {
        const p = await preview();
        await slide("End");
        const titles = await shown(".cable title").allTextContents();
        p.loads.forEach((t, i) => {
            const told = /tension ([\d.]+) (µ|m)N$/.exec(titles[i]);
            const value = Number(told[1]) * (told[2] === "m" ? 1e-3 : 1e-6);
            assert.ok(Math.abs(value / p.motion.tension_N[i].at(-1) - 1) < 0.06, `${titles[i]}, ${p.motion.tension_N[i].at(-1)}`); // two digits
        });
        const arrows = page.locator("#panel-motion .arrows .load:not(.none)");
        assert.deepEqual((await arrows.locator("title").allTextContents()).map((x) => x.slice(0, 8)), ["cable T2", "cable T3"]);
        await slide("Home");
        assert.equal(await arrows.count(), 0, "at the beginning of the ramps nothing is drawn in");
        await page.waitForTimeout(50);
        assert.match((await shown(".cable title").allTextContents())[1], /^cable T2: 0 µm drawn in, tension/);
    });

    test("a cable that is too long is slack", async () => {
        await answered(page, () => page.evaluate(() => {
            const { editor } = globalThis.flexwright.parts;
            editor.replace(editor.text.replace('id="T1" stiffness="cable" damping="2e-4 N s/m" slack="-1 um"', 'id="T1" stiffness="cable" damping="2e-4 N s/m" slack="90 um"'));
        }));
        await slide("End");
        const p = await preview();
        const slack = p.motion.tension_N.map((list) => list.at(-1) === 0);
        assert.ok(slack[0] && slack.includes(false), slack.join());
        assert.deepEqual(await shown(".cable").evaluateAll((list) => list.map((e) => e.classList.contains("slack"))), slack);
        const titles = await shown(".cable title").allTextContents();
        slack.forEach((is, i) => assert.match(titles[i], is ? /slack$/ : /tension/));
    });

    test("electrodes that nobody has drawn move with rotor and stator; a spring is as long as it is", async () => {
        const device = readFileSync(join(source, "tests/data/effects/comb.xml"), "utf8")
            .replace("</mechanism>", '<spring id="back" a="coupler" a-x="-0.3 mm" a-y="0.1 mm" b="ground" b-x="0.1 mm" b-y="2 mm" stiffness="1 N/m" length="0.8 mm"/></mechanism>');
        await answered(page, () => page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), device));
        await slide("End");
        const p = await preview();
        const [comb] = p.loads;
        assert.equal(comb.drawn, false);
        const row = p.motion.q.at(-1);
        const body = p.bodies[comb.bodies[1]].id;
        assert.equal(await shown(".rotor").getAttribute("transform"), await page.locator(`#panel-motion .body[data-id="${body}"]`).getAttribute("transform"));
        // from the tips of the rotor's fingers to those of the stator's, on the screen: the overlap and the way of the rotor
        const [overlap, rotor, stator] = await page.evaluate(() => {
            const k = globalThis.flexwright.parts.motion.mechanism.view.k;
            const ends = ["rotor", "stator"].map((name) => {
                const path = document.querySelector(`#panel-motion .electrode.${name} path`);
                const [b, m] = [path.getBBox(), path.getCTM()];
                const x = [b.x, b.x + b.width].map((v) => new DOMPoint(v, b.y + b.height / 2).matrixTransform(m).x / k);
                return { tip: name === "rotor" ? Math.max(...x) : Math.min(...x), size: [b.width, b.height] };
            });
            return [ends[0].tip - ends[1].tip, ends[0].size, ends[1].size];
        });
        const way = at(row, comb.bodies[1], comb.at_um)[0] - at(p.bodies.flatMap((b) => b.rest ?? []), comb.bodies[1], comb.at_um)[0];
        assert.ok(Math.abs(way) > 0.1 && Math.abs(overlap - (comb.overlap_um + way)) < 0.02, `${overlap} for ${comb.overlap_um} + ${way}`);
        assert.deepEqual([rotor, stator].map((s) => s.map((v) => Number(v.toFixed(2)))), [[100, 30 * 8 + 29 * 20], [100, 31 * 8 + 30 * 20]]);
        const [spring] = p.springs;
        const zigzag = (await paths(".spring"))[0];
        assert.ok(far(zigzag[0], at(row, spring.bodies[0], spring.on_a_um)) < 0.01 && far(zigzag.at(-1), spring.on_b_um) < 0.01);
        assert.ok(zigzag.length > 10 && along(zigzag) > 1.2 * far(zigzag[0], zigzag.at(-1)));
    });

    test("a plate that is not drawn stands a gap away from its rotor", async () => {
        await answered(page, () => page.selectOption("#scene", "pull-back"));
        await slide("Home");
        const gap = await page.evaluate(() => {
            const k = globalThis.flexwright.parts.motion.mechanism.view.k;
            const [rotor, stator] = ["rotor", "stator"].map((name) => {
                const path = document.querySelector(`#panel-motion .electrode.${name} path`);
                const [b, m] = [path.getBBox(), path.getCTM()];
                return [b.x, b.x + b.width].map((v) => new DOMPoint(v, b.y).matrixTransform(m).x / k).sort((a, c) => a - c);
            });
            return rotor[0] - stator[1]; // it pulls to the left
        });
        assert.ok(Math.abs(gap - 20) < 0.02, `${gap}`);
    });
});
