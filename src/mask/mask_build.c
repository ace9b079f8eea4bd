/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/mask_parts.h"
#include "mask/mask.h"
#include "mask/rule.h"
#include <math.h>
#include <string.h>

static const double DEFAULT_TOLERANCE_M = 5e-9;
static const int32_t FARTHEST_DBU = 1 << 30;
enum { DEFAULT_VERTICES = 4094, LONGEST_NAME = 32 };
static const fw_place nowhere;

/* A-Za-z0-9_?$ and at most 32 characters: what every GDSII reader takes as a cell name */
static const char *cell_name(fw_arena *arena, const char *name, bool rejected) {
    const char *tail = rejected ? "_REJECTED" : "";
    size_t most = LONGEST_NAME - strlen(tail), n = strlen(name);
    char *cell = fw_arena_printf(arena, "%.*s%s", (int)(n < most ? n : most), name, tail);
    for (char *s = cell; s && *s; s++) {
        bool letter = (*s >= 'A' && *s <= 'Z') || (*s >= 'a' && *s <= 'z');
        if (!letter && !(*s >= '0' && *s <= '9') && *s != '_' && *s != '?' && *s != '$') *s = '_';
    }
    return cell && !*cell ? "DEVICE" : cell;
}

/* the shapes of all layers, of them `shape` is filled where it is given; how many there are */
static int list_shapes(const fw_layout *layout, const fw_mask_table *table, bool no_islands,
                       fw_mask_shape *shape) {
    int n = 0;
    for (int k = 0; k < table->nlayer; k++)
        for (int i = 0; i < layout->npiece; i++) {
            const fw_layout_piece *piece = &layout->piece[i];
            const fw_layout_cell *cell = fw_layout_cell_of(layout, piece);
            bool drawn = cell ? fw_mask_layer_named(table, cell->layer) == k
                              : (table->layer[k].roles & 1u << piece->role) != 0;
            if (!drawn) continue;
            if (no_islands && piece->body == FW_ISLAND) continue;
            if (shape)
                shape[n] = (fw_mask_shape){.layer = k, .piece = piece, .contour = piece->contour};
            n++;
        }
    return n;
}

static fw_status pick_shapes(fw_arena *arena, const fw_layout *layout, const fw_mask_table *table,
                             bool no_islands, fw_mask_shape **out, int *count) {
    *count = list_shapes(layout, table, no_islands, NULL);
    FW_NEED(*out = fw_arena_array(arena, fw_mask_shape, (size_t)*count));
    list_shapes(layout, table, no_islands, *out);
    return FW_OK;
}

static fw_geometry_vec2 middle_of(const fw_geometry_contour *c, int i) {
    if (i < 0 || i >= c->count) return (fw_geometry_vec2){(double)NAN, (double)NAN};
    const fw_geometry_segment *s = &c->segment[i];
    return (fw_geometry_vec2){0.5 * (s->a.x + s->b.x), 0.5 * (s->a.y + s->b.y)};
}

static fw_status refuse_bias(fw_arena *arena, const fw_layout *layout, fw_diags *diags,
                             const fw_mask_shape *shape, double bias_m, int i, int j) {
    char p[80], q[80], bias[32], need[32];
    const fw_geometry_contour *c = &shape->piece->contour;
    fw_mask_place_text(p, sizeof p, middle_of(c, i));
    fw_mask_place_text(q, sizeof q, middle_of(c, j));
    fw_number_text(bias, sizeof bias, bias_m * 1e6, 6);
    fw_number_text(need, sizeof need, fabs(2 * bias_m) * 1e6, 6);
    const char *cause = fw_mask_cause(arena, layout, middle_of(c, i));
    FW_NEED(cause);
    fw_diag_error(
        diags, 143, nowhere,
        "%s cannot take the bias of %s um per edge: its edges %d at %s and %d at %s would "
        "meet or vanish; keep them more than %s um apart and hollow radii above the bias%s",
        shape->piece->label, bias, i, p, j, q, need,
        *cause ? cause : ", or choose a flow with a smaller bias");
    return FW_OK;
}

