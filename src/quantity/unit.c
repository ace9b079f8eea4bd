/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One row per unit symbol; prefixes are spelled out, so that what is accepted can be read here. */
#include "quantity/program.h"
#include "base/constants.h"
#include "quantity/quantity.h"
#include <math.h>
#include <string.h>

#define NONE                                                                                       \
    { 0, 0, 0, 0, 0, 0, 0, 0 }
#define LENGTH                                                                                     \
    { 1, 0, 0, 0, 0, 0, 0, 0 }
#define MASS                                                                                       \
    { 0, 1, 0, 0, 0, 0, 0, 0 }
#define TIME                                                                                       \
    { 0, 0, 1, 0, 0, 0, 0, 0 }
#define RATE                                                                                       \
    { 0, 0, -1, 0, 0, 0, 0, 0 }
#define CURRENT                                                                                    \
    { 0, 0, 0, 1, 0, 0, 0, 0 }
#define TEMPERATURE                                                                                \
    { 0, 0, 0, 0, 1, 0, 0, 0 }
#define AMOUNT                                                                                     \
    { 0, 0, 0, 0, 0, 1, 0, 0 }
#define AMOUNT_RATE                                                                                \
    { 0, 0, -1, 0, 0, 1, 0, 0 }
#define ANGLE                                                                                      \
    { 0, 0, 0, 0, 0, 0, 1, 0 }
#define SPIN                                                                                       \
    { 0, 0, -1, 0, 0, 0, 1, 0 }
#define MONEY                                                                                      \
    { 0, 0, 0, 0, 0, 0, 0, 1 }
#define VOLUME                                                                                     \
    { 3, 0, 0, 0, 0, 0, 0, 0 }
#define CONCENTRATION                                                                              \
    { -3, 0, 0, 0, 0, 1, 0, 0 }
#define FORCE                                                                                      \
    { 1, 1, -2, 0, 0, 0, 0, 0 }
#define PRESSURE                                                                                   \
    { -1, 1, -2, 0, 0, 0, 0, 0 }
#define ENERGY                                                                                     \
    { 2, 1, -2, 0, 0, 0, 0, 0 }
#define POWER                                                                                      \
    { 2, 1, -3, 0, 0, 0, 0, 0 }
#define CHARGE                                                                                     \
    { 0, 0, 1, 1, 0, 0, 0, 0 }
#define VOLTAGE                                                                                    \
    { 2, 1, -3, -1, 0, 0, 0, 0 }
#define RESISTANCE                                                                                 \
    { 2, 1, -3, -2, 0, 0, 0, 0 }
#define FLUX_DENSITY                                                                               \
    { 0, 1, -2, -1, 0, 0, 0, 0 }
#define CAPACITANCE                                                                                \
    { -2, -1, 4, 2, 0, 0, 0, 0 }

