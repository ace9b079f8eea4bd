// SPDX-License-Identifier: GPL-3.0-or-later
// What a motion was computed without: of every effect that its scene calls for the most that leaving it out changes of the
// peak, on a logarithmic scale, beside the accuracy that is wanted; as HTML, as numbers, as a picture for a paper.
import { h } from "./dom.js";
import { percent } from "./format.js";

const LEAST = 1e-12; // a bound below it is drawn as nothing

/** {rows: [{id, active, bound, reason}] (largest first), wanted, total: of those left out, by the program or by who asked for
 *  less, null without bound, pins: the first look takes hinges as pins, and has that in its bands} */
export function leftOutOf(p, wanted) {
    const size = (e) => e.bound ?? Infinity;
    const rows = (p.ledger ?? []).filter((e) => e.called_for).map((e) => ({ id: e.id, active: e.active, bound: e.bound, reason: reasonOf(e, p) }));
    rows.sort((a, b) => Number(a.active) - Number(b.active) || size(b) - size(a));
    const sizes = [wanted, ...rows.map((e) => e.bound)].filter((x) => Number.isFinite(x) && x > LEAST);
    const out = rows.filter((e) => !e.active);
    const total = out.some((e) => e.bound === null) ? null : out.reduce((sum, e) => sum + e.bound, 0);
    const pins = (p.left_out ?? []).some((x) => x.what === "hinge-model");
    return { rows, wanted, total, pins, low: Math.floor(Math.log10(Math.min(...sizes) / 3)), high: Math.max(0, Math.ceil(Math.log10(Math.max(...sizes)))) };
}

/** Why an effect is computed or not. That a first look takes hinges as pins was nobody's wish, and the program is not asked for it. */
export const reasonOf = (e, p) => (!e.active && e.id === "nonlinear-hinge" && (p.left_out ?? []).some((x) => x.what === "hinge-model") ? "this first look takes hinges as pins; what a better model of them changes is in its bands" : e.reason);

const share = (x, { low, high }) => (x === null || x > 10 ** high ? 1 : x <= LEAST ? 0 : Math.min(Math.max((Math.log10(x) - low) / (high - low), 0), 1));
const boundOf = (e) => (e.bound === null ? "no bound" : percent(e.bound, 2));
const stateOf = (e) => (e.active ? "computed" : "left out");
const sumOf = (l) => `left out in all: ${l.total === null ? "without bound" : `at most ${percent(l.total, 2)} of the peak`}; wanted: ${percent(l.wanted, 2)}${l.pins ? "; what pins in place of the hinges change is in the bands of this first look" : ""}`;

export function leftOutList(l) {
    const at = `${100 * share(l.wanted, l)}%`;
    return h("div", { class: "leftout", role: "list", tabIndex: 0, "aria-label": `Effects and what leaving them out changes at most. ${sumOf(l)}` },
        l.rows.map((e) => h("div", { class: e.active ? "leftout-row active" : "leftout-row", role: "listitem", title: `${stateOf(e)}: ${e.reason ?? ""}`, "aria-label": `${e.id}: ${boundOf(e)}, ${stateOf(e)}` },
            h("span", { "aria-hidden": "true" }, e.active ? "●" : "○"), h("span", { class: "leftout-name" }, e.id), h("span", { class: "leftout-track", "aria-hidden": "true" }, h("i", { class: "leftout-bar", style: { width: `${100 * share(e.bound, l)}%` } }), h("i", { class: "leftout-wanted", style: { left: at } })),
            h("span", { class: "leftout-value" }, boundOf(e)))),
        h("p", { class: "leftout-sum" }, `○ ${sumOf(l)} (dashed)`));
}

const quoted = (x) => (/[",\n]/.test(x) ? `"${x.replaceAll('"', '""')}"` : x);

export const leftOutCsv = (l) => `${["effect,computed,bound,wanted,reason", ...l.rows.map((e) => [e.id, e.active ? 1 : 0, e.bound ?? "", l.wanted, quoted(e.reason ?? "")].join(","))].join("\n")}\n`;

const escaped = (x) => x.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
const [W, ROW, LEFT, RIGHT, TOP] = [760, 22, 150, 170, 56];

export function leftOutSvg(l, title) {
    const H = TOP + ROW * l.rows.length + 60;
    const px = (s) => (LEFT + s * (W - LEFT - RIGHT)).toFixed(2);
    const bottom = TOP + ROW * l.rows.length + 6;
    const out = [`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${W} ${H}" width="${W}" height="${H}" font-family="system-ui, sans-serif" font-size="12">`, `<rect width="${W}" height="${H}" fill="#fff"/>`,
        `<text x="16" y="22" font-size="14" font-weight="600">${escaped(title)}</text>`, '<text x="16" y="40" fill="#55626f">effects that the scene calls for: most that leaving one out changes of the peak</text>'];
    for (let k = l.low; k <= l.high; k++) {
        const x = px((k - l.low) / (l.high - l.low));
        out.push(`<path d="M${x} ${TOP}V${bottom}" stroke="#e6eaee"/>`, `<text x="${x}" y="${bottom + 16}" text-anchor="middle">${percent(10 ** k, 1)}</text>`);
    }
    l.rows.forEach((e, i) => {
        const y = TOP + ROW * i;
        out.push(`<text x="${LEFT - 8}" y="${y + 15}" text-anchor="end">${escaped(e.id)}</text>`, `<rect x="${LEFT}" y="${y + 5}" width="${(share(e.bound, l) * (W - LEFT - RIGHT)).toFixed(2)}" height="${ROW - 10}" fill="${e.active ? "#0060a0" : "#fff"}" stroke="#0060a0"/>`,
            `<text x="${W - RIGHT + 8}" y="${y + 15}">${escaped(`${boundOf(e)}, ${stateOf(e)}`)}</text>`);
    });
    const x = px(share(l.wanted, l));
    out.push(`<path d="M${x} ${TOP - 4}V${bottom}" stroke="#a53304" stroke-width="1.5" stroke-dasharray="5 4"/>`, `<text x="16" y="${bottom + 38}" fill="#a53304">${escaped(sumOf(l))} (dashed)</text>`, "</svg>");
    return `${out.join("\n")}\n`;
}
