/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The working day, minute by minute against its definition. */
#include "schedule/schedule.h"
#include "test.h"

static bool there(const fw_schedule_calendar *c,
                  long minute) { /* during the minute that starts now */
    long day = minute / 1440;
    double s = 60.0 * (double)(minute % 1440);
    return (c->weekends || day % 7 < 5) && s >= c->open_s && s < c->close_s;
}

static void by_minutes(void **state) {
    (void)state;
    const fw_schedule_calendar list[] = {{8 * 3600.0, 18 * 3600.0, false},
                                         {0, 86400.0, true},
                                         {6 * 3600.0, 86400.0, true},
                                         {9.5 * 3600.0, 12 * 3600.0, false}};
    static const long length[] = {1, 7, 60, 149, 150, 151, 600, 601};
    for (int k = 0; k < 4; k++) {
        const fw_schedule_calendar *c = &list[k];
        long longest = (long)((c->close_s - c->open_s) / 60.0);
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
                                      "08-18"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_false(fw_schedule_calendar_parse(bad[i], &c));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(by_minutes), cmocka_unit_test(parsing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