/* symbol, factor to SI, offset, dimension */
#define UNIT_TABLE(X)                                                                              \
    X("1", 1.0, 0.0, NONE)                                                                         \
    X("%", 1e-2, 0.0, NONE)                                                                        \
    X("ppm", 1e-6, 0.0, NONE)                                                                      \
    X("m", 1.0, 0.0, LENGTH)                                                                       \
    X("km", 1e3, 0.0, LENGTH)                                                                      \
    X("dm", 1e-1, 0.0, LENGTH)                                                                     \
    X("cm", 1e-2, 0.0, LENGTH)                                                                     \
    X("mm", 1e-3, 0.0, LENGTH)                                                                     \
    X("um", 1e-6, 0.0, LENGTH)                                                                     \
    X("nm", 1e-9, 0.0, LENGTH)                                                                     \
    X("pm", 1e-12, 0.0, LENGTH)                                                                    \
    X("Ao", 1e-10, 0.0, LENGTH)                                                                    \
    X("kg", 1.0, 0.0, MASS)                                                                        \
    X("g", 1e-3, 0.0, MASS)                                                                        \
    X("mg", 1e-6, 0.0, MASS)                                                                       \
    X("ug", 1e-9, 0.0, MASS)                                                                       \
    X("ng", 1e-12, 0.0, MASS)                                                                      \
    X("s", 1.0, 0.0, TIME)                                                                         \
    X("ms", 1e-3, 0.0, TIME)                                                                       \
    X("us", 1e-6, 0.0, TIME)                                                                       \
    X("ns", 1e-9, 0.0, TIME)                                                                       \
    X("min", 60.0, 0.0, TIME)                                                                      \
    X("h", 3600.0, 0.0, TIME)                                                                      \
    X("Hz", 1.0, 0.0, RATE)                                                                        \
    X("kHz", 1e3, 0.0, RATE)                                                                       \
    X("MHz", 1e6, 0.0, RATE)                                                                       \
    X("GHz", 1e9, 0.0, RATE)                                                                       \
    X("N", 1.0, 0.0, FORCE)                                                                        \
    X("kN", 1e3, 0.0, FORCE)                                                                       \
    X("mN", 1e-3, 0.0, FORCE)                                                                      \
    X("uN", 1e-6, 0.0, FORCE)                                                                      \
    X("nN", 1e-9, 0.0, FORCE)                                                                      \
    X("pN", 1e-12, 0.0, FORCE)                                                                     \
    X("Pa", 1.0, 0.0, PRESSURE)                                                                    \
    X("mPa", 1e-3, 0.0, PRESSURE)                                                                  \
    X("uPa", 1e-6, 0.0, PRESSURE)                                                                  \
    X("hPa", 1e2, 0.0, PRESSURE)                                                                   \
    X("kPa", 1e3, 0.0, PRESSURE)                                                                   \
    X("MPa", 1e6, 0.0, PRESSURE)                                                                   \
    X("GPa", 1e9, 0.0, PRESSURE)                                                                   \
    X("bar", 1e5, 0.0, PRESSURE)                                                                   \
    X("mbar", 1e2, 0.0, PRESSURE)                                                                  \
    X("atm", FW_STANDARD_ATMOSPHERE_Pa, 0.0, PRESSURE)                                             \
    X("Torr", FW_STANDARD_ATMOSPHERE_Pa / 760.0, 0.0, PRESSURE)                                    \
    X("mTorr", FW_STANDARD_ATMOSPHERE_Pa / 1000.0 / 760.0, 0.0, PRESSURE)                          \
    X("J", 1.0, 0.0, ENERGY)                                                                       \
    X("kJ", 1e3, 0.0, ENERGY)                                                                      \
    X("mJ", 1e-3, 0.0, ENERGY)                                                                     \
    X("uJ", 1e-6, 0.0, ENERGY)                                                                     \
    X("nJ", 1e-9, 0.0, ENERGY)                                                                     \
    X("eV", FW_ELECTRONVOLT_J, 0.0, ENERGY)                                                        \
    X("keV", FW_KILOELECTRONVOLT_J, 0.0, ENERGY)                                                   \
    X("meV", FW_MILLIELECTRONVOLT_J, 0.0, ENERGY)                                                  \
    X("W", 1.0, 0.0, POWER)                                                                        \
    X("kW", 1e3, 0.0, POWER)                                                                       \
    X("mW", 1e-3, 0.0, POWER)                                                                      \
    X("uW", 1e-6, 0.0, POWER)                                                                      \
    X("A", 1.0, 0.0, CURRENT)                                                                      \
    X("mA", 1e-3, 0.0, CURRENT)                                                                    \
    X("uA", 1e-6, 0.0, CURRENT)                                                                    \
    X("nA", 1e-9, 0.0, CURRENT)                                                                    \
    X("V", 1.0, 0.0, VOLTAGE)                                                                      \
    X("kV", 1e3, 0.0, VOLTAGE)                                                                     \
    X("mV", 1e-3, 0.0, VOLTAGE)                                                                    \
    X("uV", 1e-6, 0.0, VOLTAGE)                                                                    \
    X("C", 1.0, 0.0, CHARGE)                                                                       \
    X("mC", 1e-3, 0.0, CHARGE)                                                                     \
    X("uC", 1e-6, 0.0, CHARGE)                                                                     \
    X("ohm", 1.0, 0.0, RESISTANCE)                                                                 \
    X("mohm", 1e-3, 0.0, RESISTANCE)                                                               \
    X("kohm", 1e3, 0.0, RESISTANCE)                                                                \
    X("Mohm", 1e6, 0.0, RESISTANCE)                                                                \
    X("F", 1.0, 0.0, CAPACITANCE)                                                                  \
    X("uF", 1e-6, 0.0, CAPACITANCE)                                                                \
    X("nF", 1e-9, 0.0, CAPACITANCE)                                                                \
    X("pF", 1e-12, 0.0, CAPACITANCE)                                                               \
    X("fF", 1e-15, 0.0, CAPACITANCE)                                                               \
    X("T", 1.0, 0.0, FLUX_DENSITY)                                                                 \
    X("mT", 1e-3, 0.0, FLUX_DENSITY)                                                               \
    X("uT", 1e-6, 0.0, FLUX_DENSITY)                                                               \
    X("K", 1.0, 0.0, TEMPERATURE)                                                                  \
    X("mK", 1e-3, 0.0, TEMPERATURE)                                                                \
    X("Cel", 1.0, FW_ICE_POINT_K, TEMPERATURE)                                                     \
    X("mol", 1.0, 0.0, AMOUNT)                                                                     \
    X("mmol", 1e-3, 0.0, AMOUNT)                                                                   \
    X("umol", 1e-6, 0.0, AMOUNT)                                                                   \
    X("kmol", 1e3, 0.0, AMOUNT)                                                                    \
    X("M", 1e3, 0.0, CONCENTRATION)                                                                \
    X("L", 1e-3, 0.0, VOLUME)                                                                      \
    X("dL", 1e-4, 0.0, VOLUME)                                                                     \
    X("cL", 1e-5, 0.0, VOLUME)                                                                     \
    X("mL", 1e-6, 0.0, VOLUME)                                                                     \
    X("uL", 1e-9, 0.0, VOLUME)                                                                     \
    X("l", 1e-3, 0.0, VOLUME)                                                                      \
    X("ml", 1e-6, 0.0, VOLUME)                                                                     \
    X("rad", 1.0, 0.0, ANGLE)                                                                      \
    X("mrad", 1e-3, 0.0, ANGLE)                                                                    \
    X("urad", 1e-6, 0.0, ANGLE)                                                                    \
    X("deg", FW_PI / 180.0, 0.0, ANGLE)                                                            \
    X("rpm", FW_PI / 30.0, 0.0, SPIN)                                                              \
    /* cm3 per minute of ideal gas at the ice point and one standard atmosphere */                 \
    X("{sccm}", FW_STANDARD_ATMOSPHERE_Pa / 1e6 / (60.0 * FW_GAS_J_PER_mol_K * FW_ICE_POINT_K),    \
      0.0, AMOUNT_RATE)                                                                            \
    /* currencies, by ISO 4217: of one dimension, at no rate (fw_quantity_unit_currency) */        \
    X("AUD", 1.0, 0.0, MONEY)                                                                      \
    X("BRL", 1.0, 0.0, MONEY)                                                                      \
    X("CAD", 1.0, 0.0, MONEY)                                                                      \
    X("CHF", 1.0, 0.0, MONEY)                                                                      \
    X("CNY", 1.0, 0.0, MONEY)                                                                      \
    X("CZK", 1.0, 0.0, MONEY)                                                                      \
    X("DKK", 1.0, 0.0, MONEY)                                                                      \
    X("EUR", 1.0, 0.0, MONEY)                                                                      \
    X("GBP", 1.0, 0.0, MONEY)                                                                      \
    X("HUF", 1.0, 0.0, MONEY)                                                                      \
    X("ILS", 1.0, 0.0, MONEY)                                                                      \
    X("INR", 1.0, 0.0, MONEY)                                                                      \
    X("JPY", 1.0, 0.0, MONEY)                                                                      \
    X("KRW", 1.0, 0.0, MONEY)                                                                      \
    X("MXN", 1.0, 0.0, MONEY)                                                                      \
    X("NOK", 1.0, 0.0, MONEY)                                                                      \
    X("NZD", 1.0, 0.0, MONEY)                                                                      \
    X("PLN", 1.0, 0.0, MONEY)                                                                      \
    X("SEK", 1.0, 0.0, MONEY)                                                                      \
    X("SGD", 1.0, 0.0, MONEY)                                                                      \
    X("TRY", 1.0, 0.0, MONEY)                                                                      \
    X("TWD", 1.0, 0.0, MONEY)                                                                      \
    X("USD", 1.0, 0.0, MONEY)                                                                      \
    X("ZAR", 1.0, 0.0, MONEY)

