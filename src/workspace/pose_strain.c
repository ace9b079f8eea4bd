/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"
#include "workspace/pose_load.h"
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* ---- boxes that were looked at before ----
   Of the devices of a study much is the same to the last bit: where everything is, unless a pin moves; forces, unless a
   spring, a grip or the platform does; the strain of a hinge, unless it is another one. What is kept carries the number
   of what it was found with, and is found again with the same alone. Test: test_pose_strain.c what_devices_have_in_common */

enum {
    POSES = 1024, /* a power of 2: one place for each box */
    GRIPS = 8,    /* the first ones of a hold, of which forces are kept */
    BOXES = 256,  /* that have room for them: 3 MB */
    KINDS = 4,    /* flows take turns */
    WORDS = 320
};

typedef struct kind { /* what something was found with, as numbers */
    long is;          /* 0: there is none */
    int n;
    double word[WORDS];
} kind;

typedef struct kinds {
    kind item[KINDS];
    int next; /* to be replaced */
} kinds;

typedef struct placed {
    fw_workspace_box3 box;
    long of; /* 0: of none */
    bool reached;
    char at[offsetof(fw_workspace_pose_load, own)];
    long filled, forces;        /* counted; forces of `grip` */
    fw_workspace_gripped *grip; /* (GRIPS) or NULL */
} placed;

struct fw_workspace_poses {
    fw_arena *arena;
    long of, filled, kind; /* counted: mechanisms, boxes, kinds */
    fw_workspace_loop loop;
    double axis[FW_SIX][2];        /* 0, 0: no section */
    placed *item;                  /* (POSES) */
    int roomy;                     /* boxes that have room for forces */
    const fw_workspace_hold *hold; /* that is looked at now */
    long forces, section[FW_SIX];  /* its numbers; 0: forces are not kept */
    kinds of_forces, of_section[FW_SIX];
};

fw_status fw_workspace_poses_new(fw_arena *arena, fw_workspace_poses **poses) {
    FW_NEED(*poses = fw_arena_one(arena, fw_workspace_poses));
    (*poses)->arena = arena;
    FW_NEED((*poses)->item = fw_arena_array(arena, placed, POSES));
    return FW_OK;
}

static void say(kind *k, double word) {
    if (k->n < WORDS) k->word[k->n] = word;
    k->n++;
}

/* its number, that of an equal one where there is one; 0: it is too long to be known again */
static long number_of(fw_workspace_poses *p, kinds *all, const kind *now) {
    if (now->n > WORDS) return 0;
    for (int i = 0; i < KINDS; i++) {
        const kind *was = &all->item[i];
        if (was->is > 0 && was->n == now->n &&
            memcmp(was->word, now->word, (size_t)now->n * sizeof *now->word) == 0)
            return was->is;
    }
    kind *to = &all->item[all->next];
    all->next = (all->next + 1) % KINDS;
    *to = *now;
    return to->is = ++p->kind;
}

static void say_actuator(kind *k, const fw_workspace_actuator *a) {
    say(k, a->kind), say(k, a->body), say(k, a->against), say(k, a->pulls), say(k, a->platform);
    say(k, a->direction[0]), say(k, a->direction[1]), say(k, a->npoint);
    for (int i = 0; i < a->npoint; i++)
        say(k, a->point[i].body), say(k, a->point[i].x_m), say(k, a->point[i].y_m);
}

static void say_station(kind *k, const fw_workspace_station *s) {
    say(k, s->lever_m[0]), say(k, s->lever_m[1]), say(k, s->bending_per_Nm), say(k, s->axial_per_N);
}

