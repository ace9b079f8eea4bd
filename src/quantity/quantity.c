/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers with a dimension, in words: the names of dimensions, the unit that a misspelt one was meant to be, and
   what is known of a quantity beside its value; and what a law does to oscillators between two frequencies, and laws beside each other. */
#include "base/constants.h"
#include "base/sort.h"
#include "quantity/law_kind.h"
#include "quantity/quantity.h"
#include "base/text.h"
#include "quantity/program.h"
#include <math.h>
#include <string.h>

/* ---- dimensions ---- */

typedef struct named {
    fw_quantity_dimension dimension;
    const char *name, *unit;
    const char *si; /* in SI, where the field has a word for it; NULL: a product of base units */
} named;

/* what users of this program meet, with the unit that suits a 3 mm device */
static const named known[] = {
    {{0, 0, 0, 0, 0, 0, 0, 0}, "pure number", NULL, NULL},
    {{1, 0, 0, 0, 0, 0, 0, 0}, "length", "um", NULL},
    {{2, 0, 0, 0, 0, 0, 0, 0}, "area", "um^2", NULL},
    {{3, 0, 0, 0, 0, 0, 0, 0}, "volume", "mL", NULL},
    {{4, 0, 0, 0, 0, 0, 0, 0}, "second moment of area", "um^4", NULL},
    {{0, 1, 0, 0, 0, 0, 0, 0}, "mass", "mg", NULL},
    {{0, 0, 1, 0, 0, 0, 0, 0}, "time", "ms", NULL},
    {{0, 0, -1, 0, 0, 0, 0, 0}, "frequency", "Hz", "1/s"},
    {{0, 0, 0, 1, 0, 0, 0, 0}, "electric current", "mA", NULL},
    {{0, 0, 0, 0, 1, 0, 0, 0}, "temperature", "Cel", NULL},
    {{0, 0, 0, 0, 0, 1, 0, 0}, "amount of substance", "mol", NULL},
    {{0, 0, -1, 0, 0, 1, 0, 0}, "gas flow", "{sccm}", NULL},
    {{0, 0, 0, 0, 0, 0, 1, 0}, "angle", "deg", NULL},
    {{0, 0, -1, 0, 0, 0, 1, 0}, "angular velocity", "rad/s", "rad/s"},
    {{0, 0, -2, 0, 0, 0, 1, 0}, "angular acceleration", "rad/s^2", "rad/s^2"},
    {{1, 0, -1, 0, 0, 0, 0, 0}, "velocity", "mm/s", "m/s"},
    {{1, 0, -2, 0, 0, 0, 0, 0}, "acceleration", "m/s^2", "m/s^2"},
    {{1, 1, -2, 0, 0, 0, 0, 0}, "force", "uN", "N"},
    {{2, 1, -2, 0, 0, 0, 0, 0}, "torque or energy", "uN mm", "N m"},
    {{2, 1, -3, 0, 0, 0, 0, 0}, "power", "W", "W"},
    {{-1, 1, -2, 0, 0, 0, 0, 0}, "pressure or stress", "GPa", "Pa"},
    {{-3, 1, 0, 0, 0, 0, 0, 0}, "density", "g/cm3", "kg/m^3"},
    {{2, 1, 0, 0, 0, 0, 0, 0}, "moment of inertia", "mg mm^2", "kg m^2"},
    {{0, 1, -2, 0, 0, 0, 0, 0}, "stiffness", "N/m", "N/m"},
    {{0, 1, -1, 0, 0, 0, 0, 0}, "damping", "N s/m", "N s/m"},
    {{2, 1, -2, 0, 0, 0, -1, 0}, "torsional stiffness", "N m/rad", "N m/rad"},
    {{2, 1, -1, 0, 0, 0, -1, 0}, "torsional damping", "N m s/rad", "N m s/rad"},
    {{0, 0, 1, 1, 0, 0, 0, 0}, "electric charge", "C", "C"},
    {{-2, 0, 0, 1, 0, 0, 0, 0}, "current density", "mA/cm2", "A/m^2"},
    {{-2, 0, 1, 1, 0, 0, 0, 0}, "charge per area", "C/cm2", NULL},
    {{2, 1, -3, -1, 0, 0, 0, 0}, "voltage", "V", "V"},
    {{2, 1, -3, -2, 0, 0, 0, 0}, "electric resistance", "ohm", "ohm"},
    {{-2, -1, 4, 2, 0, 0, 0, 0}, "capacitance", "pF", "F"},
    {{0, 1, -2, -1, 0, 0, 0, 0}, "magnetic flux density", "mT", "T"},
    {{0, 1, 0, 0, 0, -1, 0, 0}, "molar mass", "g/mol", "kg/mol"},
    {{-3, 0, 0, 0, 0, 1, 0, 0}, "concentration", "mol/L", NULL},
    {{2, 1, -2, 0, 0, -1, 0, 0}, "molar energy", "kJ/mol", "J/mol"},
    {{2, 0, -1, 0, 0, 0, 0, 0}, "diffusivity", "cm2/s", NULL},
    {{0, 1, -3, 0, 0, 0, 0, 0}, "power density", "mW/cm2", "W/m^2"},
    {{0, 0, 0, 0, -1, 0, 0, 0}, "change per temperature", "K^-1", NULL},
    {{-1, 1, -1, 0, 0, 0, 0, 0}, "viscosity", "uPa s", "Pa s"},
    {{-2, 1, -2, 0, 0, 0, 0, 0}, "stress gradient", "MPa/um", "Pa/m"},
    {{0, 0, 0, 0, 0, 0, 0, 1}, "price", "EUR", NULL},
    {{-3, 0, 0, 0, 0, 0, 0, 1}, "price of a volume", "EUR/L", NULL},
    {{0, -1, 0, 0, 0, 0, 0, 1}, "price of a mass", "EUR/kg", NULL},
    {{0, 0, -1, 0, 0, 0, 0, 1}, "price of a time", "EUR/h", NULL},
};

