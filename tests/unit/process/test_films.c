/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The films of the wafer step by step. */
#include "pack_fixture.h"
#include "process/films.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

#define SOI "soi-deep-rie"
#define DOUBLE "soi-double-sided"
static const char *const packs[] = {COPPER, SILICON, SOI, "silicon-on-glass", DOUBLE};
enum { PACKS = sizeof packs / sizeof *packs };
static const fw_process_mask_gap gaps[] = {{FW_GAP_HINGE, "gap of hinge A", 8e-6}};

static fw_process_flow *computed(fw_process_flow *f) {
    fw_process_mask_facts facts = plain_facts;
    facts.gap = gaps;
    facts.ngap = 1;
    facts.narrowest_slot_m = 8e-6;
    assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
    return f;
}

static fw_process_flow *pack(const char *name) {
    fw_process_flow *f = read_pack(arena, name, NULL, NULL, &diags);
    if (strcmp(name, SOI) == 0) measured(f, "release.reach", 20e-6, 0); /* not of a drawing */
    return f;
}

static fw_process_films films_after(const fw_process_flow *f, const char *id) {
    fw_process_films films;
    for (int i = 0; i < f->nstep; i++)
        if (strcmp(f->step[i].id, id) == 0) {
            assert_int_equal(fw_process_flow_films(arena, f, i, &films), FW_OK);
            return films;
        }
    fail_msg("no step %s", id);
    return (fw_process_films){0};
}

static const fw_process_film *film_of(const fw_process_films *films, const char *material,
                                      int column) {
    const fw_process_film *found = NULL;
    for (int i = 0; i < films->n; i++)
        if (strcmp(films->film[i].material, material) == 0 && films->film[i].in[column])
            found = &films->film[i];
    return found;
}

static bool is_floor(const fw_process_film *f) {
    return f->cut && !f->in[FW_STACK_STRUCTURE];
}

static bool stack_has(const fw_process_stack *s, const char *material, int column) {
    for (int i = 0; i < s->n[column]; i++)
        if (strcmp(s->cell[column][i].material, material) == 0) return true;
    return false;
}

/* the lint's own account of the same changes, which knows no heights: the same materials in the
   same column, but for what an etch from the openings has not reached and for floors of narrow ones
 */
static void same_materials_as_the_lint(void **state) {
    (void)state;
    for (int p = 0; p < PACKS; p++) {
        fw_process_flow *f = computed(pack(packs[p]));
        for (int i = 0; i < f->nstep; i++) {
            fw_process_films films;
            fw_process_stack stack;
            assert_int_equal(fw_process_flow_films(arena, f, i, &films), FW_OK);
            assert_int_equal(fw_process_flow_stack(arena, f, i, &stack, NULL), FW_OK);
            for (int column = 0; column < fw_process_flow_columns(f); column++) {
                for (int k = 0; k < films.n; k++)
                    if (films.film[k].in[column] && !is_floor(&films.film[k]) &&
                        !(films.film[k].reach_m > 0.0) &&
                        !stack_has(&stack, films.film[k].material, column))
                        fail_msg("%s %s: %s is too much in column %d", packs[p], f->step[i].id,
                                 films.film[k].material, column);
                for (int k = 0; k < stack.n[column]; k++)
                    if (!film_of(&films, stack.cell[column][k].material, column))
                        fail_msg("%s %s: %s is missing in column %d", packs[p], f->step[i].id,
                                 stack.cell[column][k].material, column);
            }
        }
    }
}

/* films of one column lie on each other without overlap, and as thick as they are stated */
static void films_lie_on_each_other(void **state) {
    (void)state;
    for (int p = 0; p < PACKS; p++) {
        fw_process_flow *f = computed(pack(packs[p]));
        for (int i = 0; i < f->nstep; i++) {
            fw_process_films films;
            assert_int_equal(fw_process_flow_films(arena, f, i, &films), FW_OK);
            for (int column = 0; column < fw_process_flow_columns(f); column++) {
                double top = -1.0;
                for (int k = 0; k < films.n; k++) {
                    const fw_process_film *c = &films.film[k];
                    if (!c->in[column] || is_floor(c)) continue;
                    assert_true(c->bottom_m >= top - 1e-15 && c->top_m > c->bottom_m);
                    top = c->top_m;
                    if (!c->shortened && !isnan(c->thickness_m))
                        assert_near(c->top_m - c->bottom_m, c->thickness_m, 1e-15);
                }
            }
        }
    }
}

