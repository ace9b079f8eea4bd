/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The row of a time law: all that the program knows of it. Nobody compares kinds; who needs to know
   something of a law asks its row, and what a row leaves out (NULL, false) has the answer that is
   safe for any law. A new law is a file with its row and a line in laws.def.

   A row needs name, factor, words, attributes and value. With nothing else the law is smooth, its
   size is found by 2001 samples, steps are limited by looking at it (stride.c), and it has no
   proved bounds, so that no effect is left out because of it. */
#ifndef FW_QUANTITY_LAW_KIND_H
#define FW_QUANTITY_LAW_KIND_H
#include "quantity/quantity_law.h"
#include "quantity/quantity.h"
#include <stddef.h>

typedef enum fw_quantity_law_form {
    FW_QUANTITY_LAW_NUMBER,    /* a number; goes to the double at `offset` of fw_quantity_law */
    FW_QUANTITY_LAW_POINTS,    /* "TIME: NUMBER; ..."; goes to table_t_s, table_value, ntable */
    FW_QUANTITY_LAW_EXPRESSION /* a pure number as an expression in time; goes to program */
} fw_quantity_law_form;

/* Laws may share an attribute: its value, default and range are then the same in each, only
 * `sentence` may differ. */
typedef struct fw_quantity_law_attribute {
    const char *name;
    fw_quantity_law_form form;
    bool needed;
    size_t offset;
    fw_quantity_dimension dimension;
    const char *unit;        /* in messages and on the reference page */
    const char *si_unit;     /* in reports */
    bool whole, open;        /* a whole number; the least value itself is excluded */
    double least, most;      /* SI; both 0: any number */
    const char *reason;      /* where the range comes from */
    double absent;           /* SI: what holds where it is not given */
    const char *absent_text; /* the same in words, or NULL */
    const char *sentence;    /* without the name of the law in front and the full stop behind */
} fw_quantity_law_attribute;

typedef struct fw_quantity_law_wave { /* of what is made of sines */
    double fastest_Hz;                /* of its fastest sine; 0: it is not made of sines */
    double rad_per_s;      /* of the only sine that it is made of; 0: there are several */
    bool repeats;          /* over and over; else one pulse */
    double from_s, to_s;   /* nothing before and behind */
    double shortest_s;     /* period of the fastest sine, or how long the pulse lasts */
    const char *attribute; /* that sets the fastest frequency of what repeats */
} fw_quantity_law_wave;

typedef struct fw_quantity_law_mistake { /* "<force>: end 1 ms is not behind start 2 ms; exchange
                                            them" */
    int number;                          /* of the diagnostic (base/diagnostics.def) */
    const char *attribute, *relation, *other, *advice;
} fw_quantity_law_mistake;

typedef struct fw_quantity_law_breaks {
    double end_s, *t_s;
    int most, count;
} fw_quantity_law_breaks;
/* a time at which the law or its slope jumps; outside (0, end_s) it does not count */
static inline void fw_quantity_law_break(fw_quantity_law_breaks *b, double t_s) {
    if (!(t_s > 0 && t_s < b->end_s)) return;
    if (b->count < b->most) b->t_s[b->count] = t_s;
    b->count++;
}

struct fw_quantity_law_kind {
    const char *name;   /* as in law="..." */
    const char *factor; /* what it is, for the reference page; `attribute` in back quotes */
    const char *words;  /* in reports, behind "times a NAME": {attribute} stands for its value, and
                           what is in [] is left out where the attribute inside has the value that
                           it has when it is absent */
    const fw_quantity_law_attribute *attribute; /* (attributes) */
    int attributes;
    /* value[0..2]: factor, d/dt, d2/dt2; at a break the limit from the side of piece_s */
    void (*value)(const fw_quantity_law *law, double t_s, double piece_s, double value[3]);
    /* all times at which it or its slope jumps; NULL: there are none */
    void (*breaks)(const fw_quantity_law *law, fw_quantity_law_breaks *breaks);
    /* from when on it stays what it is; NULL: nobody knows, or it goes on for ever */
    double (*done)(const fw_quantity_law *law);
    /* largest |value| in [0, end_s], or an upper bound; NULL: by samples */
    double (*largest)(const fw_quantity_law *law, double end_s);
    /* upper bounds of slope and variation, `most` is there already; NULL: none are known */
    void (*size)(const fw_quantity_law *law, double end_s, fw_quantity_law_size *size);
    /* its total variation over (0, end_s), where samples may be too few to count it; NULL: they are
     * not */
    double (*variation)(const fw_quantity_law *law, double end_s);
    /* total variation of its slope inside (a, b), within one smooth piece; NULL: by samples */
    double (*slope_variation)(const fw_quantity_law *law, double a_s, double b_s);
    fw_quantity_law_wave (*wave)(const fw_quantity_law *law); /* NULL: it is not made of sines */
    bool stepwise;                                            /* constant between its breaks */
    bool (*straight)(
        const fw_quantity_law *law); /* linear or constant between its breaks; NULL: no */
    bool (*never_negative)(const fw_quantity_law *law); /* at any time; NULL: it may be */
    bool (*is_constant)(const fw_quantity_law *law);    /* 1 from the start on; NULL: no */
    bool (*is_ready)(const fw_quantity_law *law);       /* it has a value; NULL: yes */
    /* what is wrong among its attributes, each of which is in range; NULL: nothing can be */
    bool (*is_wrong)(const fw_quantity_law *law, fw_quantity_law_mistake *mistake);
    const char *may_be_nothing; /* the attribute that may make it 0 for a whole scene, which is
                                   worth a warning; NULL */
};

