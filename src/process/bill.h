/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a lot uses up, and what it costs where prices are given. */
#ifndef FW_PROCESS_BILL_H
#define FW_PROCESS_BILL_H
#include "process/process.h"

typedef struct fw_process_bill_bath {
    const fw_process_bath *bath;
    int fillings;        /* for the lot; 0: not known */
    double *part_amount; /* (bath->npart) of one filling, m3 or kg; NaN: not known */
    const char *steps;   /* "S14, S21" */
    const char *missing; /* names of what is not known; "" */
} fw_process_bill_bath;

typedef struct fw_process_bill_row {
    const fw_process_consumable *consumable;
    double amount; /* for the lot: m3, kg or pieces; NaN: not known */
    double cost;   /* in the bill's currency; NaN: not known */
    const char *steps;
    const char *missing; /* of the amount; "" */
} fw_process_bill_row;

typedef struct fw_process_bill_machine {
    const fw_process_equipment *equipment;
    double booked_s; /* of all loads; NaN: a step's time is not computable */
    double cost;
    const char *steps;
} fw_process_bill_machine;

typedef struct fw_process_bill {
    int wafers;
    fw_process_bill_bath *bath;       /* (nbath) in the order in which the steps meet them */
    fw_process_bill_row *row;         /* (nrow) */
    fw_process_bill_machine *machine; /* (nmachine) */
    int nbath, nrow, nmachine;
    const char *currency; /* "EUR"; NULL: no price is known */
    /* sums of what is known, and how many rows and machines they leave out */
    double consumables_cost, machines_cost;
    int rows_without, machines_without;
} fw_process_bill;

/* A bath with parts of volume v_i takes V v_i / sum v of the liquid i for a filling of volume V, and
   V c of what is weighed, c its mass per volume: as stated, amount per volume times molar mass, or share
   by mass times the bath's density. V is stated, or one part times the sum of parts. Fillings: one
   for every step that uses it, or ceil(wafers x steps / serves). A consumable of a step is taken once a
   wafer, once for each of ceil(wafers / batch) loads, or once. Cost = amount x price, machine time =
   booked time x loads.
   flow: computed; wafers >= 1. Amounts SI, nominal: uncertainties are not carried, since bottles are
   bought and not measured; mixing is taken as ideal (volumes add). Cost O(steps x consumables). Source:
   arithmetic. Test: tests/unit/process/test_bill.c. */
fw_status fw_process_flow_bill(fw_arena *arena, const fw_process_flow *flow, int wafers,
                               fw_process_bill *bill);

#endif