static const named *find(fw_quantity_dimension d) {
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (fw_quantity_dimension_equal(known[i].dimension, d)) return &known[i];
    return NULL;
}

bool fw_quantity_dimension_equal(fw_quantity_dimension a, fw_quantity_dimension b) {
    return a.m == b.m && a.kg == b.kg && a.s == b.s && a.A == b.A && a.K == b.K && a.mol == b.mol &&
           a.rad == b.rad && a.money == b.money;
}

const char *fw_quantity_dimension_unit(fw_quantity_dimension d) {
    const named *row = find(d);
    return row ? row->unit : NULL;
}

/* "m s^-1": a product of base units; "": of nothing */
static const char *product(fw_arena *arena, fw_quantity_dimension d) {
    const struct {
        const char *symbol;
        int exponent;
    } part[] = {{"m", d.m}, {"kg", d.kg},   {"s", d.s},     {"A", d.A},
                {"K", d.K}, {"mol", d.mol}, {"rad", d.rad}, {"EUR", d.money}};
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, "");
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        if (part[i].exponent == 0) continue;
        fw_text_printf(&text, "%s%s", text.length ? " " : "", part[i].symbol);
        if (part[i].exponent != 1) fw_text_printf(&text, "^%d", part[i].exponent);
    }
    return fw_text_end(&text) == FW_OK ? text.data : NULL;
}

const char *fw_quantity_dimension_text(fw_arena *arena, fw_quantity_dimension d) {
    const named *row = find(d);
    const char *text = row ? row->name : product(arena, d);
    return text && text[0] ? text : "unnamed dimension";
}

const char *fw_quantity_dimension_si(fw_arena *arena, fw_quantity_dimension d) {
    const named *row = find(d);
    return row && row->si ? row->si : product(arena, d);
}

const char *fw_quantity_dimension_phrase(fw_arena *arena, fw_quantity_dimension d) {
    const char *name = fw_quantity_dimension_text(arena, d);
    const char *phrase =
        find(d) ? fw_arena_printf(arena, "%s %s", strchr("ae", name[0]) ? "an" : "a", name)
                : fw_arena_printf(arena, "a quantity in '%s'", name);
    return phrase ? phrase : name;
}

