/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a lot uses up: consumables, the baths mixed from them and their prices as a pack says them, and the bill that
   follows; see process.h. */
#include "base/text.h"
#include "process/process.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

/* ---- what a pack says ---- */

static const fw_quantity_dimension number = {0}, volume = {.m = 3}, mass_in = {.m = -3, .kg = 1},
                                   amount_in = {.m = -3, .mol = 1};

static bool is_of(const fw_quantity *q, fw_quantity_dimension d) {
    return fw_quantity_dimension_equal(q->dimension, d);
}

static void want(fw_process_pack *pack, const fw_xml_record *e, const char *attribute,
                 const fw_quantity *q, fw_quantity_dimension d, const char *what) {
    if (q && !is_of(q, d))
        fw_diag_error(pack->diags, 169, fw_process_pack_get(e, attribute)->place, "'%s' is not %s",
                      q->id, what);
}

/* ---- its consumables and prices ---- */

static const char *const amount_words[] = {
    [FW_AMOUNT_L] = "L", [FW_AMOUNT_kg] = "kg", [FW_AMOUNT_PIECE] = "piece"};
static const char *const price_units[] = {
    [FW_AMOUNT_L] = "EUR/L", [FW_AMOUNT_kg] = "EUR/kg", [FW_AMOUNT_PIECE] = "EUR"};

static void read_consumable(fw_process_pack *pack, const fw_xml_record *e,
                            fw_process_consumable *c) {
    const char *unit = fw_process_pack_text(e, "unit");
    const fw_xml_attribute *hazard = fw_process_pack_get(e, "hazard");
    c->name = fw_process_pack_text(e, "name");
    if (hazard) c->hazard = fw_process_pack_find(pack, hazard, FW_ID_HAZARD);
    for (int i = 0; i < (int)(sizeof amount_words / sizeof *amount_words); i++)
        if (strcmp(amount_words[i], unit) == 0) c->amount = (fw_process_amount)i;
}

/* the quantity "ID.price" of the pack, or an unknown one that a laboratory may replace */
static fw_status price(fw_process_pack *pack, const char *of, const char *unit, fw_place place,
                       const fw_quantity **answer) {
    fw_process_flow *f = pack->flow;
    fw_quantity_unit parsed = {0};
    const char *id = fw_arena_printf(pack->arena, "%s.price", of);
    FW_NEED(id);
    fw_quantity *q = fw_process_flow_own_quantity(f, id);
    fw_quantity_unit_parse(unit, strlen(unit), &parsed, NULL, NULL);
    if (q && !is_of(q, parsed.dimension))
        fw_diag_error(pack->diags, 169, q->place,
                      "the price of '%s' has the wrong unit; write it as %s, in any currency", of,
                      unit);
    if (!q) {
        FW_NEED(q = fw_arena_one(pack->arena, fw_quantity));
        *q = (fw_quantity){.id = id,
                           .unknown = true,
                           .unit = unit,
                           .dimension = parsed.dimension,
                           .status = FW_ASSUMED,
                           .u_status = FW_ASSUMED,
                           .source = "not stated",
                           .place = place};
        f->quantity[f->nquantity++] = q;
    }
    *answer = q;
    return FW_OK;
}

static fw_status prices(fw_process_pack *pack) {
    fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nconsumable; i++) {
        fw_process_consumable *c = &f->consumable[i];
        FW_TRY(price(pack, c->id, price_units[c->amount], c->place, &c->price));
    }
    for (int i = 0; i < f->nequipment; i++)
        FW_TRY(price(pack, f->equipment[i].id, "EUR/h", f->equipment[i].place,
                     &f->equipment[i].price));
    return FW_OK;
}

/* ---- its baths ---- */