#define X(symbol, factor, offset, ...) symbol,
static const char *const names[] = {UNIT_TABLE(X)};
#undef X
#define X(symbol, factor, offset, ...) {factor, offset, __VA_ARGS__},
static const fw_quantity_unit rows[] = {UNIT_TABLE(X)};
#undef X
enum { UNIT_COUNT = sizeof rows / sizeof rows[0] };

const char *const *fw_quantity_unit_names(size_t *count) {
    *count = UNIT_COUNT;
    return names;
}

/* bytes of the sign of micro at symbol, as UTF-8: U+00B5, or the Greek letter U+03BC; else 0 */
static size_t micro(const char *symbol, size_t n) {
    enum { BYTES = 2 };
    return n > BYTES && (memcmp(symbol, "\xc2\xb5", BYTES) == 0 ||
                         memcmp(symbol, "\xce\xbc", BYTES) == 0)
               ? BYTES
               : 0;
}

/* most are told apart by their first byte; the sign of micro stands for u */
static const fw_quantity_unit *find(const char *symbol, size_t n) {
    size_t sign = micro(symbol, n), rest = n - sign;
    for (size_t i = 0; sign > 0 && i < UNIT_COUNT; i++)
        if (names[i][0] == 'u' && strlen(names[i]) == rest + 1 &&
            memcmp(names[i] + 1, symbol + sign, rest) == 0)
            return &rows[i];
    for (size_t i = 0; n > 0 && i < UNIT_COUNT; i++)
        if (names[i][0] == symbol[0] && strlen(names[i]) == n && memcmp(names[i], symbol, n) == 0)
            return &rows[i];
    return NULL;
}

