// SPDX-License-Identifier: GPL-3.0-or-later
// The tools of drawing: what each asks for, by the pointer or by numbers, and what it makes of that.
import { makeBar, makeCable, makeComb, makeDisc, makeForce, makeHinge, makeOutline, makePlate, makeWorkspace } from "./making.js";
import { far } from "./places.js";

const LEAST_UM = 1; // of a bar, a side, a radius

const size = (key, label, value, unit = "um", more = {}) => ({ key, label, value, unit, ...more });
const bodyField = (first) => ({ key: "body", label: "belongs to", value: "", bodies: first });
const two = ["from", "to"];
const cut = { key: "hole", label: "cut out", value: "no", choices: ["no", "yes"] };
const image = { key: "symmetry", label: "mirror image too", value: "none", choices: ["none", "x", "y", "both"], words: "in the body's own axes: x has the other sign of y, y that of x" };

/** The body that is meant: the chosen one, else what is drawn at the point. */
const under = (c, p) => c.values.body || c.places.bodiesAt(p, c.within)[0];
const noBody = { refuse: "There is no body at this point. Draw a link or a plate there first." };
const tooSmall = (p, q) => (far(p, q) < LEAST_UM ? { refuse: "The two points are the same." } : null);

/** What a hinge at a point joins: [holds on to, holds]; the body that stands first in the text holds the other. */
function twoBodies(c, at) {
    const { a, b } = c.values;
    const found = c.places.bodiesAt(at, c.within).filter((id) => id !== a && id !== b).slice(0, Number(!a) + Number(!b));
    if (!a && !b && found.length === 2) return [...c.places.bodies.keys()].filter((id) => found.includes(id));
    return b ? [a || found[0] || "ground", b] : [a || "ground", found[0]];
}

function hinge(c, [at]) {
    const [a, b] = twoBodies(c, at);
    if (!b) return { refuse: 'There is no body at this point. A hinge joins two bodies, or a body and the ground. To hold a body that ends beside it, choose that under "holds".' };
    if (a === b) return { refuse: "A hinge joins two bodies." };
    const v = c.values;
    const um = (x) => `${x} um`;
    const sizes = v.kind === "leaf" ? { length: um(v.length), width: um(v.width) } : { radius: um(v.radius), angle: `${v.angle} deg`, width: um(v.arcWidth), gap: um(v.gap) };
    return makeHinge(c.places, { at, a, b, flexure: v.flexure, kind: v.kind === "leaf" ? "leaf" : "csfh", sizes, axis: v.axis === "" ? null : (Number(v.axis) * Math.PI) / 180 });
}

const arc = (v) => v.kind === "arc" && !v.flexure;
const leaf = (v) => v.kind === "leaf" && !v.flexure;

/**
 * {id, label, icon, words, points: names of the points that it takes (null: any number), fields, make(c, points)}; c: {places,
 * values, within: um, scene}. make returns {id, changes} or {refuse}.
 */
