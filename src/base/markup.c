/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/constants.h"
#include "base/markup.h"
#include <math.h>
#include <string.h>

/* "5.7e-05" as 5.7 times ten to a raised exponent */
static void scientific(fw_text *out, const char *number) {
    static const char *const raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    const char *e = strchr(number, 'e');
    if (!e) {
        fw_text_add(out, number);
        return;
    }
    fw_text_bytes(out, number, (size_t)(e - number));
    fw_text_add(out, "\u00d710");
    e++;
    if (*e == '-') fw_text_add(out, "\u207b");
    for (e++; *e == '0' && e[1];)
        e++;
    for (; *e >= '0' && *e <= '9'; e++)
        fw_text_add(out, raised[*e - '0']);
}

/* fw_text_fixed drops the zeros at the end; here they are put back */
static void fixed_with_zeros(fw_text *out, double value, int decimals) {
    size_t before = out->length;
    fw_text_fixed(out, value, decimals);
    if (out->failed || decimals == 0) return;
    const char *point = strchr(out->data + before, '.');
    int have = point ? (int)strlen(point + 1) : 0;
    if (!point) fw_text_add(out, ".");
    for (; have < decimals; have++)
        fw_text_add(out, "0");
}

void fw_markup_number(fw_text *out, double value, int digits) {
    if (!isfinite(value)) {
        fw_text_add(out, "\u2013");
        return;
    }
    char text[64];
    fw_number_text(text, sizeof text, fabs(value), digits);
    if (value < 0.0) fw_text_add(out, "\u2212"); /* the true minus sign */
    scientific(out, text);
}

/* `digits` significant ones, zeros at the end kept, so that columns of results line up */
static void padded(fw_text *out, double value, int digits) {
    double size = fabs(value);
    if (!(size >= 1e-4 && size < 1e4)) {
        fw_markup_number(out, value, digits);
        return;
    }
    int decimals = digits - 1;
    for (double power = 10.0; decimals > 0 && size >= power * (1.0 - 0.5 * pow(10.0, -digits));)
        power *= 10.0, decimals--;
    for (double power = 1.0;
         decimals < digits + 3 && size < power * (1.0 - 0.5 * pow(10.0, -digits));)
        power /= 10.0, decimals++;
    if (value < 0.0) fw_text_add(out, "\u2212");
    fixed_with_zeros(out, size, decimals);
}

static void append_si(fw_text *out, double value, const char *unit, int digits) {
    static const struct {
        double factor;
        const char *prefix;
    } row[] = {{1e9, "G"},       {1e6, "M"},  {1e3, "k"},   {1.0, ""},   {1e-3, "m"},
               {1e-6, "\u00b5"}, {1e-9, "n"}, {1e-12, "p"}, {1e-15, "f"}};
    enum { ROWS = sizeof row / sizeof row[0], PLAIN = 3 };
    int i = PLAIN;
    double size = fabs(value);
    if (isfinite(value) && size > 0.0)
        for (i = 0; i < ROWS - 1 && size < 0.99995 * row[i].factor;)
            i++;
    fw_markup_number(out, value / row[i].factor, digits);
    if (size > 0.0 && (unit[0] || row[i].prefix[0])) {
        fw_text_add(out, "\u00a0"); /* number and unit stay on one line */
        fw_text_add(out, row[i].prefix);
        fw_text_escaped(out, unit);
    } /* a plain 0 needs no unit */
}

static void percent(fw_text *out, double ratio) {
    double value = 100.0 * ratio;
    if (!isfinite(value) || fabs(value) >= 1e6 || fabs(value) < 0.1)
        fw_markup_number(out, value, 3);
    else {
        if (value < 0.0) fw_text_add(out, "\u2212");
        double size = fabs(value);
        fixed_with_zeros(out, size, size < 9.995 ? 2 : size < 99.95 ? 1 : 0);
    }
    fw_text_add(out, "\u00a0%");
}

static void duration(fw_text *out, double seconds) {
    if (!isfinite(seconds) || fabs(seconds) < 60.0 || fabs(seconds) >= 3.6e9) {
        append_si(out, seconds, "s", 3);
        return;
    }
    long whole = lround(fabs(seconds));
    if (seconds < 0.0) fw_text_add(out, "\u2212");
    if (whole < 7200)
        fw_text_printf(out, "%ld\u00a0min", whole / 60);
    else
        fw_text_printf(out, "%ld\u00a0h", whole / 3600);
    long rest = whole < 7200 ? whole % 60 : whole % 3600 / 60;
    if (rest) fw_text_printf(out, " %ld\u00a0%s", rest, whole < 7200 ? "s" : "min");
}

static void coordinate(fw_text *out, double value, int decimals) {
    fw_text_fixed(out, isfinite(value) ? value : 0.0, decimals);
}

static void directive(fw_text *out, char kind, va_list *arguments) {
    switch (kind) {
    case 's': {
        const char *s = va_arg(*arguments, const char *);
        fw_text_escaped(out, s ? s : "");
        break;
    }
    case 'r': {
        const char *s = va_arg(*arguments, const char *);
        fw_text_add(out, s ? s : "");
        break;
    }
    case 'i':
        fw_text_printf(out, "%d", va_arg(*arguments, int));
        break;
    case 'l':
        fw_text_printf(out, "%ld", va_arg(*arguments, long));
        break;
    case 'c': {
        double value = va_arg(*arguments, double);
        /* what lies far outside every picture must not cost a line of digits */
        coordinate(out, isfinite(value) ? fmax(-1e6, fmin(1e6, value)) : 0.0, 2);
        break;
    }
    case '1':
    case '2':
    case '3':
    case '4':
    case '6':
    case '9':
        coordinate(out, va_arg(*arguments, double), kind - '0');
        break;
    case 'n':
        fw_markup_number(out, va_arg(*arguments, double), 4);
        break;
    case 'e':
        fw_markup_number(out, va_arg(*arguments, double), 2);
        break;
    case 'u': {
        double value = va_arg(*arguments, double);
        append_si(out, value, va_arg(*arguments, const char *), 4);
        break;
    }
    case 'd':
        fw_markup_number(out, va_arg(*arguments, double) * 180.0 / FW_PI, 4);
        fw_text_add(out, "\u00b0");
        break;
    case 'D':
        padded(out, va_arg(*arguments, double) * 180.0 / FW_PI, 4);
        break;
    case 'p':
        percent(out, va_arg(*arguments, double));
        break;
    case 'h':
        duration(out, va_arg(*arguments, double));
        break;
    default:
        out->failed = 1; /* a directive that does not exist: a mistake of the caller */
    }
}

void fw_markup_part(fw_text *out, const char *format, size_t n, char quote, va_list *arguments) {
    for (const char *at = format, *end = format + n; at < end;) {
        size_t plain = 0, left = (size_t)(end - at);
        while (plain < left && at[plain] != '{' && (at[plain] != '\'' || quote == '\''))
            plain++;
        fw_text_bytes(out, at, plain);
        at += plain;
        if (at == end) return;
        if (*at == '{' && end - at > 2 && at[2] == '}') {
            directive(out, at[1], arguments);
            at += 3;
            continue;
        }
        fw_text_bytes(out, *at == '{' ? at : &quote, 1);
        at++;
    }
}

void fw_markup(fw_text *out, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fw_markup_part(out, format, strlen(format), '\'', &arguments);
    va_end(arguments);
}
