/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How something goes with time: a pure factor for loads, an angle or a length for drivers.

   Laws may jump or bend at known times (fw_quantity_law_breaks_of); integration stops there and
   goes on in the next piece. Inside a piece a law and its first two derivatives are continuous.
   `piece` is a time inside the piece that is meant, so that the value at a break is the limit from
   that side.

   What a law is, its row says (law_kind.h); laws.def lists them. */
#ifndef FW_QUANTITY_QUANTITY_LAW_H
#define FW_QUANTITY_QUANTITY_LAW_H
#include "quantity/quantity.h"

/* ---- an expression in t, compiled ---- */

typedef struct fw_quantity_program fw_quantity_program;
/* compiles `text` (n bytes) with parameters `names`; `t` (or `time`) is time in s. Where a
   parameter is called t, the bare `t` is refused (it could mean either) and the message says to
   write `time`. The dimension of the result must be `wanted`. FW_OK, FW_INPUT with *error filled,
   FW_NOMEM. */
fw_status fw_quantity_program_compile(fw_arena *arena, const char *text, size_t n,
                                      const fw_quantity_names *names, fw_quantity_dimension wanted,
                                      fw_quantity_program **program,
                                      fw_quantity_expression_error *error);
/* value[0..2]: value, d/dt, d2/dt2 (SI, exact differentiation of the expression, forward second
   order); not finite where the expression is not */
void fw_quantity_program_value(const fw_quantity_program *program, double t_s, double value[3]);
/* false when abs, min, max or atan2 of something that varies occur: the value is then only
   piecewise smooth, and fw_quantity_law_breaks_of looks for the switches */
bool fw_quantity_program_smooth(const fw_quantity_program *program);

/* ---- laws ---- */

typedef struct fw_quantity_law_kind fw_quantity_law_kind;
enum { FW_QUANTITY_LAW_OWN = 4 };

typedef struct
    fw_quantity_law { /* which of the numbers it has, and what they mean, its kind says */
    const fw_quantity_law_kind *kind;
    double start_s, end_s, rise_s, frequency_Hz, phase_rad;
    const double *table_t_s, *table_value; /* (ntable) times rise strictly */
    int ntable;
    const fw_quantity_program *program;
    double frequency_most_Hz, lines, seed; /* random; the last two are whole */
    double held_s; /* from then on it stays what it is, whatever its kind says; 0: it goes on */
    double own[FW_QUANTITY_LAW_OWN]; /* of laws to which none of the numbers above belongs */
} fw_quantity_law;

const char *fw_quantity_law_name(const fw_quantity_law *law); /* "ramp" */
/* value[0..2]: the factor or coordinate, d/dt, d2/dt2 */
void fw_quantity_law_value(const fw_quantity_law *law, double t_s, double piece_s, double value[3]);
/* a copy of the law that stays from an instant on what it is there; NULL stays NULL, and NULL, too, without memory */
const fw_quantity_law *fw_quantity_law_hold(fw_arena *arena, const fw_quantity_law *law,
                                            double held_s);
/* it stays behind an instant what it is there (NULL: it does) */
bool fw_quantity_law_rests(const fw_quantity_law *law, double from_s);
/* times in (0, end_s) where the law or its slope jumps, ascending; at most `most` are stored.
   Returns how many there are. Expressions: switches of abs, min and max as far as 2000 samples show
   them, located to round-off, at most 1000. NULL, no law, has none. */
int fw_quantity_law_breaks_of(const fw_quantity_law *law, double end_s, double *t_s, int most);
/* constant 1 from the start on: what a load without a law (NULL) has */
bool fw_quantity_law_is_constant(const fw_quantity_law *law);
/* largest |value| in [0, end_s]: exact, but for random an upper bound (within 2 % in short scenes,
   the top of the envelope in long ones) and for expressions the largest of 2001 samples; infinite
   where a sample is not finite. 1 without a law (NULL). */
double fw_quantity_law_largest(const fw_quantity_law *law, double end_s);
/* instants at which n laws (NULL: 1) stand in different ratios, each where they are largest: at most `most`, and
   |values| there, (most + 1) x n; *all false: these are not all */