export const TOOLS = [
    {
        id: "bar", label: "Link", icon: "bar", points: two, words: "Draw from one end to the other. A link that begins on another point begins exactly there.",
        fields: [size("width", "width", 120), bodyField("a new body")],
        make: (c, [p, q]) => tooSmall(p, q) ?? makeBar(c.places, { p, q, width: c.values.width, body: c.values.body }),
    },
    {
        id: "plate", label: "Plate", icon: "plate", points: two, words: "Draw from corner to corner.",
        fields: [bodyField("there, or new"), cut, image],
        make: (c, [p, q]) => (Math.min(Math.abs(p[0] - q[0]), Math.abs(p[1] - q[1])) < LEAST_UM ? { refuse: "A plate needs a width and a height." }
            : makePlate(c.places, { p, q, body: c.values.body === "new" ? null : c.values.body || c.places.bodiesUnder(p, q)[0], hole: c.values.hole === "yes", symmetry: c.values.symmetry })),
    },
    {
        id: "disc", label: "Disc", icon: "disc", points: two, words: "Draw from the middle to the edge.",
        fields: [bodyField("there, or new"), cut, image],
        make: (c, [p, q]) => tooSmall(p, q) ?? makeDisc(c.places, { p, q, body: c.values.body === "new" ? null : under(c, p), hole: c.values.hole === "yes", symmetry: c.values.symmetry }),
    },
    {
        id: "outline", label: "Outline", icon: "outline", points: null, least: 3, closes: true, words: "Click corner after corner; end with a double click, Enter, or a click on the first corner. Where the next side is an arc, click a point that it passes, then its end.",
        fields: [{ key: "side", label: "next side", value: "line", choices: ["line", "arc"] }, bodyField("there, or new"), cut, image],
        make: (c, list) => (list.length < 3 ? { refuse: "An outline has three corners at least." }
            : makeOutline(c.places, { points: list, sides: c.on, body: c.values.body === "new" ? null : c.values.body || list.flatMap((p) => c.places.bodiesAt(p, 0.01))[0], hole: c.values.hole === "yes", symmetry: c.values.symmetry })),
    },
    {
        id: "hinge", label: "Hinge", icon: "hinge", points: ["at"], words: "Click where two links meet, or on one link to hold it on the ground.",
        fields: [
            { key: "kind", label: "kind", value: "arc", choices: ["arc", "leaf"] }, { key: "flexure", label: "flexure", value: "", flexures: true },
            size("length", "length", 300, "um", { when: leaf }), size("width", "width", 10, "um", { when: leaf }),
            size("radius", "radius", 80, "um", { when: arc }), size("angle", "arc", 240, "deg", { when: arc }), size("arcWidth", "width", 8, "um", { when: arc }), size("gap", "gap", 10, "um", { when: arc }),
            { key: "axis", label: "bulges to", value: "", unit: "deg", optional: true }, { key: "a", label: "holds on to", value: "", bodies: "what is there", ground: true }, { key: "b", label: "holds", value: "", bodies: "what is there" },
        ],
        make: hinge,
    },
    {
        id: "force", label: "Force", icon: "force", points: two, words: "Draw from a point of a body to where it is pulled.",
        fields: [size("size", "size", 10, "uN"), bodyField("body there")],
        make: (c, [p, q]) => {
            const body = under(c, p);
            return tooSmall(p, q) ?? (body ? makeForce(c.places, { p, q, body, size: c.values.size, scene: c.scene }) : noBody);
        },
    },
    {
        id: "cable", label: "Cable", icon: "cable", points: null, words: "Click the eyelets in order: first where it is fixed, last where it is pulled. End with a double click or Enter. Where no body is, an eyelet stands on the ground.",
        fields: [size("size", "tension", 50, "uN"), { key: "body", label: "next eyelet on", value: "", bodies: "what is there", ground: true }],
        make: (c, list) => {
            const points = list.map((at, i) => ({ at, body: c.on[i] || c.places.bodiesAt(at, c.within)[0] || "ground" }));
            if (points.length < 2) return { refuse: "A cable has two eyelets at least." };
            if (points.every((x) => x.body === points[0].body)) return { refuse: `All of these points are on ${points[0].body}: a cable goes from one body to another.` };
            return makeCable(c.places, { points, size: c.values.size, scene: c.scene });
        },
    },
    {
        id: "comb", label: "Electrodes", icon: "comb", points: two, words: "Draw from the middle of the overlap on a body to where it is pulled. Both electrodes stand on a carrier that insulates: that of the flow, or the one that carrier=\"insulating\" in <flow> says there is.",
        fields: [size("fingers", "fingers", 10, ""), size("gap", "gap", 8), size("overlap", "overlap", 20), size("length", "length", 50), size("voltage", "voltage", 10, "V"), bodyField("body there")],
        make: (c, [p, q]) => {
            const body = under(c, p);
            return tooSmall(p, q) ?? (body ? makeComb(c.places, { ...c.values, p, q, body, scene: c.scene }) : noBody);
        },
    },
    {
        id: "workspace", label: "Workspace", icon: "workspace", points: two, sixBar: true, words: "Draw the box that the middle of the platform must reach, from corner to corner.",
        fields: [], make: (c, [p, q]) => tooSmall(p, q) ?? makeWorkspace(c.places, { p, q }),
    },
];
