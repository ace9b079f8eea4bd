/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Design rules on layouts of which the answer is known: a field of parts that keep every rule, with
   none or one part that breaks one, at random places, turned and mirrored at random. 200 parts from
   0.5 to 0.997 of a limit are each found once, at the place and with the value of closed forms, to
   what flattening changes; 200 fields from 1.001 to 3 times the limits have no finding; one edge
   moved over the limit by what flattening changes and 1 nm changes the answer. */
#include "rule_field.h"

typedef struct known { /* what breaks a rule */
    const fw_mask_rule_kind_row *kind;
    fw_layout_role role; /* its layer */
    double value;        /* SI */
    fw_geometry_vec2 at; /* middle of the worst chord, */
    double within_m;     /* to this; 0: 1 pm */
    const char *label;   /* of one of the pieces */
} known;

/* ---- the parts: each has one dimension, `size` in um, um2 or degrees, that may be below the
   limit, and keeps all else. What is broken then comes back in *k. ---- */

static void bar(field *f, double size, known *k) {
    double w = size, l = round(between(f, 20, 120));
    draw_box(f, FW_ROLE_STRUCTURE, 0, 0, l, w);
    *k = (known){&fw_mask_kind_width,    FW_ROLE_STRUCTURE, w * UM,
                 world(f, l / 2, w / 2), l / 2 * UM,        0};
}

static void bend(field *f, double size, known *k) {
    double w = size, r = between(f, 40, 80), sweep = between(f, 0.6, 2.8);
    draw_ring(f, FW_ROLE_STRUCTURE, r, r + w, -sweep / 2, sweep);
    *k = (known){&fw_mask_kind_width, FW_ROLE_STRUCTURE, w * UM, world(f, r, 0), (r + w) * UM, 0};
}

/* across a disc: normals enclose 90 degrees and more over R sqrt 2 and more */
static void disc(field *f, double size, known *k) {
    double across = size;
    draw_disc(f, FW_ROLE_STRUCTURE, 3, 4, across / sqrt(2));
    *k = (known){&fw_mask_kind_width, FW_ROLE_STRUCTURE, across * UM,
                 world(f, 3, 4),      across * UM,       0};
}

static void parallel(field *f, double size, known *k) {
    double g = size, l = round(between(f, 20, 80)), shift = round(between(f, -15, 15));
    draw_box(f, FW_ROLE_STRUCTURE, 0, -10, l, 0);
    draw_box(f, FW_ROLE_STRUCTURE, shift, g, shift + l, g + 12);
    *k = (known){&fw_mask_kind_space, FW_ROLE_STRUCTURE, g * UM, world(f, l / 2, g / 2), l * UM, 0};
}

static void corners(field *f, double size, known *k) {
    double g = size, a = between(f, 0.2, 1.3), x = g * cos(a), y = g * sin(a);
    draw_box(f, FW_ROLE_STRUCTURE, -30, -20, 0, 0);
    draw_box(f, FW_ROLE_STRUCTURE, x, y, x + 25, y + 40);
    *k = (known){&fw_mask_kind_space, FW_ROLE_STRUCTURE, g * UM, world(f, x / 2, y / 2), 0, 0};
}

static void discs(field *f, double size, known *k) {
    double g = size, r = between(f, 10, 40), q = between(f, 10, 40);
    draw_disc(f, FW_ROLE_STRUCTURE, -r, 0, r);
    draw_disc(f, FW_ROLE_STRUCTURE, g + q, 0, q);
    *k = (known){&fw_mask_kind_space, FW_ROLE_STRUCTURE, g * UM, world(f, g / 2, 0), 0, 0};
}

static void disc_on_bar(field *f, double size, known *k) {
    double g = size, r = between(f, 10, 40);
    draw_disc(f, FW_ROLE_STRUCTURE, 0, g + r, r);
    draw_box(f, FW_ROLE_STRUCTURE, -50, -10, 60, 0);
    *k = (known){&fw_mask_kind_space, FW_ROLE_STRUCTURE, g * UM, world(f, 0, g / 2), 0, 0};
}

