/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Can people do at a bench what the flow says? Whether somebody stands where a liquid lies open, whether times are ones
   that hands and benches keep, how long a state may last at most, what a last rinse takes off, and what must be read for
   one's safety. Each question is a function here and a row in lint.c. Theory: docs/theory/process.md, "What hands and
   benches do". Test: test_lint.c. */
#include "base/text.h"
#include "process/films.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

static const char *minutes(char text[32], double seconds) {
    return fw_number_text(text, 32, seconds / 60.0, 4);
}

/* ---- people ---- */

static bool is_acid(const fw_process_hazard *h) {
    return h->wets && fw_words_hold(h->reacts_as, " ", "fluoride") &&
           strstr(h->name, "hydrofluoric") != NULL;
}

/* a hazard that speaks of hydrofluoric acid and does not say whether it may be handled alone */
static void lint_acid(fw_process_pack *pack) {
    for (int part = 0; part < 2; part++) {
        const fw_xml_record *root = part == 0 ? pack->base : pack->root;
        for (const fw_xml_record *h = root->first_child; h; h = h->next) {
            bool named = false, antidote = false;
            if (!fw_xml_is(h, "hazard")) continue;
            for (const fw_xml_record *c = h->first_child; c; c = c->next) {
                named = named || strstr(c->element->text, "hydrofluoric") ||
                        strstr(c->element->text, "HF ");
                antidote = antidote || strstr(c->element->text, "gluconate");
            }
            if (!named || strcmp(fw_process_pack_text(h, "buddy"), "no") == 0) continue;
            if (!fw_process_pack_get(h, "buddy"))
                fw_diag_error(pack->diags, 174, h->element->place,
                              "hazard '%s' mentions hydrofluoric acid: state buddy=\"yes\", or "
                              "buddy=\"no\" where nobody handles the acid itself",
                              fw_process_pack_text(h, "id"));
            else if (!antidote)
                fw_diag_error(pack->diags, 174, h->element->place,
                              "hazard '%s' is hydrofluoric acid and its first aid does not name "
                              "calcium gluconate",
                              fw_process_pack_text(h, "id"));
        }
    }
    for (int i = 0; i < pack->flow->nhazard; i++) {
        const fw_process_hazard *h = &pack->flow->hazard[i];
        if (is_acid(h) && !h->buddy)
            fw_diag_error(pack->diags, 174, h->place,
                          "hazard '%s' is hydrofluoric acid that wets wafers, so that somebody "
                          "handles it: state buddy=\"yes\"",
                          h->id);
        /* an acid drop sets hydrogen cyanide free: who finds somebody must know at once what it was */
        if (h->wets && fw_words_hold(h->reacts_as, " ", "cyanide") &&
            (!h->buddy || !strstr(h->first_aid, "cyanide")))
            fw_diag_error(pack->diags, 635, h->place,
                          "hazard '%s' is a cyanide: state buddy=\"yes\", and say \"cyanide\" in "
                          "its first aid",
                          h->id);
    }
}

/* a liquid is not left alone, nor what needs a buddy */
static void lint_attended(fw_process_pack *pack, const fw_process_step *s) {
    const double longest = 12 * 3600.0;
    const fw_process_hazard *alone = NULL;
    char is[32];
    for (int i = 0; i < s->nhazard; i++)
        if (s->hazard[i]->buddy) alone = s->hazard[i];
    if (!(s->attended_s > 0.0) && alone)
        fw_diag_error(pack->diags, 174, s->place,
                      "step %s has the hazard '%s', which nobody leaves alone, and is "
                      "attended=\"0\": say for how long somebody stands there",
                      s->id, alone->id);
    else if (!(s->attended_s > 0.0) && fw_process_step_in_liquid(s))
        fw_diag_error(pack->diags, 174, s->place,
                      "step %s (%s) is done in a liquid and is attended=\"0\", but somebody puts "
                      "the wafer in, watches it and takes it out: say for how many minutes",
                      s->id, s->op);
    if (s->attended_s > longest)
        fw_diag_error(pack->diags, 577, s->place,
                      "step %s is attended for %s min, longer than anybody stands at a bench; "
                      "attended is in minutes, and of one load",
                      s->id, minutes(is, s->attended_s));
}

