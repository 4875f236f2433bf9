"""Effects: one file each, none imports another, none is named by the loop (see ../composition.py)."""
