// SPDX-License-Identifier: GPL-3.0-or-later
// What a device is for, on the page: requirements with their values beside the verdict, one probe over time with its
// bounds beside the angles, or how fast it changes, where points go and how fast, what was left out. A device without
// probes has the points.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { tickWords } from "../../web/src/format.js";
import { requirementsOf } from "../../web/src/purpose.js";
import { answered, close, finish, open, program, serve, setText, SMALL, source, verdict } from "./helper.mjs";

after(finish);

const figure = (svg) => assert.equal(execFileSync(program, ["figure", "-", "-o", "-"], { input: svg }).subarray(0, 5).toString(), "%PDF-"); // for a paper

test("marks of an axis are told apart, whatever lies between them", () => {
    assert.deepEqual(tickWords([0, 5, null, 10]), ["0", "5", "", "10"]);
    assert.deepEqual(tickWords([100.001, 100.002, 100.003]), ["100.001", "100.002", "100.003"]);
    assert.deepEqual(tickWords([1.0001e-7, 1.0002e-7]), ["1.0001e\u22127", "1.0002e\u22127"]);
});

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
        await page.waitForFunction(() => globalThis.flexwright.parts.verdict.judged === null);
        const said = await page.locator(".purpose").innerText();
        for (const word of ["stroke (final, draw)", "at least 40 µm: accepted as drawn", "frequency-1", "at least 400 Hz"]) assert.ok(said.includes(word), `${word} in ${said}`);
        assert.match(said, /tension \(peak, draw\)\s+115 µN as drawn, at a first look/);
        assert.equal(await page.locator(".purpose dd.accept").count(), 0, "a first look accepts nothing, and nothing is green");
        assert.match(said, /tilt \(peak, draw\)\s+not known with hinges as pins/, "rounding noise is no result");
    });

    test("a requirement that is added takes the size of its probe, in a unit of it", async () => {
        const [added, peak] = await page.evaluate(() => {
            const { state, parts: { form } } = globalThis.flexwright;
            const { attributes } = form.adding(form.root, form.elements.find((row) => row.name === "require"))[0];
            return [attributes, Math.abs(state.preview.verdict.probes.find((x) => x.id === attributes.probe).peak)];
        });
        const [, size, unit] = /^([\d.]+) (\S+)$/.exec(added.max);
        assert.equal(unit, "um");
        assert.ok(size * 1e-6 > 1.3 * peak && size * 1e-6 < 1.7 * peak, `${added.max} of ${peak}`);
    });

    test("what only flexing hinges do is not drawn as a curve of a look with pins", async () => {
        const box = page.locator('.plots select[aria-label="What is plotted"]');
        for (const id of ["tilt", ":rate tilt"]) {
            await box.selectOption(id);
            await page.locator(".course-unknown", { hasText: "tilt is not known with hinges as pins" }).waitFor();
            assert.match(await page.evaluate(() => globalThis.flexwright.parts.motion.course.csv()), /^t_ms,tilt.*\n# tilt is not known.*\n$/);
        }
        await box.selectOption("stroke");
        assert.match(await page.locator(".plots .plot").last().locator(".plot-unit").innerText(), /µm, hinges as pins/);
    });

    test("as soon as the verdict is there, each number, band and decision of the card is the verdict's", async () => {
        await page.waitForFunction(() => globalThis.flexwright.parts.verdict.judged, null, { timeout: 60000 });
        const done = spawnSync(program, ["check", server.file, "--json"], { cwd: source, maxBuffer: 64 << 20 });
        const told = JSON.parse(done.stdout);
        const said = (await page.locator(".purpose").innerText()).replaceAll("\u2212", "-");
        const si = (x, unit) => {
            const [prefix, size] = [["k", 1e3], ["", 1], ["m", 1e-3], ["µ", 1e-6], ["n", 1e-9]].find(([, f]) => Math.abs(x) >= f * 0.9995);
            return `${Number((x / size).toPrecision(4))} ${prefix}${unit}`;
        };
        for (const r of told.requirements) {
            const made = r.as_fabricated;
            for (const x of [`${si(made.value, r.unit)} (${si(made.band[0], r.unit)} to ${si(made.band[1], r.unit)}) as made`, `to ${si(made.all_corners_band[1], r.unit)} over all corners`, `${si(r.value, r.unit)} (`]) assert.ok(said.includes(x), `${x} in ${said}`);
        }
        const tilt = told.probes.find((x) => x.id === "tilt");
        assert.ok(said.includes(si(tilt.peak, "rad")), `${tilt.peak} in ${said}`);
        assert.equal(await page.locator(".purpose dd.accept").count(), told.requirements.length);
    });

    test("a requirement that the worst device of the flow does not hold is undecided, not accepted as the drawing is", () => {
        const one = (drawn, made) => requirementsOf({ requirements: [{ verdict: drawn, value: 114.3, band: [102.4, 117.9], as_fabricated: made && { verdict: made, value: 83.8, band: [75.83, 86.25], all_corners_band: [75.83, 153.1], corner: "thickness 8.1 um" } }] }, made === null)[0];
        for (const [drawn, made, word] of [["accept", "accept", "accept"], ["accept", "reject", "inconclusive"], ["accept", "inconclusive", "inconclusive"], ["inconclusive", "accept", "inconclusive"], ["reject", "accept", "reject"]]) {
            assert.equal(one(drawn, made).decision, word, `${drawn}, ${made}`);
            assert.deepEqual([one(drawn, made).value, one(drawn, made).basis], [83.8, "as made"]);
        }
        assert.deepEqual([one("accept", null).value, one("accept", null).first], [114.3, true]);
    });

    test("a probe is plotted with its bounds, and another can be chosen", async () => {
        const shown = () => page.evaluate(() => {
            const { data } = globalThis.flexwright.parts.motion.course;
            return { name: data.series[0].name, most: Math.max(...data.series[0].values), marks: data.marks.map((x) => x.y) };
        });
        const first = await shown();
        assert.equal(first.name, "stroke");
        assert.deepEqual(first.marks.map((x) => Math.round(x * 1e3) / 1e3), [40]);
        assert.ok(first.most > 57 && first.most < 62);
        await page.locator('.plots select[aria-label="What is plotted"]').selectOption("tension");
        assert.equal((await shown()).name, "tension");
        assert.ok(Math.abs((await shown()).most - 115) < 0.01);
        if (process.env.FW_PICTURE) await page.screenshot({ path: join(process.env.FW_PICTURE, "probes.png") });
    });

    test("a plot names its values under the pointer, is zoomed with the others, and saved as numbers and as a picture", async () => {
        const box = page.locator(".plots .plot-box").first();
        const b = await box.boundingBox();
        const window = () => page.evaluate(() => [globalThis.flexwright.parts.motion.angles, globalThis.flexwright.parts.motion.course].map((p) => [p.plot.scales.x.min, p.plot.scales.x.max]));
        await page.mouse.move(b.x + b.width / 2, b.y + 60);
        const look = page.locator(".plot-look:visible");
        const said = await look.innerText();
        const t = Number(/^([\d.]+) ms/.exec(said)[1]);
        const told = await page.evaluate((at) => {
            const { data } = globalThis.flexwright.parts.motion.angles;
            const i = data.t.reduce((best, x, k) => (Math.abs(x - at) < Math.abs(data.t[best] - at) ? k : best), 0);
            return data.series.map((x) => [x.name, x.values[i]]);
        }, t);
        for (const [name, v] of told) assert.ok(said.includes(`${name} ${String(Number(v.toPrecision(4))).replace("-", "\u2212")}`), `${name} ${v} in ${said}`);
        const values = () => page.evaluate((at) => { // of the present answer, at the pointer that has not moved
            const { data } = globalThis.flexwright.parts.motion.angles;
            const i = data.t.reduce((best, x, k) => (Math.abs(x - at) < Math.abs(data.t[best] - at) ? k : best), 0);
            return data.series.map((x) => `${x.name} ${String(Number(x.values[i].toPrecision(4))).replace("-", "\u2212")}`);
        }, t);
        const [former] = await values();
        for (const [was, is] of [["115 uN", "90 uN"], ["90 uN", "115 uN"]]) {
            await answered(page, () => setText(page, [`value="${was}"`, `value="${is}"`]));
            await page.waitForTimeout(50);
            for (const x of await values()) assert.ok((await look.innerText()).includes(x), `${x} in ${await look.innerText()}`);
            assert.equal((await values())[0] === former, is === "115 uN");
        }
        const whole = (await window())[0];
        await page.mouse.wheel(0, -400);
        const [one, other] = await window();
        assert.ok(one[1] - one[0] < 0.7 * (whole[1] - whole[0]) && one[0] <= t && t <= one[1]);
        assert.deepEqual(other, one, "one time for all");
        if (process.env.FW_PICTURE) await page.screenshot({ path: join(process.env.FW_PICTURE, "plots.png") });
        await page.mouse.dblclick(b.x + b.width / 2, b.y + 60);
        assert.deepEqual((await window())[0], whole);
        const saved = async (what) => {
            await page.locator(".plots .plot:first-child .plot-menu > summary").click();
            const [file] = await Promise.all([page.waitForEvent("download"), page.locator(`.plots .plot:first-child button:has-text("${what}")`).click()]);
            return [file.suggestedFilename(), readFileSync(await file.path(), "utf8")];
        };
        const [name, csv] = await saved("Save as CSV");
        assert.equal(name, "straight-stage-share-of-the-limit.csv");
        const lines = csv.trim().split("\n");
        const data = await page.evaluate(() => globalThis.flexwright.parts.motion.angles.data);
        assert.equal(lines.length, 1 + data.t.length);
        assert.match(lines[0], /^t_ms,A \(%\),B \(%\)/);
        assert.deepEqual(lines.at(-1).split(",").map(Number), [data.t.at(-1), ...data.series.map((x) => x.values.at(-1))]);
        const [picture, svg] = await saved("Save as SVG");
        assert.equal(picture, "straight-stage-share-of-the-limit.svg");
        const drawn = await page.evaluate((x) => {
            const root = new DOMParser().parseFromString(x, "image/svg+xml").documentElement;
            return [root.tagName, root.querySelectorAll("g path").length, root.querySelectorAll("parsererror").length];
        }, svg);
        assert.deepEqual(drawn, ["svg", data.series.length + data.marks.length, 0]);
        figure(svg);
        await page.keyboard.press("Escape");
    });

    test("plots have the time of their scene when its length changes, zoomed or not", async () => {
        const ends = () => page.evaluate(() => ["angles", "energy", "course"].map((k) => globalThis.flexwright.parts.motion[k].plot.scales.x.max));
        for (const [was, is, zoomed] of [["40 ms", "60 ms", false], ["60 ms", "40 ms", true]]) {
            if (zoomed) await page.evaluate(() => globalThis.flexwright.parts.motion.angles.onwindow([50, 60]));
            await answered(page, () => setText(page, [`duration="${was}"`, `duration="${is}"`]));
            await page.waitForFunction(() => globalThis.flexwright.settled(false));
            await page.waitForTimeout(50);
            assert.deepEqual(await ends(), Array(3).fill(parseFloat(is)));
        }
    });

    test("paths of what moves are drawn where the motion takes it", async () => {
        await page.click('button:has-text("Paths")');
        const path = await page.locator("#panel-motion .paths path").nth(1).getAttribute("d"); // of the stage
        const ends = await page.evaluate(() => globalThis.flexwright.state.preview.motion.q.filter((r, i, all) => i === 0 || i === all.length - 1).map((r) => [r[3] * 1e6, r[4] * 1e6]));
        const points = path.slice(1).split("L").map((x) => x.split(" ").map(Number));
        [points[0], points.at(-1)].forEach((p, i) => p.forEach((v, k) => assert.ok(Math.abs(v - ends[i][k]) < 0.01)));
        await page.click('button:has-text("Paths")');
        assert.equal(await page.locator("#panel-motion .paths path").count(), 0);
    });

    test("what is not met is said, with its reason", async () => {
        await answered(page, () => setText(page, ['value="115 uN"', 'value="60 uN"']));
        await verdict(page, "reject");
        assert.match(await page.locator("#banner").innerText(), /stroke \(final\) is .*at least 40 um is required.*FW-D330/s);
        assert.match(await page.locator(".purpose").innerText(), /at least 40 µm: rejected/);
    });

    test("in a window of another size plots have its layout, their lower end is reached, and each menu opens where it is seen", async () => {
        for (const size of [SMALL, { width: 1240, height: 600 }, SMALL]) {
            await page.setViewportSize(size);
            await page.locator(".plots").evaluate((e) => e.parentElement.scrollTo(0, 1e4));
            const plots = page.locator(".plots > .plot:visible");
            assert.equal(await plots.count(), size.width > 1200 ? 3 : 2);
            for (const plot of await plots.all()) {
                await plot.locator("summary").click();
                await page.waitForFunction((e) => {
                    const seen = (x) => {
                        const r = x.getBoundingClientRect();
                        return x.contains(document.elementFromPoint(r.left + r.width / 2, r.top + r.height / 2));
                    };
                    const end = e.getBoundingClientRect().bottom;
                    return end <= document.querySelector("#centre").getBoundingClientRect().bottom && [...e.querySelectorAll(".plot-menu button")].every(seen);
                }, await plot.elementHandle());
                await page.keyboard.press("Escape");
            }
        }
    });

    test("velocities of probes and points are the program's, and what was left out has its bounds; each is saved", async () => {
        await page.setViewportSize(SMALL);
        // of the hinge that is looked at the heading tells what is plotted
        await page.evaluate(() => globalThis.flexwright.parts.motion.seek(0.02, true));
        const heading = () => page.locator(".plots .plot").first().locator(".plot-value").innerText();
        await page.locator('.bar[data-hinge="A"]').click();
        assert.match(await heading(), /^A: [\d.]+ %$/);
        await page.click('.plots button:has-text("degrees")');
        assert.match(await heading(), /^A: .?[\d.]+°$/);
        await page.click('.plots button:has-text("degrees")');
        await page.locator('.bar[data-hinge="A"]').click();
        const box = page.locator('.plots select[aria-label="What is plotted"]');
        const chosen = async (id, rates) => {
            await box.selectOption(id);
            if (rates) await page.waitForFunction(() => globalThis.flexwright.state.preview.motion.v && globalThis.flexwright.parts.motion.course.data.series.length > 0);
            return page.evaluate(() => {
                const { course } = globalThis.flexwright.parts.motion;
                const { motion, bodies } = globalThis.flexwright.state.preview;
                return { unit: course.unitWords, series: course.data.series, motion: { v: motion.v, probes: motion.probes }, stage: bodies.findIndex((b) => b.id === "stage"), words: course.words };
            });
        };
        const saved = async (what) => {
            await page.locator(".plots .plot:last-child .plot-menu > summary").click();
            const [file] = await Promise.all([page.waitForEvent("download"), page.locator(`.plots .plot:last-child button:has-text("${what}")`).click()]);
            return [file.suggestedFilename(), readFileSync(await file.path(), "utf8")];
        };
        const near = (a, b) => assert.ok(a.every((x, i) => Math.abs(x - b[i]) <= 1e-9 * Math.max(...b.map(Math.abs))));
        const rate = await chosen(":rate stroke", true);
        const size = { m: 1e-3, µ: 1e-6, n: 1e-9 }[rate.unit[0]];
        near(rate.series[0].values.map((x) => x * size), rate.motion.probes.find((x) => x.id === "stroke").rate);
        const [name, csv] = await saved("Save as CSV");
        assert.equal(name, "straight-stage-stroke-rate.csv");
        assert.match(csv.split("\n")[0], /^t_ms,"?stroke, rate \((m|µ|n)m\/s\)"?$/);
        const speed = await chosen(":speed", true);
        const own = speed.series.find((x) => x.name === "stage");
        near(own.values.map((x) => x * size), speed.motion.v.map((row) => Math.hypot(row[3 * speed.stage], row[3 * speed.stage + 1])));
        await chosen(":v stage", true);
        figure((await saved("Save as SVG"))[1]);
        await box.selectOption(":left");
        assert.ok(await page.evaluate(() => { // nobody has asked the first look for pins
            const { course } = globalThis.flexwright.parts.motion;
            return /nonlinear-hinge,0,.*this first look takes hinges as pins/.test(course.csv()) && !/asked for \(--hinge-model revolute\)/.test(course.csv() + document.querySelector(".ledger").textContent);
        }));
        const told = await page.locator(".leftout-row").evaluateAll((rows) => rows.map((r) => [r.querySelector(".leftout-name").textContent, r.classList.contains("active"), r.getAttribute("aria-label")]));
        const ledger = await page.evaluate(() => globalThis.flexwright.state.preview.ledger.filter((e) => e.called_for).map((e) => [e.id, e.active]));
        assert.deepEqual(told.map(([id, active]) => [id, active]).sort(), ledger.sort());
        assert.ok(told.every(([id, active, label]) => label.startsWith(`${id}: `) && label.endsWith(active ? ", computed" : ", left out")));
        assert.equal((await saved("Save as CSV"))[1].split("\n").length, ledger.length + 2);
        figure((await saved("Save as SVG"))[1]);
        if (process.env.FW_PICTURE) await page.screenshot({ path: join(process.env.FW_PICTURE, "left-out.png") });
        await box.selectOption("stroke");
    });

    test("without probes there is no card, and the points are plotted", async () => {
        const plain = await serve("leaf-four-bar");
        const other = await open(plain);
        assert.equal(await other.locator(".purpose:visible").count(), 0);
        assert.equal(await other.locator('.plots optgroup[label="Probes"]').count(), 0);
        assert.equal(await other.locator('.plots select[aria-label="What is plotted"]').inputValue(), ":way");
        await close(other);
        await plain.stop();
    });

    test("what moves is saved as a file that moves: whole, as it is seen, and the same bytes each time", async () => {
        await page.setViewportSize(SMALL);
        await page.selectOption('select[aria-label="Speed"]', "2");
        const film = async (kind) => {
            await page.click("#panel-motion .film-menu > summary");
            const [d] = await Promise.all([page.waitForEvent("download", { timeout: 60000 }), page.click(`#panel-motion .film-menu button:has-text("${kind}")`)]);
            return [d.suggestedFilename(), readFileSync(await d.path())];
        };
        const [name, first] = await film("Animated SVG");
        assert.equal(name, "straight-stage-draw.svg");
        figure(first);
        assert.deepEqual((await film("Animated SVG"))[1], first);
        const { seen, wanted, parts } = await page.evaluate((text) => {
            const root = new DOMParser().parseFromString(text, "image/svg+xml");
            const p = globalThis.flexwright.state.preview;
            const turns = [...root.querySelectorAll("animateTransform[type=translate]")].map((e) => e.getAttribute("values").split(";"));
            const at = (k, i) => (p.bodies[k].fixed ? 0 : p.motion.q[i][3 * k] * 1e6);
            const moves = p.bodies.map((b, k) => k).filter((k) => !p.bodies[k].fixed);
            return { // the last frame is the last sample, to what is drawn
                seen: turns.filter((v) => v.length === 50).map((v) => Number(v[49].split(" ")[0])), wanted: moves.map((k) => at(k, p.motion.q.length - 1)),
                parts: [root.querySelectorAll("parsererror").length, root.querySelectorAll("animate[attributeName=d]").length, root.documentElement.outerHTML.match(/https?:(?!\/\/www\.w3\.org)/g), root.querySelectorAll("script, style").length],
            };
        }, first.toString());
        for (const x of wanted) assert.ok(seen.some((v) => Math.abs(v - x) < 2e-3), `${x} in ${seen}`);
        assert.ok(parts[0] === 0 && parts[1] >= 4 && parts[2] === null && parts[3] === 0, JSON.stringify(parts));
        const [gif, bytes] = await film("GIF");
        assert.equal(gif, "straight-stage-draw.gif");
        const told = await page.evaluate(async (data) => {
            const decoder = new ImageDecoder({ type: "image/gif", data: Uint8Array.from(atob(data), (c) => c.charCodeAt(0)) });
            await decoder.tracks.ready;
            const { frameCount, repetitionCount } = decoder.tracks.selectedTrack;
            const { image } = await decoder.decode({ frameIndex: frameCount - 1 });
            const { svg } = globalThis.flexwright.parts.motion.mechanism;
            return { frameCount, repetitionCount, ms: image.duration / 1000, wide: image.displayWidth === svg.clientWidth };
        }, bytes.toString("base64"));
        assert.deepEqual(told, { frameCount: 50, repetitionCount: Infinity, ms: 40, wide: true });
        // of a text with a mistake there is no picture: what is saved of the former one says so
        await answered(page, () => setText(page, ['kind="leaf"', 'kind="leef"']));
        const [former, moving] = await film("Animated SVG");
        assert.equal(former, "straight-stage-draw-former-input.svg");
        assert.match(moving.toString(), /one second here is [^<]*, of a former input<\/text>/);
        await page.click("#panel-motion .plot-menu > summary >> nth=0");
        const [csv] = await Promise.all([page.waitForEvent("download"), page.click('#panel-motion .plot-menu[open] button:has-text("Save as CSV")')]);
        assert.match(csv.suggestedFilename(), /-former-input\.csv$/);
        assert.match(await page.evaluate(() => globalThis.flexwright.parts.motion.angles.svg()), /, of a former input<\/text>/);
        await answered(page, () => page.click("#undo"));
    });

    test("the documentation is part of the page, and its links lead to pages that are there", async () => {
        const get = async (path) => (await page.request.get(new URL(path, page.url()).href)).text();
        const seen = new Map();
        const wanted = ["/help/page.html"];
        while (wanted.length) {
            const path = wanted.pop();
            if (seen.has(path)) continue;
            const html = await get(path);
            assert.match(html, /<h1 id=/, path);
            assert.doesNotMatch(html, /<script|https?:\/\//, path);
            seen.set(path, new Set([...html.matchAll(/ id="([^"]*)"/g)].map((m) => m[1])));
            wanted.push(...[...html.matchAll(/href="(\/help\/[^"#]*\.html)/g)].map((m) => m[1]));
            for (const [, to, place] of html.matchAll(/href="(\/help\/[^"#]*)#([^"]*)"/g)) if (seen.has(to)) assert.ok(seen.get(to).has(place), `${path}: ${to}#${place}`);
        }
        assert.ok(seen.size >= 14, [...seen.keys()].join());
        assert.ok(seen.get("/help/reference-device.html").has("flexure"));
    });
});