/* ---- units that were meant ---- */

/* nearest within distance 2; ties as quantity.h says */
static const char *nearest(const char *word, const char *usual) {
    size_t count;
    const char *const *names = fw_quantity_unit_names(&count), *best = NULL;
    int least = 4 * 3; /* four steps per edit, for the ties */
    for (size_t i = 0; i < count; i++) {
        int d = fw_edit_distance(word, names[i], 2);
        if (d > 2 || (size_t)d >= strlen(names[i])) continue;
        int rank = 4 * d + (names[i][0] == word[0] ? 0 : 2) +
                   (usual && strcmp(usual, names[i]) == 0 ? 0 : 1);
        if (rank < least) {
            least = rank;
            best = names[i];
        }
    }
    return best;
}

/* spellings from other habits, and what to write here */
const char *fw_quantity_unit_suggestion(const char *symbol, size_t n, const char *usual) {
    static const char *const other[][2] = {
        {"\xc2\xb5m", "um"},
        {"\xce\xbcm", "um"},
        {"\xc2\xb5N", "uN"},
        {"\xce\xbcN", "uN"},
        {"\xc2\xb5s", "us"},
        {"\xce\xbcs", "us"},
        {"\xc2\xb0", "deg"},
        {"\xc2\xb0"
         "C",
         "Cel"},
        {"\xe2\x84\xab", "Ao"},
        {"\xc3\x85", "Ao"},
        {"\xce\xa9", "ohm"},
        {"\xe2\x84\xa6", "ohm"},
        {"micron", "um"},
        {"microns", "um"},
        {"degC", "Cel"},
        {"degree", "deg"},
        {"degrees", "deg"},
        {"radian", "rad"},
        {"radians", "rad"},
        {"sec", "s"},
        {"hr", "h"},
        {"hour", "h"},
        {"sccm", "{sccm}"},
        {"Nm", "N m"},
        {"mNm", "mN m"},
        {"uNm", "uN m"},
        {"Nmm", "N mm"},
        {"mNmm", "mN mm"},
        {"uNmm", "uN mm"},
        {"Angstrom", "Ao"},
        {"angstrom", "Ao"},
        {"Ohm", "ohm"},
        {"kOhm", "kohm"},
        {"torr", "Torr"},
        {"mtorr", "mTorr"},
        {"hz", "Hz"},
        {"mpa", "MPa"},
        {"gpa", "GPa"},
        {"pa", "Pa"},
        {"n", "N"},
        {"msec", "ms"},
        {"usec", "us"},
        {"meter", "m"},
        {"metre", "m"},
        {"Kg", "kg"},
        {"KG", "kg"},
        {"MM", "mm"},
        {"v", "V"},
        {"Tesla", "T"},
        {"tesla", "T"},
    };
    for (size_t i = 0; i < sizeof other / sizeof other[0]; i++)
        if (strlen(other[i][0]) == n && memcmp(other[i][0], symbol, n) == 0) return other[i][1];
    char word[32];
    if (n == 0 || n >= sizeof word) return NULL;
    memcpy(word, symbol, n);
    word[n] = '\0';
    return nearest(word, usual);
}

/* ---- a quantity: how well it is known, in its unit, and with which others it errs ---- */

static const char *const status_text[] = {"measured", "stated", "derived", "typical", "assumed"};

const char *fw_quantity_value_status_text(fw_quantity_value_status status) {
    return status_text[status];
}

bool fw_quantity_value_status_parse(const char *text, fw_quantity_value_status *status) {
    for (int i = 0; i < 5; i++)
        if (strcmp(text, status_text[i]) == 0) {
            *status = (fw_quantity_value_status)i;
            return true;
        }
    return false;
}

bool fw_quantity_is_word(const fw_quantity *q) {
    return q->word || (q->range && strcmp(q->range, "word") == 0);
}

