"""Freely cooling granular gases: dissipative hard disks, the TC model, and their clusters.

import granugas as gg
scene = gg.Scene(n_particles=5740, area_fraction=0.2267, restitution=0.4, contact_time=1e-5)
data = gg.simulate(scene, until=5.0, seed=1)
found = gg.find_clusters(data, distance_factors=[1.05, 1.1])
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import Any

_HOMES = {
    "Scene": "granugas.scene",
    "SceneError": "granugas.scene",
    "equilibrate": "granugas.equilibrate",
    "simulate": "granugas.simulate",
    "export_snapshots": "granugas.storage.export",
    "find_clusters": "granugas.analysis.clusters",
    "load_study": "granugas.storage.dataset",
    "warm_up": "granugas.warm_up",
}
__all__ = sorted(_HOMES)
__version__ = "0.1.0"


def __getattr__(name: str) -> Any:
    """Import on first use: the names above cost nothing until somebody needs them."""
    if name not in _HOMES:
        raise AttributeError(f"module 'granugas' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


class _Package(ModuleType):
    """`granugas.simulate` stays the function when the module of that name has been imported."""

    def __setattr__(self, name: str, value: Any) -> None:
        if not (name in _HOMES and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
