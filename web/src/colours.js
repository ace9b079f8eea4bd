// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that people with any colour vision tell apart.
//
// Utilisation: viridis, which rises evenly in lightness from violet over green to yellow for normal and for
// red-green-blind vision, and is nowhere the grey of a body (N. J. Smith, S. van der Walt, matplotlib 1.5, 2015,
// CC0); nine of its points, between them linear. Above the limit a hinge is hatched and its number is in bold: colour never says anything alone.
// Curves: Okabe and Ito's eight colours (jfly.uni-koeln.de/color, 2008) with eight dash patterns.
const VIRIDIS = [
    [68, 1, 84], [71, 45, 123], [59, 82, 139], [44, 114, 142], [33, 144, 140],
    [39, 173, 129], [93, 200, 99], [170, 220, 50], [253, 231, 37],
];

/** 0..1 -> css colour */
export function scale(share) {
    const x = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
    const i = Math.min(Math.floor(x), VIRIDIS.length - 2);
    const mix = VIRIDIS[i].map((c, j) => Math.round(c + (VIRIDIS[i + 1][j] - c) * (x - i)));
    return `rgb(${mix.join(" ")})`;
}

const LIGHT = ["#0060a0", "#b3470a", "#00735a", "#8a3f78", "#7a5c00", "#2f7fb8", "#444b54", "#a0005a"];
const DARK = ["#6fb7f0", "#f59a5b", "#4fd0a8", "#e0a0cc", "#e8c84a", "#9ad8ff", "#c3c9d1", "#ff9ac4"];
const DASHES = [[], [7, 3], [2, 2.5], [9, 3, 2, 3], [4, 2], [12, 4], [1.5, 4], [6, 2, 2, 2, 2, 2]];

export const dark = () => document.documentElement.dataset.theme === "dark";
export const curve = (i) => (dark() ? DARK : LIGHT)[i % LIGHT.length];
export const dash = (i) => DASHES[i % DASHES.length];

/** A css variable of the theme. */
export const themed = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
