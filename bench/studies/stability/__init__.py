# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What bench/studies/stability_map.py is made of: maps, long runs, verdicts on runs, pictures."""
