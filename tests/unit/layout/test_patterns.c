/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Test patterns against closed forms and independent computations. */
#include "layout/pattern.h"
#include "test.h"

#define UM 1e-6
#define PI 3.14159265358979323846

typedef struct drawn {
    fw_arena *arena;
    fw_layout_pattern row;
    fw_layout_coupon c;
} drawn;

static drawn *start(const char *kind) {
    fw_arena *arena = fw_arena_new(0);
    drawn *d = fw_arena_one(arena, drawn);
    d->arena = arena;
    d->row.kind = fw_layout_pattern_kind_named(kind);
    assert_non_null(d->row.kind);
    d->row.id = d->row.title = kind;
    for (int i = 0; i < d->row.kind->nparameter; i++)
        d->row.value[i] = d->row.kind->parameter[i].usual;
    return d;
}

static void set(drawn *d, const char *name, double value) {
    for (int i = 0; i < d->row.kind->nparameter; i++)
        if (strcmp(d->row.kind->parameter[i].name, name) == 0) {
            d->row.value[i] = value;
            return;
        }
    fail_msg("no parameter %s", name);
}

static void sizes(drawn *d, const double *um, int n) {
    d->row.nsize = n;
    for (int i = 0; i < n; i++)
        d->row.size_m[i] = um[i] * UM;
}

static void draw(drawn *d) {
    assert_int_equal(fw_layout_pattern_draw(d->arena, &d->row, 4 * UM, 4 * UM, 0, &d->c), FW_OK);
}

static double area_of(const drawn *d, fw_layout_role role) {
    double sum = 0;
    for (int i = 0; i < d->c.npiece; i++)
        if (d->c.piece[i].role == role) sum += fw_geometry_contour_area(&d->c.piece[i].contour);
    return sum;
}

static double figure(const drawn *d, const char *name) {
    for (int i = 0; i < d->c.nfigure; i++)
        if (strcmp(d->c.figure[i].name, name) == 0) return d->c.figure[i].value;
    fail_msg("no figure %s", name);
    return 0;
}