#define FW_LAW(name) extern const fw_quantity_law_kind fw_quantity_law_##name;
#include "quantity/laws.def"
#undef FW_LAW

extern const fw_quantity_law_kind *const fw_quantity_law_kinds[];   /* NULL behind the last */
const fw_quantity_law_kind *fw_quantity_law_find(const char *name); /* NULL: there is none */
double fw_quantity_law_number(const fw_quantity_law *law,
                              const fw_quantity_law_attribute *attribute);
fw_quantity_law_wave fw_quantity_law_wave_of(const fw_quantity_law *law); /* of NULL: no wave */
bool fw_quantity_law_is_straight(const fw_quantity_law *law);             /* of NULL: yes */
bool fw_quantity_law_never_negative(const fw_quantity_law *law);          /* of NULL: yes */
bool fw_quantity_law_is_ready(const fw_quantity_law *law);
/* ---- for rows ---- */

static inline bool fw_quantity_law_always(const fw_quantity_law *law) {
    (void)law;
    return true;
}

/* `end` does not lie behind `start` */
static inline bool fw_quantity_law_ends_early(const fw_quantity_law *law,
                                              fw_quantity_law_mistake *mistake) {
    *mistake = (fw_quantity_law_mistake){63, "end", "is not behind", "start", "exchange them"};
    return !(law->start_s < law->end_s);
}

/* ---- what attributes are written with ---- */

#define FW_LAW_MEMBER(member)                .offset = offsetof(fw_quantity_law, member)
#define FW_LAW_TIME                          .dimension = {.s = 1}, .unit = "ms", .si_unit = "s"
#define FW_LAW_RATE                          .dimension = {.s = -1}, .unit = "Hz", .si_unit = "Hz"
#define FW_LAW_PURE                          .unit = "1", .si_unit = ""
#define FW_LAW_RANGE(least_, most_, reason_) .least = (least_), .most = (most_), .reason = (reason_)
#define FW_LAW_ABOVE(least_, most_, reason_) FW_LAW_RANGE(least_, most_, reason_), .open = true
#define FW_LAW_ROWS(rows)                    .attribute = (rows), .attributes = (int)(sizeof(rows) / sizeof((rows)[0]))
#define FW_LAW_WITHIN_TIME                                                                         \
    FW_LAW_RANGE(0, 1e9, "a scene begins at 0, and none takes longer than 1e9 s, thirty years")
#define FW_LAW_FREQUENCY                                                                           \
    FW_LAW_RATE, FW_LAW_ABOVE(0, 1e15, "without frequency nothing swings; beyond is light")
#define FW_LAW_START                                                                               \
    {                                                                                              \
        "start", FW_LAW_MEMBER(start_s), FW_LAW_TIME, FW_LAW_WITHIN_TIME,                          \
            .absent_text = "0 ms", .sentence = "nothing before"                                    \
    }
#define FW_LAW_END                                                                                 \
    {                                                                                              \
        "end", FW_LAW_MEMBER(end_s), FW_LAW_TIME, FW_LAW_WITHIN_TIME,                              \
            .absent = HUGE_VAL, .absent_text = "never", .sentence = "nothing from then on"         \
    }
#define FW_LAW_RISE(sentence_)                                                                     \
    {                                                                                              \
        "rise", FW_LAW_MEMBER(rise_s), FW_LAW_TIME,                                                \
            .needed = true,                                                                        \
            FW_LAW_ABOVE(0, 1e9,                                                                   \
                         "a ramp that takes no time is a step; no scene takes longer than 1e9 s"), \
            .sentence = (sentence_)                                                                \
    }

#endif
