/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The working day, minute by minute against its definition. */
#include "schedule/schedule.h"
#include "test.h"
#include <stdlib.h>
#include <time.h>

static bool there(const fw_schedule_calendar *c,
                  long minute) { /* during the minute that starts now */
    long day = minute / 1440;
    double s = 60.0 * (double)(minute % 1440);
    for (int i = 0; i < c->breaks; i++)
        if (s >= c->break_s[i][0] && s < c->break_s[i][1]) return false;
    return (c->weekends || (day + (c->dated ? 5 : 0)) % 7 < 5) && s >= c->open_s && s < c->close_s;
}

static void by_minutes(void **state) {
    (void)state;
    static const char *const text[] = {"08:00-18:00", "none", "06:00-24:00", "09:30-12:00",
                                       "07:00-09:00,09:30-12:00,13:00-17:00 from 2026-11-21"};
    fw_schedule_calendar list[5]; /* the last one begins on a Saturday */
    for (int k = 0; k < 5; k++)
        assert_true(fw_schedule_calendar_parse(text[k], &list[k]));
    list[1].weekends = list[2].weekends = true;
    static const long length[] = {1, 7, 60, 149, 150, 151, 600, 601};
    for (int k = 0; k < 5; k++) {
        const fw_schedule_calendar *c = &list[k];
        long longest = k == 4 ? 240 : (long)((c->close_s - c->open_s) / 60.0);
        for (long from = 0; from < 9 * 1440; from += 97)
            for (int i = 0; i < 8; i++) {
                double got =
                    fw_schedule_calendar_fit(c, 60.0 * (double)from, 60.0 * (double)length[i]);
                long t = from, run = 0, worked = 0, end = from;
                for (; length[i] <= longest && run < length[i]; t++)
                    run = there(c, t) ? run + 1 : 0;
                if (length[i] > longest && k != 1) {
                    assert_true(isinf(got));
                } else {
                    assert_near(got, 60.0 * (double)(t - length[i]), 1e-6);
                }
                for (; worked < length[i]; end++)
                    worked += there(c, end);
                assert_near(
                    fw_schedule_calendar_worked(c, 60.0 * (double)from, 60.0 * (double)length[i]),
                    60.0 * (double)end, 1e-6);
            }
    }
}

static void parsing(void **state) {
    (void)state;
    fw_schedule_calendar c;
    assert_true(fw_schedule_calendar_parse("08:00-18:30", &c));
    assert_near(c.open_s, 28800.0, 0);
    assert_near(c.close_s, 66600.0, 0);
    assert_false(c.weekends);
    assert_true(fw_schedule_calendar_parse("none", &c) && fw_schedule_calendar_round(&c));
    assert_true(fw_schedule_calendar_parse("00:00-24:00", &c) && fw_schedule_calendar_round(&c));
    static const char *const bad[] = {"",
                                      "8:00-18:00",
                                      "08:00",
                                      "08:00-18:0",
                                      "18:00-08:00",
                                      "08:00-25:00",
                                      "08:60-18:00",
                                      "08:00-08:00",
                                      "08:00 18:00",
                                      "08:00-18:00x",
                                      "08:00-12:00,11:00-18:00",
                                      "08:00-12:00,",
                                      "08:00-18:00 from 2026-02-29",
                                      "08:00-18:00 from 2026-2-9",
                                      "none from",
                                      "08:00-18:00 from 2026-11-23T24:01",
                                      "08:00-18:00 from 2026-11-23T9:00",
                                      "08:00-18:00 from 2026-11-23 CET",
                                      "08:00-18:00 from 2026-11-23 UTC+1",
                                      "08:00-18:00 from 2026-11-23 UTC+15:00",
                                      "08:00-18:00 from 2026-11-23 UTC-12:30",
                                      "08:00-18:00 UTC",
                                      "08-18"};
    assert_true(fw_schedule_calendar_parse("none from 2024-02-29", &c));
    assert_int_equal(fw_schedule_calendar_weekday(&c, 0), 3); /* a Thursday */
    assert_true(fw_schedule_calendar_parse("08:00-18:00 from 2126-01-01", &c));
    assert_int_equal(fw_schedule_calendar_weekday(&c, 0), 1);
    long civil[3];
    fw_quantity_civil(c.first_day + 31, civil);
    assert_true(civil[0] == 2126 && civil[1] == 2 && civil[2] == 1);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_false(fw_schedule_calendar_parse(bad[i], &c));
    /* a time of the first day, and a zone */
    assert_true(fw_schedule_calendar_parse("08:00-18:00 from 2026-11-23T13:00 UTC+05:30", &c));
    assert_true(c.zoned && c.zone_min == 330);
    assert_near(fw_schedule_calendar_start(&c), 13.0 * 3600.0, 1e-9);
    assert_true(fw_schedule_calendar_parse("08:00-18:00 from 2026-11-23T07:00", &c) && !c.zoned);
    assert_near(fw_schedule_calendar_start(&c), 8.0 * 3600.0, 1e-9);
    assert_true(fw_schedule_calendar_parse("08:00-18:00 from 2026-11-23T19:00 UTC", &c));
    assert_true(c.zoned && c.zone_min == 0);
    assert_near(fw_schedule_calendar_start(&c), 32.0 * 3600.0, 1e-9); /* Tuesday morning */
    assert_true(fw_schedule_calendar_parse("none from 2026-11-23 UTC-03:30", &c));
    assert_int_equal(c.zone_min, -210);
}