static fw_status bias_shapes(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                             fw_diags *diags) {
    enum { TOLD = 3 }; /* one bias that is too large has as many as there are parts */
    size_t errors = diags->errors;
    int refused = 0;
    const fw_layout_cell *seen = NULL;
    bool cut = false;
    fw_mask_shape *shape = mask->shape;
    for (int k = 0; k < mask->nshape; k++) {
        double bias_m = fw_mask_layer_bias_m(mask, shape[k].layer);
        const fw_layout_cell *cell = fw_layout_cell_of(layout, shape[k].piece);
        if (bias_m == 0 || (cell && !cell->biased)) continue;
        if (cell && cell != seen) cut = fw_mask_cell_is_cut(mask, k);
        if (cell) seen = cell;
        if (cell && cut) continue; /* fw_mask_cells_bias */
        int i = -1, j = -1;
        fw_status status = fw_geometry_contour_offset(arena, &shape[k].piece->contour, bias_m,
                                                      &shape[k].contour, &i, &j);
        if (status != FW_GEOMETRY)
            FW_TRY(status);
        else if (refused++ < TOLD)
            FW_TRY(refuse_bias(arena, layout, diags, &shape[k], bias_m, i, j));
    }
    if (refused > TOLD)
        fw_diag_error(diags, 143, nowhere, "%d more parts cannot take it either", refused - TOLD);
    if (diags->failed) return FW_NOMEM;
    return diags->errors > errors ? FW_INPUT : FW_OK;
}

static fw_status check_range(const fw_mask_shape *shape, fw_diags *diags) {
    fw_geometry_box b = shape->box;
    double far = fmax(fmax(fabs(b.x0), fabs(b.x1)), fmax(fabs(b.y0), fabs(b.y1)));
    if (far < (FARTHEST_DBU - 1) * FW_GEOMETRY_GRID_M) return FW_OK;
    char number[32];
    return fw_diag_error(diags, 149, nowhere,
                         "%s reaches %s m from the origin; the limit of GDSII readers is 1.07 m; "
                         "place the device near the origin",
                         shape->piece->label, fw_number_text(number, sizeof number, far, 6));
}

/* parts that GDSII readers take; each is certified like the whole */
static fw_status cut(fw_arena *arena, fw_mask_shape *shape, int most, fw_diags *diags) {
    fw_status status = fw_mask_polygon_cut(arena, &shape->polygon, most, &shape->part,
                                           &shape->npart, &shape->cut_clear_dbu);
    bool simple = status == FW_OK;
    for (int i = 0; simple && shape->npart > 1 && i < shape->npart; i++) {
        fw_geometry_polygon_report report;
        FW_TRY(fw_geometry_polygon_check(arena, &shape->part[i], &report));
        simple = report.simple;
    }
    if (simple || (status != FW_OK && status != FW_GEOMETRY)) return status;
    return fw_diag_error(diags, 148, nowhere,
                         "%s has %d vertices, and no cut was found that leaves parts of at most "
                         "%d; choose a larger tolerance or divide the part",
                         shape->piece->label, shape->polygon.count, most);
}

static fw_status tell_wavy(const fw_mask_shape *shape, const fw_mask_wavy_arc *wavy,
                           double tolerance_m, fw_diags *diags) {
    char at[80], eps[32], next[32], radius[32], sweep[32];
    fw_mask_place_text(at, sizeof at, wavy->arc.a);
    double up_nm = ceil(wavy->next_m * 1e12) * 1e-3; /* to the next pm, so that it does */
    return fw_diag_error(
        diags, 136, nowhere,
        "%s: with a tolerance of %s nm its arc of radius %s um through %s deg at %s gets chords "
        "so short that rounding to the 1 nm grid can reverse the sense of its curvature; use a "
        "tolerance of %s nm, with one chord fewer on this arc, or of 1.42 nm or more, which is "
        "safe for every arc",
        shape->piece->label, fw_number_text(eps, sizeof eps, tolerance_m * 1e9, 6),
        fw_number_text(radius, sizeof radius, wavy->arc.radius * 1e6, 6),
        fw_number_text(sweep, sizeof sweep, fabs(wavy->arc.sweep_rad) * 180 / FW_PI, 4), at,
        fw_number_text(next, sizeof next, up_nm, 7));
}