static double random01(uint64_t *seed) {
    *seed = *seed * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

/* ---- what every kind keeps ---- */

static bool grid(double x) {
    return fabs(x * 1e9 - nearbyint(x * 1e9)) < 1e-6;
}

static const double usual_sizes[] = {20, 30, 60, 100};

static void every_kind(void **state) {
    (void)state;
    const fw_layout_pattern_kind *kind;
    for (size_t k = 0; (kind = fw_layout_pattern_kind_at(k)); k++) {
        if (kind->fills || kind->in_window) continue;
        drawn *d = start(kind->name);
        if (kind->sizes) sizes(d, usual_sizes, 4);
        draw(d);
        double area = 0, wide = 0, high = 0;
        int feet = 0;
        for (int i = 0; i < d->c.npiece; i++) {
            const fw_geometry_contour *p = &d->c.piece[i].contour;
            fw_geometry_box b = fw_geometry_contour_box(p);
            assert_true(b.x0 >= 0 && b.y0 >= 0);
            wide = fmax(wide, b.x1), high = fmax(high, b.y1);
            area += fw_geometry_contour_area(p);
            bool stands = false;
            for (int s = 0; s < p->count; s++) {
                assert_true(grid(p->segment[s].a.x) && grid(p->segment[s].a.y));
                bool floor = p->segment[s].a.y == 0 && p->segment[s].b.y == 0;
                if (d->c.piece[i].role == FW_ROLE_STRUCTURE && floor) {
                    assert_true(p->segment[s].flags & FW_SEGMENT_JOINT);
                    assert_true(p->segment[s].b.x > p->segment[s].a.x);
                    stands = true;
                }
            }
            feet += stands;
            /* a piece of the material stands, or shares a joint with another piece */
            bool joined = stands;
            for (int s = 0; s < p->count; s++)
                joined = joined || p->segment[s].flags & FW_SEGMENT_JOINT;
            assert_true(joined || d->c.piece[i].role != FW_ROLE_STRUCTURE);
        }
        assert_true(area > 0 && (feet > 0) == !kind->on_frame && d->c.nfeature > 0);
        assert_near(wide, d->c.width_m, 1e-15);
        assert_near(high, d->c.height_m, 1e-15);
        for (int i = 0; i < d->c.nfeature; i++)
            assert_true(d->c.feature[i].drawn_m > 0);
        fw_arena_free(d->arena);
    }
}

/* numbers that do not go together are refused, never drawn somehow */
static void refusals(void **state) {
    (void)state;
    static const struct {
        const char *kind, *parameter;
        double value;
    } bad[] = {{"undercut-ladder", "to", 4e-6},  {"stress-pointer", "offset", 12e-6},
               {"stress-pointer", "arm", 60e-6}, {"van-der-pauw", "pad", 41e-6},
               {"vernier", "teeth", 16},         {"back-mark", "cross", 155e-6},
               {"back-mark", "ring", 21e-6},     {"release-holes", "hole", 14e-6}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        drawn *d = start(bad[i].kind);
        if (d->row.kind->sizes) sizes(d, usual_sizes, 4);
        set(d, bad[i].parameter, bad[i].value);
        assert_int_equal(fw_layout_pattern_draw(d->arena, &d->row, 4 * UM, 4 * UM, 0, &d->c),
                         FW_GEOMETRY);
        fw_arena_free(d->arena);
    }
    assert_null(fw_layout_pattern_kind_named("ladder"));
}

/* ---- sizes ---- */

static void ladder_has_the_stated_widths(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int trial = 0; trial < 20; trial++) {
        drawn *d = start("undercut-ladder");
        double from = 1e-9 * (2000 + floor(5000 * random01(&seed)));
        double step = 1e-9 * (100 + floor(900 * random01(&seed)));
        int n = 2 + (int)(40 * random01(&seed));
        set(d, "from", from);
        set(d, "step", step);
        set(d, "to", from + (n - 1) * step);
        draw(d);
        assert_int_equal(d->c.npiece, n);
        double area = 0, length = d->row.value[4];
        for (int i = 0; i < n; i++) {
            fw_geometry_box b = fw_geometry_contour_box(&d->c.piece[i].contour);
            assert_near(b.x1 - b.x0, from + i * step, 1e-15);
            if (i > 0)
                assert_near(b.x0 - fw_geometry_contour_box(&d->c.piece[i - 1].contour).x1, 20 * UM,
                            1e-15);
            assert_near(d->c.feature[i].drawn_m, from + i * step, 1e-15);
            area += length * (from + i * step);
        }
        assert_relative(area_of(d, FW_ROLE_STRUCTURE), area, 1e-12);
        fw_arena_free(d->arena);
    }
}

static void slots_have_the_stated_widths(void **state) {
    (void)state;
    const double w[] = {4, 5.5, 7.001, 10, 100};
    drawn *d = start("arde-slots");
    sizes(d, w, 5);
    draw(d);
    assert_int_equal(d->c.npiece, 6);
    for (int i = 0; i < 5; i++) {
        double gap = fw_geometry_contour_box(&d->c.piece[i + 1].contour).x0 -
                     fw_geometry_contour_box(&d->c.piece[i].contour).x1;
        assert_near(gap, w[i] * UM, 1e-15);
        assert_near(d->c.feature[i].drawn_m, w[i] * UM, 1e-15);
    }
    fw_arena_free(d->arena);
}

static void pads_and_thief(void **state) {
    (void)state;
    const double w[] = {10, 30, 100};
    drawn *d = start("plating-pads");
    sizes(d, w, 3);
    draw(d);
    assert_relative(area_of(d, FW_ROLE_STRUCTURE), 140 * UM * 150 * UM, 1e-12);
    assert_relative(figure(d, "area"), 140.0 * 150, 1e-12);
    fw_arena_free(d->arena);
    d = start("plating-thief");
    draw(d);
    double outer = 260.0 * 180, inner = 180.0 * 140, pad = 100.0 * 100;
    assert_relative(figure(d, "ring area"), outer - inner, 1e-12);
    assert_relative(area_of(d, FW_ROLE_STRUCTURE) * 1e12, outer - inner + pad, 1e-12);
    /* least distance of pad and ring is the stated one */
    fw_geometry_vec2 p, q;
    assert_near(
        fw_geometry_contour_distance(&d->c.piece[0].contour, &d->c.piece[1].contour, &p, &q),
        40 * UM, 1e-15);
    fw_arena_free(d->arena);
}

