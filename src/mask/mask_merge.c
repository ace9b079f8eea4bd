/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/mask_parts.h"
#include "mask/mask.h"
#include "geometry/merge.h"
#include <math.h>
#include <string.h>

static const char *other_tone(const char *tone) {
    if (!tone) return NULL;
    return strcmp(tone, "data dark") == 0 ? "data clear" : "data dark";
}

fw_status fw_mask_written_table(fw_arena *arena, const fw_mask_table *table, int plate,
                                bool inverted, const fw_mask_table **out) {
    fw_mask_plate_term *term;
    int n;
    FW_TRY(fw_mask_plate_terms_of(arena, table, plate, &term, &n));
    fw_mask_table *t = fw_arena_one(arena, fw_mask_table);
    fw_mask_layer *layer = fw_arena_one(arena, fw_mask_layer);
    FW_NEED(t && layer ? t : NULL);
    if (n > 0) *layer = table->layer[term[0].layer];
    if (inverted) layer->tone = other_tone(layer->tone);
    layer->id = "plate";
    layer->name = table->written_name ? table->written_name : "PLATE";
    layer->purpose = "the plate as it is written: the layers of the order joined";
    if (table->written_numbered) {
        layer->layer = table->written_layer;
        layer->datatype = table->written_datatype;
    }
    *t = *table;
    t->layer = layer;
    t->nlayer = 1;
    t->plate = t->order = NULL;
    t->plates = NULL;
    t->nplate = t->device_plate = 0;
    t->reading = fw_mask_plate_at(table, plate).reading;
    t->rule = NULL;
    t->nrule = 0;
    *out = t;
    return FW_OK;
}

/* ---- what is joined ---- */

typedef struct joined {
    fw_geometry_merge_input *input;
    int n;
    fw_geometry_merge_term *term;
    int nterm;
} joined;

/* Set 0 is the windows, set 1 the field of what is inverted, set 2 + k the k-th different layer of the
   expression. Terms are joined from the left, so "field NOT expression" is "expression AND field XOR
   field". */
enum { WINDOWS, FIELD, LAYERS };

static fw_status terms_of(fw_arena *arena, const fw_mask *mask, const fw_mask_merge_options *o,
                          joined *j, int *set_of) {
    fw_mask_plate_term *term;
    int n, sets = LAYERS;
    FW_TRY(fw_mask_plate_terms_of(arena, mask->table, o->plate, &term, &n));
    FW_NEED(j->term = fw_arena_array(arena, fw_geometry_merge_term, (size_t)n + 3));
    for (int k = 0; k < mask->table->nlayer; k++)
        set_of[k] = -1;
    for (int i = 0; i < n; i++) {
        int *set = &set_of[term[i].layer];
        if (*set < 0) *set = sets++;
        if (sets > FW_MERGE_SETS) return FW_LIMIT;
        j->term[j->nterm++] = (fw_geometry_merge_term){*set, term[i].rule};
    }
    if (o->inverted) {
        j->term[j->nterm++] = (fw_geometry_merge_term){FIELD, FW_SET_AND};
        j->term[j->nterm++] = (fw_geometry_merge_term){FIELD, FW_SET_XOR};
    }
    if (o->nwindow > 0)
        j->term[j->nterm++] =
            (fw_geometry_merge_term){WINDOWS, o->under < 0 ? FW_SET_NOT : FW_SET_AND};
    return FW_OK;
}

static void add(joined *j, const fw_geometry_polygon *polygon, int set) {
    if (set >= 0 && polygon->count > 2) j->input[j->n++] = (fw_geometry_merge_input){polygon, set};
}

static int32_t scaled(int32_t v, double scale) {
    return (int32_t)llround(v * scale);
}

/* of a mask, as it is written */
static fw_status add_scaled(fw_arena *arena, joined *j, const fw_geometry_polygon *polygon, int set,
                            double scale) {
    fw_geometry_polygon *own = fw_arena_one(arena, fw_geometry_polygon);
    if (scale == 1 || set < 0) {
        add(j, polygon, set);
        return FW_OK;
    }
    FW_NEED(own);
    FW_NEED(own->vertex = fw_arena_array(arena, fw_geometry_point, (size_t)polygon->count));
    own->count = polygon->count;
    for (int i = 0; i < polygon->count; i++)
        own->vertex[i] = (fw_geometry_point){scaled(polygon->vertex[i].x_dbu, scale),
                                             scaled(polygon->vertex[i].y_dbu, scale)};
    add(j, own, set);
    return FW_OK;
}

