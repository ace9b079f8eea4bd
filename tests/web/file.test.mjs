// SPDX-License-Identifier: GPL-3.0-or-later
// The text and its file: mistakes, another editor, saving, a server that ends.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, statSync, unlinkSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { answered, close, finish, open, program, ready, serve, setText, text, verdict, view } from "./helper.mjs";

after(finish);

describe("text and file", () => {
    let server, page;
    before(async () => {
        server = await serve("copper-nodder");
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });

    test("a slider flips the verdict, and back", async () => {
        await verdict(page, "reject");
        const slider = page.locator('[data-parameter="push"]');
        await slider.focus();
        await page.keyboard.press("Home");
        await verdict(page, "accept");
        await page.waitForFunction(() => /name="push" value="1 uN"/.test(globalThis.flexwright.state.text));
        await page.keyboard.press("End");
        await verdict(page, "reject");
        const b = await slider.boundingBox(); // and held by the mouse: the answer comes before the text
        await page.mouse.move(b.x + b.width - 8, b.y + b.height / 2);
        await page.mouse.down();
        await page.mouse.move(b.x + 10, b.y + b.height / 2, { steps: 5 });
        await verdict(page, "accept");
        assert.match(await text(page), /name="push" value="50 uN"/);
        await page.mouse.up();
        await page.waitForFunction(() => !/name="push" value="50 uN"/.test(globalThis.flexwright.state.text));
        await page.click("#undo");
        await verdict(page, "reject");
        // away and back to where it was: a browser tells of no change, and nothing may stay held
        await page.mouse.move(b.x + b.width - 8, b.y + b.height / 2);
        await page.mouse.down();
        await page.mouse.move(b.x + 10, b.y + b.height / 2, { steps: 3 });
        await page.mouse.move(b.x + b.width - 8, b.y + b.height / 2, { steps: 3 });
        await page.mouse.up();
        await page.waitForFunction(() => Object.keys(globalThis.flexwright.state.set).length === 0);
        await verdict(page, "reject");
    });

    test("wrong text: a marker at its place, the last good answer stays, the fix is seen", async () => {
        const good = await text(page);
        await page.click("#tab-xml");
        await answered(page, () => setText(page, ['kind="leaf"', 'kind="leef"']));
        await page.waitForSelector(".problems li.error");
        assert.match(await page.textContent(".problems"), /leef|leaf/);
        await page.waitForSelector("#editor .cm-lint-marker-error");
        await page.waitForSelector("#editor .cm-lintRange-error");
        await page.waitForSelector("#banner.old");
        assert.ok(await page.isVisible("#old-note > div"), "the old verdict is not told to be old");
        const [note, decision] = await Promise.all(["#old-note > div", "#banner .decision"].map((q) => page.locator(q).boundingBox()));
        assert.ok(note.y + note.height <= decision.y, "the note lies over the decision");
        await page.click(".problems button.jump");
        const chosen = await page.evaluate(() => {
            const { state } = globalThis.flexwright.parts.editor.view;
            return state.sliceDoc(state.selection.main.from, state.selection.main.to);
        });
        assert.match(chosen, /leef/);
        await answered(page, () => page.keyboard.press("Control+z"));
        assert.equal(await text(page), good);
        await page.waitForSelector(".problems", { state: "hidden" });
        assert.ok(!(await page.isVisible("#old-note > div")));
        await answered(page, () => setText(page, ["</device>", "</devise>"]));
        await page.waitForSelector(".problems li.error");
        await page.waitForSelector('.slider[data-name="push"]', { state: "attached" }); // the form is still there
        await answered(page, () => page.evaluate(() => globalThis.flexwright.parts.editor.undo()));
        await page.waitForSelector(".problems", { state: "hidden" });
    });

    test("typing in the editor", async () => {
        await page.click("#tab-xml");
        const line = page.locator("#editor .cm-line", { hasText: 'name="push"' });
        await line.click({ position: { x: 4, y: 5 } });
        await page.keyboard.press("End");
        await answered(page, () => page.keyboard.type("<!-- typed -->"));
        assert.match(await text(page), /<!-- typed -->/);
        await answered(page, () => page.keyboard.press("Control+z"));
        assert.doesNotMatch(await text(page), /<!-- typed -->/);
    });

    test("text of a file is never markup", async () => {
        const good = await text(page);
        await page.click("#tab-form");
        await answered(page, () => setText(page, ['doc="amplitude of the force"', 'doc="&lt;img src=x onerror=alert(1)>&lt;script>globalThis.owned=1&lt;/script>"']));
        assert.match(await page.textContent('.slider[data-name="push"] .doc'), /^<img src=x/);
        assert.equal(await page.evaluate(() => [globalThis.owned, document.querySelectorAll("main img[src=x], main script").length].join()), ",0");
        await answered(page, () => page.evaluate(() => globalThis.flexwright.parts.editor.undo()));
        assert.equal(await text(page), good);
    });

    test("a file that another editor changes is followed", async () => {
        const now = readFileSync(server.file, "utf8").replace("A parallel", "Followed: a parallel").replace('name="push" value="30 uN"', 'name="push" value="12 uN"');
        if (await page.isEnabled("#save")) await page.click("#save");
        await page.waitForFunction(() => document.querySelector("#file-state").textContent === "device.xml");
        writeFileSync(server.file, now);
        await page.waitForFunction((t) => globalThis.flexwright.state.text === t, now);
        await verdict(page, "accept");
        assert.equal(await page.textContent("#file-state"), "device.xml");
    });

    test("saving writes the text and nothing else; a conflict is asked about", async () => {
        await answered(page, () => setText(page, ['value="12 uN"', 'value="13 uN"']));
        assert.match(await page.textContent("#file-state"), /changed/);
        await page.keyboard.press("Control+s");
        await page.waitForFunction(() => document.querySelector("#file-state").textContent === "device.xml");
        assert.equal(readFileSync(server.file, "utf8"), await text(page));
        await answered(page, () => setText(page, ['value="13 uN"', 'value="11 uN"']));
        const theirs = readFileSync(server.file, "utf8").replace("13 uN", "9 uN");
        writeFileSync(server.file, theirs);
        await page.click('button:has-text("Take the file\'s")');
        assert.equal(await text(page), theirs);
    });

    describe("what is typed in a field belongs to the input before it is in the text", () => {
        const field = () => page.locator('.slider[data-name="push"] input.value');
        const banner = (of) => page.waitForSelector(`#banner[data-of="${of}"]`);
        const onDisk = () => /name="push" value="([^"]*)"/.exec(readFileSync(server.file, "utf8"))[1];
        const asks = () => page.evaluate(() => !globalThis.dispatchEvent(new Event("beforeunload", { cancelable: true })));

        test("typed, it makes what is shown former at once, and leaving the page asks; Escape takes it back", async () => {
            await banner("present");
            assert.equal(await asks(), false);
            await field().fill("14 uN");
            assert.equal(await page.getAttribute("#banner", "data-of"), "former");
            await page.waitForSelector('#old-note > div:has-text("typed in a field")');
            assert.equal(await asks(), true);
            assert.match(await page.textContent("#file-state"), /changed/);
            await field().press("Escape");
            assert.equal(await page.getAttribute("#banner", "data-of"), "present");
            assert.equal(await asks(), false);
            await field().fill("14 uN"); // typed back to what the text says it is nothing
            await field().fill(onDisk());
            assert.equal(await page.getAttribute("#banner", "data-of"), "present");
        });

        test("Ctrl S and Save take it first, also while its edit is under way", async () => {
            await field().fill("14 uN");
            await page.keyboard.press("Control+s");
            await page.waitForFunction(() => document.querySelector("#file-state").textContent === "device.xml"); // a former "Saved" may stand there yet
            assert.equal(onDisk(), "14 uN");
            await page.evaluate(() => document.querySelectorAll(".notice").forEach((n) => n.classList.add("former")));
            await page.keyboard.press("Control+s");
            await page.waitForSelector('.notice:not(.former):has-text("Saved device.xml")');
            assert.equal(await page.locator('.notice:has-text("Saved device.xml")').count(), 1, "said once");
            let release;
            const gate = new Promise((resolve) => (release = resolve));
            await page.route("**/api/edit", async (r) => (await gate, r.continue()));
            await field().fill("13 uN");
            await field().press("Enter");
            await page.keyboard.press("Control+s");
            await page.waitForSelector("#banner.old"); // for as long as the edit takes
            assert.equal(await field().inputValue(), "13 uN");
            assert.equal(onDisk(), "14 uN");
            release();
            await page.waitForFunction(() => document.querySelector("#file-state").textContent === "device.xml");
            assert.equal(onDisk(), "13 uN");
            await page.unroute("**/api/edit");
            await field().fill("12 uN");
            await page.click("#save");
            await page.waitForFunction(() => document.querySelector("#file-state").textContent === "device.xml");
            assert.equal(onDisk(), "12 uN");
        });

        test("a plan that is begun from the field is of it", async () => {
            await field().fill("13 uN");
            const [request] = await Promise.all([page.waitForRequest((r) => r.url().endsWith("/api/jobs") && r.postDataJSON().kind === "plan"), page.click("#download")]);
            assert.match(request.postDataJSON().text, /name="push" value="13 uN"/);
            await page.click("dialog .cancel");
            await page.waitForSelector("dialog", { state: "detached" });
        });

        test("what the program cannot write is said, and nothing is saved; then the field says what the text says", async () => {
            await field().evaluate((f) => {
                f.focus();
                f.value = "1\u00012 uN";
                f.dispatchEvent(new Event("input"));
            });
            await page.keyboard.press("Control+s");
            await page.waitForSelector('.notice.bad:has-text("Not saved: what was entered is not taken")');
            assert.equal(onDisk(), "12 uN");
            assert.equal(await field().inputValue(), "13 uN");
            await page.keyboard.press("Control+s");
            await page.waitForFunction(() => document.querySelector("#file-state").textContent === "device.xml");
            assert.equal(onDisk(), "13 uN");
        });

        test("a slider that is held is saved as it is shown, and goes on from there", async () => {
            const slider = page.locator('[data-parameter="push"]');
            let b;
            const to = (share) => page.mouse.move(b.x + b.width * share, b.y + b.height / 2, { steps: 4 });
            const press = async (share) => { // what is said of its values moves it
                b = await slider.boundingBox();
                await to(share);
                await page.mouse.down();
            };
            const ready = () => page.waitForFunction(() => document.querySelector("#file-state").textContent === "device.xml");
            const before = onDisk();
            await press(0.2);
            await to(0.6);
            const held = await field().inputValue();
            assert.notEqual(held, before);
            assert.match(await page.textContent("#file-state"), /changed/);
            assert.equal(await asks(), true);
            await page.keyboard.press("Control+s");
            await ready();
            assert.equal(onDisk(), held); // and it is pressed still
            assert.equal(await field().inputValue(), held);
            await to(0.8);
            const later = await field().inputValue();
            assert.notEqual(later, held);
            assert.match(await page.textContent("#file-state"), /changed/);
            await page.mouse.up();
            await page.waitForFunction((v) => globalThis.flexwright.state.text.includes(`name="push" value="${v}"`), later);
            // taken and taken back while it is held: letting go writes nothing
            await press(0.8);
            await to(0.5);
            await page.keyboard.press("Control+s");
            await ready();
            await page.keyboard.press("Control+z");
            await page.waitForFunction((v) => globalThis.flexwright.state.text.includes(`name="push" value="${v}"`), later);
            await page.mouse.up();
            await banner("present");
            assert.match(await text(page), new RegExp(`name="push" value="${later}"`));
            // what the program refuses is not called saved
            const saved = onDisk();
            await page.route("**/api/edit", (r) => r.fulfill({ json: { status: "invalid", diagnostics: [{ message: "no such parameter" }] } }));
            await press(0.8);
            await to(0.3);
            await page.keyboard.press("Control+s");
            await page.waitForSelector('.notice.bad:has-text("Not saved: what was entered is not taken: no such parameter")');
            assert.equal(onDisk(), saved);
            await page.mouse.up();
            await page.unroute("**/api/edit");
            await page.waitForFunction(() => Object.keys(globalThis.flexwright.state.set).length === 0);
            for (const x of await page.$$(".notice.bad button, .notice.warn button")) await x.click();
            await field().fill("13 uN");
            await field().press("Enter");
            await page.waitForFunction(() => /name="push" value="13 uN"/.test(globalThis.flexwright.state.text));
            await banner("present");
        });
    });

    test("the server ends and is started anew: the text survives, the page goes on", async () => {
        page.expected = [/Failed to load resource/, /ERR_|EventSource/];
        await answered(page, () => setText(page, ['value="13 uN"', 'value="8 uN"']));
        const mine = await text(page);
        await server.halt();
        const field = page.locator('.slider[data-name="push"] input.value');
        await field.fill("7 uN"); // written into the text by the page itself
        await field.press("Enter");
        await page.waitForSelector('.notice.bad:has-text("does not answer")');
        await page.waitForSelector("#banner.old");
        assert.equal(await text(page), mine.replace("8 uN", "7 uN"));
        await page.focus('[data-parameter="push"]');
        await page.keyboard.press("ArrowRight");
        await page.waitForFunction(() => Object.keys(globalThis.flexwright.state.set).length === 0 && globalThis.flexwright.state.edits.length === 0);
        const slid = await field.inputValue();
        assert.notEqual(slid, "7 uN");
        assert.equal(await text(page), mine.replace("8 uN", slid));
        await field.fill("7 uN");
        const [kept] = await Promise.all([page.waitForEvent("download"), page.click('button:has-text("Save the text as a file")')]);
        assert.equal(readFileSync(await kept.path(), "utf8"), mine.replace("8 uN", "7 uN"));
        await page.locator("details.element > .element-body > .element-tools select.add").first().selectOption("scene");
        await page.waitForSelector('.notice:has-text("Not changed: the server does not answer")');
        assert.equal(await text(page), mine.replace("8 uN", "7 uN"));
        await server.restart();
        await page.waitForSelector('.notice.bad:has-text("session is over"), .notice.bad:has-text("open the address")');
        page.once("dialog", (d) => d.accept());
        await page.goto(server.url);
        await ready(page);
        await page.waitForSelector('.notice:has-text("were not saved are back")');
        assert.equal(await text(page), mine.replace("8 uN", "7 uN"));
        await verdict(page, "accept");
        page.expected = [];
    });
});