/* mass per volume of what is weighed: as it stands, or with a molar mass or a density */
static void weighed(fw_process_pack *pack, const fw_xml_record *e, fw_process_part *p) {
    const fw_quantity *molar_mass = fw_process_pack_quantity(pack, e, "molar-mass"),
                      *density = fw_process_pack_quantity(pack, e, "density");
    bool mol = is_of(p->q, amount_in), share = is_of(p->q, number);
    p->factor = mol ? molar_mass : share ? density : NULL;
    if (!mol && !share && !is_of(p->q, mass_in))
        fw_diag_error(pack->diags, 370, fw_process_pack_get(e, "q")->place,
                      "'%s' is counted in kg: a bath takes it as g/L, as mol/L or as a share by "
                      "mass, and '%s' is none of them",
                      p->of->id, p->q->id);
    if (mol != (molar_mass != NULL))
        fw_diag_error(pack->diags, 370, e->element->place,
                      mol ? "an amount of substance needs a molar-mass to be weighed"
                          : "molar-mass belongs to an amount of substance, as mol/L, only");
    if (share != (density != NULL))
        fw_diag_error(pack->diags, 370, e->element->place,
                      share ? "a share by mass needs the density of the bath to be weighed"
                            : "density belongs to a share by mass only");
    want(pack, e, "molar-mass", molar_mass, (fw_quantity_dimension){.kg = 1, .mol = -1},
         "a molar mass; write it in g/mol");
    want(pack, e, "density", density, mass_in, "a density; write it in kg/m3");
}

static void read_part(fw_process_pack *pack, const fw_xml_record *e, fw_process_bath *b) {
    const fw_xml_attribute *of = fw_process_pack_get(e, "of");
    fw_process_part p = {.of = of ? fw_process_pack_find(pack, of, FW_ID_CONSUMABLE) : NULL,
                         .q = fw_process_pack_quantity(pack, e, "q")};
    if (!p.of || !p.q) return;
    switch (p.of->amount) {
    case FW_AMOUNT_L:
        if (!is_of(p.q, number))
            fw_diag_error(pack->diags, 370, fw_process_pack_get(e, "q")->place,
                          "'%s' is a liquid: a bath takes it by parts of volume, and '%s' is no "
                          "plain number",
                          p.of->id, p.q->id);
        break;
    case FW_AMOUNT_kg:
        weighed(pack, e, &p);
        break;
    case FW_AMOUNT_PIECE:
        fw_diag_error(pack->diags, 370, of->place,
                      "'%s' is counted in pieces, and no bath is mixed from pieces; give it in L "
                      "or kg, or use it in a step",
                      p.of->id);
        break;
    }
    b->part[b->npart++] = p;
}

static fw_status read_bath(fw_process_pack *pack, const fw_xml_record *e, fw_process_bath *b) {
    b->name = fw_process_pack_text(e, "name");
    b->text = e->element->text;
    const fw_xml_attribute *hazard = fw_process_pack_get(e, "hazard");
    if (hazard) b->hazard = fw_process_pack_find(pack, hazard, FW_ID_HAZARD);
    b->volume = fw_process_pack_quantity(pack, e, "volume");
    b->one_part = fw_process_pack_quantity(pack, e, "one-part");
    b->serves = fw_process_pack_quantity(pack, e, "serves");
    b->keeps = fw_process_pack_quantity(pack, e, "keeps");
    if ((fw_process_pack_get(e, "volume") != NULL) == (fw_process_pack_get(e, "one-part") != NULL))
        fw_diag_error(pack->diags, 370, e->element->place,
                      "<bath> needs the volume of a filling, or one-part, the volume of one part");
    want(pack, e, "one-part", b->one_part, volume, "a volume; write it in mL or L");
    want(pack, e, "volume", b->volume, volume, "a volume; write it in mL or L");
    want(pack, e, "serves", b->serves, number, "a number of wafers");
    want(pack, e, "keeps", b->keeps, (fw_quantity_dimension)FW_DIM_TIME, "a time; write it in h");
    FW_NEED(b->part =
                fw_arena_array(pack->arena, fw_process_part, (size_t)fw_xml_children(e, "part")));
    for (const fw_xml_record *c = e->first_child; c; c = c->next)
        if (fw_xml_is(c, "part")) read_part(pack, c, b);
    return FW_OK;
}

/* consumables first: parts of baths are counted as they are */
fw_status fw_process_pack_baths(fw_process_pack *pack) {
    const fw_xml_record *root[] = {pack->base, pack->root};
    int bath = 0, consumable = 0;
    for (int i = 0; i < 2; i++)
        for (const fw_xml_record *e = root[i]->first_child; e; e = e->next)
            if (fw_xml_is(e, "consumable") && fw_process_pack_get(e, "id"))
                read_consumable(pack, e, &pack->flow->consumable[consumable++]);
    for (int i = 0; i < 2; i++)
        for (const fw_xml_record *e = root[i]->first_child; e; e = e->next)
            if (fw_xml_is(e, "bath") && fw_process_pack_get(e, "id"))
                FW_TRY(read_bath(pack, e, &pack->flow->bath[bath++]));
    return prices(pack);
}