/* would the outline be simple with the smallest tolerance that is safe for every arc? */
static fw_status is_simple_when_fine(fw_arena *arena, const fw_mask_shape *shape, bool *simple) {
    fw_mask_shape fine = *shape;
    fw_mask_wavy_arc wavy;
    fw_status status = fw_mask_flatten(arena, &fine, FW_SAFE_TOLERANCE_M, &wavy);
    *simple = false;
    if (status == FW_GEOMETRY) return FW_OK;
    FW_TRY(status);
    FW_TRY(fw_geometry_polygon_check(arena, &fine.polygon, &fine.report));
    *simple = fine.report.simple;
    return FW_OK;
}

static fw_status tell_touching(fw_arena *arena, const fw_layout *layout, const fw_mask_shape *shape,
                               double tolerance_m, fw_diags *diags) {
    const fw_geometry_polygon *p = &shape->polygon;
    const fw_geometry_polygon_report *r = &shape->report;
    fw_geometry_point v = p->vertex[r->bad_i >= 0 ? r->bad_i % p->count : 0];
    fw_geometry_vec2 place = {v.x_dbu * FW_GEOMETRY_GRID_M, v.y_dbu * FW_GEOMETRY_GRID_M};
    char at[80];
    bool fine = false;
    fw_mask_place_text(at, sizeof at, place);
    if (tolerance_m > FW_SAFE_TOLERANCE_M) FW_TRY(is_simple_when_fine(arena, shape, &fine));
    if (fine)
        return fw_diag_error(diags, 147, nowhere,
                             "%s: on the 1 nm grid its edges %d and %d touch at %s; with a "
                             "tolerance of 1.42 nm they do not, so choose a smaller one, or a "
                             "larger feature",
                             shape->piece->label, r->bad_i, r->bad_j, at);
    const char *cause = fw_mask_cause(arena, layout, place);
    FW_NEED(cause);
    return fw_diag_error(diags, 147, nowhere,
                         "%s: its edges %d and %d touch at %s, whatever the tolerance: its outline "
                         "has no room there%s",
                         shape->piece->label, r->bad_i, r->bad_j, at,
                         *cause ? cause : ", so move its parts or make them larger");
}

/* one shape: polygon, exact integer certificate, area against the exact outline */
static fw_status flatten(fw_arena *arena, const fw_layout *layout, fw_mask_shape *shape,
                         double tolerance_m, int most, fw_diags *diags) {
    FW_TRY(check_range(shape, diags));
    fw_mask_wavy_arc wavy;
    fw_status flat_status = fw_mask_flatten(arena, shape, tolerance_m, &wavy);
    if (wavy.there) return tell_wavy(shape, &wavy, tolerance_m, diags);
    FW_TRY(flat_status);
    const char *name = shape->piece->label;
    const fw_geometry_polygon *p = &shape->polygon;
    FW_TRY(fw_geometry_polygon_check(arena, p, &shape->report));
    if (!shape->report.simple) return tell_touching(arena, layout, shape, tolerance_m, diags);
    FW_TRY(cut(arena, shape, most, diags));
    shape->area_m2 = fw_geometry_contour_area_in(&shape->contour, shape->box);
    double flat =
        0.5 * (double)fw_geometry_polygon_area2(p) * FW_GEOMETRY_GRID_M * FW_GEOMETRY_GRID_M;
    shape->polygon_area_m2 = flat;
    if (fabs(flat - shape->area_m2) <= shape->bound_m2) return FW_OK;
    char got[32], want[32];
    return fw_diag_error(diags, 150, nowhere,
                         "%s: area %s um2 after flattening, %s um2 before, which is more than "
                         "flattening can change; this is an error of the program, please report it",
                         name, fw_number_text(got, sizeof got, flat * 1e12, 12),
                         fw_number_text(want, sizeof want, shape->area_m2 * 1e12, 12));
}

static fw_status flatten_all(fw_arena *arena, const fw_layout *layout, fw_mask_shape *shape,
                             int nshape, double tolerance_m, int most, fw_diags *diags) {
    bool wrong = false;
    for (int k = 0; k < nshape; k++) {
        fw_status status = flatten(arena, layout, &shape[k], tolerance_m, most, diags);
        if (status != FW_OK && status != FW_INPUT) return status;
        wrong = wrong || status == FW_INPUT;
    }
    return wrong ? FW_INPUT : FW_OK;
}

