/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Does a step take what is its own? The numbers of its law, its plate, its tool, its bath, and its times among
   themselves. */
#include "base/constants.h"
#include "base/text.h"
#include "process/films.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

/* ---- numbers of its law ---- */

/* the one material that a step adds or takes away; NULL: several, none, or only what is exposed */
static const char *material_of(const fw_process_step *s) {
    const char *material = NULL;
    for (int k = 0; k < s->nchange; k++) {
        if (material && strcmp(material, s->change[k].material) != 0) return NULL;
        material = s->change[k].material;
    }
    return material;
}

/* Arguments that belong to one material or to one bath. A current density or an efficiency may by chance be that of another
   bath, and is then two numbers all the same: who changes one does not mean the other. */
static const struct {
    const char *argument;
    bool by_chance;
} own[] = {{"rate", false},           {"molar_mass", false}, {"density", false}, {"valence", true},
           {"current_density", true}, {"efficiency", true},  {"porosity", true}};

static void lint_own(fw_process_pack *pack, int at, const char *argument, bool by_chance) {
    const fw_process_step *s = &pack->flow->step[at];
    const fw_quantity *q = fw_process_step_argument(s, argument);
    const char *material = material_of(s);
    for (int i = 0; q && material && i < at; i++) {
        const fw_process_step *before = &pack->flow->step[i];
        const char *other = material_of(before);
        if (fw_process_step_argument(before, argument) != q || !other ||
            strcmp(other, material) == 0)
            continue;
        const char *why = fw_arena_printf(
            pack->arena,
            "the time of step %s is computed with '%s' as its %s, by which step %s is timed for "
            "'%s', but the step is of '%s'; name that of its own",
            s->id, q->id, argument, before->id, other, material);
        if (by_chance)
            fw_diag_warning(pack->diags, 561, s->place, "%s", why ? why : "");
        else
            fw_diag_error(pack->diags, 561, s->place, "%s", why ? why : "");
        return;
    }
}

/* what lies in a narrow opening lags behind, not what stands beside it */
static void lint_opening(fw_process_pack *pack, const fw_process_step *s) {
    static const char *const lines[] = {"mask.narrowest-line", "mask.narrowest-flexure"};
    const fw_quantity *width = fw_process_step_argument(s, "width");
    for (size_t i = 0; width && width->id && i < sizeof lines / sizeof *lines; i++)
        if (strcmp(width->id, lines[i]) == 0)
            fw_diag_error(pack->diags, 561, s->place,
                          "the time of step %s is computed for an opening as wide as '%s', which "
                          "is no opening; name the narrowest slot, or that of the masking layer",
                          s->id, width->id);
}

/* The supply gives the current of all that conducts in the bath: a plating whose area is another one has another current,
   charge and time on the sheet than in the jig. */
static void lint_area(fw_process_pack *pack, const fw_process_step *s) {
    static const char plated[] = "mask.plated-area";
    const fw_quantity *area = fw_process_step_argument(s, "area");
    if (!area || !area->id || !fw_process_step_is_op(s, "plate") || strcmp(area->id, plated) == 0 ||
        !fw_process_flow_quantity(pack->flow, plated))
        return;
    fw_diag_warning(pack->diags, 561, s->place,
                    "step %s takes '%s' for the area that it plates, and what the mask opens, with "
                    "contact ring and thief, is '%s'; the current goes with the area",
                    s->id, area->id, plated);
}

/* what is put on until it is as thick as wanted gets thicker by an overrun */
static void lint_overrun(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_law *law = fw_process_law_find(s->law);
    bool adds = false;
    for (int k = 0; k < s->nchange; k++)
        adds = adds || (strcmp(s->change[k].kind, "add") == 0 && s->change[k].thickness);
    if (!adds || !(s->overrun > 0.0) || !law || law->stated ||
        !fw_words_hold("deposit displace plate", " ", s->op))
        return;
    char share[32];
    fw_diag_error(pack->diags, 609, s->place,
                  "step %s (%s) goes on for %s %% longer than its layer takes, so that the layer "
                  "gets thicker than the flow says; write overrun=\"0\"",
                  s->id, s->op, fw_number_text(share, sizeof share, 100.0 * s->overrun, 3));
}

/* ---- its times among themselves ---- */

/* a step whose time somebody states is not shorter than what is done in it */
static void lint_within(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const fw_quantity *time = fw_process_step_argument(s, "time");
    const fw_quantity *longest = NULL;
    double sum = 0.0;
    for (int k = 0; k < s->nsetting; k++) {
        const fw_quantity *q = s->setting[k].q;
        if (q->unknown ||
            !fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_TIME) ||
            q == time)
            continue;
        sum += q->value;
        if (!longest || q->value > longest->value) longest = q;
    }
    if (!law || !law->stated || !time || time->unknown || !longest ||
        !(sum > time->value * (1.0 + 1e-9)))
        return;
    char is[32], parts[32];
    fw_diag_error(pack->diags, 609, longest->replaced ? longest->place : s->place,
                  "step %s takes %s min (%s), but the times that are set in it are %s min together "
                  "('%s' is the longest); correct one of them",
                  s->id, fw_number_text(is, sizeof is, time->value / 60.0, 4), time->id,
                  fw_number_text(parts, sizeof parts, sum / 60.0, 4), longest->id);
}

