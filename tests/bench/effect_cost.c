/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One right-hand side of a scene again and again, for instruction counts (tests/build/effects.py):

     valgrind --tool=callgrind --toggle-collect=measured --dump-after=measured \
       ./effect_cost FILE SCENE COUNT [options] [--then FILE SCENE COUNT [options]]...

   --off ID       as if the scene did not call for this effect; at most twice
   --pins         hinges stay pins, whatever is known of their strips
   --general      the code for all joints and effects, even where the fast kernel would do
   --stir SIZE    how far the state is from the assembled pose, scaled; default 0.01
   --still        velocities 0: what sticks, sticks
   ./effect_cost --list   the effects of this build: id, instructions as stated */
#include "effects/effect.h"
#include "layout/layout.h"
#include "multibody/system.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct request {
    const char *file, *scene, *off[2];
    long count;
    bool general, still;
    bool pins; /* hinges are taken as such, whatever their strips */
    double stir;
} request;

static void fail(const char *what) {
    fprintf(stderr, "effect_cost: %s\n", what);
    exit(1);
}

static void need(fw_status status, const fw_diags *diags, const char *what) {
    if (status == FW_OK) return;
    for (size_t i = 0; i < diags->count; i++)
        fprintf(stderr, "%s\n", diags->item[i].message);
    fail(what);
}

static char *read_all(fw_arena *arena, const char *name, size_t *n) {
    FILE *file = fopen(name, "rb");
    size_t room = (size_t)1 << 20;
    char *text = fw_arena_array(arena, char, room);
    if (!file || !text) fail(name);
    *n = fread(text, 1, room - 1, file);
    fclose(file);
    return text;
}

/* the material of the description, at 50 um where it states no thickness */
static fw_mechanism_variant variant_of(fw_arena *arena, const fw_device *d, fw_diags *diags) {
    fw_mechanism_variant v = {.thickness_m = 1,
                              /* what a flow may leave on surfaces that a scene closes */
                              .drying = {.adhesion_words = "stated", .adhesion_high = 0.05},
                              .explicit_mass_scale = 1,
                              .explicit_stiffness_scale = 1,
                              .explicit_damping_scale = 1};
    fw_device_materials all;
    size_t n;
    if (!d->material_ref) return v;
    const char *file = FW_SOURCE_DATA_DIR "/processes/base.xml", *xml = read_all(arena, file, &n);
    need(fw_device_materials_read(arena, file, xml, n, diags, &all), diags, file);
    const fw_device_material *found = fw_device_material_find(&all, d->material_ref);
    if (!found) fail("unknown material");
    v.material = fw_device_material_with(found, &d->material);
    v.thickness_m = isnan(d->thickness_m) ? 50e-6 : d->thickness_m;
    return v;
}

static const fw_mechanism *mechanism_of(fw_arena *arena, const fw_device *d, fw_diags *diags) {
    const fw_layout *layout = NULL;
    const fw_mechanism *m = NULL;
    fw_mechanism_variant *variant = fw_arena_one(arena, fw_mechanism_variant);
    if (!variant) fail("memory");
    *variant = variant_of(arena, d, diags);
    fw_diags drawing = fw_diags_new(arena);
    if (fw_layout_build(arena, d, &drawing, &layout) != FW_OK) layout = NULL;
    need(fw_mechanism_build(arena, d, layout, variant, diags, &m), diags, "mechanism");
    return m;
}

/* all that the scene calls for, but for one effect; says what that is */
static bool is_off(const char *const off[2], const char *id) {
    return (off[0] && strcmp(off[0], id) == 0) || (off[1] && strcmp(off[1], id) == 0);
}

static void compile(const fw_effect_case *c, const char *const off[2], bool pins, fw_effects_loads *loads) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    if (fw_effects_loads_new(c->arena, c->mechanism, c->scene, loads) != FW_OK) fail("memory");
    for (size_t i = 0; i < count; i++) {
        if (!row[i]->called_for(c)) continue;
        printf("calls %s %d\n", row[i]->id, row[i]->count ? row[i]->count(c) : 1);
        if (is_off(off, row[i]->id)) continue;
        if (pins && strcmp(row[i]->id, "nonlinear-hinge") == 0) continue;
        if (row[i]->add(c, loads) != FW_OK) fail(row[i]->id);
    }
}

static fw_multibody_system *system_of(fw_arena *arena, const fw_mechanism *mechanism,
                                      const fw_device_scene *scene, const request *r,
                                      fw_diags *diags) {
    const fw_effect_case c = {.arena = arena, .mechanism = mechanism, .scene = scene};
    fw_effects_loads *loads = fw_arena_one(arena, fw_effects_loads);
    double *q = fw_arena_array(arena, double, 3 * (size_t)mechanism->nbody);
    const fw_multibody_model *m;
    fw_multibody_system *sys;
    if (!loads || !q) fail("memory");
    compile(&c, r->off, r->pins, loads);
    for (int b = 0; b < mechanism->nbody; b++) {
        const fw_mechanism_mass *from = &mechanism->body[b];
        q[3 * b] = from->x_m, q[3 * b + 1] = from->y_m, q[3 * b + 2] = from->phi_rad;
    }
    need(fw_effects_strain(arena, mechanism, loads, &mechanism), diags, "strains");
    need(fw_multibody_model_new(arena, mechanism, loads, q, scene->duration_s, NULL, &m), diags,
         "model");
    need(fw_multibody_system_new(arena, m, mechanism, diags, &sys), diags, "system");
    if (r->general) sys->kernel = NULL;
    sys->piece_s = 0.4 * scene->duration_s;
    return sys;
}