/* plating puts its thickness on the seed, between walls of resist */
static void copper(void **state) {
    (void)state;
    fw_process_flow *f = computed(pack(COPPER));
    fw_process_films films = films_after(f, "C22");
    const fw_process_film *cu = film_of(&films, "copper-plated", FW_STACK_STRUCTURE);
    const fw_process_film *resist = film_of(&films, "resist", FW_STACK_FIELD);
    const fw_process_film *seed = film_of(&films, "copper-seed", FW_STACK_STRUCTURE);
    assert_non_null(cu);
    assert_false(cu->in[FW_STACK_FIELD]);
    assert_false(resist->in[FW_STACK_STRUCTURE]);
    assert_near(cu->top_m - cu->bottom_m, 9e-6, 1e-18);
    assert_near(cu->bottom_m, seed->top_m, 0);
    assert_near(resist->top_m - seed->top_m, 16e-6, 1e-16);
    assert_near(cu->foot_m, 0, 1e-18); /* nothing known about printing and walls: as drawn */
    assert_true(isnan(seed->thickness_m));
    assert_true(film_of(&films, "silicon-substrate", 0)->shortened);
    /* unknown reach: drawn as if everything were gone, and said */
    films = films_after(f, "C26");
    assert_null(film_of(&films, "porous-silicon", FW_STACK_STRUCTURE));
    bool said = false;
    for (int i = 0; i < films.nnote; i++)
        said = said || strstr(films.note[i], "C26");
    assert_true(said);
    /* known: below the structure it stays beyond the reach and its overrun */
    f = pack(COPPER);
    measured(f, "release.reach", 30e-6, 0);
    films = films_after(computed(f), "C26");
    assert_near(film_of(&films, "porous-silicon", FW_STACK_STRUCTURE)->reach_m, 36e-6, 1e-18);
    assert_null(film_of(&films, "porous-silicon", FW_STACK_FIELD));
}

/* walls of resist that lean: the copper has the slope that the corners of the flow have */
static void walls_that_lean(void **state) {
    (void)state;
    fw_process_flow *f = pack(COPPER);
    measured(f, "made.wall", 0.02, 0);
    computed(f);
    const fw_process_fixed_point *p = &f->edges;
    assert_true(fabs(p->flare_m) > 1e-8);
    fw_process_films films = films_after(f, "C28");
    const fw_process_film *cu = film_of(&films, "copper-plated", FW_STACK_STRUCTURE);
    assert_near(cu->foot_m, p->cls[p->field].edge.bottom_m, 1e-15);
    assert_near(cu->head_m, p->cls[p->field].edge.top_m, 1e-15);
}

/* the walls after the etch are those of the fixed point, whatever A, S and overrun are */
static void silicon_walls(void **state) {
    (void)state;
    static const double A[] = {0.95, 0.98, 0.995, 1.0};
    for (int i = 0; i < 4; i++) {
        fw_process_flow *f = pack(SILICON);
        measured(f, "rie.A", A[i], 0);
        measured(f, "rie.S", 0.02 * i, 0);
        computed(f);
        const fw_process_fixed_point *p = &f->edges;
        assert_true(p->solved);
        const fw_process_edge e = p->cls[p->field].edge;
        fw_process_films films = films_after(f, "S14");
        assert_near(film_of(&films, "aluminium", 0)->foot_m, p->etch_m, 1e-15);
        assert_near(film_of(&films, "resist", 0)->foot_m, p->bias_m - p->printed_m, 1e-15);
        films = films_after(f, "S23");
        const fw_process_film *si = film_of(&films, "silicon-100", FW_STACK_STRUCTURE);
        assert_near(si->head_m, e.top_m, 1e-15);
        assert_near(si->foot_m, e.bottom_m, 1e-15);
        assert_ptr_equal(si->cut, &p->cut[0]);
        assert_null(film_of(&films, "aluminium", 0));
        assert_null(film_of(&films, "carrier", 0));
    }
    /* nobody knows A: straight walls, and a sentence */
    fw_process_flow *f = computed(pack(SILICON));
    fw_process_films films = films_after(f, "S18");
    const fw_process_film *si = film_of(&films, "silicon-100", FW_STACK_STRUCTURE);
    assert_near(si->head_m, si->foot_m, 0);
    bool said = false;
    for (int i = 0; i < films.nnote; i++)
        said = said || strstr(films.note[i], "rie.A");
    assert_true(said);
    /* what the plasma takes of the mask: d (1 + overrun)/S */
    double al = film_of(&films, "aluminium", 0)->thickness_m;
    fw_process_films before = films_after(f, "S17");
    assert_near(film_of(&before, "aluminium", 0)->thickness_m - al, 50e-6 * 1.1 / 100.0, 1e-15);
}

