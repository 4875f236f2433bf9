"""Vectors of the kernels: tuples of one, two or three numbers, as long as space has dimensions.

Each function has an answer for each length (composition.py), written out so that it compiles to what one would write by hand.
"""

from granugas.dynamics.events.composition import generic, implements


@generic
def dot(a, b):
    """a . b"""


@generic
def plus(a, b):
    """a + b"""


@generic
def minus(a, b):
    """a - b"""


@generic
def times(a, b):
    """The components of a by those of b."""


@generic
def along(a, s, b):
    """a + s b, with a number s."""


@generic
def scaled(a, s):
    """a by the number s."""


@generic
def divided(a, s):
    """a by 1/s, each component divided by the number s."""


@generic
def mapped(a, b, f):
    """f(a_k, b_k) of each component, with a function f of kernels."""


@generic
def mapped_three(a, b, c, f):
    """f(a_k, b_k, c_k) of each component."""


@generic
def with_component(a, axis, value):
    """a with the number `value` along an axis."""


@generic
def cross(w, a):
    """w x a; in a plane w has one component, out of the plane."""


@generic
def torque(a, b):
    """a x b; in a plane its one component, out of the plane."""


@generic
def zeros_like(a):
    """The vector of zeros."""


@implements(dot, 1)
def _dot_1(a, b):
    return a[0] * b[0]


@implements(dot, 2)
def _dot_2(a, b):
    return a[0] * b[0] + a[1] * b[1]


@implements(dot, 3)
def _dot_3(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@implements(plus, 1)
def _plus_1(a, b):
    return (a[0] + b[0],)


@implements(plus, 2)
def _plus_2(a, b):
    return a[0] + b[0], a[1] + b[1]


@implements(plus, 3)
def _plus_3(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@implements(minus, 1)
def _minus_1(a, b):
    return (a[0] - b[0],)


@implements(minus, 2)
def _minus_2(a, b):
    return a[0] - b[0], a[1] - b[1]


@implements(minus, 3)
def _minus_3(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@implements(times, 1)
def _times_1(a, b):
    return (a[0] * b[0],)


@implements(times, 2)
def _times_2(a, b):
    return a[0] * b[0], a[1] * b[1]


@implements(times, 3)
def _times_3(a, b):
    return a[0] * b[0], a[1] * b[1], a[2] * b[2]


@implements(along, 1)
def _along_1(a, s, b):
    return (a[0] + s * b[0],)


@implements(along, 2)
def _along_2(a, s, b):
    return a[0] + s * b[0], a[1] + s * b[1]


@implements(along, 3)
def _along_3(a, s, b):
    return a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]


@implements(scaled, 1)
def _scaled_1(a, s):
    return (a[0] * s,)


@implements(scaled, 2)
def _scaled_2(a, s):
    return a[0] * s, a[1] * s


@implements(scaled, 3)
def _scaled_3(a, s):
    return a[0] * s, a[1] * s, a[2] * s


@implements(divided, 1)
def _divided_1(a, s):
    return (a[0] / s,)


@implements(divided, 2)
def _divided_2(a, s):
    return a[0] / s, a[1] / s


@implements(divided, 3)
def _divided_3(a, s):
    return a[0] / s, a[1] / s, a[2] / s


@implements(mapped, 1)
def _mapped_1(a, b, f):
    return (f(a[0], b[0]),)


@implements(mapped, 2)
def _mapped_2(a, b, f):
    return f(a[0], b[0]), f(a[1], b[1])


@implements(mapped, 3)
def _mapped_3(a, b, f):
    return f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2])


@implements(mapped_three, 1)
def _mapped_three_1(a, b, c, f):
    return (f(a[0], b[0], c[0]),)


@implements(mapped_three, 2)
def _mapped_three_2(a, b, c, f):
    return f(a[0], b[0], c[0]), f(a[1], b[1], c[1])


@implements(mapped_three, 3)
def _mapped_three_3(a, b, c, f):
    return f(a[0], b[0], c[0]), f(a[1], b[1], c[1]), f(a[2], b[2], c[2])


@implements(with_component, 1)
def _with_component_1(a, axis, value):
    return (value,)


@implements(with_component, 2)
def _with_component_2(a, axis, value):
    return (value if axis == 0 else a[0]), (value if axis == 1 else a[1])


@implements(with_component, 3)
def _with_component_3(a, axis, value):
    return (value if axis == 0 else a[0]), (value if axis == 1 else a[1]), (value if axis == 2 else a[2])


@implements(cross, 1)
def _cross_in_a_plane(w, a):
    return -w[0] * a[1], w[0] * a[0]


@implements(cross, 3)
def _cross_in_space(w, a):
    return w[1] * a[2] - w[2] * a[1], w[2] * a[0] - w[0] * a[2], w[0] * a[1] - w[1] * a[0]


@implements(torque, 2)
def _torque_in_a_plane(a, b):
    return (a[0] * b[1] - a[1] * b[0],)


@implements(torque, 3)
def _torque_in_space(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@implements(zeros_like, 1)
def _zeros_like_1(a):
    return (0.0,)


@implements(zeros_like, 2)
def _zeros_like_2(a):
    return 0.0, 0.0


@implements(zeros_like, 3)
def _zeros_like_3(a):
    return 0.0, 0.0, 0.0
