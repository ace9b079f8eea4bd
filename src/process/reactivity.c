/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which liquids must not meet: a table of what they react as.

   Every liquid of a pack belongs to groups (reacts-as), and a pair of groups has a consequence or none. Two liquids must
   not meet if a group of one and a group of the other have a consequence, unless one of the two holds both already: what
   is mixed in it has met. In: the groups of two hazards. Out: the consequence in words. Validity: the groups below, in
   amounts that stay on a wafer or go into a can; what a mixture does beyond its groups an <incompatible> of the pack
   says. Cost: one look at each row. Source: groups and consequences of H. K. Hatayama and others, A Method for
   Determining the Compatibility of Hazardous Wastes, EPA-600/2-80-076 (1980), chart of binary combinations, its groups 1
   to 4, 10, 11, 15, 19 and 104, not re-read at its source and not all of its pairs; ammonium salts with bases, iodine with
   ammonia and hypochlorite with ammonia: common textbook knowledge. Test: test_lint.c liquids_react_by_their_groups. */
#include "base/constants.h"
#include "base/text.h"
#include "process/films.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

typedef enum group {
#define FW_REACTIVITY_GROUP(name, word) name,
#include "process/reactivity.def"
#undef FW_REACTIVITY_GROUP
    NONE,
    GROUPS
} group;

static const char *const groups[GROUPS] = {
#define FW_REACTIVITY_GROUP(name, word) [name] = word,
#include "process/reactivity.def"
#undef FW_REACTIVITY_GROUP
    [NONE] = "none",
};

/* the worst first: of two liquids with several pairs the first one is told */
static const struct {
    group a, b;
    const char *what;
} rows[] = {
    {CYANIDE, ACID, "hydrogen cyanide is set free"},
    {CYANIDE, OXIDISING_ACID, "hydrogen cyanide is set free"},
    {CYANIDE, ORGANIC_ACID, "hydrogen cyanide is set free"},
    {IODINE, AMMONIA, "they make nitrogen triiodide, which explodes when it is dry"},
    {OXIDISING_ACID, ALCOHOL, "they may catch fire or explode"},
    {OXIDISING_ACID, KETONE, "they may catch fire or explode"},
    {OXIDISER, KETONE, "they make peroxides that explode"},
    {OXIDISER, ORGANIC_ACID, "they make peroxides that explode"},
    {FLUORIDE, OXIDISING_ACID, "hydrogen fluoride is set free"},
    {FLUORIDE, ACID, "hydrogen fluoride is set free"},
    {FLUORIDE, ORGANIC_ACID, "hydrogen fluoride is set free"},
    {HYPOCHLORITE, ACID, "chlorine is set free"},
    {HYPOCHLORITE, OXIDISING_ACID, "chlorine is set free"},
    {HYPOCHLORITE, ORGANIC_ACID, "chlorine is set free"},
    {HYPOCHLORITE, AMMONIA, "chloramines are set free"},
    {HYPOCHLORITE, AMMONIUM, "chloramines are set free"},
    {HYPOCHLORITE, ALCOHOL, "they may catch fire"},
    {HYPOCHLORITE, KETONE, "they may catch fire"},
    {OXIDISER, ALCOHOL, "they may catch fire"},
    {AMMONIUM, BASE, "ammonia is set free"},
    {OXIDISING_ACID, ORGANIC_ACID, "they heat each other and give off gas"},
    {ACID, BASE, "they heat each other and spatter"},
    {OXIDISING_ACID, BASE, "they heat each other and spatter"},
    {ORGANIC_ACID, BASE, "they heat each other and spatter"},
    {ACID, AMMONIA, "they heat each other and spatter"},
    {OXIDISING_ACID, AMMONIA, "they heat each other and spatter"},
    {ACID, KETONE, "they heat each other"},
};

/* GROUPS: there is none of this name */
static group group_of(fw_word word) {
    int i = 0;
    while (i < GROUPS && !fw_word_is(word, groups[i]))
        i++;
    return (group)i;
}

