/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The named cases whose instructions are counted (tests/bench/gate). Each is prepared, then run
   once inside `measured`, around which callgrind counts:

   valgrind --tool=callgrind --toggle-collect=measured --dump-after=measured gate_cases [CASE...]

   Without names all of them in the order of the table. A line each: name, 1 when it went well. The
   first line says which of the processor's instructions the program sees, because kernels are
   chosen by them. */
#include "flexure/beam.h"
#include "flexure/flexure.h"
#include "dynamics/models.h"
#include "maths/ode.h"
#include "multibody/kernel.h"
#include "multibody/system.h"
#include "plan/design.h"
#include "workspace/reach.h"
#include "workspace/six_bar_fixture.h"
#include <stdlib.h>

static const char benchmark_file[] = FW_SOURCE_DATA_DIR "/tests/data/six-bar-benchmark.xml";
static const char six_bar_file[] = FW_SOURCE_DATA_DIR "/docs/gallery/reference-six-bar/device.xml";
static const double pi = 3.14159265358979323846;

/* what the cases work on; each fills what it needs */
typedef struct gate {
    fw_arena *arena;
    rig r;
    fw_dynamics_motion_options motion;
    fw_multibody_kernel *kernel;
    double *y, *f;
    int ny;
    fw_maths_stepper *stepper;
    fw_design *design;
    fw_flexure_input hinge;
    fw_flexure_elastica *beam;
    six_bar_fixture fixture;
    fw_workspace_loop loop;
    fw_plan *plan;
    char *xml;
    size_t length;
    double used; /* so that nothing is left out as unused */
} gate;

static bool must(fw_status status) {
    return status == FW_OK;
}

/* ---- motion ---- */

static bool prepare_rhs(gate *g) {
    g->r = rig_six_bar(g->arena, false);
    fw_diags diags = fw_diags_new(g->arena);
    const fw_effect_choice choice = {0};
    fw_effect_ledger ledger;
    fw_effects_loads *loads = fw_arena_one(g->arena, fw_effects_loads);
    const fw_multibody_model *m = NULL;
    double q[15];
    for (int b = 0; b < 5; b++) {
        q[3 * b] = g->r.m.body[b].x_m;
        q[3 * b + 1] = g->r.m.body[b].y_m;
        q[3 * b + 2] = g->r.m.body[b].phi_rad;
    }
    if (!must(fw_effects_compile(g->arena, &g->r.m, &g->r.scene, &choice, 1e-3, &diags, &ledger,
                                 loads)) ||
        !must(
            fw_multibody_model_new(g->arena, &g->r.m, loads, q, g->r.scene.duration_s, NULL, &m)) ||
        !must(fw_multibody_kernel_new(g->arena, m, &g->kernel)) || !g->kernel)
        return false;
    g->ny = m->ny;
    g->y = fw_arena_array(g->arena, double, (size_t)m->ny);
    g->f = fw_arena_array(g->arena, double, (size_t)m->ny);
    uint64_t seed = 5;
    for (int i = 0; i < m->ny; i++)
        g->y[i] = 0.1 * (rig_random(&seed) - 0.5);
    return true;
}

static bool run_rhs(gate *g) {
    for (int i = 0; i < 1000; i++) {
        fw_multibody_kernel_rhs(g->kernel, g->y, g->f);
        g->y[2] += 1e-30 * g->f[g->ny / 2];
    }
    return isfinite(g->y[2]) != 0;
}

static bool run_motion(gate *g) {
    fw_diags diags = fw_diags_new(g->arena);
    const fw_dynamics_motion *m = NULL;
    return must(fw_dynamics_simulate(g->arena, &g->r.m, &g->r.scene, &g->motion, &diags, &m));
}

static bool prepare_six_bar(gate *g) {
    g->r = rig_six_bar(g->arena, false);
    g->motion = (fw_dynamics_motion_options){.rtol = 1e-8, .samples = 11};
    return true;
}

static bool prepare_squeezer(gate *g) {
    g->r = rig_squeezer(g->arena);
    g->motion = (fw_dynamics_motion_options){.rtol = 1e-8, .samples = 11};
    return true;
}

