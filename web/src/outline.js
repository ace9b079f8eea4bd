// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines of bodies and bent flexures.
const STEP_UM = 5; // between points of a bent outline: about a pixel of a 3 mm device on a screen

/** Points of a circular arc from p to q, without p (SVG 1.1, appendix F.6.5, for equal radii). */
function arc(p, r, large, sweep, q) {
    const dx = (p[0] - q[0]) / 2;
    const dy = (p[1] - q[1]) / 2;
    const half = Math.hypot(dx, dy);
    const radius = Math.max(r, half);
    const k = (large === sweep ? -1 : 1) * Math.sqrt(Math.max(radius * radius - half * half, 0)) / (half || 1);
    const c = [(p[0] + q[0]) / 2 + k * dy, (p[1] + q[1]) / 2 - k * dx];
    const from = Math.atan2(p[1] - c[1], p[0] - c[0]);
    let turn = Math.atan2(q[1] - c[1], q[0] - c[0]) - from;
    if (sweep && turn < 0) turn += 2 * Math.PI;
    if (!sweep && turn > 0) turn -= 2 * Math.PI;
    const n = Math.max(Math.ceil((Math.abs(turn) * radius) / STEP_UM), Math.ceil(Math.abs(turn) / 0.3), 1);
    return Array.from({ length: n }, (_, i) => {
        if (i === n - 1) return q;
        const at = from + (turn * (i + 1)) / n;
        return [c[0] + radius * Math.cos(at), c[1] + radius * Math.sin(at)];
    });
}

function line(p, q) {
    const n = Math.max(Math.ceil(Math.hypot(q[0] - p[0], q[1] - p[1]) / STEP_UM), 1);
    return Array.from({ length: n }, (_, i) => [p[0] + ((q[0] - p[0]) * (i + 1)) / n, p[1] + ((q[1] - p[1]) * (i + 1)) / n]);
}

/** Rings of points of a path of absolute M, L, A and Z, as the server writes outlines. */
export function rings(d) {
    const out = [];
    for (const [, command, list] of d.matchAll(/([MLAZ])([^MLAZ]*)/g)) {
        const v = list.trim() ? list.trim().split(/[ ,]+/).map(Number) : [];
        const ring = out.at(-1);
        if (command === "M") out.push([[v[0], v[1]]]);
        else if (command === "L") ring.push(...line(ring.at(-1), [v[0], v[1]]));
        else if (command === "A") ring.push(...arc(ring.at(-1), v[0], v[3] === 1, v[4] === 1, [v[5], v[6]]));
        else ring.push(...line(ring.at(-1), ring[0]));
    }
    return out;
}

/** Direction and place of every point of a centre line: [{x, y, s (0..1)}]. */
function measured(line) {
    const out = [];
    let total = 0;
    line.forEach(([x, y], i) => {
        if (i) total += Math.hypot(x - line[i - 1][0], y - line[i - 1][1]);
        out.push({ x, y, s: total });
    });
    for (const p of out) p.s = total ? p.s / total : 0;
    return out;
}

function nearest(line, [x, y]) {
    let best = { d: Infinity, s: 0 };
    for (let i = 0; i + 1 < line.length; i++) {
        const a = line[i];
        const b = line[i + 1];
        const dx = b.x - a.x;
        const dy = b.y - a.y;
        const n = dx * dx + dy * dy || 1;
        const t = Math.min(Math.max(((x - a.x) * dx + (y - a.y) * dy) / n, 0), 1);
        const d = (a.x + t * dx - x) ** 2 + (a.y + t * dy - y) ** 2;
        if (d < best.d) best = { d, s: a.s + t * (b.s - a.s) };
    }
    return best.s;
}

export const moved = (pose, [x, y]) => {
    const c = Math.cos(pose[2]);
    const q = Math.sin(pose[2]);
    return [pose[0] + c * x - q * y, pose[1] + q * x + c * y];
};

/** A pose as an SVG transform, in um. */
export const place = (pose) =>
    `translate(${(pose[0] * 1e6).toFixed(3)} ${(pose[1] * 1e6).toFixed(3)}) rotate(${((pose[2] * 180) / Math.PI).toFixed(5)})`;

/**
 * A flexure between two bodies that have moved: its ends go with the bodies, and between them its
 * curvature changes evenly, as that of a beam under a pure moment does; the small gap that the pin
 * model leaves at the far end is shared out along the length.
 * line: centre line at rest in um, from body a to body b; d: outline at rest.
 */
export class Bend {
    constructor(d, line) {
        this.line = measured(line);
        this.rings = rings(d).map((ring) => ring.map((p) => ({ p, s: nearest(this.line, p) })));
    }

    /** Motions of the two bodies from rest, as maps of the plane: [x_um, y_um, phi] about the origin. */
    path(a, b) {
        const n = this.line.length;
        const turn = b[2] - a[2];
        const spine = [moved(a, [this.line[0].x, this.line[0].y])];
        for (let i = 1; i < n; i++) {
            const from = this.line[i - 1];
            const to = this.line[i];
            const phi = a[2] + (turn * (from.s + to.s)) / 2;
            const c = Math.cos(phi);
            const q = Math.sin(phi);
            const dx = to.x - from.x;
            const dy = to.y - from.y;
            spine.push([spine[i - 1][0] + c * dx - q * dy, spine[i - 1][1] + q * dx + c * dy]);
        }
        const end = moved(b, [this.line[n - 1].x, this.line[n - 1].y]);
        const gap = [end[0] - spine[n - 1][0], end[1] - spine[n - 1][1]];
        return this.rings.map((ring) => this.#ring(ring, spine, gap, a[2], turn)).join("");
    }

    #ring(ring, spine, gap, phi0, turn) {
        let d = "";
        ring.forEach(({ p, s: at }, j) => {
            let i = 1;
            while (i < this.line.length - 1 && this.line[i].s < at) i++;
            const a = this.line[i - 1];
            const b = this.line[i];
            const t = b.s > a.s ? (at - a.s) / (b.s - a.s) : 0;
            const phi = phi0 + turn * at;
            const c = Math.cos(phi);
            const q = Math.sin(phi);
            const ox = p[0] - (a.x + t * (b.x - a.x));
            const oy = p[1] - (a.y + t * (b.y - a.y));
            const x = spine[i - 1][0] + t * (spine[i][0] - spine[i - 1][0]) + at * gap[0] + c * ox - q * oy;
            const y = spine[i - 1][1] + t * (spine[i][1] - spine[i - 1][1]) + at * gap[1] + q * ox + c * oy;
            d += `${j ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`;
        });
        return `${d}Z`;
    }
}

/** The rigid motion that takes a body from its pose at rest to another, as a map of the plane (um). */
export function displacement(rest, now) {
    const phi = now[2] - rest[2];
    const [x, y] = moved([0, 0, phi], [rest[0] * 1e6, rest[1] * 1e6]);
    return [now[0] * 1e6 - x, now[1] * 1e6 - y, phi];
}
