# SPDX-License-Identifier: GPL-3.0-or-later
"""Flexwright in KLayout: devices as PCells, planning and markers from the menu, rules as a DRC script."""