/* z + lag(w, z) = E, or the whole depth where the whole time suffices */
static void depth_by_width(void **state) {
    (void)state;
    fw_process_flow *f = computed(pack(SILICON)); /* S = 0.1 is assumed: planned without it */
    const fw_process_cut *cut = &f->edges.cut[0];
    double before = 0.0;
    for (double w = 1e-6; w < 200e-6; w *= 1.3) {
        double z = fw_process_cut_depth(cut, w);
        assert_true(z >= before && z <= cut->depth_m);
        before = z;
        if (z < cut->depth_m)
            assert_near(z + fw_process_cut_lag(cut, w, z), cut->etched_m, 1e-15);
        else
            assert_true(cut->depth_m + fw_process_cut_lag(cut, w, cut->depth_m) <= cut->etched_m);
    }
    assert_near(before, cut->depth_m, 0);
    assert_true(fw_process_cut_depth(cut, 2e-6) < 0.95 * cut->depth_m);
    /* process.md, 2.7: 90 min without overrun, S = 0.1: 38.5921 um in 2 um, 45.8113 um in 10 um */
    fw_process_cut plain = *cut;
    plain.etched_m = 50e-6;
    assert_near(fw_process_cut_depth(&plain, 2e-6), 38.5921e-6, 1e-10);
    assert_near(fw_process_cut_depth(&plain, 10e-6), 45.8113e-6, 1e-10);
    assert_near(fw_process_cut_depth(&plain, (double)INFINITY), 50e-6, 1e-19);
}

/* the third flow, of which no line of code knows */
static void soi(void **state) {
    (void)state;
    fw_process_flow *f = computed(pack(SOI));
    const fw_process_fixed_point *p = &f->edges;
    fw_process_films films = films_after(f, "D13");
    const fw_process_film *si = film_of(&films, "silicon-100", FW_STACK_STRUCTURE);
    const fw_process_film *box = film_of(&films, "buried-oxide", FW_STACK_STRUCTURE);
    assert_near(si->head_m, p->cls[p->field].edge.top_m, 1e-15);
    assert_near(si->foot_m, p->cls[p->field].edge.bottom_m, 1e-15);
    assert_near(box->top_m - box->bottom_m, 2e-6, 1e-18);
    assert_near(box->reach_m, 24e-6, 1e-18);
    assert_null(film_of(&films, "buried-oxide", FW_STACK_FIELD));
    assert_null(film_of(&films, "resist", 0));
    assert_true(film_of(&films, "silicon-substrate", 1)->shortened);
}

/* a pack may remove a part of a film, from either side, and etch the structure beside the field */
static void partial_and_back(void **state) {
    (void)state;
    fw_process_flow *f = computed(pack(SOI));
    fw_process_step *s = step_of(f, "D13");
    fw_quantity ten = {.id = "ten", .value = 10e-6}, three = {.id = "three", .value = 3e-6};
    fw_process_change c[] = {{.kind = "remove",
                              .material = "silicon-100",
                              .thickness = &ten,
                              .where = "structure",
                              .from = ""},
                             {.kind = "add",
                              .material = "aluminium",
                              .thickness = &three,
                              .where = "all",
                              .from = "",
                              .back = true}};
    fw_process_films before = films_after(f, "D13"), after;
    double top = film_of(&before, "silicon-100", 0)->top_m;
    double low = film_of(&before, "silicon-substrate", 0)->bottom_m;
    s->change = c;
    s->nchange = 2;
    after = films_after(f, "D13");
    const fw_process_film *si = film_of(&after, "silicon-100", 0),
                          *al = film_of(&after, "aluminium", 1);
    assert_near(si->top_m, top - 10e-6, 1e-18);
    assert_near(si->thickness_m, 40e-6, 1e-18);
    assert_near(al->top_m, low, 0);
    assert_near(al->bottom_m, low - 3e-6, 1e-18);
}