static void crosses(void **state) {
    (void)state;
    drawn *d = start("van-der-pauw");
    draw(d);
    double a = 40, arm = 60, pad = 120;
    assert_relative(area_of(d, FW_ROLE_STRUCTURE) * 1e12, a * a + 4 * a * arm + 4 * pad * pad,
                    1e-12);
    assert_int_equal(d->c.npiece, 1);
    fw_arena_free(d->arena);
    d = start("back-mark");
    draw(d);
    assert_relative(area_of(d, FW_ROLE_BACK) * 1e12, 2 * 120.0 * 20 - 20.0 * 20, 1e-12);
    assert_relative(area_of(d, FW_ROLE_MARK) * 1e12, 160.0 * 160, 1e-12);
    assert_relative(area_of(d, FW_ROLE_STRUCTURE) * 1e12, 240.0 * 240, 1e-12);
    assert_near(area_of(d, FW_ROLE_METAL), 0.0, 0.0);
    fw_arena_free(d->arena);
    d = start(
        "back-mark"); /* a bar beside each side of the window, 10 um from it and from the edge */
    set(d, "ring", 20 * UM);
    draw(d);
    assert_relative(area_of(d, FW_ROLE_METAL) * 1e12, 4 * 160.0 * 20, 1e-12);
    for (int i = 0; i < d->c.npiece; i++) {
        fw_geometry_box b = fw_geometry_contour_box(&d->c.piece[i].contour);
        if (d->c.piece[i].role != FW_ROLE_METAL) continue;
        assert_true(b.x0 > 9.9 * UM && b.y0 > 9.9 * UM && b.x1 < 230.1 * UM && b.y1 < 230.1 * UM);
    }
    fw_arena_free(d->arena);
}

/* vertical edges of one shape at height y, from the left */
static int edges_at(const fw_geometry_contour *c, double y, double *x, int most) {
    int n = 0;
    for (int i = 0; i < c->count; i++) {
        fw_geometry_vec2 a = c->segment[i].a, b = c->segment[i].b;
        if (a.x != b.x || !(fmin(a.y, b.y) < y && y < fmax(a.y, b.y))) continue;
        int k = n++;
        assert_true(n <= most);
        for (; k > 0 && x[k - 1] > a.x; k--)
            x[k] = x[k - 1];
        x[k] = a.x;
    }
    return n;
}

/* tooth i of the second scale stands i steps from tooth i of the first */
static void vernier_steps(void **state) {
    (void)state;
    drawn *d = start("vernier");
    draw(d);
    assert_int_equal(d->c.npiece, 4);
    const fw_geometry_contour *first = &d->c.piece[0].contour, *second = &d->c.piece[1].contour;
    assert_int_equal(d->c.piece[1].role, FW_ROLE_BACK);
    double x[40], z[40], y = d->c.feature[0].from.y;
    assert_int_equal(edges_at(first, y - 10 * UM, x, 40), 34);
    assert_int_equal(edges_at(second, y + 20 * UM, z, 40), 34);
    for (int i = 0; i < 34; i++)
        assert_near(x[i] - z[i], (i / 2 - 8) * 0.25 * UM, 1e-15);
    for (int i = 0; i < 17; i++)
        assert_near(x[2 * i + 1] - x[2 * i], 6 * UM, 1e-15);
    fw_arena_free(d->arena);
}