/* ---- of a step, and how its mask is aligned to an earlier one ---- */

static fw_process_taker taker(const char *word) {
    return strcmp(word, "lot") == 0    ? FW_PER_LOT
           : strcmp(word, "load") == 0 ? FW_PER_LOAD
                                       : FW_PER_WAFER;
}

void fw_process_pack_use(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *s) {
    static const struct {
        fw_quantity_dimension of;
        const char *words;
    } kind[] = {[FW_AMOUNT_L] = {{.m = 3}, "a volume; write it in mL or L"},
                [FW_AMOUNT_kg] = {{.kg = 1}, "a mass; write it in g or kg"},
                [FW_AMOUNT_PIECE] = {{0}, "a number of pieces"}};
    const fw_xml_attribute *bath = fw_process_pack_get(e, "bath"),
                           *of = fw_process_pack_get(e, "consumable"),
                           *per = fw_process_pack_get(e, "per");
    const fw_quantity *q = fw_process_pack_quantity(pack, e, "q");
    if ((bath != NULL) == (of != NULL) || (of != NULL) != (fw_process_pack_get(e, "q") != NULL)) {
        fw_diag_error(pack->diags, 370, e->element->place,
                      "<uses> names a bath, or a consumable with q, how much of it is used");
        return;
    }
    if (bath && per)
        fw_diag_error(pack->diags, 370, per->place,
                      "per belongs to a consumable; how long a filling of a bath lasts is its "
                      "'serves'");
    fw_process_use u = {.bath = bath ? fw_process_pack_find(pack, bath, FW_ID_BATH) : NULL,
                        .consumable = of ? fw_process_pack_find(pack, of, FW_ID_CONSUMABLE) : NULL,
                        .q = q,
                        .per = taker(fw_process_pack_text(e, "per")),
                        .place = e->element->place};
    if (u.consumable)
        want(pack, e, "q", q, kind[u.consumable->amount].of, kind[u.consumable->amount].words);
    if (u.bath || (u.consumable && q)) s->use[s->nuse++] = u;
}

void fw_process_pack_align(fw_process_pack *pack, const fw_xml_record *e, fw_process_step *s) {
    s->align = (fw_process_align){.to = fw_process_pack_text(e, "to"),
                                  .marks = fw_process_pack_text(e, "marks"),
                                  .back = strcmp(fw_process_pack_text(e, "side"), "back") == 0,
                                  .overlay = fw_process_pack_quantity(pack, e, "overlay"),
                                  .place = e->element->place};
    want(pack, e, "overlay", s->align.overlay, (fw_quantity_dimension)FW_DIM_LENGTH,
         "a length; write it in um");
}

/* ---- the bill: cost = sum of amount x price over what the steps take for a lot ---- */

typedef struct work {
    fw_arena *arena;
    const fw_process_flow *flow;
    const int *load; /* (nstep) of a schedule; NULL: full ones */
    fw_process_bill *bill;
} work;

static double known(const fw_quantity *q) {
    return q->unknown ? (double)NAN : q->value;
}

/* "a, b" */
static fw_status append(fw_arena *arena, const char **list, const char *word) {
    if (!word) return FW_NOMEM;
    for (const char *at = *list; (at = strstr(at, word)); at++) {
        char before = at == *list ? ' ' : at[-1], after = at[strlen(word)];
        if (before == ' ' && (after == ',' || after == '\0')) return FW_OK; /* stands there */
    }
    FW_NEED(*list = fw_arena_printf(arena, "%s%s%s", *list, (*list)[0] ? ", " : "", word));
    return FW_OK;
}

static fw_status need(fw_arena *arena, const char **missing, const fw_quantity *q) {
    return q->unknown ? append(arena, missing, q->id) : FW_OK;
}

static int loads(const work *w, const fw_process_step *s) {
    const int load = fw_process_step_load(s), planned = w->load ? w->load[s - w->flow->step] : 0;
    if (fw_process_step_is_of_lot(s)) return 1;
    return planned > 0 ? planned : (w->bill->wafers + load - 1) / load;
}

