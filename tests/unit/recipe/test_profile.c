/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sections along a cut of hand-made masks: lengths, volumes and depths by hand. */
#include "../mask/scene.h"
#include "../process/packs.h"
#include "recipe/recipe_profile.h"

static const char *const packs[] = {COPPER, SILICON, "soi-deep-rie"};

typedef struct bench { /* a mask of bars that run along y: every cut at an angle is known */
    scene *s;
    fw_process_flow *flow;
    const fw_mask *mask;
    fw_recipe_cut cut;
    fw_recipe_slicer slicer;
    fw_recipe_header header;
} bench;

/* from, to of each bar, um: a flexure of 8 um, 8 um of gap, bodies, 60 um of field, an anchor */
static const double bar[][2] = {{-300, -200}, {0, 8}, {16, 46}, {54, 94}, {154, 300}};
enum { BARS = sizeof bar / sizeof *bar };

/* `angle` of the cut against x; it begins at x = -20 um and ends at x = 174 um */
static bench start(const char *pack, double anisotropy, double angle) {
    static const fw_process_mask_gap gap[] = {{FW_GAP_HINGE, "gap of hinge A", 8e-6}};
    bench b = {.s = scene_new(1e-6, 1e-6)};
    for (int i = 0; i < BARS; i++)
        scene_box(b.s, "bar", bar[i][0], -2000, bar[i][1], 2000);
    b.flow = read_pack(b.s->arena, pack, NULL, NULL, &b.s->diags);
    assert_non_null(b.flow);
    if (strcmp(pack, "soi-deep-rie") == 0) measured(b.flow, "release.reach", 20e-6, 0);
    if (anisotropy > 0.0) measured(b.flow, "rie.A", anisotropy, 0);
    fw_process_mask_facts facts = plain_facts;
    facts.gap = gap;
    facts.ngap = 1;
    facts.narrowest_slot_m = 8e-6;
    assert_int_equal(fw_process_flow_compute(b.s->arena, b.flow, &facts, &b.s->diags), FW_OK);
    b.s->options.bias_m = b.flow->bias_m;
    assert_int_equal(scene_build(b.s, &b.mask), FW_OK);
    b.cut = (fw_recipe_cut){.line = {{-20 * UM, -20 * UM * tan(angle)}, {cos(angle), sin(angle)}},
                            .length_m = 194 * UM / cos(angle),
                            .depth_m = 100 * UM,
                            .name = "test"};
    b.header = (fw_recipe_header){.device = "bars", .program_version = "1", .mask = b.mask};
    return b;
}

static void begin(bench *b) {
    b->header.cut = &b->cut;
    assert_int_equal(fw_recipe_slicer_start(b->s->arena, b->mask, &b->cut, &b->slicer), FW_OK);
}

static int step_index(const fw_process_flow *f, const char *id) {
    for (int i = 0; i < f->nstep; i++)
        if (strcmp(f->step[i].id, id) == 0) return i;
    fail_msg("no step %s", id);
    return -1;
}

static fw_recipe_cross_section section(bench *b, const char *step) {
    fw_recipe_cross_section p;
    assert_int_equal(fw_recipe_cross_section_of(&b->slicer, b->flow, step_index(b->flow, step), &p),
                     FW_OK);
    return p;
}

static double area_of(const fw_recipe_patch *p) {
    return 0.5 * (p->low_m[1] - p->low_m[0] + p->high_m[1] - p->high_m[0]) *
           (p->top_m - p->bottom_m);
}

static double material_area(const fw_recipe_cross_section *p, const char *material) {
    double sum = 0.0;
    for (int i = 0; i < p->n; i++)
        if (strcmp(p->patch[i].film->material, material) == 0) sum += area_of(&p->patch[i]);
    return sum;
}

/* drawn material between x = -20 and 174 um, over the cosine along the cut */
static double drawn_length(double angle) {
    return ((8 - 0) + (46 - 16) + (94 - 54) + (174 - 154)) * UM / cos(angle);
}