static void lines_and_nests(void **state) {
    (void)state;
    const double w[] = {4, 6.5};
    drawn *d = start("cd-lines");
    sizes(d, w, 2);
    draw(d);
    /* six upright pieces and one with the level lines, for each width */
    assert_int_equal(d->c.npiece, 14);
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < 6; i++) {
            fw_geometry_box b = fw_geometry_contour_box(&d->c.piece[7 * k + i].contour);
            assert_near(b.x1 - b.x0, w[k] * UM, 1e-15);
            if (i > 0 && i < 5)
                assert_near(b.x0 - fw_geometry_contour_box(&d->c.piece[7 * k + i - 1].contour).x1,
                            w[k] * UM, 1e-15);
        }
        double level = 6 * w[k] * 100 + 30 * (40 + 9 * w[k] + 40 + w[k]);
        assert_relative(fw_geometry_contour_area(&d->c.piece[7 * k + 6].contour) * 1e12, level,
                        1e-12);
    }
    fw_arena_free(d->arena);
    d = start("resolution");
    sizes(d, w, 2);
    draw(d);
    assert_int_equal(d->c.npiece, 8);
    for (int i = 0; i < 8; i++) {
        const fw_geometry_contour *c = &d->c.piece[i].contour;
        assert_near(fw_geometry_contour_clearance(c, true, NULL, NULL), w[i / 4] * UM, 1e-15);
        if (i % 4)
            assert_near(fw_geometry_contour_distance(c, &d->c.piece[i - 1].contour, NULL, NULL),
                        w[i / 4] * UM, 1e-15);
    }
    fw_arena_free(d->arena);
}

/* ---- holes ---- */

/* farthest point of the cell between four holes from all nine around it, by a fine grid */
static double farthest(double p, double s, bool round) {
    double most = 0;
    enum { N = 400 };
    for (int i = 0; i <= N; i++)
        for (int j = 0; j <= N; j++) {
            double x = p * i / N, y = p * j / N, least = HUGE_VAL;
            for (int a = 0; a <= 1; a++)
                for (int b = 0; b <= 1; b++) {
                    double dx = fabs(x - a * p), dy = fabs(y - b * p), r;
                    r = round ? fmax(hypot(dx, dy) - s / 2, 0)
                              : hypot(fmax(dx - s / 2, 0), fmax(dy - s / 2, 0));
                    least = fmin(least, r);
                }
            most = fmax(most, least);
        }
    return most;
}

static void plates_with_holes(void **state) {
    (void)state;
    for (int round = 0; round < 2; round++) {
        const double pitch[] = {30};
        drawn *d = start("release-holes");
        sizes(d, pitch, 1);
        set(d, "round", round);
        draw(d);
        assert_int_equal(d->c.npiece, 5);
        double side = 120, hole = round ? PI * 25 : 100;
        assert_relative(area_of(d, FW_ROLE_STRUCTURE) * 1e12, side * side - 16 * hole + 20.0 * 30,
                        1e-12);
        assert_relative(d->c.feature[0].drawn_m, farthest(30 * UM, 10 * UM, round), 1e-12);
        /* every joint but the foot has its partner, bit for bit */
        int joints = 0, paired = 0;
        for (int i = 0; i < d->c.npiece; i++)
            for (int s = 0; s < d->c.piece[i].contour.count; s++) {
                const fw_geometry_segment *u = &d->c.piece[i].contour.segment[s];
                if (!(u->flags & FW_SEGMENT_JOINT)) continue;
                joints++;
                for (int j = 0; j < d->c.npiece; j++)
                    for (int t = 0; t < d->c.piece[j].contour.count; t++) {
                        const fw_geometry_segment *v = &d->c.piece[j].contour.segment[t];
                        paired += v->flags & FW_SEGMENT_JOINT && u->a.x == v->b.x &&
                                  u->a.y == v->b.y && u->b.x == v->a.x && u->b.y == v->a.y;
                    }
            }
        assert_int_equal(joints, 2 * 4 * 5 + 1);
        assert_int_equal(paired, joints - 1);
        /* and the strips take a bias: each hole shrinks, each joint fits */
        for (int i = 0; i < d->c.npiece; i++) {
            fw_geometry_contour grown;
            int a, b;
            assert_int_equal(fw_geometry_contour_offset(d->arena, &d->c.piece[i].contour, 1 * UM,
                                                        &grown, &a, &b),
                             FW_OK);
        }
        fw_arena_free(d->arena);
    }
}