int fw_quantity_law_ratios(const fw_quantity_law *const *law, int n, double end_s, int most,
                           double *t_s, double *value, bool *all);
/* of a law over (0, end_s): largest |value|, largest |slope| (1/s), total variation from 0 before
   the start on; of a constant 1, 0, 1. Upper bounds, of expressions by intervals; infinite where there is none */
typedef struct fw_quantity_law_size {
    double most, slope, variation;
} fw_quantity_law_size;
fw_quantity_law_size fw_quantity_law_measure(const fw_quantity_law *law, double end_s);
/* What a law sets ringing at omega, rad/s, over what it does at rest, at most: its jumps and, over omega,
   those of its slope and the slope's variation between them. Of a load, which nothing was before the
   start, or of a coordinate, which has the value it begins with. An estimate: of a law that is neither
   straight nor knows how its slope varies, by midpoints of 256 cells. 1: it comes at once (NULL, too) */
double fw_quantity_law_jolt(const fw_quantity_law *law, bool coordinate, double end_s,
                            double omega_per_s);

/* What a load with this law sets ringing at omega, rad/s, besides its jumps: over the furthest that it goes from its first
   value, which it has at *at_s. By parts once or twice, at most

     min(variation, (jumps and variation of the slope)/omega)

   and 0 of what jumps only; above 1 where it goes to and fro. Infinite: nothing bounds it. An estimate where
   fw_quantity_law_jolt is one. Test: test_time_law.c rings */
double fw_quantity_law_rings(const fw_quantity_law *law, double end_s, double omega_per_s,
                             double *at_s);

/* What a coordinate that follows this law does to what hangs on it, which is at rest before: by its acceleration a, which
   is a load of its own, and by jumps of its speed, that from rest at the start among them. With V, J the variation of a
   between breaks and its jumps, V', J' those of its slope, by 1024 cells of the scene, 24 to a period of a law of sines

     rings = (J + min(V, (J' + V')/omega))/most,   most = max|a|, first at at_s

   blows: the sum of all |jumps of the speed|. In: s, rad/s; out: 1/s^2, s, 1, 1/s times the law's unit; infinite beyond 64
   breaks. An estimate where cells miss something. Source: Duhamel's integral by parts. Test: test_time_law.c shakes */
typedef struct fw_quantity_law_shaking {
    double most, at_s, rings, blows;
} fw_quantity_law_shaking;
fw_quantity_law_shaking fw_quantity_law_shakes(const fw_quantity_law *law, double end_s,
                                               double omega_per_s);

/* When a law of which something acts within the scene has come to where it stays: a pulse or a table may do so behind the
   scene's end. The scene's end of one that is done before, or of which nobody knows when it is */
double fw_quantity_law_done_s(const fw_quantity_law *law, double end_s);

/* Largest |q| at any time of q'' + w^2 q = w^2 f(t), f the law, without damping and at rest before, for every w of
   [low, high], rad/s: what a load with this law does to a mode at most, over what it does at rest. A device goes on ringing
   where a scene ends: f is all of the law where it comes to rest (fw_quantity_law_done_s); others act until end_s and stay
   what they are there, or, where they repeat, stop. By parts twice

     |q - f| <= min(variation of f, jumps of f + (jumps and variation of f')/w)

   Of what is straight between breaks, and of a half wave in 128 straight cells whose error is added, by exact steps, with the
   turns within each, and |f| + (q - f, q'/w) behind the last, at frequencies between which the integral of (T - t)|df|, T
   when it is done, bounds what changes: 2 % apart, or as far as 1e5 cells allow; never below the truth. Of other waves,
   where by parts is more than twice max|f|, as at resonance, by exact steps of f that is linear between samples, 24 to a
   period of what is fastest, at frequencies that lie half a radian apart at the end; 1.03 times that, which covers what is
   between (1.9 % and 0.3 %); beyond 4e6 steps by parts. Infinite: nothing bounds the law. Source: Duhamel's integral.
   Test: test_time_law.c answers, answers_behind_the_end */