/* nobody stands for hours beside what is over in minutes */
static void lint_attended(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const fw_quantity *time = fw_process_step_argument(s, "time");
    if (!law || !law->stated || !time || time->unknown || s->pulse ||
        !(s->attended_s > time->value * (1.0 + s->overrun) + 3600.0))
        return;
    char is[32], t[32];
    fw_diag_error(pack->diags, 609, s->place,
                  "somebody stands at step %s for %s min (attended), which takes %s min (%s): more "
                  "than an hour longer; correct one of them",
                  s->id, fw_number_text(is, sizeof is, s->attended_s / 60.0, 4),
                  fw_number_text(t, sizeof t, time->value / 60.0, 4), time->id);
}

fw_status fw_process_lint_inputs(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        for (size_t k = 0; k < sizeof own / sizeof *own; k++)
            lint_own(pack, i, own[k].argument, own[k].by_chance);
        lint_opening(pack, s);
        lint_area(pack, s);
        lint_overrun(pack, s);
        lint_within(pack, s);
        lint_attended(pack, s);
    }
    return FW_OK;
}

/* ---- its tool ---- */

static bool treats(const fw_process_step *s) {
    return fw_words_hold("anodise bake coat deposit develop displace dry-etch expose "
                         "plate strip wet-etch",
                         " ", s->op);
}

/* What wafers are looked at with is no tool that treats them: a place at which more steps look than treat. An etcher in
   whose window somebody looks at the depth is none. */
static void lint_instrument(fw_process_pack *pack, int at) {
    const fw_process_step *s = &pack->flow->step[at], *looks = NULL;
    int looked = 0, treated = 0;
    if (!s->equipment || !treats(s)) return;
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *other = &pack->flow->step[i];
        if (other->equipment != s->equipment) continue;
        treated += treats(other);
        looked += fw_process_step_is_op(other, "inspect");
        if (!looks && fw_process_step_is_op(other, "inspect")) looks = other;
    }
    if (looked > treated)
        fw_diag_warning(pack->diags, 608, s->place,
                        "step %s (%s) is done at '%s' (%s), where steps as %s only look at wafers; "
                        "name the tool that does it",
                        s->id, s->op, s->equipment->id, s->equipment->class_, looks->id);
}

/* ---- its bath ---- */

/* m3 of one filling; NaN: not known */
static double filling_of(const fw_process_bath *b) {
    const fw_quantity *size = b->volume ? b->volume : b->one_part;
    double parts = 0.0;
    if (!size || size->unknown) return (double)NAN;
    if (b->volume) return size->value;
    for (int i = 0; i < b->npart; i++) {
        if (b->part[i].of->amount != FW_AMOUNT_L) continue;
        if (b->part[i].q->unknown) return (double)NAN;
        parts += b->part[i].q->value;
    }
    return parts * size->value;
}

/* A filling that serves fewer wafers than are in it at once, and one that does not cover a wafer: a millimetre of liquid is
   held by its own surface tension, less runs to one side. */
static void lint_filling(fw_process_pack *pack, const fw_process_step *s, const fw_process_use *u) {
    const double least_m = 1e-3;
    const fw_quantity *serves = u->bath->serves,
                      *wafer = fw_process_flow_quantity(pack->flow, "wafer.D"),
                      *size = u->bath->volume ? u->bath->volume : u->bath->one_part;
    const double V = filling_of(u->bath);
    char is[32], needs[32];
    if (serves && !serves->unknown && serves->value < (double)s->batch)
        fw_diag_error(pack->diags, 608, serves->replaced ? serves->place : s->place,
                      "step %s takes %d wafers at once into bath '%s', a filling of which serves "
                      "%s (%s); take fewer, or a larger filling",
                      s->id, s->batch, u->bath->id, fw_number_text(is, sizeof is, serves->value, 4),
                      serves->id);
    if (!wafer || wafer->unknown || !fw_process_step_in_liquid(s)) return;
    const double covers = least_m * 0.25 * FW_PI * wafer->value * wafer->value;
    if (V < covers)
        fw_diag_warning(pack->diags, 608, size->replaced ? size->place : s->place,
                        "step %s uses a filling of %s mL of bath '%s', which does not cover a "
                        "wafer of wafer.D: a millimetre over it are %s mL; correct the volume or "
                        "its unit",
                        s->id, fw_number_text(is, sizeof is, V * 1e6, 3), u->bath->id,
                        fw_number_text(needs, sizeof needs, covers * 1e6, 3));
}

