"""Small measurements that are no study of a gas: each module has a function `measure() -> xr.Dataset`."""