typedef struct fw_quantity_law_response {
    double most;   /* |q|: what gives bears that */
    double far;    /* |q| (low/w)^2: how far it goes, over what it does at rest at low */
    double behind; /* |q - f|: how fast it is accelerated, over w^2 */
} fw_quantity_law_response;
fw_quantity_law_response fw_quantity_law_responds(const fw_quantity_law *law, double end_s,
                                                  double low_per_s, double high_per_s);
/* s: the integral of |f| at most, of a law that is over behind what it does; infinite: it never is, or nobody knows */
double fw_quantity_law_impulse_s(const fw_quantity_law *law, double end_s);
double fw_quantity_law_answer(const fw_quantity_law *law, double end_s, double low_per_s,
                              double high_per_s); /* .most of it */

/* Largest |q| of q'' + 2 damping w q' + w^2 q = w^2 g(t), at rest before, by exact steps of g that is linear between 24
   samples to a period of w or of what the law is made of; below by 2 % at most. g: the law of a load, its square for
   one that goes with the square of a voltage. Of a coordinate |q| is how far what hangs on it is behind: q'' + 2 damping
   w q' + w^2 q = -f''(t). damping: share of the critical one, < 1. -1: beyond 4e6 steps. Test: test_time_law.c swings */
typedef enum fw_quantity_law_acts {
    FW_LAW_OF_LOAD,
    FW_LAW_SQUARED,
    FW_LAW_OF_COORDINATE
} fw_quantity_law_acts;
double fw_quantity_law_swing(const fw_quantity_law *law, fw_quantity_law_acts as, double end_s,
                             double omega_per_s, double damping);
/* Its largest and its least (FW_LAW_OF_LOAD) at any frequency between two: to[0], to[1]. Half a radian apart at the end of what
   rings, at most 40 of them, and where the law's own lies between; behind one and a half times the fastest of these, or of a law that
   does not go to and fro, at both ends. Of an oscillator so fast that steps are too many that of a slower one, eight times as
   fast as the law */
void fw_quantity_law_swings_within(const fw_quantity_law *law, double end_s, double low_per_s,
                                   double high_per_s, double damping, double to[2]);
/* It goes to and fro more often than once: what it varies by beyond one way there and back is more than a quarter of its
   range, by 2001 samples of it. True of a law whose variation nothing bounds */
bool fw_quantity_law_goes_to_and_fro(const fw_quantity_law *law, double end_s);

/* By how much x'' + 2 damping w x' + w^2 (1 + share f(t)) x = 0 may grow within the scene, f the law over its largest value:
   Stoermer's steps, 24 to a period of w or of the law, from either start */
double fw_quantity_law_pumps(const fw_quantity_law *law, bool squared, double end_s, double most,
                             double omega_per_s, double damping, double share);
double fw_quantity_law_root_mean_square(const fw_quantity_law *law, double end_s);

/* of a coordinate: where it begins, and the farthest from there of its breaks and 2001 looks; false: it stays */
bool fw_quantity_law_goes(const fw_quantity_law *law, double end_s, double *from, double *to);

typedef struct fw_quantity_law_load { /* law NULL: there from the start on */
    const fw_quantity_law *law;
    double size;
    bool squared; /* of a voltage, by whose square it acts */
    double from; /* value of the law at which it does nothing: of a coordinate, where that begins */
    bool
        coordinate; /* what it prescribes goes where it says, and what hangs on it is left behind */
} fw_quantity_law_load;

/* Between breaks of any of them all laws of loads are smooth; a step of at most step_s sees them there, infinite where
   all are straight. FW_OK or FW_NOMEM */
typedef struct fw_quantity_law_pieces {
    double *end_s, *step_s; /* (n) ascending, the last end is that of the scene */
    int n;
} fw_quantity_law_pieces;
fw_status fw_quantity_law_pieces_of(fw_arena *arena, const fw_quantity_law_load *load, int n,
                                    double end_s, fw_quantity_law_pieces *pieces);

