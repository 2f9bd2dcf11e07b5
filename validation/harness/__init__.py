"""What the cases of validation/run.py share: runs of scenes, their files, theory, tables and pictures."""