static void conjugate(field *f, double size, known *k) {
    double g = size, r = between(f, 30, 50), sweep = between(f, 0.6, 2.8);
    draw_disc(f, FW_ROLE_STRUCTURE, 0, 0, r);
    draw_ring(f, FW_ROLE_STRUCTURE, r + g, r + g + 10, -sweep / 2, sweep);
    *k = (known){&fw_mask_kind_space, FW_ROLE_STRUCTURE, g * UM, world(f, r, 0), (r + g) * UM, 0};
}

static void fork(field *f, double size, known *k) {
    double g = size, d = round(between(f, 20, 60));
    const double p[8][2] = {{-g, 0},  {30, 0},      {30, 12 + d},     {20, 12 + d},
                            {20, 12}, {20 - g, 12}, {20 - g, 12 + d}, {-g, 12 + d}};
    draw_polygon(f, FW_ROLE_STRUCTURE, p, 8);
    *k = (known){&fw_mask_kind_notch,
                 FW_ROLE_STRUCTURE,
                 g * UM,
                 world(f, 20 - g / 2, 12 + d / 2),
                 d * UM,
                 0};
}

/* a ring that is open by a mouth: from corner to corner */
static void mouth(field *f, double size, known *k) {
    double g = size, r = between(f, 25, 45), half = asin(g / (2 * r));
    draw_ring(f, FW_ROLE_STRUCTURE, r, r + 15, half, 2 * (PI - half));
    *k = (known){&fw_mask_kind_notch, FW_ROLE_STRUCTURE, g * UM, world(f, r * cos(half), 0), 0, 0};
}

static void thin_line(field *f, double size, known *k) {
    double w = size, l = round(between(f, 20, 120));
    draw_box(f, FW_ROLE_FLEXURE, 0, 0, l, w);
    *k = (known){&fw_mask_kind_feature,  FW_ROLE_FLEXURE, w * UM,
                 world(f, l / 2, w / 2), l / 2 * UM,      0};
}

static void thin_gap(field *f, double size, known *k) {
    double g = size, r = between(f, 10, 40);
    draw_disc(f, FW_ROLE_FLEXURE, 0, g + r, r);
    draw_box(f, FW_ROLE_FLEXURE, -50, -10, 60, 0);
    *k = (known){&fw_mask_kind_feature, FW_ROLE_FLEXURE, g * UM, world(f, 0, g / 2), 0, 0};
}

static void island(field *f, double size, known *k) {
    double area = size, r = sqrt(area / PI);
    draw_disc(f, FW_ROLE_FRAME, 2, 1, r);
    *k = (known){&fw_mask_kind_area, FW_ROLE_FRAME, area * UM * UM, world(f, 2, 1), 0, 0};
}

/* a ring of two joined halves around a hole */
static void hole(field *f, double size, known *k) {
    double area = size, ri = sqrt(area / PI), ro = ri + 15;
    fw_geometry_vec2 e[4] = {{ri * UM, 0}, {ro * UM, 0}, {-ro * UM, 0}, {-ri * UM, 0}};
    for (int lower = 0; lower < 2; lower++) {
        const fw_geometry_vec2 p[4] = {e[lower ? 3 : 0], e[lower ? 2 : 1], e[lower ? 1 : 2],
                                       e[lower ? 0 : 3]};
        draw(f, FW_ROLE_FRAME, scene_half_ring(f->s->arena, p));
    }
    *k = (known){&fw_mask_kind_area, FW_ROLE_FRAME, area * UM * UM, world(f, 0, 0), 0, 0};
}

