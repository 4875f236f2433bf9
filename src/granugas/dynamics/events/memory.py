"""Raw memory of the kernels: tables of rows and single records, read as `disks.x[i]` and `calendar.now`.

A numba array that is handed to a helper drags its reference count and its shape along, which costs a factor 2 to 4 in the hot
path. Here a table is nothing but the address of a structured numpy array; the offsets of its columns are part of its type, so
that `disks.t[i] += 1.0` compiles to one load and one store. A field with several components is read and written as a tuple, a
vector of the kernels (vectors.py); a field of several vectors in a record is a column of them. Nothing checks an index in
compiled code: with NUMBA_DISABLE_JIT=1 the same kernels run as plain Python on numpy columns, where every index is checked.
"""

import hashlib
import operator
from functools import cache
from typing import Any

import numpy as np
from llvmlite import ir
from numba import config, types
from numba.core import cgutils
from numba.core.typing.templates import AttributeTemplate, infer_getattr
from numba.extending import (
    NativeValue,
    intrinsic,
    lower_builtin,
    lower_getattr_generic,
    lower_setattr_generic,
    models,
    register_model,
    type_callable,
    typeof_impl,
    unbox,
)
from numba.np.numpy_support import from_dtype

COMPILED = not config.DISABLE_JIT
"""False under NUMBA_DISABLE_JIT=1: kernels are then plain Python."""


CACHE_LINE = 64
"""Bytes."""


def allocate(count: int, layout: np.dtype) -> np.ndarray:
    """`count` rows of zeros that begin with a cache line: a row of 64 bytes then never lies across two of them."""
    size = count * layout.itemsize
    raw = np.zeros(size + CACHE_LINE, np.uint8)
    begin = -raw.ctypes.data % CACHE_LINE
    return raw[begin : begin + size].view(layout)


class Table:
    """Rows of a structured array, seen by kernels as columns: `table.column[row]`."""

    def __init__(self, rows: np.ndarray) -> None:
        if not rows.flags.c_contiguous:
            raise ValueError("a table needs contiguous rows")
        self.rows = rows
        self.address = rows.ctypes.data
        if not COMPILED:
            for name in rows.dtype.names:
                setattr(self, name, _CheckedColumn(rows[name], name))


class Record:
    """The only row of a structured array, seen by kernels as fields: `record.field`."""

    def __init__(self, rows: np.ndarray) -> None:
        if rows.shape != (1,):
            raise ValueError(f"a record needs exactly one row, not {rows.shape}")
        object.__setattr__(self, "rows", rows)
        object.__setattr__(self, "address", rows.ctypes.data)

    def __getattr__(self, name: str) -> Any:
        value = self.rows[name][0]
        if np.ndim(value) == 2:
            return _CheckedColumn(value, name)
        return tuple(value) if np.ndim(value) else value

    def __setattr__(self, name: str, value: Any) -> None:
        self.rows[name][0] = value


class _CheckedColumn:
    """A column that refuses every index outside of it, the negative ones of Python too."""

    def __init__(self, values: np.ndarray, name: str) -> None:
        self._values, self._name = values, name

    def _check(self, index: int) -> int:
        if not 0 <= index < len(self._values):
            raise IndexError(f"{self._name}[{index}] of {len(self._values)} rows")
        return index

    def __getitem__(self, index: int) -> Any:
        value = self._values[self._check(index)]
        return tuple(value) if np.ndim(value) else value

    def __setitem__(self, index: int, value: Any) -> None:
        self._values[self._check(index)] = value


# --- the same two, as numba types: the value is the address ---------------------------------------------------------------


class _RowsType(types.Type):
    """Address of rows with the layout `dtype`."""

    def __init__(self, dtype: np.dtype) -> None:
        self.dtype = dtype
        layout = ",".join(f"{name}:{dtype[name].base.str}{dtype[name].shape}@{dtype.fields[name][1]}" for name in dtype.names)
        digest = hashlib.sha256(f"{layout};{dtype.itemsize}".encode()).hexdigest()
        super().__init__(name=f"{type(self).__name__}({digest[:12]})")  # short, as it is part of every kernel's name


class TableType(_RowsType):
    """numba type of Table."""


class RecordType(_RowsType):
    """numba type of Record."""


class ColumnType(types.Type):
    """Address of the first entry of a column, scalars or vectors; the distance between entries belongs to the type."""

    def __init__(self, entry: types.Type, stride: int) -> None:
        self.entry, self.stride = entry, stride
        super().__init__(name=f"Column({entry},{stride})")


for _type in (TableType, RecordType, ColumnType):

    @register_model(_type)
    class _AddressModel(models.PrimitiveModel):
        def __init__(self, dmm: Any, fe_type: types.Type) -> None:
            super().__init__(dmm, fe_type, ir.IntType(64))


_table_type, _record_type = cache(TableType), cache(RecordType)  # numba asks at every call from Python


@typeof_impl.register(Table)
def _typeof_table(value: Table, context: Any) -> TableType:
    return _table_type(value.rows.dtype)


@typeof_impl.register(Record)
def _typeof_record(value: Record, context: Any) -> RecordType:
    return _record_type(value.rows.dtype)


