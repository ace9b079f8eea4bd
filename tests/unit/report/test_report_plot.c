/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"
#include "report/report_page.h"
#include "report/fixture.h"

static uint64_t seed = 88172645463325252u;
static double uniform(void) {
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static void decimation_keeps_ends_and_extremes(void **state) {
    (void)state;
    enum { LONGEST = 5000, MOST = 400 };
    static double y[2 * LONGEST];
    int index[MOST];
    for (int trial = 0; trial < 200; trial++) {
        int n = 1 + (int)(uniform() * LONGEST), most = 4 + (int)(uniform() * (MOST - 4));
        int low = 0, high = 0;
        for (int i = 0; i < n; i++) {
            y[2 * i] = uniform() - 0.5;
            low = y[2 * i] < y[2 * low] ? i : low;
            high = y[2 * i] > y[2 * high] ? i : high;
        }
        int got = fw_report_decimate(y, 2, n, most, index);
        assert_true(got >= 1 && got <= most);
        assert_int_equal(index[0], 0);
        assert_int_equal(index[got - 1], n - 1);
        int found = 0;
        for (int k = 0; k < got; k++) {
            if (k) assert_true(index[k] > index[k - 1]);
            found += (index[k] == low) + (index[k] == high && high != low);
        }
        assert_int_equal(found, n == 1 ? 1 : 2);
    }
}

static void nice_steps(void **state) {
    (void)state;
    for (int trial = 0; trial < 1000; trial++) {
        double x = pow(10.0, 12.0 * uniform() - 6.0), s = fw_svg_nice(x);
        assert_true(s >= x * (1.0 - 1e-9) && s < 2.51 * x);
        double digit = s / pow(10.0, floor(log10(s) + 1e-9));
        assert_true(fabs(digit - 1.0) < 1e-9 || fabs(digit - 2.0) < 1e-9 ||
                    fabs(digit - 5.0) < 1e-9);
    }
    assert_true(fw_svg_nice((double)NAN) == 1.0);
    assert_true(fw_svg_nice(0.0) == 1.0);
}

/* the flexure meets both bodies: ends move as points of the body on that side */
static void bent_flexure_meets_both_bodies(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    const fw_dynamics_motion *m = f->variant_verdict[0].motion[0];
    fw_report_bends bends;
    assert_int_equal(fw_report_bends_make(arena, &f->device, &f->layout, &bends), FW_OK);
    assert_int_equal(bends.count, SIX);
    for (int i = 0; i < bends.count; i++) {
        const fw_report_bend *b = &bends.item[i];
        int ends = 0;
        for (int k = 0; k < b->npoint; k++) {
            double w = b->point[k].weight;
            assert_true(w >= 0.0 && w <= 1.0);
            if (w > 1e-9 && w < 1.0 - 1e-9) continue;
            ends++;
            for (int t = 0; t < SAMPLES; t += 50) {
                fw_geometry_vec2 p = fw_report_bent(&f->mechanism[0], m, b, m->t_s[t], b->point[k]);
                fw_geometry_vec2 q =
                    fw_report_moved(&f->mechanism[0], m, w < 0.5 ? b->lower : b->upper, m->t_s[t],
                                    (fw_geometry_vec2){b->point[k].x_m, b->point[k].y_m});
                assert_near(p.x, q.x, 1e-12);
                assert_near(p.y, q.y, 1e-12);
            }
        }
        assert_true(ends >= 4);
    }
    fw_arena_free(arena);
}

static void pose_is_the_sample_at_a_sample(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    const fw_dynamics_motion *m = f->variant_verdict[0].motion[0];
    double pose[3];
    for (int i = 0; i < SAMPLES; i += 7)
        for (int b = 0; b < FIVE; b++) {
            fw_report_pose_at(m, b, m->t_s[i], pose);
            for (int k = 0; k < 3; k++)
                assert_near(pose[k], m->q[(i * FIVE + b) * 3 + k], 1e-15);
        }
    fw_report_pose_at(m, FW_GROUND, 1e-3, pose);
    assert_true(pose[0] == 0.0 && pose[1] == 0.0 && pose[2] == 0.0);
    fw_report_pose_at(m, 0, 1.0, pose); /* beyond the end: the last sample */
    assert_true(pose[0] == m->q[(SAMPLES - 1) * FIVE * 3]);
    fw_arena_free(arena);
}

static void picture_keeps_points_where_they_are(void **state) {
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        fw_geometry_box box = {uniform(), uniform(), 0.0, 0.0};
        box.x1 = box.x0 + 1e-6 + uniform();
        box.y1 = box.y0 + 1e-6 + uniform();
        fw_report_view v = fw_report_view_fit(box, 640.0, 0.1 * (box.x1 - box.x0));
        assert_true(v.height <= 801.0 && v.height > 0.0);
        assert_true(fw_report_x(&v, box.x0) >= -1e-6 && fw_report_x(&v, box.x1) <= 640.0 + 1e-6);
        assert_true(fw_report_y(&v, box.y1) >= -1e-6 && fw_report_y(&v, box.y0) <= v.height + 1e-6);
    }
    /* round-off of another library makes no other picture: a square that is a hair too high is as high as it is wide */
    fw_geometry_box square = {0.0, 0.0, 1e-3, 1e-3 * (1 + 1e-13)};
    assert_near(fw_report_view_fit(square, 360.0, 0.0).height, 360.0, 0.0);
    square.y1 = 1.001e-3;
    assert_near(fw_report_view_fit(square, 360.0, 0.0).height, 361.0, 0.0);
    fw_report_view none = fw_report_view_fit(fw_report_box_empty(), 640.0, 0.0);
    assert_true(isfinite(none.scale) && none.scale > 0.0);
}