static void letter(field *f, double size, known *k) {
    double e = size, h = round(between(f, 10, 30));
    draw_box(f, FW_ROLE_FRAME, -60, 0, 60, 100);
    draw_box(f, FW_ROLE_TEXT, -20, e, 30, e + h);
    *k = (known){&fw_mask_kind_enclosure, FW_ROLE_TEXT, e * UM, world(f, 5, e / 2), 26 * UM, 0};
}

/* a disc in a disc, off its middle */
static void dot(field *f, double size, known *k) {
    double e = size, r = between(f, 5, 15), all = between(f, 50, 80);
    draw_disc(f, FW_ROLE_FRAME, 0, 0, all);
    draw_disc(f, FW_ROLE_TEXT, all - e - r, 0, r);
    *k = (known){&fw_mask_kind_enclosure, FW_ROLE_TEXT, e * UM, world(f, all - e / 2, 0), 0, 0};
}

static void mark_beside(field *f, double size, known *k) {
    double g = size, r = between(f, 5, 30);
    draw_box(f, FW_ROLE_FRAME, -50, -40, 60, 0);
    draw_disc(f, FW_ROLE_MARK, 0, g + r, r);
    *k = (known){&fw_mask_kind_separation, FW_ROLE_MARK, g * UM, world(f, 0, g / 2), 0, 0};
}

static void mark_at_corner(field *f, double size, known *k) {
    double g = size, a = between(f, 0.2, 1.3), x = g * cos(a), y = g * sin(a);
    draw_box(f, FW_ROLE_FRAME, -50, -40, 0, 0);
    draw_box(f, FW_ROLE_MARK, x, y, x + 5, y + 9);
    *k = (known){&fw_mask_kind_separation, FW_ROLE_MARK, g * UM, world(f, x / 2, y / 2), 0, 0};
}

static void gable(field *f, double size, known *k) {
    double angle = fmin(size, 168) * DEG, half = 20, rise = half / tan(angle / 2);
    const double p[5][2] = {{-half, 0}, {half, 0}, {half, 30}, {0, 30 + rise}, {-half, 30}};
    draw_polygon(f, FW_ROLE_TETHER, p, 5);
    *k = (known){&fw_mask_kind_angle, FW_ROLE_TETHER, angle, world(f, 0, 30 + rise), 0, 0};
}

static void valley(field *f, double size, known *k) {
    double angle = fmin(size, 168) * DEG, half = 15, deep = half / tan(angle / 2);
    const double p[7][2] = {{-40, -60}, {40, -60},  {40, 0}, {half, 0},
                            {0, -deep}, {-half, 0}, {-40, 0}};
    draw_polygon(f, FW_ROLE_TETHER, p, 7);
    *k = (known){&fw_mask_kind_angle, FW_ROLE_TETHER, angle, world(f, 0, -deep), 0, 0};
}

/* a slice of a disc: square where the arc begins and ends */
static void slice(field *f, double size, known *k) {
    double angle = fmin(size, 168) * DEG, r = between(f, 20, 50) * UM;
    fw_geometry_outline o = fw_geometry_outline_start(f->s->arena, (fw_geometry_vec2){0, 0});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){r, 0}, 0);
    fw_geometry_outline_arc(&o, (fw_geometry_vec2){0, 0}, angle, 0);
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    draw(f, FW_ROLE_TETHER, c);
    *k = (known){&fw_mask_kind_angle, FW_ROLE_TETHER, angle, world(f, 0, 0), 0, 0};
}

static void step(field *f, double size, known *k) {
    double e = size;
    const double p[6][2] = {{0, 0}, {50, 0}, {50, 30}, {25, 30}, {25, 30 - e}, {0, 30 - e}};
    draw_polygon(f, FW_ROLE_TETHER, p, 6);
    *k = (known){&fw_mask_kind_edge, FW_ROLE_TETHER, e * UM, world(f, 25, 30 - e / 2), 0, 0};
}

