/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A reader of OASIS for the tests, from the record table of SEMI P39 and by another way than the
   writer: it fails the test at whatever is not as the format says. */
#ifndef FW_TEST_OASIS_READER_H
#define FW_TEST_OASIS_READER_H
#include "scene.h"
#include <zlib.h>

typedef struct oas_polygon {
    int layer, datatype, n, kind;
    int64_t x[5000], y[5000];
} oas_polygon;

typedef struct oas {
    fw_arena *arena;
    const unsigned char *at, *end; /* being read: the file, or an inflated block */
    const unsigned char *file;
    size_t length;
    oas_polygon *polygon[4096];
    int npolygon, records, kinds[6], repetitions[12], packed;
    char cell[64], text[64][520], layer[16][80];
    int64_t text_x[64], text_y[64];
    int ntext, nstring, nlayer, used[64], named_layer[16][2];
    uint64_t offset[12];
} oas;

static inline unsigned oas_byte(oas *r) {
    assert_true(r->at < r->end);
    return *r->at++;
}

static inline uint64_t oas_number(oas *r) {
    uint64_t v = 0;
    for (int shift = 0;; shift += 7) {
        unsigned b = oas_byte(r);
        v |= (uint64_t)(b & 127) << shift;
        if (b < 128) return v;
    }
}

static inline int64_t oas_signed(oas *r) {
    uint64_t v = oas_number(r);
    return v & 1 ? -(int64_t)(v >> 1) : (int64_t)(v >> 1);
}

static inline void oas_string(oas *r, char *to, size_t most, unsigned lowest) {
    uint64_t n = oas_number(r);
    assert_true(n < most);
    for (uint64_t i = 0; i < n; i++) {
        unsigned c = oas_byte(r);
        assert_true(c >= lowest && c <= 0x7e);
        to[i] = (char)c;
    }
    to[n] = '\0';
}

static inline void oas_along(int64_t length, unsigned direction, int64_t *dx, int64_t *dy) {
    static const int ex[8] = {1, 0, -1, 0, 1, -1, -1, 1}, ey[8] = {0, 1, 0, -1, 1, 1, -1, -1};
    *dx = ex[direction] * length;
    *dy = ey[direction] * length;
}

static inline void oas_displacement(oas *r, int64_t *dx, int64_t *dy) {
    uint64_t v = oas_number(r);
    if (v & 1) {
        *dx = (v & 2 ? -1 : 1) * (int64_t)(v >> 2);
        *dy = oas_signed(r);
    } else
        oas_along((int64_t)(v >> 4), (unsigned)(v >> 1 & 7), dx, dy);
}

/* vertices relative to the first one */
static inline void oas_points(oas *r, oas_polygon *p) {
    p->kind = (int)oas_number(r);
    int n = (int)oas_number(r);
    assert_true(p->kind <= 5 && n >= 2 && n < 4998);
    r->kinds[p->kind]++;
    int64_t x = 0, y = 0, sx = 0, sy = 0;
    p->n = 1;
    p->x[0] = p->y[0] = 0;
    for (int i = 0; i < n; i++) {
        int64_t dx = 0, dy = 0;
        uint64_t v;
        if (p->kind < 2) {
            if ((i + p->kind) % 2)
                dy = oas_signed(r);
            else
                dx = oas_signed(r);
        } else if (p->kind < 4) {
            v = oas_number(r);
            oas_along((int64_t)(v >> p->kind), (unsigned)(v & (p->kind == 2 ? 3 : 7)), &dx, &dy);
        } else {
            oas_displacement(r, &dx, &dy);
            if (p->kind == 5) {
                sx += dx, sy += dy;
                dx = sx, dy = sy;
            }
        }
        x += dx, y += dy;
        p->x[p->n] = x;
        p->y[p->n++] = y;
    }
    if (p->kind < 2) { /* the last corner closes at right angles */
        bool along_x = (n + p->kind) % 2 == 0;
        p->x[p->n] = along_x ? 0 : x;
        p->y[p->n++] = along_x ? y : 0;
    }
}

/* places of a repetition, the first at 0, 0 */
static inline int oas_repetition(oas *r, int64_t (*at)[2], int most) {
    int type = (int)oas_number(r), nx = 1, ny = 1, n = 0;
    int64_t dx = 0, dy = 0;
    assert_true(type == 1 || type == 2 || type == 3 || type == 10);
    r->repetitions[type]++;
    if (type == 10) {
        int count = (int)oas_number(r) + 2;
        assert_true(count <= most);
        at[n][0] = at[n][1] = 0;
        for (n = 1; n < count; n++) {
            oas_displacement(r, &dx, &dy);
            at[n][0] = at[n - 1][0] + dx;
            at[n][1] = at[n - 1][1] + dy;
        }
        return n;
    }
    if (type != 3) nx = (int)oas_number(r) + 2;
    if (type != 2) ny = (int)oas_number(r) + 2;
    if (type != 3) dx = (int64_t)oas_number(r);
    if (type != 2) dy = (int64_t)oas_number(r);
    assert_true(nx * ny <= most);
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++, n++)
            at[n][0] = i * dx, at[n][1] = j * dy;
    return n;
}

