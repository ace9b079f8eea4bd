/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses for dragging. The mechanism that was posed last stays until another text comes: laying it out takes
   longer than all the rest. */
#include "assembly/assembly.h"
#include "base/json.h"
#include "base/text.h"
#include "plan/design.h"
#include "plan/live.h"
#include "plan/stages.h"
#include "report/report.h"
#include "workspace/workspace.h"
#include <math.h>
#include <string.h>

/* ---- inverse kinematics ----
   Of a six-bar in closed form, of anything else by closing its joints about a body that hardly gives way. */

static void rest_of(const fw_mechanism *m, double *q) {
    for (int b = 0; b < m->nbody; b++) {
        q[3 * b] = m->body[b].x_m;
        q[3 * b + 1] = m->body[b].y_m;
        q[3 * b + 2] = m->body[b].phi_rad;
    }
}

/* size of the mechanism at rest: larger extent of its pins and centres of mass, m */
static double size_of(const fw_mechanism *m) {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int i = -m->nbody; i < m->npin; i++) {
        fw_geometry_vec2 p =
            i < 0 ? (fw_geometry_vec2){m->body[i + m->nbody].x_m, m->body[i + m->nbody].y_m}
                  : fw_mechanism_pin_place(m, &m->pin[i], 0);
        low[0] = fmin(low[0], p.x), high[0] = fmax(high[0], p.x);
        low[1] = fmin(low[1], p.y), high[1] = fmax(high[1], p.y);
    }
    double size = fmax(high[0] - low[0], high[1] - low[1]);
    return size > 0 && isfinite(size) ? size : 1e-3;
}

int fw_plan_pose_body(const fw_mechanism *m) {
    int heaviest = FW_NONE;
    for (int b = 0; b < m->nbody; b++) {
        if (m->device->body[b].platform) return b;
        if (heaviest == FW_NONE || m->body[b].mass_kg > m->body[heaviest].mass_kg) heaviest = b;
    }
    return heaviest;
}

static void angles_of(const fw_mechanism *m, const double *q, double *angle) {
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        angle[i] = (p->body_b == FW_GROUND ? 0.0 : q[3 * p->body_b + 2]) -
                   (p->body_a == FW_GROUND ? 0.0 : q[3 * p->body_a + 2]) - p->free_angle_rad;
    }
}

/* ---- six-bar ---- */

/* puts body b of a pin where the pin's angle and body a say, or body a likewise */
static void place(const fw_mechanism_pin *p, double angle, bool put_b, double *q) {
    int from = put_b ? p->body_a : p->body_b, to = put_b ? p->body_b : p->body_a;
    double fx = put_b ? p->ax_m : p->bx_m, fy = put_b ? p->ay_m : p->by_m;
    double tx = put_b ? p->bx_m : p->ax_m, ty = put_b ? p->by_m : p->ay_m;
    double turn = put_b ? angle + p->free_angle_rad : -angle - p->free_angle_rad;
    double x = fx, y = fy, phi = turn;
    if (from != FW_GROUND) {
        double c = cos(q[3 * from + 2]), s = sin(q[3 * from + 2]);
        x = q[3 * from] + c * fx - s * fy;
        y = q[3 * from + 1] + s * fx + c * fy;
        phi += q[3 * from + 2];
    }
    q[3 * to] = x - cos(phi) * tx + sin(phi) * ty;
    q[3 * to + 1] = y - sin(phi) * tx - cos(phi) * ty;
    q[3 * to + 2] = phi;
}

/* bodies from the angles of all pins, outward from the ground */
static void place_all(const fw_mechanism *m, const double *angle, bool *stands, double *q) {
    memset(stands, 0, (size_t)m->nbody * sizeof *stands);
    for (bool more = true; more;) {
        more = false;
        for (int i = 0; i < m->npin; i++) {
            const fw_mechanism_pin *p = &m->pin[i];
            bool a = p->body_a == FW_GROUND || stands[p->body_a];
            bool b = p->body_b == FW_GROUND || stands[p->body_b];
            if (a == b) continue;
            place(p, angle[i], a, q);
            stands[a ? p->body_b : p->body_a] = true;
            more = true;
        }
    }
}

