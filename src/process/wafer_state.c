/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A step takes a wafer from one state to the next:
     wet       what the step's liquid leaves, then what its <finish>es make of it, in their order; a step without either
               leaves it as it came
     unbaked   from a coat to the next bake             coated   from that bake to the exposure
     image     from the exposure to the developer       hot      after a bake without <finish kind="cool">
     vacuum    after a tool that is pumped, without <finish kind="vent">
     seasoned  from what prepares a pumped chamber (op="mount") to the first step in it
   A resist that is taken off ends its states. Cost: steps times states. Test: test_wafer_state.c.
   And from which step on, until which, what a coupon reads is on the wafer. */
#include "base/text.h"
#include "process/coupon.h"
#include "process/films.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

static const char WATER[] = "water"; /* in the place of a chemical's id */

static const struct {
    const char *key;
    double longest_s, most_s;
    const char *is, *why;
} rows[] = {
#define X(name, key, longest, most, is, why) [FW_STATE_##name] = {key, longest, most, is, why},
#include "process/wafer_states.def"
#undef X
};

const char *fw_process_state_why(fw_process_state state) {
    return rows[state].why;
}

const char *fw_process_state_is(fw_process_state state) {
    return rows[state].is;
}

double fw_process_state_most_s(fw_process_state state) {
    return rows[state].most_s;
}

const char *fw_process_state_key(fw_process_state state) {
    return rows[state].key;
}

bool fw_process_step_takes_wet(const fw_process_step *s) {
    if (s->equipment && s->equipment->vacuum) return false;
    for (int i = 0; i < s->nfinish; i++)
        if (s->finish[i].kind == FW_FINISH_RINSE || s->finish[i].kind == FW_FINISH_DRY) return true;
    return fw_process_step_in_liquid(s);
}

static void set(fw_process_wafer *w, fw_process_state state, int step, const char *with) {
    w->is[state] = true;
    w->since[state] = step;
    w->with[state] = with;
}

static void wet(const fw_process_step *s, int step, fw_process_wafer *w) {
    if (fw_process_step_in_liquid(s)) {
        w->liquid = fw_process_step_liquid(s);
        set(w, FW_STATE_WET, step, w->liquid ? w->liquid->id : "");
    }
    for (int i = 0; i < s->nfinish; i++) {
        const fw_process_finish *f = &s->finish[i];
        switch (f->kind) {
        case FW_FINISH_RINSE:
            w->liquid = f->with;
            set(w, FW_STATE_WET, step, f->with ? f->with->id : WATER);
            break;
        case FW_FINISH_DRY:
            w->is[FW_STATE_WET] = false;
            break;
        case FW_FINISH_COOL:
        case FW_FINISH_VENT:
            break;
        }
    }
}

/* ---- how devices that are free are dried ---- */

bool fw_process_drying_pulls(const char *by) {
    static const char *const pulls[] = {"spin", "nitrogen", "oven", "air", "vapour"};
    for (size_t i = 0; i < sizeof pulls / sizeof *pulls; i++)
        if (strcmp(pulls[i], by) == 0) return true;
    return false;
}

static bool pulls_more(const fw_quantity *a, const fw_quantity *b) {
    return !b || (a && a->value > b->value);
}

fw_process_drying fw_process_flow_drying(const fw_process_flow *flow) {
    fw_process_wafer w = {.released = false};
    fw_process_drying d = {.how = FW_DRIED_UNKNOWN};
    const fw_quantity *alcohol = fw_process_flow_quantity(flow, "isopropanol.tension"),
                      *angle = fw_process_flow_quantity(flow, "dry.angle");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        fw_process_wafer_pass(flow, i, &w);
        if (w.released && d.how == FW_DRIED_UNKNOWN) d.how = FW_DRIED_NEVER;
        for (int k = 0; k < s->nfinish && w.released; k++) {
            const fw_process_finish *f = &s->finish[k];
            if (f->kind != FW_FINISH_DRY) continue;
            bool pulls = fw_process_drying_pulls(f->by);
            const fw_quantity *tension = f->tension ? f->tension : pulls ? alcohol : NULL;
            if (!pulls && d.how != FW_DRIED_PULLED)
                d = (fw_process_drying){FW_DRIED_CALM, s, f, NULL, NULL};
            else if (pulls && (d.how != FW_DRIED_PULLED || pulls_more(tension, d.tension)))
                d = (fw_process_drying){FW_DRIED_PULLED, s, f, tension,
                                        f->angle ? f->angle : angle};
        }
    }
    return d;
}