/* what is plated is the drawn area times 9 um: the bias takes back what printing adds */
static void plated_volume(void **state) {
    (void)state;
    static const double angle[] = {0.0, 0.3, -0.7};
    for (int i = 0; i < 3; i++) {
        bench b = start(COPPER, 0.0, angle[i]);
        begin(&b);
        fw_recipe_cross_section p = section(&b, "C22");
        double copper = material_area(&p, "copper-plated"), length = drawn_length(angle[i]);
        assert_relative(copper, length * 9e-6, 1e-9);
        double window = b.cut.length_m;
        assert_relative(material_area(&p, "resist"), (window - length) * 16e-6, 1e-9);
        p = section(&b, "C13"); /* before the mould is opened */
        assert_relative(material_area(&p, "resist"), window * 16e-6, 1e-12);
        p = section(&b, "C28");
        assert_relative(material_area(&p, "copper-plated"), copper, 1e-12);
        assert_near(material_area(&p, "resist"), 0, 0);
        scene_free(b.s);
    }
}

/* RIE with A = 0.95: section by the formulas of docs/theory/process.md, written out again here */
static void etched_by_hand(void **state) {
    (void)state;
    const double A = 0.95, D = 50e-6;
    bench b = start(SILICON, A, 0.0);
    begin(&b);
    const fw_process_fixed_point *e = &b.flow->edges;
    double E = 1.1 * D, m = (1.0 - A) * (E - 0.5 * (D + 0.0)), wet = 1.1e-6;
    /* the lag of the open field shifts m by some 10 nm; the rest is by hand */
    assert_near(e->etch_m, m, 3e-8);
    m = e->etch_m;
    fw_recipe_cross_section al = section(&b, "S16"), p = section(&b, "S23");
    assert_near(b.mask->bias_m, m + wet, 1e-15);
    int found = 0;
    for (int i = 0; i < al.n; i++)
        if (strcmp(al.patch[i].film->material, "aluminium") == 0 && al.patch[i].low_m[0] > 0.0) {
            double x0 = bar[1 + found][0] * UM + 20 * UM;
            assert_near(al.patch[i].low_m[0], x0 - m, 1e-14); /* wet etch has taken its part */
            found++;
        }
    assert_int_equal(found, 4);
    found = 0;
    for (int i = 0; i < p.n; i++) {
        const fw_recipe_patch *q = &p.patch[i];
        if (!q->film->in[FW_STACK_STRUCTURE] || q->low_m[0] <= 0.0) continue;
        double x0 = bar[1 + found][0] * UM + 20 * UM;
        assert_near(q->high_m[0], x0 - m + (1.0 - A) * E, 1e-14);
        /* foot: u = (1 - A)(E - D - lag(w)), w the opening to the left of this bar */
        double w = (bar[1 + found][0] - bar[found][1]) * UM - 2.0 * m;
        double left = fmax(0.0, E - D - fw_process_cut_lag(&e->cut[0], w, D));
        assert_near(q->low_m[0], x0 - m + (1.0 - A) * left, 1e-13);
        found++;
    }
    assert_int_equal(found, 4);
    scene_free(b.s);
}

/* silicon before = silicon after + what every opening lost, depth by its width */
static void floors_and_conservation(void **state) {
    (void)state;
    bench b = start(SILICON, 1.0, 0.25);
    begin(&b);
    double D = 50e-6, window = b.cut.length_m, c = cos(0.25);
    fw_recipe_cross_section before = section(&b, "S17"), after = section(&b, "S18");
    assert_relative(material_area(&before, "silicon-100"), window * D, 1e-12);
    const fw_process_cut *cut = &b.flow->edges.cut[0];
    double lost = 0.0;
    for (int i = 0; i + 1 < BARS; i++) { /* askew, and each with its own width all the same */
        double w = (bar[i + 1][0] - bar[i][1]) * UM;
        double shown = i == 0 ? 20 * UM : w; /* the first one begins outside the window */
        lost += shown / c * fw_process_cut_depth(cut, w);
    }
    assert_true(fw_process_cut_depth(cut, 8e-6) < D); /* narrow slots are not through: S = 0.1 */
    assert_relative(material_area(&after, "silicon-100"), window * D - lost, 1e-9);
    fw_recipe_section_plan plan;
    assert_int_equal(fw_recipe_section_plan_of(&b.slicer, b.flow, &plan), FW_OK);
    assert_int_equal(plan.nopening, 3); /* the first one begins outside */
    assert_near(plan.opening[0].drawn_m, 8e-6, 1e-15);
    assert_near(plan.opening[0].mask_m, 5.8e-6, 1e-14);
    assert_near(plan.opening[0].top_m, 8e-6, 1e-14);
    assert_near(plan.opening[0].depth_m, fw_process_cut_depth(cut, 8e-6), 1e-14);
    scene_free(b.s);
}