/* every day of the years 1 to 9999, counted one by one by the rule of leap years */
static void centuries(void **state) {
    (void)state;
    static const int length[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    long day, first;
    assert_true(fw_quantity_date_parse("0001-01-01", &first));
    day = first;
    for (int y = 1; y <= 9999; y++)
        for (int m = 1; m <= 12; m++) {
            bool leap = (y % 4 == 0 && y % 100 != 0) || y % 400 == 0;
            for (int d = 1; d <= length[m - 1] + (m == 2 && leap); d++, day++) {
                long civil[3];
                fw_quantity_civil(day, civil);
                if (civil[0] != y || civil[1] != m || civil[2] != d)
                    fail_msg("day %ld: %ld-%ld-%ld", day, civil[0], civil[1], civil[2]);
            }
        }
    long at;
    assert_true(fw_quantity_date_parse("1970-01-01", &at) && at == 0);
    assert_true(fw_quantity_date_parse("9999-12-31", &at) && at == day - 1);
    assert_false(fw_quantity_date_parse("0000-12-31", &at));
    assert_false(fw_quantity_date_parse("1900-02-29", &at));
    static const struct {
        const char *text;
        int weekday; /* 0: Monday */
    } known[] = {{"none from 1970-01-01", 3}, {"none from 1969-07-20", 6},
                 {"none from 1900-01-01", 0}, {"none from 2000-02-29", 1},
                 {"none from 2126-11-23", 5}, {"none from 2400-02-29", 1},
                 {"none from 0001-01-01", 0}, {"none from 9998-12-31", 3}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        fw_schedule_calendar c;
        assert_true(fw_schedule_calendar_parse(known[i].text, &c) && c.dated);
        if (fw_schedule_calendar_weekday(&c, 0) != known[i].weekday) fail_msg("%s", known[i].text);
        assert_int_equal(fw_schedule_calendar_weekday(&c, 9), (known[i].weekday + 9) % 7);
    }
    fw_schedule_calendar c; /* a plan of that year could end in five digits */
    assert_false(fw_schedule_calendar_parse("none from 9999-01-01", &c));
}

/* The rule against the C library's own, hour by hour over the years of a plan: north, south of the equator, half hours,
   zones without summer, days counted through the year, changes beyond midnight. */
static void zones(void **state) {
    (void)state;
    static const char *const rules[] = {"CET-1CEST,M3.5.0,M10.5.0/3", "EST5EDT,M3.2.0,M11.1.0",
                                        "AEST-10AEDT,M10.1.0,M4.1.0/3",
                                        "<+1030>-10:30<+11>-11,M10.1.0,M4.1.0", "JST-9",
                                        "IST-1GMT0,M10.5.0,M3.5.0/1", "ABC3DEF2,J60/0,J300/26:30",
                                        "<-02>2<-01>,M3.5.0/-1,M10.5.0/0", "XYZ-3:30ZYX,59,303/4"};
    static const char *const days[] = {"2026-03-20", "2026-10-20", "2028-02-25", "2027-01-01",
                                       "2026-12-31", "2026-03-29", "2026-10-25"};
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        for (size_t k = 0; k < sizeof days / sizeof *days; k++) {
            fw_schedule_calendar c;
            char text[96];
            snprintf(text, sizeof text, "none from %s %s", days[k], rules[i]);
            if (!fw_schedule_calendar_parse(text, &c)) fail_msg("%s", text);
            setenv("TZ", rules[i], 1);
            tzset();
            struct tm first = {.tm_isdst = -1, .tm_mday = 1};
            long civil[3];
            fw_quantity_civil(c.first_day, civil);
            first.tm_year = (int)civil[0] - 1900;
            first.tm_mon = (int)civil[1] - 1;
            first.tm_mday = (int)civil[2];
            const time_t begin = mktime(&first);
            for (long hour = 0; hour < 400L * 24L; hour++) {
                const time_t at = begin + 3600 * hour + 900;
                struct tm is;
                localtime_r(&at, &is);
                const double clock = fw_schedule_calendar_clock(&c, 3600.0 * (double)hour + 900.0);
                const long minutes = lround(clock / 60.0);
                fw_quantity_civil(c.first_day + minutes / 1440, civil);
                if (civil[2] != is.tm_mday || civil[1] != is.tm_mon + 1 ||
                    minutes / 60 % 24 != is.tm_hour || minutes % 60 != is.tm_min)
                    fail_msg("%s: hour %ld is %02ld:%02ld, not %02d:%02d", text, hour,
                             minutes / 60 % 24, minutes % 60, is.tm_hour, is.tm_min);
            }
        }
    unsetenv("TZ");
    static const char *const bad[] = {"Europe/Berlin", "CET", "CE-1CEST,M3.5.0,M10.5.0",
                                      "CET-1CEST,M13.5.0,M10.5.0", "CET-1CEST,M3.5.0",
                                      "CET-1CEST,M3.6.0,M10.5.0", "CET-1CEST,M3.5.7,M10.5.0",
                                      "CET-1CEST,M3.5.0,M10.5.0/3x", "CET-25", "CET-1CEST",
                                      "<CET-1", "CET-1CEST,J0,J300", "CET-1CEST,366,12"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        fw_schedule_calendar c;
        char text[96];
        snprintf(text, sizeof text, "none from 2026-03-20 %s", bad[i]);
        if (fw_schedule_calendar_parse(text, &c)) fail_msg("%s is taken", text);
    }
}

/* people come when the clock on the wall says so; what lasts, lasts as long as ever */
static void clock_changes(void **state) {
    (void)state;
    fw_schedule_calendar c;
    const double h = 3600.0, day = 24 * h;
    assert_true(fw_schedule_calendar_parse(
        "08:00-18:00 from 2026-03-27 CET-1CEST,M3.5.0,M10.5.0/3", &c)); /* a Friday */
    assert_int_equal(c.zone_min, 60);
    assert_true(c.changes >= 2);
    assert_near(c.change_s[0], 2 * day + 2 * h, 1e-9);
    assert_near(fw_schedule_calendar_start(&c), 8 * h, 1e-9);
    assert_near(fw_schedule_calendar_fit(&c, 18 * h, 60.0), 3 * day + 7 * h, 1e-9);
    assert_near(fw_schedule_calendar_worked(&c, 8 * h, 12 * h), 3 * day + 9 * h, 1e-9);
    assert_near(fw_schedule_calendar_clock(&c, 3 * day + 7 * h), 3 * day + 8 * h, 1e-9);
    assert_near(fw_schedule_calendar_elapsed(&c, 2 * day + 2.5 * h), 2 * day + 2 * h, 1e-9);
    assert_true(fw_schedule_calendar_parse(
        "08:00-18:00 from 2026-10-23 CET-1CEST,M3.5.0,M10.5.0/3", &c));
    assert_int_equal(c.zone_min, 120);
    assert_near(fw_schedule_calendar_fit(&c, 18 * h, 60.0), 3 * day + 9 * h, 1e-9);
    assert_near(fw_schedule_calendar_elapsed(&c, 2 * day + 2.5 * h), 2 * day + 2.5 * h, 1e-9);
    /* there and back, but for the hour that is twice and the one that never is */
    for (double t = 0.0; t < 500 * day; t += 1800.0) {
        const double back = fw_schedule_calendar_elapsed(&c, fw_schedule_calendar_clock(&c, t));
        assert_true(back <= t + 1e-6 && back >= t - h - 1e-6);
        assert_near(fw_schedule_calendar_clock(&c, back), fw_schedule_calendar_clock(&c, t), 1e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(by_minutes), cmocka_unit_test(parsing),
                                       cmocka_unit_test(centuries), cmocka_unit_test(zones),
                                       cmocka_unit_test(clock_changes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