unsigned fw_process_reacts_as(const char *words) {
    unsigned set = 0;
    for (fw_word word; fw_word_next(&words, " ", &word);) {
        const group is = group_of(word);
        if (is < GROUPS) set |= 1u << is;
    }
    return set;
}

static const char *between(unsigned a, unsigned b) {
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const unsigned g = 1u << rows[i].a, h = 1u << rows[i].b, both = g | h;
        if ((a & both) == both || (b & both) == both) continue;
        if (((a & g) && (b & h)) || ((a & h) && (b & g))) return rows[i].what;
    }
    return NULL;
}

static bool excludes(const fw_process_hazard *a, const fw_process_hazard *b) {
    for (int i = 0; i < a->nincompatible; i++)
        if (strcmp(a->incompatible[i], b->id) == 0) return true;
    return false;
}

const char *fw_process_reaction(const fw_process_hazard *a, const fw_process_hazard *b) {
    if (!a || !b) return NULL;
    const char *what = between(a->reacts, b->reacts);
    if (!what && (excludes(a, b) || excludes(b, a))) what = "the pack says so";
    return what;
}

static fw_status all_groups(fw_arena *arena, const char **text) {
    fw_text list = fw_text_new(arena);
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        fw_text_printf(&list, "%s%s", i ? ", " : "", groups[i]);
    FW_TRY(fw_text_end(&list));
    *text = list.data;
    return FW_OK;
}

/* every liquid says what it reacts as, in words of the table */
fw_status fw_process_lint_reactivity(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    const char *known;
    FW_TRY(all_groups(pack->arena, &known));
    for (int i = 0; i < f->nhazard; i++) {
        const fw_process_hazard *h = &f->hazard[i];
        if (h->wets && !*h->reacts_as)
            fw_diag_error(
                pack->diags, 501, h->place,
                "hazard '%s' is a liquid and does not say what it reacts as, so that nobody "
                "knows what it must not meet; add reacts-as with some of: %s",
                h->id, known);
        const char *words = h->reacts_as;
        for (fw_word word; fw_word_next(&words, " ", &word);)
            if (group_of(word) == GROUPS)
                fw_diag_error(
                    pack->diags, 502, h->place,
                    "hazard '%s' reacts as '%.*s', which is no group that is known; there "
                    "are: %s",
                    h->id, (int)word.length, word.at, known);
    }
    return FW_OK;
}

/* ---- how warm a liquid can be ---- */

/* The first row of which the liquid has a group holds; K. Below the least it freezes, above the most it boils or drives
   its vapour out; open baths, at the pressure of a room. Mixtures lie between, so that rows are wide. Sources: melting and
   boiling points of acetone -95 and 56 Cel, isopropyl alcohol -89 and 82 Cel, water; phosphoric acid is used at 160 to
   180 Cel, piranha at 120 to 140 Cel, potassium hydroxide of 50 % boils at 145 Cel (handbooks, typical). */
static const struct {
    unsigned groups;
    double least_K, most_K;
    const char *why;
} bearable[] = {
    {1u << KETONE, 178, 329.4, "acetone freezes at -95 Cel and boils at 56 Cel"},
    {1u << FLUORIDE, FW_ICE_POINT_K, 353.15,
     "it is of water, and gives off hydrogen fluoride when warm"},
    {1u << ALCOHOL, 184, 355.5, "isopropyl alcohol freezes at -89 Cel and boils at 82 Cel"},
    {1u << AMMONIA, FW_ICE_POINT_K, 363.15, "it is of water, and loses its ammonia when warm"},
    {1u << BASE, FW_ICE_POINT_K, 423.15,
     "it is of water, which freezes at 0 Cel, and boils at 150 Cel"},
    {~0u, FW_ICE_POINT_K, 473.15,
     "it is of water, which freezes at 0 Cel; no bath of acid is above 200 Cel"},
};