bool fw_quantity_unit_symbol(const char *symbol, size_t n) {
    return find(symbol, n) != NULL;
}

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
static bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* length of the symbol that starts at text[0]; 0 when none can start there */
static size_t symbol_length(const char *text, size_t n) {
    if (n == 0) return 0;
    if (text[0] == '%' || (text[0] == '1' && (n == 1 || !(is_digit(text[1]) || text[1] == '.'))))
        return 1;
    if (text[0] == '{') {
        const char *end = memchr(text, '}', n);
        return end ? (size_t)(end - text) + 1 : n;
    }
    size_t i = 0;
    /* bytes above 127 belong to the symbol, so that a message shows all of a misspelt one */
    while (i < n && (is_letter(text[i]) || (unsigned char)text[i] >= 0x80))
        i++;
    return i;
}

/* exponent behind a symbol: 2, -1 (only when `minus_allowed` or after ^), ^3, ^-2; 0 bytes: none */
static size_t exponent_length(const char *text, size_t n, bool minus_allowed, int *exponent) {
    size_t i = 0;
    bool caret = n > 0 && text[0] == '^';
    if (caret) i++;
    bool minus = i < n && text[i] == '-' && (caret || minus_allowed);
    if (minus) i++;
    size_t first = i;
    int value = 0;
    while (i < n && is_digit(text[i]) && i - first < 3)
        value = 10 * value + (text[i++] - '0');
    if (i == first) return 0;
    *exponent = minus ? -value : value;
    return i;
}

bool fw_quantity_dimension_combine(fw_quantity_dimension *d, fw_quantity_dimension by, int times) {
    int8_t *const part[] = {&d->m, &d->kg, &d->s, &d->A, &d->K, &d->mol, &d->rad, &d->money};
    const int8_t add[] = {by.m, by.kg, by.s, by.A, by.K, by.mol, by.rad, by.money};
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        int sum = *part[i] + add[i] * times;
        if (sum < -127 || sum > 127) return false;
        *part[i] = (int8_t)sum;
    }
    return true;
}