static void sum_up(fw_mask *mask, fw_mask_measure *measure) {
    for (int k = 0; k < mask->table->nlayer; k++)
        fw_mask_measure_start(&measure[k]);
    mask->box = (fw_geometry_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < mask->nshape; k++) {
        const fw_mask_shape *s = &mask->shape[k];
        fw_mask_measure *m = &measure[s->layer];
        fw_geometry_box b = s->box;
        mask->box = (fw_geometry_box){fmin(mask->box.x0, b.x0), fmin(mask->box.y0, b.y0),
                                      fmax(mask->box.x1, b.x1), fmax(mask->box.y1, b.y1)};
        if (s->polygon.count == 0) continue; /* rules are broken, and it could not be flattened */
        m->shapes++;
        m->vertices += s->polygon.count;
        m->area_m2 += s->area_m2;
        m->polygon_area_m2 += s->polygon_area_m2;
        m->bound_m2 += s->bound_m2;
        fw_mask_measure_add(m, s);
    }
    mask->measure = measure;
}

static fw_status check_options(const fw_mask_options *options, double tolerance_m,
                               fw_diags *diags) {
    char number[32];
    if (!(fabs(options->bias_m) <= 1e-3))
        return fw_diag_error(diags, 143, nowhere,
                             "the bias of %s m per edge is not below 1 mm; check its unit",
                             fw_number_text(number, sizeof number, options->bias_m, 6));
    if (!(tolerance_m >= FW_LEAST_TOLERANCE_M * (1 - 1e-12) &&
          tolerance_m <= FW_MOST_TOLERANCE_M * (1 + 1e-12)))
        return fw_diag_error(diags, 147, nowhere,
                             "the tolerance of %s nm is not between 0.36 nm (below it, rounding to "
                             "the grid makes every arc wavy) and 1000 nm, both included",
                             fw_number_text(number, sizeof number, tolerance_m * 1e9, 6));
    return FW_OK;
}