static void lint_step(fw_process_pack *pack, const fw_process_step *s) {
    for (int i = 0; i < s->nhazard; i++) {
        if (!s->hazard[i]->buddy) continue;
        if (!s->second_signature)
            fw_diag_error(pack->diags, 174, s->place,
                          "step %s has the hazard '%s', which nobody handles alone: add "
                          "second-signature=\"yes\"",
                          s->id, s->hazard[i]->id);
        if (!s->hazard[i]->first_aid[0])
            fw_diag_error(pack->diags, 174, s->hazard[i]->place,
                          "hazard '%s' has no first aid; add a <firstaid>", s->hazard[i]->id);
    }
    lint_attended(pack, s);
}

/* "GHS01" to "GHS09", or "none" */
static bool is_pictogram(fw_word word) {
    return fw_word_is(word, "none") || (word.length == 5 && memcmp(word.at, "GHS0", 4) == 0 &&
                                        word.at[4] >= '1' && word.at[4] <= '9');
}

static bool says_nothing(const char *text) {
    return text[strspn(text, " \t\r\n")] == '\0';
}

/* what is read before a bottle is opened */
static void lint_warning(fw_process_pack *pack, const fw_process_hazard *h) {
    const char *empty = says_nothing(h->ppe) ? "ppe" : says_nothing(h->waste) ? "waste" : NULL;
    const char *words = h->ghs;
    if (empty)
        fw_diag_error(pack->diags, 171, h->place,
                      "hazard '%s': its <%s> says nothing, and whoever stands there reads it on "
                      "the sheet; write it, or \"none\"",
                      h->id, empty);
    for (fw_word word; fw_word_next(&words, " ", &word);)
        if (!is_pictogram(word))
            fw_diag_error(pack->diags, 171, h->place,
                          "hazard '%s': '%.*s' is no pictogram; they are GHS01 to GHS09, or none",
                          h->id, (int)word.length, word.at);
}

/* people and chemicals (FW-D171, FW-D174) */
fw_status fw_process_lint_people(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        lint_step(pack, &pack->flow->step[i]);
    for (int i = 0; i < pack->flow->nhazard; i++)
        lint_warning(pack, &pack->flow->hazard[i]);
    lint_acid(pack);
    return FW_OK;
}

/* ---- times ---- */

/* Between what hands and shutters keep and what any laboratory waits for; wider than what is usual, so that a slip of the
   unit is told and a slow recipe is not. */
static const struct {
    const char *op;
    double least_s, most_s;
    const char *why;
} times[] = {
    {"clean", 5, 172800, "a cleaning takes seconds to hours"},
    {"anodise", 2, 172800, "a current is switched on and off by hand, and no cell runs for days"},
    {"displace", 2, 86400, "a dip is seconds at least, and a deposit dissolves again within hours"},
    {"coat", 5, 3600, "a resist needs seconds to spread and is dry within minutes"},
    {"bake", 0, 86400, "a bake is over within a day"},
    {"expose", 0.2, 7200, "a shutter takes tenths of a second, and a lamp that needs hours is out"},
    {"develop", 3, 14400, "a dish is changed in seconds, and dark resist goes within hours"},
    {"plate", 5, 1209600, "a current is switched on and off by hand, and no bath runs for weeks"},
    {"deposit", 2, 345600, "a shutter takes seconds, and no coater runs for days"},
    {"wet-etch", 3, 172800, "nobody stops a bath sooner, and none is watched for days"},
    {"dry-etch", 3, 172800, "a plasma burns evenly after seconds only, and none runs for days"},
    {"strip", 3, 345600, "nobody stops a bath sooner, and none is left for days"},
    {"release", 3, 864000, "nobody stops a bath sooner, and ten days are long even below a plate"},
    {"mount", 1, 86400, "a wafer is mounted within a day"},
    {"bond", 1, 172800, "a bond is over within a day or two"},
    {"inspect", 1, 172800, "a wafer is looked at within a day or two"},
    {"dice", 1, 172800, "a wafer is sawn within a day or two"},
    {"package", 1, 604800, "chips are packaged within days"},
};