static inline void oas_cell(oas *r) {
    enum { MOST = 1024 };
    static int64_t place[MOST][2];
    int64_t x = 0, y = 0, tx = 0, ty = 0;
    int layer = -1, datatype = -1, text_layer = -1, text_type = -1;
    oas_polygon form = {0};
    while (r->at < r->end) {
        const unsigned char *start = r->at;
        unsigned id = oas_byte(r);
        if (id == 19) {
            unsigned info = oas_byte(r);
            assert_int_equal(info & 0xe4, 0x60);
            r->used[r->ntext] = (int)oas_number(r);
            if (info & 1) text_layer = (int)oas_number(r);
            if (info & 2) text_type = (int)oas_number(r);
            if (info & 16) tx = oas_signed(r);
            if (info & 8) ty = oas_signed(r);
            assert_true(text_layer == 63 && text_type == 0);
            r->text_x[r->ntext] = tx;
            r->text_y[r->ntext++] = ty;
            continue;
        }
        if (id != 21) {
            r->at = start;
            return;
        }
        unsigned info = oas_byte(r);
        assert_true(info < 64);
        if (info & 1) layer = (int)oas_number(r);
        if (info & 2) datatype = (int)oas_number(r);
        if (info & 32) oas_points(r, &form);
        if (info & 16) x = oas_signed(r);
        if (info & 8) y = oas_signed(r);
        assert_true(layer >= 0 && datatype >= 0 && form.n >= 3);
        place[0][0] = place[0][1] = 0;
        int n = info & 4 ? oas_repetition(r, place, MOST) : 1;
        r->records++;
        for (int k = 0; k < n; k++) {
            oas_polygon *p = fw_arena_one(r->arena, oas_polygon);
            *p = form;
            p->layer = layer, p->datatype = datatype;
            for (int i = 0; i < p->n; i++)
                p->x[i] += x + place[k][0], p->y[i] += y + place[k][1];
            assert_true(r->npolygon < 4096);
            r->polygon[r->npolygon++] = p;
        }
    }
}

static inline void oas_block(oas *r) {
    assert_int_equal(oas_byte(r), 34);
    assert_int_equal(oas_number(r), 0);
    uint64_t whole = oas_number(r), packed = oas_number(r);
    assert_true(packed < whole && packed <= (uint64_t)(r->end - r->at));
    unsigned char *data = fw_arena_array(r->arena, unsigned char, whole);
    z_stream z = {.next_in = (unsigned char *)(uintptr_t)r->at,
                  .avail_in = (unsigned)packed,
                  .next_out = data,
                  .avail_out = (unsigned)whole};
    assert_int_equal(inflateInit2(&z, -15), Z_OK);
    assert_int_equal(inflate(&z, Z_FINISH), Z_STREAM_END);
    assert_true(z.total_out == whole && z.total_in == packed);
    inflateEnd(&z);
    oas inner = *r;
    inner.at = data;
    inner.end = data + whole;
    oas_cell(&inner);
    assert_ptr_equal(inner.at, inner.end);
    inner.at = r->at + packed;
    inner.end = r->end;
    *r = inner;
    r->packed++;
}

/* bit by bit: x^32+x^26+x^23+x^22+x^16+x^12+x^11+x^10+x^8+x^7+x^5+x^4+x^2+x+1, reflected */
static inline uint32_t oas_crc(const unsigned char *data, size_t n) {
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < n; i++) {
        crc ^= data[i];
        for (int k = 0; k < 8; k++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

static inline void oas_end(oas *r) {
    const unsigned char *start = r->at;
    assert_int_equal(r->end - start, 256);
    assert_int_equal(oas_byte(r), 2);
    for (int i = 0; i < 12; i++)
        r->offset[i] = oas_number(r);
    uint64_t padding = oas_number(r);
    assert_true(padding < 256);
    for (uint64_t i = 0; i < padding; i++)
        oas_byte(r);
    assert_int_equal(oas_byte(r), 1);
    uint32_t crc = 0;
    for (int i = 0; i < 4; i++)
        crc |= (uint32_t)oas_byte(r) << 8 * i;
    assert_ptr_equal(r->at, r->end);
    assert_int_equal(crc, oas_crc(r->file, r->length - 4));
}

static inline void oas_read(oas *r, fw_arena *arena, const fw_text *text) {
    *r = (oas){.arena = arena, .file = (const unsigned char *)text->data, .length = text->length};
    r->at = r->file;
    r->end = r->file + r->length;
    assert_memory_equal(r->at,
                        "%SEMI-OASIS\r\n\1\3"
                        "1.0",
                        18);
    r->at += 18;
    assert_int_equal(oas_number(r), 0); /* a whole number of grid steps per um */
    assert_int_equal(oas_number(r), 1000);
    assert_int_equal(oas_number(r), 1);
    assert_int_equal(oas_byte(r), 13);
    assert_int_equal(oas_number(r), 0);
    if (*r->at == 34)
        oas_block(r);
    else
        oas_cell(r);
    uint64_t table[3] = {0, 0, 0};
    for (unsigned id; id = oas_byte(r), id != 2;) {
        uint64_t here = (uint64_t)(r->at - 1 - r->file);
        int which = id == 3 ? 0 : id == 5 ? 1 : 2;
        if (!table[which]) table[which] = here;
        for (int later = which + 1; later < 3; later++)
            assert_int_equal(table[later], 0); /* tables in one piece each */
        if (id == 3)
            oas_string(r, r->cell, sizeof r->cell, 0x21);
        else if (id == 5)
            oas_string(r, r->text[r->nstring++], sizeof r->text[0], 0x20);
        else {
            assert_true(id == 11 || id == 12);
            oas_string(r, r->layer[r->nlayer], sizeof r->layer[0], 0x21);
            for (int k = 0; k < 2; k++) {
                assert_int_equal(oas_number(r), 3);
                r->named_layer[r->nlayer][k] = (int)oas_number(r);
            }
            r->nlayer++;
        }
    }
    r->at--;
    oas_end(r);
    const uint64_t want[12] = {1, table[0], 1, table[1], 1, 0, 1, 0, 1, table[2], 1, 0};
    for (int i = 0; i < 12; i++)
        assert_int_equal(r->offset[i], want[i]);
}

#endif
