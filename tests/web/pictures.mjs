// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of docs/page.md: tests/web/run.sh PROGRAM BUILD pictures.mjs, then in docs/pictures
//   pngquant --nofs --force --strip --speed 1 --ext .png 256 page-*.png
import { join } from "node:path";
import { answered, close, closeBrowser, computed, open, serve, setText, source, verdict, view } from "./helper.mjs";

const size = { width: 1440, height: 900 };
/** The decision as fabricated, asked for where it does not come by itself because the last one was slow. */
const made = async (page) => {
    const told = page.locator("#banner:has-text('as it will be made')");
    await told.waitFor({ timeout: 20000 }).catch(() => page.click('button:has-text("Judge as fabricated"):visible'));
    await told.waitFor({ timeout: 300000 });
    await page.waitForFunction(() => globalThis.flexwright.settled(true), null, { timeout: 300000 });
};
const save = (page, name) => page.screenshot({ path: join(source, "docs/pictures", name) });

const server = await serve("reference-six-bar");
const page = await open(server, size);
await made(page);
await page.waitForTimeout(300);
await save(page, "page-motion.png");

await page.emulateMedia({ colorScheme: "dark" });
await view(page, "workspace");
for (const [key, value] of [["x_m", 420], ["y_m", -150], ["phi_rad", -6]]) {
    await page.fill(`#pose-${key}`, String(value));
    await page.press(`#pose-${key}`, "Enter");
}
await page.waitForTimeout(600);
await save(page, "page-workspace.png");

await page.emulateMedia({ colorScheme: "light" });
await answered(page, () => setText(page, ['gap="8 um"/>', 'gap="2 um"/>']));
await verdict(page, "accept");
await view(page, "masks");
await computed(page, "masks");
await page.locator(".violation:has-text('space')").first().click();
await page.waitForTimeout(600);
await save(page, "page-masks.png");
await close(page);
await server.stop();

const tendons = await serve("four-tendons");
const moving = await open(tendons, size);
await made(moving);
await moving.waitForTimeout(300);
await save(moving, "page-cables.png");
await close(moving);
await tendons.stop();

const gripper = await serve("free-form-gripper");
const drawing = await open(gripper, size);
await verdict(drawing, "accept");
await made(drawing);
await view(drawing, "draw");
await drawing.selectOption('select[aria-label="Part"]', "device/mechanism/body[left]/outline start");
await drawing.waitForTimeout(300);
await save(drawing, "page-draw.png");
await close(drawing);
await gripper.stop();

const bar = await serve("leaf-four-bar");
const exploring = await open(bar, size);
await made(exploring);
await view(exploring, "explore");
await exploring.selectOption('select[aria-label="Vary"]', "scene[push]/force/@fx");
for (const [end, value] of [["from", "0.05 mN"], ["to", "2.5 mN"]]) {
    await exploring.fill(`[aria-label="First input, ${end}"]`, value);
    await exploring.press(`[aria-label="First input, ${end}"]`, "Tab");
}
await exploring.waitForFunction(() => globalThis.flexwright.parts.explore.whole, null, { timeout: 120000 });
await exploring.locator(".explore-plot").click({ position: { x: 300, y: 100 } });
await exploring.waitForTimeout(300);
await save(exploring, "page-explore.png");
await close(exploring);
await bar.stop();

const costs = await serve("reference-six-bar");
const accuracy = await open(costs, size);
await view(accuracy, "accuracy");
await accuracy.click('button:has-text("Measure the trade-off")');
await computed(accuracy, "accuracy", 240000);
await made(accuracy);
await accuracy.waitForTimeout(300);
await save(accuracy, "page-accuracy.png");
await close(accuracy);
await costs.stop();
await closeBrowser();
