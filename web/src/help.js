// SPDX-License-Identifier: GPL-3.0-or-later
// Help: what every option of the view that is open means, in a sentence, and the documentation that is part of the program.
// The form has the sentences of the description's own table; here are those of how the page computes and shows.
import { openDialog } from "./dialog.js";
import { h } from "./dom.js";

const POINT = "Where it is, from the origin of the drawing; the pointer fills it in, and it can be written.";
const BODY = "The body that it becomes a part of, or acts on. What is under the pointer, where nothing is chosen.";

/** By the name of a control, without its unit. */
const SENTENCES = {
    Scene: "Which of the description's scenes is moved and shown. The verdict is about all of them.",
    method: "How the forces that hold the joints together are found. All methods give the same motion; chain is the cheapest for most devices.",
    integrator: "The rule that steps from instant to instant. auto takes an explicit one, and an implicit one where the motion is stiff.",
    stabilise: "How joints are kept closed while rounding opens them: projection puts the bodies back after every step, baumgarte pulls them back, none lets them drift.",
    tolerance: "Relative error that the integrator allows itself in a step. auto takes it from the accuracy.",
    hinges: "How flexures enter the mechanism: revolute is a pin with a spring at the elastic centre, compliance also gives and drifts, elastica is the exact beam. auto takes the cheapest whose error is below the accuracy.",
    effects: "Which forces are computed: auto leaves out what provably changes less than the accuracy, all computes all that the scene calls for, none only stiffness, springs and loads.",
    accuracy: "Relative error of the largest deflection of a hinge that is good enough. What is cheaper and within it is taken.",
    "Time of the scene": "The instant that the picture shows, and the cursors of the plots.",
    "What is plotted": "The third plot: a probe with its bounds, how fast it changes, where points of the bodies are and how fast, how bodies turn, or what the motion was computed without.",
    Speed: "How fast the scene plays; at 1× it takes four seconds, however long it is.",
    Grid: "The steps on which points come to rest while they are drawn. With Alt they rest on nothing.",
    Part: "All that can be chosen in the drawing, for who does not point.",
    "belongs to": BODY,
    "cut out": "yes: a hole in the body instead of a part of it.",
    "mirror image too": "Draws the image as well: x about the x axis of the body's own frame (y has the other sign), y about its y axis, both all four.",
    "next side": "How the outline goes on: a straight line, or an arc over a point that it passes.",
    kind: "arc: a circular flexure between conjugate surfaces, which turns far; leaf: a straight strip.",
    flexure: "One that the description has, so that several hinges share its sizes, or a new one.",
    "bulges to": "Direction of the arc's bulge, from the x axis; empty: the layout finds it.",
    "holds on to": "The body that the hinge holds on to, or the ground.", holds: "The body that turns on it.",
    width: "Across a link, or of the flexure's strip.", length: "Of the strip, or of a finger.", radius: "Of the arc's middle line.", arc: "Angle that the arc subtends.",
    gap: "Of a hinge: between the arc and its conjugate surfaces; of electrodes: between fingers.", size: "How strongly it pulls.", tension: "With which the cable is pulled behind its last eyelet; it rises within 10 ms.",
    "next eyelet on": "The body that carries the next eyelet; without one the cable is led over the ground.",
    fingers: "Of the moving comb.", overlap: "Of the fingers as drawn.", voltage: "Between the combs, constant.",
    "from, x": POINT, "from, y": POINT, "to, x": POINT, "to, y": POINT, "at, x": POINT, "at, y": POINT, "next corner, x": POINT, "next corner, y": POINT, "next eyelet, x": POINT, "next eyelet, y": POINT,
    to: "left and right: x has the other sign; above and below: y.", about: "The line about which it is mirrored.",
    x: "By how much it stands off its place at rest, or where it is.", y: "By how much it stands off its place at rest, or where it is.", φ: "By how much it is turned from rest.",
    "Body that is dragged": "The body whose pose is chosen; all others follow.",
    Flow: "The process that makes it: material, thickness, bias and limits are its own.",
    About: "Small motions about the device at rest, or about the equilibrium under the loads of the scene.",
    "Amplitude of the picture": "How far the shape is drawn; a mode has no size of its own.",
    "with the load path, through limit points": "Follows the equilibrium from no load to the whole, also where it snaps through.",
    "From before to after": "From the poses that the description states to those in which the joints are closed.",
    "Assembly shown": "The assembly that was found, or another way in which the same links fit together.",
    Cell: "The device itself, or the test die that measures its process.",
    "as drawn": "The outlines of the description.", "on the mask": "With the flow's bias: what is written.", "as fabricated": "What the flow is expected to make of it.", "where the edge may stand": "Between the least and the most of the flow's ranges.",
    "Another number": "Any other value of the process pack that your laboratory knows better.", "Where these numbers are from": "Stands on the run sheet and in the report, beside every number.",
    Log: "The as-run log of a lot, a file beside the description, or a new one.",
    Number: "What is shown along the range: the share of the limit that governs, that of one hinge, a requirement, the lowest frequency in and out of the plane.",
    Vary: "Parameter or attribute that is varied.", "and vary": "A second one makes a map.", "First input, from": "Begin of the range, with its unit.", "First input, to": "End of the range.", "Second input, from": "Begin of the second range.", "Second input, to": "End of the second range.",
    Judged: "A first look takes hinges as pins, as the live verdict does; as drawn is the whole verdict of the drawing; as made looks at the corners of what the flow may make, too.",
    "Look at": "The device of the range that is told below; Use puts it into the text.", "Kind of study": "What many devices are judged for: a map, what matters, the best, the worst, or how many survive.",
    "Accuracy wanted": "Relative error of the largest deflection of a hinge that is good enough, for all of the page.",
    begun: "Date and time, of this machine, at which the step was begun.", ended: "Date and time at which it was done; not before it was begun.", by: "Initials of who did it.",
    "second signature": "Initials of who watched, where the step asks for two.", machine: "Which one, where the laboratory has several; its name or number.", bath: "Which bath or bottle: what is used up is counted on it.",
    "measured with": "The instrument that the values below are read from.", note: "What else was seen; any words.", why: "What happened to the wafer, in words.", "What became of the wafer": "Scrapped or held, nothing more is expected of it; a held one may go on.", lot: "The name of the lot, as on its box.", file: "The log's file, beside the description.",
    "wafers: how many, or their names with commas between": "4 for wafers 1 to 4, or names: W1, W2.", of: "The wafer that went through the step, or the whole lot.", log: "The as-run log of a lot, a file beside the description, or a new one.",
    "Coupons, one a line": "Name, feature, drawn size, values, standard uncertainty and what it was measured at, each with its unit (um), as flexwright calibrate takes them.",
    step: "The step of the recipe that was run.", Step: "The step of the recipe that was run.", Wafer: "The wafer that went through it, or the whole lot.",
};
const PATTERNS = [
    [/: value$/, "What your laboratory has found, in the unit beside it."], [/: which it is$/, "The name of what your laboratory uses, as its maker writes it."], [/: standard uncertainty$/, "One standard deviation; 0 says that the number is exact."], [/: how it is known$/, "Measured, stated by a maker, typical, or assumed: what is assumed stays marked so."],
    [/^\d+\/\d+/, "Shows or hides this layer of the mask."], [/^Open results of/, "Samples that flexwright study has left beside the description."],
];