/* A plasma strikes, is matched and settles within some seconds: what is ashed for less is ashed as it happens. */
static const char *unstruck(const fw_process_step *s, double time_s) {
    const double least_s = 10.0;
    const bool plasma = s->equipment && s->equipment->vacuum && !fw_process_step_in_liquid(s) &&
                        fw_words_hold("clean dry-etch strip", " ", s->op);
    return plasma && time_s < least_s
               ? "a plasma strikes and settles within some seconds, and is worth a time from ten on"
               : NULL;
}

const char *fw_process_step_unkept(const fw_process_step *s, double time_s) {
    const char *plasma = unstruck(s, time_s);
    if (plasma) return plasma;
    for (size_t i = 0; i < sizeof times / sizeof times[0]; i++)
        if (fw_process_step_is_op(s, times[i].op) &&
            (time_s < times[i].least_s || time_s > times[i].most_s))
            return times[i].why;
    return NULL;
}

static void lint_stated_time(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const fw_quantity *t = fw_process_step_argument(s, "time");
    char is[32];
    if (!law || !law->stated || !t || t->unknown || !(t->value > 0.0)) return; /* none: FW-D534 */
    const char *why = fw_process_step_unkept(s, t->value);
    if (why)
        fw_diag_error(pack->diags, 577, t->replaced ? t->place : s->place,
                      "step %s (%s) takes %s min (%s), but %s; is its unit right?", s->id, s->op,
                      minutes(is, t->value), t->id, why);
}

static void lint_bench_time(fw_process_pack *pack, const fw_process_step *s, const fw_quantity *q,
                            fw_place place, double least_s, double most_s, const char *what) {
    char is[32], least[32], most[32];
    if (!q || q->unknown || !(q->value > 0.0) || (q->value >= least_s && q->value <= most_s))
        return;
    fw_diag_error(pack->diags, 577, q->replaced ? q->place : place,
                  "step %s %s %s min (%s), outside %s to %s min; is its unit right?", s->id, what,
                  minutes(is, q->value), q->id, minutes(least, least_s), minutes(most, most_s));
}

/* rinses, dryings and the pauses of a step that is done in parts */
static void lint_bench_times(fw_process_pack *pack, const fw_process_step *s) {
    for (int i = 0; i < s->nfinish; i++) {
        const fw_process_finish *f = &s->finish[i];
        const bool rinse = f->kind == FW_FINISH_RINSE;
        lint_bench_time(pack, s, f->time, f->place, 3.0, rinse ? 4 * 3600.0 : 86400.0,
                        rinse ? "rinses for" : "finishes at its bench for");
    }
    if (s->pulse)
        lint_bench_time(pack, s, s->pause, s->place, 0.0, 12 * 3600.0, "pauses between parts for");
}

/* a wafer that must go on sooner than anybody carries it */
static void lint_carrying(fw_process_pack *pack, int at) {
    const double least_s = 30.0;
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[at];
    for (int k = 0; k < s->nlag; k++)
        for (int j = 0; j < at; j++)
            if (strcmp(s->lag[k].from, f->step[j].id) == 0 && s->lag[k].max_s < least_s &&
                s->equipment != f->step[j].equipment)
                fw_diag_error(pack->diags, 577, s->lag[k].place,
                              "step %s must start within %s min of the end of step %s, which is at "
                              "another place: nobody carries a wafer so fast; give half a minute "
                              "at least, or finish it at the first bench",
                              s->id, minutes((char[32]){0}, s->lag[k].max_s), f->step[j].id);
}

fw_status fw_process_lint_hands(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        lint_stated_time(pack, s);
        lint_bench_times(pack, s);
        lint_carrying(pack, i);
    }
    return FW_OK;
}

/* ---- how long a state may last ---- */

static const fw_process_hazard *hazard_of(const fw_process_flow *f, const char *id, size_t n) {
    for (int i = f->nhazard - 1; i >= 0; i--)
        if (strlen(f->hazard[i].id) == n && memcmp(f->hazard[i].id, id, n) == 0)
            return &f->hazard[i];
    return NULL;
}