static bool prepare_windows(gate *g) {
    g->r = rig_windows(g->arena, 100);
    g->r.scene.duration_s = 1;
    g->motion = (fw_dynamics_motion_options){.rtol = 1e-8, .samples = 2};
    return true;
}

/* ---- the core of a motion, and the public call that gives it ---- */

static const double public_rtol = 3e-9;

/* as dynamics/start.c has it: twice the static response, scaled */
static bool amplitude_of(gate *g, const fw_multibody_model *m, const fw_effects_loads *loads,
                         double *amplitude) {
    double force[15], displacement[15], rotation[6];
    bool valid;
    fw_effects_loads_largest_force(&g->r.m, loads, g->r.scene.duration_s, force);
    if (!must(fw_effects_static_response(g->arena, &g->r.m, loads, force, displacement, rotation,
                                         &valid)))
        return false;
    *amplitude = 0;
    for (int i = 0; i < 15; i++)
        *amplitude =
            fmax(*amplitude, 2 * fabs(displacement[i]) / (i % 3 == 2 ? 1 : m->scale.length_m));
    return valid && *amplitude < 1;
}

/* all that a motion needs but its steps */
static bool prepare_core(gate *g) {
    g->r = rig_six_bar(g->arena, false);
    fw_diags *diags = fw_arena_one(g->arena, fw_diags);
    const fw_effect_choice choice = {0};
    fw_effect_ledger ledger;
    fw_effects_loads *loads = fw_arena_one(g->arena, fw_effects_loads);
    const fw_multibody_model *m = NULL;
    fw_multibody_system *system = NULL;
    double q[15], amplitude, *atol;
    *diags = fw_diags_new(g->arena);
    for (int b = 0; b < 5; b++) {
        q[3 * b] = g->r.m.body[b].x_m;
        q[3 * b + 1] = g->r.m.body[b].y_m;
        q[3 * b + 2] = g->r.m.body[b].phi_rad;
    }
    if (!must(fw_effects_compile(g->arena, &g->r.m, &g->r.scene, &choice, 1e-3, diags, &ledger,
                                 loads)) ||
        !must(
            fw_multibody_model_new(g->arena, &g->r.m, loads, q, g->r.scene.duration_s, NULL, &m)) ||
        !must(fw_multibody_system_new(g->arena, m, &g->r.m, diags, &system)) || !system->kernel ||
        !amplitude_of(g, m, loads, &amplitude))
        return false;
    system->projecting = true;
    const fw_maths_ode ode = {.context = system,
                              .rhs = fw_multibody_rhs,
                              .lean = fw_multibody_rhs_motion,
                              .project = fw_multibody_project,
                              .n = m->ny,
                              .controlled = 2 * m->nq,
                              .positions = m->nq};
    g->ny = m->ny;
    g->y = fw_arena_array(g->arena, double, (size_t)m->ny);
    atol = fw_arena_array(g->arena, double, (size_t)m->ny);
    for (int i = 0; i < m->ny; i++)
        atol[i] = public_rtol * amplitude;
    g->used = g->r.scene.duration_s / m->scale.time_s;
    return must(
        fw_maths_stepper_new(g->arena, &fw_maths_dop853_row, &ode, public_rtol, atol, &g->stepper));
}

static bool run_core(gate *g) {
    fw_maths_stepper_start(g->stepper, 0, g->y, g->used);
    while (g->stepper->t < g->used)
        if (fw_maths_stepper_step(g->stepper) != FW_ODE_STEP) return false;
    return g->stepper->steps == 130; /* as many as the public call makes */
}

static bool prepare_public(gate *g, int rows, int figures) {
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_SOURCE_DATA_DIR;
    o.rtol = public_rtol;
    o.samples = rows;
    o.figures = figures;
    g->design = fw_design_new(&o);
    return g->design &&
           fw_design_set(g->design, "scene[step]/@duration", "10 ms") == FW_STATUS_OK &&
           fw_design_read(g->design, benchmark_file) == FW_STATUS_OK;
}

static bool prepare_bare(gate *g) {
    return prepare_public(g, 2, 0);
}

