"""Event-driven molecular dynamics of hard disks."""

from granugas.digest import use_kernel_cache

use_kernel_cache()