static void lint_warmth(fw_process_pack *pack, const fw_process_step *s,
                        const fw_process_hazard *in, const char *name, const fw_quantity *q,
                        fw_place place) {
    size_t row = 0;
    if (q->unknown || !fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension){.K = 1}))
        return;
    while (!(bearable[row].groups & (in->reacts | 1u << GROUPS)))
        row++;
    if (q->value >= bearable[row].least_K && q->value <= bearable[row].most_K) return;
    char is[32];
    fw_diag_error(pack->diags, 543, q->replaced ? q->place : place,
                  "step %s is done in '%s' with '%s' at %s %s (%s), where it is no liquid: %s; "
                  "correct the value",
                  s->id, in->id, name, fw_number_text(is, sizeof is, fw_quantity_in_unit(q), 4),
                  q->unit, q->id ? q->id : "q", bearable[row].why);
}

/* what is set is told there */
static void warm_arguments(fw_process_pack *pack, const fw_process_step *s,
                           const fw_process_hazard *in, const fw_process_argument *argument,
                           int n) {
    for (int k = 0; k < n; k++)
        if (!fw_process_step_sets(s, argument[k].q))
            lint_warmth(pack, s, in, argument[k].name, argument[k].q, s->place);
}

/* is every bath warm enough to be one, and not too warm? FW-D543 */
fw_status fw_process_lint_warmth(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        const fw_process_hazard *in = fw_process_step_liquid(s);
        if (!in || !fw_process_step_in_liquid(s)) continue;
        for (int k = 0; k < s->nsetting; k++)
            lint_warmth(pack, s, in, s->setting[k].name, s->setting[k].q, s->setting[k].place);
        warm_arguments(pack, s, in, s->argument, s->nargument);
        for (int k = 0; k < s->nderive; k++)
            warm_arguments(pack, s, in, s->derive[k].argument, s->derive[k].nargument);
    }
    return FW_OK;
}

/* does it leave a wafer as it is, but for stains? Liquids of unknown kind do not */
bool fw_process_only_dries(const fw_process_hazard *h) {
    static const char mild[] = "alcohol ketone none";
    const char *words = h->reacts_as;
    for (fw_word word; fw_word_next(&words, " ", &word);) {
        char of[32];
        if (word.length >= sizeof of) return false;
        memcpy(of, word.at, word.length);
        of[word.length] = '\0';
        if (!fw_words_hold(mild, " ", of)) return false;
    }
    return true;
}

/* ---- does it take what it shall? ---- */

static bool attacks(const fw_process_step *s, const char *material) {
    for (int h = 0; h < s->nhazard; h++)
        for (int m = 0; m < s->hazard[h]->nattacks; m++)
            if (strcmp(s->hazard[h]->attacks[m], material) == 0) return true;
    return false;
}

/* An etch or a strip in what takes nothing of what it shall: the wrong bath, or a pack that does not say what its own one
   attacks, so that nobody is told what else it would take. What is lifted off goes with what is dissolved below it. */
static void lint_taken(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_change *first = NULL;
    if (!fw_words_hold("wet-etch dry-etch strip", " ", s->op)) return;
    for (int k = 0; k < s->nchange; k++) {
        if (strcmp(s->change[k].kind, "remove") != 0) continue;
        if (attacks(s, s->change[k].material)) return;
        if (!first) first = &s->change[k];
    }
    if (!first) return;
    const char *why = fw_arena_printf(
        pack->arena,
        "step %s (%s) takes off '%s', which none of its hazards attacks; name the bath or the "
        "plasma that does, or say <attacks material=\"%s\"/> of it",
        s->id, s->op, first->material, first->material);
    if (s->nhazard > 0) /* else it may be a pack that knows of no hazards */
        fw_diag_error(pack->diags, 629, first->place, "%s", why ? why : "");
    else
        fw_diag_warning(pack->diags, 629, first->place, "%s", why ? why : "");
}

static bool changes_on(const fw_process_step *s, const char *material, bool back) {
    for (int k = 0; k < s->nchange; k++)
        if (s->change[k].back == back && strcmp(s->change[k].material, material) == 0) return true;
    return false;
}