static bool prepare_rows(gate *g) {
    return prepare_public(g, 1001, 0);
}

static bool prepare_figures(gate *g) {
    return prepare_public(g, 1001, 1);
}

static bool run_public(gate *g) {
    return fw_design_simulate(g->design) == FW_STATUS_OK && g->design->motion->stats.steps == 130;
}

static bool prepare_table(gate *g) {
    return prepare_rows(g) && run_public(g);
}

static bool run_table(gate *g) {
    const char *text;
    size_t length;
    return fw_design_document(g->design, FW_DOCUMENT_MOTION_CSV, &text, &length) == FW_STATUS_OK &&
           length > 100000;
}

/* ---- hinges and workspace ---- */

static bool prepare_hinge(gate *g) {
    const double angle = 1.5 * pi;
    g->hinge = (fw_flexure_input){.kind = FW_FLEXURE_CSFH,
                                  .length_m = 100e-6 * angle,
                                  .angle_rad = angle,
                                  .radius_m = 100e-6,
                                  .width_m = 8e-6,
                                  .fillet_m = 4e-6,
                                  .depth_m = 50e-6,
                                  .youngs_Pa = 169e9,
                                  .poisson = 0.22,
                                  .strength_Pa = 500e6,
                                  .safety_factor = 1};
    return true;
}

static bool run_closed_form(gate *g) {
    for (int i = 0; i < 1000; i++) {
        fw_flexure_result out;
        g->hinge.width_m = 8e-6 + 1e-9 * (i & 63);
        fw_flexure_closed_form(&g->hinge, &out);
        g->used += out.stiffness_Nm_per_rad + out.strain_per_rad;
    }
    return isfinite(g->used) != 0;
}

static bool prepare_elastica(gate *g) {
    static fw_flexure_result closed;
    static fw_flexure_beam_piece piece;
    static fw_flexure_beam beam;
    prepare_hinge(g);
    fw_flexure_closed_form(&g->hinge, &closed);
    fw_flexure_beam_of_flexure(&g->hinge, &closed, &piece, &beam);
    return must(fw_flexure_elastica_new(g->arena, &beam, NULL, false, &g->beam));
}

/* a loop of rotations up to 10 degrees under 0.1 mN, each from the one before */
static bool run_elastica(gate *g) {
    bool good = true;
    for (int i = 0; i < 25; i++) {
        const double a = 0.08 * pi * i;
        const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                               {0.17 * sin(a), 1e-4 * cos(a), 1e-4 * sin(a)}};
        fw_flexure_elastica_result at;
        fw_flexure_elastica_solve(g->beam, &task, 1e-8, i > 0, &at);
        good = good && at.code == FW_ELASTICA_OK;
        g->used += at.wrench[0];
    }
    return good;
}

static bool prepare_workspace(gate *g) {
    six_bar_make(&g->fixture, six_bar_reference);
    return fw_workspace_loop_set_up(&g->fixture.mechanism, &g->loop);
}

static bool run_workspace(gate *g) {
    double limit[FW_SIX];
    fw_workspace_measure out;
    for (int h = 0; h < FW_SIX; h++)
        limit[h] = 10 * pi / 180;
    const fw_workspace_reach_limits limits = fw_workspace_limits_symmetric(limit);
    return must(fw_workspace_reach_volume(g->arena, &g->loop, &limits,
                                          (fw_workspace_proof_effort){1e-2, 5000000}, &out));
}

/* ---- the gallery's six-bar ---- */

static bool read_file(gate *g) {
    FILE *file = fopen(six_bar_file, "rb");
    g->xml = fw_arena_array(g->arena, char, 1u << 20);
    if (!file || !g->xml) return false;
    g->length = fread(g->xml, 1, (1u << 20) - 1, file);
    fclose(file);
    return g->length > 0;
}

static bool new_plan(gate *g, fw_verdict_corners corners) {
    fw_plan_options options = fw_plan_options_default();
    options.verdict.corners = corners;
    g->plan = fw_plan_new(&options);
    return g->plan && read_file(g);
}

