/* SPDX-License-Identifier: GPL-3.0-or-later */
/* cost = sum of amount x price over what the steps take for a lot; see bill.h. */
#include "process/bill.h"
#include "base/text.h"
#include <math.h>
#include <string.h>

typedef struct work {
    fw_arena *arena;
    const fw_process_flow *flow;
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

static int loads(const fw_process_step *s, int wafers) {
    int load = fw_process_step_load(s);
    return fw_process_step_is_of_lot(s) ? 1 : (wafers + load - 1) / load;
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

/* how many fillings, and what they take of every consumable */
static fw_status close_bath(work *w, fw_process_bill_bath *row, int passes) {
    const fw_process_bath *b = row->bath;
    double serves = b->serves ? known(b->serves) : w->bill->wafers;
    FW_TRY(fill(w, row));
    if (b->serves) FW_TRY(need(w->arena, &row->missing, b->serves));
    row->fillings = serves >= 1.0 ? (int)ceil(passes * (double)w->bill->wafers / serves) : 0;
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
    for (int j = 0; j < w->bill->nbath; j++) {
        int passes = 0;
        for (int i = 0; i < f->nstep; i++)
            for (int k = 0; k < f->step[i].nuse; k++)
                passes += f->step[i].use[k].bath == w->bill->bath[j].bath;
        FW_TRY(close_bath(w, &w->bill->bath[j], passes));
    }
    return FW_OK;
}

/* ---- what steps take themselves ---- */

static double times(const fw_process_step *s, const fw_process_use *u, int wafers) {
    switch (u->per) {
    case FW_PER_WAFER:
        return wafers;
    case FW_PER_LOAD:
        return loads(s, wafers);
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
            r->amount += known(u->q) * times(s, u, w->bill->wafers);
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
        m->booked_s += s->time.computable ? s->booked_s * loads(s, b->wafers) : (double)NAN;
        FW_TRY(append(w->arena, &m->steps, s->id));
    }
    for (int k = 0; k < b->nmachine; k++) {
        fw_process_bill_machine *m = &b->machine[k];
        m->cost = pay(b, m->equipment->price, m->booked_s, &b->machines_cost, &b->machines_without);
    }
    return FW_OK;
}

fw_status fw_process_flow_bill(fw_arena *arena, const fw_process_flow *flow, int wafers,
                               fw_process_bill *bill) {
    work w = {arena, flow, bill};
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