fw_status fw_process_lint_places(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        lint_instrument(pack, i);
        for (int k = 0; k < s->nuse; k++)
            if (s->use[k].bath) lint_filling(pack, s, &s->use[k]);
    }
    return FW_OK;
}

/* ---- its plate ---- */

/* does another step print a part of the device's plate (0) or of another one through this mask? */
static bool prints(const fw_process_flow *f, const char *mask, int plate) {
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            fw_process_side side;
            if (strcmp(c->kind, "pattern") == 0 && strcmp(f->step[i].mask, mask) == 0 &&
                fw_process_where_side(f, c->where, &side) && side.plate == plate)
                return true;
        }
    return false;
}

/* A plate prints the parts that it is there for, and the device's plate structure and field. A mask that is no plate of the
   pack at all is told where the plates of the table are (FW-D412, FW-D421). */
static void lint_printed(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_flow *f = pack->flow;
    for (int k = 0; k < s->nchange && s->mask[0]; k++) {
        const fw_process_change *c = &s->change[k];
        fw_process_side side;
        int named = -1;
        if (strcmp(c->kind, "pattern") != 0 || !fw_process_where_side(f, c->where, &side)) continue;
        for (int p = 0; p < f->nplate; p++)
            if (strcmp(f->plate[p].id, s->mask) == 0) named = p + 1;
        if (named < 0 && side.plate > 0 && prints(f, s->mask, 0)) named = 0;
        if (named < 0 || named == side.plate) continue;
        fw_diag_error(pack->diags, 559, c->place,
                      "step %s exposes the part '%s', which %s%s%s draws, through mask %s; name "
                      "the mask that draws it",
                      s->id, c->where, side.plate > 0 ? "plate '" : "the device's plate",
                      side.plate > 0 ? f->plate[side.plate - 1].id : "", side.plate > 0 ? "'" : "",
                      s->mask);
    }
}

static const fw_process_step *exposed_before(const fw_process_flow *f, int before,
                                             const char *mask) {
    for (int i = 0; i < before; i++)
        if (f->step[i].mask[0] && (!mask || strcmp(f->step[i].mask, mask) == 0)) return &f->step[i];
    return NULL;
}

static void aligned(fw_process_pack *pack, const fw_process_flow *f, int at) {
    const fw_process_step *s = &f->step[at], *first = exposed_before(f, at, NULL);
    if (!s->align.to) {
        if (s->mask[0] && first && strcmp(first->mask, s->mask) != 0)
            fw_diag_error(
                pack->diags, 373, s->place,
                "step %s exposes mask %s after %s did mask %s, and does not say how it is "
                "aligned; add <align to=\"%s\" overlay=\"...\"/>",
                s->id, s->mask, first->id, first->mask, first->mask);
        return;
    }
    if (!s->mask[0])
        fw_diag_error(pack->diags, 373, s->align.place,
                      "step %s exposes no mask, so that there is nothing to align", s->id);
    else if (!exposed_before(f, at, s->align.to))
        fw_diag_error(pack->diags, 373, s->align.place,
                      "step %s aligns mask %s to '%s', which no earlier step has exposed; name a "
                      "mask that is on the wafer by then",
                      s->id, s->mask, s->align.to);
    for (int k = 0; k < s->nchange; k++)
        if (strcmp(s->change[k].kind, "pattern") == 0 && s->change[k].back != s->align.back)
            fw_diag_error(pack->diags, 373, s->align.place,
                          "step %s exposes the %s (its <change>), and aligns a plate of the %s; "
                          "write the same side in both",
                          s->id, s->change[k].back ? "back" : "front",
                          s->align.back ? "back" : "front");
}

fw_status fw_process_lint_plates(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        aligned(pack, pack->flow, i), lint_printed(pack, &pack->flow->step[i]);
    return FW_OK;
}

/* ---- what it carries to another bench ---- */

/* What etches goes on etching on its way, and drips: it is rinsed off where it stands. Water and solvents may be carried,
   as they are to a dryer. A tool that takes nothing wet says so itself (FW-D335). */
fw_status fw_process_lint_carried(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_wafer *after;
    FW_TRY(fw_process_flow_wafers(pack->arena, f, &after));
    for (int i = 1; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        const fw_process_wafer *before = &after[i - 1];
        if (!before->is[FW_STATE_WET] || !before->liquid || !fw_process_step_takes_wet(s)) continue;
        const fw_process_step *from = &f->step[before->since[FW_STATE_WET]];
        if (from->equipment == s->equipment || fw_process_only_dries(before->liquid)) continue;
        fw_diag_error(pack->diags, 606, s->place,
                      "step %s is at '%s', and the wafer comes there wet with '%s' from '%s' (step "
                      "%s): it goes on etching on the way, and drips; rinse it where it was: "
                      "<finish kind=\"rinse\"/> in step %s",
                      s->id, s->equipment ? s->equipment->id : "", before->liquid->id,
                      from->equipment ? from->equipment->id : "", from->id, from->id);
    }
    return FW_OK;
}
