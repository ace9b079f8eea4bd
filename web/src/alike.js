// SPDX-License-Identifier: GPL-3.0-or-later
// Two answers of the server: are they the same?

/** Of what JSON can hold; but: {member: true} of the members that do not count, {member: {...}} of those within one. */
export function alike(a, b, but = {}) {
    if (a === b) return true;
    if (typeof a !== "object" || typeof b !== "object" || a === null || b === null || Array.isArray(a) !== Array.isArray(b)) return false;
    if (Array.isArray(a)) return a.length === b.length && a.every((x, i) => alike(x, b[i]));
    const names = Object.keys(a);
    return names.length === Object.keys(b).length && names.every((k) => but[k] === true || (k in b && alike(a[k], b[k], but[k])));
}
