"""What bench/stability_map.py is made of: maps, long runs, verdicts on runs, pictures."""