/* Asked pose, or where that is out of reach the last reachable one on the straight way to it from
   rest: the first failure among 64 equal parts, then halving to 1e-12 of the way.
   in: displacement (m, m, rad); out: six angles, q; exact up to rounding, cost below 200 inverse
   solutions of 1 us each. Test: test_live_pose.c (forward kinematics, joints closed, random
   poses). */
static fw_status six_bar(fw_arena *arena, const fw_mechanism *m, const double asked[3],
                         fw_plan_posed *out) {
    enum { PARTS = 64, HALVINGS = 34 };
    double angle[FW_SIX], share = 1.0;
    int leg = 0, blamed = 0;
    bool *stands = fw_arena_array(arena, bool, (size_t)m->nbody);
    FW_NEED(stands);
    out->reachable = fw_workspace_six_bar_inverse(m, asked[0], asked[1], asked[2], angle, &blamed);
    if (!out->reachable) {
        double low = 0.0, high = 1.0;
        for (int i = 1; i <= PARTS; i++) {
            double s = (double)i / PARTS;
            high = s;
            if (!fw_workspace_six_bar_inverse(m, s * asked[0], s * asked[1], s * asked[2], angle,
                                              &leg))
                break;
            low = s;
        }
        for (int i = 0; i < HALVINGS; i++) {
            double s = 0.5 * (low + high);
            if (fw_workspace_six_bar_inverse(m, s * asked[0], s * asked[1], s * asked[2], angle,
                                             &leg))
                low = s;
            else
                high = s, blamed = leg;
        }
        share = low;
        if (!fw_workspace_six_bar_inverse(m, share * asked[0], share * asked[1], share * asked[2],
                                          angle, &leg))
            return FW_SOLVER;
        out->reason = fw_arena_printf(arena, "leg %s-%s-%s is stretched or folded there",
                                      m->pin[blamed ? 5 : 0].id, m->pin[blamed ? 4 : 1].id,
                                      m->pin[blamed ? 3 : 2].id);
        FW_NEED(out->reason);
    }
    memcpy(out->angle_rad, angle, sizeof angle);
    place_all(m, angle, stands, out->q);
    for (int k = 0; k < 3; k++)
        out->at[k] = share * asked[k];
    out->closed_form = true;
    out->share = share;
    return FW_OK;
}

/* ---- anything else ---- */

static const double heavy = 1e6;

/* bodies that weigh alike but the one that is held, which may turn where its angle is not asked
   for; drivers let go */
static fw_status held(fw_arena *arena, const fw_mechanism *from, int body, bool turns, double size,
                      fw_mechanism *to) {
    *to = *from;
    to->ndriver = 0;
    FW_NEED(to->body = fw_arena_array(arena, fw_mechanism_mass, (size_t)from->nbody));
    for (int b = 0; b < from->nbody; b++) {
        to->body[b] = from->body[b];
        to->body[b].mass_kg = b == body ? heavy : 1.0;
        to->body[b].inertia_kg_m2 = (turns ? 1.0 : to->body[b].mass_kg) * size * size / 12.0;
    }
    return FW_OK;
}

static double apart(const double *a, const double *b, bool turns, double size) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]) / size, turns ? 0.0 : a[2] - b[2]);
}

/* closes all joints with `body` at `target`, or as near to it as they allow; q is start and result.
   The closed pose nearest in the mass metric leaves a heavy body behind its place by about
   1/heavy of what the others have to move: aimed so much farther, it stands there. */
static fw_status close_at(fw_arena *arena, const fw_mechanism *m, int body, const double target[3],
                          bool turns, double size, double *q) {
    double aim[3] = {target[0], target[1], target[2]}, moved;
    if (turns) aim[2] = q[3 * body + 2];
    for (int round = 0; round < 4; round++) {
        fw_mark mark = fw_arena_mark(arena);
        fw_diags quiet = fw_diags_new(arena);
        memcpy(q + (size_t)3 * (size_t)body, aim, sizeof aim);
        fw_status status = fw_assembly_assemble(arena, m, q, &moved, &quiet);
        fw_arena_rewind(arena, mark);
        FW_TRY(status);
        double off = apart(q + (size_t)3 * (size_t)body, target, turns, size);
        if (off < 1e-13 || off > 1e-3) break; /* there, or as near as it goes */
        for (int k = 0; k < 2 + !turns; k++)
            aim[k] += target[k] - q[3 * body + k];
    }
    return FW_OK;
}

