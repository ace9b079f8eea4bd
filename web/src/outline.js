// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines of bodies and bent flexures.
import { s } from "./dom.js";

const STEP_UM = 4; // between points of a bent outline: below half a pixel of a 3 mm device on a screen

/** Rings of points of an SVG path (absolute commands M L A Z), arcs within some nanometres. */
export function rings(d) {
    const probe = s("path", {});
    return d
        .split(/(?=M)/)
        .filter((part) => part.trim())
        .map((part) => {
            probe.setAttribute("d", part);
            const length = probe.getTotalLength();
            const n = Math.min(Math.max(Math.ceil(length / STEP_UM), 8), 1500);
            return Array.from({ length: n }, (_, i) => {
                const p = probe.getPointAtLength((length * i) / n);
                return [p.x, p.y];
            });
        });
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
