/* SPDX-License-Identifier: GPL-3.0-or-later */
/* External programs: private, limited, cleaned up; and reading what the solver writes. */
#include "base/arena.h"
#include "continuum/solver.h"
#include "test.h"
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static fw_continuum_external_run call(const fw_continuum_external_room *room, const char *program,
                                      const char *word, double timeout_s) {
    const char *argv[] = {program, word, NULL};
    fw_continuum_external_run run;
    assert_int_equal(fw_continuum_external_call(room, argv, "log", timeout_s, &run), FW_OK);
    return run;
}

static void ends(void **state) {
    (void)state;
    fw_arena *work = fw_arena_new(0);
    fw_continuum_external_room room;
    assert_int_equal(fw_continuum_external_room_open(work, &room), FW_OK);
    struct stat info;
    assert_int_equal(stat(room.path, &info), 0);
    assert_int_equal(info.st_mode & 0777, 0700);
    fw_continuum_external_run run = call(&room, "/bin/true", NULL, 10);
    assert_int_equal(run.end, FW_EXTERNAL_DONE);
    run = call(&room, "/bin/false", NULL, 10);
    assert_int_equal(run.end, FW_EXTERNAL_FAILED);
    assert_int_equal(run.code, 1);
    run = call(&room, "/nonexistent/program", NULL, 10);
    assert_int_equal(run.end, FW_EXTERNAL_FAILED);
    assert_int_equal(run.code, 127);
    run = call(&room, "/bin/sleep", "1000", 0.01);
    assert_int_equal(run.end, FW_EXTERNAL_TIMEOUT);
    fw_cancel cancel = {0};
    fw_arena_stop_with(work, &cancel);
    fw_cancel_request(&cancel, 2);
    run = call(&room, "/bin/sleep", "1000", 1000);
    fw_cancel_clear(&cancel);
    assert_int_equal(run.end, FW_EXTERNAL_CANCELLED);
    char path[sizeof room.path];
    memcpy(path, room.path, sizeof path);
    fw_continuum_external_room_close(&room);
    assert_int_not_equal(access(path, F_OK), 0);
    fw_continuum_external_room_close(&room); /* twice does no harm */
    fw_arena_free(work);
}

/* the environment is ours, the directory too */
static void surroundings(void **state) {
    (void)state;
    fw_arena *work = fw_arena_new(0);
    fw_continuum_external_room room;
    assert_int_equal(fw_continuum_external_room_open(work, &room), FW_OK);
    setenv("SOME_SECRET", "value", 1);
    assert_int_equal(call(&room, "/usr/bin/env", NULL, 10).end, FW_EXTERNAL_DONE);
    char file[700], text[2000] = {0};
    snprintf(file, sizeof file, "%s/log", room.path);
    FILE *log = fopen(file, "r");
    assert_non_null(log);
    size_t n = fread(text, 1, sizeof text - 1, log);
    fclose(log);
    assert_true(n > 0);
    assert_non_null(strstr(text, "OMP_NUM_THREADS=1\n"));
    assert_null(strstr(text, "SOME_SECRET"));
    assert_int_equal(fw_continuum_external_write(&room, "a", "b", 1), FW_OK);
    assert_int_equal(fw_continuum_external_write(&room, "a", "b", 1),
                     FW_IO); /* nothing is written over */
    fw_continuum_external_room_close(&room);
    fw_arena_free(work);
}

static void program_is_found(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *path = getenv("PATH");
    char *kept = fw_arena_strdup(arena, path ? path : "");
    setenv("PATH", ":.:/nonexistent:/bin", 1);
    const char *found;
    assert_int_equal(fw_continuum_program(arena, "sh", &found), FW_OK);
    assert_string_equal(found, "/bin/sh");
    assert_int_equal(fw_continuum_program(arena, "no-such-program", &found), FW_OK);
    assert_null(found);
    setenv("PATH", kept, 1);
    fw_arena_free(arena);
}

