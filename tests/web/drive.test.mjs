// SPDX-License-Identifier: GPL-3.0-or-later
// Random edits, held sliders, options and slow answers: after each all that is shown is what a fresh answer says of
// the text in the editor, and before that nothing of a former input looks current.
//
// FW_DRIVE_STEPS and FW_DRIVE_SEED: more steps on every device, another course; FW_DRIVE_WAIT_MS: how long a step may take to settle. `tests/web/run.sh PROGRAM BUILD
// drive.test.mjs` runs this alone; with FW_DRIVE_STEPS=1000 on six devices.
import { after, test } from "node:test";
import { actions, dice, step, watcher } from "./drive.mjs";
import { ALL, close, finish, open, serve, SMALL } from "./helper.mjs";

after(finish);

const STEPS = Number(process.env.FW_DRIVE_STEPS ?? 0);
const FEW = { "reference-six-bar": 24, "comb-stage": 12 }; // with all tests; a step of the comb takes twice the time
// where nobody asks for more: each kind of action once on the six-bar, and on the comb those that have answers of their own there,
// what takes back after what changes
const ONCE = {
    "reference-six-bar": Object.keys(actions),
    "comb-stage": ["text", "scene", "course", "hold", "undo"],
};
const SEED = Number(process.env.FW_DRIVE_SEED ?? 1);
const FIRST = ["reference-six-bar", "comb-stage"];
const MORE = ["leaf-four-bar", "free-form-four-bar", "straight-stage", "four-tendons"];

for (const device of STEPS ? [...FIRST, ...MORE] : FIRST)
    test(`${device}, driven at random`, { timeout: STEPS ? Infinity : 600000 }, async (t) => {
        const server = await serve(device);
        const page = await open(server, { ...SMALL, before: watcher });
        page.expected = [/Failed to load resource/]; // an option that a changed text does not know
        const d = dice(SEED);
        const done = {};
        let mend = false;
        const kinds = STEPS || ALL ? null : [...ONCE[device]];
        const most = STEPS || (kinds ? 2 * kinds.length : FEW[device]);
        try {
            for (let i = 0; i < most && kinds?.length !== 0; i++) {
                let told;
                try {
                    told = await step(page, server, d, kinds ? { kind: mend ? "undo" : kinds.shift() } : { mend });
                } catch (error) {
                    error.message = `step ${i + 1} of seed ${SEED}: ${error.message}`;
                    throw error;
                }
                mend = [null, "none", "ended", "failed"].includes(told[1]);
                for (const x of told) done[x] = (done[x] ?? 0) + 1;
            }
            t.diagnostic(`${JSON.stringify(done)}, ${await page.evaluate(() => globalThis.driven.frames)} frames looked at`);
        } finally {
            await close(page);
            await server.stop();
        }
    });
