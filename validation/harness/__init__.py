# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the programs of validation/ and bench/ share: their options, runs of scenes and plans, files of runs, theory, tables and pictures."""
