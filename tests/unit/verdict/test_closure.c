/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/verdict_parts.h"
#include "test.h"

static const double none = (double)NAN;

typedef struct bench {
    fw_mechanism_mass body[2];
    fw_device_revolute revolute[1];
    fw_mechanism_pin pin[1];
    fw_device_joint joint[3];
    fw_device_driver driver[1];
    fw_device device;
    fw_mechanism m;
} bench;

/* a weld, a rod and a slide between two bodies, all of them closed */
static void bench_new(bench *b) {
    memset(b, 0, sizeof *b);
    b->body[0] = (fw_mechanism_mass){"a", 1e-6, 1e-12, 1e-3, 0, 0.5, {0, 0}};
    b->body[1] = (fw_mechanism_mass){"b", 1e-6, 1e-12, 4e-3, 1e-3, 0.2, {0, 0}};
    double c = cos(0.5), s = sin(0.5), x = 3e-3, y = 1e-3;
    double lx = c * x + s * y, ly = -s * x + c * y; /* centre of b in the frame of a */
    b->joint[0] = (fw_device_joint){.id = "weld",
                                    .kind = FW_JOINT_WELD,
                                    .body_a = 0,
                                    .body_b = 1,
                                    .ax_m = lx,
                                    .ay_m = ly,
                                    .angle_rad = -0.3};
    b->joint[1] = (fw_device_joint){
        .id = "rod", .kind = FW_JOINT_DISTANCE, .body_a = 0, .body_b = 1, .length_m = hypot(x, y)};
    b->joint[2] = (fw_device_joint){.id = "slide",
                                    .kind = FW_JOINT_PRISMATIC,
                                    .body_a = 0,
                                    .body_b = 1,
                                    .axis_rad = atan2(ly, lx),
                                    .angle_rad = -0.3};
    b->pin[0] = (fw_mechanism_pin){.id = "pin",
                                   .body_a = 0,
                                   .body_b = 1,
                                   .ax_m = lx,
                                   .ay_m = ly,
                                   .stop_min_rad = none,
                                   .stop_max_rad = none};
    b->driver[0] = (fw_device_driver){.id = "pull", .revolute = FW_NONE, .joint = 1};
    for (int i = 0; i < 3; i++)
        b->joint[i].place = (fw_place){"d.xml", 10 + i, 1};
    b->revolute[0].place = (fw_place){"d.xml", 9, 1};
    b->device = (fw_device){.revolute = b->revolute, .nrevolute = 1};
    b->m = (fw_mechanism){.body = b->body,
                          .pin = b->pin,
                          .joint = b->joint,
                          .driver = b->driver,
                          .nbody = 2,
                          .npin = 1,
                          .njoint = 3};
}

static void every_joint_must_close(void **state) {
    (void)state;
    for (int i = 0; i < 9; i++) {
        static const int line[] = {0, 9, 10, 10, 11, 0, 12, 12, 0};
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        bench b;
        bench_new(&b);
        switch (i) {
        case 1:
            b.pin[0].bx_m = 1e-6;
            break;
        case 2:
            b.joint[0].bx_m = 1e-6;
            break;
        case 3:
            b.joint[0].angle_rad = -0.29;
            break;
        case 4:
            b.joint[1].length_m += 1e-6;
            break;
        case 5: /* a driven rod has the driver's length */
            b.joint[1].length_m += 1e-6;
            b.m.ndriver = 1;
            break;
        case 6:
            b.joint[2].by_m = 1e-6;
            break;
        case 7:
            b.joint[2].angle_rad = 0;
            break;
        case 8: /* along the axis it may be anywhere; 1 nm is nothing */
            b.joint[2].ax_m = 0.7 * cos(b.joint[2].axis_rad) * 1e-3;
            b.joint[2].ay_m = 0.7 * sin(b.joint[2].axis_rad) * 1e-3;
            b.joint[0].bx_m = 1e-9;
            break;
        default:
            break;
        }
        fw_status status = fw_verdict_check_closure(&b.device, &b.m, &diags);
        assert_int_equal(status, line[i] ? FW_INPUT : FW_OK);
        assert_int_equal(diags.count, line[i] > 0);
        if (line[i]) {
            assert_int_equal(diags.item[0].number, 206);
            assert_int_equal(diags.item[0].place.line, line[i]);
        }
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_joint_must_close)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