/* does another step of the flow dry wafers before drops stand on them? by: how, NULL: none does */
static const fw_process_step *dries(const fw_process_flow *f, const char **by) {
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nfinish; k++) {
            const fw_process_finish *d = &f->step[i].finish[k];
            *by = d->by;
            if (d->kind == FW_FINISH_DRY && fw_words_hold("spin nitrogen vapour", " ", d->by))
                return &f->step[i];
        }
    return NULL;
}

/* Water that is left to dry in air leaves what it held where the last drop stood, and takes up what is in the air. Where the
   laboratory has nothing else that is how it is done; where another step of the flow dries wafers it is a slip. Decision 98. */
fw_status fw_process_lint_aired(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    const char *by;
    const fw_process_step *other = dries(f, &by);
    for (int i = 0; other && i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        const fw_process_finish *rinse = NULL;
        for (int k = 0; k < s->nfinish; k++) {
            const fw_process_finish *d = &s->finish[k];
            if (d->kind == FW_FINISH_RINSE) rinse = d;
            if (d->kind != FW_FINISH_DRY || !rinse || rinse->with || strcmp(d->by, "air") != 0)
                continue;
            fw_diag_warning(pack->diags, 618, d->place,
                            "step %s lets the water of its rinse dry in air: each drop leaves a "
                            "ring of what it held; dry it by=\"%s\", as step %s does",
                            s->id, by, other->id);
        }
    }
    return FW_OK;
}

static bool finished_by(const fw_process_step *s, fw_process_finish_kind kind) {
    for (int i = 0; i < s->nfinish; i++)
        if (s->finish[i].kind == kind) return true;
    return false;
}

/* a resist is what is spun on: its states go from one to the next, and end with it */
static void resist(const fw_process_step *s, int step, fw_process_wafer *w) {
    for (int i = 0; i < s->nchange; i++) {
        const fw_process_change *c = &s->change[i];
        if (fw_process_step_is_op(s, "coat") && strcmp(c->kind, "add") == 0) {
            set(w, FW_STATE_UNBAKED, step, c->material);
            w->is[FW_STATE_COATED] = false;
        }
        if (strcmp(c->kind, "pattern") == 0) {
            w->is[FW_STATE_COATED] = false;
            set(w, FW_STATE_IMAGE, step, c->material);
        }
        for (int r = FW_STATE_UNBAKED; r <= FW_STATE_IMAGE; r++)
            if (strcmp(c->kind, "remove") == 0 && w->is[r] && strcmp(w->with[r], c->material) == 0)
                w->is[r] = false;
    }
    if (fw_process_step_is_op(s, "bake") && w->is[FW_STATE_UNBAKED]) {
        w->is[FW_STATE_UNBAKED] = false;
        if (!w->is[FW_STATE_IMAGE]) set(w, FW_STATE_COATED, step, w->with[FW_STATE_UNBAKED]);
    }
    if (fw_process_step_is_op(s, "develop")) w->is[FW_STATE_IMAGE] = false;
}

