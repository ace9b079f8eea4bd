// SPDX-License-Identifier: GPL-3.0-or-later
// A server with a device in a directory of its own, a Chromium with one page of it, and a record of
// everything that must not happen: errors, requests to elsewhere, refused content.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { copyFileSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const [libraries, program, source] = ["FW_WEB_LIBRARIES", "FW_PROGRAM", "FW_SOURCE"].map((name) => {
    if (!process.env[name]) throw new Error(`${name} is not set: run tests/web/run.sh`);
    return process.env[name];
});
export { program, source };
/** All of what repeats, not its first part: ./test --all. */
export const ALL = Boolean(process.env.FW_TEST_ALL);
const require = createRequire(join(libraries, "package.json"));
const { chromium } = require("playwright-core");
export const axeSource = require("axe-core").source;

/** How long a page is waited for; a machine that much else keeps busy needs more (FW_PATIENCE_MS). */
const PATIENCE_MS = Number(process.env.FW_PATIENCE_MS ?? 15000);

let browser = null;
export async function theBrowser() {
    browser ??= await chromium.launch({ executablePath: process.env.FW_CHROMIUM, args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"] });
    return browser;
}
export const closeBrowser = () => browser?.close();

/** {url, port, file, directory, stop(), restart()}; device: a directory of docs/gallery, null: no file. */
const running = new Set(); // a test that fails leaves its own, and node would wait for it

export async function serve(device, { port = 0 } = {}) {
    const directory = mkdtempSync(join(tmpdir(), "flexwright-web-"));
    const file = join(directory, "device.xml");
    if (device) copyFileSync(join(source, "docs/gallery", device, "device.xml"), file);
    const server = { directory, file, foreign: [] };
    const start = (at) => new Promise((resolve, reject) => {
        const child = spawn(program, ["serve", ...(device ? [file] : []), "--no-browser", ...(at ? ["--port", String(at)] : [])], {
            cwd: source, stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, XDG_STATE_HOME: join(directory, "state") },
        });
        server.child = child;
        let said = "";
        child.stdout.on("data", (d) => {
            said += d;
            const m = /(http:\/\/127\.0\.0\.1:(\d+)\/\S*)\n/.exec(said);
            if (m) resolve(Object.assign(server, { url: m[1], port: Number(m[2]) }));
        });
        child.stderr.on("data", () => {});
        child.on("exit", (code) => reject(new Error(`the server ended with ${code}: ${said}`)));
    });
    server.halt = () => new Promise((resolve) => {
        server.child.on("exit", resolve);
        server.child.kill("SIGTERM");
    });
    server.restart = (at = server.port) => start(at);
    running.add(server);
    server.stop = async () => {
        running.delete(server);
        if (server.child.exitCode === null && server.child.signalCode === null) await server.halt();
        rmSync(directory, { recursive: true, force: true });
    };
    return start(port);
}

const wrongs = []; // what must not happen, of all pages

/** For who does not look at the page: fewer pixels are painted. */
export const SMALL = { width: 1000, height: 560 };

/** Opens the page of a server and waits for its first answer. */
export async function open(server, { width = 1440, height = 900, colorScheme = "light", before, ...more } = {}) {
    const context = await (await theBrowser()).newContext({ viewport: { width, height }, colorScheme, acceptDownloads: true, reducedMotion: "reduce", ...more });
    context.setDefaultTimeout(PATIENCE_MS);
    await context.addInitScript(() => {
        globalThis.refused = [];
        document.addEventListener("securitypolicyviolation", (e) => globalThis.refused.push(`${e.violatedDirective} ${e.blockedURI} ${e.sourceFile}:${e.lineNumber}`));
    });
    if (before) await context.addInitScript(before);
    const page = await context.newPage();
    // looked at twenty times a second and not at every frame, each of which would have to be drawn for it
    const wait = page.waitForFunction.bind(page);
    page.waitForFunction = (what, given, options = {}) => wait(what, given, { polling: 50, ...options });
    page.expected = []; // errors that a test provokes
    page.on("console", (m) => {
        if (["error", "warning"].includes(m.type()) && !page.expected.some((x) => x.test(m.text()))) wrongs.push(`console: ${m.text()} ${m.location().url}`);
    });
    page.on("pageerror", (e) => wrongs.push(`exception: ${e.stack}`));
    context.on("request", (r) => {
        const url = new URL(r.url());
        if (!["127.0.0.1"].includes(url.hostname) && !["blob:", "data:"].includes(url.protocol)) wrongs.push(`request to ${r.url()}`);
    });
    await page.goto(server.url);
    await ready(page);
    return page;
}

export const ready = (page) => page.waitForFunction(() => globalThis.flexwright?.state.preview && document.body.dataset.ready);

export async function close(page) {
    wrongs.push(...(await page.evaluate(() => globalThis.refused)).map((x) => `refused by the policy: ${x}`));
    await page.context().close();
}

/** At the end of a file of tests: the browser is closed, so are servers of tests that failed, and nothing was wrong meanwhile. */
export async function finish() {
    await closeBrowser();
    for (const server of running) await server.stop();
    assert.deepEqual(wrongs, [], "errors, refused content or requests to elsewhere");
}

/** A new answer of the server to what `act` does. */
export async function answered(page, act) {
    const before = await page.evaluate(() => {
        globalThis.answers ??= 0;
        if (!globalThis.counting) {
            globalThis.counting = true;
            globalThis.flexwright.on("answer", () => globalThis.answers++);
        }
        return globalThis.answers;
    });
    await act();
    await page.waitForFunction((n) => globalThis.answers > n, before, { timeout: 40000 }); // of a machine that others use, too
}

export const view = async (page, id) => {
    await page.click(`#tab-${id}`);
    await page.waitForSelector(`#panel-${id}:not([hidden])`);
};
/** The layout of a window that has another size now: what watches sizes is told before the next frame but one. */
export const laidOut = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(resolve, 0)))));

/** Serious findings of axe in `where` (a selector, null: the whole page), whose script the page has, each with the view's name. */
export async function serious(page, name, where, options = {}) {
    const result = await page.evaluate(([w, o]) => globalThis.axe.run(w ? { include: [w] } : document, { resultTypes: ["violations"], ...o }), [where, options]);
    return result.violations.filter((v) => ["serious", "critical"].includes(v.impact))
        .map((v) => `${name}: ${v.id}: ${v.nodes.slice(0, 3).map((n) => `${n.target} ${n.html.slice(0, 150)} ${n.any[0]?.message ?? ""}`).join("; ")}`);
}
export const text = (page) => page.evaluate(() => globalThis.flexwright.state.text);
export const setText = (page, change) => page.evaluate((c) => {
    const { editor } = globalThis.flexwright.parts;
    editor.replace(editor.text.replace(c[0], c[1]));
}, change);
export const verdict = (page, word) => page.waitForSelector(`#banner[data-verdict="${word}"]`);
export const computed = (page, id, timeout = PATIENCE_MS) => page.waitForFunction((p) => /^computed/.test(document.querySelector(`#panel-${p} .job-message`)?.textContent ?? ""), id, { timeout });
