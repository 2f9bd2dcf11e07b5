# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 5 with the paper's own scheme and step, beside shape following: what the errors of area and the steady values owe to the scheme."""

from cases import fig4_5
from harness import drawing, shear

TITLE = "figure 5 as the paper computes it: Euler steps, penalty tension and volume"


def compute(context):
    return fig4_5.compute(context, {"shape following": {}, "paper's scheme": shear.paper_scheme(128 if context.paper else 64) | shear.HALF})


def draw(context, values, path):
    figure = drawing.plt.figure(figsize=(9.5, 5))
    fig4_5.draw_courses(figure, values)
    drawing.save(figure, path)
