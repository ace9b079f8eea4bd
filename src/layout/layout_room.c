/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nearest room of what is missing in a drawing: the part is changed in a copy of the device, and
   the device drawn again, until nothing is missing that was not missing before, and this part is there.

   Tried are places around the stated one, in the axes in which the file states it: 16 directions at
   distances that grow from 5 um to 2 mm by a factor of 1.4; then, along each direction that has room at
   the least such distance, halves of the step before it, to 1 um. And sizes: for a comb fewer fingers,
   for plates a shorter face, for fingers that end too near their partners' root longer ones, wider ones for those too
   narrow, with which places and other sizes are looked for where the width alone does not do; for an eyelet a smaller
   ring. In: a layout with missing parts. Out: a clause for each. What is proposed was drawn. That nothing nearer has room is not proved: a room less wide than a step may be passed over.
   Cost: at most MOST_TRIES drawings for a part, and MOST_ALL for
   a device. Test: tests/unit/layout/test_missing.c */
#include "base/constants.h"
#include "base/text.h"
#include "layout/draw.h"
#include <math.h>
#include <string.h>

enum { MOST_TRIES = 360, MOST_ALL = 1080, DIRECTIONS = 16, MOST_FINGERS = 100 };
static const double FIRST_M = 5e-6, FARTHEST_M = 2e-3, GROWTH = 1.4, STEP_M = 1e-6;

typedef struct search {
    fw_arena *arena; /* of the answer */
    const fw_device *device;
    const fw_layout *layout;
    const fw_layout_missing *missing;
    int left; /* drawings that may still be made */
    double
        wider_m; /* of fingers that no mask shows as they are: in every try; 0: they are wide enough */
} search;

typedef struct change { /* of the part, beside what is stated */
    double x_m, y_m;
    int fingers;     /* 0: as stated */
    double length_m; /* 0: as stated */
    double width_m;  /* of fingers; 0: as stated */
    double ring;     /* share of hole and ring; 0: as stated */
} change;

/* ---- a changed copy, drawn ---- */

static void change_comb(const search *s, const change *c, fw_device_comb *comb) {
    comb->bx_m += c->x_m;
    comb->by_m += c->y_m;
    if (s->wider_m > 0.0) comb->width_m = s->wider_m;
    if (c->fingers > 0) comb->fingers = c->fingers;
    if (c->length_m > 0.0) comb->length_m = c->length_m;
    if (c->width_m > 0.0) comb->width_m = c->width_m;
}

static void change_eyelet(const change *c, fw_device_eyelet *e) {
    e->x_m += c->x_m;
    e->y_m += c->y_m;
    if (!(c->ring > 0.0)) return;
    e->hole_m = c->ring * (e->hole_m > 0.0 ? e->hole_m : FW_EYELET_HOLE_M);
    e->ring_m = c->ring * (e->ring_m > 0.0 ? e->ring_m : FW_EYELET_RING_M);
}

static fw_status changed_tendon(fw_arena *arena, const search *s, const change *c,
                                fw_device_tendon *t) {
    size_t n = (size_t)t->neyelet;
    FW_NEED(t->eyelet = fw_arena_grow(arena, t->eyelet, n, n, sizeof *t->eyelet));
    for (size_t k = 0; k < n; k++)
        if (fw_layout_same_eyelet(&t->eyelet[k], s->missing->eyelet))
            change_eyelet(c, &t->eyelet[k]);
    return FW_OK;
}

static fw_status changed_scene(fw_arena *arena, const search *s, const change *c,
                               fw_device_scene *scene) {
    size_t n = (size_t)scene->ncomb;
    if (s->missing->comb && n > 0) {
        FW_NEED(scene->comb = fw_arena_grow(arena, scene->comb, n, n, sizeof *scene->comb));
        for (size_t i = 0; i < n; i++)
            if (fw_device_same_comb(&scene->comb[i], s->missing->comb))
                change_comb(s, c, &scene->comb[i]);
    }
    n = (size_t)scene->ntendon;
    if (s->missing->eyelet && n > 0) {
        FW_NEED(scene->tendon = fw_arena_grow(arena, scene->tendon, n, n, sizeof *scene->tendon));
        for (size_t i = 0; i < n; i++)
            FW_TRY(changed_tendon(arena, s, c, &scene->tendon[i]));
    }
    return FW_OK;
}

