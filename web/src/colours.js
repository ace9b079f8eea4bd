// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that people with any colour vision tell apart.
//
// Utilisation: cividis, which rises evenly in lightness from blue to yellow for normal and for
// red-green-blind vision (J. R. Nunez, C. R. Anderton, R. S. Renslow, "Optimizing colormaps with
// consideration for color vision deficiency to enable accurate interpretation of scientific data",
// PLoS ONE 13, e0199239, 2018); nine of its points, between them linear. Above the limit a hinge is
// hatched and its number is in bold: colour never says anything alone.
// Curves: Okabe and Ito's eight colours (jfly.uni-koeln.de/color, 2008) with eight dash patterns.
const CIVIDIS = [
    [0, 34, 78], [23, 51, 112], [63, 72, 108], [89, 93, 109], [112, 113, 115],
    [138, 134, 120], [166, 157, 117], [198, 183, 104], [254, 232, 56],
];

/** 0..1 -> css colour */
export function scale(share) {
    const x = Math.min(Math.max(share, 0), 1) * (CIVIDIS.length - 1);
    const i = Math.min(Math.floor(x), CIVIDIS.length - 2);
    const mix = CIVIDIS[i].map((c, j) => Math.round(c + (CIVIDIS[i + 1][j] - c) * (x - i)));
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