describe("nothing that somebody wrote is lost", () => {
    let server, page;
    before(async () => {
        server = await serve("straight-stage");
        page = await open(server);
    });
    after(async () => {
        await close(page);
        await server.stop();
    });
    const mine = (words) => page.evaluate((w) => globalThis.flexwright.parts.editor.replace(`${globalThis.flexwright.state.text}<!-- ${w} -->\n`), words);
    const saved = () => page.waitForFunction(() => document.querySelector("#file-state").textContent === "device.xml");

    test("while nobody has answered a conflict, Save writes nothing and shows both sides", async () => {
        await mine("mine");
        const [here, theirs] = [await text(page), `${readFileSync(server.file, "utf8")}<!-- theirs -->\n`];
        writeFileSync(server.file, theirs);
        await page.waitForSelector('button:has-text("Keep mine")');
        await page.keyboard.press("Control+s");
        await page.waitForSelector("dialog .diff");
        assert.match(await page.textContent("dialog .diff"), /<!-- mine -->.*<!-- theirs -->/s);
        assert.equal(readFileSync(server.file, "utf8"), theirs);
        await page.click('dialog button:has-text("Later")');
        assert.equal(await text(page), here);
        await page.keyboard.press("Control+s");
        await page.click("dialog .keep-mine");
        await page.waitForSelector("dialog", { state: "detached" });
        assert.equal(readFileSync(server.file, "utf8"), theirs);
        await page.keyboard.press("Control+s"); // now that it was said, mine is written
        await saved();
        assert.equal(readFileSync(server.file, "utf8"), here);
    });

    test("a saving that another one overtook shows both, too; taking the file's is one undo away", async () => {
        await mine("second");
        const here = await text(page);
        const theirs = readFileSync(server.file, "utf8").replace("<!-- mine -->", "<!-- other -->");
        page.expected = [/409/];
        await page.route("**/api/file", async (r) => { // just before it arrives
            if (r.request().method() === "POST") writeFileSync(server.file, theirs);
            await r.continue();
        });
        await page.keyboard.press("Control+s");
        await page.waitForSelector("dialog .diff");
        await page.unroute("**/api/file");
        await page.click("dialog .take-theirs");
        assert.equal(await text(page), theirs);
        await page.evaluate(() => globalThis.flexwright.parts.editor.undo());
        assert.equal(await text(page), here);
        await page.evaluate(() => globalThis.flexwright.parts.editor.redo());
        page.expected = [];
    });

    test("line ends of the file stay, whatever is edited", async () => {
        const crlf = readFileSync(server.file, "utf8").replaceAll("\n", "\r\n");
        writeFileSync(server.file, crlf);
        await page.waitForFunction(() => globalThis.flexwright.state.file.eol === "\r\n");
        await answered(page, () => mine("and more"));
        await page.keyboard.press("Control+s");
        await saved();
        assert.equal(readFileSync(server.file, "utf8"), `${crlf}<!-- and more -->\r\n`);
    });

    test("a file that is deleted is told, its text stays, and Save writes it anew; what cannot be read is not replaced", async () => {
        page.expected = [/404|500/];
        unlinkSync(server.file);
        await page.waitForSelector('.notice:has-text("cannot be read: No such file")');
        assert.match(await page.textContent("#file-state"), /not on disk/);
        await page.click("#save");
        await saved();
        assert.ok(readFileSync(server.file, "utf8").length > 100);
        writeFileSync(server.file, "x".repeat(2 << 20));
        await page.waitForSelector('.notice:has-text("is larger than")');
        await page.click("#save");
        await page.waitForSelector('.notice.bad:has-text("Not saved")');
        assert.equal(statSync(server.file).size, 2 << 20);
        unlinkSync(server.file);
        await page.click("#save");
        await saved();
        page.expected = [];
    });

    test("what was not saved outlives the page and the server, on another port, too", async () => {
        await mine("of yesterday");
        const here = await text(page);
        await page.waitForResponse((r) => r.url().endsWith("/api/draft") && r.request().method() === "POST");
        await page.context().close();
        await server.halt();
        await server.restart(0);
        page = await open(server);
        await page.waitForSelector('.notice:has-text("were not saved are back")');
        assert.equal(await text(page), here);
        await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 600)));
        await page.context().close(); // and where the file has changed meanwhile, both are shown
        await server.halt();
        const theirs = `${readFileSync(server.file, "utf8")}<!-- of this morning -->\r\n`;
        writeFileSync(server.file, theirs);
        await server.restart(0);
        page = await open(server);
        await page.click('.notice button:has-text("Show both")');
        assert.match(await page.textContent("dialog .diff"), /of yesterday.*of this morning/s);
        await page.click("dialog .take-theirs");
        assert.equal(await text(page), theirs.replaceAll("\r\n", "\n"));
    });
});

