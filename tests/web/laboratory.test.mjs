// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of the laboratory: entered where a recipe cannot be computed, they are a pack, as `--lab` takes it, and all that
// is shown is then what the commands say with it; a pack is opened, refused in the program's words, and made of coupons.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { axeSource, close, computed, finish, open, program, ready, serve, setText, source, verdict, view } from "./helper.mjs";

after(finish);

const FLOW = "al-masked-rie";
const COUPONS = `coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit
cd-lines,line,10,7.9,0.2,um,,,
cd-lines,space,10,12.05,0.2,um,,,
undercut-ladder,width,16,13.10,0.08,um,50.5,0.3,um
undercut-ladder,width,20,17.06,0.08,um,50.5,0.3,um
`;

describe("numbers of the laboratory", () => {
    let server, page, pack;
    before(async () => {
        server = await serve("leaf-four-bar");
        page = await open(server);
        await view(page, "recipe");
        await computed(page, "recipe", 60000);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });
    const row = (id) => page.locator(`.lab-table tr[data-id="${id}"]`);
    const said = () => page.textContent(".laboratory > .doc[role=status]");
    const anew = async (act) => {
        const before = await page.evaluate(() => globalThis.flexwright.parts.recipe.done?.id);
        await act();
        await page.waitForFunction((id) => globalThis.flexwright.parts.recipe.done?.id !== id && globalThis.flexwright.parts.recipe.body.dataset.of === "present", before, { timeout: 60000 });
    };
    const recipe = () => page.evaluate((f) => (globalThis.flexwright.parts.recipe.recipes ?? []).find((r) => r.flow === f), FLOW);
    const missing = async () => (await recipe()).steps.flatMap((s) => s.not_computable);

    test("every number that is missing has a row with its unit", async () => {
        const ids = (await missing()).map((x) => /\(([^()]+)\)$/.exec(x)[1]);
        assert.ok(ids.length >= 3, ids.join());
        for (const id of ids) assert.equal(await row(id).count(), 1, id);
        assert.match(await row("al.R").textContent(), /sputter rate.*needed for S03.*nm\/min/);
        assert.ok(await page.evaluate(() => document.querySelector("details.laboratory").open));
    });

    test("what is no number is not taken", async () => {
        await row("al.R").locator("input").first().fill("fast");
        await page.click("#lab-use");
        assert.match(await page.textContent(".laboratory .messages"), /al\.R: a number is needed, not "fast"/);
        await row("al.R").locator("input").first().fill("38.5");
        await page.click("#lab-save"); // the program would refuse the pack
        assert.match(await page.textContent(".laboratory .messages"), /al\.R: its standard uncertainty is needed, too/);
        await page.click("#lab-use");
        assert.match(await page.textContent(".laboratory .messages"), /al\.R: its standard uncertainty is needed, too/);
        assert.deepEqual(await page.evaluate(() => globalThis.flexwright.state.lab), {});
        assert.match(await said(), /^None are in use\. Entered and not used yet: al\.R\./);
        assert.equal(await row("al.R").locator(".lab-used").textContent(), "nothing of yours; what is entered is not used yet");
    });

    test("the as-run log is the command's, from its first entry on, and its coupons become a pack", async () => {
        const log = `${server.directory}/lot7.log`;
        const fill = (label, value) => page.locator(`.log-form label:has(> span:text-is("${label}")) input`).fill(value);
        const measure = (name, value) => page.fill(`.log-form [data-kind="measure"][data-name="${name}"]`, value);
        const read = (n) => page.waitForFunction((k) => globalThis.flexwright.parts.recipe.asRun.told?.entries === k && !globalThis.flexwright.parts.recipe.asRun.control, n, { timeout: 60000 });
        const told = () => JSON.parse(execFileSync(program, ["log", server.file, "--flow", FLOW, "--run", log, "--json"], { cwd: source, stdio: ["ignore", "pipe", "ignore"] }));
        await page.evaluate(() => (document.querySelector("details.as-run").open = true));
        await read(0);
        assert.match(await page.textContent(".as-run"), /thickness 48 to 52 um; up to 5 values/);
        await fill("file", "lot7.log"); // as the list names it
        await fill("wafers: how many, or their names with commas between", "2");
        await fill("begun", "2026-11-20T10:00");
        await fill("ended", "2026-11-20T09:00");
        await fill("by", "AB");
        await measure("thickness", "50.1 50.0 49.9 50.2 50.1");
        await page.click("#log-add");
        await page.waitForSelector('.as-run .messages:has-text("FW-D282")', { timeout: 60000 });
        assert.equal(existsSync(log), false, "a refused entry begins no log");
        await fill("ended", "2026-11-20T10:50");
        await page.click("#log-add");
        await read(1);
        assert.match(await page.textContent(".as-run .messages"), /does not give 'cracks or chipped edge'/); // what a colleague would ask stays
        assert.match(await page.textContent(".log-deviations"), /S01: duration is 50 min, planned 16 min/);
        // the terminal goes on with it, and the page after it
        execFileSync(program, ["log", server.file, "--flow", FLOW, "--run", log, "-q", "--entry", "S02; start=2026-11-20T11:00; end=2026-11-20T11:35; by=CD; particles in bright light=0"], { cwd: source, stdio: "ignore" });
        for (const times of ["start=2026-11-20T12:00; end=2026-11-20T13:00", "start=2026-11-20T13:10; end=2026-11-20T13:50"]) // an etch that was interrupted
            execFileSync(program, ["log", server.file, "--flow", FLOW, "--run", log, "-q", "--entry", `S18; ${times}; by=CD; second=AB`, "--wafer", "1"], { cwd: source, stdio: "ignore" });
        await page.selectOption('.log-form select[aria-label="Step"]', "S18");
        await page.selectOption('.log-form select[aria-label="Wafer"]', "2");
        await fill("begun", "2026-11-21T10:00");
        await fill("ended", "2026-11-21T12:05");
        await page.evaluate(() => document.querySelectorAll(".log-form details").forEach((e) => (e.open = true)));
        await page.click("#help"); // each field has its sentence, and what has a unit says it
        const helped = await page.evaluate(() => [[...document.querySelectorAll(".log-form :is(input, select, textarea)")].filter((e) => e.offsetParent).length,
            Object.fromEntries([...document.querySelectorAll(".help-list dt")].map((e) => [e.innerText, e.nextElementSibling.innerText]))]);
        for (const name of ["begun", "ended", "by", "machine", "bath", "measured with", "note", "power"]) assert.ok(helped[1][name], `${name} in ${JSON.stringify(helped)}`);
        assert.match(helped[1].power, /planned .* W/);
        assert.ok(Object.keys(helped[1]).length >= helped[0], JSON.stringify(helped));
        await page.keyboard.press("Escape");
        await page.fill('.log-form [data-kind="set"][data-name="power"]', "251");
        await page.fill(".log-form textarea", [16, 20].map((w) => `undercut-ladder, feature=width, drawn=${w} um, value=${w - 2.9} um, u=0.08 um, at=50.5 um`).join("\n"));
        await page.click("#log-add");
        await read(5);
        assert.match(await page.textContent(".as-run"), /40 min; 2 runs, 1(00 min| h 40 min)/);
        // a wafer that is lost is an entry of its own, and the page and the command say so
        await page.selectOption('.log-form select[aria-label="Step"]', "S18");
        await page.selectOption('.log-form select[aria-label="What became of the wafer"]', "scrapped", { force: true });
        await fill("ended", "2026-11-21T12:10");
        await page.evaluate(() => document.querySelectorAll(".log-form details").forEach((e) => (e.open = true)));
        await page.click("#log-add");
        await page.waitForSelector('.as-run .messages:has-text("Say of which wafer, and why")');
        await page.selectOption('.log-form select[aria-label="Wafer"]', "2");
        await fill("why", "cracked in the chuck");
        await fill("by", "AB");
        await page.click("#log-add");
        await read(6);
        assert.match(await page.textContent(".log-fates"), /wafer 2: scrapped at S18, 2026-11-21T12:10: cracked in the chuck/);
        assert.deepEqual(await page.evaluate(() => globalThis.flexwright.parts.recipe.asRun.told), told());
        assert.match(readFileSync(log, "utf8"), /step=S18.*by=AB.*wafer=2.*set power=251 W/);
        await page.click("#log-fit");
        await page.waitForFunction((f) => globalThis.flexwright.state.lab[`calibrated-${f}.xml`], FLOW, { timeout: 60000 });
        execFileSync(program, ["calibrate", log, "--flow", FLOW, "-o", `${server.directory}/of-log.xml`, "-q"], { cwd: source });
        assert.equal(await page.evaluate((f) => globalThis.flexwright.state.lab[`calibrated-${f}.xml`], FLOW), readFileSync(`${server.directory}/of-log.xml`, "utf8"));
        await page.waitForFunction(() => /its plan is the one without them/.test(document.querySelector(".as-run").textContent), null, { timeout: 60000 });
        assert.equal(await page.evaluate(() => globalThis.flexwright.parts.recipe.asRun.told.entries), 6);
        await page.evaluate(() => (document.querySelector("details.as-run").open = false));
        await page.click("#lab-clear");
    });

    test("entered, they are a pack: the recipe is that of the command with --lab, the verdict says so", async () => {
        for (const [id, value, u] of [["al.R", "38.5", "1.5"], ["al.power", "200", "2"], ["expose.D", "210", "10"], ["resist.type", "AZ 5214E <new>", null]]) {
            await row(id).locator("input").nth(0).fill(value);
            if (u !== null) await row(id).locator("input").nth(1).fill(u);
        }
        // which resist is a word: it has no uncertainty and no unit
        assert.deepEqual([await row("resist.type").locator("input").count(), await row("resist.type").locator("td").nth(2).textContent()], [1, "a word"]);
        await page.fill(".lab-source", "our notebook <7>");
        await anew(() => page.click("#lab-use"));
        const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#lab-save")]);
        assert.equal(saved.suggestedFilename(), `laboratory-${FLOW}.xml`);
        pack = `${server.directory}/lab.xml`;
        writeFileSync(pack, readFileSync(await saved.path()));
        const told = JSON.parse(execFileSync(program, ["recipe", server.file, "--json", "--flow", FLOW, "--lab", pack, "--advice", "none", "-o", `${server.directory}/out`], { cwd: source, stdio: ["ignore", "pipe", "ignore"] }));
        const mine = await recipe();
        assert.deepEqual(mine.steps.map((s) => [s.id, s.time_s, s.not_computable]), told.steps.map((s) => [s.id, s.time_s, s.not_computable]));
        assert.equal(mine.total_s, told.total_s);
        assert.ok(mine.steps.find((s) => s.id === "S03").time_s !== null);
        assert.ok(mine.steps.some((s) => s.quantities.some((q) => q.word === "AZ 5214E <new>" && q.value === null && q.status === "stated")));
        assert.equal(await row("resist.type").locator(".lab-used").textContent(), "AZ 5214E <new>");
        await page.waitForFunction(() => /with your laboratory's numbers/.test(document.querySelector(".as-drawn").textContent));
    });

    test("what is saved is what the table shows, and nothing that the command line would refuse", async () => {
        const value = row("al.R").locator("input").first();
        await value.fill("41.5");
        const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#lab-save")]);
        assert.match(readFileSync(await saved.path(), "utf8"), /<q id="al\.R" value="41\.5" u="1\.5"/);
        assert.match(await page.evaluate((f) => globalThis.flexwright.state.lab[`entered-${f}.xml`], FLOW), /value="41\.5"/);
        let downloads = 0;
        page.on("download", () => downloads++);
        await value.fill("-20");
        await page.click("#lab-save");
        await page.locator(".laboratory .messages li", { hasText: "Not saved: entered-" }).waitFor();
        assert.match(await page.textContent(".laboratory .messages"), /FW-D278/);
        assert.equal(downloads, 0);
        await value.fill("38.5");
        await page.click("#lab-use");
        await page.waitForFunction(() => globalThis.flexwright.parts.recipe.body.dataset.of === "present", null, { timeout: 60000 });
    });

    test("beside the table stands what is in use, and what is entered and not used yet", async () => {
        const used = () => row("al.R").locator(".lab-used").textContent();
        assert.match(await row("al.R").textContent(), /^sputter rate.*al\.R/); // as before it was used
        assert.equal(await said(), `In use: entered-${FLOW}.xml (4 numbers).`);
        assert.equal(await used(), "38.5 ± 1.5");
        await row("al.R").locator("input").first().fill("60");
        assert.equal(await used(), "38.5 ± 1.5; what is entered is not used yet");
        assert.match(await said(), /\(4 numbers\)\. Entered and not used yet: al\.R\./);
        await row("al.R").locator("input").first().fill("6o");
        await page.click("#lab-use");
        assert.match(await said(), /^In use: .*\(4 numbers\)\. Entered and not used yet: al\.R\./); // the former ones
        await row("al.R").locator("input").first().fill("38.5");
        assert.equal(await used(), "38.5 ± 1.5");
    });

    test("the live verdict and what is explored are of the pack, too", async () => {
        const text = readFileSync(pack, "utf8").replace("</process>", '  <q id="si.d" value="44" u="0.2" unit="um" status="measured" src="laboratory"/>\n</process>');
        // a device that takes the thickness from its flow
        const change = [' thickness="50 um"', ""];
        const plain = `${server.directory}/plain.xml`;
        writeFileSync(plain, readFileSync(server.file, "utf8").replace(...change));
        await anew(() => setText(page, change));
        const before = await page.evaluate(() => globalThis.flexwright.state.preview.verdict.hinges.map((x) => x.utilisation));
        const thick = `${server.directory}/thick.xml`;
        writeFileSync(thick, text);
        await page.locator('.laboratory input[type="file"]').first().setInputFiles(thick);
        await page.waitForFunction(() => globalThis.flexwright.state.lab["thick.xml"] && globalThis.flexwright.parts.recipe.body.dataset.of === "present", null, { timeout: 60000 });
        await page.click("#lab-clear");
        await page.locator('.laboratory input[type="file"]').first().setInputFiles(thick);
        await page.waitForFunction(() => Object.keys(globalThis.flexwright.state.lab).join() === "thick.xml");
        await page.waitForFunction(() => document.querySelector(".banner").dataset.of === "present" && /with your laboratory's numbers/.test(document.querySelector(".as-drawn").textContent), null, { timeout: 60000 });
        const first = await page.evaluate(() => globalThis.flexwright.state.preview.verdict.hinges.map((x) => [x.id, x.utilisation]));
        const told = JSON.parse(spawnSync(program, ["check", plain, "--lab", thick, "--corners", "none", "--hinge-model", "revolute", "--json"], { cwd: source }).stdout);
        assert.deepEqual(first, told.hinges.map((x) => [x.id, x.utilisation]));
        assert.notDeepEqual(first.map((x) => x[1]), before);
        await view(page, "explore");
        await page.waitForFunction(() => globalThis.flexwright.parts.explore.done.has(8) && globalThis.flexwright.parts.explore.body.dataset.of === "present", null, { timeout: 60000 });
        assert.equal(await page.evaluate(() => globalThis.flexwright.parts.explore.done.get(8).value), told.governing.utilisation * 100);
        await view(page, "recipe");
        await page.evaluate(() => globalThis.flexwright.parts.editor.undo());
    });

    test("a pack that is wrong is refused in the words of the program, and left again", async () => {
        const wrong = `${server.directory}/wrong.xml`;
        writeFileSync(wrong, readFileSync(pack, "utf8").replace('id="al.R"', 'id="al.nobody"'));
        await page.click("#lab-clear");
        await page.locator('.laboratory input[type="file"]').first().setInputFiles(wrong);
        await page.waitForFunction(() => /wrong\.xml:\d+: .*al\.nobody.* \[FW-D\d+\]/.test(document.querySelector(".laboratory .messages").textContent), null, { timeout: 60000 });
        const told = spawnSync(program, ["check", server.file, "--lab", wrong], { cwd: source, encoding: "utf8" });
        assert.equal(told.status, 3);
        const message = await page.evaluate(() => globalThis.flexwright.state.diagnostics.find((d) => d.severity === "error").message);
        assert.ok(told.stderr.includes(message), message);
        assert.match(await said(), /^Nothing is computed with wrong\.xml \(4 numbers\): wrong\.xml is refused\./);
        await anew(() => page.click("#lab-clear"));
        await verdict(page, "accept");
        assert.ok((await missing()).length >= 3);
    });

    test("a reload keeps what is entered and in use", async () => {
        await anew(() => page.click("#lab-use"));
        await page.reload();
        await ready(page);
        assert.match(await page.evaluate(() => Object.values(globalThis.flexwright.state.lab)[0]), /al\.R" value="38.5" u="1.5" unit="nm\/min"/);
        await view(page, "recipe");
        await page.waitForFunction(() => globalThis.flexwright.parts.recipe.body.dataset.of === "present", null, { timeout: 60000 });
        assert.match(await row("al.R").textContent(), /^sputter rate.*al\.R/);
        assert.equal(await page.inputValue(".lab-source"), "our notebook <7>");
        await page.evaluate(() => (document.querySelector("details.laboratory").open = true));
        await page.click("#lab-use"); // and what is used anew is still from there
        assert.match(await page.evaluate(() => Object.values(globalThis.flexwright.state.lab)[0]), /<source [^>]*>our notebook &lt;7&gt;<\/source>/);
        assert.equal((await recipe()).steps.find((s) => s.id === "S03").not_computable.length, 0);
    });

    test("coupons that were measured become a pack by the command's fit; what it refuses is said", async () => {
        const csv = `${server.directory}/lot.csv`;
        writeFileSync(csv, "coupon,feature\nnobody,here\n");
        await page.evaluate(() => (document.querySelector("details.laboratory").open = true));
        await page.click("#lab-clear");
        await page.locator('.laboratory input[type="file"]').nth(1).setInputFiles(csv);
        await page.waitForFunction(() => /^lot\.csv:\d+/.test(document.querySelector(".laboratory .messages").textContent), null, { timeout: 60000 });
        writeFileSync(csv, COUPONS);
        await page.locator('.laboratory input[type="file"]').nth(1).setInputFiles(csv);
        await page.waitForFunction((f) => globalThis.flexwright.state.lab[`calibrated-${f}.xml`], FLOW, { timeout: 60000 });
        const own = `${server.directory}/own.xml`;
        writeFileSync(`${server.directory}/measured.csv`, COUPONS);
        execFileSync(program, ["calibrate", `${server.directory}/measured.csv`, "--flow", FLOW, "-o", own, "-q"], { cwd: source });
        assert.equal(await page.evaluate((f) => globalThis.flexwright.state.lab[`calibrated-${f}.xml`], FLOW), readFileSync(own, "utf8"));
        // with a pack of the laboratory it is found with that, as by --lab
        const thicker = `${server.directory}/thicker.xml`;
        writeFileSync(thicker, `<process xmlns="urn:flexwright:process:1" flow="${FLOW}"><source id="s" kind="measured">book</source><q id="al.d" value="1.2" u="0.03" unit="um" status="measured" src="s"/></process>`);
        await page.locator('.laboratory input[type="file"]').nth(0).setInputFiles(thicker);
        await page.waitForFunction(() => globalThis.flexwright.state.lab["thicker.xml"], null, { timeout: 60000 });
        await page.locator('.laboratory input[type="file"]').nth(1).setInputFiles(csv);
        await page.waitForFunction((f) => /for use with thicker\.xml/.test(globalThis.flexwright.state.lab[`calibrated-${f}.xml`]), FLOW, { timeout: 60000 });
        execFileSync(program, ["calibrate", `${server.directory}/measured.csv`, "--flow", FLOW, "--lab", thicker, "-o", own, "-q"], { cwd: source });
        assert.equal(await page.evaluate((f) => globalThis.flexwright.state.lab[`calibrated-${f}.xml`], FLOW), readFileSync(own, "utf8"));
    });

    test("no serious finding of axe", async () => {
        await page.evaluate(axeSource);
        const found = await page.evaluate(() => globalThis.axe.run("#panel-recipe", { resultTypes: ["violations"] }));
        assert.deepEqual(found.violations.filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => [v.id, v.nodes.map((n) => n.html)]), []);
    });
});

test("a mistake in the laboratory's numbers is said to be there, and not in the description", async () => {
    const server = await serve("leaf-four-bar");
    const page = await open(server);
    await page.evaluate(() => {
        const { state, parts } = globalThis.flexwright;
        state.lab["laboratory-al-masked-rie.xml"] = '<process xmlns="urn:flexwright:process:1" id="laboratory" version="1" title="numbers" flow="al-masked-rie"><q id="al.R" value="many" unit="nm/min" status="measured"/></process>';
        parts.editor.replace(`${parts.editor.text} `);
    });
    await page.waitForSelector(".card.problems:not([hidden]) h2");
    assert.match(await page.textContent(".card.problems h2"), /^\d+ mistakes? in the laboratory's numbers$/);
    await close(page);
    await server.stop();
});