double fw_quantity_in_unit(const fw_quantity *q) {
    fw_quantity_unit unit;
    if (!q->unit || !fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL))
        return q->value;
    return fw_quantity_unit_from_si(&unit, q->value);
}

/* Numbers that were fitted to the same measurements have errors that go together. */

double fw_quantity_correlation(const fw_quantity *a, const fw_quantity *b) {
    for (int i = 0; b->id && i < a->ncorrelated; i++)
        if (strcmp(a->correlated[i].id, b->id) == 0) return a->correlated[i].correlation;
    return 0.0;
}

/* ---- days ---- */

/* quotient towards minus infinity, as days before 1970 need it */
static long whole(long a, long b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

/* Days since 1970-01-01, negative before it, to a date of the Gregorian calendar and back; exact for the years -5000 to
   20000. Source: Hinnant, chrono-compatible date algorithms. Test: test_calendar.c, centuries (against counting days). */
void fw_quantity_civil(long day, long civil[3]) {
    long z = day + 719468, era = whole(z, 146097), doe = z - era * 146097;
    long yoe = (doe - doe / 1460 + doe / 36524 - doe / 146096) / 365;
    long doy = doe - (365 * yoe + yoe / 4 - yoe / 100), mp = (5 * doy + 2) / 153;
    civil[1] = mp < 10 ? mp + 3 : mp - 9;
    civil[2] = doy - (153 * mp + 2) / 5 + 1;
    civil[0] = yoe + era * 400 + (civil[1] <= 2 ? 1 : 0);
}

static long day_of(long y, long m, long d) {
    y -= m <= 2;
    long era = whole(y, 400), yoe = y - era * 400,
         doy = (153 * (m + (m > 2 ? -3 : 9)) + 2) / 5 + d - 1;
    return era * 146097 + yoe * 365 + yoe / 4 - yoe / 100 + doy - 719468;
}

bool fw_quantity_date_parse(const char *text, long *day) {
    static const char shape[] = "0000-00-00";
    long part[3] = {0, 0, 0}, civil[3];
    for (int i = 0, k = 0; shape[i]; i++) {
        if (shape[i] == '-' ? text[i] != '-' : text[i] < '0' || text[i] > '9') return false;
        if (shape[i] == '-')
            k++;
        else
            part[k] = 10 * part[k] + text[i] - '0';
    }
    if (part[0] < 1 || part[1] < 1 || part[1] > 12 || part[2] < 1) return false;
    *day = day_of(part[0], part[1], part[2]);
    fw_quantity_civil(*day, civil); /* the 30th of February is another day */
    return civil[0] == part[0] && civil[1] == part[1] && civil[2] == part[2];
}

/* ---- what a law does to an oscillator of any frequency between two ---- */

enum { SWUNG_POINTS = 40, SWUNG_STEPS = 20000 };

/* largest answer; of what is so fast that steps are too many that of a slower one, still far beyond the law's own frequencies */
static double swing_of(const fw_quantity_law *law, double end_s, double omega, double damping) {
    const double fast = 8;
    if (!law) return 2; /* at once */
    const double most = fmax(FW_TURN * SWUNG_STEPS / (24 * end_s),
                             fast * FW_TURN * fw_quantity_law_wave_of(law).fastest_Hz),
                 q = fw_quantity_law_swing(law, FW_LAW_OF_LOAD, end_s, fmin(omega, most),
                                           fmin(damping, 0.99));
    return q >= 0 ? q : 2 * fw_quantity_law_largest(law, end_s);
}

void fw_quantity_law_swings_within(const fw_quantity_law *law, double end_s, double low,
                                   double high, double damping, double to[2]) {
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    const double own = wave.rad_per_s,
                 beyond = wave.fastest_Hz > 0 ? 1.5 * FW_TURN * wave.fastest_Hz
                          : fw_quantity_law_goes_to_and_fro(law, end_s) ? HUGE_VAL
                                                                        : 0,
                 rings_s = damping > 0 ? fmin(end_s, 4 / (damping * high)) : end_s,
                 fine = fmin(ceil((high - low) * rings_s / 0.5) + 1, SWUNG_POINTS),
                 n = !(high > low)  ? 0
                     : low > beyond ? 2
                                    : fine;
    to[0] = 0, to[1] = HUGE_VAL;
    for (double k = 0; k <= n; k++) {
        const double at = k < n || n < 1 ? low + (high - low) * k / fmax(n - 1, 1)
                                         : fmin(fmax(own, low), high),
                     now = swing_of(law, end_s, at, damping);
        to[0] = fmax(to[0], now), to[1] = fmin(to[1], now);
    }
}

/* ---- laws beside each other ----
   Instants at which laws stand in different ratios to each other, each where they are largest: their breaks, just before and just
   behind, where each is largest, the end, and between any two of these. In: laws (NULL: 1), value (most + 1) x n for |values|
   there. Out: how many; all false: there are more. Error: extremes by 512 looks; ratios within a thousandth are one, and what
   is below a thousandth of the largest is none. Test: test_stride.c ratios */

enum { TIMES = 256, EXTREME = 512 };

typedef struct ratios {
    const fw_quantity_law *const *law;
    int n, most, found;
    double *t_s, *value, size; /* size: largest norm */
    bool all;
} ratios;

static double norm_of(const double *x, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i] * x[i];
    return sqrt(sum);
}