/* In steps of a twentieth of the mechanism or a tenth of a radian, so that it stays on its branch.
   in: displacement of `body` from rest (m, m, rad), start (3 nbody) or NULL; out: q with joints
   closed to round-off, at[] as asked to 1e-7 of the size (what the search for the nearest pose
   leaves) or `reachable` false: then the pose nearest in the mass metric. Cost: some 50 us per step
   and body. Source: docs/theory/assembly.md. Test: test_live_pose.c (against the closed form of the
   six-bar, four-bar against its coupler curve). */
static fw_status closing(fw_arena *arena, const fw_mechanism *m, int body, const double asked[3],
                         const double *from, fw_plan_posed *out) {
    enum { STEPS_MOST = 40 };
    fw_mechanism free_mechanism;
    double size = size_of(m), *rest, target[3], start[3];
    size_t n = 3 * (size_t)m->nbody;
    FW_NEED(rest = fw_arena_array(arena, double, n));
    rest_of(m, rest);
    memcpy(out->q, from ? from : rest, n * sizeof *rest);
    bool turns = isnan(asked[2]);
    FW_TRY(held(arena, m, body, turns, size, &free_mechanism));
    const double *at_rest = rest + (size_t)3 * (size_t)body,
                 *now = out->q + (size_t)3 * (size_t)body;
    double way[3], far = 0.0;
    for (int k = 0; k < 3; k++) {
        double most = k < 2 ? 20.0 * size : 100.0; /* beyond, it is out of reach all the same */
        start[k] = now[k];
        way[k] = at_rest[k] + fmax(-most, fmin(most, asked[k])) - start[k];
        if (k == 2 && turns) way[k] = 0.0;
    }
    far = fmax(hypot(way[0], way[1]) / (0.05 * size), fabs(way[2]) / 0.1);
    int steps = (int)fmin(STEPS_MOST, fmax(1.0, ceil(far)));
    for (int i = 1; i <= steps; i++) {
        for (int k = 0; k < 3; k++)
            target[k] = start[k] + way[k] * i / steps;
        FW_TRY(close_at(arena, &free_mechanism, body, target, turns, size, out->q));
    }
    angles_of(m, out->q, out->angle_rad);
    for (int k = 0; k < 3; k++)
        out->at[k] = now[k] - at_rest[k];
    out->reachable = apart(out->at, asked, turns, size) < 1e-7;
    out->share = (double)NAN;
    if (!out->reachable)
        out->reason =
            "the joints do not let the body go there; shown is the nearest pose that they "
            "allow";
    return FW_OK;
}

fw_status fw_plan_pose_solve(fw_arena *arena, const fw_mechanism *m, int body,
                             const double asked[3], const double *from, fw_plan_posed *out) {
    *out = (fw_plan_posed){0};
    FW_NEED(out->q = fw_arena_array(arena, double, 3 * (size_t)m->nbody));
    FW_NEED(out->angle_rad = fw_arena_array(arena, double, (size_t)m->npin));
    if (body < 0 || body >= m->nbody) return FW_USAGE;
    /* further joints would take freedom from the platform */
    bool plain = m->device->six_bar && m->npin == FW_SIX && m->njoint == 0 && m->nbody == 5;
    const double upright[3] = {asked[0], asked[1], isnan(asked[2]) ? 0.0 : asked[2]};
    if (plain && body == 2) return six_bar(arena, m, upright, out);
    return closing(arena, m, body, asked, from, out);
}

/* ---- the mechanisms of a text ---- */

typedef struct fw_plan_live_posed {
    fw_design *design; /* its arena holds this struct and the mechanisms */
    char key[65];      /* of text, sets and options */
    fw_status status;  /* of reading and building: FW_OK, or the description is no good */
    const fw_mechanism **mechanism; /* (nflow) closed */
} fw_plan_live_posed;