/* Where a motion has no peak of a hinge, its panel is as high as what the samples reach to either side, which is what it is where the
   peak is the largest of them: the curve is drawn as it was. */
static void a_plot_without_a_peak_is_as_high_as_its_samples(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture *f = fixture_new(arena, 0.12);
    fw_dynamics_motion motion = *f->variant_verdict[0].motion[0];
    fw_dynamics_peak peak[SIX];
    const fw_report_figure figure = {3, 40, true, "plot"};
    const char *at[2];
    memcpy(peak, motion.peak, sizeof peak);
    motion.peak = peak;
    for (int k = 0; k < SIX; k++)
        f->mechanism[0].hinge[k].closed_form.limit_angle_rad =
            12; /* far away: none of them is drawn */
    for (int without = 0; without < 2; without++) {
        fw_text text = fw_text_new(arena);
        for (int k = 0; without && k < SIX; k++)
            peak[k].angle_rad = (double)NAN;
        assert_int_equal(fw_report_panels(arena, &f->mechanism[0], &motion, &figure, &text), FW_OK);
        at[without] = text.data;
    }
    for (int k = 0; k < SIX; k++) {
        for (int i = 0; i < 2; i++)
            assert_non_null(at[i] = strstr(at[i] + 1, "#0072B2"));
        const size_t n = strcspn(at[0], ">");
        assert_true(n > 200 && strncmp(at[0], at[1], n) == 0);
    }
    fw_arena_free(arena);
}

/* A film of many flexures has fewer key frames of their outlines: as many numbers as make 0.5 to 1e5 of them; one of few has all 120. */
static void a_film_of_many_flexures_has_fewer_frames(void **state) {
    (void)state;
    enum { TIMES = 5 };
    for (int many = 0; many < 2; many++) {
        fw_arena *arena = fw_arena_new(0);
        fixture *f = fixture_new(arena, 0.12);
        fw_layout layout = f->layout;
        fw_layout_piece *piece =
            fw_arena_array(arena, fw_layout_piece, (size_t)(TIMES * layout.npiece));
        int n = 0, frames = 0;
        size_t points = 0;
        for (int i = 0; i < layout.npiece; i++)
            for (int k = 0; k < (many && layout.piece[i].role == FW_ROLE_FLEXURE ? TIMES : 1); k++)
                piece[n++] = layout.piece[i];
        layout.piece = piece, layout.npiece = n;
        fw_report_bends bends;
        assert_int_equal(fw_report_bends_make(arena, &f->device, &layout, &bends), FW_OK);
        for (int i = 0; i < bends.count; i++)
            points += (size_t)bends.item[i].npoint;
        fw_text out = fw_text_new(arena);
        assert_int_equal(fw_report_animation_svg(arena, &f->device, &layout, &f->mechanism[0],
                                                 f->variant_verdict[0].motion[0],
                                                 &f->device.scene[0], &out),
                         FW_OK);
        for (const char *at = out.data; (at = strstr(at, ";M")) != NULL; at++)
            frames++;
        frames = frames / bends.count + 1;
        const double numbers = 2.0 * (double)points * frames;
        assert_int_equal(bends.count, many ? TIMES * SIX : SIX);
        assert_true(many ? frames > 16 && numbers > 5e4 && numbers <= 1e5 : frames == 120);
        fw_arena_free(arena);
    }
}

static void only_plain_colours_pass(void **state) {
    (void)state;
    assert_string_equal(fw_report_layer_colour("#12aBcD", 0), "#12aBcD");
    assert_string_equal(fw_report_layer_colour("#123", 0), "#123");
    const char *const bad[] = {"red", "#12345", "#12345g", "#123\"><script>", "url(x)", "", NULL};
    for (int i = 0; i < 7; i++)
        assert_string_equal(fw_report_layer_colour(bad[i], 1), "#E69F00");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_plain_colours_pass),
        cmocka_unit_test(decimation_keeps_ends_and_extremes),
        cmocka_unit_test(nice_steps),
        cmocka_unit_test(bent_flexure_meets_both_bodies),
        cmocka_unit_test(pose_is_the_sample_at_a_sample),
        cmocka_unit_test(a_plot_without_a_peak_is_as_high_as_its_samples),
        cmocka_unit_test(a_film_of_many_flexures_has_fewer_frames),
        cmocka_unit_test(picture_keeps_points_where_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