/* is it the outermost of what was put on that face, somewhere? */
static bool lies_on(const fw_process_stack *stack, const char *material, bool back) {
    for (int column = 0; column < stack->columns; column++) {
        const fw_process_cell *cell = fw_process_stack_top(stack, column, back);
        if (cell && cell->back == back && strcmp(cell->material, material) == 0) return true;
    }
    return false;
}

/* a strip says of which face, and asher and solvent take the same from the other: a mask that shall stay there is gone */
static void lint_stripped(fw_process_pack *pack, const fw_process_step *s,
                          const fw_process_change *c, const fw_process_stack *stack) {
    const char *other = c->back ? "front" : "back";
    if (changes_on(s, c->material, !c->back) || !lies_on(stack, c->material, c->back) ||
        !lies_on(stack, c->material, !c->back))
        return;
    fw_diag_error(pack->diags, 645, c->place,
                  "step %s strips '%s' off the %s, and it lies open on the %s: there it goes, too; "
                  "cover it with something else before, or add a <change> of the %s to the step",
                  s->id, c->material, c->back ? "back" : "front", other, other);
}

/* what was put on the back and a bath attacks, with nothing said of it */
static void lint_back_wet(fw_process_pack *pack, const fw_process_step *s,
                          const fw_process_stack *stack) {
    for (int h = 0; h < s->nhazard; h++)
        for (int m = 0; s->hazard[h]->wets && m < s->hazard[h]->nattacks; m++) {
            const char *on = s->hazard[h]->attacks[m];
            bool said = changes_on(s, on, true) || changes_on(s, on, false);
            for (int i = 0; i < s->nexposed; i++)
                said = said || strcmp(s->exposed[i].material, on) == 0;
            if (said || !lies_on(stack, on, true)) continue;
            fw_diag_warning(pack->diags, 632, s->place,
                            "step %s is done in '%s', which attacks '%s', and that lies open on "
                            "the back: a bath meets both faces; cover the back before, or add a "
                            "<change> of it with side=\"back\"",
                            s->id, s->hazard[h]->id, on);
        }
}

/* a bath etches both faces: what is etched to a depth on the front, and lies open on the back, gets thinner from there, too */
static fw_status lint_both(fw_process_pack *pack, int at) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[at];
    const bool etches = fw_process_step_is_op(s, "wet-etch");
    fw_process_stack stack;
    if (!etches && !fw_words_hold("strip clean release", " ", s->op)) return FW_OK;
    FW_TRY(fw_process_flow_stack(pack->arena, f, at - 1, &stack, NULL));
    if (fw_process_step_in_liquid(s)) lint_back_wet(pack, s, &stack);
    for (int k = 0; k < s->nchange; k++) {
        const fw_process_change *c = &s->change[k];
        if (strcmp(c->kind, "remove") != 0) continue;
        if (fw_process_step_is_op(s, "strip")) lint_stripped(pack, s, c, &stack);
        if (!etches || c->back || !c->thickness || c->reach ||
            !fw_process_stack_open(f, &stack, c->material, true))
            continue;
        fw_diag_warning(pack->diags, 632, c->place,
                        "step %s etches '%s' on the front, and it lies open on the back: the bath "
                        "takes as much there; cover the back before, or add a <change> of it with "
                        "side=\"back\"",
                        s->id, c->material);
    }
    return FW_OK;
}

fw_status fw_process_lint_chemistry(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        lint_taken(pack, &pack->flow->step[i]);
        FW_TRY(lint_both(pack, i));
    }
    return FW_OK;
}

/* ---- do the numbers of a step belong to what it is of? ---- */

/* g/mol of what is plated. IUPAC 2021 */
static const struct {
    const char *metal;
    double g_per_mol;
} molar[] = {{"chromium", 51.996}, {"cobalt", 58.933},   {"copper", 63.546},  {"gold", 196.967},
             {"indium", 114.818},  {"iron", 55.845},     {"nickel", 58.693},  {"palladium", 106.42},
             {"platinum", 195.08}, {"rhodium", 102.906}, {"silver", 107.868}, {"tin", 118.71},
             {"zinc", 65.38}};