@unbox(TableType)
@unbox(RecordType)
def _unbox_rows(typ: types.Type, value: Any, c: Any) -> NativeValue:
    address = c.pyapi.object_getattr_string(value, "address")
    native = c.unbox(types.uint64, address)
    c.pyapi.decref(address)
    return NativeValue(native.value, is_error=native.is_error)


def _entry(field: np.dtype) -> types.Type:
    """Type of a field's value: a scalar, or a tuple of its last dimension."""
    scalar = from_dtype(field.base)
    return types.UniTuple(scalar, field.shape[-1]) if field.shape else scalar


@infer_getattr
class _TableAttributes(AttributeTemplate):
    key = TableType

    def generic_resolve(self, typ: TableType, name: str) -> types.Type | None:
        return ColumnType(_entry(typ.dtype[name]), typ.dtype.itemsize) if name in typ.dtype.names else None


@infer_getattr
class _RecordAttributes(AttributeTemplate):
    key = RecordType

    def generic_resolve(self, typ: RecordType, name: str) -> types.Type | None:
        if name not in typ.dtype.names:
            return None
        field = typ.dtype[name]
        return ColumnType(_entry(field), field.itemsize // field.shape[0]) if field.ndim == 2 else _entry(field)


def _offset(builder: Any, typ: _RowsType, address: Any, name: str) -> Any:
    return builder.add(address, ir.Constant(ir.IntType(64), typ.dtype.fields[name][1]))


@lower_getattr_generic(TableType)
def _column_of(context: Any, builder: Any, typ: TableType, value: Any, name: str) -> Any:
    return _offset(builder, typ, value, name)


@lower_getattr_generic(RecordType)
def _read_field(context: Any, builder: Any, typ: RecordType, value: Any, name: str) -> Any:
    address = _offset(builder, typ, value, name)
    return address if typ.dtype[name].ndim == 2 else _load_entry(context, builder, _entry(typ.dtype[name]), address)


@lower_setattr_generic(RecordType)
def _write_field(context: Any, builder: Any, sig: Any, args: Any, name: str) -> None:
    typ, value_type = sig.args
    _store_entry(context, builder, _entry(typ.dtype[name]), _offset(builder, typ, args[0], name), args[1], value_type)


@type_callable(operator.getitem)
def _type_getitem(context: Any) -> Any:
    return lambda column, index: column.entry if isinstance(column, ColumnType) and isinstance(index, types.Integer) else None


@type_callable(operator.setitem)
def _type_setitem(context: Any) -> Any:
    return lambda column, index, value: (
        types.none if isinstance(column, ColumnType) and isinstance(index, types.Integer) else None
    )


@lower_builtin(operator.getitem, ColumnType, types.Integer)
def _load(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return _load_entry(context, builder, sig.args[0].entry, _address_of_entry(context, builder, sig, args))


@lower_builtin(operator.setitem, ColumnType, types.Integer, types.Any)
def _store(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    address = _address_of_entry(context, builder, sig, args)
    _store_entry(context, builder, sig.args[0].entry, address, args[2], sig.args[2])
    return context.get_dummy_value()


def _address_of_entry(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    column, index_type = sig.args[:2]
    index = context.cast(builder, args[1], index_type, types.int64)
    return builder.add(args[0], builder.mul(index, ir.Constant(ir.IntType(64), column.stride)))


def _load_entry(context: Any, builder: Any, entry: types.Type, address: Any) -> Any:
    if not isinstance(entry, types.UniTuple):
        return builder.load(_pointer(context, builder, entry, address, 0))
    parts = [builder.load(_pointer(context, builder, entry.dtype, address, k)) for k in range(entry.count)]
    return context.make_tuple(builder, entry, parts)


def _store_entry(context: Any, builder: Any, entry: types.Type, address: Any, value: Any, given: types.Type) -> None:
    if not isinstance(entry, types.UniTuple):
        builder.store(context.cast(builder, value, given, entry), _pointer(context, builder, entry, address, 0))
        return
    for k, (part, kind) in enumerate(zip(cgutils.unpack_tuple(builder, value), given, strict=True)):
        builder.store(context.cast(builder, part, kind, entry.dtype), _pointer(context, builder, entry.dtype, address, k))


def _pointer(context: Any, builder: Any, scalar: types.Type, address: Any, k: int) -> Any:
    """To the k-th of scalars that follow each other."""
    size = context.get_abi_sizeof(context.get_data_type(scalar))
    place = builder.add(address, ir.Constant(ir.IntType(64), k * size))
    return builder.inttoptr(place, context.get_data_type(scalar).as_pointer())


@intrinsic
def _prefetch(typing_context: Any, column: types.Type, index: types.Type) -> Any:
    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        pointer = builder.inttoptr(_address_of_entry(context, builder, sig, args), cgutils.voidptr_t)
        flag = ir.IntType(32)
        signature = ir.FunctionType(ir.VoidType(), [cgutils.voidptr_t, flag, flag, flag])
        hint = cgutils.get_or_insert_function(builder.module, signature, "llvm.prefetch.p0")
        builder.call(hint, [pointer, flag(0), flag(3), flag(1)])
        return context.get_dummy_value()

    return types.none(column, index), lower


def _no_prefetch(column: _CheckedColumn, index: int) -> None:
    column._check(index)


prefetch = _prefetch if COMPILED else _no_prefetch
"""prefetch(column, index): ask for the cache line of an entry that will be needed soon."""