static void keep_forces_of(fw_workspace_poses *p, const fw_workspace_hold *h) {
    kind all = {.n = 0};
    say(&all, h->length_m);
    for (int i = 0; i < 5; i++)
        say(&all, h->at[i].x), say(&all, h->at[i].y);
    for (int i = 0; i < h->nactuator; i++)
        say_actuator(&all, &h->actuator[i]);
    for (int i = 0; i < h->ngrip && i < GRIPS; i++)
        for (int j = 0; j < 3; j++)
            say(&all, h->grip[i].actuator[j]), say(&all, h->grip[i].wrench);
    for (int i = 0; i < FW_SIX; i++) {
        const fw_workspace_section *s = &h->section[i];
        kind one = {.n = 0};
        say(&all, s->spring_Nm_per_rad);
        say(&one, s->moment_Nm_per_rad), say(&one, s->n), say(&one, s->roots);
        say_station(&one, &s->inside);
        for (int j = 0; j < s->n; j++)
            say_station(&one, &s->station[j]);
        p->section[i] = number_of(p, &p->of_section[i], &one);
    }
    p->forces = number_of(p, &p->of_forces, &all);
}

void fw_workspace_poses_are_of(fw_workspace_poses *p, const fw_workspace_hold *hold, bool whole) {
    double axis[FW_SIX][2] = {{0}};
    p->hold = hold, p->forces = 0;
    if (whole) keep_forces_of(p, hold);
    for (int i = 0; i < FW_SIX; i++)
        if (hold->section[i].n > 0) memcpy(axis[i], hold->section[i].axis, sizeof axis[i]);
    if (p->of > 0 && memcmp(&p->loop, hold->loop, sizeof p->loop) == 0 &&
        memcmp(p->axis, axis, sizeof axis) == 0)
        return;
    p->of++;
    p->loop = *hold->loop;
    memcpy(p->axis, axis, sizeof axis);
}

static placed *place_in(const fw_workspace_poses *p, const fw_workspace_box3 *box) {
    uint64_t word[sizeof *box / sizeof(uint64_t)], sum = 0;
    memcpy(word, box, sizeof word);
    for (size_t i = 0; i < sizeof word / sizeof word[0]; i++)
        sum = (sum ^ word[i] ^ sum >> 29) * UINT64_C(0x9e3779b97f4a7c15);
    return &p->item[sum >> 32 & (POSES - 1)];
}

/* *kept: where it stands now; NULL: nowhere */
static bool places(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                   fw_workspace_pose_load *o, placed **kept) {
    fw_workspace_poses *p = hold->poses;
    *kept = NULL;
    if (!p || p->hold != hold) return fw_workspace_pose_places(hold, box, NULL, o);
    placed *was = *kept = place_in(p, box);
    if (was->of == p->of && memcmp(&was->box, box, sizeof *box) == 0) {
        memcpy(o, was->at, sizeof was->at);
        return was->reached;
    }
    was->reached = fw_workspace_pose_places(hold, box, NULL, o);
    was->of = p->of, was->box = *box;
    was->filled = ++p->filled, was->forces = 0;
    memcpy(was->at, o, sizeof was->at);
    return was->reached;
}

bool fw_workspace_poses_find(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                             fw_workspace_pose_load *o) {
    placed *unused;
    return places(hold, box, o, &unused);
}

fw_status fw_workspace_view_new(fw_arena *arena, const fw_workspace_hold *hold,
                                fw_workspace_view *view) {
    const size_t n = (size_t)hold->nactuator + 1;
    *view = (fw_workspace_view){.hold = hold};
    FW_NEED(view->response = fw_arena_array(arena, fw_workspace_response, n));
    FW_NEED(view->responded = fw_arena_array(arena, bool, n));
    return FW_OK;
}

bool fw_workspace_view_at(fw_workspace_view *v, const fw_workspace_box3 *box) {
    v->owned = false, v->here_of = FW_NONE;
    memset(v->responded, 0, (size_t)v->hold->nactuator * sizeof *v->responded);
    const bool reached = places(v->hold, box, &v->load, &v->kept);
    v->filled = v->kept ? v->kept->filled : 0;
    return reached;
}

