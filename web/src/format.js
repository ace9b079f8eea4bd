// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as people read them. Everything the page shows is rounded here, nowhere else.

const MINUS = "\u2212";
const sign = (text) => text.replace(/^-/, MINUS).replace("e-", `e${MINUS}`);

/** n significant digits without trailing zeros of an exponent: 0.0123, 12.3, 1.23e7 */
export function number(x, digits = 3) {
    if (x === null || x === undefined) return "\u2013";
    if (!Number.isFinite(x)) return "\u221e";
    if (x === 0) return "0";
    const size = Math.abs(x);
    if (size >= 1e6 || size < 1e-4) return sign(x.toExponential(digits - 1));
    return sign(Number(x.toPrecision(digits)).toString());
}

const TICK_MOST = 9;

/** Words of the marks of an axis: as many digits as tell them apart; null is a mark without words. */
export function tickWords(marks, least = 3) {
    const there = marks.filter((x) => x !== null);
    let digits = least;
    while (digits < TICK_MOST && new Set(there.map((x) => number(x, digits))).size < new Set(there).size) digits++;
    return marks.map((x) => (x === null ? "" : number(x, digits)));
}

const PREFIXES = [["G", 1e9], ["M", 1e6], ["k", 1e3], ["", 1], ["m", 1e-3], ["µ", 1e-6], ["n", 1e-9], ["p", 1e-12], ["f", 1e-15]];

/** So many decimals, without a minus before zero. */
export const fixed = (x, digits) => sign((Number(x.toFixed(digits)) + 0).toFixed(digits));

/** The prefix that a size is written with, and its factor. */
export const prefixOf = (x) => (x === 0 ? ["", 1] : PREFIXES.find(([, f]) => Math.abs(x) >= f * 0.9995) ?? PREFIXES.at(-1));

/** 1.23e-6, "J" -> "1.23 µJ" */
export function si(x, unit, digits = 3) {
    if (!Number.isFinite(x)) return number(x);
    if (x === 0) return `0 ${unit}`;
    const [prefix, factor] = prefixOf(x);
    return `${number(x / factor, digits)} ${prefix}${unit}`;
}

export const degrees = (rad, digits = 3) => `${number((rad * 180) / Math.PI, digits)}°`;
export const micrometres = (m, digits = 4) => `${number(m * 1e6, digits)} µm`;

const MOST_PERCENT = 10; // beyond it a share is told as a multiple

/** A share as a percentage: 0.579 -> "57.9 %", 8700 -> "8700 ×" */
export function percent(x, digits = 3) {
    if (x === null || x === undefined) return "\u2013";
    if (!Number.isFinite(x)) return "without bound";
    if (Math.abs(x) >= MOST_PERCENT) return `${number(x, digits)} ×`;
    return `${number(x * 100, digits)} %`;
}

/** Time of a step or a job: 75 -> "1 min 15 s", 23780 -> "6 h 36 min" */
export function duration(seconds) {
    if (seconds === null || seconds === undefined) return "\u2013";
    if (seconds < 1) return si(seconds, "s");
    const whole = Math.round(seconds);
    if (whole < 60) return `${number(seconds, 3)} s`;
    if (whole < 3600) return `${Math.floor(whole / 60)} min${whole % 60 ? ` ${whole % 60} s` : ""}`;
    const minutes = Math.round(seconds / 60);
    return `${Math.floor(minutes / 60)} h${minutes % 60 ? ` ${minutes % 60} min` : ""}`;
}

export function bytes(n) {
    if (n < 1000) return `${n} B`;
    if (n < 1e6) return `${number(n / 1e3)} kB`;
    return `${number(n / 1e6)} MB`;
}

/** "312.50 um" -> {value: 312.5, unit: "um"}; null for an expression */
export function splitQuantity(text) {
    const m = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\d\s].*)?$/.exec(text ?? "");
    if (!m || /[*/+]|\bsqrt\b/.test((m[2] ?? "").replace(/[a-zA-Z]\/[a-zA-Z]/g, ""))) return null;
    return { value: Number(m[1]), unit: (m[2] ?? "").trim() };
}