/* polygons and their proofs */
static fw_status prove(fw_arena *arena, const fw_layout *layout, fw_mask *m, fw_diags *diags) {
    FW_TRY(flatten_all(arena, layout, m->shape, m->nshape, m->tolerance_m, m->vertex_limit, diags));
    FW_TRY(fw_mask_check_joints(arena, m->shape, m->nshape, diags));
    fw_mask_check_corners(m->shape, m->nshape, diags);
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* Polygons, near edges of the outlines, and rules on what is written of these. Where rules are broken, what could not
   be flattened besides is told, but the rest is there to be looked at. */
static fw_status judge(fw_arena *arena, const fw_layout *layout, fw_mask *m,
                       fw_mask_measure *measure, fw_diags *diags) {
    fw_mask_rules rules = {.arena = arena,
                           .table = m->table,
                           .shape = m->shape,
                           .nshape = m->nshape,
                           .layout = layout,
                           .tolerance_m = m->tolerance_m};
    double *bias_m = fw_arena_array(arena, double, (size_t)m->table->nlayer);
    FW_NEED(rules.bias_m = bias_m);
    for (int k = 0; k < m->table->nlayer; k++)
        bias_m[k] = fw_mask_layer_bias_m(m, k);
    fw_status status = prove(arena, layout, m, diags);
    if (status != FW_OK && status != FW_INPUT && status != FW_GEOMETRY) return status;
    m->whole = status == FW_OK;
    FW_TRY(fw_mask_rules_start(&rules, measure)); /* reads what flattening wrote of necks */
    FW_TRY(fw_mask_rules_check(&rules, false));
    FW_TRY(fw_mask_rules_check(&rules, true));
    FW_TRY(fw_mask_rules_tell(&rules, diags, &m->nbroken));
    m->finding = rules.finding;
    m->nfinding = rules.nfinding;
    sum_up(m, measure);
    return m->nbroken ? FW_INPUT : status;
}

fw_status fw_mask_examine(fw_arena *arena, const fw_layout *layout, const fw_mask_table *table,
                          const char *device_name, const fw_mask_options *options, fw_diags *diags,
                          const fw_mask **mask) {
    double tolerance_m = options->tolerance_m == 0 ? DEFAULT_TOLERANCE_M : options->tolerance_m;
    FW_TRY(check_options(options, tolerance_m, diags));
    if (!layout->drawn)
        return fw_diag_error(diags, 151, nowhere, "there is nothing to draw: %s",
                             layout->why_not ? layout->why_not : "the mechanism has no shapes");
    fw_mask *m = fw_arena_one(arena, fw_mask);
    fw_mask_measure *measure = fw_arena_array(arena, fw_mask_measure, (size_t)table->nlayer);
    FW_NEED(m);
    FW_NEED(measure);
    m->table = table;
    m->flow = table->flow;
    m->device = device_name;
    m->title = options->title ? options->title : device_name;
    m->bias_m = options->bias_m;
    m->edges = options->edges;
    m->tolerance_m = tolerance_m;
    m->vertex_limit = options->vertex_limit ? options->vertex_limit : DEFAULT_VERTICES;
    m->note = options->note;
    m->nnote = options->nnote;
    FW_TRY(pick_shapes(arena, layout, table, options->no_islands, &m->shape, &m->nshape));
    if (m->nshape == 0)
        return fw_diag_error(diags, 151, nowhere,
                             "no layer of flow %s draws any of the %d pieces; give a layer of its "
                             "table the roles of these pieces",
                             table->flow, layout->npiece);
    m->placed = layout->cell;
    m->nplaced = layout->ncell;
    m->flattening = options->flattening;
    m->thickness_m = options->thickness_m;
    fw_mask_set_flattening(m->shape, m->nshape, options->flattening);
    m->layer_bias_m = options->layer_bias_m;
    FW_TRY(bias_shapes(arena, layout, m, diags));
    FW_TRY(fw_mask_join(arena, m->shape, m->nshape, diags));
    FW_TRY(fw_mask_cells_bias(arena, layout, m, diags));
    FW_TRY(fw_mask_cells_unite(arena, layout, m, diags));
    for (int k = 0; k < m->nshape; k++)
        m->shape[k].box = fw_geometry_contour_box(&m->shape[k].contour);
    fw_status status = judge(arena, layout, m, measure, diags);
    if (status != FW_OK && !(status == FW_INPUT && m->nbroken)) return status;
    m->wiring = options->wiring;
    fw_status wired = fw_mask_wiring_check(arena, layout, m, diags);
    if (wired != FW_OK && wired != FW_INPUT) return wired;
    if (status == FW_OK) status = wired;
    m->rejected = options->rejected || m->nbroken > 0;
    m->because = options->because;
    m->nbecause = options->nbecause;
    FW_NEED(m->cell = cell_name(arena, device_name, m->rejected));
    *mask = m;
    return status;
}

fw_status fw_mask_build(fw_arena *arena, const fw_layout *layout, const fw_mask_table *table,
                        const char *device_name, const fw_mask_options *options, fw_diags *diags,
                        const fw_mask **mask) {
    *mask = NULL;
    const fw_mask *m = NULL;
    FW_TRY(fw_mask_examine(arena, layout, table, device_name, options, diags, &m));
    *mask = m;
    return FW_OK;
}

/* The test die as a mask. */

/* the layer on which structure is drawn has the rules that the patterns keep */
static const fw_mask_layer *structure_layer(const fw_mask_table *table) {
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].roles & 1u << FW_ROLE_STRUCTURE) return &table->layer[k];
    return NULL;
}

fw_status fw_mask_frame_marks(fw_arena *arena, const fw_mask_table *table, const fw_layout *device,
                              const fw_layout **layout, fw_layout_no_room *no_room) {
    const fw_mask_layer *layer = structure_layer(table);
    double width = layer ? layer->min_width_m : 0, space = layer ? layer->min_space_m : 0;
    FW_TRY(fw_layout_content_on_frame(arena, device, table->pattern, table->npattern, width, space,
                                      layout, no_room));
    return fw_mask_contents_add(arena, table, *layout, layout);
}

static fw_layout_content_options content_options(const fw_mask_table *table,
                                                 const fw_mask_layer *layer, const char *title,
                                                 const fw_mask_coupon_options *options) {
    return (fw_layout_content_options){.die = options->die,
                                       .frame_m = options->frame_m,
                                       .lane_m = options->lane_m,
                                       .bias_m = options->mask.bias_m,
                                       .width_rule_m = layer->min_width_m,
                                       .space_rule_m = layer->min_space_m,
                                       .title = title,
                                       .flow = table->flow,
                                       .die_id = options->die_id,
                                       .file = layer->place.file};
}

