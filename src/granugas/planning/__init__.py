"""Before anything runs: what studies will cost and how good they will be, and what is cheapest for an error."""