/* the metal that a material is named for; -1: none of them, or several, as an alloy */
static int metal_of(const fw_process_material *m) {
    int found = -1;
    for (int i = 0; i < (int)(sizeof molar / sizeof molar[0]); i++) {
        if (!strstr(m->name, molar[i].metal) && !strstr(m->id, molar[i].metal)) continue;
        if (found >= 0) return -1;
        found = i;
    }
    return found;
}

/* Faraday's law with the constants of another metal plates another thickness in its time, and nothing on the wafer shows
   it before it is measured. Densities are apart where they differ by half a percent and by more than both are known to. */
static void lint_faraday(fw_process_pack *pack, const fw_process_step *s,
                         const fw_process_change *c) {
    const fw_process_material *m = fw_process_flow_material(pack->flow, c->material);
    const fw_quantity *rho = fw_process_step_argument(s, "density"),
                      *M = fw_process_step_argument(s, "molar_mass");
    char is[32], own[32];
    if (!m || strcmp(c->kind, "add") != 0) return;
    const int metal = metal_of(m);
    if (rho && !rho->unknown && m->density && !m->density->unknown) {
        const double apart = fabs(rho->value - m->density->value);
        if (apart > 0.005 * m->density->value &&
            apart > hypot(rho->uncertainty, m->density->uncertainty))
            fw_diag_warning(pack->diags, 674, s->place,
                            "step %s plates '%s' with a density of %s kg/m3 (%s), and that of the "
                            "material is %s kg/m3: the time is that of another metal; name the "
                            "material's own",
                            s->id, m->id, fw_number_text(is, sizeof is, rho->value, 5), rho->id,
                            fw_number_text(own, sizeof own, m->density->value, 5));
    }
    if (M && !M->unknown && metal >= 0 &&
        fabs(1e3 * M->value - molar[metal].g_per_mol) > 0.01 * molar[metal].g_per_mol)
        fw_diag_warning(pack->diags, 674, s->place,
                        "step %s plates '%s' with a molar mass of %s g/mol (%s), and %s has %s "
                        "g/mol: the time is that of another metal; correct it",
                        s->id, m->id, fw_number_text(is, sizeof is, 1e3 * M->value, 5), M->id,
                        molar[metal].metal,
                        fw_number_text(own, sizeof own, molar[metal].g_per_mol, 6));
}

static fw_place place_of(const fw_quantity *q, fw_place otherwise) {
    return q->replaced ? q->place : otherwise;
}

/* a ratio that is written as the share by which it exceeds 1, or the other way round */
static void lint_share(fw_process_pack *pack, const fw_process_step *s,
                       const fw_process_change *c) {
    char is[32], meant[32];
    const fw_quantity *f = c->spread, *A = c->anisotropy;
    if (f && !f->unknown && f->value < 1.0)
        fw_diag_error(pack->diags, 669, place_of(f, c->place),
                      "the spread of step %s is %s (%s), but it is the largest local thickness "
                      "over the mean, which is 1 at least; where the thickest place has %s %% more "
                      "than the mean, write %s",
                      s->id, fw_number_text(is, sizeof is, f->value, 4), f->id,
                      fw_number_text((char[32]){0}, 32, 100.0 * f->value, 4),
                      fw_number_text(meant, sizeof meant, 1.0 + f->value, 5));
    if (A && !A->unknown && A->value < 0.5)
        fw_diag_error(pack->diags, 675, place_of(A, c->place),
                      "step %s etches with an anisotropy of %s (%s), that is nearly as much "
                      "sideways as down: it is 1 less lateral over vertical, and 1 for a straight "
                      "wall; write %s where %s is lateral over vertical, or profile=\"isotropic\"",
                      s->id, fw_number_text(is, sizeof is, A->value, 4), A->id,
                      fw_number_text(meant, sizeof meant, 1.0 - A->value, 5), is);
}

fw_status fw_process_lint_meant(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        for (int k = 0; k < s->nchange; k++) {
            lint_share(pack, s, &s->change[k]);
            if (strcmp(s->law, "faraday") == 0) lint_faraday(pack, s, &s->change[k]);
        }
    }
    return FW_OK;
}