static void widen(double *low, double *high, double by) {
    *low -= 0.5 * by;
    *high += 0.5 * by;
}

fw_status fw_mask_coupons_die(fw_arena *arena, const fw_mask_table *table,
                              const fw_mask_coupon_options *options, fw_geometry_box *die,
                              bool *found) {
    static const double STEP_M = 250e-6, MOST_M = 8e-3, LEVEL_M = 1e-9;
    const fw_mask_layer *layer = structure_layer(table);
    fw_mask_coupon_options tried = *options;
    fw_geometry_box *d = &tried.die;
    const double least_m = fmin(d->x1 - d->x0, d->y1 - d->y0);
    *found = false;
    while (layer && !*found && fmin(d->x1 - d->x0, d->y1 - d->y0) < least_m + MOST_M) {
        const double ahead_m = (d->x1 - d->x0) - (d->y1 - d->y0);
        if (ahead_m < LEVEL_M) widen(&d->x0, &d->x1, STEP_M);
        if (ahead_m > -LEVEL_M) widen(&d->y0, &d->y1, STEP_M);
        fw_mark mark = fw_arena_mark(arena);
        fw_diags quiet = fw_diags_new(arena);
        const fw_layout_content *content = NULL;
        fw_layout_content_options as = content_options(table, layer, table->flow, &tried);
        fw_status status =
            fw_layout_content_build(arena, table->pattern, table->npattern, &as, &quiet, &content);
        *found = status == FW_OK && content->nplaced == content->ncoupon;
        fw_arena_rewind(arena, mark);
        if (status != FW_OK && status != FW_GEOMETRY) return status;
    }
    *die = tried.die;
    return FW_OK;
}

fw_status fw_mask_coupons_build(fw_arena *arena, const fw_mask_table *table,
                                const fw_mask_coupon_options *options, fw_diags *diags,
                                const fw_mask_coupons **coupons) {
    *coupons = NULL;
    const fw_mask_layer *layer = structure_layer(table);
    if (table->npattern == 0 || !layer) return FW_OK;
    fw_mask_coupons *c = fw_arena_one(arena, fw_mask_coupons);
    FW_NEED(c);
    const char *title = fw_arena_printf(arena, "TEST %s", table->flow);
    FW_NEED(title);
    fw_layout_content_options content = content_options(table, layer, title, options);
    FW_TRY(fw_layout_content_build(arena, table->pattern, table->npattern, &content, diags,
                                   &c->content));
    fw_mask_options mask = options->mask;
    mask.bias_m = 0; /* it is in the outlines, where a pattern wants it */
    mask.no_islands = true;
    mask.title = title;
    FW_TRY(fw_mask_build(arena, c->content->layout, table, title, &mask, diags, &c->mask));
    *coupons = c;
    return FW_OK;
}

/* ---- the formats in which a mask is written: formats.def ---- */

#define FW_MASK_FORMAT(name_, ending_, ...)                                                        \
    {.name = #name_, .ending = ending_, .write = fw_mask_write_##name_, __VA_ARGS__},
static const fw_mask_format format_row[] = {
#include "mask/formats.def"
};
#undef FW_MASK_FORMAT
enum { NFORMAT = sizeof format_row / sizeof format_row[0] };
_Static_assert(NFORMAT <= 32, "sets of formats are bits of an unsigned");

const fw_mask_format *fw_mask_format_at(size_t i) {
    return i < NFORMAT ? &format_row[i] : NULL;
}

static bool wanted(unsigned *set, const char *word, size_t n) {
    bool all = n == 3 && memcmp(word, "all", 3) == 0, found = false;
    for (unsigned i = 0; i < NFORMAT; i++)
        if (all || (strlen(format_row[i].name) == n && memcmp(format_row[i].name, word, n) == 0)) {
            *set |= 1u << i;
            found = true;
        }
    return found;
}

bool fw_mask_formats(const char *list, unsigned *set) {
    *set = 0;
    for (unsigned i = 0; i < NFORMAT; i++)
        if (format_row[i].always || (!list && format_row[i].usual)) *set |= 1u << i;
    for (const char *s = list; s; s = strchr(s, ',') ? strchr(s, ',') + 1 : NULL)
        if (!wanted(set, s, strcspn(s, ","))) return false;
    return true;
}