static bool run_read(gate *g) {
    return must(fw_plan_load_memory(g->plan, "device.xml", g->xml, g->length));
}

static bool prepare_read(gate *g) {
    return new_plan(g, FW_CORNERS_NONE);
}

static bool prepare_drawn(gate *g) {
    return new_plan(g, FW_CORNERS_NONE) && run_read(g);
}

static bool prepare_made(gate *g) {
    return new_plan(g, FW_CORNERS_AUTO) && run_read(g);
}

static bool run_judge(gate *g) {
    return must(fw_plan_judge(g->plan)) && g->plan->verdict.decision == FW_ACCEPT;
}

static bool prepare_masks(gate *g) {
    return prepare_drawn(g) && run_judge(g);
}

static bool run_masks(gate *g) {
    if (!must(fw_plan_fabricate(g->plan))) return false;
    for (int i = 0; i < g->plan->nflow; i++)
        if (!g->plan->flow[i].mask) return false;
    return true;
}

static bool prepare_recipes(gate *g) {
    return prepare_masks(g) && run_masks(g);
}

static bool run_recipes(gate *g) {
    fw_text out = fw_text_new(g->plan->arena);
    return must(fw_plan_recipes_json(g->plan, &out)) && must(fw_text_end(&out));
}

/* ---- */

typedef struct gate_case {
    const char *name;
    bool (*prepare)(gate *g), (*run)(gate *g);
} gate_case;

static const gate_case cases[] = {
    {"right-hand side of the six-bar, 1000 times", prepare_rhs, run_rhs},
    {"six-bar, 10 ms at rtol 1e-8", prepare_six_bar, run_motion},
    {"Andrews' squeezer, 30 ms at rtol 1e-8", prepare_squeezer, run_motion},
    {"100 four-bar windows, 1 s at rtol 1e-8", prepare_windows, run_motion},
    {"six-bar, 10 ms at rtol 3e-9: steps alone", prepare_core, run_core},
    {"six-bar, 10 ms at rtol 3e-9: fw_design_simulate", prepare_bare, run_public},
    {"six-bar, 10 ms at rtol 3e-9: fw_design_simulate, 1001 rows", prepare_rows, run_public},
    {"six-bar, 10 ms at rtol 3e-9: fw_design_simulate, 1001 rows and figures", prepare_figures,
     run_public},
    {"table of 1001 rows of the six-bar", prepare_table, run_table},
    {"hinge in closed form, 1000 times", prepare_hinge, run_closed_form},
    {"hinge as an exact beam, a loop of 25 loads", prepare_elastica, run_elastica},
    {"workspace to 1 %, proved", prepare_workspace, run_workspace},
    {"device file read with its packs", prepare_read, run_read},
    {"verdict of the device as drawn", prepare_drawn, run_judge},
    {"verdict of the device as made", prepare_made, run_judge},
    {"masks and rules of two flows", prepare_masks, run_masks},
    {"recipes of two flows", prepare_recipes, run_recipes},
};

bool measured(const gate_case *c, gate *g);
__attribute__((noinline)) bool measured(const gate_case *c, gate *g) {
    return c->run(g);
}

static bool wanted(int argc, char **argv, const char *name) {
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], name) == 0) return true;
    return argc < 2;
}

int main(int argc, char **argv) {
    bool all = true;
#if defined(__x86_64__)
    printf("sees%s%s%s%s\n", __builtin_cpu_supports("avx") ? " avx" : "",
           __builtin_cpu_supports("avx2") ? " avx2" : "",
           __builtin_cpu_supports("fma") ? " fma" : "",
           __builtin_cpu_supports("avx512f") ? " avx512f" : "");
#else
    printf("sees nothing\n");
#endif
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!wanted(argc, argv, cases[i].name)) continue;
        gate g = {.arena = fw_arena_new(0)};
        bool good = g.arena && cases[i].prepare(&g) && measured(&cases[i], &g);
        printf("case %s: %d\n", cases[i].name, good);
        all = all && good;
        fw_plan_free(g.plan);
        fw_design_free(g.design);
        fw_arena_free(g.arena);
    }
    return all ? 0 : 1;
}