/* reach: a length, and of a removal */
static void reach_is_checked(void **state) {
    (void)state;
    static const char from[] = "where=\"field\" reach=\"release.reach\"";
    assert_null(read_pack(arena, SOI, from, "where=\"field\" reach=\"release.R\"", &diags));
    assert_non_null(strstr(diags.item[diags.count - 1].message, "not a length"));
    assert_null(read_pack(arena, SOI, "<change kind=\"add\" material=\"buried-oxide\"",
                          "<change kind=\"add\" reach=\"box.d\" material=\"buried-oxide\"",
                          &diags));
    assert_non_null(strstr(diags.item[diags.count - 1].message, "kind='remove'"));
}

/* A window from the back: covered on both faces until it is opened, (1 - A) of the way wider than its plate at the back and
   of the over-etch at its end; resist of either face goes with that face alone. Own sums: D = 400 um, E = 1.1 D. */
static void windows_from_the_back(void **state) {
    (void)state;
    fw_process_flow *f = read_pack(arena, DOUBLE, NULL, NULL, &diags);
    measured(f, "back.A", 0.98, 0);
    computed(f);
    bool open[FW_STACK_MOST];
    int opened = 0;
    for (int k = 0; k < fw_process_flow_columns(f); k++)
        opened += open[k] = fw_process_where_holds(f, "window", k);
    assert_int_equal(opened, 2);
    fw_process_films coated = films_after(f, "B15"), developed = films_after(f, "B18"),
                     etched = films_after(f, "B20"), bare = films_after(f, "B22"),
                     end = films_after(f, "B24");
    for (int k = 0; k < fw_process_flow_columns(f); k++) {
        const bool field = fw_process_where_holds(f, "field", k);
        int back[2] = {0}, front[2] = {0};
        for (int i = 0; i < coated.n; i++)
            if (coated.film[i].in[k] && strcmp(coated.film[i].material, "resist") == 0)
                (coated.film[i].back ? back : front)[0]++;
        for (int i = 0; i < developed.n; i++)
            if (developed.film[i].in[k] && strcmp(developed.film[i].material, "resist") == 0)
                (developed.film[i].back ? back : front)[1]++;
        assert_int_equal(front[0], 1);
        assert_int_equal(front[1], 1); /* the cover is not exposed */
        assert_int_equal(back[0], 1);
        assert_int_equal(back[1], !open[k]);
        assert_int_equal(film_of(&etched, "silicon-substrate", k) == NULL, open[k]);
        assert_non_null(film_of(&etched, "buried-oxide", k));
        assert_null(film_of(&bare, "resist", k));
        assert_int_equal(film_of(&end, "buried-oxide", k) == NULL, open[k] || field);
        const fw_process_film *handle = film_of(&etched, "silicon-substrate", k);
        if (!handle) continue;
        assert_near(handle->further[0].foot_m, 0.02 * 440e-6, 1e-12);
        assert_near(handle->further[0].head_m, 0.02 * 40e-6, 1e-12);
    }
    /* the back's resist is thinner by what its etch takes, the cover is not met */
    for (int i = 0; i < etched.n; i++)
        if (strcmp(etched.film[i].material, "resist") == 0)
            assert_near(etched.film[i].thickness_m,
                        etched.film[i].back ? 10e-6 - 440e-6 / 75 : 5e-6, 1e-12);
    bool nothing_below, hollow;
    const char *material;
    assert_null(fw_process_flow_gap(f, &nothing_below, &hollow, &material));
    assert_true(nothing_below && !hollow);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(same_materials_as_the_lint, setup, teardown),
        cmocka_unit_test_setup_teardown(films_lie_on_each_other, setup, teardown),
        cmocka_unit_test_setup_teardown(copper, setup, teardown),
        cmocka_unit_test_setup_teardown(walls_that_lean, setup, teardown),
        cmocka_unit_test_setup_teardown(silicon_walls, setup, teardown),
        cmocka_unit_test_setup_teardown(depth_by_width, setup, teardown),
        cmocka_unit_test_setup_teardown(soi, setup, teardown),
        cmocka_unit_test_setup_teardown(partial_and_back, setup, teardown),
        cmocka_unit_test_setup_teardown(windows_from_the_back, setup, teardown),
        cmocka_unit_test_setup_teardown(reach_is_checked, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
