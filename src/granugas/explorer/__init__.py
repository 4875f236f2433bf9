"""Runs as a page to explore: `explorer.html`, one file that needs no network."""

from granugas.explorer.building import Source, write_explorer

__all__ = ["Source", "write_explorer"]
