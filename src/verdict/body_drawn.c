/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies and bases as they are drawn: of which ends ways are looked for (body_arms.c), and up to where; and what bases give.
   A base is what is drawn between a hinge on the ground and the frame. Each is a piece of the drawing that ends where it
   is cut from the frame, and gives by the strip of circles along the stiffest way from the hinge to the middle of that cut, as
   a body does to its middle; behind it the frame gives as if that strip went on by 0.44 of the cut. Nothing else acts on it than its hinges,
   so that all that it stores is

     U = sum over hinges of w.g w/(2 E h), and of ways that go together what their hinges put on them together

   which counts beside what bodies store, wherever that is compared with what hinges do: bases soften stiffnesses, frequencies
   and ways in series with the flexures that stand on them. In: outlines of the layout in the drawn pose. Range: bases that the layout
   draws; the frame is a half-plane behind the cut, which a bar as wide as the cut nearly is. Error: an upper bound as
   far as a strip of circles is a beam. Cost: some 1e5 operations a base. Source: S. Timoshenko, J. Goodier, Theory of Elasticity, 3rd
   ed., art. 86; W. J. O'Donnell, J. Appl. Mech. 27 (1960) 461. Theory: docs/theory/verdict.md, 5. Test: test_body_arms.c,
   test_effects.py Bases */
#include "geometry/segment.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

enum { FINEST = 4, FINEST_OF_BASES = 2 }; /* grids */

/* ---- bodies ---- */

static int ends_of(const fw_mechanism *m, int body, fw_verdict_arm *arm, fw_verdict_arm_end *out) {
    int n = 0;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        fw_geometry_vec2 pin, root;
        if (fw_mechanism_hinge_end(m, body, i, &pin, &root))
            out[n++] = (fw_verdict_arm_end){.to = &arm[i], .index = i, .pin = pin, .root = root};
    }
    return n;
}

fw_status fw_verdict_body_arms(fw_arena *arena, const fw_mechanism *m, const fw_layout *layout,
                               fw_verdict_arm **arm) {
    size_t n = 2 * (size_t)m->nhinge;
    fw_mechanism_load_end *load;
    int nload;
    FW_TRY(fw_mechanism_load_ends(arena, m, &load, &nload));
    const fw_device *d = m->device;
    const double pitch = d ? d->release_pitch_m : 0;
    const double drawn_m = pitch > 0 ? d->release_hole_m : 0;
    const double hole_m = pitch > 0 && !(drawn_m > 0) ? 0.3 * pitch : drawn_m;
    FW_NEED(*arm = fw_arena_array(arena, fw_verdict_arm, n + (size_t)nload));
    for (int b = 0; layout && layout->drawn && b < m->nbody; b++) {
        fw_arena *scratch = fw_arena_part(arena, 0);
        FW_NEED(scratch);
        fw_verdict_arm_end *ends = fw_arena_array(scratch, fw_verdict_arm_end, n + (size_t)nload);
        int nhinge = ends ? ends_of(m, b, *arm, ends) : 0, found = nhinge;
        for (int j = 0; ends && j < nload; j++)
            if (load[j].body == b && load[j].first == j)
                ends[found++] = (fw_verdict_arm_end){
                    .to = *arm + n + j, .index = (int)n + j, .pin = load[j].at, .root = load[j].at};
        fw_status status = ends ? FW_OK : FW_NOMEM;
        fw_verdict_drawn from = {.middle = layout->body[b].centroid, .deep = 2, .finest = FINEST};
        if (nhinge > 0)
            status = fw_mechanism_body_lines(scratch, layout, b, &from.line, &from.nline);
        if (nhinge > 0 && status == FW_OK)
            status = fw_verdict_arms_of(scratch, arena, &from, ends, nhinge, found, hole_m);
        fw_arena_free(scratch);
        FW_TRY(status);
    }
    for (int j = 0; j < nload; j++)
        (*arm)[n + (size_t)j] = (*arm)[n + (size_t)load[j].first];
    return FW_OK;
}

/* ---- bases ---- */

static const fw_verdict_turn still = {0, 1, 0};

static double distance_to(const fw_mechanism_line *line, fw_geometry_vec2 at) {
    double t;
    return vec_distance(at, vec_line_foot(line->a, line->b, at, &t));
}