static fw_status rectangle(fw_arena *arena, fw_mask_window w, const fw_geometry_polygon **out) {
    fw_geometry_polygon *r = fw_arena_one(arena, fw_geometry_polygon);
    fw_geometry_point *p = fw_arena_array(arena, fw_geometry_point, 4);
    FW_NEED(r && p ? r : NULL);
    for (int i = 0; i < 4; i++)
        p[i] = (fw_geometry_point){i == 1 || i == 2 ? w.x1 : w.x0, i > 1 ? w.y1 : w.y0};
    *r = (fw_geometry_polygon){p, 4};
    *out = r;
    return FW_OK;
}

static fw_status collect(fw_arena *arena, const fw_mask *mask, const fw_mask_merge_options *o,
                         joined *j) {
    int *set_of = fw_arena_array(arena, int, (size_t)mask->table->nlayer + 1);
    size_t most = (size_t)mask->nshape + 2 * (size_t)o->nwindow + 1;
    const fw_geometry_polygon *r;
    FW_NEED(set_of);
    FW_TRY(terms_of(arena, mask, o, j, set_of));
    FW_NEED(j->input = fw_arena_array(arena, fw_geometry_merge_input, most));
    for (int i = 0; i < mask->nshape; i++)
        FW_TRY(add_scaled(arena, j, &mask->shape[i].polygon, set_of[mask->shape[i].layer],
                          o->scales ? o->scales[i] : o->scale));
    for (int i = 0; i < o->nwindow; i++) {
        FW_TRY(rectangle(arena, o->window[i], &r));
        add(j, r, WINDOWS);
        if (o->under >= 0) add(j, r, set_of[o->under]);
    }
    if (!o->inverted) return FW_OK;
    FW_TRY(rectangle(arena, o->field, &r));
    add(j, r, FIELD);
    return FW_OK;
}

/* ---- what comes of it ---- */

static const fw_layout_piece merged_piece = {
    .role = FW_ROLE_FRAME, .body = FW_NONE - 1, .joint = FW_NONE, .label = "plate"};

/* mirrored, where asked for; counter-clockwise again */
static fw_status placed(fw_arena *arena, const fw_geometry_polygon *p,
                        const fw_mask_merge_options *o, fw_geometry_polygon *out) {
    FW_NEED(out->vertex = fw_arena_array(arena, fw_geometry_point, (size_t)p->count));
    out->count = p->count;
    for (int i = 0; i < p->count; i++) {
        fw_geometry_point v = p->vertex[o->mirror ? p->count - 1 - i : i];
        int64_t x = o->mirror ? -(int64_t)v.x_dbu : v.x_dbu;
        out->vertex[i] = (fw_geometry_point){(int32_t)x, v.y_dbu};
    }
    return FW_OK;
}

/* lines between the vertices, for the formats that write outlines */
static fw_status outline_of(fw_arena *arena, const fw_geometry_polygon *p,
                            fw_geometry_contour *out) {
    FW_NEED(out->segment = fw_arena_array(arena, fw_geometry_segment, (size_t)p->count));
    out->count = p->count;
    for (int i = 0; i < p->count; i++) {
        fw_geometry_point a = p->vertex[i], b = p->vertex[i + 1 < p->count ? i + 1 : 0];
        out->segment[i] = (fw_geometry_segment){
            .kind = FW_LINE,
            .a = {a.x_dbu * FW_GEOMETRY_GRID_M, a.y_dbu * FW_GEOMETRY_GRID_M},
            .b = {b.x_dbu * FW_GEOMETRY_GRID_M, b.y_dbu * FW_GEOMETRY_GRID_M}};
    }
    return FW_OK;
}