void fw_plan_live_posed_free(fw_plan_live_posed *posed) {
    if (posed) fw_design_free(posed->design);
}

static fw_status build(fw_design *d, void *argument) {
    fw_plan_live_posed *posed = argument;
    fw_plan *plan = fw_plan_design_plan(d);
    const fw_mechanism *first;
    size_t n = (size_t)plan->nflow;
    FW_NEED(posed->mechanism = fw_arena_alloc(plan->arena, n, sizeof *posed->mechanism));
    FW_TRY(fw_plan_mechanism(plan, NULL, &first)); /* with its drawing */
    for (size_t i = 0; i < n; i++) {
        fw_diags again = fw_diags_new(plan->arena);
        fw_diags *diags = i == 0 ? &plan->diags : &again;
        const fw_mechanism *m;
        FW_TRY(fw_mechanism_build(plan->arena, plan->device, plan->layout, &plan->flow[i].variant,
                                  &again, &m));
        FW_TRY(fw_assembly_assembled(plan->arena, m, diags, &posed->mechanism[i], NULL));
    }
    return FW_OK;
}

/* a value as it was read; the same values give the same text */
static void copied(fw_json *json, const char *key, const json_t *value) {
    const char *name;
    const json_t *item;
    size_t i;
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        fw_json_object(json, key);
        json_object_foreach((json_t *)value, name, item) copied(json, name, item);
        fw_json_end(json);
        break;
    case JSON_ARRAY:
        fw_json_list(json, key);
        json_array_foreach(value, i, item) copied(json, NULL, item);
        fw_json_end(json);
        break;
    case JSON_STRING:
        fw_json_text(json, key, json_string_value(value));
        break;
    case JSON_INTEGER:
        fw_json_whole(json, key, json_integer_value(value));
        break;
    case JSON_REAL:
        fw_json_real(json, key, json_real_value(value));
        break;
    case JSON_TRUE:
    case JSON_FALSE:
        fw_json_truth(json, key, json_is_true(value));
        break;
    case JSON_NULL:
        fw_json_null(json, key);
        break;
    }
}

static fw_status key_of(fw_plan_live_request *r, char key[65]) {
    fw_text all = fw_text_new(r->arena);
    fw_text_bytes(&all, r->text, r->length);
    fw_text_add(&all, "\n");
    fw_json json = fw_json_new(&all, FW_JSON_COMPACT);
    fw_json_list(&json, NULL);
    if (r->set) copied(&json, NULL, r->set);
    fw_json_null(&json, NULL);
    if (r->options) copied(&json, NULL, r->options);
    fw_json_null(&json, NULL);
    if (r->lab) copied(&json, NULL, r->lab);
    fw_json_end(&json);
    fw_status status = fw_json_finish(&json, "");
    if (status == FW_INTERNAL) return fw_plan_live_wrong(r, "nested too deeply:", "set or options");
    FW_TRY(status);
    fw_sha256(all.data, all.length, key);
    return FW_OK;
}

/* live->posed holds the mechanisms of this request */
static fw_status prepare(fw_plan_live *live, fw_plan_live_request *r) {
    char key[65];
    FW_TRY(key_of(r, key));
    if (live->posed && strcmp(live->posed->key, key) == 0) return FW_OK;
    fw_plan_live_posed_free(live->posed);
    live->posed = NULL;
    fw_design *design;
    FW_TRY(fw_plan_live_design(live, r, &design));
    fw_plan_live_posed *posed =
        fw_arena_one(fw_plan_design_plan(design)->arena, fw_plan_live_posed);
    if (!posed) {
        fw_design_free(design);
        return FW_NOMEM;
    }
    posed->design = design;
    live->posed = posed;
    int status = fw_design_read_memory(posed->design, "device.xml", r->text, r->length);
    if (status == FW_STATUS_OK) status = fw_plan_design_run(posed->design, build, posed);
    if (status == FW_STATUS_USAGE)
        return fw_plan_live_wrong(r, design->wrong_option ? design->wrong_option : "wrong usage",
                                  NULL);
    if (status == FW_STATUS_NOMEM || status == FW_STATUS_CANCELLED) return (fw_status)status;
    posed->status = (fw_status)status;
    memcpy(posed->key, key, sizeof key); /* only now is it whole */
    return FW_OK;
}

