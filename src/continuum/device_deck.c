/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the mechanism as the engine has it to solids. */
#include "continuum/continuum.h"
#include "continuum/solver.h"
#include "effects/effects.h"
#include "mechanism/mechanism.h"
#include <math.h>
#include <stdio.h>

static fw_status refused(fw_diags *diags, fw_place place, const char *why) {
    fw_diag_error(diags, 213, place,
                  "the mechanism cannot be written as solid flexures and rigid bodies: %s", why);
    return FW_GEOMETRY;
}

/* whatever the scene calls for is either in the solids, or has no part in them, or is refused by
 * name */
static fw_status effects_fit(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                             fw_diags *diags) {
    size_t count;
    const fw_effect_row *const *effect = fw_effect_rows(&count);
    const fw_effect_case asked = {.arena = arena, .mechanism = m, .scene = s};
    for (size_t i = 0; i < count; i++) {
        if (effect[i]->solid != FW_EFFECTS_SOLID_REFUSED || !effect[i]->called_for(&asked))
            continue;
        const char *why = fw_arena_printf(arena, "the scene has %s (%s), which solids do not have",
                                          effect[i]->id, effect[i]->summary);
        FW_NEED(why);
        return refused(diags, s->place, why);
    }
    return FW_OK;
}

static fw_status representable(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                               fw_diags *diags) {
    const fw_place none = {0};
    if (m->nhinge < 1) return refused(diags, none, "it has no flexure");
    if (m->nhinge != m->npin) return refused(diags, none, "some of its joints are no flexures");
    if (m->njoint > 0 || m->ndriver > 0 || m->nspring > 0)
        return refused(diags, none, "it has sliders, rods, welds, drivers or springs");
    for (int p = 0; p < m->npin; p++)
        if (m->pin[p].free_angle_rad != 0.0)
            return refused(diags, none, "a joint is strained in the drawn pose (free angle)");
    for (int h = 0; h < m->nhinge; h++)
        if (fw_flexure_input_varies(&m->hinge[h].input))
            return refused(diags, m->device->flexure[m->hinge[h].flexure].place,
                           "a flexure is a path, or its width varies");
    return s ? effects_fit(arena, m, s, diags) : FW_OK;
}

static void hinge_of(const fw_mechanism *m, int h, fw_continuum_solid_hinge *to) {
    const fw_mechanism_hinge *hinge = &m->hinge[h];
    const fw_mechanism_pin *pin = &m->pin[hinge->pin];
    fw_continuum_shape_of(&hinge->input, &to->shape);
    /* W of the closed form lies at the pin, as in the layout */
    double W = to->shape.centre_x_m, c = cos(hinge->axis_rad), s = sin(hinge->axis_rad);
    fw_geometry_vec2 at = fw_mechanism_pin_place(m, pin, 0);
    to->id = pin->id;
    to->pose = (fw_geometry_pose){at.x - W * c, at.y - W * s, hinge->axis_rad};
    to->first = hinge->first_is_a ? pin->body_a : pin->body_b;
    to->second = hinge->first_is_a ? pin->body_b : pin->body_a;
}

fw_continuum_material fw_continuum_material_of(const fw_mechanism *m,
                                               const fw_mechanism_hinge *hinge) {
    const fw_flexure_input *in = &hinge->input;
    const fw_device_material *of = &m->variant->material;
    if (!in->crystal.known || !in->crystal.aligned)
        return (fw_continuum_material){.youngs_Pa = in->youngs_Pa, .poisson = in->poisson};
    return (fw_continuum_material){.cubic = true,
                                   .c11_Pa = of->c11.value,
                                   .c12_Pa = of->c12.value,
                                   .c44_Pa = of->c44.value,
                                   .crystal_rad =
                                       -0.25 * atan2(in->crystal.sin4, in->crystal.cos4)};
}