/* of two states in turn: what a hinge keeps of its last pose is of no use to the next, as in a motion */
void measured(fw_multibody_system *sys, double t, const double *const y[2], double *f, long count);
__attribute__((noinline)) void measured(fw_multibody_system *sys, double t, const double *const y[2],
                                        double *f, long count) {
    for (long i = 0; i < count; i++)
        fw_multibody_rhs(sys, t, y[i & 1], f);
}

static void run(fw_multibody_system *sys, double t, const request *r, fw_arena *arena) {
    const fw_multibody_model *m = sys->model;
    double *y = fw_arena_array(arena, double, (size_t)m->ny), sum = 0;
    double *f = fw_arena_array(arena, double, (size_t)m->ny);
    double *beside = fw_arena_array(arena, double, (size_t)m->ny);
    uint64_t z = 5;
    if (!y || !f || !beside) fail("memory");
    for (int i = 0; i < 2 * m->nq; i++) {
        z = z * 6364136223846793005u + 1442695040888963407u;
        y[i] = r->still && i >= m->nq ? 0 : r->stir * ((double)(z >> 11) * 0x1p-53 - 0.5);
    }
    fw_multibody_set_switches(sys, 0, y);
    fw_multibody_friction_begin(sys);
    if (!fw_multibody_friction_decide(sys, t / m->scale.time_s, y)) fail("friction jams");
    for (int i = 0; i < m->ny; i++)
        beside[i] = y[i] * (1 + 1e-12);
    const double *const both[2] = {y, beside};
    measured(sys, t / m->scale.time_s, both, f, r->count);
    for (int i = 0; i < 2 * m->nq; i++)
        sum += fabs(f[i]);
    printf("kernel %s\nsum %.17g\n", sys->kernel ? "yes" : "no", sum);
}

static int list(void) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    for (size_t i = 0; i < count; i++)
        printf("%s %.9g\n", row[i]->id, row[i]->cost);
    return 0;
}

/* from argv[*at] on, up to --then */
static request request_of(int argc, char **argv, int *at) {
    if (*at + 3 > argc) fail("FILE SCENE COUNT [options] [--then ...], or --list");
    request r = {.file = argv[*at],
                 .scene = argv[*at + 1],
                 .count = strtol(argv[*at + 2], NULL, 10),
                 .stir = 0.01};
    int i = *at + 3;
    for (; i < argc && strcmp(argv[i], "--then") != 0; i++)
        if (strcmp(argv[i], "--general") == 0)
            r.general = true;
        else if (strcmp(argv[i], "--pins") == 0)
            r.pins = true;
        else if (strcmp(argv[i], "--still") == 0)
            r.still = true;
        else if (strcmp(argv[i], "--off") == 0 && i + 1 < argc)
            r.off[r.off[0] != NULL] = argv[++i];
        else if (strcmp(argv[i], "--stir") == 0 && i + 1 < argc)
            r.stir = strtod(argv[++i], NULL);
        else
            fail("unknown option");
    *at = i + 1;
    return r;
}

typedef struct opened { /* the last file: scenes of one file follow each other */
    fw_arena *arena;
    const char *file;
    const fw_device *device;
    const fw_mechanism *mechanism;
} opened;

static void open_file(opened *o, const char *file) {
    if (o->arena && strcmp(o->file, file) == 0) return;
    if (o->arena) fw_arena_free(o->arena);
    *o = (opened){.arena = fw_arena_new(0), .file = file};
    fw_diags diags = fw_diags_new(o->arena);
    size_t n;
    const char *xml = read_all(o->arena, file, &n);
    need(fw_device_read(o->arena, file, xml, n, NULL, 0, &diags, &o->device), &diags, file);
    o->mechanism = mechanism_of(o->arena, o->device, &diags);
}

static void serve(const request *r, const opened *o) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const fw_device_scene *scene = NULL;
    printf("scene %s %s\n", r->file, r->scene);
    for (int i = 0; i < o->device->nscene; i++)
        if (strcmp(o->device->scene[i].name, r->scene) == 0) scene = &o->device->scene[i];
    if (!scene) fail("no such scene");
    fw_multibody_system *sys = system_of(arena, o->mechanism, scene, r, &diags);
    run(sys, 0.4 * scene->duration_s, r, arena);
    fw_arena_free(arena);
}

int main(int argc, char **argv) {
    if (argc == 2 && strcmp(argv[1], "--list") == 0) return list();
    opened file = {0};
    for (int at = 1; at < argc || at == 1;) {
        const request r = request_of(argc, argv, &at);
        open_file(&file, r.file);
        serve(&r, &file);
    }
    fw_arena_free(file.arena);
    return 0;
}