/* ---- the request ---- */

static fw_status asked_of(fw_plan_live_request *r, double asked[3]) {
    static const char *const name[] = {"x_m", "y_m", "phi_rad"};
    const json_t *platform = json_object_get(r->root, "platform");
    if (!json_is_object(platform))
        return fw_plan_live_wrong(r, "an object is needed for", "platform");
    for (int k = 0; k < 3; k++) {
        asked[k] = k < 2 ? 0.0 : (double)NAN; /* any angle */
        FW_TRY(fw_plan_live_real(r, platform, name[k], &asked[k]));
        if (fabs(asked[k]) > 1e6)
            return fw_plan_live_wrong(r, "a pose may be at most 1e6 m or rad away:", name[k]);
    }
    return FW_OK;
}

/* the poses to start from, as the last answer gave them; NULL: none */
static fw_status start_of(fw_plan_live_request *r, const fw_mechanism *m, const double **from) {
    const json_t *list = json_object_get(r->root, "q");
    *from = NULL;
    if (!list || json_is_null(list)) return FW_OK;
    size_t n = 3 * (size_t)m->nbody;
    if (!json_is_array(list) || json_array_size(list) != n) return FW_OK; /* of another mechanism */
    double *q = fw_arena_array(r->arena, double, n);
    FW_NEED(q);
    for (size_t i = 0; i < n; i++) {
        const json_t *v = json_array_get(list, i);
        if (!json_is_number(v)) return fw_plan_live_wrong(r, "numbers are needed in", "q");
        q[i] = json_number_value(v);
        if (!(fabs(q[i]) <= 1e6)) return FW_OK;
    }
    *from = q;
    return FW_OK;
}

static fw_status body_of(fw_plan_live_request *r, const fw_mechanism *m, int *body) {
    const char *name = NULL;
    FW_TRY(fw_plan_live_string(r, r->root, "body", &name));
    *body = fw_plan_pose_body(m);
    if (!name && *body == FW_NONE)
        return fw_plan_live_wrong(r, "the device has no body to move", NULL);
    for (int b = 0; name && b < m->nbody; b++)
        if (strcmp(m->body[b].id, name) == 0) {
            *body = b;
            return FW_OK;
        }
    return name ? fw_plan_live_wrong(r, "the device has no body", name) : FW_OK;
}

/* the flow whose mechanism is moved: the one that is named, else the first */
static fw_status flow_of(fw_plan_live_request *r, const fw_plan *plan, int *flow) {
    const char *name = NULL;
    FW_TRY(fw_plan_live_string(r, r->root, "flow", &name));
    *flow = 0;
    for (int i = 0; name && i < plan->nflow; i++)
        if (plan->flow[i].variant.flow && strcmp(plan->flow[i].variant.flow, name) == 0) {
            *flow = i;
            return FW_OK;
        }
    return name ? fw_plan_live_wrong(r, "the device has no flow", name) : FW_OK;
}

/* ---- the answer ---- */

static void triple(fw_json *out, const char *key, const double at[3]) {
    static const char *const name[] = {"x_m", "y_m", "phi_rad"};
    fw_json_line(out, 0);
    fw_json_object(out, key);
    for (int k = 0; k < 3; k++)
        fw_json_number(out, name[k], at[k], 12);
    fw_json_end(out);
}

static void numbers(fw_json *out, const char *key, const double *value, int n) {
    fw_json_line(out, 0);
    fw_json_list(out, key);
    for (int k = 0; k < n; k++)
        fw_json_number(out, NULL, value[k], 15);
    fw_json_end(out);
}

static double limit_of(const fw_mechanism *m, int pin) {
    int h = m->pin[pin].hinge;
    double limit = h == FW_NONE ? (double)NAN : m->hinge[h].closed_form.limit_angle_rad;
    return limit > 0.0 ? limit : (double)NAN;
}

