"""Ways to move the particles: a state in, the state at a later time out."""