/* multiplies one factor symbol^exponent into the unit; offsets only survive alone and to the 1st */
static bool multiply(fw_quantity_unit *unit, const fw_quantity_unit *row, int exponent,
                     bool first) {
    unit->offset = first && exponent == 1 ? row->offset : 0.0;
    unit->factor *= exponent == 1 ? row->factor : pow(row->factor, exponent);
    return fw_quantity_dimension_combine(&unit->dimension, row->dimension, exponent) &&
           isfinite(unit->factor) && unit->factor > 0.0;
}

static size_t skip_spaces(const char *text, size_t n, size_t i) {
    while (i < n && is_space(text[i]))
        i++;
    return i;
}

size_t fw_quantity_unit_scan(const char *text, size_t n, bool minus_allowed, fw_quantity_unit *unit,
                             const char **wrong, size_t *wrong_n) {
    *unit = (fw_quantity_unit){.factor = 1.0};
    *wrong = NULL;
    *wrong_n = 0;
    size_t done = 0; /* bytes known to belong to the unit */
    for (size_t i = 0;;) {
        bool over = false, joined = false; /* an operator came before this symbol */
        if (done > 0) {
            i = skip_spaces(text, n, done);
            joined = i > done;
            if (i < n && (text[i] == '/' || text[i] == '*' || text[i] == '.')) {
                over = text[i] == '/';
                joined = true;
                i = skip_spaces(text, n, i + 1);
            }
            if (!joined) return done;
        }
        size_t length = i < n ? symbol_length(text + i, n - i) : 0;
        const fw_quantity_unit *row = length ? find(text + i, length) : NULL;
        /* inside a chain a 1 has no business ("5 um 1"), and min( is the function */
        size_t behind = row ? skip_spaces(text, n, i + length) : 0;
        if (row && ((done > 0 && text[i] == '1') || (behind < n && text[behind] == '(')))
            row = NULL;
        if (!row) {
            *wrong = text + i;
            *wrong_n = length;
            return done;
        }
        size_t end = i + length;
        int exponent = 1;
        if (text[i] != '1' && text[i] != '%')
            end += exponent_length(text + end, n - end, minus_allowed, &exponent);
        if (!multiply(unit, row, over ? -exponent : exponent, done == 0)) {
            *wrong = text + i;
            *wrong_n = end - i;
            return 0;
        }
        done = end;
    }
}

bool fw_quantity_unit_parse(const char *text, size_t n, fw_quantity_unit *unit, const char **wrong,
                            size_t *wrong_n) {
    const char *symbol = text;
    size_t length = 0, start = skip_spaces(text, n, 0);
    size_t used = fw_quantity_unit_scan(text + start, n - start, true, unit, &symbol, &length);
    if (used > 0 && skip_spaces(text, n, start + used) == n) return true;
    if (wrong) *wrong = symbol ? symbol : text + start + used;
    if (wrong_n) *wrong_n = symbol ? length : n - start - used;
    return false;
}

/* the whole number 1/factor, or 0 where it is none */
static double whole_inverse(double factor) {
    double inverse = 1.0 / factor, whole = rint(inverse);
    return factor < 1.0 && inverse < 0x1p53 && fabs(inverse - whole) <= 1e-14 * inverse ? whole
                                                                                        : 0.0;
}

double fw_quantity_unit_to_si(const fw_quantity_unit *unit, double value) {
    double inverse = whole_inverse(unit->factor);
    return (inverse > 0.0 ? value / inverse : value * unit->factor) + unit->offset;
}

double fw_quantity_unit_from_si(const fw_quantity_unit *unit, double value) {
    double inverse = whole_inverse(unit->factor);
    value -= unit->offset;
    return inverse > 0.0 ? value * inverse : value / unit->factor;
}

const char *fw_quantity_unit_currency(const char *text) {
    size_t n = strlen(text);
    for (size_t at = 0; at < n;) {
        size_t length = symbol_length(text + at, n - at);
        for (size_t i = 0; i < UNIT_COUNT && length > 0; i++)
            if (rows[i].dimension.money != 0 && strlen(names[i]) == length &&
                memcmp(names[i], text + at, length) == 0)
                return names[i];
        at += length > 0 ? length : 1;
    }
    return NULL;
}