/* where forces of the first grips are kept; NULL: nowhere, or another box has taken the place meanwhile */
static fw_workspace_gripped *kept_grips(const fw_workspace_view *v) {
    fw_workspace_poses *p = v->hold->poses;
    placed *k = v->kept;
    if (!k || p->hold != v->hold || p->forces == 0 || k->filled != v->filled) return NULL;
    if (!k->grip && p->roomy < BOXES) {
        k->grip = fw_arena_array(p->arena, fw_workspace_gripped, GRIPS);
        p->roomy += k->grip != NULL;
    }
    if (k->grip && k->forces != p->forces)
        for (int i = 0; i < GRIPS; i++)
            k->grip[i].known = false;
    k->forces = p->forces;
    return k->grip;
}

static fw_workspace_gripped *room_of(fw_workspace_view *v, int grip) {
    fw_workspace_gripped *kept = grip < GRIPS ? kept_grips(v) : NULL;
    if (kept) return &kept[grip];
    if (v->here_of != grip) v->here.known = false;
    v->here_of = grip;
    return &v->here;
}

fw_workspace_gripped *fw_workspace_view_grip(fw_workspace_view *v, int grip) {
    const fw_workspace_hold *h = v->hold;
    const fw_workspace_grip *by = &h->grip[grip];
    fw_workspace_gripped *to = room_of(v, grip);
    if (to->known) return to;
    if (!v->owned) fw_workspace_pose_own(h, &v->load);
    v->owned = true;
    for (int k = 0; k < 3 && !by->wrench; k++) {
        const int i = by->actuator[k];
        if (!v->responded[i])
            fw_workspace_pose_response(h, &v->load, &h->actuator[i], &v->response[i]);
        v->responded[i] = true;
    }
    to->holds =
        fw_workspace_pose_forces(h, &v->load, v->response, by, &to->certain, to->own, to->force);
    memset(to->section, 0, sizeof to->section);
    to->known = true;
    return to;
}

fw_maths_interval fw_workspace_view_strain(const fw_workspace_view *v, fw_workspace_gripped *by,
                                           int hinge, double slope[3]) {
    const fw_workspace_poses *p = v->hold->poses;
    const long section = by == &v->here ? 0 : p->section[hinge];
    if (section == 0 || by->section[hinge] != section) {
        memset(by->slope[hinge], 0, sizeof by->slope[hinge]);
        by->strain[hinge] =
            fw_workspace_pose_strain(v->hold, &v->load, hinge, &by->force[hinge], by->slope[hinge]);
        by->section[hinge] = section;
    }
    if (slope) memcpy(slope, by->slope[hinge], sizeof by->slope[hinge]);
    return by->strain[hinge];
}

/* ---- over a whole required box ---- */

enum { DEPTH = 120, GRID = 9 };

typedef struct bounding {
    const fw_arena *arena;
    const fw_workspace_hold *hold;
    double relative, size[3];
    bool sampled; /* nothing is proved */
    fw_workspace_strain_proof *proof;
    fw_workspace_view *over, *at; /* of a box and of a pose */
    double found[FW_SIX], bound[FW_SIX];
    double force_N[FW_SIX]; /* at most in the leaves so far; of samples the largest */
} bounding;

/* the leg's forces are those of a wrench on the platform, which was looked at before */
static bool seen(const bounding *b, int grip, int from, bool own) {
    return own && from == 0 && grip > 0 && b->hold->grip[0].wrench;
}

/* no less than the size of a joint force at every pose of the box */
static double size_of(const fw_workspace_jet2 *force, const double half[3]) {
    const fw_maths_interval x = fw_jet_range(&force->x, half), y = fw_jet_range(&force->y, half);
    return fw_up(hypot(fmax(-x.lo, x.hi), fmax(-y.lo, y.hi)));
}

/* strains at one pose, by the grips from..to that certainly hold it */
static void try_pose(bounding *b, const double pose[3], int from, int to) {
    const fw_workspace_box3 at = {{pose[0], pose[1], pose[2]}, {pose[0], pose[1], pose[2]}};
    if (!fw_workspace_view_at(b->at, &at)) return;
    for (int g = from; g <= to; g++) {
        fw_workspace_gripped *by = fw_workspace_view_grip(b->at, g);
        if (!by->holds || !by->certain) continue;
        for (int i = 0; i < FW_SIX; i++) {
            if (seen(b, g, from, by->own[i > 2])) continue;
            fw_maths_interval now = fw_workspace_view_strain(b->at, by, i, NULL);
            if (b->sampled)
                b->force_N[i] = fmax(b->force_N[i], size_of(&by->force[i], b->at->load.half));
            if (!(now.lo > b->found[i])) continue;
            b->found[i] = now.lo;
            b->proof->most[i] = (fw_workspace_strain_extreme){
                .pose = {pose[0], pose[1], pose[2]}, .grip = g, .strain = now};
        }
    }
}