/* every hinge against its limit in this flow, and which is nearest to it */
static void flow_json(fw_json *out, const fw_mechanism *m, const double *angle) {
    int governing = FW_NONE;
    double most = -1.0;
    fw_json_object(out, NULL);
    fw_json_text(out, "name", m->variant->flow);
    fw_json_list(out, "hinges");
    for (int i = 0; i < m->npin; i++) {
        double limit = limit_of(m, i), used = fabs(angle[i]) / limit;
        if (isnan(limit)) continue;
        if (used > most) most = used, governing = i;
        fw_json_object(out, NULL);
        fw_json_text(out, "id", m->pin[i].id);
        fw_json_whole(out, "pin", i);
        fw_json_number(out, "angle_rad", angle[i], 12);
        fw_json_number(out, "limit_rad", limit, 9);
        fw_json_number(out, "utilisation", used, 9);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_text(out, "governing", governing == FW_NONE ? NULL : m->pin[governing].id);
    fw_json_number(out, "utilisation", governing == FW_NONE ? (double)NAN : most, 9);
    if (governing == FW_NONE)
        fw_json_null(out, "within_limits");
    else
        fw_json_truth(out, "within_limits", most <= 1.0);
    fw_json_end(out);
}

static void answer(fw_json *out, const fw_plan_live_posed *posed, int flow, int body,
                   const double asked[3], const fw_plan_posed *p) {
    const fw_plan *plan = fw_plan_design_plan(posed->design);
    const fw_mechanism *m = posed->mechanism[flow];
    fw_json_line(out, 0);
    fw_json_text(out, "body", m->body[body].id);
    fw_json_text(out, "how", p->closed_form ? "closed form" : "assembly");
    fw_json_truth(out, "reachable", p->reachable);
    fw_json_text(out, "reason", p->reason);
    triple(out, "asked", asked);
    triple(out, "at", p->at);
    fw_json_line(out, 0);
    fw_json_number(out, "share", p->share, 12);
    numbers(out, "q", p->q, 3 * m->nbody);
    numbers(out, "angle_rad", p->angle_rad, m->npin);
    fw_json_line(out, 0);
    fw_json_text(out, "flow", m->variant->flow);
    fw_json_list(out, "flows");
    for (int i = 0; i < plan->nflow; i++) {
        fw_json_line(out, 0);
        flow_json(out, posed->mechanism[i], p->angle_rad);
    }
    fw_json_end(out);
}

static fw_status pose(fw_plan_live *live, fw_plan_live_request *r, fw_text *text) {
    double asked[3];
    FW_TRY(asked_of(r, asked));
    FW_TRY(prepare(live, r));
    fw_plan_live_posed *posed = live->posed;
    const fw_plan *plan = fw_plan_design_plan(posed->design);
    fw_plan_posed p = {.reachable = false};
    const double *from = NULL;
    int flow = 0, body = FW_NONE;
    fw_status status = posed->status;
    if (status == FW_OK) {
        FW_TRY(flow_of(r, plan, &flow));
        FW_TRY(body_of(r, posed->mechanism[flow], &body));
        FW_TRY(start_of(r, posed->mechanism[flow], &from));
        status = fw_plan_pose_solve(r->arena, posed->mechanism[flow], body, asked, from, &p);
        if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    }
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    fw_json_text(out, "schema", "flexwright.pose/1");
    fw_json_text(out, "status",
                 status == FW_OK          ? "ok"
                 : posed->status == FW_OK ? "failed"
                                          : "invalid");
    fw_json_line(out, 0);
    fw_report_preview_diagnostics(&plan->diags, "device.xml", out);
    if (status == FW_OK) answer(out, posed, flow, body, asked, &p);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

fw_plan_live_answer fw_plan_live_pose(fw_plan_live *live, const char *request, size_t n) {
    static const char *const keys[] = {"text", "set",      "options", "lab", "flow",
                                       "body", "platform", "q",       NULL};
    return fw_plan_live_call(live, request, n, keys, pose);
}
