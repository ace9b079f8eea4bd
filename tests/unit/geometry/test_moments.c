/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"

/* places are exact in binary, so that only the routine's own error is seen far from the origin */
static const double far[] = {0, 0x1p-10, -0x1p-7};

static void disc(void **state) {
    for (int i = 0; i < 3; i++) {
        fw_geometry_contour c;
        double r = 0x1p-14;
        assert_int_equal(
            fw_geometry_contour_disc(*state, (fw_geometry_vec2){far[i], -far[i]}, r, &c), FW_OK);
        fw_geometry_region region = region_of(&c);
        fw_geometry_moments m = fw_geometry_region_moments(&region);
        assert_relative(m.area_m2, FW_PI * r * r, 1e-12);
        assert_near(m.centroid.x, far[i], 1e-12 * r);
        assert_near(m.centroid.y, -far[i], 1e-12 * r);
        assert_relative(m.polar_m4, FW_PI * r * r * r * r / 2, 1e-12);
    }
}

static void rectangle(void **state) {
    for (int i = 0; i < 3; i++) {
        fw_geometry_contour c;
        double a = 0x1p-12, b = 0x1p-16, x = far[i];
        assert_int_equal(
            fw_geometry_contour_rectangle(*state, (fw_geometry_box){x, x, x + a, x + b}, &c),
            FW_OK);
        fw_geometry_region region = region_of(&c);
        fw_geometry_moments m = fw_geometry_region_moments(&region);
        assert_relative(m.area_m2, a * b, 1e-12);
        assert_near(m.centroid.x, x + a / 2, 1e-12 * a);
        assert_near(m.centroid.y, x + b / 2, 1e-12 * a);
        assert_relative(m.polar_m4, a * b * (a * a + b * b) / 12, 1e-12);
        assert_relative(m.spread_m4.x, a * b * (a * a - b * b) / 12, 1e-12);
        assert_near(m.spread_m4.y, 0, 1e-12 * m.polar_m4);
    }
}

/* ring sector of angle w: area w (R^2 - r^2)/2, centroid at (4/3) sin(w/2)/w (R^3 - r^3)/(R^2 -
   r^2) on the bisector, polar about the centre w (R^4 - r^4)/4, spread there sin w (R^4 - r^4)/4 along twice its
   angle */
static void ring_sector(void **state) {
    for (int i = 0; i < 300; i++) {
        double w = i < 100 ? pow(10, uniform(-3, 0)) : uniform(0.5, 6.2);
        double inner = pow(10, uniform(-5, -4)), outer = inner * uniform(1.5, 3);
        double start = uniform(-4, 4), x = far[i % 3] * 0.125;
        fw_geometry_contour c;
        fw_geometry_vec2 centre = {x, x};
        assert_int_equal(
            fw_geometry_contour_ring_sector(*state, centre, inner, outer, start, w, &c), FW_OK);
        fw_geometry_region region = region_of(&c);
        fw_geometry_moments m = fw_geometry_region_moments(&region);
        /* end points are rounded to the spacing of doubles there: that is the error allowed */
        double tolerance =
            1e-12 + 40 * 0x1p-53 * (fabs(x) + outer) / fmin(w * inner, outer - inner);
        double area = w * (outer * outer - inner * inner) / 2;
        assert_relative(m.area_m2, area, tolerance);
        double q = 4.0 / 3 * sin(w / 2) / w * (pow(outer, 3) - pow(inner, 3)) /
                   (outer * outer - inner * inner);
        assert_near(m.centroid.x, x + q * cos(start + w / 2), tolerance * outer);
        assert_near(m.centroid.y, x + q * sin(start + w / 2), tolerance * outer);
        double about_centre = w * (pow(outer, 4) - pow(inner, 4)) / 4;
        double polar = about_centre - area * q * q;
        /* the reference itself loses digits in the subtraction for narrow sectors */
        assert_relative(m.polar_m4, polar, tolerance + 20 * 0x1p-53 * about_centre / polar);
        double spread = sin(w) / w * about_centre - area * q * q, twice = 2 * start + w;
        double off = (tolerance + 1e-12) * about_centre;
        assert_near(m.spread_m4.x, spread * cos(twice), off);
        assert_near(m.spread_m4.y, spread * sin(twice), off);
    }
}

static void hole_is_subtracted(void **state) {
    fw_geometry_contour part[2], disc_ccw;
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, 4e-5, &part[0]),
                     FW_OK);
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){2e-5, 0}, 1e-5, &disc_ccw),
                     FW_OK);
    assert_int_equal(fw_geometry_contour_reverse(*state, &disc_ccw, &part[1]), FW_OK);
    fw_geometry_moments m = fw_geometry_region_moments(&(fw_geometry_region){part, 2});
    assert_relative(m.area_m2, FW_PI * 15e-10, 1e-13);
    assert_near(m.centroid.x, -2e-5 / 15, 1e-18);
    double about = FW_PI / 2 * (256e-20 - 1e-20) - FW_PI * 1e-10 * 4e-10;
    assert_relative(m.polar_m4, about - FW_PI * 15e-10 * 4e-10 / 225, 1e-12);
}

/* the same figure flattened ever finer comes to the same integrals */
static void invariant_under_motion(void **state) {
    for (int i = 0; i < 300; i++) {
        fw_geometry_contour c = random_shape(*state, 1e-4, 0), t;
        fw_geometry_pose pose = {uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3), uniform(-4, 4)};
        assert_int_equal(fw_geometry_contour_transform(*state, &c, pose, i % 2, &t), FW_OK);
        fw_geometry_region p = region_of(&c), q = region_of(&t);
        fw_geometry_moments m = fw_geometry_region_moments(&p), n = fw_geometry_region_moments(&q);
        fw_geometry_vec2 g = {m.centroid.x, i % 2 ? -m.centroid.y : m.centroid.y};
        g = fw_geometry_vec_rotate(g, pose.angle_rad);
        assert_near(n.centroid.x, g.x + pose.x_m, 1e-16);
        assert_near(n.centroid.y, g.y + pose.y_m, 1e-16);
        assert_relative(n.polar_m4, m.polar_m4, 1e-10);
        fw_geometry_vec2 s = {m.spread_m4.x, i % 2 ? -m.spread_m4.y : m.spread_m4.y};
        s = fw_geometry_vec_rotate(s, 2 * pose.angle_rad);
        assert_near(n.spread_m4.x, s.x, 1e-10 * m.polar_m4);
        assert_near(n.spread_m4.y, s.y, 1e-10 * m.polar_m4);
    }
}

static void box_is_tight(void **state) {
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_contour_ring_sector(*state, (fw_geometry_vec2){0, 0}, 1e-5, 3e-5,
                                                     -0.1, FW_PI + 0.2, &c),
                     FW_OK);
    fw_geometry_box box = fw_geometry_contour_box(&c);
    assert_near(box.x0, -3e-5, 1e-19);
    assert_near(box.x1, 3e-5, 1e-19);
    assert_near(box.y1, 3e-5, 1e-19);
    assert_near(box.y0, -3e-5 * sin(0.1), 1e-19);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(disc),
        geo_test(rectangle),
        geo_test(ring_sector),
        geo_test(hole_is_subtracted),
        geo_test(invariant_under_motion),
        geo_test(box_is_tight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