static bool close_enough(const bounding *b, int hinge, double far) {
    return far <= b->found[hinge] * (1.0 + b->relative) + 1e-15;
}

/* a pose of the box may say more than is known: of large boxes only where their bound is near */
static bool worth(const bounding *b, const fw_workspace_box3 *box, int hinge, double bound) {
    double most = 0.0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, (box->hi[i] - box->lo[i]) / b->size[i]);
    return isfinite(bound) && (most < 0.2 || bound <= 1.03 * b->found[hinge]);
}

/* one enclosure of the box: does it say all that is wanted? Where a bound is too far the corner to
   which that strain grows is tried. */
static bool enough(bounding *b, const fw_workspace_box3 *box) {
    if (!fw_workspace_view_at(b->over, box)) return false;
    double far[FW_SIX] = {0}, most_N[FW_SIX] = {0};
    for (int g = 0; g < b->hold->ngrip; g++) {
        if (!fw_workspace_view_grip(b->over, g)->holds) continue;
        for (int i = 0; i < FW_SIX; i++) {
            fw_workspace_gripped *by = fw_workspace_view_grip(b->over, g);
            if (seen(b, g, 0, by->own[i > 2])) continue;
            double slope[3], corner[3];
            double now = fw_workspace_view_strain(b->over, by, i, slope).hi;
            if (!close_enough(b, i, now)) {
                for (int k = 0; k < 3; k++)
                    corner[k] = slope[k] > 0.0 ? box->hi[k] : box->lo[k];
                if (worth(b, box, i, now)) try_pose(b, corner, g, g);
                if (!close_enough(b, i, now)) return false;
                by = fw_workspace_view_grip(b->over, g); /* the pose may have taken its place */
            }
            far[i] = fmax(far[i], now);
            most_N[i] = fmax(most_N[i], size_of(&by->force[i], b->over->load.half));
        }
    }
    for (int i = 0; i < FW_SIX; i++) {
        b->bound[i] = fmax(b->bound[i], far[i]);
        b->force_N[i] = fmax(b->force_N[i], most_N[i]);
    }
    return true;
}

static int longest(const bounding *b, const fw_workspace_box3 *box) {
    int axis = FW_NONE;
    double most = 0.0;
    for (int i = 0; i < 3; i++) {
        double width = box->hi[i] - box->lo[i], c = 0.5 * (box->lo[i] + box->hi[i]);
        if (!(c > box->lo[i] && c < box->hi[i]) || !(width / b->size[i] > most)) continue;
        most = width / b->size[i];
        axis = i;
    }
    return axis;
}

static fw_workspace_proof_end walk(bounding *b, const fw_workspace_box3 *whole, long most,
                                   fw_text *tree) {
    static const char *const name[] = {"x", "y", "p"};
    fw_workspace_box3 stack[DEPTH];
    int depth = 0;
    stack[depth++] = *whole;
    while (depth > 0) {
        fw_workspace_box3 box = stack[--depth];
        if (b->proof->boxes++ >= most || fw_arena_cancelled(b->arena)) return FW_UNDECIDED;
        if (enough(b, &box)) {
            fw_text_add(tree, ".");
            b->proof->leaves++;
            continue;
        }
        int axis = longest(b, &box);
        if (axis == FW_NONE || depth + 2 > DEPTH) return FW_UNDECIDED;
        fw_text_add(tree, name[axis]);
        double middle = 0.5 * (box.lo[axis] + box.hi[axis]);
        stack[depth] = stack[depth + 1] = box;
        stack[depth].lo[axis] = middle;
        stack[depth + 1].hi[axis] = middle; /* the lower half comes first */
        depth += 2;
    }
    return FW_PROVED;
}

