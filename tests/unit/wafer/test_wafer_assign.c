/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which place is what: every rule of wafer_grid.c by itself. */
#include "mask/scene.h"
#include "wafer/wafer.h"
#include <stdlib.h>

typedef struct bench {
    fw_arena *arena;
    fw_diags diags;
    fw_device_wafer_asked asked;
    fw_wafer_form form;
    fw_wafer_grid grid;
} bench;

static bench *begin(void) {
    fw_arena *arena = fw_arena_new(0);
    bench *b = fw_arena_one(arena, bench);
    double none = (double)NAN;
    *b = (bench){.arena = arena,
                 .diags = fw_diags_new(arena),
                 .asked = {.asked = true,
                           .diameter_m = 0.1,
                           .flat_m = none,
                           .edge_m = 3e-3,
                           .pitch_x_m = none,
                           .pitch_y_m = none,
                           .plate_m = none}};
    return b;
}

static void assign(bench *b, int32_t width, int32_t height) {
    assert_int_equal(fw_wafer_form_of(&b->asked, &b->diags, &b->form), FW_OK);
    assert_int_equal(
        fw_wafer_grid_fill(b->arena, &b->form, &b->asked, width, height, &b->diags, &b->grid),
        FW_OK);
    assert_int_equal(fw_wafer_assign(&b->form, &b->asked, &b->diags, &b->grid), FW_OK);
}

static int count(const bench *b, fw_wafer_kind kind) {
    int n = 0;
    for (int i = 0; i < b->grid.nsite; i++)
        n += b->grid.site[i].kind == kind;
    return n;
}

static void sweep(bench *b, int k, int steps) {
    b->asked.sweep[k] = (fw_device_sweep){.steps = steps, .unit = ""};
    b->asked.nsweep = k + 1;
}

/* the farthest two places of the wafer in one row */
static void test_alignment(void **state) {
    (void)state;
    for (int centre = 0; centre < 3; centre++) {
        bench *b = begin();
        b->asked.alignment = true;
        b->asked.centre = (fw_device_wafer_centre)centre;
        assign(b, 5600000, 5000000);
        const fw_wafer_site *at[2] = {NULL, NULL};
        for (int i = 0; i < b->grid.nsite; i++)
            if (b->grid.site[i].kind == FW_WAFER_ALIGNMENT) at[at[0] ? 1 : 0] = &b->grid.site[i];
        assert_int_equal(count(b, FW_WAFER_ALIGNMENT), 2);
        assert_int_equal(at[0]->row, at[1]->row);
        assert_int_equal(at[0]->x + at[1]->x, -b->grid.width); /* mirror images */
        int apart = at[1]->x - at[0]->x;
        for (int i = 0; i < b->grid.nsite; i++)
            for (int j = 0; j < i; j++)
                if (b->grid.site[i].row == b->grid.site[j].row)
                    assert_true(b->grid.site[i].x - b->grid.site[j].x <= apart);
        fw_arena_free(b->arena);
    }
}

static void test_tests(void **state) {
    (void)state;
    for (int n = 1; n <= 9; n++) {
        bench *b = begin();
        b->asked.tests = n;
        b->asked.centre = FW_CENTRE_DIE;
        assign(b, 5600000, 5000000);
        assert_int_equal(count(b, FW_WAFER_TEST), n);
        double mean_x = 0, mean_y = 0;
        bool centre = false;
        for (int i = 0; i < b->grid.nsite; i++) {
            const fw_wafer_site *s = &b->grid.site[i];
            if (s->kind != FW_WAFER_TEST) continue;
            assert_int_equal(s->variant, -1);
            mean_x += s->x + 0.5 * b->grid.width;
            mean_y += s->y + 0.5 * b->grid.height;
            centre = centre || s->x == -b->grid.width / 2;
        }
        assert_true(centre);
        if (n == 1 || n == 5 || n == 9) /* balanced about the centre, to half a die */
            assert_true(fabs(mean_x) < n * 2.8e6 && fabs(mean_y) < n * 2.5e6);
        fw_arena_free(b->arena);
    }
}

