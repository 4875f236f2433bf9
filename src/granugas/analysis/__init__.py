"""What runs mean: theory, observables, clusters and statistics. Arrays in, arrays out."""