static fw_status start(fw_arena *arena, const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                       fw_workspace_strain_proof *proof, bounding *b) {
    *proof = (fw_workspace_strain_proof){.hold = hold};
    *b = (bounding){.arena = arena, .hold = hold, .proof = proof};
    FW_NEED(b->over = fw_arena_alloc(arena, 2, sizeof *b->over));
    b->at = b->over + 1;
    FW_TRY(fw_workspace_view_new(arena, hold, b->over));
    FW_TRY(fw_workspace_view_new(arena, hold, b->at));
    for (int i = 0; i < 3; i++)
        b->size[i] = fmax(box->hi[i] - box->lo[i], 1e-300);
    return FW_OK;
}

/* n poses along every coordinate */
static void grid(bounding *b, const fw_workspace_box3 *box, int n) {
    for (int i = 0; i < n * n * n; i++) {
        const int step[3] = {i % n, i / n % n, i / (n * n)};
        double pose[3];
        for (int k = 0; k < 3; k++)
            pose[k] = step[k] == n - 1 ? box->hi[k]
                                       : box->lo[k] + (box->hi[k] - box->lo[k]) * step[k] / (n - 1);
        try_pose(b, pose, 0, b->hold->ngrip - 1);
    }
}

/* Largest strain of every hinge over a box of poses, by branch and bound: a box is a leaf when the
   forms of pose_load.c bound the strain of each hinge under each grip by what some pose is proved
   to reach, within `relative`; else it is halved. in: box m, rad; out: strains, proved; the tree of
   boxes. Error: proved. Cost about 15 us a box and 5 us for each of its grips. Source:
   docs/theory/workspace.md. Test: test_pose_strain.c, tests/accept/check_certificate.py. */
fw_status fw_workspace_certify_strain(fw_arena *arena, const fw_workspace_hold *hold,
                                      const fw_workspace_box3 *box, double relative, long most,
                                      fw_workspace_strain_proof *proof,
                                      fw_workspace_proof_end *end) {
    bounding b;
    FW_TRY(start(arena, hold, box, proof, &b));
    b.relative = relative;
    grid(&b, box, 2);
    fw_text tree = fw_text_new(arena);
    *end = walk(&b, box, most, &tree);
    FW_TRY(fw_text_end(&tree));
    if (fw_arena_cancelled(arena)) return FW_CANCELLED;
    if (*end != FW_PROVED) return FW_OK;
    /* a hair more, so that another enclosure of the same numbers can confirm it */
    for (int i = 0; i < FW_SIX; i++)
        proof->strain[i] = b.bound[i] > 0.0 ? b.bound[i] * (1.0 + 1e-4) : 0.0;
    memcpy(proof->force_N, b.force_N, sizeof b.force_N);
    proof->tree = tree.data;
    proof->proved = true;
    return FW_OK;
}

fw_status fw_workspace_sample_strain(fw_arena *arena, const fw_workspace_hold *hold,
                                     const fw_workspace_box3 *box,
                                     fw_workspace_strain_proof *proof) {
    bounding b;
    double coarse[FW_SIX];
    FW_TRY(start(arena, hold, box, proof, &b));
    b.sampled = true;
    grid(&b, box, GRID / 2 + 1);
    memcpy(coarse, b.found, sizeof coarse);
    grid(&b, box, GRID);
    for (int i = 0; i < FW_SIX; i++) /* the grid twice as fine found this much more */
        proof->strain[i] = b.found[i] + 2.0 * (b.found[i] - coarse[i]);
    memcpy(proof->force_N, b.force_N, sizeof b.force_N);
    return fw_arena_cancelled(arena) ? FW_CANCELLED : FW_OK;
}

const char *fw_workspace_actuation(const fw_workspace_strain_proof *proof, int hinge) {
    return proof->hold->grip[proof->most[hinge].grip].name;
}
