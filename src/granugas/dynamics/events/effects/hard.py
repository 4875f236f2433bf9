"""Hard disks without a contact duration (IHS): every collision is as the material says."""

from typing import Any

from granugas.dynamics.state import State
from granugas.scene import Scene


def effect_of(scene: Scene, state: State, material: Any) -> Any:
    """The material itself."""
    return material