/* what all hinges are made of; of a crystal with [100] where it lies in the wafer */
static fw_continuum_material material_of(const fw_mechanism *m) {
    const fw_device_material *of = &m->variant->material;
    fw_continuum_material material = {.youngs_Pa = of->youngs.value, .poisson = of->poisson.value};
    if (m->nhinge > 0) material = fw_continuum_material_of(m, &m->hinge[0]);
    if (material.cubic) material.crystal_rad = m->variant->orientation_rad;
    return material;
}

static double factor_at_end(const fw_quantity_law *law, double duration_s) {
    double value[3] = {1.0, 0.0, 0.0};
    if (law) fw_quantity_law_value(law, duration_s, duration_s, value);
    return value[0];
}

fw_status fw_continuum_solid_device_of(fw_arena *arena, const fw_mechanism *m,
                                       const fw_device_scene *scene, fw_diags *diags,
                                       fw_continuum_solid_device *device) {
    FW_TRY(representable(arena, m, scene, diags));
    *device = (fw_continuum_solid_device){
        .nhinge = m->nhinge, .nbody = m->nbody, .material = material_of(m)};
    int nforce = scene ? scene->nforce : 0;
    FW_NEED(device->hinge = fw_arena_array(arena, fw_continuum_solid_hinge, (size_t)m->nhinge));
    FW_NEED(device->body = fw_arena_array(arena, fw_continuum_solid_body, (size_t)m->nbody));
    FW_NEED(device->force = fw_arena_array(arena, fw_continuum_solid_force, (size_t)nforce));
    for (int h = 0; h < m->nhinge; h++)
        hinge_of(m, h, &device->hinge[h]);
    for (int b = 0; b < m->nbody; b++)
        device->body[b] = (fw_continuum_solid_body){
            .id = m->body[b].id, .x_m = m->body[b].x_m, .y_m = m->body[b].y_m};
    for (int i = 0; i < nforce; i++) {
        const fw_device_force *f = &scene->force[i];
        if (f->body < 0) continue;
        fw_geometry_vec2 at = fw_mechanism_local_place(m, f->body, f->x_m, f->y_m);
        double share = factor_at_end(f->law, scene->duration_s);
        device->force[device->nforce++] =
            (fw_continuum_solid_force){f->body, at.x, at.y, share * f->fx_N, share * f->fy_N};
    }
    for (int i = 0; scene && i < scene->ntorque; i++) {
        const fw_device_torque *t = &scene->torque[i];
        if (t->body < 0) continue;
        device->body[t->body].moment_Nm += factor_at_end(t->law, scene->duration_s) * t->value_Nm;
    }
    return FW_OK;
}

typedef struct numbered {    /* meshes and where their numbers begin */
    fw_continuum_mesh *mesh; /* (nhinge) */
    int *node, *element;     /* (nhinge) */
    int reference;           /* of body b: reference + 2 b, rotation: one more */
    int force;               /* of force f: force + f */
    int nnode, nelement;
} numbered;

static fw_status mesh_all(fw_arena *arena, const fw_continuum_solid_device *d,
                          const fw_continuum_solid_options *o, fw_diags *diags, numbered *n) {
    double refinement = o->refinement > 0.0 ? o->refinement : 0.5;
    FW_TRY(fw_continuum_usable(&d->material, refinement, (fw_place){0}, diags));
    FW_NEED(n->mesh = fw_arena_array(arena, fw_continuum_mesh, (size_t)d->nhinge));
    FW_NEED(n->node = fw_arena_array(arena, int, (size_t)d->nhinge));
    FW_NEED(n->element = fw_arena_array(arena, int, (size_t)d->nhinge));
    n->nnode = n->nelement = 0;
    for (int h = 0; h < d->nhinge; h++) {
        FW_TRY(fw_continuum_good_mesh(arena, &d->hinge[h].shape, refinement, o->plane_stress,
                                      (fw_place){0}, diags, &n->mesh[h]));
        n->node[h] = n->nnode + 1, n->element[h] = n->nelement + 1;
        n->nnode += n->mesh[h].nnode, n->nelement += n->mesh[h].nelement;
    }
    n->reference = n->nnode + 1;
    n->force = n->reference + 2 * d->nbody;
    return FW_OK;
}