/* what etches goes on etching; water and solvents only dry */
static double longest_wet_s(const fw_process_flow *f, const char *id, size_t n) {
    const fw_process_hazard *h = hazard_of(f, id, n);
    return !h || fw_process_only_dries(h) ? 86400.0 : 600.0;
}

/* "h.pan.wet-longest": of what and of which state; false: of none */
static bool longest_of(const char *id, size_t *of, fw_process_state *state) {
    static const char longest[] = "-longest";
    const size_t n = strlen(id);
    for (int k = 0; k < FW_STATES; k++) {
        const char *key = fw_process_state_key((fw_process_state)k);
        const size_t tail = 1 + strlen(key) + strlen(longest);
        if (n <= tail || id[n - tail] != '.' || strncmp(id + n - tail + 1, key, strlen(key)) != 0 ||
            strcmp(id + n - strlen(longest), longest) != 0)
            continue;
        *of = n - tail;
        *state = (fw_process_state)k;
        return true;
    }
    return false;
}

fw_status fw_process_lint_longest(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nquantity; i++) {
        const fw_quantity *q = f->quantity[i];
        size_t n;
        fw_process_state state;
        char is[32], most[32];
        if (!q->id || q->unknown || !longest_of(q->id, &n, &state)) continue;
        const double most_s =
            state == FW_STATE_WET ? longest_wet_s(f, q->id, n) : fw_process_state_most_s(state);
        if (q->value > 0.0 && q->value <= most_s) continue;
        fw_diag_error(pack->diags, 578, q->place,
                      "'%s' lets a wafer wait for %s min, but as %s it bears %s min at most: %s; "
                      "finish it at the bench before",
                      q->id, minutes(is, q->value), fw_process_state_is(state),
                      minutes(most, most_s), fw_process_state_why(state));
    }
    return FW_OK;
}

/* a pack's own hold that is longer than what the wafer bears in between: it would never be used, and says so to nobody */
static fw_status lint_lag(fw_process_pack *pack, const fw_process_wait *w,
                          const fw_process_lag *lag) {
    const char *to = pack->flow->step[w->to].id, *from = pack->flow->step[w->from].id;
    char is[32], most[32];
    if (!(lag->max_s > w->max_s) || strcmp(lag->from, from) != 0) return FW_OK;
    const char *why = fw_arena_printf(
        pack->arena,
        "step %s may wait for %s min after step %s, but the wafer is %s then and bears %s min "
        "(%s): %s; give a shorter max, or finish it at the bench before",
        to, minutes(is, lag->max_s), from, w->is, minutes(most, w->max_s),
        w->q ? w->q->id : "assumed, since no quantity says how long", w->why);
    FW_NEED(why);
    if (w->q || lag->max_s > w->most_s)
        fw_diag_error(pack->diags, 578, lag->place, "%s", why);
    else
        fw_diag_warning(pack->diags, 578, lag->place, "%s", why);
    return FW_OK;
}

fw_status fw_process_lint_lags(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    FW_TRY(fw_process_flow_waits(pack->arena, pack->flow));
    for (int i = 0; i < f->nwait; i++)
        for (int k = 0; k < f->step[f->wait[i].to].nlag; k++)
            FW_TRY(lint_lag(pack, &f->wait[i], &f->step[f->wait[i].to].lag[k]));
    return FW_OK;
}

/* ---- what a rinse takes off ---- */

static fw_status takes_off(fw_process_pack *pack, int step, const fw_process_finish *r,
                           const fw_process_hazard *with, const char *material) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[step];
    fw_process_stack stack;
    for (int i = 0; i < s->nexposed; i++)
        if (strcmp(s->exposed[i].material, material) == 0) return FW_OK;
    FW_TRY(fw_process_flow_stack(pack->arena, f, step, &stack, NULL));
    for (int back = 0; back < 2; back++)
        if (fw_process_stack_open(f, &stack, material, back)) {
            fw_diag_error(pack->diags, 539, r->place,
                          "step %s %s '%s', which attacks '%s', and that lies open then; "
                          "%s, or take it off before",
                          s->id, r->kind == FW_FINISH_DRY ? "dries in vapour of" : "rinses in",
                          with->id, material,
                          r->kind == FW_FINISH_DRY ? "spin it dry" : "rinse in water");
            return FW_OK;
        }
    return FW_OK;
}