static void fill_density(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 100; i++) {
        double s = 10 + 90 * random01(&seed), n = 0.5 * s * random01(&seed) + 1,
               want = 0.1 + 0.7 * random01(&seed);
        double g = fw_layout_fill_gap_m(s, n, want);
        assert_true(g > 0);
        assert_relative((s * s + n * g) / ((s + g) * (s + g)), want, 1e-12);
    }
    assert_near(fw_layout_fill_gap_m(40, 10, 0.5), 20, 1e-12);
    assert_true(isnan(fw_layout_fill_gap_m(40, 10, 1.0)));
}

/* ---- the pointer: a plane frame of beams by direct stiffness, with the strain as a load ---- */

/* adds a beam from node i to node j to K (3 dof each) and its load by the free strain e (a film
   that wants to be shorter pulls its ends together) */
static void add_beam(double *K, double *f, int ndof, const double *x, const double *y, int i, int j,
                     double E, double A, double I, double e) {
    double dx = x[j] - x[i], dy = y[j] - y[i], l = hypot(dx, dy), c = dx / l, s = dy / l;
    double k[6][6] = {{0}}, T[6][6] = {{0}}, a = E * A / l, b = E * I / (l * l * l);
    const double bend[4][4] = {{12, 6 * l, -12, 6 * l},
                               {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                               {-12, -6 * l, 12, -6 * l},
                               {6 * l, 2 * l * l, -6 * l, 4 * l * l}};
    const int at[4] = {1, 2, 4, 5},
              dof[6] = {3 * i, 3 * i + 1, 3 * i + 2, 3 * j, 3 * j + 1, 3 * j + 2};
    k[0][0] = k[3][3] = a, k[0][3] = k[3][0] = -a;
    for (int p = 0; p < 4; p++)
        for (int q = 0; q < 4; q++)
            k[at[p]][at[q]] = b * bend[p][q];
    for (int n = 0; n < 2; n++) {
        T[3 * n][3 * n] = T[3 * n + 1][3 * n + 1] = c;
        T[3 * n][3 * n + 1] = s, T[3 * n + 1][3 * n] = -s, T[3 * n + 2][3 * n + 2] = 1;
    }
    const double pull[6] = {E * A * e, 0, 0, -E * A * e, 0, 0};
    for (int p = 0; p < 6; p++)
        for (int q = 0; q < 6; q++) {
            double sum = 0;
            for (int u = 0; u < 6; u++)
                for (int v = 0; v < 6; v++)
                    sum += T[u][p] * k[u][v] * T[v][q];
            K[dof[p] * ndof + dof[q]] += sum;
        }
    for (int p = 0; p < 6; p++)
        for (int u = 0; u < 6; u++)
            f[dof[p]] += T[u][p] * pull[u];
}

static void solve(double *K, double *f, int n) {
    for (int k = 0; k < n; k++) { /* elimination with the largest pivot of the column */
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(K[i * n + k]) > fabs(K[best * n + k])) best = i;
        for (int j = 0; j < n; j++) {
            double t = K[k * n + j];
            K[k * n + j] = K[best * n + j], K[best * n + j] = t;
        }
        double t = f[k];
        f[k] = f[best], f[best] = t;
        for (int i = k + 1; i < n; i++) {
            double m = K[i * n + k] / K[k * n + k];
            for (int j = k; j < n; j++)
                K[i * n + j] -= m * K[k * n + j];
            f[i] -= m * f[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++)
            f[k] -= K[k * n + j] * f[j];
        f[k] /= K[k * n + k];
    }
}

/* nodes: 0 and 1 anchors (left, right), 2 and 3 ends of the arms on the pointer, 4 the middle */
static double frame_turn(double arm, double offset, double width, double stiffer) {
    enum { N = 15 };
    double K[N * N] = {0}, f[N] = {0}, E = 120e9, h = 10e-6, A = width * h;
    double I = h * width * width * width / 12, e = 1e-4;
    const double x[] = {-arm, arm, 0, 0, 0},
                 y[] = {offset / 2, -offset / 2, offset / 2, -offset / 2, 0};
    add_beam(K, f, N, x, y, 0, 2, E, A, I, e);
    add_beam(K, f, N, x, y, 3, 1, E, A, I, e);
    add_beam(K, f, N, x, y, 2, 4, E, stiffer * A, stiffer * I, e);
    add_beam(K, f, N, x, y, 4, 3, E, stiffer * A, stiffer * I, e);
    for (int i = 0; i < 6; i++) { /* anchors are held */
        for (int j = 0; j < N; j++)
            K[i * N + j] = K[j * N + i] = i == j;
        f[i] = 0;
    }
    solve(K, f, N);
    return f[14] / e;
}

static void pointer_turns_as_a_frame_of_beams_does(void **state) {
    (void)state;
    static const double c[][3] = {
        {250e-6, 24e-6, 8e-6}, {400e-6, 30e-6, 6e-6}, {150e-6, 40e-6, 12e-6}};
    for (int i = 0; i < 3; i++) {
        double closed = fw_layout_pointer_turn_per_strain(c[i][0], c[i][1], c[i][2]);
        /* a pointer a million times as stiff: what is left falls with its stiffness.
           Counter-clockwise: the tip above goes to the left where the film pulls */
        assert_relative(frame_turn(c[i][0], c[i][1], c[i][2], 1e6), closed, 1e-6);
        /* the pointer is drawn twice as wide as an arm: it gives a little */
        assert_relative(frame_turn(c[i][0], c[i][1], c[i][2], 8), closed, 0.08);
    }
    drawn *d = start("stress-pointer");
    draw(d);
    assert_relative(figure(d, "turn per strain"),
                    fw_layout_pointer_turn_per_strain(250e-6, 24e-6, 8e-6), 1e-12);
    assert_relative(figure(d, "amplification"), figure(d, "turn per strain") * 220e-6, 1e-12);
    assert_relative(figure(d, "strain per step"), 0.5e-6 / figure(d, "amplification"), 1e-12);
    fw_arena_free(d->arena);
}

/* Beams over a hollow of another plate: 20 um beyond them on every side, below their bar, too; without it nothing
   changes but where they begin. */
static void beams_hang_over_a_hollow(void **state) {
    (void)state;
    const double lengths[] = {200, 350};
    for (int hollow = 0; hollow < 2; hollow++) {
        drawn *d = start("cantilevers");
        sizes(d, lengths, 2);
        if (hollow) set(d, "hollow", 20 * UM);
        draw(d);
        const double from = hollow ? 20 * UM : 0;
        fw_geometry_box below = {0};
        int hollows = 0, beams = 0;
        for (int i = 0; i < d->c.npiece; i++) {
            const fw_layout_piece *p = &d->c.piece[i];
            const fw_geometry_box b = fw_geometry_contour_box(&p->contour);
            if (p->role == FW_ROLE_CAVITY) {
                below = b;
                hollows++;
                assert_int_equal(p->body, FW_NONE - 1);
                continue;
            }
            assert_true(fabs(b.x0 - (from + beams * 72 * UM)) < 1e-12);
            assert_true(fabs(b.y1 - (lengths[beams++] * UM)) < 1e-12);
        }
        assert_int_equal(beams, 2);
        assert_int_equal(hollows, hollow);
        assert_true(fabs(d->c.width_m - (84 * UM + 2 * from)) < 1e-12);
        assert_true(fabs(d->c.height_m - (350 * UM + from)) < 1e-12);
        if (hollow) {
            assert_true(fabs(below.x0 - (0)) < 1e-12);
            assert_true(fabs(below.x1 - (124 * UM)) < 1e-12);
            assert_true(fabs(below.y0 - (-20 * UM)) < 1e-12);
            assert_true(fabs(below.y1 - (370 * UM)) < 1e-12);
        }
        fw_arena_free(d->arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind),
        cmocka_unit_test(refusals),
        cmocka_unit_test(ladder_has_the_stated_widths),
        cmocka_unit_test(slots_have_the_stated_widths),
        cmocka_unit_test(pads_and_thief),
        cmocka_unit_test(crosses),
        cmocka_unit_test(vernier_steps),
        cmocka_unit_test(lines_and_nests),
        cmocka_unit_test(plates_with_holes),
        cmocka_unit_test(fill_density),
        cmocka_unit_test(pointer_turns_as_a_frame_of_beams_does),
        cmocka_unit_test(beams_hang_over_a_hollow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
