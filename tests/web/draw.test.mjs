// SPDX-License-Identifier: GPL-3.0-or-later
// A device made with the mouse: from an empty page to an accepted gripper without touching the text, and things that
// are there dragged, with what is written respected.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { ALL, answered, axeSource, close, finish, open, serve, setText, source, text, verdict, view } from "./helper.mjs";

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
        await page.waitForSelector("#panel-draw:not([hidden])"); // an empty page opens where it is drawn on
        await page.waitForSelector("#right .problems:has-text('Nothing is drawn yet')");
        assert.equal(await page.locator('button:has-text("Judge as fabricated")').isVisible(), false); // of nothing
        assert.equal(await page.locator(".old:visible, .old-note:visible, #banner:visible").count(), 0, "nothing of the device that was there is left, not even as a former answer");
        await shot(page, "draw-empty.png");
        await tool(page, "bar");
        await changed(page, () => drag(page, [-400, 0], [-400, 1000]));
        await page.selectOption('label:has-text("belongs to") select', "link-1");
        await changed(page, () => drag(page, [-400, 1000], [-100, 1000]));
        await page.selectOption('label:has-text("belongs to") select', "");
        await changed(page, () => drag(page, [400, 0], [400, 1000]));
        await page.selectOption('label:has-text("belongs to") select', "link-2");
        await changed(page, () => drag(page, [400, 1000], [100, 1000]));
        await page.waitForFunction(() => document.querySelectorAll("#panel-draw .sketch-shape.faulty").length === 4); // a mistake is red where it is
        assert.match(await page.locator("#right .problems").innerText(), /no hinge holds it yet/i);
        await shot(page, "draw-links.png");
        await tool(page, "hinge");
        await changed(page, () => click(page, [-400, 0]));
        await changed(page, () => click(page, [400, 0]));
        assert.equal((await text(page)).match(/<flexure /g).length, 1, "hinges of the same sizes share their flexure");
        await page.waitForSelector("#right .problems:has-text('Nothing moves it yet')"); // what comes next, and no mistake
        await tool(page, "force");
        await changed(page, () => drag(page, [-400, 600], [-200, 600]));
        await changed(page, () => drag(page, [400, 600], [200, 600]));
        await verdict(page, "accept");
        await page.waitForSelector(".as-drawn:text-is('as it will be made')", { timeout: 60000 });
        await shot(page, "draw-gripper.png");
        await changed(page, () => setText(page, ['name="new-device"', 'name="new-device" wrong="yes"']));
        await page.waitForSelector("#banner.old:visible"); // of this device: what was known before the mistake stays, and looks old
        await page.click("#undo");
        await verdict(page, "accept");
    });

    test("a jaw again as its mirror image is the same jaw: what it uses of its limit, and every point", async () => {
        const { hinges, xml } = await page.evaluate(() => ({ hinges: globalThis.flexwright.state.preview.verdict.hinges.map((x) => x.utilisation), xml: globalThis.flexwright.state.text }));
        await page.evaluate(() => globalThis.flexwright.parts.draw.bar.querySelector('[data-tool="select"]').click());
        await page.selectOption('select[aria-label="Part"]', "device/mechanism/body[link-2]");
        await changed(page, () => page.click(".draw-remove"));
        await page.selectOption('select[aria-label="Part"]', "device/mechanism/body[link-1]");
        await page.click(".draw-mirror > summary");
        await changed(page, () => page.click(".draw-copy"));
        await page.waitForFunction(() => globalThis.flexwright.settled(false) && globalThis.flexwright.state.preview.verdict?.hinges.length === 2);
        const [now, rings] = await page.evaluate(() => [globalThis.flexwright.state.preview.verdict.hinges.map((x) => x.utilisation), globalThis.flexwright.parts.draw.places.shapes().map((x) => [x.body, x.rings[0]])]);
        now.forEach((u, i) => assert.ok(Math.abs(u - hinges[i]) < 1e-6 * u, `${now} and ${hinges}`));
        const of = (body) => rings.filter(([b]) => b === body).flatMap(([, r]) => r);
        const image = of("link-1-mirrored");
        assert.equal(image.length, 8);
        for (const [x, y] of of("link-1")) assert.ok(image.some((p) => Math.hypot(p[0] + x, p[1] - y) < 1e-6), `${x}, ${y}`);
        for (const part of ['<body id="link-1-mirrored" x="400 um" y="0 um">', '<revolute id="B" a="ground" a-x="400 um" a-y="0 um" b="link-1-mirrored"', '<force on="link-1-mirrored" x="0 um" y="600 um" fx="-10 uN"']) assert.ok((await text(page)).includes(part), `${part} in ${await text(page)}`);
        for (let i = 0; i < 2; i++) await page.click("#undo");
        assert.equal(await text(page), xml);
        await answered(page, () => setText(page, ["</mechanism>", '</mechanism>\n  <probe id="tip" kind="displacement" on="link-1" direction="0 deg"/>']));
        await page.selectOption('select[aria-label="Part"]', "device/mechanism/body[link-1]");
        if (!(await page.locator(".draw-copy").isVisible())) await page.click(".draw-mirror > summary");
        await changed(page, () => page.click(".draw-copy"));
        await page.locator(".notice:has-text('what could not be mirrored was left out: probe tip.')").waitFor();
        for (let i = 0; i < 2; i++) await page.click("#undo");
        assert.equal(await text(page), xml);
    });

    test("a stage, with the mouse alone", async () => {
        await tool(page, "force");
        await page.click("#new");
        await page.click('.template:has-text("Empty page")');
        await page.click("dialog .drop"); // the gripper was not saved
        await page.waitForSelector("#right .problems:has-text('Nothing is drawn yet')");
        assert.equal(await page.getAttribute('.draw-tools [data-tool="select"]', "aria-pressed"), "true"); // the tool was for the device before
        await tool(page, "bar");
        await page.selectOption('label:has-text("belongs to") select', "");
        for (const x of [-500, 500]) await changed(page, () => drag(page, [x, 0], [x, 900]));
        await changed(page, () => drag(page, [-500, 900], [500, 900]));
        await tool(page, "hinge");
        for (const at of [[-500, 0], [500, 0], [-500, 900], [500, 900]]) await changed(page, () => click(page, at));
        await tool(page, "hinge");
        await click(page, [0, 400]); // beside the links
        await page.waitForSelector('.notice:has-text("choose that under \\"holds\\"")');
        await tool(page, "force");
        await changed(page, () => drag(page, [0, 900], [200, 900]));
        await verdict(page, "accept");
        await page.waitForSelector('button:has-text("Judge as fabricated"):visible');
        await page.click('button:has-text("Judge as fabricated")'); // by itself only where the last one was quick
        await page.waitForSelector(".as-drawn:text-is('as it will be made')", { timeout: 60000 });
        await shot(page, "draw-stage.png");
    });
});