/* is the part there, and nothing missing but what was before? */
static bool has_room(const search *s, const fw_layout *layout) {
    if (!layout || !layout->drawn || layout->nmissing >= s->layout->nmissing) return false;
    for (int i = 0; i < layout->nmissing; i++) {
        bool before = false;
        for (int k = 0; k < s->layout->nmissing; k++)
            before = before || (&s->layout->missing[k] != s->missing &&
                                strcmp(layout->missing[i].name, s->layout->missing[k].name) == 0);
        if (!before) return false;
    }
    return true;
}

static fw_status try_change(search *s, const change *c, bool *fits) {
    fw_device device = *s->device;
    size_t n = (size_t)device.nscene;
    const fw_layout *layout = NULL;
    *fits = false;
    if (s->left <= 0) return FW_OK;
    if (fw_arena_cancelled(s->arena)) return FW_CANCELLED;
    s->left--;
    device.release_pitch_m = 0.0; /* holes keep off whatever is drawn, and cost most of a drawing */
    fw_arena *arena = fw_arena_part(s->arena, 0);
    FW_NEED(arena);
    fw_diags quiet = fw_diags_new(arena);
    device.scene = fw_arena_grow(arena, device.scene, n, n, sizeof *device.scene);
    fw_status status = device.scene ? FW_OK : FW_NOMEM;
    for (size_t i = 0; i < n && status == FW_OK; i++)
        status = changed_scene(arena, s, c, &device.scene[i]);
    if (status == FW_OK) status = fw_layout_build(arena, &device, &quiet, &layout);
    if (status == FW_OK) *fits = has_room(s, layout);
    fw_arena_free(arena);
    return status == FW_GEOMETRY || status == FW_INPUT ? FW_OK : status;
}

/* ---- another place ---- */

static change shifted(int direction, double far_m) {
    const double turn = 2.0 * FW_PI * direction / DIRECTIONS;
    return (change){.x_m = STEP_M * round(cos(turn) * far_m / STEP_M),
                    .y_m = STEP_M * round(sin(turn) * far_m / STEP_M)};
}

/* between a distance without room and one with it */
static fw_status nearer(search *s, int direction, double low_m, double *high_m) {
    while (*high_m - low_m > 1.5 * STEP_M && s->left > 0) {
        double middle = STEP_M * round(0.5 * (low_m + *high_m) / STEP_M);
        change c = shifted(direction, middle);
        bool fits;
        FW_TRY(try_change(s, &c, &fits));
        *(fits ? high_m : &low_m) = middle;
    }
    return FW_OK;
}

/* *far_m: 0 where there is none */
static fw_status find_place(search *s, change *best, double *far_m) {
    *far_m = 0.0;
    for (double r = FIRST_M, before = 0.0; r <= FARTHEST_M && *far_m == 0.0 && s->left > 0;
         before = r, r *= GROWTH)
        for (int k = 0; k < DIRECTIONS; k++) {
            change c = shifted(k, r);
            double near = r;
            bool fits;
            FW_TRY(try_change(s, &c, &fits));
            if (!fits) continue;
            FW_TRY(nearer(s, k, before, &near));
            c = shifted(k, near);
            if (*far_m > 0.0 && hypot(c.x_m, c.y_m) >= *far_m) continue;
            *best = c;
            *far_m = hypot(c.x_m, c.y_m);
        }
    return FW_OK;
}

/* ---- another size ---- */

/* the most fingers that have room; 0: none */
static fw_status find_fingers(search *s, int *fingers) {
    const fw_device_comb *c = s->missing->comb;
    int first = c->fingers > MOST_FINGERS ? MOST_FINGERS : c->fingers - 1, low = 0,
        high = first + 1;
    *fingers = 0;
    for (int n = first, step = 1; n >= 1 && low == 0; n -= step, step *= 2) {
        bool fits;
        FW_TRY(try_change(s, &(change){.fingers = n}, &fits));
        *(fits ? &low : &high) = n;
        if (!fits && n > 1 && n - step < 1) step = n - 1; /* one finger is the last that is tried */
    }
    while (low > 0 && high - low > 1) {
        int middle = (low + high) / 2;
        bool fits;
        FW_TRY(try_change(s, &(change){.fingers = middle}, &fits));
        *(fits ? &low : &high) = middle;
    }
    *fingers = low;
    return FW_OK;
}

