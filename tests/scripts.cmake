# SPDX-License-Identifier: GPL-3.0-or-later
# Tests that run programs: each is one ctest entry. `quick` are those of ./test --quick.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(FW_PROGRAM $<TARGET_FILE:flexwright>)

function(fw_script_test name)
    cmake_parse_arguments(ARG "" "TIMEOUT;LABEL" "COMMAND" ${ARGN})
    add_test(NAME ${name} COMMAND ${ARG_COMMAND} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    if(NOT ARG_TIMEOUT)
        set(ARG_TIMEOUT 300)
    endif()
    if(NOT ARG_LABEL)
        set(ARG_LABEL full)
    endif()
    if(ARG_LABEL STREQUAL quick)
        string(REGEX MATCHALL "TARGET_FILE:[a-z_]+" programs "${ARG_COMMAND}")
        list(TRANSFORM programs REPLACE "TARGET_FILE:" "")
        set_property(GLOBAL APPEND PROPERTY FW_QUICK_SCRIPTS ${programs})
    endif()
    set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS ${ARG_LABEL})
endfunction()

# a first part, and as whole.NAME, of ./test --all, everything
function(fw_first_part_of name)
    cmake_parse_arguments(ARG "" "" "COMMAND;FIRST;WHOLE" ${ARGN})
    fw_script_test(${name} COMMAND ${ARG_COMMAND} ${ARG_FIRST} TIMEOUT 600)
    set_property(TEST ${name} APPEND PROPERTY LABELS part)
    fw_script_test(whole.${name} LABEL long COMMAND ${ARG_COMMAND} ${ARG_WHOLE} TIMEOUT 600)
endfunction()

fw_script_test(arch.rooms LABEL quick COMMAND ${Python3_EXECUTABLE} tests/arch/rooms.py)
fw_script_test(arch.circles LABEL quick COMMAND ${Python3_EXECUTABLE} tests/arch/circles.py ${PROJECT_BINARY_DIR})
fw_script_test(arch.constants LABEL quick COMMAND ${Python3_EXECUTABLE} tests/arch/constants.py)
# a law, an effect and a format that the program does not have, each one file and one row
fw_script_test(arch.additions TIMEOUT 600 COMMAND ${Python3_EXECUTABLE} tests/arch/additions.py ${PROJECT_BINARY_DIR})
set_tests_properties(arch.additions PROPERTIES RUN_SERIAL ON)
fw_script_test(arch.names LABEL quick COMMAND ${Python3_EXECUTABLE} tests/arch/names.py)
fw_script_test(library.symbols LABEL quick COMMAND ${Python3_EXECUTABLE} tests/build/symbols.py
               $<TARGET_FILE:flexwright_library>)