static void point(fw_text *deck, int number, double x_m, double y_m) {
    fw_text_printf(deck, "%d, ", number);
    fw_continuum_deck_number(deck, 1e6 * x_m);
    fw_text_add(deck, ", ");
    fw_continuum_deck_number(deck, 1e6 * y_m);
    fw_text_add(deck, ", 0\n");
}

static void nodes_and_bricks(fw_text *deck, const fw_continuum_solid_device *d, const numbered *n) {
    for (int h = 0; h < d->nhinge; h++) {
        fw_text_printf(deck, "** flexure %s\n*NODE\n", d->hinge[h].id);
        fw_continuum_deck_nodes(deck, &n->mesh[h], d->hinge[h].pose, n->node[h]);
    }
    fw_text_add(deck, "** bodies: a point, then its rotation\n*NODE, NSET=NREF\n");
    for (int b = 0; b < d->nbody; b++)
        for (int k = 0; k < 2; k++)
            point(deck, n->reference + 2 * b + k, d->body[b].x_m, d->body[b].y_m);
    if (d->nforce > 0) fw_text_add(deck, "** where forces act\n*NODE\n");
    for (int f = 0; f < d->nforce; f++)
        point(deck, n->force + f, d->force[f].x_m, d->force[f].y_m);
    for (int h = 0; h < d->nhinge; h++) {
        fw_text_printf(deck, "*ELEMENT, TYPE=C3D20R, ELSET=E%d\n", h + 1);
        fw_continuum_deck_bricks(deck, &n->mesh[h], n->node[h], n->element[h]);
    }
}

static void sets_and_sections(fw_text *deck, const fw_continuum_solid_device *d,
                              const numbered *n) {
    fw_text_add(deck, "*NSET, NSET=MIDDLE\n");
    for (int h = 0; h < d->nhinge; h++)
        fw_continuum_deck_set(deck, &n->mesh[h], n->node[h], fw_continuum_deck_middle);
    fw_text_add(deck, "*NSET, NSET=FIELD\n");
    for (int h = 0; h < d->nhinge; h++)
        fw_continuum_deck_set(deck, &n->mesh[h], n->node[h], fw_continuum_deck_field);
    for (int b = -1; b < d->nbody; b++) {
        fw_text_printf(deck, "** %s\n*NSET, NSET=B%d\n", b < 0 ? "ground" : d->body[b].id, b + 1);
        for (int h = 0; h < d->nhinge; h++) {
            if (d->hinge[h].first == b)
                fw_continuum_deck_set(deck, &n->mesh[h], n->node[h], fw_continuum_deck_root_first);
            if (d->hinge[h].second == b)
                fw_continuum_deck_set(deck, &n->mesh[h], n->node[h], fw_continuum_deck_root_second);
        }
        for (int f = 0; f < d->nforce; f++)
            if (d->force[f].body == b) fw_text_printf(deck, "%d\n", n->force + f);
    }
    for (int h = 0; h < d->nhinge; h++) {
        char name[24], set[24];
        snprintf(name, sizeof name, "M%d", h + 1);
        snprintf(set, sizeof set, "E%d", h + 1);
        fw_continuum_deck_material(deck, &d->material, name, set, 0.0);
    }
}