static fw_status shape_of(fw_arena *arena, const fw_geometry_polygon *p, int most,
                          fw_mask_shape *s) {
    *s = (fw_mask_shape){.piece = &merged_piece, .polygon = *p};
    FW_TRY(fw_geometry_polygon_check(arena, p, &s->report));
    if (!s->report.simple) return FW_GEOMETRY;
    FW_TRY(outline_of(arena, p, &s->contour));
    s->box = fw_geometry_contour_box(&s->contour);
    s->polygon_area_m2 = s->area_m2 = 0.5e-18 * (double)fw_geometry_polygon_area2(p);
    return fw_mask_polygon_cut(arena, &s->polygon, most, &s->part, &s->npart, &s->cut_clear_dbu);
}

static void extend(fw_mask *m, fw_geometry_box b) {
    m->box = (fw_geometry_box){fmin(m->box.x0, b.x0), fmin(m->box.y0, b.y0), fmax(m->box.x1, b.x1),
                               fmax(m->box.y1, b.y1)};
}

/* what is joined, as it is written */
static fw_status keep_merged(fw_arena *arena, const fw_mask *mask, const fw_mask_merge_options *o,
                             const fw_geometry_merged *merged, const fw_mask **out,
                             fw_mask_merge_sums *sums) {
    fw_mask *m = fw_arena_one(arena, fw_mask);
    FW_NEED(m);
    *m = *mask;
    m->table = o->written;
    m->measure = NULL;
    m->edges = NULL;
    m->finding = NULL;
    m->nfinding = m->nbroken = 0;
    m->vertex_limit = o->vertices;
    m->box = (fw_geometry_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    m->nshape = merged->n;
    FW_NEED(m->shape = fw_arena_array(arena, fw_mask_shape, (size_t)merged->n + 1));
    *sums = (fw_mask_merge_sums){.cuts = merged->cuts,
                                 .holes = merged->holes,
                                 .rounded = merged->rounded,
                                 .clear_m = merged->clear_m,
                                 .area_m2 = 0.5e-18 * (double)merged->area2_dbu};
    for (int i = 0; i < merged->n; i++) {
        fw_geometry_polygon p;
        fw_mask_shape *s = &m->shape[i];
        FW_TRY(placed(arena, &merged->polygon[i], o, &p));
        FW_TRY(shape_of(arena, &p, o->vertices, s));
        extend(m, s->box);
        sums->polygons += s->npart > 0 ? s->npart : 1;
        sums->cuts += s->npart > 1 ? s->npart - 1 : 0;
        sums->clear_m = fmin(sums->clear_m, s->cut_clear_dbu * FW_GEOMETRY_GRID_M);
        sums->vertices += s->polygon.count + (s->npart > 1 ? 2 * (s->npart - 1) : 0);
    }
    *out = m;
    return FW_OK;
}

/* edges and joints of what is joined take ten times what comes of it, and are given back */
fw_status fw_mask_merged(fw_arena *arena, const fw_mask *mask, const fw_mask_merge_options *o,
                         const fw_mask **out, fw_mask_merge_sums *sums) {
    joined j = {0};
    fw_geometry_merged merged;
    fw_arena *scratch = fw_arena_part(arena, 0);
    FW_NEED(scratch);
    fw_status status = collect(scratch, mask, o, &j);
    if (status == FW_OK)
        status = fw_geometry_merge(scratch, j.input, j.n, j.term, j.nterm, o->vertices, &merged);
    if (status == FW_OK) status = keep_merged(arena, mask, o, &merged, out, sums);
    fw_arena_free(scratch);
    return status;
}

/* ---- the nets of the drawing found again on the mask, in its certificate and on its order sheets. Theory:
   docs/theory/wiring.md; tests: test_wiring_mask.c, tests/accept/kl_nets.py ---- */

/* contours of the mask for the pieces of the layout: exact outlines with the bias, of which the polygons are
   proved to be within the tolerance */
fw_status fw_mask_wiring_check(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                               fw_diags *diags) {
    const fw_wiring *w = mask->wiring;
    fw_geometry_contour *contour;
    if (!w || w->npiece != layout->npiece) {
        mask->wiring = NULL;
        return FW_OK;
    }
    FW_NEED(contour = fw_arena_array(arena, fw_geometry_contour, (size_t)layout->npiece));
    for (int k = 0; k < mask->nshape; k++) {
        ptrdiff_t i = mask->shape[k].piece - layout->piece;
        bool device = mask->table->layer[mask->shape[k].layer].biased;
        if (device && w->net_of[i] >= 0) contour[i] = mask->shape[k].contour;
    }
    FW_TRY(fw_wiring_compare(arena, w, layout, contour, &mask->wired));
    if (mask->wired.same) return FW_OK;
    mask->nbroken++; /* no rule of a layer, but as good as one */
    return fw_diag_error(diags, 441, (fw_place){0}, "%s", mask->wired.differs);
}

static void place(fw_json *json, const char *key, fw_geometry_vec2 at) {
    fw_json_list(json, key);
    fw_json_fixed(json, NULL, at.x * 1e6, 4);
    fw_json_fixed(json, NULL, at.y * 1e6, 4);
    fw_json_end(json);
}

void fw_mask_wiring_json(fw_json *json, const fw_mask *mask) {
    const fw_wiring_on_mask *m = &mask->wired;
    if (!mask->wiring) return;
    fw_json_line(json, 2);
    fw_wiring_json(mask->wiring, json);
    fw_json_line(json, 2);
    fw_json_object(json, "nets_on_mask");
    fw_json_whole(json, "nets", m->nnet);
    fw_json_truth(json, "as_drawn", m->same);
    fw_json_number(json, "least_um", m->least_m * 1e6, 12);
    if (isfinite(m->least_m)) {
        place(json, "from_um", m->at[0]);
        place(json, "to_um", m->at[1]);
    }
    fw_json_list(json, "between");
    for (int i = 0; i < 2 && isfinite(m->least_m); i++)
        fw_json_text(json, NULL, m->label[i]);
    fw_json_end(json);
    fw_json_end(json);
}

/* only where something is driven: else there is nothing to contact */
static bool is_driven(const fw_mask *mask) {
    return mask->wiring && mask->wiring->ndrive > 0 && mask->wiring->carrier.insulates;
}

static bool has_pad(const fw_wiring_net *n) {
    return n->needed && n->padded;
}

static fw_geometry_vec2 middle(const fw_wiring_net *n) {
    return (fw_geometry_vec2){0.5 * (n->pad.x0 + n->pad.x1), 0.5 * (n->pad.y0 + n->pad.y1)};
}

fw_status fw_mask_ports(fw_arena *arena, const fw_mask *mask, fw_mask_port **port, int *count) {
    *count = 0;
    *port = NULL;
    if (!is_driven(mask) || mask->wiring->nnet == 0) return FW_OK;
    FW_NEED(*port = fw_arena_array(arena, fw_mask_port, (size_t)mask->wiring->nnet));
    for (int i = 0; i < mask->wiring->nnet; i++) {
        const fw_wiring_net *n = &mask->wiring->net[i];
        if (!has_pad(n)) continue;
        const fw_geometry_vec2 at = middle(n);
        fw_mask_port *p = &(*port)[(*count)++];
        *p = (fw_mask_port){NULL, (int32_t)lround(at.x * 1e9), (int32_t)lround(at.y * 1e9)};
        FW_TRY(fw_mask_note(arena, "port", n->name, &p->note));
    }
    return FW_OK;
}

void fw_mask_wiring_order_json(fw_json *json, const fw_mask *mask) {
    if (!is_driven(mask)) return;
    fw_json_line(json, 2);
    fw_json_list(json, "contacts");
    for (int i = 0; i < mask->wiring->nnet; i++) {
        const fw_wiring_net *n = &mask->wiring->net[i];
        fw_json_line(json, 4);
        fw_json_object(json, NULL);
        fw_json_text(json, "net", n->name);
        fw_json_text(json, "contact", fw_wiring_contact_word(n));
        if (has_pad(n)) {
            place(json, "centre_um", middle(n));
            fw_json_fixed(json, "side_um", (n->pad.x1 - n->pad.x0) * 1e6, 4);
        }
        fw_json_end(json);
    }
    fw_json_end_line(json, 2);
}

fw_status fw_mask_wiring_order_text(const fw_mask *mask, fw_text *out) {
    if (!is_driven(mask)) return FW_OK;
    fw_text_add(out, "\ncontacts, net by net\n");
    for (int i = 0; i < mask->wiring->nnet; i++) {
        const char *words;
        FW_TRY(fw_wiring_contact_words(out->arena, &mask->wiring->net[i], &words));
        fw_text_printf(out, "%s: %s\n", mask->wiring->net[i].name, words);
    }
    return FW_OK;
}