const plain = (name) => name.replace(/\s+/g, " ").trim().replace(/(, | \()(µm|µN|°|V|deg)\)?$/, "");

/** The sentence of a control, or null. */
export function sentenceOf(name, own) {
    const key = plain(name);
    return SENTENCES[key] ?? SENTENCES[key[0]?.toUpperCase() + key.slice(1)] ?? PATTERNS.find(([p]) => p.test(key))?.[1] ?? (own || null);
}

/** [{name, sentence}] of what can be chosen in a panel now. */
export function controlsOf(panel) {
    const seen = new Map();
    for (const e of panel.querySelectorAll("select, input, textarea")) {
        if (e.offsetParent === null || e.type === "file") continue;
        const name = plain(e.dataset.name ?? e.getAttribute("aria-label") ?? e.labels?.[0]?.textContent ?? "");
        if (!seen.has(name)) seen.set(name, { name: /^\d+\/\d+/.test(name) ? "layers" : name.replace(/^.* \([^()]+\): (value|which it is|standard uncertainty|how it is known)$/, "$1"), sentence: sentenceOf(name, e.title) });
    }
    return [...new Map([...seen.values()].map((x) => [x.name, x])).values()];
}

export function helpDialog(view, panel) {
    const list = controlsOf(panel).filter((x) => x.sentence);
    openDialog(`Help: ${view}`, [
        h("p", {}, h("a", { href: "/help/page.html", target: "_blank", rel: "noopener" }, "The documentation"), ": this page, tutorial, device description, diagnostics. It is of this version and needs no network."),
        list.length ? h("dl", { class: "help-list scroll" }, list.flatMap(({ name, sentence }) => [h("dt", {}, name), h("dd", {}, sentence)])) : h("p", { class: "doc" }, "There is nothing to choose here at the moment."),
    ], []);
}