static void constraints(fw_text *deck, const fw_continuum_solid_device *d, const numbered *n) {
    for (int b = 0; b < d->nbody; b++)
        fw_text_printf(deck, "*RIGID BODY, NSET=B%d, REF NODE=%d, ROT NODE=%d\n", b + 1,
                       n->reference + 2 * b, n->reference + 2 * b + 1);
    fw_text_add(deck, "** the upper half of the depth is meshed; its middle plane stays plane\n"
                      "*BOUNDARY\nB0, 1, 3\nMIDDLE, 3, 3\n");
    for (int b = 0; b < d->nbody; b++)
        fw_text_printf(deck, "%d, 3, 3\n%d, 1, 2\n", n->reference + 2 * b,
                       n->reference + 2 * b + 1);
}

static void load(fw_text *deck, int node, int axis, double value) {
    fw_text_printf(deck, "%d, %d, ", node, axis);
    fw_continuum_deck_number(deck, value);
    fw_text_add(deck, "\n");
}

/* `share`: of the depth that is meshed, half of it in reality */
static void step(fw_text *deck, const fw_continuum_solid_device *d,
                 const fw_continuum_solid_options *o, const numbered *n, double share) {
    fw_text_add(
        deck,
        "** 1e-6 as for one flexure does not converge where bodies are free; these take small "
        "increments, too\n"
        "*STEP, NLGEOM, INC=1000\n*STATIC, SOLVER=SPOOLES\n");
    fw_continuum_deck_number(deck, 1.0 / (o->increments > 0 ? o->increments : 20));
    fw_text_add(deck, ", 1, 1e-5, 1\n*CONTROLS, PARAMETERS=FIELD\n1e-4, 1e-4, , , 1e-4\n");
    for (int b = 0; b < d->nbody; b++)
        if (d->body[b].driven) {
            fw_text_add(deck, "*BOUNDARY\n");
            fw_text_printf(deck, "%d, 3, 3, ", n->reference + 2 * b + 1);
            fw_continuum_deck_number(deck, d->body[b].rotation_rad);
            fw_text_add(deck, "\n");
        } else if (d->body[b].moment_Nm != 0.0) {
            fw_text_add(deck, "*CLOAD\n");
            load(deck, n->reference + 2 * b + 1, 3, 1e12 * share * d->body[b].moment_Nm);
        }
    for (int f = 0; f < d->nforce; f++) {
        fw_text_add(deck, "*CLOAD\n");
        load(deck, n->force + f, 1, 1e6 * share * d->force[f].fx_N);
        load(deck, n->force + f, 2, 1e6 * share * d->force[f].fy_N);
    }
    fw_text_add(deck, "*NODE PRINT, NSET=NREF, FREQUENCY=1000\nU, RF\n"
                      "*NODE FILE, NSET=FIELD, FREQUENCY=1000\nU\n"
                      "*EL FILE, NSET=FIELD, FREQUENCY=1000\nS, E\n*END STEP\n");
}

static fw_status write_deck(const fw_continuum_solid_device *d, const fw_continuum_solid_options *o,
                            const numbered *n, fw_text *deck) {
    double share = 0.5 * n->mesh[0].depth_m / d->hinge[0].shape.depth_m;
    fw_continuum_deck_head(deck, "mechanism of solid flexures and rigid bodies");
    nodes_and_bricks(deck, d, n);
    sets_and_sections(deck, d, n);
    constraints(deck, d, n);
    step(deck, d, o, n, share);
    return fw_text_end(deck);
}

static fw_status no_deck(fw_diags *diags, const char *why) {
    fw_diag_error(diags, 213, (fw_place){0}, "the mechanism cannot be meshed: %s", why);
    return FW_GEOMETRY;
}