/* one corner rounded by an arc of that length */
static void rounded(field *f, double size, known *k) {
    double e = size, r = e / (PI / 2), m = r * (1 - sqrt(0.5));
    fw_geometry_outline o = fw_geometry_outline_start(f->s->arena, (fw_geometry_vec2){0, 0});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){40 * UM, 0}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){40 * UM, (30 - r) * UM}, 0);
    fw_geometry_outline_arc_to(&o, (fw_geometry_vec2){(40 - r) * UM, (30 - r) * UM}, PI / 2,
                               (fw_geometry_vec2){(40 - r) * UM, 30 * UM}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){0, 30 * UM}, 0);
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    draw(f, FW_ROLE_TETHER, c);
    *k = (known){&fw_mask_kind_edge, FW_ROLE_TETHER, e * UM, world(f, 40 - m, 30 - m), r * UM, 0};
}

/* what is written: vertices on the grid, by quarter turns only */
static void to_grid(field *f) {
    f->pose = (fw_geometry_pose){round(f->pose.x_m / UM) * UM, round(f->pose.y_m / UM) * UM,
                                 0.5 * PI * (int)between(f, 0, 4)};
}

static void written_gable(field *f, double size, known *k) {
    double angle = fmin(size, 168) * DEG, half = 20;
    double rise = round(half / tan(angle / 2) * 1000) / 1000;
    const double p[5][2] = {{-half, 0}, {half, 0}, {half, 30}, {0, 30 + rise}, {-half, 30}};
    to_grid(f);
    draw_polygon(f, FW_ROLE_DICING, p, 5);
    *k = (known){
        &fw_mask_kind_angle, FW_ROLE_DICING, 2 * atan2(half, rise), world(f, 0, 30 + rise), 0, 0};
}

static void written_step(field *f, double size, known *k) {
    double e = floor(size * 1000 + 1e-6) / 1000;
    const double p[6][2] = {{0, 0}, {50, 0}, {50, 30}, {25, 30}, {25, 30 - e}, {0, 30 - e}};
    to_grid(f);
    draw_polygon(f, FW_ROLE_DICING, p, 6);
    *k = (known){&fw_mask_kind_edge, FW_ROLE_DICING, e * UM, world(f, 25, 30 - e / 2), 1e-9, 0};
}

typedef struct part {
    void (*draw)(field *f, double size, known *k);
    double limit; /* in the unit of size */
    bool slack;   /* a length that flattening takes from */
} part;
static const part parts[] = {
    {bar, 4, true},
    {bend, 4, true},
    {disc, 4, true},
    {parallel, 4, true},
    {corners, 4, true},
    {discs, 4, true},
    {disc_on_bar, 4, true},
    {conjugate, 4, true},
    {fork, 5, true},
    {mouth, 5, true},
    {thin_line, 4.05, true},
    {thin_gap, 4.05, true},
    {island, 400, false},
    {hole, 400, false},
    {letter, 6, true},
    {dot, 6, true},
    {mark_beside, 7, true},
    {mark_at_corner, 7, true},
    {gable, 60, false},
    {valley, 60, false},
    {slice, 60, false},
    {step, 1, false},
    {rounded, 1, false},
    {written_gable, 60, false},
    {written_step, 0.3, false},
};
enum { PARTS = sizeof parts / sizeof parts[0], ROW = 6 };

/* ---- the fields ---- */

/* Chords of a small disc face each other across less than a quarter of it: the turn of one chord
   less, 2 acos(1 - eps/R), which is 6.8 degrees of one of R = 2.8 um. */
static const double DISC_MORE = 1.07;

/* 1.001 to 3 times what is needed; as many near it as far from it */
static double clean_size(field *f, const part *p) {
    double u = random01(&f->seed), needed = p->limit + (p->slack ? MOST_SLACK_M / UM : 0);
    if (p->draw == disc) needed *= DISC_MORE;
    return 1.001 * pow(3 / 1.001, u * u) * needed;
}