describe("without a pointer, and what cannot be made", () => {
    let server, page;
    const type = async (label, value) => {
        await page.fill(`.view-draw input[aria-label="${label}"]`, String(value));
    };
    const add = async (act = () => page.press(".draw-add", "Enter")) => changed(page, act);
    before(async () => {
        server = await serve(null);
        page = await open(server);
        await page.click("#new");
        await page.click('.template:has-text("Empty page")');
        await view(page, "draw");
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("tools take numbers; an arm, its hinge, a hole, a cable and electrodes are made with keys", async () => {
        await page.selectOption('select[aria-label="Grid"]', "5");
        const key = async (id) => page.press(`.draw-tools [data-tool="${id}"]`, "Enter");
        const points = async (...list) => {
            for (const [name, x, y] of list) {
                await type(`${name}, x, µm`, x);
                await type(`${name}, y, µm`, y);
            }
        };
        await key("bar");
        await points(["from", 0, 0], ["to", 0, 900]);
        await add();
        await key("plate");
        await points(["from", -200, 800], ["to", 200, 1100]);
        await add();
        await key("disc");
        await page.selectOption('label:has-text("cut out") select', "yes");
        await points(["from", 100, 950], ["to", 140, 950]);
        await add();
        await key("hinge");
        await page.selectOption('label:has-text("kind") select', "leaf");
        await points(["at", 0, 0]);
        await add();
        await key("cable");
        for (const [x, y] of [[-100, 950], [-700, 950]]) {
            await points(["next eyelet", x, y]);
            await page.press(".draw-add", "Enter");
        }
        await add(() => page.press('.view-draw button:has-text("Finish")', "Enter"));
        await verdict(page, "reject");
        const eyelet = page.locator('.draw-handle.doubtful[data-id*="eyelet[2]"]'); // it stands outside of the frame
        await eyelet.focus();
        assert.match(await eyelet.getAttribute("aria-label"), /outside of the frame/);
        for (let i = 0; i < 2; i++) await changed(page, () => page.keyboard.press("Shift+ArrowRight"));
        await verdict(page, "accept");
        const xml = await text(page);
        for (const part of ['<bar x="0 um" y="0 um" to-x="0 um" to-y="900 um" width="120 um"/>', '<plate x="0 um" y="950 um" width="400 um" height="300 um"/>', '<disc x="100 um" y="950 um" radius="40 um" hole="yes"/>',
            '<flexure id="leaf-1" kind="leaf" length="300 um" width="10 um"/>', 'a="ground" a-x="0 um" a-y="0 um" b="link-1"', '<eyelet on="link-1" x="-100 um" y="950 um"/>', '<eyelet on="ground" x="-600 um" y="950 um"/>'])
            assert.ok(xml.includes(part), `${part} in ${xml}`);
        await key("comb");
        await points(["from", 0, 1100], ["to", 0, 1300]);
        await add();
        assert.match(await text(page), /<comb-drive id="comb-1" kind="comb" on="link-1" x="0 um" y="1100 um" direction="90 deg" fingers="10"/);
        await page.click("#undo");
        assert.equal(await text(page), xml);
    });

    test("parts that overlap are red where they do, until they are dragged apart", async () => {
        await tool(page, "bar");
        await changed(page, () => drag(page, [-300, 500], [300, 500]));
        await page.waitForSelector('#banner[data-verdict="failed"]');
        assert.ok(await page.locator("#panel-draw .overlap").count() > 0);
        assert.ok(await page.locator("#panel-draw .mark-tag").count() > 0);
        await page.click("#undo");
        await verdict(page, "accept");
        assert.equal(await page.locator("#panel-draw .overlap").count(), 0);
        await page.click('#panel-draw button[aria-label="Zoom out"]'); // room above the plate
        await tool(page, "outline");
        for (const at of [[-200, 1100], [-200, 1300], [-100, 1300]]) await click(page, at);
        await changed(page, () => click(page, [-200, 1100]));
        assert.match(await text(page), /<outline id="outline-1" start-x="-200 um" start-y="1100 um">\s*<line to-x="-200 um" to-y="1300 um"\/>\s*<line to-x="-100 um" to-y="1300 um"\/>\s*<line to-x="-200 um" to-y="1100 um"\/>\s*<\/outline>/);
        await page.click("#undo");
        for (const at of [[-200, 1100], [-200, 1300]]) await click(page, at); // and with a half circle over a point
        await page.selectOption('label:has-text("next side") select', "arc");
        for (const at of [[-150, 1350], [-100, 1300]]) await click(page, at);
        await page.selectOption('label:has-text("next side") select', "line");
        await changed(page, () => page.keyboard.press("Enter"));
        assert.match(await text(page), /<line to-x="-200 um" to-y="1300 um"\/>\s*<arc to-x="-100 um" to-y="1300 um" radius="50 um" turn="right"( large="(yes|no)")?\/>\s*<line to-x="-200 um" to-y="1100 um"\/>/);
        const ring = await page.evaluate(() => globalThis.flexwright.parts.draw.places.shapes().find((x) => x.element.name === "outline").rings[0]);
        assert.ok(Math.max(...ring.map((p) => p[1])) > 1349, "it passes the point");
        await page.click("#undo");
        await page.evaluate(axeSource);
        await tool(page, "hinge");
        const axe = await page.evaluate(() => globalThis.axe.run("#panel-draw", { resultTypes: ["violations"] }));
        assert.deepEqual(axe.violations.filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => [v.id, v.nodes[0].html]), []);
    });
});

describe("what is there is dragged", () => {
    let server, page;
    const handle = (id) => page.locator(`.draw-handle[data-id="${id}"]`);
    const place = (id) => page.evaluate((x) => globalThis.flexwright.parts.draw.list.find((h) => h.id === x)?.at, id);
    const load = async (name) => {
        const xml = readFileSync(join(source, "docs/gallery", name, "device.xml"), "utf8");
        await page.evaluate((t) => globalThis.flexwright.parts.editor.open(t), xml);
        await page.waitForFunction(() => globalThis.flexwright.settled(false) && globalThis.flexwright.state.preview);
        return xml;
    };
    before(async () => {
        server = await serve(null);
        page = await open(server);
        await view(page, "draw");
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("every hinge of the gallery has its handle where the program has its pin", async () => {
        const seen = [];
        for (const name of ["reference-six-bar", "leaf-four-bar", "straight-stage", "free-form-gripper", "free-form-four-bar", "comb-stage", "four-tendons"]) {
            await load(name);
            const off = await page.evaluate(() => {
                const { list } = globalThis.flexwright.parts.draw;
                return globalThis.flexwright.state.preview.pins.map((p) => {
                    const own = list.find((h) => h.look === "hinge" && h.element.id === p.id);
                    const at = globalThis.flexwright.state.preview.flexures.find((f) => f.id === p.id)?.centre_um ?? p.at_um;
                    return own ? Math.hypot(own.at[0] - at[0], own.at[1] - at[1]) : Infinity;
                });
            });
            const values = await page.evaluate(() => globalThis.flexwright.state.preview.parameters.map((p) => [p.name, p.value_SI, globalThis.flexwright.parts.draw.places.evaluate(p.name)]));
            for (const [parameter, si, own] of values) assert.ok(Math.abs(own - si) <= 1e-12 * Math.abs(si), `${name}: ${parameter} is ${si}, and ${own} in the page`);
            assert.ok(off.length > 0 && off.every((d) => d < 0.01), `${name}: off by ${off} um`);
            seen.push(...off);
        }
        assert.ok(seen.length > 25);
    });

    test("at any scale the arrow of a load is as long, and ends inside of the fitted picture", async () => {
        for (const size of [{ width: 1024, height: 768 }, { width: 1440, height: 900 }]) {
            await page.setViewportSize(size);
            await load("reference-six-bar");
            const ends = () => page.evaluate(() => {
                const r = globalThis.flexwright.parts.draw.stage.getBoundingClientRect();
                return [...document.querySelectorAll("#panel-draw .draw-handle.tip .reach")].map((e) => {
                    const q = e.getBoundingClientRect();
                    const path = /M([-\d.]+) ([-\d.]+)L([-\d.]+) ([-\d.]+)/.exec(document.querySelector("#panel-draw .tip-stem").getAttribute("d")).slice(1).map(Number);
                    return { inside: q.left > r.left && q.right < r.right && q.top > r.top && q.bottom < r.bottom, long: Math.hypot(path[2] - path[0], path[3] - path[1]) };
                });
            });
            await page.evaluate(() => globalThis.flexwright.parts.draw.view.fit());
            assert.ok((await ends()).length > 0 && (await ends()).every((x) => x.inside), JSON.stringify(await ends()));
            const [{ long }] = await ends();
            await page.evaluate(() => globalThis.flexwright.parts.draw.view.zoom(1.7));
            assert.ok(Math.abs((await ends())[0].long - long) < 1 || long < 62, `${long}, ${(await ends())[0].long}`);
        }
    });

    test("expressions are read as the program reads them", async () => {
        const list = ["1 um", "-2^2", "2^-1 * 4", "3 um*2 + 4 um/2", "2*span", "-span", "span/3 - 5 um", "sqrt(9) * 1 mm", "min(1 um, 2 um, span)", "atan2(1, -1)", "30 deg", "1e-3 m", "2 N m/rad", "0.3 kg/A/s^2", "5 N/m^2", "pi*1 um", ".5 mm", "((1 um))", "1 um * cos(60 deg)", "2 m s^-1"];
        await load("free-form-gripper");
        const text_ = await text(page);
        const own = await page.evaluate((x) => x.map((e) => globalThis.flexwright.parts.draw.places.evaluate(e)), list);
        const xml = text_.replace("<material", `${list.map((e, i) => `<parameter name="q${i}" value="${e}"/>`).join("")}<material`);
        await answered(page, () => page.evaluate((t) => globalThis.flexwright.parts.editor.open(t), xml));
        await page.waitForFunction(() => globalThis.flexwright.settled(false));
        const told = await page.evaluate(() => globalThis.flexwright.state.preview.parameters.filter((p) => /^q\d/.test(p.name)).map((p) => p.value_SI));
        assert.equal(told.length, list.length);
        list.forEach((e, i) => assert.ok(Math.abs(own[i] - told[i]) <= 1e-14 * Math.abs(told[i]) + 1e-30, `${e}: ${own[i]}, and ${told[i]} in the program`));
        const wrong = ["1 um +", "1 um span", "foo", "2 (3)", "1,5 um", "nan(1)", ""];
        assert.ok((await page.evaluate((x) => x.map((e) => globalThis.flexwright.parts.draw.places.evaluate(e)), wrong)).every((v) => v === null || Number.isNaN(v)));
    });

    test("a parameter is changed, and all that uses it follows; one drag is one undo", async () => {
        const xml = await load("free-form-gripper");
        const id = "device/mechanism/revolute[A]";
        assert.deepEqual(await place(id), [-600, 0]);
        await drag(page, [-600, 0], [-700, 0], { release: false });
        await page.waitForFunction(() => /^700 um|^0.7 mm/.test(globalThis.flexwright.state.set.span ?? ""));
        assert.equal(await text(page), xml, "the text waits until it is let go");
        const told = () => page.evaluate(() => Number(document.querySelector('#panel-draw .pose-fields input[aria-label="x, µm"]').value));
        assert.equal(await told(), -700, "the panel tells where it is now");
        await page.waitForFunction(() => document.querySelector(".draw-stage").dataset.of === "present" && !document.querySelector(".draw-stage.old")); // the picture follows
        await changed(page, () => page.mouse.up());
        assert.equal(await text(page), xml.replace('name="span" value="0.6 mm"', 'name="span" value="0.7 mm"'));
        assert.deepEqual(await place("device/mechanism/revolute[B]"), [700, 0]);
        assert.deepEqual(await page.evaluate(() => globalThis.flexwright.state.set), {});
        await page.click("#undo");
        assert.equal(await text(page), xml);
        await page.waitForFunction(() => globalThis.flexwright.settled(false));
        assert.equal(await told(), -600);
        // a mistake that was told of the text is none of what is dragged, until that is answered; then it is what the answer says
        await answered(page, () => setText(page, ['<revolute id="A"', '<revolute id="A" stop-max="-400 deg"']));
        const fault = () => page.evaluate(() => [...document.querySelectorAll("#panel-draw .pose-status.bad")].filter((e) => !e.hidden).map((e) => e.textContent).join());
        await page.waitForFunction(() => globalThis.flexwright.settled(false));
        assert.notEqual(await fault(), "");
        await page.route("**/api/preview", async (route) => {
            await new Promise((resolve) => setTimeout(resolve, 600));
            await route.continue().catch(() => {}); // it may be given up
        });
        await drag(page, [-600, 0], [-650, 0], { release: false });
        assert.equal(await fault(), "");
        await page.waitForFunction(() => [...document.querySelectorAll("#panel-draw .pose-status.bad")].some((e) => !e.hidden), null, { timeout: 20000 });
        await page.keyboard.press("Escape");
        await page.mouse.up();
        await page.unrouteAll({ behavior: "wait" });
    });

    test("a drag is the same in however many moves the pointer does it: what is asked for, what is written, and what undo takes back", async () => {
        const asked = []; // what is held, of every preview
        page.on("request", (r) => r.url().endsWith("/api/preview") && asked.push(JSON.parse(r.postData()).set));
        const held = () => page.evaluate(() => ({ ...globalThis.flexwright.state.set }));
        const cases = [ // a device, what is clicked first, what is taken, by so many pixels
            ["reference-six-bar", null, "device/six-bar/hinge[B]", [-15, -18]],
            ["free-form-gripper", [-680, 600], "device/mechanism/body[left]/outline/line[1]", [-17, -23]],
            ["four-tendons", null, /eyelet/, [31, 27]],
            ["free-form-four-bar", [900, 1500], "device/mechanism/body[coupler]", [-22, -31]],
        ];
        for (const [name, first, which, by] of cases) {
            const xml = await load(name);
            await page.keyboard.press("Escape");
            if (first) await click(page, first);
            const [id, at] = await page.evaluate(([s, regular]) => {
                const { draw } = globalThis.flexwright.parts;
                const h = draw.list.find((x) => (regular ? new RegExp(s).test(x.id) && [...draw.handles.children].some((g) => g.dataset.id === x.id) : x.id === s));
                return [h.id, h.at];
            }, typeof which === "string" ? [which, false] : [which.source, true]);
            let one = null;
            for (const n of ALL || name === "reference-six-bar" ? [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13] : [1, 2, 6]) {
                const a = await pixels(page, at);
                const b = [a[0] + by[0], a[1] + by[1]];
                const way = (i) => [a[0] + ((b[0] - a[0]) * i) / n, a[1] + ((b[1] - a[1]) * i) / n];
                await page.mouse.move(...a);
                await page.mouse.down();
                for (let i = 1; i <= n; i++) {
                    await page.mouse.move(...way(i));
                    if (i % 2) await page.mouse.move(way(i)[0] + 0.2, way(i)[1] - 0.2); // a hand is not still, and both come to the same place
                    if (i % 3 === 0) await page.mouse.move(...way(i));
                }
                await page.mouse.move(...b);
                await page.waitForFunction(() => globalThis.flexwright.settled(false));
                const set = await held();
                assert.deepEqual(asked.at(-1), set, `${id}, ${n} moves: what is asked for is what is held`);
                await changed(page, () => page.mouse.up());
                await page.waitForFunction(() => globalThis.flexwright.settled(false));
                const now = await text(page);
                one ??= { set, now };
                assert.ok(Object.keys(one.set).length > 0, id);
                assert.deepEqual(set, one.set, `${id}, ${n} moves: what is held`);
                assert.equal(now, one.now, `${id}, ${n} moves: what is written`);
                assert.deepEqual(await held(), {});
                await page.keyboard.press("Control+z");
                await page.waitForFunction((t) => globalThis.flexwright.state.text === t && globalThis.flexwright.settled(false), xml);
            }
        }
    });

    test("a drag that begins before the last one is in the text, and arrow keys faster than the text, lose nothing", async () => {
        const xml = await load("free-form-gripper");
        const slow = (route) => setTimeout(() => route.continue().catch(() => {}), 250);
        await page.route("**/api/edit", slow);
        await drag(page, [-600, 0], [-660, 0]);
        await drag(page, [-660, 0], [-720, 0]);
        await page.waitForFunction(() => globalThis.flexwright.settled(false) && !Object.keys(globalThis.flexwright.state.set).length);
        assert.equal(await text(page), xml.replace('name="span" value="0.6 mm"', 'name="span" value="0.72 mm"'));
        await handle("device/mechanism/revolute[A]").focus();
        for (let i = 0; i < 3; i++) await page.keyboard.press("ArrowRight");
        await page.waitForFunction(() => globalThis.flexwright.settled(false) && !Object.keys(globalThis.flexwright.state.set).length);
        assert.equal(await text(page), xml.replace('name="span" value="0.6 mm"', 'name="span" value="0.705 mm"'));
        await page.unroute("**/api/edit", slow);
    });

    test("what is dragged is saved as it is shown, and goes on from there", async () => {
        const xml = await load("free-form-gripper");
        const span = (mm) => xml.replace('name="span" value="0.6 mm"', `name="span" value="${mm} mm"`);
        await drag(page, [-600, 0], [-700, 0], { release: false });
        await page.waitForFunction(() => /^700 um|^0.7 mm/.test(globalThis.flexwright.state.set.span ?? ""));
        const [saved] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Control+s")]);
        assert.equal(readFileSync(await saved.path(), "utf8"), span(0.7));
        assert.equal(await text(page), span(0.7));
        const [x, y] = await pixels(page, [-650, 0]);
        await page.mouse.move(x, y);
        await page.waitForFunction(() => globalThis.flexwright.state.set.span);
        const held = await page.evaluate(() => globalThis.flexwright.state.set.span);
        await changed(page, () => page.mouse.up());
        assert.equal(await text(page), span(Number(held.replace(" mm", ""))));
        for (let i = 0; i < 2; i++) await page.click("#undo");
        assert.equal(await text(page), xml);
    });

    test("a notice that comes meanwhile does not move what is dragged", async () => {
        const xml = await load("free-form-gripper");
        await drag(page, [-600, 0], [-700, 0], { release: false });
        await page.evaluate(() => {
            globalThis.strip = document.createElement("div");
            globalThis.strip.style.height = "50px";
            document.getElementById("notices").append(globalThis.strip);
        });
        const b = await page.evaluate(() => globalThis.flexwright.parts.draw.drag.at);
        const scale = await page.evaluate(() => globalThis.flexwright.parts.draw.view.k);
        await page.mouse.move(b[0] - 60 * scale, b[1]);
        await changed(page, () => page.mouse.up());
        await page.evaluate(() => globalThis.strip.remove());
        assert.equal(await text(page), xml.replace('name="span" value="0.6 mm"', 'name="span" value="0.66 mm"'));
        await page.click("#undo");
    });

    test("at the end of a parameter's range it stops; Escape gives up", async () => {
        const xml = await load("free-form-gripper");
        await drag(page, [-600, 0], [-1200, 0], { release: false });
        await page.waitForFunction(() => /^0.8 mm/.test(globalThis.flexwright.state.set.span ?? ""));
        await page.keyboard.press("Escape");
        await page.mouse.up();
        assert.equal(await text(page), xml);
        assert.deepEqual(await page.evaluate(() => globalThis.flexwright.state.set), {});
    });

    test("a formula is never overwritten without a word", async () => {
        const xml = await load("straight-stage");
        const id = "device/mechanism/revolute[A]";
        await drag(page, [0, 0], [0, 200]);
        const notice = page.locator('.notice:has-text("hinge A is held")');
        await notice.waitFor();
        assert.match(await notice.innerText(), /b-y of revolute A is -leg\/2/);
        assert.equal(await text(page), xml);
        await shot(page, "draw-held.png");
        await changed(page, () => notice.locator('button:has-text("Replace")').click());
        assert.equal(await text(page), xml.replace('<revolute id="A" a="ground" b="left" b-y="-leg/2" hinge="leaf"/>', '<revolute id="A" a="ground" b="left" b-y="-900 um" hinge="leaf" a-y="200 um"/>'));
        assert.deepEqual((await place(id)).map((v) => Number(v.toFixed(6))), [0, 200]);
        await page.click("#undo");
        assert.equal(await text(page), xml);
    });

    test("corners of outlines, with the pointer; arrow keys, removal and undo with the keyboard", async () => {
        const xml = await load("free-form-gripper");
        await click(page, [-680, 600]);
        const corner = "device/mechanism/body[left]/outline/line[1]"; // from (-100, 250) to (140, 250) in the jaw
        await handle(corner).waitFor();
        assert.deepEqual(await place(corner), [-460, 250]);
        await drag(page, [-460, 250], [-420, 250], { release: false });
        await page.waitForFunction(() => Object.keys(globalThis.flexwright.state.set).length > 0 && globalThis.flexwright.settled(false));
        // the held corner was judged: it is acute, and no mask of it can be made
        const errors = await page.evaluate(() => globalThis.flexwright.state.diagnostics.filter((d) => d.severity === "error").map((d) => [d.code, /left \(edge \d+\): width of 0 um at \((-4\d\d)/.exec(d.message)?.[1]]));
        assert.deepEqual(errors.map(([code]) => code), ["FW-D144", "FW-D144"]);
        assert.ok(errors.every(([, x]) => Math.abs(Number(x) + 420) <= 3), JSON.stringify(errors));
        assert.match(await page.evaluate(() => JSON.stringify(globalThis.flexwright.state.set)), /outline\/line\[1\]\/@to-x":"180 um"/);
        await changed(page, () => page.mouse.up());
        assert.equal(await text(page), xml.replace('<line to-x="140 um" to-y="250 um"/>', '<line to-x="180 um" to-y="250 um"/>'));
        await page.click("#undo");
        await handle("device/mechanism/revolute[A]").focus();
        await changed(page, () => page.keyboard.press("Shift+ArrowUp"));
        assert.match(await handle("device/mechanism/revolute[A]").getAttribute("aria-label"), /^hinge A, x \u2212600 µm, y 50 µm/);
        await page.click("#undo");
        assert.equal(await text(page), xml);
        await handle("device/mechanism/revolute[A]").focus();
        await changed(page, () => page.keyboard.press("Delete"));
        assert.ok(!(await text(page)).includes('<revolute id="A"'));
        await page.click("#undo");
        assert.equal(await text(page), xml);
        await page.selectOption('select[aria-label="Part"]', "device/mechanism/body[left]");
        await changed(page, () => page.click(".draw-remove"));
        assert.ok(!/ (on|a|b|id)="left"|bead-left|id="A"/.test(await text(page)), "what needed the body goes with it");
        await page.click("#undo");
        assert.equal(await text(page), xml);
    });
});

test("of another device nothing is chosen, though it has a part of the same name, and what could not be made is not told of it", async () => {
    const server = await serve(null);
    const page = await open(server);
    const begin = async (name) => {
        await page.click("#new");
        await page.click(`.template:has-text("${name}")`);
    };
    await begin("Six-bar");
    await view(page, "draw");
    await page.waitForSelector("#panel-draw .draw-handle");
    await page.locator('#panel-draw select[aria-label="Part"]').selectOption({ index: 3 });
    await page.waitForSelector("#panel-draw .draw-remove");
    const chosen = await page.evaluate(() => globalThis.flexwright.parts.draw.chosen);
    await begin("Four cables");
    await page.waitForFunction((id) => globalThis.flexwright.parts.draw.list.some((x) => x.id === id), chosen);
    assert.equal(await page.locator("#panel-draw .draw-remove").count(), 0);
    assert.deepEqual(await page.evaluate(() => [globalThis.flexwright.parts.draw.chosen, globalThis.flexwright.state.hinge]), [null, null]);
    await begin("One leaf");
    await setText(page, ['length="', 'length="9']); // as long as the frame
    await page.waitForSelector('#banner[data-verdict="failed"]');
    await setText(page, ["</mechanism>", "</mechanismx>"]);
    await page.waitForSelector(".card.problems:not([hidden])");
    await page.waitForFunction(() => globalThis.flexwright.settled(false));
    assert.match(await page.innerText("#old-note"), /The present one has none/, "picture and cards are grey, and nothing says why");
    await setText(page, ["</mechanismx>", "</mechanism>"]);
    await page.waitForSelector('#banner[data-verdict="failed"]');
    await page.evaluate(() => {
        const { editor } = globalThis.flexwright.parts;
        editor.replace(editor.text.replace('length="9', 'length="').replace(/<scene[^]*<\/scene>/, ""));
    });
    await page.waitForSelector(".card.problems:not([hidden])");
    await page.waitForFunction(() => globalThis.flexwright.settled(false));
    assert.doesNotMatch(await page.innerText("#banner"), /Cannot be made/);
    await close(page);
    await server.stop();
});

test("hinges of what nothing moves yet are drawn with their strips and round places, and a hinge is told where it bulges to", async () => {
    const server = await serve("leaf-four-bar");
    const page = await open(server);
    await page.evaluate(() => {
        const { editor } = globalThis.flexwright.parts;
        editor.replace(editor.text.replace(/<scene[^]*<\/scene>/g, "").replace(/<(require|probe)[^>]*\/>/g, "").replace(/<study[^]*<\/study>/g, ""));
    });
    await page.waitForSelector("#right .problems:has-text('Nothing moves it yet')");
    await view(page, "draw");
    await page.waitForFunction(() => !document.querySelector("#panel-draw .stage").classList.contains("sketch-only"));
    const [drawn, there] = await page.evaluate(() => [globalThis.flexwright.state.picture.flexures.filter((f) => f.path.length > 20).length, [...globalThis.flexwright.state.text.matchAll(/<revolute/g)].length]);
    assert.equal(drawn, there);
    assert.match(await page.innerText("#banner"), /nothing moves what is drawn/);
    const hinge = await page.evaluate(() => globalThis.flexwright.parts.draw.list.find((x) => x.element.name === "revolute" && !x.element.attributes.has("axis")).id);
    await page.locator('#panel-draw select[aria-label="Part"]').selectOption(hinge);
    const field = page.locator('#panel-draw input[aria-label="bulges to"]');
    assert.equal(await field.inputValue(), "");
    await changed(page, async () => {
        await field.fill("60");
        await field.press("Enter");
    });
    assert.match(await text(page), /axis="60 deg"/);
    await changed(page, async () => {
        await field.fill("");
        await field.press("Enter");
    });
    assert.doesNotMatch(await text(page), /axis="60 deg"/);
    await close(page);
    await server.stop();
});