static void tool(const fw_process_step *s, int step, fw_process_wafer *w) {
    const char *id = s->equipment ? s->equipment->id : "";
    bool pumped = s->equipment && s->equipment->vacuum;
    w->is[FW_STATE_HOT] = w->is[FW_STATE_VACUUM] = false;
    if (fw_process_step_is_op(s, "bake") && !finished_by(s, FW_FINISH_COOL))
        set(w, FW_STATE_HOT, step, id);
    if (w->is[FW_STATE_SEASONED] && strcmp(w->with[FW_STATE_SEASONED], id) == 0)
        w->is[FW_STATE_SEASONED] = false;
    if (pumped && fw_process_step_is_op(s, "mount"))
        set(w, FW_STATE_SEASONED, step, id);
    else if (pumped && !finished_by(s, FW_FINISH_VENT))
        set(w, FW_STATE_VACUUM, step, id);
}

static bool frees(const fw_process_step *s) {
    for (int i = 0; i < s->nchange; i++)
        if (fw_process_step_is_op(s, "release") && strcmp(s->change[i].kind, "remove") == 0)
            return true;
    return false;
}

void fw_process_wafer_pass(const fw_process_flow *flow, int step, fw_process_wafer *w) {
    const fw_process_step *s = &flow->step[step];
    w->released = w->released || frees(s);
    wet(s, step, w);
    resist(s, step, w);
    tool(s, step, w);
}

fw_status fw_process_flow_wafers(fw_arena *arena, const fw_process_flow *flow,
                                 fw_process_wafer **wafer) {
    fw_process_wafer now = {0};
    FW_NEED(*wafer = fw_arena_array(arena, fw_process_wafer, (size_t)flow->nstep));
    for (int i = 0; i < flow->nstep; i++) {
        fw_process_wafer_pass(flow, i, &now);
        (*wafer)[i] = now;
    }
    return FW_OK;
}

static const char *name_of(const fw_process_flow *flow, fw_process_state state, const char *id) {
    switch (state) {
    case FW_STATE_WET:
        if (strcmp(id, WATER) == 0) return "deionised water";
        for (int i = flow->nhazard - 1; i >= 0; i--)
            if (strcmp(flow->hazard[i].id, id) == 0) return flow->hazard[i].name;
        return "what it was treated with";
    case FW_STATE_UNBAKED:
    case FW_STATE_COATED:
    case FW_STATE_IMAGE:
        return fw_process_flow_material_name(flow, id);
    case FW_STATE_HOT:
    case FW_STATE_VACUUM:
    case FW_STATE_SEASONED:
        for (int i = flow->nequipment - 1; i >= 0; i--)
            if (strcmp(flow->equipment[i].id, id) == 0) return flow->equipment[i].class_;
        return id;
    case FW_STATES:
        break;
    }
    return id;
}

const char *fw_process_wafer_words(fw_arena *arena, const fw_process_flow *flow,
                                   const fw_process_wafer *w, fw_process_state state) {
    return fw_arena_printf(arena, "%s %s", rows[state].is, name_of(flow, state, w->with[state]));
}

/* the pack's own hold says it more strictly */
static bool held(const fw_process_flow *flow, int from, int to, double max_s) {
    for (int k = 0; k < flow->step[to].nlag; k++)
        if (strcmp(flow->step[to].lag[k].from, flow->step[from].id) == 0 &&
            flow->step[to].lag[k].max_s <= max_s)
            return true;
    return false;
}

static fw_status add_wait(fw_arena *arena, fw_process_flow *flow, const fw_process_wafer *w,
                          fw_process_state state, int from, int to) {
    const char *id = fw_arena_printf(arena, "%s.%s-longest", w->with[state], rows[state].key);
    FW_NEED(id);
    const fw_quantity *q = fw_process_flow_quantity(flow, id);
    if (q && q->unknown) q = NULL;
    double longest_s = q ? q->value : rows[state].longest_s;
    bool water = state == FW_STATE_WET && strcmp(w->with[state], WATER) == 0;
    if (held(flow, from, to, longest_s)) return FW_OK;
    fw_process_wait *grown = fw_arena_grow(arena, flow->wait, (size_t)flow->nwait,
                                           (size_t)flow->nwait + 1, sizeof *grown);
    const char *is = fw_process_wafer_words(arena, flow, w, state);
    FW_NEED(grown && is);
    flow->wait = grown;
    flow->wait[flow->nwait++] =
        (fw_process_wait){.from = from,
                          .to = to,
                          .max_s = longest_s,
                          .most_s = rows[state].most_s,
                          .q = q,
                          .first_only = state == FW_STATE_SEASONED,
                          .is = is,
                          .why = water ? "it dries to stains where it is left" : rows[state].why};
    return FW_OK;
}

