"""Run time against error: what bench/work_precision.py is made of."""