/* lettering is taken out of the plate: "1/0 NOT 2/0". It is not biased, so that what the wet etch
   takes makes its holes wider */
static void lettering(void **state) {
    (void)state;
    const double letter[4][2] = {{200, -5}, {210, -5}, {210, 5}, {200, 5}};
    bench b = start(SILICON, 1.0, 0.0);
    scene_add(b.s, FW_ROLE_TEXT, "letter", polygon(b.s->arena, letter, 4));
    b.s->table.plate = "1/0 NOT 2/0";
    assert_int_equal(scene_build(b.s, &b.mask), FW_OK);
    b.cut.length_m = 280 * UM; /* to x = 260 um */
    begin(&b);
    static const struct {
        const char *step, *material;
        double hole_um;
    } at[] = {{"S11", "resist", 10.0}, {"S16", "aluminium", 12.2}, {"S23", "silicon-100", 12.2}};
    for (int i = 0; i < 3; i++) {
        fw_recipe_cross_section p = section(&b, at[i].step);
        double left = 0.0, right = 0.0;
        for (int k = 0; k < p.n; k++) { /* the last bar, in two parts */
            const fw_recipe_patch *q = &p.patch[k];
            if (strcmp(q->film->material, at[i].material) != 0 || q->high_m[0] < 170 * UM) continue;
            if (left == 0.0)
                left = q->high_m[1];
            else
                right = q->high_m[0];
        }
        assert_near(right - left, at[i].hole_um * UM, 1e-14);
        assert_near(0.5 * (left + right), 225 * UM, 1e-14);
    }
    scene_free(b.s);
}

/* oxide stays where it is farther than 24 um from every edge: below bars of 100 um and 146 um */
static void released(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        double angle = i ? 0.4 : 0.0;
        bench b = start("soi-deep-rie", 0.0, angle);
        b.cut.line.at = (fw_geometry_vec2){-320 * UM, -320 * UM * tan(angle)};
        b.cut.length_m = 640 * UM / cos(angle);
        begin(&b);
        fw_recipe_cross_section p = section(&b, "D13");
        double length = 0.0;
        int n = 0;
        for (int k = 0; k < p.n; k++)
            if (strcmp(p.patch[k].film->material, "buried-oxide") == 0) {
                length += p.patch[k].high_m[1] - p.patch[k].high_m[0];
                n++;
            }
        /* edges of the resist, m outside the drawn ones, are those of the oxide's mask */
        double m = b.flow->edges.etch_m - 0.005 * 5e-6; /* about: the foot of the silicon */
        assert_int_equal(n, 2);
        assert_near(length, (100 - 48 + 146 - 48 + 4e6 * m) * UM / cos(angle), 2e-7);
        scene_free(b.s);
    }
}