/* ... each of them so often: a lot's mixing is done for every filling */
static int mixings(const work *w, const fw_process_step *s) {
    const int planned = w->load ? w->load[s - w->flow->step] : 0,
              least = fw_process_step_times(w->flow, s, w->bill->wafers);
    return planned > least && fw_process_step_mixes(w->flow, s) ? planned : least;
}

/* the row of a consumable, made where there is none yet */
static fw_process_bill_row *row_of(work *w, const fw_process_consumable *c) {
    fw_process_bill *b = w->bill;
    for (int i = 0; i < b->nrow; i++)
        if (b->row[i].consumable == c) return &b->row[i];
    b->row[b->nrow] = (fw_process_bill_row){.consumable = c, .steps = "", .missing = ""};
    return &b->row[b->nrow++];
}

/* ---- baths ---- */

static fw_process_bill_bath *bath_of(work *w, const fw_process_bath *bath) {
    fw_process_bill *b = w->bill;
    for (int i = 0; i < b->nbath; i++)
        if (b->bath[i].bath == bath) return &b->bath[i];
    b->bath[b->nbath] = (fw_process_bill_bath){.bath = bath, .steps = "", .missing = ""};
    return &b->bath[b->nbath++];
}

static double mass_per_volume(const fw_process_part *p) {
    return known(p->q) * (p->factor ? known(p->factor) : 1.0);
}

static fw_status fill(work *w, fw_process_bill_bath *row) {
    const fw_process_bath *b = row->bath;
    const fw_quantity *size = b->volume ? b->volume : b->one_part;
    double parts = 0.0;
    FW_TRY(need(w->arena, &row->missing, size));
    FW_NEED(row->part_amount = fw_arena_array(w->arena, double, (size_t)b->npart));
    for (int i = 0; i < b->npart; i++) {
        FW_TRY(need(w->arena, &row->missing, b->part[i].q));
        if (b->part[i].factor) FW_TRY(need(w->arena, &row->missing, b->part[i].factor));
        if (b->part[i].of->amount == FW_AMOUNT_L) parts += known(b->part[i].q);
    }
    double V = b->volume ? known(b->volume) : known(b->one_part) * parts;
    for (int i = 0; i < b->npart; i++)
        row->part_amount[i] = b->part[i].of->amount == FW_AMOUNT_L
                                  ? V * known(b->part[i].q) / parts
                                  : V * mass_per_volume(&b->part[i]);
    return FW_OK;
}

const fw_process_bath *fw_process_step_mixes(const fw_process_flow *flow,
                                             const fw_process_step *step) {
    for (int i = 0; i < flow->nbath && fw_process_step_is_of_lot(step); i++)
        for (int k = 0; k < step->nsetting; k++)
            if (step->setting[k].q == flow->bath[i].volume ||
                step->setting[k].q == flow->bath[i].one_part)
                return &flow->bath[i];
    return NULL;
}

int fw_process_bath_fillings(const fw_process_flow *flow, const fw_process_bath *bath, int wafers,
                             const int *load) {
    const double serves = bath->serves ? known(bath->serves) : wafers;
    int passes = 0;
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nuse; k++)
            passes += flow->step[i].use[k].bath == bath;
    int most = serves >= 1.0 ? (int)ceil(passes * (double)wafers / serves) : 0;
    for (int i = 0; load && i < flow->nstep; i++)
        if (load[i] > 1 && load[i] > most && fw_process_step_mixes(flow, &flow->step[i]) == bath)
            most = load[i];
    return most;
}

int fw_process_step_times(const fw_process_flow *flow, const fw_process_step *step, int wafers) {
    const fw_process_bath *bath = fw_process_step_mixes(flow, step);
    const int fillings =
        bath ? fw_process_bath_fillings(flow, bath, wafers < 1 ? 1 : wafers, NULL) : 1;
    return fillings > 1 ? fillings : 1;
}

/* how many fillings, and what they take of every consumable */
static fw_status close_bath(work *w, fw_process_bill_bath *row) {
    const fw_process_bath *b = row->bath;
    FW_TRY(fill(w, row));
    if (b->serves) FW_TRY(need(w->arena, &row->missing, b->serves));
    row->fillings = fw_process_bath_fillings(w->flow, b, w->bill->wafers, w->load);
    for (int i = 0; i < b->npart; i++) {
        fw_process_bill_row *r = row_of(w, b->part[i].of);
        r->amount += row->fillings > 0 ? row->fillings * row->part_amount[i] : (double)NAN;
        FW_TRY(append(w->arena, &r->steps, row->steps));
        if (isnan(r->amount) && row->missing[0])
            FW_TRY(append(w->arena, &r->missing, row->missing));
    }
    return FW_OK;
}