test("without a file: what is not saved survives a reload, and opening another text asks", async () => {
    const server = await serve(null);
    const page = await open(server);
    const begun = await text(page);
    const changed = `${begun}<!-- mine -->\n`;
    await page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), changed);
    page.on("dialog", (d) => d.accept());
    await page.reload();
    await ready(page);
    const back = page.locator('.notice:has-text("were not saved are back")');
    await back.waitFor();
    assert.equal(await text(page), changed);
    await Promise.all([page.waitForEvent("download"), page.click("#save")]);
    assert.equal(await back.count(), 0); // nothing is left to be answered
    const again = `${changed} `; // there is something to lose once more
    await page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), again);
    const pick = async () => {
        const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#open")]);
        await chooser.setFiles({ name: "other.xml", mimeType: "application/xml", buffer: Buffer.from(begun.replace("name=", "\r\nname=")) });
    };
    await pick();
    await page.click("dialog .dialog-foot .cancel");
    assert.equal(await text(page), again);
    await pick();
    await page.click("dialog .drop");
    assert.equal(await text(page), begun.replace("name=", "\nname="));
    await close(page);
    await server.stop();
});

test("without a file: what was downloaded, or begun from New…, is there after a reload, and it is said what it is", async () => {
    const server = await serve(null);
    const page = await open(server);
    page.on("dialog", (d) => d.accept());
    const begin = async (name) => {
        await page.click("#new");
        await page.click(`.template:has-text("${name}")`);
    };
    const reload = async () => {
        await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 600))); // the server has it, too
        await page.reload();
        await ready(page);
    };
    await begin("One leaf");
    const begun = await text(page);
    await reload();
    await page.waitForSelector('.notice:has-text("The text is back that was opened last")');
    assert.equal(await text(page), begun);
    const mine = begun.replace(/name="[^"]*"/, 'name="mine"');
    await page.evaluate((t) => globalThis.flexwright.parts.editor.replace(t), mine);
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
    assert.equal(saved.suggestedFilename(), "mine.xml");
    assert.equal(await page.textContent("#file-state"), "downloaded, not a file");
    await reload();
    await page.waitForSelector('.notice:has-text("The text is back that was downloaded last")');
    assert.equal(await text(page), mine);
    assert.equal(await page.textContent("#file-state"), "downloaded, not a file");
    await page.context().close(); // and on another page of a server that is started anew
    await server.halt();
    await server.restart(0);
    const later = await open(server);
    await later.waitForSelector('.notice:has-text("The text is back that was downloaded last")');
    assert.equal(await text(later), mine);
    await later.click('.notice button:has-text("Begin anew instead")');
    assert.equal(await text(later), execFileSync(program, ["init"]).toString());
    await close(later);
    await server.stop();
});

test("without a file: the starter of `flexwright init`, judged, to be changed and downloaded", async () => {
    const server = await serve(null);
    const page = await open(server);
    assert.equal(await text(page), execFileSync(program, ["init"]).toString());
    await verdict(page, "accept");
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
    assert.equal(saved.suggestedFilename(), "my-device.xml");
    await close(page);
    await server.stop();
});