/* vapour of alcohol wets what is dried by it: what takes resist off as a liquid does so then */
static const fw_process_hazard *rinsed_with(const fw_process_flow *f, const fw_process_finish *r) {
    if (r->kind == FW_FINISH_RINSE) return r->with;
    for (int i = f->nhazard - 1; i >= 0 && strcmp(r->by, "vapour") == 0; i--)
        if (f->hazard[i].wets && fw_process_only_dries(&f->hazard[i]) &&
            fw_words_hold(f->hazard[i].reacts_as, " ", "alcohol"))
            return &f->hazard[i];
    return NULL;
}

fw_status fw_process_lint_rinses(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        for (int k = 0; k < pack->flow->step[i].nfinish; k++) {
            const fw_process_finish *r = &pack->flow->step[i].finish[k];
            const fw_process_hazard *with = rinsed_with(pack->flow, r);
            for (int m = 0; with && m < with->nattacks; m++)
                FW_TRY(takes_off(pack, i, r, with, with->attacks[m]));
        }
    return FW_OK;
}

/* ---- what a critical point dryer takes up ----
   Liquid carbon dioxide mixes with alcohols and ketones; water stays, and dries with its meniscus. */

static const fw_process_hazard *liquid_before(const fw_process_step *s, int finish,
                                              const fw_process_wafer *came) {
    for (int k = finish - 1; k >= 0; k--)
        if (s->finish[k].kind == FW_FINISH_RINSE) return s->finish[k].with; /* NULL: water */
    if (fw_process_step_in_liquid(s)) return fw_process_step_liquid(s);
    return came && came->is[FW_STATE_WET] ? came->liquid : NULL;
}

static void lint_taken_up(fw_process_pack *pack, const fw_process_step *s, int finish,
                          const fw_process_wafer *came) {
    const fw_process_hazard *h = liquid_before(s, finish, came);
    if (strcmp(s->finish[finish].by, "critical-point") != 0) return;
    if (h &&
        (fw_words_hold(h->reacts_as, " ", "alcohol") || fw_words_hold(h->reacts_as, " ", "ketone")))
        return;
    fw_diag_error(pack->diags, 591, s->finish[finish].place,
                  "step %s dries at the critical point out of %s, which carbon dioxide does not "
                  "take up: a meniscus stays, and pulls compliant parts down; exchange it for an "
                  "alcohol or a ketone before, and name that among the step's hazards",
                  s->id, h ? h->name : "water");
}

/* A dryer brings carbon dioxide under pressure, which no open bench does. */
static void lint_dryer(fw_process_pack *pack, const fw_process_step *s,
                       const fw_process_finish *dry) {
    if (!s->equipment || strcmp(dry->by, "critical-point") != 0) return;
    for (int i = 0; i < pack->flow->nhazard; i++)
        if (fw_words_hold(pack->flow->hazard[i].ghs, " ", "GHS04") &&
            fw_words_hold(s->equipment->brings, " ", pack->flow->hazard[i].id))
            return;
    fw_diag_error(pack->diags, 612, dry->place,
                  "step %s dries at the critical point at '%s' (%s), which brings no gas under "
                  "pressure (GHS04): carbon dioxide gets there in a closed chamber at 74 bar only; "
                  "name the dryer, or say what it brings (brings=\"h.pressure\")",
                  s->id, s->equipment->id, s->equipment->class_);
}

/* What an anodising step has turned a material into is full of pores, and each is a capillary. */
static bool is_anodised(const fw_process_flow *f, int upto, const char *material) {
    for (int i = 0; i <= upto; i++)
        for (int k = 0; k < f->step[i].nchange; k++)
            if (fw_process_step_is_op(&f->step[i], "anodise") &&
                strcmp(f->step[i].change[k].kind, "convert") == 0 &&
                strcmp(f->step[i].change[k].material, material) == 0)
                return true;
    return false;
}