/* few dies: what cannot be given is said */
static void test_too_few(void **state) {
    (void)state;
    bench *b = begin();
    b->asked.alignment = true;
    b->asked.tests = 9;
    assign(b, 55000000, 50000000);
    assert_int_equal(count(b, FW_WAFER_DIE), 1);
    assert_int_equal(b->diags.count, 2);
    assert_int_equal(b->diags.item[0].number, 192);
    fw_arena_free(b->arena);
}

/* in turn: in every column and in every row neighbours differ by one step, so each run of n dies
   has every step once */
static void test_round_robin(void **state) {
    (void)state;
    bench *b = begin();
    enum { N = 7 };
    sweep(b, 0, N);
    assign(b, 3000000, 3000000);
    int dies[N] = {0};
    for (int i = 0; i < b->grid.nsite; i++) {
        const fw_wafer_site *s = &b->grid.site[i];
        assert_in_range(s->variant, 0, N - 1);
        assert_int_equal(s->variant, (s->row + s->column) % N);
        dies[s->variant]++;
    }
    for (int v = 0; v < N; v++) /* as many of each as can be, to one per row */
        assert_true(abs(dies[v] - b->grid.nsite / N) <= b->grid.rows);
    fw_arena_free(b->arena);
}

/* side by side: steps never fall from left to right and blocks are equally wide, to one column */
static void test_blocks(void **state) {
    (void)state;
    bench *b = begin();
    sweep(b, 0, 5);
    sweep(b, 1, 3);
    b->asked.blocks = true;
    assign(b, 3000000, 3000000);
    int first[64] = {0}, wide[5] = {0}, high[3] = {0};
    bool column[64] = {false}, row[64] = {false};
    for (int i = 0; i < b->grid.nsite; i++) {
        const fw_wafer_site *s = &b->grid.site[i];
        int s0 = s->variant % 5, s1 = s->variant / 5;
        first[s->column] = s0;
        wide[s0] += !column[s->column];
        high[s1] += !row[s->row];
        column[s->column] = row[s->row] = true;
        if (i > 0 && s->row == s[-1].row) assert_true(s->variant >= s[-1].variant);
        if (i > 0) assert_true(s1 >= s[-1].variant / 5);
    }
    for (int c = 1; c < b->grid.columns; c++)
        assert_true(first[c] >= first[c - 1]);
    for (int k = 0; k < 5; k++)
        assert_true(abs(wide[k] - b->grid.columns / 5) <= 1);
    for (int k = 0; k < 3; k++)
        assert_true(abs(high[k] - b->grid.rows / 3) <= 1);
    fw_arena_free(b->arena);
}

/* the number that the process works with is that of the places */
static void test_dies(void **state) {
    (void)state;
    bench *b = begin();
    b->asked.alignment = true;
    b->asked.tests = 5;
    assign(b, 5600000, 5000000);
    fw_geometry_box die = {1e-3, -2e-3, 6.6e-3, 3e-3};
    int dies;
    assert_int_equal(fw_wafer_dies(b->arena, &b->asked, die, &dies), FW_OK);
    assert_int_equal(dies, count(b, FW_WAFER_DIE));
    assert_int_equal(count(b, FW_WAFER_DIE), b->grid.nsite - 7);
    b->asked.diameter_m = 0.09;
    assert_int_equal(fw_wafer_dies(b->arena, &b->asked, die, &dies), FW_OK);
    assert_int_equal(dies, 0);
    fw_arena_free(b->arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_alignment), cmocka_unit_test(test_tests),
        cmocka_unit_test(test_too_few),   cmocka_unit_test(test_round_robin),
        cmocka_unit_test(test_blocks),    cmocka_unit_test(test_dies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
