/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integers, displacements and point lists of OASIS. Source: SEMI P39-0308, sections 7.2 (integers),
   7.5 (deltas), 7.7 (point lists), in the form in which KLayout reads them. */
#include "mask/mask_parts.h"
#include <string.h>

bool fw_mask_octets_room(fw_mask_octets *o, size_t more) {
    if (o->failed) return false;
    if (o->length + more <= o->capacity) return true;
    size_t capacity = o->capacity ? o->capacity : 4096;
    while (capacity < o->length + more)
        capacity *= 2;
    unsigned char *data = fw_arena_grow(o->arena, o->data, o->length, capacity, 1);
    o->failed = !data;
    if (!data) return false;
    o->data = data;
    o->capacity = capacity;
    return true;
}

void fw_mask_octets_bytes(fw_mask_octets *o, const void *data, size_t n) {
    if (n == 0 || !fw_mask_octets_room(o, n)) return;
    memcpy(o->data + o->length, data, n);
    o->length += n;
}

void fw_mask_octets_number(fw_mask_octets *o, uint64_t value) {
    if (!fw_mask_octets_room(o, FW_OCTETS_INTEGER)) return;
    o->length = (size_t)(fw_octets_put(o->data + o->length, value) - o->data);
}

void fw_mask_octets_signed(fw_mask_octets *o, int64_t value) {
    fw_mask_octets_number(o, fw_octets_folded(value));
}

void fw_mask_octets_string(fw_mask_octets *o, const char *text) {
    size_t n = strlen(text);
    fw_mask_octets_number(o, n);
    fw_mask_octets_bytes(o, text, n);
}

/* ---- displacements ---- */
static uint64_t size_of(int64_t v) {
    return (uint64_t)(v < 0 ? -v : v);
}

/* 0 east, 1 north, 2 west, 3 south, 4 north-east, 5 north-west, 6 south-west, 7 south-east;
   -1: none of these */
static int octant(int64_t dx, int64_t dy) {
    if (dy == 0) return dx >= 0 ? 0 : 2;
    if (dx == 0) return dy > 0 ? 1 : 3;
    if (size_of(dx) != size_of(dy)) return -1;
    return dx > 0 ? (dy > 0 ? 4 : 7) : (dy > 0 ? 5 : 6);
}

static uint64_t longer(int64_t dx, int64_t dy) {
    uint64_t x = size_of(dx), y = size_of(dy);
    return x > y ? x : y;
}

unsigned char *fw_mask_octets_displacement(unsigned char *at, int64_t dx, int64_t dy) {
    int direction = octant(dx, dy);
    if (direction >= 0) return fw_octets_put(at, longer(dx, dy) << 4 | (unsigned)direction << 1);
    at = fw_octets_put(at, size_of(dx) << 2 | (dx < 0 ? 2u : 0u) | 1u);
    return fw_octets_put(at, fw_octets_folded(dy));
}

/* bytes of an integer: ceil(bits / 7), at least 1 */
static size_t bytes_of(uint64_t value) {
    unsigned bits = 64 - (unsigned)__builtin_clzll(value | 1);
    return (bits + 6) * 37 >> 8; /* = ceil(bits / 7) for 1 .. 64 bits */
}

static size_t displacement_bytes(int64_t dx, int64_t dy) {
    if (octant(dx, dy) >= 0) return bytes_of(longer(dx, dy) << 4);
    return bytes_of(size_of(dx) << 2) + bytes_of(size_of(dy) << 1);
}

/* ---- point lists ---- */
typedef struct step {
    int64_t dx, dy;
} step;

static step step_at(const fw_geometry_polygon *p, int i) { /* from vertex i to the next one */
    fw_geometry_point a = p->vertex[i], b = p->vertex[i + 1 < p->count ? i + 1 : 0];
    return (step){(int64_t)b.x_dbu - a.x_dbu, (int64_t)b.y_dbu - a.y_dbu};
}