/* is this cut the nearest to where one of the hinges begins? A fillet may lie between */
static bool is_root(const fw_mechanism_line *line, int n, int cut, const fw_verdict_arm_end *end,
                    int nend) {
    for (int k = 0; k < nend; k++) {
        int nearest = cut;
        for (int i = 0; i < n; i++)
            if (!line[i].edge &&
                distance_to(&line[i], end[k].root) < distance_to(&line[nearest], end[k].root))
                nearest = i;
        if (nearest == cut) return true;
    }
    return false;
}

/* Where a piece hangs on the frame: the middle of the longest straight cut at which no hinge begins, and of those in line with it,
   between which the head of a hinge may reach into the frame. false: there is none */
static bool find_cut(const fw_mechanism_line *line, int n, const fw_verdict_arm_end *end, int nend,
                     fw_verdict_drawn *to) {
    const double in_line_m = 1e-6;
    const fw_mechanism_line *longest = NULL;
    double sum = 0;
    for (int i = 0; i < n; i++)
        if (!line[i].edge && !is_root(line, n, i, end, nend) &&
            (!longest || vec_distance(line[i].a, line[i].b) > vec_distance(longest->a, longest->b)))
            longest = &line[i];
    to->middle = (fw_geometry_vec2){0, 0};
    for (int i = 0; longest && i < n; i++) {
        const fw_geometry_vec2 a = line[i].a, b = line[i].b, at = longest->a,
                               along = vec_unit(vec_sub(longest->b, at));
        const double wide = vec_distance(a, b);
        if (line[i].edge || is_root(line, n, i, end, nend) ||
            fabs(vec_cross(along, vec_sub(a, at))) > in_line_m ||
            fabs(vec_cross(along, vec_sub(b, at))) > in_line_m)
            continue;
        sum += wide, to->along = along;
        to->middle = vec_along(to->middle, 0.5 * wide, vec_add(a, b));
    }
    if (sum > 0) to->middle = vec_scale(1 / sum, to->middle);
    to->foot_m = sum;
    return sum > 0;
}

/* one piece: its lines, and of all ends those that begin at it */
static fw_status one_base(fw_arena *scratch, fw_mechanism_line *line, int n,
                          const fw_verdict_arm_end *all, const int *of, int nall, int piece) {
    /* the way may end in a circle that reaches the cut: at the cut itself an edge may be near */
    fw_verdict_drawn from = {.line = line, .nline = n, .deep = 1.25, .finest = FINEST_OF_BASES};
    fw_verdict_arm_end *end = fw_arena_array(scratch, fw_verdict_arm_end, (size_t)nall + 1);
    int nend = 0;
    FW_NEED(end);
    for (int k = 0; k < nall; k++)
        if (of[k] == piece) end[nend++] = all[k];
    if (nend == 0 || !find_cut(line, n, end, nend, &from)) return FW_OK;
    return fw_verdict_arms_of(scratch, scratch, &from, end, nend, nend, 0);
}

/* of: (n) the piece that is nearest to where each begins */
static void find_pieces(const fw_mechanism_line *line, int nline, const fw_verdict_arm_end *end,
                        int n, int *of) {
    for (int k = 0; k < n; k++) {
        double least = HUGE_VAL;
        of[k] = FW_NONE;
        for (int i = 0; i < nline; i++) {
            const double away = distance_to(&line[i], end[k].root);
            if (away < least) least = away, of[k] = line[i].piece;
        }
    }
}

/* what is asked of ways that meet, with the strips by which they give as made */
static fw_status keep_shared(fw_arena *arena, const fw_verdict_shared *from,
                             const fw_verdict_shared **kept) {
    fw_verdict_shared *to = fw_arena_one(arena, fw_verdict_shared);
    const size_t n = (size_t)from->n;
    FW_NEED(to);
    *to = *from, *kept = to;
    FW_NEED(to->trunk = fw_arena_grow(arena, from->trunk, n, n, sizeof *to->trunk));
    for (size_t i = 0; i < n; i++) {
        struct fw_verdict_trunk *t = &to->trunk[i];
        const size_t ends = (size_t)t->n;
        FW_NEED(t->end = fw_arena_grow(arena, t->end, ends, ends, sizeof *t->end));
        const size_t strips = (size_t)t->nstrip;
        FW_NEED(t->strip = fw_arena_grow(arena, t->strip, strips, strips, sizeof *t->strip));
    }
    return FW_OK;
}

