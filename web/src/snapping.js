// SPDX-License-Identifier: GPL-3.0-or-later
// Where a point comes to rest while it is drawn or dragged: on another point, in line with one, or on the grid.
import { far } from "./places.js";

const POINT_PIXELS = 9;
const LINE_PIXELS = 6;
const GRID_PIXELS = 4; // least distance of grid lines that a point rests on

/** The step of the grid at so many pixels per um: 1, 2 or 5 times a power of ten, at least a nanometre. */
export function gridStep(k) {
    const least = GRID_PIXELS / k;
    const power = 10 ** Math.floor(Math.log10(least));
    return Math.max([1, 2, 5, 10].map((f) => f * power).find((v) => v >= least * 0.999), 1e-3);
}

const round = (v, step) => Number((Math.round(v / step) * step).toFixed(3)) + 0;

/**
 * p: the place under the pointer; points: others; k: pixels per um; grid: its step, 0: none; free: nothing is snapped.
 * Returns {at, point: the one that it rests on or null, lines: points that it is in line with by axis ([x of, y of])}.
 */
export function snap(p, points, { k, grid = gridStep(k), free = false }) {
    if (free) return { at: p.map((v) => Number(v.toFixed(3)) + 0), point: null, lines: [null, null] };
    let best = null;
    for (const q of points) if (far(p, q) * k <= POINT_PIXELS && (!best || far(p, q) < far(p, best))) best = q;
    if (best) return { at: [...best], point: best, lines: [null, null] };
    const lines = [0, 1].map((axis) => {
        const near = points.filter((q) => Math.abs(q[axis] - p[axis]) * k <= LINE_PIXELS);
        return near.length ? near.reduce((a, b) => (Math.abs(b[axis] - p[axis]) < Math.abs(a[axis] - p[axis]) ? b : a)) : null;
    });
    return { at: p.map((v, axis) => (lines[axis] ? lines[axis][axis] : grid ? round(v, grid) : Number(v.toFixed(3)) + 0)), point: null, lines };
}