typedef struct sizes {
    size_t manhattan, octangular, any, change; /* bytes of types 2, 3, 4, 5 */
    bool all_manhattan, all_octangular;
} sizes;

static sizes measure(const fw_geometry_polygon *p) {
    sizes s = {.all_manhattan = true, .all_octangular = true};
    step before = {0, 0};
    for (int i = 0; i + 1 < p->count; i++) {
        step d = step_at(p, i);
        int direction = octant(d.dx, d.dy);
        s.all_manhattan = s.all_manhattan && direction >= 0 && direction < 4;
        s.all_octangular = s.all_octangular && direction >= 0;
        if (s.all_octangular) {
            s.manhattan += bytes_of(longer(d.dx, d.dy) << 2);
            s.octangular += bytes_of(longer(d.dx, d.dy) << 3);
        }
        s.any += displacement_bytes(d.dx, d.dy);
        s.change += displacement_bytes(d.dx - before.dx, d.dy - before.dy);
        before = d;
    }
    return s;
}

/* every edge along an axis, in turn: 0 starts along x, 1 along y, -1 not so */
static int alternating(const fw_geometry_polygon *p) {
    if (p->count % 2) return -1;
    int first = step_at(p, 0).dy == 0 ? 0 : 1;
    for (int i = 0; i < p->count; i++) {
        step d = step_at(p, i);
        if ((i + first) % 2 == 0 ? d.dy != 0 : d.dx != 0) return -1;
    }
    return first;
}

static unsigned char *put_alternating(unsigned char *at, const fw_geometry_polygon *p, int first) {
    *at++ = (unsigned char)first;
    at = fw_octets_put(at, (uint64_t)p->count - 2); /* the reader adds the last corner */
    for (int i = 0; i + 2 < p->count; i++) {
        step d = step_at(p, i);
        at = fw_octets_put(at, fw_octets_folded(d.dx + d.dy));
    }
    return at;
}

static unsigned char *put_steps(unsigned char *at, const fw_geometry_polygon *p, int type) {
    *at++ = (unsigned char)type;
    at = fw_octets_put(at, (uint64_t)p->count - 1);
    step before = {0, 0};
    for (int i = 0; i + 1 < p->count; i++) {
        step d = step_at(p, i);
        unsigned direction = type < 4 ? (unsigned)octant(d.dx, d.dy) : 0;
        if (type < 4)
            at = fw_octets_put(at, longer(d.dx, d.dy) << type | direction);
        else
            at = fw_mask_octets_displacement(at, d.dx - before.dx, d.dy - before.dy);
        if (type == 5) before = d;
    }
    return at;
}

/* Point list of the fewest bytes. In: n >= 3 vertices on the grid, |coordinate| < 2^30. Types: 0
   and 1 lengths along x and y in turn, 2 and 3 length and one of four or eight directions, 4 any
   displacement, 5 change of the displacement (short for chords of one arc: about 8 eps instead of
   the chord). Exact: integers. Cost O(n). Source: SEMI P39, 7.7. Test: test_oasis.c. */
void fw_mask_octets_points(fw_mask_octets *o, const fw_geometry_polygon *p) {
    size_t most = 2 * FW_OCTETS_INTEGER * (size_t)p->count + FW_OCTETS_INTEGER + 1;
    if (!fw_mask_octets_room(o, most)) return;
    unsigned char *at = o->data + o->length;
    int first = alternating(p);
    if (first >= 0) {
        at = put_alternating(at, p, first);
    } else {
        sizes s = measure(p);
        int type = s.change < s.any ? 5 : 4;
        size_t least = s.change < s.any ? s.change : s.any;
        if (s.all_octangular && s.octangular <= least) type = 3, least = s.octangular;
        if (s.all_manhattan && s.manhattan <= least) type = 2;
        at = put_steps(at, p, type);
    }
    o->length = (size_t)(at - o->data);
}