/* Oscillators under all loads together, at several frequencies at a time: what acts is evaluated once for these */
enum { FW_QUANTITY_OSCILLATORS = 24, FW_QUANTITY_LANES = 8 };
typedef struct fw_quantity_law_loads {
    const fw_quantity_law_load *load;
    int n, held; /* held: the last ones, whose sizes no scale changes */
    const fw_quantity_law_pieces *pieces;
} fw_quantity_law_loads;
typedef struct fw_quantity_law_oscillator {
    double damping, start_per_s; /* damping: share of the critical one, < 1 */
    const double *size;          /* of every load, in place of its own */
    double omega_per_s[FW_QUANTITY_LANES], scale[FW_QUANTITY_LANES]; /* scale: of the sizes */
} fw_quantity_law_oscillator;
typedef struct fw_quantity_law_row { /* what it is at the begin and at the end of a step */
    double q[2][FW_QUANTITY_LANES], v[2][FW_QUANTITY_LANES], less[2][FW_QUANTITY_LANES];
} fw_quantity_law_row;

/* What is looked at: row i is the sum of by[i * oscillators + k] q_k less that of less[i * loads + j] (f_j - from_j); behind:
   of how far each is from where its loads would hold it, in place of q_k */
typedef struct fw_quantity_law_seen {
    const double *by, *less;  /* less: NULL, nothing */
    double *most;             /* (n, lanes) the largest |row| */
    fw_quantity_law_row *row; /* (n) for its own use */
    int n;
    bool behind;
} fw_quantity_law_seen;
/* q'' + 2 damping w q' + w^2 q = w^2 sum of size_j (f_j - from_j) of every oscillator, from q = 0 and q' = start_per_s on.
   Exact steps of what is straight between 24 samples to a period of the fastest, or of what laws are made of, 12 where all
   laws are straight; of one oscillator alone such a piece is one step between its first and its last period. Between samples
   the cubic through values and rates: 1e-4 of a swing at most. Returns the steps that it took; -1: beyond 4e6, most is not
   known. Cost of a step at one frequency: 10 ns for one oscillator, of several what rows times oscillators take, and an eighth of the laws.
   Test: test_time_law.c swings_of_several, swings_side_by_side */
double fw_quantity_law_swings_of(const fw_quantity_law_loads *loads,
                                 const fw_quantity_law_oscillator *oscillator, int oscillators,
                                 fw_quantity_law_seen *seen);
/* of loads of these sizes no |q| is larger than that, from rest, whatever w is; infinite: nothing bounds a law */
double fw_quantity_law_bound_of(const fw_quantity_law_load *load, const double *size, int n,
                                double end_s);
/* Something may come again while a mode still rings by what came before: loads that do not all have one course, a
   law of more than two breaks, or one that rests between two changes (2000 samples). Of a coordinate, which leaves what
   hangs on it behind whenever its rate changes, two such changes, the start among them */
bool fw_quantity_law_come_again(const fw_quantity_law_load *load, int n, double end_s);

/* ---- steps that see all of it (stride.c) ---- */

typedef struct
    fw_quantity_law_strides { /* from t_s[i] on a step longer than most_s[i] may miss something */
    double *t_s, *most_s;     /* (n) ascending; most_s may be infinite */
    int n;                    /* 0: any step sees all of it */
} fw_quantity_law_strides;
/* Looks at the law once over [0, end_s], which sines, steps, ramps and tables do not need.
   `break_s` (breaks), ascending: its fw_quantity_law_breaks_of, at which steps end anyway.
   coordinate: the law drives a joint, so that its second derivative counts. FW_OK or FW_NOMEM. Not
   seen is what is zero to the last bit at 2049 looks (a bell exp(-(t/w)^2) with w below some 1e-5
   end_s), and what is shorter than a look beside larger things. */
fw_status fw_quantity_law_look(fw_arena *arena, const fw_quantity_law *law, bool coordinate,
                               double end_s, const double *break_s, int breaks,
                               fw_quantity_law_strides *strides);
/* longest step from t_s on that does not leap over anything, with every stride `factor` times as
   long; *row (0 at first) remembers where the search stood */
double fw_quantity_law_stride(const fw_quantity_law_strides *strides, double factor, double t_s,
                              int *row);

#endif
