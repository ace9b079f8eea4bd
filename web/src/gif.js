// SPDX-License-Identifier: GPL-3.0-or-later
// A GIF that moves (89a): one palette of what is there most, of each frame the part that has changed, LZW. Nothing but
// arithmetic: the same pixels give the same bytes.
const COLOURS = 256;
const SAMPLED = 6; // frames that the palette is taken from
const breath = () => new Promise((resolve) => setTimeout(resolve));
const word = (v) => [v & 255, v >> 8];

class Palette {
    constructor() {
        this.count = new Map();
        this.known = new Map();
    }

    look(data) {
        for (let i = 0; i < data.length; i += 4) {
            const c = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
            this.count.set(c, (this.count.get(c) ?? 0) + 1);
        }
    }

    choose() {
        const most = [...this.count].sort(([a, n], [b, m]) => m - n || a - b).slice(0, COLOURS);
        this.list = most.map(([c]) => c);
        this.list.forEach((c, i) => this.known.set(c, i));
    }

    at(c) {
        let best = this.known.get(c);
        if (best !== undefined) return best;
        let least = Infinity;
        this.list.forEach((p, i) => {
            const d = ((p >> 16) - (c >> 16)) ** 2 + (((p >> 8) & 255) - ((c >> 8) & 255)) ** 2 + ((p & 255) - (c & 255)) ** 2;
            if (d < least) [least, best] = [d, i];
        });
        this.known.set(c, best);
        return best;
    }

    get bytes() {
        return Array.from({ length: COLOURS }, (_, i) => this.list[i] ?? 0).flatMap((c) => [c >> 16, (c >> 8) & 255, c & 255]);
    }
}

/** Variable-length codes from 9 to 12 bits, in blocks of at most 255 bytes. */
export function lzw(indices) {
    const out = [8];
    const CLEAR = 256;
    let block = [];
    let [bits, held, size, next] = [0, 0, 9, 258];
    let table = new Map();
    const put = (code) => {
        held |= code << bits;
        bits += size;
        while (bits >= 8) {
            block.push(held & 255);
            held >>>= 8;
            bits -= 8;
            if (block.length === 255) {
                out.push(255, ...block);
                block = [];
            }
        }
    };
    put(CLEAR);
    let now = indices[0];
    for (let i = 1; i < indices.length; i++) {
        const key = (now << 8) | indices[i];
        const known = table.get(key);
        if (known !== undefined) {
            now = known;
            continue;
        }
        put(now);
        if (next === 4096) {
            put(CLEAR);
            [table, size, next] = [new Map(), 9, 258];
        } else {
            if (next === 1 << size) size++;
            table.set(key, next++);
        }
        now = indices[i];
    }
    put(now);
    put(CLEAR + 1);
    if (bits) block.push(held & 255);
    if (block.length) out.push(block.length, ...block);
    out.push(0);
    return Uint8Array.from(out);
}

/** The rectangle in which two frames differ: [x0, y0, x1, y1], the last ones behind it. */
function changed(a, b, width, height) {
    let [x0, y0, x1, y1] = [width, height, 0, 0];
    for (let i = 0; i < b.length; i++) {
        if (a && a[i] === b[i]) continue;
        const [x, y] = [i % width, Math.floor(i / width)];
        x0 = Math.min(x0, x);
        x1 = Math.max(x1, x + 1);
        y0 = Math.min(y0, y);
        y1 = y + 1;
    }
    return x0 < x1 ? [x0, y0, x1, y1] : [0, 0, 1, 1];
}

/** n frames of RGBA pixels, each shown for so many hundredths of a second. */
export async function gifOf(width, height, n, delay, pixels) {
    const palette = new Palette();
    for (let k = 0; k < SAMPLED; k++) palette.look(await pixels(Math.floor((k * n) / SAMPLED)));
    palette.choose();
    const parts = [Uint8Array.from([...new TextEncoder().encode("GIF89a"), ...word(width), ...word(height), 0xf7, 0, 0, ...palette.bytes,
        0x21, 0xff, 11, ...new TextEncoder().encode("NETSCAPE2.0"), 3, 1, 0, 0, 0])];
    let before = null;
    for (let i = 0; i < n; i++) {
        const data = await pixels(i);
        const now = new Uint8Array(width * height);
        for (let p = 0; p < now.length; p++) now[p] = palette.at((data[4 * p] << 16) | (data[4 * p + 1] << 8) | data[4 * p + 2]);
        const [x0, y0, x1, y1] = changed(before, now, width, height);
        const part = new Uint8Array((x1 - x0) * (y1 - y0));
        for (let y = y0; y < y1; y++) part.set(now.subarray(y * width + x0, y * width + x1), (y - y0) * (x1 - x0));
        parts.push(Uint8Array.from([0x21, 0xf9, 4, 4, ...word(delay), 0, 0, 0x2c, ...word(x0), ...word(y0), ...word(x1 - x0), ...word(y1 - y0), 0]), lzw(part));
        before = now;
        await breath();
    }
    parts.push(Uint8Array.of(0x3b));
    return new Blob(parts, { type: "image/gif" });
}
