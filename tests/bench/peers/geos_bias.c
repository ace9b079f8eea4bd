/* SPDX-License-Identifier: GPL-3.0-or-later */
/* geos_bias INPUT.f64 OUTPUT.bin: GEOS's side of tests/bench/mask_peers.py. 1000 polygons of 1000
   vertices (pairs of doubles, um) moved outward by 1.5 um with mitred corners, each by itself, and
   rounded to 1 nm. OUTPUT: for each polygon its number of vertices and the pairs. Row: what, CPU
   ms, bytes. */
#include "../measure.h"
#include <geos_c.h>
#include <stdarg.h>
#include <stdint.h>

enum { HINGES = 1000, VERTICES = 1000, MOST = 4 * VERTICES };
static double in[HINGES][VERTICES][2];
static int32_t out[HINGES][MOST][2];
static int count[HINGES];

static void say(const char *format, ...) {
    va_list list;
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
}

static int bias_one(GEOSContextHandle_t g, int k) {
    double ring[VERTICES + 1][2];
    for (int i = 0; i <= VERTICES; i++)
        for (int c = 0; c < 2; c++)
            ring[i][c] = in[k][i % VERTICES][c];
    GEOSGeometry *p = GEOSGeom_createPolygon_r(
        g,
        GEOSGeom_createLinearRing_r(
            g, GEOSCoordSeq_copyFromBuffer_r(g, &ring[0][0], VERTICES + 1, 0, 0)),
        NULL, 0);
    GEOSGeometry *q =
        GEOSBufferWithStyle_r(g, p, 1.5, 8, GEOSBUF_CAP_FLAT, GEOSBUF_JOIN_MITRE, 5.0);
    const GEOSGeometry *shell = q ? GEOSGetExteriorRing_r(g, q) : NULL;
    unsigned n = 0;
    const GEOSCoordSequence *s = shell ? GEOSGeom_getCoordSeq_r(g, shell) : NULL;
    if (!s || !GEOSCoordSeq_getSize_r(g, s, &n) || n < 4 || n - 1 > MOST) return 0;
    count[k] = (int)n - 1;
    for (unsigned i = 0; i + 1 < n; i++) {
        double x, y;
        GEOSCoordSeq_getXY_r(g, s, i, &x, &y);
        out[k][i][0] = (int32_t)floor(x * 1e3 + .5);
        out[k][i][1] = (int32_t)floor(y * 1e3 + .5);
    }
    GEOSGeom_destroy_r(g, q);
    GEOSGeom_destroy_r(g, p);
    return 1;
}

static outcome once(void *context) {
    outcome o = {0};
    double start = cpu_seconds();
    for (int k = 0; k < HINGES; k++)
        if (!bias_one(context, k)) o.failed = "a polygon cannot be moved";
    o.cpu_s = cpu_seconds() - start;
    return o;
}

int main(int argc, char **argv) {
    FILE *file = argc == 3 ? fopen(argv[1], "rb") : NULL;
    if (!file || fread(in, sizeof in, 1, file) != 1) return 2;
    fclose(file);
    GEOSContextHandle_t g = GEOS_init_r();
    GEOSContext_setErrorHandler_r(g, say);
    outcome o = measure(once, g);
    GEOS_finish_r(g);
    printf("bias geos,%.6g,0\n", 1e3 * o.cpu_s);
    file = fopen(argv[2], "wb");
    if (!file || o.failed) return 1;
    for (int k = 0; k < HINGES; k++) {
        int32_t n = count[k];
        fwrite(&n, sizeof n, 1, file);
        fwrite(out[k], sizeof out[k][0], (size_t)n, file);
    }
    return fclose(file) != 0;
}