/* every part in a cell of its own, 600 um apart; part `bad` breaks its rule */
static known draw_field(field *f, int bad, double ratio) {
    known k = {0}, broken = {0};
    for (int i = 0; i < PARTS; i++) {
        f->pose =
            (fw_geometry_pose){(600 * (i % ROW) + between(f, -60, 60)) * UM,
                               (600 * (i / ROW) + between(f, -60, 60)) * UM, between(f, -PI, PI)};
        f->mirror = random01(&f->seed) < 0.5;
        f->label = fw_arena_printf(f->s->arena, "part %d", i);
        double clean = clean_size(f, &parts[i]);
        parts[i].draw(f, i == bad ? ratio * parts[i].limit : clean, &k);
        if (i == bad) broken = k, broken.label = f->label;
    }
    return broken;
}

static bool is_chord(const fw_mask_rule_kind_row *kind) {
    return kind->unit == FW_UNIT_LENGTH && kind != &fw_mask_kind_edge;
}

static void is_the_known(const fw_mask_finding *g, const known *k, int trial) {
    if (g->rule->kind != k->kind || g->rule->layer != (int)k->role)
        fail_msg("field %d: rule %s on layer %d, not %s on %d", trial, g->rule->kind->name,
                 g->rule->layer, k->kind->name, (int)k->role);
    bool chord = is_chord(k->kind), round = k->label && k->within_m == k->value;
    double off_m = chord ? MOST_SLACK_M : 1e-9 * k->value;
    if (!(g->value - k->value <= off_m && k->value - g->value <= off_m * (round ? 25 : 1)))
        fail_msg("field %d, %s: value %.12g, not %.12g", trial, k->kind->name, g->value, k->value);
    fw_geometry_vec2 middle = vec_scale(0.5, vec_add(g->at[0], g->at[1]));
    double off = vec_distance(middle, k->at);
    /* the middle of a chord of an arc, where that is nearer than the arc itself */
    if (!(off <= k->within_m + (chord ? 1.5 * UM : 1e-12)))
        fail_msg("field %d, %s: %g um from its place", trial, k->kind->name, off / UM);
    if (chord) assert_near(vec_distance(g->at[0], g->at[1]), g->value, 1e-12);
    assert_true(g->box.x0 <= middle.x + 1e-12 && middle.x <= g->box.x1 + 1e-12);
    assert_true(g->needed == g->limit);
    assert_true(g->limit == g->rule->least && g->value < g->limit);
    if (k->label) assert_string_equal(g->label[0], k->label);
}

/* ---- density: a disc in every window ---- */

static known draw_windows(field *f, int bad, double ratio) {
    f->rule[0] = window_rule();
    f->s->table.nrule = 1;
    f->pose = (fw_geometry_pose){between(f, -1000, 1000) * UM, between(f, -1000, 1000) * UM, 0};
    f->label = "disc";
    draw_box(f, FW_ROLE_FRAME, 0, 0, 100 * WINDOWS, 100 * WINDOWS);
    known broken = {0};
    for (int i = 0; i < WINDOWS * WINDOWS; i++) {
        double x = 100 * (i % WINDOWS), y = 100 * (i / WINDOWS), share = between(f, 0.2002, 0.4995);
        bool low = random01(&f->seed) < 0.5;
        if (i == bad) share = low ? 0.2 * ratio : fmin(0.5 / ratio, 0.7);
        double r = 100 * sqrt(share / PI);
        draw_disc(f, FW_ROLE_DICING, x + 50, y + 50, r);
        if (i == bad)
            broken = (known){
                &fw_mask_kind_density, FW_ROLE_DICING, share, world(f, x + 50, y + 50), 0, 0};
    }
    return broken;
}

/* ---- the tests ---- */

