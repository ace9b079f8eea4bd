/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that a description draws: areas against closed forms, holes and their caps, mirror images,
   what stands on such bodies, and hinges that find them. */
#include "geometry/segment.h"
#include "layout/layout.h"
#include "test.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define UM 1e-6

typedef struct drawn {
    fw_arena *arena;
    fw_diags diags;
    const fw_device *device;
    const fw_layout *layout;
} drawn;

static const char head[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" "
    "thickness=\"50 um\"/><flexure id=\"f\" kind=\"csfh\" radius=\"80 um\" angle=\"240 deg\" "
    "width=\"8 um\" gap=\"8 um\"/><flexure id=\"leaf\" kind=\"leaf\" length=\"400 um\" width=\"12 um\"/><mechanism>";
#define BODY(shapes)                                                                               \
    "<body id=\"jaw\" x=\"0 mm\" y=\"0 mm\">" shapes "</body><revolute id=\"A\" a=\"ground\" "     \
    "b=\"jaw\" hinge=\"f\"/>"
#define PLATE     "<plate x=\"700 um\" width=\"1000 um\" height=\"300 um\"/>"
#define NO_TETHER "<die tethers=\"no\"/>"

static drawn draw(const char *mechanism, const char *rest) {
    drawn d = {.arena = fw_arena_new(0)};
    static char xml[16384];
    snprintf(xml, sizeof xml, "%s%s</mechanism>%s</device>", head, mechanism, rest);
    d.diags = fw_diags_new(d.arena);
    fw_status status =
        fw_device_read(d.arena, "t.xml", xml, strlen(xml), NULL, 0, &d.diags, &d.device);
    if (status == FW_OK) status = fw_layout_build(d.arena, d.device, &d.diags, &d.layout);
    size_t holes = 0; /* release holes without room, and plates that begin in a hinge's round place, are no fault */
    for (size_t i = 0; i < d.diags.count; i++)
        holes += d.diags.item[i].number == 189 || d.diags.item[i].number == 537 || d.diags.item[i].number == 702;
    if (status != FW_OK || !d.layout->drawn || d.diags.count > holes)
        fail_msg("%s: %s", fw_status_text(status),
                 d.diags.count ? d.diags.item[0].message : "not drawn");
    return d;
}

static double area_of(const char *mechanism) {
    drawn d = draw(mechanism, NO_TETHER);
    double area = d.layout->body[0].area_m2;
    fw_arena_free(d.arena);
    return area / (UM * UM);
}

/* what is added or cut out changes the area by its own, to rounding */
static void areas_follow(void **state) {
    (void)state;
    double plain = area_of(BODY(PLATE));
    static const struct {
        const char *mechanism;
        double more; /* um2 */
    } with[] = {
        {BODY(PLATE "<disc x=\"700 um\" radius=\"40 um\" hole=\"yes\"/>"), -M_PI * 1600},
        {BODY(PLATE "<disc x=\"1200 um\" radius=\"60 um\"/>"), 0.5 * M_PI * 3600},
        {BODY(PLATE "<bar x=\"500 um\" y=\"100 um\" to-x=\"500 um\" to-y=\"250 um\" width=\"20 "
                    "um\" copies=\"6\" pitch-x=\"40 um\"/>"),
         6 * 20 * 100},
        {BODY(PLATE "<bar x=\"500 um\" y=\"100 um\" to-x=\"500 um\" to-y=\"250 um\" width=\"20 "
                    "um\" ends=\"round\" copies=\"6\" pitch-x=\"40 um\" symmetry=\"x\"/>"),
         12 * (20 * 100 + 0.5 * M_PI * 100)},
        {BODY(PLATE "<plate x=\"800 um\" width=\"100 um\" height=\"80 um\" corner=\"10 um\" "
                    "hole=\"yes\"/>"),
         -(100 * 80 - (4 - M_PI) * 100)},
        /* a notch of two lines and an arc in a frame of its own, turned and placed */
        {BODY(PLATE "<outline x=\"800 um\" y=\"20 um\" angle=\"30 deg\" hole=\"yes\"><line "
                    "to-x=\"100 um\" to-y=\"0 um\"/><line to-x=\"100 um\" to-y=\"50 um\"/><arc "
                    "to-x=\"0 um\" to-y=\"50 um\" radius=\"50 um\" turn=\"left\"/><line to-x=\"0 "
                    "um\" to-y=\"0 um\"/></outline>"),
         -(100 * 50 + 0.5 * M_PI * 2500)},
        /* L: 9 + 5 cells of 8 um, J of 6 + ... is counted by its font: I, two serifs and a stem */
        {BODY(PLATE "<lettering text=\"LI\" x=\"700 um\" height=\"72 um\"/>"),
         -(9 + 5 + 9 + 4) * 64},
        /* four inward corners of 90 degrees, rounded by 12 um */
        {"<body id=\"jaw\" x=\"0 mm\" y=\"0 mm\" inner-corner=\"12 um\">" PLATE
         "<plate x=\"800 um\" width=\"100 um\" height=\"500 um\"/></body><revolute id=\"A\" "
         "a=\"ground\" b=\"jaw\" hinge=\"f\"/>",
         100 * 200 + (4 - M_PI) * 144},
        /* a frame of four plates encloses a hole that nobody drew as one */
        {BODY(PLATE "<plate x=\"1300 um\" y=\"100 um\" width=\"200 um\" height=\"20 um\" "
                    "symmetry=\"x\"/><plate x=\"1390 um\" width=\"20 um\" height=\"220 um\"/>"),
         2 * 200 * 20 + 20 * 180},
    };
    for (size_t i = 0; i < sizeof with / sizeof with[0]; i++) {
        double more = area_of(with[i].mechanism) - plain;
        if (fabs(more - with[i].more) > 1e-7 * fabs(with[i].more))
            fail_msg("case %zu: %.9g um2 more, not %.9g", i, more, with[i].more);
    }
}

/* the pieces of a body */
static fw_geometry_region pieces(const drawn *d, int body) {
    fw_geometry_region r = {
        fw_arena_array(d->arena, fw_geometry_contour, (size_t)d->layout->npiece), 0};
    for (int i = 0; i < d->layout->npiece; i++)
        if (d->layout->piece[i].body == body && d->layout->piece[i].role == FW_ROLE_STRUCTURE)
            r.contour[r.count++] = d->layout->piece[i].contour;
    return r;
}

#define RICH                                                                                       \
    BODY(PLATE                                                                                     \
         "<disc x=\"600 um\" radius=\"40 um\" hole=\"yes\"/><disc x=\"900 um\" radius=\"25 "       \
         "um\" hole=\"yes\" copies=\"4\" pitch-x=\"70 um\"/><lettering text=\"FLEX 08\" "          \
         "x=\"680 um\" y=\"60 um\" height=\"63 um\"/><bar x=\"500 um\" y=\"-100 um\" "             \
         "to-x=\"500 um\" to-y=\"-250 um\" width=\"20 um\" copies=\"12\" pitch-x=\"40 um\"/>"      \
         "<lettering text=\"A B\" x=\"420 um\" y=\"-130 um\" height=\"90 um\" angle=\"90 deg\"/>")

static double about_origin(double area, fw_geometry_vec2 c, double polar) {
    return polar + area * (c.x * c.x + c.y * c.y);
}

/* moments are those of the pieces; these do not overlap, for their union has no less area; and a
   bias moves them alike */
static void pieces_are_the_body(void **state) {
    (void)state;
    drawn d = draw(RICH, NO_TETHER);
    fw_geometry_region all = pieces(&d, 0), sum = {all.contour, 1};
    const fw_layout_body_layout *b = &d.layout->body[0];
    assert_true(all.count > 12); /* five holes and nine letters, a cap each */
    fw_geometry_moments m = fw_geometry_region_moments(&all);
    /* less half of the flexure, which is that of the plain plate */
    drawn bare = draw(BODY(PLATE), NO_TETHER);
    fw_geometry_region only = pieces(&bare, 0);
    fw_geometry_moments own = fw_geometry_region_moments(&only);
    const fw_layout_body_layout *plate = &bare.layout->body[0];
    assert_relative(b->area_m2 - plate->area_m2, m.area_m2 - own.area_m2, 1e-10);
    assert_relative(b->area_m2 * b->centroid.x - plate->area_m2 * plate->centroid.x,
                    m.area_m2 * m.centroid.x - own.area_m2 * own.centroid.x, 1e-10);
    assert_near(b->area_m2 * b->centroid.y - plate->area_m2 * plate->centroid.y,
                m.area_m2 * m.centroid.y - own.area_m2 * own.centroid.y, 1e-10 * m.area_m2 * 1e-3);
    assert_relative(about_origin(b->area_m2, b->centroid, b->polar_m4) -
                        about_origin(plate->area_m2, plate->centroid, plate->polar_m4),
                    about_origin(m.area_m2, m.centroid, m.polar_m4) -
                        about_origin(own.area_m2, own.centroid, own.polar_m4),
                    1e-9);
    for (int i = 1; i < all.count; i++) {
        fw_geometry_region one = {&all.contour[i], 1}, both;
        if (fw_geometry_region_boolean(d.arena, &sum, &one, FW_UNION, &both) != FW_OK)
            fail_msg("piece %d near (%g, %g)", i, one.contour->segment[0].a.x,
                     one.contour->segment[0].a.y);
        sum = both;
    }
    assert_relative(fw_geometry_region_moments(&sum).area_m2, m.area_m2, 1e-9);
    assert_int_equal(sum.contour[0].count > 0 && fw_geometry_contour_area(&sum.contour[1]) < 0, 1);
    double edge = 0;
    for (int i = 0; i < sum.count; i++)
        edge += fw_geometry_contour_perimeter(&sum.contour[i]);
    double bare_edge = 0;
    for (int i = 0; i < only.count; i++)
        bare_edge += fw_geometry_contour_perimeter(&only.contour[i]);
    assert_relative(b->perimeter_m - plate->perimeter_m, edge - bare_edge, 1e-9);
    static const double bias[] = {1.1 * UM, -0.5 * UM};
    for (int k = 0; k < 2; k++) {
        double moved = 0;
        for (int i = 0; i < all.count; i++) {
            fw_geometry_contour c;
            int p = -1, q = -1;
            if (fw_geometry_contour_offset(d.arena, &all.contour[i], bias[k], &c, &p, &q) != FW_OK)
                fail_msg("piece %d of %d segments: %d and %d", i, all.contour[i].count, p, q);
            moved += fw_geometry_contour_area(&c);
        }
        /* the edge times the bias, and what corners add: no cut has opened or overlaps */
        assert_near(moved - m.area_m2, edge * bias[k], 400 * bias[k] * bias[k]);
    }
    fw_arena_free(bare.arena);
    fw_arena_free(d.arena);
}

/* a body drawn as its mirror image has its neck, its area and its centroid mirrored; one whose frame
   lies elsewhere is the same body */
static void mirrored_and_moved(void **state) {
    (void)state;
#define WEDGE                                                                                      \
    "<line to-x=\"900 um\" to-y=\"0 um\"/><arc to-x=\"1000 um\" to-y=\"100 um\" radius=\"100 "     \
    "um\" "                                                                                        \
    "turn=\"left\"/><line to-x=\"0 um\" to-y=\"240 um\"/><line to-x=\"0 um\" to-y=\"0 "            \
    "um\"/></outline>"
    static const char *const as[] = {
        BODY("<outline x=\"200 um\" y=\"-100 um\">" WEDGE),
        BODY("<outline x=\"-200 um\" y=\"-100 um\" mirror=\"y\">" WEDGE),
        "<body id=\"jaw\" x=\"0.3 mm\" y=\"-0.2 mm\" phi=\"90 deg\"><outline x=\"100 um\" y=\"100 "
        "um\" angle=\"-90 deg\">" WEDGE "</body><revolute id=\"A\" a=\"ground\" b=\"jaw\" "
        "b-x=\"0.2 mm\" b-y=\"0.3 mm\" hinge=\"f\"/>",
    };
    static const double sign[3][2] = {{1, 1}, {-1, 1}, {1, 1}};
    fw_layout_body_layout first = {0};
    for (int i = 0; i < 3; i++) {
        drawn d = draw(as[i], NO_TETHER);
        fw_layout_body_layout b = d.layout->body[0];
        if (i == 0) first = b;
        assert_relative(b.area_m2, first.area_m2, 1e-11);
        assert_near(b.centroid.x, sign[i][0] * first.centroid.x, 1e-12);
        assert_near(b.centroid.y, sign[i][1] * first.centroid.y, 1e-12);
        assert_relative(b.polar_m4, first.polar_m4, 1e-9);
        fw_arena_free(d.arena);
    }
}

/* eyelets, electrodes, release holes and tethers on a body with holes: all are drawn, and nothing
   overlaps */
static void what_stands_on_it(void **state) {
    (void)state;
    static const char rest[] =
        "<scene name=\"s\" duration=\"1 ms\"><tendon id=\"T\" pull=\"1 uN\"><eyelet on=\"jaw\" "
        "x=\"600 um\" y=\"60 um\"/><eyelet on=\"ground\" x=\"0.6 mm\" y=\"0.5 mm\"/></tendon>"
        "<comb-drive kind=\"comb\" id=\"C\" on=\"jaw\" against=\"ground\" x=\"1300 um\" y=\"0 um\" "
        "direction=\"0 deg\" fingers=\"10\" gap=\"8 um\" overlap=\"30 um\" voltage=\"10 V\"/>"
        "</scene><die release-pitch=\"70 um\"/>";
    drawn d = draw(BODY(PLATE "<disc x=\"800 um\" y=\"30 um\" radius=\"40 um\" hole=\"yes\"/><disc "
                              "x=\"600 um\" y=\"-60 um\" radius=\"30 um\" hole=\"yes\"/>"),
                   rest);
    fw_geometry_region all = pieces(&d, 0), sum = {all.contour, 1};
    assert_true(all.count > 30); /* release holes, each with a cap */
    for (int i = 1; i < all.count; i++) {
        fw_geometry_region one = {&all.contour[i], 1}, both;
        assert_int_equal(fw_geometry_region_boolean(d.arena, &sum, &one, FW_UNION, &both), FW_OK);
        sum = both;
    }
    double area = fw_geometry_region_moments(&all).area_m2;
    assert_relative(fw_geometry_region_moments(&sum).area_m2, area, 1e-9);
    fw_arena_free(d.arena);
}

/* bars between hinges and shapes together; and shapes alone between two hinges */
static void between_hinges(void **state) {
    (void)state;
#define TWO(body, shapes)                                                                          \
    "<body id=\"crank\" x=\"0 mm\" y=\"0.75 mm\" width=\"120 um\"/><body id=\"rod\" x=\"0.9 mm\" " \
    "y=\"1.5 mm\"" body ">" shapes "</body><body id=\"rocker\" x=\"1.8 mm\" y=\"0.75 mm\" "        \
    "width=\"120 um\"/><revolute id=\"A\" a=\"ground\" b=\"crank\" b-y=\"-0.75 mm\" "              \
    "hinge=\"f\"/><revolute id=\"B\" a=\"crank\" a-y=\"0.75 mm\" b=\"rod\" b-x=\"-0.9 mm\" "       \
    "hinge=\"f\"/><revolute id=\"C\" a=\"rod\" a-x=\"0.9 mm\" b=\"rocker\" b-y=\"0.75 mm\" "       \
    "hinge=\"f\"/><revolute id=\"D\" a=\"rocker\" a-y=\"-0.75 mm\" b=\"ground\" b-x=\"1.8 mm\" "   \
    "hinge=\"f\"/>"
    drawn plain = draw(TWO(" width=\"120 um\"", ""), NO_TETHER);
    drawn with = draw(TWO(" width=\"120 um\"", "<disc radius=\"150 um\"/>"), NO_TETHER);
    drawn alone = draw(TWO("", "<plate width=\"1200 um\" height=\"150 um\"/>"), NO_TETHER);
    double bar = 120 * UM, r = 150 * UM, half = asin(0.5 * bar / r);
    double disc = M_PI * r * r, inside = 2 * (half * r * r + 0.5 * bar * r * cos(half));
    /* the disc beyond the bar; its four corners with the bar are rounded */
    assert_near(with.layout->body[1].area_m2 - plain.layout->body[1].area_m2, disc - inside,
                4 * 100 * UM * UM);
    assert_true(alone.layout->body[1].area_m2 > 1200 * 150 * UM * UM);
    fw_arena_free(plain.arena);
    fw_arena_free(with.arena);
    fw_arena_free(alone.arena);
}

/* a plate that begins within its hinge's round place loses a segment of the circle, of which the head and the neck give
   some back: that is said once, and loudly where it is much */
static void what_hinges_take_is_said(void **state) {
    (void)state;
    double um2 = 0;
    drawn d = draw(BODY(PLATE), NO_TETHER);
    assert_int_equal(d.diags.count, 1);
    assert_int_equal(d.diags.item[0].number, 537);
    const char *said = strstr(d.diags.item[0].message, "um, and ");
    if (!said || sscanf(said, "um, and %lf um^2", &um2) != 1)
        fail_msg("%s", d.diags.item[0].message);
    const double r = d.layout->hinge[0].keep_out_m / UM, from = 200;
    const double segment = r * r * acos(from / r) - from * sqrt(r * r - from * from);
    assert_true(um2 < segment && um2 > 0.2 * segment);
    fw_arena_free(d.arena);
    /* half of a plate is gone, and a frequency of what is drawn is not that of the device: a warning, once for the body */
    d = draw(BODY("<plate x=\"150 um\" width=\"300 um\" height=\"300 um\"/>"), NO_TETHER);
    int warned = 0;
    double percent = 0;
    for (size_t i = 0; i < d.diags.count; i++)
        if (d.diags.item[i].number == 537 && d.diags.item[i].severity == FW_WARNING) {
            said = strstr(d.diags.item[i].message, ", and ");
            if (!said || sscanf(said, ", and %lf %%", &percent) != 1) fail_msg("%s", d.diags.item[i].message);
            assert_non_null(strstr(d.diags.item[i].message, "Most of it is at hinge "));
            warned++;
        }
    assert_int_equal(warned, 1);
    assert_true(percent > 20 && percent < 100);
    fw_arena_free(d.arena);
}

static size_t said_537(const char *mechanism, double *weighs) {
    drawn d = draw(mechanism, NO_TETHER);
    size_t n = 0;
    for (size_t i = 0; i < d.diags.count; i++)
        n += d.diags.item[i].number == 537;
    *weighs = d.layout->body[0].area_m2;
    fw_arena_free(d.arena);
    return n;
}

/* a link that is drawn to the middle of its hinge, as hinges ask for, is no mistake; one that goes on past it is, and one that
   stands in another's */
static void a_link_that_ends_in_its_hinge(void **state) {
    (void)state;
    double to, past, turned, short_of;
    assert_int_equal(said_537(BODY("<bar to-x=\"1280 um\" to-y=\"0 um\" width=\"120 um\"/>"), &to), 0);
    assert_int_equal(
        said_537(BODY("<bar to-x=\"900 um\" to-y=\"910 um\" width=\"120 um\"/>"), &turned), 0);
    assert_int_equal(said_537(BODY("<bar x=\"-60 um\" y=\"0 um\" to-x=\"1280 um\" to-y=\"0 um\" width=\"120 um\"/>"), &past),
                     2); /* the note, and the warning of its share */
    assert_true(said_537(BODY("<bar x=\"40 um\" y=\"0 um\" to-x=\"1280 um\" to-y=\"0 um\" width=\"120 um\"/>"), &short_of) > 0);
    assert_near(to, past, 1e-12); /* what is made of it is the same */
    const char *beside =
        "<body id=\"jaw\" x=\"0 um\" y=\"0 um\"><bar to-x=\"1280 um\" to-y=\"0 um\" width=\"120 um\"/><bar x=\"700 um\" y=\"0 um\" to-x=\"700 um\" "
        "to-y=\"-900 um\" width=\"120 um\"/></body><body id=\"other\" x=\"700 um\" y=\"-1400 um\">"
        "<bar to-x=\"0 um\" to-y=\"500 um\" width=\"120 um\"/></body><revolute id=\"A\" a=\"ground\" b=\"jaw\" "
        "hinge=\"f\"/><revolute id=\"B\" a=\"jaw\" a-x=\"700 um\" a-y=\"-900 um\" b=\"other\" "
        "b-y=\"500 um\" hinge=\"f\"/>";
    assert_int_equal(said_537(beside, &to), 0);
}

/* does a tether end at a cut of its body: end for end, and outside of what it holds? */
static bool ends_at_body(const fw_layout *l, const fw_layout_piece *t) {
    int cuts = 0, frame = 0;
    for (int i = 0; i < l->npiece; i++) {
        const fw_layout_piece *p = &l->piece[i];
        if (p == t || p->role == FW_ROLE_TETHER) continue;
        for (int j = 0; j < p->contour.count; j++)
            for (int k = 0; k < t->contour.count; k++) {
                const fw_geometry_segment *s = &p->contour.segment[j], *e = &t->contour.segment[k];
                if (!(s->flags & e->flags & FW_SEGMENT_JOINT)) continue;
                if (!vec_same(s->a, e->b) || !vec_same(s->b, e->a)) continue;
                cuts += p->body == 0;
                frame += p->role == FW_ROLE_FRAME;
            }
        if (p->body != 0) continue;
        for (int k = 0; k < t->contour.count; k++) { /* nothing of it is inside of the body */
            const fw_geometry_segment *e = &t->contour.segment[k];
            if (!(e->flags & FW_SEGMENT_JOINT) &&
                fw_geometry_contour_contains(&p->contour, fw_geometry_segment_point(e, 0.5)))
                return false;
        }
    }
    return cuts == 1 && frame == 1;
}

/* A finger begins 30 um below the edge that it holds: where the body was just as thick it began on the far
   edge, and ran through the body, 20 um wide and without a neck. At all widths about that, at places whose
   coordinates round either way, upright and lying. */
static void tethers_end_at_thin_bars(void **state) {
    (void)state;
    int n = 0;
    for (int lying = 0; lying < 2; lying++)
        for (int place = 0; place < 6; place++)
            for (int half_um = 40; half_um <= 120; half_um++) {
                char mechanism[1024], at[64];
                const double x_um = place * 17.3, to_um = 2600.0 - place * 31.7;
                snprintf(at, sizeof at, lying ? "phi=\"-90 deg\"" : "");
                snprintf(mechanism, sizeof mechanism,
                         "<body id=\"jaw\" x=\"0 mm\" y=\"0 mm\" %s><plate x=\"%g um\" y=\"500 um\" "
                         "width=\"400 um\" height=\"400 um\"/><bar x=\"%g um\" y=\"600 um\" to-x=\"%g um\" "
                         "to-y=\"%g um\" width=\"%g um\"/></body><revolute id=\"A\" a=\"ground\" b=\"jaw\" "
                         "b-x=\"%g um\" b-y=\"0 mm\" hinge=\"f\"/>",
                         at, x_um, x_um, x_um, to_um, 0.5 * half_um, x_um);
                drawn d = draw(mechanism, "<die clearance=\"1200 um\"/>");
                for (int i = 0; i < d.layout->npiece; i++) {
                    if (d.layout->piece[i].role != FW_ROLE_TETHER) continue;
                    if (!ends_at_body(d.layout, &d.layout->piece[i]))
                        fail_msg("%g um wide, place %d, lying %d: tether %d", 0.5 * half_um, place,
                                 lying, i);
                    n++;
                }
                assert_true(d.layout->ntether > 0);
                fw_arena_free(d.arena);
            }
    assert_true(n > 900);
}

static int said(const drawn *d, int number) {
    int n = 0;
    for (size_t i = 0; i < d->diags.count; i++)
        n += d->diags.item[i].number == number;
    return n;
}

/* two plates, a spring of fifteen bars between them, and a hinge below and above either; `first`: how the plate
   at the left is written */
static drawn twin(const char *attributes, const char *shape) {
    static char mechanism[8192];
    int n = snprintf(mechanism, sizeof mechanism,
                     "<body id=\"lo\" x=\"0 mm\" y=\"0 mm\"%s>%s<plate x=\"2900 um\" width=\"900 um\" "
                     "height=\"500 um\"/><bar x=\"490 um\" to-x=\"1000 um\" to-y=\"0 um\" width=\"14 um\"/>",
                     attributes, shape);
    int x = 1000, y = 0;
    for (int leg = 0; leg <= 8; leg++) {
        const int to = leg == 8 ? 0 : leg % 2 ? -350 : 350;
        n += snprintf(mechanism + n, sizeof mechanism - (size_t)n,
                      "<bar x=\"%d um\" y=\"%d um\" to-x=\"%d um\" to-y=\"%d um\" width=\"14 um\" "
                      "ends=\"round\"/><bar x=\"%d um\" y=\"%d um\" to-x=\"%d um\" to-y=\"%d um\" width=\"14 "
                      "um\" ends=\"round\"/>",
                      x, y, x, to, x, to, leg == 8 ? 2460 : x + 150, to);
        x += 150, y = to;
    }
    for (int i = 0; i < 4; i++)
        n += snprintf(mechanism + n, sizeof mechanism - (size_t)n,
                      "%s<revolute id=\"%c\" axis=\"0 deg\" a=\"ground\" a-x=\"%d um\" a-y=\"%d um\" b=\"lo\" "
                      "b-x=\"%d um\" b-y=\"%d um\" hinge=\"leaf\"/>",
                      i ? "" : "</body>", "ACEG"[i], i / 2 * 2900, i % 2 ? 600 : -600, i / 2 * 2900,
                      i % 2 ? 600 : -600);
    return draw(mechanism, NO_TETHER);
}

/* A body's own plate is one more of its shapes: hinges beside the second plate lead into that, and not across the
   spring to the first. Either way of writing the first plate gives the same body, but for its corners and for how wide a
   neck into it is. */
static void necks_find_the_nearest(void **state) {
    (void)state;
    drawn own = twin(" plate-width=\"1 mm\" plate-height=\"0.5 mm\"", "");
    drawn shape = twin("", "<plate width=\"1 mm\" height=\"0.5 mm\"/>");
    assert_int_equal(said(&own, 702) + said(&shape, 702), 0);
    assert_int_equal(pieces(&own, 0).count, 1); /* nothing is enclosed, so that nothing is cut open */
    assert_int_equal(pieces(&shape, 0).count, 1);
    assert_relative(own.layout->body[0].area_m2, shape.layout->body[0].area_m2, 5e-3);
    assert_near(own.layout->body[0].centroid.x, shape.layout->body[0].centroid.x, 5 * UM);
    fw_arena_free(own.arena);
    fw_arena_free(shape.arena);
}

/* what hangs on a plate of the body's own beside the way of its neck, and what its neck enters first, moves no neck:
   the body has its area more, and nothing else */
static void shapes_move_no_neck(void **state) {
    (void)state;
#define OWN(shapes)                                                                                 \
    "<body id=\"jaw\" x=\"0 mm\" y=\"0 mm\" plate-x=\"700 um\" plate-y=\"100 um\" plate-width=\"900 um\" " \
    "plate-height=\"300 um\">" shapes "</body><revolute id=\"A\" a=\"ground\" b=\"jaw\" hinge=\"f\"/>"
    static const struct {
        const char *mechanism;
        double more; /* um2 */
    } with[] = {
        {OWN("<bar x=\"1000 um\" y=\"200 um\" to-x=\"1000 um\" to-y=\"400 um\" width=\"20 um\"/>"), 20 * 150},
        {OWN("<disc x=\"1150 um\" y=\"100 um\" radius=\"60 um\"/>"), 0.5 * M_PI * 3600},
    };
    const double plain = area_of(OWN("<disc x=\"700 um\" y=\"100 um\" radius=\"60 um\"/>"));
    assert_relative(plain, area_of(OWN("")), 1e-9);
    for (size_t i = 0; i < sizeof with / sizeof with[0]; i++) {
        const double more = area_of(with[i].mechanism) - plain;
        /* where the shape meets the plate's edge two corners are rounded */
        if (fabs(more - with[i].more) > 2 * 100) fail_msg("case %zu: %.9g um2 more, not %.9g", i, more, with[i].more);
    }
#undef OWN
}

/* A thin bar before the plate is left alone where another way leads past it. Where all ways lead across it, that is said at
   its place, once for the hinge. */
static void necks_close_nothing(void **state) {
    (void)state;
    /* the hinge at the origin hangs below the plate; `wall` stands 290 um above it, and is joined to the plate on the left */
#define UNDER(wall)                                                                                 \
    "<body id=\"jaw\" x=\"0 mm\" y=\"0 mm\"><plate y=\"500 um\" width=\"1600 um\" height=\"200 um\"/>" wall     \
    "</body><revolute id=\"A\" axis=\"0 deg\" a=\"ground\" b=\"jaw\" hinge=\"f\"/>"
#define BAR(x, y, to_x, to_y)                                                                       \
    "<bar x=\"" #x " um\" y=\"" #y " um\" to-x=\"" #to_x " um\" to-y=\"" #to_y " um\" width=\"14 um\"/>"
    drawn plain = draw(UNDER(""), NO_TETHER);
    assert_int_equal(pieces(&plain, 0).count, 1);
    const double keep_out_um = plain.layout->hinge[0].keep_out_m / UM;
    assert_true(keep_out_um < 270);
    fw_arena_free(plain.arena);

    drawn past = draw(UNDER(BAR(-160, 450, -160, 283) BAR(-167, 290, 40, 290)), NO_TETHER);
    assert_int_equal(said(&past, 702), 0);
    assert_int_equal(pieces(&past, 0).count, 1);
    fw_arena_free(past.arena);

    drawn across = draw(UNDER(BAR(-700, 450, -700, 283) BAR(-707, 290, 707, 290)), NO_TETHER);
    assert_int_equal(said(&across, 702), 1);
    for (size_t i = 0; i < across.diags.count; i++) {
        double x, y = 0.0;
        const char *at = strstr(across.diags.item[i].message, ", at (");
        if (across.diags.item[i].number != 702) continue;
        assert_int_equal(across.diags.item[i].severity, FW_WARNING);
        assert_int_equal(across.diags.item[i].place.line, 1);
        if (!at || sscanf(at, ", at (%lf, %lf) um", &x, &y) != 2) fail_msg("%s", across.diags.item[i].message);
        assert_near(y, 290, 1.0);
    }
    fw_arena_free(across.arena);
#undef UNDER
#undef BAR
}

static void memory_runs_out(void **state) {
    (void)state;
    static char xml[16384];
    snprintf(xml, sizeof xml, "%s%s</mechanism></device>", head,
             BODY(PLATE "<disc x=\"800 um\" radius=\"40 um\" hole=\"yes\"/><lettering text=\"I\" "
                        "x=\"600 um\"/>"));
    bool done = false;
    for (long n = 1; !done; n += 1 + n / 8) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        const fw_device *device = NULL;
        const fw_layout *layout = NULL;
        fw_arena_fail_at(n, 1);
        fw_status s = fw_device_read(arena, "t.xml", xml, strlen(xml), NULL, 0, &diags, &device);
        if (s == FW_OK) s = fw_layout_build(arena, device, &diags, &layout);
        fw_arena_fail_at(0, 0);
        if (s != FW_OK && s != FW_NOMEM) fail_msg("allocation %ld: %s", n, fw_status_text(s));
        done = s == FW_OK;
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_follow),       cmocka_unit_test(pieces_are_the_body),
        cmocka_unit_test(mirrored_and_moved), cmocka_unit_test(what_stands_on_it),
        cmocka_unit_test(between_hinges),
        cmocka_unit_test(what_hinges_take_is_said),
        cmocka_unit_test(a_link_that_ends_in_its_hinge),
        cmocka_unit_test(tethers_end_at_thin_bars),
        cmocka_unit_test(necks_find_the_nearest),
        cmocka_unit_test(shapes_move_no_neck),
        cmocka_unit_test(necks_close_nothing),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
