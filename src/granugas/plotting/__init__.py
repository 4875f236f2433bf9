"""Figures and films: the style, and what drawings of several figures have in common."""
