# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run time against error: what bench/studies/work_precision.py is made of."""