/* every picture and every document again, byte for byte, and each step's own */
static void the_same_again(void **state) {
    (void)state;
    fw_status (*const write[])(const fw_process_flow *, const fw_recipe_header *, fw_text *) = {
        fw_recipe_write_html, fw_recipe_write_sections_svg, fw_recipe_write_sections_json,
        fw_recipe_write_stack_svg};
    for (int i = 0; i < 3; i++) {
        bench b = start(packs[i], 0.0, 0.2);
        begin(&b);
        for (int w = 0; w < 4; w++) {
            fw_text text[2];
            for (int k = 0; k < 2; k++) {
                text[k] = fw_text_new(b.s->arena);
                assert_int_equal(write[w](b.flow, &b.header, &text[k]), FW_OK);
            }
            assert_int_equal(text[0].length, text[1].length);
            assert_memory_equal(text[0].data, text[1].data, text[0].length);
            assert_true(w == 0 ||
                        !strstr(text[0].data, "nan")); /* a source of the run sheet: NanoLab */
            assert_true(w == 0 || !strstr(text[0].data, "inf"));
            assert_null(strstr(text[0].data, "REJECTED"));
            b.header.rejected = true;
            text[0] = fw_text_new(b.s->arena);
            assert_int_equal(write[w](b.flow, &b.header, &text[0]), FW_OK);
            assert_non_null(strstr(text[0].data, "REJECTED"));
            b.header.rejected = false;
        }
        fw_recipe_section_scale scale;
        assert_int_equal(fw_recipe_section_scale_of(b.s->arena, b.flow, &b.cut, &scale), FW_OK);
        for (int k = 0; k < b.flow->nstep; k++) {
            fw_recipe_slicer other; /* not the cache of the other steps */
            fw_text p = fw_text_new(b.s->arena), q = fw_text_new(b.s->arena);
            assert_int_equal(fw_recipe_slicer_start(b.s->arena, b.mask, &b.cut, &other), FW_OK);
            assert_int_equal(fw_recipe_section_exact(&b.slicer, b.flow, &scale, k, &p), FW_OK);
            assert_int_equal(fw_recipe_section_exact(&other, b.flow, &scale, k, &q), FW_OK);
            assert_string_equal(p.data, q.data);
        }
        scene_free(b.s);
    }
}

/* memory that runs out anywhere is said, and nothing else happens */
static void out_of_memory(void **state) {
    (void)state;
    fw_status (*const write[])(const fw_process_flow *, const fw_recipe_header *, fw_text *) = {
        fw_recipe_write_html, fw_recipe_write_sections_svg, fw_recipe_write_sections_json,
        fw_recipe_write_stack_svg};
    bench b = start("soi-deep-rie", 0.0, 0.2);
    begin(&b);
    for (int w = 0; w < 4; w++) {
        long n = 1;
        for (fw_status status = FW_NOMEM; status != FW_OK; n += 1 + n / 8) {
            fw_arena *own = fw_arena_new(0);
            fw_text text = fw_text_new(own);
            fw_arena_fail_at(n, 1);
            status = write[w](b.flow, &b.header, &text);
            fw_arena_fail_at(0, 0);
            assert_true(status == FW_NOMEM || status == FW_OK);
            fw_arena_free(own);
        }
        assert_true(n > 30);
    }
    scene_free(b.s);
}

/* random disjoint walls: none comes before one that it hides; witness by rays */
static void walls(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    uint64_t seed = 7;
    enum { N = 60, RAYS = 400 };
    for (int round = 0; round < 40; round++) {
        fw_recipe_wall w[N];
        for (int i = 0; i < N; i++) { /* each in its own cell of a lattice: they cannot cross */
            double x = i % 10, y = i / 10;
            w[i] = (fw_recipe_wall){
                .a = {x + 0.98 * random01(&seed), y + 0.98 * random01(&seed), false},
                .b = {x + 0.98 * random01(&seed), y + 0.98 * random01(&seed), false}};
        }
        double turn = 6.28 * random01(&seed), tx = cos(turn), ty = sin(turn);
        assert_int_equal(fw_recipe_walls_sort(arena, w, N, tx, ty), FW_OK);
        for (int r = 0; r < RAYS; r++) {
            double across = 24.0 * random01(&seed) - 12.0, last = -HUGE_VAL;
            for (int i = 0; i < N; i++) { /* in the order of painting: ever nearer on this ray */
                double xa = -ty * w[i].a.x + tx * w[i].a.y, xb = -ty * w[i].b.x + tx * w[i].b.y;
                double t = (across - xa) / (xb - xa);
                if (!(t > 0.0 && t < 1.0)) continue;
                double depth = tx * (w[i].a.x + t * (w[i].b.x - w[i].a.x)) +
                               ty * (w[i].a.y + t * (w[i].b.y - w[i].a.y));
                assert_true(depth > last - 1e-9);
                last = fmax(last, depth);
            }
        }
    }
    fw_arena_free(arena);
}

