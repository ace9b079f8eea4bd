// SPDX-License-Identifier: GPL-3.0-or-later
// What is attached to the bodies of a picture: springs between points, rods and guides, cables through
// eyelets, and the electrodes of a drive that nobody has drawn. All of it moves with the bodies.
import { s } from "./dom.js";
import { micrometres, si } from "./format.js";
import { moved, place } from "./outline.js";

const FIXED = [0, 0, 0];
const COILS = 7;
const BAR_UM = 40; // behind the fingers of electrodes that nobody has drawn
const SHARES = [1 / 3, 1 / 2, 2 / 3, 1 / 5, 4 / 5]; // of the way along, where a name may stand: the first that is free
const NAME = 14; // half of a short name, in pixels, and its height

const length = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);
const write = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(3)} ${y.toFixed(3)}`).join("");
const points = (list) => list.map(([x, y]) => `M${x.toFixed(3)} ${y.toFixed(3)}h0.001`).join(""); // round caps make dots of them
const inMicrometres = (pose) => [pose[0] * 1e6, pose[1] * 1e6, pose[2]];

/** A zigzag from a to b with straight ends; half: its half width in um. */
export function zigzag(a, b, half) {
    const far = length(a, b);
    if (!(far > 1e-6)) return write([a, b]);
    const u = [(b[0] - a[0]) / far, (b[1] - a[1]) / far];
    const at = (share, aside) => [a[0] + share * far * u[0] - aside * u[1], a[1] + share * far * u[1] + aside * u[0]];
    const turns = Array.from({ length: 2 * COILS }, (_, i) => at(0.15 + (0.7 * (i + 0.5)) / (2 * COILS), i % 2 ? -half : half));
    return write([a, at(0.15, 0), ...turns, at(0.85, 0), b]);
}

/** Fingers (or the one face of a plate) along +x in the axes of a drive, whose origin is the middle of the overlap. */
function fingers(load, n) {
    const pitch = 2 * (load.gap_um + load.width_um);
    const tip = load.overlap_um / 2;
    const root = tip - load.length_um;
    const half = ((n - 1) * pitch + load.width_um) / 2;
    const box = (x0, x1, y0, y1) => `M${x0} ${y0}H${x1}V${y1}H${x0}Z`;
    return box(root - BAR_UM, root, -half, half) + Array.from({ length: n }, (_, i) => {
        const y = (i - (n - 1) / 2) * pitch - load.width_um / 2;
        return box(root, tip, y, y + load.width_um);
    }).join("");
}

function electrodes(load) {
    if (load.electrodes === "comb") return [fingers(load, load.fingers), fingers(load, load.fingers + 1)];
    const face = (x, half) => `M${x - BAR_UM} ${-half}H${x}V${half}H${x - BAR_UM}Z`;
    return [face(0, load.length_um / 2), face(-load.gap_um, load.length_um / 2 + load.gap_um + 10)];
}

export class Attached {
    constructor() {
        this.group = s("g", { class: "attached" });
        this.tags = s("g", { class: "attached-tags" });
        this.items = [];
    }

    /** rest: pose of every body at rest. */
    show(preview, rest) {
        this.group.replaceChildren();
        this.tags.replaceChildren();
        const [x0, y0, x1, y1] = preview.box_um ?? [0, 0, 1, 1];
        this.size = Math.max(x1 - x0, y1 - y0);
        const tendons = (preview.loads ?? []).filter((load) => load.kind === "tendon");
        this.items = [
            ...(preview.ties ?? []).map((tie) => this.#tie(tie)),
            ...(preview.loads ?? []).map((load, i) => this.#load(load, i, rest, tendons.indexOf(load))),
            ...(preview.springs ?? []).map((spring) => this.#spring(spring)),
        ].filter(Boolean);
    }

    #path(name, title) {
        const path = s("path", { class: name }, s("title", {}, title));
        this.group.append(path);
        return path;
    }

    #tag(text) {
        const tag = s("text", { class: "attached-tag" }, text ?? "");
        this.tags.append(tag);
        return tag;
    }

    #spring(spring) {
        const path = this.#path(spring.cable ? "cable" : "spring", `${spring.cable ? "cable" : "spring"} ${spring.id ?? ""}`);
        const tag = this.#tag(spring.id);
        const dots = this.#path(spring.cable ? "eyelet" : "end", "");
        const half = 0.018 * this.size;
        return (at) => {
            const [a, b] = [at(spring.bodies[0], spring.on_a_um), at(spring.bodies[1], spring.on_b_um)];
            dots.setAttribute("d", points([a, b]));
            path.setAttribute("d", spring.cable ? write([a, b]) : zigzag(a, b, half));
            path.classList.toggle("slack", spring.cable && length(a, b) < spring.length_um);
            return [{ tag, a, b, away: spring.cable ? 0 : half }];
        };
    }

    #tie(tie) {
        if (tie.kind === "weld") return null;
        const path = this.#path(tie.kind === "distance" ? "rod" : "guide", `${tie.kind === "distance" ? "rod" : "guide"} ${tie.id ?? ""}`);
        if (tie.kind === "distance")
            return (at) => {
                path.setAttribute("d", write([at(tie.bodies[0], tie.on_a_um), at(tie.bodies[1], tie.on_b_um)]));
                return [];
            };
        const u = [Math.cos(tie.axis_rad), Math.sin(tie.axis_rad)];
        return (at, inside) => { // the axis in the first body, from its point to beyond the second's
            const p = inside(tie.bodies[0], at(tie.bodies[1], tie.on_b_um));
            const t = (p[0] - tie.on_a_um[0]) * u[0] + (p[1] - tie.on_a_um[1]) * u[1];
            const ends = [Math.min(0, t) - 0.04 * this.size, Math.max(0, t) + 0.04 * this.size];
            path.setAttribute("d", write(ends.map((v) => at(tie.bodies[0], [tie.on_a_um[0] + v * u[0], tie.on_a_um[1] + v * u[1]]))));
            return [];
        };
    }

    #load(load, index, rest, cable) {
        if (cable >= 0) return this.#tendon(load, index, cable);
        if (load.kind === "comb-drive" && !load.drawn) return this.#comb(load, rest);
        return null;
    }

    /** index: of the load; cable: of the tendons alone. */
    #tendon(load, index, cable) {
        const path = this.#path("cable", "");
        const dots = this.#path("eyelet", "");
        const title = path.firstChild;
        const tag = this.#tag(load.id);
        return (at, inside, acting) => {
            const through = load.eyelets.map((e) => at(e.body, e.at_um));
            path.setAttribute("d", write(through));
            dots.setAttribute("d", points(through));
            const tension = acting?.tensions[cable];
            path.classList.toggle("slack", tension === 0);
            const drawn = load.pull_N === null && acting ? `${micrometres(load.draw_m * acting.factors[index])} drawn in, ` : "";
            const pull = tension === undefined ? "" : `: ${drawn}${tension > 0 ? `tension ${si(tension, "N", 2)}` : "slack"}`;
            const text = `cable ${load.id ?? ""}${pull}`;
            if (title.textContent !== text) title.textContent = text;
            return [through.slice(1).map((b, i) => ({ tag, a: through[i], b, away: 0 })).reduce((a, b) => (length(b.a, b.b) > length(a.a, a.b) ? b : a))];
        };
    }

    #comb(load, rest) {
        const [a, b] = load.bodies;
        const pose = (q, i) => inMicrometres(q[i] ?? FIXED);
        const turn = load.direction_rad + (rest[a]?.[2] ?? 0); // of the drive in the drawing
        const middle = moved(pose(rest, b), load.at_um);
        const base = pose(rest, a);
        const own = moved([0, 0, -base[2]], [middle[0] - base[0], middle[1] - base[1]]); // in the stator's axes
        const degrees = (v) => ((v * 180) / Math.PI).toFixed(5);
        const [rotor, stator] = electrodes(load);
        const within = ([x, y], angle, d, name) => {
            const g = s("g", { class: `electrode ${name}` }, s("title", {}, `drive ${load.id ?? ""}: ${name}, which is not drawn`),
                s("path", { d, transform: `translate(${x.toFixed(3)} ${y.toFixed(3)}) rotate(${degrees(angle)})` }));
            this.group.append(g);
            return g;
        };
        const moving = within(load.at_um, turn - (rest[b]?.[2] ?? 0), rotor, "rotor");
        const still = within(own, turn - base[2] + Math.PI, stator, "stator");
        return (at, inside, acting, q) => {
            moving.setAttribute("transform", place(q[b] ?? FIXED));
            still.setAttribute("transform", place(q[a] ?? FIXED));
            return [];
        };
    }

    /** acting: {factors, tensions} of loads and cables now; null: this picture is of no scene. */
    pose(q, acting) {
        const at = (body, point) => (q[body] ? moved(inMicrometres(q[body]), point) : point);
        const inside = (body, [x, y]) => {
            const p = inMicrometres(q[body] ?? FIXED);
            return moved([0, 0, -p[2]], [x - p[0], y - p[1]]);
        };
        this.places = this.items.flatMap((item) => item(at, inside, acting, q));
    }

    /** Names stand beside what they name, a third of the way along: hinges have theirs towards the middle of the picture; farther
     *  along, or on the other side, where buttons lie there. covered: [left, top, right, bottom] of these, in pixels. */
    name(toScreen, scale, covered) {
        for (const { tag, a, b, away } of this.places ?? []) {
            const [[x0, y0], [x1, y1]] = [toScreen(...a), toScreen(...b)];
            const steep = Math.abs(y1 - y0) > Math.abs(x1 - x0);
            const off = away * scale;
            const at = (share, side) => [x0 + (x1 - x0) * share + (steep ? side * (7 + off) - (side < 0 ? 2 * NAME : 0) : 0), y0 + (y1 - y0) * share + (steep ? 4 : side < 0 ? NAME + 4 + off : -8 - off)];
            const free = ([x, y]) => covered.every(([left, top, right, bottom]) => x < left - NAME || x > right + NAME || y < top - 4 || y > bottom + NAME);
            const places = [1, -1].flatMap((side) => SHARES.map((share) => at(share, side)));
            const [x, y] = places.find(free) ?? places[0];
            tag.setAttribute("text-anchor", steep ? "start" : "middle");
            tag.setAttribute("x", x.toFixed(1));
            tag.setAttribute("y", y.toFixed(1));
        }
    }
}