/* diag(p) turned by two angles */
static void principal_values(void **state) {
    (void)state;
    unsigned seed = 1;
    for (int n = 0; n < 1000; n++) {
        double random[5], p[3];
        for (int i = 0; i < 5; i++)
            random[i] = (double)(seed = seed * 1664525u + 1013904223u) / 4294967296.0 - 0.5;
        for (int i = 0; i < 3; i++)
            p[i] = random[i];
        if (n % 3 == 0) p[1] = p[0]; /* a double value */
        double c = cos(6 * random[3]), s = sin(6 * random[3]), e = cos(6 * random[4]),
               f = sin(6 * random[4]);
        double R[3][3] = {{c, -s * e, s * f}, {s, c * e, -c * f}, {0, f, e}}, A[3][3] = {{0}};
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                for (int k = 0; k < 3; k++)
                    A[i][j] += R[i][k] * p[k] * R[j][k];
        double value[3],
            sorted[3] = {fmin(p[0], fmin(p[1], p[2])), 0, fmax(p[0], fmax(p[1], p[2]))};
        sorted[1] = p[0] + p[1] + p[2] - sorted[0] - sorted[2];
        fw_continuum_results_principal(
            (double[6]){A[0][0], A[1][1], A[2][2], A[0][1], A[1][2], A[2][0]}, value);
        for (int i = 0; i < 3; i++)
            assert_near(value[i], sorted[i], 2e-8); /* double values: square root of round-off */
        if (n % 3 != 0) assert_near(value[2], sorted[2], 1e-13);
    }
    double zero[3];
    fw_continuum_results_principal((double[6]){0}, zero);
    assert_near(zero[2], 0, 0);
}

static const char printed[] = "\n displacements (vx,vy,vz) for set NREF and time  0.5000000E+00\n\n"
                              "         7  9.000000E+00  9.000000E+00  9.000000E+00\n"
                              "\n displacements (vx,vy,vz) for set NREF and time  0.1000000E+01\n\n"
                              "         7  1.500000E-03 -2.000000E+00  0.000000E+00\n"
                              "         8  0.000000E+00  0.000000E+00  2.5000000-101\n"
                              "\n forces (fx,fy,fz) for set NREF and time  0.1000000E+01\n\n"
                              "         8  1.000000E+00  2.000000E+00  3.000000E+00\n";

static void print_file(void **state) {
    (void)state;
    const int node[2] = {7, 8};
    fw_continuum_result_step step[2] = {{.have_move = {false}}};
    assert_int_equal(fw_continuum_results_print(printed, node, 2, step, 2), FW_OK);
    assert_near(step[0].move[0][0], 1.5e-3, 0);
    assert_near(step[0].move[0][1], -2, 0);
    assert_near(step[0].move[1][2], 0, 0); /* an exponent of three digits */
    assert_near(step[0].force[1][2], 3, 0);
    assert_true(step[0].have_move[0] && step[0].have_move[1] && step[0].have_force[1]);
    assert_false(step[0].have_force[0] || step[1].have_move[0]);
    assert_int_equal(
        fw_continuum_results_print(" displacements (vx) time  0.1000000E+01\n 7 nonsense 1 2\n",
                                   node, 2, step, 2),
        FW_SOLVER);
    assert_int_equal(fw_continuum_results_print(" forces and time  NaN\n", node, 2, step, 2),
                     FW_SOLVER);
}

static const char fields[] =
    "  100CL  103 3.000000000        3317                     0    3           1\n"
    " -4  STRESS      6    1\n -5  SXX         1    4    1    1\n"
    " -1       356 1.00000E+02-5.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00\n"
    " -3\n"
    "  100CL  103 3.000000000        3317                     0    3           1\n"
    " -4  TOSTRAIN    6    1\n"
    " -1       356 1.00000E-03 0.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00\n"
    " -1       357 0.00000E+00-2.00000E-03 0.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00\n"
    " -3\n";

static void field_file(void **state) {
    (void)state;
    fw_continuum_result_peak strain[3], stress[3];
    int found_steps;
    assert_int_equal(fw_continuum_results_fields(fields, strain, stress, 3, &found_steps), FW_OK);
    assert_int_equal(found_steps, 3);
    assert_near(strain[2].principal, 2e-3, 1e-15);
    assert_int_equal(strain[2].node, 357);
    assert_near(stress[2].principal, 100, 1e-12);
    assert_near(stress[2].mises, sqrt(0.5 * (105.0 * 105 + 25 + 100 * 100)), 1e-10);
    assert_int_equal(
        fw_continuum_results_fields("  100CL  103 3.000000000        3317\n -4  STRESS      6\n"
                                    " -1       356 1.00000E+02\n",
                                    strain, stress, 3, &found_steps),
        FW_SOLVER);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends),       cmocka_unit_test(surroundings),
        cmocka_unit_test(program_is_found),      cmocka_unit_test(principal_values),
        cmocka_unit_test(print_file), cmocka_unit_test(field_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
