"""Start lattices: one file for each number of dimensions, with the same functions in each.

`filling(scene)` takes the box as asked (lattice "auto"), `explicit(scene)` the lattice that the scene names;
`site(lattice, k)` says where the sites of these numbers are. DENSEST are the kinds and the fractions that touching particles
fill; up to the fraction MELTED_UP_TO a start is melted, above it the crystal is the stable phase and is kept.
"""