fw_script_test(library.state LABEL quick COMMAND ${Python3_EXECUTABLE} tests/build/state.py ${PROJECT_BINARY_DIR})
fw_script_test(cli.program COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_program.py ${FW_PROGRAM} TIMEOUT 1200)
fw_script_test(cli.advice COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_advice.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(cli.fitted COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_fitted.py ${FW_PROGRAM})
fw_script_test(cli.study COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_study.py ${FW_PROGRAM} TIMEOUT 1200)
fw_script_test(cli.sizing COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_sizing.py ${FW_PROGRAM} TIMEOUT 3600)
# a cluster of one node; what needs none is tried first, and 77 says that there is no Slurm
fw_script_test(cli.slurm COMMAND ${Python3_EXECUTABLE} tests/cli/test_slurm.py ${FW_PROGRAM} TIMEOUT 300)
set_tests_properties(cli.slurm PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(cli.near_pull_in COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_near_pull_in.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(cli.measurements COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_measurements.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(cli.inputs COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_inputs.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(cli.benchmarks COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_benchmarks.py ${FW_PROGRAM})
fw_script_test(cli.rest COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_rest.py ${FW_PROGRAM})
fw_script_test(cli.heated COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_heated.py ${FW_PROGRAM} TIMEOUT 900)
fw_script_test(cli.workspace COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_workspace.py ${FW_PROGRAM} TIMEOUT 900)
fw_script_test(cli.assemble COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_assemble.py ${FW_PROGRAM})
fw_script_test(cli.shapes COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_shapes.py ${FW_PROGRAM})
fw_script_test(cli.frames COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_frames.py ${FW_PROGRAM})
fw_script_test(cli.out_of_plane COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_out_of_plane.py ${FW_PROGRAM} TIMEOUT 900)
fw_script_test(cli.stiction COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_stiction.py ${FW_PROGRAM})
fw_script_test(cli.large COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_large.py ${FW_PROGRAM})
fw_script_test(cli.apart COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_apart.py ${FW_PROGRAM})
fw_script_test(cli.unsymmetric COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_unsymmetric.py ${FW_PROGRAM})
fw_script_test(cli.probe COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_probe.py ${FW_PROGRAM} TIMEOUT 900)
fw_script_test(cli.friction_range COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_friction_range.py ${FW_PROGRAM} TIMEOUT 900)
fw_script_test(cli.effects COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_effects.py ${FW_PROGRAM} TIMEOUT 900)
fw_script_test(cli.bars COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_bars.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(cli.schedule COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_schedule.py ${FW_PROGRAM})
fw_script_test(cli.flowback COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_flowback.py ${FW_PROGRAM})
fw_script_test(cli.limits COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_limits.py ${FW_PROGRAM})
fw_script_test(cli.tradeoff COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_tradeoff.py ${FW_PROGRAM})
fw_script_test(cli.hinge COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_hinge.py ${FW_PROGRAM})
fw_script_test(cli.pictures COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_pictures.py ${FW_PROGRAM})
fw_script_test(cli.marked COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_marked.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(cli.reproducible COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_reproducible.py ${FW_PROGRAM})
fw_script_test(cli.third_flow COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_third_flow.py ${FW_PROGRAM})
fw_script_test(cli.sections COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_sections.py ${FW_PROGRAM})
fw_script_test(cli.violations COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_violations.py ${FW_PROGRAM})
fw_script_test(cli.mask_certificate COMMAND ${Python3_EXECUTABLE} tests/cli/test_mask_certificate.py ${FW_PROGRAM})
fw_script_test(cli.manners COMMAND ${Python3_EXECUTABLE} tests/turn.py tests/cli/test_manners.py ${FW_PROGRAM})
fw_script_test(fault.files COMMAND ${Python3_EXECUTABLE} tests/faults/test_faults.py ${FW_PROGRAM})
fw_script_test(accept.masks COMMAND tests/accept/gallery.sh ${FW_PROGRAM} TIMEOUT 600)
# random devices before beams of their own: tests/judge/README.md says how to ask for many
fw_script_test(judge.self LABEL quick COMMAND ${Python3_EXECUTABLE} tests/judge/self_test.py $<TARGET_FILE:judge>
               tests/data/hinge)
# every step of the packs left out, every pair exchanged: docs/process-orders.md
fw_script_test(process.orders COMMAND ${Python3_EXECUTABLE} tests/process/orders.py $<TARGET_FILE:lint_packs>)
# every quantity of the packs with values that nobody can mean
fw_script_test(process.absurd COMMAND ${Python3_EXECUTABLE} tests/process/absurd.py $<TARGET_FILE:lint_packs>)
fw_script_test(process.coupons COMMAND ${Python3_EXECUTABLE} tests/process/coupons.py)
# a seed is the same device on every machine; what a long run says is in tests/judge/README.md
fw_first_part_of(judge.random COMMAND ${Python3_EXECUTABLE} tests/judge/judge.py --judge $<TARGET_FILE:judge>
                 --program ${FW_PROGRAM} --seed 7001 FIRST --count 10 WHOLE --count 24)
# required poses held by the judge's beams
fw_first_part_of(judge.poses COMMAND ${Python3_EXECUTABLE} tests/judge/poses.py --judge $<TARGET_FILE:judge>
                 --program ${FW_PROGRAM} --seed 5 FIRST --count 1 WHOLE --count 12)
# the same against springs, weight and contacts
fw_first_part_of(judge.given COMMAND ${Python3_EXECUTABLE} tests/judge/poses.py --judge $<TARGET_FILE:judge>
                 --program ${FW_PROGRAM} --given --seed 22 FIRST --count 1 WHOLE --count 12)
# clearances of random devices against GEOS; a longer run is in tests/clearance/README.md
fw_script_test(clearance.random COMMAND /usr/bin/python3 tests/clearance/compare.py
               $<TARGET_FILE:clearance_outlines> --seed 1 --count 6)
set_tests_properties(clearance.random PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(clearance.combs COMMAND /usr/bin/python3 tests/clearance/compare.py
               $<TARGET_FILE:clearance_outlines> --seed 1 --count 3 --combs)
set_tests_properties(clearance.combs PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(clearance.gaps COMMAND /usr/bin/python3 tests/clearance/gaps.py
               $<TARGET_FILE:clearance_outlines> --seed 1 --count 6)
set_tests_properties(clearance.gaps PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(clearance.between COMMAND ${Python3_EXECUTABLE} tests/clearance/between.py
               $<TARGET_FILE:clearance_outlines>)
# stators over required poses, against a search of our own; nothing loose and all held, in every flow
fw_script_test(clearance.stators COMMAND /usr/bin/python3 tests/clearance/stators.py
               $<TARGET_FILE:clearance_outlines> ${FW_PROGRAM} 801 1)
fw_script_test(accept.held COMMAND /usr/bin/python3 tests/accept/held.py ${FW_PROGRAM} 6001 10)
set_tests_properties(clearance.stators accept.held PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(clearance.cases COMMAND ${Python3_EXECUTABLE} tests/clearance/cases.py ${FW_PROGRAM})
fw_script_test(judge.examples COMMAND ${Python3_EXECUTABLE} tests/judge/examples.py ${FW_PROGRAM})
fw_script_test(judge.frequencies COMMAND ${Python3_EXECUTABLE} tests/judge/frequencies.py ${FW_PROGRAM} $<TARGET_FILE:judge>)
fw_script_test(accept.selftest COMMAND tests/accept/selftest.py ${FW_PROGRAM})
fw_script_test(release.distances COMMAND tests/release/distances.py ${FW_PROGRAM} 1 5 TIMEOUT 900)
set_tests_properties(release.distances PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(accept.nets COMMAND ${Python3_EXECUTABLE} tests/accept/nets.py ${FW_PROGRAM})
fw_script_test(accept.shapes COMMAND /usr/bin/python3 tests/accept/random_shapes.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(accept.random COMMAND tests/accept/random_masks.py ${FW_PROGRAM} TIMEOUT 600)
# width and space as written before KLayout's, in both directions; with FW_TEST_ALL=1 24 devices
fw_script_test(accept.written COMMAND tests/accept/written_rules.py ${FW_PROGRAM} TIMEOUT 600)
# the package for KLayout; its rules before the program's on random devices (FW_DRC_COUNT=200: many)
fw_script_test(klayout.package COMMAND /usr/bin/python3 tests/klayout/test_package.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(klayout.rules COMMAND /usr/bin/python3 tests/klayout/rules.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(klayout.gdspy COMMAND /usr/bin/python3 tests/klayout/gdspy_cell.py ${FW_PROGRAM})
# drawings of others on our masks, and ours come back, before KLayout
fw_script_test(klayout.cells COMMAND /usr/bin/python3 tests/klayout/cells.py ${FW_PROGRAM} TIMEOUT 600)
# STEP as Open CASCADE reads it
fw_script_test(accept.step COMMAND /usr/bin/python3 tests/accept/step.py ${FW_PROGRAM})
set_tests_properties(accept.shapes klayout.package klayout.rules klayout.gdspy klayout.cells accept.step PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(docs.readme COMMAND ${Python3_EXECUTABLE} tests/docs/readme.py ${FW_PROGRAM} TIMEOUT 1800)
fw_script_test(docs.json COMMAND ${Python3_EXECUTABLE} tests/docs/json_keys.py ${FW_PROGRAM} $<TARGET_FILE:live>)
fw_script_test(docs.effects LABEL quick COMMAND ${Python3_EXECUTABLE} tests/docs/effects.py)
fw_script_test(docs.masks LABEL quick COMMAND ${Python3_EXECUTABLE} tests/docs/mask_benchmarks.py)
fw_script_test(docs.gallery_solids COMMAND ${Python3_EXECUTABLE} tests/docs/gallery_solids.py ${FW_PROGRAM})
fw_script_test(docs.solids LABEL quick COMMAND ${Python3_EXECUTABLE} tests/docs/solids.py
               ${PROJECT_BINARY_DIR}/tools/solids)
fw_script_test(docs.accuracy LABEL quick COMMAND ${Python3_EXECUTABLE} tests/docs/accuracy.py)
fw_script_test(docs.pages LABEL quick COMMAND ${Python3_EXECUTABLE} tests/docs/pages.py)
fw_script_test(docs.names LABEL quick COMMAND ${Python3_EXECUTABLE} tests/docs/names.py)
# what the schema for editors refuses and takes, before the program
fw_script_test(docs.schema COMMAND ${Python3_EXECUTABLE} tests/docs/schema.py ${FW_PROGRAM} TIMEOUT 900)
set_tests_properties(docs.schema PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(docs.theory LABEL longer COMMAND ${Python3_EXECUTABLE} tests/docs/theory.py ${FW_PROGRAM})
fw_script_test(docs.limits COMMAND ${Python3_EXECUTABLE} tests/docs/limits.py ${FW_PROGRAM} TIMEOUT 600)
fw_script_test(build.sanitized COMMAND tests/build/sanitized.sh TIMEOUT 1500)
# a third tree, to run what library.state has looked for in every object
fw_script_test(build.threads LABEL long COMMAND tests/build/threads.sh TIMEOUT 900)
fw_script_test(build.labels LABEL quick COMMAND ${Python3_EXECUTABLE} tests/build/labels.py ${PROJECT_BINARY_DIR})
fw_script_test(build.together LABEL quick COMMAND ${Python3_EXECUTABLE} tests/build/together.py)
fw_script_test(build.bytes COMMAND ${Python3_EXECUTABLE} tests/build/bytes.py ${FW_PROGRAM} TIMEOUT 900)
set_tests_properties(build.bytes PROPERTIES DEPENDS build.sanitized) # uses what they build
fw_script_test(effects.costs COMMAND ${Python3_EXECUTABLE} tests/build/effects.py costs $<TARGET_FILE:effect_cost>)
fw_script_test(effects.absent COMMAND ${Python3_EXECUTABLE} tests/build/effects.py absent
               ${PROJECT_BINARY_DIR} TIMEOUT 600)
set_tests_properties(effects.costs effects.absent PROPERTIES SKIP_RETURN_CODE 77)
# instruction counts against tests/bench/baseline.json
fw_script_test(gate.counts COMMAND ${Python3_EXECUTABLE} tests/bench/gate ${PROJECT_BINARY_DIR})
set_tests_properties(gate.counts PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(cost.size COMMAND ${Python3_EXECUTABLE} tests/build/size.py $<TARGET_FILE:accuracy_motions>)
set_tests_properties(cost.size PROPERTIES SKIP_RETURN_CODE 77)
fw_script_test(gate.judge LABEL quick COMMAND ${Python3_EXECUTABLE} tests/build/gate_judge.py)
fw_script_test(accuracy.reference COMMAND ${Python3_EXECUTABLE} tests/accuracy/reference_check.py
               $<TARGET_FILE:accuracy_reference>)
fw_script_test(fuzz.device COMMAND tests/build/fuzz.sh TIMEOUT 600)
set_tests_properties(fuzz.device PROPERTIES DEPENDS build.sanitized) # in the same tree
fw_script_test(hard.valgrind LABEL hard COMMAND tests/build/valgrind.sh ${PROJECT_BINARY_DIR} TIMEOUT 600)
set_tests_properties(hard.valgrind PROPERTIES SKIP_RETURN_CODE 77)
set_tests_properties(build.sanitized PROPERTIES PROCESSORS 2) # two at a time within; beside it what waits more than it computes

include(serve/serve.cmake)
include(ccx/ccx.cmake)
include(web/web.cmake)
# the functions behind the page without a server
add_executable(live live/live.c)
target_link_libraries(live PRIVATE fw_study)
fw_first_part_of(live.memory COMMAND live memory FIRST 3000 WHOLE 10000)
fw_first_part_of(live.designs COMMAND live designs FIRST 30 WHOLE 1000)
# what a thread's cache of freed blocks keeps counts as held, and is up to 7 kB more or less from run to run
set_tests_properties(live.memory whole.live.memory live.designs whole.live.designs PROPERTIES
                     ENVIRONMENT GLIBC_TUNABLES=glibc.malloc.tcache_count=0)
# files and descriptions that are mostly right, by seed; tests/build/fuzz.sh has the same with coverage, under the sanitizers
fw_first_part_of(fuzz.files COMMAND fuzzed_files FIRST 2000 WHOLE 100000)
fw_first_part_of(fuzz.judge COMMAND fuzzed_judge FIRST 40 WHOLE 500)
fw_first_part_of(fuzz.bodies COMMAND fuzzed_bodies FIRST 300 WHOLE 20000)

add_executable(fault_memory faults/memory.c faults/sites.c)
target_include_directories(fault_memory PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
foreach(name new part alloc raw grow strdup strndup printf)
    target_link_options(fault_memory PRIVATE -Wl,--wrap=fw_arena_${name})
endforeach()
target_link_libraries(fault_memory PRIVATE fw_plan)
fw_first_part_of(fault.memory COMMAND fault_memory docs/gallery/reference-six-bar/device.xml FIRST 12 WHOLE 120)
# calls of libraries and of the system that fail, and kills before them; a seed is the same calls on every machine
add_library(fault_preload MODULE faults/preload.c)
target_compile_options(fault_preload PRIVATE -fvisibility=default)
target_link_libraries(fault_preload PRIVATE dl)
set(FW_LOOPS ${Python3_EXECUTABLE} tests/faults/loops.py ${FW_PROGRAM} $<TARGET_FILE:fault_preload>)
if(NOT FW_SANITIZE) # a sanitizer has an allocator of its own
    fw_first_part_of(fault.calls COMMAND ${FW_LOOPS} FIRST --most 2 --runs 3 --case check plan statics hinge simulate calibrate log report study doctor
                     WHOLE --most 12)
    fw_first_part_of(fault.kill COMMAND ${FW_LOOPS} --kill --kind open write fsync rename close mkdir unlink
                     FIRST --most 2 --runs 3 --case plan log statics study WHOLE --most 8)
    fw_first_part_of(fault.served COMMAND ${Python3_EXECUTABLE} tests/faults/served.py ${FW_PROGRAM} $<TARGET_FILE:fault_preload>
                     FIRST --count 6 WHOLE --count 60)
endif()
fw_script_test(fault.instead COMMAND ${Python3_EXECUTABLE} tests/faults/instead.py ${FW_PROGRAM})
fw_script_test(hostile.documents COMMAND ${Python3_EXECUTABLE} tests/hostile/hostile.py ${FW_PROGRAM} TIMEOUT 600)
fw_first_part_of(fault.limits COMMAND ${Python3_EXECUTABLE} tests/faults/limits.py ${FW_PROGRAM} FIRST --count 8 WHOLE --count 200)
fw_script_test(golden.gallery COMMAND tests/golden/gallery.sh ${FW_PROGRAM})
fw_script_test(golden.said COMMAND ${Python3_EXECUTABLE} tests/golden/said.py ${FW_PROGRAM})
fw_script_test(accept.wafer COMMAND tests/accept/wafer.sh ${FW_PROGRAM} TIMEOUT 600)
set_tests_properties(accept.masks accept.wafer accept.nets accept.random accept.selftest accept.written
                     PROPERTIES SKIP_RETURN_CODE 77)
if(NOT FW_SANITIZE) # a sanitized library wants a sanitized user
    fw_script_test(library.consumer COMMAND tests/consumer/run.sh ${PROJECT_BINARY_DIR} ${FW_PROGRAM})
    # the package needs NumPy of the system's python3
    fw_script_test(python.package COMMAND /usr/bin/python3 tests/python/test_package.py ${PROJECT_BINARY_DIR})
    fw_script_test(python.docs COMMAND /usr/bin/python3 tests/python/test_docs.py ${PROJECT_BINARY_DIR})
    fw_script_test(install.tree COMMAND ${Python3_EXECUTABLE} tests/install/test_install.py ${PROJECT_BINARY_DIR} TIMEOUT 600)
    fw_script_test(python.install COMMAND tests/python/install.sh ${PROJECT_BINARY_DIR} TIMEOUT 600)
endif()

# `plan` of the gallery, once for those that look at what it gives
set(FW_PLANS ${PROJECT_BINARY_DIR}/gallery)
fw_script_test(golden.plans COMMAND tests/golden/plans.sh ${FW_PROGRAM} ${FW_PLANS} TIMEOUT 600)
set_tests_properties(golden.plans PROPERTIES FIXTURES_SETUP gallery)
set_tests_properties(golden.gallery accept.masks cli.advice PROPERTIES FIXTURES_REQUIRED gallery
                     ENVIRONMENT FW_GALLERY_PLANS=${FW_PLANS})

# what `ctest -L quick` runs
get_property(programs GLOBAL PROPERTY FW_QUICK_SCRIPTS)
list(REMOVE_DUPLICATES programs)
add_custom_target(quick DEPENDS ${FW_QUICK_PROGRAMS} ${programs} solids)

# Seconds of a processor of tests that take more than five. The longest begin first, so that two cores end together (ctest
# measures them only for the next time). Of those that stand in FW_LONG each belongs to one turn (tests/turn.py), the one that
# has the least so far; the others run each time, or take turns within.
set(FW_LONG
        build.bytes:160 unit.plan.test_cancel_threads:110 docs.json:101 hard.test_hard_verdict:85 effects.absent:60
        accept.wafer:55 python.package:52 docs.readme:50 klayout.cells:44 docs.limits:40 hard.valgrind:36
        serve.robust:35 clearance.cases:24 cli.slurm:24 accept.masks:24 process.orders:24 fault.files:23
        unit.verdict.test_made_by_hand:23 unit.plan.test_live_attached:21 unit.plan.test_advice:17
        unit.study.test_engine:16 hard.test_hard_friction:16 docs.schema:15 hostile.documents:15 judge.examples:14
        install.tree:12 unit.effects.test_fringe:12 accept.random:12 serve.mutants:11 release.distances:11
        unit.plan.test_nearest_drawn:10 serve.doors:9 live.memory:9 unit.workspace.test_pose_strain:9 accept.shapes:8
        accuracy.survey:8 docs.gallery_solids:8 klayout.package:8 klayout.rules:8 library.consumer:7 serve.hostile:7
        hard.test_hard_surfaces:7 fault.calls:7 unit.plan.test_live_kept:7 unit.plan.test_not_drawn:7 clearance.random:7
        unit.continuum.test_continuum:7 accept.written:7 clearance.stators:6 unit.workspace.test_survey:6 fault.memory:6
        fault.served:6 accept.selftest:6 python.docs:6 docs.theory:6 judge.frequencies:6 python.install:6)
set(FW_LONG_EACH_TIME
        web.page:454 build.sanitized:270 cli.effects:124 cli.study:110 cli.probe:75 cli.advice:67 cli.out_of_plane:65
        cli.program:63 cli.measurements:57 cli.sizing:55 cli.manners:55 cli.heated:49 golden.plans:39 cli.workspace:31
        cli.inputs:24 cli.flowback:21 cli.limits:20 cli.stiction:18 arch.additions:18 fuzz.device:18 gate.counts:17
        cli.apart:16 cli.near_pull_in:16 cli.hinge:15 cli.fitted:13 cli.tradeoff:13 cli.third_flow:12 cli.frames:12
        cli.schedule:11 cli.friction_range:11 cli.large:11 cli.reproducible:10 cli.rest:10 cli.marked:8 cli.shapes:8
        cli.violations:8 golden.said:9 cli.unsymmetric:6 cli.assemble:6 cli.mask_certificate:6 hard.test_hard_contact:5
        cli.sections:5 accept.nets:5 effects.costs:5 fault.kill:5 accept.held:5 judge.random:5)
# build.sanitized has every second turn, with a quarter of its tests in each: half of its seconds are the compiler's, and those turns
# have little else of this table (270 s left an even turn 12 min 9 s, an odd one 9 min 36 s)
set(FW_TURN_NUMBERS 0 1 2 3 4 5 6 7)
foreach(turn ${FW_TURN_NUMBERS})
    math(EXPR FW_TURN_SECONDS_${turn} "300 * (1 - ${turn} % 2)")
endforeach()
set_property(TEST build.sanitized APPEND PROPERTY LABELS turn-even)
foreach(entry ${FW_LONG} ${FW_LONG_EACH_TIME})
    string(REPLACE ":" ";" entry_parts ${entry})
    list(GET entry_parts 0 name)
    list(GET entry_parts 1 seconds)
    if(NOT TEST ${name})
        continue()
    endif()
    set_tests_properties(${name} PROPERTIES COST ${seconds})
    if(NOT entry IN_LIST FW_LONG)
        continue()
    endif()
    set(least 0)
    foreach(turn ${FW_TURN_NUMBERS})
        if(FW_TURN_SECONDS_${turn} LESS FW_TURN_SECONDS_${least})
            set(least ${turn})
        endif()
    endforeach()
    math(EXPR FW_TURN_SECONDS_${least} "${FW_TURN_SECONDS_${least}} + ${seconds}")
    set_property(TEST ${name} APPEND PROPERTY LABELS turn-${least})
endforeach()
set_tests_properties(build.sanitized PROPERTIES COST 1000)