/* those that are known, as long as the device is: of their ways the strips alone */
static fw_status keep_bases(fw_arena *arena, const fw_verdict_arm_end *end, int n,
                            fw_verdict_arm *arm) {
    for (int k = 0; k < n; k++) {
        if (!end[k].to->known) continue;
        fw_verdict_arm *to = fw_arena_grow(arena, end[k].to, 1, 1, sizeof *to);
        FW_NEED(to);
        const size_t strips = (size_t)to->nstrip;
        to->way = NULL, to->nway = 0;
        FW_NEED(to->strip = fw_arena_grow(arena, to->strip, strips, strips, sizeof *to->strip));
        int like = 0;
        while (like < k && !(end[like].to->known && end[like].to->shared == to->shared))
            like++;
        if (to->shared && like < k)
            to->shared = arm[end[like].index].base->shared;
        else if (to->shared)
            FW_TRY(keep_shared(arena, to->shared, &to->shared));
        arm[end[k].index].base = to;
    }
    return FW_OK;
}

static fw_status all_bases(fw_arena *scratch, fw_arena *arena, const fw_mechanism *m,
                           const fw_layout *layout, fw_verdict_arm *arm) {
    fw_mechanism_line *line;
    int nline, n = 0;
    const size_t ends = 2 * (size_t)m->nhinge;
    fw_verdict_arm_end *end = fw_arena_array(scratch, fw_verdict_arm_end, ends + 1);
    int *of = fw_arena_array(scratch, int, ends + 1);
    fw_verdict_arm *base;
    FW_NEED(end && of ? end : NULL);
    FW_NEED(base = fw_arena_array(scratch, fw_verdict_arm, ends + 1));
    FW_TRY(fw_mechanism_body_lines(scratch, layout, FW_GROUND, &line, &nline));
    for (int i = 0; i < (int)ends; i++) {
        fw_verdict_arm_end *to = &end[n];
        if (!fw_mechanism_hinge_end(m, FW_GROUND, i, &to->pin, &to->root)) continue;
        to->to = &base[i], to->index = i, n++;
    }
    find_pieces(line, nline, end, n, of);
    for (int first = 0, last; first < nline; first = last) {
        for (last = first; last < nline && line[last].piece == line[first].piece;)
            last++;
        FW_TRY(one_base(scratch, line + first, last - first, end, of, n, line[first].piece));
    }
    return keep_bases(arena, end, n, arm);
}

fw_status fw_verdict_bases(fw_arena *arena, const fw_mechanism *m, const fw_layout *layout,
                           fw_verdict_arm *arm) {
    if (!layout || !layout->drawn) return FW_OK;
    fw_arena *scratch = fw_arena_part(arena, 0);
    FW_NEED(scratch);
    const fw_status status = all_bases(scratch, arena, m, layout, arm);
    fw_arena_free(scratch);
    return status;
}

bool fw_verdict_has_bases(const fw_mechanism *m, const fw_verdict_arm *arm) {
    for (int i = 0; i < 2 * m->nhinge; i++)
        if (arm[i].base) return true;
    return false;
}

/* ---- what they give ---- */

double fw_verdict_bases_J(const fw_mechanism *m, const fw_verdict_arm *arm, double stiff_N,
                          const double *on, double *end) {
    double sum = 0;
    memset(end, 0, 6 * (size_t)m->nhinge * sizeof *end);
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_verdict_arm *base = arm[i].base;
        const double *by = on + 3 * (i / 2);
        double w[3];
        if (!base) continue;
        sum += fw_verdict_arm_energy_J(base, stiff_N, -by[0], by[1], by[2], &still);
        if (!base->shared) continue;
        fw_verdict_end_put(by, i % 2, &still, w);
        fw_verdict_wrench_about(base->pin, base->shared->about, w, end + 3 * i);
    }
    for (int i = 0; i < 2 * m->nhinge; i++)
        if (arm[i].base && arm[i].base->shared && arm[i].base->shared->first == i)
            sum += fw_verdict_shared_J(arm[i].base->shared, stiff_N, end, 2 * m->nhinge);
    return sum;
}