/* The least width that every mask shows, which is the one that the reason names (fw_layout_rotor_flaw); where fingers as
   wide are not drawn where these ones lie, the narrowest that are, to 0.05 um. 0: width is not what they lack. What is up
   to four times as wide as any mask needs is looked at. */
static fw_status find_width(search *s, double *width_m) {
    const double step_m = 0.05e-6, enough_m = 30e-6, grow = 1.25,
                 stated = fw_device_comb_width_m(s->missing->comb),
                 shown = fw_layout_comb_width_shown();
    double low = fmax(stated, shown), high = 0.0;
    *width_m = 0.0;
    if (stated < shown) {
        bool drawn;
        FW_TRY(try_change(s, &(change){.width_m = shown}, &drawn));
        if (drawn) *width_m = shown;
        if (drawn) return FW_OK;
    }
    for (double w = grow * low; w <= enough_m && high == 0.0; w *= grow) {
        bool fits;
        FW_TRY(try_change(s, &(change){.width_m = w}, &fits));
        *(fits ? &high : &low) = w;
    }
    while (high - low > step_m) {
        const double middle = 0.5 * (low + high);
        bool fits;
        FW_TRY(try_change(s, &(change){.width_m = middle}, &fits));
        *(fits ? &high : &low) = middle;
    }
    if (high == 0.0) return FW_OK;
    bool fits;
    *width_m = step_m * ceil(high / step_m);
    FW_TRY(try_change(s, &(change){.width_m = *width_m}, &fits));
    if (!fits) *width_m = high;
    return FW_OK;
}

/* the longest face of plates that has room, or fingers that end far enough from the others' root; 0: none */
static fw_status find_length(search *s, double *length_m) {
    const fw_device_comb *c = s->missing->comb;
    const bool comb = c->kind == FW_ELECTRODES_COMB;
    const double stated = isnan(c->length_m) ? 2.0 * c->overlap_m : c->length_m;
    const double least = comb ? c->overlap_m + fw_layout_rule.corner_m : 0.1 * stated;
    const double step = fmax(0.1 * stated, STEP_M); /* an overlap of nothing states none */
    bool fits = false;
    *length_m = 0.0;
    if (comb && stated >= least) return FW_OK;
    for (double l = comb ? least : 0.9 * stated; l >= least && !fits; l -= step) {
        *length_m = STEP_M * (comb ? ceil(l / STEP_M - 1e-6) : round(l / STEP_M));
        if (*length_m > 0.0) FW_TRY(try_change(s, &(change){.length_m = *length_m}, &fits));
    }
    if (!fits) *length_m = 0.0;
    return FW_OK;
}

/* the largest share of ring and hole that has room; 0: none */
static fw_status find_ring(search *s, double *share) {
    bool fits = false;
    for (*share = 0.9; *share > 0.25 && !fits; *share -= fits ? 0.0 : 0.1)
        FW_TRY(try_change(s, &(change){.ring = *share}, &fits));
    if (!fits) *share = 0.0;
    return FW_OK;
}

/* ---- in words ---- */

static const char *join_of(const fw_text *text) {
    return text->length ? "; or " : "";
}

static void say_place(const search *s, const change *c, double far_m, fw_text *text) {
    const fw_layout_missing *m = s->missing;
    double x = (m->comb ? m->comb->bx_m : m->eyelet->x_m) + c->x_m,
           y = (m->comb ? m->comb->by_m : m->eyelet->y_m) + c->y_m;
    char at[2][32], far[32];
    fw_text_printf(text, "x=\"%s um\" y=\"%s um\", %s um away", fw_layout_um(at[0], x),
                   fw_layout_um(at[1], y), fw_layout_um(far, far_m));
}

static fw_status room_of_comb(search *s, fw_text *text) {
    const fw_device_comb *c = s->missing->comb;
    char um[2][32];
    int fingers = 0;
    double length;
    FW_TRY(find_length(s, &length));
    if (length > 0.0)
        fw_text_printf(text, "%slength=\"%s um\" instead of %s um", join_of(text),
                       fw_layout_um(um[0], length),
                       fw_layout_um(um[1], isnan(c->length_m) ? 2.0 * c->overlap_m : c->length_m));
    if (c->kind == FW_ELECTRODES_COMB && c->fingers > 1) FW_TRY(find_fingers(s, &fingers));
    if (fingers > 0)
        fw_text_printf(text, "%sfingers=\"%d\" instead of %d", join_of(text), fingers, c->fingers);
    return FW_OK;
}