fw_status fw_process_flow_waits(fw_arena *arena, fw_process_flow *flow) {
    fw_process_wafer *after;
    flow->wait = NULL;
    flow->nwait = 0;
    FW_TRY(fw_process_flow_wafers(arena, flow, &after));
    for (int i = 0; i + 1 < flow->nstep; i++)
        for (int state = 0; state < FW_STATES; state++) {
            int to = i + 1;
            if (!after[i].is[state] || after[i].since[state] != i) continue;
            /* to the step that ends it; what is wet, hot or pumped goes on at once */
            while (to < flow->nstep && after[to].is[state] && after[to].since[state] == i)
                to++;
            if (to < flow->nstep)
                FW_TRY(add_wait(arena, flow, &after[i], (fw_process_state)state, i, to));
        }
    return FW_OK;
}

/* ---- what carries the device, and what is below it ---- */

bool fw_process_flow_runs_below(const fw_process_flow *flow, const char *material) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (c->reach && strcmp(c->material, material) == 0) return true;
        }
    return false;
}

fw_status fw_process_flow_ground(fw_arena *arena, const fw_process_flow *flow,
                                 const fw_process_material **carries,
                                 const fw_process_material **faces) {
    fw_process_stack s;
    double thickest = -1;
    *carries = *faces = NULL;
    FW_TRY(fw_process_flow_stack(arena, flow, flow->nstep - 1, &s, NULL));
    for (int column = 0; flow->material && column < s.columns; column++) {
        const fw_process_cell *cell = s.cell[column];
        int at = 0;
        while (at < s.n[column] && strcmp(cell[at].material, flow->material) != 0)
            at++;
        if (at == 0 || at == s.n[column]) continue;
        bool free = false; /* above what cell[i - 1] is */
        for (int i = at; i > 0; i--) {
            const fw_process_cell *c = &cell[i - 1];
            const fw_process_material *m = fw_process_flow_material(flow, c->material);
            const double thick = isnan(c->thickness_m) ? 0 : c->thickness_m;
            if (thick > thickest) thickest = thick, *carries = m;
            const bool sideways = fw_process_flow_runs_below(flow, c->material),
                       gap = c->bottom + c->height < cell[i].bottom - 1e-9;
            if ((free || gap) && !sideways) {
                if (!*faces || (m && m->conducts != 0)) *faces = m;
                break;
            }
            free = free || sideways || gap;
        }
    }
    return FW_OK;
}

/* ---- at which step of the flow a coupon is read ---- */

static bool takes(const fw_process_change *c, const char *material) {
    return strcmp(c->kind, "remove") == 0 && strcmp(c->material, material) == 0;
}

/* the first step behind `after` that removes more of the material; NULL: none does */
static const fw_process_step *gone_by(const fw_process_flow *flow, const fw_process_step *after,
                                      const char *material) {
    for (const fw_process_step *s = after + 1; after && s < flow->step + flow->nstep; s++)
        for (int k = 0; k < s->nchange; k++)
            if (takes(&s->change[k], material)) return s;
    return NULL;
}

