// SPDX-License-Identifier: GPL-3.0-or-later
// What a device is for: of each requirement and probe the number that is told, with its band, its decision and what it is of. It is the verdict's own where that
// is there (as made, else as drawn); before it is of the first look at the drawing, which accepts nothing.
import { si } from "./format.js";

const DIGITS = 4; // as in the terminal

export const FIRST_LOOK = "at a first look";

/** Hinges are pins in this look at the drawing, or because somebody wants that. */
export const hasPins = (p) => p?.hinge_model === "revolute";

/** What hinges that flex would change of a probe is more than what it has without it: it cannot be told from it. */
export const isUnknown = (x) => (x.level_error !== null && x.level_error >= 1) || !Number.isFinite(x.peak);

/** Why a probe is not told, in words. */
export const whyUnknown = (p) => `not known ${hasPins(p) ? "with hinges as pins" : "as the hinges are taken"}: what a better model of them changes of it is larger than what is computed of it`;

/** [low, high] of what a probe has at its peak: what the hinges' model changes, and what is off by numbers. */
function bandOf(x) {
    const off = Math.abs(x.peak) * (x.level_error ?? 0) + (x.error ?? 0);
    return [x.peak - off, x.peak + off];
}

/** A number and its band; what is within the error of numbers about zero is zero. */
export function withBand(value, band, unit) {
    const [low, high] = band ?? [NaN, NaN];
    if (!Number.isFinite(low) || !Number.isFinite(high)) return si(value, unit, DIGITS);
    const [own, a, b] = [value, low, high].map((x) => si(x, unit, DIGITS));
    return a === own && b === own ? own : `${own} (${a} to ${b})`;
}

/** A requirement as made: where that is worse than the drawing it decides, but a range that some of its devices do not meet is undecided. */
function decided(r) {
    const made = r.as_fabricated;
    if (!made || r.verdict === "reject") return r.verdict;
    return made.verdict === "accept" ? r.verdict : "inconclusive";
}

/**
 * Rows of the requirements of a verdict: [{r, value, band, all: band over all corners, basis, decision, at: which corner, known}].
 * look: it is the live one, whose corners were not run and which may not accept.
 */
export const requirementsOf = (v, look) => (v?.requirements ?? []).map((r) => {
    const made = r.as_fabricated;
    const told = made ?? r;
    const [low, high] = told.band ?? [NaN, NaN];
    return { r, value: told.value, band: told.band, all: made?.all_corners_band ?? null, basis: made ? "as made" : look ? `as drawn, ${FIRST_LOOK}` : "as drawn",
        at: made?.corner ?? null, decision: decided(r), first: look, known: !told.why && told.value !== null, why: told.why,
        only: look && Number.isFinite(low) && Number.isFinite(high) && high - low >= 2 * Math.abs(told.value) }; // the band alone says something
});

/** Probes that no requirement is about: [{x, band, known, zero: nothing but rounding}]. */
export const probesOf = (v) => (v?.probes ?? []).filter((x) => !(v.requirements ?? []).some((r) => r.probe === x.id && r.scene === x.scene && r.flow === x.flow))
    .map((x) => ({ x, band: bandOf(x), known: !isUnknown(x), zero: Math.abs(x.peak) <= (x.error ?? 0) }));
