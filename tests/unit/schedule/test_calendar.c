/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The working day, minute by minute against its definition. */
#include "schedule/schedule.h"
#include "test.h"

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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(by_minutes), cmocka_unit_test(parsing),
                                       cmocka_unit_test(centuries)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
