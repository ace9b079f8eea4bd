// SPDX-License-Identifier: GPL-3.0-or-later
// A plot as a file: its numbers as CSV, its curves as an SVG that prints as it is.
import { isFormer } from "./belong.js";
import { number } from "./format.js";
import { emit } from "./store.js";

const DARK_ON_WHITE = ["#0060a0", "#b3470a", "#00735a", "#8a3f78", "#7a5c00", "#2f7fb8", "#444b54", "#a0005a"];
const DASHES = ["", "7 3", "2 2.5", "9 3 2 3", "4 2", "12 4", "1.5 4", "6 2 2 2 2 2"];
const [W, H, LEFT, RIGHT, TOP, BOTTOM] = [760, 420, 78, 16, 40, 64];

const quoted = (x) => (/[",\n]/.test(x) ? `"${x.replaceAll('"', '""')}"` : x);

/** A row for each x; unit: of the values; head: of the first column. */
export function csvOf({ t, series }, unit, x = "t_ms") {
    const head = [x, ...series.map((x) => `${x.name}${unit ? ` (${unit})` : ""}`)].map(quoted).join(",");
    return `${[head, ...t.map((v, i) => [v, ...series.map((x) => x.values[i] ?? "")].join(","))].join("\n")}\n`;
}

/** About n round numbers from low to high. */
export function ticks(low, high, n) {
    const raw = (high - low) / n || 1;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((f) => f * power).find((f) => f >= raw);
    const out = [];
    if (!(step > 1e-12 * Math.max(Math.abs(low), Math.abs(high)))) return [low]; // too near each other to be told apart
    for (let v = Math.ceil(low / step) * step; v <= high + step * 1e-9; v += step) out.push(Math.abs(v) < step * 1e-9 ? 0 : v);
    return out;
}

const escaped = (x) => x.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);

/** x and y: [low, high] that are shown; log: y by its decades. A series is a line, or `dots`. */
export function svgOf({ t, series, marks }, { title, unit, x, y, log }) {
    const up = log ? (v) => Math.log10(Math.max(v, 1e-300)) : (v) => v;
    const px = (v) => LEFT + ((v - x[0]) / (x[1] - x[0] || 1)) * (W - LEFT - RIGHT);
    const py = (v) => H - BOTTOM - ((up(v) - up(y[0])) / (up(y[1]) - up(y[0]) || 1)) * (H - TOP - BOTTOM);
    const f = (v) => v.toFixed(2);
    const ys = log ? ticks(up(y[0]), up(y[1]), 6).filter(Number.isInteger).map((v) => 10 ** v) : ticks(y[0], y[1], 6);
    const line = (values) => {
        let d = "";
        let pen = "M";
        values.forEach((v, i) => {
            if (v === null || v === undefined || !Number.isFinite(v)) pen = "M";
            else {
                d += `${pen}${f(px(t[i]))} ${f(py(v))}`;
                pen = "L";
            }
        });
        return d;
    };
    const out = [`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${W} ${H}" width="${W}" height="${H}" font-family="system-ui, sans-serif" font-size="12">`,
        `<rect width="${W}" height="${H}" fill="#fff"/>`, `<text x="${LEFT}" y="22" font-size="14" font-weight="600">${escaped(title)}</text>`, `<text x="${W - RIGHT}" y="22" text-anchor="end" fill="#55626f">${escaped(unit)}</text>`,
        `<clipPath id="area"><rect x="${LEFT}" y="${TOP}" width="${W - LEFT - RIGHT}" height="${H - TOP - BOTTOM}"/></clipPath>`];
    for (const v of ticks(x[0], x[1], 8)) out.push(`<path d="M${f(px(v))} ${TOP}V${H - BOTTOM}" stroke="#e6eaee"/>`, `<text x="${f(px(v))}" y="${H - BOTTOM + 16}" text-anchor="middle">${number(v, 4)}</text>`);
    for (const v of ys) out.push(`<path d="M${LEFT} ${f(py(v))}H${W - RIGHT}" stroke="#e6eaee"/>`, `<text x="${LEFT - 6}" y="${f(py(v) + 4)}" text-anchor="end">${number(v, 4)}</text>`);
    out.push(`<rect x="${LEFT}" y="${TOP}" width="${W - LEFT - RIGHT}" height="${H - TOP - BOTTOM}" fill="none" stroke="#8592a0"/>`, '<g clip-path="url(#area)" fill="none">');
    for (const m of marks) out.push(`<path d="M${LEFT} ${f(py(m.y))}H${W - RIGHT}" stroke="#a53304" stroke-dasharray="5 4"/>`, m.text ? `<text x="${W - RIGHT - 6}" y="${f(py(m.y) + (m.y < 0 ? -5 : 14))}" text-anchor="end" fill="#a53304">${escaped(m.text)}</text>` : "");
    const style = (one, i) => one.dots ? `stroke="${DARK_ON_WHITE[(one.key ?? i) % 8]}" stroke-width="4"` : `stroke="${DARK_ON_WHITE[(one.key ?? i) % 8]}" stroke-width="${one.then ? 1 : 1.8}"${one.then ? ' stroke-dasharray="1.5 2.5"' : one.solid || !DASHES[(one.key ?? i) % 8] ? "" : ` stroke-dasharray="${DASHES[(one.key ?? i) % 8]}"`}`;
    const dots = (values) => values.map((v, i) => (Number.isFinite(v) ? `M${f(px(t[i]) - 2)} ${f(py(v))}h4` : "")).join("");
    series.forEach((one, i) => out.push(`<path d="${one.dots ? dots(one.values) : line(one.values)}" ${style(one, i)}/>`));
    out.push("</g>");
    series.forEach((one, i) => {
        const at = LEFT + (i % 8) * ((W - LEFT - RIGHT) / 8);
        const below = H - BOTTOM + 36 + 14 * Math.floor(i / 8);
        out.push(`<path d="M${f(one.dots ? at + 16 : at)} ${below - 4}h${one.dots ? 4 : 20}" fill="none" ${style(one, i)}/>`, `<text x="${f(at + 24)}" y="${below}">${escaped(one.name)}</text>`);
    });
    return `${out.filter(Boolean).join("\n")}\n</svg>\n`;
}

/** Puts a text, or a blob, where the browser puts what is downloaded. shown: the element that it is of, where that may be of a
 *  former input: then the file is named so, and it is said. */
export function saveAs(name, text, type, shown = null) {
    if (shown && isFormer(shown)) {
        name = name.replace(/(?=\.[a-z]+$)/, "-former-input");
        emit("notice", { kind: "warn", text: `${name}: of the former input, as what is grey is.` });
    }
    const link = document.createElement("a");
    link.href = URL.createObjectURL(text instanceof Blob ? text : new Blob([text], { type }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