static fw_status room_of_eyelet(search *s, fw_text *text) {
    const fw_device_eyelet *e = s->missing->eyelet;
    char hole[32], ring[32];
    double share;
    FW_TRY(find_ring(s, &share));
    if (share > 0.0)
        fw_text_printf(
            text, "%shole=\"%s um\" ring=\"%s um\"", join_of(text),
            fw_layout_um(hole, share * (e->hole_m > 0.0 ? e->hole_m : FW_EYELET_HOLE_M)),
            fw_layout_um(ring, share * (e->ring_m > 0.0 ? e->ring_m : FW_EYELET_RING_M)));
    return FW_OK;
}

static void say_width(const search *s, double width_m, fw_text *text) {
    char um[2][32];
    fw_text_printf(text, "width=\"%s um\" instead of %s um", fw_layout_um(um[0], width_m),
                   fw_layout_um(um[1], fw_device_comb_width_m(s->missing->comb)));
}

/* *out NULL: they are wide enough, or it is not their width alone. Where no mask shows them as they are, what else
   they lack is looked for with the width that every mask shows. */
static fw_status width_of_fingers(search *s, const char **out) {
    const fw_device_comb *c = s->missing->comb;
    double width = 0.0;
    *out = NULL;
    if (!c || c->kind != FW_ELECTRODES_COMB) return FW_OK;
    FW_TRY(find_width(s, &width));
    if (width > 0.0) {
        fw_text text = fw_text_new(s->arena);
        say_width(s, width, &text);
        FW_TRY(fw_text_end(&text));
        *out = text.data;
    } else if (fw_device_comb_width_m(c) < fw_layout_comb_width_shown()) {
        s->wider_m = fw_layout_comb_width_shown();
    }
    return FW_OK;
}

static fw_status room_of(search *s, const char **out, bool *narrow) {
    fw_text text = fw_text_new(s->arena);
    change place = {0};
    double far;
    if (s->left == 0) {
        *out = "not looked for: the search ended with the parts before it";
        return FW_OK;
    }
    FW_TRY(width_of_fingers(s, out));
    if ((*narrow = *out != NULL)) return FW_OK;
    FW_TRY(s->missing->comb ? room_of_comb(s, &text) : room_of_eyelet(s, &text));
    fw_text sizes = text;
    text = fw_text_new(s->arena);
    FW_TRY(find_place(s, &place, &far));
    const bool any = far > 0.0 || sizes.length;
    if (any && s->wider_m > 0.0) {
        fw_text_add(&text, "with ");
        say_width(s, s->wider_m, &text);
        fw_text_add(&text, ": ");
    }
    if (far > 0.0) say_place(s, &place, far, &text);
    if (sizes.length) fw_text_printf(&text, "%s%s", far > 0.0 ? "; or " : "", sizes.data);
    if (!any)
        fw_text_printf(&text, "none was found within %.0f mm, nor with another size",
                       1e3 * FARTHEST_M);
    FW_TRY(fw_text_end(&text));
    *out = text.data;
    return FW_OK;
}

fw_status fw_layout_rooms_find(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_layout **out) {
    *out = layout;
    if (!layout || !layout->drawn || layout->nmissing == 0) return FW_OK;
    fw_layout *found = fw_arena_one(arena, fw_layout);
    size_t n = (size_t)layout->nmissing;
    FW_NEED(found);
    *found = *layout;
    FW_NEED(found->missing = fw_arena_grow(arena, layout->missing, n, n, sizeof *found->missing));
    for (size_t i = 0, left = MOST_ALL; i < n; i++) {
        int most = left < MOST_TRIES ? (int)left : MOST_TRIES;
        search s = {arena, device, layout, &layout->missing[i], most, 0.0};
        if (found->missing[i].room || !(s.missing->comb || s.missing->eyelet)) continue;
        FW_TRY(room_of(&s, &found->missing[i].room, &found->missing[i].narrow));
        left -= (size_t)(most - (s.left > 0 ? s.left : 0));
    }
    *out = found;
    return FW_OK;
}
