# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the cases of validation/run.py share: runs of scenes, their files, theory, tables and pictures."""