/* the last step that removes in the device's pattern: under a mask and sideways (etched), or where light has printed it */
static const fw_process_step *edge_made(const fw_process_flow *flow, bool etched,
                                        const char **material) {
    const fw_process_step *made = NULL;
    const fw_process_change *print = NULL;
    for (const fw_process_step *s = flow->step; s < flow->step + flow->nstep; s++)
        for (int k = 0; k < s->nchange; k++) {
            const fw_process_change *c = &s->change[k];
            if (c->back || !fw_process_where_is_of_device(flow, c->where)) continue;
            if (strcmp(c->kind, "pattern") == 0) print = c;
            const bool developed = print && takes(c, print->material) &&
                                   strcmp(c->where, print->where) == 0,
                       undercut = strcmp(c->kind, "remove") == 0 && c->isotropic && c->thickness;
            if (etched ? undercut : developed) made = s, *material = c->material;
        }
    return made;
}

int fw_process_stages_of_edges(const fw_process_flow *flow, const fw_process_measurement *row,
                               fw_process_coupon_stage *stage) {
    const char *resist = NULL, *film = NULL, *edge = fw_process_coupon_edge(flow);
    const fw_process_step *image = edge_made(flow, false, &resist), *etch = NULL;
    const bool etched = strcmp(edge, FW_PROCESS_PRINTED_EDGE) != 0;
    int n = 0;
    (void)row; /* a line and a space alike */
    if (etched) etch = edge_made(flow, true, &film);
    if (image)
        stage[n++] = (fw_process_coupon_stage){.from = image,
                                               .until = etch ? etch : gone_by(flow, image, resist),
                                               .gives = FW_PROCESS_PRINTED_EDGE};
    if (etch)
        stage[n++] = (fw_process_coupon_stage){
            .from = etch, .until = gone_by(flow, etch, film), .gives = edge};
    return n;
}

bool fw_process_coupon_begins_at_edge(const fw_process_measurement *row) {
    return strcmp(row->coupon, "arde-slots") == 0 || strcmp(row->coupon, "undercut-ladder") == 0;
}

bool fw_process_coupon_tells_edge(const fw_process_flow *flow, const fw_process_measurement *row) {
    const char *edge = fw_process_coupon_edge(flow);
    return strcmp(row->coupon, "cd-lines") == 0 && strcmp(row->of ? row->of : edge, edge) == 0;
}

const fw_process_step *fw_process_flow_edge_step(const fw_process_flow *flow) {
    fw_process_coupon_stage stage[FW_COUPON_STAGES];
    const int n = fw_process_stages_of_edges(flow, NULL, stage);
    for (int i = 0; i < n; i++)
        if (strcmp(stage[i].gives, fw_process_coupon_edge(flow)) == 0) return stage[i].from;
    return NULL;
}

/* is a reading of that wafer among them that tells the edge (of_wafer: of this wafer alone), or else one that begins at it? */
static bool has(const fw_process_flow *flow, const fw_process_readings *all, const char *wafer,
                bool edge, bool of_wafer) {
    for (const fw_process_reading *r = all->item; r < all->item + all->n; r++)
        if (strcmp(r->wafer, wafer) == 0 && r->row.of_wafer == of_wafer &&
            (edge ? fw_process_coupon_tells_edge(flow, &r->row)
                  : fw_process_coupon_begins_at_edge(&r->row)))
            return true;
    return false;
}

/* FW-D693, of reading i and those like it, at the first */
static void tell_no_edge(const fw_process_readings *all, int i, fw_diags *diags) {
    const fw_process_reading *r = &all->item[i];
    int n = 0;
    for (int k = 0; k < all->n; k++) {
        const fw_process_reading *o = &all->item[k];
        const bool like = strcmp(o->row.coupon, r->row.coupon) == 0 && o->edge_off &&
                          strcmp(o->wafer, r->wafer) == 0 && strcmp(o->step, r->step) == 0;
        if (like && k < i) return;
        n += like;
    }
    fw_diag_warning(
        diags, 693, r->row.place,
        "%d reading%s of %s at step %s%s%s %s: where the layer that masks the etch ends on this "
        "wafer is not what was planned, since %s, and no cd-lines that count tell it; "
        "--all-runs counts all",
        n, n > 1 ? "s" : "", r->row.coupon, r->step, r->wafer[0] ? " of wafer " : "", r->wafer,
        n > 1 ? "do not count" : "does not count", r->edge_off);
}

