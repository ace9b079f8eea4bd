/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Binary STL: 80 bytes of text, the number of triangles, and 50 bytes for each: normal and three
   corners as floats, two bytes of nothing; little-endian. 1 unit = 1 um. Source: 3D Systems,
   StereoLithography Interface Specification, 1989. */
#include "mask/solid.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { HEAD = 80, FACET = 50 };

typedef struct corner {
    double x, y, z; /* um */
} corner;

static unsigned char *put_u32(unsigned char *at, uint32_t v) {
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(v >> 8 * i & 0xff);
    return at + 4;
}

static unsigned char *put_float(unsigned char *at, double value) {
    float f = (float)value;
    uint32_t v;
    memcpy(&v, &f, sizeof v);
    return put_u32(at, v);
}

static unsigned char *put_corner(unsigned char *at, corner c) {
    return put_float(put_float(put_float(at, c.x), c.y), c.z);
}

static corner place(fw_geometry_point p, double z) {
    return (corner){1e-3 * p.x_dbu, 1e-3 * p.y_dbu, z};
}

static unsigned char *facet(unsigned char *at, corner a, corner b, corner c) {
    corner u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
    corner n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    double length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    at = put_corner(at, (corner){n.x / length, n.y / length, n.z / length});
    at = put_corner(put_corner(put_corner(at, a), b), c);
    at[0] = at[1] = 0;
    return at + 2;
}

static unsigned char *piece(unsigned char *at, const fw_mask_solid_piece *s, double top_um) {
    const fw_geometry_polygon *p = &s->polygon;
    for (int i = 0; i < p->count - 2; i++) {
        const int *v = s->triangle[i].vertex;
        fw_geometry_point a = p->vertex[v[0]], b = p->vertex[v[1]], c = p->vertex[v[2]];
        at = facet(at, place(a, top_um), place(b, top_um), place(c, top_um));
        at = facet(at, place(a, 0), place(c, 0), place(b, 0));
    }
    for (int i = 0; i < p->count; i++) {
        if (!s->wall[i]) continue;
        fw_geometry_point a = p->vertex[i], b = p->vertex[i + 1 < p->count ? i + 1 : 0];
        at = facet(at, place(a, 0), place(b, 0), place(b, top_um));
        at = facet(at, place(a, 0), place(b, top_um), place(a, top_um));
    }
    return at;
}

fw_status fw_mask_write_stl(const fw_mask *mask, fw_text *out) {
    fw_mask_solid solid;
    FW_TRY(fw_mask_solid_build(out->arena, mask, &solid));
    unsigned char *at = fw_text_room(out, HEAD + 4 + FACET * (size_t)solid.triangles);
    if (!at) return FW_NOMEM;
    memset(at, ' ', HEAD);
    char text[HEAD + 1]; /* a text STL begins with "solid": not this one */
    int n =
        snprintf(text, sizeof text, "%s1 unit = 1 um; %s; %s", mask->rejected ? "REJECTED; " : "",
                 mask->thickness_m > 0 ? "walls vertical" : "THICKNESS NOT KNOWN", mask->cell);
    memcpy(at, text, n < HEAD ? (size_t)n : HEAD);
    at = put_u32(at + HEAD, (uint32_t)solid.triangles);
    for (int i = 0; i < solid.npiece; i++)
        at = piece(at, &solid.piece[i], 1e6 * solid.thickness_m);
    return fw_text_end(out);
}