/* bodies that nothing holds would leave a singular matrix */
static fw_status complete(const fw_continuum_solid_device *d, const fw_continuum_solid_options *o,
                          fw_diags *diags) {
    if (d->nhinge < 1 || d->nbody < 1) return no_deck(diags, "it has no flexure or no body");
    if (2 * d->nbody > FW_RESULT_NODES) return no_deck(diags, "it has too many bodies");
    for (int b = 0; b < d->nbody; b++) {
        bool held = false;
        for (int h = 0; h < d->nhinge; h++)
            held = held || d->hinge[h].first == b || d->hinge[h].second == b;
        if (!held) return no_deck(diags, "no flexure holds one of its bodies");
    }
    for (int h = 0; h < d->nhinge; h++)
        if (!(d->hinge[h].shape.depth_m == d->hinge[0].shape.depth_m) ||
            (o->plane_stress && d->hinge[h].shape.width_m != d->hinge[0].shape.width_m))
            return no_deck(diags, "its flexures differ in depth, or in width where a thin layer "
                                  "stands for plane stress");
    return FW_OK;
}

fw_status fw_continuum_solid_deck(fw_arena *arena, const fw_continuum_solid_device *device,
                                  const fw_continuum_solid_options *options, fw_diags *diags,
                                  fw_text *deck) {
    numbered n;
    FW_TRY(complete(device, options, diags));
    FW_TRY(mesh_all(arena, device, options, diags, &n));
    return write_deck(device, options, &n, deck);
}

static fw_status solve(fw_arena *scratch, const char *program, const fw_continuum_solid_device *d,
                       const fw_continuum_solid_options *o, fw_diags *diags,
                       fw_continuum_solid_result *r) {
    numbered n;
    fw_text deck = fw_text_new(scratch);
    fw_continuum_solver_result *out;
    int node[FW_RESULT_NODES];
    FW_NEED(out = fw_arena_one(scratch, fw_continuum_solver_result));
    FW_TRY(mesh_all(scratch, d, o, diags, &n));
    FW_TRY(write_deck(d, o, &n, &deck));
    for (int i = 0; i < 2 * d->nbody; i++)
        node[i] = n.reference + i;
    const fw_continuum_solver_call call = {.program = program,
                                           .deck = &deck,
                                           .node = node,
                                           .nnode = 2 * d->nbody,
                                           .nstep = 1,
                                           .timeout_s = o->timeout_s};
    FW_TRY(fw_continuum_solver_run(scratch, &call, diags, out));
    double share = 0.5 * n.mesh[0].depth_m / d->hinge[0].shape.depth_m;
    for (int b = 0; b < d->nbody; b++) {
        const double *move = out->step[0].move[2 * b], *turn = out->step[0].move[2 * b + 1];
        r->body[b] = (fw_continuum_solid_pose){1e-6 * move[0], 1e-6 * move[1], turn[2],
                                               1e-12 * out->step[0].force[2 * b + 1][2] / share};
        if (!d->body[b].driven) r->body[b].moment_Nm = d->body[b].moment_Nm;
    }
    r->strain = out->strain[0].principal;
    for (int h = 0; h < d->nhinge; h++)
        if (out->strain[0].node >= n.node[h]) r->strain_hinge = h;
    r->cpu_s = out->cpu_s;
    r->mesh = (fw_continuum_mesh_size){n.nelement, n.nnode};
    return FW_OK;
}

fw_status fw_continuum_solid_solve(fw_arena *arena, const fw_continuum_solid_device *device,
                                   const fw_continuum_solid_options *options, fw_diags *diags,
                                   fw_continuum_solid_result *result) {
    *result = (fw_continuum_solid_result){.strain_hinge = 0};
    FW_TRY(complete(device, options, diags));
    const char *program;
    FW_TRY(fw_continuum_program(arena, "ccx", &program));
    if (!program) {
        result->missing = fw_continuum_install;
        fw_diag_note(diags, 214, (fw_place){0}, "%s", fw_continuum_install);
        return FW_OK;
    }
    result->installed = true;
    FW_NEED(result->body = fw_arena_array(arena, fw_continuum_solid_pose, (size_t)device->nbody));
    fw_arena *scratch = fw_arena_part(arena, (size_t)2 << 30);
    FW_NEED(scratch);
    fw_status status = solve(scratch, program, device, options, diags, result);
    fw_arena_free(scratch);
    return status;
}