static void seeded(void **state) {
    (void)state;
    int found[PARTS + 1] = {0};
    for (int trial = 0; trial < 200; trial++) {
        field *f = field_new(1000 + (uint64_t)trial);
        int bad = trial % (PARTS + 1);
        double ratio = trial % 3 == 0 ? 0.997 : between(f, 0.5, 0.997);
        known k = bad == PARTS ? draw_windows(f, (int)between(f, 0, WINDOWS * WINDOWS), ratio)
                               : draw_field(f, bad, ratio);
        const fw_mask *mask = examine(f->s);
        if (mask->nfinding != 1) {
            print_findings(mask);
            fail_msg("field %d: %d findings of one %s", trial, mask->nfinding, k.kind->name);
        }
        const fw_mask_finding *g = &mask->finding[0];
        if (k.kind == &fw_mask_kind_density) {
            assert_near(g->value, k.value, 1e-9 * k.value);
            assert_near(vec_distance(vec_scale(0.5, vec_add(g->at[0], g->at[1])), k.at), 0, 1e-12);
        } else {
            is_the_known(g, &k, trial);
        }
        found[bad]++;
        scene_free(f->s);
    }
    for (int i = 0; i <= PARTS; i++)
        assert_true(found[i] >= 7);
}

static void clean(void **state) {
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        field *f = field_new(5000 + (uint64_t)trial);
        if (trial % 8 == 7)
            draw_windows(f, -1, 1);
        else
            draw_field(f, -1, 1);
        const fw_mask *mask = examine(f->s);
        print_findings(mask);
        if (mask->nfinding > 0) fail_msg("field %d: %d findings", trial, mask->nfinding);
        scene_free(f->s);
    }
}

/* The part alone, with its dimension 1 nm (areas, angles: 1e-4) and what flattening changes below or
   above the limit. That is written out here: nothing for lines on the grid, 1/sqrt 2 nm for each
   other line, 5 nm more for each arc. */
static void one_step_over_the_limit(void **state) {
    (void)state;
    const double line = 0.70710678118654752e-3, arc = 5e-3 + line;
    const struct {
        void (*draw)(field *f, double size, known *k);
        double limit, slack;
        bool turned;
    } at[] = {
        {bar, 4, 0, false},
        {bar, 4, 2 * line, true},
        {bend, 4, 2 * arc, true},
        {parallel, 4, 0, false},
        {parallel, 4, 2 * line, true},
        {discs, 4, 2 * arc, true},
        {conjugate, 4, 2 * arc, true},
        {corners, 4, 2 * line, true},
        {disc_on_bar, 4, arc + line, true},
        {fork, 5, 0, false},
        {fork, 5, 2 * line, true},
        {thin_line, 4.05, 2 * line, true},
        {thin_gap, 4.05, arc + line, true},
        {letter, 6, 0, false},
        {letter, 6, 2 * line, true},
        {dot, 6, 2 * arc, true},
        {mark_beside, 7, arc + line, true},
        {mark_at_corner, 7, 2 * line, true},
        {step, 1, 0, true},
        {rounded, 1, 0, true},
        {written_step, 0.3, 0, false},
        {island, 400, 0, true},
        {hole, 400, 0, true},
        {gable, 60, 0, true},
        {valley, 60, 0, true},
        {slice, 60, 0, true},
        {written_gable, 60, 0, false},
    };
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++)
        for (int more = 0; more < 2; more++) {
            field *f = field_new(77);
            known k;
            double by = at[i].limit < 10 ? 1e-3 : 1e-4 * at[i].limit;
            f->label = "part";
            f->pose = (fw_geometry_pose){17 * UM, -40 * UM, at[i].turned ? 0.3 : 0};
            at[i].draw(f, at[i].limit + (more ? 1 : -1) * (at[i].slack + by), &k);
            const fw_mask *mask = examine(f->s);
            if (mask->nfinding != !more)
                fail_msg("case %d, %s, %s: %d findings", (int)i, k.kind->name,
                         more ? "above" : "below", mask->nfinding);
            scene_free(f->s);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(seeded),
        cmocka_unit_test(clean),
        cmocka_unit_test(one_step_over_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
