// SPDX-License-Identifier: GPL-3.0-or-later
// Values of attributes as numbers, so that what is drawn by hand can be placed while the text is no device yet. The
// grammar is that of the program (src/quantity/expression.c): sum, product, sign, power; a unit binds tighter than * and
// /. Dimensions are not checked here, the program does that; what cannot be read is NaN.

const FUNCTIONS = {
    sqrt: Math.sqrt, exp: Math.exp, ln: Math.log, sin: Math.sin, cos: Math.cos, tan: Math.tan, asin: Math.asin, acos: Math.acos,
    atan: Math.atan, atan2: Math.atan2, min: Math.min, max: Math.max, abs: Math.abs,
};
const NUMBER = /(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?/y;
const NAME = /[A-Za-z_][A-Za-z0-9_]*/y;
const SYMBOL = /\{[^}]*\}|%|[A-Za-z\u00b5\u03bc]+/y;
const EXPONENT = /\^?-?\d+/y;
const DEPTH_MOST = 64;

class Reader {
    constructor(text, units, value) {
        Object.assign(this, { text, units, value, at: 0, depth: 0 });
    }

    #space() {
        while (/\s/.test(this.text[this.at] ?? "")) this.at++;
    }

    #match(pattern) {
        pattern.lastIndex = this.at;
        const m = pattern.exec(this.text);
        if (m) this.at = pattern.lastIndex;
        return m?.[0] ?? null;
    }

    #mark(c) {
        this.#space();
        if (this.text[this.at] !== c) return false;
        this.at++;
        return true;
    }

    /** The factor of a unit behind a number, 1 without one. */
    #unit() {
        let factor = 1;
        for (let sign = 1, first = true; ; first = false) {
            const before = this.at;
            this.#space();
            if (!first) {
                const joined = this.text[this.at] ?? "";
                sign = joined === "/" ? -1 : 1;
                if (joined && "/.*".includes(joined)) this.at++;
                this.#space();
            }
            const symbol = this.#match(SYMBOL);
            const size = symbol === null ? undefined : this.units[symbol];
            if (size === undefined || /[A-Za-z0-9_(]/.test(this.text[this.at] ?? "") && !/\d/.test(this.text[this.at])) {
                this.at = before;
                return factor;
            }
            const exponent = this.#match(EXPONENT);
            factor *= size ** (sign * (exponent === null ? 1 : Number(exponent.replace("^", ""))));
        }
    }

    #primary() {
        this.#space();
        const number = this.#match(NUMBER);
        if (number !== null) return Number(number) * this.#unit();
        if (this.#mark("(")) {
            const inner = this.#sum();
            return this.#mark(")") ? inner : NaN;
        }
        const name = this.#match(NAME);
        if (name === null) return NaN;
        if (!this.#mark("(")) return this.value(name);
        const list = [this.#sum()];
        while (this.#mark(",")) list.push(this.#sum());
        return this.#mark(")") && Object.hasOwn(FUNCTIONS, name) ? FUNCTIONS[name](...list) : NaN;
    }

    #power() {
        const base = this.#primary();
        return this.#mark("^") ? base ** this.#signed() : base;
    }

    #signed() {
        if (++this.depth > DEPTH_MOST) return NaN;
        const v = this.#mark("-") ? -this.#signed() : this.#mark("+") ? this.#signed() : this.#power();
        this.depth--;
        return v;
    }

    #product() {
        for (let v = this.#signed(); ; ) {
            if (this.#mark("*")) v *= this.#signed();
            else if (this.#mark("/")) v /= this.#signed();
            else return v;
        }
    }

    #sum() {
        for (let v = this.#product(); ; ) {
            if (this.#mark("+")) v += this.#product();
            else if (this.#mark("-")) v -= this.#product();
            else return v;
        }
    }

    /** The factor of all of the text as a unit; undefined: it is none. */
    unitAlone() {
        const factor = this.#unit();
        this.#space();
        return this.at > 0 && this.at === this.text.length ? factor : undefined;
    }

    all() {
        const v = this.#sum();
        this.#space();
        return this.at === this.text.length ? v : NaN;
    }
}

/** In SI. units: symbol -> factor; value(name): of a parameter. */
export const evaluate = (text, units, value) => new Reader(String(text), units, (name) => (name === "pi" ? Math.PI : value(name))).all();

/** The factor of a unit, also of several symbols joined by a blank, '.', '*' or '/' ("N m", "kg m^2/s^2"); undefined: it
 *  is none. */
export const sizeOf = (unit, units) => units[unit] ?? new Reader(unit, units, () => NaN).unitAlone();

const PLAIN = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([A-Za-z%\u00b5\u03bc][^()+]*?)?\s*$/;
const ALONE = /^\s*([+-]?)\s*([A-Za-z_][A-Za-z0-9_]*)\s*$/;

/** What stands in an attribute: {kind: "number", unit}, {kind: "parameter", name, sign} or {kind: "formula"}. */
export function kindOf(text, units, isParameter) {
    const plain = PLAIN.exec(text);
    if (plain && (plain[2] === undefined || sizeOf(plain[2], units) !== undefined)) return { kind: "number", unit: plain[2] ?? "" };
    const alone = ALONE.exec(text);
    if (alone && isParameter(alone[2])) return { kind: "parameter", name: alone[2], sign: alone[1] === "-" ? -1 : 1 };
    return { kind: "formula" };
}

const FINEST = 1e-9; // m and, of angles, 0.001 deg: what the masks resolve
const FINEST_ANGLE = Math.PI / 180e3;

/** A number in a unit as it is written into the text, rounded to a nanometre or a thousandth of a degree; other
 *  quantities to six digits. */
export function written(value, unit, units) {
    const factor = sizeOf(unit, units) ?? 1;
    const finest = /^[kdcmu\u00b5\u03bcnp]?m$/.test(unit) ? FINEST : /^[a-z\u00b5\u03bc]*(?:rad|deg)$/.test(unit) ? FINEST_ANGLE : 0;
    const x = value / factor;
    const digits = finest ? Math.max(0, Math.min(12, Math.round(-Math.log10(finest / factor)))) : null;
    const rounded = digits === null ? Number(x.toPrecision(6)) : Number(x.toFixed(digits));
    return `${rounded + 0}${unit ? ` ${unit}` : ""}`;
}