void fw_verdict_bases_record(fw_verdict_bending *b, const fw_mechanism *m,
                             const fw_dynamics_instant *now) {
    double *on = b->base;
    for (int k = 0; k < m->nhinge; k++) {
        const int j = m->hinge[k].pin;
        on[3 * k] = m->pin[j].stiffness_Nm_per_rad * now->angle_rad[j];
        on[3 * k + 1] = now->reaction_N[2 * j], on[3 * k + 2] = now->reaction_N[2 * j + 1];
        for (int side = 0; side < 2; side++) {
            const fw_verdict_arm *base = b->arm[2 * k + side].base;
            if (base)
                b->bases_gone =
                    fmax(b->bases_gone, fw_verdict_arm_gone(b, &m->hinge[k], base, -on[3 * k],
                                                            on + 3 * k + 1, &still));
        }
    }
    b->bases_J =
        fmax(b->bases_J, fw_verdict_bases_J(m, b->arm, b->stiff_N, on, on + 3 * (size_t)m->nhinge));
}

/* ends that share their ways with this one, and it */
static int sharing(const fw_mechanism *m, const fw_verdict_arm *arm, const fw_verdict_arm *base) {
    int n = 0;
    for (int i = 0; base->shared && i < 2 * m->nhinge; i++)
        n += arm[i].base && arm[i].base->shared == base->shared;
    return base->shared ? n : 1;
}

void fw_verdict_bases_add(const fw_mechanism *m, const fw_verdict_arm *arm, int hinge,
                          double gives[9]) {
    const double stiff_N = m->variant->material.youngs.value * m->variant->thickness_m;
    for (int side = 0; arm && side < 2; side++) {
        const fw_verdict_arm *base = arm[2 * hinge + side].base;
        if (!base) continue;
        const int ends = sharing(m, arm, base);
        const double *g = base->give,
                     all[9] = {g[3], g[4], g[1], g[4], g[5], g[2], g[1], g[2], g[0]};
        for (int i = 0; i < 9; i++)
            gives[i] += ends * all[i] / stiff_N;
    }
}

void fw_verdict_bases_tell(const fw_mechanism *m, const fw_verdict_arm *arm,
                           const fw_device_scene *scene, const char *const share[4],
                           fw_diags *diags) {
    char way[32];
    const fw_verdict_arm *softest = NULL;
    int at = 0;
    for (int i = 0; i < 2 * m->nhinge; i++)
        if (arm[i].base &&
            (!softest || fw_verdict_arm_goes(arm[i].base) > fw_verdict_arm_goes(softest)))
            softest = arm[i].base, at = m->hinge[i / 2].pin;
    if (!softest) return;
    fw_diag_warning(
        diags, 510, m->device->revolute[at].place,
        "bodies, and bases between hinges and the frame, are taken as rigid, and in %s%s they may "
        "give by up to %s %s what the hinges give, bases by %s %s it: what is probed may move that "
        "much further, and the bands allow for it. The softest base, at %s%s, which the layout "
        "draws, is %s um long up to the frame. A leaf that runs straight to a side of the frame by "
        "its stated axis has a base in line with it, a wider anchor of <die> bends less, and "
        "longer "
        "or thinner flexures ask less of it",
        FW_NAMED("scene", scene->name), share[0], share[1], share[2], share[3],
        FW_NAMED("hinge", m->pin[at].id),
        fw_number_text(way, sizeof way, 1e6 * softest->length_m, 3));
}

/* Of a device of which nothing is drawn nobody knows how its bodies bend. Test: test_effects.py, NotDrawn */
fw_status fw_verdict_bending_name_rigid(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    fw_text list = fw_text_new(arena);
    if (v->arm || v->nrequirement == 0 || v->corner) return FW_OK;
    for (int b = 0; b < m->nbody; b++)
        fw_text_printf(&list, "%s%s", b ? ", " : "", fw_text_name(m->body[b].id));
    FW_TRY(fw_text_end(&list));
    for (int k = 0; k < v->nrequirement; k++)
        if (!v->requirement[k].why) v->requirement[k].rigid = list.data;
    return FW_OK;
}
