// SPDX-License-Identifier: GPL-3.0-or-later
// What Explore tells between judged devices, without a page: no value is further off than is said of it, kinks, steps and other ways of a verdict
// are not told over, and what is noise is judged.
import assert from "node:assert/strict";
import { test } from "node:test";
import { nextOf, SHOWN, tell, tellMap } from "../../web/src/telling.js";

const PLACES = Array.from({ length: 201 }, (_, i) => i);
const EACH = 8;
const whole = (f) => (x) => ({ x, state: "accept", way: "a", value: f(x), low: f(x) - 1, high: f(x) + 1, used: 0.5, ...(f.more?.(x) ?? {}) });

const noise = (x) => (((Math.imul(x + 1, 2654435761) >>> 8) % 1000) / 1000 - 0.5) * 2; // from -1 to 1

/** Judged by turns until nothing is open, as the page does: {judged, told, turns}. */
function look(truth, height = 100, each = EACH) {
    const judged = new Set(PLACES.filter((x) => x % each === 0));
    for (let turns = 0; ; turns++) {
        const points = [...judged].sort((a, b) => a - b).map(truth);
        const { told, open } = tell(points, PLACES, height);
        for (const p of told) {
            const is = truth(p.x);
            assert.ok(!judged.has(p.x) && p.told);
            assert.equal(p.state, is.state, `at ${p.x}`);
            for (const f of SHOWN) assert.ok(Math.abs(p[f] - is[f]) <= p.off[f] && p.off[f] <= height / 250, `${f} at ${p.x}: ${p[f]} for ${is[f]}, off by ${p.off[f]}`);
        }
        if (!open.length) {
            assert.equal(told.length + judged.size, PLACES.length);
            return { judged: judged.size, told, turns };
        }
        for (const x of nextOf(open)) {
            assert.ok(!judged.has(x));
            judged.add(x);
        }
    }
}

test("what is smooth is told from the first judged devices, within what it is said to be off by", () => {
    for (const f of [(x) => 50, (x) => 20 + 0.3 * x, (x) => 90 - 60 / (1 + x / 60), (x) => 50 + 40 * Math.sin(x / 40)]) assert.deepEqual([look(whole(f)).judged, look(whole(f)).turns], [26, 0]);
});

test("a kink or a step is found by a few more, wherever it is, though no verdict speaks of it", () => {
    let most = 0;
    for (let at = 3; at < 200; at += 7.3)
        for (const f of [(x) => 50 + 0.4 * Math.abs(x - at), (x) => (x < at ? 40 : 42) + 0.1 * x, (x) => 30 + Math.max(0, x - at) ** 2 / 400]) most = Math.max(most, look(whole(f)).judged);
    assert.ok(most <= 45, String(most));
});

test("what governs changes, and so does the way: only that place is judged", () => {
    const smooth = (x) => 90 - 60 / (1 + x / 60), at = 101.5;
    const f = (x) => smooth(x) + (x < at ? 0 : 0.1); // a step that could not be seen
    f.more = (x) => ({ way: x < at ? "a" : "b" });
    const { judged, told } = look(whole(f));
    assert.ok(judged <= 30, String(judged));
    assert.ok(told.every((p) => p.x < 101 || p.x > 102) && told.some((p) => p.way === "a") && told.some((p) => p.way === "b"));
});

test("noise is told with what it does, or judged where that can be seen", () => {
    assert.ok(look(whole((x) => 50 + 0.01 * noise(x))).told.every((p) => p.off.value > 0.01));
    assert.equal(look(whole((x) => 50 + 2 * noise(x))).told.length, 0);
});

test("a decision is told where nothing comes near it, and a device that could not be judged is none to tell from", () => {
    const f = (x) => 20 + 0.4 * x;
    f.more = (x) => ({ used: f(x) / 100, state: f(x) < 100 ? "accept" : "reject", way: f(x) < 100 ? "a" : "b" });
    const { told } = look(whole(f), 100);
    assert.ok(told.every((p) => Math.abs(p.used - 1) > p.off.used));
    const near = (x) => 95;
    near.more = (x) => ({ used: 0.991 }); // too near its limit
    assert.equal(look(whole(near)).told.length, 0);
    const rejected = (x) => 50;
    rejected.more = (x) => ({ state: "reject", used: 1.3 + 0.2 * noise(x) }); // what decides is too rough to say that it stays above its limit
    assert.equal(look(whole(rejected)).told.length, 0);
    const holes = (x) => 50;
    holes.more = (x) => (x % 40 < 3 ? { state: "failed", way: null, value: NaN, low: NaN, high: NaN, used: null } : {});
    const points = PLACES.filter((x) => x % EACH === 0).map(whole(holes));
    for (const p of tell(points, PLACES, 100).told) assert.ok(p.x % 40 > 8);
});

test("one open place is judged at two of its thirds, several in their middles", () => {
    const one = { places: [1, 2, 3, 4, 5, 6, 7] }, other = { places: [9, 10] };
    assert.deepEqual([nextOf([one]), nextOf([one, other]), nextOf([{ places: [3] }]), nextOf([])], [[3, 5], [4, 10], [3], []]);
});

test("fewer than five alike tell nothing", () => {
    const points = [0, 50, 100, 150].map(whole((x) => 50));
    assert.deepEqual(tell(points, PLACES, 100).told, []);
    assert.equal(tell(points, PLACES, 100).open.length, 3);
});

test("a map is told between its judged cells, and not across an edge", () => {
    const of = (f, more) => (i, j) => ({ x: i, y: j, state: "accept", way: "a", value: f(i, j), low: NaN, high: NaN, used: 0.5, ...more?.(i, j) });
    const judged = (truth, each) => new Map(PLACES.slice(0, 33 / each + 1).flatMap((a) => PLACES.slice(0, 33 / each + 1).map((b) => [`${a * each} ${b * each}`, truth(a * each, b * each)])));
    const smooth = of((i, j) => 30 + 20 * Math.sin(i / 20) * Math.cos(j / 25) + 0.5 * j);
    const all = tellMap(judged(smooth, 4), 32, 80);
    assert.equal(all.length, 33 * 33 - 81);
    for (const p of all) assert.ok(Math.abs(p.value - smooth(p.i, p.j).value) <= p.off.value && p.off.value <= 80 / 250, JSON.stringify(p));
    // by rows, and then by columns from what was told by rows, with both errors
    for (const p of all.filter(({ i, j }) => i % 4 && j % 4)) assert.ok(p.off.value >= (2 * 80) / 2000, JSON.stringify(p));
    const parted = of((i, j) => (i + j < 33 ? 30 : 60) + i, (i, j) => (i + j < 33 ? {} : { way: "b", state: "reject", used: 1.4 }));
    const some = tellMap(judged(parted, 4), 32, 80);
    assert.ok(some.length > 300, String(some.length));
    for (const p of some) assert.deepEqual([Math.abs(p.value - parted(p.i, p.j).value) <= p.off.value, p.state], [true, parted(p.i, p.j).state], JSON.stringify(p));
});
