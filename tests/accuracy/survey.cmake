# SPDX-License-Identifier: GPL-3.0-or-later
# What --accuracy promises on random devices (README.md): `accuracy_survey` writes the tables, and a
# short one is a test.
set(here ${CMAKE_CURRENT_LIST_DIR})
add_executable(accuracy_survey ${here}/survey.c ${here}/survey_table.c)
target_include_directories(accuracy_survey PRIVATE ${PROJECT_SOURCE_DIR}/tests/unit)
target_link_libraries(accuracy_survey PRIVATE fw_statics PkgConfig::CMOCKA)
add_test(NAME accuracy.survey COMMAND accuracy_survey --count 15 --seed 5001 --jobs 2)
set_tests_properties(accuracy.survey PROPERTIES LABELS "full;part" TIMEOUT 600)
add_test(NAME whole.accuracy.survey COMMAND accuracy_survey --count 60 --seed 5001 --jobs 2)
set_tests_properties(whole.accuracy.survey PROPERTIES LABELS long TIMEOUT 600)
