# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The cases of validation/run.py, in the order of the paper. Each module has

TITLE    a line
compute  (context) -> values: runs the scenes (context.run) and returns what is stored; "tables" is a list of harness.tables.table()
draw     (context, values, path): the figure, from the values and from the files in context.folders, by name of the run
"""

import importlib

NAMES = ["table1", "table2_3", "fig3", "fig4_5", "fig5_scheme", "fig6", "fig7", "fig8", "fig9", "fig10_11", "fig12",
         "grid_and_box", "critical_ratio", "tumbling_period", "deflated_shear", "sharp_treading",
         "sharp_modes", "sharp_sinking", "sharp_tumbling", "sharp_critical", "sharp_drift", "sharp_several", "sharp_figures"]


def load(name):
    return importlib.import_module(f"cases.{name}")