/* Slots and the ladder begin at the edge that lines of their wafer tell, else at the planned one: where that is not as planned, and
   no lines tell it, they are left out. So are lines that tell of their wafer alone where nothing begins at their edge, or
   others tell it. Test: test_asrun.c, readings_of_bad_runs; test_wafers.c, the_edge_of_its_wafer */
void fw_process_readings_of_edges(const fw_process_flow *flow, fw_process_readings *all,
                                  fw_diags *diags) {
    fw_process_readings some = *all;
    for (int i = 0; i < some.n; i++) {
        fw_process_reading *r = &some.item[i];
        if (has(flow, &some, r->wafer, true, false) || has(flow, &some, r->wafer, true, true))
            r->edge_off = NULL; /* somebody read it */
    }
    for (int i = 0; i < some.n; i++)
        if (some.item[i].edge_off) tell_no_edge(&some, i, diags);
    all->n = 0;
    for (int i = 0; i < some.n; i++)
        if (!some.item[i].edge_off) all->item[all->n++] = some.item[i];
    some.n = all->n;
    all->n = 0;
    for (int i = 0; i < some.n; i++) {
        const fw_process_reading r = some.item[i];
        if (!r.row.of_wafer ||
            (has(flow, &some, r.wafer, false, false) && !has(flow, &some, r.wafer, true, false)))
            all->item[all->n++] = r;
    }
}

static const fw_process_step *etch_step(const fw_process_flow *flow) {
    const fw_quantity *A = fw_process_flow_etch(flow).anisotropy;
    for (const fw_process_step *s = flow->step; A && s < flow->step + flow->nstep; s++)
        for (int k = 0; k < s->nchange; k++)
            if (s->change[k].anisotropy == A) return s;
    return NULL;
}

int fw_process_stages_of_etch(const fw_process_flow *flow, const fw_process_measurement *row,
                              fw_process_coupon_stage *stage) {
    (void)row;
    *stage = (fw_process_coupon_stage){.from = etch_step(flow)};
    return stage->from ? 1 : 0;
}

int fw_process_stages_of_mask(const fw_process_flow *flow, const fw_process_measurement *row,
                              fw_process_coupon_stage *stage) {
    const fw_process_step *etch = etch_step(flow);
    (void)row;
    *stage = (fw_process_coupon_stage){.from = etch};
    for (int i = 0; etch && i < etch->nexposed; i++)
        if (etch->exposed[i].selectivity)
            stage->until = gone_by(flow, etch, etch->exposed[i].material);
    return etch ? 1 : 0;
}

static int of_argument(const fw_process_flow *flow, const char *name, const char *id,
                       fw_process_coupon_stage *stage) {
    for (const fw_process_step *s = flow->step; id && s < flow->step + flow->nstep; s++) {
        const fw_quantity *q = fw_process_step_argument(s, name);
        if (!q || !q->id || strcmp(q->id, id) != 0) continue;
        *stage = (fw_process_coupon_stage){.from = s};
        return 1;
    }
    return 0;
}

int fw_process_stages_of_release(const fw_process_flow *flow, const fw_process_measurement *row,
                                 fw_process_coupon_stage *stage) {
    (void)row;
    return of_argument(flow, "rate", "release.R", stage);
}

int fw_process_stages_of_plating(const fw_process_flow *flow, const fw_process_measurement *row,
                                 fw_process_coupon_stage *stage) {
    const fw_quantity *eta = fw_process_flow_plating(flow, row->feature).efficiency;
    return of_argument(flow, "efficiency", eta ? eta->id : NULL, stage);
}
