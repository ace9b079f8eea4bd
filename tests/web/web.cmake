# SPDX-License-Identifier: GPL-3.0-or-later
# The page in headless Chromium; skipped only where there is no Chromium or no npm.
fw_script_test(web.page COMMAND tests/web/run.sh ${FW_PROGRAM} ${PROJECT_BINARY_DIR} TIMEOUT 1200)
set_tests_properties(web.page PROPERTIES SKIP_RETURN_CODE 77)