/* area of a film's region behind the cut, m2 */
static double region_area(bench *b, const char *step, const char *material, double part) {
    fw_process_films films;
    fw_recipe_rings rings;
    double area = 0.0;
    const fw_process_film *found = NULL;
    assert_int_equal(fw_process_flow_films(b->s->arena, b->flow, step_index(b->flow, step), &films),
                     FW_OK);
    for (int i = 0; i < films.n; i++)
        if (strcmp(films.film[i].material, material) == 0 &&
            (!found || films.film[i].top_m > found->top_m))
            found = &films.film[i];
    assert_non_null(found);
    assert_int_equal(fw_recipe_region_of(&b->slicer, b->flow, found, part, 0.1 * UM, &rings),
                     FW_OK);
    for (int i = 0; i < rings.n; i++)
        for (int k = 0; k < rings.ring[i].n; k++) {
            fw_recipe_spot p = rings.ring[i].corner[k],
                           q = rings.ring[i].corner[(k + 1) % rings.ring[i].n];
            area += 0.5 * (p.x * q.y - q.x * p.y);
        }
    return area;
}

/* where films lie when three plates part them: bars of silicon over a hollow of 110 um and its land of 30 by 40 um */
static void regions_of_several_plates(void **state) {
    (void)state;
    size_t n;
    bench b = start(SILICON, 0.0, 0.0);
    scene *s = b.s;
    const char *xml = pack_text(s->arena, "../masks/silicon-on-glass", &n);
    s->diags = fw_diags_new(s->arena);
    assert_int_equal(fw_mask_table_read(s->arena, "t.xml", xml, n, &s->diags, &s->table), FW_OK);
    s->table.nrule = 0;
    const double hollow[4][2] = {{-10, -500}, {100, -500}, {100, 500}, {-10, 500}},
                 land[4][2] = {{30, 30}, {60, 30}, {60, 70}, {30, 70}};
    scene_add(s, FW_ROLE_CAVITY, "hollow", polygon(s->arena, hollow, 4));
    scene_add(s, FW_ROLE_LAND, "land", polygon(s->arena, land, 4));
    b.flow = read_pack(s->arena, "silicon-on-glass", NULL, NULL, &s->diags);
    assert_non_null(b.flow);
    assert_int_equal(fw_process_flow_compute(s->arena, b.flow, &plain_facts, &s->diags), FW_OK);
    double bias[16] = {0};
    for (int k = 0; k < s->table.nlayer; k++)
        bias[k] = s->table.layer[k].shrink ? -20 * UM : s->table.layer[k].grow ? 20 * UM : 0.0;
    s->options.bias_m = b.flow->bias_m;
    s->options.layer_bias_m = bias;
    assert_int_equal(scene_build(s, &b.mask), FW_OK);
    begin(&b);
    double block = 194 * 100, silicon = drawn_length(0.0) / UM * 100;
    assert_relative(region_area(&b, "G01", "glass-carrier", 1.0) / (UM * UM), block, 1e-9);
    /* the ground as it was printed at its foot, as it is drawn at its head */
    assert_relative(region_area(&b, "G12", "glass-carrier", 1.0) / (UM * UM),
                    block - 110 * 100 + 30 * 40, 1e-9);
    assert_relative(region_area(&b, "G12", "glass-carrier", 0.0) / (UM * UM),
                    block - 70 * 100 + 70 * 80, 1e-9);
    assert_relative(region_area(&b, "G12", "resist", 1.0) / (UM * UM), block - 70 * 100 + 70 * 80,
                    1e-9);
    assert_relative(region_area(&b, "G19", "silicon-100", 0.5) / (UM * UM), block, 1e-9);
    assert_relative(region_area(&b, "G42", "silicon-100", 0.5) / (UM * UM), silicon, 1e-6);
    fw_text svg = fw_text_new(s->arena);
    assert_int_equal(fw_recipe_write_stack_svg(b.flow, &b.header, &svg), FW_OK);
    assert_non_null(strstr(svg.data, ">G53&#160;") ? svg.data : strstr(svg.data, "G46"));
    scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regions_of_several_plates),
        cmocka_unit_test(plated_volume),
        cmocka_unit_test(etched_by_hand),
        cmocka_unit_test(floors_and_conservation),
        cmocka_unit_test(lettering),
        cmocka_unit_test(released),
        cmocka_unit_test(the_same_again),
        cmocka_unit_test(walls),
        cmocka_unit_test(out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