static fw_status baths(work *w) {
    const fw_process_flow *f = w->flow;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nuse; k++) {
            const fw_process_bath *b = f->step[i].use[k].bath;
            if (b) FW_TRY(append(w->arena, &bath_of(w, b)->steps, f->step[i].id));
        }
    for (int j = 0; j < w->bill->nbath; j++)
        FW_TRY(close_bath(w, &w->bill->bath[j]));
    return FW_OK;
}

/* ---- what steps take themselves ---- */

static double times(const work *w, const fw_process_step *s, const fw_process_use *u) {
    switch (u->per) {
    case FW_PER_WAFER:
        return w->bill->wafers;
    case FW_PER_LOAD:
        return loads(w, s);
    case FW_PER_LOT:
        return 1.0;
    }
    return (double)NAN;
}

static fw_status consumables(work *w) {
    for (int i = 0; i < w->flow->nstep; i++) {
        const fw_process_step *s = &w->flow->step[i];
        for (int k = 0; k < s->nuse; k++) {
            const fw_process_use *u = &s->use[k];
            if (!u->consumable) continue;
            fw_process_bill_row *r = row_of(w, u->consumable);
            r->amount += known(u->q) * times(w, s, u);
            FW_TRY(append(w->arena, &r->steps, s->id));
            FW_TRY(need(w->arena, &r->missing, u->q));
        }
    }
    return FW_OK;
}

/* ---- money ---- */

/* NaN where the amount or the price is not known, and then one more that is left out of the sum */
static double pay(fw_process_bill *b, const fw_quantity *price, double amount, double *sum,
                  int *without) {
    double cost = amount * known(price);
    if (!price->unknown && !b->currency) b->currency = fw_quantity_unit_currency(price->unit);
    if (isnan(cost))
        (*without)++;
    else
        *sum += cost;
    return cost;
}

static void pay_rows(fw_process_bill *b) {
    for (int i = 0; i < b->nrow; i++)
        b->row[i].cost = pay(b, b->row[i].consumable->price, b->row[i].amount, &b->consumables_cost,
                             &b->rows_without);
}

static fw_status machines(work *w) {
    fw_process_bill *b = w->bill;
    for (int i = 0; i < w->flow->nstep; i++) {
        const fw_process_step *s = &w->flow->step[i];
        int k = 0;
        if (!s->equipment) continue;
        while (k < b->nmachine && b->machine[k].equipment != s->equipment)
            k++;
        fw_process_bill_machine *m = &b->machine[k];
        if (k == b->nmachine)
            b->machine[b->nmachine++] =
                (fw_process_bill_machine){.equipment = s->equipment, .steps = ""};
        m->booked_s += s->time.computable ? s->booked_s * loads(w, s) * mixings(w, s) : (double)NAN;
        FW_TRY(append(w->arena, &m->steps, s->id));
    }
    for (int k = 0; k < b->nmachine; k++) {
        fw_process_bill_machine *m = &b->machine[k];
        m->cost = pay(b, m->equipment->price, m->booked_s, &b->machines_cost, &b->machines_without);
    }
    return FW_OK;
}

fw_status fw_process_flow_bill(fw_arena *arena, const fw_process_flow *flow, int wafers,
                               const int *load, fw_process_bill *bill) {
    work w = {arena, flow, load, bill};
    *bill = (fw_process_bill){.wafers = wafers < 1 ? 1 : wafers};
    FW_NEED(bill->bath = fw_arena_array(arena, fw_process_bill_bath, (size_t)flow->nbath));
    FW_NEED(bill->row = fw_arena_array(arena, fw_process_bill_row, (size_t)flow->nconsumable));
    FW_NEED(bill->machine =
                fw_arena_array(arena, fw_process_bill_machine, (size_t)flow->nequipment));
    FW_TRY(baths(&w));
    FW_TRY(consumables(&w));
    pay_rows(bill);
    return machines(&w);
}