static fw_status lint_pores(fw_process_pack *pack, int at, const fw_process_finish *dry,
                            const fw_process_hazard *from) {
    const fw_process_flow *f = pack->flow;
    fw_process_stack stack;
    if (!fw_process_drying_pulls(dry->by)) return FW_OK;
    FW_TRY(fw_process_flow_stack(pack->arena, f, at, &stack, NULL));
    for (int column = 0; column < stack.columns; column++) {
        const fw_process_cell *top = fw_process_stack_top(&stack, column, false);
        if (!top || !is_anodised(f, at, top->material)) continue;
        const bool mild = from && (fw_words_hold(from->reacts_as, " ", "alcohol") ||
                                   fw_words_hold(from->reacts_as, " ", "ketone"));
        const char *why = fw_arena_printf(
            pack->arena,
            "step %s dries '%s' by %s out of %s while it lies open: menisci in its pores crack "
            "it%s; keep it wet, cover it before, or dry it by=\"critical-point\"",
            f->step[at].id, top->material, dry->by, from ? from->name : "water",
            mild ? " where it is thick or very porous" : "");
        FW_NEED(why);
        if (mild)
            fw_diag_warning(pack->diags, 613, dry->place, "%s", why);
        else
            fw_diag_error(pack->diags, 613, dry->place, "%s", why);
        return FW_OK;
    }
    return FW_OK;
}

fw_status fw_process_lint_critical(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_wafer *after;
    FW_TRY(fw_process_flow_wafers(pack->arena, f, &after));
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nfinish; k++) {
            const fw_process_step *s = &f->step[i];
            const fw_process_wafer *came = i > 0 ? &after[i - 1] : NULL;
            if (s->finish[k].kind != FW_FINISH_DRY) continue;
            lint_taken_up(pack, s, k, came);
            lint_dryer(pack, s, &s->finish[k]);
            FW_TRY(lint_pores(pack, i, &s->finish[k], liquid_before(s, k, came)));
        }
    return FW_OK;
}

/* ---- metal that lifts off ---- */

static bool is_spun_on(const fw_process_flow *f, int before, const char *material) {
    for (int i = 0; i < before; i++)
        for (int k = 0; k < f->step[i].nchange && fw_process_step_is_op(&f->step[i], "coat"); k++)
            if (strcmp(f->step[i].change[k].kind, "add") == 0 &&
                strcmp(f->step[i].change[k].material, material) == 0)
                return true;
    return false;
}

/* A solvent gets below metal only where that is thinner than the resist that it lies on. */
static fw_status lint_lift(fw_process_pack *pack, int step, int change) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[step];
    const char *resist = s->change[change].material;
    fw_process_stack stack;
    if (!fw_process_step_is_op(s, "strip") || strcmp(s->change[change].kind, "remove") != 0 ||
        s->change[change].back || !is_spun_on(f, step, resist))
        return FW_OK;
    FW_TRY(fw_process_flow_stack(pack->arena, f, step - 1, &stack, NULL));
    for (int column = 0; column < stack.columns; column++) {
        double below_m = 0.0, above_m = 0.0;
        for (int i = 0; i < stack.n[column]; i++) {
            const fw_process_cell *c = &stack.cell[column][i];
            if (c->back) continue;
            if (strcmp(c->material, resist) == 0)
                below_m = c->thickness_m, above_m = 0.0;
            else
                above_m += c->thickness_m;
        }
        if (!(below_m > 0.0) || !(above_m >= below_m)) continue;
        char metal[32], is[32];
        fw_diag_error(pack->diags, 579, s->change[change].place,
                      "step %s lifts off %s um with '%s', which is %s um thick: the two parts hang "
                      "together over its edge; make the resist thicker, or the layer thinner",
                      s->id, fw_number_text(metal, sizeof metal, 1e6 * above_m, 3), resist,
                      fw_number_text(is, sizeof is, 1e6 * below_m, 3));
        return FW_OK;
    }
    return FW_OK;
}