static void take_ratio(ratios *r, double t_s) {
    const int n = r->n;
    double *now = r->value + (size_t)r->found * (size_t)n;
    for (int i = 0; i < n; i++) {
        double value[3] = {1, 0, 0};
        if (r->law[i]) fw_quantity_law_value(r->law[i], t_s, t_s, value);
        now[i] = fabs(value[0]);
    }
    const double size = norm_of(now, n), same = 1e-3;
    if (!isfinite(size) || !(size > same * r->size)) return;
    r->size = fmax(r->size, size);
    for (int k = 0; k < r->found; k++) {
        double *was = r->value + (size_t)k * (size_t)n, far = 0;
        const double its = norm_of(was, n);
        for (int i = 0; i < n; i++)
            far = fmax(far, fabs(now[i] / size - was[i] / its));
        if (far > same) continue;
        if (size <= its) return;
        memcpy(was, now, (size_t)n * sizeof *now);
        r->t_s[k] = t_s;
        return;
    }
    if (r->found == r->most)
        r->all = false;
    else
        r->t_s[r->found++] = t_s;
}

static double largest_at(const fw_quantity_law *law, double end_s) {
    double most = -1, at_s = end_s;
    for (int i = 1; law && i <= EXTREME; i++) {
        const double t = end_s * i / EXTREME;
        double value[3];
        fw_quantity_law_value(law, t, t * (1 - 1e-9), value);
        if (fabs(value[0]) > most) most = fabs(value[0]), at_s = t;
    }
    return at_s;
}

int fw_quantity_law_ratios(const fw_quantity_law *const *law, int n, double end_s, int most,
                           double *t_s, double *value, bool *all) {
    ratios r = {.law = law, .n = n, .most = most, .t_s = t_s, .value = value, .all = true};
    double at[TIMES], break_s[TIMES / 4];
    int count = 0;
    at[count++] = end_s * (1 - 1e-9);
    for (int i = 0; i < n; i++) {
        const int breaks = fw_quantity_law_breaks_of(law[i], end_s, break_s, TIMES / 4);
        if (breaks > TIMES / 4 || count + 2 * breaks + 1 > TIMES) r.all = false;
        for (int k = 0; k < breaks && k < TIMES / 4 && count + 3 <= TIMES; k++)
            at[count++] = break_s[k] * (1 - 1e-9), at[count++] = break_s[k] * (1 + 1e-9);
        if (count < TIMES) at[count++] = largest_at(law[i], end_s);
    }
    fw_sort_doubles(at, (size_t)count);
    for (int i = count; i-- > 0;) /* what stands longest is at the end */
        take_ratio(&r, at[i]);
    for (int i = 1; i < count; i++)
        take_ratio(&r, 0.5 * (at[i - 1] + at[i]));
    *all = r.all;
    return r.found;
}