fw_status fw_process_lint_lifted(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        for (int k = 0; k < pack->flow->step[i].nchange; k++)
            FW_TRY(lint_lift(pack, i, k));
    return FW_OK;
}

/* ---- baths, and the wafer itself ---- */

static bool uses(const fw_process_step *s, const fw_process_hazard *liquid) {
    for (int i = 0; i < s->nuse; i++)
        if (s->use[i].bath || s->use[i].consumable->hazard == liquid) return true;
    return false;
}

/* a bath decides on volume, bill and waste; what stands at the bench of an earlier step is in the bill with that */
static void lint_bath(fw_process_pack *pack, int at) {
    const fw_process_step *s = &pack->flow->step[at];
    const fw_process_hazard *in = fw_process_step_liquid(s);
    bool bath = false, liquid = uses(s, in);
    for (int i = 0; i < s->nuse; i++)
        bath = bath || s->use[i].bath;
    for (int i = 0; i < at; i++)
        liquid = liquid || (pack->flow->step[i].equipment == s->equipment &&
                            fw_process_step_liquid(&pack->flow->step[i]) == in &&
                            uses(&pack->flow->step[i], in));
    if (!bath && fw_words_hold("anodise develop displace plate wet-etch", " ", s->op))
        fw_diag_warning(pack->diags, 562, s->place,
                        "step %s (%s) is done in a bath, and names none: what it uses up is in no "
                        "bill of the lot; add <uses bath=\"...\"/>",
                        s->id, s->op);
    else if (!liquid && fw_process_step_in_liquid(s))
        fw_diag_warning(pack->diags, 562, s->place,
                        "step %s (%s) is done in '%s', and uses nothing of that: it is in no bill "
                        "of the lot; add <uses bath=\"...\"/> or <uses consumable=\"...\"/>",
                        s->id, s->op, in->id);
}

fw_status fw_process_lint_baths(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        lint_bath(pack, i);
    return FW_OK;
}

static void lint_empty(fw_process_pack *pack, const fw_process_bath *b) {
    double sum = 0.0;
    for (int i = 0; i < b->npart; i++)
        sum += b->part[i].q && !b->part[i].q->unknown ? b->part[i].q->value : 1.0;
    if (b->npart > 0 && !(sum > 0.0))
        fw_diag_error(pack->diags, 370, b->part[0].q->replaced ? b->part[0].q->place : b->place,
                      "bath '%s' is mixed from nothing: all its parts are 0; leave unknown those "
                      "that nobody knows",
                      b->id);
}

/* of what is counted there is no half, but where it is a mean */
static void lint_whole(fw_process_pack *pack, const fw_quantity *q) {
    const bool counted = q->range && strcmp(q->range, "count") == 0;
    char is[32];
    if (!counted || q->unknown || q->uncertainty > 0.0 || q->value == floor(q->value)) return;
    fw_diag_error(pack->diags, 278, q->place,
                  "'%s' is %s, and counts things: write a whole number, or say by u how uncertain "
                  "a mean is",
                  q->id ? q->id : "q", fw_number_text(is, sizeof is, q->value, 6));
}

fw_status fw_process_lint_stock(fw_process_pack *pack) {
    const fw_quantity *wafer = fw_process_flow_quantity(pack->flow, "wafer.D");
    char is[32];
    for (int i = 0; i < pack->flow->nbath; i++)
        lint_empty(pack, &pack->flow->bath[i]);
    for (int i = 0; i < pack->flow->nquantity; i++)
        lint_whole(pack, pack->flow->quantity[i]);
    if (wafer && !wafer->unknown && !(wafer->value >= 5e-3 && wafer->value <= 0.45))
        fw_diag_error(pack->diags, 278, wafer->place,
                      "'wafer.D' is %s mm, outside its plausible range of 5 to 450 mm (a piece is "
                      "some millimetres wide, the largest wafer 450 mm); correct the value or its "
                      "unit",
                      fw_number_text(is, sizeof is, wafer->value * 1e3, 4));
    return FW_OK;
}
